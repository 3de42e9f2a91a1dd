// pin-in-hole.geo: a round pin in the hole of a plate, with a clearance all round; lengths in mm
//   gmsh -2 edp/examples/pin-in-hole/pin-in-hole.geo, or as it is: -mesh edp/examples/pin-in-hole/pin-in-hole.geo
DefineConstant[ pin = {10, Name "radius of the pin"} ];
DefineConstant[ clearance = {0.01, Name "radius of the hole less the pin's"} ];
DefineConstant[ half = {500, Name "half the plate's width and height"} ];
DefineConstant[ size = {0.28, Name "size of the elements in the hole"} ];
DefineConstant[ finer = {0.73, Name "size of the pin's elements over that"} ];
DefineConstant[ core = {1, Name "side of the square in the pin's middle that is pulled"} ];
hole = pin + clearance;

// corners of the plate, and of the core
Macro Square
  Point(at + 1) = {-reach, -reach, 0};
  Point(at + 2) = {reach, -reach, 0};
  Point(at + 3) = {reach, reach, 0};
  Point(at + 4) = {-reach, reach, 0};
  For k In {1 : 4}
    Line(at + k) = {at + k, at + (k % 4) + 1};
  EndFor
  Curve Loop(at) = {at + 1 : at + 4};
Return
at = 10; reach = half;
Call Square;
at = 20; reach = core / 2;
Call Square;

// circles of four arcs each, about the origin
Point(5) = {0, 0, 0};
Macro Ring
  Point(at + 1) = {radius, 0, 0};
  Point(at + 2) = {0, radius, 0};
  Point(at + 3) = {-radius, 0, 0};
  Point(at + 4) = {0, -radius, 0};
  For k In {1 : 4}
    Circle(at + k) = {at + k, 5, at + (k % 4) + 1};
  EndFor
  Curve Loop(at) = {at + 1 : at + 4};
Return
at = 30; radius = hole;
Call Ring;
at = 40; radius = pin;
Call Ring;
Plane Surface(1) = {10, 30};
Plane Surface(2) = {40, 20};
Plane Surface(3) = {20};

Physical Curve("frame") = {11 : 14};
Physical Curve("bore") = {31 : 34};
Physical Curve("pin-surface") = {41 : 44};
Physical Surface("plate") = {1};
Physical Surface("pin") = {2};
Physical Surface("core") = {3};

// elements grow away from the circles; the pin's differ, so that no two meshes match
Field[1] = MathEval;
Field[1].F = Sprintf("Min((%g+%g*Tanh(1e3*(Sqrt(x*x+y*y)-%g)))*(1+0.15*Abs(Sqrt(x*x+y*y)-%g)/%g),0.5*(%g+Sqrt(x*x+y*y)))",
    0.5 * size * (1 + finer), 0.5 * size * (1 - finer), 0.5 * (hole + pin), 0.5 * (hole + pin), size, core);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
