// outline.geo: read after a geometry whose faces are looked at: a coarse mesh, which follows curvature, whatever sizes it asks for
Background Field = -1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 24;
Mesh.MeshSizeMin = 0;
Mesh.MeshSizeFactor = 1;
