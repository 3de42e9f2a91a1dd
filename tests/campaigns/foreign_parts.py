"""Parts that no constant was fitted on: drawn by a seed, with random dimensions, laws, loads and rotations.

`parts(seed)` gives all of them. A part says how it is drawn (`geo(Draw)`: for gmsh, its circles of few sides or of the
sizes of a finer run), its case file, and what is known of its numbers in closed form, each with the doubt of that form.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

Random = np.random.Generator
Known = dict[str, tuple[float, float]]  # number: value and doubt
INFINITE = (np.inf, 0.0)  # a pressure that grows without bound as the mesh is refined


@dataclass(frozen=True)
class Draw:
    """How a geometry is to be written: its sizes times `factor`; smooth: no circle of few sides; turned: as rotated."""

    factor: float = 1.0
    order: int = 1
    named: bool = False  # every free boundary has a name, for a statement
    smooth: bool = False
    turned: bool = False


@dataclass(frozen=True)
class Part:
    """truth_case: where the truth is another problem (a body really turned); causes: what it can be false by."""

    name: str
    drawn: Callable[["Sketch"], str]
    case: str
    known: Known = field(default_factory=dict)
    causes: tuple[str, ...] = ()
    truth_case: str = ""
    space: bool = False
    fine: float = 0.35  # factor of sizes of the fine run that gives the rest of the truth; 0: none

    def geo(self, draw: Draw) -> str:
        return self.drawn(Sketch(draw))


class Sketch:
    """A plane geometry for gmsh; sides() asks for a number of sides, which a smooth drawing leaves out."""

    def __init__(self, draw: Draw, space: bool = False):
        self.draw, self.space = draw, space
        self.lines: list[str] = []
        self.points, self.curves, self.used = 0, 0, set()
        self.surfaces = 0
        self.names: list[str] = []
        self.angle, self.pivot = 0.0, np.zeros(2)

    def turn(self, angle: float, pivot=(0, 0)) -> None:
        """What is drawn from now on is turned."""
        self.angle, self.pivot = angle, np.array(pivot, float)

    def point(self, x: float, y: float, size: float) -> int:
        cosine, sine = np.cos(self.angle), np.sin(self.angle)
        x, y = self.pivot + np.array([[cosine, -sine], [sine, cosine]]) @ (np.array([x, y], float) - self.pivot)
        self.points += 1
        self.lines.append(f"Point({self.points}) = {{{x:.16g}, {y:.16g}, 0, {size * self.draw.factor:.6g}}};")
        return self.points

    def on_circle(self, size: float, radius: float) -> float:
        """A size on a curve of this radius: a smooth drawing has 64 sides round it at least."""
        return min(size, 2 * np.pi * radius / 64 / self.draw.factor) if self.draw.smooth else size

    def curve(self, kind: str, *points: int, sides: int = 0) -> int:
        self.curves += 1
        self.lines.append(f"{kind}({self.curves}) = {{{', '.join(map(str, points))}}};")
        if sides and not self.draw.smooth:
            self.lines.append(f"Transfinite Curve {{{self.curves}}} = {sides + 1};")
        return self.curves

    def oval(self, x: float, y: float, a: float, b: float, size: float, sides: int = 0, bottom: float = 0) -> list[int]:
        """An ellipse of `sides` sides, equal where a is b; or with a size at its `bottom`, and sides above alone."""
        counts = [sides // 4 + (k < sides % 4) for k in range(4)]
        if bottom:
            counts[0] = counts[3] = 0
        share = np.cumsum([0, *counts[:3]]) / sides if sides and a == b and not bottom else np.arange(4) / 4
        size = min(size, 2 * np.pi * max(a, b) / sides) if sides else size
        angles = 2 * np.pi * share - np.pi / 2
        ends = []
        for k, t in enumerate(angles):
            near = self.on_circle(bottom if bottom and k == 0 else size, (a * a / b, b * b / a)[k % 2])
            ends.append(self.point(x + a * np.cos(t), y + b * np.sin(t), near))
        centre, far = self.point(x, y, size), self.point(x + 1.01 * max(a, b) * (a >= b), y + 1.01 * b * (a < b), size)
        found = []
        for k in range(4):
            last = ends[(k + 1) % 4]
            if a == b:
                found.append(self.curve("Circle", ends[k], centre, last, sides=counts[k]))
            else:
                found.append(self.curve("Ellipse", ends[k], centre, far, last, sides=counts[k]))
        return found

    def outline(self, corners: list[tuple[float, ...]]) -> tuple[list[int], list[int]]:
        """A closed outline through corners (x, y, size[, radius of its fillet[, sides of the fillet]]).

        Its straight sides, the k-th from corner k on, and its fillets, in the order of their corners."""
        places = np.array([corner[:2] for corner in corners], float)
        starts, ends, fillets = [], [], []
        for k, (x, y, size, *more) in enumerate(corners):
            radius = more[0] if more else 0
            if not radius:
                starts.append(self.point(x, y, size))
                ends.append(starts[-1])
                fillets.append(None)
                continue
            back, ahead = places[k - 1] - (x, y), places[(k + 1) % len(corners)] - (x, y)
            back, ahead = back / np.hypot(*back), ahead / np.hypot(*ahead)
            size = self.on_circle(size, radius)
            half = np.arccos(np.clip(back @ ahead, -1, 1)) / 2
            middle = (back + ahead) / np.hypot(*(back + ahead))
            centre = self.point(*((x, y) + middle * radius / np.sin(half)), size)
            starts.append(self.point(*((x, y) + back * radius / np.tan(half)), size))
            ends.append(self.point(*((x, y) + ahead * radius / np.tan(half)), size))
            fillets.append((starts[-1], centre, ends[-1], more[1] if len(more) > 1 else 0))
        arcs, straight = [], []
        for k, fillet in enumerate(fillets):
            if fillet:
                arcs.append(self.curve("Circle", *fillet[:3], sides=fillet[3]))
            straight.append(self.curve("Line", ends[k], starts[(k + 1) % len(corners)]))
        return straight, arcs

    def body(self, name: str, *loops: list[int]) -> None:
        """A surface between loops; a curve against its loop's way has a minus."""
        numbers = []
        for loop in loops:
            self.curves += 1
            numbers.append(self.curves)
            self.lines.append(f"Curve Loop({self.curves}) = {{{', '.join(map(str, loop))}}};")
            self.used |= set(map(abs, loop))
        self.surfaces += 1
        tag = self.surfaces
        self.lines.append(f"Plane Surface({tag}) = {{{', '.join(map(str, numbers))}}};")
        self.names.append(f'Physical Surface("{name}") = {{{tag}}};')

    def group(self, name: str, curves: list[int]) -> None:
        self.used -= set(curves)
        self.names.append(f'Physical Curve("{name}") = {{{", ".join(map(str, curves))}}};')

    def named(self, **curves: list[int]) -> str:
        """The geometry, with these groups of curves; a name's _ is -."""
        for word, these in curves.items():
            self.group(word.replace("_", "-"), these)
        return self.text()

    def rectangle(self, x0: float, y0: float, x1: float, y1: float, size: float) -> list[int]:
        """Its sides: below, right, above, left."""
        return self.outline([(x0, y0, size), (x1, y0, size), (x1, y1, size), (x0, y1, size)])[0]

    def text(self, further: str = "") -> str:
        lines = [*self.lines, *self.names]
        if self.draw.named and self.used:
            lines.append(f'Physical Curve("rest") = {{{", ".join(map(str, sorted(self.used)))}}};')
        return "\n".join([*lines, further, *options(self.draw)]) + "\n"


