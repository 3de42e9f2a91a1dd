SetFactory("OpenCASCADE");
DefineConstant[ size = {0.5, Name "size"} ];
Rectangle(1) = {0, 0, 0, 1, 5}; Rectangle(2) = {0, 5, 0, 1, 5}; Rectangle(3) = {0, 10, 0, 1.7, 1};
Rectangle(4) = {3.2, 0, 0, 0.8, 4}; Rectangle(5) = {3.2, 4, 0, 0.8, 6}; Rectangle(6) = {2.5, 10, 0, 1.5, 1};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2:3}; Delete; }
BooleanFragments{ Surface{4}; Delete; }{ Surface{5:6}; Delete; }
Rectangle(7) = {1.2, 0, 0, 1.8, 9}; Rectangle(8) = {1.2, 9, 0, 1.8, 1};
BooleanFragments{ Surface{7}; Delete; }{ Surface{8}; Delete; }
Mesh.MeshSizeMax = size; e = 1e-3;
Physical Surface("shank") = {1, 2}; Physical Surface("tube") = {4, 5}; Physical Surface("sleeve") = {7};
Physical Surface("heads") = {3, 6, 8};
Physical Curve("inner") = Curve In BoundingBox {-e, 5-e, -e, 1+e, 5+e, e};
Physical Curve("outer") = Curve In BoundingBox {3.2-e, 4-e, -e, 4+e, 4+e, e};
Physical Curve("foot") = Curve In BoundingBox {-e, -e, -e, 4+e, e, e};
Physical Curve("under inner") = Curve In BoundingBox {1-e, 10-e, -e, 1.7+e, 10+e, e};
Physical Curve("under outer") = Curve In BoundingBox {2.5-e, 10-e, -e, 3.2+e, 10+e, e};
Physical Curve("end") = Curve In BoundingBox {1.2-e, 10-e, -e, 3+e, 10+e, e};
