"""The boxes of a figure's texts: none may lie on another one, or leave the figure; no legend may lie on a curve."""

from itertools import combinations

from matplotlib.text import Text
from matplotlib.transforms import Bbox

PIXEL = 1.0  # what boxes may share, at 100 dots an inch: they are larger than their letters


def shown(figure):
    """Every text that is drawn, tick labels within the axes' limits only."""
    ticks = {}
    for axes in figure.findobj(lambda artist: hasattr(artist, "get_xticks")):
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
                inside = low - 1e-9 * (high - low) <= tick.get_loc() <= high + 1e-9 * (high - low)
                ticks |= dict.fromkeys((tick.label1, tick.label2), inside and axes.get_visible() and axes.axison)
    hidden = {
        text
        for axes in figure.findobj(lambda artist: hasattr(artist, "get_xticks"))
        if not axes.get_visible()
        for text in axes.findobj(Text)
    }
    for text in figure.findobj(Text):
        if text.get_visible() and text.get_text().strip() and ticks.get(text, True) and text not in hidden:
            yield text


def hidden_curves(figure):
    """Legends that lie on a curve of their axes or reach into other axes, in words."""
    every = [axes for axes in figure.axes if axes.get_visible() and axes.axison]
    for axes in every:
        legend = axes.get_legend()
        if legend is None or not legend.get_visible():
            continue
        box = legend.get_window_extent().padded(-0.02 * figure.dpi)
        names = ", ".join(text.get_text() for text in legend.get_texts())
        inside = Bbox.intersection(box, axes.bbox)
        for line in axes.lines:
            path = line.get_path().transformed(line.get_transform())
            named = not line.get_label().startswith("_")  # others are grids and marks
            drawn = named and line.get_zorder() > 0 and len(path.vertices) > 1 and line.get_linestyle() != "None"
            if inside is not None and drawn and path.intersects_bbox(inside, filled=False):
                yield f"the legend of {names!r} lies on the curve {line.get_label()!r}"
        for other in every:
            if other is not axes and other not in axes.child_axes and Bbox.intersection(box, other.bbox) is not None:
                yield f"the legend of {names!r} lies on other axes"


def faults(figure):
    """What lies on something else or outside, in words."""
    figure.draw_without_rendering()
    scale = figure.dpi / 100
    boxes = [(text.get_text(), Text.get_window_extent(text)) for text in shown(figure)]  # without its arrow
    boxes = [(text, box) for text, box in boxes if box.width > 0 and box.height > 0]
    whole = figure.bbox.padded(2 * scale)
    found = [
        f"{text!r} is outside"
        for text, box in boxes
        if not (whole.x0 <= box.x0 and box.x1 <= whole.x1 and whole.y0 <= box.y0 and box.y1 <= whole.y1)
    ]
    for (one, a), (other, b) in combinations(boxes, 2):
        across = min(a.x1, b.x1) - max(a.x0, b.x0)
        along = min(a.y1, b.y1) - max(a.y0, b.y0)
        if min(across, along) > PIXEL * scale and across * along > 0:
            found.append(f"{one!r} lies on {other!r}")
    return found + list(dict.fromkeys(hidden_curves(figure)))
