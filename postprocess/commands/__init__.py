"""Subcommands: every module of this folder is one.

A module is named like its subcommand, its docstring is the help text (first line: the summary), and it defines
`add_arguments(parser)` and `run(arguments)`. It raises `ResultsError` for anything that the user has to correct.
"""

import importlib
import pkgutil
from types import ModuleType


def modules() -> dict[str, ModuleType]:
    """The subcommands by name, in alphabetical order."""
    names = sorted(info.name for info in pkgutil.iter_modules(__path__))
    return {name: importlib.import_module(f"{__name__}.{name}") for name in names}
