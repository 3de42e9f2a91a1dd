"""The package beside CalculiX on one mesh: in space a ball pressed on a block; in the plane a cylinder, then dragged.

Both read the same triangles of second order, made by gmsh: a round body of radius 1 and a block, equal in modulus, on
meshes that do not match; pressed by a prescribed displacement, then dragged by one. CalculiX (`ccx`, Debian's
calculix-ccx) takes contact by a penalty, face to face, in steps of its own choice. Tractions are compared
with the package's on a finer mesh. In space a quarter of it without friction, tetrahedra of second order, hard contact
here, penalties there. A row per run into results/bench/calculix.csv, of space calculix-space.csv; seconds
are CPU seconds of the whole program.
"""

import argparse
import csv
import json
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import campaign
import numpy as np

FILE = campaign.RESULTS_FOLDER / "bench" / "calculix.csv"
FILE_SPACE = FILE.with_name("calculix-space.csv")
YOUNG, POISSON, FRICTION, PRESS, DRAG = 100.0, 0.3, 0.3, 0.02, 0.009
LONGEST = 60  # CPU seconds of a run
GEO = (Path(__file__).parent / "disc-on-block.geo").read_text()
CASE = f"""body lower E {YOUNG} nu {POISSON}
body upper E {YOUNG} nu {POISSON}
contact flat round friction {FRICTION}
clamp clamped
leg 1
move pushed 0 -{PRESS}
leg 4
move pushed {DRAG} -{PRESS}
"""


GEO_SPACE = (Path(__file__).parent / "ball-on-block.geo").read_text()
CASE_SPACE = f"""body lower E {YOUNG} nu {POISSON}
body upper E {YOUNG} nu {POISSON}
contact flat round
clamp clamped
symmetry xs
symmetry ys
move pushed 0 0 -{PRESS}
"""


def mesh_of(path: Path, kind: int = 8) -> tuple[np.ndarray, dict, dict]:
    """Nodes (n, 3); by group sides, of gmsh's number `kind`, and elements, of a mesh of second order, from 0."""
    text = path.read_text()
    names = {int(tag): name for tag, name in re.findall(r'^\d (\d+) "(.*)"$', text, re.M)}
    nodes = text.split("$Nodes\n")[1].split("$EndNodes")[0].splitlines()[1:]
    place = np.array([line.split()[1:4] for line in nodes], float)
    sides, triangles = {}, {}
    for line in text.split("$Elements\n")[1].split("$EndElements")[0].splitlines()[1:]:
        words = [int(word) for word in line.split()]
        (sides if words[1] == kind else triangles).setdefault(names[words[3]], []).append([k - 1 for k in words[5:]])
    return place, {k: np.array(v) for k, v in sides.items()}, {k: np.array(v) for k, v in triangles.items()}


def deck(path: Path, place, sides, bodies, stiffness: float, stick: float, space: bool) -> None:
    """CalculiX's input: penalty `stiffness` for the pressure, `stick` for the shear, both pressure/length."""
    elements, kind = np.concatenate(list(bodies.values())), "CPE6"
    corners = ((0, 1), (1, 2), (2, 0))
    if space:  # gmsh's last two nodes are the other way round there
        elements, kind = elements[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]], "C3D10"
        corners = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
    lines = ["*NODE"] + [f"{k + 1},{x:.11g},{y:.11g},{z:.11g}" for k, (x, y, z) in enumerate(place)]
    lines += [f"*ELEMENT,TYPE={kind},ELSET=ALL"]
    lines += [f"{k + 1}," + ",".join(str(n + 1) for n in nodes) for k, nodes in enumerate(elements)]
    for group, nodes in sides.items():
        lines += [f"*NSET,NSET={group}"] + [f"{n + 1}," for n in np.unique(nodes)]
    faces = {frozenset(e[list(few)]): (k + 1, f + 1) for k, e in enumerate(elements) for f, few in enumerate(corners)}
    for group in ("flat", "round"):
        lines += [f"*SURFACE,NAME=S{group},TYPE=ELEMENT"]
        lines += ["{},S{}".format(*faces[frozenset(side[: len(corners[0])])]) for side in sides[group]]
    lines += ["*MATERIAL,NAME=M", "*ELASTIC", f"{YOUNG},{POISSON}", "*SOLID SECTION,ELSET=ALL,MATERIAL=M"]
    lines += [] if space else ["1."]
    lines += ["*SURFACE INTERACTION,NAME=I", "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR", f"{stiffness:g}"]
    lines += [] if space else ["*FRICTION", f"{FRICTION},{stick:g}"]
    lines += ["*CONTACT PAIR,INTERACTION=I,TYPE=SURFACE TO SURFACE", "Sflat,Sround"]
    output = ["*NODE PRINT,NSET=pushed,TOTALS=ONLY", "RF", "*CONTACT FILE", "CDIS,CSTR"]
    if space:
        lines += ["*STEP,INC=1000", "*STATIC", "1.,1.", "*BOUNDARY", "clamped,1,3", "xs,1,1", "ys,2,2"]
        lines += ["pushed,1,2", f"pushed,3,3,{-PRESS:g}", *output, "*END STEP"]
    for x, start in () if space else ((0, 1.0), (DRAG, 0.25)):
        lines += ["*STEP,INC=1000", "*STATIC", f"{start:g},1.", "*BOUNDARY"]
        lines += [] if x else ["clamped,1,2", "pushed,1,1", "*BOUNDARY"]
        lines += [f"pushed,1,1,{x:g}", f"pushed,2,2,{-PRESS:g}", *output, "*NODE FILE,NSET=flat", "U", "*END STEP"]
    path.write_text("\n".join(lines) + "\n")


