"""threshold field of one run from adaptation to adaptation"""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from postprocess import style
from postprocess.results import WALL, ResultsError, Run

RUNS = (1, 1)

CROWD = 40  # points beyond which their dots are drawn smaller
FAR_WALL = 30  # walls this many times beyond the greatest penetration of the layer need a logarithmic axis


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Above, T^N - d0 of every model and d - d0 at convergence; below, how much each update moved the wall.

    Full dots are the points where the wall was active. Both panels are counted from d0, where asperities first touch.
    """
    (run,) = runs
    tables = last_load_step(run)
    x = tables[0]["x"]
    for table in tables:
        if not np.array_equal(table["x"], x):
            raise ResultsError(run.path / "adaptations.csv", "the points differ from adaptation to adaptation")
    heights = np.array([table["tau"] for table in tables])
    walls = np.array([table["status"] == WALL for table in tables])
    penetration = run.contact["s"]
    moves = np.diff(heights, axis=0) if np.isfinite(heights).all() else np.zeros((0, len(x)))
    moved = bool((moves > 0).any())

    rows = 2 if moved else 1
    size = (style.COLUMN, (1.3 if moved else 0.85) * style.COLUMN)
    figure = Figure(figsize=size, layout="constrained")
    panels = figure.subplots(rows, 1, sharex=True, squeeze=False, height_ratios=[1.6, 1][:rows])[:, 0]
    colours = style.sequence(len(tables))
    draw_heights(panels[0], run, heights, walls, penetration, colours, units)
    if moved:
        draw_moves(panels[1], x, moves, colours, units)
    panels[-1].set_xlabel(f"$x$ [{units.length}]")
    panels[-1].set_xlim(*interval(x, (penetration > 0) | walls.any(axis=0)))
    figure.align_ylabels()
    return figure


def draw_heights(axes, run: Run, heights, walls, penetration, colours, units: style.Units) -> None:
    """The threshold of each model, (adaptations, points), and the overlap reached, both measured from d0."""
    x = run.contact["x"]
    finite = np.isfinite(heights)
    size = 4 if np.count_nonzero(walls.any(axis=0)) < CROWD else 2.5
    for number, colour in enumerate(colours):
        if not finite[number].all():
            continue
        name = f"$T^{{{number}}}$" if number in style.named(len(colours)) else None
        axes.plot(x, heights[number], color=colour, label=name, zorder=3)
        active = walls[number]
        axes.plot(x[active], heights[number, active], ".", color=colour, markersize=size, zorder=4)
    axes.plot(x, penetration, color=style.VERMILION, linestyle=(0, (4, 1.5)), zorder=5)
    top = max(heights[finite].max(initial=0), penetration.max())
    if top <= 0:
        raise ResultsError(run.path / "contact.csv", "no overlap beyond d0 and no wall beyond it: nothing to draw")
    reached = penetration.max()
    if reached > 0 and top > FAR_WALL * reached:
        axes.set_yscale("log")
        axes.set_ylim(reached * 1e-2, top * 3)
    else:
        axes.axhline(0, color=style.GREY, linewidth=0.8)
        axes.annotate(
            "first touch of asperities, $d = d_0$",
            (0.5, 0),
            xycoords=("axes fraction", "data"),
            xytext=(0, 3.5),
            textcoords="offset points",
            ha="center",
            fontsize=8,
            color=style.GREY,
        )
        axes.set_ylim(-0.12 * top, 1.08 * top)
    axes.set_ylabel(f"$T^N - d_0$ and $d - d_0$ [{units.length}]")
    draw_legends(axes, title(run), bool(walls.any()))


def draw_legends(axes, heading: str, any_wall: bool) -> None:
    """The thresholds' names above the axes; what the other marks mean below the arch that the curves form."""
    places = {"loc": "outside upper center", "ncols": 6, "borderaxespad": 0.2, "columnspacing": 1.0}
    if axes.get_legend_handles_labels()[0]:
        axes.figure.legend(**places, title=heading, title_fontsize=9)
    else:
        axes.figure.suptitle(heading, fontsize=9)
    marks = [Line2D([], [], color=style.VERMILION, linestyle=(0, (4, 1.5)), label="overlap $d$ at convergence")]
    if any_wall:
        marks.append(Line2D([], [], color=style.GREY, marker=".", label="wall active", linewidth=0, markersize=4))
    axes.legend(handles=marks, loc="center", bbox_to_anchor=(0.5, 0.42 if axes.get_yscale() == "linear" else 0.2))


def draw_moves(axes, x, moves, colours, units: style.Units) -> None:
    """T^{N+1} - T^N of each update, (updates, points), on a logarithmic axis, where it is positive."""
    for number, move in enumerate(moves):
        seen = np.where(move > 0, move, np.nan)
        size = 3 if np.count_nonzero(move > 0) < CROWD else 2
        axes.plot(x, seen, color=colours[number + 1], marker=".", markersize=size, linewidth=0.8)
    axes.set_ylabel(f"$T^{{N+1}} - T^N$ [{units.length}]")
    style.decades(axes, moves)


def last_load_step(run: Run) -> list:
    """The tables of the models that were solved under the full load."""
    history = run.history
    if len(history["step"]) == 0:
        return run.adaptations
    last = history["step"] == history["step"][-1]
    return run.adaptations[-len(np.unique(history["adaptation"][last])) :]


def title(run: Run) -> str:
    """The method and its count of models."""
    if not any(np.isfinite(table["tau"]).any() for table in run.adaptations):
        return f"{style.method(run)}: no wall, $T = \\infty$"
    return f"{style.method(run)}: {style.count(run.summary['adaptations'], 'adaptation')}"


def interval(x: np.ndarray, chosen: np.ndarray) -> tuple[float, float]:
    """The part of the surface worth showing: the chosen points and a margin on both sides."""
    if not chosen.any():
        return x.min(), x.max()
    left, right = x[chosen].min(), x[chosen].max()
    margin = 0.15 * (right - left) or 0.05 * np.ptp(x)
    return max(left - margin, x.min()), min(right + margin, x.max())
