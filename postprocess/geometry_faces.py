"""The faces of a geometry, or in the plane its curves, with the numbers by which a case file picks them.

The faces of cuts have numbers below 0, and the word cut. A geometry of many faces has a page: the whole with the names
of its bodies, then each body without the others.
"""

import csv
import sys
import textwrap
import time
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from postprocess import bodies as drawn
from postprocess import bodies_3d, labels, raster, style
from postprocess.results import read_table

FEW = 40  # faces, whose numbers have room on the whole
WIDE = 72 * style.PAGE  # points
GAP, MARGIN, EDGE = 5.0, 14.0, 10.0  # points: between views, left and right of a body, above and below it
PATIENCE = 2.0  # seconds after which a line tells of the progress

Box = tuple[float, float, float, float]  # points of the page: left, low, width, height


def draw(path: Path, azimuth: float, elevation: float) -> Figure:
    """One column wide; in space from where the eye is, and from the other side and below.

    Faces that neither side shows, inside or between bodies, stand in a panel of their own, without what hides them.
    More than a few faces take a page.
    """
    with path.open() as file:
        plane = "x2" not in file.readline()
    ends = 2 if plane else 3
    columns = [f"{axis}{end}" for end in range(ends) for axis in "xyz"]
    found = read_table(path, ["face", "body", *columns])
    at = np.column_stack([found[name] for name in columns]).reshape(-1, ends, 3)
    face, body = (np.asarray(found[name]).astype(int) for name in ("face", "body"))
    if plane:
        figure = Figure(layout="constrained")
        figure.set_size_inches(style.COLUMN, 0.9 * style.COLUMN)
        draw_curves(figure.subplots(), at, face)
        return figure
    names = read_names(path.with_name("check-bodies.csv"))
    views = [bodies_3d.view_matrix(azimuth, elevation), bodies_3d.view_matrix(azimuth + 180, -elevation)]
    if len(np.unique(face)) > FEW:
        return draw_page(at, face, body, views, names)
    sides = [View(at, face, body, view, style.COLUMN * style.DPI) for view in views]
    inner = sorted(set(face.tolist()) - set(sides[0].places) - set(sides[1].places))
    if any(map(crowded, (at @ view.T for view in views), (side.places for side in sides))):
        return draw_page(at, face, body, views, names)
    figure = Figure(layout="constrained")
    figure.set_size_inches(style.COLUMN, (2.25 if inner else 1.5) * style.COLUMN)
    axes = figure.subplots(3 if inner else 2, 1)
    for panel, side, words in zip(axes[:2], sides, ("", ": the other side"), strict=True):
        side.paint(panel)
        for number, place in side.places.items():
            write_number(panel, place, "cut" if number < 0 else number)
        panel.set_title(f"Faces{words}", loc="left", fontsize=7)
    if inner:
        draw_inner(axes[2], at, face, body, face_borders(at, face), views[0], inner)
        axes[2].set_title("Faces inside, without what hides them", loc="left", fontsize=7)
    figure.supxlabel("\n".join(volumes(face, body, names)), x=0.02, ha="left", fontsize=7)
    return figure


def crowded(seen: np.ndarray, places: dict[int, np.ndarray]) -> bool:
    """Would numbers at these places lie on each other, in a panel of a column's width?"""
    wide, high = np.ptp(seen[:, :, :2].reshape(-1, 2), axis=0)
    scale = 72 * style.COLUMN * min(0.95 / wide, 0.65 / high)  # points a unit
    found = scale * np.array(list(places.values())).reshape(-1, 2)
    apart = np.abs(found[:, None] - found[None])
    return bool(np.any(np.triu((apart[:, :, 0] < 11) & (apart[:, :, 1] < 9), 1)))


def read_names(path: Path) -> dict[int, str]:
    """By body its name, of those that have one."""
    if not path.exists():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        return {int(row["body"]): style.without_mathtext(row["name"]) for row in csv.DictReader(file)}


def volumes(face: np.ndarray, body: np.ndarray, names: dict[int, str]) -> list[str]:
    """Of each body its number, its name and the numbers of its faces."""
    lines = []
    for number in np.unique(body[body > 0]):
        own = " ".join(str(each) for each in np.unique(face[body == number]) if each > 0)
        name = f" ({names[number]})" if number in names else ""
        lines += textwrap.wrap(f"volume {number}{name}: faces {own}", 95, subsequent_indent="    ")
    return lines


