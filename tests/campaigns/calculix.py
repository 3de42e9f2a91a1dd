"""The package beside CalculiX on one mesh: a cylinder pressed on a block and dragged, with friction.

Both read the same triangles of second order, made by gmsh: a round body of radius 1 and a block, equal in modulus, on
meshes that do not match; pressed by a prescribed displacement, then dragged by one. CalculiX (`ccx`, Debian's
calculix-ccx) takes contact by a penalty, face to face, in steps of its own choice. Tractions are compared
with the package's on a finer mesh. A row per run into results/bench/calculix.csv; seconds are CPU seconds of the whole
program.
"""

import argparse
import csv
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
YOUNG, POISSON, FRICTION, PRESS, DRAG = 100.0, 0.3, 0.3, 0.02, 0.009
LONGEST = 60  # CPU seconds of a run
GEO = """
SetFactory("Built-in");
Point(1) = {-2, -2, 0, 0.4}; Point(2) = {2, -2, 0, 0.4}; Point(3) = {2, 0, 0, 0.4}; Point(4) = {0.25, 0, 0, H};
Point(5) = {-0.25, 0, 0, H}; Point(6) = {-2, 0, 0, 0.4};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6}; Plane Surface(1) = {1};
B = 1.37 * H;
Point(11) = {0, 1, 0, 0.1}; Point(12) = {-0.25, 1 - Sqrt(1 - 0.0625), 0, B};
Point(13) = {0.25, 1 - Sqrt(1 - 0.0625), 0, B};
Point(14) = {1, 1, 0, 0.1}; Point(15) = {1, 2, 0, 0.2}; Point(16) = {-1, 2, 0, 0.2}; Point(17) = {-1, 1, 0, 0.1};
Circle(11) = {12, 11, 13}; Circle(12) = {13, 11, 14}; Line(13) = {14, 15}; Line(14) = {15, 16}; Line(15) = {16, 17};
Circle(16) = {17, 11, 12};
Curve Loop(2) = {11, 12, 13, 14, 15, 16}; Plane Surface(2) = {2};
Physical Curve("clamped") = {1}; Physical Curve("flat") = {4}; Physical Curve("round") = {11};
Physical Curve("pushed") = {14}; Physical Curve("rest") = {2, 3, 5, 6, 12, 13, 15, 16};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
"""
CASE = f"""body lower E {YOUNG} nu {POISSON}
body upper E {YOUNG} nu {POISSON}
contact flat round friction {FRICTION}
clamp clamped
leg 1
move pushed 0 -{PRESS}
leg 4
move pushed {DRAG} -{PRESS}
"""


def mesh_of(path: Path) -> tuple[np.ndarray, dict, dict]:
    """Nodes (n, 2); by group the sides (., 3) and triangles (., 6) of a mesh of gmsh's of second order, from 0."""
    text = path.read_text()
    names = {int(tag): name for tag, name in re.findall(r'^\d (\d+) "(.*)"$', text, re.M)}
    nodes = text.split("$Nodes\n")[1].split("$EndNodes")[0].splitlines()[1:]
    place = np.array([line.split()[1:3] for line in nodes], float)
    sides, triangles = {}, {}
    for line in text.split("$Elements\n")[1].split("$EndElements")[0].splitlines()[1:]:
        words = [int(word) for word in line.split()]
        (sides if words[1] == 8 else triangles).setdefault(names[words[3]], []).append([k - 1 for k in words[5:]])
    return place, {k: np.array(v) for k, v in sides.items()}, {k: np.array(v) for k, v in triangles.items()}


def deck(path: Path, place, sides, triangles, stiffness: float, stick: float) -> None:
    """CalculiX's input: penalty `stiffness` for the pressure, `stick` for the shear, both pressure/length."""
    elements = np.concatenate(list(triangles.values()))
    lines = ["*NODE"] + [f"{k + 1},{x:.11g},{y:.11g},0" for k, (x, y) in enumerate(place)]
    lines += ["*ELEMENT,TYPE=CPE6,ELSET=ALL"]
    lines += [f"{k + 1}," + ",".join(str(n + 1) for n in nodes) for k, nodes in enumerate(elements)]
    for group in ("clamped", "pushed", "flat", "round"):
        lines += [f"*NSET,NSET={group}"] + [f"{n + 1}," for n in np.unique(sides[group])]
    faces = {
        frozenset(nodes[[a, b]]): (k + 1, a + 1)
        for k, nodes in enumerate(elements)
        for a, b in ((0, 1), (1, 2), (2, 0))
    }
    for group in ("flat", "round"):
        lines += [f"*SURFACE,NAME=S{group},TYPE=ELEMENT"]
        lines += ["{},S{}".format(*faces[frozenset(side[:2])]) for side in sides[group]]
    lines += ["*MATERIAL,NAME=M", "*ELASTIC", f"{YOUNG},{POISSON}", "*SOLID SECTION,ELSET=ALL,MATERIAL=M", "1."]
    lines += ["*SURFACE INTERACTION,NAME=I", "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR", f"{stiffness:g}"]
    lines += [
        "*FRICTION",
        f"{FRICTION},{stick:g}",
        "*CONTACT PAIR,INTERACTION=I,TYPE=SURFACE TO SURFACE",
        "Sflat,Sround",
    ]
    output = ["*NODE PRINT,NSET=pushed,TOTALS=ONLY", "RF", "*CONTACT FILE", "CDIS,CSTR", "*NODE FILE,NSET=flat", "U"]
    for step, (x, start) in enumerate(((0, 1.0), (DRAG, 0.25))):
        lines += ["*STEP,INC=1000", "*STATIC", f"{start:g},1."]
        if step == 0:
            lines += ["*BOUNDARY", "clamped,1,2", "pushed,1,1"]
        lines += ["*BOUNDARY", f"pushed,1,1,{x:g}", f"pushed,2,2,{-PRESS:g}", *output, "*END STEP"]
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
    return (
        after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
        done.returncode,
        done.stdout + done.stderr,
    )


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


