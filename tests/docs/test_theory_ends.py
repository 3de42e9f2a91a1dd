"""The theory of sequences of models (edp/docs/theory/), second part: how they end, and remarks of the chapters on them.

Problems are drawn by a seed, of 2 to 6 points, overlaps and pressures of order 1; states of models are exact.
"""

from dataclasses import replace

import numpy as np
import pytest
from condensed import Problem, barrier, bounds, energy, exponential, least, power, sequence, table

ZERO = 1e-300  # eps = 0: eq. (7) is read with <
ROUNDING = 1e-9


def spd(rng, n):
    A = rng.normal(size=(n, n))
    return A @ A.T / n + 0.01 * np.eye(n)


def m_matrix(rng, n):
    """S (n, n): no positive entry off the diagonal, row sums of 0 except one in each component."""
    off = np.triu(-rng.random((n, n)) * (rng.random((n, n)) < 0.6), 1)
    off += off.T
    linked = np.linalg.matrix_power(np.eye(n) + (off != 0), n) > 0
    first = np.argmax(linked, axis=1) == np.arange(n)
    return off + np.diag(-off.sum(1) + np.where(first, 10 ** rng.uniform(-2, 0, n), 0))


def of_stiffness(rng, S):
    C = np.linalg.inv(S)
    return Problem((C + C.T) / 2, 10 ** rng.uniform(-0.5, 0.5, len(S)), rng.uniform(-0.3, 1, len(S)) + 0.3)


def some_law(rng):
    flat = table(np.array([0, 0.02, 0.1, 0.3]), np.array([0, 0.1, 0.1, 2]) * 10 ** rng.uniform(-1, 1))
    stiff = power(10 ** rng.uniform(0, 8), rng.choice([1, 1.5, 3, 10]))
    return rng.choice(np.array([flat, stiff, barrier(10 ** rng.uniform(-3, 1), 0.4)], object))


def shares(problem, law, model):
    """(lambda, e), each (n,), of a model of walls."""
    p, tau = np.where(model.at, model.q / problem.w, 0.0), np.where(model.at, model.tau, 0.0)
    return np.where(model.at, p - law.pressure(tau), 0), np.where(model.at, law.inverse(p) - model.tau, 0)


# ---------------------------------------------------------------- walls


@pytest.mark.parametrize("tau0", [0.0, 1e-2])
@pytest.mark.parametrize("update", ["pointwise", "uniform"])
def test_the_loop_ends_exactly(tau0, update):
    """With eps = 0 too, and from walls at 0, some model shall have no wall that carries: its forces are the law's."""
    rng, most = np.random.default_rng(1), 0
    for _ in range(40):
        problem, law = of_stiffness(rng, spd(rng, int(rng.integers(2, 7)))), some_law(rng)
        found = sequence(problem, law, tau0, update=update, eps=ZERO, inner="exact")
        assert found.ended and not found.models[-1].at.any()
        assert all(model.at.any() for model in found.models[:-1])
        _, q = least(problem, law)
        assert problem.norm(found.q - q) <= ROUNDING * problem.norm(q)
        for model in found.models[:-1]:
            share, e = shares(problem, law, model)
            floor = 1e-7 * problem.norm(q)
            assert problem.norm(model.q - q) ** 2 <= problem.w @ (share * e) * (1 + 1e-6) + floor**2
        most = max(most, len(found.models))
    assert (3 if update == "pointwise" else 2) <= most < 10


def test_row_sums_may_be_0():
    """Uniform thresholds shall end after two models, also where row sums are 0 and the law has flat pieces."""
    rng, count, zeros = np.random.default_rng(2), [], 0
    for _ in range(60):
        S = m_matrix(rng, int(rng.integers(2, 7)))
        zeros += np.any(np.abs(S.sum(1)) < 1e-12)
        problem, law, tau0 = of_stiffness(rng, S), some_law(rng), rng.choice([0.0, 0.01, 0.1])
        found = sequence(problem, law, tau0, update="uniform", eps=ZERO, inner="exact")
        assert found.ended
        count.append(len(found.models))
    assert max(count) == 2 and count.count(2) > 30 and zeros > 30


def test_a_table_with_a_greatest_pressure():
    """One point, its wall goes in the first model: no finite rise, so R = 0, but the energy falls by 8.5."""
    law = table(np.array([0.0, 1.0]), np.array([0.0, 1.0]), bounded=True)
    problem = Problem(np.eye(1), np.ones(1), np.full(1, 5.0))
    found = sequence(problem, law, 0.0, eps=ZERO, inner="exact")
    first, second = found.models
    assert found.ended and first.tau == 0 and np.isinf(second.tau)
    assert (first.q.item(), second.q.item()) == pytest.approx((5, 1))
    assert first.energy - second.energy == pytest.approx(8.5)


