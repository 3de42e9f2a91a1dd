"""Coulomb's friction: counts, closed forms, energies, symmetries, legs of a case, what is refused."""

import re
import sys

import numpy as np
import pytest
from freefem import (
    FREEFEM,
    ROOT,
    cases_of,
    data,
    environment,
    execute,
    flag_text,
    interrupt,
    part,
    run,
    run_in,
    snippet,
    table,
    told,
)
from input.test_parts import UNTURNED, Mesh, block, turn
from shapes import moved, polygon

from postprocess.command_line import main
from postprocess.commands.hysteresis import last_loop

HARD = {"-gap": 0, "-law": "signorini", "-d0": 0}
BLOCK = {"-force": 0, "-shear": 0, "-reach": 8, "-grading": 20, "-u0": 2, "-drag": 1, "-h": 0.25}
TURNS = "1 0, 1 .05, 1 .2, 1 1, 1 -.2, .5 -.2, 1.25 .3"
SMALL = {"-force": 0.08631, "-shear": 0.015536, "-reach": 0.2, "-gap": 0.001, "-grading": 400, "-h": 0.00667}
SMALL |= {"-ratio": 1}
RADIUS, MODULUS = 10, 100 / 0.91


WEDGE = """
DefineConstant[ slope = {0.3, Name "slope"} ];
DefineConstant[ size = {0.2, Name "size"} ];
""" + polygon(
    "wedge", "size", ["0, 0", "0.5, 0", "0.5 + slope, 1", "0, 1"], {1: "tip", 2: "flank", 3: "head", 4: "mirror"}
)
SQUARE = polygon("block", 0.34, ["0, 0", "1, 0", "1, 1", "0, 1"], {1: "base", 3: "head"})
ARCH = [f"{x}, {y}" for x, y in ((-1, 0), (-0.6, 0), (-0.6, 0.3), (0.6, 0.3), (0.6, 0), (1, 0), (1, 1), (-1, 1))]
ARCHED = polygon("low", 0.6, ["-3, -1", "3, -1", "3, 0", "-3, 0"], {1: "base", 3: "top"})
ARCHED += polygon("up", 0.3, ARCH, {1: "left", 5: "right"}, 11)
ON_FEET = """body low E 8e4 nu 0.3
body up E 8e4 nu 0.3
contact left top friction 0.1
contact right top friction 0.1
clamp base
"""


def stack(aside=0.0, above=1.0):
    """Two squares, the upper one aside and above the lower one's corner."""
    x, y = aside, above
    geo = polygon("low", 1, ["0, 0", "1, 0", "1, 1", "0, 1"], {1: "base", 3: "head", 4: "left"})
    upper = [f"{x}, {y}", f"{1 + x}, {y}", f"{1 + x}, 2", f"{x}, 2"]
    geo += polygon("up", 1, upper, {1: "foot", 3: "top", 4: "side"}, 5)
    return geo + "Transfinite Curve{1:4} = 8; Transfinite Curve{5:8} = 5;\n"


GLUED = "body low E 100 nu 0.3\nbody up E 100 nu 0.3\ntie foot head\n"
BOXES = data("friction/boxes.geo")
BEAM = (
    'DefineConstant[ h = {0.1, Name "h"} ];\n'
    + polygon("left", "h", ["0, 0", "2, 0", "2, 1", "0, 1"], {2: "end1", 4: "wall"})
    + polygon("right", "0.7 * h", ["2, 0", "4, 0", "4, 1", "2, 1"], {2: "tip", 4: "end2"}, 5)
)
ONE = polygon("beam", 0.06, ["0, 0", "4, 0", "4, 1", "0, 1"], {1: "below", 2: "tip", 4: "wall"})
PUNCH = """body lower E 100 nu 0.3
body upper E 100 nu 0.3
contact contact master gap vertical law power kappa 1e3 m 3 d0 -0.05 friction 0.3
clamp clamped
"""
PLANE = "obstacle free plane 0 99 0 -1"
LEGS = "move pushed 0 -1\nleg 1\nleg 1\n"


def rub(folder, script, flags, expect=0):
    """A run of a scene, P2 unless the flags say so."""
    flags = {"-vtu": 0, "-estimate": 0, **flags}
    words = [word for pair in flags.items() for word in pair]
    return run_in(ROOT, script, *words, out=folder, expect=expect)


def fretting(folder, expect=0, **flags):
    return rub(folder, "edp/scenes/fretting.edp", {f"-{name}": value for name, value in flags.items()}, expect)


def test_work_of_parabolas(tmp_path):
    """The work of forces and ways that are parabolas is exact from a leg's second step on, the first one's with it."""
    text = (ROOT / "edp/scenes/fretting.edp").read_text() + data("friction/work.edp")
    flags = {**BLOCK, "-h": 1, "-legs": "1 0", "-vtu": 0, "-out": tmp_path / "out"}
    found = told(snippet(tmp_path, text, *(word for pair in flags.items() for word in pair)))
    force, way = [np.poly1d([3, 2, 1]), np.poly1d([-1, 0, 2])], [np.poly1d([-0.5, 1, 0]), np.poly1d([7, 0])]
    exact = sum((f * w.deriv()).integ() for f, w in zip(force, way, strict=True))
    assert [found["work2"][0], found["work3"][0]] == pytest.approx([exact(2), exact(3)], rel=1e-12)


def series(run):
    return table(run.folder / "series.csv")


def counts(run):
    rows = series(run)
    return np.diff(rows["newton"], prepend=0), np.diff(rows["backsolves"], prepend=0)


def case(folder, geometry, text, *flags, **how):
    """A run of a case, its error not estimated unless a flag asks for it."""
    return part(folder, geometry, text, *flags, *([] if "-estimate" in flags else ["-estimate", 0]), **how)


LOOSE = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 8, 6, 2}; Box(2) = {1, 1, 2, 6, 4, 1.5};
Physical Volume("A") = {1}; Physical Volume("B") = {2};
MeshSize{PointsOf{Volume{1};}} = 2; MeshSize{PointsOf{Volume{2};}} = 1.5;
"""
PRESSED_LOOSE = data("friction/pressed-loose.case")


def test_way_of_a_load_that_friction_holds(tmp_path):
    """The error of a load's way on a body that friction alone holds sideways: elements 0.4 as large have 6.48e-4."""
    done = case(tmp_path, LOOSE, PRESSED_LOOSE, "-order", 2, "-estimate", 1, space=True)
    way = done.summary["estimates"]["loads"][0]["way"]
    assert abs(way["value"] - 6.48e-4) < way["error"] < 0.1 * way["value"]
    assert not [text for text in done.summary["warnings"] if "too coarse" in text]
    # no force is along the faces: that of the shears is what the balance leaves
    (shear,) = re.findall(r"shear force +(\S+) ± (\S+) \(mesh\)", done.stdout)
    assert float(shear[0]) < float(shear[1]) < 1e-5 * done.force


@pytest.mark.parametrize(
    ("law", "friction"),
    cases_of([("hard", 0.3)], [("1e12", 0.6), ("1", 1.5)]),
)
def test_counts_of_a_path(tmp_path, law, friction):
    given = {} if law == "hard" else {"law": "power", "kappa": law, "m": 3, "d0": -1e-9}
    run = fretting(tmp_path, friction=friction, legs=TURNS, **{k[1:]: v for k, v in BLOCK.items()}, **given)
    newton, products = counts(run)
    assert len(newton) == 7
    assert newton.mean() <= 3 and newton.max() <= 5
    assert products.mean() <= 12 and products.max() <= 20


