"""Whether two versions of the package give the same results: `python tests/campaigns/same.py OTHER [WORDS]`.

OTHER is a folder with another version, a worktree of the commit before say. Every run of RUNS whose name has one of
the words is made with both; its exit code, what a refusal says, summary.json and contact.csv are compared. Counts,
words and statuses must be equal; numbers may differ by TOLERANCE of their scale: of forces the largest force, of
moments force times the model's width, of points' values the column's largest; residuals and algebraic errors must be
below -tol; the estimates' own numbers may differ by ESTIMATED. Left out: seconds, modules, folders, dates. Runs of
OTHER are kept in its results/same/, made anew when its sources change.
Exit code 1: a difference, printed a line each.
"""

import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import product
from pathlib import Path

from campaign import FREEFEM, ROOT, script_of, sources_digest

TOLERANCE = 1e-9
ESTIMATED = 1e-4  # of the estimates' own numbers: their dual is solved to a tolerance
LEFT_OUT = {"seconds", "modules", "plugins", "costRatio", "out", "version", "freefem", "gmsh", "date", "given"}
LEFT_OUT |= {"path", "branch", "control", "w", "eps0", "axis"}  # flags of options: of scenes that read them
BELOW_TOL = {"residual", "algebra", "modelError"}
MOMENTS = {"contactMoment", "reactionMoment", "masterMoment"}
JOBS = 2

PLANE = ["disc-on-block", "meshed-disc", "confined-block", "wavy", "flat-punch", "hertz-line", "two-cylinders"]
PLANE += ["patch-test", "rough"]
SPACE = ["sphere-on-block", "sphere-on-plane", "two-spheres", "patch-test-3d"]
ADHESIVE = ["adhesive-sphere", "adhesive-cylinder", "adhesive-wavy", "adhesive-sphere-3d"]
METHODS = ["paper", "newton", "linesearch", "incremental", "signorini"]
LAWS = ["exponential", "barrier", "signorini"]
INGREDIENTS = ["-T0 d0", "-T0 0", "-threshold pointwise -T0 d0", "-inner newton", "-start none", "-preconditioner none"]
INGREDIENTS += ["-preconditioner diagonal", "-forcing 1e-6 -tol 1e-10", "-kappa 1e12 -m 1.05", "-kappa 0.01 -m 20"]
INGREDIENTS += ["-law power -kappa 1e9 -T0 d0", "-maxNewton 1", "-history 1 -steps 4", "-states 1"]
OFTEN = ["-geometry stress", "-geometry axisymmetric", "-force 80", "-distance exact", "-corners 0", "-ends 5 -h 1"]
OFTEN += ["-bodyForce 0.1 -traction 0.2", "-aspect 2", "-offset 3", "-u0 0.1", "-accuracy 1e-3"]
OFTEN += [
    "-accuracy 1e-3 -goal pressure",
    "-accuracy 1e-4 -order 4 -h 1",
    "-accuracy 1e-3 -law signorini",
    "-distance exact -history 1 -steps 3",
]
OFTEN += ["-force 80 -accuracy 1e-3", "-distance exact -accuracy 1e-2", "-geometry axisymmetric -accuracy 1e-2 -u0 1"]
EXAMPLES = {"pin-in-hole": "parts", "press-fit": "parts", "roller": "parts", "crossed-cylinders": "parts-3d"}
EXAMPLES["ball-on-bracket"] = "parts-3d"
PUNCH = f"-mesh {ROOT}/tests/data/results/punch.geo -case {ROOT}/tests/campaigns/punch.case -estimate 0"
TAPER = "-mesh edp/examples/taper/taper.geo -case edp/examples/taper/taper.case"
STUCK = ["-u0 -0.0005", "-u0 0.0005 -order 2", "-h 0.08", "-h 0.08 -force-coarse 1", "-geometry stress", "-vtu 0"]
STUCK += ["-geometry axisymmetric", "-method paper", "-method linesearch", "-method newton", "-start none", "-force 1"]
STUCK += ["-eps0 0.002 -gap 0.002"]
REFUSED = ["-h 0", "-order 3", "-method no", "-T0 -5", "-out /proc/x", "-kappa abc", "-law table"]
REFUSED += ["-nosuch 1", "-law barrier -method newton", "-force 5 -method paper", "-accuracy 0.01 -method paper"]


