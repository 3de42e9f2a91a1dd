// gear-pair.geo: two teeth of spur gears that touch at the pitch point, the origin; lengths in mm, the line of centres along y
//   gmsh -2 edp/examples/gear-pair/gear-pair.geo, or as it is: -mesh edp/examples/gear-pair/gear-pair.geo
SetFactory("OpenCASCADE");
DefineConstant[ module = {4, Name "module"} ];
DefineConstant[ driver = {24, Name "teeth of the driver, above"} ];
DefineConstant[ driven = {36, Name "teeth of the driven gear, below"} ];
pressure = 20 * Pi / 180;

// a tooth on a piece of its rim, side 1: below, the tooth at the left of its flank; -1: above, turned by half a turn
Macro Tooth
  pitch = module * teeth / 2;
  base = pitch * Cos(pressure);
  half = Pi / (2 * teeth);                                 // half a tooth at the pitch circle, as an angle
  there = Tan(pressure) - pressure;                        // the involute's angle at the pitch point
  start = Acos(Min(1, base / Max(1.002 * base, pitch - 1.1 * module)));
  end = Acos(base / (pitch + module));
  flank() = {};
  back() = {};
  For k In {0 : 20}
    turn = start + (end - start) * k / 20;
    r = base / Cos(turn);
    way = there - (Tan(turn) - turn);                      // angle from the line of centres
    p = newp;
    Point(p) = {side * r * Sin(way), side * (r * Cos(way) - pitch), 0};
    Point(p + 1) = {side * r * Sin(-2 * half - way), side * (r * Cos(-2 * half - way) - pitch), 0};
    flank() += p;
    back() += p + 1;
  EndFor
  // below the flanks straight to the root, and well into the rim
  r = pitch - 2 * module;
  p = newp;
  way = there - (Tan(start) - start);
  Point(p) = {side * r * Sin(way), side * (r * Cos(way) - pitch), 0};
  Point(p + 1) = {side * r * Sin(-2 * half - way), side * (r * Cos(-2 * half - way) - pitch), 0};
  l = newl;
  Spline(l) = flank();
  Line(l + 1) = {flank(20), back(20)};
  Spline(l + 2) = back();
  Line(l + 3) = {back(0), p + 1};
  Line(l + 4) = {p + 1, p};
  Line(l + 5) = {p, flank(0)};
  Curve Loop(l) = {l, l + 1, -(l + 2), l + 3, l + 4, l + 5};
  s = news;
  Plane Surface(s) = {l};
  // the rim: four corners
  p = newp;
  For k In {0 : 3}
    r = pitch - (k < 2 ? 1.25 : 4) * module;
    way = -half + (k == 0 || k == 3 ? -4 : 4) * half;
    Point(p + k) = {side * r * Sin(way), side * (r * Cos(way) - pitch), 0};
  EndFor
  l = newl;
  For k In {0 : 3}
    Line(l + k) = {p + k, p + (k + 1) % 4};
  EndFor
  Curve Loop(l + 4) = {l : l + 3};
  Plane Surface(s + 1) = {l + 4};
  whole() = BooleanUnion{ Surface{s}; Delete; }{ Surface{s + 1}; Delete; };
Return
side = 1; teeth = driven;
Call Tooth;
Physical Surface("driven") = {whole()};
side = -1; teeth = driver;
Call Tooth;
Physical Surface("driver") = {whole()};
