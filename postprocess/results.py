"""Result files of a run folder, read and checked.

`read_run(folder)` reads `summary.json` at once and every other file when it is first asked for. Columns are found by
name, so their order in the file is free and further columns do no harm. Lengths, pressures and forces carry the
units that the user gave the run in; overlaps are positive where bodies overlap, pressures positive in compression.

Every fault (no such file, empty, truncated, binary, foreign columns, NaN, counts that contradict the summary) raises
`ResultsError`, whose text is `<file>: <what is wrong>`.
"""

import json
import math
import warnings
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NoReturn, TypeGuard

import numpy as np

SIZE_LIMIT = 200 * 10**6  # bytes; a larger file is refused before it is opened

OPEN, LAW, WALL, TANGENT = 0, 1, 2, 3  # values of the column `status`

HISTORY = (
    "step adaptation iteration newton residual contactPoints statusChanges wallPoints overlapMax force "
    "factorisations backsolves seconds"
).split()
CONTACT = "x y weight overlap pressure lambda status threshold s tau".split()
ADAPTATIONS = "adaptation x y overlap pressure lambda status threshold s tau".split()
STEPS = "adaptation newton x y overlap pressure lambda status threshold s tau".split()
TRIANGLES = "a b c region".split()
STATES = "state adaptation newton vertex x y ux uy".split()
WHOLE = frozenset(
    "step adaptation iteration newton contactPoints statusChanges wallPoints factorisations backsolves status "
    "a b c region state vertex".split()
)
MAY_BE_INFINITE = frozenset(
    "threshold tau vonMisesError displacementError".split()
)  # +inf: a model without a wall, an error not known

SUMMARY = {
    "text": "scene method".split(),
    "count": "adaptations newton factorisations backsolves wallPoints contactPoints ndof points order".split(),
    "number": "force pressureMax overlapMax halfWidth modelError residual energy h".split(),  # null: undefined
    "mapping": "seconds parameters".split(),
}

Table = dict[str, np.ndarray]


class ResultsError(Exception):
    """A result file, or a set of them, that cannot be used: `<file>: <what is wrong>`."""

    def __init__(self, path: Path | str, what: str):
        super().__init__(f"{path}: {what}")


class JsonObject(dict[str, Any]):
    """An object of a JSON file; what is looked for and not there is a fault of that file."""

    def __init__(self, path: Path, content: dict[str, Any]):
        super().__init__(content)
        self.path = path

    def __missing__(self, key: str) -> NoReturn:
        raise ResultsError(self.path, f"has no key {key} where one is needed")


@dataclass(frozen=True)
class States:
    """Displacements of all vertices before the first and after every Newton step.

    adaptation, newton: (S,) int, the step that led to each state; both 0 before the first one. State 0 is undeformed;
                        a further state with newton = 0 holds the prescribed motion alone.
    x, y:   (V,) undeformed vertex coordinates [length].
    ux, uy: (S, V) displacements [length].
    """

    adaptation: np.ndarray
    newton: np.ndarray
    x: np.ndarray
    y: np.ndarray
    ux: np.ndarray
    uy: np.ndarray


@dataclass(frozen=True)
class Mesh:
    """Triangles of all bodies: triangles (M, 3) int vertex indices from 0; region (M,) int, 1 block, 2 disc."""

    triangles: np.ndarray
    region: np.ndarray


@dataclass(frozen=True)
class Steps:
    """The collocation points before the first and after every Newton step, sorted by x.

    adaptation, newton: (S,) int, the step that led to each state; both 0 before the first one.
    x, y:   (P,) undeformed coordinates [length].
    overlap, pressure, multiplier, status, threshold: (S, P); threshold may be inf (no wall).
    s, tau: (S, P) overlap and threshold from d0 on, with the digits that d0 swallows.
    """

    adaptation: np.ndarray
    newton: np.ndarray
    x: np.ndarray
    y: np.ndarray
    overlap: np.ndarray
    pressure: np.ndarray
    multiplier: np.ndarray
    status: np.ndarray
    threshold: np.ndarray
    s: np.ndarray
    tau: np.ndarray


