"""What a run should have given: independent or exact values, and how far from them it may be."""

from dataclasses import dataclass

from postprocess.results import Run, is_number

# The paper's test by (kappa, m): NGSolve 6.2, P4, refined to h = 0.0125 (tests/data/README.md).
PAPER = {
    (1e3, 3.0): {"force": 150.02947, "pressureMax": 22.559747, "halfWidth": 4.927623},
    (1e3, 10.0): {"force": 114.04577, "pressureMax": 19.478949, "halfWidth": 5.464573},
}
PAPER_TEST = {
    **{"E": 100, "nu": 0.3, "width": 40, "depth": 20, "R": 10, "gap": 0.5, "u0": 2.5, "d0": -0.25},
    **{"law": "power", "geometry": "strain", "distance": "linear", "offset": 0, "force": 0, "reach": 0},
    **{"bodyForce": 0, "traction": 0, "Eratio": 1e6, "history": 0},
}
SCENES = ("disc-on-block", "disc-on-block-ipopt", "meshed-disc")
NAMES = {
    "force": "force",
    "pressureMax": "greatest pressure",
    "halfWidth": "half-width",
    "overlapMax": "greatest overlap",
}
LEAST_POINTS = 5  # points in contact below which a comparison means nothing


@dataclass(frozen=True)
class Check:
    """One value of a run beside its reference; difference and allowed are relative."""

    name: str
    value: float
    reference: float
    allowed: float
    source: str

    @property
    def difference(self) -> float:
        return self.value / self.reference - 1

    @property
    def passed(self) -> bool:
        return abs(self.difference) <= self.allowed


def checks(run: Run) -> list[Check]:
    """The comparisons that make sense for a run; none where no reference is known or the run did not converge."""
    summary = run.summary
    if not summary["converged"] or not is_number(summary["h"]) or not summary["h"] > 0:
        return []
    expected, source = paper_test(run), "paper's test"
    if not expected:
        expected, source = confined_block(run), "exact"
    return [
        Check(NAMES[name], float(summary[name]), reference, allowed(run, name, source), source)
        for name, reference in expected.items()
        if is_number(summary[name]) and reference > 0
    ]


def paper_test(run: Run) -> dict[str, float]:
    """The reference values, when every parameter is that of the paper's test and enough points are in contact."""
    summary, parameters = run.summary, run.summary["parameters"]
    if summary["scene"] not in SCENES or summary["method"] == "signorini" or summary["contactPoints"] < LEAST_POINTS:
        return {}
    if any(not equal(parameters[name], value) for name, value in PAPER_TEST.items() if name in parameters):
        return {}
    law = parameters.get("kappa"), parameters.get("m")
    return PAPER.get(tuple(map(float, law)), {}) if all(map(is_number, law)) else {}


def confined_block(run: Run) -> dict[str, float]:
    """The one-dimensional state of a laterally confined block under a flat wall: a root, found by bisection."""
    summary, parameters = run.summary, run.summary["parameters"]
    names = "E nu width depth gap u0 d0 kappa m".split()
    if summary["scene"] != "confined-block" or not all(is_number(parameters.get(name)) for name in names):
        return {}
    law = "signorini" if summary["method"] == "signorini" else parameters.get("law", "power")
    young, nu, width, depth, gap, u0, d0, kappa, m = (float(parameters[name]) for name in names)
    if law not in ("power", "signorini") or u0 - gap <= d0 or not -1 < nu < 0.5 or not depth > 0:
        return {}
    modulus = young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    low, high = d0, u0 - gap
    if law == "signorini":
        high = d0
    for _ in range(200):
        middle = 0.5 * (low + high)
        try:
            below = kappa * (middle - d0) ** m < modulus * (u0 - gap - middle) / depth
        except OverflowError:
            below = False
        low, high = (middle, high) if below else (low, middle)
    pressure = modulus * (u0 - gap - high) / depth
    return {"force": pressure * width, "pressureMax": pressure}


def allowed(run: Run, name: str, source: str) -> float:
    """The relative difference that the mesh and the tolerances of a run explain.

    The paper's test: force and pressure 0.1 h^1.5 for P1 and 0.0025 h for P2, half-width 0.05 h.
    """
    tolerance = run.summary["parameters"].get("tol")
    tolerance = 10 * float(tolerance) if is_number(tolerance) else 1e-5
    if source == "exact":
        return tolerance
    h = float(run.summary["h"])
    by_mesh = 0.05 * h if name == "halfWidth" else (0.1 * h**1.5 if run.summary["order"] == 1 else 0.0025 * h)
    return by_mesh + tolerance


def equal(value: object, wanted: object) -> bool:
    if is_number(wanted):
        return is_number(value) and abs(float(value) - wanted) <= 1e-12 * abs(wanted)
    return value == wanted
