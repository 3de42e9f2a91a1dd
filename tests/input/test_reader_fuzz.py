"""The reader on spoilt cases, meshes and geometries: it reads them, or refuses them in one line, and always ends.

Words, lines and bytes of good files are changed at random, by a seed each. No other exception than a refusal may leave
the reader; a refusal writes nothing but its reason, and no process is left. Quick are a few of each kind.
"""

import contextlib
import os
import random
import re
from pathlib import Path

import pytest
from freefem import ROOT
from physics import test_heat
from reader import Group, Refusal, Where, read_case
from reader.fields import STATEMENTS
from reader.gmsh_process import GmshError
from reader.mesher import prepare
from reader.modules import Run, modules, needs
from reader.problem import Problem, run
from reader.values import table
from reader.words import LONGEST, split_case

from input import test_reader

CASES = [path.read_text() for path in sorted((ROOT / "edp").glob("*/*/*.case"))]
CASES += [test_heat.CASE, test_reader.GOOD, test_reader.GOOD_SPACE, test_reader.LEGS]
NUMBERS = "0 -0 1 -1 7 1e400 1e-400 nan inf -inf 0x10 1_000 1e 1e+ .5 5. +.5e-3 ٣ 0.5 1e40 1e-41 1e20 1.5".split()
NUMBERS += ["99999999999999999999", "9" * 5000]
KEYWORDS = sorted({word for cls in STATEMENTS.values() for word in re.findall("[A-Za-z]+", cls.example + cls.usage)})
ODD = [
    "",
    '"',
    '""',
    '"a b"',
    "#",
    "\x00",
    "\x1b[31m",
    "\r",
    "\t",
    "é",
    "\udcff",
    "\u2028",
    "\ufeff",
    "a" * 5000,
    "{|}",
    "%s",
]


def changed(rng, words, pool):
    """Some words exchanged, left out, said twice, moved, or taken from the pool."""
    words = list(words)
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        at = rng.randrange(len(words) + 1)
        how = rng.randrange(6)
        if how == 0 and words:
            del words[min(at, len(words) - 1)]
        elif how == 1 and words:
            words.insert(at, rng.choice(words))
        elif how == 2 and words:
            i, j = rng.randrange(len(words)), rng.randrange(len(words))
            words[i], words[j] = words[j], words[i]
        elif how == 3 and words:
            k = rng.randrange(len(words))
            letter = rng.randrange(len(words[k]) + 1)
            words[k] = words[k][:letter] + rng.choice('abe0.-"# \x01é') + words[k][letter + rng.randrange(2) :]
        else:
            words[at : at + rng.randrange(2)] = [rng.choice(pool)]
    return words


def spoilt_case(rng):
    """A case whose lines, and words of lines, are changed."""
    lines = rng.choice(CASES).split("\n")
    if rng.random() < 0.4:
        lines = changed(rng, lines, [line for case in CASES for line in case.split("\n")])
    for _ in range(rng.randrange(3)):
        k = rng.randrange(len(lines)) if lines else 0
        pool = rng.choice((NUMBERS, KEYWORDS, list(STATEMENTS), ODD))
        lines[k : k + 1] = [" ".join(changed(rng, lines[k].split() if lines else [], pool))]
    return rng.choice("\n\n\n\n\r").join(lines)


def told(refusal):
    """A refusal is one line that a terminal takes."""
    text = refusal.text("a.case")
    assert len(text) < LONGEST + 20 and not re.search("[\x00-\x1f\x7f]", text), text


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("part", range(25))
def test_cases(part):
    """200 cases: before the mesh is known, and with all words as groups."""
    for seed in range(200 * part, 200 * part + 200):
        rng = random.Random(seed)
        text = spoilt_case(rng)
        space = ("sphere" in text or "state" not in text) ^ (rng.random() < 0.2)
        with contextlib.suppress(Refusal):
            words = dict.fromkeys(word for line in split_case(text, lambda word: "") for word in line.words)
            groups = [Group(2 + space - (k + rng.randrange(2)) % 2, word) for k, word in enumerate(words)]
            for known in (None, groups):
                try:
                    case = read_case(text, Where(space=space, overlap=True), known)
                    modules(needs(case), Run(space=space))
                    assert table(case).endswith("\n")
                except Refusal as refusal:
                    told(refusal)


# ---------------------------------------------------------------- meshes

PLANE = """body block E 100 nu 0.3
clamp bottom
obstacle top circle 0.5 2 R 1 move 0 -0.1
"""
NODES = [(x, y) for y in (0, 0.5, 1) for x in (0, 0.5, 1)]
CORNERS = [(a, a + 1, a + 4, a + 3) for a in (1, 2, 4, 5)]
HEAD = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", '1 1 "bottom"', '1 2 "top"', '2 3 "block"']
LINES = [f"1 2 {tag} {tag} {a} {a + 1}" for tag, a in ((1, 1), (1, 2), (2, 7), (2, 8))]
TRIANGLES = [f"2 2 3 1 {t}" for a, b, c, d in CORNERS for t in (f"{a} {b} {c}", f"{a} {c} {d}")]
MSH = "\n".join([
    *HEAD, "$EndPhysicalNames", "$Nodes", "9", *(f"{k + 1} {x} {y} 0" for k, (x, y) in enumerate(NODES)), "$EndNodes",
    "$Elements", "12", *(f"{k + 1} {each}" for k, each in enumerate(LINES + TRIANGLES)), "$EndElements", "",
])  # fmt: skip
INP = "\n".join([
    "*NODE", *(f"{k + 1}, {x}, {y}" for k, (x, y) in enumerate(NODES)), "*ELEMENT, TYPE=CPE4, ELSET=block",
    *(f"{k + 1}, {', '.join(map(str, corners))}" for k, corners in enumerate(CORNERS)),
    "*NSET, NSET=bottom", "1, 2, 3", "*SURFACE, NAME=top", "3, S3", "4, S3", "",
])  # fmt: skip
IN_FILES = "$Nodes $EndNodes $Elements *NODE *STEP *PART *INCLUDE *NSET,NSET=top,GENERATE *ELSET,ELSET=x 2.2 4.1 -3"
IN_FILES = [*IN_FILES.split(), "1,9,0", "99"]
PICKS = [
    "group top plane 0 1 0 1\n",
    "group bottom near 0.5 0\n",
    "group block box -1 -1 2 2\n",
    "group a elements 1 side 1\n",
]


