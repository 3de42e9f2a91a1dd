"""A whole case: its statements in the order of the file, and the rules that hold between them.

`read_case(text, where, groups)` reads a case file's text, with the groups of its mesh if they are known: a Case, or a
Refusal is raised.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import TypeVar

from . import grammar as g
from .fields import STATEMENTS, GroupName, Reading, Statement, read_statement, shown, usage_of
from .groups import KINDS, Group, Groups, Where
from .words import Line, Refusal, quoted, spells_number, split_case

MOST = 1000  # statements
ONLY_ONE = (
    "only one of clamp, symmetry, move, rotate, force and a moment that is rigid or about a point for a group, "
    "or clamp and move along different axes"
)
LATER = "move, rotate, pressure, traction, weight, a free force or moment, an obstacle's move"
WITHOUT_SHAPE = "move force law friction wear".split()
S = TypeVar("S", bound=Statement)


@dataclass
class Case:
    """The statements of a case; behind a join stands the tie or the contact that it makes."""

    where: Where
    groups: Groups
    statements: list[Statement] = field(default_factory=list)
    load_cases: list[str] = field(default_factory=list)  # and combinations, by name

    def of(self, kind: type[S]) -> list[S]:
        """The statements of a kind that change none before them."""
        return [s for s in self.statements if isinstance(s, kind) and s.changes is None]

    def has(self, *kinds: type[Statement]) -> bool:
        """Whether there is a statement of one of these kinds."""
        return any(isinstance(s, kinds) for s in self.statements)

    @property
    def touching(self) -> list[g.Contact | g.Obstacle]:
        """Contacts and obstacles, as they were stated first."""
        return [s for s in self.statements if isinstance(s, (g.Contact, g.Obstacle)) and s.changes is None]

    def on(self, kind: type[S]) -> dict[Group, S]:
        """By group: its statement of this kind."""
        return {group: s for s in self.of(kind) for name, group in s.groups() if name == "on"}

    @property
    def units(self) -> str:
        """Units of lengths and of pressures, or none."""
        found = self.of(g.Units)
        return f"{found[0].length} {found[0].pressure}" if found else "none"

    @property
    def thickness(self) -> float:
        return next((s.value for s in self.of(g.Thickness)), 1.0)

    def apart(self) -> set[Group]:
        """Of bodies of one material, by one statement: those that only joins, sizes and groups name."""
        if not self.groups.only_body:
            return set()
        return {Group(self.where.dimension, name) for name in self.groups.labels} - set(self.used())

    def used(self) -> list[Group]:
        """The groups that the problem uses, in the order of their first statements."""
        aside = (g.PickedGroup, g.Size, g.Join)
        found = (group for s in self.statements if not isinstance(s, aside) for _, group in s.groups())
        return list(dict.fromkeys(found))


@dataclass
class Rules:
    """A case while it is read: what was stated, where, and what may follow."""

    case: Case
    stated: dict[object, Statement] = field(default_factory=dict)  # by key: the first
    held: dict[Group, list[Statement]] = field(default_factory=dict)
    gap_way: dict[object, tuple[bool, int]] = field(default_factory=dict)  # of each slave: vertical, and the line
    first_leg: int = 0
    rows: int = 0

    def read(self, line: Line) -> None:
        """Reads a line and adds its statement."""
        word, where = line.words[0], self.case.where
        if word not in STATEMENTS:
            line.no(f"{word}: unknown statement; {g.lead_to(word)}allowed: {', '.join(STATEMENTS)}")
        cls = STATEMENTS[word]
        if where.phase > 1 and not (cls.in_legs or word == "leg"):
            line.no(f"{word}: in leg {where.phase}, but it holds in every leg; allowed there: {LATER}")
        if cls is g.Obstacle and len(line.words) > 2 and line.words[2] in WITHOUT_SHAPE:
            cls = self.obstacle_without_shape(line)
        made = read_statement(line, where, self.case.groups, cls)
        self.add(made)
        if isinstance(made, g.Join) and made.how != "part":
            self.read(made.line_of(line))
        elif line.left:
            Reading(line, where, self.case.groups, cls).stray()

    def add(self, s: Statement) -> None:
        """Adds a statement, if no one before it excludes it."""
        where = self.case.where
        if isinstance(s, (g.Obstacle, g.ObstacleMove)) and where.phase > 1:
            self.change_obstacle(s)
        elif where.phase > 1 and s.in_legs and not (isinstance(s, (g.Force, g.Moment)) and s.how and s.holds()):
            self.change(s, s.key())
            if isinstance(s, g.Force) and s.how is None:
                self.no(s, f"{s.on}: a force in two legs; allowed there: move, rotate, pressure, traction, weight")
        elif s.holds():
            self.hold(s)
        else:
            self.once(s)
        if isinstance(s, g.State):
            if self.rows:
                first = next(
                    one.line
                    for one in self.case.statements
                    if not isinstance(one, (g.Units, g.Thickness, g.PickedGroup, g.Size))
                )
                self.no(s, f"state: after line {first}; allowed: before all statements but units and thickness")
            where.state = s.name
        if isinstance(s, g.PickedGroup):
            self.name_of_group(s)
        if isinstance(s, g.Cut):
            self.name_of_cut(s)
        if isinstance(s, (g.Contact, g.Tie, g.Obstacle)) and s.changes is None:
            self.measure(s)
        if isinstance(s, g.Leg):
            where.phase += 1
            self.first_leg = self.first_leg or s.line
        self.case.statements.append(s)
        aside = (g.Units, g.State, g.Thickness, g.PickedGroup, g.Size, g.Join, g.Spin, g.Gravity)
        self.rows += not isinstance(s, aside)
        if self.rows > MOST:
            self.no(s, f"more than {MOST} statements; allowed: fewer")

    def no(self, s: Statement, what: str) -> None:
        raise Refusal(what, s.line)

    def once(self, s: Statement) -> None:
        """Refuses what was stated before."""
        what, before = s.once, self.stated.get(s.key())
        if isinstance(s, (g.Force, g.Moment)):
            what = f"free {s.word} on {s.on}"
        what = what.format(s=s)
        if before and what:
            self.not_twice(s, what, before, s.in_legs and not isinstance(s, g.Obstacle))
            self.no(s, f"{what}: stated before, in line {before.line}; allowed: once")
        self.stated[s.key()] = s

    def not_twice(self, s: Statement, what: str, before: Statement, grows: bool) -> None:
        """A load or motion before the first leg and again in it."""
        if grows and self.case.where.phase == 1 and before.line < self.first_leg:
            self.no(
                s,
                f"{what} in line {before.line}, before the first leg, and again in it; "
                f"allowed: without line {before.line}: the first leg begins with no load and no motion",
            )

    def hold(self, s: Statement) -> None:
        """A boundary is held in one way, or along each axis in one."""
        word, group = s.word, s.groups()[0][1]
        if self.case.where.phase > 1:
            self.no(s, f"{group}: a rigid group's {word} in two legs; allowed there: a {word} that is free")
        for before in self.held.get(group, []):
            if both := s.axes() & before.axes():
                along = f" along {min(both)}" if len(both) < 3 else ""
                self.not_twice(s, f"{word} {group}", before, before.word == word)
                self.no(s, f"{group}: {word} after {before.word}{along} in line {before.line}; allowed: {ONLY_ONE}")
        self.held.setdefault(group, []).append(s)
        self.stated[s.key()] = s

    def change(self, s: Statement, key: object) -> None:
        """In later load phases: what was stated before, as a total reached in this one."""
        phase, start = self.case.where.phase, f"{s.words[0]} {s.words[1]}"
        holding = self.held.get(s.groups()[0][1], []) if isinstance(s, g.Move) and key not in self.stated else []
        for other in holding:
            if s.axes() & other.axes():
                self.no(s, f"{start}: other components than in line {other.line}; allowed: those of that line")
        if key not in self.stated:
            self.no(
                s,
                f"{start}: first stated in leg {phase}; allowed: also behind the first leg in line {self.first_leg}: "
                f"{with_zeros(s)}",
            )
        s.changes = self.stated[key]
        # a phase is a key of its own: a change is stated once in it
        if before := self.stated.get((phase, key)):
            self.no(
                s, f"{s.words[0]} of {s.words[1]} in leg {phase}: stated before, in line {before.line}; allowed: once"
            )
        self.stated[phase, key] = s

    def obstacles_of(self, group: Group) -> list[g.Obstacle]:
        return [s for s in self.case.of(g.Obstacle) if s.on == group]

    def obstacle_without_shape(self, line: Line) -> type[Statement]:
        """A later phase may leave out the shape of an obstacle that moves."""
        where, word = self.case.where, line.words[2]
        if where.phase > 1 and word == "move":
            return g.ObstacleMove
        reading = Reading(line, where, self.case.groups, g.Obstacle)
        here = self.obstacles_of(GroupName(False, "SLAVE").read(reading))
        behind = f"{word} behind the shape in line {here[-1].line}" if here else ""
        behind += ", where that of the first leg stands" if here and word == "move" else ""
        allowed = behind or f"a shape before it, as {shown(g.Obstacle.example, where)}"
        line.no(f"obstacle {line.words[1]}: {word} without a shape; allowed: {allowed}")

    def change_obstacle(self, s: g.Obstacle | g.ObstacleMove) -> None:
        """In later load phases: another move of an obstacle; the only one of its slave may stand without its shape."""
        key = s.key()
        start = f"obstacle {s.on}: "
        if isinstance(s, g.ObstacleMove):
            here = self.obstacles_of(s.on)
            if len(here) != 1:
                self.no(s, f"{start}{len(here)} obstacles of it; allowed in a later leg: its shape before move")
            key = here[0].key()
        known = self.stated.get(key)
        if not isinstance(known, g.Obstacle):
            self.change(s, key)
        assert isinstance(known, g.Obstacle)
        no_move = f"{start}no move here or in line {known.line}; allowed in several legs: a move in each, be it 0"
        if isinstance(s, g.ObstacleMove) and not isinstance(known.drive, g.Moved):
            self.no(s, no_move)
        self.change(s, key)
        if isinstance(s, g.ObstacleMove):
            return
        if isinstance(s.drive, g.Pushed):
            self.no(s, f"this obstacle of {s.on}: stated before, in line {known.line}; allowed: once")
        rest = [(one.law, one.interference, one.friction) for one in (s, known)]
        if any(rest[0]) and rest[0] != rest[1]:
            self.no(
                s,
                f"{start}law, friction or interference unlike line {known.line}; "
                "allowed in a later leg: another move alone",
            )
        if not (isinstance(s.drive, g.Moved) and isinstance(known.drive, g.Moved)):
            self.no(s, no_move)

    def measure(self, s: g.Contact | g.Tie | g.Obstacle) -> None:
        """Gaps of one slave, in space of all contacts, are measured in one way."""
        space = self.case.where.space
        slave = s.on if isinstance(s, g.Obstacle) else s.slave
        vertical = isinstance(s, g.Contact) and s.vertical
        of = None if space else slave
        before, line = self.gap_way.get(of, (vertical, 0))
        if before != vertical:
            self.no(
                s,
                f"{slave}: gap {'vertical' if vertical else 'along its normals'}, in line {line} it is not; "
                f"allowed: one way for {'all contacts' if space else 'one slave'}",
            )
        self.gap_way[of] = vertical, s.line

    def name_of_group(self, s: g.PickedGroup) -> None:
        if self.case.groups.in_file(s.name):
            self.no(s, f"{quoted(s.name)}: the mesh or geometry has a group of this name; allowed: another name")
        if s.name in self.case.groups.cad:
            self.no(s, f"{quoted(s.name)}: a cut or a join has a group of this name; allowed: another name")

    def name_of_cut(self, s: g.Cut) -> None:
        groups, where = self.case.groups, self.case.where
        if Group(where.dimension - 1, s.on.name) in groups.of_mesh and not where.again:
            self.no(s, f"{s.on}: the mesh or geometry has a group of this name; allowed: another name")


def with_zeros(s: Statement) -> str:
    """The line before anything of it is there."""
    skipped = s.words.index("move") if s.word == "obstacle" else 1
    last = len(s.words) - 1

    def zero(k: int, word: str) -> bool:
        return k > skipped and spells_number(word) and (s.word != "rotate" or k == last)

    return " ".join("0" if zero(k, w) else quoted(w) for k, w in enumerate(s.words))


# Once all is read


def check(case: Case, rules: Rules) -> None:
    """What is missing, or does nothing."""
    for wrong in chain(body_loads(case), heat(case), wear(case), whole(case, rules)):
        raise wrong


def body_loads(case: Case) -> Iterable[Refusal]:
    bodies = {group: s for group, s in case.on(g.Body).items() if s.density}
    for group, s in case.on(g.Spin).items():
        if group not in bodies:
            yield Refusal(
                f"spin {group}: the body has no density; allowed: body {group} E number nu number density number",
                s.line,
            )
    weights = case.on(g.Weight)
    for gravity in case.of(g.Gravity):
        for group in bodies.keys() & weights.keys():
            both = f"gravity, and a weight of {group} in line {weights[group].line}"
            yield Refusal(f"{both}; allowed: one of them", gravity.line)
        if not bodies:
            dense = "body NAME E number nu number density number"
            yield Refusal(f"gravity: no body has a density; allowed: {dense}", gravity.line)


def heat(case: Case) -> Iterable[Refusal]:
    conducts, each = case.on(g.Conduct), "with a line conduct BODY k for each body"
    given: list[Statement] = [
        s for s in case.statements if isinstance(s, (g.Temperature, g.Flux, g.Film, g.Source, g.Time))
    ]
    with_conductance = [s for s in case.of(g.Contact) if s.conductance]
    for pair in with_conductance:
        if pair.conductance and pair.conductance.fault():
            yield Refusal(f"conductance: {pair.conductance.fault()}; allowed: one of them", pair.line)
    if not conducts:
        for s in given:
            yield Refusal(f"a temperature, flux, film, source or time, and no body conducts; allowed: {each}", s.line)
        for s in with_conductance[-1:]:
            yield Refusal(f"a conductance, and no body conducts; allowed: {each}", s.line)
        return
    for s in [s for s in case.touching if s.wear][-1:]:
        yield Refusal("wear with conduct; allowed: one of them", s.line)
    for group, s in case.on(g.Body).items():
        if group not in conducts:
            yield Refusal(
                f"{group}: nothing says how it conducts, as others do; allowed: a line conduct {group} k", s.line
            )
    temperatures, warmed = case.on(g.Temperature), case.on(g.Flux).keys() | case.on(g.Film).keys()
    for s in case.of(g.Expand):
        group = s.groups()[0][1]
        yield Refusal(f"expand with conduct; allowed: conduct {group} k expand alpha from T", s.line)
    for s in case.of(g.Preload):
        yield Refusal("preload with conduct; allowed: one of them", s.line)
    for group in [group for group in case.used() if group in warmed and group in temperatures]:
        line = max(on[group].line for on in (case.on(g.Flux), case.on(g.Film)) if group in on)
        nothing = f"{group}: a flux or film where line {temperatures[group].line} gives the temperature does nothing"
        yield Refusal(f"{nothing}; allowed: one of them", line)
    for s in case.of(g.Time):
        for group in [group for group, body in conducts.items() if not body.capacity]:
            yield Refusal(f"time: {group} has no heat capacity; allowed: conduct {group} k capacity C", s.line)
    if not case.has(g.Temperature, g.Film, g.Time):
        yield Refusal("conduct, and no temperature anywhere; allowed: at least one line temperature or film")


def wear(case: Case) -> Iterable[Refusal]:
    worn = [s for s in case.touching if s.wear]
    slips = [s for s in worn if s.friction and s.friction.coefficient > 0]
    glides = [s for s in worn if s not in slips]
    cycles = case.of(g.Cycles)
    if worn and not cycles:
        yield Refusal("wear without cycles; allowed: a line cycles N", worn[-1].line)
    if slips and glides:
        yield Refusal(
            f"wear with slide, in line {slips[-1].line} wear by friction; allowed: one kind for all contacts",
            glides[-1].line,
        )
    if slips and case.where.phase < 2:
        one = "a first leg that loads, and further legs that are one cycle"
        yield Refusal(f"wear by friction without a cycle; allowed: {one}", slips[-1].line)
    if cycles and not worn:
        yield Refusal("cycles without wear; allowed: wear K slide S behind a contact or an obstacle", cycles[0].line)


def whole(case: Case, rules: Rules) -> Iterable[Refusal]:
    where, touching = case.where, [*case.touching, *case.of(g.Tie)]
    if not rules.rows and not case.has(g.Spin, g.Gravity):
        yield Refusal("it has no statement; allowed: at least body and contact or obstacle")
    known = case.on(g.Body).keys() | case.apart()
    for group in case.groups.all:
        if group.dimension == where.dimension and not where.overlap and group not in known:
            made = f"{KINDS[where.dimension]} {group} is made of; allowed: a line body {group} E number nu number"
            yield Refusal(f"nothing says what the {made}")
    slaves = {s.groups()[0][1]: s for s in touching}
    for group, s in slaves.items():
        if group in rules.held:
            by = rules.held[group][0]
            yield Refusal(
                f"{group}: a slave that line {by.line} holds ({by.word}); allowed: the other surface as slave",
                s.line,
            )
    loaded = {s.groups()[0][1]: s for s in case.statements if s.load() and (s.changes is None or s.loads)}
    for group, load in loaded.items():
        holding = [by for by in rules.held.get(group, []) if by.word != "force"]
        if set("xyz"[: where.dimension]).issubset(axis for by in holding for axis in by.axes()):
            line, word = holding[0].line, holding[0].word
            nothing = f"{group}: a {load.load()} on what line {line} holds ({word}) does nothing"
            yield Refusal(f"{nothing}; allowed: on another group", load.line)
    preloads = case.on(g.Preload)
    for group, cut in case.on(g.Cut).items():
        if group not in preloads:
            yield Refusal(f"cut {group}: nothing tightens it; allowed: a line preload {group} force", cut.line)
    tightened = {group: s for s in case.of(g.Tighten) for group in s.bolts}
    for group, tighten in tightened.items():
        if group not in preloads:
            yield Refusal(f"tighten {group}: has no preload; allowed: a line preload {group} force", tighten.line)
    for group, preload in preloads.items():
        if tightened and group not in tightened:
            why = f"preload {group}: no line tighten names it"
            yield Refusal(f"{why}; allowed: all preloads in lines tighten, or no such line", preload.line)
    if not touching:
        yield Refusal("no contact; allowed: at least one line contact or obstacle")
    if where.state == "axisymmetric" and case.thickness != 1:
        line = case.of(g.Thickness)[0].line
        yield Refusal("thickness with state axisymmetric; allowed: with strain and stress", line)


def read_lines(lines: Sequence[Line], where: Where, of_mesh: Sequence[Group] | None) -> Case:
    """The case of these lines, without load cases; arguments as those of read_case()."""
    where = replace(where)  # reading changes it
    groups = Groups(where, of_mesh or (), any_name=of_mesh is None)
    groups.look_ahead(lines)
    rules = Rules(Case(where, groups))
    for line in lines:
        rules.read(line)
    check(rules.case, rules)
    return rules.case


def read_case(text: str, where: Where, of_mesh: Sequence[Group] | None) -> Case:
    """The case of this text; raises a Refusal. `of_mesh`: the groups of its mesh, in their order.

    None: they are not known yet; any name is a group then, and all other mistakes are refused. With load cases it has
    the loads of all.
    """
    lines = split_case(text, lambda word: usage_of(word, where))
    if any(line.words[0] in ("load", "combine") for line in lines):
        from .rows import read_load_cases  # takes time to load

        return read_load_cases(lines, where, of_mesh)
    return read_lines(lines, where, of_mesh)
