"""Laws fitted to measurements: their parameters with bounds and first values, and fits from the best of these."""

import math
from dataclasses import dataclass

import numpy as np

from postprocess.least_squares import Fit, Parameter, fit
from postprocess.measurements import ContactModel, Measurements
from postprocess.problem_rows import Problem, Setting
from postprocess.results import ResultsError

LAWS = {"power": ("kappa", "m"), "exponential": ("p0", "beta"), "barrier": ("p0",), "signorini": (), "table": ()}
BOUNDS = {  # of parameters without bounds of the user's
    "kappa": (1e-12, 1e40),
    "m": (1.001, 40.0),
    "p0": (1e-15, 1e15),
    "beta": (1e-6, 1e9),
    "E": (1e-12, 1e15),
    "E1": (1e-12, 1e15),
    "E2": (1e-12, 1e15),
    "friction": (1e-3, 10.0),
    "d0": (-1e9, -1e-9),
    "nu": (-0.9, 0.499),
    "nu1": (-0.9, 0.499),
    "nu2": (-0.9, 0.499),
}
LINEAR = frozenset("nu nu1 nu2".split())  # parameters that do not vary in their logarithms
POWERS = (1.5, 3.0, 6.0)  # first values of m; of the others factors beside the value of the run
SHARES = (0.02, 0.1, 0.4)  # assumed overlap of the layer over its height, for first values


@dataclass
class LawFit:
    """The best fit of a law to the measurements."""

    law: str
    fit: Fit
    model: ContactModel


def read_parameters(words: str, problem: Problem) -> dict[str, tuple[float, float]]:
    """Parameters and bounds of a text as "kappa 1:1e9, m, E"."""
    found = {}
    for part in filter(None, (word.strip() for word in words.split(","))):
        name, _, text = part.partition(" ")
        if name not in problem.parameters or not isinstance(problem.parameters[name], int | float):
            numbers = " ".join(n for n in BOUNDS if n in problem.parameters)
            raise ResultsError("--fit", f"{name}: no number of this run; allowed: {numbers}, or another flag of it")
        low, high = BOUNDS.get(name, (1e-12, 1e12))
        if text:
            try:
                low, high = (float(end) for end in text.split(":"))
            except ValueError:
                raise ResultsError("--fit", f"{part}: allowed: NAME or NAME LOW:HIGH") from None
        if not low < high or (name not in LINEAR and low * high <= 0):
            raise ResultsError("--fit", f"{part}: allowed: LOW < HIGH, both of one sign")
        found[name] = (low, high)
    return found


def first_settings(law: str, problem: Problem, measured: Measurements) -> list[dict[str, float]]:
    """First values of a law's parameters: those of the run, if it has this law, and guesses over decades.

    A guess carries the greatest pressure at an overlap that is a share of the layer.
    """
    height = abs(float(problem.parameters["d0"])) or 1.0
    pressure = float(problem.summary["pressureMax"]) or float(problem.parameters.get("E", 1.0))
    own = {name: float(problem.parameters[name]) for name in LAWS[law]} if problem.parameters["law"] == law else {}
    found = [own] if own else []
    for share in SHARES:
        overlap = share * height
        if law == "power":
            found += [{"kappa": pressure / overlap**m, "m": m} for m in POWERS]
        if law == "exponential":
            found += [{"beta": n / overlap, "p0": pressure / math.expm1(n)} for n in (1.0, 4.0, 8.0)]
        if law == "barrier":
            found.append({"p0": pressure * (1 - share) / share})
    return found or [{}]


def fit_law(
    law: str, problem: Problem, measured: Measurements, sought: dict[str, tuple[float, float]], starts: int
) -> LawFit | None:
    """The best of the fits from the best `starts` of all first values; None without any solution."""
    names = [name for name in sought if name in LAWS[law] or name not in {n for group in LAWS.values() for n in group}]
    fixed: Setting = {"law": law} if law != problem.parameters["law"] else {}
    fixed |= {name: float(problem.parameters[name]) for name in LAWS[law] if name not in names}
    model = ContactModel(problem, measured, fixed)
    deviations, values = measured.deviations, measured.values
    firsts = []
    for setting in first_settings(law, problem, measured):
        point = {name: setting.get(name, float(problem.parameters[name])) for name in names}
        point = {name: min(max(value, sought[name][0]), sought[name][1]) for name, value in point.items()}
        if point not in firsts:
            firsts.append(point)
    ranked = rank_first(model, firsts) if len(firsts) > 1 else firsts
    best: Fit | None = None
    for point in ranked[:starts]:
        parameters = [
            Parameter(name, value, *sought[name], is_logarithmic=name not in LINEAR) for name, value in point.items()
        ]
        found = fit(model.predict, parameters, np.array(values), np.array(deviations), measured.is_scatter_known)
        if found and (best is None or found.sum_of_squares < best.sum_of_squares):
            best = found
    return LawFit(law, best, model) if best else None


def rank_first(model: ContactModel, firsts: list[dict[str, float]]) -> list[dict[str, float]]:
    """First values that have solutions at all loads, by their sums of squares: one table of problems."""
    measured = model.measured
    settings = [{**model.fixed, **point, measured.flag: load} for point in firsts for load in measured.loads]
    rows = model.problem.solve(settings, "stiffness" in measured.names)
    sums = []
    for k in range(len(firsts)):
        part = rows[k * len(measured.loads) : (k + 1) * len(measured.loads)]
        total = 0.0
        for name, at, value, deviation in zip(
            measured.names, measured.at, measured.values, measured.deviations, strict=True
        ):
            row = part[at]
            total += math.inf if row is None else ((model.result(row, name) - value) / deviation) ** 2
        sums.append(total)
    order = sorted(range(len(firsts)), key=lambda k: sums[k])
    return [firsts[k] for k in order if math.isfinite(sums[k])] or firsts