def spoilt_mesh(rng, text):
    lines = text.split("\n")
    blank = ", " if "*NODE" in text else " "
    for _ in range(rng.choice((0, 1, 1, 2))):
        k, pool = rng.randrange(len(lines)), rng.choice((NUMBERS, IN_FILES, ODD))
        lines[k] = blank.join(changed(rng, lines[k].split(blank), pool))
    if rng.random() < 0.4:
        lines = changed(rng, lines, IN_FILES)
    made = "\n".join(lines).encode(errors="surrogateescape")
    if rng.random() < 0.2:
        at = rng.randrange(len(made))
        made = made[:at] + rng.choice((b"", bytes([rng.randrange(256)]) + made[at + 1 :]))
    return made


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("part", range(10))
def test_meshes(tmp_path, part):
    """100 meshes, half of them decks: codes of readings that ended, and nothing but the reason in the folder."""
    for seed in range(100 * part, 100 * part + 100):
        rng = random.Random(seed)
        mesh, case, folder = tmp_path / f"a{('.msh', '.inp')[seed % 2]}", tmp_path / "a.case", tmp_path / f"{seed}"
        folder.mkdir()
        mesh.write_bytes(spoilt_mesh(rng, (MSH, INP)[seed % 2]))
        case.write_text(PLANE + rng.choice(PICKS) * (rng.random() < 0.3))
        code = run(Problem(mesh, str(case), folder, Where()))
        files = {path.name for path in folder.iterdir()}
        assert code in (0, 1, 3), seed
        assert "mesh.msh" in files if code == 0 else files <= {"why", "converted.msh", "picked.msh"}, (seed, files)
        if code:
            assert (folder / "why").read_text(errors="surrogateescape").count("\n") == 1


# ---------------------------------------------------------------- geometries

GEO = """SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Disk(2) = {0.5, 1.5, 0, 0.5};
Physical Surface("block") = {1};
Physical Surface("disc") = {2};
Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Curve("round") = {5};
Mesh.MeshSizeMax = 0.3;
"""
ROUND = "body block E 1 nu 0.3\nbody disc E 1 nu 0.3\ncontact top round\nclamp bottom\nweight disc 0 -1\n"
SPOILT = [
    "Exit;",
    "Abort;",
    "While (1)\nEndWhile",
    "For k In {0:1e15}\nEndFor",
    "Mesh 2;",
    "Mesh 3;",
    "Error('no');",
    "Coherence;",
]
SPOILT += ['Field[1] = MathEval;\nField[1].F = "0.2";\nBackground Field = 1;', "Field[1] = Box;\nBackground Field = 7;"]
SPOILT += [
    "Delete { Surface{1}; }",
    "Delete Physicals;",
    "Mesh.ElementOrder = 9;",
    "Mesh.Algorithm = 77;",
    "Include 'no.geo';",
]
SPOILT += ["Merge 'a.geo';", "Point(1) = {", "x = 1 / 0;", "x = nothing;", "Rotate {{0,0,1},{0,0,0},1} { Surface{1}; }"]
SPOILT += [
    "Printf('%s', 3);",
    "Mesh.MeshSizeMax = 1e-300;",
    "Mesh.MeshSizeMax = 1e300;",
    "NewModel;",
    'Physical Curve("\\x01") = {4};',
]
SIZES = ["", "size contact 0.1\n", "size disc 0.2\n", "group left near 0 0.5\n", "group a surfaces 9\n"]


def no_child():
    """Whether all children have been waited for."""
    try:
        os.waitpid(-1, os.WNOHANG)
    except ChildProcessError:
        return True
    return False


@pytest.mark.parametrize("part", range(10))
def test_geometries(tmp_path, part):
    """10 geometries: read, or refused, within the limit, and no process is left, nor a file of one that was refused."""
    for seed in range(10 * part, 10 * part + 10):
        rng = random.Random(seed)
        lines = GEO.split("\n")
        for first in (True, *[False] * rng.randrange(2)):
            lines.insert(rng.randrange(1, len(lines)), SPOILT[seed % len(SPOILT)] if first else rng.choice(SPOILT))
        if rng.random() < 0.3:
            lines = changed(rng, lines, SPOILT)
        geo, folder = tmp_path / "a.geo", tmp_path / f"{seed}"
        folder.mkdir()
        geo.write_text("\n".join(lines), errors="surrogateescape")
        text = ROUND + rng.choice(SIZES)

        def read(groups, bodies, text=text):
            return read_case(text, Where(bodies=bodies), groups)

        try:
            made = prepare(geo, False, text, read, folder, cache=tmp_path / "cache", limit=3)
            assert Path(made.mesh).is_file() and made.case
        except (Refusal, GmshError) as error:
            assert str(error) and not list(folder.iterdir()), seed
        assert no_child() and not list(folder.rglob(".making*")), seed
        assert not list((tmp_path / "cache").glob(".making*")), seed
