// a block over a round pad whose named arc is narrow; d: how far the block is drawn to the left
DefineConstant[ d = {0, Name "drawn to the left by"} ];
Point(1) = {-d,0,0}; Point(2) = {10-d,0,0}; Point(3) = {10-d,3,0}; Point(4) = {-d,3,0};
For k In {1:4}
  Line(k) = {k, 1+k%4};
EndFor
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
r = 6; x = 2.5; a = 0.12;
Point(10) = {x,-r,0};
Point(11) = {x+r*Sin(a), -r+r*Cos(a), 0}; Point(12) = {x-r*Sin(a), -r+r*Cos(a), 0};
Point(13) = {x-r*Sin(0.6), -r+r*Cos(0.6), 0}; Point(14) = {x+r*Sin(0.6), -r+r*Cos(0.6), 0};
Point(15) = {x-3.4,-4,0}; Point(16) = {x+3.4,-4,0};
Circle(11) = {14,10,11}; Circle(12) = {11,10,12}; Circle(13) = {12,10,13};
Line(14) = {13,15}; Line(15) = {15,16}; Line(16) = {16,14};
Curve Loop(2) = {11:16}; Plane Surface(2) = {2};
Physical Curve("under") = {1}; Physical Curve("top") = {3};
Physical Curve("arc") = {12}; Physical Curve("base") = {15};
Physical Surface("block") = {1}; Physical Surface("pad") = {2};
Transfinite Curve{1} = 81; Transfinite Curve{12} = 13;
Mesh.MeshSizeMax = 0.8;
