"""Geometries and meshes of any kind: each is taken as it is, or refused in one line; groups and sizes of a case.

The reader, edp/input/read-case.sh, is asked by itself where that tells all; a few are solved.
"""

import os
import re
import subprocess

import numpy as np
import pytest
from freefem import FREEFEM, ROOT, cases_of, data, execute, part, wait_for
from shapes import polygon

from postprocess.command_line import main

CUBOIDS = data("zoo/cuboids.geo")
RECTANGLES = data("zoo/rectangles.geo")
NAMED = """body lower E 210e3 nu 0.3
body upper E 210e3 nu 0.3
contact foot top
clamp base
move grip 0 {} -0.011
"""
BOXES = 'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 4, 4, 2}; Box(2) = {1, 1, 2.01, 2, 2, 1};\n'
JOINED = BOXES.replace("2.01", "2") + "BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n"
PICKED = data("zoo/picked.case")
AREAS = {"base": 16.0, "foot": 4.0, "grip": 4.0}


def gmsh(folder, name, text, *options):
    """A file of gmsh's in the folder, out of a geometry."""
    geo = folder / "source.geo"
    geo.write_text(text)
    subprocess.run(["gmsh", geo, *map(str, options), "-v", "2", "-o", folder / name], check=True, capture_output=True)
    return folder / name


def iges(*boxes):
    """Boxes as flat B-spline surfaces (type 128) that nothing joins, each by two opposite corners."""
    directory, parameters = [], []
    for low, high in boxes:
        corner = [[(low, high)[k >> axis & 1][axis] for axis in range(3)] for k in range(8)]
        for a, b, c, d in ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 4, 5), (2, 3, 6, 7), (0, 2, 4, 6), (1, 3, 5, 7)):
            knots = [0.0, 0.0, 1.0, 1.0] * 2
            places = [value for k in (a, b, c, d) for value in corner[k]]
            values = [128, 1, 1, 1, 1, 0, 0, 1, 0, 0, *knots, *[1.0] * 4, *map(float, places), 0.0, 1.0, 0.0, 1.0]
            words, lines = [str(value) for value in values], [""]
            for k, word in enumerate(words):
                word += ";" if k == len(words) - 1 else ","
                lines += [""] if len(lines[-1] + word) > 64 else []
                lines[-1] += word
            entry, first = len(directory) + 1, len(parameters) + 1
            parameters += [f"{line:<64}{entry:>8}" for line in lines]
            directory.append("".join(f"{each:>8}" for each in (128, first, 0, 0, 0, 0, 0, 0, 0)))
            directory.append("".join(f"{each:>8}" for each in (128, 0, 0, len(lines), 0, "", "", "", 0)))
    head = "1H,,1H;,4Hpart,8Hpart.igs,4Htest,4Htest,32,38,6,308,15,4Hpart,1.,2,2HMM,1,0.01,"
    head += "15H20260101.000000,1e-07,100.,4Htest,4Htest,11,0,15H20260101.000000;"
    parts = {"S": ["boxes"], "G": [head[k : k + 72] for k in range(0, len(head), 72)], "D": directory, "P": parameters}
    parts["T"] = ["".join(f"{key}{len(lines):>7}" for key, lines in parts.items())]
    return "".join(f"{line:<72}{key}{k:>7}\n" for key, lines in parts.items() for k, line in enumerate(lines, 1))


def readable(folder, mesh, case, space=1, sets=""):
    """(exit code, what is said, areas of groups, volumes of bodies) of the reader by itself."""
    (folder / "a.case").write_text(case)
    out = folder / "read"
    environment = {**os.environ, "LC_ALL": "C"}
    given = [str(os.getpid()), mesh, out, folder / "a.case", str(space), "solve", sets, "friction wear plastic"]
    command = ["sh", "edp/input/read-case.sh", *given]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    why = (out / "why").read_text().strip() if (out / "why").exists() else ""
    assert done.returncode in (0, 4) or why.count("\n") == 0
    sizes = measure(out, space) if done.returncode == 0 else ({}, [])
    subprocess.run(["rm", "-r", out], check=True)
    return done.returncode, why, *sizes


