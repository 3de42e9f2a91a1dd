// two bars, one on the other
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 10};
Rectangle(2) = {0, 10, 0, 2, 10};
Physical Surface("steel") = {1};
Physical Surface("alu") = {2};
Physical Curve("cold") = {1};
Physical Curve("up") = {3};
Physical Curve("down") = {5};
Physical Curve("hot") = {7};
Mesh.MeshSizeMax = 1;
