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
        (shrink, ["too small"]),
        (release, ['no edge of "pushed" on the upper body']),
    ],
    ids="turned degenerate misnamed exchanged cut number empty joined repeated tiny free".split(),
)
def test_refused_meshes(mesh, tmp_path, how, words):
    """A mesh that cannot be read shall be refused in one line that says why."""
    line = refusal(spoilt(mesh, tmp_path, how), tmp_path)
    for word in [*words, "spoilt.msh"]:
        assert word in line


def test_refused_order(tmp_path):
    """Meshes of second order shall be refused in one line."""
    (tmp_path / "bodies.geo").write_text((ROOT / "meshes/two-bodies.geo").read_text())
    mesh = gmsh(tmp_path / "bodies.geo", "-order", 2, "-format", "msh22")
    assert "first order" in refusal(mesh, tmp_path)


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


def test_refused_with_exact(tmp_path):
    """The true distance shall be refused where it is not done."""
    run_in(ROOT, script(SCENE), "-distance", "exact", "-method", "newton", out=tmp_path / "out", expect=10)


# ---------------------------------------------------------------- pairing along the normals


@pytest.mark.parametrize("points", ["nodal", "segment"])
def test_true_distance_to_a_nearly_rigid_disc(points):
    """In hard contact the meshed disc's true distance shall give the rigid disc's force, up to 1/Eratio."""
    flags = ["-law", "signorini", "-d0", 0, "-distance", "exact", "-tol", 1e-8, "-order", 2]
    rigid = run("disc-on-block", *flags, "-h", 0.5).force
    assert run("meshed-disc", *flags, "-h", 0.5, "-points", points).force == pytest.approx(rigid, rel=2e-6)


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
    flags = ["-force", 0, "-gap", 0.01, "-u0", 0.0105, "-reach", 0.3, "-h", 0.02, "-tol", 1e-9]
    linear, exact = (run("two-cylinders", *flags, "-distance", distance).force for distance in ("linear", "exact"))
    assert exact == pytest.approx(linear, rel=0.01)
    assert not np.isclose(exact, linear, rtol=1e-9, atol=0)


@pytest.mark.parametrize("scene, u0", [("two-cylinders", 100), ("two-cylinders", 12), ("disc-on-block", 50)])
def test_contact_that_gets_lost(scene, u0, tmp_path):
    """A load too large for the true distance shall end with code 20 and say so, not with a contact that is no more."""
    flags = ["-h", 0.5, "-distance", "exact", "-force", 0, "-u0", u0]
    done = run_in(ROOT, script(scene), *flags, out=tmp_path / "out", expect=20)
    assert "loses the contact" in done.summary["message"]


# ---------------------------------------------------------------- points without a master


@pytest.mark.parametrize(
    "flags",
    [
        [],
        ["-method", "paper"],
        ["-method", "newton"],
        ["-law", "exponential", "-d0", -0.05],
        ["-points", "nodal"],
        ["-start", "none"],
    ],
    ids=lambda flags: " ".join(map(str, flags)) or "default",
)
def test_points_without_a_master_stay_open(flags, tmp_path):
    """However far the bodies move, points without a master carry nothing, and the force grows as the load."""
    force = []
    for u0 in (1e5, 1e6):  # 1e4 and 1e5 lengths of the contact
        done = run_in(ROOT, script(SCENE), *flags, "-u0", u0, "-vtu", 0, out=tmp_path / f"{u0:g}")
        unpaired = done.contact["overlap"] < -100
        assert np.count_nonzero(unpaired) == done.summary["unpairedPoints"] > 0
        assert np.all(done.contact["pressure"][unpaired] == 0)
        assert np.all(done.contact["status"][unpaired] == 0)
        assert done.summary["contactPoints"] == np.count_nonzero(~unpaired)
        assert done.summary["reactionY"] == pytest.approx(done.force, rel=1e-9)
        force.append(done.force)
    # all that face each other touch, and the layer gives next to nothing
    assert force[1] == pytest.approx(10 * force[0], rel=1e-3)


