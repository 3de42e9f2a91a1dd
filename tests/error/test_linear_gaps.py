"""Gaps and rotations are linear in the displacement: what that leaves out is in each ±, or is said with its size.

The truth is a body that is turned in its mesh, statics, or the true distance.
"""

import re
from itertools import count

import numpy as np
import pytest
from freefem import ROOT, cases_of, data, part, run_in, tree

# an ellipse, finer near (0, 5), turned by `turn` about its centre
CAM = data("linear-gaps/cam.geo")
PRESSED = "body cam E 1e5 nu 0.3\nobstacle rim plane 0 {} 0 -1\n"

# a plank of 10 by 4 on two round feet of radius 1, six apart
PLANK = data("linear-gaps/plank.geo")
STANDING = "body plank E 1e6 nu 0.3\nobstacle left plane 0 -1 0 1\nobstacle right plane 0 -1.3 0 1\n"

# a soft round nose on a stiff floor
NOSE = data("linear-gaps/nose.geo")
ON_FLOOR = "body low E 1e6 nu 0.3\nbody up E 1 nu 0.3\ncontact {} {}\nclamp base\nmove head {} {}\n"

# a ball in a cup, axisymmetric
HIP = data("linear-gaps/hip.geo")
IN_CUP = data("linear-gaps/in-cup.case")

# a disc in space, finer near (0, 3)
WHEEL = data("linear-gaps/wheel.geo")


class Said:
    """What a run says."""

    def __init__(self, summary, stdout):
        self.summary, self.stdout = summary, stdout
        self.linear = summary["linearised"]
        self.listed = self.linear and list(self.linear["changes"])
        if self.linear:
            both = {"normal force": " normal force"}  # the others are the names' only ones
            changes = self.linear["changes"]
            self.linear["changes"] = {x["name"] + both.get(x["kind"], ""): x["change"] for x in changes}
        self.warnings = [text for text in summary["warnings"] if "linearised" in text or "use -distance" in text]

    def known(self, what, number=0):
        """(value, error) of a contact's number, or of a load's way."""
        if what == "way":
            entry = self.summary["estimates"]["loads"][number]["way"]
        else:
            entry = self.summary["estimates"]["contacts"][number][what]
        return entry["value"], entry["error"]

    def holds(self, what, truth, number=0):
        value, error = self.known(what, number)
        return abs(value - truth) <= error


def apart(one, other):
    """How far the resultants of the first contact are apart, as vectors."""
    forces = [np.array(found.summary["contacts"][0]["force"]) for found in (one, other)]
    return np.linalg.norm(forces[0] - forces[1])


@pytest.fixture
def said(tmp_path):
    """said(geo, case, *flags) runs a case; what it says."""
    numbers = count()

    def go(geo, case, *flags, space=False, **constants):
        for name, value in constants.items():
            geo = re.sub(rf"\b{name} = {{[^}}]*}}", f"{name} = {{{value}}}", geo)
        done = part(tmp_path / str(next(numbers)), geo, case, *flags, space=space)
        return Said(done.summary, done.stdout)

    return go


@pytest.mark.parametrize(
    "rx, depth, angle, flags",
    cases_of([(6, 4.999, 0.05, ())], [(5, 4.99, 0.09, ("-distance", "exact")), (5, 4.99, 0.02, ())]),
)
def test_turned_bodies(said, rx, depth, angle, flags):
    """A disc and an elliptic cam turned by a statement: the force of those that are turned in their meshes."""
    pressed = PRESSED.format(depth)
    true = said(CAM, pressed + "clamp shaft\n", *flags, rx=rx, turn=angle).known("force")[0]
    turned = said(CAM, pressed + f"rotate shaft 0 0 {angle}\n", *flags, rx=rx)
    assert turned.holds("force", true) and turned.known("force")[0] == pytest.approx(true, rel=0.02)
    assert not turned.warnings and "rotations" not in turned.stdout


