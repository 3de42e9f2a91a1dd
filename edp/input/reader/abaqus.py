"""Meshes of CalculiX and Abaqus: a deck's nodes and elements, its sets as groups.

`read_deck` reads a file; `read_inp` gives the mesh with the sets that the case names: ELSETs are bodies, or groups of
sides; of a SURFACE its sides; an NSET stands for all sides of the boundary whose corners are in it. `listing` is the
table of all sets.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn

import numpy as np

from .mesh import KINDS, Block, Floats, Ints, Mesh, MeshRefusal, Side, alone, rows_of, sides_of
from .msh import all_numbers, words_of_lines
from .words import spells_number, whole_number

# a kind of element: gmsh's type, and its nodes in gmsh's order
ORDER = {"C3D4": (4, "0 1 2 3"), "C3D10": (11, "0 1 2 3 4 5 6 7 9 8"), "C3D8": (5, "0 1 2 3 4 5 6 7")}
ORDER |= {"C3D20": (17, "0 1 2 3 4 5 6 7 8 11 16 9 17 10 18 19 12 15 13 14"), "C3D6": (6, "0 1 2 3 4 5")}
ORDER |= {"C3D15": (18, "0 1 2 3 4 5 6 8 12 7 13 14 9 11 10"), "P3": (2, "0 1 2"), "P6": (9, "0 1 2 3 4 5")}
ORDER |= {"P4": (3, "0 1 2 3"), "P8": (16, "0 1 2 3 4 5 6 7"), "P9": (10, "0 1 2 3 4 5 6 7 8")}
ORDER |= {"L2": (1, "0 1"), "L3": (8, "0 2 1")}
SOLID = re.compile(r"(C3D(?:4|6|8|10|15|20))(?:R|I|H|RH|M|MH|T|IH|RT|HT|E)?")
PLANE = re.compile(r"(?:CPE|CPS|CAX|M3D)(3|4|6|8|9)(?:R|I|H|RH|M|MH|T|RT)?")
LINE = re.compile(r"T[23]D([23])")
NONE = np.zeros(0, np.int64)
NO_SOLID = {
    "S": "a shell",
    "B": "a beam",
    "SPRING": "a spring",
    "DASHPOT": "a dashpot",
    "GAP": "a gap",
    "MASS": "a mass",
}


def allowed(space: bool) -> str:
    return "C3D4, C3D10, C3D6, C3D8, C3D15, C3D20" if space else "CPE, CPS or CAX 3, 4, 6, 8"


def kind_of(text: str, space: bool) -> str:
    """The word of ORDER for a type of element; a MeshRefusal names what it is."""
    text = text.upper()
    if space and (found := SOLID.fullmatch(text)):
        return found[1]
    if found := PLANE.fullmatch(text):
        return "P" + found[1]
    if found := LINE.fullmatch(text):
        return "L" + found[1]
    what = next((f", {name}" for word, name in NO_SOLID.items() if re.match(rf"{word}[A-Z]?(\d|$)", text)), "")
    raise MeshRefusal(f"*ELEMENT, TYPE={text}: not read{what}; allowed: {allowed(space)}")


def fields_of(text: bytes, signs: bytes) -> tuple[Floats | None, Ints, Ints]:
    """All numbers, if each stands between commas; the lines that are not blank, and how many numbers they have."""
    blanks = text.replace(b",", b" ")
    apart = not re.search(rb"[^,\s][ \t]+[^,\s]|,[ \t]*,", text)
    return all_numbers(blanks, signs) if apart else None, *words_of_lines(blanks)


def trim(text: str) -> str:
    return text.strip(' \t\r"')


def options_of(words: list[str]) -> dict[str, str]:
    """Of a keyword's line: what stands behind NAME=."""
    pairs = [word.partition("=") for word in words[:0:-1]]  # the first of a name stands
    return {trim(name).upper(): trim(value) if sign and value else "yes" for name, sign, value in pairs}


