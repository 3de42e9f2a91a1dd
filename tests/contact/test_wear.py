"""Archard wear: exact discrete and steady solutions, the volume, the steps' error, profiles read back, refusals."""

import csv
import sys

import numpy as np
import pytest
from freefem import ROOT, cases_of, execute, part
from input.test_parts import Mesh, block, cube, groups, stack
from reader import Refusal, Where, read_case

from postprocess.closed_forms import plane_modulus

PUNCHED = """size = {size};
Point(1) = {{0, 0, 0, 2}}; Point(2) = {{20, 0, 0, 2}}; Point(3) = {{20, 20, 0, 2}};
Point(4) = {{4, 20, 0, size}}; Point(5) = {{0, 20, 0, size}};
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
    """A confined column under a prescribed approach: each step divides the pressure by 1 + k ds E/H, exactly."""
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
    # the force that is left, whose steps are as wrong as the depth's of what remains
    left = 3 * stiffness * 0.02 * np.exp(-k * slide * cycles * stiffness)
    force = worn(run)["normalForce"]
    assert abs(force["value"] - left) < force["error"] and force["value"] == pytest.approx(
        run.contact["pressure"][0] * 3
    )
    (line,) = (line for line in run.stdout.splitlines() if "normal force  " in line)
    assert "by the wear steps" in line and ("error not known" in line or " ± " in line)
    assert any("raise the number of steps after cycles" in text for text in run.summary["warnings"])
    limit = 0.02 * (1 - np.exp(-k * slide * cycles * stiffness))
    assert abs(worn(run)["depth"]["value"] - limit) < worn(run)["depth"]["error"] < 0.1 * limit
    assert run.summary["factorisations"] == 1 and run.summary["newton"] <= 3 * steps


def test_stack(tmp_path):
    """Two confined blocks of different meshes wear on each other, as two springs in series."""
    case = "body block E 100 nu 0.3\nbody upper E 50 nu 0.3\nsymmetry bottom\nsymmetry left\nsymmetry right\n"
    case += 'symmetry "upper left"\nsymmetry "upper right"\nmove "upper top" 0 -0.02\n'
    case += 'contact top "upper bottom" wear 2e-3 slide 4\ncycles 6 steps 3\n'
    run = part(tmp_path, stack(), case, "-order", 1, "-tol", 1e-10)
    modulus = 0.7 / (1.3 * 0.4)
    stiffness = 1 / (1 / (100 * modulus) + 1 / (50 * modulus))
    depth = 0.02 * (1 - (1 + 2e-3 * 4 * 2 * stiffness) ** -3)
    assert rows(run)["depth"] == pytest.approx(depth, rel=1e-6)
    assert run.summary["wear"]["contacts"][0]["coefficient"] == 2e-3


def test_punch(tmp_path):
    """A flat punch: the volume is k F s; at last the pressure is uniform, the profile that of the loaded surface."""
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
    assert bulge == pytest.approx(
        4 * 12.5 * 4 * np.log(2) / (np.pi * plane_modulus(1000, 0.3)), rel=0.3
    )  # a half-plane's


def test_ball(tmp_path):
    """A stiff ball: h = sqrt(k F s/(pi R)), in ten steps and in a hundred; the error holds their difference."""
    runs = [part(tmp_path / f"{n}", PUNCHED.format(size=0.1), BALL.format(1000, n)) for n in (8, 80)]
    closed = np.sqrt(1e-6 * 10 * 1000 * 50 / (np.pi * 100))
    few, many = (worn(run)["depth"] for run in runs)
    assert many["value"] == pytest.approx(closed, rel=6e-3)
    assert abs(few["value"] - many["value"]) < min(few["error"], 1e-3 * closed)
    assert worn(runs[1])["volume"]["value"] == pytest.approx(1e-6 * 10 * 1000 * 50, rel=1e-3)
    assert (
        abs(worn(runs[0])["pressureMax"]["value"] - worn(runs[1])["pressureMax"]["value"])
        < worn(runs[0])["pressureMax"]["error"]
    )


def test_goes_on(tmp_path):
    """A run from the profile of another one ends as one run of all cycles; on another mesh the volume stays."""
    whole = part(tmp_path / "whole", PUNCHED.format(size=0.5), FLAT.format("", 40, 8), "-tol", 1e-10)
    first = part(tmp_path / "first", PUNCHED.format(size=0.5), FLAT.format("", 20, 4), "-tol", 1e-10)
    file = f" from {first.folder / 'worn.csv'}"
    second = part(tmp_path / "second", PUNCHED.format(size=0.5), FLAT.format(file, 20, 4), "-tol", 1e-10)
    assert rows(second)["depth"] == pytest.approx(rows(whole)["depth"], rel=1e-8)
    other = part(tmp_path / "other", PUNCHED.format(size=0.3), FLAT.format(file, 1e-9, 1))
    assert worn(other)["volume"]["value"] == pytest.approx(worn(first)["volume"]["value"], rel=1e-3)
    assert "the worn depth is " not in other.stdout
    deep = part(tmp_path / "deep", PUNCHED.format(size=0.5), FLAT.format("", 4000, 1), "-order", 1)
    assert "the worn depth is " in deep.stdout and "only gaps wear, not the mesh" in deep.stdout
    assert worn(other)["volume"]["error"] is None and "error not known" in other.stdout
    assert other.summary["wear"]["stepsError"].startswith("not known: an odd number of wear steps")


def test_two_contacts(tmp_path):
    """Only the contact with wear loses material; the screen says what wears, wear.csv has a row for each."""
    case = HELD + "obstacle top plane 0 20 0 -1 force 0 -50 wear 1e-4 slide 10\n"
    case += "obstacle free plane 0 20.5 0 -1\ncycles 6 steps 2\n"
    run = part(tmp_path, PUNCHED.format(size=0.5), case, "-order", 1)
    assert [worn(run, k)["volume"]["value"] for k in (0, 1)] == [pytest.approx(1e-4 * 10 * 6 * 50, rel=1e-10), 0]
    assert run.stdout.count("    worn depth ") == 1
    assert "  wear      top: 0.0001, sliding distance of a cycle 10\n  cycles    6 in 2 wear steps\n" in run.stdout
    table, profile = rows(run, "wear.csv"), rows(run)
    assert (table["contact"] == [0, 1] * 3).all() and (table["depth"][1::2] == 0).all()
    assert (profile["depth"][profile["contact"] == 1] == 0).all() and (
        profile["depth"][profile["contact"] == 0] > 0
    ).all()
    picture = execute([sys.executable, "-m", "postprocess", "wear", str(run.folder)])
    assert picture[0] == 0 and (run.folder / "wear.png").exists(), picture[1]


def test_other_units(tmp_path):
    """In millimetres and in metres, and with an interference in place of a motion, the depths are the same lengths."""
    case = "state axisymmetric\nbody block E {} nu 0.3\nclamp bottom\nsymmetry left\n"
    case += "obstacle top circle 0 {} R {} {} wear {} slide {}\ncycles 1000 steps 4\n"
    mesh = block(Mesh(), size=(4, 4), cells=(24, 12))
    run = part(tmp_path / "mm", mesh.text(), case.format(1e5, 104, 100, "move 0 -0.02", 1e-6, 10))
    metres = mesh.text(1e-3 * np.eye(3))
    for name, pressed in (("m", "move 0 -2e-5"), ("fit", "interference 2e-5")):
        other = part(tmp_path / name, metres, case.format(1e11, 0.104, 0.1, pressed, 1e-12, 0.01))
        for key, scale in (("depth", 1e-3), ("volume", 1e-9), ("pressureMax", 1e6)):
            limit = 1e-5 if name == "m" else 1e-2  # an interference is along the normals
            assert worn(other)[key]["value"] == pytest.approx(scale * worn(run)[key]["value"], rel=limit), (name, key)


def test_in_space(tmp_path):
    """A confined box in space: as the column; its profile is read back on the same mesh only."""
    case = "body block E 100 nu 0.3\nsymmetry left\nsymmetry right\nsymmetry front\nsymmetry back\nsymmetry bottom\n"
    case += "obstacle top plane 0 0 1 0 0 -1 move 0 0 -0.01 wear 1e-3 slide 2{}\ncycles 10 steps 4\n"
    meshes = [cube(Mesh(), cells=cells).text() for cells in ((3, 3, 2), (2, 2, 2))]
    first = part(tmp_path / "first", meshes[0], case.format(""), "-order", 1, "-tol", 1e-10, space=True)
    stiffness = 100 * 0.7 / (1.3 * 0.4)
    shrinks = (1 + 1e-3 * 2 * 10 / 4 * stiffness) ** -4
    assert rows(first)["depth"] == pytest.approx(0.01 * (1 - shrinks), rel=1e-7)
    assert worn(first)["volume"]["value"] == pytest.approx(4 * 0.01 * (1 - shrinks), rel=1e-7)
    again = case.format(f" from {first.folder / 'worn.csv'}")
    second = part(tmp_path / "second", meshes[0], again, "-order", 1, "-tol", 1e-10, space=True)
    assert rows(second)["depth"] == pytest.approx(0.01 * (1 - shrinks**2), rel=1e-7)
    other = part(tmp_path / "other", meshes[1], again, "-order", 1, space=True, expect=10)
    assert "the profile does not reach the point (" in other.stdout and "on the same mesh" in other.stdout


# ---------------------------------------------------------------- refusals

PLAIN = "body block E 100 nu 0.3\nclamp bottom\n"
REFUSED = {  # @: an obstacle
    "@ wear 1e-6\ncycles 1": "wear: no sliding distance and no friction; allowed: wear K slide S",
    "@ wear 0 slide 1\ncycles 1": "0: the wear coefficient is out of range; allowed: above 0",
    "@ wear 1e-6 slide -1\ncycles 1": "-1: the sliding distance of a cycle is out of range",
    "@ wear 1e-6 slide\ncycles 1": "the sliding distance of a cycle is missing after slide",
    "@ wear 1e-6 slide 1": "wear without cycles; allowed: a line cycles N",
    "@\ncycles 1": "cycles without wear; allowed: wear K slide S",
    "@ wear 1e-6 slide 1\ncycles 0": "0: the number of cycles is out of range; allowed: above 0",
    "@ wear 1e-6 slide 1\ncycles 5 steps 2.5": "2.5: no whole number of wear steps",
    "@ wear 1e-6 slide 1\ncycles 5 in 2": "in: more than the statement takes; allowed: cycles NUMBER",
    "@ wear 1e-6 slide 1\ncycles 5\ncycles 6": "cycles: stated before",
    "@ law power kappa 1 m 2 d0 -1 wear 1e-6 slide 1\ncycles 1": "wear: with the law power",
    "@ wear 1e-6 slide 1 from no.csv\ncycles 1": "no.csv: no such file; allowed: the worn.csv of a run",
    "@ wear 1e-6 slide 1 from\ncycles 1": "the file of a worn profile is missing",
    "@ friction 0.3 wear 1e-6 slide 1\ncycles 1": "wear: slide with friction, whose slip is computed",
    "@ friction 0.3 wear 1e-6\ncycles 1": "wear by friction without a cycle",
    "@ friction 0.3 wear 1e-6\nobstacle left plane 0 0 1 0 wear 1e-6 slide 1\ncycles 1\nleg 1\nleg 1": "one kind",
    "contact left right gap vertical wear 1e-6 slide 1\ncycles 1": "left: gap vertical with wear: depth and pressure",
    "wear top 1e-6": "wear: unknown statement; it stands behind a contact or an obstacle",
}


def refusal(lines, **where):
    with pytest.raises(Refusal) as found:
        read_case(PLAIN + lines.replace("@", "obstacle top plane 0 2 0 -1") + "\n", Where(**where), groups(0))
    return found.value.text("a.case")


@pytest.mark.parametrize("lines, words", list(REFUSED.items()))
def test_refused(lines, words):
    """Each mistake in a case: one line with the file, the line, and what is allowed."""
    why = refusal(lines)
    assert words in why and "allowed" in why and "\n" not in why


def test_not_read_elsewhere():
    """A script without the option refuses wear."""
    assert "wear: read by parts.edp and parts-3d.edp alone" in refusal("@ wear 1e-6 slide 1\ncycles 1", wear=False)


WORE = PLAIN + "obstacle top plane 0 2 0 -1 move 0 -0.01 wear 1e-6 slide 1{}\ncycles 1 steps 2\n"
SLIPPED = PLAIN + "obstacle top plane 0 2 0 -1 move 0 -0.01 friction 0.1 wear 1e-6\ncycles 1\nleg 1\nleg 1\n"
SLIPPED += "obstacle top move 0.01 -0.01\n"
COMBINED = [
    (WORE.format(""), ["-accuracy", 0.1], "-accuracy 0.1: not with wear"),
    (WORE.format(""), ["-method", "paper"], "-method paper: not with wear; allowed: xnewton"),
    (WORE.format(""), ["-history", 1], "wear with rotate, -distance exact or -history"),
    (WORE.format(""), ["-distance", "exact"], "wear with rotate, -distance exact or -history"),
    (WORE.format("") + "rotate left 0 0 0.01\n", [], "wear with rotate, -distance exact or -history"),
    (WORE.format("") + "expand block 1e-5 10\n", [], "wear with expand or preload"),
    (WORE.format("\nobstacle left plane -9 0 1 0 friction 0.1"), [], "wear with slide, and friction, leg or tie"),
    (SLIPPED, [], "wear by friction: the last leg does not end where the first one does"),
    (SLIPPED, ["-stepErrors", 1], "-stepErrors 1: not with wear"),
    (SLIPPED, ["-distance", "exact"], "wear with rotate, -distance exact or -history"),
    (WORE.format(" from {}"), [], "no worn profile; allowed: worn.csv of a run"),
]


@pytest.mark.parametrize("case, flags, words", cases_of(COMBINED[-1:], COMBINED))
def test_combinations(tmp_path, case, flags, words):
    """What is not solved together with wear is refused by name, and nothing is written."""
    (tmp_path / "other.csv").write_text("overlap,pressure\n0,0\n")
    run = part(tmp_path, block(Mesh()).text(), case.replace("{}", str(tmp_path / "other.csv")), *flags, expect=10)
    assert words in run.stdout.splitlines()[-1] and not (tmp_path / "out").exists(), run.stdout


@pytest.mark.parametrize(
    "row, words",
    cases_of(
        [("0,0,1.5,2,0,x", "allowed: worn.csv of a run"), ("0,0,1.5,2,0,-1e-3", "line 2: depth -0.001: ")],
        [
            ("0,0,1.5,2,0,-1e-3", "line 2: depth -0.001: "),
            ("0,0,1.5,2,0,x", "allowed: worn.csv of a run"),
            ("0,0,1.5,2,0", "line 2: not six numbers"),
            ("0,0,1.5,2,0,1,7", "allowed: worn.csv of a run"),
            ("3,0,1.5,2,0,0", "no row of contact 0"),
            ("0,0,9,9,0,0", "the profile does not reach the point ("),
        ],
    ),
)
def test_bad_profile(tmp_path, row, words):
    (tmp_path / "bad.csv").write_text("contact,chain,x,y,z,depth\n" + row + "\n")
    run = part(tmp_path, block(Mesh()).text(), WORE.format(f" from {tmp_path / 'bad.csv'}"), expect=10)
    assert words in run.stdout.splitlines()[-1] and not (tmp_path / "out").exists(), run.stdout


# ---------------------------------------------------------------- slip

FRETTED = """size = {size};
Point(1) = {{-20, 0, 0, 4}}; Point(2) = {{20, 0, 0, 4}}; Point(3) = {{20, 20, 0, 4}}; Point(4) = {{1, 20, 0, size}};
Point(5) = {{-1, 20, 0, size}}; Point(6) = {{-20, 20, 0, 4}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 5}}; Line(5) = {{5, 6}}; Line(6) = {{6, 1}};
Curve Loop(1) = {{1 : 6}}; Plane Surface(1) = {{1}};
Physical Surface("block") = {{1}}; Physical Curve("bottom") = {{1}}; Physical Curve("top") = {{4}};
Physical Curve("free") = {{2, 3, 5, 6}};
"""
FRETTING = "body block E 1e4 nu 0.49\nclamp bottom\n"
FRETTING += "obstacle top circle 0 120 R 100 move 0 -0.012 friction 0.5 wear 1e-6\ncycles {} steps {}\nleg 2\n"
CYCLE = (
    "leg 4\nobstacle top move 0.005 -0.012\nleg 6\nobstacle top move -0.005 -0.012\nleg 4\nobstacle top move 0 -0.012\n"
)


def test_partial_slip(tmp_path):
    """A cycle wears as Cattaneo and Mindlin have it, k times pressure times slip; the volume is k/mu energy."""
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


def test_fretting_steps(tmp_path):
    """The slip zone loses its pressure; the steps' error holds the difference; too long a step stops the run."""
    mesh, cycles = FRETTED.format(size=0.16), 4000
    page = (ROOT / "edp/docs/howto/wear.md").read_text()
    assert "".join((FRETTING + CYCLE).format(cycles, 8).splitlines(True)[2:]) in page
    few, many = (part(tmp_path / f"{n}", mesh, FRETTING.format(cycles, n) + CYCLE) for n in (4, 8))
    assert abs(worn(few)["depth"]["value"] - worn(many)["depth"]["value"]) < worn(few)["depth"]["error"]
    assert abs(worn(few)["volume"]["value"] - worn(many)["volume"]["value"]) < worn(few)["volume"]["error"]
    assert worn(few)["depth"]["error"] < 0.3 * worn(few)["depth"]["value"]
    deepest = rows(many)["depth"].argmax()
    unworn = (FRETTING + CYCLE).replace(" wear 1e-6", "").replace("cycles {} steps {}\n", "")
    plain = part(tmp_path / "plain", mesh, unworn, "-estimate", 0)
    assert many.contact["pressure"][deepest] < 0.95 * plain.contact["pressure"][deepest]
    long = part(tmp_path / "long", mesh, FRETTING.format(100 * cycles, 1) + CYCLE, expect=20)
    assert "cycles is too long for this mesh: use cycles 400000 steps " in long.stdout


