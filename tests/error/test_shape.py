"""The shape's part of a number in the plane: corners, elements that follow every smooth boundary, what is unknown."""

import json
import re

import numpy as np
import pytest
from contact.test_surfaces import ring
from freefem import ROOT, cases_of, data, execute, part, snippet, told
from input.test_parts import Mesh, block

# outer ring 10.05 to 14, inner ring 7 to 10
RINGS = "body outer E 1000 nu 0.3\nbody inner E 1000 nu 0.3\n"
SHARP = """
real[int] corner(Th.nbe);
for (int e = 0; e < Th.nbe; e++) corner[e] = sideCorner[e] > 0;
tell("corners", corner.sum);
tell("curved", curvedElements);
"""


def sharp(folder, mesh, case, name="a.msh"):
    """Corners of the whole boundary, elements that follow it."""
    (folder / name).write_text(mesh)
    (folder / "a.case").write_text(case)
    text = (ROOT / "edp/parts.edp").read_text().split("checkOpposingSurfaces();")[0] + SHARP
    return told(snippet(folder, text, "-mesh", name, "-case", "a.case"))


def fit(edges, overlap=0.001):
    """A ring of radii 7 and 10 pressed into one of 10 and 14, of so many sides."""
    mesh = ring(Mesh(), 10, 14, edges, 2, "outer", ("bore", "rim"))
    return ring(mesh, 7, 10 + overlap, edges, 2, "inner", ("hole", "pin"), 0.1).text()


def lame(inner=7, radius=10, outer=14, overlap=0.001):
    """Integral of the pressure of such rings, round."""
    bends = (radius**2 + inner**2) / (radius**2 - inner**2) + (outer**2 + radius**2) / (outer**2 - radius**2)
    return 2 * np.pi * overlap * 1000 / (1 - 0.3**2) / bends


FIELDS = data("shape/fields.edp")
PEAK = data("shape/peak.edp")


@pytest.mark.parametrize("order", [1, 2])
def test_heavy_disc(tmp_path, order):
    """What Hertz's pressure is above that of one point; energies from either side; no rolling that nothing feels."""
    (tmp_path / "a.geo").write_text(DISC)
    (tmp_path / "a.case").write_text(HEAVY)
    text, files = (ROOT / "edp/parts.edp").read_text() + PEAK, ["-mesh", "a.geo", "-case", "a.case", "-vtu", 0]
    of = told(snippet(tmp_path, text, *files, "-order", order, "-out", tmp_path / "out"))
    np.testing.assert_allclose(of["with"], of["of"], rtol=1e-12)
    assert abs(of["rolled"][0]) < 1e-10
    found = json.loads((tmp_path / "out/summary.json").read_text())
    assert found["estimates"]["loads"][0]["name"] == "weight disc"
    greatest = np.sqrt(found["force"] * 1000 / (1 - 0.3**2) / np.pi)
    assert of["lack"][0] == pytest.approx(1.5 * max(greatest - found["pressureMax"], 0), rel=1e-4)
    assert of["lack"][0] > 0 or order == 2


def test_fields_on_sides(tmp_path):
    """Strains and values of a linear field at round sides, whose places the field x tells; what splines are off."""
    (tmp_path / "a.msh").write_text(fit(12))
    (tmp_path / "a.case").write_text(RINGS + "contact bore pin\n")
    text = (ROOT / "edp/parts.edp").read_text() + FIELDS
    of = told(snippet(tmp_path, text, "-mesh", "a.msh", "-case", "a.case", "-order", 2, "-vtu", 0))
    x, y = of["x0"], of["y0"]
    radius = np.hypot(x, y)
    assert len(x) == 4 * 12 * 4 and min(abs(radius[:, None] - [7, 10, 10.001, 14]).min(axis=1)) < 0.05
    np.testing.assert_allclose(of["strain1"].reshape(-1, 4), np.tile([2.0, 7, 8, 0], (len(x), 1)), atol=1e-12)
    np.testing.assert_allclose(of["x1"], 2 * x + 3 * y, atol=1e-3)
    np.testing.assert_allclose(of["y1"], 5 * x + 7 * y, atol=1e-3)
    turn = 2 * np.pi / 12  # of a circle the fourth derivative is 1/R^3
    np.testing.assert_allclose(of["doubt"][:24], turn**2 * (10 * turn) ** 4 / 384 / 10**3, rtol=1e-3)


