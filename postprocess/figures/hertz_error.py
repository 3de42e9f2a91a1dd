"""error against Hertz over the element size, a curve a scene and order: width of contact, pressures"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.reference_values import CIRCLES, LINES, about_axis, hertz, prescribed_force, scene_of
from postprocess.results import ResultsError, Run

RUNS = (2, None)

PLANE = (*LINES, "axisymmetric")  # meshes of triangles, the others of tetrahedra
LEAST = 1e-5  # an error that changes its sign between two meshes may be as small as one likes
FLOOR = 3e-5  # of the first two errors: less than what Hertz leaves out, as a/R and the size of the bodies
WHAT = ("half-width or radius", "greatest pressure", "pressure, root mean square")


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Relative errors over h/a, a row each: of the second moment, of the greatest value, of all points, weighted.

    Scenes with meshes of triangles at the left, of tetrahedra at the right. The legends have each curve's slopes, least
    squares over what is not below FLOOR, which is shaded; none where the error changes its sign. Errors below LEAST
    stand there. a and p0 are from the prescribed force and the parameters: nothing of the runs enters them.
    """
    groups: dict[tuple, list[Run]] = {}
    for run in runs:
        groups.setdefault((scene(run), run.summary["order"]), []).append(run)
    scenes = list(dict.fromkeys(name for name, _ in groups))
    sides = [side for side in (True, False) if any((name in PLANE) is side for name in scenes)]
    figure = Figure(figsize=(style.COLUMN, 2.1 * style.COLUMN), layout="constrained")
    grid = figure.subplots(len(WHAT), len(sides), sharex="col", sharey="row", squeeze=False)
    for (name, order), group in groups.items():
        panels = grid[:, sides.index(name in PLANE)]
        sizes, found = errors(group)
        look = style.curve(scenes.index(name)) | {"linewidth": 0.9}
        if order > 1:
            look |= {"markerfacecolor": "white", "linestyle": (0, (4, 1.5))}
        text = ", ".join(slope(sizes, each) for each in found)
        for axes, each in zip(panels, found, strict=True):
            axes.plot(sizes, np.maximum(np.abs(each), LEAST), label=f"{words(name)}, P{order}: {text}", **look)
    for panels, side in zip(grid.T, sides, strict=True):
        panels[-1].set_xlabel("element size $h/a$ [–]")
        style.set_log(panels[0], "x", 4)
        place, entries = "lower left" if side else "lower right", panels[0].get_legend_handles_labels()
        small: style.Look = {"fontsize": 7, "handlelength": 1.5, "title_fontproperties": {"size": 7}}
        title = "slopes in (a), (b), (c); ×: sign changes\ngrey: below the error of Hertz's solution"
        style.legend_outside(figure, place, *entries, title=title if side is sides[0] else " ", **small)
    for index, (row, what) in enumerate(zip(grid, WHAT, strict=True)):
        style.set_log(row[0], "y", 5)
        row[0].set_ylabel("relative error [–]")
        row[0].set_title(f"{style.panel(index)} {what}", loc="left")
        for axes in row:
            axes.grid(color="0.9", linewidth=0.5)
            if index < 2:
                axes.axhspan(LEAST / 10, FLOOR, color="0.9", linewidth=0, zorder=0)
    for axes, side in zip(grid[0], sides, strict=True):
        kind = "triangles" if side else "tetrahedra"
        axes.set_title(f"{kind}\n{axes.get_title(loc='left')}", loc="left")
    figure.align_ylabels()
    return figure


def slope(sizes: np.ndarray, error: np.ndarray) -> str:
    """The slope of |error| over the sizes in logarithms, for readers; a cross where it has none."""
    sizes, error = sizes[np.abs(error) > FLOOR], error[np.abs(error) > FLOOR]
    if len(sizes) < 2 or not (np.all(error > 0) or np.all(error < 0)):
        return "×"
    return f"{np.polyfit(np.log(sizes), np.log(np.abs(error)), 1)[0]:.1f}".replace("-", "−")


def words(name: str) -> str:
    """A scene as what is in contact."""
    return {"hertz-line": "cylinder", "axisymmetric": "sphere on block"}.get(name, name.replace("-", " "))


def scene(run: Run) -> str:
    """The run's scene; of a disc about its axis that word."""
    name = scene_of(run, *LINES, "disc-on-block", *CIRCLES)
    if name == "disc-on-block" and not about_axis(run):
        raise ResultsError(run.path / "summary.json", "is of a disc: use the scene hertz-line")
    return "axisymmetric" if about_axis(run) else name


def errors(group: list[Run]) -> tuple[np.ndarray, np.ndarray]:
    """h/a (runs,), sorted, and relative errors (3, runs) of WHAT, the first two with their sign; runs of one scene."""
    rows = []
    for run in group:
        if not run.summary["converged"]:
            raise ResultsError(run.path / "summary.json", "the run did not converge: its error means nothing")
        a, greatest = hertz(run, prescribed_force(run))
        x, y, weight, pressure = (run.contact[name] for name in ("x", "y", "weight", "pressure"))
        in_space = run.summary["scene"] in CIRCLES  # otherwise y is the height
        expected = greatest * np.sqrt(np.maximum(1 - (x**2 + (y**2 if in_space else 0)) / a**2, 0))
        spread = np.sqrt(weight @ (pressure - expected) ** 2 / (weight @ expected**2))
        width, top = run.value("halfWidthMoment"), run.value("pressureMax")
        rows.append((run.value("h") / a, width / a - 1, top / greatest - 1, spread))
    sizes, *found = np.array(sorted(rows)).T
    return sizes, np.array(found)
