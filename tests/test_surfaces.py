"""Surfaces of any shape in the plane: chains, splines, what lies opposite, the true distance, turned problems."""

import numpy as np
import pytest
from freefem import ROOT, run_in, script, snippet, told
from test_parts import Mesh, block, solve, turn

MIRROR = np.diag([-1.0, 1, 1])


def ring(mesh, inner, outer, edges, layers, name, groups, phase=0.0):
    """A ring of triangles about the origin, with the names of its inner and outer boundary."""
    radii = np.linspace(inner, outer, layers + 1)
    angles = phase + 2 * np.pi * np.arange(edges) / edges
    nodes = [(r * np.cos(a), r * np.sin(a), 0) for r in radii for a in angles]

    def number(i, j):
        return edges * i + j % edges

    sides = [(groups[0], (number(0, j + 1), number(0, j))) for j in range(edges)]
    sides += [(groups[1], (number(layers, j), number(layers, j + 1))) for j in range(edges)]
    bodies = []
    for i in range(layers):
        for j in range(edges):
            a, b, c, d = number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)
            bodies += [(name, (a, b, c)), (name, (a, c, d))]
    mesh.add(nodes, sides, bodies)
    return mesh


POINTS = """
real[int] seen(points);
tell("x", pointX);
tell("y", pointY);
tell("normalX", normalX);
tell("normalY", normalY);
tell("gap", overlapBefore);
tell("weight", weight);
tell("along", along);
for (int i = 0; i < points; i++) seen[i] = paired[i];
tell("paired", seen);
for (int i = 0; i < points; i++) seen[i] = contactOf[i];
tell("contact", seen);
for (int i = 0; i < points; i++) seen[i] = chainOf[i];
tell("chain", seen);
real[int] closed(chainClosed.n);
for (int i = 0; i < chainClosed.n; i++) closed[i] = chainClosed[i];
tell("closed", closed);
tell("correction", correctionMost);
tell("corners", sharpCorners);
"""


def pairs(folder, mesh, case, *flags, more="", order=2):
    """The contact points of a case: {name: numbers}; the gap is positive where there is one."""
    (folder / "a.msh").write_text(mesh)
    (folder / "a.case").write_text(case)
    text = (ROOT / "edp/parts.edp").read_text().split("checkTouched();")[0] + POINTS + more
    values = told(snippet(folder, text, "-mesh", "a.msh", "-case", "a.case", "-order", order, *flags))
    return {**values, "gap": -values["gap"]}


# ---------------------------------------------------------------- geometry

RINGS = "body inner E 100 nu 0.3\nbody outer E 100 nu 0.3\ncontact bore pin\nclamp rim\n"


def rings(edges, ratio=1.31, gap=0.05, phase=0.1):
    """A ring in a ring, closed boundaries whose meshes do not match."""
    mesh = ring(Mesh(), 10 + gap, 14, edges, 3, "outer", ("bore", "rim"))
    return ring(mesh, 7, 10, round(ratio * edges), 3, "inner", ("hole", "pin"), phase)


def test_gap_of_circles(tmp_path):
    """From meshed circles the gap shall be that of the circles, the error falling like h^6; from facets it does not."""
    worst = {}
    for edges in (24, 48, 96):
        values = pairs(tmp_path, rings(edges).text(), RINGS)
        assert values["closed"] == [1] and values["corners"] == 0 and values["paired"].all()
        worst[edges] = abs(values["gap"] - 0.05).max()
        angle = np.arctan2(values["y"], values["x"])
        assert abs(values["normalX"] * np.cos(angle) + values["normalY"] * np.sin(angle) + 1).max() < 0.02 / edges**2
        assert np.diff(values["along"]).min() > 0
        assert values["correction"] == pytest.approx(10.05 * (1 - np.cos(np.pi / edges)), rel=1e-2)
    assert worst[48] < worst[24] / 40 and worst[96] < worst[48] / 40 and worst[96] < 1e-9
    facets = pairs(tmp_path, rings(96).text(), RINGS, "-surface", "facets")
    assert abs(facets["gap"] - 0.05).max() > 1e-3


@pytest.mark.parametrize("points", ["nodal", "segment"])
def test_press_fit_gap(tmp_path, points):
    """Two rings that overlap by 1e-4 of their radius, 180 edges, meshes rotated: the overlap to 1e-3, all round."""
    values = pairs(tmp_path, rings(180, ratio=1.0, gap=-1e-3, phase=0.01).text(), RINGS, "-points", points)
    assert values["paired"].all()
    np.testing.assert_allclose(-values["gap"], 1e-3, rtol=1e-3)


