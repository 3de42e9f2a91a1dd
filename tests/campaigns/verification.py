"""Published problems, solved by the package, beside their published numbers: `make verification`.

Each folder of tests/verification is a case: its case file, its geometry, and `numbers.toml` with the source, the
published numbers, the source's tolerance, and the expression that finds each number in the files of the run. The
program runs all cases, and writes tests/VERIFICATION.md between its marks.

A number is verified if it differs from the published one by no more than the error that the run estimates, or than
the tolerance of the source. Otherwise `reason` in numbers.toml says why it differs.
"""

import json
import re
import tempfile
import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from freefem import FREEFEM, ROOT, execute

from postprocess.formatting import typeset_number, with_error

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
    """The words after `FreeFem++`."""
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


def rows(name, case, numbers):
    """The lines of the table for the numbers of a case, and the reasons of those that differ."""
    lines, reasons = [], []
    for number, (value, error) in zip(case["number"], numbers, strict=True):
        given, tolerance = number["published"], number.get("tolerance")
        shown = typeset_number(f"{given:.6g}") + (f" (±{100 * tolerance:g} %)" if tolerance else "")
        words = verdict(number, value, error)
        if words == "differs":
            reasons.append(f"- `{name}`, {number['name']}: {number['reason']}")
            words = "explained below"
        label = f"{number['name']}{', ' * bool(number['unit'])}{number['unit']}"
        off = typeset_number(f"{round(100 * (value / given - 1), 2) + 0.0:+.2f} %")
        lines.append(f"| `{name}` | {label} | {shown} | {with_error(value, error)} | {off} | {words} |")
    return lines, reasons


def page(found):
    """The tables of the page and the reasons below them, of {name: [(value, error)]}."""
    lines = ["| case | model | source |", "| --- | --- | --- |"]
    for name, case in cases().items():
        link = f"[`{name}`](verification/{name}/{name}.case)"
        lines.append(f"| {link} {case['title']} | {case['model']} | {case['source']} |")
    lines += ["", "| case | number | published | package | off | verdict |", "| --- | --- | --- | --- | --- | --- |"]
    reasons = []
    for name, case in cases().items():
        more, why = rows(name, case, found[name])
        lines += more
        reasons += why
    return counts("\n".join(lines)) + "\n\n" + "\n".join([*lines, "", *reasons, ""])


def counts(table):
    """The sentences above the table."""
    inside, allowed, differ = (
        table.count(f"| {words} |") for words in ("inside ±", "inside the tolerance", "explained below")
    )
    return (
        f"The {len(cases())} cases have {inside + allowed + differ} numbers: {inside} inside ±, {allowed} inside the "
        f"tolerance of the source. {differ} differ, for reasons that stand below the table."
    )


def main():
    found = {name: solve(name, case) for name, case in cases().items()}
    PAGE.write_text(MARKED.sub(lambda match: match[1] + page(found) + match[3], PAGE.read_text()))


if __name__ == "__main__":
    main()
