"""pressure under a body that attracts, at several approaches of a path (a run with -path, not in space)"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.results import Run, read_table, refuse_space

RUNS = (1, 1)

MOST = 7  # profiles


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Left on the way in, right on the way out: pressures at states spread over each, the jumps' among them."""
    (run,) = runs
    rows = read_table(run.path / "path.csv", "state leg approach force jump".split(), "the run needs -path")
    table = read_table(run.path / "profiles.csv", "state x pressure overlap".split(), "the run needs -path")
    if run.summary["parameters"].get("geometry") is None:
        refuse_space(run.path)
    length = run.positive("eps0") if "eps0" in run.summary["parameters"] else 1.0
    figure = Figure(figsize=(style.PAGE, 0.45 * style.PAGE), layout="constrained")
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for panel, (axes, title) in enumerate(zip(panels, ("loading", "unloading"), strict=True)):
        of_leg = np.nonzero(rows["leg"] == panel + 1)[0]
        if len(of_leg) == 0:
            continue
        jumps = [index for row in of_leg if rows["jump"][row] for index in (row - 1, row)]
        spread = of_leg[np.unique(np.linspace(0, len(of_leg) - 1, max(2, MOST - len(jumps))).astype(int))]
        chosen = sorted({*spread, *jumps})[:MOST]
        for index, row in enumerate(chosen):
            here = table["state"] == rows["state"][row]
            name = rf"$\delta/\varepsilon$ = {rows['approach'][row] / length:.2f}" + (
                ", jumped" if rows["jump"][row] else ""
            )
            colour = style.map_colours(np.array([0.92 * (1 - index / max(len(chosen) - 1, 1))]))[0]  # darker: later
            axes.plot(table["x"][here], table["pressure"][here], color=colour, label=name)
        axes.axhline(0, color=style.GREY, linewidth=0.4)
        axes.set_title(f"{style.panel(panel)} {title}", loc="left")
        axes.set_xlabel(f"x [{units.length}]")
        axes.legend(loc="upper right", fontsize=7.5)
    fine = run.summary["parameters"].get("fine")
    if fine is not None:
        panels[0].set_xlim(0 if run.summary["parameters"].get("geometry") == "axisymmetric" else -fine, fine)
    down, up = panels[0].get_ylim()
    panels[0].set_ylim(down, up + 0.15 * (up - down))
    panels[0].set_ylabel(f"pressure [{units.stress}]")
    style.name_elements(figure, runs)
    return figure
