"""Heat sources in bodies: bars in series, and curved elements, against closed forms."""

from math import pi

import pytest
from freefem import data

from .test_heat import BARS, CONTACT, HELD, SOFT, balanced, confined, solve, through

APART = "body slab E 100 nu 0.3\nbody base E 100 nu 0.3\nconduct slab 2\nconduct base 2\ncontact top rim\n"
WARM = "clamp bottom\nclamp rim\nsource slab 3\nfilm rim 2 5\ntemperature bottom 0\n"


def test_bars_with_a_source(tmp_path):
    """A source in one of two bars in series leaves through both of its ends."""
    case = f"{SOFT}source lower 0.002\n{CONTACT}\n{HELD}move top 0 -1\ntemperature top 1\n"
    heat = solve(tmp_path, BARS, case, "-set", "n", 4)["heat"]
    flow = (1 - 0.002 * 20**2 / 2) / (20 + 5 + 1 / through(confined(100, 0.3)[0] / 30))
    groups = {group["name"]: group["heat"] for group in heat["groups"]}
    assert groups["source lower"] == pytest.approx(0.002 * 400, rel=1e-12)
    assert groups["temperature top"] == pytest.approx(20 * flow, rel=1e-6)
    assert heat["contacts"][0]["heat"] == pytest.approx(-20 * flow, rel=1e-6)
    balanced(heat)


@pytest.mark.parametrize("space", [False, True])
def test_curved_source(tmp_path, space):
    """A disc and a ball that make heat: area or volume of the curved elements, temperatures on the axis and the rim."""
    mesh, case = data("heat/ball.geo" if space else "heat/disc.geo"), APART + WARM
    heat = solve(tmp_path, mesh, case, *([] if space else ["-order", 4]), space=space)["heat"]
    groups = {group["name"]: group["heat"] for group in heat["groups"]}
    size, ways = (4 / 3 * pi * 1000, 3) if space else (pi * 100, 2)
    (slab,) = (body for body in heat["bodies"] if body["name"] == "slab")
    assert groups["source slab"] == pytest.approx(3 * size, rel=4e-3 if space else 1e-4)
    assert slab["least"] == pytest.approx(5 + 30 / ways / 2, rel=0.1 if space else 1e-3)
    assert slab["greatest"] == pytest.approx(5 + 30 / ways / 2 + 300 / (4 * ways), rel=0.05 if space else 5e-3)
    balanced(heat)
