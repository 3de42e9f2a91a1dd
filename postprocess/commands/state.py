"""draw a run's bodies under their load, with the pressure along the contact

RUN is a result folder of any run made with -vtu 1, the default. Written are RUN/state.pdf and RUN/state.png, or what
--out names. In the plane: the bodies, the surroundings of the greatest pressure, and the pressure over the arc length;
in space: the bodies from outside, and for each contact the pressure on its surface, seen along its normal.
With friction the shear stands beside the pressure, and what sticks and slips is coloured.
"""

import argparse

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from postprocess import bodies as drawn
from postprocess import style
from postprocess.bodies import Bodies, write_picture
from postprocess.results import ResultsError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    style.add_picture(parser, "state")


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws it, writes both files and prints their paths."""
    write_picture(arguments, "state", draw)


def draw(bodies: Bodies, units: style.Units, view: np.ndarray, slide: bool = False) -> Figure:
    """The figure, one column of a page wide, or a slide."""
    return in_space(bodies, units, view, slide) if bodies.grid.space else in_plane(bodies, units, slide=slide)


def in_plane(bodies: Bodies, units: style.Units, stress: bool = False, slide: bool = False) -> Figure:
    """(a) the bodies, (b) what is about the greatest pressure if that is small, (c) the pressure over the arc length.

    With `stress` the bodies are coloured by von Mises' stress.
    """
    whole, close = drawn.plane_window(bodies)
    zoom = np.ptp(close[:, 0]) < 0.5 * np.ptp(whole[:, 0])
    windows = [whole, close] if zoom else [whole]
    # the boxes' own shape beside labels and colour bar
    wide = 0.68 if stress else 0.84
    tall = [min(1.0, max(0.25, np.ptp(box[:, 1]) / np.ptp(box[:, 0]))) * wide for box in windows] + [0.42]
    inches = style.COLUMN * (sum(tall) + 0.18 * len(tall))
    figure, panels = style.panels(tall, inches, slide)
    for axes, box in zip(panels, windows, strict=False):
        colours = drawn.fill_plane(axes, bodies, stress)
        drawn.stand_pressure(axes, bodies, drawn.tall(bodies, box))
        axes.set_xlim(*box[:, 0])
        axes.set_ylim(*box[:, 1])
        axes.set_aspect("equal")
        axes.set_xlabel(f"$x$ [{units.length}]")
        axes.set_ylabel(f"$y$ [{units.length}]")
        if colours is not None:
            bar = {"location": "bottom", "pad": 0.02} if slide else {"pad": 0.01, "shrink": 0.95}
            figure.colorbar(colours, ax=axes, label=f"von Mises [{units.stress}]", aspect=18, **bar)
    if zoom:
        size = np.ptp(close, axis=0)
        panels[0].add_patch(Rectangle(close[0], *size, fill=False, linewidth=0.6, zorder=6))
    drawn.plot_pressure(panels[-1], bodies, units)
    for index, axes in enumerate(panels):
        drawn.title(axes, index, drawn.motion(bodies, units) if index == 0 and not slide else "")
    if slide:
        figure.suptitle(drawn.motion(bodies, units), x=0.02, ha="left", fontsize=8)
    return figure


def in_space(bodies: Bodies, units: style.Units, view: np.ndarray, slide: bool = False) -> Figure:
    """(a) the bodies from outside, then the pressure on each contact's surface."""
    pressed = [contact for contact in range(len(bodies.names)) if bodies.touching(contact).any()]
    if not pressed:
        raise ResultsError(bodies.run.path / "contact.csv", "no point is in contact")
    rubs = "slide" in bodies.table
    rows = [0.8] + [0.8] * (1 + rubs) * len(pressed)
    figure, panels = style.panels(rows, sum(rows) * style.COLUMN, slide, "compressed")
    drawn.draw_shell(panels[0], bodies, view, None, 1.0)
    figure.suptitle(f"{style.panel(0)} {drawn.motion(bodies, units)}", x=0.03, ha="left", fontsize=8)
    for index, (contact, axes) in enumerate(zip(pressed, panels[1:], strict=False), start=1):
        colours = drawn.map_pressure(axes, bodies, contact, units, bodies.coloured)
        figure.colorbar(colours, ax=axes, label=f"pressure [{units.stress}]")
        drawn.title(axes, index, style.plain(bodies.names[contact]))
    for index, contact in enumerate(pressed if rubs else [], start=1 + len(pressed)):
        greatest = drawn.map_shear(panels[index], bodies, contact, units)
        words = f"{style.plain(bodies.names[contact])} shear, up to ${style.number(greatest)}$"
        drawn.title(panels[index], index, words.lstrip())
    return figure
