"""The reader of meshes: files of gmsh and Abaqus, cuts into simplices, groups by place, what FreeFEM reads."""

from itertools import product

import numpy as np
import pytest
from reader import Group, Refusal, Where, read_case
from reader.abaqus import listing, read_inp
from reader.bodies import write_bodies
from reader.grammar import ElementSides, OnCylinder
from reader.mesh import CENTRES, EDGES, KINDS, Block, Mesh, MeshRefusal, alone, groups_of, keys_of, sides_of
from reader.msh import read_msh
from reader.sides import Boundary, pick_on_mesh, pick_sides
from reader.simplices import cut_to_simplices
from reader.values import table

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
        sizes = np.linalg.det(made.places[turned[:, 1:4]] - made.places[turned[:, :1]])
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


# ---------------------------------------------------------------- what FreeFEM reads


PLANE = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
6
1 1 "base"
1 2 "top"
1 3 "foot"
1 4 "grip"
2 5 "low"
2 6 "high"
$EndPhysicalNames
$Nodes
8
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 1.01 0
6 1 1.01 0
7 1 2.01 0
8 0 2.01 0
$EndNodes
$Elements
8
1 1 2 1 11 1 2
2 1 2 2 12 3 4
3 1 2 3 13 5 6
4 1 2 4 14 7 8
5 2 2 5 1 1 2 3
6 2 2 5 1 1 4 3
7 2 2 6 2 5 6 7
8 2 2 6 2 5 7 8
$EndElements
"""
ALONE = PLANE.replace('2 6 "high"\n', "").replace("$PhysicalNames\n6", "$PhysicalNames\n5")
PRESSED = "body low E 1 nu 0.3\nbody high E 2 nu 0.3\ncontact foot top\nclamp base\nmove grip 0 -0.1\n"
SPACE = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
2 1 "base"
2 2 "side"
3 3 "part"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 0 0 -1
$EndNodes
$Elements
4
1 2 2 1 1 1 2 4
2 2 2 2 2 1 3 4
3 4 2 3 1 1 2 3 4
4 4 2 3 1 1 2 3 5
$EndElements
"""
STANDS = "body part E 1 nu 0.3\nclamp base\nobstacle side plane -1 0 0 1 0 0\n"


def made_of(folder, text, case, space=False, straight=False):
    """The run's files of a mesh's text, or a refusal."""
    (folder / "a.msh").write_text(text)
    mesh = read_msh(folder / "a.msh")
    read = read_case(case, Where(space=space), groups_of(mesh, space))
    written = write_bodies(pick_on_mesh(mesh, read), read, folder, space, straight)
    return {file.name: file.read_text() for file in folder.iterdir()}, written, read


def test_plane(tmp_path):
    """All of the boundary with its labels and curves; elements turned one way; regions and parts."""
    files, written, _ = made_of(tmp_path, PLANE, PRESSED)
    elements = files["mesh.msh"].split("$Elements\n")[1].split("\n")[:-2]
    assert elements[:5] == ["12", "1 1 2 5 5 1 2", "2 1 2 4 4 3 4", "3 1 2 3 3 5 6", "4 1 2 6 6 7 8"]
    assert elements[5:9] == ["5 1 2 7 7 2 3", "6 1 2 7 7 4 1", "7 1 2 7 7 6 7", "8 1 2 7 7 8 5"]
    assert elements[9:] == ["9 2 2 1 1 1 2 3", "10 2 2 1 1 1 3 4", "11 2 2 2 2 5 6 7", "12 2 2 2 2 5 7 8"]
    assert "\n5 0 1010000 0\n" in files["mesh.msh"] and files["curves"] == "11\n12\n13\n14\n0\n0\n0\n0\n"
    assert files["notes"] == "0\n" and "middles" not in files
    tail = "regions 2\n1 1\n2 2\nparts 2\nmiddles 0\nsame 0\ncuts 0\n"
    assert written.text.startswith("named <FieldData><Array") and written.text.endswith(tail)
    assert 'Name="bodies" NumberOfTuples="2" format="ascii">49 32 108 111 119 0 ' in written.text


@pytest.mark.parametrize("straight, many", [(False, 4), (True, 0)])
def test_middles_in_the_plane(tmp_path, straight, many):
    """Of second order each side has its middle; of straight bodies they say nothing."""
    nodes = "9 0.5 0 0\n10 1 0.5 0\n11 0.5 0.5 0\n12 0.5 1 0\n13 0 0.5 0\n"
    text = ALONE.split("$Elements")[0].replace("$Nodes\n8\n", "$Nodes\n13\n").replace("$EndNodes", nodes + "$EndNodes")
    text += "$Elements\n4\n1 8 2 1 11 1 2 9\n2 8 2 2 12 3 4 12\n"
    text += "5 9 2 5 1 1 2 3 9 10 11\n6 9 2 5 1 1 3 4 11 12 13\n$EndElements\n"
    case = "body low E 1 nu 0.3\nclamp base\nobstacle top plane 0 2 0 -1\n"
    files, written, _ = made_of(tmp_path, text, case, straight=straight)
    assert f"middles {many}\n" in written.text
    assert many == 0 or files["middles"] == "500000 0 0\n500000 1000000 0\n1000000 500000 0\n0 500000 0\n"
    bent, written, _ = made_of(tmp_path, text.replace("10 1 0.5", "10 1.1 0.5"), case, straight=straight)
    assert "middles 4\n" in written.text and "1100000 500000 0" in bent["middles"]


