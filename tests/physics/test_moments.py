"""Moments, free and rigid forces, springs and spinning bodies of a case: closed forms, balance, turned problems."""

import csv

import numpy as np
import pytest
from freefem import cases_of, part
from input.test_parts import UNTURNED, Mesh, block, cube, read, turn_in_space

RING = """
Function ring
  Point(n + 1) = {r, 0, 0, h}; Point(n + 2) = {0, r, 0, h}; Point(n + 3) = {-r, 0, 0, h}; Point(n + 4) = {0, -r, 0, h};
  Circle(n + 1) = {n + 1, 1, n + 2}; Circle(n + 2) = {n + 2, 1, n + 3};
  Circle(n + 3) = {n + 3, 1, n + 4}; Circle(n + 4) = {n + 4, 1, n + 1};
  Curve Loop(n + 1) = {n + 1, n + 2, n + 3, n + 4};
Return
"""
RINGS = """h = 2.5; Point(1) = {0, 0, 0, h};
n = 10; r = 5; Call ring;
n = 20; r = 10; Call ring;
n = 30; Call ring;
n = 40; r = 20; Call ring;
Plane Surface(1) = {21, 11}; Plane Surface(2) = {41, 31};
Physical Surface("shaft") = {1}; Physical Surface("hub") = {2};
Physical Curve("core") = {11 : 14}; Physical Curve("seat") = {21 : 24};
Physical Curve("bore") = {31 : 34}; Physical Curve("rim") = {41 : 44};
"""
FIT = "body shaft E 210e3 nu 0.3\nbody hub E 210e3 nu 0.3\n"
HUB = FIT + "clamp rim\ncontact bore seat interference 0.01 friction {}\n"
POST = "body base E 1000 nu 0.3\nbody post E 1000 nu 0.3\ncontact top foot friction 0.5\nclamp bottom\nabout A 0 0\n"


def moments(run):
    """{(name, body): (force, moment)} of the summary, which moments.csv has too."""
    found = {(row["name"], row["body"]): row for row in run.summary["moments"]}
    with open(run.folder / "moments.csv") as lines:
        for row in csv.DictReader(lines):
            told = [float(row[key]) for key in row if key.startswith("moment")]
            assert told == found[row["name"], row["body"]]["moment"]
            assert (row["error"] == "") == ("error" not in found[row["name"], row["body"]])
    return found


def way(run):
    """The load-point displacement of the first load."""
    estimated = [(load["name"], load["way"]["value"]) for load in run.summary["estimates"]["loads"]]
    told = [(load["name"], load["way"]) for load in run.summary["ways"]]
    assert [name for name, _ in told] == [name for name, _ in estimated]
    assert [value for _, value in told] == pytest.approx([value for _, value in estimated], rel=1e-5)
    return estimated[0][1]


def across(place, force):
    """The moment in the plane of a force at a place."""
    return place[0] * force[1] - place[1] * force[0]


def column(matrix=UNTURNED):
    """A post of width 2 and height 3 on a base; it stands on y = 1."""
    mesh = block(Mesh(), size=(4, 1), cells=(8, 2), at=(-2, 0), name="base")
    mesh = block(mesh, size=(2, 3), cells=(5, 6), at=(-1, 1), prefix="post ", name="post")
    return mesh.text(matrix).replace('"post bottom"', '"foot"').replace('"post top"', '"head"')


# ---------------------------------------------------------------- moments


def test_hub_slips(tmp_path):
    """A shaft that slips in its hub: 2 pi R^2 mu p, on both bodies and the clamp; it is printed unasked."""
    run = part(tmp_path, RING + RINGS, HUB.format(0.1) + "rotate core 0 0 0.004\n")
    found = moments(run)
    pressure = run.summary["contacts"][0]["normalForce"] / (2 * np.pi * 10)
    moment = found["bore seat", "hub"]["moment"][0]
    assert moment == pytest.approx(2 * np.pi * 10**2 * 0.1 * pressure, rel=1e-5)
    assert found["bore seat", "shaft"]["moment"][0] == pytest.approx(-moment, rel=1e-9)
    assert found["clamp rim", "hub"]["moment"][0] == pytest.approx(-moment, rel=1e-9)
    assert 0 < found["bore seat", "hub"]["error"] < 0.05 * moment
    assert "  moments\n    bore seat " in run.stdout and "\n    clamp rim " not in run.stdout


