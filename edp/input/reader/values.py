"""A case as FreeFEM reads it: the problem as a whole, then each statement with its groups, and its values by name.

A value has the name of its field in grammar.py: `angle`; a component `centre.x`; what stands behind a keyword
`friction.coefficient`. Where a word chooses what follows, that is a text: `shape ball`. What is left out has no value.
input/case/statements.idp has a function for each.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence

from . import grammar as g
from .case import Case
from .fields import Part, Statement, Vector3
from .groups import Group, Where
from .rigid.shapes import has_edges

Value = tuple[str, float | str]
ASIDE = (g.Units, g.State, g.Thickness, g.PickedGroup, g.Size, g.Join, g.Gravity)  # no statements of their own there


def flat(part: Part, before: str = "") -> Iterator[Value]:
    """The values of a statement, or of what stands behind a keyword: numbers and texts by their names."""
    for item in dataclasses.fields(part):  # type: ignore[arg-type]
        name, value = before + item.name, getattr(part, item.name)
        match value:
            case float() | int():
                yield name, float(value)
            case str() if value:
                yield name, value
            case (float() as x, float() as y, float() as z):
                yield from vector(name, (x, y, z))
            case ((float(), float()), *_):
                yield f"{name}.count", float(len(value))
                for k, pair in enumerate(value):
                    yield from zip((f"{name}.{k}.x", f"{name}.{k}.y"), pair, strict=True)
            case Part() if not isinstance(value, Statement):
                yield name, type(value).__name__.lower()
                yield from flat(value, f"{name}.")


def vector(name: str, value: Vector3) -> list[Value]:
    return [(f"{name}.{axis}", component) for axis, component in zip("xyz", value, strict=True)]


def values(s: Statement, where: Where, density: float, surface: int = -1) -> list[Value]:
    """Those of a statement, and those that follow from them."""
    found = [(name, value) for name, value in flat(s) if name != "line"]
    if isinstance(s, g.Moment):
        found += vector("couple", s.couple)
    if surface >= 0:  # the number of a surface has the place of a radius
        given = ("shape.radius", "shape.inside")
        found = [(name, value) for name, value in found if name not in given]
        found += [("shape.radius", float(surface)), ("shape.inside", 0.0)]
    if isinstance(s, g.Spin):
        found.append(("density", density))
        if s.axis is None:
            found += vector("axis", (0.0, 1.0, 0.0) if where.state == "axisymmetric" else (0.0, 0.0, 1.0))
    return found


def weights(s: g.Gravity, dense: dict[Group, float], used: list[Group]) -> Iterator[tuple[Group, list[Value]]]:
    """Gravity is a weight of each body with a density."""
    for group in used:
        if group in dense:
            x, y, z = s.value
            yield group, vector("value", (x * dense[group], y * dense[group], z * dense[group]))


def table(case: Case, groups: Sequence[Group] = (), split: Mapping[int, int] | None = None) -> str:
    """The problem as a whole, the groups by their labels, then the statements; each has a line of

    word, line of the case, labels of its groups (0: none), the statement that it changes (-1: none), numbers, texts

    groups: by label, if some are split, and split: the labels of these by those of the groups in the case.
    """
    used = case.used()
    label = {group: k + 1 for k, group in enumerate(used)}
    groups = groups or used
    dense = {s.on: s.density for s in case.of(g.Body) if s.density}
    edged = [s for s in case.of(g.Obstacle) if has_edges(s.shape) and s.changes is None]
    rows: list[str] = []
    place: dict[int, int] = {}  # by statement

    def put(word: str, line: int, on: list[Group], changes: int, found: list[Value]) -> None:
        numbers = [f"{name} {value:.17g}" for name, value in found if isinstance(value, float)]
        texts = [f"{name} {value}" for name, value in found if isinstance(value, str)]
        sides = [label[group] for group in on[:2]] + [0] * (2 - len(on))
        same = [new for new, old in (split or {}).items() if word == "symmetry" and old == sides[0]]
        for first in (sides[0], *same):
            head = f"{word} {line} {first} {sides[1]} {changes} {len(numbers)} {len(texts)}"
            rows.append("\n".join([head, *numbers, *texts]))

    for s in case.statements:
        if not isinstance(s, ASIDE):
            changes = -1 if s.changes is None else place[id(s.changes)]
            place[id(s)] = len(rows)
            word = s.word if changes < 0 else "change"
            density = dense.get(s.on, 0.0) if isinstance(s, g.Spin) else 0.0
            surface = next((n for n, one in enumerate(edged) if one is s), -1)
            found = values(s, case.where, density, surface)
            if changes >= 0:  # only what it changes
                found = [(name, value) for name, value in found if isinstance(value, float)]
                if isinstance(s, (g.Obstacle, g.ObstacleMove)):
                    found = [(name, value) for name, value in found if name.startswith("drive.")]
            named = [group for _, group in s.groups()]
            for on in [[bolt] for bolt in named] if isinstance(s, g.Tighten) else [named]:
                put(word, s.line, on, changes, found)
    for gravity in case.of(g.Gravity):
        for group, found in weights(gravity, dense, used):
            put("weight", gravity.line, [group], -1, found)
    head = [f"units {case.units}", f"state {case.where.state}", f"thickness {case.thickness:.17g}"]
    head += [f"groups {len(groups)}", *(f"{group.dimension} {group.name}" for group in groups)]
    return "\n".join([*head, f"statements {len(rows)}", *rows]) + "\n"