def test_rises(tmp_path):
    """In space: edges of the boundary with their middles, by the mesh itself or by one of its surfaces."""
    mesh = grid(17, (1, 3, 1), shell)
    read = read_case(
        "body part E 1 nu 0.3\nclamp base\nobstacle bore plane 0 0 3 0 0 -1\ngroup base plane 0 0 0 0 1 0\n"
        "group bore near 0.7 0.7 0.5\n", Where(space=True), groups_of(mesh, True)
    )  # fmt: skip
    written = write_bodies(pick_on_mesh(mesh, read), read, tmp_path, True)
    found = np.array([line.split() for line in (tmp_path / "rises").read_text().split("\n")[1:-1]], float)
    nodes = (tmp_path / "mesh.msh").read_text().split("$Nodes\n")[1].split("$EndNodes")[0].split("\n")[1:-1]
    places = np.array([line.split()[1:] for line in nodes], float)
    middles = (places[found[:, :2].astype(int)].mean(axis=1) + found[:, 2:]) / 1e6
    ends = np.linalg.norm(places[found[:, :2].astype(int)][..., :2] / 1e6, axis=2)
    on = np.abs(ends - 1).max(axis=1) < 1e-9
    assert on.sum() > 10 and np.linalg.norm(middles[on][:, :2], axis=1) == pytest.approx(1, abs=1e-9)
    assert "middles 8\n" in written.text and len((tmp_path / "middles").read_text().split("\n")) == 9


def test_order_of_the_file(tmp_path):
    """Elements of several kinds stay in the file's order; a quadrangle with a missing node is refused."""
    text = ALONE.replace(
        "5 2 2 5 1 1 2 3\n6 2 2 5 1 1 4 3\n7 2 2 6 2 5 6 7\n8 2 2 6 2 5 7 8",
        "5 3 2 5 1 5 6 7 8\n6 2 2 5 1 1 2 3\n7 2 2 5 1 1 4 3",
    )
    text = text.replace("$Elements\n8\n", "$Elements\n7\n")
    case = "body low E 1 nu 0.3\nclamp base\ncontact foot top\n"
    files, _, _ = made_of(tmp_path, text, case)
    solids = [line.split()[5:] for line in files["mesh.msh"].split("\n") if line.split()[1:3] == ["2", "2"]]
    assert solids == [["5", "6", "7"], ["5", "7", "8"], ["1", "2", "3"], ["1", "3", "4"]]
    with pytest.raises(MeshRefusal, match=r"element 5 \(line 29\): a node that is missing: 9"):
        made_of(tmp_path, text.replace("5 6 7 8\n", "5 6 7 9\n"), case)


@pytest.mark.parametrize("across", [False, True])
def test_rises_of_a_surface(tmp_path, across):
    """gmsh's mesh of the same surfaces has the middles, also along the other diagonal of a quadrangle."""
    flat = cut_to_simplices(grid(5, (1, 1, 1), shell))
    case = "body part E 1 nu 0.3\nclamp base\nobstacle bore plane 0 0 3 0 0 -1\ngroup base plane 0 0 0 0 1 0\n"
    case += "group bore box 0 0 0 1 1 1\n"
    where = np.round(flat.places, 9).tolist()
    ring = [where.index(np.round(shell(np.array(p)), 9).tolist()) for p in ((0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1))]
    ring = ring[1:] + ring[:1] if across else ring
    corners = flat.places[ring]
    middles = [shell(np.array([0, 0.5, z])) for z in (0, 0.5, 1)]
    nodes, elements = list(corners), []
    for a, b, c in ((0, 1, 2), (0, 2, 3)):
        pairs = ((a, b), (b, c), (c, a))
        middle = [(nodes[i] + nodes[j]) / 2 for i, j in pairs]
        bent = [
            middles[round(2 * m[2])] if abs(nodes[i][0] - nodes[j][0]) > 0.5 else m
            for m, (i, j) in zip(middle, pairs, strict=True)
        ]
        elements.append([a, b, c, *range(len(nodes), len(nodes) + 3)])
        nodes += bent
    two = np.array([1, 2])
    surface = Mesh(
        np.array(nodes), np.arange(1, 11), [Block(9, np.array(elements), two, two, two * 0 + 1, two * 0 + 7)]
    )
    read = read_case(case, Where(space=True), groups_of(flat, True))
    write_bodies(pick_on_mesh(flat, read), read, tmp_path, True, False, surface)
    found = np.array([line.split() for line in (tmp_path / "rises").read_text().split("\n")[1:-1]], float)
    high = np.linalg.norm(found[:, 2:], axis=1) / 1e6
    assert len(found) == 5 and sorted(high)[:2] == pytest.approx([0, 0], abs=1e-9)
    assert sorted(high)[2:] == pytest.approx([1 - np.sqrt(0.5)] * 3)


