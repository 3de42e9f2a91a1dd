"""a flat punch: pressure below it and towards its corner, hard contact and layers of finite stiffness, closed form"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.reference_values import about_axis, prescribed_force, punch_pressure, scene_of
from postprocess.results import Run

RUNS = (1, 7)

TOP = 4.5  # of the left panel, in mean pressures: the closed form is infinite at the corners


def draw(runs: list[Run], units: style.Units) -> Figure:
    """(a) p over its mean against x/a; (b) the same over the distance from the corner, logarithmic: hard contact, -1/2.

    The closed form is that of hard contact on a half-plane under the run's prescribed force.
    """
    figure = Figure(figsize=(style.COLUMN, 1.45 * style.COLUMN), layout="constrained")
    left, right = figure.subplots(2, 1)
    across = 1 - np.geomspace(1e-4, 1, 300)
    for index, run in enumerate(runs):
        scene_of(run, "flat-punch")
        a = run.positive("a")
        mean = prescribed_force(run) / (np.pi * a**2 if about_axis(run) else 2 * a)
        closed = punch_pressure(run, a * across) / mean
        x, pressure = run.contact["x"] / a, run.contact["pressure"] / mean
        look = style.curve(index) | {"markersize": 2.5, "linewidth": 0.8, "markerfacecolor": "white"}
        left.plot(x, np.where(pressure < TOP, pressure, np.nan), label=style.law_text(run), markevery=0.04, **look)
        half = (x >= 0) & (x < 1 - 1e-9)
        right.plot(1 - x[half], pressure[half], markevery=0.04, **look)
    line: style.Look = {"color": style.BLACK, "linewidth": 1.0, "zorder": 4}
    left.plot(np.append(-across, across[::-1]), np.append(closed, closed[::-1]), label="closed form", **line)
    right.plot(1 - across, closed, **line)
    left.set_ylim(0, TOP)
    left.set_xlabel("$x/a$ [–]")
    style.set_log(right, "xy")
    right.set_xlim(0.5 * (1 - x[half]).min(), 1.2)
    right.set_xlabel("distance from the corner $1 - |x|/a$ [–]")
    right.annotate("slope $-1/2$", (0.32, 0.75), xycoords="axes fraction", fontsize=8)
    for axes, number in ((left, 0), (right, 1)):
        axes.set_ylabel("pressure over its mean [–]")
        axes.set_title(style.panel(number), loc="left")
    style.legend_outside(figure, "upper center", *left.get_legend_handles_labels(), ncols=2)
    style.name_elements(figure, runs)
    return figure
