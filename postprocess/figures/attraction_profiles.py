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
    given = run.summary["parameters"]
    rows = read_table(run.path / "path.csv", "state leg approach force jump".split(), "the run needs -path")
    table = read_table(run.path / "profiles.csv", "state x pressure overlap".split(), "the run needs -path")
    if given.get("geometry") is None:
        refuse_space(run.path)
    length = run.positive("eps0") if "eps0" in given else 1.0
    figure = Figure(figsize=(style.PAGE, 0.52 * style.PAGE), layout="constrained")
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for panel, (axes, title) in enumerate(zip(panels, ("approach", "separation"), strict=True)):
        of_leg = np.nonzero(rows["leg"] == panel + 1)[0]
        if len(of_leg) == 0:
            continue
        jumps = [index for row in of_leg if rows["jump"][row] for index in (row - 1, row)]
        spread = of_leg[np.unique(np.linspace(0, len(of_leg) - 1, max(2, MOST - len(jumps))).astype(int))]
        near = 0.005 * np.ptp(rows["approach"])  # of a jump: its states would have the same number
        spread = [row for row in spread if np.all(np.abs(rows["approach"][jumps] - rows["approach"][row]) > near)]
        chosen = sorted({*spread, *jumps})[:MOST]
        for index, row in enumerate(chosen):
            here = table["state"] == rows["state"][row]
            when = ", after the jump" if rows["jump"][row] else ", before the jump" if row in jumps else ""
            name = f"{rows['approach'][row] / length:.2f}{when}".replace("-", "\N{MINUS SIGN}")
            colour = style.map_colours(np.array([0.92 * (1 - index / max(len(chosen) - 1, 1))]))[0]  # darker: later
            axes.plot(table["x"][here], table["pressure"][here], color=colour, label=name)
        axes.axhline(0, color=style.GREY, linewidth=0.4)
        axes.set_title(f"{style.panel(panel)} {title}", loc="left")
        axes.set_xlabel(f"$x$ [{units.length}]")
        over = (
            r"approach / equilibrium gap, $\delta/\varepsilon$ [–]" if "eps0" in given else f"approach [{units.length}]"
        )
        below: style.Look = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.22), "title": over, "ncols": 2}
        axes.legend(**below, title_fontsize=8)
    fine = given.get("fine")
    if fine is not None:
        panels[0].set_xlim(0 if given.get("geometry") == "axisymmetric" else -fine, fine)
    panels[0].set_ylabel(f"pressure [{units.stress}]")
    style.name_elements(figure, runs)
    return figure
