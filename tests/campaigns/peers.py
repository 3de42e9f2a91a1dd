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
from collections.abc import Iterable
from pathlib import Path

import campaign
import numpy as np
import reference
from bench import FOLDER, cheapest, contact_seconds, element, ends, problem, problem_words
from campaign import case, decade, markdown, value

PEER = "ngsolve_contact.py"
PYTHON = (campaign.CACHE / "venv-peers" if campaign.CACHE else campaign.ROOT / ".venv-peers") / "bin" / "python"
ROUNDS = 3
ERRORS = (2e-3, 5e-4, 1e-4, 1e-5, 1e-6, 1e-7)  # errors in force that the table asks the price of
TOL = 1e-8  # of the residual, for both

LAWS = [(1e3, 3), (1e9, 3), (1e12, 3), (1e3, 10), (1e3, 20)]  # kappa, m
# Series of runs: flags, and the sizes h (length) that they are run with. A further element or mesh is a further line.
PACKAGE_PLANE = [
    ({"order": 2}, (0.5, 0.25)),
    ({"order": 3, "grading": 60, "corners": 0.1}, (2, 1, 0.5)),
    ({"order": 3, "grading": 60}, (0.5, 0.25)),
    ({"order": 4, "grading": 60, "corners": 0.1}, (1, 0.5)),
    ({"order": 4, "grading": 120, "corners": 0.1}, (0.5,)),
    ({"order": 4, "grading": 60}, (0.5, 0.25)),
]
# With the stiff laws, kappa >= STIFF, and `-ends` half the contact's width; a run with the flags COARSE tells it about.
PACKAGE_PLANE_ENDS = [
    ({"order": 3, "grading": 60, "corners": 0.1}, (1, 0.5)),
    ({"order": 4, "grading": 60, "corners": 0.1}, (1.5, 1)),
    ({"order": 4, "grading": 60, "corners": 0.02}, (1.5, 0.5)),
    ({"order": 4, "grading": 120, "corners": 0.02}, (0.5,)),
]
STIFF = 1e9
COARSE = {"order": 2, "h": 0.5}
PACKAGE_SPACE = [
    ({"order": 2, "layers": 1, "grading": 10}, (2, 1.5, 1, 0.75)),
    ({"order": 2, "layers": 1, "grading": 5}, (1.5,)),
]
PEER_PLANE = [
    ({"order": 2, "corners": 3}, (0.5, 0.25)),
    ({"order": 3, "corners": 4}, (1, 0.5, 0.25, 0.1)),
    ({"order": 4, "corners": 5}, (1, 0.5, 0.25, 0.1)),
    ({"order": 5, "corners": 6}, (1, 0.5, 0.25, 0.1)),
    ({"order": 5, "corners": 6, "far": 1.5}, (1,)),
]
# With the first law alone: no refinement to the corners; the straightforward form of the same method.
PEER_PLANE_FIRST = [
    *(({"order": order, "corners": 0}, (0.5, 0.25)) for order in (2, 4)),
    ({"order": 4, "corners": 5, "start": 0, "assembly": "whole"}, (1, 0.5)),
]
PEER_SPACE = [
    ({"order": 2, "mesh": "tetrahedra"}, (1.5, 1)),
    ({"order": 2, "mesh": "hexes", "corners": 1}, (1.5,)),
    ({"order": 3, "mesh": "tetrahedra", "reuse": 1}, (2, 1.5, 1)),
    ({"order": 3, "mesh": "hexes", "corners": 1, "reuse": 1}, (2, 1.5)),
]
COLUMNS = [*reference.COLUMNS, "secondsBefore"]


def cases(_root: Path = campaign.ROOT) -> list[campaign.Case]:
    """Round by round and problem by problem, the two codes in turn."""
    found = []
    for place in range(ROUNDS):
        for kappa, m in LAWS:
            ours, theirs = PACKAGE_PLANE, PEER_PLANE
            if (kappa, m) == LAWS[0]:
                theirs = theirs + PEER_PLANE_FIRST
            if kappa >= STIFF:
                ours = ours + [({**flags, "ends": ends(kappa, m)}, sizes) for flags, sizes in PACKAGE_PLANE_ENDS]
            found += alternating(
                series("disc-on-block", ours, place, kappa, m), series("disc-on-block", theirs, place, kappa, m, PEER)
            )
        ours = series("sphere-on-block", PACKAGE_SPACE, place, *LAWS[0])
        found += alternating(ours, series("sphere-on-block", PEER_SPACE, place, *LAWS[0], PEER))
    return found


