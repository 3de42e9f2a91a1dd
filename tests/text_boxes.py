"""The rules for figures (edp/docs/reference/figures.md), held on matplotlib's objects: boxes of texts, labels, looks.

`faults(figure)` draws a figure and names what breaks them: texts on each other, on data or outside; axes without unit,
or with too few labels; hyphens as minus; small letters; internal names; curves that look alike.
"""

import re
from itertools import combinations

import numpy as np
from freefem import ROOT
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.legend import Legend
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


def strayed(figure):
    """Legends that reach into other axes, in words."""
    every = [axes for axes in figure.axes if axes.get_visible() and axes.axison]
    for axes in every:
        legend = axes.get_legend()
        if legend is None or not legend.get_visible():
            continue
        box = legend.get_window_extent().padded(-0.02 * figure.dpi)
        names = ", ".join(text.get_text() for text in legend.get_texts())
        for other in every:
            if other is not axes and other not in axes.child_axes and Bbox.intersection(box, other.bbox) is not None:
                yield f"the legend of {names!r} lies on other axes"


# ---------------------------------------------------------------- the rules of edp/docs/reference/figures.md

LEAST = 7.0  # points at the printed size
BEYOND = 2.5  # how much farther than the last label of a logarithmic axis its data may reach
APART = 8.0  # of two colours that nothing else tells apart, in Lab, for each kind of colour blindness
MATHTEXT = re.compile(r"(?<!\\)\$.*?(?<!\\)\$")
HYPHEN = re.compile(r"(?<![\w)\]])-(?=[\d.])")
SCENES = "|".join(path.stem for path in (ROOT / "edp/scenes").glob("*-*.edp"))
INTERNAL = re.compile(rf"\b(xnewton|signorini|linesearch|{SCENES})\b|\b[a-z]+[A-Z]|[a-z]_[a-z]")
# Linear RGB as each kind of colour blindness sees it: Machado, Oliveira and Fernandes (2009), severity 1
BLIND = (
    ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)),
    ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)),
    ((1.255528, -0.076749, -0.178779), (-0.078411, 0.930809, 0.147602), (0.004733, 0.691367, 0.303900)),
)


def lab(colour, seen):
    """(3,) a colour's place in Lab, as an eye with this matrix sees it."""
    red = np.array(to_rgb(colour))
    linear = np.clip(np.array(seen) @ np.where(red > 0.04045, ((red + 0.055) / 1.055) ** 2.4, red / 12.92), 0, 1)
    turned = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ linear
    x, y, z = np.cbrt(turned / [0.9505, 1, 1.089])
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def labels_of(axis):
    """(place, text) of the tick labels that are drawn, in the order of their places."""
    low, high = sorted(axis.get_view_interval())
    near = 1e-9 * (high - low)
    ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
    found = [(tick.get_loc(), label) for tick in ticks for label in (tick.label1, tick.label2)]
    found = [each for each in found if low - near <= each[0] <= high + near and each[1].get_visible()]
    return sorted((place, label.get_text()) for place, label in found if label.get_text().strip())


def unlabelled(axes):
    """Axes without label, or with numbers and no unit, in words; the panel below, or at the left, may have it for both.

    An axis with no number but 0 has no scale: it is a sketch's, and its label needs no unit.
    """
    own, root = axes.get_position(), axes.get_figure(root=True)
    around = [each for each in root.findobj(Axes) if each.get_visible() and each.axison and each is not axes]
    boxes = [(each, each.get_position()) for each in around]
    beside = {
        "x": [
            each
            for each, box in boxes
            if min(box.x1, own.x1) - max(box.x0, own.x0) > 0.5 * own.width and box.y0 < own.y0
        ],
        "y": [
            each
            for each, box in boxes
            if min(box.y1, own.y1) - max(box.y0, own.y0) > 0.5 * own.height and box.x0 < own.x0
        ],
    }
    for name, axis in (("x", axes.xaxis), ("y", axes.yaxis)):
        labels = [text for _, text in labels_of(axis)]
        words = [getattr(each, name + "axis").get_label_text() for each in (axes, *beside[name])]
        words += [root.get_supylabel()] if name == "y" else []
        numbers = any(text != "0" and re.match(r"[$\N{MINUS SIGN}]*[\d.]", text) for text in labels)
        where = f"the {name} axis of {axes.get_title(loc='left') or axes.get_title() or 'a panel'!r}"
        if len(set(labels)) < len(labels):
            yield f"{where} has a number twice: {labels}"
        if labels and not any(word and (not numbers or re.search(r"\[[^\]]+\]", word)) for word in words):
            yield f"{where} has no label with a unit: {words[0]!r}"


