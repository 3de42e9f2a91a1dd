"""What the package claims: the paper's count, accuracy, agreement of the methods, invariance, cost, limits."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from freefem import WALL, cases_of, named, run, table

# converged values of the paper's test, from an independent code: data/README.md
FORCE, PRESSURE_MAX, HALF_WIDTH = 150.02947, 22.559747, 4.927623
PROFILE = Path(__file__).parents[1] / "data" / "disc_on_block_base.csv"
# the same with exponent 10
FORCE_M10, PRESSURE_MAX_M10, HALF_WIDTH_M10 = 114.04577, 19.478949, 5.464573

DISC, TWO_BODIES, BLOCK = "disc-on-block", "meshed-disc", "confined-block"
PAPER = ["-method", "paper", "-T0", "0", "-h", 0.5, "-tol", 1e-6, "-eps", 1e-4, "-order", 1]
FINE = ["-order", 2, "-h", 0.25]
EXACT_STOP = ["-eps", 1e-12, "-tol", 1e-10]


def near(value, reference, relative):
    return abs(value / reference - 1) <= relative


# ---------------------------------------------------------------- the paper's count


@pytest.mark.parametrize("scene", [DISC, TWO_BODIES])
def test_the_papers_count(scene):
    """The paper's scheme at h = 0.5 shall take 3 adaptations, 11 to 13 Newton steps, with the disc meshed as well."""
    paper = run(scene, *PAPER)
    assert paper.adaptations == 3
    assert 11 <= paper.newton <= 13
    assert all(steps <= most for steps, most in zip(paper.newtonPerAdaptation, (6, 4, 2), strict=True))


# adaptations and Newton steps, as measured; the scene's and the method's ceilings
CEILINGS = [
    (DISC, ["-method", "paper", "-h", 1], 3, 12),
    (DISC, ["-method", "paper", "-h", 0.25], 4, 13),
    (DISC, ["-method", "paper", "-T0", "d0", "-h", 0.5], 3, 13),
    (DISC, ["-method", "paper", "-T0", "d0", "-h", 0.25], 4, 18),
    (DISC, ["-method", "newton", "-h", 0.5], 1, 8),
    (DISC, ["-method", "newton", "-h", 0.5, "-kappa", 1e12], 1, 26),
    (DISC, ["-method", "incremental", "-h", 0.5], 1, 73),
    (DISC, ["-method", "signorini", "-h", 0.5], 1, 4),
    (TWO_BODIES, ["-method", "newton", "-h", 0.5], 1, 8),
    (TWO_BODIES, ["-method", "signorini", "-h", 0.5, "-order", 2], 1, 5),
    (BLOCK, ["-method", "paper", "-h", 4], 1, 4),
    (BLOCK, ["-method", "newton", "-h", 4, "-kappa", 1e12], 1, 25),
]
MORE = [
    (DISC, ["-method", "newton", *FINE], 1, 9),
    (DISC, ["-method", "paper", *FINE], 5, 15),
    (TWO_BODIES, ["-method", "signorini", "-h", 0.5], 1, 4),
    (DISC, ["-method", "paper", "-h", 0.25, "-corners", 0], 4, 13),
    (DISC, ["-method", "paper", "-h", 0.1, "-corners", 0], 4, 16),
    (DISC, ["-method", "paper", "-h", 0.1], 5, 17),
    (DISC, ["-method", "paper", "-h", 0.1, "-order", 2], 6, 21),
    (DISC, ["-method", "paper", "-T0", "d0", "-h", 0.1], 7, 28),
    (DISC, ["-method", "newton", "-h", 0.1, "-order", 2], 1, 9),
    (DISC, ["-method", "signorini", "-h", 0.2, "-order", 2], 1, 6),
    (DISC, ["-method", "signorini", "-h", 0.1, "-order", 2], 1, 8),
    (TWO_BODIES, ["-method", "paper", "-h", 0.5, "-order", 2], 3, 12),
]


@pytest.mark.parametrize("scene, flags, adaptations, newton", cases_of(CEILINGS, MORE), ids=named)
def test_ceilings(scene, flags, adaptations, newton):
    """No scene shall need more adaptations or Newton steps than it did when they were counted."""
    result = run(scene, *flags)
    assert result.adaptations <= adaptations
    assert result.newton <= newton


# ---------------------------------------------------------------- accuracy


