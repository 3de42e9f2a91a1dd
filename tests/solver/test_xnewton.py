"""Method xnewton: counts, laws, prescribed forces, exact distance, axisymmetry, against something independent."""

import numpy as np
import pytest
from freefem import cases_of, flag_lists, run, run_in, script, solve_rows

BASE = ["-method", "xnewton", "-tol", 1e-8]
P2_LAWS = flag_lists("-law signorini | -kappa 0.01 -m 30 | -kappa 1e12 | -kappa 1e30 -m 20")
LAWS = flag_lists("-law exponential -beta 500 | -law barrier -p0 1 | -law barrier -p0 1e-4 | -kappa 1e3 -m 1.05")
USUAL_LAWS = flag_lists("-law exponential -beta 60 | -kappa 1e6 -m 10")


@pytest.mark.parametrize("order", [1, 2])
def test_counts(tmp_path, order):
    """Any law shall be solved in 4 linearisations, 20 back-substitutions, one factorisation and one model."""
    laws = LAWS + P2_LAWS + USUAL_LAWS
    flags = [*BASE[2:], "-h", 0.25 * order, "-order", order]
    for law, done in zip(laws, solve_rows(tmp_path, "disc-on-block", laws, *flags), strict=True):
        assert done["newton"] <= 4, law
        assert done["backsolves"] <= 20, law
        assert done["factorisations"] == 1, law
        assert done["adaptations"] == 1, law
        assert done["used"]["kernel"] is True, law


SHRINKING = flag_lists("-law signorini -ends 4.239 | -kappa 1e9 -ends 4.272")


@pytest.mark.parametrize("flags", cases_of(SHRINKING, flag_lists("-kappa 1e12 -ends 4.245")), ids=str)
def test_counts_on_points_that_shrink_to_the_ends(flags):
    """Points of very different distances, 1:86, shall cost no more linearisations than even ones."""
    done = run("disc-on-block", *BASE, *flags, "-h", 0.5, "-order", 2)
    assert done.newton <= 4
    assert done.backsolves <= 20


def test_start_of_many_points_about_an_axis():
    """The start on a selection of 250 and more points shall count rings: by lengths it takes 7 linearisations."""
    flags = ("-geometry", "axisymmetric", "-h", 0.04, "-grading", 240, "-reach", 7)
    assert run("disc-on-block", *BASE, *flags, "-order", 2).newton <= 3


@pytest.mark.parametrize("law", [["-kappa", 1e9], ["-law", "exponential"]], ids=str)
def test_cold_start(law):
    """Without the half-plane start 10 linearisations shall do, and 16 with a wall that is met."""
    assert run("disc-on-block", *BASE, *law, "-h", 0.2, "-start", "none").newton <= 10
    walled = run("disc-on-block", *BASE, *law, "-h", 0.2, "-start", "none", "-T0", "d0")
    assert walled.newton <= 16
    assert walled.adaptations == 2
    assert walled.summary["used"]["wall"] is True


@pytest.mark.parametrize(
    "flags",
    cases_of([[], *flag_lists("-kappa 1e6 -m 10 | -law barrier -T0 -0.01")], [["-law", "exponential"]]),
    ids=str,
)
def test_same_as_paper(flags):
    """The paper's scheme, run to its exact stop, shall give the same force, pressures and energy."""
    rest = flags[: flags.index("-T0")] if "-T0" in flags else flags
    ours = run("disc-on-block", "-method", "xnewton", "-tol", 1e-11, "-h", 0.5, *rest)
    paper = run("disc-on-block", "-method", "paper", "-tol", 1e-11, "-eps", 1e-12, "-h", 0.5, *flags)
    assert ours.force == pytest.approx(paper.force, rel=1e-9)
    np.testing.assert_allclose(ours.contact["pressure"], paper.contact["pressure"], atol=1e-8 * paper.pressureMax)
    assert ours.energy <= paper.energy * (1 + 1e-12)


PARTS = "-start none | -preconditioner none | -inner newton -T0 0 -start none | -threshold pointwise -T0 0 | -T0 d0"


@pytest.mark.parametrize("part", cases_of(flag_lists(PARTS), flag_lists("-preconditioner diagonal | -T0 0")), ids=str)
def test_ingredients(part):
    """Taking an ingredient away shall cost iterations, never change the answer."""
    whole = run("disc-on-block", "-method", "xnewton", "-tol", 1e-11, "-h", 0.5)
    bare = run("disc-on-block", "-method", "xnewton", "-tol", 1e-11, "-eps", 1e-10, "-h", 0.5, *part)
    assert bare.force == pytest.approx(whole.force, rel=1e-8)
    assert bare.backsolves >= whole.backsolves