def test_cattaneo_and_mindlin(tmp_path):
    """Equal half-cylinders, 60 points across: no coupling."""
    run = rub(tmp_path, "edp/scenes/fretting-bodies.edp", {**SMALL, "-legs": "1 0, 1 1, 1 -1, 1 1"})
    force, shear, friction = 0.08631, 0.015536, 0.3
    half = np.sqrt(4 * force * (RADIUS / 2) / (np.pi * MODULUS / 2))
    inner = half * np.sqrt(1 - shear / friction / force)
    rows = run.contact
    x, weight = rows["x"], rows["weight"]
    stick = x[rows["slide"] == 1]
    cell = np.diff(x).min() * 2
    assert abs(stick.max() - inner) <= cell and abs(stick.min() + inner) <= cell
    root = lambda b: np.sqrt(np.maximum(1 - (x / b) ** 2, 0))  # noqa: E731
    exact = friction * 2 * force / np.pi / half * (root(half) - inner / half * root(inner))
    assert np.sqrt((weight * (rows["shear"] - exact) ** 2).sum() / (weight * exact**2).sum()) < 0.02
    # most is of the point beside the edge of what sticks, where the exact one has a vertical tangent: means of elements
    order = np.argsort(x)
    ends, shears = x[order][::2], rows["shear"][order]
    sine = lambda b: np.clip(ends / b, -1, 1)  # noqa: E731
    area = lambda b: b / 2 * (sine(b) * root(b)[order][::2] + np.arcsin(sine(b)))  # noqa: E731
    exact = friction * 2 * force / np.pi / half * np.diff(area(half) - inner / half * area(inner)) / np.diff(ends)
    means = (shears[:-2:2] + 4 * shears[1::2] + shears[2::2]) / 6
    assert np.sqrt(((means - exact) ** 2).sum() / (exact**2).sum()) < 0.01
    # the loop between -Q and Q
    rate = friction * 2 / np.pi / MODULUS
    left = lambda s: force - s / friction  # noqa: E731
    way = lambda s: rate * (left(s) * np.log(left(s)) - left(s) - force * np.log(force) + force)  # noqa: E731
    at, share = np.polynomial.legendre.leggauss(60)
    loop = 4 * shear * way(shear) - 8 * shear / 2 * (share * way(shear / 2 * (at + 1))).sum()
    done = series(run)["dissipated"]
    assert done[3] - done[1] == pytest.approx(loop, rel=0.005)


@pytest.mark.parametrize(
    ("friction", "inner"),
    [(0.4, 0.3535), *(c for c in [(0.2, 0.0471), (0.8, 0.8090)])],
)
def test_spence(tmp_path, friction, inner):
    """A flat punch on a large block, nu = 0, the shear changing the pressure too: what sticks, to a cell."""
    flags = {"-law": "signorini", "-d0": 0, "-gap": 0, "-u0": 0.1, "-nu": 0, "-legs": "1", "-a": 1, "-order": 2}
    flags |= {"-h": 0.025, "-corners": 0.02, "-width": 800, "-depth": 400, "-grading": 4000, "-friction": friction}
    rows = rub(tmp_path, "tests/data/friction/flat-punch.edp", flags).contact
    last = np.flatnonzero(rows["slide"] == 1)[-1]
    assert rows["x"][last] - 0.0125 <= inner <= rows["x"][last + 1] + 0.0125


def test_work_is_stored_and_dissipated(tmp_path):
    """By ever smaller steps: within 1e-4 of what is dissipated."""
    off = []
    for steps in (16, 64):
        flags = {"-h": 0.4, "-legs": "1 0, 1 1, 1 -1", "-history": 1, "-steps": steps}
        rows = series(rub(tmp_path / str(steps), "edp/scenes/fretting-bodies.edp", flags))
        first, last = steps - 1, len(rows) - 1
        done = {name: rows[name][last] - rows[name][first] for name in ("work", "stored", "dissipated")}
        off.append(abs(done["work"] - done["stored"] - done["dissipated"]) / done["dissipated"])
    assert off[1] < off[0] / 10 and off[1] < 1e-4


ROTATION = np.array([[np.cos(0.7), -np.sin(0.7)], [np.sin(0.7), np.cos(0.7)]])
MOTIONS = [(np.eye(2), 1), (ROTATION @ np.diag([-1.0, 1]), 1e-3)]


def meshed(folder, geo):
    (folder / "a.geo").write_text(geo)
    execute(["gmsh", "-2", "-format", "msh22", "-v", 0, folder / "a.geo", "-o", folder / "a.msh"])
    return (folder / "a.msh").read_text()


def alike(one, other):
    """Lists of numbers, to 1e-9 of each's greatest."""
    for mine, theirs in zip(one, other, strict=True):
        assert abs(mine - theirs).max() <= 1e-9 * abs(mine).max()


def test_turned_mirrored_and_in_other_units(tmp_path):
    """A wedge pressed in: the same forces and slip."""
    mesh, found = meshed(tmp_path, WEDGE), []
    for k, (matrix, scale) in enumerate(MOTIONS):
        vector = lambda *v, m=matrix, s=1: " ".join(repr(float(c)) for c in s * (m @ v))  # noqa: E731
        text = f"body wedge E 1000 nu 0.3\nobstacle flank plane {vector(0.5, 0, s=scale)} {vector(-1, 0.3)} "
        text += f"friction 0.4\nsymmetry mirror\nleg 2\ntraction head {vector(0, -1)}\n"
        run = case(tmp_path / str(k), moved(mesh, matrix, scale), text, "-tol", 1e-12)
        rows = run.contact[np.argsort(run.contact["pressure"])]
        found.append((rows["pressure"], abs(rows["shear"]), rows["slip"] ** 2 / scale**2, rows["slide"]))
    alike(*found)


EXACT = ("-distance", "exact")
LYING = polygon("block", 0.25, ["0, 0", "2, 0", "2, 1", "0, 1"], {1: "base", 2: "side", 3: "head"})


def test_friction_alone_holds_a_block(tmp_path):
    """It lies on a plane and is dragged by its head: all of the drag goes through; turned, mirrored: the same."""
    mesh, found = meshed(tmp_path, LYING), []
    for k, (matrix, _) in enumerate(MOTIONS):
        folder = tmp_path / str(k)
        vector = lambda *v, m=matrix: " ".join(repr(float(c)) for c in m @ v)  # noqa: E731
        text = f"body block E 1000 nu 0.3\nobstacle base plane 0 0 {vector(0, 1)} friction 0.3\n"
        text += f"stresses\nline middle {vector(1, 0.01)} {vector(1, 1)}\n"
        run = case(folder, moved(mesh, matrix), text + f"traction head {vector(0.2, -1)}\n", "-tol", 1e-12)
        contact = run.summary["contacts"][0]
        assert contact["normalForce"] == pytest.approx(2, rel=1e-9)
        assert run.summary["stored"] == pytest.approx(-run.summary["energy"], rel=2e-3)  # nearly all of it sticks
        assert contact["shearForce"] == pytest.approx(matrix @ [-0.4, 0], abs=1e-9)
        rows = run.contact[np.argsort(run.contact["pressure"])]
        inside = table(run.folder / "line-middle.csv")["vonMises"]
        found.append((rows["pressure"], abs(rows["shear"]), abs(rows["slip"]), rows["slide"], inside))
    alike(*found)


def test_no_equilibrium_is_named(tmp_path):
    """Dragged by more than friction bears, in the second leg; tipped over."""
    text = "body block E 1000 nu 0.3\nobstacle base plane 0 0 0 1 friction 0.3\nleg 1\ntraction head 0 -1\nleg 2\n"
    run = case(tmp_path, LYING, text + "traction head 0.4 -1\n", *EXACT, script="edp/parts.edp", expect=20)
    assert "leg 2, load step 2 of 2: block: along x: no equilibrium (traction head): friction" in run.message
    assert (
        "carry between 50 % and 100 % of this leg's change of load (load steps of that size; more of them narrow it)"
        in run.message
    )
    last = series(run)
    assert len(last["leg"]) == 2 and last["shearForce"][1] == pytest.approx(-0.4, rel=1e-6)
    text = "body block E 1000 nu 0.3\nobstacle base plane 0 0 0 1 friction 2\ntraction head 1.1 -1\n"
    assert "block: rotation" in case(tmp_path, LYING, text, expect=10).stdout


