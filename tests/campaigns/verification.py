"""Published problems, solved by the package, beside their published numbers: `make verification`.

Each folder of tests/verification is a case: its case file, its geometry, and `numbers.toml` with the source, the
published numbers, the source's tolerance, and the expression that finds each number in the files of the run. The
program runs all cases, writes each one's found.csv, and writes tests/VERIFICATION.md between its marks.

A number is verified if it differs from the published one by no more than the error that the run estimates, or than
the tolerance of the source. Otherwise `reason` in numbers.toml says why it differs.
"""

import csv
import json
import math
import re
import sys
import tempfile
import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from freefem import FREEFEM, ROOT, execute

FOLDER = ROOT / "tests/verification"
PAGE = ROOT / "tests/VERIFICATION.md"
MARKED = re.compile(r"(<!-- cases: make verification -->\n)(.*?)(<!-- end -->)", re.S)


class Keys(SimpleNamespace):
    """A dictionary of summary.json: its keys as attributes."""


def cases():
    """{name: what numbers.toml says}, in the order of the page."""
    found = {path.parent.name: tomllib.loads(path.read_text()) for path in FOLDER.glob("*/numbers.toml")}
    first = ["cb1", "cb1-friction", "cb2", "cb2-friction", "ssnv104", "ssna102"]
    return {name: found[name] for name in first} | {name: found[name] for name in sorted(found) if name not in first}


def command(name, case):
    """The words after `FreeFem++ -nw -v 0`."""
    script = "parts-3d" if case["model"] == "space" else "parts"
    geometry = (FOLDER / case.get("geometry", f"{name}/{name}.geo")).resolve().relative_to(ROOT)
    return f"edp/{script}.edp -mesh {geometry} -case tests/verification/{name}/{name}.case".split()


def scaled(number, factor):
    """A value and its error in another unit."""
    error = None if number.error is None else number.error * abs(factor)
    return Keys(value=number.value * factor, error=error)


def of_line(folder):
    """The function line(NAME, distance, column): a value on a line of stresses, for displacements with its error."""

    def line(name, distance, column):
        rows = np.genfromtxt(folder / f"line-{name}.csv", delimiter=",", names=True)
        value, error = (
            float(np.interp(distance, rows["distance"], rows[key])) for key in (column, "displacementError")
        )
        return Keys(value=value, error=error if column in ("ux", "uy", "uz") else None)

    return line


def solve(name, case):
    """[(value, error or None)] of the numbers of a case, by a run of it."""
    with tempfile.TemporaryDirectory() as place:
        code, stdout = execute([*FREEFEM, *command(name, case), "-vtu", "0", "-out", place])
        if code != 0:
            raise RuntimeError(f"{name}: exit code {code}\n{stdout[-2000:]}")
        folder = Path(place)
        names = json.loads((folder / "summary.json").read_text(), object_hook=lambda pairs: Keys(**pairs))
        names = {**vars(names), "line": of_line(folder), "scaled": scaled, "np": np}
        found = [eval(number["found"], names) for number in case["number"]]
    return [(number.value, number.error) for number in found]


def verdict(number, value, error):
    """The bound that holds: the error of the run, the tolerance of the source, or none."""
    off = abs(value - number["published"])
    if error is not None and off <= error:
        return "inside ±"
    if off <= number.get("tolerance", 0) * abs(number["published"]):
        return "inside the tolerance"
    return "differs"


# ---------------------------------------------------------------- the page


def to_digits(value, digits):
    """A number for readers: this many digits after the point, negative for rounding before it."""
    text = f"{round(value, digits):.{max(digits, 0)}f}"
    whole, point, rest = text.lstrip("-").partition(".")
    grouped = f"{int(whole):,}".replace(",", " ") if len(whole) > 4 else whole
    return "−" * text.startswith("-") + grouped + point + rest


def written(value, error):
    """A value and its error, to two digits of the error; five digits of a value without one."""
    size = error if error else abs(value) * 1e-3
    digits = min(1 - math.floor(math.log10(size)), 8 - math.floor(math.log10(abs(value))))
    return to_digits(value, digits) + (f" ± {to_digits(error, digits)}" if error is not None else "")


def rows_of(name):
    """The rows of a case's found.csv: value and error of each number."""
    with open(FOLDER / name / "found.csv") as file:
        rows = list(csv.DictReader(file))
    return [(float(row["value"]), float(row["error"]) if row["error"] else None) for row in rows]


def page(found):
    """The tables of the page and the reasons below them, of {name: [(value, error)]}."""
    every = cases()
    verdicts = [
        verdict(number, *pair)
        for name, case in every.items()
        for number, pair in zip(case["number"], found[name], strict=True)
    ]
    inside, allowed, differ = (verdicts.count(words) for words in ("inside ±", "inside the tolerance", "differs"))
    lines = [
        f"The {len(every)} cases have {len(verdicts)} numbers: {inside} inside ±, {allowed} inside the tolerance of "
        f"the source. {differ} differ, for reasons that stand below the table.",
        "",
        "| case | model | source |",
        "| --- | --- | --- |",
    ]
    for name, case in every.items():
        link = f"[`{name}`](verification/{name}/{name}.case)"
        lines.append(f"| {link} {case['title']} | {case['model']} | {case['source']} |")
    lines += ["", "| case | number | published | package | off | verdict |", "| --- | --- | --- | --- | --- | --- |"]
    reasons = []
    for name, case in every.items():
        for number, (value, error) in zip(case["number"], found[name], strict=True):
            given, tolerance = number["published"], number.get("tolerance")
            digits = 5 - math.floor(math.log10(abs(given)))
            shown = to_digits(given, digits).rstrip("0").rstrip(".") if digits > 0 else to_digits(given, 0)
            shown += f" (±{100 * tolerance:g} %)" if tolerance else ""
            words = verdict(number, value, error)
            if words == "differs":
                reasons.append(f"- `{name}`, {number['name']}: {number['reason']}")
                words = "explained below"
            label = f"{number['name']}{', ' * bool(number['unit'])}{number['unit']}"
            off = f"{100 * (value / given - 1):+.2f} %".replace("-", "−")
            lines.append(f"| `{name}` | {label} | {shown} | {written(value, error)} | {off} | {words} |")
    return "\n".join([*lines, "", *reasons, ""])


def with_cases(text, found):
    """The page with its tables written anew."""
    return MARKED.sub(lambda match: match[1] + page(found) + match[3], text)


def main(names):
    every = cases()
    for name in names or every:
        numbers = solve(name, every[name])
        with open(FOLDER / name / "found.csv", "w") as file:
            file.write("value,error\n")
            for value, error in numbers:
                file.write(f"{value:.8g},{'' if error is None else f'{error:.3g}'}\n")
        for number, (value, error) in zip(every[name]["number"], numbers, strict=True):
            words = f"published {number['published']:g}: {verdict(number, value, error)}"
            print(f"{name}: {number['name']}: {written(value, error)}, {words}")
    PAGE.write_text(with_cases(PAGE.read_text(), {name: rows_of(name) for name in every}))


if __name__ == "__main__":
    main(sys.argv[1:])
