SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 6, 4}; Cylinder(2) = {0, 0, 1, 0, 0, 4, 6}; Cylinder(3) = {0, 0, 1, 0, 0, 4, 4};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
Physical Volume("shaft") = {1}; Physical Volume("hub") = {4};
Mesh.MeshSizeMax = 3;