def test_slip_in_space(tmp_path):
    """A box that slides as a whole, in space and in the plane: k p times the slip, and k/mu times the energy."""
    case = "body block E 100 nu 0.3\nclamp bottom\ncycles 10 steps 1\n"
    case += "obstacle top plane 0 {0}2 0 {0}-1 move 0 {0}-0.01 friction 0.2 wear 1e-6\nleg 1\nleg 2\n"
    case += "obstacle top move 0.5 {0}-0.01\nleg 4\nobstacle top move -0.5 {0}-0.01\n"
    case += "leg 2\nobstacle top move 0 {0}-0.01\n"
    meshes = block(Mesh(), cells=(6, 4)).text(), cube(Mesh(), size=(3, 1, 2), cells=(3, 1, 2)).text()
    for mesh, space in zip(meshes, (False, True), strict=True):
        run = part(tmp_path / f"{space}", mesh, case.format("0 " * space), "-order", 1, "-estimate", 0, space=space)
        dissipated, force = (run.summary["contacts"][0][key] for key in ("dissipated", "normalForce"))
        volume = worn(run)["volume"]["value"]
        assert volume == pytest.approx(10 * 1e-6 / 0.2 * dissipated, rel=5e-3)
        assert volume == pytest.approx(10 * 1e-6 * force * 2, rel=0.03)  # less what the box gives way
