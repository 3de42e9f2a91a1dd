// a block of L by 6 above a table of T by 8, x0 from its start; mm
DefineConstant[ hb = {1, Name "elements of the block"}, ht = {1, Name "elements of the table"} ];
DefineConstant[ x0 = {0, Name "start of the block"}, g = {0.01, Name "gap, negative: overlap"} ];
L = 10; T = 20;
Point(1) = {0,0,0,ht}; Point(2) = {T,0,0,ht}; Point(3) = {T,-8,0,2*ht}; Point(4) = {0,-8,0,2*ht};
Line(1) = {1,4}; Line(2) = {4,3}; Line(3) = {3,2}; Line(4) = {2,1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(11) = {x0,g,0,hb}; Point(12) = {x0+L,g,0,hb}; Point(13) = {x0+L,g+6,0,2*hb}; Point(14) = {x0,g+6,0,2*hb};
For k In {1:4}
Line(10+k) = {10+k, 11+k%4};
EndFor
Curve Loop(2) = {11:14}; Plane Surface(2) = {2};
Physical Surface("table") = {1}; Physical Surface("block") = {2};
Physical Curve("base") = {2}; Physical Curve("face") = {4}; Physical Curve("end") = {3}; Physical Curve("start") = {1};
Physical Curve("under") = {11}; Physical Curve("right") = {12}; Physical Curve("top") = {13}; Physical Curve("left") = {14};
