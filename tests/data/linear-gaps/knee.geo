// rounded condyle on a cartilage layer bonded to bone, about the axis x = 0, mm
DefineConstant[ R = {30, Name "radius of the condyle"} ];
DefineConstant[ t = {3, Name "thickness of the layer"} ];
SetFactory("OpenCASCADE");
Rectangle(1) = {0, -t, 0, 25, t};          // cartilage
Rectangle(2) = {0, -t-20, 0, 25, 20};      // bone
Disk(3) = {0, R, 0, R};                    // condyle
Rectangle(4) = {0, 0, 0, 40, 12};
BooleanIntersection(5) = { Surface{3}; Delete; }{ Surface{4}; Delete; };
Physical Surface("cartilage") = {1}; Physical Surface("bone") = {2}; Physical Surface("condyle") = {5};
Mesh.MeshSizeMax = 2.5;
