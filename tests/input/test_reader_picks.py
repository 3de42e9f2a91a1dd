"""What a case picks of a geometry: groups, cuts, joins, sizes, places of contact, on outlines made here; gmsh's meshes.

The last part needs gmsh's module. tests/campaigns/geometries.py compares both readers on many geometries.
"""

import json
import os
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from reader import Refusal, Where, mesher, read_case
from reader.geometry import Outline
from reader.gmsh_process import GmshError
from reader.near import PARTS, Shape, Store, first_of_cell
from reader.neighbours import distances
from reader.picks import Picks, apart, nearest_pieces

from input.test_reader_geometry import AT, TURN, box, closed, curve, solid
from input.test_sizes import LOWER, SEARCHED, SHAPES, UPPER, bent, middles_over

BODIES = "body low E 1 nu 0\nbody high E 1 nu 0\n"
NUMBERS = "group low volumes 1\ngroup high volumes 2\n"
ENOUGH = "group ground plane 0 0 0 0 0 1\nclamp ground\n"


def case_of(text, bodies="1 2", space=True, groups=(), labels=()):
    named = dict.fromkeys(map(int, bodies.split()), "") | dict(labels)
    return read_case(text, Where(space=space, bodies=named), groups)


def boxes(gap=0.0, size=(1, 1, 1), at=(0, 0)):
    """Two boxes above each other, faces 1 ... 6 and 7 ... 12: 6 and 11 look at each other."""
    lower, upper = box(0, 0, 0), box(*at, 1 + gap, size, first=7)
    return Outline(True, {1: list(lower), 2: list(upper)}, lower | upper)


def picks(text, made=None, **more):
    return Picks(made or boxes(), case_of(text, **more), cad=True)


def chosen(rest, made=None):
    """The groups of two boxes that a case picks with these lines."""
    found = picks(NUMBERS + BODIES + ENOUGH + rest, made)
    assert found.choose() == []
    return found


def refused(rest, made=None, then=lambda found: None):
    with pytest.raises(Refusal) as refusal:
        found = picks(NUMBERS + BODIES + ENOUGH + rest, made)
        assert found.choose() == []
        then(found)
    return f"line {refusal.value.line}: {refusal.value}"


# ---------------------------------------------------------------- groups

CONTACT = "contact up down\n"


@pytest.mark.parametrize("pick, face", [
    ("faces 6 5", [6, 5]),
    ("plane 0 0 1 0 0 -3", [6, 11]),
    ("plane 7 9 1.0000009 0 0 1", [6, 11]),
    ("box -1 -1 0.9 2 2 1.1", [6, 11]),
    ("box 2 2 1.1 -1 -1 0.9", [6, 11]),
    ("near 0.3 -0.5 0.4", [3]),
    ("near 0.4 0.45 1.8", [12]),
    ("between low high", [6]),
    ("between high low", [11]),
])  # fmt: skip
def test_picked(pick, face):
    found = chosen(f"group up {pick}\ngroup down faces 12\n{CONTACT}")
    assert found.members[2, "up"] == face and found.members[3, "low"] == [1]
    assert found.members[2, "ground"] == [5]


@pytest.mark.parametrize("pick, said", [
    ("faces 13", "13: no such number of faces; allowed: 1 2 3 4 5 6 7 8 9 10 11 12"),
    ("plane 0 0 1.01 0 0 1", "up: plane: no face lies there; allowed: one or more, of 1 2 3"),
    ("plane 0 0 1.000009 0 0 1", "up: plane: no face lies there"),
    ("box 0.1 0.1 0 0.9 0.9 1.5", "up: box: no face lies there"),
    ("near 0.5 0.5 1", "near 0.5 0.5 1: the faces 6 of body 1 and 11 of body 2 are equally near; allowed: a place "
     "nearer to one of them, faces and its number, between BODY BODY"),
])  # fmt: skip
def test_not_picked(pick, said):
    assert refused(f"group up {pick}\ngroup down faces 12\n{CONTACT}").startswith(f"line 7: {said}")


