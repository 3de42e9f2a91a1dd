"""Whether the two readers of meshes agree: `python tests/campaigns/bodies.py FOLDER [MUTATED] [SEED]`.

FOLDER/bin/awk, made by the first start, stands for awk: it keeps what edp/bodies/readable.sh gives to meshes/*.awk and
what these answer, for every run with FOLDER/bin in front of PATH. Without captures there, the examples' and the tests'
cases are read so. More come from `PATH=FOLDER/bin:$PATH make test TESTS="tests/test_zoo.py tests/test_cad.py"`.
The Python package reads each captured mesh, and so many mutated ones (500 unless given): numbers and lines spoilt,
dropped, doubled and exchanged. Compared are all files byte by byte, except rises, whose order awk leaves to its hashes:
these as sets of edges, their numbers to 1e-14 of the largest; and the refusals, letter by letter. EXPECTED explains the
differences that are wanted. Exit code 1: one that it does not explain.
"""

import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "edp/case"))

from reader import Group, Refusal, Where, read_case  # noqa: E402
from reader.abaqus import listing, read_inp  # noqa: E402
from reader.bodies import with_split, write_bodies  # noqa: E402
from reader.mesh import MeshRefusal  # noqa: E402
from reader.msh import read_msh  # noqa: E402
from reader.rows import rows  # noqa: E402

AWK = shutil.which("awk", path="/usr/bin:/bin") or "awk"
FILES = "MESH REGIONS MIDDLES CURVES RISES NOTES".split()
SHIM = """#!/bin/sh
case "$*" in
*case-file.awk*)
    before=; last=
    for word; do before=$last; last=$word; done
    cp "$last" FOLDER/case-$PPID; cp "$before" FOLDER/names-$PPID; env > FOLDER/env-$PPID ;;
*inp.awk*)
    for last; do :; done
    test -n "$LISTED" || cp "$last" FOLDER/deck-$PPID ;;
*parts.awk*)
    d=$(mktemp -d FOLDER/got-XXXXXX)
    cat > $d/in.msh
    cp "$CASE" $d/table
    for name in case names env deck; do test ! -e FOLDER/$name-$PPID || cp FOLDER/$name-$PPID $d/$name; done
    test -z "$SURFACE" || cp "$SURFACE" $d/surface.msh
    AWK "$@" < $d/in.msh > $d/why
    code=$?
    cat $d/why
    printf '%s\\n' "$SPACE" "$STRAIGHT" $code > $d/how
    cp "$CASE" $d/split
    for file in "$MESH" "$REGIONS" "$MIDDLES" "$CURVES" "$RISES" "$NOTES"; do test ! -e "$file" || cp "$file" $d/; done
    exit $code ;;
esac
exec AWK "$@"
"""
# what awk says -> what Python says: differences that are wanted
SECTION = "two mistakes: a section is read as a whole before its elements are understood"
EXPECTED = {
    "numbers of a copy's elements": "awk numbers the elements of a deck or of a cut mesh anew, Python says their own",
    r"-> '\$\w+ has \d+ lines, and says": SECTION,
    r"cut off.* -> .(element|line)": SECTION,
    r"-> 'element \d+ \(line \d+\): \d+ numbers; cut off": SECTION,
    r"-> '(cut off|no physical groups)": SECTION,
    r"is there twice' -> '(node|line)": "two mistakes: nodes that cannot be read go before nodes that are there twice",
    r"no \*ELEMENT of a body; .* -> .*no \*ELEMENT of a body; ": "more types are read: another list of what is allowed",
    r"TYPE=.*: not read.* -> .*TYPE=.*: not read": "more types are read: another list of what is allowed",
    r"of gmsh's type .* -> .element": "more types are read: another list of what is allowed",
    r"-> .element \d+ \(line \d+\): of gmsh's type": SECTION,
    r"of gmsh's type .* -> ''": "elements of second order are cut",
    r"touch, but share no nodes.* -> .*touch, but share no nodes": "several cracks: awk names one by its hashes",
    r"line \d+: the node .* -> .element": SECTION,
    r"line \d+: the (node|element) \d+ is there twice.* -> '": "two mistakes: what is twice goes last",
    r"-> .*no range; allowed: from, to, step": "awk takes a range without an end for none",
    r"the coordinate \S+\\r is no number": "several returns at the ends of lines are blanks",
    r"not gmsh's version 2 text format. -> .(element|')": "several returns at the ends of lines are blanks",
    r"a node that is missing: .* -> '": SECTION,
    r"element \d+ has \d+ nodes, .* -> 'line": SECTION,
    r"-> 'line \d+: no node: number and places": "awk takes what is no number for 0",
    r"-> 'line \d+: (node|element) .*: the coordinate .* is no number": "awk takes what is no number for 0",
    r"-> 'line \d+: (node|element) .*: a node that is missing: \S*[^\d;']": "awk takes what is no number for 0",
    r"-> 'element \S+ \(line \d+\): \S+ is no number": "awk takes a number or a tag that is none for 0",
}


