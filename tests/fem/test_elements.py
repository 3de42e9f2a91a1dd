"""The elements: patch tests, accuracy, counts and energy at every order, in the plane, about the axis and in space."""

import numpy as np
import pytest
from contact.test_two_bodies import confined
from error.test_energy import derivative
from freefem import ROOT, cases_of, named, run, run_in, script, solve_rows

FORCE, PRESSURE, HALF_WIDTH = 150.0294748, 22.559747, 4.927623  # of the paper's test, from another code
SPHERE = 1567.7  # +- 0.3: the force of sphere-on-block's default load, from another code


PATCHES = [("patch-test", ["-order", 3, "-lower", 2, "-upper", 3]), ("patch-test", ["-order", 4])]
PATCHES += [("patch-test-3d", ["-order", k, "-lower", 2, "-upper", n]) for k, n in ((1, 5), (2, 3), (3, 3))]


@pytest.mark.parametrize("scene, flags", cases_of(PATCHES, [("patch-test-3d", ["-order", 2])]))
def test_patch(scene, flags):
    """Between meshes that do not match the pressure shall be uniform to 1e-10, and exact, the weights the areas."""
    done = run(scene, *flags, "-tol", 1e-12)
    exact = confined(1e3, 3, -0.25, 2, (20, 10), (100 * 0.7 / (1.3 * 0.4),) * 2)
    np.testing.assert_allclose(done.contact["pressure"], exact, rtol=1e-10)
    assert done.contact["weight"].min() > 0
    assert done.contact["weight"].sum() == pytest.approx(20 if scene == "patch-test" else 400, rel=1e-12)


@pytest.mark.parametrize("order", [1, 3])
def test_weights_about_the_axis(order):
    """The points of a surface about the axis shall have the area of its disc."""
    done = run("disc-on-block", "-geometry", "axisymmetric", "-h", 1, "-order", order, "-estimate", 0)
    assert done.contact["weight"].sum() == pytest.approx(np.pi * 9.9**2, rel=1e-12)


@pytest.mark.parametrize(
    "order, h, dofs, allowed",
    [
        (2, 0.25, 5000, (6e-4, 5e-4, 2e-4)),
        (3, 0.5, 4100, (1e-5, 1e-5, 1e-5)),
        (4, 1, 4500, (5e-6, 2e-5, 5e-5)),
        (4, 0.5, 7100, (3e-7, 6e-7, 2e-6)),
    ],
)
def test_accuracy(order, h, dofs, allowed):
    """Force, greatest pressure and half-width of the paper's test on a coarse mesh, against another code."""
    done = run("disc-on-block", "-order", order, "-h", h, "-grading", 60, "-tol", 1e-8)
    assert done.ndof < dofs
    found = done.force, done.pressureMax, done.halfWidth
    for value, exact, error in zip(found, (FORCE, PRESSURE, HALF_WIDTH), allowed, strict=True):
        assert value == pytest.approx(exact, rel=error)


@pytest.mark.parametrize("order", [3, 4])
def test_smooth_pressures(order):
    """Inside a hard contact the points' pressures shall scatter little: at evenly spaced nodes by 1.8e-2, 4.8e-3."""
    done = run("disc-on-block", "-law", "signorini", "-order", order, "-h", 0.5)
    inside = np.abs(done.contact["x"]) < 3
    x, p = done.contact["x"][inside], done.contact["pressure"][inside]
    smooth = np.polynomial.Polynomial.fit(x, p**2, 6)(x)
    assert np.abs(p / np.sqrt(smooth) - 1).max() < (6e-3 if order == 3 else 1e-3)


@pytest.mark.parametrize("method, steps", cases_of([("paper", 12)], [("newton", 8), ("linesearch", 8)]))
def test_methods_between_nodes(method, steps):
    """P3's points are no nodes: methods on the whole system shall find what the condensed one does."""
    done = run("disc-on-block", "-order", 3, "-method", method)
    assert done.newton <= steps
    assert done.force == pytest.approx(run("disc-on-block", "-order", 3).force, rel=1e-5)


