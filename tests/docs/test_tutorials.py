"""The tutorials and the pages beside them: each command runs as it stands, and prints what the page shows."""

import re

import pytest
import screens

from docs.test_readme import is_rule, quoted


@pytest.mark.parametrize("page", screens.PAGES, ids=lambda page: page.stem)
def test_commands(page, tmp_path):
    """Commands of a page shall run as they stand, one after the other, and print its screens: `make numbers`."""
    for script, new in screens.outputs(page, screens.package(tmp_path / "package")):
        assert new is None or not screens.differing(script.shown, new), f"{script.text}{new}"


@pytest.mark.parametrize("page", screens.TUTORIALS, ids=lambda page: page.stem)
def test_lines_that_are_explained(page):
    """Lines that a table `line | meaning` explains shall stand in a screen of the page."""
    text = page.read_text()
    shown = "".join(script.shown or "" for script in screens.scripts(text))
    tables = re.findall(r"^\| line \| meaning \|\n((?:\|.*\n)+)", text, re.M)
    lines = [row for table in tables for row in table.splitlines() if not is_rule(row[1:-1].split("|"))]
    explained = [quoted(row)[0] for row in lines]
    spaced = " ".join(shown.split())
    assert explained and [line for line in explained if " ".join(line.split()) not in spaced] == []


def test_screens():
    """A screen shall be compared by its words, and by its numbers to two in a hundred; times and rounding aside."""
    assert screens.same("force 150.04 in 0.2 s", "force   150.1 in 0.9 s")
    assert not screens.same("force 150.04", "force 144.9")
    assert screens.same("moved 7e-10 1.5", "moved -2e-11 1.5") and not screens.same("force 3.5", "shear 3.5")
    assert screens.anew("...\nforce 1\n...\n", "head\nforce 2\nend\n") == "...\nforce 2\n...\n"
    with pytest.raises(SystemExit, match="nothing like this line"):
        screens.anew("...\nforce 1\n", "head\n")
