"""Rigid surfaces of mesh files: triangles of .stl and .msh, segments of .msh in the plane.

Nodes at one place are one node. Neighbours get one sense; a closed surface has its normals outwards, an open one keeps
the sense of the file: the free side is where its triangles turn to the left, in the plane right of its segments.
"""

from __future__ import annotations

import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..gmsh_process import GmshError
from ..mesh import Floats, Ints, MeshRefusal
from ..msh import read_msh
from ..words import Refusal
from .triangles import sides_of

if TYPE_CHECKING:
    from .shapes import Surface
    from .surfaces import Outline

SAME = 1e-9  # of the size: nodes so near to each other are one
VERTEX = re.compile(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)")
MOST = 200_000


def read_stl(path: Path) -> tuple[Floats, Ints]:
    """Places and corners of a text or binary file."""
    data = path.read_bytes()
    if not data:
        raise Refusal(f"{path}: an empty file; allowed: .stl, text or binary, or .msh")
    count = int.from_bytes(data[80:84], "little")
    if len(data) == 84 + 50 * count:
        kind = np.dtype([("normal", "<f4", 3), ("at", "<f4", (3, 3)), ("more", "<u2")])
        places = np.frombuffer(data, kind, offset=84)["at"].reshape(-1, 3).astype(float)
    else:
        try:
            places = np.array(VERTEX.findall(data), dtype=float).reshape(-1, 3)
        except ValueError:
            places = np.zeros((0, 3))
    if not len(places) or len(places) % 3 or not np.isfinite(places).all():
        raise Refusal(f"{path}: it has no triangles of an .stl file; allowed: .stl, text or binary, or .msh")
    return places, np.arange(len(places)).reshape(-1, 3)


def read_elements(path: Path, dimension: int) -> tuple[Floats, Ints]:
    """Places and corners of the elements of this dimension; of those of second order their parts."""
    from ..mesher import convert  # takes time to load
    from ..names import is_text_of_gmsh

    with tempfile.TemporaryDirectory() as folder:
        try:
            file = path
            if not is_text_of_gmsh(path):
                file = Path(folder) / "surface.msh"
                convert(path, file, named=False)
            mesh = read_msh(file, False)
        except (GmshError, MeshRefusal, OSError) as error:
            raise Refusal(f"{path}: {error}") from error
    cuts = {1: "01", 8: "02 21", 2: "012", 9: "035 314 542 345", 3: "012 023", 10: "012 023", 16: "012 023"}
    found = [
        block.nodes[:, [int(digit) for digit in word]]
        for block in mesh.blocks
        if block.of.dimension == dimension
        for word in cuts[block.kind].split()
    ]
    if not found:
        what = "triangles" if dimension == 2 else "segments"
        raise Refusal(f"{path}: it has no {what}; allowed: a mesh with {what}")
    corners = np.concatenate(found)
    if corners.min() < 0:
        raise Refusal(f"{path}: a node is missing")
    return mesh.places, corners


def read_surface(shape: Surface, dimension: int) -> tuple[Floats, Ints]:
    """Places, scaled and moved, each once, and corners of the parts that are no points or lines."""
    path = Path(shape.file)
    places, corners = read_stl(path) if path.suffix.lower() == ".stl" else read_elements(path, dimension)
    if len(corners) > MOST:
        raise Refusal(f"{path}: {len(corners)} parts; allowed: at most {MOST}")
    places = places * shape.scale + np.array(shape.at)
    used = np.unique(corners)
    size = np.ptp(places[used], axis=0).max()
    low = places[used].min(axis=0)
    cells = np.round((places - low) / max(SAME * size, 1e-300)).astype(np.int64)
    _, first, own = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    corners = own.ravel()[corners]
    places = places[first]
    different = np.ones(len(corners), bool)
    for a in range(corners.shape[1]):
        different &= corners[:, a] != corners[:, a - 1]
    corners = corners[different]
    if dimension == 2:
        at = places[corners]
        across = np.linalg.norm(np.cross(at[:, 1] - at[:, 0], at[:, 2] - at[:, 0]), axis=1)
        corners = corners[across > 1e-12 * size**2]
    if not len(corners):
        raise Refusal(f"{path}: all its parts are points or lines")
    return places, corners


