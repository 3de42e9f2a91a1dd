"""Counts and failures over laws, stiffness, meshes, loads and thresholds: `make stability`, results/stability/.

`stability.csv` has a row per run, `checks.csv` a row per comparison of a converged xnewton run with something that does
not depend on it: plain Newton on the full law (or, where that fails, the paper's scheme), the exact state of confined
blocks, the limits of a rigid layer and of a linear one, a twin in other units; and a row per count that has a limit.
`--quick` runs the subset that is part of the tests (`quick.csv`), `python tests/campaigns/stability.py patch-test` this
part alone (`parts.csv`). Interrupted and started again, it goes on where it was.
"""

import argparse
import dataclasses
import sys
from collections import defaultdict
from itertools import pairwise
from pathlib import Path

import campaign
import numpy as np
import reference
from campaign import case, decade, flags_of, markdown, select, signed, value

FOLDER = campaign.RESULTS_FOLDER / "stability"
COLUMNS = ("stepsPerModel", "rounds", "masterForce", "approach")


def power(kappa: float, m: float) -> dict:
    return {"law": "power", "kappa": kappa, "m": m}


KAPPAS = (1e-2, 1.0, 1e3, 1e6, 1e9, 1e12, 1e30)
EXPONENTS = (1.05, 2, 3, 3.3, 10, 20, 30)
POWER = [power(kappa, m) for kappa in KAPPAS for m in EXPONENTS]
OTHER = [{"law": "exponential", "p0": 0.02, "beta": beta} for beta in (60, 500)]
OTHER += [{"law": "barrier", "p0": p0} for p0 in (1, 1e-4)]
HARD = {"law": "signorini"}
LAWS = POWER + OTHER
TABLE = {"law": "table", "table": "table.csv"}
# The corners of the box and two laws inside it; a few laws; those that all methods are run with.
SAMPLE = [power(kappa, m) for kappa in (1e-2, 1e30) for m in (1.05, 30)]
SAMPLE += [power(kappa, 3) for kappa in (1e3, 1e12)] + OTHER
STIFF = [power(1e3, 3), power(1e3, 10), power(1e9, 3), power(1e12, 3), power(1e30, 30)]
FEW = [STIFF[0], STIFF[3], STIFF[4]]
METHOD_LAWS = [power(kappa, m) for kappa in (1e-2, 1.0, 1e3, 1e12, 1e30) for m in (1.05, 3, 10, 30)] + OTHER

TOL = 1e-8
GAP, D0, U0, SIZE = 0.5, -0.25, 2.5, 40.0  # the paper's test
STEPS = {1: (0.5, 0.1), 2: (0.5, 0.1), 3: (1.0, 0.5), 4: (1.0, 0.5)}
COARSE = [{"h": h, "order": order} for order, steps in STEPS.items() for h in steps]
FINE = [{"h": h, "order": order, "grading": 80} for h in (0.05, 0.025) for order in (1, 2)]
FINE += [{"h": h, "order": 4, "grading": 80} for h in (0.1, 0.05)]
FINEST = [mesh for mesh in FINE if mesh["h"] == (0.05 if mesh["order"] == 4 else 0.025)]  # for FEW; the others SAMPLE
SMALL = [mesh for mesh in COARSE if mesh["h"] >= 0.5 and (mesh["h"] == 1 or mesh["order"] < 3)]  # one a degree
RIVALS = {"h": 0.5, "order": 2}  # the mesh that all methods are run on
MAP = {"h": 0.1, "order": 2}  # that of the table of counts over stiffness and exponent
# a guess of one xnewton run
SECONDS = {(0.5, 1): 0.1, (0.5, 2): 0.1, (0.1, 1): 0.35, (0.1, 2): 1.0}
SECONDS |= {(1.0, 3): 0.25, (0.5, 3): 0.3, (1.0, 4): 0.35, (0.5, 4): 0.4, (0.1, 4): 2.0}
SECONDS |= {(0.05, 1): 0.8, (0.05, 2): 2.5, (0.025, 1): 2.0, (0.025, 2): 5.5, (0.05, 4): 5.5}
LOADS = (GAP + D0 + 1e-12 * SIZE, GAP + D0 + 1e-6 * SIZE, 0.1 * U0 + 0.9 * (GAP + D0), 0.5 * U0, 2 * U0)
STARTS = {"0": {"T0": "0"}, "d0": {"T0": "d0"}}

# a steel bearing in SI units, and the same numbers with lengths in units of 5 mm, pressures in units of E
STEEL = {"E": 2.1e11, "nu": 0.3, "R": 5e-3, "width": 2e-2, "depth": 1e-2, "gap": 1e-6, "d0": -1e-6, "u0": 4e-6}
STEEL_SCENE = {"grading": 400}
STEEL_KAPPA = [(20.0, 2.0), (1e3, 3.0), (1e9, 3.0)]  # kappa scaled: p/E = kappa' ((d - d0)/(1 micrometre))^m * 1e-6


def weight(h: float = 0.25, order: int = 1, **_) -> float:
    return SECONDS.get((h, order), 0.5 * order)