def test_on_a_cylinder():
    """Faces about an axis, at a radius, whatever the length of the axis; a geometry has no elements."""
    made = solid(closed(5.0))
    at, way = (" ".join(f"{x:.17g}" for x in v) for v in (AT, 3 * TURN[:, 2]))
    body = "body low E 1 nu 0\ngroup ends faces 4\nclamp ends\nobstacle wall plane 0 0 99 0 0 -1\n"

    def on(pick):
        found = picks(f"{body}group wall {pick}\n", made, bodies="1")
        found.choose()
        return found.members[2, "wall"]

    assert on(f"cylinder {at} {way} R 5") == [1, 2, 3]
    for pick, said in (
        (f"cylinder {at} {way} R 4.99", "wall: cylinder: no face lies there"),
        (f"cylinder {at} 1 0 0 R 5", "wall: cylinder: no face lies there"),
        ("elements 4 side 2", "elements: a geometry has none yet"),
    ):
        with pytest.raises(Refusal) as refusal:
            on(pick)
        assert str(refusal.value).startswith(said)


def test_bodies_picked():
    """Bodies by place; a number of none; one body needs no group."""
    text = (
        NUMBERS.replace("volumes 2", "near 0 0 3")
        + BODIES
        + ENOUGH
        + "contact side up\ngroup side faces 1\ngroup up faces 12\n"
    )
    found = picks(text)
    found.choose()
    assert found.members[3, "high"] == [2] and found.left() == ""
    with pytest.raises(Refusal, match=r"^3: no such number of volumes; allowed: 1 2$"):
        picks(text.replace("volumes 1", "volumes 3")).choose()
    alone = picks("body all E 1 nu 0\ncontact a b\ngroup a faces 1\ngroup b faces 12\n")
    alone.choose()
    assert alone.members[3, "all"] == [1, 2]
    some = picks(
        "body low E 1 nu 0\ngroup low volumes 1\nclamp a\ncontact a b\ngroup a faces 1\ngroup b faces 2\n".replace(
            "clamp a\n", ""
        )
    )
    some.choose()
    assert some.left() == "volumes 2"


def test_between_with_a_gap():
    """The nearest faces, if none lie on each other; which is no tie."""
    made = boxes(gap=0.1)
    found = chosen("join low high contact\n", made)
    assert found.members[2, "low-high"] == [6] and found.members[2, "high-low"] == [11]
    said = refused("join low high tie\n", made, Picks.check_ties)
    assert said.startswith("line 7: join low high tie: they touch nowhere, there is a gap between them; allowed: ")
    chosen("join low high tie\n").check_ties()


def test_bodies_that_share_a_face():
    """The second is taken apart; its new number stands for the old one."""
    pieces = box(0, 0, 0) | {k: v for k, v in box(0, 0, 1, first=7).items() if k != 11}
    shared = Outline(True, {1: [1, 2, 3, 4, 5, 6], 2: [6, 7, 8, 9, 10, 12]}, pieces)
    text = NUMBERS + BODIES + ENOUGH + "join low high contact\n"
    assert picks(text, shared).choose() == [2]
    apart = boxes()
    apart.bodies = {1: apart.bodies[1], 3: apart.bodies[2]}
    found = Picks(apart, case_of(text), True, {2: 3})
    assert found.choose() == [] and found.members[3, "high"] == [3] and found.members[2, "high-low"] == [11]


# ---------------------------------------------------------------- what touches

OPEN = "group up faces 12\nobstacle up plane 0 0 5 0 0 -1\n"


def test_touching_untold():
    """Faces on each other of which no statement says anything; a join, or a contact of these faces, says it."""
    lines = chosen(OPEN).untold()
    nothing = "low and high (faces 6 on 11), and no statement says what happens there: "
    assert lines == [f"{nothing}write join low high part, tie or contact"]
    for told in ("join high low part\n", "group a faces 11\ngroup b faces 6\ncontact a b\n"):
        assert chosen(OPEN + told).untold() == []
    assert len(chosen(OPEN + "group a faces 11\ngroup b faces 1\ncontact a b\n").untold()) == 1
    nameless = picks("body all E 1 nu 0\ngroup all volumes 1 2\n" + OPEN)
    nameless.choose()
    assert nameless.untold()[0].startswith(
        "volumes 1 and 2 (faces 6 on 11), and no statement says what happens there: "
    )
    assert "name each by a line group NAME volumes N, and write join A B part" in nameless.untold()[0]


