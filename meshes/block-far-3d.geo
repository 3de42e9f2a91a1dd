// block-far-3d.geo: a box with a square base; contact is possible far beyond where it is expected, on elements that grow there
// Lengths in units of the box's width. Origin in the middle of the bottom, so the top is z = depth.
// Below the middle of the top a regular grid of size h, its cells alike and split alike: nodal forces are smooth there.
DefineConstant[
  depth   = {0.5,   Name "depth"},    // height of the box
  patch   = {0.05,  Name "patch"},    // half the side of the square where contact is possible
  fine    = {0.015, Name "fine"},     // half the side of the square below which the grid lies
  h       = {0.001, Name "h"},        // element size there
  layers  = {4,     Name "layers"},   // of the grid below the square
  grading = {80,    Name "grading"}   // size = h (1 + grading r), r: distance from the grid
];

half = 0.5;
n = Ceil(fine / h - 1e-9);            // 2 n cells: a node in the middle
cell = fine / n;
low = depth - layers * cell;
// five squares: the box's bottom and top, where contact ends, the grid's bottom and top
For k In {0 : 4}
  s = (k < 2) ? half : ((k == 2) ? patch : fine);
  z = (k == 0) ? 0 : ((k == 3) ? low : depth);
  Point(4 * k + 1) = {-s, -s, z};
  Point(4 * k + 2) = { s, -s, z};
  Point(4 * k + 3) = { s,  s, z};
  Point(4 * k + 4) = {-s,  s, z};
  For i In {1 : 4}
    Line(4 * k + i) = {4 * k + i, 4 * k + i % 4 + 1};
  EndFor
  Curve Loop(k + 1) = {4 * k + 1 : 4 * k + 4};
EndFor
// uprights and sides: of the box, then of the grid
For j In {0 : 1}
  k = 3 * j;
  For i In {1 : 4}
    Line(30 + 4 * j + i) = {4 * k + i, 4 * k + 4 + i};
  EndFor
  For i In {1 : 4}
    Curve Loop(10 + 4 * j + i) = {4 * k + i, 30 + 4 * j + i % 4 + 1, -(4 * k + 4 + i), -(30 + 4 * j + i)};
    Plane Surface(10 + 4 * j + i) = {10 + 4 * j + i};
  EndFor
EndFor
Plane Surface(1) = {1};
Plane Surface(2) = {2, 3};
Plane Surface(3) = {3, 5};
Plane Surface(4) = {4};
Plane Surface(5) = {5};
Surface Loop(1) = {4, 5, 15 : 18};
Volume(1) = {1};
Surface Loop(2) = {1, 2, 3, 11 : 14, 4, 15 : 18};
Volume(2) = {2};

Transfinite Curve {13 : 20} = 2 * n + 1;
Transfinite Curve {35 : 38} = layers + 1;
Transfinite Surface {4, 5, 15, 16};
Transfinite Surface {17, 18} Right;       // split as the grid's cells are
Transfinite Volume {1};

Physical Surface("clamped", 1) = {1};
Physical Surface("contact", 2) = {3, 5};
Physical Surface("free", 3) = {2, 11 : 14};
Physical Volume("block", 1) = {1, 2};

// distance from the grid: beyond max(0, .) in each direction
outx = Sprintf("(0.5*(Fabs(x)-%.12g+Fabs(Fabs(x)-%.12g)))", fine, fine);
outy = Sprintf("(0.5*(Fabs(y)-%.12g+Fabs(Fabs(y)-%.12g)))", fine, fine);
outz = Sprintf("(0.5*(%.12g-z+Fabs(%.12g-z)))", low, low);
Field[1] = MathEval;
Field[1].F = StrCat(Sprintf("%.12g*(1+%.12g*Sqrt(", cell, grading), outx, "*", outx, "+", outy, "*", outy, "+", outz, "*", outz, "))");
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = 0.25 * ((depth < 1) ? depth : 1);