def options(draw: Draw) -> list[str]:
    return [f"Mesh.ElementOrder = {draw.order};"] if draw.order > 1 else []


def body(name: str, E: float, nu: float) -> str:
    return f"body {name} E {E:.9g} nu {nu:.9g}\n"


def moduli(random: Random) -> tuple[float, float]:
    return float(10 ** random.uniform(2, 5.3)), float(random.uniform(0, 0.45))


def law(random: Random, E: float, length: float) -> str:
    """Hard as often as not; a layer of a random law else, soft and hard beside the body."""
    kind = random.integers(6)
    thick = length * 10 ** random.uniform(-4, -2.5)
    if kind == 0:
        m = random.uniform(1.05, 6)
        pressure = E * thick / length * 10 ** random.uniform(0, 4)
        return f" law power kappa {pressure / thick**m:.6g} m {m:.4g} d0 {-thick:.6g}"
    if kind == 1:
        return f" law exponential p0 {1e-4 * E:.6g} beta {5 / thick:.6g} d0 {-thick:.6g}"
    return ""


def few(random: Random) -> int:
    """Sides of a circle: 5 to 60."""
    return int(np.exp(random.uniform(np.log(5), np.log(60.99))))


# ---------------------------------------------------------------- closed forms


def press_fit(name: str, random: Random) -> Part:
    """Two rings with an interference that is small beside the radius: Lame. A part of it by heat, or twisted."""
    a, c, b = np.cumsum(random.uniform(0.5, 1.5, 3)) * 10
    (E1, nu1), (E2, nu2) = moduli(random), moduli(random)
    E2, strain = E1 * random.uniform(0.3, 3), random.random() < 0.7
    over, angle = c * 1e-4 * random.uniform(1, 5), random.uniform(0.1, 0.9) * 2 * np.pi / 100
    joint, inside, outside = int(random.integers(24, 80)), few(random), few(random)

    def geo(sketch: Sketch) -> str:
        size = 2 * np.pi * c / joint
        sketch.turn(angle)
        shaft = sketch.oval(0, 0, c + over, c + over, size, round(1.25 * joint))
        bore = sketch.oval(0, 0, a, a, (c - a) / 2, inside)
        sketch.turn(0)
        hub, outer = sketch.oval(0, 0, c, c, size, joint), sketch.oval(0, 0, b, b, (b - c) / 2, outside)
        sketch.body("inner", shaft, bore)
        sketch.body("outer", outer, hub)
        held = {"bore": bore, "outside": outer} if name.startswith("twisted") else {}
        return sketch.named(shaft=shaft, hub=hub, **held)

    e1, e2, n1, n2 = E1, E2, nu1, nu2
    if strain:
        e1, e2, n1, n2 = E1 / (1 - nu1**2), E2 / (1 - nu2**2), nu1 / (1 - nu1), nu2 / (1 - nu2)
    case = f"state {'strain' if strain else 'stress'}\n{body('inner', E1, nu1)}{body('outer', E2, nu2)}"
    case += "contact hub shaft"

    def give(e: float, n: float, held: float) -> float:
        """Displacement over pressure and radius of a ring that is held at this share of the radius."""
        return (1 - n * n) / e * (1 - held**2) / (1 + n + (1 - n) * held**2)

    r, pressed = c + over, over  # of the inner ring at rest: its pressure is smaller by c / r
    if name.startswith("shrink"):
        cold = random.uniform(0.3, 3) * over / c
        pressed += c * cold
        case += f"\nexpand outer 1e-5 {-1e5 * cold / (1 + nu2 * strain):.9g}"
    p = pressed / c / (((r**2 + a**2) / (r**2 - a**2) - n1) / e1 + ((b**2 + c**2) / (b**2 - c**2) + n2) / e2)
    if name.startswith("twisted"):
        p = over / c / (give(e1, n1, a / r) - give(e2, n2, b / c))
    known = {"normalForce": 2 * np.pi * c * p, "pressureMax": p, "contactLength": 2 * np.pi * c}
    doubt = 0.3 * pressed / (min(c - a, b - c) if name.startswith("twisted") else c)
    found = contact_knows(known, doubt)
    if name.startswith("twisted"):
        mu, share = random.uniform(0.05, 0.6), random.choice([random.uniform(0.2, 0.8), random.uniform(1.2, 3)])
        soft = [(1 + nu) / (2 * np.pi * E) * abs(1 / c**2 - 1 / s**2) for E, nu, s in ((E1, nu1, a), (E2, nu2, b))]
        most = mu * p * 2 * np.pi * c**2
        case += f" friction {mu:.9g}\nclamp bore\nrotate outside 0 0 {share * most * sum(soft):.9g}"
        found["prescribed.0.needs"] = (min(share, 1) * most, doubt * most)
    return Part(name, geo, f"{case}\n", found, ("shape",), fine=0)


def contact_knows(known: dict[str, float], doubt: float = 1e-9, contact: int = 0) -> Known:
    """Numbers of one contact, with a relative doubt."""
    return {f"contacts.{contact}.{word}": (float(value), abs(float(value)) * doubt) for word, value in known.items()}


def lined_tube(name: str, random: Random) -> Part:
    """A tube under inner pressure in a rigid ring that it just fills: Lame."""
    a = random.uniform(5, 15)
    b = a * random.uniform(1.3, 3)
    E, nu = moduli(random)
    p, inside, outside = 1e-3 * E * random.uniform(0.1, 1), few(random), int(random.integers(20, 60))

    def geo(sketch: Sketch) -> str:
        skin = sketch.oval(0, 0, b, b, (b - a) / 3, outside)
        bore = sketch.oval(0, 0, a, a, (b - a) / 3, inside)
        sketch.body("tube", skin, bore)
        return sketch.named(skin=skin, bore=bore)

    outer = 2 * (1 - nu) * p / (1 + (1 - 2 * nu) * (b / a) ** 2)
    known = {"normalForce": 2 * np.pi * b * outer, "pressureMax": outer, "contactLength": 2 * np.pi * b}
    case = f"{body('tube', E, nu)}obstacle skin circle 0 0 R {b:.16g} inside\npressure bore {p:.9g}\n"
    return Part(name, geo, case, contact_knows(known), ("shape",), fine=0)


