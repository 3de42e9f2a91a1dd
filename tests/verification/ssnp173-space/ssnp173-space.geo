// ssnp173-space.geo: an eighth of a hollow sphere in another one that it touches; lengths in mm
SetFactory("OpenCASCADE");
Macro Shell
  Sphere(n) = {0, 0, 0, outer, 0, Pi/2, Pi/2};
  Sphere(n + 10) = {0, 0, 0, inner, 0, Pi/2, Pi/2};
  BooleanDifference(n + 20) = { Volume{n}; Delete; }{ Volume{n + 10}; Delete; };
  MeshSize {PointsOf{Volume{n + 20};}} = size;
Return
n = 1; inner = 20; outer = 30; size = 8;
Call Shell;
n = 2; inner = 30; outer = 40; size = 6.5;
Call Shell;
Physical Volume("core") = {21};
Physical Volume("shell") = {22};
