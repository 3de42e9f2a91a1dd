"""Bodies that turn by any angle, each solved in axes of its own: as the same mesh drawn turned, as statics."""

import csv
import itertools
import re
from itertools import count

import numpy as np
import pytest
from error.test_linear_gaps import PLANK, STANDING
from freefem import ROOT, data, part, snippet, told
from input.test_parts import Mesh, block, cube, vector

from postprocess.bodies import read_bodies
from postprocess.results import read_run

DISC = "body disc E 1e5 nu 0.3\nobstacle rim plane 0 4.99 0 -1\n"
ROLLER = "body disc E 1e5 nu 0.3\nbody block E 2e5 nu 0.3\ncontact {}\nclamp bottom\nrotate shaft 0 0 {}\n"


def rotation(angle, axis=(0, 0, 1)):
    """Rodrigues' formula."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    across = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * across + (1 - np.cos(angle)) * across @ across


def ring(mesh, sectors, layers=6, inner=2.0, outer=5.0, squeeze=1.0):
    """A ring of equal sectors, or an ellipse, all cut alike: groups rim, shaft, body disc."""
    radii = [outer - (outer - inner) * (k / layers) ** 1.5 for k in range(layers + 1)]
    turns = 2 * np.pi * np.arange(sectors) / sectors + np.pi / 2
    nodes = [(r * np.cos(a), (1 - (1 - squeeze) * (r == outer)) * r * np.sin(a), 0) for r in radii for a in turns]

    def number(k, i):
        return k * sectors + i % sectors

    sides = [("rim", (number(0, i), number(0, i + 1))) for i in range(sectors)]
    sides += [("shaft", (number(layers, i + 1), number(layers, i))) for i in range(sectors)]
    bodies = []
    for k, i in itertools.product(range(layers), range(sectors)):
        a, b, c, d = number(k, i), number(k, i + 1), number(k + 1, i), number(k + 1, i + 1)
        bodies += [("disc", (a, b, d)), ("disc", (a, d, c))]
    mesh.add(nodes, sides, bodies)
    return mesh


@pytest.fixture
def solve(tmp_path):
    """solve(mesh, case, *flags) runs a case; its summary and what it printed."""
    numbers = count()

    def go(mesh, case, *flags, **how):
        done = part(tmp_path / str(next(numbers)), mesh, case, *flags, **how)
        return done.summary if done.code == 0 else {}, done.stdout

    return go


def force(summary, number=0):
    """(value, error) of a contact's force."""
    entry = summary["estimates"]["contacts"][number]["normalForce"]
    return entry["value"], entry["error"]


def test_equal_sectors(solve):
    """A disc of equal sectors, turned by some of them: the same force and error, and no word of it."""
    mesh = ring(Mesh(), 72).text()
    for flags, turns in (((), (35,)), (("-distance", "exact"), (11,))):
        true = force(solve(mesh, f"{DISC}clamp shaft\n", *flags)[0])
        for sectors in turns:
            angle = 2 * np.pi * sectors / 72
            summary, stdout = solve(mesh, f"{DISC}rotate shaft 0 0 {angle!r}\n", *flags)
            told = force(summary)
            assert told[0] == pytest.approx(true[0], rel=1e-8) and told[1] == pytest.approx(true[1], rel=1e-5)
            assert summary["bodies"][0]["motion"][2] == pytest.approx(angle, abs=1e-5)
            assert "finite rotations" not in stdout and "linearised" not in stdout


@pytest.mark.parametrize("contact", ["rim top", "top rim"])
def test_master_or_slave(solve, contact):
    """An elliptic ring that turns above a block, as its slave and as its master: as drawn turned."""
    below = {"size": (4, 2), "cells": (24, 6), "at": (-2, -6.98)}
    still = block(Mesh(), **below)
    turned, drawn = ring(block(Mesh(), **below), 72, squeeze=0.98), ring(block(Mesh(), **below), 72, squeeze=0.98)
    size = len(still.nodes)
    drawn.nodes[size:] = [tuple(rotation(1.2) @ np.array(place)) for place in drawn.nodes[size:]]
    for flags in ((), ("-distance", "exact", "-steps", 3)):
        true = force(solve(drawn.text(), ROLLER.format(contact, 0), *(flags[:-2] if "-steps" in flags else flags))[0])
        said = force(solve(turned.text(), ROLLER.format(contact, 1.2), *flags)[0])
        assert true[0] > 1 and said[0] == pytest.approx(true[0], rel=1e-6 if "-steps" in flags else 1e-9)


