"""The runner of the campaigns on a stand-in for FreeFEM, and the quick stability campaign on the real one."""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import time

import bench
import calculix
import campaign
import coverage
import numpy as np
import peers
import pictures
import pytest
import reference
import stability
import tables
from campaign import Case, case, read_rows, value
from text_boxes import faults, shown

from postprocess import figures, style
from postprocess.__main__ import main
from postprocess.campaign import read_campaign
from postprocess.references import PAPER
from postprocess.results import ResultsError

# Writes a summary as a run does; -code N ends with it, -sleep S takes that long first, -count FILE adds a line to it,
# -meet N waits until so many lines are there.
STAND_IN = """
import json, os, sys, time
flags = dict(zip(sys.argv[2::2], sys.argv[3::2]))
if "-count" in flags:
    with open(flags["-count"], "a") as file:
        file.write(sys.argv[1] + chr(10))
while "-meet" in flags and len(open(flags["-count"]).readlines()) < int(flags["-meet"]):
    time.sleep(0.01)
print("first line")
time.sleep(float(flags.get("-sleep", 0)))
code = int(flags.get("-code", 0))
if code in (0, 20):
    seconds = dict(mesh=0, assembly=1, factorisation=1, contact=2, total=4)
    summary = dict(scene="stand-in", converged=code == 0, message="why, in words", newton=3, adaptations=1)
    summary |= dict(costRatio=2.0, seconds=seconds, force=1.5, ndof=10, parameters=dict(kappa=1000, m=3, threads=7))
    with open(flags["-out"] + "/summary.json", "w") as file:
        json.dump(summary, file)
if code < 0:
    os.kill(os.getpid(), -code)
sys.exit(code)
"""


@pytest.fixture
def runner(tmp_path):
    """runner(cases, **options) runs a campaign of the stand-in into campaign.csv of the test's folder."""
    root = tmp_path / "package"
    (root / "edp").mkdir(parents=True)
    (root / "edp" / "main.edp").write_text("// a scene\nreal a = 1; // a comment\n")
    stand_in = tmp_path / "stand_in.py"
    stand_in.write_text(STAND_IN)

    def go(cases, **options):
        command = [sys.executable, str(stand_in)]
        return campaign.run(cases, tmp_path / "campaign.csv", root=root, freefem=command, **options)

    go.path, go.count, go.root = tmp_path / "campaign.csv", tmp_path / "count", root
    go.case = lambda *flags, **options: Case("part", "edp/main.edp", ("-count", str(go.count), *flags), **options)
    go.runs = lambda: len(go.count.read_text().splitlines()) if go.count.exists() else 0
    return go


def test_a_row_per_run(runner):
    """Each run shall be a row with its flags, how it ended, what the run tells and what was measured from outside."""
    rows = runner([runner.case("-kappa", "1000"), runner.case("-kappa", "2", "-code", "20")])
    assert [row["status"] for row in rows] == ["converged", "not converged"]
    assert [row["message"] for row in rows] == ["", "why, in words"]
    assert rows[0]["kappa"] == "1000" and rows[0]["newton"] == "3" and rows[0]["scene"] == "stand-in"
    assert value(rows[0], "cpu") == 4 and 0 < value(rows[0], "wall") < 20 and 1 < value(rows[0], "memory") < 1000
    assert rows[0]["threads"] == "1" and int(rows[0]["cores"]) >= 1 and rows[0]["machine"] and rows[0]["freefem"]
    assert np.isnan(value(rows[0], "backsolves"))


@pytest.mark.parametrize(
    "flags, timeout, status",
    [
        (["-code", "10"], 60, "refused"),
        (["-code", "8"], 60, "crash 8"),
        (["-code", "-11"], 60, "crash -11"),
        (["-sleep", "60"], 0.5, "timeout"),
    ],
)
def test_failures_stay_as_rows(runner, flags, timeout, status):
    """A run that is refused, crashes or takes too long shall be a row that says so, and the campaign shall go on."""
    begin = time.monotonic()
    rows = runner([runner.case(*flags, timeout=timeout), runner.case("-after", "1")])
    assert [row["status"] for row in rows] == [status, "converged"]
    assert time.monotonic() - begin < 55
    if status.startswith(("refused", "crash")):
        assert "first line" in rows[0]["message"] or rows[0]["message"] == ""


