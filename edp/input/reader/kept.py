"""What a run before has read of the same geometry and case, kept beside the mesh: a folder with the files of that run.

Kept is what stands for itself: a geometry that reads no other file, a case without files of its own. This module loads
neither numpy nor gmsh's module, so that a run that finds its files waits for none of them.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
from pathlib import Path

CAD = {".step", ".stp", ".brep", ".iges", ".igs"}
KINDS = {".geo", *CAD}  # of geometries
WHOLE = "whole"  # the file that says which others there are
FILES = re.compile(rb"(^|[ \t\"])(table|from|surface)([ \t\"]|$)", re.M)  # what names a file in a case


def module_version() -> str:
    """Which gmsh module there is, without starting it."""
    spec = next(filter(None, (finder.find_spec("gmsh", None) for finder in sys.meta_path)), None)
    if spec is None or spec.origin is None:
        return ""
    found = os.stat(spec.origin)
    return f"{spec.origin} {found.st_size} {found.st_mtime_ns}"


def words_that_read() -> str:
    """The words of a .geo file that read other files, as input/included-files.sh has them: no other place does."""
    found = re.search(r"geo \| opt\) words='(.*)'", (Path(__file__).parents[2] / "input/included-files.sh").read_text())
    assert found
    return found[1]


def stands_alone(file: Path) -> bool:
    """Whether a geometry reads no other file, and nothing that only gmsh knows."""
    if Path(f"{file}.opt").exists():
        return False
    if file.suffix.lower() != ".geo":
        return True
    lines = file.read_text(errors="replace").splitlines()
    reads = re.compile(words_that_read(), re.I)
    return not any(reads.search(re.sub(r"//.*", "", re.sub(r'"[^"]*"', " ", line))) for line in lines)


def checksum(file: Path, *more: object) -> str:
    """Of a geometry, of all else that is made of it, of gmsh's module and of the reader itself."""
    import hashlib  # takes time to load

    own = [repr([module_version(), *more]).encode(errors="surrogateescape"), file.read_bytes()]
    own += [source.read_bytes() for source in sorted(Path(__file__).parent.rglob("*.py"))]
    return hashlib.blake2b(b"\0".join(own), digest_size=12).hexdigest()


def place_of(file: Path, case: str, cache: Path, *more: object) -> Path | None:
    """Where the files of this problem are kept; None: it does not stand for itself."""
    try:
        if file.suffix.lower() not in KINDS or not Path(case).is_file() or not stands_alone(file):
            return None
        text = Path(case).read_bytes()
        return None if FILES.search(text) else cache / f"own-{checksum(file, text, case, *more)}"
    except (OSError, ValueError):
        return None


def sizes(folder: Path) -> str:
    """The files of a folder and their sizes, a line each."""
    return "".join(f"{file.stat().st_size} {file.name}\n" for file in sorted(folder.iterdir()) if file.name != WHOLE)


def take(place: Path, folder: Path) -> bool:
    """Copies what is kept into a run's folder; whether it is there, whole, and the mesh that it tells of."""
    try:
        if (place / WHOLE).read_text() != sizes(place):
            return False
        told = (place / "told").read_text(errors="surrogateescape").split("\n")
        if told[1] and not Path(told[1]).is_file():
            return False
        for file in place.iterdir():
            shutil.copyfile(file, folder / file.name)
    except OSError:
        return False
    return True


def write_whole(path: Path, text: str) -> bool:
    """Writes a file that others may read meanwhile; whether there was room."""
    part = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        part.write_text(text, encoding="utf-8", errors="surrogateescape")
        part.replace(path)
    except OSError:
        part.unlink(missing_ok=True)
        return False
    return True


def keep(folder: Path, place: Path) -> None:
    """Keeps the files of a folder, whole or not at all."""
    part = place.with_name(f".making-{place.name}-{os.getpid()}")
    try:
        shutil.copytree(folder, part)
        (part / WHOLE).write_text(sizes(part))
        shutil.rmtree(place, ignore_errors=True)  # one that is not whole
        part.rename(place)
    except OSError:
        shutil.rmtree(part, ignore_errors=True)