REFUSED = [
    # the file
    (PLANE, "", "an empty file, not gmsh's version 2 text format"),
    ("$MeshFormat\n2.2", "x\n2.2", "not gmsh's version 2 text format"),
    ("2.2 0 8", "4.1 0 8", "not gmsh's version 2 text format: version 4.1, binary 0"),
    ("2.2 0 8", "2.2 1 8", "not gmsh's version 2 text format: version 2.2, binary 1"),
    ("$Nodes\n8\n", "$Nodes\neight\n", "line 14: the number of lines of $Nodes is no number"),
    ("$Nodes\n8\n", "$Nodes\n9\n", "$Nodes has 8 lines, and says 9: cut off?"),
    ("$EndElements\n", "$EndElements\n$Nodes\n", "a second $Nodes (line 35)"),
    ("$EndElements\n", "", "cut off in $Elements"),
    ("\n1 0 0 0\n", "\n0 0 0 0\n", "line 15: the node 0; node numbers start at 1"),
    ("\n1 0 0 0\n", "\n1 0 0\n", "node 1 (line 15): 2 coordinates for 3"),
    ("\n1 0 0 0\n", "\n1 0 nan 0\n", "node 1 (line 15): the coordinate nan is no number"),
    ("\n1 0 0 0\n", "\n1 0 1e200 0\n", "node 1 (line 15): the coordinate 1e200 is no number"),
    ("\n2 1 0 0\n", "\n1 1 0 0\n", "node 1 (line 16) is there twice"),
    ("5 2 2 5 1 1 2 3", "5 99 2 5 1 1 2 3", "element 5 (line 30): of gmsh's type 99: allowed: points, lines"),
    ("5 2 2 5 1 1 2 3", "5 2 2 5 1 1 2", "element 5 (line 30): 7 numbers; cut off, or more than it should have?"),
    ("5 2 2 5 1 1 2 3", "5 2 2 5 1 1 2 x", "element 5 (line 30): a node that is missing: x"),
    ("5 2 2 5 1 1 2 3", "5 2 2 y 1 1 2 3", "element 5 (line 30): y is no number"),
    ("PhysicalNames", "Comments", "no physical groups"),
    # its elements
    ("5 2 2 5 1 1 2 3", "5 2 2 5 1 1 2 77", "element 5 (line 30): a node that is missing: 77"),
    ("1 1 2 1 11 1 2", "1 1 2 1 11 1 78", "element 1 (line 26): a node that is missing: 78"),
    ("5 2 2 5 1 1 2 3", "5 2 2 9 1 1 2 3", "5 (line 30): a triangle in no body: allowed: every one in a physical"),
    ("5 2 2 5 1 1 2 3", "5 4 2 5 1 1 2 3 4", "5 (line 30): a tetrahedron: allowed in the plane: triangles"),
    ("5 2 2 5 1 1 2 3", "5 2 2 5 1 1 2 2", "element 5 (line 30): a triangle without area"),
    ("\n2 1 0 0\n3 1 1 0\n", "\n2 1e-10 0 0\n3 0 1e-10 0\n", "(line 30): a triangle too small: another unit of"),
    ("\n7 1 2.01 0", "\n7 1 2.01 0.5", "z goes from 0 to 0.5; a plane mesh has z = 0 everywhere"),
    ("8 2 2 6 2 5 7 8", "8 2 2 6 2 5 7 6", "elements 7 and 8 lie on the same side of a common edge: they overlap"),
    ("8 2 2 6 2 5 7 8", "8 2 2 5 2 1 3 7", "element 8 is the third that has a side of element 5: they overlap"),
    ("7 2 2 6 2 5 6 7\n8 2 2 6 2 5 7 8", "7 2 2 6 2 3 6 8\n8 2 2 6 2 6 7 8", "node 3: two pieces hang together by it"),
    # its groups
    ("1 1 2 1 11 1 2", "1 1 2 1 11 2 6", 'element 1: edge of "base" that no triangle has'),
    ("1 1 2 1 11 1 2", "1 1 2 1 11 1 3", 'element 1: edge of "base" inside the bodies, which share its nodes; allow'),
    ("1 1 2 1 11 1 2", "1 1 2 2 11 1 2", 'the physical group "base" has no edge of a body'),
    ("1 1 2 1 11 1 2", "1 1 2 1 11 1 2\n9 1 2 4 9 2 1", 'element 9: edge in two physical groups of the case, "base"'),
]  # fmt: skip


