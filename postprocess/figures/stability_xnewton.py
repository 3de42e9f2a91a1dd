"""the default method's greatest counts over all meshes, by stiffness and exponent (results/stability)"""

from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import Campaign, read_campaign, select
from postprocess.figures.stability_methods import panels

RUNS = (1, 1)
READ = read_campaign


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """Linearisations with the half-plane start, without it, and from the two walls of the paper's scheme."""
    rows = runs[0].rows("stability", "name status method T0 law kappa m p0 beta h order newton backsolves")
    rows = select(rows, method="xnewton")
    thresholds = select(rows, name="threshold")
    groups = {
        "default": select(rows, name="grid"),
        "no start": select(rows, name="no start"),
        "$T^0 = 0$": [row for row in thresholds if row["T0"] != "d0"],
        "$T^0 = d_0$": select(thresholds, T0="d0"),
    }
    return panels(
        {name: group for name, group in groups.items() if group},
        "newton",
        "Default method: most linearisations",
    )
