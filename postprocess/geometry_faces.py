"""The faces of a geometry, or in the plane its curves, with the numbers by which a case file picks them.

The faces of cuts have numbers below 0, and the word cut.
"""

import textwrap
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from postprocess import bodies as drawn
from postprocess import bodies_3d, style
from postprocess.results import read_table


def draw(path: Path, azimuth: float, elevation: float) -> Figure:
    """One column wide; in space from where the eye is, and from the other side and below.

    Faces that neither side shows, inside or between bodies, stand in a panel of their own, without what hides them.
    """
    with path.open() as file:
        plane = "x2" not in file.readline()
    ends = 2 if plane else 3
    columns = [f"{axis}{end}" for end in range(ends) for axis in "xyz"]
    found = read_table(path, ["face", "body", *columns])
    at = np.column_stack([found[name] for name in columns]).reshape(-1, ends, 3)
    face, body = (np.asarray(found[name]).astype(int) for name in ("face", "body"))
    figure = Figure(layout="constrained")
    if plane:
        figure.set_size_inches(style.COLUMN, 0.9 * style.COLUMN)
        draw_curves(figure.subplots(), at, face)
        return figure
    rim = face_borders(at, face)
    at, face, body = subdivided(at, face, body)
    views = [bodies_3d.view_matrix(azimuth, elevation), bodies_3d.view_matrix(azimuth + 180, -elevation)]
    places = [label_positions(at, face, view) for view in views]
    inner = sorted(set(face.tolist()) - set(places[0]) - set(places[1]))
    figure.set_size_inches(style.COLUMN, (2.25 if inner else 1.5) * style.COLUMN)
    axes = figure.subplots(3 if inner else 2, 1)
    for panel, view, seen, words in zip(axes[:2], views, places, ("", ": the other side"), strict=True):
        draw_faces(panel, at, body, rim, view, seen)
        panel.set_title(f"Faces{words}", loc="left", fontsize=6.5)
    if inner:
        draw_inner(axes[2], at, face, body, rim, views[0], inner)
        axes[2].set_title("Faces inside, without what hides them", loc="left", fontsize=6.5)
    figure.supxlabel("\n".join(volumes(face, body)), x=0.02, ha="left", fontsize=6)
    return figure


def volumes(face: np.ndarray, body: np.ndarray) -> list[str]:
    """Of each body its number and those of its faces."""
    lines = []
    for number in np.unique(body[body > 0]):
        own = " ".join(str(each) for each in np.unique(face[body == number]) if each > 0)
        lines += textwrap.wrap(f"volume {number}: faces {own}", 95, subsequent_indent="    ")
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
    axes.set_xlabel("$x$")
    axes.set_ylabel("$y$")
    axes.set_title("Curves", loc="left", fontsize=6.5)


def subdivided(at: np.ndarray, face: np.ndarray, body: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles cut until they are small beside the whole: each is drawn before or behind another as a whole."""
    for _ in range(5):
        large = (
            np.linalg.norm(at - np.roll(at, 1, axis=1), axis=2).max(axis=1)
            > np.ptp(at.reshape(-1, 3), axis=0).max() / 12
        )
        if not large.any() or len(at) > 4000:
            break
        a, b, c = at[large].transpose(1, 0, 2)
        d, e, f = (a + b) / 2, (b + c) / 2, (c + a) / 2
        parts = [np.stack(part, axis=1) for part in ((a, d, f), (d, b, e), (f, e, c), (d, e, f))]
        at = np.concatenate([at[~large], *parts])
        face, body = (np.concatenate([each[~large], np.tile(each[large], 4)]) for each in (face, body))
    return at, face, body


def shaded_colours(seen: np.ndarray, body: np.ndarray) -> np.ndarray:
    """Colours of triangles, (triangles, 3): their bodies', darker where they look away from the light."""
    across = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
    size = np.maximum(np.linalg.norm(across, axis=1), 1e-300)
    bright = 0.62 + 0.38 * np.abs(across @ drawn.LIGHT) / size
    fills = np.array([[int(fill[k : k + 2], 16) / 255 for k in (1, 3, 5)] for fill in drawn.FILLS])
    return np.clip(fills[body % len(fills)] * bright[:, None], 0, 1)


def label_positions(at: np.ndarray, face: np.ndarray, view: np.ndarray) -> dict[int, np.ndarray]:
    """Of each face that can be seen the place of its number: the middle of what is seen of it."""
    seen = at @ view.T
    towards = np.abs(np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])[:, 2])
    places = {}
    for number in np.unique(face):
        own = np.flatnonzero(face == number)
        own = own[np.argsort(-towards[own])][:200]
        free = own[~is_hidden(seen[own].mean(axis=1), seen)]
        if free.size and towards[free[0]] > 0:
            places[int(number)] = middle_of(seen[free])
    return places


