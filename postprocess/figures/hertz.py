"""a contact under a force against Hertz: pressure, and shear stress below the middle (runs with -axis 1)"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.references import hertz, prescribed_force
from postprocess.results import Run, read_table

RUNS = (1, 1)


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Left, p/p0 over x/a; right, the greatest shear stress |s11 - s22|/2 over the depth z/a, both with Hertz's curves.

    a and p0 are Hertz's own, from the applied force and the parameters: nothing of the run enters them. Sources:
    Johnson, Contact Mechanics (1985), 4.2 for lines, 3.4 for circles.
    """
    (run,) = runs
    round_contact = run.summary["parameters"].get("geometry") == "axisymmetric"
    a, greatest = hertz(run, prescribed_force(run), round_contact)
    axis = read_table(run.path / "axis.csv", ["depth", "s11", "s22", "s12"], "the run needs -axis 1")
    depth = np.linspace(1e-3, 3, 400)
    shear, expected = np.abs(axis["s11"] - axis["s22"]) / 2 / greatest, shear_below(depth, run, round_contact)

    figure = Figure(figsize=(style.PAGE, 0.42 * style.PAGE), layout="constrained")
    left, right = figure.subplots(1, 2)
    x, pressure = run.contact["x"] / a, run.contact["pressure"] / greatest
    shown = np.abs(x) <= 1.4
    line = np.linspace(0 if round_contact else -1, 1, 400)
    left.plot(line, np.sqrt(1 - line**2), color=style.BLACK, label="Hertz")
    dots = {"linestyle": "none", "marker": "o", "markersize": 3.2, "markerfacecolor": "white", "color": style.VERMILION}
    left.plot(x[shown], pressure[shown], label=f"{style.method(run)}, {run.summary['contactPoints']} points", **dots)
    left.set_xlabel("$r/a$" if round_contact else "$x/a$")
    left.set_ylabel("pressure $p/p_0$")
    right.plot(expected, depth, color=style.BLACK)
    below = axis["depth"] / a
    right.plot(shear, below, color=style.VERMILION, linestyle=(0, (4, 1.5)))
    peak, theirs = np.argmax(shear), np.argmax(expected)
    right.annotate(
        f"{shear[peak]:.3f} at {below[peak]:.2f} $a$\n(Hertz: {expected[theirs]:.3f} at {depth[theirs]:.2f} $a$)",
        (shear[peak], below[peak]),
        (0.35 * shear[peak], below[peak] + 0.7),
        arrowprops={"arrowstyle": "-", "linewidth": 0.6},
    )
    right.set_ylim(min(3, below.max()), 0)
    right.set_xlim(0, None)
    right.set_xlabel(r"greatest shear stress $\tau/p_0$")
    right.set_ylabel("depth $z/a$")
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return figure


def shear_below(z: np.ndarray, run: Run, round_contact: bool) -> np.ndarray:
    """Hertz's greatest shear stress over p0 on the axis at depths z (in units of a)."""
    if round_contact:
        nu = run.parameter("nu")
        down = -1 / (1 + z**2)
        radial = -(1 + nu) * (1 - z * np.arctan(1 / z)) + 1 / (2 * (1 + z**2))
        return np.abs(radial - down) / 2
    root = np.sqrt(1 + z**2)
    return np.abs(-((1 + 2 * z**2) / root - 2 * z) + 1 / root) / 2
