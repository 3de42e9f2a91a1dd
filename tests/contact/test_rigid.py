"""Rigid obstacles with edges: outlines and triangles against samples of them, closed forms, copies, refusals."""

import struct

import numpy as np
import pytest
from freefem import part
from reader import Refusal, Where, read_case
from reader import grammar as g
from reader.fields import OneOf, Reading
from reader.groups import Group
from reader.rigid.surfaces import surface_of
from reader.words import Line

E, NU = 1000.0, 0.3
STIFF = E / (1 - NU**2)
BLOCK = """W = 20; h = {h}; a = {a};
Point(1) = {{-W, -W, 0, 4}}; Point(2) = {{W, -W, 0, 4}}; Point(3) = {{W, 0, 0, 4}}; Point(4) = {{a, 0, 0, h}};
Point(5) = {{-a, 0, 0, h}}; Point(6) = {{-W, 0, 0, 4}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 5}}; Line(5) = {{5, 6}}; Line(6) = {{6, 1}};
Curve Loop(1) = {{1:6}}; Plane Surface(1) = {{1}};
Physical Surface("block") = {{1}}; Physical Curve("bottom") = {{1}}; Physical Curve("top") = {{3, 4, 5}};
"""
RING = """W = 400; a = 2;
Point(1) = {0, -W, 0, 80}; Point(2) = {W, -W, 0, 80}; Point(3) = {W, 0, 0, 80}; Point(4) = {a, 0, 0, 0.1};
Point(5) = {0, 0, 0, 0.1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1:5}; Plane Surface(1) = {1};
Physical Surface("block") = {1}; Physical Curve("bottom") = {1}; Physical Curve("top") = {3, 4};
"""
CUBE = """
Point(1) = {-3, -3, -4, 2.5}; Point(2) = {3, -3, -4, 2.5}; Point(3) = {3, 3, -4, 2.5}; Point(4) = {-3, 3, -4, 2.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; v[] = Extrude {0, 0, 4} { Surface{1}; };
Physical Volume("block") = {v[1]}; Physical Surface("bottom") = {1}; Physical Surface("top") = {v[0]};
Field[1] = Ball; Field[1].Radius = 1.4; Field[1].VIn = 0.6; Field[1].VOut = 2.5; Field[1].Thickness = 2;
Background Field = 1;
"""
HELD = "body block E 1000 nu 0.3\nclamp bottom\n"
WEDGE = "polygon 0 0 3 1 0 3 -3 1 move 0 -0.2 friction 0.3"


def shape(text, space=False, state="strain"):
    """The surface of a shape, as a case states it."""
    where = Where(space=space)
    where.state = state
    made = OneOf("a", "b", g.SHAPES).read(Reading(Line(1, ["shape", *text.split()]), where, None, g.Obstacle))
    return surface_of(made, where)


def facets(low, high):
    """Corners of the twelve triangles of a box."""
    corner = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)]) * (np.subtract(high, low)) + low
    sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return [corner[[*three]] for a, b, c, d in sides for three in ((a, b, c), (c, d, a))]


def stl(path, triangles, text=False):
    """Writes a file of a surface; every other triangle the other way round, as some programs do."""
    triangles = [at[::-1] if k % 2 else at for k, at in enumerate(triangles)]
    if text:
        rows = [f"facet normal 0 0 0\nouter loop\n{vertices(at)}endloop\nendfacet\n" for at in triangles]
        path.write_text("solid one\n" + "".join(rows) + "endsolid one\n")
        return
    rows = [struct.pack("<12fH", 0, 0, 0, *at.ravel(), 0) for at in triangles]
    path.write_bytes(bytes(80) + struct.pack("<I", len(rows)) + b"".join(rows))


def vertices(at):
    return "".join(f"vertex {x!r} {y!r} {z!r}\n" for x, y, z in at.tolist())


def box_distance(places, low, high):
    """From outside or inside of a box."""
    middle, half = (np.array(low) + high) / 2, (np.array(high) - low) / 2
    off = np.abs(places - middle) - half
    return np.abs(np.linalg.norm(np.maximum(off, 0), axis=1) + np.minimum(off.max(axis=1), 0))


