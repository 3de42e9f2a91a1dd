"""Surfaces of any shape in the plane: chains, splines, what lies opposite, the true distance, turned problems."""

from itertools import pairwise

import numpy as np
import pytest
from freefem import ROOT, data, run, snippet, told
from input.test_parts import Mesh, block, solve, turn

MIRROR = np.diag([-1.0, 1, 1])


def ring(mesh, inner, outer, edges, layers, name, groups, phase=0.0, at=0.0):
    """A ring of triangles about (at, 0), with the names of its inner and outer boundary."""
    radii = np.linspace(inner, outer, layers + 1)
    angles = phase + 2 * np.pi * np.arange(edges) / edges
    nodes = [(at + r * np.cos(a), r * np.sin(a), 0) for r in radii for a in angles]

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


POINTS = data("surfaces/points.edp")


def pairs(folder, mesh, case, *flags, more="", order=2):
    """The contact points of a case: {name: numbers}; the gap is positive where there is one."""
    (folder / "a.msh").write_text(mesh)
    (folder / "a.case").write_text(case)
    text = (ROOT / "edp/parts.edp").read_text().split("checkOpposingSurfaces();")[0] + POINTS + more
    values = told(snippet(folder, text, "-mesh", "a.msh", "-case", "a.case", "-order", order, *flags))
    return {**values, "gap": -values["gap"]}


# ---------------------------------------------------------------- geometry

RINGS = "body inner E 100 nu 0.3\nbody outer E 100 nu 0.3\ncontact bore pin\nclamp rim\n"


def rings(edges, ratio=1.31, gap=0.05, phase=0.1, mesh=None, tag="", at=0.0):
    """A ring in a ring, closed boundaries whose meshes do not match; `tag` ends the names of further ones."""
    mesh = ring(mesh or Mesh(), 10 + gap, 14, edges, 3, f"outer{tag}", (f"bore{tag}", f"rim{tag}"), at=at)
    return ring(mesh, 7, 10, round(ratio * edges), 3, f"inner{tag}", (f"hole{tag}", f"pin{tag}"), phase, at)


def test_gap_of_circles(tmp_path):
    """From meshed circles the gap shall be that of the circles, the error falling like h^6; from facets it does not.

    Where they overlap by 1e-4 of their radius, 180 edges, meshes rotated: the overlap to 1e-3, all round.
    """
    mesh, case, sizes, far = Mesh(), "", (24, 48, 96), 40
    for k, edges in enumerate(sizes):
        rings(edges, mesh=mesh, tag=k, at=far * k)
    rings(180, ratio=1.0, gap=-1e-3, phase=0.01, mesh=mesh, tag=3, at=far * 3)
    for k in range(4):
        case += f"body inner{k} E 100 nu 0.3\nbody outer{k} E 100 nu 0.3\ncontact bore{k} pin{k}\nclamp rim{k}\n"
    values = pairs(tmp_path, mesh.text(), case)
    assert (values["closed"] == [1, 1, 1, 1]).all() and values["corners"] == 0 and values["paired"].all()
    assert values["correction"] == pytest.approx(10.05 * (1 - np.cos(np.pi / 24)), rel=1e-2)
    x, y, gap, normal_x, normal_y, along, contact = (
        values[name] for name in ("x", "y", "gap", "normalX", "normalY", "along", "contact")
    )
    worst = {}
    for k, edges in enumerate(sizes):
        of = contact == k
        worst[edges] = abs(gap[of] - 0.05).max()
        angle = np.arctan2(y[of], x[of] - far * k)
        assert abs(normal_x[of] * np.cos(angle) + normal_y[of] * np.sin(angle) + 1).max() < 0.02 / edges**2
        assert np.diff(along[of]).min() > 0
    assert worst[48] < worst[24] / 40 and worst[96] < worst[48] / 40 and worst[96] < 1e-9
    np.testing.assert_allclose(-gap[contact == 3], 1e-3, rtol=1e-3)
    nodal = pairs(tmp_path, rings(180, ratio=1.0, gap=-1e-3, phase=0.01).text(), RINGS, "-points", "nodal")
    assert nodal["paired"].all()
    np.testing.assert_allclose(-nodal["gap"], 1e-3, rtol=1e-3)
    facets = pairs(tmp_path, rings(96).text(), RINGS, "-surface", "facets")
    assert abs(facets["gap"] - 0.05).max() > 1e-3


