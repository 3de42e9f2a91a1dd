"""The .vtu files of a run, read and checked: the bodies, the contact surface, and a section by a plane."""

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from postprocess.results import ResultsError, check_file

TYPES = {"Float64": "<f8", "Int64": "<i8"}
CORNERS = {3: 2, 5: 3, 10: 4}  # of VTK's lines, triangles and tetrahedra
MOVE, PRESSURE, STRESS = "displacement[length]", "contactPressure[pressure]", "vonMises[pressure]"
NODE = "node"  # of a piece: the number of a point among those of all pieces
NONE = np.empty(0, int)


@dataclass(frozen=True)
class Grid:
    """Bodies: points, move (n, 3) lengths; cells (m, c) and their surface (k, c - 1) from 0; stress (n,) von Mises'.

    pressure (n,): the contacts', on their slaves.
    c = 4 in space, 3 in the plane. body (m,) and label (k,): numbers of the region and of the group on the boundary.
    """

    points: np.ndarray
    move: np.ndarray
    cells: np.ndarray
    surface: np.ndarray
    stress: np.ndarray
    body: np.ndarray = field(default_factory=lambda: NONE)
    label: np.ndarray = field(default_factory=lambda: NONE)
    pressure: np.ndarray = field(default_factory=lambda: NONE)

    @cached_property
    def skin(self) -> np.ndarray:
        """The sides (s, c - 1) that belong to one cell alone: the bodies' whole boundary, named or not."""
        count = self.cells.shape[1]
        sides = np.concatenate([np.delete(self.cells, corner, axis=1) for corner in range(count)])
        _, first, times = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
        return sides[first[times == 1]]

    @property
    def space(self) -> bool:
        return self.cells.shape[1] == 4


@dataclass(frozen=True)
class Surface:
    """Where contact is possible: points, move (n, 3) lengths; cells (k, 2 or 3) from 0; pressure and overlap (n,).

    contact (k,): the number of the contact that a cell belongs to.
    """

    points: np.ndarray
    move: np.ndarray
    cells: np.ndarray
    contact: np.ndarray
    pressure: np.ndarray
    overlap: np.ndarray


def bodies_file(folder: Path) -> Path:
    """solution.vtu of a run, or the index solution.pvtu of a run whose processes wrote a piece each."""
    index = folder / "solution.pvtu"
    return index if index.exists() else folder / "solution.vtu"


def read_grid(path: Path) -> Grid:
    """solution.vtu or solution.pvtu; ResultsError for a file that is missing, truncated, or no grid of bodies."""
    found = read_arrays(path)
    points, move, stress, types = check_fields(path, found, "a run's solution", MOVE, STRESS)
    pressure = found.get(("PointData", PRESSURE), np.zeros(len(points)))
    solid = 10 if np.any(types == 10) else 5
    shell = 5 if solid == 10 else 3
    if not np.isin(types, (solid, shell)).all() or not np.any(types == solid):
        raise ResultsError(path, "is not a grid of bodies and their surface")
    cells, surface = (cells_of_type(path, found, kind) for kind in (solid, shell))
    label = found.get(("CellData", "Label"), np.zeros(len(types), int))
    if len(label) != len(types):
        raise ResultsError(path, "is truncated: its labels are not as many as its cells")
    return Grid(points, move, cells, surface, stress, label[types == solid], label[types == shell], pressure)


def read_surface(path: Path) -> Surface:
    """contact.vtu; ResultsError for a file that is missing, truncated, or no contact surface."""
    found = read_arrays(path)
    points, move, pressure, overlap, types = check_fields(
        path, found, "a contact surface", MOVE, PRESSURE, "overlap[length]"
    )
    if len(types) == 0 or len(set(types)) > 1:
        raise ResultsError(path, "is not one surface")
    contact = found.get(("CellData", "Label"), np.zeros(len(types), int))
    if len(contact) != len(types):
        raise ResultsError(path, "is truncated: its labels are not as many as its cells")
    return Surface(points, move, cells_of_type(path, found, types[0]), contact, pressure, overlap)


def read_names(path: Path) -> dict[str, list[str]]:
    """The texts of a file's FieldData by their arrays' names: units; bodies and groups behind their labels."""
    root, _ = read_xml(pieces(path)[0])
    found = {}
    for element in root.iterfind("UnstructuredGrid/FieldData/Array"):
        letters = bytes(int(letter) for letter in (element.text or "").split())
        found[element.get("Name", "")] = [text.decode("utf-8", "replace") for text in letters.split(b"\0")[:-1]]
    return found


def read_arrays(path: Path) -> dict:
    """All arrays of a file, or of the pieces of an index, by part and name; the points by their part alone."""
    if path.suffix == ".pvtu":
        return join_pieces(path, [read_arrays(piece) for piece in pieces(path)])
    root, numbers = read_xml(path)
    found = {}
    for part in ("Points", "Cells", "PointData", "CellData"):
        for element in root.iterfind(f"UnstructuredGrid/Piece/{part}/DataArray"):
            found[part, element.get("Name") if part != "Points" else None] = array(path, element, numbers)
    return found


