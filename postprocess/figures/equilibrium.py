"""a confined block's state: where the law's curve and the block's line cross, one or more runs"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.laws import law_of
from postprocess.results import ResultsError, Run, read_table

RUNS = (1, 7)

SCENES = ("confined-block", "labs/1-law", "labs/2-newton", "labs/4-own-law")


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Left, pressure over overlap: the laws rise, the block's line falls, a dot a run. Right, over d - d0, logarithmic.

    The line is p = M/depth (u0 - gap - d), M = E (1 - nu)/((1 + nu)(1 - 2 nu)). The dots are computed, the curves are
    not; but a law that is made of data, or a scene's own, is drawn through the states of its load series, if any.
    """
    lines = {block_line(run) for run in runs}
    if len(lines) > 1:
        raise ResultsError(runs[1].path, "is of another block, approach or d0 than the first run")
    ((stiffness, end, d0),) = lines
    if end <= d0:
        raise ResultsError(runs[0].path, "the wall does not touch: nothing to draw")
    figure = Figure(figsize=(style.PAGE, 0.42 * style.PAGE), layout="constrained")
    left, right = figure.subplots(1, 2)
    hard = stiffness * (end - d0)
    s = np.geomspace(1e-4, 1, 600) * (end - d0)
    left.plot([d0, end], [hard, 0], color=style.BLACK, label="the block")
    right.plot(s, stiffness * (end - d0 - s), color=style.BLACK)
    for index, run in enumerate(runs):
        look = style.curve(index)
        overlap, pressure, reached = state(run)
        law = law_of(run)
        if run.summary["parameters"].get("law") == "signorini" or run.summary["method"] == "signorini":
            left.plot([d0, d0], [0, 1.2 * hard], color=look["color"], linestyle=(0, (4, 1.5)))
        elif law is not None:
            curve = law(s)
            left.plot([d0, *(d0 + s)], [0, *curve], color=look["color"], linewidth=0.9)
            right.plot(s, curve, color=look["color"], linewidth=0.9)
        elif (run.path / "series.csv").exists():
            rows = read_table(run.path / "series.csv", ["overlapMax", "pressureMax"])
            touched = rows["pressureMax"] > 0
            steps, carried = rows["overlapMax"][touched], rows["pressureMax"][touched]
            left.plot([d0, *steps], [0, *carried], color=look["color"], linewidth=0.9)
            right.plot(steps - d0, carried, color=look["color"], linewidth=0.9)
        dot: style.Look = {**look, "linestyle": "none", "markersize": 5, "zorder": 4}
        left.plot(overlap, pressure, label=style.law_text(run), clip_on=False, **dot)
        if reached >= s[0]:
            right.plot(reached, pressure, **dot)
    left.set_xlim(d0 - 0.05 * (end - d0), end)
    left.set_ylim(0, 1.2 * hard)
    left.set_xlabel(f"overlap $d$ [{units.length}]")
    left.set_ylabel(f"pressure $p$ [{units.stress}]")
    style.set_log(right, "x", ends=(s[0], s[-1]))
    style.set_log(right, "y", ends=(1e-3 * hard, 3 * hard))
    right.set_ylabel(f"pressure $p$ [{units.stress}]")
    right.set_xlabel(f"overlap of the asperities $s = d - d_0$ [{units.length}]")
    style.legend_outside(figure, "upper center", *left.get_legend_handles_labels(), ncols=5)
    style.name_elements(figure, runs)
    return figure


def block_line(run: Run) -> tuple[float, float, float]:
    """(M/depth, u0 - gap, d0): slope of the block's line, where it ends, where the layer begins."""
    if run.summary["scene"] not in SCENES:
        raise ResultsError(run.path / "summary.json", f"scene {run.summary['scene']} is not a confined block")
    young, nu, depth = (run.parameter(each) for each in ("E", "nu", "depth"))
    modulus = young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    return modulus / depth, run.parameter("u0") - run.parameter("gap"), run.parameter("d0")


def state(run: Run) -> tuple[float, float, float]:
    """(overlap, pressure, s) of the points, which are all alike."""
    overlap, pressure, s = (float(np.mean(run.contact[column])) for column in ("overlap", "pressure", "s"))
    return overlap, pressure, s
