"""tests/VERIFICATION.md: published problems give the numbers of the page, and the reasons of those that differ hold."""

import re

import numpy as np
import pytest
import verification
from freefem import FREEFEM, ROOT, execute

CASES, TEXT = verification.cases(), verification.PAGE.read_text()
SHORT = [name for name, case in CASES.items() if not case.get("long")]
LONG = [name for name in CASES if name not in SHORT]


def told(name):
    """[(value, error, verdict)] of the rows of a case on the page."""
    rows = re.findall(rf"^\| `{name}` \| .* \| .* \| (\S+)(?: ± (\S+))? \| \S+ % \| (.*) \|$", TEXT, re.M)
    return [(float(value.replace("−", "-")), float(error) if error else None, words) for value, error, words in rows]


@pytest.mark.parametrize("name", [*SHORT, *LONG])
def test_case(name):
    """A fresh run gives the values, errors and verdicts of the page, to its digits; what differs has its reason."""
    found = verification.solve(name, CASES[name])
    for number, (value, error), (old, old_error, words) in zip(CASES[name]["number"], found, told(name), strict=True):
        verdict = verification.verdict(number, value, error)
        assert words == ("explained below" if verdict == "differs" else verdict)
        assert (verdict == "differs") == ("reason" in number)
        digit = 0.05 * (old_error or 0) if old_error else 5e-5 * abs(old)  # half of the last one, at most
        assert abs(value - old) <= 1e-5 * abs(old) + 0.01 * (old_error or 0) + digit
        assert (error is None) == (old_error is None)
        assert error is None or error == pytest.approx(old_error, rel=0.1)


def test_page():
    """The page has what `make verification` would write for its numbers, but for the column `off` of exact values."""
    numbers = {name: [(value, error) for value, error, _ in told(name)] for name in CASES}
    written, page = (re.sub(r"\| \S+ % \|", "|", text) for text in (verification.page(numbers), TEXT))
    assert written in page
    assert sum(case["model"] == "space" for case in CASES.values()) >= 3 and len(CASES) >= 14


@pytest.mark.parametrize(
    "value, error, tolerance, words",
    [
        (101, 1.5, 0, "inside ±"),
        (99, 1.5, 0, "inside ±"),
        (-100, 1.5, 0.01, "differs"),
        (104, 1.5, 0.05, "inside the tolerance"),
        (104, None, 0.05, "inside the tolerance"),
        (106, 1.5, 0.05, "differs"),
        (106, None, 0, "differs"),
    ],
)
def test_verdict(value, error, tolerance, words):
    assert verification.verdict({"published": 100, "tolerance": tolerance}, value, error) == words


# ---------------------------------------------------------------- reasons


def test_large_strains_in_cb1():
    """Large strains move the block of CB1 4 % further; the linear displacement is that of the run with contact."""
    code, stdout = execute([*FREEFEM, "tests/verification/cb1/finite-strain.edp"], cwd=ROOT)
    linear, *_, large = map(float, stdout.split())
    assert code == 0 and large / linear == pytest.approx(1.04, abs=0.001)
    (*_, (value, error, _)), published = told("cb1"), CASES["cb1"]["number"][-1]["published"]
    assert abs(linear - value) <= error
    assert large < published < linear


def test_hertz_by_the_force_of_two_spheres():
    """The pressure of SSNV104 is that of Hertz for the force of the run, to 0.3 %."""
    case = CASES["ssnv104"]
    (force, _), (pressure, _) = verification.solve(
        "ssnv104", {**case, "number": [{"found": "estimates.force"}, *case["number"]]}
    )
    modulus, radius = 20e3 / (1 - 0.3**2) / 2, 25
    hertz = (6 * force * modulus**2 / (np.pi**3 * radius**2)) ** (1 / 3)
    assert pressure == pytest.approx(hertz, rel=0.003)
    assert case["number"][0]["published"] == pytest.approx(2 * modulus / np.pi * np.sqrt(2 * 4 / 50), abs=0.05)


def test_stiffness_of_the_plate_in_ssna102():
    """Displacement over force, of this run, of code_aster's own run, and of the published means."""
    (force, *_), (way, *_) = told("ssna102")
    own = 0.841259653998 / 17496.6104063
    assert abs(-way / force / own - 1) < 0.0065
    published = [abs(number["published"]) for number in CASES["ssna102"]["number"]]
    assert published[1] / published[0] / (-way / force) - 1 == pytest.approx(-0.028, abs=5e-4)
