"""The reader of geometries: kinds, areas, sides and neighbours of faces made here, and gmsh's process with a stand-in.

No test needs gmsh.
"""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from freefem import ROOT
from reader import geometry as geo
from reader import gmsh_process
from reader.gmsh_process import GmshError, in_child
from reader.neighbours import by_face, distances, one_shape, part_on, parts_of, statements, touching


def patch(place, n=4, m=4):
    """Triangles of second order of a surface with parameters in the unit square."""
    pieces = []
    for i in range(n):
        for j in range(m):
            a, b, c, d = ((i / n, j / m), ((i + 1) / n, j / m), ((i + 1) / n, (j + 1) / m), (i / n, (j + 1) / m))
            for corners in ((a, b, c), (a, c, d)):
                sides = [(np.add(corners[k], corners[(k + 1) % 3]) / 2) for k in range(3)]
                pieces.append([place(*at) for at in (*corners, *sides)])
    return np.array(pieces, dtype=float)


def curve(place, n=6):
    """Segments of second order of a curve in the plane with a parameter from 0 to 1."""
    ends = np.arange(n) / n
    return np.array([[[*place(t), 0] for t in (s, s + 1 / n, s + 0.5 / n)] for s in ends], dtype=float)


def box(x, y, z, size=(1, 1, 1), first=1):
    """The six faces of a box from a corner, numbered."""
    low, high = np.array([x, y, z], float), np.array([x, y, z], float) + size
    faces = {}
    for k in range(3):
        for end in (low, high):

            def place(u, v, k=k, end=end):
                at = low + (high - low) * np.insert([u, v], k, 0)
                at[k] = end[k]
                return at

            faces[first + len(faces)] = patch(place, 2, 2)
    return faces


def solid(pieces, bodies=None):
    return geo.Outline(True, bodies or {1: list(pieces)}, pieces)


def plane_face(place, others=None):
    """A curve of a body in the plane, with what closes it."""
    pieces = {1: curve(place), **(others or {})}
    made = geo.Outline(False, {1: list(pieces)}, pieces)
    return geo.faces(made)[0]


TURN = np.linalg.qr(np.array([[1.0, 2, 3], [0, 1, 4], [5, 6, 0]]))[0]
AT = np.array([3.0, -2, 7])


def turned(u, v, w):
    return TURN @ np.array([u, v, w]) + AT


def closed(radius, slope=0.0, height=4.0):
    """A cylinder or a cone around a turned axis, in three faces, with its lids."""

    def wall(part):
        def place(u, v):
            r, t = radius + slope * height * (v - 0.5), 2 * np.pi * (part + u) / 3
            return turned(r * np.cos(t), r * np.sin(t), height * (v - 0.5))

        return place

    def lid(end):
        def place(u, v):
            r, t = (radius + slope * height * end) * u, 2 * np.pi * v
            return turned(r * np.cos(t), r * np.sin(t), height * end)

        return place

    return {k + 1: patch(wall(k), 12, 6) for k in range(3)} | {4: patch(lid(-0.5), 4, 36), 5: patch(lid(0.5), 4, 36)}


# ---------------------------------------------------------------- kinds, areas, sides


def test_box():
    """Planes with their middles, areas and normals out of the body."""
    found = geo.faces(solid(box(1, 2, 3, (2, 4, 6))))
    assert [face.kind for face in found] == ["plane"] * 6
    assert [face.area for face in found] == pytest.approx([24, 24, 12, 12, 8, 8])
    assert np.allclose(
        [face.way for face in found], [[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]]
    )
    assert np.allclose(found[1].spot, [3, 4, 6]) and found[1].bodies == [1] and not found[1].hollow


@pytest.mark.parametrize("slope, kind", [(0, "cylinder"), (0.25, "cone"), (-0.25, "cone")])
def test_round_bodies(slope, kind):
    found = geo.faces(solid(closed(5.0, slope)))
    assert [face.kind for face in found] == [kind] * 3 + ["plane"] * 2
    for face in found[:3]:
        assert face.radius == pytest.approx(5 + slope**2 * 4**2 / 60, rel=1e-3)  # beside the middle of the area
        assert not face.hollow
        assert abs(face.way @ TURN[:, 2]) == pytest.approx(1, abs=1e-6)
        assert np.linalg.norm(np.cross(face.spot - AT, TURN[:, 2])) < 1e-5
        assert face.tilt == pytest.approx(np.arctan(abs(slope)), abs=1e-5)
        assert face.area == pytest.approx(2 * np.pi / 3 * 5 * 4 * np.hypot(1, slope), rel=1e-3)


