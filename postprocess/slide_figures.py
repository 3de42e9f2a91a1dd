"""Pictures of the lecture: sketches and closed forms, drawn without a run, for a slide or a page.

`PICTURES` has the functions by name. Each draws into an empty figure; `drawn(function)` makes the figure for a slide,
`drawn(function, slide=False)` for a page. The film of `postprocess/teaching_kit.py` alone needs a run.
"""

import itertools
from collections.abc import Callable
from typing import Any, TypeVar

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

from postprocess import style

SLIDE = (11.2, 4.7)  # inches of a picture that fills a slide below its title
LARGE: dict[Any, Any] = {name: 17 for name in ("font.size", "axes.titlesize", "axes.labelsize", "legend.fontsize")} | {
    "xtick.labelsize": 16,
    "ytick.labelsize": 16,
    "lines.linewidth": 2.2,
    "axes.linewidth": 1.0,
    "lines.markersize": 8,
    "legend.handlelength": 1.5,
}
PAGE_SIZE: dict[Any, Any] = {
    name: 9.5 for name in ("font.size", "axes.titlesize", "axes.labelsize", "legend.fontsize")
} | {
    "lines.linewidth": 1.4,
    "lines.markersize": 5,
}
T = TypeVar("T", float, np.ndarray)

DASHED, DOTTED = (0, (4, 2)), ":"
BODY, OTHER = "#dfe5ec", "#eee6d8"  # the two bodies


def draw_picture(draw: Callable[[Figure], None], slide: bool = True) -> Figure:
    """A picture in the size of a slide, or of a page's width."""
    with mpl.rc_context(LARGE if slide else PAGE_SIZE):
        figure = Figure(figsize=SLIDE if slide else (style.PAGE, 0.42 * style.PAGE), layout="constrained")
        draw(figure)
        style.layout_of(figure).execute(figure)
    return figure


# ---------------------------------------------------------------- parts of a picture


def bare(axes: Axes, x: tuple[float, float], y: tuple[float, float], equal: bool = False) -> Axes:
    """Axes without frame or ticks."""
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    axes.axis("off")
    axes.set_xticks([])
    axes.set_yticks([])
    if equal:
        axes.set_aspect("equal")
    return axes


def arrow(
    axes: Axes,
    begin: tuple[float, float],
    end: tuple[float, float],
    colour: str = style.BLACK,
    both: bool = False,
    width: float = 1.6,
) -> None:
    heads = "<->" if both else "->"
    axes.annotate(
        "", end, begin, arrowprops={"arrowstyle": heads, "color": colour, "lw": width, "shrinkA": 0, "shrinkB": 0}
    )


def span(axes: Axes, x: float, low: float, high: float, words: str, colour: str = style.BLACK) -> None:
    """A vertical double arrow with its name at the right."""
    arrow(axes, (x, low), (x, high), colour, both=True)
    axes.text(x + 0.09, (low + high) / 2, words, color=colour, va="center")


def rough_line(seed: int, size: float) -> Callable[[np.ndarray], np.ndarray]:
    """A rough profile: a sum of waves with random phases."""
    random = np.random.default_rng(seed)
    waves = np.arange(3, 34)
    phases, sizes = random.uniform(0, 2 * np.pi, len(waves)), waves**-0.9
    sizes *= size / np.sqrt((sizes**2).sum() / 2)
    return lambda x: (sizes * np.cos(np.multiply.outer(x, waves * 2 * np.pi / 12) + phases)).sum(axis=-1)


def law(s: T, kappa: float = 100, m: float = 3) -> T:
    """The pressure of a power law at an overlap s of the asperities: a number, or an array of any shape."""
    pressure: T = kappa * np.maximum(s, 0) ** m
    return pressure


# ---------------------------------------------------------------- contact


def rough(figure: Figure) -> None:
    """Three approaches of two rough surfaces: apart, first touch, pressed, with d, d0 and s."""
    panels = figure.subplots(1, 3)
    x = np.linspace(0, 4, 900)
    lower, upper = rough_line(3, 0.16)(x), rough_line(12, 0.16)(x)
    touch = (lower - upper).max()  # distance of the mean planes at first touch
    cases = ((touch + 0.45, "apart"), (touch, "first touch"), (0.3 * touch, "pressed"))
    for axes, (apart, title) in zip(panels, cases, strict=True):
        bare(axes, (0, 5), (-1.25, 1.25 + touch))
        top = upper + apart
        pressed = np.minimum(lower, top)
        axes.fill_between(x, -1.15, pressed, color=BODY, linewidth=0)
        axes.fill_between(x, top, 1.15 + touch, color=OTHER, linewidth=0)
        axes.plot(x, pressed, color=style.BLUE)
        axes.plot(x, top, color=style.ORANGE)
        axes.axhline(0, xmax=0.8, color=style.BLUE, linestyle=DASHED, linewidth=1)
        axes.axhline(apart, xmax=0.8, color=style.ORANGE, linestyle=DASHED, linewidth=1)
        span(axes, 4.1, 0, apart, {"apart": r"$-d$", "first touch": r"$-d_0$", "pressed": r"$-d$"}[title])
        axes.set_title(
            {"apart": "apart: $d < d_0$, $p = 0$", "first touch": "first touch: $d = d_0 < 0$"}.get(
                title, "pressed: $s = d - d_0 > 0$"
            )
        )
        if title == "first touch":
            axes.text(0.1, -1.0, "mean planes: dashed", color=style.BLUE)
        if title == "pressed":
            carries = np.where(lower > top, top, np.nan)
            axes.plot(x, carries, color=style.VERMILION, linewidth=2 * mpl.rcParams["lines.linewidth"])
            axes.text(0.1, -1.0, "asperities that carry", color=style.VERMILION)
            axes.axhline(touch, xmax=0.8, color=style.GREY, linestyle=DOTTED, linewidth=1)
            span(axes, 4.1, apart, touch, "$s$", style.VERMILION)


