// heated-fit.geo: a quarter of a ring on a hollow shaft, of one radius without heat; lengths in mm
DefineConstant[ bore = {10, Name "inner radius of the shaft"} ];
DefineConstant[ radius = {25, Name "radius of the joint"} ];
DefineConstant[ outside = {45, Name "outer radius of the ring"} ];
DefineConstant[ edges = {24, Name "edges along a quarter of the joint, of the ring"} ];
Point(1) = {0, 0, 0};
r() = {bore, radius, radius, outside};
For k In {0 : 3}
  Point(10 * k + 10) = {r(k), 0, 0};
  Point(10 * k + 11) = {0, r(k), 0};
  Circle(10 * k + 10) = {10 * k + 10, 1, 10 * k + 11};
EndFor
For k In {0 : 2 : 2}
  Line(10 * k + 12) = {10 * k + 10, 10 * k + 20};
  Line(10 * k + 13) = {10 * k + 11, 10 * k + 21};
  Curve Loop(k + 1) = {10 * k + 12, 10 * k + 20, -(10 * k + 13), -(10 * k + 10)};
  Plane Surface(k + 1) = {k + 1};
EndFor
Transfinite Curve {10, 20} = Round(1.3 * edges) + 1;
Transfinite Curve {30, 40} = edges + 1;
Mesh.MeshSizeMax = 2.5 * radius / edges;
Physical Curve("journal") = {20};
Physical Curve("seat") = {30};
Physical Curve("bore") = {10};
Physical Curve("outside") = {40};
Physical Curve("floor") = {12, 32};
Physical Curve("side") = {13, 33};
Physical Surface("shaft") = {1};
Physical Surface("ring") = {3};
