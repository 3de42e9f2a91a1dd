"""edp/THEORY.md, formula by formula: on small matrices in numpy, and on the compliance of real scenes."""

import functools
import math
import re
from itertools import pairwise

import numpy as np
import pytest
from freefem import ROOT, run, scene_text, snippet, told

THEORY = (ROOT / "edp" / "THEORY.md").read_text()
DISC, SPHERE = "disc-on-block", "sphere-on-block"
COMPLIANCE = """
setUpContact();
int[int] all(points);
for (int i = 0; i < points; i++) all[i] = i;
real[int,int] half(0, 0);
kernelMatrix(all, kernelCell, half);
fitKernel();
real[int,int] fitted(0, 0);
kernelMatrix(all, kernelCell, fitted);
tell("x", pointX);
tell("weight", weight);
tell("cell", kernelCell);
tell("k", bodyStiffness);
tell("alpha", localCompliance);
tell("scale", kernelLength);
real[int] unit(points);
real[int] column(points);
for (int i = 0; i < points; i++)
{
    unit = 0;
    unit[i] = 1;
    complianceTimes(unit, column, 0);
    tell("C", column);
    column = half(:, i);
    tell("G", column);
    column = fitted(:, i);
    tell("M", column);
}
"""


class Problem:
    """A scene's points: x, w, cell, k, alpha, scale; the true C, the kernel G, the fitted kernel M."""

    def __init__(self, output):
        values = told(output)
        self.x, self.w, self.cell, self.k = values["x"], values["weight"], values["cell"], values["k"]
        self.alpha, self.scale = values["alpha"].item(), values["scale"].item()
        rows = [line.split() for line in output.splitlines() if line.startswith("told ")]
        self.C, self.G, self.M = (np.array([row[2:] for row in rows if row[1] == name], float) for name in "CGM")


@pytest.fixture(scope="module")
def problem(tmp_path_factory):
    """problem(scene, flags): made once; P1 unless -order is among the flags, as in freefem.run()."""

    @functools.cache
    def made(scene, *flags):
        flags = flags if "-order" in flags else (*flags, "-order", 1)
        folder = tmp_path_factory.mktemp("theory")
        return Problem(snippet(folder, scene_text(scene) + COMPLIANCE, *flags))

    return made


# ---------------------------------------------------------------- the law, its resolvent, small problems

SOFT, STIFF = (1e3, 3), (1e12, 3)


def resolvent(c, k, kappa, m, wall=math.inf):
    """(s, P): the point of p = kappa s^m, with a wall, where p + k s = c; by bisection."""
    low, high = np.zeros_like(c), np.maximum(c, 0) / k
    for _ in range(200):
        middle = 0.5 * (low + high)
        above = kappa * middle**m + k * middle > c
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    s = np.where(c > 0, np.minimum(0.5 * (low + high), wall), c / k)
    return s, np.maximum(c - k * np.minimum(s, wall), 0) * (c > 0)


def small(n=12, seed=0):
    """A symmetric positive definite C, weights, free overlaps of both signs."""
    generator = np.random.default_rng(seed)
    x, w = np.linspace(0, 1, n), np.full(n, 1 / n)
    C = -np.log(np.abs(x[:, None] - x) + np.eye(n)) + np.diag(np.full(n, 1 + math.log(2 * n)))
    assert np.linalg.eigvalsh(C)[0] > 0
    return C, w, generator.uniform(-1, 2, n)


def newton_on_resolvent(C, w, free, k, law, wall=math.inf, steps=60):
    """Proximal Newton as THEORY.md states it; (q, linearisations)."""
    kappa, m = law
    q, status = np.zeros(len(w)), None
    for step in range(steps):
        s_hat, p_hat = free - C @ q, q / w
        s, p = resolvent(p_hat + k * s_hat, k, kappa, m, wall)
        now = (p > 0).astype(int) + (s >= wall)
        if np.linalg.norm(w * p - q) <= 1e-12 * np.linalg.norm(q) and (now == status).all():
            return q, step
        A = np.flatnonzero(p > 0)
        a = np.where(s < wall, 1 / (kappa * m * np.maximum(s, 1e-30) ** (m - 1)), 0)[A]
        status, q = now, np.zeros(len(w))
        q[A] = np.linalg.solve(C[np.ix_(A, A)] + np.diag(a / w[A]), free[A] - s[A] + a * p[A])
    raise AssertionError("no convergence")


