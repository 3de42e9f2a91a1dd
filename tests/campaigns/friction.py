"""Does the step with friction come to equilibrium, and in how many linearisations? Paths of loads, drawn at random.

Kinds of paths, their laws of stiffness 1 to 1e12 and hard contact:
  plane   disc on block, P1, P2 and P4, 21 to 301 points, friction 0.01 to 1.5, prescribed approaches and forces, five
          sorts of legs
  loads   the same, friction 0.05 to 5, nu 0 to 0.45, six legs of any size
  space   sphere on block, friction 0.1 to 1.5, approaches or forces; the drag turns, or goes anywhere
  bodies  two cylinders on meshes that do not match, unlike in modulus and nu, nodal or averaged, friction 0.1 to 1
  fit, belt, wedge, clip, block   own parts that statics allows, friction 0.02 to 1: rings pressed together, pulled or
          not; belts on pulleys; wedges pressed in and let go; a clip over a pipe; a block pressed and dragged

A row per load step in results/friction/steps.csv; interrupted and started again, it goes on where it was. Loads without
equilibrium say so and are not counted. Exit code 1 if a step is neither.
"""

import argparse
import csv
import json
import os
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import campaign
import numpy as np

from postprocess.progress import Progress, expect

ROOT = Path(__file__).resolve().parents[2]
FILE = campaign.RESULTS_FOLDER / "friction" / "steps.csv"
COLUMNS = "kind run step newton backsolves friction kappa points code message".split()
TURNS = [(1, 0), (1, 0.05), (1, 0.2), (1, 1), (1, -0.2), (0.5, -0.2), (1.25, 0.3)]
TOGETHER = [(0.2 * k, 0.04 * k) for k in range(1, 6)]
CYCLES = [(1, 0), (1, 0.15), (1, -0.15), (1, 0.15), (1, -0.15)]
FIXED = (TURNS, TOGETHER, CYCLES)


SCRIPTS = {"plane": "fretting", "loads": "fretting", "space": "fretting-3d", "bodies": "fretting-bodies"}
PARTS = {"fit": 60, "belt": 30, "wedge": 50, "clip": 20, "block": 40}
DEFAULT_RUNS = 10.0  # that a path takes, a mean
PATHS = {"plane": 380, "loads": 90, "space": 20, "bodies": 40} | PARTS


def legs_of(legs) -> str:
    return ", ".join(" ".join(f"{share:.6g}" for share in leg) for leg in legs)


def law_of(draw) -> dict:
    kappa = draw.choice([1, 1e3, 1e6, 1e12, np.inf])
    return (
        {"law": "power", "kappa": kappa, "m": 3, "d0": -1e-9} if np.isfinite(kappa) else {"law": "signorini", "d0": 0}
    )


def between(draw, low: float, high: float) -> float:
    """Of one decade as often as of another."""
    return float(np.exp(draw.uniform(np.log(low), np.log(high))))


def plane(draw) -> dict:
    order = int(draw.choice([1, 2, 2, 2, 4]))
    spacing = between(draw, 16 / 300, 16 / 20)
    kappa = draw.choice([1, 1e3, 1e6, 1e12, np.inf])
    friction = between(draw, 0.01, 1.5)
    kind = int(draw.integers(0, 5))
    legs = FIXED[kind] if kind < 3 else [(draw.uniform(0.1, 1.2), draw.uniform(-1, 1)) for _ in range(6)]
    flags = {"order": order, "h": order * spacing, "reach": 8, "grading": 20, "nu": float(draw.uniform(0, 0.45))}
    flags |= {"friction": friction, "u0": 2, "drag": 1, "force": 0, "shear": 0, "legs": legs_of(legs)}
    if np.isfinite(kappa):
        flags |= {"law": "power", "kappa": kappa, "m": 3, "d0": -1e-9}
    if draw.random() < 0.3:  # a force presses, and in half of these one pulls
        flags |= {"force": 250}
        if draw.random() < 0.5:
            flags |= {"drag": 0, "shear": 0.9 * friction * 100 * min(press for press, _ in legs)}
    return flags


def loads(draw) -> dict:
    flags = {"order": 2, "h": between(draw, 0.15, 1), "reach": 8, "grading": 20, "force": 0, "shear": 0, "u0": 2}
    legs = [(between(draw, 0.02, 1.2), draw.uniform(-1, 1)) for _ in range(6)]
    flags |= {"nu": float(draw.uniform(0, 0.45)), "friction": between(draw, 0.05, 5), "legs": legs_of(legs)}
    return flags | law_of(draw) | {"drag": between(draw, 0.01, 2)}


