"""The truth is within what a run says, or a warning names the cause and its size: small parts whose truth is known.

Covered and warned of mean what they mean in campaigns/foreign.py. Marks of xfail are what is not so yet.
"""

import json
import re
from itertools import product

import foreign
import numpy as np
import pytest
from foreign_parts import Draw, Sketch, parts
from freefem import FREEFEM, ROOT, cases_of, data, execute, part, snippet, told
from input.test_parts import Mesh, block, turn, vector
from solver.test_turning import rotation

MEMORY = 3_000_000  # kB: a run that wants more shall end, not the machine


class Told:
    """What a run printed and wrote."""

    def __init__(self, folder, geo, case, *flags, space=False, expect=0, vtu=0):
        mesh, case_file, out = folder / "part.geo", folder / "part.case", folder / "out"
        mesh = mesh if "Point" in geo or "OpenCASCADE" in geo else mesh.with_suffix(".msh")
        mesh.write_text(geo)
        case_file.write_text(case)
        script = f"edp/parts{'-3d' * space}.edp"
        command = [*FREEFEM, script, "-mesh", mesh, "-case", case_file, "-out", out, "-vtu", vtu, *flags]
        code, self.stdout = execute(["sh", "-c", f'ulimit -v {MEMORY}; exec "$@"', "sh", *command])
        assert code == expect, f"exit code {code}:\n{self.stdout[-2000:]}"
        self.summary = json.loads((out / "summary.json").read_text()) if code in (0, 21) else {}
        self.record = foreign.record_of(self.summary)
        self.numbers = self.record["numbers"]
        self.warnings = " | ".join(self.record["warnings"])

    def holds(self, name, truth):
        """The truth is covered, or warned of."""
        value, said = self.numbers[name]
        assert said is not None, f"{name}: no error"
        error = abs(value - truth)
        assert error <= said or foreign.warned(name, value, error, self.record)[0], (
            f"{name}: {value:.9g} ± {said:.2g}, truth {truth:.9g}; {self.warnings}"
        )


def drawn(name):
    """A part of the campaign's."""
    return next(part for part in parts() if part.name == name)


# ---------------------------------------------------------------- shape in the plane

STEEL = "E 210e3 nu 0.3"
RINGS = f"body inner {STEEL}\nbody outer {STEEL}\ncontact hub shaft\n"
LAME = 679.671  # of rings of 10, 20.002 and 20, 30: integral of the pressure


def rings(order=1, sides=8):
    """A press fit: 64 edges in contact, 8 elsewhere."""
    sketch = Sketch(Draw(order=order, named=True))
    sketch.turn(0.02)
    shaft, bore = sketch.oval(0, 0, 20.002, 20.002, 2, 80), sketch.oval(0, 0, 10, 10, 8, sides)
    sketch.turn(0)
    hub, outside = sketch.oval(0, 0, 20, 20, 2, 64), sketch.oval(0, 0, 30, 30, 24, sides)
    sketch.body("inner", shaft, bore)
    sketch.body("outer", outside, hub)
    return sketch.named(shaft=shaft, hub=hub)


@pytest.fixture(scope="module")
def rings_run(tmp_path_factory):
    return Told(tmp_path_factory.mktemp("rings"), rings(), RINGS)


def test_few_sides(rings_run):
    """Free circles of 8 sides."""
    rings_run.holds("contacts.0.normalForce", LAME)


@pytest.mark.parametrize("flags", [["-order", 4], ["-accuracy", 1e-3]])
def test_few_sides_otherwise(go, flags):
    """The same with P4, and with new meshes."""
    go(rings(), RINGS, *flags).holds("contacts.0.normalForce", LAME)


def test_quadratic_sides(go):
    """Sides through true middles are not the circle either."""
    go(rings(2), RINGS + "pressure rest 0\n", "-accuracy", 1e-3).holds("contacts.0.normalForce", LAME)


DISC_ON_PLANE = "body disc E 1000 nu 0.3\nobstacle rim plane 0 -1 0 1\nweight disc 0 -1\n"


def disc():
    sketch = Sketch(Draw())
    rim = sketch.oval(0, 0, 1, 1, 0.5, bottom=0.12)
    sketch.body("disc", rim)
    return sketch.named(rim=[rim[0], rim[3]])


def test_weight(go):
    """A polygon weighs less than the disc."""
    go(disc(), DISC_ON_PLANE).holds("contacts.0.force", np.pi)


def test_gear(go):
    """1884.5 by an independent code on the true outline."""
    geo = (ROOT / "tests/data/gear-pair.geo").read_text()
    geo += 'Physical Curve("pinion-rest") = {cp+1:cp+6}; Physical Curve("wheel-rest") = {cg+1:cg+6};\n'
    case = (
        "body pinion E 206e3 nu 0.3\nbody wheel E 206e3 nu 0.3\ncontact wheel-flank pinion-flank\nclamp wheel-rim\n"
        "rotate pinion-rim 0 -50 0.002\npressure pinion-rest 0\npressure wheel-rest 0\n"
    )
    go(geo, case, "-accuracy", 1e-3).holds("contacts.0.force", 1884.5)


# ---------------------------------------------------------------- the warning of polygons


def test_named_boundaries(go):
    """The cure that the warning words: a second-order mesh with these boundaries named."""
    told = go(rings(2, sides=24), RINGS)
    assert "polygon" not in told.warnings
    told.holds("contacts.0.normalForce", LAME)


def test_true_kinks(go):
    """A true polygon of 11 sides: nothing is cut off."""
    part = drawn("polygon 2")
    assert "polygon" not in go(part.geo(Draw(1.3)), part.case).warnings


# ---------------------------------------------------------------- shape in space

COLUMN = "body column E 1000 nu 0\nobstacle sole plane 0 0 0 0 0 1\nmove head 0 0 -0.01\n"


LIFTED = (
    'e[] = Extrude{0, 0, 2} {Surface{1}; Layers{2};}; Physical Volume("column") = {e[1]};\n'
    'Physical Surface("sole") = {1}; Physical Surface("head") = {e[0]};'
)


def column(order, sides=12):
    sketch = Sketch(Draw(order=order))
    sketch.body("flat", sketch.oval(0, 0, 1, 1, 1, sides))
    sketch.names.clear()
    return sketch.text(LIFTED)


@pytest.mark.parametrize("order, sides", cases_of([(1, 5)], [(1, 12), (2, 12), (2, 40)]))
def test_column(go, order, sides):
    """nu = 0: E strain everywhere, times the circle's area; geometry or mesh tells five sides from a pentagon."""
    told = go(column(order, sides), COLUMN, space=True)
    told.holds("contacts.0.force", 5 * np.pi)
    value, said = told.numbers["contacts.0.force"]
    assert said < 3 * abs(value - 5 * np.pi)
    assert told.summary["contacts"][0]["pressureMax"] == pytest.approx(5, rel=1e-5) and not told.summary["warnings"]


