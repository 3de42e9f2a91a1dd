"""The shapes of rigid obstacles, as a case states them; a shape with edges is a `Rounded`.

`fault` says what is wrong with a shape.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from ..fields import (
    Number,
    Part,
    Reading,
    Vector3,
    axisymmetric,
    custom,
    in_space,
    keyword,
    number,
    option,
    vector,
    word,
)
from ..groups import Where
from ..laws import is_file
from ..words import spells_number

Place2 = tuple[float, float]
MOST_CORNERS = 1000
KINDS = (".msh", ".stl")


class Shape(Part):
    """A rigid shape: a point of it, a direction or a radius where it has one, and whether the body is in it."""

    place: Vector3 = vector("the obstacle's place")
    direction: Vector3 = (0.0, 0.0, 0.0)
    radius: float = 0.0
    inside: bool = False

    def fault(self, where: Where) -> str:
        """What is wrong with it, or nothing."""
        return ""


class Plane(Shape):
    direction: Vector3 = vector("the obstacle's direction", "nx ny{| nz}", nonzero=True)


class Ball(Shape):
    """A circle, in space a sphere."""

    radius: float = number("the radius", "r", above=0, prefix="R", unit="length")
    inside: bool = option("inside", default=False)


class Cylinder(Ball):
    direction: Vector3 = vector("the obstacle's direction", "dx dy dz", nonzero=True)


class Rounded(Shape):
    """A shape with edges, which may be round."""

    rounding: float = option("round", number("the radius of its edges", "r", above=0, unit="length"), default=0.0)


@dataclass(frozen=True)
class Corners:
    """The corners of a polygon, two numbers each, up to the next word."""

    def read(self, reading: Reading) -> tuple[Vector3, ...]:
        found: list[Vector3] = []
        left = reading.line.left
        count = next((k for k, word in enumerate(left) if not spells_number(word)), len(left))
        if count % 2:
            reading.line.no(
                f"polygon: {count} numbers, of which the last has no partner; allowed: x and y of each corner"
            )
        while reading.line.left and spells_number(reading.line.left[0]):
            x = Number("a corner").read(reading)
            found.append((x, Number("the y of a corner").read(reading), 0.0))
        if len(found) < 3:
            reading.no(f"a polygon of {len(found)} corners; at least 3 are needed")
        if len(found) > MOST_CORNERS:
            reading.line.no(f"a polygon of {len(found)} corners; allowed: at most {MOST_CORNERS}, or surface FILE")
        return tuple(found)

    def usage(self, where: Where) -> str:
        return "x y x y x y ..."


def cross(a: Place2, b: Place2, c: Place2) -> float:
    """Twice the area of a triangle, positive if it turns to the left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def crossing(at: list[Place2]) -> str:
    """Which sides of a polygon meet besides at their common corners, or nothing."""
    n = len(at)
    size = max(abs(x) for place in at for x in place) + 1e-300
    for i, (a, b) in enumerate(zip(at, at[1:] + at[:1], strict=True)):
        if hypot(b[0] - a[0], b[1] - a[1]) <= 1e-9 * size:
            return f"corners {i + 1} and {(i + 1) % n + 1} are the same"
    for i in range(n):
        a, b = at[i], at[(i + 1) % n]
        back = at[(i + 2) % n]
        ahead = (b[0] - a[0]) * (back[0] - b[0]) + (b[1] - a[1]) * (back[1] - b[1])
        if ahead < 0 and abs(cross(a, b, back)) <= 1e-12 * size * size:
            return f"it goes back on itself at corner {(i + 1) % n + 1}"
        for j in range(i + 2, n - (i == 0)):
            c, d = at[j], at[(j + 1) % n]
            if max(c[0], d[0]) < min(a[0], b[0]) or min(c[0], d[0]) > max(a[0], b[0]):
                continue
            if cross(a, b, c) * cross(a, b, d) <= 0 and cross(c, d, a) * cross(c, d, b) <= 0:
                return f"the sides from corners {i + 1} and {j + 1} meet"
    return ""