def shim(folder):
    (folder / "bin").mkdir(parents=True, exist_ok=True)
    program = folder / "bin/awk"
    program.write_text(SHIM.replace("FOLDER", str(folder)).replace("AWK", AWK))
    program.chmod(0o755)


def collect(folder):
    """Reads all cases whose geometry stands beside them, as a run does, and the meshes of tests/data."""
    environment = {**os.environ, "LC_ALL": "C", "RUBS": "1", "WEARS": "1", "FLOWS": "1"}
    environment["PATH"] = f"{folder / 'bin'}:{environment['PATH']}"
    cases = sorted(ROOT.glob("edp/**/*.case")) + sorted(ROOT.glob("tests/**/*.case"))
    pairs = [(geo, case) for case in cases for geo in case.parent.glob("*.geo") if geo.stem in case.stem]
    made = Path(tempfile.mkdtemp())
    for space, name in ((1, "cuboids"), (0, "rectangles")):
        case = made / f"{name}.case"
        case.write_text(
            "body lower E 210e3 nu 0.3\nbody upper E 210e3 nu 0.3\ncontact foot top\nclamp base\n"
            + ("move grip 0 0 -0.011\n" if space else "move grip 0 -0.011\n")
        )
        for brick, order, form in (
            (0, 1, "msh22"),
            (0, 2, "msh22"),
            (1, 1, "msh22"),
            (0, 1, "inp"),
            (0, 2, "inp"),
            (1, 1, "inp"),
        ):
            mesh = made / f"{name}{brick}{order}.{form[:3]}"
            words = ["-setnumber", "brick", brick, "-order", order]
            words += ["-format", form] if form == "msh22" else []
            words += ["-setnumber", "Mesh.SaveGroupsOfNodes", 1, "-setnumber", "Mesh.SaveGroupsOfElements", 1]
            geo = ROOT / f"tests/data/zoo/{name}.geo"
            command = ["gmsh", geo, f"-{2 + space}", *words, "-o", mesh]
            subprocess.run(list(map(str, command)), capture_output=True, check=True)
            pairs.append((mesh, case))
    (made / "block.case").write_text("body PART E 210e3 nu 0.3\nclamp BASE\nobstacle TOP plane 0 0 1.999 0 0 -1\n")
    pairs.append((ROOT / "tests/data/zoo/block.inp", made / "block.case"))
    for geo, case in pairs:
        space = int((geo.suffix != ".geo" and geo.stem[:4] in ("cubo", "bloc")) or "Volume" in geo.read_text())
        out = made / "out"
        command = ["sh", ROOT / "edp/bodies/readable.sh", os.getpid(), geo, out, case, space, "solve", ""]
        code = subprocess.run(list(map(str, command)), env=environment, capture_output=True, cwd=ROOT).returncode
        print(f"{code} {geo.name} {case.name} {(out / 'why').read_text().strip() if (out / 'why').exists() else ''}")
        shutil.rmtree(out, ignore_errors=True)


class Given:
    """A captured start of the awk programs."""

    def __init__(self, folder):
        self.folder = folder
        self.space, self.straight, self.code = (folder / "how").read_text().split("\n")[:3]
        env = dict(line.partition("=")[::2] for line in (folder / "env").read_text(errors="replace").splitlines())
        picked = bool(env.get("PICKS"))
        self.where = {
            "space": self.space == "1",
            "overlap": bool(env.get("SETS_OVERLAP")),
            "again": bool(env.get("AGAIN")),
        }
        self.where |= {
            "friction": env.get("RUBS", ""),
            "wear": bool(env.get("WEARS")),
            "plastic": bool(env.get("FLOWS")),
        }
        self.where |= {"bodies": env.get("BODIES", "") if picked else ""}
        lines = (folder / "names").read_text(errors="surrogateescape").splitlines()
        self.groups = [Group(int(line[0]), line[line.find('"') + 1 : line.rfind('"')]) for line in lines]
        self.text = (folder / "case").read_text(errors="surrogateescape")
        self.deck = folder / "deck" if (folder / "deck").exists() else None
        self.surface = folder / "surface.msh"

    def case(self):
        return read_case(self.text, Where(**self.where), self.groups)


