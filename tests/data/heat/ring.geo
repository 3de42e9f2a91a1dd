// a ring on a hollow shaft in space: a quarter between two flat faces, whose mesh is of second order
SetFactory("OpenCASCADE");
DefineConstant[ h = {5, Name "size"} ];
DefineConstant[ straight = {2, Name "order of the mesh"} ];
r() = {10, 25, 25, 45};
For k In {0:1}
  Cylinder(10 * k + 1) = {0, 0, 0, 0, 0, 6, r(2 * k + 1), Pi / 2};
  Cylinder(10 * k + 2) = {0, 0, 0, 0, 0, 6, r(2 * k), Pi / 2};
  BooleanDifference(10 * k + 3) = { Volume{10 * k + 1}; Delete; }{ Volume{10 * k + 2}; Delete; };
EndFor
Characteristic Length{ PointsOf{ Volume{3}; } } = h;
Characteristic Length{ PointsOf{ Volume{13}; } } = 0.8 * h;
Mesh.ElementOrder = straight;
Physical Volume("shaft") = {3};
Physical Volume("ring") = {13};
e = 0.1;
floor() = Surface In BoundingBox {-e, -e, -e, 50, e, 7};
side() = Surface In BoundingBox {-e, -e, -e, e, 50, 7};
below() = Surface In BoundingBox {-e, -e, -e, 50, 50, e};
above() = Surface In BoundingBox {-e, -e, 6 - e, 50, 50, 7};
Physical Surface("floor") = {floor()};
Physical Surface("side") = {side()};
Physical Surface("below") = {below()};
Physical Surface("above") = {above()};
s() = Boundary { Volume{3}; };
t() = Boundary { Volume{13}; };
s() -= {floor(), side(), below(), above()};
t() -= {floor(), side(), below(), above()};
inner() = Surface In BoundingBox {-e, -e, -e, 10 + e, 10 + e, 7};
seat() = Surface In BoundingBox {-e, -e, -e, 25 + e, 25 + e, 7};
seat() -= {floor(), side(), below(), above(), s()};
Physical Surface("bore") = {inner()};
s() -= {inner()};
t() -= {seat()};
Physical Surface("journal") = {s()};
Physical Surface("seat") = {seat()};
Physical Surface("outside") = {t()};
