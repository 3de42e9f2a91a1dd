"""Surfaces in space: smooth geometry through meshes' nodes, pairing, contacts, obstacles, turned problems."""

import numpy as np
import pytest
from freefem import ROOT, data, execute, part, run, scene_text, snippet, told
from input.test_parts import Mesh, cube, turn_in_space
from shapes import moved

from postprocess import closed_forms as forms

TURNS = [turn_in_space(seed) for seed in (1, 2, 3)]
E, NU = 100.0, 0.3


def parts(folder, mesh, case, *flags, expect=0):
    return part(folder, mesh, case, "-estimate", 0, *flags, space=True, expect=expect)


def vector(values):
    return " ".join(repr(float(v)) for v in values)


MIRRORS = [f"{body}-{side}" for body in ("lower", "upper") for side in ("back", "front", "left", "right")]
BLOCKS = "body lower E 100 nu 0.3\nbody upper E 100 nu 0.3\ncontact lower-top upper-bottom\n"
BLOCKS += "".join(f"symmetry {side}\n" for side in MIRRORS) + "clamp lower-bottom\n"


def blocks(gap=0.01):
    """Two confined blocks, three elements along a side below, five above."""
    mesh = cube(Mesh(), (2, 2, 1), (3, 3, 2), (0, 0, 0), "lower-", "lower")
    return cube(mesh, (2, 2, 0.5), (5, 5, 1), (0, 0, 1 + gap), "upper-", "upper")


@pytest.mark.parametrize("order, turn", [(1, 0), (2, 1)])
def test_patch(tmp_path, order, turn):
    """Blocks of 3 and 5 elements shall press each other uniformly to 1e-10, turned as they may be."""
    matrix = TURNS[turn]
    case = BLOCKS + f"move upper-top {vector(matrix @ [0, 0, -0.05])}\n"
    done = parts(tmp_path, blocks().text(matrix), case, "-order", order, "-tol", 1e-12)
    exact = 0.04 / 1.5 * E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
    np.testing.assert_allclose(done.contact["pressure"], exact, rtol=1e-10)


@pytest.mark.parametrize("turn", [0, 2])
def test_normals_beyond_the_master(tmp_path, turn):
    """Points that next to nothing is opposite have the normal of their own surface, as others have."""
    mesh = cube(Mesh(), (2, 2, 1), (3, 3, 1), (0, 0, 0), "lower-", "lower")
    mesh = cube(mesh, (2, 2, 1), (3, 3, 1), (0.9, 0.1, 1), "upper-", "upper")
    case = "body lower E 100 nu 0.3\nbody upper E 100 nu 0.3\ncontact lower-top upper-bottom\nclamp lower-bottom\n"
    case += f"move upper-top {vector(TURNS[turn] @ [0.01, 0, -0.02])}\n"
    contact = parts(tmp_path, mesh.text(TURNS[turn]), case, "-order", 1, "-distance", "exact").contact
    normals = np.stack([contact[f"normal{c}"] for c in "XYZ"], axis=1)
    beyond = contact["weight"] < 1e-6
    assert beyond.sum() > 3 and not beyond.all()
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-2)
    np.testing.assert_allclose(normals[beyond], [TURNS[turn] @ [0, 0, 1]] * beyond.sum(), atol=1e-9)


def ball(cells, size=1.0):
    """A cube of tetrahedra blown up to a ball with the group skin; no two of its places alike."""
    mesh = cube(Mesh(), (2, 2, 2), 3 * (cells,), (-1, -1, -1), "", "ball")
    nodes = np.array(mesh.nodes)
    far = abs(nodes).max(axis=1)
    nodes += np.random.default_rng(1).uniform(-0.2 / cells, 0.2 / cells, nodes.shape)
    away = np.linalg.norm(nodes, axis=1)
    mesh.nodes = list(nodes * (size * far / np.maximum(away, 1e-300))[:, None])
    mesh.names = [(2, "skin"), (3, "ball")]
    mesh.elements = [(kind, 1 if kind == 2 else 2, corners) for kind, _, corners in mesh.elements]
    return mesh


def plane(group, point, normal, move=None):
    text = f"obstacle {group} plane {vector(point)} {vector(normal)}"
    return text + (f" move {vector(move)}\n" if move is not None else "\n")