def test_loads_and_supports(solve):
    """Weight and traction keep their direction, a pressure goes with its side; moments where the body is."""
    matrix = rotation(0.7)
    loads = "body block E 100 nu 0.3\nobstacle bottom plane 0 -9 0 1\nweight block 0.1 -0.3\n"
    loads += "traction top 0.2 0.1\npressure right 0.4\n"
    mesh = block(Mesh())
    true = solve(mesh.text(matrix), f"{loads}clamp left\n")[0]
    told = solve(mesh.text(), f"{loads}rotate left 0 0 0.7\n")[0]
    assert told["bodies"][0]["reaction"] == pytest.approx(true["bodies"][0]["reaction"], rel=1e-9)


SLOW = [flags for flags in ((), ("-distance", "exact"))]


@pytest.mark.parametrize("flags", [("-order", 1), *SLOW])
def test_skew_axis(solve, flags):
    """A box in space turned about a skew axis against a sphere: force, error and reactions of the box drawn turned."""
    axis, matrix = (1, 2, -1.5), rotation(1.7, (1, 2, -1.5))
    mesh = cube(Mesh(), cells=(6, 6, 3))
    top = matrix @ np.array((1, 1, 1))
    normal = matrix @ np.array((0, 0, 1))
    shape = f"obstacle top sphere {' '.join(map(repr, map(float, top + 2.99 * normal)))} R 3\n"
    case = f"body block E 100 nu 0.3\n{shape}"
    true = solve(mesh.text(matrix), f"{case}clamp bottom\n", *flags, space=True)[0]
    turns = f"rotate bottom 0 0 0 {vector(axis, dimension=3)} 1.7\n"
    told = solve(mesh.text(), case + turns, *flags, space=True)[0]
    assert force(told) == pytest.approx(force(true), rel=1e-8)
    assert told["bodies"][0]["reaction"] == pytest.approx(true["bodies"][0]["reaction"], rel=1e-8)
    turned = np.array(told["bodies"][0]["motion"][3:])
    assert turned == pytest.approx(1.7 * np.array(axis) / np.linalg.norm(axis), abs=0.02)


def test_lever_at_rest(solve):
    """A plank that tilts until both feet stand: statics where it stands, and how far its weight has gone."""
    geo = PLANK.replace("0.02}", "0.004}")
    summary, _ = solve(geo, STANDING + "weight plank 0 -1\n", "-distance", "exact", "-order", 4)
    area, tilt = 40 + np.pi, np.arcsin(0.3 / 6)
    middle = (80 - 2 / 3 * 2) / area
    right = area * (0.5 + middle * np.tan(tilt) / 6)
    for number, true in enumerate((area - right, right)):
        assert force(summary, number)[0] == pytest.approx(true, rel=2e-4)
    motion = summary["bodies"][0]["motion"]
    assert motion[2] == pytest.approx(-tilt, rel=1e-3)
    # the mean between the feet goes down by 0.15, the middle of the area, above it, by its tilt besides
    down = 0.15 + (1 - np.cos(tilt)) * middle
    assert -motion[1] == pytest.approx(down, rel=2e-3)
    (way,) = summary["estimates"]["loads"]
    assert way["way"]["value"] == pytest.approx(down, rel=2e-3)


