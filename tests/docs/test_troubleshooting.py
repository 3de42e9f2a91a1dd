"""edp/docs/TROUBLESHOOTING.md against the sources: every warning, refusal and failure is there, and no other."""

import dataclasses
import re

import pytest
from freefem import ROOT
from input import test_parts, test_reader
from input.test_reader import GOOD, STEEL
from physics import test_heat
from reader import Group, Refusal, Where, read_case
from reader.modules import Run, modules, needs

PAGE = (ROOT / "edp/docs/TROUBLESHOOTING.md").read_text()
KINDS = {  # heading of the page: the functions whose argument is the text
    "Warnings": r"warn|prependWarning|printWarning",
    "Refused flags and files": r"refuse",
    "Refused case files": r"input/reader",
    "Runs without convergence": r"fail",
}
LINES = "\n".join(f"line l{k} 0 0 1 1" for k in range(1000))
LITERAL = re.compile(r'"(?:[^"\\]|\\.)*"')


def argument(text, start):
    """The argument of a call whose parenthesis opens just before `start`."""
    depth, at = 1, start
    while depth:
        literal = LITERAL.match(text, at)
        depth += (text[at] == "(") - (text[at] == ")")
        at = literal.end() if literal else at + 1
    return text[start : at - 1]


def words(expression):
    """The texts of an expression, `…` for the values: of "-h " + h + ": too small" it is -h …: too small."""
    expression = re.sub(r'flagTextOf\("[^"]*"\)', "value", expression)
    said = ""
    for part in re.split(f"({LITERAL.pattern})", expression):
        said += (
            part[1:-1].replace('\\"', '"').replace("\\047", "'")
            if part[:1] == '"'
            else "…" * bool(part.strip(" +()\n"))
        )
    return re.sub("…+", "…", said)


def refusals():
    """What the reader says of the spoilt cases of other tests, and of a few more: without the file's name."""
    worn, legs = f"{GOOD}contact left right wear 1 friction 0.2\ncycles 9\n", f"{GOOD}pressure right 2\n"
    both = f"{worn}obstacle right plane 4 0 -1 0 wear 1 slide 2\nleg 2\nleg 2"
    pair = "body a E 1 nu 0\nbody b E 1 nu 0\n"
    cut = f"{GOOD}cut c block plane 1 1 1 0\npreload c 1\ngroup c near 0 0"
    dense = GOOD.replace("nu 0.3", "nu 0.3 density 2") + "gravity 1 -9\nweight block 0 1"
    moved = legs.replace("clamp bottom", "move bottom 0 1") + "leg 1\nforce left 0 1\nleg 1\nforce left 0 2"
    cases = [(GOOD + lines.replace(" / ", "\n"), {}) for lines, _ in test_reader.REFUSED]
    cases += [(f"state axisymmetric\n{GOOD}{line}", {}) for line, _ in test_reader.AXISYMMETRIC]
    cases += [(f"{legs}leg 4\nleg 4\n" + lines.replace(" / ", "\n"), {}) for lines, _ in test_reader.PHASES]
    cases += [(GOOD + line, where) for where, line, _ in test_reader.SCRIPTS]
    along_axes = [line.split(" | ")[0].replace(" / ", "\n") for line in test_reader.ALONG_AXES.strip().splitlines()]
    cases += [(GOOD + lines, {}) for lines in along_axes]
    cases += [(f"{legs}leg 1\nmove right 0 *\nleg 1\nmove right 1 1", {})]
    cases += [(case, {"friction": "", "wear": False, "plastic": False}) for case, _ in test_parts.REFUSED]
    cases += [
        (GOOD + line, {}) for line in ('clamp le"ft"', "clamp \x07", "about a.b 0 0", "contact left right law table")
    ]
    cases += [(text, {}) for text in (f"{legs}leg 1\npressure right 3", f"{worn}leg 2", both, dense, moved, cut)]
    cases += [(f"{legs}leg 1\nforce left 0 0 rigid", {}), (GOOD + "about p 0 0\n" * 1 + "stresses\n" + LINES, {})]
    cases += [(f"thickness 1\n{STEEL}", {"space": True}), (f"{STEEL}plastic block 1 1", {"space": True})]
    cases += [(f"{pair}clamp base", {"bodies": {7: "", 8: ""}}), ("body pin E 1 nu 0\nclamp base", {"bodies": {7: ""}})]
    cases += [(f"{pair}group a-b near 0 0\njoin a b tie", {"bodies": {7: "", 8: ""}})]
    for case, where in cases:
        alone = not where.get("bodies")
        groups = (
            test_parts.groups(where.get("space", False)) if alone else [Group(2, "a"), Group(2, "b")] * ("join" in case)
        )
        with pytest.raises(Refusal) as found:
            read_case(case, Where(**where), groups)
        yield re.sub(r"^-case a.case, (line \d+: )?", "", found.value.text("a.case"))
    for change in test_heat.CHANGES.values():
        case = test_heat.CASE
        for old, new in zip(change[::2], change[1::2], strict=True):
            case = case.replace(old, new)
        yield re.sub(r"^-case a.case, (line \d+: )?", "", test_heat.read(case))
    need = needs(read_case(test_heat.CASE, Where(), test_heat.GROUPS))
    for change, run in (({}, {"own": False}), ({"friction": True}, {}), ({"plastic": True}, {}), ({}, {"axis": True})):
        with pytest.raises(Refusal) as found:
            modules(dataclasses.replace(need, **change), Run(space=False, **run))
        yield str(found.value)