CURVED = """
real[int] unit(ndof);
real[int] reaction(ndof);
real[int] worst(3);
for (int k = 0; k < 3; k++)
{
    for (int d = 0; d < ndof; d++)
        unit[d] = k == 0 ? ofComponent(d, 0) : (k == 1 ? ofComponent(d, 1) : ofComponent(d, 1) * dofPlaces(d, 0)
            - ofComponent(d, 0) * dofPlaces(d, 1));
    reaction = elasticStiffness * unit;
    worst[k] = reaction.linfty;
}
tell("rigid", worst);
for (int d = 0; d < ndof; d++) unit[d] = dofPlaces(d, 0) * ofComponent(d, 0) + dofPlaces(d, 1) * ofComponent(d, 1);
tell("swelling", wholeLoad' * unit);
for (int d = 0; d < ndof; d++) unit[d] = ofComponent(d, 1);
tell("weighs", wholeLoad' * unit);
tell("curved", curvedElements);
tell("stretch", leastStretch);
"""


@pytest.mark.parametrize("order", [2, 4])
def test_curved_elements(tmp_path, order):
    """Rigid motions of curved elements shall be without stress, points and loads those of the circles."""
    loads = RINGS + "pressure bore 5\nweight inner 0 -1\n"
    values = pairs(tmp_path, rings(24).text(), loads, more=CURVED, order=order)
    assert values["swelling"] == pytest.approx(5 * 2 * np.pi * 10.05**2, rel=2e-5)  # parabolas: 1.0e-5
    hole = 31 / 2 * 7**2 * np.sin(2 * np.pi / 31)
    assert values["weighs"] == pytest.approx(-(np.pi * 10**2 - hole), rel=2e-5)
    assert values["curved"] == 24 + 31 and 0.5 < values["stretch"] < 1
    assert abs(values["rigid"]).max() < 1e-10  # rounding of terms of 1e4
    assert values["weight"].sum() == pytest.approx(2 * np.pi * 10.05, rel=1e-5)
    assert np.hypot(values["x"], values["y"]) == pytest.approx(10.05, rel=1e-6 if order == 2 else 2e-4)
    facets = pairs(tmp_path, rings(24).text(), RINGS, "-surface", "facets", more=CURVED, order=order)
    assert facets["curved"] == 0 and abs(facets["rigid"]).max() < 1e-10


def test_folded_elements(tmp_path):
    """Elements too flat for their side's bow shall stay straight, and it is said."""
    mesh = ring(Mesh(), 10.05, 10.06, 24, 1, "outer", ("bore", "rim"))
    mesh = ring(mesh, 7, 10, 31, 3, "inner", ("hole", "pin"), 0.1)
    run = solve(tmp_path, mesh.text(), RINGS + "weight inner 0 -1\n", "-check", 1, "-order", 2)
    assert "24 elements beside a smooth surface are too flat to follow it" in run.stdout


def stadium(edges):
    """A slot of two straight sides and two half circles of radius 2 about (-3, 0) and (3, 0)."""
    arc = np.linspace(-np.pi / 2, np.pi / 2, edges + 1)
    outline = [(3 + 2 * np.cos(a), 2 * np.sin(a)) for a in arc]
    outline += [(x, 2.0) for x in np.linspace(3, -3, edges + 1)[1:-1]]
    outline += [(-3 - 2 * np.cos(a), -2 * np.sin(a)) for a in arc]
    outline += [(x, -2.0) for x in np.linspace(-3, 3, edges + 1)[1:-1]]
    return np.array(outline)


def outlined(outline, name="block", group="edge", scale=0.5):
    """A body between an outline and its smaller image: their boundaries' names."""
    n = len(outline)
    nodes = [(*p, 0) for p in outline] + [(*p, 0) for p in scale * outline]
    sides = [(group, (j, (j + 1) % n)) for j in range(n)] + [("inside", (n + (j + 1) % n, n + j)) for j in range(n)]
    bodies = []
    for j in range(n):
        a, b, c, d = j, (j + 1) % n, n + (j + 1) % n, n + j
        bodies += [(name, (a, b, c)), (name, (a, c, d))]
    mesh = Mesh()
    mesh.add(nodes, sides, bodies)
    return mesh


