size = 0.5;
Point(1) = {0, 0, 0, size}; Point(2) = {1, 0, 0, size}; Point(3) = {2, 0, 0, size}; Point(4) = {2, -1, 0, 0.02};
Point(5) = {3, 0, 0, size}; Point(6) = {7, 0, 0, size}; Point(7) = {8, 0, 0, size}; Point(8) = {8, -1, 0, 0.02};
Point(9) = {9, 0, 0, size}; Point(10) = {10, 0, 0, size}; Point(11) = {10, 4, 0, size}; Point(12) = {0, 4, 0, size};
Line(1) = {1, 2}; Circle(2) = {2, 3, 4}; Circle(3) = {4, 3, 5}; Line(4) = {5, 6}; Circle(5) = {6, 7, 8};
Circle(6) = {8, 7, 9}; Line(7) = {9, 10}; Line(8) = {10, 11}; Line(9) = {11, 12}; Line(10) = {12, 1};
Curve Loop(1) = {1:10}; Plane Surface(1) = {1}; Mesh.ElementOrder = 2;
Physical Curve("left") = {2, 3}; Physical Curve("right") = {5, 6}; Physical Curve("top") = {9};
Physical Surface("plank") = {1};
