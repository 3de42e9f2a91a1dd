"""The frames of a movie: points on the law's curve, pressure profile, deformed bodies; one frame per Newton step."""

from dataclasses import dataclass

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.ticker import MaxNLocator

from postprocess import style
from postprocess.laws import Law, law_of, overlap_at
from postprocess.results import LAW, OPEN, TANGENT, WALL, ResultsError, Run, Steps, is_number

SIZE = (8.6, 4.8)  # inches
CROWD = 120  # points beyond which their dots are drawn smaller
OFF = 0.01  # of the picture's height: points farther than this from the law are drawn as off it
HUGE = 1e100  # overlaps and pressures beyond it are not drawn
FILLS = ("#DCE9F3", "#E9E6E1", "#E3EFE3")  # of the bodies, by region
LINES = (style.BLUE, "#6E675F", style.GREEN)
# Status of a point: what it is called, and how it is drawn; colour and shape both tell.
LOOKS: dict[int, tuple[str, style.Look]] = {
    OPEN: ("open", {"marker": "o", "markerfacecolor": "white", "color": style.GREY, "markersize": 3.5}),
    LAW: ("on the law", {"marker": "o", "color": style.BLUE, "markersize": 4.5}),
    WALL: ("at the wall", {"marker": "s", "color": style.VERMILION, "markersize": 4.5}),
    TANGENT: ("on the tangent", {"marker": "D", "color": style.VERMILION, "markersize": 4.0}),
}


@dataclass(frozen=True)
class Plane:
    """Limits of the plane of s = d - d0 and pressure, the law's curve in it, and its end of contact."""

    left: float
    right: float
    top: float
    curve: tuple[np.ndarray, np.ndarray] | None
    at: Law | None  # s -> pressure


