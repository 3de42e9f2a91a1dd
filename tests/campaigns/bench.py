"""Error against run time, cost growth, and what each ingredient of the method saves: `make bench`, results/bench/.

work_precision.csv: on one mesh, error of the iteration against seconds, factorisations and back-substitutions.
meshes.csv: over meshes and degrees of elements, error against the independent reference solution, against seconds.
growth.csv: seconds, memory and cost ratio over the number of degrees of freedom; at one size over stiffness, degree and
method. ingredients.csv: the default method with each of its ingredients exchanged in turn, scene by scene.
hertz.csv: contact of elastic balls, and of a rigid sphere on a block, against Hertz.
accuracy.csv: runs that make their own meshes, `-accuracy`, beside meshes that a user would try: the true error, the
estimate, and CPU seconds from the first mesh to the result, estimates and later meshes included.
large.csv, only if asked for, by `make bench-large`: large bodies in space with `-solver multigrid`, on one process.
ranks.csv, only if asked for, by `make bench-ranks`: memory and agreement of several processes, with the usual and the
lean set-up of the levels, for a scene and for cases.

One run at a time. The default method's are repeated three times, unless they are long; the rivals are run once. Failed
runs are kept. Interrupted and started again, it goes on where it was. A part can be run alone: `python
tests/campaigns/bench.py growth`.
"""

import argparse
import dataclasses
import functools
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import campaign
import numpy as np
import reference
from campaign import case, decade, flags_of, markdown, select, signed, value

FOLDER = campaign.RESULTS_FOLDER / "bench"
REPEATS = 3

CASES = [(1e3, 3), (1e3, 10), (1e9, 3), (1e12, 3)]  # kappa, m: the paper's, an extreme one, two stiff ones
ERRORS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)  # in force, of which the price is asked
TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)
RIVALS_TOLERANCES = (1e-2, 1e-5, 1e-8)
RIVALS = [{"method": "xnewton"}, {"method": "paper", "T0": "0"}, {"method": "paper", "T0": "d0"}, {"method": "newton"}]
RIVALS += [{"method": "linesearch"}, {"method": "incremental", "steps": 5}, {"method": "ipopt"}]

SPHERE = "sphere-on-block"
# Series of meshes: the flags that they share, and their h (length); the other laws do without P1 and the finest of P2.
PLANE = [
    ({"order": 1}, (1.0, 0.5, 0.25, 0.1, 0.05)),
    ({"order": 2}, (1.0, 0.5, 0.25, 0.1, 0.05)),
    ({"order": 3, "grading": 60}, (2.0, 1.0, 0.5, 0.25)),
    ({"order": 4, "grading": 60}, (2.0, 1.0, 0.5, 0.25)),
]
PLANE_SHORT = [({"order": 2}, PLANE[1][1][:-1]), *PLANE[2:]]
SPACE = [
    ({"order": 1}, (1.0, 0.6, 0.4, 0.3)),
    ({"order": 2, "layers": 1, "grading": 10}, (2.0, 1.5, 1.0, 0.75)),
    ({"order": 2, "layers": 1, "grading": 5}, (1.5, 0.75)),
]
RIVALS_PLANE = [({"order": 1}, (0.1,)), ({"order": 2}, (0.5, 0.25)), ({"order": 4, "grading": 60}, (1.0, 0.5))]
RIVALS_SPACE = [({"order": 1}, (0.6,)), ({"order": 2, "layers": 1, "grading": 10}, (2.0, 1.5))]
GROWTH = {"disc-on-block": (0.235, 0.13, 0.071, 0.0405, 0.0222), SPHERE: (1.2, 0.8, 0.55, 0.4, 0.255)}  # h, with P2
GROWTH_LAWS = [CASES[0], CASES[3]]
# h of 100 000 degrees of freedom in the plane, 60 000 in space, by degree
ONE_SIZE = {"disc-on-block": {1: 0.0355, 2: 0.0711, 4: 0.146}, SPHERE: {1: 0.25, 2: 0.585}}
LONG = 9  # seconds of a run that is not repeated

EXPONENTS = (1.05, 3, 10, 30)
KAPPAS = (1e-2, 1e3, 1e6, 1e12, 1e30)

