"""Tests of error/: estimates, warnings, new meshes."""
