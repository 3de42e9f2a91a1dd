"""Whether both readers make the same of geometries: `python tests/campaigns/geometries.py [WORDS] [-mutated N]`.

edp/bodies/readable.sh, with gmsh's program, and the Python package edp/case/reader, with gmsh's module, read all
geometries in the package with their cases, those of tests that have both, and N mutated ones (120 unless given): Exit;,
endless loops, Mesh 3;, fields, syntax errors, cut texts, empty files. -seed K makes others, -keep FOLDER keeps those of
tests. Compared are the refusals, the tables of -check 1, what is left out and what touches, the picture's triangles,
and the meshes: nodes, elements and groups. EXPECTED explains the differences that are wanted. Exit code 1: one that it
does not explain, printed.
"""

import hashlib
import importlib.util
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from faces import KINDS, differences

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "edp/case"), str(ROOT / "tests")]

from reader import Refusal, Where, read_case  # noqa: E402
from reader.gmsh_process import GmshError  # noqa: E402
from reader.mesher import prepare  # noqa: E402

TESTS = ["cad", "own_mesh", "sizes", "parts", "zoo", "named_groups"]
SECONDS = 20  # of an endless geometry
EXPECTED = {
    "gmsh makes no mesh of it": "it says why: Exit, or a crash",
    "cannot be cut, joined or taken apart": "gmsh's own words differ between its language and its module",
    "table:   join ": "faces of one area: the bodies' order, awk's by rounding",
    "a row less": "a coarser outline of CAD for a table alone",
    "no physical ": "a group without a face is none, and names are listed in the file's order",
    "no surface in it": "an empty geometry says so",
    "the mesh or geometry has a group of this name": "two faults in one line",
}
CLOSER = "where an outline is made again, closer to its curves, awk takes pieces in an order of its own"
CUTS = "cuts have other numbers, and gmsh meshes bodies in the order of these"


@dataclass
class Job:
    """A geometry and a case, or none."""

    name: str
    file: Path
    case: Path | None
    space: bool
    sets: str = ""


def module():
    """Lets Pythons without gmsh's module use that of the system."""
    if importlib.util.find_spec("gmsh") is None:
        spec = importlib.util.spec_from_file_location("gmsh", "/usr/lib/python3/dist-packages/gmsh.py")
        sys.modules["gmsh"] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules["gmsh"])


# ---------------------------------------------------------------- what is read


def is_space(file):
    text = file.read_text(errors="replace")
    return file.suffix != ".geo" or bool(re.search(r"Volume|Extrude|Sphere|Box|Cylinder\(", text))


def shipped():
    for folder in ("edp/examples", "edp/labs", "edp/tutorials", "tests/data", "tests/verification", "tests/campaigns"):
        for file in sorted((ROOT / folder).rglob("*.*")):
            if file.suffix.lower()[1:] in KINDS:
                name = str(file.relative_to(ROOT))
                yield Job(name, file, None, is_space(file))
                for case in sorted(file.parent.glob("*.case")):
                    yield Job(f"{name} {case.name}", file, case, is_space(file))


class Recorder:
    """Keeps each geometry that a test reads with its case, and ends the test there."""

    def __init__(self, folder):
        self.folder, self.count, self.test = folder, 0, ""

    def pytest_runtest_setup(self, item):
        self.test = item.nodeid

    def pytest_configure(self, config):
        import freefem

        run, self.seen = subprocess.run, set()

        def instead(command, *args, **words):
            given = list(map(str, command)) if isinstance(command, (list, tuple)) else []
            here = Path(words.get("cwd") or ".")
            if any("readable.sh" in word for word in given[:2]):
                _, _, _, mesh, _, case, space, *more = [*given, "", "", ""]
                self.keep(here / mesh, case if case == "none" else here / case, space == "1", [*more, "", ""][1])
            if given and "FreeFem" in given[0]:
                self.of_run(given, here)
            return run(command, *args, **words)

        subprocess.run = instead
        freefem.execute = lambda words, cwd=ROOT, env=None: self.of_run(list(map(str, words)), Path(cwd or ROOT))

    def of_run(self, given, here):
        flags = dict(pairwise(given))
        sets = " ".join(f"-setnumber {w.replace('=', ' ')}" for w in flags.get("-set", "").split(",") if w)
        if "-mesh" in flags:
            case = flags.get("-case", "none")
            self.keep(here / flags["-mesh"], case if case == "none" else here / case, "3d" in " ".join(given), sets)
        raise RuntimeError("recorded")

    def keep(self, mesh, case, space, sets):
        text = Path(case).read_bytes() if case != "none" and Path(case).is_file() else b""
        if mesh.suffix.lower()[1:] in KINDS and mesh.is_file():
            key = hashlib.sha256(mesh.read_bytes() + text + sets.encode()).hexdigest()
            if key in self.seen:
                raise RuntimeError("recorded")
            self.seen.add(key)
            to = self.folder / f"{self.count:04}"
            self.count += 1
            to.mkdir()
            shutil.copy(mesh, to / f"a{mesh.suffix}")
            if text:
                (to / "a.case").write_bytes(text)
            about = {"name": f"{self.test} {mesh.name}", "space": space, "sets": sets, "mesh": mesh.suffix}
            (to / "about.json").write_text(json.dumps(about))
        raise RuntimeError("recorded")