class NewtonMovie:
    """Draws the frames of one run, which was made with -states 1, into one figure."""

    def __init__(self, run: Run, units: style.Units):
        self.run, self.units, self.steps = run, units, run.steps
        self.count = len(self.steps.newton)
        self.state = states_of_steps(run)
        self.plane = plane_of(run)
        self.scale = 1.0 if len(self.steps.x) <= CROWD else 0.6
        self.rigid = len(np.unique(run.mesh.region)) == 1
        self.figure = Figure(figsize=SIZE)
        FigureCanvasAgg(self.figure)
        self.left = self.figure.add_axes((0.075, 0.19, 0.4, 0.65))
        self.above = self.figure.add_axes((0.575, 0.59, 0.405, 0.25))
        self.below = self.figure.add_axes((0.575, 0.19, 0.405, 0.31))
        self.window = window_of(run, self.below.bbox.height / self.below.bbox.width)

    def draw(self, index: int) -> None:
        """Draws frame `index`, 0 ... count - 1, in place of the one before."""
        for artist in [*self.figure.legends, *self.figure.texts]:
            artist.remove()
        for axes in (self.left, self.above, self.below):
            axes.clear()
        self.figure.text(0.5, 0.975, frame_title(self.run, index), fontsize=11, ha="center", va="top")
        self.figure.text(
            0.5, 0.93, f"Algorithm 1, {algorithm_line_caption(self.run, index)}", fontsize=9, ha="center", va="top"
        )
        self.draw_plane(index)
        self.draw_profile(index)
        self.draw_bodies(index)
        used = [status for status in LOOKS if status != TANGENT or (self.steps.status == TANGENT).any()]
        looks = [LOOKS[status] for status in used]
        handles = [Line2D([], [], linestyle="none", label=name, **look) for name, look in looks]
        handles.append(Line2D([], [], linestyle="none", marker=">", color=style.BLACK, label="beyond the picture"))
        hollow: style.Look = {"marker": "o", "markerfacecolor": "white", "color": style.BLUE, "linewidth": 0.6}
        handles.append(Line2D([], [], label="off the law: on its tangent of the step before", **hollow))
        self.figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.05, 0.0), ncols=5, columnspacing=1.5)

    def draw_plane(self, index: int) -> None:
        """The law, its walls, the points where the linear solve left them; hollow, with a line to it, off the law."""
        axes, plane, steps = self.left, self.plane, self.steps
        if plane.curve is not None:
            axes.plot(*plane.curve, color=style.BLACK, linewidth=1.0, zorder=2)
        walls = np.unique(steps.tau[index][np.isfinite(steps.tau[index])])
        walls = walls[(walls > plane.left) & (walls < plane.right)]
        foot = plane.at(walls) if plane.at is not None else np.zeros(len(walls))
        seen = foot < plane.top
        segments = [[(wall, low), (wall, plane.top)] for wall, low in zip(walls[seen], foot[seen], strict=True)]
        axes.add_collection(LineCollection(segments, color=style.VERMILION, linewidth=0.9, alpha=0.7, zorder=1))
        overlap, pressure = steps.s[index], steps.pressure[index]
        bottom = -0.06 * plane.top
        at = np.clip(overlap, plane.left, plane.right), np.clip(pressure, bottom, plane.top)
        outside = (overlap > plane.right) | (pressure > plane.top) | (pressure < bottom)
        off, expected = points_off_law(steps, plane, index)
        stems = [[(s, p), (s, min(q, plane.top))] for s, p, q in zip(*at, expected, strict=True)]
        drawn = off & ~outside & (overlap >= plane.left)
        chosen = [stem for stem, each in zip(stems, drawn, strict=True) if each]
        axes.add_collection(LineCollection(chosen, color=style.GREY, linewidth=0.6, zorder=3))
        for status, (_, look) in LOOKS.items():
            size = {"markersize": self.scale * look["markersize"]}
            for hollow in (False, True):
                chosen = (steps.status[index] == status) & ~outside & (overlap >= plane.left) & (off == hollow)
                face = {"markerfacecolor": "white"} if hollow else {}
                axes.plot(at[0][chosen], at[1][chosen], linestyle="none", zorder=4, **{**look, **size, **face})
        for chosen, marker in (
            (outside & (overlap > plane.right), ">"),
            (outside & (overlap <= plane.right) & (pressure > plane.top), "^"),
            (outside & (overlap <= plane.right) & (pressure < bottom), "v"),
        ):
            colors = [LOOKS[status][1]["color"] for status in steps.status[index][chosen]]
            axes.scatter(at[0][chosen], at[1][chosen], c=colors, marker=marker, s=28, clip_on=False, zorder=5)
        axes.set_xlim(plane.left, plane.right)
        axes.set_ylim(bottom, plane.top)
        axes.set_xlabel(f"overlap of the asperities $s = d - d_0$ [{self.units.length}]")
        axes.set_ylabel(f"pressure $p$ [{self.units.stress}]")
        axes.set_title(wall_caption(walls, steps.tau[index], plane), fontsize=9, loc="left")

    def draw_profile(self, index: int) -> None:
        """Pressure along the contact; the last step's as a line to compare with."""
        axes, steps = self.above, self.steps
        axes.plot(steps.x, steps.pressure[-1], color=style.GREY, linewidth=0.8, zorder=1)
        pressure = np.clip(steps.pressure[index], -0.06 * self.plane.top, self.plane.top)
        for status, (_, look) in LOOKS.items():
            chosen = steps.status[index] == status
            axes.plot(
                steps.x[chosen], pressure[chosen], linestyle="none", zorder=2, **{**look, "markersize": 3 * self.scale}
            )
        axes.set_xlim(self.window[0], self.window[1])
        axes.set_ylim(-0.06 * self.plane.top, self.plane.top)
        axes.yaxis.set_major_locator(MaxNLocator(nbins=4))
        axes.set_ylabel(f"$p$ [{self.units.stress}]")
        axes.set_title("pressure along the contact; line: last step", fontsize=9, loc="left")

    def draw_bodies(self, index: int) -> None:
        """The deformed bodies at true scale around the contact; a rigid obstacle as the points see it."""
        axes, run = self.below, self.run
        states, mesh, state = run.states, run.mesh, self.state[index]
        x, y = states.x + states.ux[state], states.y + states.uy[state]
        left, right, bottom, top = self.window
        for order, region in enumerate(np.unique(mesh.region)):
            triangles = mesh.triangles[mesh.region == region]
            near = (x[triangles].max(1) > left) & (x[triangles].min(1) < right)
            near &= (y[triangles].max(1) > bottom - (right - left)) & (y[triangles].min(1) < top + (right - left))
            corners = np.stack([x[triangles[near]], y[triangles[near]]], axis=-1)
            look: style.Look = {"facecolor": FILLS[order % len(FILLS)], "edgecolor": LINES[order % len(LINES)]}
            axes.add_collection(PolyCollection(list(corners), **look, linewidth=0.2, alpha=0.85, zorder=1))
        if self.rigid:
            outline = obstacle_outline(run, self.steps, index, x, y)
            axes.add_patch(Polygon(outline, facecolor=FILLS[1], edgecolor=LINES[1], linewidth=0.8, alpha=0.7, zorder=2))
        axes.set_aspect("equal")
        axes.set_xlim(left, right)
        axes.set_ylim(bottom, top)
        axes.yaxis.set_major_locator(MaxNLocator(nbins=4))
        axes.set_xlabel(f"$x$ [{self.units.length}]")
        axes.set_ylabel(f"$y$ [{self.units.length}]")