def cases(_root: Path = campaign.ROOT) -> list[campaign.Case]:
    """The whole map: the default method first, its grid before all."""
    found = extreme() + steel() + further() + bodies() + documented()

    def add(name, *parts, factor=1.0, **flags):
        merged = {"tol": TOL}
        for part in parts:
            merged |= part
        merged |= flags
        found.append(case(name, weight=factor * weight(**merged), **{"method": "xnewton", **merged}))

    # the grid: every law and stiffness on the coarse meshes, some on the fine ones; other first thresholds, no start
    for mesh in COARSE + FINE:
        add("grid", HARD, mesh, T0="auto")
        if mesh in SMALL:
            add("grid", HARD, mesh, method="signorini", factor=5)
        for law in LAWS if mesh in COARSE else FEW if mesh in FINEST else SAMPLE:
            add("grid", law, mesh, T0="auto")
    for law in SAMPLE:
        for mesh in COARSE:
            add("no start", law, mesh, T0="auto", start="none", factor=1.3)
        for mesh in SMALL:
            for start in STARTS.values():
                add("threshold", law, mesh, start)
            if mesh != RIVALS:
                add("rival", law, mesh, method="newton", factor=5)
    # the other methods on one mesh
    for law in LAWS:
        add("rival", law, RIVALS, method="newton", factor=3)
    for law in METHOD_LAWS:
        add("rival", law, RIVALS, method="linesearch", factor=3)
        add("rival", law, RIVALS, method="paper", T0="0", factor=3)
        add("rival", law, RIVALS, method="paper", T0="d0", factor=3)
        add("rival", law, RIVALS, method="incremental", steps=5, factor=10)
        add("rival", law, RIVALS, method="ipopt", factor=3)
    # loads
    for u0 in LOADS:
        for law in SAMPLE:
            for mesh in SMALL:
                add("load", law, mesh, u0=u0)
        for law in FEW + OTHER[::3]:
            for method in ("newton", "paper"):
                add("load", law, {"h": 0.5, "order": 1}, u0=u0, method=method, factor=5)
    # other scenes
    for scene in ("meshed-disc", "wavy", "flat-punch", "confined-block"):
        for law in [*SAMPLE, TABLE]:
            for mesh in ({"h": 0.5, "order": 1}, {"h": 0.25, "order": 2}):
                add("scene", law, mesh, scene=scene)
        for law in [*FEW, TABLE]:
            add("scene", law, {"h": 0.5, "order": 1}, scene=scene, method="newton", factor=5)
    for order in (1, 2):
        add("scene", TABLE, h=0.1, order=order)
        add("scene", TABLE, h=0.1, order=order, method="newton")
    # against the exact state
    for law in POWER:
        add("exact", law, scene="confined-block", h=1.0, order=1)
    # a rigid layer and a linear one
    for m in (2, 3, 10):
        for kappa in (1e6, 1e9, 1e12, 1e15, 1e18, 1e24, 1e30):
            add("rigid layer", power(kappa, m), h=0.25, order=2)
    add("rigid layer", h=0.25, order=2, method="signorini")
    add("rigid layer", h=0.25, order=2, law="signorini")
    for m in (1.1, 1.01, 1.001, 1.0001, 1.00001):
        for kappa in (1.0, 1e3):
            add("linear layer", power(kappa, m), h=0.25, order=2)
            add("linear layer", power(kappa, m), h=0.25, order=2, method="newton")
    found = sorted(found, key=lambda item: (item.parameters["method"] != "xnewton", item.name != "grid"))
    return [item if "ipopt" in item.script else without_estimates(item) for item in found]


def without_estimates(item: campaign.Case) -> campaign.Case:
    """The case with -estimate 0: no table has errors."""
    return dataclasses.replace(item, flags=(*item.flags, "-estimate", "0"))


def extreme() -> list[campaign.Case]:
    """Named extreme cases, each with several laws, and by plain Newton to compare with."""
    found = []

    def add(name, scene="disc-on-block", laws=FEW, compared=True, **flags):
        for law in laws:
            for method, factor in (("xnewton", 1), ("newton", 5))[: 1 + compared]:
                merged = {"method": method, "tol": TOL, **law, **flags}
                found.append(case(name, scene=scene, weight=factor * weight(**merged), **merged))

    add("nu 0.4999", compared=False, nu=0.4999, h=0.1, order=2)
    add("nu 0.4999", nu=0.4999, h=0.5, order=2)
    for stiffness in (1e-6, 1.0, 1e12):
        add("E", E=stiffness, h=0.25, order=2)
    for d0 in (-1e-12, -1e-3, -5.0):
        add("d0", laws=FEW + OTHER[::3], d0=d0, h=0.5, order=2)
    for aspect in (10, 100):
        for order in (1, 2):
            add("aspect", aspect=aspect, h=1.0, order=order)
    for offset in (15, -20):
        for order in (1, 2):
            add("offset", offset=offset, h=0.5, order=order)
    add("20 contacts", compared=False, scene="wavy", h=0.1, order=2)
    add("20 contacts", scene="wavy", h=0.1, order=1)
    add("flat punch", scene="flat-punch", laws=FEW + OTHER, h=0.25, order=2)
    add("flat punch", compared=False, scene="flat-punch", h=0.05, order=2)
    for order in (1, 2):
        add("u0 three times", compared=order == 1, laws=FEW + OTHER, u0=3 * U0, h=0.1, order=order)
    for (scene, kappa, m), known in reference.values().items():
        law = power(kappa, m) if np.isfinite(kappa) else HARD
        for mesh in ({"h": 0.5, "order": 2}, {"h": 1.0, "order": 4}, {"h": 0.5, "order": 4, "grading": 60}):
            if scene == "disc-on-block":
                merged = {"method": "xnewton", "tol": TOL, **law, **mesh, "ends": round(known["halfWidth"], 3)}
                found.append(case("ends", weight=weight(**mesh), **merged))
    add("stiff disc", scene="meshed-disc", Eratio=1e6, h=0.25, order=2)
    add("equal bodies", scene="meshed-disc", Eratio=1, h=0.25, order=2)
    return found


