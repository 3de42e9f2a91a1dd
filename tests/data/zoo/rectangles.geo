DefineConstant[ brick = {0, Name "1: quadrangles"} ];
Macro Flat
  Point(at + 1) = {from, low, 0}; Point(at + 2) = {to, low, 0};
  Point(at + 3) = {to, low + high, 0}; Point(at + 4) = {from, low + high, 0};
  For k In {1 : 4}
    Line(at + k) = {at + k, at + k % 4 + 1};
  EndFor
  Curve Loop(at + 1) = {at + 1 : at + 4}; Plane Surface(at + 1) = {at + 1};
  Transfinite Curve{at + 1 : at + 4} = parts + 1; Transfinite Surface{at + 1};
  If (brick)
    Recombine Surface{at + 1};
  EndIf
Return
at = 0; from = 0; to = 4; low = 0; high = 2; parts = 4;
Call Flat;
Physical Surface("lower") = {1}; Physical Curve("top") = {3}; Physical Curve("base") = {1};
at = 100; from = 1; to = 3; low = 2.01; high = 1; parts = 3;
Call Flat;
Physical Surface("upper") = {101}; Physical Curve("grip") = {103}; Physical Curve("foot") = {101};
