"""a meshed disc as it stiffens: pressure against the rigid disc's, and the differences over the ratio of the moduli"""

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.figures.figure2 import check_comparable
from postprocess.reference_values import scene_of
from postprocess.results import ResultsError, Run

RUNS = (3, 9)


def draw(runs: list[Run], units: style.Units) -> Figure:
    """(a) p over x of the rigid disc, a line, and of the softest; (b) each disc's difference from it over x.

    (c) force, and greatest difference of pressure over the rigid disc's greatest one, over E disc/E block; with the
    slope of each, least squares over the runs where the disc is at least ten times stiffer.
    """
    rigid, *meshed = runs
    scene_of(rigid, "disc-on-block")
    for run in meshed:
        scene_of(run, "meshed-disc")
        check_comparable(run, rigid)
        if not np.array_equal(run.contact["x"], rigid.contact["x"]):
            raise ResultsError(run.path / "contact.csv", f"has other points than {rigid.path / 'contact.csv'}")
    meshed.sort(key=lambda run: run.positive("Eratio"))
    ratio = np.array([run.positive("Eratio") for run in meshed])
    figure = Figure(figsize=(style.COLUMN, 2.0 * style.COLUMN), layout="constrained")
    left, middle, right = figure.subplots(3, 1)
    middle.sharex(left)
    shown = np.abs(rigid.contact["x"]) <= 0.7 * rigid.parameter("R")
    x = rigid.contact["x"][shown]
    for index, run in enumerate(meshed):
        look = style.curve(index) | {"linestyle": "none", "markersize": 3.5, "markerfacecolor": "white"}
        name = rf"$E_{{\mathrm{{disc}}}}/E = {style.number(ratio[index])}$"
        pressure, top = run.contact["pressure"][shown], rigid.contact["pressure"].max()
        apart = np.abs(pressure - rigid.contact["pressure"][shown]) / top
        middle.plot(x, np.where(apart > 0, apart, np.nan), label=name, **look | {"markersize": 2.5})
        if index == 0:
            left.plot(x, pressure, label=name, **look)
    left.plot(x, rigid.contact["pressure"][shown], color=style.BLACK, linewidth=0.9, label="rigid disc", zorder=1)
    middle.set_xlabel(f"$x$ [{units.length}]")
    middle.set_ylabel("difference of pressure [–]")
    style.set_log(middle, "y")
    left.tick_params(labelbottom=False)
    left.set_ylabel(f"pressure $p$ [{units.stress}]")
    left.set_ylim(0, None)
    for index, (what, difference) in enumerate(differences(rigid, meshed).items()):
        stiff = (ratio >= 10) & (difference > 0)
        label = what
        if np.count_nonzero(stiff) > 1:
            slope = np.polyfit(np.log(ratio[stiff]), np.log(difference[stiff]), 1)[0]
            label = f"{what}, slope ${slope:.2f}$"
        right.plot(
            ratio,
            difference,
            label=label,
            **style.curve(index) | ({"linestyle": "--", "markerfacecolor": "white"} if index else {}),
        )
    style.set_log(right, "xy", 5)
    right.set_xlabel(r"$E_{\mathrm{disc}}/E$ [–]")
    right.set_ylabel("greatest difference [–]")
    for index, axes in enumerate((left, middle, right)):
        axes.set_title(style.panel(index), loc="left")
    figure.align_ylabels()
    right.legend()
    handles, names = middle.get_legend_handles_labels()
    style.legend_outside(figure, "upper center", [left.lines[-1], *handles], ["rigid disc", *names], ncols=2)
    style.name_elements(figure, runs)
    return figure


def differences(rigid: Run, meshed: list[Run]) -> dict[str, np.ndarray]:
    """(runs,) relative differences from the rigid disc's run: of the force, of the pressure at its worst point."""
    pressure = rigid.contact["pressure"]
    return {
        "pressure": np.array([np.abs(run.contact["pressure"] - pressure).max() for run in meshed]) / pressure.max(),
        "force": np.array([abs(run.value("force") / rigid.value("force") - 1) for run in meshed]),
    }
