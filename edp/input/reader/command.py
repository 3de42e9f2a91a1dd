"""What FreeFEM and the shell programs of the package ask of the reader: `main([COMMAND, NAME=VALUE, ...])`.

    ready    nothing: whether this Python can run it
    modules  the macros that a case's script needs  space= own= flags= to= cache=
    problem  mesh and case, for FreeFEM           file= case= folder= space= as= sets= options= unlike= surface= rows=
                                                   cache=
    again    another mesh of a geometry           file= space= plan= view= to=

`to`: the file that the answer goes to; case=none: -check 1 without a case. Exit codes: 0 done; 1 refused, in one line;
of `problem` those of problem.run(); 12: see read.py; 130: interrupted.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path

from .kept import keep, place_of, take

Words = dict[str, str]  # the arguments by their names


def sets_of(text: str) -> list[tuple[str, float]]:
    """The numbers of -set, each -setnumber NAME VALUE."""
    words = text.split()
    return [(name, float(value)) for name, value in zip(words[1::3], words[2::3], strict=True)]


def ask_modules(of: Words) -> int:
    """Writes which Python this is, how many macros the second start of FreeFEM has, and these, a line each.

    Where the groups of the mesh are not known yet, a wrong name is no fault here. Exit code 2: no room for the answer,
    which a line says.
    """
    from .case import read_case
    from .groups import Where
    from .modules import Run, modules, needs
    from .names import names_of
    from .words import Refusal, text_of

    flags = of["flags"].split("\n")
    after = {flag: value for flag, value in reversed(list(pairwise(flags)))}
    file, path = after.get("-mesh", "none"), after.get("-case", "none")
    sets = [(flags[i + 1], float(flags[i + 2])) for i, flag in enumerate(flags[:-2]) if flag == "-set"]
    refines = of["space"] != "1" and after.get("-accuracy", "0") != "0"  # by elements of the highest order
    run = Run(
        space=of["space"] == "1",
        own=of["own"] == "1",
        exact="exact" in flags,
        history="-history" in flags,
        axis="-axis" in flags,
        check=after.get("-check") == "1",
        order=after.get("-order", "4" if refines else "2"),
    )
    code = 0
    try:
        groups, bodies = names_of(Path(file), run.space, sets, Path(of["cache"]))
        where = Where(space=run.space, bodies=bodies, overlap=file.lower().endswith(".inp"))
        case = read_case(text_of(path), where, groups)
        asked = modules(needs(case), run)
        if case.load_cases and not run.check:
            asked.options.append("rows")
        macros = [*asked.macros, *(f"{name}OnRequest" for name in asked.options)]
        lines = [sys.executable, str(len(macros)), *macros]
    except Refusal as refusal:
        code, lines = 1, [refusal.text(path)]
    try:
        Path(of["to"]).write_text("\n".join(lines) + "\n", errors="surrogateescape")
    except OSError:
        folder = Path(of["to"]).parent
        allowed = "another folder, named by the variable TMPDIR"
        print(f"-case {path}: cannot be checked: {folder} cannot be written; allowed: {allowed}")
        return 2
    return code


def ask_problem(of: Words) -> int:
    """Reads mesh and case into the run's folder, or takes what a run before has kept of them."""
    folder, cache = Path(of["folder"]), Path(of["cache"])
    alike = (of["space"], of["sets"], of["options"], of["unlike"])
    place = place_of(Path(of["file"]), of["case"], cache, *alike) if of["as"] == "solve" and not of["rows"] else None
    if place and take(place, folder):
        return 0
    # modules that take time to load
    from .groups import Where
    from .problem import Problem, run

    options, sets = of["options"].split(), sets_of(of["sets"])
    where = Where(
        space=of["space"] == "1",
        friction=(of["unlike"] or "1") if "friction" in options else "",
        wear="wear" in options,
        plastic="plastic" in options,
        again=of["as"] == "again",
    )
    check = of["as"] == "check"
    code = run(Problem(Path(of["file"]), of["case"], folder, where, sets, check, cache, of["rows"], of["surface"]))
    if code == 0 and place:
        keep(folder, place)
    return code


def ask_again(of: Words) -> int:
    from .gmsh_process import GmshError
    from .mesher import again

    try:
        again(Path(of["file"]), of["space"] == "1", Path(of["plan"]), Path(of["view"]), Path(of["to"]))
    except (GmshError, OSError):
        return 1
    return 0


COMMANDS: dict[str, Callable[[Words], int]] = {
    "ready": lambda of: 0,
    "modules": ask_modules,
    "problem": ask_problem,
    "again": ask_again,
}


def main(arguments: Sequence[str]) -> int:
    """Runs a command; its exit code."""
    command, *rest = arguments
    try:
        return COMMANDS[command]({name: value for name, _, value in (word.partition("=") for word in rest)})
    except KeyboardInterrupt:
        return 130
