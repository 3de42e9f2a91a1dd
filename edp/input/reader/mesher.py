"""A geometry read, picked and meshed by gmsh's module, in one child process, for a case or for -check 1 without one.

`prepare(file, space, text, read, ...)` opens the geometry with the numbers of -set, calls read(groups, bodies), which
makes a Case of the text, picks what it names (picks.py), and has the mesh made: gmsh's version 2 text. `again(...)` is
the same geometry, as it was picked, with sizes of a view. `convert(file, out)` is a mesh in another format of gmsh's.
A GmshError says what is wrong with the geometry, for "-mesh FILE: ..."; a Refusal what is wrong with the case; an
OSError that there is no room. What stands for itself is kept: the mesh, by all that it comes of, and what was read.
"""

from __future__ import annotations

import errno
import json
import os
import platform
import re
import shutil
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from . import grammar as g
from .case import Case
from .geometry import TRIANGLE, Outline, distance_field, look, nodes_of
from .gmsh_process import GmshError, end_with, in_child, start, version
from .groups import Group, Groups, Where
from .kept import CAD, checksum, stands_alone, write_whole
from .names import EVERY_CURVE, body_names, keep_names
from .picks import Picks
from .words import CONTROL, Refusal

SEWN = ["-setnumber", "Geometry.OCCSewFaces", "1", "-setnumber", "Geometry.OCCMakeSolids", "1"]
STEP = (".step", ".stp")
PLANE = "the mesh is plane, it has no volumes: use edp/parts.edp"
NO_NAMES = "no physical groups: bodies and boundaries have no names"
OTHER_MESH = (
    "another size of elements, another algorithm of gmsh's (Mesh.Algorithm), or closed surfaces, as a torus, split "
    "in the geometry"
)
PICKS = re.compile(r"^[ \t]*(group|size|cut|join)[ \t]", re.M)
MAKING = f".making-{platform.node()}-"
TURNS = 6  # closer outlines
Sets = Sequence[tuple[str, float]]
Reader = Callable[[Sequence[Group], Mapping[int, str]], Case]


@dataclass
class Plan:
    """What is done with a geometry before it is meshed; numbers are gmsh's."""

    options: list[str] = field(default_factory=list)  # words for gmsh's start
    operations: list[Any] = field(default_factory=list)  # apart, cut, share: see operate()
    rename: bool = False  # the file's own groups go
    groups: list[tuple[int, str, list[int]]] = field(default_factory=list)
    sizes: list[dict[str, Any]] = field(default_factory=list)
    point_size: float = 0.0  # the least of the geometry's points, 0 of none
    background: int = 0  # the geometry's own field of sizes
    cad: bool = False
    anew: bool = False  # a mesh that the geometry makes of itself goes


@dataclass
class Prepared:
    """What a geometry and a case come to; paths are "" where there is no such file."""

    groups: list[Group]  # that the file itself has
    bodies: dict[int, str] = field(default_factory=dict)  # of CAD: the names of its parts, or ""
    mesh: str = ""
    surface: str = ""  # in space: the mesh of the same surfaces, of second order
    plan: str = ""  # a file, for again()
    version: str = ""  # of gmsh
    finer: str = ""  # what makes smaller elements, in words
    left: str = ""  # bodies that no group has
    touch: list[str] = field(default_factory=list)  # a line for each pair of bodies that no statement tells of
    table: str = ""  # of -check 1
    faces: str = ""  # for the picture of -check 1
    names: str = ""  # of bodies, for the picture
    case: Case | None = None


@dataclass
class Job:
    """What is asked of the child process."""

    file: Path
    space: bool
    text: str | None
    read: Reader | None
    sets: Sets
    check: bool
    cache: Path | None
    folder: Path
    run: int = field(default_factory=os.getpid)

    @property
    def cad(self) -> bool:
        return self.file.suffix.lower() in CAD

    @property
    def options(self) -> list[str]:
        words = [word for name, value in self.sets for word in ("-setnumber", name, f"{value:.17g}")]
        return words if self.space else [*words, "-order", "2"]

    def work(self, place: Path) -> Path:
        """Where this run makes a mesh, before it is moved into place."""
        return place / f"{MAKING}{self.run}"

    def key(self, *more: object) -> str:
        return checksum(self.file, self.space, self.options, *more)


