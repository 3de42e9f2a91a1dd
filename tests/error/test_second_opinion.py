"""Errors against what is known beside a finer mesh: the law's integrals, one order more, a tighter tolerance."""

import numpy as np
import pytest
from fem.test_states import PLACES, TENSOR, E, line_of
from freefem import cases_of, part, run
from input.test_parts import UNTURNED, Mesh, block, cube, turn_in_space, vector

LAWS = {"power": ("-kappa", 10, "-m", 2), "exponential": ("-beta", 6)}


def profile(law, ring):
    """Of a body that hardly gives way under a disc: force, energy, greatest pressure, half-width, by the law alone."""
    deep, radius = 1.2 - 0.5 + 0.25, 10
    half = np.sqrt(radius**2 - (radius - deep) ** 2)
    x, share = np.polynomial.legendre.leggauss(200)
    x, share = half * (x + 1) / 2, half / 2 * share * (np.pi * half * (x + 1) if ring else 2)
    s = deep - radius + np.sqrt(radius**2 - x**2)
    if law == "exponential":
        p, stored, most = 0.02 * np.expm1(6 * s), 0.02 * (np.expm1(6 * s) / 6 - s), 0.02 * np.expm1(6 * deep)
    else:
        p, stored, most = 10 * s**2, 10 / 3 * s**3, 10 * deep**2
    return {"force": p @ share, "energy": stored @ share, "pressureMax": most, "halfWidth": half}


@pytest.mark.parametrize(
    "law, geometry, order",
    [("power", "strain", 2), ("exponential", "axisymmetric", 3), ("table", "stress", 3), ("table", "axisymmetric", 2)],
)
def test_on_the_contact_line(tmp_path, law, geometry, order):
    """A nearly rigid body: the law's own integrals; what the points miss of them is the error on the contact line."""
    flags = LAWS.get(law, ("-table", tmp_path / "pairs.csv"))
    (tmp_path / "pairs.csv").write_text("".join(f"{s / 200},{10 * (s / 200) ** 2!r}\n" for s in range(221)))
    more = "-h", 1, "-E", 1e9, "-u0", 1.2, "-order", order, "-geometry", geometry, "-law", law, "-estimate", 1
    found = run("disc-on-block", *more, *flags)
    exact = profile(law, geometry == "axisymmetric")
    for name, value in exact.items():
        said = found.estimates[name]
        assert abs(said["value"] - value) <= said["error"], name
        assert said["value"] == pytest.approx(value, rel=0.05 if name == "pressureMax" else 0.01), name
    parts = found.estimates["parts"]
    assert parts["line"] == pytest.approx(2 * abs(found.force - exact["force"]), rel=0.15)
    assert found.estimates["force"]["error"] == pytest.approx(parts["line"], rel=1e-3)


@pytest.mark.parametrize("state", ["stress", "axisymmetric", "space"])
def test_column(tmp_path, state):
    """A column under its own weight, of elements that are exact: stresses grow with the depth, along any line."""
    space, weight, height = state == "space", 0.7, 1 if state == "space" else 2
    matrix = turn_in_space(5) if space else UNTURNED
    down, where = np.eye(3)[2 if space else 1], 3 if space else 2

    def v(values):
        return vector(values, matrix, where)

    case = "" if space else f"state {state}\n"
    case += f"body block E {E} nu 0\nobstacle bottom plane {v([0, 0, 0])} {v(down)}\nweight block {v(-weight * down)}\n"
    case += f"line a {v([0.4, 0.1, 0.1])} {v([1.7, 0.9, 0.9])}\n"
    mesh = cube(Mesh(), cells=(2, 2, 2)) if space else block(Mesh())
    part(tmp_path, mesh.text(matrix), case, "-order", 2, "-tol", 1e-10, "-estimate", 0, space=space)
    rows = line_of(tmp_path)
    depth = height - np.array([rows[name] for name in "xyz"[:where]]).T @ (matrix @ down)[:where]
    for name, (a, b) in zip(TENSOR, PLACES, strict=True):
        if name in rows.dtype.names:
            stress = -weight * depth * (matrix @ down)[a] * (matrix @ down)[b]
            assert rows[name] == pytest.approx(stress, abs=1e-6), name
    assert rows["vonMises"] == pytest.approx(weight * depth, abs=1e-6)
    assert rows["stress3"] == pytest.approx(-weight * depth, abs=1e-6)
    assert abs(rows["stress1"]).max() < 1e-6