def test_table_and_picture():
    found = chosen(OPEN + "join high low part\n")
    text = found.table()
    assert "volume 1 (low): from (0, 0, 0) to (1, 1, 1)" in text
    assert text.endswith("volumes 1 and 2 touch (faces 6 on 11): the case file says how\n")
    assert "join high low tie" in chosen(OPEN).table() or "join low high tie" in chosen(OPEN).table()
    lines = found.pieces().splitlines()
    assert lines[0] == "face,body,x0,y0,z0,x1,y1,z1,x2,y2,z2" and len(lines) == 1 + 12 * 8
    assert lines[1] == "1,1,0,0,0,0,0.5,0,0,0.5,0.5"


# ---------------------------------------------------------------- cuts and joins


def test_operations():
    text = "cut waist low plane 0 0 0.5 0 0 2\npreload waist 1\njoin low high part\n"
    assert chosen(OPEN + text).operations() == [
        ["cut", 1, [0, 0, 0.5], [0, 0, 2], [0.5, 0.5, 1], pytest.approx(6**0.5)],
        ["share", [1, 2]],
    ]
    assert chosen(OPEN).operations() == []
    (alone,) = chosen(OPEN + text.replace("join low high part\n", "")).operations()
    assert alone[:2] == ["cut", 1]


def test_three_that_touch():
    """Two that are joined to a third and touch must be joined, too."""
    pieces = box(0, 0, 0) | box(1, 0, 0, first=7) | box(0, 0, 1, (2, 1, 1), first=13)
    made = Outline(True, {1: [*range(1, 7)], 2: [*range(7, 13)], 3: [*range(13, 19)]}, pieces)
    text = "".join(f"group {n} volumes {k}\nbody {n} E 1 nu 0\n" for k, n in ((1, "a"), (2, "b"), (3, "c")))
    text += ENOUGH + OPEN.replace("12", "18") + "join a c part\njoin b c part\n"
    found = picks(text, made, bodies="1 2 3")
    found.choose()
    with pytest.raises(Refusal, match=r"^join: a and b touch, and joins with other bodies hang them together"):
        found.operations()
    found = picks(text + "join a b part\n", made, bodies="1 2 3")
    found.choose()
    assert found.operations() == [["share", [1, 2, 3]]]


def halves(shared=True):
    """The lower box in two halves, joined to the upper one: bodies 1 and 3, which share face 20, and 2."""
    lower, upper = box(0, 0, 0, (1, 1, 0.5), first=21), box(0, 0, 0.5, (1, 1, 0.5), first=27)
    top = {k: v for k, v in box(0, 0, 1, first=41).items() if k != 45}
    faces = {k: v for k, v in lower.items() if k != 26} | {20: lower[26]}
    faces |= {k: v for k, v in upper.items() if k != 31} | top
    bodies = {1: [*range(21, 26), 20], 2: [*([32] if shared else []), *top], 3: [20, *range(27, 31), 32]}
    return Outline(True, bodies, faces)


CUT = "cut waist low plane 0 0 0.5 0 0 2\npreload waist 1\njoin low high part\n"


def after(rest, now, overlap=False, own=None):
    before = chosen(OPEN + rest)
    found = Picks(now, before.case, True)
    found.after(before, own or {1: [1, 3], 2: [2]}, overlap)
    return found


def test_groups_after_a_cut():
    """Each face is a piece of the one that it lies on; the cut's own, and one between joined bodies, are of none."""
    found = after("group side faces 1 6\npressure side 1\n" + CUT, halves())
    assert found.members[3, "low"] == [1, 3] and found.members[3, "high"] == [2]
    assert found.members[2, "ground"] == [25] and found.members[2, "waist"] == [20] and found.members[2, "up"] == [46]
    assert found.members[2, "side"] == [21, 27]
    assert found.origin[20] == -20 and found.origin[32] == 11 and found.parent == {1: 1, 3: 1, 2: 2}
    assert found.pieces().splitlines()[1].startswith("1,1,") and "\n-20,1," in found.pieces()
    assert found.table_of_cuts() == "\ncut waist through low: area 1, middle 0.5 0.5 0.5\n"


def test_refused_after_operations():
    with pytest.raises(Refusal, match=r"^join low high part: they share no face, there is a gap between them"):
        after(CUT, halves(shared=False))
    with pytest.raises(
        Refusal, match=r"^join low high part: bodies of it overlap; allowed: bodies that touch, or join"
    ):
        after(CUT, halves(), overlap=True)
    with pytest.raises(Refusal, match=r"^cut waist: bodies that share a face with others cannot be cut or joined so"):
        after(CUT.replace("join low high part\n", ""), halves(), overlap=True)
    beside = "^cut waist: the plane does not cross low, which lies from -0.5 to 0.5 along the normal from its point"
    with pytest.raises(Refusal, match=beside):
        after(CUT.replace("0.5 0 0 2", "0.5 0 2 0").replace("plane 0 0", "plane 0 0.5"), halves())