def draw_curves(axes: Axes, at: np.ndarray, curve: np.ndarray) -> None:
    """Each curve's number at its middle."""
    place = at[:, :, :2]
    axes.add_collection(LineCollection(list(place), color=style.BLUE, linewidth=0.8))
    for number in np.unique(curve):
        own = place[curve == number]
        write_number(axes, own[len(own) // 2].mean(axis=0), "cut" if number < 0 else number)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_xlabel(f"$x$ [{style.Units.length}]")
    axes.set_ylabel(f"$y$ [{style.Units.length}]")
    axes.set_title("Curves", loc="left", fontsize=7)


def shaded_colours(seen: np.ndarray, body: np.ndarray) -> np.ndarray:
    """Colours of triangles, (triangles, 3): their bodies', darker where they look away from the light."""
    across = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
    size = np.maximum(np.linalg.norm(across, axis=1), 1e-300)
    bright = 0.62 + 0.38 * np.abs(across @ drawn.LIGHT) / size
    fills = np.array([[int(fill[k : k + 2], 16) / 255 for k in (1, 3, 5)] for fill in drawn.FILLS])
    return np.clip(fills[body % len(fills)] * bright[:, None], 0, 1)


class View:
    """Triangles as an eye sees them, `dots` wide at most: a picture, and the places of what is seen.

    places: by face the place of its number, where most of what is seen is around; room: how far from its edge.
    """

    def __init__(self, at: np.ndarray, face: np.ndarray, body: np.ndarray, view: np.ndarray, dots: float) -> None:
        seen = at @ view.T
        self.low, high = seen[:, :, :2].min(axis=(0, 1)), seen[:, :, :2].max(axis=(0, 1))
        self.size = np.maximum(high - self.low, 1e-9 * np.ptp(seen) + 1e-300)
        step = float(self.size.max() / max(dots - 4, 1))
        self.low, shape = self.low - 2 * step, tuple((self.size[::-1] / step).astype(int) + 5)
        self.step, self.shape = step, shape
        front = raster.fronts(seen, self.low, step, shape)
        numbers, index = np.unique(face, return_inverse=True)
        self.number = np.where(front < 0, -1, index.reshape(-1)[front])
        self.body = np.where(front < 0, -1, body[front])
        self.picture = np.ones((*shape, 3))
        self.picture[front >= 0] = shaded_colours(seen, body)[front[front >= 0]]
        self.picture[raster.edges(self.number)] = 0.25
        found = raster.rooms(self.number)
        self.places = {int(numbers[k]): self.place(row, column) for k, (row, column, _) in found.items()}
        self.room = {int(numbers[k]): room * step for k, (_, _, room) in found.items()}

    def place(self, row: int, column: int) -> np.ndarray:
        return self.low + self.step * (np.array([column, row]) + 0.5)

    def bodies(self) -> dict[int, np.ndarray]:
        """By body that is seen the place of its name."""
        return {number: self.place(row, column) for number, (row, column, _) in raster.rooms(self.body).items()}

    def paint(self, axes: Axes) -> None:
        right, top = self.low + self.step * np.array(self.shape[::-1])
        axes.imshow(
            self.picture, origin="lower", extent=(self.low[0], right, self.low[1], top), interpolation="antialiased"
        )
        set_plain_frame(axes)


def draw_inner(
    axes: Axes,
    at: np.ndarray,
    face: np.ndarray,
    body: np.ndarray,
    rim: np.ndarray,
    view: np.ndarray,
    inner: list[int],
) -> None:
    """The faces that nothing else shows, over the edges of all."""
    seen = at @ view.T
    axes.add_collection(LineCollection(list((rim @ view.T)[:, :, :2]), color="#B0B0B0", linewidth=0.3))
    own = np.isin(face, inner)
    depth = np.argsort(seen[own][:, :, 2].mean(axis=1))
    fill: style.Look = {"facecolor": shaded_colours(seen[own], body[own])[depth], "edgecolor": "none", "alpha": 0.7}
    axes.add_collection(PolyCollection(seen[own][depth][:, :, :2], rasterized=True, **fill))
    places: list[tuple[np.ndarray, list[str]]] = []
    for number in inner:
        place = middle_of(seen[face == number])
        near = [words for other, words in places if np.abs(other - place).max() < 0.02 * np.ptp(seen)]
        word = "cut" if number < 0 else str(number)
        near[0].append(word) if near else places.append((place, [word]))
    for place, words in places:
        write_number(axes, place, ", ".join(dict.fromkeys(words)))
    set_plain_frame(axes)


def middle_of(seen: np.ndarray) -> np.ndarray:
    """The centre of the triangle nearest to the middle of all."""
    centres = seen.mean(axis=1)[:, :2]
    return centres[np.argmin(np.linalg.norm(centres - np.median(centres, axis=0), axis=1))]


def write_number(axes: Axes, place: np.ndarray, number: int | str) -> None:
    look: style.Look = {"ha": "center", "va": "center", "fontsize": 7, "bbox": style.HALO, "zorder": 6}
    axes.annotate(str(number), (place[0], place[1]), color=style.BLACK, **look)


def set_plain_frame(axes: Axes) -> None:
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()


def face_borders(at: np.ndarray, face: np.ndarray) -> np.ndarray:
    """The sides of triangles that only one triangle of its face has, (sides, 2, 3)."""
    _, node = np.unique(np.round(at.reshape(-1, 3) / (np.ptp(at) + 1e-300), 9), axis=0, return_inverse=True)
    node = node.reshape(-1, 3)
    sides = np.concatenate([np.column_stack([face, np.sort(node[:, [k, (k + 1) % 3]], axis=1)]) for k in range(3)])
    places = np.concatenate([at[:, [k, (k + 1) % 3]] for k in range(3)])
    _, first, times = np.unique(sides, axis=0, return_index=True, return_counts=True)
    return places[first[times == 1]]


# ---------------------------------------------------------------- many faces: a page


def draw_page(
    at: np.ndarray, face: np.ndarray, body: np.ndarray, views: list[np.ndarray], names: dict[int, str]
) -> Figure:
    """The whole with its bodies' names, from both sides, then each body alone, its faces' numbers beside them.

    A number in brackets is that of a face that neither side shows.
    """
    begun = time.monotonic()
    parts = {int(number): body == number for number in np.unique(body)}
    words = {n: style.wrapped(f"{n} {names[n]}" if n in names else f"volume {n}", 18) for n in parts}
    margin = 6 + max(labels.size(text)[0] for text in words.values())
    top = 0.0
    if len(parts) > 1:
        least = 12 + sum(labels.size(text)[1] for text in words.values()) / 3
        top = 10 + max(least, height_needed(at, views, WIDE / 2 - GAP, margin))
    rows = arrange_rows({n: len(np.unique(face[own])) for n, own in parts.items()})
    tall = [max(height_needed(at[parts[n]], views, wide / 2, MARGIN) for n, _, wide in row) + 12 for row in rows]
    height = top + sum(tall)
    figure = Figure(figsize=(style.PAGE, height / 72))
    if top:
        draw_whole(figure, at, face, body, views, words, (height, top, margin))
    told, low = 0, height - top
    for row, high in zip(rows, tall, strict=True):
        low -= high
        for number, left, wide in row:
            told += 1
            if time.monotonic() - begun > PATIENCE:
                print(f"faces of body {told} of {len(parts)}", file=sys.stderr, flush=True)
                begun = time.monotonic()
            own = parts[number]
            title = f"volume {number}{f': {names[number]}' if number in names else ''}"
            look: style.Look = {"fontsize": 7, "va": "top"}
            figure.text((left + 3) / WIDE, (low + high) / height, style.wrapped(title, int(wide / 3.5)), **look)
            draw_alone(figure, at[own], face[own], body[own], views, (left, low, wide / 2, high - 12), height)
    return figure


def arrange_rows(counts: dict[int, int]) -> list[list[tuple[int, float, float]]]:
    """Rows of bodies, each with its left end and its width: of many faces wider ones."""
    rows: list[list[tuple[int, float, float]]] = [[]]
    left = 0.0
    for number, count in counts.items():
        wide = WIDE / (1 if count > 40 or len(counts) == 1 else 2 if count > 12 else 3)
        if left + wide > WIDE * 1.001:
            rows.append([])
            left = 0.0
        rows[-1].append((number, left, wide))
        left += wide
    return rows


def height_needed(at: np.ndarray, views: list[np.ndarray], wide: float, margin: float) -> float:
    """The height in points of a view that fills a width, or is nearly as high as that."""
    sizes = [np.ptp((at @ view.T)[:, :, :2].reshape(-1, 2), axis=0) for view in views]
    return min(0.95 * wide, 2 * EDGE + max((wide - 2 * margin) * up / max(right, 1e-300) for right, up in sizes))


def panel_in_points(figure: Figure, box: Box, height: float) -> Axes:
    """Axes whose data are points of the page."""
    left, low, wide, tall = box
    axes = figure.add_axes((left / WIDE, low / height, wide / WIDE, tall / height))
    axes.set_axis_off()
    return axes


def paint_fitted(axes: Axes, side: View, box: Box, margin: float) -> tuple[np.ndarray, float]:
    """Paints a view into the middle of axes in points; where its lower left corner is, and the points of a length."""
    scale = float(((np.array(box[2:]) - [2 * margin, 2 * EDGE]) / side.size).min())
    corner = np.array(box[2:]) / 2 - scale * (side.size / 2 + 2 * side.step)
    right, top = corner + scale * side.step * np.array(side.shape[::-1])
    axes.imshow(side.picture, origin="lower", extent=(corner[0], right, corner[1], top), interpolation="antialiased")
    axes.set_xlim(0, box[2])
    axes.set_ylim(0, box[3])
    return corner - scale * side.low, scale


def pixels_across(at: np.ndarray, view: np.ndarray, room: tuple[float, float]) -> float:
    """The pixels across a view that fills a room in points."""
    size = np.ptp((at @ view.T)[:, :, :2].reshape(-1, 2), axis=0)
    return float(size.max() * (np.array(room) / np.maximum(size, 1e-300)).min()) * style.DPI / 72


def draw_whole(
    figure: Figure,
    at: np.ndarray,
    face: np.ndarray,
    body: np.ndarray,
    views: list[np.ndarray],
    words: dict[int, str],
    sizes: tuple[float, float, float],
) -> None:
    """All bodies from two sides, the name of each beside the side that shows more of it.

    sizes: the page's height, that of this part, and the room for names.
    """
    height, top, margin = sizes
    wide = WIDE / 2
    room = (wide - GAP - 2 * margin, top - 10 - 2 * EDGE)
    sides = [View(at, face, body, view, pixels_across(at, view, room)) for view in views]
    seen = [side.bodies() for side in sides]
    shares = [{n: np.sum(side.body == n) for n in words} for side in sides]
    for k, (side, view) in enumerate(zip(sides, views, strict=True)):
        box = (k * (wide + GAP), height - top, wide - GAP, top - 10)
        axes = panel_in_points(figure, box, height)
        zero, scale = paint_fitted(axes, side, box, margin)
        axes.set_title(("Bodies", "Bodies: the other side")[k], loc="left", fontsize=7, pad=0)
        places = {}
        for number, text in words.items():
            hidden = not any(number in each for each in seen)
            if number in seen[k] and (number not in seen[1 - k] or shares[k][number] >= shares[1 - k][number] + k):
                places[number] = seen[k][number], text
            elif hidden and k == 0:
                places[number] = middle_of((at @ view.T)[body == number]), f"({text})"
        anchors = [zero + scale * place for place, _ in places.values()]
        labels.beside(axes, anchors, [text for _, text in places.values()], box[2:])


def draw_alone(
    figure: Figure,
    at: np.ndarray,
    face: np.ndarray,
    body: np.ndarray,
    views: list[np.ndarray],
    box: Box,
    height: float,
) -> None:
    """A body from two sides, the number of each face on the side that shows more of it."""
    left, low, wide, tall = box
    room = (wide - 2 * MARGIN, tall - 2 * EDGE)
    sides = [View(at, face, body, view, pixels_across(at, view, room)) for view in views]
    for k, (side, view) in enumerate(zip(sides, views, strict=True)):
        own = (left + k * wide, low, wide, tall)
        axes = panel_in_points(figure, own, height)
        zero, scale = paint_fitted(axes, side, own, MARGIN)
        anchors, texts, rooms = [], [], []
        for number in np.unique(face).tolist():
            here, there = (each.room.get(number, 0.0) / max(each.step, 1e-300) for each in (side, sides[1 - k]))
            word = "cut" if number < 0 else str(number)
            if here > there or (here == there > 0 and k == 0):
                anchors.append(zero + scale * side.places[number])
                texts.append(word)
                rooms.append(scale * side.room[number])
            elif here == there == 0 and k == 0:
                anchors.append(zero + scale * middle_of((at @ view.T)[face == number]))
                texts.append(f"({word})")
                rooms.append(0.0)
        labels.around(axes, anchors, texts, rooms, own[2:])
