// block-rim-3d.geo: a box with a square base; contact within a circle of its top, elements shrink towards the rim of contact
// Lengths in units of the box's width. Origin in the middle of the bottom, so the top is z = depth.
// Around the rim lies a ring, a section turned about the middle: its elements are thin across the rim, and long along it.
// Of a half, x >= 0, or a quarter, x, y >= 0, the sides x = 0 and y = 0 are mirrors.
DefineConstant[
  depth   = {0.5,   Name "depth"},    // height of the box
  patch   = {0.17,  Name "patch"},    // radius of the circle where contact is possible
  h       = {0.04,  Name "h"},        // element size there
  ends    = {0.12,  Name "ends"},     // radius of the rim of contact: a fifth of h across it, growing by 0.4 times the distance
  mirrors = {2,     Name "mirrors"},  // 0: the whole, 1: a half, 2: a quarter
  grading = {20,    Name "grading"},  // size = h (1 + grading r), r: distance from the circle
  edges   = {0,     Name "edges"}     // element size at the clamped edges, where it grows by 1.2 times the distance; 0: as around them
];

half = 0.5;
turns = (mirrors == 2) ? 1 : ((mirrors == 1) ? 2 : 4);
n = Ceil(0.5 * Pi * ends / h - 1e-9);
n = (n < 3) ? 3 : n;                  // of a quarter of the ring
inner = 0.6 * ends;
low = depth - 0.4 * ends;
// the ring's section, where it begins: y = 0, of a half x = 0, y < 0
alongX = (mirrors == 1) ? 0 : 1;
alongY = (mirrors == 1) ? -1 : 0;
Point(1) = {0, 0, depth};
Point(2) = {alongX * inner, alongY * inner, depth};
Point(3) = {alongX * ends, alongY * ends, depth};
Point(4) = {alongX * patch, alongY * patch, depth};
Point(5) = {alongX * patch, alongY * patch, low};
Point(6) = {alongX * inner, alongY * inner, low};
Line(1) = {2, 3};
Line(2) = {3, 4};
Line(3) = {4, 5};
Line(4) = {5, 6};
Line(5) = {6, 2};
Curve Loop(1) = {1 : 5};
Plane Surface(1) = {1};
section = 1;
ring[] = {};
contact[] = {};
shell[] = {};      // the ring's faces towards the rest
inside[] = {};     // arcs of the top
outside[] = {};
For k In {1 : turns}
  new[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Surface{section}; Layers{n}; };
  section = new[0];
  ring[] += {new[1]};
  contact[] += {new[2], new[3]};
  shell[] += {new[4], new[5], new[6]};
  arcs[] = Boundary { Surface{new[2]}; };
  inside[] += {Fabs(arcs[3])};
  arcs[] = Boundary { Surface{new[3]}; };
  outside[] += {Fabs(arcs[1])};
EndFor
last[] = Boundary { Surface{section}; };
at[] = Boundary { Curve{last[0]}; };
endIn = Fabs(at[0]);
at[] = Boundary { Curve{last[1]}; };
endOut = Fabs(at[1]);

// the box: bottom 201 to 204, top 205 to 208
x0 = (mirrors > 0) ? 0 : -half;
y0 = (mirrors > 1) ? 0 : -half;
For k In {0 : 1}
  If (mirrors < 2 || k == 0)
    Point(4 * k + 201) = {x0, y0, k * depth};
  EndIf
  Point(4 * k + 202) = {half, y0, k * depth};
  Point(4 * k + 203) = {half, half, k * depth};
  Point(4 * k + 204) = {x0, half, k * depth};
EndFor
corner = (mirrors == 2) ? 1 : 205;
Line(201) = {201, 202};
Line(202) = {202, 203};
Line(203) = {203, 204};
Line(204) = {204, 201};
Line(206) = {206, 207};
Line(207) = {207, 208};
Line(211) = {201, corner};
Line(212) = {202, 206};
Line(213) = {203, 207};
Line(214) = {204, 208};
If (mirrors > 0)
  Line(221) = {4, (mirrors == 2) ? 206 : 205};
  Line(222) = {208, endOut};
  Line(223) = {endIn, 1};
  Line(224) = {1, 2};