def frame_title(run: Run, index: int) -> str:
    """Where in the scheme a frame stands."""
    steps = run.steps
    total = steps.newton[-1]
    if index == 0:
        return f"before the first of {style.count(total, 'Newton step')}"
    history = run.history
    row = int(steps.newton[index]) - 1
    words = f"Newton step {steps.newton[index]} of {total}, residual ${style.number(history['residual'][row])}$"
    words = f"adaptation {steps.adaptation[index]}, {words}"
    last = history["step"].max()
    return f"load step {history['step'][row]} of {last}, {words}" if last > 1 else words


def algorithm_line_caption(run: Run, index: int) -> str:
    """The lines of Algorithm 1 that a frame has come through, and the one where it goes on."""
    if index == 0:
        return "lines 1 to 3: first threshold, bodies at rest; line 4 is next"
    history, row = run.history, int(run.steps.newton[index]) - 1
    model = history["step"], history["adaptation"]
    last = row + 1 == len(history["newton"])
    if not last and all(each[row] == each[row + 1] for each in model):
        changes = int(history["statusChanges"][row])
        why = f"{style.count(changes, 'status change')}" if changes else "residual above the tolerance"
        return f"lines 4, 5: one linear solve, multiplier and status; line 6: {why}, back to line 4"
    if not last and model[0][row] != model[0][row + 1]:
        return "line 10: the thresholds stand still; the next load step begins at line 1"
    if not last:
        return "line 6: this model is solved; line 8 raises the thresholds; line 9: not yet at rest, back to line 1"
    return "line 10: the thresholds stand still, the end" if run.summary["converged"] else "stopped before its end"


def points_off_law(steps: Steps, plane: Plane, index: int) -> tuple[np.ndarray, np.ndarray]:
    """(off, pressure), a point each: whether it is off the law and its wall, and the law's pressure at its overlap."""
    s, pressure, tau = steps.s[index], steps.pressure[index], steps.tau[index]
    if plane.at is None:
        return np.zeros(len(s), bool), pressure
    expected = np.asarray(plane.at(s))
    at_wall = (steps.status[index] == WALL) & (np.abs(s - tau) < OFF * plane.right)
    expected = np.where(at_wall & (pressure >= expected), pressure, expected)
    return np.abs(pressure - expected) > OFF * plane.top, expected


def wall_caption(walls: np.ndarray, tau: np.ndarray, plane: Plane) -> str:
    """What the vertical lines are."""
    if not np.isfinite(tau).any():
        return "law; no wall"
    name = "law" if plane.curve is not None else "points"
    if len(walls) == 0:
        return f"{name}; wall beyond the picture"
    if len(walls) == 1:
        return f"{name}; wall at $T - d_0 = {style.number(walls[0])}$"
    return f"{name}; walls: $T - d_0$ of the points"


def states_of_steps(run: Run) -> np.ndarray:
    """The state of states.csv that belongs to each of the steps: the last one with its number."""
    last = {int(newton): state for state, newton in enumerate(run.states.newton)}
    missing = [int(newton) for newton in run.steps.newton if int(newton) not in last]
    if missing:
        raise ResultsError(run.path / "states.csv", f"has no state of Newton step {missing[0]}, which steps.csv has")
    return np.array([last[int(newton)] for newton in run.steps.newton])


