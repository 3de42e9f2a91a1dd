"""The package beside CalculiX on five parts: two are in space, two have friction. `results/bench/calculix-parts.csv`.

Both programs read one mesh of second order and one case file. The package runs with its defaults: hard contact, with ±.
CalculiX takes contact face to face, by a penalty; a run with ten times this penalty shows whether it is stiff enough.
A finer mesh shows which program is nearer. Seconds are CPU seconds (user and system) of whole programs on one thread:
the programs take turns, and the row has the median of ROUNDS. `make tables` writes the tables of tests/RESULTS.md.
"""

import argparse
import json
import shutil
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import campaign
import ccx
import numpy as np
from campaign import markdown

FILE = campaign.RESULTS_FOLDER / "bench" / "calculix-parts.csv"
ROUNDS, LONGEST = 3, 1800
COLUMNS = "name script flags sources repeats cpu plain unknowns iterations numbers message".split() + campaign.MACHINE
PACKAGE, CALCULIX, STIFFER = COLUMNS_OF_TABLE = "package", "CalculiX", "CalculiX, ten times the penalty"


@dataclass(frozen=True)
class Part:
    """A geometry, a case with one line, and what is compared: see `numbers`."""

    name: str
    geo: str
    case: str
    size: str  # a number of the geometry, with its values for the usual and the finer mesh
    sizes: tuple[float, float]
    penalty: float  # pressure/length
    axis: int  # of the contact force
    patch: tuple[tuple[float, ...], tuple[float, ...]] | None = None  # middle and half axes: see `mean`
    greatest: bool = False  # whether the greatest pressure is finite

    @property
    def line(self) -> tuple[list[float], list[float]]:
        words = next(line for line in self.case.splitlines() if line.startswith("line ")).split("#")[0].split()[2:]
        numbers = [float(word) for word in words]
        return numbers[: len(numbers) // 2], numbers[len(numbers) // 2 :]

    @property
    def space(self) -> bool:
        return len(self.line[0]) == 3

    def meshed(self, folder: Path, finer: bool = False) -> Path:
        (folder / "a.geo").write_text(self.geo)
        numbers = "-setnumber", self.size, f"{self.sizes[finer]:g}"
        words = [f"-{2 + self.space}", "-order", "2", "-format", "msh22", "-v", "0", *numbers]
        subprocess.run(["gmsh", *words, "a.geo", "-o", "a.msh"], cwd=folder, check=True)
        return folder / "a.msh"

    def numbers(self, force, pressure: np.ndarray, weight, place, stress: np.ndarray, moved: np.ndarray) -> dict:
        """Name to (value, error or None). Pressures, weights and places are those of the contact points or nodes.

        stress: (tensor xx yy zz xy yz xz, error) at the line's first end; moved: (displacement, error) at its last.
        """
        first, last = (", ".join(f"{x:g}" for x in end) for end in self.line)
        found = {f"contact force, N{'' if self.space or 'axisymmetric' in self.case else '/mm'}": force}
        if self.greatest:
            found["greatest pressure, MPa"] = pressure.max(), None
        if self.patch:
            found["mean pressure, MPa"] = mean(pressure, weight, place, *self.patch), None
        found[f"von Mises stress at ({first}), MPa"] = (von_mises(stress[0]), stress[1])
        found[f"displacement of ({last}), µm"] = tuple(e and 1e3 * e for e in moved)
        return found


def mean(pressure, weight, place, middle, axes) -> float:
    """The mean over an ellipsoid, weighted by 1 - r^2, which is 1 in its middle and 0 at its edge."""
    radius = ((place - middle) / axes)[:, np.isfinite(axes)]
    weight = weight * np.maximum(0, 1 - (radius**2).sum(axis=1))
    return float(pressure @ weight / weight.sum())


def von_mises(tensor) -> float:
    xx, yy, zz, *shears = tensor
    return float(np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * np.square(shears).sum()))


def example(name: str, *changes: tuple[str, str], more: str = "") -> tuple[str, str, str]:
    """Name, geometry and case file of an example, the case with changes, the geometry with more groups."""
    folder = campaign.ROOT / "edp" / "examples" / name
    case = (folder / f"{name}.case").read_text()
    for old, new in changes:
        assert old in case, (name, old)
        case = case.replace(old, new)
    return name, (folder / f"{name}.geo").read_text() + more, case


def own(name: str) -> tuple[str, str, str]:
    folder = Path(__file__).parent / "calculix-parts"
    return name, (folder / f"{name}.geo").read_text(), (folder / f"{name}.case").read_text()


