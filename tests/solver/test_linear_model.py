"""-model linear of the method paper: beyond the threshold the law's tangent there, in place of a wall."""

import numpy as np
import pytest
from condensed import Problem, power, sequence
from freefem import (
    ROOT,
    TANGENT,
    WALL,
    Run,
    cases_of,
    data,
    named,
    refusal,
    run,
    run_in,
    scene_text,
    snippet,
    table,
    told,
)

DISC, TWO_BODIES, BALL = "disc-on-block", "meshed-disc", "sphere-on-block"
COARSE = ["-h", 0.5]
PAPER = ["-method", "paper", *COARSE]
LINEAR = [*PAPER, "-model", "linear"]
EXACT = ["-tol", 1e-11, "-eps", 1e-10]
PAIRS = "0,0\n0.05,0.4\n0.1,1.5\n0.15,5\n0.2,14\n0.25,40\n"  # overlap, pressure
CONCAVE = "0,0\n0.01,4\n0.03,9\n0.1,20\n0.3,40\n"


def same_force(linear, other, relative=1e-8):
    assert linear.force == pytest.approx(other.force, rel=relative)
    assert linear.pressureMax == pytest.approx(other.pressureMax, rel=relative)


# ---------------------------------------------------------------- counts

COUNTS = [  # models and Newton steps, as measured; the flags behind the scene's
    (DISC, [], (3, 7)),
    (DISC, ["-T0", 0], (3, 7)),
    (DISC, ["-threshold", "uniform"], (3, 8)),
    (TWO_BODIES, [], (3, 7)),
    (DISC, ["-force", 100], (3, 7)),
    (DISC, ["-kappa", 1, "-m", 3], (1, 3)),
    (DISC, ["-kappa", 1e12, "-m", 3], (2, 8)),
    (DISC, ["-kappa", 1e12, "-m", 1.5], (2, 5)),  # overlaps and thresholds agree to rounding: the status cycles
    (DISC, ["-kappa", 1e9, "-m", 20], (2, 7)),
    (DISC, ["-law", "exponential", "-beta", 500], (2, 9)),  # plain Newton fails
    (DISC, ["-law", "barrier", "-p0", 1e-4], (1, 12)),  # plain Newton fails
]
MORE = [
    (DISC, ["-kappa", 1e6, "-m", 3], (3, 9)),
    (DISC, ["-kappa", 1e9, "-m", 3], (2, 8)),
    (DISC, ["-kappa", 1e3, "-m", 1.5], (3, 8)),
    (DISC, ["-kappa", 1e3, "-m", 10], (3, 7)),
    (DISC, ["-law", "exponential"], (3, 9)),
    (DISC, ["-law", "barrier", "-p0", 1], (2, 8)),
]


@pytest.mark.parametrize("scene, flags, counts", cases_of(COUNTS, MORE), ids=named)
def test_counts(scene, flags, counts):
    """The sequence of tangents shall take so many models and Newton steps; no wall shall stand anywhere."""
    linear = run(scene, *LINEAR, *flags)
    assert (linear.adaptations, linear.newton) == counts
    assert linear.wallPoints == 0 and not (linear.models["status"] == WALL).any()


def test_walls_are_the_default():
    """Without the flag the model has walls, and -threshold uniform is a choice of it."""
    plain, wall = run(DISC, *PAPER), run(DISC, *PAPER, "-model", "wall", "-threshold", "pointwise")
    assert (plain.adaptations, plain.newton) == (wall.adaptations, wall.newton) == (3, 12)
    assert plain.force == wall.force
    uniform = run(DISC, *PAPER, "-threshold", "uniform", "-T0", "d0")
    assert uniform.adaptations == 2
    assert np.ptp(uniform.models[-1]["tau"]) == 0


def test_states_are_on_the_tangent():
    """Each model's pressures shall be those of the law up to the threshold and of its tangent there beyond it."""
    linear = run(DISC, *LINEAR, *EXACT)
    kappa, m = 1e3, 3
    beyond = 0
    for model in linear.models[:-1]:
        s, tau, at = model["s"], model["tau"], model["status"] == TANGENT
        expected = kappa * np.maximum(s, 0) ** m
        tangent = kappa * tau**m + m * kappa * tau ** (m - 1) * (s - tau)
        np.testing.assert_allclose(model["pressure"], np.where(at, tangent, expected), rtol=1e-8, atol=1e-9)
        assert (s[at] > tau[at]).all() and (s[~at] <= tau[~at]).all()
        beyond += at.sum()
    assert beyond > 5


GRAPH = """
real[int] ks = [K], taus = [TAU], shats(1), phats(1), sg(1), pg(1), dg(1);
int[int] stateg(1);
real[int] pt(1), dt(1);
lawPressure(taus, pt, dt);
shats = taus;
shats *= 3;
phats = pt;
computeGraphPoint(shats, phats, ks, taus, sg, pg, dg, stateg);
tell("tau", taus); tell("pt", pt); tell("dt", dt); tell("s", sg); tell("p", pg); tell("slope", dg);
real[int] status = [stateg[0]];
tell("status", status);
"""


