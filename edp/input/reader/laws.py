"""The law behind a contact or an obstacle: its name, and its parameters by name in any order."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from .fields import Number, Part, Reading
from .groups import Where
from .words import meant

PARAMETERS = {
    "kappa": Number("kappa", above=0, unit="pressure/length^m"),
    "m": Number("m", above=1, below=1000),
    "k": Number("k", above=0, unit="pressure/length"),
    "p0": Number("p0", above=0, unit="pressure"),
    "beta": Number("beta", above=0, unit="1/length"),
    "d0": Number("d0", below=0, unit="length"),
}
LAWS = {
    "power": "kappa m d0",
    "exponential": "p0 beta d0",
    "barrier": "p0 d0",
    "table": "d0",
    "linear": "k",
    "signorini": "",
}
EXAMPLE = "law power kappa 1e6 m 3 d0 -0.001"
NAMES = ", ".join(f"{law}{' FILE' * (law == 'table')} {takes}".rstrip() for law, takes in LAWS.items())


@dataclass(kw_only=True)
class Law(Part):
    """A contact law; `file`: the pressures of a table."""

    name: str
    file: str = ""
    kappa: float = 0.0
    m: float = 0.0
    k: float = 0.0
    p0: float = 0.0
    beta: float = 0.0
    d0: float = 0.0


def is_file(path: str, with_a_line: bool = False) -> bool:
    """Whether it is a file that can be read, no folder, pipe or device."""
    try:
        if not Path(path).is_file():
            return False
        with open(path, "rb") as file:
            return not with_a_line or file.read(1) != b""
    except (OSError, ValueError):
        return False


@dataclass(frozen=True)
class LawKind:
    """law NAME and all the parameters that it takes."""

    def read(self, reading: Reading) -> Law:
        line = reading.line
        if not line.left:
            line.no(f"a law's name is missing; allowed: {NAMES}, as {EXAMPLE}")
        name = line.next()
        if name not in LAWS:
            line.no(f"{name}: unknown law; {meant(name, LAWS)}allowed: {NAMES}, as {EXAMPLE}")
        takes = LAWS[name].split()
        file = ""
        if name == "table":
            if not line.left:
                line.no(f"the file of the law table is missing; allowed: {NAMES}")
            file = line.next()
            if not is_file(file, with_a_line=True):
                unlike = "no such file, or empty, a folder, a pipe or a device"
                line.no(f"{file}: {unlike}; allowed: a file of overlap,pressure pairs")
        given: dict[str, float] = {}
        while line.starts(*PARAMETERS):
            key = line.next()
            if key not in takes:
                line.no(f"{key}: not a parameter of the law {name}; allowed: {LAWS[name] or 'none'}")
            if key in given:
                line.no(f"{key}: given twice; allowed: once")
            given[key] = PARAMETERS[key].read(reading)
        for key in takes:
            if key not in given:
                line.no(f"law {name}: {key} is missing; allowed: law {name} with {LAWS[name]}")
        return Law(name=name, file=file, **given)

    def usage(self, where: Where) -> str:
        return "NAME ..."
