SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 5}; Box(2) = {0, 0, 5, 1, 1, 5}; Box(3) = {0, 0, 10, 3, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; }
Box(4) = {1.5, 0, 0, 1.5, 1, 10};
Mesh.MeshSizeMax = 1;
e = 1e-3;
axis() = Surface In BoundingBox {-e, -e, -e, e, 1 + e, 12};
side() = Surface In BoundingBox {-e, -e, -e, 4, e, 12};
foot() = Surface In BoundingBox {-e, -e, -e, 4, 2, e};
cut() = Surface In BoundingBox {-e, -e, 5 - e, 4, 2, 5 + e};
top() = Surface In BoundingBox {-e, -e, 11 - e, 4, 2, 11 + e};
level() = Surface In BoundingBox {1 - e, -e, 10 - e, 4, 2, 10 + e};
seat() = Surface In BoundingBox {1.5 - e, -e, 10 - e, 3 + e, 2, 10 + e};
level() -= seat();
Physical Volume("shank") = {1, 2}; Physical Volume("head") = {3}; Physical Volume("sleeve") = {4};
Physical Surface("axis") = axis(); Physical Surface("side") = side(); Physical Surface("foot") = foot();
Physical Surface("cut") = cut(); Physical Surface("top") = top(); Physical Surface("under") = level();
Physical Surface("seat") = seat();
