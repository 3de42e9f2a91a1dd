"""What was read of a geometry is kept beside its mesh: the next run takes it if nothing it comes of has changed."""

import os
import subprocess

import pytest
from freefem import ROOT
from test_zoo import BOXES, NAMED, PICKED

CASE = PICKED + NAMED.format("0")
KEPT = ("mesh.msh", "case", "rises", "regions")


def read(folder, cache, how="solve", programs=None):
    """{name: text} of what the reader gives of folder/a.case, or why it refuses."""
    out = folder / "read"
    given = [str(os.getpid()), folder / "a.geo", out, folder / "a.case", "1", how, ""]
    path = f"{programs}{os.pathsep}{os.environ['PATH']}" if programs else os.environ["PATH"]
    environment = {**os.environ, "LC_ALL": "C", "CONTACT_CACHE": str(cache), "PATH": path}
    command = ["sh", "edp/bodies/readable.sh", *given]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    texts = {file.name: file.read_text(errors="replace") for file in out.iterdir() if file.is_file()}
    subprocess.run(["rm", "-r", out], check=True)
    return {name: texts[name] for name in KEPT if name in texts} if done.returncode == 0 else texts["why"]


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """A folder with a geometry and a case, a cache in which they have been read, what was read, no gmsh."""
    folder = tmp_path_factory.mktemp("first")
    (folder / "a.geo").write_text(BOXES)
    (folder / "a.case").write_text(CASE)
    (folder / "programs").mkdir()
    (folder / "programs" / "gmsh").write_text("#!/bin/sh\nexit 1\n")
    (folder / "programs" / "gmsh").chmod(0o755)
    found = read(folder, folder / "cache")
    assert found["mesh.msh"].endswith("$EndElements\n") and len(list((folder / "cache/meshes").glob("*.tar"))) == 1
    return folder, folder / "cache", found, folder / "programs"


def test_taken(first):
    """The same files shall be read once: again without gmsh, which picks groups, and the same."""
    folder, cache, found, programs = first
    assert read(folder, cache, programs=programs) == found
    assert "gmsh" in read(folder, folder / "empty", programs=programs)


@pytest.mark.parametrize(
    "name, old, new",
    [
        ("a.case", "0 -0.011", "0 -0.012"),
        ("a.case", "grip box 0.9 0.9 3  3.1 3.1 3.02", "grip plane 1 0 0  1 0 0"),
        ("a.case", "size contact 0.7", "size contact 0.6"),
        ("a.geo", "0, 0, 0, 4, 4, 2", "0, 0, 0, 4, 5, 2"),
    ],
    ids=["number", "group", "size", "geometry"],
)
def test_changed(first, tmp_path, name, old, new):
    """A changed number, group, size or geometry shall give what a first reading gives, and then the former again."""
    folder, cache, found, _ = first
    text = (folder / name).read_text()
    assert text.count(old) == 1
    (folder / name).write_text(text.replace(old, new))
    try:
        changed = read(folder, cache)
        assert changed != found and changed == read(folder, tmp_path / "cache")
    finally:
        (folder / name).write_text(text)
    assert read(folder, cache) == found


@pytest.mark.parametrize("how", ["deleted", "cut off", "after"])
def test_lost(first, how):
    """A cache that is gone, cut off, or whose file for gmsh is gone shall be made again."""
    folder, cache, found, programs = first
    read(folder, cache)
    (archive,) = (cache / "meshes").glob("*.tar")
    if how == "deleted":
        subprocess.run(["rm", "-r", cache], check=True)
    elif how == "cut off":
        archive.write_bytes(archive.read_bytes()[:20000])
    else:
        for file in (cache / "meshes").glob("own-*.geo"):
            file.unlink()
    assert read(folder, cache) == found
    assert list((cache / "meshes").glob("own-*.geo"))  # a mesh of other sizes would be made with it
    assert read(folder, cache, programs=programs) == found


def test_not_alone(tmp_path):
    """A geometry that includes another, and a check, which draws faces, shall be read each time."""
    (tmp_path / "boxes.geo").write_text(BOXES)
    (tmp_path / "a.geo").write_text('Include "boxes.geo";\n')
    (tmp_path / "a.case").write_text(CASE)
    before = read(tmp_path, tmp_path / "cache")
    (tmp_path / "boxes.geo").write_text(BOXES.replace("0, 0, 0, 4, 4, 2", "0, 0, 0, 4, 5, 2"))
    after = read(tmp_path, tmp_path / "cache")
    assert before["mesh.msh"] != after["mesh.msh"]
    assert not list((tmp_path / "cache").rglob("*.tar"))
    (tmp_path / "a.geo").write_text(BOXES)
    assert read(tmp_path, tmp_path / "cache", how="check") == before
    assert not list((tmp_path / "cache").rglob("*.tar"))
