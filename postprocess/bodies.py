"""Bodies under their loads, for the commands `state` and `stress`: what the files hold, and how a part of it is drawn.

In the plane bodies are filled triangles, and the pressure stands on the contact's surface as a curve; in space the
bodies' surface is seen from outside, and the pressure is a map of the contact's surface, seen along its normal.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.patches import Rectangle
from matplotlib.tri import Triangulation

from postprocess import style
from postprocess.output import enter, write_figure
from postprocess.results import ResultsError, Run, brief, read_run, read_table
from postprocess.vtu import Grid, Surface, read_grid, read_surface

FILLS = ("#DCE9F3", "#E9E6E1", "#DFF0E4", "#F7E9D7", "#F0E3EE", "#E0E0F0")
ZONES = {1: "#CFE8DC", 2: "#FBE3C4"}  # behind curves: sticks, slips
LIGHT = np.array([-0.35, -0.5, 0.79])
FARTHEST = 1.5  # an obstacle is drawn as far from the surface as that times the contact's size
TOUCHING = 1e-3  # of the greatest pressure: what is shown of a contact


@dataclass(frozen=True)
class Chain:
    """A connected piece of a contact's surface in the plane: deformed places and normals (n, 2), and fields (n,)."""

    contact: int
    name: str
    place: np.ndarray
    normal: np.ndarray
    pressure: np.ndarray
    overlap: np.ndarray
    along: np.ndarray  # from the pressure's middle on, or x
    rigid: bool
    shear: np.ndarray | None = None  # with friction: traction on the slave, and 0 open, 1 sticks, 2 slips
    slide: np.ndarray | None = None


@dataclass(frozen=True)
class Bodies:
    """What a run's pictures show. place (n, 3): the grid's points under the load, displacements times `scale`."""

    run: Run
    grid: Grid
    surface: Surface
    table: dict[str, np.ndarray]
    names: list[str]
    rigid: list[bool]
    scale: float

    @property
    def place(self) -> np.ndarray:
        return self.grid.points + self.scale * self.grid.move

    @property
    def points(self) -> np.ndarray:
        """The contact points' places (p, 3)."""
        here = len(self.table["pressure"])
        return self.surface.points[:here] + self.scale * self.surface.move[:here]

    @property
    def normals(self) -> np.ndarray:
        """From slave to master (p, 3)."""
        return np.column_stack([self.table[f"normal{axis}"] for axis in "XYZ"])

    @property
    def greatest(self) -> float:
        """The greatest pressure or pull; ResultsError without contact."""
        greatest = np.abs(self.table["pressure"]).max()
        if not greatest > 0:
            raise ResultsError(self.run.path / "contact.csv", "no point is in contact")
        return greatest

    @property
    def coloured(self) -> float:
        """A scale's end: of pressures without bound what a fiftieth of the contact's force lies above."""
        table, tops = self.table, []
        told = (self.run.summary.get("estimates") or {}).get("contacts") or []
        for contact in set(table["contact"].tolist()):
            strength = np.sort(np.abs(table["pressure"][table["contact"] == contact]))
            order = np.argsort(np.abs(table["pressure"][table["contact"] == contact]))
            force = np.cumsum(strength * table["weight"][table["contact"] == contact][order])
            bound = contact >= len(told) or told[contact].get("pressureMax") is not None or not force[-1] > 0
            tops.append(strength[-1] if bound else strength[np.searchsorted(force, 0.98 * force[-1])])
        return max(tops) if max(tops) > 0 else self.greatest

    def touching(self, contact: int | None = None) -> np.ndarray:
        """Which points press or pull (p,) bool, of one contact or of all."""
        strength = np.abs(self.table["pressure"])
        carries = strength > TOUCHING * strength.max()
        return carries if contact is None else carries & (self.table["contact"] == contact)