@dataclass
class Run:
    """One run folder. `summary` is the content of summary.json; the other files are read on first use."""

    path: Path
    summary: dict

    @cached_property
    def history(self) -> Table:
        """A row per Newton step (may have none); columns HISTORY, integer where they count."""
        path = self.path / "history.csv"
        table = read_table(path, HISTORY)
        check_count(path, "Newton steps", len(table["newton"]), self.summary["newton"])
        if not np.array_equal(table["newton"], 1 + np.arange(len(table["newton"]))):
            raise ResultsError(path, "column newton does not count 1, 2, 3 ... over the whole run")
        if np.any(table["residual"] < 0):
            raise ResultsError(path, "column residual has a negative value")
        return table

    @cached_property
    def contact(self) -> Table:
        """A row per collocation point, sorted by x: columns CONTACT; threshold may be inf (no wall)."""
        path = self.path / "contact.csv"
        table = read_table(path, CONTACT)
        check_count(path, "collocation points", len(table["x"]), self.summary["points"])
        check_status(path, table["status"])
        order = np.lexsort((table["y"], table["x"]))
        return {name: column[order] for name, column in table.items()}

    @cached_property
    def adaptations(self) -> list[Table]:
        """A table per model solved, columns ADAPTATIONS, points sorted by x; threshold is that model's T^N.

        With load steps the models of all steps follow one another, as in the summary's newtonPerAdaptation.
        """
        path = self.path / "adaptations.csv"
        table = read_table(path, ADAPTATIONS)
        check_status(path, table["status"])
        numbers = np.unique(table["adaptation"])
        check_count(path, "adaptations", len(numbers), len(self.summary["newtonPerAdaptation"]))
        tables = []
        for number in numbers:
            rows = np.flatnonzero(table["adaptation"] == number)
            check_count(path, f"points in adaptation {number}", len(rows), self.summary["points"])
            rows = rows[np.lexsort((table["y"][rows], table["x"][rows]))]
            tables.append({name: column[rows] for name, column in table.items()})
        return tables

    @cached_property
    def mesh(self) -> Mesh:
        """The triangles of all bodies (runs made with `-states 1`)."""
        path = self.path / "triangles.csv"
        table = read_table(path, TRIANGLES, hint="; run the scene with -states 1")
        triangles = np.column_stack([table["a"], table["b"], table["c"]])
        vertices = len(self.states.x)
        if len(triangles) == 0:
            raise ResultsError(path, "has no rows")
        if triangles.min() < 0 or triangles.max() >= vertices:
            raise ResultsError(path, f"has a vertex index outside 0..{vertices - 1}, the vertices of states.csv")
        used = len(np.unique(triangles))
        if used < vertices:
            raise ResultsError(path, f"uses {used} of the {vertices} vertices of states.csv (truncated?)")
        return Mesh(triangles, table["region"])

    @cached_property
    def states(self) -> States:
        """The displacements after every Newton step (runs made with `-states 1`)."""
        path = self.path / "states.csv"
        table = read_table(path, STATES, hint="; run the scene with -states 1")
        refuse_space(path)
        rows = len(table["state"])
        if rows == 0:
            raise ResultsError(path, "has no rows")
        count = int(table["state"][-1]) + 1
        vertices = int(np.count_nonzero(table["state"] == 0))
        expected = np.repeat(np.arange(count), vertices)
        if rows != len(expected) or np.any(table["state"] != expected):
            raise ResultsError(path, f"is not complete: {rows} rows for {count} states of {vertices} vertices")
        grid = {name: column.reshape(count, vertices) for name, column in table.items()}
        for name, reference in (("vertex", np.arange(vertices)), ("x", grid["x"][0]), ("y", grid["y"][0])):
            if np.any(grid[name] != reference):
                raise ResultsError(path, f"column {name} differs from state to state")
        newton = grid["newton"][:, 0]
        check_count(path, "the last state's Newton step", int(newton[-1]), self.summary["newton"])
        return States(
            grid["adaptation"][:, 0], newton, grid["x"][0], grid["y"][0], grid["ux"].copy(), grid["uy"].copy()
        )

    @cached_property
    def steps(self) -> Steps:
        """The points at every Newton step (runs made with `-states 1`)."""
        path = self.path / "steps.csv"
        table = read_table(path, STEPS, hint="; run the scene with -states 1")
        refuse_space(path)
        points = self.summary["points"]
        rows = len(table["x"])
        check_count(path, "rows", rows, points * (self.summary["newton"] + 1))
        if rows == 0:
            raise ResultsError(path, "has no rows")
        check_status(path, table["status"])
        grid = {name: column.reshape(-1, points) for name, column in table.items()}
        if np.any(grid["newton"] != np.arange(len(grid["newton"]))[:, None]):
            raise ResultsError(path, f"column newton does not count 0, 1, 2 ..., {points} rows each")
        for name in ("adaptation", "x", "y"):
            reference = grid[name][:, :1] if name == "adaptation" else grid[name][:1]
            if np.any(grid[name] != reference):
                raise ResultsError(path, f"column {name} differs from row to row of a step, or from step to step")
        order = np.lexsort((grid["y"][0], grid["x"][0]))
        fields = [grid[name][:, order] for name in "overlap pressure lambda status threshold s tau".split()]
        labels = grid["adaptation"][:, 0], grid["newton"][:, 0]
        return Steps(*labels, grid["x"][0, order], grid["y"][0, order], *fields)

    def value(self, name: str) -> float:
        """A finite number from the summary; ResultsError when it is not there."""
        return finite(self, self.summary.get(name), f"has no number {name}")

    def parameter(self, name: str) -> float:
        """A finite number from the summary's `parameters`; ResultsError when it is not there."""
        return finite(self, self.summary["parameters"].get(name), f"parameters has no number {name}")

    def positive(self, name: str) -> float:
        """The same, for one that has to be above 0."""
        value = self.parameter(name)
        return finite(self, value if value > 0 else None, f"parameters has {name} = {value:g}, which is not above 0")


