// block.geo: a rectangular block; element size h on the part of its top that can touch, growing away from it
// Lengths in units of the block's width. Origin in the middle of the bottom edge, so the top is y = depth.
DefineConstant[
  depth   = {0.5,    Name "depth"},    // height of the block
  reach   = {0.2475, Name "reach"},    // contact is possible for |x| <= reach
  h       = {0.0125, Name "h"},        // element size there
  grading = {40,     Name "grading"}   // size = h (1 + grading r), r: distance from the contact line
];

half = 0.5;
c = (reach < half) ? reach : half;
Point(1) = {-half, 0, 0};
Point(2) = { half, 0, 0};
Point(3) = { half, depth, 0};
Point(4) = {-half, depth, 0};
Line(1) = {1, 2};
If (c < half)
  Point(5) = { c, depth, 0};
  Point(6) = {-c, depth, 0};
  Line(2) = {2, 3};
  Line(3) = {3, 5};
  Line(4) = {5, 6};
  Line(5) = {6, 4};
  Line(6) = {4, 1};
  Curve Loop(1) = {1 : 6};
  Physical Curve("free", 3) = {2, 3, 5, 6};
Else
  Line(2) = {2, 3};
  Line(4) = {3, 4};
  Line(6) = {4, 1};
  Curve Loop(1) = {1, 2, 4, 6};
  Physical Curve("free", 3) = {2, 6};
EndIf
Plane Surface(1) = {1};
// equal elements on the contact line, an even number of them: a node at x = 0
Transfinite Curve {4} = 2 * Ceil(c / h - 1e-9) + 1;

Physical Curve("clamped", 1) = {1};
Physical Curve("contact", 2) = {4};
Physical Surface("block", 1) = {1};

beyond = Sprintf("(0.5*(Fabs(x)-%.12g+Fabs(Fabs(x)-%.12g)))", c, c);
Field[1] = MathEval;
Field[1].F = StrCat(Sprintf("%.12g*(1+%.12g*Sqrt((%.12g-y)*(%.12g-y)+", h, grading, depth, depth), beyond, "*", beyond, "))");
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = 0.25 * ((depth < 1) ? depth : 1);
