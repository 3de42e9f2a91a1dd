// vm191.geo: halves of two cylinders of radii 10 and 13 that touch at the origin, their right quarters; lengths in mm
Macro Quarter
  Point(at + 1) = {0, 0, 0};
  Point(at + 2) = {0, radius, 0};
  Point(at + 3) = {Abs(radius), radius, 0};
  Circle(at + 1) = {at + 1, at + 2, at + 3};
  Line(at + 2) = {at + 3, at + 2};
  Line(at + 3) = {at + 2, at + 1};
  Curve Loop(at) = {at + 1 : at + 3};
  Plane Surface(at) = {at};
Return
at = 10; radius = 10;
Call Quarter;
at = 20; radius = -13;
Call Quarter;
Physical Curve("upper-arc") = {11};
Physical Curve("upper-flat") = {12};
Physical Curve("lower-arc") = {21};
Physical Curve("lower-flat") = {22};
Physical Curve("middle") = {13, 23};
Physical Surface("upper") = {10};
Physical Surface("lower") = {20};
