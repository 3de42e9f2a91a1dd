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
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import campaign
import ccx
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
    seconds, code, said = ccx.timed([*campaign.FREEFEM, script, *words], campaign.ROOT, LONGEST)
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


def calculix(folder: Path, mesh: Path, stiffness: float, space: bool) -> dict:
    """ccx with a penalty, and a tenth of it along the surface."""
    read = ccx.mesh_of(mesh)
    deck = ccx.Deck(read, CASE_SPACE if space else CASE, ccx.Contact(stiffness, stiffness / 10))
    done = ccx.solve(folder, read, deck.text(), LONGEST)
    common = {"code": int(bool(done.message)), "seconds": done.seconds, "count": done.iterations}
    if done.message:
        return {**common, "message": f"{done.message}, {done.increments} increments converged"}
    flat = read.nodes("flat")
    pull, *_, force = done.reactions[-1][: read.axes]
    place, (pressure, shear) = read.place[flat], done.fields["CONTACT"][flat, 3:5].T
    if space:
        return {**common, "force": -force, "found": np.array([np.hypot(*place[:, :2].T), pressure])}
    return {**common, "force": -force, "pull": pull, "found": np.array([place[:, 0], pressure, -shear])}


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
                    runs += [(f"CalculiX {each:g}", calculix(folder, mesh, each, space))]
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
