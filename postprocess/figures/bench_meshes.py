"""errors against the independent reference over meshes, against run time (results/bench)"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import (
    NAMES,
    Campaign,
    draw_failures,
    good,
    look,
    method,
    number,
    numbers,
    read_campaign,
    select,
)

RUNS = (1, 1)
READ = read_campaign

ERRORS = {"forceError": "force", "pressureMaxError": "greatest pressure", "profileError": "pressure profile"}
SHOWN = ("xnewton", "newton", "paper 0")


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """A panel per quantity: the paper's case; solid P2, dashed P1; a point per mesh."""
    rows = runs[0].rows("meshes", f"status method T0 kappa m order h cpu {' '.join(ERRORS)}")
    rows = select(rows, kappa=1e3, m=3.0)
    figure = Figure(figsize=(style.PAGE, 0.42 * style.PAGE), layout="constrained")
    panels = figure.subplots(1, len(ERRORS), sharex=True)
    for axes, (column, title) in zip(panels, ERRORS.items(), strict=True):
        axes.set_xscale("log")
        axes.set_yscale("log")
        for name in SHOWN:
            for order, dashes in ((1, (0, (4, 2))), (2, "-")):
                group = sorted(select([row for row in rows if method(row) == name], order=order), key=size)
                done = [row for row in group if good(row)]
                face = {"markerfacecolor": "white"} if order == 1 else {}
                axes.plot(numbers(done, "cpu"), numbers(done, column), linestyle=dashes, **look(name), **face)
                failed = [row for row in group if not good(row)]
                draw_failures(axes, numbers(failed, "cpu"), look(name)["color"])
        axes.set_title(f"{title}, relative error", loc="left")
        axes.set_xlabel("CPU seconds, whole run")
        axes.grid(color="0.9", linewidth=0.5)
        axes.margins(0.16, 0.1)  # room for the sizes
    mark_sizes(panels[0], rows)
    for name in SHOWN:
        panels[0].plot([], [], **look(name), label=NAMES[name])
    for order, dashes in ((1, (0, (4, 2))), (2, "-")):
        panels[0].plot([], [], color=style.GREY, linestyle=dashes, label=f"P{order}")
    figure.legend(loc="outside upper center", ncols=5)
    return figure


def size(row: dict) -> float:
    return -number(row, "h")


def mark_sizes(axes, rows: list[dict]) -> None:
    """The element sizes, beside the points of the default method with P2."""
    for row in select([row for row in rows if good(row)], method="xnewton", order=2):
        at = (number(row, "cpu"), number(row, "forceError"))
        if np.isfinite(at).all():
            text = f"$h = {style.number(number(row, 'h'))}$"
            axes.annotate(text, at, xytext=(-3, -9), textcoords="offset points", fontsize=7, ha="right")