def test_cone_from_an_axis_that_is_turned():
    """Newton's method turns the axis; point and radius are those beside the origin."""
    nodes = np.concatenate([closed(5.0, 0.25)[k].reshape(-1, 3) for k in (1, 2, 3)])[::7] - AT + 2 * TURN[:, 0]
    start = (TURN[:, 2] + 0.2 * TURN[:, 0]) / np.hypot(1, 0.2)
    point, axis, radius, slope = geo.cone(nodes, start)
    assert np.allclose(np.abs(axis @ TURN[:, 2]), 1, atol=1e-9) and radius == pytest.approx(5, rel=1e-3)
    assert np.allclose(point, 2 * TURN[:, 0], atol=1e-4) and abs(slope) == pytest.approx(0.25, rel=1e-3)


def test_bore():
    """A cylinder inside a box is hollow, and the box's sides still look outwards."""

    def wall(u, v):
        return 2 + np.cos(2 * np.pi * u), 2 + np.sin(2 * np.pi * u), 4 * v

    pieces = box(0, 0, 0, (4, 4, 4)) | {7: patch(wall, 24, 4)}
    found = geo.faces(solid(pieces))
    assert (found[6].kind, found[6].hollow) == ("cylinder", True)
    assert np.allclose(found[0].way, [-1, 0, 0])


def test_ball():
    def octant(u, v):
        t, p = np.pi / 2 * u, np.pi * (v - 0.5)
        return turned(3 * np.cos(t) * np.cos(p), 3 * np.sin(t) * np.cos(p), 3 * np.sin(p))

    (face,) = geo.faces(geo.Outline(True, {}, {1: patch(octant, 6, 12)}))
    assert (face.kind, face.radius) == ("sphere", pytest.approx(3, rel=1e-6))
    assert np.allclose(face.spot, AT, atol=1e-5)
    assert face.area == pytest.approx(np.pi * 9, rel=1e-6)


def test_other_faces():
    """A torus and a wave are none of these kinds; a plane that is bent by more than 1e-6 of its size is none."""

    def torus(u, v):
        r = 5 + np.cos(u)
        return r * np.cos(v), r * np.sin(v), np.sin(u)

    for place in (torus, lambda u, v: (u, v, np.sin(u * v))):
        assert geo.face_of(geo.Outline(True, {}, {1: patch(place)}), 1).kind == "other"
    for bend, kind in ((1e-8, "plane"), (1e-4, "other")):
        made = geo.Outline(True, {}, {1: patch(lambda u, v, bend=bend: (u, v, bend * u**3))})
        assert geo.face_of(made, 1).kind == kind


def test_curves_in_the_plane():
    line = plane_face(
        lambda t: (3 * t, 4 * t), {2: curve(lambda t: (3 - 3 * t, 4)), 3: curve(lambda t: (0, 4 - 4 * t))}
    )
    assert (line.kind, line.area) == ("line", pytest.approx(5))
    assert np.allclose(line.way, [0.8, -0.6, 0]) and np.allclose(line.spot, [1.5, 2, 0])


def test_arcs():
    """A hole in a square, in four arcs; lengths of arcs."""
    sides = {
        k + 1: curve(lambda t, k=k: ((t * 8 - 4, -4), (4, t * 8 - 4), (4 - t * 8, 4), (-4, 4 - t * 8))[k])
        for k in range(4)
    }
    arcs = {
        5 + k: curve(lambda t, k=k: (np.cos((k + t) * np.pi / 2), np.sin((k + t) * np.pi / 2)), 16) for k in range(4)
    }
    found = geo.faces(geo.Outline(False, {1: [*sides, *arcs]}, sides | arcs))
    assert [face.kind for face in found] == ["line"] * 4 + ["circle"] * 4
    assert all(face.hollow for face in found[4:]) and found[4].area == pytest.approx(np.pi / 2, rel=1e-6)
    assert np.allclose([face.way for face in found[:4]], [[0, -1, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0]])
    disc = geo.faces(geo.Outline(False, {1: [*arcs]}, arcs))
    assert not any(face.hollow for face in disc)


