"""steps of walls, tangents, plain Newton and xnewton over stiffness and exponent (results/models)"""

from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import Campaign, read_campaign, select
from postprocess.figures.stability_methods import panels

RUNS = (1, 1)
READ = read_campaign

PANELS = {
    "plain Newton": "plain Newton",
    "walls from T⁰ = 0": "walls, $T^0 = 0$",
    "walls from T⁰ = d0": "walls, $T^0 = d_0$",
    "tangents": "tangents",
    "`xnewton`, no start": "default method, no start",
    "`xnewton`": "default method",
}


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """A panel a method: the most steps of three loads and two meshes; rows kappa, columns m."""
    rows = runs[0].rows("models", "name status law kappa m p0 beta u0 h order newton")
    rows = [row | {"law": "power"} for row in rows]  # the default, and no other
    groups = {words: select(rows, name=name) for name, words in PANELS.items()}
    return panels(groups, "newton", "Newton steps, the most of three loads and two meshes", wide=3)