def measure(folder, space):
    """Areas (lengths) of the groups and volumes (areas) of the regions of mesh.msh."""
    lines = (folder / "case").read_text().splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("groups "))
    names = [line[2:] for line in lines[first + 1 : first + 1 + int(lines[first].split()[1])]]
    rows = (folder / "mesh.msh").read_text().splitlines()
    nodes = rows.index("$Nodes")
    count = int(rows[nodes + 1])
    at = 1e-6 * np.array([row.split()[1:] for row in rows[nodes + 2 : nodes + 2 + count]], float)
    elements = rows.index("$Elements")
    areas, volumes = {}, {}
    for row in rows[elements + 2 : -1]:
        _, kind, _, group, _, *corners = map(int, row.split())
        edges = at[np.array(corners[1:]) - 1] - at[corners[0] - 1]
        if kind == 2 + 2 * space:
            size = abs(np.linalg.det(edges[:, : 2 + space])) / (2 + 4 * space)
            volumes[group] = volumes.get(group, 0) + size
        elif group <= len(names):
            size = np.linalg.norm(np.cross(*edges)) / 2 if space else np.linalg.norm(edges)
            areas[names[group - 1]] = areas.get(names[group - 1], 0) + size
    return areas, sorted(volumes.values())


# ---------------------------------------------------------------- meshes


MESHES = [(0, "msh22 -bin", 1, 1), (1, "msh41 -bin", 2, 0), (1, "msh41", 1, 1), (1, "inp", 2, 0), (1, "msh22", 2, 1)]
MESHES += [(0, "inp", 1, 1), (0, "msh41", 2, 0), (0, "inp", 2, 1)]


@pytest.mark.parametrize("space, form, order, brick", MESHES)
def test_meshes(tmp_path, space, form, order, brick):
    """Triangles, tetrahedra, quadrangles and bricks of either order shall be read."""
    name = "a.inp" if form == "inp" else "a.msh"
    text, (kind, *rest) = CUBOIDS if space else RECTANGLES, form.split()
    groups = ["-setnumber", "Mesh.SaveGroupsOfNodes", 1, "-setnumber", "Mesh.SaveGroupsOfElements", 1]
    options = groups if form == "inp" else ["-format", kind, *rest]
    mesh = gmsh(tmp_path, name, text, f"-{2 + space}", "-order", order, "-setnumber", "brick", brick, *options)
    code, why, areas, volumes = readable(tmp_path, mesh, NAMED.format("0" if space else ""), space)
    assert code == 0, why
    assert volumes == pytest.approx([4, 32] if space else [2, 8])
    assert {name: areas[name] for name in AREAS} == pytest.approx(AREAS if space else {"base": 4, "foot": 2, "grip": 2})


INP = data("zoo/block.inp")
PRESSED = "body PART E 210e3 nu 0.3\nclamp BASE\nobstacle TOP plane 0 0 1.999 0 0 -1\n"


def test_inp(tmp_path):
    """Node sets and surfaces of CalculiX's become groups; a case names what it uses."""
    (tmp_path / "a.inp").write_text(INP)
    code, why, areas, volumes = readable(tmp_path, tmp_path / "a.inp", PRESSED)
    assert code == 0, why
    assert areas == pytest.approx({"BASE": 1, "TOP": 1}) and volumes == pytest.approx([2])
    code, why, *_ = readable(tmp_path, tmp_path / "a.inp", PRESSED.replace("BASE", "BAS"))
    assert code == 3 and "line 2: BAS: no physical surface of the mesh; did you mean BASE?" in why