@pytest.mark.parametrize(
    "order, distance",
    [(1, "linear"), (2, "exact")],
)
def test_turned_ball(tmp_path, order, distance):
    """A ball that only three pairs of planes hold, turned: the same counts, but for one product, results to 1e-9."""

    def solve(name, matrix):
        case = "body ball E 100 nu 0.3\n"
        for axis in np.eye(3):
            case += plane("skin", matrix @ (-axis), matrix @ axis)
            case += plane("skin", matrix @ axis, -matrix @ axis, -0.3 * matrix @ axis)
        folder = tmp_path / name
        folder.mkdir()
        return parts(folder, ball(4).text(matrix), case, "-order", order, "-tol", 1e-11, "-distance", distance)

    one = solve("one", np.eye(3))
    points = one.points // 6
    assert one.points == 6 * points
    greatest = [max(one.contact["pressure"][k * points : (k + 1) * points]) for k in range(6)]
    assert min(greatest) > 0.5 * max(greatest)
    other = solve("other", TURNS[0])
    for count in ["newton", "points", "contactPoints"]:
        assert other.summary[count] == one.summary[count], count
    # the last product of the conjugate gradients may be decided by rounding
    assert abs(other.backsolves - one.backsolves) <= 1
    assert other.energy == pytest.approx(one.energy, rel=1e-9)
    for c in range(6):
        part = slice(c * points, (c + 1) * points)
        assert np.sort(other.contact["pressure"][part]) == pytest.approx(
            np.sort(one.contact["pressure"][part]), abs=1e-9 * one.pressureMax
        )


SMOOTH = data("surfaces-space/smooth.edp")


def smoothed(folder, nodes, triangles):
    """What the sides' middles are off the straight ones (triangles, 3, 3), normals at the corners."""
    rows = [f"{c} {vector(nodes[c])}" for corners in triangles for c in corners]
    (folder / "triangles.txt").write_text("\n".join([str(len(triangles)), *rows, ""]))
    values = told(snippet(folder, scene_text("two-spheres") + SMOOTH, "-order", 1, "-h", 0.5, "-layers", 1))
    return values["bulge"].reshape(-1, 3, 3), values["normal"].reshape(-1, 3, 3)


def sides(nodes, triangles):
    """The straight sides' middles, opposite each corner."""
    places = nodes[np.array(triangles)]
    return 0.5 * (places[:, [1, 2, 0]] + places[:, [2, 0, 1]])


def skin(mesh):
    """Nodes and outward triangles of a mesh about the origin."""
    nodes = np.array(mesh.nodes)
    triangles = np.array([corners for kind, _, corners in mesh.elements if kind == 2]) - 1
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    inward = (np.cross(b - a, c - a) * (a + b + c)).sum(axis=1) < 0
    triangles[inward] = triangles[inward][:, [0, 2, 1]]
    used, triangles = np.unique(triangles, return_inverse=True)
    return nodes[used], triangles.reshape(-1, 3)


def test_smooth_sphere(tmp_path):
    """Through an irregular sphere's nodes the surface shall be round to 3 % of its height above the facets."""
    nodes, triangles = skin(ball(8))
    bulge, normal = smoothed(tmp_path, nodes @ TURNS[0].T, triangles)
    middle = sides(nodes @ TURNS[0].T, triangles)
    height = 1 - np.linalg.norm(middle, axis=2)
    assert abs(1 - np.linalg.norm(middle + bulge, axis=2)).max() < 0.03 * height.max()
    assert abs(normal - (nodes @ TURNS[0].T)[triangles]).max() < 0.01