@pytest.mark.parametrize("old, new, said", REFUSED)
def test_refused(tmp_path, old, new, said):
    text = PLANE.replace(old, new) if old != PLANE else new
    assert text != PLANE
    if "\n9 1 2 4" in new:
        text = text.replace("$Elements\n8\n", "$Elements\n9\n")
    with pytest.raises(MeshRefusal) as refusal:
        made_of(tmp_path, text, PRESSED)
    assert said in str(refusal.value) and "\n" not in str(refusal.value)
    assert sorted(file.name for file in tmp_path.iterdir()) == ["a.msh"]  # before any file is written


def test_far_away(tmp_path):
    far = PLANE
    for k, (x, y) in enumerate([(0, 0), (1, 0), (1, 1), (0, 1), (0, 1.01), (1, 1.01), (1, 2.01), (0, 2.01)], 1):
        far = far.replace(f"\n{k} {x} {y} 0\n", f"\n{k} {x + 16e9} {y} 0\n")
    with pytest.raises(MeshRefusal, match="too far from the origin for their size"):
        made_of(tmp_path, far, PRESSED)


def test_cracks(tmp_path):
    """Sides of one body in one place: refused, unless a contact is there."""
    joined = ALONE.replace("1.01 0\n", "1 0\n").replace("2 2 6 2", "2 2 5 2")
    case = "body low E 1 nu 0.3\nclamp base\n"
    with pytest.raises(MeshRefusal, match='elements 6 and 7 of "low" touch, but share no nodes: a crack'):
        made_of(tmp_path, joined, f"{case}obstacle grip plane 0 3 0 -1\n")
    made_of(tmp_path, joined, f"{case}contact foot top\n")


def test_groups():
    """Names in the order of the file; none, control characters, and a plane mesh in space are refused."""
    mesh = grid(3, (1, 1), lambda p: np.array([*p, 0]))
    mesh.names = {(1, 1): "every curve of the geometry", (2, 7): "a b", (1, 2): "side"}
    assert groups_of(mesh, False) == [Group(2, "a b"), Group(1, "side")]
    for names, space, said in (
        ({(1, 1): "every curve of the geometry"}, False, "no physical groups: bodies and boundaries have no names"),
        ({(1, 1): "a\x1bb"}, False, "a control character in a group's name; allowed: other names"),
        ({(1, 1): "a"}, True, "the mesh is plane, it has no volumes: use edp/parts.edp"),
    ):
        mesh.names = names
        with pytest.raises(MeshRefusal, match=said):
            groups_of(mesh, space)


def test_merged(tmp_path):
    """Two groups with the same sides are one, if contacts alone use them; then their contacts must differ."""
    twice = PLANE.replace("$Elements\n8\n", "$Elements\n9\n").replace("$EndElements", "9 1 2 7 12 3 4\n$EndElements")
    twice = twice.replace("$PhysicalNames\n6\n", '$PhysicalNames\n7\n1 7 "also"\n')
    case = "body low E 1 nu 0.3\nbody high E 2 nu 0.3\nclamp base\n{}\ncontact {} {}\n"
    _, written, _ = made_of(tmp_path, twice, case.format("contact foot top", "grip", "also"))
    assert "same 1\n" in written.text
    with pytest.raises(MeshRefusal, match=r"line 5 of the case file\): the same surfaces as in line 4; allowed: once"):
        made_of(tmp_path, twice, case.format("contact top foot", "also", "foot"))
    with pytest.raises(
        MeshRefusal, match=r"line 5 of the case file\): both are the same surface; allowed: two surfaces"
    ):
        made_of(tmp_path, twice, case.format("contact foot top", "also", "top"))


# ---------------------------------------------------------------- symmetries in planes, cuts


def test_split_symmetry(tmp_path):
    """A group in two planes becomes two, by their normals; the case's rows and the notes say so."""
    text = PLANE.replace("4 1 2 4 14 7 8", "4 1 2 4 14 7 8\n9 1 2 4 15 6 7").replace("$Elements\n8\n", "$Elements\n9\n")
    case = PRESSED.replace("move grip 0 -0.1", "symmetry grip")
    files, written, read = made_of(tmp_path, text, case)
    words = "symmetry grip of line 5 is in 2 planes: grip 1 with the normal (1, 0) and grip 2 with the normal (0, 1)"
    assert files["notes"] == f"1\n{words}\n"
    lines = table(read, written.groups, written.split).split("\n")
    assert "groups 7" in lines and "1 grip 1" in lines and "1 grip 2" in lines and "statements 6" in lines
    assert [line.split()[:3] for line in lines if line.startswith("symmetry")] == [
        ["symmetry", "5", "6"],
        ["symmetry", "5", "7"],
    ]
    assert "\n4 1 2 7 7 7 8\n" in files["mesh.msh"] and "\n5 1 2 6 6 6 7\n" in files["mesh.msh"]
    with pytest.raises(
        MeshRefusal, match='symmetry "grip" of the case file, line 5: in 2 planes, and line 6 uses this'
    ):
        made_of(tmp_path, text, f"{case}contact top grip\n")
    slope = text.replace("\n6 1 1.01 0", "\n6 1.3 1.01 0").replace("\n8 0 2.01 0", "\n8 0.6 2.51 0")
    with pytest.raises(
        MeshRefusal, match=r'"grip" of the case file, line 5: curved, by 22 degrees at \(\S+, \S+\); allow'
    ):
        made_of(tmp_path, slope, case)


