"""figures.toml: which runs each figure is drawn from, sweeps, what is made anew."""

import os

import pytest
from matplotlib.figure import Figure

from postprocess import figures, output, progress, recipes
from postprocess.command_line import main
from postprocess.commands import make
from postprocess.recipes import Recipes
from postprocess.results import ResultsError

STATED = """
[texts]
block = "edp/main.edp -h 1"
[figures.runs]
soft = "{block} -path '0 1'"
[figures.sweeps."error-p{order}-{size}"]
run = "{block} -order {order} {size}"
order = ["1", "2"]
size = { "0.4" = "-h 0.4 -layers 1", "0.2" = "-h 0.2 -layers 2" }
[figures.drawn]
one = { draw = "hertz", runs = ["soft"] }
hertz = { runs = ["error-*", "soft"] }
[paper.runs]
h = "edp/main.edp"
"""


@pytest.fixture
def stated(tmp_path):
    path = tmp_path / "figures.toml"
    path.write_text(STATED)
    return path


def test_sweeps_and_texts(stated):
    """A sweep shall be a run for each combination, words in its name, flags in its command; quotes hold words."""
    read = recipes.read_recipes("figures", stated)
    assert read.runs["soft"] == ("edp/main.edp", "-h", "1", "-path", "0 1")
    assert list(read.runs)[1:] == ["error-p1-0.4", "error-p1-0.2", "error-p2-0.4", "error-p2-0.2"]
    assert read.runs["error-p2-0.2"] == tuple("edp/main.edp -h 1 -order 2 -h 0.2 -layers 2".split())
    assert read.figures["one"] == recipes.Figure("hertz", ("soft",))
    assert read.figures["hertz"] == recipes.Figure("hertz", (*list(read.runs)[1:], "soft"))
    assert list(recipes.read_recipes("paper", stated).runs) == ["h"]
    with pytest.raises(ResultsError, match="allowed: figures, paper"):
        recipes.read_recipes("papers", stated)


def test_what_is_chosen(stated):
    """A figure shall bring its runs, each once; a run's summary is the run; nothing is all."""
    read = recipes.read_recipes("figures", stated)
    drawn, runs = make.choose(read, ["one.pdf", "soft/summary.json", "error-p1-0.4"])
    assert list(drawn) == ["one"] and runs == ["soft", "error-p1-0.4"]
    drawn, runs = make.choose(read, [])
    assert list(drawn) == ["one", "hertz"] and sorted(runs) == sorted(read.runs)
    drawn, runs = make.choose(recipes.read_recipes("paper", stated), [])
    assert not drawn and runs == ["h"]
    with pytest.raises(ResultsError, match="one, hertz"):
        make.choose(read, ["two"])


def test_the_package_s_own():
    """Each figure of the package shall be drawn by a module from as many runs as that takes; each script is there."""
    modules = figures.modules()
    for section in ("figures", "paper", "accuracy"):
        read = recipes.read_recipes(section)
        assert read.runs and all((recipes.ROOT / words[0]).exists() for words in read.runs.values())
        for name, figure in read.figures.items():
            least, most = modules[figure.module].RUNS
            assert least <= len(figure.runs) <= (most or len(figure.runs)), name
    assert len(recipes.read_recipes("figures").runs) == 71 and len(recipes.read_recipes("paper").runs) == 19


def test_a_run_that_fails_ends_all(tmp_path):
    """Its code and last words shall be told, and no later run begins."""
    program = tmp_path / "program"
    program.write_text(f"#!/bin/sh\necho $@ >> {tmp_path}/log\necho it is refused\nexit 10\n")
    program.chmod(0o755)
    with pytest.raises(ResultsError, match="code 10: it is refused"):
        recipes.make_run(("edp/main.edp",), tmp_path / "run", [str(program)])
    assert (tmp_path / "log").read_text() == f"edp/main.edp -out {tmp_path}/run\n"


def test_what_is_current(tmp_path):
    """Results shall be current while no source is later."""
    (tmp_path / "summary.json").write_text("{}")
    latest = recipes.newest_source("edp/main.edp")
    for age, current in ((latest - 1, False), (latest + 1, True)):
        os.utime(tmp_path / "summary.json", (age, age))
        assert recipes.is_current(tmp_path, "edp/main.edp") == current
    assert not recipes.is_current(tmp_path / "none", "edp/main.edp")