def test_repeats_give_medians(runner):
    """A timed case shall be run as often as asked; a failed one once."""
    rows = runner([runner.case("-a", "1", repeats=5)])
    assert rows[0]["repeats"] == "5" and runner.runs() == 5
    rows = runner([runner.case("-code", "20", repeats=5)])
    assert rows[0]["repeats"] == "1" and runner.runs() == 6


def test_started_again_it_runs_what_is_missing(runner):
    """Rows that are there shall not be run again; a comment changes no result, another source does."""
    first, second = runner.case("-a", "1"), runner.case("-a", "2")
    runner([first])
    assert runner.runs() == 1
    assert len(runner([first, second])) == 2 and runner.runs() == 2
    (runner.root / "edp" / "main.edp").write_text("// the same scene\n\nreal a  = 1;\n")
    runner([first, second])
    assert runner.runs() == 2
    (runner.root / "edp" / "main.edp").write_text("real a = 2;\n")
    assert len(runner([first, second])) == 2 and runner.runs() == 4


@pytest.mark.parametrize("cut", [1, 30, 200])
def test_a_row_that_was_cut_off_is_run_again(runner, cut):
    """A line that was being written when the machine stopped shall be dropped, and its case run again."""
    cases = [runner.case("-a", str(number)) for number in range(3)]
    runner(cases)
    whole = runner.path.read_bytes()
    runner.path.write_bytes(whole[:-cut])
    assert len(read_rows(runner.path)) == 2
    assert len(runner(cases)) == 3 and runner.runs() == 4
    with runner.path.open() as file:
        assert {len(line) for line in csv.reader(file)} == {len(campaign.COLUMNS)}


def test_a_case_given_twice_is_one_row(runner):
    """The same part, script and flags shall be run once."""
    assert len(runner([runner.case("-a", "1")] * 2)) == 1 and runner.runs() == 1


def test_several_at_a_time(runner):
    """With several jobs runs shall overlap in time, and the rows come in the order of the list."""
    rows = runner([runner.case("-sleep", "0.1", "-meet", "4", "-kappa", str(n)) for n in range(4)], jobs=4)
    assert [row["status"] for row in rows] == ["converged"] * 4, "each waits for the other three"
    assert [row["flags"].split()[-1] for row in rows] == ["0", "1", "2", "3"]


def test_further_columns(runner):
    """A campaign shall be able to measure a run's files; a column that was not announced is an error."""

    def measure(sources, processes):
        assert (sources / "edp" / "main.edp").exists() and (sources / "extra.csv").read_text() == "x"
        return lambda item, summary, folder: {"twice": 2 * summary["force"]}

    rows = runner([runner.case("-a", "1")], columns=["twice"], measure=measure, files={"extra.csv": "x"})
    assert rows[0]["twice"] == "3.0"
    with pytest.raises(ValueError, match="no column for twice"):
        runner([runner.case("-a", "2")], measure=measure, files={"extra.csv": "x"})


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_interrupted_it_leaves_a_valid_table(runner, tmp_path, how):
    """Interrupted, a campaign shall end its runs, keep the rows that it has, and leave none half written."""
    script = f"""
import signal
import sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background is started with it ignored
sys.path.insert(0, {str(campaign.ROOT / "tests" / "campaigns")!r})
import campaign
import coverage
from pathlib import Path
cases = [campaign.Case("part", "edp/main.edp", ("-sleep", seconds, "-count", {str(runner.count)!r}))
         for seconds in ("0", "50")]
try:
    campaign.run(cases, Path({str(runner.path)!r}), root=Path({str(runner.root)!r}),
                 freefem=[sys.executable, {str(tmp_path / "stand_in.py")!r}])
except KeyboardInterrupt:
    sys.exit(130)
"""
    process = subprocess.Popen([sys.executable, "-c", script], stderr=subprocess.DEVNULL, start_new_session=True)
    deadline = time.monotonic() + 30
    while runner.runs() < 2 and time.monotonic() < deadline:
        time.sleep(0.05)
    os.kill(process.pid, how)
    assert process.wait(timeout=100) == 130
    assert [row["flags"].split()[1] for row in read_rows(runner.path)] == ["0"]
    assert not list(tmp_path.glob(".campaign*"))


