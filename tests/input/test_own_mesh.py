"""The example punch on a mesh of the user's; pairing along normals of deformed surfaces; contact that is cut off."""

import os

import freefem
import numpy as np
import pytest
from freefem import ROOT, cases_of, execute, run, run_in, script

PUNCH = ROOT / "edp/examples/punch"
LAW = "law power kappa 1e3 m 3 d0 -0.05"


@pytest.fixture(scope="module")
def mesh():
    """The example's mesh, made as its head says, on larger elements; kept with the runs, which name it."""
    path = freefem.STORE / "bodies.msh"
    freefem.STORE.mkdir(parents=True, exist_ok=True)
    if not path.exists():
        own = freefem.STORE / f"bodies-{os.getpid()}.geo"
        text = (PUNCH / "punch.geo").read_text()
        assert "size = {0.1," in text
        own.write_text(text.replace("size = {0.1,", "size = {0.3,"))
        code, stdout = execute(["gmsh", "-2", "-v", 0, "-format", "msh22", own, "-o", own.with_suffix(".msh")])
        assert code == 0, stdout
        own.with_suffix(".msh").rename(path)
    return path


def pressed(folder, mesh, *flags, law="", u0=0.5):
    """A run of the example's case with another law, hard contact without one, and another approach; P1."""
    case = (PUNCH / "punch.case").read_text()
    assert LAW in case and "0 -0.5" in case
    folder.mkdir(exist_ok=True)
    (folder / "punch.case").write_text(case.replace(LAW, law).replace("0 -0.5", f"0 {-u0!r}"))
    given = ["-mesh", mesh, "-case", folder / "punch.case", "-order", 1, "-vtu", 0, "-estimate", 0]
    return run_in(ROOT, "edp/parts.edp", *given, *flags, out=folder / "out")


def spoilt(mesh, folder, how):
    """A copy of the mesh after `how` has changed its lines."""
    lines = mesh.read_text().splitlines()
    how(lines)
    (folder / "spoilt.msh").write_text("\n".join(lines) + "\n")
    return folder / "spoilt.msh"


def test_own_mesh(mesh, tmp_path):
    """A mesh of the user's shall be solved, by two methods to one force, near the example's finer one's."""
    ours, paper = (
        pressed(tmp_path / flags[-1], mesh, "-tol", 1e-8, "-eps", 1e-8, *flags)
        for flags in (["-method", "xnewton"], ["-method", "paper"])
    )
    assert paper.force == pytest.approx(ours.force, rel=1e-6)
    assert ours.newton <= 5
    assert pressed(tmp_path / "finer", PUNCH / "punch.geo").force == pytest.approx(ours.force, rel=0.02)
    assert ours.summary["unpairedPoints"] > 0


def test_own_mesh_in_other_units(mesh, tmp_path):
    """In other lengths the force shall scale: elements of an area of 1e-12 are no reason to fail."""
    larger = pressed(tmp_path / "here", mesh, law=LAW)
    small = spoilt(mesh, tmp_path, lambda lines: shrink(lines, 1e-5))
    there = pressed(tmp_path / "there", small, law="law power kappa 1e18 m 3 d0 -0.05e-5", u0=0.5e-5)
    assert there.newton == larger.newton
    assert there.force == pytest.approx(larger.force * 1e-5, rel=1e-8)


def shrink(lines, size):
    start = lines.index("$Nodes") + 2
    for i in range(start, lines.index("$EndNodes")):
        number, *where = lines[i].split()
        lines[i] = " ".join([number, *(repr(float(v) * size) for v in where)])


# ---------------------------------------------------------------- pairing along the normals


@pytest.mark.parametrize("kappa", [1e-2, 1e6, 1e30, *(k for k in (1, 1e3, 1e12))])
def test_rounds(kappa):
    """The force of two meshed bodies shall stand still within 7 rounds and 25 linearisations, whatever kappa."""
    done = run("meshed-disc", "-distance", "exact", "-points", "segment", "-kappa", kappa, "-h", 0.5, "-tol", 1e-8)
    assert done.rounds <= 7
    assert done.newton <= 25
    assert done.summary["masterForceY"] == pytest.approx(done.force, rel=1e-12)
    assert abs(done.summary["masterForceX"]) < 1e-3 * done.force


def test_small_loads_need_no_refreshing():
    """For a load that hardly deforms or tilts anything the true distance shall be the linear one."""
    flags = ["-force", 0, "-gap", 0.01, "-u0", 0.0105, "-reach", 0.3, "-h", 0.03, "-tol", 1e-9]
    linear, exact = (run("two-cylinders", *flags, "-distance", distance).force for distance in ("linear", "exact"))
    assert exact == pytest.approx(linear, rel=0.01)
    assert not np.isclose(exact, linear, rtol=1e-9, atol=0)


