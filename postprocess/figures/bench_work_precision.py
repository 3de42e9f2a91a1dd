"""error of the iteration on one mesh against seconds, factorisations and back-substitutions (results/bench)"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import (
    METHODS,
    NAMES,
    Campaign,
    contact_seconds,
    draw_failures,
    is_converged,
    method,
    method_look,
    name_meshes,
    number,
    numbers,
    read_campaign,
    select,
)

RUNS = (1, 1)
READ = read_campaign

FLOOR = 1e-13  # below, an error is the reference's own
MEASURES = {"seconds": "CPU time [s]", "factorisations": "factorisations [–]", "backsolves": "back-substitutions [–]"}
COLUMNS = "status order h method T0 kappa m tol pressureError seconds_assembly seconds_factorisation seconds_contact"


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """A column per law, a row per measure of work; a curve per method, a point per tolerance."""
    rows = runs[0].rows("work_precision", f"{COLUMNS} factorisations backsolves")
    laws = list(dict.fromkeys((number(row, "kappa"), number(row, "m")) for row in rows))
    present = [name for name in METHODS if any(method(row) == name for row in rows)]
    figure = Figure(figsize=(style.PAGE, 0.3 * style.PAGE * len(MEASURES)), layout="constrained")
    grid = figure.subplots(len(MEASURES), len(laws), sharex="row", sharey=True, squeeze=False)
    for column, (kappa, m) in enumerate(laws):
        for line, (axes, (measure, label)) in enumerate(zip(grid[:, column], MEASURES.items(), strict=True)):
            for name in present:
                draw_curve(axes, [row for row in select(rows, kappa=kappa, m=m) if method(row) == name], name, measure)
            axes.set_xlabel(label)
            axes.set_title(style.panel(len(laws) * line + column), loc="left")
            axes.grid(color="0.9", linewidth=0.5)
            style.set_log(axes, "xy")
        grid[0, column].set_title(rf"$\kappa = {style.number(kappa)}$, $m = {style.number(m)}$")
    for axes in grid[:, 0]:
        axes.set_ylabel("relative error of $p$ [–]")
    for name in present:
        grid[0, 0].plot([], [], **method_look(name), label=NAMES[name])
    if not all(map(is_converged, rows)):
        grid[0, 0].plot([], [], "x", color=style.GREY, label="failed")
    style.legend_outside(figure, "upper center", ncols=4)
    name_meshes(figure, rows)
    return figure


def draw_curve(axes: Axes, rows: list[dict], name: str, measure: str) -> None:
    rows = sorted(rows, key=lambda row: -number(row, "tol"))
    done = [row for row in rows if is_converged(row)]
    error = np.maximum(numbers(done, "pressureError"), FLOOR)
    axes.plot(work(done, measure), error, **method_look(name), linewidth=1, markersize=3.5)
    draw_failures(axes, work([row for row in rows if not is_converged(row)], measure), method_look(name)["color"])


def work(rows: list[dict], measure: str) -> np.ndarray:
    return np.array([contact_seconds(row) if measure == "seconds" else number(row, measure) for row in rows])
