"""Numbers on the pages that come from runs: `make numbers` runs their commands anew and writes what has changed.

Comments that no reader sees name the run and the value of each number; tests/output/test_numbers.py compares them.

    <!-- run: COMMAND -->      the run of the numbers below it, as typed after `FreeFem++`; with {c[0]}, ...,
                               the cells of a row, each row of the next table is a run. Without this comment: the
                               last command of the sh block above.
    <!-- let: STATEMENT -->    Python, for the expressions of this run
    <!-- columns: E | E; E --> the expressions of a row's cells after the first, `_` for a number of no run. Without
                               this comment the head has them: `key`, or words that the run prints before a number.
    <!-- long run: COMMAND --> one of above half a minute: the long tests hold it, `make numbers` leaves it
    NUMBER<!--= E -->          a single number; after "< " its bound

An expression is Python with the keys of summary.json, the run's tables (contact, series, ...), `code`, GIVEN,
printed("words") and again("more flags") as names.
"""

import difflib
import functools
import json
import re
import shlex
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from decimal import ROUND_HALF_EVEN, ROUND_UP, Decimal, getcontext
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import reference
from accounts import shared
from contact.test_adhesion import flags
from freefem import FREEFEM, ROOT, execute, table

from postprocess import closed_forms as forms

PAGES = [*ROOT.glob("*.md"), *sorted((ROOT / "edp").rglob("*.md")), *sorted((ROOT / "tests").glob("*.md"))]
TYPED = "FreeFem++ "
NUMBER = r"[−+-]?(?:\d{1,3}(?: \d{3})+|\d+)(?:\.\d+)?(?:e[-+]?\d+)?(?: %)?"
IN_CELL = re.compile(rf"`[^`]*`|(?<![\w.])({NUMBER})")
MARK = re.compile(rf"(?P<below>< )?(?P<number>{NUMBER})<!--= (?P<value>.*?) -->")
TOKEN = re.compile(
    r"^```sh\n(?P<block>.*?)^```|^<!-- (?P<kind>run|long run|let|columns): (?P<words>.*?) -->$|"
    r"(?P<table>(?:^\|[^\n]*\n)+)|" + MARK.pattern,
    re.M | re.S,
)
GIVEN = {"np": np, "forms": forms, "reference": reference, "STEEL": forms.plane_modulus(210e3, 0.3)}


@dataclass
class Unit:
    """The numbers of one run on a page."""

    command: str
    lets: list[str] = field(default_factory=list)
    long: bool = False
    marks: list[tuple[int, int, str, bool]] = field(default_factory=list)  # from, to, expression, whether a bound


# ---------------------------------------------------------------- written numbers


def number(text):
    """A number as it is written for readers: a true minus sign, blanks between thousands, maybe a percent sign."""
    text = text.replace("−", "-").replace(" ", "")
    return float(text.removesuffix("%")) / 100 if text.endswith("%") else float(text)


def last_digit(text):
    """One unit in the last digit of a written number."""
    digits, _, exponent = text.removesuffix("%").strip().partition("e")
    return 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]) - 2 * text.endswith("%"))


def agrees(value, text):
    """Whether the value is the written number: to its digits, or to the tolerance written after it."""
    written, _, tolerance = (word.strip() for word in text.partition("±"))
    return abs(value - number(written)) <= (float(tolerance) if tolerance else 0.51 * last_digit(written))


def like(text, value, bound=False):
    """The value written as the text is: as many digits, as it has signs and blanks. A bound: its size, rounded up."""
    percent = " %" * text.endswith("%")
    digits, _, exponent = text.removesuffix(" %").partition("e")
    places = len(digits.partition(".")[2])
    size = Decimal(abs(value)) * (100 if percent else 1)
    getcontext().rounding = ROUND_UP if bound else ROUND_HALF_EVEN
    if exponent:
        mantissa, _, power = f"{size:.{places}e}".partition("e")
        made = f"{mantissa}e{int(power)}"
    else:
        made = f"{size:,.{places}f}".replace(",", " " * (" " in digits))
    sign = "" if float(made.replace(" ", "")) == 0 else "−" if value < 0 and not bound else "+" * text.startswith("+")
    return sign + made + percent


# ---------------------------------------------------------------- pages


def units(text):
    """The units of a page, those without a number left out."""
    found, columns, rows = [Unit("")], "", False
    for token in TOKEN.finditer(text):
        if token["block"]:
            typed = [line for line in token["block"].splitlines() if line.startswith(TYPED) and "$" not in line]
            found += [Unit(line.removeprefix(TYPED)) for line in typed[-1:]]
            rows = False
        elif token["kind"] in ("run", "long run"):
            found.append(Unit(token["words"], long=token["kind"] == "long run"))
            columns, rows = "", "{" in token["words"]
        elif token["kind"] == "let":
            found[-1].lets.append(token["words"])
        elif token["kind"] == "columns":
            columns = token["words"]
        elif token["table"] and rows:
            found += of_rows(token["table"], token.start(), found.pop(), columns)
            rows = False
        else:
            for match in MARK.finditer(token[0]):
                place = (token.start() + end for end in match.span("number"))
                found[-1].marks.append((*place, match["value"], bool(match["below"])))
    return [unit for unit in found if unit.marks]