def timed(command: list, folder: Path) -> tuple[float, int, str]:
    """CPU seconds, code and words of a program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [str(word) for word in command],
        cwd=folder,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST)),
        capture_output=True,
        text=True,
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"},
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, done.returncode, done.stdout + done.stderr


def surface_stresses(path: Path, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Of the last block CONTACT of a .frd file: nodes (from 0), and their pressure and shear (., 2)."""
    block = path.read_text().split(" -4  CONTACT")[-1].split(" -3")[0]
    rows = [line for line in block.splitlines() if line.startswith(" -1")]
    node = np.array([int(row[3:13]) for row in rows]) - 1
    value = np.array([[float(row[13 + 12 * k : 25 + 12 * k]) for k in range(6)] for row in rows])
    return node, value[:, 3:5]


def off(found: np.ndarray, wanted: np.ndarray) -> list[float]:
    """Differences of pressure and shear (3, n: x, p, t) in the mean square along x, over those that are wanted."""
    x, *tractions = found[:, np.argsort(found[0])]
    norm = lambda f: np.sqrt((np.diff(x) * (f[1:] ** 2 + f[:-1] ** 2) / 2).sum())  # noqa: E731
    exact = [np.interp(x, wanted[0], values) for values in wanted[1:]]
    return [norm(f - w) / norm(w) for f, w in zip(tractions, exact, strict=True)]


def off_radius(found: np.ndarray, wanted: np.ndarray) -> float:
    """The same of a pressure over the radius (2, n: r, p), in the mean square over the area."""
    radii = 0.5 * (np.linspace(0, 1, 41)[1:] + np.linspace(0, 1, 41)[:-1]) * 1.1 * wanted[0][wanted[1] > 0].max()
    half = 0.5 * (radii[1] - radii[0])
    squares = weight = 0.0
    for r in radii:
        inside = np.abs(found[0] - r) <= half
        near = np.abs(wanted[0] - r) <= half
        if inside.any() and near.any():
            expected = wanted[1][near].mean()
            squares += r * np.mean((found[1][inside] - expected) ** 2)
            weight += r * expected**2
    return float(np.sqrt(squares / weight))


def package(folder: Path, mesh: Path, space: bool) -> dict:
    (folder / "a.case").write_text(CASE_SPACE if space else CASE)
    words = ["-mesh", mesh, "-case", folder / "a.case", "-vtu", 0, "-estimate", 0, "-out", folder / "out"]
    script = "edp/parts-3d.edp" if space else "edp/parts.edp"
    seconds, code, said = timed(["FreeFem++", "-nw", "-v", "0", script, *words], campaign.ROOT)
    if code:
        return {"code": code, "seconds": seconds, "message": said.strip().splitlines()[-1]}
    if space:
        summary = json.loads((folder / "out/summary.json").read_text())
        found = campaign.read_contact(folder / "out")
        r, counts = np.hypot(found["x"], found["y"]), f"{summary['newton']} / {summary['backsolves']}"
        common = {"code": 0, "seconds": seconds, "force": float(found["pressure"] @ found["weight"]), "count": counts}
        return {**common, "dofs": summary["ndof"], "found": np.array([r, found["pressure"]])}
    rows = list(csv.DictReader((folder / "out/contact.csv").read_text().splitlines()))
    x, p, t, w = (np.array([float(row[name]) for row in rows]) for name in ("x", "pressure", "shear", "weight"))
    last = list(csv.DictReader((folder / "out/series.csv").read_text().splitlines()))[-1]
    counts = f"{last['newton']} / {last['backsolves']}"
    found = np.array([x, p, t])[:, np.argsort(x)]
    return {"code": 0, "seconds": seconds, "force": p @ w, "pull": t @ w, "count": counts, "found": found}


