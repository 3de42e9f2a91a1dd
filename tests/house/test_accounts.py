"""What tests cost and read: a test that passed runs again only when something that it read has changed."""

import os
import re
import shutil
import subprocess
import sys

import accounts
import choose
import pytest
import run as runner
from freefem import ROOT, TIMEOUT

OF_PLAIN_PYTHON = "conftest.py accounts.py reads.c freefem.py text_boxes.py data/tell.edp".split()
TESTS = """
import subprocess

import pytest
from accounts import shared
from freefem import ROOT


@shared
def text():
    return subprocess.run(["cat", ROOT / "edp/contact/laws/one.idp"], capture_output=True, text=True).stdout


@pytest.fixture(scope="module")
def two():
    return (ROOT / "edp/contact/laws/two.idp").read_text()


@pytest.mark.parametrize("k", [1, 2])
def test_by_a_cached_call(k):
    assert text() == "1"


@pytest.mark.parametrize("k", [1, 2])
def test_by_a_fixture(two, k):
    assert two == "2"


def test_by_a_shell():
    assert subprocess.run(["sh", "-c", "cat edp/contact/laws/t*"], cwd=ROOT, capture_output=True).stdout == b"2"


def test_of_nothing():
    pass


def test_unwatched():
    subprocess.run(["true"], env={})


def test_no_room():
    subprocess.run(["sh", "-c", "ulimit -f 0; cat edp/contact/laws/two.idp"], cwd=ROOT, capture_output=True)
"""
FIRST = """
from helper import THREE


def test_by_a_helper():
    assert THREE == "3"
"""
HELPER = """
from freefem import ROOT

THREE = (ROOT / "edp/contact/laws/helped.idp").read_text()
"""


@pytest.fixture
def package(tmp_path):
    """The tests' own tools in a folder with two files to read."""
    folder = tmp_path / "package"
    (folder / "tests/data").mkdir(parents=True)
    for name in OF_PLAIN_PYTHON:
        shutil.copy(ROOT / "tests" / name, folder / "tests" / name)
    shutil.copy(ROOT / "pyproject.toml", folder)
    shutil.copytree(ROOT / "edp/input/without", folder / "edp/input/without")
    shutil.copytree(ROOT / "postprocess", folder / "postprocess", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "edp/contact/laws").mkdir(parents=True)
    for mark in ("long", "nightly"):
        (folder / f"tests/{mark}.txt").touch()
    last = FIRST.replace("by_a_helper", "by_the_same_helper")  # which is not imported again
    for name, text in (("test_first", FIRST), ("helper", HELPER), ("test_some", TESTS), ("test_then", last)):
        (folder / f"tests/{name}.py").write_text(text)
    for name, text in (("one", "1"), ("two", "2"), ("helped", "3")):
        (folder / f"edp/contact/laws/{name}.idp").write_text(text)
    return folder


def ran(package, *words):
    """Names of the tests that ran, and how they ended; words: further ones of pytest."""
    env = {name: value for name, value in os.environ.items() if not name.startswith(("PYTEST", "READS", "LD_PRELOAD"))}
    command = [sys.executable, "-m", "pytest", "-v", "--basetemp", package.parent / "base", *words]
    done = subprocess.run(command, cwd=package, env=env, capture_output=True, text=True, timeout=TIMEOUT)
    return dict(re.findall(r"::test_(\S+) (\w+)", done.stdout)), done


@pytest.mark.skipif(not (shutil.which("gcc") or shutil.which("cc")), reason="no C compiler")
def test_what_has_not_changed(package):
    """Cached calls, fixtures, helpers and programs count for all who use them; what escapes reads everything."""
    every, done = ran(package)
    assert set(every.values()) == {"PASSED"} and len(every) == 10, done.stdout
    again, done = ran(package)
    assert again == {} and done.returncode == 0 and "10 tests passed before" in done.stdout, done.stdout
    (package / "edp/contact/laws/one.idp").write_text("1 ")
    again, _ = ran(package)
    escaped = {"unwatched": "PASSED", "no_room": "PASSED"}
    assert again == escaped | {"by_a_cached_call[1]": "FAILED", "by_a_cached_call[2]": "FAILED"}
    (package / "edp/contact/laws/one.idp").write_text("1")
    (package / "edp/contact/laws/two.idp").write_text("3")
    again, _ = ran(package)
    assert set(again) == set(every) - {"of_nothing", "by_a_helper", "by_the_same_helper"}
    assert [name for name, end in again.items() if end == "FAILED"] == [
        "by_a_fixture[1]",
        "by_a_fixture[2]",
        "by_a_shell",
    ]
    (package / "edp/contact/laws/two.idp").write_text("2")
    ran(package)
    (package / "edp/contact/laws/helped.idp").write_text("4")
    again, _ = ran(package)
    assert again == escaped | {"by_a_helper": "FAILED", "by_the_same_helper": "FAILED"}
    (package / "edp/contact/laws/helped.idp").write_text("3")
    ran(package)
    with (package / "tests/data/tell.edp").open("a") as file:  # which freefem.py reads when it is imported
        file.write("\n")
    again, _ = ran(package)
    assert again == every


