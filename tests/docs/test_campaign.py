"""What the campaigns compare with, their figures and tables, and the quick stability campaign."""

import json
import subprocess
import sys

import bench
import campaign
import conditioning
import covered
import models
import peers
import peers_condensed
import pictures
import pytest
import reference
import stability
import tables
from campaign import value
from freefem import cases_of
from text_boxes import faults

from postprocess import figures, style
from postprocess.campaign import read_campaign
from postprocess.command_line import main
from postprocess.reference_values import PAPER
from postprocess.results import ResultsError


def test_references():
    """Every problem that the peers solve shall have a reference; that of the paper's test shall be its numbers."""
    known = reference.values()
    rows = [{"flags": " ".join(item.flags), "scene": item.script} for item in peers.cases() if item.program]
    assert {peers.problem_of(row | {"kappa": 0, "m": 0}) for row in rows} <= set(known)
    for law, expected in PAPER.items():
        for quantity, rounded in expected.items():
            assert known["disc-on-block", *law][quantity] == pytest.approx(rounded, rel=5e-8), (law, quantity)


PLANE = peers.PEER, "-order 4 -h 1", 5e-6
HALF = peers_condensed.CONDENSED, "-order 4 -half 1", 5e-6
WHOLE = peers_condensed.CONDENSED, "-order 5 -corners 5", 5e-6


LONGER = (peers.BODIES, "-h 0.4", 2e-4), WHOLE


@pytest.mark.parametrize("script, flags, off", cases_of([PLANE, HALF], LONGER))
def test_peer(tmp_path, script, flags, off):
    """The other code shall give the references' forces; where it is not installed, say in a line how to get it."""
    python = peers.PYTHON if peers.PYTHON.exists() else sys.executable
    program = campaign.ROOT / "tests/campaigns" / script
    command = [python, program, *flags.split(), "-kappa", "1e3", "-out", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True)
    if subprocess.run([python, "-c", "import ngsolve"], capture_output=True).returncode:
        assert done.returncode == 1 and done.stderr.count("\n") == 1 and "make bench-peers" in done.stderr
        return
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["force"] == pytest.approx(reference.values()[summary["scene"], 1e3, 3.0]["force"], rel=off)
    if script == peers.PEER:
        assert reference.profile_error(1e3, 3, campaign.read_contact(tmp_path)) < 1e-3


# ---------------------------------------------------------------- the documentation's tables


def test_markers_of_the_tables():
    """Every marker of the results shall be a table that there is, opened and closed once; none shall be missing."""
    text = "".join(document.read_text() for document in tables.DOCUMENTS)
    names = [found.group(2) for found in tables.MARKED.finditer(text)]
    assert sorted(names) == sorted(tables.TABLES)
    assert text.count("<!-- table:") == text.count("<!-- end -->") == len(names)
    assert {csv for csv, _ in tables.TABLES.values()} == set(tables.LISTS)


# ---------------------------------------------------------------- figures

FIGURES = sorted(name for name, module in figures.modules().items() if hasattr(module, "READ"))


def made_up(item, columns, every):
    """A row such as the case might give; every so many cases one has failed."""
    dofs = 512 / float(item.parameters.get("h", 0.25)) ** 2
    row = dict.fromkeys(columns, "1") | {"p0": "0.02", "beta": "60", "T0": "0", "costRatio": "1.3"}
    row |= {name: text for name, text in item.parameters.items() if name in columns}
    row |= campaign.row_of(item, [campaign.Outcome(0, 1, 1, dofs / 500, "", {})]) | {k: v for k, v in row.items() if v}
    row |= {"name": item.name, "script": item.script, "flags": " ".join(item.flags), "memory": dofs / 500}
    row |= {"status": "timeout" if every == 0 else "converged", "ndof": dofs, "cpu": 1e-5 * dofs}
    row |= {"newton": 1 + len(row["flags"]) % 7, "seconds_assembly": 1e-5 * dofs}
    return row | {name: 0.1 / dofs for name in columns if name.endswith("Error")}


@pytest.fixture(scope="module")
def campaigns(tmp_path_factory):
    """Folders bench and stability with tables of the real lists of cases and made-up results."""
    folder = tmp_path_factory.mktemp("campaigns")
    lists = {f"bench/{name}": (cases(campaign.ROOT), columns) for name, (cases, columns, *_) in bench.PARTS.items()}
    lists["bench/peers"] = peers.cases(), peers.COLUMNS
    lists["bench/condensed"] = peers_condensed.cases(), peers.COLUMNS
    lists["coverage/coverage"] = covered.cases(), covered.COLUMNS
    lists["coverage/space"] = covered.cases_in_space(), covered.COLUMNS
    lists["stability/stability"] = stability.cases(), stability.COLUMNS
    lists["models/models"] = models.cases(), models.COLUMNS
    for name, (cases, further) in lists.items():
        columns = [*campaign.COLUMNS, *further]
        rows = [made_up(item, columns, place % 9) for place, item in enumerate(cases)]
        path = folder / f"{name}.csv"
        path.parent.mkdir(exist_ok=True)
        path.write_text("".join(campaign.csv_line(line) for line in [columns, *(row.values() for row in rows)]))
    path = folder / "conditioning/conditioning.csv"
    path.parent.mkdir()
    campaign.add_rows(path, conditioning.COLUMNS, conditions())
    return folder


def conditions():
    """Rows of the conditioning campaign, one of them without its steps."""
    for kappa in conditioning.KAPPAS:
        for m in (*conditioning.LINEAR, *conditioning.EXPONENTS):
            row = dict.fromkeys(conditioning.COLUMNS, "3") | {"kappa": f"{kappa:g}", "m": f"{m:g}", "h": "0.5"}
            row |= {"name": "linear" if m in conditioning.LINEAR else "power", "predicted": f"{2 * m + kappa**0.1:g}"}
            failed = (kappa, m) == (1e12, 20.0)
            yield row | ({"status": "not converged", "newton": ""} if failed else {"status": "converged"})


