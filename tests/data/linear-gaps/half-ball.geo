// half a ball of radius 8 about x = 0, which touches y = 0, under its flat top
DefineConstant[ hs = {0.8, Name "size"} ];
Point(1) = {0,0,0,hs}; Point(2) = {0,8,0,hs}; Point(3) = {8,8,0,hs};
Circle(1) = {1,2,3}; Line(2) = {3,2}; Line(3) = {2,1};
Curve Loop(1) = {1:3}; Plane Surface(1) = {1};
Physical Surface("ball") = {1}; Physical Curve("round") = {1}; Physical Curve("top") = {2}; Physical Curve("axis") = {3};
