"""print the pressure at which a fluid leaks through each contact, from the pressures of the contact

RUN is a run of own parts, or of a built-in problem. A fluid passes points that are pressed less than its own pressure.
In the plane and about an axis it has to pass the greatest pressure along the contact. In space it takes the way from
inside to outside whose greatest pressure is least. Inside and outside are the two rims of the slave's surface. Where
there are more or fewer, two points name them: the rim or the open part nearest to each. The fluid is no load here.
"""

import argparse
from pathlib import Path

import numpy as np

from postprocess.case_report import error_of, objects_of_list
from postprocess.formatting import Units, with_error
from postprocess.results import ResultsError, Run, is_number, read_run
from postprocess.vtu import bodies_file, read_grid, read_names, read_surface

Edges = np.ndarray  # (n, 2) vertices
SAME = 1e-5  # of the size of the surface: points of two files that are nearer are one


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RUN", help="a run's result folder")
    for side in ("inside", "outside"):
        parser.add_argument(f"--{side}", type=float, nargs=3, metavar=("X", "Y", "Z"), help=f"a point where {side} is")


def run(arguments: argparse.Namespace) -> None:
    """Reads the run and prints a line for each contact."""
    chosen = read_run(arguments.folder)
    if chosen.summary.get("converged") is False:
        raise ResultsError(chosen.path / "summary.json", "the run has not converged; allowed: a run that has")
    space = "z" in chosen.contact or (chosen.path / "contact.csv").read_text()[:5] == "x,y,z"
    for text in leaks_in_space(chosen, arguments) if space else leaks_in_plane(chosen):
        print(text)


def contacts_of(chosen: Run) -> list[tuple[str, object, object]]:
    """Of each contact its name, its greatest pressure, and the error of that."""
    estimates = chosen.summary.get("estimates")
    known = objects_of_list(estimates, "contacts")
    found = objects_of_list(chosen.summary, "contacts")
    if not found:
        one = estimates if isinstance(estimates, dict) else {}
        return [("contact", chosen.summary["pressureMax"], error_of(one, "pressureMax"))]
    errors = [error_of(known[k], "pressureMax") if k < len(known) else None for k in range(len(found))]
    return [(f"{each['name']}", each.get("pressureMax"), error) for each, error in zip(found, errors, strict=True)]


def said(name: str, pressure: float, error: object, unit: str, where: str = "") -> str:
    if pressure <= 0:
        return f"{name}: leaks without pressure: there is an open way"
    text = with_error(pressure, error, unit)
    return f"{name}: leaks at {text}{where}" + ("" if is_number(error) else ", error not known")


def leaks_in_plane(chosen: Run) -> list[str]:
    unit = Units(chosen.summary).stress
    return [said(name, float(p), error, unit) for name, p, error in contacts_of(chosen) if is_number(p)]


def leaks_in_space(chosen: Run, arguments: argparse.Namespace) -> list[str]:
    path = chosen.path / "contact.vtu"
    surface, unit, texts = read_surface(path), Units(chosen.summary).stress, []
    across = [each.get("across", []) for each in objects_of_list(chosen.summary, "contacts")] or [[]]
    for number, (name, _, error) in enumerate(contacts_of(chosen)):
        cells = surface.cells[surface.contact == number]
        if len(cells) == 0:
            continue
        used, cells = np.unique(cells, return_inverse=True)
        cells = cells.reshape(-1, 3)
        points, pressure = surface.points[used], np.maximum(surface.pressure[used], 0.0)
        edges, free = edges_of(cells)
        # an edge between two points of one symmetry is a cut by it, and no rim
        for symmetry in across[number]:
            on = on_symmetries(points, chosen.path, symmetry)
            free = free[~on[free].all(axis=1)]
        rims = [rim for rim in parts(len(points), free) if len(rim) > 1]
        ends = [end_at(points, pressure, rims, getattr(arguments, side), side) for side in ("inside", "outside")]
        inside, outside = ends
        if inside is None or outside is None:
            if len(rims) != 2:
                what = f"{name}: its surface has {len(rims)} rims; allowed: with --inside X Y Z --outside X Y Z"
                raise ResultsError(path, what)
            inside, outside = len(points), len(points) + 1
        # the fluid along a rim is a vertex of its own, beside all of the rim's
        at = last_passed(
            np.r_[pressure, np.zeros(len(rims))],
            np.array([*edges.tolist(), *([len(points) + k, v] for k, rim in enumerate(rims) for v in rim)]),
            inside,
            outside,
        )
        level, where = 0.0, ""
        if at < len(points) and pressure[at] > 0:
            level, where = float(pressure[at]), ", at ({:.4g}, {:.4g}, {:.4g})".format(*points[at])
            if is_number(error):
                error += 0.5 * float(np.abs(pressure[edges[(edges == at).any(axis=1)]] - level).max())
        texts.append(said(name, level, error, unit, where))
    return texts