def test_bulges_of_symmetries(tmp_path):
    """Sides of a split symmetry are flat to their middles."""
    flat = cut_to_simplices(grid(16, (1, 1), lambda p: np.array([*p, 0])))
    sides = sides_of(flat, flat.blocks)
    ends = {name: [] for name in ("floor", "cuts")}
    for side, free in zip(sides, alone(sides), strict=True):
        for nodes in side.nodes[free]:
            low = flat.places[nodes[:2]].sum(axis=0) < 1e-9
            ends["floor" if low[1] else "cuts"].append(nodes)
    for k, (name, rows_) in enumerate(ends.items()):
        number = np.arange(10 * k + 3, 10 * k + 3 + len(rows_))
        flat.blocks.append(Block(8, np.array(rows_), number, number, number * 0 + k + 1, number))
        flat.names[1, k + 1] = name
    case = "body part E 1 nu 0.3\nobstacle floor plane 0 -1 0 1\nsymmetry cuts\n"
    read = read_case(case, Where(), groups_of(flat, False))
    written = write_bodies(flat, read, tmp_path, False)
    assert sorted(written.split.values()) == [3, 3] and "middles 4" in written.text
    bent = flat.places.copy()
    middle = next(nodes[2] for nodes in ends["cuts"] if flat.places[nodes[2]][0] == 1)
    bent[middle, 0] += 0.01
    flat.places = bent
    with pytest.raises(MeshRefusal, match=r'symmetry "cuts" of the case file, line 3: curved at \(1, [01]\); allowed'):
        write_bodies(flat, read, tmp_path, False)


@pytest.mark.parametrize("count", [100, 2**20, 2**21, 2**40])
def test_keys(count):
    """Sides have one key whatever the order of their nodes, also in very large meshes; others have other keys."""
    nodes = np.random.default_rng(1).integers(0, 100, (3000, 3)) + count - 100
    keys = keys_of(nodes, count)
    assert np.array_equal(keys, keys_of(nodes[:, [2, 0, 1]], count)) and keys.min() >= 0
    assert len(set(keys.tolist())) == len({tuple(sorted(row)) for row in nodes.tolist()})


CUT = "cut waist part plane 0 0 {} 0 0 1\npreload waist 1\n"


def test_cuts(tmp_path):
    """A finished mesh is cut along sides in the plane; elsewhere that is refused, with the reason."""
    both = SPACE.replace("2 2 2 2 2 1 3 4", "2 2 2 2 2 1 3 5")  # a side on each side of the cut
    files, written, _ = made_of(tmp_path, both, STANDS + CUT.format(0), True)
    assert "cuts 3\n4 0\n4 1\n4 2\n" in written.text
    assert files["rises"] == "0\n"
    for z, said in (
        (2, 'cut "waist" of the case file, line 4: the plane does not cross "part", which lies from -3 to -1 along'),
        (0.5, "the plane goes through 1 elements, the first is 3; allowed: a geometry"),
    ):
        with pytest.raises(MeshRefusal, match=said):
            made_of(tmp_path, SPACE, STANDS + CUT.format(z), True)
    inside = SPACE.replace("2 2 2 2 2 1 3 4", "2 2 2 2 2 1 2 3").replace(
        "$Elements\n4\n", "$Elements\n5\n5 2 2 1 1 1 2 5\n"
    )
    files, written, _ = made_of(
        tmp_path, inside, STANDS.replace("obstacle side", "obstacle base").replace("clamp base", "preload side 1"), True
    )
    assert "cuts 3\n2 0\n2 1\n2 2\n" in written.text
    with pytest.raises(MeshRefusal, match='triangle of the preload "side" on the boundary; allowed: a cut through'):
        made_of(
            tmp_path,
            SPACE,
            STANDS.replace("obstacle side", "obstacle base").replace("clamp base", "preload side 1"),
            True,
        )


