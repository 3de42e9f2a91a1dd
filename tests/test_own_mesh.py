"""Scene two-bodies: a mesh of the user's, its refusals; the pairing along the normals of deformed surfaces."""

import re

import numpy as np
import pytest
from freefem import ROOT, execute, run, run_in, script

SCENE = "two-bodies"
SMALL = ["-h", 1, "-vtu", 0]


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    """The example's mesh, made as its head says, on larger elements."""
    folder = tmp_path_factory.mktemp("mesh")
    text = (ROOT / "meshes/two-bodies.geo").read_text()
    (folder / "bodies.geo").write_text(re.sub(r"^size = 0.1;", "size = 0.3;", text, flags=re.M))
    return gmsh(folder / "bodies.geo", "-format", "msh22")


def gmsh(source, *flags):
    path = source.with_suffix(".msh")
    code, stdout = execute(["gmsh", "-2", "-v", 0, *flags, source, "-o", path])
    assert code == 0, stdout
    return path


def triangles(lines):
    """The line numbers of the triangles of a version 2 file."""
    return [i for i, line in enumerate(lines) if len(line.split()) == 8 and line.split()[1] == "2"]


def spoilt(mesh, folder, how):
    """A copy of the mesh after `how` has changed its lines."""
    lines = mesh.read_text().splitlines()
    how(lines)
    (folder / "spoilt.msh").write_text("\n".join(lines) + "\n")
    return folder / "spoilt.msh"


def refusal(path, folder, *flags):
    """The first line of a refused run that leaves nothing behind."""
    done = run_in(ROOT, script(SCENE), "-mesh", path, *flags, out=folder / "out", expect=10)
    assert not (folder / "out").exists()
    return done.stdout.splitlines()[0]


def test_own_mesh(mesh, tmp_path):
    """A mesh of the user's shall be solved, by two methods to one force, near the example's finer one's."""
    ours = run_in(ROOT, script(SCENE), "-mesh", mesh, "-tol", 1e-8, "-vtu", 0, out=tmp_path / "a")
    paper = ["-method", "paper", "-eps", 1e-8, "-tol", 1e-8, "-vtu", 0]
    assert run_in(ROOT, script(SCENE), "-mesh", mesh, *paper, out=tmp_path / "b").force == pytest.approx(
        ours.force, rel=1e-6
    )
    assert ours.summary["masterForceY"] == pytest.approx(ours.force, rel=1e-12)
    assert ours.newton <= 5
    assert run(SCENE).force == pytest.approx(ours.force, rel=0.02)
    assert ours.summary["unpairedPoints"] > 0


def test_own_mesh_in_other_units(mesh, tmp_path):
    """In other lengths the force shall scale: elements of an area of 1e-12 are no reason to fail."""
    flags = [
        "-law",
        "power",
        "-mesh",
        spoilt(mesh, tmp_path, lambda lines: shrink(lines, 1e-5)),
        "-u0",
        0.5e-5,
        "-d0",
        -0.05e-5,
        "-kappa",
        1e18,
        "-rho",
        1e7,
        "-vtu",
        0,
    ]
    there = run_in(ROOT, script(SCENE), *flags, out=tmp_path / "there")
    here = run_in(ROOT, script(SCENE), "-law", "power", "-d0", -0.05, "-mesh", mesh, "-vtu", 0, out=tmp_path / "here")
    assert there.newton == here.newton
    assert there.force == pytest.approx(here.force * 1e-5, rel=1e-8)


def swap(lines):
    i = triangles(lines)[0]
    words = lines[i].split()
    lines[i] = " ".join([*words[:5], words[6], words[5], words[7]])


def collapse(lines):
    i = triangles(lines)[3]
    words = lines[i].split()
    lines[i] = " ".join([*words[:6], words[5], words[7]])


def misname(lines):
    i = next(i for i, line in enumerate(lines) if line.endswith('"master"'))
    lines[i] = lines[i].replace('"master"', '"Master"')


def exchange(lines):
    for i, line in enumerate(lines[:20]):
        lines[i] = line.replace('"contact"', '"x"').replace('"master"', '"contact"').replace('"x"', '"master"')