EndIf
If (mirrors < 2)
  Line(205) = {205, 206};
EndIf
If (mirrors == 0)
  Line(208) = {208, 205};
EndIf
Curve Loop(201) = {201 : 204};
Curve Loop(202) = {202, 213, -206, -212};
Curve Loop(203) = {203, 214, -207, -213};
If (mirrors == 2)
  Curve Loop(204) = {201, 212, -221, 3, 4, 5, -224, -211};
  Curve Loop(205) = {204, 211, -223, -last[4], -last[3], -last[2], -222, -214};
  Curve Loop(206) = {221, 206, 207, 222, -outside[]};
ElseIf (mirrors == 1)
  Curve Loop(204) = {201, 212, -205, -211};
  Curve Loop(205) = {204, 211, -221, 3, 4, 5, -224, -223, -last[4], -last[3], -last[2], -222, -214};
  Curve Loop(206) = {221, 205, 206, 207, 222, -outside[1], -outside[0]};
Else
  Curve Loop(204) = {201, 212, -205, -211};
  Curve Loop(205) = {204, 211, -208, -214};
  Curve Loop(206) = {205 : 208};
  Curve Loop(208) = {outside[]};
EndIf
If (mirrors == 0)
  Curve Loop(207) = {inside[]};
Else
  Curve Loop(207) = {224, inside[], 223};
EndIf
For k In {201 : 205}
  Plane Surface(k) = {k};
EndFor
If (mirrors == 0)
  Plane Surface(206) = {206, 208};
Else
  Plane Surface(206) = {206};
EndIf
Plane Surface(207) = {207};
Surface Loop(200) = {201 : 207, shell[]};
Volume(200) = {200};

Physical Surface("clamped", 1) = {201};
Physical Surface("contact", 2) = {207, contact[]};
Physical Surface("free", 3) = {202, 203, 206};
If (mirrors == 2)
  Physical Surface("mirrorX", 4) = {205, section};
  Physical Surface("mirrorY", 5) = {204, 1};
ElseIf (mirrors == 1)
  Physical Surface("mirrorX", 4) = {205, 1, section};
  Physical Surface("free") += {204};
Else
  Physical Surface("free") += {204, 205};
EndIf
Physical Volume("block", 1) = {200, ring[]};

// sizes: away from the circle, towards its rim
radial = "Sqrt(x*x+y*y)";
out = StrCat("(0.5*(", radial, Sprintf("-%.12g+Fabs(", patch), radial, Sprintf("-%.12g)))", patch));
Field[1] = MathEval;
Field[1].F = StrCat(Sprintf("%.12g*(1+%.12g*Sqrt(", h, grading), out, "*", out, Sprintf("+(%.12g-z)*(%.12g-z)))", depth, depth));
Field[2] = MathEval;
Field[2].F = StrCat(Sprintf("%.12g+0.4*Sqrt((", 0.2 * h), radial, Sprintf("-%.12g)*(", ends), radial,
                    Sprintf("-%.12g)+(%.12g-z)*(%.12g-z))", ends, depth, depth));
sizes[] = {1, 2};
If (edges > 0)
  Field[3] = MathEval;
  Field[3].F = Sprintf("%.12g+1.2*Sqrt((Fabs(x)-0.5)*(Fabs(x)-0.5)+z*z)", edges);
  Field[4] = MathEval;
  Field[4].F = Sprintf("%.12g+1.2*Sqrt((Fabs(y)-0.5)*(Fabs(y)-0.5)+z*z)", edges);
  sizes[] += {3, 4};
EndIf
Field[5] = Min;
Field[5].FieldsList = {sizes[]};
Background Field = 5;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = 0.25 * ((depth < 1) ? depth : 1);
