"""Bodies under their loads, for the commands `state` and `stress`: what the files hold, and how a part of it is drawn.

In the plane bodies are filled triangles, and the pressure stands on the contact's surface as a curve; what is drawn of
bodies in space is in bodies_3d.py.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import Collection, LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.tri import Triangulation

from postprocess import style
from postprocess.output import write_figure_of_run
from postprocess.results import ResultsError, Run, column_names, one_line, read_run, read_table
from postprocess.vtu import NONE, Grid, Surface, bodies_file, read_grid, read_surface

FILLS = ("#DCE9F3", "#E9E6E1", "#DFF0E4", "#F7E9D7", "#F0E3EE", "#E0E0F0")
ZONES = {1: "#CFE8DC", 2: "#FBE3C4"}  # behind curves: sticks, slips
SHEAR: style.Look = {"marker": "", "linestyle": (0, (4, 1.5))}
LIGHT = np.array([-0.35, -0.5, 0.79])
FARTHEST = 1.5  # an obstacle is drawn as far from the surface as that times the contact's size
ARROWS = 0.06  # from one to the next, of the contact's length
SEEN = 2.0  # points: the least side of an element that is drawn
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
    along: np.ndarray  # from the origin on, or x
    rigid: bool
    origin: str  # what the arc length begins at: "axis", "middle" of the pressure; "" for x
    shear: np.ndarray = field(
        default_factory=lambda: NONE
    )  # with friction: traction on the slave, and 0 open, 1 sticks, 2 slips
    slide: np.ndarray = field(default_factory=lambda: NONE)
    rest: np.ndarray = field(default_factory=lambda: NONE)  # (n, 2) undeformed places

    @property
    def joined(self) -> np.ndarray:
        """Which neighbours (n - 1,) are so near that a line may join them."""
        steps = np.hypot(*np.diff(self.place, axis=0).T)
        return steps < 10 * np.median(steps)

    def reached(self, least: float) -> np.ndarray:
        """Which points (n,) carry more than `least`, or are beside such: there the pressure's line begins and ends."""
        carries = np.abs(self.pressure) > least
        reached = carries.copy()
        reached[1:] |= carries[:-1] & self.joined
        reached[:-1] |= carries[1:] & self.joined
        return reached

    @property
    def towards(self) -> str:
        """The coordinate with which the arc length of an open piece grows, x or y; nothing for a closed one."""
        along, across = np.abs(self.place[-1] - self.place[0])
        closed = np.array_equal(self.place[0], self.place[-1])
        return "" if closed or self.origin != "middle" else "x" if along > 0.99 * across else "y"

    @property
    def zero(self) -> np.ndarray:
        """The place where the arc length is 0."""
        order = np.argsort(self.along)
        return np.array([np.interp(0, self.along[order], self.place[order, k]) for k in range(2)])


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
        """A scale's end: of pressures without bound what a tenth of the contact's force lies above."""
        table, tops = self.table, []
        estimates = (self.run.summary.get("estimates") or {}).get("contacts") or []
        for contact in set(table["contact"].tolist()):
            strength = np.sort(np.abs(table["pressure"][table["contact"] == contact]))
            order = np.argsort(np.abs(table["pressure"][table["contact"] == contact]))
            force = np.cumsum(strength * table["weight"][table["contact"] == contact][order])
            most = strength[np.searchsorted(force, 0.9 * force[-1])] if force[-1] > 0 else 0
            # where the run does not tell, it stands out
            known = contact < len(estimates)
            bound = estimates[contact].get("pressureMax") is not None if known else strength[-1] < 2 * most
            tops.append(strength[-1] if bound or not most > 0 else most)
        return max(tops) if max(tops) > 0 else self.greatest

    @property
    def about_axis(self) -> bool:
        summary = self.run.summary
        return "axisymmetric" in (summary.get("state"), summary["parameters"].get("geometry"))

    def touching(self, contact: int | None = None) -> np.ndarray:
        """Which points press or pull (p,) bool, of one contact or of all."""
        strength = np.abs(self.table["pressure"])
        carries = strength > TOUCHING * strength.max()
        return carries if contact is None else carries & (self.table["contact"] == contact)


