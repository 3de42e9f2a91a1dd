"""intervals of results whose parameters are uncertain, beside the error of the mesh: which of them is greater?

RUN is the result folder of a run with -sensitivity 1. DEVIATIONS are standard deviations, as "kappa 20%, m 0.1, E 2":
a percentage of the value, or in its unit. --identified takes values and covariance from identify.json. First-order
intervals come from the sensitivities; --samples N also solves N problems with parameters drawn at random. Parameters
that are positive are drawn in their logarithms. Nothing is written.
"""

import argparse
import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from postprocess.law_fits import LINEAR
from postprocess.problem_rows import Problem, Row, Setting, read_problem
from postprocess.results import ResultsError

NORMAL = 1.959963984540054  # half the 95 % interval of a normal distribution, in standard deviations
LINEAR_WITHIN = 0.1  # relative difference of first order and samples that is called linear
SAME = 0.1  # of a standard deviation: how far the run's parameters may be from the identified ones
NAMES = {
    "force": "contact force",
    "approach": "approach",
    "pressureMax": "greatest pressure",
    "overlapMax": "greatest overlap",
}


@dataclass
class Uncertain:
    """Uncertain parameters: names, values, standard deviations, correlation."""

    names: list[str]
    values: np.ndarray
    deviations: np.ndarray
    correlation: np.ndarray

    @property
    def covariance(self) -> np.ndarray:
        return self.correlation * np.outer(self.deviations, self.deviations)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RUN", type=Path, help="result folder of a run with -sensitivity 1")
    parser.add_argument("deviations", metavar="DEVIATIONS", nargs="?", default="", help='as "kappa 20%%, m 0.1, E 2"')
    parser.add_argument("--identified", metavar="FILE", type=Path, help="identify.json of an identification")
    parser.add_argument("--samples", type=int, default=0, metavar="N", help="problems with parameters drawn at random")
    parser.add_argument("--seed", type=int, default=1, metavar="K", help="of the random numbers (default 1)")


def run(arguments: argparse.Namespace) -> None:
    """Prints a line for each result."""
    problem = read_problem(arguments.folder)
    known = problem.summary.get("sensitivities")
    if not known:
        raise ResultsError(arguments.folder, "has no sensitivities; allowed: a run with -sensitivity 1")
    uncertain = read_uncertain(arguments, problem)
    results = {name: slopes for name, slopes in known.items() if isinstance(slopes, dict)}
    missing = [name for name in uncertain.names if not all(name in slopes for slopes in results.values())]
    if missing:
        allowed = " ".join(next(iter(results.values())))
        raise ResultsError("DEVIATIONS", f"{missing[0]}: no sensitivity by it; allowed: {allowed}")
    if arguments.samples and arguments.samples < 20:
        raise ResultsError("--samples", "allowed: 20 or more")
    drawn = sample(problem, uncertain, arguments.samples, arguments.seed) if arguments.samples else []
    for line in report(problem, uncertain, results, drawn):
        print(line)


# ---------------------------------------------------------------- uncertain parameters


def read_uncertain(arguments: argparse.Namespace, problem: Problem) -> Uncertain:
    """The parameters of the command line and of identify.json, independent of each other."""
    found: dict[str, float] = {}
    for part in filter(None, (word.strip() for word in arguments.deviations.split(","))):
        name, _, text = part.partition(" ")
        value = problem.parameters.get(name)
        if not isinstance(value, int | float):
            raise ResultsError("DEVIATIONS", f"{name}: no number of this run")
        try:
            share = float(text.strip().removesuffix("%"))
        except ValueError:
            share = math.nan
        if not (share > 0 and math.isfinite(share)):
            raise ResultsError("DEVIATIONS", f"{part}: allowed: NAME P% or NAME NUMBER, above 0")
        found[name] = share / 100 * abs(float(value)) if text.strip().endswith("%") else share
    names, deviations = list(found), list(found.values())
    correlation = np.eye(len(names))
    if arguments.identified:
        law = read_identified(arguments.identified)
        own = [name for name in law["parameters"] if name not in found]
        index = [list(law["parameters"]).index(name) for name in own]
        for name in own:
            deviations.append(absolute_deviation(arguments.identified, problem, name, law["parameters"][name]))
        names += own
        whole = np.eye(len(names))
        whole[len(found) :, len(found) :] = signed(law, own, np.array(law["correlation"])[np.ix_(index, index)])
        correlation = whole
    if not names:
        raise ResultsError("DEVIATIONS", 'none; allowed: as "kappa 20%, m 0.1", or --identified identify.json')
    values = np.array([float(problem.parameters[name]) for name in names])
    return Uncertain(names, values, np.array(deviations), correlation)