def test_accuracy_of_a_column(go):
    """Its circles have 12 sides on every mesh: that is said, and no digits are claimed."""
    told = go(column(1), COLUMN, "-accuracy", 1e-5, space=True, expect=21)
    told.holds("contacts.0.force", 5 * np.pi)
    assert "sides on curves as long as before" in told.summary["accuracy"]["why"]


def test_true_prism(go):
    """A pentagon that is meant: its shape is known, and costs nothing."""
    sketch = Sketch(Draw())
    corners = [(np.cos(t), np.sin(t), 0.6) for t in 2 * np.pi * np.arange(5) / 5]
    sketch.body("flat", sketch.outline(corners)[0])
    sketch.names.clear()
    told = go(sketch.text(LIFTED), COLUMN, space=True)
    value, said = told.numbers["contacts.0.force"]
    assert value == pytest.approx(12.5 * np.sin(2 * np.pi / 5), rel=1e-6)
    assert said < 1e-5


def test_press_fit_in_space(go):
    part = drawn("press fit in space 1")
    told = go(part.geo(Draw(order=2)), part.case, space=True)
    told.holds("contacts.0.normalForce", part.known["contacts.0.normalForce"][0])


# ---------------------------------------------------------------- the linearised gap

HIP = (
    "state axisymmetric\nbody head E 230e3 nu 0.3\nbody cup E 800 nu 0.46\ncontact cup-bore head-surface\n"
    "clamp shell\nforce grip 0 -2500\npressure rest 0\n"
)


def hip(size=0.5):
    """A ball of 14 in a cup, 0.1 of clearance; second order."""
    sketch = Sketch(Draw(order=2, named=True))
    centre = [sketch.point(0, y, 2) for y in (0, 0.1)]
    arcs, ends = [], []
    for radius, c, h in ((14, 0, size), (14.1, 1, size), (24, 1, 2)):
        ends.append([sketch.point(0, 0.1 * c - radius, h), sketch.point(radius, 0.1 * c, h)])
        arcs.append(sketch.curve("Circle", ends[-1][0], centre[c], ends[-1][1]))
    axis, top = sketch.curve("Line", centre[0], ends[0][0]), sketch.curve("Line", ends[0][1], centre[0])
    low, side = sketch.curve("Line", ends[2][0], ends[1][0]), sketch.curve("Line", ends[1][1], ends[2][1])
    sketch.body("head", [axis, arcs[0], top])
    sketch.body("cup", [low, arcs[1], side, -arcs[2]])
    return sketch.named(head_surface=[arcs[0]], grip=[top], cup_bore=[arcs[1]], shell=[arcs[2]])


@pytest.fixture(scope="module")
def hip_run(tmp_path_factory):
    """The hip joint with the linear gap."""
    return Told(tmp_path_factory.mktemp("hip"), hip(), HIP)


def nose(slave, master):
    """A round nose, sizes of elements on it and on the floor below."""
    sketch = Sketch(Draw())
    low, _ = sketch.outline([(-6, -5, 1), (6, -5, 1), (6, 0, 1.5 * master), (0, 0, master), (-6, 0, 1.5 * master)])
    top, x = sketch.point(0, 5, 1), 1.4
    places = [(-4, 2, 0.8), (-x, 5 - np.sqrt(25 - x * x), slave), (0, 0, slave), (x, 5 - np.sqrt(25 - x * x), slave)]
    knots = [sketch.point(*place) for place in (*places, (4, 2, 0.8))]
    arcs = [sketch.curve("Circle", knots[k], top, knots[k + 1]) for k in range(4)]
    head = sketch.curve("Line", knots[4], knots[0])
    sketch.body("low", low)
    sketch.body("up", [*arcs, head])
    return sketch.named(base=[low[0]], floor=[low[2], low[3]], nose=arcs, head=[head])


NOSE = "body low E 1 nu 0.3\nbody up E 1 nu 0.3\ncontact nose floor\nclamp base\nmove head 0 -0.08\n"


# ---------------------------------------------------------------- the master's mesh


@pytest.mark.parametrize("name, truth", [("pressureMax", 0.032226), ("contactLength", 1.1319)])
def test_coarse_master(nose_run, name, truth):
    """A fine slave on a coarse master of its stiffness; P4 on fine meshes."""
    nose_run.holds(f"contacts.0.{name}", truth)


@pytest.fixture(scope="module")
def nose_run(tmp_path_factory):
    return Told(tmp_path_factory.mktemp("nose"), nose(0.05, 0.8), NOSE)


# ---------------------------------------------------------------- singular places


def test_crack(go):
    part = drawn("crack 2")
    told = go(part.geo(Draw()), part.case)
    for name, (truth, _) in part.known.items():
        told.holds(name, truth)


def test_edge(go):
    """A greatest pressure that grows without bound has no error, and its place is named."""
    part = drawn("punch 1")
    told = go(part.geo(Draw(1.5)), part.case)
    assert told.numbers["contacts.0.pressureMax"][1] is None
    assert foreign.SINGULAR.search(told.warnings)


def test_edge_in_space(go):
    """A cube on a block, quarters, nu near 0.5."""
    geo = data("truth/quarters.geo")
    names = {"sole": 5, "head": 6, "floor": 12, "base": 11, "ux": 2, "uy": 4, "lx": 8, "ly": 10}
    geo += "".join(f'Physical Surface("{name}") = {{{tag}}};\n' for name, tag in names.items())
    case = "body up E 1000 nu 0.4999\nbody low E 1000 nu 0.4999\ncontact sole floor\nclamp base\n"
    case += "".join(f"symmetry {name}\n" for name in ("ux", "uy", "lx", "ly")) + "move head 0 0 -0.01\n"
    told = go(geo, case, space=True)
    assert told.numbers["contacts.0.pressureMax"][1] is None
    assert foreign.SINGULAR.search(told.warnings)


KINKED = """
h = SIZE; t = TAN;
Point(1) = {0, 0, 0, h}; Point(2) = {4, 0, 0, h}; Point(3) = {4, 2, 0, h}; Point(4) = {2, 2 - 2 * t, 0, h};
Point(5) = {0, 2, 0, h}; Point(6) = {2, 2 - 2 * t + (1 + t * t) / t, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; SIDES Line(5) = {5, 1}; Curve Loop(1) = {1:5}; Plane Surface(1) = {1};
"""
NAMED = """
Physical Surface("plate") = {1}; Physical Curve("left") = {5}; Physical Curve("right") = {2};
"""
SOLID = """
o[] = Extrude {0, 0, 1} { Surface{1}; };
Physical Volume("plate") = {1}; Physical Surface("left") = {o[6]}; Physical Surface("right") = {o[3]};
Physical Surface("front") = {1};
"""
SIDES = {"lines": "Line(3) = {3, 4}; Line(4) = {4, 5};", "arcs": "Circle(3) = {3, 6, 4}; Circle(4) = {4, 6, 5};"}
PULLED = "body plate E 1000 nu 0.3\nobstacle right plane AWAY\nclamp left\nstresses\n"


