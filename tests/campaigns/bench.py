"""Error against run time, cost growth, and what each ingredient of the method saves: `make bench`, results/bench/.

work_precision.csv: on one mesh, error of the iteration against seconds, factorisations and back-substitutions.
meshes.csv: over meshes, error against the independent reference solution, against seconds.
growth.csv: seconds, memory and cost ratio over the number of degrees of freedom, and over stiffness at one size.
ingredients.csv: the default method with each of its ingredients exchanged in turn, scene by scene.

Timed runs are repeated five times, one at a time. Failed runs are kept. Interrupted and started again, it goes on where
it was. A part can be run alone: `python tests/campaigns/bench.py growth`.
"""

import argparse
import dataclasses
import functools
import sys
import tempfile
from pathlib import Path

import campaign
import numpy as np
import reference
from campaign import case, markdown, select, value

FOLDER = campaign.ROOT / "results" / "bench"
REPEATS = 5

CASES = [(1e3, 3), (1e3, 10), (1e9, 3), (1e12, 3)]  # kappa, m: the paper's, an extreme one, two stiff ones
TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)
RIVALS = [
    {"method": "xnewton"},
    {"method": "paper", "T0": "0"},
    {"method": "paper", "T0": "d0"},
    {"method": "newton"},
    {"method": "linesearch"},
    {"method": "incremental", "steps": 5},
]
IPOPT = {"method": "ipopt"}

EXPONENTS = (1.05, 2, 3, 3.3, 10, 20, 30)
KAPPAS = (1e-2, 1.0, 1e3, 1e6, 1e9, 1e12, 1e30)

VARIANTS = [
    {},
    {"start": "none"},
    {"preconditioner": "diagonal"},
    {"preconditioner": "none"},
    {"start": "none", "preconditioner": "diagonal"},
    {"inner": "newton"},
    {"inner": "newton", "start": "none"},
    {"T0": "0"},
    {"T0": "d0"},
    {"threshold": "pointwise", "T0": "0"},
    {"threshold": "pointwise", "T0": "d0"},
    {"inner": "newton", "start": "none", "preconditioner": "none", "threshold": "pointwise", "T0": "0"},
]
SCENES = [
    {"scene": "disc-on-block", "h": 0.1, "order": 2},
    {"scene": "meshed-disc", "h": 0.1, "order": 1},
    {"scene": "confined-block", "h": 0.25, "order": 1},
    {"scene": "wavy", "h": 0.1, "order": 1},
    {"scene": "flat-punch", "h": 0.1, "order": 2},
]
LAWS = [
    {"law": "power", "kappa": 1e3, "m": 3},
    {"law": "power", "kappa": 1e9, "m": 10},
    {"law": "power", "kappa": 1e12, "m": 3},
    {"law": "exponential", "p0": 0.02, "beta": 500},
    {"law": "barrier", "p0": 1e-4},
]


def rivals(root: Path) -> list[dict]:
    return RIVALS + ([IPOPT] if campaign.has_ipopt(root) else [])


def work_precision(root: Path) -> list[campaign.Case]:
    found = []
    for kappa, m in CASES:
        for rival in rivals(root):
            for tol in (1e-4, 1e-8) if rival["method"] == "incremental" else TOLERANCES:
                flags = {**rival, "law": "power", "kappa": kappa, "m": m, "h": 0.2, "order": 2, "tol": tol, "eps": tol}
                seconds = {"xnewton": 0.3, "incremental": 7, "ipopt": 5}.get(rival["method"], 1.5)
                found.append(case("work_precision", repeats=REPEATS, weight=seconds, timeout=120, **flags))
    return found


def meshes(_root: Path) -> list[campaign.Case]:
    """P1 and P2 over h; the rivals up to 200 000 degrees of freedom."""
    found = []
    sizes = {1: (1.0, 0.5, 0.25, 0.1, 0.05, 0.025, 0.02), 2: (1.0, 0.5, 0.25, 0.1, 0.05, 0.03)}
    for kappa, m in CASES[:2]:
        for order, steps in sizes.items():
            for h in steps:
                dofs = 512 * (order / h) ** 2 / 4
                for method in ("xnewton", "newton", "paper"):
                    if method != "xnewton" and (dofs > 2.1e5 or (method == "paper" and m != 3)):
                        continue
                    seconds = 1e-5 * dofs * (1 if method == "xnewton" else 10)
                    flags = {"method": method, "law": "power", "kappa": kappa, "m": m, "h": h, "order": order}
                    flags |= {"tol": 1e-8}
                    found.append(case("meshes", repeats=REPEATS, weight=0.1 + seconds, timeout=300, **flags))
    return found