# ---------------------------------------------------------------- neighbours


def two_boxes(gap=0.0, size=(1, 1, 1), at=(0, 0)):
    lower, upper = box(0, 0, 0), box(*at, 1 + gap, size, first=7)
    made = solid(lower | upper, {1: list(lower), 2: list(upper)})
    return made, geo.faces(made)


def test_touching():
    """Faces on each other, also where one is the smaller; not across a gap, not beside each other, not flush sides."""
    made, found = two_boxes()
    assert touching(made, found) == {(1, 2): [(6, 11)]}
    small, faces = two_boxes(size=(0.2, 0.2, 1), at=(0.4, 0.4))
    assert touching(small, faces) == {(1, 2): [(6, 11)]}
    for other in (two_boxes(gap=1e-4), two_boxes(at=(1.5, 0))):
        assert touching(*other) == {}
    assert by_face(touching(made, found)) == {6: [11], 11: [6]}


def test_statements_of_bodies_that_touch():
    """Bodies without names get one; the smaller face is the slave."""
    made, found = two_boxes(size=(0.5, 0.5, 1), at=(0.2, 0.2))
    text = statements(made, found, touching(made, found))
    assert "volumes 1 and 2 touch (faces 6 on 11): nothing joins them" in text
    assert "  group V1 volumes 1\n  group V2 volumes 2\n  join V2 V1 part" in text
    made.names[1] = "base"
    text = statements(made, found, touching(made, found))
    assert "group V1" not in text and "  join V2 base tie" in text


def test_shared_faces():
    made = solid(box(0, 0, 0) | {7: box(0, 0, 1, first=7)[12]}, {1: [1, 2, 3, 4, 5, 6], 2: [6, 7]})
    assert geo.faces(made)[5].bodies == [1, 2]
    assert touching(made, geo.faces(made)) == {}


def face(kind, spot, way=(0, 0, 0), radius=0.0, tilt=0.0, area=1.0):
    return geo.Face(1, kind, np.array(spot, float), np.array(way, float), area, [1], radius, tilt)


HALF = np.arctan(0.5)
ONE = [
    (face("plane", (0, 0, 0), (0, 0, 1)), face("plane", (5, 5, 0), (0, 0, -1)), True),
    (face("plane", (0, 0, 0), (0, 0, 1)), face("plane", (5, 5, 1e-3), (0, 0, 1)), False),
    (face("plane", (0, 0, 0), (0, 0, 1)), face("plane", (0, 0, 0), (0, 0.6, 0.8)), False),
    (face("sphere", (0, 0, 0), radius=2), face("sphere", (0, 0, 0), radius=2), True),
    (face("sphere", (0, 0, 0), radius=2), face("sphere", (0, 0, 0), radius=2.1), False),
    (face("cylinder", (0, 0, 0), (0, 0, 1), 2), face("cylinder", (0, 0, 9), (0, 0, 1), 2), True),
    (face("cylinder", (0, 0, 0), (0, 0, 1), 2), face("cylinder", (1, 0, 9), (0, 0, 1), 2), False),
    (face("cylinder", (0, 0, 0), (0, 0, 1), 2), face("plane", (0, 0, 0), (0, 0, 1)), False),
    (face("cone", (0, 0, 0), (0, 0, 1), 2, HALF), face("cone", (0, 0, 2), (0, 0, 1), 3, HALF), True),
    (face("cone", (0, 0, 0), (0, 0, 1), 2, HALF), face("cone", (0, 0, 2), (0, 0, 1), 1, HALF), True),
    (face("cone", (0, 0, 0), (0, 0, 1), 2, HALF), face("cone", (0, 0, 2), (0, 0, 1), 2, HALF), False),
    (face("other", (0, 0, 0), area=2), face("other", (0, 0, 0), area=2), True),
    (face("other", (0, 0, 0), area=2), face("other", (0, 0, 0), area=2.1), False),
]  # fmt: skip


@pytest.mark.parametrize("f, g, same", ONE)
def test_one_shape(f, g, same):
    assert bool(one_shape(f, g, 1e-6, 1.0)) is same


