// a belt around a quarter of a pulley (centre 0 0), straight ends; mm
DefineConstant[ R = {50, Name "pulley"}, t = {1, Name "belt"}, L = {20, Name "straight"}, hs = {0.5, Name "size"} ];
Point(9) = {0,0,0,hs};
Point(1) = {R,-L,0,hs}; Point(2) = {R+t,-L,0,hs}; Point(3) = {R+t,0,0,hs}; Point(4) = {0,R+t,0,hs};
Point(5) = {-L,R+t,0,hs}; Point(6) = {-L,R,0,hs}; Point(7) = {0,R,0,hs}; Point(8) = {R,0,0,hs};
Line(1) = {1,2}; Line(2) = {2,3}; Circle(3) = {3,9,4}; Line(4) = {4,5}; Line(5) = {5,6}; Line(6) = {6,7}; Circle(7) = {7,9,8}; Line(8) = {8,1};
Curve Loop(1) = {1:8}; Plane Surface(1) = {1};
Physical Surface("belt") = {1};
Physical Curve("slack") = {1}; Physical Curve("tight") = {5}; Physical Curve("inner") = {6,7,8};