def space(draw) -> dict:
    turns = np.cumsum(draw.uniform(0.3, 1.2, 6))
    round_about = [(1, np.cos(t), np.sin(t)) for t in turns]
    anywhere = [(draw.uniform(0.2, 1.2), draw.uniform(-1, 1), draw.uniform(-1, 1)) for _ in range(6)]
    legs = [(1,), *(round_about if draw.random() < 0.5 else anywhere)]
    friction = between(draw, 0.1, 1.5)
    flags = {
        "h": between(draw, 1.2, 2.5),
        "u0": 0.5,
        "gap": 0,
        "nu": float(draw.uniform(0, 0.45)),
        "friction": friction,
    }
    flags |= law_of(draw) | {"drag": between(draw, 0.01, 0.5), "legs": legs_of(legs)}
    if draw.random() < 0.3:
        flags |= {"force": 100, "drag": 0, "shear": 0.7 * friction * 100 * min(1, *(leg[0] for leg in legs))}
    return flags


def bodies(draw) -> dict:
    flags = {"h": between(draw, 0.04, 0.3), "ratio": between(draw, 0.6, 2.3), "friction": between(draw, 0.1, 1)}
    flags |= {
        "E2": 100 * between(draw, 0.1, 10),
        "nu1": float(draw.uniform(0, 0.45)),
        "nu2": float(draw.uniform(0, 0.45)),
    }
    legs = [(draw.uniform(0.2, 1.2), draw.uniform(-1, 1)) for _ in range(6)]
    flags |= law_of(draw) | {"points": str(draw.choice(["nodal", "segment"])), "legs": legs_of(legs)}
    if draw.random() < 0.5:
        return flags | {"force": 0, "shear": 0, "u0": 0.2, "drag": between(draw, 0.005, 0.2)}
    return flags | {"shear": 0.8 * flags["friction"] * 8.631 * min(press for press, _ in legs)}


def closed(lines: list[str], names: dict, body: str, first: int) -> str:
    """gmsh's geometry of a body in the plane: its sides, each as gmsh writes it, numbered from the first on."""
    sides = [f"{line.split('{')[0]}({first + k}) = {{{line.split('{')[1]};" for k, line in enumerate(lines)]
    sides += [
        f"Curve Loop({first}) = {{{first} : {first + len(lines) - 1}}};",
        f"Plane Surface({first}) = {{{first}}};",
    ]
    sides += [f'Physical Curve("{name}") = {{{", ".join(str(first + k) for k in of)}}};' for name, of in names.items()]
    return "\n".join([*sides, f'Physical Surface("{body}") = {{{first}}};', ""])


def polygon(body: str, corners: list, names: dict, first: int) -> str:
    count = len(corners)
    points = [f"Point({first + k}) = {{{x}, {y}, 0}};" for k, (x, y) in enumerate(corners)]
    lines = [f"Line{{{first + k}, {first + (k + 1) % count}}}" for k in range(count)]
    return "\n".join([*points, closed(lines, names, body, first)])


def stuff(draw, *names: str) -> str:
    return "".join(f"body {name} E {between(draw, 1e3, 1e5):.6g} nu {draw.uniform(0, 0.45):.6g}\n" for name in names)


def fit(draw) -> tuple[str, str]:
    radii = np.cumsum([draw.uniform(1, 5), draw.uniform(2, 8), 0, draw.uniform(1.5, 8)])
    mesh = 'SetFactory("OpenCASCADE");\n'
    for k, (radius, name) in enumerate(zip(radii, ("bore", "seat", "hole", "rim"), strict=True), 1):
        mesh += f"Circle({k}) = {{0, 0, 0, {radius}}};\nCurve Loop({k}) = {{{k}}};\n"
        mesh += f'Physical Curve("{name}") = {{{k}}};\n'
    mesh += "Plane Surface(1) = {2, 1};\nPlane Surface(2) = {4, 3};\n"
    mesh += 'Physical Surface("shaft") = {1};\nPhysical Surface("hub") = {2};\n'
    for place in ":3":
        mesh += f"MeshSize{{{place}}} = {between(draw, 0.1, 0.3) * radii[1]};\n"
    overlap = between(draw, 1e-4, 2e-3) * radii[1]
    text = f"state {draw.choice(['stress', 'strain'])}\n" + stuff(draw, "shaft", "hub")
    text += f"contact hole seat interference {overlap:.6g} friction {between(draw, 0.02, 1):.6g}\nclamp bore\n"
    pulled = draw.uniform(0, 0.1) * 1e3 * overlap / radii[3] if draw.random() < 0.5 else 0
    return mesh, text + (f"traction rim {pulled:.6g} 0\n" if pulled else "")


