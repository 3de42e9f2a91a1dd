"""The package beside another code, NGSolve: error against CPU seconds: `make bench-peers`, results/bench/peers.csv.

Both solve the same problems, a run of the one after a run of the other, in ROUNDS rounds: a row each, and medians over
the rounds in what is printed and drawn. Seconds are CPU seconds of one thread from the mesh that has been read to the
displacement, `seconds_assembly + seconds_factorisation + seconds_contact`; the mesh's own stand in `seconds_mesh`.
Errors are relative to tests/data/references.csv. A run that is told half the contact's width, `-ends`, is charged with
the coarse run that would tell it: `secondsBefore`. Interrupted and started again, it goes on where it was.

NGSolve is no part of the package: it has a virtual environment of its own, .venv-peers (requirements-peers.txt).
"""

import argparse
import dataclasses
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import campaign
import numpy as np
import reference
from bench import FOLDER, cheapest, contact_seconds, element, ends
from campaign import case, decade, flags_of, markdown, value

PEER, BODIES = "ngsolve_contact.py", "ngsolve_bodies.py"  # the other code: rigid obstacles, two bodies
PYTHON = (campaign.CACHE / "venv-peers" if campaign.CACHE else campaign.ROOT / ".venv-peers") / "bin" / "python"
ROUNDS = 5
ERRORS = (2e-3, 5e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7)  # in force, that the table asks the price of
OTHERS = {"pressureMaxError": "greatest pressure", "halfWidthError": "half-width"}  # columns that are asked too
OTHERS_ERRORS = (1e-3, 1e-4, 1e-5, 1e-6)
WRONG = 0.1  # error in force of a run that says it has converged
TOL = 1e-8  # of the residual, for both
SECONDS = "CPU time without mesh"  # what the tables' seconds are: the axis of the picture that is drawn from them

