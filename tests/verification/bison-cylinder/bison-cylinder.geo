// bison-cylinder.geo: a quarter of a disc of radius 3, its lowest point at the origin
radius = 3;
Point(1) = {0, 0, 0};
Point(2) = {0, radius, 0};
Point(3) = {radius, radius, 0};
Circle(1) = {1, 2, 3};
Line(2) = {3, 2};
Line(3) = {2, 1};
Curve Loop(1) = {1 : 3};
Plane Surface(1) = {1};
Physical Curve("arc") = {1};
Physical Curve("flat") = {2};
Physical Curve("middle") = {3};
Physical Surface("cylinder") = {1};
