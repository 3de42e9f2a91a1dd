// roller.geo: a roller between two plates that are pressed together; lengths in mm
DefineConstant[ radius = {10, Name "the roller's radius"} ];
DefineConstant[ width = {60, Name "the plates' width"} ];
DefineConstant[ height = {30, Name "a plate's height"} ];
DefineConstant[ size = {0.06, Name "size of the elements in the contacts"} ];

// the roller, about the origin: one arc a quarter
Point(1) = {0, 0, 0};
Point(2) = {radius, 0, 0};
Point(3) = {0, radius, 0};
Point(4) = {-radius, 0, 0};
Point(5) = {0, -radius, 0};
For k In {1 : 4}
  Circle(k) = {k + 1, 1, (k % 4) + 2};
EndFor
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};

// a plate above (way = 1) and one below (way = -1), touching it
Macro Plate
  Point(at + 1) = {-width / 2, way * radius, 0};
  Point(at + 2) = {width / 2, way * radius, 0};
  Point(at + 3) = {width / 2, way * (radius + height), 0};
  Point(at + 4) = {-width / 2, way * (radius + height), 0};
  For k In {1 : 4}
    Line(at + k) = {at + k, at + (k % 4) + 1};
  EndFor
  Curve Loop(at) = {at + 1 : at + 4};
  Plane Surface(at) = {at};
Return
at = 10; way = 1;
Call Plate;
at = 20; way = -1;
Call Plate;

Physical Curve("roller-top") = {1, 2};
Physical Curve("roller-bottom") = {3, 4};
Physical Curve("upper-face") = {11};
Physical Curve("lower-face") = {21};
Physical Curve("grip") = {13};
Physical Curve("base") = {23};
Physical Surface("roller") = {1};
Physical Surface("upper") = {10};
Physical Surface("lower") = {20};

// elements grow away from the two places of contact; the plates' are finer, so that no two meshes match
Field[1] = MathEval;
Field[1].F = Sprintf("%g*(0.865+0.135*Tanh(1e3*(%g-Abs(y))))*(1+0.15*Sqrt(x*x+(Abs(y)-%g)^2)/%g)", size, radius, radius, size);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
