"""What single runs shall show: the exact state, no contact, runs that do not converge, and the files' contents."""

import numpy as np
import pytest
from freefem import LAW, OPEN, ROOT, WALL, cases_of, named, run, run_in, script
from output.test_paraview import Grid

DISC, TWO_BODIES, BLOCK = "disc-on-block", "meshed-disc", "confined-block"
SCENES = [DISC, TWO_BODIES, BLOCK]

# ---------------------------------------------------------------- the confined block's exact state

E, NU, WIDTH, HEIGHT, D0, U0, GAP = 100.0, 0.3, 20.0, 20.0, -0.25, 2.5, 0.5
CONFINED = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))


def exact_state(kappa, m):
    """(s, p): the root of kappa s^m = M (u0 - gap - d0 - s) / L, by bisection in s = d - d0."""
    low, high = 0.0, U0 - GAP - D0
    for _ in range(200):
        s = 0.5 * (low + high)
        if kappa * s**m > CONFINED * (U0 - GAP - D0 - s) / HEIGHT:
            high = s
        else:
            low = s
    return s, CONFINED * (U0 - GAP - D0 - s) / HEIGHT


@pytest.mark.parametrize("method", ["paper", "paper from d0", "newton", "incremental"])
@pytest.mark.parametrize(
    "order, kappa, m",
    cases_of([(2, 1, 1.1), (1, 1e3, 20), (2, 1e12, 1.05)], [(1, 1e3, 3), (2, 1e6, 3.3), (1, 1e12, 3)]),
)
def test_confined_block(method, order, kappa, m):
    """Under a flat wall the confined block shall be in the uniform state known exactly, to 1e-10."""
    first = ["-T0", "d0"] if "d0" in method else []
    flags = ["-order", order, "-h", 5, "-kappa", kappa, "-m", m, "-tol", 1e-12, "-eps", 1e-12]
    result = run(BLOCK, "-method", method.split()[0], *first, *flags)
    s, p = exact_state(kappa, m)
    np.testing.assert_allclose(result.contact["pressure"], p, rtol=1e-10)
    np.testing.assert_allclose(result.contact["overlap"], s + D0, rtol=0, atol=1e-10 * abs(D0))
    assert result.force == pytest.approx(WIDTH * p, rel=1e-10)
    # strain energy of the uniform strain p/M, and the layer's kappa s^(m+1) / (m+1)
    energy = 0.5 * p**2 / CONFINED * WIDTH * HEIGHT + WIDTH * p * s / (m + 1)
    assert result.energy == pytest.approx(energy, rel=1e-10)
    assert result.halfWidth is None  # contact up to the last point


def test_confined_block_of_hard_contact():
    """Hard contact shall press the confined block's top to the wall exactly."""
    result = run(BLOCK, "-method", "signorini", "-order", 2, "-h", 5)
    np.testing.assert_allclose(result.contact["pressure"], CONFINED * (U0 - GAP - D0) / HEIGHT, rtol=1e-10)
    assert (result.contact["status"] == WALL).all()


def test_confined_block_of_odd_shape():
    """An element size that does not divide the block shall be rounded down to one that does."""
    result = run(BLOCK, "-method", "newton", "-width", 7, "-h", 3, "-tol", 1e-12)
    assert len(result.contact) == 4
    assert result.contact["weight"].sum() == pytest.approx(7, rel=1e-12)
    np.testing.assert_allclose(result.contact["pressure"], exact_state(1e3, 3)[1], rtol=1e-10)


# ---------------------------------------------------------------- no contact


APART = [*((scene, "xnewton", 0.2) for scene in SCENES), (DISC, "paper", 0.2), (DISC, "newton", 0.25)]
APART += [(DISC, "incremental", 0.25), (DISC, "signorini", 0.2), (DISC, "paper", -1), (TWO_BODIES, "paper", 0.2)]


@pytest.mark.parametrize("scene, method, u0", [*APART, (BLOCK, "newton", 0.25)])
def test_no_contact(scene, method, u0):
    """Short of first touch (u0 = gap + d0), or just at it, the result shall be zero force, converged, nothing open."""
    h = 5 if scene == BLOCK else 1
    steps = ["-steps", 2] if method == "incremental" else []
    result = run(scene, "-method", method, "-u0", u0, "-h", h, *steps)
    assert result.force == 0
    assert result.pressureMax == 0
    assert result.contactPoints == result.wallPoints == 0
    assert result.halfWidth is None
    assert result.energy == 0
    assert result.overlapMax == pytest.approx(u0 - GAP, rel=1e-12)
    assert (result.contact["status"] == OPEN).all()
    assert result.newton <= 2