def read_bodies(run: Run, scale: float = 1.0) -> Bodies:
    """The bodies of a run with its files for ParaView; older runs, whose tables say less, have one contact, upwards."""
    path = run.path / "contact.csv"
    grid, surface = read_grid(run.path / "solution.vtu"), read_surface(run.path / "contact.vtu")
    with path.open(encoding="utf-8") as file:
        names = file.readline().strip().split(",")
    optional = "z normalX normalY normalZ contact along chain shear shearX shearY shearZ slide".split()
    optional = [name for name in optional if name in names]
    table = read_table(path, ["x", "y", "weight", "overlap", "pressure", *optional])
    count = len(table["x"])
    if len(surface.points) < count:
        raise ResultsError(run.path / "contact.vtu", "is of another run: it has fewer points than contact.csv")
    up = "normalZ" if grid.space else "normalY"
    for name in "normalX normalY normalZ contact chain".split():
        table.setdefault(name, np.full(count, float(name == up and "normalX" not in optional)))
    table["contact"] = table["contact"].astype(int)
    stated = run.summary.get("contacts") or []
    last = table["contact"].max(initial=0)
    titles = [brief(str(each.get("name", ""))) for each in stated] or [""]
    rigid = [each.get("master") is None for each in stated] or [
        not any(key.startswith("masterForce") for key in run.summary)
    ]
    if len(titles) <= last:
        raise ResultsError(path, f"has a contact {last}, but summary.json has {len(titles)}")
    return Bodies(run, grid, surface, table, titles, rigid, scale)


def write_picture(arguments: argparse.Namespace, name: str, draw: Callable) -> None:
    """Draws one run as the arguments of style.add_picture say, into its own folder by default; prints the paths."""
    chosen = read_run(arguments.folder)
    out = Path(arguments.out) if arguments.out else chosen.path / f"{name}.pdf"
    with style.look():
        bodies = read_bodies(chosen, arguments.scale)
        figure = draw(bodies, units_of(chosen, arguments.units), sight(*arguments.view), arguments.slide)
        if not arguments.out:
            enter(chosen.path, [f"{name}.pdf", f"{name}.png"])
        for path in write_figure(figure, out):
            print(path)


def units_of(run: Run, given: tuple[str, str]) -> style.Units:
    """The units named on the command line, or those that the run's case file names."""
    stated = run.summary.get("units")
    if tuple(given) == (style.Units.length, style.Units.stress) and isinstance(stated, list) and len(stated) == 2:
        given = [brief(str(name), 20) for name in stated]
    return style.Units(*map(style.plain, given))


def title(axes, index: int, words: str = "") -> None:
    """A panel's letter, and what it shows."""
    axes.set_title(f"{style.panel(index)} {words}", loc="left", fontsize=8)


def motion(bodies: Bodies, units: style.Units) -> str:
    """What the displacements in a picture are."""
    most = np.sqrt((bodies.grid.move**2).sum(axis=1).max())
    drawn = "true scale" if bodies.scale == 1 else f"drawn {style.number(bodies.scale)} times"
    unit = "" if units.length == style.Units.length else f" {units.length}"
    return f"displacements up to {most:.3g}{unit}, {drawn}"


# ---------------------------------------------------------------- the plane


