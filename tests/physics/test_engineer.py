"""What sizes a part: stresses with errors, load curves, heat, bolts, interference, sweeps, against closed forms."""

import csv
import json
import os
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
from freefem import ROOT, cases_of, data, part, run_in
from input.test_parts import read
from PIL import Image

from postprocess.command_line import main
from postprocess.vtu import read_arrays

RING = data("engineer/ring.geo")
SLICE = """
h = SIZE;
Point(2) = {10, 0, 0, h}; Point(3) = {20, 0, 0, h}; Point(4) = {20, 4, 0, h}; Point(5) = {10, 4, 0, h};
Point(6) = {20, 0, 0, h}; Point(7) = {30, 0, 0, h}; Point(8) = {30, 4, 0, h}; Point(9) = {20, 4, 0, h};
Line(1) = {2, 3}; Line(2) = {3, 4}; Line(3) = {4, 5}; Line(4) = {5, 2};
Line(5) = {6, 7}; Line(6) = {7, 8}; Line(7) = {8, 9}; Line(8) = {9, 6};
""" + RING[RING.index("Curve Loop") :]
BODIES = """
body hub E 200000 nu 0.3 yield 100
body ring E 100000 nu 0.25 yield 180
symmetry below
symmetry left
"""
A, B, C = 10.0, 20.0, 30.0  # radii
HUB, OUTER = (200000.0, 0.3), (100000.0, 0.25)


def lame(inside, outside, r1, r2):
    """(a, b): radial stress a - b/r^2 of a ring under pressures."""
    area = r2**2 - r1**2
    return (inside * r1**2 - outside * r2**2) / area, (inside - outside) * (r1 * r2) ** 2 / area


def moved(r, ab, material, stress):
    """The radial displacement."""
    modulus, nu = material
    first = (1 - nu) if stress else (1 + nu) * (1 - 2 * nu)
    return (first * ab[0] * r + (1 + nu) * ab[1] / r) / modulus


def seat_pressure(over, inner, stress):
    """Between hub and ring that overlap by so much at their seat."""

    def gap(p):
        return moved(B, lame(p, 0, B, C), OUTER, stress) - moved(B, lame(inner, p, A, B), HUB, stress) - over

    return gap(0) / (gap(0) - gap(1))


def solve(folder, geo, case, *flags, scene="parts", size=2.0, expect=0):
    """-vtu 1 too: the figures want it."""
    vtu = () if "-vtu" in flags else ("-vtu", 1)
    text = geo.replace("SIZE", f"{size:g}")
    return part(folder, text, case, *vtu, *flags, space=scene == "parts-3d", expect=expect)


def summary(folder):
    return json.loads((folder / "out/summary.json").read_text())