@pytest.mark.parametrize(
    "old, new, said",
    [
        (
            "C3D8R",
            "S4R",
            "line 13: *ELEMENT, TYPE=S4R: not read, a shell; allowed: C3D4, C3D10, C3D6, C3D8, C3D15",
        ),
        (
            "5, 6, 7, 8\n*ELSET",
            "5, 6, 7, 9\n*ELSET",
            "line 14: element 1: a node that is missing: 9; allowed: nodes",
        ),
        ("EVERY, S2", "EVERY, S7", "line 21: *SURFACE: S7: no side of an element; allowed: S1 ... S6"),
        ("*HEADING", "*INCLUDE, INPUT=b.inp", "line 1: *INCLUDE: not read; allowed: one file"),
        ("8, 0., 1., 2.", "7, 0., 1., 2.", "line 11: the node 7 is there twice"),
    ],
)
def test_inp_refused(tmp_path, old, new, said):
    assert old in INP
    (tmp_path / "a.inp").write_text(INP.replace(old, new))
    code, why, *_ = readable(tmp_path, tmp_path / "a.inp", PRESSED)
    assert code == 1 and said in why and "\n" not in why


# ---------------------------------------------------------------- geometries


@pytest.mark.parametrize("kind", "iges step stp brep geo".split())
def test_geometries(tmp_path, kind):
    """What CAD writes is meshed as it is, its groups picked in the case file: the same of each kind."""
    if kind == "iges":
        mesh = tmp_path / "a.IGES"
        mesh.write_text(iges(((0, 0, 0), (4, 4, 2)), ((1, 1, 2.01), (3, 3, 3.01))))
    elif kind == "geo":
        mesh = tmp_path / "a.geo"
        mesh.write_text(BOXES)
    else:
        mesh = gmsh(tmp_path, "a.step" if kind == "stp" else f"a.{kind}", BOXES, "-0")
        mesh = mesh.rename(tmp_path / f"a.{kind}")
    code, why, areas, volumes = readable(tmp_path, mesh, PICKED + NAMED.format("0"))
    assert code == 0, why
    assert volumes == pytest.approx([4, 32])
    assert areas == pytest.approx({**AREAS, "top": 16})


def test_faces_that_meet_become_two(tmp_path):
    """Bodies that share a face are one part, until "between" asks for their faces: then each has its own nodes."""
    mesh = gmsh(tmp_path, "a.brep", JOINED, "-0")
    case = PICKED.replace("near 2 2 3", "volumes 2").replace(" 3  3.1 3.1 3.02", " 2.9  3.1 3.1 3.02")
    code, why, areas, volumes = readable(tmp_path, mesh, case + NAMED.format("0"))
    assert code == 0, why
    assert volumes == pytest.approx([4, 32])
    assert areas == pytest.approx({**AREAS, "top": 4})  # of the lower one's upper side the part that meets


def test_plane_geometry(tmp_path):
    flat = 'SetFactory("OpenCASCADE");\nRectangle(1) = {0, 0, 0, 4, 2};\nDisk(2) = {2, 3, 0, 1};\n'
    mesh = gmsh(tmp_path, "a.step", flat, "-0")
    code, why, areas, volumes = readable(tmp_path, mesh, data("zoo/disc-on-block.case"), 0)
    assert code == 0, why
    assert volumes == pytest.approx([np.pi, 8], rel=0.02)
    assert areas == pytest.approx({"top": 4, "base": 4, "round": 2 * np.pi}, rel=0.01)


def test_what_no_group_has_is_left_out(tmp_path):
    """One body alone needs no group; of several those of no group are left out, which is said."""
    mesh = gmsh(tmp_path, "a.step", BOXES, "-0")
    case = "group only volumes 1\ngroup base plane 0 0 0 0 0 1\ngroup top plane 0 0 2 0 0 1\nbody only E 1 nu 0.3\n"
    case += "clamp base\nobstacle top plane 0 0 1.9 0 0 -1\n"
    assert readable(tmp_path, mesh, case)[3] == pytest.approx([32])
    assert readable(tmp_path, mesh, case.replace("group only volumes 1\n", ""))[3] == pytest.approx([4, 32])