def stiffness_of(C, w):
    return 1 / (np.diag(C) * w)


def test_two_forms():
    """The least values of the two forms shall add up to nothing: the run's energy, and that of its forces alone."""
    done = run(DISC, "-h", 0.5, "-tol", 1e-11)
    x, w, p, s = (done.contact[name] for name in ("x", "weight", "pressure", "s"))
    given = done.parameters
    at_rest = given["u0"] - given["gap"] - given["R"] + np.sqrt(given["R"] ** 2 - x**2) - given["d0"]
    conjugate = given["m"] / (given["m"] + 1) * p * (p / given["kappa"]) ** (1 / given["m"])
    q = w * p
    assert 0.5 * q @ (at_rest - s) - at_rest @ q + w @ conjugate == pytest.approx(-done.energy, rel=1e-9)


def test_resolvent():
    """It shall be increasing, not expansive, with the derivative 1/(1 + k a), and near max(c, 0) for a stiff law."""
    k, (kappa, m) = 3.0, SOFT
    c = np.linspace(-5, 50, 4001)
    s, P = resolvent(c, k, kappa, m)
    np.testing.assert_allclose(P, np.where(c > 0, kappa * np.maximum(s, 0) ** m, 0), rtol=1e-8, atol=1e-12)
    rise = np.diff(P) / np.diff(c)
    assert rise.min() >= 0 and rise.max() <= 1
    on = c > 0.1
    a = 1 / (kappa * m * s[on] ** (m - 1))
    step = 1e-5
    slope = (resolvent(c[on] + step, k, kappa, m)[1] - resolvent(c[on] - step, k, kappa, m)[1]) / (2 * step)
    np.testing.assert_allclose(slope, 1 / (1 + k * a), rtol=1e-5)
    for stiff in (1e3, 1e6, 1e12):
        short = np.maximum(c, 0) - resolvent(c, k, stiff, m)[1]
        assert (short >= -1e-9).all()
        assert (short <= k * (np.maximum(c, 0) / stiff) ** (1 / m) + 1e-9).all()


def test_envelope():
    """The resolvent's pressure shall be the derivative of the potential's Moreau envelope."""
    k, (kappa, m) = 3.0, SOFT

    def envelope(x):
        s, _ = resolvent(k * x, k, kappa, m)
        return kappa * np.maximum(s, 0) ** (m + 1) / (m + 1) + 0.5 * k * (x - s) ** 2

    x, step = np.linspace(-1, 3, 41), 1e-5
    slope = (envelope(x + step) - envelope(x - step)) / (2 * step)
    np.testing.assert_allclose(slope, resolvent(k * x, k, kappa, m)[1], rtol=1e-6, atol=1e-8)
    s = np.linspace(-2, 3, 500001)  # it is the least value over s
    for at in (-0.5, 0.7, 2.0):
        least = np.min(kappa * np.maximum(s, 0) ** (m + 1) / (m + 1) + 0.5 * k * (at - s) ** 2)
        assert envelope(np.array([at]))[0] == pytest.approx(least, rel=1e-6, abs=1e-9)


def test_step_is_newton_on_the_resolvent():
    """The linear system of the proximal step shall be Newton's step on F(q) = q/w - P(q/w + k (free - C q))."""
    C, w, free = small()
    kappa, m = SOFT
    k = stiffness_of(C, w)
    q = w * np.maximum(free, 0)

    def F(q):
        return q / w - resolvent(q / w + k * (free - C @ q), k, kappa, m)[1]

    step = 1e-7
    jacobian = np.column_stack([(F(q + step * e) - F(q - step * e)) / (2 * step) for e in np.eye(len(w))])
    expected = q - np.linalg.solve(jacobian, F(q))
    s, p = resolvent(q / w + k * (free - C @ q), k, kappa, m)
    A = np.flatnonzero(p > 0)
    a = 1 / (kappa * m * s[A] ** (m - 1))
    found = np.zeros(len(w))
    found[A] = np.linalg.solve(C[np.ix_(A, A)] + np.diag(a / w[A]), free[A] - s[A] + a * p[A])
    np.testing.assert_allclose(found, expected, atol=1e-5 * np.abs(expected).max())


def test_the_parameter_sets_the_path_only():
    """Ten times k, or a tenth, shall lead to the same solution, in a few linearisations more at most."""
    C, w, free = small()
    k = stiffness_of(C, w)
    for law in (SOFT, STIFF):
        best, steps = newton_on_resolvent(C, w, free, k, law)
        for factor in (0.1, 10):
            q, others = newton_on_resolvent(C, w, free, factor * k, law)
            np.testing.assert_allclose(q, best, rtol=1e-9, atol=1e-12)
            assert others <= steps + 4