@pytest.mark.parametrize("how", cases_of([" rigid"], ["", " rigid", " about 0 0"]))
def test_hub_under_a_moment(tmp_path, how):
    """The moment that a shaft is loaded with goes through contact and clamp, whatever point it is told about."""
    run = part(tmp_path, RING + RINGS, HUB.format(0.2) + f"moment core 3000{how}\nabout P 1 2\n")
    found = moments(run)
    for key, sign in ((("bore seat", "hub"), 1), (("bore seat", "shaft"), -1), (("clamp rim", "hub"), -1)):
        assert found[key]["moment"][0] == pytest.approx(sign * 3000, rel=1e-6), key
        assert found[key]["about"] == [1, 2]
    assert found["bore seat", "hub"]["moment"][0] == pytest.approx(-found["bore seat", "shaft"]["moment"][0], rel=1e-9)
    assert run.summary["prescribed"] == [{"name": "moment core", "moment": 3000, "times": 1}]
    assert "  moment core turns " in run.stdout and " rad " in run.stdout
    if how:
        assert found["guide of moment core", "shaft"]["moment"] == pytest.approx([0], abs=1e-2)
    assert "  moments about P (1, 2)\n    bore seat " in run.stdout


def test_loads_before_the_solution(tmp_path):
    """`-check 1` prints friction, and each force, moment, spin and spring with its numbers and what it leaves free."""
    dense = FIT.replace("nu 0.3", "nu 0.3 density 8e-9") + "clamp rim\ncontact bore seat friction 0.2\n"
    loads = {
        "moment core 3000 about 1 2": (
            "held by moment core (free to turn)",
            "load      moment core 3000, about (1, 2)",
        ),
        "force core 0 -9 rigid": ("held by force core (free to move and turn)", "load      force core (0, -9), rigid"),
        "force core 0 -9 free at 1 2": ("held by contact only", "load      force core (0, -9), free at (1, 2)"),
        "spring core 5 5\nspin shaft 7": ("held by spring core", "load      spin shaft 7 rad per unit of time"),
    }
    for line, (held, load) in loads.items():
        run = part(tmp_path, RING + RINGS, dense + line + "\n", "-check", 1)
        assert f"body      shaft: E 210000, nu 0.3; {held}" in run.stdout and f"  {load}\n" in run.stdout, run.stdout
        assert "hard contact, friction 0.2, " in run.stdout, run.stdout


@pytest.mark.parametrize(
    "how", cases_of(["rigid at 0.2 4", "free at 0.2 4"], ["free", "rigid", "free at 0.2 4", "rigid at 0.2 4"])
)
def test_lever(tmp_path, how):
    """A post under a force that nothing guides: contact and clamp have its force and its moment about any point."""
    force = np.array([0.5, -4])
    run = part(tmp_path, column(), POST + f"force head {force[0]} {force[1]} {how}\n", "-order", 1)
    place = np.array([float(word) for word in how.split("at")[1].split()]) if "at" in how else np.array([0, 4])
    found = moments(run)
    for key, sign in ((("top foot", "base"), 1), (("top foot", "post"), -1), (("clamp bottom", "base"), -1)):
        assert found[key]["force"] == pytest.approx(sign * force, abs=1e-7)
        assert found[key]["moment"][0] == pytest.approx(sign * across(place, force), abs=1e-6), key
    guides = [guide["force"] for guide in run.summary["guides"]]
    assert guides == ([] if "free" in how else [pytest.approx([0, 0], abs=1e-7)])
    assert "guide of" not in run.stdout


def test_guided_force(tmp_path):
    """The guide of a force carries what the contact does not take of force and moment; a line of its own says so."""
    run = part(tmp_path, column(), POST + "force head 0.5 -4\n", "-order", 1)
    found = moments(run)
    guide, below = found["guide of force head", "post"], found["top foot", "base"]
    assert np.abs(guide["force"]).max() > 1e-3
    assert np.add(guide["force"], (0.5, -4)) == pytest.approx(np.array(below["force"]), abs=1e-7)
    assert guide["moment"][0] + across((0, 4), (0.5, -4)) == pytest.approx(below["moment"][0], abs=1e-6)
    assert run.summary["guides"][0]["force"] == pytest.approx(guide["force"], abs=1e-9)
    assert "  guide of force head carries " in run.stdout


