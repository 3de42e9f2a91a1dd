"""draw von Mises' stress in a run's bodies, with the contact pressure

RUN is a result folder of any run made with -vtu 1, the default. Written are RUN/stress.pdf and RUN/stress.png, or what
--out names. In the plane: the deformed bodies coloured by the stress, whole and about the greatest pressure, and the
pressure over the arc length; in space: their surface from outside, the section through the point of greatest pressure,
and for each contact the pressure on its surface.
"""

import argparse
from dataclasses import replace

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation

from postprocess import bodies as drawn
from postprocess import style
from postprocess.bodies import Bodies, write_picture
from postprocess.commands import state
from postprocess.vtu import cut


def add_arguments(parser: argparse.ArgumentParser) -> None:
    style.add_picture(parser, "stress")


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws it, writes both files and prints their paths."""
    write_picture(arguments, "stress", draw)


def draw(bodies: Bodies, units: style.Units, view: np.ndarray, slide: bool = False) -> Figure:
    """The figure, one column of a page wide, or a slide."""
    return in_space(bodies, units, view, slide) if bodies.grid.space else state.in_plane(bodies, units, True, slide)


def in_space(bodies: Bodies, units: style.Units, view: np.ndarray, slide: bool = False) -> Figure:
    """(a) the surface, (b) the section, then the pressure on the surface of the contact that carries most of it."""
    most = int(bodies.table["contact"][bodies.table["pressure"].argmax()])
    figure, panels = style.panels([0.8, 0.7, 0.8], 2.3 * style.COLUMN, slide, "compressed")
    top = bodies.grid.stress.max()
    drawn.draw_shell(panels[0], bodies, view, bodies.grid.stress, top)
    colours = draw_section(panels[1], bodies, units)
    figure.colorbar(colours, ax=panels[:2], label=f"von Mises [{units.stress}]", pad=0.01, shrink=0.7)
    pressed = drawn.map_pressure(panels[2], bodies, most, units, bodies.coloured)
    figure.colorbar(pressed, ax=panels[2], label=f"pressure [{units.stress}]")
    figure.suptitle(f"{style.panel(0)} {drawn.motion(bodies, units)}", x=0.03, ha="left", fontsize=8)
    for index, words in enumerate(["section", style.plain(bodies.names[most])], start=1):
        drawn.title(panels[index], index, words)
    return figure


def draw_section(axes, bodies: Bodies, units: style.Units):
    """The section by the plane through the point of greatest pressure that holds its normal, with the outlines."""
    grid, at = bodies.grid, int(bodies.table["pressure"].argmax())
    flat, words = drawn.facing(bodies.normals[at])
    # rows: along the surface, across the section, along the normal; cut() takes the second coordinate for the level
    frame = np.array([flat[0], -flat[1], flat[2]])
    turned = replace(grid, points=grid.points @ frame.T, move=bodies.scale * grid.move @ frame.T)
    level = bodies.surface.points[at] @ frame[1]
    aside = 1e-6 * np.ptp(grid.points, axis=0).max()
    sections = [cut(turned, level + way * aside) for way in (1, -1)]
    pieces, stress, outline = max(sections, key=lambda section: len(section[0]))
    corner = np.arange(4 * len(pieces)).reshape(-1, 4)
    triangles = np.concatenate([corner[:, [0, 1, 2]], corner[:, [0, 2, 3]]])
    place = pieces.reshape(-1, 2)[triangles]
    longest = np.square(np.roll(place, 1, axis=1) - place).sum(axis=2).max(axis=1)
    # without needles, which shading would colour far beyond their ends
    full = abs(np.linalg.det(place[:, 1:] - place[:, :1])) > 0.01 * longest
    mesh = Triangulation(*pieces.reshape(-1, 2).T, triangles[full])
    look = {"cmap": "viridis", "shading": "gouraud", "vmin": 0, "vmax": grid.stress.max(), "rasterized": True}
    colours = axes.tripcolor(mesh, stress.ravel(), **look)
    axes.add_collection(LineCollection(outline, color=style.BLACK, linewidth=0.5))
    touched = bodies.points[bodies.touching(int(bodies.table["contact"][at]))] @ frame.T
    middle, half = bodies.points[at] @ frame.T, 1.5 * np.ptp(touched, axis=0).max()
    for limits, at, reach, values in (
        (axes.set_xlim, middle[0], half, pieces[..., 0]),
        (axes.set_ylim, middle[2], 0.75 * half, pieces[..., 1]),
    ):
        limits(max(at - reach, values.min()), min(at + reach, values.max()))
    axes.set_aspect("equal")
    normal = next((f"${name}$" for k, name in enumerate("xyz") if abs(flat[2][k]) > 1 - 1e-9), "along the normal")
    axes.set_xlabel(f"{words[0]} [{units.length}]")
    axes.set_ylabel(f"{normal} [{units.length}]")
    return colours
