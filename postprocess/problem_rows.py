"""The problem of a finished run, solved again with other numbers: all in one table of problems, with sensitivities.

A problem is {flag: number}. Flags that change mesh or stiffness, as -E, are given on the command line: one run of
FreeFEM for each of their values, as are tangential loads. Problems without any other number take a run each.
"""

import csv
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from postprocess.results import ResultsError, read_run

ROOT = Path(__file__).resolve().parent.parent
LAW_FLAGS = ("law", "kappa", "m", "p0", "beta", "d0", "table")
ROW_FLAGS = frozenset([*LAW_FLAGS, "u0", "force", "friction", "compliance", "shearLimit"])  # columns that -rows takes
OF_OUTPUT = frozenset("out vtu plot states estimate sensitivity verbose history rows vary".split())
Row = dict[str, float]
Setting = dict[str, float | str]


@dataclass
class Problem:
    """A script and the flags that its run was given; `calls` counts runs of FreeFEM."""

    script: str
    flags: dict[str, float | str]
    parameters: dict[str, float | str]  # all flags of the run, with defaults
    summary: dict
    calls: int = field(default=0)

    def solve(self, problems: list[Setting], sensitivities: bool = True) -> list[Row | None]:
        """The numbers of each problem by the names of rows.csv; None where it has no solution."""
        groups: dict[tuple, list[int]] = {}
        for k, one in enumerate(problems):
            groups.setdefault(tuple(sorted((n, v) for n, v in one.items() if n not in ROW_FLAGS)), []).append(k)
        found: list[Row | None] = [None] * len(problems)
        for common, members in groups.items():
            part = [{n: v for n, v in problems[k].items() if n in ROW_FLAGS} for k in members]
            for k, row in zip(members, self.solve_group(dict(common), part, sensitivities), strict=True):
                found[k] = row
        return found

    def solve_group(self, common: Setting, rows: list[Setting], sensitivities: bool) -> list[Row | None]:
        """One run of FreeFEM: rows with the same other flags."""
        columns = list(dict.fromkeys(name for row in rows for name in row))
        given = {n: v for n, v in {**self.flags, **common}.items() if n not in columns}
        with tempfile.TemporaryDirectory(prefix="contact-rows-") as folder:
            words = [word for name, value in given.items() for word in (f"-{name}", text_of(value))]
            words += ["-vtu", "0", "-estimate", "0", "-out", f"{folder}/out", *["-sensitivity", "1"] * sensitivities]
            if columns:
                path = Path(folder, "rows.csv")
                lines = [columns, *([text_of(row[name]) if name in row else "" for name in columns] for row in rows)]
                path.write_text("".join(",".join(line) + "\n" for line in lines), encoding="utf-8")
                words += ["-rows", str(path)]
            done = run_freefem(self.script, words)
            self.calls += 1
            if sys.stderr.isatty():
                print(f"\r  {self.calls} runs of FreeFEM", end="\r", file=sys.stderr, flush=True)
            out = Path(folder, "out")
            if not columns:
                return [flatten(read_run(out).summary) if done.returncode == 0 else None] * len(rows)
            if not (out / "rows.csv").exists():
                said = done.stdout.strip().splitlines()
                raise ResultsError(self.script, said[-1] if said else f"FreeFem++ ended with {done.returncode}")
            with (out / "rows.csv").open(newline="", encoding="utf-8") as f:
                return [numbers_of(row) if row["code"] == "0" else None for row in csv.DictReader(f)]


def read_problem(folder: Path) -> Problem:
    """The problem of the run in this folder."""
    summary = read_run(folder).summary
    if "bodies" in summary:
        raise ResultsError(folder, "is the run of a case; allowed: a built-in problem")
    parameters = summary["parameters"]
    given = {name: parameters[name] for name in summary["given"] if name in parameters and name not in OF_OUTPUT}
    scene = str(summary["scene"])
    found = sorted((ROOT / "edp" / scene).glob("*.edp")) if scene.startswith("labs/") else []
    if "friction" in summary and parameters["history"]:
        raise ResultsError(folder, "is a run with -history 1; allowed: more phases in -legs")
    return Problem(str(found[0]) if found else scene, given, parameters, summary)


def run_freefem(script: str, words: list[str]) -> subprocess.CompletedProcess[str]:
    """Runs a script of the package, with one thread of BLAS."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    command = ["sh", str(ROOT / "edp/freefem.sh"), script, *words]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)


def text_of(value: float | str) -> str:
    return value if isinstance(value, str) else repr(float(value))


def numbers_of(row: dict[str, str]) -> Row:
    """The numeric cells of a row of rows.csv."""
    return {name: float(text) for name, text in row.items() if text and re.fullmatch(r"[-+0-9.eE]+", text)}


def flatten(summary: dict, before: str = "") -> Row:
    """The numbers of a summary by the names of rows.csv: dots between keys, lists from 1."""
    found: Row = {}
    for key, value in summary.items():
        inner = value if isinstance(value, dict) else {}
        if isinstance(value, list):
            inner = {str(k): one for k, one in enumerate(value, 1)}
        if isinstance(value, int | float):
            found[f"{before}{key}"] = float(value)
        found |= flatten(inner, f"{before}{key}.") if key != "parameters" else {}
    return found
