SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 2};
Rectangle(2) = {0, 2, 0, 1, 1};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }
e = 1e-4;
Physical Surface("soft") = {1};
Physical Surface("stiff") = {2};
Physical Curve("left") = Curve In BoundingBox{-e, -e, -e, e, 3 + e, e};
Physical Curve("right") = Curve In BoundingBox{1 - e, -e, -e, 1 + e, 3 + e, e};
Physical Curve("base") = Curve In BoundingBox{-e, -e, -e, 1 + e, e, e};
Physical Curve("top") = Curve In BoundingBox{-e, 3 - e, -e, 1 + e, 3 + e, e};
Mesh.MeshSizeMax = 0.4;
