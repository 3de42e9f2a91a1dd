"""deformed bodies at successive states of one run (made with -states 1)"""

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation

from postprocess import style
from postprocess.results import ResultsError, Run

RUNS = (1, 1)

BLOCK, DISC = 1, 2  # regions of the mesh
FILL = {BLOCK: "#DCE9F3", DISC: "#E9E6E1"}
LINE = {BLOCK: style.BLUE, DISC: "#6E675F"}


@dataclass(frozen=True)
class Bodies:
    """The boundary lines needed to see who is in whom: edges (n, 2) vertex pairs of each region."""

    block: np.ndarray
    disc: np.ndarray | None


def draw(runs: list[Run], units: style.Units) -> Figure:
    """A column per state: the whole bodies, the contact zone, all at true scale; below, overlap and threshold over x.

    Where the bodies overlap, the overlap is filled. A rigid disc without a mesh is drawn as the half disc that it is.
    """
    (run,) = runs
    chosen = choose_states(run)
    mesh = run.mesh
    edges = Bodies(
        boundary(mesh.triangles[mesh.region == BLOCK]),
        boundary(mesh.triangles[mesh.region == DISC]) if np.any(mesh.region == DISC) else None,
    )
    if len(edges.block) == 0:
        raise ResultsError(run.path / "triangles.csv", "has no triangle of region 1, the block")
    whole, close = axes_limits(run)

    figure = Figure(figsize=(style.PAGE, 0.64 * style.PAGE), layout="constrained")
    grid = figure.subplots(3, len(chosen), sharex="row", squeeze=False, height_ratios=[1, 0.85, 0.85])
    for column, (state, words) in enumerate(chosen):
        for axes, window in zip(grid[:2, column], (whole, close), strict=True):
            draw_state(axes, run, edges, state, line_weight(run, window, len(chosen)))
            axes.set_xlim(window[0], window[1])
            axes.set_ylim(window[2], window[3])
            axes.set_aspect("equal")
        grid[0, column].set_title(f"{style.panel(column)} {words}", loc="left", linespacing=1.0, fontsize=8)
        corner, size = close[::2], np.subtract(close[1::2], close[::2])
        grid[0, column].add_patch(Rectangle(corner, *size, fill=False, linewidth=0.6, zorder=5))
        grid[1, column].set_title(overlap_caption(run, state), fontsize=8)
        draw_overlap(grid[2, column], run, state)
        grid[2, column].set_xlim(close[:2])
        grid[2, column].set_xlabel(f"$x$ [{units.length}]")
    for row, label in zip(grid, (f"$y$ [{units.length}]",) * 2 + (f"overlap [{units.length}]",), strict=True):
        row[0].set_ylabel(label)
        row[0].xaxis.set_major_locator(MaxNLocator(nbins=5, integer=True))
        row[0].yaxis.set_major_locator(MaxNLocator(nbins=4, integer=True))
    low, high = run.parameter("d0"), max(table["overlap"].max() for table in run.adaptations)
    near = 1.4 * low, high + 0.4 * (high - low)
    for place, row in enumerate(grid):
        for axes in row[1:] if place < 2 else ():
            axes.sharey(row[0])
            axes.tick_params(labelleft=False)
    for axes in grid[2]:
        top = axes.lines[0].get_ydata().max()
        far = not low < top < 3 * high  # the prescribed motion alone, apart or overlapping
        axes.set_ylim(*(run.parameter("u0") * np.array([-0.4, 1]) if far else near))
        if far:  # what the other panels of the row show of its scale
            axes.axhspan(*near, color="0.9", linewidth=0, zorder=0)
        axes.yaxis.set_major_locator(MaxNLocator(nbins=4))
        axes.yaxis.set_major_formatter(two_decimals)  # as wide in all panels
    handles, names = grid[2, -1].get_legend_handles_labels()
    band = Rectangle((0, 0), 1, 1, color="0.9", linewidth=0)
    style.legend_outside(figure, "lower center", [*handles, band], [*names, "range of the other panels"], ncols=4)
    figure.align_ylabels()
    style.name_elements(figure, runs)
    return figure


def two_decimals(value: float, _: object = None) -> str:
    return f"{value:.2f}".replace("-", "\N{MINUS SIGN}")