def test_rod_in_a_bowl(solve):
    """It leans on a rim: two points bear it, the next have hardly a lever; where they bear is in the errors."""
    r, half, rim, length, tilt = 5, 0.2, 0.5, 10, 0.5
    along, up = np.array([np.cos(tilt), np.sin(tilt)]), np.array([-np.sin(tilt), np.cos(tilt)])
    place = tilt - np.pi - np.arcsin((half + rim - 6 * np.sin(tilt)) / (r - half))
    foot = (r - half) * np.array([np.cos(place), np.sin(place)])
    corners = [(0, -half, 0.03), (9.4, -half, 0.03), (length, -half, 0.1), (length, half, 0.2), (0, half, 0.1)]
    corners += [(0, 0, 0.1), (-half, 0, 0.03)]
    places = [(*(foot + u * along + v * up), size) for u, v, size in corners]
    geo = "".join("Point({}) = {{{}, {}, 0, {}}};\n".format(k + 1, *place) for k, place in enumerate(places))
    geo += "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Circle(5) = {5, 6, 7};"
    geo += 'Circle(6) = {7, 6, 1}; Curve Loop(1) = {1:6}; Plane Surface(1) = {1}; Physical Surface("rod") = {1};\n'
    geo += 'Physical Curve("lower") = {1, 2}; Physical Curve("end") = {5, 6};\n'
    case = "body rod E 1e9 nu 0.3\nobstacle end circle 0 0 R 5 inside\nobstacle lower circle 6 0 R 0.5\n"
    case += "weight rod 0 -1\n"
    summary, _ = solve(geo, case, "-distance", "exact")
    for number, true in enumerate((2.73605635, 1.84753534)):  # statics: the lowest place of the middle
        value, error = force(summary, number)
        assert abs(value - true) < error < 0.02 * true
    assert any("way of weight rod, counted from the first touch, is" in text for text in summary["warnings"])


def test_pushed_group(solve):
    """A body that turns and has a force on a group: it follows along the force as it is, in one step or three."""
    case = "body block E 100 nu 0.3\nobstacle bottom circle 1.785 0.209 R 1\nforce right -2 0\n{} left {}\n"
    mesh = block(Mesh())
    true = solve(mesh.text(rotation(0.7)), case.format("clamp", ""), "-distance", "exact")[0]
    for steps in (3,):
        told = solve(mesh.text(), case.format("rotate", "0 0 0.7"), "-distance", "exact", "-steps", steps)[0]
        assert force(told)[0] == pytest.approx(force(true)[0], rel=1e-8)
        ways = [run["estimates"]["loads"][0]["way"]["value"] for run in (true, told)]
        assert ways[1] == pytest.approx(ways[0], rel=1e-8)


def test_other_scripts(solve, tmp_path):
    """A script that reads parts.edp rotates bodies by any angle, or only by small ones: none stays as it is drawn."""
    (tmp_path / "edp").symlink_to(ROOT / "edp")
    (tmp_path / "own.edp").write_text('include "parts.edp"\n')
    lab, own = {"script": "edp/labs/9-own-part/own-part.edp"}, {"script": tmp_path / "own.edp"}
    mesh, flags, angle = ring(Mesh(), 36, 3).text(), ["-order", 1, "-estimate", 0], 2 * np.pi * 11 / 36
    centre = np.linalg.solve(np.eye(2) - rotation(angle)[:2, :2], [0, 0.005])  # about it the disc also goes up by 0.005
    cases = [(f"{vector(centre)} {angle!r}", lab), ("-1 0 0.005", own)]
    runs = [solve(mesh, f"{DISC}rotate shaft {numbers}\n", *flags, **how)[0] for numbers, how in cases]
    for run in runs:
        assert run["contacts"][0]["normalForce"] == pytest.approx(1.5 * 661, rel=0.02)  # 661 of the disc as it is drawn
    assert "scripts that read the option" in solve(mesh, f"{DISC}rotate shaft 0 0 0.7\n", expect=10, **own)[1]


def test_refused(solve):
    """Large rotations of what is held besides, and by methods that do not know them."""
    mesh = block(Mesh()).text()
    case = "body block E 100 nu 0.3\nobstacle top plane 0 2 0 -1\nrotate left 0 0 0.7\n"
    for more, flags in (("clamp right\n", ()), ("", ("-method", "newton")), ("", ("-accuracy", 0.1))):
        _, stdout = solve(mesh, case + more, *flags, expect=10)
        assert "rotate left: the angle 0.7; allowed: between -0.5 and 0.5, or with -method xnewton" in stdout


GEAR = (ROOT / "tests/data/gear-pair.geo", "units mm MPa\nbody pinion E 206e3 nu 0.3\nbody wheel E 206e3 nu 0.3\n")