@dataclass
class Deck:
    """What a deck has. sets: by kind and name their members, in pieces; surfaces: name, element or ELSET, side."""

    space: bool
    nodes: list[Floats] = field(default_factory=list)  # rows: number, x, y, z
    bodies: list[Block] = field(default_factory=list)
    flats: list[Block] = field(default_factory=list)  # elements that are sides of bodies
    sets: dict[tuple[str, str], list[Ints]] = field(default_factory=dict)
    surfaces: list[tuple[str, str, int]] = field(default_factory=list)
    surface_names: list[str] = field(default_factory=list)
    places: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    numbers: Ints = field(default_factory=lambda: np.zeros(0, np.int64))

    def names(self, kind: str) -> list[str]:
        return [name for of, name in self.sets if of == kind]

    def named(self, kind: str, word: str) -> list[Ints]:
        """What a word stands for: a number, or the pieces of a set."""
        return [np.array([number])] if (number := whole_number(word)) >= 0 else self.sets.get((kind, word), [])

    def members(self, kind: str, name: str) -> Ints:
        pieces = self.sets.get((kind, name), [])
        return np.unique(np.concatenate(pieces)) if pieces else NONE

    def is_body(self, name: str) -> bool:
        members = self.members("ELSET", name)
        return any(np.isin(block.number, members).any() for block in self.bodies)