def chains(bodies: Bodies) -> list[Chain]:
    """The contacts' pieces; a closed one is cut open where nothing touches."""
    table, found = bodies.table, []
    for contact, chain in sorted(set(zip(table["contact"].tolist(), table["chain"].tolist(), strict=True))):
        rows = np.flatnonzero((table["contact"] == contact) & (table["chain"] == chain))
        along = (table["along"] if "along" in table else table["x"])[rows].copy()
        loads = (table["weight"] * np.maximum(table["pressure"], 0))[rows]
        closed = bodies.run.summary.get("contacts") or [{}]
        length = closed[contact].get("closed", {}).get(str(int(chain)))
        if length and loads.sum() > 0:
            # the angle of the middle of what presses, as of a circle
            turn = 2 * np.pi * along / length
            middle = np.arctan2(loads @ np.sin(turn), loads @ np.cos(turn)) * length / (2 * np.pi)
            along = (along - middle + length / 2) % length - length / 2
            order = np.argsort(along)
            rows, along = rows[order], along[order]
            rows, along = np.append(rows, rows[0]), np.append(along, along[0] + length)
        elif "along" in table and not np.array_equal(table["along"], table["x"]):
            along -= loads @ along / loads.sum() if loads.sum() > 0 else along.mean()
        place, normal = bodies.points[rows, :2], bodies.normals[rows, :2]
        fields = bodies.table["pressure"][rows], bodies.table["overlap"][rows]
        rubs = (table["shear"][rows], table["slide"][rows]) if "shear" in table else ()
        found.append(Chain(contact, bodies.names[contact], place, normal, *fields, along, bodies.rigid[contact], *rubs))
    return found


def tall(bodies: Bodies, box: np.ndarray) -> float:
    """How high the greatest pressure stands (length) in a box of corners: not higher than the contact is long."""
    most = bodies.table["contact"][bodies.table["pressure"].argmax()]
    touched = bodies.points[bodies.touching(most), :2]
    return min(0.16 * np.ptp(box, axis=0).min(), 0.5 * np.ptp(touched, axis=0).max())


def plane_window(bodies: Bodies) -> tuple[np.ndarray, np.ndarray]:
    """The corners of a box around all bodies, and of the one that carries the greatest pressure's surroundings."""
    place = bodies.place[:, :2]
    # with room for the pressure's diagram and for a rigid obstacle close by
    size = np.ptp(place, axis=0).max()
    carried = np.maximum(bodies.table["pressure"], 0) / bodies.greatest
    near = np.where(np.abs(bodies.table["overlap"]) < 0.05 * size, -bodies.table["overlap"], 0)
    tops = (
        bodies.points[:, :2]
        + np.maximum(0.16 * np.ptp(place, axis=0).min() * carried, near)[:, None] * bodies.normals[:, :2]
    )
    place = np.concatenate([place, tops])
    margin = 0.03 * np.ptp(place, axis=0).max()
    whole = np.array([place.min(axis=0) - margin, place.max(axis=0) + margin])
    most = bodies.table["contact"][bodies.table["pressure"].argmax()]
    touched = bodies.points[bodies.touching(most), :2]
    middle, half = 0.5 * (touched.min(axis=0) + touched.max(axis=0)), 0.5 * np.ptp(touched, axis=0).max()
    spacing = np.sqrt(2 * plane_areas(bodies).min())
    half = max(1.6 * half, 6 * spacing)
    return whole, np.array([middle - half * np.array([1, 0.75]), middle + half * np.array([1, 0.75])])