def series(scene: str, lines: list, place: int, kappa: float, m: int, script: str = "") -> list[campaign.Case]:
    """The runs of these series; `script`: the peer's, none for the package."""
    found = []
    for flags, sizes in lines:
        for h in sizes:
            law = {"law": "power", "kappa": kappa, "m": m, "h": h, "tol": TOL}
            if script:
                flags = {"problem": scene, "method": "ngsolve", **flags}
                item = case(f"round {place + 1}", scene, timeout=300, weight=1.5, **flags, **law)
                item = dataclasses.replace(item, script=script, program=(str(PYTHON),))
            else:
                item = case(f"round {place + 1}", scene, timeout=300, weight=1.5, method="xnewton", **flags, **law)
            found.append(item)
    return found


def alternating(ours: list, theirs: list) -> list:
    """Both lists in one, each spread evenly over the whole."""
    pairs = [(place / len(part), item) for part in (ours, theirs) if part for place, item in enumerate(part)]
    return [item for _, item in sorted(pairs, key=lambda pair: pair[0])]


# ---------------------------------------------------------------- errors


def measures(sources: Path, processes: campaign.Processes) -> campaign.Measure:
    """COLUMNS: errors, and of a run with `-ends` the seconds of a coarse run without, mesh to displacement."""
    errors = reference.errors(sources, processes)

    def measure(item: campaign.Case, summary: dict, folder: Path) -> dict:
        found = errors(item, summary, folder)
        if "ends" in item.parameters:
            flags = {"law": "power", "kappa": item.parameters["kappa"], "m": item.parameters["m"], "tol": TOL}
            coarse = case("coarse", method="xnewton", **COARSE, **flags)
            row = campaign.run_case(coarse, sources, processes)
            if row["status"] != "converged":
                raise RuntimeError(f"{coarse.flags}: {row['message']}")
            found["secondsBefore"] = contact_seconds(row) + row["seconds_mesh"]
        return found

    return measure


# ---------------------------------------------------------------- what came out


def medians(rows: Iterable[dict[str, str]]) -> list[dict[str, str]]:
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


def seconds(row: dict[str, str]) -> float:
    """CPU seconds from the mesh to the displacement, with those of the run that must come before."""
    return contact_seconds(row) + float(row["secondsBefore"] or 0)


def table(rows: list[dict[str, str]]) -> str:
    """Least seconds to each error in force and the element that took them, package / NGSolve, problem by problem."""
    rows = medians(rows)
    lines = []
    for which in dict.fromkeys(map(problem, rows)):
        group = [row for row in rows if problem(row) == which]
        cells = []
        for error in ERRORS:
            pair = [best(group, error, peer) for peer in (False, True)]
            words = ["–" if row is None else f"{row['seconds']:.2g} {element(row)}" for row in pair]
            cells.append(" / ".join(words))
        lines.append([problem_words(group[0]), *cells])
    return markdown(["κ, m", *(decade(error) for error in ERRORS)], lines)


def report(rows: list[dict[str, str]]) -> str:
    """The cheapest run of each code to each error in force, problem by problem; then what failed."""
    short = table(rows)
    rows = medians(rows)
    lines = []
    for which in dict.fromkeys(map(problem, rows)):
        group = [row for row in rows if problem(row) == which]
        for error in ERRORS:
            pair = [best(group, error, peer) for peer in (False, True)]
            if any(pair):
                lines.append([problem_words(group[0]), decade(error), *map(words, pair)])
    failed = [f"{row['script']} {row['flags']}: {row['status']}, {row['message']}" for row in rows if failure(row)]
    header = ["kappa, m", "error in force", "package: s (mesh s), dofs, linearisations", "NGSolve: the same"]
    return "\n".join([markdown(header, lines), "", short, "", *failed])


def failure(row: dict) -> bool:
    return row["status"] != "converged"


def best(rows: list[dict], error: float, peer: bool) -> dict | None:
    """The cheapest run of one code to this error in force."""
    return cheapest([row for row in rows if (row["script"] == PEER) == peer], error, lambda row: row["seconds"])


def words(row: dict | None) -> str:
    """A run's seconds, size and linearisations, its element and mesh; "-" where there is none."""
    if row is None:
        return "-"
    steps = int(row["newton"]) + (int(row["kernelNewton"] or 0) if row["script"] == PEER else 0)
    return f"{row['seconds']:.3f} ({row['mesh']:.2f}), {row['ndof']}, {steps}: {element(row)}, h = {row['h']}"


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of peers.csv")
    arguments = parser.parse_args(argv)
    if not PYTHON.exists():
        parser.exit(1, f"{parser.prog}: NGSolve is not installed in .venv-peers; `make bench-peers` does it\n")
    files = {PEER: (campaign.ROOT / "tests" / "campaigns" / PEER).read_text()}
    try:
        rows = campaign.run(
            cases(), arguments.out / "peers.csv", columns=COLUMNS, measure=measures, files=files, title="peers"
        )
    except KeyboardInterrupt:
        print("\ninterrupted; started again, it goes on from here", file=sys.stderr)
        return 130
    print(f"\n{report(rows)}\n", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
