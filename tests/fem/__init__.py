"""Tests of fem/: elements, engines, processes."""
