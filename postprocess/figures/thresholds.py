"""threshold and overlap of one to three runs, model by model"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from postprocess import style
from postprocess.results import WALL, ResultsError, Run, Table

RUNS = (1, 3)

MOST = 4  # models of a run that are shown: the first ones and the last
CROWD = 40  # points beyond which their dots are drawn smaller
FAR_WALL = 30  # walls this many times beyond the greatest overlap need a logarithmic axis
OVERLAP: style.Look = {"color": style.VERMILION, "linestyle": (0, (4, 1.5)), "zorder": 5}


def draw(runs: list[Run], units: style.Units) -> Figure:
    """A column a run, a panel a model: its threshold T^N, and the overlap d^N that Newton's steps have found with it.

    Both are counted from d0, where asperities first touch. Dots are points where the wall carries: there d^N = T^N, and
    there the next threshold is higher.
    """
    columns = [shown(run) for run in runs]
    rows = max(map(len, columns))
    figure = Figure(figsize=(style.COLUMN, (0.32 + 0.3 * rows) * style.COLUMN), layout="constrained")
    grid = figure.subplots(rows, len(runs), sharex=True, sharey=True, squeeze=False)
    for panels, run, models in zip(grid.T, runs, columns, strict=True):
        for row, axes in enumerate(panels):
            if row < len(models):
                number, table = models[row]
                draw_model(axes, number, table)
                model = f"model {number + 1}: $T^{number}$"
                heading = title(run) if len(runs) < 3 else title(run).replace(", ", ",\n").replace(": ", ":\n")
                axes.set_title(f"{heading}\n{model}" if row == 0 else model, fontsize=8, pad=3)
            else:
                axes.set_visible(False)
        panels[len(models) - 1].tick_params(labelbottom=True)
        panels[len(models) - 1].set_xlabel(f"$x$ [{units.length}]")
    limits(grid, [table for models in columns for _, table in models])
    figure.supylabel(f"$T^N - d_0$, $d^N - d_0$ [{units.length}]", fontsize=9)
    handles = {line.get_label(): line for axes in grid.ravel() for line in axes.lines if line.get_label()[0] != "_"}
    style.legend_outside(figure, "upper center", handles.values(), handles.keys(), ncols=3, columnspacing=1.2)
    style.name_elements(figure, runs)
    return figure


def shown(run: Run) -> list[tuple[int, Table]]:
    """(N, table) of the models that were solved under the full load: all of a few, else the first ones and the last."""
    history, tables = run.history, run.adaptations
    if len(history["step"]):
        last = history["step"] == history["step"][-1]
        tables = tables[-len(np.unique(history["adaptation"][last])) :]
    if any(not np.array_equal(table["x"], tables[0]["x"]) for table in tables):
        raise ResultsError(run.path / "adaptations.csv", "the points differ from adaptation to adaptation")
    models = list(enumerate(tables))
    return models if len(models) <= MOST else [*models[: MOST - 1], models[-1]]


def draw_model(axes: Axes, number: int, table: Table) -> None:
    """One model: the threshold where it has one, the points where its wall carries, the overlap."""
    x, wall = table["x"], table["status"] == WALL
    if np.isfinite(table["tau"]).all():
        axes.plot(x, table["tau"], color=style.BLUE, label="threshold $T^N$", zorder=3)
        size = 5 if np.count_nonzero(wall) < CROWD else 2.5
        dots: style.Look = {"linestyle": "none", "marker": ".", "markersize": size, "color": style.BLUE, "zorder": 6}
        axes.plot(x[wall], table["tau"][wall], label="the wall carries" if wall.any() else "_", **dots)
    axes.plot(x, table["s"], label="overlap $d^N$", **OVERLAP)
    axes.axhline(0, color=style.GREY, linewidth=0.6)


def limits(grid: np.ndarray, tables: list) -> None:
    """Axes that all panels share: where there is an overlap or a wall, and a logarithmic height for far walls."""
    x = tables[0]["x"]
    reached = max(table["s"].max() for table in tables)
    walls = np.concatenate([table["tau"][np.isfinite(table["tau"])] for table in tables])
    top = max(walls.max(initial=0), reached)
    if top <= 0:
        raise ResultsError("adaptations.csv", "no overlap beyond d0 and no wall beyond it: nothing to draw")
    touched = [table["x"][(table["s"] > 0) | (table["status"] == WALL)] for table in tables]
    shown = np.concatenate(touched) if any(map(len, touched)) else x
    margin = 0.15 * np.ptp(shown) or 0.05 * np.ptp(x)
    grid[0, 0].set_xlim(max(shown.min() - margin, x.min()), min(shown.max() + margin, x.max()))
    if reached > 0 and top > FAR_WALL * reached:
        grid[0, 0].set_yscale("log")
        grid[0, 0].set_ylim(reached * 1e-2, top * 3)
    else:
        grid[0, 0].set_ylim(-0.15 * top, 1.12 * top)


def title(run: Run) -> str:
    """The method, and whether its models have a wall."""
    wall = any(np.isfinite(table["tau"]).any() for table in run.adaptations)
    return style.method(run) if wall else f"{style.method(run)}: no wall"