def heavy(name: str, random: Random) -> Part:
    """An ellipse, with a hole or without, lies on a plane: its weight."""
    a, b = random.uniform(2, 8, 2)
    hole, sides, inside = random.choice([0, 0.4]) * min(a, b), few(random), few(random)
    E, nu = moduli(random)
    density = 1e-3 * E / b * random.uniform(0.3, 1)

    def geo(sketch: Sketch) -> str:
        rim = sketch.oval(0, b, a, b, b / 3, sides, b / 60)
        sketch.body("disc", rim, *([sketch.oval(0, b, hole, hole, b / 5, inside)] if hole else []))
        return sketch.named(foot=[rim[0], rim[3]])

    case = f"{body('disc', E, nu)}obstacle foot plane 0 0 0 1\nweight disc 0 {-density:.9g}\n"
    weight = density * np.pi * (a * b - hole**2)
    return Part(name, geo, case, contact_knows({"force": weight}), ("shape",))


def groove(name: str, random: Random) -> Part:
    """A disc in a rigid groove: half its weight on each flank, over the cosine of its slope."""
    r, slope, sides = random.uniform(2, 8), random.uniform(0.3, 1.1), int(random.integers(40, 100))
    E, nu = moduli(random)
    density = 5e-3 * E / r * random.uniform(0.3, 1)

    def geo(sketch: Sketch) -> str:
        rim = sketch.oval(0, 0, r, r, r / 8, sides)
        sketch.body("disc", rim)
        return sketch.named(rim=rim)

    lines = [
        f"obstacle rim plane {-side * r * np.sin(slope):.16g} {-r * np.cos(slope):.16g} "
        f"{side * np.sin(slope):.16g} {np.cos(slope):.16g}\n"
        for side in (1, -1)
    ]
    case = f"{body('disc', E, nu)}{''.join(lines)}weight disc 0 {-density:.9g}\n"
    flank = density * np.pi * r**2 / (2 * np.cos(slope))
    known = contact_knows({"force": flank}) | contact_knows({"force": flank}, contact=1)
    return Part(name, geo, case, known, ("shape",))