def test_space():
    """P2 in space: ten times closer than P1 with as many degrees of freedom; equilibrium; few iterations."""
    done = run("sphere-on-block", "-order", 2, "-h", 1.25, "-layers", 1, "-patch", 6)
    assert done.ndof < 20000
    assert done.force == pytest.approx(SPHERE, rel=6e-3)
    assert done.contact["weight"].sum() == pytest.approx(12**2, rel=1e-10)
    assert done.summary["reactionZ"] == pytest.approx(done.force, rel=1e-9)
    assert done.newton <= 4 and done.backsolves <= 20


LAWS = [["-law", "signorini"], *[["-kappa", k, "-m", m] for k in (1e-2, 1e6, 1e30) for m in (1.05, 30)]]
ABOUT, BESIDE = ["-geometry", "axisymmetric", "-width", 20], ["-offset", 3]


@pytest.mark.parametrize("order", [2, 3, 4])
@pytest.mark.parametrize("more", [[], ABOUT, BESIDE], ids=named)
def test_counts(tmp_path, order, more):
    """At most 4 linearisations and 20 back-substitutions, whatever the law."""
    flags = [*more, "-order", order, "-h", 0.25 * order, "-tol", 1e-8]
    for law, done in zip(LAWS, solve_rows(tmp_path, "disc-on-block", LAWS, *flags), strict=True):
        assert done["newton"] <= 4, law
        assert done["backsolves"] <= 20, law


WORKING = [
    ("disc-on-block", 2.5, ["-h", 2, "-order", 4, "-geometry", "axisymmetric", "-width", 20]),
    ("meshed-disc", 2.5, ["-h", 2, "-order", 4, "-Eratio", 10]),
    ("sphere-on-block", 1.0, ["-h", 2, "-patch", 4, "-layers", 1, "-order", 2]),
]
MORE = [
    ("disc-on-block", 2.5, ["-h", 2, "-order", 4]),
    ("disc-on-block", 2.5, ["-h", 2, "-order", 4, "-geometry", "stress"]),
    ("patch-test", 2.5, ["-order", 4]),
    ("patch-test-3d", 2.5, ["-lower", 2, "-upper", 3, "-order", 2]),
]


@pytest.mark.parametrize("scene, u0, flags", cases_of(WORKING, MORE))
def test_work_is_force(scene, u0, flags):
    """dE/du0 shall be the force to 1e-5."""
    slope, force = derivative(scene, u0, flags)
    assert force > 0
    assert slope == pytest.approx(force, rel=1e-5)


P4_DISC = ("disc-on-block", ["-h", 2, "-order", 4])
P2_SPHERE = ("sphere-on-block", ["-h", 2, "-patch", 4, "-layers", 1, "-order", 2])


@pytest.mark.parametrize(
    "scene, flags, method",
    cases_of([(*P4_DISC, "newton")], [(*P4_DISC, "paper"), (*P2_SPHERE, "newton"), (*P2_SPHERE, "paper")]),
)
def test_methods_agree(scene, flags, method):
    """The paper's scheme and Newton's method shall find xnewton's solution."""
    best = run(scene, *flags, "-tol", 1e-9)
    other = run(scene, *flags, "-tol", 1e-9, "-eps", 1e-9, "-method", method)
    assert other.force == pytest.approx(best.force, rel=1e-7)
    np.testing.assert_allclose(other.contact["pressure"], best.contact["pressure"], atol=1e-6 * best.pressureMax)


def test_stress_without_jumps(tmp_path):
    """The stress below the contact, on the axis of symmetry, shall be smooth: P4's second differences are tiny."""
    done = run_in(ROOT, script("hertz-line"), "-order", 4, "-h", 0.25, "-axis", 1, out=tmp_path / "out")
    axis = np.genfromtxt(tmp_path / "out" / "axis.csv", delimiter=",", names=True)
    a, greatest = done.halfWidth, done.pressureMax
    depth = axis["depth"] / a
    exact = -greatest / np.sqrt(1 + depth**2)
    assert np.abs(axis["s22"] - exact).max() < 0.02 * greatest
    assert np.abs(np.diff(axis["s22"], 2)).max() < 0.01 * greatest
