"""The reader of cases, meshes and geometries: a text becomes typed statements, or a refusal of one line.

`read_case` (case.py) reads; grammar.py declares the statements; modules.py decides on modules; values.py writes what
FreeFEM reads. mesher.py and picks.py are for geometries, msh.py, abaqus.py and bodies.py for meshes; problem.py takes
all together. Names are loaded when they are asked for: a run that finds its files waits for no grammar.
"""

from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False  # the module typing takes time to load
if TYPE_CHECKING:
    from .case import Case, read_case
    from .groups import Group, Where
    from .words import Refusal

OF = {"Case": "case", "read_case": "case", "Group": "groups", "Where": "groups", "Refusal": "words"}
__all__ = ["Case", "Group", "Refusal", "Where", "read_case"]


def __getattr__(name: str) -> object:
    if name not in OF:
        raise AttributeError(name)
    return getattr(import_module(f".{OF[name]}", __name__), name)
