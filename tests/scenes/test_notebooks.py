"""The labs' notebooks are made of the labs' pages, and run from their first cell to their last."""

import csv
import io
import json
import os
import re
import sys
import types
from pathlib import Path

import pytest
from docs.test_readme import fences, section
from freefem import ROOT

from postprocess import notebook, teaching_kit
from postprocess.command_line import main
from postprocess.commands import check_lab
from scenes.test_labs import LABS, answers, package_in, readme


@pytest.fixture(scope="module")
def books(tmp_path_factory):
    """{lab: its notebook}, as `make notebooks` writes them."""
    folder = tmp_path_factory.mktemp("notebooks")
    assert main(["notebooks", "--out", str(folder)]) == 0
    return {path.stem.removeprefix("lab-"): json.loads(path.read_text()) for path in folder.glob("*.ipynb")}


def codes(book):
    return [cell["source"] for cell in book["cells"] if cell["cell_type"] == "code"]


@pytest.mark.parametrize("lab", LABS)
def test_parts(lab, books):
    """A notebook shall have each command of its lab's page once, each question with room for an answer, no answer."""
    book, page = books[lab], readme(lab)
    commands = [line for fence in fences(page, "sh") for line in fence.splitlines() if not line.startswith("#")]
    run = [found[1] for code in codes(book) if (found := re.search(r"^shell\(r'''(.*)'''\)$", code, re.M))]
    assert run == commands
    texts = [cell["source"] for cell in book["cells"] if cell["cell_type"] == "markdown"]
    asked = re.findall(r"^\d+\. ", section(page, "Questions"), re.M)
    assert texts.count(notebook.ANSWER) == len(asked) > 4
    assert not any("ANSWERS" in text for text in texts)
    assert not any(cell.get("outputs") or cell.get("execution_count") for cell in book["cells"])
    for code in codes(book):
        compile(code, lab, "exec")


def test_links():
    """Links and pictures shall lead from the notebook's folder to files that are there."""
    place = ROOT / "results/notebooks"
    for lab in teaching_kit.folders():
        cells = json.loads(notebook.made(lab, place))["cells"]
        text = "\n".join(cell["source"] for cell in cells if cell["cell_type"] == "markdown")
        links = [link for link in re.findall(r"\]\(([^)\s#]+)", text) if not link.startswith("http")]
        assert len(links) >= 1 and not [link for link in links if not Path(os.path.normpath(place / link)).exists()]


def test_cells_of_a_lab(tmp_path):
    """Further cells shall follow the section or the question that they name; one that is not there is an error."""
    lab = tmp_path / "edp/labs/9-new"
    lab.mkdir(parents=True)
    for name, text in {
        "README.md": "# Lab\n\n## Theory\n\na\n\n## Questions\n\nCore: 1.\n\n1. Why?\n2. When?\n",
        "ANSWERS.md": "| flags | a |\n|---|---|\n| `-h 1` | 2 |\n",
        "new.edp": "",
        "cells.py": "# %% Theory\nx = 1\n\n# %% 2\nx = 2\n",
    }.items():
        (lab / name).write_text(text)
    sources = [cell["source"] for cell in json.loads(notebook.made(lab, tmp_path))["cells"]]
    assert sources[3] == "x = 1" and sources[7:10] == ["2. When?", "x = 2", notebook.ANSWER]
    (lab / "cells.py").write_text("# %% 3\nx = 3\n")
    with pytest.raises(ValueError, match=r"no section or question 3"):
        notebook.made(lab, tmp_path)


def test_answers_of_a_notebook(books, tmp_path):
    """The expected values, written behind the commas of a notebook's table, shall be right; other values are not."""
    for lab in LABS:
        (table,) = re.findall(r"answers = r'''(.*?)'''", codes(books[lab])[-1], re.S)
        head, *rows = csv.reader(io.StringIO(table))
        known = {place: list(values) for place, values in check_lab.expected(answers(lab)).items()}
        filled = [[*row[:2], known[check_lab.key(row[0]), check_lab.key(row[1])].pop(0)] for row in rows]
        file = tmp_path / "answers.csv"
        for before in ("", "7"):
            with file.open("w", newline="") as out:
                csv.writer(out).writerows([head, *([*row[:2], before + row[2]] for row in filled[:4])])
            found = check_lab.check_answers(answers(lab), file)
            assert all(well for well, _ in found) == (before == ""), (lab, found)


def test_first_cell(books, tmp_path, monkeypatch, capsys):
    """`shell` shall run in the package, show the pictures that are new, and stop at an exit code that is an error."""
    shown = []
    display = types.SimpleNamespace(Image=lambda path, width: path, display=shown.append)
    monkeypatch.setitem(sys.modules, "IPython", types.ModuleType("IPython"))
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    monkeypatch.setenv("MPLBACKEND", "agg")
    for name in ("edp/main.edp", "results/old.png", "results/notebooks/lab.ipynb"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    monkeypatch.chdir(tmp_path / "results/notebooks")
    names = {}
    exec(codes(books["2-newton"])[0], names)
    assert names["script"] == "edp/labs/2-newton/newton.edp"
    names["shell"]("echo done; touch results/new.png; exit 20")
    names["shell"](".venv/bin/python -c 'print(6 * 7)'")
    assert [path.as_posix() for path in shown] == ["results/new.png"]
    assert capsys.readouterr().out == "done\nresults/new.png\n42\n"
    with pytest.raises(RuntimeError, match="code 10"):
        names["shell"]("exit 10")


@pytest.mark.parametrize("lab", LABS)
def test_runs(lab, tmp_path):
    """A notebook shall run in a folder of the package: no error, and its commands' pictures in it."""
    nbformat, nbclient = (pytest.importorskip(name) for name in ("nbformat", "nbclient"))
    pytest.importorskip("ipykernel")
    package = package_in(tmp_path)
    folder = package / "results/notebooks"
    assert main(["notebooks", "--out", str(folder)]) == 0
    book = nbformat.read(folder / f"lab-{lab}.ipynb", as_version=4)
    nbformat.validate(book)
    resources = {"metadata": {"path": str(folder)}}
    nbclient.NotebookClient(book, timeout=300, kernel_name="python3", resources=resources).execute()
    drawn = {line for cell in book.cells for out in cell.get("outputs", []) for line in out.get("text", "").split()}
    (figure,) = re.findall(r"^\*`(\w+\.png)` of these commands: ", readme(lab), re.M)
    assert any(Path(word).name == figure for word in drawn)
    assert "has no value" in book.cells[-1].outputs[0].text
    assert any("image/png" in out.get("data", {}) for cell in book.cells for out in cell.get("outputs", []))
