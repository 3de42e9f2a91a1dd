"""A mesh and a case as FreeFEM reads them.

`write_bodies` checks that the mesh is what the case needs, and writes the files of a run's folder. A MeshRefusal says
what is wrong. A part is what hangs together, also several bodies that share nodes.

- mesh.msh: first order, lengths a million times as large (FreeFEM takes elements below 1e-8 for degenerate), each
  element once and turned the right way, boundaries numbered as the case's groups, bodies by regions. What no group
  names is left out; in the plane it is numbered one more than the groups.
- middles: a line for each element of the boundary in mesh.msh's order: the place of its middle node, in space of three,
  each opposite a corner.
- curves, in the plane: the number of the geometry's curve of each element of the boundary.
- rises, in space: edges whose middle is known, and the way from the straight middle to it.
- notes: lines for the screen.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn

import numpy as np

from . import grammar as g
from .case import Case
from .groups import Group
from .mesh import Bools, Floats, Ints, Mesh, components, keys_of, mixed, refuse, table
from .simplices import cut_to_simplices
from .words import brief

BIG = 1e6  # as large as the user's lengths
ALLOWED = "; allowed: "


@dataclass
class Written:
    """What a run is told about its files.

    text: of the file regions; groups: by label, also those of split symmetries; split: of these the statement's.
    """

    text: str
    groups: list[Group]
    split: dict[int, int] = field(default_factory=dict)


@dataclass
class Elements:
    """All elements of one dimension in the file's order. label: of the case's group, 0: none; second: with middles."""

    corners: Ints
    middles: Ints
    second: Bools
    number: Ints
    line: Ints
    label: Ints
    entity: Ints

    def head(self, k: int) -> str:
        return f"element {self.number[k]} (line {self.line[k]}): "


def elements_of(mesh: Mesh, dimension: int, labels: dict[Group, int]) -> Elements:
    size = dimension + 1
    parts: list[list[Ints]] = [[] for _ in range(6)]
    for block in (block for block in mesh.blocks if block.of.dimension == dimension):
        own = np.zeros(len(block.nodes), np.int64)
        for tag in np.unique(block.group):
            own[block.group == tag] = labels.get(Group(dimension, mesh.names.get((dimension, int(tag)), "")), 0)
        middles = np.zeros((len(own), size * dimension // 2), np.int64)
        if block.of.second:
            middles = block.nodes[:, size:]
        second = np.full(len(own), block.of.second)
        nodes = np.column_stack([block.nodes[:, :size], middles, second])
        for part, values in zip(parts, (nodes, block.number, block.line, own, block.entity), strict=False):
            part.append(values)
    if not parts[0]:
        none = np.zeros(0, np.int64)
        return Elements(np.zeros((0, size), np.int64), np.zeros((0, 1), np.int64), none > 0, none, none, none, none)
    order = np.argsort(np.concatenate(parts[2]), kind="stable")
    nodes, number, line, label, entity = (np.concatenate(part)[order] for part in parts[:5])
    return Elements(nodes[:, :size], nodes[:, size:-1], nodes[:, -1] > 0, number, line, label, entity)


def first_refusal(*checks: tuple[Elements, Bools, Callable[[int], str]]) -> None:
    """The refusal that stands first in the file, of one element the first."""
    found = [(int(of.line[k]), rank, of.head(k) + what(int(k))) for rank, (of, wrong, what) in enumerate(checks)
             for k in np.flatnonzero(wrong)[:1]]  # fmt: skip
    if found:
        refuse(min(found)[2])


def missing(of: Elements, used: Bools) -> tuple[Elements, Bools, Callable[[int], str]]:
    nodes = np.column_stack([of.corners, np.where(of.second[:, None], of.middles, 0)])

    def what(k: int) -> str:
        return f"a node that is missing: {~nodes[k][nodes[k] < 0][0]}"

    return of, used & (nodes < 0).any(axis=1), what


def signed(x: Floats, corners: Ints) -> tuple[Floats, Floats]:
    """Of triangles twice the area, of tetrahedra six times the volume, with a sign; and the square of their reach."""
    edges = x[corners[:, 1:]] - x[corners[:, :1]]
    across = np.cross(edges[:, 0], edges[:, 1])
    size = across[:, 2] if corners.shape[1] == 3 else (across * edges[:, 2]).sum(axis=1)
    return size, (edges**2).sum(axis=2).max(axis=1)


def side_normals(x: Floats) -> Floats:
    """The unit normals of sides, either way, by their corners (sides x corners x 3)."""
    b = x[:, 1] - x[:, 0]
    normal = np.cross(b, x[:, 2] - x[:, 0]) if x.shape[1] == 3 else np.column_stack([b[:, 1], -b[:, 0], 0 * b[:, 0]])
    return np.asarray(normal / np.sqrt((normal**2).sum(axis=1))[:, None])


class Bodies:
    """The bodies and the boundary of a mesh, step by step as they are checked. Labels are those of the case."""

    def __init__(self, mesh: Mesh, case: Case, space: bool) -> None:
        self.mesh, self.case, self.space = mesh, case, space
        self.dim = 3 if space else 2
        self.body_kind, self.side_kind = ("tetrahedron", "triangle") if space else ("triangle", "edge")
        self.groups = case.used()
        self.x = mesh.places
        labels = {group: k + 1 for k, group in enumerate(self.groups)}
        self.label = labels
        self.solids = elements_of(mesh, self.dim, labels)
        self.sides = elements_of(mesh, self.dim - 1, labels)
        self.check_elements(elements_of(mesh, 3, labels) if not space else None)
        self.join()
        self.part()

    def name(self, label: int) -> str:
        return self.groups[label - 1].name

    def corner(self, p: int) -> str:
        """A place in the user's lengths."""
        return ", ".join(f"{c:.4g}" for c in self.x[p, : self.dim])

    def keys(self, corners: Ints) -> Ints:
        return keys_of(corners, len(self.x))

    # ------------------------------------------------------------ elements

    def check_elements(self, tetrahedra: Elements | None) -> None:
        """Each element is in a body, is there whole and has a size; afterwards they are turned one way."""
        solids, sides, kind = self.solids, self.sides, self.body_kind
        every = "volume" if self.space else "surface"
        c = np.maximum(solids.corners, 0)
        size, reach = signed(self.x, c)
        small = np.abs(size)
        flat = small <= 1e-10 * reach * (np.sqrt(reach) if self.space else 1)
        tiny = small * (1e18 / 6 if self.space else 0.5e12) < 1e-7
        checks: list[tuple[Elements, Bools, Callable[[int], str]]] = [
            (solids, solids.label == 0, lambda k: f"a {kind} in no body: allowed: every one in a physical {every}"),
            missing(solids, solids.label > 0),
            (solids, flat, lambda k: f"a {kind} without {'volume' if self.space else 'area'}"),
            (solids, tiny, lambda k: f"a {kind} too small: another unit of length helps"),
            missing(sides, (sides.label > 0) | (sides.entity != 0 if not self.space else False)),
        ]
        if tetrahedra:
            what = "a tetrahedron: allowed in the plane: triangles; edp/parts-3d.edp is for bodies in space"
            checks.append((tetrahedra, np.ones(len(tetrahedra.line), bool), lambda k: what))
        first_refusal(*checks)
        if not len(c):
            refuse(f"no {kind}s")
        c[:, 1:3] = np.where(size[:, None] < 0, c[:, 2:0:-1], c[:, 1:3])
        self.corners = c
        low, high = self.x[c].min(axis=(0, 1)), self.x[c].max(axis=(0, 1))
        self.low, self.size = low, float(high[0] - low[0] + high[1] - low[1] + high[2] - low[2])
        if (low < -1e9 * self.size).any() or (high > 1e9 * self.size).any():
            refuse("the bodies are too far from the origin for their size: their coordinates have no digits left")
        if not self.space and (high[2] > 1e-9 * self.size or low[2] < -1e-9 * self.size):
            refuse(f"z goes from {brief(low[2])} to {brief(high[2])}; a plane mesh has z = 0 everywhere")

    def join(self) -> None:
        """The sides of the elements: by place the first element that has it, and the corner of this that is across."""
        size = self.dim + 1
        faces = np.array([[k for k in range(size) if k != tip] for tip in range(size)])
        side = self.corners[:, faces].reshape(-1, self.dim)
        tip = self.corners.reshape(-1)
        keys = self.keys(side)
        order = np.argsort(keys, kind="stable")
        begin = np.flatnonzero(np.diff(keys[order], prepend=keys[order[0]] - 1))
        count = np.diff(begin, append=len(order))
        first = order[begin]
        second = order[begin[count > 1] + 1]
        both = (signed(self.x, np.column_stack([side[second], tip[k]]))[0] > 0 for k in (first[count > 1], second))
        wrong = np.equal(*both)
        found = [(int(k), int(j), 3) for k, j in zip(order[begin[count > 2] + 2], first[count > 2], strict=True)]
        found += [(int(k), int(j), 2) for k, j in zip(second[wrong], first[count > 1][wrong], strict=True)]
        if found:
            k, j, many = min(found)
            new, old = self.solids.number[k // size], self.solids.number[j // size]
            if many == 3:
                refuse(f"element {new} is the third that has a side of element {old}: they overlap")
            refuse(f"elements {old} and {new} lie on the same side of a common {self.side_kind}: they overlap")
        self.place_key, self.owner, self.inner = keys[first], first // size, count > 1
        self.face, self.tip, self.occurs = side[first], tip[first], first
        self.pairs = first[count > 1] // size, second // size

    def part(self) -> None:
        """What hangs together by sides, and the regions: a body in a part."""
        root = components(len(self.corners), *self.pairs)
        firsts, part = np.unique(root, return_inverse=True)  # a root is the first element of its part
        self.parts = len(firsts)
        label = self.solids.label
        known, begin, same = np.unique(part * (len(self.groups) + 1) + label, return_index=True, return_inverse=True)
        order = np.argsort(begin)
        rank = np.empty(len(known), np.int64)
        rank[order] = np.arange(len(known))
        self.region = rank[same] + 1
        self.regions = [(int(label[k]), int(part[k]) + 1) for k in begin[order]]
        nodes, parts = self.corners.reshape(-1), np.repeat(part, self.dim + 1)
        of = np.full(len(self.x), -1)
        of[nodes[::-1]] = parts[::-1]
        for k in np.flatnonzero(of[nodes] != parts)[:1]:
            hinge = "two pieces hang together by it alone, which is a hinge"
            own = f"a common {self.side_kind}, or nodes of their own"
            refuse(f"node {self.mesh.numbers[nodes[k]]}: {hinge}{ALLOWED}{own}")
        self.here = of >= 0

    # ------------------------------------------------------------ the boundary

    def find(self, corners: Ints) -> Ints:
        """Which places sides are, -1: none."""
        keys = self.keys(corners)
        at = np.minimum(np.searchsorted(self.place_key, keys), len(self.place_key) - 1)
        return np.where(self.place_key[at] == keys, at, -1)

    def check_sides(self) -> None:
        """Each side of a group is one of the boundary, those of a preload's are inside; each is there once."""
        label, number = self.sides.label, self.sides.number
        own = np.flatnonzero(label > 0)
        self.used_sides = len(own)
        place = self.find(self.sides.corners[own])
        cut = np.isin(label[own], [self.label[s.groups()[0][1]] for s in self.case.of(g.Preload)])
        inner = (place >= 0) & self.inner[place]
        cuts = Cuts(self)
        for k in np.flatnonzero((place < 0) | (inner != cut))[:1]:
            preload = "the preload " * int(cut[k] and place[k] >= 0)
            what = f'element {number[own[k]]}: {self.side_kind} of {preload}"{self.name(label[own[k]])}"'
            if place[k] < 0:
                refuse(f"{what} that no {self.body_kind} has")
            if cut[k]:
                through = "a cut through a body, whose elements on both sides share its nodes"
                refuse(f"{what} on the boundary{ALLOWED}{through}")
            nodes = "each body's own nodes where they touch (no Coherence, BooleanFragments there)"
            refuse(f"{what} inside the bodies, which share its nodes{ALLOWED}{nodes}")
        cuts.add(label[own[cut]], self.sides.corners[own[cut]])
        has = {*np.unique(label[own]).tolist(), *np.unique(self.solids.label).tolist(), *cuts.found}
        self.cut_nodes = cuts.nodes
        own, place = own[~cut], place[~cut]
        for s in self.case.of(g.Preload):
            self.check_ends(s, place, label[own])
        once = np.sort(np.unique(place, return_index=True)[1])
        self.group_at = np.zeros(len(self.place_key), np.int64)  # by place the first group there
        self.group_at[place[once]] = label[own[once]]
        self.merge(own, place)
        self.kept, self.kept_place = own[once], place[once]
        self.kept_label = np.array([0, *map(self.one, range(1, len(self.groups) + 1))])[label[self.kept]]
        self.kept_corners = self.sides.corners[self.kept]
        self.mirrors = Mirrors(self)
        for k, group in enumerate(self.groups[: len(self.label)]):
            if k + 1 not in has:
                what = self.body_kind if group.dimension == self.dim else self.side_kind
                refuse(f'the physical group "{group.name}" has no {what} of a body')

    def check_ends(self, s: g.Preload, place: Ints, label: Ints) -> None:
        """On both sides of a cut through a shank something has to take its force: a contact or a support.

        place, label: of the sides in groups. A cut that does not part its body, as one of a frame, closes its own path.
        """
        nodes = np.array([node for cut, node in self.cut_nodes if cut == self.label[s.on]])
        across = np.isin(self.face[self.inner], nodes).all(axis=1)
        root = components(len(self.corners), *(elements[~across] for elements in self.pairs))
        ends = np.unique(np.concatenate([root[elements[across]] for elements in self.pairs]))
        if (root[self.pairs[0][across]] == root[self.pairs[1][across]]).any():
            return
        takes = [self.label[group] for one in self.case.statements if isinstance(one, (g.Contact, g.Obstacle, g.Tie))
                 or one.holds() or isinstance(one, (g.Spring, g.Force, g.Moment))
                 for _, group in one.groups() if group in self.label]  # fmt: skip
        normal = side_normals(self.x[self.face[self.inner][across][:1]])[0]
        mirrors = [self.label[one.on] for one in self.case.of(g.Symmetry)]
        along = np.abs(side_normals(self.x[self.face[place]]) @ normal) < 0.1
        closing = np.isin(label, takes) & ~(np.isin(label, mirrors) & along)
        for end in ends[~np.isin(ends, root[self.owner[place[closing]]])][:1]:
            middle = self.x[self.corners[root == end]].mean(axis=(0, 1))[: self.dim]
            where = ", ".join(f"{c:.4g}" for c in middle)
            refuse(
                f'preload "{s.on.name}" of the case file, line {s.line}: the piece of the body about ({where}), '
                f"on one side of the cut, has no contact and no support that takes the force{ALLOWED}both ends of the "
                "shank in contacts, ties or supports"
            )

    def one(self, label: int) -> int:
        while label in self.same_as:
            label = self.same_as[label]
        return label

    def merge(self, own: Ints, place: Ints) -> None:
        """Groups that share sides become one, if only contacts use them and nothing else changes.

        All have the same sides, or all are masters: one with more sides than a contact needs is no other contact.
        """
        slaves, others, pairs = uses(self.case)
        label = self.sides.label
        here, first = label[own], self.group_at[place]
        self.same_as: dict[int, int] = {}
        total = {k: len(np.unique(place[here == k])) for k in np.unique(here).tolist()}
        shared: dict[tuple[int, int], list[int]] = {}
        for k in np.flatnonzero(here != first).tolist():
            shared.setdefault((min(first[k], here[k]), max(first[k], here[k])), []).append(int(own[k]))
        for (a, b), on in shared.items():
            same = len(on) == total[a] == total[b]
            one, other = self.groups[a - 1], self.groups[b - 1]
            if {one, other} & others or (not same and {one, other} & slaves):
                first_corner = self.corner(self.sides.corners[on[0], 0])
                refuse(
                    f"element {self.sides.number[on[0]]}: {self.side_kind} in two physical groups of the case, "
                    f'"{one.name}" and "{other.name}", which share {len(on)} of their {total[a]} and {total[b]}, '
                    f"this one at ({first_corner}){ALLOWED}one of them, or two that only contacts use, with the same "
                    "sides or as masters; group ... plane and box take the sides of all bodies there, near, between "
                    "and numbers those of one"
                )
            a, b = self.one(a), self.one(b)
            if a != b:
                self.same_as[max(a, b)] = min(a, b)
        seen: dict[tuple[int, int], int] = {}
        for s in pairs if self.same_as else ():
            what = f"contact of {s.slave} and {s.master} (line {s.line} of the case file): "
            one_, other_ = sorted((self.one(self.label[s.slave]), self.one(self.label[s.master])))
            if one_ == other_:
                refuse(f"{what}both are the same surface{ALLOWED}two surfaces")
            if (one_, other_) in seen:
                refuse(f"{what}the same surfaces as in line {seen[one_, other_]}{ALLOWED}once")
            seen[one_, other_] = s.line

    def check_cracks(self) -> None:
        """Two sides of one body in the same place, and no contact there: what is meant as one body would open."""
        touched = [self.label[group] for s in (*self.case.touching, *self.case.of(g.Tie)) for _, group in s.groups()]
        free = np.flatnonzero(~self.inner & ~np.isin(self.group_at, touched))
        free = free[np.argsort(self.occurs[free])]
        middle = (self.x[self.face[free]].sum(axis=1) / self.dim - self.low) / self.size
        body = self.solids.label[self.owner[free]]
        rows = np.column_stack([body, np.rint(middle * 1e9)])
        order = np.lexsort(rows.T)
        same = np.flatnonzero((rows[order[1:]] == rows[order[:-1]]).all(axis=1))
        for k, j in sorted(zip(order[same + 1], order[same], strict=True))[:1]:
            one, other = self.solids.number[self.owner[free[[j, k]]]]
            joined = "share no nodes: a crack, or pieces not joined (in gmsh: Coherence, BooleanFragments)"
            refuse(f'elements {one} and {other} of "{self.name(body[k])}" touch, but {joined}{ALLOWED}a contact there')

    def add_sides(self) -> None:
        """In the plane: the rest of the boundary, which no group of the case names."""
        around = self.corners[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        place = self.find(around)
        rest = ~self.inner[place] & (self.group_at[place] == 0)
        self.kept_corners = np.concatenate([self.kept_corners, around[rest]])
        self.kept_place = np.concatenate([self.kept_place, place[rest]])
        self.kept_label = np.concatenate([self.kept_label, np.full(int(rest.sum()), len(self.groups) + 1)])

    def last_at(self, of: Elements, ends: Ints, values: Ints) -> Ints:
        """In the plane, by place: the value of the last element that has it, -1: none."""
        place, found = self.find(ends), np.full(len(self.place_key), -1)
        found[place[place >= 0]] = values[place >= 0]
        return found

    def know_middles(self, straight: bool) -> tuple[int, Ints]:
        """How many sides have middles, and these nodes. straight: none where all sides are straight."""
        count = len(self.kept_corners)
        if self.space:
            middles = self.sides.middles[self.kept][:, [1, 2, 0]] if len(self.kept) else np.zeros((0, 3), np.int64)
            return (count if int(self.sides.second[self.sides.label > 0].sum()) == self.used_sides else 0), middles
        second = self.solids.second
        ends = self.solids.corners[second][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        middle = self.last_at(self.solids, ends, self.solids.middles[second].reshape(-1))[self.kept_place]
        own = np.full(count, -1)
        own[: len(self.kept)] = np.where(self.sides.second[self.kept], self.sides.middles[self.kept, 0], -1)
        middle = np.where(middle < 0, own, middle)
        if (middle < 0).any():
            return 0, middle[:, None]
        bends = bool(self.bends(self.kept_corners, middle).any())
        return (count if bends or not straight else 0), middle[:, None]

    def bends(self, ends: Ints, middle: Ints) -> Bools:
        """Whether the nodes in the middle of edges are off the straight line."""
        a, b = self.x[ends[..., 0]], self.x[ends[..., 1]]
        off = ((self.x[middle] - (a + b) / 2) ** 2)[..., : self.dim].sum(axis=-1)
        return off > 1e-16 * ((b - a) ** 2)[..., : self.dim].sum(axis=-1)

    # ------------------------------------------------------------ rises, in space

    def rises(self, surface: Mesh | None) -> tuple[Ints, Floats]:
        """Edges of the bodies, and the ways from their straight middles to the surface.

        Those of the boundary, and inside bodies those that are curved: between materials, or moved to keep elements
        from folding.
        """
        ends, at = [np.zeros((0, 2), np.int64)], [np.zeros((0, 3))]
        second = np.flatnonzero(self.solids.second)
        pairs = np.array(table("01 12 20 30 23 13"))
        edges, middles = self.solids.corners[:, pairs], self.solids.middles
        outer = np.flatnonzero(~self.inner)
        if len(second):
            own = self.owner[outer]
            on = (edges[own][..., None] == self.face[outer][:, None, None]).any(axis=3).all(axis=2)
            on &= self.solids.second[own][:, None]
            inside = edges[second]
            curved = self.bends(inside, middles[second])
            ends += [edges[own][on], inside[curved]]
            at += [self.x[middles[own][on]], self.x[middles[second][curved]]]
        if surface:
            around = self.face[outer][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
            row, middle = middles_on(surface, self.x, around)
            ends.append(around[row])
            at.append(surface.places[middle])
        all_ends, all_at = np.concatenate(ends), np.concatenate(at)
        once = np.sort(np.unique(self.keys(all_ends), return_index=True)[1])
        all_ends, all_at = all_ends[once], all_at[once]
        return all_ends, all_at - (self.x[all_ends[:, 0]] + self.x[all_ends[:, 1]]) / 2


def uses(case: Case) -> tuple[set[Group], set[Group], list[g.Contact | g.Tie]]:
    """The groups of contacts' slaves and of all other statements, and the contacts."""
    slaves: set[Group] = set()
    others: set[Group] = set()
    pairs: list[g.Contact | g.Tie] = []
    for s in case.statements:
        if s.changes is not None or isinstance(s, (g.Cut, g.PickedGroup, g.Size, g.Join)):
            continue
        if isinstance(s, (g.Contact, g.Tie, g.Obstacle)):
            slave = s.on if isinstance(s, g.Obstacle) else s.slave
            slaves.add(slave)
            if not isinstance(s, g.Obstacle):
                pairs.append(s)
            others |= {slave} if not isinstance(s, g.Tie) and s.wear else set()
        else:
            others |= {group for _, group in s.groups()}
    return slaves, others, pairs


def middles_on(surface: Mesh, x: Floats, edges: Ints) -> tuple[Ints, Ints]:
    """The rows of edges that a mesh of the same surfaces has too, and its nodes in their middles.

    gmsh may cut extruded quadrangles along the other diagonal: its middle is that of the one that is there.
    """
    blocks = [block for block in surface.blocks if block.kind == 9]
    if not blocks:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    nodes = np.concatenate([block.nodes for block in blocks])
    entity = np.repeat(np.concatenate([block.entity for block in blocks]), 3)
    place = same_places(np.concatenate([x, surface.places]))
    own = place[len(x) :]
    key = keys_of(own[nodes[:, [[0, 1], [1, 2], [2, 0]]]].reshape(-1, 2), len(place))
    tip, middle = own[nodes[:, [2, 0, 1]]].reshape(-1), nodes[:, 3:6].reshape(-1)
    order = np.lexsort((np.arange(len(key)), entity, key))
    pair = np.flatnonzero((key[order[1:]] == key[order[:-1]]) & (entity[order[1:]] == entity[order[:-1]]))
    one, other = order[pair], order[pair + 1]
    across = keys_of(np.column_stack([tip[one], tip[other]]), len(place))
    # the last one of an edge goes first, and the edges themselves before those across
    keys, middles = np.concatenate([across, key])[::-1], np.concatenate([middle[other], middle])[::-1]
    known, first = np.unique(keys, return_index=True)
    wanted = keys_of(place[edges], len(place))
    at = np.minimum(np.searchsorted(known, wanted), len(known) - 1)
    row = np.flatnonzero(known[at] == wanted)
    return row, middles[first[at[row]]]


def same_places(x: Floats) -> Ints:
    """By row the first one that is the same to the last digit."""
    key = np.zeros(len(x), np.int64)
    for component in (x + 0.0).T:  # no -0
        key = mixed(key ^ component.view(np.int64))
    _, first, same = np.unique(key, return_index=True, return_inverse=True)
    return first[same]


class Cuts:
    """The nodes of cuts: of the sides of a preload's group, and of those that lie in a plane the case cuts a body by.

    The plane goes through no element: a geometry is cut before it is meshed, a mesh has a layer of sides there.
    """

    def __init__(self, bodies: Bodies) -> None:
        self.bodies = bodies
        self.nodes: list[tuple[int, int]] = []
        self.found: set[int] = set()
        for s in bodies.case.of(g.Cut):
            self.cut(s, bodies.label[s.on])

    def add(self, labels: Ints, corners: Ints) -> None:
        pairs = zip(np.repeat(labels, corners.shape[1]).tolist(), corners.reshape(-1).tolist(), strict=True)
        self.nodes = list(dict.fromkeys([*self.nodes, *pairs]))

    def cut(self, s: g.Cut, label: int) -> None:
        of, near = self.bodies, 1e-7 * self.bodies.size
        normal = np.array(s.plane.normal)
        height = (of.x - s.plane.point)[:, : of.dim] @ (normal / np.sqrt((normal**2).sum()))[: of.dim]
        level = np.sign(height) * (np.abs(height) > near)
        own = of.solids.label == of.label[s.body]
        corners = of.corners[own]
        most, least = float(height[corners].max()), float(height[corners].min())
        start = f'cut "{s.on.name}" of the case file, line {s.line}: '
        if most <= near or least >= -near:
            lies = f"which lies from {least:.4g} to {most:.4g} along the normal from its point"
            refuse(f'{start}the plane does not cross "{s.body.name}", {lies}{ALLOWED}a point between')
        through = np.flatnonzero((level[corners] < 0).any(axis=1) & (level[corners] > 0).any(axis=1))
        if len(through):
            first = of.solids.number[own][through[0]]
            refuse(
                f"{start}the plane goes through {len(through)} elements, the first is {first}{ALLOWED}"
                "a geometry (STEP, BREP, .geo), which is cut before it is meshed, "
                "or a mesh that has sides of elements in the plane"
            )
        inside = of.inner & own[of.owner] & (level[of.face] == 0).all(axis=1)
        if not inside.any():
            refuse(f'{start}no two elements of "{s.body.name}" meet in the plane{ALLOWED}a plane through it')
        self.add(np.full(int(inside.sum()), label), of.face[inside])
        self.found.add(label)


class Mirrors:
    """Symmetries of several planes: each plane becomes a group of its own, "NAME 1", "NAME 2", ... by outward normals.

    Planes that meet turn by 45 degrees or more: less is a curved surface, which is refused.
    """

    def __init__(self, bodies: Bodies) -> None:
        self.of = bodies
        self.notes: list[str] = []
        self.split: dict[int, int] = {}
        self.flat: list[tuple[str, int, Ints, Floats]] = []  # split symmetries: name, line, sides, their normals
        lines = {bodies.label[s.on]: s.line for s in bodies.case.of(g.Symmetry)}
        labels = bodies.kept_label.copy()
        for label, line in sorted(lines.items()):
            own = np.flatnonzero(labels == label)
            if len(own):
                self.take(label, line, own)

    def refuse(self, name: str, line: int, why: str) -> NoReturn:
        refuse(f'symmetry "{name}" of the case file, line {line}: {why}')

    def bent(self, name: str, line: int, side: int, how: str) -> NoReturn:
        at = self.of.corner(self.of.kept_corners[side, 0])
        flat = "a flat group, or one in several planes that meet at 45 degrees or more"
        self.refuse(name, line, f"curved{how} at ({at}){ALLOWED}{flat}")

    def outward(self, sides: Ints) -> Floats:
        """The unit normals of sides, out of their bodies."""
        of, side = self.of, self.of.kept_corners[sides]
        normal = side_normals(of.x[side])
        inside = ((of.x[of.tip[of.kept_place[sides]]] - of.x[side[:, 0]]) * normal).sum(axis=1) > 0
        normal[inside] *= -1
        return normal

    def take(self, label: int, line: int, own: Ints) -> None:
        of, name = self.of, self.of.name(label)
        normal, at = self.outward(own), of.x[of.kept_corners[own, 0]]
        facing: list[Floats] = []
        plane = np.full(len(own), -1)
        while (plane < 0).any():
            k = int(np.argmax(plane < 0))
            off = ((at - at[k]) * normal).sum(axis=1) / of.size
            same = (plane < 0) & ((normal @ normal[k]) ** 2 > 1 - 1e-8) & (off * off < 1e-8)
            same[k] = True
            plane[same] = len(facing)
            facing.append(normal[k])
        if len(facing) < 2:
            return
        met: dict[tuple[int, ...], set[int]] = {}
        for k, corners in enumerate(of.kept_corners[own].tolist()):
            for j in range(of.dim):
                edge = tuple(sorted((corners[j], corners[(j + 1) % 3]))) if of.space else (corners[j],)
                others = met.setdefault(edge, set())
                for other in sorted(others - {int(plane[k])}):
                    c = float(normal[k] @ facing[other])
                    if c > 0.7072:
                        angle = np.degrees(np.arctan2(np.sqrt(max(1 - c * c, 0)), c))
                        self.bent(name, line, own[k], f", by {angle:.3g} degrees")
                others.add(int(plane[k]))
        self.spread(label, line, own, plane, facing)
        self.flat.append((name, line, own, normal))

    def spread(self, label: int, line: int, own: Ints, plane: Ints, facing: list[Floats]) -> None:
        """Each plane gets a group."""
        of, group = self.of, self.of.groups[label - 1]
        used = [s.line for s in of.case.statements if s.changes is None and not isinstance(s, (g.Symmetry, g.Cut))
                and group in (one for _, one in s.groups())]  # fmt: skip
        if used:
            several = f"in {len(facing)} planes, and line {used[-1]} uses this group too"
            self.refuse(group.name, line, f"{several}{ALLOWED}a group for each plane")
        order = sorted(range(len(facing)), key=lambda k: tuple(-np.round(facing[k], 6)))
        said = []
        for j, k in enumerate(order):
            new = Group(group.dimension, f"{group.name} {j + 1}")
            if j:
                of.groups.append(new)
                self.split[len(of.groups)] = label
            else:
                of.groups[label - 1] = new
            of.kept_label[own[plane == k]] = len(of.groups) if j else label
            normal = ", ".join(f"{0.0 if c * c < 1e-12 else c:.4g}" for c in facing[k][: of.dim])
            said.append(f"{new.name} with the normal ({normal})")
        planes = " and ".join([", ".join(said[:-1]), said[-1]])
        self.notes.append(f"symmetry {group.name} of line {line} is in {len(facing)} planes: {planes}")

    def check_bulges(self, middles: Ints, ends: Ints, rises: Floats) -> None:
        """No middle of an edge is off the plane."""
        of = self.of
        keys = of.keys(ends)
        order = np.argsort(keys)
        for name, line, own, normal in self.flat:
            for k in range(3 if of.space else 1):
                edge = of.kept_corners[own][:, [k, (k + 1) % 3]] if of.space else of.kept_corners[own]
                if of.space and len(keys):
                    wanted = of.keys(edge)
                    at = order[np.minimum(np.searchsorted(keys, wanted, sorter=order), len(keys) - 1)]
                    way = np.where((keys[at] == wanted)[:, None], rises[at], 0)
                elif not of.space and len(middles):
                    known = middles[own, 0] >= 0
                    way = np.where(known[:, None], of.x[middles[own, 0]] - of.x[edge[:, 0]], 0)
                else:
                    continue
                long = ((of.x[edge[:, 0]] - of.x[edge[:, 1]])[:, : of.dim] ** 2).sum(axis=1)
                for row in np.flatnonzero((way * normal).sum(axis=1) ** 2 > 1e-6 * long)[:1]:
                    self.bent(name, line, int(own[row]), "")


# ---------------------------------------------------------------- files


def lines_of(form: str, *columns: Ints | Floats) -> str:
    """Rows of numbers as lines; form: % for each."""
    rows = np.column_stack(columns)
    return (form + "\n") * len(rows) % tuple(rows.reshape(-1).tolist())


def texts_of(called: str, texts: list[str]) -> str:
    """An array of texts as VTK's XML has it: the numbers of their letters."""
    if not texts:
        return ""
    letters = "".join("".join(f"{c} " for c in text.encode(errors="surrogateescape")) + "0 " for text in texts)
    head = f'<Array type="String" Name="{called}" NumberOfTuples="{len(texts)}" format="ascii">'
    return f"{head}{letters}</Array>"


@np.errstate(all="ignore")  # places up to 1e150
def write_bodies(
    mesh: Mesh, case: Case, folder: Path, space: bool, straight: bool = False, surface: Mesh | None = None
) -> Written:
    """Checks the mesh and writes the files of the folder.

    straight: of straight bodies in the plane no middles; surface: gmsh's mesh of the same surfaces, of second order.
    """
    of = Bodies(cut_to_simplices(mesh), case, space)
    of.check_sides()
    of.check_cracks()
    if not space:
        of.add_sides()
    known, middles = of.know_middles(straight)
    ends, ways = of.rises(surface) if space else (np.zeros((0, 2), np.int64), np.zeros((0, 3)))
    of.mirrors.check_bulges(middles, ends, ways)
    now: Ints = np.cumsum(of.here, dtype=np.int64)
    x = of.x[of.here] * BIG
    if not space:
        x[:, 2] = 0
    place = "%.17g %.17g %.17g"
    nodes = lines_of(f"%d {place}", np.arange(1, len(x) + 1), x)
    count = len(of.kept_corners)
    kinds = (2, 4) if space else (1, 2)
    numbers = np.arange(1, count + len(of.corners) + 1)
    sides = numbers[:count], of.kept_label, of.kept_label, now[of.kept_corners]
    solids = numbers[count:], of.region, of.region, now[of.corners]
    width = " %d" * of.dim
    with (folder / "mesh.msh").open("w", encoding="ascii") as file:
        file.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(x)}\n{nodes}$EndNodes\n")
        file.write(f"$Elements\n{len(numbers)}\n")
        file.write(lines_of(f"%d {kinds[0]} 2 %d %d{width}", *sides))
        file.write(lines_of(f"%d {kinds[1]} 2 %d %d %d{width}", *solids) + "$EndElements\n")
    if known:
        at = of.x[middles] * BIG
        if not space:
            at[..., 2] = 0
        (folder / "middles").write_text(lines_of(" ".join([place] * middles.shape[1]), at.reshape(known, -1)))
    if space:
        rows = lines_of(f"%d %d {place}", now[ends] - 1, ways * BIG)
        (folder / "rises").write_text(f"{len(ends)}\n{rows}")
    else:
        curved = of.sides.entity != 0
        curve = of.last_at(of.sides, of.sides.corners[curved], of.sides.entity[curved])[of.kept_place]
        (folder / "curves").write_text(lines_of("%d", np.maximum(curve, 0)))
    notes = of.mirrors.notes
    (folder / "notes").write_text("\n".join([str(len(notes)), *notes, ""]), errors="surrogateescape")
    inside = [f"{k + 1} {of.name(label)}" for k, (label, _) in enumerate(of.regions)]
    outside = [f"{k + 1} {group.name}" for k, group in enumerate(of.groups) if group.dimension < of.dim]
    units = [] if case.units == "none" else case.units.split(" ", 1)
    arrays = texts_of("units", units) + texts_of("bodies", inside) + texts_of("groups", outside)
    text = [f"named <FieldData>{arrays}</FieldData>", f"regions {len(of.regions)}"]
    text += [f"{label} {part}" for label, part in of.regions]
    text += [f"parts {of.parts}", f"middles {known}", f"same {len(of.same_as)}"]
    text += [f"{label} {of.one(label)}" for label in sorted(of.same_as)]
    text += [f"cuts {len(of.cut_nodes)}", *(f"{label} {now[node] - 1}" for label, node in of.cut_nodes)]
    return Written("\n".join(text) + "\n", of.groups, of.mirrors.split)