def laws(figure: Figure) -> None:
    """Contact laws with the same pressure at s = 0.15, and hard contact."""
    axes = figure.subplots()
    d0, s = -0.25, np.linspace(0, 0.2495, 400)
    shown = (
        (r"power, $m = 2$", s**2, style.SKY),
        (r"power, $m = 3$: the paper", s**3, style.BLUE),
        (r"power, $m = 10$", s**10, "#003355"),
        (r"exponential", np.exp(20 * s) - 1, style.GREEN),
        ("barrier: infinite where the\nmean planes meet", s / (-d0 - s), style.ORANGE),
    )
    for name, p, colour in shown:
        axes.plot(s, 10 * p / np.interp(0.15, s, p), color=colour, label=name)
    axes.plot([-0.05, 0, 0], [0, 0, 40], color=style.VERMILION, linewidth=3, label="hard contact")
    axes.set_xlim(-0.05, 0.26)
    axes.set_xticks([0, 0.1, 0.2, -d0], ["0", "0.1", "0.2", "$-d_0$"])
    axes.set_ylim(0, 40)
    axes.axvline(-d0, color=style.GREY, linewidth=0.8, linestyle=DASHED)
    axes.set_xlabel("overlap of the asperities $s = d - d_0$ [length]")
    axes.set_ylabel("pressure $p$ [pressure]")
    style.legend_outside(figure, "right upper")


def springs(figure: Figure) -> None:
    """Layer and body in series: where the law's curve and the body's line cross, for growing stiffness."""
    axes = figure.subplots()
    s, approach, stiffness = np.linspace(0, 2.4, 2000), 2.25, 6.73
    for kappa, colour in ((1, style.SKY), (1e3, style.BLUE), (1e6, "#003355")):
        p = law(s, kappa)
        axes.plot(s[p < 18], p[p < 18], color=colour, label=rf"law, $\kappa = {style.number(kappa)}$")
        at = np.argmin(abs(p - stiffness * (approach - s)))
        axes.plot(s[at], p[at], "o", color=colour)
    axes.plot([0, approach], [stiffness * approach, 0], color=style.GREY, label=r"body, $p = k(\delta - s)$")
    axes.plot([0, 0], [0, 18], color=style.VERMILION, linewidth=3, label="hard contact")
    axes.plot(0, stiffness * approach, "o", color=style.VERMILION)
    axes.set_xlim(-0.05, 2.4)
    axes.set_ylim(0, 18)
    axes.set_xticks([0, approach], ["0", r"$\delta$"])
    axes.set_yticks([0, 5, 10, 15])
    axes.set_xlabel("overlap of the asperities $s$")
    axes.set_ylabel("pressure $p$ [pressure]")
    style.legend_outside(figure, "right upper")


def hard(figure: Figure) -> None:
    """Hard contact: a gap without pressure, or a pressure without a gap; stiffer and stiffer laws tend to it."""
    axes = figure.subplots()
    s = np.linspace(0, 1, 800)
    for kappa, colour in ((3, style.SKY), (100, style.BLUE), (1e4, "#003355")):
        axes.plot(s, law(s, kappa), color=colour, label=rf"law, $\kappa = {style.number(kappa)}$")
    axes.plot(
        [-1, 0, 0],
        [0, 0, 3],
        color=style.VERMILION,
        linewidth=2 * mpl.rcParams["lines.linewidth"],
        label="hard contact",
    )
    axes.text(-0.95, 0.12, "open: $s < 0$, $p = 0$", color=style.VERMILION)
    axes.text(-0.03, 2.3, "closed: $s = 0$, $p \\geq 0$", color=style.VERMILION, ha="right")
    axes.set_xlim(-1, 1)
    axes.set_ylim(-0.05, 3)
    axes.set_xticks([0], ["0"])
    axes.set_yticks([])
    axes.set_xlabel("overlap of the asperities $s$")
    axes.set_ylabel("pressure $p$")
    style.legend_outside(figure, "right upper")