def stacked(force, *, spring, side='symmetry "u left"\n', more="", contact=""):
    """Two squares of width 2, one on the other, on which a guided force acts."""
    mesh = block(block(Mesh(), (2, 1), (4, 2), name="low"), (2, 1), (4, 2), (0, 1), "u ", "up").text()
    case = f'state stress\nbody low E 1000 nu 0\nbody up E 1000 nu 0\ncontact "u bottom" top{contact}\n'
    return mesh, f'{case}symmetry bottom\nsymmetry left\n{side}spring "u {spring}" 300 400\n{more}{force}\n'


@pytest.mark.parametrize("spring", cases_of(["top"], ["top", "right"]))
@pytest.mark.parametrize("along", cases_of(["0 -2"], ["0 -2", "0.5 -2"]))
def test_guide_beside_a_spring(tmp_path, spring, along):
    """A spring on the guided group, or at its corner, carries its own force; the guide carries none along the load."""
    case = stacked(f'force "u top" {along}', spring=spring, more="about A 0 0\n")
    along = np.array(along.split(), float)
    oblique = along[0] != 0
    run = part(tmp_path, case[0], case[1].replace('symmetry "u left"\n', "") if oblique else case[1])
    supports = {entry["name"]: np.array(entry["force"]) for entry in run.summary["supports"]}
    (entry,) = run.summary["guides"]
    guide, contact = np.array(entry["force"]), np.array(run.summary["contacts"][0]["force"])
    assert guide @ along == pytest.approx(0, abs=1e-6)
    others = sum(force for name, force in supports.items() if "u " in name)
    assert guide + others + contact == pytest.approx(-along, abs=1e-6)
    assert moments(run)["guide of force u top", "up"]["force"] == pytest.approx(guide, abs=1e-6)
    assert np.abs(guide).max() > 1e-2 or (spring, oblique) == ("top", False)
    if (spring, oblique) == ("top", False):  # 1000 of two blocks and 400 of the spring share the force
        assert supports["spring u top"] == pytest.approx([0, 2 * 400 / 1400], rel=1e-5)
        assert not entry["carries"] and "guide of" not in run.stdout


def test_move_beside_a_spring(tmp_path):
    """A moved side has a corner in common with a spring: each carries its own force, in balance with the contact."""
    run = part(tmp_path, *stacked('move "u top" 0 -0.002', spring="right", more="about A 0 0\n"))
    supports = {entry["name"]: np.array(entry["force"]) for entry in run.summary["supports"]}
    others = sum(force for name, force in supports.items() if "u " in name)
    assert others + run.summary["contacts"][0]["force"] == pytest.approx([0, 0], abs=1e-6)
    assert np.abs(supports["spring u right"]).min() > 1e-2
    assert moments(run)["move u top", "up"]["force"] == pytest.approx(supports["move u top"], abs=1e-6)
    assert run.summary["prescribed"][0]["force"] == pytest.approx(-supports["move u top"][1], rel=1e-6)


@pytest.mark.parametrize("about", cases_of(["0 0"], ["0 0", "0.5 3"]))
def test_moments_of_a_half(tmp_path, about):
    """Of a mirrored half all moments are those of the half: a uniform pressure, 2 wide, acts at 1."""
    load = 'pressure "u top" 1'
    more = f"about O {about}\nleg 1\n"
    run = part(tmp_path, *stacked(load, spring="top", more=more, contact=" friction 0.3"))
    found, force = moments(run), 2 / 1.4
    moment = (1 - float(about.split()[0])) * force
    assert found["u bottom top", "up"]["moment"][0] == pytest.approx(moment, rel=1e-5)
    assert found["u bottom top", "low"]["moment"][0] == pytest.approx(-moment, rel=1e-5)
    assert found["symmetry bottom", "low"]["moment"][0] == pytest.approx(moment, rel=1e-5)
    with open(run.folder / "series.csv") as lines:
        told = [float(row["u bottom top moment"]) for row in csv.DictReader(lines)]
    assert told == pytest.approx([moment], rel=1e-5)
    summary = run.summary
    assert summary["contactMoment"] == pytest.approx(force, rel=1e-5)
    assert summary["masterMoment"] == pytest.approx(-force, rel=1e-5)


