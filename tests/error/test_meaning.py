"""One meaning for each number of a case, and words that hold: what is printed, in summary.json and for ParaView."""

import re

import numpy as np
import pytest
from foreign_parts import Draw, Sketch
from freefem import ROOT, cases_of, execute, table
from output.test_paraview import Grid

BOWL = "body disc E 1000 nu 0.3\nobstacle rim circle 0 0.5 R 2.5 inside\n"
DISC = "body disc E 1000 nu 0.3\nobstacle rim plane 0 -2 0 1\n"


def disc(size=0.3):
    sketch = Sketch(Draw())
    rim = sketch.oval(0, 0, 2, 2, size)
    sketch.body("disc", rim)
    sketch.group("rim", rim)
    return sketch.text()


def bar(near, far, kink=0.0):
    """A bar of 2 by 1, sizes of elements at its ends; its sole's second half is bent up by an angle."""
    sketch = Sketch(Draw())
    end = (1 + np.cos(kink), np.sin(kink), far)
    sides, _ = sketch.outline([(0, 0, near), (1, 0, near), end, (end[0], 1.5, far), (0, 1.5, near)])
    sketch.body("bar", sides)
    for name, side in (("sole", sides[0]), ("right", sides[2]), ("head", sides[3]), ("left", sides[4])):
        sketch.group(name, [side])
    return sketch.text()


def half_disc():
    """The right half of a disc of radius 2, cut off at the top."""
    sketch = Sketch(Draw())
    centre, low, side = sketch.point(0, 0, 0.5), sketch.point(0, -2, 0.05), sketch.point(2, 0, 0.3)
    top, corner = sketch.point(0, 1, 0.3), sketch.point(2, 1, 0.3)
    arc = sketch.curve("Circle", low, centre, side)
    lines = [sketch.curve("Line", *pair) for pair in ((side, corner), (corner, top), (top, centre), (centre, low))]
    sketch.body("disc", [arc, *lines])
    for name, curves in (("rim", [arc]), ("head", [lines[1]]), ("mirror", lines[2:])):
        sketch.group(name, curves)
    return sketch.text()


# ---------------------------------------------------------------- numbers


def test_half(go):
    """Of a half the force is what is applied, beside the whole's; a contact has none across the mirror."""
    told = go(half_disc(), f"{BOWL}symmetry mirror\nforce head 0 -20\n", "-estimate", 0)
    assert told.summary["force"] == 20
    assert told.summary["prescribed"] == [{"name": "force head", "force": 20, "times": 2}]
    assert re.search(r"^  force head +20 of the whole 2 times as much: 40$", told.stdout, re.M)
    assert re.search(rf"^  force head moves +{told.summary['ways'][0]['way']:.6g}$", told.stdout, re.M)
    assert told.summary["contacts"][0]["force"] == pytest.approx([0, 20], abs=1e-6)
    assert told.summary["contacts"][0]["normalForce"] > 20.01


def test_several(go):
    """Of two loads there is no force of the run, but one of each; a pressure has that of its resultant."""
    case = "body bar E 1000 nu 0.3\nobstacle sole plane 0 0 0 1\nweight bar 0 -2\npressure head 3\nclamp left\n"
    told = go(bar(0.3, 0.3), case, "-estimate", 0)
    assert told.summary["force"] is None and not re.search(r"^  force", told.stdout, re.M)
    forces = {each["name"]: each["force"] for each in told.summary["prescribed"]}
    assert forces == {"weight bar": pytest.approx(6), "pressure head": pytest.approx(6)}


def test_prescribed_motion(go):
    """What a motion needs along itself, with an error, is the run's force: of a move, of a moved obstacle alike."""
    squeezed = "body bar E 1000 nu 0\nsymmetry left\nobstacle right plane 2 0 -1 0"
    pushed = go(bar(0.3, 0.3), f"{squeezed} move -0.01 0\n")
    assert pushed.summary["force"] == pytest.approx(7.5, rel=1e-6)
    assert pushed.summary["estimates"]["force"]["value"] == pushed.summary["force"]
    case = f"{squeezed}\n".replace("symmetry left", "move left 0.01 0")
    moved = go(bar(0.3, 0.3), case)
    assert moved.summary["force"] == pytest.approx(7.5, rel=1e-6)
    assert moved.summary["bodies"][0]["reaction"][0] == pytest.approx(7.5, rel=1e-6)