@pytest.mark.parametrize(
    "load, height, flags",
    cases_of(
        [("weight plank 0 -1", None, ("-distance", "exact")), ("traction top 0 -4", 4.0, ())],
        [("weight plank 0 -1", None, ()), ("traction top 0 -4", 4.0, ("-distance", "exact"))],
    ),
)
def test_levers(said, load, height, flags):
    """A plank that tilts until both feet stand: each foot's force by statics, of the plank where it stands."""
    plank = said(PLANK, STANDING + load + "\n", *flags)
    area = 40 + np.pi
    carried = area if height is None else 40.0
    middle = (80 - 2 / 3 * 2) / area if height is None else height
    tilt = np.arcsin(0.3 / 6)
    right = carried * (0.5 + middle * np.tan(tilt) / 6)
    for number, true in enumerate((carried - right, right)):
        value, error = plank.known("force", number)
        assert plank.holds("force", true, number)
        if flags:  # it has turned in rounds; one point of each foot carries
            assert abs(value - true) < 1e-3 * true and error < 0.005 * true
        else:
            assert abs(value - true) > 0.02 * true and error < 3 * abs(value - true)
            assert plank.linear["rotation"] == pytest.approx(tilt, rel=0.01)
    assert not plank.warnings


def test_followed_pressure(said):
    """A pressure goes with the surface that it acts on: its lever stays, and it pushes sideways as the plank tilts."""
    dead = said(PLANK, STANDING + "traction top 0 -4\n")
    follows = said(PLANK, STANDING + "pressure top 4\n")
    assert dead.known("force")[0] == pytest.approx(follows.known("force")[0], rel=1e-6)
    assert follows.linear["changes"]["left plane"] != pytest.approx(dead.linear["changes"]["left plane"], rel=0.1)


def test_exchanged(said):
    """Slave and master exchanged: the true distance lies within both errors, and is predicted within a third."""
    noses = {order: ON_FLOOR.format(*order, 0, -0.08) for order in (("nose", "floor"), ("floor", "nose"))}
    true = said(NOSE, noses["nose", "floor"], "-distance", "exact")
    assert true.linear is None
    for order, case in noses.items():
        linear = said(NOSE, case)
        assert linear.holds("force", true.known("force")[0]) and not linear.warnings
        if order[0] == "nose":
            value, error = linear.known("force")
            moved = true.known("force")[0] - value
            assert linear.linear["changes"]["nose floor"] == pytest.approx(moved, rel=0.33)
            assert error < 4 * moved
            assert linear.holds("pressureMax", true.known("pressureMax")[0])
            assert linear.holds("contactLength", true.known("contactLength")[0])
            assert linear.summary["estimates"]["refine"] == "use -distance exact"


def test_hip(said):
    """A ball in a soft cup, axisymmetric: force and way, each predicted within a twentieth."""
    linear, true = said(HIP, IN_CUP), said(HIP, IN_CUP, "-distance", "exact")
    for what, name in (("normalForce", "cup-bore head-surface normal force"), ("way", "force grip")):
        value, error = linear.known(what)
        moved = true.known(what)[0] - value
        assert linear.holds(what, true.known(what)[0]) and error < 4 * abs(moved)
        assert linear.linear["changes"][name] == pytest.approx(moved, rel=0.05)


def test_too_much(said):
    """A gap whose linearisation is far off: said, with a size within a factor of ten, and with what helps."""
    case = ON_FLOOR.format("nose", "floor", 1.2, -0.05)
    linear, true = said(NOSE, case), said(NOSE, case, "-distance", "exact")
    (text,) = linear.warnings
    value = linear.known("force")[0]
    size = float(re.search(r"by about (\S+),", text)[1])
    assert 0.1 < size / (true.known("force")[0] - value) < 10
    assert text.endswith("use -distance exact")
    assert linear.holds("force", true.known("force")[0]) and not linear.linear["trusted"]


