DefineConstant[ size = {0.7, Name "elements"} ];
SetFactory("OpenCASCADE");
Rectangle(1) = {-3, 0, 0, 1, 5}; Rectangle(2) = {-3, 5, 0, 1, 5};
Rectangle(3) = {2, 0, 0, 1, 4}; Rectangle(4) = {2, 4, 0, 1, 6};
Rectangle(5) = {-4, 10, 0, 8, 2};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2,3,4,5}; Delete; }
Rectangle(6) = {-1.8, 0, 0, 3.6, 10};
Mesh.MeshSizeMax = size;
e = 1e-3;
Physical Surface("frame") = {1:5}; Physical Surface("block") = {6};
Physical Curve("cut1") = Curve In BoundingBox {-3-e, 5-e, -e, -2+e, 5+e, e};
Physical Curve("cut2") = Curve In BoundingBox {2-e, 4-e, -e, 3+e, 4+e, e};
Physical Curve("foot") = {Curve In BoundingBox {-3-e, -e, -e, -2+e, e, e}, Curve In BoundingBox {2-e, -e, -e, 3+e, e, e}, Curve In BoundingBox {-1.8-e, -e, -e, 1.8+e, e, e}};
Physical Curve("top") = Curve In BoundingBox {-4-e, 12-e, -e, 4+e, 12+e, e};
cs() = Curve In BoundingBox {-1.8-e, 10-e, -e, 1.8+e, 10+e, e}; Physical Curve("seat") = {cs(#cs()-1)};
cu() = Curve In BoundingBox {-2-e, 10-e, -e, 2+e, 10+e, e}; cu() -= {cs(#cs()-1)}; Physical Curve("under") = {cu()};
