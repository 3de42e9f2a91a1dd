// cad.geo: writes wheel-on-rail.step: the middle of a wheel and of a rail's head, which touch at the origin; lengths in mm
//   gmsh -0 edp/examples/wheel-on-rail/cad.geo -o wheel-on-rail.step
SetFactory("OpenCASCADE");
DefineConstant[ wheel = {460, Name "radius of the wheel, about an axis along y"} ];
DefineConstant[ crown = {300, Name "radius of the rail's head, along x"} ];
DefineConstant[ half = {35, Name "half of what is cut out, in every direction"} ];
Cylinder(1) = {0, -half, wheel, 0, 2 * half, 0, wheel};
Box(2) = {-half, -half, -half, 2 * half, 2 * half, 2 * half};
BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {-half, 0, -crown, 2 * half, 0, 0, crown};
Box(5) = {-half, -half, -half, 2 * half, 2 * half, 2 * half};
BooleanIntersection(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };
