"""error against Hertz over the element size, a curve a scene and order: width of contact, pressures"""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from postprocess import style
from postprocess.references import hertz, prescribed_force, scene_of
from postprocess.results import ResultsError, Run

RUNS = (2, None)

LINES = ("hertz-line", "two-cylinders")  # of the scenes, those whose contact is a line
CIRCLES = ("disc-on-block", "sphere-on-block", "sphere-on-plane", "two-spheres")
FLOOR = 3e-5  # of the first two errors: less than what Hertz leaves out, as a/R and the size of the bodies
WHAT = ("half-width or radius", "greatest pressure", "pressure, root mean square")


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Relative errors over h/a: (a) of the second moment, (b) of the greatest value, (c) of all points, weighted.

    The legend has each curve's slope, least squares over what is not below FLOOR, which is shaded; none where the
    error changes its sign. a and p0 are Hertz's own, from the prescribed force and the parameters: nothing of the runs
    enters them.
    """
    groups: dict[tuple, list[Run]] = {}
    for run in runs:
        groups.setdefault((scene(run), run.summary["order"]), []).append(run)
    scenes = list(dict.fromkeys(name for name, _ in groups))
    figure = Figure(figsize=(style.PAGE, 0.56 * style.PAGE), layout="constrained")
    panels = figure.subplots(1, 3)
    for (name, order), group in groups.items():
        sizes, found = errors(group)
        look = style.curve(scenes.index(name)) | {"linewidth": 0.9}
        if order > 1:
            look |= {"markerfacecolor": "white", "linestyle": (0, (4, 1.5))}
        text = ", ".join(slope(sizes, each) for each in found)
        for axes, each in zip(panels, found, strict=True):
            axes.plot(sizes, np.abs(each), label=f"{name} P{order}: {text}", **look)
    for index, (axes, what) in enumerate(zip(panels, WHAT, strict=True)):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("$h/a$")
        axes.set_xticks([0.05, 0.1, 0.2], labels=["0.05", "0.1", "0.2"])
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.set_title(f"{style.panel(index)} {what}", loc="left")
        axes.grid(color="0.9", linewidth=0.5)
    for axes in panels[:2]:
        axes.set_ylim(0.3 * FLOOR, None)
        axes.axhspan(0.3 * FLOOR, FLOOR, color="0.93", linewidth=0, zorder=0)
    panels[0].set_ylabel("relative error")
    legend = figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    legend.set_title(
        "slopes in (a), (b), (c), above what Hertz leaves out (shaded); × where the error changes its sign",
        prop={"size": 8},
    )
    return figure


def slope(sizes: np.ndarray, error: np.ndarray) -> str:
    """The slope of |error| over the sizes in logarithms, for readers; a cross where it has none."""
    sizes, error = sizes[np.abs(error) > FLOOR], error[np.abs(error) > FLOOR]
    if len(sizes) < 2 or not (np.all(error > 0) or np.all(error < 0)):
        return "×"
    return f"{np.polyfit(np.log(sizes), np.log(np.abs(error)), 1)[0]:.1f}".replace("-", "−")


def scene(run: Run) -> str:
    """The run's scene, as what is in contact."""
    name = scene_of(run, *LINES, *CIRCLES)
    if name == "disc-on-block":
        if run.summary["parameters"].get("geometry") != "axisymmetric":
            raise ResultsError(run.path / "summary.json", "is of a disc: use the scene hertz-line")
        name = "axisymmetric sphere"
    return name


def errors(group: list[Run]) -> tuple[np.ndarray, np.ndarray]:
    """h/a (runs,), sorted, and relative errors (3, runs) of WHAT, the first two with their sign; runs of one scene."""
    rows = []
    for run in group:
        if not run.summary["converged"]:
            raise ResultsError(run.path / "summary.json", "the run did not converge: its error means nothing")
        round_contact = run.summary["scene"] in CIRCLES
        a, greatest = hertz(run, prescribed_force(run), round_contact)
        x, y, weight, pressure = (run.contact[name] for name in ("x", "y", "weight", "pressure"))
        in_space = round_contact and run.summary["scene"] != "disc-on-block"  # otherwise y is the height
        expected = greatest * np.sqrt(np.maximum(1 - (x**2 + (y**2 if in_space else 0)) / a**2, 0))
        spread = np.sqrt(weight @ (pressure - expected) ** 2 / (weight @ expected**2))
        width, top = run.value("halfWidthMoment"), run.value("pressureMax")
        rows.append((run.value("h") / a, width / a - 1, top / greatest - 1, spread))
    sizes, *found = np.array(sorted(rows)).T
    return sizes, np.array(found)