FIRST = [{"T0": "0"}, {"T0": "d0"}]
VARIANTS = [{}, {"start": "none"}, {"preconditioner": "diagonal"}, {"preconditioner": "none"}]
VARIANTS += [{"start": "none", "preconditioner": "diagonal"}, {"inner": "newton"}, {"inner": "newton", "start": "none"}]
VARIANTS += [*FIRST, *({"threshold": "pointwise", **first} for first in FIRST)]
VARIANTS += [{"inner": "newton", "start": "none", "preconditioner": "none", "threshold": "pointwise", "T0": "0"}]
SCENES = [
    {"scene": "disc-on-block", "h": 0.2, "order": 2},
    {"scene": "meshed-disc", "h": 0.25, "order": 1},
    {"scene": "confined-block", "h": 0.5, "order": 1},
    {"scene": "wavy", "h": 0.2, "order": 1},
    {"scene": "flat-punch", "h": 0.25, "order": 2},
]
LAWS = [
    {"law": "power", "kappa": 1e3, "m": 3},
    {"law": "power", "kappa": 1e12, "m": 3},
    {"law": "exponential", "p0": 0.02, "beta": 500},
    {"law": "barrier", "p0": 1e-4},
]
HERTZ_SIZES = ((0.4, 2), (0.2, 3), (0.14, 4), (0.1, 4)), ((0.4, 2), (0.2, 4), (0.14, 4), (0.1, 6))
# Hertz in space, radius 1: the flags of each scene, its h (length) and the layers of its grid. Its greatest pressure.
HERTZ = {
    SPHERE: ({"law": "signorini", "force": 14.652014652, "patch": 1.6, "grading": 80}, HERTZ_SIZES[0]),
    "two-spheres": ({}, HERTZ_SIZES[1]),
    "sphere-on-plane": ({}, HERTZ_SIZES[1]),
}
HERTZ_PRESSURE = 1.5 * 14.652014652 / np.pi


# Series of the part accuracy: flags, and what is varied. Uniform: elements of one size.
ADAPTIVE_PLANE = (1e-3, 1e-4, 1e-5, 1e-6)
ADAPTIVE_SPACE = (3e-2, 1e-2, 3e-3, 1e-3)
TRIED: dict[str, dict[str, tuple[dict, tuple[float, ...]]]] = {
    "disc-on-block": {
        "graded": ({"order": 4, "grading": 60}, (2.0, 1.0, 0.5, 0.25)),
        "uniform": ({"order": 2, "grading": 0.01, "corners": 0}, (2.0, 1.0, 0.5)),
    },
    SPHERE: {
        "graded": ({"order": 2, "layers": 1, "grading": 10}, (3.0, 2.0, 1.5, 1.0)),
        "uniform": ({"order": 2, "layers": 1, "grading": 0.01}, (4.0, 2.8, 2.0)),
    },
}
CROSSED = "crossed-cylinders"
CROSSED_SIZES = (0.16, 0.11, 0.08)  # the geometry's own parameter; growing away from the contact as it says
CROSSED_FINE = 0.06


def work_precision(_root: Path) -> list[campaign.Case]:
    found = []
    for kappa, m in CASES:
        for rival in RIVALS:
            tolerances = TOLERANCES if rival["method"] == "xnewton" else RIVALS_TOLERANCES
            for tol in tolerances[-1:] if rival["method"] == "incremental" else tolerances:
                flags = {**rival, "law": "power", "kappa": kappa, "m": m, "h": 0.2, "order": 2, "tol": tol, "eps": tol}
                seconds = {"xnewton": 0.3, "incremental": 7, "ipopt": 5}.get(rival["method"], 1.5)
                repeats = REPEATS if rival["method"] == "xnewton" else 1
                found.append(case("work_precision", repeats=repeats, weight=seconds, timeout=120, **flags))
    return found


def meshes(_root: Path) -> list[campaign.Case]:
    """Every degree over h; the rivals on the paper's case, and two of them in space."""
    found = []

    def add(scene, law, method, lines):
        kappa, m = law
        for flags, sizes in lines:
            for h in sizes:
                ours = method["method"] == "xnewton"
                merged = {**method, "law": "power", "kappa": kappa, "m": m, "h": h, **flags, "tol": 1e-8}
                dofs = 1.6e4 / h**2.5 if scene == SPHERE else 520 * (flags["order"] / h) ** 2 / 4 + 3000
                repeats = REPEATS if ours else 1
                seconds = dofs * (2e-5 if ours else 2e-4)
                found.append(case("meshes", scene, 300, repeats, 0.2 + seconds, **merged))

    for law in CASES:
        add("disc-on-block", law, RIVALS[0], PLANE if law == CASES[0] else PLANE_SHORT)
        if law[0] >= 1e9:
            add("disc-on-block", law, RIVALS[0], [({**PLANE[-1][0], "ends": ends(*law)}, PLANE[-1][1])])
    for rival in RIVALS[1:]:
        add("disc-on-block", CASES[0], rival, RIVALS_PLANE)
    add(SPHERE, CASES[0], RIVALS[0], SPACE)
    for rival in RIVALS[2:4]:
        add(SPHERE, CASES[0], rival, RIVALS_SPACE)
    return found


def ends(kappa: float, m: float) -> float:
    """Half the contact's width (length) to three decimals, as a coarse run gives it about."""
    return round(reference.values()["disc-on-block", kappa, m]["halfWidth"], 3)


