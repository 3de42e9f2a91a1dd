Point(1) = {-30, -30, 0}; Point(2) = {30, -30, 0}; Point(3) = {30, 0, 0}; Point(4) = {-30, 0, 0};
Point(5) = {-0.2, 0, 0}; Point(6) = {0.2, 0, 0}; Point(7) = {0, -0.1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 6}; Line(4) = {6, 5}; Line(5) = {5, 4}; Line(6) = {4, 1};
Curve Loop(1) = {1 : 6}; Plane Surface(1) = {1};
Field[1] = Distance; Field[1].PointsList = {7};
Field[2] = Threshold; Field[2].InField = 1; Field[2].SizeMin = SIZE; Field[2].SizeMax = 5;
Field[2].DistMin = 0.17; Field[2].DistMax = 30; Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;
Physical Surface("block") = {1}; Physical Curve("base") = {1}; Physical Curve("face") = {4};
