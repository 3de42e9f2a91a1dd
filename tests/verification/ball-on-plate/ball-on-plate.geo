// ball-on-plate.geo: half a section of a hemisphere of radius 8, its pole at the origin; lengths in mm
radius = 8;
Point(1) = {0, 0, 0};
Point(2) = {0, radius, 0};
Point(3) = {radius, radius, 0};
Circle(1) = {1, 2, 3};
Line(2) = {3, 2};
Line(3) = {2, 1};
Curve Loop(1) = {1 : 3};
Plane Surface(1) = {1};
Physical Curve("sphere") = {1};
Physical Curve("equator") = {2};
Physical Surface("ball") = {1};
