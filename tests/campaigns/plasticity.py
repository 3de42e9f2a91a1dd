"""Plastic bodies under a sphere and a cylinder: 48 problems, hardness, first yield: `make plasticity`.

A rigid sphere or cylinder of radius 1 is pressed into a large block with E = 1. In results/plasticity/, `grid.csv` has
a row for each of 48 problems: hardening 0.05, 0.01 and 1e-4 E, depth 1.6 to 80 times (cylinder: twice that) the
sphere's at first yield, in one load step or ten. `hardness.csv` has the mean pressure over Y at the end of a path
without hardening, `first.csv` the greatest elastic pressure over Y at first yield. With `--calculix` two meshed bodies
are solved by CalculiX too, where `ccx` is installed, on the same mesh and in the same steps. Code 1: a run of the grid
failed.
"""

import argparse
import csv
import json
import math
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import calculix
import campaign
import ccx
import numpy as np

FOLDER = campaign.RESULTS_FOLDER / "plasticity"
YOUNG_OVER_YIELD, POISSON = 400.0, 0.3
SHALLOW = 40000.0  # E over Y of the hardness: the slope of the surfaces stays small
MODULUS = 1 / (1 - POISSON**2)
HARDENING, DEPTHS, STEPS = (0.05, 0.01, 0.0001), (1.6, 5, 20, 80), (1, 10)
FLOWS = "plastic lower 0.5 1\nplastic upper 0.5 1\n"
GEOMETRY = """Point(1) = {{0, 0, 0, {h}}}; Point(2) = {{1, 0, 0, {h}}}; Point(3) = {{{L}, 0, 0, {L} / 6}};
Point(4) = {{{L}, -{L}, 0, {L} / 4}}; Point(5) = {{0, -{L}, 0, {L} / 4}}; Point(6) = {{0, -1, 0, 1.6 * {h}}};
Point(7) = {{1.2, -1.2, 0, 2 * {h}}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 5}}; Line(5) = {{5, 6}}; Line(6) = {{6, 1}};
Curve Loop(1) = {{1 : 6}}; Plane Surface(1) = {{1}}; Point{{7}} In Surface{{1}};
Physical Curve("top") = {{1}}; Physical Curve("bottom") = {{4}}; Physical Curve("left") = {{5, 6}};
Physical Surface("block") = {{1}};
"""


def geometry(h: float = 0.05, size: float = 12) -> str:
    """A block around the axis, or one half of it; its top from 0 to 1 may touch and has elements of size h."""
    return GEOMETRY.format(h=h, L=size)


class Indentation:
    """A problem in units of the block: 1 is 1.15 times the contact radius that an ideally plastic body would have."""

    def __init__(self, sphere: bool, hardening: float, depth: float, over: float = YOUNG_OVER_YIELD):
        """depth: over that of the sphere, or of the cylinder's formula in its place, at first yield; over: E over Y."""
        self.sphere, self.hardening, self.limit = sphere, hardening, 1 / over
        first = (1.60 if sphere else 1.67) * self.limit
        self.yielding = (math.pi / 2 if sphere else 2) * first / MODULUS  # the contact's radius or half-width then
        self.depth = depth * self.yielding**2
        self.unit = 1.15 * math.sqrt((2.2 if sphere else 1.6) * self.depth)
        yielding = 4 / 3 * self.yielding**3 if sphere else math.pi / 4 * self.yielding**2
        self.force = yielding * MODULUS

    def case(self, legs: list[tuple[int, float]], plastic: str | None = None) -> str:
        """The case's text; legs: load steps, and the share of the depth at the end."""
        text = f"state {'axisymmetric' if self.sphere else 'strain'}\nbody block E 1 nu {POISSON}\n"
        text += plastic if plastic is not None else f"plastic block {self.limit!r} {self.hardening!r}\n"
        text += "clamp bottom\nsymmetry left\n"
        radius = 1 / self.unit
        for steps, share in legs:
            text += f"leg {steps}\n" if steps else ""
            text += f"obstacle top circle 0 {radius!r} R {radius!r} move 0 {-share * self.depth / self.unit!r}\n"
        return text

    def row(self, force: float, radius: float) -> dict[str, float]:
        """Of a run's force on the meshed part and contact radius: force over that at first yield, pressure, radius."""
        a = radius * self.unit
        whole = force * self.unit**2 if self.sphere else 2 * force * self.unit
        mean = whole / (math.pi * a**2 if self.sphere else 2 * a) if a else 0.0
        return {"force": whole / self.force, "meanPressure": mean / self.limit, "strain": a / self.limit * MODULUS}