def test_distances(tmp_path):
    """Boxes, punches and cones against closed forms; files of triangles in any sense, text and binary."""
    random = np.random.default_rng(3)
    places = random.uniform(-3, 5, (200, 3))
    flat = places * [1, 1, 0]
    for text, space, low, high, by in (
        ("box 0 0 0 1 2 3", True, (0, 0, 0), (1, 2, 3), 0),
        ("box 1 2 3 0 0 0 round 0.3", True, (0.3, 0.3, 0.3), (0.7, 1.7, 2.7), 0.3),
        ("box 0 0 2 3 inside", False, (0, 0, -9), (2, 3, 9), 0),
        ("box 0 0 2 3 round 0.5", False, (0.5, 0.5, -9), (1.5, 2.5, 9), 0.5),
    ):
        known = box_distance(places if space else flat, low, high)
        outside = np.any((places if space else flat) != np.clip(places if space else flat, low, high), axis=1)
        known = np.abs(np.where(outside, known, -known) - by) if by else known
        found = shape(text, space).distance(places)
        here = outside if by else known > 0  # inside of a rounded one only near its surface
        assert found[here] == pytest.approx(known[here], abs=1e-12), text
    # about an axis: the tip of a round cone, its flank, the end of a punch
    axis = np.array([1.0, 2.0, 2.0]) / 3
    cone = shape("cone 1 1 1 1 2 2 degrees 60 round 0.5", True)
    across = np.cross(axis, [0, 0, 1.0])
    across /= np.linalg.norm(across)
    tip = np.ones(3)
    flank = tip - 0.5 * axis + 3 * (np.sin(np.pi / 3) * across - np.cos(np.pi / 3) * axis)
    out = np.cos(np.pi / 3) * across + np.sin(np.pi / 3) * axis
    at = np.array([tip + 0.7 * axis, flank + (0.5 + 0.2) * out])
    assert cone.distance(at) == pytest.approx([0.7, 0.2])
    punch = shape("punch 1 1 1 1 2 2 R 2 round 0.5", True)
    at = np.array([tip + 0.4 * axis + 1.2 * across, tip - 5 * axis + 2.3 * across, tip - 0.5 * axis + 1.5 * across])
    at[2] += (axis + across) * np.sqrt(0.5)
    assert punch.distance(at) == pytest.approx([0.4, 0.3, 0.5])
    # files
    for name, text in (("a.stl", False), ("b.stl", True)):
        stl(tmp_path / name, facets((0, 0, 0), (1, 2, 3)), text)
        made = shape(f"surface {tmp_path / name} scale 2 at 0 1 0", True)
        assert made.distance(places) == pytest.approx(box_distance(places, (0, 1, 0), (2, 5, 6)), abs=1e-7)
        assert made.convex() and len(made.edges()) == 12
        assert (np.einsum("ij,ij->i", made.facets.normal, made.facets.at.mean(axis=1) - [1, 3, 3]) > 0).all()


def test_segments(tmp_path):
    """Segments of a mesh in the plane: a closed outline in any sense, an open one, and one that ends on the axis."""
    head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 2 0 0\n3 2 3 0\n4 0 3 0\n$EndNodes\n$Elements\n"
    rows = ["1 1 2 1 1 1 2", "2 1 2 1 1 3 2", "3 1 2 1 1 3 4", "4 1 2 1 1 1 4"]
    places = np.random.default_rng(4).uniform(-2, 5, (50, 3)) * [1, 1, 0]
    for name, count in (("closed.msh", 4), ("open.msh", 2)):
        (tmp_path / name).write_text(head + "\n".join([str(count), *rows[:count], "$EndElements\n"]))
    made = shape(f"surface {tmp_path / 'closed.msh'}")
    assert made.distance(places) == pytest.approx(box_distance(places, (0, 0, -9), (2, 3, 9)))
    assert made.convex() and len(made.outline.corners) == 4
    middle = made.outline.start + made.outline.way * made.outline.length[:, None] / 2
    assert (((middle - [1, 1.5]) * made.outline.normal).sum(1) > 0).all()
    assert not shape(f"surface {tmp_path / 'closed.msh'} inside").convex()
    ends = shape(f"surface {tmp_path / 'open.msh'}").outline
    assert sorted(ends.beside.ravel().tolist()) == [-1, -1, 0, 1] and len(ends.corners) == 1
    axis = shape(f"surface {tmp_path / 'closed.msh'}", state="axisymmetric")
    assert axis.distance(places) == pytest.approx(box_distance(places, (-2, 0, -9), (2, 3, 9)))


