"""A mesh as it stands in a file, whatever its format: places of nodes, elements by kind, names of groups.

`groups_of` names the groups for the reader of cases; `sides_of` has the sides of elements; a MeshRefusal says what is
wrong with a mesh, in one line.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple, NoReturn

import numpy as np
import numpy.typing as npt

from .groups import Group
from .names import EVERY_CURVE
from .words import CONTROL, LONGEST

Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]
Floats = npt.NDArray[np.float64]


class Kind(NamedTuple):
    """A kind of element, as gmsh numbers it: its dimension, corners and nodes: corners, edges, sides, centre."""

    dimension: int
    corners: int
    nodes: int

    @property
    def second(self) -> bool:
        return self.nodes > self.corners


KINDS = {1: Kind(1, 2, 2), 2: Kind(2, 3, 3), 3: Kind(2, 4, 4), 4: Kind(3, 4, 4), 5: Kind(3, 8, 8), 6: Kind(3, 6, 6)}
KINDS |= {7: Kind(3, 5, 5), 8: Kind(1, 2, 3), 9: Kind(2, 3, 6), 10: Kind(2, 4, 9), 11: Kind(3, 4, 10)}
KINDS |= {12: Kind(3, 8, 27), 13: Kind(3, 6, 18), 14: Kind(3, 5, 14), 15: Kind(0, 1, 1), 16: Kind(2, 4, 8)}
KINDS |= {17: Kind(3, 8, 20), 18: Kind(3, 6, 15), 19: Kind(3, 5, 13)}
# by dimension and corners: between which corners the middles of edges lie, in gmsh's order
EDGES = {
    (1, 2): "01",
    (2, 3): "01 12 20",
    (2, 4): "01 12 23 30",
    (3, 4): "01 12 20 30 23 13",
    (3, 8): "01 03 04 12 15 23 26 37 45 47 56 67",
    (3, 6): "01 02 03 12 14 25 34 35 45",
    (3, 5): "01 03 04 12 14 23 24 34",
}
# the sides by their corners; of solids in the order of Abaqus, S1 ... S6
SIDES = {
    (2, 3): "01 12 20",
    (2, 4): "01 12 23 30",
    (3, 4): "012 031 132 230",
    (3, 8): "0123 4765 0451 1562 2673 3740",
    (3, 6): "012 354 0341 1452 2530",
    (3, 5): "0123 041 142 243 340",
}
# nodes in the middle of sides
CENTRES = {10: {"0123": 8}, 13: {"0143": 15, "2035": 16, "1254": 17}, 14: {"0123": 13}}
CENTRES |= {12: {"0123": 20, "0154": 21, "3047": 22, "1265": 23, "2376": 24, "4567": 25}}


def table(text: str) -> list[list[int]]:
    return [[int(digit) for digit in word] for word in text.split()]


class MeshRefusal(Exception):
    """What is wrong with a mesh, in one line; the run adds what is allowed where it says nothing about that."""

    def __init__(self, what: str) -> None:
        super().__init__(CONTROL.sub(" ", what)[:LONGEST])


def refuse(what: str) -> NoReturn:
    raise MeshRefusal(what)


@dataclass
class Block:
    """Elements of one kind. line: their order in the file; group, entity: gmsh's first two tags, 0 where there is none.

    nodes: (elements, nodes) rows of the mesh's places; of a node that is missing ~number.
    """

    kind: int
    nodes: Ints
    number: Ints
    line: Ints
    group: Ints
    entity: Ints

    @property
    def of(self) -> Kind:
        return KINDS[self.kind]

    def head(self, k: int) -> str:
        """How a refusal begins."""
        return f"element {self.number[k]} (line {self.line[k]}): "

    def take(self, rows: Ints, kind: int, nodes: Ints) -> Block:
        """Elements that are parts of these."""
        return Block(kind, nodes, self.number[rows], self.line[rows], self.group[rows], self.entity[rows])


@dataclass
class Mesh:
    """A mesh. places: (nodes, 3); numbers: of the nodes in the file; names: of groups, by dimension and tag."""

    places: Floats
    numbers: Ints
    blocks: list[Block]
    names: dict[tuple[int, int], str] = field(default_factory=dict)

    def dimension(self) -> int:
        return max((block.of.dimension for block in self.blocks), default=0)

    def group(self, dimension: int, name: str) -> int:
        """The tag of a group, a new one if there is none of this name."""
        for (d, tag), known in self.names.items():
            if (d, known) == (dimension, name):
                return tag
        tag = max((tag for d, tag in self.names if d == dimension), default=0) + 1
        self.names[dimension, tag] = name
        return tag


def groups_of(mesh: Mesh, space: bool, some: bool = True) -> list[Group]:
    """The groups that a case may name, in the order of the file; some: one at least."""
    if space and mesh.dimension() < 3:
        raise MeshRefusal("the mesh is plane, it has no volumes: use edp/parts.edp")
    named = [(d, name) for (d, _), name in mesh.names.items() if EVERY_CURVE not in name]
    if some and not named:
        raise MeshRefusal("no physical groups: bodies and boundaries have no names")
    if any(CONTROL.search(name) for _, name in named):
        raise MeshRefusal("a control character in a group's name; allowed: other names")
    return [Group(d, name) for d, name in named]


def rows_of(numbers: Ints, wanted: Ints) -> Ints:
    """By number of a node its row; of one that is missing ~number."""
    if not len(numbers):
        return ~wanted
    if numbers[0] == 1 and numbers[-1] == len(numbers) and bool((np.diff(numbers) == 1).all()):
        return np.where((wanted >= 1) & (wanted <= len(numbers)), wanted - 1, ~wanted)
    order = np.argsort(numbers, kind="stable")
    at = np.minimum(np.searchsorted(numbers, wanted, sorter=order), len(numbers) - 1)
    return np.where(numbers[order[at]] == wanted, order[at], ~wanted)


def keys_of(corners: Ints, count: int) -> Ints:
    """A number for each side by its corners, whatever their order; count: of all nodes. Three of a quadrangle's do."""
    ordered = np.sort(corners, axis=1)[:, :3].T
    key = np.zeros(len(corners), np.int64)
    for nodes in ordered:
        key = key * count + nodes if count < 2**21 else mixed(key ^ nodes)
    return ~key if corners.shape[1] == 4 else key


