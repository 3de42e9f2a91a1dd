"""contact pressure of a run against a second one, the reference, and their difference"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.results import ResultsError, Run

RUNS = (2, 2)

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
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2.1, 1])
    labels = [f"{text}:\n{price(each)}" for text, each in zip(style.labels(runs), runs, strict=True)]
    above.plot(x_reference, pressure_reference, color=style.BLACK, linewidth=1.0, label=labels[1], zorder=2)
    above.plot(
        x,
        pressure,
        linestyle="none",
        marker="o",
        markersize=3.6,
        markerfacecolor="white",
        markeredgewidth=0.9,
        color=style.VERMILION,
        markevery=max(1, np.count_nonzero(pressure > 0) // 45),
        label=labels[0],
        zorder=3,
    )
    above.set_ylabel(f"contact pressure $p$ [{units.stress}]")
    top = max(pressure.max(), pressure_reference.max())
    above.set_ylim(-0.03 * top, 1.05 * top)
    handles, texts = above.get_legend_handles_labels()
    figure.legend(handles[::-1], texts[::-1], loc="outside upper center", ncols=2, borderaxespad=0.2, columnspacing=1.2)

    touched = (pressure > 0) | (expected > 0)
    draw_difference(below, x[touched], difference[touched])
    if not same_points:
        below.set_title("reference interpolated to the run's points", fontsize=8, loc="right", pad=2)
    below.set_xlabel(f"$x$ [{units.length}]")
    edge = 1.12 * np.abs(x[touched] - x[touched].mean()).max()
    below.set_xlim(x[touched].mean() - edge, x[touched].mean() + edge)
    figure.align_ylabels()
    return figure


def draw_difference(axes, x: np.ndarray, difference: np.ndarray) -> None:
    """The relative difference at the points in contact; where it is exactly zero there is nothing to draw."""
    axes.set_ylabel(r"$|p - p_{\mathrm{ref}}| \,/\, \max\, p_{\mathrm{ref}}$")
    if not difference.any():
        axes.text(0.5, 0.5, "no difference", transform=axes.transAxes, ha="center", va="center", color=style.GREY)
        axes.set_yticks([])
        return
    seen = np.where(difference > 0, difference, np.nan)
    axes.plot(x, seen, color=style.BLUE, marker=".", markersize=3, linewidth=0.7)
    greatest = difference.max()
    style.decades(axes, np.append(difference, 10 * greatest))
    axes.annotate(
        f"greatest: ${style.number(greatest)}$",
        (0.5, 0.97),
        xycoords="axes fraction",
        ha="center",
        va="top",
        fontsize=8,
        color=style.BLUE,
    )


def price(run: Run) -> str:
    """The counts that the comparison is about."""
    summary = run.summary
    words = style.count(summary["newton"], "Newton step")
    if summary["adaptations"] > 1:
        words = f"{style.count(summary['adaptations'], 'adaptation')}, {words}"
    return words if summary["converged"] else f"{words} (not converged)"


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
        touching = np.count_nonzero(each.contact["pressure"] > 0)
        if touching < LEAST_POINTS:
            raise ResultsError(
                each.path / "contact.csv",
                f"only {style.count(touching, 'point')} in contact, {LEAST_POINTS} are needed for a comparison",
            )