BRACKET = data("shape/bracket.geo")
DISC = """
Point(1)={0,0,0,0.5};Point(2)={1,0,0,0.5};Point(3)={0,1,0,0.5};Point(4)={-1,0,0,0.5};Point(5)={0,-1,0,0.12};
Circle(1)={2,1,3};Circle(2)={3,1,4};Circle(3)={4,1,5};Circle(4)={5,1,2};Curve Loop(1)={1:4};Plane Surface(1)={1};
Physical Curve("rim")={3:4};Physical Surface("disc")={1};
"""
HEAVY = "body disc E 1000 nu 0.3\nobstacle rim plane 0 -1 0 1\nweight disc 0 -1\n"


def test_corners(tmp_path):
    """A curve's sides, however few, are no corners; those of a body are, and of a fillet's ends none."""
    case = RINGS + "contact bore pin\n"
    for edges in (5, 12):
        found = sharp(tmp_path, fit(edges), case)
        assert found["corners"] == 0 and found["curved"] == 4 * edges
    found = sharp(tmp_path, block(Mesh()).text(), "body block E 1 nu 0.3\nobstacle top plane 0 3 0 -1\nclamp bottom\n")
    assert found["corners"] == 4 and found["curved"] == 0
    case = "body bracket E 1 nu 0.3\nobstacle foot plane 0 5 0 -1\nclamp wall\n"
    assert sharp(tmp_path, BRACKET, case, "a.geo")["corners"] == 5


def run(folder, mesh, case, *flags, expect=0):
    """summary.json of a run with estimates, the first contact's normal force in it, what was printed."""
    done = part(folder, mesh, case, *flags, expect=expect)
    return done.summary, done.estimates["contacts"][0]["normalForce"], done.stdout


def circle(first, radius, sides, turned=0.0):
    """.geo lines: a circle of four arcs."""
    angles = turned + np.pi / 2 * np.arange(4)
    lines = [
        f"Point({first + k})={{{radius * np.cos(a):.15g},{radius * np.sin(a):.15g},0}};" for k, a in enumerate(angles)
    ]
    lines += [f"Circle({first + k})={{{first + k},1,{first + (k + 1) % 4}}};" for k in range(4)]
    arcs = f"{{{first}:{first + 3}}}"
    return [*lines, f"Curve Loop({first})={arcs};", f"Transfinite Curve {arcs}={sides // 4 + 1};"]


@pytest.fixture(scope="module")
def coarse(tmp_path_factory):
    """A press fit whose free circles have 8 sides: .geo, and the bare mesh of first order."""
    folder = tmp_path_factory.mktemp("coarse")
    lines = [
        "Point(1)={0,0,0};",
        *circle(10, 10, 8),
        *circle(20, 20.002, 80),
        *circle(30, 20, 64),
        *circle(40, 30, 8),
    ]
    lines += ["Plane Surface(1)={20,10};", "Plane Surface(2)={40,30};", 'Physical Surface("inner")={1};']
    lines += ['Physical Surface("outer")={2};', 'Physical Curve("pin")={20:23};', 'Physical Curve("bore")={30:33};']
    (folder / "a.geo").write_text("\n".join(lines) + "\n")
    code, stdout = execute(["gmsh", "-2", "-order", "1", "-format", "msh22", folder / "a.geo", "-o", folder / "a.msh"])
    assert code == 0, stdout
    return {"geo": (folder / "a.geo").read_text(), "msh": (folder / "a.msh").read_text()}


@pytest.mark.parametrize(
    "kind, order, most", cases_of([("msh", 1, 0.4), ("msh", 2, 0.02), ("geo", 2, 0.01)], [("msh", 4, 0.02)])
)
def test_few_sides(tmp_path, coarse, kind, order, most):
    """Of circles of 8 sides the force is within what is said; a geometry is known better than a bare file."""
    _, force, _ = run(tmp_path, coarse[kind], RINGS + "contact bore pin\n", "-order", order)
    truth = lame(10, 20, 30, 0.002)
    assert abs(force["value"] - truth) < force["error"] < most * truth


def test_floor(tmp_path):
    """Where nothing more is known of the curves -accuracy stops, and says so."""
    case = RINGS + "contact bore pin\n"
    summary, force, stdout = run(tmp_path, fit(24), case, "-accuracy", 1e-5, expect=21)
    assert "the first mesh knows its curves no better" in stdout
    assert summary["accuracy"]["meshes"] < 4 and abs(force["value"] - lame()) < max(force["error"], 1e-4 * lame())


@pytest.mark.parametrize("order", [1, 2])
def test_weight(tmp_path, order):
    """What the balance alone tells of a weight is as good as the shape."""
    summary, force, _ = run(tmp_path, DISC, HEAVY, "-order", order)
    assert 1e-9 < abs(force["value"] - np.pi) < force["error"] < (0.2 if order == 1 else 1e-3)
    assert not any("sides" in text for text in summary["warnings"])


