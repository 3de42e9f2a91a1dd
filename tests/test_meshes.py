"""meshes/*.geo: conforming, right in area or volume, grouped as the scripts expect."""

from collections import Counter
from itertools import combinations

import numpy as np
import pytest
from freefem import ROOT, execute

TETRAHEDRON, TRIANGLE, EDGE = 4, 2, 1
BLOCK = 0.5  # the default depth of a block of width 1
HALF_DISC = np.pi / 2
QUARTER = np.pi / 6  # of a half-ball

# .geo file: numbers of its own, {body: area or volume}
MESHES = {
    "block": ([], {"block": BLOCK}),
    "block-and-disc": ([], {"block": BLOCK, "disc": HALF_DISC / 16}),
    "two-discs": ([], {"lower": HALF_DISC, "upper": HALF_DISC}),
    "two-bodies": ([], {"lower": 111.5867, "upper": 44.4231}),
    "block-3d": (["h", 0.03, "patch", 0.09], {"block": BLOCK}),
    "block-far": (
        ["depth", 0.5, "h", 0.003, "left", 0.3, "right", 0.7, "fineLeft", 0.45, "fineRight", 0.55],
        {"block": BLOCK},
    ),
    "block-far-3d": (["h", 0.01, "fine", 0.03, "patch", 0.09], {"block": BLOCK}),
    "quarter-spheres": (["h", 0.05, "layers", 2], {"lower": QUARTER, "upper": QUARTER}),
}


def read(path):
    """({group number: name}, nodes, {element type: [(group, nodes)]}) of a version 2 file."""
    lines = iter(path.read_text().splitlines())
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


@pytest.fixture(scope="module", params=MESHES)
def mesh(request, tmp_path_factory):
    """(bodies' sizes, names, nodes, elements of the bodies, elements of their boundary, dimension)."""
    numbers, sizes = MESHES[request.param]
    path = tmp_path_factory.mktemp("mesh") / "a.msh"
    dimension = 3 if request.param in ("block-3d", "block-far-3d", "quarter-spheres") else 2
    flags = [
        word for name, value in zip(numbers[::2], numbers[1::2], strict=True) for word in ("-setnumber", name, value)
    ]
    source = ROOT / "meshes" / f"{request.param}.geo"
    code, stdout = execute(["gmsh", f"-{dimension}", "-v", 0, "-format", "msh22", *flags, source, "-o", path])
    assert code == 0, stdout
    names, nodes, elements = read(path)
    inner, outer = (TETRAHEDRON, TRIANGLE) if dimension == 3 else (TRIANGLE, EDGE)
    return sizes, names, nodes, elements[inner], elements[outer], dimension


def test_all_sources_are_here():
    """Every .geo file shall be among those tested."""
    assert {path.stem for path in (ROOT / "meshes").glob("*.geo")} == set(MESHES)


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
