"""contact in space: pressure map, pressure over the distance from the middle against Hertz, deformed cut"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import Collection, LineCollection
from matplotlib.figure import Figure, SubFigure
from matplotlib.tri import Triangulation

from postprocess import style
from postprocess.reference_values import hertz
from postprocess.results import ResultsError, Run, read_table
from postprocess.vtu import bodies_file, cut_grid, read_grid

RUNS = (1, 1)

WIDE, DEEP = 2.9, 1.3  # of the cut's window, half its width and what is shown of a body, in units of a


def draw(runs: list[Run], units: style.Units) -> Figure:
    """(a) the pressure at the points, with Hertz's circle; (b) p/p0 over r/a, one dot a point, and Hertz's curve.

    (c), for runs with -vtu 1: the section by y = 0 in its deformed place, coloured by von Mises' stress. a and p0 are
    those of hard contact on a half-space under the run's total force; the middle is the pressure's centre. Of a half or
    quarter model the rest is its mirror images.
    """
    (run,) = runs
    height = read_table(run.path / "contact.csv", ["z"], "; the run is not one in space")["z"].max()
    nodal = run.contact["weight"] * run.contact["pressure"]
    if not nodal.sum() > 0:
        raise ResultsError(run.path / "contact.csv", "no point is in contact")
    a, greatest = hertz(run, run.value("force"))
    middle = middle_of(run, nodal, a)
    used = run.summary.get("used")
    whole = not isinstance(used, dict) or used.get("vtu", True)
    figure = Figure(figsize=(style.PAGE, (0.88 if whole else 0.42) * style.PAGE), layout="constrained")
    style.layout_of(figure).set(h_pad=0.09)
    top: Figure | SubFigure = figure
    if whole:
        (top,), (bottom,) = figure.subfigures(2, 1, squeeze=False, height_ratios=[1, 1.05])
    left, right = top.subplots(1, 2)
    colours = draw_map(left, run, middle, a, units)
    top.colorbar(colours, ax=left, label=f"pressure $p$ [{units.stress}]", shrink=0.85)
    draw_profile(right, run, middle, a, greatest)
    style.legend_outside(top, "upper center", handles=[*left.lines, *right.lines], ncols=3)
    if not whole:
        style.name_elements(figure, runs)
        return figure
    below = bottom.subplots()
    colours = draw_cut(below, run, middle, height, a)
    below.set_xlabel(f"$x$ [{units.length}]")
    below.set_ylabel(f"$z$ [{units.length}]")
    bottom.colorbar(colours, ax=below, label=f"von Mises stress [{units.stress}]", shrink=0.85, pad=0.01)
    for index, axes in enumerate((left, right, below)):
        axes.set_title(style.panel(index), loc="left")
    below.set_title(f"section $y = 0$, displacements at true scale; {style.elements(runs)}")
    return figure


def is_mirrored(run: Run, a: float) -> list[bool]:
    """Whether the plane x = 0, and y = 0, is one of symmetry, beyond which the run has no points; a: Hertz's radius."""
    return [bool(run.contact[name].min() > -1e-6 * a) for name in "xy"]


def middle_of(run: Run, nodal: np.ndarray, a: float) -> tuple[float, float]:
    """(x, y) of the centre of the nodal forces (n,); 0 in a plane of symmetry."""
    x, y = (
        0 if mirrored else np.sum(nodal * run.contact[name]) / nodal.sum()
        for mirrored, name in zip(is_mirrored(run, a), "xy", strict=True)
    )
    return x, y


def draw_map(axes: Axes, run: Run, middle: tuple[float, float], a: float, units: style.Units) -> Collection:
    """The pressure at the contact's points, with their mirror images, and Hertz's circle; returns the coloured dots.

    A dot is as large as the part of the surface that a point stands for; points without pressure are small and grey.
    """
    x, y, pressure = (run.contact[name] for name in ("x", "y", "pressure"))
    signs = [(1, -1) if mirrored else (1,) for mirrored in is_mirrored(run, a)]
    images = np.concatenate(
        [np.column_stack([across * x, along * y, pressure]) for across in signs[0] for along in signs[1]]
    )
    _, once = np.unique(np.round(images[:, :2] / a, 9) + 0.0, axis=0, return_index=True)
    across, along, pressure = images[once].T
    touches = pressure > 0
    apart = np.sqrt(np.pi * a**2 / np.count_nonzero(touches)) / (2.6 * a)  # over the width of the panel
    size = (0.75 * apart * 72 * 0.3 * style.PAGE) ** 2
    axes.scatter(across[~touches], along[~touches], s=2, color="0.8", linewidth=0)
    dots: style.Look = {"cmap": "viridis", "vmin": 0, "s": size, "linewidth": 0, "rasterized": True}
    colours = axes.scatter(across[touches], along[touches], c=pressure[touches], **dots)
    axes.set_xlim(middle[0] - 1.3 * a, middle[0] + 1.3 * a)
    axes.set_ylim(middle[1] - 1.3 * a, middle[1] + 1.3 * a)
    turn = np.linspace(0, 2 * np.pi, 200)
    circle: style.Look = {"color": style.VERMILION, "linewidth": 0.9, "linestyle": (0, (4, 1.5))}
    axes.plot(middle[0] + a * np.cos(turn), middle[1] + a * np.sin(turn), label="Hertz's circle, radius $a$", **circle)
    axes.set_aspect("equal")
    axes.set_xlabel(f"$x$ [{units.length}]")
    axes.set_ylabel(f"$y$ [{units.length}]")
    return colours


