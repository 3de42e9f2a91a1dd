"""How statements are declared: a dataclass for each, whose fields say how they are read, refused and shown.

A statement is a subclass of Statement with a word; a Part is what follows a keyword. These functions make their fields:

    number("the flux", "q", above=0)      a number within bounds
    vector("the force")                   two numbers, in space three
    boundary(), body()                    a group of the mesh
    word("NAME")                          a word of the user's
    option("steps", number(...))          a keyword and its value, which may be left out
    keyword("E", number(...))             a keyword and its value, which must be there
    choice("a word", "strain", "stress")  one of these words
    one_of(..., {"plane": Plane})         a word that selects a class, whose fields follow
    perhaps("free", {"free": Free})       as one_of, but it may be left out
    custom(kind)                          anything else: an object with `read` and `usage`

Fields that must be there are read in their order, options in any order, each once. In texts {a|b} is a in the plane,
b in space.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Protocol, dataclass_transform

from .groups import Group, Groups, Where
from .words import Line, meant, number_text, spells_number

VARIANT = re.compile(r"\{([^{}|]*)\|([^{}|]*)\}")
Condition = Callable[[Where], bool]
STATEMENTS: dict[str, type[Statement]] = {}  # by word, in the order of their declaration
MAGNITUDES = 1e-40, 1e40


def in_space(where: Where) -> bool:
    return where.space


def in_plane(where: Where) -> bool:
    return not where.space


def axisymmetric(where: Where) -> bool:
    return where.state == "axisymmetric"


def always(where: Where) -> bool:
    return True


def never(where: Where) -> bool:
    return False


def shown(text: str, where: Where) -> str:
    """A text with {plane|space} of the grammar, as it is in the plane or in space."""
    return VARIANT.sub(lambda found: found[2 if where.space else 1], text)


@dataclass_transform(kw_only_default=True)
class Part:
    """A piece of a statement: the fields behind a keyword; `refused`: where it may not stand, and what is said then."""

    refused: ClassVar[tuple[tuple[Condition, str], ...]] = ()

    def __init_subclass__(cls) -> None:
        # methods and a docstring made for each of sixty classes would double the reader's start
        cls.__doc__ = cls.__doc__ or cls.__name__
        dataclass(kw_only=True, init=False, repr=False, eq=False, match_args=False)(cls)

    def __init__(self, **values: Any) -> None:
        for item in dataclasses.fields(self):  # type: ignore[arg-type]
            if item.name not in values and item.default_factory is not dataclasses.MISSING:
                values[item.name] = item.default_factory()
        vars(self).update(values)

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and vars(self) == vars(other)


class Statement(Part):
    """A statement, with the words of its line; `changes`: the one of the first load phase whose values it changes."""

    word: ClassVar[str] = ""
    example: ClassVar[str] = ""  # a line of its own
    does: ClassVar[str] = ""  # in a few words, for who writes another word
    synonyms: ClassVar[str] = ""  # words that others use for it
    usage: ClassVar[str] = ""  # instead of the one that is made of the fields
    note: ClassVar[str] = ""  # behind that one
    once: ClassVar[str] = "{s.word} of {s.on}"  # it is stated once for each such text; "" for as often as one likes
    loads: ClassVar[str] = ""  # the word for it if it is a load, which does nothing on a group that is held
    stray: ClassVar[str] = "more than the statement takes"  # what is wrong with a word that is left
    hints: ClassVar[tuple[tuple[str, str], ...]] = ()  # of certain words
    support: ClassVar[bool] = False  # its group has no other one
    in_legs: ClassVar[bool] = False  # a later load phase may change it
    rest: ClassVar[bool] = False  # what is left is read as another statement
    line: int
    words: tuple[str, ...]
    changes: Statement | None = None

    def __init_subclass__(
        cls, word: str = "", example: str = "", holds: bool = False, in_legs: bool = False, rest: bool = False
    ) -> None:
        super().__init_subclass__()
        if word:
            STATEMENTS[word] = cls
            cls.word, cls.support, cls.in_legs, cls.rest = word, holds, in_legs, rest
            cls.example = example or cls.example

    def key(self) -> object:
        """By what two statements are the same."""
        return self.once.format(s=self)

    def groups(self) -> list[tuple[str, Group]]:
        """The groups that it names, with the names of their fields, in the order of the line."""
        found = ((item.name, getattr(self, item.name)) for item in dataclasses.fields(self))
        return [(name, group) for name, group in found if isinstance(group, Group)]

    def check(self, where: Where) -> str:
        """What is wrong with its values together, or nothing."""
        return ""

    def holds(self) -> bool:
        """Whether it is the support of its group."""
        return self.support

    def axes(self) -> set[str]:
        """The components of the displacement that a support holds."""
        return set("xyz")

    def load(self) -> str:
        """The word for it if it is a load on a boundary, which does nothing where that is held."""
        return self.loads


@dataclass
class Reading:
    """A line that is being read: what may stand where, and the groups there are."""

    line: Line
    where: Where
    groups: Groups
    cls: type[Statement]

    def no(self, what: str) -> Any:
        """Refuses the line, with what its statement takes."""
        self.line.no(f"{what}; {usage_of(self.cls.word, self.where)}")

    def stray(self) -> Any:
        """Refuses the next word, which nothing takes."""
        word = self.line.left[0]
        self.no(f"{word}: {dict(self.cls.hints).get(word, self.cls.stray)}")

    def need(self, what: str) -> str:
        """The next word, which must be there."""
        if not self.line.left:
            self.no(f"{what} is missing after {self.line.last}")
        return self.line.next()


class Kind(Protocol):
    """How a field is read and shown."""

    def read(self, reading: Reading) -> Any: ...

    def usage(self, where: Where) -> str: ...


@dataclass(frozen=True)
class Number:
    """A number within open bounds, or at least one."""

    what: str
    shown: str = "number"
    above: float | None = None
    below: float | None = None
    at_least: float | None = None
    at_most: float | None = None
    whole: bool = False
    prefix: str = ""  # a word that may stand before it
    only: Condition = always  # where it is there; elsewhere it is 0
    unit: str = ""  # its dimension in length, pressure, force, temperature, time, power; "" for a pure number

    def read(self, reading: Reading) -> float:
        if not self.only(reading.where):
            return 0.0
        if self.prefix and reading.line.starts(self.prefix):
            reading.line.next()
        text = reading.need(self.what)
        if not spells_number(text):
            reading.no(f"{text}: {self.what} is no number")
        value = float(text) + 0.0
        if re.search("[1-9]", re.split("[eE]", text)[0]) and not MAGNITUDES[0] <= abs(value) <= MAGNITUDES[1]:
            reading.line.no(
                f"{text}: {self.what} cannot be computed with; allowed: 0, and magnitudes from 1e-40 to 1e40"
            )
        low = (self.above is not None and value <= self.above) or (self.at_least is not None and value < self.at_least)
        high = (self.below is not None and value >= self.below) or (self.at_most is not None and value > self.at_most)
        if low or high:
            reading.line.no(f"{text}: {self.what} is out of range; allowed: {self.bounds()}")
        if self.whole and value != int(value):
            reading.no(f"{text}: no whole number{self.what.removeprefix('the number')}")
        return value

    def bounds(self) -> str:
        """The bounds in words."""
        limits = (("at least", self.at_least), ("above", self.above), ("below", self.below), ("at most", self.at_most))
        return " and ".join(f"{word} {number_text(bound)}" for word, bound in limits if bound is not None)

    def usage(self, where: Where) -> str:
        return f"{self.prefix} {self.shown}".lstrip() if self.only(where) else ""


Vector3 = tuple[float, float, float]


@dataclass(frozen=True)
class Vector:
    """Two numbers, in space three; the third is 0 in the plane."""

    what: str
    shown: str = "x y{| z}"
    nonzero: bool = False
    free: str = ""  # a word for a component that is not given, which is 0 here
    counted: str = ""  # by this name it is refused if there are more numbers than components
    only: Condition = always  # where it is there; elsewhere it is `other`
    other: Vector3 = (0.0, 0.0, 1.0)

    def read(self, reading: Reading) -> Vector3:
        if not self.only(reading.where):
            return self.other
        size = reading.where.dimension
        if self.counted:
            left = reading.line.left
            count = next((k for k, word in enumerate(left) if not spells_number(word) and word != self.free), len(left))
            if count > size:
                reading.no(
                    f"{reading.line.left[size]}: {self.counted} has {count} numbers, "
                    f"more than the {size} components there are"
                )
        values = [0.0 if self.is_free(reading) else Number(self.what).read(reading) for _ in range(size)]
        if self.nonzero and not any(values):
            reading.no(f"{self.what} is 0 in every direction")
        return values[0], values[1], values[2] if size == 3 else 0.0

    def is_free(self, reading: Reading) -> bool:
        return bool(self.free) and reading.line.starts(self.free) and reading.line.next() == self.free

    def usage(self, where: Where) -> str:
        return shown(self.shown, where) if self.only(where) else ""


@dataclass(frozen=True)
class GroupName:
    """A group of the mesh: of its bodies, or of their boundaries."""

    bodies: bool
    shown: str = ""

    def read(self, reading: Reading) -> Group:
        name = reading.need("a name")
        dimension = reading.where.dimension - (not self.bodies)
        wrong = reading.groups.why_not(dimension, name, reading.cls.word)
        if wrong:
            reading.line.no(wrong)
        return Group(dimension, name)

    def usage(self, where: Where) -> str:
        return self.shown or ("BODY" if self.bodies else "NAME")


@dataclass(frozen=True)
class Word:
    """A word of the user's; `allowed`: its signs, and how a refusal says them."""

    shown: str
    what: str = "a name"
    allowed: tuple[str, str] = ("", "")
    fault: Callable[[str], str] = lambda _: ""  # what is wrong with it, with what is allowed

    def read(self, reading: Reading) -> str:
        text = reading.need(self.what)
        if self.allowed[0] and not re.fullmatch(self.allowed[0], text):
            reading.line.no(f"{text}: {self.allowed[1]}")
        if wrong := self.fault(text):
            reading.line.no(wrong)
        return text

    def usage(self, where: Where) -> str:
        return self.shown