@pytest.mark.parametrize(
    "old, new, said",
    [
        ("volumes 1", "volumes 3", "line 1: 3: no such number of volumes; allowed: 1 2"),
        ("volumes 1", "volume 1", "line 1: volume: unknown; did you mean volumes? allowed: group NAME faces N ..."),
        ("volumes 1", "volumes one", "line 1: one: not the number of one of the volumes; allowed: those that -check 1"),
        (
            "group lower volumes 1\n",
            "",
            "line 2: lower: no body of the geometry has this name; allowed: upper, or a line",
        ),
        ("0 0 0  0 0 1", "0 0 9  0 0 1", "line 5: base: plane: no face lies there; allowed: one or more, of 1 2 3"),
        ("0 0 0  0 0 1", "0 0 0  0 0 0", "line 5: the normal is 0 in every direction"),
        ("near 2 2 3", "near 2 2", "line 2: the place is missing after 2"),
        ("between upper lower", "between upper upper", "line 3: upper: twice the same body; allowed: two bodies"),
        ("size lower 1", "size lower 0", "line 7: 0: the size is out of range; allowed: above 0"),
        ("size lower 1", "size lowr 1", "line 7: lowr: no"),
        ("group top between lower upper", "group foot faces 1", "line 4: group foot: stated before, in line 3"),
    ],
)
def test_refused(tmp_path_factory, old, new, said, cad):
    assert old in PICKED
    folder = tmp_path_factory.mktemp("refused")
    code, why, *_ = readable(folder, cad, PICKED.replace(old, new) + NAMED.format("0"))
    assert code == 3 and said in why and "allowed: " in why, why


@pytest.fixture(scope="module")
def cad(tmp_path_factory):
    return gmsh(tmp_path_factory.mktemp("cad"), "a.step", BOXES, "-0")


def test_files_that_are_none(tmp_path, cad):
    """What is no geometry, has no body or no groups, a size for a mesh: one line each."""
    (tmp_path / "a.step").write_text("no geometry")
    code, why, *_ = readable(tmp_path, tmp_path / "a.step", PRESSED)
    assert code == 1 and why.startswith("gmsh cannot read it")
    shell = gmsh(tmp_path, "b.brep", 'SetFactory("OpenCASCADE");\nRectangle(1) = {0, 0, 0, 4, 2};\n', "-0")
    assert readable(tmp_path, shell, PRESSED)[:2] == (1, "no solid in it")
    mesh = gmsh(tmp_path, "c.msh", CUBOIDS, "-3", "-format", "msh22")
    code, why, *_ = readable(tmp_path, mesh, "size contact 0.1\n" + NAMED.format("0"))
    assert code == 3 and "line 1: sizes need a geometry; allowed: with a .geo, .step, .iges or .brep file" in why
    code, why, *_ = readable(tmp_path, cad, PICKED + NAMED.format("0"), sets=" -setnumber radius 3")
    assert code == 1 and why == "-set: it has no numbers to be set; allowed: with a .geo file"


TWO = "body low E 1 nu 0\nbody high E 1 nu 0\nclamp foot\n"
SAVED = (
    'Physical Volume("low") = {1}; Physical Volume("high") = {2}; Physical Surface("foot") = {5}; Mesh.SaveAll = 1;\n'
)
ON_TOP = "obstacle lid plane 0 0 9 0 0 -1\n"


@pytest.fixture(scope="module")
def numbered(tmp_path_factory):
    """A mesh with the numbers of its geometry."""
    folder = tmp_path_factory.mktemp("numbered")
    return gmsh(folder, "a.msh", BOXES + SAVED, "-3", "-format", "msh41", "-clmax", 1)


@pytest.mark.parametrize(
    "lines, areas",
    [
        ("group lid faces 12\njoin high low contact\n", {"lid": 4, "high-low": 4, "low-high": 16}),
        ("group lid plane 0 0 3.01 0 0 1\ngroup a between high low\ngroup b faces 6\ncontact a b\n", {"a": 4, "b": 16}),
        ("group lid near 2 2 9\n", {"lid": 4}),
    ],
)
def test_groups_of_a_mesh(tmp_path, numbered, lines, areas):
    """A case picks on a mesh by numbers and between bodies if it has those of a geometry, by place in any case."""
    code, why, found, _ = readable(tmp_path, numbered, TWO + lines + ON_TOP)
    assert code == 0, why
    assert found == pytest.approx({"foot": 16, "lid": 4, **areas})


