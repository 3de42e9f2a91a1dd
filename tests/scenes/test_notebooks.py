"""The labs' notebooks are made of the labs' pages, and run from their first cell to their last."""

import csv
import io
import json
import os
import re
import sys
import types
from pathlib import Path

import documents
import pytest
from docs.test_readme import section
from freefem import ROOT, cases_of, execute

from postprocess import lab_session, notebook, teaching_kit
from postprocess.command_line import main
from postprocess.commands import check_lab
from scenes.test_labs import LABS, answers, commands, package_in, readme


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
    calls = [re.sub(r"^#.*\n", "", code, flags=re.M) for code in codes(book)]
    called = [code for code in calls if re.match(r"(?:for \w+ in .*\n    )?(?:freefem|postprocess|gmsh)\(", code)]
    assert called == [notebook.call(line, f"exit code {code}" if code else "") for line, code in commands(lab)]
    assert not any("shell(" in code or "subprocess" in code for code in codes(book))
    assert any("plt.subplots" in code for code in codes(book))  # Python that reads results
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


def test_call():
    """A command of a page shall become a call with the same words; one of another program is an error."""
    assert notebook.call("FreeFem++ -nw a.edp -path '0 1'") == 'freefem("a.edp", "-path", "0 1")'
    loop = "for k in 1 2e3; do FreeFem++ a.edp -kappa $k -out r/x-$k; done"
    assert notebook.call(loop) == 'for k in ("1", "2e3"):\n    freefem("a.edp", "-kappa", k, "-out", f"r/x-{k}")'
    drawn = notebook.call(".venv/bin/python -m postprocess state r/one", "# exit code 20: stopped\n")
    assert drawn == 'postprocess("state", "r/one", codes=(20,))'
    assert notebook.call("gmsh -2 a.geo") == 'gmsh("-2", "a.geo")'
    with pytest.raises(ValueError, match="no call for the command sed"):
        notebook.call("sed s/a/b/ file")


def test_session(tmp_path, monkeypatch, capsys):
    """A session shall show new pictures, and stop at an exit code that is an error."""
    shown = []
    display = types.SimpleNamespace(Image=lambda path, width: path, display=shown.append)
    monkeypatch.setitem(sys.modules, "IPython", types.ModuleType("IPython"))
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    for name in ("edp/main.edp", "results/old.png", "results/notebooks/lab.ipynb"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    monkeypatch.chdir(tmp_path)
    assert lab_session.execute("sh", "-c", "echo done; exit 20", codes=(0, 20)) == "done\n"
    with pytest.raises(RuntimeError, match="exit code 10"):
        lab_session.execute("sh", "-c", "exit 10")
    (tmp_path / "table.csv").write_text("x,s'\n1,2\n")
    assert lab_session.columns("table.csv") == {"x": [1], "s'": [2]}
    typed = []
    monkeypatch.setattr(lab_session, "main", lambda words: typed.append(words) or Path("results/new.png").touch() or 0)
    lab_session.postprocess("state", "results/o*.png", 3)
    assert typed == [["state", "results/old.png", "3"]] and [path.name for path in shown] == ["new.png"]
    drawn = []
    monkeypatch.setitem(sys.modules, "ipywidgets", None)
    lab_session.explore(lambda kappa: drawn.append(kappa), kappa=[3, 1])
    widgets = types.SimpleNamespace(
        SelectionSlider=lambda options, **_: options, interact=lambda draw, kappa: drawn.append(kappa)
    )
    monkeypatch.setitem(sys.modules, "ipywidgets", widgets)
    lab_session.explore(lambda kappa: None, kappa=[3, 1])
    assert drawn == [3, [3, 1]]


@pytest.mark.parametrize("lab", cases_of(["1-law"], LABS))
def test_runs(lab, tmp_path):
    """A notebook shall run in a folder of the package, with outputs and figures, and become a page of the site."""
    for name in ("nbformat", "nbclient", "ipykernel"):
        pytest.importorskip(name)
    package = package_in(tmp_path)
    done = execute(
        [ROOT / ".venv/bin/python", *"-m postprocess notebooks --execute --out results/notebooks --lab".split(), lab],
        package,
    )
    assert done[0] == 0, done[1]
    book = json.loads((package / f"results/notebooks/lab-{lab}.ipynb").read_text())
    cells = [cell for cell in book["cells"] if cell["cell_type"] == "code"]
    outputs = [output for cell in cells for output in cell["outputs"]]
    text = "\n".join("".join(output.get("text", "")) for output in outputs)
    (figure,) = re.findall(r"^\*`(\w+\.png)` of these commands: ", readme(lab), re.M)
    assert f"/{figure}" in text and "has no value" in "".join(cells[-1]["outputs"][0]["text"])
    drawn = [output for output in outputs if "image/png" in output.get("data", {})]
    own = [cell for cell in cells if "plt.subplots" in "".join(cell["source"])]
    assert own and len(drawn) > len(own) - 1
    page = (package / f"results/notebooks/pages/lab-{lab}.md").read_text()
    assert page.count("](lab-") == len(drawn) == len(list((package / "results/notebooks/pages").glob("*.png")))
    links = [to for _, to in documents.LINK.findall(page) if not re.match(r"https?:|#", to)]
    assert links and [to for to in links if not (package / "results/notebooks/pages" / to).exists()] == []