@pytest.mark.parametrize(
    "scene, u0",
    [("two-cylinders", 12), ("disc-on-block", 50), ("two-cylinders", 100)],
)
def test_contact_that_gets_lost(scene, u0, tmp_path):
    """A load too large for the true distance shall end with code 20 and say so, not with a contact that is no more."""
    flags = ["-h", 0.5, "-distance", "exact", "-force", 0, "-u0", u0]
    done = run_in(ROOT, script(scene), *flags, out=tmp_path / "out", expect=20)
    assert "loses the contact" in done.summary["message"]


# ---------------------------------------------------------------- points without a master


@pytest.mark.parametrize(
    "law, flags, further",
    [
        ("", [], []),
        ("law exponential p0 0.02 beta 50 d0 -0.05", [], []),
        ("", ["-points", "nodal"], ["-points", "nodal", "-start", "none"]),
    ],
    ids=["default", "exponential", "nodal"],
)
def test_points_without_a_master_stay_open(mesh, tmp_path, law, flags, further):
    """However far the bodies move, points without a master carry nothing, and the force grows as the load."""
    one = opened(tmp_path / "one", mesh, *flags, u0=1e5)  # 1e4 lengths of the contact
    ten = opened(tmp_path / "ten", mesh, *further, u0=1e6, law=law)
    # all that face each other touch, and the layer gives next to nothing
    assert ten.force == pytest.approx(10 * one.force, rel=1e-3)


def opened(folder, mesh, *flags, **given):
    """A run in which points without a master carry nothing."""
    done = pressed(folder, mesh, *flags, **given)
    unpaired = done.contact["overlap"] < -100
    assert np.count_nonzero(unpaired) == done.summary["unpairedPoints"] > 0
    assert np.all(done.contact["pressure"][unpaired] == 0)
    assert np.all(done.contact["status"][unpaired] == 0)
    assert done.summary["contactPoints"] == np.count_nonzero(~unpaired)
    assert done.summary["outOfBalance"] < 1e-9
    return done


@pytest.mark.parametrize("method", ["paper", *(name for name in ("xnewton", "newton", "incremental"))])
def test_points_without_a_master_by_every_method(mesh, tmp_path, method):
    """The same, whichever way it is solved."""
    pushed = opened(tmp_path / "pushed", mesh, u0=1e6)
    done = opened(tmp_path / "done", mesh, "-method", method, "-steps", 3, "-tol", 1e-8, u0=1e6)
    assert done.force == pytest.approx(pushed.force, rel=1e-6)
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


NODAL = ["-points", "nodal"]
OTHERS = [("contact", lambda x: x < 0.5, NODAL), *(("master", lambda x: abs(x) < 1, more) for more in ([], NODAL))]


@pytest.mark.parametrize("curve, keep, points", cases_of([("contact", lambda x: x > 0.5, [])], OTHERS))
def test_contact_cut_off(mesh, tmp_path, curve, keep, points):
    """Contact that reaches the end of a curve that stops in the middle of the body's side shall be said."""
    short = spoilt(mesh, tmp_path, narrow(curve, keep))
    done = pressed(tmp_path / "short", short, *points, law=LAW)
    whole = pressed(tmp_path / "whole", mesh, *points, law=LAW)
    assert done.force < 0.98 * whole.force
    assert [line for line in done.summary["warnings"] if "reaches the end" in line]
    assert not [line for line in whole.summary["warnings"] if "reaches the end" in line]


OVER = ["-reach", 2, "-u0", 1.5, "-h", 0.5]


@pytest.mark.parametrize(
    "scene, flags, said",
    [
        ("disc-on-block", OVER, True),
        ("disc-on-block", [*OVER, "-geometry", "axisymmetric"], True),
        ("disc-on-block", ["-geometry", "axisymmetric", "-h", 0.5], False),  # the axis is no end
        ("two-cylinders", ["-reach", 0.5, "-h", 0.2], True),
        ("confined-block", ["-law", "exponential"], False),
        ("rough", ["-force", 200, "-h", 0.2, "-modes", 20], False),
        ("wavy", ["-u0", 3, "-geometry", "axisymmetric"], False),
        ("sphere-on-plane", ["-patch", 0.8, "-h", 0.2], True),
    ],
)
def test_ends(scene, flags, said):
    """The end of a body or of the obstacle, and an axis, are no ends at which contact is cut off.

    That of a punch, and those of the other scenes with their defaults: see test_warnings.
    """
    done = run(scene, *flags)
    assert any("raise -" in line for line in done.summary["warnings"]) is said
    assert bool(done.summary["warnings"]) is said


def test_no_force_before_touch():
    """Curved bodies a hair apart shall not press: the gap is that of the circles, not its mean over an element."""
    for order, u0, touch in ((1, 0.09999, False), (2, 0.09999, False), (1, 0.1001, True)):
        done = run("two-cylinders", "-force", 0, "-u0", u0, "-order", order, "-h", 0.1)
        assert done.force > 0 if touch else done.force == 0, (order, u0)
    assert run("two-spheres", "-force", 0, "-u0", 0.09999, "-h", 0.5).force == 0