def test_coarse_weight(tmp_path):
    """Sides that make a tenth of a number are said, with a size within ten times the error; the error has it too."""
    summary, force, _ = run(tmp_path, DISC + "Transfinite Curve{1:4} = 2;", HEAVY, "-order", 1)
    assert abs(force["value"] - np.pi) < force["error"]
    (share,) = re.findall(
        r"sides stand for curves, and forces and ways may be off by ([\d.]+) %", str(summary["warnings"])
    )
    assert 20 < float(share) < 1000 * abs(force["value"] / np.pi - 1)


def test_geometry_again(tmp_path):
    """With a .geo file new meshes are of the geometry: a disc's weight, and how far it has gone."""
    summary, force, _ = run(tmp_path, DISC, HEAVY, "-accuracy", 1e-3)
    assert summary["accuracy"]["met"] and summary["accuracy"]["meshes"] > 1
    assert abs(force["value"] - np.pi) < force["error"] < 1e-3 * np.pi


def test_slices(tmp_path):
    """Any number of elements round a node beside a boundary that is followed: a disc of 12 slices."""
    angles = 2 * np.pi * np.arange(12) / 12
    mesh = Mesh()
    sides = [("rim", (1 + j, 1 + (j + 1) % 12)) for j in range(12)]
    slices = [("disc", (0, 1 + j, 1 + (j + 1) % 12)) for j in range(12)]
    mesh.add([(0, 0, 0), *((np.cos(a), np.sin(a), 0) for a in angles)], sides, slices)
    _, force, _ = run(tmp_path, mesh.text(), HEAVY, "-order", 2)
    assert abs(force["value"] - np.pi) < force["error"] < 0.05


DOME = """SetFactory("OpenCASCADE"); Sphere(1) = {0, 0, 0, 1}; Box(2) = {-2, -2, -2, 4, 4, 2};
dome() = BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; };
faces() = Boundary{ Volume{1}; };
Physical Volume("dome") = {1}; Physical Surface("cap") = {faces(0)}; Physical Surface("base") = {faces(1)};
MeshSize{:} = 0.5;
"""
PRESSED_TWICE = """body dome E 1000 nu 0.3
clamp base
obstacle cap plane 0 0 1 0 0 -1 move 0 0 -0.1
obstacle cap plane 0.6 0 0.8 -0.6 0 -0.8 move -0.06 0 -0.08
"""
EQUAL_VALUES = """include "parts-3d.edp"
real[int] before = goalGeometryError(0 : goals - 1);
real first = goalValue[0];
for (int j = 0; j < goals; j++) goalValue[j] = first;
estimateAllGoals();
real[int] after = goalGeometryError(0 : goals - 1);
tell("before", before);
tell("after", after);
"""


def test_results_of_equal_value(tmp_path):
    """In space each result shall keep its own part by the shape, if several have the same value too."""
    (tmp_path / "a.geo").write_text(DOME)
    (tmp_path / "a.case").write_text(PRESSED_TWICE)
    files = ["-mesh", "a.geo", "-case", "a.case", "-vtu", 0, "-out", tmp_path / "out"]
    of = told(snippet(tmp_path, EQUAL_VALUES, *files, "-order", 1))
    np.testing.assert_allclose(of["after"], of["before"], rtol=1e-9)
    assert of["before"][0] > 1.2 * of["before"][1] > 0


SECTOR = """body inner E 210000 nu 0
body outer E 210000 nu 0
contact outof hole
symmetry foot
symmetry end
pressure {} 100
"""


@pytest.mark.parametrize("pressed, exact", [("rim", 1), ("bore", 0.5)])
def test_pressed_sector(tmp_path, pressed, exact):
    """Flat sides change a pressure's work on the displacement; symmetries at any angle cancel a resultant."""
    summary, _, _ = run(tmp_path, data("shape/sector.geo"), SECTOR.format(pressed), "-order", 1)
    way, force = summary["estimates"]["loads"][0]["way"], summary["estimates"]["contacts"][0]["force"]
    exact *= 100 / 210000 * (1 + 0.25) / (1 - 0.25)
    assert abs(way["value"] - exact) < way["error"] < 2.5 * abs(way["value"] - exact)
    contact = summary["contacts"][0]
    assert np.linalg.norm(contact["force"]) < 1e-12 * contact["normalForce"] and force["error"] < 1e-9