def test_rigid_like_others(tmp_path):
    """In the middle of a half a rigid force does as a guided one, on a stiff post as a free one: in errors too."""
    half = f'{POST}symmetry "post left"\nforce head 0 -4'.replace("friction 0.5", "")
    stiff = POST.replace("post E 1000", "post E 1e8") + "force head 0.5 -4"
    pairs = ((half + "\n", half + " rigid\n"), (stiff + " free at 0.2 4\n", stiff + " rigid at 0.2 4\n"))
    for number, pair in enumerate(pairs):
        runs = [part(tmp_path / f"{number}{k}", column(), case, "-order", 1) for k, case in enumerate(pair)]
        ways = [run.summary["estimates"]["loads"][0]["way"] for run in runs]
        assert ways[1]["value"] == pytest.approx(ways[0]["value"], rel=1e-4)
        assert ways[1]["error"] == pytest.approx(ways[0]["error"], rel=0.05)


def test_free_force_is_a_traction(tmp_path):
    """On a flat group without a point it is the uniform traction; forces, moments and springs are of the thickness."""
    lines = ("traction head 0.1 -1", "force head 0.2 -2 free", "thickness 5\nforce head 1 -10 free")
    runs = [part(tmp_path / str(k), column(), f"{POST}{line}\n", "-order", 1) for k, line in enumerate(lines)]
    for run in runs[1:]:
        assert run.contact["pressure"] == pytest.approx(runs[0].contact["pressure"], rel=1e-9)
        assert way(run) == pytest.approx(way(runs[0]), rel=1e-9)


TIED = """body base E 1000 nu 0.3
body post E 1000 nu 0.3
tie top "post bottom"
clamp bottom
"""
PUSHED = {
    "rigid": 'force "post top" {F} rigid at {P}',
    "free": 'force "post top" {F} free at {P}',
    "moment": 'force "post top" {F} free at {P}\nmoment "post front" 0.3 axis {E}',
    "rigid moment": 'traction "post top" {T}\nmoment "post front" 0.3 axis {E} rigid',
    "about": 'traction "post top" {T}\nmoment "post front" 0.3 axis {E} about {P}',
}


def boxes(matrix):
    mesh = cube(Mesh(), cells=(3, 3, 1), name="base")
    return cube(mesh, size=(1.5, 1.2, 2), cells=(2, 2, 2), at=(0.3, 0.4, 1), prefix="post ", name="post").text(matrix)


@pytest.mark.parametrize("kind", cases_of(["rigid"], PUSHED))
def test_any_axis(tmp_path, kind):
    """In space, turned at random: contact and clamp have the moment of the loads, the turned problem the turned one."""
    force, place, axis, about = map(np.array, ((0.2, -0.1, -3), (1, 1.1, 3.4), (0.1, 1, -0.4), (0.5, 0.2, 1)))
    told = []
    for k, matrix in enumerate((UNTURNED, turn_in_space(3))):
        words = {"F": force, "P": place, "E": axis, "T": force / 1.8}
        words = {key: " ".join(map(repr, map(float, matrix @ value))) for key, value in words.items()}
        point = " ".join(map(repr, map(float, matrix @ about)))
        case = f"{TIED}{PUSHED[kind].format(**words)}\nabout A {point}\n"
        run = part(tmp_path / str(k), boxes(matrix), case, "-order", 1, space=True)
        found = moments(run)
        sides = [
            found[key] for key in (("top post bottom", "base"), ("top post bottom", "post"), ("clamp bottom", "base"))
        ]
        told.append({key: [matrix.T @ side[key] for side in sides] for key in ("force", "moment")})
        for here, there, held in told[-1].values():
            assert here == pytest.approx(-there, abs=1e-9)
            assert here == pytest.approx(-held, abs=1e-7)
    for key in ("force", "moment"):
        assert told[1][key][0] == pytest.approx(told[0][key][0], abs=1e-6)
    if kind != "about":  # a guide carries nothing else
        acts = place if "F" in PUSHED[kind] else (1.05, 1, 3)
        moment = np.cross(acts - about, force) + ("moment" in kind) * 0.3 * axis / np.linalg.norm(axis)
        assert told[0]["force"][0] == pytest.approx(force, abs=1e-6)
        assert told[0]["moment"][0] == pytest.approx(moment, abs=1e-5)


HEAD = """SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 2, 5}; Cylinder(2) = {0, 0, 0, 0, 0, 2, 3};
BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
Physical Volume("head") = {3};
Mesh.MeshSizeMax = 1.6;
"""