def test_slides_that_change_nothing(said):
    """A disc under a plane that slides along it: no word, the true distance gives the same number."""
    case = PRESSED.format(4.99).replace("0 -1\n", "0 -1 move 1 0\n") + "clamp shaft\n"
    linear, true = said(CAM, case, rx=5), said(CAM, case, "-distance", "exact", rx=5)
    assert not linear.warnings
    assert linear.known("force")[0] == pytest.approx(true.known("force")[0], rel=1e-6)
    assert linear.known("force")[1] == pytest.approx(true.known("force")[1], rel=1e-3)


def test_motion_of_the_whole(said):
    """A body's motion is its area's mean: of a disc that turns about its middle 0, however its nodes are spread."""
    turned = said(CAM, PRESSED.format(4.99) + "rotate shaft 0 0 0.02\n", rx=5)
    motion = turned.summary["bodies"][0]["motion"]
    assert np.hypot(*motion[:2]) < 0.001 and motion[2] == pytest.approx(0.02, rel=0.01)


def test_shaft_in_hub(said):
    """A shaft that turns in its hub changes nothing."""
    geo = (ROOT / "edp/examples/press-fit/press-fit.geo").read_text()
    geo += 'Physical Curve("bore") = {11:14}; Physical Curve("outside") = {41:44};\n'
    case = "body inner E 210e3 nu 0.3\nbody outer E 210e3 nu 0.3\ncontact hub shaft\nclamp outside\n"
    true = said(geo, case + "clamp bore\n", edges=44).known("normalForce")[0]
    for angle, flags in ((0.02, ()), (1.3, ("-distance", "exact"))):
        turned = said(geo, case + f"rotate bore 0 0 {angle}\n", *flags, edges=44)
        assert turned.known("normalForce")[0] == pytest.approx(true, rel=1e-4 if flags else 1e-8)
        assert not turned.warnings


def test_rounds_leave_errors(said):
    """After rounds of the true distance a ring's error is that of the linear run: its resultant is only rounding."""
    folder = ROOT / "edp/examples/press-fit"
    geo, case = (folder / "press-fit.geo").read_text(), (folder / "press-fit.case").read_text()
    linear, exact = said(geo, case, edges=44), said(geo, case, "-distance", "exact", edges=44)
    assert exact.known("force")[1] == pytest.approx(linear.known("force")[1], rel=0.1)


def test_turned_in_space(said):
    """A disc in space, turned about its axis."""
    case = "body disc E 1e5 nu 0.3\nobstacle rim plane 0 2.97 0 0 -1 0\n{}\n"
    true = said(WHEEL, case.format("clamp shaft"), space=True).known("force")[0]
    turned = said(WHEEL, case.format("rotate shaft 0 0 0 0 0 1 0.05"), space=True)
    assert turned.holds("force", true) and not turned.warnings and "rotations" not in turned.stdout
    # points that face nothing are no example for their neighbours
    exact = said(WHEEL, case.format("clamp shaft"), "-distance", "exact", space=True)
    assert exact.holds("force", true) and exact.known("force")[1] < 0.05 * true


# a blade's root in a disc: flat flanks with rounded ends, which carry most at their last points
DOVETAIL = data("linear-gaps/dovetail.geo")
BLADE = """size contact 0.15
body disc E 114e3 nu 0.31
body blade E 114e3 nu 0.31
contact slot flank{}
symmetry middle
symmetry side
traction top 0 150
"""


@pytest.mark.parametrize("friction, off", [("", 0.25), (" friction 0.2", 0.25)], ids=["", " friction 0.2"])
def test_ends_that_open(said, friction, off):
    """The flank turns, and points at the contact's ends open and close: foreseen; the resultant is held as a vector.

    With friction the undeformed normals are the mean of both surfaces', those of the true distance the slave's alone;
    at corners of the master these are the point's own without friction, too.
    """
    linear = said(DOVETAIL, BLADE.format(friction))
    true = said(DOVETAIL, BLADE.format(friction), "-distance", "exact")
    moved = true.known("normalForce")[0] - linear.known("normalForce")[0]
    assert linear.linear["changes"]["slot flank normal force"] == pytest.approx(moved, rel=off)
    assert linear.holds("normalForce", true.known("normalForce")[0])
    assert linear.known("force")[1] == pytest.approx(2 * apart(linear, true), rel=0.25)  # the safety


