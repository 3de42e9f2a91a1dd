Point(1) = {0, 10, 0, 4}; Point(2) = {-10, 10, 0, 4}; Point(3) = {10, 10, 0, 4}; Point(4) = {0, 0, 0, SIZE};
Circle(1) = {2, 1, 4}; Circle(2) = {4, 1, 3}; Line(3) = {3, 2}; Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
Point(11) = {-20, 0, 0, 5}; Point(12) = {20, 0, 0, 5}; Point(13) = {20, -20, 0, 5}; Point(14) = {-20, -20, 0, 5};
Point(15) = {0, 0, 0, SIZE}; Line(11) = {11, 15}; Line(15) = {15, 12}; Line(12) = {12, 13}; Line(13) = {13, 14};
Line(14) = {14, 11}; Curve Loop(2) = {11, 15, 12, 13, 14}; Plane Surface(2) = {2};
Physical Surface("disc") = {1}; Physical Surface("block") = {2};
Physical Curve("round") = {1, 2}; Physical Curve("flat") = {3}; Physical Curve("top") = {11, 15};
Physical Curve("base") = {13};