class Keyword:
    """A keyword's line and the lines behind it; line: the number of the keyword's."""

    def __init__(self, deck: Deck, head: str, text: bytes, line: int) -> None:
        words = head.split(",")
        self.deck, self.text, self.line = deck, text, line
        self.section, self.options = trim(words[0][1:]).upper(), options_of(words)

    def no(self, what: str, line: int = 0) -> NoReturn:
        raise MeshRefusal(f"line {line or self.line}: {what}")

    def new_set(self, kind: str, option: str, must: bool = True) -> list[Ints]:
        """The set that this keyword fills, by its option; nothing to keep if it has none."""
        name = self.options.get(option, "")
        if not name and must:
            self.no(f"*{kind}: no name; allowed: {kind}=NAME")
        return self.deck.sets.setdefault((kind, name), []) if name else []

    def rows(self) -> list[tuple[int, list[str]]]:
        """Line by line the fields."""
        lines = self.text.decode(errors="surrogateescape").split("\n")
        return [
            (self.line + k, [trim(word) for word in line.split(",")]) for k, line in enumerate(lines) if line.strip()
        ]

    def read(self) -> None:
        if self.section == "NODE":
            self.read_nodes()
        elif self.section == "ELEMENT":
            self.read_elements()
        elif self.section in ("NSET", "ELSET"):
            self.read_set()
        elif self.section == "SURFACE":
            self.read_surface()
        elif self.section == "INCLUDE":
            self.no("*INCLUDE: not read; allowed: one file")
        elif self.section == "INSTANCE" and self.rows():
            self.no("an instance that is moved; allowed: places in the nodes themselves", self.rows()[0][0])

    def read_nodes(self) -> None:
        found, lines, words = fields_of(self.text, b"+-.eE")
        into = self.new_set("NSET", "NSET", False)
        if not len(words):
            return
        if found is not None and (words == words[0]).all() and words[0] > 2:
            rows = found.reshape(len(words), -1)[:, :4]
        else:
            rows = np.array([self.node(line, fields) for line, fields in self.rows()])
        rows = np.column_stack([rows, np.zeros((len(rows), 4 - rows.shape[1]))])
        number = rows[:, 0]
        if ((number < 1) | (number > 1e15) | (number % 1 > 0)).any() or (np.abs(rows) >= 1e150).any():
            for line, fields in self.rows():
                self.node(line, fields)
        self.deck.nodes.append(np.column_stack([rows, lines + self.line]))
        into.append(number.astype(np.int64))

    def node(self, line: int, fields: list[str]) -> list[float]:
        """The number and the places of a line."""
        numbers = [word.upper().replace("D", "E") or "0" for word in fields[:4]]
        if len(numbers) < 3 or whole_number(numbers[0]) < 1:
            self.no("no node: number and places; allowed: number, x, y, z", line)
        for word in numbers:
            if not spells_number(word) or abs(float(word)) >= 1e150:
                self.no(f"node {numbers[0]}: the coordinate {word} is no number", line)
        return [float(word) for word in numbers] + [0.0] * (4 - len(numbers))

    def read_elements(self) -> None:
        """Elements go over as many lines as they need."""
        deck = self.deck
        try:
            word = kind_of(self.options.get("TYPE", ""), deck.space)
        except MeshRefusal as refusal:
            self.no(str(refusal))
        kind, order = ORDER[word][0], ORDER[word][1].split()
        found, lines, words = fields_of(self.text, b"")
        width = len(order) + 1
        starts = np.cumsum(words) - words
        into = self.new_set("ELSET", "ELSET", False)
        if found is None or len(found) % width or len(np.setdiff1d(np.arange(0, len(found), width), starts)):
            self.wrong_element(width, word)
        rows = found.astype(np.int64).reshape(-1, width)
        line = self.line + lines[np.searchsorted(starts, np.arange(len(rows)) * width)]
        none = np.zeros(len(rows), np.int64)
        block = Block(kind, rows[:, 1:][:, [int(k) for k in order]], rows[:, 0], line, none, none)
        is_body = block.of.dimension == (3 if deck.space else 2)
        (deck.bodies if is_body else deck.flats).append(block)
        into.append(rows[:, 0])

    def wrong_element(self, width: int, word: str) -> NoReturn:
        """Which element it is that cannot be read."""
        number, given = "", width
        for line, fields in self.rows():
            words = [word for word in fields if word]
            if given >= width:
                number, given = words[0], 0
            given += len(words)
            for text in words:
                if whole_number(text) < 0:
                    self.no(f"element {number}: a node that is missing: {text}; allowed: nodes above", line)
            if given > width:
                self.no(f"element {number} has {given - 1} nodes, of the {width - 1} that {word} has", line)
        raise MeshRefusal(f"element {number}: cut off")

    def read_set(self) -> None:
        kind = self.section
        into = self.new_set(kind, kind)
        if "GENERATE" in self.options:
            for line, fields in self.rows():
                if not all(whole_number(word) >= 0 for word in fields if word) or len(fields) < 2:
                    self.no(f"*{kind}: no range; allowed: from, to, step", line)
                first, last, step = (int(word or 0) for word in [*fields, "", ""][:3])
                if last - first > 1e8:
                    self.no(f"*{kind}: a range of {last - first} numbers; allowed: less", line)
                into.append(np.arange(first, last + 1, step or 1))
            return
        found = fields_of(self.text, b"")[0]
        if found is not None:
            into.append(found.astype(np.int64))
            return
        for word in (word for _, fields in self.rows() for word in fields if word):
            into.extend(self.deck.named(kind, word))

    def read_surface(self) -> None:
        name = self.options.get("NAME", "")
        if self.options.get("TYPE", "").upper() == "NODE":
            into = self.new_set("NSET", "NAME")
            for _, fields in self.rows():
                into.extend(self.deck.named("NSET", fields[0]))
            return
        self.new_set("SURFACE", "NAME")
        for line, fields in self.rows():
            side = (fields[1] if len(fields) > 1 else "").upper()
            if not re.fullmatch("S[1-6]", side):
                self.no(f"*SURFACE: {side}: no side of an element; allowed: S1 ... S6", line)
            self.deck.surfaces.append((name, fields[0], int(side[1])))


def read_deck(path: Path, space: bool) -> Deck:
    """All of a deck up to its first step."""
    text = path.read_bytes() + b"\n"
    deck, parts, line, at = Deck(space), 0, 0, 0
    marks = list(re.finditer(rb"^\*(?!\*)[^\n]*", text, re.M))
    for k, mark in enumerate(marks):
        line, at = line + text.count(b"\n", at, mark.start()), mark.start()
        after = marks[k + 1].start() if k + 1 < len(marks) else len(text)
        behind = re.sub(rb"^\*\*[^\n]*", b"", text[mark.end() : after], flags=re.M)
        keyword = Keyword(deck, mark[0].decode(errors="surrogateescape"), behind, line + 1)
        parts += keyword.section == "PART"
        if parts > 1:
            keyword.no("*PART: a second one; allowed: one part, or a mesh of all without parts")
        if keyword.section == "STEP":
            break
        keyword.read()
    if not any(len(block.nodes) for block in deck.bodies):
        raise MeshRefusal(f"no *ELEMENT of a body; allowed: {allowed(space)}")
    number_nodes(deck)
    return deck


