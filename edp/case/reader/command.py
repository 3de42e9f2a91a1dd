"""What FreeFEM and bodies/readable.sh ask of the reader: `main([COMMAND, NAME=VALUE, ...])`.

    ready    nothing: whether this Python can run it
    modules  which modules a case asks for       case= space= own= check= flags= to=
    case     a case with the groups of its mesh  case= names= space= options= unlike= overlap= bodies= again= to= picks=

`to`: the file that the answer goes to. Exit codes: 0 done; 1 refused: the answer is one line; 12: see read.py.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from .case import read_case, read_open
from .groups import Group, Where
from .modules import Run, modules, needs
from .picks_text import picks
from .values import table
from .words import Refusal

Words = dict[str, str]  # the arguments by their names


def text_of(case: str) -> str:
    """A case file's text; bytes that are no letters are kept."""
    with open(case, encoding="utf-8", errors="surrogateescape", newline="\n") as file:
        return file.read()


def answer(path: str, text: str) -> None:
    Path(path).write_text(text, encoding="utf-8", errors="surrogateescape", newline="\n")


def groups_of(path: str) -> list[Group]:
    """Groups as gmsh's text has them: dimension, number, "name"."""
    lines = (line.split(maxsplit=2) for line in text_of(path).splitlines())
    return [Group(int(size), name.strip().strip('"')) for size, _, name in lines]


def ask_modules(of: Words) -> None:
    """How many macros the second start of FreeFEM has, and these, a line each.

    A case that cannot be read yet is no fault here.
    """
    flags = of["flags"].split("\n")
    run = Run(
        space=of["space"] == "1",
        own=of["own"] == "1",
        exact="exact" in flags,
        history="-history" in flags,
        axis="-axis" in flags,
        check=of["check"] == "1",
    )
    asked = modules(needs(*read_open(text_of(of["case"]), Where(space=run.space))), run)
    macros = [*asked.macros, *(f"{name}OnRequest" for name in asked.options)]
    answer(of["to"], "\n".join([str(len(macros)), *macros]) + "\n")


def ask_case(of: Words) -> None:
    """The table of the case, and what it picks on a geometry."""
    options = of["options"].split()
    where = Where(
        space=of["space"] == "1",
        friction=(of["unlike"] or "1") if "friction" in options else "",
        wear="wear" in options,
        plastic="plastic" in options,
        overlap=of["overlap"] != "",
        bodies=of["bodies"],
        again=of["again"] != "",
    )
    case = read_case(text_of(of["case"]), where, groups_of(of["names"]))
    answer(of["to"], table(case))
    if of["picks"]:
        answer(of["picks"], "".join(f"{line}\n" for line in picks(case)))


COMMANDS: dict[str, Callable[[Words], None]] = {"ready": lambda of: None, "modules": ask_modules, "case": ask_case}


def main(arguments: Sequence[str]) -> int:
    """Runs a command; its exit code."""
    command, *rest = arguments
    of = {name: value for name, _, value in (word.partition("=") for word in rest)}
    try:
        COMMANDS[command](of)
    except Refusal as refusal:
        answer(of["to"], refusal.text(of["case"]) + "\n")
        return 1
    except BrokenPipeError:
        sys.stderr.close()
        return 1
    return 0