def finite(run: Run, value: object, fault: str) -> float:
    """The value where it is a finite number; otherwise the fault of the run's summary."""
    if not is_number(value):
        raise ResultsError(run.path / "summary.json", fault)
    return float(value)


def read_run(folder: Path | str) -> Run:
    """Opens a run folder and checks its summary; the tables are read when they are first used."""
    path = Path(folder)
    if not path.is_dir():
        raise ResultsError(path, "no such folder" if not path.exists() else "is not a folder")
    return Run(path, read_summary(path / "summary.json"))


def read_summary(path: Path) -> dict:
    """summary.json as a dict, with the keys of SUMMARY present and of their kind."""
    check_file(path)
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise ResultsError(path, system_message(error)) from None
    except UnicodeDecodeError:
        raise ResultsError(path, "is binary, not a JSON file") from None
    try:
        summary = json.loads(text, parse_constant=refuse_constant, object_hook=lambda found: JsonObject(path, found))
    except json.JSONDecodeError as error:
        raise ResultsError(path, f"is not JSON, or is truncated, at line {error.lineno}: {error.msg}") from None
    except (ValueError, RecursionError) as error:
        raise ResultsError(path, str(error)) from None
    if not isinstance(summary, dict):
        raise ResultsError(path, "is not a run's summary: it holds no keys")
    kinds = {
        "text": lambda value: isinstance(value, str),
        "count": lambda value: is_number(value) and float(value).is_integer() and value >= 0,
        "number": lambda value: value is None or is_number(value),
        "mapping": lambda value: isinstance(value, dict),
    }
    missing = [key for keys in SUMMARY.values() for key in keys if key not in summary]
    missing += [key for key in ("converged", "newtonPerAdaptation") if key not in summary]
    if missing:
        raise ResultsError(path, f"is not a run's summary: no key {', '.join(missing)}")
    for kind, keys in SUMMARY.items():
        for key in keys:
            if not kinds[kind](summary[key]):
                raise ResultsError(path, f"key {key} is not a {kind}: {summary[key]!r}"[:200])
    if not isinstance(summary["converged"], bool):
        raise ResultsError(path, f"key converged is not true or false: {summary['converged']!r}"[:200])
    for key in ("contacts", "prescribed", "stresses"):  # of runs of some kinds
        found = summary.get(key) or []
        if not isinstance(found, list) or not all(isinstance(each, dict) for each in found):
            raise ResultsError(path, f"key {key} is not a list of objects: {found!r}"[:200])
    if not isinstance(summary.get("estimates") or {}, dict):
        raise ResultsError(path, f"key estimates is not an object: {summary['estimates']!r}"[:200])
    for key in ("warnings", "given"):
        found = summary.setdefault(key, [] if key == "warnings" else list(summary["parameters"]))
        if not isinstance(found, list) or not all(isinstance(text, str) for text in found):
            raise ResultsError(path, f"key {key} is not a list of texts: {found!r}"[:200])
    if not isinstance(summary.setdefault("message", ""), str):
        raise ResultsError(path, f"key message is not a text: {summary['message']!r}"[:200])
    steps = summary["newtonPerAdaptation"]
    if not isinstance(steps, list) or not all(map(kinds["count"], steps)):
        raise ResultsError(path, f"key newtonPerAdaptation is not a list of counts: {steps!r}"[:200])
    for key in SUMMARY["count"]:
        summary[key] = int(summary[key])
    return summary