def test_distances():
    """From places above, beside and beyond a triangle and a segment."""
    triangle = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.5, 0, 0], [0.5, 0.5, 0], [0, 0.5, 0]]], float)
    places = np.array([[0.2, 0.2, 3], [-1, -1, 0], [1, 1, 0], [0.5, -2, 0], [-3, 0.5, 0]], float)
    assert distances(places, triangle) == pytest.approx([3, 2**0.5, 0.5**0.5, 2, 3])
    segment = np.array([[[0, 0, 0], [2, 0, 0], [1, 0, 0]]], float)
    assert distances(places, segment) == pytest.approx([9.04**0.5, 2**0.5, 1, 2, (9.25) ** 0.5])
    assert parts_of(triangle)[0, 0] == pytest.approx([1 / 6, 1 / 6, 0]) and parts_of(segment)[0, 1] == pytest.approx(
        [1.5, 0, 0]
    )
    shifted = triangle + np.array([0.3, 0.3, 0])
    assert part_on(triangle, shifted, 1e-6) and not part_on(triangle, shifted + 2, 1e-6)


def test_table():
    """The columns of -check 1."""
    made, found = two_boxes()
    made.names[2] = "upper"
    lines = geo.table(made, found, {6: [11]}).splitlines()
    assert lines[0] == "volume 1: from (0, 0, 0) to (1, 1, 1), faces 1 2 3 4 5 6"
    assert lines[1].startswith("volume 2 (upper): from (0, 0, 1) to (1, 1, 2)")
    assert lines[9].split() == ["6", "plane", "0.5", "0.5", "1", "0", "0", "1", "-", "1", "1;", "on", "11"]


# ---------------------------------------------------------------- gmsh's process


@pytest.fixture
def stand_in(monkeypatch):
    """A module that takes the place of gmsh in the child."""
    options = {}
    module = SimpleNamespace(
        initialize=lambda words, readConfigFiles: options.update(files=readConfigFiles),
        option=SimpleNamespace(setNumber=options.__setitem__, getString=lambda name: "4.8.4", all=options),
    )
    monkeypatch.setitem(sys.modules, "gmsh", module)
    return module


def gone(process):
    """Whether a process has ended, soon."""
    for _ in range(200):
        try:
            os.kill(process, 0)
        except ProcessLookupError:
            return True
        if Path(f"/proc/{process}/stat").read_text().rsplit(")")[-1].split()[0] == "Z":
            return True
        time.sleep(0.02)
    return False


def test_child_answers(stand_in):
    """Its answer comes whole; gmsh starts without files of options; the child's output goes nowhere."""

    def task(gmsh):
        print("said by gmsh")
        return gmsh.option.all, list(range(100000))

    options, numbers = in_child(task)
    assert options["files"] is False and options["General.Terminal"] == 0 and options["General.AbortOnError"] == 2
    assert numbers[-1] == 99999


def test_child_refuses(stand_in):
    with pytest.raises(GmshError, match=r"^no such thing$"):
        in_child(lambda gmsh: (_ for _ in ()).throw(ValueError("no such thing")))
    with pytest.raises(GmshError, match=r"gmsh makes no mesh of it: it ends gmsh \(Exit\)"):
        in_child(lambda gmsh: os._exit(0))
    with pytest.raises(GmshError, match=r"gmsh crashed \(SIGSEGV\)"):
        in_child(lambda gmsh: os.kill(os.getpid(), signal.SIGSEGV))


def test_endless_geometry(stand_in, tmp_path, monkeypatch):
    """It is ended at a limit; lines say meanwhile that gmsh is at work."""
    monkeypatch.setattr(gmsh_process, "FIRST", 0.05)
    monkeypatch.setattr(gmsh_process, "NEXT", 0.1)
    said = []

    def task(gmsh):
        (tmp_path / "pid").write_text(str(os.getpid()))
        time.sleep(60)

    with pytest.raises(GmshError, match=r"gmsh takes longer than 0\.5 s"):
        in_child(task, "a.geo", limit=0.5, say=said.append)
    assert (
        said[0] == "gmsh meshes a.geo ..."
        and said[1] == "gmsh has been at work on a.geo for 0.1 s; Ctrl-C ends the run"
    )
    assert said[2].endswith("for 0.2 s; Ctrl-C ends the run")
    assert gone(int((tmp_path / "pid").read_text()))