def middle_of(seen: np.ndarray) -> np.ndarray:
    """The centre of the triangle nearest to the middle of all."""
    centres = seen.mean(axis=1)[:, :2]
    return centres[np.argmin(np.linalg.norm(centres - np.median(centres, axis=0), axis=1))]


def edges_of(rim: np.ndarray, view: np.ndarray) -> np.ndarray:
    """The rims in short pieces, as they are seen, (pieces, 2, 3)."""
    share = np.linspace(0, 1, 17)[:, None, None, None]
    ends = rim[:, 0] * (1 - share[..., 0]) + rim[:, 1] * share[..., 0]
    return np.stack([ends[:-1], ends[1:]], axis=2).reshape(-1, 2, 3) @ view.T


def draw_faces(
    axes: Axes,
    at: np.ndarray,
    body: np.ndarray,
    rim: np.ndarray,
    view: np.ndarray,
    places: dict[int, np.ndarray],
) -> None:
    """Far triangles first, in their bodies' colours, the faces' edges on them; the numbers at their places."""
    seen = at @ view.T
    colours = shaded_colours(seen, body)
    order = np.lexsort((seen[:, :, 2].mean(axis=1), ~is_hidden(seen.mean(axis=1), seen)))
    shown: style.Look = {"facecolor": colours[order], "edgecolor": colours[order], "linewidth": 0.1}
    axes.add_collection(PolyCollection(seen[order][:, :, :2], rasterized=True, **shown))
    edges = edges_of(rim, view)
    visible = ~is_hidden(edges.mean(axis=1), seen)
    axes.add_collection(LineCollection(edges[visible][:, :, :2], color="#404040", linewidth=0.4))
    for number, place in places.items():
        write_number(axes, place, number)
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
    axes.add_collection(LineCollection(list(edges_of(rim, view)[:, :, :2]), color="#B0B0B0", linewidth=0.3))
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


def is_hidden(points: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Does a triangle lie between a place and the eye?"""
    a, ab, ac = seen[:, 0], seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0]
    twice = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    flat = np.abs(twice) < 1e-12 * np.ptp(seen) ** 2
    twice = np.where(flat, np.inf, twice)
    away = 1e-3 * np.ptp(seen)
    answer = np.zeros(len(points), bool)
    for k, point in enumerate(points):
        off = point - a
        u = (off[:, 0] * ac[:, 1] - off[:, 1] * ac[:, 0]) / twice
        v = (ab[:, 0] * off[:, 1] - ab[:, 1] * off[:, 0]) / twice
        depth = a[:, 2] + u * ab[:, 2] + v * ac[:, 2]
        answer[k] = np.any((u > 0) & (v > 0) & (u + v < 1) & ~flat & (depth > point[2] + away))
    return answer


def write_number(axes: Axes, place: np.ndarray, number: int | str) -> None:
    look: style.Look = {"ha": "center", "va": "center", "fontsize": 6, "bbox": style.HALO, "zorder": 6}
    axes.annotate(str(number), (place[0], place[1]), color=style.BLACK, **look)
