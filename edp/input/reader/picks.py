"""What a case picks of a geometry: groups, cuts and joined bodies, sizes, and where bodies touch.

`Picks(made, case, cad)` holds the outline of a geometry (geometry.py) and its groups by numbers, `members`. `choose()`
finds the groups that the case names, and returns bodies that must be taken apart before that is possible.
`operations()` are the cuts and joins, which gmsh makes; `after(before, own)` finds all groups again behind them.
`sizes()` are the sizes of elements. What cannot be is a Refusal. mesher.py calls these in their order.
What is decided here is which numbers are meant; shapes are gmsh's, and its outline is as near to them as pieces of
second order are. "near" and "between" compare places of these, "box" and "plane" all nodes of a face.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property
from itertools import combinations
from typing import Any, NoReturn

import numpy as np

from . import grammar as g
from .case import Case
from .geometry import Array, Face, Outline, faces, table, triple
from .groups import Group
from .near import PAIRS, Numbers, Shape, Store, first_of_cell
from .neighbours import Touching, by_face, distances, normals, statements, touching
from .rigid.shapes import has_edges
from .rigid.surfaces import surface_of
from .sides import lies_in
from .words import Refusal, quoted

Wish = tuple[int, int, str, Any]  # a group: its line, dimension, name, and what it is picked by
EXACT = "{:.9g}".format  # gmsh has its places and sizes with nine digits


def unique(numbers: Iterable[int]) -> list[int]:
    return list(dict.fromkeys(int(number) for number in numbers))


def words(numbers: Iterable[int]) -> str:
    return " ".join(map(str, numbers))


HOW = {g.Box: "box", g.InPlane: "plane", g.Near: "near", g.OnCylinder: "cylinder", g.Between: "between"}


class Picks:
    """The groups of a geometry by numbers, and what a case does with them."""

    def __init__(self, made: Outline, case: Case, cad: bool = False, called: dict[int, int] | None = None) -> None:
        self.made, self.case, self.cad = made, case, cad
        self.called = called or {}  # numbers of bodies that have been taken apart
        self.dimension = 3 if made.space else 2
        self.members = {key: list(own) for key, own in made.groups.items()}
        self.lies: dict[tuple[str, str], bool] = {}
        self.origin: dict[int, int] = {}  # behind cuts and joins: by face its number before them, minus one of a cut
        self.parent: dict[int, int] = {}  # behind them: by body its number before
        self.joined: set[frozenset[int]] = set()
        self.cut_faces: dict[int, int] = {}  # by face between pieces of a body: this body

    @cached_property
    def labels(self) -> dict[int, str]:
        """By body the name of its part in the file."""
        return {self.called.get(body, body): name for name, body in self.case.groups.labels.items()}

    @cached_property
    def store(self) -> Store:
        return Store(self.made.pieces)

    @cached_property
    def diagonal(self) -> float:
        return self.made.diagonal

    @cached_property
    def faces(self) -> list[Face]:
        return faces(self.made)

    @cached_property
    def touching(self) -> Touching:
        return touching(self.made, self.faces)

    def renew(self, made: Outline) -> None:
        """Another outline of the same faces."""
        self.made = made
        for name in ("store", "faces", "touching"):
            self.__dict__.pop(name, None)

    def no(self, line: int, what: str) -> NoReturn:
        raise Refusal(what, line)

    def entities(self, dimension: int) -> list[int]:
        return list(self.made.bodies) if dimension == self.dimension else self.made.entities

    def many(self, dimension: int) -> str:
        return self.case.where.many(dimension)

    def around(self, bodies: Iterable[int]) -> list[int]:
        """The faces of bodies."""
        return [face for body in bodies for face in self.made.bodies[body]]

    def of(self, dimension: int, name: str) -> list[int]:
        return self.members.get((dimension, name), [])

    def listed(self, dimension: int) -> str:
        own = self.entities(dimension)
        return " ".join(map(str, own if len(own) <= 20 else (own[0], "...", own[-1]))) or "none"

    def named(self, body: int) -> str:
        """The name of a body in the case, or nothing."""
        found = [name for (d, name), own in self.members.items() if d == self.dimension and own == [body]]
        return found[-1] if found else self.labels.get(self.parent.get(body, body), "")

    # ------------------------------------------------------------ groups

    def wishes(self) -> list[Wish]:
        """The groups that the case picks, in its order; a join that is no part picks the faces of each on the other."""
        case, dimension = self.case, self.dimension
        found: list[Wish] = []
        if case.groups.only_body:
            found.append((0, dimension, case.groups.only_body, g.BodyNumbers(numbers=tuple(self.made.bodies))))
        for name, body in case.groups.labels.items():
            if Group(dimension, name) in case.groups.all:
                found.append((0, dimension, name, g.BodyNumbers(numbers=(body,))))
        for s in case.statements:
            if isinstance(s, g.PickedGroup):
                found.append((s.line, case.groups.picked[s.name], s.name, s.pick))
            elif isinstance(s, g.Join) and s.how != "part":
                for a, b in ((s.one, s.other), (s.other, s.one)):
                    found.append((s.line, dimension - 1, f"{a.name}-{b.name}", g.Between(one=a, other=b)))
        return found

    def choose(self) -> list[int]:
        """Finds the groups that the case picks; bodies that must be taken apart first, for they share a face."""
        apart: dict[int, None] = {}
        wishes = self.wishes()
        # bodies first: "between" asks for them
        for line, dimension, name, pick in sorted(wishes, key=lambda wish: isinstance(wish[3], g.Between)):
            if isinstance(pick, g.Between):
                one, other = (self.of(self.dimension, side.name) for side in (pick.one, pick.other))
                if not self.around(one) or not self.around(other):
                    nothing = "the file does not say which faces are a body's; allowed: with a geometry"
                    self.no(line, f"{quoted(name)}: between: {nothing}")
                self.share(one, other, apart)
                found = [] if apart else self.between(one, other, (pick.one.name, pick.other.name))
                if apart:
                    continue
            else:
                found = self.picked(line, dimension, pick)
            if not found:
                how = HOW[type(pick)] if self.made.space or not isinstance(pick, g.OnCylinder) else "circle"
                what = "body" if dimension == self.dimension else "face" if self.made.space else "curve"
                there = f"allowed: one or more, of {self.listed(dimension)}"
                self.no(line, f"{quoted(name)}: {how}: no {what} lies there; {there}")
            self.members[dimension, name] = found
        return list(apart)

    def picked(self, line: int, dimension: int, pick: Any) -> list[int]:
        """The numbers that are picked by number or by place."""
        if isinstance(pick, g.Near):
            return self.nearest(line, dimension, np.array(pick.point))
        if isinstance(pick, (g.BodyNumbers, g.BoundaryNumbers)):
            bodies = dimension == self.dimension
            found = [self.called.get(number, number) if bodies else number for number in pick.numbers]
            for number in found:
                if number not in self.entities(dimension):
                    there = self.listed(dimension)
                    self.no(line, f"{number}: no such number of {self.many(dimension)}; allowed: {there}")
            return found
        if isinstance(pick, g.ElementSides):
            self.no(line, "elements: a geometry has none yet; allowed: with a mesh, here plane, box, near")
        return [n for n in self.entities(dimension) if self.within(self.faces_of(dimension, n), pick)]

    def faces_of(self, dimension: int, number: int) -> list[int]:
        return self.made.bodies[number] if dimension == self.dimension else [number]

    def within(self, own: Sequence[int], pick: Any) -> bool:
        """Whether all corners and middles of faces lie there."""
        nodes = [self.made.pieces[face].reshape(-1, 3) for face in own if face in self.made.pieces]
        if not nodes:
            return False
        near = 1e-6 * self.diagonal
        return bool(lies_in(np.concatenate(nodes), pick, near, near).all())

    def nearest(self, line: int, dimension: int, place: Array) -> list[int]:
        """What is nearest to a place; refused if another is as near, to what pieces leave of a curved surface."""
        store, own = self.store, self.entities(dimension)
        pieces = [store.of(self.faces_of(dimension, number)) for number in own]
        at, of = np.repeat(np.arange(len(own)), [len(p) for p in pieces]), np.concatenate([*pieces, np.zeros(0, int)])
        if not len(of):
            return []
        of = of.astype(int)
        off = np.linalg.norm(store.centre[of] - place, axis=1)
        kept = off - store.reach[of] <= off.min() + 1e-3 * self.diagonal
        places = np.tile(place, (len(own), 1))
        least, piece = store.closest(places, at[kept], of[kept], np.full(len(own), np.inf), 1e-6 * self.diagonal)
        first = int(np.argmin(least))
        slack = 1e-6 * self.diagonal + np.where(store.bow[piece] > 0, 1e-4 * store.reach[piece], 0)
        near = [k for k in range(len(own)) if k == first or least[k] < least[first] + slack[first] + slack[k]]
        if len(near) > 1:
            near.sort(key=lambda k: k != first)
            sides = self.made.sides if dimension < self.dimension else {}
            called = [f"{own[k]} of body {sides[own[k]][0]}" if sides.get(own[k]) else str(own[k]) for k in near]
            many, at_place = self.many(dimension), " ".join(f"{x:.6g}" for x in place[: self.dimension])
            allowed = f"a place nearer to one of them, {many} and its number"
            allowed += ", between BODY BODY" if dimension < self.dimension else ""
            self.no(line, f"near {at_place}: the {many} {' and '.join(called)} are equally near; allowed: {allowed}")
        return [own[first]]

    def share(self, one: Sequence[int], other: Sequence[int], apart: dict[int, None]) -> None:
        """Bodies that "between" names, and that share faces: the second of each pair gets its own."""
        for sides in self.made.sides.values():
            for p, q in combinations(sides, 2):
                both = (p in one and q in other) or (q in one and p in other)
                if both and p not in apart and q not in apart:
                    apart[q if q in other else p] = None

    def between(self, one: Sequence[int], other: Sequence[int], names: tuple[str, str]) -> list[int]:
        """The faces of bodies that lie on others; where none does, the nearest: by the middles of their pieces."""
        store = self.store
        a, b = store.of(self.around(one)), store.of(self.around(other))
        if not len(a) or not len(b):
            return []
        # bodies that touch do so where their boxes meet; what is not near there need not be looked at
        widest = 1e-4 * self.diagonal + 1.2 * float(store.bow[a].max() + store.bow[b].max())
        touching = a[store.within(a, b, widest)]
        found: list[int] = []
        for face in unique(store.face[touching]):
            own = touching[store.face[touching] == face]
            found += self.facing(own, b[store.within(b, own, widest)], True)
        if found:
            self.lies[names] = True
            return found
        self.lies[names] = False
        return self.facing(a, b, False)

    def facing(self, a: Numbers, b: Numbers, touching: bool) -> list[int]:
        """The faces of pieces a that lie on pieces b, or are nearest to them, and look at them within 45 degrees."""
        store = self.store
        if not len(b):
            return []
        best, there = nearest_pieces(store, a, b)
        alike = ((normals(store.nodes[a]) * normals(store.nodes[there])).sum(1)) ** 2 > 0.5
        off = np.where(alike, best, np.inf)
        play = 1e-4 * self.diagonal + 1.2 * (store.bow[a] + store.bow[there])
        return unique(store.face[a[off < (0 if touching else off.min() + 1e-3 * self.diagonal) + play]])

    # ------------------------------------------------------------ bodies that touch

    def check_ties(self) -> None:
        for s in self.case.of(g.Join):
            if s.how == "tie" and not self.lies.get((s.one.name, s.other.name)):
                nothing = "they touch nowhere, there is a gap between them"
                allowed = "bodies that touch, a contact, or tie SLAVE MASTER with groups of your own"
                self.no(s.line, f"join {s.one} {s.other} tie: {nothing}; allowed: {allowed}")

    def stated(self, a: int, b: int, f: int, h: int) -> bool:
        """Whether the case says what happens between these faces of these bodies."""
        top, low = self.dimension, self.dimension - 1
        pairs = [(top, s.one.name, s.other.name, a, b) for s in self.case.of(g.Join)]
        for kind in (g.Contact, g.Tie):
            pairs += [(low, s.slave.name, s.master.name, f, h) for s in self.case.of(kind)]
        return any(
            (x in self.of(d, p) and y in self.of(d, q)) or (y in self.of(d, p) and x in self.of(d, q))
            for d, p, q, x, y in pairs
        )

    def untold(self) -> list[str]:
        """A line for each pair of bodies that touch and of which no statement says anything."""
        found, many = [], self.many(self.dimension)
        used = {number for (d, _), own in self.members.items() if d == self.dimension for number in own}
        for (a, b), pairs in self.touching.items():
            open_ = [f"{f} on {h}" for f, h in pairs if not self.stated(a, b, f, h)]
            if not open_ or a not in used or b not in used:
                continue
            names = [quoted(name) for body in (a, b) if (name := self.named(body))]
            both = len(names) == 2
            found.append(
                f"{' and '.join(names) if both else f'{many} {a} and {b}'} ({self.many(self.dimension - 1)} "
                f"{', '.join(open_)}), and no statement says what happens there: "
                + ("" if both else f"name each by a line group NAME {many} N, and ")
                + f"write join {' '.join(names) if both else 'A B'} part, tie or contact"
            )
        return found

    def bare(self) -> bool:
        """Whether a body has no face that is known, as in a mesh that was saved without most of them."""
        return any(not self.made.pieces.keys() & own for own in map(set, self.made.bodies.values()))

    def table(self) -> str:
        """What -check 1 prints of bodies and faces."""
        self.made.names = {body: quoted(name) for body in self.made.bodies if (name := self.named(body))}
        told = {bodies: all(self.stated(*bodies, *pair) for pair in pairs) for bodies, pairs in self.touching.items()}
        on = by_face(self.touching)
        return table(self.made, self.faces, on) + statements(self.made, self.faces, self.touching, told)

    def pieces(self) -> str:
        """The outline for a picture: corners, with the numbers of faces and bodies."""
        corners = self.dimension
        lines = ["face,body," + ",".join(f"x{k},y{k},z{k}" for k in range(corners))]
        sides = self.made.sides
        for face, pieces in self.made.pieces.items():
            body = sides[face][0] if sides.get(face) else 0
            start = f"{self.origin.get(face, face)},{self.parent.get(body, body)}"
            rows = pieces[:, :corners].reshape(len(pieces), -1).tolist()
            lines += [",".join([start, *map(EXACT, row)]) for row in rows]
        return "\n".join(lines) + "\n"

    def names(self) -> str:
        """The bodies' names for a picture."""
        rows = [f'{body},"{name}"' for body in self.made.bodies if (name := self.named(body).replace('"', ""))]
        return "\n".join(["body,name", *rows]) + "\n" if rows else ""

    def left(self) -> str:
        """Of CAD: the bodies that no group has."""
        used = {number for (d, _), own in self.members.items() if d == self.dimension for number in own}
        found = unique(self.parent.get(body, body) for body in self.made.bodies if body not in used)
        said = " ".join(f"{n} ({quoted(self.labels[n])})" if n in self.labels else str(n) for n in found)
        return f"{self.many(self.dimension)} {said}" if self.cad and found else ""

    # ------------------------------------------------------------ cuts and joins

    def sharing(self) -> set[frozenset[int]]:
        """The pairs of bodies that share a face."""
        return {frozenset(sides) for sides in self.made.sides.values() if len(sides) > 1}

    def operations(self) -> list[Any]:
        """Cuts and bodies to be joined, for gmsh: cut, body, point, normal, middle, size; share, bodies."""
        top, cuts = self.dimension, self.case.of(g.Cut)
        shared = self.sharing()
        pairs = [
            (a, b)
            for s in self.case.of(g.Join)
            if s.how == "part"
            for a in self.of(top, s.one.name)
            for b in self.of(top, s.other.name)
            if frozenset((a, b)) not in shared
        ]
        if not cuts and not pairs:
            return []
        together = {body: {body} for body in self.made.bodies}  # what hangs together
        direct = {frozenset(pair) for pair in pairs} | shared
        for pair in direct:
            both = set().union(*(together[body] for body in pair))
            together |= {body: both for body in both}
        self.check_hanging(together, direct if pairs else None)
        nodes = np.concatenate([p.reshape(-1, 3) for p in self.made.pieces.values()])
        middle = ((nodes.min(0) + nodes.max(0)) / 2).tolist()
        found: list[Any] = []
        changed = {a for a, _ in pairs}
        for s in cuts:
            for body in self.of(top, s.body.name):
                found.append(["cut", body, [*s.plane.point], [*s.plane.normal], middle, self.diagonal])
                changed.add(body)
        for group in {min(own): sorted(own) for own in together.values()}.values():
            if len(group) > 1 and changed & set(group):
                found.append(["share", group])
        return found

    def check_hanging(self, together: dict[int, set[int]], direct: set[frozenset[int]] | None) -> None:
        """gmsh meshes at once what hangs together: bodies that touch there without being joined stop it."""
        for a, b in combinations(self.made.bodies, 2) if direct is not None else ():
            if b not in together[a] or frozenset((a, b)) in (direct or ()):
                continue
            if (a, b) in self.touching or (b, a) in self.touching:
                names = [quoted(self.named(body) or str(body)) for body in (a, b)]
                allowed = "join them as part too, or tie in place of part"
                hang = "touch, and joins with other bodies hang them together"
                self.no(self.case.of(g.Join)[0].line, f"join: {' and '.join(names)} {hang}; allowed: {allowed}")

    def after(self, before: Picks, own: dict[int, list[int]], overlap: bool) -> None:
        """Behind cuts and joins: all groups of before, by the numbers of now; own: by body its pieces.

        A face is a piece of the one that it lies on; a face between two pieces of one body, or between joined bodies,
        is of none.
        """
        top, shared = self.dimension, before.sharing()
        self.parent = {piece: body for body, pieces in own.items() for piece in pieces}
        new: dict[tuple[int, int], list[int]] = {}
        for body in self.made.bodies:
            new.setdefault((top, self.parent.get(body, body)), []).append(body)
        for face in self.made.entities:
            sides = [self.parent.get(body, body) for body in self.made.sides.get(face, [])]
            if len(sides) > 1 and sides[0] == sides[1]:
                self.cut_faces[face], self.origin[face] = sides[0], -face
                continue
            self.joined |= {frozenset(sides)} if len(sides) > 1 else set()
            between = len(sides) > 1 and frozenset(sides) not in shared
            old = self.lies_on(before, face, sides[:1] if between else sides)
            if old:
                self.origin[face] = old
                if not between:
                    new.setdefault((top - 1, old), []).append(face)
        self.members = {
            (d, name): [now for number in numbers for now in new.get((d, number), [])]
            for (d, name), numbers in before.members.items()
        }
        self.check_joins(before, shared, overlap)
        self.find_sections(before)

    def lies_on(self, before: Picks, face: int, sides: Sequence[int]) -> int:
        """The face of these bodies before, on which a face lies: at the middle of its largest piece."""
        pieces = self.store.of([face])
        old_sides = before.made.sides
        of = before.store.of([old for old, own in old_sides.items() if set(sides) <= set(own)])
        if not len(pieces) or not len(of):
            return 0
        large = pieces[np.argmax(self.store.reach[pieces])]
        of = of[(normals(before.store.nodes[of]) @ normals(self.store.nodes[large][None])[0]) ** 2 > 0.5]
        if not len(of):
            return 0
        parts = before.store.split(of).ravel()
        nearest = parts[np.argmin(distances(self.store.centre[large], before.store.nodes[parts]))]
        return int(before.store.face[nearest])

    def check_joins(self, before: Picks, shared: set[frozenset[int]], overlap: bool) -> None:
        top, joins, cuts = self.dimension, self.case.of(g.Join), self.case.of(g.Cut)
        for s in joins:
            if s.how != "part":
                continue
            start = f"join {s.one} {s.other}"
            if overlap:
                allowed = f"bodies that touch, or {start} contact"
                self.no(s.line, f"{start} part: bodies of it overlap; allowed: {allowed}")
            both = [(a, b) for a in before.of(top, s.one.name) for b in before.of(top, s.other.name)]
            if not any(frozenset(pair) in self.joined for pair in both):
                gap = "they share no face, there is a gap between them"
                self.no(s.line, f"{start} part: {gap}; allowed: bodies that touch, or a contact")
        if overlap or shared - self.joined:
            first = cuts[0] if cuts else joins[0]
            name = cuts[0].on if cuts else joins[0].one
            why = "bodies that share a face with others cannot be cut or joined so; allowed: in the geometry"
            self.no(first.line, f"{first.word} {name}: {why}")

    def find_sections(self, before: Picks) -> None:
        """Of each cut: the faces between pieces of its body that lie in its plane."""
        for s in self.case.of(g.Cut):
            bodies = before.of(self.dimension, s.body.name)
            plane = g.InPlane(point=s.plane.point, normal=s.plane.normal)
            found = [f for f, body in self.cut_faces.items() if body in bodies and self.within([f], plane)]
            if not found:
                nodes = before.store.nodes[before.store.of(before.around(bodies))].reshape(-1, 3)
                along = (nodes - s.plane.point) @ np.array(s.plane.normal) / np.linalg.norm(s.plane.normal)
                lies = f"lies from {along.min():.4g} to {along.max():.4g} along the normal from its point"
                self.no(
                    s.line,
                    f"cut {s.on}: the plane does not cross {s.body}, which {lies}; allowed: a point between",
                )
            self.members[self.dimension - 1, s.on.name] = found

    def table_of_cuts(self) -> str:
        """A line for the faces of each cut."""
        text, space = "", self.made.space
        for s in self.case.of(g.Cut):
            own = [face for face in self.faces if face.number in self.of(self.dimension - 1, s.on.name)]
            middle = triple(own[0].spot, space, 4, 3e-5 * self.diagonal)
            size = f"{'area' if space else 'length'} {sum(face.area for face in own):.4g}"
            text += f"\ncut {s.on} through {s.body}: {size}, middle {middle}\n"
        return text

    # ------------------------------------------------------------ sizes

    def sizes(self) -> list[dict[str, Any]]:
        """Sizes of elements, for gmsh's fields; none yet if the outline must be closer (`store.finest`)."""
        found = []
        for s in self.case.of(g.Size):
            on = [d for d in (self.dimension, self.dimension - 1) if self.of(d, s.name)]
            if s.on is None:
                if size := self.of_contacts(s.value):
                    found.append(size)
            elif not on:
                one = "face" if self.made.space else "curve"
                nothing = f"the geometry has nothing in the group {s.on}"
                allowed = f"a group with a body, or with a {one} of one"
                self.no(s.line, f"size {s.on}: {nothing}; allowed: {allowed}")
            else:
                found.append(self.of_group(on[0], self.of(on[0], s.name), s.value))
        return found

    def of_group(self, dimension: int, numbers: list[int], h: float) -> dict[str, Any]:
        size: dict[str, Any] = {"h": h, "dimension": dimension, "on": numbers}
        if dimension == 1:
            # in the plane sizes grow from a curve, in its bodies: beside a size of the curve alone gmsh leaves slivers,
            # too stiff for a contact
            lengths = [np.linalg.norm(p[:, 1] - p[:, 0], axis=1).sum() for p in map(self.made.pieces.get, numbers)]  # type: ignore[index]
            most, sides = max(map(float, lengths)), self.made.sides
            bodies = [body for face in numbers for body in sides[face]]
            count = 2000 if most > 4000 * h else int(most / h / 2) + 20
            return size | {"points": count, "faces": unique(bodies), "edges": unique([*numbers, *self.around(bodies)])}
        return size | {"around": unique(self.around(numbers)) if dimension == self.dimension else []}

    def of_contacts(self, h: float) -> dict[str, Any] | None:
        """Around the places where contacts are; ties have none beside contacts: their surfaces touch all over."""
        store, low = self.store, self.dimension - 1
        zones, wide = [], 0.0
        touching: list[g.Contact | g.Obstacle | g.Tie] = [*self.case.touching] or [*self.case.of(g.Tie)]
        for s in touching:
            shape, master, around = None, np.zeros(0, int), np.zeros(0, int)
            slave = store.of(self.of(low, (s.on if isinstance(s, g.Obstacle) else s.slave).name))
            if isinstance(s, g.Obstacle):
                shape = (
                    surface_of(s.shape, self.case.where, s.line)
                    if has_edges(s.shape)
                    else Shape(np.array(s.shape.place), np.array(s.shape.direction), s.shape.radius)
                )
            else:
                master = store.of(self.of(low, s.master.name))
                around = self.inside(s)
            if not len(slave) or not (shape or len(master)):
                continue
            zone = store.nearest(slave, master, h, 0.05 * h, shape, around)
            zones.append(store.centre[zone])
            wide = max(wide, float(np.max(store.reach[zone], initial=0)))
        if store.asks and store.finest < np.inf:
            return None
        places = np.concatenate([*zones, np.zeros((0, 3))])
        if not len(places):
            return None
        kept = places[first_of_cell(places, h)]
        start = 4 * h + (wide if wide > 4 * h else 0)
        return {"h": h, "zone": [[float(EXACT(x)) for x in place] for place in kept.tolist()], "from": start}

    def inside(self, s: g.Contact | g.Tie) -> Numbers:
        """In the plane: the boundary of the bodies that have curves of the master, and none of the slave."""
        if self.made.space:
            return np.zeros(0, int)
        sides = self.made.sides
        own, other = ({b for f in self.of(1, side.name) for b in sides[f]} for side in (s.slave, s.master))
        return self.store.of(unique(self.around([body for body in self.made.bodies if body in other - own])))


def apart(one: Array, other: Array) -> Array:
    """The distances of places from others, to about 1e-8 of the greatest: as one product of matrices."""
    square = (one**2).sum(1)[:, None] + (other**2).sum(1) - 2 * one @ other.T
    found: Array = np.sqrt(np.maximum(square, 0, out=square), out=square)
    return found


def nearest_pieces(store: Store, a: Numbers, b: Numbers) -> tuple[Array, Numbers]:
    """From the middles of pieces a to the flat pieces b: distances, and the nearest pieces."""
    best, there = np.full(len(a), np.inf), np.zeros(len(a), int)
    rows = max(1, PAIRS // len(b))
    middle = store.centre[b].mean(axis=0)
    others = store.centre[b] - middle
    for k in range(0, len(a), rows):
        places = store.centre[a[k : k + rows]]
        off = apart(places - middle, others)
        row, column = np.nonzero(off - store.reach[b] <= (off + store.bow[b]).min(axis=1)[:, None] + 1e-6 * off.max())
        found = distances(places[row], store.nodes[b[column]])
        order = np.lexsort((found, row))
        _, first = np.unique(row[order], return_index=True)
        best[k : k + rows], there[k : k + rows] = found[order[first]], b[column[order[first]]]
    return best, there
