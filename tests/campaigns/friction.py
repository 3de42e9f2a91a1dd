"""Does the step with friction come to equilibrium, and in how many linearisations? Paths of loads, drawn at random.

Disc on block, P1, P2 and P4, 21 to 301 points, friction 0.01 to 1.5, laws of stiffness 1 to 1e12 and hard contact,
prescribed approaches and forces, six legs each of any size. A row per load step in results/friction/steps.csv;
interrupted and started again, it goes on where it was. Loads without equilibrium say so and are not counted. Exit
code 1 if a step is neither.
"""

import argparse
import csv
import os
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import campaign
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
FILE = campaign.RESULTS_FOLDER / "friction" / "steps.csv"
COLUMNS = "run step newton backsolves friction kappa points code message".split()
TURNS = [(1, 0), (1, 0.05), (1, 0.2), (1, 1), (1, -0.2), (0.5, -0.2), (1.25, 0.3)]
TOGETHER = [(0.2 * k, 0.04 * k) for k in range(1, 6)]
CYCLES = [(1, 0), (1, 0.15), (1, -0.15), (1, 0.15), (1, -0.15)]
FIXED = (TURNS, TOGETHER, CYCLES)


def load(run: int) -> list[str]:
    """The run's flags; its number is the seed."""
    draw = np.random.default_rng(run)
    order = int(draw.choice([1, 2, 2, 2, 4]))
    spacing = float(np.exp(draw.uniform(np.log(16 / 300), np.log(16 / 20))))
    kappa = draw.choice([1, 1e3, 1e6, 1e12, np.inf])
    friction = float(np.exp(draw.uniform(np.log(0.01), np.log(1.5))))
    kind = int(draw.integers(0, 5))
    legs = FIXED[kind] if kind < 3 else [(draw.uniform(0.1, 1.2), draw.uniform(-1, 1)) for _ in range(6)]
    flags = {
        "order": order,
        "h": order * spacing,
        "reach": 8,
        "grading": 20,
        "nu": float(draw.uniform(0, 0.45)),
        "friction": friction,
        "u0": 2,
        "drag": 1,
        "force": 0,
        "shear": 0,
        "vtu": 0,
        "legs": ", ".join(f"{press:.6g} {drag:.6g}" for press, drag in legs),
    }
    if np.isfinite(kappa):
        flags |= {"law": "power", "kappa": kappa, "m": 3, "d0": -1e-9}
    if draw.random() < 0.3:  # a force presses, and in half of these one pulls
        flags |= {"force": 250}
        if draw.random() < 0.5:
            flags |= {"drag": 0, "shear": 0.9 * friction * 100 * min(press for press, _ in legs)}
    return [word for name, value in flags.items() for word in (f"-{name}", str(value))]


def solve(run: int) -> list[dict]:
    """One path; what became of its steps."""
    flags = load(run)
    given = dict(zip(flags[::2], flags[1::2], strict=True))
    with tempfile.TemporaryDirectory() as folder:
        command = ["FreeFem++", "-nw", "-v", "0", "edp/scenes/fretting.edp", *flags, "-out", folder]
        done = subprocess.run(
            command, cwd=ROOT, capture_output=True, text=True, env=os.environ | {"OPENBLAS_NUM_THREADS": "1"}
        )
        series, contact = Path(folder) / "series.csv", Path(folder) / "contact.csv"
        steps = list(csv.DictReader(series.read_text().splitlines())) if series.exists() else []
        points = len(contact.read_text().splitlines()) - 1 if contact.exists() else 0
    common = {"run": run, "friction": given["-friction"], "kappa": given.get("-kappa", "hard"), "points": points}
    rows, before = [], (0, 0)
    for row in steps:
        now = int(row["newton"]), int(row["backsolves"])
        rows.append(
            common | {"step": row["step"], "newton": now[0] - before[0], "backsolves": now[1] - before[1], "code": 0}
        )
        before = now
    if done.returncode:
        lines = [line for line in done.stdout.splitlines() if "NOT CONVERGED" in line] or done.stdout.splitlines()[-1:]
        rows.append(common | {"step": len(steps) + 1, "code": done.returncode, "message": " ".join(lines)})
    return rows


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--paths", type=int, default=380, help="how many (default: %(default)s)")
    count = parser.parse_args().paths
    FILE.parent.mkdir(parents=True, exist_ok=True)
    known = {int(row["run"]) for row in campaign.read_rows(FILE)}
    with ThreadPoolExecutor(2) as pool:
        for found in pool.map(solve, sorted(set(range(count)) - known)):
            campaign.add_rows(FILE, COLUMNS, found)
    done = [row for row in campaign.read_rows(FILE) if int(row["run"]) < count]
    good = [row for row in done if row["code"] == "0"]
    said = [row for row in done if row["code"] == "20" and "gross sliding" in row["message"]]
    failed = [row for row in done if row not in good and row not in said]
    for what in ("newton", "backsolves"):
        counts = np.array([int(row[what]) for row in good])
        print(f"{what}: mean {counts.mean():.2f}, 95 % {np.percentile(counts, 95):.0f}, most {counts.max()}")
    print(f"{len(good)} steps solved, {len(said)} without equilibrium, {len(failed)} failed")
    for row in failed:
        print(f"  run {row['run']} step {row['step']}: {row['message']}")
    return 1 if failed else 0


if __name__ == "__main__":
    raise SystemExit(main())
