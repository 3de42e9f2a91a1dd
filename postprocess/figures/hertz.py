"""a contact under a force against Hertz: pressure, and shear stress below the middle (runs with -axis 1)"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from postprocess import style
from postprocess.reference_values import hertz, in_circle, prescribed_force
from postprocess.results import Run, read_table

RUNS = (1, 1)


def draw(runs: list[Run], units: style.Units) -> Figure:
    """(a) p/p0 over x/a; (b) the greatest shear stress |s11 - s22|/2 over the depth z/a, both with Hertz's curves.

    a and p0 are Hertz's own, from the applied force and the parameters: nothing of the run enters them. Sources:
    Johnson, Contact Mechanics (1985), 4.2 for lines, 3.4 for circles.
    """
    (run,) = runs
    round_contact = in_circle(run)
    a, greatest = hertz(run, prescribed_force(run))
    axis = read_table(run.path / "axis.csv", ["depth", "s11", "s22", "s12"], "the run needs -axis 1")

    figure = Figure(figsize=(style.COLUMN, 1.3 * style.COLUMN), layout="constrained")
    above, below = figure.subplots(2, 1)
    x, pressure = run.contact["x"] / a, run.contact["pressure"] / greatest
    shown = np.abs(x) <= 1.4
    line = np.linspace(0 if round_contact else -1, 1, 400)
    above.plot(line, np.sqrt(1 - line**2), color=style.BLACK, label="Hertz, half-space")
    dots: style.Look = {
        "linestyle": "none",
        "marker": "o",
        "markersize": 3.2,
        "markerfacecolor": "white",
        "color": style.VERMILION,
    }
    above.plot(x[shown], pressure[shown], label=f"run, {run.summary['contactPoints']} points in contact", **dots)
    above.set_xlabel("$r/a$ [–]" if round_contact else "$x/a$ [–]")
    above.set_ylabel("pressure $p/p_0$ [–]")
    draw_shear(below, run, axis["depth"] / a, np.abs(axis["s11"] - axis["s22"]) / 2 / greatest, round_contact)
    for index, axes in enumerate((above, below)):
        axes.set_title(style.panel(index), loc="left")
    style.legend_outside(figure, "upper center", *above.get_legend_handles_labels(), ncols=2)
    style.name_elements(figure, runs)
    return figure


def draw_shear(axes: Axes, run: Run, below: np.ndarray, shear: np.ndarray, round_contact: bool) -> None:
    """The shear stress over the depth, both curves' greatest values marked and told beside them."""
    depth = np.linspace(1e-3, 3, 400)
    expected = shear_below(depth, run, round_contact)
    axes.plot(expected, depth, color=style.BLACK)
    axes.plot(shear, below, color=style.VERMILION, linestyle=(0, (4, 1.5)))
    end, greatest = min(3.0, np.ceil(below.max())), max(shear.max(), expected.max())
    for place, name, colour, at, values in (
        (0.1, "Hertz", style.BLACK, depth, expected),
        (0.55, "run", style.VERMILION, below, shear),
    ):
        peak = np.argmax(values)
        axes.plot(values[peak], at[peak], "o", color=colour, markersize=3, zorder=4)
        line = {"arrowstyle": "-", "linewidth": 0.6, "color": colour, "shrinkA": 0, "shrinkB": 0, "relpos": (0, 0.5)}
        text = f"{name}: {values[peak]:.3f} at {at[peak]:.2f} $a$"
        look: style.Look = {"fontsize": 8, "color": colour, "va": "center", "arrowprops": line}
        axes.annotate(text, (values[peak], at[peak]), (1.14 * greatest, place * end), **look)
    axes.set_ylim(end, 0)
    axes.set_xlim(0, 1.85 * greatest)
    axes.set_xticks(np.arange(0, greatest + 1e-9, 0.1))
    axes.set_xlabel(r"greatest shear stress $\tau/p_0$ [–]")
    axes.set_ylabel("depth $z/a$ [–]")


def shear_below(z: np.ndarray, run: Run, round_contact: bool) -> np.ndarray:
    """Hertz's greatest shear stress over p0 on the axis at depths z (in units of a)."""
    if round_contact:
        nu = run.parameter("nu")
        down = -1 / (1 + z**2)
        radial = -(1 + nu) * (1 - z * np.arctan(1 / z)) + 1 / (2 * (1 + z**2))
        return np.abs(radial - down) / 2
    root = np.sqrt(1 + z**2)
    return np.abs(-((1 + 2 * z**2) / root - 2 * z) + 1 / root) / 2
