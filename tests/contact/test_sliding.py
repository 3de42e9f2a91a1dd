"""Finite sliding of cases in the plane: to where nothing lay opposite, with friction, on meshes whose sizes jump."""

from math import pi, sqrt

import numpy as np
import pytest
from freefem import TELL, data, part, run_in, scene_text, snippet, told, tree

BLOCK = """units mm MPa
body block E 2000 nu 0.3
body pad E 2000 nu 0.3
contact under arc
clamp base
move top {} -0.01
"""


@pytest.fixture(scope="module")
def moved(tmp_path_factory):
    """A block that slides to where no point of it faces the pad, and one that is drawn there."""
    folder, geometry = tmp_path_factory.mktemp("pad"), data("sliding/narrow-pad.geo")
    slid = part(folder / "slid", geometry, BLOCK.format(-1), "-distance", "exact")
    return slid, part(folder / "drawn", geometry, BLOCK.format(0), "-distance", "exact", "-set", "d", 1)


def test_slides_as_it_is_drawn(moved):
    """Points that nothing faced at rest have the stiffness of the others: as few steps, the same errors."""
    slid, drawn = (run.summary for run in moved)
    assert slid["newton"] < 30
    for name in ("normalForce", "pressureMax", "contactLength"):
        here, there = (summary["estimates"]["contacts"][0][name] for summary in (slid, drawn))
        assert here["value"] == pytest.approx(there["value"], rel=1e-4), name
        assert here["error"] == pytest.approx(there["error"], rel=0.05), name


def test_gaps_are_not_those_of_a_part(moved):
    """A point of which the pad covered a part at rest has the gap of the surfaces, not the part's."""
    slid, drawn = (run.contact for run in moved)
    near = (slid["overlap"] > -0.02) & (slid["weight"] > 1e-6)
    assert near.sum() > 15
    assert slid["overlap"][near] == pytest.approx(drawn["overlap"][near], abs=2e-6)
    assert np.abs(slid["x"][near] - drawn["x"][near] - 1).max() < 1e-9


COLLET = """units mm MPa
state axisymmetric
body shaft E 210e3 nu 0.3
body collet E 210e3 nu 0.3
body housing E 210e3 nu 0.3
contact collet-bore shaft-side friction 0.15
contact collet-cone cone friction 0.1
clamp housing-bottom
leg 1
traction collet-bottom 0 -40
move shaft-foot 0 0
leg 1
traction collet-bottom 0 -40
move shaft-foot 0 {}
"""


@pytest.mark.parametrize("way, pressure, least", [(0.005, 23.6, 10), (-0.02, 47, 15), (-0.005, 31, 6.7)])
def test_forces_that_friction_carries(tmp_path, way, pressure, least):
    """The error of a force along the surface moves no pressures, although normals turn by 1e-5 and it is theirs too."""
    run = part(tmp_path, data("sliding/collet.geo"), COLLET.format(way), "-distance", "exact", "-set", "size", 3)
    bore, cone = run.summary["estimates"]["contacts"]
    # pressure: on elements a sixth as large; least: with the error of the normal force in it
    assert abs(bore["pressureMax"]["value"] - pressure) < bore["pressureMax"]["error"] < 0.7 * pressure
    assert bore["pressureMax"]["error"] > least
    assert cone["contactLength"]["error"] < 0.2 * cone["contactLength"]["value"]
    assert not [text for text in run.summary["warnings"] if "is estimated at" in text]


# a sleeve on a cone of slope 1/50, pulled until all of it slips
CONE = data("friction-bodies/sleeve.geo").replace("{inner, k", "{inner + 0.02 * k, k")
CONE = CONE.replace("{outer, 6", "{outer + 0.12 * (1 - k), 6").replace("{inner, 6", "{inner + 0.1 * k, 6")
PULLED = """state axisymmetric
body shaft E 200e3 nu 0.3
body hub E 100e3 nu 0.3
contact hole seat interference 0.01 friction 0.2
clamp foot
move rim 0 0.02
"""
WORST = """
real[int] changes(goals), ranked(goals);
for (int j = 0; j < goals; j++) changes[j] = slidingFraction(j);
for (int j = 0; j < goals; j++) ranked[j] = goalIsRanked[j];
tell("changes", changes);
tell("ranked", ranked);
tell("worst", slidingWorstGoal);
"""


def test_worst_change_of_what_counts(tmp_path):
    """A resultant that friction carries is not ranked: though its change is the greatest, a ranked one shall decide."""
    package = tree(tmp_path / "package")  # friction is read by parts.edp itself alone
    with (package / "edp/parts.edp").open("a") as script:
        script.write(TELL + WORST)
    (package / "a.geo").write_text(CONE)
    (package / "a.case").write_text(PULLED)
    numbers = told(run_in(package, "edp/parts.edp", "-mesh", "a.geo", "-case", "a.case", "-vtu", 0).stdout)
    changes, ranked = numbers["changes"], numbers["ranked"] > 0
    assert not ranked[0] and changes[0] > 1.2 * changes[ranked].max()
    assert numbers["worst"][0] == np.flatnonzero(ranked)[changes[ranked].argmax()]


