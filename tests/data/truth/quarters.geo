SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.5, 0.5, 1}; Box(2) = {-1, -1, -1, 1.5, 1.5, 1}; e = 1e-6;
a() = Curve In BoundingBox{-e, -e, -e, 0.5 + e, e, e};
b() = Curve In BoundingBox{-e, -e, -e, e, 0.5 + e, e};
Field[1] = Distance; Field[1].CurvesList = {a(), b()}; Field[1].NumPointsPerCurve = 200;
Field[2] = MathEval; Field[2].F = "0.06 + 0.35*F1"; Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;
Physical Volume("up") = {1}; Physical Volume("low") = {2};
