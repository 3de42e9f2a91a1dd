"""Does the stable step come to a stable state? Loads of surfaces that attract, drawn at random, each from rest.

Tabor's number between 0.05 and 5, P1 and P2, elements of 0.1 to 0.25 cohesive lengths, approaches from far apart to
deep in contact. A row per run in results/attraction/loads.csv; interrupted and started again, it goes on where it was.
The end says how many were stable, how many said which limit they had met, and exits with 1 if a run did neither.
"""

import argparse

import campaign
import numpy as np

FILE = campaign.RESULTS_FOLDER / "attraction" / "loads.csv"
MODULUS, RADIUS, GAP = 100 / 0.91, 10, 1e-3  # the scene's E/(1 - nu^2), R, eps0


def load(run: int) -> campaign.Case:
    """The run of this number, which is the seed of what is drawn."""
    draw = np.random.default_rng(run)
    tabor, order = float(np.exp(draw.uniform(np.log(0.05), np.log(5)))), int(draw.integers(1, 3))
    per_length, share = draw.uniform(0.1, 0.25), draw.random()
    far, near = -2.641 * tabor ** (3 / 7) - 1, 0.6 * tabor + 0.5
    root = float(np.sqrt(RADIUS * GAP))
    h = float(min(per_length * tabor**-1.5, 0.2) * root)
    flags = {"w": tabor**1.5 * MODULUS * GAP**2 / root, "h": h, "fine": max(2, 1.3 * tabor**0.8 + 1.5) * root}
    flags |= {"grading": 2 / h, "order": order, "u0": float(GAP * (far + share * (near - far))), "estimate": 0}
    return campaign.case(f"load {run}", "adhesive-sphere", **flags)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--loads", type=int, default=200, help="how many (default: %(default)s)")
    cases = [load(run) for run in range(parser.parse_args().loads)]
    done = campaign.run(cases, FILE, columns=["stability"], measure=lambda *_: stability)
    stable = [row for row in done if row["status"] == "converged" and float(row["stability"]) > 0]
    said = [row for row in done if row["status"] in ("refused", "not converged") and row["message"]]
    print(f"{len(done)} loads: {len(stable)} stable, {len(said)} said which limit they met")
    if stable:
        newton, solves = (np.array([int(row[name]) for row in stable]) for name in ("newton", "backsolves"))
        print(f"linearisations: mean {newton.mean():.1f}, most {newton.max()}")
        mean, most = solves.sum() / newton.sum(), (solves / newton).max()
        print(f"back-substitutions a linearisation: mean {mean:.1f}, most {most:.1f}")
    for row in said:
        print(f"  {row['name']}: {row['message']}")
    lost = [row["name"] for row in done if row not in stable and row not in said]
    if lost:
        print("lost:", *lost)
    return 1 if lost else 0


def stability(_item: campaign.Case, summary: dict, _folder) -> dict:
    return {"stability": summary["stability"]}


if __name__ == "__main__":
    raise SystemExit(main())
