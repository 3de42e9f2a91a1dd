// ssnp121.geo: two squares of side 1, one on the other, whose meshes do not match
Macro Square
  Point(at + 1) = {0, below, 0};
  Point(at + 2) = {1, below, 0};
  Point(at + 3) = {1, below + 1, 0};
  Point(at + 4) = {0, below + 1, 0};
  For k In {1 : 4}
    Line(at + k) = {at + k, at + (k % 4) + 1};
  EndFor
  Curve Loop(at) = {at + 1 : at + 4};
  Plane Surface(at) = {at};
Return
at = 10; below = 0;
Call Square;
at = 20; below = 1;
Call Square;
Transfinite Curve {13} = 5;
Transfinite Curve {21} = 6;
Mesh.MeshSizeMax = 0.25;
Physical Curve("base") = {11};
Physical Curve("lower-face") = {13};
Physical Curve("upper-face") = {21};
Physical Curve("head") = {23};
Physical Surface("lower") = {10};
Physical Surface("upper") = {20};
