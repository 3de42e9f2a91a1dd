"""A run's bodies for other programs: VTU with tensors for ParaView, FRD for CalculiX's viewers.

Fields at the nodes of solution.vtu, whose elements are divided into linear cells. Components are along the axes of the
case; with `state axisymmetric` these are radius, axis and circumference. FRD is the result format of the manual of
CalculiX GraphiX.
"""

from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from postprocess.vtu import Grid, bodies_file, read_arrays, read_grid, read_names

COMPONENTS = ("XX", "YY", "ZZ", "XY", "YZ", "XZ")  # of a symmetric tensor, as VTK orders them
PRINCIPAL = ("first", "second", "third")
FRD_STRESS = (("SXX", 1, 1), ("SYY", 2, 2), ("SZZ", 3, 3), ("SXY", 1, 2), ("SYZ", 2, 3), ("SZX", 3, 1))


@dataclass(frozen=True)
class Exported:
    """A grid; stress (n, 6) in the order of COMPONENTS, or None; names: bodies and groups behind their labels."""

    grid: Grid
    stress: np.ndarray | None
    names: dict[str, list[str]]

    def principal(self) -> tuple[np.ndarray, np.ndarray]:
        """Principal stresses (n, 3), the greatest first, and their unit directions (n, 3, 3), a row each.

        A direction has its greatest component above 0.
        """
        assert self.stress is not None
        xx, yy, zz, xy, yz, xz = self.stress.T
        tensors = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=1).reshape(-1, 3, 3)
        values, vectors = np.linalg.eigh(tensors)
        rows = vectors.transpose(0, 2, 1)[:, ::-1]
        most = np.take_along_axis(rows, np.abs(rows).argmax(axis=2)[..., None], axis=2)
        return values[:, ::-1], rows * np.sign(most)


def read_exported(folder: Path) -> Exported:
    """The bodies of a run; ResultsError for files that are missing or wrong."""
    path = bodies_file(folder)
    grid, found, names = read_grid(path), read_arrays(path), read_names(path)
    parts = [found.get(("PointData", f"stress{component}[pressure]")) for component in COMPONENTS]
    known = [part for part in parts if part is not None and len(part) == len(grid.points)]
    stress = np.stack(known, axis=1) if len(known) == len(parts) else None
    return Exported(grid, stress, names)


# ---------------------------------------------------------------- VTU


def vtu(of: Exported) -> bytes:
    """A grid of the bodies for ParaView, with `stress` as a symmetric tensor, principal stresses and directions."""
    grid = of.grid
    fields: list[tuple[str, np.ndarray, tuple[str, ...]]] = [
        ("displacement", grid.move, ("X", "Y", "Z")),
        ("von Mises stress", grid.stress, ()),
        ("contact pressure", grid.pressure, ()),
    ]
    if of.stress is not None:
        values, directions = of.principal()
        fields += [("stress", of.stress, COMPONENTS), ("principal stresses", values, PRINCIPAL)]
        fields += [(f"{PRINCIPAL[k]} principal direction", directions[:, k], ("X", "Y", "Z")) for k in range(3)]
    arrays: list[bytes] = []

    def declared(name: str, values: np.ndarray, components: tuple[str, ...] = ()) -> str:
        values = np.ascontiguousarray(values, "<i8" if values.dtype.kind == "i" else "<f8")
        kind = "Int64" if values.dtype.kind == "i" else "Float64"
        offset = sum(map(len, arrays))
        arrays.append(values.nbytes.to_bytes(8, "little") + values.tobytes())
        wide = values.shape[1] if values.ndim > 1 else 1
        words = "".join(f" ComponentName{k}={quoteattr(text)}" for k, text in enumerate(components))
        return (
            f'<DataArray type="{kind}" Name={quoteattr(name)} NumberOfComponents="{wide}"{words} '
            f'format="appended" offset="{offset}"/>\n'
        )

    count, corners = grid.cells.shape
    places = "<Points>\n" + declared("points", grid.points) + "</Points>\n"
    cells = "<Cells>\n" + declared("connectivity", grid.cells.astype(int))
    cells += declared("offsets", corners * np.arange(1, count + 1))
    cells += declared("types", np.full(count, 10 if grid.space else 5)) + "</Cells>\n"
    tensor = ' Tensors="stress"' if of.stress is not None else ""
    points = f'<PointData Vectors="displacement" Scalars="von Mises stress"{tensor}>\n'
    points += "".join(declared(*field) for field in fields) + "</PointData>\n"
    bodies = "<CellData>\n" + declared("body", grid.body.astype(int)) + "</CellData>\n"
    head = (
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
        f'header_type="UInt64">\n<UnstructuredGrid>\n{texts(of.names)}'
        f'<Piece NumberOfPoints="{len(grid.points)}" NumberOfCells="{count}">\n'
    )
    end = '</Piece>\n</UnstructuredGrid>\n<AppendedData encoding="raw">\n_'
    return (
        (head + places + cells + points + bodies + end).encode() + b"".join(arrays) + b"\n</AppendedData>\n</VTKFile>\n"
    )