SLEEVE = example(
    "bolted-sleeve",
    *((f"group    {line}\n", "") for line in ("under  between bolt sleeve", "cut    plane 2.5 20  0 1")),
    *((f"group    {line}\n", "") for line in ("middle plane 0 0  0 1", "top    plane 0 47  0 1")),
    ("40e3", "15e3\nline     shank 2.5 30  2.5 45"),
    more='Physical Curve("under") = {8}; Physical Curve("cut") = {3}; Physical Curve("middle") = {1, 12};\n'
    'Physical Curve("top") = {10};\n',
)
TAPER = example("taper", ("clamp ", "line     plug 5 15  5 38\nclamp "))
ALL = np.inf
PARTS = [
    Part(*example("shrink-fit"), "edges", (24, 48), 1e6, 0, greatest=True),
    Part(*TAPER, "size", (2, 1), 1e6, 0, ((0, 15), (ALL, 8))),
    Part(*SLEEVE, "size", (0.8, 0.4), 1e6, 1, ((7, 0), (0.8, ALL))),
    Part(*own("ball-in-groove"), "size", (0.1, 0.08), 1e7, 2, ((0, 0, 0), (0.6, 0.15, ALL)), greatest=True),
    Part(*own("lug"), "size", (2, 1.6), 1e6, 0, ((-8, 0, 2), (8, 5, 3.5))),
]


def package(part: Part, mesh: Path, folder: Path, *flags) -> tuple[float, dict, dict]:
    """CPU seconds, summary and numbers of a run with its defaults."""
    (folder / "a.case").write_text(part.case)
    words = ["-mesh", mesh, "-case", folder / "a.case", "-vtu", 0, "-out", folder / "out", *flags]
    command = [*campaign.FREEFEM, campaign.script_of(f"parts{'-3d' * part.space}"), *words]
    seconds, code, said = ccx.timed(command, campaign.ROOT, LONGEST)
    if code:
        raise RuntimeError(f"{part.name}: code {code}: {said.strip().splitlines()[-1]}")
    summary = campaign.read_summary(folder / "out/summary.json")
    if "-estimate" in flags:
        return seconds, summary, {}
    points = campaign.read_contact(folder / "out")
    (line,) = (folder / "out").glob("line-*.csv")
    rows = np.genfromtxt(line, delimiter=",", names=True)[[0, -1]]
    tensor = [rows[0][f"stress{name}"] for name in "XX YY ZZ XY YZ XZ".split()]
    moved = [rows[1][f"u{axis}"] for axis in "xyz"[: 2 + part.space]]
    estimates = summary["estimates"]["contacts"][0]
    told, normal = summary["contacts"][0]["force"][part.axis], estimates["normalForce"]
    force = abs(told), estimates["force"]["error"]
    if force[0] < 1e-6 * normal["value"]:  # a contact that symmetries close around a body has no resultant
        towards = points[f"normal{'XYZ'[part.axis]}"]
        whole = abs(points["pressure"] @ (points["weight"] * towards))
        force = whole, normal["error"] * whole / normal["value"]
    place = np.column_stack([points[axis] for axis in "xyz"[: 2 + part.space]])
    numbers = part.numbers(
        force,
        *(points["pressure"], points["weight"], place),
        (tensor, rows[0]["vonMisesError"]),
        (float(np.linalg.norm(moved)), rows[1]["displacementError"]),
    )
    if part.greatest:
        greatest = estimates["pressureMax"]
        numbers["greatest pressure, MPa"] = greatest["value"], greatest["error"]
    return seconds, summary, numbers


def calculix(part: Part, mesh: Path, folder: Path, penalty: float) -> tuple[ccx.Result, dict]:
    """A run of ccx and its numbers; none if it did not end."""
    read = ccx.mesh_of(mesh)
    made = ccx.Deck(read, part.case, ccx.Contact(penalty, penalty / 10))
    done = ccx.solve(folder, read, made.text(), LONGEST)
    if done.message:
        return done, {}
    slave = read.nodes(made.pairs[0].slave)
    weight = read.weights(made.pairs[0].slave, made.state == "axisymmetric")[slave]
    at = [read.at(np.array(end)) for end in part.line]
    stress, moved = (
        shape @ done.fields[name][nodes] for (nodes, shape), name in zip(at, ("STRESS", "DISP"), strict=True)
    )
    force = abs(done.contacts[-1][part.axis]) * made.circle, None
    pressure = done.fields["CONTACT"][slave, 3]
    displacement = float(np.linalg.norm(moved)), None
    return done, part.numbers(force, pressure, weight, read.place[slave, : read.axes], (stress, None), displacement)


# ---------------------------------------------------------------- the campaign


