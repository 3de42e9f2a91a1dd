"""Problems on one mesh: load cases of a case file, and rows of a table whose columns name numbers of statements.

A load case or a row is a case of its own, with the same statements and other numbers. So the model of a case file with
load cases has the loads of all of them, each with its value in one: 0 where a case does not state it. The name of a
number is that of its line, as `force.grip.y`: the statement, its groups, a keyword or an axis.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from . import grammar as g
from .case import Case, read_lines
from .fields import STATEMENTS, Statement, Vector3, read_statement, usage_of
from .groups import Group, Groups, Where
from .laws import PARAMETERS
from .values import table
from .words import Line, Refusal, meant, spells_number, split_case

WITH_AXES = {"traction": 2, "weight": 2, "force": 2, "move": 2, "gravity": 1}  # by statement: where its numbers begin
ONE = {"pressure": 2, "moment": 2, "preload": 2, "spin": 2, "expand": 3}
GROUPS = {"contact": 2, "join": 2, "obstacle": 1, "gravity": 0}  # other statements have one
BEHIND = ("interference", "friction", "compliance", "limit", *PARAMETERS)
IN_CASES = "pressure, traction, weight, gravity, expand, a free force or moment, move, an obstacle's move"
Places = dict[str, int]  # by name: the place of a number among the words of a line


def places(line: Line, where: Where) -> Places:
    """The numbers of a line that a row may change; `interference` may be added at its end."""
    words, first = line.words, line.words[0]
    names = words[: 1 + GROUPS.get(first, 1)]
    base, axes = ".".join(names), "xyz"[: where.dimension]
    found = {f"{base}.{axis}": WITH_AXES[first] + k for k, axis in enumerate(axes) if first in WITH_AXES}
    if first in ONE:
        found[base] = ONE[first]
    if first in ("contact", "obstacle") or (first == "join" and words[3:4] == ["contact"]):
        for k in range(len(names), len(words)):
            if words[k] in BEHIND:
                found[f"{base}.{words[k]}"] = k + 1
            if first == "obstacle" and words[k] in ("move", "force"):
                found |= {f"{base}.{words[k]}.{axis}": k + 1 + n for n, axis in enumerate(axes)}
    found = {name: k for name, k in found.items() if k < len(words) and spells_number(words[k])}
    if first in ("contact", "obstacle"):
        found.setdefault(f"{base}.interference", len(words) + 1)
    return found


def put(line: Line, place: int, text: str) -> None:
    """Sets a word of the line, or adds the interference that it lacks."""
    line.words += ["interference", text][: max(place + 1 - len(line.words), 0)]
    line.words[place] = text


def copy_of(line: Line) -> Line:
    return Line(line.number, list(line.words))


@dataclass
class LoadCases:
    """A case file with load cases; without any, all of it is `common`."""

    where: Where
    common: list[Line] = field(default_factory=list)
    blocks: dict[str, list[Line]] = field(default_factory=dict)  # by load case: its lines
    combined: dict[str, list[tuple[float, str]]] = field(default_factory=dict)  # by combination: factors and load cases

    @property
    def names(self) -> list[str]:
        return [*self.blocks, *self.combined]

    def key(self, line: Line) -> tuple[str, ...]:
        """What two lines that are the same load have in common: all words but its numbers."""
        numbers = places(line, self.where).values()
        if line.words[0] == "obstacle":
            return tuple(line.words[:2])
        return tuple(word for k, word in enumerate(line.words) if k not in numbers)

    def held(self, line: Line) -> Line | None:
        """The line before all load cases whose motion this one replaces."""
        same = [one for one in self.common if one.words[0] == line.words[0] and self.key(one) == self.key(line)]
        return same[0] if same else None

    def shares(self, name: str) -> dict[str, float]:
        """By load case its factor in a load case or a combination."""
        return {case: factor for factor, case in self.combined.get(name, [(1.0, name)])}

    def lines(self, name: str = "") -> list[Line]:
        """The lines of one case, or with the first numbers of each load."""
        common = {id(line): copy_of(line) for line in self.common}
        loads: dict[tuple[str, ...], Line] = {}
        shares = self.shares(name) if name else {}
        stated: dict[int, dict[str, float]] = {}  # by line: the sum of its numbers
        for case, block in self.blocks.items():
            for line in block:
                held = self.held(line)
                target = common[id(held)] if held else loads.setdefault(self.key(line), copy_of(line))
                sums = stated.setdefault(id(target), {} if held else dict.fromkeys(places(target, self.where), 0.0))
                if case in shares:
                    target.number = line.number
                    for one, k in places(line, self.where).items():
                        if not one.endswith(".interference"):
                            sums[one] = sums.get(one, 0.0) + shares[case] * float(line.words[k])
        whole = [*common.values(), *loads.values()]
        for line in whole:
            for one, value in stated.get(id(line), {}).items():
                if name and not one.endswith(".interference"):
                    put(line, places(line, self.where)[one], f"{value:.17g}")
        return whole


def refuse_in_case(of: LoadCases, line: Line, name: str) -> None:
    """What a load case may not have."""
    words, where = line.words, of.where
    known, start = places(line, where), f"{words[0]} {words[1] if len(words) > 1 else ''}".rstrip()
    if words[0] not in (*WITH_AXES, "pressure", "moment", "expand", "obstacle"):
        line.no(
            f"{words[0]}: in load case {name}, but it holds in all; allowed before the first load case, here {IN_CASES}"
        )
    guided = words[0] == "force" and "free" not in words[2:]
    if guided or (words[0] == "moment" and ("rigid" in words[2:] or "about" in words[2:])):
        line.no(
            f"{start}: its group would be held in all load cases; allowed: {start} ... free"
            if guided
            else f"{start}: its group would be rigid in all load cases; allowed: a moment without rigid and about"
        )
    held = of.held(line)
    if words[0] in ("move", "obstacle"):
        at = [k for k, word in enumerate(words) if k > 1 and word == "move"]
        if words[0] == "obstacle" and not at:
            line.no(f"{start}: in load case {name} without move; allowed: {start} move and numbers")
        if not held or (words[0] == "obstacle" and "move" not in held.words):
            first = max([1, *at])
            zeros = " ".join("0" if k > first and spells_number(word) else word for k, word in enumerate(words))
            where_else = "also before the first one, with the motion of the others"
            line.no(f"{start}: it holds in all load cases; allowed: {where_else}, as {zeros}")
    elif held:
        line.no(f"{start}: also in line {held.number}, in all load cases; allowed: one of them")
    if not known:
        read_statement(copy_of(line), where, Groups(where, (), any_name=True), STATEMENTS[words[0]])  # refuses it
    for before in of.blocks[name]:
        if of.key(before) == of.key(line):
            line.no(f"{start}: stated before in load case {name}, in line {before.number}; allowed: once")


def load_cases(lines: Sequence[Line], where: Where) -> LoadCases:
    """Splits the lines of a case file; refuses wrong load cases and combinations."""
    of, present = LoadCases(where), ""
    anything = Groups(where, (), any_name=True)
    for line in lines:
        word = line.words[0]
        if word not in ("load", "combine"):
            if present and not of.combined:
                refuse_in_case(of, line, present)
                of.blocks[present].append(line)
            elif present:
                line.no(f"{word}: after combine; allowed: combinations at the end")
            else:
                of.common.append(line)
            continue
        made = read_statement(line, where, anything, STATEMENTS[word])
        assert isinstance(made, g.LoadCase | g.Combine)
        if made.name in of.names:
            line.no(f"{made.name}: a load case or combination before has this name; allowed: another name")
        if isinstance(made, g.LoadCase):
            if of.combined:
                line.no(f"load case {made.name}: after combine; allowed: combinations at the end")
            present = made.name
            of.blocks[present] = []
            continue
        for _, name in made.terms:
            if name not in of.blocks:
                line.no(
                    f"{name}: no load case; {meant(name, of.blocks)}"
                    f"allowed: {', '.join(of.blocks) or 'load cases before it'}"
                )
        if len({name for _, name in made.terms}) < len(made.terms):
            line.no(f"combine {made.name}: one load case twice; allowed: once")
        of.combined[made.name] = list(made.terms)
    legs = [line for line in of.common if line.words[0] in ("leg", "cycles", "time")]
    if of.blocks and legs:
        legs[0].no(f"{legs[0].words[0]}: with load cases; allowed: one of them")
    where.cases = bool(of.blocks)
    return of


def read_load_cases(lines: Sequence[Line], where: Where, of_mesh: Sequence[Group] | None) -> Case:
    """The case with the loads of all load cases, each of which is read and checked; arguments of read_case()."""
    of = load_cases(lines, replace(where))
    for name in of.names:
        read_lines(of.lines(name), of.where, of_mesh)
    case = read_lines(of.lines(), of.where, of_mesh)
    case.load_cases = of.names
    return case


# The rows of a table


@dataclass
class Table:
    """The columns of a table that are no flags, and its cells."""

    names: list[str]
    rows: list[list[str]]

    @classmethod
    def read(cls, file: Path) -> Table:
        lines = file.read_text(errors="surrogateescape").split("\n")
        columns, rows = map(int, lines[0].split())
        cells = lines[1 + columns :]
        return cls(lines[1 : 1 + columns], [cells[k * columns : (k + 1) * columns] for k in range(rows)])


def check_columns(of: LoadCases, names: Sequence[str]) -> None:
    """Refuses columns that are no number which a row may change."""
    lines = of.lines()
    found = [name for line in lines for name in places(line, of.where)]
    allowed = ", ".join((["case"] if of.blocks else []) + [name for name in dict.fromkeys(found)])
    if of.blocks and "case" not in names:
        raise Refusal("the file has load cases, the table no column case; allowed: a column case")
    for name in names:
        if name == "case" and not of.blocks:
            raise Refusal(f"column case: the file has no load case; allowed: {allowed}")
        if found.count(name) > 1:
            raise Refusal(f"column {name}: {found.count(name)} lines have this name; allowed: another column")
        if name not in found and name != "case":
            known = any(name.startswith(".".join(line.words[:2]) + ".") for line in lines)
            why = (
                "no number that a row may change: all rows have one mesh and stiffness, the same supports and contacts"
            )
            why = why if known else f"no number of a statement; {meant(name, found)}".rstrip("; ")
            raise Refusal(f"column {name}: {why}; allowed: {allowed}")


def row_lines(of: LoadCases, names: Sequence[str], cells: Sequence[str]) -> list[Line]:
    """The lines of a row's case."""
    given = {name: cell for name, cell in zip(names, cells, strict=True) if cell}
    case = given.pop("case", "")
    if of.blocks and case not in of.names:
        raise Refusal(f"case {case}: no load case; {meant(case, of.names)}allowed: {', '.join(of.names)}")
    lines = of.lines(case)
    for line in lines:
        for name, place in places(line, of.where).items():
            if name in given:
                put(line, place, given[name])
    return lines