def test_smooth_cylinder(tmp_path):
    """A can: walls round, rims sharp, lids exactly flat."""
    n, layers = 32, 5
    angle = 2 * np.pi * np.arange(n) / n
    ring = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    nodes = [ring + np.array([0, 0, 0.2 * k]) for k in range(layers)]
    nodes += [0.5 * ring * [1, 1, 0] + [0, 0, z] for z in (0, 0.8)] + [np.array([[0, 0, 0], [0, 0, 0.8]])]
    nodes = np.concatenate(nodes)
    triangles = []
    for i in range(n):
        j = (i + 1) % n
        for k in range(layers - 1):
            a, b, c, d = n * k + i, n * k + j, n * k + n + j, n * k + n + i
            triangles += [(a, b, c), (a, c, d)]
        low, high = n * layers, n * layers + n
        triangles += [(j, i, low + i), (j, low + i, low + j), (low + j, low + i, high + n)]
        top = n * (layers - 1)
        triangles += [(top + i, top + j, high + i), (top + j, high + j, high + i), (high + i, high + j, high + n + 1)]
    triangles = np.array(triangles)
    matrix = TURNS[1]
    bulge, normal = smoothed(tmp_path, nodes @ matrix.T, triangles)
    bulge, normal = bulge @ matrix, normal @ matrix
    places = nodes[triangles]
    lid = np.ptp(places[:, :, 2], axis=1) < 1e-12
    assert (bulge[lid] == 0).all()
    assert abs(abs(normal[lid][:, :, 2]) - 1).max() < 1e-12
    middle = sides(nodes, triangles)[~lid]
    height = 1 - np.cos(np.pi / n)
    assert abs(np.hypot(*np.moveaxis((middle + bulge[~lid])[:, :, :2], -1, 0)) - 1).max() < 0.02 * height
    assert abs(bulge[~lid][:, :, 2]).max() < 0.02 * height


def test_smooth_in_any_order(tmp_path):
    """An open patch, and beside it one whose triangles and corners come in another order: the same bulges, normals."""
    n = 4
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    x, y = (x + 0.05 * np.sin(5 * y)).ravel(), (y + 0.03 * x**2).ravel()
    nodes = np.column_stack([x, y, 0.2 * x**2 + 0.1 * (x + y) ** 2 - 0.1 * x * y**2])
    first = [k for k in range(n * (n + 1)) if (k + 1) % (n + 1)]
    triangles = np.array([(k, k + 1, k + n + 2) for k in first] + [(k, k + n + 2, k + n + 1) for k in first])
    triangles[[0, n - 1]] = triangles[[n - 1, 0]]  # the one that has a corner alone, which is to be the last of all
    triangles[0] = np.roll(triangles[0], 1)
    other, places = triangles[::-1], np.concatenate([nodes, nodes + np.array([3, 0, 0])])
    bulge, normal = smoothed(tmp_path, places, np.concatenate([triangles, other + len(nodes)]))
    count = len(triangles)
    for values in (bulge, normal):
        assert abs(values[:count]).max(axis=(1, 2)).min() > 1e-3
        np.testing.assert_allclose(values[count:][::-1], values[:count], atol=1e-12)


def test_mean_of_neighbours(tmp_path):
    """Pressures that are all alike are off their neighbours' mean by nothing."""
    code = 'real[int] off(points);\nphat = 3;\ncomputeMeanDeviation(off);\ntell("off", off);\n'
    text = (ROOT / "edp/scenes/sphere-on-block.edp").read_text() + code
    off = told(snippet(tmp_path, text, "-order", 1, "-h", 2, "-estimate", 0, "-vtu", 0, "-out", tmp_path / "out"))[
        "off"
    ]
    assert len(off) > 9 and (off == 0).all()


def general(text):
    """The scene two-spheres with a statement of contact instead of its formula for the gap."""
    start, end = text.index("macro separation"), text.index("macro isAtContactBoundary")
    text = text[:start] + text[end:]
    added = 'addContact("balls", "", slaveLabel, masterLabel, -1, false, localCompliance);'
    statement = added + '\ninclude "solver/discretise.idp"'
    return text.replace('include "solver/discretise.idp"', statement)


@pytest.mark.parametrize("surface, points", [("smooth", "segment"), ("smooth", "nodal"), ("facets", "nodal")])
def test_gap_of_spheres(tmp_path, surface, points):
    """The gap between meshed spheres along normals: with smooth surfaces to 1 % of what facets are off."""
    code = 'tell("x", pointX);\ntell("y", pointY);\ntell("z", pointZ);\ntell("before", initialOverlap);\n'
    flags = ["-order", 2, "-h", 0.3, "-layers", 1, "-surface", surface, "-points", points]
    values = told(snippet(tmp_path, general(scene_text("two-spheres")) + code, *flags))
    normal = np.column_stack([values[name] for name in "xyz"])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    apart = 10 * normal - [0, 0, 20.1]
    ahead = (apart * normal).sum(axis=1)
    gap = -ahead - np.sqrt(ahead**2 - (apart**2).sum(axis=1) + 100)
    error = abs(-values["before"] - gap).max()
    facets = 0.3**2 / 80
    assert error < 0.01 * facets if surface == "smooth" else error > facets


