"""The linear law: an elastic foundation (Winkler) below a beam, and below a rigid plate that lifts off."""

import json

import numpy as np
import pytest
from freefem import data, part, table
from reader import Group, Refusal, Where, read_case

BEAM = data("foundation/beam.geo")
FOUNDATION = "obstacle sole plane 0 0 0 1 law linear k 0.5\n"
PLATE = "state strain\nbody beam E 1e8 nu 0.3\npressure top 1\n"


def under_a_layer(x, young, poisson, k, depth, length, loaded, load, count=150):
    """Pressures at x below an elastic layer on a foundation k, mirrored at 0 and length, its top loaded up to `loaded`.

    A cosine of the load has the stress function f(y) cos(a x), f = (A + C y) e^(a (y - depth)) + (B + D y) e^(-a y)."""
    shear, plane, ratio = young / 2 / (1 + poisson), young / (1 - poisson**2), poisson / (1 - poisson)
    found = np.full_like(x, load * loaded / length)
    for n in range(1, count):
        a, y = n * np.pi / length, np.array([0.0, depth])
        up, down = np.exp(a * (y - depth)), np.exp(-a * y)
        f = np.array([up, down, y * up, y * down])
        slope = np.array([a * up, -a * down, (1 + a * y) * up, (1 - a * y) * down])
        third = np.array([a**3 * up, -(a**3) * down, (3 * a**2 + a**3 * y) * up, (3 * a**2 - a**3 * y) * down])
        rise = ((third + ratio * a**2 * slope) / (a * plane) - a * slope / shear) / a
        rows = np.array([slope[:, 0], a**2 * f[:, 0] + k * rise[:, 0], slope[:, 1], a**2 * f[:, 1]])
        scale = 1 / np.abs(rows).max(0)
        right = [0, 0, 0, 2 * load / (n * np.pi) * np.sin(a * loaded)]
        found += a**2 * (f[:, 0] @ (scale * np.linalg.solve(rows * scale, right))) * np.cos(a * x)
    return found


def solved(folder, case, *flags):
    screen = part(folder, BEAM, case, *flags).stdout
    assert ("greatest displacement along gravity\n    beam " in screen) == ("gravity" in case)
    return json.loads((folder / "out/summary.json").read_text()), table(folder / "out/contact.csv")


def test_beam(tmp_path):
    """A beam on a foundation shall have the pressures of its Fourier series, and no word on passing mean planes."""
    case = f"state strain\nbody beam E 200e3 nu 0.3\n{FOUNDATION}symmetry left\nsymmetry right\npressure top 1\n"
    summary, points = solved(tmp_path, case)
    expected = under_a_layer(points["x"], 200e3, 0.3, 0.5, 4.0, 120.0, 20.0, 1.0)
    np.testing.assert_allclose(points["pressure"], expected, atol=4e-5 * expected.max())
    np.testing.assert_allclose(points["pressure"], 0.5 * points["overlap"], atol=1e-6)
    assert summary["contacts"][0]["law"] == "linear" and not summary["warnings"]


def test_rigid_plate_lifts_off(tmp_path):
    """A rigid plate loaded on half its top shall have a triangle of pressures on 3/4 of its length."""
    summary, points = solved(tmp_path, PLATE + FOUNDATION, "-set", "length", 40, "-set", "depth", 10)
    np.testing.assert_allclose(points["pressure"], np.maximum(4 / 3 * (1 - points["x"] / 30), 0), atol=2e-4)
    assert summary["contacts"][0]["contactLength"] == pytest.approx(30, abs=0.5)
    assert summary["contacts"][0]["normalForce"] == pytest.approx(20, rel=1e-6)


def test_interference(tmp_path):
    """A plate that is held shall compress the foundation by the interference and its motion; the law counts from 0."""
    case = PLATE.replace("pressure top 1", "move top 0 -0.2") + FOUNDATION.replace("law", "interference 0.1 law")
    summary, points = solved(tmp_path, case, "-set", "length", 40, "-set", "part", 39, "-set", "depth", 1)
    np.testing.assert_allclose(points["pressure"], 0.15, rtol=1e-4)
    assert summary["contacts"][0]["normalForce"] == pytest.approx(0.15 * 40, rel=1e-4)


def test_refusals():
    """A linear law shall take k alone, above 0."""
    groups = [*(Group(1, name) for name in ("sole", "top")), Group(2, "beam")]
    words_told = {"kappa 5": "not a parameter of the law linear; allowed: k", "k 0": "above 0", "": "k is missing"}
    for words, told in words_told.items():
        with pytest.raises(Refusal) as refused:
            read_case(PLATE + FOUNDATION.replace("k 0.5", words), Where(), groups)
        assert told in refused.value.text("a.case")


def test_gravity(tmp_path):
    """A column on a foundation shall sink by its weight and its own compression; the place and the error are given."""
    case = f"state strain\nbody beam E 50 nu 0 density 2\n{FOUNDATION}symmetry left\nsymmetry right\ngravity 0 -0.01\n"
    summary, _ = solved(tmp_path, case, "-set", "length", 10, "-set", "part", 5)
    (found,) = summary["deflections"]
    sunk = 0.02 * 4 / 0.5 + 0.02 * 4**2 / (2 * 50)
    assert found["body"] == "beam" and found["at"][1] == 4
    assert abs(found["value"] - sunk) <= found["error"] < 1e-5 * sunk