def test_screw_head(tmp_path):
    """A screw's head that turns under a force F: 2/3 mu F (R^3 - r^3) / (R^2 - r^2), of a uniform pressure."""
    case = "group face plane 0 0 0 0 0 1\ngroup top plane 0 0 2 0 0 1\nbody head E 210e3 nu 0\nabout O 0 0 0\n"
    case += "obstacle face plane 0 0 0 0 0 1 force 0 0 1000 friction 0.15\nrotate top 0 0 0 0 0 1 0.001\n"
    run = part(tmp_path, HEAD, case, space=True)
    found = moments(run)["face plane", "head"]
    true = 2 / 3 * 0.15 * 1000 * (5**3 - 3**3) / (5**2 - 3**2)
    assert abs(-found["moment"][2] - true) <= found["error"] < 2e-3 * true
    (turned,) = run.summary["prescribed"][1:] or run.summary["prescribed"]
    assert found["error"] == pytest.approx(turned["error"], rel=0.1)  # of one number, by two dual problems
    assert moments(run)["rotate top", "head"]["moment"] == pytest.approx(-np.array(found["moment"]), abs=1e-6)
    assert np.abs(found["moment"][:2]).max() < 1e-4 * true


def rings(size):
    return RING + RINGS.replace("h = 2.5", f"h = {size}")


DENSE = "state stress\n" + FIT.replace("nu 0.3", "nu 0.3 density 8e-9") + "contact bore seat interference 0.01\n"
WITHIN = {
    "rotated": HUB.format(0.3) + "rotate core 0 0 0.0005\nabout O 0 0\n",
    "pushed aside": HUB.format(0.3) + "force core 300 0 rigid at 0 8\nabout O 3 4\n",
    "on springs": HUB.format(0.3).replace("clamp rim", "spring rim 3e5 2e5")
    + "moment core 3000\nforce core 100 50 free\n",
    "spun": DENSE + "spin shaft 5000 about 3 0\nspin hub 5000 about 3 0\nspring rim 2e5 1e5\nabout O 0 0\n",
}


def with_errors(run):
    """{name: (value, error)} of contacts, loads, prescribed motions and moments."""
    estimates, found = run.summary["estimates"], {}
    for contact in estimates["contacts"]:
        found |= {key: (number["value"], number["error"]) for key, number in contact.items() if "error" in number}
    found |= {load["name"]: (load["way"]["value"], load["way"]["error"]) for load in estimates["loads"]}
    known = [one for one in run.summary["prescribed"] if "error" in one]
    found |= {"needed " + one["name"]: (one.get("force", one.get("moment")), one["error"]) for one in known}
    told = run.summary.get("moments", [])
    found |= {"moment " + row["name"]: (row["moment"][0], row["error"]) for row in told if "error" in row}
    return found


@pytest.mark.parametrize("kind", WITHIN)
def test_errors_hold(tmp_path, kind):
    """The errors of a coarse mesh contain the values of one three times as fine."""
    coarse, fine = (with_errors(part(tmp_path / str(size), rings(size), WITHIN[kind])) for size in (2.5, 0.8))
    assert len(coarse) >= 5
    for name, (value, error) in coarse.items():
        assert abs(value - fine[name][0]) <= error + 1e-9 * abs(value), name


# ---------------------------------------------------------------- springs, gravity, spin


def test_weight_on_springs(tmp_path):
    """A block on springs under gravity: it sinks by its weight over their stiffness; both are of the thickness."""
    lines = "state stress\nthickness 5\nbody block E 1e5 nu 0.3 density 0.02\nobstacle right plane 4 0 -1 0\n"
    case = lines + "gravity 0 -10\nspring bottom 20 30\nabout A 0 0\n"
    run = part(tmp_path, block(Mesh()).text(), case)
    weight = 0.02 * 10 * 3 * 2
    support = run.summary["supports"][0]
    assert support["name"] == "spring bottom"
    assert support["force"] == pytest.approx([0, weight], abs=1e-8)
    assert run.summary["reactionY"] == pytest.approx(weight, rel=1e-8)
    assert run.summary["prescribed"][0]["force"] == pytest.approx(weight, rel=1e-12)
    assert moments(run)["spring bottom", "block"]["moment"][0] == pytest.approx(1.5 * weight, rel=1e-8)
    sunk = -run.summary["bodies"][0]["motion"][1]
    assert sunk == pytest.approx(weight * 5 / 30 + weight / 3 * 2 / 3 / 1e5, rel=1e-5)  # and its own shortening


