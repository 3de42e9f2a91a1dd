SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 0.5}; Box(2) = {0, 0, 0.5, 1, 1, 0.5};
Mesh.MeshSizeMax = 0.34;
MeshSize{ PointsOf{ Volume{2}; } } = 0.24;
Physical Volume("low") = {1}; Physical Volume("up") = {2};
Physical Surface("base") = {5}; Physical Surface("head") = {6};
Physical Surface("foot") = {11}; Physical Surface("top") = {12};
Physical Surface("lx") = {1}; Physical Surface("ly") = {3}; Physical Surface("ux") = {7}; Physical Surface("uy") = {9};