def plane_areas(bodies: Bodies) -> np.ndarray:
    """Of the undeformed triangles."""
    a, b, c = (bodies.grid.points[bodies.grid.cells[:, k], :2] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    return 0.5 * np.abs(ux * vy - uy * vx)


def fill_plane(axes, bodies: Bodies, stress: bool):
    """The bodies, each in its colour or all by von Mises' stress, with their outlines; what a colour bar is for."""
    grid, place = bodies.grid, bodies.place
    colours = None
    if stress:
        mesh = Triangulation(place[:, 0], place[:, 1], grid.cells)
        colours = axes.tripcolor(mesh, grid.stress, shading="gouraud", cmap="viridis", vmin=0, rasterized=True)
    else:
        for number, body in enumerate(np.unique(grid.body)):
            cells = place[grid.cells[grid.body == body], :2]
            colour = FILLS[number % len(FILLS)]
            axes.add_collection(PolyCollection(cells, facecolor=colour, edgecolor=colour, linewidth=0.1, zorder=1))
    lines = place[grid.skin][:, :, :2]
    axes.add_collection(LineCollection(lines, color=style.BLACK, linewidth=0.5, zorder=3))
    return colours


def stand_pressure(axes, bodies: Bodies, height: float) -> None:
    """The pressure on the contacts' surfaces: as high as `height` (length) where it is greatest; rigid obstacles."""
    scale = height / bodies.greatest
    for chain in chains(bodies):
        foot, top = chain.place, chain.place + scale * chain.pressure[:, None] * chain.normal
        carries = (chain.pressure[:-1] != 0) | (chain.pressure[1:] != 0)
        near = np.hypot(*np.diff(foot, axis=0).T) < 10 * np.median(np.hypot(*np.diff(foot, axis=0).T))
        walls = np.stack([foot[:-1], foot[1:], top[1:], top[:-1]], axis=1)[carries & near]
        axes.add_collection(PolyCollection(walls, facecolor=style.VERMILION, alpha=0.3, linewidth=0, zorder=4))
        crest = np.stack([top[:-1], top[1:]], axis=1)[carries & near]
        axes.add_collection(LineCollection(crest, color=style.VERMILION, linewidth=0.9, zorder=5))
        if chain.rigid:
            size = np.ptp(chain.place, axis=0).max()
            opposite = chain.place - chain.overlap[:, None] * chain.normal
            close = (np.abs(chain.overlap) < FARTHEST * size)[:-1] & (np.abs(chain.overlap) < FARTHEST * size)[1:]
            line = np.stack([opposite[:-1], opposite[1:]], axis=1)[close & near]
            axes.add_collection(LineCollection(line, color=style.GREY, linewidth=1.4, zorder=2.5))


def zones(place: np.ndarray, slide: np.ndarray) -> list[tuple[float, float, int]]:
    """From where to where it sticks (1) or slips (2); each point stands for half of the way to its neighbours."""
    middle = 0.5 * (place[1:] + place[:-1])
    from_, to = np.concatenate([place[:1], middle]), np.concatenate([middle, place[-1:]])
    ends = np.flatnonzero(np.diff(slide, append=-1))
    starts = np.concatenate([[0], ends[:-1] + 1])
    return [(from_[a], to[b], int(slide[a])) for a, b in zip(starts, ends, strict=True) if slide[a] > 0]


def plot_shear(axes, chain: Chain, look: dict, first: bool) -> None:
    """The shear of a contact, and behind it where it sticks and slips."""
    name = f"{style.plain(chain.name)} shear".lstrip() if first else None
    own = {"marker": "s", "color": style.VERMILION} if chain.contact == 0 else {"linestyle": (0, (3, 1.5))}
    axes.plot(chain.along, chain.shear, label=name, **(look | own))
    for start, end, slide in zones(chain.along, chain.slide):
        axes.axvspan(start, end, color=ZONES[slide], linewidth=0, zorder=0)


def name_zones(axes) -> None:
    """A legend above the panel: the curves, and the colours of what sticks and slips."""
    handles, names = axes.get_legend_handles_labels()
    handles += [Rectangle((0, 0), 1, 1, color=ZONES[slide], linewidth=0) for slide in (1, 2)]
    axes.legend(
        handles, [*names, "sticks", "slips"], ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0), fontsize=7
    )