def package(folder: Path, mesh: Path) -> dict:
    (folder / "a.case").write_text(CASE)
    words = ["-mesh", mesh, "-case", folder / "a.case", "-vtu", 0, "-estimate", 0, "-out", folder / "out"]
    seconds, code, said = timed(["FreeFem++", "-nw", "-v", "0", "edp/parts.edp", *words], campaign.ROOT)
    if code:
        return {"code": code, "seconds": seconds, "message": said.strip().splitlines()[-1]}
    rows = list(csv.DictReader((folder / "out/contact.csv").read_text().splitlines()))
    x, p, t, w = (np.array([float(row[name]) for row in rows]) for name in ("x", "pressure", "shear", "weight"))
    last = list(csv.DictReader((folder / "out/series.csv").read_text().splitlines()))[-1]
    counts = f"{last['newton']} / {last['backsolves']}"
    found = np.array([x, p, t])[:, np.argsort(x)]
    return {"code": 0, "seconds": seconds, "force": p @ w, "pull": t @ w, "count": counts, "found": found}


def calculix(folder: Path, mesh: Path, stiffness: float, stick: float) -> dict:
    place, sides, triangles = mesh_of(mesh)
    deck(folder / "a.inp", place, sides, triangles, stiffness, stick)
    seconds, code, said = timed(["ccx", "-i", "a"], folder)
    count = len(re.findall(r"^ iteration +\d+", said, re.M))
    if code or "Job finished" not in said:
        lines = [line.strip() for line in said.splitlines() if "ERROR" in line or "too" in line] or [f"code {code}"]
        done = re.findall(r"^ +(\d+) +(\d+) .*$", (folder / "a.sta").read_text(), re.M)
        lines += [f"not done in {LONGEST} s, {count} iterations" if code < 0 else lines[-1]]
        lines[-1] += f", {len(done)} increments converged"
        return {"code": code or 1, "seconds": seconds, "message": lines[-1], "count": count}
    totals = re.findall(r"total force.*\n\n +(\S+) +(\S+)", (folder / "a.dat").read_text())
    pull, force = (float(number) for number in totals[-1])
    node, tractions = surface_stresses(folder / "a.frd", len(place))
    flat = np.isin(node, sides["flat"])
    found = np.array([place[node[flat], 0], tractions[flat, 0], -tractions[flat, 1]])
    return {"code": 0, "seconds": seconds, "force": -force, "pull": pull, "count": count, "found": found}


def say(row: dict) -> None:
    print(
        *(f"{name} {value:.5g}" if isinstance(value, float) else f"{name} {value}" for name, value in row.items()),
        flush=True,
    )


def meshed(folder: Path, size: float) -> Path:
    (folder / "a.geo").write_text(f"H = {size!r};{GEO}")
    command = ["gmsh", "-2", "-order", "2", "-format", "msh22", "-v", "0", "a.geo", "-o", "a.msh"]
    subprocess.run(command, cwd=folder, check=True)
    return folder / "a.msh"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=float, nargs="*", default=[0.02, 0.01], help="of the sides in contact")
    parser.add_argument("--penalties", type=float, nargs="*", default=[1e4, 1e5, 1e6, 1e8], help="CalculiX's")
    parser.add_argument("--finest", type=float, default=0.0025, help="sides of the mesh that gives the reference")
    arguments = parser.parse_args()
    if not shutil.which("ccx"):
        parser.error("no ccx here; apt-get install calculix-ccx")
    rows, wanted = [], None
    for size in (arguments.finest, *arguments.sizes):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            mesh = meshed(folder, size)
            runs = [("package", package(folder, mesh))]
            if wanted is None:
                wanted = runs[0][1]["found"]
            else:
                runs += [
                    (f"CalculiX {each:g}", calculix(folder, mesh, each, each / 10)) for each in arguments.penalties
                ]
        for who, run in runs:
            found = run.pop("found", None)
            errors = {} if found is None else dict(zip("pt", off(found, wanted), strict=True))
            rows.append({"size": size, "by": who, **run, **errors})
            say(rows[-1])
    FILE.parent.mkdir(parents=True, exist_ok=True)
    with FILE.open("w", newline="") as file:
        writer = csv.DictWriter(file, "size by code seconds force pull p t count message".split(), restval="")
        writer.writeheader()
        writer.writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
