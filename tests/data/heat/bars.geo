// two bars end to end whose meshes do not match, turned and mirrored; lengths 20 and 10, width 20
DefineConstant[ n = {7, Name "elements across the lower bar"} ];
DefineConstant[ angle = {0, Name "angle"} ];
DefineConstant[ mirror = {1, Name "1 or -1"} ];
DefineConstant[ gap = {0, Name "gap between the bars"} ];
xs() = {0}; ys() = {0}; xs() += {20}; ys() += {0}; xs() += {20}; ys() += {20}; xs() += {0}; ys() += {20};
xs() += {0}; ys() += {20 + gap}; xs() += {20}; ys() += {20 + gap}; xs() += {20}; ys() += {30 + gap}; xs() += {0}; ys() += {30 + gap};
For i In {0 : 7}
  Point(i + 1) = {mirror * xs(i) * Cos(angle) - ys(i) * Sin(angle), mirror * xs(i) * Sin(angle) + ys(i) * Cos(angle), 0};
EndFor
For k In {0:1}
  For j In {1:4}
    Line(10 * k + j) = {4 * k + j, 4 * k + j % 4 + 1};
  EndFor
  Curve Loop(k + 1) = {10 * k + 1 : 10 * k + 4};
  Plane Surface(k + 1) = {k + 1};
EndFor
Transfinite Curve {1, 3} = n + 1;
Transfinite Curve {11, 13} = Round(1.6 * n) + 1;
Mesh.MeshSizeMax = 20 / n;
Physical Curve("bottom") = {1}; Physical Curve("face") = {3}; Physical Curve("right") = {2};
Physical Curve("beside") = {12}; Physical Curve("left") = {4, 14};
Physical Curve("foot") = {11}; Physical Curve("top") = {13};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
