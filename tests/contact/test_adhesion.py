"""Surfaces that attract: the law, the stable step, paths with jumps, against closed forms and an independent code."""

import re

import numpy as np
import pytest
from freefem import (
    FREEFEM,
    ROOT,
    cases_of,
    flag_text,
    interrupt,
    run,
    run_in,
    script,
    snippet,
    table,
    told,
)
from text_boxes import faults

from contact.test_laws import GRAPH_ROWS, LAW_ROWS, evaluate
from postprocess import style
from postprocess.figures import attraction, attraction_profiles
from postprocess.path_movie import PathMovie, along_path
from postprocess.results import read_run

E, NU, R, GAP = 100, 0.3, 10, 1e-3  # the scene's defaults, GAP the gap at rest
MODULUS = E / (1 - NU**2)
SPHERE = "adhesive-sphere"
LJ = ["-law", "lennard-jones"]
OPTION = {"options": "macro eachOption(do, what) do(adhesion, what) //\n"}

# sphere on a half-space, by Tabor's number: an independent boundary element code, 0.1 %
PULL_OFF = {0.05: -1.9883, 0.3: -1.8698, 1: -1.6702, 2: -1.5834}  # over pi w R
JUMP_IN = {1: 2.629, 2: 3.552}  # undeformed gap over GAP
JUMP_OFF = {1: -1.743, 2: -3.381}  # approach over GAP
LOOP = {2: 0.915}  # over pi w R GAP


def flags(mu, path=None, per_length=0.2, steps=5, order=1):
    """A sphere with Tabor's number mu, elements of per_length times the cohesive length (at most 0.2 sqrt(R GAP))."""
    work = mu**1.5 * MODULUS * GAP**1.5 / np.sqrt(R)
    h = min(per_length * MODULUS * GAP**2 / work, 0.2 * np.sqrt(R * GAP))
    fine = np.sqrt(R * GAP) * max(2, 1.3 * mu**0.8 + 1.5)
    given = ["-w", float(work), "-h", float(h), "-fine", float(fine), "-grading", float(2 / h), "-order", order]
    if path is not None:
        given += ["-path", " ".join(f"{GAP * end:.12g}" for end in path), "-steps", steps]
    return given, np.pi * work * R


def whole_path(mu):
    """Approaches, over GAP: apart, into contact, and as far apart again."""
    far = min(-2.641 * mu ** (3 / 7) - 0.5, JUMP_OFF.get(mu, -2) - 0.5)
    return far, 0.6 * mu + 0.5, far


def follow(mu, **choices):
    """The run along the whole path, its table, and the unit of force."""
    given, unit = flags(mu, whole_path(mu), **choices)
    done = run(SPHERE, *given)
    return done, table(done.folder / "path.csv"), unit


# ---------------------------------------------------------------- the law


def lennard_jones(gap, work, rest):
    """(pressure, slope against the overlap, energy) at a gap."""
    x = rest / gap
    pressure = 8 * work / (3 * rest) * (x**9 - x**3)
    slope = 8 * work / (3 * rest) * (9 * x**9 - 3 * x**3) / gap
    return pressure, slope, 8 * work / 3 * (x**8 / 8 - x**2 / 2)


def test_lennard_jones(tmp_path):
    """Pressure, slope, energy and inverse shall be the formulas', and each other's derivatives."""
    work, rest = 0.37, 0.02
    gaps = rest * np.array([0.3, 0.7, 0.999999, 1.0, 1.1, 3 ** (1 / 6), 7.5 ** (1 / 6), 2.0, 10, 1e4])
    step = 1e-6 * gaps
    s = np.concatenate([-gaps, -gaps - step, -gaps + step])
    law = evaluate(tmp_path, LAW_ROWS, s, "-method", "newton", *LJ, "-w", work, "-eps0", rest, **OPTION)
    pressure, slope, energy = lennard_jones(gaps, work, rest)
    scale = work / rest
    np.testing.assert_allclose(law["pressure"][:10], pressure, rtol=1e-12, atol=1e-14 * scale)
    np.testing.assert_allclose(law["slope"][:10], slope, rtol=1e-12, atol=1e-13 * scale / rest)
    np.testing.assert_allclose(law["potential"][:10], energy, rtol=1e-12)
    np.testing.assert_allclose(law["inverse"][:4], -gaps[:4], rtol=1e-12)
    for function, derivative in (("pressure", slope * rest), ("potential", pressure)):
        _, low, high = law[function].reshape(3, -1)
        low, high = (low * rest, high * rest) if function == "pressure" else (low, high)
        np.testing.assert_allclose((high - low) / (2 * step), derivative, rtol=1e-6, atol=1e-8 * scale)
    assert law["potential"][3] == pytest.approx(-work, rel=1e-14)
    assert law["pressure"][5] / scale == pytest.approx(-1.0264, rel=1e-4)
    assert law["slope"][6] / scale * rest == pytest.approx(-1.25276, rel=1e-5)