def solve(folder: Path, mesh: str, case: str, *flags, script: str = "edp/parts.edp") -> tuple[int, dict, list[dict]]:
    """Code, summary and series of a run."""
    place = folder / ("a.msh" if mesh.startswith("$") else "a.geo")
    place.write_text(mesh)
    (folder / "a.case").write_text(case)
    words = ["-mesh", place, "-case", folder / "a.case", "-vtu", 0, "-out", folder / "out", *flags]
    done = subprocess.run([*campaign.FREEFEM, script, *map(str, words)], cwd=campaign.ROOT, capture_output=True)
    series = folder / "out/series.csv"
    rows = list(csv.DictReader(series.read_text().splitlines())) if series.exists() else []
    return done.returncode, campaign.read_summary(folder / "out/summary.json"), rows


def problems() -> list[tuple[bool, float, float, int]]:
    shapes = [(sphere, (1 if sphere else 2)) for sphere in (True, False)]
    return [(s, h, times * d, n) for s, times in shapes for h in HARDENING for d in DEPTHS for n in STEPS]


def grid_row(sphere: bool, hardening: float, depth: float, steps: int, h: float = 0.05) -> dict:
    """One problem of the grid."""
    problem = Indentation(sphere, hardening, depth)
    with tempfile.TemporaryDirectory() as name:
        code, summary, _ = solve(Path(name), geometry(h), problem.case([(steps, 1)]), "-estimate", 0)
    row = {"sphere": int(sphere), "hardening": hardening, "depth": depth, "steps": steps, "code": code}
    if code:
        return row | {"message": summary.get("message", "")}
    found, flow = summary["contacts"][0], summary["plastic"]
    row |= problem.row(found["normalForce"], found["contactLength"])
    names = "newton", "backsolves", "factorisations", "ndof"
    row |= {"plasticStrain": flow["bodies"][0]["strainMax"], "most": flow["mostIterations"]}
    return row | {"iterations": flow["iterations"], **{key: summary[key] for key in names}}


def hardness(h: float, steps: int, depth: float) -> dict:
    """The end of a path of a sphere into an ideally plastic block."""
    problem = Indentation(True, 0.0, depth, SHALLOW)
    with tempfile.TemporaryDirectory() as name:
        code, summary, _ = solve(Path(name), geometry(h), problem.case([(steps, 1)]), "-estimate", 0)
    if code:
        return {"depth": depth, "steps": steps, "code": code}
    found = summary["contacts"][0]
    return {"depth": depth, "steps": steps, "code": 0} | problem.row(found["normalForce"], found["contactLength"])


def first_yield(sphere: bool, h: float = 0.04, steps: int = 20) -> tuple[float, float]:
    """Greatest pressure of the elastic contact, by Hertz from the force, over Y: before and after the first yield."""
    problem = Indentation(sphere, 0.0, 1.2 if sphere else 5.0)
    with tempfile.TemporaryDirectory() as name:
        legs = [(1, 0.75 if sphere else 0.4), (steps, 1)]
        _, _, rows = solve(Path(name), geometry(h, 24), problem.case(legs), "-estimate", 0)
    yields = [float(row["plasticStrain"]) > 0 for row in rows].index(True)
    return tuple(hertz(problem, float(rows[k]["force"])) for k in (yields - 1, yields))


