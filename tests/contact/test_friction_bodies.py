"""Friction between own parts, where few loads or slender bodies decide: press fits, parts on mirrors, belts."""

import re
import sys
from math import cos, exp, pi, sin, sqrt

import numpy as np
import pytest
import shapes
from freefem import ROOT, cases_of, data, environment, execute, part, run_in, snippet, table, told
from output.test_paraview import Grid

from contact.test_friction import LYING, case, series

FIT = data("friction-bodies/fit.geo")
FITTED = """state stress
body shaft E 200e3 nu 0.3
body hub E 100e3 nu 0.3
contact hole seat interference 0.01 friction 0.2
clamp bore
"""
SLEEVE = data("friction-bodies/sleeve.geo")
SLEEVED = """state axisymmetric
body shaft E 200e3 nu 0.3
body hub E 100e3 nu 0.3
contact hole seat interference 0.01 friction 0.2
clamp foot
"""
SPACE_FIT = data("friction-bodies/space-fit.geo")
SPACE_FITTED = data("friction-bodies/space-fitted.case")


def test_press_fit_without_other_loads(tmp_path):
    """Lamé's pressure of two rings, the inner one's bore held; nothing but friction holds the outer one's rotation."""
    fit = case(tmp_path, FIT, FITTED)
    inner, seat, outer = 3, 8, 12
    ring = 1.3 + 0.7 * (inner / seat) ** 2
    soft = seat * 0.91 * (1 - (inner / seat) ** 2) / ring / 200e3
    soft += seat * ((outer**2 + seat**2) / (outer**2 - seat**2) + 0.3) / 100e3
    assert fit.summary["contacts"][0]["normalForce"] == pytest.approx(2 * pi * seat * 0.01 / soft, rel=1e-4)
    assert fit.summary["newton"] <= 6


def test_light_load_on_a_tight_fit(tmp_path):
    """A load of 4e-7 of the normal force is borne to -tol of itself."""
    fit = case(tmp_path, FIT, FITTED + "traction rim 1e-5 0\n")
    pulled = 1e-5 * 2 * pi * 12
    assert fit.summary["supports"][0]["force"] == pytest.approx([-pulled, 0], abs=1e-5 * pulled)


def test_press_fit_in_space(tmp_path):
    fit = case(tmp_path, SPACE_FIT, SPACE_FITTED, "-order", 1, space=True)
    contact = fit.summary["contacts"][0]
    assert fit.summary["newton"] <= 12 and np.abs(contact["force"]).max() < 1e-9 * contact["normalForce"]


def test_steps_that_run_out_are_no_lack_of_equilibrium(tmp_path):
    fit = case(tmp_path, FIT, FITTED, "-maxNewton", 1, expect=20)
    assert "stands at residual" in fit.message


@pytest.mark.parametrize("pull, code", [(8, 0), (11, 20)])
def test_sleeve_pulled_off(tmp_path, pull, code):
    """Along its axis: up to the friction of the fit it holds; beyond, the reason names the load."""
    fit = case(tmp_path, SLEEVE, SLEEVED + f"traction rim 0 {pull}\n", expect=code)
    if code == 0:
        return
    found = re.search(
        r"\(traction rim\): friction and contact carry between (\S+) % and (\S+) % of this leg's", fit.message
    )
    carried, not_carried = (float(share) for share in found.groups())
    assert 8 / pull < carried / 100 < not_carried / 100 < carried / 100 + 0.0012 < 1


# ---------------------------------------------------------------- symmetry planes

QUARTER = data("friction-bodies/quarter.geo")
PRESSED = """body block E 70e3 nu 0.3
body disc E 210e3 nu 0.3
contact top round friction 0.1
symmetry middle
clamp base
force load 0 -1000
"""


def test_mirrored_point_has_no_friction(tmp_path):
    """Half of a cylinder on half of a block, meshes that do not match: where the plane cuts them nothing slides."""
    half = case(tmp_path, QUARTER, PRESSED, "-estimate", 1)
    contact = half.summary["contacts"][0]
    assert contact["mesh"]["shearForce"]["error"] < 0.05 * abs(contact["shearForce"][0])
    rows = table(half.folder / "contact.csv")
    first = abs(rows["x"]).argmin()
    assert abs(rows["x"][first]) < 1e-9 and rows["shear"][first] == 0 and rows["slip"][first] == 0