def mixed(key: Ints) -> Ints:
    """Numbers of 62 bits, as good as never the same (splitmix64)."""
    h = key.astype(np.uint64) + np.uint64(0x9E3779B97F4A7C15)
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB), (31, 1)):
        h = (h ^ (h >> np.uint64(shift))) * np.uint64(factor)
    return (h >> np.uint64(2)).astype(np.int64)


@dataclass
class Side:
    """The sides of one number of a block's elements. nodes: corners first; key: one for each place."""

    block: Block
    number: int  # from 1 on
    kind: int
    nodes: Ints
    key: Ints

    def rows(self, chosen: Ints, line: Ints, group: int) -> Block:
        """Some of them as elements of a group."""
        same = np.full(len(chosen), group)
        return Block(self.kind, self.nodes[chosen], self.block.number[chosen], line, same, same)


def columns_of_sides(kind: int) -> list[list[int]]:
    """By side: where its nodes stand in the element, corners first, in the order of gmsh's kinds."""
    of = KINDS[kind]
    edges = ["".join(sorted(edge)) for edge in EDGES[of[:2]].split()]
    found = []
    for side in SIDES[of[:2]].split():
        columns = [int(corner) for corner in side]
        if of.second:
            around = zip(side, side[1:] + side[0], strict=True) if len(side) > 2 else [(side[0], side[1])]
            columns += [of.corners + edges.index("".join(sorted(edge))) for edge in around]
            columns += [node for name, node in CENTRES.get(kind, {}).items() if set(name) == set(side)]
        found.append(columns)
    return found


def sides_of(mesh: Mesh, blocks: list[Block]) -> list[Side]:
    """All sides of all elements, block by block."""
    kinds = {(of.dimension, of.corners, of.nodes): kind for kind, of in KINDS.items()}
    found = []
    for block in blocks:
        for k, columns in enumerate(columns_of_sides(block.kind)):
            corners = len(SIDES[block.of[:2]].split()[k])
            nodes = block.nodes[:, columns]
            kind = kinds[block.of.dimension - 1, corners, len(columns)]
            found.append(Side(block, k + 1, kind, nodes, keys_of(nodes[:, :corners], len(mesh.places))))
    return found


def alone(sides: list[Side]) -> list[Bools]:
    """Of each side: whether it bounds one element only."""
    keys = np.concatenate([side.key for side in sides])
    _, same, count = np.unique(keys, return_inverse=True, return_counts=True)
    return np.split(count[same] == 1, np.cumsum([len(side.key) for side in sides])[:-1])


def components(count: int, one: Ints, other: Ints) -> Ints:
    """By element the first one that it hangs together with, by pairs of neighbours (Shiloach and Vishkin, 1982)."""
    root = np.arange(count)
    while len(one):
        a, b = root[one], root[other]
        apart = a != b
        one, other, a, b = one[apart], other[apart], a[apart], b[apart]
        root[np.maximum(a, b)] = np.minimum(a, b)
        while (root[root] != root).any():
            root = root[root]
    return root
