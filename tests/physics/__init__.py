"""Tests of physics/: plasticity, heat, loads."""
