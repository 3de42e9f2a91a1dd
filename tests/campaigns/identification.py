"""Synthetic measurements with known parameters: how often 95 % intervals contain them, and whether a wrong law shows.

python tests/campaigns/identification.py [SETS [SEED]]: draws SETS tables (default 200) of 8 forces on a compliant layer
with normal noise of 1 %, each with its own kappa and m, and identifies them by the power law: with the deviations
stated, and with estimated ones. Then it draws half as many from the exponential law, and fits both laws. All tables are
identified at the same time: each step of all fits is one run of FreeFEM. Writes
results/identification/identification.csv.
"""

import csv
import sys
import tempfile
import threading
from dataclasses import replace
from pathlib import Path

import numpy as np

from postprocess.law_fits import BOUNDS
from postprocess.least_squares import Fit, Parameter, fit
from postprocess.measurements import ContactModel, Measurements
from postprocess.problem_rows import Problem, read_problem, run_freefem

ROOT = Path(__file__).resolve().parents[2]
BODIES = ["-h", "1", "-E", "1000", "-gap", "0", "-d0", "-0.25", "-vtu", "0", "-estimate", "0", "-u0", "0"]
LOADS = np.linspace(-0.2, 0.15, 8)  # approaches, counted from the touch of the mean planes
NOISE = 0.01


class SharedProblem(Problem):
    """A problem that several threads solve: once all of them wait, their problems are one table."""

    def start(self, threads: int) -> None:
        self.waiting: list[tuple[list, list]] = []
        self.active = threads
        self.lock = threading.Condition()

    def solve(self, problems, sensitivities=True):
        answer: list = []
        with self.lock:
            self.waiting.append((problems, answer))
            self.solve_if_all_wait()
            self.lock.wait_for(lambda: len(answer) == len(problems))
        return answer

    def leave(self) -> None:
        with self.lock:
            self.active -= 1
            self.solve_if_all_wait()

    def solve_if_all_wait(self) -> None:
        if not self.waiting or len(self.waiting) < self.active:
            return
        found = super().solve([one for problems, _ in self.waiting for one in problems])
        for problems, answer in self.waiting:
            answer.extend(found[: len(problems)])
            del found[: len(problems)]
        self.waiting = []
        self.lock.notify_all()


FIRST = {"power": {"kappa": 1e3, "m": 3.0}, "exponential": {"p0": 1.0, "beta": 10.0}}  # first values, for all sets


def identify_all(problem: Problem, tables: list[Measurements], law: str, firsts: list[dict]) -> list[Fit | None]:
    """The fit of a law to each table, from these first values on."""
    shared = SharedProblem(problem.script, problem.flags, problem.parameters, problem.summary)
    found: list[Fit | None] = [None] * len(tables)
    shared.start(len(tables))

    def work(k: int) -> None:
        try:
            model = ContactModel(shared, tables[k], {"law": law})
            parameters = [Parameter(name, first, *BOUNDS[name]) for name, first in firsts[k].items()]
            data = np.array(tables[k].values), np.array(tables[k].deviations)
            found[k] = fit(model.predict, parameters, *data, tables[k].is_scatter_known)
        finally:
            shared.leave()

    threads = [threading.Thread(target=work, args=(k,)) for k in range(len(tables))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    print(f"{len(tables)} fits of {law}, {shared.calls} runs of FreeFEM", flush=True)
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
        problem = read_problem(Path(folder, "out"))
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