@pytest.mark.parametrize("method", ["paper", "newton"])
def test_accuracy(method):
    """P2 at h = 0.25 shall give force, pressure, half-width and pressure profile of the independent computation."""
    result = run(DISC, "-method", method, *FINE)
    assert near(result.force, FORCE, 2e-4)
    assert near(result.pressureMax, PRESSURE_MAX, 2e-4)
    assert near(result.halfWidth, HALF_WIDTH, 5e-3)
    reference = table(PROFILE)
    pressure = np.interp(reference["x"], result.contact["x"], result.contact["pressure"])
    assert np.linalg.norm(pressure - reference["p"]) <= 1e-3 * np.linalg.norm(reference["p"])


def test_accuracy_of_a_stiffer_law():
    """The same for the exponent 10, whose reference has another half-width and a lower force."""
    result = run(DISC, "-method", "newton", "-m", 10, *FINE)
    assert near(result.force, FORCE_M10, 2e-4)
    assert near(result.pressureMax, PRESSURE_MAX_M10, 2e-4)
    assert near(result.halfWidth, HALF_WIDTH_M10, 5e-3)


@pytest.mark.parametrize("order, sizes, slowest", cases_of([(2, (1, 0.5, 0.25), 1.35)], [(1, (0.5, 0.25, 0.1), 1.75)]))
def test_order_of_convergence(order, sizes, slowest):
    """The force's error shall fall on every mesh, at P1's and P2's order (P2: the clamped corners set it)."""
    errors = [abs(run(DISC, "-method", "newton", "-order", order, "-h", h).force / FORCE - 1) for h in sizes]
    assert errors == sorted(errors, reverse=True)
    rate = np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    assert rate >= slowest


# ---------------------------------------------------------------- agreement


SAME = [(DISC, 0.5, 4), (TWO_BODIES, 1, 1), *((scene, h, 2) for scene, h in ((DISC, 0.5), (TWO_BODIES, 1), (BLOCK, 4)))]
SAME += [(TWO_BODIES, 1, 4), (BLOCK, 4, 4)]


@pytest.mark.parametrize("scene, h, order", cases_of([(DISC, 0.5, 1)], SAME))
def test_same_answer(scene, h, order):
    """Paper (run to its exact stop), newton and incremental shall agree to 1e-7 in force and pressure on one mesh."""
    flags = ["-h", 2 if order == 4 and scene != BLOCK else h, "-order", order, *EXACT_STOP]
    newton = run(scene, "-method", "newton", *flags)
    ways = [["paper", "-T0", "0"], ["paper", "-T0", "d0"], ["incremental", "-steps", 4]]
    assert newton.contactPoints >= 5
    for way in ways if order < 4 or scene == BLOCK else ways[1:2]:
        other = run(scene, "-method", *way, *flags)
        assert near(other.force, newton.force, 1e-7)
        assert near(other.pressureMax, newton.pressureMax, 1e-7)
        difference = np.abs(other.contact["pressure"] - newton.contact["pressure"]).max()
        assert difference <= 1e-7 * newton.pressureMax
        assert near(other.energy, newton.energy, 1e-10)


@pytest.mark.parametrize("kappa, m", [(1e6, 3), (1e3, 10), (1e9, 2)])
def test_same_answer_of_stiff_laws(kappa, m):
    """Both first thresholds of the paper's scheme shall lead to Newton's answer for stiffer laws too."""
    flags = ["-h", 0.5, "-kappa", kappa, "-m", m, *EXACT_STOP]
    newton = run(DISC, "-method", "newton", *flags)
    for threshold in ("0", "d0", "-0.2"):
        paper = run(DISC, "-method", "paper", "-T0", threshold, *flags)
        assert near(paper.force, newton.force, 1e-7)
        assert np.abs(paper.contact["pressure"] - newton.contact["pressure"]).max() <= 1e-7 * newton.pressureMax


def test_rho_does_not_matter():
    """The weight rho of the overlap in the status shall not change the paper's answer."""
    flags = ["-method", "paper", "-T0", "d0", "-h", 0.5, *EXACT_STOP]
    forces = [run(DISC, *flags, *rho).force for rho in (["-rho", 1e-3], [], ["-rho", 1e6])]
    assert near(min(forces), max(forces), 1e-7)


def test_energy_is_the_least():
    """No model on the way to the solution shall have less energy: a wall only takes states away."""
    best = run(DISC, "-method", "newton", "-h", 0.5, *EXACT_STOP).energy
    for flags in (["-method", "paper", "-eps", 0.9], ["-method", "signorini"]):
        assert run(DISC, "-h", 0.5, *flags).energy >= best * (1 - 1e-12)


# ---------------------------------------------------------------- thresholds


