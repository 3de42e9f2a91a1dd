"""gmsh's version 2 text format.

`read_msh` reads a file; a MeshRefusal names the line and what is wrong with it. The numbers of a section are read at
once; only where they cannot all be read, its lines are looked at one by one.
"""

from __future__ import annotations

import re
import warnings
from pathlib import Path
from typing import NoReturn

import numpy as np

from .mesh import KINDS, Block, Floats, Ints, Mesh, refuse, rows_of
from .names import named_in
from .words import spells_number, whole_number

FORMAT = "not gmsh's version 2 text format"
READ = ("MeshFormat", "PhysicalNames", "Nodes", "Elements")
MARK = re.compile(rb"^[ \t]*\$([^ \t\r\n]*)[^\n]*(\n|$)", re.M)
KNOWN = "allowed: points, lines, triangles, quadrangles, tetrahedra, bricks, prisms, pyramids of first or second order"


def all_numbers(text: bytes, signs: bytes) -> Floats | None:
    """All numbers of a text of digits, blanks and these signs; nothing if there is anything else.

    Without a point they are numbers of nodes or elements, with 15 digits at most.
    """
    if text.translate(None, b"0123456789 \t\r\n" + signs):
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            found = np.fromstring(text, sep=" ") if text.strip() else np.zeros(0)
        except (DeprecationWarning, ValueError):
            return None
    return found if b"." in signs or not (np.abs(found) > 1e15).any() else None


def words_of_lines(text: bytes) -> tuple[Ints, Ints]:
    """Of the lines that are not blank: where they are, from 0 on, and how many words they have."""
    blank = np.frombuffer(b" " + text, np.uint8) <= 32
    begins = np.flatnonzero(blank[:-1] & ~blank[1:])
    ends = np.append(np.flatnonzero(np.frombuffer(text, np.uint8) == 10), len(text))
    words = np.diff(np.searchsorted(begins, ends), prepend=0)
    lines = np.flatnonzero(words)
    return lines, words[lines]


class Section:
    """The lines of a section behind its number of lines; first: the number of the first one in the file."""

    def __init__(self, name: str, text: bytes, first: int) -> None:
        self.name, self.text, self.first = name, text, first
        self.said = 1
        if name != "MeshFormat":
            self.take_count()
        self.lines, self.words = words_of_lines(self.text)
        self.lines += self.first

    def take_count(self) -> None:
        found = re.match(rb"(?:[ \t\r]*\n)*([^\n]*)(?:\n|$)", self.text)
        assert found is not None
        if not found[1].strip():
            self.said = -1  # cut off
        elif not re.fullmatch(rb"[ \t]*[0-9]{1,15}[ \t\r]*", found[1]):
            line = self.first + self.text.count(b"\n", 0, found.start(1))
            refuse(f"line {line}: the number of lines of ${self.name} is no number")
        else:
            self.said = int(found[1])
        self.first += self.text.count(b"\n", 0, found.end())
        self.text = self.text[found.end() :]

    def rows(self) -> list[tuple[int, list[str]]]:
        """Line by line the words; only to find what is wrong."""
        texts = self.text.decode(errors="surrogateescape").split("\n")
        return [(line, texts[line - self.first].split()) for line in self.lines.tolist()]


def read_msh(path: Path, named: bool = True) -> Mesh:
    """The mesh of a file; named: it has names of groups."""
    text = path.read_bytes()
    if not text:
        refuse(f"an empty file, {FORMAT}")
    if not text.split(b"\n", 1)[0].lstrip(b" \t").startswith(b"$"):
        refuse(FORMAT)
    mesh = Mesh(np.zeros((0, 3)), np.zeros(0, np.int64), [])
    seen: set[str] = set()
    at = line = 0
    inside, begin = "", 0
    for mark in MARK.finditer(text):
        name = mark[1].decode(errors="replace")
        if inside and name != f"End{inside}":
            continue
        line, at = line + text.count(b"\n", at, mark.start()), mark.start()
        if not inside:
            inside, begin = name, mark.end()
            if name in READ and name in seen:
                refuse(f"a second ${name} (line {line + 1})")
            seen.add(name)
            start = line + 2
        else:
            if inside in READ:
                read_section(mesh, Section(inside, text[begin : mark.start()], start), True)
            inside = ""
    if inside in READ:
        read_section(mesh, Section(inside, text[begin:], start), False)
    if "MeshFormat" not in seen:
        refuse(FORMAT)
    if inside or not {"Nodes", "Elements"} <= seen:
        refuse("cut off" + (f" in ${inside}" if inside else ""))
    if named and "PhysicalNames" not in seen:
        refuse("no physical groups")
    return mesh