def test_mean_motion(go):
    """A body's motion is its area's mean: of a uniform strain the middle's, however the elements are spread."""
    case = "body bar E 1000 nu 0\nsymmetry left\nobstacle right plane 2 0 -1 0 move -0.01 0\n"
    for near, far in ((0.05, 0.5), (0.5, 0.05)):
        told = go(bar(near, far), case, "-estimate", 0)
        assert told.summary["bodies"][0]["motion"][0] == pytest.approx(-0.005, rel=1e-6)


def test_turned_body(go):
    """A body that is turned as a whole turns by the angle that is prescribed, and moves as its middle does."""
    for order in (1, 4):
        case = f"{DISC.replace('-2 0 1', '-2.001 0 1')}rotate hub 0 0 0.01\n"
        sketch = Sketch(Draw())
        rim, hub = sketch.oval(0, 0, 2, 2, 0.6, bottom=0.2), sketch.oval(0, 0, 1, 1, 0.3)
        sketch.body("disc", rim, hub)
        sketch.group("rim", rim)
        sketch.group("hub", hub)
        told = go(sketch.text(), case, "-order", order, "-estimate", 0)
        x, y, turn = told.summary["bodies"][0]["motion"]
        assert turn == pytest.approx(0.01, rel=1e-9) and np.hypot(x, y) < 0.02 * turn


def test_ring(go):
    """About an axis what is across it is no force: of contacts, supports, motions."""
    case = "state axisymmetric\nbody disc E 1000 nu 0.3\nobstacle rim plane 0 -2 0 1\nclamp head\n"
    told = go(half_disc(), case.replace("plane 0 -2 0 1", "plane 0 -2 0 1 move 0 0.01"), "-estimate", 0)
    (contact,), (body,) = told.summary["contacts"], told.summary["bodies"]
    assert contact["force"] == pytest.approx([0, told.summary["force"]])
    assert body["reaction"] == pytest.approx([0, -told.summary["force"], 0])
    assert body["motion"][0] == body["motion"][2] == 0


# ---------------------------------------------------------------- words


@pytest.mark.parametrize(
    "line", cases_of(["force head 0 0 -2"], ["traction head 0 0 5", "weight bar 0 1 2", "move head 0 -1 0"])
)
def test_too_many_numbers(go, line):
    """More numbers than components shall be refused as such, not as a vector that is 0."""
    case = f"body bar E 1000 nu 0.3\nobstacle sole plane 0 0 0 1\n{line}\n"
    word = line.split()[0]
    assert f"line 3: {line.split()[-1]}: {word} has 3 numbers" in go(bar(1, 1), case, expect=10).stdout


def test_layer(go):
    """A layer thicker than the bodies shall be refused, with what is allowed."""
    case = "body bar E 1000 nu 0.3\nobstacle sole plane 0 0 0 1 law power kappa 1 m 2 d0 {}\nmove head 0 -0.01\n"
    said = go(bar(1, 1), case.format("-1e30"), expect=10).stdout
    assert "line 2: obstacle sole: d0 -1e+30" in said and "allowed: from -1.7" in said
    assert "overflow" not in go(bar(1, 1), case.format("-1.6")).stdout


def test_ends(go):
    """Where a group ends at a corner of the body nothing is cut off; where the body goes on smoothly it is."""
    case = "body bar E 1000 nu 0.3\nobstacle sole plane 0 0 0 1\nmove head 0 -0.01\n"
    assert "extend the group" not in go(bar(0.1, 0.3, kink=0.5), case, "-estimate", 0).warnings
    assert "extend the group" in go(bar(0.1, 0.3), case, "-estimate", 0).warnings
    sketch = Sketch(Draw())
    rim = sketch.oval(0, 0, 2, 2, 0.3)
    sketch.body("disc", rim)
    sketch.group("rim", rim[3:])
    sketch.group("hub", rim[1:2])
    assert "extend the group" in go(sketch.text(), f"{DISC}move hub 0 -0.1\n", "-estimate", 0).warnings


