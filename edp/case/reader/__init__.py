"""The reader of case files: a text becomes typed statements, or a refusal of one line.

`read_case` (case.py) reads; grammar.py declares the statements; modules.py decides on modules; values.py writes what
FreeFEM reads.
"""

from .case import Case, read_case
from .groups import Group, Where
from .words import Refusal

__all__ = ["Case", "Group", "Refusal", "Where", "read_case"]
