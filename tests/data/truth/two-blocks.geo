For k In {0:1}
  Point(10 * k + 1) = {0, k, 0, 0.5};
  Point(10 * k + 2) = {1, k, 0, 0.5};
  Point(10 * k + 3) = {1, k + 1, 0, 0.5};
  Point(10 * k + 4) = {0, k + 1, 0, 0.5};
  For i In {1:4}
    Line(10 * k + i) = {10 * k + i, 10 * k + (i % 4) + 1};
  EndFor
  Curve Loop(k + 1) = {10 * k + 1, 10 * k + 2, 10 * k + 3, 10 * k + 4};
  Plane Surface(k + 1) = {k + 1};
EndFor
Physical Surface("soft") = {1};
Physical Surface("stiff") = {2};
Physical Curve("base") = {1};
Physical Curve("seat") = {3};
Physical Curve("under") = {11};
Physical Curve("top") = {13};
Physical Curve("sides") = {2, 4};
Physical Curve("sidesUp") = {12, 14};
