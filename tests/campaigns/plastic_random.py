"""Random plastic bodies: `python tests/campaigns/plastic_random.py [COUNT]` writes results/plasticity/random.csv.

Each problem draws its dimension, size, mesh, material, hardening, friction and load path: a block on a clamped foot,
pressed by a rigid plane, ball or cylinder to a few times its strain at first yield, moved aside and released. A row has
the problem, the code of its run, iterations and energies. Code 1: a run failed, or its energies do not balance.
"""

import argparse
import sys
import tempfile
from pathlib import Path

import campaign
import numpy as np
import plasticity

sys.path[:0] = [str(campaign.ROOT / name) for name in ("tests", "edp/input")]
from input.test_parts import UNTURNED, Mesh, block, cube, turn_in_space  # noqa: E402

FILE = plasticity.FOLDER / "random.csv"


def problem(seed: int) -> tuple[str, str, dict]:
    """Mesh and case of a problem, and what it is."""
    rng = np.random.default_rng(seed)
    space = bool(rng.integers(2))
    size = rng.uniform(1, 3, 3) if space else rng.uniform(1, 3, 2)
    cells = tuple(int(n) for n in (rng.integers(2, 4, 3) if space else rng.integers(4, 9, 2)))
    limit = 10 ** rng.uniform(-0.5, 0.7)
    slope = float(rng.choice([0, 5, 50, 300]))
    kind = str(rng.choice(["linear", "table", "kinematic"]))
    hardening = f"{slope:g}"
    if kind == "table":
        rise = limit * (1 + np.cumsum(rng.uniform(0, 0.4, 3)))
        hardening = "table " + " ".join(f"{a} {b}" for a, b in zip((0.002, 0.01, 0.05), rise, strict=True))
    elif kind == "kinematic":
        hardening += f" kinematic {10 ** rng.uniform(0, 2.5)}"
    friction = float(rng.choice([0, 0.1, 0.4, 1.0]))
    state = "space" if space else str(rng.choice(["strain", "stress", "axisymmetric"]))
    matrix = turn_in_space(seed) if space and rng.integers(2) else UNTURNED
    up = np.array([0, 0, 1.0] if space else [0, 1.0, 0])
    shape = str(rng.choice(["plane", "ball"]))
    height = size[-1]
    top = matrix @ np.array([*(size[:2] / 2), height] if space else [size[0] / 2, height, 0])
    if state == "axisymmetric":
        top[0] = 0
    press = height * limit / 1000 * rng.uniform(1.2, 4)
    side = np.array([1.0, 0.4, 0] if space else [1.0, 0, 0]) * press * rng.uniform(0, 1) * (state != "axisymmetric")
    radius = rng.uniform(60, 200)
    numbers = 3 if space else 2
    text = lambda v: " ".join(repr(float(x)) for x in np.asarray(v)[:numbers])  # noqa: E731
    inward, outward = matrix @ -up, matrix @ up
    place = f"plane {text(top)} {text(inward)}"
    if shape == "ball":
        place = f"{'sphere' if space else 'circle'} {text(top + radius * outward)} R {radius!r}"
    rub = f" friction {friction:g}" if friction else ""
    down = matrix @ (-press * up)
    case = ("" if space else f"state {state}\n") + "body block E 1000 nu 0.3\n"
    case += f"plastic block {limit!r} {hardening}\nclamp bottom\n"
    if state == "axisymmetric":
        case += "symmetry left\n"
    steps = int(rng.integers(2, 5))
    case += f"leg {steps}\nobstacle top {place} move {text(down)}{rub}\n"
    case += f"leg {steps}\nobstacle top move {text(down + matrix @ side)}\n"
    case += f"leg 2\nobstacle top move {text(0.9 * down)}\n"
    mesh = cube(Mesh(), tuple(size), cells) if space else block(Mesh(), tuple(size), cells)
    row = {"seed": seed, "state": state, "shape": shape, "hardening": kind, "slope": slope, "friction": friction}
    return mesh.text(matrix), case, row


def solve(seed: int) -> dict:
    """The row of a problem."""
    mesh, case, row = problem(seed)
    with tempfile.TemporaryDirectory() as name:
        script = "edp/parts-3d.edp" if row["state"] == "space" else "edp/parts.edp"
        code, summary, _ = plasticity.solve(Path(name), mesh, case, "-estimate", 0, script=script)
    row["code"] = code
    if code:
        return row | {"message": summary.get("message", "")}
    found = summary["plastic"]
    stored = found["storedElastic"] + found["storedByHardening"]
    left = (found["work"] - stored - found["dissipated"]) / max(found["work"], 1e-300)
    names = "iterations", "mostIterations", "work", "dissipated"
    row |= {"strain": found["bodies"][0]["strainMax"], "left": left, **{key: found[key] for key in names}}
    return row | {"factorisations": summary["factorisations"], "ndof": summary["ndof"]}


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int, nargs="?", default=48)
    parser.add_argument("--first", type=int, default=0, help="the first problem's number")
    arguments = parser.parse_args(argv)
    rows = []
    for seed in range(arguments.first, arguments.first + arguments.count):
        rows.append(solve(seed))
        print(rows[-1], flush=True)
    plasticity.write(FILE, rows)
    failed = sum(row["code"] != 0 or abs(row["left"]) > 0.25 for row in rows)
    print(f"{len(rows)} problems, {failed} failed")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
