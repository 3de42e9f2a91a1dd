"""`postprocess sheet`: the page of one case stands by itself, says each number with its ±, and each doubt in words."""

import base64
import html.parser
import json
import os
import re
import shutil

import pytest
from browser import CHROMIUM, Browser
from freefem import FREEFEM, ROOT, execute, run
from page_numbers import number

from postprocess.command_line import main
from postprocess.commands.sheet import Units, vector
from postprocess.formatting import command, number_with_error, with_error
from postprocess.results import read_run

EXAMPLE = ROOT / "edp/examples/shrink-fit"
A4 = 794  # pixels across


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A run of the example in a folder of its own, with the example's files beside it."""
    folder = tmp_path_factory.mktemp("sheet")
    for name in ("shrink-fit.geo", "shrink-fit.case"):
        shutil.copy(EXAMPLE / name, folder)
    given = ["-mesh", folder / "shrink-fit.geo", "-case", folder / "shrink-fit.case", "-out", folder / "run"]
    code, stdout = execute([*FREEFEM, "edp/parts.edp", *map(str, given), "-set", "edges", "12"], cwd=ROOT)
    assert code == 0, stdout
    return folder


@pytest.fixture
def whole(made, tmp_path):
    """A copy of it, times of files included."""
    return shutil.copytree(made, tmp_path / "copy")


@pytest.fixture
def folder(whole):
    """A copy without solution.vtu, whose picture takes a second."""
    (whole / "run/solution.vtu").unlink()
    return whole


def edit(folder, **changes):
    path = folder / "run/summary.json"
    summary = json.loads(path.read_text())
    time = path.stat()
    path.write_text(json.dumps({**summary, **changes}))
    os.utime(path, ns=(time.st_atime_ns, time.st_mtime_ns))
    return summary


