"""contact in space: pressure map on the surface, and pressure over the distance from the middle against Hertz"""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation

from postprocess import style
from postprocess.results import ResultsError, Run, read_table

RUNS = (1, 1)


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Left, the pressure at the points, with Hertz's circle; right, p/p0 over r/a, one dot a point, and Hertz's curve.

    a and p0 are those of hard contact on a half-space under the run's total force; the middle is the pressure's centre.
    """
    (run,) = runs
    read_table(run.path / "contact.csv", ["z"], "; the run is not one in space")
    x, y, pressure = (run.contact[name] for name in ("x", "y", "pressure"))
    nodal = run.contact["weight"] * pressure
    if not nodal.sum() > 0:
        raise ResultsError(run.path / "contact.csv", "no point is in contact")
    a, greatest = hertz(run)
    middle = np.sum(nodal * x) / nodal.sum(), np.sum(nodal * y) / nodal.sum()
    distance = np.hypot(x - middle[0], y - middle[1])

    figure = Figure(figsize=(style.PAGE, 0.42 * style.PAGE), layout="constrained")
    left, right = figure.subplots(1, 2)
    colours = left.tripcolor(
        Triangulation(x, y), pressure, shading="gouraud", cmap="viridis", vmin=0, vmax=pressure.max(), rasterized=True
    )
    turn = np.linspace(0, 2 * np.pi, 200)
    circle = {"color": style.VERMILION, "linewidth": 0.9, "linestyle": (0, (4, 1.5))}
    left.plot(middle[0] + a * np.cos(turn), middle[1] + a * np.sin(turn), **circle)
    left.set_aspect("equal")
    left.set_xlabel(f"$x$ [{units.length}]")
    left.set_ylabel(f"$y$ [{units.length}]")
    figure.colorbar(colours, ax=left, label=f"pressure $p$ [{units.stress}]", shrink=0.85)

    line = np.linspace(0, 1, 300)
    right.plot(line, np.sqrt(1 - line**2), color=style.BLACK, label="Hertz, half-space", zorder=3)
    shown = distance <= 1.5 * a
    label = f"{style.method(run)}, {style.count(run.summary['contactPoints'], 'point')} in contact"
    dots = {"linestyle": "none", "marker": "o", "markersize": 2.2, "markeredgewidth": 0, "color": style.BLUE}
    right.plot(distance[shown] / a, pressure[shown] / greatest, label=label, alpha=0.6, **dots)
    right.set_xlabel("$r/a$")
    right.set_ylabel("pressure $p/p_0$")
    right.set_xlim(0, None)
    right.set_ylim(0, None)
    found = run.summary["halfWidthMoment"], run.summary["pressureMax"]
    right.annotate(
        f"radius {100 * (found[0] / a - 1):+.1f} %\ngreatest pressure {100 * (found[1] / greatest - 1):+.1f} %",
        (0.97, 0.78),
        xycoords="axes fraction",
        ha="right",
        fontsize=8,
    )
    figure.legend(*right.get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return figure


def hertz(run: Run) -> tuple[float, float]:
    """(a, p0): Hertz's radius and greatest pressure for a rigid sphere under the run's total force."""
    force = run.summary["force"]
    modulus = run.parameter("E") / (1 - run.parameter("nu") ** 2)
    a = (3 * force * run.parameter("R") / (4 * modulus)) ** (1 / 3)
    return a, 3 * force / (2 * np.pi * a**2)