RUNS = data("surfaces/runs.edp")


def test_runs(tmp_path):
    """Runs of curved spans, closed and open, among lines, in any order: what walks along them finds."""
    text, known = "", []
    for last in (10, 16, 25):  # the place of the last span: in a closed run, before an open one, in it
        order = list(np.random.default_rng(3).permutation(59))
        order.insert(last, 59)
        lines = {order[k] for k in (20, 31, 32, 59)}
        bounds = [0, 7, 8, 16, 40, 43, 60]  # the first three are closed, one of them of one span; the others begin anew
        before = dict.fromkeys(order, 60)
        for k, (first, end) in enumerate(pairwise(bounds)):
            before |= {order[i]: order[i - 1 if i > first else end - 1] for i in range(first + (k > 2), end)}
        text += "\n".join(["60", *(f"{before[k]} {int(k in lines)}" for k in range(60)), ""])

        def walk(k, before=before, lines=lines):
            """The spans of its run before this one; of a closed run back to its least."""
            way = [k]
            while not {way[-1], before[way[-1]]} & {60, *lines} and before[way[-1]] != k:
                way.append(before[way[-1]])
            return way if before[way[-1]] != k or k in lines else way[: way.index(min(way)) + 1]

        heads = sorted({walk(k)[-1] for k in range(60) if k not in lines})
        number = [0 if k in lines else 1 + heads.index(walk(k)[-1]) for k in range(60)]
        known += [number, [0 if k in lines else len(walk(k)) - 1 for k in range(60)], np.bincount(number).tolist()]
    (tmp_path / "before.txt").write_text(text)
    values = pairs(tmp_path, rings(24).text(), RINGS, more=RUNS)
    assert [values[f"{name}{c}"].tolist() for c in range(3) for name in ("run", "before", "size")] == known


CURVED = data("surfaces/curved.edp")


@pytest.mark.parametrize("order", [2, 4])
def test_curved_elements(tmp_path, order):
    """Rigid motions of curved elements shall be without stress, points and loads those of the circles."""
    loads = RINGS + "pressure bore 5\nweight inner 0 -1\n"
    values = pairs(tmp_path, rings(24).text(), loads, more=CURVED, order=order)
    assert values["swelling"] == pytest.approx(5 * 2 * np.pi * 10.05**2, rel=2e-5)  # parabolas: 1.0e-5
    assert values["weighs"] == pytest.approx(-np.pi * (10**2 - 7**2), rel=2e-5)
    assert values["curved"] == 2 * (24 + 31) and 0.5 < values["stretch"] < 1
    assert abs(values["rigid"]).max() < 1e-10  # rounding of terms of 1e4
    assert values["weight"].sum() == pytest.approx(2 * np.pi * 10.05, rel=1e-5)
    assert np.hypot(values["x"], values["y"]) == pytest.approx(10.05, rel=1e-6 if order == 2 else 2e-4)
    if order == 2:
        facets = pairs(tmp_path, rings(24).text(), RINGS, "-surface", "facets", more=CURVED, order=order)
        assert facets["curved"] == 0 and abs(facets["rigid"]).max() < 1e-10


def test_folded_elements(tmp_path):
    """Elements too flat for their side's bow shall stay straight, and it is said."""
    mesh = ring(Mesh(), 10.05, 10.06, 24, 1, "outer", ("bore", "rim"))
    mesh = ring(mesh, 7, 10, 31, 3, "inner", ("hole", "pin"), 0.1)
    done = solve(tmp_path, mesh.text(), RINGS + "weight inner 0 -1\n", "-check", 1, "-order", 2)
    assert "24 elements beside a smooth surface are too flat to follow it" in done.stdout