def test_the_time_left(capsys):
    """Progress shall tell runs done, all runs, the time left and the failures."""
    progress = campaign.Progress("title", total=4.0, count=2, stream=sys.stderr)
    progress.step(1.0, good=False)
    progress.begin -= 10
    line = progress.line(progress.begin + 10)
    assert "1/2" in line and "0:30 left" in line and "1 not converged" in line and line.count("#") == 7
    assert campaign.clock(3661) == "1:01:01"


def test_cases_are_flags_of_the_scenes():
    """A case shall name the scene's script and give numbers exactly."""
    item = case("part", scene="wavy", kappa=1e30, u0=stability.LOADS["overlap 1e-12 of the size"], h=0.1, T0="d0")
    assert item.script == "edp/scenes/wavy.edp"
    assert item.parameters == {"kappa": "1e+30", "u0": repr(0.25 + 4e-11), "h": "0.1", "T0": "d0"}
    assert case("part", method="ipopt").script == "edp/scenes/disc-on-block-ipopt.edp"


def test_the_campaigns_are_large_enough():
    """The stability map shall have at least 600 runs, each once; every part of the benchmark shall have some."""
    cases = stability.cases()
    assert len(cases) >= 600 and len({item.key for item in cases}) >= 0.99 * len(cases)
    assert {item.parameters["method"] for item in cases} >= {"xnewton", "paper", "newton", "linesearch", "incremental"}
    for parts, *_ in bench.PARTS.values():
        assert len(parts(campaign.ROOT)) >= 12
    runs = peers.cases()
    assert len({item.key for item in runs}) == len(runs) > 300


def test_errors_of_the_benchmark():
    """The fitted exponent shall be exact for a power."""
    sizes = np.array([1e4, 1e5, 1e6])
    assert bench.exponent(sizes, 3e-5 * sizes**1.2) == pytest.approx(1.2)


LAWS = sorted((kappa, m) for scene, kappa, m in reference.values() if scene == "disc-on-block")


def test_references():
    """Every problem that the peers solve shall have a reference whose two solutions share the digits that it is for."""
    with (reference.DATA / "references.csv").open() as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        allowed = 1e-9 if row["scene"] == "disc-on-block" else 1e-3 if row["quantity"] == "contactRadius" else 5e-5
        assert float(row["value"]) > 0 and float(row["difference"]) <= allowed and row["code"], row
    known = reference.values()
    rows = [{"flags": " ".join(item.flags), "scene": item.script} for item in peers.cases() if item.program]
    assert {peers.problem_of(row | {"kappa": 0, "m": 0}) for row in rows} <= set(known)
    for law, expected in PAPER.items():
        for quantity, rounded in expected.items():
            assert known["disc-on-block", *law][quantity] == pytest.approx(rounded, rel=5e-8), (law, quantity)


@pytest.mark.parametrize("kappa, m", LAWS)
def test_profiles_of_the_references(kappa, m):
    """A profile shall have the force, greatest pressure and half-width of its reference, between its nodes too."""
    known = reference.values()["disc-on-block", kappa, m]
    pieces = reference.profile(kappa, m)
    assert pieces[0][-1, -1] == pytest.approx(known["halfWidth"], rel=1e-11)
    assert pieces[1].max() == pytest.approx(known["pressureMax"], rel=1e-10)
    nodes, weights = np.polynomial.legendre.leggauss(20)
    low, high = pieces[0][:, :1], pieces[0][:, -1:]
    at = 0.5 * (low + high) + 0.5 * (high - low) * nodes
    force = np.sum((high - low) * weights * reference.expected_pressure(pieces, -at.ravel()).reshape(at.shape))
    assert force == pytest.approx(known["force"], rel=2e-8)
    assert reference.expected_pressure(pieces, np.array([1.001 * known["halfWidth"], 9.0])).tolist() == [0, 0]


