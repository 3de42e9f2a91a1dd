"""make the teaching kit: slides with notes, handouts, tables of expected values

RUN is one of lab 3, whose thresholds make the film of the slides. FOLDER gets the files, all of them or none.
"""

import argparse
from pathlib import Path

from postprocess import teaching_kit
from postprocess.output import write_files


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RUN", help="result folder of a run of lab 3")
    parser.add_argument("--out", required=True, metavar="FOLDER", help="where to write")


def run(arguments: argparse.Namespace) -> None:
    """Writes the kit and prints the path of its first page."""
    out = Path(arguments.out)
    write_files({out / name: content for name, content in teaching_kit.make_kit(Path(arguments.folder)).items()})
    print(out / "index.html")
