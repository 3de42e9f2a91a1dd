// pin.geo: a round pin with a rigid core, in the hole of a ring, for tests/campaigns/peers.py: all of it smooth
DefineConstant[ h = {0.4, Name "size of the elements in the hole"} ];
DefineConstant[ finer = {0.73, Name "size of the pin's elements over that"} ];
DefineConstant[ grading = {0.15, Name "growth: size over h is 1 + grading r/h, r: distance from the surfaces"} ];

// circles of four arcs each, about the origin
Point(5) = {0, 0, 0};
Macro Ring
  Point(at + 1) = {0, -radius, 0};
  Point(at + 2) = {radius, 0, 0};
  Point(at + 3) = {0, radius, 0};
  Point(at + 4) = {-radius, 0, 0};
  For k In {1 : 4}
    Circle(at + k) = {at + k, 5, at + (k % 4) + 1};
  EndFor
  Curve Loop(at) = {at + 1 : at + 4};
Return
at = 10; radius = 4; Call Ring;
at = 20; radius = 10; Call Ring;
at = 30; radius = 10.1; Call Ring;
at = 40; radius = 30; Call Ring;
Plane Surface(1) = {20, 10};
Plane Surface(2) = {40, 30};

Physical Curve("core") = {11 : 14};
Physical Curve("pin-surface") = {21 : 24};
Physical Curve("bore") = {31 : 34};
Physical Curve("frame") = {41 : 44};
Physical Surface("pin") = {1};
Physical Surface("ring") = {2};

Field[1] = MathEval;
Field[1].F = Sprintf("Min(2.5,Min(0.15*Sqrt(x*x+y*y),%g+%g*Tanh(1e3*(Sqrt(x*x+y*y)-10.05))+%g*Fabs(Sqrt(x*x+y*y)-10.05)))",
    0.5 * h * (1 + finer), 0.5 * h * (1 - finer), grading);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
