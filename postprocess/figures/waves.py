"""a rigid wave: pressure over one wavelength against Westergaard's, one or more loads, and the difference"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.reference_values import merging_pressure, prescribed_force, wave_pressure
from postprocess.results import ResultsError, Run

RUNS = (1, 7)


def draw(runs: list[Run], units: style.Units) -> Figure:
    """(a) p/p_full over x/lambda, all waves' points laid over each other, and Westergaard's curves; (b) the difference.

    p_full is the mean pressure at which the contacts merge. The closed form is that of hard contact on a half-plane,
    which has no sides: the outermost two waves on either side, which the block's free sides disturb, are left out.
    """
    figure = Figure(figsize=(style.COLUMN, 1.35 * style.COLUMN), layout="constrained")
    left, right = figure.subplots(2, 1, sharex=True, height_ratios=[1.5, 1])
    line = np.linspace(-0.5, 0.5, 1001)
    dots = {"linestyle": "none", "markersize": 2.5, "markeredgewidth": 0.5, "markerfacecolor": "white"}
    for index, run in enumerate(runs):
        full = merging_pressure(run)
        waves = run.parameter("waves")
        if waves < 5:
            raise ResultsError(run.path / "summary.json", "has fewer than five waves: none is far from the sides")
        x = run.contact["x"] * waves / run.positive("width")
        inner = np.abs(x) <= waves / 2 - 2 + 1e-9
        crests = x[inner] - 0.5  # the wave is farthest from the block at x = 0
        x, pressure = crests - np.round(crests), run.contact["pressure"][inner]
        look: style.Look = {**style.curve(index), **dots}
        share = style.number(float(f"{prescribed_force(run) / run.positive('width') / full:.3g}"))
        left.plot(line, wave_pressure(run, line) / full, color=style.BLACK, linewidth=0.8, zorder=3)
        left.plot(x, pressure / full, label=rf"$\bar p = {share}\, p_{{\mathrm{{full}}}}$", **look)
        right.plot(x, 100 * (pressure - wave_pressure(run, x)) / full, **look)
    left.plot([], [], color=style.BLACK, linewidth=0.8, label="Westergaard")
    left.set_ylabel(r"pressure $p/p_{\mathrm{full}}$ [–]")
    left.set_ylim(0, None)
    right.set_ylabel(r"difference [% of $p_{\mathrm{full}}$]")
    for number, axes in enumerate((left, right)):
        axes.set_xlim(-0.5, 0.5)
        axes.set_title(style.panel(number), loc="left")
    right.set_xlabel(r"$x/\lambda$, from the crest [–]; the contacts merge at $\bar p = p_{\mathrm{full}}$")
    style.legend_outside(figure, "upper center", *left.get_legend_handles_labels(), ncols=2)
    style.name_elements(figure, runs)
    return figure
