Point(1)={0,0,0,1};Point(2)={30,0,0,1};Point(3)={30,4,0,1};Point(4)={6,4,0,1};Point(5)={6,6,0,1};Point(6)={4,6,0,1};
Point(7)={4,20,0,1};Point(8)={0,20,0,1};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Circle(4)={4,5,6};Line(5)={6,7};Line(6)={7,8};Line(7)={8,1};
Curve Loop(1)={1:7};Plane Surface(1)={1};Physical Surface("bracket")={1};
Physical Curve("foot")={3};Physical Curve("wall")={6};
