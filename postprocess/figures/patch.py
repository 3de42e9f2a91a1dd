"""patch tests: pressure between two meshes that do not match over its exact value, in the plane and in space"""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.reference_values import patch_pressure
from postprocess.results import Run

RUNS = (1, 6)


def draw(runs: list[Run], units: style.Units) -> Figure:
    """p/p exact - 1 in per cent: (a) the plane runs over x, then a map of the surface for each run in space.

    The exact pressure is uniform: the law in series with two confined blocks. The maps share their colours.
    """
    plane = [run for run in runs if run.summary["scene"] == "patch-test"]
    space = [run for run in runs if run not in plane]
    off = [100 * (run.contact["pressure"] / patch_pressure(run) - 1) for run in plane + space]
    rows: list[Any] = [["plane"] * max(len(space), 1)] * bool(plane) + [
        [f"space {number}" for number in range(len(space))]
    ] * bool(space)
    figure = Figure(figsize=(style.COLUMN, 0.68 * len(rows) * style.COLUMN), layout="constrained")
    panels = list(figure.subplot_mosaic(rows).values())
    maps = panels[1:] if plane else panels
    for index, (run, error) in enumerate(zip(plane, off[: len(plane)], strict=True)):
        panels[0].plot(run.contact["x"], error, label=words(run, error), **style.curve(index) | {"linewidth": 0.9})
    if plane:
        panels[0].set_xlabel(f"$x$ [{units.length}]")
        panels[0].set_ylabel(r"$p/p_{\mathrm{exact}} - 1$ [%]")
        panels[0].legend(loc="lower center", bbox_to_anchor=(0.5, 1.08))
        panels[0].set_title("(a) plane", loc="left")
    greatest = max((np.abs(error).max() for error in off[len(plane) :]), default=0)
    for axes, run, error in zip(maps, space, off[len(plane) :], strict=True):
        look: style.Look = {"cmap": "RdBu_r", "vmin": -greatest, "vmax": greatest, "rasterized": True}
        colours = axes.tripcolor(style.contact_triangulation(run), error, shading="gouraud", **look)
        axes.plot(run.contact["x"], run.contact["y"], ".", color=style.BLACK, markersize=1.5)
        axes.set_aspect("equal")
        axes.set_xlabel(f"$x$ [{units.length}]")
        axes.label_outer()
    if space:
        maps[0].set_ylabel(f"$y$ [{units.length}]")
        height = (1.03, 0, 0.06, 1)  # that of the panel
        figure.colorbar(colours, cax=maps[-1].inset_axes(height), label=r"$p/p_{\mathrm{exact}} - 1$ [%]")
    for index, (axes, run, error) in enumerate(zip(maps, space, off[len(plane) :], strict=False), start=bool(plane)):
        axes.set_title(
            f"{style.panel(index)} space, {words(run, error)}".replace(", ", ",\n").replace(": ", ":\n"),
            loc="left",
            fontsize=8,
        )
    style.write_below(figure, meshes(runs))
    return figure


def meshes(runs: list[Run]) -> str:
    """The runs' element, and how many of them the two bodies have along a side, in the plane and in space."""
    sides = {"plane" if run.summary["scene"] == "patch-test" else "space": run.summary["parameters"] for run in runs}
    kinds = [f"{given['lower']} and {given['upper']} ({where})" for where, given in sides.items() if "lower" in given]
    return f"P{runs[0].summary['order']}" + (f", elements a side: {', '.join(kinds)}" if kinds else "")


def words(run: Run, error: np.ndarray) -> str:
    """How the overlaps are taken, and the greatest error (per cent)."""
    taken = run.summary["parameters"].get("points", "")
    points = {"nodal": "overlaps at nodes", "segment": "averaged overlaps"}.get(
        taken, style.without_mathtext(str(taken))
    )
    return f"{points}: at most ${style.number(float(f'{np.abs(error).max():.2g}'))}$ %"