JAWS = polygon(
    "plate", 0.25, ["0, 0", "2, 0", "4, 0", "4, 1", "2, 1", "0, 1"], {1: "under", 3: "end", 5: "over"}
) + polygon("jaw", 0.2, ["0, 1", "2, 1", "2, 2", "0, 2"], {1: "grip", 3: "top"}, 7)


@pytest.mark.parametrize(("pull", "code"), [(5.9, 0), (6.1, 20)])
def test_a_jaw_driven_by_force(tmp_path, pull, code):
    """Nothing but slides feels a plate's way between two planes: pressed by 10, it bears 2 mu 10."""
    plate = polygon("plate", 0.2, ["0, 0", "2, 0", "2, 0.4", "0, 0.4"], {1: "down", 2: "end", 3: "up"})
    text = "body plate E 1e4 nu 0.3\nobstacle down plane 0 0 0 1 friction 0.3\n"
    text += f"obstacle up plane 0 0.4 0 -1 force 0 -10 friction 0.3\ntraction end {pull / 0.4} 0\n"
    run = case(tmp_path, plate, text, expect=code)
    if code == 20:
        assert "plate: along x: no equilibrium" in run.message
        text = text.replace(f"traction end {pull / 0.4}", "force end 1")
        assert "the point at (2, 0.4): its node is held" in case(tmp_path, plate, text, expect=20).message
    else:
        sheared = [contact["shearForce"][0] for contact in run.summary["contacts"]]
        assert abs(sheared[0]) + abs(sheared[1]) == pytest.approx(pull, rel=1e-5)


@pytest.mark.parametrize(("below", "name"), [(0.3, "low: along x, up: along x"), (0.5, "up: along x")])
def test_of_two_blocks_what_slides_is_named(tmp_path, below, name):
    corners = ["-0.4, 0.5", "0.4, 0.5", "0.4, 1", "-0.4, 1"]
    blocks = polygon("low", 0.25, ["-0.5, 0", "0.5, 0", "0.5, 0.5", "-0.5, 0.5"], {1: "foot", 3: "low-top"})
    blocks += polygon("up", 0.2, corners, {1: "up-foot", 3: "up-top"}, 5)
    text = f"body low E 1e4 nu 0.3\nbody up E 1e4 nu 0.3\nobstacle foot plane 0 0 0 1 friction {below}\n"
    text += f"contact up-foot low-top friction {0.8 - below}\npressure up-top 10\ntraction up-top 3.1 0\n"
    message = case(tmp_path, blocks, text, expect=20).message
    assert f"leg 1: {name}: no equilibrium (pressure up-top, traction up-top): friction and contact do not" in message


@pytest.mark.parametrize(("pull", "steps"), [(1.7, 4), (1.7, 1), (0.6004, 4)])
def test_what_friction_carries_of_the_load_is_told_by_its_steps(tmp_path, pull, steps):
    """Friction bears 0.6: a bracket of a thousandth of the leg, and the advice is never less friction, not even 0.07 %
    above."""
    text = "body block E 1000 nu 0.3\nobstacle base plane 0 0 0 1 friction 0.3\n"
    text += f"leg 1\npressure head 1\ntraction head 0 0\nleg {steps}\npressure head 1\ntraction head {pull / 2} 0\n"
    message = case(tmp_path, LYING, text, expect=20).message
    carried, not_carried = (float(share) for share in re.findall(r"([\d.]+) %", message))
    assert carried <= 60 / pull <= not_carried <= carried + 0.12
    assert "no equilibrium" in message and "more friction or pressure" in message and "less friction" not in message


def test_a_jaw_takes_a_plate_along(tmp_path):
    """By four elements in two steps: the plate slides on what bears it, and what goes in is stored and lost."""
    text = "body plate E 1000 nu 0.3\nbody jaw E 2000 nu 0.3\nobstacle under plane 0 0 0 1 friction 0.1\n"
    text += "contact grip over friction 0.5\nmove top 1 -0.005\n"
    run = case(tmp_path, JAWS, text, *EXACT, "-history", 1, "-steps", 2)
    under, over = run.summary["contacts"]
    assert under["stickShare"] == 0 and over["stickShare"] == 1
    for contact in (under, over):  # on flat faces
        assert contact["force"][0] == pytest.approx(-0.1 * under["normalForce"], rel=1e-5)
    work, stored, lost = rows(run, "work", "stored", "dissipated")
    assert work == pytest.approx(stored + lost, rel=1e-4) and np.diff(lost)[0] > 0.05


@pytest.mark.parametrize("friction", [0.2, 0.3, 0.8])
def test_plank_against_a_wall(tmp_path, friction):
    """Leaning at 1 rad, its foot on the floor: where statics have an equilibrium it stands, and balances."""
    corners = np.array([[0, 0], [3, 0], [3, 0.3], [0, 0.3]]) @ turn(1)[:2, :2].T
    text = ["{}, {}".format(*corner) for corner in corners]
    geometry = polygon("plank", 0.2, text, {4: "foot", 1: "below"})
    (wall, up), middle = corners[1], corners.mean(0)[0]
    drags = np.linspace(-1, 1, 2001)  # of the wall
    presses = (middle - wall * drags) / up  # moments about the foot
    stands = ((presses >= abs(drags) / friction) & (presses <= friction * (1 - drags))).any()
    text = f"body plank E 1e4 nu 0.3\nobstacle foot plane 0 0 0 1 friction {friction}\nweight plank 0 {-1 / 0.9}\n"
    text += f"obstacle below plane {wall} 0 -1 0 friction {friction}\n"
    run = case(tmp_path, geometry, text, expect=0 if stands else 20)
    if not stands:
        assert "no equilibrium" in run.message and "(weight)" in run.message
        return
    foot, top = (np.array(contact["force"]) for contact in run.summary["contacts"])
    assert foot + top == pytest.approx([0, 1], abs=1e-6) and wall * top[1] - up * top[0] == pytest.approx(middle)


def test_random_loads_on_a_block(tmp_path):
    """None fails that has an equilibrium: on one flat face friction bears mu N, within the face."""
    random = np.random.default_rng(3)
    for _ in range(30):
        friction, law = random.choice([0.1, 0.3, 0.6, 1.5]), random.choice(["", "law power kappa 1e4 m 2 d0 -0.001 "])
        (tx, sx), (ty, sy) = random.normal(0, [0.4, 0.3]), random.normal([-1, 0], 0.3)
        normal, drag = -(2 * ty + sy), 2 * tx + sx
        at = (2 * ty - 2 * tx + 2 * sy - 0.5 * sx) / -normal
        text = f"body block E 1000 nu 0.3\nobstacle base plane 0 0 0 1 {law}friction {friction}\n"
        text += f"traction head {tx} {ty}\ntraction side {sx} {sy}\n"
        stands = normal > 0 and abs(drag) <= friction * normal and 0 <= at <= 2
        done = case(tmp_path, LYING, text, expect=None)
        assert (done.code == 0) == stands, text


def test_mirrored_parts_bear_the_opposite_shear(tmp_path):
    """Half of a block or a section about an axis: what is summed is the force of the whole."""
    flags = {"-u0": 0.5, "-h": 2, **HARD, "-symmetry": "half", "-legs": "1"}
    run = rub(tmp_path / "half", "edp/scenes/fretting-3d.edp", flags)
    assert run.summary["contacts"][0]["shearForce"][0] == 0 and abs(run.contact["shearX"]).max() > 1
    run = fretting(tmp_path / "axis", geometry="axisymmetric", force=0, shear=0, u0=0.2, h=0.2, legs="1")
    assert run.summary["contacts"][0]["shearForce"][0] == 0 and abs(run.contact["shear"]).max() > 0.1