def test_profile_error():
    """The profile itself shall have no error, one that is a tenth too large a tenth; without a file there is none."""
    x, p = (part.ravel() for part in reference.profile(1e9, 3))
    contact = {"x": x, "pressure": 1.1 * p, "weight": np.linspace(1, 2, len(x))}
    assert reference.profile_error(1e9, 3, contact | {"pressure": p}) < 1e-12
    assert reference.profile_error(1e9, 3, contact) == pytest.approx(0.1)
    assert reference.profile_error(1e7, 3, contact) is None


def test_peers_alternate():
    """Each code's runs shall be spread over the other's, and every round have all of them."""
    runs = peers.cases()
    rounds = {item.name for item in runs}
    assert len(rounds) == peers.ROUNDS
    keys = [[item.key[1:] for item in runs if item.name == name] for name in sorted(rounds)]
    assert all(part == keys[0] for part in keys)
    ours = [not item.program for item in runs[:6]]
    assert 0 < sum(ours) < len(ours) and ours != sorted(ours) and ours != sorted(ours, reverse=True)
    scripts = (peers.PEER, peers.BODIES)
    assert all(item.program == ((str(peers.PYTHON),) if item.script in scripts else ()) for item in runs)
    wanted = {item.parameters[name] for item in runs for name in ("mesh", "case") if item.script == "edp/parts.edp"}
    assert wanted <= set(peers.added_files())  # what the pin's runs read


def peer_row(seconds, error, script="edp/main.edp", flags="-h 1", **cells):
    flags += " -order 2"
    common = {
        "script": script,
        "flags": flags,
        "scene": "disc-on-block",
        "kappa": "1000",
        "m": "3",
        "order": "2",
        "h": "1",
    }
    common |= {"status": "converged", "message": "", "ndof": "10", "newton": "3", "kernelNewton": "4"}
    common |= {"seconds_assembly": str(seconds), "seconds_factorisation": "0", "seconds_contact": "0"}
    return (
        common
        | {"seconds_mesh": "0.5", "forceError": str(error), "secondsBefore": "", **dict.fromkeys(peers.OTHERS, "")}
        | cells
    )


def test_report_of_the_peers():
    """The table shall take medians over the rounds, the cheapest run that is close enough, and name what failed."""
    rows = [peer_row(seconds, 5e-5) for seconds in (1, 2, 9)]
    rows += [peer_row(0.5, 5e-4, flags="-h 2"), peer_row(0.1, 1e-9, peers.PEER, "-h 3")]
    rows += [peer_row(0.01, 1e-9, peers.PEER, "-h 4", status="not converged", message="stood still", kappa="1000.0")]
    lines = peers.report(rows).splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:9]]
    assert [row[1:] for row in (cells[0], cells[2])] == [
        ["2e-3", "0.500 (0.50), 10, 3: P2, h = 1", "0.100 (0.50), 10, 7: P2, h = 1"],
        ["1e-4", "2.000 (0.50), 10, 3: P2, h = 1", "0.100 (0.50), 10, 7: P2, h = 1"],
    ]
    assert cells[3][2] == "-"
    assert lines[-1] == "| 1e3, 3 | least error 5e-05 | least error 1e-09; not converged: P2 h = 4 |"
    last = peers.table(rows).splitlines()[-1]
    fine = " | – / 0.1 P2" * 4
    assert last == f"| 1e3, 3 | 0.5 P2 / 0.1 P2 | 0.5 P2 / 0.1 P2 | 2 P2 / 0.1 P2{fine} |"
    pin = [row | {"flags": "-case pin-1000-3.case -mesh pin-0.8.geo -order 2", "scene": "parts"} for row in rows[:1]]
    last = peers.table(pin).splitlines()[-1]
    assert last.startswith("| pin, 1e3, 3 |") and last.endswith("|  |  |")  # finer than the reference itself: nothing