def test_greatest_pressures_of_two_meshes(tmp_path):
    """Neither's error excludes the other: a load's way moves pressures by what a unit of the load does."""
    found = []
    for k, share in enumerate((6, 12)):
        (tmp_path / str(k)).mkdir()
        mesh = QUARTER.replace("0.3}", f"{0.3 / share}}}").replace("0.22}", f"{0.22 / share}}}")
        summary = case(tmp_path / str(k), mesh, PRESSED, "-estimate", 1).summary
        found.append((summary["pressureMax"], summary["estimates"]["pressureMax"]["error"]))
    (one, first), (other, second) = found
    assert abs(one - other) < first + second < 0.02 * one


ARM = data("friction-bodies/arm.geo")
ROD = """body arm E 1000 nu 0.3
obstacle sole circle 4 -5 R 5RUBS
clamp wall
"""


@pytest.mark.parametrize("rubs", cases_of([" friction 0.3"], [""]))
def test_way_of_a_load_by_differences(tmp_path, rubs):
    """An arm that a traction presses: what a unit of the load moves it by, of the adjoint, as a greater load does."""
    ways = []
    for k, share in enumerate((1, 1.01)):
        (tmp_path / str(k)).mkdir()
        text = ROD.replace("RUBS", rubs) + f"traction back {0.3 * share} {-share}\n"
        found = case(tmp_path / str(k), ARM, text, "-estimate", 1, "-tol", 1e-9).summary["estimates"]
        ways.append(found["loads"][0]["way"]["value"])
    assert found["contactStiffness"] == pytest.approx((ways[1] - ways[0]) / (0.01 * 5 * sqrt(1.09)), rel=1e-5)


HALVES = data("friction-bodies/halves.geo")
BLOCKS = """body low E 1000 nu 0.3
body up E 3000 nu 0.3
contact foot top friction 0.3
clamp base
"""


def mesh_again(half: str, turned: float, both: bool) -> str:
    """A mesh of gmsh's format 2.2 turned about z; both: with its image beyond the plane y = 0, joined with it there."""
    head, rest = half.split("$Nodes\n")
    nodes, rest = rest.split("$EndNodes\n$Elements\n")
    at = {int(number): tuple(map(float, place)) for number, *place in map(str.split, nodes.splitlines()[1:])}
    cells = [list(map(int, line.split())) for line in rest.split("$EndElements")[0].splitlines()[1:]]
    if both:
        image = {k: k if abs(place[1]) < 1e-9 else k + max(at) for k, place in at.items()}
        cells = [row for row in cells if any(image[k] != k for k in row[5:])]
        at |= {image[k]: (x, -y, z) for k, (x, y, z) in list(at.items()) if image[k] != k}
        cells += [[*row[:4], 100 + row[4], *(image[k] for k in (row[6], row[5], *row[7:]))] for row in cells]
    c, s = cos(turned), sin(turned)
    lines = [f"{k} {c * x - s * y!r} {s * x + c * y!r} {z!r}" for k, (x, y, z) in at.items()]
    rows = [" ".join(map(str, [k, *row[1:]])) for k, row in enumerate(cells, 1)]
    nodes, elements = (f"{len(part)}\n" + "\n".join(part) + "\n" for part in (lines, rows))
    return f"{head}$Nodes\n{nodes}$EndNodes\n$Elements\n{elements}$EndElements\n"


def test_mirror_in_space(tmp_path):
    """Half a block on half a block, turned about z, so that no axis is the mirror's normal: as the whole ones are."""
    (tmp_path / "half.geo").write_text(HALVES)
    shapes.gmsh(tmp_path / "half.geo", tmp_path / "half.msh", "-3", np.eye(3))
    half, found = (tmp_path / "half.msh").read_text(), []
    for turned, both in ((0, True), (0.6, False)):
        c, s = cos(turned), sin(turned)
        text = BLOCKS + f"move head {0.004 * c} {0.004 * s} -0.01\n" + ("" if both else "symmetry mirror\n")
        folder = tmp_path / str(both)
        folder.mkdir()
        (folder / "a.msh").write_text(mesh_again(half, turned, both))
        (folder / "a.case").write_text(text)
        words = "-mesh", folder / "a.msh", "-case", folder / "a.case", "-order", 1, "-estimate", 0, "-vtu", 0
        run = run_in(ROOT, "edp/parts-3d.edp", *words, out=folder / "out")
        contact, share = run.summary["contacts"][0], 0.5 if both else 1
        along = c * contact["shearForce"][0] + s * contact["shearForce"][1]
        found.append([share * contact["normalForce"], share * along, contact["stickShare"]])
    assert found[1] == pytest.approx(found[0], rel=1e-5)


