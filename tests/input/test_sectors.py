"""Sectors of bodies: symmetries in several planes, also across no axis; how many times the whole has a load; places."""

import re

import numpy as np
import pytest
from freefem import cases_of, part
from physics.test_moments import fit
from shapes import moved

from input.test_parts import STEEL, Mesh, block, cube, turn, turn_in_space, vector
from input.test_zoo import gmsh

RINGS = "state stress\nbody shaft E 210e3 nu 0.3\nbody hub E 210e3 nu 0.3\ncontact bore seat interference 0.01"
APART = "symmetry low\nsymmetry high\n"


def rings(folder, angle, one=True, size=2.5):
    """A mesh's text of a sector of rings 5 to 10 and 10 to 20, from the x axis on; its cuts in one group or in two."""
    radii = ((10, 5), (20, 10), (30, 10), (40, 20))
    ends = [(n, k, r * np.cos(k * angle), r * np.sin(k * angle)) for n, r in radii for k in (0, 1)]
    geo = f"h = {size}; Point(1) = {{0, 0, 0, h}};\n"
    geo += "".join(f"Point({n + 1 + k}) = {{{x:.17g}, {y:.17g}, 0, h}};\n" for n, k, x, y in ends)
    geo += "".join(f"Circle({n}) = {{{n + 1}, 1, {n + 2}}};\n" for n, _ in radii)
    for n, name in ((10, "shaft"), (30, "hub")):
        geo += f"Line({n + 1}) = {{{n + 1}, {n + 11}}}; Line({n + 2}) = {{{n + 2}, {n + 12}}};\n"
        geo += f"Curve Loop({n}) = {{{n + 1}, {n + 10}, -{n + 2}, -{n}}}; Plane Surface({n}) = {{{n}}};\n"
        geo += f'Physical Surface("{name}") = {{{n}}};\n'
    cuts = {"cuts": "11, 31, 12, 32"} if one else {"low": "11, 31", "high": "12, 32"}
    for name, curves in {"inside": 10, "seat": 20, "bore": 30, "rest": 40, **cuts}.items():
        geo += f'Physical Curve("{name}") = {{{curves}}};\n'
    return gmsh(folder, "a.msh", geo, "-2", "-order", 2, "-format", "msh22").read_text()


def phases(matrix, angle):
    """Friction in two load phases, along the middle of the sector."""
    middle = np.array([np.cos(angle / 2), np.sin(angle / 2)])
    loads = (6, 3), (-20, 10)
    return " friction 0.02\n" + "".join(
        f"leg 1\ntraction rest {vector(size * middle, matrix)}\npressure inside {pressure}\n"
        for size, pressure in loads
    )


def test_sector_in_two_phases(tmp_path):
    """One group in two planes is both; a sector turned by 17 degrees has the same forces, shears and supports."""
    angle = np.pi / 3
    found = []
    for k, (degrees, one) in enumerate(((0, False), (17, False), (17, True))):
        matrix = turn(np.radians(degrees))
        folder = tmp_path / str(k)
        folder.mkdir()
        text = RINGS + phases(matrix, angle)
        head, legs = text.split("leg 1", 1)
        text = head + ("symmetry cuts\n" if one else APART) + "leg 1" + legs
        run = part(folder, moved(rings(folder, angle, one, 4), matrix[:2, :2]), text, "-estimate", 0, "-tol", 1e-10)
        contact = run.contacts[0]
        supports = [np.hypot(*each["force"]) for each in run.summary["supports"]]
        found.append([contact["normalForce"], np.hypot(*contact["shearForce"]), *supports])
    assert found[1] == pytest.approx(found[0], rel=1e-6) and found[0][1] > 0
    assert found[2] == pytest.approx(found[1], rel=1e-9)
    assert "symmetry cuts of line 5 is in 2 planes: cuts 1 with the normal (0.2924, -0.9563) and cuts 2" in run.stdout
    assert contact["across"] == ["cuts 1", "cuts 2"]


@pytest.mark.parametrize(
    ("degrees", "times"), cases_of([(60, 6), (120, None)], [(60, 6), (120, None), (45, 8), (36, 10), (72, None)])
)
def test_whole_of_a_sector(tmp_path, degrees, times):
    """A press fit's pressure is Lame's in each sector; the whole has a sector's load so many times, if images close."""
    angle = np.radians(degrees)
    matrix = turn(0.3)
    case = f"{RINGS}\nsymmetry cuts\npressure rest 0.001\n"
    run = part(tmp_path, moved(rings(tmp_path, angle), matrix[:2, :2]), case, "-estimate", 0)
    assert run.contacts[0]["normalForce"] == pytest.approx(angle * 10 * 0.01 / fit("stress")[0], rel=2e-3)
    (load,) = run.summary["prescribed"]
    assert load["times"] == times and load["cancelled"] == pytest.approx(1)