def disc(figure: Figure) -> None:
    """The paper's test: left the disc above the block, right the prescribed motion with its overlap of 2."""
    panels = figure.subplots(1, 2)
    angle = np.linspace(np.pi, 2 * np.pi, 200)
    for axes, lowest in zip(panels, (0.5, -2.0), strict=True):
        bare(axes, (-23, 23), (-22, 13.5), equal=True)
        axes.add_patch(Rectangle((-20, -20), 40, 20, facecolor=BODY, edgecolor=style.BLUE))
        axes.fill(
            10 * np.cos(angle), lowest + 10 + 10 * np.sin(angle), facecolor=OTHER, edgecolor=style.ORANGE, alpha=0.8
        )
        axes.plot([-20, 20], [-20, -20], color=style.BLACK, linewidth=5)
    left, right = panels
    left.text(0, 6, "rigid, $R = 10$", ha="center")
    left.text(0, -9, r"$E = 100$, $\nu = 0.3$", ha="center")
    left.text(0, -19.2, "clamped", ha="center", va="bottom")
    left.text(-20, 0.6, "gap 0.5")
    arrow(left, (15, 10), (15, 4), width=2.2)
    left.text(16, 6.5, "$u_0 = 2.5$", va="center")
    right.text(0, 8.8, "first iterate of Newton:\nthe block has not moved", ha="center")
    right.annotate(
        "overlap 2: the law gives 11 400",
        (0, -1.2),
        (0, -9),
        ha="center",
        color=style.VERMILION,
        arrowprops={"arrowstyle": "->", "color": style.VERMILION, "lw": 2},
    )
    right.text(0, -14, "greatest pressure of the solution: 22.9", ha="center", color=style.GREEN)


# ---------------------------------------------------------------- Newton's method


def tangents(figure: Figure) -> None:
    """Newton's tangents on p = kappa s^3 from far to the right."""
    axes = figure.subplots()
    s = np.linspace(0, 1.05, 300)
    axes.plot(s, s**3, color=style.BLUE)
    axes.plot([0, 1.05], [0.03, 0.03 * (1 - 1.05 / 1.1)], color=style.GREY)
    at = 1.0
    for step in range(4):
        after = (2 * at**3 + 0.03) / (3 * at**2 + 0.03 / 1.1)
        axes.plot([at, at], [0, at**3], color=style.VERMILION, linewidth=1, linestyle=DOTTED)
        axes.plot([after, at], [max(0.03 * (1 - after / 1.1), 0), at**3], color=style.VERMILION, linewidth=1.6)
        axes.plot([at], [at**3], "o", color=style.VERMILION)
        axes.annotate(f"step {step}", (at, at**3), (-12, 4), textcoords="offset points", ha="right")
        at = after
    axes.set_xticks([0, 1], ["0", r"$\delta$: the whole approach"])
    axes.set_yticks([])
    axes.set_xlim(0, 1.1)
    axes.set_xlabel("overlap $s$")
    axes.set_ylabel("pressure")
    axes.text(0.8, 0.66, r"the law $\kappa s^m$", color=style.BLUE, ha="right")
    axes.text(0.02, 0.06, r"the body $k(\delta - s)$", color=style.GREY)


def overshoot(figure: Figure) -> None:
    """Error of s over Newton's steps for three exponents, without counts: they are asked for in lab 2."""
    axes = figure.subplots()
    stiffness, approach, kappa = 6.73, 2.25, 1e9
    for m, colour, symbol in ((2, style.SKY, "o"), (3, style.BLUE, "s"), (8, "#003355", "^")):
        low, high = 0.0, approach
        for _ in range(200):
            middle = (low + high) / 2
            low, high = (middle, high) if kappa * middle**m < stiffness * (approach - middle) else (low, middle)
        s = approach
        errors: list[float] = []
        while len(errors) < 80:
            errors.append(abs(s / low - 1))
            if errors[-1] < 1e-9:
                break
            s -= (kappa * s**m - stiffness * (approach - s)) / (kappa * m * s ** (m - 1) + stiffness)
        axes.semilogy(errors, color=colour, marker=symbol, markersize=6, label=f"$m = {m}$")
    axes.axhspan(1, 1e6, color=style.VERMILION, alpha=0.07, linewidth=0)
    axes.text(0.985, 0.9, r"far: each step takes off the share $1/m$", transform=axes.transAxes, ha="right")
    axes.text(0.03, 0.12, "near: the error is squared", transform=axes.transAxes)
    axes.set_ylim(1e-16, 1e6)
    axes.set_yticks([1e-15, 1e-10, 1e-5, 1, 1e5])
    axes.set_xticks([])
    axes.set_xlabel("Newton step")
    axes.set_ylabel("relative error of $s$ [–]")
    style.legend_outside(figure, "right upper")


# ---------------------------------------------------------------- the paper's scheme


def cut(figure: Figure) -> None:
    """The law cut at T by a wall, the share of the wall, and the next T."""
    axes = figure.subplots()
    s = np.linspace(0, 0.42, 200)
    axes.plot(s, law(s), color=style.GREY, linestyle=(0, (3, 2)))
    low = np.linspace(0, 0.25, 100)
    axes.plot([-0.05, 0], [0, 0], color=style.BLUE, linewidth=3)
    axes.plot(low, law(low), color=style.BLUE, linewidth=3)
    axes.plot([0.25, 0.25], [law(0.25), 7.8], color=style.VERMILION, linewidth=3)
    arrow(axes, (0.26, law(0.25)), (0.26, 5), both=True)
    axes.text(0.266, 2.9, r"$\lambda$")
    axes.text(0.243, 3.5, r"share of the wall: $\lambda$", ha="right")
    axes.text(0.2, 2.0, "$d < T$: the law", color=style.BLUE, ha="right")
    axes.text(0.243, 6.3, "$d = T$: the wall", color=style.VERMILION, ha="right")
    axes.text(0.37, 5.9, "eq. (3)", color=style.GREY, ha="right")
    axes.plot([0.25], [5], "o", color=style.VERMILION, zorder=3)
    axes.text(0.243, 4.85, "pressure found", ha="right", va="center")
    axes.plot([0.25, 0.3684], [5, 5], color=style.BLACK, linewidth=1, linestyle=DOTTED)
    arrow(axes, (0.3684, 5), (0.3684, 0), width=1)
    axes.set_xticks([0, 0.25, 0.3684], ["$d_0$", "$T^N$", "$T^{N+1}$"])
    axes.set_yticks([])
    axes.set_xlim(-0.05, 0.42)
    axes.set_ylim(0, 7.8)
    axes.set_xlabel("overlap $d$")
    axes.set_ylabel("pressure $p$")