def test_rolling_and_wedge_beyond_what_they_can(tmp_path):
    """A pull that friction does not bear; a wedge about an axis; rolling that has not begun."""
    run = rub(tmp_path / "a", "edp/scenes/rolling.edp", {"-h": 0.04, "-shear": 0.03}, 20)
    assert "gross sliding" in run.message and "creepage" not in run.summary
    run = rub(tmp_path / "b", "edp/scenes/wedge.edp", {"-geometry": "axisymmetric"}, 10)
    assert "a wedge drags across the axis" in run.stdout
    assert "creepage" not in rub(tmp_path / "c", "edp/scenes/rolling.edp", {"-h": 0.04, "-legs": "1 1"}).summary


def test_little_friction_is_none(tmp_path):
    flags = {"legs": "1", "h": 0.25, "force": 0, "shear": 0, "reach": 8, "u0": 2, "grading": 20}
    none = fretting(tmp_path / "none", friction=0, **flags)
    assert "friction" not in none.summary and "slide" not in none.contact.dtype.names
    little = fretting(tmp_path / "little", friction=1e-9, **flags)
    assert little.newton <= none.newton + 1 and little.summary["sliding"] in (True, False)
    assert little.force == pytest.approx(none.force, rel=1e-6)
    assert abs(little.contact["pressure"] - none.contact["pressure"]).max() < 1e-5 * none.pressureMax


def test_gross_sliding_is_named(tmp_path):
    run = fretting(tmp_path, h=0.2, shear=2.7, expect=20)
    assert "gross sliding" in run.message and "-shear" in run.message


def test_mindlin(tmp_path):
    """A rigid sphere on a block of nu = 0.49, pressed and pulled to and fro: approach, way and the loop's energy."""
    young, nu, friction, radius = 100, 0.49, 0.3, 100
    force = 4 * young / (1 - nu**2) / 3 / radius  # Hertz's radius is 1
    shear = 0.9 * friction * force
    flags = {"-R": radius, "-force": force, "-nu": nu, "-patch": 1.3, "-h": 0.2, **HARD}
    flags |= {"-layers": 2, "-width": 200, "-depth": 100, "-grading": 200, "-drag": 0, "-shear": shear}
    rows = series(rub(tmp_path, "edp/scenes/fretting-3d.edp", {**flags, "-legs": "1, 1 1, 1 -1, 1 1"}))
    rate = 3 * friction * force * (2 - nu) / 16 / (young / 2 / (1 + nu))
    way = lambda q: rate * (1 - (1 - q / friction / force) ** (2 / 3))  # noqa: E731
    at, share = np.polynomial.legendre.leggauss(60)
    loop = 4 * shear * way(shear) - 4 * shear * (share * way(shear / 2 * (at + 1))).sum()
    assert rows["approach"][0] == pytest.approx(1 / radius, rel=0.01)
    assert rows["drag"][1] - rows["drag"][0] == pytest.approx(way(shear), rel=0.01)
    assert rows["dissipated"][3] - rows["dissipated"][1] == pytest.approx(loop, rel=0.01)


@pytest.mark.parametrize(("pull", "h"), [(0.6, 0.0125), (0.3, 0.005)])
def test_carter(tmp_path, pull, h):
    """Rolling: creepage, tractions, what sticks at the side where the surfaces come in, what is dissipated."""
    force, friction = 0.08631, 0.3
    flags = {"-force": force, "-shear": pull * friction * force, "-h": h}
    run = rub(tmp_path, "edp/scenes/rolling.edp", flags)
    half = np.sqrt(4 * force * 5 / (np.pi * MODULUS / 2))
    inner = half * np.sqrt(1 - pull)
    assert run.summary["creepage"] == pytest.approx(friction * (half - inner) / 5, rel=0.02)
    rows = run.contact
    x, weight = rows["x"], rows["weight"]
    root = lambda at, b: np.sqrt(np.maximum(1 - (at / b) ** 2, 0))  # noqa: E731
    exact = friction * 2 * force / np.pi / half * (root(x, half) - inner / half * root(x - half + inner, inner))
    assert np.sqrt((weight * (rows["shear"] - exact) ** 2).sum() / (weight * exact**2).sum()) < 0.06
    stick = x[rows["slide"] == 1]
    assert abs(stick.min() - half + 2 * inner) <= 0.01 and abs(stick.max() - half) <= 0.01
    steps = series(run)  # one step's loss ripples as points come in: the mean of twenty
    lost = steps["dissipated"][-1] - steps["dissipated"][-21]
    assert lost == pytest.approx(steps["shearForce"][-1] * (steps["drag"][-1] - steps["drag"][-21]), rel=5e-3)


def test_wedge_of_a_scene_is_let_go_at_once(tmp_path):
    """Every point slips in, and sticks when the push is gone: Newton's method starts again as if all stuck."""
    run = rub(tmp_path, "edp/scenes/wedge.edp", {"-h": 0.2})
    rows = series(run)
    assert rows["stickingPoints"][0] == 0 < rows["stickingPoints"][1] and rows["force"][1] == pytest.approx(
        2.579, abs=5e-3
    )
    assert run.summary["newton"] <= 14


@pytest.mark.parametrize("share", [0.99, 1.01])
@pytest.mark.parametrize("slope", [0.3, *(s for s in (0.05, 0.6))])
def test_wedge_of_a_scene_locks_above_its_slope(tmp_path, slope, share):
    """Friction of a hundredth less and more than the slope."""
    friction = share * slope
    flags = {"-slope": slope, "-friction": friction, "-h": 0.2, "-legs": "1, 1e-3, 1e-4"}
    rows = series(rub(tmp_path, "edp/scenes/wedge.edp", flags))
    assert rows["force"][0] == pytest.approx(8.631 * slope / (slope + friction), rel=1e-5)
    if friction < slope:
        assert rows["force"][2] == pytest.approx(1e-4 * 8.631 * slope / (slope - friction), rel=1e-4)
    else:
        assert rows["force"][2] > 0.9 * rows["force"][1] and rows["stickingPoints"][2] > 0


def test_compliance_and_limit(tmp_path):
    flags = {"h": 0.2, "legs": "1 0, 1 1", "force": 0, "shear": 0, "u0": 0.1, "drag": 0.05}
    stiff = fretting(tmp_path / "a", **flags).contact
    soft = fretting(tmp_path / "b", compliance=0.05, **flags).contact
    assert (soft["weight"] * soft["shear"]).sum() < 0.9 * (stiff["weight"] * stiff["shear"]).sum()
    most = 0.5 * stiff["shear"].max()
    limited = fretting(tmp_path / "c", shearLimit=float(most), **flags).contact
    assert abs(limited["shear"]).max() <= most * (1 + 1e-6)


def test_about_the_axis(tmp_path):
    """A sphere pressed on a block: it sticks in the middle and slips outwards around it."""
    run = fretting(tmp_path, geometry="axisymmetric", force=0, shear=0, u0=0.2, h=0.1, legs="1", friction=0.1)
    rows = run.contact
    assert rows["slide"][1] == 1 and rows["slide"][rows["slide"] > 0][-1] == 2
    assert run.summary["contacts"][0]["dissipated"] > 0


def test_space_turns_with_its_load(tmp_path):
    """Along x and along y the same, turned."""
    flags = {"-u0": 0.5, "-h": 2, **HARD, "-drag": 0.1}
    along = [
        rub(tmp_path / name, "edp/scenes/fretting-3d.edp", {**flags, "-legs": legs})
        for name, legs in (("x", "1, 1 1"), ("y", "1, 1 0 1"))
    ]
    x, y = (run.summary["contacts"][0]["shearForce"] for run in along)
    assert x[0] == pytest.approx(y[1], rel=0.05) and x[0] > 0
    newton, _ = counts(along[0])
    assert newton.max() <= 6