WRONG = (
    ("polygon 0 0 1 0", "a polygon of 2 corners"),
    ("polygon 0 0 2 0 0 2 2 2", "the sides from corners 2 and 4 meet"),
    ("polygon 0 0 2 0 2 0 0 2", "corners 2 and 3 are the same"),
    ("box 0 0 0 2", "two corners on one side; allowed: opposite corners"),
    ("punch 0 0 0 -1 R 2 round 3", "as wide as the punch; allowed: below R 2"),
    ("cone 0 0 0 -1 degrees 90", "is out of range; allowed: above 0 and below 90"),
    ("surface none.stl", "none.stl: no such file"),
    ("cone 0 0 0 -1", "degrees is missing after -1"),
)


@pytest.mark.parametrize("text, why", WRONG)
def test_refused(text, why):
    """Shapes that are none."""
    with pytest.raises(Refusal, match=why):
        read_case(f"{HELD}obstacle top {text}\n", Where(), [Group(2, "block"), Group(1, "bottom"), Group(1, "top")])


def test_refused_as_made(tmp_path):
    """What shows when the surface is made: sides too short for their radius, no surface in a file."""
    with pytest.raises(Refusal, match=r"a side is too short for it; allowed: below 0\.5"):
        shape("box 0 0 1 3 round 0.6")
    (tmp_path / "empty.stl").touch()
    with pytest.raises(Refusal, match=r"empty.stl: an empty file; allowed: \.stl, text or binary"):
        shape(f"surface {tmp_path / 'empty.stl'}", True)
    test_refused(f"surface {tmp_path / 'empty.stl'}", r"for bodies in space \(edp/parts-3d.edp\); allowed in the plane")
    (tmp_path / "bad.stl").write_text("solid\nvertex a b c\n")
    with pytest.raises(Refusal, match=r"no triangles of an \.stl file"):
        shape(f"surface {tmp_path / 'bad.stl'}", True)
    three = [*facets((0, 0, 0), (1, 1, 1)), np.array([[0.0, 0, 0], [1, 0, 0], [0, -1, -1]])]
    stl(tmp_path / "three.stl", three)
    with pytest.raises(Refusal, match="more than two triangles meet at an edge"):
        shape(f"surface {tmp_path / 'three.stl'}", True)


def press(folder, mesh, obstacle, *flags, state="", space=False):
    """A run in which an obstacle is pressed into a block."""
    return part(folder, mesh, f"{state}{HELD}obstacle top {obstacle}\n", *flags, space=space)


def resultant(run):
    return np.array(run.summary["contacts"][0]["force"])


def test_sneddon(tmp_path):
    """A cone on a half-space: force and contact radius over depth, and the pressure away from tip and edge."""
    angle, depth = np.radians(88), 0.05
    run = press(tmp_path, RING, f"cone 0 0 0 -1 degrees 88 move 0 {-depth}", state="state axisymmetric\n")
    slope = 1 / np.tan(angle)
    radius = 2 / np.pi * depth / slope
    contact, error = run.summary["contacts"][0], run.summary["estimates"]["contacts"][0]
    # Hay, Bolshakov, Pharr 1999: the inward motion of the surface adds 0.6 % at this angle
    inward = slope * (1 - 2 * NU) / (4 * (1 - NU))
    more = np.pi * (np.pi / 4 + 0.1548 * inward) / (np.pi / 2 - 0.831 * inward) ** 2
    assert run.summary["force"] == pytest.approx(more * 2 / np.pi * STIFF * depth**2 / slope, rel=5e-3)
    assert abs(contact["contactLength"] - radius) < error["contactLength"]["error"] + 0.01 * radius
    assert error["pressureMax"] is None and any("grows without bound" in said for said in run.summary["warnings"])
    x, p = run.contact["x"], run.contact["pressure"]
    here = (x > 0.3 * radius) & (x < 0.85 * radius)
    assert here.sum() > 5
    assert p[here] == pytest.approx(STIFF / 2 * slope * np.arccosh(radius / x[here]), rel=0.03)