def plot_pressure(axes, bodies: Bodies, units: style.Units) -> None:
    """The pressure over the arc length, a curve a contact, as far as they touch; with friction the shear beside it."""
    seen, shown, pulls = set(), [], False
    rubs = "shear" in bodies.table
    for chain in chains(bodies):
        touched = np.abs(chain.pressure) > TOUCHING * bodies.greatest
        if not touched.any():
            continue
        first = chain.contact not in seen
        seen.add(chain.contact)
        look = style.curve(chain.contact) | {"markersize": 2.2, "markeredgewidth": 0, "linewidth": 0.9}
        name = style.plain(chain.name)
        if rubs:
            name = f"{name} pressure".lstrip()
            pulls = pulls or chain.shear.min() < 0
        axes.plot(chain.along, chain.pressure, label=name if first else None, **look)
        if rubs:
            plot_shear(axes, chain, look, first)
        shown += [chain.along[touched].min(), chain.along[touched].max()]
        pulls = pulls or chain.pressure[touched].min() < 0
    margin = 0.15 * (max(shown) - min(shown)) or 1.0
    axes.set_xlim(min(shown) - margin, max(shown) + margin)
    if pulls:
        axes.axhline(0, color=style.GREY, linewidth=0.5, zorder=0)
    else:
        axes.set_ylim(0, None)
    arc = "along" in bodies.table and not np.array_equal(bodies.table["along"], bodies.table["x"])
    words = "arc length" if arc else "$x$"
    axes.set_xlabel(f"{words} [{units.length}]")
    axes.set_ylabel(f"{'traction' if rubs else 'pressure'} [{units.stress}]")
    if rubs:
        name_zones(axes)
    elif len(seen) > 1 or any(bodies.names):
        axes.legend()


# ---------------------------------------------------------------- space


def sight(azimuth: float, elevation: float) -> np.ndarray:
    """The rows of an orthographic view (3, 3): to the right, up, towards the eye; angles in degrees."""
    turn, rise = np.radians([azimuth, elevation])
    eye = np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])
    right = np.array([-np.sin(turn), np.cos(turn), 0])
    return np.array([right, np.cross(eye, right), eye])


