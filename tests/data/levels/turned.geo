SetFactory("OpenCASCADE");
Box(1) = {0, 0, -1, 3, 2, 1};
Rotate {{0, 0, 1}, {0, 0, 0}, Atan(0.75)} { Volume{1}; }
f() = Abs(Boundary{ Volume{1}; });
Physical Volume("block") = {1}; Physical Surface("left") = {f(0)}; Physical Surface("side") = {f(1)};
Physical Surface("front") = {f(2)}; Physical Surface("base") = {f(4)}; Physical Surface("top") = {f(5)};
Mesh.MeshSizeMax = 0.22;
