"""Bodies that slide onto and off a surface: a press-in from outside the bore, over an edge, in one leg and in two."""

import csv
import re
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
SERIES = "-history", 1, "-steps", 4


def rows(run):
    """The rows of series.csv, as numbers."""
    with (run.folder / "series.csv").open() as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def lengthened(geometry):
    """A hub of 90 and a tube of 110."""
    for old, new in ("20 - down", "90 - down"), ("21 - down", "91 - down"), ("48 - down", "200 - down"):
        geometry = geometry.replace(old, new)
    return geometry.replace(", 20, 0", ", 90, 0").replace(", 19, 0", ", 89, 0")


@pytest.mark.parametrize("pair", ["hole outside", "outside hole"])
def test_pressed_in_from_outside(tmp_path, pair):
    """Far from both ends each millimetre adds Lame's pressure, up to 1.5 % of the force; the energy alone resists."""
    case = TUBE.format(pair, "move top * -63")
    run = part(tmp_path, lengthened(FIT), case, *EXACT, "-set", "h", 2, "-history", 1, "-steps", 6)
    name = pair + " normal force"
    path = rows(run)
    pressure = 0.0025 * 196e3 / 20 / ((900 + 400) / (900 - 400) + (400 + 100) / (400 - 100))
    for last, this in [path[3:5], path[4:6]]:
        assert this[name] - last[name] == pytest.approx(pressure * 2 * pi * 20 * 10.5, abs=0.015 * this[name])
    energy = path[5]["stored energy"] - path[3]["stored energy"]
    assert path[4]["symmetry base force y"] == pytest.approx(energy / 21, abs=1e-4 * path[4][name])
    assert run.summary["outOfBalance"] < 1e-6
    assert run.summary["unpairedPoints"] == 0 or not any("opposite" in text for text in run.summary["warnings"])


BLOCK = """units mm MPa
body table E 2000 nu 0.3
body block E 2000 nu 0.3
contact {}
clamp base
{}
"""


def over_edge(folder, case, start, *flags):
    """A block with an overlap of 0.01 that slides on a table of 20 by 8, from x = start."""
    return part(folder, data("sliding/table.geo"), case, *EXACT, "-set", "g", -0.01, "-set", "x0", start, *flags)


def test_off_the_table(tmp_path):
    """With friction: a block that has left the table carries nothing; before, friction is that of all it carries."""
    off = over_edge(tmp_path / "off", BLOCK.format("under face friction 0.2", "move top 12 0"), 12, *SERIES)
    path = rows(off)
    assert [row["contactPoints"] for row in path] == [11, 5, 0, 0]
    assert path[1]["move top reaction"] == pytest.approx(0.2 * path[1]["under face normal force"], rel=0.01)
    (told,) = [text for text in off.summary["warnings"] if "presses" in text]
    assert told.startswith("at the end of the load nothing presses on anything: nothing is opposite any more")


def test_onto_the_table(tmp_path):
    """From where nothing is opposite: two moves of one body carry it to what a problem has that is drawn there."""
    case = BLOCK.format("under face", "move top * 0\nmove right -12 *")
    on = over_edge(tmp_path / "on", case, 24, *SERIES)
    drawn = over_edge(tmp_path / "drawn", BLOCK.format("under face", "move top * 0\nmove right 0 *"), 12)
    there = drawn.summary["contacts"][0]["normalForce"]
    assert rows(on)[-1]["under face normal force"] == pytest.approx(there, rel=1e-3)
    assert on.contact["x"].max() == pytest.approx(22)  # the block has been carried along
    assert on.summary["outOfBalance"] < 1e-6


IN_SPACE = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 20, 8, 6}; Box(2) = {21, 1.5, 5.99, 8, 5, 4};
Mesh.MeshSizeMax = 2; MeshSize{ PointsOf{ Volume{2}; } } = 1.3;
Physical Volume("table") = {1}; Physical Volume("block") = {2};
Physical Surface("base") = {5}; Physical Surface("face") = {6};
Physical Surface("under") = {11}; Physical Surface("top") = {12};
"""


def test_onto_the_table_in_space(tmp_path):
    """From where nothing is opposite, with friction: all that presses rubs, and shear acts against the motion."""
    case = BLOCK.removeprefix("units mm MPa\n").format("under face friction 0.2", "move top -6 0 0")
    on = part(tmp_path, IN_SPACE, case, "-order", 1, "-points", "segment", *EXACT, *SERIES, space=True)
    path = rows(on)
    assert [row["contactPoints"] for row in path] == sorted(row["contactPoints"] for row in path)
    assert path[0]["contactPoints"] > 0
    for row in path:
        assert row["shearForce"] == pytest.approx(0.2 * row["force"], rel=1e-3)


def test_gaps_of_curves_where_they_are(tmp_path):
    """A block that leaves a round pad in one leg, which carries it along, or in two: the same gap is left."""
    case = BLOCK.format("under arc", "{}").replace("table", "pad")
    pad = data("sliding/narrow-pad.geo")
    one = part(tmp_path / "one", pad, case.format("move top -8 -0.02"), *EXACT, "-history", 1, "-steps", 2)
    two = part(tmp_path / "two", pad, case.format("leg 2\nmove top -8 -0.02\nleg 1\nmove top -8 -0.02"), *EXACT)
    left = [re.search(r"least gap left is ([\d.e-]+)", " ".join(run.summary["warnings"]))[1] for run in (one, two)]
    assert float(left[0]) == pytest.approx(float(left[1]), rel=1e-5)


def test_two_legs_pair_as_one(tmp_path):
    """A path of two legs, which carries no body along, measures gaps where the surfaces are: the forces of one leg."""
    one = part(tmp_path / "one", FIT, TUBE.format("hole outside", "move top 0 -12"), *EXACT, "-set", "h", 2, *SERIES)
    legs = "leg 4\nmove top 0 -12\nleg 1\nmove top 0 -12"
    two = part(tmp_path / "two", FIT, TUBE.format("hole outside", legs), *EXACT, "-set", "h", 2)
    name = "hole outside normal force"
    assert rows(two)[3][name] == pytest.approx(rows(one)[3][name], rel=0.01)
