"""The package beside another code, NGSolve: error against CPU seconds: `make bench-peers`, results/bench/peers.csv.

Both solve the same problems, a run of the one after a run of the other, in ROUNDS rounds: a row each, and medians over
the rounds in what is printed and drawn. Seconds are CPU seconds of one thread from the mesh that has been read to the
displacement, `seconds_assembly + seconds_factorisation + seconds_contact`; the mesh's own stand in `seconds_mesh`.
Errors are relative to tests/data/references.csv. Interrupted and started again, it goes on where it was.

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
from bench import FOLDER, contact_seconds
from campaign import case, markdown, value

PEER = "ngsolve_contact.py"
PYTHON = campaign.ROOT / ".venv-peers" / "bin" / "python"
ROUNDS = 3
DECADES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)  # errors in force that the table asks the price of
TOL = 1e-8  # of the residual, for both

LAWS = [(1e3, 3), (1e9, 3), (1e12, 3), (1e3, 10), (1e3, 20)]  # kappa, m
# Series of runs: flags, and the sizes h (length) that they are run with. A further element or mesh is a further line.
PACKAGE_PLANE = [
    ({"order": 1}, (0.5, 0.25, 0.1, 0.05)),
    ({"order": 2}, (0.5, 0.25, 0.1)),
]
PACKAGE_PLANE_FIRST = [({"order": 2}, (0.05,))]  # with the first law alone
PACKAGE_SPACE = [
    ({}, (0.8, 0.6, 0.45)),
]
PEER_PLANE = [
    ({"order": 1, "corners": 2}, (0.2, 0.1)),
    ({"order": 2, "corners": 3}, (0.5, 0.25, 0.1)),
    ({"order": 3, "corners": 4}, (1, 0.5, 0.25, 0.1)),
    ({"order": 4, "corners": 5}, (1, 0.5, 0.25, 0.1)),
    ({"order": 5, "corners": 6}, (1, 0.5, 0.25, 0.1)),
    ({"order": 5, "corners": 6, "far": 1.5}, (1,)),
]
# With the first law alone: no refinement to the corners; the straightforward form of the same method.
PEER_PLANE_FIRST = [
    *(({"order": order, "corners": 0}, (0.5, 0.25, 0.1)) for order in (2, 4)),
    ({"order": 4, "corners": 5, "start": 0, "assembly": "whole"}, (1, 0.5, 0.25)),
]
PEER_SPACE = [
    ({"order": 2, "mesh": "tetrahedra"}, (1.5, 1)),
    ({"order": 2, "mesh": "hexes", "corners": 1}, (1.5,)),
    ({"order": 3, "mesh": "tetrahedra", "reuse": 1}, (2, 1.5, 1)),
    ({"order": 3, "mesh": "hexes", "corners": 1, "reuse": 1}, (2, 1.5)),
]
ERRORS = {"forceError": "force", "pressureMaxError": "pressureMax", "halfWidthError": "halfWidth"}
COLUMNS = [*ERRORS, "profileError"]


def cases(_root: Path = campaign.ROOT) -> list[campaign.Case]:
    """Round by round and problem by problem, the two codes in turn."""
    found = []
    for place in range(ROUNDS):
        for kappa, m in LAWS:
            ours, theirs = PACKAGE_PLANE, PEER_PLANE
            if (kappa, m) == LAWS[0]:
                ours, theirs = ours + PACKAGE_PLANE_FIRST, theirs + PEER_PLANE_FIRST
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


def reference_error(*_) -> campaign.Measure:
    """Relative differences to the reference: force, greatest pressure, half-width, and the plane's profile (L2)."""

    def measure(item: campaign.Case, summary: dict, folder: Path) -> dict:
        scene, (kappa, m) = summary["scene"], (float(item.parameters[name]) for name in ("kappa", "m"))
        known = reference.values()[scene, kappa, m]
        errors = {}
        for column, name in ERRORS.items():
            if name in known and summary.get(name) is not None:
                errors[column] = abs(summary[name] / known[name] - 1)
        if scene == "disc-on-block":
            errors["profileError"] = reference.profile_error(kappa, m, campaign.read_contact(folder))
        return errors

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
        first["seconds"] = float(np.median([contact_seconds(row) for row in good])) if good else float("nan")
        first["mesh"] = float(np.median([value(row, "seconds_mesh") for row in good])) if good else float("nan")
        found.append(first)
    return found


def report(rows: list[dict[str, str]]) -> str:
    """The cheapest run of each code to each error in force, problem by problem; then what failed."""
    rows = medians(rows)
    lines = []
    problem = {id(row): (row["scene"], value(row, "kappa"), value(row, "m")) for row in rows}
    for scene, kappa, m in dict.fromkeys(problem.values()):
        group = [row for row in rows if problem[id(row)] == (scene, kappa, m)]
        for error in DECADES:
            cells = [cheapest(group, error, peer) for peer in (False, True)]
            if any(cell != "-" for cell in cells):
                lines.append([scene, f"{kappa:g}, {m:g}", f"{error:.0e}", *cells])
    failed = [f"{row['script']} {row['flags']}: {row['status']}, {row['message']}" for row in rows if failure(row)]
    header = ["scene", "kappa, m", "error in force", "package: s (mesh s), dofs, linearisations", "NGSolve: the same"]
    return "\n".join([markdown(header, lines), *failed])


def failure(row: dict) -> bool:
    return row["status"] != "converged"


def cheapest(rows: list[dict], error: float, peer: bool) -> str:
    """The run of least seconds among those of one code that are at least as close as this; "-": there is none."""
    close = [row for row in rows if not failure(row) and (row["script"] == PEER) == peer]
    close = [row for row in close if value(row, "forceError") <= error]
    if not close:
        return "-"
    best = min(close, key=lambda row: row["seconds"])
    steps = int(best["newton"]) + (int(best["kernelNewton"] or 0) if peer else 0)
    return f"{best['seconds']:.3f} ({best['mesh']:.2f}), {best['ndof']}, {steps}: P{best['order']}, h = {best['h']}"


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of peers.csv")
    arguments = parser.parse_args(argv)
    if not PYTHON.exists():
        parser.exit(1, f"{parser.prog}: NGSolve is not installed in .venv-peers; `make bench-peers` does it\n")
    files = {PEER: (campaign.ROOT / "tests" / "campaigns" / PEER).read_text()}
    try:
        rows = campaign.run(
            cases(), arguments.out / "peers.csv", columns=COLUMNS, measure=reference_error, files=files, title="peers"
        )
    except KeyboardInterrupt:
        print("\ninterrupted; started again, it goes on from here", file=sys.stderr)
        return 130
    print(f"\n{report(rows)}\n", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