def test_the_ends_of_a_shank(tmp_path):
    """Something has to take the force on both sides of the cut: no symmetry along the shank, but one across it."""
    line, free = (
        CUT.format(0),
        r'preload "waist" of the case file, line 5: the piece of the body about \(0.25, 0.25, -0',
    )
    with pytest.raises(MeshRefusal, match=free):
        made_of(tmp_path, SPACE, STANDS + line, True)
    text = "body part E 1 nu 0.3\nsymmetry side\nobstacle base plane 0 -1 0 0 1 0\n"
    along, across = (SPACE.replace("2 2 2 2 2 1 3 4", f"2 2 2 2 2 {side}") for side in ("1 3 5", "2 3 5"))
    with pytest.raises(MeshRefusal, match=free):
        made_of(tmp_path, along, text + line, True)
    assert made_of(tmp_path, across, text + line, True)


# ---------------------------------------------------------------- decks


DECK = """*HEADING
*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 2.
6, 1., 0., 2.
7, 1., 1., 2.
8, 0., 1., 2.
** a comment
*Element, type=C3D8R, elset=PART
1, 1, 2, 3, 4,
5, 6, 7, 8
*ELSET, ELSET=EVERY
PART
*NSET, NSET=BASE, GENERATE
1, 4, 1
*SURFACE, NAME=TOP, TYPE=ELEMENT
EVERY, S2
*STEP
*NODE
nonsense
"""
ON_DECK = "body PART E 210e3 nu 0.3\nclamp BASE\nobstacle TOP plane 0 0 1.999 0 0 -1\n"


def read(folder, deck, words="PART BASE TOP", space=True):
    (folder / "a.inp").write_text(deck)
    return read_inp(folder / "a.inp", space, words.split())


def test_deck(tmp_path):
    """Sets are groups; a brick is cut; elements keep their numbers."""
    mesh = read(tmp_path, DECK)
    names = [(2, "TOP"), (2, "ALL"), (2, "BASE"), (3, "PART"), (3, "EVERY")]
    assert groups_of(mesh, True) == [Group(*name) for name in names]
    case = read_case(ON_DECK, Where(space=True, overlap=True), groups_of(mesh, True))
    written = write_bodies(mesh, case, tmp_path, True)
    elements = (tmp_path / "mesh.msh").read_text().split("$Elements\n")[1].split("\n")
    assert elements[0] == "10" and sorted(line.split()[3] for line in elements[1:5]) == ["2", "2", "3", "3"]
    assert "regions 1\n1 1\nparts 1\n" in written.text
    table = listing(tmp_path / "a.inp", True).split("\n")
    assert table[0] == "kind     name                        count   from ... to"
    assert table[1] == "body     PART                            1   (0, 0, 0) to (1, 1, 2)"
    assert table[4] == "nodes    BASE                            4   (0, 0, 0) to (1, 1, 0)"
    assert table[5] == "surface  TOP                             1   (0, 0, 2) to (1, 1, 2)"


def test_set_of_sides(tmp_path):
    """gmsh writes sides of bodies as plane elements: an ELSET of them is a group of sides."""
    deck = DECK.replace("*STEP", "*ELEMENT, TYPE=CPS4, ELSET=FOOT\n2, 4, 3, 2, 1\n*STEP")
    mesh = read(tmp_path, deck, "PART FOOT TOP")
    assert groups_of(mesh, True)[-1] == Group(2, "FOOT")
    case = read_case(ON_DECK.replace("BASE", "FOOT"), Where(space=True, overlap=True), groups_of(mesh, True))
    write_bodies(mesh, case, tmp_path, True)
    elements = (tmp_path / "mesh.msh").read_text().split("$Elements\n")[1].split("\n")[1:5]
    assert [line.split()[3] for line in elements] == ["2", "2", "3", "3"]
    assert "sides    FOOT                            1   (0, 0, 0) to (1, 1, 0)" in listing(tmp_path / "a.inp", True)