PLACES = data("surfaces-space/places.edp")


def test_places_of_spheres(tmp_path):
    """What the estimates and the true distance call places on the slave lies on its sphere; the points are points; the
    curvatures of the closeness are its slopes' change, by differences: those of the patch count, a fifth and more."""
    text = "macro exactOnRequest() 1 //\n" + general((ROOT / "edp/scenes/two-spheres.edp").read_text()) + PLACES
    flags = ["-order", 1, *EXACT, "-force", 0, "-u0", 0.5, "-vtu", 0, "-out", tmp_path / "out"]
    values = told(snippet(tmp_path, text, *flags))
    assert len(values["away"]) > 100 and abs(values["away"] - 10).max() < 0.01 * 0.5**2 / 80
    assert len(values["off"]) > 9 and abs(values["off"]).max() < 1e-12
    for curved, slope in [(0, 0), (1, 1), (1, 3), (2, 4)]:
        change = -values[f"slope{slope}"]
        np.testing.assert_allclose(values[f"curved{curved}"], change, atol=1e-6 * abs(change).max())


EXACT = ["-distance", "exact", "-h", 0.5, "-layers", 1]
LAYER = ["-law", "power", "-kappa", 100, "-m", 2, "-d0", -0.05, "-tol", 1e-11]


@pytest.mark.parametrize("order, points", [(1, "nodal"), (2, "segment")])
def test_distance_has_an_energy(order, points):
    """With the true distance the force shall be the derivative of the energy: Simpson's rule to 1e-9."""
    flags = [*EXACT, *LAYER, "-order", order, "-points", points, "-force", 0]
    runs = [run("two-spheres", *flags, "-u0", u0) for u0 in (0.499, 0.5, 0.501)]
    work = 0.002 / 6 * (runs[0].force + 4 * runs[1].force + runs[2].force)
    assert runs[2].energy - runs[0].energy == pytest.approx(work, rel=1e-9)


def test_distance_there_and_back():
    """With the true distance the force found for an approach shall, prescribed, give that approach back."""
    flags = [*EXACT, "-tol", 1e-12, "-order", 1]
    pushed = run("two-spheres", *flags, "-force", 0, "-u0", 0.5)
    assert run("two-spheres", *flags, "-force", pushed.force).approach == pytest.approx(0.5, rel=1e-9)


def test_distance_about_an_axis():
    """A rigid sphere on a block in space and on a cylinder of the same area: one force to 1 %."""
    flags = ["-distance", "exact", "-law", "signorini", "-depth", 40]
    square = run("sphere-on-block", *flags, "-order", 2, "-force", 0, "-width", 80, "-h", 0.8)
    circle = run(
        "disc-on-block", *flags, "-order", 2, "-geometry", "axisymmetric", "-width", 80 / np.sqrt(np.pi), "-h", 0.2
    )
    assert square.force == pytest.approx(circle.force, rel=0.01)


@pytest.mark.parametrize("order", [2, 1])
def test_turned_cylinders(tmp_path, order):
    """Crossed cylinders with symmetries and a force, turned: the same counts, but for one product, results to 1e-9."""
    example = ROOT / "edp/examples/crossed-cylinders/crossed-cylinders.geo"
    numbers = {"ratio": 2, "size": 0.2 * order, "long": 0.71, "wide": 0.45, "extent": 3, "finer": 0.9}
    (tmp_path / "a.geo").write_text("".join(f"{k} = {v};\n" for k, v in numbers.items()) + f'Include "{example}";\n')
    execute(["gmsh", "-3", "-v", "1", "-format", "msh22", tmp_path / "a.geo", "-o", tmp_path / "a.msh"])
    mesh, case = (tmp_path / "a.msh").read_text(), example.with_suffix(".case").read_text()
    force = "force    grip  0 0 -500"
    assert force in case

    def solve(name, matrix):
        (tmp_path / name).mkdir()
        turned = case.replace(force, f"force grip {vector(matrix @ [0, 0, -500])}")
        return parts(tmp_path / name, moved(mesh, matrix), turned, "-order", order, "-tol", 1e-11)

    one, other = solve("one", np.eye(3)), solve("other", TURNS[order])
    assert one.contactPoints > 10
    for count in ("newton", "backsolves", "points", "contactPoints"):
        assert other.summary[count] == one.summary[count], count
    assert other.energy == pytest.approx(one.energy, rel=1e-9)
    np.testing.assert_allclose(other.contact["pressure"], one.contact["pressure"], atol=1e-9 * one.pressureMax)


