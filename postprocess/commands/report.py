"""make one self-contained HTML page of everything that has been run

RESULTS is a folder of results, `results` when it is not given: every run in it (a folder with a summary.json), the
figures in its folders figures, bench and stability, the tables of these campaigns, and the movies.
The page needs no network and no further files. A result file that cannot be used is refused, and nothing is written.
"""

import argparse
from pathlib import Path

from postprocess.output import write_files
from postprocess.report import build
from postprocess.results import ResultsError
from postprocess.results_folder import read_results_folder


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RESULTS", nargs="?", default="results", help="a folder of results")
    parser.add_argument("--out", required=True, metavar="FILE.html", help="where to write; folders are created")


def run(arguments: argparse.Namespace) -> None:
    """Reads the tree, writes the page and prints its path."""
    out = Path(arguments.out)
    if out.suffix != ".html":
        raise ResultsError(out, "the name of a report ends in .html")
    for path in write_files({out: build(read_results_folder(arguments.folder)).encode()}):
        print(path)