def further() -> list[campaign.Case]:
    """Kinds of problem beyond the paper's: rough surface, prescribed force, the true distance to the disc."""
    found = []

    def add(name, **flags):
        for law in FEW + OTHER[:1] if name == "rough" else SAMPLE:
            merged = {"method": "xnewton", "tol": TOL, **law, **flags}
            found.append(case(name, weight=weight(**merged), **merged))

    for order in (1, 2):
        add("rough", scene="rough", h=0.1, order=order)
        add("prescribed force", force=100, h=0.25, order=order)
        add("exact distance", distance="exact", h=0.25, order=order)
    return found


# two meshed bodies and space: scene and its flags, every law of BODY_LAWS on each
BODY_LAWS = [power(kappa, m) for kappa in (1.0, 1e12) for m in (1.05, 20)]
BODY_LAWS += [power(kappa, 3) for kappa in (1e3, 1e30)] + [*OTHER[::3], HARD]
SPACE = ("two-spheres", "sphere-on-plane", "sphere-on-block", "patch-test-3d", "counts in space")
RATIOS = (1e-6, 1.0, 1e9)
POINTS = ("segment", "nodal")
CURVED = {("two-cylinders", order): {"d0": -0.01, "h": 0.1} for order in (1, 2)}
CURVED |= {
    (scene, order): {"d0": -0.01, "h": 0.2 * order, "layers": 3 - order}
    for scene in ("two-spheres", "sphere-on-plane")
    for order in (1, 2)
}


def bodies() -> list[campaign.Case]:
    """Two meshed bodies, curved or flat, and contact in space; each beside another method on the same problem."""
    found = []

    def add(scene, others=True, **flags):
        for law in BODY_LAWS:
            common = {"tol": TOL, **law, **flags}
            found.append(case(scene, scene=scene, weight=0.4, method="xnewton", **common))
            if not others:
                continue
            if law["law"] == "power":
                found.append(case(scene, scene=scene, weight=1.5, method="newton", **common))
                if (law["kappa"], law["m"]) == (1.0, 20):  # under a prescribed force plain Newton creeps there
                    found.append(case(scene, scene=scene, weight=0.6, method="linesearch", **common))
            elif law["law"] == "signorini":
                found.append(case(scene, scene=scene, weight=0.8, method="signorini", **common))
            else:
                found.append(case(scene, scene=scene, weight=1.5, method="paper", T0="d0", eps=1e-12, **common))

    for (scene, order), flags in CURVED.items():
        points = POINTS if scene != "sphere-on-plane" else ("",)
        for which in points:
            place = {"points": which} if which else {}
            add(scene, others=which == points[0], order=order, **flags, **place)
        add(scene, others=False, order=order, **flags, force=0, **({"points": points[0]} if points[0] else {}))
    for ratio in RATIOS:
        for order in (1, 2):
            compared = order == 1 and ratio == 1
            add("patch-test", others=compared, order=order, Eratio=ratio)
            add("patch-test-3d", others=compared, order=order, Eratio=ratio)
    for ratio in (1.0, 1e9):
        for points in POINTS:
            for order in (1, 2):
                compared = order == 1 and points == POINTS[0]
                add("meshed-disc", others=compared, order=order, Eratio=ratio, points=points, h=0.5)
    add("meshed-disc", order=4, h=1.0)
    for order in (1, 2):
        add("rough", others=order == 1, order=order, h=0.25)
    for symmetry in ("quarter", "whole"):
        add("sphere-on-block", others=symmetry == "quarter", order=1, h=1.0, symmetry=symmetry)
    add("sphere-on-block", order=2, h=1.5, layers=2)
    add("sphere-on-block", others=False, order=2, h=1.0)
    return found