# ---------------------------------------------------------------- the files of P3 in space

BOX = """
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Physical Volume("box") = {1};
"""
RUBBED = """group foot plane 0 0 0 0 0 1
group head plane 0 0 1 0 0 1
size box 1
body box E 1000 nu 0.3
obstacle foot plane 0 0 0 0 0 1 friction 0.3
move head 0.004 0.002 -0.01
"""


def test_all_fields_of_a_contact(tmp_path):
    """P3 in space with friction and estimates: contact.vtu has what each of them adds, under its own name."""
    rubbed = part(tmp_path, BOX, RUBBED, "-order", 3, "-vtu", 1, script="edp/parts-3d.edp")
    found, rows = Grid(rubbed.folder / "contact.vtu").at_points, table(rubbed.folder / "contact.csv")
    for name in ("shearX", "shearY", "shearZ", "slipX", "slipY", "slipZ", "slide", "status", "pressure"):
        (field,) = [field for field in found if field.lower().startswith(("contact" + name, name.lower()))]
        assert found[field][: len(rows[name])] == pytest.approx(rows[name], rel=1e-8, abs=1e-12), name
    assert abs(rows["slide"]).max() == 2 and found["recoveredPressure[pressure]"].max() > 0


# ---------------------------------------------------------------- slender bodies

BELT = data("friction-bodies/belt.geo")
BELTED = """body belt E 2000 nu 0.3
obstacle inner circle 0 0 R 10 friction MU
traction slack 0 -1
move tight 0 -0.3
"""


@pytest.mark.parametrize("friction, thick", cases_of([(0.8, 0.05)], [(0.8, 0.2), (0.3, 0.2)]))
def test_belt_over_half_a_turn(tmp_path, friction, thick):
    """It slips: the tensions' ratio is Euler's, of a belt that is pulled in its middle and rubs at its inner side.

    With r from the middle of its thickness, friction q = mu p turns it about its middle by q T/2, borne by a transverse
    force V = q T/2 alone, for its curvature stays the pulley's: N - V' = p r, r N' = q R. So p grows by e^(rate theta)
    where rate (r + mu rate T/2) = mu R, and the tension as much.
    """
    belt = case(tmp_path, BELT.replace("0.2 * k", f"{thick} * k"), BELTED.replace("MU", str(friction)))
    assert belt.summary["newton"] + belt.summary["kernelNewton"] <= 13 and belt.summary["backsolves"] <= 40
    contact = belt.summary["contacts"][0]
    assert contact["stickShare"] == 0 and belt.history[-1]["force"] == pytest.approx(contact["normalForce"], rel=1e-9)
    middle = 10 + thick / 2
    rate = (sqrt(middle**2 + 20 * friction**2 * thick) - middle) / (friction * thick)
    tight = -belt.summary["supports"][0]["force"][1]
    assert tight == pytest.approx(thick * exp(rate * pi), rel=2e-3)
    assert thick > 0.1 or tight == pytest.approx(thick * exp(friction * pi), rel=0.011)
    assert belt.summary["outOfBalance"] < 1e-8


def test_belt_that_is_let_back(tmp_path):
    """Slips of both signs meet on it at a place that few linearisations find. Let back, it slips the other way.

    The ratio of the tensions is that of test_belt_over_half_a_turn and of -MU, but for its bending at the ends.
    """
    text = BELTED.replace("MU", "0.2").replace("traction", "leg 1\ntraction").replace("-0.3", "-0.02")
    text += "leg 2\nmove tight 0 -0.7\nleg 1\nmove tight 0 -0.3\n"
    belt = case(tmp_path, BELT.replace("0.2 * k", "0.1 * k"), text)
    rows = series(belt)
    assert np.diff(rows["newton"], prepend=0).max() <= 11 and belt.summary["outOfBalance"] < 1e-8
    for step, friction in ((2, 0.2), (3, -0.2)):
        rate = (sqrt(10.05**2 + 20 * friction**2 * 0.1) - 10.05) / (friction * 0.1)
        assert rows["move tight reaction"][step] == pytest.approx(0.1 * exp(rate * pi), rel=1e-2)