def of_rows(text, begin, unit, columns):
    """A unit each row of a table."""
    head, rule, *lines = text.splitlines(keepends=True)
    names = [name.strip() for name in head.split("|")[2:-1]]
    known = {"exit code": "code"}
    values = [name[1:-1] if "`" in name else known.get(name, f"printed({name!r})") for name in names]
    values = columns.split("|") if columns else values
    begin += len(head) + len(rule)
    for line in lines:
        cells = line.rstrip()[1:-1].split("|")
        c = [quoted[0] if (quoted := re.findall("`(.*?)`", cell)) else cell.strip() for cell in cells]
        row = Unit(eval(f"f{unit.command!r}", {**GIVEN, "c": c, "loop": loop}), [f"c = {c!r}", *unit.lets], unit.long)
        at = begin + 2 + len(cells[0])
        for cell, column in zip(cells[1:], values, strict=True):
            places = [match.span(1) for match in IN_CELL.finditer(cell) if match[1]]
            for (start, end), value in zip(places, column.split(";"), strict=False):
                if value.strip() not in ("", "_"):
                    row.marks.append((at + start, at + end, value.strip(), False))
            at += len(cell) + 1
        begin += len(line)
        yield row


# ---------------------------------------------------------------- runs


class Keys(SimpleNamespace):
    """A dictionary of summary.json: its keys as attributes, or by name."""

    def __getitem__(self, name):
        return getattr(self, name)


@shared
def run(command):
    """The names of a command's expressions."""
    with tempfile.TemporaryDirectory() as name:
        code, stdout = execute([*FREEFEM, *shlex.split(command), "-vtu", "0", "-out", name])
        if code not in (0, 20):
            raise RuntimeError(f"{command}: exit code {code}\n{stdout[-2000:]}")
        folder = Path(name)
        files = [path for path in folder.glob("*.csv") if path.name != "moments.csv"]  # which has names in it
        tables = {path.stem.replace("-", "_"): table(path) for path in files}
        keys = json.loads((folder / "summary.json").read_text(), object_hook=lambda pairs: Keys(**pairs))
    more = {"again": lambda words: Keys(**run(f"{command} {words}")), "printed": functools.partial(printed, stdout)}
    return {**GIVEN, **tables, **vars(keys), "code": code, **more}


def printed(stdout, label):
    """The number after the last place where a run printed this label."""
    found = re.findall(re.escape(label) + r"\s*[:=]?\s*([-+]?\d[\d.]*(?:e[-+]?\d+)?)", stdout)
    if not found:
        raise RuntimeError(f"{label} is not printed:\n{stdout[-2000:]}")
    return float(found[-1])


def loop(mu, element):
    """The flags of a path of the adhesive sphere, by Tabor's number and the element."""
    order, h = element.split(", ")
    mu, size = float(mu), float(h.split(" ")[0])
    far = -max(2.641 * mu ** (3 / 7), 1.65 * mu + 0.2) - 0.5
    given, _ = flags(mu, (far, 0.6 * mu + 0.5, far), size * (mu**1.5 if "√" in h else 1), order=int(order[1]))
    return shlex.join(map(str, given))


def differing(text, unit):
    """(from, to, old, new) of each number of a unit that its run does not give."""
    names, found = dict(run(unit.command)), []
    for statement in unit.lets:
        exec(statement, names)
    for start, end, expression, bound in unit.marks:
        value, old = eval(expression, names), text[start:end]
        if not (abs(value) < number(old) if bound else agrees(value, old)):
            found.append((start, end, old, like(old, value, bound)))
    return found


def renewed(text, workers=2):
    """The page with the numbers of its runs."""
    with ThreadPoolExecutor(workers) as pool:
        short = [unit for unit in units(text) if not unit.long]
        found = sorted(each for some in pool.map(functools.partial(differing, text), short) for each in some)
    for start, end, _, new in reversed(found):
        text = text[:start] + new + text[end:]
    return text


def main(paths):
    """Writes the pages anew and prints what has changed."""
    for path in [Path(path) for path in paths] or PAGES:
        old = path.read_text()
        new = renewed(old)
        path.write_text(new)
        lines = (each.splitlines(keepends=True) for each in (old, new))
        print("".join(difflib.unified_diff(*lines, str(path), n=0)), end="")


if __name__ == "__main__":
    main(sys.argv[1:])