@pytest.mark.parametrize("scene", [DISC, TWO_BODIES])
@pytest.mark.parametrize("flags, first", [(PAPER, 0), (["-method", "paper", "-T0", "d0", "-h", 0.5], -0.25)])
def test_thresholds(scene, flags, first):
    """Thresholds shall start at T0, rise, and follow eq. (6) at every point where the wall carried, stay elsewhere."""
    models = run(scene, *flags).models
    assert (models[0]["threshold"] == first).all()
    assert len(models) >= 3
    for before, after in pairwise(models):
        wall = before["status"] == WALL
        assert wall.any()
        by_law = -0.25 + (before["pressure"] / 1e3).clip(0) ** (1 / 3)
        expected = np.where(wall, np.maximum(before["threshold"], by_law), before["threshold"])
        np.testing.assert_allclose(after["threshold"], expected, rtol=0, atol=1e-14)
        assert (after["threshold"] > before["threshold"]).any()


def test_model_error():
    """The model error shall be eq. (7)'s, in the shifted threshold, and stop the loop below eps and not before."""
    for kappa, eps in ((1e3, 0.5), (1e3, 0.02), (1e9, 0.2)):  # the last ends at the wall
        result = run(DISC, "-method", "paper", "-T0", "d0", "-h", 0.5, "-kappa", kappa, "-eps", eps)
        errors = []
        for model in result.models:
            wall = model["status"] == WALL
            tau, fresh = model["threshold"][wall] + 0.25, (model["pressure"][wall] / kappa) ** (1 / 3)
            errors.append(((fresh - tau) / fresh).max(initial=0))
        assert result.modelError == pytest.approx(errors[-1], rel=1e-9, abs=1e-14)
        assert (result.modelError > 0) == (kappa == 1e9)
        assert errors[-1] < eps
        assert (np.array(errors[:-1]) >= eps).all()


def test_residual_is_the_distance_to_the_law():
    """The residual of the summary shall be the law's own, evaluated from the contact table."""
    for flags in (["-tol", 1e-2], []):
        result = run(DISC, "-method", "newton", "-h", 0.5, *flags)
        contact, weight = result.contact, result.contact["weight"]
        law = 1e3 * (contact["overlap"] + 0.25).clip(0) ** 3
        off = np.linalg.norm(weight * (contact["pressure"] - law)) / np.linalg.norm(weight * contact["pressure"])
        assert result.residual == pytest.approx(result.history["residual"][-1], rel=1e-12)
        # the law's share of the distance along the body's response: never more than the distance at fixed overlap
        assert 0.05 * off <= result.residual <= off


# ---------------------------------------------------------------- invariance

# the scenes' defaults, but for h
LENGTHS = {
    DISC: {"width": 40.0, "depth": 20.0, "R": 10.0, "gap": 0.5, "u0": 2.5, "d0": -0.25, "h": 0.5},
    BLOCK: {"width": 20.0, "depth": 20.0, "gap": 0.5, "u0": 2.5, "d0": -0.25, "h": 4.0},
}
LENGTHS[TWO_BODIES] = LENGTHS[DISC]


def in_units(scene, length, pressure):
    """The case's flags where one of its units of length, of pressure, is `length`, `pressure` new ones."""
    flags = {name: value * length for name, value in LENGTHS[scene].items()}
    flags.update(E=100.0 * pressure, kappa=1e3 * pressure / length**3, rho=100.0 * pressure / length)
    return [word for name, value in flags.items() for word in ("-" + name, value)]


SMALLER = (1e3, 1e-6)
LARGER = (1 / 7e7, 3e11)


@pytest.mark.parametrize(
    "scene, flags, length, pressure",
    [
        (DISC, ["-method", "paper"], *SMALLER),
        (DISC, ["-method", "paper", "-T0", "d0"], *LARGER),
        (DISC, ["-method", "newton", "-order", 2], *SMALLER),
        (DISC, ["-method", "incremental", "-steps", 4, *EXACT_STOP], *LARGER),
        (DISC, ["-method", "signorini"], *SMALLER),
        (TWO_BODIES, ["-method", "paper", "-T0", "d0"], *SMALLER),
        (TWO_BODIES, ["-method", "signorini"], *LARGER),
        (BLOCK, ["-method", "paper"], *LARGER),
        (BLOCK, ["-method", "incremental", "-steps", 4], *SMALLER),
    ],
    ids=named,
)
def test_invariance(scene, flags, length, pressure):
    """A change of units (m and Pa to mm and MPa) shall change no count, and scale every result to 1e-9."""
    first = run(scene, "-h", LENGTHS[scene]["h"], *flags)
    other = run(scene, *in_units(scene, length, pressure), *flags)
    assert first.contactPoints >= 5
    assert other.newtonPerAdaptation == first.newtonPerAdaptation
    for name in "adaptations newton factorisations backsolves points ndof contactPoints wallPoints".split():
        assert other.summary[name] == first.summary[name]
    units = {"force": pressure * length, "pressureMax": pressure, "overlapMax": length, "energy": pressure * length**2}
    for name, unit in units.items():
        assert near(other.summary[name], first.summary[name] * unit, 1e-9), name
    assert (other.halfWidth is None) == (first.halfWidth is None)
    assert first.halfWidth is None or near(other.halfWidth, first.halfWidth * length, 1e-9)
    assert (other.contact["status"] == first.contact["status"]).all()
    units = {"pressure": pressure, "lambda": pressure, "overlap": length, "x": length, "weight": length}
    for name, unit in units.items():
        expected = first.contact[name] * unit
        assert np.abs(other.contact[name] - expected).max() <= 1e-9 * np.abs(expected).max(), name