@pytest.mark.parametrize("method", ["paper", "newton", "incremental", "signorini"])
def test_first_touch(method):
    """Just beyond first touch there shall be contact, at the disc's lowest point only."""
    result = run(DISC, "-method", method, "-u0", 0.2501, "-h", 1)
    assert result.force > 0
    assert list(result.contact["x"][result.contact["status"] != OPEN]) == pytest.approx([0], abs=1e-9)


# ---------------------------------------------------------------- not converged


STEPS, MODELS = ["-maxNewton", "-tol"], ["-maxAdaptations", "-eps"]


@pytest.mark.parametrize(
    "scene, flags, knobs",
    [
        (DISC, ["-method", "paper", "-T0", "d0", "-maxNewton", 2], STEPS),
        (DISC, ["-method", "newton", "-maxNewton", 2], STEPS),
        (DISC, ["-method", "incremental", "-maxNewton", 2], STEPS),
        (DISC, ["-method", "paper", "-T0", "d0", "-kappa", 100, "-maxAdaptations", 1], MODELS),
        (TWO_BODIES, ["-method", "paper", "-T0", "d0", "-kappa", 100, "-maxAdaptations", 1], MODELS),
        (BLOCK, ["-method", "newton", "-maxNewton", 2], STEPS),
    ],
    ids=named,
)
def test_not_converged(scene, flags, knobs):
    """A run that does not converge shall end with code 20, its files written, and name the flag to turn."""
    result = run(scene, *flags, "-h", 5 if scene == BLOCK else 1, expect=20)
    assert result.summary["converged"] is False
    message = next(line for line in result.stdout.splitlines() if "NOT CONVERGED" in line)
    for knob in knobs:
        assert knob in message
        assert knob in result.summary["message"]
    assert len(result.contact) == result.points
    assert len(result.history) == result.newton
    assert len(result.models) == len(result.newtonPerAdaptation)
    if "-maxAdaptations" in flags:
        assert result.adaptations == 1
        assert result.modelError >= result.parameters["eps"]
    else:
        assert result.history["iteration"].max() == 2
    if "incremental" in flags:
        assert result.history["step"].max() < 20  # it stops at the load step that fails


# ---------------------------------------------------------------- what the files say


@pytest.mark.parametrize("scene", SCENES)
def test_summary_names_the_run(scene):
    """summary.json shall carry scene, method and every parameter as it was used."""
    result = run(scene, "-method", "paper", "-h", 1.25, "-kappa", "1.2345678901234567e3", "-nu", 0.25)
    assert (result.scene, result.method, result.order, result.h) == (scene, "paper", 1, 1.25)
    parameters = result.parameters
    assert parameters["kappa"] == 1234.5678901234567
    for name, value in (("E", 100), ("nu", 0.25), ("m", 3), ("d0", -0.25), ("rho", 100), ("T0", "0"), ("u0", 2.5)):
        assert parameters[name] == value
    for name in "width depth gap eps tol maxNewton maxAdaptations steps order h method out".split():
        assert name in parameters


def test_history_counts():
    """history.csv shall have a row for each Newton step, its counts running through adaptations and load steps."""
    paper = run(DISC, "-method", "paper", "-h", 0.5)
    assert list(paper.history["newton"]) == list(range(1, paper.newton + 1))
    counts = [int((paper.history["adaptation"] == n).sum()) for n in range(1, paper.adaptations + 1)]
    assert counts == paper.newtonPerAdaptation
    loaded = run(DISC, "-method", "incremental", "-h", 0.5)
    assert loaded.history["step"].max() == 20
    assert (np.diff(loaded.history["step"]) >= 0).all()
    assert loaded.history["residual"][-1] == loaded.residual
    assert loaded.history["force"][-1] == pytest.approx(loaded.force, rel=1e-12)