def test_a_run_that_needs_another_is_charged_with_it():
    """Seconds of a run with `-ends` shall include those of the coarse run before it."""
    rows = [peer_row(0.2, 1e-6), peer_row(0.1, 1e-6, flags="-h 1 -ends 4", secondsBefore="0.15")]
    assert "0.2 P2 /" in peers.table(rows)
    assert "0.15 P2, `-ends` /" in peers.table([rows[0], rows[1] | {"secondsBefore": "0.05"}])


def test_peers_without_the_other_code(monkeypatch, tmp_path, capsys):
    """Without NGSolve the campaign shall say in a line how to get it, and write nothing."""
    monkeypatch.setattr(peers, "PYTHON", tmp_path / "python")
    with pytest.raises(SystemExit) as stopped:
        peers.main(["--out", str(tmp_path / "bench")])
    assert stopped.value.code == 1 and not (tmp_path / "bench").exists()
    (line,) = capsys.readouterr().err.splitlines()
    assert "make bench-peers" in line


@pytest.mark.parametrize("script, flags, off", [(peers.PEER, "-order 4 -h 1", 5e-6), (peers.BODIES, "-h 0.4", 2e-4)])
def test_peer(tmp_path, script, flags, off):
    """The other code shall give the references' forces; where it is not installed, say in a line how to get it."""
    python = peers.PYTHON if peers.PYTHON.exists() else sys.executable
    command = [
        python,
        campaign.ROOT / "tests" / "campaigns" / script,
        *flags.split(),
        "-kappa",
        "1e3",
        "-out",
        tmp_path,
    ]
    done = subprocess.run(command, capture_output=True, text=True)
    if subprocess.run([python, "-c", "import ngsolve"], capture_output=True).returncode:
        assert done.returncode == 1 and done.stderr.count("\n") == 1 and "make bench-peers" in done.stderr
        return
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["force"] == pytest.approx(reference.values()[summary["scene"], 1e3, 3.0]["force"], rel=off)
    if script == peers.PEER:
        assert reference.profile_error(1e3, 3, campaign.read_contact(tmp_path)) < 1e-3


def test_a_mesh_for_calculix(tmp_path):
    """CalculiX's input in space shall have its own order of a tetrahedron's nodes and its faces' numbers."""
    place = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    edges = [(0, 1), (1, 2), (2, 0), (0, 3), (2, 3), (1, 3)]  # gmsh's
    place = np.vstack([place, [place[list(pair)].mean(axis=0) for pair in edges]])
    sides = {"flat": np.array([[0, 1, 2, 4, 5, 6]]), "round": np.array([[1, 3, 2, 9, 8, 5]])}
    calculix.deck_in_space(tmp_path / "a.inp", place, sides, {"body": np.arange(10)[None]}, 1e4)
    lines = (tmp_path / "a.inp").read_text().splitlines()
    assert lines[lines.index("*ELEMENT,TYPE=C3D10,ELSET=ALL") + 1] == "1,1,2,3,4,5,6,7,8,10,9"
    assert [lines[lines.index(f"*SURFACE,NAME=S{name},TYPE=ELEMENT") + 1] for name in sides] == ["1,S1", "1,S3"]


def test_markdown():
    """A table shall have a header, a rule and a line a row."""
    assert list(map(campaign.decade, (1e-2, 1.0, 1e12))) == ["1e-2", "1", "1e12"]
    assert list(map(campaign.signed, (-1.46e-3, 0.02))) == ["−1.5e-3", "2.0e-2"]
    assert campaign.markdown(["a", "b"], [[1, 2]]) == "| a | b |\n| --- | --- |\n| 1 | 2 |"


