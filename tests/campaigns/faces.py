"""Whether the two readers of geometries agree: `python tests/campaigns/faces.py [WORDS]`, with gmsh's module.

The table of -check 1 by the awk programs, as edp/bodies/readable.sh starts them, and by the Python package
edp/case/reader, of all geometries in the package and in tests whose path has one of the words. Bodies, faces, kinds,
places, normals, radii, areas and neighbours are compared word by word, numbers by their last digit but one.
Exit code 1: a difference, printed.
"""

import os
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "edp/case"))

from reader.gmsh_process import GmshError  # noqa: E402
from reader.mesher import prepare  # noqa: E402

LAST_DIGITS = 2e-3  # of numbers that are printed with four digits: rounding, and the middle of a coarse outline
KINDS = ("geo", "step", "stp", "brep", "igs", "iges")


def seconds():
    """CPU of all processes that were started and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def awk(file, space):
    """(the table or why there is none, CPU seconds)."""
    with tempfile.TemporaryDirectory() as temporary:
        begun = seconds()
        command = ["sh", ROOT / "edp/bodies/readable.sh", str(os.getpid()), file, f"{temporary}/read", "none"]
        done = subprocess.run([*command, str(int(space)), "check", ""], capture_output=True, text=True)
        read = Path(temporary, "read")
        text = (read / ("table" if done.returncode == 4 else "why")).read_text()
        return text if done.returncode == 4 else f"refused: {text}", seconds() - begun


def python(file, space):
    """The same of Python, its own CPU seconds with those of gmsh's process."""
    begun, own = seconds(), sum(os.times()[:2])
    try:
        text = prepare(file, space, None, None, Path(tempfile.gettempdir()), check=True).table
    except GmshError as error:
        text = f"refused: {error}"
    return text, seconds() - begun + sum(os.times()[:2]) - own


def alike(a, b):
    """Whether two words are one, or two numbers that differ by rounding."""
    try:
        x, y = float(a.strip("(),")), float(b.strip("(),"))
    except ValueError:
        return a == b
    return abs(x - y) <= LAST_DIGITS * max(abs(x), abs(y)) or max(abs(x), abs(y)) < 1e-9


def differences(old, new):
    """Pairs of lines that differ."""
    if old.startswith("refused") and new.startswith("refused"):
        return []
    lines = old.splitlines(), new.splitlines()
    if len(lines[0]) != len(lines[1]):
        return [(f"{len(lines[0])} lines", f"{len(lines[1])} lines: {new if len(new) < 200 else ''}")]
    pairs = [(a, b, a.split(), b.split()) for a, b in zip(*lines, strict=True)]
    return [(a, b) for a, b, x, y in pairs if len(x) != len(y) or not all(map(alike, x, y))]


def geometries():
    for folder in ("edp/examples", "edp/labs", "tests/data", "tests/verification", "tests/campaigns"):
        for file in sorted((ROOT / folder).rglob("*.*")):
            if file.suffix.lower()[1:] in KINDS:
                yield (
                    file,
                    bool(re.search(r"Volume|Extrude|Sphere|Box|Cylinder", file.read_text(errors="replace")))
                    or (file.suffix != ".geo"),
                )


def main(*words):
    wrong = 0
    for file, space in geometries():
        name = str(file.relative_to(ROOT))
        if words and not any(word in name for word in words):
            continue
        (old, before), (new, after) = awk(file, space), python(file, space)
        found = differences(old, new)
        wrong += bool(found)
        print(
            f"{name}: {len(old.splitlines())} lines, {len(found)} differ, {before:.2f} and {after:.2f} CPU s",
            flush=True,
        )
        for a, b in found[:6]:
            print(f"    awk:    {a}\n    Python: {b}")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
