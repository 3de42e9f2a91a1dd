// pin-in-hole.geo: a round pin in the hole of a plate, with a clearance all round; lengths in mm
//   gmsh -2 edp/examples/pin-in-hole/pin-in-hole.geo, or as it is: -mesh edp/examples/pin-in-hole/pin-in-hole.geo
DefineConstant[ hole = {10.05, Name "radius of the hole"} ];
DefineConstant[ pin = {10, Name "radius of the pin"} ];
DefineConstant[ half = {100, Name "half the plate's width and height"} ];
DefineConstant[ size = {0.5, Name "size of the elements in the hole"} ];
DefineConstant[ finer = {0.73, Name "size of the pin's elements over that"} ];

// the plate
Point(1) = {-half, -half, 0};
Point(2) = {half, -half, 0};
Point(3) = {half, half, 0};
Point(4) = {-half, half, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};

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
at = 10; radius = hole;
Call Ring;
at = 20; radius = pin;
Call Ring;
Plane Surface(1) = {1, 10};
Plane Surface(2) = {20};

Physical Curve("base") = {1};
Physical Curve("sides") = {2, 3, 4};
Physical Curve("bore") = {11 : 14};
Physical Curve("pin-surface") = {21 : 24};
Physical Surface("plate") = {1};
Physical Surface("pin") = {2};

// elements grow away from the circles; the pin's differ, so that no two meshes match
Field[1] = MathEval;
Field[1].F = Sprintf("(%g+%g*Tanh(1e3*(Sqrt(x*x+y*y)-%g)))*(1+0.15*Abs(Sqrt(x*x+y*y)-%g)/%g)",
    0.5 * size * (1 + finer), 0.5 * size * (1 - finer), 0.5 * (hole + pin), 0.5 * (hole + pin), size);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
