Point(1) = {0, 0, 0}; Point(2) = {100, 0, 0}; Point(3) = {100, -200, 0}; Point(4) = {0, -200, 0};
Line(1) = {4, 3}; Line(2) = {3, 2}; Line(3) = {2, 1}; Line(4) = {1, 4};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Point(11) = {0, 0, 0}; Point(12) = {40, 0, 0}; Point(13) = {40, 10, 0}; Point(14) = {50, 10, 0};
Point(15) = {50, 100, 0}; Point(16) = {0, 100, 0};
Line(11) = {11, 12}; Circle(12) = {12, 13, 14}; Line(13) = {14, 15}; Line(14) = {15, 16}; Line(15) = {16, 11};
Curve Loop(2) = {11, 12, 13, 14, 15}; Plane Surface(2) = {2};
Physical Curve("top") = {3}; Physical Curve("base") = {1}; Physical Curve("sole") = {11, 12};
Physical Curve("head") = {14}; Physical Surface("foundation") = {1}; Physical Surface("punch") = {2};
