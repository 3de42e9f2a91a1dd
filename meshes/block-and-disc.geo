// block-and-disc.geo: the block of block.geo and, as a second body never merged with it, a semi-disc above it
// Lengths in units of the block's width; the disc's lowest point is at (0, depth + gap), its flat top up.
Include "block.geo";
DefineConstant[
  radius = {0.25,   Name "radius"},  // of the disc
  gap    = {0.0125, Name "gap"}      // initial separation
];
Point(11) = {0, depth + gap + radius, 0};
Point(12) = {-radius, depth + gap + radius, 0};
Point(13) = {0, depth + gap, 0};
Point(14) = {radius, depth + gap + radius, 0};
Circle(11) = {12, 11, 13};
Circle(12) = {13, 11, 14};
Line(13) = {14, 12};
Curve Loop(11) = {11, 12, 13};
Plane Surface(11) = {11};
Physical Curve("master", 4) = {11, 12};
Physical Curve("pushed", 5) = {13};
Physical Surface("disc", 2) = {11};
If (corners > 0)
  atY = depth + gap + radius;
  For side In {-1 : 1 : 2}
    atX = side * radius;
    Call Singular;
  EndFor
EndIf
Field[100].FieldsList = {1, singular[]};
// the disc's elements grow from its lowest point's neighbourhood as the block's do from the contact line