PLACES = """
real[int] px(edges);
real[int] py(edges);
int[int] e(edges);
real[int] r(edges);
for (int k = 0; k < edges; k++) e[k] = k;
r = 0.3;
placesAt(e, r, px, py);
tell("px", px);
tell("py", py);
"""
SLOT = "body block E 100 nu 0.3\nclamp inside\nobstacle edge plane 0 9 0 -1\n"


@pytest.mark.parametrize("angle", [0, 0.7])
def test_lines_stay_straight(tmp_path, angle):
    """Beside a round end a straight side shall stay straight, and the round end a circle up to it."""
    values = pairs(tmp_path, outlined(stadium(12)).text(turn(angle)), SLOT, more=PLACES)
    x, y = (turn(-angle)[:2, :2] @ [values["px"], values["py"]]).round(15)
    straight = abs(x) < 2.95
    np.testing.assert_allclose(abs(y[straight]), 2, rtol=0, atol=1e-13)
    np.testing.assert_allclose(np.hypot(abs(x) - 3, y)[~straight], 2, rtol=2e-4)
    assert values["corners"] == 0 and values["closed"] == [1]


def test_corners_stay_sharp(tmp_path):
    """A square shall have four chains, straight, with two points at a corner; a polygon of 20 edges is a circle."""
    side = np.linspace(-1, 1, 6)[:-1]
    square = [(s, -1.0) for s in side] + [(1.0, s) for s in side]
    square += [(-s, 1.0) for s in side] + [(-1.0, -s) for s in side]
    values = pairs(tmp_path, outlined(np.array(square)).text(turn(0.3)), SLOT)
    assert values["corners"] == 4 and values["correction"] < 1e-14
    assert len(values["closed"]) == 4 and not values["closed"].any()
    assert len(values["x"]) == 4 * 11
    np.testing.assert_allclose(np.bincount(values["chain"].astype(int), values["weight"]), 2, rtol=1e-12)
    angles = 2 * np.pi * np.arange(20) / 20
    values = pairs(tmp_path, outlined(np.c_[np.cos(angles), np.sin(angles)]).text(), SLOT, more=PLACES)
    assert values["corners"] == 0 and values["closed"] == [1]
    np.testing.assert_allclose(np.hypot(values["px"], values["py"]), 1, rtol=1e-4)


def test_what_faces_away(tmp_path):
    """Only sides that face each other shall pair; an obstacle's points are a set of their own."""
    mesh = block(Mesh(), (4, 1), (8, 2), prefix="low-", name="low")
    block(mesh, (2, 1), (5, 2), (1, 1.25), prefix="up-", name="up")
    text = mesh.text(turn(0.4))
    case = "body low E 1 nu 0\nbody up E 1 nu 0\nclamp low-bottom\nclamp up-top\n"
    case += "contact low-top up-bottom\nobstacle low-top plane 0 0 1 0\n"
    values = pairs(tmp_path, text, case, "-points", "nodal")
    first = values["contact"] == 0
    x, _ = turn(-0.4)[:2, :2] @ [values["x"], values["y"]]
    assert first.sum() == (~first).sum() == 17
    inside = abs(x - 2) < 1 + 1e-9
    assert (values["paired"][first] == inside[first]).all()
    np.testing.assert_allclose(values["gap"][first & inside], 0.25, rtol=1e-12)
    # the plane's free side is x > 0, the surface's normal (-sin 0.4, cos 0.4) looks to it
    np.testing.assert_allclose(values["gap"][~first], values["x"][~first], rtol=0, atol=1e-12)
    np.testing.assert_allclose(values["normalX"][~first], -1)
    sideways = "contact low-left up-left\ncontact up-left low-right\ncontact low-bottom up-top\n"
    case = case.replace("contact low-top up-bottom\n", sideways).replace(
        "clamp low-bottom\nclamp up-top", "clamp up-bottom"
    )
    values = pairs(tmp_path, text, case)
    assert not values["paired"][values["contact"] < 3].any()


# ---------------------------------------------------------------- results

PATCH = """body low E 210 nu 0.3
body up E 70 nu 0.2
symmetry low-bottom
symmetry low-left
symmetry up-left
contact low-top up-bottom
pressure up-top 5
"""


