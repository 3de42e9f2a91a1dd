"""write many runs as one CSV file, a row a run

Columns: the run's folder, its scene and method, counts, results and seconds, then the flags in which the runs differ.
"""

import argparse
import csv
import io
from pathlib import Path

from postprocess.commands.compare import VALUES
from postprocess.output import write_files
from postprocess.results import Run, read_run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folders", metavar="RUN", nargs="+", help="result folders")
    parser.add_argument("--out", metavar="FILE.csv", required=True, help="where to write; folders are created")


def run(arguments: argparse.Namespace) -> None:
    """Reads the runs, writes the table and prints its path."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows([read_run(folder) for folder in arguments.folders]))
    for path in write_files({Path(arguments.out): text.getvalue().encode()}):
        print(path)


def rows(runs: list[Run]) -> list[list]:
    """The head, and a row a run; a value that a run does not have is empty."""
    every = [values(run) for run in runs]
    names = list(dict.fromkeys(name for each in every for name in each))
    given = [run.summary["parameters"] for run in runs]
    flags = dict.fromkeys(name for each in given for name in each if name not in (*names, "method", "out"))
    different = [name for name in flags if len({repr(each.get(name)) for each in given}) > 1]
    table = [[*names, *(f"-{name}" for name in different)]]
    for one, parameters in zip(every, given, strict=True):
        table.append([*(one.get(name) for name in names), *(parameters.get(name) for name in different)])
    return table


def values(run: Run) -> dict:
    """Columns that every run has."""
    summary = run.summary
    found = {"run": str(run.path), **{name: summary[name] for name in ("scene", "method", "converged")}}
    found |= {name: summary[name] for name in VALUES if name in summary}
    found |= {"message": summary.get("message", ""), "warnings": "; ".join(summary.get("warnings", []))}
    return found | {f"seconds.{name}": value for name, value in summary["seconds"].items()}