def growth(_root: Path) -> list[campaign.Case]:
    """Sizes up to 1e6 in the plane, 4e5 in space; at one size the map of stiffness, every degree, the rivals."""
    found = []

    def add(name, scene, law, h, order, method=RIVALS[0], repeats=REPEATS):
        dofs = {1: 940, 2: 12100}[order] / h**3 if scene == SPHERE else 520 * (order / h) ** 2 / 4
        seconds = 0.2 + dofs * (1e-4 if scene == SPHERE else 3e-5) * (1 if method == RIVALS[0] else 10)
        flags = {**method, "law": "power", "kappa": law[0], "m": law[1], "h": h, "order": order, "tol": 1e-8}
        repeats = repeats if seconds < LONG else 1
        found.append(case(name, scene, 900, repeats, seconds, **flags))

    for scene, sizes in GROWTH.items():
        for h in sizes:
            for law in GROWTH_LAWS if h > (0.5 if scene == SPHERE else 0.03) else GROWTH_LAWS[:1]:
                add("growth", scene, law, h, 2)
    for kappa in KAPPAS:
        for m in EXPONENTS:
            add("cost", "disc-on-block", (kappa, m), ONE_SIZE["disc-on-block"][2], 2)
    for scene, sizes in ONE_SIZE.items():
        for order, h in sizes.items():
            for law in GROWTH_LAWS:
                if (scene, order) != ("disc-on-block", 2):
                    add("cost", scene, law, h, order)
                if (scene, order) == ("disc-on-block", 2) or (law == CASES[0] and (scene, order) != (SPHERE, 1)):
                    add("cost", scene, law, h, order, RIVALS[3], 1)
    for rival in (RIVALS[1], RIVALS[2], RIVALS[4]):
        add("cost", "disc-on-block", CASES[0], ONE_SIZE["disc-on-block"][2], 2, rival, 1)
    return found


def ingredients(_root: Path) -> list[campaign.Case]:
    found = []
    for scene in SCENES:
        for law in LAWS:
            for variant in VARIANTS:
                flags = {"method": "xnewton", **scene, **law, "tol": 1e-8, **variant}
                found.append(case("ingredients", weight=0.6, timeout=120, **flags))
    return found


def hertz(_root: Path) -> list[campaign.Case]:
    found = []
    for scene, (flags, sizes) in HERTZ.items():
        for h, layers in sizes:
            found.append(case("hertz", scene, 300, 1, 0.1 / h**2, method="xnewton", h=h, layers=layers, **flags))
    return found


LARGE = {1: (0.3, 0.21, 0.15, 0.088, 0.058), 2: (0.5, 0.3, 0.2)}  # h, by degree: to 3e6 and 1e6 degrees of freedom
LARGE_ONE = {1: 0.21, 2: 0.45}  # about 1e5, over stiffness and exponent
LARGE_LAWS = [(1, 3), (1e4, 3), (1e8, 3), (1e12, 3), (1e3, 1.05), (1e3, 20)]
LEAN = "-matptap_via allatonce"  # what a run chooses itself where memory is short
PROCESSES = [(1, False), (2, False), (4, False), (8, False), (2, True), (4, True)]
# name, order, flags of the mesh, runs: processes, lean or not
RANKED = [
    ("P1", 1, {"h": 0.132}, PROCESSES),
    ("P2", 2, {"h": 0.3}, PROCESSES),
    ("P1 halved", 1, {"h": 0.19, "refine": 1}, [(4, False)]),
]
# name, of P1 unless it says P2: geometry among the examples, and the text of a case, if it is not the example's own
RANKED_PARTS = {
    "wheel on rail": ("wheel-on-rail/wheel-on-rail.step", ""),
    "wheel on rail P2": ("wheel-on-rail/wheel-on-rail.step", ""),
    "ball on bracket": ("ball-on-bracket/ball-on-bracket.geo", ""),
    "tie": (
        "ball-on-bracket/ball-on-bracket.geo",
        """units mm MPa
body  bracket E 3e3 nu 0.4
body  ball E 210e3 nu 0.3
tie   shelf ball-surface
clamp bolts
weight ball 0.01 0 -0.046627423
""",
    ),
    "friction": (
        "crossed-cylinders/crossed-cylinders.geo",
        """units mm MPa
body  lower E 210e3 nu 0.3
body  upper E 210e3 nu 0.3
contact lower-round upper-round friction 0.3
clamp base
leg   2
move  grip 0 0 -0.01
leg   4
move  grip 0.003 0.001 -0.01
""",
    ),
}
ONE_SOLVE = "edp/scenes/one-solve.edp"  # the scene, and after it one solve under the same forces


def large(_root: Path) -> list[campaign.Case]:
    """Sizes on one process; laws at 100 000."""
    found = []

    def add(name, law, h, order):
        flags = {"kappa": law[0], "m": law[1], "h": h, "order": order, "tol": 1e-8, "estimate": 0}
        item = case(name, SPHERE, 3600, 1, 0.35 / h**2.5 * order**3, solver="multigrid", **flags)
        if name == "law":
            item = dataclasses.replace(item, script=ONE_SOLVE)
        found.append(item)

    for order, h in LARGE_ONE.items():
        for law in LARGE_LAWS:
            add("law", law, h, order)
    for order, sizes in LARGE.items():
        for h in sizes:
            add("size", (1e9, 3), h, order)
    return found


