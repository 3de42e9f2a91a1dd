// ssnv128.geo: a square plate of side 40 on a rigid plane, its right side on the plane of symmetry; lengths in mm
DefineConstant[ size = {2, Name "size of the elements"} ];
side = 40;
Point(1) = {0, 0, 0};
Point(2) = {side, 0, 0};
Point(3) = {side, side, 0};
Point(4) = {0, side, 0};
For k In {1 : 4}
  Line(k) = {k, (k % 4) + 1};
EndFor
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Mesh.MeshSizeMax = size;
Physical Curve("sole") = {1};
Physical Curve("middle") = {2};
Physical Curve("top") = {3};
Physical Curve("side") = {4};
Physical Surface("plate") = {1};
