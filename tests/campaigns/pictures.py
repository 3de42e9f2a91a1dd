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
from peers import SECONDS
from tables import DOCUMENTS, MARKED

from postprocess import style
from postprocess.output import DRAWN, drawn_numbers, write_files

SIZE = (style.COLUMN, 0.8 * style.COLUMN)
DOTS = 210  # an inch: twice what a screen shows of half a page


def cells(name: str, text: str | None = None) -> list[list[str]]:
    """The rows of a table of tests/RESULTS.md or tests/COST.md, its head first."""
    text = text or "".join(document.read_text() for document in DOCUMENTS)
    (table,) = [found[3] for found in MARKED.finditer(text) if found[2] == name]
    lines = [line for line in table.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if not line.startswith("| ---")]


def least(cells: list[str], part: int = 0) -> np.ndarray:
    """The seconds of cells such as "0.043 P2 / 0.025 P2", of the code at this place; NaN where none was fast enough."""
    found = [re.match(r"[\d.]+", ([*cell.split("/"), ""][part]).strip()) for cell in cells]
    return np.array([float(each[0]) if each else np.nan for each in found])


def elements(cells: list[str], part: int) -> list[str]:
    """The elements in such cells."""
    found = [re.search(r"P\d", [*cell.split("/"), ""][part]) for cell in cells]
    return [each[0] if each else "" for each in found]


# The first cells of the rows of the table `meshes` on the paper's test: words, and what tells the curve from others
METHODS = {
    ("xnewton", "P1"): ("default method, P1", {"color": style.SKY, "marker": "o"}),
    ("xnewton", "P2"): ("default method, P2", {"color": style.BLUE, "marker": "s"}),
    ("xnewton", "P4"): ("default method, P4", {"color": style.BLACK, "marker": "D"}),
    ("newton", "best"): ("Newton, best element", {"color": style.GREEN, "marker": "^"}),
    ("paper, T0 = 0", "best"): ("paper's scheme, best element", {"color": style.ORANGE, "marker": "v"}),
}
LAWS = {"soft": "soft law", "stiff": "stiff law"}
CODES: dict[str, style.Look] = {
    "this package": {"color": style.BLUE, "marker": "o"},
    "NGSolve": {"color": style.VERMILION, "marker": "s"},
    "NGSolve, condensed": {"color": style.GREY, "marker": "^", "linestyle": (0, (1, 1))},
}
WHOLE = "CPU time of the command"


def peers() -> Figure:
    """Error of the force over seconds: (a) methods and elements on the paper's test; (b), (c) whole commands.

    A point is the least seconds to an error, its word the element that takes them. NGSolve is drawn a second time as
    solved on the contact's unknowns.
    """
    figure = Figure(figsize=(style.PAGE, 0.46 * style.PAGE), layout="constrained")
    left, *beside = figure.subplots(1, 3, sharey=True)
    head, *rows = cells("meshes")
    errors = np.array([float(cell) for cell in head[3:]])
    for (method, element), (words, look) in METHODS.items():
        (row,) = [row[3:] for row in rows if row[:3] == ["1e3, 3", method, element]]
        left.plot(*fronts(least(row), errors), label=words, markersize=3.5, linewidth=1, **look)
    for axes, (law, words) in zip(beside, LAWS.items(), strict=True):
        head, *rows = cells("peers-whole")
        errors = np.array([float(cell) for cell in head[1:]])
        (row,) = [row[1:] for row in rows if row[0] == law]
        for part, (name, look) in enumerate(CODES.items()):
            x, y = fronts(least(row, part), errors)
            axes.plot(x, y, markersize=3.5, linewidth=1, label=name, **look)
            named = dict(zip(errors, elements(row, part), strict=True))
            for at, error in zip(x, y, strict=True) if part < 2 else ():  # the words of the third would cover others
                place: style.Look = {"xytext": (5, 0) if part else (-5, 0), "ha": "left" if part else "right"}
                place |= {"va": "center", "color": look["color"], "fontsize": 7}
                axes.annotate(named[error], (at, error), textcoords="offset points", **place)
        axes.set_title(f"{style.panel(list(LAWS).index(law) + 1)} {words}, whole command", loc="left")
    left.set_title(f"{style.panel(0)} methods and elements, soft law", loc="left")
    left.set_ylabel("error of the force [–]")
    for axes, what in zip((left, *beside), (SECONDS, WHOLE, WHOLE), strict=True):
        axes.set_xlabel(f"{what} [s]")
        axes.grid(color="0.92", linewidth=0.4)
        style.set_log(axes, "x", 5)
        least_x, most_x = axes.get_xlim()
        axes.set_xlim(0.75 * least_x, 1.2 * most_x)  # room for the words at both sides
        narrow: style.Look = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.2), "fontsize": 8}
        axes.legend(**narrow)
    style.set_log(left, "y", 7)
    return figure


def fronts(seconds: np.ndarray, errors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of points with the same seconds the smallest error: what these seconds buy."""
    last = np.isfinite(seconds) & np.append(seconds[1:] != seconds[:-1], True)
    return seconds[last], errors[last]


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
    axes.set_xticks(10.0 ** np.arange(-2, 31, 8))
    axes.xaxis.minorticks_off()
    axes.set_ylim(0, 90)
    axes.set_xlabel(r"stiffness $\kappa$ [stress/length$^m$]")
    axes.set_ylabel("Newton steps [–]")
    return figure


PICTURES: dict[str, Callable[[], Figure]] = {"readme-peers.png": peers, "readme-stability.png": stability}


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, nargs="+", required=True, metavar="FILE", help="readme-*.png, one or both")
    for path in parser.parse_args(argv).out:
        written = io.BytesIO()
        with style.look():
            drawn = PICTURES[path.name]()
            drawn.savefig(written, dpi=DOTS, facecolor="white", metadata={DRAWN: drawn_numbers(drawn)})
        write_files({path: written.getvalue()})
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
