"""Synthetic measurements with known parameters: how often 95 % intervals contain them, and whether a wrong law shows.

python tests/campaigns/identification.py [SETS [SEED]]: draws SETS tables (default 200) of 8 forces on a compliant layer
with normal noise of 1 %, each with its own kappa and m, and identifies them by the power law: with the deviations
stated, and with estimated ones. Then it draws half as many from the exponential law, and fits both laws. The contact
problem on the mesh is solved by its condensed twin in numpy, which is first checked against FreeFEM. Writes
results/identification/identification.csv.
"""

import csv
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import condensed
import conditioning
import numpy as np

from postprocess.law_fits import BOUNDS
from postprocess.least_squares import Fit, Parameter, fit
from postprocess.measurements import ContactModel, Measurements
from postprocess.problem_rows import Problem, read_problem, run_freefem

ROOT = Path(__file__).resolve().parents[2]
BODIES = ["-h", "1", "-E", "1000", "-gap", "0", "-d0", "-0.25", "-vtu", "0", "-estimate", "0", "-u0", "0"]
LOADS = np.linspace(-0.2, 0.15, 8)  # approaches, counted from the touch of the mean planes
NOISE = 0.01


class Twin(Problem):
    """The same problem in numpy: the compliance of its contact points comes from FreeFEM, the law is solved here."""

    def solve(self, problems, sensitivities=True):
        return [self.solve_one(one, sensitivities) for one in problems]

    def solve_one(self, at, sensitivities):
        law = (
            condensed.power(at["kappa"], at["m"])
            if at["law"] == "power"
            else condensed.exponential(at["p0"], at["beta"])
        )
        C, w = self.contact.C, self.contact.w
        free = self.contact.free + at["u0"]
        s = free.copy()
        for _ in range(100):  # Newton's method from the side where it is monotone
            change = np.linalg.solve(np.eye(len(s)) + C * (w * law.slope(s)), free - s - C @ (w * law.pressure(s)))
            s += change
            if np.abs(change).max() < 1e-13 * np.abs(s).max():
                break
        else:
            return None
        row = {"force": float(w @ law.pressure(s))}
        if not sensitivities:
            return row
        active = law.slope(s) > 0
        s, p, slope = s[active], law.pressure(s)[active], law.slope(s)[active]
        adjoint = np.linalg.solve(C[np.ix_(active, active)] + np.diag(1 / (w[active] * slope)), np.ones(len(s)))
        by = {"kappa": p / at.get("kappa", 1), "m": p * np.log(s), "p0": p / at.get("p0", 1)}
        by["beta"] = s * (p + at.get("p0", 0))
        return row | {f"sensitivities.force.{n}": float(adjoint @ (v / slope)) for n, v in by.items() if n in at}


def make_twin(problem: Problem) -> Twin:
    """The twin of FreeFEM's problem, checked against it: forces and derivatives of two laws at all loads."""
    twin = Twin(problem.script, problem.flags, problem.parameters, problem.summary)
    flags = {
        name: value for name, value in zip(BODIES[::2], BODIES[1::2], strict=True) if name not in ("-vtu", "-estimate")
    }
    twin.contact = conditioning.assembled({name[1:]: value for name, value in flags.items()})[-1]
    settings = [{"law": law, **first, "u0": load} for law, first in FIRST.items() for load in LOADS]
    for one, other in zip(problem.solve(settings), twin.solve(settings), strict=True):
        wrong = [name for name, value in other.items() if not np.isclose(value, one[name], rtol=1e-5, atol=0)]
        if wrong:
            raise SystemExit(f"the twin differs from FreeFEM: {wrong[0]} {other[wrong[0]]}, not {one[wrong[0]]}")
    return twin


FIRST = {"power": {"kappa": 1e3, "m": 3.0}, "exponential": {"p0": 1.0, "beta": 10.0}}  # first values, for all sets


def identify_all(problem: Problem, tables: list[Measurements], law: str, firsts: list[dict]) -> list[Fit | None]:
    """The fit of a law to each table, from these first values on."""
    found = []
    for table, first in zip(tables, firsts, strict=True):
        parameters = [Parameter(name, value, *BOUNDS[name]) for name, value in first.items()]
        data = np.array(table.values), np.array(table.deviations)
        found.append(fit(ContactModel(problem, table, {"law": law}).predict, parameters, *data, table.is_scatter_known))
    return found


