"""draw stresses and displacements along a line that a case has named

RUN is a run of own parts whose case has `line NAME ...`. Left: von Mises' stress with its error as a band, which is
left out where it is not known, and the principal stresses; right: the displacement. FILE.pdf has a FILE.png beside it.
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from postprocess import style
from postprocess.bodies import units_of
from postprocess.output import write_figure_of_run
from postprocess.results import ResultsError, Run, Table, column_names, read_run, read_table

SIZE = (style.PAGE, 0.42 * style.PAGE)
COLUMNS = "distance x y ux uy stress1 stress2 stress3 vonMises vonMisesError displacementError".split()


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RUN", help="a run's result folder")
    parser.add_argument("name", metavar="NAME", nargs="?", help="which line (default: the only one)")
    parser.add_argument("--out", metavar="FILE.pdf", help="where to write (default: RUN/line-NAME.pdf)")
    style.add_units(parser)


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws its line and prints the paths."""
    chosen = read_run(arguments.folder)
    path = table_of(chosen, arguments.name)
    with style.look():
        write_figure_of_run(draw_line(path, units_of(chosen, arguments.units)), arguments.out, path.with_suffix(".pdf"))


def table_of(chosen: Run, name: str | None) -> Path:
    """The file of a line."""
    found = sorted(chosen.path.glob("line-*.csv"))
    if name is None and len(found) != 1:
        names = ", ".join(path.stem.removeprefix("line-") for path in found)
        raise ResultsError(chosen.path, f"which line? There are: {names}" if found else "no line in its case")
    return found[0] if name is None else chosen.path / f"line-{name}.csv"


def read_line(path: Path) -> Table:
    """The columns that are drawn; an error that is not known is inf."""
    space = path.is_file() and "uz" in column_names(path)
    return read_table(path, [*COLUMNS, *(["uz"] if space else [])], "; name it in the case: line NAME ...")


def draw_line(path: Path, units: style.Units) -> Figure:
    table = read_line(path)
    at = table["distance"]
    figure = Figure(figsize=SIZE, layout="constrained")
    left, right = figure.subplots(1, 2)
    steps = np.diff(at)
    breaks = np.flatnonzero(steps > 1.5 * np.median(steps)) + 1 if len(at) > 2 else np.empty(0, int)

    def curve(axes: Axes, values: np.ndarray, error: np.ndarray, label: str, color: str) -> None:
        # places that were asked have less than their neighbours: no comb of it
        beside = np.where(np.isfinite(error), error, 0)
        beside = np.maximum(beside, np.maximum(np.r_[beside[1:], 0], np.r_[0, beside[:-1]]))
        error = np.where(np.isfinite(error), beside, error)
        for k, part in enumerate(np.split(np.arange(len(at)), breaks)):
            axes.plot(at[part], values[part], color=color, label=label if k == 0 else None)
            known = np.isfinite(error[part])
            low, high = values[part] - error[part], values[part] + error[part]
            axes.fill_between(
                at[part], np.where(known, low, 0), np.where(known, high, 0), where=known, color=color, alpha=0.25, lw=0
            )

    unknown = np.full(len(at), np.inf)
    for k, color in ((1, style.BLUE), (2, style.GREEN), (3, style.PURPLE)):
        curve(left, table[f"stress{k}"], unknown, f"principal, {'greatest middle least'.split()[k - 1]}", color)
    curve(left, table["vonMises"], table["vonMisesError"], "von Mises, with its error", style.VERMILION)
    for name, color in zip(("ux", "uy", "uz"), (style.BLUE, style.VERMILION, style.GREEN), strict=True):
        if name in table:
            curve(right, table[name], table["displacementError"], f"along {name[1]}", color)
    left.set_ylabel(f"stress [{units.stress}]")
    right.set_ylabel(f"displacement [{units.length}]")
    for axes in (left, right):
        axes.set_xlabel(f"distance along the line [{units.length}]")
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1))
    return figure
