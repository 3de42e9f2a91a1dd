"""The words of a case file: lines, quotes and numbers, and the refusal of a word that is not allowed.

A refusal names the file and the line, says what is wrong, and what is allowed. It is one line of text.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import NoReturn

LONGEST = 3000  # letters of a refusal: a terminal and a person take no more
NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
CONTROL = re.compile(r"[\x00-\x1f\x7f]")
BARE = re.compile(r'[^ \t\r#"]+')


class Refusal(Exception):
    """What is wrong with a case file, and what is allowed; `line` is 0 if it is wrong as a whole."""

    def __init__(self, what: str, line: int = 0) -> None:
        super().__init__(what)
        self.line = line

    def text(self, case: str) -> str:
        """The refusal as a run prints it; `case` is the file as the user named it."""
        what = CONTROL.sub(" ", (f"line {self.line}: " if self.line else "") + str(self))
        if len(what) > LONGEST:
            what = f"{what[:100]} ... {what[199 - LONGEST :]}"
        return f"-case {case}, {what}"


def quoted(name: str) -> str:
    """A name as a case file takes it: between quotes if it has blanks, or the sign of a comment."""
    return name if BARE.fullmatch(name) else f'"{name}"'


def spells_number(text: str) -> bool:
    """Whether a word is a number: digits, a point, an exponent; no nan, no inf, no 0x10."""
    return NUMBER.fullmatch(text) is not None


def whole_number(text: str) -> int:
    """What digits stand for; -1: no digits, or more than any number of a file has."""
    return int(text) if text.isdecimal() and len(text) < 16 else -1


def number_text(value: float) -> str:
    """A bound as people write it: 1000000, 0.5."""
    return str(int(value)) if value == int(value) else f"{value:g}"


def distance(a: str, b: str) -> int:
    """How many letters must be put in, left out, replaced or exchanged to make one word of the other."""
    rows = [list(range(len(b) + 1))]
    for i in range(1, len(a) + 1):
        rows.append([i])
        for j in range(1, len(b) + 1):
            steps = min(rows[i - 1][j] + 1, rows[i][j - 1] + 1, rows[i - 1][j - 1] + (a[i - 1] != b[j - 1]))
            if i > 1 and j > 1 and a[i - 1] == b[j - 2] and a[i - 2] == b[j - 1]:
                steps = min(steps, rows[i - 2][j - 2] + 1)
            rows[i].append(steps)
    return rows[-1][-1]


def nearest(word: str, known: Iterable[str]) -> str:
    """The known word that was probably meant, or nothing."""
    if len(word) > 40:
        return ""
    found, least = "", 2 + len(word) // 4
    for candidate in known:
        off = distance(word.lower(), candidate.lower())
        if off < least:
            found, least = candidate, off
    return found


def meant(word: str, known: Iterable[str]) -> str:
    """A question that begins a refusal: the word that was probably meant."""
    found = nearest(word, known)
    return f"did you mean {quoted(found)}? " if found else ""


@dataclass
class Line:
    """A line of a case file: its number and its words, and how many of them have been read."""

    number: int
    words: list[str] = field(default_factory=list)
    read: int = 1

    def no(self, what: str) -> NoReturn:
        """Refuses this line."""
        raise Refusal(what, self.number)

    @property
    def left(self) -> list[str]:
        """The words that have not been read."""
        return self.words[self.read :]

    def starts(self, *words: str) -> bool:
        """Whether the next word is one of these."""
        return bool(self.left) and self.left[0] in words

    def next(self) -> str:
        """The next word, which is read now."""
        self.read += 1
        return self.words[self.read - 1]

    @property
    def last(self) -> str:
        """The last word of the line."""
        return self.words[-1]


def split_line(number: int, text: str, usage: Callable[[str], str]) -> Line:
    """The words of a line: blanks are kept between quotes, # begins a comment; usage(word): what a statement takes."""
    line = Line(number)
    rest = text.lstrip(" \t\r")
    while rest and rest[0] != "#":
        if rest[0] == '"':
            word, quote, after = rest[1:].partition('"')
            if not quote:
                line.no(f'{rest}: a quote that does not end; allowed: "name"')
            if after and after[0] not in " \t\r#":
                line.no(f'"{word}"{after}: no blank after the quote; allowed: a blank between two words')
            if not word:
                line.no(f'"": an empty name; {usage(line.words[0] if line.words else "")}')
        else:
            found = BARE.match(rest)
            assert found is not None
            word, after = found[0], rest[found.end() :]
            if after.startswith('"'):
                line.no(f"{word}{after}: a quote inside a word; allowed: a blank between two words")
        if CONTROL.search(word):
            line.no(f"{word}: a control character; allowed: letters, digits and signs")
        line.words.append(word)
        rest = after.lstrip(" \t\r")
    return line


def split_case(text: str, usage: Callable[[str], str]) -> list[Line]:
    """All lines of a case file that have words."""
    lines = text.removeprefix("\ufeff").split("\n")
    return [line for k, text in enumerate(lines) if (line := split_line(k + 1, text, usage)).words]


def text_of(case: str) -> str:
    """A case file's text; bytes that are no letters are kept."""
    with open(case, encoding="utf-8", errors="surrogateescape", newline="\n") as file:
        return file.read()


def brief(value: float) -> str:
    """A number as people write it."""
    return str(int(value)) if value == int(value) and abs(value) < 2**31 else f"{value:.6g}"