def test_products_in_space(tmp_path):
    """Solved by iterations (828 rows) and by an inverse: few products, forces that the mesh hardly changes."""
    flags = {"-order": 1, "-layers": 1, "-grading": 40, "-legs": "1, 1 0.3, 1 0.6"}
    paths = [rub(tmp_path / str(h), "edp/scenes/fretting-3d.edp", {**flags, "-h": h}) for h in (0.6, 1)]
    for path in paths:
        newton, products = counts(path)
        assert newton.max() <= 2
        assert products[0] <= 20 and products[1:].max() <= 9
    fine, coarse = (path.summary["contacts"][0]["shearForce"][0] for path in paths)
    assert fine == pytest.approx(coarse, rel=0.1)


@pytest.fixture(scope="module")
def coarse_punch(tmp_path_factory):
    """The example's bodies on larger elements."""
    geo = tmp_path_factory.mktemp("punch") / "punch.geo"
    geo.write_text((ROOT / "edp/examples/punch/punch.geo").read_text().replace("size = {0.1,", "size = {0.3,"))
    return geo


def test_legs_of_a_case(tmp_path, coarse_punch):
    """Pressed, then dragged: the supports carry what the contact does."""
    text = PUNCH + "leg 1\nmove pushed 0 -0.5\nleg 2\nmove pushed 0.1 -0.5\n"
    run = case(tmp_path, coarse_punch, text, script="edp/parts.edp")
    shear = run.summary["contacts"][0]["shearForce"]
    assert run.summary["contacts"][0]["force"][0] == pytest.approx(shear[0], rel=1e-6)
    assert list(series(run)["leg"]) == [1, 2, 2]
    assert run.summary["contacts"][0]["stickShare"] > 0.3


def test_history_of_a_case_with_friction(tmp_path, coarse_punch):
    """A load in steps is a load phase of as many steps."""
    flags = {"h": ("-history", 1, "-steps", 2), "l": ()}
    runs = {}
    for name, words in flags.items():
        text = PUNCH + "leg 2\n" * (name == "l") + "move pushed 0.1 -0.5\n"
        runs[name] = case(tmp_path / name, coarse_punch, text, *words, script="edp/parts.edp").summary["contacts"][0]
    assert runs["h"]["shearForce"] == pytest.approx(runs["l"]["shearForce"], rel=1e-9)


def test_rotation_drags(tmp_path, coarse_punch):
    """A rotation carries the slip with it: bodies are not turned first and rubbed then."""
    run = case(tmp_path, coarse_punch, PUNCH + "rotate pushed 10 2 0.06\n")
    shear, normal = run.summary["contacts"][0]["shearForce"][0], run.summary["contacts"][0]["normalForce"]
    assert 0.15 * normal < abs(shear) < 0.3 * normal


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (PUNCH + "leg 1.5\nmove pushed 0 -0.5\n", "no whole number of steps"),
        (PUNCH + "leg 1\nleg 2\nmove pushed 0 -0.5\n", "also behind the first leg in line 5: move pushed 0 0"),
        (PUNCH + "leg 1\nleg 2\nrotate pushed 1 2 0.1\n", "also behind the first leg in line 5: rotate pushed 1 2 0"),
        (PUNCH + "pressure pushed 1\nleg 2\npressure pushed 2\n", "pressure of pushed in line 5, before the first leg"),
        (PUNCH + "leg 1\nrotate pushed 10 2 2\n", "(with friction or a leg: by -distance exact, in one leg)"),
        (PUNCH.replace("friction 0.3", "friction -1") + "move pushed 0 -1\n", "allowed: at least 0 and below"),
        (PUNCH + LEGS + "clamp free\n", "clamp: in leg 2, but it holds in every leg"),
        (PUNCH + LEGS + "thickness 2\n", "thickness: in leg 2, but it holds in every leg"),
        (PUNCH + LEGS + "move pushed 0 -2\nmove pushed 0 -3\n", "move of pushed in leg 2: stated before, in line"),
        (PUNCH + f"{PLANE} friction 0.3\nleg 1\nleg 1\n{PLANE} move 0 1\n", "no move here or in line"),
        (PUNCH + f"{PLANE} move 0 0\nleg 1\nleg 1\n{PLANE} move 0 1 friction 0.3\n", "interference unlike line"),
        (PUNCH.replace("contact contact", "tie contact").replace("gap", "#"), "tie: not with -distance exact"),
        (PUNCH.replace("contact contact", "tie contact").replace("gap", "#"), "tie: not with -points nodal"),
    ],
)
def test_refusals_of_a_case(tmp_path, coarse_punch, text, words):
    flags = words.split()[3:] if words.startswith("tie: not with") else ()
    run = case(tmp_path, coarse_punch, text, *flags, expect=10)
    assert words in run.stdout


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        ({"method": "paper"}, "only with -method xnewton"),
        ({"distance": "exact"}, "-distance exact: with friction in own parts only"),
        ({"drag": 1, "shear": 1}, "not with -drag"),
        ({"drag": 1, "geometry": "axisymmetric"}, "a drag across a symmetry"),
        ({"force": 0}, "only with a prescribed -force"),
        ({"legs": "1 0, 1 2 3 4"}, "4 numbers in leg 2"),
        ({"legs": "-1 0"}, "pulls the bodies apart"),
        ({"friction": 0, "legs": "1 0, 1 1"}, "only with friction"),
    ],
)
def test_refusals(tmp_path, flags, words):
    run = fretting(tmp_path / "out", expect=10, **flags)
    assert words in run.stdout and len(re.findall(r"\n", run.stdout.strip())) <= 1
    assert not (tmp_path / "out" / "summary.json").exists()


def off(error, value, truth):
    """The ± of a number over what it is off by."""
    return error / max(abs(value - truth), 1e-300)


def test_error_of_the_load_steps(tmp_path):
    """Half as many load steps say how far these have the numbers off; an odd number says nothing."""
    flags = {"h": 0.6, "force": 0, "shear": 0, "u0": 0.8, "drag": 0.25, "friction": 0.4, "reach": 5, "grading": 20}
    flags |= {"nu": 0.2, "legs": ".6 .3, 1 1", "history": 1}
    some = fretting(tmp_path / "some", steps=4, stepErrors=1, **flags)
    many = fretting(tmp_path / "many", steps=16, **flags).summary
    assert many["loadStepsError"].startswith("not known: -stepErrors 1")
    contact, many = some.summary["contacts"][0], many["contacts"][0]
    for name in ("normalForce", "dissipated", "slipMean"):
        assert 1 <= off(contact["loadSteps"][name]["error"], contact[name], many[name]) < 100
    error = contact["loadSteps"]["shearForce"]["error"]
    assert 1 <= off(error, contact["shearForce"][0], many["shearForce"][0]) < 100
    odd = fretting(tmp_path / "odd", steps=1, stepErrors=1, **flags)
    assert "an odd number of load steps" in odd.summary["loadStepsError"]
    assert "loadSteps" not in odd.summary["contacts"][0]
    assert list(series(odd)["newton"]) == list(series(fretting(tmp_path / "as", steps=1, **flags))["newton"])