@pytest.mark.parametrize(
    "lines, said",
    [
        (
            "join low high part\n",
            "line 4: join low high part: a mesh cannot be joined; allowed: with a geometry, or join",
        ),
        ("join low high tie\n", "line 4: join low high tie: they touch nowhere, there is a gap between them"),
        ("size low 1\n", "line 4: sizes need a geometry; allowed: with a .geo, .step, .iges or .brep file"),
        ("group a faces 33\npressure a 1\n", "line 4: 33: no such number of faces; allowed: 1 2 3"),
        ("cut a low plane 0 0 1.1 0 0 1\npreload a 1\n", 'cut "a" of the case file, line 4: the plane goes through'),
    ],
)
def test_meshes_refused(tmp_path, numbered, lines, said):
    case = TWO + lines + "group lid plane 0 0 3.01 0 0 1\n" + ON_TOP
    code, why, *_ = readable(tmp_path, numbered, case)
    assert code == (1 if "cut" in lines else 3) and said in why


def test_numbers_of_a_geometry(tmp_path):
    """-set NAME value is a number of a .geo file, another name refused with those that there are."""
    geo = ROOT / "edp/examples/roller/roller.geo"
    case = (geo.with_suffix(".case")).read_text()
    code, why, *_ = readable(tmp_path, geo, case, 0, sets=" -setnumber size 2")
    assert code == 0, why
    code, why, *_ = readable(tmp_path, geo, case, 0, sets=" -setnumber sizes 2")
    assert code == 1 and why == "-set sizes: no number of it that can be set; allowed: radius width height size"
    geo = tmp_path / "several.geo"
    geo.write_text('DefineConstant[ a = 1, b = {2, Min 0, Name "x]y, c"},\n // z = 1\n  dd=2 ];DefineConstant[e];')
    assert readable(tmp_path, geo, case, 0, sets=" -setnumber z 2")[1].endswith("allowed: a b dd e")


WORDS = {
    "fix": "did you mean clamp (no displacement, or none along axes)?",
    "Fixed": "did you mean clamp (no displacement, or none along axes)?",
    "support": "did you mean clamp (no displacement, or none along axes)?",
    "acceleration": "did you mean gravity (an acceleration of all bodies with a density)?",
    "glue": "did you mean tie (two surfaces glued: no gap, no slip)?",
    "weld": "join BODY BODY part makes two bodies of a geometry that touch one part",
    "friction": "it stands behind a contact or an obstacle",
    "material": "did you mean body (",
    "mesh": "did you mean size (",
}


@pytest.mark.parametrize("word", cases_of(list(WORDS)[::4], WORDS))
def test_words(tmp_path, word, cad):
    """What an engineer looks for leads to what there is, and says what that does."""
    code, why, *_ = readable(tmp_path, cad, f"{word} base\n" + NAMED.format("0"))
    assert code == 3 and f"line 1: {word}: unknown statement; {WORDS[word]}" in why


# ---------------------------------------------------------------- solved


@pytest.mark.parametrize("drawn", [False, True])
def test_shown_without_a_case(tmp_path, cad, drawn):
    """-check 1 shows a geometry without a case file: each face with its number; two commands lead to the picture."""
    out = tmp_path / "out"
    code, said = execute([*FREEFEM, "edp/parts-3d.edp", "-mesh", cad, "-check", 1, "-out", out])
    assert code == 0 and f"-m postprocess check {out}/check" in said
    faces = np.genfromtxt(out / "check/check-faces.csv", delimiter=",", names=True)
    assert sorted(set(faces["face"])) == list(range(1, 13)) and set(faces["body"]) == {1, 2}
    code, said = execute([*FREEFEM, "edp/parts-3d.edp", "-mesh", cad, "-out", tmp_path / "none"])
    assert code == 10 and "-check 1 shows a geometry without" in said and not (tmp_path / "none").exists()
    if drawn:
        assert main(["check", str(out)]) == 0
        assert (out / "check/faces.png").exists() and not (out / "check/check.png").exists()


