"""The session's store of runs, shared by pytest-xdist's workers; the texts of figures that tests write are measured."""

import gc
import os

import accounts
import freefem
import pytest
from text_boxes import faults

from postprocess import output

os.environ |= {"OPENBLAS_NUM_THREADS": "1", "OMP_THREAD_LIMIT": "1"}  # of what tests start in ways of their own, too


def pytest_addoption(parser):
    parser.addoption("--no-skips", action="store_true", help="a test that is skipped is named and fails the session")


def pytest_configure(config):
    config.pluginmanager.register(accounts)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """The tests of long.txt get the mark `long`, those of nightly.txt `nightly`, too.

    A name there is a test, or a function with all its cases.
    """
    names = {item.nodeid for item in items} | {item.nodeid.split("[")[0] for item in items}
    for marks in (["long"], ["nightly", "long"]):
        named = set((freefem.ROOT / f"tests/{marks[0]}.txt").read_text().splitlines())
        for item in items:
            if not named.isdisjoint((item.nodeid, item.nodeid.split("[")[0])):
                for mark in marks:
                    item.add_marker(mark)
        stale = sorted(named - names)
        if stale and config.args == config.getini("testpaths"):
            raise pytest.UsageError(f"tests/{marks[0]}.txt names no test: {stale[0]} ({len(stale)} such lines)")


def pytest_collection_finish():
    gc.freeze()  # the tests themselves and matplotlib are no garbage: figures begin collections by the dozen


def pytest_sessionfinish(session):
    config = session.config
    reporter = config.pluginmanager.get_plugin("terminalreporter")
    if config.getoption("--no-skips") and reporter:  # not in a worker
        for report in reporter.stats.get("skipped", []):
            reporter.write_line(f"\nSKIPPED {report.nodeid}: {report.longrepr[2]}")
            session.exitstatus = pytest.ExitCode.TESTS_FAILED


@pytest.fixture(scope="session", autouse=True)
def run_store(tmp_path_factory):
    base = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:  # a worker's folder lies in the session's
        base = base.parent
    freefem.STORE = base / "runs"


@pytest.fixture(autouse=True)
def legible_figures(monkeypatch):
    """No figure shall be written with a text on another one or beyond its edge."""
    save = output.figure_writer

    def measured(figure, kind, metadata):
        assert kind != "png" or faults(figure) == []
        return save(figure, kind, metadata)

    monkeypatch.setattr(output, "figure_writer", measured)


@pytest.fixture
def go(tmp_path):
    """go(geo, case, *flags) runs a part, each time in a folder of its own: what it told."""
    from error.test_truth import Told  # the campaigns that it needs are for its tests alone

    def start(*words, **options):
        folder = tmp_path / str(len(list(tmp_path.iterdir())))
        folder.mkdir()
        return Told(folder, *words, **options)

    return start