def pieces(path: Path) -> list[Path]:
    """The files of an index; a file that is no index itself."""
    if path.suffix != ".pvtu":
        return [path]
    names = [element.get("Source", "") for element in read_xml(path)[0].iterfind("PUnstructuredGrid/Piece")]
    if not names or any(not name or Path(name).name != name for name in names):
        raise ResultsError(path, "names no pieces, or pieces in another folder")
    return [path.parent / name for name in names]


def join_pieces(path: Path, parts: list[dict]) -> dict:
    """The arrays of all pieces as those of one file: points with the same number are one point."""
    names = set(parts[0])
    needed = {
        ("Points", None),
        ("PointData", NODE),
        *(("Cells", name) for name in ("connectivity", "offsets", "types")),
    }
    if any(set(part) != names for part in parts) or needed - names:
        raise ResultsError(path, "has pieces whose fields differ, or points without numbers")
    numbers = [part["PointData", NODE] for part in parts]
    if any(3 * len(number) != len(part["Points", None]) for number, part in zip(numbers, parts, strict=True)):
        raise ResultsError(path, "has a piece that is truncated")
    _, first, place = np.unique(np.concatenate(numbers), return_index=True, return_inverse=True)
    starts = np.cumsum([0, *map(len, numbers)])
    ends = np.cumsum([0, *(len(part["Cells", "connectivity"]) for part in parts)])
    found = {}
    for name in names:
        shift = {("Cells", "connectivity"): starts, ("Cells", "offsets"): ends}.get(name, np.zeros(len(parts) + 1, int))
        values = [part[name] + shift[k] if shift[k] else part[name] for k, part in enumerate(parts)]
        if name[0] in ("Points", "PointData"):
            wide = 3 if name[1] in (None, MOVE) else 1
            if any(len(value) != wide * len(number) for value, number in zip(values, numbers, strict=True)):
                raise ResultsError(path, "has a piece that is truncated")
            found[name] = np.concatenate(values).reshape(-1, wide)[first].reshape(-1)
        else:
            found[name] = np.concatenate(values)
    corner = found["Cells", "connectivity"]
    if len(corner) and (corner.min() < 0 or corner.max() >= len(place)):
        raise ResultsError(path, "has a cell with a point that is not there")
    found["Cells", "connectivity"] = place[corner]
    return found


def read_xml(path: Path) -> tuple[ElementTree.Element, bytes]:
    """The file's XML, and the numbers behind it."""
    check_file(path, "; run the scene with -vtu 1")
    head, mark, numbers = path.read_bytes().partition(b'<AppendedData encoding="raw">')
    try:
        root = ElementTree.fromstring(head + b"</VTKFile>" if mark else head)
    except (ElementTree.ParseError, UnicodeDecodeError):
        raise ResultsError(path, "is not XML, or is truncated") from None
    return root, numbers.lstrip()[1:]


def check_fields(path: Path, found: dict, what: str, *fields: str) -> list[np.ndarray]:
    """The points, the fields at them, the displacement (n, 3), and the cells' types; all of the right length."""
    names = [("Points", None), *(("PointData", name) for name in fields)]
    cells = [("Cells", name) for name in ("connectivity", "offsets", "types")]
    missing = [name[1] or name[0] for name in (*names, *cells) if name not in found]
    if missing:
        raise ResultsError(path, f"is not {what}: no {', '.join(missing)}")
    points = len(found["Points", None]) // 3
    values = [found[name].reshape(-1, 3) if name[1] in (None, MOVE) else found[name] for name in names]
    corner, ends, types = (found[name] for name in cells)
    if not np.isin(types, list(CORNERS)).all():
        raise ResultsError(path, "is not a grid of lines, triangles and tetrahedra")
    whole = np.array_equal(ends, np.cumsum([CORNERS[kind] for kind in types.tolist()]))
    if any(len(value) != points for value in values) or not whole or len(corner) != (ends[-1] if len(ends) else 0):
        raise ResultsError(path, "is truncated: its fields are not as long as its points and cells")
    if len(corner) and (corner.min() < 0 or corner.max() >= points):
        raise ResultsError(path, "has a cell with a point that is not there")
    return [*values, types]


def cells_of_type(path: Path, found: dict, kind: int) -> np.ndarray:
    """The cells of one kind (n, corners)."""
    ends = found["Cells", "offsets"][found["Cells", "types"] == kind]
    return found["Cells", "connectivity"][ends[:, None] + np.arange(-CORNERS[kind], 0)].astype(int)


def array(path: Path, element: ElementTree.Element, numbers: bytes) -> np.ndarray:
    """The finite numbers of a DataArray, which stand among the appended ones behind their length in bytes.

    An overlap is NaN where nothing lies opposite.
    """
    kind, name = TYPES.get(element.get("type", "")), element.get("Name", "the points")
    if kind is None:
        raise ResultsError(path, f"has numbers of an unknown type {element.get('type')!r:.40}")
    begin = int(element.get("offset", "0")) + 8
    end = begin + int.from_bytes(numbers[begin - 8 : begin], "little")
    if end > len(numbers) or (end - begin) % 8:
        raise ResultsError(path, f"is truncated: {name} cannot be read")
    found = np.frombuffer(numbers[begin:end], kind)
    if not np.isfinite(found).all() and not (name.startswith("overlap") and not np.isinf(found).any()):
        raise ResultsError(path, f"has a number that is not finite in {name}")
    return found


def cut_grid(grid: Grid, level: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
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