def test_step_solved(tmp_path, cad):
    """Of a STEP file to forces: those of the same bodies out of a mesh of bricks, as far as these meshes tell."""
    forces = []
    bricks = gmsh(tmp_path, "b.msh", CUBOIDS, "-3", "-format", "msh41", "-setnumber", "brick", 1)
    for mesh, case in ((cad, PICKED), (bricks, "")):
        done = part(tmp_path, mesh, case + NAMED.format("0"), "-estimate", 0, space=True)
        forces.append(done.contacts[0]["force"][2])
    assert forces[0] == pytest.approx(forces[1], rel=0.05)


def test_ties_beside_contacts(tmp_path):
    """`size contact` is of where contacts touch: a tie, which touches all over, has it only where it is alone."""
    stack = polygon("low", 1, ["-4, -2", "4, -2", "4, 0", "-4, 0"], {1: "base", 3: "lid"})
    stack += polygon("high", 1, ["-4, 0", "4, 0", "4, 1", "-4, 1"], {1: "sole", 3: "top"}, 5)
    bodies = "body low E 1 nu 0.3\nbody high E 1 nu 0.3\nclamp base\ntie sole lid\n"
    found, contact = [], "obstacle top circle 0 3 2 move 0 -0.1\n"
    for k, own in enumerate((contact, "pressure top 1\n")):
        run = part(tmp_path / str(k), stack, f"size contact 0.05\n{bodies}{own}", "-check", 1)
        found.append(int(re.search(r"mesh +(\d+)", run.stdout)[1]))
    assert 300 < found[0] < found[1] / 3
    # and of the two only the tie has shears
    assert part(tmp_path / "2", stack, bodies + contact, "-estimate", 0).stdout.count("shear force") == 1


# ---------------------------------------------------------------- sizes of a case beside those of a geometry


SHIPPED = [path for path in sorted(ROOT.glob("edp/*/*/*.geo")) if path.with_suffix(".case").exists()]


def count(folder, mesh, case, space=0):
    """How many elements the reader makes: triangles, in space tetrahedra."""
    (folder / "a.case").write_text(case)
    out = folder / "read"
    words = [str(os.getpid()), mesh, out, folder / "a.case", str(space), "solve", ""]
    done = subprocess.run(["sh", ROOT / "edp/input/read-case.sh", *words], timeout=60, capture_output=True, text=True)
    assert done.returncode == 0, (done.stdout, (out / "why").read_text())
    rows = [row.split() for row in (out / "mesh.msh").read_text().splitlines()]
    subprocess.run(["rm", "-r", out], check=True)
    return sum(len(row) > 5 and row[1] == str(2 + 2 * space) for row in rows[rows.index(["$Elements"]) :])


@pytest.mark.parametrize("geo", SHIPPED, ids=lambda path: path.stem)
def test_shipped_geometries_take_sizes(tmp_path, geo):
    """Each geometry of the package, with fields of its own or without, takes a size of a case."""
    rows = [row.split() for row in geo.with_suffix(".case").read_text().splitlines() if row.strip()]
    case = "".join(f"{' '.join(row)}\n" for row in rows if row[0] in ("group", "state"))
    case += "".join(f"body {row[1]} E 1 nu 0\n" for row in rows if row[0] == "body")
    first = next(row for row in rows if row[0] in ("contact", "obstacle", "tie"))
    space = int("Physical Volume" in geo.read_text())
    place = "plane 0 0 0 1 0 0" if space else "plane 0 0 1 0"
    case += f"contact {first[1]} {first[2]}\n" if first[0] != "obstacle" else f"obstacle {first[1]} {place}\n"
    assert count(tmp_path, geo, case + f"size {first[1]} {1 + 4 * space}\n", space) > 20