def plane_of(run: Run) -> Plane:
    """Limits that show the last step well and most of the others; a few far points are left outside."""
    steps, law = run.steps, law_of(run)
    if max(np.abs(steps.s).max(), np.abs(steps.pressure).max()) > HUGE:
        raise ResultsError(run.path, f"holds overlaps or pressures beyond {HUGE:g}, too large to be drawn")
    after = slice(1, None) if len(steps.newton) > 1 else slice(None)
    greatest, pressures = steps.s[after].max(axis=1), steps.pressure[after].max(axis=1)
    top = 1.12 * max(pressures[-1], np.quantile(pressures, 0.8))
    walls = steps.tau[after][steps.status[after] == WALL]
    ends = [greatest[-1], np.quantile(greatest, 0.85), *walls[:1], *walls[-1:]]
    span = max(*ends, 0.0)
    if span == 0 or not np.isfinite(span):
        span = abs(finite(run, "d0", 0.0)) or float(np.ptp(steps.s[-1])) or 1.0
    left, right = -0.45 * span, 1.12 * span
    if not top > 0:
        top = 1.0 if law is None else max(float(law(np.array([right]))[0]), 1e-300)
        top = top if np.isfinite(top) and top > 0 else 1.0
    if law is None:
        return Plane(left, right, float(top), None, None)
    end = overlap_at(law, 1.05 * top, 0.0, right)
    overlap = np.concatenate([[left], end * np.linspace(0, 1, 400)])
    pressure = np.minimum(law(overlap), 1.05 * top)
    if run.summary["parameters"].get("law") == "signorini":
        overlap, pressure = np.array([left, 0.0]), np.zeros(2)
    return Plane(left, right, float(top), (overlap, pressure), law)


def window_of(run: Run, ratio: float) -> tuple[float, float, float, float]:
    """Limits (left, right, bottom, top) around the points that carry pressure in any step; ratio: height to width."""
    steps = run.steps
    touched = steps.x[(steps.pressure > 0).any(axis=0)]
    if len(touched) < 2:
        touched = steps.x
    middle = 0.5 * (touched.min() + touched.max())
    reach = 0.675 * max(touched.max() - touched.min(), 1e-300)
    height = 2 * reach * ratio
    surface = float(np.mean(steps.y))
    return middle - reach, middle + reach, surface - 0.7 * height, surface + 0.3 * height


def obstacle_outline(run: Run, steps: Steps, index: int, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The outline (n, 2) of the rigid obstacle: at each point as far above the deformed surface as the gap says.

    x, y: deformed vertices. Scenes with a disc (parameter R) get its lower half, at the height that the points tell.
    """
    states = run.states
    surface = np.flatnonzero(np.abs(states.y - steps.y.mean()) < 1e-9 * max(np.ptp(states.y), 1e-300))
    surface = surface[np.argsort(states.x[surface])]
    if len(surface) < 2:
        raise ResultsError(run.path / "states.csv", "has no vertices at the height of the points in steps.csv")
    height = np.interp(steps.x, states.x[surface], y[surface])
    overlap = steps.overlap[index]
    radius = finite(run, "R", 0.0)
    if radius <= 0:
        top = height.max() + 2 * np.ptp(steps.x)
        return np.column_stack(
            [[*steps.x, steps.x[-1], steps.x[0]], [*(height - overlap), top, top]],
        )
    offset = finite(run, "offset", 0.0)
    if run.summary["parameters"].get("distance") == "exact":
        across = np.interp(steps.x, states.x[surface], x[surface]) - offset
        reach = np.maximum((radius - overlap) ** 2 - across**2, 0)
    else:
        reach = np.maximum(radius**2 - (steps.x - offset) ** 2, 0)
    near = np.argsort(np.abs(steps.x - offset))[: max(1, len(steps.x) // 5)]
    rise = np.sqrt(reach) if run.summary["parameters"].get("distance") == "exact" else np.sqrt(reach) - overlap
    centre = float(np.median((height + rise)[near]))
    angle = np.linspace(np.pi, 2 * np.pi, 721)
    return np.column_stack([offset + radius * np.cos(angle), centre + radius * np.sin(angle)])


def finite(run: Run, name: str, otherwise: float) -> float:
    """A number from the summary's parameters, or what stands in for it."""
    value = run.summary["parameters"].get(name)
    return float(value) if is_number(value) else otherwise
