"""Bodies with a Poisson's ratio of 0.5 or nearly: mixed elements beside closed forms, P4 and an axisymmetric run."""

import numpy as np
import pytest
from freefem import part

RING = """
h = SIZE;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {2, 0, 0, h}; Point(4) = {0, 2, 0, h};
Point(5) = {0, 1, 0, h};
Line(1) = {2, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 5}; Circle(4) = {5, 1, 2}; Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Physical Surface("ring") = {1}; Physical Curve("bottom") = {1}; Physical Curve("outer") = {2};
Physical Curve("left") = {3}; Physical Curve("inner") = {4};
"""
CORD = """
R = 2.665; h = SIZE;
Point(1) = {0, 0, 0, h}; Point(2) = {R, 0, 0, h}; Point(3) = {0, R, 0, h / 4};
Line(1) = {1, 2}; Circle(2) = {2, 1, 3}; Line(3) = {3, 1}; Curve Loop(1) = {1:3};
Plane Surface(1) = {1};
Physical Surface("cord") = {1}; Physical Curve("mid") = {1}; Physical Curve("skin") = {2};
Physical Curve("mirror") = {3};
"""
CORD_CASE = "body cord E 6 nu NU\nsymmetry mid\nsymmetry mirror\nobstacle skin plane 0 2.665 0 -1 move 0 -0.05\n"
# a bonded disc of thickness 1, the lower half of it meshed, and a plate
DISC = """
R = 6; h = 0.2;
Point(1) = {0, 0, 0, h}; Point(2) = {R, 0, 0, h}; Point(3) = {R, 0.5, 0, h / 4}; Point(4) = {0, 0.5, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(11) = {0, 0.5, 0, h}; Point(12) = {R, 0.5, 0, h / 4}; Point(13) = {R, 1, 0, h}; Point(14) = {0, 1, 0, h};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11}; Curve Loop(2) = {11:14};
Plane Surface(2) = {2};
Physical Surface("rubber") = {1}; Physical Surface("plate") = {2}; Physical Curve("mid") = {1};
Physical Curve("top") = {3}; Physical Curve("under") = {11}; Physical Curve("head") = {13};
"""
PAD = """
Point(1) = {0, 0, 0, 0.15}; Point(2) = {2, 0, 0, 0.15}; Point(3) = {2, 1, 0, 0.15}; Point(4) = {0, 1, 0, 0.05};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Physical Surface("pad") = {1}; Physical Curve("base") = {1}; Physical Curve("top") = {3};
"""
PAD_IN_SPACE = """
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 1, 2, Pi / 2};
e = 1e-4; Physical Volume("pad") = {1};
Physical Surface("base") = Surface In BoundingBox{-e, -e, -e, 2 + e, 2 + e, e};
Physical Surface("top") = Surface In BoundingBox{-e, -e, 1 - e, 2 + e, 2 + e, 1 + e};
Physical Surface("sx") = Surface In BoundingBox{-e, -e, -e, e, 2 + e, 1 + e};
Physical Surface("sy") = Surface In BoundingBox{-e, -e, -e, 2 + e, e, 1 + e};
Mesh.MeshSizeMax = 0.4;
"""


def holds(summary, name, truth, least=0.0):
    """The truth is within the error that the run estimates, which is below a share of it."""
    found = summary["estimates"]["contacts"][0][name]
    assert abs(found["value"] - truth) <= found["error"], (name, found, truth)
    assert not least or found["error"] < least * truth


def test_no_free_surface(tmp_path):
    """A body that is closed in has the force of the Poisson's ratio that it is taken to have; the run says it."""
    box = 'SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 2, 2}; Mesh.MeshSizeMax = 0.25;\n'
    box += 'Physical Surface("b") = {1}; Physical Curve("bottom") = {1}; Physical Curve("right") = {2};\n'
    box += 'Physical Curve("top") = {3}; Physical Curve("left") = {4};\n'
    case = "body b E 6 nu 0.5\nclamp bottom y\nsymmetry left\nobstacle top plane 0 2 0 -1 move 0 -0.02\n"
    run = part(tmp_path, box, case + "obstacle right plane 2 0 -1 0\n")
    nu = 0.4999999
    assert "b: nu is taken as 0.4999999\n" in run.stdout
    holds(run.summary, "normalForce", 6 * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) * 0.01 * 2, 0.01)