def constants(text: str) -> list[str]:
    """The numbers of a .geo file that -set may set: several in one DefineConstant, with {value, Name "..."}."""
    text = re.sub(r"\n|$", " ", re.sub(r"//.*", "", re.sub(r'"[^"]*"', "", text)))
    while (inner := re.sub(r"\{[^{}]*\}", "", text)) != text:
        text = inner
    parts = [part for found in re.findall(r"DefineConstant[ \t]*\[([^]]*)\]", text) for part in found.split(",")]
    return [name for part in parts if (name := re.sub(r"[ \t\r]", "", part.partition("=")[0]))]


def check_file(file: Path, sets: Sets) -> None:
    """Refuses what is no file, and numbers that the geometry does not have."""
    if file.is_dir():
        raise GmshError("a folder, no mesh")
    if not file.is_file():
        raise GmshError("no file: a pipe or a device")
    if not os.access(file, os.R_OK):
        raise GmshError("may not be read")
    if sets and file.suffix.lower() != ".geo":
        raise GmshError("-set: it has no numbers to be set; allowed: with a .geo file")
    text = file.read_text(errors="replace") if sets else ""
    known = constants(text)
    for name, _ in sets:
        if name not in known and not re.search("merge|include", text, re.I):
            there = " ".join(known) or "none"
            raise GmshError(f"-set {name}: no number of it that can be set; allowed: {there}")


def smaller(file: Path) -> str:
    """What makes smaller elements, in words."""
    if file.suffix.lower() in CAD:
        return "lower sizes (size contact, size NAME in the case file)"
    text = file.read_text(errors="replace")
    found = re.search(r"^ *DefineConstant *\[ *([A-Za-z_0-9]*) *=.*size of the", text, re.M)
    return f"lower sizes ({f'-set {found[1]}, or ' if found else ''}size contact in the case file)"


def prepare(
    file: Path,
    space: bool,
    text: str | None,
    read: Reader | None,
    folder: Path,
    sets: Sets = (),
    check: bool = False,
    cache: Path | None = None,
    limit: float = float("inf"),
) -> Prepared:
    """Reads a geometry for the text of a case, or without one, for -check 1.

    folder: of the run, for what is not kept; cache: where meshes are kept; check: with the table and the picture.
    """
    check_file(file, sets)
    keeps = cache is not None and stands_alone(file)
    job = Job(file, space, text, read, sets, check, cache if keeps else None, folder)
    try:
        made = in_child(partial(make, job=job), file.name, limit)
    finally:  # the child may have been killed
        for place in (job.cache, folder):
            if place:
                shutil.rmtree(job.work(place), ignore_errors=True)
    if read:
        made.case = read(made.groups, made.bodies)
    return made


def pick_on(
    file: Path, space: bool, read: Reader, folder: Path, picks: bool, check: bool = False, limit: float = float("inf")
) -> Prepared:
    """Reads a mesh for a case that picks groups by numbers of its faces and bodies, or between bodies (`picks`).

    check: with the table and the picture. The mesh with these groups is in the folder.
    """
    job = Job(file, space, None, read, (), check, None, folder)
    made = in_child(partial(pick_from_mesh, job=job, picks_any=picks), file.name, limit)
    if made.mesh and not whole(Path(made.mesh)):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), made.mesh)
    return made


# ---------------------------------------------------------------- in the child