@pytest.mark.parametrize("angle", [-0.1, 0.1])
def test_gears(solve, angle):
    """A pair of teeth rolls: the moments' ratio, the same in one step as in ten, eight linearisations a step."""
    geo, bodies = GEAR
    case = bodies + "contact wheel-flank pinion-flank\n"
    case += f"rotate wheel-rim 0 75 {-angle * 2 / 3!r}\nrotate pinion-rim 0 -50 {angle + 0.0002!r}\n"
    moments = {}
    for steps in (1, 10):
        summary, _ = solve(geo.read_text(), case, "-distance", "exact", "-steps", steps, "-history", 1)
        wheel, pinion = (entry["moment"] for entry in summary["prescribed"])
        assert summary["newton"] <= 8 * steps
        assert wheel / pinion == pytest.approx(1.5, rel=1e-3)
        moments[steps] = wheel
    assert moments[10] == pytest.approx(moments[1], rel=1e-5)


HOOK = data("turning/hook.geo")


def series(folder):
    """A run's load series, by column."""
    with (folder / "out/series.csv").open() as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def test_hook_in_and_out(solve, tmp_path):
    """A hook that slides over a bump, on to points that nothing faced at first, shall press, and be free at the end."""
    case = "body hook E 2800 nu 0.39\nbody catch E 2800 nu 0.39\ncontact nose bump\nclamp root\nmove base -4.8 0\n"
    whole = solve(HOOK, case, "-distance", "exact", "-history", 1, "-estimate", 0, "-steps", 10)[0]
    assert abs(whole["contacts"][0]["normalForce"]) < 1e-9
    steps = series(tmp_path / "0")
    assert steps["nose bump normal force"][4] > 0.05
    assert steps["stored energy"][-1] == 0 and steps["move base displacement"][-1] == pytest.approx(4.8)
    # the force turns round on the bump's top, where most is stored
    top = steps["stored energy"].argmax()
    assert steps["move base reaction"][: top + 1].max() > 0 > steps["move base reaction"][top + 1 :].min()


SNAP = "units mm MPa\nstate stress\nbody hook E 2600 nu 0.35\nbody latch E 2600 nu 0.35\nclamp floor\n"
SNAP += "size nose 0.1\nsize edge {}\ncontact nose edge {}\nmove root 1.8 0\n"


@pytest.mark.parametrize("edge", [0.1, 0.03])
def test_hook_on_an_edge(solve, tmp_path, edge):
    """A hook that bends far beyond what faced it: a beam's force; each gap is the distance to the edge's round shape.

    The beam: 8/12 mm^4, 25 mm long, then the stiff nose, touched 1.63 mm farther on and 2.1 mm below its axis, where
    the ramp, by then at 33.9 degrees, has to go 0.706 mm back along its normal.
    """
    solve(data("turning/snap.geo"), SNAP.format(edge, ""), "-distance", "exact", "-order", 1, "-estimate", 0, "-vtu", 1)
    bodies = read_bodies(read_run(tmp_path / "0/out"))
    gap, pressure = -bodies.table["overlap"], bodies.table["pressure"]
    assert (pressure * bodies.table["weight"]).sum() == pytest.approx(0.3147, rel=0.01)
    beyond = np.maximum(np.array([28.7, -np.inf]) - bodies.points[:, :2], bodies.points[:, :2] - [31.1, -0.5])
    distance = np.hypot(*np.maximum(beyond, 0).T) - 0.3
    assert distance[pressure > 0] == pytest.approx(0, abs=0.005)
    near = gap < 100  # others face nothing
    assert near.sum() > 10 and gap[near] == pytest.approx(distance[near], abs=0.04)


def test_cam_off_its_roller(solve):
    """A cam that turns away from where surfaces were paired: equilibrium of circles, in a step of a few rounds."""
    case = "units mm MPa\nstate strain\nbody cam E 210e3 nu 0.3\nbody roller E 210e3 nu 0.3\n"
    groups = ("cam surfaces 11", "roller surfaces 12", "lobe curves 1", "shaft curves 2")
    groups += ("tread curves 3", "bore curves 4")
    case += "".join(f"group {group}\n" for group in groups)
    case += "size tread 0.4\nsize lobe 0.5\nsize bore 1.5\ncontact tread lobe\nforce bore 0 -1000\n"
    case += "rotate shaft 0 0 0.4\n"
    summary, stdout = solve(data("turning/cam.geo"), case, "-distance", "exact", "-order", 1, "-estimate", 0)
    lean = np.arcsin(10 * np.cos(np.pi / 6 + 0.4) / 42)
    assert summary["contacts"][0]["normalForce"] == pytest.approx(1000 / np.cos(lean), rel=1e-3)
    assert summary["newton"] <= 12
    # as drawn, not where the step has turned the cam into the roller
    assert float(re.search(r", initial gap (\S+) to ", stdout)[1]) < 1e-3
    assert "overlap" not in stdout.split("Results")[0]
    assert not any("before any load" in text for text in summary["warnings"])