def large_files(root: Path) -> dict[str, str]:
    text = (root / campaign.script_of(SPHERE, None)).read_text()
    after = """{
    int before = iterations;
    real[int] nodal(ndof);
    computeContactLoad(q, nodal);
    solveMultigrid(nodal, 0.1 * tol, false);
    ofstream one(requestedFolder + "/one-solve");
    one << iterations - before;
}
"""
    return {ONE_SOLVE: text + after}


def solves(*_) -> campaign.Measure:
    """How many iterations all solves took, and one to a tenth of the tolerance."""

    def measure(_item: campaign.Case, summary: dict, folder: Path) -> dict:
        one = folder / "one-solve"
        alone = int(one.read_text()) if one.exists() else None
        return {"iterations": summary["iterations"], "oneSolve": alone}

    return measure


def large_table(rows: list[dict]) -> str:
    """The sizes."""
    header = "element, h|dofs|in contact|linearisations|solves / iterations|cost ratio|CPU s|wall s|MB"
    lines = []
    for row in (row for row in rows if row["name"] != "law"):
        good = row["status"] == "converged"
        counts = [row["newton"], f"{row['backsolves']} / {row['iterations']}"] if good else [row["status"], "-"]
        size = [row["ndof"], row["contactPoints"]]
        cost = [f"{value(row, 'costRatio'):.2f}", *(f"{value(row, name):.0f}" for name in ("cpu", "wall", "memory"))]
        lines.append([f"P{row['order']}, {row['h']}", *size, *counts, *cost])
    return markdown(header.split("|"), lines)


def large_laws_table(rows: list[dict]) -> str:
    """Over the law: the iterations of all solves beside those of one to a tenth of the tolerance."""
    header = "element, h|dofs|κ, m|linearisations|solves / iterations|of one solve|quotient"
    lines = []
    for row in (row for row in rows if row["name"] == "law" and row["status"] == "converged"):
        quotient = value(row, "iterations") / value(row, "oneSolve")
        law = f"{decade(value(row, 'kappa'))}, {row['m']}"
        counts = [row["newton"], f"{row['backsolves']} / {row['iterations']}", row["oneSolve"], f"{quotient:.1f}"]
        lines.append([f"P{row['order']}, {row['h']}", row["ndof"], law, *counts])
    return markdown(header.split("|"), lines)


def ranks_cases(_root: Path) -> list[campaign.Case]:
    """A scene of three sizes, and four cases: on one process, on several, and with a lean set-up."""
    found = []

    def add(name, script, flags, ranks=1, lean=False):
        start = ("mpiexec", "-n", str(ranks)) if ranks > 1 else ()
        spared = ("env", f"PETSC_OPTIONS={LEAN}") if lean else ()
        texts = tuple(text for flag, given in flags.items() for text in (f"-{flag}", campaign.flag_text(given)))
        program = (*spared, *start, "sh", "edp/freefem.sh")
        title = f"{name}, {ranks}{', lean' * lean}"
        found.append(campaign.Case(title, script, texts, 3600, 1, 60, program))

    shared = {"solver": "multigrid", "tol": 1e-9, "estimate": 0}
    for name, (geometry, case_file) in RANKED_PARTS.items():
        own = f"{name.split()[0]}.case"
        example = Path("edp/examples") / geometry
        flags = {"mesh": example if example.suffix == ".geo" else example.name}
        flags |= {"case": own if case_file else example.with_suffix(".case"), **shared}
        flags["order"] = 1 + name.endswith("P2")
        for ranks in (1, 2, 4) if name.startswith("wheel") else (1, 2):
            add(name, "edp/parts-3d.edp", flags, ranks)
    for name, order, mesh, runs in RANKED:
        flags = {"order": order, "kappa": 1e9, **mesh, **shared}
        for ranks, lean in runs:
            add(name, f"edp/scenes/{SPHERE}.edp", flags, ranks, lean)
    return found


def ranks_files(root: Path) -> dict[str, str]:
    files = {f"{name.split()[0]}.case": text for name, (_, text) in RANKED_PARTS.items() if text}
    step = root / "edp/examples" / RANKED_PARTS["wheel on rail"][0]
    return files | {step.name: step.read_text()}


def answers(*_) -> campaign.Measure:
    """What is compared: processes, force or that of the first contact, greatest pressure."""

    def measure(_item: campaign.Case, summary: dict, _folder: Path) -> dict:
        contact = summary["contacts"][0] if summary.get("contacts") else summary
        force = contact.get("normalForce", contact.get("force"))
        numbers = {"answer": repr(force), "greatest": repr(contact["pressureMax"])}
        return {"ranks": summary["ranks"], "iterations": summary["iterations"], **numbers}

    return measure


