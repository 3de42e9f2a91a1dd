"""Cases in space on several processes, each with its part of the mesh: answers, estimates and pictures of one process.

Skipped where `make mpi` has not built the plugin.
"""

import csv
import itertools
import json
from collections import Counter

import numpy as np
import pytest
from contact.test_isoparametric import BALL, ON_PLANE, gmsh
from input.test_parts import Mesh, cube, turn_in_space, vector

from fem.test_multigrid import built, on_ranks
from fem.test_ranks import in_order
from postprocess.vtu import bodies_file, pieces, read_arrays, read_grid, read_surface

pytestmark = pytest.mark.ranks
TURN = turn_in_space(1)[:, [2, 0, 1]]  # longest across both boxes, so that cuts of the mesh go through both
STACK = 'body block E 100 nu 0.3\nbody upper E 150 nu 0.3\ncontact top "upper bottom"\nclamp bottom\n'
DOWN, ASIDE, PRESS, AT = (vector(at, TURN, 3) for at in ((0, 0, -1), (2e-3, 1e-3, -1e-2), (0, 0, -1e-2), (0, 0, 2.01)))
MOVED = STACK + f'move "upper top" {ASIDE}\n'
FLOATS = STACK + f'symmetry "upper left"\npressure "upper top" 2\ntraction "upper front" {DOWN}\nweight upper {DOWN}\n'
SPUN = MOVED.replace("E 150 nu 0.3", "E 150 nu 0.3 density 0.5") + f"spin upper 3 about {AT} axis {ASIDE}\n"
RUBS = STACK.replace('bottom"', 'bottom" friction 0.3', 1)
CASES = {
    # grounded and held along no axis, with a pressure and a traction
    "floats": (3, FLOATS, ["-order", 1]),
    # a guided force beside a support, a free one, weights
    "pulled": (
        3,
        STACK
        + f'clamp "upper left"\nforce "upper right" {DOWN}\nforce "upper top" {ASIDE} free\nweight block {DOWN}\n',
        ["-order", 2],
    ),
    # two contacts, an interference, an obstacle under a force
    "obstacle": (
        3,
        STACK + f'obstacle "upper top" plane {AT} {DOWN} law power kappa 1e3 m 2 d0 -0.05 force {DOWN}\n'
        'symmetry "upper left"\nsymmetry "upper front"\n',
        ["-order", 1, "-points", "nodal", "-estimate", 0],
    ),
    "tie": (2, MOVED.replace("contact", "tie"), ["-order", 1]),
    "legs": (3, RUBS + f'leg 1\nmove "upper top" {PRESS}\nleg 2\nmove "upper top" {ASIDE}\n', ["-order", 1]),
    # one group in two planes, along no axis
    "planes": (
        2,
        RUBS + 'symmetry "upper sides"\nleg 1\npressure "upper top" 1\nleg 2\npressure "upper top" 3\n',
        ["-order", 1],
    ),
    # supports along the axes, which are those of no side
    "rollers": (
        2,
        STACK.replace("clamp bottom", "symmetry bottom\nclamp left x\nclamp back y")
        + 'clamp "upper left" y\nmove "upper back" 0.01 * *\nmove "upper top" * * -0.02\n',
        ["-order", 1],
    ),
    "heated": (2, RUBS + f'expand upper 1e-3 1\nmove "upper top" {PRESS}\n', ["-order", 1]),
    "series": (2, MOVED, ["-order", 1, "-history", 1, "-steps", 2, "-estimate", 0]),
    "exact": (3, MOVED, ["-order", 1, "-distance", "exact", "-estimate", 0]),
}
RUNS = list(CASES)


FLAT = ((1, 0.017), (2, 0), (2, 1), (2, 2), (0, 2.013))  # axis, place
SIDES = ((0, 0), (0, 2), (0, 0.013), (1, 0), (1, 2), (1, 2.017))