@pytest.mark.parametrize("order", [1, 2])
def test_contact_covers_the_slave_surface(order):
    """contact.csv shall have every point of the slave surface, symmetric about the disc's axis, x rising."""
    contact = run(DISC, "-method", "newton", "-h", 0.5, "-order", order).contact
    assert len(contact) == 40 * order + 1
    np.testing.assert_allclose(contact["x"], np.linspace(-9.9, 9.9, 40 * order + 1), atol=1e-9)
    assert (contact["y"] == 20).all()
    assert contact["weight"].sum() == pytest.approx(2 * 9.9, rel=1e-12)
    np.testing.assert_allclose(contact["x"], -contact["x"][::-1], atol=1e-9)
    pressure = contact["pressure"]
    np.testing.assert_allclose(pressure, pressure[::-1], atol=0.02 * pressure.max())  # the mesh below is not symmetric
    inside = contact["status"] == LAW
    law = 1e3 * (contact["overlap"][inside] + 0.25) ** 3
    np.testing.assert_allclose(pressure[inside], law, atol=1e-5 * pressure.max())


def test_half_width_is_where_the_overlap_changes_sign():
    """The half-width shall be where the cubic through four points of d - d0 changes its sign."""
    result = run(DISC, "-method", "newton", "-h", 0.5)
    x, s = result.contact["x"], result.contact["overlap"] + 0.25
    i = np.flatnonzero(s > 0)
    ends = []
    for four in (slice(i[0] - 2, i[0] + 2), slice(i[-1] - 1, i[-1] + 3)):
        roots = np.roots(np.polyfit(x[four], s[four], 3))
        ends += [root.real for root in roots if abs(root.imag) < 1e-12 and x[four][1] <= root.real <= x[four][2]]
    assert len(ends) == 2
    assert result.halfWidth == pytest.approx(0.5 * (ends[1] - ends[0]), rel=1e-9)


MILD = "-nu 0.499|-nu 0|-E 1e-6|-E 1e9|-gap 3 -u0 5|-R 60|-nu -0.9|-m 1.05|-m 30|-kappa 1e-3|-d0 -2|-depth 2"
HARSH = "-kappa 1e15|-gap -1 -u0 0|-width 12|-R 0.6|-kappa 1e30 -m 30|-d0 -1e-6"
MILD, HARSH = ([flags.split() for flags in text.split("|")] for text in (MILD, HARSH))  # mild: in other tests too
EXTREMES = MILD + HARSH
MESHED = [flags for flags in EXTREMES if flags != ["-R", "0.6"]]  # smaller than an element


@pytest.mark.parametrize(
    "scene, flags",
    [
        *((DISC, flags) for flags in EXTREMES),
        *((TWO_BODIES, flags) for flags in MESHED),
    ],
    ids=named,
)
def test_extremes(scene, flags):
    """Runs far from the paper's case shall converge, keep every invariant and agree between the methods."""
    place = EXTREMES.index(flags)
    if scene == TWO_BODIES and flags[:2] == ["-gap", "-1"]:
        flags = ["-gap", 1e-6]  # meshed bodies do not overlap at rest
    newton = run(scene, "-method", "newton", "-h", 1, *flags)
    assert newton.force > 0
    assert newton.contactPoints >= 1
    threshold = "0" if place % 2 else "d0"
    paper = run(scene, "-method", "paper", "-T0", threshold, "-h", 1, *flags)
    assert paper.force == pytest.approx(newton.force, rel=1e-4)


# ---------------------------------------------------------------- ParaView and the states


@pytest.mark.parametrize("order", [1, 4])
def test_solution_for_paraview(tmp_path, order):
    """solution.vtu shall hold displacement and von Mises stress: of the confined block, uniform strain e = p/M."""
    out = tmp_path / "out"
    result = run_in(ROOT, script(BLOCK), "-method", "newton", "-h", 5, "-order", order, "-tol", 1e-12, out=out)
    grid = Grid(out / "solution.vtu")
    points, displacement = grid.points, grid.at_points["displacement[length]"]
    stress = grid.at_points["vonMises[pressure]"]
    strain = result.pressureMax / CONFINED
    assert len(points) == (4 * order + 1) ** 2
    np.testing.assert_allclose(displacement[:, 1], -strain * points[:, 1], atol=1e-6)
    np.testing.assert_allclose(displacement[:, [0, 2]], 0, atol=1e-6)
    np.testing.assert_allclose(stress, E / (1 + NU) * strain, rtol=1e-6)
