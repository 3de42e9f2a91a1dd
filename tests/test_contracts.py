"""The heads of the modules against their code: what crosses files is in "Needs" of the one and "Gives" of the other.

Needs may name an identifier, or the module that gives it (`solve/problem.idp`), or a folder with two algorithms behind
one contract (`operator/`).
"""

import re
from functools import cache

import pytest
from freefem import ROOT

EDP = ROOT / "edp"
MODULES = sorted(str(path.relative_to(EDP)) for path in EDP.rglob("*.idp"))
SCRIPTS = sorted(str(path.relative_to(EDP)) for path in EDP.rglob("*.edp"))
TYPES = r"(?:int|real|string|bool|complex|matrix|mesh3?|meshS|meshL|varf|fespace|ifstream|ofstream)"
TYPES += r"(?:\s*<\w+>)?(?:\[[\w, ]*\])?"
KEYWORDS = set("if else for while return func macro include load break continue try catch new true false".split())
EXCEPTIONS = set()  # (module, identifier): why


@cache
def source(name):
    """Head and code of a source: the comment block that opens it, and the rest without comments and strings."""
    text = (EDP / name).read_text()
    head = re.match(r"(?://[^\n]*\n)+", text).group()
    code = re.sub(r'"(?:\\.|[^"\\])*"', '""', text)
    lines = []
    for line in code.split("\n"):
        # a macro ends at //: what stands behind it there is no comment of ours, and it holds none
        lines.append(line.split("//")[0])
    return head, "\n".join(lines)


def part(head, name):
    """The words of Needs or Gives in a head."""
    text = re.sub(r"^// ?", "", head, flags=re.M)
    found = re.search(rf"^{name}:(.*?)(?=^(?:Needs|Gives):|\Z)", text, flags=re.M | re.S)
    return found.group(1) if found else ""


def declarators(text):
    """The names that a declaration's list declares: `a = f(x), b(3)` gives a and b."""
    names, depth, start = [], 0, 0
    for position, char in enumerate(text + ","):
        depth += (char in "([{") - (char in ")]}")
        if char == "," and depth == 0:
            name = re.match(r"\s*&?\s*(\w+)", text[start:position])
            start = position + 1
            if name:
                names.append(name.group(1))
    return names


@cache
def declared(name):
    """(global names, local names) of a source; parameters, and what stands between braces, are local."""
    _, code = source(name)
    outside, inside, depth = set(), set(), 0
    for line in code.split("\n"):
        where = outside if depth == 0 else inside
        macro = re.match(r"\s*macro\s+(\w+)\s*\(([^)]*)\)", line)
        if macro:
            where.add(macro.group(1))
            inside.update(re.findall(r"\w+", macro.group(2)))
        function = re.match(rf"\s*func\s+{TYPES}\s+(\w+)\s*\(", line)
        if function:
            where.add(function.group(1))
        for field in re.finditer(r"^\s*func\s+(\w+)\s*=", line):
            where.add(field.group(1))
        for match in re.finditer(rf"(?:^|[\s;(,{{]){TYPES}\s*&?\s+&?\s*(?!\()(\w[^;]*)", line):
            before = line[: match.start()].strip()
            if before.startswith("func") or before.startswith("macro"):
                inside.update(re.findall(rf"{TYPES}\s*&?\s*(\w+)", line.split("(", 1)[1]))
            elif before.endswith("("):
                inside.update(declarators(match.group(1))[:1])
            elif "func" not in before:
                where.update(declarators(match.group(1)))
        if re.match(r"\s+(?:real|int|bool|string)", line) and "&" in line:  # parameters that go on in the next line
            inside.update(re.findall(rf"{TYPES}\s*&?\s*(\w+)", line))
        depth += line.count("{") - line.count("}")
    return frozenset(outside - KEYWORDS), frozenset(inside - KEYWORDS)


@cache
def owners():
    """identifier: the sources that declare it outside braces."""
    found = {}
    for name in MODULES + SCRIPTS:
        for word in declared(name)[0]:
            found.setdefault(word, set()).add(name)
    return found


def uses(name):
    """The identifiers of other files that a source uses."""
    _, code = source(name)
    outside, inside = declared(name)
    words = set(re.findall(r"(?<![\w.])[A-Za-z]\w*", code)) - outside - inside - KEYWORDS
    return {word for word in words if word in owners()}


def covers(needs, word):
    """Whether Needs names an identifier or one of the modules that give it."""
    if re.search(rf"\b{word}\b", needs):
        return True
    for owner in owners()[word]:
        folder = owner.split("/")[0] + "/"
        named = re.search(rf"(?<!\w){re.escape(owner)}", needs) or re.search(rf"(?<![\w/]){folder}(?!\w)", needs)
        if named and re.search(rf"\b{word}\b", part(source(owner)[0], "Gives")):
            return True
    return False


def test_the_code_is_read():
    """What this test takes for declarations and uses shall be what is meant."""
    outside, inside = declared("solve/problem.idp")
    assert {"sRest", "approach", "applyLoad", "setUpProblem"} <= outside
    assert {"fraction", "pGraph"} <= inside
    assert "graphPoint" in uses("solve/problem.idp")
    assert len(owners()) > 300


@pytest.mark.parametrize("name", [name for name in MODULES if not name.startswith("labs/")])
def test_needs(name):
    """What a module uses of other files shall be in its Needs."""
    needs = part(source(name)[0], "Needs")
    missing = {word for word in uses(name) if not covers(needs, word) and (name, word) not in EXCEPTIONS}
    missing -= {"moduleLoaded", "pluginLoaded"}  # every module says that it is there
    assert not missing, {word: owners()[word] for word in sorted(missing)}


@pytest.mark.parametrize("name", [name for name in MODULES if not name.startswith("labs/")])
def test_gives(name):
    """What other modules use of a module shall be in its Gives."""
    gives = part(source(name)[0], "Gives")
    used = {word for other in MODULES + SCRIPTS if other != name for word in uses(other) & declared(name)[0]}
    missing = {word for word in used if not re.search(rf"\b{word}\b", gives) and (name, word) not in EXCEPTIONS}
    missing -= {word for word in missing if len(owners()[word]) > 1}
    assert not missing, sorted(missing)


def test_few_exceptions():
    """The list of exceptions shall stay short."""
    assert len(EXCEPTIONS) <= 10