STAMP = """Point(1) = {0, -20, 0, 1}; Point(2) = {20, -20, 0, 1}; Point(3) = {20, 0, 0, 1}; Point(4) = {0, 0, 0, 1};
For k In {1:4}
Line(k) = {k, k % 4 + 1};
EndFor
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Physical Surface("block") = {1}; Physical Curve("base") = {1}; Physical Curve("top") = {3};
"""
FIELD = 'Field[{0}] = MathEval; Field[{0}].F = "1"; Background Field = {0}; Mesh.MeshSizeFromPoints = 0;\n'


@pytest.mark.parametrize("field, name", [(0, "top"), (1, "top"), (3, "contact"), (99999, "contact")])
def test_sizes_beside_own(tmp_path, field, name):
    """A named size is taken beside sizes of points or a field of any number; what is not named keeps its size."""
    (tmp_path / "a.geo").write_text(STAMP + (FIELD.format(field) if field else ""))
    case = f"size {name} 0.2\nbody block E 1 nu 0\nclamp base\nobstacle top circle 10 5 5 move 0 -1\n"
    (tmp_path / "a.case").write_text(case)
    words = [str(os.getpid()), tmp_path / "a.geo", tmp_path / "read", tmp_path / "a.case", "0", "solve", ""]
    subprocess.run(["sh", ROOT / "edp/input/read-case.sh", *words], timeout=60, check=True)
    rows = [row.split() for row in (tmp_path / "read/mesh.msh").read_text().splitlines()]
    first = rows.index(["$Nodes"]) + 2
    at = 1e-6 * np.array([row[1:3] for row in rows[first : first + int(rows[first - 1][0])]], float)
    ends = np.array([row[-2:] for row in rows[rows.index(["$Elements"]) + 2 : -1] if row[1] == "1"], int) - 1
    middle, length = at[ends].mean(axis=1), np.linalg.norm(at[ends[:, 0]] - at[ends[:, 1]], axis=1)
    base, near = middle[:, 1] < -19.99, (abs(middle[:, 1]) < 0.01) & (abs(middle[:, 0] - 10) < 0.5)
    assert base.sum() == 20 and length[near].max() < 0.25


def test_coarser_than_points(tmp_path):
    """A size on a group counts where the geometry's points say a smaller one."""
    (tmp_path / "a.geo").write_text(STAMP)
    case = "size block 4\nbody block E 1 nu 0\nclamp base\nobstacle top circle 10 5 5 move 0 -1\n"
    assert count(tmp_path, tmp_path / "a.geo", case) < 100


OWN_WAYS = ["Mesh.MshFileVersion = 2.2; Mesh.SaveAll = 1;", "Mesh.MshFileVersion = 4.1; Mesh.Binary = 1;"]


@pytest.mark.parametrize("own", OWN_WAYS, ids=["old", "binary"])
def test_geometry_that_meshes_itself(tmp_path, own):
    """A .geo file that ends with Mesh 3 and options of its own for a file takes sizes of the case as any other."""
    geo, case = tmp_path / "a.geo", "body block E 1 nu 0\nclamp foot\nobstacle top sphere 2 2 5 R 3 move 0 0 -1\n"
    text = BOXES.partition("Box(2)")[0] + 'Physical Volume("block") = {1}; Physical Surface("foot") = {5};\n'
    text += 'Physical Surface("top") = {6}; Mesh.MeshSizeMax = 2;\n'
    geo.write_text(text + "Mesh 3;\n" + own + "\n")
    found = [count(tmp_path, geo, size + case, 1) for size in ("", "size top 0.5\n")]
    geo.write_text(text)
    assert found == [count(tmp_path, geo, size + case, 1) for size in ("", "size top 0.5\n")]
    assert found[1] != found[0]


SETS = """*NODE, NSET=all
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
5, 2, 2, 2
*ELEMENT, TYPE=C3D4, ELSET=block
1, 1, 2, 3, 4
2, 2, 3, 4, 5
*NSET, NSET=foot
1, 2, 3
*SURFACE, NAME=face
1, S1
block, S2
"""