@pytest.mark.parametrize(
    "sides, space", cases_of([("lines", False), *product(SIDES, [True])], product(SIDES, (False, True)))
)
def test_kink_without_bound(go, sides, space):
    """A re-entrant corner of 204 degrees has no bound; a smooth curve of the same depth, of few sides, has one."""
    rise = 0.7 if space else np.tan(np.radians(12))
    depth = 2 - 2 * rise
    geo = KINKED.replace("SIZE", "0.35" if space else "0.4").replace("TAN", f"{rise}").replace("SIDES", SIDES[sides])
    case = PULLED.replace("AWAY", "10 0 0 -1 0 0" if space else "10 0 -1 0")
    case += "symmetry front\ntraction right 1 0 0\n" if space else "traction right 1 0\n"
    (one,) = go(geo + (SOLID if space else NAMED), case, space=space).summary["stresses"]
    if sides == "lines":
        assert one["singular"][:2] == pytest.approx([2, depth], abs=0.3)
        assert np.hypot(one["at"][0] - 2, one["at"][1] - depth) > 0.8
    else:
        assert one["singular"] is None
        assert one["at"][:2] == pytest.approx([2, depth], abs=0.3)


def test_half_a_kink_without_bound(go):
    """The half of a re-entrant corner of 204 degrees: on the plane of symmetry its side turns to the other side."""
    geo = KINKED.replace("Point(3) = {4, 2, 0, h}; ", "").replace("{4, 0, 0, h}", "{2, 0, 0, h}")
    geo = geo.replace("SIZE", "0.35").replace("TAN", "0.7").replace("SIDES", "Line(4) = {4, 5};")
    geo = geo.replace("Line(2) = {2, 3};", "Line(2) = {2, 4};").replace("{1:5}", "{1, 2, 4, 5}")
    solid = SOLID.replace("o[6]", "o[5]")
    case = "body plate E 1000 nu 0.3\nobstacle left plane -9 0 0 1 0 0\nsymmetry right\nsymmetry front\n"
    case += "traction left -1 0 0\nstresses\nspring left 0.001 0.001 0.001\n"
    (one,) = go(geo + solid, case, space=True).summary["stresses"]
    assert one["singular"][:2] == pytest.approx([2, 0.6], abs=0.3)


HOLLOWS = {
    "bore": ("Cylinder", "0, 0, 0, 0, 0, 1, R, Pi/2", (0.707, 0.707, 0.5), 7),
    "ball": ("Sphere", "0, 0, 0, R, 0, Pi/2, Pi/2", (0.577, 0.577, 0.577), 36 / 7),
}


@pytest.mark.parametrize(
    "shape, mesh",
    [*product(HOLLOWS, ["Transfinite Curve {:} = 4;"]), ("bore", "Mesh.ElementOrder = 1; Mesh.MeshSizeMax = 0.4;")],
)
def test_smooth_hollow_has_a_bound(go, shape, mesh):
    """A thick ring and a hollow ball, pressed from inside (Lame): a smooth wall, coarse or straight, is no edge."""
    kind, numbers, (x, y, z), mises = HOLLOWS[shape]
    geo = 'SetFactory("OpenCASCADE");\n'
    for k in (1, 2):
        geo += f"{kind}({k}) = {{{numbers.replace('R', str(k))}}};\n"
    geo += "BooleanDifference(3) = { Volume{2}; Delete; }{ Volume{1}; Delete; };\n" + mesh + "\n"
    case = "group part near 0.7 0.7 0.7\nbody part E 1000 nu 0.3\nstresses\n"
    for name, normal in {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}.items():
        case += f"group {name} plane 0 0 0 {normal}\nsymmetry {name}\n"
    case += f"group wall near {x} {y} {z}\npressure wall 3\n"
    case += f"group skin near {2 * x} {2 * y} {2 * z}\nobstacle skin plane 9 9 9 -1 -1 -1\n"
    (one,) = go(geo, case, space=True).summary["stresses"]
    assert one["singular"] is None
    assert np.linalg.norm(one["at"][: 3 if shape == "ball" else 2]) == pytest.approx(1, abs=0.02)
    assert one["vonMises"] == pytest.approx(mises, rel=0.05)


def test_clamped_rim_of_unnamed_sides(go):
    """A bar whose sides are in no group: all of the clamped rim has no bound, the greatest stress is elsewhere."""
    geo = 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 2, 2, 6};\nMesh.MeshSizeMax = 0.5;\n'
    groups = "group bar near 1 1 3\ngroup foot plane 1 1 0 0 0 1\ngroup head plane 1 1 6 0 0 1\n"
    case = "body bar E 1000 nu 0.45\nclamp foot\nobstacle head plane 1 1 6 0 0 -1 move 0 0 -0.06\nstresses\n"
    (one,) = go(geo, groups + case, space=True).summary["stresses"]
    assert one["singular"][2] == 0
    assert one["at"][2] > 1
    assert one["vonMises"] == pytest.approx(10, rel=0.1)


def test_kink_on_a_mirror(go):
    """Half of a kink, a line at 102 degrees to a mirror, has no bound; a coarse hole at 90 to it has one."""
    case = "body plate E 1000 nu 0.3\nobstacle pulled plane 10 0 -1 0\nsymmetry below\nsymmetry side\n"
    case += "traction pulled 1 0\nstresses\n"
    geo = "Point(1) = {X, 0, 0, 0.6}; Point(2) = {4, 0, 0, 0.6}; Point(3) = {4, 4, 0, 0.6};\n"
    geo += "Point(4) = {0, Y, 0, 0.6};\n"
    geo += "Point(5) = {0, X, 0, 0.6}; Point(6) = {0, 0, 0}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};\n"
    geo += 'LAST Plane Surface(1) = {1}; Physical Surface("plate") = {1}; Physical Curve("below") = {1};\n'
    geo += 'Physical Curve("pulled") = {2}; Physical Curve("side") = {4};\n'
    kink = geo.replace("X", "0").replace("Y", "3.15").replace("LAST", "Line(4) = {4, 1}; Curve Loop(1) = {1:4};")
    (one,) = go(kink, case).summary["stresses"]
    assert one["singular"] == pytest.approx([0, 3.15])
    hole = "Line(4) = {4, 5}; Circle(5) = {5, 6, 1}; Curve Loop(1) = {1:5};"
    (one,) = go(geo.replace("X", "1").replace("Y", "4").replace("LAST", hole), case).summary["stresses"]
    assert one["singular"] is None
    assert one["at"] == pytest.approx([0, 1], abs=0.3)


