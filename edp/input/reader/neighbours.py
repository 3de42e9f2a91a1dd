"""Bodies of a geometry that touch: pairs of faces that lie on each other.

Two faces lie on each other if they are of one kind, at one place within 1e-6 of the whole, if a piece of one lies
inside the other, and if they look at each other. Faces of kind other do so if they have one area and one middle.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np

from .geometry import MIDDLE, PARTS, Array, Face, Outline

Touching = dict[tuple[int, int], list[tuple[int, int]]]  # by two bodies: pairs of faces


def one_shape(f: Face, g: Face, near: float, diagonal: float) -> bool:
    """Whether two faces lie on one plane, cylinder, ...: within `near`."""
    if f.kind != g.kind:
        return False
    apart = g.spot - f.spot
    along, off = float(apart @ f.way), float(apart @ apart)
    if f.kind == "other":
        return off < (1e-4 * diagonal) ** 2 and abs(f.area - g.area) < 1e-4 * f.area
    if f.kind in ("sphere", "circle"):
        return off < near**2 and abs(f.radius - g.radius) < near
    if 1 - float(f.way @ g.way) ** 2 > 1e-10:
        return False
    if f.kind in ("plane", "line"):
        return abs(along) < near
    if off - along**2 > near**2 or abs(f.tilt - g.tilt) > 1e-5:
        return False
    slope = np.tan(f.tilt) * (-1 if (g.radius - f.radius) * along < 0 else 1)
    return bool(abs(g.radius - f.radius - slope * along) < 2 * near)


def opposite(f: Face, g: Face) -> bool:
    """Whether they look at each other: flush faces, with one outward normal, share an edge at most."""
    if f.kind == "other" or len(f.bodies) != 1 or len(g.bodies) != 1:
        return True
    return bool(f.way @ g.way < 0) if f.kind in ("plane", "line") else f.hollow != g.hollow


def parts_of(pieces: Array) -> Array:
    """The middles of the quarters of pieces, in the plane of their halves: (pieces, 4 or 2, 3)."""
    return np.einsum("m,cmn,pnk->pck", MIDDLE[pieces.shape[1]], PARTS[pieces.shape[1]], pieces)


def bows(pieces: Array) -> Array:
    """How far the sides of pieces are from straight."""
    corners = 3 if pieces.shape[1] == 6 else 2
    ends, middles = pieces[:, :corners], pieces[:, corners:]
    straight = ((ends + np.roll(ends, -1, axis=1)) / 2)[:, : middles.shape[1]]
    return np.linalg.norm(middles - straight, axis=2).max(axis=1)


def normals(pieces: Array) -> Array:
    """Of flat pieces, of length 1."""
    a = pieces[:, 1] - pieces[:, 0]
    b = pieces[:, 2] - pieces[:, 0] if pieces.shape[1] == 6 else np.array([0.0, 0.0, 1.0])
    across = np.cross(a, b)
    return across / (np.linalg.norm(across, axis=1)[:, None] + 1e-300)


def to_segment(q: Array, a: Array) -> Array:
    """Distances from places q to segments from 0 to a."""
    t = np.clip((q * a).sum(-1) / ((a * a).sum(-1) + 1e-300), 0, 1)
    return np.linalg.norm(q - t[..., None] * a, axis=-1)


def distances(places: Array, pieces: Array) -> Array:
    """From places to flat pieces between corners: (..., 3) and (..., 6 or 3, 3)."""
    q, a = places - pieces[..., 0, :], pieces[..., 1, :] - pieces[..., 0, :]
    if pieces.shape[-2] == 3:
        return to_segment(q, a)
    b = pieces[..., 2, :] - pieces[..., 0, :]
    aa, ab, bb, qa, qb = ((x * y).sum(-1) for x, y in ((a, a), (a, b), (b, b), (q, a), (q, b)))
    det = aa * bb - ab * ab + 1e-300
    u, v = (qa * bb - qb * ab) / det, (qb * aa - qa * ab) / det
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    above = np.linalg.norm(q - u[..., None] * a - v[..., None] * b, axis=-1)
    sides = np.minimum(np.minimum(to_segment(q, a), to_segment(q, b)), to_segment(q - a, b - a))
    return np.where(inside, above, sides)


def part_on(f: Array, g: Array, near: float) -> bool:
    """Whether a quarter of a piece of f, in the plane a half, lies on g."""
    low, high = g.reshape(-1, 3).min(0) - near, g.reshape(-1, 3).max(0) + near
    play_f, play_g, ways_f, ways_g = near + 1.2 * bows(f), near + 1.2 * bows(g), normals(f), normals(g)
    for k, places in enumerate(parts_of(f)):
        places = places[((places >= low) & (places <= high)).all(axis=1)]
        if len(places):
            alike = (ways_g @ ways_f[k]) ** 2 > 0.5
            if (distances(places[:, None], g[alike]) < play_f[k] + play_g[alike]).any():
                return True
    return False


def touching(made: Outline, found: list[Face]) -> Touching:
    """The pairs of faces on each other, by pairs of bodies."""
    near, sides = 1e-6 * made.diagonal, made.sides
    pairs: Touching = {}
    low = np.array([made.pieces[face.number].min((0, 1)) - near for face in found])
    high = np.array([made.pieces[face.number].max((0, 1)) for face in found])
    order = {body: k for k, body in enumerate(made.bodies)}
    for i, one in enumerate(found):
        meet = (low[i] <= high[i + 1 :]).all(axis=1) & (low[i + 1 :] <= high[i]).all(axis=1)
        for other in (found[i + 1 + int(k)] for k in np.flatnonzero(meet)):
            if not one_shape(one, other, near, made.diagonal) or not opposite(one, other):
                continue
            f, g = made.pieces[one.number], made.pieces[other.number]
            if not part_on(f, g, near) and not part_on(g, f, near):
                continue
            for a in sides[one.number]:
                for b in (b for b in sides[other.number] if b != a):
                    swap = order[a] > order[b]
                    pair = (other.number, one.number) if swap else (one.number, other.number)
                    pairs.setdefault((b, a) if swap else (a, b), []).append(pair)
    places = {body: {face: k for k, face in enumerate(own)} for body, own in made.bodies.items()}
    return {
        (a, b): sorted(pairs[a, b], key=lambda pair: (places[a][pair[0]], places[b][pair[1]]))
        for a, b in combinations(made.bodies, 2)
        if (a, b) in pairs
    }


def by_face(pairs: Touching) -> dict[int, list[int]]:
    """By face: those of other bodies that lie on it."""
    found: dict[int, list[int]] = {}
    for f, g in (pair for both in pairs.values() for pair in both):
        found.setdefault(f, []).append(g)
        found.setdefault(g, []).append(f)
    return found


def statements(
    made: Outline, found: list[Face], pairs: Touching, told: dict[tuple[int, int], bool] | None = None
) -> str:
    """For each pair of bodies that touch: the statements of a case that say what happens there; told: it has some."""
    area = {face.number: face.area for face in found}
    many, sides = ("volumes", "faces") if made.space else ("surfaces", "curves")
    text = ""
    for (a, b), both in pairs.items():
        listed = ", ".join(f"{f} on {g}" for f, g in both)
        done = (told or {}).get((a, b))
        how = "the case file says how" if done else "nothing joins them until the case file says how"
        text += f"\n{many} {a} and {b} touch ({sides} {listed}): {how}\n"
        if done:
            continue
        names = []
        for body in (a, b):
            if body not in made.names:
                text += f"  group V{body} {many} {body}\n"
            names.append(made.names.get(body, f"V{body}"))
        # the slave first: the smaller face
        if sum(area[f] for f, _ in both) > (1 + 1e-6) * sum(area[g] for _, g in both):
            names.reverse()
        join = f"  join {' '.join(names)}"
        text += f"{join} part      # one part: they share nodes\n{join} tie       # glued, each with its own nodes\n"
        text += f"{join} contact   # they may part and slide\n"
    return text