PULLEY = data("friction-bodies/pulley.geo")
AROUND = """units mm MPa
state stress
body belt E 100e3 nu 0.3
obstacle inner circle 0 0 R 50 friction MU
move tight 0 0
leg 2
traction slack 0 -10
leg 8
traction slack 0 -10
move tight -0.05 0
"""


@pytest.mark.parametrize(
    "size, friction, first, most",
    cases_of([(3, 0.3, 13, 4)], [(0.8, 0.3, 13, 4), (1.5, 0.8, 13, 21), (3, 1.2, 15, 31)]),
)
def test_belt_bends_in_few_solves(tmp_path, size, friction, first, most):
    """A belt's bending compliance is 1e8 times that of its surface: a few factorisations solve each step, no columns.

    The ratio of the tensions is that of test_belt_over_half_a_turn, over a quarter of a turn.
    """
    belt = case(tmp_path, PULLEY, AROUND.replace("MU", str(friction)), "-set", "hs", size)
    rate = (sqrt(50.5**2 + 100 * friction**2) - 50.5) / friction
    (tight,) = (entry["force"] for entry in belt.summary["prescribed"] if entry["name"] == "move tight")
    assert tight == pytest.approx(10 * exp(rate * pi / 2), rel=2e-3)
    assert belt.summary["kernelNewton"] == 0 and belt.summary["outOfBalance"] < 1e-8
    rows = series(belt)
    steps, solves = np.diff(rows["newton"], prepend=0), np.diff(rows["backsolves"], prepend=0)
    assert steps[0] <= first and steps[1:].max() <= most
    assert solves[0] <= 40 and (friction > 0.3 or solves[1:].max() <= 8)
    assert belt.summary["factorisations"] <= steps.sum() + 1


@pytest.mark.parametrize(
    "scene, flags", cases_of([("fretting-bodies", ())], [("fretting-3d", ("-h", 3, "-layers", 2))])
)
def test_factor_solves_as_all_columns_do(tmp_path, scene, flags):
    """The system with the stiffness has the solution of the dense one with all columns of C; so has its adjoint."""
    text = (ROOT / f"edp/scenes/{scene}.edp").read_text() + data("friction-bodies/tangent.edp")
    found = told(snippet(tmp_path, text, *flags, "-estimate", 0, "-vtu", 0, "-out", tmp_path / "out"))
    assert max(found["forward"][0], found["transposed"][0], found["layer"][0]) < 1e-9
    assert found["slipping"][0] > 3 and (flags or found["modes"][0] > 0)
    assert found["again"][0] < 1e-9 and found["factored"][0] == 0


def test_belt_with_the_true_distance(tmp_path):
    """The states at the points outlast a new pairing: forces hardly change, no step begins anew."""
    text = AROUND.replace("MU", "0.3")
    linear = case(tmp_path / "linear", PULLEY, text, "-set", "hs", 3)
    exact = case(tmp_path / "exact", PULLEY, text, "-set", "hs", 3, "-distance", "exact")
    forces = [run.summary["contacts"][0]["normalForce"] for run in (linear, exact)]
    assert forces[1] == pytest.approx(forces[0], rel=2e-3) and exact.summary["newton"] <= 60


WEDGE = data("friction-bodies/wedge.geo")
WEDGED = """body wedge E 2503.75 nu 0.04
obstacle flank plane 0.5 0 -1 0.25149 friction 0.2575
symmetry mirror
leg 1
traction head 0 -10
leg 4
traction head 0 -0.5
"""


@pytest.mark.parametrize("law", ["", " law linear k 100", " friction 0.2"])
def test_block_let_go(tmp_path, law):
    """A block that was pressed and is flush with its obstacle again shall carry nothing, and the run shall end well."""
    block = tmp_path / "block.geo"
    block.write_text(
        'SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 10, 10}; Mesh.MeshSizeMax = 1;\n'
        'Physical Surface("block") = {1}; Physical Curve("base") = {1}; Physical Curve("top") = {3};\n'
    )
    legs = f"leg 1\nobstacle top plane 0 10 0 -1{law} move 0 -0.1\nleg 1\nobstacle top move 0 0\n"
    part(tmp_path, block, f"body block E 1000 nu 0.3\nclamp base\n{legs}")
    rows = table(tmp_path / "out/series.csv")
    force = rows["top plane normal force"]
    assert len(force) == 2 and force[0] > 50 and abs(force[1]) < 1e-9 * force[0]


