// quarter-spheres.geo: a quarter (x, y >= 0) of two half-balls, flat sides out, poles facing each other across a gap; never merged
// Lengths in units of the lower radius. The lower ball's pole is at (0, 0, 1), the upper one's at (0, 0, 1 + gap).
// Below each pole a regular grid between two concentric spheres and planes through the centre: its cells are alike, split
// alike: nodal forces are smooth there, as they are not on an irregular mesh.
DefineConstant[
  radius  = {1,    Name "radius"},   // of the upper ball; 0: no upper ball
  gap     = {0.01, Name "gap"},      // initial separation
  patch   = {0.15, Name "patch"},    // contact is possible for x, y <= patch
  h       = {0.01, Name "h"},        // element size of the lower ball there
  layers  = {4,    Name "layers"},   // of the grid below the pole
  ratio   = {1.37, Name "ratio"},    // element size of the upper ball there, over h
  grading = {20,   Name "grading"}   // size = h (1 + grading r), r: distance from the grid
];

// k = 0: lower, 1: upper, a little wider: the lower one's points all find it above them
balls = (radius > 0) ? 2 : 1;
For k In {0 : balls - 1}
  R = (k == 0) ? 1 : radius;
  up = 1 - 2 * k;
  zc = (k == 0) ? 0 : 1 + gap + radius;
  wide = (k == 0) ? patch : 1.15 * patch;
  size = (k == 0) ? h : ratio * h;
  n = Ceil(wide / size - 1e-9);
  p = 20 * k;
  Point(p + 1) = {0, 0, zc};
  Point(p + 2) = {R, 0, zc};
  Point(p + 3) = {R / Sqrt(2), R / Sqrt(2), zc};
  Point(p + 4) = {0, R, zc};
  // the grid's corners: on y = 0, on the diagonal, on x = 0, at the pole; below (level 0), then above: a grid's sides must be split alike
  For level In {0 : 1}
    s = (level == k) ? 1 - layers * size / R : 1;
    Point(p + 5 + 4 * level) = {s * wide, 0, zc + up * s * Sqrt(R * R - wide * wide)};
    Point(p + 6 + 4 * level) = {s * wide, s * wide, zc + up * s * Sqrt(R * R - 2 * wide * wide)};
    Point(p + 7 + 4 * level) = {0, s * wide, zc + up * s * Sqrt(R * R - wide * wide)};
    Point(p + 8 + 4 * level) = {0, 0, zc + up * s * R};
    For i In {0 : 3}
      Circle(p + 1 + 4 * level + i) = {p + 5 + 4 * level + i, p + 1, p + 5 + 4 * level + (i + 1) % 4};
    EndFor
    Curve Loop(p + 1 + level) = {p + 1 + 4 * level : p + 4 + 4 * level};
    Surface(p + 1 + level) = {p + 1 + level} In Sphere {p + 1};
  EndFor
  For i In {0 : 3}
    Line(p + 9 + i) = {p + 5 + i, p + 9 + i};
  EndFor
  For i In {0 : 3}
    Curve Loop(p + 3 + i) = {p + 1 + i, p + 9 + (i + 1) % 4, -(p + 5 + i), -(p + 9 + i)};
    Plane Surface(p + 3 + i) = {p + 3 + i};
  EndFor
  Surface Loop(p + 1) = {p + 1 : p + 6};
  Volume(p + 1) = {p + 1};
  Transfinite Curve {p + 1 : p + 8} = n + 1;
  Transfinite Curve {p + 9 : p + 12} = layers + 1;
  Transfinite Surface {p + 1 : p + 4};
  Transfinite Surface {p + 5, p + 6} Right;       // split as the grid's cells are
  Transfinite Volume {p + 1};

  // the rest of the ball: outer and inner curves and corners of the grid
  out = p + 4 * (1 - k);
  in = p + 4 * k;
  Line(p + 13) = {p + 1, p + 2};
  Line(p + 14) = {p + 4, p + 1};
  Circle(p + 15) = {p + 2, p + 1, p + 3};
  Circle(p + 16) = {p + 3, p + 1, p + 4};
  Circle(p + 17) = {p + 2, p + 1, out + 5};
  Circle(p + 18) = {p + 3, p + 1, out + 6};
  Circle(p + 19) = {p + 4, p + 1, out + 7};
  Line(p + 20) = {p + 1, in + 8};
  Curve Loop(p + 7) = {p + 13, p + 15, p + 16, p + 14};
  Plane Surface(p + 7) = {p + 7};                                       // flat side
  Curve Loop(p + 8) = {p + 13, p + 17, -up * (p + 9), -(in + 4), -(p + 20)};
  Plane Surface(p + 8) = {p + 8};                                       // y = 0
  Curve Loop(p + 9) = {-(p + 14), p + 19, -up * (p + 11), in + 3, -(p + 20)};
  Plane Surface(p + 9) = {p + 9};                                       // x = 0
  Curve Loop(p + 10) = {p + 15, p + 18, -(out + 1), -(p + 17)};
  Surface(p + 10) = {p + 10} In Sphere {p + 1};
  Curve Loop(p + 11) = {p + 16, p + 19, -(out + 2), -(p + 18)};
  Surface(p + 11) = {p + 11} In Sphere {p + 1};
  Surface Loop(p + 2) = {p + 1 + k, p + 3, p + 4, p + 7 : p + 11};
  Volume(p + 2) = {p + 2};
EndFor

Physical Surface("clamped", 1) = {7};
Physical Surface("contact", 2) = {2};
Physical Surface("free", 3) = {10, 11};
Physical Surface("mirrorX", 4) = {5, 9};
Physical Surface("mirrorY", 5) = {6, 8};
Physical Volume("lower", 1) = {1, 2};
If (balls == 2)
  Physical Surface("pushed", 6) = {27};
  Physical Surface("master", 7) = {21};
  Physical Surface("upperFree", 8) = {30, 31};
  Physical Surface("mirrorX") += {25, 29};
  Physical Surface("mirrorY") += {26, 28};
  Physical Volume("upper", 2) = {21, 22};
EndIf

// the distance from the grids, each read in its body's own half of space: beyond max(0, .) in each direction
middle = 1 + 0.5 * gap;
deep = layers * h + patch * patch;
outx = Sprintf("(0.5*(x-%.12g+Fabs(x-%.12g)))", patch, patch);
outy = Sprintf("(0.5*(y-%.12g+Fabs(y-%.12g)))", patch, patch);
outz = Sprintf("(0.5*(Fabs(z-%.12g)-%.12g+Fabs(Fabs(z-%.12g)-%.12g)))", middle, deep, middle, deep);
side = Sprintf("(0.5+0.5*(z-%.12g)/Fabs(z-%.12g))", middle, middle);          // 0 in the lower ball, 1 in the upper one
Field[1] = MathEval;
Field[1].F = StrCat(Sprintf("%.12g*(1+%.12g*Sqrt(", h, grading), outx, "*", outx, "+", outy, "*", outy, "+", outz, "*", outz,
                    Sprintf("))*(1+(%.12g)*", ratio - 1), side, ")");
Field[2] = MathEval;
Field[2].F = StrCat(Sprintf("0.3*(1+(%.12g)*", balls == 2 ? radius - 1 : 0), side, ")");
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