def read_identified(path: Path) -> dict:
    """The preferred law of identify.json."""
    try:
        law = json.loads(path.read_text(encoding="utf-8"))["laws"][0]
        if not law["parameters"]:
            raise KeyError
    except (OSError, ValueError, KeyError, IndexError, TypeError):
        raise ResultsError(path, "is not what the command identify writes") from None
    return law


def absolute_deviation(path: Path, problem: Problem, name: str, one: dict) -> float:
    """The standard deviation of an identified parameter, whose value must be that of the run."""
    if one["deviation"] is None:
        raise ResultsError(path, f"{name} has no standard deviation: measure at more loads")
    deviation = one["deviation"] * (abs(one["value"]) if one["logarithmic"] else 1.0)
    if not isinstance(problem.parameters.get(name), int | float):
        raise ResultsError(path, f"{name}: no number of this run")
    if abs(float(problem.parameters[name]) - one["value"]) > SAME * deviation:
        raise ResultsError(
            path, f"{name} is {one['value']:.6g}, in RUN {problem.parameters[name]:.6g}: run with the former"
        )
    return float(deviation)


def signed(law: dict, names: list[str], correlation: np.ndarray) -> np.ndarray:
    """The correlation of the values: that of logarithms of magnitudes, with the signs of the values."""
    sign = np.sign([law["parameters"][n]["value"] if law["parameters"][n]["logarithmic"] else 1.0 for n in names])
    return correlation * np.outer(sign, sign)


# ---------------------------------------------------------------- samples


def sample(problem: Problem, uncertain: Uncertain, count: int, seed: int) -> list[Row]:
    """The results of problems with parameters drawn at random: those that have a solution."""
    linear = np.array([name in LINEAR for name in uncertain.names])
    scale = np.where(linear, 1.0, uncertain.values)
    spread = np.linalg.cholesky(uncertain.covariance / np.outer(scale, scale) + 1e-14 * np.eye(len(scale)))
    normal = np.random.default_rng(seed).standard_normal((count, len(scale))) @ spread.T
    values = np.where(linear, uncertain.values + normal, uncertain.values * np.exp(normal))
    settings: list[Setting] = [dict(zip(uncertain.names, map(float, row), strict=True)) for row in values]
    found = [row for row in problem.solve(settings, False) if row is not None]
    if len(found) < 0.9 * count:
        raise ResultsError("--samples", f"only {len(found)} of {count} problems have a solution: smaller deviations")
    return found


def drawn_values(name: str, rows: list[Row]) -> np.ndarray:
    column = {"contactLength": "contacts.1.contactLength"}.get(name, name)
    return np.array([row[column] for row in rows if column in row])


# ---------------------------------------------------------------- report


def slope(entry: float | dict) -> float:
    """A derivative; of two one-sided ones the greater."""
    return max(entry["below"], entry["above"], key=abs) if isinstance(entry, dict) else float(entry)


def report(problem: Problem, uncertain: Uncertain, results: dict, drawn: list[Row]) -> list[str]:
    """The lines of the screen."""
    given = zip(uncertain.names, uncertain.values, uncertain.deviations, strict=True)
    lines = ["standard deviations: " + ", ".join(f"{name} {value:.5g} ± {sd:.3g}" for name, value, sd in given), ""]
    head = f"{'95 % intervals':20s}{'value':>12s}{'mesh ±':>12s}{'parameters ±':>14s}"
    lines.append(head + (f"{f'{len(drawn)} samples':>26s}" if drawn else "") + "  greater, most of it by")
    estimates = problem.summary.get("estimates") or {}
    curved = []
    for name, entry in results.items():
        slopes = np.array([slope(entry[parameter]) for parameter in uncertain.names])
        reach = NORMAL * math.sqrt(slopes @ uncertain.covariance @ slopes)
        value = float(problem.summary.get(name) or problem.summary["contacts"][0].get(name, math.nan))
        error = (estimates.get(name) or {}).get("error")
        parts = (slopes * uncertain.deviations) ** 2
        top = int(np.argmax(parts))
        mesh = "unknown" if error is None else f"{error:.3g}"
        line = f"{NAMES.get(name, name):20s}{value:12.6g}{mesh:>12s}{reach:14.3g}"
        if drawn:
            ends = np.quantile(drawn_values(name, drawn), [0.025, 0.975])
            line += f"{ends[0]:13.6g}{ends[1]:13.6g}"
            if abs((ends[1] - ends[0]) / 2 - reach) > max(LINEAR_WITHIN, 3 / math.sqrt(len(drawn))) * reach:
                curved.append(NAMES.get(name, name))
        greater = "" if error is None else ("mesh" if error > reach else f"parameters, {uncertain.names[top]}")
        lines.append(f"{line}  {greater}".rstrip())
    if curved:
        lines += ["", f"not linear in the parameters, take the samples: {', '.join(curved)}"]
    return lines
