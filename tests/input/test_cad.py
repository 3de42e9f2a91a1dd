"""Parts from CAD: bodies cut for a bolt, joined bodies, the table of faces, one surface in several contacts."""

import ast
import os
import re
import subprocess

import numpy as np
import pytest
from freefem import FREEFEM, ROOT, cases_of, execute, part

from input.test_parts import Mesh, cube
from input.test_zoo import gmsh, measure, readable
from postprocess import style
from postprocess.geometry_faces import draw

OCC = 'SetFactory("OpenCASCADE");\n'
TURN = np.array([1.0, 2.0, 3.0]) / np.sqrt(14)
PLACES = ["turned", "mirrored"]


def matrix(placed):
    """What a place does to directions."""
    if placed == "turned":
        a, angle = TURN, 0.7
        cross = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
        return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    if placed == "mirrored":
        return np.eye(3) - 2 * np.outer(TURN, TURN)
    return np.eye(3)


def moved(geo, placed):
    """A geometry in space, turned about the origin or mirrored in a plane through it."""
    every = "Volume{:};"
    if placed == "turned":
        return f"{geo}Rotate{{ {{1, 2, 3}}, {{0, 0, 0}}, 0.7 }}{{ {every} }}\n"
    if placed == "mirrored":
        return f"{geo}Symmetry {{1, 2, 3, 0}} {{ {every} }}\n"
    return geo


def numbers(vector):
    return " ".join(f"{each:.15g}" for each in vector)


def placed_plane(at, normal, placed):
    """ "plane x y z nx ny nz" of a plane of the drawing."""
    return f"plane {numbers(matrix(placed) @ at)} {numbers(matrix(placed) @ normal)}"


# ---------------------------------------------------------------- a bolt out of a STEP file: cut, part, contact

BOLT = OCC + "".join(
    f"Box({k}) = {{{box}}};\n"
    for k, box in enumerate(
        ("-1, 0, 0, 2, 1, 10", "-3, 0, 10, 6, 1, 1", "-3, 0, 0, 1.5, 1, 10", "1.5, 0, 0, 1.5, 1, 10"), 1
    )
)
SHANK, SLEEVE = 1000 * 2 / 10, 500 * 3 / 10  # stiffnesses
BODIES = "body shank E 1000 nu 0\nbody head E 1e9 nu 0\nbody sleeve E 500 nu 0\n"
SIZES = "size shank 1.2\nsize head 1.2\nsize sleeve 1.2\n"
GROUPS = "group shank volumes 1\ngroup head volumes 2\ngroup sleeve volumes 3 4\n"
JOINS = "join shank head part\njoin sleeve head contact\n"


def bolt_case(placed):
    foot, top = (placed_plane(*plane, placed) for plane in (([0, 0, 0], [0, 0, 1]), ([0, 0, 11], [0, 0, 1])))
    cut = placed_plane([0.3, 0, 5], [0, 0, 2], placed)
    loads = f"clamp foot\ncut waist shank {cut}\npreload waist 40\ntraction top {numbers(matrix(placed) @ [0, 0, 3])}\n"
    return f"{GROUPS}group foot {foot}\ngroup top {top}\n{SIZES}{BODIES}{JOINS}{loads}"


@pytest.mark.parametrize("placed", PLACES)
def test_bolt(placed, tmp_path):
    """The joint diagram of a bolt whose STEP file has neither a cut nor a shared face; nu is 0, the head is rigid."""
    mesh = gmsh(tmp_path, "part.step", moved(BOLT, placed), "-0")
    done = part(tmp_path, mesh, bolt_case(placed), "-estimate", 0, space=True)
    preload = done.summary["preloads"][0]
    assert preload["force"] == pytest.approx(40 + 18 * SHANK / (SHANK + SLEEVE), rel=1e-5)
    assert preload["shortened"] == pytest.approx(40 / SHANK + 40 / SLEEVE, rel=1e-4)
    seat = done.contacts[0]
    assert (seat["slave"], seat["master"]) == ("sleeve-head", "head-sleeve")
    assert seat["normalForce"] == pytest.approx(40 - 18 * SLEEVE / (SHANK + SLEEVE), rel=1e-5)
    assert done.summary["warnings"] == []


FLAT = OCC + "Rectangle(1) = {0, 0, 0, 1, 10}; Rectangle(2) = {0, 10, 0, 3, 2}; Rectangle(3) = {1.5, 0, 0, 1.5, 10};\n"
FLAT_CASE = """state stress
group shank surfaces 1
group head surfaces 2
group sleeve surfaces 3
group foot plane 0 0 0 1
group axis plane 0 0 1 0
group top plane 0 12 0 1
size shank 0.7
body shank E 1000 nu 0
body head E 1e9 nu 0
body sleeve E 500 nu 0
join shank head part
join sleeve head contact
symmetry foot
symmetry axis
cut waist shank plane 0.3 5 0 1
preload waist 20
traction top 0 3
line up 0.4 0 0.4 9
"""


