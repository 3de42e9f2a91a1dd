// half of the section of two rings about x = 0, straight edges, pressed together at x = R; meshes that do not match
DefineConstant[ inner = {8}, R = {28}, outer = {35}, H = {4}, size = {1.6}, few = {8} ];
Point(1) = {inner, 0, 0}; Point(2) = {R, 0, 0}; Point(3) = {R, H, 0}; Point(4) = {inner, H, 0};
Point(5) = {R, 0, 0}; Point(6) = {outer, 0, 0}; Point(7) = {outer, H, 0}; Point(8) = {R, H, 0};
For k In {0:1}
  For a In {1:4}
    Line(4 * k + a) = {4 * k + a, 4 * k + a % 4 + 1};
  EndFor
  Curve Loop(k + 1) = {4 * k + 1:4 * k + 4}; Plane Surface(k + 1) = {k + 1};
EndFor
Transfinite Curve {2, 4} = few; Transfinite Curve {6, 8} = few + 1; Mesh.MeshSizeMax = size;
Physical Surface("hub") = {1}; Physical Surface("ring") = {2}; Physical Curve("shaft") = {2}; Physical Curve("bore") = {8};
Physical Curve("floor") = {1, 5}; Physical Curve("side") = {3, 7};
