"""The package beside NGSolve on the contact's unknowns, whole block and half: the end of `make bench-peers`.

Rows in results/bench/condensed.csv, as those of peers.py. Both solve the paper's test in ROUNDS rounds, runs of the
two in turn, each in a process of its own; NGSolve has solved the problem once in that process before it is timed.
Seconds are CPU seconds of one thread, so that other work on the machine counts little.
"""

import argparse
import dataclasses
import sys
from pathlib import Path

import campaign
import peers
import reference
from bench import FOLDER, element, ends
from campaign import decade, flags_of, markdown

SCENE, CONDENSED = "disc-on-block", "ngsolve_condensed.py"
LAWS = peers.LAWS[:3]
ERRORS = (1e-4, 1e-5, 1e-6, 1e-7)
BLOCKS = {1: "half", 0: "whole"}
# Series of runs: flags, and the sizes h (length). The cheapest of some thirty meshes for each code.
PACKAGE = [
    ({"order": 3, "grading": 100, "corners": 0.1, **peers.SECTION}, (1, 0.7)),
    ({"order": 3, "grading": 60, "corners": 0.1, **peers.SECTION}, (0.5,)),
    ({"order": 4, "grading": 160, "corners": 0.05, **peers.SECTION}, (1.2, 0.7, 0.5)),
    ({"order": 4, "grading": 60, "corners": 0.05, **peers.SECTION}, (0.3,)),
]
PACKAGE_STIFF = [
    ({"order": 3, "grading": 100, "corners": 0.05, **peers.SECTION}, (2,)),
    ({"order": 4, "grading": 100, "corners": 0.05, **peers.SECTION}, (2,)),
    ({"order": 4, "grading": 60, "corners": 0.02, **peers.SECTION}, (2,)),
    ({"order": 4, "grading": 100, "corners": 0.1, **peers.SECTION}, (1,)),
]
PEER = [
    ({"order": 3, "corners": 3}, (2, 1)),
    ({"order": 4, "corners": 3}, (2,)),
    ({"order": 4, "corners": 5}, (1,)),
    ({"order": 5, "corners": 5}, (2, 1)),
    ({"order": 5, "corners": 6, "far": 2.5}, (1,)),
]
PEER_STIFF = [
    ({"order": 3, "corners": 4}, (2,)),
    ({"order": 4, "corners": 4}, (2,)),
    ({"order": 4, "corners": 5}, (1,)),
    ({"order": 5, "corners": 5}, (2,)),
    ({"order": 5, "corners": 6, "far": 2.5}, (1,)),
]


def cases(_root: Path = campaign.ROOT) -> list[campaign.Case]:
    """Round by round and law by law, half and whole, the two codes in turn."""
    found = []
    for place in range(peers.ROUNDS):
        for law in LAWS:
            stiff = law[0] >= peers.STIFF
            ours = peers.told(PACKAGE_STIFF, ends(*law)) if stiff else PACKAGE
            theirs = peers.told(PEER_STIFF, ends(*law)) if stiff else PEER
            for half in BLOCKS:
                both = (peers.with_flags(lines, {"half": half}) for lines in (ours, theirs))
                found += peers.both(SCENE, place, law, *both, CONDENSED)
    return found


def coarse(item: campaign.Case, scene: str, law: dict) -> campaign.Case:
    """The run that tells the width of the contact to a run with `-ends`."""
    half = item.parameters["half"]
    if not item.program:
        return campaign.case("coarse", scene, method="xnewton", half=half, **peers.COARSE[scene], **law)
    run = campaign.case("coarse", method="ngsolve", order=3, h=1, corners=3, half=half, **law)
    return dataclasses.replace(run, script=item.script, program=item.program)


def of_block(rows: list[dict], half: int) -> list[dict]:
    return [row for row in rows if int(flags_of(row)["-half"]) == half]


def table(rows: list[dict[str, str]]) -> str:
    """Least seconds to each error, package / condensed NGSolve, and the latter over the former, law by law."""
    lines = []
    for which, group in peers.by_problem(peers.medians(rows)):
        for half, words in BLOCKS.items():
            cells = []
            for error in ERRORS:
                pair = [peers.best(of_block(group, half), error, peer) for peer in (False, True)]
                said = ["–" if row is None else f"{row['seconds']:.2g} {element(row)}" for row in pair]
                ratio = "" if None in pair else f" ({pair[1]['seconds'] / pair[0]['seconds']:.2f})"
                sure = error >= 2 * reference.differences()[which]
                cells.append(" / ".join(said) + ratio if sure else "")
            lines.append([peers.problem_words(which), words, *cells])
    return markdown(["κ, m", "block", *(decade(error) for error in ERRORS)], lines)


def plugin_words() -> str:
    """Whether the package's runs had the plugin of `make fast`."""
    return "with" if list((campaign.ROOT / "build").glob("fast-plugin-*.so")) else "without"


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of condensed.csv")
    arguments = parser.parse_args(argv)
    if not peers.PYTHON.exists():
        parser.exit(1, f"{parser.prog}: NGSolve is not installed in .venv-peers; `make bench-peers` does it\n")
    folder = Path(__file__).parent
    files = {name: (folder / name).read_text() for name in (peers.PEER, CONDENSED)}
    path = arguments.out / "condensed.csv"
    try:
        rows = campaign.run(cases(), path, columns=peers.COLUMNS, measure=measures, files=files, title="condensed")
    except KeyboardInterrupt:
        print("\ninterrupted; started again, it goes on from here", file=sys.stderr)
        return 130
    print(f"\n{table(rows)}\n\n{plugin_words()} the plugin of make fast\n", flush=True)
    return 0


def measures(sources: Path, processes: campaign.Processes) -> campaign.Measure:
    """COLUMNS, as peers.measures gives them, with coarse runs of the same block."""
    return peers.measures(sources, processes, coarse)


if __name__ == "__main__":
    sys.exit(main())
