"""draw what a run with -check 1 has read: mesh, groups, contact points with their normals, what is held

RUN is the result folder of a run of parts.edp or parts-3d.edp with -check 1, or its folder check. Written are
check.pdf and check.png beside the files of the check, or what --out names. Each group of the boundary that the case
file names has a colour, its statement stands beside it; a line at each contact point is its normal, as long as its
gap or as the elements around, whichever is less. Of a geometry faces.pdf and faces.png show its faces (in the plane
its curves) with the numbers that a line `group NAME faces N` takes; in space from both sides. Without a case file they
are all. More than 40 faces take a page: the names of the bodies on the whole, and each body alone.
"""

import argparse
import json
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from postprocess import bodies as drawn
from postprocess import geometry_faces, style
from postprocess.bodies_3d import VIEW, view_matrix
from postprocess.output import register_files_of_run, write_figures
from postprocess.results import ResultsError, check_file, one_line, read_table
from postprocess.vtu import CORNERS, cells_of_type, read_arrays

MANY = 12  # groups, or bodies, that a column has room for
COLOURS = (style.BLUE, style.VERMILION, style.GREEN, style.PURPLE, style.ORANGE, style.SKY, "#8C510A", "#35978F")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    style.add_picture(parser, "check")


def run(arguments: argparse.Namespace) -> None:
    """Reads the check's files, draws them, writes both files and prints their paths."""
    given = Path(arguments.folder)
    folder = given / "check" if (given / "check").is_dir() else given
    out = Path(arguments.out) if arguments.out else folder / "check.pdf"
    numbered = folder / "check-faces.csv"
    with style.look():
        figures = {}
        if (folder / "check.json").exists() or not numbered.exists():
            figures[out] = draw(folder, view_matrix(*(arguments.view or VIEW)))
        if numbered.exists():
            beside = out.with_name(f"{out.stem}-faces.pdf") if arguments.out else folder / "faces.pdf"
            figures[beside] = geometry_faces.draw(numbered, *(arguments.view or VIEW))
        if not arguments.out:
            register_files_of_run(
                folder, [path.with_suffix(kind).name for path in figures for kind in (".pdf", ".png")]
            )
        for path in write_figures(figures):
            print(path)


def draw(folder: Path, view: np.ndarray) -> Figure:
    """The figure, one column wide."""
    content = read_check(folder / "check.json")
    found = read_arrays(folder / "check-mesh.vtu")
    at, types = found["Points", None].reshape(-1, 3), found["Cells", "types"]
    label = found["CellData", "Label"]
    solid = 10 if np.any(types == 10) else 5
    shell = 5 if solid == 10 else 3
    cells, sides = (cells_of_type(folder / "check-mesh.vtu", found, kind) for kind in (solid, shell))
    points = read_table(folder / "check-points.csv", "contact x y z nx ny nz gap paired".split())
    plane = solid == 5
    many = len(np.unique(label[types == shell])) > MANY or len(content["bodies"]) > MANY
    held = held_by(content["bodies"], many)
    wide, high = style.COLUMN, (1.95 if plane else 1.35) * style.COLUMN
    if many:  # the legend and what is above the picture have their room besides
        wide = style.PAGE
        rows = len(np.unique(label[types == shell])) / 3 + held.count("\n") + 3
        high = (1.2 if plane else 0.65) * style.PAGE + rows * 9 / 72
    figure = Figure(figsize=(wide, high), layout="constrained")
    axes, *close = figure.subplots(2, 1, height_ratios=[1, 0.62]) if plane else [figure.subplots()]
    groups = label[types == shell]
    colours = {int(group): COLOURS[k % len(COLOURS)] for k, group in enumerate(np.unique(groups[groups > 0]))}
    paint = draw_plane if plane else draw_solid
    for panel in (axes, *close):
        size = paint(panel, at, cells, label[types == solid], sides, groups, colours, view, line_widths(content))
        draw_points(panel, points, np.eye(3) if plane else view, size, panel in close or not plane)
    for panel in (axes, *close) if plane else ():
        length = (str(content.get("units", "")).split() or [style.Units.length])[0]
        panel.set(xlabel=f"$x$ [{length}]", ylabel=f"$y$ [{length}]")
    for panel in close:
        near = np.argmin(np.where(points["paired"] > 0, np.abs(points["gap"]), np.inf))
        reach = 8 * size + 2 * abs(points["gap"][near])
        panel.set_xlim(points["x"][near] - reach, points["x"][near] + reach)
        panel.set_ylim(points["y"][near] - 0.6 * reach, points["y"][near] + 0.6 * reach)
    width = line_widths(content) if plane else {}
    entries = [
        Line2D([], [], color=colours[group], linewidth=width.get(group, 1.4 if plane else 2)) for group in colours
    ]
    entries.append(Line2D([], [], color=style.BLACK, linewidth=0.6, marker="o", markersize=2))
    words = [style.without_mathtext(group_caption(content, group)) for group in colours]
    look: style.Look = {"ncols": 3, "fontsize": 7, "handlelength": 1.4} if many else {"ncols": 1}
    style.legend_outside(figure, "lower left", entries, [*words, "contact points and normals"], **look)
    if many:
        figure.suptitle(style.without_mathtext(held), x=0.01, ha="left", fontsize=7)
    else:
        axes.set_title(style.without_mathtext(held), loc="left", fontsize=7)
    return figure


