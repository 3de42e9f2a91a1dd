"""check a student's answers of a lab: which are within tolerance, which are not

FILE is an answers.csv (columns flags, quantity, value; `make kit` writes one to fill in), or of lab 4 a law file
(.idp): its functions are checked against each other and solved with. It is a program, which runs here: read it first.
The expected values are those of ANSWERS.md. Allowed: 0.5 %, or half a unit of the last digit that the page has; counts
must be equal. Exit code 1: not all is well.
"""

import argparse
import csv
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from postprocess import markdown, teaching_kit
from postprocess.results import ResultsError, system_message

SHARE = 0.005
SECONDS = 120  # a law that loops for ever
CHECKS = {  # what lab 4 prints, and what is allowed of it
    "inverse of pressure, against s": 1e-6,
    "slope, against differences of the pressure": 1e-6,
    "pressure, against differences of the potential": 1e-6,
    "relative difference": 1e-9,
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("lab", metavar="N", help="the lab's number, 0 to 12")
    parser.add_argument("file", metavar="FILE", type=Path, help="answers.csv, or of lab 4 a law file (.idp)")


def run(arguments: argparse.Namespace) -> None:
    """Prints a line an answer, and how many are well; ends with code 1 where not all are."""
    found = [lab for lab in teaching_kit.folders() if lab.name.split("-")[0] == arguments.lab]
    if not found:
        raise ResultsError(
            arguments.lab, f"no such lab; allowed: {' '.join(lab.name.split('-')[0] for lab in teaching_kit.folders())}"
        )
    if arguments.file.suffix == ".idp":
        if arguments.lab != "4":
            raise ResultsError(arguments.file, "a law file is checked by lab 4 alone")
        lines = check_law_file(arguments.file)
    else:
        lines = check_answers(teaching_kit.read_page(found[0] / "ANSWERS.md"), arguments.file)
    good = sum(well for well, _ in lines)
    for well, words in lines:
        print(f"{'ok ' if well else 'OFF'}  {words}")
    print(f"{good} of {len(lines)} within tolerance")
    if good < len(lines):
        sys.exit(1)


# ---------------------------------------------------------------- answers


def expected(answers: str) -> dict[tuple[str, str], list[str]]:
    """The pages' cells by flags and quantity."""
    cells: dict[tuple[str, str], list[str]] = {}
    for head, rows in markdown.tables(answers):
        for flags, *values in rows:
            for name, cell in zip(head[1:], values, strict=True):
                if cell != "–":
                    cells.setdefault((key(flags), key(name)), []).append(cell)
    return cells


def key(text: str) -> str:
    """Flags or a quantity as they are compared: without marks and further blanks."""
    return " ".join(text.replace("`", "").split())


def number(text: str) -> float:
    """Also with a comma, as spreadsheets of many languages write it."""
    return float(text.replace("−", "-").replace(",", "."))


def tolerance(cell: str) -> float:
    """What is allowed beside a page's number: 0 for a count."""
    digits, _, exponent = cell.replace("−", "-").partition("e")
    if "." not in digits and not exponent:
        return 0.0
    last = 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))
    return max(0.501 * last, SHARE * abs(number(cell)))


def check_answers(answers: str, file: Path) -> list[tuple[bool, str]]:
    """Of each row that has a value: whether it is well, and words."""
    known = expected(answers)
    try:
        text = file.read_text(encoding="utf-8-sig")
        # the same spreadsheets part columns by semicolons
        lines = csv.reader(io.StringIO(text, newline=""), delimiter=";" if ";" in text.partition("\n")[0] else ",")
        head, *cells = list(lines) or [[]]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ResultsError(file, system_message(error) if isinstance(error, OSError) else "is not a CSV file") from None
    names = [name.strip().lower() for name in head]
    rows = [dict(zip(names, [*row, "", "", ""], strict=False)) for row in cells]
    if not rows or not {"flags", "quantity", "value"} <= {*names}:
        raise ResultsError(file, "its first line is to be flags,quantity,value, and a row an answer")
    found = []
    for place, row in enumerate(rows, 2):
        value = row["value"].strip()
        if not value:
            continue
        flags, quantity = key(row["flags"]), key(row["quantity"])
        words = f"{flags}, {quantity}: {value}"
        values = known.get((flags, quantity))
        if values is None:
            found.append((False, f"{words}: line {place}: the lab has no such number"))
            continue
        try:
            best = min(values, key=lambda cell: abs(number(value) - number(cell)))
        except ValueError:
            found.append((False, f"{words}: line {place}: is not a number"))
            continue
        allowed, away = tolerance(best), abs(number(value) - number(best))
        found.append((away <= allowed, f"{words}, expected {best} ± {allowed:.2g}"))
    if not found:
        raise ResultsError(file, "has no value")
    return found


# ---------------------------------------------------------------- a law


def check_law_file(file: Path) -> list[tuple[bool, str]]:
    """The checks that lab 4 prints, of a law in place of its own."""
    if not file.is_file():
        raise ResultsError(file, "is not there")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        edp, own = folder / "edp", teaching_kit.LABS.parent  # a copy: the package reads its own files before any other
        shutil.copytree(own, edp, ignore=shutil.ignore_patterns("*.png", "mylaw.idp"))
        for path in (own.parent / "meshes", own.parent / "build", own.parent / "freefem++.pref"):
            if path.exists():
                (folder / path.name).symlink_to(path)
        shutil.copyfile(file, edp / "labs/4-own-law/mylaw.idp")
        command = ["sh", f"{edp}/freefem.sh", f"{edp}/labs/4-own-law/own-law.edp", "-vtu", "0", "-out", f"{folder}/out"]
        quiet = {name: value for name, value in os.environ.items() if name != "CONTACT_RESULTS"}
        quiet |= {"LC_ALL": "C"}
        try:
            done = subprocess.run(
                command, cwd=folder, env=quiet, stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS
            )
        except subprocess.TimeoutExpired:
            return [(False, f"the run does not end: stopped after {SECONDS} seconds")]
    output = done.stdout.decode(errors="replace")
    found = []
    for words, allowed in CHECKS.items():
        printed = re.findall(rf"{re.escape(words)} (\S+)", output)
        value = float(printed[-1]) if printed else float("nan")
        shown = f"{value:.2g}" if printed else "not printed"
        found.append((value <= allowed, f"{words}: {shown}, at most {allowed:g}"))
    below = re.findall(r"below s = 0: (\S+) (\S+) (\S+)", output)
    found.append((bool(below) and all(float(v) == 0 for v in below[-1]), "pressure, slope, potential: 0 below s = 0"))
    if done.returncode != 0:
        (why,) = ([line for line in output.splitlines() if "error" in line.lower()] or output.splitlines() or [""])[:1]
        found.append((False, f"the run ends with code {done.returncode}: {why.strip()}"))
    return found