LAWS = [(1e3, 3), (1e9, 3), (1e12, 3), (1e3, 10), (1e3, 20)]  # kappa, m
LAWS_SPACE = LAWS_BODIES = LAWS[:2]
# Series of runs: flags, and the sizes h (length) that they are run with. A further element or mesh is a further line.
SECTION = {"reach": 6.95}  # contact is looked for as far as NGSolve's meshes do: 1.1 times the rigid section
PACKAGE_PLANE = [
    ({"order": 2}, (0.5,)),
    ({"order": 3, "grading": 100, "corners": 0.1, **SECTION}, (1.4, 1)),
    ({"order": 3, "grading": 60, "corners": 0.1, **SECTION}, (0.5,)),
    ({"order": 4, "grading": 160, "corners": 0.05, **SECTION}, (1.2, 0.7, 0.5, 0.4)),
    ({"order": 4, "grading": 60, "corners": 0.1, **SECTION}, (0.7, 0.5)),
    ({"order": 4, "grading": 60, "corners": 0.05, **SECTION}, (0.3,)),
]
# With the stiff laws, kappa >= STIFF, and `-ends` half the contact's width; a run with the flags COARSE tells it about.
PACKAGE_PLANE_ENDS = [
    ({"order": 4, "grading": 60, "corners": 0.05, **SECTION}, (2, 0.35)),
    ({"order": 4, "grading": 100, "corners": 0.1, **SECTION}, (1,)),
    ({"order": 4, "grading": 60, "corners": 0.1, **SECTION}, (0.7,)),
    ({"order": 4, "grading": 60, "corners": 0.02, **SECTION}, (2, 1)),
]
STIFF = 1e9
PACKAGE_SPACE = [
    ({"order": 2, "layers": 1, "grading": 10}, (1.5, 1)),
    ({"order": 3, "layers": 1, "grading": 40}, (3,)),
    ({"order": 3, "layers": 1, "grading": 20, "edges": 1}, (1.5,)),
    ({"order": 3, "layers": 1, "grading": 10, "edges": 1}, (1.5,)),
]
# With the stiff law, in the place of P3's.
PACKAGE_SPACE_ENDS = [({"order": 3, "grading": 10}, (2.5,)), ({"order": 3, "grading": 10, "edges": 1}, (2,))]
PACKAGE_CYLINDERS = [
    ({"order": 2}, (0.4,)),
    ({"order": 3, "grading": 200, "corners": 0.5}, (0.8, 0.4)),
    ({"order": 3, "grading": 60, "corners": 0.1}, (0.2,)),
    ({"order": 4, "grading": 200, "corners": 0.5}, (0.4, 0.2)),
]
PACKAGE_PIN = [({"order": 2}, (0.8,)), ({"order": 3}, (0.8,)), ({"order": 4}, (0.8,))]
PEER_PLANE = [
    ({"order": 2, "corners": 3}, (0.5,)),
    ({"order": 3, "corners": 4}, (1, 0.5)),
    ({"order": 4, "corners": 5}, (1, 0.5)),
    ({"order": 5, "corners": 6}, (1, 0.25)),
    ({"order": 5, "corners": 6, "far": 1.5}, (1,)),
]
# With the stiff laws these are solved by degrees 1, 2 and their own; and meshes that are told the contact's width.
PEER_PLANE_ENDS = [({"order": 3, "corners": 5}, (1,)), ({"order": 4, "corners": 5}, (1, 0.5))]
# With the first law alone: the straightforward form of the same method. With the last one alone: a fine mesh.
PEER_PLANE_FIRST = [({"order": 4, "corners": 5, "start": 0, "assembly": "whole"}, (1,))]
PEER_PLANE_LAST = [({"order": 5, "corners": 6}, (0.1,))]
PEER_SPACE = [
    ({"order": 2, "mesh": "tetrahedra"}, (1,)),
    ({"order": 3, "mesh": "tetrahedra", "reuse": 1}, (2,)),
    ({"order": 3, "mesh": "hexes", "corners": 1, "reuse": 1}, (1.5,)),
]
PEER_SPACE_ENDS = [({"order": 3, "reuse": 1}, (1,))]
# Stiff: a factorisation a step, for one that is reused takes 80 iterations a step; rims as told by a coarse run.
PEER_SPACE_STIFF = [({"order": 2, "mesh": "tetrahedra"}, (1,))]
PEER_SPACE_STIFF_ENDS = [({"order": 2, "start": 2}, (1.5,)), ({"order": 3, "start": 2}, (2, 1.5))]
PEER_CYLINDERS = [({"order": 2}, (0.4,)), ({"order": 3}, (0.4, 0.2)), ({"order": 4}, (0.4, 0.2))]
PEER_PIN = [({"order": 2}, (0.8,)), ({"order": 3}, (0.8,)), ({"order": 4}, (0.8,))]
# What tells the contact's width, of each code: flags of a run with the same law.
COARSE = {
    "disc-on-block": {"order": 3, "grading": 60, "corners": 0.1, "h": 1, **SECTION},
    "sphere-on-block": {"order": 2, "h": 1.5, "layers": 1},
}
PEER_COARSE = {
    "disc-on-block": {"corners": 3, "order": 2, "h": 0.5},
    "sphere-on-block": {"mesh": "tetrahedra", "order": 2, "h": 1.5},
}

# The pin: the law stands in a case file, the elements' size before the geometry.
PIN = "pin-in-hole"
PIN_CASE = """state strain
body ring E 100 nu 0.3
body pin E 100 nu 0.3
contact bore pin-surface law power kappa {kappa:g} m {m:g} d0 -0.05
clamp frame
move core 0 -0.3
"""
OWN = {"method": "xnewton", "estimate": 0}  # of every run of the package
CYLINDERS = {"d0": -0.05, "force": 0, "u0": 0.5}
COLUMNS = [*reference.COLUMNS, "secondsBefore"]


