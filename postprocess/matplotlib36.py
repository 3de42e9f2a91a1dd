"""matplotlib 3.6, Debian 12's: legends beyond all axes, loc="outside ...", as they came with 3.7."""

from matplotlib import _constrained_layout as layout
from matplotlib.figure import FigureBase

plain_legend, plain_margins = FigureBase.legend, layout.make_layout_margins


def legend(figure, *args, loc=None, **options):
    """Figure.legend, that knows "outside upper center" and the like: margins() makes the room."""
    words = (loc or "").split()
    if words[:1] != ["outside"]:
        return plain_legend(figure, *args, loc=loc, **options)
    made = plain_legend(figure, *args, loc=" ".join(words[1:]), **options)
    made.side = {"upper": "top", "lower": "bottom"}[words[1]]
    return made


def margins(grids, figure, renderer, *, w_pad=0, h_pad=0, **spaces):
    """The margins that the layout gives to the axes' own texts, and those of such legends."""
    plain_margins(grids, figure, renderer, w_pad=w_pad, h_pad=h_pad, **spaces)
    for made in figure.legends:
        if hasattr(made, "side"):
            box = figure.transFigure.inverted().transform_bbox(made.get_tightbbox(renderer))
            grids[figure].edit_margin_min(made.side, box.height + 2 * h_pad)


def install() -> None:
    FigureBase.legend, layout.make_layout_margins = legend, margins
