// two-discs.geo: two semi-discs, flat sides out, round sides facing each other across a gap; two bodies, never merged
// Lengths in units of the lower radius. The lower disc's highest point is at (0, 1), the upper one's lowest at (0, 1 + gap).
DefineConstant[
  radius  = {1,    Name "radius"},   // of the upper disc
  gap     = {0.01, Name "gap"},      // initial separation
  reach   = {0.2,  Name "reach"},    // contact is possible for |x| <= reach
  h       = {0.01, Name "h"},        // element size of the lower disc there
  ratio   = {1.37, Name "ratio"},    // element size of the upper disc there, over h
  grading = {20,   Name "grading"},  // size = h (1 + grading r), r: distance from the point between the discs, beyond reach
  corners = {1e-4, Name "corners"}    // element size at the ends of the flat sides, where stresses are singular; 0: that of the rest
];
Include "singular.geo";

yc = Sqrt(1 - reach * reach);
Point(1) = {0, 0, 0};
Point(2) = {-1, 0, 0};
Point(3) = {1, 0, 0};
Point(4) = {-reach, yc, 0};
Point(5) = {reach, yc, 0};
Point(6) = {0, 1, 0};
Line(1) = {2, 3};
Circle(2) = {3, 1, 5};
Circle(3) = {5, 1, 6};
Circle(4) = {6, 1, 4};
Circle(5) = {4, 1, 2};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Transfinite Curve {3, 4} = Ceil(reach / h - 1e-9) + 1;

top = 1 + gap + radius;
yd = top - Sqrt(radius * radius - 1.21 * reach * reach);
Point(11) = {0, top, 0};
Point(12) = {-radius, top, 0};
Point(13) = {radius, top, 0};
Point(14) = {-1.1 * reach, yd, 0};
Point(15) = {1.1 * reach, yd, 0};
Point(16) = {0, 1 + gap, 0};
Line(11) = {13, 12};
Circle(12) = {12, 11, 14};
Circle(13) = {14, 11, 16};
Circle(14) = {16, 11, 15};
Circle(15) = {15, 11, 13};
Curve Loop(11) = {11, 12, 13, 14, 15};
Plane Surface(11) = {11};
Transfinite Curve {13, 14} = Ceil(1.1 * reach / (ratio * h) - 1e-9) + 1;

Physical Curve("clamped", 1) = {1};
Physical Curve("contact", 2) = {3, 4};
Physical Curve("free", 3) = {2, 5};
Physical Curve("master", 4) = {13, 14};
Physical Curve("pushed", 5) = {11};
Physical Curve("upperFree", 6) = {12, 15};
Physical Surface("lower", 1) = {1};
Physical Surface("upper", 2) = {11};

beyond = Sprintf("(0.5*(Sqrt(x*x+(y-1)*(y-1))-%.12g+Fabs(Sqrt(x*x+(y-1)*(y-1))-%.12g)))", reach, reach);
Field[1] = MathEval;
Field[1].F = StrCat(Sprintf("%.12g*(1+%.12g*", h, grading), beyond, ")");
middle = 1 + 0.5 * gap;
Field[2] = MathEval;                    // at most a quarter of the disc's radius
Field[2].F = Sprintf("0.25*(1+(%.12g)*(0.5+0.5*(y-%.12g)/Fabs(y-%.12g)))", radius - 1, middle, middle);
If (corners > 0)
  For side In {-1 : 1 : 2}
    atX = side;
    atY = 0;
    Call Singular;
    atX = side * radius;
    atY = top;
    Call Singular;
  EndFor
EndIf
Field[100] = Min;
Field[100].FieldsList = {1, 2, singular[]};
Background Field = 100;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