PIECE = """Point(1) = {-10,-10,0}; Point(2) = {10,-10,0}; Point(3) = {10,0,0}; Point(4) = {0.5,0,0};
Point(5) = {-0.5,0,0}; Point(6) = {-10,0,0};
For k In {1:6}
  Line(k) = {k, 1+k%6};
EndFor
Curve Loop(1) = {1:6}; Plane Surface(1) = {1};
Physical Curve("base") = {1}; Physical Curve("middle") = {4}; Physical Surface("block") = {1};
Mesh.MeshSizeMax = 2;
"""
ALONE = """Field[1] = MathEval; Field[1].F = "0.02";
Field[2] = Restrict; Field[2].IField = 1; Field[2].EdgesList = {4};
Background Field = 2; Mesh.MeshSizeFromPoints = 0;
"""
PRESSED = "units mm MPa\nbody block E 1e5 nu 0.3\nclamp base\nobstacle middle circle 0.3 20 R 20 force 0 -60\n"


def test_size_of_a_curve(tmp_path):
    """Sizes grow away from a curve with a size of its own: Hertz' pressure and length within their errors."""
    modulus = 1e5 / (1 - 0.3**2)
    summary = part(tmp_path, PIECE, PRESSED + "size middle 0.02\n").summary
    found = summary["estimates"]["contacts"][0]
    exact = sqrt(60 * modulus / (20 * pi)), 2 * sqrt(4 * 60 * 20 / (pi * modulus))
    for name, value in zip(("pressureMax", "contactLength"), exact, strict=True):
        assert abs(found[name]["value"] - value) < found[name]["error"] < 0.05 * value, name
    assert summary["warnings"] == []


def test_flat_elements_are_told(tmp_path):
    """Of sizes that the geometry gives to a curve alone: long elements at the contact, whose errors are too small."""
    warnings = part(tmp_path, PIECE + ALONE, PRESSED).summary["warnings"]
    (told,) = [text for text in warnings if "times as long as high" in text]
    assert told.startswith("elements at the contact are up to 1") and "let sizes grow by less" in told


@pytest.mark.parametrize("height, told", [(5.5, 0), (6.5, 1)])
def test_how_flat_is_too_flat(height, told, tmp_path):
    """Elements more than six times as long as high are told of."""
    text = f"""
Point(1) = {{-4,0,0}}; Point(2) = {{4,0,0}}; Point(3) = {{4,{height},0}}; Point(4) = {{-4,{height},0}};
For k In {{1:4}}
  Line(k) = {{k, 1+k%4}};
EndFor
Curve Loop(1) = {{1:4}}; Plane Surface(1) = {{1}};
Transfinite Curve {{1, 3}} = 81; Transfinite Curve {{2, 4}} = 11; Transfinite Surface {{1}};
Physical Curve("base") = {{1}}; Physical Curve("middle") = {{3}}; Physical Surface("block") = {{1}};
"""
    pressed = PRESSED.replace("0.3 20", f"0.3 {height + 20}").replace("-60", "-600")
    warnings = part(tmp_path, text, pressed, "-order", 1).summary["warnings"]
    assert sum("times as long as high" in text for text in warnings) == told


@pytest.mark.parametrize("scene, ratio", [("disc-on-block", 0.25), ("sphere-on-plane", 0.5)])
def test_stiffness_goes_with_the_weight(tmp_path, scene, ratio):
    """A point with a quarter of its weight: twice its stiffness in space, four times in the plane."""
    text = """include "solver/solve.idp"
real[int] whole = bodyStiffness;
weight *= 0.25;
rescaleBodyStiffness();
rescaleBodyStiffness();
cout << "ratio " << whole[points / 2] / bodyStiffness[points / 2] << endl;
"""
    printed = snippet(tmp_path, scene_text(scene) + text, "-h", 0.5, "-vtu", 0)
    assert float(printed.split("ratio ")[1].split()[0]) == pytest.approx(ratio, rel=1e-5)


PRESSED_FIT = """units mm MPa
state axisymmetric
body tube E 196e3 nu 0.3
body hub E 196e3 nu 0.3
contact outside hole
symmetry base
move top 0 {}
"""


def test_pressed_as_it_is_drawn(tmp_path):
    """A tube pressed into a hub in steps, from where nothing faced anything: the forces of one that is drawn there."""
    geometry = data("sliding/press-fit.geo")
    drawn = part(tmp_path / "drawn", geometry, PRESSED_FIT.format(0), "-set", "down", 22, "-estimate", 0)
    flags = ["-distance", "exact", "-history", 1, "-steps", 8]
    pressed = part(tmp_path / "pressed", geometry, PRESSED_FIT.format(-22), *flags)
    here, there = (run.summary["contacts"][0]["normalForce"] for run in (pressed, drawn))
    assert here == pytest.approx(there, rel=0.02)
    moved = [float(line.split()[-1]) for line in pressed.stdout.splitlines() if "forces moved by" in line]
    assert max(moved) < 1e6  # of the forces, where they vanish too
    assert not any("inside the other body" in text for text in pressed.summary["warnings"])


SEATED = """units mm MPa
state axisymmetric
body plug E 200e3 nu 0.3
body seat E 100e3 nu 0.3
contact {}
symmetry axis
clamp base
move top 0 -7.02
"""


@pytest.mark.parametrize("pair, size", [("cone funnel", 1), ("cone funnel", 0.25)])
def test_past_a_corner(tmp_path, pair, size):
    """A cone that is longer than its seat: the contact is as long as the seat, no scrap past its end carries much."""
    run = part(tmp_path, data("sliding/plug.geo"), SEATED.format(pair), "-distance", "exact", "-set", "h", size)
    contact, known = run.summary["contacts"][0], run.estimates["contacts"][0]
    assert abs(known["contactLength"]["value"] - 4 * sqrt(2)) < known["contactLength"]["error"]
    scraps = run.contact["weight"] < 0.1 * np.median(run.contact["weight"][run.contact["pressure"] > 0])
    assert (run.contact["pressure"] * run.contact["weight"])[scraps].sum() < 0.02 * contact["normalForce"]
