// a hub pressed on a solid shaft that goes on beyond it. z is the axis
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -30, 0, 0, 90, 20};
Cylinder(2) = {0, 0, 0, 0, 0, 30, 40};
Cylinder(3) = {0, 0, 0, 0, 0, 30, 20};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
Physical Volume("shaft") = {1};
Physical Volume("hub") = {4};
Mesh.MeshSizeMax = 9;