def ranks_table(rows: list[dict]) -> str:
    """Memory of the largest process over that of one, seconds, and how far answers are from those of one."""
    header = "run|dofs|processes|MB of the largest|over one|CPU s of process 0|of it levels and first solve|iterations"
    lines = []
    alone = {}
    for row in rows:
        name = row["name"].split(",")[0]
        size = [row["name"].replace(f", {row['ranks']}", ""), row["ndof"] or "-", row["ranks"] or "-"]
        if row["status"] != "converged":
            lines.append([*size, row["status"], *["-"] * 6])
            continue
        if row["ranks"] == "1":
            alone[name] = row
        one = alone.get(name)
        over = f"{value(row, 'memory') / value(one, 'memory'):.2f}" if one else "-"
        off = [f"{abs(value(row, key) / value(one, key) - 1):.0e}" if one else "-" for key in ("answer", "greatest")]
        if one is row:
            off = ["-", "-"]
        costs = [f"{value(row, 'memory'):.0f}", over, f"{value(row, 'cpu'):.0f}"]
        costs += [f"{value(row, 'seconds_factorisation'):.1f}", row["iterations"]]
        lines.append([*size, *costs, *off])
    return markdown([*header.split("|"), "force off by", "greatest pressure off by"], lines)


def crossed_geometry(root: Path, size: float) -> str:
    """The example's geometry with another size of elements.

    The finest is fine far away too, and has the surfaces' own nodes in the middles of sides."""
    text = (root / f"edp/examples/{CROSSED}/{CROSSED}.geo").read_text().replace("size = {0.08", f"size = {{{size:g}")
    if size == CROSSED_FINE:
        text = text.replace("growth = {0.5", "growth = {0.3").replace("extent / 3", "extent / 10")
        text += "Mesh.ElementOrder = 2;\n"
    return text


def crossed(size: float, name: str, **flags) -> campaign.Case:
    texts = tuple(text for flag, value in flags.items() for text in (f"-{flag}", campaign.flag_text(value)))
    mesh = ("-mesh", f"{CROSSED}-{size:g}.geo", "-case", f"edp/examples/{CROSSED}/{CROSSED}.case")
    return campaign.Case(name, "edp/parts-3d.edp", mesh + texts, 300, 1, 5)


def accuracy_files(root: Path) -> dict[str, str]:
    return {f"{CROSSED}-{size:g}.geo": crossed_geometry(root, size) for size in (*CROSSED_SIZES, CROSSED_FINE)}


def accuracy_cases(_root: Path) -> list[campaign.Case]:
    """By problem: asked accuracies, then the meshes that a user would try."""
    found = []
    for scene, law in (("disc-on-block", CASES[0]), *(("disc-on-block", law) for law in CASES[2:]), (SPHERE, CASES[0])):
        flags = {"method": "xnewton", "law": "power", "kappa": law[0], "m": law[1]}
        for asked in ADAPTIVE_SPACE if scene == SPHERE else ADAPTIVE_PLANE:
            found.append(case("adaptive", scene, weight=3, **flags, accuracy=asked))
        for name, (further, sizes) in TRIED[scene].items():
            found += [case(name, scene, weight=2, **flags, **further, h=h, tol=1e-8) for h in sizes]
    found += [crossed(CROSSED_SIZES[0], "adaptive", accuracy=asked) for asked in ADAPTIVE_SPACE[:3]]
    return found + [crossed(size, "graded") for size in CROSSED_SIZES]


# ---------------------------------------------------------------- errors


def accuracy_errors(sources: Path, processes: campaign.Processes) -> campaign.Measure:
    """The relative error, true and said, of the force; of the crossed cylinders of how far the force has gone."""

    @functools.cache
    def fine() -> float:
        item = crossed(CROSSED_FINE, "reference")
        with tempfile.TemporaryDirectory() as name:
            command = [*campaign.FREEFEM, item.script, *item.flags, "-vtu", "0", "-out", name]
            outcome = processes.execute(command, sources, Path(name), 900)
            if outcome.code != 0:
                raise RuntimeError(f"the finest mesh's run did not converge: {outcome.output[-300:]}")
            return outcome.summary["estimates"]["loads"][0]["way"]["value"]

    def measure(item: campaign.Case, summary: dict, _folder: Path) -> dict:
        told, seconds = summary["estimates"], summary["seconds"]
        if summary["scene"] == "parts-3d":
            number, known = told["loads"][0]["way"], fine()
        else:
            law = (float(item.parameters[name]) for name in ("kappa", "m"))
            number, known = told["force"], reference.values()[summary["scene"], *law]["force"]
        parts = ("assembly", "factorisation", "contact", "estimate")
        reached = summary.get("accuracy") or {}
        return {
            "forceError": abs(number["value"] / known - 1),
            "said": number["error"] / abs(number["value"]),
            "asked": reached.get("asked"),
            "meshes": reached.get("meshes", 1),
            "seconds": reached.get("seconds") or sum(seconds[part] for part in parts),
        }

    return measure


def hertz_differences(*_) -> campaign.Measure:
    """Radius (of the second moments) and greatest pressure, relative differences to Hertz's with their sign."""

    def measure(_item: campaign.Case, summary: dict, _folder: Path) -> dict:
        return {"radius": summary["halfWidthMoment"] - 1, "pressure": summary["pressureMax"] / HERTZ_PRESSURE - 1}

    return measure


