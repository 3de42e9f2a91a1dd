"""What a run should have given: independent or exact values, and how far from them it may be."""

from dataclasses import dataclass

import numpy as np

from postprocess.results import ResultsError, Run, is_number

# The paper's test by (kappa, m): tests/data/references.csv, rounded (NGSolve 6.2; tests/data/README.md).
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
LINES = ("hertz-line", "two-cylinders")  # Hertz's scenes in the plane; about an axis their contact is a circle
CIRCLES = ("sphere-on-block", "sphere-on-plane", "two-spheres")
FORMLESS = ("history", "bodyForce", "traction")  # flags whose states have no closed form here
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
    if found := closed_forms(run):
        return found
    expected, source = paper_test(run), "paper's test"
    if not expected:
        expected, source = confined_block(run), "exact"
    return [
        Check(NAMES[name], float(summary[name]), reference, allowed(run, name, source), source)
        for name, reference in expected.items()
        if is_number(summary[name]) and reference > 0
    ]


def closed_forms(run: Run) -> list[Check]:
    """Hard contact under a force beside its closed form on a half-space; none where it has none."""
    summary, parameters = run.summary, run.summary["parameters"]
    hard = "signorini" in (summary["method"], parameters.get("law"))
    if not hard or not is_number(parameters.get("force")) or not parameters["force"] > 0:
        return []
    if summary["contactPoints"] < LEAST_POINTS or any(parameters.get(name) for name in FORMLESS):
        return []
    scene = summary["scene"]
    if scene in (*LINES, *CIRCLES) or (scene == "disc-on-block" and about_axis(run)):
        return compare_with_hertz(run)
    x, pressure = run.contact["x"], run.contact["pressure"]
    if scene == "flat-punch" and 40 * run.positive("a") <= run.positive("width"):
        middle, a = float(np.interp(0, x, pressure)), run.positive("a")
        slack = mesh_tolerance(run, a) + a / run.positive("width")
        return [
            Check("pressure in the middle", middle, float(punch_pressure(run, np.zeros(1))[0]), slack, "flat punch")
        ]
    if scene == "wavy" and run.parameter("waves") >= 5 and not about_axis(run):
        length = run.positive("width") / run.parameter("waves")
        inner = np.abs(x) <= 0.5 * run.positive("width") - 2 * length  # the outermost waves feel the block's sides
        crest = float(wave_pressure(run, np.zeros(1))[0])
        return [
            Check("greatest pressure", float(pressure[inner].max()), crest, mesh_tolerance(run, length), "Westergaard")
        ]
    return []


def about_axis(run: Run) -> bool:
    """Whether the run's bodies turn about an axis."""
    return run.summary["parameters"].get("geometry") == "axisymmetric"


def in_circle(run: Run) -> bool:
    """Whether the contact of one of Hertz's scenes is a circle."""
    return run.summary["scene"] in CIRCLES or about_axis(run)


def compare_with_hertz(run: Run) -> list[Check]:
    """Half-width or radius, by the second moment, and greatest pressure of a contact under a force."""
    a, greatest = hertz(run, prescribed_force(run))
    lengths = run.summary["parameters"]
    radius = min(run.positive(name) for name in ("R", "R1", "R2") if name in lengths)
    if is_number(lengths.get("reach")) and 0 < lengths["reach"] < 1.2 * a:
        return []  # cut off, or close to it
    slack = mesh_tolerance(run, a) + (a / radius) ** 2
    if "depth" in lengths:  # the block's own, which the closed form takes for endless
        slack += (a / min(run.positive("depth"), (1 if about_axis(run) else 0.5) * run.positive("width"))) ** 2
    round_contact = in_circle(run)
    names = ("halfWidthMoment", "radius" if round_contact else "half-width"), ("pressureMax", "greatest pressure")
    pairs = zip(names, (a, greatest), strict=True)
    found = [(name, run.summary.get(key), reference) for (key, name), reference in pairs]
    return [
        Check(name, float(value), reference, slack, "Hertz") for name, value, reference in found if is_number(value)
    ]


def mesh_tolerance(run: Run, length: float) -> float:
    """The relative difference from a closed form that the mesh explains, length: of the contact or its wave."""
    return (0.4 if run.summary["order"] == 1 else 0.1) * float(run.summary["h"]) / length


def paper_test(run: Run) -> dict[str, float]:
    """The reference values, when every parameter is that of the paper's test and enough points are in contact."""
    summary, parameters = run.summary, run.summary["parameters"]
    if summary["scene"] not in SCENES or summary["method"] == "signorini" or summary["contactPoints"] < LEAST_POINTS:
        return {}
    if any(not is_equal_parameter(parameters[name], value) for name, value in PAPER_TEST.items() if name in parameters):
        return {}
    law = parameters.get("kappa"), parameters.get("m")
    kappa, m = law
    return PAPER.get((float(kappa), float(m)), {}) if is_number(kappa) and is_number(m) else {}


