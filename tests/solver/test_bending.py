"""Bodies that bend: strips that lie on a plane or are lifted at one end, against statics and slow starts."""

import numpy as np
import pytest
from freefem import part
from input.test_parts import Mesh, block

STEEL = (
    "units m Pa\nstate stress\nbody block E 210e9 nu 0.3 density 7850\nobstacle bottom plane 0 0 0 1\nsymmetry left\n"
)


def strip(length):
    """A strip of height 1 from the symmetry at 0, two elements high."""
    return block(Mesh(), size=(length, 1), cells=(2 * length, 2)).text()


def totals(run):
    """Newton steps, factorisations and back-substitutions of a run."""
    return [run.summary[name] for name in ("newton", "factorisations", "backsolves")]


def test_strip_under_pressure(tmp_path):
    """A strip that lies flat carries its pressure point by point, whatever its length: few steps, no cancellation."""
    for length in (60, 150):
        run = part(tmp_path, strip(length), STEEL + "pressure top 1e7\n", "-tol", 1e-8)
        steps, factors, backsolves = totals(run)
        assert steps <= 8 and factors <= steps + 1 and backsolves <= 45
        assert run.contact["pressure"] == pytest.approx(1e7, rel=1e-6)
        assert run.summary["contacts"][0]["points"] == len(run.contact["x"])


@pytest.mark.parametrize("length, most", [(12, 9), (30, 13), (60, 17)])
def test_lifted_strip(tmp_path, length, most):
    """A force at the end lifts twice its share of the weight, but for about the height where the strip comes down."""
    weight = 7850 * 9.81
    load = f"gravity 0 -9.81\nforce right 0 {0.2 * weight * length} free\n"
    run = part(tmp_path, strip(length), STEEL + load)
    steps, _, backsolves = totals(run)
    assert steps <= most and backsolves <= 5 * most
    (contact,) = run.summary["contacts"]
    assert contact["force"][1] == pytest.approx(0.8 * weight * length, rel=1e-9)
    assert 0 < contact["contactLength"] - 0.6 * length < 1
    touching = run.contact["pressure"] > 0
    assert np.all(run.contact["pressure"] >= 0) and np.all(run.contact["overlap"][~touching] < 0)
    assert touching[np.argsort(run.contact["x"])].tolist() == sorted(touching, reverse=True)  # one front


def test_same_as_slow_start(tmp_path):
    """Started without the surrogate, conjugate gradients come to the same state, with many steps more."""
    load = f"gravity 0 -9.81\nforce right 0 {0.1 * 7850 * 9.81 * 12} free\n"
    quick, slow = (
        part(tmp_path / str(k), strip(12), STEEL + load, "-tol", 1e-8, *words)
        for k, words in enumerate([(), ("-start", "none")])
    )
    assert quick.summary["newton"] < slow.summary["newton"] and slow.summary["factorisations"] == 1
    for name in ("pressure", "overlap"):
        assert quick.contact[name] == pytest.approx(slow.contact[name], abs=1e-6 * abs(slow.contact[name]).max())


def test_bent_by_a_soft_law(tmp_path):
    """A compliant law under a strip: the start through the layer, and the same pressures as by the slow start."""
    case = (
        STEEL.replace(
            "obstacle bottom plane 0 0 0 1", "obstacle bottom plane 0 0 0 1 law power kappa 1e13 m 2 d0 -1e-3"
        )
        + "pressure top 1e7\nforce right 0 3e6 free\n"
    )
    quick, slow = (
        part(tmp_path / str(k), strip(30), case, "-tol", 1e-8, *words)
        for k, words in enumerate([(), ("-start", "none")])
    )
    assert quick.summary["factorisations"] > 1 == slow.summary["factorisations"]
    scale = slow.contact["pressure"].max()
    assert quick.contact["pressure"] == pytest.approx(slow.contact["pressure"], abs=1e-5 * scale)


def test_errors_by_the_factor(tmp_path):
    """The adjoint problems of the factor have the solutions of those by conjugate gradients."""
    load = f"gravity 0 -9.81\nforce right 0 {0.2 * 7850 * 9.81 * 30} free\n"
    quick, slow = (
        part(tmp_path / str(k), strip(30), STEEL + load, "-tol", 1e-8, *words).summary
        for k, words in enumerate([(), ("-start", "none")])
    )
    one, other = quick["estimates"], slow["estimates"]
    assert one["contactStiffness"] == pytest.approx(other["contactStiffness"], rel=1e-4)
    for name in ("inside", "line"):
        assert one["parts"][name] == pytest.approx(other["parts"][name], rel=1e-3, abs=1e-9)
    # rotations lower the pressure where the strip comes down: a difference of large terms, whose sign is sure
    assert quick["linearised"]["pressureMax"][0] < -3e-5


def test_series_of_a_lifted_strip(tmp_path):
    """Each step of a load series begins with the points in contact of the last one, not with a layer again."""
    load = f"gravity 0 -9.81\nforce right 0 {0.1 * 7850 * 9.81 * 30} free\n"
    whole = part(tmp_path / "whole", strip(30), STEEL + load)
    steps = part(tmp_path / "steps", strip(30), STEEL + load, "-history", 1, "-steps", 4)
    assert steps.contact["pressure"] == pytest.approx(
        whole.contact["pressure"], abs=1e-5 * whole.contact["pressure"].max()
    )
    assert steps.summary["newton"] <= whole.summary["newton"] + 9


def test_two_slaves_on_one_strip(tmp_path):
    """Two contacts that share a node carry what one contact does: the two points there are not dependent."""
    load = f"gravity 0 -9.81\nforce right 0 {0.1 * 7850 * 9.81 * 30} free\n"
    one = part(tmp_path / "one", strip(30), STEEL + load)
    halves = block(Mesh(), size=(30, 1), cells=(60, 2))
    bottom = [k for k, (_, tag, ends) in enumerate(halves.elements) if halves.names[tag - 1] == (1, "bottom")]
    for k in bottom[:30]:
        kind, _, ends = halves.elements[k]
        halves.elements[k] = (kind, halves.group(1, "inner"), ends)
    case = STEEL.replace("symmetry", "obstacle inner plane 0 0 0 1\nsymmetry") + load
    two = part(tmp_path / "two", halves.text(), case)
    assert two.summary["factorisations"] > 1 and two.summary["newton"] <= one.summary["newton"] + 2
    (whole,), parts = one.summary["contacts"], two.summary["contacts"]
    assert sum(contact["force"][1] for contact in parts) == pytest.approx(whole["force"][1], rel=1e-9)
    assert all(0 < contact["force"][1] < whole["force"][1] for contact in parts)
    known = dict(zip(one.contact["x"].round(9), one.contact["pressure"], strict=True))
    expected = [known[x] for x in two.contact["x"].round(9)]
    assert two.contact["pressure"] == pytest.approx(expected, abs=1e-5 * max(expected))
    assert two.summary["estimates"]["parts"] == pytest.approx(one.summary["estimates"]["parts"], rel=0.1, abs=1e-6)
