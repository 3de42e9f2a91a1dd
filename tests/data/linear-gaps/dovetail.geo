// dovetail: half of a blade root in half of a disc sector (36 blades), plane, axis of rotation at the origin, y radial, mm
A = 5*Pi/180; s2 = Sqrt(2);
// disc
Point(1) = {0, 150, 0};  Point(2) = {0, 238, 0};
Point(3) = {9.5, 238, 0}; Point(4) = {9.5, 240.5, 0}; Point(5) = {12, 240.5, 0};
yc = 244 + 2.5 - 2.5*s2;
Point(6) = {12, yc, 0}; Point(7) = {9.5, yc, 0}; Point(8) = {9.5+2.5/s2, yc+2.5/s2, 0};
yd = 249.5 - 1.5 + 1.5*s2;
Point(9) = {8-1.5/s2, yd-1.5/s2, 0}; Point(10) = {8, yd, 0}; Point(11) = {6.5, yd, 0};
Point(12) = {6.5, Sqrt(255^2-6.5^2), 0};
Point(13) = {255*Sin(A), 255*Cos(A), 0};
Point(14) = {150*Sin(A), 150*Cos(A), 0};
Point(15) = {0, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Circle(3) = {3, 4, 5}; Line(4) = {5, 6}; Circle(5) = {6, 7, 8};
Line(6) = {8, 9}; Circle(7) = {9, 10, 11}; Line(8) = {11, 12}; Circle(9) = {12, 15, 13}; Line(10) = {13, 14}; Circle(11) = {14, 15, 1};
Curve Loop(1) = {1:11}; Plane Surface(1) = {1};
// blade
yb = 245 + 2 - 2*s2; yn = 251 - 2 + 2*s2;
Point(21) = {0, 240, 0}; Point(22) = {11, 240, 0}; Point(23) = {11, yb, 0}; Point(24) = {9, yb, 0};
Point(25) = {9+2/s2, yb+2/s2, 0};
Point(26) = {7-2/s2, yn-2/s2, 0}; Point(27) = {7, yn, 0}; Point(28) = {5, yn, 0};
Point(29) = {5, 270, 0}; Point(30) = {0, 270, 0};
Line(21) = {21, 22}; Line(22) = {22, 23}; Circle(23) = {23, 24, 25}; Line(24) = {25, 26}; Circle(25) = {26, 27, 28};
Line(26) = {28, 29}; Line(27) = {29, 30}; Line(28) = {30, 21};
Curve Loop(2) = {21:28}; Plane Surface(2) = {2};
Physical Surface("disc") = {1}; Physical Surface("blade") = {2};
Physical Curve("slot") = {5, 6, 7}; Physical Curve("flank") = {23, 24, 25};
Physical Curve("middle") = {1, 28}; Physical Curve("side") = {10}; Physical Curve("top") = {27};
Mesh.MeshSizeMax = 4;
