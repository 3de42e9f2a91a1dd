// a ring on a hollow shaft about x = 0: a slice between two flat faces; radii 10, 25, 45
DefineConstant[ edges = {6, Name "edges along the joint"} ];
r() = {10, 25, 25, 45};
For k In {0 : 1}
  a = 10 * k;
  Point(a + 1) = {r(2 * k), 0, 0}; Point(a + 2) = {r(2 * k + 1), 0, 0}; Point(a + 3) = {r(2 * k + 1), 12, 0}; Point(a + 4) = {r(2 * k), 12, 0};
  For j In {1:4}
    Line(a + j) = {a + j, a + j % 4 + 1};
  EndFor
  Curve Loop(k + 1) = {a + 1 : a + 4};
  Plane Surface(k + 1) = {k + 1};
EndFor
Transfinite Curve {14} = edges + 1;
Transfinite Curve {2} = Round(1.4 * edges) + 1;
Mesh.MeshSizeMax = 12 / edges;
Physical Curve("bore") = {4}; Physical Curve("journal") = {2}; Physical Curve("seat") = {14}; Physical Curve("outside") = {12};
Physical Curve("floor") = {1, 11}; Physical Curve("roof") = {3, 13};
Physical Surface("shaft") = {1}; Physical Surface("ring") = {2};