ON_WIDER = data("truth/on-wider.geo")


@pytest.mark.parametrize(
    "contact, nose",
    cases_of([("foot face", "sharp"), ("face foot", "round")], [("face foot", "sharp"), ("foot face", "round")]),
)
def test_opposite_a_corner(go, contact, nose):
    """Both bodies' stresses have no bound where a block's corner presses on a wider one, and have one below a nose."""
    rise, side = ("0", "Line(1) = {1, 2}") if nose == "sharp" else ("1", "Circle(1) = {1, 9, 2}")
    geo = ON_WIDER.replace("RISE", rise).replace("NOSE", f"{side}; Line(2)")
    case = "body up E 1000 nu 0.3\nbody low E 5000 nu 0.2\nsymmetry mirror\nsymmetry below\npressure top 40\nstresses\n"
    for one in go(geo, f"{case}contact {contact} friction 0.3\n").summary["stresses"]:
        if nose == "sharp":
            assert one["singular"] == pytest.approx([2, 0], abs=0.3)
            assert np.hypot(one["at"][0] - 2, one["at"][1]) > 0.5
        else:
            assert one["singular"] is None
            assert one["error"] < 0.1 * one["vonMises"]


# ---------------------------------------------------------------- surfaces that no contact names

PIN = data("truth/pin.geo")
PINNED = "body pin E 200e3 nu 0.3\nbody plate E 200e3 nu 0.3\ncontact hole skin\nclamp left\n"


@pytest.mark.parametrize(
    "named, weight, code, warned",
    cases_of([("3, 4", 1000, 0, True)], [("1, 4", 1000, 0, False), ("3, 4", 5000, 20, True), ("1:4", 1000, 0, False)]),
)
def test_half_a_pin(go, named, weight, code, warned):
    """The half that is pressed is enough; a pin that leaves through what is unnamed is said first, or ends the run."""
    told = go(PIN.replace("NAMED", named), f"{PINNED}weight pin {weight} 0\n", "-estimate", 0, expect=code)
    says = [line for line in told.stdout.splitlines() if line.startswith("warning: ")]
    assert [k for k, line in enumerate(says) if "pass through" in line] == [0] * warned
    assert ("NOT CONVERGED: pin: moved by 3" in told.stdout) == (code == 20)


# ---------------------------------------------------------------- about an axis


def test_ball(go):
    """Hertz: a ball of 10 under its weight."""
    sketch = Sketch(Draw(order=2))
    centre = sketch.point(0, 10, 2)
    angle, near = 0.12, 0.05
    places = [(0, 0, near), (10 * np.sin(angle), 10 - 10 * np.cos(angle), near), (10, 10, 2), (0, 20, 2)]
    points = [sketch.point(*place) for place in places]
    arcs = [sketch.curve("Circle", points[k], centre, points[k + 1]) for k in range(3)]
    axis = [sketch.curve("Line", points[3], centre), sketch.curve("Line", centre, points[0])]
    sketch.body("ball", [*arcs, *axis])
    sketch.group("low", arcs[:1])
    sketch.group("rest", arcs[1:])
    density = 50 / (4 / 3 * np.pi * 1000)
    case = "state axisymmetric\nbody ball E 1000 nu 0.3\nobstacle low plane 0 0 0 1\npressure rest 1e-9\n"
    told = go(sketch.text(), f"{case}weight ball 0 {-density:.15g}\n")
    radius = (3 * 50 * 10 * (1 - 0.09) / (4 * 1000)) ** (1 / 3)
    told.holds("contacts.0.contactLength", radius)
    told.holds("contacts.0.pressureMax", 48.79)  # P4, 2.5 times as fine; Hertz, of a half-space: 48.89
    assert told.summary["contacts"][0]["halfWidthMoment"] == pytest.approx(radius, rel=2e-3)


def test_cup(hip_run):
    """A slave whose chain begins on the axis: the length is from there, not twice."""
    hip_run.holds("contacts.0.contactLength", 11.8)


@pytest.mark.parametrize("name, truth", [("contactLength", 20.94), ("pressureMax", 8.72)])
def test_conforming(ring_run, name, truth):
    """Two pieces of rings that touch all over: P2 with 5 elements on 8."""
    ring_run.holds(f"contacts.0.{name}", truth)


@pytest.fixture(scope="module")
def ring_run(tmp_path_factory):
    lines = ["Point(1) = {0, 0, 0};"]
    for k, (a, b, first, last, count) in enumerate(
        ((10, 20.00232, 0.3, 1.3472, 5), (19.99984, 30, 0.3, 1.3472, 8)), start=1
    ):
        p = 10 * k
        for j, (radius, angle) in enumerate(((a, first), (b, first), (b, last), (a, last))):
            lines.append(f"Point({p + j}) = {{{radius * np.cos(angle):.15g}, {radius * np.sin(angle):.15g}, 0}};")
        lines.append(f"Line({p}) = {{{p}, {p + 1}}}; Circle({p + 1}) = {{{p + 1}, 1, {p + 2}}};")
        lines.append(f"Line({p + 2}) = {{{p + 2}, {p + 3}}}; Circle({p + 3}) = {{{p + 3}, 1, {p}}};")
        lines.append(f"Transfinite Curve {{{p + 1}, {p + 3}}} = {count + 1}; Transfinite Curve {{{p}, {p + 2}}} = 5;")
        lines.append(f"Curve Loop({p}) = {{{p}:{p + 3}}}; Plane Surface({p}) = {{{p}}};")
        lines.append(f'Physical Surface("{("inner", "outer")[k - 1]}") = {{{p}}};')
        names = (("s1", "shaft", "s2", "bore"), ("s3", "outside", "s4", "hub"))[k - 1]
        lines += [f'Physical Curve("{name}") = {{{p + j}}};' for j, name in enumerate(names)]
    lines.append("Mesh.ElementOrder = 2;")
    case = RINGS.replace("contact", "symmetry s1\nsymmetry s2\nsymmetry s3\nsymmetry s4\ncontact")
    case += "pressure bore 5\npressure outside 3\n"
    return Told(tmp_path_factory.mktemp("ring"), "\n".join(lines), case)


# ---------------------------------------------------------------- what the numbers are


def test_force_about_an_axis(hip_run):
    """The force that is applied is the one that is printed."""
    assert hip_run.summary["force"] == pytest.approx(2500, rel=1e-6)
    assert re.search(r"resultant force +\(0, -2500\) +exact by equilibrium", hip_run.stdout)


def test_one_meaning(rings_run):
    """The resultant of a press fit is 0: its integral's error is not the resultant's."""
    told = rings_run.summary["estimates"]["force"]
    value, said = rings_run.numbers["contacts.0.force"]
    assert told is None or told["value"] == pytest.approx(value) or told["error"] < said / 100
    assert rings_run.summary["force"] is None
    assert abs(value) < 1e-9 < 600 < rings_run.numbers["contacts.0.normalForce"][0]


