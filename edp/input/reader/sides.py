"""Groups that a case picks on a finished mesh: sides of its boundary by their place.

`pick_on_mesh(mesh, case)` adds what each statement `group` picks: sides of one element only that lie wholly in a box,
in a plane or on a cylinder, the smooth part of the boundary nearest to a point, or sides of elements by numbers. Two
neighbours belong to one smooth part if their normals at the common edge are within 30 degrees: at its ends, by the
quadratic map of elements of second order. A body is picked by a box, or as the part nearest to a point.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import NoReturn

import numpy as np

from . import grammar as g
from .case import Case
from .fields import Vector3
from .mesh import KINDS, Block, Bools, Floats, Ints, Mesh, Side, alone, components, keys_of, sides_of
from .neighbours import distances
from .words import Refusal, quoted

SMOOTH = 30.0  # degrees between neighbours
NEAR = 1e-6  # of the whole: nodes so near to a plane or a box lie in it
ROUND = 1e-4  # of its radius: nodes so near to a cylinder lie on it
DOUBT = 0.05  # of a side's size: how far flat sides may be off what they stand for


class Boundary:
    """The sides of one element only. of: their rows in `sides`; ends: their corners and the middles between them."""

    def __init__(self, mesh: Mesh, blocks: list[Block]) -> None:
        self.mesh = mesh
        self.sides = sides_of(mesh, blocks)
        self.free = alone(self.sides)
        self.space = blocks[0].of.dimension == 3
        x = mesh.places[np.concatenate([block.nodes.reshape(-1) for block in blocks])]
        self.diagonal = float(np.linalg.norm(x.max(axis=0) - x.min(axis=0)))

    def chosen(self, inside: list[Bools]) -> list[Ints]:
        """Rows, by side, of the boundary."""
        return [np.flatnonzero(free & own) for free, own in zip(self.free, inside, strict=True)]

    def where(self, places_inside: Bools) -> list[Bools]:
        """Sides whose nodes are all inside."""
        return [np.logical_and.reduce(places_inside[side.nodes], axis=1) for side in self.sides]

    def ring(self, side: Side) -> tuple[Ints, Ints | None]:
        """The corners of a side, and the middles behind them."""
        of = KINDS[side.kind]
        corners = side.nodes[:, : of.corners]
        return corners, side.nodes[
            :, of.corners : of.corners + (of.corners if self.space else 1)
        ] if of.second else None

    def normals(self, side: Side) -> Floats:
        """(sides, corners, 3): out of the bodies, of any length."""
        x = self.mesh.places
        corners, middles = self.ring(side)
        a = x[corners]
        if self.space:
            after, before = np.roll(a, -1, axis=1) - a, np.roll(a, 1, axis=1) - a
            if middles is not None:
                m = x[middles]
                after, before = 4 * (m - a) - after, 4 * (np.roll(m, 1, axis=1) - a) - before
            normal = np.cross(after, before)
        else:
            along = np.repeat(a[:, 1:] - a[:, :1], 2, axis=1)
            if middles is not None:
                m = x[middles]
                along = np.concatenate([4 * m - 3 * a[:, :1] - a[:, 1:], 3 * a[:, 1:] + a[:, :1] - 4 * m], axis=1)
            normal = np.stack([along[..., 1], -along[..., 0], np.zeros(along.shape[:2])], axis=2)
        inside = x[side.block.nodes[:, : side.block.of.corners]].mean(axis=1)
        outward = ((a.mean(axis=1) - inside) * normal.mean(axis=1)).sum(axis=1) < 0
        normal[outward] *= -1
        return normal

    def along_radius(self, side: Side, pick: g.OnCylinder) -> Bools:
        """Which sides look along or against the radius of a cylinder."""
        out = from_axis(self.mesh.places, pick)[self.ring(side)[0]].mean(axis=1)
        normal = self.normals(side).mean(axis=1)
        return 2 * (normal * out).sum(axis=1) ** 2 > (normal**2).sum(axis=1) * (out**2).sum(axis=1)

    def to_point(self, side: Side, rows: Ints, point: Vector3) -> tuple[Floats, Floats]:
        """The distances of sides from a point, by flat pieces between corners and middles; and the sides' sizes."""
        x, at = self.mesh.places, np.array([point])
        corners, middles = self.ring(side)
        a = x[corners[rows]]
        size = np.linalg.norm(a.max(axis=1) - a.min(axis=1), axis=1)
        if not self.space:
            joints = [a[:, 0], a[:, 1]] if middles is None else [a[:, 0], x[middles[rows, 0]], a[:, 1]]
            pieces = [np.stack([p, q, q], axis=1) for p, q in pairwise(joints)]
        else:
            ring, centre = a, a.mean(axis=1)
            if middles is not None:
                m = x[middles[rows]]
                ring = np.stack([a, m], axis=2).reshape(len(a), -1, 3)
                mean, middle = a.mean(axis=1), m.mean(axis=1)
                centre = (4 * middle - mean) / 3 if a.shape[1] == 3 else 2 * middle - mean
            after = np.roll(ring, -1, axis=1)
            pieces = [np.stack([centre, ring[:, k], after[:, k]] * 2, axis=1) for k in range(ring.shape[1])]
        return np.min([distances(at, piece) for piece in pieces], axis=0), size

    def patches(self) -> tuple[Ints, Ints, Ints]:
        """Of all sides of the boundary: which of `sides`, which row, and the number of their smooth part."""
        which = np.repeat(np.arange(len(self.sides)), [int(free.sum()) for free in self.free])
        row = np.concatenate([np.flatnonzero(free) for free in self.free])
        keys, ends, own, first = [], [], [], 0
        for side, free in zip(self.sides, self.free, strict=True):
            normal = self.normals(side)[free]
            normal = normal / (np.linalg.norm(normal, axis=2)[..., None] + 1e-300)
            corners = self.ring(side)[0][free]
            count = corners.shape[1]
            for k in range(count):
                j = (k + 1) % count if self.space else k
                nodes = corners[:, [k, j]]
                turned = (nodes[:, 0] > nodes[:, 1])[:, None]
                keys.append(keys_of(nodes, len(self.mesh.places)))
                n, m = normal[:, k], normal[:, j]
                ends.append(np.stack([np.where(turned, m, n), np.where(turned, n, m)], axis=1))
                own.append(first + np.arange(len(nodes)))
            first += len(corners)
        key, end, of = np.concatenate(keys), np.concatenate(ends), np.concatenate(own)
        order = np.argsort(key, kind="stable")
        pairs = [np.zeros((0, 2), np.int64)]
        for apart in range(1, len(key)):  # several bodies may have one edge
            one, other = order[:-apart], order[apart:]
            same = key[one] == key[other]
            if not same.any():
                break
            one, other = one[same], other[same]
            smooth = ((end[one] * end[other]).sum(axis=2) > np.cos(np.radians(SMOOTH))).all(axis=1)
            pairs.append(np.column_stack([of[one], of[other]])[smooth])
        both = np.concatenate(pairs)
        return which, row, components(len(which), both[:, 0], both[:, 1])

    def near(self, point: Vector3) -> tuple[list[Ints], str]:
        """The smooth part nearest to a point, by side; or why that is none."""
        which, row, patch = self.patches()
        away, size = np.empty(len(which)), np.empty(len(which))
        for k, side in enumerate(self.sides):
            away[which == k], size[which == k] = self.to_point(side, row[which == k], point)
        best = int(np.argmin(away))
        slack = NEAR * self.diagonal + DOUBT * size[best]
        other = patch[(away < away[best] + slack) & (patch != patch[best])]
        if len(other):
            return [], f"{len(np.unique(other)) + 1} smooth parts of the boundary are equally near"
        return [row[(which == k) & (patch == patch[best])] for k in range(len(self.sides))], ""


