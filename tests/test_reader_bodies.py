"""The reader of meshes: gmsh's and Abaqus' files, cuts into simplices, groups by place, what FreeFEM reads. Calls alone."""

from itertools import product

import numpy as np
import pytest
from reader import Group, Refusal, Where, read_case
from reader.abaqus import listing, read_inp
from reader.bodies import with_split, write_bodies
from reader.mesh import CENTRES, EDGES, KINDS, Block, Mesh, MeshRefusal, alone, groups_of, sides_of
from reader.msh import read_msh
from reader.rows import rows
from reader.sides import Boundary, ElementSides, OnCylinder, pick_on_mesh, pick_sides
from reader.simplices import cut_to_simplices

# ---------------------------------------------------------------- meshes by hand

CORNERS = {
    8: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
    4: [(0, 0), (1, 0), (1, 1), (0, 1)],
}
PRISMS = ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))  # of a brick
PYRAMIDS = ((0, 1, 2, 3, 8), (4, 7, 6, 5, 8), (0, 4, 5, 1, 8), (1, 5, 6, 2, 8), (2, 6, 7, 3, 8), (0, 3, 7, 4, 8))


def places_of(kind, corners):
    """The nodes of an element by its corners: middles of edges, sides, centre."""
    of = KINDS[kind]
    found = list(corners)
    if of.second:
        found += [(corners[int(a)] + corners[int(b)]) / 2 for a, b in EDGES[of[:2]].split()]
    by_node = {node: name for name, node in CENTRES.get(kind, {}).items()}
    found += [np.mean([corners[int(c)] for c in by_node[node]], axis=0) for node in sorted(by_node)]
    if len(found) < of.nodes:
        found.append(np.mean(corners, axis=0))
    return found


def grid(kind, cells, shape=lambda p: p, turn=None):
    """cells (nx, ny, nz) of the unit cube in elements of one kind, bent by `shape`; turn: numbers its nodes anew."""
    of, known, rows_ = KINDS[kind], {}, []
    for cell in product(*map(range, cells)):
        whole = [(np.array(cell) + c) / np.array(cells) for c in CORNERS[8 if of.dimension == 3 else 4]]
        whole.append(np.mean(whole, axis=0))
        parts = {8: [range(8)], 6: PRISMS, 5: PYRAMIDS, 4: [range(4)]}[of.corners]
        for part in parts:
            nodes = places_of(kind, [whole[k] for k in part])
            rows_.append([known.setdefault(tuple(np.round(p, 9)), len(known)) for p in nodes])
    order = np.arange(len(known)) if turn is None else np.random.default_rng(turn).permutation(len(known))
    places = np.empty((len(known), 3))
    places[order] = [shape(np.array(p)) for p in known]
    count = len(rows_)
    ones = np.ones(count, np.int64)
    block = Block(kind, order[np.array(rows_)], np.arange(1, count + 1), np.arange(1, count + 1), ones, ones)
    return Mesh(places, np.arange(1, len(known) + 1), [block], {(of.dimension, 1): "part"})


def shell(p):
    """A quarter of a pipe from radius 1 to 2."""
    r, angle = 1 + p[0], p[1] * np.pi / 2
    return np.array([r * np.cos(angle), r * np.sin(angle), p[2]])


def skewed(p):
    return np.array([[1, 0.3, 0.1], [0, 1.2, 0.2], [0.1, 0, 0.9]]) @ p


def volume(mesh):
    """Of tetrahedra of either order; a rule of degree 3 is exact for quadratic maps."""
    total = 0.0
    points = [((1 / 4,) * 4, -4 / 5)]
    points += [(tuple(1 / 2 if k == j else 1 / 6 for k in range(4)), 9 / 20) for j in range(4)]
    for block in mesh.blocks:
        x = mesh.places[block.nodes]
        for b, weight in points:
            slopes = [[(4 * b[k] - 1 if block.of.second else 1) * (k == c) for c in range(4)] for k in range(4)]
            if block.of.second:
                for edge in EDGES[3, 4].split():
                    i, j = map(int, edge)
                    slopes.append([4 * b[j] * (c == i) + 4 * b[i] * (c == j) for c in range(4)])
            slope = np.array(slopes, float)
            jacobian = np.einsum("enk,nd->ekd", x, slope[:, 1:] - slope[:, :1])
            total += weight * np.linalg.det(jacobian).sum() / 6
    return total


