"""One look for all figures: fonts, colours, widths, and the words for methods, runs and units."""

import argparse
import contextlib
import re
import textwrap
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from string import ascii_lowercase
from typing import Any

import matplotlib as mpl
import matplotlib.style
import numpy as np
from cycler import cycler
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis, XAxis
from matplotlib.figure import Figure, SubFigure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.legend import Legend
from matplotlib.text import Text
from matplotlib.ticker import FixedFormatter, FixedLocator, LogLocator, NullFormatter, NullLocator
from matplotlib.tri import Triangulation

from postprocess.results import ResultsError, Run, is_number

COLUMN = 85 / 25.4  # inches: one column of a journal page
PAGE = 180 / 25.4  # inches: two columns
DPI = 300

# Okabe and Ito's palette, distinct for all common kinds of colour blindness.
BLACK, GREY = "#000000", "#7F7F7F"
BLUE, VERMILION, GREEN, ORANGE = "#0072B2", "#D55E00", "#009E73", "#E69F00"
PURPLE, SKY = "#CC79A7", "#56B4E9"
CURVES = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
MARKERS = ("o", "s", "^", "D", "v", "P", "X")

Look = dict[str, Any]  # keyword arguments of matplotlib's drawing functions

# behind text that stands on a picture
HALO: Look = {"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}

# Methods in words: their names on the command line say nothing in a legend.
METHODS = {
    "xnewton": "default method",
    "paper": "paper's scheme",
    "newton": "Newton",
    "linesearch": "Newton, line search",
    "signorini": "hard contact",
    "ipopt": "Ipopt",
}

RC: Look = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.labelsize": 9,
    "legend.fontsize": 8,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.prop_cycle": cycler(color=CURVES),
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "lines.linewidth": 1.2,
    "lines.markersize": 4,
    "legend.frameon": False,
    "legend.handlelength": 1.8,
    "pdf.fonttype": 42,  # TrueType: text stays text
    "savefig.dpi": DPI,
}


@dataclass(frozen=True)
class Units:
    """Names of the units that a run's numbers are in, for axis labels."""

    length: str = "length unit"
    stress: str = "force/area unit"


def add_units(parser: argparse.ArgumentParser) -> None:
    """The flag --units LENGTH STRESS of every command that draws."""
    parser.add_argument(
        "--units",
        nargs=2,
        metavar=("LENGTH", "STRESS"),
        default=(Units.length, Units.stress),
        help="names of the units in the axis labels, such as mm MPa",
    )


def add_output(parser: argparse.ArgumentParser, name: str, written: str = "") -> None:
    """The run, and --out, of a command that draws it into its own folder."""
    parser.add_argument("folder", metavar="RUN", help="a run's result folder")
    written = written or f"{name}.pdf"
    parser.add_argument("--out", metavar=written.replace(name, "FILE"), help=f"where to write (default: RUN/{written})")


def add_picture(parser: argparse.ArgumentParser, name: str, written: str = "") -> None:
    """The arguments of a command that draws one run's bodies into its own folder."""
    add_output(parser, name, written)
    parser.add_argument(
        "--scale",
        type=lambda text: None if text == "auto" else float(text),
        default=1.0,
        metavar="S",
        help="draw the displacements S times; auto: so that the largest can be seen",
    )
    parser.add_argument(
        "--view",
        nargs=2,
        type=float,
        metavar=("AZIMUTH", "ELEVATION"),
        help="in space: where the eye is, degrees from x towards y, and above; default: where it sees the contact",
    )
    if not written or written.endswith(".pdf"):
        parser.add_argument("--slide", action="store_true", help="panels side by side on a page of 16:9, for a slide")
    add_units(parser)


