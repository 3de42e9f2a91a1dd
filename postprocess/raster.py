"""Triangles as they are seen, on a grid of pixels: which one is in front, and where in a region a label has most room.

`fronts(seen, low, step, shape)` gives by pixel the triangle in front, -1 where there is none. `rooms(number)` gives by
region of a picture of numbers the pixel that is farthest from the region's edge, and how far that is.
"""

import numpy as np

CHUNK = 4_000_000  # pixels looked at at once


def fronts(seen: np.ndarray, low: np.ndarray, step: float, shape: tuple[int, int]) -> np.ndarray:
    """seen: triangles (n, 3, 3), to the right, up, towards the eye; low: the lower left corner; step: a pixel's side.

    The rows of the picture begin below.
    """
    rows, columns = shape
    front, near = np.full(rows * columns, -1), np.full(rows * columns, -np.inf)
    at, depth = (seen[:, :, :2] - low) / step - 0.5, seen[:, :, 2]
    least = np.maximum(np.ceil(at.min(axis=1)), 0).astype(int)
    most = np.minimum(np.floor(at.max(axis=1)), [columns - 1, rows - 1]).astype(int)
    wide, high = np.maximum(most - least + 1, 0).T
    (ax, ay), (bx, by), (cx, cy) = (at[:, k].T for k in range(3))
    twice = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    count = np.where(np.abs(twice) > 1e-12, wide * high, 0)
    parts = np.cumsum(count) // CHUNK
    for part in np.unique(parts):
        own = np.flatnonzero((parts == part) & (count > 0))
        of = np.repeat(own, count[own])
        here = np.arange(len(of)) - np.repeat(np.cumsum(count[own]) - count[own], count[own])
        x, y = least[of, 0] + here % wide[of], least[of, 1] + here // wide[of]
        dx, dy = x - ax[of], y - ay[of]
        u = (dx * (cy - ay)[of] - dy * (cx - ax)[of]) / twice[of]
        v = (dy * (bx - ax)[of] - dx * (by - ay)[of]) / twice[of]
        inside = (u >= 0) & (v >= 0) & (u + v <= 1)
        of, u, v, pixel = of[inside], u[inside], v[inside], (y * columns + x)[inside]
        z = depth[of, 0] + u * (depth[of, 1] - depth[of, 0]) + v * (depth[of, 2] - depth[of, 0])
        order = np.argsort(z, kind="stable")
        order = order[z[order] > near[pixel[order]]]
        front[pixel[order]], near[pixel[order]] = of[order], z[order]  # of one pixel the last, which is nearest
    return front.reshape(shape)


def edges(number: np.ndarray) -> np.ndarray:
    """The pixels on both sides of a line between two numbers."""
    found = np.zeros(number.shape, bool)
    across, up = number[:, 1:] != number[:, :-1], number[1:] != number[:-1]
    for part, edge in ((found[:, :-1], across), (found[:, 1:], across), (found[:-1], up), (found[1:], up)):
        part |= edge
    return found


def rooms(number: np.ndarray) -> dict[int, tuple[int, int, int]]:
    """By number, of those from 0 on: row and column of the pixel farthest from other numbers, and how many pixels."""
    alive, far = number >= 0, np.zeros(number.shape, int)
    alive[[0, -1]] = alive[:, [0, -1]] = False
    same = [(slice(None), slice(1, None)), (slice(None), slice(None, -1)), (slice(1, None),), (slice(None, -1),)]
    alike = number[same[0]] == number[same[1]], number[same[2]] == number[same[3]]
    for _ in range(80):
        kept = alive.copy()
        kept[same[0]] &= alive[same[1]] & alike[0]
        kept[same[1]] &= alive[same[0]] & alike[0]
        kept[same[2]] &= alive[same[3]] & alike[1]
        kept[same[3]] &= alive[same[2]] & alike[1]
        alive = kept
        if not alive.any():
            break
        far += alive
    row, column = np.nonzero(far)
    value, room = number[row, column], far[row, column]
    found = {}
    for each in np.unique(value):
        own = value == each
        own &= room == room[own].max()
        place = np.column_stack([row, column])[own]
        best = place[np.argmin(np.linalg.norm(place - place.mean(axis=0), axis=1))]
        found[int(each)] = int(best[0]), int(best[1]), int(room[own][0])
    return found