def runs() -> Iterator[tuple[str, str, str]]:
    """(name, script, flags) of every run."""

    def one(scene: str, flags: str = "", script: str = "") -> tuple[str, str, str]:
        return f"{scene} {flags}".strip(), script or script_of(scene), flags

    for scene, order in product(PLANE, (1, 2, 4)):
        yield one(scene, f"-order {order}")
        if order == 2:
            yield one(scene, f"-order {order} -estimate 0 -kappa 1e9")
    for scene, method in product(PLANE, METHODS):
        yield one(scene, f"-order 1 -method {method}")
    for scene, law in product(PLANE, LAWS):
        yield one(scene, f"-law {law}")
    for flags in [*INGREDIENTS, *OFTEN, *REFUSED]:
        yield one("disc-on-block", flags)
    for method, order in product(METHODS, (1, 2, 4)):
        yield one("disc-on-block", f"-method {method} -order {order} -kappa 1e6")
    for law, geometry in product(["power", *LAWS], ["stress", "axisymmetric"]):
        yield one("disc-on-block", f"-law {law} -geometry {geometry} -order 1")
    for scene, flags in product(["two-cylinders", "meshed-disc"], ["-distance exact", "-history 1 -steps 3"]):
        yield one(scene, flags)
        yield one(scene, f"{flags} -order 1")
    for scene, flags in product(["wavy", "flat-punch", "hertz-line", "two-cylinders", "rough"], INGREDIENTS[:6]):
        yield one(scene, flags)
    for scene in ["wavy", "flat-punch", "hertz-line", "two-cylinders", "meshed-disc"]:
        yield one(scene, "-accuracy 1e-2")
    for scene, points in product(["two-cylinders", "meshed-disc", "patch-test"], ["nodal", "segment"]):
        yield one(scene, f"-points {points} -order 1")
    coarse = {"sphere-on-block": "-h 1", "sphere-on-plane": "-h 0.5", "two-spheres": "-h 0.5", "patch-test-3d": ""}
    for scene, order in product(SPACE, (1, 2)):
        yield one(scene, f"{coarse[scene]} -order {order}".strip())
        yield one(scene, f"{coarse[scene]} -order {order} -kappa 1e9 -estimate 0".strip())
    for scene, law in product(SPACE[:3], ["exponential", "signorini"]):
        yield one(scene, f"{coarse[scene]} -order 1 -law {law}")
    for flags in ["-symmetry none", "-symmetry half", "-method paper", "-history 1 -steps 3", "-force 200", "-T0 d0"]:
        yield one("sphere-on-block", f"-h 1.5 -order 1 {flags}")
    yield one("sphere-on-block", "-h 1.5 -accuracy 0.05")
    for scene in SPACE[1:3]:
        yield one(scene, f"{coarse[scene]} -order 1 -distance exact")
    for scene in ADHESIVE[:2]:
        for flags in ["", "-order 1", "-kappa 100 -law power", *STUCK]:
            yield one(scene, flags)
    yield one("adhesive-sphere", '-path "-0.0031 0.0011 -0.0031" -steps 5')
    yield one("adhesive-sphere", '-path "-0.0031 0.0011" -steps 5 -branch unstable')
    yield one("adhesive-sphere", '-control force -path "0.02 -0.03" -steps 2')
    for flags in ["", "-path 1", '-path "-0.02 0.01 -0.02" -steps 3', "-u0 -0.005 -law table", "-history 1 -steps 2"]:
        yield one("adhesive-wavy", flags)
    yield one("adhesive-sphere-3d")
    yield one("disc-on-block-ipopt", "-method ipopt -order 1", "edp/scenes/disc-on-block-ipopt.edp")
    for example, scene in EXAMPLES.items():
        file = f"edp/examples/{example}/{example}"
        parts = f"-mesh {file}.geo -case {file}.case"
        for flags in [
            "",
            "-order 1",
            "-distance exact",
            "-surface facets",
            "-history 1 -steps 2",
            "-estimate 0 -kappa 1e5",
        ]:
            yield example + " " + flags, f"edp/{scene}.edp", f"{parts} {flags}".strip()
        if scene == "parts":
            yield example + " P4", f"edp/{scene}.edp", f"{parts} -order 4"
            yield example + " 1e-2", f"edp/{scene}.edp", f"{parts} -accuracy 1e-2"
            yield example + " check", f"edp/{scene}.edp", f"{parts} -check 1"
    yield "rounded punch, about an axis", "edp/parts.edp", f"{PUNCH} -order 4"
    yield "taper, with friction", "edp/parts.edp", TAPER
    yield one("wedge", "-order 2 -h 0.2")
    for lab in ["1-law", "2-newton", "3-threshold", "4-own-law", "5-cost", "6-sphere", "8-error", "9-own-part"]:
        yield f"lab {lab}", f"edp/labs/{lab}/{lab[2:]}.edp", ""


def result_of(root: Path, name: str, script: str, flags: str) -> Path:
    """The folder of the run's results and of `end.json`: its exit code and last lines; made if it is not there."""
    folder = root / "results/same" / re.sub(r"\W+", "-", name)
    if (folder / "end.json").exists() and root != ROOT:
        return folder
    shutil.rmtree(folder, ignore_errors=True)
    words = [word.strip('"') for word in re.findall(r'"[^"]*"|\S+', flags)]
    out = [] if "-out" in words else ["-out", str(folder.relative_to(root))]
    done = subprocess.run(
        [*FREEFEM, script, *words, *out],
        cwd=root,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "LC_ALL": "C"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=900,
    )
    text = done.stdout.decode(errors="replace").splitlines()
    folder.mkdir(parents=True, exist_ok=True)
    refusal = text[:1] if done.returncode == 10 else []
    (folder / "end.json").write_text(json.dumps({"code": done.returncode, "said": refusal, "last": text[-12:]}))
    return folder


