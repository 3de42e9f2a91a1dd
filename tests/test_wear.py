"""Archard wear: exact discrete and steady solutions, the volume, the steps' error, profiles that are read back, refusals."""

import csv

import numpy as np
import pytest
from freefem import part, run_in
from test_parts import Mesh, block, cube, read

from postprocess.closed_forms import plane_modulus

PUNCHED = """size = {size};
Point(1) = {{0, 0, 0, 2}}; Point(2) = {{20, 0, 0, 2}}; Point(3) = {{20, 20, 0, 2}}; Point(4) = {{4, 20, 0, size}}; Point(5) = {{0, 20, 0, size}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 5}}; Line(5) = {{5, 1}};
Curve Loop(1) = {{1 : 5}}; Plane Surface(1) = {{1}};
Physical Surface("block") = {{1}}; Physical Curve("bottom") = {{1}}; Physical Curve("top") = {{4}};
Physical Curve("axis") = {{5}}; Physical Curve("side") = {{2}}; Physical Curve("free") = {{3}};
"""
HELD = "body block E 1000 nu 0.3\nclamp bottom\nsymmetry axis\n"
FLAT = HELD + "obstacle top plane 0 20 0 -1 force 0 -50 wear 1e-4 slide 10{}\ncycles {} steps {}\n"
BALL = "state axisymmetric\nbody block E 1e5 nu 0.3\nclamp bottom\nsymmetry axis\n"
BALL += "obstacle top circle 0 120 R 100 force 0 -50 wear 1e-6 slide 10\ncycles {} steps {}\n"
COLUMN = "body block E 100 nu 0.3\nsymmetry left\nsymmetry right\nsymmetry bottom\n"
COLUMN += "obstacle top plane 0 2 0 -1 move 0 -0.02 wear {} slide {}\ncycles {} steps {}\n"


def worn(run, contact=0):
    """The entry of a contact that wears."""
    return run.summary["wear"]["contacts"][contact]


def rows(run, name="worn.csv"):
    """A table of results as {column: values}."""
    with open(run.folder / name) as lines:
        table = list(csv.DictReader(lines))
    return {key: np.array([float(row[key]) for row in table]) for key in table[0]}


def test_column(tmp_path):
    """A confined column under a prescribed approach: each implicit step divides the pressure by 1 + k ds E/H, exactly."""
    k, slide, cycles, steps = 2e-4, 5, 30, 12
    run = part(tmp_path, block(Mesh(), cells=(6, 4)).text(), COLUMN.format(k, slide, cycles, steps), "-tol", 1e-10)
    stiffness = 100 * 0.7 / (1.3 * 0.4) / 2
    shrinks = 1 + k * slide * cycles / steps * stiffness
    left = 0.02 * shrinks ** -np.arange(steps + 1.0)
    table = rows(run, "wear.csv")
    assert table["cycles"] == pytest.approx(np.linspace(0, cycles, steps + 1))
    assert table["depth"] == pytest.approx(0.02 - left, abs=1e-11)
    assert table["pressureMax"] == pytest.approx(stiffness * left, rel=1e-8)
    assert table["volume"] == pytest.approx(3 * (0.02 - left), abs=1e-11)
    assert rows(run)["depth"] == pytest.approx(0.02 - left[-1], abs=1e-11)
    assert run.contact["pressure"] == pytest.approx(stiffness * left[-1], rel=1e-7)
    assert (run.contact["status"] == 2).all()  # hard contact on the worn profile
    limit = 0.02 * (1 - np.exp(-k * slide * cycles * stiffness))
    assert abs(worn(run)["depth"]["value"] - limit) < worn(run)["depth"]["error"] < 0.1 * limit
    assert run.summary["factorisations"] == 1 and run.summary["newton"] <= 3 * steps


def test_punch(tmp_path):
    """A flat punch: the volume is k F s; at last the pressure is uniform, and the profile that of the loaded surface."""
    run = part(tmp_path, PUNCHED.format(size=0.25), FLAT.format("", 400, 20))
    table = rows(run, "wear.csv")
    assert table["volume"] == pytest.approx(1e-4 * 10 * 50 * table["cycles"], rel=1e-10)
    assert table["pressureMax"][0] > 2 * 50 / 4 and table["pressureMax"][-1] < 1.001 * 50 / 4
    assert run.contact["pressure"] == pytest.approx(50 / 4, rel=1e-3)
    assert "    worn depth " in run.stdout and "error of the mesh not known" in run.stdout
    loaded = HELD + "pressure top 12.5\nobstacle side plane 30 0 -1 0\nline surface 0 20 4 20\n"
    line = rows(part(tmp_path / "loaded", PUNCHED.format(size=0.25), loaded, "-estimate", 0), "line-surface.csv")
    profile = rows(run)
    order = np.argsort(profile["x"])
    x, depth = profile["x"][order], profile["depth"][order]
    sinks = np.interp(x, line["x"], line["uy"])
    bulge = np.ptp(sinks)
    inner = x < 3.9
    assert (depth - sinks)[inner] == pytest.approx((depth - sinks)[0], abs=5e-3 * bulge)
    assert bulge == pytest.approx(4 * 12.5 * 4 * np.log(2) / (np.pi * plane_modulus(1000, 0.3)), rel=0.3)  # a half-plane's