def draw_overlap(axes: Axes, run: Run, state: int) -> None:
    """The overlap d over x and the model's threshold T; before the first step that of the prescribed motion alone."""
    newton, history = run.states.newton[state], run.history
    until = history["newton"] <= max(newton, 1)
    number = len(np.unique(np.stack([history["step"], history["adaptation"]])[:, until], axis=1).T)
    table = run.adaptations[number - 1]
    x, radius = table["x"], run.parameter("R")
    overlap = table["overlap"]
    if newton < history["newton"][until][-1] or newton == 0:
        drop = radius - np.sqrt(np.maximum(radius**2 - x**2, 0))
        overlap = load_share(run, state) * run.parameter("u0") - run.parameter("gap") - drop
    axes.plot(x, overlap, color=style.VERMILION, label="$d$, overlap")
    if np.isfinite(table["threshold"]).all():
        axes.plot(x, table["threshold"], color=style.BLUE, linestyle=(0, (4, 1.5)), label="$T$, threshold")
    axes.axhline(run.parameter("d0"), color=style.GREY, linewidth=0.6, label="$d_0$, first touch")


def choose_states(run: Run) -> list[tuple[int, str]]:
    """The states to show, each once, and what to call them: initial, interpenetrating, first model solved, converged.

    The interpenetrating state is the prescribed motion alone where the run saved it, else the first linear step.
    """
    states = run.states
    last = len(states.newton) - 1
    if states.newton[last] == 0:
        raise ResultsError(run.path / "states.csv", "has no state after a Newton step")
    names = {0: "initial state", 1: "first linear step" if states.newton[1] else "prescribed motion"}
    first_model = np.flatnonzero(states.newton)[0]
    later = np.flatnonzero(states.adaptation[first_model:] != states.adaptation[first_model])
    if len(later):
        names[int(first_model + later[0] - 1)] = "first model solved"
    names[last] = "converged" if run.summary["converged"] else "last step, not converged"
    return [(state, f"{name}\n{state_caption(run, state)}") for state, name in sorted(names.items())]


def state_caption(run: Run, state: int) -> str:
    """Where in the scheme a state stands."""
    states = run.states
    if state == 0:
        return "undeformed"
    if states.newton[state] == 0:
        return "before Newton step 1"
    return f"adaptation {states.adaptation[state]}, step {states.newton[state]}"


def line_weight(run: Run, window: tuple, columns: int) -> float:
    """A width for mesh lines [points] at which the elements of the window can still be told from each other."""
    states, triangles = run.states, run.mesh.triangles
    x, y = states.x[triangles], states.y[triangles]
    inside = (x.mean(axis=1) > window[0]) & (x.mean(axis=1) < window[1]) & (y.mean(axis=1) > window[2])
    sizes = np.hypot(x[:, 0] - x[:, 1], y[:, 0] - y[:, 1])[inside & (y.mean(axis=1) < window[3])]
    if len(sizes) == 0:
        return 0.3
    scale = 0.8 * 72 * style.PAGE / columns / (window[1] - window[0])  # points on paper per unit of length
    return float(np.clip(0.08 * scale * np.median(sizes), 0.04, 0.3))


def draw_state(axes: Axes, run: Run, edges: Bodies, state: int, weight: float) -> None:
    """Both bodies in one state: fills, the overlap on top of them, mesh lines of the given weight [points] last."""
    states, mesh = run.states, run.mesh
    x, y = states.x + states.ux[state], states.y + states.uy[state]
    for region in np.unique(mesh.region):
        triangles = mesh.triangles[mesh.region == region]
        colour = FILL.get(int(region), FILL[BLOCK])
        corners = np.stack([x[triangles], y[triangles]], axis=-1)
        axes.add_collection(PolyCollection(list(corners), facecolor=colour, edgecolor=colour, linewidth=0.1, zorder=1))
        lines = Triangulation(x, y, triangles).edges
        segments = np.stack([x[lines], y[lines]], axis=-1)
        colour = LINE.get(int(region), LINE[BLOCK])
        axes.add_collection(LineCollection(list(segments), color=colour, linewidth=weight, zorder=3))
    at = np.linspace(x[edges.block].min(), x[edges.block].max(), 2001)
    surface = envelope(at, x, y, edges.block, np.fmax)
    if edges.disc is not None:
        obstacle = envelope(at, x, y, edges.disc, np.fmin)
        draw_boundary(axes, x, y, edges.disc, LINE[DISC])
    else:
        outline, radius = half_disc(run, state), run.parameter("R")
        axes.add_patch(Polygon(outline, facecolor=FILL[DISC], edgecolor=LINE[DISC], linewidth=0.6, zorder=1.5))
        with np.errstate(invalid="ignore"):
            obstacle = outline[0, 1] - np.sqrt(radius**2 - at**2)
    draw_boundary(axes, x, y, edges.block, LINE[BLOCK])
    axes.fill_between(at, obstacle, surface, where=surface > obstacle, color=style.ORANGE, linewidth=0, zorder=2)


