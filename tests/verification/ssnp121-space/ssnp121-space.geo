// ssnp121-space.geo: two cubes of side 1, one on the other, whose meshes do not match
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {0, 0, 1, 1, 1, 1};
Physical Surface("base") = {5};
Physical Surface("lower-face") = {6};
Physical Surface("upper-face") = {11};
Physical Surface("head") = {12};
Physical Volume("lower") = {1};
Physical Volume("upper") = {2};
MeshSize {PointsOf{Volume{1};}} = 0.5;
MeshSize {PointsOf{Volume{2};}} = 0.34;
