"""The names of the bodies of a STEP file: those of its parts, as a case file can name them.

CAD programs write a name for each part, and gmsh gives each body a label with it, as Shapes/Assembly/1/Plate.
`names_of(labels)` makes names of the labels: by body, "" where the file has none. A name that a CAD program gives by
itself, as Body001, is none. Parts that occur several times get numbers: bolt, bolt-2.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from .words import CONTROL, spells_number

LONGEST = 60  # letters of a name
# what programs write in place of a name: also numbers alone, and what Open CASCADE makes of a reference
NO_NAME = re.compile(
    r"open cascade .*|=>.*|(body|solid|part|volume|shape|compound|component|product|assembly"
    r"|(manifold[ _]?)?(solid[ _]?)?brep|unnamed|untitled|no[ _]?name|none|null|default|unknown)?[ _.-]*[\d.]*",
    re.I,
)
TAKEN = {"contact"}  # size contact


def name_of(label: str) -> str:
    """The name of a part: the last component of a label, with plain blanks and without quotes; nothing of none."""
    last = CONTROL.sub(" ", label.rpartition("/")[2]).replace('"', "").replace("\ufffd", "")
    found = " ".join(last.split())[:LONGEST].strip()
    return "" if NO_NAME.fullmatch(found) or spells_number(found) else found


def names_of(labels: Mapping[int, str]) -> dict[int, str]:
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