class Session:
    """gmsh with a geometry."""

    def __init__(self, gmsh: Any, file: Path, space: bool, cad: bool) -> None:
        self.gmsh, self.file, self.space, self.cad = gmsh, file, space, cad
        self.dimension = 3 if space else 2

    def open(self, options: Sequence[str]) -> None:
        """Opens it afresh."""
        self.gmsh.finalize()
        start(self.gmsh, options)
        self.gmsh.option.setNumber("General.Verbosity", 4)
        self.gmsh.logger.start()
        try:
            self.gmsh.open(str(self.file))
        except Exception as error:
            raise cannot_mesh(error) if self.meshed() else cannot_read(error, self.file) from None

    def meshed(self) -> bool:
        """Whether the geometry has made a mesh of itself while it was read."""
        return any("Meshing " in line for line in self.gmsh.logger.get())

    def numbers(self, dimension: int) -> list[int]:
        return [tag for _, tag in self.gmsh.model.getEntities(dimension)]

    def groups(self) -> list[Group]:
        """The groups that have names."""
        model = self.gmsh.model
        try:
            named = [(d, model.getPhysicalName(d, tag)) for d, tag in model.getPhysicalGroups()]
        except UnicodeDecodeError:
            raise GmshError("a group's name that is no UTF-8 text; allowed: other names") from None
        if any(CONTROL.search(name) for _, name in named):
            raise GmshError("a control character in a group's name; allowed: other names")
        return [Group(d, name) for d, name in named if name]

    def labels(self) -> dict[int, str]:
        """By body the name that the file has for its part, or nothing."""
        found = dict.fromkeys(self.numbers(self.dimension), "")
        for body in found if self.file.suffix.lower() in STEP else ():
            with suppress(UnicodeDecodeError):
                found[body] = self.gmsh.model.getEntityName(self.dimension, body)
        return body_names(found)

    def look(self, closer: Sequence[Any] = (), listed: bool = False) -> Outline:
        try:
            return look(self.gmsh, self.cad, self.space, closer, listed)
        except Exception as error:
            raise cannot_mesh(error) from None

    def own_sizes(self, folder: Path) -> tuple[float, int]:
        """The least size of the geometry's points, and the number of its own field of sizes: as gmsh saves them."""
        whole = folder / f"own-{os.getpid()}.geo_unrolled"
        self.gmsh.option.setNumber("General.AbortOnError", 0)  # it lacks some shapes
        self.gmsh.write(str(whole))
        self.gmsh.option.setNumber("General.AbortOnError", 2)
        text = whole.read_text(errors="replace")
        whole.unlink()
        sizes = [float(size) for size in re.findall(r"^cl__\d+ = (.*);", text, re.M)]
        field_ = re.search(r"^Background Field = (\d+);", text, re.M)
        return min((size for size in sizes if size < 1e22), default=0.0), int(field_[1]) if field_ else 0

    # ------------------------------------------------------------ what is done with it

    def operate(self, operations: Sequence[Any]) -> tuple[dict[int, list[int]], dict[int, int], bool]:
        """apart, bodies: they get faces of their own. cut, body, ...: by a plane. share, bodies: they get common faces.

        By body its pieces, the new numbers of those that were taken apart, and whether bodies overlap.
        """
        occ, top = self.gmsh.model.occ, self.dimension
        own, overlap = {body: [body] for body in self.numbers(top)}, False
        called: dict[int, int] = {}
        try:
            for how, what, *more in operations:
                if how == "apart":
                    for body in what:
                        called[body] = new = occ.copy([(top, body)])[0][1]
                        occ.remove([(top, body)], True)
                        del own[body]
                        own[new] = [new]
                    continue
                tools = []
                if how == "cut":
                    bodies = [(top, tag) for tag in own[what]]
                    tools = occ.intersect([self.plane(*more)], bodies, removeTool=False)[0]
                    if not tools:
                        continue
                else:
                    bodies = [(top, tag) for body in what for tag in own[body]]
                _, parts = occ.fragment(bodies, tools)
                pieces = {
                    body[1]: [tag for d, tag in new if d == top] for body, new in zip(bodies, parts, strict=False)
                }
                for body in [what] if how == "cut" else what:
                    own[body] = [tag for old in own[body] for tag in pieces[old]]
                every = [tag for new in own.values() for tag in new]
                overlap |= len(every) > len(set(every))
            if operations:
                occ.synchronize()
        except Exception as error:
            allowed = 'a STEP or BREP file, or a .geo file with SetFactory("OpenCASCADE")'
            raise Refusal(f"bodies of it cannot be cut, joined or taken apart: {error}; allowed: {allowed}") from None
        return own, called, overlap

    def plane(self, point: Any, normal: Any, middle: Any, size: float) -> tuple[int, int]:
        """A disc, in the plane a line, that crosses the whole geometry."""
        occ = self.gmsh.model.occ
        way = np.array(normal) / np.linalg.norm(normal)
        at = np.array(middle) - (np.array(middle) - point) @ way * way
        if not self.space:
            along = size * np.array([-way[1], way[0], 0.0])
            ends = [occ.addPoint(*(at + side * along)) for side in (1, -1)]
            return 1, occ.addLine(*ends)
        tool = occ.addDisk(0, 0, 0, size, size)
        flat = float(np.hypot(way[0], way[1]))
        if flat > 0:
            occ.rotate([(2, tool)], 0, 0, 0, -way[1] / flat, way[0] / flat, 0, np.arctan2(flat, way[2]))
        occ.translate([(2, tool)], *at)
        return 2, tool

    def apply(self, plan: Plan, curves: bool = True) -> None:
        """All that comes before the mesh; curves: in the plane, a group of all of them."""
        model = self.gmsh.model
        self.operate(plan.operations)
        if plan.rename:
            model.removePhysicalGroups()
        for dimension, name, numbers in plan.groups:
            if numbers:
                model.removePhysicalName(name)  # of a group that is gone
                model.setPhysicalName(dimension, model.addPhysicalGroup(dimension, numbers), name)
        if plan.cad:
            self.gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 12)
        fields = [self.size_field(size, plan) for size in plan.sizes]
        if fields:
            least = model.mesh.field.add("Min")
            own = [plan.background] if plan.background else []
            model.mesh.field.setNumbers(least, "FieldsList", [*fields, *own])
            model.mesh.field.setAsBackgroundMesh(least)
            if not plan.point_size:
                self.gmsh.option.setNumber("Mesh.MeshSizeFromPoints", 0)
        if plan.anew:
            model.mesh.clear()
        if curves and not self.space:
            model.setPhysicalName(1, model.addPhysicalGroup(1, self.numbers(1)), EVERY_CURVE)

    def size_field(self, size: dict[str, Any], plan: Plan) -> int:
        """A field of the sizes of a group, or around places of contact."""
        model, h = self.gmsh.model, size["h"]
        fields = model.mesh.field
        if "zone" in size:
            return distance_field(self.gmsh, size["zone"], f"{h:.9g}+0.25*Max(0,{{}}-{size['from']:.9g})")
        dimension, on = size["dimension"], size["on"]
        if plan.point_size >= h:  # points keep their sizes, except smaller ones of the group
            pass
        elif plan.point_size:
            entities = [(dimension, tag) for tag in on]
            points = [at for at in model.getBoundary(entities, False, False, True) if at[0] == 0]
            model.mesh.setSize(points, h)
        inner, restrict = fields.add("MathEval"), 0
        fields.setString(inner, "F", f"{h:.17g}")
        lists = {"RegionsList": on} if dimension == 3 else {"FacesList": on}
        if dimension == 1:
            away = fields.add("Distance")
            fields.setNumbers(away, "CurvesList", on)
            fields.setNumber(away, "NumPointsPerCurve", size["points"])
            fields.setString(inner, "F", f"{h:.9g}+0.5*Max(0,F{away}-{h:.9g})")
            lists = {"FacesList": size["faces"], "EdgesList": size["edges"]}
        elif not self.space:
            lists["EdgesList"] = size["around"]
        else:  # with a body its boundary, with a face its edges
            faces = size["around"] or on
            lists["FacesList"] = faces
            edges = model.getBoundary([(2, face) for face in faces], False, False)
            lists["EdgesList"] = list(dict.fromkeys(abs(edge) for _, edge in edges))
        restrict = fields.add("Restrict")
        fields.setNumber(restrict, "IField", inner)
        for name, numbers in lists.items():
            fields.setNumbers(restrict, name, numbers)
        return int(restrict)

    def generate(self, mesh: Path, surface: Path | None) -> None:
        """The mesh, and in space, in a process aside, that of the same surfaces, of second order."""
        aside = fork(partial(self.write_surface, surface)) if surface else 0
        try:
            self.gmsh.model.mesh.generate(self.dimension)
        except Exception as error:
            raise cannot_mesh(error) from None
        finally:
            if aside:
                os.waitpid(aside, 0)
        self.write(mesh, False)
        if surface and not whole(surface):
            surface.unlink(missing_ok=True)

    def write_surface(self, path: Path) -> None:
        self.gmsh.option.setNumber("Mesh.ElementOrder", 2)
        self.gmsh.model.mesh.generate(2)
        self.write(path, True)

    def write(self, path: Path, everything: bool) -> None:
        """As version 2 text; everything: what has no name too."""
        for name, value in (("MshFileVersion", 2.2), ("Binary", 0), ("SaveAll", everything)):
            self.gmsh.option.setNumber(f"Mesh.{name}", value)
        self.gmsh.write(str(path))

    def flat(self) -> bool:
        """Whether a triangle of the plane has no area: its points lie on one line."""
        model = self.gmsh.model
        corners = nodes_of(model)[model.mesh.getElementsByType(TRIANGLE)[1]].reshape(-1, 6, 3)[:, :3]
        a, b, c = (corners[:, (k + 1) % 3] - corners[:, k] for k in range(3))
        la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
        twice = np.linalg.norm(np.cross(a, b), axis=1)
        return bool((4 * twice**2 < 1e-8 * la * lb * lc * (la + lb + lc)).any())

    def make(self, plan: Plan, mesh: Path, surface: Path | None, view: Path | None = None) -> None:
        """Opens it, does what the plan says, and meshes it; view: with sizes of this file."""
        # gmsh moves points by a part of the whole for its first triangles: on a fine curve it may leave one between
        # three points of the curve
        for more in ((), ("-setnumber", "Mesh.RandomFactor", "1e-11")):
            self.open([*plan.options, *more])
            self.apply(plan)
            if view:
                self.gmsh.merge(str(view))
                sizes = self.gmsh.model.mesh.field.add("PostView")
                self.gmsh.model.mesh.field.setNumber(sizes, "IView", len(self.gmsh.view.getTags()) - 1)
                self.gmsh.model.mesh.field.setAsBackgroundMesh(sizes)
            self.generate(mesh, surface)
            if self.space or not self.flat():
                break
        groups = self.gmsh.model.getPhysicalGroups()
        solid = len(self.gmsh.model.mesh.getElements(3)[0]) > 0 and (not groups or groups[-1][0] == 3)
        if self.space and not solid:
            raise GmshError(PLANE)