def triangles_of(shape: Surface) -> tuple[Floats, Ints]:
    """Places and corners of a surface in space, in one sense."""
    places, corners = read_surface(shape, 2)
    n = len(corners)
    ends, key = sides_of(corners, len(places))
    order = np.argsort(key, kind="stable")
    same = np.flatnonzero(key[order][1:] == key[order][:-1])
    if len(same) > 1 and (np.diff(same) == 1).any():
        at = places[ends[order[same[np.flatnonzero(np.diff(same) == 1)[0]]]]].mean(axis=0)
        raise Refusal(f"{shape.file}: more than two triangles meet at an edge at ({at[0]:g}, {at[1]:g}, {at[2]:g})")
    one, two = order[same], order[same + 1]
    neighbours: list[list[tuple[int, bool]]] = [[] for _ in range(n)]
    for a, b, against in zip(one // 3, two // 3, ends[one, 0] == ends[two, 0], strict=True):
        neighbours[a].append((int(b), bool(against)))
        neighbours[b].append((int(a), bool(against)))
    sense, part, parts = np.zeros(n, int), np.zeros(n, int), 0
    for first in range(n):
        if sense[first] == 0:
            sense[first], part[first], left = 1, parts, [first]
            while left:
                a = left.pop()
                for b, against in neighbours[a]:
                    wanted = -sense[a] if against else sense[a]
                    if sense[b] == 0:
                        sense[b], part[b] = wanted, parts
                        left.append(b)
                    elif sense[b] != wanted:
                        raise Refusal(f"{shape.file}: a surface with one side; allowed: one with two")
            parts += 1
    closed = np.ones(parts, bool)
    closed[part[[k for k in range(n) if len(neighbours[k]) < 3]]] = False
    at = places[corners] - places.mean(axis=0)
    volume = np.bincount(part, sense * np.einsum("ij,ij->i", at[:, 0], np.cross(at[:, 1], at[:, 2])), parts)
    votes = np.bincount(part, sense, parts)
    sense = sense * np.where(np.where(closed, volume, votes) < 0, -1, 1)[part]
    flip = (sense < 0) != shape.inside
    corners[flip] = corners[flip][:, ::-1]
    return places, corners


def with_mirror(file: str, places: Floats, corners: Ints) -> tuple[Floats, Ints]:
    """Segments in a half plane and their mirror images at x = 0; those on the axis are no surface."""
    size = np.abs(places).max()
    if places[:, 0].min() < -SAME * size:
        raise Refusal(f"{file}: a negative radius; allowed with state axisymmetric: x >= 0")
    on = places[:, 0] <= SAME * size
    corners = corners[~on[corners].all(axis=1)]
    image = np.where(on, np.arange(len(places)), len(places) + np.arange(len(places)))
    return np.vstack([places, places * [-1, 1]]), np.vstack([corners, image[corners][:, ::-1]])


def chains_of(file: str, places: Floats, corners: Ints, inside: bool) -> list[tuple[list[int], bool]]:
    """Nodes in a row, in the sense of the surface, and whether the row is closed; a closed one ends where it begins."""
    at: dict[int, list[int]] = {}
    for k, two in enumerate(corners.tolist()):
        for node in two:
            at.setdefault(node, []).append(k)
    crowded = [node for node, sides in at.items() if len(sides) > 2]
    if crowded:
        x, y = places[crowded[0]]
        raise Refusal(f"{file}: more than two segments meet at ({x:g}, {y:g})")
    done, chains = np.zeros(len(corners), bool), []
    for first in [sides[0] for sides in at.values() if len(sides) == 1] + list(range(len(corners))):
        if done[first]:
            continue
        side: int | None = first
        chain, votes = [next((e for e in corners[first].tolist() if len(at[e]) == 1), int(corners[first, 0]))], 0
        while side is not None and not done[side]:
            done[side] = True
            votes += 1 if corners[side, 0] == chain[-1] else -1
            chain.append(int(corners[side].sum() - chain[-1]))
            side = next((k for k in at[chain[-1]] if not done[k]), None)
        closed = chain[0] == chain[-1]
        if closed:
            x, y = places[chain[:-1]].T
            votes = x @ np.roll(y, -1) - y @ np.roll(x, -1)
        chains.append((chain[::-1] if (votes < 0) != inside else chain, closed))
    return chains


def segments_of(shape: Surface, mirrored: bool) -> Outline:
    """The outline of a surface in the plane; mirrored: at the axis, so that it does not end there."""
    from .surfaces import Outline, right_of

    places, corners = read_surface(shape, 1)
    places = places[:, :2]
    if mirrored:
        places, corners = with_mirror(shape.file, places, corners)
    start: list[Floats] = []
    beside, sharp, ways, lengths = [], [], [], []
    for chain, closed in chains_of(shape.file, places, corners, shape.inside):
        nodes = places[chain]
        m, base = len(chain) - 1, len(start)
        step = np.diff(nodes, axis=0)
        length = np.linalg.norm(step, axis=1)
        way = step / length[:, None]
        for k in range(m):
            before, behind = ((k - 1) % m, (k + 1) % m) if closed else (k - 1, k + 1)
            beside.append([base + before if before >= 0 else -1, base + behind if behind < m else -1])
            if beside[-1][0] >= 0 and way[before, 0] * way[k, 1] - way[before, 1] * way[k, 0] > 1e-6:
                sharp.append(nodes[k])
        start += list(nodes[:-1])
        ways.append(way)
        lengths.append(length)
    way = np.concatenate(ways)
    corner = np.array(sharp).reshape(-1, 2)
    return Outline(np.array(start), way, np.concatenate(lengths), right_of(way), np.array(beside), corner)
