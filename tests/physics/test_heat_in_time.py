"""Heat in time: a slab against its Fourier series, a fit that warms up, a body that only stores its heat."""

import json
from math import cos, exp, pi

import pytest
from freefem import data, part, table
from reader import Group, Refusal, Where, read_case

from .test_heat import FIT, TUBE, exact_fit, solve

SLAB = data("heat/slab.geo")
APART = """body slab E 100 nu 0.3
body base E 100 nu 0.3
conduct slab 2 capacity 3 start 1
conduct base 2 capacity 3
contact face foot
clamp bottom
clamp top
"""
HEATED = f"""state axisymmetric
{FIT}conduct shaft 0.05 capacity 3.6e-3 expand 12e-6 from 20
conduct ring 0.2 capacity 2.4e-3 start 20 expand 23e-6 from 140
contact seat journal conductance 0.01 hardness 100
symmetry floor
symmetry roof
temperature bore 20
temperature outside 60
"""


def cooled(x, time, length=10, diffusivity=2 / 3):
    """The temperature of a slab at 1 that is at 0 on one side from the time 0 on, at x from its other side."""
    ways = [(2 * n + 1) * pi / (2 * length) for n in range(40)]
    return sum(
        2 * (-1) ** n / (a * length) * cos(a * x) * exp(-(a**2) * diffusivity * time) for n, a in enumerate(ways)
    )


@pytest.mark.parametrize("scheme, order", [("euler", 1), ("bdf2", 2)])
def test_slab(tmp_path, scheme, order):
    """A slab that is cooled on one side shall follow its Fourier series with the order of the scheme."""
    errors = []
    for steps in (20, 40):
        case = f"{APART}temperature right 0\ntime 75 steps {steps} scheme {scheme}\n"
        part(tmp_path, SLAB, case, "-set", "n", 6)
        rows = table(tmp_path / "out/series.csv")
        assert len(rows["time"]) == steps + 1 and rows["time"][-1] == 75
        errors.append(rows["slab greatest temperature"][-1] - cooled(0, 75))
    assert errors[0] / errors[1] == pytest.approx(2**order, rel=0.05)
    assert abs(errors[1]) < (8e-3 if order == 1 else 1.3e-4)


def test_stored_heat(tmp_path):
    """A body that only makes heat shall store it: its temperature grows evenly, and no other one changes."""
    part(tmp_path, SLAB, f"{APART}source slab 0.6\ntime 5 steps 3\n", "-set", "n", 4)
    summary = json.loads((tmp_path / "out/summary.json").read_text())
    bodies = {body["name"]: (body["least"], body["greatest"]) for body in summary["heat"]["bodies"]}
    assert bodies == {"slab": pytest.approx((2, 2), rel=1e-12), "base": pytest.approx((0, 0), abs=1e-12)}
    assert summary["heat"]["stored"] == pytest.approx(0.6 * 20, rel=1e-10) and summary["time"] == 5


def test_pair_that_evens_out(tmp_path):
    """Two insulated bars at unlike temperatures shall end at the mean of their heat, with no heat in and none out."""
    case = """state stress
body steel E 210e3 nu 0
body alu E 70e3 nu 0
conduct steel 0.05 capacity 3.6e-3 start 20
conduct alu 0.2 capacity 2.4e-3 start 200
contact down up conductance 100
clamp cold
force hot 0 -20
time 200 steps 40
"""
    heat = solve(tmp_path, data("heat/pair.geo"), case)["heat"]
    mean = (3.6 * 20 + 2.4 * 200) / (3.6 + 2.4)
    ends = [end for body in heat["bodies"] for end in (body["least"], body["greatest"])]
    assert ends == pytest.approx(4 * [mean], rel=1e-4)
    assert abs(heat["in"]) + abs(heat["out"]) < 1e-9


def test_fit_that_warms_up(tmp_path):
    """A fit whose ring is heated shall go from its cold force to that of steady heat, and store the rest."""
    steady = solve(tmp_path / "long", TUBE, f"{HEATED}time 1e5 steps 3\n", "-set", "edges", 4)
    pressure, heat, _ = exact_fit(60)
    assert steady["contacts"][0]["normalForce"] == pytest.approx(pressure * 2 * pi * 25 * 12, rel=1e-5)
    assert steady["heat"]["contacts"][0]["heat"] == pytest.approx(12 * heat, rel=1e-5)
    warm = solve(tmp_path / "short", TUBE, f"{HEATED}time 5 steps 8\n", "-tol", 1e-9, "-set", "edges", 3)
    rows = table(tmp_path / "short/out/series.csv")
    force = rows["seat journal normal force"]
    assert warm["heat"]["in"] == pytest.approx(warm["heat"]["out"] + warm["heat"]["stored"], rel=1e-9)
    assert force[0] == pytest.approx(200600, rel=1e-3) and force[-1] == pytest.approx(148672, rel=2e-3)
    assert (force[1:7] > force[2:8]).all() and (
        rows["ring least temperature"][1:] > rows["ring least temperature"][:-1]
    ).all()


def test_refusals():
    """Time needs a heat capacity of each body, and a number of steps."""
    groups = [*(Group(1, name) for name in ("face", "foot", "bottom", "top", "right"))]
    groups += [Group(2, "slab"), Group(2, "base")]
    for old, new, told in (
        (" capacity 3\n", "\n", "time: base has no heat capacity; allowed: conduct base k capacity C"),
        ("steps 4", "", "steps is missing"),
        ("conduct slab 2 capacity 3 start 1\nconduct base 2 capacity 3\n", "", "no body conducts"),
    ):
        with pytest.raises(Refusal) as refused:
            read_case(f"{APART}time 5 steps 4\n".replace(old, new), Where(), groups)
        assert told in refused.value.text("a.case")
    read_case(f"{APART}time 5 steps 4\n", Where(), groups)
