// a disc and a block below it, that do not touch
SetFactory("OpenCASCADE"); Disk(1)={0,0,0,10}; Rectangle(2)={-2,-13,0,4,2};
Mesh.MeshSizeMax=4; Mesh.MeshSizeMin=4;
Physical Surface("slab")={1}; Physical Surface("base")={2}; Physical Curve("rim")={1}; Physical Curve("top")={4}; Physical Curve("bottom")={2};
