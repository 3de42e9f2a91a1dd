// brinell.geo: a block of steel about its axis, refined below a ball; lengths in mm
DefineConstant[ size = {0.05, Name "edges where the ball touches"} ];
DefineConstant[ block = {12, Name "radius and height of the block"} ];

Point(1) = {0, 0, 0, size};
Point(2) = {0.8, 0, 0, size};
Point(3) = {block, 0, 0, block / 6};
Point(4) = {block, -block, 0, block / 4};
Point(5) = {0, -block, 0, block / 4};
Point(6) = {0, -0.8, 0, 1.5 * size};
Point(7) = {1, -1, 0, 2 * size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1 : 6};
Plane Surface(1) = {1};
Point{7} In Surface{1};

Physical Curve("top") = {1};
Physical Curve("base") = {4};
Physical Curve("axis") = {5, 6};
Physical Surface("block") = {1};