def test_flags_of_a_section(stated):
    """Each run shall have its section's flags; no run of the package's figures pays for estimates that none shows."""
    stated.write_text(STATED.replace("[figures.runs]", '[figures]\nflags = "-vtu 0"\ncost = 7\n[figures.runs]'))
    read = recipes.read_recipes("figures", stated)
    assert read.cost == 7 and all(words[-2:] == ("-vtu", "0") for words in read.runs.values())
    assert all("-estimate" in words for words in recipes.read_recipes("figures").runs.values())


def test_what_it_takes_is_said_before(tmp_path, monkeypatch, capsys):
    """Before the first run: how many, and how long by last time, or by a start; then what is left; nothing twice."""
    program = tmp_path / "program"
    finished = '"$out"; echo \'{"seconds": {"waited": 90}}\' > "$out/summary.json"'
    program.write_text(
        f'#!/bin/sh\necho $@ >> {tmp_path}/log\nfor out; do :; done\ntest "$out" = -help || mkdir -p {finished}\n'
    )
    program.chmod(0o755)
    monkeypatch.setattr(progress, "default_run", lambda freefem: 60.0)
    monkeypatch.setattr(make, "read_recipes", lambda section: Recipes({"a": ("edp/main.edp",), "b": ("b",)}, {}, 0.5))
    monkeypatch.setattr(recipes, "newest_source", lambda script: 0.0)
    words = ["make", "paper", "--freefem", str(program), "--out", str(tmp_path), "--jobs", "1"]
    assert main([*words, "--expect"]) == 0 and not (tmp_path / "log").exists()
    assert capsys.readouterr().err == "paper: 2 runs, about 1:00 (2 of them guessed from a start here)\n"
    assert main(words) == 0
    first, last = capsys.readouterr().err.splitlines()
    assert first.startswith("paper: 2 runs, about 1:00") and last == "paper 2/2, 0:00 left"
    assert main(words) == 0 and capsys.readouterr().err == ""
    monkeypatch.setattr(recipes, "newest_source", lambda script: 1e12)
    assert main([*words, "--expect"]) == 0
    assert capsys.readouterr().err == "paper: 2 runs, about 3:00\n"
    assert len((tmp_path / "log").read_text().splitlines()) == 2


def test_pictures_count_too(monkeypatch, capsys):
    """Runs share the jobs, pictures come one by one; the seconds of each are given back."""
    monkeypatch.setattr(progress, "default_run", lambda freefem: 2.0)
    assert progress.expect("x", [None, 30.0], [5, 5], 2, (), [4]) == [10, 30, 8]
    assert capsys.readouterr().err == "x: 2 runs and 1 picture, about 0:28 (1 of them guessed from a start here)\n"


def test_time_left(monkeypatch, capsys):
    """The time left shall be that of the weight left, a line each `pause`, and the last one always."""
    now = [0.0]
    monkeypatch.setattr(progress.time, "monotonic", lambda: now[0])
    going = progress.Progress("x", 10, 3, pause=5)
    for seconds, weight, good in ((1, 1, True), (7, 1, False), (30, 8, True)):
        now[0] = seconds
        going.step(weight, good)
    assert capsys.readouterr().err == "x 2/3, 0:28 left, 1 not converged\nx 3/3, 0:00 left, 1 not converged\n"


def test_a_layout_is_found_once(tmp_path, monkeypatch):
    """A figure's PDF and PNG shall have one layout, with the room that its labels need."""
    figure = Figure(layout="constrained")
    figure.subplots().set(xlabel="x [–]", ylabel="a label that needs room [–]")
    found, engine = [], figure.get_layout_engine()
    execute = engine.execute
    monkeypatch.setattr(engine, "execute", lambda figure: found.append(1) or execute(figure))
    for kind, metadata in output.METADATA.items():
        output.figure_writer(figure, kind, metadata)(tmp_path / f"f.{kind}")
    assert len(found) == 1 and figure.axes[0].get_position().x0 > 0.05