def test_flat_punch(tmp_path):
    """Force and pressure of a round flat punch; -distance exact adds nothing to a flat face."""
    runs = [
        press(tmp_path / way, RING, "punch 0 0 0 -1 R 2 move 0 -0.01", "-distance", way, state="state axisymmetric\n")
        for way in ("linear", "exact")
    ]
    force = 2 * 2 * STIFF * 0.01
    for run in runs:
        error = run.summary["estimates"]["contacts"][0]["normalForce"]["error"]
        assert abs(run.summary["force"] - force) < error + 5e-3 * force
        x, p = run.contact["x"], run.contact["pressure"]
        here = (x > 0.1) & (x < 1.6)
        assert p[here] == pytest.approx(run.summary["force"] / (4 * np.pi * np.sqrt(4 - x[here] ** 2)), rel=0.02)
        assert (p[x > 2.001] == 0).all()
        assert run.summary["estimates"]["contacts"][0]["pressureMax"] is None
    assert runs[1].summary["force"] == pytest.approx(runs[0].summary["force"], rel=1e-6)


def test_edges_between_nodes(tmp_path):
    """A punch whose edges are between nodes: the force within its error of that with nodes there."""
    fine = press(tmp_path / "fine", BLOCK.format(h=0.05, a=2.1), "punch 0 0 0 -1 R 2.1 move 0 -0.05")
    coarse = press(tmp_path / "coarse", BLOCK.format(h=0.5, a=2), "punch 0 20 0 -1 R 2.1 move 0 -20.05")
    error = coarse.summary["estimates"]["contacts"][0]["normalForce"]["error"]
    assert 0.003 * fine.summary["force"] < abs(coarse.summary["force"] - fine.summary["force"]) < error
    assert (coarse.contact["pressure"][np.abs(coarse.contact["x"]) > 2.1] == 0).all()
    x, p = fine.contact["x"], fine.contact["pressure"]
    here = np.abs(x) < 1.75
    assert p[here] == pytest.approx(fine.summary["force"] / (np.pi * np.sqrt(2.1**2 - x[here] ** 2)), rel=0.015)


def test_round_edges(tmp_path):
    """A box that is nearly a circle, a polygon of many sides, and the circle."""
    mesh, force = BLOCK.format(h=0.2, a=2), "force 0 -50"
    at = 2 * np.pi * np.arange(200) / 200
    many = " ".join(f"{10 * np.sin(a):.15g} {10 - 10 * np.cos(a):.15g}" for a in at)
    runs = [
        press(tmp_path / name, mesh, f"{text} {force}", "-distance", "exact")
        for name, text in (
            ("circle", "circle 0 10 R 10"),
            ("round", "box -10 0 10 20 round 9.999999"),
            ("many", f"polygon {many}"),
        )
    ]
    way = [run.summary["obstacles"][0]["motion"][1] for run in runs]
    assert way[1] == pytest.approx(way[0], rel=1e-5) and way[2] == pytest.approx(way[0], rel=0.01)
    assert runs[1].contact["pressure"] == pytest.approx(runs[0].contact["pressure"], abs=1e-3)
    size = [run.summary["contacts"][0]["contactLength"] for run in runs]
    assert size[2] == pytest.approx(size[0], rel=0.05)


def test_turned_and_mirrored(tmp_path):
    """A wedge with friction, the same turned by 90 degrees, and with its corners in the other order."""
    mesh = BLOCK.format(h=0.2, a=1)
    flags = ["-distance", "exact"]
    first = press(tmp_path / "first", mesh, WEDGE, *flags)
    other = press(tmp_path / "other", mesh, WEDGE.replace("0 0 3 1 0 3 -3 1", "-3 1 0 3 3 1 0 0"), *flags)
    turn = "Rotate {{0, 0, 1}, {0, 0, 0}, Pi/2} { Surface{1}; }\n"
    turned = "polygon 0 0 -1 3 -3 0 -1 -3 move 0.2 0 friction 0.3"
    third = press(tmp_path / "third", mesh + turn, turned, *flags)
    force = resultant(first)
    assert force[1] < -20 and abs(force[0]) < 0.01 * abs(force[1])
    assert resultant(other) == pytest.approx(force, abs=1e-6 * abs(force[1]))
    assert resultant(third) == pytest.approx([-force[1], force[0]], abs=1e-4 * abs(force[1]))


