"""draw what friction did: the loop of force against displacement, and where it sticks and slips, step by step

RUN is a run with friction and several load steps. (a) of a scene the shear force over how far the obstacle or the
upper body has been dragged; of a case the reaction over the displacement of the load or motion that does most in the
last load phase. The area of the last closed loop is shaded, with what friction dissipated in it; (b) in the plane, load
step by load step, where the contact sticks and slips; in space, the shares of the points that do.
"""

import argparse

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from postprocess import bodies as drawn
from postprocess import style
from postprocess.bodies import ZONES, slip_zones, units_of
from postprocess.formatting import Units
from postprocess.load_series import Curve, driving_load, load_curves, read_series
from postprocess.output import write_figure_of_run
from postprocess.results import ResultsError, Run, column_names, one_line, read_run, read_table

COLUMNS = "step leg drag shearForce dissipated contactPoints stickingPoints".split()
STRONG = {1: style.GREEN, 2: style.ORANGE}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    style.add_output(parser, "hysteresis")
    parser.add_argument(
        "--contact", type=int, default=0, metavar="N", help="in (b) the contact with this number; default 0"
    )
    parser.add_argument("--along", metavar="NAME", help="in (a) of a case this load or motion, as 'move top x'")
    parser.add_argument("--slide", action="store_true", help="panels side by side on a page of 16:9, for a slide")
    parser.add_argument("--slip", action="store_true", help="in (a) without the elastic displacement of the bodies")
    style.add_units(parser)


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws it and prints the paths."""
    chosen = read_run(arguments.folder)
    with style.look():
        figure = draw(chosen, units_of(chosen, arguments.units), arguments, Units(chosen.summary, arguments.units))
        write_figure_of_run(figure, arguments.out, chosen.path / "hysteresis.pdf")


def last_loop(drag: np.ndarray, shear: np.ndarray) -> tuple[int, int] | None:
    """First and last step of the last closed loop: the end, force and displacement, met before with a turn between."""
    size = np.ptp(shear)
    for start in range(len(shear) - 3, -1, -1):
        between = shear[start : len(shear)]
        met = abs(shear[start] - shear[-1]) <= 1e-3 * size and abs(drag[start] - drag[-1]) <= 0.02 * np.ptp(drag)
        if met and np.ptp(between) > 0.5 * size:
            return start, len(shear) - 1
    return None


def flexibility(table: dict) -> float:
    """Of the bodies along the pull while all of it sticks: the least of all load steps; ResultsError without pull."""
    drag, shear = np.diff(table["drag"]), np.diff(table["shearForce"])
    pulls = np.abs(shear) > 1e-6 * np.ptp(table["shearForce"])
    if not pulls.any():
        raise ResultsError("series.csv", "has no load step in which the shear force changes")
    return (drag[pulls] / shear[pulls]).min()


def of_case(chosen: Run, table: dict, named: str | None) -> tuple[dict, Curve]:
    """The table with displacement and reaction of one load or motion in place of drag and shear; and that curve."""
    path = chosen.path / "series.csv"
    whole = read_series(chosen)
    if named is None:
        each = driving_load(whole)
    else:
        found = {each.name: each for each in load_curves(whole)}
        if named not in found:
            raise ResultsError(path, f"{named}: no load or motion; allowed: {', '.join(found)}")
        each = found[named]
    if each is None:
        raise ResultsError(path, "has no load or motion that does work in the last load phase; allowed: --along NAME")
    rows = len(table["step"])
    return {**table, "drag": each.way[-rows:], "shearForce": each.force[-rows:]}, each


def draw(chosen: Run, units: style.Units, asked: argparse.Namespace, own: Units) -> Figure:
    """The figure, one column of a page wide, or a slide."""
    table = read_table(chosen.path / "series.csv", COLUMNS, "; run it with friction")
    curve = None
    if any(column.endswith(" reaction") for column in column_names(chosen.path / "series.csv")):
        table, curve = of_case(chosen, table, asked.along)
    figure, panels = style.figure_with_panels([("a", 1.0), ("b", 0.9)], "ab", asked.slide)
    above, below = panels["a"], panels["b"]
    words = f"displacement of {style.without_mathtext(curve.name)}" if curve else "dragged by"
    if asked.slip:
        words = "displacement without its elastic part"
        table["drag"] -= flexibility(table) * table["shearForce"]
    turns = curve is not None and curve.turns
    force = own.moment if turns else own.force
    label = ("moment" if turns else "reaction") if curve else "shear force"
    across = f"{words} [{'rad' if turns else units.length}]"
    plot_loop(above, table, across, f"{label} [{force or 'force unit'}]", own.energy)
    if (chosen.path / "slides.csv").exists():
        plot_zones(below, chosen, asked.contact, len(table["step"]), units)
    else:
        plot_shares(below, table)
    drawn.set_panel_title(above, 0)
    drawn.set_panel_title(below, 1, named(chosen, asked.contact), 28)
    return figure


def named(chosen: Run, contact: int) -> str:
    """The contact of (b), of a case in the plane; in space its shares are those of all."""
    stated = chosen.summary.get("contacts") or []
    if not (chosen.path / "slides.csv").exists() or contact >= len(stated):
        return ""
    return style.without_mathtext(one_line(str(stated[contact].get("name", ""))))


def plot_loop(axes: Axes, table: dict, words: str, label: str, unit: str) -> None:
    drag, shear, lost = table["drag"], table["shearForce"], table["dissipated"]
    closed = last_loop(drag, shear)
    energy = f"dissipated {lost[-1]:.3g}"
    if closed:
        first, last = closed
        axes.fill(drag[first : last + 1], shear[first : last + 1], color=ZONES[2], linewidth=0)
        energy = f"last loop {lost[last] - lost[first]:.3g}, in all {lost[-1]:.3g}"
    axes.plot(drag, shear, color=style.BLUE, marker="o", markersize=2.2, markeredgewidth=0)
    axes.plot(drag[-1], shear[-1], color=style.VERMILION, marker="o", markersize=4, linestyle="none")
    axes.axhline(0, color=style.GREY, linewidth=0.5, zorder=0)
    axes.axvline(0, color=style.GREY, linewidth=0.5, zorder=0)
    # an arrow in the middle of each leg
    for leg in np.unique(table["leg"]):
        rows = np.flatnonzero(table["leg"] == leg)
        rows = np.concatenate([[rows[0] - 1], rows]) if rows[0] > 0 else rows
        way = np.hypot(np.ptp(drag[rows]) / (np.ptp(drag) or 1), np.ptp(shear[rows]) / (np.ptp(shear) or 1))
        if len(rows) > 1 and way > 0.2:
            k = rows[len(rows) // 2 - 1]
            ends: style.Look = {"xy": (drag[k + 1], shear[k + 1]), "xytext": (drag[k], shear[k])}
            axes.annotate("", arrowprops={"arrowstyle": "-|>", "color": style.BLUE, "linewidth": 0.8}, **ends)
    axes.set_xlabel(style.wrapped(words, 36), loc="left", multialignment="left")  # the power of ten is at the right end
    axes.set_ylabel(label)
    axes.set_title(f"energy{f' [{unit}]' if unit else ''}: {energy}", loc="right", fontsize=8)
    axes.ticklabel_format(axis="both", scilimits=(-3, 4), useMathText=True)


def plot_zones(axes: Axes, chosen: Run, contact: int, steps: int, units: style.Units) -> None:
    """Load step by load step, where one contact sticks and slips."""
    table = read_table(chosen.path / "slides.csv", "step contact x y slide".split())
    mine = table["contact"] == contact
    flat = not mine.any() or np.ptp(table["x"][mine]) >= np.ptp(table["y"][mine])
    along = table["x" if flat else "y"]
    for step in range(1, steps + 1):
        rows = np.flatnonzero(mine & (table["step"] == step))
        rows = rows[np.argsort(along[rows])]
        if len(rows):
            boxes = slip_zones(along[rows], table["slide"][rows])
            corners = [[(step - 0.5, a), (step + 0.5, a), (step + 0.5, b), (step - 0.5, b)] for a, b, _ in boxes]
            colours = [STRONG[state] for *_, state in boxes]
            axes.add_collection(PolyCollection(corners, facecolors=colours, linewidths=0))
    axes.set_xlim(0.5, steps + 0.5)
    axes.autoscale(axis="y")
    axes.margins(y=0.05)
    axes.set_xlabel("load step [–]")
    axes.set_ylabel(f"${'x' if flat else 'y'}$ [{units.length}]")
    squares: list[Artist] = [Rectangle((0, 0), 1, 1, color=STRONG[k], linewidth=0) for k in (1, 2)]
    axes.legend(squares, ["sticks", "slips"], **ABOVE)


def plot_shares(axes: Axes, table: dict) -> None:
    """In space: the shares of the points in contact that stick and slip."""
    share = 100 * table["stickingPoints"] / np.maximum(table["contactPoints"], 1)
    steps = table["step"]
    axes.bar(steps, share, 1.0, color=STRONG[1], linewidth=0, label="sticks")
    axes.bar(steps, 100 - share, 1.0, bottom=share, color=STRONG[2], linewidth=0, label="slips")
    axes.set_xlim(steps[0] - 0.5, steps[-1] + 0.5)
    axes.set_ylim(0, 100)
    axes.set_xlabel("load step [–]")
    axes.set_ylabel("points in contact [%]")
    axes.legend(**ABOVE)


ABOVE: style.Look = {"ncols": 2, "loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "borderaxespad": 0.1}
