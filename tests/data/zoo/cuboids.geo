DefineConstant[ brick = {0, Name "1: bricks"} ];
Macro Cuboid
  Point(at + 1) = {from, from, low}; Point(at + 2) = {to, from, low};
  Point(at + 3) = {to, to, low}; Point(at + 4) = {from, to, low};
  For k In {1 : 4}
    Line(at + k) = {at + k, at + k % 4 + 1};
  EndFor
  Curve Loop(at + 1) = {at + 1 : at + 4}; Plane Surface(at + 1) = {at + 1};
  Transfinite Curve{at + 1 : at + 4} = parts + 1; Transfinite Surface{at + 1};
  If (brick)
    Recombine Surface{at + 1};
    out() = Extrude{0, 0, high}{ Surface{at + 1}; Layers{2}; Recombine; };
  Else
    out() = Extrude{0, 0, high}{ Surface{at + 1}; Layers{2}; };
  EndIf
Return
at = 0; from = 0; to = 4; low = 0; high = 2; parts = 4;
Call Cuboid;
Physical Volume("lower") = {out(1)}; Physical Surface("top") = {out(0)}; Physical Surface("base") = {1};
at = 100; from = 1; to = 3; low = 2.01; high = 1; parts = 3;
Call Cuboid;
Physical Volume("upper") = {out(1)}; Physical Surface("grip") = {out(0)}; Physical Surface("foot") = {101};