def test_one_side_of_a_corner(tmp_path):
    """A point that has slid off the tip of a wedge has the normal of a flank: the run says what is in doubt."""
    run = press(tmp_path, BLOCK.format(h=0.1, a=2), "polygon 0 0 3 1 0 3 -3 1 move 0 -0.2", "-distance", "exact")
    across = abs(resultant(run)[0])
    (said,) = (said for said in run.summary["warnings"] if "normal of one side" in said)
    assert across < float(said.split("is known to ")[1].split()[0]) + 1e-9


def test_gap_along_normals(tmp_path):
    """Undeformed gaps of a wedge are those along the normals of the block, as distances from the flank they meet."""
    mesh = BLOCK.format(h=0.5, a=2)
    run = press(tmp_path, mesh, "cone 0 0.1 0 -1 degrees 60 interference 0.0001", "-estimate", 0)
    gap = (0.1 + np.abs(run.contact["x"]) / np.tan(np.pi / 3)) * np.sin(np.pi / 3)
    beside = (np.abs(run.contact["x"]) > 0.1) & (np.abs(run.contact["x"]) < 19)
    assert run.contact["s"][beside] == pytest.approx(1e-4 - gap[beside], abs=1e-3)


ROUNDED = {
    "polygon": "polygon 0 0 3 1 0 3 -3 1 round 0.8 move 0.1 -0.2",
    "punch": "punch 0 0 0 -1 R 1.5 round 1 move 0 -0.2",
    "box": "box -1 0 3 4 round 0.9 move 0.05 -0.15",
}


@pytest.mark.parametrize("name", ROUNDED)
def test_errors_with_exact_distance(name, tmp_path):
    """Round edges, exact distances: force and normal force on a mesh four times as fine lie within ±."""
    runs = [
        press(tmp_path / str(h), BLOCK.format(h=h, a=3), ROUNDED[name], "-distance", "exact", "-estimate", 1)
        for h in (0.4, 0.1)
    ]
    known = runs[0].summary["estimates"]["contacts"][0]
    for key in ("force", "normalForce"):
        coarse, fine = (run.summary["contacts"][0][key] for run in runs)
        off = np.linalg.norm(np.subtract(coarse, fine))
        assert off < known[key]["error"] < 0.15 * np.linalg.norm(fine)


def ball(radius, times):
    """Corners of the triangles of an octahedron, each cut into four so many times, on a sphere at height radius."""
    ends = np.eye(3)
    found = [np.array([a * ends[0], b * ends[1], c * ends[2]]) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    for _ in range(times):
        halves = [(at, (at + np.roll(at, -1, axis=0)) / 2) for at in found]
        parts = [np.array([at[k], half[k], half[k - 1]]) for at, half in halves for k in range(3)]
        found = parts + [half for _, half in halves]
    return [radius * at / np.linalg.norm(at, axis=1, keepdims=True) + [0, 0, radius] for at in found]


def test_in_space(tmp_path):
    """A box beside a punch, with no contact beside them; a ball of triangles beside a sphere."""
    stl(tmp_path / "ball.stl", ball(3, 5))
    texts = ("box -1 -1 0 1 1 2", "punch 0 0 0 0 0 -1 R 1", f"surface {tmp_path / 'ball.stl'}", "sphere 0 0 3 R 3")
    runs = [
        press(tmp_path / str(n), CUBE, f"{text} move 0 0 -0.1", "-distance", "exact", space=True)
        for n, text in enumerate(texts)
    ]
    force = [run.summary["force"] for run in runs]
    # Pharr: a square punch is 1.012 sqrt(4/pi) times as stiff as a round one of its half width
    assert force[0] / force[1] == pytest.approx(1.012 * np.sqrt(4 / np.pi), rel=0.06)
    assert force[2] == pytest.approx(force[3], rel=0.02)
    gap = [-run.contact["s"] for run in runs[2:]]
    near = gap[1] < 10
    assert near.sum() > 50 and gap[0][near] == pytest.approx(gap[1][near], abs=0.01)
    for run in runs[:2]:
        x, y, p = (run.contact[name] for name in ("x", "y", "pressure"))
        far = np.hypot(x, y) if run is runs[1] else np.maximum(abs(x), abs(y))
        assert (p[far > 1.001] == 0).all() and p.max() > 0
        assert any("grows without bound" in said for said in run.summary["warnings"])
