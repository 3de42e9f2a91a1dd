"""seconds, memory and cost ratio against the number of unknowns (results/bench)"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import (
    Campaign,
    Row,
    contact_seconds,
    draw_failures,
    elastic_seconds,
    is_converged,
    name_meshes,
    number,
    numbers,
    read_campaign,
    select,
)
from postprocess.results import ResultsError

RUNS = (1, 1)
READ = read_campaign


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """Contact run and linear elastic solve, with fitted exponents; memory; the ratio of the two. Plane and space."""
    columns = (
        "name scene status order h kappa m ndof memory costRatio seconds_assembly seconds_factorisation seconds_contact"
    )
    rows = select(runs[0].rows("growth", columns), name="growth")
    if not any(map(is_converged, rows)):
        raise ResultsError(runs[0].path / "growth.csv", "no run of it converged")
    problems = sorted(set(map(problem, rows)))
    figure = Figure(figsize=(style.PAGE, 0.45 * style.PAGE), layout="constrained")
    seconds, memory, ratio = figure.subplots(1, 3, sharex=True)
    texts = []
    for index, which in enumerate(problems):
        group = sorted([row for row in rows if problem(row) == which], key=lambda row: number(row, "ndof"))
        done = [row for row in group if is_converged(row)]
        dofs = numbers(done, "ndof")
        ours = np.array([contact_seconds(row) for row in done])
        seconds.plot(dofs, ours, **style.curve(index), label=words(which))
        memory.plot(dofs, numbers(done, "memory") / 1024, **style.curve(index))
        ratio.plot(dofs, numbers(done, "costRatio"), **style.curve(index))
        for axes in (seconds, memory, ratio):
            draw_failures(
                axes, numbers([row for row in group if not is_converged(row)], "ndof"), style.curve(index)["color"]
            )
        if which[0] not in {other[0] for other in problems[:index]}:
            elastic = np.array([elastic_seconds(row) for row in done])
            label = None if index else "linear elastic solve"
            seconds.plot(dofs, elastic, color=style.BLACK, linewidth=0.8, linestyle=(0, (4, 2)), label=label)
            if len(done) > 2:
                powers = f"$n^{{{exponent(dofs, ours):.2f}}}$, elastic $n^{{{exponent(dofs, elastic):.2f}}}$"
                texts.append(f"{place(which[0])}: {powers}")
    seconds.plot([], [], " ", label="CPU time grows as " + "; ".join(texts)) if texts else None
    labels = "CPU time [s]", "memory [GB]", "cost over an elastic solve [–]"
    for index, (axes, label) in enumerate(zip((seconds, memory, ratio), labels, strict=True)):
        axes.set(xlabel="degrees of freedom $n$ [–]", ylabel=label)
        axes.set_title(style.panel(index), loc="left")
        axes.grid(color="0.9", linewidth=0.5)
        style.set_log(axes, "x" if axes is ratio else "xy", 5)
    ratio.set_ylim(1, max(1.4, 1.05 * np.nanmax(numbers([row for row in rows if is_converged(row)], "costRatio"))))
    style.legend_outside(figure, "upper center", ncols=2)
    name_meshes(figure, rows)
    return figure


def problem(row: Row) -> tuple[str, float, float]:
    return row["scene"], number(row, "kappa"), number(row, "m")


def words(which: tuple[str, float, float]) -> str:
    """A problem for the legend."""
    scene, kappa, m = which
    return rf"{place(scene)}, $\kappa = {style.number(kappa)}$, $m = {style.number(m)}$"


def place(scene: str) -> str:
    return "sphere" if scene == "sphere-on-block" else "plane"


def exponent(sizes: np.ndarray, seconds: np.ndarray) -> float:
    """s of seconds ~ sizes^s, least squares in the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])
