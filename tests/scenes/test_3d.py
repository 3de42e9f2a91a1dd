"""In space: a rigid sphere on a box against Hertz, agreement of the methods, counts, units, refusals."""

import numpy as np
import pytest
import reference
from contact.test_two_bodies import confined
from freefem import (
    MULTIGRID,
    ROOT,
    Run,
    cases_of,
    data,
    run,
    run_in,
    scene_text,
    script,
    snippet,
    solve_rows,
    stored,
    told,
    tree,
)

built = pytest.mark.skipif(not MULTIGRID.exists(), reason="the plugin is not built: make mpi")
SCENE = "sphere-on-block"
E, NU = 100.0, 0.3
COARSE = ["-h", 1.2, "-layers", 2, "-tol", 1e-8]
FORCE = 40 * E / (1 - NU**2) / 300  # contact radius a = 1 on a half-space, with R = 10
FINE = ["-law", "signorini", "-d0", 0, "-gap", 0, "-force", FORCE, "-patch", 1.3, "-grading", 80]
FINE_HALF = [*FINE, "-h", 0.1, "-layers", 4, "-symmetry", "half"]


@pytest.mark.parametrize("symmetry, points", [("whole", 49), ("half", 28), ("quarter", 16)])
def test_stiffness_and_points(tmp_path, symmetry, points):
    """Energies of linear displacements, and the weights of the points, shall be exact, and those of the whole."""
    flags = ["-order", 1, "-h", 1, "-patch", 3, "-layers", 2, "-symmetry", symmetry]
    values = told(snippet(tmp_path, scene_text(SCENE) + data("3d/displacements.edp"), *flags))
    volume, shear = 40 * 40 * 20, E / (2 * (1 + NU))
    np.testing.assert_allclose(values["stretch"], volume * 2 * shear * (1 - NU) / (1 - 2 * NU), rtol=1e-11)
    if symmetry != "quarter":  # the displacement does not keep to the mirror y = 0
        np.testing.assert_allclose(values["shear"], volume * shear, rtol=1e-11)
    np.testing.assert_allclose(values["area"], 36, rtol=1e-12)
    assert symmetry != "whole" or abs(values["middle"]) < 1e-10
    assert (values["top"] == 20).all()
    assert values["trace"] < 1e-12
    assert len(values["top"]) == points


@pytest.mark.parametrize("kappa", [1e3, 1e9])
def test_methods_agree(kappa):
    """The paper's scheme, Newton's method, load steps and xnewton shall find one solution, the energy's minimum."""
    best = run(SCENE, *COARSE, "-kappa", kappa)
    milder = (["paper"], ["incremental", "-steps", 2]) if kappa < 1e9 else ()
    for flags in (["paper", "-T0", "d0"], ["newton"], *milder):
        other = run(SCENE, *COARSE, "-kappa", kappa, "-eps", 1e-8, "-method", *flags)
        assert other.force == pytest.approx(best.force, rel=1e-6)
        assert other.energy >= best.energy * (1 - 1e-9)
        np.testing.assert_allclose(other.contact["pressure"], best.contact["pressure"], atol=1e-5 * best.pressureMax)


def test_hard_contact_is_the_limit():
    """xnewton on a wall shall agree with the full system's, and a stiff law with both."""
    wall = run(SCENE, *COARSE, "-method", "signorini")
    assert run(SCENE, *COARSE, "-law", "signorini").force == pytest.approx(wall.force, rel=1e-7)
    assert run(SCENE, *COARSE, "-kappa", 1e18).force == pytest.approx(wall.force, rel=1e-4)
    assert wall.halfWidth is None


LAWS = [["-law", "signorini"], *[["-kappa", k, "-m", m] for k in (1, 1e12) for m in (1.1, 20)]]


@pytest.mark.parametrize("symmetry", cases_of(["quarter", "half"], ["whole"]))
def test_counts(tmp_path, symmetry):
    """At most 5 linearisations and 20 back-substitutions, one factorisation, whatever the law's stiffness."""
    laws = LAWS if symmetry == "quarter" else LAWS[4:]
    flags = ["-order", 1, "-h", 0.8, "-grading", 20, "-symmetry", symmetry]
    for law, sphere in zip(laws, solve_rows(tmp_path, SCENE, laws, *flags), strict=True):
        assert sphere["newton"] <= 5, law
        assert sphere["backsolves"] <= 20, law
        assert sphere["factorisations"] == 1, law
        assert sphere["used"]["kernel"], law


MESH = 'Th = gmshMesh("block-3d", names, values, width);'
UNFOLDED = """values[5] = 2;
mesh3 quarter = gmshMesh("block-3d", names, values, width);
mesh3 side = quarter + movemesh(quarter, [-x, y, z], orientation = -1);
Th = side + movemesh(side, [x, -y, z], orientation = -1);
"""


