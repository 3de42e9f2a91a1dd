"""Run the tests and say what they took in default runs: `python tests/run.py EXPRESSION [WORDS OF PYTEST]`.

EXPRESSION chooses tests by their marks. Those with the mark `ranks` start processes that wait for each other, and are
slow beside other tests: they come last, one at a time. `python tests/run.py --report TIMES ACCOUNTS` sums up what went
before: the CPU that a shell's `times` wrote, and the accounts of all tests (accounts.py).

A default run is the CPU, user and system, of `FreeFem++ edp/main.edp` when the budgets were set; default-run.edp keeps
it, so that budgets mean the same on every machine, whatever becomes of the package.
"""

import json
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
FREEFEM = ("FreeFem++", "-nw", "-v", "0")
FACTOR = 0.92  # a default run over default-run.edp: median of nine, in turns, on an idle machine
WORKERS = 3


def children() -> float:
    """CPU seconds of everything that has been started here and has ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def cpu(*command: object) -> float:
    before = children()
    quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.STDOUT}
    subprocess.run(list(map(str, command)), env={**os.environ, "OPENBLAS_NUM_THREADS": "1"}, **quiet)
    return children() - before


def default_run() -> float:
    """CPU seconds of a default run on this machine."""
    return FACTOR * statistics.median([cpu(*FREEFEM, HERE / "default-run.edp") for _ in range(6)][1:])


def start() -> float:
    """CPU seconds of a start of FreeFEM that reads the package's scripts and computes nothing."""
    refused = [*FREEFEM, HERE.parent / "edp/main.edp", "-h", 0]
    return statistics.median(cpu(*refused) for _ in range(3))


def report(used: float, unit: float, accounts: Path, dearest: int) -> str:
    """What the tests took: `used` CPU seconds in default runs, the share of FreeFEM's starts, the dearest tests."""
    rows = [json.loads(line) for line in accounts.read_text().splitlines()] if accounts.exists() else []
    starts = sum(row["starts"] for row in rows)
    text = f"{used / unit:.0f} default runs of {unit:.3f} CPU s"
    if starts:
        text += f"; {starts} starts of FreeFEM, about {100 * starts * start() / used:.0f} % of it"
    costs = Counter()
    for row in rows:
        costs[row["label"]] += row["cpu"]
    for label, seconds in costs.most_common(dearest):
        text += f"\n{seconds / unit:6.0f}  {label}"
    return text


def main(words: list[str]) -> int:
    if words[0] == "--report":
        minutes = re.findall(r"(\d+)m([\d.]+)s", Path(words[1]).read_text().splitlines()[1])
        print(report(sum(60 * int(m) + float(s) for m, s in minutes), default_run(), Path(words[2]), 20))
        return 0
    expression, *rest = words
    unit, codes = default_run(), []
    before = children()
    with tempfile.TemporaryDirectory() as folder:
        own = Path(folder, "accounts")
        env = {**os.environ, "ACCOUNTS": str(own), "DEFAULT_RUN": str(unit)}
        for kind, how in (("not ranks", ["-n", str(WORKERS), "--dist", "worksteal"]), ("ranks", [])):
            command = [sys.executable, "-m", "pytest", "-q", "-m", f"({expression}) and {kind}", *how, *rest]
            rest = [word for word in rest if word != "--cache-clear"]  # the second would clear what the first kept
            codes.append(subprocess.run(command, env=env).returncode)
        used = children() - before
        print(report(used, unit, own, 0))
        if os.environ.get("ACCOUNTS") and own.exists():
            with Path(os.environ["ACCOUNTS"]).open("a") as file:
                file.write(own.read_text())
    return 0 if set(codes) <= {0, 5} and codes != [5, 5] else 1  # 5: no test of that kind


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