def test_error_of_the_mesh(tmp_path):
    """The transposed tangent's dual: the force's derivative as a difference quotient; finer elements are within."""
    flags = {"force": 0, "shear": 0, "friction": 0.3, "reach": 5, "grading": 20, "nu": 0.2}
    flags |= {"legs": "1 0, 1 1", "drag": 0.3}
    steep = fretting(tmp_path / "steep", h=0.4, u0=1, estimate=1, tol=1e-10, **flags)
    beside = fretting(tmp_path / "beside", h=0.4, u0=1, tol=1e-10, **{**flags, "legs": "1 0, 1.0001 1"})
    quotient = (beside.force - steep.force) / 1e-4
    assert steep.summary["estimates"]["contactStiffness"] == pytest.approx(quotient, rel=1e-4)
    fine = fretting(tmp_path / "fine", h=0.1, u0=1, **flags)
    coarse, truth = steep.summary["contacts"][0], fine.summary["contacts"][0]
    assert 1 <= off(steep.summary["estimates"]["force"]["error"], steep.force, fine.force) < 100
    error = coarse["mesh"]["shearForce"]["error"]
    assert abs(coarse["shearForce"][0] - truth["shearForce"][0]) <= error < 1e-2 * truth["shearForce"][0]
    last = coarse["mesh"]["dissipatedLastStep"]
    assert abs(last["value"] - truth["mesh"]["dissipatedLastStep"]["value"]) <= last["error"] < 0.05 * last["value"]
    assert steep.summary["estimates"]["energy"] is None


def goes_on(folder, command, rows_before, steps):
    """A path killed after so many rows and begun again: the numbers of one that was not."""
    command = list(map(str, [*command, "-out"]))
    code, stdout = execute([*command, folder / "whole"])
    assert code == 0, stdout
    rows = folder / "cut" / "series.csv"
    interrupt([*command, folder / "cut"], lambda: rows.exists() and rows.read_text().count("\n") > rows_before)
    code, stdout = execute([*command, folder / "cut"])
    assert code == 0 and re.search(rf"goes on after step \d+ of {steps}", stdout), stdout
    for name in ("series.csv", "contact.csv"):
        one, two = table(folder / "whole" / name), table(folder / "cut" / name)
        for column in one.dtype.names:
            if column not in ("backsolves", "threshold", "tau"):
                rounding = 1e-17 if column in ("overlap", "s") else 0  # those of hard contact are 0 but for rounding
                assert abs(one[column] - two[column]).max() <= 1e-12 * abs(one[column]).max() + rounding, column


@pytest.mark.parametrize("rows_before", [6, 7])
def test_interrupted_path_goes_on(tmp_path, monkeypatch, rows_before):
    """Also after the first step of a leg. Two BLAS threads would round anew each time."""
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")
    flags = {"h": 0.4, "friction": 0.3, "legs": "1 0, 1 1, 1 -1", "history": 1, "steps": 5, "vtu": 0, "estimate": 0}
    words = [flag_text(word) for name, value in flags.items() for word in (f"-{name}", value)]
    goes_on(tmp_path, [*FREEFEM, "edp/scenes/fretting-bodies.edp", *words], rows_before, 15)


def test_free_body_goes_on(tmp_path, monkeypatch):
    """A body that contact alone holds, in its second phase."""
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")
    (tmp_path / "a.geo").write_text(ARCHED)
    (tmp_path / "a.case").write_text(f"{ON_FEET}leg 1\nweight up 0 -1\nleg 12\nweight up 0.05 -1\n")
    words = ["-mesh", tmp_path / "a.geo", "-case", tmp_path / "a.case", "-vtu", 0, "-estimate", 0]
    goes_on(tmp_path, ["sh", "edp/freefem.sh", "edp/parts.edp", *words], 3, 13)


@pytest.mark.parametrize(("friction", "lifted", "several"), [(4, 0.001, True), (1, -0.01, False)])
def test_several_solutions_are_said(tmp_path, friction, lifted, several):
    """A block wedged by its friction while its head is lifted: it might as well be free."""
    text = f"body block E 100 nu 0.3\nobstacle base plane 0 0 0 1 friction {friction}\nleg 1\nmove head 0 -0.01\n"
    text += f"leg 2\nmove head 0.03 -0.01\nleg 2\nmove head 0.05 {lifted}\n"
    run = case(tmp_path, SQUARE, text)
    assert ("several solutions" in run.stdout) is several
    assert run.summary["contacts"][0]["normalForce"] > 0


def test_shears_in_both_files(tmp_path):
    """contact.vtu and contact.csv: tractions, slip, state."""
    flags = {"h": 0.4, "legs": "1 0, 1 1", "force": 0, "shear": 0, "u0": 0.5, "drag": 0.1, "vtu": 1}
    run = fretting(tmp_path, **flags)
    text = (run.folder / "contact.vtu").read_text(errors="replace")
    names = {"shear[pressure]": "shear", "slip[length]": "slip", "slide": "slide"}
    assert all(f'Name="{name}"' in text and column in run.contact.dtype.names for name, column in names.items())


@pytest.mark.parametrize("order", [2, 4])
def test_tie_reproduces_uniform_tension(tmp_path, order):
    text = GLUED + "symmetry base\nsymmetry left\nsymmetry side\ntraction top 0 1\n"
    run = case(tmp_path, stack(), text, "-tol", 1e-12, "-order", order)
    rows = run.contact
    assert abs(rows["pressure"] + 1).max() < 1e-9 and abs(rows["shear"]).max() < 1e-9
    assert run.summary["contacts"][0]["tied"] is True
    assert run.summary["contacts"][0]["force"][1] == pytest.approx(-1, abs=1e-9)


def test_tie_where_there_is_something_opposite(tmp_path):
    """The upper piece stands over and hangs above: what has nothing opposite is free, the rest keeps its distance."""
    text = GLUED + "clamp base\ntraction top 0.1 1\n"
    contact = case(tmp_path, stack(0.3, 1.05), text).summary["contacts"][0]
    assert contact["force"] == pytest.approx([-0.1, -1], rel=1e-5) and 0 < contact["contactPoints"] < contact["points"]


@pytest.mark.parametrize("order", [1, 2, 3])
def test_tie_reproduces_uniform_tension_in_space(tmp_path, order):
    mirrors = "".join(f"symmetry {name}\n" for name in "base lx ly ux uy".split())
    text = f"{GLUED}{mirrors}traction top 0 0 1\n"
    run = case(tmp_path, BOXES, text, "-tol", 1e-12, "-order", order, space=True)
    rows = run.contact
    assert abs(rows["pressure"] + 1).max() < 1e-9
    assert max(abs(rows["shearX"]).max(), abs(rows["shearY"]).max()) < 1e-9


def test_cantilever_of_two_glued_pieces(tmp_path):
    """Its tip goes as far as that of one piece with elements a third as large, within the ±."""
    glued = "body left E 1000 nu 0.3\nbody right E 1000 nu 0.3\ntie end2 end1\nclamp wall\ntraction tip 0 -1\n"
    two = case(tmp_path, BEAM, glued, "-estimate", 1)
    loads = two.summary["estimates"]["loads"][0]["way"]
    assert loads["error"] < 2e-3 * loads["value"]
    text = "body beam E 1000 nu 0.3\nobstacle below plane 0 -9 0 1\nclamp wall\ntraction tip 0 -1\n"
    (tmp_path / "one").mkdir()
    one = case(tmp_path / "one", ONE, text).summary["bodies"][0]["motion"][1]
    both = np.mean([body["motion"][1] for body in two.summary["bodies"]])
    assert abs(both / one - 1) <= loads["error"] / loads["value"]
    assert two.summary["contacts"][0]["force"][1] == pytest.approx(1, rel=1e-6)


LOOP = {"-h": 0.2, "-legs": "1 0, 1 1, 1 -1, 1 1", "-history": 1, "-steps": 3}


@pytest.mark.parametrize(
    "scene, flags",
    cases_of([("fretting", LOOP)], [("fretting-3d", {"-u0": 0.5, "-h": 2, **HARD, "-drag": 0.1})]),
)
def test_pictures(tmp_path, scene, flags):
    """The shear beside the pressure; the loop, and what sticks over the load steps."""
    out = rub(tmp_path / "out", f"edp/scenes/{scene}.edp", {**flags, "-vtu": 1}).folder
    for words in (["state"], ["hysteresis", "--slip", "--slide"], ["hysteresis", "--slip"]):
        assert main([*words, str(out)]) == 0
        assert (out / f"{words[0]}.pdf").stat().st_size > 5000 and (out / f"{words[0]}.png").stat().st_size > 20000
    if scene == "fretting":
        zones, steps = table(out / "slides.csv"), table(out / "series.csv")
        last = zones[zones["step"] == zones["step"].max()]
        assert len(last) == steps["contactPoints"][-1] and (last["slide"] == 1).sum() == steps["stickingPoints"][-1]