DECKS = [
    ("C3D8R", "S4R", "line 12: *ELEMENT, TYPE=S4R: not read, a shell; allowed: C3D4, C3D10, C3D6, C3D8, C3D15, C3D20"),
    ("C3D8R", "B31", "line 12: *ELEMENT, TYPE=B31: not read, a beam; allowed: "),
    ("C3D8R", "SPRINGA", "line 12: *ELEMENT, TYPE=SPRINGA: not read, a spring; allowed: "),
    ("C3D8R", "C3D7", "line 12: *ELEMENT, TYPE=C3D7: not read; allowed: "),
    ("5, 6, 7, 8\n*ELSET", "5, 6, 7, 9\n*ELSET", "line 13: element 1: a node that is missing: 9; allowed: nodes above"),
    ("5, 6, 7, 8\n*ELSET", "5, 6, 7\n*ELSET", "element 1: cut off"),
    ("5, 6, 7, 8\n*ELSET", "5, 6, 7, 8, 1\n*ELSET", "line 14: element 1 has 9 nodes, of the 8 that C3D8 has"),
    ("5, 6, 7, 8\n*ELSET", "5, 6, 7, 8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*ELSET", "line 15: the element 1 is there twice"),
    ("EVERY, S2", "EVERY, S7", "line 20: *SURFACE: S7: no side of an element; allowed: S1 ... S6"),
    ("EVERY, S2", "NONE, S2", "*SURFACE TOP: no *ELSET NONE"),
    ("EVERY, S2", "9, S2", "*SURFACE TOP: element 9 has no side S2"),
    ("*HEADING", "*INCLUDE, INPUT=b.inp", "line 1: *INCLUDE: not read; allowed: one file"),
    ("*HEADING", "*PART\n*PART", "line 2: *PART: a second one; allowed: one part, or a mesh of all without parts"),
    ("*HEADING", "*INSTANCE\n1, 2, 3", "line 2: an instance that is moved; allowed: places in the nodes themselves"),
    ("8, 0., 1., 2.", "7, 0., 1., 2.", "line 10: the node 7 is there twice; allowed: one mesh of all parts"),
    ("8, 0., 1., 2.", "8, 0., one, 2.", "line 10: node 8: the coordinate ONE is no number"),
    ("8, 0., 1., 2.", "8", "line 10: no node: number and places; allowed: number, x, y, z"),
    ("ELSET=EVERY", "X=1", "line 15: *ELSET: no name; allowed: ELSET=NAME"),
    ("*Element", "*None", "no *ELEMENT of a body; allowed: C3D4, C3D10, C3D6, C3D8, C3D15, C3D20"),
    ("elset=PART", "elset=PART\n*ELSET, ELSET=BASE\n1\n*Comment", "element 1 is in two bodies of the case, PART"),
]  # fmt: skip


@pytest.mark.parametrize("old, new, said", DECKS)
def test_decks_refused(tmp_path, old, new, said):
    assert old in DECK
    deck = DECK.replace(old, new, 1)
    if "*Comment" in new:
        deck = DECK.replace("*ELSET, ELSET=EVERY", "*ELSET, ELSET=BASE\n1\n*ELSET, ELSET=EVERY")
    with pytest.raises(MeshRefusal) as refusal:
        read(tmp_path, deck)
    assert said in str(refusal.value)


# Abaqus' own order of nodes: between which corners its middles lie
ABAQUS = {
    "C3D20": (17, "01 12 23 30 45 56 67 74 04 15 26 37"),
    "C3D20R": (17, "01 12 23 30 45 56 67 74 04 15 26 37"),
    "C3D15": (18, "01 12 20 34 45 53 03 14 25"),
    "C3D10": (11, "01 12 20 03 13 23"),
    "CPS8": (16, "01 12 23 30"),
    "CAX8R": (16, "01 12 23 30"),
    "CPE6M": (9, "01 12 20"),
}


