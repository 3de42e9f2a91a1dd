// a snap-fit hook: an arm held at the left, its nose with a ramp of 30 degrees over the rounded edge of a block; mm
r = 0.3;
// the nose, its corners rounded: a back face, a flat, the ramp
b = Sqrt(0.7^2 + 1.2^2); d = r * Tan(Acos(0.7 / b) / 2); f = r * Tan(Pi / 12);
Point(1) = {0, 0, 0}; Point(2) = {25, 0, 0};
Point(3) = {25.7 - d * 0.7 / b, -1.2 + d * 1.2 / b, 0}; Point(4) = {25.7 + d, -1.2, 0};
Point(5) = {26.5 - f, -1.2, 0}; Point(6) = {26.5 + f * Cos(Pi / 6), -1.2 + f / 2, 0};
Point(7) = {26.5 + 2.2 * Sqrt(3), 1, 0}; Point(8) = {26.5 + 2.2 * Sqrt(3), 2, 0}; Point(9) = {0, 2, 0};
Point(10) = {25.7 + d, -1.2 + r, 0}; Point(11) = {26.5 - f, -1.2 + r, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Circle(3) = {3, 10, 4}; Line(4) = {4, 5}; Circle(5) = {5, 11, 6};
Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 9}; Line(9) = {9, 1};
Curve Loop(1) = {1:9}; Plane Surface(1) = {1};
Point(21) = {28.4, -5, 0}; Point(22) = {31.4, -5, 0}; Point(23) = {31.4, -0.5, 0}; Point(24) = {31.1, -0.2, 0};
Point(25) = {28.7, -0.2, 0}; Point(26) = {28.4, -0.5, 0}; Point(27) = {31.1, -0.5, 0}; Point(28) = {28.7, -0.5, 0};
Line(11) = {21, 22}; Line(12) = {22, 23}; Circle(13) = {23, 27, 24}; Line(14) = {24, 25}; Circle(15) = {25, 28, 26};
Line(16) = {26, 21};
Curve Loop(2) = {11:16}; Plane Surface(2) = {2};
Physical Surface("hook") = {1}; Physical Surface("latch") = {2};
Physical Curve("root") = {9}; Physical Curve("nose") = {2:6}; Physical Curve("edge") = {12:16};
Physical Curve("floor") = {11};
Mesh.MeshSizeMax = 0.5;
