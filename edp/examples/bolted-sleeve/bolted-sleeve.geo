// bolted-sleeve.geo: half of a bolt through a sleeve, about its axis (x is the radius), and about the plane y = 0; lengths in mm
DefineConstant[ shank = {5, Name "radius of the shank"} ];
DefineConstant[ hole = {5.5, Name "radius of the hole"} ];
DefineConstant[ outside = {8, Name "radius of head and sleeve"} ];
DefineConstant[ half = {40, Name "half the length that is clamped"} ];
DefineConstant[ head = {7, Name "height of the head"} ];
DefineConstant[ size = {0.8, Name "elements"} ];
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, shank, half / 2};
Rectangle(2) = {0, half / 2, 0, shank, half / 2};
Rectangle(3) = {0, half, 0, outside, head};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2, 3}; Delete; }
Rectangle(4) = {hole, 0, 0, outside - hole, half};
Mesh.MeshSizeMax = size;
e = 1e-3;
Physical Curve("seat") = Curve In BoundingBox {hole - e, half - e, -e, outside + e, half + e, e};
Physical Surface("bolt") = {1, 2, 3};
Physical Surface("sleeve") = {4};
