"""seconds, memory and cost ratio against the number of unknowns (results/bench)"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import (
    Campaign,
    contact_seconds,
    draw_failures,
    elastic_seconds,
    good,
    number,
    numbers,
    read_campaign,
    select,
)
from postprocess.results import ResultsError

RUNS = (1, 1)
READ = read_campaign


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """Contact run and linear elastic solve, with fitted exponents; memory; the ratio of the two."""
    columns = "name status method kappa m ndof memory costRatio seconds_assembly seconds_factorisation seconds_contact"
    rows = select(runs[0].rows("growth", columns), name="growth")
    if not any(map(good, rows)):
        raise ResultsError(runs[0].path / "growth.csv", "no run of it converged")
    laws = list(dict.fromkeys((number(row, "kappa"), number(row, "m")) for row in rows))
    figure = Figure(figsize=(style.PAGE, 0.42 * style.PAGE), layout="constrained")
    seconds, memory, ratio = figure.subplots(1, 3, sharex=True)
    for index, (kappa, m) in enumerate(laws):
        group = sorted(select(rows, kappa=kappa, m=m), key=lambda row: number(row, "ndof"))
        done = [row for row in group if good(row)]
        dofs = numbers(done, "ndof")
        label = rf"$\kappa = {style.number(kappa)}$, $m = {style.number(m)}$"
        ours = np.array([contact_seconds(row) for row in done])
        seconds.plot(dofs, ours, **style.curve(index), label=label)
        memory.plot(dofs, numbers(done, "memory") / 1024, **style.curve(index))
        ratio.plot(dofs, numbers(done, "costRatio"), **style.curve(index))
        for axes in (seconds, memory, ratio):
            draw_failures(axes, numbers([row for row in group if not good(row)], "ndof"), style.curve(index)["color"])
        if index == 0:
            elastic = np.array([elastic_seconds(row) for row in done])
            seconds.plot(dofs, elastic, color=style.BLACK, linestyle=(0, (4, 2)), label="linear elastic solve")
            if len(done) > 2:
                texts = [f"contact: $\\propto n^{{{exponent(dofs, ours):.2f}}}$"]
                texts.append(f"elastic: $\\propto n^{{{exponent(dofs, elastic):.2f}}}$")
                seconds.text(0.97, 0.05, "\n".join(texts), transform=seconds.transAxes, ha="right", fontsize=8)
    for axes, title in ((seconds, "CPU seconds"), (memory, "memory [GB]"), (ratio, "cost ratio")):
        axes.set_xscale("log")
        axes.set_title(title, loc="left")
        axes.set_xlabel("degrees of freedom $n$")
        axes.grid(color="0.9", linewidth=0.5)
    seconds.set_yscale("log")
    memory.set_yscale("log")
    ratio.axhline(2, color=style.GREY, linewidth=0.8, linestyle=(0, (4, 2)))
    ratio.set_ylim(1, max(2.2, 1.1 * np.nanmax(numbers([row for row in rows if good(row)], "costRatio"))))
    figure.legend(loc="outside upper center", ncols=5)
    return figure


def exponent(sizes: np.ndarray, seconds: np.ndarray) -> float:
    """s of seconds ~ sizes^s, least squares in the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])
