Point(1) = {0, 0, 0};
For k In {0 : 1}
  r = 10 + 0.2 * k;
  Point(10 * k + 2) = {r, -6, 0}; Point(10 * k + 3) = {r, 0, 0}; Point(10 * k + 4) = {0, r, 0};
  Point(10 * k + 5) = {-r, 0, 0}; Point(10 * k + 6) = {-r, -6, 0};
  Line(10 * k + 2) = {10 * k + 2, 10 * k + 3};
  Circle(10 * k + 3) = {10 * k + 3, 1, 10 * k + 4}; Circle(10 * k + 4) = {10 * k + 4, 1, 10 * k + 5};
  Line(10 * k + 5) = {10 * k + 5, 10 * k + 6};
EndFor
Line(6) = {6, 16}; Line(7) = {12, 2};
Curve Loop(1) = {2 : 5, 6, -15, -14, -13, -12, 7};
Plane Surface(1) = {1};
Physical Surface("belt") = {1}; Physical Curve("inner") = {3, 4}; Physical Curve("slack") = {7};
Physical Curve("tight") = {6};
Mesh.MeshSizeMax = 0.9;