def boxes(folder, lower=(4, 4, 3), upper=(5, 3, 2), sides=(), core=False, rough=0, joined=False):
    """Two boxes, the one on the other, turned. Nodes on no flat side are moved at random: no two of them move alike.
    sides: others that stay flat; core: another body deep inside the lower one shares its nodes; rough: how far
    the surfaces in contact rise at random; joined: two sides of the upper one are one group."""
    mesh = cube(Mesh(), cells=lower)
    cube(mesh, cells=upper, at=(0.013, 0.017, 1), prefix="upper ", name="upper")
    nodes = np.array(mesh.nodes)
    flat = [np.isclose(nodes[:, c], at) for c, at in (*FLAT, *sides)]
    loose = ~np.any(flat, axis=0)
    before = nodes.copy()
    nodes[loose] += np.random.default_rng(5).uniform(-0.04, 0.04, (loose.sum(), 3))
    touching = np.isclose(nodes[:, 2], 1)
    nodes[touching, 2] += np.random.default_rng(3).uniform(-rough, rough, touching.sum())
    mesh.nodes = [tuple(node) for node in nodes]
    for k, (kind, _, corners) in enumerate(mesh.elements):
        off = np.abs(before[np.array(corners) - 1].mean(axis=0) - (1.375, 1, 0.5))
        if core and kind == 4 and np.all(off < (0.375, 0.2, 0.1)):
            mesh.elements[k] = (kind, mesh.group(3, "core"), corners)
    text = mesh.text(TURN)
    for name in ("left", "front") if joined else ():
        text = text.replace(f'"upper {name}"', '"upper sides"')
    (folder / "a.msh").write_text(text)


def solved(folder, case, ranks, *flags, whole=False, solver="multigrid"):
    """The summary of a case of the mesh a.msh on so many processes."""
    (folder / "a.case").write_text(case)
    given = ["-mesh", folder / "a.msh", "-case", folder / "a.case", "-solver", solver, "-tol", 1e-9, *flags]
    code, output = on_ranks(ranks, "edp/parts-3d.edp", *given, "-out", folder / str(ranks))
    assert code == 0, output[-2000:]
    assert ("mesh: whole" in output) == whole, output
    (told,) = [line for line in output.splitlines() if line.startswith("  mesh")]
    return json.loads((folder / str(ranks) / "summary.json").read_text()), told


def alike(one, many, force, length):
    """Forces and motions to what the balance of a run leaves, estimates to the accuracy of their solves."""
    for name, key, scale in (
        ("contacts", "force", force),
        ("bodies", "reaction", force * length),
        ("supports", "force", force),
        ("guides", "force", force),
    ):
        for a, b in zip(one[name], many[name], strict=True):
            assert b[key] == pytest.approx(a[key], abs=2e-6 * scale), (name, key)
    for a, b in zip(one["contacts"], many["contacts"], strict=True):
        for key in ("normalForce", "pressureMax"):
            assert b[key] == pytest.approx(a[key], rel=1e-8), key
    for a, b in zip(one["bodies"], many["bodies"], strict=True):
        assert b["motion"] == pytest.approx(a["motion"], rel=1e-6, abs=1e-7 * np.abs(a["motion"]).max())
    for a, b in zip(one["prescribed"], many["prescribed"], strict=True):
        key = "force" if "force" in a else "moment"
        assert b[key] == pytest.approx(a[key], abs=2e-6 * force)
    assert many["energy"] == pytest.approx(one["energy"], rel=1e-7)
    assert many["outOfBalance"] < 1e-6
    assert many["warnings"] == one["warnings"] and many["fixedMotions"] == one["fixedMotions"]


def same_errors(one, many, path=()):
    """Each ± of the one is that of the other, and none is known to one of them alone."""
    if isinstance(one, dict):
        assert one.keys() == many.keys(), path
        for key in one:
            same_errors(one[key], many[key], (*path, key))
    elif isinstance(one, list):
        assert len(one) == len(many), path
        for a, b in zip(one, many, strict=True):
            same_errors(a, b, path)
    elif path and path[-1] == "error" and one is not None:
        assert many == pytest.approx(one, rel=5e-3, abs=1e-9), path


