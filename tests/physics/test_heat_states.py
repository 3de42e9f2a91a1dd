"""Heat through gaps, and bodies that only a gap cools: closed forms of bars and of a pellet in a can, two states."""

from math import log, pi

import pytest
from freefem import data
from reader import Group, Refusal, Where, read_case

from .test_heat import BARS, HELD, SOFT, UNLIKE, balanced, confined, solve

PELLET = data("heat/pellet.geo")
CASE = """state axisymmetric
body pellet E 200e3 nu 0.316
body can E 75e3 nu 0.33
conduct pellet 0.003 expand 10e-6 from 20
conduct can 0.0165 expand 6.5e-6 from 20
contact lining skin conductance {law}
symmetry low
symmetry high
flux bore 3
film wet 0.03 300
"""
INNER, OUTER, WALL, GAP = 1, 4.1, 4.75, 0.02


def strained(young, poisson, expansion):
    """Constants of plane strain as those of plane stress."""
    return young / (1 - poisson**2), poisson / (1 - poisson), expansion * (1 + poisson)


def root(function, low, high):
    """Where a function that decreases is 0."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) > 0 else (low, middle)
    return 0.5 * (low + high)


def mean_warmth(low, high, outside, drop):
    """Twice the mean of r (T - 20) between two radii, T = outside + drop log(high/r), by the squares of the radii."""
    ring = high**2 - low**2
    return (outside - 20) + drop * (0.5 - low**2 / ring * log(high / low))


def pellet_state(conductance, low, high, rate=3.0):
    """Pressure on the can, or minus the gap, and temperature of the skin; conductance: of this state."""
    (pellet, across, grows), (can, beside, widens) = strained(200e3, 0.316, 10e-6), strained(75e3, 0.33, 6.5e-6)
    bore, flow = OUTER + GAP, rate * INNER
    outside = 300 + flow / (0.03 * WALL)
    lining = outside + flow / 0.0165 * log(WALL / bore)

    def skin(state):
        return lining + flow / (bore * conductance(state))

    def excess(state):
        pressure = max(state, 0)
        pushed = pressure * bore / pellet * ((OUTER**2 + INNER**2) / (OUTER**2 - INNER**2) - across)
        opened = pressure * bore / can * ((WALL**2 + bore**2) / (WALL**2 - bore**2) + beside)
        pellet_moves = OUTER * grows * mean_warmth(INNER, OUTER, skin(state), flow / 0.003) - pushed
        can_moves = bore * widens * mean_warmth(bore, WALL, outside, flow / 0.0165) + opened
        return pellet_moves - can_moves - GAP - min(state, 0)

    found = root(excess, low, high)
    return found, skin(found)


def states(summary):
    return [text for text in summary["warnings"] if "two steady states" in text]


@pytest.mark.parametrize("gas", ["", " gap 3e-4 layer 0.01"])
def test_pellet(tmp_path, gas):
    """A pellet that only its gap cools closes it, from the free expansion on: the state of Lamé and Fourier."""
    found = solve(tmp_path, PELLET, CASE.format(law="0.02 hardness 1000" + gas), "-tol", 1e-9, "-set", "hs", 0.2)
    by_gas = 0.03 if gas else 0
    pressure, skin = pellet_state(lambda p: 0.02 * (p / 1000) ** 0.95 + by_gas, 1e-9, 1e4)
    assert found["contacts"][0]["normalForce"] / (2 * pi * (OUTER + GAP) * 2) == pytest.approx(pressure, rel=1e-5)
    (pellet,) = (body for body in found["heat"]["bodies"] if body["name"] == "pellet")
    assert pellet["least"] == pytest.approx(skin, rel=2e-5)
    assert not states(found)
    balanced(found["heat"])


STEEP = [
    ("pellet 0.003 expand 10e-6", "pellet 0.0114 expand 3e-6"),
    ("can 0.0165 expand 6.5e-6", "can 0.0083 expand 0"),
    ("flux bore 3", "flux bore 0.12"),
    ("film wet 0.03 300", "film wet 0.0192 245"),
]


def test_steep_conductance(tmp_path):
    """Where small pressures change the temperatures much, the iteration shall still end, by mixing its trials."""
    case = CASE.format(law="0.135 hardness 148")
    for old, new in STEEP:
        case = case.replace(old, new)
    found = solve(tmp_path, PELLET, case, "-set", "hs", 0.3, "-set", "gap", 0.005)
    conductance = found["heat"]["contacts"][0]["conductance"]
    pressure = found["contacts"][0]["normalForce"] / (2 * pi * 4.105 * 2)
    assert found["heat"]["rounds"] < 60 and conductance == pytest.approx(0.135 * (pressure / 148) ** 0.95, rel=1e-4)
    assert pressure == pytest.approx(0.2847, rel=0.05)
    balanced(found["heat"])


def test_pellet_stays_open(tmp_path):
    """A gas that conducts well keeps the pellet cold and its gap open."""
    case = CASE.format(law="0.5 gap 3e-3").replace("flux bore 3", "flux bore 0.3")
    found = solve(tmp_path, PELLET, case, "-tol", 1e-9, "-set", "hs", 0.2)
    gap, skin = pellet_state(lambda y: 1 / (1 / 0.5 - y / 3e-3), -1, 0, rate=0.3)
    assert gap < -1e-3 and found["contacts"][0]["normalForce"] == 0
    (pellet,) = (body for body in found["heat"]["bodies"] if body["name"] == "pellet")
    assert pellet["least"] == pytest.approx(skin, rel=1e-5)


def test_bars_through_a_gas(tmp_path):
    """Bars that do not touch conduct through the gas between them."""
    case = f"{SOFT}contact face foot conductance 0.5 gap 0.02\n{HELD}move top 0 0.1\ntemperature top 1\n"
    heat = solve(tmp_path, BARS, case, "-set", "n", 3)["heat"]
    conductance = 1 / (1 / 0.5 + 0.1 / 0.02)
    assert heat["contacts"][0]["conductance"] == pytest.approx(conductance, rel=1e-9)
    assert heat["in"] == pytest.approx(20 / (20 + 5 + 1 / conductance), rel=1e-8)
    balanced(heat)


def test_two_states(tmp_path):
    """A contact that heat closes may stay open too: the run takes the state without heat first, and names both."""
    warm = f"{UNLIKE}conduct lower 1 expand 1e-2\nconduct upper 2\ncontact face foot conductance 0.5\n"
    found = solve(tmp_path, BARS, f"{warm}{HELD}temperature top 1\nmove top 0 0.05\n", "-set", "n", 3)
    (said,) = states(found)
    (first, more), (second, _) = confined(100, 0.3), confined(200, 0.2)
    pressure = (more * 1e-2 * 20 * 10 / 27 - 0.05) / (20 / first + 10 / second)
    assert "this one, open at up to 1," in said and found["contacts"][0]["normalForce"] == 0
    other = float(said.partition("the other, with the greatest pressure ")[2].split()[0])
    assert other == pytest.approx(pressure, rel=1e-4)


def test_refusals():
    """A layer belongs to a hardness, and a hardness with a gas needs one."""
    names = "low high bore wet lining skin".split()
    groups = [*(Group(1, name) for name in names), Group(2, "pellet"), Group(2, "can")]
    for law in ("2 gap 3 layer 4", "2 hardness 3 gap 4"):
        with pytest.raises(Refusal) as refused:
            read_case(CASE.format(law=law), Where(), groups)
        assert "with a hardness a gap has a layer" in refused.value.text("a.case")
    read_case(CASE.format(law="2 hardness 3 gap 4 layer 5"), Where(), groups)