def no(s: g.PickedGroup, what: str) -> NoReturn:
    raise Refusal(f"{quoted(s.name)}: {what}", s.line)


def from_axis(x: Floats, pick: g.OnCylinder) -> Floats:
    """The ways from the axis of a cylinder to places."""
    off, axis = x - pick.point, np.array(pick.axis) / np.linalg.norm(pick.axis)
    return off - np.outer(off @ axis, axis)


def lies_in(x: Floats, pick: g.Box | g.InPlane | g.OnCylinder, near: float, round_: float) -> Bools:
    """Which places lie in a box, in a plane or on a cylinder: within `near`, on a cylinder within `round_`."""
    match pick:
        case g.Box():
            low, high = np.minimum(pick.corner, pick.opposite), np.maximum(pick.corner, pick.opposite)
            return np.logical_and.reduce((x > low - near) & (x < high + near), axis=1)
        case g.InPlane():
            return np.abs((x - pick.point) @ (np.array(pick.normal) / np.linalg.norm(pick.normal))) < near
        case g.OnCylinder():
            return np.abs(np.linalg.norm(from_axis(x, pick), axis=1) - pick.radius) < round_


def pick_sides(boundary: Boundary, s: g.PickedGroup, pick: object) -> list[Ints]:
    """Rows, by side, that a statement picks."""
    x, near = boundary.mesh.places, NEAR * boundary.diagonal
    match pick:
        case g.Box() | g.InPlane():
            return boundary.chosen(boundary.where(lies_in(x, pick, near, near)))
        case g.OnCylinder():
            inside = boundary.where(lies_in(x, pick, near, ROUND * pick.radius))
            ways = (boundary.along_radius(side, pick) for side in boundary.sides)
            return boundary.chosen([own & way for own, way in zip(inside, ways, strict=True)])
        case g.ElementSides():
            sides = boundary.sides
            inside = [np.isin(side.block.number, pick.elements) & (side.number == int(pick.side)) for side in sides]
            for side, own, free in zip(sides, inside, boundary.free, strict=True):
                for k in np.flatnonzero(own & ~free)[:1]:
                    inside_ = f"side {pick.side:g} of element {side.block.number[k]} is inside"
                    no(s, f"{inside_}; allowed: sides of the boundary")
            return boundary.chosen(inside)
        case g.Near():
            found, why = boundary.near(pick.point)
            if why:
                no(s, f"near: {why}; allowed: a point nearer to one of them, plane, box")
            return found
    no(s, "a mesh has no numbers of faces, no bodies of a geometry; allowed: plane, box, near")