def test_infinite_where_the_surfaces_meet(tmp_path):
    """At no gap pressure, slope and energy shall be infinite, not numbers that are none."""
    law = evaluate(tmp_path, LAW_ROWS, [0.0, 0.1, 1e9], "-method", "newton", *LJ, **OPTION)
    for name in ("pressure", "slope", "potential"):
        assert (law[name] == np.inf).all()


def test_graph_point_of_a_law_that_falls(tmp_path):
    """For k above the steepest fall the law's point on a line shall be the one that bisection finds."""
    work, rest = 0.37, 0.02
    k = 3 * 1.25276 * work / rest**2
    rows = [(s, p, k, 0.0) for s in (-0.1, -0.03, -0.02, 0.0, 0.05) for p in (-60.0, 0.0, 3.0, 1e4)]
    found = evaluate(tmp_path, GRAPH_ROWS, rows, "-method", "newton", *LJ, "-w", work, "-eps0", rest, **OPTION)
    for (s, p, *_), at, pressure in zip(rows, found["s"], found["p"], strict=True):
        low, high = -10.0, -1e-6
        for _ in range(200):
            middle = 0.5 * (low + high)
            above = lennard_jones(-middle, work, rest)[0] + k * middle > p + k * s
            low, high = (low, middle) if above else (middle, high)
        assert at == pytest.approx(low, rel=1e-10)
        assert pressure == pytest.approx(lennard_jones(-low, work, rest)[0], rel=1e-7, abs=1e-9 * work / rest)


# ---------------------------------------------------------------- single loads


def test_force_is_the_energys_derivative():
    """The force shall be dE/du0."""
    low, middle, high = (run(SPHERE, "-u0", u0, "-tol", 1e-10) for u0 in (-2.01e-4, -2e-4, -1.99e-4))
    assert (high.energy - low.energy) / 2e-6 == pytest.approx(middle.force, rel=1e-5)
    assert middle.force < 0


def test_change_of_units():
    """The same problem in other units shall take the same steps to the same numbers."""
    one = run(SPHERE, "-u0", 0.0005)
    lengths = {"-width": 20, "-depth": 20, "-h": 0.02, "-R": 10, "-reach": 1.5, "-fine": 0.3}
    lengths |= {"-gap": 1e-3, "-eps0": 1e-3, "-u0": 0.0005}
    scaled = [word for flag, value in lengths.items() for word in (flag, 1e3 * value)]
    other = run(SPHERE, *scaled, "-E", 1e8, "-w", 1.0989011e6)
    assert other.newton == one.newton
    assert other.force == pytest.approx(1e12 * one.force, rel=1e-8)


@pytest.mark.parametrize(
    "mu, approach",
    cases_of([(0.05, 0.0), (0.3, -0.3), (1, -1.2), (1, 1.0), (3, -4)], [(1, -3.0), (2, 1.0), (5, 1.5)]),
)
def test_from_rest_in_one_step(mu, approach):
    """From no forces the step shall come to a stable state, in few linearisations of few back-substitutions."""
    given, _ = flags(mu)
    done = run(SPHERE, *given, "-u0", GAP * approach)
    assert done.stability > 0
    assert done.newton <= 16
    assert done.backsolves <= 12 * done.newton + 12


def test_rivals():
    """The paper's thresholds and line search shall find the same state; plain Newton shall fail by name."""
    ours = run(SPHERE, "-u0", 0.0005)
    for method in ("paper", "linesearch"):
        assert run(SPHERE, "-u0", 0.0005, "-method", method).force == pytest.approx(ours.force, rel=1e-6)
    lost = run(SPHERE, "-u0", 0.0, "-method", "newton", expect=20)
    assert "infinite" in lost.message and "-method xnewton" in lost.message


