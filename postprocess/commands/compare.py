"""lay two runs over each other and print their differences

Printed is a table: the values of both runs, the second minus the first, and that relative to the first; then the
parameters in which they differ. FILE.pdf, and FILE.png beside it: pressures, overlaps and residuals of both.
"""

import argparse

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from postprocess import case_report, style
from postprocess.commands.show import value_text
from postprocess.output import write_figure
from postprocess.results import Run, column_names, is_number, read_run

VALUES = (
    "force approach pressureMax overlapMax halfWidth energy residual modelError adaptations newton kernelNewton "
    "factorisations backsolves costRatio contactPoints wallPoints points ndof order h"
).split()


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folders", metavar="RUN", nargs=2, help="two result folders")
    parser.add_argument("--out", metavar="FILE.pdf", help="where to draw them; folders are created")
    style.add_units(parser)


def run(arguments: argparse.Namespace) -> None:
    """Reads both runs, draws them where that is asked for, and prints the table."""
    runs = [read_run(folder) for folder in arguments.folders]
    lines = table(*runs)
    written = []
    if arguments.out:
        with style.look():
            figure = draw(runs, style.Units(*map(style.without_mathtext, arguments.units)))
            written = write_figure(figure, arguments.out)
    print("\n".join([*lines, *map(str, written)]))


def table(first: Run, second: Run) -> list[str]:
    """The lines of the table, in columns."""
    rows = [["", str(first.path), str(second.path), "difference", "relative"]]
    for name in ("scene", "method", "converged"):
        pair = value_text(first.summary[name]), value_text(second.summary[name])
        rows.append([name, *pair, "" if pair[0] == pair[1] else "differs", ""])
    both = [
        {**run.summary, **{f"seconds.{name}": s for name, s in run.summary["seconds"].items()}}
        for run in (first, second)
    ]
    seconds = [name for name in both[0] if name.startswith("seconds.") and name in both[1]]
    warnings = [value_text(len(run.summary.get("warnings", []))) for run in (first, second)]
    rows.append(["warnings", *warnings, "" if warnings[0] == warnings[1] else "differs", ""])
    cases = all(case_report.is_case(run.summary) for run in (first, second))
    if cases:
        results = [case_report.case_results(run.summary) for run in (first, second)]
        for words, (value, _, unit) in results[0].items():
            if words in results[1]:
                rows.append(row(f"{words} [{unit}]" if unit else words, value, results[1][words][0]))
    for name in [*(name for name in VALUES if not cases or name not in case_report.WHOLE), *seconds]:
        if name in both[0] and name in both[1]:
            rows.append(row(name, both[0][name], both[1][name]))
    rows += profiles(first, second)
    given = [run.summary["parameters"] for run in (first, second)]
    different = [
        name for name in {**given[0], **given[1]} if given[0].get(name) != given[1].get(name) and name != "out"
    ]
    for name in different:
        rows.append([f"-{name}", *(value_text(each.get(name)) for each in given), "", ""])
    widths = [max(len(line[column]) for line in rows) for column in range(5)]
    aligned = []
    for line in rows:
        cells = [
            line[0].ljust(widths[0]),
            *(text.rjust(width) for text, width in zip(line[1:], widths[1:], strict=True)),
        ]
        aligned.append("  ".join(cells).rstrip())
    for run in (first, second):
        aligned += [f"warning of {run.path}: {text}" for text in run.summary.get("warnings", [])]
        if run.summary.get("message"):
            aligned.append(f"not converged, {run.path}: {run.summary['message']}")
    return aligned


def row(name: str, first: object, second: object) -> list[str]:
    """A value of both runs, their difference, and that relative to the first's."""
    if not (is_number(first) and is_number(second)):
        return [name, value_text(first), value_text(second), "", ""]
    difference = second - first
    relative = "" if first == 0 or difference == 0 else f"{difference / abs(first):+.1e}"
    shown = f"{difference:+d}" if isinstance(difference, int) else f"{difference:+.3g}"
    return [name, value_text(first), value_text(second), "0" if difference == 0 else shown, relative]


def profiles(first: Run, second: Run) -> list[list[str]]:
    """How far the pressures are from each other; the second's are interpolated to the first's points."""
    x, pressure = first.contact["x"], first.contact["pressure"]
    other = second.contact
    inside = (x >= other["x"][0]) & (x <= other["x"][-1]) if len(other["x"]) else np.zeros(len(x), bool)
    scale = np.abs(pressure).max(initial=0)
    if not inside.any() or scale == 0 or "z" in header(first) or "z" in header(second):
        return []
    difference = np.interp(x[inside], other["x"], other["pressure"]) - pressure[inside]
    greatest = np.abs(difference).max()
    return [["pressure profile, greatest", "", "", f"{greatest:.3g}", f"{greatest / scale:.1e}"]]


def header(run: Run) -> list[str]:
    """The column names of contact.csv: with a z the points lie in a plane, not on a line."""
    return column_names(run.path / "contact.csv")


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Pressures and overlaps of both runs over x, and their residuals over Newton steps."""
    figure = Figure(figsize=(style.PAGE, 0.42 * style.PAGE), layout="constrained")
    pressures, overlaps, residuals = figure.subplots(1, 3)
    names = [
        f"{style.without_mathtext(run.path.name)}: {text}" for run, text in zip(runs, style.labels(runs), strict=True)
    ]
    names = [name if names.count(name) == 1 else f"{name} ({order})" for order, name in enumerate(names, 1)]
    for index, (run, name) in enumerate(zip(runs, names, strict=True)):
        look = style.curve(index) | {"markersize": 3, "linewidth": 0.9, "markerfacecolor": "white"}
        look["linestyle"] = ("-", "--")[index]
        contact = run.contact
        if "z" in header(run):
            look_at = np.hypot(contact["x"], contact["y"])
            look["linestyle"] = "none"
        else:
            look_at = contact["x"]
        every = max(2, len(look_at) // 40)
        shown = index * every // 2, every  # the markers of one run between those of the other
        pressures.plot(look_at, contact["pressure"], label=name, markevery=shown, **look)
        overlaps.plot(look_at, contact["overlap"], markevery=shown, **look)
        history = run.history
        positive = history["residual"] > 0
        residuals.plot(history["newton"][positive], history["residual"][positive], **look)
    touched = [run.contact["overlap"][run.contact["pressure"] > 0] for run in runs]
    reached = np.concatenate(touched)
    if len(reached):
        span = max(float(np.ptp(reached)), 0.02 * abs(float(reached.max())), 1e-300)
        low = reached.min() - 0.5 * span
        overlaps.set_ylim(low, reached.max() + 0.1 * span)
        for line in overlaps.lines:  # points far from contact have no marker at the panel's edge
            line.set_ydata(np.where(line.get_ydata() > low, line.get_ydata(), np.nan))
    across = "distance from the axis" if "z" in header(runs[0]) else "$x$"
    for axes in (pressures, overlaps):
        axes.set_xlabel(f"{across} [{units.length}]")
        axes.xaxis.set_major_locator(MaxNLocator(nbins=6))
    pressures.set_ylabel(f"pressure $p$ [{units.stress}]")
    overlaps.set_ylabel(f"overlap $d$ [{units.length}]")
    residuals.set_ylabel("relative residual [–]")
    residuals.set_xlabel("Newton step [–]")
    style.set_log(residuals, "y")
    residuals.xaxis.set_major_locator(MaxNLocator(integer=True))
    style.legend_outside(figure, "upper left", alignment="left")
    return figure