def hertz(problem: Indentation, force: float) -> float:
    """The greatest pressure over Y of an elastic contact with this force on the meshed part."""
    if problem.sphere:
        return (6 * force * problem.unit**2 * MODULUS**2 / math.pi**3) ** (1 / 3) / problem.limit
    return math.sqrt(2 * force * problem.unit * MODULUS / math.pi) / problem.limit


def beside_calculix(
    size: float, steps: int, penalty: float, space: bool = False, friction: bool = False, longest: int = 600
) -> dict:
    """Forces of this package and of CalculiX: two plastic bodies, one mesh, the same steps.

    In the plane a cylinder on a block, with friction it is dragged too; in space a quarter of a ball on a block.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        mesh = calculix.meshed(folder, size, space)
        start = calculix.CASE.split("leg 1")[0]
        case = start if friction else start.replace(f" friction {calculix.FRICTION}", "")
        case += FLOWS + f"leg {steps}\nmove pushed 0 -{calculix.PRESS}\n"
        if friction:
            case += f"leg {steps}\nmove pushed {calculix.DRAG} -{calculix.PRESS}\n"
        if space:
            case = calculix.CASE_SPACE.replace("move", FLOWS + f"leg {steps}\nmove")
        read = ccx.mesh_of(mesh)
        deck = ccx.Deck(read, case, ccx.Contact(penalty, penalty / 10), direct=True)
        done = ccx.solve(folder, read, deck.text(), longest)
        (folder / "a.case").write_text(case)
        words = ["-mesh", mesh, "-case", folder / "a.case", "-vtu", "0", "-estimate", "0", "-out", folder / "out"]
        script = "edp/parts-3d.edp" if space else "edp/parts.edp"
        subprocess.run([*campaign.FREEFEM, script, *map(str, words)], cwd=campaign.ROOT, capture_output=True)
        summary = json.loads((folder / "out/summary.json").read_text())
    here = -np.array(next(one for one in summary["supports"] if one["name"].startswith("clamp"))["force"])
    there = np.array(done.reactions[-1][: read.axes])
    if space:  # across a symmetry the nodes of both supports share the rest
        here, there = here[2:], there[2:]
    strain = max(body["strainMax"] for body in summary["plastic"]["bodies"])
    return {
        "force": here.tolist(),
        "calculix": there.tolist(),
        "off": float(np.linalg.norm(here - there) / np.linalg.norm(there)),
        "increments": done.increments,
        "plasticStrain": strain,
    }


def write(path: Path, rows: list[dict]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    names = list(dict.fromkeys(key for row in rows for key in row))
    path.unlink(missing_ok=True)
    campaign.add_rows(path, names, rows)


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of the CSV files")
    parser.add_argument("--calculix", action="store_true", help="only the comparison with CalculiX")
    arguments = parser.parse_args(argv)
    if arguments.calculix:
        if not shutil.which("ccx"):
            parser.error("no ccx here; apt-get install calculix-ccx")
        for size, steps, space, friction in ((0.02, 20, False, False), (0.02, 20, False, True), (0.03, 4, True, False)):
            calculix.say(beside_calculix(size, steps, 1e6, space, friction))
        return 0
    rows = []
    for problem in problems():
        rows.append(grid_row(*problem))
        calculix.say(rows[-1])
    write(arguments.out / "grid.csv", rows)
    first = [dict(zip(("before", "after"), first_yield(sphere), strict=True)) for sphere in (True, False)]
    path = [hardness(0.02, steps, 400) for steps in (10, 20, 40)]
    write(arguments.out / "first.csv", first)
    write(arguments.out / "hardness.csv", path)
    for row in (*first, *path):
        calculix.say(row)
    failed = sum(row["code"] != 0 for row in rows)
    factorised = max(row.get("factorisations", 0) for row in rows)
    print(f"{len(rows)} problems, {failed} failed, at most {factorised} factorisation")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