def test_sets_without_a_case(tmp_path):
    """-check 1 lists the sets of an .inp file, with their sizes and places; what is no mesh is refused."""
    (tmp_path / "a.inp").write_text(SETS)
    command = [*FREEFEM, "edp/parts-3d.edp", "-check", 1, "-out", tmp_path / "out", "-mesh"]
    code, said = execute([*command, tmp_path / "a.inp"])
    rows = [line.split(maxsplit=3) for line in said.splitlines() if re.match("body|nodes|surface", line)]
    whole = "(0, 0, 0) to (2, 2, 2)"
    right = [["body", "block", "2", whole], ["nodes", "all", "5", whole]]
    right += [["nodes", "foot", "3", "(0, 0, 0) to (1, 1, 0)"], ["surface", "face", "3", whole]]
    assert code == 0 and sorted(rows) == right and not (tmp_path / "out").exists()
    (tmp_path / "b.inp").write_text(SETS.partition("*ELEMENT")[0])
    code, said = execute([*command, tmp_path / "b.inp"])
    assert code == 10 and "no *ELEMENT of a body" in said


def test_unv(tmp_path):
    """A file of another format that gmsh knows is read; without faces that have numbers none are listed."""
    text = BOXES.partition("Box(2)")[0] + 'Physical Volume("block") = {1}; Physical Surface("foot") = {5};\n'
    mesh = gmsh(tmp_path, "a.unv", text, "-3", "-format", "unv")
    case = "body block E 1 nu 0\nobstacle foot plane 0 0 -0.01 0 0 1\n"
    assert count(tmp_path, mesh, case, 1) > 20
    code, said = execute([*FREEFEM, "edp/parts-3d.edp", "-check", 1, "-out", tmp_path / "out", "-mesh", mesh])
    assert code == 10 and "no bodies with faces" in said and "e+300" not in said


ENDLESS = "For k In {0 : 1e15}\nEndFor\n"


def reading(folder):
    """The numbers of the Python processes that read files of the folder: the reader, and gmsh in its child."""
    found = subprocess.run(["pgrep", "-f", f"read.py problem .*{folder}"], capture_output=True, text=True)
    return found.stdout.split()


@pytest.mark.parametrize("first, end", [("", "killed"), ("foo bar\n", "error")])
def test_gmsh_is_ended(tmp_path, first, end):
    """A gmsh that does not end is ended by its first error, and when its run has been killed."""
    (tmp_path / "a.geo").write_text(STAMP + first + ENDLESS)
    (tmp_path / "a.case").write_text("size top 1\nbody block E 1 nu 0\nobstacle top circle 10 5 5\n")
    run = subprocess.Popen(["sleep", "60"])
    words = [str(run.pid), tmp_path / "a.geo", tmp_path / "read", tmp_path / "a.case", "0", "solve", ""]
    reader = subprocess.Popen(["sh", ROOT / "edp/input/read-case.sh", *words])
    try:
        if end == "killed":
            wait_for(lambda: len(reading(tmp_path)) == 2)
            run.kill()
            run.wait()
        assert reader.wait(timeout=20) == (130 if end == "killed" else 1)
        if end == "error":
            assert "Unknown variable 'bar'" in (tmp_path / "read/why").read_text()
        assert not reading(tmp_path)
    finally:
        run.kill()
        run.wait()
    wait_for(lambda: not (tmp_path / "read").exists())


def test_without_room(tmp_path):
    """A limit of the size of files is no full disk."""
    (tmp_path / "a.geo").write_text(STAMP)
    command = f"{' '.join(FREEFEM)} edp/parts.edp -mesh {tmp_path}/a.geo -check 1 -out {tmp_path}/out"
    done = subprocess.run(["sh", "-c", f"ulimit -f 1; {command}"], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 30 and "ulimit -f too small" in done.stdout, done.stdout