# ---------------------------------------------------------------- sizes


def test_sizes_of_groups():
    text = "size low 0.1\nsize ground 0.2\nsize contact 0.25\n"
    found = chosen(OPEN + text)
    found.store.asks = False
    body, face, zone = found.sizes()
    assert body == {"h": 0.1, "dimension": 3, "on": [1], "around": [1, 2, 3, 4, 5, 6]}
    assert face == {"h": 0.2, "dimension": 2, "on": [5], "around": []}
    assert zone["h"] == 0.25 and {place[2] for place in zone["zone"]} == {2} and zone["from"] == 1
    found = chosen(OPEN + "group none faces 12\nsize none 1\n")
    del found.members[2, "none"]  # as after a cut
    with pytest.raises(Refusal, match=r"^size none: the geometry has nothing in the group none; allowed: a group with"):
        found.sizes()


def square(x, y, first):
    corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1), (x, y)]
    return {
        first + k: curve(lambda t, k=k: np.add(corners[k], t * np.subtract(corners[k + 1], corners[k])))
        for k in range(4)
    }


def test_sizes_in_the_plane():
    """From a curve sizes grow, in its bodies; of ties there is a size of contact only without contacts."""
    lower, upper = square(0, 0, 1), square(0, 1.1, 5)
    made = Outline(False, {1: list(lower), 2: list(upper)}, lower | upper)
    text = (
        "group low surfaces 1\ngroup high surfaces 2\n"
        + BODIES
        + "group up curves 3\ngroup down curves 5\nclamp ground\n"
    )
    text += "group ground plane 0 0 0 1\nsize up 0.05\nsize contact 0.05\n"
    found = Picks(made, case_of(text + "contact up down\n", space=False), True)
    found.choose()
    line, zone = found.sizes()
    assert line == {"h": 0.05, "dimension": 1, "on": [3], "points": line["points"], "faces": [1], "edges": [3, 1, 2, 4]}
    assert 29 <= line["points"] <= 30
    at = np.array(zone["zone"])
    assert np.allclose(at[:, 1], 1) and at[:, 0].min() < 0.05 and at[:, 0].max() > 0.95
    for more, size in (("tie up down\n", 2), ("tie up down\nobstacle low-side plane -9 0 1 0\n", 2)):
        found = Picks(made, case_of(text + "group low-side curves 4\n" + more, space=False), True)
        found.choose()
        assert len(found.sizes()) == size
    assert {place[0] for place in found.sizes()[1]["zone"]} == {0}


# ---------------------------------------------------------------- places and pieces


def store(*faces):
    return Store({k + 1: np.pad(each, ((0, 0), (0, 0), (0, 3 - each.shape[2]))) for k, each in enumerate(faces)})


@pytest.mark.parametrize("nodes", [3, 6])
def test_parts_of_a_piece(nodes):
    """They are the piece; their middles are on it."""
    rng = np.random.default_rng(1)
    made = store(rng.uniform(size=(1, nodes, 3)))
    parts = made.split(made.split(np.array([0])).ravel())
    assert parts.size == len(PARTS[nodes]) ** 2 and (made.root == 0).all() and (made.face == 1).all()
    assert made.split(np.array([0, 0])).tolist() == 2 * [list(range(1, len(PARTS[nodes]) + 1))]
    least, _ = made.closest(made.centre, np.arange(len(made.centre)), np.zeros(len(made.centre), int),
                            np.full(len(made.centre), np.inf), 1e-6)  # fmt: skip
    assert least.max() < 1e-5
    bows = made.bow[[0, 1, -1]]
    assert (bows[1:] < 0.5 * bows[0]).all()


