"""The estimates of the error and `-accuracy`, against references by an independent code and against finer meshes."""

from itertools import count

import coverage
import numpy as np
import pytest
import reference
from freefem import ROOT, run_in, script

HARD = (float("inf"), 1.0)


@pytest.fixture
def solved(tmp_path):
    """solved(scene, *flags) runs a scene; its summary."""

    numbers = count()

    def go(scene, *flags, expect=0):
        return run_in(ROOT, script(scene), *flags, "-vtu", 0, out=tmp_path / str(next(numbers)), expect=expect)

    return go


def true_errors(run, kappa, m):
    """quantity: |value - reference| for the disc on the block."""
    known = reference.values()["disc-on-block", kappa, m]
    return {name: abs(run.summary[name] - known[name]) for name in ("force", "pressureMax", "halfWidth")}


@pytest.mark.parametrize("order, h", [(1, 0.25), (2, 0.5), (4, 1), (4, 0.5)])
@pytest.mark.parametrize("law", [(1e3, 3), (1e9, 3), (1e3, 10), HARD])
def test_estimates_hold(solved, order, h, law):
    """The error that is said shall be at least the true one, and not too much more."""
    flags = ["-law", "signorini"] if law == HARD else ["-kappa", law[0], "-m", law[1]]
    run = solved("disc-on-block", *flags, "-order", order, "-h", h, "-tol", 1e-8)
    true = true_errors(run, *law)
    for name, error in true.items():
        assert run.estimates[name]["error"] >= error, name
    # now and then the true error changes its sign: then what is said is small at least
    assert run.estimates["force"]["error"] <= max(30 * true["force"], 1e-5 * run.force)
    assert sum(run.estimates["parts"].values()) == pytest.approx(run.estimates["force"]["error"])


@pytest.mark.parametrize("order, h", [(1, 1), (2, 2), (2, 1.4)])
def test_in_space(solved, order, h):
    """In space too: the sphere on the block."""
    run = solved("sphere-on-block", "-order", order, "-h", h)
    known = reference.values()["sphere-on-block", 1e3, 3]
    for name in ("force", "pressureMax"):
        assert abs(run.summary[name] - known[name]) <= run.estimates[name]["error"], name
    assert run.estimates["force"]["error"] <= 15 * abs(run.force - known["force"])


def test_printed(solved):
    """The run shall print its numbers with their errors."""
    run = solved("disc-on-block", "-h", 1)
    assert "±" in run.stdout and "greatest pressure" in run.stdout.split("within")[1]


@pytest.mark.parametrize("tol", [1e-2, 1e-3])
def test_algebra(solved, tol):
    """What the algebra leaves shall be predicted within a fifth."""
    exact = solved("disc-on-block", "-h", 1, "-tol", 1e-12)
    loose = solved("disc-on-block", "-h", 1, "-tol", tol, "-start", "none", "-forcing", 0.9, "-kappa", 1e3)
    assert 1e-9 < loose.residual < 1e-2
    assert loose.estimates["parts"]["algebra"] == pytest.approx(abs(loose.force - exact.force), rel=0.2)


def test_model(solved):
    """What the threshold leaves shall be told apart and be of the right size."""
    flags = "-method", "paper", "-order", 1, "-T0", "d0", "-kappa", 1e9, "-h", 0.5
    rough = solved("disc-on-block", *flags, "-eps", 0.2)
    exact = solved("disc-on-block", *flags, "-eps", 1e-10)
    true = abs(rough.force - exact.force)
    assert rough.wallPoints > 0 and true > 0
    assert rough.estimates["parts"]["model"] == pytest.approx(true, rel=0.5)


def test_prescribed_force(solved):
    """Under a prescribed force the approach has the error, the force none."""
    coarse = solved("disc-on-block", "-force", 150, "-h", 1)
    fine = solved("disc-on-block", "-force", 150, "-order", 4, "-h", 0.25)
    assert coarse.estimates["force"]["error"] == 0
    assert (
        abs(coarse.approach - fine.approach)
        <= coarse.estimates["approach"]["error"]
        <= 20 * abs(coarse.approach - fine.approach)
    )


