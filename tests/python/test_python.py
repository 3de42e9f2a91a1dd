"""The Python of postprocess/ and edp/input/: short functions, no private modules, no edited path of modules."""

import ast
import re
import tomllib
from functools import cache

import pytest
from freefem import ROOT

LINES = 60  # of a function, with its docstring
LONGER = {"edp/input/reader/near.py nearest": 70}  # to be split; none is added


@cache
def trees():
    """{path: its syntax tree} of all modules; what a notebook's cells are made of is no module."""
    files = [path for folder in ("postprocess", "edp/input") for path in (ROOT / folder).rglob("*.py")]
    names = [path.relative_to(ROOT).as_posix() for path in files if path.parent.name != "templates"]
    return {name: ast.parse((ROOT / name).read_text()) for name in names}


def test_length_of_functions():
    """No function shall be longer than a screen."""
    found = {
        f"{path} {node.name}": node.end_lineno - node.lineno + 1
        for path, tree in trees().items()
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef)
    }
    assert {name: lines for name, lines in found.items() if lines > LONGER.get(name, LINES)} == {}


def test_no_private_modules():
    """postprocess shall import no private module of another package."""
    names = [
        f"{path}: {name}"
        for path, tree in trees().items()
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom)
        for name in [getattr(node, "module", None) or "", *(alias.name for alias in node.names)]
        if re.search(r"(^|\.)_[a-z]", name) and not name.startswith("__")
    ]
    assert names == []


@pytest.mark.parametrize("folder", ["postprocess/**/*.py", "tests/pages.py"])
def test_path_of_modules_is_not_edited(folder):
    """Who starts a program says where its modules are: PYTHONPATH, or the settings of pytest."""
    assert [path for path in ROOT.glob(folder) if re.search(r"sys\.path\b(?!_)", path.read_text())] == []


def test_few_types_are_left_out():
    """mypy shall be told to overlook no line of postprocess, and few of the reader, each for one named fault."""
    texts = {path: (ROOT / path).read_text().splitlines() for path in trees()}
    lines = [f"{path}: {line}" for path, text in texts.items() for line in text if "type: ignore" in line]
    assert len(lines) <= 5 and all(line.startswith("edp/") and "type: ignore[" in line for line in lines), lines


def test_project():
    """pyproject.toml shall state the version of edp/VERSION and the packages of requirements.txt."""
    stated = tomllib.loads((ROOT / "pyproject.toml").read_text())
    assert stated["project"]["name"] == "stiff-contact" and stated["project"]["requires-python"] == ">=3.11"
    assert set(stated["project"]["dynamic"]) == {"version", "dependencies"}
    dynamic = stated["tool"]["setuptools"]["dynamic"]
    assert dynamic == {"version": {"file": "edp/VERSION"}, "dependencies": {"file": "requirements.txt"}}