def read_bodies(run: Run, scale: float | None = 1.0) -> Bodies:
    """The bodies of a run with its files for ParaView; older runs, whose tables say less, have one contact, upwards."""
    path = run.path / "contact.csv"
    grid, surface = read_grid(bodies_file(run.path)), read_surface(run.path / "contact.vtu")
    names = column_names(path)
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
    titles = [one_line(str(each.get("name", ""))) for each in stated] or [""]
    rigid = [each.get("master") is None for each in stated] or [
        not any(key.startswith("masterForce") for key in run.summary)
    ]
    if len(titles) <= last:
        raise ResultsError(path, f"has a contact {last}, but summary.json has {len(titles)}")
    if scale is None:  # so much that the largest is a twentieth of the bodies
        largest = np.sqrt((grid.move**2).sum(axis=1).max())
        scale = style.round_below(max(1.0, 0.05 * np.ptp(grid.points, axis=0).max() / max(largest, 1e-300)))
    return Bodies(run, grid, surface, table, titles, rigid, scale)


def at_true_scale(bodies: Bodies) -> Bodies:
    """For pictures of a contact: magnified displacements would show gaps and overlaps that are not there."""
    return replace(bodies, scale=1.0)


def write_picture(arguments: argparse.Namespace, name: str, draw: Callable) -> None:
    """Draws one run as the arguments of style.add_picture say, into its own folder by default; prints the paths."""
    chosen = read_run(arguments.folder)
    with style.look():
        bodies = read_bodies(chosen, arguments.scale)
        figure = draw(bodies, units_of(chosen, arguments.units), arguments.view, arguments.slide)
        write_figure_of_run(figure, arguments.out, chosen.path / f"{name}.pdf")


def units_of(run: Run, given: tuple[str, str]) -> style.Units:
    """The units named on the command line, or those that the run's case file names."""
    stated = run.summary.get("units")
    if tuple(given) == (style.Units.length, style.Units.stress) and isinstance(stated, list) and len(stated) == 2:
        return style.Units(*(style.without_mathtext(one_line(str(name), 20)) for name in stated))
    return style.Units(*map(style.without_mathtext, given))


def set_panel_title(axes: Axes, index: int, words: str = "", width: int = 56) -> None:
    """A panel's letter, and what it shows, in lines of so many letters."""
    axes.set_title(style.wrapped(f"{style.panel(index)} {words}", width), loc="left", fontsize=8)


def displacement_caption(bodies: Bodies, units: style.Units) -> str:
    """What the displacements in a picture are."""
    most = np.sqrt((bodies.grid.move**2).sum(axis=1).max())
    drawn = "true scale" if bodies.scale == 1 else f"drawn {style.number(bodies.scale)} times"
    unit = "" if units.length == style.Units.length else f" {units.length}"
    return f"displacements up to {most:.3g}{unit}, {drawn}"


# ---------------------------------------------------------------- the plane


def contact_chains(bodies: Bodies) -> list[Chain]:
    """The contacts' pieces; a closed one is cut open where nothing touches."""
    table, found = bodies.table, []
    for contact, chain in sorted(set(zip(table["contact"].tolist(), table["chain"].tolist(), strict=True))):
        rows = np.flatnonzero((table["contact"] == contact) & (table["chain"] == chain))
        along = (table["along"] if "along" in table else table["x"])[rows].copy()
        loads = (table["weight"] * np.maximum(table["pressure"], 0))[rows]
        origin = ""
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
            origin = "middle"
        elif "along" in table and not np.array_equal(table["along"], table["x"]):
            x, first = table["x"][rows], np.argmin(np.abs(along))
            # a bore or a cone does not begin at the axis
            origin = "axis" if bodies.about_axis and x[first] <= 1e-6 * np.abs(x).max() else "middle"
            if origin == "middle":
                along -= loads @ along / loads.sum() if loads.sum() > 0 else along.mean()
                # upwards or to the right: contacts are drawn over each other
                ends = bodies.surface.points[rows[[np.argmin(along), np.argmax(along)]]]
                across, up = ends[1, :2] - ends[0, :2]
                along *= -1 if (across if abs(across) > 0.99 * abs(up) else up) < 0 else 1
        place, normal = bodies.points[rows, :2], bodies.normals[rows, :2]
        fields = bodies.table["pressure"][rows], bodies.table["overlap"][rows]
        shear, slide = (table[name][rows] if "shear" in table else NONE for name in ("shear", "slide"))
        stated = bodies.rigid[contact], origin
        rest = bodies.surface.points[rows, :2]
        shown = place, normal, *fields, along, *stated, shear, slide, rest
        found.append(Chain(contact, bodies.names[contact], *shown))
    return found


