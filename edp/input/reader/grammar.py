"""The statements of a case file, each in one place: what it takes, its bounds, where it is allowed, what it means.

A new statement is a class here: its parser, its refusals, its usage and its row of the pages' table come of it.
`modules.py` names the modules that it needs. In texts {a|b} is a in the plane, b in space; see fields.py for fields.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

from .fields import (
    STATEMENTS,
    GroupName,
    Number,
    OneOf,
    Part,
    Reading,
    Statement,
    Vector3,
    axisymmetric,
    body,
    boundary,
    choice,
    custom,
    in_plane,
    in_space,
    keyword,
    number,
    one_of,
    option,
    perhaps,
    read_fields,
    shown,
    usage_of,
    usage_of_fields,
    vector,
    word,
)
from .groups import Group, Where
from .laws import NAMES, Law, LawKind, is_file
from .rigid.shapes import SHAPES, Shape
from .words import Line, nearest, spells_number, whole_number

FILE_NAME = "[A-Za-z0-9_-]+"
PLAIN_NAME = (FILE_NAME, "a name; allowed: letters, digits, - and _")
STRAIN = "allowed: state strain or axisymmetric"
ALONG_AXIS = "allowed with state axisymmetric: along y"


def no_friction(where: Where) -> bool:
    return not where.friction


def no_wear(where: Where) -> bool:
    return not where.wear


def no_plastic(where: Where) -> bool:
    return not where.plastic


def off_axis(what: str, value: Vector3, where: Where) -> str:
    """Why a ring cannot have it, or nothing."""
    return f"{what} off the axis; {ALONG_AXIS}" if axisymmetric(where) and value[0] != 0 else ""


# The problem as a whole


class Units(Statement, word="units"):
    does = "of lengths and pressures"
    once = "units"
    note = ", as units mm MPa"
    length: str = word("LENGTH", "a unit of length")
    pressure: str = word("PRESSURE", "a unit of pressure")


class State(Statement, word="state", example="state axisymmetric"):
    does = "strain, stress or about an axis"
    once = "state"
    usage = "state strain, stress or axisymmetric"
    name: str = choice("a word", "STATE", "strain", "stress", "axisymmetric")
    refused = ((in_space, "state: only in the plane, with edp/parts.edp; allowed in space: nothing of the kind"),)


class Thickness(Statement, word="thickness", example="thickness 12"):
    does = "in the plane"
    once = "thickness"
    value: float = number("the thickness", "NUMBER", above=0, unit="length")
    refused = ((in_space, "thickness: only in the plane, with edp/parts.edp; allowed in space: nothing of the kind"),)


# Groups of a geometry, and sizes of its elements


@dataclass(frozen=True)
class Numbers:
    """At least one number of an entity of the geometry, up to the end of the line, or to a word."""

    what: str
    end: str = ""

    def read(self, reading: Reading) -> tuple[int, ...]:
        many = shown(self.what, reading.where)
        numbers = reading.line.left
        if self.end in numbers:
            numbers = numbers[: numbers.index(self.end)]
        if not numbers:
            reading.no(f"numbers are missing after {many}")
        for text in numbers:
            if not text.isascii() or whole_number(text) < 0:
                allowed = "those of the mesh" if self.end else "those that -check 1 draws"
                reading.line.no(f"{text}: not the number of one of the {many}; allowed: {allowed}")
        return tuple(int(reading.line.next()) for _ in numbers)

    def usage(self, where: Where) -> str:
        return "N ..."


class BoundaryNumbers(Part):
    numbers: tuple[int, ...] = custom(Numbers("{curves|faces}"))


class BodyNumbers(Part):
    numbers: tuple[int, ...] = custom(Numbers("{surfaces|volumes}"))


class Box(Part):
    corner: Vector3 = vector("the place")
    opposite: Vector3 = vector("the other corner")


class InPlane(Part):
    point: Vector3 = vector("the place")
    normal: Vector3 = vector("the normal", "nx ny{| nz}", nonzero=True)


class Near(Part):
    point: Vector3 = vector("the place")


class OnCylinder(Part):
    """A cylinder about an axis, in the plane a circle about a point."""

    point: Vector3 = vector("the place")
    axis: Vector3 = vector("the axis", "dx dy dz", only=in_space, nonzero=True)
    radius: float = number("the radius", "r", above=0, prefix="R", unit="length")


class ElementSides(Part):
    """Sides of elements of a mesh, as a deck numbers them."""

    elements: tuple[int, ...] = custom(Numbers("elements", end="side"))
    side: float = keyword("side", number("the number of the side", "S", above=0, below=7, whole=True))


class Between(Part):
    one: Group = body()
    other: Group = body()


SELECTIONS = {
    "{curves|faces}": BoundaryNumbers,
    "{surfaces|volumes}": BodyNumbers,
    "box": Box,
    "plane": InPlane,
    "near": Near,
    "{circle|cylinder}": OnCylinder,
    "elements": ElementSides,
    "between": Between,
}


class PickedGroup(Statement, word="group", example="group bore near 12 0{| 0}"):
    does = "faces or bodies of a geometry"
    synonyms = "set nset elset surface face select"
    once = "group {s.name}"
    usage = (
        "group NAME {curves|faces} N ..., {surfaces|volumes} N ..., box x y{| z} x y{| z}, "
        "plane x y{| z} nx ny{| nz}, near x y{| z}, {circle x y|cylinder x y z dx dy dz} R r, elements N ... side S "
        "or between BODY BODY"
    )
    name: str = word("NAME")
    pick: BoundaryNumbers | BodyNumbers | Box | InPlane | Near | OnCylinder | ElementSides | Between = one_of(
        "what it is picked by", "SELECTION", SELECTIONS
    )

    def check(self, where: Where) -> str:
        twice = isinstance(self.pick, Between) and self.pick.one == self.pick.other and self.pick.one
        return f"{twice}: twice the same body; allowed: two bodies" if twice else ""


@dataclass(frozen=True)
class SizedGroup:
    """A body or a boundary, or the word contact, if no group has that name."""

    def read(self, reading: Reading) -> Group | None:
        name = reading.need("a name")
        dimension, groups = reading.where.dimension, reading.groups
        found = [Group(d, name) for d in (dimension, dimension - 1) if groups.has(d, name)]
        if found or name == "contact":
            return found[0] if found else None
        as_body = nearest(name, groups.listed(dimension))
        if wrong := groups.why_not(dimension - (not as_body), name, "size"):
            reading.line.no(wrong)
        return Group(dimension - 1, name)

    def usage(self, where: Where) -> str:
        return "NAME"


class Size(Statement, word="size", example="size contact 0.05"):
    does = "of the elements"
    synonyms = "mesh h elementsize refine"
    once = "size of {s.name}"
    usage = "size NAME number or size contact number"
    on: Group | None = custom(SizedGroup())
    value: float = number("the size", above=0, unit="length")

    @property
    def name(self) -> str:
        return self.on.name if self.on else "contact"


# Bodies and what touches them


class Body(Statement, word="body", example="body pin E 210e3 nu 0.3"):
    does = "Young's modulus and Poisson's ratio"
    synonyms = "material elastic steel"
    once = "body {s.on}"
    on: Group = body("NAME")
    E: float = keyword("E", number("Young's modulus", above=0, unit="pressure"))
    nu: float = keyword("nu", number("Poisson's ratio", above=-1, at_most=0.5))
    yield_stress: float = option("yield", number("the yield stress", above=0, unit="pressure"), default=0.0)
    density: float = option("density", number("the density", above=0, unit="mass/volume"), default=0.0)


class Friction(Part):
    coefficient: float = number("the coefficient of friction", "MU", at_least=0, below=1e6)
    compliance: float = option(
        "compliance", number("the compliance", "c", at_least=0, unit="length/pressure"), default=0.0
    )
    limit: float = option("limit", number("the limit", "t", above=0, unit="pressure"), default=0.0)
    refused = ((no_friction, "friction: read by parts.edp and parts-3d.edp alone; allowed here: contacts without it"),)


class Hardness(Part):
    value: float = number("the hardness", "H", above=0, unit="pressure")
    exponent: float = option("exponent", number("the exponent", "m", above=0, below=3), default=0.95)


class Gas(Part):
    conductivity: float = number("the conductivity in the gap", "k", above=0, unit="power/(length temperature)")
    layer: float = option("layer", number("the gap's rest in contact", "d", above=0, unit="length"), default=0.0)


class Conductance(Part):
    value: float = number("the conductance", "h0", above=0, unit="power/(area temperature)")
    hardness: Hardness | None = option("hardness", Hardness)
    gap: Gas | None = option("gap", Gas)

    def fault(self) -> str:
        """Why the gap cannot conduct so, or nothing."""
        if self.gap and bool(self.gap.layer) != bool(self.hardness):
            return (
                "with a hardness a gap has a layer: conductance h0 hardness H gap k layer d; "
                "without, its layer is k/h0: conductance h0 gap k"
            )
        return ""


def no_profile(path: str) -> str:
    return "" if is_file(path) else f"{path}: no such file; allowed: the worn.csv of a run"


class Wear(Part):
    coefficient: float = number("the wear coefficient", "K", above=0, unit="1/pressure")
    slide: float = option("slide", number("the sliding distance of a cycle", "S", above=0, unit="length"), default=0.0)
    profile: str = option("from", word("FILE", "the file of a worn profile", fault=no_profile), default="")
    refused = ((no_wear, "wear: read by parts.edp and parts-3d.edp alone; allowed here: contacts without it"),)

    def fault(self, law: Law | None, friction: Friction | None) -> str:
        """Why it cannot wear so, or nothing."""
        rubs = friction is not None and friction.coefficient > 0
        if law and law.name != "signorini":
            return f"wear: with the law {law.name}; allowed: hard contact, no law or signorini"
        if rubs and self.slide:
            return "wear: slide with friction, whose slip is computed; allowed: wear K"
        if rubs or self.slide:
            return ""
        return "wear: no sliding distance and no friction; allowed: wear K slide S, or friction MU and legs"


class Pair(Statement):
    """Two surfaces: those of a contact or a tie."""

    slave: Group = boundary("SLAVE")
    master: Group = boundary("MASTER")

    def key(self) -> object:
        return "contact", frozenset((self.slave, self.master))

    def check(self, where: Where) -> str:
        return f"{self.slave}: slave and master are the same; allowed: two groups" if self.slave == self.master else ""


@dataclass(frozen=True)
class Vertical:
    """The word vertical behind gap."""

    def read(self, reading: Reading) -> bool:
        if not reading.line.starts("vertical"):
            conducts = "a gap that conducts stands behind a conductance"
            reading.line.no(f"gap: {conducts}; allowed: conductance h0 gap k, or gap vertical")
        return bool(reading.line.next())

    def usage(self, where: Where) -> str:
        return "vertical"


class Contact(Pair, word="contact", example="contact bore pin friction 0.15"):
    does = "two surfaces that may touch"
    synonyms = "interface pair touch interference overlap"
    once = "contact of {s.slave} and {s.master}"
    stray = "not allowed here"
    note = f", with its parameters: {NAMES}"
    vertical: bool = option("gap", custom(Vertical()), default=False)
    interference: float = option("interference", number("the interference", above=0, unit="length"), default=0.0)
    conductance: Conductance | None = option("conductance", Conductance)
    law: Law | None = option("law", custom(LawKind()))
    wear: Wear | None = option("wear", Wear)
    friction: Friction | None = option("friction", Friction)

    def check(self, where: Where) -> str:
        if same := Pair.check(self, where):
            return same
        if self.vertical and self.conductance:
            return (
                f"{self.slave}: gap vertical with conductance: heat crosses the true area, this gap weighs the one "
                "seen along the vertical; allowed: conductance without gap vertical"
            )
        if self.vertical and self.wear:
            return (
                f"{self.slave}: gap vertical with wear: depth and pressure of wear are those along the normal; "
                "allowed: wear without gap vertical"
            )
        return self.wear.fault(self.law, self.friction) if self.wear else ""


class Moved(Part):
    by: Vector3 = vector("the obstacle's move", counted="move")


class Pushed(Part):
    by: Vector3 = vector("the obstacle's force", counted="force", nonzero=True)


def shape_names(where: Where) -> str:
    return f"allowed: {OneOf('', '', SHAPES).all(where)}, as {shown(Obstacle.example, where)}"


class Obstacle(Statement, word="obstacle", in_legs=True):
    does = "a rigid shape that may touch"
    synonyms = "rigid wall ground"
    example = "obstacle top {circle 0 12|sphere 0 0 12} R 10 move 0{| 0} -0.1"
    once = "this obstacle of {s.on}"
    stray = "not allowed here"
    note = f", SHAPE one of: {{{OneOf('', '', SHAPES).all(Where())}|{OneOf('', '', SHAPES).all(Where(space=True))}}}"
    on: Group = boundary("SLAVE")
    shape: Shape = one_of("a shape", "SHAPE [inside] [round r]", SHAPES, noun=" shape", allowed=shape_names)
    drive: Moved | Pushed | None = perhaps("move or force x y{| z}", {"move": Moved, "force": Pushed})
    interference: float = option("interference", number("the interference", above=0, unit="length"), default=0.0)
    law: Law | None = option("law", custom(LawKind()))
    wear: Wear | None = option("wear", Wear)
    friction: Friction | None = option("friction", Friction)

    def check(self, where: Where) -> str:
        kind = "force" if isinstance(self.drive, Pushed) else "move"
        return (
            (off_axis(f"obstacle: a {kind}", self.drive.by, where) if self.drive else "")
            or self.shape.fault(where)
            or (self.wear.fault(self.law, self.friction) if self.wear else "")
        )

    def key(self) -> object:
        return "obstacle", self.on, type(self.shape), *vars(self.shape).items()


class ObstacleMove(Statement):
    """obstacle SLAVE move x y [z]: in a later load phase, of the one obstacle of this slave."""

    word = "obstacle"
    on: Group = boundary("SLAVE")
    drive: Moved = keyword("move", Moved)


class Tie(Pair, word="tie", example="tie pad disc"):
    does = "two surfaces glued: no gap, no slip"
    synonyms = "tied bond bonded glue glued mortar"
    once = "contact of {s.slave} and {s.master}"
    refused = (
        (no_friction, "tie: read by parts.edp and parts-3d.edp alone; allowed here: bodies that share nodes"),
        (lambda where: " " in where.friction, "tie: not with FRICTION; allowed: -distance linear, -points segment"),
    )


class Join(Statement, word="join", example="join bolt plate contact", rest=True):
    """A tie or a contact becomes that statement, between the groups A-B and B-A: the faces of each on the other."""

    does = "two bodies that touch: one part, a tie or a contact"
    synonyms = "coincident fragment touching"
    once = "join of {s.one} and {s.other}"
    usage = "join BODY BODY part, tie or contact, a contact with what may stand behind its groups"

    one: Group = body()
    other: Group = body()
    how: str = choice("how they are joined", "HOW", "part", "tie", "contact")

    def key(self) -> object:
        return "join", frozenset((self.one, self.other))

    def check(self, where: Where) -> str:
        return f"{self.one}: twice the same body; allowed: two bodies" if self.one == self.other else ""

    def line_of(self, rest: Line) -> Line:
        """The line of the statement that it makes."""
        return Line(
            self.line,
            [self.how, f"{self.one.name}-{self.other.name}", f"{self.other.name}-{self.one.name}", *rest.left],
        )


# Supports


@dataclass(frozen=True)
class Axes:
    """Axes in any order, each once, or none."""

    def read(self, reading: Reading) -> str:
        axes, found = "xyz"[: reading.where.dimension], ""
        while reading.line.starts(*axes):
            axis = reading.line.next()
            if axis in found:
                reading.line.no(f"{axis}: stated before in this line; allowed: once")
            found += axis
        return only_some(found, reading.where)

    def usage(self, where: Where) -> str:
        return shown("[x] [y]{| [z]}", where)


def only_some(axes: str, where: Where) -> str:
    """The axes along which a support holds, in their order; nothing if they are all there are."""
    return "" if len(axes) == where.dimension else "".join(sorted(axes))


class Clamp(Statement, word="clamp", example="clamp base", holds=True):
    """With axes, only the displacement along these is 0."""

    does = "no displacement, or none along axes"
    synonyms = "fix fixed fixity encastre support anchor hold bc boundary roller slider"
    on: Group = boundary()
    only: str = custom(Axes())

    def axes(self) -> set[str]:
        return set(self.only or "xyz")


class Symmetry(Statement, word="symmetry", example="symmetry left", holds=True):
    does = "no displacement across a flat group, whose mirror image belongs to the model"
    synonyms = "mirror"
    on: Group = boundary()


@dataclass(frozen=True)
class Numbered:
    """Reads no word: the axes along which the vector before it has numbers."""

    def read(self, reading: Reading) -> str:
        axes = "xyz"[: reading.where.dimension]
        words = reading.line.words[reading.line.read - len(axes) : reading.line.read]
        found = "".join(axis for axis, word in zip(axes, words, strict=True) if word != "*")
        if not found:
            reading.no("every component is free")
        return only_some(found, reading.where)

    def usage(self, where: Where) -> str:
        return ""


class Move(Statement, word="move", example="move grip 0{| 0} -0.05", holds=True, in_legs=True):
    """A component that is * is left free."""

    once = "{s.word} of {s.on}{s.along}"
    does = "a displacement that is given"
    synonyms = "displacement disp displace"
    note = ", or * for a component that is left free"
    on: Group = boundary()
    by: Vector3 = vector("the move", counted="move", free="*")
    only: str = custom(Numbered())

    def axes(self) -> set[str]:
        return set(self.only or "xyz")

    @property
    def along(self) -> str:
        return f" along {' '.join(self.only)}" if self.only else ""


class Rotate(Statement, word="rotate", example="rotate core 0 0{| 0 0 0 1} 0.01", holds=True, in_legs=True):
    does = "a small rotation"
    synonyms = "turn rotation"
    usage = "rotate NAME, centre x y{, | z, axis x y z, }angle in radians"
    on: Group = boundary()
    centre: Vector3 = vector("the centre")
    axis: Vector3 = vector("the axis", only=in_space, nonzero=True)
    angle: float = number("the angle", above=-1e6, below=1e6)
    refused = (
        (axisymmetric, "rotate: a ring cannot turn; allowed with state axisymmetric: clamp, symmetry, move, force"),
    )


# Loads


class Free(Part):
    """Nodal loads on a group that stays elastic."""

    at: Vector3 | None = option("at", vector("the point of at"))


class Rigid(Part):
    """The group is held rigid, and moves as the load says."""

    at: Vector3 | None = option("at", vector("the point of at"))


class Force(Statement, word="force", example="force grip 0{| 0} -2500 free", in_legs=True):
    """Without a word it is guided: the group stays as it is, and moves along the force alone."""

    does = "a resultant on a group"
    synonyms = "load cload"
    usage = "force NAME x y{| z} [free or rigid [at x y{| z}]]"
    hints = (("at", "free or rigid must stand before it"),)

    on: Group = boundary()
    resultant: Vector3 = vector("the force", counted="force")
    how: Free | Rigid | None = perhaps("free or rigid", {"free": Free, "rigid": Rigid})

    def check(self, where: Where) -> str:
        zero = not any(self.resultant)
        if zero and (self.how is None or not (where.phase or where.cases)):
            return f"the force is 0 in every direction; {usage_of('force', where)}"
        if axisymmetric(where) and isinstance(self.how, Rigid):
            along = "a ring moves along its axis alone, as the force without the word lets it"
            return f"rigid: {along}; allowed: no word, or free"
        if axisymmetric(where) and self.how and self.how.at:
            return "at: a ring has its force on the axis; allowed with state axisymmetric: no point"
        if zero and isinstance(self.how, Rigid):
            return f"force {self.on}: 0 of a rigid group; allowed: another number"
        return off_axis(f"{self.on}: a force", self.resultant, where)

    def key(self) -> object:
        return type(self.how), "force", self.on

    def holds(self) -> bool:
        return not isinstance(self.how, Free)

    def load(self) -> str:
        return "" if self.holds() else "free force"


class Spread(Part):
    """A moment as nodal loads on a group that stays elastic."""


class Stiff(Part):
    """A moment on a rigid group."""


class About(Part):
    """A moment on a rigid group that only turns about a point; the point stands behind the word."""

    point: Vector3 = vector("the point of about")


class Moment(Statement, word="moment", example="moment core 21600{| axis 0 0 1}", in_legs=True):
    does = "on a group, by what it carries or as a rigid one"
    synonyms = "torque couple"
    usage = "moment NAME m{| axis x y z} [rigid or about x y{| z}]"
    on: Group = boundary()
    size: float = number("the moment", "m", unit="force length")
    axis: Vector3 | None = option("axis", vector("the axis", nonzero=True), needed=in_space, absent=in_plane)
    how: Spread | Stiff | About = perhaps(
        "rigid or about x y{| z}", {"free": Spread, "rigid": Stiff, "about": About}, Spread
    )
    refused = (
        (axisymmetric, "moment: a ring does not turn; allowed with state axisymmetric: none, in space a moment"),
    )

    def check(self, where: Where) -> str:
        if self.size == 0 and (not (where.phase or where.cases) or not isinstance(self.how, Spread)):
            return f"moment {self.on}: 0{' of a rigid group' if where.phase else ''}; allowed: another number"
        return ""

    @property
    def couple(self) -> Vector3:
        """The moment as a vector; in the plane across it."""
        axis = self.axis or (0.0, 0.0, 1.0)
        length = sqrt(sum(c * c for c in axis))
        return axis[0] * (self.size / length), axis[1] * (self.size / length), axis[2] * (self.size / length)

    def key(self) -> object:
        return isinstance(self.how, Spread), "moment", self.on

    def holds(self) -> bool:
        return not isinstance(self.how, Spread)

    def load(self) -> str:
        return "" if self.holds() else "free moment"


class Spring(Statement, word="spring", example="spring base 1e4 1e4{| 1e4}"):
    """Of all of the group, along each axis."""

    does = "between a group and the ground"
    synonyms = "foundation elastic_support bushing"
    loads = "spring"

    on: Group = boundary()
    x: float = number("the stiffness", "kx", at_least=0, unit="force/length")
    y: float = number("the stiffness", "ky", at_least=0, unit="force/length")
    z: float = number("the stiffness", "kz", at_least=0, unit="force/length", only=in_space)

    def check(self, where: Where) -> str:
        return "" if self.x or self.y or self.z else f"spring {self.on}: no stiffness; allowed: one above 0"


class Pressure(Statement, word="pressure", example="pressure top 12", in_legs=True):
    does = "along the normal, on a boundary"
    loads = "pressure"
    on: Group = boundary()
    value: float = number("the pressure", unit="pressure")


class Traction(Statement, word="traction", example="traction top 0{| 0} -5", in_legs=True):
    does = "a force per area, on a boundary"
    loads = "traction"
    on: Group = boundary()
    value: Vector3 = vector("the traction", counted="traction")


class Weight(Statement, word="weight", example="weight core 0{| 0} -77e-6", in_legs=True):
    does = "a force per volume on a body: density times gravity"
    synonyms = "dload"
    on: Group = body("NAME")
    value: Vector3 = vector("the weight", counted="weight")

    def check(self, where: Where) -> str:
        return off_axis(f"{self.on}: a weight", self.value, where)


class Spin(Statement, word="spin"):
    """About the axis with state axisymmetric, otherwise about the origin or a point."""

    does = "a body's centrifugal force"
    synonyms = "centrifugal centrif omega rpm rotation_speed"
    example = "spin rotor 1500{| about 0 0 0 axis 0 0 1}"
    usage = "spin BODY omega {[about x y]|about x y z axis x y z}"

    on: Group = body()
    speed: float = number("the angular velocity", "omega", unit="1/time")
    about: Vector3 = option("about", vector("the point"), default=(0.0, 0.0, 0.0), needed=in_space, absent=axisymmetric)
    axis: Vector3 | None = option("axis", vector("the axis", nonzero=True), needed=in_space, absent=in_plane)


class Gravity(Statement, word="gravity", example="gravity 0{| 0} -9810"):
    does = "an acceleration of all bodies with a density"
    synonyms = "acceleration density"
    once = "gravity"
    value: Vector3 = vector("the gravity", counted="the gravity")

    def check(self, where: Where) -> str:
        if not any(self.value) and not where.cases:
            return f"the gravity is 0 in every direction; {usage_of('gravity', where)}"
        return off_axis("gravity", self.value, where)


# What options read


class Expand(Statement, word="expand", example="expand ring 12e-6 -180"):
    does = "thermal strain"
    synonyms = "thermal shrink"
    once = "expand {s.on}"
    note = ", two numbers"
    on: Group = body("NAME")
    coefficient: float = number("the coefficient of expansion", "alpha", unit="1/temperature")
    warmer: float = number("the change of temperature", "dT", unit="temperature")


class Section(Part):
    """A plane by a point and its normal."""

    point: Vector3 = vector("the point of the plane")
    normal: Vector3 = vector("the normal", "nx ny{| nz}", nonzero=True)


class Cut(Statement, word="cut"):
    does = "a plane through a body, for a preload"
    synonyms = "slice section split"
    example = "cut waist bolt plane 0 0{| 0} 0 1{| 0}"
    once = "cut {s.on}"
    on: Group = boundary()
    body: Group = body()
    plane: Section = keyword("plane", Section)

    def check(self, where: Where) -> str:
        if not axisymmetric(where) or self.plane.normal[0] == 0:
            return ""
        flat = "a plane that is not across the axis cuts no ring flat"
        return f"cut {self.on}: {flat}; allowed with state axisymmetric: a normal 0 1"


class Rubbing(Part):
    """Where a bolt rubs when it is tightened."""

    diameter: float = number("the diameter", "D", above=0, unit="length")
    friction: float = number("the coefficient of friction", "MU", at_least=0, below=10)


class Torque(Part):
    """A tightening torque, the pitch of the thread, its pitch diameter, and the mean diameter of the bearing face."""

    torque: float = number("the torque", "T", above=0, unit="force length")
    pitch: float = keyword("pitch", number("the pitch", "P", above=0, unit="length"))
    thread: Rubbing = keyword("thread", Rubbing)
    head: Rubbing = keyword("head", Rubbing)

    def force(self) -> float:
        """The preload: the torque over its lever in a thread with flanks at 30 degrees (VDI 2230)."""
        lever = self.pitch / (2 * pi) + self.thread.friction * self.thread.diameter / sqrt(3)
        return self.torque / (lever + self.head.friction * self.head.diameter / 2)


@dataclass(frozen=True)
class Tension:
    """The preload of a bolt, or the torque that gives it."""

    def read(self, reading: Reading) -> float:
        if not reading.line.starts("torque"):
            return Number("the preload", "force", above=0, unit="force").read(reading)
        reading.line.next()
        return Torque(**read_fields(Torque, reading)).force()

    def usage(self, where: Where) -> str:
        return f"force, or torque {usage_of_fields(Torque, where)}"


class Preload(Statement, word="preload", example="preload cut 8000"):
    does = "a shank pulled together"
    synonyms = "bolt pretension tension torque"
    once = "preload {s.on}"
    on: Group = boundary()
    force: float = custom(Tension())


@dataclass(frozen=True)
class TableRows:
    """Equivalent plastic strains and yield stresses, two numbers each, both rising."""

    def read(self, reading: Reading) -> tuple[tuple[float, float], ...]:
        found: list[tuple[float, float]] = []
        while reading.line.left and spells_number(reading.line.left[0]):
            strain = Number("the plastic strain", above=found[-1][0] if found else 0).read(reading)
            low = found[-1][1] if found else None
            found.append((strain, Number("the yield stress", above=0, at_least=low, unit="pressure").read(reading)))
        if not found:
            reading.no("a table without rows")
        return tuple(found)

    def usage(self, where: Where) -> str:
        return "strain stress strain stress ..."


class Table(Part):
    rows: tuple[tuple[float, float], ...] = custom(TableRows())


@dataclass(frozen=True)
class Hardening:
    """A modulus, or a table; beyond its end the yield stress stays."""

    def read(self, reading: Reading) -> float | Part:
        if not reading.line.starts("table"):
            return Number("the hardening modulus", at_least=0, unit="pressure").read(reading)
        reading.line.next()
        return Table(**read_fields(Table, reading))

    def usage(self, where: Where) -> str:
        return f"hardening, or table {TableRows().usage(where)}"


@dataclass(frozen=True)
class Bolts:
    """At least one cut with a preload, up to the end of the line, or to the word to."""

    def read(self, reading: Reading) -> tuple[Group, ...]:
        name, found = GroupName(False), [GroupName(False).read(reading)]
        while reading.line.left and not reading.line.starts("to"):
            found.append(name.read(reading))
        return tuple(found)

    def usage(self, where: Where) -> str:
        return "NAME ..."


class Tighten(Statement, word="tighten", example="tighten cut1 cut2 to 0.5"):
    """One pass: each bolt in turn, to this fraction of its preload; the others keep their lengths."""

    does = "the order in which bolts are tightened"
    synonyms = "sequence tightening_sequence pass"
    once = ""
    bolts: tuple[Group, ...] = custom(Bolts())
    fraction: float = option("to", number("the fraction of the preload", "fraction", above=0, below=10), default=1.0)

    def groups(self) -> list[tuple[str, Group]]:
        return [("bolt", group) for group in self.bolts]


class Plastic(Statement, word="plastic", example="plastic core 350 2000"):
    does = "yield stress and hardening of a body"
    synonyms = "plasticity elastoplastic mises hardening"
    once = "plastic {s.on}"
    on: Group = body()
    yield_stress: float = number("the yield stress", "yield", above=0, unit="pressure")
    hardening: float | Part = custom(Hardening())
    kinematic: float = option(
        "kinematic", number("the kinematic hardening modulus", "C", at_least=0, unit="pressure"), default=0.0
    )
    refused = ((no_plastic, "plastic: read by parts.edp and parts-3d.edp alone; allowed here: elastic bodies"),)

    def check(self, where: Where) -> str:
        first = self.hardening.rows[0][1] if isinstance(self.hardening, Table) else self.yield_stress
        low = f"plastic: the table starts with {first:g}, below the yield stress {self.yield_stress:g}; allowed: rising"
        return low if first < self.yield_stress else ""


class Expansion(Part):
    coefficient: float = number("the coefficient of expansion", "alpha", unit="1/temperature")
    stress_free: float = option("from", number("the temperature without stress", "T", unit="temperature"), default=0.0)


class Capacity(Part):
    value: float = number("the heat capacity", "C", above=0, unit="power time/(volume temperature)")
    start: float | None = option("start", number("the temperature at the start", "T", unit="temperature"))


class Conduct(Statement, word="conduct"):
    does = "conductivity of a body"
    synonyms = "heat conductivity"
    hints = (
        ("start", "a temperature at the start stands behind a heat capacity, capacity C start T"),
        ("from", "a temperature without stress stands behind an expansion, expand alpha from T"),
    )
    example = "conduct ring 0.05 expand 12e-6 from 20"
    on: Group = body()
    conductivity: float = number("the conductivity", "k", above=0, unit="power/(length temperature)")
    capacity: Capacity | None = option("capacity", Capacity)
    expand: Expansion | None = option("expand", Expansion)


class Temperature(Statement, word="temperature", example="temperature base 20"):
    does = "of a group"
    synonyms = "temp"
    on: Group = boundary()
    value: float = number("the temperature", "T", unit="temperature")


class Flux(Statement, word="flux", example="flux top 0.3"):
    does = "of heat into a body"
    synonyms = "hflux heatflux"
    on: Group = boundary()
    value: float = number("the flux", "q", unit="power/area")


class Source(Statement, word="source", example="source pellet 0.3"):
    does = "heat made in a body"
    synonyms = "dflux heatsource bodyflux"
    on: Group = body()
    value: float = number("the source", "q", unit="power/volume")


class Film(Statement, word="film", example="film outside 25e-6 20"):
    does = "heat exchanged with what is around"
    synonyms = "convection"
    on: Group = boundary()
    coefficient: float = number("the film coefficient", "h", above=0, unit="power/(area temperature)")
    around: float = number("the temperature around", "T", unit="temperature")


class Stresses(Statement, word="stresses"):
    """The stress tensor in the files of results."""

    does = "tensor, principal and von Mises"
    once = "stresses"


class LineOut(Statement, word="line", example="line middle 0 0{| 0} 0 20{| 0}"):
    does = "results along it"
    once = "line {s.name}"
    name: str = word("NAME", allowed=(FILE_NAME, "a name for files; allowed: letters, digits, - and _"))
    begin: Vector3 = vector("the line's beginning")
    end: Vector3 = vector("the line's end")

    def check(self, where: Where) -> str:
        return f"line {self.name}: begins where it ends; {usage_of('line', where)}" if self.begin == self.end else ""


class AboutPoint(Statement, word="about", example="about axle 0 0{| 0}"):
    does = "a point that moments are told about"
    once = "about"
    name: str = word("NAME", allowed=PLAIN_NAME)
    point: Vector3 = vector("the point")
    refused = ((axisymmetric, "about: a ring has no moments; allowed with state axisymmetric: none"),)


@dataclass(frozen=True)
class Terms:
    """Factors and load cases: 1.35 dead + 1.5 wind; without a factor it is 1."""

    def read(self, reading: Reading) -> tuple[tuple[float, str], ...]:
        terms: list[tuple[float, str]] = []
        while not terms or reading.line.left:
            if terms and reading.line.starts("+"):
                reading.line.next()
            starts = bool(reading.line.left) and spells_number(reading.line.left[0])
            factor = Number("the factor").read(reading) if starts else 1.0
            terms.append((factor, reading.need("a load case")))
        return tuple(terms)

    def usage(self, where: Where) -> str:
        return "FACTOR CASE + FACTOR CASE ..."


class LoadCase(Statement, word="load", example="load case wind"):
    does = "loads and motions of one load case follow"
    once = "load case {s.name}"
    synonyms = "case loadcase subcase"
    name: str = keyword("case", word("NAME", allowed=PLAIN_NAME))


class Combine(Statement, word="combine", example="combine storm 1.35 dead + 1.5 wind"):
    does = "the loads of several load cases times factors"
    once = "combine {s.name}"
    synonyms = "combination combo loadcomb"
    name: str = word("NAME", allowed=PLAIN_NAME)
    terms: tuple[tuple[float, str], ...] = custom(Terms())


class Cycles(Statement, word="cycles", example="cycles 1e5 steps 40"):
    does = "of wear, in so many steps"
    once = "cycles"
    count: float = number("the number of cycles", "NUMBER", above=0)
    steps: float = option(
        "steps", number("the number of wear steps", "NUMBER", above=0, below=10001, whole=True), default=20.0
    )


class Time(Statement, word="time", example="time 600 steps 40"):
    does = "heat from a start to an end, in so many steps"
    synonyms = "transient duration"
    once = "time"
    end: float = number("the end", "END", above=0, unit="time")
    steps: float = keyword("steps", number("the number of time steps", "N", above=0, below=100001, whole=True))
    scheme: str = option("scheme", choice("the scheme", "bdf2 or euler", "bdf2", "euler"), default="bdf2")


class Leg(Statement, word="leg", example="leg 8"):
    does, once = "loads and motions reached in steps", ""
    steps: float = number("the number of steps", "STEPS", above=0, below=100001, whole=True)
    refused = (
        (no_friction, "leg: read by parts.edp and parts-3d.edp alone; allowed here: one load, -history 1 in steps"),
    )


BEHIND = {
    "friction mu coulomb": "it stands behind a contact or an obstacle: contact SLAVE MASTER friction 0.3",
    "conductance hardness": "it stands behind a contact: contact SLAVE MASTER conductance 30",
    "wear archard": "it stands behind a contact or an obstacle: contact SLAVE MASTER wear 1e-8 slide 20",
    "weld": "join BODY BODY part makes two bodies of a geometry that touch one part; "
    "tie SLAVE MASTER glues two surfaces; bodies that share nodes are one part and need no statement "
    "(in gmsh: BooleanFragments, Coherence)",
}


def lead_to(text: str) -> str:
    """For a word that is no statement: the statement that does what it probably asks for, and what that does."""
    lower = text.lower().removesuffix("s")
    for words, advice in BEHIND.items():
        if lower in words.split():
            return f"{advice}; "
    known = [name for name, cls in STATEMENTS.items() if lower in cls.synonyms.split()]
    found = known[0] if known else nearest(text, STATEMENTS)
    return f"did you mean {found} ({STATEMENTS[found].does})? " if found else ""
