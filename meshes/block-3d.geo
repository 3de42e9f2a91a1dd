// block-3d.geo: a box with a square base; below the square of its top that can touch a regular grid of size h, growing away
// Lengths in units of the box's width. Origin in the middle of the bottom, so the top is z = depth.
// The grid's cells are alike, split alike: nodal forces are smooth there, as they are not on an irregular mesh.
// Of a half, x >= 0, or a quarter, x, y >= 0, the sides x = 0 and y = 0 are mirrors, and sides of the grid too.
DefineConstant[
  depth   = {0.5,   Name "depth"},    // height of the box
  patch   = {0.05,  Name "patch"},    // half the side of the square where contact is possible
  h       = {0.01,  Name "h"},        // element size there
  layers  = {4,     Name "layers"},   // of the grid below the square
  mirrors = {0,     Name "mirrors"},  // 0: the whole, 1: a half, 2: a quarter
  grading = {80,    Name "grading"},  // size = h (1 + grading r), r: distance from the grid
  edges   = {0,     Name "edges"}     // element size at the clamped edges, where it grows by 1.2 times the distance; 0: as around them
];

half = 0.5;
n = Ceil(patch / h - 1e-9);           // 2 n cells: a node in the middle
cell = patch / n;
low = depth - layers * cell;
// four rectangles, from below: the box's bottom and top, the grid's bottom and top
For k In {0 : 3}
  s = (k < 2) ? half : patch;
  z = (k == 0) ? 0 : ((k == 2) ? low : depth);
  x0 = (mirrors > 0) ? 0 : -s;
  y0 = (mirrors > 1) ? 0 : -s;
  Point(4 * k + 1) = {x0, y0, z};
  Point(4 * k + 2) = { s, y0, z};
  Point(4 * k + 3) = { s,  s, z};
  Point(4 * k + 4) = {x0,  s, z};
EndFor
// their edges; those of the box's top that hold an edge of the grid, in parts
For k In {0 : 3}
  For i In {1 : 4}
    If (k != 1 || (mirrors < 2 || i != 1) && (mirrors < 1 || i != 4))
      Line(4 * k + i) = {4 * k + i, 4 * k + i % 4 + 1};
    EndIf
  EndFor
EndFor
If (mirrors > 0)
  Line(41) = {8, 16};
  If (mirrors == 1)
    Line(42) = {13, 5};
  EndIf
EndIf
If (mirrors == 2)
  Line(43) = {14, 6};
EndIf
// uprights: of the box 21 to 24, of the grid 29 to 32
For i In {1 : 4}
  If (i == 1 && mirrors == 2)
    Line(21) = {1, 9};
  Else
    Line(20 + i) = {i, 4 + i};
  EndIf
  Line(28 + i) = {8 + i, 12 + i};
EndFor
For k In {0 : 3}
  If (k != 1)
    Curve Loop(k + 1) = {4 * k + 1 : 4 * k + 4};
    Plane Surface(k + 1) = {k + 1};
  EndIf
EndFor
// the grid's sides 15 to 18, the box's 11 to 14, its top 2
For i In {1 : 4}
  Curve Loop(14 + i) = {8 + i, 28 + i % 4 + 1, -(12 + i), -(28 + i)};
  Plane Surface(14 + i) = {14 + i};
EndFor
If (mirrors == 2)
  Curve Loop(11) = {1, 22, -43, -30, -9, -21};
  Curve Loop(14) = {4, 21, -12, 32, -41, -24};
  Curve Loop(2) = {43, 6, 7, 41, -15, -14};
  inner[] = {3, 16, 17};
ElseIf (mirrors == 1)
  Curve Loop(11) = {1, 22, -5, -21};
  Curve Loop(14) = {4, 21, -42, -29, -12, 32, -41, -24};
  Curve Loop(2) = {5, 6, 7, 41, -15, -14, -13, 42};
  inner[] = {3, 15, 16, 17};
Else
  Curve Loop(11) = {1, 22, -5, -21};
  Curve Loop(14) = {4, 21, -8, -24};
  Curve Loop(20) = {5 : 8};
  inner[] = {3, 15 : 18};
EndIf
Curve Loop(12) = {2, 23, -6, -22};
Curve Loop(13) = {3, 24, -7, -23};
For i In {11 : 14}
  Plane Surface(i) = {i};
EndFor
If (mirrors == 0)
  Plane Surface(2) = {20, 4};
Else
  Plane Surface(2) = {2};
EndIf
Surface Loop(1) = {3, 4, 15 : 18};
Volume(1) = {1};
Surface Loop(2) = {1, 2, 11 : 14, inner[]};
Volume(2) = {2};

acrossX = (mirrors > 0) ? n : 2 * n;
acrossY = (mirrors > 1) ? n : 2 * n;
Transfinite Curve {9, 11, 13, 15} = acrossX + 1;
Transfinite Curve {10, 12, 14, 16} = acrossY + 1;
Transfinite Curve {29 : 32} = layers + 1;
Transfinite Surface {3, 4, 15, 16};
Transfinite Surface {17, 18} Right;       // split as the grid's cells are
Transfinite Volume {1};

Physical Surface("clamped", 1) = {1};
Physical Surface("contact", 2) = {4};
Physical Surface("free", 3) = {2, 12, 13};
If (mirrors > 0)
  Physical Surface("mirrorX", 4) = {14, 18};
Else
  Physical Surface("free") += {14};
EndIf
If (mirrors > 1)
  Physical Surface("mirrorY", 5) = {11, 15};
Else
  Physical Surface("free") += {11};
EndIf
Physical Volume("block", 1) = {1, 2};

// distance from the grid: beyond max(0, .) in each direction
outx = Sprintf("(0.5*(Fabs(x)-%.12g+Fabs(Fabs(x)-%.12g)))", patch, patch);
outy = Sprintf("(0.5*(Fabs(y)-%.12g+Fabs(Fabs(y)-%.12g)))", patch, patch);
outz = Sprintf("(0.5*(%.12g-z+Fabs(%.12g-z)))", low, low);
Field[1] = MathEval;
Field[1].F = StrCat(Sprintf("%.12g*(1+%.12g*Sqrt(", cell, grading), outx, "*", outx, "+", outy, "*", outy, "+", outz, "*", outz, "))");
If (edges > 0)
  Field[2] = MathEval;
  Field[2].F = Sprintf("%.12g+1.2*Sqrt((Fabs(x)-0.5)*(Fabs(x)-0.5)+z*z)", edges);
  Field[3] = MathEval;
  Field[3].F = Sprintf("%.12g+1.2*Sqrt((Fabs(y)-0.5)*(Fabs(y)-0.5)+z*z)", edges);
  Field[4] = Min;
  Field[4].FieldsList = {1, 2, 3};
EndIf
Background Field = (edges > 0) ? 4 : 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = 0.25 * ((depth < 1) ? depth : 1);
