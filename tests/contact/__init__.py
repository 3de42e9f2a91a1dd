"""Tests of contact/: surfaces, pairing, laws, friction, adhesion, wear."""