def test_taper_let_back(tmp_path):
    """A plug that was driven in and is let back to its place carries next to nothing, within the tolerance."""
    plug = tmp_path / "plug.geo"
    plug.write_text(
        "Point(1) = {0, 0, 0}; Point(2) = {20, 0, 0}; Point(3) = {20 + 40 * Tan(Pi / 36), 40, 0};\n"
        "Point(4) = {0, 40, 0}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
        'Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Physical Surface("plug") = {1};\n'
        'Physical Curve("flank") = {2}; Mesh.MeshSizeMax = 2;\n'
        'Physical Curve("head") = {3}; Physical Curve("axis") = {4};\n'
    )
    text = "state axisymmetric\nbody plug E 70e3 nu 0.33\nsymmetry axis\nobstacle flank polygon "
    text += (
        " ".join(f"{20 + y * np.tan(np.pi / 36):.10f} {y}" for y in (-50, 114.2)) + " 60 114.2 60 -50 friction 0.1\n"
    )
    part(tmp_path, plug, text + "leg 8\nmove head * -0.2\nleg 8\nmove head * 0\n", "-estimate", 0)
    force = table(tmp_path / "out/series.csv")["flank polygon normal force"]
    assert force[7] > 1e3 and abs(force[-1]) < 1e-5 * force[7]


def test_wedge_let_go(tmp_path):
    """Where all contact is lost, found, and lost again in Newton's steps, it starts elsewhere; the wedge is held."""
    let_go = case(tmp_path, WEDGE, WEDGED)
    assert np.diff(series(let_go)["newton"], prepend=0).max() <= 20


@pytest.mark.parametrize("kinds", cases_of([("block",)], [("fit", "wedge", "belt")]))
def test_sample_of_the_campaign(tmp_path, kinds):
    """One of each sort of own parts that statics allows is solved, within twelve linearisations a step."""
    command = [sys.executable, "tests/campaigns/friction.py", *kinds, "--paths", "1", "--out", tmp_path / "steps.csv"]
    code, stdout = execute(command, env=environment(PYTHONPATH=ROOT))
    assert code == 0 and stdout.count(" 0 failed") == len(kinds), stdout
    assert max(map(int, re.findall(r"newton: .*most (\d+)", stdout))) <= 12


def test_moment_of_a_twisted_fit(tmp_path):
    """All of a press fit slips: friction's moment on the displaced radius, turned from inside or outside."""
    fit = FIT.replace("{3, 8, 8, 12}", "{3, 8.05, 8, 12}")
    text = FITTED.replace("interference 0.01 ", "").replace("clamp bore", "clamp {}\nrotate {} 0 0 0.03")
    moments = []
    for groups in (("rim", "bore"), ("bore", "rim")):
        run = case(tmp_path / groups[0], fit, text.format(*groups), "-distance", "exact", "-estimate", 1)
        slips = 0.2 * run.summary["contacts"][0]["normalForce"]
        moments.append(run.summary["prescribed"][0]["moment"])
        assert slips * 8 < moments[-1] < slips * 8.05
        assert run.summary["prescribed"][0]["error"] < 2e-3 * moments[-1]
    assert moments[0] == pytest.approx(moments[1], rel=1e-4)


def test_heated_fit_that_turns(tmp_path):
    """With linear gaps a rotation is a small one, also with expand, which reads the module of large ones: all slips."""
    text = FITTED.replace("interference 0.01 ", "").replace("clamp bore", "clamp rim\nrotate bore 0 0 0.002")
    fit = case(tmp_path, FIT, text + "expand shaft 12e-6 60\n")
    slips = 0.2 * fit.summary["contacts"][0]["normalForce"]
    assert fit.summary["prescribed"][0]["moment"] == pytest.approx(8 * slips, rel=1e-4)


SLIDERS = """
For k In {0 : 1}
  left = k / 2;
  right = 2 - k / 2;
  Point(4 * k + 1) = {left, k, 0, H}; Point(4 * k + 2) = {right, k, 0, H};
  Point(4 * k + 3) = {right, k + 1, 0, H}; Point(4 * k + 4) = {left, k + 1, 0, H};
  For l In {1 : 4}
    Line(4 * k + l) = {4 * k + l, 4 * k + l % 4 + 1};
  EndFor
  Curve Loop(k + 1) = {4 * k + 1 : 4 * k + 4};
  Plane Surface(k + 1) = {k + 1};
EndFor
Physical Surface("block") = {1}; Physical Curve("base") = {1}; Physical Curve("floor") = {3};
Physical Curve("right") = {2}; Physical Curve("left") = {4};
Physical Surface("slider") = {2}; Physical Curve("sole") = {5}; Physical Curve("grip") = {7};
"""


