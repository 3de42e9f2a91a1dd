Point(1) = {0, 0, 0};
Point(2) = {0.5, 0, 0};
Point(3) = {0.75149, 1, 0};
Point(4) = {0, 1, 0};
For k In {1 : 4}
  Line(k) = {k, k % 4 + 1};
EndFor
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Physical Surface("wedge") = {1};
Physical Curve("flank") = {2};
Physical Curve("head") = {3};
Physical Curve("mirror") = {4};
Mesh.MeshSizeMax = 0.1047;
