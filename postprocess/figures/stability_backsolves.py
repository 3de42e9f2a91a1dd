"""the default method's most back-substitutions over all meshes, by stiffness and exponent (results/stability)"""

from matplotlib.figure import Figure

from postprocess import style
from postprocess.campaign import Campaign, read_campaign, select
from postprocess.figures.stability_methods import panels

RUNS = (1, 1)
READ = read_campaign


def draw(runs: list[Campaign], units: style.Units) -> Figure:
    """With the half-plane start, and without it."""
    rows = runs[0].rows("stability", "name status method T0 law kappa m p0 beta h order newton backsolves")
    rows = select(rows, method="xnewton")
    groups = {"default": select(rows, name="grid"), "no start": select(rows, name="no start")}
    groups = {name: group for name, group in groups.items() if group}
    return panels(groups, "backsolves", "Default method: most back-substitutions")
