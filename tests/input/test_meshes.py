"""meshes/*.geo: conforming, right in area or volume, grouped as the scripts expect."""

from collections import Counter
from itertools import combinations

import numpy as np
import pytest
from accounts import shared
from freefem import ROOT, execute, run

TETRAHEDRON, TRIANGLE, EDGE = 4, 2, 1
BLOCK = 0.5  # the default depth of a block of width 1
HALF_DISC = np.pi / 2
QUARTER = np.pi / 6  # of a half-ball

# .geo file, and what of it: numbers of its own, {body: area or volume}
MESHES = {
    "block": ([], {"block": BLOCK}),
    "block-and-disc": ([], {"block": BLOCK, "disc": HALF_DISC / 16}),
    "two-discs": ([], {"lower": HALF_DISC, "upper": HALF_DISC}),
    "block-3d": (["h", 0.03, "patch", 0.09], {"block": BLOCK}),
    "block-3d half": (["h", 0.03, "patch", 0.09, "mirrors", 1], {"block": BLOCK / 2}),
    "block-3d quarter": (["h", 0.03, "patch", 0.09, "mirrors", 2], {"block": BLOCK / 4}),
    "block punch": (["sharp", 1], {"block": BLOCK}),
    "block-far": (
        ["depth", 0.5, "h", 0.003, "left", 0.3, "right", 0.7, "fineLeft", 0.45, "fineRight", 0.55],
        {"block": BLOCK},
    ),
    "block-far-3d": (["h", 0.01, "fine", 0.03, "patch", 0.09], {"block": BLOCK}),
    "block-rim-3d": ([], {"block": BLOCK / 4}),
    "quarter-spheres": (["h", 0.05, "layers", 2], {"lower": QUARTER, "upper": QUARTER}),
}


def read(text):
    """({group number: name}, nodes, {element type: [(group, nodes)]}) of a version 2 file."""
    lines = iter(text.splitlines())
    names, nodes, elements = {}, {}, {}
    for line in lines:
        if line == "$PhysicalNames":
            for _ in range(int(next(lines))):
                dimension, number, name = next(lines).split()
                names[int(dimension), int(number)] = name.strip('"')
        if line == "$Nodes":
            for _ in range(int(next(lines))):
                number, *where = next(lines).split()
                nodes[int(number)] = np.array(where, float)
        if line == "$Elements":
            for _ in range(int(next(lines))):
                _, kind, tags, *rest = map(int, next(lines).split())
                elements.setdefault(kind, []).append((rest[0], rest[tags:]))
    return names, nodes, elements


@shared
def made(folder, name, dimension, *numbers):
    """gmsh's mesh of meshes/`name`.geo with these numbers of its own."""
    flags = [
        word for key, value in zip(numbers[::2], numbers[1::2], strict=True) for word in ("-setnumber", key, value)
    ]
    source = ROOT / "meshes" / f"{name}.geo"
    path = folder / "a.msh"
    code, stdout = execute(["gmsh", f"-{dimension}", "-v", 0, "-format", "msh22", *flags, source, "-o", path])
    assert code == 0, stdout
    return read(path.read_text())


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("mesh")


@pytest.fixture(scope="module", params=list(MESHES))
def mesh(request, folder):
    """(bodies' sizes, names, nodes, elements of the bodies, elements of their boundary, dimension)."""
    numbers, sizes = MESHES[request.param]
    source = request.param.split()[0]
    dimension = 3 if source in ("block-3d", "block-far-3d", "block-rim-3d", "quarter-spheres") else 2
    names, nodes, elements = made(folder, source, dimension, *numbers)
    inner, outer = (TETRAHEDRON, TRIANGLE) if dimension == 3 else (TRIANGLE, EDGE)
    return sizes, names, nodes, elements[inner], elements[outer], dimension


def test_all_sources_are_here():
    """Every .geo file shall be among those tested, and the part that they include."""
    assert {path.stem for path in (ROOT / "meshes").glob("*.geo")} == {name.split()[0] for name in MESHES} | {
        "singular"
    }