def test_places_and_pieces():
    """The distance from a quadratic piece, and whether pieces surround a place, against many points of the pieces."""
    rng = np.random.default_rng(5)
    corners = 4 * np.array([[np.cos(k), np.sin(k)] for k in np.arange(7) * 2 * np.pi / 7])
    ahead = np.roll(corners, -1, axis=0)
    places = np.stack([corners, ahead, 0.5 * (corners + ahead) + rng.uniform(-0.9, 0.9, (7, 2))], axis=1)
    outline = np.vstack([bent(piece)[:-1] for piece in places])
    spots = rng.uniform(-5, 5, (60, 2))
    made, at = store(places), np.pad(spots, ((0, 0), (0, 1)))
    found, root = made.closest(at, np.arange(60), np.arange(60) % 7, np.full(60, np.inf), 1e-6)
    inside = made.surrounded(at, np.arange(7))
    for k, spot in enumerate(spots):
        away = np.linalg.norm(bent(places[k % 7]) - spot, axis=1).min()
        assert found[k] == pytest.approx(away, abs=1e-4) and root[k] == k % 7
        rise, go = outline[:, 1] > spot[1], np.roll(outline, -1, axis=0)
        x = outline[:, 0] + (spot[1] - outline[:, 1]) / (go[:, 1] - outline[:, 1] + 1e-300) * (go - outline)[:, 0]
        assert inside[k] == ((rise != (go[:, 1] > spot[1])) & (x > spot[0])).sum() % 2
    assert 15 < inside.sum() < 45
    capped, root = made.closest(at, np.arange(60), np.arange(60) % 7, np.full(60, 1e-9), 1e-6)
    assert (capped == 1e-9).all() and (root == -1).all()


