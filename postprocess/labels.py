"""Labels that lie on nothing else: at a place, or near it or in a margin, with a line to the place.

Axes have points of the page as data. `around` puts each label at its place if it has room there, otherwise on the
nearest free place; `beside` puts labels into the margins at the left and at the right.
"""

import functools
from collections.abc import Sequence
from itertools import chain

import numpy as np
from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

from postprocess import style

FONT = 7.0
PAD = 0.8  # around letters

Place = np.ndarray | tuple[float, float]


@functools.cache
def size(text: str) -> tuple[float, float]:
    """Width and height of lines of text in points."""
    lines = text.split("\n")
    font = FontProperties(family=style.RC["font.family"])
    wide = max(TextPath((0, 0), line or " ", size=FONT, prop=font).vertices[:, 0].max(initial=0) for line in lines)
    return float(wide) + 2 * PAD, 1.2 * FONT * len(lines) + 2 * PAD - 1


def box_of(place: np.ndarray, text: str) -> np.ndarray:
    """Lower left and upper right corner of a label about its middle."""
    half = np.array(size(text)) / 2
    return np.array([place - half, place + half])


def meet(box: np.ndarray, others: np.ndarray) -> np.ndarray:
    return (box[0] < others[:, 1]).all(axis=1) & (others[:, 0] < box[1]).all(axis=1)


def put(axes: Axes, place: np.ndarray, text: str, anchor: np.ndarray | None = None) -> None:
    """Writes a label about a place; a line goes to its anchor."""
    if anchor is not None:
        box = box_of(place, text)
        end = np.clip(anchor, box[0], box[1])
        axes.plot(*np.array([end, anchor]).T, color=style.BLACK, linewidth=0.35, zorder=5)
        axes.plot(*anchor, marker="o", markersize=1.1, markeredgewidth=0, color=style.BLACK, zorder=5)
    halo = {**style.HALO, "boxstyle": "square,pad=0.05"}
    axes.text(place[0], place[1], text, ha="center", va="center", fontsize=FONT, linespacing=1.0, bbox=halo, zorder=6)


def around(
    axes: Axes,
    places: Sequence[Place],
    texts: list[str],
    rooms: list[float],
    room: tuple[float, float],
) -> None:
    """Labels at their places or near them; rooms: the distances from the places to the edges of what they name.

    Those with most room are put first. No label lies on another one, or on the place of another one; none hides
    what it names.
    """
    anchors = np.array(places, float).reshape(-1, 2)
    middle = np.array(room) / 2
    taken = np.zeros((0, 2, 2))
    for k in sorted(range(len(texts)), key=lambda k: -rooms[k]):
        away = np.arctan2(*(anchors[k] - middle)[::-1])
        # away from the middle first
        turns = away + np.pi / 12 * np.array([j // 2 * (-1) ** j for j in range(1, 25)])
        directions = np.column_stack([np.cos(turns), np.sin(turns)])
        here = [0.0 * middle] if rooms[k] > 0.35 * size(texts[k])[1] else []
        offs = chain(here, (r * directions[j] for r in range(6, int(max(room)), 3) for j in range(24)))
        for off in offs:
            spot = anchors[k] + off
            box = box_of(spot, texts[k])
            inside = (box[0] >= 0).all() and (box[1] <= room).all()
            covers = ((anchors > box[0] - 0.5) & (anchors < box[1] + 0.5)).all(axis=1)
            covers[k] &= off.any()
            if inside and not covers.any() and not meet(box, taken).any():
                break
        else:
            spot = anchors[k]
        at_place = (spot == anchors[k]).all()
        taken = np.concatenate([taken, box_of(spot, texts[k])[None]])
        put(axes, spot, texts[k], None if at_place else anchors[k])


def beside(axes: Axes, places: Sequence[Place], texts: list[str], room: tuple[float, float]) -> None:
    """Labels in two columns at both sides, in the order of their places from above, and lines to these."""
    anchors = np.array(places, float).reshape(-1, 2)
    order = sorted(range(len(texts)), key=lambda k: anchors[k][0])
    half = (len(order) + 1) // 2
    for column, right in ((order[:half], False), (order[half:], True)):
        column = sorted(column, key=lambda k: -anchors[k][1])
        tall = [size(texts[k])[1] for k in column]
        # from above each at the height of its anchor or below the one before, then up from the bottom
        heights: list[float] = []
        for k, high in zip(column, tall, strict=True):
            below = heights[-1] - high if heights else room[1] - high
            heights.append(min(below, anchors[k][1] - high / 2))
        least = 0.0
        for j in range(len(column) - 1, -1, -1):
            heights[j] = max(heights[j], least)
            least = heights[j] + tall[j]
        for k, low, high in zip(column, heights, tall, strict=True):
            wide = size(texts[k])[0]
            x = room[0] - wide / 2 if right else wide / 2
            put(axes, np.array([x, low + high / 2]), texts[k], anchors[k])