def contacts_by_force(bodies: Bodies) -> list[int]:
    """The contacts where something presses or pulls, the strongest first; equal ones in the case file's order."""
    loads = np.abs(bodies.table["weight"] * bodies.table["pressure"]) * bodies.touching()
    forces = np.bincount(bodies.table["contact"], loads, len(bodies.names))
    ranked = np.round(forces / (forces.max() or 1.0), 3)
    return [int(contact) for contact in np.argsort(-ranked, kind="stable") if forces[contact] > 0]


def whole_window(bodies: Bodies) -> np.ndarray:
    """The corners of a box around all bodies, with room for the pressure's diagram and a rigid obstacle close by."""
    place = bodies.place[:, :2]
    size = np.ptp(place, axis=0).max()
    carried = np.maximum(bodies.table["pressure"], 0) / bodies.greatest
    near = np.where(np.abs(bodies.table["overlap"]) < 0.05 * size, -bodies.table["overlap"], 0)
    tops = (
        bodies.points[:, :2]
        + np.maximum(0.16 * np.ptp(place, axis=0).min() * carried, near)[:, None] * bodies.normals[:, :2]
    )
    place = np.concatenate([place, tops])
    margin = 0.03 * np.ptp(place, axis=0).max()
    return np.array([place.min(axis=0) - margin, place.max(axis=0) + margin])


def contact_window(bodies: Bodies, contact: int) -> np.ndarray:
    """The corners of a box around one contact, four by three."""
    touched = loaded_points(bodies, contact)
    middle, half = 0.5 * (touched.min(axis=0) + touched.max(axis=0)), 0.5 * np.ptp(touched, axis=0).max()
    half = max(1.6 * half, 6 * np.sqrt(2 * plane_areas(bodies).min()))
    return np.array([middle - half * np.array([1, 0.75]), middle + half * np.array([1, 0.75])])


def loaded_points(bodies: Bodies, contact: int | None = None) -> np.ndarray:
    """The places (n, 2) over which the pressure of one contact, or of all, stands, and those beside, where it ends."""
    least = TOUCHING * bodies.greatest
    found = [chain for chain in contact_chains(bodies) if contact in (None, chain.contact)]
    return np.concatenate([chain.place[chain.reached(least)] for chain in found])