def draw_profile(axes: Axes, run: Run, middle: tuple[float, float], a: float, greatest: float) -> None:
    """p/p0 over r/a of all points and Hertz's; a, greatest: Hertz's radius [length] and p0 [pressure]."""
    x, y, pressure = (run.contact[name] for name in ("x", "y", "pressure"))
    line = np.linspace(0, 1, 300)
    axes.plot(line, np.sqrt(1 - line**2), color=style.BLACK, label="Hertz, half-space", zorder=3)
    distance = np.hypot(x - middle[0], y - middle[1])
    shown = distance <= 1.5 * a
    label = f"run, {style.count(run.summary['contactPoints'], 'point')} in contact"
    dots: style.Look = {"linestyle": "none", "marker": "o", "markersize": 2.2, "markeredgewidth": 0}
    axes.plot(distance[shown] / a, pressure[shown] / greatest, label=label, alpha=0.6, color=style.BLUE, **dots)
    axes.set_xlabel("$r/a$ [–]")
    axes.set_ylabel("pressure $p/p_0$ [–]")
    axes.set_xlim(0, None)
    axes.set_ylim(0, None)
    found = run.value("halfWidthMoment"), run.value("pressureMax")
    axes.annotate(
        f"radius {percent(found[0], a)}\ngreatest pressure {percent(found[1], greatest)}",
        (0.97, 0.78),
        xycoords="axes fraction",
        ha="right",
        fontsize=8,
    )


def thickness(pieces: np.ndarray) -> np.ndarray:
    """Of quadrangles (n, 4, 2) the area over the square of the longer diagonal (n,)."""
    one, other = pieces[:, 2] - pieces[:, 0], pieces[:, 3] - pieces[:, 1]
    area = 0.5 * np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])
    return area / np.maximum((one**2).sum(axis=1), (other**2).sum(axis=1))


def percent(value: float, reference: float) -> str:
    """The difference of a value from its reference, for readers."""
    return f"{100 * (value / reference - 1):+.1f} %".replace("-", "−")


def draw_cut(axes: Axes, run: Run, middle: tuple, height: float, a: float) -> Collection:
    """The deformed section through the middle, with its outline, and the rigid obstacle where there is no second body.

    The bodies' mean planes are d0 apart where hard contact is: they touch only in runs with -d0 0.
    """
    path = bodies_file(run.path)
    grid = read_grid(path)
    if not grid.space:
        raise ResultsError(path, "is not a grid of tetrahedra; the run is not one in space")
    pieces, stress, outline = cut_grid(grid, middle[1] + 1e-3 * run.value("h"))
    near = np.hypot(*(pieces.mean(axis=1) - (middle[0], height)).T) < 4 * a
    if not near.any():
        raise ResultsError(path, "has no element at the middle of the contact")
    pieces, stress = pieces[near], stress[near]
    thick = thickness(pieces) > 0.02
    pieces, stress = pieces[thick], stress[thick]  # slivers at the plane of symmetry are drawn broader than they are
    if pieces[..., 0].min() > -1e-6 * a:
        mirror = np.array([-1, 1])
        outline = outline[np.any(outline[..., 0] > 1e-6 * a, axis=1)]  # not the plane of symmetry
        pieces, outline = np.concatenate([pieces, pieces * mirror]), np.concatenate([outline, outline * mirror])
        stress = np.tile(stress, (2, 1))
    corner = np.arange(4 * len(pieces)).reshape(-1, 4)
    mesh = Triangulation(
        pieces[..., 0].ravel(),
        pieces[..., 1].ravel(),
        np.concatenate([corner[:, [0, 1, 2]], corner[:, [0, 2, 3]]]),
    )
    look: style.Look = {"cmap": "viridis", "shading": "gouraud", "vmin": 0, "rasterized": True}
    colours = axes.tripcolor(mesh, stress.ravel(), **look)
    axes.add_collection(LineCollection(list(outline), color=style.BLACK, linewidth=0.6))
    window = middle[0] - WIDE * a, middle[0] + WIDE * a
    two = "R2" in run.summary["parameters"]
    if not two:
        x = np.linspace(*window, 200)
        radius = run.parameter("R")
        flat = run.summary["scene"] == "sphere-on-plane"
        rounded = 0 * x if flat else radius - np.sqrt(np.maximum(radius**2 - (x - middle[0]) ** 2, 0))
        lowest = height + run.parameter("gap") - run.value("approach")
        axes.fill_between(x, lowest + rounded, height + DEEP * a, color="#E9E6E1", linewidth=0)
        axes.plot(x, lowest + rounded, color=style.BLACK, linewidth=0.6)
    axes.set_aspect("equal")
    axes.set_xlim(*window)
    axes.set_ylim(height - (DEEP if two else 1.5 * DEEP) * a, height + (DEEP if two else 0.5 * DEEP) * a)
    return colours
