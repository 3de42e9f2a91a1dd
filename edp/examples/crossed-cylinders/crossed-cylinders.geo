// crossed-cylinders.geo: two cylinders that cross at a right angle and touch at the origin; a quarter; lengths in mm
//   gmsh -3 edp/examples/crossed-cylinders/crossed-cylinders.geo -setnumber ratio 1
SetFactory("OpenCASCADE");
DefineConstant[ radius = {10, Name "radius of the lower cylinder, along x"} ];
DefineConstant[ ratio = {4, Name "radius of the upper one, along y, over that"} ];
DefineConstant[ extent = {5, Name "how far the bodies go from the point of contact"} ];
DefineConstant[ size = {0.08, Name "size of the elements in the contact"} ];
DefineConstant[ long = {0.98, Name "half the length of the contact, along x"} ];
DefineConstant[ wide = {0.39, Name "half its width, along y"} ];
DefineConstant[ depth = {0.25, Name "depth of the finest elements, over half the width"} ];
DefineConstant[ growth = {0.5, Name "growth of the elements outside"} ];
DefineConstant[ finer = {0.8, Name "size of the lower body's elements over the upper one's"} ];

// a quarter: x, y > 0
Cylinder(1) = {0, 0, -radius, extent, 0, 0, radius, 2 * Pi};
Box(2) = {0, 0, -extent, extent, extent, 2 * extent};
BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, ratio * radius, 0, extent, 0, ratio * radius, 2 * Pi};
Box(5) = {0, 0, -extent, extent, extent, 2 * extent};
BooleanIntersection(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };

near = 1e-3 * extent;
Physical Volume("lower") = {3};
Physical Volume("upper") = {6};
mirrors() = Surface In BoundingBox {-near, -near, -extent - near, near, extent + near, extent + near};
Physical Surface("mirror-x") = mirrors();
across() = Surface In BoundingBox {-near, -near, -extent - near, extent + near, near, extent + near};
Physical Surface("mirror-y") = across();
bottom() = Surface In BoundingBox {-near, -near, -extent - near, extent + near, extent + near, -extent + near};
Physical Surface("base") = bottom();
top() = Surface In BoundingBox {-near, -near, extent - near, extent + near, extent + near, extent + near};
Physical Surface("grip") = top();
// the round ones: what is left of the boundary near the origin
ends() = Surface In BoundingBox {extent - near, -near, -extent - near, extent + near, extent + near, extent + near};
sides() = Surface In BoundingBox {-near, extent - near, -extent - near, extent + near, extent + near, extent + near};
below() = Abs(Boundary{ Volume{3}; });
below() -= mirrors(); below() -= across(); below() -= bottom(); below() -= ends(); below() -= sides();
above() = Abs(Boundary{ Volume{6}; });
above() -= mirrors(); above() -= across(); above() -= top(); above() -= ends(); above() -= sides();
Physical Surface("lower-round") = below();
Physical Surface("upper-round") = above();

// elements grow away from the ellipse of contact
Field[1] = MathEval;
Field[1].F = Sprintf("%g*(0.5*(%g+1)+0.5*(1-%g)*Tanh(1e4*z))*(1+%g*Max(0,Sqrt(x*x*%g+y*y*%g+z*z*%g)-1.15)*%g)",
    size, finer, finer, growth, 1 / long^2, 1 / wide^2, 1 / (depth * wide)^2, wide / size);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = extent / 3;