def test_table_that_falls(tmp_path):
    """A table of Lennard-Jones' values shall give its state; one that falls without pulling shall be refused."""
    work, far = 1.0989011e-3, 0.1
    gaps = np.geomspace(far, 0.6 * GAP, 500)
    pressure = lennard_jones(gaps, work, GAP)[0] - lennard_jones(far, work, GAP)[0]
    pressure[0] = 0
    file = tmp_path / "law.csv"
    file.write_text("".join(f"{-g:.15g},{p:.15g}\n" for g, p in zip(gaps, pressure, strict=True)))
    given = ["-law", "table", "-table", file, "-d0", -far, "-u0", 0.0003]
    assert run(SPHERE, *given).force == pytest.approx(run(SPHERE, "-u0", 0.0003).force, rel=2e-3)
    file.write_text("0,0\n1,2\n2,1\n3,4\n")
    refused = run_in(ROOT, script(SPHERE), *given[:4], "-d0", -4, out=tmp_path / "out", expect=10)
    assert "falls, but not from 0" in refused.stdout


def test_in_space():
    """The sphere in space shall pull like the axisymmetric one, to 2 %."""
    space = run("adhesive-sphere-3d", "-u0", -0.00087, "-fine", 0.15)
    assert space.stability > 0
    assert space.force == pytest.approx(run(SPHERE, "-u0", -0.00087).force, rel=0.02)


def test_two_bodies():
    """Two cylinders shall be stable in one step; the forces on both shall be the same."""
    given = ["-R1", 20, "-R2", 20, "-E1", 200, "-E2", 200, "-force", 0, *LJ, "-w", 0.0011, "-gap", GAP, "-u0", -0.0005]
    done = run("attraction/two-cylinders", *given, "-reach", 0.5, "-h", 0.02, "-grading", 100)
    assert done.stability > 0
    assert done.force < 0
    assert done.masterForceY == pytest.approx(done.force, rel=1e-9)


# ---------------------------------------------------------------- paths


@pytest.mark.parametrize("mu", cases_of([0.05, 2], [0.3, 1]))
def test_pull_off(mu):
    """The least force on the whole path shall be that of the half-space to 0.5 %, with five increments each way."""
    done, _, unit = follow(mu)
    assert done.pullOff / unit == pytest.approx(PULL_OFF[mu], rel=0.005)


def test_bradley():
    """For a stiff sphere the pull-off force shall be 2 pi w R."""
    given, unit = flags(0.01, (-1, 0.5, -1))
    assert run(SPHERE, *given).pullOff / unit == pytest.approx(-2, rel=0.007)


def test_no_jump_below_tabors_limit():
    """Without an instability loading and unloading shall be one curve."""
    done, rows, unit = follow(0.3)
    assert done.jumps == []
    there, back = rows[rows["leg"] == 1], rows[rows["leg"] == 2]
    assert back["force"][-1] == pytest.approx(there["force"][0], rel=1e-9)
    assert abs(done.loopWork) < 0.05 * unit * GAP


@pytest.mark.parametrize("per_length", [0.2, 0.1])
def test_two_jumps(per_length):
    """At Tabor's number 2 there shall be two jumps on fine enough meshes, where and of the energy that theory has."""
    done, rows, unit = follow(2, per_length=per_length)
    into, off = done.jumps
    located = 0.02 + 0.05
    assert into["gap"] / GAP == pytest.approx(JUMP_IN[2], rel=0.01, abs=located)
    assert off["approach"] / GAP == pytest.approx(JUMP_OFF[2], rel=0.01, abs=located)
    assert done.dissipated / (unit * GAP) == pytest.approx(LOOP[2], rel=0.03)
    assert done.dissipated == pytest.approx(done.loopWork, rel=0.01)
    assert (rows["stability"] >= 0).all()  # 0 at the folds
    assert rows["jump"].sum() == 2
    smooth = rows[rows["jump"] == 0]
    assert (smooth["dissipated"] == 0).all()


def test_fold():
    """A jump shall begin where the branch ends: at a fold, from which no energy is put in, at one approach."""
    done, rows, unit = follow(1, per_length=0.1, order=2)
    into, off = done.jumps
    assert into["gap"] / GAP == pytest.approx(JUMP_IN[1], rel=0.005)
    assert off["approach"] / GAP == pytest.approx(JUMP_OFF[1], rel=0.005)
    assert done.dissipated == pytest.approx(done.loopWork, rel=0.015)
    assert done.dissipated / (unit * GAP) == pytest.approx(0.079, rel=0.03)
    after = np.nonzero(rows["jump"])[0]
    np.testing.assert_array_equal(rows["approach"][after], rows["approach"][after - 1])
    np.testing.assert_array_equal(rows["stability"][after - 1], 0)