def test_spring_along_one_axis(tmp_path):
    """A block on the ground that a spring holds along it only: the rest is free, the contact has force and moment."""
    case = "body block E 1e5 nu 0.3\nobstacle bottom plane 0 0 0 1\nspring bottom 50 0\nabout A 0 0\n"
    case += "force top 0.5 -4 free\n"
    found = moments(part(tmp_path, block(Mesh()).text(), case))
    assert found["spring bottom", "block"]["force"] == pytest.approx([-0.5, 0], abs=1e-8)
    assert found["bottom plane", "block"]["force"] == pytest.approx([0, 4], abs=1e-8)
    assert found["bottom plane", "block"]["moment"][0] == pytest.approx(1.5 * 4 + 2 * 0.5, abs=1e-6)


def test_springs_in_space(tmp_path):
    """A box on springs that a plane presses: forces, moments and ways in series; a moment turns it."""
    case = "body block E 1e6 nu 0\nspring bottom 40 40 10\nobstacle top plane 0 0 1 0 0 -1 force 0 0 -2\n"
    case += "moment top 0.3 axis 2 0 0\n"
    run = part(tmp_path, cube(Mesh()).text(), case + "about A 1 1 0\n", "-order", 1, space=True)
    support = moments(run)["spring bottom", "block"]
    assert support["force"] == pytest.approx([0, 0, 2], abs=1e-8)
    assert np.array(support["moment"]) == pytest.approx(
        -np.array(moments(run)["top plane", "block"]["moment"]) - [0.3, 0, 0], abs=1e-8
    )
    assert run.summary["bodies"][0]["motion"][2] == pytest.approx(-0.2, rel=1e-3)


def spun(r, inner, outer, young, nu):
    """The radial displacement of a rotating ring (inner 0: a disc) over rho omega^2, in plane stress."""
    whole = (3 + nu) / 8 * ((1 - nu) * (inner**2 + outer**2) - (1 - nu**2) / (3 + nu) * r**2)
    return r / young * (whole + (inner > 0) * (3 + nu) / 8 * (1 + nu) * inner**2 * outer**2 / r**2)


def fit(state, young=210e3, nu=0.3):
    """Interference over pressure of rings 5, 10 and 10, 20, and by how much spin at rho omega^2 = 1 opens it."""
    if state == "strain":
        young, nu = young / (1 - nu**2), nu / (1 - nu)
    lame = 10 / young * ((400 + 100) / (400 - 100) + (100 + 25) / (100 - 25))
    return lame, spun(10, 10, 20, young, nu) - spun(10, 5, 10, young, nu)


@pytest.mark.parametrize("state", cases_of(["stress"], ["stress", "strain"]))
def test_shrink_fit_that_loosens(tmp_path, state):
    """A shrink fit loses its pressure with the square of the speed, all of it at one: closed forms of Lame."""
    lame, opened = fit(state)
    loose = np.sqrt(0.01 / opened / 8e-9)
    case = f"state {state}\n" + FIT.replace("nu 0.3", "nu 0.3 density 8e-9") + "contact bore seat interference 0.01\n"
    for speed, rel in ((0.9, 1), (1.001, 0)):
        spins = "".join(f"spin {body} {speed * loose}\n" for body in ("shaft", "hub"))
        run = part(tmp_path / str(speed), RING + RINGS, case + spins)
        told = run.summary["estimates"]["contacts"][0]["normalForce"] if rel else {"value": 0, "error": 0}
        normal = run.summary["contacts"][0]["normalForce"]
        true = max(0, 2 * np.pi * 10 * 0.01 * (1 - speed**2) / lame)
        assert normal == pytest.approx(true, rel=1e-3, abs=1e-3 * rel * 2 * np.pi * 10 * 0.01 / lame)
        assert abs(normal - true) <= told["error"]


@pytest.mark.parametrize("inner", cases_of([0], [0, 5]))
def test_spinning_disc(tmp_path, inner):
    """The rim of a rotating disc, or ring, about its axis, held along it: the closed form of plane strain."""
    rho, omega, young, nu = 8e-9, 2000, 210e3 / (1 - 0.3**2), 0.3 / (1 - 0.3)
    strip = block(Mesh(), size=(20 - inner, 2), cells=(20, 2), at=(inner, 0)).text()
    case = "state axisymmetric\nbody block E 210e3 nu 0.3 density 8e-9\nobstacle right plane 20.5 0 -1 0\n"
    case += f"symmetry bottom\nsymmetry top\nspin block {omega}\nline rim 20 0 20 2\n"
    run = part(tmp_path, strip, case)
    with open(run.folder / "line-rim.csv") as lines:
        found = [float(row["ux"]) for row in csv.DictReader(lines)]
    assert np.array(found) == pytest.approx(rho * omega**2 * spun(20, inner, 20, young, nu), rel=1e-5)