def halves(split):
    """A block of 4 by 2 whose sole is two groups, or one."""
    sketch = Sketch(Draw())
    sides, _ = sketch.outline([(0, 0, 0.3), (2, 0, 0.3), (4, 0, 0.3), (4, 2, 0.3), (0, 2, 0.3)])
    sketch.body("a", sides)
    for name, side in (("one", sides[: 2 - split]), ("other", sides[1:2]), ("top", sides[3:4]), ("side", sides[4:])):
        if split or name != "other":
            sketch.group(name, side)
    return sketch.text()


@pytest.mark.parametrize(
    "rubs, support",
    cases_of([("", "symmetry side"), (" friction 0.3", "move side 0.01 0")], [(" friction 0.3", "symmetry side")]),
)
def test_neighbours(go, tmp_path, rubs, support):
    """Two contacts of neighbours on one surface carry what one contact does, each its own share of the node between."""
    case = "body a E 1e3 nu 0.3\n{}" + f"{support}\npressure top 1\n"
    floor = f"obstacle one plane 0 0 0 1{rubs}\n"
    whole = go(halves(False), case.format(floor)).summary["contacts"]
    run = go(halves(True), case.format(floor + floor.replace("one", "other")))
    forces = np.array([entry["force"] for entry in run.summary["contacts"]])
    assert forces[:, 1].sum() == pytest.approx(whole[0]["force"][1], rel=1e-6)
    assert rubs or forces[:, 1] == pytest.approx([2, 2], abs=1e-5)
    assert "(2, 0)" not in run.warnings
    points = table(tmp_path / "1/out/contact.csv")
    pressures = points["pressure"][np.abs(points["x"] - 2) < 1e-9]
    assert len(pressures) == 2 and pressures[0] == pytest.approx(pressures[1], rel=1e-4) and pressures[0] > 0.3


@pytest.mark.parametrize("other", ["0 0 0 1 friction 0.2", "0 -0.001 0 1 friction 0.3"])
def test_neighbours_unlike(go, other):
    """With friction, and unlike at the node that they share, they are refused: how forces part is not known."""
    case = "obstacle one plane 0 0 0 1 friction 0.3\nobstacle other plane {}\nsymmetry side\npressure top 1\n"
    said = go(halves(True), "body a E 1e3 nu 0.3\n" + case.format(other), expect=10).stdout
    assert "contacts one plane and other plane share the node at (2, 0)" in said


def test_sizes_of_elements(go):
    """Where -h is no flag nothing shall ask for it."""
    told = go(disc(1.2), f"{DISC}weight disc 0 -5\n")
    assert "lower sizes" in told.warnings and not re.search(r"(^|\s)-h\b", told.stdout)


def test_shares(tmp_path):
    """Shares beyond any meaning shall be no numbers."""
    script = tmp_path / "shares.edp"
    script.write_text(
        'include "input/flags.idp"\nreal none = sqrt(-1.);\n'
        'cout << percentText(0.274) << "|" << percentText(1e300) << "|"'
        ' << percentText(none) << "|" << percentText(-1e30) << endl;\n'
    )
    code, said = execute(["FreeFem++", "-nw", "-v", "0", script], ROOT)
    assert code == 0 and "27 %|more than 1000 %|more than 1000 %|more than 1000 %" in said


def test_nothing_opposite(go, tmp_path):
    """For ParaView the overlap of points that meet nothing is none; of all others it is a length of the problem."""
    told = go(disc(), f"{DISC}obstacle rim plane 0 2 0 -1 move 0 -0.05\n", "-estimate", 0, vtu=1)
    overlap = Grid(tmp_path / "0" / "out" / "contact.vtu").at_points["overlap[length]"]
    assert np.isnan(overlap).any() and np.nanmax(np.abs(overlap)) < 50 * told.summary["contacts"][0]["contactLength"]
    assert told.summary["unpairedPoints"] > 0
