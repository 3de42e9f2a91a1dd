// a sector of 15 degrees of a ring in another one: radii 0.5, 0.75, 1; n sides around it, m across each ring
DefineConstant[ n = {6, Name "n"} ]; DefineConstant[ m = {40, Name "m"} ]; A = 15 * Pi / 180;
For k In {0:3}
  r = 0.5 + 0.25 * (k == 0 ? 0 : (k == 3 ? 2 : 1));
  Point(10*k+1) = {0,0,0}; Point(10*k+2) = {r,0,0}; Point(10*k+3) = {r*Cos(A),r*Sin(A),0};
  Circle(10*k+1) = {10*k+2,10*k+1,10*k+3}; Transfinite Curve {10*k+1} = n+1;
EndFor
Line(5) = {2,12}; Line(6) = {3,13}; Line(7) = {22,32}; Line(8) = {23,33}; Transfinite Curve {5,6,7,8} = m+1;
Curve Loop(1) = {5,11,-6,-1}; Plane Surface(1) = {1}; Transfinite Surface{1};
Curve Loop(2) = {7,31,-8,-21}; Plane Surface(2) = {2}; Transfinite Surface{2};
Physical Surface("inner") = {1}; Physical Surface("outer") = {2}; Physical Curve("bore") = {1}; Physical Curve("outof") = {11}; Physical Curve("hole") = {21};
Physical Curve("rim") = {31}; Physical Curve("foot") = {5,7}; Physical Curve("end") = {6,8};