@pytest.mark.parametrize("file", cases_of(["part.step"], ["part.step", "part.brep", "part.geo"]))
def test_bolt_in_the_plane(file, tmp_path):
    """The same in the plane, out of each kind of geometry."""
    mesh = gmsh(tmp_path, file, FLAT, "-0") if file != "part.geo" else tmp_path / file
    if file == "part.geo":
        mesh.write_text(FLAT)
    done = part(tmp_path, mesh, FLAT_CASE, "-estimate", 0)
    assert re.search("^  body +sleeve: .*; held by symmetry foot; free: along x", done.stdout, re.M)  # of two bodies
    assert re.search("^  body +head.shank: .*; held by symmetry foot, symmetry axis$", done.stdout, re.M)
    found = done.summary
    assert found["preloads"][0]["force"] == pytest.approx(20 + 9 * 100 / 175, rel=1e-5)
    assert found["contacts"][0]["normalForce"] == pytest.approx(20 - 9 * 75 / 175, rel=1e-5)
    line = np.genfromtxt(tmp_path / "out/line-up.csv", delimiter=",", names=True)
    behind = line["y"] > 5.001  # beyond the cut the shank lacks its shortening
    straight = found["preloads"][0]["force"] / 1000 * line["y"] - behind * found["preloads"][0]["shortened"]
    assert line["uy"] == pytest.approx(straight, abs=1e-6)


# two flanges that touch at their outer rings, and a bolt through them: they bend
FLANGES = (
    OCC
    + """Rectangle(1) = {0, -12, 0, 5, 24}; Rectangle(2) = {0, 12, 0, 8, 6}; Rectangle(3) = {0, -18, 0, 8, 6};
BooleanUnion(4) = { Surface{1}; Delete; }{ Surface{2, 3}; Delete; };
Rectangle(5) = {5.5, 1, 0, 44.5, 11}; Rectangle(6) = {40, 0, 0, 10, 1};
BooleanUnion(7) = { Surface{5}; Delete; }{ Surface{6}; Delete; };
Rectangle(8) = {5.5, -12, 0, 46.5, 11}; Rectangle(9) = {40, -1, 0, 9, 1};
BooleanUnion(10) = { Surface{8}; Delete; }{ Surface{9}; Delete; };
"""
)
FLANGES_CASE = """state axisymmetric
group bolt surfaces 4
group upper surfaces 7
group lower surfaces 10
group axis plane 0 0 1 0
group side plane 50 0 1 0
group foot plane 52 0 1 0
size bolt 3
size upper 4
size lower 4
body bolt E 210e3 nu 0.3
body upper E 210e3 nu 0.3
body lower E 210e3 nu 0.3
join upper lower contact
join bolt upper contact
join bolt lower contact
cut waist bolt plane 0 1 0 1
preload waist 10e3
clamp foot
traction side 0 1
"""


def test_flanges_that_bend(tmp_path):
    """They give way far more than the model of the start, whose forces would leave all open."""
    pull = 12 * 2 * np.pi * 50
    flags = ("-estimate", 0, "-start")
    runs = {how: part(tmp_path / how, FLANGES, FLANGES_CASE, *flags, how) for how in ("kernel", "none")}
    for run in runs.values():
        force = {each["slave"]: each["normalForce"] for each in run.contacts}
        assert force["bolt-upper"] - force["upper-lower"] == pytest.approx(pull, rel=1e-6)
        assert force["bolt-upper"] == pytest.approx(force["bolt-lower"], rel=1e-6)
    first, other = (run.summary["preloads"][0]["force"] for run in runs.values())
    assert first == pytest.approx(other, rel=1e-6)
    # the start is left where it opens all, which rounding may decide: the first shortening takes no longer with it
    kernel, none = (run.history[: np.argmax(run.history["residual"] < 1e-6) + 1] for run in runs.values())
    assert 3 < len(kernel) <= len(none) and kernel["force"][-1] == pytest.approx(none["force"][-1], rel=1e-6)


HEAD_IN_SPACE = (
    OCC
    + """Cylinder(1) = {0, 0, 4, 0, 0, 3, 8, Pi/2}; Cylinder(2) = {0, 0, 4, 0, 0, 3, 5, Pi/2};
BooleanDifference(5) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(3) = {0, 0, 0, 0, 0, 4, 12, Pi/2}; Cylinder(4) = {0, 0, 0, 0, 0, 4, 5.5, Pi/2};
BooleanDifference(6) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
"""
)
HEAD_CASE = """group head volumes 5
group plate volumes 6
group high plane 0 0 7 0 0 1
group low plane 0 0 0 0 0 1
group left plane 0 0 0 1 0 0
group front plane 0 0 0 0 1 0
size head 0.8
size plate 0.8
body head E 1000 nu 0.3
body plate E 1000 nu 0.3
join SLAVE contact
clamp low
move high 0 0 -0.05
symmetry left
symmetry front
"""
HEAD_IN_PLANE = OCC + "Rectangle(1) = {5, 4, 0, 3, 3}; Rectangle(2) = {5.5, 0, 0, 6.5, 4};\n"
HEAD_SECTION = """state axisymmetric
group head surfaces 1
group plate surfaces 2
group high plane 0 7 0 1
group low plane 0 0 0 1
size head 0.1
size plate 0.1
body head E 1000 nu 0.3
body plate E 1000 nu 0.3
join head plate contact
clamp low
move high 0 -0.05
"""