def awk(given, mesh, table, folder):
    """(refusal or nothing, files) of the awk programs, as readable.sh starts them."""
    names = dict(zip(FILES, "mesh.msh regions middles curves rises notes".split(), strict=True))
    (folder / "table").write_text(table)
    environment = {**os.environ, "LC_ALL": "C", "SPACE": given.space, "STRAIGHT": given.straight, "CASE": "table"}
    environment |= {**names, "SURFACE": str(given.surface) if given.surface.exists() else ""}
    programs = [word for name in "msh parts cuts same planes".split() for word in ("-f", ROOT / f"meshes/{name}.awk")]

    def start(file):
        with file.open("rb") as text:
            how = {"stdin": text, "cwd": folder, "env": environment, "capture_output": True}
            return subprocess.run([AWK, *programs], **how)

    done = start(mesh)
    if re.search(rb"of gmsh's type [3567]: ", done.stdout):
        with (folder / "cut.msh").open("wb") as cut:
            subprocess.run([AWK, "-f", ROOT / "meshes/cut.awk", mesh, mesh], stdout=cut, env=environment, check=False)
        done = start(folder / "cut.msh")
    if done.returncode:
        return done.stdout.decode(errors="replace").strip().split("\n")[-1], {}
    found = {name: (folder / name).read_text() for name in (*names.values(), "table") if (folder / name).exists()}
    return "", found


def awk_deck(given, deck, folder):
    """The same of a deck that inp.awk reads first."""
    environment = {**os.environ, "LC_ALL": "C", "SPACE": given.space}
    with (folder / "deck.msh").open("wb") as made:
        command = [AWK, "-f", ROOT / "meshes/inp.awk", given.folder / "case", deck]
        done = subprocess.run(command, stdout=made, env=environment, check=False, capture_output=False)
    if done.returncode:
        text = (folder / "deck.msh").read_text(errors="replace").strip().split("\n")
        return text[-1], {}
    return awk(given, folder / "deck.msh", (given.folder / "table").read_text(), folder)


def python(given, mesh, folder, inp=False):
    """The same of the Python reader."""
    try:
        if inp:
            words = set(re.findall(r'[^\s"]+', re.sub("#.*", "", given.text))) | set(
                re.findall(r'"([^"]*)"', given.text)
            )
            made = read_inp(mesh, given.where["space"], words)
        else:
            made = read_msh(mesh)
        case = given.case()
        surface = read_msh(given.surface) if given.surface.exists() else None
        written = write_bodies(made, case, folder, given.where["space"], given.straight == "1", surface)
    except MeshRefusal as refusal:
        return str(refusal).encode(errors="surrogateescape").decode(errors="replace"), {}
    found = {file.name: file.read_text() for file in folder.iterdir() if file.is_file()}
    return "", {**found, "regions": written.text, "table": with_split(rows(case), written)}


def edges(text):
    rows_ = np.array([line.split() for line in text.splitlines()[1:]], float).reshape(-1, 5)
    rows_[:, :2].sort(axis=1)
    return rows_[np.lexsort(rows_[:, :2].T)]


def alike(name, one, other):
    if one == other:
        return ""
    if name == "rises":
        a, b = edges(one), edges(other)
        scale = np.abs(a).max(initial=1)
        ok = a.shape == b.shape and np.array_equal(a[:, :2], b[:, :2]) and np.abs(a - b).max() <= 1e-14 * scale
        return "" if ok else f"rises {a.shape} {b.shape}"
    if name == "regions" and sorted(one.split("\n")) == sorted(other.split("\n")):
        return ""
    lines = [(a, b) for a, b in zip(one.split("\n"), other.split("\n"), strict=False) if a != b]
    return f"{name}: {lines[:1] or 'lengths'}"


def masked(text):
    return re.sub(r"(elements?|line|and) \d+", r"\1 N", text)


def same(given, mesh, inp=False, table=None, deck=None):
    """Nothing, or how the two differ."""
    with tempfile.TemporaryDirectory() as a, tempfile.TemporaryDirectory() as b:
        if deck and deck != given.deck:
            one = awk_deck(given, deck, Path(a))
        else:
            one = awk(given, mesh, table or (given.folder / "table").read_text(), Path(a))
        renumbered = deck or (Path(a) / "cut.msh").exists()
        two = python(given, deck or mesh, Path(b), inp)
    if renumbered and one[0] and masked(one[0]) == masked(two[0]):
        return "" if one[0] == two[0] else "numbers of a copy's elements"
    if one[0] or two[0]:
        return "" if one[0].strip() == two[0].strip() else f"{one[0]!r} -> {two[0]!r}"
    told = [alike(name, one[1].get(name, ""), two[1].get(name, "")) for name in sorted({*one[1], *two[1]})]
    return "; ".join(text for text in told if text)