def messages(functions):
    """[(file, text)] of every call of the functions; of a variable the texts that its file assigns to it."""
    if functions == "input/reader":
        return [("input/reader", text) for text in refusals()]
    found = []
    for path in sorted(path for kind in ("idp", "edp", "awk") for path in ROOT.glob(f"edp/**/*.{kind}")):
        text = re.sub(r"^\s*(?://|#).*", "", path.read_text(), flags=re.M)
        for call in re.finditer(rf"(?<!func int )(?<!function )\b(?:{functions})\(", text):
            expression = argument(text, call.end())
            given = [expression]
            if re.fullmatch(r"\w+", expression):
                given = re.findall(rf"\b{expression} \+?= ([^;]*);", text)
            found += [(path.relative_to(ROOT / "edp").as_posix(), words(each)) for each in given]
    if functions == "refuse":  # a program writes those of words that are no flags
        program = "input/unknown-flag.awk"
        lines = re.findall(r'\btext = (".*)', (ROOT / "edp" / program).read_text())
        found += [(program, "…" + words(line)) for line in lines]
        program = "solver/rows/rows.sh"  # another starts the processes of rows
        lines = re.findall(r'\becho "(.*; allowed: .*)"', (ROOT / "edp" / program).read_text())
        found += [(program, re.sub(r"\$\{[^}]*\}", "…", line)) for line in lines]
    return [(file, text) for file, text in found if re.search(r"[a-z]{3}.* ", text.replace("…", ""))]  # not bare values


def patterns(heading):
    """The texts in the first cells of the tables below a heading of the page, as they are written there."""
    below = re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", PAGE, re.M | re.S)[1]
    cells = [re.split(r"(?<!\\)\|", line)[1] for line in below.splitlines() if line.startswith("| `")]
    return [text.replace("\\|", "|") for cell in cells for text in re.findall(r"`([^`]+)`", cell)]


def matches(pattern, text):
    """Whether a text begins as the page has it; `…` on the page stands for anything."""
    return re.match(".*".join(map(re.escape, pattern.split("…"))), text)


@pytest.mark.parametrize("heading", KINDS)
def test_every_message_is_on_the_page(heading):
    missing = [
        (file, text) for file, text in messages(KINDS[heading]) if not any(matches(p, text) for p in patterns(heading))
    ]
    assert not missing, "\n".join(f"{file}: {text}" for file, text in missing)


@pytest.mark.parametrize("heading", KINDS)
def test_the_page_has_no_other(heading):
    texts = [text for _, text in messages(KINDS[heading])]
    assert len(texts) > 20
    assert [p for p in patterns(heading) if not any(matches(p, text) for text in texts)] == []
    assert [p for p in patterns(heading) if sum(bool(matches(p, text)) for text in texts) > 12] == []  # says nothing


# advice behind a condition that rules the value out: another inner method, a law's own tangent, a method of its own
CONDITIONED = {
    "solver/newton/extended-newton.idp: -method xnewton",
    "solver/methods/ipopt.idp: -method xnewton",
    "solver/steps/update-loop.idp: -distance linear",
}
CONDITIONED |= {"solver/rigid-modes/drifting-bodies.idp: -distance linear"}


def test_no_advice_to_do_what_is_done():
    """What a message advises is not what a run has without flags: flagAdvice or a condition leaves that out."""
    modules = [(path, path.read_text()) for path in sorted(ROOT.glob("edp/**/*.idp"))]
    usual = dict(re.findall(r'wordFlag\("(-\w+)", (?:preferredWord\()?"(\w+)"', "\n".join(text for _, text in modules)))
    assert {"-preconditioner": "kernel", "-method": "xnewton", "-distance": "linear"}.items() <= usual.items()
    advised = {
        f"{path.relative_to(ROOT / 'edp').as_posix()}: {flag} {value}"
        for path, text in modules
        for flag, value in re.findall(r"\buse (-\w+) (\w+)", " ".join(LITERAL.findall(text)))
        if usual.get(flag) == value
    }
    assert advised <= CONDITIONED, advised - CONDITIONED


def test_words():
    """Texts are read as a run prints them, whatever stands between."""
    assert (
        words('"-h " + flagTextOf("-h") + ": " + (h > 1 ? "too large" : "too small")') == "-h …: …too large…too small"
    )
    assert argument('refuse("a) (" + f(2)); x', 7) == '"a) (" + f(2)'
    assert matches("-h …: larger than …", "-h 3: larger than the block; allowed: at most 2")