def models(figure: Figure) -> None:
    """Side by side: the law (3), the first model (4) with its wall at d = 0, the N-th model (5) with its wall at T."""
    panels = figure.subplots(1, 3, sharey=True)
    d0, s = -0.25, np.linspace(0, 0.42, 200)
    walls = (np.inf, 0.0, 0.06)
    names = ("eq. (3): the law", "eq. (4): wall at $d = 0$", "eq. (5): wall at $d = T^N$")
    for axes, wall, name in zip(panels, walls, names, strict=True):
        full = np.isinf(wall)
        axes.plot(d0 + s, law(s), color=style.BLUE if full else style.GREY, linestyle="-" if full else (0, (3, 2)))
        axes.plot([d0 - 0.07, d0], [0, 0], color=style.BLUE)
        if not full:
            low = np.linspace(0, wall - d0, 100)
            axes.plot(d0 + low, law(low), color=style.BLUE)
            axes.plot(
                [wall, wall],
                [law(wall - d0), 7],
                color=style.VERMILION,
                linewidth=1.5 * mpl.rcParams["lines.linewidth"],
            )
            arrow(axes, (wall + 0.012, law(wall - d0)), (wall + 0.012, 4.8), style.BLACK, both=True)
            axes.text(wall - 0.012, 0.5 * (law(wall - d0) + 4.8), r"$\lambda$", ha="right", va="center")
            axes.text(wall - 0.012, 5.6, "wall", color=style.VERMILION, ha="right")
        axes.text(d0 - 0.05, 1.0, "" if full else "asperities", color=style.BLUE)
        axes.set_xticks([d0, 0, *([wall] if wall else [])], ["$d_0$", "0", *(["    $T^N$"] if wall else [])])
        axes.set_yticks([])
        axes.set_ylim(0, 7)
        axes.set_xlim(d0 - 0.07, 0.18)
        axes.set_title(name)
        axes.set_xlabel("overlap $d$")
    panels[0].set_ylabel("pressure $p$")


def four_five(figure: Figure) -> None:
    """Eq. (4) beside eq. (5): one wall for good, and walls that move until none is needed."""
    left, right = figure.subplots(1, 2, sharey=True)
    d0, s = -0.25, np.linspace(0, 0.45, 2000)
    body = 6.4 - 6.83 * s
    solution = s[np.argmin(abs(body - law(s)))]
    found = 6.4 + 6.83 * d0  # the pressure where the wall stands at d = 0
    after = (found / 100) ** (1 / 3)  # eq. (6)
    width = 1.3 * mpl.rcParams["lines.linewidth"]
    for axes in (left, right):
        reach = s <= (-d0 if axes is left else after)
        axes.plot(d0 + s, law(s), color=style.GREY, linestyle=(0, (3, 2)))
        axes.plot([d0 - 0.05, d0], [0, 0], color=style.BLUE)
        axes.plot(d0 + s[reach], law(s)[reach], color=style.BLUE)
        axes.plot(d0 + s, body, color=style.GREEN)
        axes.text(d0 - 0.03, 4.5, "the body's answer", color=style.GREEN)
        pale = style.VERMILION if axes is left else "#eaa987"
        axes.plot([0, 0], [law(-d0), 7], color=pale, linewidth=width)
        axes.plot(0, found, "o", color=pale)
        axes.text(-0.006, 6.6, "$T^0$", color=pale, ha="right")
        axes.set_xticks([d0, 0], ["$d_0$", "0"])
        axes.set_yticks([])
        axes.set_ylim(0, 7.2)
        axes.set_xlim(d0 - 0.05, 0.18)
        axes.set_xlabel("overlap $d$")
    right.plot([d0 + after] * 2, [law(after), 7], color=style.VERMILION, linewidth=width)
    right.text(d0 + after - 0.006, 6.6, "$T^1$", color=style.VERMILION, ha="right")
    arrow(right, (0.006, found), (d0 + after, found), style.BLACK)
    right.text(0.05, found + 0.12, "eq. (6)", ha="center")
    for axes in (left, right):
        axes.plot(
            d0 + solution, law(solution), "o", color=style.BLACK, fillstyle="none" if axes is left else "full", zorder=4
        )
    right.annotate(
        "the solution:\nno wall acts",
        (d0 + solution - 0.004, law(solution) - 0.04),
        (-0.012, 3.0),
        ha="right",
        arrowprops={"arrowstyle": "->", "color": style.BLACK, "shrinkB": 4},
    )
    left.text(
        -0.012,
        found - 0.75,
        "too stiff: the wall carries\na share of the pressure",
        color=style.VERMILION,
        ha="right",
        va="top",
    )
    left.set_title("eq. (4): one wall, at $d = 0$")
    right.set_title("eq. (5): the wall moves to the law")
    left.set_ylabel("pressure $p$")


