"""Reference solutions by another code: tests/data/references.csv and the pressure profiles beside it, read.

tests/data/README.md says how they were computed, and what their columns are.
"""

import csv
import functools
from pathlib import Path

import campaign
import numpy as np
from numpy.polynomial.chebyshev import Chebyshev

DATA = Path(__file__).resolve().parents[1] / "data"
ERRORS = {"forceError": "force", "pressureMaxError": "pressureMax", "halfWidthError": "halfWidth"}
COLUMNS = [*ERRORS, "profileError"]


@functools.cache
def values(path: Path = DATA / "references.csv") -> dict[tuple[str, float, float], dict[str, float]]:
    """(scene, kappa, m) to quantity to value; kappa infinite: hard contact."""
    found: dict = {}
    with path.open() as file:
        for row in csv.DictReader(file):
            key = row["scene"], float(row["kappa"]), float(row["m"])
            found.setdefault(key, {})[row["quantity"]] = float(row["value"])
    return found


@functools.cache
def differences(path: Path = DATA / "references.csv") -> dict[tuple[str, float, float], float]:
    """(scene, kappa, m) to what is known of the force's own error: the relative difference of its two solutions."""
    with path.open() as file:
        rows = [row for row in csv.DictReader(file) if row["quantity"] == "force"]
    return {(row["scene"], float(row["kappa"]), float(row["m"])): float(row["difference"]) for row in rows}


def name_of(kappa: float, m: float) -> str:
    """The name of a law in the files' names: k1e9-m3, or hard."""
    mantissa, exponent = f"{kappa:e}".split("e") if np.isfinite(kappa) else ("", "")
    return f"k{float(mantissa):g}e{int(exponent)}-m{m:g}" if exponent else "hard"


@functools.cache
def profile(kappa: float, m: float) -> tuple[np.ndarray, np.ndarray] | None:
    """(pieces, nodes) abscissae from the middle to the edge of contact, and pressures; None where there is no file."""
    path = DATA / f"profile-{name_of(kappa, m)}.csv"
    if not path.exists():
        return None
    x, p = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    ends = np.flatnonzero(np.diff(x) == 0) + 1  # the end of one piece is the beginning of the next
    return np.array(np.split(x, ends)), np.array(np.split(p, ends))


def expected_pressure(pieces: tuple[np.ndarray, np.ndarray], at: np.ndarray) -> np.ndarray:
    """A profile's pressure at these abscissae, by each piece's own polynomial; 0 beyond the edge."""
    found = np.zeros_like(at)
    for x, p in zip(*pieces, strict=True):
        inside = (np.abs(at) >= x[0]) & (np.abs(at) <= x[-1])
        if inside.any():
            found[inside] = Chebyshev.fit(x, p, len(x) - 1)(np.abs(at[inside]))
    return found


def profile_error(kappa: float, m: float, contact: dict[str, np.ndarray]) -> float | None:
    """Relative difference (weighted L2) of a run's pressures to the profile; contact: columns x, pressure, weight."""
    pieces = profile(kappa, m)
    if pieces is None:
        return None
    expected = expected_pressure(pieces, contact["x"])
    root = np.sqrt(contact["weight"])
    return float(np.linalg.norm(root * (contact["pressure"] - expected)) / np.linalg.norm(root * expected))


def errors(*_) -> campaign.Measure:
    """COLUMNS of a run, relative differences to the reference: the plane's profile in L2, the others as they are."""

    def measure(item: campaign.Case, summary: dict, folder: Path) -> dict:
        kappa, m = (float(item.parameters[name]) for name in ("kappa", "m"))
        return compared(summary, summary["scene"], kappa, m, folder)

    return measure


def compared(summary: dict, scene: str, kappa: float, m: float, folder: Path) -> dict:
    """COLUMNS of a run of this problem."""
    known = values()[scene, kappa, m]
    found = {}
    for column, name in ERRORS.items():
        if name in known and summary.get(name) is not None:
            found[column] = abs(summary[name] / known[name] - 1)
    if scene == "disc-on-block":
        found["profileError"] = profile_error(kappa, m, campaign.read_contact(folder))
    return found
