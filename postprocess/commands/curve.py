"""draw the load curve of a case, step by step: reactions over displacements, what contacts carry, energies

RUN is a run of your own model with -history 1, or with load phases (leg). (a) each load or motion: its
reaction over its displacement; (b) the normal force of each contact, and the tension of each preload; (c) the energies.
The command prints the greatest and the least reaction of each load or motion, and its work. FILE.pdf has a FILE.png
beside it.
"""

import argparse

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from postprocess import style
from postprocess.formatting import Units
from postprocess.load_series import Curve, load_curves, load_phases, read_series
from postprocess.output import write_figure_of_run
from postprocess.results import Run, read_run

ENERGIES = {"work": "work of the loads", "stored": "stored", "stored energy": "stored", "dissipated": "dissipated"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    style.add_output(parser, "curve")
    style.add_units(parser)


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws its series, prints the extremes and the paths."""
    chosen = read_run(arguments.folder)
    units = Units(chosen.summary, arguments.units)
    for each in load_curves(read_series(chosen)):
        print(extremes(each, units))
    thickness = chosen.summary.get("thickness", 1)
    if thickness != 1:
        print(
            f"forces, moments and work are of a unit of thickness; all {thickness:g} carry {thickness:g} times as much"
        )
    with style.look():
        figure = draw_curves(chosen, units)
        write_figure_of_run(figure, arguments.out, chosen.path / "curve.pdf")


def extremes(each: Curve, units: Units) -> str:
    """The greatest and the least reaction of a load or motion, where they occur, and the work up to the end."""
    force, way = (units.moment, "rad") if each.turns else (units.force, units.length)
    parts = []
    for word, at in (("greatest", int(np.argmax(each.force))), ("least", int(np.argmin(each.force)))):
        parts.append(f"{word} {number_with_unit(each.force[at], force)} at {number_with_unit(each.way[at], way)}")
    return f"{each.name}: {', '.join(parts)}; work {number_with_unit(each.work()[-1], units.energy)}"


def number_with_unit(number: float, unit: str) -> str:
    return f"{number:.5g}" + (f" {unit}" if unit else "")


def label_with_unit(words: str, unit: str, kind: str) -> str:
    """An axis label; where nothing names the unit, its brackets hold the kind of the quantity."""
    return f"{words} [{unit or kind}]"


def draw_curves(chosen: Run, units: Units) -> Figure:
    """The figure: two panels, or three if the energies are known."""
    table = read_series(chosen)
    pushed = load_curves(table)
    carried = [name for name in table if name.endswith(" normal force") or name.startswith("preload ")]
    energies = [name for name in ENERGIES if name in table]
    panels = 3 if energies else 2
    width = 52 if panels == 2 else 32
    figure = Figure(figsize=(style.PAGE, (0.42 if panels == 2 else 0.34) * style.PAGE), layout="constrained")
    axes = figure.subplots(1, panels)
    for index, each in enumerate(pushed):
        axes[0].plot(each.way, each.force, label=wrapped_label(each.name, width), **style.curve(index))
    phased = load_phases(table)[-1] > 1
    place = table["step"] if phased or "fraction" not in table else table["fraction"]
    tight = any(name.startswith("preload ") for name in carried)  # bolts carry before the first step
    for index, name in enumerate(carried):
        x, y = (place, table[name]) if tight else (np.append(0, place), np.append(0, table[name]))
        axes[1].plot(x, y, label=wrapped_label(name, width), **style.curve(index + len(pushed)))
    for index, name in enumerate(energies):
        axes[2].plot(np.append(0, place), np.append(0, table[name]), label=ENERGIES[name], **style.curve(index))
    turns = pushed and all(each.turns for each in pushed)
    axes[0].set_xlabel(
        "rotation [rad]" if turns else label_with_unit("displacement along the load", units.length, "length")
    )
    axes[0].set_ylabel(
        label_with_unit(*("moment", units.moment, "moment") if turns else ("reaction", units.force, "force"))
    )
    axes[1].set_ylabel(label_with_unit("force carried", units.force, "force"))
    for each in axes[1:]:
        each.set_xlabel("load step [–]" if place is table["step"] else "share of the load [–]")
        each.xaxis.set_major_locator(MaxNLocator(nbins=6, integer=place is table["step"]))
    if energies:
        axes[2].set_ylabel(label_with_unit("energy", units.energy, "energy"))
    for each in axes:
        each.update_datalim([(0, 0)])
        each.autoscale_view()
        each.axhline(0, color=style.GREY, linewidth=0.5, zorder=0)
        each.axvline(0, color=style.GREY, linewidth=0.5, zorder=0)
    for each in axes[1:]:
        each.set_xlim(left=0)
        ends = np.flatnonzero(np.diff(load_phases(table))) if phased else np.empty(0, int)
        for end in ends:
            each.axvline(table["step"][end], color=style.GREY, linewidth=0.5, linestyle=":", zorder=0)
    name_curves(figure, axes)
    return style.finish_layout(figure)


def wrapped_label(words: str, width: int) -> str:
    return style.without_mathtext(style.wrapped(words, width))


def name_curves(figure: Figure, axes: np.ndarray) -> None:
    """The names of each panel's curves above it; the page grows with the longest list, for the panels to stay."""
    found = [each.legend(loc="lower left", bbox_to_anchor=(0, 1)) for each in axes if each.lines]
    most = max(sum(1 + text.get_text().count("\n") for text in legend.get_texts()) for legend in found)
    figure.set_figheight(figure.get_figheight() + 0.15 * most)
