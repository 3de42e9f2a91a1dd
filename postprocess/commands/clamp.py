"""print what clamps a joint over the load phases: forces of bolts and contacts, and which part sticks

RUN is a case with load phases, as of a transverse load that goes to and fro. A row is a load phase: of each preload and
each contact the force at its end, the least one in the phase, and the loss since the joint was tightened; then the
least part of all points in contact that sticks. 0 % slips as a whole. There are no threads: see the how-to page.
"""

import argparse

import numpy as np

from postprocess.load_series import read_series
from postprocess.results import ResultsError, Run, read_run

ENDS = {" force": "preload ", " normal force": ""}  # of a column's name, and how it begins


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RUN", help="a run's result folder")


def run(arguments: argparse.Namespace) -> None:
    """Reads the run and prints the table."""
    for line in table(read_run(arguments.folder)):
        print(line)


def clamps(columns: dict) -> list[str]:
    """The columns that clamp: of preloads, otherwise of contacts."""
    for end, begin in ENDS.items():
        found = [name for name in columns if name.startswith(begin) and name.endswith(end)]
        if found:
            return found
    return []


def table(chosen: Run) -> list[str]:
    """The lines of the table."""
    columns = read_series(chosen)
    names = clamps(columns)
    if "leg" not in columns or not names:
        what = "has no load phases of a joint; allowed: a case with leg, and a preload or contacts"
        raise ResultsError(chosen.path / "series.csv", what)
    leg, touching = columns["leg"], columns["contactPoints"]
    sticks = np.where(touching > 0, columns["stickingPoints"] / np.maximum(touching, 1), 0)
    found = ["leg  sticks" + "".join(f"   {name.removeprefix('preload ')}: end, least, loss" for name in names)]
    for phase in np.unique(leg).tolist():
        inside = leg == phase
        text = f"{phase:3.0f}  {100 * sticks[inside].min():5.1f}%"
        for name in names:
            force = columns[name]
            loss = 1 - force[inside][-1] / force[0] if force[0] else 0.0
            text += f"   {force[inside][-1]:.6g}, {force[inside].min():.6g}, {100 * loss:.2f} %".replace(
                "-0.00 %", "0.00 %"
            )
        found.append(text)
    return found
