"""What was read of a geometry is kept beside its mesh: the next run takes it if nothing it comes of has changed."""

import os
import subprocess

import pytest
from freefem import ROOT
from reader.groups import Group, Where
from reader.names import names_of
from reader.problem import Problem, run

from input.test_reader_fuzz import INP, PLANE
from input.test_zoo import BOXES, NAMED, PICKED

CASE = PICKED + NAMED.format("0")
KEPT = ("mesh.msh", "case", "rises", "regions")
MARK = "a mark\n"


def read(folder, cache, how="solve"):
    """{name: text} of what the reader gives of folder/a.case."""
    out = folder / "read"
    given = [str(os.getpid()), folder / "a.geo", out, folder / "a.case", "1", how, ""]
    environment = {**os.environ, "LC_ALL": "C", "CONTACT_CACHE": str(cache)}
    command = ["sh", "edp/input/read-case.sh", *given]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, (out / "why").read_text()
    texts = {name: (out / name).read_text(errors="replace") for name in KEPT}
    subprocess.run(["rm", "-r", out], check=True)
    return texts


def kept(cache):
    """The folders of what was read."""
    return [path for path in cache.rglob("own-*") if path.is_dir()]


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """A folder with a geometry and a case, a cache in which they have been read, what was read."""
    folder = tmp_path_factory.mktemp("first")
    (folder / "a.geo").write_text(BOXES)
    (folder / "a.case").write_text(CASE)
    found = read(folder, folder / "cache")
    assert found["mesh.msh"].endswith("$EndElements\n") and len(kept(folder / "cache")) == 1
    return folder, folder / "cache", found


def mark(cache):
    """Exchanges the last letters of a kept file, whose text it returns."""
    (place,) = kept(cache)
    with open(place / "rises", "r+") as file:
        text = file.read()
        file.seek(len(text) - len(MARK))
        file.write(MARK)
    return text


def test_taken(first):
    """The same files shall be read once: what is kept is taken as it is."""
    folder, cache, found = first
    text = mark(cache)
    assert read(folder, cache) == found | {"rises": text[: -len(MARK)] + MARK}
    (kept(cache)[0] / "rises").write_text(text)
    assert read(folder, cache) == found


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
    folder, _, found = first
    text = (folder / name).read_text()
    assert text.count(old) == 1
    (tmp_path / "a.geo").write_text((folder / "a.geo").read_text())
    (tmp_path / "a.case").write_text((folder / "a.case").read_text())
    read(tmp_path, tmp_path / "cache")
    (tmp_path / name).write_text(text.replace(old, new))
    changed = read(tmp_path, tmp_path / "cache")
    assert changed != found and changed == read(tmp_path, tmp_path / "empty")
    (tmp_path / name).write_text(text)
    assert read(tmp_path, tmp_path / "cache") == found


@pytest.mark.parametrize("how", ["deleted", "cut off", "without a file", "without a plan"])
def test_lost(first, how):
    """A cache that is gone, cut off, lacks a file or the plan for meshes of other sizes shall be made again."""
    folder, cache, found = first
    read(folder, cache)
    (place,) = kept(cache)
    if how == "deleted":
        subprocess.run(["rm", "-r", cache], check=True)
    elif how == "cut off":
        (place / "mesh.msh").write_text(found["mesh.msh"][:20000])
    elif how == "without a file":
        (place / "rises").unlink()
    else:
        for file in (cache / "meshes").glob("own-*.plan"):
            file.unlink()
    assert read(folder, cache) == found
    assert list((cache / "meshes").glob("own-*.plan"))  # a mesh of other sizes would be made with it
    text = mark(cache)
    assert read(folder, cache) != found
    (kept(cache)[0] / "rises").write_text(text)


def test_not_alone(tmp_path):
    """A geometry that includes another, and a check, which draws faces, shall be read each time."""
    (tmp_path / "boxes.geo").write_text(BOXES)
    (tmp_path / "a.geo").write_text('Include "boxes.geo";\n')
    (tmp_path / "a.case").write_text(CASE)
    before = read(tmp_path, tmp_path / "cache")
    (tmp_path / "boxes.geo").write_text(BOXES.replace("0, 0, 0, 4, 4, 2", "0, 0, 0, 4, 5, 2"))
    after = read(tmp_path, tmp_path / "cache")
    assert before["mesh.msh"] != after["mesh.msh"]
    assert not kept(tmp_path / "cache")
    (tmp_path / "a.geo").write_text(BOXES)
    assert read(tmp_path, tmp_path / "cache", how="check") == before
    assert not kept(tmp_path / "cache")


