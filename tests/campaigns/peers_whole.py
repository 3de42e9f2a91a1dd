"""Whole commands of the package and of NGSolve, by both of its ways: the end of `make bench-peers`.

Rows in results/bench/whole.csv. The paper's test on the whole block, with a soft and a stiff law, on the meshes of
peers.py and peers_condensed.py. `used` are the CPU seconds of a command from outside: start, imports, mesh, solution,
results. A run with `-ends` is charged with the whole coarse run that tells the width of the contact.
"""

import sys
from pathlib import Path

import campaign
import peers
import peers_condensed
import reference
from bench import FOLDER, cheapest, element, ends
from campaign import decade, markdown, value

ROUNDS = 3
LAWS = {peers.LAWS[0]: "soft", peers.LAWS[2]: "stiff"}
ERRORS = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
CODES = ("edp/main.edp", peers.PEER, peers_condensed.CONDENSED)
FINER = [({"order": 2}, (0.25, 0.1, 0.05))]  # of P2, which needs no second start of the program
COLD = {"cold": 1, "half": 0}


def cases(_root: Path = campaign.ROOT) -> list[campaign.Case]:
    """Round by round and law by law, the three in turn."""
    found = []
    for place in range(ROUNDS):
        for law in LAWS:
            ours, theirs, condensed = peers.PACKAGE_PLANE + FINER, peers.PEER_PLANE, peers_condensed.PEER
            if law[0] >= peers.STIFF:
                ours = ours + peers.told(peers.PACKAGE_PLANE_ENDS, ends(*law))
                theirs = peers.with_flags(theirs + peers.told(peers.PEER_PLANE_ENDS, ends(*law)), {"start": 2})
                condensed = peers.told(peers_condensed.PEER_STIFF, ends(*law))
            runs = peers.both(peers_condensed.SCENE, place, law, ours, theirs)
            last = peers.with_flags(condensed, COLD)
            found += peers.alternating(
                runs, peers.series(peers_condensed.SCENE, last, place, *law, peers_condensed.CONDENSED)
            )
    return found


def measures(sources: Path, processes: campaign.Processes) -> campaign.Measure:
    """peers.COLUMNS: the error of the force, and of a run with `-ends` the CPU seconds of the command before it."""

    def measure(item: campaign.Case, summary: dict, folder: Path) -> dict:
        flags = item.parameters
        found = reference.compared(summary, summary["scene"], float(flags["kappa"]), float(flags["m"]), folder)
        if "ends" in flags:
            law = {"law": "power", "kappa": flags["kappa"], "m": flags["m"], "tol": peers.TOL}
            of_its_own = peers_condensed.coarse if "cold" in flags else peers.coarse
            pilot = of_its_own(item, summary["scene"], law | ({"cold": 1} if "cold" in flags else {}))
            found["secondsBefore"] = campaign.run_case(pilot, sources, processes)["used"]
        return found

    return measure


def seconds(row: dict[str, str]) -> float:
    """CPU seconds of the commands that give a row."""
    return value(row, "used") + float(row["secondsBefore"] or 0)


def table(rows: list[dict[str, str]]) -> str:
    """Least CPU seconds of the whole command to each error: package / NGSolve / NGSolve condensed."""
    lines = []
    for which, group in peers.by_problem(peers.medians(rows, seconds)):
        cells = []
        for error in ERRORS:
            best = [cheapest([row for row in group if row["script"] == code], error, peers.spent) for code in CODES]
            cells.append(" / ".join("–" if row is None else f"{row['seconds']:.2g} {element(row)}" for row in best))
        lines.append([LAWS[which[1:]], *cells])
    return markdown(["law", *(decade(error) for error in ERRORS)], lines)


def main() -> int:
    here = Path(__file__).parent
    files = {name: (here / name).read_text() for name in CODES[1:]}
    rows = campaign.run(
        cases(), FOLDER / "whole.csv", columns=peers.COLUMNS, measure=measures, files=files, title="whole commands"
    )
    print(f"\n{table(rows)}\n", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
