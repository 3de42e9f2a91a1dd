"""The chapters of edp/docs/theory/ against runs, and against the compliance of real scenes, formed column by column."""

import math
import re
from itertools import pairwise

import numpy as np
import pytest
from accounts import shared
from freefem import ROOT, cases_of, data, run, scene_text, snippet, told

CHAPTERS = {path.name: path.read_text() for path in sorted((ROOT / "edp/docs/theory").glob("*.md"))}
MODELS = ROOT / "tests/docs/test_theory_models.py"  # of the chapters on sequences of models
DISC, SPHERE = "disc-on-block", "sphere-on-block"
COMPLIANCE = data("theory/compliance.edp")


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

    @shared
    def made(scene, *flags):
        flags = flags if "-order" in flags else (*flags, "-order", 1)
        folder = tmp_path_factory.mktemp("theory")
        return Problem(snippet(folder, scene_text(scene) + COMPLIANCE, *flags))

    return made


# ---------------------------------------------------------------- the law


def test_two_forms():
    """The least values of the two forms shall add up to nothing: the run's energy, and that of its forces alone."""
    done = run(DISC, "-h", 0.5, "-tol", 1e-11)
    x, w, p, s = (done.contact[name] for name in ("x", "weight", "pressure", "s"))
    given = done.parameters
    at_rest = given["u0"] - given["gap"] - given["R"] + np.sqrt(given["R"] ** 2 - x**2) - given["d0"]
    conjugate = given["m"] / (given["m"] + 1) * p * (p / given["kappa"]) ** (1 / given["m"])
    q = w * p
    assert 0.5 * q @ (at_rest - s) - at_rest @ q + w @ conjugate == pytest.approx(-done.energy, rel=1e-9)


# ---------------------------------------------------------------- errors


def energy_norm(C, q):
    return math.sqrt(q @ C @ q)


def dual_norm(C, e):
    return math.sqrt(e @ np.linalg.solve(C, e))


@pytest.mark.parametrize("m", [*(m for m in (2, 3)), 10])
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


SPECTRA = [(DISC, ("-h", 0.1), 0.75, 1.25), (DISC, ("-h", 0.5, "-order", 4), 0.75, 1.25)]
SPECTRA += [(SPHERE, ("-h", 1, "-layers", 2), 0.25, 1.25)]
MORE = [(DISC, flags, 0.75, 1.25) for flags in (("-h", 0.5), ("-h", 0.25), ("-h", 0.25, "-order", 2))]
MORE += [(SPHERE, ("-h", 1.5, "-layers", 2, "-order", 2), 0.5, 1.25)]


@pytest.mark.parametrize("scene, flags, low, high", cases_of(SPECTRA, MORE))
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


# ---------------------------------------------------------------- the pages themselves


def test_every_number_has_its_test():
    """Each chapter shall name tests: all of this file, those of others with the file, and only such as there are."""
    elsewhere = r"\(`(test_\w+\.py)`:([^)]*)\)"
    for page, text in CHAPTERS.items():
        for file, names in re.findall(elsewhere, text):
            for name in re.findall(r"`(\w+)`", names):
                module = next((ROOT / "tests").glob(f"*/{file}"))
                assert f"def {name}(" in module.read_text(), f"{page}: {name}"
        assert "`test" in text.split("\n## Test\n")[1], page
    named = set(re.findall(r"`(test_\w+)`", re.sub(elsewhere, "", "".join(CHAPTERS.values()))))
    there = {name for name in globals() if name.startswith("test_")} - {
        "test_every_number_has_its_test",
        "test_chapters_are_short_and_in_order",
    }
    models = set(re.findall(r"^def (test_\w+)\(", MODELS.read_text(), re.M)) if MODELS.exists() else named - there
    assert there <= named <= there | models


def test_chapters_are_short_and_in_order():
    """A chapter shall have at most 1 800 words, its parts in one order, and stand in the overview, which has 700."""
    parts = ["Question", "Idea", "Formulas", "Statement", "Reason", "Proof", "Test"]
    for page, text in CHAPTERS.items():
        assert len(text.split()) <= (700 if page == "README.md" else 1800), page
        if page != "README.md":
            assert f"({page})" in CHAPTERS["README.md"], page
            found = [title for title in re.findall(r"^## (.*)$", text, re.M) if title in parts]
            assert [*found[:2], found[-1]] == ["Question", "Idea", "Test"] and found == sorted(found, key=parts.index)
