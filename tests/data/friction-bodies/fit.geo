SetFactory("OpenCASCADE");
radius() = {3, 8, 8, 12};
For k In {0 : 3}
  Circle(k + 1) = {0, 0, 0, radius(k)};
  Curve Loop(k + 1) = {k + 1};
EndFor
Plane Surface(1) = {2, 1}; Plane Surface(2) = {4, 3};
Physical Surface("shaft") = {1}; Physical Surface("hub") = {2}; Physical Curve("bore") = {1};
Physical Curve("seat") = {2}; Physical Curve("hole") = {3}; Physical Curve("rim") = {4};
MeshSize{:} = 2;
MeshSize{3} = 1.4;