def pick_body(boundary: Boundary, blocks: list[Block], s: g.PickedGroup, pick: object) -> list[Bools]:
    """The elements that a statement picks as a body: by block."""
    if isinstance(pick, g.Box):
        near = NEAR * boundary.diagonal
        inside = lies_in(boundary.mesh.places, pick, near, near)
        return [np.logical_and.reduce(inside[block.nodes], axis=1) for block in blocks]
    if not isinstance(pick, g.Near):
        no(s, "a mesh has no numbers of bodies; allowed: box, near")
    begin = dict(zip(map(id, blocks), np.cumsum([0, *(len(b.nodes) for b in blocks)]).tolist(), strict=False))
    key = np.concatenate([side.key for side in boundary.sides])
    own = np.concatenate([begin[id(side.block)] + np.arange(len(side.key)) for side in boundary.sides])
    order = np.argsort(key, kind="stable")
    same = key[order[1:]] == key[order[:-1]]
    part = components(sum(len(b.nodes) for b in blocks), own[order[:-1]][same], own[order[1:]][same])
    best, where = np.inf, -1
    for side, free in zip(boundary.sides, boundary.free, strict=True):
        rows = np.flatnonzero(free)
        if len(rows):
            away = boundary.to_point(side, rows, pick.point)[0]
            k = int(np.argmin(away))
            if away[k] < best:
                best, where = float(away[k]), int(part[begin[id(side.block)] + rows[k]])
    return np.split(part == where, np.cumsum([len(b.nodes) for b in blocks])[:-1])


@np.errstate(all="ignore")  # places up to 1e150
def pick_on_mesh(mesh: Mesh, case: Case) -> Mesh:
    """The mesh with the groups that the case picks by their place."""
    picked = case.of(g.PickedGroup)
    dimension = case.where.dimension
    blocks = [block for block in mesh.blocks if block.of.dimension == dimension]
    if not picked or not blocks:
        return mesh
    made = replace(mesh, names=dict(mesh.names))
    blocks = [replace(block, group=block.group.copy()) for block in blocks]
    boundary = Boundary(made, blocks)
    last = max(int(block.line.max(initial=0)) for block in mesh.blocks)
    added: list[Block] = []
    for s in picked:
        tag = made.group(case.groups.picked[s.name], s.name)
        if case.groups.picked[s.name] == dimension:
            bodies = pick_body(boundary, blocks, s, s.pick)
            for block, own in zip(blocks, bodies, strict=True):
                block.group[own] = tag
            count = sum(int(own.sum()) for own in bodies)
        else:
            rows = pick_sides(boundary, s, s.pick)
            for side, chosen in zip(boundary.sides, rows, strict=True):
                added.append(side.rows(chosen, last + 1 + np.arange(len(chosen)), tag))
                last += len(chosen)
            count = sum(map(len, rows))
        if not count:
            what = "elements lie" if case.groups.picked[s.name] == dimension else "sides of the boundary lie"
            no(s, f"no {what} there wholly; allowed: one or more")
    made.blocks = [block for block in mesh.blocks if block.of.dimension != dimension] + blocks + added
    return made
