"""A problem read as a whole: mesh or geometry, and case; the files of a run's folder, which FreeFEM reads.

case: values.py; mesh.msh, middles, curves, rises, notes, regions: bodies.py; told, a line each: gmsh's version, if it
meshed the file; the plan of a geometry, for `again`; what makes smaller elements, in words; bodies that are left out;
how many pairs of bodies touch that no statement tells of, and these; table, faces, bodies, for -check 1: what the
geometry has, for the screen and for a picture.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from . import grammar as g
from .abaqus import listing, read_inp
from .bodies import write_bodies
from .case import Case, read_case
from .gmsh_process import GmshError
from .groups import Group, Where
from .kept import KINDS, write_whole
from .mesh import Mesh, MeshRefusal, groups_of
from .mesher import Prepared, Reader, Sets, check_file, convert, pick_on, prepare, refuse_surface
from .msh import read_msh
from .names import is_text_of_gmsh, keep_names
from .rigid.shapes import has_edges
from .sides import pick_on_mesh
from .values import table
from .words import Refusal, quoted, split_case, text_of

FINER = "mesh with smaller elements"
GROUP = re.compile(r"^[ \t]*group[ \t]", re.M)
NUMBERED = (g.BoundaryNumbers, g.BodyNumbers, g.Between)


@dataclass
class Problem:
    """What is to be read, and where to. case: none for -check 1 without; cache: where meshes are kept."""

    file: Path
    case: str
    folder: Path
    where: Where
    sets: Sets = ()
    check: bool = False
    cache: Path | None = None
    rows: str = ""  # a table of problems: its columns that are no flags
    surface: str = ""  # of a mesh made anew: that of the same surfaces, of second order


def write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8", errors="surrogateescape", newline="\n")


def words_of(text: str) -> set[str]:
    """All words of a case: what sets of a mesh it may name."""
    return {word for line in split_case(text, lambda word: "") for word in line.words}


def read_mesh(of: Problem, text: str, named: bool) -> Mesh:
    """A mesh of whatever format; named: it has groups."""
    check_file(of.file, of.sets)
    if of.file.suffix.lower() == ".inp":
        of.where.overlap = True
        return read_inp(of.file, of.where.space, words_of(text))
    if is_text_of_gmsh(of.file):
        return read_msh(of.file, named)
    convert(of.file, of.folder / "converted.msh", named=named)
    return read_msh(of.folder / "converted.msh", named)


def refuse_shapes(case: Case, deck: bool) -> None:
    """Refuses what only a geometry can have."""
    for s in case.of(g.Size):
        raise Refusal("sizes need a geometry; allowed: with a .geo, .step, .iges or .brep file", s.line)
    for join in case.of(g.Join):
        words = f"join {join.one} {join.other}"
        if join.how == "part":
            allowed = f"with a geometry, or {words} tie"
            raise Refusal(f"{words} part: a mesh cannot be joined; allowed: {allowed}", join.line)
        if deck:
            nothing = "the file does not say which faces are a body's"
            group = quoted(f"{join.one.name}-{join.other.name}")
            raise Refusal(f"{group}: between: {nothing}; allowed: with a geometry", join.line)


def read_on_mesh(of: Problem, text: str, read: Reader) -> tuple[Mesh, Case, Prepared]:
    """A mesh with the groups that the case picks: by place, or by numbers of a geometry, which gmsh knows."""
    named = of.where.again or not GROUP.search(text)
    mesh, made = read_mesh(of, text, named), Prepared([], finer=FINER)
    groups, deck = groups_of(mesh, of.where.space, named), of.file.suffix.lower() == ".inp"
    if deck and of.cache:
        keep_names(of.file, of.where.space, of.sets, of.cache, groups, {})
    case = read(groups, {})
    if of.where.again:
        return mesh, case, made
    refuse_shapes(case, deck)
    numbered = not deck and (case.has(g.Join) or any(isinstance(s.pick, NUMBERED) for s in case.of(g.PickedGroup)))
    if numbered or (of.check and not deck):
        try:
            made = pick_on(of.file, of.where.space, read, of.folder, numbered, of.check)
        except GmshError:
            if numbered:
                raise
        made.finer = FINER
    if numbered:
        return read_msh(Path(made.mesh)), case, made
    return pick_on_mesh(mesh, case), case, made


def write_faces(folder: Path, made: Prepared) -> None:
    """What -check 1 prints and draws of a geometry."""
    for name, text in (("table", made.table), ("faces", made.faces), ("bodies", made.names)):
        write(folder / name, text)


def surfaces_of(case: Case) -> str:
    """The rigid shapes with edges, in the order of their statements; nothing without any."""
    edged = [s for s in case.of(g.Obstacle) if has_edges(s.shape)]
    if not edged:
        return ""
    from .rigid.surfaces import surface_of  # takes time to load

    texts = [surface_of(s.shape, case.where, s.line).text() for s in edged]
    return "\n".join([str(len(texts)), *texts]) + "\n"


def tell_faces(of: Problem) -> None:
    """-check 1 without a case: the table of bodies and faces, or of sets."""
    check_file(of.file, of.sets)
    if of.file.suffix.lower() == ".inp":
        write(of.folder / "table", listing(of.file, of.where.space))
        return
    refuse_surface(of.file)
    made = prepare(of.file, of.where.space, None, None, of.folder, of.sets, True)
    write_faces(of.folder, made)


def read_problem(of: Problem) -> None:
    """Writes the files of the folder; raises a Refusal of the case, a GmshError or MeshRefusal of the mesh."""
    text = text_of(of.case)
    made = Prepared([], finer=FINER)
    known: list[Group] = []

    def read(groups: Sequence[Group], bodies: Mapping[int, str]) -> Case:
        of.where.bodies = dict(bodies)
        known[:] = groups
        return read_case(text, of.where, groups)

    if of.file.suffix.lower() in KINDS:
        made = prepare(of.file, of.where.space, text, read, of.folder, of.sets, of.check, of.cache)
        mesh = read_msh(Path(made.mesh))
        case = read(groups_of(mesh, of.where.space), {}) if made.case is None else made.case
    else:
        mesh, case, made = read_on_mesh(of, text, read)
    surface = Path(made.surface or of.surface or os.devnull)
    straight = not of.where.space and of.file.suffix.lower() in KINDS
    smooth = read_msh(surface) if surface.is_file() else None
    written = write_bodies(mesh, case, of.folder, of.where.space, straight, smooth)
    write(of.folder / "regions", written.text)
    write(of.folder / "case", table(case, written.groups, written.split))
    if of.rows:
        from .rows import write_rows  # few runs need it

        write_rows(Path(of.rows), of.folder, of.case, text, case, known, written.groups, written.split)
    if surfaces := surfaces_of(case):
        write(of.folder / "surfaces", surfaces)
    told = [made.version, made.plan, made.finer, made.left, str(len(made.touch)), *made.touch]
    write(of.folder / "told", "\n".join(told) + "\n")
    if made.table:
        write_faces(of.folder, made)


def run(of: Problem) -> int:
    """Reads. Exit codes: 0 done; 1 the mesh, 3 the case is refused, in the file why; 4 without a case; 5 no room."""
    why, code = "", 0
    try:
        if of.case == "none":
            tell_faces(of)
            return 4
        if Path(of.case).exists() and not Path(of.case).is_file():
            why, code = f"-case {of.case}: a folder, a pipe or a device; allowed: a case file", 3
        else:
            read_problem(of)
            return 0
    except Refusal as refusal:
        why, code = refusal.text(of.case), 3
    except (GmshError, MeshRefusal) as error:
        why, code = str(error), 1
    except OSError as error:
        why, code = error.strerror or str(error), 5
    except MemoryError:
        return 5
    return code if write_whole(of.folder / "why", why + "\n") else 5