def row_of(**cells):
    """A converged row of the stability map, its other cells empty."""
    names = [*campaign.COLUMNS, *stability.COLUMNS]
    common = {"status": "converged", "method": "xnewton", "law": "power", "kappa": "1000", "m": "3"}
    return dict.fromkeys(names, "") | common | {"force": "1", "pressureMax": "1", "energy": "1"} | cells


@pytest.mark.parametrize(
    "cells, failed",
    [
        ({"name": "two-spheres", "newton": "5", "backsolves": "35", "masterForce": "1"}, 0),
        ({"name": "two-spheres", "newton": "6", "backsolves": "36", "masterForce": "1.00000000001"}, 3),
        ({"name": "two-spheres", "newton": "6", "backsolves": "36", "kappa": "1e+30"}, 0),
        ({"name": "rough", "newton": "11"}, 1),
        ({"name": "exact distance", "newton": "25", "rounds": "6"}, 0),
        ({"name": "exact distance", "newton": "26", "rounds": "7"}, 2),
    ],
)
def test_checks_find_a_count_above_its_limit(cells, failed):
    """Counts above their limits and unequal forces on the two bodies shall not pass."""
    assert sum(not entry["passed"] for entry in stability.checks([row_of(**cells)])) == failed


def test_energy_with_a_prescribed_force():
    """With a prescribed force the energy that is compared shall include the force's work."""
    mine = row_of(name="prescribed force", flags="-force 2", force="2", approach="1.5", energy="3")
    newton = row_of(name="rival", flags="-force 2", force="2", approach="1", energy="2", method="newton")
    (entry,) = [entry for entry in stability.checks([mine, newton]) if entry["check"] == "energy"]
    assert entry["found"] == entry["expected"] == 0 and entry["passed"]


def test_parts_of_the_stability_map(capsys):
    """A part that there is not shall be refused with its name."""
    with pytest.raises(SystemExit):
        stability.main(["nowhere"])
    assert "no such part: nowhere" in capsys.readouterr().err


# ---------------------------------------------------------------- the documentation's tables

TEXT = "before\n<!-- table: {} -->\nold\n<!-- end -->\nbetween\n<!-- table: peers -->\nkept\n<!-- end -->\nafter\n"


def test_markers_of_the_tables():
    """Every marker of the results shall be a table that there is, opened and closed once; none shall be missing."""
    text = "".join(document.read_text() for document in tables.DOCUMENTS)
    names = [found.group(2) for found in tables.MARKED.finditer(text)]
    assert sorted(names) == sorted(tables.TABLES)
    assert text.count("<!-- table:") == text.count("<!-- end -->") == len(names)
    assert {csv for csv, _ in tables.TABLES.values()} == set(tables.LISTS)


def test_only_what_is_between_markers_is_written():
    """The writer shall change what stands between a table's markers, nothing else; an unknown table is refused."""
    new = tables.written(TEXT.format("growth"), {"growth": "| a |\n", "cost": "| b |"})
    assert new == TEXT.format("growth").replace("old", "| a |")
    assert tables.written(new, {"growth": "| a |\n"}) == new
    with pytest.raises(ValueError, match=r"no such table: nowhere; there are: .*growth"):
        tables.written(TEXT.format("nowhere"), {})