def test_quarter_is_a_quarter_of_its_images(tmp_path):
    """A loaded quarter, and the block on the quarter's mesh and its mirror images, shall have one solution."""
    package = tree(tmp_path / "package")
    block = package / "edp/scenes/blocks" / "block-space.idp"
    assert block.read_text().count(MESH) == 1
    block.write_text(block.read_text().replace(MESH, UNFOLDED))
    flags = ["-order", 1, "-h", 1.2, "-layers", 2, "-tol", 1e-10, "-bodyForce", 0.1, "-traction", -1]
    quarter = run(SCENE, *flags, "-symmetry", "quarter")
    whole = run_in(package, script(SCENE), *flags, "-symmetry", "whole", "-vtu", 0, out=tmp_path / "out")
    assert whole.points == 169
    assert quarter.points == 49
    for name in ("force", "energy", "pressureMax", "reactionZ", "halfWidthMoment"):
        assert whole.summary[name] == pytest.approx(quarter.summary[name], rel=1e-8), name
    for axis in "XY":
        assert abs(whole.summary[f"reaction{axis}"]) < 1e-8 * whole.force
    assert whole.contact["weight"].sum() == pytest.approx(quarter.contact["weight"].sum(), rel=1e-12)


def test_elements_at_the_rim():
    """Told the contact's radius, P3's force of a stiff law shall be off by 1e-4 and less, within what is said of it."""
    sphere = run(SCENE, "-kappa", 1e9, "-order", 3, "-h", 2, "-grading", 10, "-edges", 1, "-ends", 4.89, "-estimate", 1)
    known = reference.values()["sphere-on-block", 1e9, 3]["force"]
    assert abs(sphere.force / known - 1) < 1e-4
    assert abs(sphere.force - known) < sphere.summary["estimates"]["force"]["error"] < 1e-3 * known
    assert sphere.newton <= 4 and sphere.backsolves <= 25 and sphere.ndof < 25000
    # the greatest pressure, by the scene about the axis in a block as stiff: scattered at the points, then recovered
    greatest = sphere.summary["estimates"]["pressureMax"]
    assert abs(greatest["value"] / 36.293 - 1) < 2e-3 < 5e-3 < sphere.pressureMax / 36.293 - 1
    assert abs(greatest["value"] - 36.293) < greatest["error"]
    # elements of length h along the rim: a polygon of 16 sides in a circle, its radius 1.1 times the rigid section's
    assert sphere.contact["weight"].sum() == pytest.approx(8 * 1.1**2 * 2.25 * 17.75 * np.sin(np.pi / 8), rel=1e-6)


def test_contact_fills_the_rings():
    """P2 touches at the middles of the rim's chords: that contact fills -patch shall be said, of no other."""
    flags = ["-ends", 2, "-order", 2, "-h", 1.5, "-kappa", 1e10, "-patch", 2.5, "-estimate", 0]
    full, within = run(SCENE, *flags, "-u0", 1.4), run(SCENE, *flags, "-u0", 0.5)
    assert any("raise -patch" in text for text in full.summary["warnings"])
    assert 0 < (within.contact["pressure"] > 0).sum() < within.points
    assert not any("raise -patch" in text for text in within.summary["warnings"])


@pytest.mark.parametrize("symmetry", ["half", "whole"])
def test_rim_of_a_half_and_of_a_whole(symmetry):
    """A half and a whole on meshes of rings shall have the quarter's force, but for their meshes."""
    flags = ["-order", 1, "-h", 2, "-ends", 5.4]
    quarter = run(SCENE, *flags)
    more = run(SCENE, *flags, "-symmetry", symmetry)
    assert more.force == pytest.approx(quarter.force, rel=0.02)
    assert 1.8 < more.points / quarter.points < (2.1 if symmetry == "half" else 4.2)


def test_grading():
    """Sizes that grow half as fast, the default, shall halve the error of the force: 1567.7 by an independent code."""
    coarse, usual = run(SCENE, "-grading", 20), run(SCENE)
    assert usual.ndof < 12000
    assert abs(usual.force / 1567.7 - 1) < 0.016 < 0.025 < abs(coarse.force / 1567.7 - 1)


def ridge(sphere):
    """Mean relative errors of the pressure within 0.8 a on x = 0, on y = 0 and elsewhere, over Hertz's greatest."""
    a, greatest = hertz(FORCE, 10, E / (1 - NU**2))
    x, y, pressure = (sphere.contact[name] for name in ("x", "y", "pressure"))
    away = np.hypot(x, y) / a
    error = (pressure - greatest * np.sqrt(np.maximum(1 - away**2, 0))) / greatest
    inside, onX, onY = away < 0.8, abs(x) < 1e-9, abs(y) < 1e-9
    return error[inside & onX].mean(), error[inside & onY].mean(), error[inside & ~onX & ~onY].mean()