def read_table(path: Path, columns: list[str], hint: str = "") -> Table:
    """The named columns of a CSV file as arrays, (rows,) float64, or int64 for the columns in WHOLE.

    `hint` is added to the message when the file is missing. NaN is refused everywhere, inf outside MAY_BE_INFINITE.
    """
    check_file(path, hint)
    try:
        with path.open("rb") as file:
            start = file.read(65536)
            file.seek(-1, 2)
            end = file.read(1)
    except OSError as error:
        raise ResultsError(path, system_message(error)) from None
    try:
        if b"\0" in start:
            raise UnicodeError
        header = start.partition(b"\n")[0].decode("utf-8")
    except UnicodeError:
        raise ResultsError(path, "is binary, not a CSV file") from None
    names = [name.strip() for name in header.split(",")]
    missing = [name for name in columns if name not in names]
    if missing:
        raise ResultsError(path, f"wrong columns: no {', '.join(missing)} in the first line ({one_line(header)})")
    if len(set(names)) < len(names):
        raise ResultsError(path, f"wrong columns: a name appears twice in the first line ({one_line(header)})")
    if end != b"\n":
        raise ResultsError(path, "is truncated: the last line has no end")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # no rows: for the caller to judge
            values = np.loadtxt(path, delimiter=",", skiprows=1, comments=None, ndmin=2, encoding="utf-8", dtype=float)
    except (ValueError, OSError) as error:
        raise ResultsError(path, f"has an unreadable row: {one_line(str(error))}") from None
    if values.size == 0:
        values = np.empty((0, len(names)))
    if values.shape[1] != len(names):
        raise ResultsError(path, f"has {values.shape[1]} values in a row for {len(names)} column names")
    for name in names:
        checked_column(path, name, values[:, names.index(name)])
    return {name: checked_column(path, name, values[:, names.index(name)]) for name in columns}


def checked_column(path: Path, name: str, column: np.ndarray) -> np.ndarray:
    """The column of a table once its values are of the kind its name asks for."""
    bad = np.isnan(column) | (np.isinf(column) if name not in MAY_BE_INFINITE else column == -np.inf)
    if bad.any():
        row = int(np.argmax(bad))
        raise ResultsError(path, f"column {name} has the value {column[row]} in line {row + 2}")
    if name not in WHOLE:
        return column.copy()
    bad = (column != np.round(column)) | (np.abs(column) > 2**53)
    if bad.any():
        row = int(np.argmax(bad))
        raise ResultsError(path, f"column {name} has {column[row]:g} in line {row + 2}, not a whole number")
    return column.astype(np.int64)


def check_file(path: Path, hint: str = "") -> None:
    """Refuses a file that is missing, not a file, empty or larger than SIZE_LIMIT."""
    try:
        size = path.stat().st_size
    except FileNotFoundError:
        raise ResultsError(path, f"no such file{hint}") from None
    except OSError as error:
        raise ResultsError(path, system_message(error)) from None
    if not path.is_file():
        raise ResultsError(path, "is not a file")
    if size == 0:
        raise ResultsError(path, "is empty")
    if size > SIZE_LIMIT:
        raise ResultsError(path, f"is too large: {size / 1e6:.0f} MB, at most {SIZE_LIMIT / 1e6:.0f} MB are read")


def column_names(path: Path) -> list[str]:
    """The words of a table's first line."""
    check_file(path)
    try:
        with path.open(encoding="utf-8", errors="replace") as file:
            return file.readline().strip().split(",")
    except OSError as error:
        raise ResultsError(path, system_message(error)) from None


def refuse_space(path: Path) -> None:
    """Refuses a table whose points have a third coordinate; for a file that read_table has taken."""
    if "z" in column_names(path):
        raise ResultsError(path, "is of a run in space, which is not drawn here; open states.pvd in ParaView")


def check_count(path: Path, what: str, found: int, expected: int) -> None:
    """Refuses a table whose rows contradict the summary, as those of a file cut between two lines do."""
    if found != expected:
        raise ResultsError(path, f"{what}: {found}, but summary.json has {expected} (truncated, or of another run)")


def check_status(path: Path, status: np.ndarray) -> None:
    """Refuses a status other than OPEN, LAW, WALL and TANGENT."""
    bad = ~np.isin(status, (OPEN, LAW, WALL, TANGENT))
    if bad.any():
        words = "0 (open), 1 (law), 2 (wall) or 3 (tangent)"
        raise ResultsError(path, f"column status has {status[np.argmax(bad)]}, not {words}")


def is_number(value: object) -> TypeGuard[int | float]:
    """True for a finite JSON number; true and false are none."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def refuse_constant(name: str) -> None:
    """Called by the JSON reader for NaN and Infinity, which are not JSON."""
    raise ValueError(f"holds {name}, which is not a number")


def system_message(error: OSError) -> str:
    """The system's own words, on one line."""
    return (error.strerror or str(error)).lower()


def one_line(text: str, width: int = 120) -> str:
    """Text that may come from any file, as one printable line."""
    line = "".join(letter if letter.isprintable() else " " for letter in text).strip()
    return line if len(line) <= width else line[: width - 3] + "..."