def cannot_read(error: Exception, file: Path) -> GmshError:
    allowed = "a file that gmsh opens without this error"
    if file.suffix.lower() == ".geo":
        again = f"`gmsh -parse_and_exit {file}` repeats what gmsh says"
        allowed = f"a geometry without this error. Correct it there; {again}"
    return GmshError(f"gmsh cannot read it: {error}; allowed: {allowed}")


def cannot_mesh(error: Exception) -> GmshError:
    return GmshError(f"gmsh reads it, but cannot mesh it: {error}; allowed: {OTHER_MESH}")


def fork(task: Callable[[], None]) -> int:
    """The number of a process that does a task aside, silently, and ends with this one."""
    parent = os.getpid()
    child = os.fork()
    if child == 0:
        try:
            end_with(parent)
            task()
        finally:
            os._exit(0)
    return child


def whole(mesh: Path, named: bool = True) -> bool:
    """Whether a mesh was written up to its end, and has names."""
    if not mesh.is_file():
        return False
    with open(mesh, "rb") as text:
        head = text.read(4096)
        text.seek(-min(mesh.stat().st_size, 32), os.SEEK_END)
        return text.read().rstrip().endswith(b"$EndElements") and (not named or b"$PhysicalNames" in head)


def make(gmsh: Any, job: Job) -> Prepared:
    """All of prepare() that needs gmsh."""
    session = Session(gmsh, job.file, job.space, job.cad)
    plan = Plan(options=job.options, cad=job.cad)
    session.open(plan.options)
    if job.cad and job.space and not session.numbers(3):  # faces that nothing joins, as IGES has them
        plan.options += SEWN
        session.open(plan.options)
    if not session.numbers(session.dimension):
        nothing = "no solid in it" if job.space else "no surface in it"
        raise GmshError(PLANE if job.space and not job.cad else nothing)
    made = Prepared(session.groups(), version=version(gmsh), finer=smaller(job.file))
    made.bodies = session.labels() if job.cad else {}
    if job.cache:
        keep_names(job.file, job.space, job.sets, job.cache, made.groups, made.bodies)
    if job.text is None or job.read is None:
        where = Where(space=job.space, bodies=made.bodies)
        picks = Picks(session.look(listed=True), Case(where, Groups(where, [])))
        if not picks.made.bodies or picks.bare():
            raise GmshError("gmsh reads no bodies with faces out of it")
        made.table, made.faces, made.names = picks.table(), picks.pieces(), picks.names()
        return made
    asks = job.cad or PICKS.search(job.text)
    if not made.groups and not asks:
        raise GmshError(NO_NAMES)
    case = job.read(made.groups, made.bodies)
    if asks or job.check:
        pick(session, job, case, plan, made)
    # after reading, for a group may be picked
    names = [name for _, name, _ in plan.groups] or [group.name for group in made.groups]
    if not names:
        raise GmshError(NO_NAMES)
    write_mesh(session, job, plan, made)
    return made


