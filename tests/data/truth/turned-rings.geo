// a sector of two rings, from 17 to 65 degrees; second order
For k In {0:1}
  a = 1 + k; b = 2 + k; o = 10 * k; s = 17 * Pi / 180; e = 65 * Pi / 180;
  Point(o + 1) = {a * Cos(s), a * Sin(s), 0, 0.3}; Point(o + 2) = {b * Cos(s), b * Sin(s), 0, 0.3};
  Point(o + 3) = {b * Cos(e), b * Sin(e), 0, 0.3}; Point(o + 4) = {a * Cos(e), a * Sin(e), 0, 0.3}; Point(o + 5) = {0, 0, 0};
  Line(o + 1) = {o + 1, o + 2}; Circle(o + 2) = {o + 2, o + 5, o + 3};
  Line(o + 3) = {o + 3, o + 4}; Circle(o + 4) = {o + 4, o + 5, o + 1};
  Curve Loop(k + 1) = {o + 1:o + 4}; Plane Surface(k + 1) = {k + 1};
EndFor
Physical Surface("hub") = {1}; Physical Surface("ring") = {2};
Physical Curve("shaft") = {2}; Physical Curve("bore") = {14};
Mesh.ElementOrder = 2;