def of_tests(folder):
    """Jobs of tests, which are run up to the reading of their geometry."""
    import pytest

    folder.mkdir()
    files = [str(ROOT / f"tests/test_{name}.py") for name in TESTS if (ROOT / f"tests/test_{name}.py").exists()]
    output = sys.stdout
    with open(folder / "log", "w") as sys.stdout:
        words = ["-q", "-m", "", "--tb=no", "-p", "no:cacheprovider", "-p", "no:xdist", "--basetemp", f"{folder}-base"]
        pytest.main([*words, *files], plugins=[Recorder(folder)])
    sys.stdout = output


def recorded(folder):
    for about in sorted(folder.glob("*/about.json")):
        told = json.loads(about.read_text())
        case = about.parent / "a.case"
        file = about.parent / f"a{told['mesh']}"
        yield Job(told["name"], file, case if case.exists() else None, told["space"], told["sets"])


def mutated(jobs, count, seed, folder):
    """Geometries that are programs of another kind than their authors wrote."""
    rng, folder = random.Random(seed), folder / "mutated"
    folder.mkdir()
    jobs = [job for job in jobs if job.file.suffix == ".geo"]
    added = [
        "Exit;", "For k In {0 : 1e15}\nEndFor", "Mesh 1;", "Mesh 2;", "Mesh 3;", "Delete Physicals;", "foo bar",
        "Field[1] = MathEval; Field[1].F = \"0.7\"; Background Field = 1;",
        "Mesh.Algorithm = 8; Mesh.RecombineAll = 1;",
        "Field[3] = Box; Field[3].VIn = 0.1; Field[3].VOut = 2; Background Field = 3;", "MeshSize{:} = 1e-22;",
        'Physical Surface("a \\" b") = {1};', "Mesh.ElementOrder = 2;", "Mesh.SaveAll = 1;", "Mesh.MeshSizeFactor = 2;",
        "Delete Surface{:};", "Recursive Delete { Volume{:}; }", "Mesh.MshFileVersion = 4;", "Mesh.Binary = 1;",
        "Coherence;", "Merge \"none.step\";", "General.AbortOnError = 1;", "Geometry.AutoCoherence = 0;",
        "Error(\"no\");",
        "Printf(\"%g\", 1) > \"/dev/full\";", "SystemCall \"true\";", "Transfinite Curve{:} = 3;", "Abort;",
    ]  # fmt: skip
    for k in range(count):
        job = rng.choice(jobs)
        lines = job.file.read_text(errors="replace").splitlines()
        how = rng.choice(["add", "add", "add", "drop", "cut", "swap", "number", "empty"])
        what = ""
        if how == "add":
            what = added[k % len(added)]
            lines.insert(rng.choice([0, len(lines), rng.randrange(len(lines) + 1)]), what)
        elif how == "drop":
            del lines[rng.randrange(len(lines))]
        elif how == "cut":
            lines = "\n".join(lines)[: rng.randrange(len("\n".join(lines)))].splitlines()
        elif how == "swap":
            i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
            lines[i], lines[j] = lines[j], lines[i]
        elif how == "number":
            at = rng.randrange(len(lines))
            lines[at] = re.sub(r"\d+", lambda m: rng.choice(["0", "-1", "7", "1e9", m[0]]), lines[at])
        else:
            lines = []
        file = folder / f"{k:03}.geo"
        file.write_text("\n".join(lines) + "\n")
        yield Job(f"mutated {k:03} {how} {what} of {job.name}", file, job.case, job.space, job.sets)


# ---------------------------------------------------------------- what is made of it


@dataclass
class Made:
    """What a reader makes of a job."""

    why: str = ""
    table: str = ""
    left: str = ""
    touch: str = ""
    faces: str = ""
    mesh: tuple = ()
    surface: int = 0
    closer: bool = False
    seconds: float = 0.0


def seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN), resource.getrusage(resource.RUSAGE_SELF)
    return sum(each.ru_utime + each.ru_stime for each in used)


def mesh_of(path):
    """(places of nodes, elements by kind and names of their groups) of a mesh in gmsh's version 2 text."""
    rows = [row for row in Path(path).read_text(errors="replace").splitlines()]
    names, nodes, elements = {}, {}, {}
    at = rows.index("$PhysicalNames") + 2 if "$PhysicalNames" in rows else len(rows)
    while at < len(rows) and rows[at] != "$EndPhysicalNames":
        dimension, tag, name = rows[at].split(" ", 2)
        names[int(dimension), int(tag)] = name
        at += 1
    at = rows.index("$Nodes") + 2
    for row in rows[at : at + int(rows[at - 1])]:
        tag, *place = row.split()
        nodes[int(tag)] = tuple(map(float, place))
    at = rows.index("$Elements") + 2
    for row in rows[at : at + int(rows[at - 1])]:
        word = list(map(int, row.split()))
        dimension = {15: 0, 1: 1, 8: 1, 26: 1}.get(word[1], 2 if word[1] in (2, 3, 9, 10, 16, 20, 21) else 3)
        name = names.get((dimension, word[3]), str(word[3]))
        corners = np.array([nodes[node] for node in word[3 + word[2] :]])
        elements.setdefault((word[1], name), []).append(np.round(corners, 9).mean(0))
    return len(nodes), {key: np.array(rows) for key, rows in elements.items()}


def with_awk(job, folder):
    folder.mkdir()
    begun, read = seconds(), folder / "read"
    words = [str(os.getpid()), job.file, read, job.case or "none", str(int(job.space)), "check", job.sets]
    cache = {"CONTACT_CACHE": str(folder / "cache"), "LC_ALL": "C", "RUBS": "1", "WEARS": "1", "FLOWS": "1"}
    run = subprocess.Popen(
        ["sh", ROOT / "edp/bodies/readable.sh", *map(str, words)],
        env=os.environ | cache,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        code = run.wait(300 if "mutated" not in job.name else SECONDS)
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, 15)
        run.wait()
        time.sleep(2)
        return Made(why="endless", seconds=seconds() - begun)
    made = Made(seconds=seconds() - begun)
    if code in (0, 4):
        made.table = text_of(read / "table")
        made.faces = text_of(read / "faces")
    # the mesh reader's refusals come after gmsh's work
    meshes = sorted((folder / "cache/meshes").glob("own-*.msh")) + sorted(read.glob("converted.msh"))
    plain = [mesh for mesh in meshes if "surface" not in mesh.name]
    if plain and code == 0:
        told = text_of(read / "told").split("\n")
        made.left, made.touch = told[3], "\n".join(told[5:]).strip()
    if plain:
        made.mesh = mesh_of(plain[0])
        made.surface = len(meshes) - len(plain) or int((read / "surface.msh").exists())
    made.closer = bool(text_of(read / "closer.geo"))
    why = text_of(read / "why").strip()
    made.why = why if code not in (0, 4) else ""
    return made


def text_of(path):
    return path.read_text(errors="replace") if path.exists() else ""


def with_python(job, folder):
    folder.mkdir()
    begun = seconds()
    text = job.case.read_text(errors="surrogateescape") if job.case else None
    words = job.sets.split()
    sets = [(words[k + 1], float(words[k + 2])) for k in range(0, len(words), 3)]

    def read(groups, bodies):
        return read_case(text, Where(space=job.space, bodies=bodies), groups)

    limit = SECONDS if "mutated" in job.name else 300
    made = Made()
    try:
        new = prepare(job.file, job.space, text, read if job.case else None, folder, sets, True, folder, limit)
        made = Made("", new.table, new.left, "\n".join(new.touch), new.faces, (), int(bool(new.surface)))
        if new.mesh:
            made.mesh = mesh_of(new.mesh)
    except GmshError as error:
        made.why = "endless" if "takes longer" in str(error) else str(error)
    except Refusal as error:
        made.why = error.text(str(job.case))
    made.seconds = seconds() - begun
    return made


# ---------------------------------------------------------------- differences


def apart(a, b):
    """How far places are from those of another list that are not in both."""
    size = 1e-7 * np.abs(a).max()
    rows = [{tuple(row) for row in np.round(each / size).astype(int)} for each in (a, b)]
    if rows[0] == rows[1]:
        return 0.0
    odd = [np.array([list(row) for row in one - other]) for one, other in (rows, rows[::-1])]
    if not len(odd[0]) or not len(odd[1]):
        return 0.0
    return max(np.abs(odd[1] - row).max(axis=1).min() for row in odd[0]) * size * (1 - 1e-9) - size