def pick(session: Session, job: Job, case: Case, plan: Plan, made: Prepared) -> None:
    """Finds what the case picks; the plan says what it takes."""
    sizes = case.of(g.Size)
    plan.anew = session.meshed() and case.has(g.Size, g.Cut, g.Join)
    if sizes:
        plan.point_size, plan.background = session.own_sizes(job.folder)
    picks = Picks(session.look(), case, job.cad)
    if apart := picks.choose():
        plan.operations.append(["apart", apart])
        _, called, _ = session.operate(plan.operations)
        picks = Picks(session.look(), case, job.cad, called)
        if picks.choose():
            both = "bodies that share a face with two others cannot be taken apart"
            raise Refusal(f"{both}; allowed: apart in the geometry")
    picks.check_ties()

    def tell() -> None:
        if picks.wishes() and (job.cad or job.check):
            made.touch = picks.untold()
        if job.check:
            made.table, made.faces, made.names = picks.table(), picks.pieces(), picks.names()

    groups = [(d, name) for _, d, name, _ in picks.wishes() if Group(d, name) not in case.apart()]
    if operations := picks.operations():
        tell()
        before, plan.rename = picks, True
        groups = [*picks.made.groups, *groups]
        plan.operations += operations
        pieces, _, overlap = session.operate(operations)
        picks = Picks(session.look(), case, job.cad)
        picks.after(before, pieces, overlap)
        if job.check:
            made.table, made.faces = made.table + picks.table_of_cuts(), picks.pieces()
    closer: list[tuple[Any, float]] = []
    for turn in range(TURNS + 1):
        picks.store.asks = turn < TURNS
        plan.sizes = picks.sizes()
        if turn == TURNS or picks.store.finest == np.inf:
            break
        closer.append((picks.store.closer(), picks.store.finest))
        picks.renew(session.look(closer))
    if not operations:
        tell()
    plan.groups = [(d, name, picks.of(d, name)) for d, name in groups]
    made.left = picks.left()


