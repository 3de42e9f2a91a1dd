"""`size contact` is where contacts are, whatever their curves; what a run says of gaps and of places that slide away.

Two ellipses with random axes and turns touch at the places whose normals are opposite: no other code is needed to know
where. Splines are held against the same, for a line between them, normal to both, is the shortest.
"""

import json
import os
import re
import subprocess
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from freefem import ROOT, environment, part
from reader import Where, mesher, read_case
from reader.near import Store

BODIES = "body A E 200e3 nu 0.3\nbody B E 200e3 nu 0.3\ncontact a b\n"
PRESSED = BODIES + "clamp b-base\nmove a-base 0 {}\n"


def turned(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def closed(number, places, kind):
    """A body of one closed curve as a .geo file: of an ellipse centre, ends of the axes; of a spline its points."""
    first = 100 * number
    lines = [f"Point({first + k}) = {{{x:.15g}, {y:.15g}, 0}};" for k, (x, y) in enumerate(places)]
    if kind == "Ellipse":
        arcs = [(first + 1 + k, first, first + 1, first + 1 + (k + 1) % 4) for k in range(4)]
    else:
        ends = [first + k * len(places) // 4 for k in range(4)] + [first + len(places)]
        arcs = [[*range(a, b), b if b < first + len(places) else first] for a, b in pairwise(ends)]
    lines += [f"{kind}({first + k}) = {{{', '.join(map(str, arc))}}};" for k, arc in enumerate(arcs)]
    curves = f"{{{first}:{first + 3}}}"
    lines += [f"Curve Loop({number}) = {curves}; Plane Surface({number}) = {{{number}}};"]
    names = "?ab"[number]
    lines += [f'Physical Curve("{names}") = {curves}; Physical Surface("{names.upper()}") = {{{number}}};']
    return "\n".join(lines) + "\n"


def ellipse(rng, way):
    """Centre and ends of the axes of an ellipse whose farthest point along `way` is the origin; its radius there."""
    long = np.exp(rng.uniform(0, 3))
    axes = np.array([long, long * rng.uniform(0.15, 0.95)])
    turn = turned(rng.uniform(0, 2 * np.pi))
    along = turn.T @ way
    unit = axes * along / np.linalg.norm(axes * along)
    radius = np.linalg.norm(axes * unit[::-1]) ** 3 / axes.prod()
    return np.array([[0, 0], [1, 0], [0, 1], [-1, 0], [0, -1]]) * axes @ turn.T - turn @ (axes * unit), radius


def sides(folder, geo, case):
    """Middles (n, 2) and lengths (n) of the boundary's sides of the mesh that the reader makes."""
    (folder / "a.geo").write_text(geo)
    (folder / "a.case").write_text(case)
    words = [str(os.getpid()), folder / "a.geo", folder / "read", folder / "a.case", "0", "solve", ""]
    done = subprocess.run(["sh", ROOT / "edp/input/read-case.sh", *words], env={**os.environ, "LC_ALL": "C"})
    assert done.returncode == 0, (folder / "read/why").read_text()
    rows = [row.split() for row in (folder / "read/mesh.msh").read_text().splitlines()]
    subprocess.run(["rm", "-r", folder / "read"], check=True)
    first = rows.index(["$Nodes"]) + 2
    at = 1e-6 * np.array([row[1:3] for row in rows[first : first + int(rows[first - 1][0])]], float)
    ends = np.array([row[-2:] for row in rows[rows.index(["$Elements"]) + 2 : -1] if row[1] == "1"], int) - 1
    return at[ends].mean(axis=1), np.linalg.norm(at[ends[:, 0]] - at[ends[:, 1]], axis=1)


def check_place(middles, lengths, true, way, h, radius, gap=0.0):
    """The fine sides lie around `true`, as many on one hand as on the other, over what is as near as 0.05 h."""
    along = (middles - true) @ np.array([-way[1], way[0]])
    near = np.linalg.norm(middles - true, axis=1) < 2.5 * h + abs(gap)
    assert near.sum() >= 8 and lengths[near].max() < 1.4 * h, (near.sum(), lengths[near] / h)
    fine = lengths < 1.3 * h
    zone = np.sqrt(2 * radius * (0.05 * h + max(-gap, 0)))
    low, high = along[fine].min(), along[fine].max()
    assert abs(low + high) < 0.3 * zone + 2 * h, (low / h, high / h, zone / h)
    assert 0.6 * zone < 0.5 * (high - low) < 1.5 * zone + 7 * h, (low / h, high / h, zone / h)


SEEDS = [1, 2, 3, 9, *(k for k in range(4, 24) if k != 9)]


@pytest.mark.parametrize("seed", SEEDS)
def test_where_curves_are_nearest(tmp_path, seed):
    rng = np.random.default_rng(seed)
    angle = rng.uniform(0, 2 * np.pi)
    way = np.array([np.cos(angle), np.sin(angle)])
    (low, first), (high, second) = ellipse(rng, way), ellipse(rng, -way)
    radius = 1 / (1 / first + 1 / second)
    h = radius * 10 ** rng.uniform(-2.7, -1.3)
    gap = rng.choice([0, -1e-3, 0.3]) * h
    geo = closed(1, low, "Ellipse") + closed(2, high + gap * way, "Ellipse")
    found = sides(tmp_path, geo, f"size contact {h:.6g}\n{BODIES}pressure a 1\n")
    check_place(*found, gap / 2 * way, way, h, radius, gap)


def egg(count, turn):
    """Points, as far from each other along it, of a curve with a varying curvature; the origin is its lowest point."""
    angle = np.linspace(-np.pi, np.pi, 40001)
    radius = 5 + 3 * np.sin(2 * angle) + 1.5 * np.sin(angle) ** 2
    parts = np.array([radius * np.cos(angle), radius * np.sin(angle), radius]).T
    x, y, along = np.vstack([np.zeros(3), np.cumsum(parts[1:] + parts[:-1], axis=0) * np.pi / 40000]).T
    assert np.hypot(x[-1], y[-1]) < 1e-6
    spots = (np.arange(count) + 0.3) / count * along[-1]
    places = [np.interp(spots, along, x - x[20000]), np.interp(spots, along, y - y[20000])]
    return np.transpose(places) @ turned(turn).T


def height(folder, geo, way):
    """Places along and across `way` of the part of a curve below the middle of its height, from a very fine mesh."""
    (folder / "fine.geo").write_text(geo)
    sizes = "-clmin", "0.002", "-clmax", "0.002"
    done = subprocess.run(["gmsh", "-1", *sizes, "-format", "msh22", folder / "fine.geo", "-o", folder / "fine.msh"])
    rows = [row.split() for row in (folder / "fine.msh").read_text().splitlines()]
    first = rows.index(["$Nodes"]) + 2
    at = np.array([row[1:3] for row in rows[first : first + int(rows[first - 1][0])]], float)
    across, along = at @ [-way[1], way[0]], at @ way
    low = along < 0.2 * np.ptp(along) + along.min()
    order = np.argsort(across[low])
    assert done.returncode == 0
    return across[low][order], along[low][order]


@pytest.mark.parametrize("other", ["Spline", "Line"])
def test_where_splines_are_nearest(tmp_path, other):
    """Curvature varies along the contact, and from point to point of a spline; a line's outline is exact."""
    h, turn = 0.02, 0.7
    way = turned(turn) @ [0.0, 1.0]
    upper = closed(2, egg(64, turn), "Spline")
    lower = np.array([[30, 0], [-20, 0], [-20, -9], [30, -9]]) @ turned(turn).T
    lower = closed(1, lower if other == "Line" else egg(64, turn + np.pi), other)
    grid = np.linspace(-1, 1, 4001)
    gap = np.interp(grid, *height(tmp_path, upper, way))
    if other == "Spline":
        across, along = height(tmp_path, lower, -way)
        gap += np.interp(grid, -across[::-1], along[::-1])
    zone = grid[gap < gap.min() + 0.05 * h]
    middles, lengths = sides(tmp_path, lower + upper, f"size contact {h}\n{BODIES}pressure a 1\n")
    across = middles @ [-way[1], way[0]]
    fine = np.sort(across[lengths < 1.3 * h])
    assert lengths[(across > zone[0]) & (across < zone[-1]) & (abs(middles @ way) < 0.1)].max() < 1.3 * h
    assert 2 * h < zone[0] - fine[0] < 10 * h and 2 * h < fine[-1] - zone[-1] < 10 * h, (zone / h, fine / h)


def test_what_overlaps_is_in_contact(tmp_path):
    """Of bodies that overlap all is fine that lies in the other body, not only where their curves cross."""
    geo = closed(1, [(0, 0), (10, 0), (0, 10), (-10, 0), (0, -10)], "Ellipse")
    geo += closed(2, [(0, 19), (10, 19), (0, 29), (-10, 19), (0, 9)], "Ellipse")
    middles, lengths = sides(tmp_path, geo, f"size contact 0.1\n{BODIES}pressure a 1\n")
    inside = (abs(np.linalg.norm(middles, axis=1) - 10) < 1e-3) & (np.linalg.norm(middles - [0, 19], axis=1) < 9.95)
    assert inside.sum() > 60 and lengths[inside].max() < 0.15 < 1 < lengths.max()


def bent(piece, count=2001):
    """Places of a quadratic piece (count, 2)."""
    t = np.linspace(0, 1, count)[:, None]
    return piece[0] * (1 - t) * (1 - 2 * t) + piece[1] * t * (2 * t - 1) + 4 * piece[2] * t * (1 - t)


# ---------------------------------------------------------------- surfaces of which the distance is known


class Bent:
    """The curve, or the surface, at the height + bends (x - middle)^2/2, which quadratic pieces have exactly."""

    def __init__(self, height, bends, middle):
        self.height, self.bends, self.middle = height, np.array(bends), np.array(middle)

    def on(self, at):
        """Places over these (..., 1 or 2)."""
        rise = self.height + 0.5 * (self.bends * (at - self.middle) ** 2).sum(axis=-1)
        return np.concatenate([at, rise[..., None]], axis=-1)

    def pieces(self, edges):
        """Over the intervals between these, in space over the halves of the squares: ends or corners, then middles."""
        if len(self.bends) == 1:
            return self.on(np.array([[[a], [b], [0.5 * (a + b)]] for a, b in pairwise(edges)]))
        halves = [
            [(a, c), (b, c), (b, d)] if lower else [(a, c), (b, d), (a, d)]
            for a, b in pairwise(edges)
            for c, d in pairwise(edges)
            for lower in (True, False)
        ]
        corners = np.array(halves, float)
        return self.on(np.concatenate([corners, 0.5 * (corners + np.roll(corners, -1, axis=1))], axis=1))

    def distance(self, places):
        """Of places (n, 2 or 3): where the way to the curve or surface is normal to it, by Newton's method."""
        at = places[:, :-1].copy()
        for _ in range(30):
            slope = self.bends * (at - self.middle)
            off = self.on(at) - places
            lack = off[:, :-1] + off[:, -1:] * slope
            turned = off[:, -1, None, None] * np.diag(self.bends)
            change = np.eye(len(self.bends)) + slope[:, :, None] * slope[:, None, :] + turned
            at -= np.linalg.solve(change, lack[..., None])[..., 0]
        return np.linalg.norm(self.on(at) - places, axis=1)


def middles_over(surface, edges):
    """The middles of its pieces between these, on it."""
    return surface.on(surface.pieces(edges)[:, : 3 if len(surface.bends) == 2 else 2, :-1].mean(axis=1))


UPPER = [Bent(0.03, [0.6], [0.1]), Bent(0.03, [0.6, 0.4], [0.1, -0.05])]
LOWER = [Bent(0, [-0.5], [0.3]), Bent(0, [-0.5, -0.3], [0.3, 0.1])]
SEARCHED = [
    # components, pieces on an axis as they come and as they are found, the margin: for large pieces and for small ones
    (1, 4, 32, 0.02),
    (1, 32, 32, 0.3),
    (2, 2, 16, 0.02),
]


SHAPES = {
    # of an obstacle the words, and a place's distance from it, outside or inside
    "plane 0.3 0.2 -0.1 1 -2 6": lambda at: abs((at - [0.3, 0.2, -0.1]) @ [1, -2, 6]) / np.sqrt(41),
    "cylinder 0 0.4 -1.2 3 0.5 0.2 1": lambda at: abs(
        np.linalg.norm(np.cross(at - [0, 0.4, -1.2], [3, 0.5, 0.2]), axis=1) / np.linalg.norm([3, 0.5, 0.2]) - 1
    ),
    "sphere 0.1 -0.1 2 0 0 0 1.7": lambda at: abs(np.linalg.norm(at - [0.1, -0.1, 2], axis=1) - 1.7),
}


# ---------------------------------------------------------------- what gmsh is told


EMPTY = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n$EndPhysicalNames\n$EndElements\n"


@pytest.fixture
def told(tmp_path, monkeypatch):
    """A function of a geometry, a case and whether in space: places (n, 3) that gmsh is told to mesh finely; places and
    size of each closer look at the outline."""
    if find_spec("gmsh") is None:
        (tmp_path / "gmsh.py").symlink_to("/usr/lib/python3/dist-packages/gmsh.py")
        monkeypatch.syspath_prepend(tmp_path)
    look = mesher.look

    def recorded(gmsh, cad, space, closer=(), listed=False):
        (tmp_path / "closer").write_text(json.dumps([(places.tolist(), size) for places, size in closer]))
        return look(gmsh, cad, space, closer, listed)

    def nothing(session, plan, mesh, surface):
        mesh.write_text(EMPTY)

    monkeypatch.setattr(mesher, "look", recorded)
    monkeypatch.setattr(mesher.Session, "make", nothing)

    def tell(geo, case, space=False):
        file = tmp_path / "a.geo"
        file.write_text(geo)
        made = mesher.prepare(file, space, case, lambda groups, _: read_case(case, Where(space), groups), tmp_path)
        sizes = json.loads(Path(made.plan).read_text())["sizes"]
        places = [place for size in sizes for place in size.get("zone", ())]
        return np.array(places), [(np.array(at), h) for at, h in json.loads((tmp_path / "closer").read_text())]

    return tell


def test_fine_along_all_of_a_contact(told):
    """Two blocks that touch all over have fine places everywhere, also on both hands of 0."""
    h = 0.02
    geo = closed(1, [(-1, -1), (1, -1), (1, 0), (-1, 0)], "Line")
    geo += closed(2, [(-1, 0), (1, 0), (1, 1), (-1, 1)], "Line")
    places, looks = told(geo, f"size contact {h}\n{BODIES}pressure a 1\n")
    along = np.sort(places[abs(places[:, 1]) < 1e-9, 0])
    assert np.diff(along).max() < 3 * h and along[0] < -1 + 2 * h and along[-1] > 1 - 2 * h
    assert len(looks) == 0  # straight curves are as their outline


SPHERES = """
SetFactory("OpenCASCADE");
Sphere(1) = {{{0}, {1}, {2}, 10}}; Sphere(2) = {{{3}, {4}, {5}, 15.2}};
Rotate{{{{1, 2, 3}}, {{{0}, {1}, {2}}}, 0.7}}{{ Volume{{1}}; }}
Rotate{{{{3, 1, 1}}, {{{3}, {4}, {5}}}, 1.3}}{{ Volume{{2}}; }}
Physical Volume("A") = {{1}}; Physical Volume("B") = {{2}};
Physical Surface("a") = Abs(Boundary{{ Volume{{1}}; }}); Physical Surface("b") = Abs(Boundary{{ Volume{{2}}; }});
"""


def test_where_spheres_are_nearest(told):
    """All of the disc is fine where spheres are nearer than 0.05 h, and nothing beside it; it touches at the origin."""
    h, way = 0.03, np.array([2, 3, 6]) / 7
    geo = SPHERES.format(*-10 * way, *15.2 * way)
    places, looks = told(geo, f"size contact {h}\n{BODIES}pressure a 1\n", True)
    radius = np.sqrt(0.1 * h / (1 / 10 + 1 / 15.2))
    assert np.linalg.norm(places, axis=1).max() == pytest.approx(radius, rel=0.1)
    side = np.cross(way, [1, 0, 0]) / np.linalg.norm(np.cross(way, [1, 0, 0]))
    angle, far = np.meshgrid(np.linspace(0, 2 * np.pi, 40), np.linspace(0, radius, 10))
    disc = far[..., None] * (np.cos(angle)[..., None] * side + np.sin(angle)[..., None] * np.cross(way, side))
    off = np.linalg.norm(disc.reshape(-1, 1, 3) - places, axis=2).min(axis=1)
    assert off.max() < 2 * h, off.max() / h
    # one closer look is enough, and it is at the place
    ((closer, size),) = looks
    assert np.linalg.norm(closer, axis=1).min() < size


def test_closer_look(told):
    """One is enough for ellipses: at places no farther apart than its size."""
    geo = closed(1, [(0, -2), (3, -2), (0, 0), (-3, -2), (0, -4)], "Ellipse")
    geo += closed(2, [(0, 5), (9, 5), (0, 10), (-9, 5), (0, 0)], "Ellipse")
    _, looks = told(geo, f"size contact 0.005\n{BODIES}pressure a 1\n")
    ((closer, size),) = looks
    assert np.diff(np.sort(closer[:, 0])).max() < 0.8 * size


def test_closer_look_at_teeth(told):
    """The sizes of the outline are bounded below: gmsh would not end."""
    pair = ROOT / "edp/examples/gear-pair/gear-pair"
    _, looks = told(pair.with_suffix(".geo").read_text(), pair.with_suffix(".case").read_text())
    assert len(looks) == 1 and 0.1 < looks[0][1] < 2
    short = Store({1: np.array([[[0, 0, 0], [0.01, 0, 0], [0.005, 0, 0]]])})
    short.doubt[:] = 1e300
    short.look(np.array([0]), np.array([0]), np.array([0]), 0.4, None)
    assert short.finest == 0.2


# ---------------------------------------------------------------- gaps

RING = """
DefineConstant[ f = {{1, Name "all sizes"}} ];
Point(1) = {{0, 0, 0}}; Point(9) = {{0, {shift}, 0}};
Macro Ring
  For k In {{1:4}}
    Point(at + k) = {{r * Cos(k * Pi / 2), r * Sin(k * Pi / 2) + up, 0}};
  EndFor
  For k In {{1:4}}
    Circle(at + k) = {{at + k, up == 0 ? 1 : 9, at + k % 4 + 1}};
  EndFor
  Curve Loop(at) = {{at + 1 : at + 4}};
Return
up = 0; at = 10; r = 14; Call Ring;
at = 20; r = 10; Call Ring;
up = {shift}; at = 30; r = {radius}; Call Ring;
at = 40; r = 6; Call Ring;
Plane Surface(1) = {{10, 20}}; Plane Surface(2) = {{30, 40}};
Physical Curve("b-base") = {{11:14}}; Physical Curve("b") = {{21:24}};
Physical Curve("a") = {{31:34}}; Physical Curve("a-base") = {{41:44}};
Physical Surface("B") = {{1}}; Physical Surface("A") = {{2}};
Mesh.MeshSizeMax = 1.5;
"""


@pytest.mark.parametrize(
    "radius, shift, said",
    [
        (9.995, 0, r"initial gap 0\.005$"),
        (9.5, -0.4996, r"initial gap 0\.0004 to (1|0\.99\d)$"),  # a clearance is no 0 beside large gaps
        (9.5, -0.5, r"initial gap 0 to (1|0\.99\d)$"),
        (9.5, -0.50001, r"initial gap 0 to (1|0\.99\d)$"),  # rounding of the drawing
        (9.5, -0.52, r"initial gap -0\.02 to (1|0\.99\d|1\.0\d); the surfaces overlap as drawn at [1-9]\d? points$"),
        (10.002, 0, r"initial gap -0\.002; the surfaces overlap as drawn: a press fit$"),
    ],
)
def test_gaps_in_words(tmp_path, radius, shift, said):
    run = part(tmp_path, RING.format(radius=radius, shift=shift), PRESSED.format(-1e-3), "-check", 1)
    (line,) = re.findall(r"^  contact .*$", run.stdout, re.M)
    assert re.search(said, line), line


# ---------------------------------------------------------------- the strip, places that slide away

DISC = """
Point(1) = {0, 10, 0}; Point(2) = {-10, 10, 0}; Point(3) = {0, 0, 0}; Point(4) = {10, 10, 0};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 2};
Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
Point(5) = {-12, 0, 0}; Point(6) = {-12, -8, 0}; Point(7) = {12, -8, 0}; Point(8) = {12, 0, 0};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(2) = {5:8}; Plane Surface(2) = {2};
Physical Curve("round") = {1, 2}; Physical Curve("a-base") = {3};
Physical Curve("flat") = {8}; Physical Curve("b-base") = {6};
Physical Surface("A") = {1}; Physical Surface("B") = {2};
"""
DISC_BODIES = "size A 2\nsize B 2\nbody A E 200e3 nu 0.3\nbody B E 200e3 nu 0.3\nclamp b-base\ncontact "


def test_strip_of_any_sizes(tmp_path):
    """Elements beside a smooth surface may be ten thousand times smaller than others there."""
    case = f"size contact 0.0004\n{DISC_BODIES}round flat\nmove a-base 0 -1e-5\n"
    run = part(tmp_path, DISC, case, "-check", 1)
    assert int(re.search(r"(\d+) curved elements", run.stdout)[1]) > 1000


SLID = f"size contact {{}}\n{DISC_BODIES}flat round\nmove a-base {{}} -0.005\n"


def test_contact_beside_its_fine_elements(tmp_path):
    """A disc moved along a block touches where elements are coarse: lower sizes where it was drawn would not help."""
    run = part(tmp_path, DISC, SLID.format(0.02, 1.5), "-distance", "exact")
    (warning,) = [text for text in run.summary["warnings"] if "points across" in text]
    told = re.search(
        r"use -accuracy or size flat \(points are (\S+) apart where it touches, at \((\S+), (\S+)\), "
        r"and (\S+) apart (\S+) away from there\)",
        warning,
    )
    here, x, y, there, away = map(float, told.groups())
    assert x == pytest.approx(1.5, abs=0.3) and y == pytest.approx(0, abs=0.1)
    assert here > 5 * there and there == pytest.approx(0.01, rel=0.3) and 0.8 < away < 1.5
    # whatever else the run advises, it is that
    cure = run.summary["contacts"][0]["refine"]
    assert cure in warning and cure in run.summary["estimates"]["refine"]
    assert "size contact" not in run.stdout.split("Results")[1]


def test_contact_on_its_fine_elements(tmp_path):
    """Too few points where it was drawn: smaller sizes there."""
    run = part(tmp_path, DISC, SLID.format(0.5, 0), "-distance", "exact")
    (warning,) = [text for text in run.summary["warnings"] if "points across" in text]
    assert "size contact" in warning and "away" not in warning and run.summary["contacts"][0]["refine"] is None


GMSH = """#!/bin/sh
echo "$*" >> "{log}"
for last; do :; done
echo 'Info    : Running [Gmsh 4.8.4, 1 node]'
case $* in *RandomFactor*) ;; *) echo 'Warning : distortion = -0.0003; worst gamma = {gamma}' ;; esac
printf '%s\\n' '$MeshFormat' '2.2 0 8' '$EndMeshFormat' '$PhysicalNames' '$EndPhysicalNames' '$EndElements' > "$last"
"""


@pytest.mark.parametrize("gamma, times", [("1.8e-12", 2), ("0.3", 1)])
def test_meshed_again(tmp_path, gamma, times):
    """gmsh meshes once more, with a smaller random part, if it has left a triangle without area."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/gmsh").write_text(GMSH.format(log=tmp_path / "log", gamma=gamma))
    (tmp_path / "bin/gmsh").chmod(0o755)
    (tmp_path / "a.geo").write_text("")
    words = [str(os.getpid()), tmp_path / "made/a.msh", tmp_path / "a.geo", "-", "-2"]
    env = environment(PATH=f"{tmp_path / 'bin'}:{os.environ['PATH']}")
    assert subprocess.run(["sh", ROOT / "edp/input/make-mesh.sh", *map(str, words)], env=env).returncode == 0
    calls = (tmp_path / "log").read_text().splitlines()
    assert len(calls) == times and ("RandomFactor 1e-11" in calls[-1]) == (times == 2)
