// block-3d.geo: a box with a square base; element size h on the disc of its top that can touch, growing away from it
// Lengths in units of the box's width. Origin in the middle of the bottom, so the top is z = depth.
DefineConstant[
  depth   = {0.5,   Name "depth"},    // height of the box
  patch   = {0.05,  Name "patch"},    // radius of the disc where contact is possible
  h       = {0.01,  Name "h"},        // element size there
  grading = {80,    Name "grading"}   // size = h (1 + grading r), r: distance from the disc
];

half = 0.5;
Point(1) = {-half, -half, 0};
Point(2) = { half, -half, 0};
Point(3) = { half,  half, 0};
Point(4) = {-half,  half, 0};
Point(5) = {-half, -half, depth};
Point(6) = { half, -half, depth};
Point(7) = { half,  half, depth};
Point(8) = {-half,  half, depth};
Point(9) = {0, 0, depth};
Point(10) = {patch, 0, depth};
Point(11) = {0, patch, depth};
Point(12) = {-patch, 0, depth};
Point(13) = {0, -patch, depth};
For i In {1 : 4}
  next = i % 4 + 1;
  Line(i) = {i, next};
  Line(4 + i) = {4 + i, 4 + next};
  Line(8 + i) = {i, 4 + i};
  Circle(12 + i) = {9 + i, 9, 9 + next};
EndFor
Curve Loop(1) = {-4, -3, -2, -1};
Plane Surface(1) = {1};
Curve Loop(2) = {13, 14, 15, 16};
Plane Surface(2) = {2};
Curve Loop(3) = {5, 6, 7, 8};
Plane Surface(3) = {3, 2};
For i In {1 : 4}
  Curve Loop(3 + i) = {i, 8 + i % 4 + 1, -(4 + i), -(8 + i)};
  Plane Surface(3 + i) = {3 + i};
EndFor
Surface Loop(1) = {1 : 7};
Volume(1) = {1};
Point{9} In Surface{2};      // a node in the middle

Physical Surface("clamped", 1) = {1};
Physical Surface("contact", 2) = {2};
Physical Surface("free", 3) = {3 : 7};
Physical Volume("block", 1) = {1};

beyond = Sprintf("(0.5*(Sqrt(x*x+y*y)-%.12g+Fabs(Sqrt(x*x+y*y)-%.12g)))", patch, patch);
Field[1] = MathEval;
Field[1].F = StrCat(Sprintf("%.12g*(1+%.12g*Sqrt((%.12g-z)*(%.12g-z)+", h, grading, depth, depth), beyond, "*", beyond, "))");
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = 0.25 * ((depth < 1) ? depth : 1);