def test_ways(go):
    """A block pressed from three sides, two of which balance: nothing moves by 0.02, however it is turned."""
    mesh = block(Mesh(), size=(2, 1), cells=(8, 4))
    case = "body block E 1000 nu 0\nobstacle bottom plane 0 0 {} {}\n"
    case += "pressure top 0.02\npressure left 10\npressure right 10\n"
    ways = []
    for angle in (0, np.pi / 4):
        told = go(mesh.text(turn(angle)), case.format(-np.sin(angle), np.cos(angle)))
        ways.append(told.numbers["loads.0.way"][0] if "loads.0.way" in told.numbers else 0)
    assert max(np.abs(ways)) < 0.02
    assert ways[0] == pytest.approx(ways[1], rel=1e-6)


def test_opposite_planes(go):
    """A disc between two planes: what squeezes it is one plane's force."""
    sketch = Sketch(Draw())
    rim = sketch.oval(0, 0, 2, 2, 0.2)
    sketch.body("disc", rim)
    sketch.group("rim", rim)
    case = "body disc E 1000 nu 0.3\nobstacle rim plane 0 -2 0 1\nobstacle rim plane 0 2 0 -1 move 0 -0.05\n"
    told = go(sketch.text(), case)
    assert told.summary["force"] == pytest.approx(abs(told.summary["contacts"][1]["force"][1]), rel=1e-6)
    assert told.summary["estimates"]["force"]["error"] == told.numbers["contacts.1.force"][1] > 1e-3


# ---------------------------------------------------------------- robustness


def pie(slices=12):
    """A disc of triangles round one node."""
    mesh = Mesh()
    t = 2 * np.pi * np.arange(slices) / slices
    nodes = [(0, 0, 0), *zip(np.cos(t), np.sin(t), 0 * t, strict=True)]
    ring = [(k + 1, (k + 1) % slices + 1) for k in range(slices)]
    mesh.add(nodes, [("rim", pair) for pair in ring], [("disc", (0, *pair)) for pair in ring])
    return mesh.text()


def test_pie(go):
    go(pie(), "body disc E 1000 nu 0.3\nobstacle rim circle 0 0 R 1.001 inside\nweight disc 0 -1\n")


@pytest.mark.parametrize("sides", cases_of([8], [60]))
def test_coincident_nodes(go, sides):
    """Many nodes in one place; on few points an indefinite kernel: a press fit of 1e-7 between coarse circles."""
    sketch = Sketch(Draw())
    shaft, bore = sketch.oval(0, 0, 20 + 1e-7, 20 + 1e-7, 2, sides), sketch.oval(0, 0, 10, 10, 8, 7)
    hub, outside = sketch.oval(0, 0, 20, 20, 2, sides), sketch.oval(0, 0, 30, 30, 24, 5)
    sketch.body("inner", shaft, bore)
    sketch.body("outer", outside, hub)
    sketch.group("shaft", shaft)
    sketch.group("hub", hub)
    assert go(sketch.text(), RINGS).summary["converged"]


def test_ball_in_space(go):
    """The same in space: the ball's rotations are held by few points."""
    part = drawn("ball in space 2")
    assert go(part.geo(Draw(1.5)), part.case, "-estimate", 0, space=True).summary["converged"]


def blocks(size):
    sketch = Sketch(Draw())
    low, up = sketch.rectangle(-3, -2, 3, 0, size), sketch.rectangle(-1, 0, 1, 1, size)
    sketch.body("low", low)
    sketch.body("up", up)
    return sketch.named(base=[low[0]], floor=[low[2]], sole=[up[0]], head=[up[2]])


def test_nearly_incompressible(go):
    case = "body low E 1000 nu {0}\nbody up E 1000 nu {0}\ncontact sole floor\nclamp base\nmove head 0 -0.01\n"
    far, near = (go(blocks(0.5), case.format(nu), "-order", 4).numbers["contacts.0.force"] for nu in (0.49, 0.4999))
    assert near[1] / near[0] < 3 * far[1] / far[0]


def test_cycle(go):
    """A block between five obstacles: a cycle of four without a better start."""
    case = (
        "body block E 1000 nu 0.3\nobstacle bottom plane 0 0 0 1\nobstacle bottom circle 1 -3 R 3.001\n"
        "obstacle top circle 1 1.5 R 0.5 force 0 -20\nobstacle right plane 2 0 -1 0 move -0.001 0\n"
        "obstacle left plane 0 0 1 0\n"
    )
    sketch = Sketch(Draw())
    sides, _ = sketch.outline([(0, 0, 0.25), (2, 0, 0.25), (2, 1, 0.25), (0, 1, 0.25)])
    sketch.body("block", sides)
    for name, side in zip(("bottom", "right", "top", "left"), sides, strict=True):
        sketch.group(name, [side])
    go(sketch.text(), case, "-order", 1)


APART = DISC_ON_PLANE.replace("plane 0 -1 0 1", "plane 0 -2 0 1").replace("weight disc 0 -1", "clamp hub")


def test_accuracy_where_nothing_touches(go):
    sketch = Sketch(Draw())
    rim, hub = sketch.oval(0, 0, 1, 1, 0.3), sketch.oval(0, 0, 0.4, 0.4, 0.3)
    sketch.body("disc", rim, hub)
    sketch.group("rim", rim)
    sketch.group("hub", hub)
    told = go(sketch.text(), APART, "-accuracy", 1e-3)
    assert told.summary["contacts"][0]["normalForce"] == 0


# ---------------------------------------------------------------- open contacts, quarters, bodies that roll


def test_open_contact(go):
    """A contact that touches nowhere has no errors, and takes none from the others."""
    told = go(disc(), DISC_ON_PLANE + "obstacle rim plane 0 -9 0 1\n")
    assert told.numbers["contacts.1.pressureMax"] == [0, None]
    told.holds("contacts.0.normalForce", np.pi)
    assert "rim plane at (0, -9, 0) touches nowhere" in told.stdout
    way, error = told.numbers["loads.0.way"]
    assert error < 0.1 * way


def test_quarter(go):
    """What a quarter's contact carries at one mirror is no less for the other, which its group reaches too."""
    sketch = Sketch(Draw())
    centre, side, low = sketch.point(0, 0, 0.3), sketch.point(1, 0, 0.1), sketch.point(0, -1, 0.01)
    arc = sketch.curve("Circle", low, centre, side)
    mirrors = [sketch.curve("Line", centre, low), sketch.curve("Line", side, centre)]
    sketch.body("disc", [arc, mirrors[1], mirrors[0]])
    for word, curve in (("rim", arc), ("upright", mirrors[0]), ("level", mirrors[1])):
        sketch.group(word, [curve])
    case = "body disc E 1000 nu 0.3\nsymmetry upright\nsymmetry level\nobstacle rim plane 0 -0.99 0 1\n"
    told = go(sketch.text(), case)
    normal, force = (told.numbers[f"contacts.0.{name}"][0] for name in ("normalForce", "force"))
    assert normal > 1 and force == pytest.approx(normal, rel=1e-2)