def status(figure: Figure) -> None:
    """Status as an active set: left the contact line and its points, right the plane of d - T and lambda."""
    left, right = figure.subplots(1, 2, width_ratios=(1.5, 1))
    bare(left, (-4.6, 4.6), (-2.4, 2.6))
    x = np.linspace(-4.2, 4.2, 15)
    disc = np.linspace(-4.2, 4.2, 200)
    left.add_patch(Rectangle((-4.5, -2.3), 9, 2.3, color=BODY, linewidth=0))
    left.plot(disc, 0.15 * disc**2 - 0.5, color=style.ORANGE)
    left.text(-1.3, 2.1, "obstacle", color=style.ORANGE)
    left.text(-4.3, -2.1, "body")
    looks = (
        ("open", style.GREY, "o", "none"),
        ("on the law", style.BLUE, "o", "full"),
        ("at the wall", style.VERMILION, "s", "full"),
    )
    of = np.where(abs(x) < 1.3, 2, np.where(abs(x) < 2.5, 1, 0))
    for number, (name, colour, symbol, fill) in enumerate(looks):
        at = x[of == number]
        left.plot(at, 0 * at, symbol, color=colour, fillstyle=fill, linestyle="none", label=name)
        if number:
            for place in at:
                arrow(
                    left,
                    (place, -0.15),
                    (place, -0.15 - (2.1 - 0.25 * place**2) * (1 if number == 2 else 0.85)),
                    colour,
                    width=1.4,
                )
    left.legend(loc="upper center", ncols=3, columnspacing=0.9, handletextpad=0.1, bbox_to_anchor=(0.5, 1.12))
    right.axhline(0, color=style.BLACK, linewidth=1)
    right.axvline(0, color=style.BLACK, linewidth=1)
    right.fill([-1, 1, 1], [1, 1, -1], color=style.VERMILION, alpha=0.10, linewidth=0)
    right.fill([-1, -1, 1], [1, -1, -1], color=style.BLUE, alpha=0.08, linewidth=0)
    right.plot([-1, 0], [0, 0], color=style.BLUE, linewidth=4)
    right.plot([0, 0], [0, 1], color=style.VERMILION, linewidth=4)
    right.plot([-1, 1], [1, -1], color=style.GREY, linestyle=DASHED)
    right.text(0.08, 0.75, "wall: $S = 1$", color=style.VERMILION)
    right.text(-0.95, -0.75, "law: $S = 0$", color=style.BLUE)
    right.set_xticks([])
    right.set_yticks([])
    right.set_xlabel(r"$\rho\,(d - T)$")
    right.set_ylabel(r"$\lambda$", rotation=0, labelpad=14)
    right.set_title(r"$S = 1$ where $\lambda + \rho\,(d - T) > 0$")


def uniform(figure: Figure) -> None:
    """Where T stands after the first model: raised point by point, and at all points alike."""
    left, right = figure.subplots(1, 2, sharey=True)
    x = np.linspace(-4, 4, 41)
    pressure = np.sqrt(np.maximum(1 - (x / 2.6) ** 2, 0))
    found = -0.25 + 0.29 * pressure ** (1 / 3)
    overlap = -0.25 + 0.26 * np.maximum(1 - (x / 2.9) ** 2, -0.2)
    for axes, threshold, name in (
        (left, found, "pointwise: a new point meets its first wall"),
        (right, 0 * x + found.max(), "uniform: no point meets a wall again"),
    ):
        axes.plot(x, threshold, color=style.BLUE, linestyle=DASHED, drawstyle="steps-mid", label="next $T$")
        axes.plot(x, overlap, color=style.BLACK, label="overlap $d$ of the law")
        new = overlap > threshold + 1e-9
        axes.plot(x[new], threshold[new], "s", color=style.VERMILION, label="wall again")
        axes.axhline(-0.25, color=style.GREY, linewidth=0.8)
        axes.set_xticks([])
        axes.set_yticks([-0.25], ["$d_0$"])
        axes.set_ylim(-0.31, 0.1)
        axes.set_xlabel("place $x$ on the contact line")
        axes.set_title(name)
    left.set_ylabel("overlap")
    style.legend_outside(figure, "lower center", *left.get_legend_handles_labels(), ncols=3)


def proximal(figure: Figure) -> None:
    """A linear solve leaves the law; the way back at fixed s, and along the body's own response."""
    axes = figure.subplots()
    s = np.linspace(0, 1.05, 300)
    axes.plot(s, s**3 * 8, color=style.BLUE)
    axes.text(0.86, 6.6, "the law", color=style.BLUE, ha="right")
    at = (0.86, 1.25)
    axes.plot(*at, "o", color=style.BLACK)
    axes.annotate("after the linear solve:\n$(s, p)$ is off the law", at, (10, -36), textcoords="offset points")
    arrow(axes, at, (0.86, 8 * 0.86**3), style.VERMILION, width=2)
    axes.plot(0.86, 8 * 0.86**3, "o", color=style.VERMILION)
    axes.text(0.88, 3.3, "Newton: at fixed $s$,\na deep overshoot", color=style.VERMILION)
    slope, place = -1.9, np.linspace(0, 0.86, 2000)
    line = at[1] + slope * (place - at[0])
    back = place[np.argmin(abs(line - 8 * place**3))]
    arrow(axes, at, (back, 8 * back**3), style.GREEN, width=2)
    axes.plot(back, 8 * back**3, "o", color=style.GREEN)
    axes.text(0.56, 2.15, "along $p + k s$ = const:\nthe response of the body", color=style.GREEN, ha="right")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.set_xlim(0, 1.2)
    axes.set_ylim(0, 8)
    axes.set_xlabel("overlap $s$")
    axes.set_ylabel("pressure $p$")


