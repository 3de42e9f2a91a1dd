"""Tests of output/: screens, files, places."""
