"""Work is force: the reported energy's derivative in the prescribed displacement is the reported force."""

import numpy as np
import pytest
from freefem import cases_of, run, table

STEP = 5e-4  # of the approach: the difference's own error is of its square, its rounding far below
HARD = ["-law", "signorini"]
LAWS = {
    "exponential": ["-law", "exponential"],
    "barrier": ["-law", "barrier"],
    "table": ["-law", "table"],
    "signorini": HARD,
}
# small meshes; smooth laws: hard contact's energy has kinks in its second derivative where a point comes into contact
SCENES = [
    ("disc-on-block", 2.5, ["-h", 1, "-order", 2, "-method", "newton"]),
    ("disc-on-block", 2.5, ["-h", 1, "-bodyForce", 0.5, "-traction", 1]),
    ("disc-on-block-ipopt", 2.5, ["-h", 1, "-method", "newton"]),
    ("confined-block", 2.5, ["-h", 4]),
    ("flat-punch", 2.5, ["-h", 1, "-geometry", "axisymmetric"]),
    ("sphere-on-plane", 0.1, ["-force", 0, "-law", "power", "-d0", -0.25, "-h", 0.6, "-layers", 2]),
    ("two-spheres", 0.5, ["-force", 0, "-law", "power", "-d0", -0.25, "-h", 0.6, "-layers", 2]),
]
# what other elements find as well (test_elements.py), and the same formulas once more
MORE = [
    ("wavy", 2.5, ["-h", 0.5, "-geometry", "stress"]),
    ("two-cylinders", 0.5, ["-force", 0, "-law", "power", "-d0", -0.25, "-h", 0.4]),
    ("patch-test", 2.5, []),
    ("hertz-line", 0.3, ["-force", 0, "-law", "power", "-d0", -0.25, "-h", 0.4]),
    ("disc-on-block", 2.5, ["-h", 0.5]),
    ("disc-on-block", 2.5, ["-h", 0.5, "-geometry", "stress"]),
    ("disc-on-block", 2.5, ["-h", 0.5, "-geometry", "axisymmetric", "-width", 20]),
    ("wavy", 2.5, ["-h", 0.5]),
    ("flat-punch", 2.5, ["-h", 0.5]),
    ("flat-punch", 2.5, ["-h", 1, "-kappa", 1e9]),
    ("rough", 1.0, ["-h", 0.5, "-modes", 20]),
    ("meshed-disc", 2.5, ["-h", 0.5, "-Eratio", 10]),
    ("patch-test-3d", 2.5, ["-lower", 2, "-upper", 3]),
    ("sphere-on-block", 1.0, ["-h", 1, "-patch", 3, "-layers", 2]),
]


def derivative(scene, u0, flags):
    """The energy's difference over a step of the approach, and the mean of the forces at its ends."""
    before, after = (run(scene, *flags, "-tol", 1e-12, "-u0", u0 + k * STEP) for k in (-1, 1))
    return (after.energy - before.energy) / (2 * STEP), (before.force + after.force) / 2


@pytest.mark.parametrize(
    "scene, u0, flags", cases_of(SCENES, MORE), ids=lambda value: str(value) if isinstance(value, str) else None
)
def test_work_is_force_in_every_scene(scene, u0, flags):
    """dE/du0 shall be the force to 1e-5."""
    slope, force = derivative(scene, u0, flags)
    assert force > 0
    assert slope == pytest.approx(force, rel=1e-5)


@pytest.mark.parametrize("law", LAWS)
def test_work_is_force_for_every_law(tmp_path_factory, law):
    """The same along a path with the other laws, in the plane; a table of the power law's own pairs."""
    flags = list(LAWS[law])
    if law == "table":
        pairs = tmp_path_factory.getbasetemp() / "pairs.csv"
        pairs.write_text("".join(f"{s / 20},{1e3 * (s / 20) ** 3!r}\n" for s in range(11)))
        flags += ["-table", pairs]
    ends = f"{2.5 - STEP!r} {2.5 + STEP!r}"
    done = run("attraction/flat-punch", "-h", 1, *flags, "-tol", 1e-12, "-path", ends, "-steps", 1)
    states = table(done.folder / "path.csv")
    assert states["force"].min() > 0
    assert np.diff(states["energy"]) / np.diff(states["approach"]) == pytest.approx(states["force"].mean(), rel=1e-5)
    assert (states["stability"] == 1).all() and "stiffness" not in states.dtype.names
    assert states["contactPoints"][-1] == done.contactPoints