def skeleton(text: str) -> list[str]:
    """A table of statements without its numbers."""
    rows = [line.split(" ") for line in text.split("\n")]
    heads = [len(row) == 7 and all(map(spells_number, row[1:])) for row in rows]  # with the line in the file
    numbers = [len(row) == 2 and spells_number(row[1]) for row in rows]
    return [
        " ".join(row[:1] + row[2:] if head or is_number else row)
        for row, head, is_number in zip(rows, heads, numbers, strict=True)
    ]


def guiding(s: Statement) -> Vector3 | None:
    """The force or moment of a statement whose group moves along or about it alone; None: another statement."""
    if isinstance(s, g.Obstacle):
        return s.drive.by if isinstance(s.drive, g.Pushed) else None
    if isinstance(s, g.Force):
        return s.resultant if s.how is None else None
    return s.couple if isinstance(s, g.Moment) and isinstance(s.how, g.About) else None


def refuse_other_model(base: Case, case: Case) -> None:
    """Refuses numbers that would change supports, or what friction needs."""
    for one, row in zip(base.statements, case.statements, strict=True):
        if (old := guiding(one)) and (new := guiding(row)):
            size, other = (sum(c * c for c in v) ** 0.5 for v in (old, new))
            if any(abs(a / size - b / other) > 1e-12 for a, b in zip(old, new, strict=True)):
                guides = f"{row.words[0]} {row.words[1]}: it guides its group along the force of the file"
                allowed = "a row may change its size; another direction, or its sign, needs a run of its own"
                raise Refusal(f"{guides}; allowed: {allowed}", row.line)
    for before, touching in zip(base.touching, case.touching, strict=True):
        if before.friction and touching.friction:
            if (before.friction.coefficient > 0) == (touching.friction.coefficient > 0):
                continue
            raise Refusal("friction: 0 in some rows; allowed: above 0 in the file and in all rows", touching.line)


def write_rows(
    file: Path,
    folder: Path,
    name: str,
    text: str,
    base: Case,
    of_mesh: Sequence[Group],
    groups: Sequence[Group],
    split: dict[int, int],
) -> None:
    """A file row-0, row-1, ... for each row: an empty line, or why it is refused; then the table of its statements."""
    wanted = Table.read(file)
    file.unlink()
    where = replace(base.where, state="", phase=0)
    of = load_cases(split_case(text, lambda word: usage_of(word, where)), where)
    check_columns(of, wanted.names)
    whole = skeleton(table(base, groups, split))
    for k, cells in enumerate(wanted.rows):
        why, made = "", ""
        try:
            case = read_lines(row_lines(of, wanted.names, cells), of.where, of_mesh)
            made = table(case, groups, split)
            if skeleton(made) != whole:
                raise Refusal("the row has other statements than the file; allowed: a run of its own")
            refuse_other_model(base, case)
        except Refusal as refusal:
            why = refusal.text(name)
        (folder / f"row-{k}").write_text(f"{why}\n{made}", errors="surrogateescape")