def test_dissipation_whatever_the_steps():
    """What a loop dissipates shall not depend on its increments, and be the work done along it."""
    runs = [run(SPHERE, "-path", "-0.0031 0.0011 -0.0031", "-steps", steps) for steps in (5, 20)]
    lost = [done.dissipated for done in runs]
    assert lost == pytest.approx([lost[0]] * 2, rel=1e-4)
    assert [done.loopWork for done in runs] == pytest.approx(lost, rel=1e-4)
    assert runs[1].workByForces == pytest.approx(lost[1], rel=0.08)


@pytest.mark.parametrize("mu, most", [(0.05, 42), (1, 92), (2, 165)])
def test_linearisations_of_a_loop(mu, most):
    """Five increments each way shall need few linearisations, C a back-substitution a point."""
    done, *_ = follow(mu)
    assert done.newton <= most
    assert done.backsolves <= done.points + 5


@pytest.mark.parametrize("scene, wide", [(SPHERE, 0.17274), ("adhesive-cylinder", 0.187046)])  # P2, h = 0.005
def test_error_of_a_state(scene, wide):
    """What -tol leaves shall be told to 1 %; contact ends where the pull is greatest, known to a part of an element."""
    tight, loose = (run(scene, "-tol", tol, "-estimate", 1) for tol in (1e-10, 1e-3))
    assert loose.estimates["parts"]["algebra"] == pytest.approx(abs(loose.force - tight.force), rel=0.01)
    assert abs(tight.halfWidth - wide) <= tight.estimates["halfWidth"]["error"] < 0.7 * tight.parameters["h"]


def test_near_a_fold():
    """Nearer to a fold than the mesh has it, no error shall be told: that of the linear problem would be too small."""
    near = run(SPHERE, "-u0", -0.0015, "-estimate", 1)
    assert near.stability > 0 and near.estimates is None
    assert "nearer to a fold" in near.notEstimated


def test_start_on_the_model():
    """Started on the kernel's model, a solution shall take less than half the linearisations."""
    assert 2 * run(SPHERE).newton < run(SPHERE, "-start", "none").newton


def test_error_of_a_path():
    """What the mesh has a path's numbers off by shall be in their errors, which are no more than some times it."""
    ends = "-path", "-0.0031 0.0011 -0.0031"
    told, silent = (run(SPHERE, *ends, "-steps", 5, "-estimate", wanted) for wanted in (1, 0))
    assert (table(told.folder / "path.csv") == table(silent.folder / "path.csv")).all()
    # P2, h = 0.005
    jumps = [
        {"approach": -0.00162493, "forceBefore": -0.0235411, "forceAfter": -0.0465583, "dissipated": 1.57822e-6},
        {"approach": -0.00173697, "forceBefore": -0.0355372, "forceAfter": -0.0169113, "dissipated": 1.09669e-6},
    ]
    pairs = [(told.pullOff, told.pathErrors["pullOff"], -0.0576604)]
    pairs += [(told.dissipated, told.pathErrors["dissipated"], 2.67491e-6)]
    pairs += [(told.force, told.estimates["force"]["error"], -0.00574563)]
    for jump, error, known in zip(told.jumps, told.pathErrors["jumps"], jumps, strict=True):
        pairs += [(jump[name], error[name], known[name]) for name in known]
    shares = [abs(value - known) / error for value, error, known in pairs]
    assert max(shares) <= 1 and np.median(shares) > 0.2
    assert told.pathErrors["loopWork"] == pytest.approx(told.pathErrors["dissipated"], rel=1e-6)
    assert told.pathErrors["notKnown"] == ""
    for name in ("least force", "dissipated in jumps", "work along the path"):
        assert re.search(rf"^  {name} +[-\d.e]+ ± ", told.stdout, re.M), name


def test_accuracy_of_a_law_that_falls(tmp_path):
    """New meshes shall bring the force to what is asked for, of a law whose tangent is not positive."""
    given = "-u0", -0.0005, "-accuracy", 1e-3, "-order", 2, "-vtu", 0
    done = run_in(ROOT, script(SPHERE), *given, out=tmp_path / "out")
    assert done.accuracy["met"] and abs(done.force / -0.0563099 - 1) <= done.accuracy["reached"] <= 1e-3
    assert abs(done.halfWidth - 0.1527) <= done.estimates["halfWidth"]["error"] + 1e-4


