"""Algorithm 1 on the condensed problem, in numpy: a second implementation, for the tests of the theory of models.

The unknowns are the overlaps s of the asperities (length) and the nodal forces q = w p (force), arrays of shape (n,):

    s = free - C q,    (s, p) on the graph of the law, or of a model of it

Model "wall": the law up to the threshold tau, a rigid wall there (the paper, eq. (5)); "linear": the law up to tau, its
tangent beyond (the paper's introduction); "law": no threshold. tau = T - d0 (length). Units: any consistent ones.

sequence(problem, law, tau0, model)   Algorithm 1: eqs. (6) and (7) around Newton's steps, or around exact states
newton(...), proximal(...)            plain Newton; the proximal step of xnewton without its start
least(problem, law, tau, model)       the state of one model, without Algorithm 1
bounds(...), ball(...)                bounds of ||q - q*||_C, q* the forces of the law
"""

# ruff: noqa: E731 (a law is four lines)
import functools
from dataclasses import dataclass, field, make_dataclass

import numpy as np

quiet = np.errstate(divide="ignore", over="ignore", invalid="ignore")  # laws are infinite in places
up = functools.partial(np.maximum, 0.0)


@dataclass
class Problem:
    """C (n, n): compliance, symmetric > 0, length/force; w (n,): weights, area; free (n,): overlaps without contact.

    norm(q), dual_norm(e): the energy norms ||q||_C of forces, ||e||_(1/C) of overlaps, (force length)^(1/2).
    """

    C: np.ndarray
    w: np.ndarray
    free: np.ndarray

    def __post_init__(self):
        inverse = np.linalg.inv(self.C)
        self.S = (inverse + inverse.T) / 2  # force/length
        self.k = 1 / (np.diag(self.C) * self.w)  # the bodies' stiffness at a point, pressure/length

    def norm(self, q):
        return np.sqrt(max(q @ self.C @ q, 0.0)) if np.isfinite(q @ self.C @ q) else np.inf

    def dual_norm(self, e):
        return np.sqrt(max(e @ self.S @ e, 0.0)) if np.isfinite(e @ self.S @ e) else np.inf


@dataclass
class Law:
    """Does not decrease, 0 for s <= 0; inverse: the least overlap of p; dual: the conjugate of the potential."""

    pressure: callable
    slope: callable
    inverse: callable
    potential: callable  # force/length
    end: float = np.inf  # the overlap at which the pressure is infinite

    def dual(self, p):
        s = self.inverse(p)
        return np.where(np.isfinite(s), p * s - self.potential(s), np.inf)


def power(kappa, m):
    """p = kappa s^m, eq. (3)."""
    slope = lambda s: np.where(s > 0, kappa * m * up(s) ** (m - 1), 0.0)
    inverse = lambda p: (up(p) / kappa) ** (1 / m)
    return Law(lambda s: kappa * up(s) ** m, slope, inverse, lambda s: kappa / (m + 1) * up(s) ** (m + 1))


def exponential(p0, beta):
    """p = p0 (exp(beta s) - 1)."""

    def potential(s):
        y = beta * up(s)
        return p0 / beta * np.where(y < 1e-3, y * y * (1 / 2 + y / 6 + y * y / 24), np.expm1(y) - y)

    slope = lambda s: np.where(s > 0, beta * p0 * np.exp(beta * up(s)), 0.0)
    return Law(lambda s: p0 * np.expm1(beta * up(s)), slope, lambda p: np.log1p(up(p) / p0) / beta, potential)


def barrier(p0, end):
    """p = p0 s/(end - s), infinite from s = end on."""

    def potential(s):
        y = np.minimum(up(s) / end, 1.0)
        return p0 * end * np.where(y < 1e-3, y * y * (1 / 2 + y / 3 + y * y / 4), -y - np.log1p(-y))

    pressure = lambda s: np.where(s < end, p0 * up(s) / (end - s), np.inf)
    slope = lambda s: np.where(s > 0, np.where(s < end, p0 * end / (end - s) ** 2, np.inf), 0.0)
    return Law(pressure, slope, lambda p: end * up(p) / (p0 + up(p)), potential, end)


