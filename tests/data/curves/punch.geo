SetFactory("OpenCASCADE");
Rectangle(1) = {-2, -2, 0, 4, 2}; Rectangle(2) = {-0.5, 0, 0, 1, 1};
Physical Surface("base") = {1}; Physical Surface("punch") = {2};
Physical Curve("bottom") = {1}; Physical Curve("top-of-base") = {3};
Physical Curve("foot") = {5}; Physical Curve("head") = {7};
Mesh.MeshSizeMax = 0.25;