def runs(part: Part, finer: bool) -> dict[str, tuple[campaign.Case, float]]:
    """The rows of a part on a mesh, and CalculiX's penalties; on the finer mesh only ten times the usual one."""
    size = f"{part.size} {part.sizes[finer]:g}"
    found = {PACKAGE: (campaign.Case(part.name, PACKAGE, (size,)), 0.0)}
    for which in (STIFFER,) if finer else (CALCULIX, STIFFER):
        penalty = part.penalty * (10 if which == STIFFER else 1)
        found[which] = campaign.Case(part.name, CALCULIX, (size, f"penalty {penalty:g}")), penalty
    return found


def cases(root: Path = campaign.ROOT) -> list[campaign.Case]:
    return [item for part in PARTS for finer in (False, True) for item, _ in runs(part, finer).values()]


def measured(part: Part, finer: bool) -> list[dict]:
    """Rows of a part on a mesh, the programs in turns; the finer mesh and ten times the penalty once."""
    rows, spent = {}, {}
    with tempfile.TemporaryDirectory(prefix="parts-") as name:
        folder = Path(name)
        path = part.meshed(folder, finer)
        for turn in range(1 if finer else ROUNDS):
            for which, (item, penalty) in runs(part, finer).items():
                if turn and which == STIFFER:
                    continue
                cpu, plain = spent.setdefault(which, ([], []))
                row = rows.setdefault(which, {"name": item.name, "script": item.script, "flags": " ".join(item.flags)})
                if which == PACKAGE:
                    seconds, summary, numbers = package(part, path, folder)
                    plain.append(package(part, path, folder, "-estimate", 0)[0])
                    row |= {"unknowns": summary["ndof"], "iterations": summary["newton"]}
                else:
                    done, numbers = calculix(part, path, folder, penalty)
                    seconds = done.seconds
                    row |= {"iterations": done.iterations, "message": done.message}
                cpu.append(seconds)
                row["numbers"] = json.dumps(numbers)
    for which, (cpu, plain) in spent.items():
        rows[which] |= {"repeats": len(cpu), "cpu": statistics.median(cpu)}
        rows[which] |= {"plain": statistics.median(plain)} if plain else {}
    return list(rows.values())


def written(number: list | None) -> str:
    """Value and error; without an error five digits."""
    if number is None:
        return "–"
    value, error = number
    if not error or np.isinf(error):
        return f"{value:.5g}" + " ± unknown" * bool(error)
    digits = int(np.clip(1 - np.floor(np.log10(error)), 0, 5))
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def table(rows: list[dict]) -> str:
    known, lines = {campaign.key_of(row): json.loads(row["numbers"]) for row in rows}, []
    for part in PARTS:
        found = [known[item.key] for finer in (False, True) for item, _ in runs(part, finer).values()]
        lines += [[part.name, name, *(written(each.get(name)) for each in found)] for name in found[0]]
    return markdown(
        ["part", "number", *COLUMNS_OF_TABLE, "finer mesh: package", "finer mesh: CalculiX, ten times the penalty"],
        lines,
    )


def cost_table(rows: list[dict]) -> str:
    known, lines = {campaign.key_of(row): row for row in rows}, []
    for part in PARTS:
        ours, *theirs = (known[item.key] for item, _ in runs(part, False).values())
        seconds = [float(each) for each in (ours["plain"], ours["cpu"], *(row["cpu"] for row in theirs))]
        numbers = (f"{each:.2g}" for each in (*seconds, seconds[2] / seconds[0]))
        counts = " / ".join(str(row["iterations"]) for row in (ours, theirs[0]))
        lines.append([part.name, ours["unknowns"], campaign.decade(part.penalty), *numbers, counts])
    head = ["part", "unknowns", "penalty, MPa/mm", "package without ±", *COLUMNS_OF_TABLE]
    return markdown([*head, "CalculiX / package without ±", "iterations: package / CalculiX"], lines)


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", nargs="?", default="", help="only parts whose name has this text")
    arguments = parser.parse_args(argv)
    if not shutil.which("ccx"):
        parser.error("no ccx here; apt-get install calculix-ccx")
    digest = campaign.sources_digest(campaign.ROOT)
    every = {item.key for item in cases()}
    store = campaign.Table(FILE, COLUMNS, digest, every)
    for part in PARTS:
        for finer in (False, True):
            if arguments.part in part.name and not {item.key for item, _ in runs(part, finer).values()} <= store.done:
                for row in measured(part, finer):
                    store.append(row | campaign.machine() | {"sources": digest})
                    print(*(f"{key} {row[key]}" for key in ("name", "script", "flags", "cpu", "numbers")), flush=True)
    rows = campaign.read_rows(FILE)
    if {campaign.key_of(row) for row in rows} >= every:
        print(table(rows), cost_table(rows), sep="\n\n")
    return int(any(row["message"] for row in rows))


if __name__ == "__main__":
    sys.exit(main())