def test_the_rate_where_walls_go():
    """The energy's error shall be at most the finite rises over the number of models in which no wall goes."""
    rng, gone = np.random.default_rng(3), 0
    for _ in range(60):
        law = table(np.array([0, 0.02, 0.1, 0.3]), np.array([0, 0.1, 0.1, 2]) * 10 ** rng.uniform(-1, 1), bounded=True)
        problem = of_stiffness(rng, spd(rng, int(rng.integers(2, 7))))
        found = sequence(problem, law, 0.0, eps=ZERO, inner="exact")
        s, q = least(problem, law)
        exact = energy(problem, law, None, "law", s, q)
        _, hard = least(problem, law, 0 * problem.w, "wall")
        p = problem.norm(hard) * np.sqrt(np.diag(problem.S)) / problem.w
        tau = np.array([model.tau for model in found.models])
        goes = np.array([np.any(np.isinf(shares(problem, law, model)[1])) for model in found.models])
        room = problem.w @ (p * np.max(np.where(np.isfinite(tau), tau, 0), axis=0))
        kept = np.cumsum(~goes)
        for model, number in zip(found.models, kept, strict=True):
            assert number * (model.energy - exact) <= room + ROUNDING * found.models[0].energy
        assert found.ended and goes.sum() <= len(problem.w)
        gone += goes.any()
    assert gone > 10


# ---------------------------------------------------------------- tangents, Newton, laws that fall


def test_tangents_from_0():
    """A law with a slope at first touch may start from tau = 0: the forces converge to its own, from below."""
    rng = np.random.default_rng(4)
    for _ in range(30):
        beta = 10 ** rng.uniform(0, 2)
        law = exponential(1 / beta, beta)
        law = replace(law, slope=lambda s, b=beta: np.where(s >= 0, np.exp(b * np.maximum(s, 0)), 0.0))  # right of 0
        problem = of_stiffness(rng, spd(rng, int(rng.integers(2, 7))))
        found = sequence(problem, law, 0.0, "linear", eps=1e-9, inner="exact")
        _, q = least(problem, law)
        assert found.ended and problem.norm(found.q - q) <= 1e-6 * problem.norm(q)
        assert np.all(np.diff([model.energy for model in found.models]) >= -ROUNDING)
        assert len(found.models) > 1


def test_plain_newton_falls_to_the_solution():
    """M-matrices, convex laws, any start: from the first iterate on overlaps shall fall, and to the solution."""
    rng = np.random.default_rng(5)
    for _ in range(30):
        S = m_matrix(rng, int(rng.integers(2, 7)))
        problem, law = of_stiffness(rng, S), power(10 ** rng.uniform(0, 6), rng.choice([1, 1.5, 3, 10]))
        exact, _ = least(problem, law)
        s, path = rng.normal(size=len(S)), []
        for _ in range(200):
            out_of_balance = S @ (s - problem.free) + problem.w * law.pressure(s)
            s = s - np.linalg.solve(S + np.diag(problem.w * law.slope(s)), out_of_balance)
            path.append(s)
        size = max(1, np.abs(path[0]).max())
        assert np.all(np.diff(path, axis=0) <= 1e-9 * size) and np.all(path - exact >= -1e-9 * size)
        assert np.abs(path[-1] - exact).max() < 1e-6


def lennard_jones(s):
    """Zero at -1, infinite at 0; it falls by at most 0.53 a unit of length."""
    return s**-10 - s**-4 if s < 0 else np.inf


def crossing(rises, low, high):
    """The s in (low, high) at which a function changes its sign, or an end."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if rises(middle) > 0 else (middle, high)
    return low


def state_between(S, free, tau):
    """(n,) overlaps s <= tau of a model of Lennard-Jones' law, S_ii above 0.53 and w = 1, each point in turn."""
    s = np.minimum(free, tau)
    for _ in range(2000):
        before = s.copy()
        for i, k in enumerate(np.diag(S)):
            rest = S[i] @ (free - s) + k * s[i]
            s[i] = crossing(lambda x, k=k, rest=rest: k * x + lennard_jones(x) - rest, -30.0, tau[i])
        if np.abs(s - before).max() < 1e-14:
            break
    return s


def test_walls_on_a_law_that_falls():
    """Lennard-Jones: negative thresholds shall rise, stay negative and end, with eq. (7) measured by their size."""
    rng, counts = np.random.default_rng(6), []
    for _ in range(12):
        S, free, tau = 4 * spd(rng, 3) + 0.6 * np.eye(3), rng.uniform(-1.5, 1, 3), np.full(3, -1.0)
        models = 0
        while models < 20:
            models += 1
            s = state_between(S, free, tau)
            p = S @ (free - s)
            share = p - np.array([lennard_jones(x) for x in s])
            at = share > 1e-7
            assert np.all(share > -1e-7) and np.all(s[at] > tau[at] - 1e-12)
            eq_6 = [crossing(lambda x, wanted=wanted: lennard_jones(x) - wanted, -1.0, 0.0) for wanted in p]
            new = np.where(at, eq_6, tau)
            assert np.all(new[at] > tau[at]) and np.all(new < 0)
            if np.max((new - tau) / np.abs(new)) < 1e-9:
                break
            tau = new
        assert not at.any()
        counts.append(models)
    assert 3 <= max(counts) < 10