def held_by(bodies: list[dict], together: bool) -> str:
    """What holds each body, a line each; together: a line for all that are held alike."""
    lines: dict[str, list[str]] = {}
    for k, body in enumerate(bodies):
        held = f"held by {one_line(str(body['held']))}"
        free = ", ".join(word.partition(": ")[2] for word in body["free"])
        how = f"{held}; free: {free}" if free else held
        lines.setdefault(how if together else f"{k} {how}", []).append(one_line(str(body["name"])))
    said = [f"{', '.join(names)}: {how if together else how.partition(' ')[2]}" for how, names in lines.items()]
    return "\n".join(style.wrapped(line, 150) for line in said) if together else "\n".join(said)


def read_check(path: Path) -> dict:
    """check.json, with the lists that are drawn."""
    check_file(path, "; run the case with -check 1")
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if not all(isinstance(content[key], list) for key in ("groups", "statements", "bodies", "contacts")):
            raise ValueError
    except (ValueError, KeyError, TypeError):
        raise ResultsError(path, "is not what -check 1 writes") from None
    return content


def group_caption(content: dict, group: int) -> str:
    """A group's name, and the statements about it."""
    name = str(content["groups"][group - 1])
    words = [each["word"] for each in content["statements"] if each.get("group") == group and each["word"] != "contact"]
    for contact in content["contacts"]:
        slave, master = pair(str(contact["name"]), content["groups"])
        words += [f"slave of {master}"] if slave == name else []
        words += [f"master of {slave}"] if master == name else []
    return f"{name}: {', '.join(dict.fromkeys(words))}" if words else name


def line_widths(content: dict) -> dict[int, float]:
    """The widths of the lines of slaves and of groups that are masters alone."""
    numbers = {str(name): number for number, name in enumerate(content["groups"], 1)}
    pairs = [pair(str(contact["name"]), content["groups"]) for contact in content["contacts"]]
    found = {numbers[master]: 0.9 for _, master in pairs if master in numbers}
    return found | {numbers[slave]: 2.4 for slave, _ in pairs if slave in numbers}


def pair(contact: str, groups: list) -> tuple[str, str]:
    """Slave and master of a contact, whose names may have blanks; a name that no group has is that of an obstacle."""
    words, known = contact.split(" "), {str(name) for name in groups}
    ways = [(" ".join(words[:k]), " ".join(words[k:])) for k in range(1, len(words) + 1)]
    return max(ways, key=lambda way: (way[0] in known) + (way[1] in known))


