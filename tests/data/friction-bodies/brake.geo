// brake shoe on the outside of a drum; mm
SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 100};
Disk(2) = {0, 0, 0, 60};
BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }
// shoe: bar and lining
Rectangle(10) = {-120, 108, 0, 240, 20};
Disk(11) = {0, 0, 0, 112};
Disk(12) = {0, 0, 0, 100};
BooleanDifference(13) = { Surface{11}; Delete; }{ Surface{12}; Delete; };
Rectangle(14) = {-40, 80, 0, 80, 35};
BooleanIntersection(15) = { Surface{13}; Delete; }{ Surface{14}; Delete; };
BooleanUnion(16) = { Surface{10}; Delete; }{ Surface{15}; Delete; };
Disk(17) = {-110, 118, 0, 5};
BooleanDifference(20) = { Surface{16}; Delete; }{ Surface{17}; Delete; };
Mesh.MeshSizeMax = 8;
