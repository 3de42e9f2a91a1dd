// taper.geo: a tapered plug in a tapered bore, half of both: the mirror is x = 0; lengths in mm
DefineConstant[ slope = {0.1, Name "of the flank: how far it goes sideways over how far up"} ];
DefineConstant[ half = {10, Name "half the plug's width at y = 0"} ];
DefineConstant[ long = {30, Name "length of the bore"} ];
DefineConstant[ wall = {20, Name "thickness of the block beside the bore, at its lower end"} ];
DefineConstant[ size = {1, Name "element size at the flank"} ];

// the plug stands out by 5 below and 10 above
Point(1) = {0, -5, 0, 3 * size};
Point(2) = {half - 5 * slope, -5, 0, size};
Point(3) = {half + (long + 10) * slope, long + 10, 0, 2 * size};
Point(4) = {0, long + 10, 0, 3 * size};
For k In {1 : 4}
  Line(k) = {k, k % 4 + 1};
EndFor
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};

Point(11) = {half, 0, 0, 0.8 * size};
Point(12) = {half + wall, 0, 0, 3 * size};
Point(13) = {half + wall, long, 0, 3 * size};
Point(14) = {half + long * slope, long, 0, 0.8 * size};
For k In {1 : 4}
  Line(10 + k) = {10 + k, 11 + k % 4};
EndFor
Curve Loop(2) = {11 : 14};
Plane Surface(2) = {2};

Physical Curve("tip") = {1};
Physical Curve("flank") = {2};
Physical Curve("head") = {3};
Physical Curve("middle") = {4};
Physical Curve("ends") = {11, 13};
Physical Curve("held") = {12};
Physical Curve("bore") = {14};
Physical Surface("plug") = {1};
Physical Surface("block") = {2};
