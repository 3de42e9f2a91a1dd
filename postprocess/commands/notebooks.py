"""write a notebook for Jupyter of each lab: its text, its commands, room for answers, and their check

FOLDER gets a file `lab-NAME.ipynb` for each lab. A notebook finds the package in a folder above its own, so FOLDER is
to be inside the package.
"""

import argparse
from pathlib import Path

from postprocess import notebook, teaching_kit
from postprocess.output import write_files


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--out", required=True, metavar="FOLDER", help="where to write; folders are created")


def run(arguments: argparse.Namespace) -> None:
    """Writes the notebooks and prints their paths."""
    out = Path(arguments.out).resolve()
    files = {Path(arguments.out) / f"lab-{lab.name}.ipynb": notebook.made(lab, out) for lab in teaching_kit.folders()}
    for path in write_files(files):
        print(path)
