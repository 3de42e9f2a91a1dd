// an eccentric cam presses a roller that a force holds down; its shaft at the origin, its centre 10 from it at 30 degrees; mm
SetFactory("OpenCASCADE");
ex = 10 * Cos(Pi / 6); ey = 10 * Sin(Pi / 6);
yr = ey + Sqrt(42^2 - ex^2);
Disk(1) = {ex, ey, 0, 30};
Disk(2) = {0, 0, 0, 10};
BooleanDifference(11) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Disk(3) = {0, yr, 0, 12};
Disk(4) = {0, yr, 0, 5};
BooleanDifference(12) = { Surface{3}; Delete; }{ Surface{4}; Delete; };
Mesh.MeshSizeMax = 3;