def test_interrupted(stand_in, tmp_path):
    """What ends the reader's waiting ends gmsh."""

    def say(text):
        raise KeyboardInterrupt

    def task(gmsh):
        (tmp_path / "pid").write_text(str(os.getpid()))
        time.sleep(60)

    gmsh_process.FIRST, before = 0.3, gmsh_process.FIRST
    try:
        with pytest.raises(KeyboardInterrupt):
            in_child(task, "a.geo", say=say)
    finally:
        gmsh_process.FIRST = before
    assert gone(int((tmp_path / "pid").read_text()))


def test_child_dies_with_its_parent(tmp_path):
    """Also of a parent that is killed."""
    text = f"""
import os, sys, time, types
sys.path.insert(0, {str(ROOT / "edp/input")!r})
option = types.SimpleNamespace(setNumber=lambda *_: None)
sys.modules["gmsh"] = types.SimpleNamespace(initialize=lambda *_, **__: None, option=option)
from reader.gmsh_process import in_child
def task(gmsh):
    open("pid.part", "w").write(str(os.getpid())); os.rename("pid.part", "pid"); time.sleep(60)
in_child(task)
"""
    parent = subprocess.Popen([sys.executable, "-c", text], cwd=tmp_path)
    for _ in range(500):
        if (tmp_path / "pid").exists():
            break
        time.sleep(0.02)
    parent.kill()
    parent.wait()
    assert gone(int((tmp_path / "pid").read_text()))


# ---------------------------------------------------------------- which Python


def python(path, code):
    """A stand-in for Python that says which it is, and ends with this code: 12 without the modules."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\necho {path}\nexit {code}\n")
    path.chmod(0o755)


@pytest.mark.parametrize("codes, variables, tried, code", [
    ({".venv/bin/python": 0, "bin/python3": 0}, {}, [".venv/bin/python"], 0),
    ({".venv/bin/python": 12, "bin/python3": 3}, {}, [".venv/bin/python", "bin/python3"], 3),
    ({".venv/bin/python": 0, "own": 0}, {"CONTACT_PYTHON": "own"}, ["own"], 0),
    ({".venv/bin/python": 1, "own": 12}, {"CONTACT_PYTHON": "own"}, ["own", ".venv/bin/python"], 1),
    ({".venv/bin/python": 0, "own": 5}, {"CONTACT_READER": "own"}, ["own"], 5),
    ({"cache/venv/bin/python": 0, "bin/python3": 0}, {"CONTACT_CACHE": "cache"}, ["cache/venv/bin/python"], 0),
])  # fmt: skip
def test_which_python(tmp_path, codes, variables, tried, code):
    """The first that has both modules; its exit code is that of the program."""
    for name, each in codes.items():
        python(tmp_path / name, each)
    (tmp_path / "edp/input").mkdir(parents=True)
    shutil.copy(ROOT / "edp/input/read.sh", tmp_path / "edp/input")
    environment = {"PATH": f"{tmp_path}/bin:/usr/bin:/bin"}
    environment |= {name: str(tmp_path / path) for name, path in variables.items()}
    command = ["sh", tmp_path / "edp/input/read.sh", "1", "ready"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    found = [str(Path(line).resolve()) for line in done.stdout.splitlines()]
    assert (found, done.returncode) == ([str(tmp_path / name) for name in tried], code)


def test_no_python(tmp_path):
    """Where none has both, one line says how to get them; a Python without numpy says so by its code."""
    script = tmp_path / "edp/input/read.sh"
    script.parent.mkdir(parents=True)
    script.write_text((ROOT / "edp/input/read.sh").read_text().replace(" python3 /usr/bin/python3;", ";"))
    done = subprocess.run(["sh", script, "1", "ready"], env={"PATH": "/usr/bin:/bin"}, capture_output=True, text=True)
    assert done.returncode == 12 and done.stdout.count("\n") == 1
    assert "allowed: Debian's packages python3-numpy and python3-gmsh" in done.stdout
    command = [sys.executable, "-I", "-S", ROOT / "edp/input/read.py", "ready"]
    assert subprocess.run(command, capture_output=True).returncode == 12
