"""Tests of input/: the command line, cases and what they read of meshes and geometries."""