def confined_block(run: Run) -> dict[str, float]:
    """The one-dimensional state of a laterally confined block under a flat wall: a root, found by bisection."""
    summary, parameters = run.summary, run.summary["parameters"]
    names = "E nu width depth gap u0 d0 kappa m".split()
    if summary["scene"] != "confined-block" or not all(is_number(parameters.get(name)) for name in names):
        return {}
    law = "signorini" if summary["method"] == "signorini" else parameters.get("law", "power")
    u0, gap, d0, nu, depth, width = (float(parameters[name]) for name in ("u0", "gap", "d0", "nu", "depth", "width"))
    if law not in ("power", "signorini") or u0 - gap <= d0 or not -1 < nu < 0.5 or not depth > 0:
        return {}
    pressure = in_series(run, depth / confined_modulus(run), law == "signorini")
    return {"force": pressure * width, "pressureMax": pressure}


def confined_modulus(run: Run) -> float:
    """Pressure over strain of the run's material where it cannot bulge."""
    young, nu = run.positive("E"), run.parameter("nu")
    if not -1 < nu < 0.5:
        raise ResultsError(run.path / "summary.json", f"parameters has nu = {nu:g}: the block cannot be compressed")
    return young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))


def in_series(run: Run, soft: float, hard: bool) -> float:
    """The pressure of the run's power law, or of hard contact, on a spring of this softness (length/pressure)."""
    kappa, m, d0 = (run.parameter(name) for name in ("kappa", "m", "d0"))
    end = run.parameter("u0") - run.parameter("gap")
    low, high = d0, d0 if hard else end
    for _ in range(200):
        middle = 0.5 * (low + high)
        try:
            below = kappa * (middle - d0) ** m < (end - middle) / soft
        except OverflowError:
            below = False
        low, high = (middle, high) if below else (low, middle)
    return (end - high) / soft


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


def prescribed_force(run: Run) -> float:
    """The force that the run was given; ResultsError where its approach was."""
    force = run.parameter("force")
    if force <= 0:
        raise ResultsError(run.path / "summary.json", "a run without -force cannot be compared with its closed form")
    return force


def softness(run: Run, body: str = "") -> float:
    """(1 - nu^2)/E of the run's body, or of the one with this number; in plane stress 1/E."""
    young, nu = run.positive(f"E{body}"), run.parameter(f"nu{body}")
    if not -1 < nu <= 0.5:
        raise ResultsError(
            run.path / "summary.json", f"parameters has nu{body} = {nu:g}, which is not within (-1, 0.5]"
        )
    return (1 if run.summary["parameters"].get("geometry") == "stress" else 1 - nu**2) / young


def hertz(run: Run, force: float) -> tuple[float, float]:
    """(a, p0): Hertz's contact radius or half-width (length) and greatest pressure for a force on the run's bodies."""
    bodies = ("1", "2") if "E2" in run.summary["parameters"] else ("",)
    modulus = 1 / sum(softness(run, body) for body in bodies)
    radius = 1 / sum(1 / run.positive(f"R{body}") for body in bodies)
    if in_circle(run):
        a = (3 * force * radius / (4 * modulus)) ** (1 / 3)
        return a, 3 * force / (2 * np.pi * a**2)
    a = np.sqrt(4 * force * radius / (np.pi * modulus))
    return a, 2 * force / (np.pi * a)


def scene_of(run: Run, *names: str) -> str:
    """The run's scene; ResultsError unless it is one of these."""
    if run.summary["scene"] not in names:
        raise ResultsError(run.path / "summary.json", f"scene {run.summary['scene']!r:.60} is not {' or '.join(names)}")
    return run.summary["scene"]


def patch_pressure(run: Run) -> float:
    """The uniform pressure of a patch test: the law and two confined blocks in series."""
    scene_of(run, "patch-test", "patch-test-3d")
    blocks = (run.positive("depth") + run.positive("height") / run.positive("Eratio")) / confined_modulus(run)
    return in_series(run, blocks, run.summary["parameters"].get("law") == "signorini")


def punch_pressure(run: Run, x: np.ndarray) -> np.ndarray:
    """The pressure of a rigid flat punch in hard contact: P/(pi s), about an axis P/(2 pi a s), s^2 = a^2 - x^2."""
    a = run.positive("a")
    return prescribed_force(run) / (np.pi * np.sqrt(a**2 - x**2)) / (2 * a if about_axis(run) else 1)


def merging_pressure(run: Run) -> float:
    """The mean pressure at which the contacts of a rigid wave on a half-plane merge: pi E* A/lambda."""
    scene_of(run, "wavy")
    return np.pi / softness(run) * run.positive("amplitude") * run.positive("waves") / run.positive("width")


def wave_pressure(run: Run, x: np.ndarray) -> np.ndarray:
    """Westergaard's pressure of a rigid wave in hard contact with a half-plane, x (wavelengths) from a crest."""
    full, mean = merging_pressure(run), prescribed_force(run) / run.positive("width")
    if mean >= full:
        return mean + full * np.cos(2 * np.pi * x)
    inside = np.maximum(mean / full - np.sin(np.pi * x) ** 2, 0)
    return 2 * full * np.abs(np.cos(np.pi * x)) * np.sqrt(inside)


def is_equal_parameter(value: object, wanted: object) -> bool:
    if is_number(wanted):
        return is_number(value) and abs(float(value) - wanted) <= 1e-12 * abs(wanted)
    return value == wanted