def edges_of(cells: np.ndarray) -> tuple[Edges, Edges]:
    """All edges of triangles, and those of one triangle only."""
    every = np.sort(cells[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, count = np.unique(every, axis=0, return_counts=True)
    return edges, edges[count == 1]


def on_symmetries(points: np.ndarray, folder: Path, name: str) -> np.ndarray:
    """Which points are on the boundary of this name."""
    path = bodies_file(folder)
    grid = read_grid(path)
    labels = dict(text.split(" ", 1)[::-1] for text in read_names(path).get("groups", []))
    size = SAME * np.ptp(points, axis=0).max()
    corners = np.unique(grid.surface[grid.label == int(labels.get(name, -1))])
    known = {tuple(each) for each in np.round(grid.points[corners] / size).tolist()}
    return np.array([tuple(each) in known for each in np.round(points / size).tolist()])


class Union:
    """Sets of vertices that are joined."""

    def __init__(self, count: int):
        self.parent = list(range(count))

    def find(self, k: int) -> int:
        while self.parent[k] != k:
            self.parent[k] = self.parent[self.parent[k]]
            k = self.parent[k]
        return k

    def join(self, k: int, other: int) -> None:
        self.parent[self.find(k)] = self.find(other)


def parts(count: int, edges: Edges) -> list[list[int]]:
    """The vertices of each connected part of these edges."""
    union, found = Union(count), dict[int, list[int]]()
    for one, other in edges.tolist():
        union.join(one, other)
    for vertex in range(count):
        found.setdefault(union.find(vertex), []).append(vertex)
    return list(found.values())


def end_at(
    points: np.ndarray, pressure: np.ndarray, rims: list[list[int]], point: list[float] | None, side: str
) -> int | None:
    """The rim, behind all vertices, or the open vertex nearest to a point; nothing without one."""
    if point is None:
        return None
    on_rim = {vertex: len(points) + k for k, rim in enumerate(rims) for vertex in rim}
    reached = [k for k in range(len(points)) if k in on_rim or pressure[k] <= 0]
    if not reached:
        raise ResultsError(f"--{side}", "the contact has no rim and no open part: nothing that a fluid reaches")
    nearest = reached[int(np.argmin(np.linalg.norm(points[reached] - np.array(point), axis=1)))]
    return on_rim.get(nearest, nearest)


def last_passed(pressure: np.ndarray, edges: Edges, inside: int, outside: int) -> int:
    """The vertex with the greatest pressure on the way from inside to outside on which that is least.

    Vertices join those that are pressed less, from the least pressure on, until both ends are joined.
    """
    union = Union(len(pressure))
    both = np.r_[edges, edges[:, ::-1]]
    both = both[np.argsort(both[:, 0], kind="stable")]
    start = np.searchsorted(both[:, 0], np.arange(len(pressure) + 1))
    for vertex in np.argsort(pressure, kind="stable").tolist():
        for other in both[start[vertex] : start[vertex + 1], 1].tolist():
            if pressure[other] <= pressure[vertex]:
                union.join(vertex, other)
        if union.find(inside) == union.find(outside):
            return vertex
    raise ResultsError("contact.vtu", "inside and outside are on surfaces that do not meet")
