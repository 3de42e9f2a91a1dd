// A ball in a straight groove, a quarter of both: the mirrors are x = 0 and y = 0, the groove lies along y; lengths in mm.
SetFactory("OpenCASCADE");
DefineConstant[ radius = {5, Name "of the ball"} ];
DefineConstant[ groove = {5.5, Name "radius of the groove"} ];
DefineConstant[ extent = {4, Name "half the block's width and its depth"} ];
DefineConstant[ size = {0.1, Name "elements in the contact"} ];
Box(1) = {0, 0, -extent, extent, extent, extent + 2};
Cylinder(2) = {0, -1, groove, 0, extent + 2, 0, groove};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Sphere(4) = {0, 0, radius, radius};
Box(5) = {0, 0, 0, radius, radius, radius};
BooleanIntersection(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };
Physical Volume("race") = {3};
Physical Volume("ball") = {6};
e = 1e-3; far = 2 * radius;
Macro Sort // the faces of volume k: on a mirror, on the plane z = level, and the others
  all() = Abs(Boundary{ Volume{k}; });
  left() = Surface In BoundingBox {-e, -far, -far, e, far, far};
  front() = Surface In BoundingBox {-far, -e, -far, far, e, far};
  flat() = Surface In BoundingBox {-far, -far, level - e, far, far, level + e};
Return
k = 3; level = -extent; Call Sort;
Physical Surface("base") = flat();
k = 6; level = radius; Call Sort;
Physical Surface("middle") = flat();
Physical Surface("side") = left();
Physical Surface("front") = front();
all() -= left(); all() -= front(); all() -= flat();
Physical Surface("sphere") = all();
k = 3; level = -extent; Call Sort;
all() -= left(); all() -= front(); all() -= flat();
outer() = Surface In BoundingBox {extent - e, -e, -far, far, far, far};
outer() += Surface In BoundingBox {-e, extent - e, -far, far, extent + e, far};
all() -= outer();
Physical Surface("track") = all();
Field[1] = MathEval; // around the long axis of the ellipse of contact
Field[1].F = Sprintf("%g*(1+0.2*Tanh(1e4*(z-x*x/%g)))+0.25*(Sqrt(Max(0,x-1)^2+y*y+z*z)-0.15+Fabs(Sqrt(Max(0,x-1)^2+y*y+z*z)-0.15))", size, 2 * groove);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = 1.5;