@pytest.mark.parametrize("name", cases_of(["plank 2"], ["plank 1"]))
def test_plank_rolls(name, tmp_path):
    """A plank that leans on one round foot, or on none yet, shall roll on to the other, not from point to point."""
    part = next(part for part in parts(2) if part.name == name)
    told = Told(tmp_path, part.geo(Draw(order=2, named=True, smooth=True)), part.case)
    assert told.summary["newton"] <= 10
    assert all(contact["contactPoints"] > 0 for contact in told.summary["contacts"])


def bolt_head(f=1.0):
    """A bolt's head, whose edge is a fillet of 90 degrees, on a seat, about an axis."""
    sketch = Sketch(Draw())
    corners = [(0, -10, 2), (4, -10, 2), (4, -0.5, 0.3), (4, 0, 0.3), (7, 0, 0.2 * f, 0.4), (7, 5, 2), (0, 5, 2)]
    bolt, (fillet,) = sketch.outline(corners)
    plate, _ = sketch.outline([(4.3, -8, 2), (15, -8, 2), (15, 0, 2), (5, 0, 0.3), (4.3, -0.7, 0.3)])
    sketch.body("bolt", [*bolt[:4], fillet, *bolt[4:]])
    sketch.body("plate", plate)
    for name, curves in {
        "pull": bolt[:1],
        "head": [bolt[3], fillet],
        "axis": bolt[6:],
        "base": plate[:1],
        "seat": plate[2:4],
    }.items():
        sketch.group(name, curves)
    return sketch.text()


BOLT = (
    "state axisymmetric\nbody bolt E 210e3 nu 0.3\nbody plate E 70e3 nu 0.33\ncontact head seat\nclamp base\n"
    "symmetry axis\ntraction pull 0 -200\n"
)


@pytest.mark.parametrize("f", [1, 1.5])
def test_fillet_of_a_right_angle(go, f):
    """Normals at the fillet's end are parallel to the seat: gaps along them are no gaps of the true distance."""
    told = go(bolt_head(f), BOLT, "-distance", "exact")
    told.holds("loads.0.way", 0.02152)
    assert told.numbers["loads.0.way"][0] > 0.0205


def test_rounds_to_and_fro(go):
    """A disc on two others between two walls: a round overshoots more than the one before."""
    sketch = Sketch(Draw())
    for name, x, y in (("A", -5, 5), ("B", 5, 5), ("C", 0, 5 + 5 * np.sqrt(3))):
        rim = sketch.oval(x, y, 5, 5, 1, 56)
        sketch.body(name, rim)
        sketch.group(name + "r", rim)
    case = "body A E 2000 nu 0.3\nbody B E 3000 nu 0.3\nbody C E 1000 nu 0.3\n"
    case += "".join(
        f"obstacle {b}r plane 0 0 0 1\nobstacle {b}r plane {x} 0 {n} 0\n" for b, x, n in (("A", -10, 1), ("B", 10, -1))
    )
    case += "contact Cr Ar\ncontact Cr Br\nweight C 0 -0.3\nweight A 0 -0.1\nweight B 0 -0.1\n"
    go(sketch.text(), case, "-distance", "exact").holds("loads.0.way", 0.0462)


def test_soft_bed(go):
    """A nearly rigid block on soft springs, pushed beside its middle third: p = 2 F/l over l = 3 e."""
    sketch = Sketch(Draw())
    sides, _ = sketch.outline([(-6, 0, 1.5), (6, 0, 1.5), (6, 4, 1.5), (5, 4, 1.5), (3, 4, 1.5), (-6, 4, 1.5)])
    sketch.body("block", sides)
    sketch.group("sole", sides[:1])
    sketch.group("top", sides[3:4])
    law = "law power kappa 10 m 1.001 d0 -1e-6"
    case = f"state stress\nbody block E 1e9 nu 0.3\nobstacle sole plane 0 0 0 1 {law}\ntraction top 0 -10\n"
    told = go(sketch.text(), case)
    told.holds("contacts.0.pressureMax", 20 / 3)
    told.holds("contacts.0.contactLength", 6)
    told.holds("loads.0.way", 4 / 9)


def test_one_point_on_a_round_obstacle(go):
    """A roller between two edges of a notch: the normals at their points are known to half an element's turn."""
    sketch = Sketch(Draw())
    corners = [(0, 0, 1), (6, 0, 1), (6, 8, 1), (1.2, 8, 0.6), (1.2, 5, 0.8), (0, 5, 0.8)]
    sides, _ = sketch.outline(corners)
    sketch.body("block", sides)
    for name, curves in {"base": sides[:1], "lip": sides[2:4], "mid": sides[5:]}.items():
        sketch.group(name, curves)
    case = "body block E 70e3 nu 0.33\nobstacle lip circle 0 8.95 R 1.5 force 0 -150\nclamp base\nsymmetry mid\n"
    told = go(sketch.text(), case, "-distance", "exact")
    value, said = told.numbers["contacts.0.force"]
    assert value > 150 and 0.01 * value < said < value