def cases(_root: Path = campaign.ROOT) -> list[campaign.Case]:
    """Round by round and problem by problem, the two codes in turn."""
    found = []
    for place in range(ROUNDS):
        for law in LAWS:
            ours, theirs = PACKAGE_PLANE, PEER_PLANE
            if law == LAWS[0]:
                theirs = theirs + PEER_PLANE_FIRST
            if law == LAWS[-1]:
                theirs = theirs + PEER_PLANE_LAST
            if law[0] >= STIFF:
                ours = ours + told(PACKAGE_PLANE_ENDS, ends(*law))
                theirs = with_flags(theirs + told(PEER_PLANE_ENDS, ends(*law)), {"start": 2})
            found += both("disc-on-block", place, law, ours, theirs)
        for law in LAWS_SPACE:
            radius = round(reference.values()["sphere-on-block", *law]["contactRadius"], 2)
            theirs, rims = (
                (PEER_SPACE, PEER_SPACE_ENDS) if law[0] < STIFF else (PEER_SPACE_STIFF, PEER_SPACE_STIFF_ENDS)
            )
            theirs = theirs + told(rims, radius)
            ours = PACKAGE_SPACE if law[0] < STIFF else PACKAGE_SPACE[:1] + told(PACKAGE_SPACE_ENDS, radius)
            found += both("sphere-on-block", place, law, ours, theirs)
        for law in LAWS_BODIES:
            start = {"start": 2 if law[0] >= STIFF else 1}
            found += both("two-cylinders", place, law, PACKAGE_CYLINDERS, with_flags(PEER_CYLINDERS, start), BODIES)
            found += both(PIN, place, law, PACKAGE_PIN, with_flags(PEER_PIN, start), BODIES)
    return found


def with_flags(lines: list, flags: dict) -> list:
    """The series with these flags too."""
    return [({**own, **flags}, sizes) for own, sizes in lines]


def told(lines: list, width: float) -> list:
    """The series, on meshes that are told the contact's half-width or radius."""
    return with_flags(lines, {"ends": width})


def both(scene: str, place: int, law: tuple, ours: list, theirs: list, script: str = PEER) -> list[campaign.Case]:
    """The runs of one problem in one round, package and peer in turn."""
    return alternating(series(scene, ours, place, *law), series(scene, theirs, place, *law, script))


def series(scene: str, lines: list, place: int, kappa: float, m: int, script: str = "") -> list[campaign.Case]:
    """The runs of these series; `script`: the peer's, none for the package."""
    found = []
    common = {"timeout": 100, "weight": 5 if scene == "sphere-on-block" else 1}
    for flags, sizes in lines:
        for h in sizes:
            law = {"law": "power", "kappa": kappa, "m": m}
            if script:
                flags = {"problem": scene, "method": "ngsolve", **flags}
                item = case(f"round {place + 1}", scene, **common, **flags, **law, h=h, tol=TOL)
                item = dataclasses.replace(item, script=script, program=(str(PYTHON),))
            elif scene == PIN:
                files = {"mesh": pin_mesh(h), "case": pin_case(kappa, m)}
                item = case(f"round {place + 1}", "parts", **common, **OWN, **flags, **files, tol=TOL)
            else:
                flags = {**flags, **(CYLINDERS if scene == "two-cylinders" else {})}
                item = case(f"round {place + 1}", scene, **common, **OWN, **flags, **law, h=h, tol=TOL)
            found.append(item)
    return found


def pin_mesh(h: float) -> str:
    return f"pin-{h:g}.geo"


def pin_case(kappa: float, m: float) -> str:
    return f"pin-{kappa:g}-{m:g}.case"


def added_files() -> dict[str, str]:
    """What the frozen sources have beside the package: the other code's scripts, the pin's geometries and cases."""
    folder = Path(__file__).parent
    found = {name: (folder / name).read_text() for name in (PEER, BODIES)}
    geometry = (folder / "pin.geo").read_text()
    found |= {pin_mesh(h): f"h = {h:g};\n{geometry}" for _, sizes in PACKAGE_PIN for h in sizes}
    return found | {pin_case(*law): PIN_CASE.format(kappa=law[0], m=law[1]) for law in LAWS_BODIES}


