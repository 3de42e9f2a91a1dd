// every-curve.geo: read after a geometry of the plane: the elements on all of its curves are saved, whether they have names or not
Physical Curve("every curve of the geometry") = {Curve{:}};
