// a tube above a hub, both with a lead-in, about x = 0; down: how far the tube has come
DefineConstant[ h = {2, Name "size"} ]; DefineConstant[ down = {0, Name "way"} ];
Point(1) = {10, 20 - down, 0, 2*h}; Point(2) = {19.9, 20 - down, 0, h}; Point(3) = {20.0025, 21 - down, 0, h};
Point(4) = {20.0025, 48 - down, 0, 2*h}; Point(5) = {10, 48 - down, 0, 2*h};
Point(6) = {20, 0, 0, h}; Point(7) = {30, 0, 0, 2*h}; Point(8) = {30, 20, 0, 2*h}; Point(9) = {20.1, 20, 0, h}; Point(10) = {20, 19, 0, h};
For k In {1:5}
    Line(k) = {k, k%5+1}; Line(5+k) = {5+k, 6+k%5};
EndFor
Curve Loop(1) = {1:5}; Plane Surface(1) = {1}; Curve Loop(2) = {6:10}; Plane Surface(2) = {2};
Physical Curve("outside") = {2,3}; Physical Curve("top") = {4}; Physical Curve("base") = {6}; Physical Curve("hole") = {9,10};
Physical Surface("tube") = {1}; Physical Surface("hub") = {2};