def test_no_ridge_on_the_mirror():
    """P1 on a half: pressures on its mirror shall be those beside it, within half a per cent of the greatest."""
    onX, onY, inner = ridge(run(SCENE, *FINE_HALF))
    assert abs(onX - inner) < 0.005
    assert abs(onY - inner) < 0.005


@pytest.mark.parametrize("scene", [SCENE, "sphere-on-plane"])
def test_no_ridge_on_two_mirrors(scene):
    """P2 on a quarter, h = a/5: pressures on both planes shall be those beside them, within 1.5 % of the greatest."""
    flags = FINE if scene == SCENE else ["-force", FORCE]
    balls = run(scene, *flags, "-h", 0.2, "-layers", 2, "-order", 2)
    assert balls.newton <= 4
    onX, onY, inner = ridge(balls)
    assert abs(onX - inner) < 0.015
    assert abs(onY - inner) < 0.015
    assert balls.pressureMax == pytest.approx(hertz(FORCE, 10, E / (1 - NU**2))[1], rel=0.01)


def test_force_and_displacement():
    """The force found for an approach shall, prescribed, give that approach back."""
    pushed = run(SCENE, *COARSE)
    pressed = run(SCENE, *COARSE, "-force", pushed.force, "-patch", 1.1 * np.sqrt(2.25 * (20 - 2.25)))
    assert pressed.approach == pytest.approx(2.5, rel=1e-6)
    np.testing.assert_allclose(pressed.contact["x"], pushed.contact["x"], atol=1e-9)
    np.testing.assert_allclose(pressed.contact["pressure"], pushed.contact["pressure"], atol=1e-5 * pushed.pressureMax)


def test_units():
    """In other units (lengths 1e3 times, pressures 1e-6 times) counts shall be the same and results scaled."""
    here = run(SCENE, *COARSE)
    lengths = {"width": 40, "depth": 20, "R": 10, "gap": 0.5, "u0": 2.5, "d0": -0.25, "h": 1.2}
    flags = [text for name, value in lengths.items() for text in (f"-{name}", value * 1e3)]
    flags += ["-E", 100e-6, "-kappa", 1e3 * 1e-6 / 1e9, "-rho", 100 * 1e-9, "-layers", 2, "-tol", 1e-8]
    there = run(SCENE, *flags)
    assert (there.newton, there.backsolves, there.points) == (here.newton, here.backsolves, here.points)
    assert there.force == pytest.approx(here.force, rel=1e-10)
    assert there.pressureMax == pytest.approx(here.pressureMax * 1e-6, rel=1e-9)
    assert there.halfWidthMoment == pytest.approx(here.halfWidthMoment * 1e3, rel=1e-9)


def test_no_contact():
    """Short of first touch there shall be no force."""
    sphere = run(SCENE, *COARSE, "-u0", 0.2)
    assert sphere.force == sphere.contactPoints == sphere.energy == 0
    assert sphere.overlapMax == pytest.approx(-0.3, rel=1e-12)


def test_contact_up_to_the_edge_is_said():
    """Contact that reaches the edge of the square shall be said in the summary, and stay within the counts."""
    sphere = run(SCENE, "-h", 0.8, "-patch", 3, "-symmetry", "whole")
    assert any("-patch" in text for text in sphere.summary["warnings"])
    assert sphere.contactPoints == sphere.points == 81
    assert sphere.backsolves <= 35


@pytest.mark.parametrize(
    "flags, words",
    [
        (["-order", 4], ["-order 4", "from 1 to 3"]),
        pytest.param(["-order", 3, "-solver", "multigrid"], ["-solver multigrid", "not with -order 3"], marks=built),
        (["-patch", 7.5], ["-patch 7.5", "at most 7"]),
        (["-R", 100, "-patch", 19], ["-patch 19", "at most 18"]),
        (["-patch", 2, "-h", 3], ["-h 3", "at most 2"]),
        (["-layers", 100], ["-layers 100", "at most 10"]),
        (["-ends", 6.8], ["-ends 6.8", "at most 6.6"]),
        (["-edges", 1e-3], ["-edges 0.001", "at least 0.04"]),
        (["-geometry", "strain"], ["-geometry", "unknown flag"]),
        (["-nu", 0.5], ["-nu 0.5", "(-1, 0.5)"]),
    ],
)
def test_refusals(flags, words):
    """What is not allowed in space shall be refused in one line that names the flag and what is allowed."""
    done = stored(SCENE, tuple(map(str, flags)))
    assert done.code == 10
    assert not done.folder.exists()
    for word in words:
        assert word in done.stdout.splitlines()[0]


def test_memory_of_p3(tmp_path):
    """Multigrid does not take P3: its memory shall not be offered."""
    flags = ["-order", 3, "-layers", 1, "-h", 5, "-solver", "none"]
    said = run_in(ROOT, script(SCENE), *flags, out=tmp_path / "out", expect=0).stdout
    assert "unknowns of P3 take" in said and "multigrid;" not in said


