"""Where a case is read, and the groups it may name: those of the mesh, and those that the case picks on a geometry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from .words import Line, meant, quoted

KINDS = ("point", "curve", "surface", "volume")


@dataclass(frozen=True)
class Group:
    """A group of the mesh: its dimension and its name."""

    dimension: int
    name: str

    def __str__(self) -> str:
        """As a line of a case names it."""
        return quoted(self.name)


@dataclass
class Where:
    """Where a case is read; `state` and `phase`, the load phases begun, change as it is read.

    friction: whether the script reads it; with a blank in it, it names the flags that ties exclude. wear, plastic:
    whether the script reads them. overlap: an element may be in several groups, of which the case needs one. bodies:
    of a CAD file, by number the names that its parts have, or "". again: the mesh has the groups that the case picks.
    cases: a load may be 0, because it has another value in another load case.
    """

    space: bool = False
    friction: str = "1"
    wear: bool = True
    plastic: bool = True
    overlap: bool = False
    bodies: dict[int, str] = field(default_factory=dict)
    again: bool = False
    cases: bool = False
    state: str = ""
    phase: int = 0

    def __post_init__(self) -> None:
        self.state = self.state or ("none" if self.space else "strain")

    @property
    def dimension(self) -> int:
        return 3 if self.space else 2

    def many(self, dimension: int) -> str:
        """The word for several entities of a geometry."""
        return (*("points", "curves"), "faces" if self.space else "surfaces", "volumes")[dimension]


@dataclass
class Groups:
    """The groups that a case may name."""

    where: Where
    of_mesh: Sequence[Group]
    all: list[Group] = field(default_factory=list)
    picked: dict[str, int] = field(default_factory=dict)  # by the case: their dimensions
    cad: set[str] = field(default_factory=set)  # of cuts and joins
    labels: dict[str, int] = field(default_factory=dict)  # names of a CAD file's parts: its bodies
    only_body: str = ""  # of a geometry: a body that needs no group, for it is all there is
    any_name: bool = False  # the mesh is not known yet

    def __post_init__(self) -> None:
        self.all = list(self.of_mesh)
        self.labels = {name: body for body, name in self.where.bodies.items() if name}

    def add(self, group: Group) -> None:
        if group not in self.all:
            self.all.append(group)

    def has(self, dimension: int, name: str) -> bool:
        """Whether there is such a group; a part of the file becomes one when it is asked for."""
        if dimension == self.where.dimension and name in self.labels:
            self.add(Group(dimension, name))
        return Group(dimension, name) in self.all

    def in_file(self, name: str) -> bool:
        """Whether the mesh or geometry itself has a group of that name."""
        dimension = self.where.dimension
        return not self.where.again and any(Group(d, name) in self.of_mesh for d in (dimension, dimension - 1))

    def listed(self, dimension: int) -> list[str]:
        found = [group.name for group in self.all if group.dimension == dimension]
        found += [*self.labels] if dimension == self.where.dimension else []
        return list(dict.fromkeys(found))

    def look_ahead(self, lines: Sequence[Line]) -> None:
        """Before the rest: the names that the case gives to groups. What is said to be made of something is a body."""
        dimension = self.where.dimension
        said = {
            word: [line.words for line in lines if line.words[0] == word]
            for word in ("body", "weight", "group", "cut", "join")
        }
        bodies = {words[1] for word in ("body", "weight") for words in said[word] if len(words) > 1}
        own = [words[1] for words in said["body"] if len(words) > 1 and Group(dimension, words[1]) not in self.of_mesh]
        for words in said["group"]:
            if len(words) > 2:
                solid = words[2] == self.where.many(dimension) or (words[2] in ("box", "near") and words[1] in bodies)
                self.picked[words[1]] = dimension - (not solid)
        self.cad = {words[1] for words in said["cut"] if len(words) > 1}
        for words in said["join"]:
            if len(words) > 3 and words[3] in ("tie", "contact") and words[1] != words[2]:
                self.cad |= {f"{words[1]}-{words[2]}", f"{words[2]}-{words[1]}"}
        for name, size in self.picked.items():
            self.add(Group(size, name))
        # a name of the case's own goes before the same one of the file
        self.labels = {name: body for name, body in self.labels.items() if name not in {*self.picked, *self.cad}}
        for name in sorted(self.cad):
            self.add(Group(dimension - 1, name))
        alone = len(own) == 1 and own[0] not in self.labels
        if self.where.bodies and alone and dimension not in self.picked.values():
            self.only_body = own[0]
            self.add(Group(dimension, own[0]))

    def why_not(self, dimension: int, name: str, statement: str) -> str:
        """Why a name is no group of that dimension, with those there are; nothing if it is one."""
        if self.any_name or self.has(dimension, name):
            return ""
        names, known = self.listed(dimension), quoted(name)
        there = " ".join(map(quoted, names)) or "none"
        bodies = self.where.bodies
        if bodies and dimension == self.where.dimension:
            said = f"{known}: no body of the geometry has this name; {meant(name, names)}allowed: "
            said += f"{there}, or " if names else ""
            numbers = " ".join(map(str, bodies))
            return f"{said}a line group {known} {self.where.many(dimension)} N ..., of {numbers}"
        if bodies and not names:
            several = self.where.many(dimension)
            drawn = "(-check 1 without -case draws their numbers)"
            return f"{known}: no group; allowed: a line group {known} {several} N ... {drawn}"
        for other in (3, 2, 1, 0):
            if other != dimension and Group(other, name) in self.all:
                return (
                    f"{known}: a {KINDS[other]} of the mesh; allowed for {statement}: its {KINDS[dimension]}s: {there}"
                )
        return f"{known}: no physical {KINDS[dimension]} of the mesh; {meant(name, names)}allowed: {there}"