def of_meshes(old, new):
    if not old or not new:
        return []
    if old[0] != new[0]:
        return [f"nodes: {old[0]} and {new[0]}"]
    found = []
    for key in sorted(old[1].keys() | new[1].keys(), key=str):
        a, b = old[1].get(key, np.zeros((0, 3))), new[1].get(key, np.zeros((0, 3)))
        if len(a) != len(b):
            found.append(f"elements {key}: {len(a)} and {len(b)}")
        elif len(a) and (off := apart(a, b)) > 1e-8 * np.abs(a).max():
            found.append(f"elements {key}: places differ by {off:.2g}")
    return found


def compare(old, new):
    """Lines that say how two results differ."""
    if old.why != new.why and not (old.mesh and new.mesh):
        if (old.why and new.why) or not (old.mesh or new.mesh):
            return [f"refusal: {old.why or '-'}\n      now: {new.why or '-'}"]
        return [f"ONE REFUSES: {old.why or '-'}\n      now: {new.why or '-'}"]
    if old.why:  # by the mesh reader, which is another's
        return of_meshes(old.mesh, new.mesh)
    found = [f"table: {a}\n      now: {b}" for a, b in differences(old.table, new.table)]
    found += [f"{word}: {a!r}\n      now: {b!r}" for word in ("left", "touch", "surface")
              if (a := getattr(old, word)) != (b := getattr(new, word))]  # fmt: skip
    rows = [
        np.genfromtxt(text.splitlines()[1:], delimiter=",", ndmin=2) if text.count("\n") > 1 else np.zeros((0, 2))
        for text in (old.faces, new.faces)
    ]
    for each in rows:
        each[each[:, 0] < 0, 0] = -1  # faces of cuts have new numbers
    if {(face, body) for face, body, *_ in rows[0]} != {(face, body) for face, body, *_ in rows[1]}:
        found.append("picture: faces or bodies")
    elif rows[0].shape != rows[1].shape:
        found.append(f"picture: a row less or more: {len(rows[0])} and {len(rows[1])}")
    elif apart(*rows) > 1e-6 * np.abs(rows[0][:, 2:]).max(initial=0):
        found.append("picture: places")
    return found + of_meshes(old.mesh, new.mesh)


def main(*words):
    module()
    flags = {"-mutated": "120", "-seed": "1", "-keep": ""}
    words = list(words)
    for flag in flags:
        if flag in words:
            at = words.index(flag)
            flags[flag] = words[at + 1]
            del words[at : at + 2]
    wrong, times, count = 0, [0.0, 0.0], 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        kept = Path(flags["-keep"]) if flags["-keep"] else folder / "recorded"
        if not kept.exists():
            of_tests(kept)
        jobs = [*shipped(), *recorded(kept)]
        jobs += mutated(jobs, int(flags["-mutated"]), int(flags["-seed"]), folder)
        for k, job in enumerate(jobs):
            if words and not any(word in job.name for word in words):
                continue
            old, new = with_awk(job, folder / f"old{k}"), with_python(job, folder / f"new{k}")
            count, times = count + 1, [times[0] + old.seconds, times[1] + new.seconds]
            found = compare(old, new)
            known = [why for text, why in EXPECTED.items() if any(text in line for line in found)]
            known = known if all(any(text in line for text in EXPECTED) for line in found) else []
            is_cut = job.case and re.search(rb"^cut ", job.case.read_bytes(), re.M)
            if is_cut and not old.why and not new.why and not any("nodes:" in line for line in found):
                known.append(CUTS)
            if old.closer and new.mesh and old.mesh and abs(old.mesh[0] - new.mesh[0]) < 0.05 * old.mesh[0]:
                known.append(CLOSER)
            wrong += bool(found and not known)
            print(
                f"{job.name}: {old.why[:60] or (new.mesh and new.mesh[0]) or 'table'}; {len(found)} differ"
                f"{f' ({known[0]})' if known else ''}, {old.seconds:.2f} and {new.seconds:.2f} CPU s",
                flush=True,
            )
            for line in found[:4] if not known else []:
                print(f"    {line[:1200]}", flush=True)
            for out in ("old", "new"):
                shutil.rmtree(folder / f"{out}{k}", ignore_errors=True)
    print(f"{count} geometries, {wrong} with differences; {times[0]:.1f} and {times[1]:.1f} CPU s")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
