// an eighth of two rings of a low height, pressed together at the radius 0.18; second order, meshes that do not match
SetFactory("OpenCASCADE");
For k In {0:1}
  a = k == 0 ? 0.11 : 0.18; b = k == 0 ? 0.18 : 0.25; c = Sqrt(0.5);
  Point(10 * k + 1) = {a, 0, 0}; Point(10 * k + 2) = {b, 0, 0}; Point(10 * k + 3) = {c * b, c * b, 0};
  Point(10 * k + 4) = {c * a, c * a, 0}; Point(10 * k + 5) = {0, 0, 0};
  Line(10 * k + 1) = {10 * k + 1, 10 * k + 2}; Circle(10 * k + 2) = {10 * k + 2, 10 * k + 5, 10 * k + 3};
  Line(10 * k + 3) = {10 * k + 3, 10 * k + 4}; Circle(10 * k + 4) = {10 * k + 4, 10 * k + 5, 10 * k + 1};
  Transfinite Curve {10 * k + 2, 10 * k + 4} = 6 - k; Transfinite Curve {10 * k + 1, 10 * k + 3} = 3;
  Curve Loop(k + 1) = {10 * k + 1:10 * k + 4}; Plane Surface(k + 1) = {k + 1};
EndFor
i[] = Extrude {0, 0, 0.035} {Surface{1};}; o[] = Extrude {0, 0, 0.035} {Surface{2};};
Physical Volume("hub") = {i[1]}; Physical Surface("shaft") = {i[3]};
Physical Volume("ring") = {o[1]}; Physical Surface("bore") = {o[5]};
Physical Surface("floor") = {i[2], o[2]}; Physical Surface("side") = {i[4], o[4]};
Physical Surface("low") = {1, 2}; Physical Surface("high") = {i[0], o[0]};
Mesh.ElementOrder = 2; Mesh.MeshSizeMax = 0.017;