@pytest.mark.parametrize("method", ["xnewton", "paper", "newton", "incremental"])
def test_points_without_a_master_under_a_force(method, tmp_path):
    """The same for a force whose approach is unknown: that of the prescribed approach comes back."""
    flags = ["-tol", 1e-8, "-vtu", 0]
    pushed = run_in(ROOT, script(SCENE), "-u0", 1e6, *flags, out=tmp_path / "pushed")
    done = run_in(ROOT, script(SCENE), "-force", pushed.force, "-method", method, *flags, out=tmp_path / "out")
    assert done.summary["approach"] == pytest.approx(1e6, rel=1e-4)
    assert done.summary["contactPoints"] == pushed.summary["contactPoints"]


# ---------------------------------------------------------------- contact that is cut off


def narrow(name, keep):
    """Of a physical curve's edges only those whose middle's abscissa passes `keep`; the others become "free"."""

    def change(lines):
        group = {line.split()[2]: line.split()[1] for line in lines[:20] if line.endswith('"')}
        start = lines.index("$Nodes") + 2
        x = {line.split()[0]: float(line.split()[1]) for line in lines[start : lines.index("$EndNodes")]}
        for i, line in enumerate(lines):
            words = line.split()
            if len(words) == 7 and words[1] == "1" and words[3] == group[f'"{name}"']:
                outside = not keep((x[words[5]] + x[words[6]]) / 2)
                lines[i] = " ".join([*words[:3], group['"free"'] if outside else words[3], *words[4:]])

    return change


@pytest.mark.parametrize(
    "curve, keep", [("contact", lambda x: x > 0.5), ("contact", lambda x: x < 0.5), ("master", lambda x: abs(x) < 1)]
)
@pytest.mark.parametrize("points", ["segment", "nodal"])
def test_contact_cut_off(mesh, tmp_path, curve, keep, points):
    """Contact that reaches the end of a curve that stops in the middle of the body's side shall be said."""
    short = spoilt(mesh, tmp_path, narrow(curve, keep))
    flags = ["-points", points, "-law", "power", "-d0", -0.05, "-vtu", 0]
    done = run_in(ROOT, script(SCENE), "-mesh", short, *flags, out=tmp_path / "out")
    whole = run_in(ROOT, script(SCENE), "-mesh", mesh, *flags, out=tmp_path / "whole")
    assert done.force < 0.98 * whole.force
    assert [line for line in done.summary["warnings"] if "reaches the end" in line]
    assert not [line for line in whole.summary["warnings"] if "reaches the end" in line]


@pytest.mark.parametrize(
    "scene, flags, said",
    [
        ("disc-on-block", ["-reach", 2, "-u0", 1.5], True),
        ("disc-on-block", ["-reach", 2, "-u0", 1.5, "-geometry", "axisymmetric"], True),
        ("disc-on-block", ["-geometry", "axisymmetric"], False),  # the axis is no end
        ("two-cylinders", ["-reach", 0.5], True),
        ("two-cylinders", [], False),
        ("flat-punch", [], False),  # the punch ends where contact does
        ("patch-test", [], False),
        ("confined-block", ["-law", "exponential"], False),
        ("rough", ["-force", 200], False),
        ("wavy", ["-u0", 3, "-geometry", "axisymmetric"], False),
        ("patch-test-3d", [], False),
        ("sphere-on-plane", ["-patch", 0.8, "-h", 0.2], True),
    ],
)
def test_ends(scene, flags, said):
    """The end of a body or of the obstacle, and an axis, are no ends at which contact is cut off."""
    done = run(scene, *flags)
    assert any("raise -" in line for line in done.summary["warnings"]) is said
    assert bool(done.summary["warnings"]) is said


def test_no_force_before_touch():
    """Curved bodies a hair apart shall not press: the gap is that of the circles, not its mean over an element."""
    for order in (1, 2):
        assert run("two-cylinders", "-force", 0, "-u0", 0.09999, "-order", order).force == 0
        assert run("two-cylinders", "-force", 0, "-u0", 0.1001, "-order", order).force > 0
    assert run("two-spheres", "-force", 0, "-u0", 0.09999, "-h", 0.2).force == 0
