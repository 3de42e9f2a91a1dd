"""A run in words, as numbers of a table, and as the command that makes it again."""

import os
import re
import shlex
from pathlib import Path

from postprocess import style
from postprocess.results import Run, is_number, one_line

ROOT = Path(__file__).resolve().parent.parent

LABS = "labs/"
NONE = "–"  # no number
NEWTONS = (["mm", "MPa"], ["m", "Pa"])  # units of length and pressure whose product is a newton
UNNAMED = (style.Units.length, style.Units.stress)  # of a command line without --units
FIGURES = ROOT / "edp" / "docs" / "reference" / "figures.md"

HISTORY_COLUMNS = (
    "Newton step,adaptation,residual,in contact,status changes,at the wall,greatest overlap,force,back-substitutions"
).split(",")


def figure_captions() -> dict[str, str]:
    """What each figure shows, by its name: the tables of edp/docs/reference/figures.md. Without that page none."""
    text = FIGURES.read_text(encoding="utf-8") if FIGURES.exists() else ""
    found = re.findall(r"^\| `([\w-]+)` \| (.+) \| `make [\w/. -]+` \|$", text, re.M)
    return {name: content.replace("`", "") + "." for name, content in found}


def run_caption(run: Run) -> str:
    """Scene, method and discretisation."""
    summary = run.summary
    return f"{summary['scene']}, {summary['method']}, P{summary['order']}, h = {short_number(summary['h'])}"


class Units:
    """The units of a case's run: of lengths, pressures, forces, moments and energies; empty where nothing names them.

    `given` are those of the command line. In the plane forces, moments and energies are those of a unit of thickness.
    """

    def __init__(self, summary: dict, given: tuple[str, str] | None = None):
        stated = summary.get("units")
        if given and tuple(given) != UNNAMED:
            stated = list(given)
        known = isinstance(stated, list) and len(stated) == 2
        self.length, self.stress = (one_line(str(name), 20) for name in stated) if stated and known else ("", "")
        self.plane = summary.get("state") in ("strain", "stress")
        self.force = self.moment = self.energy = ""
        if not known:
            return
        newton = "N" if stated in NEWTONS else ""
        self.force, self.moment = (self.product(newton, power) for power in (2, 3))
        # a newton metre of energy is a joule
        self.energy = self.moment.replace("N m", "J") if self.length == "m" else self.moment

    def product(self, newton: str, power: int) -> str:
        """A pressure times this power of a length, in the plane one less: of a unit of thickness."""
        power -= self.plane
        if newton:
            return {1: f"N/{self.length}", 2: "N", 3: f"N {self.length}"}[power]
        return f"{self.stress} {self.length}" + {1: "", 2: "²", 3: "³"}[power]


def first_line(described: object) -> str:
    """The first line of the docstring of a module or a function."""
    return (described.__doc__ or "").partition("\n")[0]


def short_number(value: object, digits: int = 6) -> str:
    """A number with so many digits; a dash for what is not defined."""
    if value is None:
        return NONE
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.{digits}g}" if isinstance(value, float) else str(value)


def with_error(number: object, error: object = None, unit: str = "") -> str:
    """A number with its error to two digits; without one, five digits of the number."""
    if not is_number(number):
        return NONE
    text = number_with_error(number, error) if is_number(error) and error > 0 else f"{number:.5g}"
    return typeset_number(text) + (f" {unit}" if unit else "")


def typeset_number(text: str) -> str:
    """A number with a true minus sign, and an exponent without zeros in front."""
    return re.sub(r"(?<!e)-", "−", re.sub(r"e([-+])0*(\d)", lambda found: "e" + found[1].strip("+") + found[2], text))


def number_with_error(number: float, error: float) -> str:
    """A number and its error with the digits that the error leaves."""
    power = int(f"{error:.1e}".partition("e")[2])
    if not -6 <= power - 1 <= 4 or abs(number) >= 1e7:
        digits = max(0, min(8, int(f"{abs(number):e}".partition("e")[2]) - power + 1)) if number else 0
        return f"{number:.{digits}e} ± {error:.1e}"
    digits = max(0, 1 - power)
    return f"{round(number, 1 - power):.{digits}f} ± {round(error, 1 - power):.{digits}f}"


def history_rows(run: Run) -> list[list[str]]:
    """A row of text per Newton step, HISTORY_COLUMNS."""
    history = run.history
    names = "newton adaptation residual contactPoints statusChanges wallPoints overlapMax force backsolves".split()
    rows = zip(*(history[name].tolist() for name in names), strict=True)
    return [
        [f"{value:.2e}" if name == "residual" else short_number(value) for name, value in zip(names, row, strict=True)]
        for row in rows
    ]


def script(scene: str, method: str = "") -> str:
    """The file of a scene, relative to the repository's root."""
    if scene == "disc-on-block":
        return "edp/scenes/disc-on-block-ipopt.edp" if method == "ipopt" else "edp/main.edp"
    if scene in ("parts", "parts-3d"):
        return f"edp/{scene}.edp"
    if scene.startswith(LABS):
        return f"edp/{scene}/{scene.partition('-')[2]}.edp"
    return f"edp/scenes/{scene}.edp"


def command(run: Run) -> str:
    """The command, from the repository's root, that makes the run again: with the flags that it was given."""
    summary, parameters = run.summary, run.summary["parameters"]
    words = ["FreeFem++", script(summary["scene"], summary["method"])]
    for name in summary["given"]:
        if name != "out":
            words += [*f"-{name}".split(" "), flag_text(parameters[name])]  # -set NAME of a number of the geometry
    return shlex.join([*words, "-out", path_in_package(run.path)])


def flag_text(value: object) -> str:
    """A flag's value as the command line takes it."""
    if is_number(value) and float(f"{value:g}") == value:
        return f"{value:g}"
    return repr(value) if isinstance(value, float) else str(value)


def path_in_package(path: Path | str) -> str:
    """A path relative to the repository's root where it lies in it."""
    full = Path(os.path.abspath(path))
    return str(full.relative_to(ROOT)) if full.is_relative_to(ROOT) else str(path)