# the meshes of the table of the paper's count, and its tolerances; the scenes of that of the counts in space
COUNTED = [*({"order": 1, "h": h} for h in (1.0, 0.5, 0.25, 0.1)), {"order": 2, "h": 0.1}]
COUNTED_TOLERANCES = (1e-4, 1e-6, 1e-8)
IN_SPACE = {"sphere-on-block": {"order": 2, "h": 1.0}, "two-spheres": {"order": 2, "d0": -0.01, "h": 0.2, "layers": 3}}
SPACE_LAWS = [power(kappa, m) for kappa in (1.0, 1e3, 1e6, 1e9, 1e12) for m in (1.05, 3, 20)]
AGREEING = {"order": 2, "h": 0.25, "tol": 1e-10, "eps": 1e-12}
STIFFER = {"method": "paper", "order": 2, "h": 0.25, "eps": 1e-8, "tol": 1e-10}


def documented() -> list[campaign.Case]:
    """Further runs of the documentation's tables."""
    found = []
    for mesh in COUNTED:
        for start in STARTS.values():
            for tol in COUNTED_TOLERANCES:
                found.append(case("the paper's count", weight=2, method="paper", **mesh, **start, tol=tol))
    for method in ("xnewton", "paper", "newton", "incremental"):
        found.append(case("same answer", weight=2, method=method, **AGREEING))
    for ratio in (1e1, 1e2, 1e3, 1e4, 1e5, 1e6):
        found.append(case("stiffer disc", scene="meshed-disc", weight=3, Eratio=ratio, **STIFFER))
    found.append(case("stiffer disc", weight=2, **STIFFER))
    for scene, flags in IN_SPACE.items():
        for law in SPACE_LAWS:
            found.append(case("counts in space", scene=scene, weight=1.5, method="xnewton", tol=TOL, **law, **flags))
    return found


def steel() -> list[campaign.Case]:
    """The bearing in SI units and its twin without units: lengths over R, pressures over E."""
    found = []
    radius, modulus = STEEL["R"], STEEL["E"]
    for kappa, m in STEEL_KAPPA:
        rigidity = kappa * modulus * 1e-6 / 1e-6**m
        for h in (4e-3, 2e-3):
            common = {"method": "xnewton", "tol": TOL, "law": "power", "m": m, "order": 2, **STEEL_SCENE}
            lengths = {name: STEEL[name] for name in ("R", "width", "depth", "gap", "d0", "u0")} | {"h": h * radius}
            found.append(case("steel SI", **common, **lengths, nu=0.3, E=modulus, kappa=rigidity))
            scaled = {name: length / radius for name, length in lengths.items()}
            found.append(case("steel twin", **common, **scaled, nu=0.3, E=1.0, kappa=rigidity * radius**m / modulus))
    return found


def quick() -> list[campaign.Case]:
    """Some thirty runs of the default method, quick ones, that touch most parts of the map."""
    found = [item for item in cases() if item.parameters["method"] == "xnewton" and item.weight <= 0.4]
    grid = [item for item in found if item.name == "grid" and item.parameters["order"] == "2"]
    parts = list({item.name: item for item in found}.values())
    return [*grid[::4], *parts]


def measure(*_):
    """COLUMNS: linearisations of each model, solves with the true distance, force on a meshed master, approach."""

    def further_columns(item: campaign.Case, summary: dict, folder: Path) -> dict:
        return {
            "stepsPerModel": " ".join(map(str, summary["newtonPerAdaptation"])),
            "rounds": summary.get("rounds"),
            "masterForce": summary.get("masterForceZ", summary.get("masterForceY")),
            "approach": summary["approach"],
        }

    return further_columns


def law_table() -> str:
    """A measured law: 40 pairs of the power law kappa = 1e3, m = 3, up to an overlap of 1."""
    overlaps = np.linspace(D0, 1.0, 40)
    return "overlap,pressure\n" + "".join(f"{d:.12g},{1e3 * (d - D0) ** 3:.12g}\n" for d in overlaps)


# ---------------------------------------------------------------- checks

PROBLEM = "scene law kappa m p0 beta d0 E nu R gap u0 h order grading aspect offset".split()
NOTHING = 1e-150  # a force or pressure below is none: its square underflows
BODIES = "two-cylinders two-spheres sphere-on-plane sphere-on-block patch-test patch-test-3d meshed-disc rough".split()
PRESCRIBED = {"two-cylinders": 8.631, "two-spheres": 14.652014652, "sphere-on-plane": 14.652014652}  # scenes' -force
MORE_PROBLEM = ("-force", "-distance", "-Eratio", "-points", "-layers", "-ends", "-symmetry")  # flags without a column


def problem(row: dict[str, str]) -> tuple[str, ...]:
    """The problem that a run solves, whatever the method: rows that share it have the same answer."""
    flags = flags_of(row)
    return tuple([*(row[name] for name in PROBLEM), *(flags.get(name, "") for name in MORE_PROBLEM)])


def checks(rows: list[dict[str, str]]) -> list[dict]:
    """Comparisons of xnewton's answers with independent ones."""
    good = [row for row in rows if row["status"] == "converged"]
    kinds = against_newton, against_exact_state, rigid_layer, linear_layer, twins, reactions, counts
    return [entry for kind in kinds for entry in kind(good)]


