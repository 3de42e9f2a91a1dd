"""true error, estimate and time: runs that make their own meshes beside meshes of a user's trial (results/bench)"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from postprocess import style
from postprocess.campaign import (
    Campaign,
    Cells,
    Row,
    contact_seconds,
    is_converged,
    name_meshes,
    number,
    read_campaign,
    select,
)
from postprocess.results import ResultsError

RUNS = (1, 1)
READ = read_campaign

SERIES = {"adaptive": "own meshes (-accuracy)", "graded": "graded by hand", "uniform": "uniform"}
LOOKS: dict[str, style.Look] = {
    "adaptive": {"color": style.BLUE, "marker": "o"},
    "graded": {"color": style.VERMILION, "marker": "s"},
    "uniform": {"color": style.GREEN, "marker": "^"},
}
PROBLEMS: dict[str, Cells] = {
    r"disc, $\kappa = 10^3$": {"scene": "disc-on-block", "kappa": 1e3},
    r"disc, $\kappa = 10^9$": {"scene": "disc-on-block", "kappa": 1e9},
    r"disc, $\kappa = 10^{12}$": {"scene": "disc-on-block", "kappa": 1e12},
    "sphere": {"scene": "sphere-on-block"},
    "crossed cylinders": {"scene": "parts-3d"},
}
COLUMNS = "name status scene order h kappa m ndof forceError said asked seconds"
PEERS = "script flags status scene kappa m forceError seconds_assembly seconds_factorisation seconds_contact"


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """A panel per problem: of each run the true error, filled, and what it said, open; NGSolve's best as a line."""
    rows = [row for row in runs[0].rows("accuracy", COLUMNS) if is_converged(row) and number(row, "forceError") > 0]
    if not rows:
        raise ResultsError(runs[0].path / "accuracy.csv", "no run of it converged")
    peers = runs[0].rows("peers", PEERS) if (runs[0].path / "peers.csv").exists() else []
    peers = [row for row in peers if is_converged(row) and row["script"].endswith(".py")]
    figure = Figure(figsize=(style.COLUMN, 1.3 * style.COLUMN), layout="constrained")
    grid = figure.subplots(3, 2)
    for index, (axes, (title, wanted)) in enumerate(zip(grid.flat, PROBLEMS.items(), strict=False)):
        for name in SERIES:
            draw_series(axes, select(rows, name=name, **wanted), LOOKS[name])
        draw_peers(axes, select(peers, m=3.0, **wanted))
        style.set_log(axes, "xy", 5)
        axes.set_title(f"{style.panel(index)} {title}", loc="left", fontsize=8, pad=3)
        axes.grid(color="0.92", linewidth=0.4)
        axes.tick_params(labelsize=7)
    for axes in (grid[2, 0], grid[1, 1]):
        axes.set_xlabel("CPU time [s]", fontsize=8, labelpad=1)
    for axes in grid[:, 0]:
        axes.set_ylabel("relative error [–]", fontsize=8, labelpad=1)
    draw_legend(grid[2, 1], bool(peers))
    name_meshes(figure, rows)
    return figure


def draw_series(axes: Axes, rows: list[Row], looks: dict) -> None:
    """Of each run a stroke from the true error to what was said; the true ones joined from the coarse to the fine."""
    for row in rows:
        x, true, estimate = (number(row, name) for name in ("seconds", "forceError", "said"))
        axes.plot([x, x], [true, estimate], color=looks["color"], linewidth=0.7)
        axes.plot(x, estimate, **looks, markersize=3.2, markerfacecolor="white", markeredgewidth=0.7, zorder=3)
    rows = sorted(rows, key=lambda row: (-number(row, "asked") if row["asked"] else 0, number(row, "ndof")))
    points = [(number(row, "seconds"), number(row, "forceError")) for row in rows]
    if points:
        axes.plot(*zip(*points, strict=True), **looks, markersize=3.2, linewidth=0.9, alpha=0.9, zorder=2)


def draw_peers(axes: Axes, rows: list[Row]) -> None:
    """The best of the other code: what no run of it beats, medians over the rounds."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(row["flags"], []).append(row)
    points = [(float(np.median(list(map(contact_seconds, g)))), number(g[0], "forceError")) for g in groups.values()]
    front = [point for point in sorted(points) if all(point[1] < e for s, e in points if s < point[0])]
    if front:
        axes.plot(*zip(*front, strict=True), color=style.GREY, linewidth=0.9, linestyle="--", zorder=1)


def draw_legend(axes: Axes, peers: bool) -> None:
    """In the place of a sixth panel."""
    axes.axis("off")
    handles = [Line2D([], [], **LOOKS[name], markersize=3.2, label=words) for name, words in SERIES.items()]
    dark: style.Look = {"color": "0.25", "marker": "o", "markersize": 3.2, "linestyle": ""}
    handles.append(Line2D([], [], **dark, label="true error"))
    handles.append(Line2D([], [], **dark, markerfacecolor="white", label="what the run says"))
    if peers:
        handles.append(Line2D([], [], color=style.GREY, linestyle="--", linewidth=0.9, label="NGSolve's best"))
    axes.legend(handles=handles, loc="center", fontsize=7.5, handlelength=1.6)