def texts(names: dict[str, list[str]]) -> str:
    """Names of units, bodies and groups, as solution.vtu has them."""
    rows = []
    for name, values in names.items():
        letters = " ".join(str(letter) for value in values for letter in [*value.encode(), 0])
        head = f'<Array type="String" Name={quoteattr(name)} NumberOfTuples="{len(values)}" format="ascii">'
        rows.append(f"{head}{letters} </Array>")
    return f"<FieldData>{''.join(rows)}</FieldData>\n" if rows else ""


# ---------------------------------------------------------------- FRD


def frd(of: Exported, name: str) -> bytes:
    """The file of CalculiX's viewers: nodes, linear triangles or tetrahedra, displacements, stresses, pressures."""
    grid, count = of.grid, len(of.grid.points)
    number = range(1, count + 1)
    lines = [f"    1C{name[:60]}", "    1UPGM               contact cases"]
    for key, values in of.names.items():
        lines += [f"    1U{key[:18]:18}{value}" for value in values]
    lines.append(f"    2C{'':18}{count:12d}{'':37}1")
    lines += [f" -1{k:10d}{numbers(place)}" for k, place in zip(number, grid.points, strict=True)]
    lines += [" -3", f"    3C{'':18}{len(grid.cells):12d}{'':37}1"]
    kind = 3 if grid.space else 7  # a tetrahedron, a triangle
    bodies = grid.body if len(grid.body) == len(grid.cells) else np.ones(len(grid.cells), int)
    for k, (cell, body) in enumerate(zip(grid.cells + 1, bodies.tolist(), strict=True), 1):
        lines += [f" -1{k:10d}{kind:5d}{0:5d}{body:5d}", " -2" + "".join(f"{node:10d}" for node in cell.tolist())]
    lines.append(" -3")
    lines += block("DISP", [(f"D{k}", 2, k, 0) for k in (1, 2, 3)], grid.move, whole=True)
    if of.stress is not None:
        lines += block("STRESS", [(text, 4, a, b) for text, a, b in FRD_STRESS], of.stress)
    lines += block("MISES", [("MISES", 1, 0, 0)], grid.stress[:, None])
    if len(grid.pressure):
        lines += block("CPRESS", [("CPRESS", 1, 0, 0)], grid.pressure[:, None])
    return ("\n".join([*lines, " 9999"]) + "\n").encode("ascii", "replace")


def numbers(row: np.ndarray) -> str:
    return "".join(f"{value:12.5E}" for value in row.tolist())


def block(name: str, components: list[tuple[str, int, int, int]], values: np.ndarray, whole: bool = False) -> list[str]:
    """The lines of a field at the nodes. Components: name, kind (1 scalar, 2 vector, 4 tensor), two indices."""
    lines = [f"  100CL{101:5d}{1.0:12.5E}{len(values):12d}{'':20}{0:2d}{1:5d}{'':10}{1:2d}"]
    lines.append(f" -4  {name:8}{len(components) + whole:5d}{1:5d}")
    lines += [f" -5  {text:8}{1:5d}{kind:5d}{a:5d}{b:5d}" for text, kind, a, b in components]
    if whole:
        lines.append(f" -5  {'ALL':8}{1:5d}{2:5d}{0:5d}{0:5d}{1:5d}ALL")
    lines += [f" -1{k:10d}{numbers(row)}" for k, row in enumerate(values, 1)]
    return [*lines, " -3"]
