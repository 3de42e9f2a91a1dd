Point(1) = {0, 0, 0, SIZE}; Point(2) = {10, 0, 0, SIZE}; Point(3) = {10, 5, 0, SIZE}; Point(4) = {0, 5, 0, SIZE};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(11) = {-10, -10, 0, 2}; Point(12) = {20, -10, 0, 2}; Point(13) = {20, 0, 0, 1}; Point(14) = {-10, 0, 0, 1};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11}; Curve Loop(2) = {11:14};
Plane Surface(2) = {2}; Physical Surface("upper") = {1}; Physical Surface("block") = {2};
Physical Curve("foot") = {1}; Physical Curve("head") = {3}; Physical Curve("top") = {13}; Physical Curve("base") = {11};