def check(what: str, row: dict, found: float, expected: float, tolerance: float, error: float | None = None) -> dict:
    """One comparison; the error is relative unless given."""
    if error is None:
        error = abs(found - expected) / max(abs(expected), NOTHING)
    told = {"check": what, "name": row["name"], "flags": row["flags"], "found": found, "expected": expected}
    return told | {"error": error, "tolerance": tolerance, "passed": bool(error <= tolerance)}


def against_newton(rows: list[dict]) -> list[dict]:
    """Force and greatest pressure of plain Newton on the same problem; the energy never above any other method's.

    Both stop at a residual of 1e-8; a soft body under a steep law turns that into at most 1e-6 of the force. Where no
    run of plain Newton has converged: hard contact by the paper's inner loop, or the paper's scheme to its exact stop.
    """
    groups = defaultdict(list)
    for row in rows:
        groups[problem(row)].append(row)
    found = []
    for group in groups.values():
        exact = [row for row in select(group, method="paper") if value(row, "eps") <= TOL]
        peers = [row for name in ("newton", "linesearch", "signorini") for row in select(group, method=name)] + exact
        others = [row for row in group if row["method"] in ("newton", "linesearch", "incremental")] or peers
        for row in select(group, method="xnewton"):
            for other in peers[:1]:
                name = other["method"]
                found.append(check(f"force, {name}", row, value(row, "force"), value(other, "force"), 1e-6))
                found.append(
                    check(f"pressure, {name}", row, value(row, "pressureMax"), value(other, "pressureMax"), 1e-5)
                )
            if others:
                lowest = min(total_energy(other) for other in others)
                above = (total_energy(row) - lowest) / max(abs(lowest), 1e-300)
                found.append(check("energy", row, total_energy(row), lowest, 1e-12, max(above, 0.0)))
    return found


def total_energy(row: dict) -> float:
    """What the solution minimises: with a prescribed force the force's work on the approach is part of it."""
    prescribed = float(flags_of(row).get("-force", PRESCRIBED.get(row["scene"], 0)))
    return value(row, "energy") - (prescribed * value(row, "approach") if prescribed else 0.0)


def against_exact_state(rows: list[dict]) -> list[dict]:
    """Confined blocks, one or two of them: one scalar equation for the uniform pressure."""
    found = []
    flat = [*select(rows, name="patch-test"), *select(rows, name="patch-test-3d")]
    for row in [*select(rows, name="exact"), *select(flat, method="xnewton", law="power")]:
        young, nu, kappa, m, d0, gap, u0 = (value(row, name) for name in "E nu kappa m d0 gap u0".split())
        modulus = young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        height = 20.0 if row["name"] == "exact" else 20.0 + 10.0 / float(flags_of(row)["-Eratio"])
        push = u0 - gap - d0
        low, high = -700.0, np.log(modulus * push / height)  # of log p: p = M (push - s)/height, s = (p/kappa)^(1/m)
        for _ in range(200):
            middle = 0.5 * (low + high)
            s = np.exp((middle - np.log(kappa)) / m)
            low, high = (middle, high) if modulus * (push - s) / height > np.exp(middle) else (low, middle)
        found.append(check("exact state", row, value(row, "pressureMax"), float(np.exp(low)), 1e-7))
    return found


def rigid_layer(rows: list[dict]) -> list[dict]:
    """kappa to infinity: the force tends to Signorini's with kappa^(-1/m); the observed rate."""
    mine = select(rows, name="rigid layer")
    limits = [row for row in mine if row["method"] == "signorini"]
    if not limits:
        return []
    limit = value(limits[0], "force")
    found = []
    for other in select(mine, law="signorini", method="xnewton"):
        found.append(check("hard contact", other, value(other, "force"), limit, 1e-7))
    for m in (2, 3, 10):
        line = sorted(select(mine, method="xnewton", law="power", m=m), key=lambda row: value(row, "kappa"))
        away = [(value(row, "kappa"), limit - value(row, "force"), row) for row in line]
        away = [entry for entry in away if entry[1] > 1e-6 * limit]  # above the accuracy of the runs
        for (k1, d1, _), (k2, d2, row) in pairwise(away):
            rate = np.log(d2 / d1) / np.log(k2 / k1)
            close = d1 < 0.05 * limit  # the rate is that of the end
            found.append(check(f"rate to hard contact, m = {m}", row, rate, -1 / m, 0.05 if close else 0.5))
    return found


def linear_layer(rows: list[dict]) -> list[dict]:
    """m to 1: forces of m = 1 + e differ from the limit in proportion to e; limit: plain Newton's at e = 1e-5."""
    mine = select(rows, name="linear layer")
    found = []
    for kappa in (1.0, 1e3):
        ends = select(mine, method="newton", kappa=kappa, m=1.00001)
        line = sorted(select(mine, method="xnewton", kappa=kappa), key=lambda row: value(row, "m"))
        if not ends:
            continue
        limit = value(ends[0], "force")
        away = [
            (value(row, "m") - 1, abs(value(row, "force") - limit), row) for row in line if value(row, "m") > 1.00005
        ]
        for (e1, d1, _), (e2, d2, row) in pairwise(away):
            rate = np.log((d2 + 1e-300) / (d1 + 1e-300)) / np.log(e2 / e1)
            found.append(check("rate to a linear layer", row, rate, 1.0, 0.15))
    return found