def pick_from_mesh(gmsh: Any, job: Job, picks_any: bool) -> Prepared:
    """As make(), of a mesh in which elements have the numbers of the bodies and faces of a geometry."""
    session = Session(gmsh, job.file, job.space, False)
    session.open([])
    made = Prepared(session.groups())
    assert job.read
    case = job.read(made.groups, {})
    picks = Picks(session.look(), case)
    if picks_any:
        if not picks.made.pieces:
            none = f"the mesh has no {picks.many(picks.dimension - 1)} with numbers"
            line = next(s.line for s in case.statements if isinstance(s, (g.PickedGroup, g.Join)))
            raise Refusal(f"{none}; allowed: groups of the file's own, plane, box, near, or a geometry", line)
        if picks.choose():
            allowed = 'a STEP or BREP file, or a .geo file with SetFactory("OpenCASCADE")'
            raise Refusal(f"bodies of it cannot be cut, joined or taken apart: a mesh; allowed: {allowed}")
        picks.check_ties()
    if job.check and picks.made.bodies and not picks.bare():
        made.table, made.faces, made.names = picks.table(), picks.pieces(), picks.names()
    if picks_any:
        session.open([])  # the outline is of second order
        session.apply(Plan(groups=[(d, name, picks.of(d, name)) for _, d, name, _ in picks.wishes()]), False)
        made.mesh = str(job.folder / "picked.msh")
        session.write(Path(made.mesh), False)
    return made


