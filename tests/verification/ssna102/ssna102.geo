// ssna102.geo: a disc, two balls and a plate one above the other, half a section; lengths in mm
Macro Ball
  Point(at + 1) = {0, below, 0};
  Point(at + 2) = {0, below + radius, 0};
  Point(at + 3) = {radius, below + radius, 0};
  Point(at + 4) = {0, below + 2 * radius, 0};
  Circle(at + 1) = {at + 1, at + 2, at + 3};
  Circle(at + 2) = {at + 3, at + 2, at + 4};
  Line(at + 3) = {at + 4, at + 1};
  Curve Loop(at) = {at + 1 : at + 3};
  Plane Surface(at) = {at};
Return
Macro Disc
  Point(at + 1) = {0, below, 0};
  Point(at + 2) = {radius, below, 0};
  Point(at + 3) = {radius, below + height, 0};
  Point(at + 4) = {0, below + height, 0};
  For k In {1 : 4}
    Line(at + k) = {at + k, at + (k % 4) + 1};
  EndFor
  Curve Loop(at) = {at + 1 : at + 4};
  Plane Surface(at) = {at};
Return
at = 40; below = -4; radius = 20; height = 4;
Call Disc;
at = 30; below = 0; radius = 10;
Call Ball;
at = 20; below = 20; radius = 5;
Call Ball;
at = 10; below = 30; radius = 10; height = 2;
Call Disc;
Physical Curve("disc-face") = {11};
Physical Curve("disc-top") = {13};
Physical Curve("small-top") = {22};
Physical Curve("small-bottom") = {21};
Physical Curve("large-top") = {32};
Physical Curve("large-bottom") = {31};
Physical Curve("plate-top") = {43};
Physical Curve("plate-edge") = {42};
Physical Surface("disc") = {10};
Physical Surface("small") = {20};
Physical Surface("large") = {30};
Physical Surface("plate") = {40};
