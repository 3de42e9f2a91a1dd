"""Where faces are nearest: pieces of second order, split until they are as small as a question asks for.

A Store holds the pieces of an outline (geometry.py) and their parts. `closest` is the distance of places from pieces.
`nearest` finds the pieces of a slave whose distance from a master, or from an obstacle's shape, is at most a margin
above the least; `closer` says where the outline must be finer before that is known. Between faces that nearly touch,
an error e of the outline moves the place where they are nearest by about sqrt(2 R e), and an outline whose curves cross
is nearest where they cross. In the plane a piece inside the other body is in contact.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
import numpy.typing as npt

from .geometry import MIDDLE, PARTS, Array
from .neighbours import bows, distances, normals

Numbers = npt.NDArray[np.int64]
PAIRS = 1_000_000  # at once
MOST = 20_000  # pieces of a slave


class Store:
    """Pieces and their parts: nodes, faces, middles on the surface, radii around these, pieces that they are of."""

    def __init__(self, pieces: dict[int, Array]) -> None:
        self.nodes = np.concatenate(list(pieces.values()))
        self.corners = self.nodes.shape[1]
        self.face = np.repeat(list(pieces), [len(p) for p in pieces.values()])
        self.root = np.arange(len(self.nodes))
        self.parts = np.full(len(self.nodes), -1)
        self.centre, self.reach, self.bow = self.balls(self.nodes)
        self.doubt = self.doubts()
        self.finest, self.unsure = np.inf, np.zeros(0, int)

    @property
    def space(self) -> bool:
        return bool(self.corners == 6)

    def balls(self, nodes: Array) -> tuple[Array, Array, Array]:
        centre = np.einsum("n,pnk->pk", MIDDLE[self.corners], nodes)
        return centre, np.linalg.norm(nodes - centre[:, None], axis=2).max(axis=1), bows(nodes)

    def of(self, faces: Sequence[int]) -> Numbers:
        """The pieces of faces, in the order of these."""
        found = [np.flatnonzero(self.face[: len(self.doubt)] == face) for face in faces]
        return np.concatenate(found) if found else np.zeros(0, int)

    def within(self, pieces: Numbers, others: Numbers, slack: float) -> npt.NDArray[np.bool_]:
        """Which pieces are near the box of others."""
        nodes, reach = self.nodes[others].reshape(-1, 3), self.reach[pieces][:, None] + slack
        low, high = self.centre[pieces] - reach, self.centre[pieces] + reach
        return ((high >= nodes.min(0)) & (low <= nodes.max(0))).all(axis=1)

    def split(self, pieces: Numbers) -> Numbers:
        """The four parts of each piece, in the plane two: (pieces, 4 or 2)."""
        mixed = PARTS[self.corners]
        fresh = np.unique(pieces[self.parts[pieces] < 0])
        if len(fresh):
            nodes = np.einsum("cmn,pnk->pcmk", mixed, self.nodes[fresh]).reshape(-1, self.corners, 3)
            self.parts[fresh] = len(self.nodes) + len(mixed) * np.arange(len(fresh))
            self.nodes = np.concatenate([self.nodes, nodes])
            self.root = np.append(self.root, np.repeat(self.root[fresh], len(mixed)))
            self.face = np.append(self.face, np.repeat(self.face[fresh], len(mixed)))
            self.parts = np.append(self.parts, np.full(len(nodes), -1))
            centre, reach, bow = self.balls(nodes)
            self.centre = np.concatenate([self.centre, centre])
            self.reach, self.bow = np.append(self.reach, reach), np.append(self.bow, bow)
        return self.parts[pieces][:, None] + np.arange(len(mixed))

    def closest(self, places: Array, at: Numbers, of: Numbers, best: Array, flat: float) -> tuple[Array, Numbers]:
        """Least distances of places, below `best`, and the pieces of the outline there, or -1.

        at, of: the pairs of places and pieces that are looked at; flat: what flat pieces may lack.
        """
        best, found, upper = best.copy(), np.full(len(best), -1), best + 2 * flat
        while len(at):
            off = np.linalg.norm(self.centre[of] - places[at], axis=1)
            np.minimum.at(upper, at, off + 2 * flat)
            near = off - self.reach[of] <= np.minimum(upper, best)[at]
            at, of = at[near], of[near]
            done = self.bow[of] < flat
            d, a, p = distances(places[at[done]], self.nodes[of[done]]), at[done], of[done]
            np.minimum.at(best, a, d)
            hit = d == best[a]
            found[a[hit]] = self.root[p[hit]]
            at, of = np.repeat(at[~done], len(PARTS[self.corners])), self.split(of[~done]).ravel()
        return best, found

    # ------------------------------------------------------------ how well the outline is known

    def bends(self) -> Array:
        """Of curves in the plane: 8 times the bow over the square of the chord, with a sign."""
        a, b, m = (self.nodes[:, k, :2] for k in range(3))
        chord, off = b - a, m - a
        square = (chord**2).sum(1)
        return 8 * (chord[:, 0] * off[:, 1] - chord[:, 1] * off[:, 0]) / (square**1.5 + 1e-300)

    def sharpest(self) -> Array:
        """In space: the greatest bend of each piece's face, by how far sides' middles are off the corners' planes."""
        ways, most = normals(self.nodes), np.zeros(len(self.nodes))
        for k in range(3):
            side = ((self.nodes[:, (k + 1) % 3] - self.nodes[:, k]) ** 2).sum(1) + 1e-300
            off = np.einsum("pk,pk->p", self.nodes[:, k + 3] - self.nodes[:, k], ways)
            most = np.maximum(most, np.abs(8 / side * off))
        faces, index = np.unique(self.face, return_inverse=True)
        of_face = np.zeros(len(faces))
        np.maximum.at(of_face, index, most)
        return of_face[index]

    def doubts(self) -> Array:
        """How far a piece may be off its face, about four times too much.

        By the change of curvature to its neighbours, which a parabola lacks, and by what it lacks of a circle. In
        space, where neighbours are not known, curvature may change by a quarter within its radius.
        """
        size = 2 * self.reach
        if self.space:
            most = self.sharpest()
            return 0.03 * most**2 * size**3 / 4 + most**3 * size**4 / 128
        bend = self.bends()
        most, change, alone = np.abs(bend), np.zeros(len(bend)), np.ones(len(bend), bool)
        beside = self.face[1:] == self.face[:-1]
        for here, there in ((np.s_[1:], np.s_[:-1]), (np.s_[:-1], np.s_[1:])):
            turn = np.where(beside, np.abs(bend[here] - bend[there]), 0)
            change[here] = np.maximum(change[here], turn)
            most[here] = np.maximum(most[here], np.where(beside, np.abs(bend[there]), 0))
            alone[here] &= ~beside
        change = np.where(alone, most, change)
        return 0.03 * change * size**2 + most**3 * size**4 / 128

    # ------------------------------------------------------------ where a contact is

    def finer(self, pieces: Numbers, grain: float, margin: float) -> npt.NDArray[np.bool_]:
        """Which pieces are replaced by their parts: too large ones, but for small parts of what is in doubt."""
        root = self.root[pieces]
        vain = (self.doubt[root] > margin) & (self.reach[pieces] <= self.reach[root] / (4 if self.space else 16))
        return (self.reach[pieces] > grain) & ~vain

    def surrounded(self, places: Array, around: Numbers) -> npt.NDArray[np.bool_]:
        """In the plane: do pieces surround places? By how often a ray along x meets them."""
        nodes = self.nodes[around]
        x, v = nodes[None, :, :, 0], nodes[None, :, :, 1] - places[:, None, None, 1]
        v0, v1, v2 = v[..., 0], v[..., 1], v[..., 2]
        b = 2 * (v0 + v1 - 2 * v2)
        a = v1 - v0 - b
        # not across the ray: its ends, and the corner of its tangents, are on one side
        clear = ((v0 < 0) == (v1 < 0)) & ((v0 < 0) == (v0 + a / 2 < 0))
        square = a * a - 4 * b * v0
        with np.errstate(divide="ignore", invalid="ignore"):
            s = -(a + np.where(a < 0, -1, 1) * np.sqrt(square)) / 2  # without cancellation
            t, u = np.where(s == 0, 0, v0 / s), np.where(b == 0, 2, s / b)

            def ahead(t: Array) -> npt.NDArray[np.bool_]:
                at = x[..., 0] * (1 - t) * (1 - 2 * t) + x[..., 1] * t * (2 * t - 1) + 4 * x[..., 2] * t * (1 - t)
                return at > places[:, None, 0]

            once = (v0 < 0) != (v1 < 0)
            middle = np.where(np.abs(t - 0.5) > np.abs(u - 0.5), u, t)
            both = (t > 0) & (t < 1) & (u > 0) & (u < 1)
            times = np.where(once, ahead(middle), np.where(both, ahead(t).astype(int) + ahead(u), 0))
        return np.where(clear | (square < 0), 0, times).sum(axis=1) % 2 == 1

    def nearest(
        self, slave: Numbers, master: Numbers, grain: float, margin: float, shape: Distance | None, around: Numbers
    ) -> Numbers:
        """Pieces of the slave, no larger than the grain; around: the boundary of the master's bodies, in the plane.

        If the outline is too coarse for the margin, `finest` and `unsure` say so.
        """
        deep = np.zeros(len(slave), np.int8)  # 1: inside of the master, -1: not, 0: not known
        at = of = np.zeros(0, int)
        first, some = True, False
        rows = max(1, PAIRS // max(1, len(master)))
        for _ in range(40):
            places, doubt, own = self.centre[slave], self.doubt[self.root[slave]], self.reach[slave]
            off_shape = shape.distance(places) if shape else np.full(len(slave), np.inf)
            least = float(np.min(off_shape + doubt, initial=np.inf))
            chunks = [np.arange(k, min(k + rows, len(slave))) for k in range(0, len(slave), rows)] if first else []
            for chunk in chunks:
                off = np.linalg.norm(places[chunk][:, None] - self.centre[master], axis=2)
                both = off + doubt[chunk][:, None] + self.doubt[master]
                least = min(least, float(np.min(both, initial=np.inf)))
            off = np.linalg.norm(places[at] - self.centre[of], axis=1)
            least = min(least, float(np.min(off + doubt[at] + self.doubt[self.root[of]], initial=np.inf)))
            ends = (0.0 if some else least) + margin + own + doubt
            kept = off - self.reach[of] - self.doubt[self.root[of]] <= ends[at]
            pairs = [(at[kept], of[kept])]
            for chunk in chunks:
                off = np.linalg.norm(places[chunk][:, None] - self.centre[master], axis=2)
                a, b = np.nonzero(off - self.reach[master] - self.doubt[master] <= ends[chunk][:, None])
                pairs.append((chunk[a], master[b]))
            at, of = (np.concatenate(side) for side in zip(*pairs, strict=True))
            near = (off_shape <= ends) | (np.bincount(at, minlength=len(slave)) > 0)
            if len(around) and not near.all():
                ask = ~near & (deep == 0)
                deep[ask] = np.where(self.surrounded(places[ask], around), 1, -1)
            keep = near | (deep == 1)
            some = some or bool((~near & keep).any())
            large = self.finer(of, 4 * grain, margin)
            again, first = bool(large.any()), False
            of = np.concatenate([of[~large], self.split(of[large]).ravel()])
            at = np.concatenate([at[~large], np.repeat(at[large], len(PARTS[self.corners]))])
            coarse = self.finer(slave, grain, margin) & keep
            again |= bool(coarse.any())
            # parts take the place of their piece
            parts = np.where(coarse, len(PARTS[self.corners]), 1) * keep
            start = np.cumsum(parts) - parts
            fresh = np.repeat(slave, parts)
            inside = np.arange(len(fresh)) - np.repeat(start, parts)
            self.split(slave[coarse])
            fresh = np.where(np.repeat(coarse, parts), self.parts[fresh] + inside, fresh)
            many = parts[at]
            of, new_at = np.repeat(of, many), np.repeat(start[at], many)
            at = new_at + np.arange(len(new_at)) - np.repeat(np.cumsum(many) - many, many)
            slave, deep = fresh, np.repeat(deep, parts)
            if not again or len(slave) >= MOST:
                break
        self.look(slave, at, of, margin, shape)
        if self.finest < np.inf and self.asks:
            return np.zeros(0, int)
        places = self.centre[slave]
        if shape:
            gap = shape.distance(places)
        else:
            gap, _ = self.closest(places, at, of, np.full(len(slave), np.inf), 0.1 * margin)
        least = 0.0 if some else float(np.min(gap, initial=np.inf))
        far = gap > least + margin
        if len(around):
            ask = far & (deep == 0)
            deep[ask] = np.where(self.surrounded(places[ask], around), 1, -1)
        return slave[~far | (deep == 1)]

    asks = True  # whether a closer outline may be asked for

    def look(self, slave: Numbers, at: Numbers, of: Numbers, margin: float, shape: Distance | None) -> None:
        """Where the error is too large for the margin: it falls with the third power of the size of pieces."""
        doubt, other = self.doubt[self.root[slave]], self.doubt[self.root[of]]
        wrong = doubt[at] + other > margin
        pieces = np.unique(np.concatenate([slave[at[wrong]], of[wrong], slave[doubt > margin] if shape else of[:0]]))
        doubt = self.doubt[self.root[pieces]]
        pieces, doubt = pieces[doubt > 0.4 * margin], doubt[doubt > 0.4 * margin]
        if len(pieces):
            share = np.clip((0.15 * margin / doubt) ** (1 / 3), 0.1, 0.5)
            sizes = np.maximum(2 * self.reach[self.root[pieces]] * share, margin / 2)
            self.finest = min(self.finest, float(sizes.min()))
            self.unsure = np.union1d(self.unsure, pieces)

    def closer(self) -> Array:
        """Places, as far from each other as half the size that is asked for, where the outline must be finer."""
        return self.centre[self.unsure[first_of_cell(self.centre[self.unsure], self.finest / 2)]]


class Distance(Protocol):
    """A rigid shape."""

    def distance(self, places: Array) -> Array: ...


class Shape:
    """A plane, circle, sphere or cylinder."""

    def __init__(self, place: Array, way: Array, radius: float) -> None:
        self.place, self.radius = place, radius
        length = float(np.linalg.norm(way))
        self.way = way / length if length else way

    def distance(self, places: Array) -> Array:
        """From outside or inside."""
        off = places - self.place
        along = off @ self.way
        if self.radius:
            along = np.linalg.norm(off - along[:, None] * self.way, axis=1) - self.radius
        return np.abs(along)


def first_of_cell(places: Array, wide: float) -> Numbers:
    """The first place in each cell of this width, in their order."""
    cells = places / wide
    cells = np.where(cells < 0, -np.floor(-cells) - 1, np.floor(cells))
    return np.sort(np.unique(cells, axis=0, return_index=True)[1])
