// ssnv128-space.geo: a slice of the plate of side 40 on a rigid plane, between two planes of symmetry; lengths in mm
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 40, 4, 40};
Physical Surface("side") = {1};
Physical Surface("middle") = {2};
Physical Surface("front") = {3};
Physical Surface("back") = {4};
Physical Surface("sole") = {5};
Physical Surface("top") = {6};
Physical Volume("plate") = {1};
Mesh.MeshSizeMax = 4;