def draw_shell(axes, bodies: Bodies, view: np.ndarray, values: np.ndarray | None, top: float):
    """The bodies' surface from outside, far parts first: each body in its colour, or by a field at the nodes."""
    grid = bodies.grid
    seen = bodies.place[grid.skin] @ view.T
    order = np.argsort(seen[:, :, 2].mean(axis=1))
    across = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
    across /= np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None]
    bright = 0.62 + 0.38 * np.abs(across @ LIGHT)
    if values is None:
        of = dict(zip(np.unique(grid.body).tolist(), range(100), strict=False))
        body = np.zeros(len(grid.points), int)
        body[grid.cells] = grid.body[:, None]
        fills = np.array([[int(fill[i : i + 2], 16) / 255 for i in (1, 3, 5)] for fill in FILLS])
        colours = fills[[of[each] % len(FILLS) for each in body[grid.skin[:, 0]].tolist()]]
    else:
        colours = style.shades(values[grid.skin].mean(axis=1) / top)
    colours = colours * bright[:, None]
    faces = PolyCollection(seen[order][:, :, :2], facecolor=colours[order], edgecolor="face", linewidth=0.15)
    faces.set_rasterized(True)
    axes.add_collection(faces)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()
    corner = np.array([0.1, 0.1])
    for k, name in enumerate("xyz"):
        tip = corner + 0.09 * view[:2, k]
        look = {
            "xycoords": "axes fraction",
            "textcoords": "axes fraction",
            "fontsize": 8,
            "ha": "center",
            "va": "center",
        }
        arrow = {"arrowstyle": "<-", "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0}
        axes.annotate(f"${name}$", corner, corner + 1.45 * (tip - corner), arrowprops=arrow, **look)


def facing(normal: np.ndarray) -> tuple[np.ndarray, list[str]]:
    """The view along a normal, from outside, and what its axes are called: coordinates where they nearly are such."""
    normal = normal / np.linalg.norm(normal)
    if np.abs(normal).max() > 0.995:
        normal = np.round(normal)
    first = np.eye(3)[0 if abs(normal[0]) < 0.9 else 1]
    right = first - (first @ normal) * normal
    view = np.array([right / np.linalg.norm(right), np.zeros(3), normal])
    view[1] = np.cross(normal, view[0])
    words = [next((f"${name}$" for k, name in enumerate("xyz") if row[k] > 1 - 1e-9), "across") for row in view[:2]]
    return view, words


def map_pressure(axes, bodies: Bodies, contact: int, units: style.Units, top: float):
    """The pressure on one contact's surface, seen along the mean of the normals where it presses."""
    surface, count = bodies.surface, len(bodies.points)
    touched = bodies.touching(contact)
    loads = bodies.table["weight"] * np.abs(bodies.table["pressure"]) * touched
    view, words = facing(loads @ bodies.normals)
    cells = surface.cells[surface.contact == contact]
    seen = (surface.points + bodies.scale * surface.move) @ view.T
    centre = loads @ seen[:count] / loads.sum()
    half = 1.25 * np.abs(seen[:count][touched] - centre)[:, :2].max(axis=0).max()
    mesh = Triangulation(seen[:, 0], seen[:, 1], cells)
    scale = {"cmap": "viridis", "vmin": 0, "vmax": top}
    if bodies.table["pressure"][touched].min() < 0:
        scale = {"cmap": "RdBu_r", "vmin": -top, "vmax": top}
    colours = axes.tripcolor(mesh, surface.pressure, shading="gouraud", rasterized=True, **scale)
    axes.set_aspect("equal")
    for limits, middle, low, high in (
        (axes.set_xlim, centre[0], seen[cells, 0].min(), seen[cells, 0].max()),
        (axes.set_ylim, centre[1], seen[cells, 1].min(), seen[cells, 1].max()),
    ):
        limits(max(middle - half, low), min(middle + half, high))
    axes.set_xlabel(f"{words[0]} [{units.length}]")
    axes.set_ylabel(f"{words[1]} [{units.length}]")
    return colours


def map_shear(axes, bodies: Bodies, contact: int, units: style.Units) -> float:
    """What sticks and slips on one contact's surface, and arrows: the shear on the slave. Returns the greatest."""
    table, touched = bodies.table, bodies.touching(contact)
    view, words = facing((table["weight"] * np.abs(table["pressure"]) * touched) @ bodies.normals)
    place = (bodies.points @ view.T)[table["contact"] == contact][:, :2]
    state = np.where(touched, table["slide"], 0)[table["contact"] == contact].astype(int)
    seen = (bodies.points @ view.T)[touched, :2]
    shear = (np.column_stack([table[f"shear{axis}"] for axis in "XYZ"]) @ view.T)[touched, :2]
    greatest = np.linalg.norm(shear, axis=1).max()
    middle = 0.5 * (seen.min(axis=0) + seen.max(axis=0))
    half = 1.3 * np.abs(seen - middle).max()
    # each place is of the state of the point that is next to it
    side = (np.arange(160) + 0.5) / 80 - 1
    across = middle[0] + half * side
    nearest = [
        ((across[:, None] - place[:, 0]) ** 2 + (y - place[:, 1]) ** 2).argmin(axis=1) for y in middle[1] + half * side
    ]
    colours = np.array([to_rgb(colour) for colour in ("white", *ZONES.values())])
    box = (middle[0] - half, middle[0] + half, middle[1] - half, middle[1] + half)
    axes.imshow(colours[state[np.array(nearest)]], extent=box, origin="lower", interpolation="nearest")
    length = 2.2 * half / np.sqrt(max(len(seen), 16))
    part = slice(None, None, 1 + len(seen) // 250)
    arrows = {"angles": "xy", "scale_units": "xy", "scale": 1, "width": 0.005, "color": style.VERMILION}
    axes.quiver(*seen[part].T, *(shear[part] / max(greatest, 1e-300) * length).T, pivot="mid", **arrows)
    axes.set_xlabel(f"{words[0]} [{units.length}]")
    axes.set_ylabel(f"{words[1]} [{units.length}]")
    handles = [Rectangle((0, 0), 1, 1, color=ZONES[slide], linewidth=0) for slide in (1, 2)]
    axes.legend(handles, ["sticks", "slips"], loc="upper right", fontsize=7, borderaxespad=0.1, handlelength=1.2)
    return greatest
