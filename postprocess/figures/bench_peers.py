"""error in force against CPU seconds, this package beside NGSolve, by degree of the elements (results/bench)"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import Campaign, Row, contact_seconds, is_converged, name_meshes, number, read_campaign
from postprocess.results import ResultsError

RUNS = (1, 1)
READ = read_campaign

CODES = ("this package", "NGSolve")
COLORS = (style.BLUE, style.VERMILION)
SHAPES = dict(zip(range(1, 8), style.MARKERS, strict=True))  # by degree
SCENES = {"sphere-on-block": "sphere, ", "two-cylinders": "cylinders, ", "pin-in-hole": "pin, "}
COLUMNS = (
    "script flags status scene kappa m order h forceError secondsBefore "
    "seconds_assembly seconds_factorisation seconds_contact"
)


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """A panel per problem: a mark a run, its shape the degree; the line joins what no run of the same code beats.

    Runs that came to nothing are counted in words, code by code.
    """
    every = runs[0].rows("peers", COLUMNS)
    rows = [row for row in every if is_converged(row) and number(row, "forceError") > 0]
    problems = list(dict.fromkeys(map(problem, rows)))
    if not problems:
        raise ResultsError(runs[0].path / "peers.csv", "no run of it converged")
    lines = -(-len(problems) // 2)
    figure = Figure(figsize=(style.COLUMN, 0.5 * style.COLUMN * lines + 0.3), layout="constrained")
    grid = figure.subplots(lines, 2, sharey=True, sharex=True, squeeze=False)
    for index, (axes, which) in enumerate(zip(grid.flat, problems, strict=False)):
        for code, color in enumerate(COLORS):
            draw_code(axes, [row for row in rows if problem(row) == which and code_index(row) == code], color)
        lost = failures([row for row in every if not is_converged(row) and problem(row) == which])
        axes.set_title("\n".join([f"{style.panel(index)} {panel_title(*which)}", *lost]), loc="left", fontsize=8)
        axes.grid(color="0.9", linewidth=0.5)
    style.set_log(grid[0, 0], "xy")
    for axes in grid.flat[len(problems) :]:
        axes.set_visible(False)
    for column in grid.T:
        below = [axes for axes in column if axes.get_visible()][-1]
        below.set_xlabel("CPU time [s]")
        below.tick_params(labelbottom=True)
    for axes in grid[:, 0]:
        axes.set_ylabel("error of the force [–]")
    for name, color in zip(CODES, COLORS, strict=True):
        grid[0, 0].plot([], [], color=color, label=name)
    for degree in sorted({round(number(row, "order")) for row in rows}):
        look: style.Look = {"marker": SHAPES[degree], "markerfacecolor": "white", "color": style.GREY, "markersize": 4}
        grid[0, 0].plot([], [], linestyle="", label=f"degree {degree}", **look)
    style.legend_outside(figure, "upper center", ncols=3, columnspacing=1)
    name_meshes(figure, rows)
    return figure


def problem(row: Row) -> tuple[str, float, float]:
    """Scene, kappa and m of a run; also of one that has come to nothing, by its flags."""
    words = row["flags"].split()
    flags = dict(zip(words[::2], words[1::2], strict=True))
    if "-case" in flags:
        kappa, m = flags["-case"].removesuffix(".case").split("-")[1:]
        return "pin-in-hole", float(kappa), float(m)
    return flags.get("-problem", row["scene"]), number(row, "kappa"), number(row, "m")


def failures(rows: list[Row]) -> list[str]:
    """How many cases of each code came to nothing, and how, in lines."""
    lines = []
    for code, name in enumerate(CODES):
        lost = {row["flags"]: row["status"] for row in rows if code_index(row) == code}
        lines += [f"{name}: {list(lost.values()).count(how)} {how}" for how in sorted(set(lost.values()))]
    return lines


def code_index(row: Row) -> int:
    """The code that a row is of: its place in CODES."""
    return int(row["script"].endswith(".py"))


def panel_title(scene: str, kappa: float, m: float) -> str:
    law = rf"$\kappa = {style.number(kappa)}$, $m = {style.number(m)}$"
    return SCENES.get(scene, "") + law


def draw_code(axes: Axes, rows: list[Row], color: str) -> None:
    """The runs of one code: medians over the rounds, what must come before added; the best joined."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(row["flags"], []).append(row)
    points = []
    for group in groups.values():
        seconds = float(np.median([contact_seconds(row) + float(row["secondsBefore"] or 0) for row in group]))
        points.append((seconds, number(group[0], "forceError"), round(number(group[0], "order"))))
    for degree in sorted({point[2] for point in points}):
        x, y = zip(*[point[:2] for point in points if point[2] == degree], strict=True)
        axes.plot(
            x,
            y,
            linestyle="",
            marker=SHAPES[degree],
            color=color,
            markerfacecolor="white",
            markersize=3.5,
            markeredgewidth=0.8,
        )
    front: list[tuple[float, float]] = []
    for seconds, error, _ in sorted(points):
        if not front or error < front[-1][1]:
            front.append((seconds, error))
    if front:
        axes.plot(*zip(*front, strict=True), color=color, linewidth=0.8, alpha=0.6, zorder=1)