def figure_with_panels(page: list[tuple[str, float]], slide: str, is_slide: bool) -> tuple[Figure, dict[str, Axes]]:
    """A figure and its panels by letter: rows on a page, a column wide, or a mosaic of 16:9.

    page: the letters side by side in a row, and its height over the width; slide: rows of letters as of matplotlib's
    mosaics.
    """
    mosaic = slide.split() if is_slide else [row for row, _ in page]
    across = np.lcm.reduce([len(row) for row in mosaic])
    cells: list[Any] = [[letter for letter in row for _ in range(across // len(row))] for row in mosaic]
    if is_slide:
        figure = Figure(figsize=(PAGE, PAGE * 9 / 16), layout="constrained")
        return figure, figure.subplot_mosaic(cells)
    heights = [height for _, height in page]
    figure = Figure(figsize=(COLUMN, sum(heights) * COLUMN), layout="constrained")
    return figure, figure.subplot_mosaic(cells, height_ratios=heights)


def finish_layout(figure: Figure) -> Figure:
    """A figure whose bars beside panels of a fixed shape have their room: one round of the layout does not see them.

    Ticks stay as they are after the first rounds: those of a panel that grows would take more room than was left.
    """
    for _ in range(4):
        layout_of(figure).execute(figure)
    titles = {axes: axes.get_title(loc="left") for axes in figure.axes}
    for _ in range(3):
        set_ticks(figure)
        name_powers(figure)
        fold_titles(figure, titles)
        layout_of(figure).execute(figure)
    return figure


def legend_outside(
    figure: Figure | SubFigure,
    place: str,
    handles: Iterable[Artist] | None = None,
    labels: Iterable[str] | None = None,
    **options: Any,
) -> Legend:
    """A figure's legend beyond all axes, for which the constrained layout leaves room.

    place: the side first, as "upper center", "lower left", "right upper". handles, labels: as of Figure.legend; without
    them all curves with labels. matplotlib has such legends from 3.7 on. Before, the layout's rectangle leaves room.
    """
    given = {"handles": handles, "labels": labels}
    entries: Look = options | {name: value for name, value in given.items() if value is not None}
    if mpl.__version_info__ >= (3, 7):
        entries["loc"] = f"outside {place}"
        return figure.legend(**entries)
    root = figure.figure  # of a part of a figure the whole: the rectangle is the whole figure's
    side, along = place.split()
    if handles is None:
        entries["handles"], entries["labels"] = curves_of(figure)
    entries["loc"] = f"{along} {side}" if side == "right" else place
    legend = root.legend(**entries)
    engine = layout_of(root)
    box, pads = legend.get_window_extent().transformed(root.transFigure.inverted()), engine.get()
    across, up = root.get_size_inches()  # the layout's pads are in inches
    room = box.width + 2 * pads["w_pad"] / across if side == "right" else box.height + 2 * pads["h_pad"] / up
    left, bottom, width, height = pads["rect"]
    right, top = left + width, bottom + height
    right = min(right, 1 - room) if side == "right" else right
    top = min(top, 1 - room) if side == "upper" else top
    bottom = max(bottom, room) if side == "lower" else bottom
    engine.set(rect=(left, bottom, right - left, top - bottom))
    return legend


def layout_of(figure: Figure) -> ConstrainedLayoutEngine:
    """The layout engine of a figure that was made with layout="constrained"."""
    engine = figure.get_layout_engine()
    if not isinstance(engine, ConstrainedLayoutEngine):
        raise TypeError(f"the figure has no constrained layout, but {engine!r}")
    return engine


def figure_of(axes: Axes) -> Figure:
    """The whole figure that a panel belongs to."""
    figure = axes.figure
    return figure.figure if isinstance(figure, SubFigure) else figure


def curves_of(figure: Figure | SubFigure) -> tuple[list[Artist], list[str]]:
    """The curves with labels of all panels of a figure, or of a part of one, and these labels."""
    handles: list[Artist] = []
    labels: list[str] = []
    for axes in figure.axes:
        found = axes.get_legend_handles_labels()
        handles, labels = handles + found[0], labels + found[1]
    return handles, labels


def every_axes(figure: Figure) -> list[Axes]:
    """Panels and bars, with those that stand beside a panel."""
    return [each for axes in figure.axes for each in (axes, *axes.child_axes) if isinstance(each, Axes) and each.axison]


def name_powers(figure: Figure) -> None:
    """A power of ten that all ticks share stands in the axis' label, before the unit: beside it there is no room."""
    for axes in every_axes(figure):
        for axis in (axes.xaxis, axes.yaxis):
            axis.get_majorticklabels()
            shared = re.search(r"(?:e|10\^\{)([\u2212-]?\d+)", axis.get_major_formatter().get_offset())
            words = axis.get_label_text()
            if shared and "[" in words and "[$10^" not in words:
                axis.set_label_text(words.replace("[", f"[$10^{{{shared[1]}}}$ "))
                axis.get_offset_text().set_visible(False)


def set_ticks(figure: Figure) -> None:
    """Of the ticks of all linear axes as many, or every second one, as their labels leave room for."""
    for axes in every_axes(figure):
        axes.apply_aspect()
        for axis in (axes.xaxis, axes.yaxis):
            if axis.get_scale() != "linear":
                continue
            low, high = sorted(axis.get_view_interval())
            near = 1e-9 * (high - low)
            ticks = [tick for tick in axis.get_majorticklocs() if low - near <= tick <= high + near]
            axis.set_major_locator(FixedLocator(ticks))
            while len(ticks) > 1 and tick_labels_overlap(axis):
                # with the one at zero, where there is one
                zero = next((k for k, tick in enumerate(ticks) if abs(tick) < near), 0)
                ticks = ticks[zero % 2 :: 2]
                axis.set_major_locator(FixedLocator(ticks))


def tick_labels_overlap(axis: Axis) -> bool:
    """Does a tick's label touch the next one?"""
    boxes = [label.get_window_extent() for label in axis.get_majorticklabels() if label.get_text()]
    side = 0 if isinstance(axis, XAxis) else 1
    ends = sorted((box.min[side], box.max[side]) for box in boxes)
    return any(a[1] + 2 * axis.figure.dpi / 100 > b[0] for a, b in pairwise(ends))


def fold_titles(figure: Figure, titles: dict[Axes, str]) -> None:
    """Titles at the left of panels in more lines, where they would leave the figure or reach the panel beside."""
    for axes in figure.axes:
        place, text, before = axes.get_position(), titles[axes], axes.get_title(loc="left")
        rows = [other.get_position() for other in figure.axes if not hasattr(other, "_colorbar")]
        ends = [row.x0 for row in rows if row.x0 > place.x0 + 0.02 and row.y0 < place.y1 and place.y0 < row.y1]
        most = figure.bbox.width * min([1.0, *ends]) - figure.dpi / 40
        own = [bar.get_tightbbox() for bar in axes.child_axes]
        most = min([most, *(bar.x0 for bar in own if bar is not None and bar.y1 > axes.bbox.y1 + figure.dpi / 12)])
        drawn = [each for each in axes.findobj(Text) if before and each.get_text() == before]
        for each in drawn:
            each.set_text(text)
        width = max(map(len, text.split("\n")))
        while drawn and width > 16 and drawn[0].get_window_extent().x1 > most:
            width -= 1
            drawn[0].set_text(wrapped(text.replace("\n", " "), width))


def wrapped(text: str, width: int) -> str:
    """A title in lines of so many letters at most, none cut."""
    return "\n".join(textwrap.wrap(text, width, break_on_hyphens=False)) or text


def round_below(value: float) -> float:
    """The greatest of 1, 2, 5, 10, 20 ... up to a number."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * max(step for step in (1, 2, 5) if step <= value / power * (1 + 1e-12)))


@contextlib.contextmanager
def look() -> Iterator[None]:
    """Within this context figures are drawn and saved in the package's style, whatever the user's own settings."""
    with matplotlib.style.context(["default", RC]):
        yield


def curve(index: int) -> Look:
    """Colour and marker of the curve with this number, both different from its neighbours'."""
    return {"color": CURVES[index % len(CURVES)], "marker": MARKERS[index % len(MARKERS)]}


def number(value: float) -> str:
    """A number as mathtext without its dollars: 0.25, 1000, 10^{6}, 3.2 x 10^{-9}."""
    if value == 0 or 1e-3 <= abs(value) < 1e4:
        return f"{value:.4g}"
    mantissa, exponent = f"{value:.1e}".split("e")
    mantissa = mantissa.removesuffix(".0")
    power = f"10^{{{int(exponent)}}}"
    return {"1": power, "-1": f"-{power}"}.get(mantissa, rf"{mantissa} \times {power}")


def power_text(value: float) -> str:
    """A positive number as a power of ten, for readers: 10^{-3}, 2 x 10^{-3}, as mathtext."""
    mantissa, exponent = f"{value:.1e}".split("e")
    mantissa = mantissa.removesuffix(".0")
    return f"${'' if mantissa == '1' else mantissa + chr(92) + 'times '}10^{{{int(exponent)}}}$"


def without_mathtext(text: str) -> str:
    """Text from a file or the command line, which is not to be read as mathtext."""
    return text.replace("$", r"\$")


def count(amount: int, noun: str) -> str:
    """ "1 adaptation", "3 adaptations"."""
    return f"{amount} {noun}" if amount == 1 else f"{amount} {noun}s"


def method(run: Run) -> str:
    """The run's method in words, with the first threshold or the number of load steps where it has one."""
    name = run.summary["method"]
    parameters = run.summary["parameters"]
    if name == "incremental":
        steps = parameters.get("steps")
        return f"Newton, {count(int(steps), 'load step')}" if is_number(steps) else "Newton in load steps"
    words = METHODS.get(name, without_mathtext(name))
    first = first_threshold(run)
    return f"{words}, ${first}$" if name not in ("newton", "signorini") and first else words


def law_text(run: Run) -> str:
    """The run's law in words: hard contact, or its name, or kappa and m of a power law."""
    law = run.summary["parameters"].get("law", "power")
    if run.summary["method"] == "signorini" or law == "signorini":
        return "hard contact"
    if law == "power":
        return rf"$\kappa = {number(run.parameter('kappa'))}$, $m = {number(run.parameter('m'))}$"
    return without_mathtext(str(law))


def cost_text(run: Run, noun: str) -> str:
    """What the run took: adaptations, where there was more than one, and steps; and whether that was enough."""
    words = count(run.summary["newton"], noun)
    if run.summary["adaptations"] > 1:
        words = f"{count(run.summary['adaptations'], 'adaptation')}, {words}"
    return words if run.summary["converged"] else f"{words}, not converged"


def first_threshold(run: Run) -> str:
    """The first threshold T^0 as mathtext without its dollars; empty when the run has none."""
    parameters = run.summary["parameters"]
    start = parameters.get("T0")
    if start is None:
        return ""
    if isinstance(start, str) and start != "d0":
        with contextlib.suppress(ValueError):
            start = float(start)
    if start == "d0" or start == parameters.get("d0"):
        return "T^0 = d_0"
    return f"T^0 = {number(start)}" if is_number(start) else ""


def labels(runs: list[Run]) -> list[str]:
    """A legend entry per run: its method, and of order, h, kappa, m and tol those in which the runs differ."""
    described = {
        "order": lambda value: f"P{int(value)}",
        "h": lambda value: f"$h = {number(value)}$",
        "kappa": lambda value: rf"$\kappa = {number(value)}$",
        "m": lambda value: f"$m = {number(value)}$",
        "tol": lambda value: f"tol $= {number(value)}$",
    }
    texts = [[method(run)] for run in runs]
    for key, describe in described.items():
        values = [run.summary.get(key, run.summary["parameters"].get(key)) for run in runs]
        if len(set(map(str, values))) > 1:
            for text, value in zip(texts, values, strict=True):
                if is_number(value):
                    text.append(describe(value))
    joined = [", ".join(text) for text in texts]
    return [
        f"{text} ({without_mathtext(run.path.name)})" if joined.count(text) > 1 else text
        for text, run in zip(joined, runs, strict=True)
    ]


def elements(runs: list[Run]) -> str:
    """Element and size of the runs' meshes, as far as they have them in common: "P2, h = 0.25" with h as mathtext."""
    orders = {run.summary["order"] for run in runs}
    sizes = {run.summary["h"] for run in runs}
    texts = [f"P{int(*orders)}"] if len(orders) == 1 else []
    if len(sizes) == 1 and all(map(is_number, sizes)):
        texts.append(f"$h = {number(*sizes)}$")
    return ", ".join(texts)


def name_elements(figure: Figure, runs: list[Run]) -> None:
    """Below the figure, at its right, element and size of the meshes."""
    write_below(figure, elements(runs))


def write_below(figure: Figure, text: str) -> None:
    """A text below the figure, at its right."""
    figure.supxlabel(text, x=0.995, ha="right", fontsize=8, color=GREY)


def labelled_indices(amount: int) -> set[int]:
    """Which curves of a sequence are named in a figure: all of a few, else the first, the last and some between."""
    return set(range(amount)) if amount <= 6 else set(np.linspace(0, amount - 1, 5).round().astype(int).tolist())


def set_log(axes: Axes, which: str, most: int = 6, ends: tuple[float, float] | None = None) -> None:
    """Logarithmic axes "x", "y" or "xy" over the curves drawn so far: at most so many labels, near both ends one.

    Curves of panels that share the axis count too. Labels are 1, 1.5, 2, 3, 5, 7 times a power of ten, or fewer, down
    to every second or third power. ends: what the axis shows, where that is not all of the curves.
    """
    for name in which:
        axis, side = getattr(axes, f"{name}axis"), "xy".index(name)
        lines = [
            line
            for each in getattr(axes, f"get_shared_{name}_axes")().get_siblings(axes)
            for line in each.lines
            if line.get_transform() == each.transData
        ]
        values = np.concatenate([[], *(np.asarray(line.get_xydata(), float)[:, side] for line in lines)])
        values = values[np.isfinite(values) & (values > 0)]
        low, high = ends or (float(values.min(initial=np.inf)), float(values.max(initial=0)))
        if low > high / 1.5:  # no curve, or one value
            low, high = (low / 2, high * 2) if high else (0.1, 1.0)
        ticks = log_ticks(low, high, most)
        margin = (max(high, ticks[-1]) / min(low, ticks[0])) ** 0.04
        getattr(axes, f"set_{name}scale")("log")
        getattr(axes, f"set_{name}lim")(min(low / margin, ticks[0]), max(high * margin, ticks[-1]))
        plain = ticks[0] > 5e-4 and ticks[-1] < 5e3
        axis.set_major_locator(FixedLocator(ticks))
        axis.set_major_formatter(FixedFormatter([f"{tick:g}" if plain else power_text(tick) for tick in ticks]))
        axis.set_minor_formatter(NullFormatter())
        axis.set_minor_locator(LogLocator(subs="auto") if np.ptp(np.log10(ticks)) < len(ticks) else NullLocator())


def log_ticks(low: float, high: float, most: int) -> list[float]:
    """Ticks from below to above these numbers, or but a little within them."""
    near = 1 + 1e-9
    first, last = int(np.floor(np.log10(low) + 1e-9)), int(np.ceil(np.log10(high) - 1e-9))
    decades = range(first, last + 1)
    every = [[10.0**k * step for k in decades for step in steps] for steps in ((1, 1.5, 2, 3, 5, 7), (1, 2, 5), (1, 3))]
    coarse = len(every)
    every += [[10.0**k for k in range(last, first - step, -step)][::-1] for step in range(1, 12)]
    for number, ticks in enumerate(every):
        enough = 1.25 if number < coarse else 2.4  # of a value to the last label, which can still be read there
        below = [tick for tick in ticks if tick <= low * near][-1:]
        above = [tick for tick in ticks if tick * near >= high][:1]
        found = [tick for tick in ticks if low < tick < high and tick not in below + above]
        # an end is left out where the next label is near enough to read the value
        below = [] if len(found) > 1 and found[0] < enough * low else below
        above = [] if len(found) > 1 and found[-1] > high / enough else above
        if 2 <= len(below + found + above) <= most:
            return below + found + above
    return [low, high]


def contact_triangulation(run: Run) -> Triangulation:
    """The contact points of a run in space, joined by triangles as they are seen along z."""
    try:
        return Triangulation(run.contact["x"], run.contact["y"])
    except (ValueError, RuntimeError):
        raise ResultsError(run.path / "contact.csv", "its points make no surface") from None


def panel(index: int) -> str:
    """(a), (b), (c) ..."""
    return f"({ascii_lowercase[index]})"


def map_colours(share: np.ndarray, name: str = "viridis") -> np.ndarray:
    """(n, 3) colours of a map for numbers in [0, 1]."""
    return mpl.colormaps[name](np.clip(share, 0, 1))[:, :3]
