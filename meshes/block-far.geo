// block-far.geo: a rectangular block; contact is possible far beyond where it is expected: elements grow along the contact line too
// Lengths in units of the block's width. Origin in the middle of the bottom edge, so the top is y = depth.
DefineConstant[
  depth   = {1,      Name "depth"},    // height of the block
  left    = {0,      Name "left"},     // contact is possible between these distances from the block's left side
  right   = {0.075,  Name "right"},
  fineLeft  = {0,     Name "fineLeft"},  // element size h between these
  fineRight = {0.015, Name "fineRight"},
  h       = {0.001,  Name "h"},
  grading = {100,    Name "grading"},  // size = h (1 + grading r), r: distance from the fine part of the contact line
  corners = {1e-5,   Name "corners"},  // element size at the clamped corners, where stresses are singular; 0: that of the rest
  axis    = {0,      Name "axis"}      // 1: the left side is an axis, its corner none
];
Include "singular.geo";

half = 0.5;
Point(1) = {-half, 0, 0};
Point(2) = { half, 0, 0};
Point(3) = { half, depth, 0};
Point(4) = {-half, depth, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {4, 1};
// along the top from the right: points where the contact begins, its fine part, and where they end
place[] = {right, fineRight, fineLeft, left};
part[] = {};      // lines: free, outer contact, fine contact, outer contact, free
number = 10;
last = 3;
contact[] = {};
free[] = {2};
top[] = {};
fine = 0;
For k In {0 : 4}
  x = -half;
  If (k < 4)
    x = place[k] - half;
  EndIf
  before = half;
  If (k > 0)
    before = place[k - 1] - half;
  EndIf
  If (before - x > 1e-9)
    next = 4;
    If (x > -half + 1e-9)
      next = 10 + k;
      Point(next) = {x, depth, 0};
    EndIf
    Line(20 + k) = {last, next};
    last = next;
    top[] += {20 + k};
    If (k == 0 || k == 4)
      free[] += {20 + k};
    EndIf
    If (k > 0 && k < 4)
      contact[] += {20 + k};
    EndIf
  EndIf
EndFor
Curve Loop(1) = {1, 2, top[], 3};
Plane Surface(1) = {1};
// equal elements on the fine part, an even number of them: a node in its middle
Transfinite Curve {22} = 2 * Ceil((fineRight - fineLeft) / (2 * h) - 1e-9) + 1;

Physical Curve("clamped", 1) = {1};
Physical Curve("contact", 2) = {contact[]};
Physical Curve("free", 3) = {free[]};
Physical Curve("left", 6) = {3};
Physical Surface("block", 1) = {1};

middle = 0.5 * (fineLeft + fineRight) - half;
reach = 0.5 * (fineRight - fineLeft);
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
EndIf
Field[100] = Min;
Field[100].FieldsList = {1, singular[]};
Background Field = 100;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = 0.25 * ((depth < 1) ? depth : 1);