# a round bone on a soft layer that is bonded to a stiff one, axisymmetric
KNEE = data("linear-gaps/knee.geo")
ON_LAYER = """state axisymmetric
group top curves 3
group base plane 0 -23 0 1
group round near 8 1
group cut plane 0 12 0 1
size contact 0.5
size cartilage 0.5
body cartilage E 5 nu 0.45
body bone E 5000 nu 0.3
body condyle E 5000 nu 0.3
join cartilage bone {}
contact top round
clamp base
force cut 0 -100
stresses
"""


def test_stress_and_way_on_a_layer(said):
    """The stress of the layer under the true distance is within its error; a tie leaves that of the way as it is."""
    bonded, true = said(KNEE, ON_LAYER.format("part")), said(KNEE, ON_LAYER.format("part"), "-distance", "exact")
    stress, exact = bonded.summary["stresses"][0], true.summary["stresses"][0]
    moved = abs(stress["vonMises"] - exact["vonMises"])
    assert 0.1 * stress["vonMises"] < moved <= stress["error"] < 4 * moved
    tied = said(KNEE, ON_LAYER.format("tie"))
    assert tied.known("way") == pytest.approx(bonded.known("way"), rel=0.03)
    assert bonded.holds("way", true.known("way")[0]) and tied.holds("way", true.known("way")[0])
    for name in ("cartilage-bone bone-cartilage", "top round"):
        assert abs(tied.linear["changes"][name]) < 1e-8 * 100, name  # the load is given, and goes through both


def test_open_points_change_nothing(tmp_path):
    """The change by the true distance, of points in contact alone, shall be that of all points."""
    package = tree(tmp_path / "package")
    path = package / "edp/error/estimates/sliding-correction.idp"
    text = path.read_text()
    assert text.count("if (!referenceIsFiniteSliding) restrictPairing(close);") == 1
    path.write_text(text.replace("if (!referenceIsFiniteSliding) restrictPairing(close);", ""))
    example = ROOT / "edp/examples/crossed-cylinders/crossed-cylinders"
    flags = ["-mesh", f"{example}.geo", "-case", f"{example}.case", "-order", 1, "-vtu", 0]
    places = {"alone": ROOT, "all": package}
    runs = [run_in(place, "edp/parts-3d.edp", *flags, out=tmp_path / name) for name, place in places.items()]
    alone, all_of_them = runs
    assert alone.summary["contactPoints"] < 0.5 * alone.summary["points"]
    found, expected = alone.summary["linearised"], all_of_them.summary["linearised"]
    assert found["trusted"] and len(expected["changes"]) > 1
    assert found["normals"] == pytest.approx(expected["normals"], rel=1e-9)
    assert found["pressureMax"] == pytest.approx(expected["pressureMax"], rel=1e-9)
    for change, other in zip(found["changes"], expected["changes"], strict=True):
        assert change["change"] == pytest.approx(other["change"], rel=1e-9, abs=1e-9)


# ---------------------------------------------------------------- with friction

BALL = data("linear-gaps/ball.geo")


def rubbed(found):
    """Forces, what is lost and what is needed, by the names that `linearised` has."""
    contact = found.summary["contacts"][0]
    name = contact["name"]
    numbers = {f"{name} force": np.linalg.norm(contact["force"]), f"{name} normal force": contact["normalForce"]}
    numbers |= {f"{name} dissipated": contact["dissipated"]}
    numbers[f"{name} shear force"] = np.linalg.norm(contact["shearForce"])
    return numbers | {f"{x['name']} needed": x["force"] for x in found.summary["prescribed"]}