def draw_tables(problem: Problem, truths: list[dict], generator: np.random.Generator) -> list[Measurements]:
    """A table for each setting: the forces of its law with noise, standard deviations stated."""
    rows = problem.solve([{**truth, "u0": load} for truth in truths for load in LOADS], False)
    tables = []
    for k in range(len(truths)):
        exact = np.array([row["force"] for row in rows[k * len(LOADS) : (k + 1) * len(LOADS)]])
        values = exact * (1 + NOISE * generator.standard_normal(len(LOADS)))
        at = list(range(len(LOADS)))
        tables.append(
            Measurements("u0", LOADS.tolist(), ["force"] * len(at), at, values.tolist(), (NOISE * exact).tolist())
        )
    return tables


def without_deviations(table: Measurements) -> Measurements:
    return replace(table, deviations=np.abs(table.values).tolist(), is_scatter_known=False)


def contains(found: Fit | None, truth: dict) -> list[bool]:
    """Whether the interval of each parameter contains its true value."""
    names = [name for name in truth if name != "law"]
    if found is None:
        return [False] * len(names)
    intervals = {one.name: found.interval(k) for k, one in enumerate(found.parameters)}
    return [intervals[name][0] <= truth[name] <= intervals[name][1] for name in names]


def counts(words: str, fits: list[Fit | None], truths: list[dict]) -> list[list]:
    """A row for each parameter: how many intervals contain the truth."""
    inside = np.array([contains(found, truth) for found, truth in zip(fits, truths, strict=True)])
    names = [name for name in truths[0] if name != "law"]
    return [[f"{name} in its interval, {words}", len(fits), int(inside[:, k].sum())] for k, name in enumerate(names)]


def rejected(fits: list[Fit | None]) -> int:
    return sum(found is None or found.misfit_probability() < 0.01 for found in fits)


def campaign(sets: int, seed: int) -> list[list]:
    """Rows of the table: what is counted, how many sets, counts."""
    generator = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as folder:
        run_freefem("disc-on-block", [*BODIES, "-out", folder + "/out"])
        problem = make_twin(read_problem(Path(folder, "out")))
    truths = [
        {"law": "power", "kappa": float(10 ** generator.uniform(2, 4)), "m": float(generator.uniform(1.5, 4))}
        for _ in range(sets)
    ]
    tables = draw_tables(problem, truths, generator)
    fits = identify_all(problem, tables, "power", [FIRST["power"]] * sets)
    result = counts("power law", fits, truths)
    result.append(["power law rejected", sets, rejected(fits)])
    firsts = [found.values if found else FIRST["power"] for found in fits]
    fits = identify_all(problem, [without_deviations(table) for table in tables], "power", firsts)
    result += counts("power law, deviations estimated", fits, truths)
    truths = [
        {"law": "exponential", "p0": float(10 ** generator.uniform(-1, 1)), "beta": float(generator.uniform(8, 20))}
        for _ in range(sets // 2)
    ]
    tables = draw_tables(problem, truths, generator)
    wrong, right = (identify_all(problem, tables, law, [FIRST[law]] * len(tables)) for law in FIRST)
    result += counts("exponential law", right, truths)
    result.append(["exponential law taken for a power law: rejected", len(tables), rejected(wrong)])
    pairs = [pair for pair in zip(wrong, right, strict=True) if None not in pair]
    better = sum(pair[1].criteria()[0] < pair[0].criteria()[0] for pair in pairs)
    result.append(["exponential law preferred to the power law", len(tables), better])
    return result


def main() -> None:
    words = dict(enumerate(sys.argv))
    rows = campaign(int(words.get(1, 200)), int(words.get(2, 1)))
    out = ROOT / "results/identification/identification.csv"
    out.parent.mkdir(parents=True, exist_ok=True)
    with out.open("w", newline="") as f:
        csv.writer(f).writerows([["counted", "sets", "count"], *rows])
    for counted, total, count in rows:
        print(f"{counted:50s} {count:4d} of {total} ({100 * count / total:.1f} %)")


if __name__ == "__main__":
    main()