def same_pictures(one, many):
    assert not (many / "solution.vtu").exists()
    grids = [read_grid(bodies_file(each)) for each in (one, many)]
    first, second = (in_order(grid) for grid in grids)
    assert len(first) == len(second)
    for field, part in (("move", 1e-6), ("stress", 1e-6), ("pressure", 1e-6)):
        values = [getattr(grid, field)[order] for grid, order in zip(grids, (first, second), strict=True)]
        assert np.allclose(*values, rtol=part, atol=part * np.abs(values[0]).max()), field
    for field in ("cells", "surface"):
        assert len(getattr(grids[0], field)) == len(getattr(grids[1], field)), field
    assert np.array_equal(*(np.bincount(grid.label) for grid in grids))
    shares = [
        read_arrays(bodies_file(each)).get(("CellData", "errorShare[force]"), np.zeros(1)) for each in (one, many)
    ]
    assert shares[1].sum() == pytest.approx(shares[0].sum(), rel=5e-3)
    surfaces = [read_surface(each / "contact.vtu") for each in (one, many)]
    assert np.array_equal(surfaces[0].points, surfaces[1].points)
    assert np.array_equal(surfaces[0].cells, surfaces[1].cells)
    tables = [list(csv.reader((each / "contact.csv").open())) for each in (one, many)]
    assert tables[0][0] == tables[1][0]
    tables = [np.array([[float(word or "nan") for word in row] for row in table[1:]]) for table in tables]
    for column in range(tables[0].shape[1]):
        a, b = (table[:, column] for table in tables)
        assert np.allclose(a, b, rtol=1e-6, atol=max(1e-6 * np.nanmax(np.abs(a)), 1e-9), equal_nan=True), column


@built
@pytest.mark.parametrize("name", RUNS)
def test_same_case(name, tmp_path):
    """Two boxes of 170 nodes."""
    boxes(tmp_path, joined=name == "planes")
    ranks, case, flags = CASES[name]
    one, mesh = solved(tmp_path, case, 1, *flags)
    many, again = solved(tmp_path, case, ranks, *flags)
    assert many["ranks"] == ranks and many["ndof"] == one["ndof"] and mesh == again
    force = max(np.linalg.norm(each["force"]) for each in one["contacts"])
    alike(one, many, force, 2)
    same_errors(one["estimates"], many["estimates"])
    same_pictures(tmp_path / "1", tmp_path / str(ranks))
    if "-history" in flags:
        series = [np.genfromtxt(tmp_path / each / "series.csv", delimiter=",")[1:] for each in ("1", str(ranks))]
        assert series[0].shape[1] > 8 and np.allclose(*series, rtol=1e-6, atol=1e-6 * force, equal_nan=True)


def same_greatest(one, many):
    same_errors(one, many)
    for a, b in zip(one, many, strict=True):
        for key in ("vonMises", "at", "singular", "above"):
            assert b[key] == (a[key] and pytest.approx(a[key], rel=1e-8)), key


def same_stresses(one, many, folder, other):
    """Greatest stresses, tensors at the nodes and along lines, and their errors."""
    same_greatest(one, many)
    assert [each["body"] for each in one] == ["core", "block", "upper"]
    assert any(each["error"] for each in one) and any(0 < (each["above"] or 0) < 1 for each in one)
    for name in ("line-up.csv", "line-across.csv"):
        a, b = (np.genfromtxt(folder / each / name, delimiter=",", names=True) for each in ("1", other))
        for column in a.dtype.names:
            part = 5e-3 if column.endswith("Error") else 1e-7
            assert np.allclose(a[column], b[column], rtol=part, atol=1e-8), (name, column)
        assert name != "line-up.csv" or np.isfinite(a["vonMisesError"]).sum() > 5
    grids = [bodies_file(folder / each) for each in ("1", other)]
    orders = [in_order(read_grid(grid)) for grid in grids]
    a, b = (read_arrays(grid) for grid in grids)
    names = [key for key in a if key[0] == "PointData" and ("stress" in key[1] or "Mises" in key[1])]
    assert len(names) == 11
    parts = [read_arrays(piece) for piece in pieces(grids[1])]
    nodes = np.concatenate([each["PointData", "node"] for each in parts])
    _, first, place = np.unique(nodes, return_index=True, return_inverse=True)
    assert len(first) < len(nodes)
    for key in names:
        assert np.allclose(a[key][orders[0]], b[key][orders[1]], rtol=1e-6, atol=1e-6), key
        values = np.concatenate([each[key] for each in parts])
        assert np.array_equal(values, values[first][place]), key  # of all processes that have a node