def alternating(ours: list, theirs: list) -> list:
    """Both lists in one, each spread evenly over the whole."""
    pairs = [(place / len(part), item) for part in (ours, theirs) if part for place, item in enumerate(part)]
    return [item for _, item in sorted(pairs, key=lambda pair: pair[0])]


# ---------------------------------------------------------------- errors


def coarse(item: campaign.Case, scene: str, law: dict) -> campaign.Case:
    """The run that tells the width of the contact to a run with `-ends`."""
    if not item.program:
        return case("coarse", scene, method="xnewton", **COARSE[scene], **law)
    run = case("coarse", method="ngsolve", problem=scene, **PEER_COARSE[scene], **law)
    return dataclasses.replace(run, script=item.script, program=item.program)


def measures(sources: Path, processes: campaign.Processes, before: Callable = coarse) -> campaign.Measure:
    """COLUMNS: errors, and of a run with `-ends` the seconds of a coarse run without, mesh to displacement."""

    def measure(item: campaign.Case, summary: dict, folder: Path) -> dict:
        flags, found = item.parameters, {}
        if "case" in flags:
            h, (kappa, m) = flags["mesh"][4:-4], flags["case"][4:-5].split("-")
            found = {"scene": PIN, "kappa": float(kappa), "m": float(m), "h": float(h)}
        else:
            kappa, m = flags["kappa"], flags["m"]
        scene = (found or summary)["scene"]
        found |= reference.compared(summary, scene, float(kappa), float(m), folder)
        if "ends" in flags:
            law = {"law": "power", "kappa": kappa, "m": m, "tol": TOL}
            pilot = before(item, scene, law)
            row = campaign.run_case(pilot, sources, processes)
            if row["status"] != "converged":
                raise RuntimeError(f"{pilot.flags}: {row['message']}")
            found["secondsBefore"] = contact_seconds(row) + row["seconds_mesh"]
        return found

    return measure


# ---------------------------------------------------------------- what came out


def seconds(row: dict[str, str]) -> float:
    """CPU seconds from the mesh to the displacement, with those of the run that must come before."""
    return contact_seconds(row) + float(row["secondsBefore"] or 0)


def spent(row: dict) -> float:
    """The seconds that `medians` has found."""
    return row["seconds"]


def medians(rows: Iterable[dict[str, str]], seconds: Callable = seconds) -> list[dict[str, str]]:
    """One row a case, the first round's, with `seconds` and `mesh`: medians over the rounds that converged."""
    groups: dict = {}
    for row in rows:
        groups.setdefault((row["script"], row["flags"]), []).append(row)
    found = []
    for group in groups.values():
        good = [row for row in group if row["status"] == "converged"]
        first = dict((good or group)[0])
        first["seconds"] = float(np.median([seconds(row) for row in good])) if good else float("nan")
        first["mesh"] = float(np.median([value(row, "seconds_mesh") for row in good])) if good else float("nan")
        found.append(first)
    return found


def problem_of(row: dict[str, str]) -> tuple[str, float, float]:
    """Scene, kappa and m of a run; also of one that has failed."""
    found = flags_of(row)
    if "-case" in found:
        kappa, m = found["-case"][4:-5].split("-")
        return PIN, float(kappa), float(m)
    scene = found.get("-problem", row["scene"])
    return scene, float(found.get("-kappa", row["kappa"])), float(found.get("-m", row["m"]))


SCENES = {"sphere-on-block": "sphere, ", "two-cylinders": "cylinders, ", PIN: "pin, "}


def problem_words(which: tuple[str, float, float]) -> str:
    scene, kappa, m = which
    return f"{SCENES.get(scene, '')}{decade(kappa)}, {m:g}"


def theirs(row: dict[str, str]) -> bool:
    """Whether a run is the other code's."""
    return row["script"].endswith(".py")