def test_counts_are_apart(solved):
    """The estimates shall change no count of the run, and cost no more back-substitutions than a few."""
    told, silent = (solved("disc-on-block", "-estimate", wanted) for wanted in (1, 0))
    for name in ("backsolves", "factorisations", "newton", "kernelNewton", "force"):
        assert told.summary[name] == silent.summary[name]
    assert 1 <= told.estimates["backsolves"] <= 8
    assert silent.estimates is None and silent.notEstimated == "-estimate 0"


def test_not_believed(solved):
    """Where a case is not covered no error shall be said, and why."""
    run = solved("adhesive-cylinder", "-h", 0.02)
    assert run.estimates is None and run.notEstimated
    assert solved("flat-punch", "-law", "signorini").estimates["pressureMax"] is None


def test_too_coarse(solved):
    """A mesh that is too coarse to mean anything shall be said to be."""
    run = solved("disc-on-block", "-order", 1, "-h", 2, "-u0", 0.6)
    assert any("too coarse to mean anything" in text for text in run.warnings)
    assert run.estimates["force"]["error"] > 0.3 * run.force


@pytest.mark.parametrize("kappa", [1e3, 1e9])
def test_accuracy(solved, kappa):
    """-accuracy shall be kept by the true error, with few unknowns and few meshes."""
    run = solved("disc-on-block", "-kappa", kappa, "-accuracy", 1e-5)
    known = reference.values()["disc-on-block", kappa, 3]["force"]
    assert abs(run.force / known - 1) <= run.accuracy["reached"] <= 1e-5
    assert run.accuracy["met"] and run.accuracy["meshes"] <= 4
    assert kappa > 1e3 or run.ndof <= 6000


def test_accuracy_of_the_pressure(solved):
    """The pressure's profile shall be as near as was asked for."""
    run = solved("disc-on-block", "-accuracy", 1e-3, "-goal", "pressure")
    assert reference.profile_error(1e3, 3, {name: run.contact[name] for name in run.contact.dtype.names}) <= 1e-3
    assert run.ndof <= 10000


def test_accuracy_is_deterministic(solved):
    """Two runs shall give the same numbers."""
    first, second = (solved("disc-on-block", "-accuracy", 1e-4, "-kappa", 1e6) for _ in range(2))
    assert first.force == second.force and first.ndof == second.ndof


def test_accuracy_on_curves(solved):
    """New meshes of two cylinders shall stay on the circles."""
    run = solved("two-cylinders", "-accuracy", 1e-4)
    assert run.accuracy["met"] and run.accuracy["meshes"] > 1
    vertices = run.contact[::4]
    assert np.ptp(vertices["y"] - np.sqrt(100 - vertices["x"] ** 2)) < 1e-9


@pytest.mark.parametrize(
    "scene, flags, why",
    [
        ("disc-on-block", ["-unknowns", 5000, "-law", "signorini"], "unknowns"),
        ("flat-punch", ["-goal", "pressure", "-law", "signorini"], "no estimate"),
    ],
)
def test_accuracy_missed(solved, scene, flags, why):
    """What cannot be reached shall be said, with code 21 and the files of the best mesh."""
    run = solved(scene, "-accuracy", 1e-6, *flags, expect=21)
    assert not run.accuracy["met"] and why in run.accuracy["why"] and "NOT REACHED" in run.stdout


@pytest.mark.parametrize(
    "scene, flags", [("disc-on-block", ["-force", 5, "-goal", "force"]), ("disc-on-block", ["-goal", "approach"])]
)
def test_goals_refused(solved, scene, flags):
    """What is prescribed cannot be asked for."""
    run = solved(scene, "-accuracy", 1e-3, *flags, expect=10)
    assert "-goal" in run.stdout and "allowed" in run.stdout


def test_coverage_is_judged():
    """A number is covered where what is said is at least its distance from the reference's."""
    empty = {f"{name}{kind}": "" for name in coverage.QUANTITIES for kind in ("Value", "Said", "True")}
    common = empty | {"status": "converged", "order": "2"}
    rows = [
        common | {"name": "a: reference", "forceValue": "10", "forceSaid": "0.001"},
        common | {"name": "a", "forceValue": "10.1", "forceSaid": "0.2"},
        common | {"name": "a", "forceValue": "9.5", "forceSaid": "0.2", "approachValue": "2", "approachSaid": "0"},
    ]
    numbers = coverage.judged(rows)
    assert [round(n["said"] / n["true"], 9) for n in numbers] == [2, 0.4]
    assert "| force | P2 | 2 | 50.0 % | 1.2 |" in coverage.table(numbers)