def slab(matrix=None):
    """A thin slab of half a cylinder on one of a block, of boxes of equal sizes, bent."""
    mesh = cube(Mesh(), size=(5, 0.5, 2), cells=(25, 2, 1), at=(-3, 0, -2), prefix="b")
    first = len(mesh.nodes)
    cube(mesh, size=(1, 0.5, 1), cells=(40, 2, 1), prefix="c", name="cylinder")
    for k, (a, y, c) in enumerate(mesh.nodes[first:]):
        radius, angle = 2 * (1 - 0.75 * c), (a - 0.5) * np.pi
        mesh.nodes[first + k] = (-1 + radius * np.sin(angle), y, 2 - radius * np.cos(angle))
    return mesh.text() if matrix is None else mesh.text(matrix)


@pytest.mark.parametrize("turns", [0, 1])
def test_dragged_in_space(solve, tmp_path, turns):
    """A cylinder dragged over elements of a block between mirrors: hardly a force, steady energy, turned the same."""
    case = "body block E 100 nu 0.3\nbody cylinder E 100 nu 0.3\ncontact btop cbottom interference 0.03\n"
    case += "clamp bbottom\nsymmetry bleft\nsymmetry bright\nsymmetry cleft\nsymmetry cright\nmove ctop {}\n"
    flags = ("-distance", "exact", "-history", 1, "-steps", 3, "-order", 1, "-estimate", 0)
    runs = []
    for number, turned in enumerate((np.eye(3), rotation(0.8, (1, -2, 0.5)))[: 1 + turns]):
        way = " ".join(repr(float(v)) for v in turned @ (0.6, 0, 0))
        summary, _ = solve(slab(turned), case.format(way), *flags, space=True)
        runs.append(series(tmp_path / str(number)))
        assert summary["newton"] <= 8 * 3
    told = runs[0]
    assert told["stored energy"] == pytest.approx(told["stored energy"].mean(), rel=0.01)
    assert abs(told["move ctop reaction"]).max() < 3e-3 * told["btop cbottom normal force"].min()
    for name in ("stored energy", "btop cbottom normal force"):
        assert runs[-1][name] == pytest.approx(told[name], rel=1e-5)


ROUNDS = data("turning/rounds.edp")


@pytest.mark.parametrize(
    "module, call",
    [
        ("solver/large-rotation/rotation-steps", "iterateRotations(1)"),
        ("contact/friction/geometry-updates", "iterateGeometry(1, 0)"),
    ],
)
def test_forces_that_go_to_and_fro_turn_no_bodies(tmp_path, module, call):
    """After rounds that end nowhere a load step ends: bodies would turn to and fro, too. Otherwise they turn until they
    rest, and a body that does not is told to be held."""
    start = f"func int {call.split('(')[0]}(int step"
    bodies = (ROOT / f"edp/{module}.idp").read_text().split(start)
    follow = [start + text[: text.index("\n}\n") + 3] for text in bodies[1:] if text.split("\n")[1].startswith("//")]
    tries = [("rests", 2, 99), ("swings", 99, 1), ("later", 99, 3), ("turns", 99, 99)]
    text = "".join(f'tried({turning}, {swings});\n{call};\ntellTried("{name}");\n' for name, turning, swings in tries)
    found = told(snippet(tmp_path, ROUNDS + follow[0] + text))
    assert found["rests"].tolist() == [3, 0, 0]
    assert found["swings"].tolist() == [1, 0, 1]
    assert found["later"].tolist() == [3, 0, 1]
    assert found["turns"][1] == 1 and found["turns"][0] > 10
