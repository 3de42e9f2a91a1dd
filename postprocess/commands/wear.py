"""draw what has worn: the depth and the pressure over the cycles, and the worn profile

RUN is a run of own parts with wear, in the plane or about an axis. (a) the greatest depth of each contact that wears;
(b) its greatest pressure; (c) the depth along its profile. FILE.pdf has a FILE.png beside it.
"""

import argparse

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.bodies import units_of
from postprocess.output import write_figure_of_run
from postprocess.results import ResultsError, Run, read_run, read_table, refuse_space

CYCLES = "contact cycles depth pressureMax".split()
PROFILE = "contact chain x y depth".split()
SIZE = (style.PAGE, 0.36 * style.PAGE)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    style.add_output(parser, "wear")
    style.add_units(parser)


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws it and prints the paths."""
    chosen = read_run(arguments.folder)
    with style.look():
        write_figure_of_run(draw(chosen, units_of(chosen, arguments.units)), arguments.out, chosen.path / "wear.pdf")


def along(table: dict, inside: np.ndarray) -> np.ndarray:
    """The arc length of points that follow each other, from the first one on."""
    steps = np.hypot(np.diff(table["x"][inside]), np.diff(table["y"][inside]))
    return np.concatenate([[0.0], np.cumsum(steps)])


def draw(chosen: Run, units: style.Units) -> Figure:
    """The figure, two columns of a page wide."""
    refuse_space(chosen.path / "contact.csv")
    over = read_table(chosen.path / "wear.csv", CYCLES, "; run a case with wear")
    profile = read_table(chosen.path / "worn.csv", PROFILE, "; run a case with wear")
    worn = [k for k, entry in enumerate(chosen.summary["wear"]["contacts"]) if entry["coefficient"] > 0]
    if not worn:
        raise ResultsError(chosen.path / "wear.csv", "has no contact that wears")
    figure = Figure(figsize=SIZE, layout="constrained")
    depth, pressure, shape = figure.subplots(1, 3)
    for index, contact in enumerate(worn):
        name, look = style.without_mathtext(chosen.summary["contacts"][contact]["name"]), style.curve(index)
        own = over["contact"] == contact
        depth.plot(over["cycles"][own], over["depth"][own], label=name, **look)
        pressure.plot(over["cycles"][own], over["pressureMax"][own], **look)
        for chain in np.unique(profile["chain"][profile["contact"] == contact]):
            inside = (profile["contact"] == contact) & (profile["chain"] == chain)
            shape.plot(along(profile, inside), profile["depth"][inside], **{**look, "marker": ""})
    depth.set_ylabel(f"greatest worn depth [{units.length}]")
    pressure.set_ylabel(f"greatest pressure [{units.stress}]")
    shape.set_ylabel(f"worn depth at the end [{units.length}]")
    shape.set_xlabel(f"along the slave [{units.length}]")
    shape.invert_yaxis()
    for index, axes in enumerate((depth, pressure, shape)):
        axes.set_title(style.panel(index), loc="left", fontsize=8)
        if axes is not shape:
            axes.set_xlabel("cycles [–]")
            axes.set_ylim(bottom=0)
            axes.set_xlim(left=0)
    if len(worn) > 1:
        depth.legend()
    return figure