@dataclass(frozen=True)
class Choice:
    """One of a few words."""

    what: str
    shown: str
    words: tuple[str, ...]

    def read(self, reading: Reading) -> str:
        text = reading.need(self.what)
        if text not in self.words:
            reading.line.no(f"{text}: unknown; {meant(text, self.words)}{usage_of(reading.cls.word, reading.where)}")
        return text

    def usage(self, where: Where) -> str:
        return self.shown


@dataclass(frozen=True)
class PartOf:
    """The fields of a class, in a row."""

    cls: type[Part]

    def read(self, reading: Reading) -> Part:
        return self.cls(**read_fields(self.cls, reading))

    def usage(self, where: Where) -> str:
        return usage_of_fields(self.cls, where)


@dataclass(frozen=True)
class OneOf:
    """A word that selects a class, whose fields follow."""

    what: str
    shown: str
    variants: Mapping[str, type[Part]]
    optional: bool = False
    noun: str = ""
    allowed: Callable[[Where], str] | None = None  # instead of the statement's usage

    def classes(self, where: Where) -> dict[str, type[Part]]:
        """The classes by the words that stand for them there."""
        return {word: cls for text, cls in self.variants.items() if (word := shown(text, where))}

    def read(self, reading: Reading) -> Part:
        classes = self.classes(reading.where)
        word = reading.need(self.what)
        if word not in classes:
            elsewhere = not reading.where.space and word in self.classes(dataclasses.replace(reading.where, space=True))
            hint = (
                "a case in space is run by edp/parts-3d.edp; " if elsewhere and not self.noun else meant(word, classes)
            )
            allowed = self.allowed(reading.where) if self.allowed else usage_of(reading.cls.word, reading.where)
            reading.line.no(f"{word}: unknown{self.noun}; {hint}{allowed}")
        return classes[word](**read_fields(classes[word], reading))

    def usage(self, where: Where) -> str:
        text = shown(self.shown, where)
        return f"[{text}]" if self.optional else text

    def all(self, where: Where) -> str:
        """The words with what follows them."""
        return ", ".join(
            " ".join([word, usage_of_fields(cls, where, options=False)]) for word, cls in self.classes(where).items()
        )


