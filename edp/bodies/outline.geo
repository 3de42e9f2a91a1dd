// outline.geo: read after a geometry whose faces are looked at: a coarse mesh, which follows curvature, whatever sizes it asks for
outline_ = newf;
Field[outline_] = MathEval;
Field[outline_].F = Sprintf("%g", Hypot(Hypot(General.MaxX - General.MinX, General.MaxY - General.MinY), General.MaxZ - General.MinZ) / 15);
Background Field = outline_;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 1;
Mesh.MinimumCirclePoints = 16;
Mesh.MeshSizeMin = 0;
Mesh.MeshSizeFactor = 1;