QUARTERS = """h = 2.5; Point(1) = {0, 0, 0, h};
Function quarter
  Point(n + 1) = {r, 0, 0, h}; Point(n + 2) = {0, r, 0, h}; Circle(n) = {n + 1, 1, n + 2};
Return
n = 10; r = 5; Call quarter;
n = 20; r = 10; Call quarter;
n = 30; Call quarter;
n = 40; r = 20; Call quarter;
For n In {10 : 30 : 20}
  Line(n + 1) = {n + 1, n + 11}; Line(n + 2) = {n + 12, n + 2};
  Curve Loop(n) = {n + 1, n + 10, n + 2, -n}; Plane Surface(n) = {n};
EndFor
Physical Surface("shaft") = {10}; Physical Surface("hub") = {30};
Physical Curve("seat") = {20}; Physical Curve("bore") = {30}; Physical Curve("rest") = {10, 40};
Physical Curve("low") = {11, 31}; Physical Curve("left") = {12, 32};
"""


HIGH = [("stress", 4), ("axisymmetric", 4), ("axisymmetric", 3)]


@pytest.mark.parametrize(("state", "order"), cases_of(HIGH[:2], HIGH))
def test_spin_of_curved_elements_at_high_orders(tmp_path, state, order):
    """A quarter of two rings: their pressure and what the symmetries carry. Of two hollow spheres: as with order 2.

    The contact reaches the symmetries: its resultant has nothing across them, and the screen says so.
    """
    spins = "spin shaft 2000\nspin hub 2000\n"
    case = f"state {state}\n" + FIT.replace("nu 0.3", "nu 0.3 density 8e-9") + spins
    case += "contact bore seat interference 0.01\nsymmetry low\n"
    run = part(tmp_path / "1", QUARTERS, case + "symmetry left\n" * (state == "stress"), "-order", order)
    contact, names = run.summary["contacts"][0], ["low", "left"][: 2 if state == "stress" else 1]
    assert contact["across"] == names and contact["force"] == pytest.approx([0, 0], abs=1e-9 * contact["normalForce"])
    assert f"without its part across symmetry {', symmetry '.join(names)}\n" in run.stdout
    if state == "stress":
        low, left = (support["force"] for support in run.summary["supports"])
        assert [low[1], left[0]] == pytest.approx([-8e-9 * 2000**2 * (20**3 - 5**3) / 3] * 2, rel=1e-6)
        lame, opened = fit(state)
        true = np.pi / 2 * 10 * (0.01 - 8e-9 * 2000**2 * opened) / lame
        assert contact["normalForce"] == pytest.approx(true, rel=1e-4)
    else:
        runs = [part(tmp_path / str(k), QUARTERS, case.replace(spins, ""), "-order", k) for k in (2, order)]
        runs.append(part(tmp_path / "5", QUARTERS, case, "-order", 2))
        by = [run.summary["contacts"][0]["normalForce"] for run in runs]
        assert contact["normalForce"] - by[1] == pytest.approx(by[2] - by[0], rel=1e-3) and by[2] < 0.99 * by[0]


@pytest.mark.parametrize("order", cases_of([1], [1, 2]))
def test_spin_in_space(tmp_path, order):
    """A clamped box that spins about any axis: the clamp carries its mass times the middle's distance."""
    axis, about = np.array([0.3, -1, 2]), np.array([5, 1, -2])
    e = axis / np.linalg.norm(axis)
    arm = np.array([1, 1, 0.5]) - about
    pull = 0.02 * 4 * 3**2 * (arm - (arm @ e) * e)
    for matrix in (UNTURNED, turn_in_space(5)):
        words = [" ".join(map(repr, map(float, matrix @ v))) for v in (about, axis, (0, 0, 9), (0, 0, -1))]
        case = f"body block E 1e5 nu 0.3 density 0.02\nclamp bottom\nspin block 3 about {words[0]} axis {words[1]}\n"
        case += f"obstacle top plane {words[2]} {words[3]}\n"
        run = part(tmp_path / str(matrix[0, 0]), cube(Mesh()).text(matrix), case, "-order", order, space=True)
        assert matrix.T @ run.summary["supports"][0]["force"] == pytest.approx(-pull, rel=1e-9)