@dataclass(frozen=True)
class Keyword:
    """A keyword and its value; `needed` and `absent`: where it must stand, and where it must not."""

    word: str
    kind: Kind | None  # None: the word alone is all
    needed: Condition = always
    absent: Condition = never

    def read(self, reading: Reading) -> Any:
        word = reading.need(self.word)
        if word != self.word:
            reading.no(f"{word}: not allowed here")
        return self.kind.read(reading) if self.kind else True

    def usage(self, where: Where) -> str:
        if self.absent(where):
            return ""
        text = f"{self.word} {self.kind.usage(where)}" if self.kind else self.word
        return text if self.needed(where) else f"[{text}]"


def custom(kind: Kind) -> Any:
    return field(metadata={"kind": kind})


def field_of(kind: Callable[..., Kind], *first: Any) -> Callable[..., Any]:
    """What declares a field of this kind, and takes the kind's own arguments."""
    return lambda *given, **more: custom(kind(*first, *given, **more))


number, vector, word = field_of(Number), field_of(Vector), field_of(Word)
boundary, body = field_of(GroupName, False), field_of(GroupName, True)


def keyword(text: str, value: Any = None) -> Any:
    return custom(Keyword(text, kind_of(value)))


def option(
    text: str, value: Any = None, default: Any = None, needed: Condition = never, absent: Condition = never
) -> Any:
    """May be left out, and is `default` then; `value`: a field or a class with fields, nothing for a word alone."""
    return field(default=default, metadata={"kind": Keyword(text, kind_of(value), needed, absent)})


