"""campaigns/foreign.py: its verdicts, its parts, and long: a few of them, run as the campaign does."""

import campaign
import foreign
import numpy as np
import pytest
from foreign_parts import INFINITE, Draw, Part, parts
from freefem import ROOT

POLYGON = "boundaries out of contact are polygons: about 0.01 of a number, which no error contains"


def record(value, said, *warnings):
    """Of a run with two contacts and a load."""
    return {
        "numbers": {"contacts.0.force": [value, said], "loads.0.way": [value, said]},
        "warnings": list(warnings),
        "names": ["a b", "c d", "weight a"],
        "contacts": 2,
        "mesh": "",
        "flags": "",
    }


def verdict(value, said, truth, doubt, *warnings):
    """(covered, warned) of a contact's force."""
    part = Part("", lambda draw: "", "", {"contacts.0.force": (truth, doubt)})
    (row,) = foreign.judged(part, record(value, said, *warnings), {})
    return row["covered"], row["warned"]


def test_covered():
    assert verdict(100, 2, 101, 0) == (True, False)
    assert verdict(100, 2, 103, 0) == (False, False)
    assert verdict(100, 2, 103, 0.5) == (False, False)
    assert verdict(100, 2, 103, 1.5)[0] is None  # the truth's doubt decides
    assert verdict(100, 1e-11, 101, 0)[0] is False


def test_what_is_prescribed_is_not_judged():
    part = Part("", lambda draw: "", "", {"contacts.0.force": (100.0, 0.0)})
    assert foreign.judged(part, record(100, 1e-12), {}) == []


def test_warned_of():
    """With a cause and a size within ten times, of this number."""
    assert verdict(100, 0.1, 101, 0, POLYGON) == (False, True)
    assert verdict(100, 0.1, 120, 0, POLYGON) == (False, False)
    assert verdict(100, 0.1, 101, 0, "contact c d: the gap turns: about 0.01 of its force") == (False, False)
    assert verdict(100, 0.1, 101, 0, "contact a b: the gap turns: about 0.01 of its force") == (False, True)
    assert verdict(100, 0.1, 101, 0, "rotations are linearised: 1 %") == (False, True)
    assert verdict(100, 0.1, 101, 0, "about 0.01 of nothing that is known") == (False, False)
    assert foreign.warned("loads.0.way", 100, 1, record(100, 0, "weight a: shape, about 0.01 of its way"))[0]


def test_unbounded():
    """Of a pressure without bound the place is enough; an error is never right."""
    assert verdict(100, 10, *INFINITE) == (False, False)
    assert verdict(100, 10, *INFINITE, "a sharp edge at (1, 0): the pressure grows without bound") == (False, True)


def test_parts():
    """As many as wanted, each by its seed alone, other ones by another; kinds and closed forms among them."""
    all_of_them = parts()
    assert len(all_of_them) == len({part.name for part in all_of_them}) >= 40
    assert {foreign.kind_of(part) for part in all_of_them} == {"plane", "about an axis", "space"}
    assert sum(any(np.isfinite(value) for value, _ in part.known.values()) for part in all_of_them) >= 10
    assert [part.case for part in all_of_them] == [part.case for part in parts()]
    assert all(one.geo(Draw()) == other.geo(Draw()) for one, other in zip(all_of_them, parts(), strict=True))
    assert all(one.case != other.case for one, other in zip(all_of_them, parts(2), strict=True))


@pytest.mark.parametrize(
    ("name", "number", "truth", "most", "draw", "flags"),
    [
        # a rim of seven sides, one element from the contact: Lame
        ("twisted fit 4", "pressureMax", 3.1222, 0.2, Draw(), ""),
        ("twisted fit 2", "pressureMax", 28.318, 0.05, Draw(), ""),
        # at the true distance a slip turns round; a point that sticks would slip
        ("rubbed head 2", "force", 278.844, 1e-3, Draw(), ""),
        ("rubbed head 2", "force", 278.844, 1e-2, Draw(0.82, 2), ""),
        ("rubbed head 4", "pressureMax", 280.74, 0.2, Draw(0.81), "-order 4"),  # on three nodes of the master
        # normals turn: the balance does not tell all of the force
        ("head 2", "normalForce", 633.8704, 1e-3, Draw(), "-distance exact"),
    ],
)
def test_what_fell(name, number, truth, most, draw, flags):
    """Numbers of the campaign that were false, and said to be good."""
    (part,) = (part for part in parts() if part.name == name)
    found = foreign.solve(foreign.Job(part, draw, tuple(flags.split())), ROOT, campaign.Processes())
    value, error = found["numbers"][f"contacts.0.{number}"]
    assert abs(value - truth) < error < most * truth


def test_table():
    rows = [
        {"part": "a 1", "number": "energy", "covered": True, "warned": False, "warnings": ["w"], "error": 1.0},
        {"part": "a 1", "number": "energy", "covered": False, "warned": True, "warnings": ["w"], "error": 8.0},
        {"part": "a 1", "number": "energy", "covered": False, "warned": False, "warnings": [], "error": 8.0},
        {"part": "a 1", "number": "energy", "covered": None, "warned": False, "warnings": [], "error": 8.0},
    ]
    rows = [{**row, "said": 4.0, "doubt": 0.0, "value": 100.0} for row in rows]
    line = foreign.table(rows, {"a 1": "plane"}).splitlines()[2]
    assert line == "| all | 3 | 33.3 % | 66.7 % | 1 | 100.0 % | 0.5 | 3.3 |"


@pytest.mark.parametrize(
    "name",
    [
        *("press fit 1", "press fit 3", "lined tube 1", "heavy 4", "groove 1", "plank 2", "crack 2", "prism 4"),
    ],
)
def test_nothing_false(name):
    """An engineer's plain run: each number with a closed form is covered, or its error's size is said."""
    part = next(part for part in parts() if part.name == name)
    with campaign.frozen_sources(campaign.ROOT) as sources:
        told = foreign.solve(foreign.Job(part, Draw()), sources, campaign.Processes())
    assert told["code"] == 0
    rows = foreign.judged(part, told, {})
    assert rows or part.name.startswith("groove")  # where all that is known is right to rounding
    assert foreign.listing(rows) == ""