def number_nodes(deck: Deck) -> None:
    """Elements know their nodes by rows."""
    nodes = np.concatenate(deck.nodes) if deck.nodes else np.zeros((0, 5))
    deck.numbers, deck.places = nodes[:, 0].astype(np.int64), nodes[:, 1:4] + 0.0
    once = np.unique(deck.numbers, return_index=True)[1]
    for k in np.setdiff1d(np.arange(len(nodes)), once)[:1]:
        what = f"the node {deck.numbers[k]} is there twice; allowed: one mesh of all parts"
        raise MeshRefusal(f"line {int(nodes[k, 4])}: {what}")
    blocks = [*deck.bodies, *deck.flats]
    for block in blocks:
        block.nodes = rows_of(deck.numbers, block.nodes)
        for k, j in np.argwhere(block.nodes < 0)[:1]:
            what = f"element {block.number[k]}: a node that is missing: {~block.nodes[k, j]}; allowed: nodes above"
            raise MeshRefusal(f"line {block.line[k]}: {what}")
    number, line = (np.concatenate([getattr(block, name) for block in blocks]) for name in ("number", "line"))
    order = np.argsort(line, kind="stable")
    once = np.unique(number[order], return_index=True)[1]
    for k in order[np.setdiff1d(np.arange(len(number)), once)[:1]]:
        raise MeshRefusal(f"line {line[k]}: the element {number[k]} is there twice; allowed: once")


def read_inp(path: Path, space: bool, wanted: Collection[str]) -> Mesh:
    """The mesh of a deck with the sets that are wanted: the words of the case."""
    deck = read_deck(path, space)
    dimension = 3 if space else 2
    mesh = Mesh(deck.places, deck.numbers, list(deck.bodies))
    elsets = deck.names("ELSET")
    bodies = [name for name in elsets if deck.is_body(name)]
    flat_sets = [name for name in elsets if name not in bodies]
    sides_first = [*deck.names("SURFACE"), *deck.names("NSET")]
    groups = [(dimension - 1, name) for name in sides_first] + [(dimension, name) for name in bodies]
    tag = {group: k + 1 for k, group in enumerate(dict.fromkeys([*groups, *((dimension - 1, n) for n in flat_sets)]))}
    mesh.names = {(d, number): name for (d, name), number in tag.items()}
    taken: list[Block] = []
    count = 0

    def take(side: Side, chosen: Ints, rank: Ints, name: str) -> None:
        taken.append(side.rows(chosen, count + rank, tag[dimension - 1, name]))

    for name in (name for name in flat_sets if name in wanted):
        members = deck.members("ELSET", name)
        for block in (block for block in deck.flats if block.of.dimension == dimension - 1):
            chosen = np.flatnonzero(np.isin(block.number, members))
            part = block.take(chosen, block.kind, block.nodes[chosen])
            part.line, part.group = count + part.line, np.full(len(chosen), tag[dimension - 1, name])
            part.entity = part.group
            taken.append(part)
        count += 1 << 32
    sides = sides_of(mesh, deck.bodies)
    for name in (name for name in deck.names("SURFACE") if name in wanted):
        known: set[int] = set()
        for _, target, number in (one for one in deck.surfaces if one[0] == name):
            if not target.isdecimal() and ("ELSET", target) not in deck.sets:
                raise MeshRefusal(f"*SURFACE {name}: no *ELSET {target}")
            members = np.concatenate([NONE, *deck.named("ELSET", target)])
            hit = 0
            for block in deck.bodies:
                here = np.flatnonzero(np.isin(block.number, members))
                hit += len(here)
                own = [side for side in sides if side.block is block and side.number == number]
                if len(here) and not own:
                    raise MeshRefusal(f"*SURFACE {name}: element {block.number[here[0]]} has no side S{number}")
                for side in own:
                    fresh = np.array([k for k in here.tolist() if side.key[k] not in known], np.int64)
                    known.update(side.key[fresh].tolist())
                    take(side, fresh, block.line[fresh], name)
            if target.isdecimal() and not hit:
                raise MeshRefusal(f"*SURFACE {name}: element {target} has no side S{number}")
            count += 1 << 32
    nsets = [name for name in deck.names("NSET") if name in wanted and ("SURFACE", name) not in deck.sets]
    outside = alone(sides) if nsets else []
    for name in nsets:
        inside = np.isin(deck.numbers, deck.members("NSET", name))
        for side, free in zip(sides, outside, strict=True):
            corners = side.nodes[:, : KINDS[side.kind].corners]
            chosen = np.flatnonzero(free & inside[corners].all(axis=1))
            take(side, chosen, 8 * side.block.line[chosen] + side.number, name)
        count += 1 << 32
    put_in_bodies(deck, [(name, tag[dimension, name]) for name in bodies if name in wanted])
    mesh.blocks = [block for block in taken if len(block.nodes)] + mesh.blocks
    return mesh


