"""write a run's bodies and contacts for other programs: ParaView, CalculiX's viewers, a spreadsheet

RUN is a result folder of any run made with -vtu 1, the default. RUN gets bodies.vtu, for ParaView, with the symmetric
tensor `stress`, `principal stresses` and their directions; bodies.frd, for cgx and other viewers of CalculiX's results;
contacts.csv and contact-points.csv, the results of a case's contacts with units in the head. Stresses need the
statement `stresses` in the case.
"""

import argparse
import csv
import io
from pathlib import Path

from postprocess.case_report import contact_results, is_case, objects_of_list
from postprocess.exchange import frd, read_exported, vtu
from postprocess.formatting import Units
from postprocess.output import register_files_of_run, write_files
from postprocess.results import ResultsError, Run, read_run

KINDS = ("vtu", "frd", "csv")
UNKNOWN = "not known"
AXES = ("", "X", "Y", "Z")
LENGTHS = {
    "x",
    "y",
    "z",
    "along",
    "overlap",
    "tau",
    "s",
    "threshold",
    *(f"slip{axis}" for axis in AXES),
}  # of contact.csv
STRESSES = {"pressure", "lambda", *(f"shear{axis}" for axis in AXES)}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RUN", help="result folder of a run with -vtu 1 (the default)")
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS, help="which files (default: all)")
    parser.add_argument(
        "--units", nargs=2, metavar=("LENGTH", "STRESS"), help="names of the units, if the case has none"
    )
    parser.add_argument("--out", metavar="FOLDER", help="where to write instead of RUN; it is created")


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, writes the files and prints their paths."""
    chosen = read_run(arguments.folder)
    kinds, contents = arguments.kinds, dict[str, bytes]()
    if {"vtu", "frd"} & set(kinds):
        bodies = read_exported(chosen.path)
        if bodies.stress is None:
            print("no stress tensor in this run: add the statement stresses to the case")
        contents |= {"bodies.vtu": vtu(bodies)} if "vtu" in kinds else {}
        contents |= {"bodies.frd": frd(bodies, chosen.path.name)} if "frd" in kinds else {}
    if "csv" in kinds:
        units = Units(chosen.summary, tuple(arguments.units) if arguments.units else None)
        if is_case(chosen.summary):
            contents["contacts.csv"] = text_of(contact_rows(chosen, units))
        contents["contact-points.csv"] = text_of(point_rows(chosen, units))
    if not arguments.out:
        register_files_of_run(chosen.path, list(contents))
    folder = Path(arguments.out) if arguments.out else chosen.path
    for path in write_files({folder / name: content for name, content in contents.items()}):
        print(path)


def text_of(rows: list[list]) -> bytes:
    """A table as a spreadsheet reads it: with a mark of its encoding, for the signs of units."""
    text = io.StringIO()
    csv.writer(text).writerows(rows)
    return text.getvalue().encode("utf-8-sig")


def head(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def contact_rows(chosen: Run, units: Units) -> list[list]:
    """The head, and a row a contact: names, each number and its estimated error; UNKNOWN where it has none."""
    contacts = objects_of_list(chosen.summary, "contacts")
    found: list[dict[str, object]] = [
        {"contact": each.get("name"), "slave": each.get("slave"), "master": each.get("master"), "law": each.get("law")}
        for each in contacts
    ]
    place = {str(each.get("name")): row for each, row in zip(contacts, found, strict=True)}
    for words, value, error, unit in contact_results(chosen.summary, units):
        name, _, what = str(words).rpartition(": ")
        if value is None or name not in place:
            continue
        parts = value if isinstance(value, list) else [value]
        for part, axis in zip(parts, "xyz" if isinstance(value, list) else " ", strict=False):
            place[name][head(f"{what} {axis}".strip(), unit)] = part
        if what != "points in contact":
            place[name][head(f"± of {what}", unit)] = UNKNOWN if error is None else error
    columns = list(dict.fromkeys(name for row in found for name in row))
    return [columns, *([row.get(name) for name in columns] for row in found)]


def point_rows(chosen: Run, units: Units) -> list[list]:
    """The table contact.csv with units in its head."""
    path = chosen.path / "contact.csv"
    try:
        with path.open(newline="") as file:
            names, *rows = list(csv.reader(file))
    except (OSError, ValueError, UnicodeError):
        raise ResultsError(path, "cannot be read") from None
    return [[column(name, units) for name in names], *rows]


def column(name: str, units: Units) -> str:
    if name in LENGTHS:
        return head(name, units.length)
    return head(name, units.stress) if name in STRESSES else name
