"""What a case picks of a geometry, as lines for meshes/pick.awk."""

from __future__ import annotations

from . import grammar as g
from .case import Case


def exact(value: float) -> str:
    return f"{value:.17g}"


def brief(value: float) -> str:
    return str(int(value)) if value == int(value) and abs(value) < 2**31 else f"{value:.6g}"


def of_shape(shape: g.Shape) -> list[float]:
    return [*shape.place, *shape.direction, shape.radius, float(shape.inside)]


def shape_word(shape: g.Shape, space: bool) -> str:
    if isinstance(shape, g.Ball) and not isinstance(shape, g.Cylinder):
        return "sphere" if space else "circle"
    return "cylinder" if isinstance(shape, g.Cylinder) else "plane"


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
