// format.geo: read last: the mesh is written as the package reads it, whatever the geometry says; everything_ 1: what has no name too
DefineConstant[ everything_ = 0 ];
Mesh.Format = 1;
Mesh.MshFileVersion = 2.2;
Mesh.Binary = 0;
Mesh.SaveAll = everything_;
