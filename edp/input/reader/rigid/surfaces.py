"""Outlines and triangles of rigid shapes with edges, as FreeFEM reads them (contact/rigid-surface/).

The normal of a side or triangle points to the free side, where the bodies are. A round shape is a sharp one moved back
by the radius, to which the distance is less by the radius. `surface_of` makes a surface; its `text` is what is read:

    kind (0 outline, 1 outline about an axis, 2 triangles), 1 if it is convex, radius of edges,
    a point and direction of the axis
    number of sides or triangles, a row each, then number of blocks of triangles (first, beyond, centre, radius)
    number of sharp edges, a row each: its ends
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from ..fields import axisymmetric
from ..groups import Where
from ..mesh import Floats, Ints
from ..words import Refusal
from .meshes import segments_of, triangles_of
from .shapes import Axial, Box, Cone, Polygon, Rounded, Shape, Surface
from .triangles import Facets

AT_ONCE = 2_000_000  # pairs of places and sides
ON_AXIS = 1e-9  # of a polygon's size: a corner so near to the axis is on it


def unit(v: Floats) -> Floats:
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


@dataclass
class Outline:
    """Sides in the plane: start, direction, length (infinite: 1e300), normal (sides x 2); beside: the sides before the
    start and behind the end, -1: none (sides x 2); corners: sharp ones (corners x 2)."""

    start: Floats
    way: Floats
    length: Floats
    normal: Floats
    beside: Ints
    corners: Floats

    def distance(self, places: Floats) -> Floats:
        """From the places (places x 2) to the nearest side, from outside or inside."""
        found = np.full(len(places), np.inf)
        rows = max(1, AT_ONCE // max(1, len(self.start)))
        for k in range(0, len(places), rows):
            off = places[k : k + rows, None] - self.start
            along = np.clip(np.einsum("psk,sk->ps", off, self.way), 0, self.length)
            found[k : k + rows] = np.linalg.norm(off - along[..., None] * self.way, axis=2).min(axis=1)
        return found

    def rows(self) -> list[str]:
        put = np.column_stack([self.start, self.way, self.length, self.normal])
        return [numbers(row) + f" {a} {b}" for row, (a, b) in zip(put, self.beside.tolist(), strict=True)]


@dataclass
class Made:
    """A surface: an outline, with an axis in space, or triangles; round: the radius of its edges."""

    outline: Outline | None = None
    facets: Facets | None = None
    round: float = 0.0
    axis: Floats = field(default_factory=lambda: np.zeros((2, 3)))
    about: bool = False  # the outline is one about the axis

    def distance(self, places: Floats) -> Floats:
        """From the places (places x 3), from outside or inside."""
        if self.facets:
            return np.abs(self.facets.distance(places) - self.round)
        assert self.outline
        at = places[:, :2]
        if self.about:
            off = places - self.axis[0]
            along = off @ self.axis[1]
            at = np.column_stack([np.linalg.norm(off - along[:, None] * self.axis[1], axis=1), along])
        return np.abs(self.outline.distance(at) - self.round)

    def edges(self) -> Floats:
        """The sharp edges (edges x 2 x 3); a corner in the plane has both ends there."""
        if self.facets:
            return self.facets.edges
        assert self.outline
        at = np.column_stack([self.outline.corners, np.zeros(len(self.outline.corners))])
        if not self.about:
            return np.stack([at, at], axis=1)
        across = unit(np.cross(self.axis[1], np.eye(3)[np.abs(self.axis[1]).argmin()]))
        turn = 2 * np.pi * np.arange(65) / 64
        ring = np.cos(turn)[:, None] * across + np.sin(turn)[:, None] * np.cross(self.axis[1], across)
        rims = [self.axis[0] + z * self.axis[1] + radius * ring for radius, z, _ in at if radius >= 0]
        return np.concatenate([np.stack([rim[:-1], rim[1:]], axis=1) for rim in rims] or [np.zeros((0, 2, 3))])

    def convex(self) -> bool:
        if self.facets:
            return self.facets.convex
        o = self.outline
        assert o
        last = o.beside[:, 1]
        turn = np.where(last < 0, 0, o.way[:, 0] * o.way[last, 1] - o.way[:, 1] * o.way[last, 0])
        whole = float(np.arccos(np.clip((o.way * o.way[last]).sum(1), -1, 1))[last >= 0].sum())
        return bool(
            (o.length > 1e299).any() or ((last >= 0).all() and turn.min() > -1e-12 and whole < 2 * np.pi + 1e-6)
        )

    def text(self) -> str:
        rows = self.facets.rows() if self.facets else self.outline.rows() if self.outline else []
        blocks = self.facets.blocks() if self.facets else []
        edges = [numbers(edge.ravel()) for edge in self.edges()]
        head = (
            f"{2 if self.facets else int(self.about)} {int(self.convex())} {numbers([self.round, *self.axis.ravel()])}"
        )
        return "\n".join([head, str(len(rows)), *rows, str(len(blocks)), *blocks, str(len(edges)), *edges])


def numbers(row: Floats | list[float]) -> str:
    return " ".join(f"{value:.17g}" for value in row)


def joined(loops: list[Floats]) -> Outline:
    """Closed loops of corners, the shape on their left."""
    found, first = [], 0
    for at in loops:
        n, ends = len(at), np.roll(at, -1, axis=0)
        way = unit(ends - at)
        order = np.arange(n)
        beside = first + np.column_stack([(order - 1) % n, (order + 1) % n])
        before = np.roll(way, 1, axis=0)
        sharp = before[:, 0] * way[:, 1] - before[:, 1] * way[:, 0] > 1e-6
        length = np.linalg.norm(ends - at, axis=1)
        found.append((at, way, length, right_of(way), beside, at[sharp]))
        first += n
    return Outline(*(np.concatenate(part) for part in zip(*found, strict=True)))


def right_of(way: Floats) -> Floats:
    return np.column_stack([way[:, 1], -way[:, 0]])


def moved_back(at: Floats, by: float, name: str) -> Floats:
    """The corners of a loop whose sides are moved against their normals."""
    way = unit(np.roll(at, -1, axis=0) - at)
    normal = right_of(way)
    before = np.roll(normal, 1, axis=0)
    moved = at - by * (before + normal) / (1 + (before * normal).sum(1, keepdims=True))
    left = ((np.roll(moved, -1, axis=0) - moved) * way).sum(1)
    whole = np.linalg.norm(np.roll(at, -1, axis=0) - at, axis=1)
    if left.min() <= 0:
        most = float((by * whole / (whole - left))[left <= 0].min())
        raise Refusal(f"{name}: round {by:g}: a side is too short for it; allowed: below {most:.4g}")
    return moved


def about_axis(at: Floats) -> list[Floats]:
    """The loops of a polygon in a half plane, with their mirror images where they end on the axis."""
    on = np.flatnonzero(at[:, 0] <= ON_AXIS * np.abs(at).max())
    if not len(on):
        return [at]
    at = np.roll(at, -on[0], axis=0)
    ends = [*np.flatnonzero(at[:, 0] <= ON_AXIS * np.abs(at).max()), len(at)]
    at = np.vstack([at, at[:1]])
    parts = [at[a : b + 1] for a, b in pairwise(ends) if b > a + 1]
    return [np.vstack([part, part[-2:0:-1] * [-1, 1]]) for part in parts]


def of_loops(loops: list[Floats], shape: Rounded | Surface, name: str) -> Made:
    loops = [at[::-1] if shape.inside else at for at in loops]
    if shape.rounding:
        loops = [moved_back(at, shape.rounding, name) for at in loops]
    return Made(joined(loops), round=shape.rounding)


def area(at: Floats) -> float:
    """Of a closed polygon, positive if the inside is on its left."""
    x, y = (at - at[0]).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def of_polygon(at: Floats, shape: Rounded, where: Where, name: str) -> Made:
    at = at if area(at) > 0 else at[::-1]
    return of_loops(about_axis(at) if axisymmetric(where) else [at], shape, name)


def axial(shape: Axial) -> Outline:
    """A punch or cone with its place at the origin and its direction along y."""
    r = shape.rounding
    up, across = np.array([0.0, 1.0]), np.array([-1.0, 0.0])
    if isinstance(shape, Cone):
        angle = np.radians(shape.slope)
        tip = -r * up
        way = np.array([-np.cos(angle) * up + side * np.sin(angle) * across for side in (-1, 1)])
        normal = np.array([np.sin(angle) * up + side * np.cos(angle) * across for side in (-1, 1)])
        beside = np.array([[1, -1], [0, -1]])
        return Outline(np.array([tip, tip]), way, np.full(2, 1e300), normal, beside, tip[None])
    half = shape.radius - r
    first, last = -r * up - half * across, -r * up + half * across
    way, normal = np.array([-up, across, -up]), np.array([-across, up, across])
    length = np.array([1e300, 2 * half, 1e300])
    beside = np.array([[1, -1], [0, 2], [1, -1]])
    return Outline(np.array([first, first, last]), way, length, normal, beside, np.array([first, last]))


def turned(outline: Outline, place: Floats, way: Floats) -> Outline:
    """An outline about the origin, with y along `way`, at its place."""
    turn = np.array([[way[1], -way[0]], way])  # images of the axes, as rows
    return Outline(
        place + outline.start @ turn,
        outline.way @ turn,
        outline.length,
        outline.normal @ turn,
        outline.beside,
        place + outline.corners @ turn,
    )


def box_in_space(shape: Box) -> Made:
    low, high = np.minimum(shape.place, shape.opposite), np.maximum(shape.place, shape.opposite)
    by = -shape.rounding if shape.inside else shape.rounding
    if 2 * by >= (high - low).min():
        most = (high - low).min() / 2
        raise Refusal(f"box: round {by:g}: a side is too short for it; allowed: below {most:g}")
    low, high = low + by, high - by
    corner = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)])
    sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    three = np.array([side for a, b, c, d in sides for side in ((a, b, c), (a, c, d))])
    three = three[:, ::-1] if shape.inside else three
    return Made(facets=Facets(low + corner * (high - low), three), round=shape.rounding)


def surface_of(shape: Shape, where: Where, line: int = 0) -> Made:
    """The surface of a shape with edges, stated in this line of the case; raises a Refusal."""
    try:
        return made_of(shape, where)
    except Refusal as refusal:
        raise Refusal(str(refusal), line) from refusal


def made_of(shape: Shape, where: Where) -> Made:
    if isinstance(shape, Polygon):
        return of_polygon(np.array(shape.corners)[:, :2], shape, where, "polygon")
    if isinstance(shape, Box):
        if where.space:
            return box_in_space(shape)
        (x, y, _), (u, v, _) = shape.place, shape.opposite
        return of_polygon(np.array([[x, y], [u, y], [u, v], [x, v]]), shape, where, "box")
    if isinstance(shape, Axial):
        place, way = np.array(shape.place), unit(np.array(shape.direction))
        if where.space:
            return Made(axial(shape), round=shape.rounding, axis=np.array([place, way]), about=True)
        return Made(turned(axial(shape), place[:2], way[:2]), round=shape.rounding)
    assert isinstance(shape, Surface)
    if where.space:
        return Made(facets=Facets(*triangles_of(shape)))
    return Made(segments_of(shape, axisymmetric(where)))