def test_normal_force_of_tilted_normals(tmp_path):
    """Where surfaces bend, shears bear a part of the load: the balance alone does not tell the normal force."""
    text = "body block E 300 nu 0.4\nbody slider E 1000 nu 0.4\nclamp base\ncontact sole floor friction 0.3\n"
    text += "force grip 0 -8\n"
    run = case(tmp_path, SLIDERS.replace("H", "0.25"), text, "-distance", "exact", "-estimate", 1)
    normal = run.summary["estimates"]["contacts"][0]["normalForce"]
    assert 1e-3 < normal["error"] < 1e-2 and abs(normal["value"] - 8.0125) < 3 * normal["error"]


@pytest.mark.parametrize("friction", [0.3, 0.15])
def test_two_contacts_at_a_corner(tmp_path, friction):
    """What one contact's shear carries there is another's normal force: forces are known to that, on any mesh."""
    geo = re.sub("For k In .0 : 1.", "For k In {0 : 0}", SLIDERS[: SLIDERS.index('Physical Surface("slider')])
    text = f"body block E 1000 nu 0.3\nobstacle base plane 0 0 0 1 friction {friction}\n"
    text += f"obstacle left plane 0 0 1 0 friction {friction}\npressure floor 1\npressure right 0.5\n"
    errors, truth = [], None
    for size in (0.4, 0.2, 0.1):
        run = case(tmp_path / str(size), geo.replace("H", str(size)), text, "-estimate", 1)
        base, left = run.summary["contacts"]
        told = [c["normalForce"] for c in run.summary["estimates"]["contacts"]]
        found = [np.linalg.norm(base["shearForce"]), np.linalg.norm(left["shearForce"]), *(n["value"] for n in told)]
        errors.append([c["mesh"]["shearForce"]["error"] for c in (base, left)] + [n["error"] for n in told])
        if truth is not None:
            assert (abs(np.array(found) - truth) < np.array(errors[-1]) + errors[-2]).all()
        truth = np.array(found)
    assert min(errors[-1]) > 4e-3 and max(errors[-1]) < 0.02 and max(errors[-1]) < 0.5 * max(errors[0])


@pytest.mark.parametrize("size, order", [(0.4, 1), (0.5, 2)])
def test_grounded_node_rubs(tmp_path, size, order):
    """A body that contact alone holds is grounded at a node, which may be in contact: friction acts there as well."""
    geo = re.sub("For k In .0 : 1.", "For k In {0 : 0}", SLIDERS[: SLIDERS.index('Physical Surface("slider')])
    text = "body block E 1000 nu 0.3\nobstacle base plane 0 0 0 1 friction 0.15\n"
    text += "obstacle left plane 0 0 1 0 friction 0.15\npressure floor 1\npressure right 0.5\n"
    run = case(tmp_path, geo.replace("H", str(size)), text, "-order", order)
    assert run.summary["contacts"][0]["normalForce"] == pytest.approx(1.9366, rel=2e-3)  # without: 1.946
    rows = table(run.folder / "contact.csv")
    assert all(rows["shear"][(rows["x"] == 0) & (rows["y"] == 0)])


def test_points_that_the_true_distance_loses(tmp_path):
    """A warning names them, and no change of nothing."""
    text = "body block E 1000 nu 0\nbody slider E 1000 nu 0\nmove base -0.7 0\ncontact sole floor\nforce grip 0 -1\n"
    run = case(tmp_path, SLIDERS.replace("H", "0.25"), text, "-estimate", 1)
    (warning,) = (text for text in run.summary["warnings"] if "linearised" in text)
    assert re.search("[23] points in contact have nothing opposite", warning)


