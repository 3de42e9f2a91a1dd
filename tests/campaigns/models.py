"""Walls, tangents, plain Newton and xnewton on 75 problems and two meshes: `make models`, results/models/.

`models.csv` has a row a run. Problems: the paper's test over stiffness, exponent and load. Every run must converge, and
the forces of a problem must agree. For each run of walls or tangents `leastOverError` is the greatest ratio, over its
models, of the least bound (overlap, force, gap) to the error of the contact forces, `boundMissed` how many bounds were
below the error; the reference is the law's state by the condensed twin of the tests.
"""

import argparse
import functools
import sys
from pathlib import Path

import campaign
import condensed
import conditioning
import numpy as np
from campaign import case, decade, markdown, select, value

FOLDER = campaign.RESULTS_FOLDER / "models"
COLUMNS = ("models", "modelsBounded", "leastOverError", "boundMissed")
KAPPAS = (1.0, 1e3, 1e6, 1e9, 1e12)
EXPONENTS = (1.5, 2.0, 3.0, 10.0, 20.0)
LOADS = (1.0, 2.5, 4.5)
SIZES = (1.0, 0.5)
U0 = 2.5  # of the assembled problem
METHODS = {  # words of the tables: flags
    "plain Newton": {"method": "newton"},
    "walls from T⁰ = 0": {"method": "paper", "T0": "0"},
    "walls from T⁰ = d0": {"method": "paper", "T0": "d0"},
    "walls from T⁰ = d0, uniform": {"method": "paper", "T0": "d0", "threshold": "uniform"},
    "tangents": {"method": "paper", "model": "linear"},
    "`xnewton`, no start": {"method": "xnewton", "start": "none"},
    "`xnewton`": {"method": "xnewton"},
}
SURE = 1e-6  # of the forces: errors below are those of the residual
AGREE = 1e-3  # relative: forces of models that eq. (7) with eps = 1e-4 has accepted


def cases(_root: Path = campaign.ROOT) -> list[campaign.Case]:
    common = [
        {"kappa": kappa, "m": m, "u0": u0, "order": 1, "h": h}
        for h in SIZES
        for u0 in LOADS
        for kappa in KAPPAS
        for m in EXPONENTS
    ]
    return [case(words, **flags, **one, estimate=0, weight=0.2) for words, flags in METHODS.items() for one in common]


def few() -> list[campaign.Case]:
    """The subset that is part of the tests: one mesh and load, two laws, every method."""
    laws = {(1e3, 3.0), (1e9, 20.0)}
    wanted = [{"kappa": f"{kappa:g}", "m": f"{m:g}", "u0": "2.5", "h": "1"} for kappa, m in laws]
    return [item for item in cases() if any(item.parameters.items() >= one.items() for one in wanted)]


@functools.cache
def assembled(h: float) -> condensed.Problem:
    return conditioning.assembled({"order": 1, "h": h})[-1]


@functools.cache
def exact(h: float, kappa: float, m: float, u0: float) -> tuple[condensed.Problem, condensed.Law, np.ndarray]:
    problem = assembled(h)
    problem = condensed.Problem(problem.C, problem.w, problem.free + u0 - U0)
    law = condensed.power(kappa, m)
    return problem, law, condensed.least(problem, law)[1]


def ratios(problem: condensed.Problem, law: condensed.Law, q: np.ndarray, table: np.ndarray) -> list[tuple]:
    """(least bound over error, bounds below the error) of each model of a run that is off the law."""
    found = []
    for model in table.reshape(-1, len(q)):
        off = model["status"] >= 2  # a wall or a tangent carries
        error = problem.norm(problem.w * model["pressure"] - q)
        if not off.any() or error <= 10 * SURE * problem.norm(q):
            continue
        said = condensed.bounds(problem, law, model["s"], model["pressure"], off)
        three = [said[name] for name in ("overlap", "force", "gap")]
        missed = sum(bound < error * (1 - 1e-6) - SURE * problem.norm(q) for bound in three)
        found.append((min(three) / error, missed))
    return found


def measure(*_):
    """COLUMNS."""

    def further_columns(item: campaign.Case, summary: dict, folder: Path) -> dict:
        found = {"models": summary["adaptations"]}
        if summary["method"] != "paper":
            return found
        given = summary["parameters"]
        rows = np.genfromtxt(folder / "adaptations.csv", delimiter=",", names=True)
        known = ratios(*exact(given["h"], given["kappa"], given["m"], given["u0"]), rows)
        worst, missed = (max(one[0] for one in known), sum(one[1] for one in known)) if known else ("", 0)
        return found | {"modelsBounded": len(known), "leastOverError": worst, "boundMissed": missed}

    return further_columns


def table(rows: list[dict]) -> str:
    """A line a method: runs solved, steps, models, steps by stiffness, bounds."""
    lines = []
    for words in METHODS:
        mine = select(rows, name=words)
        if not mine:
            continue
        good = [row for row in mine if row["status"] == "converged"]
        steps, models = ([int(row[name]) for row in good] for name in ("newton", "models"))
        by_kappa = [np.mean([int(row["newton"]) for row in good if value(row, "kappa") == kappa]) for kappa in KAPPAS]
        bounded = [row for row in good if row["leastOverError"] != ""]
        ratio = [value(row, "leastOverError") for row in bounded]
        counted = sum(int(row["modelsBounded"]) for row in bounded)
        lines.append(
            [
                words,
                f"{len(good)} of {len(mine)}",
                f"{np.mean(steps):.1f}",
                max(steps),
                " to ".join(map(str, sorted({min(models), max(models)}))),
                *(f"{mean:.1f}" for mean in by_kappa),
                f"{max(ratio):.2f} in {counted}" if ratio else "",
            ]
        )
    heads = "method|solved|mean steps|most|models".split("|") + [f"κ = {decade(kappa)}" for kappa in KAPPAS]
    return markdown([*heads, "least bound over error"], lines)


def faults(rows: list[dict]) -> list[str]:
    """What is wrong: runs that have not converged, forces that differ, bounds below the error."""
    found = [f"{row['status']}: {row['flags']}" for row in rows if row["status"] != "converged"]
    good = [row for row in rows if row["status"] == "converged"]
    known = {tuple(row[name] for name in ("h", "u0", "kappa", "m")): row for row in select(good, name="`xnewton`")}
    for row in good:
        other = known.get(tuple(row[name] for name in ("h", "u0", "kappa", "m")))
        if other and abs(value(row, "force") / value(other, "force") - 1) > AGREE:
            found.append(f"force {row['force']}, not {other['force']}: {row['flags']}")
        if row["boundMissed"] not in ("", "0"):
            found.append(f"{row['boundMissed']} bounds below the error: {row['flags']}")
    return found


def run(path: Path, chosen: list[campaign.Case], jobs: int) -> list[dict[str, str]]:
    return campaign.run(chosen, path, jobs=jobs, columns=COLUMNS, measure=measure, together=needs_no_files)


def needs_no_files(item: campaign.Case) -> bool:
    """Whether `measure` reads the run's summary alone."""
    return item.parameters["method"] != "paper"


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of the CSV file")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time (default 2: they are counted, not timed)")
    arguments = parser.parse_args(argv)
    try:
        rows = run(arguments.out / "models.csv", cases(), arguments.jobs)
    except KeyboardInterrupt:
        print("\ninterrupted; started again, it goes on from here", file=sys.stderr)
        return 130
    print(table(rows))
    wrong = faults(rows)
    print(f"{len(rows)} runs, {len(wrong)} faults", *wrong, sep="\n  ")
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
