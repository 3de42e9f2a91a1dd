"""Quadrangles, bricks, prisms and pyramids of a mesh, cut into triangles and tetrahedra.

Every quadrangle is cut from its node with the lowest number, whatever it is a side of, so neighbours fit. A solid is
the cone from its lowest node over the sides that do not have it. Elements of second order keep the middles of their
edges. The middle of a diagonal is where the element's own quadratic map has the middle of that side, or of the solid: a
node, or by the shape functions of 8 and 20 nodes.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .mesh import CENTRES, EDGES, Block, Floats, Ints, Mesh, MeshRefusal, keys_of, table

# sides by their corners, the same way round as gmsh's
AROUND = {
    (2, 4): "0123",
    (3, 8): "0123 4567 0154 1265 2376 3047",
    (3, 6): "012 345 0143 1254 2035",
    (3, 5): "0123 014 124 234 304",
}
SIMPLEX = {2: (2, 9), 3: (4, 11)}


def cut_to_simplices(mesh: Mesh) -> Mesh:
    """The mesh of triangles and tetrahedra; what is one already stays."""
    kept = [block for block in mesh.blocks if block.of[:2] not in AROUND]
    whole = [block for block in mesh.blocks if block.of[:2] in AROUND]
    if not whole:
        return mesh
    for block in whole:
        for k, j in np.argwhere(block.nodes < 0)[:1]:
            raise MeshRefusal(f"{block.head(k)}a node that is missing: {~block.nodes[k, j]}")
    made = replace(mesh, blocks=kept)
    between = middles(made, whole)
    made.blocks = kept + [cut(made, block, middle) for block, middle in zip(whole, between, strict=True)]
    return made


def cut(mesh: Mesh, block: Block, middle: Ints) -> Block:
    """The triangles or tetrahedra of a block. middle: (elements, corners, corners)."""
    kind = block.of
    numbers = mesh.numbers[block.nodes[:, : kind.corners]]
    low = numbers.argmin(axis=1)
    rows: list[Ints] = []
    corners: list[Ints] = []
    for side in map(np.array, table(AROUND[kind[:2]])):
        own = np.flatnonzero((low[:, None] != side).all(axis=1) | (kind.dimension == 2))
        first = numbers[own][:, side].argmin(axis=1)
        turned = side[(first[:, None] + np.arange(4)) % 4] if len(side) == 4 else np.tile(side, (len(own), 1))
        for piece in ((0, 1, 2), (0, 2, 3))[: len(side) - 2]:
            of_side = turned[:, piece]
            rows.append(own)
            corners.append(of_side if kind.dimension == 2 else np.column_stack([low[own], of_side]))
    row, at = np.concatenate(rows), np.concatenate(corners)
    order = np.argsort(row, kind="stable")
    row, at = row[order], at[order]
    nodes = np.take_along_axis(block.nodes[row], at, axis=1)
    if kind.second:
        edges = table(EDGES[kind.dimension, kind.dimension + 1])
        nodes = np.column_stack([nodes, *(middle[row, at[:, a], at[:, b]] for a, b in edges)])
    return block.take(row, SIMPLEX[kind.dimension][kind.second], nodes)


def middles(mesh: Mesh, blocks: list[Block]) -> list[Ints]:
    """Of each block of second order the node between any two corners; those of diagonals become nodes of the mesh."""
    found, keys, places = [], [np.zeros(0, np.int64)], [np.zeros((0, 3))]
    fill: list[tuple[Ints, int, int, slice]] = []
    count = 0
    for block in blocks:
        kind, size = block.of, block.of.corners
        middle = np.full((len(block.nodes), size, size), -1)
        found.append(middle)
        if not kind.second:
            continue
        edges = table(EDGES[kind[:2]])
        for k, (a, b) in enumerate(edges):
            middle[:, a, b] = middle[:, b, a] = block.nodes[:, size + k]
        for name in AROUND[kind[:2]].split():
            side = [int(c) for c in name]
            if len(side) == 3:
                continue
            if node := CENTRES.get(block.kind, {}).get(name):
                for a, b in (side[::2], side[1::2]):
                    middle[:, a, b] = middle[:, b, a] = block.nodes[:, node]
                continue
            around = [middle[:, side[k], side[k - 1]] for k in range(4)]
            at = -mesh.places[block.nodes[:, side]].sum(axis=1) / 4 + sum(mesh.places[m] for m in around) / 2
            places.append(at)
            # the side's diagonal from its lowest node names it
            numbers = mesh.numbers[block.nodes[:, side]]
            low = numbers.argmin(axis=1)
            ends = np.take_along_axis(block.nodes[:, side], np.stack([low, (low + 2) % 4], axis=1), axis=1)
            keys.append(keys_of(ends, len(mesh.places)))
            for a, b in (side[::2], side[1::2]):
                fill.append((middle, a, b, slice(count, count + len(at))))
            count += len(at)
    _, first, same = np.unique(np.concatenate(keys), return_index=True, return_inverse=True)
    added = [np.concatenate(places)[first]]
    total = len(mesh.places) + len(first)
    for middle, a, b, part in fill:
        middle[:, a, b] = middle[:, b, a] = len(mesh.places) + same[part]
    for block, middle in zip(blocks, found, strict=True):
        if block.of.second and block.of.corners == 8:
            centre, at = centres(mesh, block, total)
            added.append(at)
            total += len(at)
            for a, b in ((0, 6), (1, 7), (2, 4), (3, 5)):
                middle[:, a, b] = middle[:, b, a] = centre
    mesh.places = np.concatenate([mesh.places, *added])
    last = int(mesh.numbers.max(initial=0))
    mesh.numbers = np.concatenate([mesh.numbers, np.arange(last + 1, last + 1 + total - len(mesh.numbers))])
    return found


def centres(mesh: Mesh, block: Block, total: int) -> tuple[Ints, Floats]:
    """Of bricks the node in the middle, and the places of those that are new."""
    if block.kind == 12:
        return block.nodes[:, 26], np.zeros((0, 3))
    at = (mesh.places[block.nodes[:, 8:20]].sum(axis=1) - mesh.places[block.nodes[:, :8]].sum(axis=1)) / 4
    return total + np.arange(len(at)), at
