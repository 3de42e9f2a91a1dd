"""The rows of series.csv of a case as curves: each load and motion, its reaction over its displacement."""

from dataclasses import dataclass

import numpy as np

from postprocess.results import ResultsError, Run, column_names, read_table

HINT = "; run the case with -history 1, or with load phases (leg)"
PLASTIC = "; a plastic case writes none: its energies are in the columns work, stored and dissipated"


@dataclass
class Curve:
    """A load or a motion: displacement and reaction of each load step, from the state without load if it is known."""

    name: str
    way: np.ndarray
    force: np.ndarray
    turns: bool  # a rotation or a moment

    def work(self) -> np.ndarray:
        """What it has done up to each step, by the trapezoidal rule."""
        steps = 0.5 * (self.force[1:] + self.force[:-1]) * np.diff(self.way)
        return np.concatenate([[0.0], np.cumsum(steps)])


def read_series(chosen: Run) -> dict:
    """All columns of series.csv; ResultsError where it is missing or has no loads of a case."""
    path = chosen.path / "series.csv"
    read_table(path, ["step"], HINT)
    table = read_table(path, column_names(path))
    if not any(name.endswith((" reaction", " normal force")) for name in table):
        raise ResultsError(path, f"has no loads and contacts of a case{PLASTIC if 'plasticStrain' in table else HINT}")
    return table


def load_curves(table: dict) -> list[Curve]:
    """The loads and motions with a displacement; from zero, except behind a preload, which moves them before."""
    tight = any(name.startswith("preload ") for name in table)
    begin = [] if tight else [0.0]
    found = []
    for column in table:
        name = column.removesuffix(" reaction")
        if name == column or f"{name} displacement" not in table:
            continue
        way, force = (np.concatenate([begin, table[f"{name} {what}"]]) for what in ("displacement", "reaction"))
        found.append(Curve(name, way, force, name.startswith(("rotate ", "moment "))))
    return found


def load_phases(table: dict) -> np.ndarray:
    """The load phase of each row; all of a series without phases are of the first."""
    return table.get("leg", np.ones(len(table["step"]), dtype=int))


def driving_load(table: dict) -> Curve | None:
    """The load or motion that does most in the last load phase: the sum of the sizes of its works; None without any."""
    rows = int((load_phases(table) == load_phases(table)[-1]).sum())
    sizes = [np.abs(np.diff(each.work()))[-rows:].sum() for each in load_curves(table)]
    return load_curves(table)[int(np.argmax(sizes))] if sizes and max(sizes) > 0 else None
