For k In {0 : 1}
  inner = k ? 4 : 1;
  outer = k ? 6 : 4;
  Point(4 * k + 1) = {inner, k, 0, 0.8}; Point(4 * k + 2) = {outer, k, 0, 0.8};
  Point(4 * k + 3) = {outer, 6 - k, 0, 0.6}; Point(4 * k + 4) = {inner, 6 - k, 0, 0.6};
  For l In {1 : 4}
    Line(4 * k + l) = {4 * k + l, 4 * k + l % 4 + 1};
  EndFor
  Curve Loop(k + 1) = {4 * k + 1 : 4 * k + 4};
  Plane Surface(k + 1) = {k + 1};
EndFor
Physical Surface("shaft") = {1}; Physical Surface("hub") = {2}; Physical Curve("foot") = {1};
Physical Curve("seat") = {2}; Physical Curve("hole") = {8}; Physical Curve("rim") = {6};
