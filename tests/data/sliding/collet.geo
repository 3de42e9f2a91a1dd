// a collet (cone 8 degrees) between a shaft and a housing, about the axis x = 0; lengths in mm
DefineConstant[ size = {1, Name "element size at the contacts"} ];
t = Tan(8*Pi/180);
// shaft
Point(1) = {0,-10,0,3*size}; Point(2) = {10,-10,0,2*size}; Point(3) = {10,60,0,2*size}; Point(4) = {0,60,0,3*size};
Point(5) = {10,-1,0,size}; Point(6) = {10,41,0,size};
Line(1) = {1,2}; Line(2) = {2,5}; Line(3) = {5,6}; Line(4) = {6,3}; Line(5) = {3,4}; Line(6) = {4,1};
Curve Loop(1) = {1:6}; Plane Surface(1) = {1};
// collet
Point(11) = {10,0,0,size}; Point(12) = {14,0,0,size}; Point(13) = {14+40*t,40,0,size}; Point(14) = {10,40,0,size};
For k In {1:4}
  Line(10+k) = {10+k, 11+k%4};
EndFor
Curve Loop(2) = {11:14}; Plane Surface(2) = {2};
// housing
Point(21) = {14+3*t,3,0,0.8*size}; Point(22) = {35,3,0,3*size}; Point(23) = {35,37,0,3*size}; Point(24) = {14+37*t,37,0,0.8*size};
For k In {1:4}
  Line(20+k) = {20+k, 21+k%4};
EndFor
Curve Loop(3) = {21:24}; Plane Surface(3) = {3};
Physical Curve("shaft-side") = {3};
Physical Curve("shaft-foot") = {1};
Physical Curve("shaft-head") = {5};
Physical Curve("collet-bottom") = {11};
Physical Curve("collet-cone") = {12};
Physical Curve("collet-bore") = {14};
Physical Curve("cone") = {24};
Physical Curve("housing-bottom") = {21};
Physical Surface("shaft") = {1};
Physical Surface("collet") = {2};
Physical Surface("housing") = {3};