BOTH = "body low E 1000 nu 0.3\nbody up E 1000 nu 0.3\ncontact {} friction 0.3\nmove head {}\n"
ON_BALL = "body ball E 1000 nu 0.3\nobstacle skin sphere 0 0 -2 R 2 friction 0.3{}\nmove cut {}\n"


@pytest.mark.parametrize(
    "geo, case",
    [
        (NOSE, BOTH.format("nose floor", "0.05 -0.1") + "clamp base\n"),
        (BALL, ON_BALL.format("", "0.06 0.02 -0.05")),
        (BALL, ON_BALL.format(" move 0 0 0.05", "0.05 0 0")),
    ],
    ids=["dragged", "ball", "pushed obstacle"],
)
def test_friction_with_the_true_distance(said, geo, case):
    """What the true distance changes of a run that rubs shall be foreseen, number by number, and be in the errors."""
    space = geo == BALL
    linear, exact = said(geo, case, space=space), said(geo, case, "-distance", "exact", space=space)
    told, truth = rubbed(linear), rubbed(exact)
    seen = 0
    for number in linear.listed:
        name = f"{number['name']} {number['kind']}"
        happens = truth[name] - told[name]
        size = linear.summary["contacts"][0]["normalForce"]
        if "dissipated" in name:  # what sticks and slips changes with it: inside its ± alone
            assert abs(happens) <= linear.summary["contacts"][0]["mesh"]["dissipatedLastStep"]["error"]
            continue
        assert number["change"] == pytest.approx(happens, rel=0.35, abs=2e-3 * size), name
        seen += abs(happens) > 3e-4 * size
    assert seen > 0 and exact.linear is None
    assert linear.holds("normalForce", exact.known("normalForce")[0])
    assert "gaps at rest" not in linear.stdout


def test_friction_pressed_deep(said):
    """The flat surface is the slave: its points come opposite others, and each still lies within its error."""
    case = BOTH.format("floor nose", "0.3 -0.5") + "clamp base\n"
    linear, exact = said(NOSE, case), said(NOSE, case, "-distance", "exact")
    for what, most in (("force", 0.06), ("normalForce", 0.05)):
        true, doubt = exact.known(what)
        value, error = linear.known(what)
        assert error + doubt < most * value
        assert abs(value - true) <= error + doubt
    assert apart(linear, exact) <= linear.known("force")[1]
    shears = [np.linalg.norm(found.summary["contacts"][0]["shearForce"]) for found in (linear, exact)]
    assert abs(shears[0] - shears[1]) <= linear.summary["contacts"][0]["mesh"]["shearForce"]["error"] < 0.35 * shears[0]


# ---------------------------------------------------------------- a gap that is linear

HALF_BALL = data("linear-gaps/half-ball.geo")


@pytest.mark.parametrize("size", [0.1, 0.15])
def test_a_plane_changes_nothing(said, size):
    """Before a plane the gap is linear in the displacement: the true distance shall add nothing, on any mesh."""
    force, modulus = 188.4956, 1000 / (1 - 0.3**2)
    case = f"state axisymmetric\nsize contact {size}\nbody ball E 1000 nu 0.3\nobstacle round plane 0 0 0 1\n"
    ball = said(HALF_BALL, f"{case}symmetry axis\nforce top 0 {-force}\n")
    most = [abs(change) for change in ball.linear["changes"].values()] + list(map(abs, ball.linear["pressureMax"]))
    assert max(most) < 1e-6 * force and not ball.summary["warnings"]
    assert ball.known("force")[1] < 1e-9 * force
    hertz = (6 * force * modulus**2 / (np.pi**3 * 8**2)) ** (1 / 3)
    value, error = ball.known("pressureMax")
    assert error < 0.03 * hertz and abs(value - hertz) < error + 0.15 * (1 / 8) ** 2 * hertz  # Hertz lacks (a/R)^2