def draw_plane(
    axes: Axes,
    at: np.ndarray,
    cells: np.ndarray,
    parts: np.ndarray,
    sides: np.ndarray,
    groups: np.ndarray,
    colours: dict[int, str],
    _view: np.ndarray,
    widths: dict[int, float],
) -> float:
    """Elements in their bodies' colours, the groups' edges on them; the size of an element at the groups.

    Where surfaces touch as drawn, the thin line of a master lies on the wide one of its slave.
    """
    place = at[:, :2]
    for number, part in enumerate(np.unique(parts)):
        fill = drawn.FILLS[number % len(drawn.FILLS)]
        look: style.Look = {"facecolor": fill, "edgecolor": "#9A9A9A", "linewidth": 0.12}
        axes.add_collection(PolyCollection(place[cells[parts == part]], **look))
    for group, colour in colours.items():
        width = widths.get(group, 1.4)
        look = {"color": colour, "linewidth": width, "zorder": 4 - width / 2}
        axes.add_collection(LineCollection(place[sides[groups == group]], **look))
    axes.autoscale_view()
    axes.set_aspect("equal")
    edges = place[sides[:, 1]] - place[sides[:, 0]]
    return float(np.median(np.hypot(*edges.T)))


def draw_solid(
    axes: Axes,
    at: np.ndarray,
    cells: np.ndarray,
    _parts: np.ndarray,
    sides: np.ndarray,
    groups: np.ndarray,
    colours: dict[int, str],
    view: np.ndarray,
    _widths: dict[int, float],
) -> float:
    """The boundary from outside, far parts first, named groups in their colours; the size of an element there."""
    every = np.concatenate([np.delete(cells, corner, axis=1) for corner in range(CORNERS[10])])
    key, first, times = np.unique(np.sort(every, axis=1), axis=0, return_index=True, return_counts=True)
    skin = every[first[times == 1]]
    named = {tuple(side): int(group) for side, group in zip(np.sort(sides, axis=1).tolist(), groups, strict=True)}
    of = [named.get(tuple(side), 0) for side in key[times == 1].tolist()]
    fills = np.array([[int(colours.get(group, "#DDDDDD")[i : i + 2], 16) / 255 for i in (1, 3, 5)] for group in of])
    seen = at[skin] @ view.T
    across = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
    across /= np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None]
    shade = (0.62 + 0.38 * np.abs(across @ drawn.LIGHT))[:, None]
    order = np.argsort(seen[:, :, 2].mean(axis=1))
    mixed = (0.45 + 0.55 * fills) * shade
    look: style.Look = {"facecolor": mixed[order], "edgecolor": "#707070", "linewidth": 0.08}
    axes.add_collection(PolyCollection(seen[order][:, :, :2], rasterized=True, **look))
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()
    return float(np.median(np.linalg.norm(at[sides[:, 1]] - at[sides[:, 0]], axis=1)))


def draw_points(axes: Axes, points: dict, view: np.ndarray, size: float, shown: bool) -> None:
    """A dot at each contact point with something opposite, and its normal, where these can be seen."""
    if not shown:
        return
    paired = points["paired"] > 0
    at, normal = (
        np.column_stack([points[name] for name in names])[paired] @ view.T
        for names in (("x", "y", "z"), ("nx", "ny", "nz"))
    )
    long = np.clip(np.abs(points["gap"][paired]), 0.3 * size, size)[:, None]
    axes.plot(
        at[:, 0],
        at[:, 1],
        linestyle="none",
        marker="o",
        markersize=1.2 if np.ptp(at[:, 2]) == 0 else 0.5,
        markeredgewidth=0,
        color=style.BLACK,
        zorder=5,
    )
    lines = np.stack([at[:, :2], (at + long * normal)[:, :2]], axis=1)
    axes.add_collection(LineCollection(list(lines), color=style.BLACK, linewidth=0.3, zorder=5))
