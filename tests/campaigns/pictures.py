"""The README's two pictures of campaigns, from the tables that `make tables` has written: no campaign is run for them.

`python tests/campaigns/pictures.py --out FILE ...` writes readme-peers.png, readme-stability.png: legible at 85 mm.
"""

import argparse
import io
import re
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from tables import DOCUMENTS, MARKED

from postprocess import style
from postprocess.output import write_files

SIZE = (style.COLUMN, 0.8 * style.COLUMN)
DOTS = 210  # an inch: twice what a screen shows of half a page


def cells(name: str, text: str | None = None) -> list[list[str]]:
    """The rows of a table of tests/RESULTS.md or tests/COST.md, its head first."""
    text = text or "".join(document.read_text() for document in DOCUMENTS)
    (table,) = [found[3] for found in MARKED.finditer(text) if found[2] == name]
    lines = [line for line in table.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if not line.startswith("| ---")]


def seconds(cell: str) -> tuple[float, float]:
    """Package's and NGSolve's, of a cell such as "0.043 P2 / 0.025 P2"; NaN where the error was not reached."""
    both = [re.match(r"[\d.]+", part.strip()) for part in (cell or "/").split("/")]
    return tuple(float(found[0]) if found else np.nan for found in both)


# The table's first column: words, colour, line
PROBLEMS = {
    "1e3, 3": (r"$\kappa = 10^3$, $m = 3$", style.BLUE, "-"),
    "1e3, 10": (r"$m = 10$", style.BLUE, "--"),
    "1e3, 20": (r"$m = 20$", style.BLUE, ":"),
    "cylinders, 1e3, 3": ("two cylinders", style.BLACK, "-."),
    "1e9, 3": (r"$\kappa = 10^9$", style.ORANGE, "-"),
    "1e12, 3": (r"$\kappa = 10^{12}$", style.VERMILION, "-"),
    "sphere, 1e3, 3": (r"sphere, $\kappa = 10^3$", style.GREEN, "--"),
    "sphere, 1e9, 3": (r"sphere, $\kappa = 10^9$", style.GREEN, "-"),
}

CONDENSED = ("1e3, 3", "1e9, 3", "1e12, 3")  # laws of the table of the condensed peer


def peers() -> Figure:
    """NGSolve's least CPU seconds over this package's, to the same error: a line a problem.

    Dotted, with open marks: the half of the block against NGSolve on the contact's unknowns.

    A triangle at its end: one of the codes did not reach the next error.
    """
    head, *rows = cells("peers")
    found = {problem: cells for problem, *cells in rows}
    errors = np.array([float(cell) for cell in head[1:]])
    figure = Figure(figsize=(SIZE[0], 1.2 * SIZE[1]), layout="constrained")
    axes = figure.subplots()
    axes.axhline(1, color=style.GREY, linewidth=0.8)
    for problem, (words, colour, line) in PROBLEMS.items():
        if problem not in found:
            continue
        ours, theirs = np.array([seconds(cell) for cell in found[problem]]).T
        ratio = theirs / ours
        axes.plot(errors, ratio, color=colour, linestyle=line, marker="o", markersize=3.5, label=words)
        last = int(np.flatnonzero(np.isfinite(ratio))[-1])
        for reached, mark, level in ((ours, "^", 2), (theirs, "v", 0.5)):
            if last + 1 < len(errors) and np.isfinite(reached[last + 1]):
                way = [(errors[last], ratio[last]), (errors[last + 1], ratio[last] * level)]
                axes.plot(*zip(*way, strict=True), color=colour, linestyle=line, linewidth=0.8)
                axes.plot(*way[1], color=colour, marker=mark, markersize=6)
    head, *rows = cells("peers-condensed")
    errors = np.array([float(cell) for cell in head[2:]])
    for which in CONDENSED:
        (row,) = [row[2:] for row in rows if row[0] == which and row[1] == "half"]
        ours, theirs = np.array([seconds(cell) for cell in row]).T
        look = {"color": PROBLEMS[which][1], "markerfacecolor": "white", "linewidth": 1, "linestyle": (0, (1, 1))}
        axes.plot(errors, theirs / ours, marker="s", markersize=4.5, **look)
    look = {"color": style.GREY, "markerfacecolor": "white", "linestyle": (0, (1, 1)), "marker": "s", "markersize": 4.5}
    axes.plot([], [], label="half, NGSolve condensed", **look)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(4e-3, 5e-8)  # the smaller error to the right
    axes.set_xticks([1e-3, 1e-4, 1e-5, 1e-6, 1e-7])
    axes.xaxis.minorticks_off()
    axes.set_yticks([0.3, 1, 3, 10], ["0.3", "1", "3", "10"])
    axes.set_ylim(0.15, 40)
    axes.yaxis.minorticks_off()
    axes.set_xlabel("error in force")
    axes.set_ylabel("NGSolve's seconds / this package's")
    grey = {"transform": axes.transAxes, "color": style.GREY, "fontsize": 8.5}
    axes.text(0.02, 0.04, "NGSolve takes less;\n▼: it alone gets there", ha="left", **grey)
    axes.text(0.98, 0.96, "this package takes less;\n▲: it alone gets there", ha="right", va="top", **grey)
    style.legend_outside(figure, "lower center", ncols=2, fontsize=8.5, handlelength=2.4)
    return figure


def stability() -> Figure:
    """Newton steps over stiffness: plain Newton by exponent, the default method's least and most over all exponents."""
    head, *rows = cells("newton-map")
    across = np.array([float(row[0]) for row in rows])
    figure = Figure(figsize=SIZE, layout="constrained")
    axes = figure.subplots()
    shades = ("#F4B183", "#E8863C", style.VERMILION, "#8C3D00")  # exponents are ordered: one hue, ever darker
    for column, (exponent, colour) in enumerate(zip(head[1:], shades, strict=True), 1):
        steps = [int(row[column]) for row in rows]
        axes.plot(across, steps, color=colour, marker="o", markersize=3.5)
        words = exponent.removeprefix("m = ")
        axes.annotate(
            f"$m = {words}$", (across[-1], steps[-1]), (5, -3), textcoords="offset points", color=colour, fontsize=8.5
        )
    counts = np.array([[int(cell.split("/")[0]) for cell in row[1:]] for row in cells("counts-map")[1:]])
    axes.fill_between(across, counts.min(axis=1), counts.max(axis=1), color=style.BLUE, linewidth=3)
    axes.annotate(
        f"default method: {counts.min()} to {counts.max()},\nany $m$ from 1.05 to 30",
        (across[-2], counts[-2].max()),
        (0, 1),
        textcoords="offset points",
        color=style.BLUE,
        ha="left",
        va="bottom",
        fontsize=8.5,
    )
    axes.text(0.02, 0.93, "plain Newton", transform=axes.transAxes, color=shades[2], fontsize=9)
    axes.set_xscale("log")
    axes.set_xlim(across[0] / 10, 1e5 * across[-1])
    axes.set_xticks(10.0 ** np.arange(0, 31, 6))
    axes.xaxis.minorticks_off()
    axes.set_ylim(0, 90)
    axes.set_xlabel(r"stiffness $\kappa$")
    axes.set_ylabel("Newton steps")
    return figure


PICTURES: dict[str, Callable[[], Figure]] = {"readme-peers.png": peers, "readme-stability.png": stability}


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, nargs="+", required=True, metavar="FILE", help="readme-*.png, one or both")
    for path in parser.parse_args(argv).out:
        written = io.BytesIO()
        with style.look():
            PICTURES[path.name]().savefig(written, dpi=DOTS, facecolor="white")
        write_files({path: written.getvalue()})
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