def test_path_of_forces(tmp_path):
    """Prescribed forces shall be met, on the approaches' own curve, and refused by name beyond the least one."""
    given = ["-control", "force", "-steps", 2]
    done = run(SPHERE, *given, "-path", "0.02 -0.03", "-estimate", 1)
    rows = table(done.folder / "path.csv")
    np.testing.assert_allclose(rows["force"], [0.02, -0.005, -0.03], atol=1e-8)
    off = abs(done.approach - 0.001046811)  # P2, h = 0.006
    assert off <= done.estimates["approach"]["error"] < 0.05 * done.approach
    assert abs(done.force + 0.03) <= done.estimates["force"]["error"] < 1e-8
    assert done.warnings == []
    assert run(SPHERE, "-u0", float(rows["approach"][2])).force == pytest.approx(-0.03, rel=1e-6)
    lost = run(SPHERE, *given, "-path", "0 -0.09", expect=20)
    assert "no stable state carries the force -0.09" in lost.message
    refused = run_in(ROOT, script(SPHERE), "-control", "force", out=tmp_path / "out", expect=10)
    assert "-control force: only with" in refused.stdout


def test_profiles():
    """profiles.csv shall hold the pressures and overlaps of every state, and be on the law."""
    done, rows, _ = follow(2)
    profiles = table(done.folder / "profiles.csv")
    assert len(profiles) == len(rows) * done.points
    work = done.parameters["w"]
    expected = lennard_jones(-profiles["overlap"], work, GAP)[0]
    np.testing.assert_allclose(profiles["pressure"], expected, atol=1e-4 * work / GAP)


def test_unstable_branch():
    """The whole curve shall turn back twice, unstable in between, and hold the stable branches of the path."""
    given, unit = flags(2, (-3.9, 1.7))
    done = run(SPHERE, *given, "-branch", "unstable")
    rows = table(done.folder / "path.csv")
    into, off = done.folds
    assert 1 - into / GAP == pytest.approx(JUMP_IN[2], rel=0.01)
    assert off / GAP == pytest.approx(JUMP_OFF[2], rel=0.01)
    turned = np.sign(rows["stability"])
    assert np.count_nonzero(np.diff(turned)) == 2
    assert (rows["approach"][turned < 0] > off - 1e-9).all() and (rows["approach"][turned < 0] < into + 1e-9).all()
    assert rows["force"].min() / unit == pytest.approx(PULL_OFF[2], rel=0.005)


def test_monotone_path():
    """A law that only pushes shall be loaded and unloaded along the same curve, without jumps."""
    done = run("attraction/disc-on-block", "-h", 0.5, "-path", "0.5 2.5 1.5", "-steps", 2)
    rows = table(done.folder / "path.csv")
    np.testing.assert_allclose(rows["approach"], [0.5, 1.5, 2.5, 2.0, 1.5])
    assert rows["force"][4] == pytest.approx(rows["force"][1], rel=1e-5)
    assert rows["force"][2] == pytest.approx(run("disc-on-block", "-h", 0.5).force, rel=1e-5)


def test_path_goes_on(tmp_path):
    """A path that was interrupted shall go on after its last state, to the same end."""
    given, _ = flags(1, whole_path(1))
    given += ["-estimate", 0]
    whole, rows, _ = follow(1)
    again, words = tmp_path / "again", [*FREEFEM, script(SPHERE), *map(flag_text, given), "-vtu", "0"]
    path = again / "path.csv"
    interrupt([*words, "-out", again], lambda: path.exists() and len(table(path)) > 5)
    kept = len(table(again / "path.csv"))
    done = run_in(ROOT, script(SPHERE), *given, "-vtu", 0, out=again)
    # table and state are put in place one after the other, and a fold only with the state after its jump
    begun = re.search(r"goes on after state (\d+),", done.stdout)
    assert begun and kept - 2 <= int(begun[1]) <= kept + 2, (kept, done.stdout)
    # it may stop once more on the way to a fold
    found = table(again / "path.csv")["force"]
    assert len(rows) <= len(found) <= len(rows) + 2
    assert all(abs(found - force).min() <= 1e-6 * abs(force) for force in rows["force"])
    assert done.dissipated == pytest.approx(whole.dissipated, rel=1e-6)
    assert done.newton < whole.newton


