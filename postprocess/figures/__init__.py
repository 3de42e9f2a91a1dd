"""Figures: every module of this folder is one.

A module is named like its figure, the first line of its docstring is the help text, `RUNS = (least, most)` is the
number of run folders it takes (most is None where any number will do), and `draw(runs, units)` returns a matplotlib
`Figure`. It raises `ResultsError` when a run does not hold what the figure shows. A figure of something other than runs
names what reads a folder: `READ = read_campaign`.
"""

import importlib
import pkgutil
from types import ModuleType


def modules() -> dict[str, ModuleType]:
    """The figures by name, in alphabetical order."""
    names = sorted(info.name for info in pkgutil.iter_modules(__path__))
    return {name: importlib.import_module(f"{__name__}.{name}") for name in names}