def test_names_of_a_mesh(tmp_path):
    """The groups of a mesh are known without numpy, those of a geometry that was never opened are not."""
    (tmp_path / "a.geo").write_text(BOXES)
    assert names_of(tmp_path / "a.geo", True, [], tmp_path) == (None, {})
    names = '1 7 "curve"\n2 3 "two words"\n3 1 "a"'
    mesh = tmp_path / "a.msh"
    mesh.write_text(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n{names}\n$EndPhysicalNames\n")
    assert names_of(mesh, True, [], tmp_path) == ([Group(1, "curve"), Group(2, "two words"), Group(3, "a")], {})
    mesh.write_text(mesh.read_text().replace("3 1", "2 1"))
    assert names_of(mesh, True, [], tmp_path) == (None, {})  # a plane mesh: refused as a whole


def test_names_of_a_deck(tmp_path):
    """The sets of a deck are known once it has been read, also for a case that was refused."""
    (tmp_path / "a.inp").write_text(INP)
    (tmp_path / "a.case").write_text(PLANE.replace("bottom", "botom"))
    problem = Problem(tmp_path / "a.inp", str(tmp_path / "a.case"), tmp_path, Where(), [], cache=tmp_path)
    assert names_of(problem.file, False, [], tmp_path) == (None, {})
    assert run(problem) == 3
    assert names_of(problem.file, False, [], tmp_path) == ([Group(1, "top"), Group(1, "bottom"), Group(2, "block")], {})


def test_accuracy_has_no_mixed_elements(tmp_path):
    """In the plane -accuracy begins with P4 unless an order is given: then rubber has no mixed elements."""
    (tmp_path / "a.inp").write_text(INP)
    (tmp_path / "a.case").write_text(PLANE.replace("nu 0.3", "nu 0.499"))
    words = f"flags=-mesh\n{tmp_path}/a.inp\n-case\n{tmp_path}/a.case"
    found = {}
    for flags in ("", "\n-accuracy\n0", "\n-accuracy\n0.01", "\n-accuracy\n0.01\n-order\n2"):
        answer = tmp_path / "answer"
        given = ["0", "modules", f"to={answer}", "space=0", "own=1", words + flags]
        assert subprocess.run(["sh", "edp/input/read.sh", *given], cwd=ROOT).returncode == 0
        found[flags.split()[-1] if flags else ""] = "incompressibleOnRequest" in answer.read_text()
    assert found == {"": True, "0": True, "0.01": False, "2": True}


def test_refused_before_the_mesh(tmp_path):
    """A wrong name, once the geometry was opened, and a wrong word at any time are refused by the first question."""
    case, geo, answer = tmp_path / "a.case", tmp_path / "a.geo", tmp_path / "answer"
    geo.write_text(BOXES)
    given = ["0", "modules", f"to={answer}", "space=1", "own=1", f"flags=-mesh\n{geo}\n-case\n{case}\n"]
    environment = {**os.environ, "CONTACT_CACHE": str(tmp_path / "cache")}

    def ask(text):
        case.write_text(text)
        code = subprocess.run(["sh", "edp/input/read.sh", *given], cwd=ROOT, env=environment).returncode
        return code, answer.read_text()

    wrong = CASE + "clamp nothing\n"
    assert ask(wrong)[0] == 0 and ask(CASE)[0] == 0
    assert "clmp: unknown statement; did you mean clamp" in ask(CASE + "clmp grip\n")[1]
    case.write_text(CASE)
    read(tmp_path, tmp_path / "cache")
    assert ask(wrong)[0] == 0  # a geometry without names is refused as a whole
    geo.write_text(BOXES + 'Physical Surface("side") = {1};\n')
    case.write_text(CASE)
    read(tmp_path, tmp_path / "cache")
    code, said = ask(wrong)
    assert code == 1 and "nothing: no physical surface of the mesh; allowed: " in said
    assert ask(CASE)[0] == 0
