// ball-on-bracket.geo: a ball on a bracket that is bolted to a wall, by gmsh's OpenCASCADE kernel; lengths in mm
SetFactory("OpenCASCADE");
DefineConstant[ radius = {8, Name "the ball's radius"} ];
DefineConstant[ size = {0.2, Name "size of the elements in the contact"} ];
DefineConstant[ finer = {0.8, Name "size of the bracket's elements over that"} ];
DefineConstant[ round = {1.8, Name "size of the ball's elements far away"} ];
DefineConstant[ coarse = {5, Name "size of the bracket's elements far away"} ];

// the bracket: a plate on the wall, a shelf whose top is z = 0, a rib below it, two holes for bolts
Box(1) = {-20, -18, -36, 8, 36, 56};
Box(2) = {-12, -18, -8, 34, 36, 8};
Point(1001) = {-12, -3, -8};
Point(1002) = {14, -3, -8};
Point(1003) = {-12, -3, -32};
Line(1001) = {1001, 1002};
Line(1002) = {1002, 1003};
Line(1003) = {1003, 1001};
Curve Loop(1001) = {1001, 1002, 1003};
Plane Surface(1001) = {1001};
rib() = Extrude {0, 6, 0} { Surface{1001}; };
BooleanUnion(10) = { Volume{1}; Delete; }{ Volume{2, rib(1)}; Delete; };
Cylinder(11) = {-21, 0, 12, 10, 0, 0, 4, 2 * Pi};
Cylinder(12) = {-21, 0, -22, 10, 0, 0, 4, 2 * Pi};
BooleanDifference(13) = { Volume{10}; Delete; }{ Volume{11, 12}; Delete; };
Sphere(20) = {4, 0, radius, radius};

gap = 1e-3;
Physical Volume("bracket") = {13};
Physical Volume("ball") = {20};
ball() = Abs(Boundary{ Volume{20}; });
Physical Surface("ball-surface") = ball();
shelf() = Surface In BoundingBox {-12 - gap, -18 - gap, -gap, 22 + gap, 18 + gap, gap};
Physical Surface("shelf") = shelf();
bolts() = Surface In BoundingBox {-20 - gap, -4 - gap, 8 - gap, -12 + gap, 4 + gap, 16 + gap};
bolts() += Surface In BoundingBox {-20 - gap, -4 - gap, -26 - gap, -12 + gap, 4 + gap, -18 + gap};
Physical Surface("bolts") = bolts();

// elements grow away from the point of contact; the ball's stay small enough for its volume
Field[1] = MathEval;
Field[1].F = Sprintf("Min(%g-%g*Tanh(1e4*(z-1e-3)),%g*(%g+%g*Tanh(1e4*(z-1e-3)))*(1+0.3*Max(0,Sqrt((x-4)^2+y*y+z*z)-0.8)/%g))",
    0.5 * (round + coarse), 0.5 * (coarse - round), size, 0.5 * (1 + finer), 0.5 * (1 - finer), size);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