def bridge(figure: Figure) -> None:
    """Where the next tangent touches the law: at the present overlap, at the present pressure, along the response."""
    axes = figure.subplots()
    s = np.linspace(0, 1.05, 2000)
    axes.plot(s, law(s, 8), color=style.BLUE)
    axes.text(0.93, 7.2, "the law", color=style.BLUE, ha="right")
    at, stiffness = (0.86, 1.25), 5
    along = s[np.argmin(abs(law(s, 8) + stiffness * s - at[1] - stiffness * at[0]))]
    places = [
        (at[0], style.VERMILION, "1 at the present overlap:\nplain Newton", (0.9, 4.0), "left"),
        ((at[1] / 8) ** (1 / 3), style.PURPLE, "2 at the present pressure:\neq. (6)", (0.05, 0.75), "left"),
        (along, style.GREEN, "3 along the response $p + k s$:\nthe default method", (0.05, 3.3), "left"),
    ]
    for place, colour, words, text, align in places:
        height = float(law(np.array(place), 8))
        arrow(axes, at, (place, height), colour)
        axes.plot(place, height, "o", color=colour)
        near = place + np.array([-0.1, 0.1])
        axes.plot(near, height + 24 * place**2 * (near - place), color=colour, linestyle=DASHED)
        axes.text(*text, words, color=colour, ha=align)
    axes.plot(*at, "o", color=style.BLACK)
    axes.annotate("after a linear solve", at, (12, -6), textcoords="offset points")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.set_xlim(0, 1.25)
    axes.set_ylim(0, 8)
    axes.set_xlabel("overlap $s$")
    axes.set_ylabel("pressure $p$")


# ---------------------------------------------------------------- discretisation


def collocation(figure: Figure) -> None:
    """Points on the contact line, hat functions and weights; nodal forces q = w p."""
    axes = bare(figure.subplots(), (-0.4, 8.4), (-2.6, 2.7))
    nodes = np.array([0, 0.9, 1.7, 2.4, 3.1, 4.1, 5.3, 6.6, 8.0])
    axes.add_patch(Rectangle((0, -2.4), 8, 2.4, color=BODY, linewidth=0))
    inner = (nodes[:-1] + nodes[1:]) / 2
    axes.plot([0, *inner, 8], [-1.1] * 10, color=style.GREY, linewidth=0.9)
    for left, right in itertools.pairwise(nodes):
        middle = (left + right) / 2
        axes.add_patch(
            Polygon([(left, 0), (right, 0), (middle, -1.1)], facecolor="none", edgecolor=style.GREY, linewidth=0.9)
        )
    for number, place in enumerate(nodes[1:-1], 1):
        left, right = nodes[number - 1], nodes[number + 1]
        chosen = number == 5
        colour = style.VERMILION if chosen else "#9ec3de"
        axes.plot([left, place, right], [0, 1, 0], color=colour, zorder=3 if chosen else 1)
        if chosen:
            axes.fill([left, place, right], [0, 1, 0], color=style.VERMILION, alpha=0.15)
            axes.text(place, 1.1, r"hat function $v_i$, weight $w_i = \int v_i$", color=style.VERMILION, ha="center")
    axes.plot(nodes, 0 * nodes, "o", color=style.BLACK, zorder=4)
    axes.text(
        -0.3,
        2.2,
        r"at each point $x_i$:  overlap $d_i = g_i + u_y(x_i)$,  pressure $p_i$,  status $S_i$,  threshold $T_i$",
    )
    arrow(axes, (4.1, -0.1), (4.1, -1.9), style.BLUE, width=2.4)
    axes.text(4.25, -1.8, r"nodal force $q_i = w_i\, p_i$", color=style.BLUE)