def table(S, P, bounded=False):
    """Pairs from (0, 0) on, joined by lines; beyond them the last line goes on, or the last pressure (bounded)."""
    rise = np.diff(P) / np.diff(S)
    rise = np.append(rise, 0.0 if bounded else rise[-1])
    W = np.append(0.0, np.cumsum(np.diff(S) * (P[1:] + P[:-1]) / 2))

    def piece(x, grid, side="right"):
        return np.maximum(np.searchsorted(grid, up(x), side=side) - 1, 0)

    def along(s, i):
        return P[i] + rise[i] * (up(s) - S[i]), W[i] + (up(s) - S[i]) * (P[i] + rise[i] * (up(s) - S[i]) / 2)

    slope = lambda s: np.where(s > 0, rise[piece(s, S, "left")], 0.0)
    inverse = quiet(lambda p: np.where(p > 0, (lambda i: S[i] + (p - P[i]) / rise[i])(piece(p, P, "left")), 0.0))
    return Law(lambda s: along(s, piece(s, S))[0], slope, inverse, lambda s: along(s, piece(s, S))[1])


def of_model(law, tau, model, s):
    """(pressure, slope, potential), each (n,), of a model at overlaps s, without a wall's share."""
    t = s if model == "law" else np.minimum(s, tau)
    p, d, W = law.pressure(t), law.slope(t), law.potential(t)
    return (p + d * (s - t), d, W + p * (s - t) + d * (s - t) ** 2 / 2) if model == "linear" else (p, d, W)


@quiet
def energy(problem, law, tau, model, s, q):
    """A model's energy at (s, q), less that of the bodies without contact (force length)."""
    return q @ problem.C @ q / 2 + problem.w @ of_model(law, tau, model, s)[2]


def linear_solve(problem, s, p, a):
    """(s, q) of a linearised problem: (C_AA + diag(a/w)) q_A = free - s + a p where a is finite, q = w p elsewhere."""
    A = np.isfinite(a)
    q = np.where(A, 0.0, problem.w * p)
    if A.any():
        M = problem.C[np.ix_(A, A)] + np.diag(a[A] / problem.w[A])
        q[A] = np.linalg.solve(M, (problem.free - problem.C @ q - s + np.where(A, a, 0.0) * p)[A])
    return problem.free - problem.C @ q, q


# The solved state of a model: at (n,): points beyond tau; energy: the model's (force length); steps: all so far.
Model = make_dataclass("Model", "tau s q at energy steps".split())
# A state, None if there is none; steps: linearised problems solved; ended: within the tolerance; models: a sequence's.
Solution = make_dataclass("Solution", ["s", "q", "steps", "ended", ("models", list, field(default_factory=list))])


def inner_newton(problem, law, tau, model, s, tol, most):
    """Lines 3 to 7: tangents at the present overlap and a fixed point on the status: (s, q, at, steps)."""
    walls, rho, at = model == "wall", 100.0, (s > tau) & (model != "law")
    for step in range(1, most + 1):
        base = np.where(at, tau, s)
        p, slope = law.pressure(base), law.slope(base)
        if not np.all(np.isfinite(slope)):
            break  # the law is infinite there
        s, q = linear_solve(problem, base, p, np.where(at & walls, 0.0, 1 / slope))
        p, was = q / problem.w, at
        status = np.where(was, p - law.pressure(tau), 0.0) + rho * np.where(was, 0.0, s - tau) > 0
        at = status if walls else (s > tau) & (model != "law")
        wanted = of_model(law, tau, model, s)[0]
        wanted = np.where(at & walls, np.maximum(p, wanted), wanted)
        if np.linalg.norm(q - problem.w * wanted) <= tol * np.linalg.norm(q) and not (walls and np.any(at != was)):
            return s, q, at, step
    return None, None, at, step


