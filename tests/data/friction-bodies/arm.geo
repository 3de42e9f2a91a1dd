Point(1) = {0, 0, 0, 0.3};
Point(2) = {3, 0, 0, 0.15};
Point(3) = {5, 0, 0, 0.15};
Point(4) = {5, 1, 0, 0.3};
Point(5) = {0, 1, 0, 0.3};
For k In {1 : 5}
  Line(k) = {k, k % 5 + 1};
EndFor
Curve Loop(1) = {1 : 5};
Plane Surface(1) = {1};
Physical Surface("arm") = {1};
Physical Curve("wall") = {5};
Physical Curve("sole") = {2};
Physical Curve("back") = {4};