def test_long_and_nightly(package):
    """A name is a test, or a function with all its cases; a night's tests are long; a name without a test is told."""
    (package / "tests/long.txt").write_text("tests/test_some.py::test_of_nothing\n")
    (package / "tests/nightly.txt").write_text("tests/test_some.py::test_by_a_fixture\n")
    night, day = {"by_a_fixture[1]", "by_a_fixture[2]"}, {"of_nothing"}
    assert set(ran(package, "-m", "nightly", "--cache-clear")[0]) == night
    assert set(ran(package, "-m", "long and not nightly", "--cache-clear")[0]) == day
    quick, _ = ran(package, "--cache-clear")
    assert len(quick) == 7 and not set(quick) & (night | day)
    (package / "tests/nightly.txt").write_text("tests/test_some.py::test_gone\n")
    every, done = ran(package)
    assert every == {} and "tests/nightly.txt names no test: tests/test_some.py::test_gone" in done.stderr


def test_choice():
    """The most per second is taken, what tests share is paid once; a larger budget takes the dear ones."""
    every = {
        name: {"cpu": cpu, "uses": uses, "outcome": "passed"}
        for name, cpu, uses in (
            ("tests/test_a.py::test_one[1]", 1, []),
            ("tests/test_a.py::test_one[2]", 1, []),
            ("tests/test_a.py::test_dear", 50, []),
            ("tests/test_a.py::test_sharing[1]", 0.1, ["run base"]),
            ("tests/test_a.py::test_sharing[2]", 0.1, ["run base"]),
            ("run base", 2, []),
        )
    }
    scripts = {"tests/test_a.py::test_one[1]": {1}, "tests/test_a.py::test_dear": {1, 2}, "run base": {3, 4, 5}}
    tests = [choose.Test(name, every, scripts, {}) for name in every if "::" in name]
    quick = choose.choose(every, tests, choose.QUICK._replace(budget=3.5), 1)
    assert quick == {f"tests/test_a.py::test_{name}" for name in ("one[1]", "sharing[1]", "sharing[2]")}
    gate = choose.choose(every, tests, choose.GATE._replace(budget=27), 2, quick)  # 54 s
    assert gate == quick | {"tests/test_a.py::test_dear"}
    assert choose.choose(every, tests, choose.GATE._replace(budget=28), 2, quick) == set(every) - {"run base"}


def test_what_stands_for_what():
    """Compiled Python stands for its source, a mesh for its geometry; results and builds count for nothing."""
    for name, expected in (
        ("postprocess/__pycache__/output.cpython-311.pyc", "postprocess/output.py"),
        ("meshes/generated/block_depth0.5_left0.2.msh", "meshes/block.geo"),
        ("results/a/summary.json", None),
        ("build/fast.so", None),
        (".git/index", accounts.EVERYTHING),
        ("edp/main.edp", "edp/main.edp"),
    ):
        assert accounts.source(name) == expected
    assert {"tests/freefem.py", "postprocess", "tests/campaigns/campaign.py"} <= accounts.imports(
        "tests/docs/test_campaign.py"
    )


def test_report(tmp_path):
    """Costs of a label are added up over workers, the dearest come first."""
    rows = tmp_path / "accounts"
    each = (("a", 1, 2), ("b", 3, 0), ("a", 4, 1))
    rows.write_text("".join(f'{{"label": "{name}", "cpu": {cpu}, "starts": {starts}}}\n' for name, cpu, starts in each))
    first, *dearest = runner.report(100, 0.5, rows, 2).splitlines()
    assert first.startswith("200 default runs of 0.500 CPU s; 3 starts of FreeFEM")
    assert [line.split() for line in dearest] == [["10", "a"], ["6", "b"]]
