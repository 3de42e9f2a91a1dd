"""The theory of sequences of models (edp/docs/theory/), against the condensed twin on problems that a seed draws.

A drawn problem has 2 to 8 points: bodies without any sign, M-matrices, half-planes, separate springs, beams of Hermite
elements; laws of any stiffness, tables with flat pieces among them. States of models are exact (condensed.least), so
that what is tested is the theory and not an inner loop.
"""

from itertools import pairwise

import conditioning
import numpy as np
import pytest
from accounts import shared
from condensed import (
    Problem,
    ball,
    barrier,
    bounds,
    energy,
    exponential,
    graph_point,
    least,
    linear_solve,
    newton,
    power,
    proximal,
    sequence,
    slope_threshold,
    table,
)

from postprocess.commands import paper

ROUNDING = 1e-9  # of energies
SMALL = 1e-6  # of the law's forces: errors below are rounding


def beam(n):
    """(n, n) compliance of a cantilever of length and stiffness 1 at n even nodes: Hermite elements, condensed."""
    h = 1 / n
    element = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]], float) / h**3
    turned = np.array([1, h, 1, h])
    K = np.zeros((2 * n + 2, 2 * n + 2))
    for i in range(n):
        K[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += turned[:, None] * element * turned
    return np.linalg.inv(K[2:, 2:])[::2, ::2]


def m_matrix(rng, n, least_sum=1e-3):
    """(n, n) the inverse of a matrix without a positive entry off its diagonal, of positive row sums."""
    off = np.triu(-rng.random((n, n)) * 10 ** rng.uniform(-2, 0, (n, n)) * (rng.random((n, n)) < 0.8), 1)
    off += off.T
    return np.linalg.inv(off - np.diag(off.sum(1)) + np.diag(10 ** rng.uniform(np.log10(least_sum), 0, n)))


def half_plane(n):
    """(n, n) the compliance of a half-plane at n even points, Flamant's solution."""
    apart = np.abs(np.subtract.outer(np.arange(n), np.arange(n))) / n
    return -np.log((apart + np.eye(n) / (2 * np.e * n)) / 4)


def bodies(rng, n):
    kind = rng.choice(["any", "M", "half-plane", "springs", "beam"])
    if kind == "any":
        A = rng.normal(size=(n, n))
        return A @ A.T / n + 1e-3 * np.eye(n)
    if kind == "springs":
        return np.diag(10 ** rng.uniform(-2, 2, n))
    return {"M": lambda: m_matrix(rng, n), "half-plane": lambda: half_plane(n), "beam": lambda: beam(n)}[kind]()


def a_problem(rng, C=None):
    """Overlaps of order 1, pressures of order 1: so are the scales of the laws."""
    n = int(rng.integers(2, 9)) if C is None else len(C)
    C = bodies(rng, n) if C is None else C
    C = (C + C.T) / 2 / np.mean(np.diag(C))
    free = rng.uniform(-0.5, 1, n) if rng.random() < 0.5 else C @ rng.uniform(0, 2, n)
    return Problem(C, 10 ** rng.uniform(-0.5, 0.5, n) / n, free if free.max() > 0 else -free)


def a_law(rng, kinds="power exponential barrier table", convex=False):
    kind = rng.choice(kinds.split())
    if kind == "power":
        return power(10 ** rng.uniform(0, 12), rng.choice([1.05, 1.5, 2, 3, 10, 20]))
    if kind == "exponential":
        return exponential(10 ** rng.uniform(-6, 1), 10 ** rng.uniform(0, 3))
    if kind == "barrier":
        return barrier(10 ** rng.uniform(-4, 2), 10 ** rng.uniform(-2, 0))
    n = rng.integers(3, 8)
    steps, rise = 10 ** rng.uniform(-3, 0, n), 10 ** rng.uniform(-1, 4, n)
    rise = np.sort(rise) if convex else rise * (rng.random(n) > (0.2 if kind == "table" else 0))
    rise[-1] = max(rise[-1], 1)
    return table(np.append(0, np.cumsum(steps)), np.append(0, np.cumsum(steps * rise)), kind == "bounded")


def drawn(seed, count, draw):
    """The results of draw(rng) for so many problems, those without a state left out; at most one in a hundred is."""
    rng = np.random.default_rng(seed)
    found = [item for item in (draw(rng) for _ in range(count)) if item is not None]
    assert len(found) >= 0.99 * count
    return found


COUNTS = [pytest.param(60, id="few"), pytest.param(1000, id="many")]


def first_thresholds(rng, problem, law):
    """tau0 > 0: a number, or one for every point; barriers below their end."""
    if rng.random() < 0.5:
        return np.full(len(problem.w), min(10 ** rng.uniform(-3, 0), law.end / 2))
    return np.minimum(10 ** rng.uniform(-3, 0, len(problem.w)), law.end / 2)


def worked_out(seed, count, model, **laws):
    """[(problem, law, tau0, update, eps, exact forces, exact energy, its sequence of exact models), ...]."""

    def draw(rng):
        problem, law = a_problem(rng), a_law(rng, **laws)
        update, eps = rng.choice(["pointwise", "uniform"]), 10 ** rng.uniform(-6, -1)
        tau0 = first_thresholds(rng, problem, law) if rng.random() < 0.7 or model == "linear" else 0 * problem.w
        if model == "linear":
            tau0 = np.maximum(slope_threshold(problem, law, 10 ** rng.uniform(-1, 1)), 1e-9)
            if not np.all(law.slope(tau0) > 0):
                return ()
        s, q = least(problem, law)
        found = sequence(problem, law, tau0, model, update, eps, inner="exact") if s is not None else None
        if found is None or found.s is None:
            return None
        return problem, law, tau0, update, eps, q, energy(problem, law, None, "law", s, q), found

    return [item for item in drawn(seed, count, draw) if item]


@shared
def walls(count):
    return worked_out(1, count, "wall")


@shared
def tangents(count):
    return worked_out(2, count, "linear", convex=True)


def bounds_of_all(problem, law, tau0, update):
    """A priori: (n,) bounds of the pressures and thresholds of all models, from hard contact alone."""
    _, hard = least(problem, law, 0 * problem.w, "wall")
    p = problem.norm(hard) * np.sqrt(np.diag(problem.S)) / problem.w
    tau = np.maximum(tau0, law.inverse(p))
    return hard, p, np.full_like(tau, tau.max()) if update == "uniform" else tau


# ---------------------------------------------------------------- the sequence ends


@pytest.mark.parametrize("count", COUNTS)
def test_energies_fall_and_thresholds_rise_to_a_bound(count):
    """Energies shall fall to the law's and not below; thresholds rise, and stay below what hard contact says."""
    for problem, law, tau0, update, _, _, law_energy, found in walls(count):
        energies = np.array([model.energy for model in found.models])
        assert np.all(np.diff(energies) <= ROUNDING * energies[0]), "an energy rose"
        assert np.all(energies >= law_energy - ROUNDING * energies[0])
        tau = np.array([model.tau for model in found.models])
        assert np.all(np.diff(tau, axis=0) >= 0), "Proposition 4.1"
        hard, p, most = bounds_of_all(problem, law, tau0, update)
        for model in found.models:
            assert problem.norm(model.q) <= problem.norm(hard) * (1 + ROUNDING)
            assert np.all(model.q / problem.w <= p * (1 + ROUNDING))
            assert np.all(model.tau <= most * (1 + ROUNDING))


@pytest.mark.parametrize("count", COUNTS)
def test_forces_converge_to_those_of_the_law(count):
    """||q_N - q||^2 shall be at most the sum of w lambda e; the energy's error at most an a priori bound over N + 1."""
    for problem, law, tau0, update, _, q, law_energy, found in walls(count):
        _, p, most = bounds_of_all(problem, law, tau0, update)
        room = problem.w * p @ (most - tau0)
        for number, model in enumerate(found.models):
            pressure = model.q / problem.w
            share = np.where(model.at, pressure - law.pressure(model.tau), 0)
            e = np.where(model.at, law.inverse(np.where(model.at, pressure, 0)) - model.tau, 0)
            off, floor = problem.norm(model.q - q), SMALL * problem.norm(q)
            assert off**2 <= problem.w @ (share * e) * (1 + ROUNDING) + floor**2
            assert model.energy - law_energy <= room / (number + 1) + ROUNDING * found.models[0].energy
            assert off**2 / 2 <= model.energy - law_energy + floor**2 + ROUNDING * found.models[0].energy


@pytest.mark.parametrize("count", COUNTS)
def test_the_loop_ends_after_so_many_models(count):
    """Eq. (7) shall end the loop, from tau0 > 0 within 1 + the sum of ln(bound/tau0)/ln(1/(1 - eps)) models."""
    several = 0
    for problem, law, tau0, update, eps, _, _, found in walls(count):
        assert found.ended
        several += len(found.models) > 2
        for model, following in pairwise(found.models):
            moved = following.tau > model.tau
            assert np.max(1 - model.tau[moved] / following.tau[moved]) >= eps, "eq. (7) was met before"
        last = found.models[-1]
        e = np.where(last.at, law.inverse(last.q / problem.w) - last.tau, 0)
        assert np.all(e <= eps * (last.tau + e) * (1 + 1e-6)), "eq. (7) is not met"
        if np.all(tau0 > 0):
            *_, most = bounds_of_all(problem, law, tau0, update)
            rises = np.floor(np.log(most / tau0) / -np.log1p(-eps) + ROUNDING)
            most_rises = rises.sum() if update == "pointwise" else rises.max() + np.any(np.diff(tau0))
            assert len(found.models) <= 1 + most_rises
    assert several > 0.1 * count


def test_eq_7_measures_by_the_next_threshold():
    """eps is compared with the rise over the next threshold: a little more ends the loop, a little less does not."""
    problem, law = Problem(half_plane(6), np.full(6, 1 / 6), np.full(6, 0.5)), power(1e3, 3)
    first, second = sequence(problem, law, 0.02, eps=1e-6, inner="exact").models[:2]
    rise = np.max(1 - first.tau / second.tau)
    assert rise > 0.2
    for eps, ended in ((1.01 * rise, True), (0.99 * rise, False)):
        assert (len(sequence(problem, law, 0.02, eps=eps, inner="exact").models) == 1) == ended


def test_a_law_with_a_greatest_pressure():
    """A wall that carries more than the law ever can is taken away, once a point: the loop shall end all the same."""

    def draw(rng):
        problem, law = a_problem(rng), a_law(rng, "bounded")
        s, q = least(problem, law)
        found = sequence(problem, law, 0.0, inner="exact") if s is not None else None
        return (problem, q, found) if found and found.s is not None else None

    taken_away = 0
    for problem, q, found in drawn(3, 60, draw):
        assert found.ended
        assert problem.norm(found.q - q) <= 1e-2 * problem.norm(q)
        taken_away += np.any(np.isinf(found.models[-1].tau))
    assert taken_away > 5


# ---------------------------------------------------------------- two models


def pressed(rng, C):
    return a_problem(rng, C), a_law(rng), rng.choice([0.0, 1e-2, 1e-1])


@pytest.mark.parametrize("count", COUNTS)
def test_uniform_thresholds_end_after_two_models(count):
    """They shall where 1/C has no positive entry off its diagonal and positive row sums, whatever law and weights."""

    def draw(rng):
        problem, law, tau0 = pressed(rng, m_matrix(rng, int(rng.integers(2, 9))))
        found = sequence(problem, law, min(tau0, law.end / 2), "wall", "uniform", 1e-9, inner="exact")
        return found if found.s is not None else None

    models = [len(found.models) for found in drawn(4, count, draw)]
    assert max(models) == 2 and models.count(2) > 0.5 * len(models)


# a cantilever at its middle and its tip; four points, positive row sums, two positive entries off the diagonal
CANTILEVER = beam(2)
FOUR = np.array([[1, -0.6, -0.6, 0.5], [-0.6, 1, 0, 0], [-0.6, 0, 1, 0], [0.5, 0, 0, 5]])


@pytest.mark.parametrize(
    "S, forces, kappa, m",
    [(np.linalg.inv(CANTILEVER), [1, 1], 1e4, 3), (FOUR, [1, 1, 1, 0], 10, 1), (FOUR, [1, 1, 1, 0], 1e3, 3)],
    ids=["a row sum below 0", "a positive entry", "a positive entry, m = 3"],
)
def test_a_third_model(S, forces, kappa, m):
    """Without one of the two conditions the greatest pressure may rise when the walls go: three models."""
    C = np.linalg.inv(S)
    problem = Problem((C + C.T) / 2, np.ones(len(S)), C @ np.array(forces, float))
    found = sequence(problem, power(kappa, m), 0.0, "wall", "uniform", 1e-9, inner="exact")
    assert found.ended and len(found.models) == 3
    assert found.models[1].q.max() > found.models[0].q.max() * (1 + 1e-3)
    row_sums, off = S.sum(1), S - np.diag(np.diag(S))
    assert (row_sums.min() < 0) != (off.max() > 1e-9 * S.max())  # one of them, not both


# ---------------------------------------------------------------- the linear model


@pytest.mark.parametrize("count", COUNTS)
def test_tangents(count):
    """For a convex law: thresholds rise, the models' energies rise to the law's, forces converge."""
    for problem, law, _, _, eps, q, law_energy, found in tangents(count):
        assert found.ended
        energies = np.array([model.energy for model in found.models])
        assert np.all(np.diff(energies) >= -ROUNDING * law_energy), "an energy fell"
        assert np.all(energies <= law_energy * (1 + ROUNDING))
        tau = np.array([model.tau for model in found.models])
        assert np.all(np.diff(tau, axis=0) >= 0)
        last = found.models[-1]
        e = np.where(last.at, last.s - law.inverse(last.q / problem.w), 0)
        assert np.all(e >= -1e-12)  # of overlaps of order 1
        assert problem.norm(last.q - q) <= problem.dual_norm(e) * (1 + 1e-6) + SMALL * problem.norm(q)
        hard, _, _ = bounds_of_all(problem, law, 0.0, "pointwise")
        assert all(problem.norm(model.q) <= problem.norm(hard) * (1 + ROUNDING) for model in found.models)
        if eps < 1e-4:
            assert problem.norm(last.q - q) <= 1e-2 * problem.norm(q)


def test_tangents_of_a_law_that_is_not_convex():
    """Rising without a bound and nowhere flat is enough: thresholds rise, forces converge; energies may fall."""

    def draw(rng):
        problem, law = a_problem(rng), a_law(rng, "rising")
        found = sequence(problem, law, 1e-2, "linear", eps=1e-8, inner="exact")
        s, q = least(problem, law)
        return (problem, law, q, found) if found.s is not None and s is not None else None

    fell = 0
    for problem, _, q, found in drawn(5, 60, draw):
        assert found.ended and problem.norm(found.q - q) <= 1e-5 * problem.norm(q)
        energies = np.array([model.energy for model in found.models])
        fell += np.any(np.diff(energies) < -1e-6 * energies[0])
    assert fell > 0


@pytest.mark.parametrize("law", [power(1e3, 3), power(1e6, 2), exponential(0.02, 60), barrier(1e-2, 0.3)])
def test_tangents_converge_quadratically(law):
    """From model to model the greatest way beyond the threshold shall be squared, up to a constant."""
    C = half_plane(12)
    problem = Problem(C, np.full(12, 1 / 12), C @ np.sin(np.linspace(0.2, np.pi - 0.2, 12)) / 12)
    found = sequence(problem, law, slope_threshold(problem, law, 1e-2), "linear", eps=1e-12, inner="exact")
    beyond = [np.max(np.maximum(model.s - model.tau, 0) / model.s.max()) for model in found.models]
    beyond = [way for way in beyond if way > 1e-13]
    orders = [np.log(b / a) / np.log(a / before) for before, a, b in zip(beyond, beyond[1:], beyond[2:], strict=False)]
    assert len(beyond) >= 3 and max(orders) > 1.7


def test_a_tangent_of_slope_0_ends_at_once():
    """T0 = d0 shall be refused: for m > 1 the first model carries nothing, and eq. (7) ends the loop."""
    problem = Problem(np.eye(2), np.ones(2), np.ones(2))
    found = sequence(problem, power(1e3, 3), 0.0, "linear")
    assert found.ended and len(found.models) == 1 and found.q.sum() == 0
    steep = exponential(1.0, 10)  # its slope at first touch is 10
    found, right = sequence(problem, steep, 1e-12, "linear"), proximal(problem, steep, tol=1e-12)
    assert found.ended and found.q.sum() == pytest.approx(right.q.sum(), rel=1e-4)


# ---------------------------------------------------------------- the error of a model


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("made", [walls, tangents])
def test_bounds_are_bounds(made, count):
    """None shall be below the error; the gap's square shall bound the energy's error; rectangle <= gap."""
    reached = {}
    for problem, law, *_, q, law_energy, found in made(count):
        for model in found.models:
            off = problem.norm(model.q - q)
            if off <= SMALL * problem.norm(q):
                continue
            said = bounds(problem, law, model.s, model.q / problem.w, model.at)
            for name, bound in said.items():
                assert off <= bound * (1 + 1e-6), name
                reached[name] = max(reached.get(name, 0), off / bound)
            assert said["rectangle"] <= said["gap"]
            at_law = energy(problem, law, None, "law", model.s, model.q)
            assert at_law - law_energy <= said["gap"] ** 2 * (1 + 1e-6) + ROUNDING * law_energy
    sharp = {"overlap": 0.9, "force": 0.9, "rectangle": 0.9, "gap": 0.6} if made is walls else {"overlap": 0.9}
    for name, share in sharp.items():
        assert reached[name] > share, f"{name} is never near the error"


@pytest.mark.parametrize("law", [power(7.0, 2.5), exponential(0.1, 4), barrier(0.3, 0.9)])
@pytest.mark.parametrize("s, p", [(0.2, 2.0), (0.6, 0.4)], ids=["wall", "tangent"])
def test_gap_and_rectangle_are_areas(law, s, p):
    """The square of the gap shall be w times the area between state and law; the rectangle the greatest inside it."""
    problem = Problem(np.eye(1), np.full(1, 0.5), np.ones(1))
    said = bounds(problem, law, np.full(1, s), np.full(1, p), np.ones(1, bool))
    x = np.linspace(s, law.inverse(p), 20001)
    beside = np.abs(p - law.pressure(x))
    area = np.sum(beside[1:] + beside[:-1]) / 2 * abs(x[1] - x[0])
    assert said["gap"] ** 2 == pytest.approx(0.5 * area, rel=1e-6)
    greatest = 0.5 * np.max(beside * np.abs(x - s))
    assert greatest <= said["rectangle"] ** 2 <= 1.02 * greatest


@pytest.mark.parametrize("count", COUNTS)
def test_the_ball(count):
    """Any points on the law give a ball that holds the forces; after one linearised problem it encloses the error."""
    closer = []
    for problem, law, *_, q, _, found in walls(count):
        for model in found.models:
            off = problem.norm(model.q - q)
            if off <= SMALL * problem.norm(q):
                continue
            s, p, a = graph_point(problem, law, None, "law", model.s, model.q / problem.w)
            centre, radius = ball(problem, s, p)
            assert problem.norm(centre - q) <= radius * (1 + 1e-6) + SMALL * problem.norm(q)
            s, forces = linear_solve(problem, s, p, a)
            s, p, _ = graph_point(problem, law, None, "law", s, forces / problem.w)
            centre, radius = ball(problem, s, p)
            apart = problem.norm(model.q - centre)
            assert apart - radius <= off * (1 + 1e-6) and off <= (apart + radius) * (1 + 1e-6)
            closer.append((apart + radius) / off)
    assert np.median(closer) < 1.1


@shared
def paper_test():
    """K, the contact points' unknowns and the condensed problem of the paper's test, P1, h = 0.5, from FreeFEM."""
    return conditioning.assembled(conditioning.FLAGS)


MODELS = [(1e3, 3), (1e9, 3), (1e3, 10)]
ALL = [(kappa, m) for kappa in (1.0, 1e3, 1e6, 1e9) for m in (1.5, 2, 3, 10, 20)]


@pytest.mark.parametrize("laws", [MODELS, ALL], ids=["few", "many"])
def test_the_least_bound_is_near_the_error(laws):
    """On the paper's test the least of overlap, force and gap shall be within 2 of the error, of all four 1.6."""
    *_, problem = paper_test()
    three, four = [], []
    for kappa, m in laws:
        law = power(kappa, m)
        _, q = least(problem, law)
        runs = [sequence(problem, law, tau0, eps=1e-10, inner="exact") for tau0 in (0.0, 0.25)]
        runs.append(sequence(problem, law, slope_threshold(problem, law), "linear", eps=1e-10, inner="exact"))
        for model in (model for found in runs for model in found.models):
            off = problem.norm(model.q - q)
            if off > 1e-7 * problem.norm(q):
                said = bounds(problem, law, model.s, model.q / problem.w, model.at)
                four.append(min(said.values()) / off)
                three.append(min(said[name] for name in ("overlap", "force", "gap")) / off)
    assert len(four) > 4 * len(laws)
    assert max(three) < 2 and max(four) < 1.6 and min(four) > 1 - 1e-6


# ---------------------------------------------------------------- counts and conditions


@pytest.mark.parametrize(
    "kappa, m, tau0, update, counts",
    [
        (1e3, 3, 0.25, "pointwise", (3, 12)),
        (1e3, 3, 0.0, "pointwise", (3, 13)),
        (1e9, 3, 0.0, "pointwise", (3, 11)),
        (1e3, 10, 0.0, "pointwise", (5, 20)),
        (1e3, 3, 0.25, "uniform", (2, 10)),
    ],
)
def test_counts_of_lab_0(kappa, m, tau0, update, counts):
    """The twin shall take as many models and Newton steps as the page in plain FreeFEM (its ANSWERS.md)."""
    found = sequence(paper_test()[-1], power(kappa, m), tau0, update=update)
    assert (len(found.models), found.steps) == counts


def test_tangents_on_the_paper_test():
    """-model linear: 3 models, 8 steps (7 by the residual of the package), the force of the others."""
    *_, problem = paper_test()
    law = power(1e3, 3)
    plain = newton(problem, law, tol=1e-10)
    low = law.inverse(0.1 * np.max(problem.k * problem.free))
    for tau0, steps in ((slope_threshold(problem, law), 8), (low, 8)):
        found = sequence(problem, law, tau0, "linear")
        assert (len(found.models), found.steps) == (3, steps)
        assert found.q.sum() == pytest.approx(plain.q.sum(), rel=1e-8)


def test_the_scaled_tangent_is_no_worse_than_the_bodies():
    """cond of K + diag(t), t >= 0, scaled to a unit diagonal, shall be at most that of K, scaled, whatever t."""
    rng = np.random.default_rng(6)
    K, dof, problem = paper_test()
    matrices = [np.linalg.inv(a_problem(rng).C) for _ in range(100)] + [problem.C]
    for A in matrices:
        added = 10 ** rng.uniform(-6, 16, len(A)) * (rng.random(len(A)) < 0.7)
        most = conditioning.conditions(A)[1]
        assert conditioning.conditions(A + np.diag(added))[1] <= most * (1 + 1e-6)
    stiff = conditioning.tangent(K, dof, 1e12 * problem.w)
    plain, scaled = conditioning.conditions(stiff)
    assert plain > 1e11 and scaled <= conditioning.conditions(K)[1] * (1 + 1e-6)


def test_the_conditions_on_the_page_of_claims():
    """The page of `make paper` says those of the first tangent at kappa = 1e12, m = 3, and of every scaled tangent."""
    K, dof, problem = paper_test()
    law = power(1e12, 3.0)
    plain, scaled = conditioning.conditions(conditioning.tangent(K, dof, problem.w * law.slope(problem.free)))
    said = {name: float(getattr(paper, name)) for name in ("CONDITION", "SCALED")}
    assert said == {"CONDITION": float(f"{plain:.0e}"), "SCALED": float(f"{scaled:.0e}")}
    assert float(f"{conditioning.conditions(K)[1]:.0e}") == said["SCALED"]
