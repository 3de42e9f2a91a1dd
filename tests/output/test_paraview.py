"""The files for ParaView, read back with an XML parser: fields, points, the series of states, nothing left over."""

import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from freefem import ROOT, run_in, script

DTYPES = {"Float64": "<f8", "Int64": "<i8"}
DISPLACEMENT, PRESSURE, STRESS = "displacement[length]", "contactPressure[pressure]", "vonMises[pressure]"
CORNERS = {3: 2, 5: 3, 10: 4}  # of VTK's lines, triangles and tetrahedra
RUNS = {
    "plane": ("disc-on-block", "-method", "paper", "-h", 2, "-order", 1, "-estimate", 0),
    "P4": ("disc-on-block", "-h", 2, "-order", 4),
    "axis": ("disc-on-block", "-geometry", "axisymmetric", "-h", 1, "-order", 2, "-estimate", 0),
    "bodies": ("meshed-disc", "-method", "newton", "-h", 2, "-order", 1, "-estimate", 0),
    "space": ("sphere-on-block", "-h", 2, "-layers", 2, "-order", 1, "-symmetry", "whole", "-estimate", 0),
    "space P2": ("sphere-on-block", "-h", 3, "-layers", 1, "-order", 2, "-symmetry", "whole"),
}


SHARE = "errorShare[force]"


class Grid:
    """A .vtu file: points (n, 3), cells (list of index arrays), kinds, point and cell fields by name."""

    def __init__(self, path):
        head, mark, numbers = path.read_bytes().partition(b'<AppendedData encoding="raw">')
        numbers, _, tail = numbers.rpartition(b"</AppendedData>")
        root = ElementTree.fromstring(head + mark + b"</AppendedData>" + tail)
        self.numbers = numbers.lstrip()
        assert self.numbers[:1] == b"_"
        assert root.tag == "VTKFile" and root.get("type") == "UnstructuredGrid"
        (piece,) = root.iter("Piece")
        (points,) = piece.find("Points")
        self.points = self.values(points)
        assert self.points.shape == (int(piece.get("NumberOfPoints")), 3)
        cells = {array.get("Name"): self.values(array) for array in piece.find("Cells")}
        self.cells, self.kinds = np.split(cells["connectivity"], cells["offsets"][:-1]), cells["types"]
        assert len(self.cells) == len(self.kinds) == int(piece.get("NumberOfCells"))
        assert [len(cell) for cell in self.cells] == [CORNERS[kind] for kind in self.kinds]
        assert cells["connectivity"].min() >= 0 and cells["connectivity"].max() < len(self.points)
        self.at_points, self.in_cells = (
            {array.get("Name"): self.values(array) for array in piece.find(f"{kind}Data")} for kind in ("Point", "Cell")
        )
        assert all(len(field) == len(self.points) for field in self.at_points.values())
        assert all(len(field) == len(self.cells) for field in self.in_cells.values())

    def values(self, array):
        """The numbers of a DataArray, one row a point or cell when there are components."""
        assert array.get("format") == "appended"
        begin = 1 + int(array.get("offset"))
        size = int.from_bytes(self.numbers[begin : begin + 8], "little")
        found = np.frombuffer(self.numbers[begin + 8 : begin + 8 + size], DTYPES[array.get("type")])
        assert np.isfinite(found).all() or array.get("Name").startswith("overlap")  # NaN: nothing lies opposite
        components = int(array.get("NumberOfComponents"))
        return found.reshape(-1, components) if components > 1 else found

    def vertex(self, points):
        """The vertex at each of the points, the first if several are there."""
        away = np.abs(self.points[None, :, :] - points[:, None, :]).max(axis=2)
        assert away.min(axis=1).max() < 1e-5
        return away.argmin(axis=1)


@pytest.fixture(
    scope="module",
    params=[
        "P4",
        "axis",
        "bodies",
        "space P2",
        *(name for name in ("plane", "space")),
    ],
)
def made(request, tmp_path_factory):
    """A run with its states: (name, run)."""
    scene, *flags = RUNS[request.param]
    out = tmp_path_factory.mktemp("paraview") / "out"
    return request.param, run_in(ROOT, script(scene), *flags, "-states", 1, out=out)


def coordinates(table):
    """(points, 3) of a table with x, y and perhaps z."""
    last = table["z"] if "z" in table.dtype.names else np.zeros(len(table))
    return np.column_stack([table["x"], table["y"], last])


