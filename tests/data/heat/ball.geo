// a ball and a block below it, that do not touch
SetFactory("OpenCASCADE"); Sphere(1)={0,0,0,10}; Box(2)={-2,-2,-13,4,4,2};
Mesh.MeshSizeMax=7; Mesh.MeshSizeMin=7;
Physical Volume("slab")={1}; Physical Volume("base")={2}; Physical Surface("rim")={1}; Physical Surface("top")={7}; Physical Surface("bottom")={6};