def draw_boundary(axes: Axes, x: np.ndarray, y: np.ndarray, edges: np.ndarray, colour: str) -> None:
    """The outline of a body."""
    segments = np.stack([x[edges], y[edges]], axis=-1)
    axes.add_collection(LineCollection(list(segments), color=colour, linewidth=0.7, capstyle="round", zorder=4))


def boundary(triangles: np.ndarray) -> np.ndarray:
    """The edges (n, 2) that belong to one triangle only."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    edges, counts = np.unique(edges, axis=0, return_counts=True)
    return edges[counts == 1]


def envelope(at: np.ndarray, x: np.ndarray, y: np.ndarray, edges: np.ndarray, choose: np.ufunc) -> np.ndarray:
    """The greatest (np.fmax) or least (np.fmin) height of a boundary over each abscissa; NaN beside the body."""
    height = np.full(len(at), np.nan)
    for start, end in edges:
        left, right = sorted((start, end), key=lambda vertex: x[vertex])
        begin, stop = np.searchsorted(at, [x[left], x[right]], side="left")
        if stop > begin:
            share = (at[begin:stop] - x[left]) / (x[right] - x[left])
            crossing = y[left] + share * (y[right] - y[left])
            height[begin:stop] = choose(height[begin:stop], crossing)
    return height


def half_disc(run: Run, state: int) -> np.ndarray:
    """The outline (n, 2) of the rigid half disc above the block, first point at its centre's height."""
    radius, depth = run.parameter("R"), run.states.y.max()
    lowest = depth + run.parameter("gap") - load_share(run, state) * run.parameter("u0")
    angle = np.linspace(np.pi, 2 * np.pi, 361)
    return np.column_stack([radius * np.cos(angle), lowest + radius + radius * np.sin(angle)])


def load_share(run: Run, state: int) -> float:
    """The part of the prescribed displacement applied in a state: 0 at the start, 1 without load steps."""
    if state == 0 or run.states.newton[state] == 0:
        return float(state > 0)
    history = run.history
    step = history["step"][history["newton"] == run.states.newton[state]]
    return float(step[0] / history["step"].max()) if len(step) else 1.0


def overlap_caption(run: Run, state: int) -> str:
    """The greatest overlap in a state, or the gap before any contact."""
    if state == 0:
        overlap = -run.parameter("gap")
    elif run.states.newton[state] == 0:
        overlap = run.parameter("u0") - run.parameter("gap")
    else:
        history = run.history
        rows = np.flatnonzero(history["newton"] == run.states.newton[state])
        if len(rows) == 0:
            raise ResultsError(run.path / "states.csv", f"has a Newton step {run.states.newton[state]} of no row")
        overlap = history["overlapMax"][rows[0]]
    return f"greatest overlap {overlap:.3g}" if overlap >= 0 else f"gap {-overlap:.3g}"


def axes_limits(run: Run) -> tuple[tuple, tuple]:
    """The axes' limits (left, right, bottom, top) for the whole bodies and for the contact zone."""
    states = run.states
    radius = run.parameter("R")
    depth = states.y[run.mesh.triangles[run.mesh.region == BLOCK]].max()
    left, right = min(states.x.min(), -radius), max(states.x.max(), radius)
    top = max(states.y.max(), depth + run.parameter("gap") + radius)
    margin = 0.02 * (right - left)
    whole = (left - margin, right + margin, states.y.min() - margin, top + margin)

    contact = run.contact
    touched = np.abs(contact["x"][contact["pressure"] > 0])
    reach = 1.35 * touched.max() if len(touched) else 0.6 * radius
    height = 1.5 * reach
    close = (-reach, reach, depth - 0.68 * height, depth + 0.32 * height)
    return whole, close
