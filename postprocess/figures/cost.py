"""error of the force against run time, a curve a method, a point a mesh or tolerance (runs with -reference)"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from postprocess import style
from postprocess.results import ResultsError, Run

RUNS = (2, None)

FLOOR = 1e-13  # an error of exactly 0 has no place on a logarithmic axis


def draw(runs: list[Run], units: style.Units) -> Figure:
    """(a) over CPU seconds from assembly to displacement, dotted over the seconds waited; (b) what no machine changes.

    That is a method's factorisations, the least to the most over its meshes; where all runs have as many, unknowns.
    Dashed, where a contact solution would cost as much as one linear elastic solve of the same mesh.
    """
    figure = Figure(figsize=(style.PAGE, 0.42 * style.PAGE), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=[1.25, 1])
    alike = len({run.summary["factorisations"] for run in runs}) == 1
    groups: dict = {}
    for run in runs:
        if not run.summary["converged"]:
            raise ResultsError(run.path / "summary.json", "the run did not converge: its error means nothing")
        groups.setdefault(f"{style.method(run)}, P{run.summary['order']}", []).append(run)
    for index, (label, group) in enumerate(groups.items()):
        group.sort(key=lambda run: (-run.summary["h"], -run.parameter("tol")))
        look = style.curve(index) | {"markersize": 4, "linewidth": 0.9, "markerfacecolor": "white"}
        error = np.maximum([force_error(run) for run in group], FLOOR)
        left.plot([seconds(run) for run in group], error, label=label, **look)
        waited = [run.summary["seconds"].get("waited", np.nan) for run in group]
        left.plot(waited, error, **look | {"alpha": 0.45, "linestyle": ":"})
        if alike:
            right.plot([run.summary["ndof"] for run in group], error, **look)
        else:
            draw_factorisations(right, index, [run.summary["factorisations"] for run in group], look["color"])
    for order in sorted({run.summary["order"] for run in runs}):
        same = [run for run in runs if run.summary["order"] == order]
        meshes = sorted({run.summary["h"] for run in same})
        at = [[run for run in same if run.summary["h"] == h] for h in meshes]
        if len(meshes) > 1:
            linear = [np.median([seconds(run) / run.summary["costRatio"] for run in group]) for group in at]
            least = [max(min(force_error(run) for run in group), FLOOR) for group in at]
            left.plot(linear, least, color=style.GREY, linewidth=0.9, linestyle=(0, (4, 1.5)), zorder=1)
    left.plot([], [], color=style.GREY, linewidth=0.9, linestyle=(0, (4, 1.5)), label="one linear elastic solve")
    left.plot([], [], color=style.GREY, linewidth=0.9, linestyle=":", label="waited, from start to results")
    for axes in (left, right):
        axes.grid(axis="x" if axes is right and not alike else "both", color="0.9", linewidth=0.5)
        axes.set_title(style.panel(int(axes is right)), loc="left")
    style.set_log(left, "xy")
    style.set_log(right, "x", 4)
    left.set_xlabel("CPU time from assembly to displacement [s];\ndotted: time waited [s]")
    left.set_ylabel("relative error of the force [–]")
    right.set_xlabel("unknowns [–]" if alike else "factorisations [–]")
    if alike:
        right.sharey(left)
        right.set_yscale("log")
        style.set_log(left, "y")
        right.tick_params(labelleft=False)
    else:
        right.set_yticks(range(len(groups)), list(groups))
        right.set_ylim(len(groups) - 0.4, -0.6)
        right.set_xlim(0.8, 4 * max(run.summary["factorisations"] for run in runs))
    style.legend_outside(figure, "upper center", *left.get_legend_handles_labels(), ncols=3)
    style.name_elements(figure, runs)
    return figure


def draw_factorisations(axes: Axes, place: int, counts: list[int], colour: str) -> None:
    """A bar from the least to the most, its numbers beside it."""
    least, most = min(counts), max(counts)
    axes.plot([least, most], [place, place], color=colour, linewidth=5, marker="o", markersize=5)
    words = f"{least}" if least == most else f"{least} to {most}"
    axes.annotate(words, (most, place), (7, -3), textcoords="offset points", fontsize=8)


def force_error(run: Run) -> float:
    """The force's relative error against the run's own -reference."""
    return abs(run.summary["force"] / run.parameter("reference") - 1)


def seconds(run: Run) -> float:
    """CPU seconds from assembly to displacement, without meshing and output."""
    parts = run.summary["seconds"]
    return sum(parts[name] for name in ("assembly", "factorisation", "contact"))
