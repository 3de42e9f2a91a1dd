// two boxes end to end whose meshes do not match: the bars in space
SetFactory("OpenCASCADE");
DefineConstant[ n = {3, Name "elements"} ];
Box(1) = {0, 0, 0, 20, 20, 20};
Box(2) = {0, 0, 20, 20, 20, 10};
Characteristic Length{ PointsOf{ Volume{1}; } } = 20 / n;
Characteristic Length{ PointsOf{ Volume{2}; } } = 12 / n;
Physical Surface("bottom") = {5}; Physical Surface("face") = {6};
Physical Surface("foot") = {11}; Physical Surface("top") = {12};
Physical Surface("left") = {1, 7}; Physical Surface("right") = {2, 8}; Physical Surface("front") = {3, 9}; Physical Surface("back") = {4, 10};
Physical Volume("lower") = {1}; Physical Volume("upper") = {2};