def test_hard_contact_is_the_active_set_method():
    """With the wall alone the step shall be that of the primal-dual active set method."""
    C, w, free = small(seed=3)
    k = stiffness_of(C, w)
    q, iterates = np.zeros(len(w)), []
    for _ in range(20):
        A = q / w + k * (free - C @ q) > 0
        iterates.append(A)
        q = np.zeros(len(w))
        q[A] = np.linalg.solve(C[np.ix_(A, A)], free[A])
        if len(iterates) > 1 and (iterates[-1] == iterates[-2]).all():
            break
    proximal, steps = newton_on_resolvent(C, w, free, k, SOFT, wall=0.0)
    np.testing.assert_allclose(proximal, q, rtol=1e-10, atol=1e-14)
    assert steps == len(iterates) - 1
    assert (q >= 0).all() and (free - C @ q <= 1e-12).all() and abs(q @ (free - C @ q)) < 1e-12


def test_inexact_step():
    """A linear residual r shall be worth w k r/(1 + k a) in the residual, to first order."""
    C, w, free = small()
    k, (kappa, m) = stiffness_of(C, w), SOFT
    q, _ = newton_on_resolvent(C, w, free, k, SOFT)
    s, p = resolvent(q / w + k * (free - C @ q), k, kappa, m)
    A = np.flatnonzero(p > 0)
    a = 1 / (kappa * m * s[A] ** (m - 1))
    generator = np.random.default_rng(1)
    change = np.zeros(len(w))
    change[A] = 1e-7 * q[A].max() * generator.uniform(-1, 1, len(A))
    r = -((C[np.ix_(A, A)] + np.diag(a / w[A])) @ change[A])  # right side minus left side of the linear system
    _, graph = resolvent((q + change) / w + k * (free - C @ (q + change)), k, kappa, m)
    np.testing.assert_allclose((w * graph - q - change)[A], (w * k)[A] * r / (1 + k[A] * a), rtol=1e-4)


# ---------------------------------------------------------------- errors


def energy_norm(C, q):
    return math.sqrt(q @ C @ q)


def dual_norm(C, e):
    return math.sqrt(e @ np.linalg.solve(C, e))


@pytest.mark.parametrize("m", [*(pytest.param(m, marks=pytest.mark.long) for m in (2, 3)), 10])
def test_distance_to_hard_contact(problem, m):
    """||q0 - q||_C shall be at most kappa^(-1/m) ||p0^(1/m)||_(1/C), not far below, and fall at that rate."""
    scene = problem(DISC, "-h", 0.5)
    hard = run(DISC, "-h", 0.5, "-law", "signorini", "-tol", 1e-12).contact
    q0 = hard["weight"] * hard["pressure"]
    found, kappas = [], (1e6, 1e9, 1e12)
    for kappa in kappas:
        law = run(DISC, "-h", 0.5, "-kappa", kappa, "-m", m, "-tol", 1e-12).contact
        off = energy_norm(scene.C, q0 - law["weight"] * law["pressure"])
        bound = kappa ** (-1 / m) * dual_norm(scene.C, np.maximum(hard["pressure"], 0) ** (1 / m))
        assert 0.3 * bound < off <= bound * (1 + 1e-6)
        found.append(off)
    if m < 10:
        rates = -np.diff(np.log(found)) / np.diff(np.log(kappas))
        np.testing.assert_allclose(rates, 1 / m, atol=0.01)


def test_model_error_bounds_the_error(problem):
    """At each adaptation ||q_N - q||_C <= ||T_(N+1) - T_N||_(1/C): eq. (7) is an error estimate."""
    flags = ["-h", 0.5, "-tol", 1e-11]
    scene = problem(DISC, "-h", 0.5)
    exact = run(DISC, *flags).contact
    paper = run(DISC, *flags, "-method", "paper", "-T0", "d0", "-eps", 1e-10)
    q = exact["weight"] * exact["pressure"]
    thresholds = paper.models["threshold"]
    assert len(thresholds) >= 3
    ratios = []
    for model, (now, after) in zip(paper.models, pairwise(thresholds), strict=False):
        off = energy_norm(scene.C, exact["weight"] * model["pressure"] - q)
        bound = dual_norm(scene.C, after - now)
        assert off <= bound * (1 + 1e-6) + 1e-8 * energy_norm(scene.C, q)
        ratios.append(off / bound)
    assert ratios[0] > 0.3


