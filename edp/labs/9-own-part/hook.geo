// hook.geo: an open hook over a round bar; lengths in mm. The bar touches the hook's inside at its top, the point (0, inner).
//   gmsh -2 edp/labs/9-own-part/hook.geo, or as it is: -mesh edp/labs/9-own-part/hook.geo
DefineConstant[ inner = {10, Name "radius of the hook's inside"} ];
DefineConstant[ thick = {6, Name "its thickness"} ];
DefineConstant[ bar = {8, Name "radius of the bar"} ];
DefineConstant[ size = {0.08, Name "size of the elements where they touch"} ];
DefineConstant[ finer = {0.7, Name "size of the bar's elements over that"} ];
outer = inner + thick;
drop = inner - bar;                       // the bar's middle above the hook's

// the hook: an arc from the grip, below the middle, over the right side and the top to the tip on the left
tip = 200 * Pi / 180;
Point(1) = {0, 0, 0};
Point(2) = {0, -outer, 0};
Point(3) = {0, -inner, 0};
Point(4) = {outer, 0, 0};
Point(5) = {inner, 0, 0};
Point(6) = {0, outer, 0};
Point(7) = {0, inner, 0};
Point(8) = {outer * Cos(tip), outer * Sin(tip), 0};
Point(9) = {inner * Cos(tip), inner * Sin(tip), 0};
Point(10) = {-outer, 0, 0};
Point(11) = {-inner, 0, 0};
Circle(1) = {2, 1, 4};
Circle(2) = {4, 1, 6};
Circle(3) = {6, 1, 10};
Circle(4) = {10, 1, 8};
Line(5) = {8, 9};
Circle(6) = {9, 1, 11};
Circle(7) = {11, 1, 7};
Circle(8) = {7, 1, 5};
Circle(9) = {5, 1, 3};
Line(10) = {3, 2};
Curve Loop(1) = {1 : 10};
Plane Surface(1) = {1};

// the bar, held in its middle
Point(20) = {0, drop, 0};
Macro Ring
  Point(at + 1) = {radius, drop, 0};
  Point(at + 2) = {0, drop + radius, 0};
  Point(at + 3) = {-radius, drop, 0};
  Point(at + 4) = {0, drop - radius, 0};
  For k In {1 : 4}
    Circle(at + k) = {at + k, 20, at + (k % 4) + 1};
  EndFor
  Curve Loop(at) = {at + 1 : at + 4};
Return
at = 30; radius = bar;
Call Ring;
at = 40; radius = bar / 3;
Call Ring;
Plane Surface(2) = {30, 40};

Physical Curve("hook-inside") = {7, 8};
Physical Curve("bar-top") = {31, 32};
Physical Curve("grip") = {10};
Physical Curve("core") = {41 : 44};
Physical Surface("hook") = {1};
Physical Surface("bar") = {2};

// elements grow away from where the bodies touch; the bar's, below, differ
Field[1] = MathEval;
Field[1].F = Sprintf("(%g+%g*Tanh(1e3*(Sqrt(x*x+(y-%g)*(y-%g))-%g)))*(1+2*Sqrt(x*x+(y-%g)*(y-%g)))",
    0.5 * size * (1 + finer), 0.5 * size * (1 - finer), drop, drop, bar, inner, inner);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = 1;
