SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 1, 1, -Pi/2, 0, 2*Pi};
Physical Volume("ball") = {1}; cut() = Surface In BoundingBox {-2, -2, 0.999, 2, 2, 1.001};
skin() = Abs(Boundary{ Volume{1}; }); skin() -= cut();
Physical Surface("cut") = cut(); Physical Surface("skin") = skin();
Field[1] = MathEval; Field[1].F = "0.09 + 0.4 * Sqrt(x * x + y * y + z * z)";
Background Field = 1; Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeExtendFromBoundary = 0;
