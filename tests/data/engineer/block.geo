SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 4};
Mesh.MeshSizeMax = 0.6;
Physical Volume("bar") = {1};
Physical Surface("x") = {1}; Physical Surface("y") = {3}; Physical Surface("z") = {5}; Physical Surface("top") = {6};