def unreadable(axes):
    """Logarithmic axes whose labels are too few, or end before the data, in words."""
    for axis, side in ((axes.xaxis, 0), (axes.yaxis, 1)):
        labels = [place for place, _ in labels_of(axis)]
        if axis.get_scale() != "log" or not labels:
            continue
        drawn = [line.get_xydata()[:, side] for line in axes.lines if line.get_transform() == axes.transData]
        low, high = sorted(axis.get_view_interval())
        seen = np.concatenate([values[(low <= values) & (values <= high)] for values in drawn if len(values)] or [[]])
        steps = np.array(labels[1:]) / labels[:-1]
        few = len(labels) < 2 or steps.max() > max(10, (high / low) ** 0.34)
        if few or (len(seen) and (seen.min() < labels[0] / BEYOND or seen.max() > labels[-1] * BEYOND)):
            yield f"the {axis.axis_name} axis with the labels {labels} and data {seen.min():g} to {seen.max():g}"


def drawn_lines(axes):
    """Lines that show data, each with its path on the page: no grid, no mark of two points without a name."""
    for line in axes.lines:
        path = line.get_path().transformed(line.get_transform())
        named = not line.get_label().startswith("_")
        if line.get_visible() and line.get_zorder() > 0 and len(path.vertices) > (1 if named else 2):
            yield line, path


def covered(axes):
    """Texts and legends on a line's data, and measured points beyond the frame, in words."""
    texts = [text for text in axes.texts if text.get_visible() and text.get_text() and text.get_bbox_patch() is None]
    boxes = [(text.get_text(), Text.get_window_extent(text)) for text in texts]
    legend = axes.get_legend()
    if legend is not None and legend.get_visible():
        names = ", ".join(text.get_text() for text in legend.get_texts())
        boxes.append((f"the legend of {names}", legend.get_window_extent()))
    for line, path in drawn_lines(axes):
        ends = path.vertices[np.isfinite(path.vertices).all(axis=1)]
        frame = axes.bbox.padded(0.02 * axes.figure.dpi)
        marked = line.get_marker() not in ("", " ", "None", None) and line.get_transform() == axes.transData
        marked &= not line.get_label().startswith("_")  # others are marks in a picture of bodies
        inside = (ends >= frame.min) & (ends <= frame.max)
        if marked and (inside[:, 0] & ~inside[:, 1]).any():
            yield f"points of {line.get_label()!r} lie beyond the frame"
        for name, box in boxes:
            box = Bbox.intersection(box.padded(-0.02 * axes.figure.dpi), axes.bbox)
            hit = box is not None and ((ends >= box.min) & (ends <= box.max)).all(axis=1).any()
            joined = box is not None and line.get_linestyle() != "None" and path.intersects_bbox(box, filled=False)
            if hit or joined:
                yield f"{name!r} lies on the curve {line.get_label()!r}"


def alike(axes):
    """Named lines that only a colour tells apart which some eyes do not see, in words."""
    looks = {}
    for line, _ in drawn_lines(axes):
        if not line.get_label().startswith("_"):
            same = (
                line.get_marker(),
                str(line._unscaled_dash_pattern),
                str(line.get_markerfacecolor()) == "white",
                line.get_linewidth(),
            )
            looks.setdefault(same, []).append(line)
    for lines in looks.values():
        for one, other in combinations(lines, 2):
            apart = [np.linalg.norm(lab(one.get_color(), eye) - lab(other.get_color(), eye)) for eye in BLIND]
            if min(apart) < APART:
                yield f"{one.get_label()!r} looks like {other.get_label()!r}"


def breaches(figure):
    """What of a figure breaks the rules, in words; the figure has been drawn."""
    for text in shown(figure):
        plain = MATHTEXT.sub("", text.get_text())
        if HYPHEN.search(plain):
            yield f"{text.get_text()!r} has a hyphen for a minus sign"
        if text.get_fontsize() < LEAST:
            yield f"{text.get_text()!r} is of {text.get_fontsize():g} points"
    legends = [each for each in figure.findobj(Legend) if each.get_visible()]
    for one, other in combinations([each.get_window_extent().padded(-0.03 * figure.dpi) for each in legends], 2):
        if one.overlaps(other):
            yield "a legend lies on another one"
    for legend in legends:
        names = [text.get_text() for text in legend.get_texts()]
        yield from (f"the legend has an internal name: {name!r}" for name in names if INTERNAL.search(name))
        yield from (f"the legend has {name!r} twice" for name in set(names) if names.count(name) > 1)
    every = [axes for axes in figure.findobj(Axes) if axes.get_visible() and axes.axison]
    for axes in every:
        for rule in (unlabelled, unreadable, covered, alike):
            yield from rule(axes)


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
    return found + list(dict.fromkeys([*strayed(figure), *breaches(figure)]))