def choice(what: str, show: str, *words: str) -> Any:
    return custom(Choice(what, show, words))


def one_of(what: str, show: str, variants: Mapping[str, type[Part]], noun: str = "", allowed: Any = None) -> Any:
    return custom(OneOf(what, show, variants, False, noun, allowed))


def perhaps(show: str, variants: Mapping[str, type[Part]], default: Callable[[], Part | None] = lambda: None) -> Any:
    """As one_of, but it may be left out, and is what `default` makes then."""
    return field(default_factory=default, metadata={"kind": OneOf("", show, variants, True)})


def kind_of(value: Any) -> Kind | None:
    if isinstance(value, dataclasses.Field):
        return value.metadata["kind"]
    return None if value is None else PartOf(value)


def fields_of(cls: type[Part]) -> list[tuple[str, Kind]]:
    return [(f.name, f.metadata["kind"]) for f in dataclasses.fields(cls) if "kind" in f.metadata]  # type: ignore[arg-type]


def is_option(kind: Kind, where: Where) -> bool:
    return (isinstance(kind, Keyword) and not kind.needed(where)) or (isinstance(kind, OneOf) and kind.optional)


def starts(kind: Kind, reading: Reading) -> bool:
    """Whether the next word begins this option."""
    if isinstance(kind, OneOf):
        return kind.optional and reading.line.starts(*kind.classes(reading.where))
    return isinstance(kind, Keyword) and reading.line.starts(kind.word) and not kind.absent(reading.where)


def read_fields(cls: type[Part], reading: Reading) -> dict[str, Any]:
    """The values of a class's fields: those that must be there in order, then options in any order."""
    kinds = fields_of(cls)
    for there, why in cls.refused:
        if there(reading.where):
            reading.line.no(why.replace("FRICTION", reading.where.friction))
    values = {name: kind.read(reading) for name, kind in kinds if not is_option(kind, reading.where)}
    while found := [(name, kind) for name, kind in kinds if name not in values and starts(kind, reading)]:
        values[found[0][0]] = found[0][1].read(reading)
    return values


def usage_of_fields(cls: type[Part], where: Where, options: bool = True) -> str:
    texts = (kind.usage(where) for _, kind in fields_of(cls) if options or not is_option(kind, where))
    return " ".join(text for text in texts if text)


def usage(name: str, where: Where) -> str:
    """What may stand in a statement's line."""
    cls = STATEMENTS[name]
    text = cls.usage or f"{name} {usage_of_fields(cls, where)}".rstrip() + cls.note
    return shown(text, where)


def usage_of(name: str, where: Where) -> str:
    """The end of a refusal: what may stand there, with an example."""
    if name not in STATEMENTS:
        return "allowed: " + ", ".join(STATEMENTS)
    example = shown(STATEMENTS[name].example, where)
    return f"allowed: {usage(name, where)}" + (f", as {example}" if example else "")


def read_statement(line: Line, where: Where, groups: Groups, cls: type[Statement]) -> Statement:
    """The line as a statement of this class; refuses what is not allowed in it."""
    reading = Reading(line, where, groups, cls)
    made = cls(line=line.number, words=tuple(line.words), **read_fields(cls, reading))
    if line.left and not cls.rest:
        reading.stray()
    if wrong := made.check(where):
        line.no(wrong)
    return made