def write_mesh(session: Session, job: Job, plan: Plan, made: Prepared) -> None:
    """Makes the mesh where meshes are kept, unless it is there; else in the run's folder."""
    text = json.dumps(asdict(plan))
    name = f"own-{job.key(text)}"
    for place in (job.cache, job.folder):
        if place is None:
            continue
        mesh, surface = place / f"{name}.msh", place / f"{name}-surface.msh"
        work = job.work(place)
        try:
            if not mesh.is_file():
                place.mkdir(parents=True, exist_ok=True)
                tidy(place)
                work.mkdir(exist_ok=True)
                session.make(plan, work / mesh.name, work / surface.name if job.space else None)
                if not whole(work / mesh.name):
                    continue
                if (work / surface.name).is_file():
                    (work / surface.name).replace(surface)
                (work / mesh.name).replace(mesh)
        except OSError:
            continue
        finally:
            shutil.rmtree(work, ignore_errors=True)
        if write_whole(place / f"{name}.plan", text):
            made.mesh, made.surface = str(mesh), str(surface) if surface.is_file() else ""
            made.plan = str(place / f"{name}.plan")
            return
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(job.folder))


def tidy(place: Path) -> None:
    """Removes what killed runs of this computer have left."""
    for left in place.glob(f"{MAKING}*"):
        if not Path("/proc", left.name.rpartition("-")[2]).exists():
            shutil.rmtree(left, ignore_errors=True)


# ---------------------------------------------------------------- meshes after the first, and of others


def again(
    file: Path, space: bool, plan: Path, view: Path, out: Path, limit: float = float("inf"), say: bool = False
) -> Path | None:
    """The mesh `out` of a geometry that has been read, with the sizes of a view; in space the one of its surfaces.

    plan: the file that prepare() names.
    """
    known = Plan(**json.loads(plan.read_text()))
    no_other = [("Mesh.MeshSizeFromPoints", "0"), ("Mesh.MeshSizeExtendFromBoundary", "0")]
    known.options += [word for option in no_other for word in ("-setnumber", *option)]
    surface = out.with_name(f"{out.name}.surface.msh") if space else None
    for old in (out, surface):
        if old:
            old.unlink(missing_ok=True)

    def task(gmsh: Any) -> None:
        Session(gmsh, file, space, known.cad).make(known, out, surface, view)

    in_child(task, file.name if say else "", limit)
    if not whole(out):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(out))
    return surface if surface and surface.is_file() else None


def refuse_surface(file: Path) -> None:
    if file.suffix.lower() == ".stl":
        geometries = "a geometry (.geo, .step, .iges, .brep), or a mesh of the bodies"
        raise GmshError(f"the triangles of a surface alone, without bodies and names; allowed: {geometries}")


def convert(file: Path, out: Path, limit: float = float("inf"), named: bool = True) -> None:
    """A mesh that gmsh reads (.msh of other versions or binary, .unv, .bdf, .med), as version 2 text.

    named: it has groups.
    """
    check_file(file, ())
    refuse_surface(file)

    def task(gmsh: Any) -> None:
        session = Session(gmsh, file, True, False)
        session.open([])
        if named and not session.groups():
            raise GmshError(NO_NAMES)
        session.write(out, False)

    in_child(task, file.name, limit)
    if not whole(out, named):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(out))