def twins(rows: list[dict]) -> list[dict]:
    """The bearing in SI units and its twin: the same counts, forces scaled."""
    mine, theirs = select(rows, name="steel SI"), select(rows, name="steel twin")
    found = []
    for row in mine:
        twin = [
            other
            for other in theirs
            if abs(value(row, "h") / STEEL["R"] - value(other, "h")) < 1e-9
            and value(row, "m") == value(other, "m")
            and abs(value(row, "kappa") * STEEL["R"] ** value(row, "m") / STEEL["E"] / value(other, "kappa") - 1) < 1e-6
        ]
        if not twin:
            continue
        counts = "newton kernelNewton backsolves adaptations".split()
        differing = sum(row[name] != twin[0][name] for name in counts)
        found.append(check("twin, counts", row, differing, 0, 0))
        scale = STEEL["E"] * STEEL["R"]
        found.append(check("twin, force", row, value(row, "force") / scale, value(twin[0], "force"), 1e-9))
    return found


def reactions(rows: list[dict]) -> list[dict]:
    """Two meshed bodies: what the master takes is the contact force."""
    both = [row for row in rows if row["masterForce"] != "" and value(row, "force") > NOTHING]
    return [check("force on the master", row, value(row, "masterForce"), value(row, "force"), 1e-12) for row in both]


def counts(rows: list[dict]) -> list[dict]:
    """Counts with a limit: the grid with P2, P3 and P4; two bodies, rough surface and space; the true distance."""
    found = []

    def at_most(what, row, name, limit):
        more = max(value(row, name) - limit, 0.0)
        found.append(check(f"{what}, at most {limit}", row, value(row, name), limit, 0, more))

    parts = {item.name for item in bodies()}
    for row in select(rows, method="xnewton"):
        if row["name"] == "grid" and row["order"] in ("2", "3", "4"):
            at_most(f"linearisations, P{row['order']}", row, "newton", 4)
            at_most(f"back-substitutions, P{row['order']}", row, "backsolves", 20)
        elif row["name"] == "exact distance":
            at_most("rounds of the true distance", row, "rounds", 6)
            at_most("linearisations, true distance", row, "newton", 25)
        elif row["name"] in SPACE:
            if row["law"] == "power" and 1 <= value(row, "kappa") <= 1e12 and value(row, "m") <= 20:
                at_most("linearisations in space", row, "newton", 5)
                at_most("back-substitutions in space", row, "backsolves", 35)
        elif row["name"] in parts:
            at_most("linearisations in the plane", row, "newton", 10)
    return found


# ---------------------------------------------------------------- what came out


PARTS = {
    "grid": "every law and stiffness, hard contact",
    "no start": "some of them without the half-plane's start",
    "threshold": "some of them from T⁰ = 0 and T⁰ = d0",
    "load": "overlaps from 1e-12 of the size to twice the paper's load",
    "ends": "meshes that shrink to the ends of contact, `-ends`",
    "u0 three times": "three times the paper's load",
    "scene": "the scenes of the plane",
    "E": "E from 1e-6 to 1e12",
    "d0": "d0 from -1e-12 to -5",
    "aspect": "elements flattened 1:10 and 1:100",
    "offset": "disc near the block's edge",
    "20 contacts": "20 contacts, `wavy`",
    "exact": "`confined-block`",
    "steel SI": "a steel bearing in SI units",
    "steel twin": "the same without units",
    "exact distance": "true distance, all rounds together",
    "same answer": "the paper's test, to a residual of 1e-10",
    "counts in space": "`sphere-on-block`, `two-spheres` over κ and m",
}
DEGREES = ("1", "2", "3", "4")


def degree(row: dict[str, str]) -> str:
    """The degree of the elements, as text; a run that does not tell it was refused or crashed."""
    return row["order"] or flags_of(row).get("-order", "")


def greatest(rows: list[dict], name: str) -> str:
    """The greatest count, for each degree that was run: "3 / 4", a dash where no run converged."""
    found = []
    for order in DEGREES:
        group = [row for row in rows if degree(row) == order]
        good = [value(row, name) for row in group if row["status"] == "converged"]
        if group:
            found.append(f"{max(good):.0f}" if good else "–")
    return " / ".join(found)


def parts_table(rows: list[dict]) -> str:
    """Worst counts of the default method by part of the map; the degrees of the elements in turn."""
    lines = []
    rows = select(rows, method="xnewton")
    names = list(dict.fromkeys([*PARTS, *(row["name"] for row in rows)]))
    for name in names:
        group = select(rows, name=name)
        if group:
            failed = sum(row["status"] != "converged" for row in group)
            degrees = " / ".join(f"P{order}" for order in DEGREES if any(degree(row) == order for row in group))
            word = PARTS.get(name, f"`{name}`" if name in BODIES else name)
            counts = [greatest(group, count) for count in ("newton", "kernelNewton", "backsolves", "adaptations")]
            lines.append([word, degrees, len(group), failed, *counts])
    header = "part|elements|runs|failed|linearisations|on the kernel|back-substitutions|adaptations"
    return markdown(header.split("|"), lines)


