// a slab above a base that it does not touch
DefineConstant[ n = {4, Name "n"} ];
Point(1) = {0,0,0}; Point(2) = {10,0,0}; Point(3) = {10,2,0}; Point(4) = {0,2,0};
For k In {1:4}
Line(k) = {k, k%4+1};
EndFor
Curve Loop(1)={1:4}; Plane Surface(1)={1};
Point(11) = {0,-1,0}; Point(12) = {10,-1,0}; Point(13) = {10,-3,0}; Point(14) = {0,-3,0};
For k In {1:4}
Line(10+k) = {10+k, 11+k%4};
EndFor
Curve Loop(2)={11:14}; Plane Surface(2)={2};
Mesh.MeshSizeMax=10/n; Mesh.MeshSizeMin=10/n;
Physical Surface("slab")={1}; Physical Surface("base")={2};
Physical Curve("foot")={1}; Physical Curve("right")={2,12}; Physical Curve("top")={3}; Physical Curve("left")={4,14}; Physical Curve("face")={11}; Physical Curve("bottom")={13};