def stadium(edges):
    """A slot of two straight sides and two half circles of radius 2 about (-3, 0) and (3, 0)."""
    arc = np.linspace(-np.pi / 2, np.pi / 2, edges + 1)
    outline = [(3 + 2 * np.cos(a), 2 * np.sin(a)) for a in arc]
    outline += [(x, 2.0) for x in np.linspace(3, -3, edges + 1)[1:-1]]
    outline += [(-3 - 2 * np.cos(a), -2 * np.sin(a)) for a in arc]
    outline += [(x, -2.0) for x in np.linspace(-3, 3, edges + 1)[1:-1]]
    return np.array(outline)


def outlined(mesh, outline, at, tag, matrix):
    """A body between an outline and its image of half the size, turned: their boundaries' names."""
    n = len(outline)
    nodes = [matrix @ (*p, 0) + [at, 0, 0] for p in (*outline, *(0.5 * outline))]
    sides = [(f"edge{tag}", (j, (j + 1) % n)) for j in range(n)]
    sides += [(f"inside{tag}", (n + (j + 1) % n, n + j)) for j in range(n)]
    bodies = []
    for j in range(n):
        a, b, c, d = j, (j + 1) % n, n + (j + 1) % n, n + j
        bodies += [(f"block{tag}", (a, b, c)), (f"block{tag}", (a, c, d))]
    mesh.add(nodes, sides, bodies)


PLACES = data("surfaces/places.edp")


def test_straight_round_and_sharp(tmp_path):
    """A straight side beside a round end shall stay straight, the end round, corners sharp, a polygon a circle.

    The square's sides are a chain each, with two points at a corner.
    """
    side = np.linspace(-1, 1, 6)[:-1]
    square = [(s, -1.0) for s in side] + [(1.0, s) for s in side]
    square += [(-s, 1.0) for s in side] + [(-1.0, -s) for s in side]
    angles = 2 * np.pi * np.arange(20) / 20
    shapes = [(stadium(12), 0), (stadium(12), 0.7), (np.array(square), 0.3), (np.c_[np.cos(angles), np.sin(angles)], 0)]
    mesh, case, far = Mesh(), "", 20
    for k, (outline, angle) in enumerate(shapes):
        outlined(mesh, outline, far * k, k, turn(angle))
        case += f"body block{k} E 100 nu 0.3\nclamp inside{k}\nobstacle edge{k} plane 0 90 0 -1\n"
    values = pairs(tmp_path, mesh.text(), case, more=PLACES)

    def places(k):
        """Of points on the edges, as if the shape stood upright about the origin."""
        own = abs(values["px"] - far * k) < far / 2
        return turn(-shapes[k][1])[:2, :2] @ [values["px"][own] - far * k, values["py"][own]]

    for x, y in map(places, (0, 1)):
        straight = abs(x) < 2.95
        np.testing.assert_allclose(abs(y[straight]), 2, rtol=0, atol=1e-13)
        np.testing.assert_allclose(np.hypot(abs(x) - 3, y)[~straight], 2, rtol=2e-4)
    np.testing.assert_allclose(abs(places(2)).max(axis=0), 1, rtol=1e-13)
    np.testing.assert_allclose(np.hypot(*places(3)), 1, rtol=1e-4)
    chain, own = values["chain"].astype(int), values["contact"] == 2
    assert values["corners"] == 4 and own.sum() == 4 * 11
    assert len(values["closed"]) == 7
    for k in range(4):
        assert (values["closed"][chain[values["contact"] == k]] == (k != 2)).all()
    lengths = np.bincount(chain[own], values["weight"][own])
    np.testing.assert_allclose(lengths[lengths > 0], [2, 2, 2, 2], rtol=1e-12)


def test_what_faces_away(tmp_path):
    """Only sides that face each other shall pair; an obstacle's points are a set of their own."""
    mesh = block(Mesh(), (4, 1), (8, 2), prefix="low-", name="low")
    block(mesh, (2, 1), (5, 2), (1, 1.25), prefix="up-", name="up")
    text = mesh.text(turn(0.4))
    case = "body low E 1 nu 0\nbody up E 1 nu 0\ncontact low-top up-bottom\nobstacle low-top plane 0 0 1 0\n"
    case += "contact low-left up-left\ncontact up-left low-right\ncontact low-bottom up-top\n"
    values = pairs(tmp_path, text, case, "-points", "nodal")
    first, plane, sideways = (values["contact"] == 0, values["contact"] == 1, values["contact"] > 1)
    x, _ = turn(-0.4)[:2, :2] @ [values["x"], values["y"]]
    assert first.sum() == plane.sum() == 17
    inside = abs(x - 2) < 1 + 1e-9
    assert (values["paired"][first] == inside[first]).all()
    np.testing.assert_allclose(values["gap"][first & inside], 0.25, rtol=1e-12)
    # the plane's free side is x > 0, the surface's normal (-sin 0.4, cos 0.4) looks to it
    np.testing.assert_allclose(values["gap"][plane], values["x"][plane], rtol=0, atol=1e-12)
    np.testing.assert_allclose(values["normalX"][plane], -1)
    assert sideways.any() and not values["paired"][sideways].any()


