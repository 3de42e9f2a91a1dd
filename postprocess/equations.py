"""The pages' equations as MathML: lines as one writes them in a letter, κ (d − d0)^m = M (u0 − gap − d)/H.

`display(lines)` gives the MathML of an indented block, or nothing where it is no equation but code; `inline(text)` that
of a formula in slanted type within a line, or nothing where it is words. The product before
`/` is its numerator, the factor behind it its denominator; words of two letters and more are text, but for functions.
"""

import html
import re
import unicodedata

UPPER = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ᵀ", "0123456789+−T", strict=True))
LOWER = dict(zip("₀₁₂₃₄₅₆₇₈₉₊", "0123456789+", strict=True))
MARKS = {"\u0302": "^", "\u0304": "¯", "\u0307": "˙"}
MATHML = "http://www.w3.org/1998/Math/MathML"
FUNCTIONS = {"div", "tr", "cos", "sin", "ln", "max", "min", "diag", "inverse", "mod", "det", "exp"}
NAMES = {"gap"}  # quantities with names of more than a letter
CLOSING = {"(": ")", "[": "]", "|": "|", "‖": "‖"}
RELATIONS = set("=≤≥≈<>‖")
DIFFERENTIAL = re.compile("d[A-Za-zδ]")
TOKEN = re.compile(
    r"(?P<space> *)(?:(?P<number>\d+(?:\.\d+)?)|(?P<flag>(?<!\w)-[a-z]\w*)|(?P<file>\w+/\w+\.idp|\bP\d(?=:))"
    rf"|(?P<upper>[{''.join(UPPER)}]+)|(?P<lower>[{''.join(LOWER)}]+)"
    r"|(?P<word>dδ|(?:[A-Za-z]{2,}(?:-[a-z]+)*)(?:'s)?)|(?P<name>[^\W\d_][\u0300-\u036f]*)"
    r"|(?P<sign>.))"
)


class Unreadable(Exception):
    """A line that is no equation."""


Token = tuple[str | None, str, bool]  # kind (None behind the last one), characters, whether a space stands before


def tokens(text: str) -> list[Token]:
    """(kind, characters, whether a space stands before) of each piece."""
    return [
        (found.lastgroup, found[found.lastgroup or 0], bool(found["space"]))
        for found in TOKEN.finditer(unicodedata.normalize("NFD", text.strip()))
    ]


def tag(name: str, *inner: str, **attributes: str) -> str:
    """An element of MathML with its content and attributes."""
    written = "".join(f' {key}="{value}"' for key, value in attributes.items())
    return f"<{name}{written}>{''.join(inner)}</{name}>"


def letter(characters: str) -> str:
    """A letter, with the mark above it."""
    if len(characters) == 1:
        return tag("mi", characters)
    return tag("mover", tag("mi", characters[0]), tag("mo", MARKS[characters[1]]), accent="true")


def row(inner: list[str]) -> str:
    return inner[0] if len(inner) == 1 else tag("mrow", *inner)