def iteration_error(sources: Path, processes: campaign.Processes) -> campaign.Measure:
    """Relative differences in force and in nodal pressure (weighted L2) to the same mesh's solution to 1e-12."""

    @functools.cache
    def tight(kappa: str, m: str, h: str, order: str) -> tuple[float, np.ndarray]:
        item = case("tight", method="xnewton", law="power", kappa=kappa, m=m, h=h, order=order, tol=1e-12)
        with tempfile.TemporaryDirectory() as name:
            command = [*campaign.FREEFEM, item.script, *item.flags, "-vtu", "0", "-out", name]
            outcome = processes.execute(command, sources, Path(name), 120)
            if outcome.code != 0:
                raise RuntimeError(
                    f"the tight solution did not converge: {item.flags}: {outcome.summary.get('message')}"
                )
            return outcome.summary["force"], campaign.read_contact(Path(name))["pressure"]

    def measure(item: campaign.Case, summary: dict, folder: Path) -> dict:
        force, pressure = tight(*(item.parameters[name] for name in ("kappa", "m", "h", "order")))
        contact = campaign.read_contact(folder)
        return {
            "forceError": abs(summary["force"] / force - 1),
            "pressureError": norm(contact["weight"], contact["pressure"] - pressure)
            / norm(contact["weight"], pressure),
        }

    return measure


def norm(weight: np.ndarray, values: np.ndarray) -> float:
    return float(np.sqrt(np.sum(weight * values**2)))


# ---------------------------------------------------------------- what came out