def table(rows: list[dict[str, str]], column: str = "forceError", errors: tuple = ERRORS) -> str:
    """Least seconds to each error and the element that took them, package / NGSolve, problem by problem."""
    rows = [row for row in medians(rows) if row["status"] != "converged" or row[column] != ""]
    lines = []
    for which, group in by_problem(rows):
        cells = []
        for error in errors:
            pair = [best(group, error, peer, column) for peer in (False, True)]
            words = ["–" if row is None else f"{row['seconds']:.2g} {element(row)}" for row in pair]
            sure = column != "forceError" or error >= 2 * reference.differences()[which]
            cells.append(" / ".join(words) if sure else "")
        if any(cell not in ("", "– / –") for cell in cells):
            lines.append([problem_words(which), *cells])
    return markdown(["κ, m", *(decade(error) for error in errors)], lines)


def other_tables(rows: list[dict[str, str]]) -> str:
    """The same of the other quantities, in the plane's problems; the quantity stands before the law."""
    lines = []
    for column, words in OTHERS.items():
        plane = [row for row in rows if problem_of(row)[0] == "disc-on-block"]
        head, rule, *body = table(plane, column, OTHERS_ERRORS).splitlines()
        lines += [f"| {words} {line}" for line in body]
    return "\n".join([f"| quantity {head}", f"| --- {rule}", *lines])


def by_problem(rows: list[dict[str, str]]) -> list[tuple[tuple, list[dict[str, str]]]]:
    """The problems in turn, and their runs."""
    found: dict = {}
    for row in rows:
        found.setdefault(problem_of(row), []).append(row)
    return list(found.items())


def failed_table(rows: list[dict[str, str]]) -> str:
    """What each code failed at, problem by problem: the least error of its meshes, and runs that came to nothing."""
    lines = []
    for which, group in by_problem(medians(rows)):
        cells = []
        for peer in (False, True):
            own = [row for row in group if theirs(row) == peer]
            known = [value(row, "forceError") for row in own if not failure(row)]
            words = [f"least error {max(min(known), reference.differences()[which]):.0e}"] if known else ["nothing"]
            for reason in ("not converged", "timeout", "wrong"):
                lost = [f"P{value_of(row, 'order')} h = {value_of(row, 'h')}" for row in own if fate(row) == reason]
                words += [f"{reason}: {', '.join(lost)}"] if lost else []
            others = [row for row in own if fate(row) not in ("", "not converged", "timeout", "wrong")]
            words += [f"{fate(row)}: {row['message']}" for row in others]
            cells.append("; ".join(words))
        lines.append([problem_words(which), *cells])
    return markdown(["κ, m", "package", "NGSolve"], lines)


def value_of(row: dict[str, str], flag: str) -> str:
    """A flag of a run, as it was given; of the pin's size the number in its file's name."""
    found = flags_of(row)
    return found["-mesh"][4:-4] if flag == "h" and "-case" in found else found[f"-{flag}"]


def fate(row: dict[str, str]) -> str:
    """Why a run is no result; empty where it is one."""
    if row["status"] != "converged":
        return row["status"]
    return "wrong" if value(row, "forceError") > WRONG else ""


def report(rows: list[dict[str, str]]) -> str:
    """The cheapest runs of each code to each error, problem by problem; then what failed."""
    return "\n\n".join([table(rows), other_tables(rows), failed_table(rows)])


def failure(row: dict) -> bool:
    return row["status"] != "converged"


def best(rows: list[dict], error: float, peer: bool, column: str = "forceError") -> dict | None:
    """The cheapest run of one code to this error."""
    return cheapest([row for row in rows if theirs(row) == peer], error, spent, column)


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of peers.csv")
    arguments = parser.parse_args(argv)
    if not PYTHON.exists():
        parser.exit(1, f"{parser.prog}: NGSolve is not installed in .venv-peers; `make bench-peers` does it\n")
    try:
        rows = campaign.run(
            cases(), arguments.out / "peers.csv", columns=COLUMNS, measure=measures, files=added_files(), title="peers"
        )
    except KeyboardInterrupt:
        print("\ninterrupted; started again, it goes on from here", file=sys.stderr)
        return 130
    print(f"\n{report(rows)}\n", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