def leaves(value: object, path: str = "") -> Iterator[tuple[str, object]]:
    """(path, value) of all that stands in a summary."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in LEFT_OUT:
                yield from leaves(inner, f"{path}.{key}")
    elif isinstance(value, list):
        value = value[:2] if re.search(r"\.accuracy\.rounds\[\d+\]$", path) else value  # the third: seconds
        yield f"{path}.length", len(value)
        for index, inner in enumerate(value):
            yield from leaves(inner, f"{path}[{index}]")
    else:
        yield path, value


def differences(mine: Path, other: Path) -> Iterator[str]:
    """What differs between two runs, in words."""
    ends = [json.loads((folder / "end.json").read_text()) for folder in (other, mine)]
    if ends[0]["code"] != ends[1]["code"] or ends[0]["said"] != ends[1]["said"]:
        now = ends[1]["said"] or ends[1]["last"]
        yield f"ended with {ends[0]['code']} {ends[0]['said']}, now {ends[1]['code']} {now}"
        return
    files = [folder / "summary.json" for folder in (other, mine)]
    if not files[0].exists():
        return
    before, now = (json.loads(file.read_text()) for file in files)
    tables = [dict(leaves(summary)) for summary in (before, now)]
    numbers = [abs(v) for k, v in tables[0].items() if re.search(r"[fF]orce|reaction[XYZ]", k) and isinstance(v, float)]
    force = max(numbers, default=0.0)
    width = before["parameters"].get("width") or 1.0
    for key in sorted(set(tables[0]) ^ set(tables[1])):
        yield f"{key} is there {'no longer' if key in tables[0] else 'now'}"
    for key in sorted(set(tables[0]) & set(tables[1])):
        a, b = tables[0][key], tables[1][key]
        if a == b:
            continue
        name = re.split(r"[.\[]", key.rstrip("]0123456789["))[-1]
        if isinstance(a, str) or isinstance(b, str) or a is None or b is None or not isinstance(a, float | int):
            if key != ".message" or re.sub(r"[-\d.e+]+", "", str(a)) != re.sub(r"[-\d.e+]+", "", str(b)):
                yield f"{key}: {a} -> {b}"
            continue
        small = name in BELOW_TOL or key.endswith(".algebra")
        if small and max(a, b) <= max(before["parameters"].get("tol", 1e-6), 1e-6 * force):
            continue
        scale = max(abs(a), abs(b))
        if name in MOMENTS:
            scale = force * width
        elif re.search(r"[fF]orce|reaction", key):
            scale = max(scale, force)
        elif name == "overlapMax":  # of places that are far larger
            scale = max(scale, abs(before["approach"]))
        elif ".motion[" in key or name == "outOfBalance":
            scale = max([scale, *(abs(v) for k, v in tables[0].items() if ".motion[" in k)])
        estimated = key.startswith(".estimates.") and not key.endswith(".value")
        within = ESTIMATED if estimated else TOLERANCE
        if estimated:  # below the value's own tolerance they are rounding
            scale = max(scale, TOLERANCE / ESTIMATED * max(1.0, force))
        if (isinstance(a, int) and isinstance(b, int)) or not math.isclose(a, b, rel_tol=0, abs_tol=within * scale):
            yield f"{key}: {a!r} -> {b!r} ({abs(a - b) / (abs(a) or 1):.1e})"
    yield from column_differences(mine / "contact.csv", other / "contact.csv")


def column_differences(mine: Path, other: Path) -> Iterator[str]:
    if not (mine.exists() and other.exists()):
        return
    a, b = (list(csv.reader(file.open())) for file in (other, mine))
    if a[0] != b[0] or len(a) != len(b):
        yield f"contact.csv: {len(a)} rows of {','.join(a[0])}, now {len(b)} of {','.join(b[0])}"
        return
    for column, name in enumerate(a[0]):
        first, second = ([float(row[column]) for row in table[1:]] for table in (a, b))
        scale = max(map(abs, first), default=0.0)
        worst = max((abs(p - q) for p, q in zip(first, second, strict=True) if p == p or q == q), default=0.0)
        if worst > TOLERANCE * scale:
            yield f"contact.csv {name}: differs by {worst / scale if scale else worst:.1e} of its largest"


def main(other: Path, words: list[str]) -> int:
    stamp = other / "results/same/sources"
    digest = sources_digest(other)
    if not stamp.exists() or stamp.read_text() != digest:
        shutil.rmtree(stamp.parent, ignore_errors=True)
        stamp.parent.mkdir(parents=True)
        stamp.write_text(digest)
    chosen = [
        run for run in dict((r[0], r) for r in runs()).values() if not words or any(word in run[0] for word in words)
    ]
    found = 0

    def both(run: tuple[str, str, str]) -> tuple[Path, Path]:
        return result_of(ROOT, *run), result_of(other, *run)

    with ThreadPoolExecutor(JOBS) as pool:
        for run, (mine, theirs) in zip(chosen, pool.map(both, chosen), strict=True):
            for line in differences(mine, theirs):
                found += 1
                print(f"{run[0]}: {line}", flush=True)
    print(f"{len(chosen)} runs, {found} differences")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve(), sys.argv[2:]))