RIM = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 7.78, 5.8, 0.87};
Box(2) = {0, 0, 0.87, 6.95, 5.14, 1.68};
Rotate {{2, -1, 1}, {0, 0, 0}, 0.29} { Volume{:}; }
Physical Volume("lower") = {1}; Physical Volume("upper") = {2};
Mesh.MeshSizeMax = 0.75;
"""


@pytest.mark.parametrize("order", [1, 2])
def test_rim_between_two_held_faces(tmp_path, order):
    """Points whose node is held, opposite held ones, carry nothing, though the meshes of the rim are not the same."""
    turned = rotation(0.29, (2, -1, 1))
    case = (
        "body lower E 70e3 nu 0.33\nbody upper E 70e3 nu 0.33\ngroup lo between lower upper\n"
        "group up between upper lower\ncontact lo up\nclamp held\n"
        f"group held plane 0 0 0 {vector((1, 0, 0), turned, 3)}\nweight upper {vector((0, 0, -1e3), turned, 3)}\n"
    )
    run = part(tmp_path, RIM, case, "-order", order, "-estimate", 0, space=True)
    assert 2e3 < run.summary["pressureMax"] < 1.2e4 and 1.5e4 < run.summary["contacts"][0]["normalForce"] < 3.5e4
    assert sum("more are held, and so is what is opposite" in text for text in run.summary["warnings"]) == 1


SOFT_AND_STIFF = data("truth/soft-and-stiff.geo")
CONFINED = 1000 * 0.7 / (1.3 * 0.4)  # the modulus of a column between walls, E 1000, nu 0.3


def stacked(folder, ratio, end, *flags, expect=0):
    """A soft column of height 2 below a stiff one of height 1, between walls."""
    case = (
        f"body soft E 1000 nu 0.3\nbody stiff E {1000 * ratio!r} nu 0.3\nsymmetry left\nsymmetry right\nsymmetry base\n"
    )
    return part(folder, SOFT_AND_STIFF, case + f"obstacle top plane 0 3 0 -1 {end}\n", *flags, expect=expect).summary


@pytest.mark.parametrize(
    "end, order", [("force 0 -10", 2), ("move 0 -0.01", 2), ("move 0 -0.01", 1), ("force 0 -10", 4)]
)
def test_stiff_body_on_a_soft_one(tmp_path, end, order):
    """Rounding of the stiff body's stiffness times its motion would resist the motion like a ground, by 1 %."""
    summary = stacked(tmp_path, 1e12, end, "-order", order)
    way = summary["estimates"]["loads"][0]["way"] if "force" in end else {"value": 0.01, "error": 0}
    force = summary["estimates"]["contacts"][0]["normalForce"]
    assert way["value"] / 2 * CONFINED == pytest.approx(10 if "force" in end else 0.005 * CONFINED, rel=1e-7)
    assert force["value"] == pytest.approx(way["value"] / 2 * CONFINED, rel=1e-7)
    assert summary["supports"][2]["force"][1] == pytest.approx(force["value"], rel=1e-7)
    assert (
        abs(force["value"] - way["value"] / 2 * CONFINED)
        <= force["error"] + CONFINED / 2 * way["error"]
        < 1e-6 * force["value"]
    )
    assert summary["warnings"] == []
    # the pressure is uniform; the overlaps' rounding moves it from point to point
    pressure = summary["estimates"]["contacts"][0]["pressureMax"]
    assert abs(pressure["value"] - force["value"]) <= pressure["error"] < 0.15 * force["value"]


@pytest.mark.parametrize(
    "body, end, force",
    [
        ("nu 0.3\nsymmetry left\nsymmetry right\nspring base 1e-10 1e-10", "move 0 -0.001", 1e-13),
        ("nu 0.4999999\nsymmetry left\nsymmetry base", "move 0 -0.001", 1000 / (1 - 0.4999999**2) * 0.001 / 3),
    ],
)
def test_soft_springs_and_no_volume_change(tmp_path, body, end, force):
    """The same for a body on springs 1e13 times as soft, and for a volume that hardly changes."""
    geometry = SOFT_AND_STIFF.replace('Physical Surface("stiff") = {2};', "").replace(
        '("soft") = {1}', '("soft") = {1, 2}'
    )
    case = f"body soft E 1000 {body}\nobstacle top plane 0 3 0 -1 {end}\n"
    summary = part(tmp_path, geometry, case, "-order", 2).summary
    assert summary["contacts"][0]["normalForce"] == pytest.approx(force, rel=1e-7)
    found = summary["estimates"]["contacts"][0]["normalForce"]
    assert abs(found["value"] - force) <= found["error"] < 1e-6 * force


@pytest.mark.parametrize("order, geometry", [(1, "strain"), (2, "axisymmetric"), (3, "stress"), (4, "strain")])
def test_forces_by_stresses(tmp_path, order, geometry):
    """Forces by the stresses inside elements, straight and curved, are those of the stiffness matrix."""
    case = f"state {geometry}\nbody ring E 1000 nu 0.3\nclamp inner\n"
    case += "obstacle outer circle 0 0 R 1 inside move 0 -0.01\n"
    (tmp_path / "a.case").write_text(case)
    (tmp_path / "a.geo").write_text(data("truth/quarter-ring.geo"))
    text = """include "edp/parts.edp"
        real[int] u(ndof), byStresses(ndof);
        for (int i = 0; i < ndof; i++) u[i] = sin(37. * i * i);
        real[int] byMatrix = elasticStiffness * u, size = abs(byMatrix);
        computeStressForces(u, byStresses);
        byMatrix -= byStresses;
        real[int] off = [byMatrix.linfty, size.linfty, curvedElementList.n];
        tell("off", off);
    """
    off = told(
        snippet(
            tmp_path,
            text,
            "-mesh",
            "a.geo",
            "-case",
            "a.case",
            "-order",
            order,
            "-estimate",
            0,
            "-vtu",
            0,
            "-out",
            "out",
        )
    )
    assert off["off"][1] > 1 and off["off"][0] < 1e-11 * off["off"][1] and (off["off"][2] > 0) == (order > 1)


def test_too_stiff(tmp_path):
    """Where nothing is left of the soft body's stiffness, the run says so."""
    case = "body soft E 0.03 nu 0.25\nbody stiff E 1.5e13 nu 0.39\nsymmetry sides\nsymmetry sidesUp\nsymmetry base\n"
    (tmp_path / "a.geo").write_text(data("truth/two-blocks.geo"))
    (tmp_path / "a.case").write_text(case + "contact seat under\nobstacle top plane 0 2 0 -1 force 0 -3e-5\n")
    files = ["-mesh", tmp_path / "a.geo", "-case", tmp_path / "a.case", "-vtu", "0", "-out", tmp_path / "out"]
    code, stdout = execute([*FREEFEM, "edp/parts.edp", *files])
    assert code == 20 and "too stiff for what carries it" in stdout


def test_a_first_move_without_a_shape(tmp_path):
    """The refusal names the line where the first move belongs."""
    case = "body soft E 1 nu 0\nbody stiff E 1 nu 0\nsymmetry base\nobstacle top plane 0 3 0 -1\n"
    case += "leg 1\nobstacle top move 0 -0.1\n"
    (tmp_path / "a.geo").write_text(SOFT_AND_STIFF)
    (tmp_path / "a.case").write_text(case)
    files = ["-mesh", tmp_path / "a.geo", "-case", tmp_path / "a.case", "-out", tmp_path / "out"]
    code, stdout = execute([*FREEFEM, "edp/parts.edp", *files])
    assert code == 10 and "obstacle top: move without a shape; allowed: move behind the shape in line 4" in stdout


def test_a_tie_that_carries_shear_alone(tmp_path):
    """Its normal force is 0, and it carries."""
    case = "body soft E 1000 nu 0\nbody stiff E 1000 nu 0\ntie seat under\nmove base 0 0\nmove top 0.001 0\n"
    done = part(tmp_path, data("truth/two-blocks.geo"), case)
    assert "carries nothing" not in done.stdout and re.search(r"shear force +0\.\d", done.stdout)