@pytest.mark.parametrize("k", [1e-3, 1.0, 1e3, 1e12])
def test_the_graph_beyond_the_threshold(tmp_path, k):
    """The graph's point shall be where the tangent meets the line p + k s = c, to rounding, soft or stiff."""
    text = GRAPH.replace("TAU", "0.01").replace("K", repr(k))
    found = told(snippet(tmp_path, scene_text(DISC) + text, *LINEAR))
    at = {name: values[0] for name, values in found.items()}
    rest = 2 * k * at["tau"] / (k + at["dt"])  # s - tau: c - p(tau) - k tau = 2 k tau
    assert at["status"] == TANGENT and at["slope"] == at["dt"] > 0
    assert at["s"] - at["tau"] == pytest.approx(rest, rel=1e-9, abs=1e-16)
    assert at["p"] - at["pt"] == pytest.approx(at["dt"] * rest, rel=1e-9)


# ---------------------------------------------------------------- the same force

LAWS = [[], ["-law", "exponential"], ["-law", "barrier"], ["-kappa", 1e9, "-m", 1.5], ["-force", 100]]


@pytest.mark.parametrize("flags", LAWS, ids=named)
def test_the_force_is_that_of_the_law(flags):
    """The sequence shall converge to the default method's force, pressure and approach."""
    linear, direct = run(DISC, *LINEAR, *EXACT, *flags), run(DISC, *COARSE, *EXACT, *flags)
    same_force(linear, direct)
    assert linear.approach == pytest.approx(direct.approach, rel=1e-8)


@pytest.mark.parametrize("first", [0, "auto", -0.2])
@pytest.mark.parametrize("update", ["pointwise", "uniform"])
def test_first_thresholds_and_updates(first, update):
    """Whatever the first threshold and the update, the force shall be the same."""
    same_force(run(DISC, *LINEAR, *EXACT, "-T0", first, "-threshold", update), run(DISC, *COARSE, *EXACT))


def test_a_law_that_is_steep_at_touch_starts_from_d0():
    """The exponential law has a slope at first touch: T0 = d0 shall be allowed, and lead to its force."""
    flags = ["-law", "exponential", *EXACT]
    linear = run(DISC, *LINEAR, "-T0", "d0", *flags)
    assert linear.adaptations > 2 and (linear.models[0]["tau"] < 1e-9).all()
    same_force(linear, run(DISC, *COARSE, *flags))


@pytest.mark.parametrize("pairs", [PAIRS, CONCAVE], ids=["convex", "concave"])
def test_tables(tmp_path, pairs):
    """A tabulated law shall converge to the default method's force, also one whose slope falls."""
    (tmp_path / "pairs.csv").write_text(pairs)
    flags = ["-law", "table", "-table", tmp_path / "pairs.csv", "-order", 1, "-estimate", 0, "-vtu", 0, *EXACT]
    linear = run_in(ROOT, "edp/main.edp", *LINEAR, *flags, out=tmp_path / "linear")
    same_force(linear, run_in(ROOT, "edp/main.edp", *COARSE, *flags, out=tmp_path / "direct"))


def test_load_series():
    """In a load series each step shall have its own first threshold, and the force of the default method."""
    flags = ["-history", 1, "-steps", 3, *EXACT]
    linear, direct = run(DISC, *LINEAR, *flags), run(DISC, *COARSE, *flags)
    same_force(linear, direct)
    forces, expected = (table(found.folder / "series.csv")["force"] for found in (linear, direct))
    assert len(forces) == 3
    np.testing.assert_allclose(forces, expected, rtol=1e-8)


def test_space():
    """The same in space."""
    flags = ["-h", 1.5, *EXACT]
    same_force(run(BALL, "-method", "paper", "-model", "linear", *flags), run(BALL, *flags))


def test_pressed_by_a_load():
    """Where nothing overlaps before the load, no law is so soft that the first tangent carries nothing."""
    flags = ["-u0", 0.4, "-gap", 0.5, "-traction", -3, *EXACT]
    linear, direct = run(DISC, *LINEAR, *flags), run(DISC, *COARSE, *flags)
    assert direct.force > 0
    same_force(linear, direct)


# ---------------------------------------------------------------- what is refused

REFUSED = {
    "-method paper -model linear -T0 d0": "-T0 d0: the tangent of the law at first touch has no slope",
    "-method paper -model linear -T0 -0.25": "-T0 -0.25: the tangent of the law at first touch has no slope",
    "-method paper -model linear -T0 d0 -m 1.2": "-T0 d0: the tangent of the law at first touch has no slope",
    "-method paper -model linear -T0 -0.2 -kappa 1e9 -m 20": "-T0 -0.2: the tangent of the law at this threshold",
    "-method paper -model linear -T0 0 -law barrier": "-T0 0: the law is infinite at this threshold",
    "-method paper -model linear -law signorini": "-model linear: -law signorini has no tangent",
    "-method paper -model tangent": "-model tangent: unknown; allowed: one of: wall linear",
    "-model linear": "-model: not a flag of this method; allowed: only with -method paper",
    "-method newton -model linear": "-model: not a flag of this method; allowed: only with -method paper",
}


