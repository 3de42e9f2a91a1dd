"""write a notebook for Jupyter of each lab: its text, its commands as Python, room for answers, and their check

FOLDER gets a file `lab-NAME.ipynb` for each lab. A notebook finds the package in a folder above its own, so FOLDER is
to be inside the package. With --execute each notebook is run, and has its outputs and figures; FOLDER/pages/ then has
it as a page for `make site`.
"""

import argparse
import time
from pathlib import Path

from postprocess import notebook, teaching_kit
from postprocess.output import write_files


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--out", required=True, metavar="FOLDER", help="where to write; folders are created")
    parser.add_argument("--execute", action="store_true", help="run the notebooks; needs nbclient and ipykernel")
    parser.add_argument("--lab", action="append", metavar="NAME", help="only this lab; may stand several times")


def run(arguments: argparse.Namespace) -> None:
    """Writes the notebooks and prints their paths; with --execute what each took, too."""
    out = Path(arguments.out).resolve()
    chosen = [lab for lab in teaching_kit.folders() if lab.name in (arguments.lab or [lab.name])]
    for number, lab in enumerate(chosen, 1):
        before = time.monotonic()
        book = notebook.made(lab, out)
        files = {Path(arguments.out) / f"lab-{lab.name}.ipynb": book}
        if arguments.execute:
            print(f"{number} of {len(chosen)}: {lab.name} ...", end="", flush=True)
            book = notebook.executed(book, out)
            page = f"lab-{lab.name}"
            files = {Path(arguments.out) / f"{page}.ipynb": book}
            files |= {out / "pages" / name: content for name, content in notebook.page_of(book, page).items()}
            print(f" {time.monotonic() - before:.0f} s")
        for path in write_files(files):
            print(path) if path.suffix == ".ipynb" else None
