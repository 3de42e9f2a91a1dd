"""Rigid shapes: shapes.py says how a case states them, surfaces.py makes outlines and triangles of those with edges."""