@pytest.mark.parametrize("name", FIGURES)
def test_figures(campaigns, tmp_path, name):
    """Each figure of a campaign shall be written as PDF and PNG, failed runs included."""
    out = tmp_path / f"{name}.pdf"
    assert main(["figure", name, "--out", str(out), str(campaigns / name.split("_")[0])]) == 0
    assert out.read_bytes().startswith(b"%PDF-") and out.with_suffix(".png").stat().st_size > 20000


@pytest.mark.parametrize("name", pictures.PICTURES)
def test_pictures_of_the_readme(name):
    """The README's pictures of campaigns shall be legible: no text on another one."""
    with style.look():
        drawn = pictures.PICTURES[name]()
        assert faults(drawn) == []


@pytest.mark.parametrize(
    "text, why",
    [("", "is empty"), ("a,b\n", "has no rows"), ("a,b\n1,2\n", "no c"), ("a,b,c\n1,2\n", "longer or shorter")],
)
def test_tables_that_are_refused(tmp_path, text, why):
    """A table that a figure cannot be drawn from shall be refused with its name and the reason."""
    (tmp_path / "t.csv").write_text(text)
    with pytest.raises(ResultsError, match=rf"t\.csv: .*{why}"):
        read_campaign(tmp_path).rows("t", "a b c")


# ---------------------------------------------------------------- the real runs


@pytest.mark.parametrize("part", ["a third", "whole"])
def test_the_quick_campaign(part, tmp_path):
    """The default method shall solve every case; on the paper's geometry in at most 4 linearisations."""
    cases = stability.quick()[:: 3 if part == "a third" else 1]
    quick = stability.run(tmp_path / "quick.csv", cases, jobs=2)
    assert [(row["flags"], row["status"], row["message"]) for row in quick if row["status"] != "converged"] == []
    assert all(value(row, "residual") <= 1e-8 for row in quick)
    grid = campaign.select(quick, name="grid")
    assert len(grid) >= 4
    for name, most in (("newton", 4), ("backsolves", 20), ("adaptations", 2), ("factorisations", 1)):
        assert [row["flags"] for row in grid if value(row, name) > most] == [], name
    for row in quick:
        assert value(row, "newton") <= 10 and value(row, "adaptations") <= 2, row["flags"]


COUNTS = {  # models / steps of kappa = 1e3, m = 3 and of 1e9, 20, at h = 1
    "plain Newton": ["1 / 8", "1 / 36"],
    "walls from T⁰ = 0": ["3 / 12", "2 / 10"],
    "walls from T⁰ = d0": ["2 / 9", "3 / 14"],
    "walls from T⁰ = d0, uniform": ["2 / 10", "2 / 11"],
    "tangents": ["3 / 8", "3 / 9"],
    "`xnewton`, no start": ["1 / 4", "1 / 4"],
    "`xnewton`": ["1 / 2", "1 / 2"],
}


def test_a_few_models(tmp_path):
    """Walls, tangents, plain Newton, xnewton: solved in these counts, to one force, no bound below the error."""
    rows = models.run(tmp_path / "few.csv", models.few(), jobs=2)
    assert models.faults(rows) == []
    found = {name: [f"{row['models']} / {row['newton']}" for row in rows if row["name"] == name] for name in COUNTS}
    assert found == COUNTS
    ratios = [value(row, "leastOverError") for row in rows if row["leastOverError"]]
    assert len(ratios) >= 4 and max(ratios) < 2


def test_models_of_one_load(tmp_path):
    """Of the runs of `make models` those of seven laws: none fails, and no count is above that of the page."""
    chosen = [item for item in models.cases() if (item.parameters["u0"], item.parameters["h"]) == ("2.5", "1")]
    laws = sorted({(item.parameters["kappa"], item.parameters["m"]) for item in chosen})[::4]
    chosen = [item for item in chosen if (item.parameters["kappa"], item.parameters["m"]) in laws]
    rows = models.run(tmp_path / "models.csv", chosen, jobs=2)
    assert len(rows) == 49 and models.faults(rows) == []
    told = [line.split(" | ") for line in models.table(rows).splitlines()[2:]]
    for line, expected in zip(told, pictures.cells("models")[1:], strict=True):
        found = [cell.strip("| ") for cell in line]
        assert found[0] == expected[0] and 0 < int(found[3]) <= int(expected[3])


def test_rows_are_runs(tmp_path, monkeypatch):
    """Cases on one mesh, solved by one run with rows, shall have the rows of their single runs, but for times."""
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")
    common = {"h": 2, "order": 1, "estimate": 0, "tol": 1e-8}
    cases = [campaign.case("a", kappa=kappa, **common, m=3.5) for kappa in (1e3, 1e30)]
    cases += [campaign.case("b", law="signorini", u0=-1.0, **common), campaign.case("b", kappa=-1.0, **common)]
    cases += [campaign.case("c", method="newton", kappa=1e6, **common)]
    assert [len(group) for group in campaign.groups(cases, lambda item: True)] == [4, 1]
    tables = [
        campaign.run(cases, tmp_path / f"{name}.csv", together=together)
        for name, together in (("alone", None), ("rows", lambda item: True))
    ]
    times = {*campaign.TIMES, "day"}
    for alone, row in zip(*tables, strict=True):
        assert {name: text for name, text in row.items() if name not in times} == {
            name: text for name, text in alone.items() if name not in times
        }
        assert float(row["cpu"]) < float(alone["cpu"]) if row["name"] != "c" and row["status"] == "converged" else True