def test_solution(made):
    """solution.vtu: every node with its displacement and stress, the pressure at the slave's and 0 elsewhere."""
    name, run = made
    grid = Grid(run.folder / "solution.vtu")
    assert grid.at_points.keys() == {DISPLACEMENT, PRESSURE, STRESS}
    assert grid.in_cells.keys() == {"Label"} | ({SHARE} if run.estimates else set())
    if run.estimates:
        parts = run.estimates["parts"]
        cells = run.order ** (3 if "space" in name else 2)  # an element's share stands in each of its cells
        shares = grid.in_cells[SHARE]
        assert shares.min() >= 0
        assert shares.sum() / cells == pytest.approx(parts["inside"] + parts["geometry"], rel=1e-9)
    assert grid.at_points[DISPLACEMENT].shape == grid.points.shape
    dimension = 3 if "space" in name else 2
    assert len(np.unique(np.round(grid.points, 9), axis=0)) * dimension <= run.ndof <= len(grid.points) * dimension
    assert (grid.at_points[DISPLACEMENT][grid.points[:, dimension - 1] == 0] == 0).all()
    contact, pressure = run.contact, grid.at_points[PRESSURE]
    np.testing.assert_allclose(pressure[np.abs(grid.points[:, dimension - 1] - 20) > 1e-6], 0, atol=0)
    places, expected = coordinates(contact), contact["pressure"]
    if name == "P4":  # points that are no nodes: a polynomial on each edge
        edges = [slice(first, first + 5) for first in range(0, len(places) - 1, 4)]
        nodes = [np.linspace(places[edge][0], places[edge][-1], 5) for edge in edges]
        fits = [np.polyfit(places[edge][:, 0], expected[edge], 4) for edge in edges]
        expected = np.concatenate([np.polyval(fit, at[:, 0]) for fit, at in zip(fits, nodes, strict=True)])
        places = np.concatenate(nodes)
    for point, value in zip(places, expected, strict=True):
        here = np.abs(grid.points - point).max(axis=1) < 1e-9  # two where the bodies touch
        assert pressure[here].max() == pytest.approx(value, rel=1e-9 if name == "P4" else 1e-12, abs=1e-9)


def test_measure(made):
    """The linear cells shall fill the bodies, the boundary's shall close them: no part is there twice."""
    name, run = made
    grid = Grid(run.folder / "solution.vtu")
    space = "space" in name
    corners = np.array(
        [grid.points[cell] for cell, kind in zip(grid.cells, grid.kinds, strict=True) if kind == (10 if space else 5)]
    )
    edges = corners[:, 1:] - corners[:, :1]
    volume = np.abs(np.linalg.det(edges)) / 6 if space else np.abs(np.cross(edges[:, 0], edges[:, 1])[:, 2]) / 2
    assert volume.min() > 0
    block = {"axis": 40 * 20, "bodies": 40 * 20 + 50 * np.pi}.get(name, 40 * 40 * 20 if space else 40 * 20)
    assert volume.sum() == pytest.approx(block, rel=2e-2 if name == "bodies" else 1e-9)
    labels = grid.in_cells["Label"]
    sides = [
        tuple(sorted(cell)) for cell, kind in zip(grid.cells, grid.kinds, strict=True) if kind == (5 if space else 3)
    ]
    assert len(set(sides)) == len(sides) > 0 and labels.min() >= 1


def test_contact(made):
    """contact.vtu: the points of contact.csv in one surface, with their fields, moved as in solution.vtu."""
    name, run = made
    grid, contact = Grid(run.folder / "contact.vtu"), run.contact
    points = len(contact)
    np.testing.assert_allclose(grid.points[:points], coordinates(contact), rtol=1e-8, atol=1e-12)
    columns = {"overlap[length]": "overlap", PRESSURE: "pressure", "lambda[pressure]": "lambda", "status": "status"}
    assert grid.at_points.keys() == {DISPLACEMENT, *columns}
    for field, column in columns.items():
        np.testing.assert_allclose(grid.at_points[field][:points], contact[column], rtol=1e-8, atol=1e-290)
    corners = grid.points[np.array(grid.cells)]
    if "space" in name:
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        measure = 0.5 * np.linalg.norm(across, axis=1)
        assert measure.sum() == pytest.approx(contact["weight"].sum(), rel=1e-8)
    else:
        length = np.ptp(grid.points[:, 0])
        assert np.abs(corners[:, 1, 0] - corners[:, 0, 0]).sum() == pytest.approx(length, rel=1e-12)
        assert len(grid.cells) == len(grid.points) - 1
    # what is no point, P2's node on the axis and its corners in space, is extrapolated
    extra = len(grid.points) - points
    assert extra == {"axis": 1, "space P2": len(grid.points) - points}.get(name, 0)
    if name == "axis":
        assert grid.points[-1, 0] == 0 and grid.at_points[PRESSURE][-1] > contact["pressure"].max()
    if name == "space P2":
        assert extra > 20 and grid.at_points[PRESSURE][points:].max() == pytest.approx(
            contact["pressure"].max(), rel=0.1
        )
        assert grid.at_points[PRESSURE].min() >= 0
    solution = Grid(run.folder / "solution.vtu")
    if name == "P4":  # points that are no nodes move between their edge's
        at, moved = (values[grid.points[:, 0].argsort()] for values in (grid.points, grid.at_points[DISPLACEMENT]))
        surface = solution.points[np.abs(solution.points[:, 1] - 20) < 1e-9]
        there = solution.at_points[DISPLACEMENT][solution.vertex(surface)]
        along = surface[:, 0].argsort()
        joined = np.interp(at[:, 0], surface[along, 0], there[along, 1])
        np.testing.assert_allclose(moved[::4, 1], joined[::4], rtol=1e-12)
        assert 0 < np.abs(moved[:, 1] - joined).max() < 0.02 * np.abs(joined).max()
    elif name != "bodies":  # there are two nodes at a place where bodies touch
        there = solution.at_points[DISPLACEMENT][solution.vertex(grid.points)]
        np.testing.assert_allclose(grid.at_points[DISPLACEMENT], there, rtol=1e-12, atol=1e-14)


