"""force against approach of surfaces that attract, with jumps and branches (runs with -path, -law lennard-jones)"""

from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from postprocess import style
from postprocess.results import ResultsError, Run, read_table

RUNS = (1, 4)

COLUMNS = "state leg approach force stiffness stability jump".split()
# pull-off force over pi w R of a sphere on a half-space, by Tabor's number: an independent boundary element code, 0.1 %
PULL_OFF = {0.05: -1.9883, 0.3: -1.8698, 0.5: -1.7871, 0.8: -1.7059, 1: -1.6702, 2: -1.5834, 3: -1.5509, 5: -1.5257}


def modulus(run: Run) -> float:
    return run.positive("E") / (1 - run.parameter("nu") ** 2)


def tabor(run: Run) -> float:
    """Tabor's number of a rigid sphere or cylinder on the run's block."""
    return (run.positive("R") * run.positive("w") ** 2 / modulus(run) ** 2 / run.positive("eps0") ** 3) ** (1 / 3)


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Stable states full, unstable ones dotted, jumps as arrows; of a sphere beside JKR's and DMT's curves.

    Forces over pi w R, approaches over the gap at rest; of waves and cylinders as they are. Sources: Johnson, Kendall
    and Roberts (1971); Derjaguin, Muller and Toporov (1975).
    """
    figure = Figure(figsize=(style.COLUMN, 0.95 * style.COLUMN), layout="constrained")
    axes = figure.subplots()
    spheres = all(run.summary["scene"].startswith(("adhesive-sphere", "labs/7")) for run in runs)
    drawn = []
    for index, run in enumerate(runs):
        if run.summary["parameters"].get("law") != "lennard-jones":
            raise ResultsError(run.path, "is not a run with -law lennard-jones")
        rows = read_table(run.path / "path.csv", COLUMNS, "the run needs -path")
        length = run.positive("eps0") if spheres else 1.0
        unit = np.pi * run.positive("w") * run.positive("R") if spheres else 1.0
        whole = run.summary["parameters"].get("branch") == "unstable"
        name = rf"Tabor's number $\mu$ = {tabor(run):.3g}" if spheres else run.summary["scene"].replace("-", " ")
        name = "all states, dotted: unstable" if whole else name
        rows["approach"], rows["force"] = rows["approach"] / length, rows["force"] / unit
        rows["stiffness"] = rows["stiffness"] * length / unit
        drawn.append((rows, style.CURVES[index], name, whole, run))
    names = [name for _, _, name, _, _ in drawn]
    for rows, colour, name, whole, run in drawn:
        if names.count(name) > 1:  # runs of one problem on several meshes
            name += f", $h$ = {style.number(run.summary['h'])}"
        draw_path(axes, rows, colour, name, whole)
    if spheres:
        draw_theories(axes, runs[0])
    axes.axhline(0, color=style.GREY, linewidth=0.4)
    over = r"approach / equilibrium gap, $\delta/\varepsilon$ [–]", r"force / adhesion × radius, $F/(\pi w R)$ [–]"
    plain = f"approach [{units.length}]", f"force [{units.stress} × {units.length}]"
    axes.set(**dict(zip(("xlabel", "ylabel"), over if spheres else plain, strict=True)))
    style.legend_outside(figure, "upper center", *axes.get_legend_handles_labels(), ncols=2, columnspacing=1.2)
    style.name_elements(figure, runs)
    return figure


def draw_path(axes: Axes, rows: dict, colour: str, name: str, whole: bool) -> None:
    """One run: pieces of equal stability, cut at jumps, which are arrows; one of all states broad, below the others."""
    broad: style.Look = {"linewidth": 3.2, "alpha": 0.45, "zorder": 1.5} if whole else {}
    approach, force = rows["approach"], rows["force"]
    stable, jumped = rows["stability"] >= 0, rows["jump"] > 0  # 0 at a fold, where a stable branch ends
    cuts = [0, *np.nonzero(jumped | np.append(False, stable[1:] != stable[:-1]))[0], len(force)]
    for begin, end in pairwise(cuts):
        if begin == end:
            continue
        joined = begin - 1 if begin and not jumped[begin] else begin
        piece = slice(joined, end)
        line = "-" if stable[begin] else (0, (0.6, 0.6) if whole else (1, 1.5))
        points = smooth_curve(*(rows[column][piece] for column in ("approach", "force", "stiffness")))
        axes.plot(*points, color=colour, linestyle=line, label=name if begin == 0 else None, **broad)
    for row in np.nonzero(jumped)[0]:
        arrow = {
            "arrowstyle": "-|>",
            "color": colour,
            "linewidth": 0.7,
            "linestyle": (0, (3, 1.5)),
            "shrinkA": 0,
            "shrinkB": 0,
        }
        axes.annotate("", (approach[row], force[row]), (approach[row - 1], force[row - 1]), arrowprops=arrow)


def smooth_curve(x: np.ndarray, y: np.ndarray, slope: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The cubic between neighbours where it is near their chord; up to a fold, of infinite slope, a root and a line."""
    t = np.linspace(0, 1, 21)[:, None]
    step = np.diff(x)
    rise, left, right = np.diff(y), slope[:-1] * step, slope[1:] * step
    bend = t * (1 - t) * ((1 - t) * (left - rise) - t * (right - rise))
    bend = np.where(np.abs(bend).max(axis=0) < 0.3 * np.ptp(y), bend, 0) if len(y) > 1 else bend
    curve = y[:-1] + t * rise + bend
    for part in np.nonzero(slope[1:] > 1e200)[0]:
        root = -2 * (rise[part] - left[part])
        curve[:, part] = y[part + 1] + root * np.sqrt(1 - t[:, 0]) - (rise[part] + root) * (1 - t[:, 0])
    return (x[:-1] + t * step).T.ravel(), curve.T.ravel()


def draw_theories(axes: Axes, run: Run) -> None:
    """JKR's curve for the first run's data, DMT's, and the boundary element code's pull-off force."""
    left, right = axes.get_xlim()
    down, up = axes.get_ylim()
    mu = tabor(run)
    # a over sqrt(R eps), F over pi w R, delta over eps
    radius = np.linspace(1e-3, 4 * np.sqrt(1 + mu), 2000)
    force = 4 * radius**3 / (3 * np.pi * mu**1.5) - np.sqrt(8 * radius**3 / (np.pi * mu**1.5))
    approach = radius**2 - np.sqrt(2 * np.pi * radius * mu**1.5)
    seen = radius > radius[np.argmin(approach)]
    axes.plot(approach[seen], force[seen], color=style.BLACK, linewidth=0.8, linestyle=(0, (5, 2)), label="JKR")
    pressed = np.linspace(0, max(right, 0.1), 200)
    hertz = 4 * pressed**1.5 / (3 * np.pi * mu**1.5) - 2
    axes.plot(pressed, hertz, color=style.GREY, linewidth=0.8, linestyle=(0, (2, 1.5)), label="DMT")
    for number, least in PULL_OFF.items():
        if abs(number / mu - 1) < 0.01:
            axes.plot(
                [left, right], [least, least], color=style.BLACK, linewidth=0.5, label="pull-off, boundary elements"
            )
    axes.set_xlim(left, right)
    axes.set_ylim(min(down, -2.1), up)