def exponent(sizes: np.ndarray, seconds: np.ndarray) -> float:
    """s of seconds ~ sizes^s, least squares in the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])


def elastic_seconds(row: dict[str, str]) -> float:
    """Assembly and the one factorisation of a run of the default method: the linear elastic solve of its mesh."""
    return value(row, "seconds_assembly") + value(row, "seconds_factorisation")


def contact_seconds(row: dict[str, str]) -> float:
    """Assembly to displacement: what the cost ratio compares with the elastic solve."""
    return elastic_seconds(row) + value(row, "seconds_contact")


def report_work_precision(rows: list[dict]) -> str:
    lines = []
    for kappa, m in CASES:
        for method, start in dict.fromkeys((row["method"], row["T0"]) for row in rows):
            group = select(rows, kappa=kappa, m=m, method=method, T0=start, tol=1e-8)
            for row in group:
                good = row["status"] == "converged"
                counts = [row["newton"] if good else row["status"], row["factorisations"], row["backsolves"]]
                numbers = [f"{contact_seconds(row):.3f}", f"{value(row, 'forceError'):.0e}"] if good else ["-", "-"]
                lines.append([f"{decade(kappa)}, {m}", method_words(row), *counts, *numbers])
    header = "κ, m|method (tol 1e-8)|linearisations|factorisations|back-substitutions|CPU s|error"
    return markdown(header.split("|"), lines)


def problem(row: dict[str, str]) -> tuple[str, float, float]:
    """Scene, kappa and m of a run."""
    return row["scene"], value(row, "kappa"), value(row, "m")


def problem_words(row: dict[str, str]) -> str:
    return ("sphere, " if row["scene"] == SPHERE else "") + f"{decade(value(row, 'kappa'))}, {value(row, 'm'):g}"


def method_words(row: dict[str, str]) -> str:
    more = {"paper": f", T0 = {row['T0']}", "incremental": f", `-steps {row['steps']}`"}
    return row["method"] + more.get(row["method"], "")


def element(row: dict[str, str]) -> str:
    """P and the degree; with the meshes that shrink to the ends of contact said."""
    return f"P{value(row, 'order'):g}" + (", `-ends`" if " -ends " in row["flags"] else "")


def accuracy(rows: list[dict]) -> list[dict]:
    """The default method's runs of the paper's case, its meshes told nothing."""
    rows = select(rows, script=campaign.script_of("disc-on-block"), method="xnewton", status="converged")
    rows = select(rows, kappa=CASES[0][0], m=CASES[0][1])
    return [row for row in rows if " -ends " not in row["flags"]]


def accuracy_table(rows: list[dict]) -> str:
    """Element by element, over h: relative differences to the reference, with their sign."""
    known = reference.values()["disc-on-block", *map(float, CASES[0])]
    lines = []
    for row in accuracy(rows):
        away = [signed(value(row, name) / known[name] - 1) for name in reference.ERRORS.values()]
        cells = [element(row), f"{value(row, 'h'):g}", row["ndof"], f"{value(row, 'force'):.6f}"]
        lines.append([*cells, *away, signed(value(row, "profileError"))])
    return markdown("element|h|dofs|force|force|greatest pressure|half-width|profile".split("|"), lines)


def orders_table(rows: list[dict]) -> str:
    """Exponents of the errors over h on the four finest meshes; P4's end at the clamped corners' error."""
    lines = []
    for order in (1, 2):
        finest = select(accuracy(rows), order=order)[-4:]
        h = np.array([value(row, "h") for row in finest])
        errors = [np.array([value(row, name) for row in finest]) for name in reference.COLUMNS]
        lines.append([f"P{order}", *(f"{exponent(h, error):.2f}" for error in errors)])
    return markdown(["element", "force", "greatest pressure", "half-width", "profile"], lines)


def hertz_table(rows: list[dict]) -> str:
    lines = []
    for row in rows:
        flags = flags_of(row)
        away = [f"{100 * value(row, name):+.2f} %".replace("-", "−") for name in ("radius", "pressure")]
        counts = f"{row['newton']} / {row['backsolves']}"
        cells = [f"`{row['scene']}`", f"{value(row, 'h'):g}, {flags['-layers']}", row["ndof"], *away, counts]
        lines.append([*cells, f"{value(row, 'costRatio'):.2f}"])
    header = "scene|`-h`, `-layers`|dofs|radius|greatest pressure|linearisations / back-substitutions|cost ratio"
    return markdown(header.split("|"), lines)


def meshes_table(rows: list[dict]) -> str:
    """Least CPU seconds to an error in force, by element; of the rivals, whatever their element, the best."""
    groups: dict = {}
    for row in rows:
        ours = row["method"] == "xnewton"
        key = problem_words(row), method_words(row), element(row) if ours else "best"
        groups.setdefault(key, []).append(row)
    lines = []
    for key, group in groups.items():
        cells = []
        for error in ERRORS:
            best = cheapest(group, error, contact_seconds)
            cells.append(
                "–"
                if best is None
                else f"{contact_seconds(best):.2g}" + (f" {element(best)}" if key[2] == "best" else "")
            )
        lines.append([*key, *cells])
    lines.sort(key=lambda line: line[1] != "xnewton")
    return markdown(["κ, m", "method", "element", *(decade(error) for error in ERRORS)], lines)


def cheapest(
    rows: list[dict], error: float, seconds: Callable[[dict], float], column: str = "forceError"
) -> dict | None:
    """The converged run of least seconds among those at least as close as `error`, relative; None: none is."""
    close = [row for row in rows if row["status"] == "converged" and value(row, column) <= error]
    return min(close, key=seconds, default=None)


def growth_table(rows: list[dict]) -> str:
    lines = []
    for row in select(rows, name="growth"):
        good = row["status"] == "converged"
        counts = [row["newton"], row["backsolves"]] if good else [row["status"], "-"]
        seconds = [f"{elastic_seconds(row):.2f}", f"{contact_seconds(row):.2f}", f"{value(row, 'costRatio'):.2f}"]
        lines.append(
            [problem_words(row), row["ndof"], *counts, *(seconds if good else "---"), f"{value(row, 'memory'):.0f}"]
        )
    header = "κ, m|dofs|linearisations|back-substitutions|elastic solve, s|contact, s|cost ratio|MB"
    return markdown(header.split("|"), lines)


def exponents_table(rows: list[dict]) -> str:
    """Exponents of seconds over degrees of freedom, problem by problem."""
    lines = []
    sizes = select(rows, name="growth", status="converged")
    for which in dict.fromkeys(map(problem, sizes)):
        group = [row for row in sizes if problem(row) == which]
        if len(group) > 2:
            dofs = np.array([value(row, "ndof") for row in group])
            found = [exponent(dofs, np.array(list(map(what, group)))) for what in (contact_seconds, elastic_seconds)]
            found.append(exponent(dofs, np.array([value(row, "memory") for row in group])))
            lines.append([problem_words(group[0]), len(group), *(f"{number:.2f}" for number in found)])
    return markdown(["κ, m", "sizes", "contact", "elastic solve", "memory"], lines)


def cost_map(rows: list[dict]) -> str:
    """Cost ratio of the default method over stiffness and exponent: the plane, P2."""
    rows = select(rows, name="cost", method="xnewton", scene="disc-on-block", order=2)
    grid = []
    for kappa in KAPPAS:
        cells = [select(rows, kappa=kappa, m=m) for m in EXPONENTS]
        grid.append([decade(kappa), *(f"{value(cell[0], 'costRatio'):.2f}" if cell else "–" for cell in cells)])
    return markdown(["κ \\ m", *map(str, EXPONENTS)], grid)


def cost_table(rows: list[dict]) -> str:
    """Method by problem and degree: cost ratio (linearisations)."""
    rows = select(rows, name="cost")
    places = [(scene, order, law) for scene, sizes in ONE_SIZE.items() for order in sizes for law in GROWTH_LAWS]
    lines = []
    for method in dict.fromkeys(map(method_words, rows)):
        cells = []
        for scene, order, (kappa, m) in places:
            group = select([row for row in rows if method_words(row) == method], scene=scene, order=order)
            group = select(group, kappa=kappa, m=m)
            good = group and group[0]["status"] == "converged"
            ratio = f"{value(group[0], 'costRatio'):.3g} ({group[0]['newton']})" if good else ""
            cells.append(ratio if good or not group else group[0]["status"])
        lines.append([method, *cells])
    words = [
        ("sphere, " if scene == SPHERE else "") + f"P{order}: {decade(kappa)}, {m:g}"
        for scene, order, (kappa, m) in places
    ]
    return markdown(["method", *words], lines)


def accuracy_runs(rows: list[dict]) -> str:
    """What was asked, said and true, and the seconds; beside it the meshes that a user would try."""
    lines = []
    for row in rows:
        words = problem_words(row) if row["kappa"] else "crossed cylinders"
        asked = f"{value(row, 'asked'):.0e}" if row["name"] == "adaptive" else f"{row['name']}, {tried(row)}"
        good = row["status"] == "converged"
        numbers = [f"{value(row, name):.1e}" for name in ("said", "forceError")] if good else [row["status"], "–"]
        lines.append([words, asked, row["ndof"], row["meshes"], *numbers, f"{value(row, 'seconds'):.2g}"])
    return markdown("κ, m|asked|dofs|meshes|said|true|CPU s".split("|"), lines)


def tried(row: dict[str, str]) -> str:
    """The size of the elements of a run of part accuracy."""
    size = row["h"] or row["flags"].split(f"{CROSSED}-")[1].split(".geo")[0]
    return f"h = {float(size):g}"


def report_growth(rows: list[dict]) -> str:
    return "\n\n".join(part(rows) for part in (growth_table, exponents_table, cost_map, cost_table))


def variant_of(row: dict[str, str]) -> str:
    """The exchanged ingredients of a run, in words; empty for the default."""
    names = ("start", "preconditioner", "inner", "threshold", "T0")
    flags = flags_of(row)
    return ", ".join(f"{name} {flags['-' + name]}" for name in names if "-" + name in flags)


def report_ingredients(rows: list[dict]) -> str:
    """Per variant: linearisations and back-substitutions, least to greatest, failures, seconds over the default's."""
    lines = []
    baseline = {(row["scene"], law_of(row)): contact_seconds(row) for row in rows if variant_of(row) == ""}
    for variant in dict.fromkeys(map(variant_of, rows)):
        group = [row for row in rows if variant_of(row) == variant]
        good = select(group, status="converged")
        ratios = [contact_seconds(row) / baseline[row["scene"], law_of(row)] for row in good]
        cells = [variant or "default", f"{len(group) - len(good)} of {len(group)}"]
        for name in ("newton", "backsolves", "adaptations"):
            values = [int(row[name]) for row in good]
            cells.append(f"{min(values)} to {max(values)}" if values else "-")
        cells.append(f"{np.median(ratios):.2f} ({max(ratios):.2f})" if ratios else "-")
        lines.append(cells)
    header = ["ingredients", "failed", "linearisations", "back-substitutions", "adaptations", "seconds over default's"]
    return markdown(header, lines)


