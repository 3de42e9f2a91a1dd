"""Measured values of a contact, and the model of a run that predicts them, with derivatives by the parameters.

A table has a column with the load: `approach`, `load` (a prescribed force), or a flag with its hyphen, as `-drag`. The
other columns are measured results; `NAME_sd` or `sd` has their standard deviations. Empty cells are not measured.
"""

import csv
import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from postprocess.problem_rows import Problem, Row, Setting
from postprocess.results import ResultsError, check_file

LOADS = {"approach": "u0", "load": "force"}
RESULTS = {  # of a table: the name of the result in rows.csv
    "force": "force",
    "approach": "approach",
    "stiffness": "stiffness",
    "pressure": "pressureMax",
    "pressureMax": "pressureMax",
    "overlap": "overlapMax",
    "halfWidth": "halfWidth",
    "contactLength": "contacts.1.contactLength",
    "radius": "halfWidthMoment",
}
DERIVED = {  # result of rows.csv: its name among the sensitivities
    "contacts.1.contactLength": "contactLength",
    "contacts.1.shearForce.1": "shearForceX",
    "contacts.1.shearForce.2": "shearForceY",
    "dragged.value": "dragged",
}
STEP = 1e-3  # relative, of differences where no sensitivity is known


@dataclass
class Measurements:
    """Loads and measured values, one after the other: a value is that of result `name` at load number `at`."""

    flag: str
    loads: list[float]
    names: list[str] = field(default_factory=list)
    at: list[int] = field(default_factory=list)
    values: list[float] = field(default_factory=list)
    deviations: list[float] = field(default_factory=list)
    is_scatter_known: bool = True


def number(path: Path, line: int, column: str, text: str) -> float:
    """A cell as a finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ResultsError(
            path, f"line {line}, {column}: {text!r} is not a number; allowed: a number, or an empty cell"
        )
    return value


def read_measurements(path: Path) -> Measurements:
    """The table of a file, checked."""
    check_file(path)
    with path.open(newline="", encoding="utf-8-sig") as f:
        lines = [[cell.strip() for cell in row] for row in csv.reader(f) if row and not row[0].startswith("#")]
    head = lines[0] if lines else []
    loads = [name for name in head if name.startswith("-") or name == "load"] or [n for n in head if n == "approach"]
    measured = [n for n in head if n not in loads and n != "sd" and not n.endswith("_sd")]
    if len(loads) != 1 or not measured or len(set(head)) < len(head):
        raise ResultsError(
            path,
            f"columns {','.join(head)}: allowed: one load (approach, load or a flag as -drag), and measured results",
        )
    unknown = [n for n in measured if n not in RESULTS and "." not in n]
    if unknown:
        raise ResultsError(
            path, f"column {unknown[0]}: allowed: {' '.join(RESULTS)}, or the name of a number in rows.csv"
        )
    if "sd" in head and len(measured) > 1:
        raise ResultsError(path, f"column sd: of which result? allowed: {' '.join(f'{n}_sd' for n in measured)}")
    found = Measurements(LOADS.get(loads[0], loads[0][1:]), [])
    missing = 0
    for k, cells in enumerate(lines[1:], 2):
        if len(cells) != len(head):
            raise ResultsError(path, f"line {k}: {len(cells)} cells; allowed: {len(head)}, as in the first line")
        row = dict(zip(head, cells, strict=True))
        found.loads.append(number(path, k, loads[0], row[loads[0]]))
        for name in measured:
            if row[name] == "":
                continue
            stated = row.get(f"{name}_sd", row.get("sd", ""))
            deviation = number(path, k, f"{name}_sd", stated) if stated else math.nan
            if deviation <= 0:
                raise ResultsError(path, f"line {k}, {name}: standard deviation {stated}; allowed: above 0")
            missing += not stated
            found.names.append(RESULTS.get(name, name))
            found.at.append(len(found.loads) - 1)
            found.values.append(number(path, k, name, row[name]))
            found.deviations.append(deviation)
    if not found.values:
        raise ResultsError(path, "has no measured values")
    if 0 < missing < len(found.values):
        raise ResultsError(path, "some values have a standard deviation, some none; allowed: all or none")
    if missing:  # equal relative errors within each result
        found.is_scatter_known = False
        found.deviations = [max(abs(value), 1e-300) for value in found.values]
    return found


@dataclass
class ContactModel:
    """The results of a problem at all loads, and their derivatives by the parameters, for least_squares.fit."""

    problem: Problem
    measured: Measurements
    fixed: Setting  # law and parameters that are not sought

    def predict(self, values: dict[str, float]) -> tuple[np.ndarray, np.ndarray] | None:
        """Values (data) and derivatives (data x parameters); None if a load has no solution."""
        names, loads = list(values), self.measured.loads
        direct = "stiffness" not in self.measured.names
        settings = [{**self.fixed, **values, self.measured.flag: load} for load in loads]
        steps = {name: STEP * (abs(value) or 1.0) for name, value in values.items()}
        shifted = [
            {**one, name: values[name] + side * steps[name]} for name in names for side in (-1, 1) for one in settings
        ]
        rows = self.problem.solve(settings + (shifted if not direct else []))
        if direct and not self.has_sensitivities(rows[: len(loads)], names):
            rows += self.problem.solve(shifted, False)
        found = np.zeros(len(self.measured.values))
        jacobian = np.zeros((len(found), len(names)))
        for k, (name, at) in enumerate(zip(self.measured.names, self.measured.at, strict=True)):
            row = rows[at]
            if row is None:
                return None
            found[k] = self.result(row, name)
            for j, parameter in enumerate(names):
                known = row.get(f"sensitivities.{DERIVED.get(name, name)}.{parameter}")
                if known is None:
                    known = row.get(f"sensitivities.{DERIVED.get(name, name)}.{parameter}.above")
                if known is None:
                    sides = [rows[len(loads) * (1 + 2 * j + side) + at] for side in (0, 1)]
                    ends = [math.nan if one is None else self.result(one, name) for one in sides]
                    known = (ends[1] - ends[0]) / (2 * steps[parameter])
                jacobian[k, j] = known
        return found, jacobian

    def has_sensitivities(self, rows: list[Row | None], names: list[str]) -> bool:
        """Whether all derivatives are known without differences."""
        for name, at in zip(self.measured.names, self.measured.at, strict=True):
            row = rows[at]
            for parameter in names:
                key = f"sensitivities.{DERIVED.get(name, name)}.{parameter}"
                if row is not None and key not in row and f"{key}.above" not in row:
                    return False
        return True

    def result(self, row: Row, name: str) -> float:
        """A result of a row; the stiffness is the derivative of the force by the approach."""
        if name == "stiffness":
            if "sensitivities.approach.force" in row:
                return 1 / row["sensitivities.approach.force"]
            return row.get("sensitivities.force.u0", row.get("sensitivities.force.u0.above", math.nan))
        if name not in row:
            raise ResultsError(
                name, "no such result of this run; allowed: a number in its rows.csv, or in summary.json"
            )
        return row[name]