def test_signorini_limit():
    """For kappa to infinity the force shall tend to Signorini's like kappa^(-1/m)."""
    flags = ["-h", 0.5, "-tol", 1e-12]
    hard = run("disc-on-block", *flags, "-law", "signorini").force
    off = [hard - run("disc-on-block", *flags, "-kappa", kappa, "-m", 3).force for kappa in (1e6, 1e9, 1e12)]
    rates = np.log10(np.array(off[:-1]) / off[1:]) / 3
    np.testing.assert_allclose(rates, 1 / 3, atol=0.02)


def test_pressure_does_not_oscillate():
    """P1 at kappa=1e12: the greatest pressure shall be within 2 % of the P2 value on the same mesh."""
    p1, p2 = (run("disc-on-block", *BASE, "-kappa", 1e12, "-h", 0.5, "-order", order) for order in (1, 2))
    assert p1.pressureMax == pytest.approx(p2.pressureMax, rel=0.02)


EXTREME = flag_lists("-nu 0.4999 -order 2 | -aspect 100 | -offset 15")
OTHERS = flag_lists("-d0 -1e-12 | -u0 0.250000000001 | -E 1e-6 | -E 1e12 | -d0 -5 | -u0 7.5")


@pytest.mark.parametrize("flags", cases_of(EXTREME, OTHERS), ids=str)
def test_extremes(flags):
    """Extreme data shall be solved, and to plain Newton's answer."""
    ours = run("disc-on-block", *BASE, "-h", 0.5, *flags)
    newton = run("disc-on-block", "-method", "newton", "-tol", 1e-10, "-h", 0.5, *flags)
    assert ours.newton <= 8
    assert ours.force == pytest.approx(newton.force, rel=1e-6)


@pytest.mark.parametrize("method", ["xnewton", "paper", "newton", "signorini"])
def test_prescribed_force(method):
    """The contact force shall be the applied one, and its approach, when prescribed, shall give this force."""
    flags = ["-method", method, "-tol", 1e-10, "-h", 0.5] + (["-eps", 1e-10] if method == "paper" else [])
    pushed = run("disc-on-block", *flags, "-force", 100)
    assert pushed.force == pytest.approx(100, rel=1e-10)
    moved = run("disc-on-block", *flags, "-u0", pushed.approach)
    assert moved.force == pytest.approx(100, rel=1e-7)


@pytest.mark.parametrize("kappa, m", [(1e30, 3), (1e3, 20), *((kappa, 3) for kappa in (1e3, 1e12))])
def test_exact_distance(kappa, m):
    """The true distance to the disc shall need 6 rounds, 25 linearisations, and raise the force by per cents."""
    linear = run("disc-on-block", *BASE, "-h", 0.2, "-kappa", kappa, "-m", m)
    exact = run("disc-on-block", *BASE, "-h", 0.2, "-kappa", kappa, "-m", m, "-distance", "exact")
    assert exact.rounds <= 6
    assert exact.newton <= 25
    assert 1.005 < exact.force / linear.force < 1.04


def test_table_law(tmp_path):
    """A table of the power law's values shall give its solution; a bad one shall be refused with its line."""
    good = tmp_path / "law.csv"
    overlaps = np.linspace(0, 0.4, 401)
    lines = [f"{d - 0.25:.17g},{1000 * d**3:.17g}" for d in overlaps]
    good.write_text("overlap,pressure\n" + "\n".join(lines) + "\n")
    tabled = run("disc-on-block", *BASE, "-h", 0.5, "-law", "table", "-table", good)
    power = run("disc-on-block", *BASE, "-h", 0.5)
    assert tabled.force == pytest.approx(power.force, rel=1e-6)
    bad = tmp_path / "bad.csv"
    bad.write_text("0,0\n1,2\n1,3\n")
    refused = run_in(".", script("disc-on-block"), "-law", "table", "-table", bad, out=tmp_path / "out", expect=10)
    assert "line 3" in refused.stdout.splitlines()[0]


def test_sphere_about_the_axis_against_hertz():
    """A rigid sphere under a force, axisymmetric: radius and greatest pressure within 1 % of Hertz at a/20."""
    force, radius, modulus = 10, 10, 100 / (1 - 0.3**2)
    a = (3 * force * radius / (4 * modulus)) ** (1 / 3)
    flags = ["-geometry", "axisymmetric", "-law", "signorini", "-force", force]
    flags += ["-reach", 2, "-h", a / 20, "-grading", 40]
    sphere = run("disc-on-block", *BASE, *flags)
    assert sphere.halfWidthMoment == pytest.approx(a, rel=0.01)
    assert sphere.pressureMax == pytest.approx(3 * force / (2 * np.pi * a**2), rel=0.01)
