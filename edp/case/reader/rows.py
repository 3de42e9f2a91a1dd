"""A case as the rows of numbers that FreeFEM reads today, and as the lines of what is picked on a geometry.

Only as long as there are two readers: `rows` writes what case-file.awk prints, `picks` what it leaves for
meshes/pick.awk.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import sqrt

from . import grammar as g
from .case import Case
from .fields import Statement, Vector3
from .groups import Group
from .laws import Law

NUMBERS = 16
Row = tuple[str, Sequence[object], Sequence[float]]  # word, its six further words, its numbers


def exact(value: float) -> str:
    return f"{value:.17g}"


def brief(value: float) -> str:
    return str(int(value)) if value == int(value) and abs(value) < 2**31 else f"{value:.6g}"


def of_law(law: Law | None, interference: float) -> list[float]:
    return (
        [law.kappa, law.m, law.p0, law.beta, law.d0 - interference] if law else [0.0, 0.0, 0.0, 0.0, 0.0 - interference]
    )


def of_shape(shape: g.Shape) -> list[float]:
    return [*shape.place, *shape.direction, shape.radius, float(shape.inside)]


def shape_word(shape: g.Shape, space: bool) -> str:
    if isinstance(shape, g.Ball) and not isinstance(shape, g.Cylinder):
        return "sphere" if space else "circle"
    return "cylinder" if isinstance(shape, g.Cylinder) else "plane"


def point(at: Vector3 | None) -> list[float]:
    return [*at, 1.0] if at else []


def couple(s: g.Moment) -> list[float]:
    axis = s.axis or (0.0, 0.0, 1.0)
    length = sqrt(sum(c * c for c in axis))
    return [c * (s.size / length) for c in axis]


def behind(s: g.Contact | g.Obstacle) -> Iterable[Row]:
    """The statements of their own that options of a contact are."""
    if s.friction:
        yield (
            "friction",
            (0, 0, "none", "none", "none"),
            [s.friction.coefficient, s.friction.compliance, s.friction.limit],
        )
    if isinstance(s, g.Contact) and s.conductance:
        hard = s.conductance.hardness
        yield (
            "conductance",
            (0, 0, "none", "none", "none"),
            [s.conductance.value, *((hard.exponent, hard.value) if hard else ())],
        )
    if s.wear:
        slave = s.on if isinstance(s, g.Obstacle) else s.slave
        yield "wear", (slave, 0, "none", "none", "none"), [s.wear.coefficient, s.wear.slide]


def numbers(s: Statement) -> list[float]:
    """The numbers of a statement that is one row, in today's order."""
    match s:
        case g.Body():
            return [s.E, s.nu, s.yield_stress]
        case g.Move():
            return [*s.by]
        case g.Rotate():
            return [*s.centre, *s.axis, s.angle]
        case g.Force():
            return [*s.resultant, *point(s.how.at if s.how else None)]
        case g.Moment():
            return [*couple(s), *point(s.how.point if isinstance(s.how, g.About) else None)]
        case g.Spring():
            return [s.x, s.y, s.z]
        case g.Pressure() | g.Temperature() | g.Flux():
            return [s.value]
        case g.Traction() | g.Weight():
            return [*s.value]
        case g.Expand():
            return [s.coefficient, s.warmer]
        case g.Cut():
            return [*s.plane.point, *s.plane.normal]
        case g.Preload():
            return [s.force]
        case g.Plastic():
            return [s.yield_stress, s.hardening]
        case g.Conduct():
            return [s.conductivity, *((s.expand.coefficient, s.expand.stress_free) if s.expand else ())]
        case g.Film():
            return [s.coefficient, s.around]
        case g.LineOut():
            return [*s.begin, *s.end]
        case g.AboutPoint():
            return [*s.point]
        case g.Cycles():
            return [s.count, s.steps]
        case g.Leg():
            return [s.steps]
        case g.Obstacle():
            return [
                *of_law(s.law, s.interference if s.changes is None else 0.0),
                *of_shape(s.shape),
                *(s.drive.by if s.drive else ()),
            ]
        case g.ObstacleMove():
            assert isinstance(s.changes, g.Obstacle)
            return [0.0] * 5 + [*of_shape(s.changes.shape), *s.drive.by]
        case g.Contact():
            return of_law(s.law, s.interference)
        case _:
            return []


def words(s: Statement, space: bool) -> tuple[str, Sequence[object]]:
    """A row's first word, its groups, and its three further words."""
    groups = [group for _, group in s.groups()]
    sides = (groups[0] if groups else 0, groups[1] if len(groups) > 1 else 0)
    match s:
        case g.Obstacle():
            drive = "none" if s.drive is None else "move" if isinstance(s.drive, g.Moved) else "force"
            return "obstacle", (*sides, shape_word(s.shape, space), drive, s.law.name if s.law else "none")
        case g.Contact():
            return "contact", (*sides, "vertical" if s.vertical else "none", "none", s.law.name if s.law else "none")
        case g.Tie():
            return "contact", (*sides, "none", "none", "tied")
        case g.Force() if s.how:
            rigid = isinstance(s.how, g.Rigid)
            return (
                ("force", (*sides, "rigid", "force", "none"))
                if rigid
                else ("spread", (*sides, "none", "force", "none"))
            )
        case g.Moment():
            how = {g.Stiff: "rigid", g.About: "about"}.get(type(s.how))
            return ("force", (*sides, how, "moment", "none")) if how else ("spread", (*sides, "none", "moment", "none"))
        case g.LineOut() | g.AboutPoint():
            return s.word, (0, 0, s.name, "none", "none")
        case _:
            return s.word, (*sides, "none", "none", "none")