@pytest.mark.parametrize("flags", REFUSED)
def test_refusals(tmp_path, flags):
    assert refusal(tmp_path, "disc-on-block", *flags.split()).startswith(REFUSED[flags])
    assert not list(tmp_path.glob("out*"))


@pytest.mark.parametrize(
    "scene, flags, words",
    [
        ("adhesive-sphere", ["-method", "paper"], "-model linear: the law lennard-jones attracts"),
        ("fretting", ["-method", "paper", "-friction", 0.3], "-friction 0.3: only with -method xnewton"),
    ],
    ids=named,
)
def test_refusals_of_scenes(tmp_path, scene, flags, words):
    words_of = [*flags, "-model", "linear"]
    refused = run_in(ROOT, f"edp/scenes/{scene}.edp", *words_of, out=tmp_path / "out", expect=10)
    assert refused.stdout.startswith(words), refused.stdout


# ---------------------------------------------------------------- uniform thresholds that take three models

COLUMNS = """
setUpContact();
real[int] unit(points), column(points);
for (int i = 0; i < points; i++)
    if (abs(pointX[i] - 5) < 0.01 || pointX[i] > 9.99)
    {
        unit = 0;
        unit[i] = 1;
        computeForceOverlap(unit, column, 0);
        real[int] at = [pointX[i], weight[i]];
        tell("point", at);
        tell("column", column);
    }
tell("x", pointX);
"""


@pytest.fixture(scope="module")
def cantilever(tmp_path_factory):
    """The beam's two points, their order along it, and flags of overlaps at which hard contact has the forces 0.01."""
    folder = tmp_path_factory.mktemp("beam")
    script = data("theory/beam.edp").split('include "solver/solve.idp"')[0]
    out = [line.split() for line in snippet(folder, script + COLUMNS).splitlines() if line.startswith("told ")]
    points, columns = (np.array([row[2:] for row in out if row[1] == name], float) for name in ("point", "column"))
    x = np.array(next(row[2:] for row in out if row[1] == "x"), float)
    here = [int(np.argmin(abs(x - at))) for at in points[:, 0]]
    C = columns[:, here]
    problem = Problem((C + C.T) / 2, points[:, 1], C @ np.array([0.01, 0.01]))
    middle, tip = problem.free[np.argsort(points[:, 0])]
    return problem, np.argsort(points[:, 0]), ["-middle", middle, "-tip", tip]


@pytest.mark.parametrize("kappa, m", [(1e2, 2), (1e4, 3)])
def test_a_beam_takes_three_models(cantilever, tmp_path, kappa, m):
    """When the walls go, the beam's tip takes a greater pressure than hard contact gave it: a third model follows."""
    problem, order, overlaps = cantilever
    assert np.linalg.inv(problem.C).sum(1).min() < 0  # a row sum below 0
    flags = ["-kappa", kappa, "-m", m, *EXACT, *overlaps]
    script = data("theory/beam.edp")
    say = snippet(tmp_path, script, "-method", "paper", "-T0", "d0", "-threshold", "uniform", *flags, "-out", "walls")
    walls = Run(0, say, tmp_path / "walls")
    assert walls.adaptations == 3
    q = np.array([model["pressure"][model["pressure"] > 0] for model in walls.models]) * problem.w[order]
    assert q[1, 1] > q[0, 1] * 1.01 and q[1, 0] < q[0, 0]
    found = sequence(problem, power(kappa, m), 0.0, "wall", "uniform", 1e-10, inner="exact")
    np.testing.assert_allclose(q, [model.q[order] for model in found.models], rtol=1e-6)
    snippet(tmp_path, script, *flags, "-out", "direct")
    assert Run(0, "", tmp_path / "direct").force == pytest.approx(walls.force, rel=1e-8)
    say = snippet(tmp_path, script, "-method", "paper", "-model", "linear", *flags, "-out", "tangents")
    assert Run(0, say, tmp_path / "tangents").force == pytest.approx(walls.force, rel=1e-8)


# ---------------------------------------------------------------- the part "model" of the error


@pytest.mark.parametrize("law", [["-kappa", 1e3], ["-m", 10], ["-law", "barrier"]], ids=named)
@pytest.mark.parametrize("eps", [0.1, 1e-2])
def test_the_models_error_is_bounded(law, eps):
    """What a sequence that stops early lacks in the force shall be below the bound, and not far below."""
    linear = run(DISC, *LINEAR, *law, "-tol", 1e-9, "-eps", eps, "-estimate", 1)
    off = abs(linear.force - run(DISC, *COARSE, *law, *EXACT).force)
    assert off <= linear.estimates["parts"]["model"] * 1.05 <= 10 * off