def law_of(row: dict[str, str]) -> str:
    """The law and its parameters, short."""
    if row["law"] == "power":
        return f"power {float(row['kappa']):g} {float(row['m']):g}"
    if row["law"] == "exponential":
        return f"exponential {float(row['p0']):g} {float(row['beta']):g}"
    return f"{row['law']} {float(row['p0']):g}"


# part: (its cases, further columns, what fills them, its summary)
PARTS = {
    "work_precision": (work_precision, ("forceError", "pressureError"), iteration_error, report_work_precision),
    "meshes": (meshes, reference.COLUMNS, reference.errors, meshes_table),
    "growth": (growth, (), None, report_growth),
    "ingredients": (ingredients, (), None, report_ingredients),
    "hertz": (hertz, ("radius", "pressure"), hertz_differences, hertz_table),
    "large": (large, ("iterations", "oneSolve"), solves, large_table),
    "ranks": (ranks_cases, ("iterations", "ranks", "answer", "greatest"), answers, ranks_table),
    "accuracy": (accuracy_cases, ("forceError", "said", "asked", "meshes", "seconds"), accuracy_errors, accuracy_runs),
}
OPT_IN = ("large", "ranks")
# what a part adds to the sources: name to text
FILES = {
    "accuracy": accuracy_files,
    "large": large_files,
    "ranks": ranks_files,
}


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "parts", nargs="*", metavar="PART", help=f"of {', '.join(PARTS)} (default: all but {', '.join(OPT_IN)})"
    )
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (default 1: they are timed)")
    parser.add_argument("--repeats", type=int, default=REPEATS, help=f"of a timed run at most (default {REPEATS})")
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of the CSV files")
    arguments = parser.parse_args(argv)
    unknown = set(arguments.parts) - set(PARTS)
    if unknown:
        parser.error(f"no such part: {', '.join(sorted(unknown))}")
    for name in arguments.parts or [name for name in PARTS if name not in OPT_IN]:
        cases, columns, measure, report = PARTS[name]
        path = arguments.out / f"{name}.csv"
        chosen = cases(campaign.ROOT)
        chosen = [dataclasses.replace(item, repeats=min(item.repeats, arguments.repeats)) for item in chosen]
        try:
            files = FILES[name](campaign.ROOT) if name in FILES else None
            rows = campaign.run(chosen, path, arguments.jobs, columns, measure, campaign.ROOT, files, title=name)
        except KeyboardInterrupt:
            print("\ninterrupted; started again, it goes on from here", file=sys.stderr)
            return 130
        print(f"\n{name}\n{report(rows)}\n", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