def test_cubic_cells_in_space(tmp_path):
    """P3's cells cut up shall fill the block once, none inside out; both files cover the slave and move alike there."""
    flags = "-order", 3, "-h", 3, "-layers", 1, "-grading", 80, "-estimate", 0
    run = run_in(ROOT, script("sphere-on-block"), *flags, out=tmp_path / "cubic")
    solution, contact = Grid(run.folder / "solution.vtu"), Grid(run.folder / "contact.vtu")
    corners = solution.points[[cell for cell, kind in zip(solution.cells, solution.kinds, strict=True) if kind == 10]]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    assert volume.min() > 0 and len(volume) % 27 == 0 and volume.sum() == pytest.approx(40 * 40 * 20 / 4, rel=1e-9)
    corners = contact.points[np.array(contact.cells)]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert 0.5 * np.linalg.norm(across, axis=1).sum() == pytest.approx(run.contact["weight"].sum() / 4, rel=1e-9)
    np.testing.assert_allclose(contact.at_points[PRESSURE], run.contact["pressure"], rtol=1e-12)
    meets = [np.abs(solution.points - point).max(axis=1).argmin() for point in contact.points]
    same = np.abs(solution.points[meets] - contact.points).max(axis=1) < 1e-9
    moved = [grid.at_points[DISPLACEMENT] for grid in (solution, contact)]
    assert 10 < same.sum() < len(same)
    np.testing.assert_allclose(moved[0][meets][same], moved[1][same], atol=1e-12)
    pressures = solution.at_points[PRESSURE][meets][same], contact.at_points[PRESSURE][same]
    np.testing.assert_allclose(*pressures, atol=1e-9)


def test_states(made):
    """states.pvd: a time for each state of states.csv, each file there, deformed; the last is the solution."""
    name, run = made
    sets = list(ElementTree.parse(run.folder / "states.pvd").getroot().iter("DataSet"))
    files = [each.get("file") for each in sets]
    assert [float(each.get("timestep")) for each in sets] == list(range(run.newton + 2))
    assert sorted(files) == sorted(path.name for path in run.folder.glob("state-*"))
    grids = [Grid(run.folder / file) for file in files]
    solution = Grid(run.folder / "solution.vtu")
    inside = solution.kinds == (10 if "space" in name else 5)
    for grid in grids:
        assert grid.at_points.keys() == {DISPLACEMENT, PRESSURE, STRESS}
        rest = grid.points - grid.at_points[DISPLACEMENT]
        np.testing.assert_allclose(rest, solution.points, rtol=1e-12, atol=1e-12)
        assert (np.array(grid.cells) == np.array([c for c, i in zip(solution.cells, inside, strict=True) if i])).all()
    first, moved, *_, last = grids
    assert not first.at_points[DISPLACEMENT].any() and not first.at_points[PRESSURE].any()
    lowest = moved.at_points[DISPLACEMENT].min()
    assert lowest == (-2.5 if name == "bodies" else 0)
    assert not moved.at_points[STRESS].max() > 1e-9
    for field in (DISPLACEMENT, PRESSURE, STRESS):
        np.testing.assert_allclose(last.at_points[field], solution.at_points[field], rtol=1e-9, atol=1e-9)


def test_states_tables(made):
    """states.csv and triangles.csv of the same run: the same nodes; in space the triangles close the surface."""
    name, run = made
    rows = np.genfromtxt(run.folder / "states.csv", delimiter=",", names=True)
    grid = Grid(run.folder / f"state-{run.newton + 1}.vtu")
    last = rows[rows["state"] == run.newton + 1]
    axes = "xyz" if "space" in name else "xy"
    for k, axis in enumerate(axes):
        np.testing.assert_allclose(grid.points[:, k], last[axis] + last[f"u{axis}"], rtol=1e-7, atol=1e-7)
    triangles = np.loadtxt(run.folder / "triangles.csv", delimiter=",", skiprows=1, dtype=int)
    if "space" in name:
        sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
        assert (np.unique(sides, axis=0, return_counts=True)[1] == 2).all()
    else:
        assert (triangles[:, :3] == np.array(grid.cells)).all()