@pytest.mark.parametrize("order, slave", [(1, "head plate"), (2, "head plate"), (2, "plate head")])
def test_head_over_a_hole(order, slave, tmp_path):
    """The slave reaches over the master's rims: it carries nothing there, and beside them what a fine section does."""
    ring = part(tmp_path / "plane", HEAD_IN_PLANE, HEAD_SECTION, "-estimate", 0)
    case = HEAD_CASE.replace("SLAVE", slave)
    run = part(tmp_path / "space", HEAD_IN_SPACE, case, "-order", order, space=True)
    assert 4 * run.contacts[0]["normalForce"] == pytest.approx(ring.contacts[0]["normalForce"], rel=0.06 / order**2)
    told = run.summary["estimates"]["contacts"][0]["normalForce"]
    assert 4 * told["value"] == pytest.approx(ring.contacts[0]["normalForce"], abs=4 * told["error"])
    assert told["error"] < 0.3 * told["value"]
    at = run.contact
    away = np.hypot(at["x"], at["y"])
    beyond = (away < 5.4) | (away > 8.05)
    assert beyond.sum() > 10 and np.all(at["pressure"][beyond] == 0)
    assert 4 * at["weight"].sum() == pytest.approx(np.pi * (8**2 - 5.5**2), rel=0.01)

    def mean(points, distance):
        near = (distance > 5.4) & (distance < 6.25)
        return np.average(points["pressure"][near], weights=points["weight"][near])

    assert mean(at, away) == pytest.approx(mean(ring.contact, ring.contact["x"]), rel=0.15)
    assert at["pressure"].max() < 3 * np.average(at["pressure"], weights=at["weight"])


RIMS = [(8, 2, 0.13, False), (8, 2, 0.16, True)]
FINER = [(12, 1, 0.35, False), (18, 2, 0.05, False), (12, 2, 0.16, True)]