def plank(name: str, random: Random) -> Part:
    """A stiff plank on two round feet, one of which finds its floor lower by `drop`: a lever."""
    length, r, thick = random.uniform(10, 20), random.uniform(0.5, 1.5), random.uniform(1, 5)
    tail, drop = random.uniform(1, 4), length * random.uniform(0.01, 0.09)
    E, nu, sides = 1e6, 0.3, int(random.integers(8, 30))

    def geo(sketch: Sketch) -> str:
        feet, corners = [], []
        for x in (0.0, length):
            ends = [sketch.point(x + side * r, 0, r / 4) for side in (-1, 0, 1)]
            low = sketch.point(x, -r, r / 60)
            halves = (ends[0], ends[1], low), (low, ends[1], ends[2])
            feet.append([sketch.curve("Circle", *half, sides=sides // 2) for half in halves])
            corners.append(ends)
        above = [sketch.point(x, thick, thick / 3) for x in (-r, length + tail)]
        last = sketch.point(length + tail, 0, thick / 3)
        middle = sketch.curve("Line", corners[0][2], corners[1][0])
        rest = [sketch.curve("Line", *p) for p in pairwise([corners[1][2], last, *above[::-1], corners[0][0]])]
        sketch.body("plank", [*feet[0], middle, *feet[1], *rest])
        return sketch.named(one=feet[0], other=feet[1])

    foot, slab = np.pi * r**2 / 2, (length + tail + r) * thick
    area = slab + 2 * foot
    across = (slab * (length + tail - r) / 2 + foot * length) / area
    up = (slab * thick / 2 - 2 * foot * 4 * r / (3 * np.pi)) / area
    density = 1e-4 * E * r / area
    tilt = -drop / np.sqrt(length**2 - drop**2)
    weight = density * area
    other = weight * (across - up * tilt) / length
    case = (
        f"{body('plank', E, nu)}obstacle one plane 0 {-r:.16g} 0 1\n"
        f"obstacle other plane 0 {-r - drop:.16g} 0 1\nweight plank 0 {-density:.9g}\n"
    )
    doubt = 1e-4  # feet are dented by 1e-4 of their radius or so
    known = contact_knows({"force": weight - other}, doubt) | contact_knows({"force": other}, doubt, 1)
    return Part(name, geo, case, known, ("rotation", "shape"), fine=0)


def crack(name: str, random: Random) -> Part:
    """A block with a cut that is pressed shut, nu = 0: the whole block's uniform pressure."""
    a, length, h = random.uniform(1, 2), random.uniform(2.5, 4), random.uniform(0.1, 0.2)
    E, _ = moduli(random)
    move = random.uniform(1e-3, 1e-2)

    def geo(sketch: Sketch) -> str:
        base = [sketch.point(x, -1, h) for x in (0, length)]
        tip, end = sketch.point(a, 0, h / 4), sketch.point(length, 0, h)
        low, high = sketch.point(0, 0, h), sketch.point(0, 0, 1.3 * h)
        head = [sketch.point(x, 1, h) for x in (length, 0)]
        way = [*base, end, tip, low, base[0]], [end, *head, high, tip]
        line = [sketch.curve("Line", *pair) for points in way for pair in pairwise(points)]
        loops = [line[:5], [-line[2], *line[5:]]]
        for loop in loops:
            sketch.curves += 1
            sketch.lines.append(f"Curve Loop({sketch.curves}) = {{{', '.join(map(str, loop))}}};")
            sketch.lines.append(f"Plane Surface({sketch.curves}) = {{{sketch.curves}}};")
        sketch.names.append(f'Physical Surface("block") = {{{sketch.curves - 1}, {sketch.curves}}};')
        for word, k in (("base", 0), ("lower", 3), ("upper", 8), ("head", 6)):
            sketch.group(word, [line[k]])
        return sketch.text()

    p = E * move / 2
    case = f"{body('block', E, 0)}contact lower upper\nsymmetry base\nmove head 0 {-move:.9g}\n"
    return Part(
        name, geo, case, contact_knows({"force": p * a, "pressureMax": p, "contactLength": a}), ("tip",), fine=0
    )


def shank(name: str, random: Random) -> Part:
    """A bolt under a rigid head, tightened against a sleeve, then heated or pulled: the joint diagram."""
    r, gap, wall, length, high = random.uniform([0.5, 0.2, 0.5, 4, 0.5], [2, 1, 3, 12, 2])
    (E1, _), cut = moduli(random), length * random.uniform(0.2, 0.8)
    E2, out = E1 * random.uniform(0.2, 2), r + gap + wall
    bolt, sleeve = E1 * r / length, E2 * wall / length
    F, pull, heat = E1 * r * 1e-3, random.choice([0, random.uniform(0.2, 3)]), random.choice([0, random.uniform(0, 1)])

    def geo(sketch: Sketch) -> str:
        h = 0.4 * r
        ends = [sketch.point(x, y, h) for y in (0, cut, length) for x in (0, r)]
        rim = [sketch.point(x, y, h) for x, y in ((out, length), (out, length + high), (0, length + high))]
        across = [sketch.curve("Line", ends[2 * k], ends[2 * k + 1]) for k in range(3)]
        left = [sketch.curve("Line", ends[2 * k + 2], ends[2 * k]) for k in range(2)]
        right = [sketch.curve("Line", ends[2 * k + 1], ends[2 * k + 3]) for k in range(2)]
        head = [sketch.curve("Line", *pair) for pair in pairwise([ends[5], *rim, ends[4]])]
        for k in range(2):
            sketch.body(f"shank{k}", [across[k], right[k], -across[k + 1], left[k]])
        sketch.body("head", [across[2], *head])
        tube = sketch.rectangle(r + gap, 0, out, length, h)
        sketch.body("sleeve", tube)
        sketch.names[:2] = ['Physical Surface("shank") = {1, 2};']
        sketch.used -= {across[2]}
        groups = {"foot": [across[0], tube[0]], "axis": [*left, head[3]], "cut": [across[1]]}
        return sketch.named(**groups, under=[head[0]], seat=[tube[2]], top=[head[2]])

    longer, load = heat * F * (1 / bolt + 1 / sleeve), pull * F
    closed = F + (longer + load / sleeve) / (1 / bolt + 1 / sleeve)
    case = f"state stress\n{body('shank', E1, 0)}{body('head', 1e6 * E1, 0)}{body('sleeve', E2, 0)}contact seat under\n"
    case += f"symmetry foot\nsymmetry axis\npreload cut {F:.9g}\nexpand sleeve 1e-5 {1e5 * longer / length:.9g}\n"
    found = {"preloads.0.tension": (max(closed, load), 1e-3 * closed)}
    return Part(name, geo, f"{case}traction top 0 {load / out:.9g}\n", found, fine=0)


def rubbing(make: Callable[[str, Random], Part]) -> Callable[[str, Random], Part]:
    """The same with friction, and dragged where a motion or a force pushes."""

    def made(name: str, random: Random) -> Part:
        part, mu, drag = make(name, random), random.uniform(0.05, 0.6), random.uniform(-0.5, 0.5)
        case = re.sub(r"^((?:contact|obstacle) .*)$", rf"\1 friction {mu:.3g}", part.case, flags=re.M)
        aside = r"\b((?:move|force)(?: grip)?) 0 (-\S+)"
        return replace(part, case=re.sub(aside, lambda x: f"{x[1]} {drag * float(x[2]):.9g} {x[2]}", case))

    return made


# ---------------------------------------------------------------- rotations


def turned_oval(name: str, random: Random) -> Part:
    """A disc or an ellipse on a shaft that turns under a flat follower; a disc turned is a disc not turned."""
    b, round_one = random.uniform(3, 8), name.startswith("disc")
    a = b if round_one else b * random.uniform(1.1, 1.5)
    shaft, angle = 0.4 * b, random.choice([-1, 1]) * 10 ** random.uniform(-2.5, -1)
    E, nu = moduli(random)
    dent, sides = b * random.uniform(5e-4, 3e-3), int(random.integers(20, 60))
    top = b if round_one else np.hypot(a * np.sin(angle), b * np.cos(angle))

    def geo(sketch: Sketch) -> str:
        sketch.turn(angle * sketch.draw.turned)
        ends = [
            sketch.point(a * np.cos(t), b * np.sin(t), b / 100 if k == 1 else b / 8)
            for k, t in enumerate(np.arange(4) * np.pi / 2)
        ]
        centre = sketch.point(0, 0, b / 8)
        kind, middle = ("Circle", [centre]) if round_one else ("Ellipse", [centre, ends[0]])
        rim = [sketch.curve(kind, ends[k], *middle, ends[(k + 1) % 4]) for k in range(4)]
        bore = sketch.oval(0, 0, shaft, shaft, b / 8, sides // 2)
        sketch.body("cam", rim, bore)
        return sketch.named(rim=rim[:2], shaft=bore)

    case = f"{body('cam', E, nu)}obstacle rim plane 0 {top - dent:.16g} 0 -1{law(random, E, b)}\n"
    return Part(name, geo, f"{case}rotate shaft 0 0 {angle:.9g}\n", {}, ("rotation", "shape"), f"{case}clamp shaft\n")


def lobes(name: str, random: Random) -> Part:
    """A lobed cam, a spline through few points, turned under a rigid roller."""
    r, waves, count = random.uniform(4, 8), int(random.integers(2, 5)), 24
    height, angle = random.uniform(0.03, 0.1), random.choice([-1, 1]) * 10 ** random.uniform(-2.5, -1.2)
    E, nu = moduli(random)
    roller, dent = r * random.uniform(0.4, 1.5), r * random.uniform(5e-4, 3e-3)
    t = np.arange(count) * 2 * np.pi / count + np.pi / 2

    def radius(angles):
        return r * (1 + height * np.cos(waves * (angles - np.pi / 2)))

    far = np.linspace(0, 2 * np.pi, 20001)
    x, y = radius(far) * np.cos(far + angle), radius(far) * np.sin(far + angle)
    near = np.abs(x) < 0.98 * roller
    top = float(np.max((y[near] + np.sqrt(roller**2 - x[near] ** 2))[y[near] > 0]))

    def geo(sketch: Sketch) -> str:
        sketch.turn(angle * sketch.draw.turned)
        points = [
            sketch.point(radius(s) * np.cos(s), radius(s) * np.sin(s), r / 200 if k == 0 else r / 8)
            for k, s in enumerate(t)
        ]
        ends = [*points, points[0]]
        rim = [sketch.curve("Spline", *ends[6 * k : 6 * k + 7]) for k in range(4)]
        bore = sketch.oval(0, 0, 0.4 * r, 0.4 * r, r / 8, 16)
        sketch.body("cam", rim, bore)
        return sketch.named(rim=[rim[0], rim[3]], shaft=bore)

    case = f"{body('cam', E, nu)}obstacle rim circle 0 {top - dent:.16g} R {roller:.16g}{law(random, E, r)}\n"
    return Part(name, geo, f"{case}rotate shaft 0 0 {angle:.9g}\n", {}, ("rotation", "shape"), f"{case}clamp shaft\n")


# ---------------------------------------------------------------- shapes, gaps, masters


def bracket(name: str, random: Random) -> Part:
    """A foot with fillets at its root, pressed by a rigid roller."""
    length, thick, wall = random.uniform(15, 30), random.uniform(2, 5), random.uniform(3, 6)
    radius, sides = random.uniform(1, 4), int(random.integers(1, 6))
    E, nu = moduli(random)
    roller, place = random.uniform(2, 8), length * random.uniform(0.7, 0.9)
    pushed = random.random() < 0.5
    load = f"move 0 {-random.uniform(0.02, 0.1) * thick:.9g}" if pushed else f"force 0 {-1e-4 * E * thick:.9g}"

    def geo(sketch: Sketch) -> str:
        coarse, near, y = thick / 3, thick / 150, thick
        corners = [(0, 0, coarse), (length, 0, coarse), (length, y, coarse), (place, y, near)]
        corners += [(wall, y, coarse, radius, sides), (wall, y + 12, coarse), (0, y + 12, coarse)]
        straight, arcs = sketch.outline(corners)
        sketch.body("bracket", [*straight, *arcs])
        return sketch.named(foot=[straight[2], straight[3]], wall=[straight[5]])

    case = f"state {random.choice(['strain', 'stress'])}\n{body('bracket', E, nu)}clamp wall\n"
    case += f"obstacle foot circle {place:.16g} {thick + roller:.16g} R {roller:.16g} {load}\n"
    return Part(name, geo, case, {}, ("shape", "gap"))


def hook(name: str, random: Random) -> Part:
    """A snap-in hook whose ramp is lifted by a rigid, round catch: it bends, turns and slides."""
    length, thick, deep = random.uniform(10, 18), random.uniform(1.2, 2.5), random.uniform(0.8, 1.5)
    E, nu = moduli(random)
    round_off, sides = random.uniform(0.2, 0.5), int(random.integers(2, 8))
    slope = random.uniform(0.35, 0.7)
    nose, ramp = 0.8, random.uniform(3, 4.5)
    catch = random.uniform(0.4, 1.5)
    x0, y0 = length + nose, -deep
    along, normal = np.array([np.cos(slope), np.sin(slope)]), np.array([np.sin(slope), -np.cos(slope)])
    touch = np.array([x0, y0]) + 0.5 * ramp * along
    centre = touch + catch * normal
    lift = thick * random.uniform(0.02, 0.15)

    def geo(sketch: Sketch) -> str:
        far = np.array([x0, y0]) + ramp * along
        coarse = thick / 4
        corners = [(0, 0, coarse), (length, 0, coarse / 2, round_off, sides), (length, -deep, coarse)]
        corners += [(x0, y0, coarse / 2, round_off, sides), (*touch, thick / 150), (*far, coarse)]
        corners += [(far[0], thick, coarse), (0, thick, coarse)]
        straight, arcs = sketch.outline(corners)
        sketch.body("hook", [*straight, *arcs])
        return sketch.named(ramp=[straight[3], straight[4]], root=[straight[7]])

    case = f"state stress\n{body('hook', E, nu)}clamp root\nobstacle ramp circle {centre[0]:.16g} {centre[1]:.16g} "
    case += f"R {catch:.16g} move {-lift * random.uniform(0, 0.5):.9g} {lift:.9g}\n"
    return Part(name, geo, case, {}, ("gap", "shape"))


def hole(name: str, random: Random) -> Part:
    """A pin, with clearance, lies in the hole of a plate, each with its own number of sides."""
    r, sides = random.uniform(3, 8), random.integers(24, 60, 2)
    clearance = r * 10 ** random.uniform(-4, -1.5)
    (E1, nu1), (E2, nu2) = moduli(random), moduli(random)
    E2 = E1 * 10 ** random.uniform(-0.7, 0.7)
    load = 1e-2 * min(E1, E2) * clearance * random.uniform(1, 6) + 2e-4 * min(E1, E2) * r
    density = load / (np.pi * r**2)
    width = r * random.uniform(2, 4)

    def geo(sketch: Sketch) -> str:
        straight = sketch.rectangle(-width, -width, width, width, width / 4)
        bore = sketch.oval(0, 0, r, r, 1, int(sides[0]))
        pin = sketch.oval(0, -clearance, r - clearance, r - clearance, 1, int(sides[1]))
        sketch.body("plate", straight, bore)
        sketch.body("pin", pin)
        return sketch.named(base=[straight[0]], bore=bore, pin_skin=pin)

    pair = "bore pin-skin" if E1 < E2 else "pin-skin bore"
    case = f"{body('plate', E1, nu1)}{body('pin', E2, nu2)}clamp base\ncontact {pair}{law(random, min(E1, E2), r)}\n"
    return Part(name, geo, f"{case}weight pin 0 {-density:.9g}\n", {}, ("gap", "shape"))


def two_bodies(name: str, random: Random) -> Part:
    """A round, elliptic or wavy head on a block; either may be the slave, either the finer one."""
    wide, deep = random.uniform(5, 8), random.uniform(3, 6)
    a, b = random.uniform(3, 6), random.uniform(2, 6)
    (E1, nu1), (E2, nu2) = moduli(random), moduli(random)
    E2 = E1 * 10 ** random.uniform(-1, 1)
    near, ratio = 0.06, 10 ** random.uniform(-1.0, 1.0)
    wavy = name.startswith("wavy")
    heights = random.uniform(0, 0.15, 9) * (np.abs(np.arange(9) - 4) > 0)

    def geo(sketch: Sketch) -> str:
        sizes = near * max(1, 1 / ratio), near * max(1, ratio)
        low = [sketch.point(x, -deep, wide / 6) for x in (-wide, wide)]
        places = [(wide * (4 - k) / 4, -heights[k]) for k in range(9)] if wavy else [(wide, 0), (0, 0), (-wide, 0)]
        knots = [sketch.point(x, y, max(sizes[0], (0.3 if wavy else 0.5) * (x != 0))) for x, y in places]
        loops = [knots] if wavy else [knots[:2], knots[1:]]
        floor = [sketch.curve("Spline" if wavy else "Line", *loop) for loop in loops]
        rest = [sketch.curve("Line", *pair) for pair in (low, (low[1], knots[0]), (knots[-1], low[0]))]
        sketch.body("block", [rest[0], rest[1], *floor, rest[2]])
        tip, centre = sketch.point(0, 0, sizes[1]), sketch.point(0, b, 1)
        ends = [sketch.point(side * a, b, max(a / 5, sizes[1])) for side in (1, -1)]
        kind, extra = ("Circle", []) if a == b else ("Ellipse", [ends[0] if a > b else tip])
        nose = [sketch.curve(kind, tip, centre, *extra, ends[0]), sketch.curve(kind, ends[1], centre, *extra, tip)]
        head = sketch.curve("Line", ends[0], ends[1])
        sketch.body("head", [nose[0], head, nose[1]])
        return sketch.named(base=[rest[0]], floor=floor, nose=nose, grip=[head])

    pair = random.permutation(["floor", "nose"])
    load = 10 ** random.uniform(-3, -1.7)
    if name.startswith("coarse master"):  # and gaps small enough to be linear
        pair, ratio, load, E2 = ["nose", "floor"], 1 / random.uniform(4, 12), 0.01 * random.uniform(0.3, 1), E1
    grip = f"move grip 0 {-load * b:.9g}" if random.random() < 0.5 else f"force grip 0 {-load * min(E1, E2) * b:.9g}"
    case = f"{body('block', E1, nu1)}{body('head', E2, nu2)}clamp base\n"
    case += f"contact {pair[0]} {pair[1]}{law(random, min(E1, E2), b)}\n{grip}\n"
    return Part(name, geo, case, {}, ("gap", "master", "shape"))


def squeezed(name: str, random: Random) -> Part:
    """An ellipse, of random sides, between two rigid planes, or about an axis a ring between them."""
    about = name.startswith("o-ring")
    a, b = random.uniform(1, 4, 2)
    if about or random.random() < 0.3:
        a = b
    x, sides = random.uniform(3, 8) * a * about, few(random) + 60
    E, nu = moduli(random)
    move = b * 10 ** random.uniform(-2.5, -1)

    def geo(sketch: Sketch) -> str:
        rim = sketch.oval(x, 0, a, b, b / 5, sides)
        sketch.body("ring", rim)
        return sketch.named(skin=rim)

    soft = law(random, E, b)
    case = f"state {'axisymmetric' if about else random.choice(['strain', 'stress'])}\n{body('ring', E, nu)}"
    case += f"obstacle skin plane {x:.16g} {-b:.16g} 0 1{soft}\n"
    case += f"obstacle skin plane {x:.16g} {b:.16g} 0 -1 move 0 {-move:.9g}{soft}\n"
    return Part(name, geo, case, {}, ("gap", "shape"))


def polygon(name: str, random: Random) -> Part:
    """A true polygon, sharp or with rounded corners, pressed flat on an elastic block: its edges are singular."""
    corners, r = int(random.integers(5, 13)), random.uniform(2, 5)
    rounded = random.choice([0, 0.15]) * r
    (E1, nu1), (E2, nu2) = moduli(random), moduli(random)
    E2 = E1 * 10 ** random.uniform(-0.5, 1.5)
    inner = r * np.cos(np.pi / corners)
    load = 1e-3 * E1 * r * random.uniform(0.5, 3)
    t = -np.pi / 2 - np.pi / corners + 2 * np.pi * np.arange(corners) / corners

    def geo(sketch: Sketch) -> str:
        width = 3 * r
        block = sketch.rectangle(-width, -width, width, 0, r / 2)
        straight, arcs = sketch.outline(
            [(r * np.cos(s), inner + r * np.sin(s), r / 30 if k < 2 else r / 6, rounded, 3) for k, s in enumerate(t)]
        )
        sketch.body("block", block)
        sketch.body("nut", [*straight, *arcs])
        sketch.group("base", [block[0]])
        sketch.group("top", [block[2]])
        sketch.group("sole", [straight[0], *arcs[:2]])
        return sketch.text(
            "Field[1] = MathEval; Field[1].F = "
            f'"{sketch.draw.factor:.6g} * ({r / 30:.6g} + 0.25 * Sqrt(x*x/4 + y*y))"; Background Field = 1;'
            "Mesh.MeshSizeExtendFromBoundary = 0;"
        )

    known = {} if rounded else {"contacts.0.pressureMax": INFINITE}
    case = (
        f"{body('block', E1, nu1)}{body('nut', E2, nu2)}clamp base\ncontact top sole\nweight nut 0 {-load / r**2:.9g}\n"
    )
    return Part(name, geo, case, known, ("singular", "shape") if not rounded else ("shape", "gap"))


def hip(name: str, random: Random) -> Part:
    """About an axis: a ball in a cup with clearance, under a force."""
    r, wall = random.uniform(8, 15), random.uniform(4, 10)
    clearance, sides = r * 10 ** random.uniform(-3, -1.7), random.integers(24, 60, 2)
    E, nu = moduli(random)
    force = 2e-2 * E * r * r * random.uniform(0.3, 1.5) * clearance / r + 1e-3 * E * r * r

    def geo(sketch: Sketch) -> str:

        centre = [sketch.point(0, y, r / 5) for y in (0, clearance)]
        found = []
        for radius, c, count in (r, 0, sides[0]), (r + clearance, 1, sides[1]), (r + clearance + wall, 1, 0):
            size, y = np.pi * radius / 2 / count if count else wall / 3, clearance * c
            low, side = sketch.point(0, y - radius, size), sketch.point(radius, y, size)
            found.append((low, side, sketch.curve("Circle", low, centre[c], side, sides=int(count))))
        ball, cup, shell = found
        axis, top = sketch.curve("Line", centre[0], ball[0]), sketch.curve("Line", ball[1], centre[0])
        sketch.body("ball", [axis, ball[2], top])
        ends = [sketch.curve("Line", shell[0], cup[0]), sketch.curve("Line", cup[1], shell[1])]
        sketch.body("cup", [ends[0], cup[2], ends[1], -shell[2]])
        return sketch.named(skin=[ball[2]], grip=[top], bore=[cup[2]], shell=[shell[2]])

    case = f"state axisymmetric\n{body('ball', 100 * E, 0.3)}{body('cup', E, nu)}contact bore skin{law(random, E, r)}\n"
    return Part(name, geo, f"{case}clamp shell\nforce grip 0 {-force:.9g}\n", {}, ("gap", "shape"))


def seat(name: str, random: Random) -> Part:
    """About an axis: a ball on a rigid plane or in a rigid cone, under its weight."""
    r, slope = random.uniform(3, 10), random.choice([0, 1]) * random.uniform(0.3, 1.0)
    E, nu = moduli(random)
    density = E * 10 ** random.uniform(-4.5, -3) / r
    near = r / 120

    def geo(sketch: Sketch) -> str:
        centre = sketch.point(0, 0, r / 6)
        angles = [-np.pi / 2, -np.pi / 2 + (slope or 0.15), 0, np.pi / 2]
        sizes = [r / 6 if slope else near, near, r / 6, r / 6]
        at = zip(angles, sizes, strict=True)
        points = [sketch.point(r * np.cos(s) * (abs(s) < 1.57), r * np.sin(s), size) for s, size in at]
        arcs = [sketch.curve("Circle", points[k], centre, points[k + 1]) for k in range(3)]
        axis = [sketch.curve("Line", points[3], centre), sketch.curve("Line", centre, points[0])]
        sketch.body("ball", [*arcs, *axis])
        return sketch.named(skin=arcs[:2])

    case = f"state axisymmetric\n{body('ball', E, nu)}"
    case += f"obstacle skin plane {r * np.sin(slope):.16g} {-r * np.cos(slope):.16g} "
    case += f"{-np.sin(slope):.16g} {np.cos(slope):.16g}\nweight ball 0 {-density:.9g}\n"
    return Part(name, geo, case, {}, ("gap", "shape", "axis"))


def punch(name: str, random: Random) -> Part:
    """A sharp punch, plane or about an axis, on a block: its pressure is unbounded at its edge."""
    a, wide = random.uniform(2, 5), random.uniform(15, 25)
    (E1, nu1), (E2, nu2) = moduli(random), moduli(random)
    E2 = E1 * 10 ** random.uniform(0, 1.5)
    force = 1e-3 * E1 * a * random.uniform(0.3, 3)
    state = random.choice(["axisymmetric", "strain"])

    def geo(sketch: Sketch) -> str:
        block, _ = sketch.outline([(0, -wide, 3), (wide, -wide, 3), (wide, 0, 3), (a, 0, a / 60), (0, 0, a / 12)])
        tool, _ = sketch.outline([(0, 0, a / 12), (a, 0, a / 45), (a, 2 * a, a / 4), (0, 2 * a, a / 4)])
        sketch.body("block", block)
        sketch.body("tool", tool)
        groups = {"base": [block[0]], "top": [block[2], block[3]], "axis": [block[4]]}
        return sketch.named(**groups, end=[tool[0]], cap=[tool[2]], tool_axis=[tool[3]])

    mirror = "" if state == "axisymmetric" else "symmetry axis\nsymmetry tool-axis\n"
    case = f"state {state}\n{body('block', E1, nu1)}{body('tool', E2, nu2)}clamp base\n{mirror}contact top end\n"
    return Part(
        name, geo, f"{case}force cap 0 {-force:.9g}\n", {"contacts.0.pressureMax": INFINITE}, ("singular", "gap")
    )


# ---------------------------------------------------------------- space


def prism(name: str, random: Random) -> Part:
    """A round column, full or a tube, on a rigid plane, nu = 0: uniform pressure."""
    r, height, sides = random.uniform(1, 3), random.uniform(1, 4), few(random)
    hole, inner = random.choice([0, 0.5]) * r, few(random)
    E, _ = moduli(random)
    strain = 10 ** random.uniform(-3, -2)

    def geo(sketch: Sketch) -> str:
        rim = sketch.oval(0, 0, r, r, r / 2, sides)
        bore = sketch.oval(0, 0, hole, hole, r / 2, inner) if hole else []
        loops = [loop for loop in (rim, bore) if loop]
        sketch.body("flat", *loops)
        sketch.names.clear()
        return sketch.text(
            f"e[] = Extrude{{0, 0, {height:.16g}}} {{Surface{{1}}; Layers{{3}};}};\n"
            'Physical Volume("column") = {e[1]}; Physical Surface("sole") = {1}; Physical Surface("head") = {e[0]};'
        )

    p = E * strain
    case = f"{body('column', E, 0)}obstacle sole plane 0 0 0 0 0 1\nmove head 0 0 {-strain * height:.12g}\n"
    known = contact_knows({"force": p * np.pi * (r**2 - hole**2), "pressureMax": p})
    return Part(name, geo, case, known, ("shape",), space=True, fine=0)


def press_fit_in_space(name: str, random: Random) -> Part:
    """A quarter of a press fit between mirrors: Lame."""
    a, c, b = np.cumsum(random.uniform(0.5, 1.5, 3)) * 10
    (E, nu), ratio = moduli(random), random.uniform(0.5, 2)
    over, height = c * 1e-4 * random.uniform(1, 5), random.uniform(2, 5)
    joint, inside, outside = int(random.integers(8, 16)), max(2, few(random) // 4), max(2, few(random) // 4)

    def geo(sketch: Sketch) -> str:
        lines = [
            "Point(1) = {0, 0, 0}; Macro Sector\nq = newl; p = newp;",
            "Point(p) = {r1, 0, 0}; Point(p+1) = {r2, 0, 0}; Point(p+2) = {0, r2, 0}; Point(p+3) = {0, r1, 0};",
            "Line(q) = {p, p+1}; Circle(q+1) = {p+1, 1, p+2}; Line(q+2) = {p+2, p+3}; Circle(q+3) = {p+3, 1, p};",
            "Transfinite Curve {q+1} = n2 + 1; Transfinite Curve {q+3} = n1 + 1;",
            "Transfinite Curve {q, q+2} = 4; Curve Loop(q) = {q, q+1, q+2, q+3}; Plane Surface(q) = {q};",
            f"e[] = Extrude{{0, 0, {height:.16g}}} {{Surface{{q}}; Layers{{2}};}}; Return",
        ]
        for k, (word, r1, r2, n1, n2) in enumerate(
            (("inner", a, c + over, inside, joint), ("outer", c, b, round(1.2 * joint) + 1, outside))
        ):
            lines += [f"r1 = {r1:.16g}; r2 = {r2:.16g}; n1 = {n1}; n2 = {n2}; Call Sector;"]
            lines += [f'Physical Volume("{word}") = {{e[1]}};']
            for side, tag in (("bottom", "q"), ("top", "e[0]"), ("y", "e[2]"), ("x", "e[4]")):
                lines.append(f'Physical Surface("{side}{k}") = {{{tag}}};')
            lines.append(f'Physical Surface("{("shaft", "hub")[k]}") = {{e[{(3, 5)[k]}]}};')
        return "\n".join(lines + options(sketch.draw)) + "\n"

    e, n = 1 / (1 - nu**2), nu / (1 - nu)
    r = c + over
    p = over / c / ((((r**2 + a**2) / (r**2 - a**2) - n) + ((b**2 + c**2) / (b**2 - c**2) + n) / ratio) / (E * e))
    mirrors = "".join(f"symmetry {side}{k}\n" for k in (0, 1) for side in ("bottom", "top", "x", "y"))
    case = f"{body('inner', E, nu)}{body('outer', E * ratio, nu)}contact hub shaft\n{mirrors}"
    known = contact_knows({"normalForce": np.pi / 2 * c * height * p, "pressureMax": p}, 0.3 * over / c)
    return Part(name, geo, case, known, ("shape",), space=True, fine=0)


def ball_in_space(name: str, random: Random) -> Part:
    """An ellipsoid lies on a rigid plane or an elastic block: its weight."""
    axes = random.uniform(2, 5, 3)
    E, nu = moduli(random)
    density, size = 1.5e-3 * E / axes[2] * random.uniform(0.5, 2), random.uniform(0.8, 1.2)
    a, b, c = axes

    def geo(sketch: Sketch) -> str:
        lines = [
            'SetFactory("OpenCASCADE"); Sphere(1) = {0, 0, 0, 1};',
            f"Dilate {{{{0, 0, 0}}, {{{a:.16g}, {b:.16g}, {c:.16g}}}}} {{ Volume{{1}}; }}",
            f"Translate {{0, 0, {c:.16g}}} {{ Volume{{1}}; }}",
            'Physical Volume("ball") = {1}; skin() = Abs(Boundary{ Volume{1}; }); Physical Surface("skin") = skin();',
            "Field[1] = MathEval; "
            f'Field[1].F = "{size * sketch.draw.factor:.6g} * (0.08 + 0.35 * Sqrt(x*x + y*y + z*z))";',
            "Background Field = 1; Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeExtendFromBoundary = 0;",
        ]
        return "\n".join(lines + options(sketch.draw)) + "\n"

    case = f"{body('ball', E, nu)}obstacle skin plane 0 0 0 0 0 1\nweight ball 0 0 {-density:.9g}\n"
    weight = density * 4 / 3 * np.pi * a * b * c
    return Part(name, geo, case, contact_knows({"force": weight}), ("shape", "gap"), space=True, fine=0.5)


def wheel(name: str, random: Random) -> Part:
    """A quarter of two crossed cylinders, a wheel on its rail, under a force."""
    r1, r2 = random.uniform(8, 20, 2)
    (E, nu), ratio = moduli(random), random.uniform(0.5, 2)
    mean = np.sqrt(r1 * r2)
    radius = mean * random.uniform(0.05, 0.1)  # of the contact
    force = 4 * E / (1 - nu**2) / 2 * radius**3 / (3 * mean) / 4
    wide, deep = 3.5 * radius, 4 * radius

    def geo(sketch: Sketch) -> str:
        near = radius / 4 * sketch.draw.factor
        lines = ['SetFactory("OpenCASCADE");']
        for k, (r, axis, sign) in enumerate(((r1, "1, 0, 0", -1), (r2, "0, 1, 0", 1))):
            start = f"{-2 * wide if k == 0 else 0}, {-2 * wide if k == 1 else 0}, {sign * r:.16g}"
            z = -deep if k == 0 else 0
            direction = ", ".join(f"{float(v) * 4 * wide:.16g}" for v in axis.split(","))
            lines += [
                f"Cylinder({11 + k}) = {{{start}, {direction}, {r:.16g}}};",
                f"Box({21 + k}) = {{0, 0, {z:.16g}, {wide:.16g}, {wide:.16g}, {deep:.16g}}};",
                f"BooleanIntersection({1 + k}) = {{ Volume{{{11 + k}}}; Delete; }}{{ Volume{{{21 + k}}}; Delete; }};",
            ]

        def near_plane(axis: int, at: float) -> str:
            low, high = [-2 * wide] * 3, [2 * wide] * 3
            low[axis], high[axis] = at - 1e-3 * radius, at + 1e-3 * radius
            return "Surface In BoundingBox {" + ", ".join(f"{v:.9g}" for v in (*low, *high)) + "}"

        lines += [
            'Physical Volume("rail") = {1}; Physical Volume("wheel") = {2};',
            f"mx() = {near_plane(0, 0)}; my() = {near_plane(1, 0)};",
            f"base() = {near_plane(2, -deep)}; grip() = {near_plane(2, deep)};",
            f"ox() = {near_plane(0, wide)}; oy() = {near_plane(1, wide)};",
            "head() = Abs(Boundary{ Volume{1}; }); tread() = Abs(Boundary{ Volume{2}; });",
        ]
        others = "mx my base grip ox oy".split()
        lines += [f"{skin}() -= {other}();" for skin in ("head", "tread") for other in others]
        lines += [f'Physical Surface("{word}") = {word}();' for word in ("mx", "my", "base", "grip", "head", "tread")]
        lines += [
            f'Field[1] = MathEval; Field[1].F = "Max({near:.6g}, '
            f'{sketch.draw.factor:.6g} * 0.45 * (Sqrt(x*x + y*y + z*z) - {0.8 * radius:.6g}))";',
            "Background Field = 1; Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeExtendFromBoundary = 0;",
        ]
        return "\n".join(lines + options(sketch.draw)) + "\n"

    case = (
        f"{body('rail', E, nu)}{body('wheel', E * ratio, nu)}contact head tread\nsymmetry mx\nsymmetry my\nclamp base\n"
    )
    return Part(
        name, geo, f"{case}force grip 0 0 {-force:.9g}\n", {}, ("shape", "gap", "scatter"), space=True, fine=0.55
    )


FAMILIES: dict[str, tuple[Callable[[str, Random], Part], int]] = {
    **{"press fit": (press_fit, 5), "lined tube": (lined_tube, 3), "heavy": (heavy, 4), "groove": (groove, 2)},
    **{"plank": (plank, 2), "crack": (crack, 2), "disc turned": (turned_oval, 2), "cam turned": (turned_oval, 3)},
    **{"lobes turned": (lobes, 2), "bracket": (bracket, 3), "hook": (hook, 3), "hole": (hole, 3)},
    **{"head": (two_bodies, 4), "wavy": (two_bodies, 2), "coarse master": (two_bodies, 2), "squeezed": (squeezed, 2)},
    **{"o-ring": (squeezed, 2), "polygon": (polygon, 3), "hip": (hip, 2), "seat": (seat, 3), "punch": (punch, 2)},
    **{"prism": (prism, 4), "press fit in space": (press_fit_in_space, 2), "ball in space": (ball_in_space, 2)},
    **{"wheel": (wheel, 2), "shrink fit": (press_fit, 3), "twisted fit": (press_fit, 6), "shank": (shank, 3)},
    **{"rubbed head": (rubbing(two_bodies), 4), "rubbed bracket": (rubbing(bracket), 3)},
    "rubbed seat": (rubbing(seat), 2),
}


def parts(seed: int = 1) -> list[Part]:
    """All of them; each has its own random numbers, so that another family changes none of the others."""
    found = []
    for family, (make, count) in FAMILIES.items():
        for k in range(count):
            words = [seed, k, *family.encode()]
            found.append(make(f"{family} {k + 1}", np.random.default_rng(words)))
    return found
