"""draw a load series: what each load and motion needs, and what each contact carries

RUN is a run of own parts with -history 1. Left: each load or motion, its reaction against its displacement; right: the
normal force of each contact, and the tension of each preload, against the share of the load. FILE.pdf has a FILE.png
beside it.
"""

import argparse

from matplotlib.figure import Figure

from postprocess import style
from postprocess.bodies import units_of
from postprocess.output import write_own
from postprocess.results import ResultsError, Run, column_names, read_run, read_table

BASIC = "step fraction".split()
SIZE = (style.PAGE, 0.42 * style.PAGE)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RUN", help="a run's result folder")
    parser.add_argument("--out", metavar="FILE.pdf", help="where to write (default: RUN/curve.pdf)")
    style.add_units(parser)


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws its series and prints the paths."""
    chosen = read_run(arguments.folder)
    with style.look():
        figure = drawn(chosen, units_of(chosen, arguments.units).length)
        write_own(figure, arguments.out, chosen.path / "curve.pdf")


def series(chosen: Run) -> dict:
    """All columns of series.csv; ResultsError where it has none of a case."""
    path = chosen.path / "series.csv"
    read_table(path, BASIC, "; run the case with -history 1")
    return read_table(path, column_names(path))


def drawn(chosen: Run, length: str) -> Figure:
    table = series(chosen)
    pushed = [name.removesuffix(" reaction") for name in table if name.endswith(" reaction")]
    carried = [name for name in table if name.endswith(" normal force") or name.startswith("preload ")]
    if not pushed and not carried:
        raise ResultsError(chosen.path / "series.csv", "has no loads and contacts of a case")
    figure = Figure(figsize=SIZE, layout="constrained")
    left, right = figure.subplots(1, 2)
    for index, name in enumerate(pushed):
        place, force = ([0, *table[f"{name} {what}"]] for what in ("displacement", "reaction"))
        tight = any(other.startswith("preload ") for other in table)  # then the way does not begin at 0
        part = slice(1, None) if tight else slice(None)
        left.plot(place[part], force[part], label=style.plain(name), **style.curve(index))
    for index, name in enumerate(carried):
        share = table["fraction"]
        right.plot(share, table[name], label=style.plain(name), **style.curve(index + len(pushed)))
    left.set_xlabel(f"displacement along the load [{length}]")
    left.set_ylabel("load, or what the motion needs")
    right.set_xlabel("share of the load")
    right.set_ylabel("force carried")
    right.set_xlim(left=0)
    for axes in (left, right):
        if axes.lines:
            axes.legend()
    return figure
