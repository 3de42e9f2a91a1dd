"""error of the overlap at every Newton step, and its ratio from step to step (runs with -states 1)"""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from postprocess import style
from postprocess.results import ResultsError, Run, is_number

RUNS = (1, 7)

FLOOR = 1e-12  # of the solution: below it an error is rounding


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Left, |s - s*| over s*, a curve a run; right, each error over the one before, and 1 - 1/m of a power law, dashed.

    s is the overlap of the asperities at the point that overlaps most, s* that after the run's last step.
    """
    figure = Figure(figsize=(style.PAGE, 0.42 * style.PAGE), layout="constrained")
    left, right = figure.subplots(1, 2)
    for index, (run, label) in enumerate(zip(runs, style.labels(runs), strict=True)):
        error = errors(run)
        look = style.curve(index) | {"markersize": 3, "linewidth": 0.8, "markerfacecolor": "white"}
        left.plot(np.arange(len(error)), error, label=f"{label}: {style.cost_text(run, 'step')}", **look)
        ratio = error[1:] / error[:-1]
        right.plot(1 + np.arange(len(ratio)), ratio, **look)
        m = run.summary["parameters"].get("m")
        if run.summary["parameters"].get("law") == "power" and is_number(m):
            right.axhline(1 - 1 / m, color=look["color"], linewidth=0.8, linestyle=(0, (4, 2)), zorder=1)
            text: style.Look = {"xytext": (0, 2), "textcoords": "offset points", "ha": "right", "fontsize": 8}
            right.annotate(
                f"$1 - 1/m$, $m = {style.number(m)}$", (1, 1 - 1 / m), xycoords=("axes fraction", "data"), **text
            )
    style.set_log(left, "y")
    left.set_ylabel("relative error of the overlap $s$ [–]")
    right.set_ylim(0, 1.05)
    right.set_ylabel("error over the error before [–]")
    for axes in (left, right):
        axes.set_xlabel("Newton step [–]")
        axes.set_xlim(0, None)
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    right.set_xlim(0, 1.3 * right.get_xlim()[1])  # room for the names of the dashed lines
    style.legend_outside(figure, "upper center", *left.get_legend_handles_labels(), ncols=3)
    style.name_elements(figure, runs)
    return figure


def errors(run: Run) -> np.ndarray:
    """(steps,) relative errors before the first Newton step and after each, up to the first that is rounding."""
    s = run.steps.s[:, np.argmax(run.steps.s[-1])]
    if len(s) < 3 or not s[-1] > 0:
        raise ResultsError(run.path / "steps.csv", "no law in contact whose error could be followed over two steps")
    error = np.abs(s / s[-1] - 1)
    rounding = np.flatnonzero(error <= FLOOR)
    return error[: rounding[0]]