def resolvent(law, c, k):
    """The s > 0 of p(s) + k s = c > 0, by Newton's steps in log s inside a bracket; all (n,)."""
    s = high = np.minimum(law.inverse(c), c / k)
    low = np.minimum(law.inverse(c / 2), c / k / 2)
    for i in range(200):
        total = law.pressure(s) + k * s
        off = np.log(total / c)
        high, low = np.where(off >= 0, s, high), np.where(off <= 0, s, low)
        new = s * np.exp(-off * total / (s * (law.slope(s) + k)))
        kink = (i % 4 == 3) & (np.abs(new / s - 1) > 1e-9)  # there Newton's steps may go to and fro for ever
        new = np.where((new > high) | (new < low) | kink, np.sqrt(low * high), new)
        if np.all(np.abs(new - s) <= 1e-15 * s):
            break
        s = new
    return new


@quiet
def graph_point(problem, law, tau, model, s, p):
    """The point (s, p) of a model's graph reached along p + k s, and a = 1/slope there, infinite where open."""
    k, c = problem.k, p + problem.k * s
    s, on = c / k, c > 0
    s[on] = resolvent(law, c[on], k[on])
    slope = law.slope(s)
    p, a = np.where(on, np.where(slope > k, c - k * s, law.pressure(s)), 0.0), 1 / slope
    if model != "law":
        limit, d = law.pressure(tau), law.slope(tau) if model == "linear" else np.full_like(c, np.inf)
        at = on & (limit + k * tau <= c)
        beyond = np.where(np.isinf(d), tau, (c - limit + d * tau) / (k + d))
        carried = np.where(d > k, c - k * beyond, limit + d * (beyond - tau))
        s, p, a = np.where(at, beyond, s), np.where(at, carried, p), np.where(at, 1 / d, a)
    return s, p, a


@quiet
def proximal(problem, law, tau=None, model="law", tol=1e-6, most=60, start=None):
    """The proximal step, from the free overlaps or from a start (s, q)."""
    s, q = start or (problem.free, np.zeros(len(problem.free)))
    point = graph_point(problem, law, tau, model, s, q / problem.w)
    for step in range(1, most + 1):
        s, q = linear_solve(problem, *point)
        point = graph_point(problem, law, tau, model, s, q / problem.w)
        if np.linalg.norm(q - problem.w * point[1]) <= tol * np.linalg.norm(q):
            return Solution(s, q, step, True)
    return Solution(s, q, most, False)


@quiet
def newton(problem, law, tol=1e-6, most=400):
    """Plain Newton on the law, from the free overlaps."""
    s, q, _, steps = inner_newton(problem, law, problem.free + 1, "law", problem.free, tol, most)
    return Solution(s, q, steps, s is not None)


def descend(problem, law, tau, model, most=400):
    """Overlaps near a model's least energy, by projected Newton with a line search: slow, but it does not cycle."""
    top = tau if model == "wall" else np.full_like(problem.free, law.end)
    s = np.minimum(np.minimum(problem.free, top), law.inverse(up(problem.k * problem.free)))

    def value(t):
        return energy(problem, law, tau, model, t, problem.S @ (problem.free - t))

    for _ in range(most):
        p, d, _ = of_model(law, tau, model, s)
        g = problem.S @ (s - problem.free) + problem.w * p
        moves = ~((s >= top * (1 - 1e-14)) & (g < 0))
        step, t = np.zeros_like(s), 1.0
        step[moves] = -np.linalg.solve(problem.S[np.ix_(moves, moves)] + np.diag((problem.w * d)[moves]), g[moves])
        while t > 1e-12 and not value(np.minimum(s + t * step, top)) < value(s) + 1e-4 * min(t * g @ step, 0.0):
            t /= 2
        if t <= 1e-12 or np.linalg.norm(g[moves]) <= 1e-10 * np.linalg.norm(g - problem.w * p):
            break
        s = np.minimum(s + t * step, top)
    return s