def conforms(mesh):
    """Each side bounds one element, or two with the same middles, and each edge has one middle."""
    seen = {}
    for side in sides_of(mesh, mesh.blocks):
        for nodes in side.nodes.tolist():
            seen.setdefault(frozenset(nodes[:3]), []).append(frozenset(nodes))
    assert all(len(found) <= 2 and len(set(found)) == 1 for found in seen.values())
    edges = {}
    for block in mesh.blocks:
        for k, (a, b) in enumerate(EDGES[block.of[:2]].split()):
            for row in block.nodes:
                edges.setdefault(frozenset((row[int(a)], row[int(b)])), set()).add(int(row[block.of.corners + k]))
    assert all(len(found) == 1 for found in edges.values())


SOLIDS = [5, 6, 7, 12, 13, 14, 17, 18, 19]


@pytest.mark.parametrize("kind", SOLIDS)
@pytest.mark.parametrize("turn", [None, 1, 2])
def test_cut_is_exact(kind, turn):
    """Straight solids fill their volume; the middles of new edges are in their middles, whatever the nodes' numbers."""
    mesh = cut_to_simplices(grid(kind, (2, 2, 1), skewed, turn))
    total = abs(np.linalg.det(np.array([skewed(e) for e in np.eye(3)])))
    (block,) = mesh.blocks
    assert block.kind == (11 if KINDS[kind].second else 4)
    x = mesh.places[block.nodes[:, :4]]
    sizes = np.abs(np.linalg.det(x[:, 1:] - x[:, :1])) / 6
    assert sizes.sum() == pytest.approx(total, rel=1e-12) and sizes.min() > 0
    if KINDS[kind].second:
        conforms(mesh)
        for k, (a, b) in enumerate(EDGES[3, 4].split()):
            assert mesh.places[block.nodes[:, 4 + k]] == pytest.approx((x[:, int(a)] + x[:, int(b)]) / 2, abs=1e-13)


@pytest.mark.parametrize("kind", [12, 13, 17, 18])
def test_cut_of_a_pipe(kind):
    """Sides fit, the volume converges with the fourth power, nodes of the file stay on the surface."""
    off = []
    for n in (3, 6):
        mesh = grid(kind, (1, n, 1), shell, 3)
        made = cut_to_simplices(mesh)
        turned = made.blocks[0].nodes
        sizes = np.linalg.det((made.places[turned[:, 1:4]] - made.places[turned[:, :1]]))
        flipped = sizes < 0
        turned[flipped] = turned[flipped][:, [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]]
        conforms(made)
        assert made.places[: len(mesh.places)] == pytest.approx(mesh.places, abs=0)
        off.append(abs(volume(made) / (3 * np.pi / 4) - 1))
        radius = np.linalg.norm(made.places[:, :2], axis=1)
        assert radius[np.abs(radius - 2) < 0.2] == pytest.approx(2, rel=1e-12)
    assert off[1] < off[0] / 10 and off[1] < 1e-4


@pytest.mark.parametrize("kind", [3, 10, 16])
def test_quadrangles(kind):
    made = cut_to_simplices(grid(kind, (3, 2), lambda p: np.array([*p, 0]), 4))
    (block,) = made.blocks
    x = made.places[block.nodes[:, :3]]
    sizes = np.abs(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])[:, 2]) / 2
    assert block.kind == (9 if KINDS[kind].second else 2) and len(sizes) == 12
    assert sizes == pytest.approx(np.full(12, 1 / 12))
    if kind != 3:
        assert made.places[block.nodes[:, 3]] == pytest.approx((x[:, 0] + x[:, 1]) / 2)


def test_centre_of_a_bent_side():
    """The new node of a side is its quadratic map's, the same from both bricks; of 27 nodes it is the file's."""
    made = cut_to_simplices(grid(17, (2, 1, 1), shell))
    bent = grid(17, (2, 1, 1), shell).places
    assert len(made.places) == len(bent) + 11 + 2  # one for each side, one for each brick
    inner = [p for p in made.places[len(bent) :] if abs(p[2] - 0.5) < 1e-9 and np.linalg.norm(p[:2]) < 1.1]
    corners = np.array([shell(np.array([0, y, z])) for y in (0, 1) for z in (0, 1)])
    middles = np.array([shell(np.array([0, y, z])) for y, z in ((0, 0.5), (1, 0.5), (0.5, 0), (0.5, 1))])
    assert np.array(inner) == pytest.approx(np.array([middles.sum(axis=0) / 2 - corners.sum(axis=0) / 4]))
    assert len(cut_to_simplices(grid(12, (2, 1, 1), shell)).places) == len(grid(12, (2, 1, 1), shell).places)