def test_waves_snap_in_one_after_the_other():
    """The waves' contacts shall snap in at approaches of their own, and every jump dissipate."""
    done = run("adhesive-wavy", "-path", "-0.006 0 -0.008")
    closing = [jump for jump in done.jumps if jump["forceAfter"] < jump["forceBefore"]]
    assert len(closing) >= 3
    assert len({jump["approach"] for jump in closing}) == len(closing)
    assert all(jump["dissipated"] > 0 for jump in done.jumps)


def test_figures_and_movie(tmp_path):
    """A path's figures and movie shall be drawn from its run, with an arrow a jump and the least force where it is."""
    done, rows, unit = follow(2)
    with style.look():
        drawn = [each.draw([read_run(done.folder)], style.Units()) for each in (attraction, attraction_profiles)]
        assert [faults(each) for each in drawn] == [[], []]
    ((axes,), profiles) = (each.axes for each in drawn)
    arrows = [text for text in axes.texts if text.arrow_patch is not None]
    assert len(arrows) == len(done.jumps) == 2
    drawn = np.concatenate([line.get_ydata() for line in axes.lines if line.get_color() == style.CURVES[0]])
    assert drawn.min() == pytest.approx(done.pullOff / unit, rel=2e-3)
    assert all(len(axes.lines) > 3 for axes in profiles)
    movie = PathMovie(read_run(done.folder), style.Units())
    assert along_path(read_run(done.folder))
    assert movie.count == len(rows)
    movie.draw(int(np.nonzero(rows["jump"])[0][0]))
    assert "jumped" in movie.title(int(np.nonzero(rows["jump"])[0][0]))


# ---------------------------------------------------------------- refusals and warnings


@pytest.mark.parametrize(
    "words, said",
    [
        (["-w", 0], "-w 0: out of range"),
        (["-eps0", -1e-3], "-eps0 -0.001: out of range"),
        (["-gap", 0], "-gap 0: the surfaces would meet"),
        (["-force", 1], "-force 1: not with the law lennard-jones"),
        (["-reach", 0.4], "-reach 0.4: "),
        (["-d0", -0.1], "-d0 -0.1: the law lennard-jones counts from"),
        (["-law", "power"], "-law power: does not attract"),
        (["-path", "1"], '-path "1": not a path'),
        (["-path", "1 1"], '-path "1 1": not a path'),
        (["-path", "1 b"], "b: not a number"),
        (["-path", "0 1", "-history", 1], "not with -history 1"),
        (["-path", "0 1 0", "-branch", "unstable"], "not with -branch unstable"),
        (["-branch", "unstable"], "-branch unstable: only with"),
        (["-path", "0 1", "-accuracy", 0.1], "not with -accuracy"),
        (["-T0", 0, "-method", "paper"], "-T0 0: out of range"),
        (["-h", 0.08], "-h 0.08: mesh too coarse for this adhesive law (resolution 0."),
    ],
)
def test_refused(words, said, tmp_path):
    """What cannot be shall be refused in one line that says what is allowed, and nothing written."""
    done = run_in(ROOT, script(SPHERE), *words, out=tmp_path / "out", expect=10)
    (line,) = done.stdout.splitlines()
    assert said in line
    assert "allowed" in line
    assert not (tmp_path / "out").exists()


def test_fold_leaves_the_dual(tmp_path):
    """What a fold near by adds to the error is found with a dual of its own; the present one is there again."""
    code = """setAdjointOfForces(adjointForces, adjointLoadOverlap);
    real[int] change = adjointDisplacement;
    real unused = 1;
    correctForSofteningLaw(unused, unused);
    change -= adjointDisplacement;
    tell("share", change.linfty / adjointDisplacement.linfty);
    """
    text = (ROOT / "edp/scenes/adhesive-cylinder.edp").read_text() + code
    found = told(snippet(tmp_path, text, "-vtu", 0, "-out", tmp_path / "out"))
    assert found["share"][0] < 1e-12


def test_coarse_mesh():
    """A mesh that hardly carries the law's fall shall be warned of; one that does not runs on demand."""
    assert run(SPHERE).warnings == []
    hardly = run(SPHERE, "-h", 0.03)
    assert ["lower -h" in text for text in hardly.warnings] == [True]
    assert 0.4 < hardly.cohesion < 0.8
    coarse = run(SPHERE, "-h", 0.08, "-force-coarse", 1)
    assert coarse.cohesion < 0.4
    assert coarse.warnings
