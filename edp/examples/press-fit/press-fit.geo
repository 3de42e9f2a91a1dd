// press-fit.geo: a ring pressed into another one, whose bore is smaller than it by the interference; lengths in mm
DefineConstant[ bore = {10, Name "inner radius of the inner ring"} ];
DefineConstant[ radius = {20, Name "radius of the joint"} ];
DefineConstant[ outside = {30, Name "outer radius of the outer ring"} ];
DefineConstant[ interference = {0.002, Name "radial interference"} ];
DefineConstant[ edges = {184, Name "edges round the joint, of the outer ring"} ];
DefineConstant[ more = {1.27, Name "the inner ring's edges over that"} ];
DefineConstant[ turn = {0.1, Name "angle by which the inner ring is turned"} ];

Point(1) = {0, 0, 0};
Macro Ring
  For k In {1 : 4}
    Point(at + k) = {r * Cos(angle + k * Pi / 2), r * Sin(angle + k * Pi / 2), 0};
  EndFor
  For k In {1 : 4}
    Circle(at + k) = {at + k, 1, at + (k % 4) + 1};
  EndFor
  Curve Loop(at) = {at + 1 : at + 4};
  Transfinite Curve {at + 1 : at + 4} = Round(count / 4) + 1;
Return
angle = turn;
at = 10; r = bore; count = edges * more / 2;
Call Ring;
at = 20; r = radius + interference; count = edges * more;
Call Ring;
angle = 0;
at = 30; r = radius; count = edges;
Call Ring;
at = 40; r = outside; count = edges / 2;
Call Ring;
Plane Surface(1) = {20, 10};
Plane Surface(2) = {40, 30};

Physical Curve("shaft") = {21 : 24};
Physical Curve("hub") = {31 : 34};
Physical Surface("inner") = {1};
Physical Surface("outer") = {2};