@pytest.mark.parametrize("m", [2, 10])
def test_newton_shrinks_the_overlap(m):
    """From an overshoot plain Newton shall multiply the overlap of the asperities by 1 - 1/m."""
    history = run(DISC, "-h", 0.25, "-method", "newton", "-kappa", 1e12, "-m", m, "-tol", 1e-8).history
    s = history["overlapMax"] + 0.25
    np.testing.assert_allclose((s[1:] / s[:-1])[:8], 1 - 1 / m, rtol=1e-5)
    wanted = math.log(s[0] / s[-1]) / math.log(m / (m - 1))
    assert wanted < len(s) < wanted + 8


# ---------------------------------------------------------------- kernels


def gauss(f, a, b, n=400):
    x, w = np.polynomial.legendre.leggauss(n)
    return 0.5 * (b - a) * np.sum(w * f(0.5 * (b - a) * x + 0.5 * (a + b)))


def agm(a, b):
    for _ in range(40):
        a, b = (a + b) / 2, math.sqrt(a * b)
    return a


def test_kernels_own_influence():
    """The diagonals shall be the means over a cell: of -ln|x|, of the ring's kernel, of 1/r over a disc."""
    width = 0.3
    mean = 2 / width * gauss(lambda t: -np.log(t**4) * 4 * t**3, 0, (width / 2) ** 0.25)
    assert mean == pytest.approx(-(math.log(width / 2) - 1), rel=1e-6)
    radius = 0.2
    assert 2 * math.pi * gauss(lambda r: r / r, 0, radius) / (math.pi * radius**2) == pytest.approx(2 / radius)
    # the ring's kernel: the mean of 1/distance over the angle
    for r, other in ((1.0, 0.4), (1.0, 1.3)):
        angle = (np.arange(20000) + 0.5) / 20000 * 2 * math.pi
        direct = np.mean(1 / np.sqrt(r**2 + other**2 - 2 * r * other * np.cos(angle)))
        assert direct == pytest.approx(1 / ((r + other) * agm(1, abs(r - other) / (r + other))), rel=1e-8)
    # its mean over a narrow ring: (ln(16 r/width) + 1)/(pi r)
    width = 1e-3
    near = np.vectorize(lambda u: 4 * u**3 / ((2 + u**4) * agm(1, u**4 / (2 + u**4))))  # |r - r'| = u^4
    ring = 2 / width * gauss(near, 0, (width / 2) ** 0.25, 60)
    assert ring == pytest.approx((math.log(16 / width) + 1) / math.pi, rel=1e-3)


def test_kernel_in_the_code(problem):
    """The code's matrices shall be those of the theory, up to the constant that a unit of length adds."""
    scene = problem(DISC, "-h", 0.25)
    x, cell = scene.x, scene.cell
    np.testing.assert_allclose(cell[1:-1], (x[2:] - x[:-2]) / 2, rtol=1e-12)
    assert scene.alpha == pytest.approx(2 * (1 - 0.3**2) / (math.pi * 100), rel=1e-12)
    G = -scene.alpha * np.log(np.abs(x[:, None] - x) + np.eye(len(x)))
    G += np.diag(-scene.alpha * (np.log(cell / 2) - 1))
    np.testing.assert_allclose(scene.G, G + scene.alpha * math.log(scene.scale), atol=1e-12)
    np.testing.assert_allclose(scene.C, scene.C.T, atol=1e-13 * np.abs(scene.C).max())


def test_symbol_of_the_plane_kernel(problem):
    """On equal cells the least eigenvalue shall be alpha (1 + ln(4/pi)), whatever their number."""
    for h in (0.25, 0.1):
        scene = problem(DISC, "-h", h)
        assert np.ptp(scene.w[1:-1]) < 1e-9
        assert np.linalg.eigvalsh(scene.G)[0] == pytest.approx(scene.alpha * (1 + math.log(4 / math.pi)), rel=1e-2)


def spectrum(M, C):
    """The eigenvalues of M^-1 C for a positive definite M."""
    lower = np.linalg.inv(np.linalg.cholesky(M))
    return np.linalg.eigvalsh(lower @ C @ lower.T)


