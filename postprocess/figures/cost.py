"""error of the force against run time, a curve a method, a point a mesh or tolerance (runs with -reference)"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.results import ResultsError, Run

RUNS = (2, None)

FLOOR = 1e-13  # an error of exactly 0 has no place on a logarithmic axis


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Left, over the CPU seconds from assembly to displacement; right, over factorisations, which no machine changes.

    Dashed, where a contact solution would cost as much as one linear elastic solve of the same mesh.
    """
    figure = Figure(figsize=(style.PAGE, 0.42 * style.PAGE), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
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
        right.plot([run.summary["factorisations"] for run in group], error, **look)
    for order in sorted({run.summary["order"] for run in runs}):
        same = [run for run in runs if run.summary["order"] == order]
        meshes = sorted({run.summary["h"] for run in same})
        at = [[run for run in same if run.summary["h"] == h] for h in meshes]
        if len(meshes) > 1:
            linear = [np.median([seconds(run) / run.summary["costRatio"] for run in group]) for group in at]
            least = [max(min(force_error(run) for run in group), FLOOR) for group in at]
            left.plot(linear, least, color=style.GREY, linewidth=0.9, linestyle=(0, (4, 1.5)), zorder=1)
    left.plot([], [], color=style.GREY, linewidth=0.9, linestyle=(0, (4, 1.5)), label="one linear elastic solve")
    for axes, what in ((left, "CPU seconds"), (right, "factorisations")):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel(what)
        axes.grid(color="0.9", linewidth=0.5)
    left.set_ylabel("relative error of the force")
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    style.name_elements(figure, runs)
    return figure


def force_error(run: Run) -> float:
    """The force's relative error against the run's own -reference."""
    return abs(run.summary["force"] / run.parameter("reference") - 1)


def seconds(run: Run) -> float:
    """CPU seconds from assembly to displacement, without meshing and output."""
    parts = run.summary["seconds"]
    return sum(parts[name] for name in ("assembly", "factorisation", "contact"))