@pytest.mark.parametrize("changing", [0, 0.3])
def test_doubt_about_an_outline(changing):
    """The error of quadratic pieces of a curve, whose curvature changes or not, is below its estimate, and not far."""
    turn = np.linspace(0, 1.6, 80001)
    steps = 5 * np.exp(changing * turn[1:, None]) * np.array([np.cos(turn), np.sin(turn)]).T[1:]
    line = np.vstack([[0, 0], np.cumsum(steps * turn[1], axis=0)])
    ends = np.arange(0, 80001, 20000)
    places = np.array([[line[a], line[b], line[(a + b) // 2]] for a, b in pairwise(ends)])
    off = max(np.linalg.norm(line[20000:40001:4] - place, axis=1).min() for place in bent(places[1], 101))
    assert off < store(places).doubt[1] < 12 * off and off < store(places[1:2]).doubt[0] < 400 * off


@pytest.mark.parametrize("components, coarse, fine, margin", SEARCHED)
def test_nearest_pieces(components, coarse, fine, margin):
    """Of two parabolas or paraboloids, cut into few pieces or into many, against distances by Newton's method."""
    upper, lower = UPPER[components - 1], LOWER[components - 1]
    made = store(*(surface.pieces(np.linspace(-1, 1, coarse + 1)) for surface in (upper, lower)))
    grain, made.asks = 2 / fine * (0.75 if components == 1 else 1.1), False
    zone = made.nearest(made.of([1]), made.of([2]), grain, margin, None, made.of([]))
    places = middles_over(upper, np.linspace(-1, 1, fine + 1))
    check_zone(made, zone, places, lower.distance(places), margin, grain)


def check_zone(made, zone, places, distance, margin, grain):
    """The pieces found are those whose middles, `places`, are at most the margin farther away than the nearest."""
    assert len(zone) and 0.5 * grain < made.reach[zone].max() <= grain
    off = np.linalg.norm(made.centre[zone][:, None, : places.shape[1]] - places, axis=2)
    taken = off.argmin(axis=1)
    assert off.min(axis=1).max() < 1e-9 and len(set(taken)) == len(zone)
    more = distance - distance.min()
    assert more[taken].max() < 1.1 * margin and np.delete(more, taken).min() > 0.9 * margin


def shape_of(words):
    kind, *numbers = words.split()
    numbers = [*map(float, numbers), 0]
    return Shape(np.array(numbers[:3]), np.array(numbers[3:6]), numbers[6] if kind != "plane" else 0)


@pytest.mark.parametrize("words", SHAPES)
def test_pieces_nearest_to_an_obstacle(words):
    """Against distances from its shape, outside and inside; a smaller margin asks for a closer look at the outline."""
    grain, margin = 2 / 16 * 1.1, 0.02
    pieces = UPPER[1].pieces(np.linspace(-1, 1, 5))
    made, places = store(pieces), middles_over(UPPER[1], np.linspace(-1, 1, 17))
    zone = made.nearest(made.of([1]), made.of([]), grain, margin, shape_of(words), made.of([]))
    check_zone(made, zone, places, SHAPES[words](places), margin, grain)
    assert made.finest == np.inf
    assert len(made.nearest(made.of([1]), made.of([]), grain, 1e-3, shape_of(words), made.of([]))) == 0
    assert made.finest < np.inf and len(made.closer())


@pytest.mark.parametrize("components", [1, 2])
def test_units_of_length(components):
    """In other units all lengths are as many times greater, curvatures smaller, and as many pieces are found."""
    pieces = UPPER[components - 1].pieces(np.linspace(-1, 1, 5))
    plane = Shape(np.zeros(3), np.eye(3)[components], 0)
    found = []
    for unit in (1.0, 1e-3):
        made = store(unit * pieces)
        zone = made.nearest(made.of([1]), made.of([]), 0.1 * unit, 0.03 * unit, plane, made.of([]))
        made.nearest(made.of([1]), made.of([]), 0.1 * unit, 0.001 * unit, plane, made.of([]))
        bend = abs(made.bends()[0]) if components == 1 else made.sharpest()[0]
        found.append(np.array([bend * unit, made.doubt[0] / unit, len(zone), made.finest / unit]))
    assert (found[0] > 0).all() and found[1] == pytest.approx(found[0], rel=1e-9)
    if components == 1:  # the parabola's in the middle of the first piece, 0.85 from its vertex
        assert found[0][0] == pytest.approx(0.6 / (1 + (0.6 * 0.85) ** 2) ** 1.5, rel=1e-9)


@pytest.mark.parametrize("times", [1.0, 2.0, 6.0, 400.0])
def test_how_much_closer(times):
    """The error falls with the third power of the size: at the size asked for it is 0.15 of the margin; but that is at
    most half as large, and at least a tenth."""
    size, margin = 0.8, 0.01
    made = store(np.array([[[0, 0], [size, 0], [size / 2, 0]]]))
    made.doubt[:] = times * margin
    made.look(np.array([0]), np.array([0]), np.array([0]), margin, None)
    assert made.finest == pytest.approx(size * np.clip((0.15 / times) ** (1 / 3), 0.1, 0.5))


def test_overlap_in_the_plane():
    """Of bodies that overlap all is near that lies in the other body."""

    def circle(y):
        return curve(lambda t: (10 * np.cos(2 * np.pi * t), y + 10 * np.sin(2 * np.pi * t)), 48)

    made = store(circle(0), circle(19))
    made.asks = False
    zone = made.nearest(made.of([1]), made.of([2]), 0.1, 0.005, None, made.of([2]))
    inside = np.linalg.norm(made.centre[zone][:, :2] - [0, 19], axis=1)
    assert len(zone) > 30 and inside.max() < 10.02 and inside.min() == pytest.approx(9, abs=1e-2)


def test_first_of_each_cell():
    places = np.array([[0.1, 0, 0], [0.2, 0, 0], [-0.1, 0, 0], [1.1, 0, 0], [0.15, 0, 0]])
    assert first_of_cell(places, 1).tolist() == [0, 2, 3]


# ---------------------------------------------------------------- files


def test_constants():
    """Names of several DefineConstants, over lines, with values in braces, texts and comments."""
    text = (
        'DefineConstant[ a = {1, Name "size, of ]"}, b = 2, // c = 3\n d ];\nDefineConstant [e = {1, Max 3}];\nf = 1;'
    )
    assert mesher.constants(text) == ["a", "b", "d", "e"]


@pytest.mark.parametrize("text, alone", [
    ("Point(1) = {0, 0, 0};\n", True),
    ('Merge "a.step";\n', False),
    ("// Merge \n", True),
    ('Printf("Include");\n', True),
    ("x = OnelabRun;\n", False),
])  # fmt: skip
def test_stands_alone(tmp_path, text, alone):
    file = tmp_path / "a.geo"
    file.write_text(text)
    assert mesher.stands_alone(file) is alone
    Path(f"{file}.opt").touch()
    assert not mesher.stands_alone(file)


def test_files_refused(tmp_path):
    geo, step = tmp_path / "a.geo", tmp_path / "a.step"
    geo.write_text("DefineConstant[ r = 1, size = {2, Name 'size of the elements'} ];\n")
    step.touch()
    mesher.check_file(geo, [("r", 2)])
    for file, sets, said in (
        (tmp_path, (), "a folder, no mesh"),
        (Path("/dev/null"), (), "no file: a pipe or a device"),
        (step, [("r", 1)], "-set: it has no numbers to be set; allowed: with a .geo file"),
        (geo, [("q", 1)], "-set q: no number of it that can be set; allowed: r size"),
    ):
        with pytest.raises(GmshError, match=f"^{said}$"):
            mesher.check_file(file, sets)
    geo.write_text('Merge "b.geo";\n')
    mesher.check_file(geo, [("q", 1)])


def test_smaller(tmp_path):
    file = tmp_path / "a.geo"
    file.write_text('DefineConstant[ h = {2, Name "size of the elements"} ];\n')
    assert mesher.smaller(file) == "lower sizes (-set h, or size contact in the case file)"
    file.write_text("")
    assert mesher.smaller(file) == "lower sizes (size contact in the case file)"
    assert mesher.smaller(Path("a.STEP")) == "lower sizes (size contact, size NAME in the case file)"


def test_whole_meshes(tmp_path):
    file = tmp_path / "a.msh"
    assert not mesher.whole(file)
    for text, is_whole in (
        ("$PhysicalNames\n$EndElements\n", True),
        ("$EndElements\n", False),
        ("$PhysicalNames\n$End", False),
    ):
        file.write_text(text)
        assert mesher.whole(file) is is_whole


def test_left_behind(tmp_path):
    """Of killed runs nothing stays; of living ones all does."""
    name = f".making-{os.uname().nodename}-"
    for process in (os.getpid(), 99999999):
        (tmp_path / f"{name}{process}").mkdir()
    mesher.tidy(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == [f"{name}{os.getpid()}"]
    assert mesher.write_whole(tmp_path / "a", "text") and (tmp_path / "a").read_text() == "text"
    assert not mesher.write_whole(tmp_path / "none/a", "text")


def test_nearest_of_small_pieces():
    """Of small pieces far from the origin the nearest one, as each is compared with each."""
    rng = np.random.default_rng(5)
    small = 0.01 * rng.normal(size=(90, 3, 3)) + rng.uniform(100, 104, (90, 1, 3))
    store = Store({1: np.concatenate([small, (small + np.roll(small, -1, 1)) / 2], axis=1)})
    a, b = store.of([1])[:30], store.of([1])[30:]
    off, there = nearest_pieces(store, a, b)
    every = np.array([[float(distances(store.centre[k], store.nodes[[j]])[0]) for j in b] for k in a])
    assert off == pytest.approx(every.min(axis=1)) and (there == b[every.argmin(axis=1)]).all()
    away = apart(store.centre[a], store.centre[b])
    assert away == pytest.approx(np.linalg.norm(store.centre[a][:, None] - store.centre[b], axis=2), abs=1e-5)


# ---------------------------------------------------------------- with gmsh's module

FLAT = """SetFactory("OpenCASCADE"); DefineConstant[ w = 1 ];
Rectangle(1) = {0, 0, 0, w, 1}; Rectangle(2) = {0, 1, 0, 1, 1};
Physical Surface("low", 1) = {1}; Physical Surface("high", 2) = {2};
Physical Curve("top", 3) = {7}; Physical Curve("foot", 4) = {1};
"""
PRESSED = BODIES + "clamp foot\nobstacle top plane 0 3 0 -1\n"


@pytest.fixture
def module(monkeypatch, tmp_path_factory):
    """gmsh's module, that of the system where this Python has none."""
    if find_spec("gmsh") is None:
        system = Path("/usr/lib/python3/dist-packages/gmsh.py")
        if not system.exists():
            pytest.skip("gmsh's module is missing")
        folder = tmp_path_factory.mktemp("module")
        (folder / "gmsh.py").symlink_to(system)
        monkeypatch.syspath_prepend(folder)


def made_of(folder, geo, case, space=False, **more):
    file = folder / "a.geo"
    file.write_text(geo)

    def read(groups, bodies):
        return read_case(case, Where(space=space, bodies=bodies), groups)

    return mesher.prepare(file, space, case, case and read, folder, **more)


def elements(path):
    """(kind of gmsh's, tag of a group): how many."""
    rows = [row.split() for row in Path(path).read_text().splitlines()]
    at = rows.index(["$Elements"]) + 2
    found = {}
    for row in rows[at : at + int(rows[at - 1][0])]:
        found[row[1], row[3]] = found.get((row[1], row[3]), 0) + 1
    return found


def test_prepared_and_kept(module, tmp_path):
    """A mesh is made once, for its numbers and its case; then gmsh is not asked."""
    cache, case = tmp_path / "cache", PRESSED + "join low high part\nsize low 0.3\n"
    cache.mkdir()
    made = made_of(tmp_path, FLAT, case, cache=cache, sets=[("w", 1)])
    assert Path(made.mesh).parent == cache and made.version and made.case.groups.all and not made.touch
    assert {kind for kind, _ in elements(made.mesh)} == {"8", "9"} and not made.surface
    plan = json.loads(Path(made.plan).read_text())
    assert plan["operations"] == [["share", [1, 2]]] and [size["h"] for size in plan["sizes"]] == [0.3]
    again = made_of(tmp_path, FLAT, case, cache=cache, sets=[("w", 1)])
    again.case = made.case
    assert again == made
    other = made_of(tmp_path, FLAT, case, cache=cache, sets=[("w", 0.9)])
    assert other.mesh != made.mesh
    view, finer = tmp_path / "v.pos", tmp_path / "b.msh"
    view.write_text('View "" {\nST(-9,-9,0,99,-9,0,-9,99,0){0.1,0.1,0.1};\n};\n')
    assert mesher.again(tmp_path / "a.geo", False, Path(made.plan), view, finer) is None
    many, few = (sum(n for (kind, _), n in elements(mesh).items() if kind == "9") for mesh in (finer, made.mesh))
    assert many > 4 * few


def test_mesh_in_space(module, tmp_path):
    """Tetrahedra, and the surfaces of second order."""
    geo = 'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1};\n'
    geo += 'Physical Volume("all") = {1}; Physical Surface("foot") = {5}; Mesh.MeshSizeMax = 0.5;\n'
    case = "body all E 1 nu 0\nclamp foot\ngroup up plane 0 0 1 0 0 1\nobstacle up plane 0 0 2 0 0 -1\n"
    made = made_of(tmp_path, geo, case, True, check=True)
    assert {kind for kind, _ in elements(made.mesh)} == {"2", "4"}
    assert {"8", "9"} <= {kind for kind, _ in elements(made.surface)}
    assert "volume 1 (all): from (0, 0, 0) to (1, 1, 1)" in made.table and made.faces.startswith("face,body,x0")
    table = made_of(tmp_path, geo, None, True)
    assert "     6  plane           0.5 0.5 1" in table.table and table.mesh == ""


@pytest.mark.parametrize("geo, space, said", [
    ("Exit;\n", False, r"gmsh makes no mesh of it: it ends gmsh \(Exit\)"),
    ("foo bar\n", False, "gmsh cannot read it: .*line 1: Unknown variable 'bar'"),
    ("", False, "no surface in it"),
    (FLAT, True, r"the mesh is plane, it has no volumes: use edp/parts\.edp"),
    (FLAT.partition("Physical")[0], False, "no physical groups: bodies and boundaries have no names"),
    (FLAT + "For k In {0 : 1e15}\nEndFor\n", False, "gmsh takes longer than 0.3 s"),
])  # fmt: skip
def test_geometries_refused(module, tmp_path, geo, space, said):
    with pytest.raises(GmshError, match=f"^{said}"):
        made_of(tmp_path, geo, PRESSED, space, limit=0.3 if "1e15" in geo else 60)


def test_case_refused_in_the_child(module, tmp_path):
    """It comes back as it is, with its line; nothing is left."""
    with pytest.raises(Refusal, match=r"^none: plane: no curve lies there") as refusal:
        made_of(tmp_path, FLAT, PRESSED + "group none plane 0 7 0 1\npressure none 1\n")
    assert refusal.value.line == 5 and [path.name for path in tmp_path.iterdir()] == ["a.geo"]


def test_converted(module, tmp_path):
    (tmp_path / "a.stl").touch()
    with pytest.raises(GmshError, match=r"^the triangles of a surface alone"):
        mesher.convert(tmp_path / "a.stl", tmp_path / "b.msh")
    made = made_of(tmp_path, FLAT, PRESSED)
    mesher.convert(Path(made.mesh), tmp_path / "b.msh")
    assert elements(tmp_path / "b.msh")["9", "1"] == elements(made.mesh)["9", "1"]