def read_section(mesh: Mesh, section: Section, whole: bool) -> None:
    """Takes what a section has; `whole`: it has an end."""
    if section.name == "MeshFormat":
        for _, words in section.rows():
            version = words[0] if spells_number(words[0]) else "0"
            if not 2 <= float(version) < 3 or words[1:2] != ["0"]:
                refuse(f"{FORMAT}: version {words[0]}, binary {' '.join(words[1:2])}")
    elif section.name == "PhysicalNames":
        mesh.names = named_in(section.text)
    elif section.name == "Nodes":
        read_nodes(mesh, section)
    else:
        read_elements(mesh, section)
    if whole and section.said != len(section.lines):
        refuse(f"${section.name} has {len(section.lines)} lines, and says {section.said}: cut off?")


def read_nodes(mesh: Mesh, section: Section) -> None:
    found = all_numbers(section.text, b"+-.eE")
    if found is None or bool((section.words != 4).any()) or len(found) != 4 * len(section.lines):
        wrong_node(section)
    rows = found.reshape(-1, 4)
    if ((rows[:, 0] < 1) | (rows[:, 0] > 1e15) | (rows[:, 0] % 1 > 0)).any() or not (np.abs(rows) < 1e150).all():
        wrong_node(section)
    mesh.places, mesh.numbers = rows[:, 1:] + 0.0, rows[:, 0].astype(np.int64)
    once = np.unique(mesh.numbers, return_index=True)[1]
    if len(once) < len(rows):
        k = int(np.setdiff1d(np.arange(len(rows)), once)[0])
        refuse(f"node {mesh.numbers[k]} (line {section.lines[k]}) is there twice")


def wrong_node(section: Section) -> NoReturn:
    for line, words in section.rows():
        number = words[0]
        if not (number.isascii() and number.isdigit() and number.strip("0")):
            refuse(f"line {line}: the node {number}; node numbers start at 1")
        if len(words) != 4:
            refuse(f"node {number} (line {line}): {len(words) - 1} coordinates for 3")
        for word in words[1:]:
            if not spells_number(word) or abs(float(word)) >= 1e150:
                refuse(f"node {number} (line {line}): the coordinate {word} is no number")
    refuse(f"${section.name} cannot be read: numbers that are too large")


def read_elements(mesh: Mesh, section: Section) -> None:
    """Elements by their kinds and numbers of tags."""
    found = all_numbers(section.text, b"-")
    if found is None or len(found) != section.words.sum() or bool((section.words < 3).any()):
        wrong_element(section)
    values = found.astype(np.int64)
    begin = np.cumsum(section.words) - section.words
    kinds, tags = values[begin + 1], values[begin + 2]
    need = np.zeros(len(begin), np.int64)
    for kind in np.unique(kinds):
        need[kinds == kind] = KINDS[kind].nodes if kind in KINDS else -1
    if bool(((need < 0) | (tags < 0) | (section.words != 3 + tags + need)).any()):
        wrong_element(section)
    for kind, count in sorted(set(zip(kinds.tolist(), tags.tolist(), strict=True))):
        rows = np.flatnonzero((kinds == kind) & (tags == count))
        whole = values[begin[rows][:, None] + np.arange(3 + count + KINDS[kind].nodes)]
        if bool((whole[:, 3 + count :] < 0).any()):
            wrong_element(section)
        nodes = rows_of(mesh.numbers, whole[:, 3 + count :])
        group = np.abs(whole[:, 3]) if count > 0 else np.zeros(len(rows), np.int64)
        entity = whole[:, 4] if count > 1 else np.zeros(len(rows), np.int64)
        mesh.blocks.append(Block(kind, nodes, whole[:, 0], section.lines[rows], group, entity))


def wrong_element(section: Section) -> NoReturn:
    for line, words in section.rows():
        head = f"element {words[0]} (line {line}): "
        kind = KINDS.get(whole_number(words[1])) if len(words) > 1 else None
        if kind is None:
            refuse(f"{head}of gmsh's type {' '.join(words[1:2])}: {KNOWN}")
        tags = whole_number(words[2]) if len(words) > 2 else -1
        if tags < 0 or len(words) != 3 + tags + kind.nodes:
            refuse(f"{head}{len(words)} numbers; cut off, or more than it should have?")
        for word in words[3 + tags :]:
            if not word.isdecimal():
                refuse(f"{head}a node that is missing: {word}")
        for word in (words[0], *words[3 : 3 + tags]):
            if not word.removeprefix("-").isdecimal():
                refuse(f"{head}{word} is no number")
    refuse(f"${section.name} cannot be read: numbers that are too large")