@pytest.mark.parametrize("ratio, extent, growth", [(1, 6, 0.5), (4, 5, 0.5), (10, 3.5, 0.8)])
def test_crossed_cylinders(tmp_path, ratio, extent, growth):
    """Radii of 1:1 to 1:10: Hertz's semi-axes and greatest pressure within 1 %, elements of b/10."""
    modulus = forms.contact_modulus(forms.plane_modulus(210e3, 0.3), forms.plane_modulus(210e3, 0.3))
    a, b, greatest, _ = forms.hertz_ellipse(2000, (10, 10 * ratio), modulus)
    numbers = {"ratio": ratio, "size": b / 10, "long": a, "wide": b, "extent": extent * a, "growth": growth, "finer": 1}
    example = ROOT / "edp/examples/crossed-cylinders/crossed-cylinders.geo"
    text = "".join(f"{name} = {float(value)!r};\n" for name, value in numbers.items()) + f'Include "{example}";\n'
    (contact,) = part(tmp_path, text, example.with_suffix(".case").read_text(), space=True).contacts
    assert contact["semiAxes"] == pytest.approx([a, b], rel=0.01)
    assert contact["pressureMax"] == pytest.approx(greatest, rel=0.01)


TURNED_SIDES = data("surfaces-space/turns.edp")


@pytest.mark.parametrize("slope", [0.0, 0.3, -0.3])
def test_turns_of_patches(tmp_path, slope):
    """A quadratic surface above a body, which patches have exactly, turns nowhere, but at a fold on x = 0.5."""

    def height(x, y):
        return 0.3 * x**2 + 0.2 * x * y - 0.4 * y**2 + slope * abs(x - 0.5)

    corner = np.array([(0, 0), (0.5, 0.1), (1, 0), (0, 1), (0.5, 0.8), (1, 0.9)])
    triangles = np.array([(0, 1, 4), (0, 4, 3), (1, 2, 5), (5, 4, 1)])
    places = corner[triangles]
    nodes = np.dstack([places, height(*np.moveaxis(places, -1, 0))])
    middle = sides(corner, triangles)
    bulge = np.dstack([middle, height(*np.moveaxis(middle, -1, 0))]) - 0.5 * (nodes[:, [1, 2, 0]] + nodes[:, [2, 0, 1]])
    ends = [frozenset(np.delete(face, a)) for face in triangles for a in range(3)]
    beyond = [next((n for n, other in enumerate(ends) if other == own and n != k), -1) for k, own in enumerate(ends)]
    rows = [
        " ".join([vector((face @ TURNS[0].T).ravel()), vector((rise @ TURNS[0].T).ravel()), *map(str, near)])
        for face, rise, near in zip(nodes, bulge, np.reshape(beyond, (-1, 3)), strict=True)
    ]
    (tmp_path / "faces.txt").write_text("\n".join([str(len(rows)), *rows, ""]))
    turn = told(snippet(tmp_path, TURNED_SIDES))["turn"]
    x, y = middle.reshape(-1, 2).T
    # normals on both hands of the fold; a valley takes up more than 180 degrees of the body
    left, right = (np.array([-0.6 * x - 0.2 * y - s, 0.8 * y - 0.2 * x, 1 + 0 * x]) for s in (-slope, slope))
    angle = np.arctan2(np.linalg.norm(np.cross(left, right, axis=0), axis=0), (left * right).sum(axis=0))
    folded = (np.array(beyond) >= 0) & (abs(x - 0.5) < 1e-12)
    assert folded.sum() == 2 and (np.array(beyond) >= 0).sum() == 6
    assert turn == pytest.approx(np.where(folded, np.sign(slope) * angle, 0), abs=1e-7)