AWAY = vector((1e-3, 2e-3, -2e-3), TURN, 3)
INNER, OUTER, LEFT, RIGHT = (
    vector(at, TURN, 3) for at in ((0.6, 0.5, 1.7), (0.9, 0.8, 4.5), (0.5, 0.8, -8), (1.5, 1.1, 9))
)
GUIDED = RUBS + f'move "upper left" {AWAY}\nforce "upper right" {DOWN}\nweight block {DOWN}\nweight upper {ASIDE}\n'
STRESSED = "body core E 300 nu 0.2 yield 1\n" + FLOATS.replace("E 150 nu 0.3", "E 150 nu 0.3 yield 3")
STRESSED += f"weight block {ASIDE}\nstresses\nline up {INNER} {OUTER}\nline across {LEFT} {RIGHT}\n"
CROSSED = {
    # grounded, under loads of bodies and of surfaces, with stresses; bodies share nodes, and the rough contact leaves
    # forces on motions that no gap feels
    "floats": (2, STRESSED, ["-vtu", 1]),
    # a force on a group beside a support that moves: its motion is solved for; with friction, and the energies of loads
    "guided": (2, GUIDED, []),
    # strains by heat, and what spins, under a motion in two steps
    "moved": (2, SPUN + f"weight upper {DOWN}\nexpand block 1e-4 20\n", ["-vtu", 0, "-history", 1, "-steps", 2]),
    "three": (3, STRESSED, ["-vtu", 1]),
}


@built
@pytest.mark.parametrize("name", CROSSED)
def test_loads_across_cuts(name, tmp_path):
    """Two boxes with inner nodes that a process does not have: the direct engine's answers, works and errors."""
    ranks, case, flags = CROSSED[name]
    core = "core" in case
    boxes(tmp_path, lower=(8, 5, 5), upper=(7, 5, 5), sides=SIDES, core=core, rough=3e-4 * core)
    flags = ["-order", 1, *(flags or ["-vtu", 0])]
    one, _ = solved(tmp_path, case, 1, *flags, solver="direct")
    many, _ = solved(tmp_path, case, ranks, *flags)
    alike(one, many, max(np.linalg.norm(each["force"]) for each in one["contacts"]), 2)
    same_errors(one["estimates"], many["estimates"])
    for a, b in zip(one["ways"], many["ways"], strict=True):
        assert b["way"] == pytest.approx(a["way"], rel=1e-7)
    for a, b in zip(one["estimates"]["loads"], many["estimates"]["loads"], strict=True):
        assert b["way"]["value"] == pytest.approx(a["way"]["value"], rel=1e-7)
    assert many["estimates"]["contactStiffness"] == pytest.approx(one["estimates"]["contactStiffness"], rel=1e-3)
    for key in ("rotation", "normals", "pressureMax"):
        assert many["linearised"][key] == pytest.approx(one["linearised"][key], rel=1e-5), key
    if name == "guided":
        (_, support), (guide,), (contact,) = many["supports"], many["guides"], many["contacts"]
        down, aside = (np.array([float(number) for number in each.split()]) for each in (DOWN, ASIDE))
        on_body = down + 4 * aside + support["force"] + guide["force"] - np.array(contact["force"])
        assert np.abs(on_body).max() < 1e-6 and abs(down @ guide["force"]) < 1e-6
        for key in ("work", "stored", "dissipated"):
            assert many[key] == pytest.approx(one[key], rel=1e-6), key
    if "stresses" in case:
        same_stresses(one["stresses"], many["stresses"], tmp_path, str(ranks))
    if "-history" in flags:
        tables = [list(csv.DictReader((tmp_path / each / "series.csv").open())) for each in ("1", str(ranks))]
        for a, b in zip(*tables, strict=True):
            for name in a.keys() - {"backsolves"}:
                assert float(b[name]) == pytest.approx(float(a[name]), rel=1e-6, abs=1e-8, nan_ok=True), name


def joint(folder):
    """A bolt, its shank cut at the waist, with a head to one side that lies on a sleeve beside the shank; turned."""
    mesh = cube(Mesh(), size=(1.8, 2.2, 1.4), cells=(9, 6, 7))
    nodes = np.array(mesh.nodes)
    corners = [np.array(each) for kind, _, each in mesh.elements if kind == 4]
    corners = [each for each in corners if nodes[each - 1, 0].mean() < 1 or nodes[each - 1, 2].mean() > 1]
    used = np.unique(corners)
    faces = Counter(face for each in corners for face in itertools.combinations(sorted(each), 3))
    sides = []
    for face, count in faces.items():
        for name, at, owners in (("bottom", 0, 1), ("waist", 0.6, 2), ("under", 1, 1), ("top", 1.4, 1)):
            if count == owners and np.allclose(nodes[np.array(face) - 1, 2], at):
                sides.append((name, np.searchsorted(used, face)))
    mesh = Mesh()
    mesh.add(nodes[used - 1], sides, [("bolt", np.searchsorted(used, each)) for each in corners])
    cube(mesh, size=(0.6, 2.2, 1), cells=(3, 6, 4), at=(1.2, 0, 0), prefix="sleeve ", name="sleeve")
    nodes = np.array(mesh.nodes)
    flat = ((0, 1, 1.2, 1.8), (0, 2.2), (0, 0.6, 1, 1.4))
    loose = ~np.any([np.isclose(nodes[:, c], at) for c in range(3) for at in flat[c]], axis=0)
    nodes[loose] += np.random.default_rng(5).uniform(-0.03, 0.03, (loose.sum(), 3))
    mesh.nodes = [tuple(node) for node in nodes]
    (folder / "a.msh").write_text(mesh.text(TURN))