@pytest.mark.parametrize("state, force, pressure", [("strain", 0.088 * np.pi, 0.088), ("axisymmetric", None, 0.044)])
def test_a_lined_tube_and_a_shell(tmp_path, state, force, pressure):
    """Inner pressure in an incompressible ring or sphere within a rigid one that is 0.004 larger: the motion is known.

    With u = u2 (r2/r)^n, n = 1 or 2, the pressure falls by 4 mu u2 r2^n n/(n + 1) (1/r1^(n + 1) - 1/r2^(n + 1)).
    """
    sides = "symmetry bottom\n" + ("symmetry left\n" if state == "strain" else "")
    case = f"state {state}\nbody ring E 3 nu 0.5\n{sides}pressure inner 0.1\nobstacle outer circle 0 0 R 2.004 inside\n"
    run = part(tmp_path, RING.replace("SIZE", "0.25"), f"{case}stresses\nline mid 1 0 2 0\n")
    holds(run.summary, "normalForce", force or 0.044 * 8 * np.pi, 2e-3)
    assert "mixed elements, since nu is above 0.49: ring" in run.stdout
    rows = np.genfromtxt(tmp_path / "out/line-mid.csv", delimiter=",", names=True)
    assert rows["stressXX"][0] == pytest.approx(-0.1, rel=0.02)
    assert rows["stressXX"][-1] == pytest.approx(-pressure, rel=0.02)
    around = {"strain": -0.068, "axisymmetric": -0.004}[state]
    assert rows["stressYY"][0] == pytest.approx(around, abs=2e-3)


@pytest.mark.parametrize("nu", ["0.5", "0.4999"])
def test_a_cord_under_a_plate(tmp_path, nu):
    """Hertz: pressure and length of the force. P2 elements alone have an alternating pressure."""
    case = CORD_CASE.replace("NU", nu) + "stresses\nline middle 0 0 0 2.665\n"
    summary = part(tmp_path, CORD.replace("SIZE", "0.3"), case).summary
    force, modulus = 2 * summary["contacts"][0]["normalForce"], 6 / (1 - float(nu) ** 2)
    half = np.sqrt(4 * force * 2.665 / (np.pi * modulus))
    holds(summary, "pressureMax", 2 * force / (np.pi * half), 0.06)
    holds(summary, "contactLength", half)
    rows = np.genfromtxt(tmp_path / "out/line-middle.csv", delimiter=",", names=True)
    assert rows["stressYY"][-1] == pytest.approx(-summary["contacts"][0]["pressureMax"], rel=0.02)
    assert not any("mixed" in text or "-order 4" in text for text in summary["warnings"])


def test_a_bonded_pad_under_a_steel_plate(tmp_path):
    """Gent's apparent modulus E (1 + 2 S^2) of a bonded disc, S = 3, is 2.4 % above P4's force 12.5897."""
    case = "state axisymmetric\nbody rubber E 3 nu 0.5\nbody plate E 2e5 nu 0.3\ntie top under\nsymmetry mid\n"
    summary = part(tmp_path, DISC, f"{case}move head 0 -0.001\n").summary
    holds(summary, "normalForce", 12.5897, 5e-3)
    assert summary["contacts"][0]["normalForce"] == pytest.approx(3 * 19 * 0.002 * 36 * np.pi, rel=0.03)


def test_other_order(tmp_path):
    """With P4, which has no mixed elements, on one mesh: force and pressure agree within both errors."""
    mesh, case = CORD.replace("SIZE", "0.5"), CORD_CASE.replace("NU", "0.499999")
    mixed, high = (
        part(tmp_path / str(order), mesh, case, "-order", order).summary["estimates"]["contacts"][0] for order in (2, 4)
    )
    for name in ("normalForce", "pressureMax"):
        assert abs(mixed[name]["value"] - high[name]["value"]) < mixed[name]["error"] + high[name]["error"]
        assert mixed[name]["value"] != high[name]["value"]


def test_in_space(tmp_path):
    """A pad under a sphere, a quarter of it in space, as about an axis; the errors have the truth of either."""
    held, top = "body pad E 3 nu 0.5\nclamp base\n", "obstacle top {} R 4 move {}-0.05\n"
    ring = part(tmp_path, PAD, f"state axisymmetric\n{held}{top.format('circle 0 5', '0 ')}").summary
    space = f"{held}symmetry sx\nsymmetry sy\n{top.format('sphere 0 0 5', '0 0 ')}"
    quarter = part(tmp_path / "space", PAD_IN_SPACE, space, space=True).summary
    flat, solid = (found["estimates"]["contacts"][0] for found in (ring, quarter))
    for name, copies in (("normalForce", 4), ("pressureMax", 1)):
        difference = abs(flat[name]["value"] - copies * solid[name]["value"])
        assert difference <= flat[name]["error"] + copies * solid[name]["error"]
    assert solid["normalForce"]["error"] < 0.04 * solid["normalForce"]["value"]


def test_unchanged_below(tmp_path):
    """At 0.49 and in plane stress bodies have the elements that they had, and the run reads no module of mixed ones."""
    for k, (nu, state) in enumerate([("0.49", "strain"), ("0.5", "stress")]):
        run = part(tmp_path / str(k), CORD.replace("SIZE", "1"), f"state {state}\n{CORD_CASE.replace('NU', nu)}")
        assert "mixed" not in run.stdout
