"""Tests of scenes, examples and labs."""
