SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 1, 3}; Cylinder(2) = {0, 0, 0, 0, 0, 1, 1.2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("disc") = {3}; Physical Surface("rim") = {1}; Physical Surface("shaft") = {4};
Field[1] = MathEval; Field[1].F = "0.08 + 0.3 * Sqrt(x * x + (y - 3) * (y - 3))";
Background Field = 1; Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeMax = 1;
Mesh.ElementOrder = 2;
