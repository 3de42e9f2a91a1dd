"""Does the stable step come to a stable state? Loads of surfaces that attract, drawn at random, each from rest.

Tabor's number between 0.05 and 5, P1 and P2, elements of 0.1 to 0.25 cohesive lengths, approaches from far apart to
deep in contact. A row per run in results/attraction/loads.csv; interrupted and started again, it goes on where it was.
The end says how many were stable, how many said which limit they had met, and exits with 1 if a run did neither.
"""

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import campaign
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
FILE = campaign.RESULTS_FOLDER / "attraction" / "loads.csv"
COLUMNS = "run tabor order perLength approach code stability newton backsolves message".split()
MODULUS, RADIUS, GAP = 100 / 0.91, 10, 1e-3  # the scene's E/(1 - nu^2), R, eps0


def load(run: int) -> dict:
    """The run's data; its number is the seed."""
    draw = np.random.default_rng(run)
    tabor = float(np.exp(draw.uniform(np.log(0.05), np.log(5))))
    far = -2.641 * tabor ** (3 / 7) - 1
    return {
        "run": run,
        "tabor": tabor,
        "order": int(draw.integers(1, 3)),
        "perLength": float(draw.uniform(0.1, 0.25)),
        "approach": float(draw.uniform(far, 0.6 * tabor + 0.5)),
    }


def solve(data: dict) -> dict:
    """One run of the scene; what became of it."""
    root = float(np.sqrt(RADIUS * GAP))
    h = min(data["perLength"] * data["tabor"] ** -1.5, 0.2) * root
    flags = {
        "w": data["tabor"] ** 1.5 * MODULUS * GAP**2 / root,
        "h": h,
        "fine": max(2, 1.3 * data["tabor"] ** 0.8 + 1.5) * root,
        "grading": 2 / h,
        "order": data["order"],
        "u0": GAP * data["approach"],
        "vtu": 0,
        "estimate": 0,
    }
    words = [word for name, value in flags.items() for word in (f"-{name}", repr(value))]
    with tempfile.TemporaryDirectory() as folder:
        command = ["FreeFem++", "-nw", "-v", "0", "edp/scenes/adhesive-sphere.edp", *words, "-out", folder]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        summary = Path(folder) / "summary.json"
        found = json.loads(summary.read_text().replace("#end", "")) if summary.exists() else {}
    lines = done.stdout.strip().splitlines() or [""]
    message = found.get("message", lines[-1]) or ""
    found = {name: found.get(name) for name in ("stability", "newton", "backsolves")}
    return {**data, "code": done.returncode, **found, "message": message}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--loads", type=int, default=200, help="how many (default: %(default)s)")
    count = parser.parse_args().loads
    FILE.parent.mkdir(parents=True, exist_ok=True)
    known = {int(row["run"]) for row in campaign.read_rows(FILE)}
    for run in sorted(set(range(count)) - known):
        campaign.add_rows(FILE, COLUMNS, [solve(load(run))])
    done = [row for row in campaign.read_rows(FILE) if int(row["run"]) < count]
    stable = [row for row in done if row["code"] == "0" and float(row["stability"]) > 0]
    said = [row for row in done if row["code"] in ("10", "20") and row["message"]]
    print(f"{len(done)} loads: {len(stable)} stable, {len(said)} said which limit they met")
    if stable:
        newton = np.array([int(row["newton"]) for row in stable])
        solves = np.array([int(row["backsolves"]) for row in stable])
        print(f"linearisations: mean {newton.mean():.1f}, most {newton.max()}")
        mean, most = solves.sum() / newton.sum(), (solves / newton).max()
        print(f"back-substitutions a linearisation: mean {mean:.1f}, most {most:.1f}")
    for row in said:
        print(f"  run {row['run']}: {row['message']}")
    lost = [row["run"] for row in done if row not in stable and row not in said]
    if lost:
        print("lost:", *lost)
    return 1 if lost else 0


if __name__ == "__main__":
    raise SystemExit(main())
