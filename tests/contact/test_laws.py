"""laws/: the contact law, its inverse and potential, and the law wrapped in its wall, against values of our own."""

from decimal import Decimal, getcontext
from itertools import product

import numpy as np
import pytest
from accounts import shared
from freefem import LAW, OPEN, WALL, data, snippet, told

getcontext().prec = 40

PRELUDE = data("laws/prelude.edp")

LAW_ROWS = data("laws/law-rows.edp")

GRAPH_ROWS = data("laws/graph-rows.edp")


# stiffness and exponent: the ends of their ranges and the usual ones; between them in the long run
RANGE = [(1e-2, 1.05), (1e-2, 30), (1e3, 3), (1e30, 1.05), (1e30, 30)]
BETWEEN = [pair for pair in product((1e-2, 1e3, 1e12, 1e30), (1.05, 3, 10, 30)) if pair not in RANGE]
RANGE += [pair for pair in BETWEEN]


def evaluate(folder, code, rows, *flags, options=""):
    rows = np.array(rows, float)
    lines = [str(len(rows))] + [" ".join(map(repr, map(float, np.atleast_1d(row)))) for row in rows]
    (folder / "rows.txt").write_text("\n".join(lines) + "\n")
    return told(snippet(folder, options + PRELUDE + code, *flags))


def law_of(folder, overlaps, kappa, m):
    return evaluate(folder, LAW_ROWS, overlaps, "-method", "newton", "-kappa", kappa, "-m", m)


# ---------------------------------------------------------------- the law


def test_law_by_hand(tmp_path):
    """The power law shall give kappa s^m, its slope and its potential, worked out by hand."""
    law = law_of(tmp_path, [0.2, 0.5, 2.0], 1000, 3)
    np.testing.assert_allclose(law["pressure"], [8, 125, 8000], rtol=1e-14)
    np.testing.assert_allclose(law["slope"], [120, 750, 12000], rtol=1e-14)
    np.testing.assert_allclose(law["potential"], [0.4, 15.625, 4000], rtol=1e-14)
    np.testing.assert_allclose(law["inverse"], [0.2, 0.5, 2.0], rtol=1e-14)


def test_law_is_zero_without_overlap(tmp_path):
    """Pressure, slope and potential shall be exactly 0 where the asperities do not touch."""
    law = law_of(tmp_path, [0.0, -1e-300, -1e-9, -0.3, -1e9], 1000, 3)
    for values in law.values():
        assert (values == 0).all()


@pytest.mark.parametrize("kappa, m", RANGE)
def test_law_over_its_range(tmp_path, kappa, m):
    """The law shall keep its relative precision for any stiffness and exponent, however thin the layer."""
    top = (100 / kappa) ** (1 / m)  # where p = 100
    overlaps = top * np.logspace(-6, 1, 50)
    law = law_of(tmp_path, overlaps, kappa, m)
    exact = [Decimal(kappa) * Decimal(float(s)) ** Decimal(m) for s in overlaps]
    normal = np.array([float(p) for p in exact]) > 1e-290
    assert normal.sum() > 25
    for values, factors in (
        (law["pressure"], [Decimal(1)] * 50),
        (law["slope"], [Decimal(m) / Decimal(float(s)) for s in overlaps]),
        (law["potential"], [Decimal(float(s)) / (Decimal(m) + 1) for s in overlaps]),
    ):
        assert np.isfinite(values).all()
        expected = np.array([float(p * factor) for p, factor in zip(exact, factors, strict=True)])
        np.testing.assert_allclose(values[normal], expected[normal], rtol=2e-13)
    np.testing.assert_allclose(law["inverse"][normal], overlaps[normal], rtol=1e-12)


PAIRS = [(0, 0), (0.1, 0.3), (0.25, 1), (0.3, 2.5), (0.7, 4), (1, 40)]
CURVES = [((100 / kappa) ** (1 / m), ("-kappa", kappa, "-m", m)) for kappa, m in [(1e3, 3), (1e12, 1.05), (1e30, 30)]]
CURVES += [(0.05, ("-law", "exponential")), (0.02, ("-law", "barrier")), (0.3, ("-law", "linear", "-k", 7))]
CURVES += [(0.29, ("-law", "table", "-table", "pairs.csv"))]


@pytest.mark.parametrize("top, flags", CURVES, ids=[" ".join(map(str, flags)) for _, flags in CURVES])
def test_law_derivatives(tmp_path, top, flags):
    """Slope and pressure shall be the derivatives of pressure and potential, by central differences."""
    (tmp_path / "pairs.csv").write_text("".join(f"{s},{p}\n" for s, p in PAIRS))
    middle = top * np.logspace(-1, 1, 9)
    step = 1e-5 * middle
    places = np.concatenate([middle, middle - step, middle + step])
    law = evaluate(tmp_path, LAW_ROWS, places, "-method", "newton", *flags)
    for function, derivative in (("pressure", "slope"), ("potential", "pressure")):
        _, low, high = law[function].reshape(3, -1)
        np.testing.assert_allclose((high - low) / (2 * step), law[derivative][:9], rtol=1e-7)
    np.testing.assert_allclose(law["inverse"], places, rtol=1e-9)
    assert 0 < law["potential"][0] < 0.7 * middle[0] * law["pressure"][0]