def adhesive_energy(S, free, s):
    """1/2 (free - s) S (free - s) plus the potential of Lennard-Jones, w = 1; its gradient and Hessian."""
    x = free - s
    value = x @ S @ x / 2 + np.sum((-s) ** -9.0 / 9 - (-s) ** -3.0 / 3)
    force = S @ (s - free) + s**-10.0 - s**-4.0
    return value, force, S + np.diag(-10 * s**-11.0 + 4 * s**-5.0)


def descended(S, free, tau, s):
    """Overlaps s <= tau without descent left, from an admissible s: Newton's steps on a Hessian made positive."""
    for _ in range(500):
        value, slope, H = adhesive_energy(S, free, s)
        moves = ~((s >= tau) & (slope < 0))
        if np.abs(slope[moves]).max(initial=0.0) < 1e-10 * (1 + np.abs(S @ (free - s)).max()):
            return s
        roots, axes = np.linalg.eigh(H[np.ix_(moves, moves)])
        step, t = np.zeros_like(s), 1.0
        step[moves] = -axes @ ((axes.T @ slope[moves]) / np.maximum(np.abs(roots), 1e-8))
        while t > 1e-14:
            new = np.minimum(s + t * step, tau)
            if adhesive_energy(S, free, new)[0] < value + 1e-4 * slope @ (new - s):
                break
            t /= 2
        if t <= 1e-14:
            return s
        s = new
    return s


@pytest.mark.parametrize("softness", [1.0, 3.0])
def test_sequences_on_a_law_that_attracts(softness):
    """Thresholds shall rise and energies fall to a state of the law, also where bodies are softer than the attraction.

    From afar and from contact the law has different states in some of them.
    """
    rng, others = np.random.default_rng(6), 0
    for _ in range(30):
        S, free, tau = spd(rng, 3) / softness, rng.uniform(-2.5, 1, 3), np.full(3, -1.0)
        s, energies, models, ended = np.minimum(free, tau), [], 0, False
        while not ended:
            models += 1
            s = descended(S, free, tau, s)
            energies.append(adhesive_energy(S, free, s)[0])
            p = S @ (free - s)
            share, at = p - (s**-10.0 - s**-4.0), s >= tau
            scale = 1e-7 * (1 + np.abs(p).max())
            assert np.all(np.abs(share[~at]) < scale) and np.all(share[at] > -scale), "no equilibrium"
            eq_6 = [crossing(lambda x, wanted=wanted: lennard_jones(x) - wanted, -1.0, 0.0) for wanted in p]
            new = np.where(at & (share > 1e-9), eq_6, tau)
            assert np.all(new >= tau) and np.all(new < 0) and models < 40
            ended, tau = np.max((new - tau) / np.abs(new)) < 1e-9, new
        assert np.all(np.diff(energies) <= 1e-12 * (1 + abs(energies[0])))
        assert np.abs(share).max() < 1e-6 * (1 + np.abs(p).max()), "not on the law"
        afar, touching = (descended(S, free, np.full(3, -1e-3), np.full(3, start)) for start in (-5.0, -1.0))
        others += int(np.abs(afar - touching).max() > 1e-3)
    assert others >= (4 if softness > 1 else 1)


# ---------------------------------------------------------------- the error of a model


def test_two_energies_add_up_to_the_gap():
    """E of the overlaps and the complementary energy of the forces shall add up to the square of the gap bound."""
    rng = np.random.default_rng(7)
    for law in (power(7.0, 2.5), exponential(0.1, 4), barrier(0.3, 3.0)):
        q = rng.uniform(0.1, 1, 4)
        C, w = np.linalg.inv(spd(rng, 4)), np.full(4, 0.5)
        problem = Problem(C, w, C @ q + rng.uniform(0.1, 1, 4))
        s = problem.free - C @ q
        complementary = q @ C @ q / 2 - problem.free @ q + w @ law.dual(q / w)
        total = energy(problem, law, None, "law", s, q) + complementary
        assert total == pytest.approx(bounds(problem, law, s, q / w, np.ones(4, bool))["gap"] ** 2, rel=1e-9)


def test_any_displacement_will_do():
    """(u K u)^(1/2) of a displacement with the overlaps e shall be at least ||e||_(1/C), and reach it."""
    rng = np.random.default_rng(8)
    K, B = spd(rng, 9), rng.normal(size=(3, 9))
    C = B @ np.linalg.inv(K) @ B.T
    e = rng.normal(size=3)
    best = np.linalg.solve(K, B.T @ np.linalg.solve(C, e))
    least_norm = Problem(C, np.ones(3), e).dual_norm(e)
    assert np.sqrt(best @ K @ best) == pytest.approx(least_norm)
    inside = np.linalg.svd(B)[2][3:]  # of displacements without an overlap
    for _ in range(20):
        u = best + rng.normal(size=6) @ inside
        np.testing.assert_allclose(B @ u, e, atol=1e-9)
        assert np.sqrt(u @ K @ u) >= least_norm
