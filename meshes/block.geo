// block.geo: a rectangular block; element size h on the part of its top that can touch, growing away from it
// Lengths in units of the block's width. Origin in the middle of the bottom edge, so the top is y = depth.
DefineConstant[
  depth   = {0.5,    Name "depth"},    // height of the block
  left    = {0.2525, Name "left"},     // contact is possible between these distances from the block's left side
  right   = {0.7475, Name "right"},
  h       = {0.0125, Name "h"},        // element size there
  grading = {20,     Name "grading"},  // size = h (1 + grading r), r: distance from the contact line
  corners = {1e-4,   Name "corners"},   // element size at the clamped corners, where stresses are singular; 0: that of the rest
  axis    = {0,      Name "axis"},     // 1: the left side is an axis, its corner none
  sharp   = {0,      Name "sharp"},    // 1: the ends of the contact line are singular too
  ends    = {0,      Name "ends"}      // 0, or the places of the line at this distance from its middle (or the axis) are
];
Include "singular.geo";

half = 0.5;
a = left - half;
b = right - half;
Point(1) = {-half, 0, 0};
Point(2) = { half, 0, 0};
Point(3) = { half, depth, 0};
Point(4) = {-half, depth, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(6) = {4, 1};
sides[] = {2};
top[] = {};
from = 3;
to = 4;
If (b < half - 1e-9)
  Point(5) = {b, depth, 0};
  Line(3) = {3, 5};
  from = 5;
  sides[] += {3};
  top[] += {3};
EndIf
If (a > -half + 1e-9)
  Point(6) = {a, depth, 0};
  to = 6;
EndIf
graded = (sharp || ends > 0) && corners > 0;
contact[] = {4};
If (graded && !axis)
  // two halves, each from its end: mirror images
  Point(7) = {0.5 * (a + b), depth, 0};
  Line(4) = {from, 7};
  Line(7) = {to, 7};
  contact[] += {-7};
Else
  Line(4) = {from, to};
EndIf
top[] += {contact[]};
If (a > -half + 1e-9)
  Line(5) = {6, 4};
  sides[] += {5};
  top[] += {5};
EndIf
Curve Loop(1) = {1, 2, top[], 6};
Plane Surface(1) = {1};
// equal elements on the contact line, an even number of them: a node in its middle
If (!graded)
  Transfinite Curve {4} = 2 * Ceil((b - a) / (2 * h) - 1e-9) + 1;
EndIf

Physical Curve("clamped", 1) = {1};
Physical Curve("contact", 2) = {contact[]};
Physical Curve("free", 3) = {sides[]};
Physical Curve("left", 6) = {6};
Physical Surface("block", 1) = {1};

middle = 0.5 * (a + b);
reach = 0.5 * (b - a);
beyond = Sprintf("(0.5*(Fabs(x-(%.12g))-%.12g+Fabs(Fabs(x-(%.12g))-%.12g)))", middle, reach, middle, reach);
Field[1] = MathEval;
Field[1].F = StrCat(Sprintf("%.12g*(1+%.12g*Sqrt((%.12g-y)*(%.12g-y)+", h, grading, depth, depth), beyond, "*", beyond, "))");
If (corners > 0)
  atY = 0;
  atX = half;
  Call Singular;
  If (!axis)
    atX = -half;
    Call Singular;
  EndIf
  atY = depth;
  slope = 0.6;                           // pressures are asked for there
  If (sharp)
    atX = b;
    Call Singular;
    If (!axis)
      atX = a;
      Call Singular;
    EndIf
  EndIf
  If (ends > 0)
    atX = (axis ? a : 0.5 * (a + b)) + ends;
    Call Singular;
    If (!axis)
      atX = 0.5 * (a + b) - ends;
      Call Singular;
    EndIf
  EndIf
EndIf
Field[100] = Min;
Field[100].FieldsList = {1, singular[]};
Background Field = 100;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = 0.25 * ((depth < 1) ? depth : 1);