@pytest.mark.parametrize("name", ABAQUS)
def test_second_order_in_decks(tmp_path, name):
    """Middles stand in Abaqus' order, over two lines or more."""
    kind, pairs = ABAQUS[name]
    of = KINDS[kind]
    chosen = {17: range(8), 18: PRISMS[0], 11: (0, 1, 3, 4), 16: range(4), 9: range(3)}[kind]
    corners = np.array([CORNERS[8][k] for k in chosen], float)
    nodes = [*corners, *((corners[int(a)] + corners[int(b)]) / 2 for a, b in pairs.split())]
    deck = "*NODE\n" + "".join(f"{k + 1}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(nodes))
    numbers = [str(k) for k in range(1, of.nodes + 1)]
    deck += f"*ELEMENT, TYPE={name}, ELSET=PART\n7, " + ", ".join(numbers[:5]) + ",\n" + ", ".join(numbers[5:]) + "\n"
    (block,) = read(tmp_path, deck, space=of.dimension == 3).blocks
    assert block.kind == kind and block.number.tolist() == [7]
    made = read(tmp_path, deck, space=of.dimension == 3)
    x = made.places[block.nodes[0]]
    for k, (a, b) in enumerate(EDGES[of[:2]].split()):
        assert x[of.corners + k] == pytest.approx((x[int(a)] + x[int(b)]) / 2)


# ---------------------------------------------------------------- groups by place


def picked(mesh, lines, space=True):
    """The middles of the sides that statements pick, by group."""
    case = "body part E 1 nu 0.3\nclamp a\nobstacle b plane 0 0 3 0 0 -1\n" if space else ""
    case += "".join(f"group {line}\n" for line in lines)
    read = read_case(case, Where(space=space), [*groups_of(mesh, space), Group(2, "a"), Group(2, "b")])
    made = pick_on_mesh(mesh, read)
    names = {tag: name for (d, tag), name in made.names.items() if d == 2}
    found = {}
    for block in made.blocks:
        if block.of.dimension == 2:
            for tag, nodes in zip(block.group.tolist(), block.nodes, strict=True):
                found.setdefault(names[tag], []).append(made.places[nodes[: block.of.corners]].mean(axis=0))
    return {name: np.array(places) for name, places in found.items()}


@pytest.mark.parametrize("kind", [5, 17, 12, 6, 18, 7, 4])
def test_picks(kind):
    """Planes, boxes and the smooth part near a point, on a quarter of a pipe."""
    mesh = grid(17 if kind == 4 else kind, (2, 6, 2), shell, 5)
    if kind == 4:
        mesh = cut_to_simplices(mesh)
    found = picked(mesh, ["low plane 0 0 0 0 0 2", "end box 0.9 -0.1 -0.1 2.1 0.01 1.1", "bore near 0.72 0.7 0.5"])
    assert found["low"][:, 2] == pytest.approx(0) and found["end"][:, 1] == pytest.approx(0, abs=1e-12)
    radius = np.linalg.norm(found["bore"][:, :2], axis=1)
    each = 2 if kind in (4, 7, 6, 18) else 1
    assert radius.max() < 1.001 and radius.min() > 0.96
    if kind not in (6, 18, 7):
        assert [len(found[name]) for name in ("low", "end", "bore")] == [12 * each, 4 * each, 12 * each]
    else:
        assert len(found["bore"]) >= 12


def test_smooth_parts_of_coarse_bricks():
    """Of second order the normals at the common edge count: sides that turn by 45 degrees each are one part."""
    assert len(picked(grid(17, (1, 2, 1), shell), ["bore near 0.72 0.7 0.5"])["bore"]) == 2
    assert len(picked(grid(5, (1, 2, 1), shell), ["bore near 0.85 0.35 0.5"])["bore"]) == 1


def test_picks_refused():
    mesh = grid(17, (1, 2, 1), shell)
    for line, said in (
        ("c plane 0 0 0.3 0 0 1", "line 4: c: no sides of the boundary lie there wholly; allowed: one or more"),
        ("c near 0.72 0.7 1.0", "c: near: 2 smooth parts of the boundary are equally near; allowed: a point nearer"),
        ("c faces 3", "line 4: c: a mesh has no numbers of faces"),
    ):
        with pytest.raises(Refusal) as refusal:
            picked(mesh, [line])
        assert said in refusal.value.text("a.case")


def test_cylinder_and_elements():
    """Sides on a cylinder, not flat ends whose nodes are on its rim; sides of elements by numbers."""
    mesh = grid(5, (2, 6, 2), shell)
    boundary = Boundary(mesh, mesh.blocks)
    read = read_case(
        "group c near 0 0 0\nbody part E 1 nu 0\nobstacle c plane 0 0 9 0 0 1\n",
        Where(space=True),
        groups_of(mesh, True),
    )
    s = read.statements[0]
    assert sum(map(len, pick_sides(boundary, s, OnCylinder(point=(0, 0, 5), axis=(0, 0, -3), radius=2)))) == 12
    assert sum(map(len, pick_sides(boundary, s, OnCylinder(point=(0, 0, 5), axis=(0, 0, 1), radius=1.7)))) == 0
    rim = grid(5, (1, 1, 1), lambda p: (p - 0.5) * np.sqrt(2))
    assert (
        sum(map(len, pick_sides(Boundary(rim, rim.blocks), s, OnCylinder(point=(0, 0, 0), axis=(0, 0, 1), radius=1))))
        == 4
    )
    chosen = pick_sides(boundary, s, ElementSides(elements=(1, 3), side=1))
    assert [len(rows_) for rows_ in chosen] == [2, 0, 0, 0, 0, 0]
    with pytest.raises(Refusal, match="side 2 of element 1 is inside"):
        pick_sides(boundary, s, ElementSides(elements=(1, 3), side=2))
    assert sum(int(free.sum()) for free in alone(boundary.sides)) == 2 * (2 * 6 + 6 * 2 + 2 * 2)


def test_bodies_by_place():
    """A box and a point name bodies of a mesh whose elements have no names."""
    one, other = grid(5, (1, 1, 1)), grid(5, (1, 1, 1), lambda p: p + np.array([2, 0, 0]))
    other.blocks[0].nodes += 8
    mesh = Mesh(np.concatenate([one.places, other.places]), np.arange(1, 17), one.blocks + other.blocks)
    for block in mesh.blocks:
        block.group = block.group * 0
    case = "group left box -1 -1 -1 1.5 2 2\ngroup right near 3.1 0.5 0.5\n"
    case += "group in plane 1 0 0 1 0 0\ngroup on plane 2 0 0 1 0 0\n"
    case += "body left E 1 nu 0\nbody right E 1 nu 0\ncontact in on\n"
    read = read_case(case, Where(space=True), [])
    made = pick_on_mesh(mesh, read)
    tags = {name: tag for (d, tag), name in made.names.items() if d == 3}
    assert [block.group.tolist() for block in made.blocks[:2]] == [[tags["left"]], [tags["right"]]]