def put_in_bodies(deck: Deck, wanted: list[tuple[str, int]]) -> None:
    """Each element gets the tag of the body that it is in."""
    twice: list[tuple[int, str]] = []
    for block in deck.bodies:
        block.group = np.zeros(len(block.number), np.int64)
        for k, (name, number) in enumerate(wanted):
            chosen = np.isin(block.number, deck.members("ELSET", name))
            for row in np.flatnonzero(chosen & (block.group > 0))[:1]:
                was = next(known for known, n in wanted[:k] if n == block.group[row])
                what = f"element {block.number[row]} is in two bodies of the case, {was} and {name}; allowed: one"
                twice.append((int(block.line[row]), what))
            block.group[chosen] = number
        block.entity = block.group
    if twice:
        raise MeshRefusal(min(twice)[1])


def listing(path: Path, space: bool) -> str:
    """A table of all sets: of elements with a body first, then those that may be boundaries."""
    deck = read_deck(path, space)
    components = 3 if space else 2
    text = ["kind     name                        count   from ... to"]

    def row(kind: str, name: str, count: int, nodes: list[Ints]) -> None:
        at = deck.places[np.concatenate([np.zeros(0, np.int64), *(part.reshape(-1) for part in nodes)])][:, :components]
        line = f"{kind:<8} {name:<24} {count:8d}"
        if len(at):
            low, high = (", ".join(f"{x:.4g}" for x in end) for end in (at.min(0), at.max(0)))
            line += f"   ({low}) to ({high})"
        text.append(line)

    elsets = deck.names("ELSET")
    for kind, names in (("body", filter(deck.is_body, elsets)), ("sides", (n for n in elsets if not deck.is_body(n)))):
        for name in names:
            members = deck.members("ELSET", name)
            parts = [block.nodes[np.isin(block.number, members)] for block in (*deck.bodies, *deck.flats)]
            row(kind, name, len(members), parts)
    if not elsets:
        row("body", "(no *ELSET)", sum(len(b.nodes) for b in deck.bodies), [np.arange(len(deck.places))])
    for name in deck.names("NSET"):
        members = deck.members("NSET", name)
        row("nodes", name, len(members), [np.flatnonzero(np.isin(deck.numbers, members))])
    sides = sides_of(Mesh(deck.places, deck.numbers, []), deck.bodies)
    for name in deck.names("SURFACE"):
        found = []
        for _, target, number in (one for one in deck.surfaces if one[0] == name):
            members = np.concatenate([NONE, *deck.named("ELSET", target)])
            for side in (side for side in sides if side.number == number):
                found.append(side.nodes[np.isin(side.block.number, members)])
        row("surface", name, sum(len(part) for part in found), found)
    return "\n".join(text) + "\n"