# ---------------------------------------------------------------- results

PATCH = data("surfaces/patch.case")


@pytest.mark.parametrize(
    "order, matrix",
    [(1, MIRROR @ turn(1)), (4, turn(2.5)), (2, MIRROR)],
    ids=["P1 mirrored", "P4 turned", "P2 mirrored"],
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
    [
        ("weight inner", []),
        ("weight inner", ["-points", "nodal"]),
        ("move hole", ["-distance", "exact"]),
    ],
    ids=["linear", "nodal", "exact"],
)
def test_turned(tmp_path, load, flags):
    """A pin in a hole, pushed by its weight or moved, turned and mirrored: results to 1e-9, in the same steps."""
    found, counts, energies = [], [], []
    for matrix in (np.eye(3), MIRROR @ turn(2.5)):
        push = matrix @ ([1.0, -20.0, 0] if load == "weight inner" else [0.005, -0.1, 0])
        case = PIN + f"{load} {float(push[0])!r} {float(push[1])!r}\n"
        done = solve(tmp_path, mirrored(rings(28), matrix), case, "-tol", 1e-11, *flags)
        x, y = matrix[:2, :2].T @ [done.contact["x"], done.contact["y"]]
        order = np.argsort((np.arctan2(y, x) + 1e-6) % (2 * np.pi))
        found.append(done.contact["pressure"][order])
        counts.append(done.summary["newton"])
        energies.append(done.summary["energy"])
    one, other = found
    np.testing.assert_allclose(other, one, rtol=0, atol=1e-9 * other.max())
    assert len(set(counts)) == 1
    np.testing.assert_allclose(energies, energies[0], rtol=1e-9)


@pytest.mark.parametrize("order, h, points", [(1, 1, "nodal"), (2, 0.5, "segment")])
def test_true_distance_has_an_energy(order, h, points):
    """With the true distance the energy's derivative in the approach shall be the force, to 1e-6 (here 1e-8)."""

    def at(u0):
        flags = ["-h", h, "-order", order, "-points", points, "-Eratio", 2, "-tol", 1e-12]
        return run("meshed-disc", *flags, "-distance", "exact", "-u0", u0).summary

    step = 0.005
    below, here, above = (at(2.5 + k * step) for k in (-1, 0, 1))
    slope = (above["energy"] - below["energy"]) / (2 * step)
    third = (above["force"] - 2 * here["force"] + below["force"]) / 6  # what the finite difference leaves out
    assert slope - third == pytest.approx(here["force"], rel=1e-8)


def test_two_meshes_tend_to_the_rigid_disc():
    """The stiffer the meshed disc, the nearer the rigid one's force under the true distance, like 1/Eratio."""
    exact = ["-h", 0.5, "-distance", "exact", "-order", 2, "-tol", 1e-10]
    rigid = run("disc-on-block", *exact).force
    off = [run("meshed-disc", *exact, "-Eratio", ratio).force / rigid - 1 for ratio in (1e3, 1e5)]
    assert off[0] == pytest.approx(100 * off[1], rel=0.05) and abs(off[1]) < 1e-4


def test_force_and_back():
    """The force that an approach takes shall give that approach again, to 1e-9, with the true distance."""
    flags = ["-distance", "exact", "-tol", 1e-11, "-h", 0.5]
    there = run("disc-on-block", *flags)
    back = run("disc-on-block", *flags, "-force", there.force)
    assert back.summary["approach"] == pytest.approx(2.5, rel=1e-9)
