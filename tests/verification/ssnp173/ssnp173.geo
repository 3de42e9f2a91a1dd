// ssnp173.geo: a hollow sphere in another one that it touches, half a section above the equator; lengths in mm
Point(1) = {0, 0, 0};
Macro Shell
  Point(at + 1) = {inner, 0, 0};
  Point(at + 2) = {outer, 0, 0};
  Point(at + 3) = {0, outer, 0};
  Point(at + 4) = {0, inner, 0};
  Line(at + 1) = {at + 1, at + 2};
  Circle(at + 2) = {at + 2, 1, at + 3};
  Line(at + 3) = {at + 3, at + 4};
  Circle(at + 4) = {at + 4, 1, at + 1};
  Curve Loop(at) = {at + 1 : at + 4};
  Plane Surface(at) = {at};
  Transfinite Curve {at + 2, at + 4} = count + 1;
  Transfinite Curve {at + 1, at + 3} = 4;
Return
at = 10; inner = 20; outer = 30; count = 10;
Call Shell;
at = 20; inner = 30; outer = 40; count = 13;
Call Shell;
Physical Curve("cavity") = {14};
Physical Curve("outside") = {12};
Physical Curve("seat") = {24};
Physical Curve("equator") = {11, 21};
Physical Surface("core") = {10};
Physical Surface("shell") = {20};