def test_no_loop_without_friction(capsys):
    """A run that has no friction is refused in one line."""
    assert main(["hysteresis", str(run("disc-on-block", "-h", 2).folder)]) == 2
    said = capsys.readouterr().err
    assert "run it with friction" in said and said.count("\n") == 1


@pytest.mark.parametrize("kind", ["plane", "loads", "space", "bodies"])
def test_the_campaign_begun(tmp_path, kind):
    """The first paths of the campaign with friction: every step is solved, or has no equilibrium and says so."""
    command = [sys.executable, "tests/campaigns/friction.py", kind, "--paths", "2", "--out", tmp_path / "steps.csv"]
    code, stdout = execute(command, env=environment(PYTHONPATH=ROOT))
    assert code == 0 and " 0 failed" in stdout, stdout


# ---------------------------------------------------------------- the true distance

HALF = """
Point(5) = {-0.5, 1, 0, 0.3}; Point(6) = {-1.5, 1, 0, 0.3}; Point(7) = {0.5, 1, 0, 0.3}; Point(8) = {-0.5, 0, 0, 0.1};
Circle(5) = {6, 5, 8}; Circle(6) = {8, 5, 7}; Line(7) = {7, 5}; Line(8) = {5, 6};
Curve Loop(2) = {5 : 8}; Plane Surface(2) = {2}; Physical Surface("disc") = {2};
Physical Curve("round") = {5, 6}; Physical Curve("flat") = {7, 8};
"""
LOW = polygon("block", 0.25, ["-2, -2", "2, -2", "2, 0", "-2, 0"], {1: "base", 3: "top"})
BOTH = "body block E 100 nu 0.3\nbody disc E {} nu 0.3\n"


def pressed(legs, shape="circle {} {} R 1", at=(-0.4, 1), matrix=UNTURNED):
    """Case: a block and a rigid body, both turned by the matrix; legs: steps and the way of the rigid one."""

    def placed(*x):
        return [repr(float(v)) for v in (matrix @ [*x, 0])[:2]]

    obstacle = "obstacle top " + shape.format(*placed(*at), *placed(0, 1))
    lines = ["body block E 100 nu 0.3", "clamp base"]
    for k, (steps, *way) in enumerate(legs):
        line = " ".join([obstacle, *(["friction 0.3"] if k == 0 else []), "move", *placed(*way)])
        lines += [line, f"leg {steps}"] if k == 0 else [f"leg {steps}", line]
    return "\n".join([*lines, ""])


def rows(run, *names):
    found = series(run)
    return np.array([np.atleast_1d(found[name]) for name in names])


def test_true_distance_of_a_plane_is_the_linear_one(tmp_path):
    """Pressed and dragged along a rigid plane by half the body's size, block and plane turned and mirrored."""
    mesh, found = block(Mesh(), (4, 2), (16, 8), (-2, -2)), []
    for k, (turned, flags) in enumerate([(False, ()), (True, EXACT)]):
        matrix = turn(0.5) @ np.diag([-1.0, 1, 1]) if turned else np.eye(3)
        (tmp_path / f"{k}.msh").write_text(mesh.text(matrix))
        text = pressed([(1, 0, -0.05), (2, 1, -0.1), (2, -1, -0.06)], "plane {} {} {} {}", (0, 0), matrix)
        text = re.sub(r"(plane \S+ \S+) (\S+) (\S+)", lambda m: f"{m[1]} {-float(m[2])!r} {-float(m[3])!r}", text)
        text = text.replace("clamp base", "clamp bottom")
        run = case(tmp_path, tmp_path / f"{k}.msh", text, *flags, "-tol", 1e-11)
        found.append(rows(run, "force", "work", "stored", "dissipated"))
        found[-1][0] = [run.summary["contacts"][0]["normalForce"]]
    assert found[1] == pytest.approx(found[0], rel=1e-9)


def test_drag_over_many_elements(tmp_path):
    """Over seven elements: a rigid disc and the same as a stiff body, whose surface is the master."""
    rigid = case(tmp_path, LOW, pressed([(1, 0, -0.05), (2, 0.5, -0.05)], at=(-0.5, 1)), *EXACT)
    text = BOTH.format(1e7) + "clamp base\ncontact top round friction 0.3\nleg 1\nmove flat 0 -0.05\n"
    text += "leg 2\nmove flat 0.5 -0.05\n"
    stiff = case(tmp_path, LOW.replace("Physical Curve", HALF + "Physical Curve", 1), text, *EXACT)
    for name in ("force", "shearForce", "stored", "dissipated"):
        assert rows(stiff, name)[0][1:] == pytest.approx(rows(rigid, name)[0][1:], rel=1e-3), name


def test_dragged_onto_what_nothing_faced(tmp_path):
    """Half a disc, stiffer than the block: points that had nothing opposite come to bear."""
    disc = [
        f"Point({5 + k}) = {{{x}, 0, 0.1}};" for k, x in enumerate(("-0.4, 0.5", "-0.9, 0.5", "-0.4, 0", "0.1, 0.5"))
    ]
    disc += ["Circle(5) = {6, 5, 7}; Circle(6) = {7, 5, 8}; Line(7) = {8, 6};"]
    disc += ["Curve Loop(5) = {5:7}; Plane Surface(5) = {5};", 'Physical Surface("disc") = {5};']
    disc += ['Physical Curve("round") = {5, 6}; Physical Curve("hub") = {7};']
    lower = polygon("block", 0.1, ["-1.5, -0.5", "1.5, -0.5", "1.5, 0", "-1.5, 0"], {1: "base", 3: "top"})
    text = BOTH.format(2000) + "clamp base\ncontact top round friction 0.3\nleg 1\nmove hub 0 -0.02\n"
    run = case(tmp_path, lower + "\n".join([*disc, ""]), text + "leg 2\nmove hub 0.6 -0.02\n", *EXACT)
    contact = run.summary["contacts"][0]
    assert contact["shearForce"][0] == pytest.approx(0.3 * contact["normalForce"], rel=0.02)


def test_little_friction_with_the_true_distance(tmp_path):
    """Of a disc that goes far: the frictionless rounds and numbers."""
    geometry = LOW.replace("Physical Curve", HALF + "Physical Curve", 1)
    text = BOTH.format(100) + "clamp base\ncontact round top{}\nmove flat 0.5 -0.05\n"
    flags = (*EXACT, "-history", 1, "-steps", 1, "-tol", 1e-10)
    one, other = (case(tmp_path, geometry, text.format(words), *flags) for words in ("", " friction 1e-8"))
    assert one.summary["rounds"] == other.summary["rounds"]
    assert abs(one.summary["newton"] - other.summary["newton"]) < 0.5 * one.summary["newton"]
    assert rows(other, "force")[0] == pytest.approx(rows(one, "force")[0], rel=1e-7)


def test_rotation_by_a_radian_drags(tmp_path):
    """A disc that turns on a block which is pushed up: what is lost is the bound times the way."""
    geometry = LOW.replace("Physical Curve", HALF + "Physical Curve", 1)
    text = BOTH.format(100) + "contact top round friction 0.3\nleg 3\nmove base 0 0.05\nrotate flat -0.5 1 -1\n"
    run = case(tmp_path, geometry, text, *EXACT)
    bound = 0.3 * run.summary["contacts"][0]["normalForce"]
    # the force grows a little faster than the way in
    assert 0.4 * bound < rows(run, "dissipated")[0][-1] < 0.5 * bound


