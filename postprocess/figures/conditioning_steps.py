"""condition of plain Newton's tangent, scaled and not, and its steps over the overshoot (results/conditioning)"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import Campaign, is_converged, name_meshes, numbers, read_campaign, select

RUNS = (1, 1)
READ = read_campaign


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """Left, condition of the first tangent over kappa, as it is and scaled; right, steps over the prediction.

    Laws with m near 1 are as badly conditioned as the others, and take few steps. They are not in the fit.
    """
    rows = runs[0].rows("conditioning", "name status kappa m h order newton predicted conditionFirst scaledFirst")
    power = select(rows, name="power")
    exponents = sorted({float(row["m"]) for row in rows if float(row["m"]) > 1})
    figure = Figure(figsize=(style.PAGE, 0.45 * style.PAGE), layout="constrained")
    left, right = figure.subplots(1, 2)
    for index, m in enumerate(exponents):
        own = select(rows, m=m)
        look = style.curve(index) | {"markersize": 4, "linewidth": 0.8}
        if own[0]["name"] == "linear":
            look |= {"markerfacecolor": "white"}
        left.plot(numbers(own, "kappa"), numbers(own, "conditionFirst"), label=f"$m = {m:g}$", **look)
        solved = [row for row in own if is_converged(row)]
        right.plot(numbers(solved, "predicted"), numbers(solved, "newton"), **(look | {"linestyle": "None"}))
    scaled = numbers(rows, "scaledFirst")
    left.axhline(scaled.max(), color=style.BLACK, linestyle=(0, (4, 2)), linewidth=0.8, zorder=1)
    words = f"scaled to a unit diagonal: {scaled.min():.1e} to {scaled.max():.1e}".replace("e+0", "e")
    left.text(0.98, scaled.max() / 3, words, transform=left.get_yaxis_transform(), ha="right", va="top", fontsize=8)
    solved = [row for row in power if is_converged(row)]
    x, y = numbers(solved, "predicted"), numbers(solved, "newton")
    slope, offset = np.polyfit(x, y, 1)
    right.plot(np.sort(x), slope * np.sort(x) + offset, color=style.GREY, linewidth=0.8, zorder=1)
    right.text(0.97, 0.06, f"line: ${slope:.2f}\\, x {offset:+.1f}$", transform=right.transAxes, ha="right", fontsize=8)
    left.plot(numbers(rows[:1], "kappa"), [min(10, scaled.min() / 10)], " ")  # room for the words
    style.set_log(left, "xy")
    for index, axes in enumerate((left, right)):
        axes.set_title(style.panel(index), loc="left")
    left.set_xlabel(r"stiffness of the law $\kappa$ [stress/length$^m$]")
    left.set_ylabel("condition number of the first tangent [–]")
    right.set_xlabel(r"$x = \ln(s_0/s^*)\,/\,\ln(m/(m-1))$ [–]")
    right.set_ylabel("steps of plain Newton [–]")
    style.legend_outside(figure, "upper center", *left.get_legend_handles_labels(), ncols=len(exponents))
    name_meshes(figure, rows)
    return figure
