"""force against approach of load series (runs with -history 1); of one run on a rough surface that surface too"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from postprocess import style
from postprocess.closed_forms import rough_profile
from postprocess.results import Run, read_table

RUNS = (1, 7)

COLUMNS = "step fraction approach force pressureMax overlapMax contactPoints newton backsolves".split()


def draw(runs: list[Run], units: style.Units) -> Figure:
    """(a) force over approach, a curve a run, from first touch on; (b) the share of points in contact.

    Of one run (c) the pressure at its end over x, and of the scene rough (d) both surfaces there, heights enlarged.
    """
    alone = len(runs) == 1
    rough = alone and runs[0].summary["scene"] == "rough"
    heights = [1.4, 1] + [1] * (alone + rough)
    figure = Figure(figsize=(style.COLUMN, 0.42 * sum(heights) * style.COLUMN), layout="constrained")
    panels = list(figure.subplots(len(heights), 1, height_ratios=heights))
    force, share = panels[:2]
    share.sharex(force)
    for index, run in enumerate(runs):
        rows = read_table(run.path / "series.csv", COLUMNS, "the run needs -history 1")
        touched = rows["force"] > 0
        before = np.flatnonzero(~touched & (np.cumsum(touched) == 0))  # steps before first touch
        name = f"{run.summary['scene'].replace('-', ' ')}, {style.method(run)}"
        if len(before):  # an obstacle that touches nothing comes nearer by what it is moved
            gap = run.parameter("d0") - rows["overlapMax"][before[-1]]
            rows = {key: np.insert(values[touched], 0, 0) for key, values in rows.items()} | {
                "approach": np.insert(rows["approach"][touched], 0, rows["approach"][before[-1]] + gap)
            }
            if index == 0:
                mark_touch(force, rows["approach"][0])
        else:
            rows = {key: values[touched] for key, values in rows.items()}
        force.plot(rows["approach"], rows["force"], label=name, **style.curve(index))
        share.plot(rows["approach"], 100 * rows["contactPoints"] / run.summary["points"], **style.curve(index))
    force.set_ylabel(f"force [{units.stress}\n× {units.length}]")
    share.set_ylabel("points in\ncontact [%]")
    share.set_xlabel(f"approach [{units.length}]")
    for axes in (force, share):
        axes.set_ylim(0, None)
    if alone:
        draw_end(panels[2:], runs[0], units)
    titles = ["", "", f"at approach {rows['approach'][-1]:.3g}", "both surfaces there, heights enlarged"]
    for index, (axes, words) in enumerate(zip(panels, titles, strict=False)):
        axes.set_title(f"{style.panel(index)} {words}", loc="left", pad=3)
    for axes in (force, *panels[2:-1]):
        axes.tick_params(labelbottom=False)
    if len(runs) > 1:
        style.legend_outside(figure, "upper center", *force.get_legend_handles_labels())
    figure.align_ylabels()
    style.name_elements(figure, runs)
    return figure


def mark_touch(axes: Axes, approach: float) -> None:
    """Where the first asperities touch, in words."""
    axes.plot([approach], [0], marker="|", markersize=12, color=style.GREY, clip_on=False)
    axes.text(0.03, 0.9, f"first touch at {approach:.3g}", transform=axes.transAxes, color=style.GREY, fontsize=8)


def draw_end(panels: list, run: Run, units: style.Units) -> None:
    """The pressure at the end of the series, and of the scene rough the surfaces: the block's, the wall above it."""
    x, pressure = run.contact["x"], run.contact["pressure"]
    panels[0].plot(x, pressure, color=style.BLUE, linewidth=0.7)
    panels[0].set_ylabel(f"pressure\n[{units.stress}]")
    panels[0].set_ylim(0, None)
    panels[-1].set_xlabel(f"$x$ [{units.length}]")
    for axes in panels[1:]:
        axes.sharex(panels[0])
        wall = -rough_profile(x, *(run.parameter(name) for name in ("width", "modes", "hurst", "rms", "seed")))
        block = wall + run.contact["s"]
        top, bottom = wall.max() + 0.3 * np.ptp(wall), block.min() - 0.3 * np.ptp(wall)
        axes.fill_between(x, wall, top, color="#E9E6E1", linewidth=0)
        axes.plot(x, wall, color="#6E675F", linewidth=0.7)
        axes.fill_between(x, block, bottom, color="#DCE9F3", linewidth=0)
        axes.plot(x, block, color=style.BLUE, linewidth=0.7)
        axes.set_ylabel(f"height\n[{units.length}]")
        axes.set_ylim(bottom, top)
        for text, at in (("rough wall", 0.88), ("block, pressed", 0.06)):
            axes.text(0.5, at, text, transform=axes.transAxes, ha="center", fontsize=8)
    panels[0].margins(x=0)