def test_moment_of_a_turned_drum(tmp_path):
    """A shoe on a drum that turns in a later load phase: its moment is friction times radius, in every step."""
    groups = (
        "drum surfaces 1",
        "shoe surfaces 20",
        "rim between drum shoe",
        "lining between shoe drum",
        "hub near 60 0",
    )
    groups += ("pivot near -105 118", "end plane 120 118 1 0")
    text = "units mm MPa\nstate strain\n" + "".join(f"group {group}\n" for group in groups)
    text += "size lining 6\nsize rim 6\nbody drum E 110e3 nu 0.27\nbody shoe E 210e3 nu 0.3\nclamp pivot\n"
    text += "contact lining rim friction 0.3\nleg 2\nforce end 0 -100 free\nrotate hub 0 0 0\n"
    text += "leg 2\nforce end 0 -100 free\nrotate hub 0 0 0.01\n"
    done = part(tmp_path, data("friction-bodies/brake.geo"), text, *"-distance exact -order 1 -estimate 0".split())
    (moment,) = (entry["moment"] for entry in done.summary["prescribed"] if entry["name"] == "rotate hub")
    rows = series(done)
    for reaction, force in zip(rows["rotate hub reaction"][-2:], rows["lining rim normal force"][-2:], strict=True):
        assert reaction == pytest.approx(0.3 * force * 100, rel=2e-3)
    assert moment == pytest.approx(rows["rotate hub reaction"][-1], rel=1e-9)


def test_columns_bought_one_by_one(tmp_path):
    """Columns put into the compliance's model one by one leave it what it is with all at once; a singular matrix."""
    text = (ROOT / "edp/scenes/fretting-bodies.edp").read_text() + data("friction-bodies/columns.edp")
    found = told(snippet(tmp_path, text, "-estimate", 0, "-vtu", 0, "-out", tmp_path / "out"))
    assert found["off"][0] < 1e-12 and found["columns"][0] < 2e-9
    assert found["inverted"][0] == 0 and found["diagonal"].tolist() == [0, 0.5, 0]


CYLINDERS = """DefineConstant[ low = {20, Name "low"} ]; DefineConstant[ up = {20, Name "up"} ];
Point(1) = {0, up, 0}; Point(2) = {-up, up, 0}; Point(3) = {0, 0, 0}; Point(4) = {up, up, 0};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 1}; Line(4) = {1, 2};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Point(11) = {0, -low, 0}; Point(12) = {-low, -low, 0}; Point(13) = {0, 0, 0}; Point(14) = {low, -low, 0};
Circle(11) = {12, 11, 13}; Circle(12) = {13, 11, 14}; Line(13) = {14, 11}; Line(14) = {11, 12};
Curve Loop(2) = {11 : 14}; Plane Surface(2) = {2};
Physical Curve("up") = {1, 2}; Physical Curve("grip") = {3, 4}; Physical Curve("low") = {11, 12};
Physical Curve("base") = {13, 14}; Physical Surface("a") = {1}; Physical Surface("b") = {2}; Mesh.MeshSizeMax = 3;
"""
SQUASHED = """size contact 0.05
body a E 210e3 nu 0.3
body b E 210e3 nu 0.3
contact low up friction 0.5
clamp base
leg 1
move grip 0 -0.012
"""
BALLS = """SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, -10, 10, 0, Pi/2, Pi/2}; Sphere(2) = {0, 0, 10, 10, -Pi/2, 0, Pi/2}; Mesh.MeshSizeMax = 5;
Physical Volume("a") = {1}; Physical Volume("b") = {2}; Physical Surface("low") = {1}; Physical Surface("up") = {5};
Physical Surface("base") = {2}; Physical Surface("grip") = {6}; Physical Surface("sides") = {3, 4, 7, 8};
"""
SQUEEZED = SQUASHED.replace("0.05", "0.4").replace("0 -0.012", "0 0 -0.1") + "symmetry sides\n"


def outward(run):
    """The shears away from the middle, as a share of the friction of the normal forces."""
    rows = run.contact
    x, y = (rows["x"], rows["y"]) if "shearX" in rows.dtype.names else (rows["x"], 0 * rows["x"])
    along = rows["shearX"] * x + rows["shearY"] * y if y.any() else rows["shear"] * x
    away = np.maximum(np.hypot(x, y), 1e-9)
    return (rows["weight"] * along / away).sum() / (0.5 * (rows["weight"] * rows["pressure"]).sum())