@pytest.mark.parametrize("cells, order, most, compliant", cases_of(RIMS, RIMS + FINER))
def test_error_at_a_rim(tmp_path, cells, order, most, compliant):
    """A punch on a larger block, which is the slave: rims cut its triangles. Finer meshes have a limit."""
    mesh = cube(Mesh(), (4, 4, 2), (cells, cells, cells // 2))
    cube(mesh, (1.3, 1.1, 1), (cells // 3,) * 3, (1.21, 1.37, 2), "p ", "punch")
    case = 'body block E 1000 nu 0.3\nbody punch E 3000 nu 0.3\nclamp bottom\nmove "p top" 0 0 -1e-4\n'
    case += 'contact top "p bottom"' + " law power kappa 1e8 m 2 d0 -1e-9\n" * compliant
    run = part(tmp_path, mesh.text(), case, "-order", order, space=True)
    told = run.summary["estimates"]["contacts"][0]["normalForce"]
    assert abs(told["value"] - (0.0993 if compliant else 0.1365)) < told["error"] < most * told["value"]


def marks(folder):
    """{group: places of its vertices} of the cuts that the reader found."""
    lines = (folder / "case").read_text().splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("groups "))
    names = [line[2:] for line in lines[first + 1 : first + 1 + int(lines[first].split()[1])]]
    rows = (folder / "mesh.msh").read_text().splitlines()
    nodes = rows.index("$Nodes") + 2
    lines = (folder / "regions").read_text().splitlines()
    at = next(k for k, line in enumerate(lines) if line.startswith("cuts "))
    found = {}
    for line in lines[at + 1 :]:
        group, node = map(int, line.split())
        found.setdefault(names[group - 1], []).append(1e-6 * np.array(rows[nodes + node].split()[1:], float))
    return {name: np.array(places) for name, places in found.items()}


def copied(folder, mesh, case, space=1, how="solve"):
    """(exit code, what is wrong, the reader's folder); the caller removes the folder."""
    out = folder / "copy"
    if case is not None:
        (folder / "a.case").write_text(case)
    given = [str(os.getpid()), mesh, out, "none" if case is None else folder / "a.case", str(space), how, ""]
    done = subprocess.run(["sh", "edp/input/read-case.sh", *given], cwd=ROOT, env={**os.environ, "LC_ALL": "C"})
    return done.returncode, (out / "why").read_text().strip() if (out / "why").exists() else "", out


def removed(out):
    subprocess.run(["rm", "-r", out], check=True)


@pytest.mark.parametrize("placed", cases_of(["turned"], PLACES))
def test_two_cuts(placed, tmp_path):
    """Two through one body, one aslant: each is all of the section, in its plane, and faces keep their numbers."""
    mesh = gmsh(tmp_path, "part.step", moved(BOLT, placed), "-0")
    case = GROUPS + "group side faces 3\nsize shank 1.5\n" + BODIES + JOINS + "clamp side\n"
    for name, at, normal in (("waist", [0, 0, 5], [0, 0, 1]), ("slope", [0, 0, 8], [0.3, 0, 1])):
        case += f"cut {name} shank {placed_plane(at, normal, placed)}\npreload {name} 1\n"
    code, why, out = copied(tmp_path, mesh, case)
    assert code == 0, why
    found = {name: places @ matrix(placed) for name, places in marks(out).items()}
    areas, volumes = measure(out, 1)
    removed(out)
    assert np.abs(found["waist"][:, 2] - 5).max() < 1e-6
    assert np.abs(found["slope"] @ [0.3, 0, 1] - 8).max() < 1e-6
    for places in found.values():
        assert np.ptp(places[:, :2], axis=0) == pytest.approx([2, 1], abs=1e-6)
    assert sum(volumes) == pytest.approx(20 + 6 + 30) and areas["side"] == pytest.approx(20)


def test_names_of_the_file(tmp_path):
    """A .geo file's own names stay where its bodies are cut, and so do faces that two of its bodies share."""
    names = 'Physical Volume("shank") = {1}; Physical Volume("sleeve") = {3, 4}; Physical Volume("head") = {2};\n'
    names += 'foot() = Surface In BoundingBox {-4, -1, -0.1, 4, 2, 0.1}; Physical Surface("foot") = foot();\n'
    geo = BOLT + "BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }\nMesh.MeshSizeMax = 2;\n" + names
    (tmp_path / "a.geo").write_text(geo)
    case = BODIES + "clamp foot\ngroup top plane 0 0 11 0 0 1\nobstacle top plane 0 0 12 0 0 -1\n"
    case += "cut waist shank plane 0 0 5 0 0 1\npreload waist 1\n"
    code, why, areas, volumes = readable(tmp_path, tmp_path / "a.geo", case)
    assert code == 0, why
    assert areas == pytest.approx({"foot": 5, "top": 6}) and sorted(volumes) == pytest.approx([6, 15, 15, 20])


GRID = """Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 6, 0}; Point(4) = {0, 6, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1, 3} = 3; Transfinite Curve{2, 4} = 7; Transfinite Surface{1};
Physical Surface("bar") = {1}; Physical Curve("low") = {1}; Physical Curve("high") = {3};
"""
ON_GRID = "body bar E 1 nu 0.3\nclamp low\nobstacle high plane 0 7 0 -1\ncut waist bar plane {}\npreload waist 1\n"


def test_cut_of_a_mesh(tmp_path):
    """A finished mesh is cut where it has a layer of sides in the plane; elsewhere that is refused, with the reason."""
    mesh = gmsh(tmp_path, "a.msh", GRID, "-2", "-format", "msh22")
    code, why, out = copied(tmp_path, mesh, ON_GRID.format("9 2 0 -1"), space=0)
    assert code == 0, why
    assert sorted(map(tuple, marks(out)["waist"].round(9))) == [(0, 2, 0), (1, 2, 0), (2, 2, 0)]
    removed(out)
    for plane, said in (
        ("0 2.5 0 1", "the plane goes through 4 elements"),
        ("0 0 0 1", "the plane does not cross"),
        ("0 7 0 1", 'the plane does not cross "bar", which lies from -7 to -1 along the normal'),
    ):
        code, why, *_ = readable(tmp_path, mesh, ON_GRID.format(plane), space=0)
        assert code == 1 and said in why and "allowed: " in why, why


# ---------------------------------------------------------------- two bodies that touch

STACK = OCC + "Box(1) = {0, 0, 0, 1, 1, 3}; Box(2) = {0, 0, 3, 1, 1, 2};\n"
STACKED = """group low volumes 1
group high volumes 2
group foot plane 0 0 0 0 0 1
group top plane 0 0 5 0 0 1
group side plane 0 0 0 1 0 0
size low 1
size high 1
body low E 100 nu 0
body high E 300 nu 0
clamp foot
obstacle side plane -1 0 0 1 0 0
"""


@pytest.mark.parametrize("how, pull", [("part", 3), *(x for x in (("tie", 3), ("contact", -3)))])
def test_joined(how, pull, tmp_path):
    """Two bars on each other: their mean displacements under a pull, or where they may part under a push."""
    mesh = gmsh(tmp_path, "part.step", STACK, "-0")
    case = STACKED + f"traction top 0 0 {pull}\njoin high low {how}\n"
    found = part(tmp_path, mesh, case, "-estimate", 0, space=True).summary
    low, high = pull / 100 * 3 / 2, pull / 100 * 3 + pull / 300 * 2 / 2
    means = {body["name"]: body["motion"][2] for body in found["bodies"]}
    expected = {"low+high": 0.6 * low + 0.4 * high} if how == "part" else {"low": low, "high": high}
    assert means == pytest.approx(expected, rel=1e-5)
    assert not [each for each in found["warnings"] if "bodies touch" in each]


def test_nothing_said(tmp_path):
    """Bodies that touch without a statement are named, with the statement to write; bodies at a distance are not."""
    case = STACKED + "traction side 0 0 1\nobstacle top plane 0 0 6 0 0 -1\n"
    for gap, lines in (("3", 1), ("3.00001", 1), ("3.001", 0)):
        mesh = gmsh(tmp_path, "part.step", STACK.replace("0, 0, 3, 1", f"0, 0, {gap}, 1"), "-0")
        code, why, out = copied(tmp_path, mesh, case.replace("0 0 5 ", f"0 0 {2 + float(gap)} "))
        assert code == 0, why
        told = (out / "told").read_text().splitlines()[4:]
        removed(out)
        assert len(told) == 1 + (gap == "3"), (gap, lines)
        if gap == "3":
            assert told[1] == (
                "low and high (faces 6 on 11), and no statement says what happens there: "
                "write join low high part, tie or contact"
            )


NEIGHBOURS = {  # boxes on the first one's top, and whether they touch it
    "0.2, 0.2, 3, 0.1, 0.1, 1": True,
    "-5, -5, 3, 20, 20, 1": True,
    "0.9, 0.9, 3, 1, 1, 1": True,
    "1.1, 0, 3, 1, 1, 1": False,
    "1, 0, 3, 1, 1, 1": False,
    "0, 0, 3.01, 1, 1, 1": False,
}


@pytest.mark.parametrize("box", cases_of(list(NEIGHBOURS)[1:4], NEIGHBOURS))
def test_who_touches(box, tmp_path):
    """A small face on a large one, a corner of both, an edge alone, a gap."""
    mesh = gmsh(tmp_path, "part.step", OCC + f"Box(1) = {{0, 0, 0, 1, 1, 3}}; Box(2) = {{{box}}};\n", "-0")
    assert ("volumes 1 and 2 touch (faces 6 on 11)" in table(tmp_path, mesh)) == NEIGHBOURS[box]


# ---------------------------------------------------------------- the table of faces


def table(folder, mesh, space=1):
    """What -check 1 tells of a geometry."""
    code, why, out = copied(folder, mesh, None, space, "check")
    assert code == 4, why
    text = (out / "table").read_text()
    removed(out)
    return text


def rows(text):
    """{number: (kind, middle, way, radius, area, whose)} of a table."""
    found = {}
    for line in text.splitlines():
        if re.match(r" *\d+  [a-z]", line):
            cells = [line[:6], line[8:23], line[24:54], line[55:85], line[86:96], line[97:107], line[109:]]
            vector = [np.array(cell.split(), float) if cell.strip() != "-" else None for cell in cells[2:4]]
            radius = None if cells[4].strip() == "-" else float(cells[4])
            found[int(cells[0])] = (cells[1].strip(), *vector, radius, float(cells[5]), cells[6].strip())
    return found


SHAPES = (
    OCC
    + """Box(1) = {0, 0, 0, 4, 4, 2}; Cylinder(2) = {2, 2, -1, 0, 0, 4, 0.7};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Cone(5) = {10, 0, 0, 0, 3, 0, 2, 1}; Sphere(6) = {0, 10, 0, 1.5}; Torus(7) = {0, 20, 0, 3, 1};
"""
)


@pytest.mark.parametrize("placed", cases_of(["turned"], PLACES))
def test_kinds(placed, tmp_path):
    """Kind, place, direction, radius and area of each face against its drawing, as it lies and moved."""
    found = rows(table(tmp_path, gmsh(tmp_path, "part.step", moved(SHAPES, placed), "-0")))
    turn = matrix(placed)
    kinds = sorted(row[0] for row in found.values())
    slope = np.degrees(np.arctan(1 / 3))
    assert kinds == sorted(["plane"] * 8 + ["cylinder hollow", f"cone {slope:.4g} deg", "sphere", "other"])
    of = {row[0].split()[0]: row for row in found.values()}
    _, at, way, radius, area, whose = of["cylinder"]
    assert at == pytest.approx(turn @ [2, 2, 1], abs=1e-5) and abs(way @ turn @ [0, 0, 1]) == pytest.approx(1)
    assert radius == pytest.approx(0.7) and area == pytest.approx(2 * np.pi * 0.7 * 2, rel=1e-3) and whose == "1"
    _, at, way, radius, area, _ = of["cone"]
    height = (turn.T @ at)[1]  # beside the middle of its area
    assert turn.T @ at == pytest.approx([10, height, 0], abs=1e-5) and abs(way @ turn @ [0, 1, 0]) == pytest.approx(1)
    assert height == pytest.approx(4 / 3, rel=1e-3) and radius == pytest.approx(2 - height / 3, rel=1e-4)
    assert area == pytest.approx(np.pi * 3 * np.sqrt(10), rel=1e-3)
    _, at, _, radius, area, _ = of["sphere"]
    assert at == pytest.approx(turn @ [0, 10, 0], abs=1e-5) and radius == pytest.approx(1.5)
    assert area == pytest.approx(9 * np.pi, rel=1e-3)
    assert of["other"][4] == pytest.approx(12 * np.pi**2, rel=1e-3)
    planes = [(turn.T @ row[1], turn.T @ row[2], row[4]) for row in found.values() if row[0] == "plane"]
    for at, way, _ in planes:  # outwards: away from the middle of its body
        middle = np.array([2, 2, 1]) if at[0] < 5 else np.array([10, 1.5, 0])
        assert way @ (at - middle) > 0.5 and np.abs(way).max() == pytest.approx(1, abs=1e-5)
    assert sorted(area for *_, area in planes) == pytest.approx(
        sorted([8] * 4 + [16 - 0.49 * np.pi] * 2 + [np.pi, 4 * np.pi]), rel=1e-3
    )


def test_curves(tmp_path):
    """In the plane: lines with normals outwards, a circle, a hole."""
    flat = OCC + "Rectangle(1) = {0, 0, 0, 4, 2}; Disk(2) = {2, 1, 0, 0.5}; Disk(3) = {9, 0, 0, 1.5};\n"
    flat += "BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }\n"
    found = list(rows(table(tmp_path, gmsh(tmp_path, "part.step", flat, "-0"), 0)).values())
    assert sorted(row[0] for row in found) == ["circle", "circle hole", *["line"] * 4]
    for kind, at, way, radius, length, _ in found:
        if kind == "line":
            assert way @ (at - [2, 1]) > 0.9 and length == pytest.approx(2 * abs(way[0]) + 4 * abs(way[1]))
        else:
            expected = ([2, 1], 0.5) if kind == "circle hole" else ([9, 0], 1.5)
            assert at == pytest.approx(expected[0], abs=1e-5) and radius == pytest.approx(expected[1])
            assert length == pytest.approx(2 * np.pi * radius, rel=1e-3)


@pytest.mark.parametrize("radius", [1, 0.999])
def test_disc_in_a_hole(radius, tmp_path):
    """A disc touches the hole that it fills, and not one that is larger by a thousandth."""
    flat = OCC + f"Rectangle(1) = {{-2, -2, 0, 4, 4}}; Disk(2) = {{0, 0, 0, 1}}; Disk(3) = {{0, 0, 0, {radius}}};\n"
    flat += "BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }\n"
    said = table(tmp_path, gmsh(tmp_path, "part.step", flat, "-0"), 0)
    assert ("touch (curves" in said) == (radius == 1)


FLUSH = """Box(1) = {0, 0, 0, 4, 4, 2}; Cylinder(2) = {2, 2, -1, 0, 0, 4, 1};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {2, 2, 0, 0, 0, 3, 1}; Cylinder(5) = {2, 2, 2.5, 0, 0, 1.5, 1}; Sphere(6) = {8, 8, 8, 1};
MeshSize{:} = 0.8;
"""


def test_flush(tmp_path):
    """Faces with one outward normal, in a plane or on a cylinder, are no neighbours; a coarse sphere has its area."""
    geo = tmp_path / "flush.geo"
    geo.write_text(OCC + FLUSH)
    said = table(tmp_path, geo)
    pairs = sorted(re.findall(r"touch \(faces (.*)\)", said))
    of = {row[0].split()[0] + f" of {row[5].split(';')[0]}": row for row in rows(said).values()}
    assert len(pairs) == 1 and pairs[0].count(" on ") == 1, pairs
    assert of["sphere of 6"][4] == pytest.approx(4 * np.pi, rel=4e-4)
    assert "; on" in of["cylinder of 4"][5] and "; on" not in of["cylinder of 5"][5]


def test_part_of_two_materials(tmp_path):
    """Strains jump between bodies that share nodes, recovery keeps the jump: P2 is exact here, and ± says so."""
    mesh = gmsh(tmp_path, "part.step", STACK, "-0")
    case = STACKED.replace("E 300", "E 3e5") + "traction top 0 0 3\njoin high low part\n"
    case = case.replace("side plane -1 0 0 1 0 0", "top plane 0 0 5.01 0 0 -1")
    found = part(tmp_path, mesh, case, space=True).summary
    left = 3 - 0.01 / (3 / 100 + 2 / 3e5)
    (contact,) = found["estimates"]["contacts"]
    assert contact["normalForce"]["value"] == pytest.approx(left, rel=1e-6)
    assert contact["normalForce"]["error"] < 1e-4 * left


FITTED = (
    OCC
    + """Cylinder(1) = {0, 0, 0, 0, 0, 4, RADIUS}; Box(2) = {-3, -3, 0, 6, 6, 2}; Cylinder(12) = {0, 0, -1, 0, 0, 9, 1};
BooleanDifference{ Volume{2}; Delete; }{ Volume{12}; }
Box(3) = {-3, -3, 2, 6, 6, 2}; BooleanDifference{ Volume{3}; Delete; }{ Volume{12}; Delete; }
"""
)


def test_pin_in_two_plates(tmp_path):
    """A pin that fits touches both plates, one that is thinner neither; the picture shows what is inside."""
    pairs = {}
    for radius in ("1", "0.999"):
        mesh = gmsh(tmp_path, "part.step", FITTED.replace("RADIUS", radius), "-0")
        if radius == "1":
            code, said = execute([*FREEFEM, "edp/parts-3d.edp", "-mesh", mesh, "-check", 1, "-out", tmp_path / radius])
            assert code == 0
        else:
            said = table(tmp_path, mesh)
        pairs[radius] = re.findall(r"volumes (\d and \d) touch \(faces ([^)]*)\)", said)
        assert ("  join V1 V2 tie" in said or "  join V2 V1 tie" in said) == (radius == "1")
    assert [pair for pair, _ in pairs["1"]] == ["1 and 2", "1 and 3", "2 and 3"]
    assert [pair for pair, _ in pairs["0.999"]] == ["2 and 3"]
    with style.look():
        figure = draw(tmp_path / "1/check/check-faces.csv", -60, 25)
    outside, inside = figure.axes[:2], figure.axes[2]
    labels = {word for axes in outside for text in axes.texts for word in text.get_text().split(", ")}
    hidden = {word for text in inside.texts for word in text.get_text().split(", ")}
    faces = {word for _, words in pairs["1"] for word in re.findall(r"\d+", words)}
    assert hidden == faces and not labels & hidden and len(labels | hidden) == 17


# ---------------------------------------------------------------- one surface in several contacts

DISC = OCC + "Rectangle(1) = {-2, -2, 0, 4, 1}; Disk(2) = {0, 0, 0, 1}; Rectangle(3) = {-2, 1, 0, 4, 1};\n"
PRESSED = """group low surfaces 1
group disc surfaces 2
group high surfaces 3
group foot plane 0 -2 0 1
group lid plane 0 2 0 1
size disc 0.15
size low 0.5
size high 0.5
body low E 1000 nu 0.3
body disc E 1000 nu 0.3
body high E 2000 nu 0.3
group face between low disc
group roof between high disc
clamp foot
move lid 0 -0.01
"""
RIMS = "group under between disc low\ngroup over between disc high\n"


@pytest.mark.parametrize("order", cases_of(["{1} {0}"], ["{1} {0}", "{0} {1}"]))
def test_one_surface_in_two_contacts(order, tmp_path):
    """`between disc low` and `between disc high` are one circle: as if one group stood in both, with their names."""
    mesh = gmsh(tmp_path, "part.step", DISC, "-0")
    contacts = "".join(f"contact {order}\n".format(*pair) for pair in (("{u}", "face"), ("{o}", "roof")))
    two = part(tmp_path / "two", mesh, PRESSED + RIMS + contacts.format(u="under", o="over"), "-estimate", 0)
    one = part(
        tmp_path / "one", mesh, PRESSED + "group rim curves 5\n" + contacts.format(u="rim", o="rim"), "-estimate", 0
    )
    assert two.contacts[0]["normalForce"] > 1
    for of_two, of_one in zip(two.contacts, one.contacts, strict=True):
        assert of_two["force"] == pytest.approx(of_one["force"], rel=1e-9, abs=1e-9)
        assert of_two["name"] == of_one["name"].replace(
            "rim", {"face": "under", "roof": "over"}[of_one["name"].replace("rim", "").strip()]
        )


@pytest.mark.parametrize(
    "lines, said",
    [
        (
            "contact face under\nclamp over\n",
            'in two physical groups of the case, "under" and "over", which share 42 of their 42 and 42,',
        ),
        ("contact face under\ncontact face over\n", "the same surfaces as in line"),
        ("contact under over\n", "both are the same surface"),
        (
            "group wide curves 5 2\ncontact under face\ncontact wide roof\n",
            "allowed: one of them, or two",
        ),
        ("group wide curves 5 2\ncontact face under\ncontact roof wide\n", None),  # a master of more than is needed
    ],
)
def test_one_surface_refused(lines, said, tmp_path):
    mesh = gmsh(tmp_path, "part.step", DISC, "-0")
    code, why, *_ = readable(tmp_path, mesh, PRESSED + RIMS + lines, 0)
    assert (code == 1 and said in why and "allowed: " in why) if said else code == 0, why


# ---------------------------------------------------------------- refusals

PLATES = """SetFactory("OpenCASCADE"); Mesh.MeshSizeMax = 0.5;
Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {0, 1.1, 0, 1, 1};
Physical Surface("a") = {1}; Physical Surface("b") = {2}; Physical Curve("empty") = {};
Physical Curve("lid") = {3}; Physical Curve("low") = {5}; Physical Curve("foot") = {1}; Physical Curve("top") = {7};
"""
PLATED = "body a E 1 nu 0.3\nbody b E 1 nu 0.3\ncontact lid low friction 0.1\nclamp foot\n"


@pytest.mark.parametrize(
    "lines, said",
    [
        ("size empty 1\n", "line 5: empty: no physical curve of the mesh; allowed: lid low foot top"),
        (
            "move top 0 0\nleg 2\nmove top 0 -0.2\n",
            "line 7: move top in line 5, before the first leg, and again in it; allowed: without",
        ),
        ("move top 0 0\nmove top 0 -0.2\nleg 2\n", "line 6: top: move after move in line 5; allowed: only one"),
        (
            "group both plane 0 1.1 0 1\npressure both 1\n",
            '"both", which share 5 of their 5 and 5, this one at (0, 1.1); allowed: one of them',
        ),
    ],
)
def test_groups_and_phases_refused(lines, said, tmp_path):
    """An empty group, a value before the first phase and in it, sides in two groups: by names, lines and places."""
    run = part(tmp_path, PLATES, PLATED + lines, "-estimate", 0, expect=10)
    assert said in run.stdout


CUT = "cut waist low plane 0 0 1 0 0 1\npreload waist 1\n"
REFUSED = {  # lines in place of the join and the cut, and what is said
    "cut waist low plane 0 0 1 0 0 1\n": "line 12: cut waist: nothing tightens it; allowed: a line preload waist force",
    "cut waist low plane 0 0 4 0 0 1\npreload waist 1\n": "plane does not cross low, which lies from -4 to -1 along",
    "cut waist low plane 0 0 3 0 0 1\npreload waist 1\n": "the plane does not cross low, which lies from -3 to 0 along",
    "cut waist low plane 0 0 1 0 0 0\n": "the normal is 0 in every direction; allowed: cut NAME BODY plane x y z",
    "cut waist low 0 0 1 0 0 1\n": "0: not allowed here; allowed: cut NAME BODY plane x y z nx ny nz, as cut",
    "cut waist lower plane 0 0 1 0 0 1\n": "lower: no body of the geometry has this name",
    "cut top low plane 0 0 1 0 0 1\n": "a cut or a join has a group of this name",
    "join low high\n": "how they are joined is missing after high; allowed: join BODY BODY part, tie or contact",
    "join low high parts\n": "parts: unknown; did you mean part? allowed: join BODY BODY part, tie or contact",
    "join low low part\n": "low: twice the same body; allowed: two bodies",
    "join low high part\njoin high low part\n": "join of high and low: stated before, in line 12; allowed: once",
    "join low high part 3\n": "3: more than the statement takes; allowed: join BODY BODY",
    "join low high contact fricton 3\n": "fricton: not allowed here; allowed: contact SLAVE MASTER",
    "join low high tie\n": "tie: read by parts.edp and parts-3d.edp alone",
}


@pytest.mark.parametrize("lines", cases_of(list(REFUSED)[::4], REFUSED))
def test_refused(lines, tmp_path_factory):
    folder = tmp_path_factory.mktemp("refused")
    mesh = gmsh(folder, "part.step", STACK, "-0")
    code, why, *_ = readable(folder, mesh, STACKED + lines)
    assert code == 3 and REFUSED[lines] in why and "allowed" in why, why


@pytest.mark.parametrize(
    "height, how, said",
    [
        (
            "3.1",
            "part",
            "join low high part: they share no face, there is a gap between them; allowed: bodies that touch, or",
        ),
        (
            "3.1",
            "tie",
            "join low high tie: they touch nowhere, there is a gap between them; allowed: bodies that touch, a",
        ),
        (
            "2.9",
            "part",
            "join low high part: bodies of it overlap; allowed: bodies that touch, or join low high contact",
        ),
    ],
)
def test_joined_at_a_distance(height, how, said, tmp_path):
    mesh = gmsh(tmp_path, "part.step", STACK.replace("0, 0, 3, 1", f"0, 0, {height}, 1"), "-0")
    case = STACKED.replace("0 0 5 ", f"0 0 {2 + float(height)} ") + f"join low high {how}\n"
    code, why, *_ = readable(tmp_path, mesh, case)
    assert code == 3 and said in why, why


@pytest.mark.parametrize(
    "third, said", [("", "bolt and two touch, and joins with other"), ("join bolt two part\n", None)]
)
def test_three_that_touch(third, said, tmp_path):
    """Two joins hang the third pair together: gmsh cannot mesh it, unless it is one part too."""
    three = OCC + "Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {1, 0, 0, 1, 1}; Rectangle(3) = {0, 1, 0, 2, 1};\n"
    mesh = gmsh(tmp_path, "part.step", three, "-0")
    case = "group bolt surfaces 1\ngroup two surfaces 2\ngroup top surfaces 3\ngroup foot plane 0 0 0 1\n"
    case += "".join(f"body {name} E 1 nu 0.3\n" for name in ("bolt", "two", "top")) + "clamp foot\n"
    case += "group lid plane 0 2 0 1\nobstacle lid plane 0 3 0 -1\njoin bolt top part\njoin two top part\n" + third
    code, why, _, volumes = readable(tmp_path, mesh, case, 0)
    assert (code == 3 and said in why) if said else (code == 0 and sum(volumes) == pytest.approx(4)), why


def test_no_shapes(tmp_path):
    """A mesh cannot be joined, a geometry of gmsh's own kernel neither joined nor cut."""
    case = re.sub("size.*\n", "", STACKED) + "join low high part\n"
    mesh = gmsh(tmp_path, "a.msh", STACK, "-3", "-format", "msh41", "-setnumber", "Mesh.MeshSizeMax", 1)
    code, why, *_ = readable(tmp_path, mesh, case)
    assert code == 3 and "part: a mesh cannot be joined; allowed: with a geometry, or join low high tie" in why, why
    (tmp_path / "a.geo").write_text(GRID)
    code, why, *_ = readable(tmp_path, tmp_path / "a.geo", ON_GRID.format("0 2.5 0 1"), 0)
    assert code == 3 and "bodies of it cannot be cut, joined or taken apart" in why and "OpenCASCADE" in why, why


def text_of(node, own):
    """The text of an expression, `…` for values; own: what the names of its function stand for."""
    if isinstance(node, ast.Constant):
        return str(node.value)
    if isinstance(node, ast.JoinedStr):
        return "".join(text_of(part, own) for part in node.values)
    if isinstance(node, ast.FormattedValue):
        return text_of(node.value, own)
    if isinstance(node, ast.BinOp):
        return text_of(node.left, own) + text_of(node.right, own)
    if isinstance(node, ast.IfExp):
        return f"{text_of(node.body, own)}…{text_of(node.orelse, own)}"
    if isinstance(node, ast.Name) and node.id in own:
        return text_of(own.pop(node.id), own)
    return "…"


def named(nodes):
    """What names stand for, by assignments."""
    pairs = [(node.targets[0], node.value) for node in nodes if isinstance(node, ast.Assign)]
    return {target.id: value for target, value in pairs if isinstance(target, ast.Name)}


def refusals(names):
    """What modules of the reader refuse, `…` for values."""
    for name in names:
        module = ast.parse((ROOT / f"edp/input/reader/{name}.py").read_text())
        known = named(module.body)
        for function in (node for node in ast.walk(module) if isinstance(node, ast.FunctionDef)):
            own = known | named(ast.walk(function))
            for call in (node for node in ast.walk(function) if isinstance(node, ast.Call)):
                called = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
                if called in ("no", "refuse", "bent", "Refusal", "GmshError", "MeshRefusal"):
                    yield "…".join(text_of(argument, dict(own)) for argument in call.args)


def test_messages_on_the_page():
    """What the reader refuses about parts from CAD stands on the page of refusals, which has no other."""
    page = (ROOT / "edp/docs/TROUBLESHOOTING.md").read_text().split("## Refused mesh files")[1]
    known = [
        [piece.strip() for piece in pattern.split("…")]
        for line in page.splitlines()
        for pattern in re.findall(r"`([^`]+)`", line.split("|")[1] if "|" in line else "")
    ]
    parts = [text for text in refusals(["picks", "sides"]) if re.search("[a-z]{3}", text)]

    def match(text, pieces):
        return all(piece in text for piece in pieces)

    assert len(parts) > 15
    assert [text for text in parts if not any(match(text, pieces) for pieces in known)] == []
    sources = [ast.parse(path.read_text()) for path in (ROOT / "edp/input/reader").glob("*.py")]
    constants = [node.value for source in sources for node in ast.walk(source) if isinstance(node, ast.Constant)]
    said = [text for text in constants if isinstance(text, str)]
    said += refusals(path.stem for path in (ROOT / "edp/input/reader").glob("*.py"))
    every = [piece.strip(" :,") for pieces in known for piece in pieces]
    assert [piece for piece in every if not any(piece in text for text in said)] == []
