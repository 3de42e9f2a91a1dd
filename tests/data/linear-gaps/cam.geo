DefineConstant[ turn = {0}, rx = {6}, size = {0.03} ];
Point(1) = {0, 0, 0}; Point(2) = {rx, 0, 0}; Point(3) = {0, 5, 0}; Point(4) = {-rx, 0, 0}; Point(5) = {0, -5, 0};
Ellipse(1) = {2, 1, 2, 3}; Ellipse(2) = {3, 1, 2, 4}; Ellipse(3) = {4, 1, 2, 5}; Ellipse(4) = {5, 1, 2, 2};
Point(6) = {2, 0, 0}; Point(7) = {0, 2, 0}; Point(8) = {-2, 0, 0}; Point(9) = {0, -2, 0};
Circle(5) = {6, 1, 7}; Circle(6) = {7, 1, 8}; Circle(7) = {8, 1, 9}; Circle(8) = {9, 1, 6};
Rotate {{0, 0, 1}, {0, 0, 0}, turn} { Curve{1:8}; }
Curve Loop(1) = {1:4}; Curve Loop(2) = {5:8}; Plane Surface(1) = {1, 2};
Mesh.ElementOrder = 2;
Physical Curve("rim") = {1:4}; Physical Curve("shaft") = {5:8}; Physical Surface("cam") = {1};
Field[1] = MathEval; Field[1].F = Sprintf("%g + 0.25 * Sqrt(x * x + (y - 5) * (y - 5))", size);
Background Field = 1; Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeMax = 1;
