"""Triangles of a rigid surface: normals of faces, edges and corners, blocks, sharp edges, distances.

The normal of an edge is the sum of those of its triangles, that of a corner the sum weighted with their angles there:
with them the sign of the distance is right wherever the nearest point is. Where the surface ends they are 0. Source:
Baerentzen and Aanaes, Signed distance computation using the angle weighted pseudonormal, IEEE TVCG 11, 2005.
"""

from __future__ import annotations

import numpy as np

from ..mesh import Floats, Ints

BLOCK = 4  # triangles
SHARP = 0.35  # least angle between the normals at a sharp edge, rad
AT_ONCE = 400_000  # pairs of places and triangles


def sides_of(corners: Ints, count: int) -> tuple[Ints, Ints]:
    """Ends of the sides of each triangle, from corner to corner, and a number that both triangles at an edge share."""
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
    return ends, ends.min(axis=1) * count + ends.max(axis=1)


class Facets:
    """places: (nodes, 3); corners: (triangles, 3), the free side where they turn to the left."""

    def __init__(self, places: Floats, corners: Ints) -> None:
        middle = places[corners].mean(axis=1)
        size = np.ptp(places, axis=0).max() + 1e-300
        cells = ((middle - places.min(axis=0)) / size * 1023).astype(np.int64)
        key = np.zeros(len(corners), np.int64)
        for bit in range(10):
            for axis in range(3):
                key |= (cells[:, axis] >> bit & 1) << (3 * bit + axis)
        self.corners = corners = corners[np.argsort(key, kind="stable")]
        self.at = places[corners]  # triangles x corners x 3
        across = np.cross(self.at[:, 1] - self.at[:, 0], self.at[:, 2] - self.at[:, 0])
        self.normal = across / np.linalg.norm(across, axis=1, keepdims=True)
        self.edge_normals(len(places))

    def edge_normals(self, count: int) -> None:
        """Of side k, from corner k to the next one, and of corner k: (triangles, 3, 3); sharp edges (edges, 2, 3)."""
        n = len(self.corners)
        ends, key = sides_of(self.corners, count)
        _, edge, times = np.unique(key, return_inverse=True, return_counts=True)
        own = np.repeat(self.normal, 3, axis=0)
        sums = np.zeros((len(times), 3))
        np.add.at(sums, edge, own)
        ended = times != 2
        sums[ended] = 0
        self.along = sums[edge].reshape(n, 3, 3)
        ways = np.roll(self.at, -1, axis=1) - self.at
        ways /= np.linalg.norm(ways, axis=2, keepdims=True)
        angle = np.arccos(np.clip(-(ways * np.roll(ways, 1, axis=1)).sum(2), -1, 1))
        corner = np.zeros((count, 3))
        np.add.at(corner, self.corners.ravel(), angle.reshape(-1, 1) * own)
        corner[ends[ended[edge]].ravel()] = 0
        self.tips = corner[self.corners]
        other = sums[edge] - own  # the normal on the other side
        inner = np.roll(ways, -1, axis=1).reshape(-1, 3)  # from the side into its triangle
        turn = np.arccos(np.clip((own * other).sum(1), -1, 1))
        convex = (other * inner).sum(1) < 0
        self.convex = not ended.any() and bool((convex | (turn < 1e-6)).all()) and self.is_one()
        chosen = ~ended[edge] & (turn > SHARP) & convex & (ends[:, 0] < ends[:, 1])
        sides = np.stack([self.at, np.roll(self.at, -1, axis=1)], axis=2).reshape(-1, 2, 3)
        self.edges = sides[chosen]

    def is_one(self) -> bool:
        """Whether a closed surface is that of one body without holes: Euler's number."""
        n = len(self.corners)
        return len(np.unique(self.corners)) - n // 2 == 2

    def rows(self) -> list[str]:
        put = np.concatenate([self.at, self.along, self.tips], axis=1).reshape(len(self.at), 27)
        return [" ".join(f"{value:.17g}" for value in row) for row in put.tolist()]

    def blocks(self) -> list[str]:
        found = []
        for first in range(0, len(self.at), BLOCK):
            nodes = self.at[first : first + BLOCK].reshape(-1, 3)
            centre = (nodes.min(axis=0) + nodes.max(axis=0)) / 2
            radius = np.linalg.norm(nodes - centre, axis=1).max()
            beyond = min(first + BLOCK, len(self.at))
            found.append(f"{first} {beyond} " + " ".join(f"{value:.17g}" for value in [*centre, radius]))
        return found

    def distance(self, places: Floats) -> Floats:
        """From the places (places x 3) to the nearest triangle."""
        found = np.full(len(places), np.inf)
        rows = max(1, AT_ONCE // len(self.at))
        for k in range(0, len(places), rows):
            p = places[k : k + rows, None]
            best = np.full((len(p), len(self.at)), np.inf)
            inside = np.ones_like(best, bool)
            for a in range(3):
                way = self.at[:, (a + 1) % 3] - self.at[:, a]
                off = p - self.at[:, a]
                along = np.clip((off * way).sum(2) / (way * way).sum(1), 0, 1)
                best = np.minimum(best, ((off - along[..., None] * way) ** 2).sum(2))
                inside &= (off * np.cross(self.normal, way)).sum(2) >= 0
            flat = ((p - self.at[:, 0]) * self.normal).sum(2) ** 2
            found[k : k + rows] = np.sqrt(np.where(inside, np.minimum(flat, best), best).min(axis=1))
        return found