def test_nearly_incompressible_bodies_ask_for_a_high_order(tmp_path):
    """Where pressures are uncertain the advice is the order; mixed elements need none."""
    case = "body ring E 6 nu 0.49999999\nclamp inner\nobstacle outer plane 0 1 0 -1 move 0 -0.02\n"
    geometry = data("truth/quarter-ring.geo")
    low, mixed = (part(tmp_path / str(order), geometry, case, "-order", order).stdout for order in (1, 2))
    assert "use -order 4, since a nu is near 0.5" in low and "raise -order" not in low
    assert "use -order" not in mixed


@pytest.mark.parametrize("group, cut", [(6, False), (7, True)])
def test_slave_beyond_its_master(tmp_path, group, cut):
    """A master that ends at an edge of its body needs no extension; one that ends within a flat side does."""
    geometry = f"""SetFactory("OpenCASCADE");
        Box(1) = {{0, 0, 0, 1, 1, 1}}; Box(3) = {{1, 0, 0, 1, 1, 1}};
        BooleanFragments{{ Volume{{1}}; Delete; }}{{ Volume{{3}}; Delete; }}
        Box(2) = {{-0.5, 0, 1.01, {2.0 if cut else 3.0}, 1, 1}};
        e = 1e-4;
        Physical Volume("low") = {{1, 3}}; Physical Volume("up") = {{2}};
        Physical Surface("base") = Surface In BoundingBox{{-e, -e, -e, 2 + e, 1 + e, e}};
        Physical Surface("seat") = Surface In BoundingBox{{-e, -e, 1 - e, {1 if cut else 2} + e, 1 + e, 1 + e}};
        Physical Surface("under") = Surface In BoundingBox{{-1, -e, 1.01 - e, 3, 1 + e, 1.01 + e}};
        Physical Surface("top") = Surface In BoundingBox{{-1, -e, 2.01 - e, 3, 1 + e, 2.01 + e}};
        Mesh.MeshSizeMax = 0.5;"""
    case = "body low E 1000 nu 0.3\nbody up E 1000 nu 0.3\ncontact under seat\nclamp base\nmove top 0 0 -0.02\n"
    warnings = part(tmp_path, geometry, case, "-order", 1, "-estimate", 0, space=True).summary["warnings"]
    assert any("extend the master" in text for text in warnings) == cut


def pressed_rings(radii, hub, ring, interference):
    """Lame's pressure between two rings in plane strain, and von Mises' stress of each at a radius."""
    (a, b, c), (flex, flexes) = radii, [((1 + nu) / E, 1 - 2 * nu) for E, nu in (hub, ring)]
    inward = flex[0] * b * (flex[1] * b**2 + a**2) / (b**2 - a**2)
    outward = flexes[0] * b * (flexes[1] * b**2 + c**2) / (c**2 - b**2)
    p = interference / (inward + outward)

    def mises(body, r):
        (mean, bend), nu = (
            ((-p * b**2, -p * (a * b) ** 2), hub[1]) if body == "hub" else ((p * b**2, p * (b * c) ** 2), ring[1])
        )
        area = b**2 - a**2 if body == "hub" else c**2 - b**2
        along, around = (mean - bend / r**2) / area, (mean + bend / r**2) / area
        third = nu * (along + around)
        return np.sqrt(((along - around) ** 2 + (around - third) ** 2 + (third - along) ** 2) / 2)

    return p, mises


@pytest.mark.parametrize("order, most", [(2, 0.02), (3, 5e-3), (4, 5e-6)])
def test_stresses_beside_a_contact_about_an_axis(go, order, most):
    """A stress at a contact feels what single edges of it do; together they do nothing."""
    hub, ring = (200, 0.2), (5e5, 0.05)
    case = f"state axisymmetric\nbody hub E {hub[0]} nu {hub[1]}\nbody ring E {ring[0]} nu {ring[1]}\n"
    case += "contact shaft bore interference 0.05\nsymmetry floor\nsymmetry side\nstresses\n"
    told = go(data("truth/two-rings.geo"), case, "-order", order)
    mises = pressed_rings((8, 28, 35), hub, ring, 0.05)[1]
    for one in told.summary["stresses"]:
        true = mises(one["body"], one["at"][0])
        assert abs(one["vonMises"] - true) <= one["error"] < most * true


@pytest.mark.parametrize("space", [False, True])
def test_a_pressure_between_parallel_symmetries_has_a_bound(go, space):
    """Each of two planes of symmetry continues the bodies, and a uniform pressure ends at neither."""
    hub, ring = (2e5, 0.3), (3e3, 0.2)
    case = f"body hub E {hub[0]} nu {hub[1]}\nbody ring E {ring[0]} nu {ring[1]}\n"
    case += "contact bore shaft interference 5e-5\n" + "".join(f"symmetry {name}\n" for name in ("floor", "side"))
    if space:
        told = go(data("truth/sector-of-rings.geo"), case + "symmetry low\nsymmetry high\n", space=True)
    else:
        told = go(
            re.sub("few = {8}", "few = {2}", data("truth/two-rings.geo")), "state axisymmetric\n" + case, "-order", 1
        )
    true = pressed_rings((0.11, 0.18, 0.25) if space else (8, 28, 35), hub, ring, 5e-5)[0]
    value, error = told.numbers["contacts.0.pressureMax"]
    assert abs(value - true) <= error < 0.2 * true and not told.warnings


@pytest.mark.parametrize("names", [("far", "near"), ("near", "far")])
def test_a_force_across_the_second_of_parallel_symmetries(go, names):
    """The image takes back what is across the plane that the contact reaches, whatever their order."""
    sketch = Sketch(Draw())
    (low, near, top, far), _ = sketch.outline([(-2, 0, 0.5), (2, 0, 0.3), (2, 2, 0.1), (-2, 2, 0.5)])
    sketch.body("block", [low, near, top, far])
    case = "body block E 1000 nu 0.3\nobstacle top circle 2 4.98 R 3\nclamp low\n"
    case += f"symmetry {names[0]}\nsymmetry {names[1]}\n"
    (contact,) = go(sketch.named(low=[low], near=[near], top=[top], far=[far]), case, "-order", 1).summary["contacts"]
    assert contact["force"][0] == 0 and contact["force"][1] < -5
    assert contact["across"] == ["near"]


def test_a_sector_that_no_symmetry_holds(go):
    """The parts of a press fit push each other away until they touch without a force or, by rounding, not at all."""
    case = "body hub E 2e5 nu 0.3\nbody ring E 1e5 nu 0.2\ncontact shaft bore interference 1e-2\n"
    told = go(data("truth/turned-rings.geo"), case)
    assert told.summary["contacts"][0]["normalForce"] == 0
    assert re.search("shaft bore touches(, but carries nothing| nowhere)", told.stdout)
    assert "nothing presses on anything" in told.warnings