def test_spin_of_a_round_body(tmp_path):
    """A pin on the side of the axis, on elements that follow its surface: its mass times the distance of its middle."""
    geo = 'SetFactory("OpenCASCADE");\nCylinder(1) = {0.5, 0, 0, 0, 0, 3, 1};\nPhysical Volume("pin") = {1};\n'
    geo += "Mesh.MeshSizeMax = 0.6;\n"
    case = "group foot plane 0 0 0 0 0 1\ngroup head plane 0 0 3 0 0 1\nbody pin E 1e4 nu 0.3 density 2\nclamp foot\n"
    case += "obstacle head plane 0 0 9 0 0 -1\nspin pin 3 about 0 0 0 axis 0 0 1\ngravity 0 0 -1\n"
    run = part(tmp_path, geo, case, space=True)
    force = run.summary["supports"][0]["force"]
    assert force[2] == pytest.approx(2 * 3 * np.pi, rel=1e-3)
    assert force[0] == pytest.approx(-9 * 0.5 * force[2], rel=1e-3)


def test_moment_in_phases(tmp_path):
    """A free moment that is reached in phases: in stick, the energy is half the moment times its angle."""
    phases = "leg 1\nmoment core 0\nleg 2\nmoment core 5000\nleg 2\nmoment core -5000\n"
    run = part(tmp_path, rings(4), HUB.format(0.2) + "about O 0 0\n" + phases, "-order", 1)
    with open(run.folder / "series.csv") as lines:
        stored = [float(row["stored"]) for row in csv.DictReader(lines)]
    assert stored[2] == pytest.approx(stored[4], rel=1e-6)
    assert stored[3] == pytest.approx(stored[0], rel=1e-6)
    twist = run.summary["bodies"][0]["motion"][2]
    assert twist < 0 and moments(run)["bore seat", "hub"]["moment"][0] == pytest.approx(-5000, rel=1e-6)
    once = part(tmp_path / "once", rings(4), HUB.format(0.2) + "moment core 5000\n", "-order", 1)
    assert stored[2] - stored[0] == pytest.approx(0.5 * 5000 * way(once), rel=1e-3)


REFUSED = {
    "force top 0 -1 at 1 2": "at: free or rigid must stand before it",
    "force top 0 -1 loose": "loose: more than the statement takes",
    "moment top 0": "moment top: 0; allowed: another number",
    "moment top 1 rigid\nclamp top": "top: clamp after moment in line 2",
    "moment top 1 axis 1 0": "axis: more than the statement takes",
    "spring top 0 0": "spring top: no stiffness; allowed: one above 0",
    "spring top -1 0": "-1: the stiffness is out of range; allowed: at least 0",
    "spin block 3": "spin block: the body has no density; allowed: body block E number nu number density number",
    "gravity 0 -9.81": "gravity: no body has a density",
    "gravity 0 0": "the gravity is 0 in every direction",
    "about 1 2": "the point is missing after 2",
    "state axisymmetric": "before all statements",
}


RING_REFUSED = {
    "moment top 1": "moment: a ring does not turn",
    "force top 1 0 free": "a force off the axis",
    "force top 0 1 rigid": "rigid: a ring moves along its axis alone",
    "force top 0 1 free at 0 1": "at: a ring has its force on the axis",
    "gravity 1 0": "gravity off the axis",
    "about A 0 0": "about: a ring has no moments",
}


PLAIN, RING_BLOCK = "body block E 100 nu 0.3\n", "state axisymmetric\nbody block E 100 nu 0.3 density 1\n"


BOTH = ((PLAIN, REFUSED), (RING_BLOCK, RING_REFUSED))


@pytest.mark.parametrize("body, line, words", [(body, *each) for body, lines in BOTH for each in lines.items()])
def test_refused(tmp_path, body, line, words):
    (tmp_path / "block.msh").write_text(block(Mesh()).text())
    code, why, _ = read(tmp_path, f"{body}{line}\nobstacle bottom plane 0 -1 0 1\n")
    assert code == 3 and words in why, why