def test_table(tmp_path):
    """A tabulated law shall pass through its pairs, and store no energy before them."""
    (tmp_path / "pairs.csv").write_text("".join(f"{s},{p}\n" for s, p in PAIRS))
    places = [s for s, _ in PAIRS] + [-0.1]
    law = evaluate(tmp_path, LAW_ROWS, places, "-method", "newton", "-law", "table", "-table", "pairs.csv")
    np.testing.assert_allclose(law["pressure"], [p for _, p in PAIRS] + [0], rtol=1e-14)
    assert law["potential"][0] == law["potential"][-1] == 0
    assert (np.diff(law["potential"][:-1]) > 0).all()


# ---------------------------------------------------------------- the law with its wall


@shared
def resolvent(shat, phat, k, tau, kappa, m):
    """(state, s, p, slope) of the graph's point with p + k s = phat + k shat, by bisection in 40 digits."""
    c = Decimal(phat + k * shat)
    kappa, m, k = Decimal(kappa), Decimal(m), Decimal(k)
    if c <= 0:
        return OPEN, c / k, Decimal(0), Decimal(0)
    if tau < 1e300:
        tau = Decimal(tau)
        if (kappa * tau**m if tau > 0 else 0) + k * tau <= c:
            return WALL, tau, c - k * tau, Decimal(0)
    high = min(c / k, ((c / kappa).ln() / m).exp())
    low = high / 3
    while kappa * low**m + k * low > c:
        low /= 3
    for _ in range(48):
        middle = (low + high) / 2
        if kappa * middle**m + k * middle > c:
            high = middle
        else:
            low = middle
    s = (low + high) / 2
    p = kappa * s**m
    return LAW, s, p, m * p / s


def graph_rows(kappa, m):
    """Rows shat, phat, k, tau: open, on the law and at the wall, soft and stiff bodies, exact and far-off pairs."""
    rows = []
    for k in (1e-4, 30.0, 1e8):
        for c in (1e-8, 0.3, 40.0, 1e6):
            _, s, _, _ = resolvent(0, c, k, 1e300, kappa, m)
            for tau in (0.0, 0.5 * float(s), 2 * float(s), 1e300):
                rows.append((0.0, c, k, tau))
                rows.append((c / k, 0.0, k, tau))
                rows.append((1.5 * c / k, -0.5 * c, k, tau))
        rows += [(-0.3, 2.0 * k * 0.1, k, 0.1), (-1e-9, 0.0, k, 1e300), (0.0, 0.0, k, 0.0), (0.0, 0.0, k, 1e300)]
    return rows


@pytest.mark.parametrize("kappa, m", RANGE)
def test_graph_point(tmp_path, kappa, m):
    """The graph's point along the body's response shall be the one that bisection finds, in every state."""
    rows = graph_rows(kappa, m)
    found = evaluate(tmp_path, GRAPH_ROWS, rows, "-method", "newton", "-kappa", kappa, "-m", m)
    expected = [resolvent(*row, kappa, m) for row in rows]
    states = np.array([point[0] for point in expected])
    assert (found["state"] == states).all()
    assert {OPEN, LAW, WALL} == set(states)
    for column, name in enumerate(("s", "p", "slope"), start=1):
        values = np.array([float(point[column]) for point in expected])
        assert np.isfinite(found[name]).all()
        np.testing.assert_allclose(found[name], values, rtol=5e-12, err_msg=name)


def test_graph_point_of_the_wall_alone(tmp_path):
    """Without a law the graph shall be Signorini's: open below the wall, any pressure at it."""
    rows = [(0.1, 2.0, 5.0, 0.0), (-0.1, 2.0, 5.0, 0.0), (-1.0, 2.0, 5.0, 0.0), (0.0, 0.0, 5.0, 0.0)]
    found = evaluate(tmp_path, GRAPH_ROWS, rows, "-method", "signorini")
    np.testing.assert_allclose(found["s"], [0, 0, -0.6, 0], rtol=1e-14)
    np.testing.assert_allclose(found["p"], [2.5, 1.5, 0, 0], rtol=1e-14)
    assert list(found["state"]) == [WALL, WALL, OPEN, OPEN]
    assert (found["slope"] == 0).all()


def test_graph_point_moves_no_point_of_the_graph(tmp_path):
    """A pair that is on the graph already shall stay where it is."""
    s = np.array([0.01, 0.1, 0.3])
    on_law = [(si, 1000 * si**3, k, 1e300) for si in s for k in (1e-3, 10.0, 1e5)]
    at_wall = [(si, 1000 * si**3 + 7, k, si) for si in s for k in (1e-3, 10.0, 1e5)]
    found = evaluate(tmp_path, GRAPH_ROWS, on_law + at_wall, "-method", "newton", "-kappa", 1000, "-m", 3)
    np.testing.assert_allclose(found["s"], [row[0] for row in on_law + at_wall], rtol=1e-12)
    np.testing.assert_allclose(found["p"], [row[1] for row in on_law + at_wall], rtol=1e-11)
    assert list(found["state"]) == [LAW] * 9 + [WALL] * 9