def test_conforming(mesh):
    """Each side of an element shall be shared by two elements, or lie on the boundary in a named group: no cracks."""
    _, _, _, inner, outer, dimension = mesh
    sides = Counter(tuple(sorted(side)) for _, nodes in inner for side in combinations(nodes, dimension))
    boundary = {tuple(sorted(nodes)) for _, nodes in outer}
    assert max(sides.values()) == 2
    assert {side for side, count in sides.items() if count == 1} == boundary


def test_sizes_and_groups(mesh):
    """The bodies shall have their area or volume, and every element a named group."""
    sizes, names, nodes, inner, outer, dimension = mesh
    found = dict.fromkeys(sizes, 0.0)
    for group, corners in inner:
        first, *others = (nodes[k][:dimension] for k in corners)
        size = np.linalg.det([other - first for other in others]) / (2 if dimension == 2 else 6)
        assert abs(size) > 0
        found[names[dimension, group]] += abs(size)
    for body, size in sizes.items():
        assert found[body] == pytest.approx(size, rel=1e-12 if body == "block" else 0.03)
    assert {(dimension - 1, group) for group, _ in outer} <= set(names)


# .geo file: its singular places
CORNERS = {
    "block": [(-0.5, 0), (0.5, 0)],
    "block-and-disc": [(-0.5, 0), (0.5, 0), (-0.25, 0.7625), (0.25, 0.7625)],
    "two-discs": [(-1, 0), (1, 0), (-1, 2.01), (1, 2.01)],
}


@pytest.mark.parametrize("name", CORNERS)
def test_elements_shrink_towards_singular_places(folder, name):
    """There edges shall be as small as by default, and grow with the distance; with 0 the mesh has none of it."""
    size = 1e-4
    for corner, least, most in ((size, 0.5 * size, 3 * size), (0, 20 * size, 1)):
        _, nodes, elements = made(folder, name, 2, *(() if corner else ("corners", 0)))
        edges = [(np.array(nodes[a]), np.array(nodes[b])) for _, (a, b) in elements[EDGE]]
        for place in CORNERS[name]:
            away = [np.linalg.norm(0.5 * (a + b)[:2] - place) for a, b in edges]
            near = edges[int(np.argmin(away))]
            assert least < np.linalg.norm(near[1] - near[0]) < most
            assert corner == 0 or all(
                np.linalg.norm(b - a) < 2 * size + 1.2 * r for (a, b), r in zip(edges, away, strict=True)
            )


def test_contact_line_with_sharp_ends(folder):
    """It shall be its own mirror image, a node in its middle, and shrink towards its ends (not on the axis)."""
    for axis in (0, 1):
        _, nodes, elements = made(folder, "block", 2, "sharp", 1, *(("axis", 1) if axis else ()))
        x = np.array(sorted({nodes[k][0] for group, pair in elements[EDGE] if group == 2 for k in pair}))
        steps = np.diff(x)
        assert steps[-1] < 3e-4
        if axis:
            assert steps[0] > 0.005
        else:
            np.testing.assert_allclose(x, -x[::-1], atol=1e-13)
            assert np.abs(x).min() < 1e-13


def test_singular_places_pay():
    """With P2 the force's error shall be a tenth of that without, for at most 15 % more unknowns."""
    flags = ["-order", 2, "-h", 0.25]
    graded, plain = run("disc-on-block", *flags), run("disc-on-block", *flags, "-corners", 0)
    assert abs(graded.force / 150.0294748 - 1) < 1.5e-5 < 1e-4 < abs(plain.force / 150.0294748 - 1)
    assert graded.ndof < 1.15 * plain.ndof
    # a punch's moment about its middle, and its corners' elements' few unknowns
    flags = ["-a", 1, "-force", 20, "-grading", 80, "-order", 2, "-law", "signorini", "-h", 0.1]
    graded, plain = run("flat-punch", *flags), run("flat-punch", *flags, "-corners", 0)
    assert abs(graded.halfWidthMoment - 1.41358) < 1e-3 < 1e-2 < abs(plain.halfWidthMoment - 1.41358)
    assert graded.backsolves <= 15
