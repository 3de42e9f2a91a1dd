// outline.geo: read after a geometry whose faces are looked at: a coarse mesh, which follows curvature, whatever sizes it asks for
Field[99999] = MathEval;
Field[99999].F = Sprintf("%g", Hypot(Hypot(General.MaxX - General.MinX, General.MaxY - General.MinY), General.MaxZ - General.MinZ) / 15);
Background Field = 99999;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 1;
Mesh.MinimumCirclePoints = 16;
Mesh.MeshSizeMin = 0;
Mesh.MeshSizeFactor = 1;
