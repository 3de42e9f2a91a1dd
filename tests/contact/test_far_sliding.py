"""Bodies that slide onto and off a surface: press-in from outside the bore, over a table's edge, in one leg and in two."""

import csv
from math import pi

import pytest
from freefem import data, part

FIT = data("sliding/press-fit.geo")
TUBE = """units mm MPa
state axisymmetric
body tube E 196e3 nu 0.3
body hub E 196e3 nu 0.3
contact {}
symmetry base
{}
"""
EXACT = "-distance", "exact", "-estimate", 0, "-vtu", 0


def rows(run):
    """The rows of series.csv, as numbers."""
    with (run.folder / "series.csv").open() as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def lengthened(geometry):
    """A hub of 60 and a tube of 70."""
    for old, new in ("20 - down", "60 - down"), ("21 - down", "61 - down"), ("48 - down", "130 - down"):
        geometry = geometry.replace(old, new)
    return geometry.replace(", 20, 0", ", 60, 0").replace(", 19, 0", ", 59, 0")


@pytest.mark.parametrize("pair", ["hole outside", "outside hole"])
def test_pressed_in_from_outside(tmp_path, pair):
    """Far from both ends each millimetre adds Lame's pressure; without friction the energy alone resists, and the forces balance."""
    case = TUBE.format(pair, "move top * -44")
    run = part(tmp_path, lengthened(FIT), case, *EXACT, "-set", "h", 2, "-history", 1, "-steps", 4)
    name = pair.replace(" ", " ") + " normal force"
    path = rows(run)
    pressure = 0.0025 * 196e3 / 20 / ((900 + 400) / (900 - 400) + (400 + 100) / (400 - 100))
    for last, this in zip(path[1:], path[2:], strict=False):
        assert this[name] - last[name] == pytest.approx(pressure * 2 * pi * 20 * 11, rel=0.01)
        energy = this["stored energy"] - last["stored energy"]
        assert this["symmetry base force y"] == pytest.approx(energy / 11, abs=2e-4 * this[name])
    assert run.summary["outOfBalance"] < 1e-6
    assert run.summary["unpairedPoints"] == 0 or not any("opposite" in text for text in run.summary["warnings"])
