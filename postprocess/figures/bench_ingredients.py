"""what each ingredient of the method saves: linearisations and back-substitutions, scene by scene (results/bench)"""

import matplotlib as mpl
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import LAWS, Campaign, heat_map, is_converged, law, name_meshes, number, read_campaign

RUNS = (1, 1)
READ = read_campaign

FLAGS = {
    "start": {"none": "no start"},
    "preconditioner": {"diagonal": "diagonal preconditioner", "none": "no preconditioner"},
    "inner": {"newton": "plain Newton steps"},
    "threshold": {"pointwise": "pointwise thresholds"},
    "T0": {"0": "$T^0 = 0$", "d0": "$T^0 = d_0$"},
}
SCENES = {
    "disc-on-block": "rigid disc",
    "meshed-disc": "meshed disc",
    "confined-block": "confined block",
    "wavy": "wave",
    "flat-punch": "flat punch",
}
MEASURES = {"newton": "linearisations", "backsolves": "back-substitutions"}


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """A row per exchange of ingredients, a column per scene and law; hatched where the run failed."""
    rows = runs[0].rows("ingredients", "flags scene status order h law kappa m p0 beta newton backsolves")
    variants = list(dict.fromkeys(map(variant, rows)))
    columns = list(dict.fromkeys((row["scene"], words(row)) for row in rows))
    figure = Figure(figsize=(style.PAGE, 0.92 * style.PAGE), layout="constrained")
    panels = figure.subplots(len(MEASURES), 1, sharex=True)
    for index, (axes, (measure, title)) in enumerate(zip(panels, MEASURES.items(), strict=True)):
        counts = np.full((len(variants), len(columns)), np.nan)
        failed = np.zeros(counts.shape, bool)
        for row in rows:
            at = variants.index(variant(row)), columns.index((row["scene"], words(row)))
            counts[at] = number(row, measure)
            failed[at] |= not is_converged(row)
        most = max(np.nanmax(counts), 10)
        heat_map(axes, counts, failed, (mpl.colormaps["viridis_r"], LogNorm(1, most)), size=7)
        axes.set_yticks(range(len(variants)), variants, fontsize=7)
        axes.invert_yaxis()
        axes.set_ylabel("exchanged ingredients")
        axes.set_title(f"{style.panel(index)} {title} (hatched: failed)", loc="left")
        for place in range(1, len(columns)):
            if columns[place][0] != columns[place - 1][0]:
                axes.axvline(place - 0.5, color=style.BLACK, linewidth=0.8)
    panels[-1].set_xticks(range(len(columns)), [text for _, text in columns], rotation=90, fontsize=7)
    for scene in dict.fromkeys(scene for scene, _ in columns):
        places = [place for place, column in enumerate(columns) if column[0] == scene]
        above = panels[0].get_xaxis_transform()
        panels[0].text(np.mean(places), 1.03, SCENES.get(scene, scene), transform=above, ha="center", fontsize=7.5)
    panels[-1].set_xlabel(r"stiffness $\kappa$ [stress/length$^m$], exponent $m$ [–]; or another law")
    panels[0].set_title(panels[0].get_title(loc="left"), loc="left", pad=16)
    name_meshes(figure, rows)
    return figure


def variant(row: dict) -> str:
    """The ingredients that the run's flags exchange."""
    texts = row["flags"].split()
    flags = dict(zip(texts[::2], texts[1::2], strict=True))
    found = [told[flags[f"-{name}"]] for name, told in FLAGS.items() if f"-{name}" in flags]
    if len(found) == len(FLAGS):
        return f"all of these, {found[-1]}"
    return ", ".join(found) or "default"


def words(row: dict) -> str:
    if row["law"] != "power":
        return LAWS.get(law(row), law(row)).replace("\n", " ")
    return rf"${style.number(number(row, 'kappa'))}$, ${style.number(number(row, 'm'))}$"