def matching(figure: Figure) -> None:
    """Meshes that do not match: slave's points, their normals, and where these meet the master."""
    axes = bare(figure.subplots(), (-0.2, 12.2), (-2.3, 3.0))
    low = lambda x: 0.28 * np.sin(0.55 * x)  # noqa: E731
    high = lambda x: 0.85 + 0.02 * (x - 6) ** 2  # noqa: E731
    slave, master = np.linspace(0.3, 11.7, 10), np.array([0.3, 2.2, 4.6, 7.2, 9.4, 11.7])
    for nodes, surface, depth, colour in ((slave, low, -1.9, BODY), (master, high, 2.7, OTHER)):
        inner = (nodes[:-1] + nodes[1:]) / 2
        axes.fill([*nodes, 11.7, 0.3], [*surface(nodes), depth, depth], color=colour, linewidth=0)
        for one, after, middle in zip(nodes[:-1], nodes[1:], inner, strict=True):
            tip = (middle, (surface(middle) + depth) / 2)
            axes.plot([one, tip[0], after], [surface(one), tip[1], surface(after)], color=style.GREY, linewidth=0.8)
    axes.plot(slave, low(slave), "-o", color=style.BLUE)
    axes.plot(master, high(master), "-s", color=style.ORANGE)
    for number, x in enumerate((slave[:-1] + slave[1:]) / 2):
        y, normal = low(x), np.array([-0.28 * 0.55 * np.cos(0.55 * x), 1])
        normal /= np.hypot(*normal)
        t = np.linspace(0, 2, 4000)
        along = x + t * normal[0], y + t * normal[1]
        at = np.argmin(abs(along[1] - np.interp(along[0], master, high(master))))
        arrow(axes, (x, y), (along[0][at], along[1][at]), style.VERMILION, width=1.8)
        axes.plot(x, y, "o", color=style.VERMILION, markersize=6, zorder=4)
        if number == 4:
            axes.text(x + 0.25, (y + along[1][at]) / 2, "$-d$", color=style.VERMILION, va="center")
    axes.text(0.4, -2.2, "slave: carries the contact points", color=style.BLUE)
    axes.text(0.4, 2.75, "master: where the normals end", color=style.ORANGE)
    axes.text(11.7, -2.2, r"$d = g + B u$,   nodal forces $B^T q$", ha="right")


def orders(rows: list[tuple[str, float, float]], figure: Figure) -> None:
    """Error of the force over unknowns: (element, unknowns, error), of the answers of lab 8."""
    axes = figure.subplots()
    for number, element in enumerate(dict.fromkeys(row[0] for row in rows)):
        of = [row for row in rows if row[0] == element]
        axes.loglog([row[1] for row in of], [row[2] for row in of], **style.curve(number), label=element)
    axes.set_xlabel("unknowns")
    axes.set_ylabel("relative error of the force")
    axes.set_xticks([500, 1000, 2000, 5000, 10000], ["500", "1000", "2000", "5000", "10 000"])
    axes.minorticks_off()
    axes.grid(color="#e6e6e6", linewidth=0.8)
    style.legend_outside(figure, "right upper")


# ---------------------------------------------------------------- friction, space, adhesion


def coulomb(figure: Figure) -> None:
    """Coulomb's cone, and stick and slip as an active set of the shear."""
    left, right = figure.subplots(1, 2)
    p = np.linspace(0, 1, 2)
    left.fill_between(p, -0.5 * p, 0.5 * p, color=style.BLUE, alpha=0.12, linewidth=0)
    for sign in (1, -1):
        left.plot(p, sign * 0.5 * p, color=style.VERMILION)
    left.text(0.55, 0, r"stick: $|t| < \mu p$", color=style.BLUE, ha="center", va="center")
    left.text(0.5, 0.42, r"slip: $|t| = \mu p$", color=style.VERMILION, ha="right")
    left.set_xlabel("pressure $p$")
    left.set_ylabel("shear $t$")
    left.set_xticks([0], ["0"])
    left.set_yticks([0], ["0"])
    left.set_title("the cone of allowed tractions")
    right.plot([-1, 0, 0, 1], [-1, -1, 1, 1], color=style.VERMILION, linewidth=3)
    right.plot([0, 0], [-1, 1], color=style.BLUE, linewidth=3)
    right.text(0.08, 0.1, "stick", color=style.BLUE)
    right.text(0.4, 1.08, "slip", color=style.VERMILION)
    right.set_yticks([-1, 0, 1], [r"$-\mu p$", "0", r"$\mu p$"])
    right.set_xticks([0], ["0"])
    right.set_ylim(-1.35, 1.35)
    right.set_xlabel("slip")
    right.set_ylabel("shear $t$")
    right.set_title("a wall that is as high as the pressure")


def mindlin(figure: Figure) -> None:
    """Pressure bound and shear of two cylinders, pressed and then dragged: Cattaneo and Mindlin."""
    panels = figure.subplots(1, 3, sharey=True)
    x = np.linspace(-1, 1, 801)
    bound = np.sqrt(1 - x**2)
    for axes, ratio in zip(panels, (0.3, 0.6, 0.9), strict=True):
        c = np.sqrt(1 - ratio)
        shear = bound - np.where(abs(x) < c, c * np.sqrt(np.maximum(1 - (x / c) ** 2, 0)), 0)
        axes.fill_between(x, 0, shear, where=abs(x) < c, color=style.BLUE, alpha=0.15, linewidth=0)
        axes.plot(x, bound, color=style.GREY, linestyle=DASHED, label=r"bound $\mu p$")
        axes.plot(x, shear, color=style.VERMILION, label="shear $t$")
        axes.text(0, 0.06, "stick", color=style.BLUE, ha="center")
        axes.set_title(rf"$Q = {ratio}\,\mu P$")
        axes.set_xticks([-1, c, 1], ["$-a$", "$c$", "$a$"])
        axes.set_yticks([0], ["0"])
        axes.set_ylim(0, 1.1)
        axes.set_xlabel("place $x$")
    panels[0].set_ylabel("traction")
    style.legend_outside(figure, "lower center", *panels[0].get_legend_handles_labels(), ncols=2)


