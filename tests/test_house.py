"""The house: arrows between files go one way, folder by folder; no cycles; what a scene reads stays small.

A file uses another one if a name stands in it that the other one alone declares at its top level: a function or a
variable. Macros are hooks, which a scene or an option fills in, and are left out; so are the scenes' own scripts.
"""

import re
from functools import cache
from graphlib import CycleError, TopologicalSorter

import pytest
from freefem import ROOT, execute
from pages import FOLDERS

EDP = ROOT / "edp"
ORDER = [folder for folder in FOLDERS if folder not in ("scenes", "labs")]  # each may use those before it
TYPE = r"(?:real|int|bool|string|mesh3?|meshS|meshL|matrix|fespace|complex)(?:\[[a-z, ]*\])*"
BARE = "edp/scenes/confined-block.edp"  # without its options
READ = {"edp/main.edp": (10600, 106), "edp/parts.edp": (17300, 134), BARE: (7000, 70)}  # lines, files


def code(text):
    """The text without comments, strings and the bodies of macros."""
    text = re.sub(r'"(\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"^[ \t]*macro [\s\S]*?//.*$", "", text, flags=re.M)
    return re.sub(r"//.*", "", text)


@cache
def modules():
    """Path below edp/ and code of each module."""
    return {
        path.relative_to(EDP).as_posix(): code(path.read_text())
        for path in EDP.rglob("*.idp")
        if "labs" not in path.parts
    }


def depths(text):
    """(line, depth of braces before it) of each line."""
    depth = 0
    for line in text.split("\n"):
        yield line, depth
        depth += line.count("{") - line.count("}")


@cache
def declared():
    """The names that each module declares at its top level."""
    found = {}
    for path, text in modules().items():
        names = found.setdefault(path, set())
        for line, depth in depths(text):
            function = re.match(rf"\s*func\s+{TYPE}\s+(\w+)\s*\(", line)
            variable = re.match(rf"\s*{TYPE}\s+(\w+)\s*(?:=|\(|;|,)", line)
            if depth == 0 and (function or (variable and not line.lstrip().startswith("return"))):
                names.add((function or variable)[1])
    return found


def local(text):
    """Names that are a module's own inside braces, or parameters."""
    names = set()
    for line, depth in depths(text):
        if depth > 0 or re.match(r"\s*func|\s+\w", line):
            names |= set(re.findall(rf"{TYPE}\s*&?\s*(\w+)", line))
            names |= set(re.findall(r"(?:varf|fespace|ofstream|ifstream)\s+(\w+)", line))
    return names


@cache
def arrows():
    """{file: {file that it uses: names}}."""
    owners = {}
    for path, names in declared().items():
        for name in names:
            owners.setdefault(name, []).append(path)
    found = {}
    for path, text in modules().items():
        own = declared()[path] | local(text)
        for name in set(re.findall(r"[A-Za-z]\w+", text)) - own:
            if len(owners.get(name, ())) == 1:
                found.setdefault(path, {}).setdefault(owners[name][0], set()).add(name)
    return found


def test_arrows_go_one_way():
    """No module shall use a name of a folder that comes later."""
    rank = {folder: place for place, folder in enumerate(ORDER)}
    wrong = [
        f"{path} uses {sorted(names)} of {other}"
        for path, uses in arrows().items()
        for other, names in uses.items()
        if rank[path.split("/")[0]] < rank[other.split("/")[0]]
    ]
    assert not wrong, "\n".join(wrong)


def test_no_cycle():
    """No file shall use another one that uses it, directly or over others."""
    try:
        TopologicalSorter({path: set(uses) for path, uses in arrows().items()}).prepare()
    except CycleError as error:
        pytest.fail(" uses ".join(error.args[1][::-1]))


def test_every_folder_has_its_place():
    assert {path.split("/")[0] for path in modules()} == set(ORDER)


def test_no_name_twice():
    """No file name shall stand twice, but in the registries of laws and methods, and in options."""
    names = {}
    for path in modules():
        if not path.startswith(("laws/", "solve/methods/", "options/")):
            names.setdefault(path.split("/")[-1], []).append(path)
    twice = {name: paths for name, paths in names.items() if len(paths) > 1}
    assert not twice


@pytest.mark.parametrize("script", READ)
def test_what_a_script_reads(script, tmp_path):
    """What a script reads shall not grow: FreeFEM echoes it; every file's first line says its name."""
    path = ROOT / script
    if script == BARE:
        for name in ("edp", "meshes", "freefem++.pref"):
            (tmp_path / name).symlink_to(ROOT / name)
        path = tmp_path / "bare.edp"
        path.write_text(re.sub(r"^macro eachOption.*\n", "", (ROOT / BARE).read_text(), flags=re.M))
    code, echo = execute(["FreeFem++", "-nw", "-v", "10", path, "-help"], path.parent if script == BARE else ROOT)
    assert code == 0
    heads = set(re.findall(r"// ([\w/-]+\.(?:idp|edp)): ", echo))
    files = [EDP / head for head in heads if (EDP / head).exists()]
    lines = sum(len(file.read_text().splitlines()) for file in files)
    assert lines <= READ[script][0] and len(files) <= READ[script][1], (lines, len(files))
