"""Two deformable bodies: patch test, two cylinders, symmetry, stiffness contrast; rough and wavy surfaces."""

import itertools

import numpy as np
import pytest
from freefem import cases_of, named, run, table

TIGHT = ["-tol", 1e-11]
XNEWTON, PAPER = ["-method", "xnewton"], ["-method", "paper", "-eps", 1e-12]


def confined(kappa, m, d0, push, lengths, moduli):
    """Pressure of the 1D state: p = kappa (d - d0)^m = (push - d)/sum(L/M), by bisection."""
    soft = sum(length / modulus for length, modulus in zip(lengths, moduli, strict=True))
    low, high = d0, push
    for _ in range(200):
        d = (low + high) / 2
        low, high = (d, high) if kappa * (d - d0) ** m < (push - d) / soft else (low, d)
    return (push - d) / soft


@pytest.mark.parametrize(
    "method, order, ratio",
    cases_of(
        [(XNEWTON, 1, 1e9), (XNEWTON, 2, 1e-6), (PAPER, 1, 1e-6), (PAPER, 2, 1)],
        itertools.product((XNEWTON, PAPER), (1, 2), (1, 1e-6, 1e9)),
    ),
    ids=named,
)
def test_patch(method, order, ratio):
    """Between meshes of 7 and 11 elements the pressure shall be exact to 1e-10, whatever the stiffness contrast."""
    done = run("patch-test", *method, *TIGHT, "-order", order, "-Eratio", ratio)
    modulus = 100 * 0.7 / (1.3 * 0.4)
    exact = confined(1e3, 3, -0.25, 2, (20, 10), (modulus, modulus * ratio))
    np.testing.assert_allclose(done.contact["pressure"], exact, rtol=1e-10)


def test_patch_nodal_fails():
    """Nodal collocation between different meshes shall show its known fault: that is what segment points are for."""
    done = run("patch-test", "-points", "nodal")
    pressure = done.contact["pressure"]
    assert np.ptp(pressure) > 0.05 * pressure.mean()


def hertz(force, r1, r2, e1, e2, nu=0.3):
    modulus = 1 / ((1 - nu**2) / e1 + (1 - nu**2) / e2)
    a = np.sqrt(4 * force / (np.pi * modulus * (1 / r1 + 1 / r2)))
    return a, 2 * force / (np.pi * a)


def test_exchange_of_slave_and_master():
    """Exchanging slave and master shall change the force by less than the discretisation error does."""
    flags = ["-method", "xnewton", "-tol", 1e-9, "-force", 0, "-u0", 0.4, "-h", 0.2]
    one = run("two-cylinders", *flags, "-E2", 300, "-R2", 8, "-ratio", 1.37)
    other = run("two-cylinders", *flags, "-E1", 300, "-E2", 100, "-R1", 8, "-R2", 10, "-ratio", 0.73)
    finer = run("two-cylinders", *flags[:-1], 0.1, "-E2", 300, "-R2", 8, "-ratio", 1.37)
    assert abs(other.force - one.force) <= 2 * abs(finer.force - one.force)


@pytest.mark.parametrize("ratio", [1, 1.37])
def test_interface_of_equal_cylinders(ratio):
    """Two equal cylinders shall meet in a plane half-way: flat to 1e-3 of the height that the arc loses there."""
    done = run("two-cylinders", "-force", 0, "-u0", 0.4, "-h", 0.05, "-ratio", ratio, "-corners", 0, "-states", 1)
    states = table(done.folder / "states.csv")
    last = states[states["state"] == states["state"].max()]
    touching = done.contact[done.contact["status"] > 0]
    vertex = [
        np.argmin(np.hypot(last["x"] - x, last["y"] - y)) for x, y in zip(touching["x"], touching["y"], strict=True)
    ]
    height = last["y"][vertex] + last["uy"][vertex]
    assert np.ptp(height) < 1e-3 * np.ptp(touching["y"])
    assert height.mean() == pytest.approx(10 + (0.1 - 0.4) / 2, abs=1e-4)


MEETING = {"patch-test": [], "two-cylinders": ["-h", 0.2], "meshed-disc": ["-h", 0.5]}


@pytest.mark.parametrize(
    "scene, points",
    cases_of(
        [("patch-test", "nodal"), ("two-cylinders", "nodal"), ("meshed-disc", "segment")],
        itertools.product(MEETING, ("nodal", "segment")),
    ),
)
def test_action_is_reaction(scene, points):
    """Contact forces on the two bodies shall be equal and opposite to 1e-12, their moments to 1e-8."""
    done = run(scene, *MEETING[scene], "-points", points)
    assert done.summary["masterForceY"] == pytest.approx(done.force, rel=1e-12)
    assert done.summary["masterForceX"] == 0
    assert abs(done.summary["contactMoment"] + done.summary["masterMoment"]) < 1e-8 * done.force * 20


def test_hertz_line_converges():
    """A rigid cylinder under a force: within 1 % of Hertz at h = a/20, the pressure's error falling with h."""
    a, greatest = hertz(8.631, 10, 1e300, 100, 1e300)
    coarse, fine = (run("hertz-line", "-method", "xnewton", "-tol", 1e-8, "-h", h) for h in (0.2, 0.05))
    assert fine.halfWidthMoment == pytest.approx(a, rel=0.01)
    assert fine.pressureMax == pytest.approx(greatest, rel=0.01)
    assert abs(fine.pressureMax / greatest - 1) < abs(coarse.pressureMax / greatest - 1)


def test_meshed_disc_counts():
    """The meshed disc: xnewton within 4 linearisations, and the paper's scheme still in 3 adaptations, 12 steps."""
    ours = run("meshed-disc", "-method", "xnewton", "-tol", 1e-8, "-h", 0.5)
    assert ours.newton <= 4
    assert ours.adaptations == 1
    assert run("meshed-disc", "-method", "paper", "-h", 0.5).summary["newtonPerAdaptation"] == [6, 4, 2]


@pytest.mark.parametrize("kappa", [1e3, 1e9])
def test_many_contacts(kappa):
    """Wavy and rough surfaces: many separate contacts, to plain Newton's answer."""
    for scene, flags in (("wavy", ["-u0", 0.7, "-h", 0.4]), ("rough", ["-h", 0.4, "-modes", 40])):
        ours = run(scene, "-method", "xnewton", "-tol", 1e-8, "-kappa", kappa, *flags)
        newton = run(scene, "-method", "newton", "-tol", 1e-10, "-kappa", kappa, *flags)
        assert ours.force == pytest.approx(newton.force, rel=1e-6)
        assert ours.newton <= 8
        if kappa > 1e6:
            contact = ours.contact["status"] > 0
            assert np.count_nonzero(np.diff(contact.astype(int)) == 1) >= 5


@pytest.mark.parametrize("scene, flags", [("confined-block", ["-h", 4]), ("patch-test", ["-points", "nodal"])])
def test_scenes_without_gmsh(scene, flags):
    """A scene whose mesh is FreeFEM's own shall not load gmsh's plugin."""
    assert "gmsh" not in run(scene, *flags).summary["plugins"]