class Cells(html.parser.HTMLParser):
    """The tables of a page, {caption: rows of cells}; its words; its links."""

    def __init__(self, text):
        super().__init__()
        self.tables, self.words, self.links, self.inside = {}, [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.links += [value for name, value in attributes if name in ("src", "href")]
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        if tag == "table":
            self.rows = []
        self.inside.append(tag)

    def handle_endtag(self, tag):
        while self.inside and self.inside.pop() != tag:
            pass

    def handle_data(self, text):
        self.words.append(text)
        if "caption" in self.inside:
            self.tables[text] = self.rows
        elif self.inside[-1:] in (["td"], ["th"]):
            self.rows[-1][-1] += text


def sheet(folder, *words):
    assert main(["sheet", str(folder / "run"), *words]) == 0
    return Cells((folder / "run/sheet.html").read_text())


def of_cell(text):
    """(value, error) of a cell, without its unit."""
    value, _, error = re.sub(r" [A-Za-z/²]+$", "", text).partition(" ± ")
    return number(value), number(error)


def test_numbers_with_errors(folder):
    """Each number of a contact and of a body is that of the summary, and so is its ±."""
    summary = json.loads((folder / "run/summary.json").read_text())
    tables = sheet(folder).tables
    head, row = tables["Contacts"]
    assert row[0] == "seat journal" and row[-1] == "25 of 25"
    cells = dict(zip(head, row, strict=True))
    told = summary["estimates"]["contacts"][0]
    for name, key, unit in (
        ("normal force", "normalForce", "N/mm"),
        ("greatest pressure", "pressureMax", "MPa"),
        ("length", "contactLength", "mm"),
    ):
        value, error = of_cell(cells[f"{name}, {unit}"])
        assert error == pytest.approx(told[key]["error"], rel=0.05)
        assert value == pytest.approx(told[key]["value"], abs=0.06 * error)
    for row, body in zip(tables["Bodies"][1:], summary["stresses"], strict=True):
        value, error = of_cell(row[2])
        assert row[0] == body["body"] and error == pytest.approx(body["error"], rel=0.05)
        assert value == pytest.approx(body["vonMises"], abs=0.06 * error)
    assert tables["Bodies"][0][-1] == "yield stress, MPa"
    assert tables["Bodies"][2][-1] == "260" and tables["Bodies"][1][-1] == "–"


def test_loads_and_friction(folder):
    """Shear with the mesh's ±, loads with their displacement's, preloads, and the word on symmetries."""
    summary = json.loads((folder / "run/summary.json").read_text())
    (contact,) = summary["contacts"]
    contact |= {"shearForce": [3.0, -4.0], "stickShare": 0.25, "dissipated": 2, "mesh": {"shearForce": {"error": 0.5}}}
    way = {"name": "force grip", "way": {"value": 0.5, "error": 0.013}}
    edit(
        folder,
        contacts=[contact],
        prescribed=[{"name": "force grip", "force": 100, "times": 2}, {"name": "move top", "force": 7.5, "times": 1}],
        estimates={**summary["estimates"], "loads": [way]},
        preloads=[{"name": "cut", "preload": 20, "force": 21}],
    )
    found = sheet(folder)
    assert found.tables["Friction"] == [
        ["contact", "shear force, N/mm", "sticks on, %", "dissipated"],
        ["seat journal", "5.00 ± 0.50", "25", "2"],
    ]
    assert found.tables["Loads"] == [
        ["load", "force, N/mm", "displacement along it, mm"],
        ["force grip", "100", "0.500 ± 0.013"],
        ["move top", "7.5", "–"],
    ]
    assert found.tables["Preloads"] == [["cut", "tightened to, N/mm", "carries, N/mm"], ["cut", "20", "21"]]
    assert "within its planes of symmetry" in " ".join(found.words)


def test_stands_by_itself(whole):
    """Pictures are in the page, no link leads out; case file, command and versions are on it."""
    found = sheet(whole, "--title", "Ring <12>")
    text = " ".join(found.words)
    assert [link for link in found.links if not link.startswith(("data:", "#"))] == []
    assert sum(link.startswith("data:image/png") for link in found.links) == 1
    assert "Ring <12>" in text and "No warnings." in text and "plane stress" in text
    assert (whole / "shrink-fit.case").read_text().rstrip() in found.words
    summary = json.loads((whole / "run/summary.json").read_text())
    run_table = dict(found.tables["Run"][1:])
    for name, key in (("package", "package"), ("FreeFEM", "freefem"), ("gmsh", "gmsh"), ("run at", "date")):
        assert run_table[name] == summary[key]
    assert command(read_run(whole / "run")).startswith("FreeFem++ edp/parts.edp -mesh ")
    assert command(read_run(whole / "run")) in found.words


def test_doubts(folder):
    """Warnings, a run that has not converged, files that have changed or are gone: each is said at the top."""
    edit(folder, converged=False, message="no step helps", warnings=["the force is in doubt"], estimates=None)
    own = json.loads((folder / "run/summary.json").read_text())["parameters"]
    case, mesh = own["case"], own["mesh"]
    parameters = {**own, "case": str(folder / "shrink-fit.case"), "mesh": str(folder / "nowhere.geo")}
    edit(folder, parameters=parameters)
    time = (folder / "run/summary.json").stat().st_mtime + 60
    os.utime(folder / "shrink-fit.case", (time, time))
    text = " ".join(sheet(folder).words)
    for words in (
        "The run has not converged. Its numbers are no results. no step helps",
        "the force is in doubt",
        f"The case file {folder}/shrink-fit.case has changed since the run.",
        f"The geometry {folder}/nowhere.geo is not there any more.",
        "Errors are not known: estimates were left out.",
    ):
        assert words in text
    assert "No warnings." not in text and case != mesh


def test_without_a_picture(folder):
    """A run without solution.vtu has a sheet that says why there is no picture."""
    found = sheet(folder)
    assert not any(link.startswith("data:image/png") for link in found.links)
    assert any(word.startswith("No picture: ") for word in found.words)


def test_refusals(folder, tmp_path, capsys):
    """A scene's run has no sheet, and a sheet is an HTML file; nothing is written."""
    scene = run("confined-block", "-h", 5).folder
    out = tmp_path / "out.html"
    assert main(["sheet", str(scene), "--out", str(out)]) == 2
    assert "is not a run of a case; allowed: results of parts.edp and parts-3d.edp" in capsys.readouterr().err
    assert main(["sheet", str(folder / "run"), "--out", str(tmp_path / "out.pdf")]) == 2
    assert "the name of a sheet ends in .html" in capsys.readouterr().err
    assert not out.exists() and not (tmp_path / "out.pdf").exists()


@pytest.mark.parametrize(
    "value, error, text",
    [
        (3598.4988, 71.9, "3598 ± 72"),
        (-1.28202, 0.00508, "−1.2820 ± 0.0051"),
        (109809.3, 2512.0, "109800 ± 2500"),
        (0.1993, None, "0.1993"),
        (1.5e8, 2e6, "1.500e8 ± 2.0e6"),
        (2e-9, 3e-10, "2.00e-9 ± 3.0e-10"),
        (5.0, 0, "5"),
        (None, 1.0, "–"),
    ],
)
def test_written(value, error, text):
    assert with_error(value, error) == text


def test_units_and_vectors():
    """Newtons where the units make them; rounding beside a size is 0."""
    for state, units, force in (
        ("strain", ["mm", "MPa"], "N/mm"),
        ("axisymmetric", ["mm", "MPa"], "N"),
        ("space", ["m", "Pa"], "N"),
        ("stress", ["in", "psi"], "psi in"),
        ("space", ["in", "psi"], "psi in²"),
        ("space", None, ""),
    ):
        assert Units({"state": state, "units": units}).force == force
    assert vector([1e-12, -2.5]) == "0, −2.5"
    assert vector([1e-12, 2e-12], 1.0) == "0, 0"
    assert vector(None) == "–" and number_with_error(0.0, 0.5) == "0.00 ± 0.50"


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here")
def test_on_paper(whole, tmp_path):
    """In a browser: no complaint, nothing wider than A4, and one page when it is printed."""
    sheet(whole)
    with Browser(tmp_path / "profile") as browser:
        page = browser.open(whole / "run/sheet.html", A4, 1100)
        assert page.evaluate("document.documentElement.scrollWidth") <= A4
        assert page.evaluate("[...document.images].every(each => each.naturalWidth > 400)")
        assert page.messages == [] and len(page.requests) == 1
        printed = page.call("Page.printToPDF", paperWidth=8.27, paperHeight=11.69, printBackground=True)["data"]
    assert len(re.findall(rb"/Type\s*/Page\b", base64.b64decode(printed))) == 1