@pytest.mark.parametrize("state", ["strain", "axisymmetric"])
def test_inside_the_bodies(tmp_path, state):
    """A column under its own weight: what elements miss of a quadratic displacement, twice, and nothing else."""
    layers, height, weight = 8, 2, 0.7
    case = f"state {state}\nbody block E {E} nu 0\nobstacle bottom plane 0 0 0 1\nweight block 0 {-weight}\n"
    case += "symmetry left\n" * (state == "strain")
    found = part(tmp_path, block(Mesh(), cells=(8, layers)).text(), case, "-order", 1, "-tol", 1e-10)
    estimates, area = found.estimates, 3 if state == "strain" else 9 * np.pi
    way, energy = estimates["loads"][0]["way"], estimates["energy"]
    for said, exact in (way, weight * height**2 / (3 * E)), (energy, -(weight**2) * height**3 / (6 * E) * area):
        assert said["value"] == pytest.approx(exact, rel=4e-3)
        assert said["error"] == pytest.approx(2 * abs(said["value"] - exact), rel=0.15)
    for said in estimates["contacts"][0], estimates:
        assert abs(said["pressureMax"]["value"] - weight * height) <= said["pressureMax"]["error"] < 0.05
    assert estimates["parts"]["inside"] == pytest.approx(way["error"], rel=0.01)
    assert estimates["contacts"][0]["force"]["error"] < 1e-9 * found.force


OPINIONS = {
    "disc-on-block": ("-h", 1),
    "disc-on-block axisymmetric": ("-h", 1, "-geometry", "axisymmetric", "-force", 150),
    "disc-on-block stress": ("-h", 1, "-geometry", "stress", "-law", "exponential"),
    "two-cylinders": ("-h", 0.1, "-grading", 10),
    "wavy": (),
    "sphere-on-block": ("-h", 2),
}

SLOW = "two-cylinders", "wavy"


@pytest.mark.parametrize("name", cases_of([name for name in OPINIONS if name not in SLOW], SLOW))
def test_one_order_more(name):
    """On the same mesh elements of one order more give other numbers: within both errors, which are not far more."""
    scene = name.split()[0]
    orders = (1, 2) if scene == "sphere-on-block" else (2, 3)
    low, high = (run(scene, *OPINIONS[name], "-estimate", 1, "-order", order) for order in orders)
    ratios = []
    for quantity in ("force", "approach", "pressureMax", "halfWidth", "energy"):
        one, other = low.estimates.get(quantity), high.estimates.get(quantity)
        if one and other and one["error"] and one["error"] > 0:
            apart = abs(one["value"] - other["value"])
            assert apart <= one["error"] + other["error"], quantity
            ratios.append(one["error"] / (2 * apart))
    assert len(ratios) >= 3 and 0.8 < np.median(ratios) < 5


@pytest.mark.parametrize("flags, name", [((), "force"), (("-force", 150), "approach")])
def test_true_distance_to_its_tolerance(flags, name):
    """A tighter tolerance moves a run with the true distance by no more than a millionth; what is said has its size."""
    flags = ("-h", 1, "-distance", "exact", *flags, "-estimate", 1)
    loose, tight = (run("disc-on-block", *flags, "-tol", tol) for tol in (1e-8, 1e-12))
    for other in ("force", "pressureMax", "approach", "energy"):
        assert loose.summary[other] == pytest.approx(tight.summary[other], rel=1e-6), other
    assert loose.rounds < tight.rounds
    off = abs(loose.summary[name] - tight.summary[name])
    if name == "approach":  # parts are forces
        off *= loose.estimates["contactStiffness"]
    assert off <= loose.estimates["parts"]["algebra"] <= 1e-6 * loose.force
