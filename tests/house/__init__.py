"""Tests of the sources themselves: arrows, names, heads, the Makefile, the accounts of tests."""