def belt(draw) -> tuple[str, str]:
    thick, quarter = between(draw, 0.1, 0.5), draw.random() < 0.4
    mesh = "Point(1) = {0, 0, 0};\n"
    for k, r in ((10, 10), (20, 10 + thick)):
        ends = [(r, -2), (r, 0), (0, r), *([(-2, r)] if quarter else [(-r, 0), (-r, -2)])]
        mesh += "".join(f"Point({k + j}) = {{{x}, {y}, 0}};\n" for j, (x, y) in enumerate(ends))
    last = len(ends) - 1
    lines = ["Line{10, 11}", *(f"Circle{{{10 + j}, 1, {11 + j}}}" for j in range(1, last - 1))]
    lines += [
        f"Line{{{9 + last}, {10 + last}}}",
        f"Line{{{10 + last}, {20 + last}}}",
        f"Line{{{20 + last}, {19 + last}}}",
    ]
    lines += [*(f"Circle{{{21 + j}, 1, {20 + j}}}" for j in range(last - 2, 0, -1)), "Line{21, 20}", "Line{20, 10}"]
    names = {"inner": range(1, last - 1), "tight": [last], "slack": [len(lines) - 1]}
    mesh += closed(lines, names, "belt", 1) + f"Mesh.MeshSizeMax = {between(draw, 0.5, 1.2)};\n"
    pull = "{} 0" if quarter else "0 {}"
    text = f"body belt E 2000 nu 0.3\nobstacle inner circle 0 0 R 10 friction {between(draw, 0.02, 1):.6g}\nleg 1\n"
    text += (
        f"traction slack 0 -{between(draw, 0.3, 3):.6g}\nmove tight {pull.format(-0.02)}\nleg {draw.integers(1, 5)}\n"
    )
    return mesh, text + f"move tight {pull.format(-draw.uniform(0.1, 1))}\n"


def wedge(draw) -> tuple[str, str]:
    slope = draw.uniform(0.05, 0.6)
    corners = [(0, 0), (0.5, 0), (0.5 + slope, 1), (0, 1)]
    mesh = polygon("wedge", corners, {"flank": [1], "head": [2], "mirror": [3]}, 1)
    text = stuff(draw, "wedge") + f"obstacle flank plane 0.5 0 -1 {slope} friction {between(draw, 0.02, 1):.6g}\n"
    text += "symmetry mirror\nleg 1\ntraction head 0 -10\nleg 4\ntraction head 0 -0.5\n"
    return mesh + f"Mesh.MeshSizeMax = {between(draw, 0.05, 0.25)};\n", text


def clip(draw) -> tuple[str, str]:
    at = [(0, 0), (0, -10), (0, -12), (6, -12 * 0.75**0.5)]
    at += [(r * np.cos(25 * np.pi / 180), r * np.sin(25 * np.pi / 180)) for r in (12, 10, 11)]
    mesh = "".join(f"Point({k}) = {{{x}, {y}, 0}};\n" for k, (x, y) in enumerate(at, 1))
    lines = ["Line{2, 3}", "Circle{3, 1, 4}", "Circle{4, 1, 5}", "Circle{5, 7, 6}", "Circle{6, 1, 2}"]
    mesh += closed(lines, {"mid": [0], "foot": [1], "tip": [3, 4]}, "clip", 1)
    text = "state stress\nbody clip E 2600 nu 0.35\nclamp foot\nsymmetry mid\nobstacle tip circle 0 16 R 10 "
    text += f"move 0 {-draw.uniform(1, 5):.6g} friction {between(draw, 0.02, 0.4):.6g}\n"
    return mesh + f"Mesh.MeshSizeMax = {between(draw, 0.3, 0.8)};\n", text


def block(draw) -> tuple[str, str]:
    low = polygon("low", [(-2, -1), (2, -1), (2, 0), (-2, 0)], {"base": [0], "top": [2]}, 1)
    up = polygon("up", [(-1, 0), (1, 0), (1, 0.5), (-1, 0.5)], {"foot": [0], "head": [2]}, 11)
    friction, press = between(draw, 0.02, 1), between(draw, 0.1, 10)
    text = (
        stuff(draw, "low", "up")
        + f"contact foot top friction {friction:.6g}\nclamp base\nleg 1\npressure head {press}\n"
    )
    text += f"traction head 0 0\nleg {draw.integers(1, 4)}\npressure head {press}\n"
    text += f"traction head {draw.uniform(-0.95, 0.95) * friction * press:.6g} 0\n"
    return low + up + f"Mesh.MeshSizeMax = {between(draw, 0.08, 0.4)};\n", text