@pytest.mark.filterwarnings("ignore:divide by zero")  # made-up results
def test_tables_are_written(campaigns, tmp_path, capsys):
    """From whole tables all shall be written, alike whatever the order of rows; from a part only when that is asked."""
    document, results = tmp_path / "RESULTS.md", tmp_path / "results"
    kept = tables.MARKED.sub(r"\1\4", "".join(document.read_text() for document in tables.DOCUMENTS))
    document.write_text(kept)
    options = ["--document", str(document), "--results"]
    assert tables.main([*options, str(campaigns)]) == 0
    assert f"{len(tables.TABLES)} of {len(tables.TABLES)} tables" in capsys.readouterr().out
    text = document.read_text()
    assert tables.MARKED.sub(r"\1\4", text) == kept
    for found in tables.MARKED.finditer(text):
        heads = [line.count("|") for line in found.group(3).splitlines() if line.startswith("|")]
        assert len(heads) > 2 and len(set(heads)) == 1 and " runs, " in found.group(3), found.group(2)
    shutil.copytree(campaigns, results)
    for path in results.glob("*/*.csv"):
        head, *lines = path.read_text().splitlines(keepends=True)
        path.write_text("".join([head, *reversed(lines)]))
    assert tables.main([*options, str(results)]) == 0 and document.read_text() == text
    lines = (results / "bench" / "growth.csv").read_text().splitlines(keepends=True)
    (results / "bench" / "growth.csv").write_text("".join(lines[:-1]))
    document.write_text(kept)
    assert tables.main([*options, str(results)]) == 0
    assert "growth.csv" in capsys.readouterr().err and "<!-- table: growth -->\n<!-- end -->" in document.read_text()
    assert tables.main([*options, str(results), "--partial"]) == 0
    assert f" of {len(lines) - 1} runs" in document.read_text()


# ---------------------------------------------------------------- figures

FIGURES = sorted(name for name, module in figures.modules().items() if hasattr(module, "READ"))


def made_up(item, columns, every):
    """A row such as the case might give; every so many cases one has failed."""
    dofs = 512 / float(item.parameters.get("h", 0.25)) ** 2
    row = dict.fromkeys(columns, "1") | {
        "p0": "0.02",
        "beta": "60",
        "T0": "0",
        "costRatio": "1.3",
        "memory": dofs / 500,
    }
    row |= {name: text for name, text in item.parameters.items() if name in columns}
    row |= {
        "name": item.name,
        "script": item.script,
        "flags": " ".join(item.flags),
        "scene": campaign.row_of(item, [campaign.Outcome(0, 1, 1, "", {})])["scene"],
    }
    row |= {"status": "timeout" if every == 0 else "converged", "ndof": dofs, "cpu": 1e-5 * dofs}
    row |= {"newton": 1 + len(row["flags"]) % 7, "seconds_assembly": 1e-5 * dofs}
    return row | {name: 0.1 / dofs for name in columns if name.endswith("Error")}


@pytest.fixture(scope="module")
def campaigns(tmp_path_factory):
    """Folders bench and stability with tables of the real lists of cases and made-up results."""
    folder = tmp_path_factory.mktemp("campaigns")
    lists = {f"bench/{name}": (cases(campaign.ROOT), columns) for name, (cases, columns, *_) in bench.PARTS.items()}
    lists["bench/peers"] = peers.cases(), peers.COLUMNS
    lists["coverage/coverage"] = coverage.cases(), coverage.COLUMNS
    lists["coverage/space"] = coverage.cases_in_space(), coverage.COLUMNS
    lists["coverage/pins"] = coverage.cases_of_pins(), coverage.COLUMNS
    lists["stability/stability"] = stability.cases(), stability.COLUMNS
    for name, (cases, further) in lists.items():
        columns = [*campaign.COLUMNS, *further]
        rows = [made_up(item, columns, place % 9) for place, item in enumerate(cases)]
        path = folder / f"{name}.csv"
        path.parent.mkdir(exist_ok=True)
        path.write_text("".join(campaign.csv_line(line) for line in [columns, *(row.values() for row in rows)]))
    return folder


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.long] if place else []) for place, name in enumerate(FIGURES)]
)
def test_figures(campaigns, tmp_path, name):
    """Each figure of a campaign shall be written as PDF and PNG, failed runs included."""
    out = tmp_path / f"{name}.pdf"
    assert main(["figure", name, "--out", str(out), str(campaigns / name.split("_")[0])]) == 0
    assert out.read_bytes().startswith(b"%PDF-") and out.with_suffix(".png").stat().st_size > 20000