# ---------------------------------------------------------------- both bodies meshed


@pytest.mark.parametrize("order", [1, 2, 4])
def test_meshed_disc_converges_to_the_rigid_disc(order):
    """With both bodies meshed the result shall tend to the rigid disc's, the difference falling like 1/Eratio."""
    flags = ["-method", "newton", "-h", 2 if order == 4 else 1, "-order", order, *EXACT_STOP]
    rigid = run(DISC, *flags)
    if order == 4:  # its points lie between the nodes, where parabolas stand for the disc: the limit is their own
        stiff = run(TWO_BODIES, *flags, "-Eratio", 1e10)
        assert stiff.force == pytest.approx(rigid.force, rel=1e-6)
        assert np.abs(stiff.contact["pressure"] - rigid.contact["pressure"]).max() < 1e-3 * rigid.pressureMax
        rigid = stiff
    ratios = (1e2, 1e4, 1e6) if order < 4 else (1e4, 1e6)
    softer, differences = [], []
    for ratio in ratios:
        meshed = run(TWO_BODIES, *flags, "-Eratio", ratio)
        assert meshed.summary["unpairedPoints"] == 0
        softer.append(rigid.force - meshed.force)
        np.testing.assert_allclose(meshed.contact["x"], rigid.contact["x"], atol=1e-12)
        differences.append(np.abs(meshed.contact["pressure"] - rigid.contact["pressure"]).max() / rigid.pressureMax)
    assert min(softer) > 0  # an elastic disc presses less
    for values in (softer, differences):
        rates = -np.diff(np.log(values)) / np.diff(np.log(ratios))
        np.testing.assert_allclose(rates, 1, atol=0.02)
    assert differences[-1] < 3e-6


# ---------------------------------------------------------------- the limit of hard contact


def test_hard_contact_is_complementary():
    """Hard contact shall be a wall at d0: pressure only at it, no overlap beyond it, no law."""
    result = run(DISC, "-method", "signorini", "-h", 0.5)
    contact = result.contact
    assert (contact["threshold"] == -0.25).all()
    assert (contact["overlap"] <= -0.25).all()
    assert (contact["lambda"] == contact["pressure"]).all()
    assert set(contact["status"]) == {0, WALL}
    assert (contact["pressure"][contact["status"] == WALL] > 0).all()


def test_hertz():
    """A light hard contact shall have Hertz's half-width (by the second moment) and greatest pressure."""
    small = ["-d0", 0, "-gap", 0, "-u0", 0.02, "-R", 8, "-reach", 2, "-h", 0.1, "-grading", 100]
    result = run(DISC, "-method", "signorini", "-order", 2, *small)
    hertz = math.sqrt(4 * result.force * 8 / (math.pi * 100 / (1 - 0.3**2)))
    assert near(result.summary["halfWidthMoment"], hertz, 0.01)
    assert near(result.pressureMax, 2 * result.force / (math.pi * hertz), 0.01)


# ---------------------------------------------------------------- cost


P4_FROM_D0 = ["-method", "paper", "-T0", "d0", "-h", 2, "-order", 4, *EXACT_STOP]
STEPPED = [(DISC, PAPER), (DISC, P4_FROM_D0), (TWO_BODIES, PAPER), (BLOCK, ["-method", "paper", "-h", 4])]


@pytest.mark.parametrize("scene, flags", cases_of(STEPPED, [(DISC, ["-method", "paper", *FINE])]), ids=named)
def test_one_factorisation_a_step(scene, flags):
    """The paper's scheme shall factorise once, and back-substitute once, for each Newton step."""
    result = run(scene, *flags)
    assert result.factorisations == result.newton
    assert result.backsolves == result.newton
    assert (np.diff(result.history["factorisations"], prepend=0) == 1).all()