def methods_table(rows: list[dict]) -> str:
    """The other methods: runs, failures, linearisations."""
    lines = []
    for method in dict.fromkeys(row["method"] for row in rows if row["method"] != "xnewton"):
        group = select(rows, method=method)
        good = [value(row, "newton") for row in group if row["status"] == "converged"]
        counts = [f"{np.median(good):.0f}", f"{max(good):.0f}"] if good else ["–", "–"]
        lines.append([f"`{method}`", len(group), len(group) - len(good), *counts])
    return markdown(["method", "runs", "failed", "linearisations, median", "most"], lines)


CHOSEN = [power(*law) for law in ((1e-2, 3), (1.0, 3), (1e3, 3), (1e12, 3), (1e3, 30))] + [OTHER[0], OTHER[2]]


def laws_table(rows: list[dict]) -> str:
    """Method by law on one mesh: adaptations / linearisations, or how it failed."""
    rows = select([*select(rows, name="grid"), *select(rows, name="rival")], **RIVALS)
    rows = [row for row in rows if row["law"] != "signorini"]
    lines = []
    for method, start in dict.fromkeys((row["method"], row["T0"] * (row["method"] == "paper")) for row in rows):
        group = [row for row in select(rows, method=method) if method != "paper" or row["T0"] == start]
        cells = []
        for law in CHOSEN:
            (row, *_) = select(group, **law) or [None]
            good = row and row["status"] == "converged"
            cells.append(f"{row['adaptations']} / {row['newton']}" if good else row["status"] if row else "")
        more = f", T0 = {start}" if start else ", `-steps 5`" if method == "incremental" else ""
        lines.append([f"`{method}`{more}", *cells])
    words = [f"κ={decade(law['kappa'])}, m={law['m']}" if law["law"] == "power" else law["law"] for law in CHOSEN]
    return markdown(["method", *words], lines)


def checks_table(verified: list[dict]) -> str:
    lines = []
    for kind in sorted({entry["check"] for entry in verified}):
        group = [entry for entry in verified if entry["check"] == kind]
        failed = sum(not entry["passed"] for entry in group)
        allowed, most = max(entry["tolerance"] for entry in group), max(entry["error"] for entry in group)
        lines.append([kind, len(group), failed, f"{allowed:.0e}" if allowed else "0", f"{most:.1e}"])
    return markdown(["compared", "comparisons", "not passed", "allowed", "greatest error"], lines)


def count(row: dict[str, str] | None, names: str = "newton backsolves") -> str:
    """Two counts of a run, "3 / 9"; how it ended, if it did not converge; nothing where there is no run."""
    if row is None:
        return ""
    return " / ".join(row[name] for name in names.split()) if row["status"] == "converged" else row["status"]


def first(rows: list[dict], **wanted) -> dict[str, str] | None:
    return next(iter(select(rows, **wanted)), None)


def paper_table(rows: list[dict]) -> str:
    """The paper's scheme by mesh, first threshold and tolerance: adaptations / linearisations."""
    rows = select(rows, name="the paper's count")
    lines = []
    for mesh in COUNTED:
        cells = [(start["T0"], tol) for start in STARTS.values() for tol in COUNTED_TOLERANCES]
        found = [first(rows, T0=start, tol=tol, **mesh) for start, tol in cells]
        lines.append([f"P{mesh['order']}, {mesh['h']:g}", *(count(row, "adaptations newton") for row in found)])
    words = [f"T⁰={start}, tol {decade(tol)}" for start in STARTS for tol in COUNTED_TOLERANCES]
    return markdown(["mesh", *words], lines)


def same_table(rows: list[dict]) -> str:
    """Force, greatest pressure and energy of the methods on one mesh."""
    lines = []
    for row in select(rows, name="same answer"):
        numbers = [value(row, name) for name in ("force", "pressureMax", "energy")]
        lines.append([f"`{row['method']}`", *(f"{number:.9f}" for number in numbers)])
    return markdown(["method", "force", "greatest pressure", "energy"], lines)


def map_table(rows: list[dict], exponents: tuple, names: str) -> str:
    lines = []
    for kappa in KAPPAS:
        cells = [count(first(rows, law="power", kappa=kappa, m=m), names) for m in exponents]
        lines.append([decade(kappa), *cells])
    return markdown(["κ", *(f"m = {m}" if m == exponents[0] else m for m in exponents)], lines)


def counts_table(rows: list[dict]) -> str:
    """The default method over stiffness and exponent: linearisations / back-substitutions."""
    return map_table(select(rows, name="grid", **MAP), EXPONENTS, "newton backsolves")