def loop(figure: Figure) -> None:
    """Mindlin's loop of two spheres: the tangential force over the displacement in a cycle."""
    axes = figure.subplots()
    most = 0.9
    first = np.linspace(0, most, 100)
    axes.plot(1 - (1 - first) ** (2 / 3), first, color=style.GREY, label="first pull")
    top = 1 - (1 - most) ** (2 / 3)
    pull = np.linspace(most, -most, 300)
    back = top - 2 * (1 - (1 - (most - pull) / 2) ** (2 / 3))
    axes.fill(
        np.concatenate([back, -back]), np.concatenate([pull, -pull]), color=style.VERMILION, alpha=0.12, linewidth=0
    )
    axes.plot(back, pull, color=style.VERMILION, label="pull back")
    axes.plot(-back, -pull, color=style.BLUE, label="pull again")
    axes.annotate(
        "energy lost in a cycle", (-0.1, -0.2), (0.05, -0.7), color=style.VERMILION, arrowprops={"arrowstyle": "->"}
    )
    axes.set_xlabel("tangential displacement")
    axes.set_ylabel(r"tangential force $Q/(\mu P)$ [–]")
    axes.set_xticks([0], ["0"])
    axes.set_yticks([-1, 0, 1])
    style.legend_outside(figure, "right upper")


def hertz(figure: Figure) -> None:
    """A sphere on a half-space: section with its contact, and Hertz's pressure beside that of a line contact."""
    left, right = figure.subplots(1, 2)
    bare(left, (-3.2, 3.2), (-2.2, 3.1), equal=True)
    x = np.linspace(-3.2, 3.2, 400)
    r = np.maximum(abs(x), 1e-9)
    inside, edge = 1 - x**2 / 2, np.arcsin(np.minimum(1 / r, 1))
    outside = ((2 - x**2) * edge + np.sqrt(np.maximum(x**2 - 1, 0))) / np.pi
    surface = -0.45 * np.where(abs(x) < 1, inside, outside)
    left.fill_between(x, -2.2, surface, color=BODY, linewidth=0)
    left.plot(x, surface, color=style.BLUE)
    radius = 2.25
    left.add_patch(
        Circle((0, surface[200] + radius), radius, facecolor=OTHER, edgecolor=style.ORANGE, linewidth=2, zorder=0)
    )
    arrow(left, (0, 2.9), (0, 1.7), width=2.4)
    left.text(0.15, 2.2, "$P$")
    arrow(left, (-1, -1.0), (1, -1.0), both=True)
    left.text(0, -1.5, "$2a$", ha="center")
    x = np.linspace(-1, 1, 400)
    right.plot(x, np.sqrt(1 - x**2), color=style.VERMILION)
    right.fill_between(x, 0, np.sqrt(1 - x**2), color=style.VERMILION, alpha=0.12, linewidth=0)
    right.set_xticks([-1, 0, 1], ["$-a$", "0", "$a$"])
    right.set_yticks([0, 1], ["0", "$p_0$"])
    right.set_xlabel("$r$")
    right.set_ylabel("pressure")
    right.set_title(r"$p = p_0\,\sqrt{1 - r^2/a^2}$")
    right.set_ylim(0, 1.2)


def adhesion(figure: Figure) -> None:
    """A law that attracts, and the body's lines: where the slope of the law exceeds the body's, the surface jumps."""
    axes = figure.subplots()
    gap = np.linspace(0.82, 3.6, 600)
    p = (8 / 3) * (gap**-9.0 - gap**-3.0)
    axes.plot(-gap, p, color=style.BLUE)
    axes.axhline(0, color=style.BLACK, linewidth=0.8)
    slope = np.gradient(p, -gap)
    k = 0.55
    for branch, colour, words in (
        (slice(120, 600), style.GREEN, "jump in"),
        (slice(0, 120), style.VERMILION, "jump off"),
    ):
        part = np.arange(600)[branch]
        at = part[np.argmin(abs(slope[part] + k))]
        start, x = -gap[at], np.linspace(-3.6, -0.8, 600)
        line = p[at] - k * (x - start)
        axes.plot(x, line, color=colour, linestyle=DASHED, linewidth=1.4)
        axes.plot(start, p[at], "o", color=colour)
        other = np.interp(x, -gap[::-1], p[::-1]) - line
        crossings = [c for c in np.flatnonzero(np.diff(np.sign(other))) if abs(x[c] - start) > 0.25]
        if crossings:
            end = x[crossings[0]], line[crossings[0]]
            arrow(axes, (start, p[at]), end, colour, width=2.4)
            axes.text(
                (start + end[0]) / 2,
                (p[at] + end[1]) / 2 + (0.12 if words == "jump in" else -0.2),
                words,
                color=colour,
                ha="center",
            )
    axes.set_ylim(-1.35, 1.1)
    axes.set_xlim(-3.6, -0.8)
    axes.set_xticks([-1], [r"$-\varepsilon$"])
    axes.set_yticks([0], ["0"])
    axes.set_xlabel("overlap $d$ = $-$gap")
    axes.set_ylabel("pressure $p$")
    axes.text(-2.9, -0.42, "attracts", color=style.BLUE)
    axes.text(-0.97, 0.8, "repels", color=style.BLUE, ha="right")


SCHEME = (tangents, overshoot, cut, models, four_five, status, uniform, proximal, bridge)
BEYOND = (collocation, matching, coulomb, mindlin, loop, hertz, adhesion)
PICTURES = {draw.__name__: draw for draw in (rough, laws, springs, hard, disc, *SCHEME, *BEYOND)}