def body_loads(case: Case) -> Iterable[tuple[int, Row]]:
    """The loads of bodies by their densities, behind all statements."""
    bodies = {s.on: s.density for s in case.of(g.Body) if s.density}
    other = (0.0, 1.0, 0.0) if case.where.state == "axisymmetric" else (0.0, 0.0, 1.0)
    for spin in case.of(g.Spin):
        values = [spin.speed, *spin.about, *(spin.axis or other), bodies[spin.on]]
        yield spin.line, ("spin", (spin.on, 0, "none", "none", "none"), values)
    for s in case.of(g.Gravity):
        for group in case.used():
            if group in bodies:
                yield s.line, ("weight", (group, 0, "none", "none", "none"), [c * bodies[group] for c in s.value])


def rows(case: Case) -> str:
    """The table of case-file.awk."""
    label = {group: k + 1 for k, group in enumerate(case.used())}
    state = case.where.state
    table: list[str] = []
    files: list[str] = []
    place: dict[int, int] = {}  # by statement: its row

    def put(line: int, row: Row) -> None:
        word, more, values = row
        said = (label[item] if isinstance(item, Group) else item for item in more)
        padded = [*values, *[0.0] * (NUMBERS - len(values))]
        table.append(" ".join([word, str(line), *map(str, said), *map(exact, padded)]))

    aside = (g.Units, g.State, g.Thickness, g.PickedGroup, g.Size, g.Join, g.Spin, g.Gravity)
    for s in case.statements:
        if isinstance(s, aside):
            continue
        if s.changes is not None:
            put(s.line, ("to", (0, place[id(s.changes)], "none", "none", "none"), numbers(s)))
            continue
        place[id(s)] = len(table)
        word, more = words(s, case.where.space)
        put(s.line, (word, more, numbers(s)))
        if isinstance(s, g.Tie):
            put(s.line, ("tied", (0, 0, "none", "none", "none"), []))
        if isinstance(s, (g.Contact, g.Obstacle)):
            if s.law and s.law.file:
                files.append(f"{len(table) - 1} {s.law.file}")
            for row in behind(s):
                put(s.line, row)
            if s.wear and s.wear.profile:
                files.append(f"{len(table) - 1} {s.wear.profile}")
    for line, row in body_loads(case):
        put(line, row)
    head = [f"units {case.units}", f"state {state}", f"thickness {exact(case.thickness)}", f"groups {len(label)}"]
    groups = [f"{group.dimension} {group.name}" for group in label]
    return "\n".join([*head, *groups, f"statements {len(table)}", *table, f"files {len(files)}", *files]) + "\n"


def selection(pick: object, many: str) -> str:
    """What a group is picked by."""
    match pick:
        case g.BoundaryNumbers() | g.BodyNumbers():
            return " ".join([many, *map(str, pick.numbers)])
        case g.Box():
            return " ".join(["box", *map(exact, (*pick.corner, *pick.opposite))])
        case g.InPlane():
            return " ".join(["plane", *map(exact, (*pick.point, *pick.normal))])
        case g.Near():
            return " ".join(["near", *map(exact, pick.point)])
        case g.Between():
            return f"between\t{pick.one}\t{pick.other}"
    raise AssertionError(pick)


def picks(case: Case) -> list[str]:
    """The lines for meshes/pick.awk."""
    where, found = case.where, []
    dimension = where.dimension
    if case.groups.only_body:
        found.append(f"group\t0\t{dimension}\t{case.groups.only_body}\t{where.many(dimension)} {where.bodies}")
    for s in case.statements:
        match s:
            case g.PickedGroup():
                size = case.groups.picked[s.name]
                solid = isinstance(s.pick, g.BodyNumbers)
                text = selection(s.pick, where.many(dimension if solid else dimension - 1))
                found.append(f"group\t{s.line}\t{size}\t{s.name}\t{text}")
            case g.Size():
                found.append(f"size\t{s.line}\t{s.name}\t{exact(s.value)}")
            case g.Cut():
                plane = (*s.plane.point, *s.plane.normal)
                found.append("\t".join(["cut", str(s.line), s.on.name, s.body.name, *map(exact, plane)]))
            case g.Join():
                found.append(f"join\t{s.line}\t{s.one}\t{s.other}\t{s.how}")
                if s.how != "part":
                    for a, b in ((s.one, s.other), (s.other, s.one)):
                        found.append(f"group\t{s.line}\t{dimension - 1}\t{a}-{b}\tbetween\t{a}\t{b}")
            case g.Contact() | g.Tie():
                found.append(f"contact\t{s.line}\t{s.slave}\t{s.master}\t{s.word}")
            case g.Obstacle() if s.changes is None:
                shape = " ".join([shape_word(s.shape, where.space), *map(brief, of_shape(s.shape))])
                found.append(f"obstacle\t{s.line}\t{s.on}\t{shape}")
    return found
