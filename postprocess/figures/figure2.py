"""contact pressure of a run against a second one, the reference, and their difference"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from postprocess import style
from postprocess.results import ResultsError, Run

RUNS = (2, 2)

LINE = 62  # characters that fit into a line of the legend
LEAST_POINTS = 5  # points in contact below which a comparison of profiles means nothing
SAME_PROBLEM = "kappa m d0 E nu R gap u0 width depth".split()


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Above, both pressures against x; below, |difference| over the greatest reference pressure, logarithmic.

    On the same points the pressures are subtracted as they are, else the reference is interpolated linearly in x.
    """
    run, reference = runs
    check_comparable(run, reference)
    x, pressure = run.contact["x"], run.contact["pressure"]
    x_reference, pressure_reference = reference.contact["x"], reference.contact["pressure"]
    same_points = len(x) == len(x_reference) and np.allclose(x, x_reference, rtol=0, atol=1e-9 * np.ptp(x))
    expected = pressure_reference if same_points else np.interp(x, x_reference, pressure_reference)
    difference = np.abs(pressure - expected) / pressure_reference.max()

    figure = Figure(figsize=(style.COLUMN, 1.18 * style.COLUMN), layout="constrained")
    legend = legend_entries(runs)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2.1, 1])
    touched = (pressure > 0) | (expected > 0)
    middle = x[touched].mean()
    edge = 1.12 * np.abs(x[touched] - middle).max()
    shown = np.abs(x - middle) < 0.98 * edge
    above.plot(x_reference, pressure_reference, color=style.BLACK, linewidth=1.0, label=legend[1], zorder=2)
    above.plot(
        x[shown],
        pressure[shown],
        linestyle="none",
        marker="o",
        markersize=3.6,
        markerfacecolor="white",
        markeredgewidth=0.9,
        color=style.VERMILION,
        markevery=max(1, np.count_nonzero(pressure > 0) // 45),
        label=legend[0],
        zorder=3,
    )
    above.set_ylabel(f"contact pressure $p$ [{units.stress}]")
    top = max(pressure.max(), pressure_reference.max())
    above.set_ylim(-0.03 * top, 1.05 * top)
    handles, texts = above.get_legend_handles_labels()
    style.legend_outside(figure, "upper center", handles[::-1], texts[::-1], borderaxespad=0.2, alignment="left")

    draw_difference(below, x[touched], difference[touched])
    if not same_points:
        below.set_title("reference interpolated", fontsize=8, loc="right", pad=2)
    below.set_xlabel(f"$x$ [{units.length}]")
    below.set_xlim(middle - edge, middle + edge)
    figure.align_ylabels()
    style.name_elements(figure, runs)
    return figure


def draw_difference(axes: Axes, x: np.ndarray, difference: np.ndarray) -> None:
    """The relative difference at the points in contact; where it is exactly zero there is nothing to draw."""
    axes.set_ylabel(r"$|p - p_{\mathrm{ref}}| \,/\, \max\, p_{\mathrm{ref}}$ [–]")
    if not difference.any():
        axes.text(0.5, 0.5, "no difference", transform=axes.transAxes, ha="center", va="center", color=style.GREY)
        axes.set_yticks([])
        return
    seen = np.where(difference > 0, difference, np.nan)
    axes.plot(x, seen, color=style.BLUE, marker=".", markersize=3, linewidth=0.7)
    greatest = difference.max()
    style.set_log(axes, "y", 5)
    words = f"greatest: ${style.number(float(f'{greatest:.2g}'))}$"
    axes.set_title(words, loc="left", fontsize=8, color=style.BLUE)


def legend_entries(runs: list[Run]) -> list[str]:
    """Each run's name and price, on two lines where they do not fit into one."""
    entries = list(zip(style.labels(runs), [style.cost_text(run, "Newton step") for run in runs], strict=True))
    longest = max(len(label) + len(price) for label, price in entries)
    separator = ": " if longest < LINE else ":\n"
    return [separator.join(entry) for entry in entries]


def check_comparable(run: Run, reference: Run) -> None:
    """Refuses two runs of different problems, or with too few points in contact to compare profiles."""
    theirs, ours = reference.summary["parameters"], run.summary["parameters"]
    for name in SAME_PROBLEM:
        if name in theirs and name in ours and theirs[name] != ours[name]:
            raise ResultsError(
                run.path / "summary.json",
                f"{name} = {ours[name]}, but {theirs[name]} in {reference.path}: not the same problem",
            )
    for each in (run, reference):
        touching = int(np.count_nonzero(each.contact["pressure"] > 0))
        if touching < LEAST_POINTS:
            raise ResultsError(
                each.path / "contact.csv",
                f"only {style.count(touching, 'point')} in contact, {LEAST_POINTS} are needed for a comparison",
            )