@pytest.mark.parametrize("name", pictures.PICTURES)
def test_pictures_of_the_readme(name):
    """The README's pictures of campaigns shall be legible at 85 mm: no text on another one, or below 8 points."""
    with style.look():
        drawn = pictures.PICTURES[name]()
        assert faults(drawn) == []
    assert drawn.get_figwidth() == style.COLUMN
    assert min(text.get_fontsize() for text in shown(drawn)) >= 8


def test_there_are_figures_of_both_campaigns():
    assert {name.split("_")[0] for name in FIGURES} == {"bench", "stability"} and len(FIGURES) >= 6


@pytest.mark.parametrize(
    "text, why",
    [("", "is empty"), ("a,b\n", "has no rows"), ("a,b\n1,2\n", "no c"), ("a,b,c\n1,2\n", "longer or shorter")],
)
def test_tables_that_are_refused(tmp_path, text, why):
    """A table that a figure cannot be drawn from shall be refused with its name and the reason."""
    (tmp_path / "t.csv").write_text(text)
    with pytest.raises(ResultsError, match=rf"t\.csv: .*{why}"):
        read_campaign(tmp_path).rows("t", "a b c")


def test_a_table_cut_off_is_read_to_its_last_whole_line(tmp_path):
    (tmp_path / "t.csv").write_text("a,b\n1,2\n3")
    assert read_campaign(tmp_path).rows("t", "a b") == [{"a": "1", "b": "2"}]


# ---------------------------------------------------------------- the real runs


@pytest.fixture(scope="module", params=["a third", pytest.param("whole", marks=pytest.mark.long)])
def quick(request, tmp_path_factory):
    """The rows of the quick campaign, or of every fourth case of its grid and one of each other part."""
    cases = stability.quick()
    assert 25 <= len(cases) <= 35
    if request.param == "a third":
        of_each = {item.name: item for item in cases}
        cases = [*[item for item in cases if item.name == "grid"][::4], *of_each.values()]
    rows = stability.run(tmp_path_factory.mktemp("stability") / "quick.csv", cases, jobs=2)
    assert {row["name"] for row in rows} == {item.name for item in stability.quick()}
    return rows


def test_the_quick_campaign_has_no_failure(quick):
    """The default method shall solve every case of the quick stability campaign."""
    assert [(row["flags"], row["status"], row["message"]) for row in quick if row["status"] != "converged"] == []
    assert all(value(row, "residual") <= 1e-8 for row in quick)


def test_the_quick_campaign_keeps_the_counts(quick):
    """On the paper's geometry it shall take at most 4 linearisations, 20 back-substitutions and 2 adaptations."""
    grid = campaign.select(quick, name="grid")
    assert len(grid) >= 4
    for name, most in (("newton", 4), ("backsolves", 20), ("adaptations", 2), ("factorisations", 1)):
        assert [row["flags"] for row in grid if value(row, name) > most] == [], name
    for row in quick:
        assert value(row, "newton") <= 10 and value(row, "adaptations") <= 2, row["flags"]


def test_summary_of_the_quick_campaign(quick):
    """The report shall name each part and count the failures."""
    text = stability.report(quick, [])
    assert "failures of xnewton: 0" in text and f"| {stability.PARTS['load']} | P1 |" in text


def test_checks_find_a_wrong_answer():
    """A force that differs from plain Newton's shall not pass."""
    names = [*campaign.COLUMNS, *stability.COLUMNS]
    row = dict.fromkeys(names, "") | {"law": "power", "name": "grid", "status": "converged", "method": "xnewton"}
    row |= {"force": "1.0", "pressureMax": "1.0", "energy": "1.0"}
    newton = row | {"method": "newton", "name": "rival"}
    assert all(entry["passed"] for entry in stability.checks([row, newton]))
    failed = [entry["check"] for entry in stability.checks([row | {"force": "1.00001", "energy": "1.1"}, newton])]
    assert len(failed) == 3
    wrong = stability.checks([row | {"force": "1.00001", "energy": "1.1"}, newton])
    assert [entry["passed"] for entry in wrong] == [False, True, False]
    assert json.dumps(wrong)