def hertz(force, radius, modulus):
    """Radius and greatest pressure of Hertz's circle of contact."""
    a = (0.75 * force * radius / modulus) ** (1 / 3)
    return a, 1.5 * force / (np.pi * a**2)


@pytest.mark.parametrize("kappa", [1e3, 1e9])
def test_two_balls_by_all_methods(kappa):
    """With a deformable master too the methods shall find one solution, under a force and under a displacement."""
    flags = ["-h", 0.3, "-layers", 1, "-law", "power", "-d0", -0.02, "-kappa", kappa, "-tol", 1e-8]
    for load, method in ((["-force", 10], ["newton"]), (["-force", 0, "-u0", 0.3], ["paper", "-eps", 1e-8])):
        best = run("two-spheres", *flags, *load)
        other = run("two-spheres", *flags, *load, "-method", *method)
        assert other.force == pytest.approx(best.force, rel=1e-6)
        np.testing.assert_allclose(other.contact["pressure"], best.contact["pressure"], atol=1e-5 * best.pressureMax)


@pytest.mark.parametrize("ratio", [1e-6, 1e9])
def test_patch_in_space(ratio):
    """Between meshes of 4 and 7 elements a side the pressure shall be exact to 1e-10, whatever the stiffness ratio."""
    done = run("patch-test-3d", "-tol", 1e-11, "-Eratio", ratio)
    modulus = 100 * 0.7 / (1.3 * 0.4)
    exact = confined(1e3, 3, -0.25, 2, (20, 10), (modulus, modulus * ratio))
    np.testing.assert_allclose(done.contact["pressure"], exact, rtol=1e-10)
    assert done.summary["unpairedPoints"] == 0


def test_patch_in_space_nodal_fails():
    """Nodal collocation between different meshes shall show its known fault in space too."""
    pressure = run("patch-test-3d", "-points", "nodal").contact["pressure"]
    assert np.ptp(pressure) > 0.05 * pressure.mean()


@pytest.mark.parametrize(
    "scene, flags, points",
    cases_of(
        [("patch-test-3d", [], "nodal"), ("two-spheres", ["-h", 0.3, "-layers", 1], "segment")],
        [("patch-test-3d", [], "segment"), ("two-spheres", ["-h", 0.3, "-layers", 1], "nodal")],
    ),
)
def test_action_is_reaction(scene, flags, points):
    """Contact forces on the two bodies shall be equal and opposite to 1e-12, their moments to 1e-8."""
    done = run(scene, *flags, "-points", points)
    assert done.summary["masterForceZ"] == pytest.approx(done.force, rel=1e-12)
    for axis in "XY":
        moment = done.summary[f"contactMoment{axis}"] + done.summary[f"masterMoment{axis}"]
        assert abs(moment) < 1e-8 * done.force * 20


def test_an_upper_body_that_is_too_small(tmp_path):
    """Points with no master above them shall stay open and be counted."""
    head, _, _ = (ROOT / script("patch-test-3d")).read_text().partition("include")
    text = head + (ROOT / script("patch-test")).read_text()
    narrow = text.replace(
        "cube(upperElements, upperElements, upperElements, [width",
        "cube(upperElements, upperElements, upperElements, [0.5 * width",
    )
    assert narrow != text
    stdout = snippet(tmp_path, narrow, "-lower", 8, "-u0", 1, "-out", tmp_path / "out")
    done = Run(0, stdout, tmp_path / "out")
    outside = abs(done.contact["x"]) > 7.5 - 1e-9  # the points whose triangles are all beyond the upper block
    assert done.summary["unpairedPoints"] == np.count_nonzero(outside) > 0
    assert (done.contact["pressure"][outside] == 0).all()
    assert done.force > 0


def test_loads_in_space():
    """The supports shall carry a body force too, which lowers the block; pressure on its sides raises it."""
    unloaded = run(SCENE, *COARSE)
    assert run(SCENE, *COARSE, "-bodyForce", 0.1).force < unloaded.force  # the invariants check the balance
    assert run(SCENE, *COARSE, "-traction", -1).force > unloaded.force


@pytest.mark.parametrize(
    "scene, flags", cases_of([("patch-test-3d", ["-u0", 2.0])], [("two-spheres", ["-h", 0.3, "-layers", 1])])
)
def test_bodies_that_almost_touch(scene, flags):
    """However small the gap, the bodies shall not be joined: the same force, and the supports carry it."""
    close, apart = (run(scene, *flags, "-gap", gap) for gap in (1e-9, 1e-2))
    assert close.reactionZ == pytest.approx(close.force, rel=1e-6)
    assert close.force == pytest.approx(apart.force, rel=0.01)
