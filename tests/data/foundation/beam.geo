// a beam whose top is loaded over a part
DefineConstant[ size = {2, Name "size"}, length = {120, Name "length"}, part = {20, Name "part"}, depth = {4, Name "depth"} ];
Point(1) = {0,0,0,size}; Point(2) = {length,0,0,size}; Point(3) = {length,depth,0,size}; Point(4) = {part,depth,0,size}; Point(5) = {0,depth,0,size};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,5};Line(5)={5,1};
Curve Loop(1)={1:5}; Plane Surface(1)={1};
Physical Surface("beam")={1}; Physical Curve("sole")={1}; Physical Curve("top")={4}; Physical Curve("left")={5}; Physical Curve("right")={2};