def calculix(folder: Path, mesh: Path, stiffness: float, stick: float, space: bool) -> dict:
    place, sides, elements = mesh_of(mesh, 9 if space else 8)
    deck(folder / "a.inp", place, sides, elements, stiffness, stick, space)
    seconds, code, said = timed(["ccx", "-i", "a"], folder)
    count = len(re.findall(r"^ iteration +\d+", said, re.M))
    if code or "Job finished" not in said:
        lines = [line.strip() for line in said.splitlines() if "ERROR" in line or "too" in line] or [f"code {code}"]
        done = re.findall(r"^ +(\d+) +(\d+) .*$", (folder / "a.sta").read_text(), re.M)
        lines += [f"not done in {LONGEST} s, {count} iterations" if code < 0 else lines[-1]]
        lines[-1] += f", {len(done)} increments converged"
        return {"code": code or 1, "seconds": seconds, "message": lines[-1], "count": count}
    totals = re.findall(r"total force.*\n\n +(\S+) +(\S+)", (folder / "a.dat").read_text())
    node, tractions = surface_stresses(folder / "a.frd", len(place))
    flat = np.isin(node, sides["flat"])
    if space:
        (force,) = re.findall(r"total force.*\n\n +\S+ +\S+ +(\S+)", (folder / "a.dat").read_text())[-1:]
        found = np.array([np.hypot(*place[node[flat], :2].T), tractions[flat, 0]])
        return {"code": 0, "seconds": seconds, "force": -float(force), "count": count, "found": found}
    pull, force = (float(number) for number in totals[-1])
    found = np.array([place[node[flat], 0], tractions[flat, 0], -tractions[flat, 1]])
    return {"code": 0, "seconds": seconds, "force": -force, "pull": pull, "count": count, "found": found}


def say(row: dict) -> None:
    print(
        *(f"{name} {value:.5g}" if isinstance(value, float) else f"{name} {value}" for name, value in row.items()),
        flush=True,
    )


def meshed(folder: Path, size: float, space: bool) -> Path:
    (folder / "a.geo").write_text(f"H = {size!r};{GEO_SPACE if space else GEO}")
    dimension = "-3" if space else "-2"
    command = ["gmsh", dimension, "-order", "2", "-format", "msh22", "-v", "0", "a.geo", "-o", "a.msh"]
    subprocess.run(command, cwd=folder, check=True)
    return folder / "a.msh"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--space", action="store_true", help="the ball on a block")
    parser.add_argument("--sizes", type=float, nargs="*", help="of the sides in contact (default: 0.02 0.01; 0.04)")
    parser.add_argument("--penalties", type=float, nargs="*", default=[1e4, 1e5, 1e6, 1e8], help="CalculiX's")
    parser.add_argument("--finest", type=float, help="sides of the mesh that gives the reference (0.0025; 0.02)")
    arguments = parser.parse_args()
    space = arguments.space
    sizes = arguments.sizes or ([0.04] if space else [0.02, 0.01])
    if not shutil.which("ccx"):
        parser.error("no ccx here; apt-get install calculix-ccx")
    rows, wanted = [], None
    for size in (arguments.finest or (0.02 if space else 0.0025), *sizes):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            mesh = meshed(folder, size, space)
            runs = [("package", package(folder, mesh, space))]
            if wanted is None:
                wanted = runs[0][1]["found"]
            else:
                for each in arguments.penalties:
                    runs += [(f"CalculiX {each:g}", calculix(folder, mesh, each, each / 10, space))]
        for who, run in runs:
            found = run.pop("found", None)
            errors = {}
            if found is not None:
                errors = {"p": off_radius(found, wanted)} if space else dict(zip("pt", off(found, wanted), strict=True))
            rows.append({"size": size, "by": who, **run, **errors})
            say(rows[-1])
    path = FILE_SPACE if space else FILE
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, "size by code seconds dofs force pull p t count message".split(), restval="")
        writer.writeheader()
        writer.writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