@pytest.mark.parametrize("low, up", cases_of([(20, 20)], [(20, 20), (20, 40), (40, 20)]))
def test_pressing_alone_makes_no_slip(tmp_path, low, up):
    """Cylinders of one material, in one load step: no shear, by symmetry and by Hertz's theory."""
    run = part(tmp_path, CYLINDERS, SQUASHED, "-set", "low", low, "-set", "up", up)
    assert abs(outward(run)) < 1e-3
    assert np.abs(run.contact["shear"]).max() < 0.015 * 0.5 * run.contact["pressure"].max()
    (contact,) = run.summary["contacts"]
    assert 1 - contact["stickShare"] <= contact["mesh"]["stickShare"]["error"] < 0.15
    assert re.search(r"sticking part +\S+ ± \S+ \(mesh\)", run.stdout)


@pytest.mark.parametrize(
    "flags",
    cases_of(["-order 1"], ["-order 1", "-order 2", "-order 1 -points nodal", "-surface facets"]),
)
def test_pressed_balls_do_not_slip(tmp_path, flags):
    """Balls of one material, a quarter: hardly any shear outwards, on straight and on curved elements."""
    run = part(tmp_path, BALLS, SQUEEZED, "-estimate", 0, *flags.split(), space=True)
    assert abs(outward(run)) < 0.03


SLOPED = """DefineConstant[ deep = {0, Name "deep"} ];
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Point(5) = {-1, 1.3 - Tan(0.4), 0}; Point(6) = {2, 1.3 + 2 * Tan(0.4), 0}; Point(7) = {2, 4, 0}; Point(8) = {-1, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1}; Curve Loop(2) = {5 : 8}; Plane Surface(2) = {2};
Mesh.MeshSizeMax = 0.5;
If(deep)
  a() = Extrude{0, 0, 1}{Surface{1};}; b() = Extrude{0, 0, 1}{Surface{2};};
  Physical Volume("a") = {a[1]}; Physical Volume("b") = {b[1]}; Physical Surface("base") = {a[2]};
  Physical Surface("top") = {a[4]}; Physical Surface("foot") = {b[2]}; Physical Surface("head") = {b[4]};
Else
  Physical Surface("a") = {1}; Physical Surface("b") = {2}; Physical Curve("base") = {1}; Physical Curve("top") = {3};
  Physical Curve("foot") = {5}; Physical Curve("head") = {7};
EndIf
"""
ABOVE = "body a E 100 nu 0.3\nbody b E 100 nu 0.3\ncontact top foot{}\nclamp base\nclamp head\n"


@pytest.mark.parametrize(
    "space, points, friction, share",
    cases_of(
        [(False, "segment", 0.3, 0.5), (True, "nodal", 0.3, 0.5)],
        [
            (False, "segment", 0.3, 0.5),
            (False, "nodal", 0.3, 0.5),
            (False, "segment", 0, 0),
            (True, "nodal", 0.3, 0.5),
            (True, "segment", 0.3, 0.5),
        ],
    ),
)
def test_normals_between_sloped_faces(tmp_path, space, points, friction, share):
    """With friction normals halve the angle between two faces, and gaps are measured along them."""
    case, flags = ABOVE.format(f" friction {friction}"), ["-check", 1, "-order", 1, "-points", points]
    checked = part(tmp_path, SLOPED, case, *flags, *(["-set", "deep", 1] if space else []), space=space)
    rows = table(checked.folder / "check/check-points.csv")
    turned = 0.4 * share
    assert rows["nx"] == pytest.approx(-np.sin(turned)) and rows["ny"] == pytest.approx(np.cos(turned))
    assert rows["gap"] == pytest.approx((0.3 + rows["x"] * np.tan(0.4)) * np.cos(turned))


@pytest.mark.parametrize("steps, drag", cases_of([(2, 0.41)], [(2, 0.41), (1, 0.31), (7, 0.75)]))
def test_bracket_of_what_friction_carries(tmp_path, steps, drag):
    """A block on a plane is dragged too hard: the run brackets the limit, 0.3 of the pressure."""
    text = "body block E 1000 nu 0.3\nobstacle base plane 0 0 0 1 friction 0.3\nleg 1\ntraction head 0 -1\n"
    run = case(tmp_path, LYING, f"{text}leg {steps}\ntraction head {drag} -1\n", expect=20)
    shares = re.search(
        r"friction and contact carry between (\S+) % and (\S+) % of this leg's change of load", run.message
    )
    carried, not_carried = (float(share) / 100 for share in shares.groups())
    assert carried <= 0.3 / drag <= not_carried <= carried + 0.0012