def newton_table(rows: list[dict]) -> str:
    """Plain Newton over stiffness and exponent: linearisations, each with a factorisation."""
    return map_table(select(rows, name="rival", method="newton", **RIVALS), (2, 3, 10, 20), "newton")


def others_table(rows: list[dict]) -> str:
    """The other laws: the default method's counts, plain Newton's linearisations."""
    lines = []
    for law in OTHER:
        words = " ".join(f"-{name} {text:g}" if name != "law" else f"-law {text}" for name, text in law.items())
        mine = first(select(rows, name="grid", **RIVALS), **law)
        newton = first(select(rows, name="rival", method="newton", **RIVALS), **law)
        lines.append([f"`{words}`", count(mine), count(newton, "newton")])
    return markdown(["law", "`xnewton`", "`newton`"], lines)


def space_table(rows: list[dict]) -> str:
    """Two scenes in space over stiffness and exponent: linearisations / back-substitutions."""
    rows = select(rows, name="counts in space")
    lines = []
    for kappa in dict.fromkeys(law["kappa"] for law in SPACE_LAWS):
        found = [first(rows, scene=scene, kappa=kappa, m=m) for scene in IN_SPACE for m in (1.05, 3, 20)]
        lines.append([decade(kappa), *map(count, found)])
    heads = [f"`{scene}`, m = {m}" if m == 1.05 else m for scene in IN_SPACE for m in (1.05, 3, 20)]
    return markdown(["κ", *heads], lines)


def stiffer_table(rows: list[dict]) -> str:
    """The paper's scheme with the disc meshed, ever stiffer, beside the rigid disc."""
    rows = select(rows, name="stiffer disc", status="converged")
    ratios = [flags_of(row).get("-Eratio") for row in rows]
    rigid = next((row for row, ratio in zip(rows, ratios, strict=True) if ratio is None), None)
    lines = []
    for row, ratio in zip(rows, ratios, strict=True):
        words, away = "`disc-on-block`", ["", ""]
        if ratio is not None and rigid is not None:
            words = decade(float(ratio))
            away = [signed(value(row, name) / value(rigid, name) - 1) for name in ("force", "pressureMax")]
        lines.append([words, count(row, "adaptations newton"), f"{value(row, 'force'):.5f}", *away])
    head = "Eratio|adaptations / Newton steps|force|its difference from `disc-on-block`|greatest pressure's"
    return markdown(head.split("|"), lines)


def report(rows: list[dict], verified: list[dict]) -> str:
    """Worst counts by part of the map and by method, failures and failed checks."""
    parts = [parts_table(rows), methods_table(rows), laws_table(rows)]
    failures = [row for row in rows if row["method"] == "xnewton" and row["status"] != "converged"]
    parts.append(f"{len(rows)} runs; failures of xnewton: {len(failures)}")
    parts += [f"  {row['status']}: {row['script']} {row['flags']}: {row['message']}" for row in failures]
    bad = [entry for entry in verified if not entry["passed"]]
    parts.append(f"{len(verified)} checks of xnewton's answers, {len(bad)} not passed")
    parts.append(checks_table(verified))
    parts += [f"  {e['check']}: {e['found']!r}, expected {e['expected']!r}: {e['flags']}" for e in bad[:40]]
    return "\n".join(parts)


def write_checks(path: Path, entries: list[dict]) -> None:
    temporary = path.with_name(f".{path.name}.part")
    lines = (
        [campaign.csv_line(entries[0])] + [campaign.csv_line(entry.values()) for entry in entries] if entries else []
    )
    temporary.write_text("".join(lines), encoding="utf-8")
    temporary.replace(path)


def run(path: Path, chosen: list[campaign.Case], jobs: int) -> list[dict[str, str]]:
    """The rows of these cases, run where they are not there yet."""
    files = {"table.csv": law_table()}
    return campaign.run(
        chosen, path, jobs=jobs, columns=COLUMNS, measure=measure, files=files, together=lambda item: True
    )


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "parts", nargs="*", metavar="PART", help="names of parts of the map to run alone (default: all)"
    )
    parser.add_argument("--quick", action="store_true", help="the subset that is part of the tests")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time (default 2: they are counted, not timed)")
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of the CSV files")
    arguments = parser.parse_args(argv)
    name, chosen = ("quick", quick()) if arguments.quick else ("stability", cases())
    if arguments.parts:
        unknown = set(arguments.parts) - {item.name for item in chosen}
        if unknown:
            parser.error(f"no such part: {', '.join(sorted(unknown))}")
        name, chosen = "parts", [item for item in chosen if item.name in arguments.parts]
    try:
        rows = run(arguments.out / f"{name}.csv", chosen, arguments.jobs)
    except KeyboardInterrupt:
        print("\ninterrupted; started again, it goes on from here", file=sys.stderr)
        return 130
    verified = checks(rows)
    if name == "stability":
        write_checks(arguments.out / "checks.csv", verified)
    print(report(rows, verified))
    failed = any(row["method"] == "xnewton" and row["status"] != "converged" for row in rows)
    return 1 if failed or not all(entry["passed"] for entry in verified) else 0


if __name__ == "__main__":
    sys.exit(main())