def test_ball(tmp_path):
    """A stiff ball: h = sqrt(k F s/(pi R)), in ten steps and in a hundred; the error holds their difference."""
    runs = [part(tmp_path / f"{n}", PUNCHED.format(size=0.1), BALL.format(1000, n)) for n in (8, 80)]
    closed = np.sqrt(1e-6 * 10 * 1000 * 50 / (np.pi * 100))
    few, many = (worn(run)["depth"] for run in runs)
    assert many["value"] == pytest.approx(closed, rel=6e-3)
    assert abs(few["value"] - many["value"]) < min(few["error"], 1e-3 * closed)
    assert worn(runs[1])["volume"]["value"] == pytest.approx(1e-6 * 10 * 1000 * 50, rel=1e-3)
    assert abs(worn(runs[0])["pressureMax"]["value"] - worn(runs[1])["pressureMax"]["value"]) < worn(runs[0])["pressureMax"]["error"]


def test_goes_on(tmp_path):
    """A run from the profile of another one ends as one run of all cycles; on another mesh the volume stays."""
    whole = part(tmp_path / "whole", PUNCHED.format(size=0.5), FLAT.format("", 40, 8), "-tol", 1e-10)
    first = part(tmp_path / "first", PUNCHED.format(size=0.5), FLAT.format("", 20, 4), "-tol", 1e-10)
    file = f" from {first.folder / 'worn.csv'}"
    second = part(tmp_path / "second", PUNCHED.format(size=0.5), FLAT.format(file, 20, 4), "-tol", 1e-10)
    assert rows(second)["depth"] == pytest.approx(rows(whole)["depth"], rel=1e-8)
    other = part(tmp_path / "other", PUNCHED.format(size=0.3), FLAT.format(file, 1e-9, 1))
    assert worn(other)["volume"]["value"] == pytest.approx(worn(first)["volume"]["value"], rel=1e-3)
    assert worn(other)["volume"]["error"] is None and "error not known" in other.stdout
    assert other.summary["wear"]["stepsError"].startswith("not known: an odd number of wear steps")


# ---------------------------------------------------------------- slip

FRETTED = """size = {size};
Point(1) = {{-20, 0, 0, 4}}; Point(2) = {{20, 0, 0, 4}}; Point(3) = {{20, 20, 0, 4}}; Point(4) = {{1, 20, 0, size}};
Point(5) = {{-1, 20, 0, size}}; Point(6) = {{-20, 20, 0, 4}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 5}}; Line(5) = {{5, 6}}; Line(6) = {{6, 1}};
Curve Loop(1) = {{1 : 6}}; Plane Surface(1) = {{1}};
Physical Surface("block") = {{1}}; Physical Curve("bottom") = {{1}}; Physical Curve("top") = {{4}}; Physical Curve("free") = {{2, 3, 5, 6}};
"""
FRETTING = "body block E 1e4 nu 0.49\nclamp bottom\ncycles {} steps {}\n"
FRETTING += "obstacle top circle 0 120 R 100 move 0 -0.012 friction 0.5 wear 1e-6\nleg 2\n"
CYCLE = "leg 4\nobstacle top move 0.005 -0.012\nleg 6\nobstacle top move -0.005 -0.012\nleg 4\nobstacle top move 0 -0.012\n"


@pytest.mark.long
def test_partial_slip(tmp_path):
    """The worn profile of a cycle is that of Cattaneo and Mindlin, k times pressure times slip; its volume k/mu times the energy."""
    run = part(tmp_path, FRETTED.format(size=0.08), FRETTING.format(100, 1) + CYCLE, "-estimate", 0)
    profile = rows(run)
    shear, force = np.abs(rows(run, "series.csv")["shearForce"]).max(), run.summary["contacts"][0]["normalForce"]
    modulus, x = plane_modulus(1e4, 0.49), np.abs(profile["x"])
    half = np.sqrt(4 * force * 100 / (np.pi * modulus))
    stick, peak = half * np.sqrt(1 - shear / (0.5 * force)), 2 * force / (np.pi * half)
    t = np.clip(x, stick, half)
    slip = 0.5 * peak / (modulus * half) * (t * np.sqrt(t**2 - stick**2) - stick**2 * np.arccosh(t / stick))
    depth = 100 * 1e-6 * peak * np.sqrt(1 - (t / half) ** 2) * 4 * slip
    assert np.abs(profile["depth"] - depth)[x < 0.95 * half].max() < 0.08 * depth.max()
    assert (profile["depth"][(x > half + 0.05) | (x < stick - 0.1)] == 0).all()
    volume = worn(run)["volume"]["value"]
    assert volume == pytest.approx(0.04 * depth.sum(), rel=0.01)
    assert volume == pytest.approx(100 * 1e-6 / 0.5 * run.summary["contacts"][0]["dissipated"], rel=3e-3)
    assert worn(run)["slide"] is None and "error of the wear steps not known" in run.stdout


@pytest.mark.long
def test_fretting_steps(tmp_path):
    """The slip zone loses its pressure; the steps' error holds the difference; a step that is too long is refused by name."""
    mesh, cycles = FRETTED.format(size=0.16), 8000
    few, many = (part(tmp_path / f"{n}", mesh, FRETTING.format(cycles, n) + CYCLE) for n in (4, 8))
    assert abs(worn(few)["depth"]["value"] - worn(many)["depth"]["value"]) < worn(few)["depth"]["error"]
    assert abs(worn(few)["volume"]["value"] - worn(many)["volume"]["value"]) < worn(few)["volume"]["error"]
    assert worn(few)["depth"]["error"] < 0.3 * worn(few)["depth"]["value"]
    deepest = rows(many)["depth"].argmax()
    plain = part(tmp_path / "plain", mesh, (FRETTING + CYCLE).format(1, 1).replace(" wear 1e-6", "").replace("cycles 1 steps 1\n", ""))
    assert many.contact["pressure"][deepest] < 0.9 * plain.contact["pressure"][deepest]
    long = part(tmp_path / "long", mesh, FRETTING.format(100 * cycles, 1) + CYCLE, expect=20)
    assert "cycles is too long for this mesh: use cycles 800000 steps " in long.stdout