# a wedge in a frame, pressed in, let go, and pulled
CORNERS = ["-2, -3", "9, -3", "9, 0", "0, 0", "0, 1", "9, 1.9", "9, 5", "-2, 5"]
FRAME = polygon("frame", 20, CORNERS, {1: "base", 3: "floor", 5: "roof"})
CORNERS = ["1, 0", "11, 0", "11, 2.1", "1, 1.1"]
FRAME += polygon("wedge", 20, CORNERS, {1: "below", 2: "head", 3: "above", 4: "tip"}, 9)
FRAMED = """body frame E 210e3 nu 0.3
body wedge E 210e3 nu 0.3
contact below floor friction 0.15
contact above roof friction 0.15
clamp base
leg 2
traction head -50 0
leg 2
traction head -0.05 0
leg 2
traction head {pull} 0
"""


def pulled(folder, pull, size, *flags, text=FRAMED, **how):
    mesh = f"{FRAME}Mesh.MeshSizeMax = {size};\n"
    return case(folder, mesh, text.format(pull=pull), "-order", 1, "-vtu", 0, *flags, **how)


def bracket(run, step):
    """Shares of the leg, in per cent, between which a load step has found no equilibrium."""
    shares = re.search(rf"^{step} \(([\d.]+) % to ([\d.]+) % of the leg\): wedge: ", run.summary["message"])
    return float(shares[1]), float(shares[2])


def test_path_that_ends(tmp_path):
    """A pull of 7.04 is the most that a locked wedge bears: the load step is taken in parts up to where that is."""
    assert [text for text in pulled(tmp_path / "low", 5, 0.7).summary["warnings"] if "energies" in text] == []
    run = pulled(tmp_path / "high", 12, 0.7, expect=20)
    least, most = bracket(run, "leg 3, load step 2 of 2")
    assert 0 < most - least < 0.12 and 0.12 * least == pytest.approx(7.04, abs=0.02)
    assert len(series(run)) == 5 and series(run)["newton"][-1] == 5


@pytest.mark.parametrize("steps", [1, 4])
def test_locked_wedge_pulled_at_once(tmp_path, steps):
    """From sliding in to a pull in one load step: it is locked, as if let go first, and its energies balance."""
    legs = f"leg 2\ntraction head -50 0\nleg {steps}\ntraction head 6.5 0\n"
    run = pulled(tmp_path, 0, 0.7, text=FRAMED[: FRAMED.index("leg")] + legs)
    rows = series(run)
    assert [text for text in run.summary["warnings"] if "energies" in text] == []
    assert rows["force"][-1] == pytest.approx(568.991, rel=1e-5)
    assert rows["shearForce"][-1] == pytest.approx(-41.823, rel=1e-4)
    assert rows["dissipated"][-1] == pytest.approx(rows["dissipated"][1], rel=1e-3)
    assert steps > 1 or rows["newton"][-1] - rows["newton"][1] <= 3
    # what the parts of the last step dissipate is the step's
    last = [contact["mesh"]["dissipatedLastStep"] for contact in run.summary["contacts"]]
    lost = np.diff(rows["dissipated"])[-1]
    assert sum(part["value"] for part in last) == pytest.approx(lost, rel=1e-9)
    assert last[1]["error"] is None


def test_error_beyond_the_energies_of_a_step(tmp_path):
    """An error of the dissipated energy beyond all that the step moves is not known, and the screen says so."""
    run = pulled(tmp_path, 5, 0.5, "-estimate", 1)
    rows = series(run)
    step = sum(abs(rows[name][-1] - rows[name][-2]) for name in ("work", "stored", "dissipated"))
    for contact in run.summary["contacts"]:
        last = contact["mesh"]["dissipatedLastStep"]
        assert 0 < last["value"] < step and last["error"] is None
    assert len(re.findall(r"dissipated, last step +\S+  error not known", run.stdout)) == 2


def test_body_that_comes_free(tmp_path):
    """A step without a solution names the body that friction may not hold."""
    run = pulled(tmp_path, 16, 0.7, expect=20)
    assert "along y: friction may no longer hold it, then there is no equilibrium: less load" in run.summary["message"]
    assert 0.16 * bracket(run, "leg 3, load step 1 of 2")[0] == pytest.approx(7.04, abs=0.02)
    # a wall that it rests on backs off: nothing presses on the state where the step ends
    text = (
        FRAMED[: FRAMED.index("leg")]
        + """leg 2
obstacle head plane 11 1 -1 0 move -0.05 0
leg 1
obstacle head move 2 0
"""
    )
    flags = ("-order", 1, "-vtu", 0)
    # by rounding the iteration ends there, or finds a state far away, whose gaps are told to be those at rest
    run = case(tmp_path / "wall", f"{FRAME}Mesh.MeshSizeMax = 0.7;\n", text, *flags, expect=None)
    if run.code == 20:
        assert "leg 2: wedge: along x: nothing presses on it any more: end" in run.summary["message"]
    else:
        assert run.code == 0 and "slide along each other by more than 100 times" in run.stdout


def test_light_prism_falls_into_a_groove(tmp_path):
    """Steel under its own weight, a gap above: it hangs on nothing before it touches; then pushed aside, it stays."""
    geo = polygon("prism", 0.3, ["0, 0.01", "1, 1.01", "-1, 1.01"], {1: "right", 3: "left"})
    side = "obstacle {0} plane 0 0 {1} 1 friction 0.3\n"
    text = "body prism E 210e3 nu 0.3\n" + side.format("right", -1) + side.format("left", 1)
    run = case(tmp_path, geo, text + "leg 1\nweight prism 0 -77e-6\nleg 2\nweight prism 7.7e-6 -77e-6\n", "-order", 1)
    # of the planes the right one bears more, all of it with little shear
    forces = np.array([contact["force"] for contact in run.summary["contacts"]])
    assert abs(forces).sum(axis=0)[1] == pytest.approx(77e-6, rel=1e-5) and run.summary["newton"] == 3
    assert abs(forces[:, 0].sum()) == pytest.approx(7.7e-6, rel=1e-5)


def test_arch_on_its_feet(tmp_path):
    """Its feet slip outwards under its weight; half the load of sliding leaves it where it is."""
    run = case(tmp_path, ARCHED, ON_FEET + "leg 2\nweight up 0 -1\nleg 2\nweight up 0.05 -1\n")
    rows = series(run)
    assert rows["force"] == pytest.approx([0.82, 1.64, 1.64, 1.64], rel=1e-6)
    assert abs(rows["shearForce"]) == pytest.approx([0, 0, 0.041, 0.082], abs=1e-6)
    # both sliding feet start far off: 25 to 42 by the rounding of the matrices, in parts of the step
    assert rows["newton"][-1] <= 60


def test_geometry_updates_are_no_load_steps(tmp_path):
    """The table of a path with geometry updates names its load steps by their numbers."""
    text = FRAMED[: FRAMED.index("leg")] + "leg 3\ntraction head -50 0\n"
    run = case(tmp_path, f"{FRAME}Mesh.MeshSizeMax = 0.7;\n", text, "-order", 1, "-vtu", 0, *EXACT)
    assert run.stdout.count("of the exact distance: ") >= 3
    assert re.findall(r"^ .*   step (\d+)$", run.stdout, re.M) == ["2", "3"]


def test_a_loop_is_closed_in_force_and_displacement():
    """The energy of a loop shall be shown of one that closes: not of a cycle that ends elsewhere than it began."""
    shear = np.array([0.0, 1, 0, -1, 0, 1])
    assert last_loop(np.array([0.0, 2, 1.5, 0, 0.5, 1]), shear) is None
    assert last_loop(np.array([0.0, 1, 0.5, 0, 0.5, 1]), shear) == (1, 5)