def growth(root: Path) -> list[campaign.Case]:
    """Sizes from 1e4 to 1e6; the whole map of stiffness at 1e5, with the rivals' cost there."""
    found = []
    for h in (0.225, 0.13, 0.0714, 0.041, 0.0225):  # 1e4, 3e4, 1e5, 3e5, 1e6 degrees of freedom
        for kappa, m in CASES:
            flags = {"method": "xnewton", "law": "power", "kappa": kappa, "m": m, "h": h, "order": 2, "tol": 1e-8}
            repeats = REPEATS if (kappa, m) == CASES[0] or h > 0.05 else 1
            found.append(case("growth", repeats=repeats, weight=1.3e-5 * 512 / h**2, timeout=600, **flags))
    for kappa in KAPPAS:
        for m in EXPONENTS:
            flags = {"method": "xnewton", "law": "power", "kappa": kappa, "m": m, "h": 0.0714, "order": 2, "tol": 1e-8}
            found.append(case("cost", repeats=3, weight=1.5, timeout=300, **flags))
    for kappa, m in CASES:
        for rival in rivals(root)[1:]:
            if rival["method"] == "incremental" and (kappa, m) != CASES[0]:
                continue
            flags = {**rival, "law": "power", "kappa": kappa, "m": m, "h": 0.0714, "order": 2, "tol": 1e-8}
            found.append(case("cost", repeats=1, weight=20, timeout=600, **flags))
    return found


def ingredients(_root: Path) -> list[campaign.Case]:
    found = []
    for scene in SCENES:
        for law in LAWS:
            for variant in VARIANTS:
                flags = {"method": "xnewton", **scene, **law, "tol": 1e-8, **variant}
                found.append(case("ingredients", repeats=REPEATS, weight=0.6, timeout=120, **flags))
    return found


# ---------------------------------------------------------------- errors


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


