// punch.geo: a punch with a round nose above an arched foundation
DefineConstant[ size = {0.1, Name "size of the elements near the contact"} ];

// the foundation: 20 wide, 6 high in the middle, its top an arc of radius 40
Point(1) = {-10, 0, 0};
Point(2) = {10, 0, 0};
Point(3) = {10, Sqrt(1500) - 34, 0};
Point(4) = {0, 6, 0};
Point(5) = {-10, Sqrt(1500) - 34, 0};
Point(6) = {0, -34, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Circle(3) = {3, 6, 4};
Circle(4) = {4, 6, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1 : 5};
Plane Surface(1) = {1};

// the punch: 8 wide, its nose an arc of radius 8, 0.1 above the foundation
Point(11) = {-4, 12, 0};
Point(12) = {-4, 14.1 - Sqrt(48), 0};
Point(13) = {0, 6.1, 0};
Point(14) = {4, 14.1 - Sqrt(48), 0};
Point(15) = {4, 12, 0};
Point(16) = {0, 14.1, 0};
Line(11) = {11, 12};
Circle(12) = {12, 16, 13};
Circle(13) = {13, 16, 14};
Line(14) = {14, 15};
Line(15) = {15, 11};
Curve Loop(2) = {11 : 15};
Plane Surface(2) = {2};

Physical Curve("clamped") = {1};
Physical Curve("contact") = {3, 4};
Physical Curve("free") = {2, 5, 11, 14};
Physical Curve("master") = {12, 13};
Physical Curve("pushed") = {15};
Physical Surface("lower") = {1};
Physical Surface("upper") = {2};

Field[1] = MathEval;
Field[1].F = Sprintf("%g*(1+0.6*Sqrt(x*x+(y-6)*(y-6)))", size);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