def plane_areas(bodies: Bodies) -> np.ndarray:
    """Of the undeformed triangles."""
    a, b, c = (bodies.grid.points[bodies.grid.cells[:, k], :2] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    return 0.5 * np.abs(ux * vy - uy * vx)


def stress_range(bodies: Bodies, boxes: list[np.ndarray] | None = None) -> float:
    """Where the colours of von Mises' stress end near contacts.

    The greatest outside singular places where the run tells it, else what one node in 1000 lies above, in the plane one
    of those in the boxes; all where that is nearly the greatest. A peak in a corner far away ends no scale.
    """
    stresses = [body["vonMises"] for body in bodies.run.summary.get("stresses") or []]
    seen, place = bodies.grid.stress, bodies.place[:, :2]
    for box in [np.array(boxes)] if boxes else []:
        inside = ((place > box[:, :1]) & (place < box[:, 1:])).all(axis=2).any(axis=0)
        seen = seen[inside] if inside.any() else seen
    top = max(stresses) if stresses else np.percentile(seen, 99.9)
    return (
        min(top, seen.max()) if 0 < min(top, seen.max()) < bodies.grid.stress.max() / 1.3 else bodies.grid.stress.max()
    )


def whole_stress_range(bodies: Bodies) -> float:
    """The same of the whole: what a fiftieth of the bodies' area, in space of their surface, lies above."""
    grid = bodies.grid
    cells = grid.skin if grid.space else grid.cells
    sides = grid.points[cells[:, 1:]] - grid.points[cells[:, :1]]
    size = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    stress = grid.stress[cells].mean(axis=1)
    order = np.argsort(stress)
    share = np.cumsum(size[order])
    top = stress[order][np.searchsorted(share, 0.98 * share[-1])]
    most = stress_range(bodies)
    return top if 0 < top < most / 1.3 else most


def singular_points(bodies: Bodies) -> np.ndarray:
    """Deformed places (n, 3) where the stress has no bound, as the run says, or of the greatest where it lies above."""
    stated = [body["singular"] for body in bodies.run.summary.get("stresses") or [] if body["singular"]]
    at = np.array([[*place, 0.0][:3] for place in stated]).reshape(-1, 3)
    rows = [int(np.square(bodies.grid.points - place).sum(axis=1).argmin()) for place in at]
    if not rows and stress_range(bodies) < bodies.grid.stress.max():
        rows = [int(bodies.grid.stress.argmax())]
    return bodies.place[rows]


def colour_bar(
    figure: Figure,
    colours: ScalarMappable | Collection,
    axes: list[Axes],
    bodies: Bodies,
    units: style.Units,
    what: str = "von Mises",
) -> None:
    """Beside one panel, below several; its end is an arrow where the greatest lies above, which is said."""
    most = bodies.grid.stress.max() if what == "von Mises" else bodies.greatest
    above = colours.get_clim()[1] < most * (1 - 1e-9)
    words = f"up to ${style.number(float(f'{most:.3g}'))}$" if above else ""
    upright = len(axes) == 1 and np.ptp(axes[0].get_ylim()) > 0.4 * np.ptp(axes[0].get_xlim())
    label = f"{what} [{units.stress}]"
    if above:  # in two lines beside a panel: a short bar's label would stand out above it
        label = f"{label}\n{words}" if upright else f"{what}, {words} [{units.stress}]"
    look: style.Look = {"extend": "max" if above else "neither", "label": label}
    if upright:
        axes[0].set_anchor("W")
        look |= {"cax": axes[0].inset_axes((1.03, 0, 0.045, 1))}
    else:
        look |= {"ax": axes, "location": "bottom", "aspect": 40, "pad": 0.02}
    figure.colorbar(colours, **look)


def fill_plane(axes: Axes, bodies: Bodies, top: float | None) -> Collection | None:
    """The bodies, each in its colour or all by von Mises' stress up to `top`, with their outlines.

    Returns what a colour bar is for.
    """
    grid, place = bodies.grid, bodies.place
    colours = None
    if top is not None:
        mesh = Triangulation(place[:, 0], place[:, 1], grid.cells)
        look: style.Look = {"shading": "gouraud", "cmap": "viridis", "vmin": 0, "vmax": top}
        colours = axes.tripcolor(mesh, grid.stress, rasterized=True, **look)
        mark_singular(axes, singular_points(bodies)[:, :2])
    else:
        for number, body in enumerate(np.unique(grid.body)):
            cells = place[grid.cells[grid.body == body], :2]
            colour = FILLS[number % len(FILLS)]
            axes.add_collection(
                PolyCollection(list(cells), facecolor=colour, edgecolor=colour, linewidth=0.1, zorder=1)
            )
    lines = place[grid.skin][:, :, :2]
    axes.add_collection(LineCollection(lines, color=style.BLACK, linewidth=0.5, zorder=3))
    return colours


def mark_singular(axes: Axes, at: np.ndarray) -> None:
    look: style.Look = {"markersize": 6, "markeredgewidth": 0.9, "fillstyle": "none", "linestyle": "none", "zorder": 7}
    axes.plot(*at.T, marker="o", color=style.VERMILION, **look)


def draw_pressure_diagram(axes: Axes, bodies: Bodies, box: np.ndarray, contact: int | None, units: style.Units) -> None:
    """The pressure on the undeformed surface of one contact, or of all, in a box; its scale; rigid obstacles.

    Where it is greatest it stands not higher than the contact is long. On a surface that has moved by more than half of
    its contact the arrows stand where it is now.
    """
    touched = bodies.touching(contact)
    greatest = np.abs(bodies.table["pressure"][touched]).max()
    long = np.ptp(loaded_points(bodies, contact), axis=0).max()
    scale = min(0.16 * np.ptp(box, axis=0).min(), 0.5 * long) / greatest
    for chain in contact_chains(bodies):
        if chain.rigid:
            size = np.ptp(chain.place, axis=0).max()
            close = np.abs(chain.overlap) < FARTHEST * size
            opposite = chain.place - chain.overlap[:, None] * chain.normal
            line = np.stack([opposite[:-1], opposite[1:]], axis=1)[close[:-1] & close[1:] & chain.joined]
            axes.add_collection(LineCollection(line, color=style.GREY, linewidth=1.4, zorder=2.5))
        if contact is not None and chain.contact != contact:
            continue
        moved = np.linalg.norm(chain.place - chain.rest, axis=1).max(initial=0)
        foot = chain.rest if moved < 0.5 * long else chain.place
        top = foot + scale * chain.pressure[:, None] * chain.normal
        carries = ((chain.pressure[:-1] != 0) | (chain.pressure[1:] != 0)) & chain.joined
        walls = np.stack([foot[:-1], foot[1:], top[1:], top[:-1]], axis=1)[carries]
        axes.add_collection(PolyCollection(walls, facecolor="white", alpha=0.6, linewidth=0, zorder=4))
        crest = np.stack([top[:-1], top[1:]], axis=1)[carries]
        axes.add_collection(LineCollection(crest, color=style.VERMILION, linewidth=0.9, zorder=5))
        surface = np.stack([foot[:-1], foot[1:]], axis=1)[chain.joined]
        axes.add_collection(LineCollection(surface, color=style.BLACK, linewidth=0.6, linestyle=(0, (3, 2)), zorder=4))
        draw_arrows(axes, foot, top, max(ARROWS * long, np.ptp(box[:, 0]) / 80))
        if chain.origin == "middle" and chain.reached(TOUCHING * bodies.greatest).any():
            axes.plot(*chain.zero, marker="o", markersize=2.5, color=style.BLACK, zorder=6)
    marked = style.round_below(greatest)
    begin = box[0] + 0.05 * np.ptp(box, axis=0)
    axes.plot(begin[0] + [0, scale * marked], begin[[1, 1]], color=style.VERMILION, linewidth=2.5, zorder=8)
    unit = "" if units.stress == style.Units.stress else f" {units.stress}"
    look: style.Look = {"textcoords": "offset points", "va": "bottom", "fontsize": 7, "bbox": style.HALO, "zorder": 8}
    axes.annotate(f"pressure ${style.number(marked)}${unit}", begin, (0, 3.5), color=style.VERMILION, **look)


def draw_arrows(axes: Axes, foot: np.ndarray, top: np.ndarray, spacing: float) -> None:
    """Arrows (n, 2) from top to foot, at points of a line that are so far apart."""
    along = np.cumsum(np.append(0, np.hypot(*np.diff(foot, axis=0).T)))
    shown = np.flatnonzero(np.diff(np.floor(along / spacing), prepend=-1) > 0)
    shown = shown[np.hypot(*(top - foot)[shown].T) > 0.1 * spacing]
    look: style.Look = {"angles": "xy", "scale_units": "xy", "scale": 1, "units": "inches", "width": 0.007}
    look |= {"headwidth": 5, "headlength": 6, "headaxislength": 5.5, "minlength": 0.1, "zorder": 5}
    axes.quiver(*top[shown].T, *(foot - top)[shown].T, color=style.VERMILION, **look)


def draw_mesh(axes: Axes, bodies: Bodies, box: np.ndarray, coloured: bool) -> None:
    """The elements' sides in a box, those that can be told from each other; white on colours."""
    place = bodies.place[:, :2]
    near = ((place > box[0]) & (place < box[1])).all(axis=1)
    cells = bodies.grid.cells[near[bodies.grid.cells].any(axis=1)]
    sides = place[Triangulation(place[:, 0], place[:, 1], cells).edges]
    # points on paper, in a panel of a column's width
    size = np.hypot(*(sides[:, 1] - sides[:, 0]).T) * 0.8 * 72 * style.COLUMN / np.ptp(box[:, 0])
    look: style.Look = {"color": "white" if coloured else style.BLACK, "alpha": 0.45 if coloured else 0.35}
    look |= {"linewidth": np.clip(0.06 * size[size > SEEN], 0.1, 0.4), "zorder": 2, "rasterized": True}
    axes.add_collection(LineCollection(list(sides[size > SEEN]), **look))


def force_caption(bodies: Bodies, contact: int, units: style.Units) -> str:
    """The normal force of a contact and its error, as far as the run tells them."""
    summary = bodies.run.summary
    known, estimates = summary.get("contacts") or [], summary.get("estimates") or {}
    if len(known) <= contact or "normalForce" not in known[contact]:
        return ""
    told = (
        estimates.get("contacts") or [{"normalForce": estimates.get("force")}] * (len(known) == 1) or [{}] * len(known)
    )
    error = ((told[contact] or {}).get("normalForce") or {}).get("error")
    unit = {("mm", "MPa"): "N", ("m", "Pa"): "N"}.get((units.length, units.stress), "")
    per = f"/{units.length}" if unit and not (bodies.about_axis or bodies.grid.space) else ""
    value = known[contact]["normalForce"]
    digits = (
        max(0, 1 - int(np.floor(np.log10(error)))) if error else max(0, 3 - int(np.floor(np.log10(abs(value) or 1))))
    )
    words = f"{value:.{digits}f}" + (f" ± {error:.{digits}f}" if error else "")
    return "; force " + f"{words} {unit}{per}".rstrip().replace(" ", "\u00a0")  # on one line


def coordinates_text(bodies: Bodies, place: np.ndarray) -> str:
    """Coordinates, to a ten-thousandth of the bodies."""
    digits = 3 - int(np.floor(np.log10(np.ptp(bodies.grid.points, axis=0).max())))
    return "(" + ",\u00a0".join(f"{round(value, digits) + 0.0:g}" for value in place).replace("-", "\u2212") + ")"


def origin_caption(bodies: Bodies, contact: int) -> str:
    """Where a contact's arc length begins, if that is the middle of its pressure."""
    found = [chain for chain in contact_chains(bodies) if chain.contact == contact and chain.pressure.any()]
    if len(found) != 1 or found[0].origin != "middle":
        return ""
    return f"; arc length from \u2022\u00a0{coordinates_text(bodies, found[0].zero)}"


def slip_zones(place: np.ndarray, slide: np.ndarray) -> list[tuple[float, float, int]]:
    """From where to where it sticks (1) or slips (2); each point stands for half of the way to its neighbours."""
    middle = 0.5 * (place[1:] + place[:-1])
    from_, to = np.concatenate([place[:1], middle]), np.concatenate([middle, place[-1:]])
    ends = np.flatnonzero(np.diff(slide, append=-1))
    starts = np.concatenate([[0], ends[:-1] + 1])
    return [(from_[a], to[b], int(slide[a])) for a, b in zip(starts, ends, strict=True) if slide[a] > 0]


def draw_slip_zones(axes: Axes, found: list[Chain]) -> None:
    """Where it sticks and slips: behind the curves of a single piece; of several in a strip each below the curves."""
    height = 1.0 if len(found) == 1 else min(0.06, 0.4 / len(found))
    if len(found) > 1:
        low, high = axes.get_ylim()
        axes.set_ylim(low - (high - low) * 1.3 * height * len(found), high)
    for number, chain in enumerate(found):
        bottom = 1.3 * height * (len(found) - 1 - number)
        for start, end, slide in slip_zones(chain.along, chain.slide):
            axes.axvspan(start, end, bottom, bottom + height, color=ZONES[slide], linewidth=0, zorder=0)
        if len(found) > 1:
            look = style.curve(chain.contact) | {"markersize": 2.5, "linestyle": "none", "clip_on": False}
            axes.plot(0.0, bottom + 0.5 * height, transform=axes.transAxes, **look)


def zone_legend(axes: Axes) -> tuple[list[Artist], list[str]]:
    """Handles and labels of a legend: the curves of the axes with names, and the colours of what sticks and slips."""
    handles, names = axes.get_legend_handles_labels()
    zones: list[Artist] = [Rectangle((0, 0), 1, 1, color=ZONES[slide], linewidth=0) for slide in (1, 2)]
    return [*handles, *zones], [*names, "sticks", "slips"]


def plot_pressure(axes: Axes, bodies: Bodies, units: style.Units, narrow: bool = False) -> None:
    """The pressure over the arc length, a curve a contact, as far as they touch; the origin is stated.

    With friction the shear stands beside it, and what sticks and slips is coloured.
    """
    rubs = "shear" in bodies.table
    seen, shown, pulls, origins = set(), [], False, set()
    found = [chain for chain in contact_chains(bodies) if np.any(np.abs(chain.pressure) > TOUCHING * bodies.greatest)]
    for chain in found:
        reached = chain.reached(TOUCHING * bodies.greatest)
        first = chain.contact not in seen
        seen.add(chain.contact)
        origins.add(chain.origin)
        look = style.curve(chain.contact) | {"markersize": 2.2, "markeredgewidth": 0, "linewidth": 0.9}
        name = style.wrapped(f"{chain.name} pressure".strip(), 24) if rubs else style.wrapped(chain.name, 44)
        axes.plot(chain.along, chain.pressure, label=(first and style.without_mathtext(name)) or None, **look)
        if rubs:
            axes.plot(chain.along, chain.shear, **(look | SHEAR))
            pulls = pulls or chain.shear[reached].min() < -TOUCHING * bodies.greatest
        shown += [chain.along[reached].min(), chain.along[reached].max()]
        pulls = pulls or chain.pressure[reached].min() < -TOUCHING * bodies.greatest
    margin = 0.1 * (max(shown) - min(shown)) or 1.0
    axes.set_xlim(min(shown) - margin, max(shown) + margin)
    if pulls:
        axes.axhline(0, color=style.GREY, linewidth=0.5, zorder=0)
    else:
        axes.set_ylim(0, None)
    if rubs:
        draw_slip_zones(axes, found)
    axes.ticklabel_format(useOffset=False)
    begins = {"axis": " from the axis", "middle": " from the middle of the pressure"}
    origin = next(iter(origins)) if len(origins) == 1 else "middle"
    ways = {chain.towards for chain in found}
    way = {"x": ", to the right", "y": ", upwards"}.get(next(iter(ways)), "") if len(ways) == 1 and not narrow else ""
    words = f"arc length{begins[origin]}{way} [{units.length}]" if origin else f"$x$ [{units.length}]"
    axes.set_xlabel(style.wrapped(words, 27 if narrow else 50))
    axes.set_ylabel(f"{'traction' if rubs else 'pressure'} [{units.stress}]")
    if rubs:
        colour = style.curve(min(seen))["color"] if len(seen) == 1 else style.BLACK
        axes.plot([], [], label="shear", linewidth=0.9, color=colour, **SHEAR)
        above: style.Look = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "ncols": 2}
        under: style.Look = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "borderaxespad": 7, "ncols": 2}
        if narrow and len(seen) > 1:
            style.legend_outside(style.figure_of(axes), "lower right", *zone_legend(axes), fontsize=7, ncols=3)
        else:
            handles, names = zone_legend(axes)
            legend = axes.legend(handles, names, fontsize=7, **(under if narrow else above))
            # on a slide there is room below a narrow panel, which is not to be taken from the other ones
            legend.set_in_layout(not narrow)
        axes.set_anchor("N" if narrow else "C")
    elif axes.get_legend_handles_labels()[0]:
        below, above = (
            {"loc": "upper center", "bbox_to_anchor": (0.5, -0.6)},
            {"loc": "lower right", "bbox_to_anchor": (1, 1)},
        )
        axes.legend(**(below if narrow else above))
    if narrow:
        axes.set_box_aspect(0.8)
