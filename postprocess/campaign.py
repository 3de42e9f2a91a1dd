"""Tables of a campaign (results/bench, results/stability), read and checked, and what their figures share.

A row is a run: `status` is "converged" or says how it failed. Cells are kept as text; `number` reads one.
"""

import contextlib
import csv
import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, Normalize
from matplotlib.figure import Figure

from postprocess import style
from postprocess.results import ResultsError, check_file

CONVERGED = "converged"
METHODS = ("xnewton", "paper 0", "paper d0", "newton", "linesearch", "incremental", "ipopt")
NAMES = style.METHODS | {
    "paper 0": "paper's scheme, $T^0 = 0$",
    "paper d0": "paper's scheme, $T^0 = d_0$",
    "incremental": "Newton, 5 load steps",
}
LAWS = {
    "exponential 0.02 60": "exp.\n60",
    "exponential 0.02 500": "exp.\n500",
    "barrier 1": "barrier\n1",
    "barrier 0.0001": "barrier\n$10^{-4}$",
}

Row = dict[str, str]
Cells = dict[str, Any]  # cells that a row is chosen by: texts and numbers


@dataclass(frozen=True)
class Campaign:
    """The folder of a campaign's tables."""

    path: Path

    def rows(self, name: str, columns: str) -> list[Row]:
        """The rows of <name>.csv, which must have these columns and at least one row; a line cut off is left out."""
        path = self.path / f"{name}.csv"
        check_file(path, "; run the campaign first (make bench, make stability)")
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            raise ResultsError(path, "is binary, not a CSV file") from None
        rows = list(csv.DictReader(io.StringIO(text[: text.rfind("\n") + 1])))
        if not rows:
            raise ResultsError(path, "has no rows")
        missing = [column for column in columns.split() if column not in rows[0]]
        if missing:
            raise ResultsError(path, f"wrong columns: no {', '.join(missing)} in the first line")
        if any(None in row or None in row.values() for row in rows):
            raise ResultsError(path, "has rows that are longer or shorter than its first line")
        return rows


def read_campaign(folder: Path | str) -> Campaign:
    path = Path(folder)
    if not path.is_dir():
        raise ResultsError(path, "no such folder" if not path.exists() else "is not a folder")
    return Campaign(path)


def number(row: Row, name: str) -> float:
    """A cell as a number; NaN where it is empty or none."""
    with contextlib.suppress(ValueError):
        return float(row[name])
    return float("nan")


def numbers(rows: list[Row], name: str) -> np.ndarray:
    """(rows,) the cells of a column."""
    return np.array([number(row, name) for row in rows])


def select(rows: list[Row], **wanted: str | float) -> list[Row]:
    """The rows with these cells: a text as it is, a number as a number."""

    def matches(row: Row, name: str, asked: object) -> bool:
        return row[name] == asked if isinstance(asked, str) else number(row, name) == asked

    return [row for row in rows if all(matches(row, name, asked) for name, asked in wanted.items())]


def is_converged(row: Row) -> bool:
    return row["status"] == CONVERGED


def method(row: Row) -> str:
    """The method, for the paper's scheme with its first threshold: one of METHODS."""
    return f"paper {'d0' if row['T0'] == 'd0' else '0'}" if row["method"] == "paper" else row["method"]


def law(row: Row) -> str:
    """Law and parameters of a law other than the power law: one of LAWS."""
    parts = [row["law"], f"{number(row, 'p0'):g}"]
    return " ".join([*parts, f"{number(row, 'beta'):g}"] if row["law"] == "exponential" else parts)


def method_look(name: str) -> dict:
    """Colour and marker of a method, the same in every figure."""
    return style.curve(METHODS.index(name))


def elastic_seconds(row: Row) -> float:
    """Assembly and the one factorisation of the default method: a linear elastic solve of that mesh."""
    return number(row, "seconds_assembly") + number(row, "seconds_factorisation")


def contact_seconds(row: Row) -> float:
    """From assembly to the displacement, without meshing and output."""
    return elastic_seconds(row) + number(row, "seconds_contact")


def name_meshes(figure: Figure, rows: list[Row]) -> None:
    """Below the figure, at its right, the elements of these rows, and from which size to which, where they have one."""
    orders = sorted({int(number(row, "order")) for row in rows})
    sizes = sorted({number(row, "h") for row in rows if row["h"]})
    texts = [f"P{order}" for order in orders]
    if sizes:
        texts.append(f"$h = {sizes[0]:g}$" + (f" to ${sizes[-1]:g}$" if len(sizes) > 1 else ""))
    style.write_below(figure, ", ".join(texts))


def draw_failures(axes: Axes, x: np.ndarray, color: str) -> None:
    """Runs that failed: crosses on the upper edge, at what they cost."""
    if len(x):
        axes.plot(
            x,
            np.full(len(x), 0.97),
            "x",
            transform=axes.get_xaxis_transform(),
            color=color,
            markersize=6,
            markeredgewidth=1.4,
            clip_on=False,
            zorder=6,
        )


def heat_map(
    axes: Axes, counts: np.ndarray, failed: np.ndarray, colors: tuple[Colormap, Normalize], size: float = 7
) -> None:
    """A cell a count, annotated; a cell where a run failed is hatched, one without a run has a dot.

    counts: (rows, columns), NaN where there is no run; failed: (rows, columns) bool. colors: (colormap, norm).
    """
    colormap, scale = colors
    rows, columns = counts.shape
    shown = np.where(failed, np.nan, counts)
    edges = np.arange(columns + 1) - 0.5, np.arange(rows + 1) - 0.5
    axes.pcolormesh(*edges, shown, cmap=colormap, norm=scale, edgecolors="white", linewidth=0.6)
    for i, j in np.argwhere(failed):
        axes.fill(
            [j - 0.5, j + 0.5, j + 0.5, j - 0.5],
            [i - 0.5, i - 0.5, i + 0.5, i + 0.5],
            facecolor="white",
            edgecolor=style.VERMILION,
            hatch="/////",
            linewidth=0.6,
        )
    for i, j in np.argwhere(np.isfinite(shown)):
        red, green, blue, _ = colormap(scale(shown[i, j]))
        dark = 0.299 * red + 0.587 * green + 0.114 * blue < 0.5
        color = "white" if dark else "black"
        axes.text(j, i, f"{shown[i, j]:.0f}", ha="center", va="center", fontsize=size, color=color)
    for i, j in np.argwhere(np.isnan(counts) & ~failed):
        axes.plot([j], [i], marker=".", markersize=2, color=style.GREY)
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)


def exponent_ticks(values: list[float]) -> list[str]:
    """Powers of ten as tick labels."""
    return [f"$10^{{{round(np.log10(value))}}}$" for value in values]
