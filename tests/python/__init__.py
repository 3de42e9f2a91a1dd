"""Tests of postprocess/."""
