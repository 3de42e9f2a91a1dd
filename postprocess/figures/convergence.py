"""residual against Newton step, a curve for each of one or more runs, adaptations marked"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from postprocess import style
from postprocess.results import ResultsError, Run, is_number

RUNS = (1, None)


def draw(runs: list[Run], units: style.Units) -> Figure:
    """One curve per run, interrupted where the next model or load step begins; the last step before is a full marker.

    A residual of exactly zero has no place on a logarithmic axis: it is drawn below all others, pointing down.
    """
    for run in runs:
        if len(run.history["newton"]) == 0:
            raise ResultsError(run.path / "history.csv", "has no Newton steps to draw")
    positive = np.concatenate([run.history["residual"] for run in runs])
    positive = positive[positive > 0]
    floor = 10 ** np.floor(np.log10(positive.min()) - 0.5) if len(positive) else 1e-16

    figure = Figure(figsize=(style.COLUMN, 0.8 * style.COLUMN + 0.16 * len(runs)), layout="constrained")
    axes = figure.subplots()
    for index, (run, label) in enumerate(zip(runs, style.labels(runs), strict=True)):
        draw_curve(axes, run, index, f"{label}: {style.cost_text(run, 'step')}", floor)
    draw_tolerances(axes, runs)
    if len(runs) == 1:
        mark_adaptations(axes, runs[0])
    axes.set_xlabel("cumulative Newton step [–]")
    axes.set_ylabel("relative residual [–]")
    style.set_log(axes, "y", 8)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_xlim(0, max(run.history["newton"][-1] for run in runs) + 0.5)
    style.legend_outside(figure, "upper center", *axes.get_legend_handles_labels(), labelspacing=0.3)
    style.name_elements(figure, runs)
    return figure


def draw_curve(axes: Axes, run: Run, index: int, label: str, floor: float) -> None:
    """The residuals of one run; hollow markers, a full one at the last step of each adaptation."""
    history = run.history
    look = style.curve(index)
    newton = history["newton"]
    residual = np.maximum(history["residual"], floor)
    starts = np.flatnonzero(np.diff(history["adaptation"]) + np.diff(history["step"])) + 1
    many = len(newton) > 60
    hollow: style.Look = {"markerfacecolor": "white", "markeredgewidth": 0.8, "markersize": 2.2 if many else 4}
    for piece in np.split(np.arange(len(newton)), starts):
        axes.plot(newton[piece], residual[piece], label=label, **look, **hollow, zorder=3)
        axes.plot(newton[piece[-1]], residual[piece[-1]], **look, markersize=hollow["markersize"], zorder=4)
        label = "_"
    for start in starts:
        pair = [start - 1, start]
        axes.plot(newton[pair], residual[pair], color=look["color"], linewidth=0.6, linestyle=":", zorder=2)
    exact = history["residual"] == 0
    if exact.any():
        axes.plot(newton[exact], residual[exact], "v", color=look["color"], markersize=6, zorder=5)
        for place in newton[exact]:
            axes.annotate(
                "0", (place, floor), xytext=(6, -2), textcoords="offset points", fontsize=8, color=look["color"]
            )


def draw_tolerances(axes: Axes, runs: list[Run]) -> None:
    """A dashed line at each tolerance that the runs were given."""
    tolerances = {run.summary["parameters"].get("tol") for run in runs}
    for tolerance in sorted(value for value in tolerances if is_number(value)):
        dashes: style.Look = {"color": style.GREY, "linewidth": 0.8, "linestyle": (0, (4, 2)), "zorder": 1}
        axes.axhline(tolerance, label=f"tolerance ${style.number(tolerance)}$", **dashes)


def mark_adaptations(axes: Axes, run: Run) -> None:
    """A vertical line where each model begins, and the name of its threshold."""
    history = run.history
    numbers, first = np.unique(history["adaptation"], return_index=True)
    if len(numbers) == 1:
        return
    for order, row in enumerate(first):
        begin = history["newton"][row] - 0.5
        if order > 0:
            axes.axvline(begin, color=style.GREY, linewidth=0.6, linestyle=":", zorder=1)
        if order not in style.labelled_indices(len(numbers)):
            continue
        axes.annotate(
            f"$T^{{{order}}}$",
            (begin, 1),
            xycoords=("data", "axes fraction"),
            xytext=(2, 0),
            textcoords="offset points",
            va="bottom",
            fontsize=8,
            color=style.GREY,
        )
