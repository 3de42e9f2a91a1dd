"""figures.toml: which runs each figure is drawn from, sweeps, what is made anew."""

import os

import pytest

from postprocess import figures, recipes
from postprocess.commands import make
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
