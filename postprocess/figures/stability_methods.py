"""linearisations of every method over stiffness and exponent, failures hatched (results/stability)"""

import matplotlib as mpl
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import (
    LAWS,
    METHODS,
    NAMES,
    Campaign,
    exponent_ticks,
    heat_map,
    is_converged,
    law,
    method,
    name_meshes,
    number,
    read_campaign,
    select,
)

RUNS = (1, 1)
READ = read_campaign

MESH = {"h": 0.5, "order": 2}


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """A panel per method, all on one mesh: rows kappa, columns m; below each, the other laws."""
    columns = "name status method T0 law kappa m p0 beta h order newton"
    rows = select(runs[0].rows("stability", columns), **MESH)
    rows = [*select(rows, name="grid"), *select(rows, name="rival")]
    present = [name for name in METHODS if any(method(row) == name for row in rows)]
    groups = {NAMES[name]: [row for row in rows if method(row) == name] for name in present}
    return panels(groups, "newton", "Newton steps to a residual of $10^{-8}$")


def panels(
    groups: dict[str, list[dict]], measure: str, title: str, most: float | None = None, wide: int | None = None
) -> Figure:
    """Heat maps of the greatest count among the rows that share kappa and m, or a law: a panel for each group."""
    every = [row for rows in groups.values() for row in rows]
    others = [name for name in LAWS if any(row["law"] != "power" and law(row) == name for row in every)]
    counted = [number(row, measure) for row in every if is_converged(row)]
    scale = LogNorm(1, most or max([10, *counted]))
    wide = wide or (4 if len(groups) > 4 else 2)
    high = -(-len(groups) // wide)
    figure = Figure(
        figsize=(style.PAGE, style.PAGE * (0.06 + high * {4: 0.34, 3: 0.24}.get(wide, 0.36))), layout="constrained"
    )
    figure.suptitle(f"{title} (hatched: failed; dot: not run)", fontsize=9, x=0.01, ha="left")
    outer = figure.add_gridspec(high, wide)
    for place, (name, rows) in enumerate(groups.items()):
        power = select(rows, law="power")
        kappas = sorted({number(row, "kappa") for row in power})
        exponents = sorted({number(row, "m") for row in power})
        cell = outer[divmod(place, wide)]
        if others:
            inner = cell.subgridspec(2, 1, height_ratios=[len(kappas), 1.0], hspace=0.02)
            above, below = figure.add_subplot(inner[0]), figure.add_subplot(inner[1])
        else:
            above = figure.add_subplot(cell)
        cells = [[select(rows, law="power", kappa=kappa, m=m) for m in exponents] for kappa in kappas]
        heat_map(above, *greatest(cells, measure), (mpl.colormaps["viridis_r"], scale))
        above.set_title(f"{style.panel(place)} {name}", loc="left")
        above.set_yticks(range(len(kappas)), exponent_ticks(kappas))
        above.set_xticks(range(len(exponents)), [f"{m:g}" for m in exponents])
        above.set_ylabel(r"stiffness $\kappa$ [stress/length$^m$]" if place % wide == 0 else "")
        above.set_xlabel("exponent $m$ [–]", labelpad=0)
        if not others:
            continue
        cells = [[[row for row in rows if row["law"] != "power" and law(row) == other] for other in others]]
        heat_map(below, *greatest(cells, measure), (mpl.colormaps["viridis_r"], scale))
        below.set_yticks([])
        below.set_xlabel("other laws")
        below.set_xticks(range(len(others)), [LAWS[other] for other in others], fontsize=7)
    name_meshes(figure, every)
    return figure


def greatest(cells: list[list[list[dict]]], measure: str) -> tuple[np.ndarray, np.ndarray]:
    """Per cell the greatest count of its rows, NaN without any, and whether one of them failed."""
    counts = [
        [max((number(row, measure) for row in cell if is_converged(row)), default=np.nan) for cell in line]
        for line in cells
    ]
    failed = [[any(not is_converged(row) for row in cell) for cell in line] for line in cells]
    return np.array(counts), np.array(failed)