def test_remainder_is_smooth(problem):
    """C - G shall have two singular values above 2 % of C, on any mesh, and be reproduced by the fitted polynomial."""
    for h in (0.25, 0.1):
        scene = problem(DISC, "-h", h)
        rest = np.linalg.svd(scene.C - scene.G, compute_uv=False) / np.linalg.norm(scene.C, 2)
        assert rest[0] > 0.25 and rest[1] > 0.05 and rest[2] < 0.02
        assert np.linalg.norm(scene.C - scene.M, 2) < 0.05 * np.linalg.norm(scene.C, 2)


@pytest.mark.parametrize(
    "scene, flags, low, high",
    [
        pytest.param(DISC, ("-h", 0.5), 0.75, 1.25, marks=pytest.mark.long),
        pytest.param(DISC, ("-h", 0.25), 0.75, 1.25, marks=pytest.mark.long),
        (DISC, ("-h", 0.1), 0.75, 1.25),
        pytest.param(DISC, ("-h", 0.25, "-order", 2), 0.75, 1.25, marks=pytest.mark.long),
        (DISC, ("-h", 0.5, "-order", 4), 0.75, 1.25),
        (SPHERE, ("-h", 1, "-layers", 2), 0.25, 1.25),
        (SPHERE, ("-h", 1.5, "-layers", 2, "-order", 2), 0.5, 1.25),
    ],
)
def test_preconditioned_spectrum(problem, scene, flags, low, high):
    """The fitted kernel shall be positive definite, and the eigenvalues of M^-1 C lie near 1 whatever the mesh."""
    made = problem(scene, *flags)
    assert np.linalg.eigvalsh(made.M)[0] > 0
    values = spectrum(made.M, made.C)
    assert low < values[0] and values[-1] < high


def test_local_stiffness(problem):
    """k shall be 1/(C_ii w_i) within a factor of 4."""
    for scene, flags, high in (
        (DISC, ("-h", 0.1), 1.1),
        (DISC, ("-h", 0.5, "-order", 4), 1.25),
        (SPHERE, ("-h", 1.5, "-layers", 2, "-symmetry", "whole"), 1.1),
        (SPHERE, ("-h", 1, "-layers", 2), 1.25),
        (SPHERE, ("-h", 1.5, "-layers", 2, "-order", 2), 1.5),
    ):
        made = problem(scene, *flags)
        share = made.k * np.diag(made.C) * made.w
        assert share.min() > 0.25 and share.max() < high


def test_space_kernel_is_positive_definite():
    """1/sqrt(r^2 + (R_i^2 + R_j^2)/2) shall be positive definite for cells of any sizes, the plain mean not."""
    for growth, stretch in ((1.0, 1), (1.0, 10), (1.5, 1), (2.0, 1), (3.0, 1)):
        line = np.concatenate([-np.cumsum(growth ** np.arange(8.0))[::-1], [0], np.cumsum(growth ** np.arange(8.0))])
        x, y = (axis.ravel() for axis in np.meshgrid(stretch * line, line))
        R = np.sqrt(stretch * np.outer(np.gradient(line), np.gradient(line)).ravel() / math.pi)
        square = (x[:, None] - x) ** 2 + (y[:, None] - y) ** 2
        soft = 1 / np.sqrt(square + (R[:, None] ** 2 + R**2) / 2)
        plain = 1 / np.sqrt(np.where(square > 0, square, 1)) + np.diag(2 / R - 1)
        scaled = [np.sqrt(np.outer(1 / np.diag(each), 1 / np.diag(each))) * each for each in (soft, plain)]
        least = [np.linalg.eigvalsh(each)[0] for each in scaled]
        assert least[0] > 0
        assert (least[1] > 0) == (growth == stretch == 1)


# ---------------------------------------------------------------- the page itself


def test_every_number_has_its_test():
    """Each section shall name tests: all of this file, those of others with the file, and only such as there are."""
    elsewhere = r"\(`(test_\w+\.py)`:([^)]*)\)"
    for file, names in re.findall(elsewhere, THEORY):
        for name in re.findall(r"`(test_\w+)`", names):
            assert f"def {name}(" in (ROOT / "tests" / file).read_text(), name
    named = set(re.findall(r"`(test_\w+)`", re.sub(elsewhere, "", THEORY)))
    there = {name for name in globals() if name.startswith("test_")}
    assert named == there - {"test_every_number_has_its_test"}
    for text in THEORY.split("\n## ")[1:]:
        assert "`test_" in text, text.partition("\n")[0]