class Polygon(Rounded):
    """In the plane: a closed polygon, its corners in either sense."""

    place: Vector3 = (0.0, 0.0, 0.0)
    corners: tuple[Vector3, ...] = custom(Corners())
    inside: bool = option("inside", default=False)

    def fault(self, where: Where) -> str:
        at = [(x, y) for x, y, _ in self.corners]
        if axisymmetric(where) and min(at)[0] < 0:
            return (
                f"polygon: a corner at x = {min(at)[0]:g}, a negative radius; allowed with state axisymmetric: x >= 0"
            )
        wrong = crossing(at)
        return f"polygon: {wrong}; allowed: a closed polygon that does not cross itself" if wrong else ""


class Box(Rounded):
    """A rectangle or cuboid along the axes."""

    opposite: Vector3 = vector("the other corner")
    inside: bool = option("inside", default=False)

    def fault(self, where: Where) -> str:
        flat = [a == b for a, b in zip(self.place, self.opposite, strict=True)]
        if any(flat[: where.dimension]):
            return "box: two corners on one side; allowed: opposite corners"
        if axisymmetric(where) and min(self.place[0], self.opposite[0]) < 0:
            return "box: a corner with a negative radius; allowed with state axisymmetric: x >= 0"
        return ""


class Axial(Rounded):
    """A shape about an axis through its place; `direction` points from it to the bodies."""

    direction: Vector3 = vector("the obstacle's direction", "nx ny{| nz}", nonzero=True)

    def fault(self, where: Where) -> str:
        name = type(self).__name__.lower()
        if axisymmetric(where) and (self.place[0] != 0 or self.direction[0] != 0):
            return f"{name}: off the axis; allowed with state axisymmetric: a place with x = 0, a direction along y"
        return ""


class Punch(Axial):
    """A flat end; its middle is the place, its half width or radius R."""

    radius: float = number("the half width", "a", above=0, prefix="R", unit="length")

    def fault(self, where: Where) -> str:
        if self.rounding >= self.radius:
            return f"punch: round {self.rounding:g}: as wide as the punch; allowed: below R {self.radius:g}"
        return super().fault(where)


class Cone(Axial):
    """A cone, in plane strain and stress a wedge; its tip is the place."""

    slope: float = keyword("degrees", number("the angle between axis and flank", "A", above=0, below=90))


def wrong_file(path: str) -> str:
    if not is_file(path):
        return f"{path}: no such file; allowed: a mesh of the surface (.stl, .msh)"
    if not path.lower().endswith(KINDS):
        return f"{path}: unknown kind of file; allowed: .stl in space, .msh"
    return ""


class Surface(Shape):
    """Triangles of a file, in the plane segments."""

    place: Vector3 = (0.0, 0.0, 0.0)
    file: str = word("FILE", "the file of the surface", fault=wrong_file)
    scale: float = option("scale", number("the scale", "s", above=0), default=1.0)
    at: Vector3 = option("at", vector("the place of the file's origin"), default=(0.0, 0.0, 0.0))
    inside: bool = option("inside", default=False)
    rounding = 0.0

    def fault(self, where: Where) -> str:
        if not in_space(where) and self.file.lower().endswith(".stl"):
            return (
                f"{self.file}: the triangles of an .stl file are for bodies in space (edp/parts-3d.edp); "
                "allowed in the plane: a .msh file with segments"
            )
        return ""


SHAPES = {
    "plane": Plane,
    "{circle|}": Ball,
    "{|sphere}": Ball,
    "{|cylinder}": Cylinder,
    "{polygon|}": Polygon,
    "box": Box,
    "punch": Punch,
    "cone": Cone,
    "surface": Surface,
}


def has_edges(shape: Shape) -> bool:
    return isinstance(shape, (Rounded, Surface))