def test_part_of_a_sector(tmp_path):
    """A load that reaches one of two oblique symmetries has an image there alone, which is not the whole."""
    mesh = block(Mesh(), (3, 2), (6, 4))
    right, lower = mesh.group(1, "right"), mesh.group(1, "lower")
    at = np.array(mesh.nodes)[:, 1]
    mesh.elements = [
        (kind, lower if tag == right and max(at[node - 1] for node in nodes) < 1.1 else tag, nodes)
        for kind, tag, nodes in mesh.elements
    ]
    mesh.nodes = [(x, y * (1 + 0.6 * x), z) for x, y, z in mesh.nodes]
    case = f"{STEEL}obstacle left plane 0 0 1 0\nsymmetry bottom\nsymmetry top\ntraction lower -1 0\n"
    run = part(tmp_path, mesh.text(), case, "-estimate", 0)
    (load,) = run.summary["prescribed"]
    assert (load["times"], load["images"]) == (2, ["bottom"])
    words = r"^  traction lower +2.8 with its image in symmetry bottom 2 times as much: 5.6$"
    assert re.search(words, run.stdout, re.M), run.stdout


@pytest.mark.parametrize(
    ("sides", "force", "times"), [("left back bottom", 4, 8), ("left right back bottom", 4 / (1 - 0.3**2), 4)]
)
def test_planes_in_space(tmp_path, sides, force, times):
    """Sides of a cube in one group, turned at random: it gives way as a bar or a strip does, in two load phases."""
    matrix = turn_in_space(3)
    mesh = cube(Mesh(), size=(2, 2, 1), cells=(2, 2, 1)).text(matrix)
    for name in sides.split():
        mesh = mesh.replace(f'"{name}"', '"sides"')
    at, down = vector((0, 0, 1), matrix, 3), vector((0, 0, -1), matrix, 3)
    case = f"{STEEL}symmetry sides\nweight block {vector((0, 0, -1e-9), matrix, 3)}\n"
    case += f"leg 1\nobstacle top plane {at} {down} move {vector((0, 0, -0.05), matrix, 3)}\n"
    case += f"leg 1\nobstacle top move {vector((0, 0, -0.01), matrix, 3)}\n"
    run = part(tmp_path, mesh, case, "-estimate", 0, space=True)
    assert run.contacts[0]["normalForce"] == pytest.approx(force, rel=1e-6)
    assert [each["name"] for each in run.summary["supports"]] == [
        f"symmetry sides {k + 1}" for k in range(len(sides.split()))
    ]
    assert [each["times"] for each in run.summary["prescribed"] if each["name"] == "weight block"] == [times]


@pytest.mark.parametrize("curved", [True, False])
def test_refused(tmp_path, curved):
    """Four planes that turn by 30 degrees each are a coarse curve; two that a contact has too are not taken apart."""
    mesh = block(Mesh(), (4, 4), (4, 1))
    angle = np.pi / 6 * (np.array(mesh.nodes)[:, 0] - 2)
    if curved:
        away = 10 - np.array(mesh.nodes)[:, 1]
        mesh.nodes = list(np.stack([away * np.sin(angle), away * np.cos(angle), 0 * angle], axis=1))
    text = mesh.text().replace('"top"', '"sides"').replace('"right"', '"right"' if curved else '"sides"')
    case = f"{STEEL}obstacle bottom plane 0 0 0 1\nsymmetry sides\n" + ("" if curved else "contact bottom sides\n")
    said = part(tmp_path, text, case, expect=10).stdout
    why = "curved, by 30 degrees at (" if curved else "in 2 planes, and line 4"
    assert f'symmetry "sides" of the case file, line 3: {why}' in said


def test_coarse_curve_is_refused(tmp_path):
    """Two sides of a quarter circle turn by 45 degrees: their middles say that they are curved."""
    geo = "Point(1) = {0, 0, 0, 9}; Point(2) = {5, 0, 0, 9}; Point(3) = {0, 5, 0, 9}; Circle(1) = {2, 1, 3};\n"
    geo += "Line(2) = {3, 1}; Line(3) = {1, 2}; Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};\n"
    geo += 'Transfinite Curve {1} = 3; Physical Surface("block") = {1};\n'
    geo += 'Physical Curve("round") = {1}; Physical Curve("foot") = {3};\n'
    run = part(tmp_path, geo, f"{STEEL}obstacle foot plane 0 0 0 1\nsymmetry round\n", expect=10)
    assert 'symmetry "round" of the case file, line 3: curved at (' in run.stdout


PIN = """SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 1}; Rectangle(2) = {-3, -2, 0, 6, 4}; Disk(3) = {0, 0, 0, RADIUS};
BooleanDifference(4) = { Surface{2}; Delete; }{ Surface{3}; Delete; };
"""


@pytest.mark.parametrize(
    ("radius", "at", "found"),
    [("1", "near 0 1", ""), ("1", "near 0 0.9", ""), ("1.001", "near 0 1", "pin"), ("1.001", "near 0 1.001", "plate")],
)
def test_near_equal_circles(tmp_path, radius, at, found):
    """A pin and a hole of the same radius are equally near to a place: refused. A thousandth between them is enough."""
    case = "group pin surfaces 1\ngroup plate surfaces 4\nbody pin E 1 nu 0\nbody plate E 1 nu 0\n"
    case += f"group seat {at}\ngroup foot plane 0 -2 0 1\nclamp foot\nobstacle seat plane 0 9 0 -1\n"
    run = part(tmp_path, PIN.replace("RADIUS", radius), case, "-check", 1, expect=0 if found == "pin" else 10)
    if found:
        assert ("pin: no contact touches it" in run.stdout) == (found == "plate")  # the obstacle is the plate's
    else:
        assert re.search(
            r"line 5: near 0 [01.9]+: the curves \d of body \d and \d of body \d are equally near", run.stdout
        )