def rows_of(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def line_of(folder, name):
    return np.genfromtxt(folder / f"out/line-{name}.csv", delimiter=",", names=True)


# ---------------------------------------------------------------- heat, interference


@pytest.mark.parametrize("state", cases_of(["axisymmetric"], ["stress", "strain"]))
def test_shrink_fit(state, tmp_path):
    """A ring that has cooled shall press as Lame's says: plane strain grows by 1 + nu more."""
    ring = state == "axisymmetric"
    line = "line r 10 2 30 2" if ring else "line r 7.0711 7.0711 21.2 21.2"
    heat = f"state {state}\n{BODIES}contact bore seat\nexpand ring 2e-5 -50\n{line}\n"
    solve(tmp_path, SLICE if ring else RING, heat, "-vtu", 0)
    over = 1e-3 * B * (1 if state == "stress" else 1 + OUTER[1])
    expected = seat_pressure(over, 0, state == "stress")
    found = summary(tmp_path)["contacts"][0]
    area = 2 * np.pi * B * 4 if state == "axisymmetric" else np.pi / 2 * B
    assert found["normalForce"] / area == pytest.approx(expected, rel=1e-4)
    table = line_of(tmp_path, "r")
    for row in table:
        r = row["x"] if ring else np.hypot(row["x"], row["y"])
        (a, b), (modulus, nu) = (lame(0, expected, A, B), HUB) if r < B else (lame(expected, 0, B, C), OUTER)
        third = 0 if state == "stress" else 2 * nu * a + (r > B) * modulus * 1e-3
        along, around = a - b / r**2, a + b / r**2
        mises = np.sqrt(((along - around) ** 2 + (around - third) ** 2 + (third - along) ** 2) / 2)
        assert abs(r - B) < 0.3 or abs(row["vonMises"] - mises) <= row["vonMisesError"]


BLOCK = data("engineer/block.geo")


HELD = """state {}
body b E 1000 nu 0.3
expand b 1e-3 1
symmetry left
symmetry right
symmetry base
obstacle top plane 0 2 0 -1 move 0 -0.99
"""
STRIP = """SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 4, 1}; Physical Surface("b") = {1};
Physical Curve("left") = {4}; Physical Curve("right") = {2};
Physical Curve("top") = {3}; Physical Curve("base") = {1}; Mesh.MeshSizeMax = SIZE;
"""


BAR = """SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 4, 1, 1}; Physical Volume("b") = {1};
Physical Surface("left") = {1}; Physical Surface("right") = {2}; Physical Surface("base") = {3};
Physical Surface("top") = {4}; Physical Surface("behind") = {5}; Mesh.MeshSizeMax = SIZE;
Rotate {{1, 0.5, 1}, {0, 0, 0}, -Pi/9} { Volume{1}; }
"""
HELD_BAR = HELD[HELD.index("\n") + 1 :].replace("0 2 0 -1 move 0 -0.99", "0 3 0 0 -1 0 move 0 -0.5 0")
HELD_BAR += "symmetry behind\n"


@pytest.mark.parametrize("state, exact", [("stress", 1), ("strain", 1 / 0.7), ("space", 1)])
def test_heat_held_on_two_sides(state, exact, tmp_path):
    """The von Mises stress of the pictures: E alpha dT in plane stress and in a bar, that over 1 - nu in plane strain.

    The body lies aslant, so that all stresses count."""
    if state == "space":
        solve(tmp_path, BAR, HELD_BAR, "-order", 1, size=1, scene="parts-3d")
    else:
        turned = STRIP + "Rotate {{0, 0, 1}, {0, 0, 0}, -Pi/9} { Surface{1}; }\n"
        solve(tmp_path, turned, HELD.format(state), size=0.5)
    found = read_arrays(tmp_path / "out/solution.vtu")["PointData", "vonMises[pressure]"]
    np.testing.assert_allclose(found, exact, rtol=1e-9)


def test_axis_without_initial_strains(tmp_path):
    """Stresses below the contact leave initial strains out: refused."""
    told = part(tmp_path, STRIP.replace("SIZE", "1"), HELD.format("strain"), "-axis", 1, expect=10)
    assert "-axis: not with expand, preload or conduct" in told.stdout


def test_heat_in_space(tmp_path):
    """A bar that heat presses against a wall: E (alpha dT - gap/length), nothing across."""
    case = "body bar E 1000 nu 0.3\nobstacle top plane 0 0 4.002 0 0 -1\nsymmetry x\nsymmetry y\nsymmetry z\n"
    solve(tmp_path, BLOCK, f"{case}expand bar 1e-5 200\nstresses\n", scene="parts-3d")
    found = summary(tmp_path)
    assert found["contacts"][0]["normalForce"] == pytest.approx(1000 * (2e-3 - 5e-4), rel=1e-6)
    assert found["stresses"][0]["vonMises"] == pytest.approx(1.5, rel=1e-5)
    down = {one["name"]: one["force"] for one in found["supports"]}
    assert down["symmetry z"] == pytest.approx([0, 0, 1.5], abs=1e-5)


# ---------------------------------------------------------------- bolts

BOLT = data("engineer/bolt.geo")
JOINT = data("engineer/joint.case")
SHANK, SLEEVE = 1000 * 1 / 10, 500 * 1.5 / 10  # stiffnesses


def joint(load):
    """Tension of the shank and force on the seat: the joint diagram, with a rigid head."""
    tension = 20 + load * SHANK / (SHANK + SLEEVE)
    return (tension, tension - load) if tension > load else (load, 0.0)


def test_joint_diagram(tmp_path):
    """A bolt, tightened and loaded until the joint opens, step by step."""
    solve(tmp_path, BOLT, f"{JOINT}traction top 0 20\n", "-history", 1, "-steps", 6, "-vtu", 0)
    rows = rows_of(tmp_path / "out/series.csv")
    assert [float(row["traction top reaction"]) for row in rows] == pytest.approx([10, 20, 30, 40, 50, 60])
    for row in rows:
        found = float(row["preload cut force"]), float(row["seat under normal force"])
        assert found == pytest.approx(joint(float(row["traction top reaction"])), rel=1e-4, abs=1e-4)
    one = summary(tmp_path)["preloads"][0]
    assert one["shortened"] == pytest.approx(20 / SHANK + 20 / SLEEVE, rel=1e-6)
    assert one["force"] == pytest.approx(60, rel=1e-5)
    assert main(["curve", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out/curve.png").stat().st_size > 10000


def test_bolt_that_follows_a_force(tmp_path):
    """A force on the head's top, which it follows as one."""
    solve(tmp_path, BOLT, f"{JOINT}force top 0 9\n", "-vtu", 0)
    found = summary(tmp_path)
    assert found["preloads"][0]["force"] == pytest.approx(joint(9)[0], rel=1e-4)
    assert 0 < found["preloads"][0]["error"] < 1e-4 and found["preloads"][0]["shortenedError"] > 0


STRETCH = 1e-4 * 50 * 10  # of ten by heat
LATER = {  # loads after the preload: what they add to the force of ten in series, sleeve and shank
    "heat": ("expand sleeve 1e-4 50", STRETCH * SHANK * SLEEVE / (SHANK + SLEEVE)),
    "weight": ("weight sleeve 0 0.5", 0.5 * 15 / 2 * SHANK / (SHANK + SLEEVE)),
}


@pytest.mark.parametrize("load", LATER)
def test_a_preload_stays_under_later_loads(load, tmp_path):
    """Few points and no unknown motions: what the forces of the tightened bolt take must go with these forces."""
    line, more = LATER[load]
    solve(tmp_path, BOLT, f"{JOINT}{line}\n", "-vtu", 0)
    found = summary(tmp_path)
    assert found["preloads"][0]["force"] == pytest.approx(20 + more, rel=1e-5)
    assert found["contacts"][0]["normalForce"] == pytest.approx(20 + more, rel=1e-5)


CURVED = BOLT.replace(
    "Line(2) = {2, 9}; Line(3) = {9, 3};",
    "Point(31) = {-11.5, 2.5, 0}; Point(32) = {-11.5, 7.5, 0}; Circle(2) = {2, 31, 9}; Circle(3) = {9, 32, 3};",
)
HALVES = BOLT.replace('"shank") = {1, 2}', '"low") = {1}; Physical Surface("shank") = {2}')
ACROSS = -11.5 + np.sqrt(12.5**2 + 2.5**2 - np.linspace(-2.499, 2.499, 2500) ** 2)  # of the curved shank, above its cut
HEATED = {  # the case, and the weight between cut and seat; Poisson's ratios are not 0
    "halves": (HALVES, "state stress\nbody low E 700 nu 0.2\nsymmetry axis\n", 5.0),
    "curved": (CURVED, "state strain\nsymmetry axis\n", 5 * ACROSS.mean()),
    "ring": (CURVED, "state axisymmetric\n", 5 * np.pi * (ACROSS**2).mean()),
}


@pytest.mark.parametrize("shape", HEATED)
def test_tension_of_a_heated_shank(shape, tmp_path):
    """It is the seat's force less the weight between them, at each step: heat and weight grow with the load."""
    geo, case, weight = HEATED[shape]
    joint = case + JOINT.replace("state stress\n", "").replace("symmetry axis\n", "").replace("nu 0\n", "nu 0.3\n")
    solve(tmp_path, geo, f"{joint}expand shank 1e-4 50\nweight shank 0 -1\n", "-history", 1, "-steps", 2, "-vtu", 0)
    rows = rows_of(tmp_path / "out/series.csv")
    for row, share in zip(rows, (0.5, 1), strict=True):
        tension, seat = float(row["preload cut force"]), float(row["seat under normal force"])
        assert seat - tension == pytest.approx(share * weight, rel=2e-5)
    assert summary(tmp_path)["preloads"][0]["force"] == pytest.approx(tension, rel=1e-6)


BOLT_IN_SPACE = data("engineer/bolt-in-space.geo")


ROUND = re.sub(r"Box\((1|2)\) = {(.*?), 1, 1, 5};", r"Cylinder(\1) = {\2, 0, 0, 5, 1, Pi/2};", BOLT_IN_SPACE)
ROUND = ROUND.replace("level() = Surface In BoundingBox {1 - e,", "level() = Surface In BoundingBox {-e,")
ROUND = ROUND.replace(
    "seat();\nPhysical", "{seat(), Surface In BoundingBox {-e, -e, 10 - e, 1 + e, 2, 10 + e}};\nPhysical"
)


def test_tension_of_a_heated_shank_in_space(tmp_path):
    """Of elements that follow its round side, in front of the cut: the same balance; this mesh is 0.2 % thinner."""
    case = JOINT.replace("state stress\n", "").replace("nu 0\n", "nu 0.3\n").replace("axis\n", "axis\nsymmetry side\n")
    heated = f"{case}expand shank 1e-4 50\nweight shank 0 0 -1\n"
    solve(tmp_path, ROUND, heated, "-vtu", 0, "-estimate", 0, scene="parts-3d")
    found = summary(tmp_path)
    assert found["contacts"][0]["normalForce"] - found["preloads"][0]["force"] == pytest.approx(5 * np.pi / 4, rel=4e-3)


def test_bolt_in_space(tmp_path):
    """The same joint in space."""
    case = JOINT.replace("state stress\n", "").replace("symmetry axis\n", "symmetry axis\nsymmetry side\n")
    solve(tmp_path, BOLT_IN_SPACE, f"{case}traction top 0 0 3\n", "-vtu", 0, scene="parts-3d")
    found = summary(tmp_path)
    expected = joint(9)
    assert found["preloads"][0]["force"] == pytest.approx(expected[0], rel=1e-3)
    assert found["contacts"][0]["normalForce"] == pytest.approx(expected[1], rel=1e-3)


# ---------------------------------------------------------------- stresses


def fit(r, p, inner=100.0):
    """Von Mises' stress and displacement of hub and ring in plane strain at the radii r."""
    of_hub, of_ring = lame(inner, p, A, B), lame(p, 0, B, C)
    found = []
    for radius in r:
        (a, b), (modulus, nu) = (of_hub, HUB) if radius < B else (of_ring, OUTER)
        along, around, third = a - b / radius**2, a + b / radius**2, 2 * nu * a
        square = ((along - around) ** 2 + (around - third) ** 2 + (third - along) ** 2) / 2
        found.append((np.sqrt(square), moved(radius, (a, b), (modulus, nu), False)))
    return np.array(found).T


def test_stresses_of_lame(tmp_path):
    """Along a line and at the greatest, errors shall hold and not be ten times the stress's; fields shall be there."""
    case = f"{BODIES}contact bore seat interference 0.02\npressure inner 100\nline radius 7.2 7.2 21 21\n"
    done = solve(tmp_path, RING, case, size=2.5)
    p = seat_pressure(0.02, 100, False)
    table = line_of(tmp_path, "radius")
    radius = np.hypot(table["x"], table["y"])
    away = np.abs(radius - B) > 0.3
    exact = fit(radius[away], p)
    off = np.abs(table["vonMises"][away] - exact[0])
    assert (off <= table["vonMisesError"][away]).all()
    assert np.median(table["vonMisesError"][away] / exact[0]) < 0.05
    way = np.abs(np.hypot(table["ux"], table["uy"])[away] - exact[1])
    assert (way <= table["displacementError"][away] + 1e-9).all()
    for found, greatest in zip(summary(tmp_path)["stresses"], fit([A, B], p)[0], strict=True):
        assert abs(found["vonMises"] - greatest) <= found["error"] < 0.1 * greatest
        assert found["singular"] is None
    hub, ring = summary(tmp_path)["stresses"]
    inside = np.linspace(A, B, 2001)[:-1]
    above = np.trapezoid(inside * (fit(inside, p)[0] > 100), inside) / (0.5 * (B**2 - A**2))
    assert hub["above"] == pytest.approx(above, abs=0.02) and ring["above"] == 0
    assert "above the yield stress 100 in" in done.stdout and "nowhere above the yield stress 180" in done.stdout
    grid = (tmp_path / "out/solution.vtu").read_bytes()
    for name in ("XX", "YY", "ZZ", "XY", "1", "2", "3", "Scatter"):
        assert f'Name="stress{name}[pressure]"'.encode() in grid
    assert main(["line", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out/line-radius.png").stat().st_size > 10000
    assert main(["stress", str(tmp_path / "out"), "--slide"]) == 0
    with Image.open(tmp_path / "out/stress.png") as picture:
        assert picture.width / picture.height == pytest.approx(16 / 9, abs=0.01)


@pytest.mark.parametrize("bore", cases_of([False], [True]), ids=["pair", "rigid bore"])
def test_displacements_where_curves_end(tmp_path, bore):
    """A spline is off most beside its ends, here on symmetry planes: what lines say there, against Lame's."""
    held = "body hub E 200000 nu 0.3\nsymmetry below\nsymmetry left\nobstacle seat circle 0 0 R 20 inside\n"
    case = held if bore else f"{BODIES}contact bore seat interference 0.02\n"
    lines = f"line end 10 0 {20 if bore else 30} 0\nline other 0 10 0 {20 if bore else 30}\n"
    geometry = f"{RING}Transfinite Curve {{8}} = 6;"
    if bore:
        geometry = re.sub("Physical Surface.*", 'Physical Surface("hub") = 1;', RING).replace("{1, 5}", "1")
        geometry = geometry.replace("{3, 7}", "3")
    solve(tmp_path, geometry, f"{case}pressure inner 100\n{lines}", "-order", 4, size=3)
    assert summary(tmp_path)["contacts"][0]["force"] == [0, 0]  # across both planes
    at_bore = [moved(B, lame(100, p, A, B), HUB, False) for p in (0, 1)]
    p = at_bore[0] / (at_bore[0] - at_bore[1]) if bore else seat_pressure(0.02, 100, False)
    for name in ("end", "other"):
        table = line_of(tmp_path, name)
        radius = np.hypot(table["x"], table["y"])
        stress, way = fit(np.minimum(radius, B - 1e-9) if bore else radius, p)
        away = np.abs(radius - B) > 0.1
        assert (np.abs(np.hypot(table["ux"], table["uy"]) - way) <= table["displacementError"] + 1e-12)[away].all()
        assert (np.abs(table["vonMises"] - stress) <= table["vonMisesError"])[away].all()
        assert np.median(table["displacementError"] / way.max()) < 2e-2


BEAM = data("engineer/beam.geo")
PUSHED = data("engineer/pushed.case")


@pytest.mark.parametrize("order", [2, 4])
def test_stresses_of_a_cantilever(order, tmp_path):
    """Bending and shear across its middle, bending along its top; at the clamp's corners nothing is claimed."""
    done = solve(tmp_path, BEAM, PUSHED, "-order", order, size=0.5)
    inertia = 2 / 3
    across = line_of(tmp_path, "section")
    y = across["y"] - 1
    exact = np.sqrt((8 * y / inertia) ** 2 + 3 * ((1 - y**2) / (2 * inertia)) ** 2)
    assert (np.abs(across["vonMises"] - exact) <= across["vonMisesError"]).all()
    assert np.median(across["vonMisesError"]) < 0.1
    top = line_of(tmp_path, "top")
    there = (top["x"] > 3) & (top["x"] < 15)
    exact = (18 - top["x"][there]) / inertia
    assert (np.abs(top["vonMises"][there] - exact) <= top["vonMisesError"][there]).all()
    assert np.isinf(top["vonMisesError"][0])
    assert "no bound there" in done.stdout
    held = {one["name"]: one["force"] for one in summary(tmp_path)["supports"]}
    assert held["clamp wall"] == pytest.approx([0, 1], abs=1e-6)
    assert "clamp wall carries" in done.stdout


BELOW = data("engineer/below.geo")


def test_stresses_below_a_contact(tmp_path):
    """Hertz's line contact, down its axis: von Mises' stress, its greatest and the depth of that."""
    case = "body block E 1000 nu 0.3\nobstacle face circle 0 10 R 10 force 0 -1\nclamp base\nline axis 0 0 0 -0.4\n"
    solve(tmp_path, BELOW, case, "-vtu", 0, size=0.03)
    half = np.sqrt(4 * 10 / (np.pi * 1000 / 0.91))
    peak = 2 / (np.pi * half)
    table = line_of(tmp_path, "axis")
    depth = -table["y"]
    root = np.sqrt(half**2 + depth**2)
    along, down = -peak / half * ((half**2 + 2 * depth**2) / root - 2 * depth), -peak * half / root
    third = 0.3 * (along + down)
    exact = np.sqrt(((along - down) ** 2 + (down - third) ** 2 + (third - along) ** 2) / 2)
    assert (np.abs(table["vonMises"] - exact) <= table["vonMisesError"] + 1e-3 * peak).all()
    assert np.median(table["vonMisesError"]) < 0.03 * peak
    found = summary(tmp_path)["stresses"][0]
    assert abs(found["vonMises"] - exact.max()) <= found["error"] + 1e-3 * peak < 0.1 * peak
    assert -found["at"][1] / half == pytest.approx(0.7, abs=0.15)  # at a node


# ---------------------------------------------------------------- what is asked for


@pytest.mark.parametrize(
    "line, words",
    [
        ("preload cut -1", "out of range"),
        ("expand cut 1 1", "allowed for expand: its surfaces"),
        ("expand head 1e-5", "the change of temperature is missing"),
        ("line a b 0 0 1 1", "no number"),
        ("line a 0 0 0 0", "begins where it ends"),
        ("line a/b 0 0 1 1", "letters, digits"),
    ],
)
def test_refused_as_read(line, words, tmp_path):
    (tmp_path / "part.geo").write_text(BOLT)
    code, why, _ = read(tmp_path, f"{JOINT}{line}\n".replace("preload cut 20\n", ""), "part.geo")
    assert code == 3 and words in why and "\n" not in why


def test_refused_by_the_run(tmp_path):
    done = solve(tmp_path, BOLT, JOINT.replace("cut 20", "seat 20"), expect=10)
    assert "on the boundary" in done.stdout and len(done.stdout.strip().splitlines()) == 1


def test_help_in_two_parts():
    """The user's flags, then all."""
    short, whole = (run_in(ROOT, "edp/parts.edp", "-help", *more).stdout for more in ([], ["all"]))
    assert "-accuracy" in short and "-axis" in short and "-preconditioner" not in short and "-help all" in short
    assert "-preconditioner" in whole and "-method" in whole


def test_sweep(tmp_path, monkeypatch, capsys):
    """Runs side by side, goes on with what is missing, and refuses what belongs to another sweep."""
    (tmp_path / "part.geo").write_text(RING.replace("SIZE", "6"))
    (tmp_path / "part.case").write_text(
        f"{BODIES}contact bore seat interference 0.02   # nominal\n".replace("yield 100", "")
    )
    monkeypatch.chdir(tmp_path)
    words = ["sweep", "part.geo", "part.case", "--out", "all", "--flags=-estimate 0"]

    def sweep(number, *values, expect=0):
        code = main([*words, "--number", number, "--values", *values])
        said = "".join(capsys.readouterr())
        assert code == expect, said
        return said

    number = "contact bore seat interference *"
    command = [sys.executable, "-m", "postprocess", *words, "--number", number, "--values", "0.01:0.02:2"]
    bare = {"PYTHONPATH": str(ROOT), "PATH": "/usr/bin:/bin"}
    first = subprocess.run(command, env=bare, capture_output=True, text=True)
    assert first.returncode == 0 and "0 of 2 runs are there" in first.stdout + first.stderr, first
    assert "2 of 3 runs are there" in sweep(number, "0.01", "0.02", "0.03")
    rows = rows_of(tmp_path / "all/sweep.csv")
    forces = [float(row["bore seat normal force"]) for row in rows]
    assert forces == pytest.approx([forces[0] * k for k in (1, 2, 3)], rel=1e-6)
    assert (tmp_path / "all/sweep.png").stat().st_size > 10000
    assert "another sweep" in sweep("body hub E *", "1", expect=2)
    assert "0 lines begin" in sweep("force grip 0 *", "1", expect=2)
    assert re.search(r"allowed: numbers", sweep(number, "a", expect=2))


SPOILS = {
    "summary.json": [
        *("null contacts", "text contacts", "no parameters", "null given", "number estimates", "no stresses"),
        *("binary", "pipe", "folder", "half"),
    ],
    "contact.csv": ["binary", "pipe", "folder", "half"],
    "solution.vtu": ["binary", "pipe", "folder", "half"],
    "sweep.json": ["binary", "half", "pipe", "folder"],
}


@pytest.mark.parametrize("name", SPOILS)
def test_spoilt_results(name, tmp_path, monkeypatch, capsys):
    """Commands shall say in one line that a folder's files are spoilt: no traceback, no escape code, no waiting."""
    case = f"{BODIES}contact bore seat interference 0.02\nstresses\n"
    whole = tmp_path / "out"
    if name == "sweep.json":
        whole.mkdir()
        (whole / name).write_text('{"mesh": 1}')
        (tmp_path / "a.geo").write_text("")
        (tmp_path / "a.case").write_text(case)
    else:
        part(tmp_path, RING.replace("SIZE", "6"), case, "-estimate", 0, "-vtu", 1)
    content = (whole / name).read_bytes()
    monkeypatch.chdir(tmp_path)
    sweep = ["sweep", "a.geo", "a.case", "--number", "body ring E *", "--values", "1", "--out"]
    commands = [sweep] if name == "sweep.json" else [["state"], ["stress"], ["show"], ["compare", whole]]
    commands += [["report", "--out", tmp_path / "r.html"]] * (name != "sweep.json")
    for spoil in SPOILS[name]:
        shutil.rmtree(tmp_path / "run", ignore_errors=True)
        shutil.copytree(whole, tmp_path / "run")
        path = tmp_path / "run" / name
        path.unlink()
        if spoil == "pipe":
            os.mkfifo(path)
        elif spoil == "folder":
            path.mkdir()
        elif spoil == "binary":
            path.write_bytes(b"\x1b[31m\xbf\x00\n" * 50)
        elif spoil == "half":
            path.write_bytes(content[: len(content) // 2])
        else:
            summary = json.loads(content)
            word, key = spoil.split()
            summary[key] = {"null": None, "text": "\x1b[31m", "no": [{}], "number": 3}[word]
            path.write_text(json.dumps(summary))
        for command in commands:
            code = main([*map(str, command), str(tmp_path / "run")])
            said = capsys.readouterr().err
            assert code in (0, 2) and "\x1b" not in said and said.count("\n") == (code == 2), (command, spoil, said)
            assert code == 0 or name in said, (command, spoil, said)  # the file that is at fault


# ---------------------------------------------------------------- what motions need, how long contacts are


RINGS = """
SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 5}; Disk(2) = {0, 0, 0, 1}; BooleanDifference(3) = {Surface{1}; Delete;}{Surface{2}; Delete;};
Disk(4) = {0, 0, 0, 8}; Disk(5) = {0, 0, 0, 5}; BooleanDifference(6) = {Surface{4}; Delete;}{Surface{5}; Delete;};
Mesh.MeshSizeMax = SIZE; Mesh.MeshSizeMin = SIZE;
"""
TWISTED = data("engineer/twisted.case")


@pytest.mark.parametrize("friction, angle", [(0.9, 0.005), (0.05, 0.02)], ids=["sticks", "slips"])
def test_moment_of_a_rotation(tmp_path, friction, angle):
    """What turns a ring on a shaft: by both rings' shear where all sticks, else by friction's share of what presses."""
    solve(tmp_path, RINGS, TWISTED.format(friction, angle), "-vtu", 0, size=1.2)
    shear, lame1 = 1000 / 2.6, 1000 * 0.3 / 1.3 / 0.4

    def stiffness(held, radius):  # of u = a (r - held^2/r) at `radius`: pressure over displacement
        return (2 * (lame1 + shear) + 2 * shear * held**2 / radius**2) / abs(radius - held**2 / radius)

    pressure = 0.005 / (1 / stiffness(1, 5) + 1 / stiffness(8, 5))
    moment = 4 * np.pi * shear * angle / (1 - 1 / 64) if friction == 0.9 else friction * pressure * 2 * np.pi * 25
    found = summary(tmp_path)["prescribed"][0]
    assert abs(found["moment"] - moment) <= found["error"] < 0.1 * moment


DISC = data("engineer/disc.geo")


ALONE = f"""{DISC[: DISC.index("Point(11)")]}Physical Surface("disc") = 1; Physical Curve("round") = {{1, 2}};
Physical Curve("flat") = {{3}};"""


@pytest.mark.parametrize(
    "friction, other",
    cases_of([("", "base"), (" friction 0.3", "obstacle")], [("", "obstacle"), (" friction 0.3", "base")]),
)
def test_what_several_motions_need(tmp_path, friction, other):
    """What two motions need is what passes through the contact between: the same number, and the same error."""
    case = f"body disc E 1000 nu 0.3\nbody block E 2000 nu 0.3\ncontact round top{friction}\nmove base 0 0.1\n"
    if other == "obstacle":
        case = f"body disc E 0.01 nu 0.3\nobstacle round circle 0 -20 R 20 move 0 0.1{friction}\n"
        case += "weight disc 0 -1e-14\n"  # as good as none
    done = solve(tmp_path, DISC if other == "base" else ALONE, f"{case}move flat 0 -0.1\n", "-vtu", 0, size=0.3)
    run = summary(tmp_path)
    contact = run["estimates"]["contacts"][0]["force"]
    needs = [found for found in run["prescribed"] if "weight" not in found["name"]]
    assert len(needs) == 2
    for found in needs:
        assert abs(found["force"]) == pytest.approx(contact["value"], rel=1e-6)
        assert found["error"] == pytest.approx(contact["error"], rel=0.01)
    assert re.search("move flat: force +[0-9.]+ ± ", done.stdout)
    if run["linearised"]:
        force, *others = (
            change["change"] for change in run["linearised"]["changes"] if change["kind"] in ("force", "needed")
        )
        assert np.abs(others) == pytest.approx(abs(force), rel=1e-3) and force != 0


FLAT = data("engineer/flat.geo")


@pytest.mark.parametrize(
    "pull, length, least, most", cases_of([(0, 10, 1e-14, 1e-8), (3.1, 9.96, 0.1, 0.5)], [(3.05, 10, 0.1, 0.5)])
)
def test_length_of_a_flat_face(tmp_path, pull, length, least, most):
    """A face that presses all over is known to rounding, not where a corner is about to lift, or just has."""
    case = "body upper E 1000 nu 0.3\nbody block E 1e5 nu 0.3\ncontact foot top friction 0.9\nclamp base\n"
    solve(tmp_path, FLAT, f"{case}traction head {pull} -10\n", "-vtu", 0, size=1)
    found = summary(tmp_path)["estimates"]["contacts"][0]["contactLength"]
    assert abs(found["value"] - length) <= found["error"] and least < found["error"] < most


def test_sweep_of_changed_files(tmp_path, monkeypatch, capsys):
    """A run is done anew when a law's table or a file that the geometry includes has changed, and kept otherwise."""
    (tmp_path / "part.geo").write_text('Include "shapes/ring.geo";\n')
    (tmp_path / "shapes").mkdir()
    shape, law = tmp_path / "shapes/ring.geo", tmp_path / "law.csv"
    shape.write_text(RING.replace("SIZE", "6"))
    law.write_text("0,0\n0.02,1\n0.05,10\n0.5,500\n")
    contact = "contact bore seat law table law.csv d0 -0.05 interference 0.02\n"
    (tmp_path / "part.case").write_text(BODIES.replace("yield 100", "") + contact)
    monkeypatch.chdir(tmp_path)
    words = ["sweep", "part.geo", "part.case", "--out", "all", "--flags=-estimate 0", "--values", "210000"]

    def sweep(there):
        assert main([*words, "--number", "body ring E *"]) == 0, (tmp_path / "all/210000.log").read_text()
        assert f"{there} of 1 runs are there" in capsys.readouterr().out
        summary = json.loads((tmp_path / "all/210000/summary.json").read_text())
        return summary["contacts"][0]["normalForce"], summary["ndof"]

    first = sweep(0)
    assert sweep(1) == first
    law.write_text(law.read_text().replace("0.02,1", "0.02,2"))
    other = sweep(0)
    assert abs(other[0] / first[0] - 1) > 0.01 and other[1] == first[1]
    shape.write_text(RING.replace("SIZE", "5"))
    assert sweep(0)[1] > first[1]
