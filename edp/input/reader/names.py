"""The groups of a file, known without numpy and gmsh's module (a refusal then waits for neither), and names of bodies.

A mesh in gmsh's version 2 text has its names near its beginning. For a deck, and a geometry that reads no other file,
they are kept once it has been read.

CAD programs write a name for each part of a STEP file, and gmsh gives each body a label with it, as
Shapes/Assembly/1/Plate. `body_names(labels)` makes names of the labels: by body, "" where the file has none. A name
that a CAD program gives by itself, as Body001, is none. Parts that occur several times get numbers: bolt, bolt-2.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from .groups import Group
from .kept import KINDS, checksum, stands_alone, write_whole
from .words import CONTROL, spells_number, whole_number

EVERY_CURVE = "every curve of the geometry"
KEPT = {*KINDS, ".inp"}
HEAD = 1 << 20  # bytes of a mesh in which its names are looked for
LONGEST = 60  # letters of a name
# what programs write in place of a name: also numbers alone, and what Open CASCADE makes of a reference
NO_NAME = re.compile(
    r"open cascade .*|=>.*|(body|solid|part|volume|shape|compound|component|product|assembly"
    r"|(manifold[ _]?)?(solid[ _]?)?brep|unnamed|untitled|no[ _]?name|none|null|default|unknown)?[ _.-]*[\d.]*",
    re.I,
)
TAKEN = {"contact"}  # size contact


def is_text_of_gmsh(file: Path) -> bool:
    """Whether it is gmsh's version 2 text; a file that says nothing of its format is read as one, and refused there."""
    if file.suffix.lower() != ".msh":
        return False
    with file.open("rb") as opened:
        lines = opened.read(200).replace(b"\r", b"").split(b"\n")
    words = lines[1].split() if lines[0].startswith(b"$MeshFormat") and len(lines) > 1 else []
    return not words or not (words[0].startswith(b"4") or (words[0].startswith(b"2") and words[1:2] == [b"1"]))


def named_in(section: bytes) -> dict[tuple[int, int], str]:
    """What a section $PhysicalNames has: names by dimension and tag."""
    found = {}
    for row in section.decode(errors="surrogateescape").replace("\r", "").split("\n"):
        words = row.split()
        if len(words) > 1 and min(map(whole_number, words[:2])) >= 0:
            first, last = row.find('"'), row.rfind('"')
            found[int(words[0]), int(words[1])] = row[first + 1 : last] if last > first else row[first + 1 :]
    return found


def of_mesh(file: Path, space: bool) -> list[Group]:
    """The groups of a mesh; none, if it must be looked at as a whole."""
    with file.open("rb") as opened:
        _, begin, rest = opened.read(HEAD).partition(b"\n$PhysicalNames")
    section, end, _ = rest.partition(b"\n$EndPhysicalNames")
    named = [Group(d, name) for (d, _), name in named_in(section).items() if EVERY_CURVE not in name]
    odd = any(CONTROL.search(group.name) for group in named) or (space and all(group.dimension < 3 for group in named))
    return named if begin and end and not odd else []


def place_of_names(file: Path, space: bool, sets: object, cache: Path) -> Path:
    return cache / f"own-{checksum(file, 'names', space, sets)}.names"


def keep_names(
    file: Path, space: bool, sets: object, cache: Path, groups: list[Group], bodies: Mapping[int, str]
) -> None:
    """Keeps what a file has: a line with how many bodies a CAD file has, a line for each with its name, the groups."""
    with suppress(OSError):
        cache.mkdir(parents=True, exist_ok=True)
    named = [*bodies.items(), *((group.dimension, group.name) for group in groups)]
    lines = [str(len(bodies)), *(f"{number} {name}" for number, name in named)]
    write_whole(place_of_names(file, space, sets, cache), "\n".join(lines))


def names_of(file: Path, space: bool, sets: object, cache: Path) -> tuple[list[Group] | None, dict[int, str]]:
    """The groups of a file, None: not known; and the names of a CAD file's bodies. sets: the numbers of -set."""
    try:
        if is_text_of_gmsh(file):
            return of_mesh(file, space) or None, {}
        if file.suffix.lower() in KEPT and stands_alone(file):
            text = place_of_names(file, space, sets, cache).read_text(encoding="utf-8")
            count, *lines = text.split("\n")
            named = [(int(number), name) for number, _, name in (line.partition(" ") for line in lines)]
            bodies = dict(named[: int(count)])
            groups = [Group(dimension, name) for dimension, name in named[int(count) :]]
            return groups if groups or bodies else None, bodies  # without both it is refused as a whole
    except (OSError, ValueError):
        pass
    return None, {}


def name_of(label: str) -> str:
    """The name of a part: the last component of a label, with plain blanks and without quotes; nothing of none."""
    last = CONTROL.sub(" ", label.rpartition("/")[2]).replace('"', "").replace("\ufffd", "")
    found = " ".join(last.split())[:LONGEST].strip()
    return "" if NO_NAME.fullmatch(found) or spells_number(found) else found


def body_names(labels: Mapping[int, str]) -> dict[int, str]:
    """By body its name; the bodies of one name are numbered from the second on."""
    found = {body: name_of(label) for body, label in labels.items()}
    used = {*found.values(), *TAKEN}
    seen = set(TAKEN)
    for body, one in found.items():
        if not one or one not in seen:
            seen.add(one)
            continue
        number = next(k for k in range(2, len(found) + 3) if f"{one}-{k}" not in used)
        found[body] = f"{one}-{number}"
        used.add(found[body])
    return found