@pytest.mark.parametrize(
    "order, matrix", [(1, turn(0)), (2, turn(2.5)), (4, MIRROR @ turn(1))], ids=["P1", "P2 turned", "P4 mirrored"]
)
def test_patch(tmp_path, order, matrix):
    """A uniform pressure shall go through two different meshes in any direction, to 1e-10."""
    mesh = block(Mesh(), (4, 2), (7, 4), prefix="low-", name="low")
    block(mesh, (4, 2), (11, 5), (0, 2.125), prefix="up-", name="up")
    done = solve(tmp_path, mirrored(mesh, matrix), PATCH, "-order", order, "-tol", 1e-12)
    np.testing.assert_allclose(done.contact["pressure"], 5, rtol=1e-10)


def mirrored(mesh, matrix):
    """A mesh's text with its places turned; in a mirror elements keep their sense."""
    if np.linalg.det(matrix) < 0:
        mesh.elements = [(kind, tag, corners[::-1]) for kind, tag, corners in mesh.elements]
    return mesh.text(matrix)


PIN = """body inner E 210e3 nu 0.3
body outer E 210e3 nu 0.3
contact bore pin
clamp rim
"""


@pytest.mark.parametrize(
    "load, flags",
    [("weight inner", []), ("weight inner", ["-points", "nodal"]), ("move hole", ["-distance", "exact"])],
    ids=["linear", "nodal", "exact"],
)
def test_turned(tmp_path, load, flags):
    """A pin in a hole, pushed by its weight or moved, turned and mirrored: results to 1e-9, in the same steps."""
    found, counts, energies = [], [], []
    for matrix in (np.eye(3), turn(2.5), MIRROR):
        push = matrix @ ([1.0, -20.0, 0] if load == "weight inner" else [0.005, -0.1, 0])
        case = PIN + f"{load} {float(push[0])!r} {float(push[1])!r}\n"
        done = solve(tmp_path, mirrored(rings(60), matrix), case, "-tol", 1e-11, *flags)
        x, y = matrix[:2, :2].T @ [done.contact["x"], done.contact["y"]]
        order = np.argsort((np.arctan2(y, x) + 1e-6) % (2 * np.pi))
        found.append(done.contact["pressure"][order])
        counts.append(done.summary["newton"])
        energies.append(done.summary["energy"])
    for pressure in found[1:]:
        np.testing.assert_allclose(pressure, found[0], rtol=0, atol=1e-9 * pressure.max())
    assert len(set(counts)) == 1
    np.testing.assert_allclose(energies, energies[0], rtol=1e-9)


@pytest.mark.parametrize("flags", [["-order", 1, "-points", "nodal"], ["-points", "segment"]], ids=["nodal", "segment"])
def test_true_distance_has_an_energy(tmp_path, flags):
    """With the true distance the energy's derivative in the approach shall be the force, to 1e-6 (here 1e-8)."""

    def at(u0):
        more = ["-h", 0.5, "-Eratio", 2, "-tol", 1e-12, "-distance", "exact", "-vtu", 0, "-u0", u0]
        return run_in(ROOT, script("meshed-disc"), *more, *flags, out=tmp_path / "out").summary

    step = 0.005
    below, here, above = (at(2.5 + k * step) for k in (-1, 0, 1))
    slope = (above["energy"] - below["energy"]) / (2 * step)
    third = (above["force"] - 2 * here["force"] + below["force"]) / 6  # what the finite difference leaves out
    assert slope - third == pytest.approx(here["force"], rel=1e-8)


def test_two_meshes_tend_to_the_rigid_disc(tmp_path):
    """The stiffer the meshed disc, the nearer the rigid one's force under the true distance, like 1/Eratio."""
    exact = ["-h", 0.5, "-distance", "exact", "-vtu", 0, "-tol", 1e-10]
    rigid = run_in(ROOT, script("disc-on-block"), *exact, out=tmp_path / "rigid").force
    off = []
    for ratio in (1e3, 1e5):
        stiff = run_in(ROOT, script("meshed-disc"), *exact, "-Eratio", ratio, out=tmp_path / "m")
        off.append(stiff.force / rigid - 1)
    assert off[0] == pytest.approx(100 * off[1], rel=0.05) and abs(off[1]) < 1e-4


def test_force_and_back(tmp_path):
    """The force that an approach takes shall give that approach again, to 1e-9, with the true distance."""
    flags = ["-distance", "exact", "-tol", 1e-11, "-h", 0.5, "-vtu", 0]
    there = run_in(ROOT, script("disc-on-block"), *flags, out=tmp_path / "a")
    back = run_in(ROOT, script("disc-on-block"), *flags, "-force", there.force, out=tmp_path / "b")
    assert back.summary["approach"] == pytest.approx(2.5, rel=1e-9)