@quiet
def least(problem, law, tau=None, model="law", tol=1e-12):
    """(s, q) of a model's state, by proximal steps, after a descent of the energy if they cycle; or (None, None)."""
    found = proximal(problem, law, tau, model, tol)
    if not found.ended:
        s = descend(problem, law, tau, model)
        found = proximal(problem, law, tau, model, tol, start=(s, problem.S @ (problem.free - s)))
    return (found.s, found.q) if found.ended else (None, None)


@quiet
def slope_threshold(problem, law, share=1.0):
    """(n,) tau0 at which the law is `share` times as steep as the bodies: p'(tau0) = share k, by bisection."""
    low, high = np.full(len(problem.w), 1e-30), np.full(len(problem.w), min(law.end, 1e30))
    for _ in range(120):
        steep = law.slope(np.sqrt(low * high)) > share * problem.k
        low, high = np.where(steep, low, np.sqrt(low * high)), np.where(steep, np.sqrt(low * high), high)
    return low


@quiet
def sequence(problem, law, tau0, model="wall", update="pointwise", eps=1e-4, tol=1e-6, inner="newton", last=300):
    """Algorithm 1 from tau0, a number or (n,). inner: "newton", the paper's steps, or "exact", least()."""
    tau, s, steps, models = np.full(len(problem.w), 1.0) * tau0, problem.free, 0, []
    while len(models) < last:
        if inner == "newton":
            s, q, at, more = inner_newton(problem, law, tau, model, s, tol, 400)
        else:
            (s, q), more = least(problem, law, tau, model), 1
        steps += more
        if s is None:
            return Solution(s, q, steps, False, models)
        p = q / problem.w
        if inner == "exact":
            at = (p > 0) & (p - law.pressure(tau) > 1e-11 * p.max() if model == "wall" else s > tau)
        on = np.where(at, tau, s) if model == "wall" else s
        models.append(Model(tau, on, q, at, energy(problem, law, tau, model, on, q), steps))
        new = np.where(at, np.maximum(tau, law.inverse(np.where(at, p, 0.0))), tau)  # eq. (6)
        new = np.full_like(new, new.max()) if update == "uniform" and at.any() else new
        if np.max(np.where(new > tau, 1 - tau / new, 0.0)) < eps:  # eq. (7)
            return Solution(s, q, steps, True, models)
        tau = new
    return Solution(s, q, steps, False, models)


@quiet
def bounds(problem, law, s, p, off, pieces=256):
    """Bounds of ||q - q*||_C of a state (s, p) in equilibrium that is on the law except at the points `off`.

    overlap: ||inverse(p) - s||_(1/C); force: ||w (p - p(s))||_C; gap: (sum of w (W(s) + W*(p) - s p))^(1/2), its square
    bounds the energy's error too; rectangle: with the greatest rectangle inside that area, from above, in `pieces`.
    """
    e, share = np.where(off, law.inverse(p) - s, 0.0), np.where(off, p - law.pressure(s), 0.0)
    gap = np.where(off, up(law.potential(s) + law.dual(p) - s * p), 0.0)
    x = s[:, None] + e[:, None] * np.linspace(0.0, 1.0, pieces + 1)  # from the state to the law
    rectangles = np.abs(p[:, None] - law.pressure(x[:, :-1])) * np.abs(x[:, 1:] - s[:, None])
    rectangle = np.where(off, np.fmin(np.max(rectangles, axis=1), gap), 0.0)
    found = {"overlap": problem.dual_norm(e), "force": problem.norm(problem.w * share)}
    found |= {"gap": np.sqrt(problem.w @ gap), "rectangle": np.sqrt(problem.w @ rectangle)}
    return {name: bound if np.isfinite(bound) else np.inf for name, bound in found.items()}


def ball(problem, s, p):
    """(centre (n,), radius) of a ball in ||.||_C that holds q*: of any (s, p) on the law, in equilibrium or not."""
    one, other = problem.w * p, problem.S @ (problem.free - s)
    return (one + other) / 2, problem.norm(one - other) / 2
