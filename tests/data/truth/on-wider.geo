Point(1) = {0, 0, 0, 0.25}; Point(2) = {2, RISE, 0, 0.25}; Point(3) = {2, 3, 0, 1}; Point(4) = {0, 3, 0, 1};
Point(9) = {0, 2.5, 0};
Point(5) = {0, 0, 0, 0.25}; Point(6) = {4, 0, 0, 0.5}; Point(7) = {4, -3, 0, 1}; Point(8) = {0, -3, 0, 1};
NOSE = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Physical Surface("up") = {1};
Curve Loop(2) = {5:8}; Plane Surface(2) = {2};
Physical Surface("low") = {2}; Physical Curve("foot") = {1}; Physical Curve("top") = {3}; Physical Curve("face") = {5};
Physical Curve("below") = {7}; Physical Curve("mirror") = {4, 8};