def spoilt(text, chance):
    """A mesh with one mistake, or a few."""
    lines = text.split("\n")
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        if not lines:
            break
        k = chance.randrange(len(lines))
        words = lines[k].split(" ")
        j = chance.randrange(len(words))
        match chance.randrange(12):
            case 0:
                del lines[k]
            case 1:
                lines.insert(k, lines[k])
            case 2:
                i = chance.randrange(len(lines))
                lines[k], lines[i] = lines[i], lines[k]
            case 3:
                del words[j]
            case 4:
                words.insert(j, words[j])
            case 5:
                words[j] = chance.choice(
                    ("0", "-1", "7", "99999999", "1e200", "nan", "x", "0x10", "1e5", "3.5", ".", "-0")
                )
            case 6:
                words[j] = words[j][: len(words[j]) // 2]
            case 7:
                i = chance.randrange(len(words))
                words[i], words[j] = words[j], words[i]
            case 8:
                lines = lines[: k + 1]
            case 9:
                if chance.random() < 0.2:
                    lines = [line + "\r" for line in lines]
            case 10:
                lines[k] = ""
                continue
            case 11:
                words = [
                    str(chance.randrange(30)) if word.isdigit() and chance.random() < 0.3 else word for word in words
                ]
        if k < len(lines):
            lines[k] = " ".join(words) if words != lines[k].split(" ") else lines[k]
    return "\n".join(lines)


def same_listing(given):
    """The same of the table of a deck's sets."""
    environment = {**os.environ, "LC_ALL": "C", "SPACE": given.space, "LISTED": "1"}
    command = [AWK, "-f", ROOT / "meshes/inp.awk", "/dev/null", given.deck]
    one = subprocess.run(command, env=environment, capture_output=True, text=True, check=False).stdout
    try:
        two = listing(given.deck, given.where["space"])
    except MeshRefusal as refusal:
        two = f"{refusal}\n"
    return "" if one == two else f"listing: {one!r} -> {two!r}"


def explained(text):
    return next((why for pattern, why in EXPECTED.items() if re.search(pattern, text)), "")


def main(folder, mutated="500", seed="1"):
    folder = Path(folder).resolve()
    shim(folder)
    if not list(folder.glob("got-*")):
        collect(folder)
    found = []
    for place in sorted(folder.glob("got-*")):
        if (place / "case").exists() and (place / "how").exists():
            found.append(Given(place))
    told, bad = Counter(), 0
    usable = []
    for given in found:
        try:
            case = given.case()
        except Refusal as refusal:
            told[f"the case is refused: {refusal}"[:60]] += 1
            continue
        if rows(case) != (given.folder / "table").read_text():
            table = (given.folder / "table").read_text()
            told["tables differ" if table.count("\n") == rows(case).count("\n") else "table was split"] += 1
            continue
        usable.append(given)
        difference = same(given, given.folder / "in.msh", bool(given.deck), deck=given.deck)
        difference = difference or (given.deck and same_listing(given)) or ""
        why = explained(difference)
        told[why or ("as awk" if not difference else "UNEXPLAINED")] += 1
        if difference and not why:
            bad += 1
            print(f"{given.folder.name}: {difference[:600]}")
    chance = random.Random(int(seed))
    small = [given for given in usable if (given.folder / "in.msh").stat().st_size < 300_000]
    for k in range(int(mutated)):
        given = chance.choice(small)
        mesh = folder / ("mutated.inp" if given.deck else "mutated.msh")
        mesh.write_text(spoilt((given.deck or given.folder / "in.msh").read_text(), chance))
        difference = same(given, mesh, bool(given.deck), deck=given.deck and mesh)
        why = explained(difference)
        told[f"mutated: {why or ('as awk' if not difference else 'UNEXPLAINED')}"] += 1
        if difference and not why:
            bad += 1
            shutil.copy(mesh, folder / f"bad-{k}{mesh.suffix}")
            print(f"mutated {k} of {given.folder.name}: {difference[:600]}")
    for text, count in sorted(told.items()):
        print(f"{count:6d}  {text}")
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
