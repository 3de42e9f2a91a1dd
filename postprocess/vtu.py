"""solution.vtu of a run in space, read and checked, and cut by a plane."""

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from postprocess.results import ResultsError, check_file

TYPES = {"Float64": "<f8", "Int64": "<i8"}
TRIANGLE, TETRAHEDRON = 5, 10  # VTK's numbers


@dataclass(frozen=True)
class Grid:
    """Bodies: points, move (n, 3) lengths; cells (m, 4) and their surface (k, 3) from 0; stress (n,) von Mises'."""

    points: np.ndarray
    move: np.ndarray
    cells: np.ndarray
    surface: np.ndarray
    stress: np.ndarray


def read_grid(path: Path) -> Grid:
    """The grid of a run in space; ResultsError for a file that is missing, truncated, or no grid of tetrahedra."""
    check_file(path, "; run the scene with -vtu 1")
    head, mark, numbers = path.read_bytes().partition(b'<AppendedData encoding="raw">')
    try:
        root = ElementTree.fromstring(head + b"</VTKFile>" if mark else head)
    except (ElementTree.ParseError, UnicodeDecodeError):
        raise ResultsError(path, "is not XML, or is truncated") from None
    numbers = numbers.lstrip()[1:]
    found = {}
    for part in ("Points", "Cells", "PointData"):
        for element in root.iterfind(f"UnstructuredGrid/Piece/{part}/DataArray"):
            found[part, element.get("Name") if part != "Points" else None] = array(path, element, numbers)
    names = {
        "points": ("Points", None),
        "move": ("PointData", "displacement[length]"),
        "corners": ("Cells", "connectivity"),
        "ends": ("Cells", "offsets"),
        "types": ("Cells", "types"),
        "stress": ("PointData", "vonMises[pressure]"),
    }
    missing = [name[1] or name[0] for name in names.values() if name not in found]
    if missing:
        raise ResultsError(path, f"is not a run's solution: no {', '.join(missing)}")
    points, move, corners, ends, types, stress = (found[name] for name in names.values())
    if not np.any(types == TETRAHEDRON) or not np.isin(types, (TRIANGLE, TETRAHEDRON)).all():
        raise ResultsError(path, "is not a grid of tetrahedra and their surface; the run is not one in space")
    wanted = np.cumsum(np.where(types == TETRAHEDRON, 4, 3))
    whole = len(points) == len(move) == 3 * len(stress)
    if not whole or not np.array_equal(ends, wanted) or len(corners) != wanted[-1]:
        raise ResultsError(path, "is truncated: its fields are not as long as its points and cells")
    if corners.min() < 0 or corners.max() >= len(points) // 3:
        raise ResultsError(path, "has a cell with a point that is not there")
    solid, shell = (wanted[types == kind] for kind in (TETRAHEDRON, TRIANGLE))
    cells = corners[solid[:, None] + np.arange(-4, 0)].astype(int)
    surface = corners[shell[:, None] + np.arange(-3, 0)].astype(int)
    return Grid(points.reshape(-1, 3), move.reshape(-1, 3), cells, surface, stress)


def array(path: Path, element: ElementTree.Element, numbers: bytes) -> np.ndarray:
    """The finite numbers of a DataArray, which stand among the appended ones behind their length in bytes."""
    kind, name = TYPES.get(element.get("type", "")), element.get("Name", "the points")
    if kind is None:
        raise ResultsError(path, f"has numbers of an unknown type {element.get('type')!r:.40}")
    begin = int(element.get("offset", "0")) + 8
    end = begin + int.from_bytes(numbers[begin - 8 : begin], "little")
    if end > len(numbers) or (end - begin) % 8:
        raise ResultsError(path, f"is truncated: {name} cannot be read")
    found = np.frombuffer(numbers[begin:end], kind)
    if not np.isfinite(found).all():
        raise ResultsError(path, f"has a number that is not finite in {name}")
    return found


def cut(grid: Grid, level: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The section by the plane y = level of the undeformed grid, in its deformed place, as corners in (x, z).

    Polygons (n, 4, 2), a triangle's last corner given twice; the stress (n, 4) there; the outline's lines (m, 2, 2).
    No point of the grid may lie on the plane.
    """
    one, two, three = (
        [(3, 0), (3, 1), (3, 2), (3, 2)],
        [(0, 2), (0, 3), (1, 3), (1, 2)],
        [(0, 1), (0, 2), (0, 3), (0, 3)],
    )
    polygons, stress = crossings(grid, grid.cells, level, {1: one, 2: two, 3: three})
    lines, _ = crossings(grid, grid.surface, level, {1: [(2, 0), (2, 1)], 2: [(0, 1), (0, 2)]})
    return polygons, stress, lines


def crossings(grid: Grid, cells: np.ndarray, level: float, edges: dict) -> tuple[np.ndarray, np.ndarray]:
    """Where the cells' edges cross the plane y = level: corners (n, c, 2) in (x, z), moved; the stress (n, c) there.

    `edges` names them by how many of a cell's corners are above; its corners are counted from the lowest.
    """
    above, place = grid.points[:, 1] - level, grid.points + grid.move
    cells = np.take_along_axis(cells, np.argsort(above[cells], axis=1), axis=1)
    upper = np.count_nonzero(above[cells] > 0, axis=1)
    found, stress = [], []
    for count, pairs in edges.items():
        first, second = (cells[upper == count][:, [pair[end] for pair in pairs]] for end in (0, 1))
        share = above[first] / (above[first] - above[second])
        found.append((place[first] + share[..., None] * (place[second] - place[first]))[..., [0, 2]])
        stress.append(grid.stress[first] + share * (grid.stress[second] - grid.stress[first]))
    return np.concatenate(found), np.concatenate(stress)