JOINT = 'body bolt E 2e4 nu 0.3\nbody sleeve E 1e4 nu 0.3\ncontact under "sleeve top"\nclamp bottom\n'
JOINT += f'clamp "sleeve bottom"\npreload waist 2\ntraction top {ASIDE}\nweight bolt {DOWN}\n'


@built
def test_preload_across_cuts(tmp_path):
    """The forces in front of a bolt's cut, its tension, shortening and their errors: the direct engine's."""
    joint(tmp_path)
    flags = ["-order", 1, "-vtu", 0]
    one, _ = solved(tmp_path, JOINT, 1, *flags, solver="direct")
    many, _ = solved(tmp_path, JOINT, 2, *flags)
    alike(one, many, 4, 2)
    same_errors(one["estimates"], many["estimates"])
    ((a,), (b,)) = one["preloads"], many["preloads"]
    assert a["error"] and a["shortenedError"]
    for key, part in (("force", 1e-6), ("shortened", 1e-6), ("error", 1e-2), ("shortenedError", 1e-2)):
        assert b[key] == pytest.approx(a[key], rel=part), key


@built
def test_same_curved_case(tmp_path):
    """A ball of second order: elements that follow its surface, on all processes alike."""
    ranks = 4
    lines = gmsh(tmp_path, BALL.format(size=0.5, order=2)).splitlines()
    first, last = lines.index("$Nodes") + 2, lines.index("$EndNodes")
    lines[first:last] = lines[first:last][::-1]  # nodes inside come first
    (tmp_path / "a.msh").write_text("\n".join([*lines, ""]))
    case = ON_PLANE + "weight ball 0 0 -1\nstresses\n"
    one, _ = solved(tmp_path, case, 1, "-order", 2)
    many, _ = solved(tmp_path, case, ranks, "-order", 2)
    alike(one, many, abs(one["force"]), 1)
    same_greatest(one["stresses"], many["stresses"])
    same_errors(one["estimates"], many["estimates"])
    same_pictures(tmp_path / "1", tmp_path / str(ranks))


DOME = """SetFactory("OpenCASCADE"); Sphere(1) = {0, 0, 0, 1, -Pi / 6, Pi / 2};
Mesh.MeshSizeMin = 0.35; Mesh.MeshSizeMax = 0.35; Mesh.ElementOrder = 2;
Physical Volume("dome") = {1}; Physical Surface("skin") = {1}; Physical Surface("base") = {2};
"""
PRESSED = "body dome E 1000 nu 0.3 density 2\nclamp base\nobstacle skin plane 0 0 1 0 0 -1 move 0 0 -0.02\n"


@built
@pytest.mark.parametrize("load", ["expand dome 1e-4 10", "spin dome 3 about 0.1 0.2 0 axis 0 0 1", "weight dome 5 0 0"])
def test_loads_of_curved_elements(load, tmp_path):
    """Integrals over elements that follow a surface: the direct engine's answers and errors."""
    gmsh(tmp_path, DOME)
    flags = ["-order", 2, "-vtu", 0]
    one, _ = solved(tmp_path, PRESSED + load + "\n", 1, *flags, solver="direct")
    many, _ = solved(tmp_path, PRESSED + load + "\n", 3, *flags)
    alike(one, many, one["contacts"][0]["normalForce"], 1)
    same_errors(one["estimates"], many["estimates"])


@built
def test_whole_mesh_for_what_parts_do_not_know(tmp_path):
    """States are written by one process, which then has the mesh, and says so."""
    boxes(tmp_path)
    solved(tmp_path, FLOATS, 2, "-order", 1, "-estimate", 0, "-states", 1, whole=True)
    assert (tmp_path / "2" / "solution.vtu").exists()