def discretisation_error(*_) -> campaign.Measure:
    """Relative differences to the reference: force, greatest pressure, and the profile (L2)."""

    def measure(item: campaign.Case, summary: dict, folder: Path) -> dict:
        law = float(item.parameters["kappa"]), float(item.parameters["m"])
        known = reference.values()["disc-on-block", *law]
        return {
            "forceError": abs(summary["force"] / known["force"] - 1),
            "pressureMaxError": abs(summary["pressureMax"] / known["pressureMax"] - 1),
            "profileError": reference.profile_error(*law, campaign.read_contact(folder)),
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
                lines.append(
                    [
                        f"{kappa:g}, {m}",
                        method + (f", T0 = {start}" if method == "paper" else ""),
                        row["newton"] if good else row["status"],
                        row["factorisations"],
                        row["backsolves"],
                        f"{contact_seconds(row):.3f}" if good else "-",
                        f"{value(row, 'forceError'):.0e}" if good else "-",
                    ]
                )
    header = [
        "kappa, m",
        "method (tol 1e-8)",
        "linearisations",
        "factorisations",
        "back-substitutions",
        "CPU s",
        "error",
    ]
    return markdown(header, lines)


def report_meshes(rows: list[dict]) -> str:
    lines = []
    for row in select(rows, method="xnewton"):
        cells = [row["kappa"] + ", " + row["m"], "P" + row["order"], row["h"], row["ndof"], f"{value(row, 'cpu'):.2f}"]
        cells += [f"{value(row, name):.1e}" for name in ("forceError", "pressureMaxError", "profileError")]
        cells = ["-" if cell == "nan" else cell for cell in cells]
        times = []
        for method in ("newton", "paper"):
            other = select(
                rows, method=method, kappa=float(row["kappa"]), m=float(row["m"]), order=row["order"], h=row["h"]
            )
            good = other and other[0]["status"] == "converged"
            times.append(f"{value(other[0], 'cpu'):.2f}" if good else "-")
        lines.append([*cells, *times])
    header = ["kappa, m", "element", "h", "dofs", "CPU s", "force", "greatest p", "profile", "newton, s", "paper, s"]
    return markdown(header, lines)


def report_growth(rows: list[dict]) -> str:
    lines = []
    sizes = select(rows, name="growth", status="converged")
    for row in sizes:
        lines.append(
            [
                row["kappa"] + ", " + row["m"],
                row["ndof"],
                row["newton"],
                row["backsolves"],
                f"{elastic_seconds(row):.2f}",
                f"{contact_seconds(row):.2f}",
                f"{value(row, 'costRatio'):.2f}",
                f"{value(row, 'memory'):.0f}",
            ]
        )
    header = [
        "kappa, m",
        "dofs",
        "linearisations",
        "back-substitutions",
        "elastic, s",
        "contact, s",
        "cost ratio",
        "MB",
    ]
    parts = [markdown(header, lines)]
    for kappa, m in CASES:
        group = select(sizes, kappa=kappa, m=m)
        if len(group) > 2:
            dofs = np.array([value(row, "ndof") for row in group])
            ours = exponent(dofs, np.array([contact_seconds(row) for row in group]))
            elastic = exponent(dofs, np.array([elastic_seconds(row) for row in group]))
            parts.append(
                f"kappa = {kappa:g}, m = {m}: seconds ~ dofs^{ours:.2f}, linear elastic solve dofs^{elastic:.2f}"
            )
    cost = select(rows, name="cost")
    grid = [
        [f"{kappa:g}"]
        + [
            f"{value(row, 'costRatio'):.2f}"
            for m in EXPONENTS
            for row in select(cost, method="xnewton", kappa=kappa, m=m)
        ]
        for kappa in KAPPAS
    ]
    parts.append(markdown(["kappa \\ m", *map(str, EXPONENTS)], grid))
    rival = [
        [
            row["kappa"] + ", " + row["m"],
            row["method"] + (f", T0 = {row['T0']}" if row["method"] == "paper" else ""),
            row["newton"],
            f"{value(row, 'costRatio'):.1f}" if row["status"] == "converged" else row["status"],
        ]
        for row in cost
        if row["method"] != "xnewton"
    ]
    parts.append(markdown(["kappa, m", "method", "linearisations", "cost ratio"], rival))
    return "\n".join(parts)


def variant_of(row: dict[str, str]) -> str:
    """The exchanged ingredients of a run, in words; empty for the default."""
    names = ("start", "preconditioner", "inner", "threshold", "T0")
    flags = dict(zip(row["flags"].split()[::2], row["flags"].split()[1::2], strict=True))
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
    "meshes": (meshes, ("forceError", "pressureMaxError", "profileError"), discretisation_error, report_meshes),
    "growth": (growth, (), None, report_growth),
    "ingredients": (ingredients, (), None, report_ingredients),
}


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"of {', '.join(PARTS)} (default: all)")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (default 1: they are timed)")
    parser.add_argument("--repeats", type=int, default=REPEATS, help=f"of a timed run at most (default {REPEATS})")
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of the CSV files")
    parser.add_argument("--root", type=Path, default=campaign.ROOT, help="the package whose scenes are run")
    arguments = parser.parse_args(argv)
    unknown = set(arguments.parts) - set(PARTS)
    if unknown:
        parser.error(f"no such part: {', '.join(sorted(unknown))}")
    for name in arguments.parts or PARTS:
        cases, columns, measure, report = PARTS[name]
        path = arguments.out / f"{name}.csv"
        chosen = cases(arguments.root)
        chosen = [dataclasses.replace(item, repeats=min(item.repeats, arguments.repeats)) for item in chosen]
        try:
            rows = campaign.run(chosen, path, arguments.jobs, columns, measure, arguments.root, title=name)
        except KeyboardInterrupt:
            print("\ninterrupted; started again, it goes on from here", file=sys.stderr)
            return 130
        print(f"\n{name}\n{report(rows)}\n", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
