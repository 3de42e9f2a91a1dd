"""errors against the independent reference over meshes, against seconds, by degree of the elements (results/bench)"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import (
    NAMES,
    Campaign,
    Cells,
    Row,
    contact_seconds,
    is_converged,
    method,
    method_look,
    name_meshes,
    number,
    numbers,
    read_campaign,
    select,
)
from postprocess.results import ResultsError

RUNS = (1, 1)
READ = read_campaign

ERRORS = {
    "forceError": "force",
    "pressureMaxError": "greatest pressure",
    "halfWidthError": "half-width",
    "profileError": "pressure profile",
}
PROBLEMS: dict[str, Cells] = {
    r"$\kappa = 10^3$": {"scene": "disc-on-block", "kappa": 1e3, "m": 3.0},
    r"$\kappa = 10^{12}$": {"scene": "disc-on-block", "kappa": 1e12, "m": 3.0},
    "sphere": {"scene": "sphere-on-block"},
}
ELEMENTS = {"P1": "P1", "P2": "P2", "P3": "P3", "P4": "P4", "P4, -ends": "P4, graded to the ends"}
RIVALS = ("newton", "linesearch", "paper 0", "paper d0", "incremental", "ipopt")
COLUMNS = "flags status method T0 scene kappa m order h seconds_assembly seconds_factorisation seconds_contact"


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """A row per problem, a panel per quantity: a curve per element, a point per mesh; the rivals' runs as points."""
    rows = [row for row in runs[0].rows("meshes", f"{COLUMNS} {' '.join(ERRORS)}") if is_converged(row)]
    if not rows:
        raise ResultsError(runs[0].path / "meshes.csv", "no run of it converged")
    figure = Figure(figsize=(style.PAGE, 0.85 * style.PAGE), layout="constrained")
    grid = figure.subplots(len(PROBLEMS), len(ERRORS), sharex="row", squeeze=False)
    letter = 0
    for line, (title, wanted) in zip(grid, PROBLEMS.items(), strict=True):
        group = select(rows, **wanted)
        for axes, (column, quantity) in zip(line, ERRORS.items(), strict=True):
            known = [row for row in group if number(row, column) > 0]
            if not known:
                axes.set_visible(False)
                continue
            for place, name in enumerate(ELEMENTS):
                draw_front(
                    [row for row in known if method(row) == "xnewton" and element(row) == name], column, axes, place
                )
            for name in RIVALS:
                rival = [row for row in known if method(row) == name]
                axes.plot(seconds(rival), numbers(rival, column), **rival_look(name))
            axes.set_title(f"{style.panel(letter)} {title}: {quantity}", loc="left", fontsize=8)
            letter += 1
            axes.grid(color="0.9", linewidth=0.5)
            style.set_log(axes, "xy", 4)
    for axes in (*grid[-1, :2], *grid[-2, 2:]):
        axes.set_xlabel("CPU time [s]")
    for axes in grid[:, 0]:
        axes.set_ylabel("relative error [–]")
    for place, (name, words) in enumerate(ELEMENTS.items()):
        if any(method(row) == "xnewton" and element(row) == name for row in rows):
            grid[0, 0].plot([], [], **style.curve(place), label=f"default method, {words}")
    for name in RIVALS:
        if any(method(row) == name for row in rows):
            grid[0, 0].plot([], [], **rival_look(name), label=NAMES[name])
    style.legend_outside(figure, "upper center", ncols=4)
    name_meshes(figure, rows)
    return figure


def draw_front(rows: list[Row], column: str, axes: Axes, place: int) -> None:
    """The runs of one element, as points; the line joins what none of them beats."""
    points = sorted(zip(seconds(rows), numbers(rows, column), strict=True))
    looks = style.curve(place)
    axes.plot([x for x, _ in points], [y for _, y in points], **{**looks, "linestyle": ""})
    front = [point for at, point in enumerate(points) if all(point[1] < y for _, y in points[:at])]
    axes.plot([x for x, _ in front], [y for _, y in front], color=looks["color"], linewidth=1)


def element(row: Row) -> str:
    """One of ELEMENTS."""
    return f"P{number(row, 'order'):g}" + (", -ends" if " -ends " in row["flags"] else "")


def seconds(rows: list[Row]) -> np.ndarray:
    return np.array([contact_seconds(row) for row in rows])


def rival_look(name: str) -> dict:
    """A method's marker, open and grey: the colours are the elements'."""
    return {
        "marker": method_look(name)["marker"],
        "linestyle": "",
        "color": style.GREY,
        "markerfacecolor": "white",
        "markersize": 3,
    }