class Line:
    """A reader of one piece of a line; `flat` writes quotients with a stroke, as in exponents."""

    def __init__(self, text: str) -> None:
        self.tokens = tokens(text)
        self.at = 0

    def peek(self, ahead: int = 0) -> Token:
        return self.tokens[self.at + ahead] if self.at + ahead < len(self.tokens) else (None, "", False)

    def take(self) -> Token:
        self.at += 1
        return self.tokens[self.at - 1]

    def sequence(self, end: str | None = None, flat: bool = False) -> list[str]:
        """Everything up to the closing bracket `end`, as MathML's elements."""
        out: list[str] = []
        product = 0  # product: where in `out` the factors of the present product begin
        while (token := self.peek())[1] != end or token[0] != "sign":
            if token[0] is None:
                if end:
                    raise Unreadable
                return out
            if token[:2] == ("sign", "/") and not flat and product < len(out):
                self.take()
                over = [self.bare(*out[product:])]
                out[product:] = [tag("mfrac", *over, self.bare(self.factor()))]
                continue
            if self.is_text():
                out.append(self.text(bool(out)))
                product = len(out)
                continue
            if token[0] == "sign" and token[1] not in CLOSING and token[1] not in "√∫Σ∇½∞…" and token[1] != "∂":
                self.take()
                out.append(tag("mo", html.escape(token[1]), **({"separator": "true"} if token[1] in ",:" else {})))
                product = len(out)
                continue
            out.append(self.factor(flat))
            if out[-1] in ("<mo>∫</mo>", "<mo>Σ</mo>"):
                product = len(out)
        if end:
            self.take()
        return out

    def is_text(self) -> bool:
        """Whether words begin here: of several letters, or a single one before or behind such."""
        kind, characters, _ = self.peek()
        if kind in ("flag", "file"):
            return True
        if kind == "word":
            return characters not in FUNCTIONS | NAMES and not DIFFERENTIAL.fullmatch(characters)
        following = self.peek(1)
        return (
            characters == "a"
            and following[0] == "word"
            and following[2]
            and following[1] not in FUNCTIONS | NAMES
            and len(following[1]) > 2
        )

    def text(self, behind: bool) -> str:
        words = []
        while self.peek()[0] is not None and self.is_text():
            words.append(self.take()[1])
        follows = self.peek()[2]
        return tag("mtext", ("\u00a0" if behind else "") + html.escape(" ".join(words)) + ("\u00a0" if follows else ""))

    def bare(self, *inner: str) -> str:
        """A numerator or denominator, without brackets around all of it."""
        if len(inner) == 1 and (
            found := re.fullmatch(r'<mrow class="group"><mo>\(</mo>(.*)<mo>\)</mo></mrow>', inner[0])
        ):
            return tag("mrow", found[1])
        return row(list(inner))

    def group(self, flat: bool) -> str:
        opening = self.take()[1]
        inner = self.sequence(CLOSING[opening], flat)
        return tag("mrow", tag("mo", opening), *inner, tag("mo", CLOSING[opening]), **{"class": "group"})

    def atom(self, flat: bool) -> str:
        kind, characters, _ = self.peek()
        if kind == "sign" and characters in CLOSING:
            return self.group(flat)
        self.take()
        if kind == "number":
            return tag("mn", characters)
        if kind == "word" and DIFFERENTIAL.fullmatch(characters):
            return row([tag("mi", "d"), tag("mi", characters[1])])
        if kind == "word":
            return tag("mi", characters)
        if kind == "name":
            return letter(characters)
        if (kind, characters) == ("sign", "√"):
            return tag("msqrt", self.bare(self.factor()))
        if kind == "sign" and characters in "∫Σ":
            return tag("mo", characters)
        if kind == "sign" and characters in "∇½∞…∂":
            return tag("mi" if characters in "∇∞∂" else "mn", characters)
        raise Unreadable

    def factor(self, flat: bool = False) -> str:
        """An atom with its indices, and the bracket that it is applied to."""
        kind, characters, _ = self.peek()
        base = self.atom(flat)
        applicable = kind == "name" or (kind == "word" and characters in FUNCTIONS)
        low: list[str] = []
        high: list[str] = []
        # d0, R1: the number is an index
        if kind == "name" and self.peek()[0] == "number" and not self.peek()[2]:
            low.append(tag("mn", self.take()[1]))
        while (token := self.peek())[0] is not None and not token[2]:
            if token[0] == "upper":
                high += [tag("mo" if c in "+−" else "mi" if c == "T" else "mn", c) for c in self.raised(self.take()[1])]
            elif token[0] == "lower":
                low.append(tag("mo" if token[1] == "₊" else "mn", "".join(LOWER[c] for c in self.take()[1])))
            elif token[:2] == ("sign", "*") and applicable:
                self.take()
                high.append(tag("mo", "*"))
            elif token[0] == "sign" and token[1] in "′'" and applicable:
                self.take()
                high.append(tag("mo", "′"))
            elif token[0] == "sign" and token[1] in "_^":
                self.take()
                (low if token[1] == "_" else high).append(self.script())
            else:
                break
        if low and high:
            base = tag("msubsup", base, row(low), row(high))
        elif low or high:
            base = tag("msub" if low else "msup", base, row(low or high))
        if applicable and self.peek()[:2] == ("sign", "(") and not self.peek()[2]:
            argument = self.group(flat)
            return tag("mrow", base, tag("mo", "\u2061"), argument)
        if kind == "word" and characters in FUNCTIONS and self.peek()[2]:
            gap = '<mspace width="0.2em"/>'
            return tag("mrow", gap if characters == "mod" else "", base, gap)
        return base

    @staticmethod
    def raised(characters: str) -> list[str]:
        """Characters above the line; figures together."""
        return re.findall(r"\d+|\D", "".join(UPPER[c] for c in characters))

    def script(self) -> str:
        if self.peek()[:2] == ("sign", "("):
            self.take()
            return row(self.sequence(")", flat=True))
        if self.peek()[:2] == ("sign", "−"):
            self.take()
            return row([tag("mo", "−"), self.script()])
        kind, characters, _ = self.take()
        if kind not in ("number", "word", "name") and characters not in "∞*":
            raise Unreadable
        if kind == "name" and self.peek()[0] == "number" and not self.peek()[2]:
            characters += self.take()[1]
        if kind == "word" and len(characters) == 2:
            return row([tag("mi", each) for each in characters])
        return tag("mn" if kind == "number" else "mo" if characters == "*" else "mi", characters)


def inline(text: str) -> str:
    """The MathML of a formula within a line, or "" where there are words in it: *p = κ s^m*, not *length*."""
    found = tokens(text)
    words = [characters for kind, characters, _ in found if kind in ("word", "flag", "file")]
    if not any(kind == "name" for kind, *_ in found) or any(
        characters not in FUNCTIONS | NAMES and not DIFFERENTIAL.fullmatch(characters) for characters in words
    ):
        return ""
    try:
        return tag("math", row(Line(text).sequence()), xmlns=MATHML)
    except Unreadable:
        return ""


def display(lines: list[str]) -> str:
    """The MathML of a block's lines, a `math` for each piece between wide gaps, or "" where they are no equation."""
    if not any(RELATIONS & set(text) for text in lines) or any(
        re.match(r"\[ |\w+: ?$", text.strip()) for text in lines
    ):
        return ""
    try:
        rows = [[row(Line(piece).sequence()) for piece in re.split(r" {2,}", text.strip())] for text in lines]
    except Unreadable:
        return ""
    pieces = [[tag("math", piece, displaystyle="true", xmlns=MATHML) for piece in each] for each in rows]
    return "".join(tag("div", *each, **{"class": "equation"}) for each in pieces)
