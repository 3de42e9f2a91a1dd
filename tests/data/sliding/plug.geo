// a plug with a cone of 45 degrees above a seat with the same cone, which is shorter; x = 0 is the axis
DefineConstant[ h = {1, Name "size"} ];
Point(1) = {0, 5, 0, h}; Point(2) = {4, 5, 0, h}; Point(3) = {10, 11, 0, h}; Point(4) = {10, 19, 0, h}; Point(5) = {0, 19, 0, h};
Point(6) = {6, 0, 0, h}; Point(7) = {16, 0, 0, h}; Point(8) = {16, 6, 0, h}; Point(9) = {12, 6, 0, h};
For k In {1:5}
    Line(k) = {k, k % 5 + 1};
EndFor
For k In {6:9}
    Line(k) = {k, 6 + (k - 5) % 4};
EndFor
Curve Loop(1) = {1:5}; Plane Surface(1) = {1}; Curve Loop(2) = {6:9}; Plane Surface(2) = {2};
Physical Surface("plug") = {1}; Physical Surface("seat") = {2};
Physical Curve("cone") = {2}; Physical Curve("funnel") = {9}; Physical Curve("top") = {4}; Physical Curve("axis") = {5};
Physical Curve("base") = {6};