DRAWN = {"plane": plane, "loads": loads, "space": space, "bodies": bodies}
DRAWN |= {"fit": fit, "belt": belt, "wedge": wedge, "clip": clip, "block": block}


def load(kind: str, run: int, folder: Path) -> list[str]:
    """The run's flags; its number is the seed; mesh and case of own parts are written."""
    drawn = DRAWN[kind](np.random.default_rng(run))
    if kind in PARTS:
        names = {"mesh": folder / "mesh.geo", "case": folder / "a.case"}
        for name, text in zip(names.values(), drawn, strict=True):
            name.write_text(text)
        drawn = names | ({"distance": "exact"} if kind != "belt" and run % 2 else {})
    flags = drawn | {"vtu": 0, "estimate": 0}
    return [word for name, value in flags.items() for word in (f"-{name}", str(value))]


def solve(one: tuple[str, int]) -> list[dict]:
    """One path; what became of its steps."""
    kind, run = one
    with tempfile.TemporaryDirectory() as place:
        flags = load(kind, run, Path(place))
        given, folder = dict(zip(flags[::2], flags[1::2], strict=True)), Path(place) / "out"
        script = "edp/parts.edp" if kind in PARTS else f"edp/scenes/{SCRIPTS[kind]}.edp"
        command = ["FreeFem++", "-nw", "-v", "0", script, *flags, "-out", folder]
        done = subprocess.run(
            command, cwd=ROOT, capture_output=True, text=True, env=os.environ | {"OPENBLAS_NUM_THREADS": "1"}
        )
        series, contact = Path(folder) / "series.csv", Path(folder) / "contact.csv"
        steps = list(csv.DictReader(series.read_text().splitlines())) if series.exists() else []
        points = len(contact.read_text().splitlines()) - 1 if contact.exists() else 0
        if not steps and not done.returncode:  # a case without legs is one step
            summary = json.loads((Path(folder) / "summary.json").read_text())
            steps = [{"step": 1, "newton": summary["newton"], "backsolves": summary["backsolves"]}]
    common = {
        "kind": kind,
        "run": run,
        "friction": given.get("-friction", ""),
        "kappa": given.get("-kappa", "hard"),
        "points": points,
    }
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


def report(kind: str, done: list[dict]) -> int:
    """Counts of the steps that are solved; how many are neither solved nor without equilibrium."""
    good = [row for row in done if row["code"] == "0"]
    said = [row for row in done if row["code"] == "20" and "gross sliding" in row["message"]]
    failed = [row for row in done if row not in good and row not in said]
    print(f"{kind}: {len(good)} steps solved, {len(said)} without equilibrium, {len(failed)} failed")
    for what in ("newton", "backsolves") if good else ():
        counts = np.array([int(row[what]) for row in good])
        print(f"  {what}: mean {counts.mean():.2f}, 95 % {np.percentile(counts, 95):.0f}, most {counts.max()}")
    for row in failed:
        print(f"  run {row['run']} step {row['step']}: {row['message']}")
    return len(failed)


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"of {', '.join(PATHS)} (default: all)")
    parser.add_argument(
        "--paths", type=int, help=f"how many of each kind (default: {', '.join(map(str, PATHS.values()))})"
    )
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time (default 2: they are counted, not timed)")
    parser.add_argument("--out", type=Path, default=FILE, help="the CSV file")
    arguments = parser.parse_args(argv)
    if unknown := set(arguments.kinds) - set(PATHS):
        parser.error(f"no such kind: {', '.join(sorted(unknown))}; allowed: {', '.join(PATHS)}")
    wanted = [
        (kind, run)
        for kind, count in PATHS.items()
        if kind in (arguments.kinds or PATHS)
        for run in range(count if arguments.paths is None else arguments.paths)
    ]
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    known = {(row["kind"], int(row["run"])) for row in campaign.read_rows(arguments.out)}
    todo = [one for one in wanted if one not in known]
    weights = expect("friction", [None] * len(todo), [DEFAULT_RUNS] * len(todo), arguments.jobs, campaign.FREEFEM)
    progress = Progress("friction", sum(weights), len(todo))
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for weight, found in zip(weights, pool.map(solve, todo), strict=True):
            campaign.add_rows(arguments.out, COLUMNS, found)
            progress.step(weight, all(row["code"] == 0 for row in found))
    done = [row for row in campaign.read_rows(arguments.out) if (row["kind"], int(row["run"])) in wanted]
    lost = [report(kind, [row for row in done if row["kind"] == kind]) for kind in dict.fromkeys(k for k, _ in wanted)]
    return 1 if any(lost) else 0


if __name__ == "__main__":
    raise SystemExit(main())