def cut(lines):
    del lines[len(lines) // 2 :]


def no_number(lines):
    i = lines.index("$Nodes") + 5
    lines[i] = " ".join([*lines[i].split()[:2], "nan", "0"])


def join(lines):
    """The last triangle, of the upper body, takes the nodes of the first one, of the lower body."""
    first, *_, last = triangles(lines)
    lines[last] = " ".join([*lines[last].split()[:5], *lines[first].split()[5:]])


def repeat(lines):
    """An edge of "master" once more, in "pushed"."""
    group = {line.split()[2]: line.split()[1] for line in lines[:20] if line.endswith('"')}
    edges = [line.split() for line in lines if len(line.split()) == 7 and line.split()[1] == "1"]
    edge = next(words for words in edges if words[3] == group['"master"'])
    start = lines.index("$Elements")
    lines[start + 1] = str(int(lines[start + 1]) + 1)
    lines.insert(start + 2, " ".join(["99999", "1", "2", group['"pushed"'], *edge[4:]]))


def blank(lines):
    i = next(i for i, line in enumerate(lines) if line.endswith('"free"'))
    lines[i] = lines[i].replace('"free"', '"free sides"')


def shrink(lines, size=1e-9):
    start = lines.index("$Nodes") + 2
    for i in range(start, lines.index("$EndNodes")):
        number, *where = lines[i].split()
        lines[i] = " ".join([number, *(repr(float(v) * size) for v in where)])


def release(lines):
    """The upper body's "pushed" edges become "free" ones."""
    group = {line.split()[2]: line.split()[1] for line in lines[:20] if line.endswith('"')}
    for i, line in enumerate(lines):
        words = line.split()
        if len(words) == 7 and words[1] == "1" and words[3] == group['"pushed"']:
            lines[i] = " ".join([*words[:3], group['"free"'], *words[4:]])


@pytest.mark.parametrize(
    "how, words",
    [
        (swap, ["turned over", "msh22"]),
        (collapse, ["without area"]),
        (misname, ['no physical group "master"', '"Master"']),
        (exchange, ['no edge of "contact" on the lower body']),
        (cut, ["cut off"]),
        (no_number, ["no number"]),
        (lambda lines: lines.clear(), ["version 2"]),
        (join, ["share a node"]),
        (repeat, ["two physical curves"]),
        (blank, ["blank"]),
        (shrink, ["too small"]),
        (release, ["holds"]),
    ],
    ids="turned degenerate misnamed exchanged cut number empty joined repeated blank tiny free".split(),
)
def test_refused_meshes(mesh, tmp_path, how, words):
    """A mesh that cannot be read shall be refused in one line that says why."""
    line = refusal(spoilt(mesh, tmp_path, how), tmp_path)
    for word in [*words, "spoilt.msh"]:
        assert word in line


@pytest.mark.parametrize(
    "flags, word",
    [(["-format", "msh41"], "version 2"), (["-format", "msh22", "-bin"], "text"), (["-order", 2], "first order")],
)
def test_refused_formats(tmp_path, flags, word):
    """Other formats and orders of gmsh shall be refused in one line."""
    (tmp_path / "bodies.geo").write_text((ROOT / "meshes/two-bodies.geo").read_text())
    flags = flags if "-format" in flags else [*flags, "-format", "msh22"]
    assert word in refusal(gmsh(tmp_path / "bodies.geo", *flags), tmp_path)


def test_refused_places(tmp_path):
    """Bodies that overlap by more than a hundredth of the surface, or do not face each other, shall be refused."""
    text = (ROOT / "meshes/two-bodies.geo").read_text()
    for name, change, word in (
        ("deep", (r"6\.1, 0\}", "5.6, 0}"), "overlap by"),
        ("aside", (r"Point\(1([1-6])\) = \{", r"\g<0>30 + "), "above"),
    ):
        moved = re.sub(*change, text)
        if name == "deep":
            moved = moved.replace("14.1", "13.6")
        (tmp_path / f"{name}.geo").write_text(moved)
        assert word in refusal(gmsh(tmp_path / f"{name}.geo", "-format", "msh22"), tmp_path)
    assert "no such file" in refusal(tmp_path / "none.msh", tmp_path)


@pytest.mark.parametrize("flags", [["-force", 5], ["-method", "newton"], ["-history", 1]])
def test_refused_with_exact(flags, tmp_path):
    """The true distance shall be refused where it is not done."""
    run_in(ROOT, script(SCENE), "-distance", "exact", *flags, out=tmp_path / "out", expect=10)


# ---------------------------------------------------------------- pairing along the normals


@pytest.mark.parametrize("points", ["nodal", "segment"])
def test_true_distance_to_a_nearly_rigid_disc(points):
    """In hard contact the meshed disc's true distance shall give the rigid disc's force, closer as h falls."""
    flags = ["-law", "signorini", "-d0", 0, "-distance", "exact", "-tol", 1e-8, "-order", 2]
    off = []
    for h in (0.5, 0.2):
        rigid = run("disc-on-block", *flags, "-h", h).force
        off.append(abs(run("meshed-disc", *flags, "-h", h, "-points", points).force / rigid - 1))
    assert off[1] < 0.001
    assert off[1] < 0.5 * off[0]


@pytest.mark.parametrize("kappa", [1e-2, 1, 1e3, 1e6, 1e12, 1e30])
def test_rounds(kappa):
    """The force of two meshed bodies shall stand still within 7 rounds and 25 linearisations, whatever kappa."""
    done = run("meshed-disc", "-distance", "exact", "-points", "segment", "-kappa", kappa, "-h", 0.25, "-tol", 1e-8)
    assert done.rounds <= 7
    assert done.newton <= 25
    assert done.summary["masterForceY"] == pytest.approx(done.force, rel=1e-12)
    assert abs(done.summary["masterForceX"]) < 1e-3 * done.force


def test_small_loads_need_no_refreshing():
    """For a load that hardly deforms or tilts anything the true distance shall be the linear one."""
    flags = ["-force", 0, "-gap", 0.01, "-u0", 0.0105, "-reach", 0.3, "-h", 0.01, "-tol", 1e-9]
    linear, exact = (run("two-cylinders", *flags, "-distance", distance).force for distance in ("linear", "exact"))
    assert exact == pytest.approx(linear, rel=0.01)
    assert not np.isclose(exact, linear, rtol=1e-9)


@pytest.mark.parametrize("scene, u0", [("two-cylinders", 100), ("two-cylinders", 12), ("disc-on-block", 50)])
def test_contact_that_gets_lost(scene, u0, tmp_path):
    """A load too large for the true distance shall end with code 20 and say so, not with a contact that is no more."""
    flags = ["-h", 0.5, "-distance", "exact", "-force", 0, "-u0", u0]
    done = run_in(ROOT, script(scene), *flags, out=tmp_path / "out", expect=20)
    assert "loses the contact" in done.summary["message"]
