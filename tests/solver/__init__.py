"""Tests of solver/: methods, models, modes, rotations."""
