"""Runs in their surroundings: languages, folders shared with other runs and other files, kills, disks without room."""

import json
import os
import platform
import resource
import shutil
import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest
from accounts import shared
from freefem import (
    FAST,
    FREEFEM,
    PLUGIN_SAYS,
    ROOT,
    being_written,
    cases_of,
    environment,
    execute,
    files,
    interrupt,
    interruptible,
    listing,
    patience,
    run_in,
    snippet,
    table,
    tree,
    wait_for,
)
from freefem import script as scene_script

from postprocess.command_line import main

DISC, BLOCK = map(scene_script, ("disc-on-block", "confined-block"))
BODIES, PUNCH = "edp/parts.edp", "edp/examples/punch/punch"
TINY = ["-h", "10", "-vtu", "0", "-estimate", "0"]  # a tenth of a second of the confined block


def start(*words, cwd=ROOT, env=None):
    """A run that goes on beside the test."""
    return subprocess.Popen(
        [*FREEFEM, *map(str, words)],
        cwd=cwd,
        env=env or environment(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
        preexec_fn=interruptible,
    )


def ended(process):
    """(exit code, output) of such a run."""
    stdout = process.communicate(timeout=patience(50))[0]
    return process.returncode, stdout.replace(PLUGIN_SAYS, "", 1)


def started(pid):
    """What the package's shell programs call the time when a process began; nothing for one that has ended."""
    done = subprocess.run(
        ["sh", "-c", f". edp/input/process.sh; started {pid}"], cwd=ROOT, capture_output=True, text=True
    )
    return done.stdout.strip()


def refused_in_one_line(stdout):
    """The line that says why; nothing but it."""
    (line,) = stdout.splitlines()
    assert "allowed" in line
    return line


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """A fresh clone, for runs that leave it as it was."""
    return tree(tmp_path_factory.mktemp("surroundings") / "package")


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    """The example's two bodies on larger elements, as a mesh of the user's: FILE.msh of a size."""
    folder = tmp_path_factory.mktemp("mesh")

    @shared
    def make(size):
        text = (ROOT / f"{PUNCH}.geo").read_text()
        assert "size = {0.1," in text
        (folder / "bodies.geo").write_text(text.replace("size = {0.1,", f"size = {{{size},"))
        command = ["gmsh", "-2", "-v", "0", "-format", "msh22", folder / "bodies.geo", "-o", folder / f"{size}.msh"]
        assert execute(command)[0] == 0
        return folder / f"{size}.msh"

    return make


# ---------------------------------------------------------------- languages


@pytest.fixture(scope="module")
def comma(tmp_path_factory):
    """An environment whose numbers have a comma."""
    if not shutil.which("localedef") or not os.path.exists("/usr/share/i18n/locales/de_DE"):
        pytest.skip("localedef or its sources are not there (Debian's package locales)")
    folder = tmp_path_factory.mktemp("locales")
    code, stdout = execute(["localedef", "-i", "de_DE", "-f", "UTF-8", folder / "de_DE.UTF-8"])
    if "charmap" in stdout:
        pytest.skip("localedef has no character maps")
    assert (folder / "de_DE.UTF-8" / "LC_NUMERIC").exists(), (code, stdout)
    kept = {name: value for name, value in environment().items() if not name.startswith("LC_")}
    env = {**kept, "LANG": "de_DE.UTF-8", "LOCPATH": str(folder)}
    assert execute(["printf", "%.1f", "0"], env=env)[1] == "0,0"
    return env


def test_comma_locale(mesh, comma, tmp_path):
    """A mesh of the user's, gmsh's meshes and the laws' tables shall be read alike in a language with commas."""
    env = {**comma, "LC_ALL": "de_DE.UTF-8"}
    package = tree(tmp_path / "package")  # its meshes are made in that language
    if FAST.parent.exists():  # the plugins round in their own ways
        (package / "build").symlink_to(FAST.parent)
    (tmp_path / "table.csv").write_text("".join(f"{s / 10},{(s / 10) ** 2}\n" for s in range(6)))
    flags = {
        BODIES: ["-mesh", mesh(0.5), "-case", f"{PUNCH}.case", "-order", 1],
        DISC: ["-h", 2, "-order", 1, "-law", "table", "-table", tmp_path / "table.csv"],
    }
    for script, own in flags.items():
        own += ["-vtu", 0, "-estimate", 0]
        here = run_in(ROOT, script, *own, out=tmp_path / "here")
        there = run_in(package, script, *own, out=tmp_path / "there", env=env)
        assert there.force == here.force > 0
        assert (there.folder / "contact.csv").read_bytes() == (here.folder / "contact.csv").read_bytes()


# ---------------------------------------------------------------- side by side


@pytest.mark.parametrize("trials", [1, 20])
def test_four_runs_in_one_new_folder(tmp_path, trials):
    """Runs that begin together in folders of one parent that is not there yet shall not disturb each other."""
    for trial in range(trials):
        parent = tmp_path / f"new {trial}" / "below"
        runs = [start(BLOCK, *TINY, "-out", parent / name) for name in "abcd"]
        for name, process in zip("abcd", runs, strict=True):
            assert ended(process)[0] == 0
            assert "summary.json" in files(parent / name) and not being_written(parent / name)
        assert sorted(path.name for path in parent.iterdir()) == list("abcd")


@pytest.mark.parametrize("trials", [2, 20])
def test_two_runs_into_one_folder(tmp_path, trials):
    """Of two runs into one folder both shall be done, one after the other, or one refused; its files are one run's."""
    out, refusals = tmp_path / "out", 0
    for trial in range(trials):
        if trial % 3 == 0:
            shutil.rmtree(out, ignore_errors=True)
        runs = [ended(process) for process in [start(BLOCK, *TINY[2:], "-h", h, "-out", out) for h in (10, 5)]]
        codes = sorted(code for code, _ in runs)
        assert codes in ([0, 0], [0, 10]), runs
        for code, stdout in runs:
            if code == 10:
                line = stdout.splitlines()[-1]
                assert f"-out {out}: in use by another run" in line and "allowed" in line
                refusals += 1
        summary = json.loads((out / "summary.json").read_text())
        assert summary["points"] == len(table(out / "contact.csv")) == {10: 3, 5: 5}[summary["h"]]
        assert summary["newton"] == len(table(out / "history.csv"))
        assert files(out) == ["adaptations.csv", "contact.csv", "history.csv", "summary.json"]
        assert len([name for name in os.listdir(out / ".run") if name.startswith(".lock")]) == 1
    assert refusals > 0 or trials < 10


def test_folder_in_use(tmp_path):
    """A folder shall be refused while a run is in it, untouched, and be free as soon as that is killed."""
    out = tmp_path / "out"
    process = start(DISC, "-method", "incremental", "-steps", 100000, "-h", 0.5, "-out", out)
    try:
        wait_for(lambda: (out / ".run" / ".written").exists())
        before = listing(tmp_path)
        done = run_in(ROOT, BLOCK, *TINY, out=out, expect=10)
        assert "in use" in refused_in_one_line(done.stdout)
        assert listing(tmp_path) == before
    finally:
        process.kill()
    wait_for(lambda: ") Z " in Path(f"/proc/{process.pid}/stat").read_text())  # it has ended, and nobody has asked how
    assert run_in(ROOT, BLOCK, *TINY, out=out).converged
    process.wait()
    process.stdout.close()


@pytest.mark.parametrize(
    "owner, free",
    [
        ("{pid} {began} {host}", False),
        ("{pid} 0 {host}", True),  # another process had that number, before a reboot say
        ("{dead} 1234 {host}", True),
        ("{pid} {began} elsewhere", False),
        ("done", True),
        ("", True),  # killed before it could say who it was
    ],
)
def test_lock(tmp_path, owner, free):
    """The lock of a run that is no more shall hold nobody up; that of a live one, or of another computer's, shall."""
    (tmp_path / ".run").mkdir()
    dead = subprocess.Popen(["true"])
    dead.wait()
    who = {"pid": os.getpid(), "began": started(os.getpid()), "host": platform.node(), "dead": dead.pid}
    text = owner.format(**who)
    (tmp_path / ".run" / ".lock-7").write_text(f"{text}\n" if text else "")
    code, _ = execute(["sh", "edp/input/folder.sh", os.getppid(), "open", tmp_path])
    assert code == (0 if free else 6 if "elsewhere" in owner else 5)
    assert sorted(os.listdir(tmp_path / ".run")) == ([".lock-8", ".written"] if free else [".lock-7"])
    if code == 6:
        done = run_in(ROOT, BLOCK, *TINY, out=tmp_path, expect=10)
        assert "another computer" in refused_in_one_line(done.stdout)


def test_publishing_of_a_killed_run(tmp_path):
    """What a killed run was still moving into place shall not touch the files of the run that has the folder now."""
    (tmp_path / ".run").mkdir()
    names = [*(f"state-{state}.vtu" for state in range(300)), "summary.json"]
    for name in names:
        (tmp_path / ".run" / name).write_text("old\n")
    (tmp_path / ".run" / ".ends").write_text("".join(f"{name} 4\n" for name in names))
    (tmp_path / ".run" / ".written").touch()
    (tmp_path / ".run" / ".lock-1").write_text("1 0 killed\n")
    publishing = subprocess.Popen(["sh", "edp/input/folder.sh", "1", "publish", tmp_path], cwd=ROOT)
    (tmp_path / ".run" / ".lock-2").write_text("done\n")
    (tmp_path / ".run" / ".lock-1").unlink()  # as the next run does
    (tmp_path / ".run" / "contact.csv").write_text("new")
    assert publishing.wait(60) in (0, 1)
    assert being_written(tmp_path).count("contact.csv") == 1 and "summary.json" not in files(tmp_path)


@pytest.mark.parametrize("trials", [1, 5])
def test_one_mesh_made_by_four_runs(tmp_path, trials):
    """Runs that need the same mesh at the same time shall each get it, whole."""
    for trial in range(trials):
        package = tree(tmp_path / f"package{trial}")
        flags = ["-h", 2, "-vtu", 0, "-estimate", 0]
        runs = [start(DISC, *flags, "-out", tmp_path / name, cwd=package) for name in "abcd"]
        assert [ended(process)[0] for process in runs] == [0, 0, 0, 0]
        (path,) = (package / "meshes" / "generated").iterdir()
        assert path.suffix == ".msh"


# ---------------------------------------------------------------- the user's own files, odd names


def test_files_of_the_user_stay(tmp_path):
    """A run shall remove what a run has written into the folder, with the movie drawn from it, and nothing else."""
    own = ["notes.vtu", "notes.tmp", "state-99.vtu", "mine.gif", "axis.csv"]
    for name in own:
        (tmp_path / name).write_text("mine")
    run_in(ROOT, BLOCK, "-method", "newton", "-kappa", 0.01, "-tol", 0.9, "-h", 5, "-states", 1, out=tmp_path)
    states = [name for name in files(tmp_path) if name.startswith("state-") and name not in own]
    assert len(states) > 1
    assert main(["movie", "--out", str(tmp_path), str(tmp_path)]) == 0
    assert {"movie.html", "movie.gif"} <= set(files(tmp_path))
    run_in(ROOT, BLOCK, *TINY, out=tmp_path)
    assert files(tmp_path) == sorted([*own, "adaptations.csv", "contact.csv", "history.csv", "summary.json"])
    for name in ("movie.html", "movie.gif"):
        (tmp_path / name).write_text("mine")
    run_in(ROOT, BLOCK, *TINY, out=tmp_path)
    assert all((tmp_path / name).read_text() == "mine" for name in [*own, "movie.html", "movie.gif"])


FOREIGN = "is not from a run of this package; allowed: a folder without it\n"


@pytest.mark.parametrize("name", ["summary.json", "history.csv", "link"])
def test_file_of_another_origin(tmp_path, name):
    """A file of the user's with a result's name, or a link with it, shall be refused in one line and stay."""
    out, elsewhere = tmp_path / "out", tmp_path / "elsewhere"
    elsewhere.write_text("mine")
    if name == "link":
        run_in(ROOT, BLOCK, *TINY, out=out)
        name = "summary.json"
        (out / name).unlink()
        (out / name).symlink_to(elsewhere)
    else:
        out.mkdir()
        (out / name).write_text("mine")
    before = listing(tmp_path)
    for task in ("check", "open"):
        code, line = execute(["sh", "edp/input/folder.sh", os.getpid(), task, out])
        assert code == 8 and line == f"-out {out}: {name} there {FOREIGN}"
    if name == "summary.json":
        done = run_in(ROOT, BLOCK, *TINY, "-maxNewton", 1, out=out, expect=10)
        assert f"-out {out}: {name} there is not" in refused_in_one_line(done.stdout)
    assert (out / name).read_text() == "mine" and listing(tmp_path) == before


def test_file_of_another_origin_met_late(tmp_path):
    """One that only some runs write shall be found before it is overwritten, and no result be left beside it."""
    (tmp_path / "states.csv").write_text("mine")
    stdout = run_in(ROOT, BLOCK, *TINY, "-states", 1, out=tmp_path, expect=10).stdout
    assert stdout.endswith(f"-out {tmp_path}: states.csv there {FOREIGN}")
    assert files(tmp_path) == ["states.csv"] and (tmp_path / "states.csv").read_text() == "mine"
    assert being_written(tmp_path) == []


@pytest.mark.parametrize("kind", ["link", "link inside", "folder"])
def test_own_folder_of_another_origin(tmp_path, kind):
    """A .run that is a link, has one in it or is the user's own shall be refused, its contents untouched."""
    out, target = tmp_path / "out", tmp_path / "target"
    (target / "deep").mkdir(parents=True)
    (target / "mine").write_text("mine")
    out.mkdir()
    if kind == "link":
        (out / ".run").symlink_to(target)
    elif kind == "folder":
        shutil.copytree(target, out / ".run")
    else:
        (out / ".run").mkdir()
        (out / ".run" / ".lock-1").write_text("done\n")
        (out / ".run" / ".written").symlink_to(target / "mine")
    before = listing(tmp_path)
    for task in ("check", "open"):
        code, line = execute(["sh", "edp/input/folder.sh", os.getpid(), task, out])
        assert code == 8 and line == f"-out {out}: .run there {FOREIGN}"
    assert listing(tmp_path) == before and (target / "mine").read_text() == "mine"


def test_name_of_a_case(tmp_path):
    """A case file's name shall lead to a folder below results/parts, whatever points it has."""
    names = {
        "...case": "case",
        "a/..case": "case",
        ".x.case": "x",
        "pin.a.case": "pin.a",
        "a.b/pin": "pin",
        "..": "case",
    }
    text = 'string scene = "parts";\ninclude "input/flags.idp"\n'
    text += 'include "input/output.idp"\ninclude "input/case/case-flags.idp"\n'
    text += "".join(f'cout << "name " << baseName("{name}") << endl;\n' for name in names)
    lines = snippet(tmp_path, text).splitlines()
    assert [line[5:] for line in lines if line.startswith("name ")] == list(names.values())


@pytest.mark.parametrize("name", ["it's", 'say "this"  $HOME `date`', "-x Größe * back\\slash"])
def test_odd_folder(tmp_path, name):
    """Any printable name of a folder shall do, and be told rightly in summary.json."""
    out = tmp_path / "in" / name
    run_in(ROOT, BLOCK, *TINY, out=out)
    assert os.listdir(tmp_path / "in") == [name]
    assert files(out) == ["adaptations.csv", "contact.csv", "history.csv", "summary.json"]
    assert json.loads((out / "summary.json").read_text())["parameters"]["out"] == str(out)


@pytest.mark.parametrize("name", ["-1.geo", "-2 $(touch F);touch F.msh"])
def test_odd_mesh(mesh, package, tmp_path, name):
    """A mesh file's name shall be read by no program as a flag or a command, gmsh's own format included."""
    for wanted in ("edp", "meshes", "freefem++.pref"):
        (tmp_path / wanted).symlink_to(package / wanted)
    if name.endswith(".geo"):
        shutil.copy(mesh(1).parent / "bodies.geo", tmp_path / name)
    else:
        assert execute(["gmsh", "-2", "-v", 0, mesh(1), "-save", "-o", tmp_path / "new.msh"])[0] == 0
        (tmp_path / "new.msh").rename(tmp_path / name)
    assert run_in(
        tmp_path, BODIES, "-mesh", name, "-case", f"{PUNCH}.case", "-order", 1, *TINY[2:], out=tmp_path / "out"
    ).converged
    assert not (tmp_path / "F").exists()


@pytest.mark.parametrize("name, told", [("a\nb", "a\\nb"), ("a\tb", "a\\tb"), ("a\x1bb", "a")])
def test_control_characters(package, name, told):
    """A control character in the folder's name shall be refused in one line."""
    before = listing(package)
    line = refused_in_one_line(run_in(package, BLOCK, *TINY, "-out", name, expect=10).stdout)
    assert f"-out {told}" in line and "control character" in line
    assert listing(package) == before


# ---------------------------------------------------------------- kills


@pytest.fixture
def slow_gmsh(tmp_path):
    """A gmsh that takes its time and notes its process: (environment, file with its number)."""
    folder = tmp_path / "bin"
    folder.mkdir()
    (folder / "gmsh").write_text(f"#!/bin/sh\necho $$ > '{folder}/began'\nexec sleep 100\n")
    (folder / "gmsh").chmod(0o755)
    return environment(PATH=f"{folder}:{os.environ['PATH']}"), folder / "began"


def test_gmsh_ends_with_its_run(tmp_path, slow_gmsh):
    """gmsh shall end with the run that needs the mesh, and nothing of either be left, or be gone with the next run."""
    env, began = slow_gmsh
    package = tree(tmp_path / "package")
    before = listing(package)
    flags = ["-h", 2, "-vtu", 0, "-estimate", 0, "-out", tmp_path / "out"]
    for how in ("kill", "interrupt", "kill all"):
        began.unlink(missing_ok=True)
        process = start(DISC, *flags, cwd=package, env=env)
        wait_for(lambda: began.exists() and began.read_text().endswith("\n"))
        gmsh = int(began.read_text())
        assert started(gmsh), how
        if how == "kill":
            process.kill()
        else:
            os.killpg(process.pid, signal.SIGKILL if how == "kill all" else signal.SIGINT)
        wait_for(lambda: not started(gmsh))  # noqa: B023
        code, stdout = ended(process)
        assert code == (130 if how == "interrupt" else -signal.SIGKILL), how
        if how == "interrupt":
            assert stdout.splitlines()[-1] == "interrupted"
        if how != "kill all":
            wait_for(lambda: listing(package) == before)
    run_in(package, DISC, *flags[:-2], out=tmp_path / "out")
    left = set(listing(package)) - set(before) - {"meshes/generated"}
    assert len(left) == 1 and left.pop().endswith(".msh")


# ---------------------------------------------------------------- no room


def no_room(limit):
    """A preexec_fn: writing a file beyond the limit fails, as on a full disk."""

    def limited():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    return limited


def limited_run(package, script, limit, *flags):
    done = subprocess.run(
        [*FREEFEM, script, *map(str, flags)],
        cwd=package,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        preexec_fn=no_room(limit),
        timeout=patience(50),
    )
    return done.returncode, done.stdout


def test_no_place_for_a_mesh(tmp_path):
    """Where meshes/generated cannot be made or has no room, the run shall say so in one line and leave nothing."""
    package = tree(tmp_path / "package")
    before = listing(package)
    code, stdout = limited_run(package, DISC, 2000, "-h", 2, "-out", tmp_path / "out")
    assert code == 30 and stdout.startswith("out of disk: ") and stdout.count("\n") == 1, stdout
    assert listing(package) == before
    (package / "meshes" / "generated").touch()
    before = listing(package)
    done = run_in(package, DISC, "-h", 2, out=tmp_path / "out", expect=10)
    assert "meshes/generated cannot be written" in refused_in_one_line(done.stdout)
    assert listing(package) == before and not (tmp_path / "out").exists()


# ---------------------------------------------------------------- load series


def interrupted_series(*words, cwd=ROOT, rows=4):
    """Kill a load series once it has written some rows."""
    series = words[words.index("-out") + 1] / "series.csv"
    interrupt([*FREEFEM, *words], lambda: series.exists() and len(table(series)) >= rows, cwd)


@pytest.mark.parametrize("method", ["xnewton", "paper"])
def test_series_counts_go_on(tmp_path, method):
    """An interrupted series shall end with the forces and counts of one that was not."""
    flags = ["-method", method, "-h", 1, "-order", 1, "-history", 1, "-steps", 12, "-vtu", 0, "-estimate", 0]
    whole = run_in(ROOT, DISC, *flags, out=tmp_path / "whole")
    out = tmp_path / "halved"
    interrupted_series(DISC, *flags, "-out", out)
    resumed = run_in(ROOT, DISC, *flags, out=out)
    assert "goes on after step" in resumed.stdout and "begun anew" not in whole.stdout
    rows, expected = (table(folder / "series.csv") for folder in (out, whole.folder))
    np.testing.assert_array_equal(rows["step"], expected["step"])
    np.testing.assert_allclose(rows["force"], expected["force"], rtol=1e-9)
    np.testing.assert_array_equal(rows["newton"], expected["newton"])
    extra = rows["backsolves"] - expected["backsolves"]
    assert (np.diff(extra) >= 0).all() and extra[0] == 0
    assert extra[-1] <= (method == "xnewton")  # the kernel is fitted once more
    assert whole.newton > resumed.newton == len(resumed.history)


def test_series_of_another_problem(tmp_path):
    """Where flags, the files they name, or the sources have changed, a series shall be begun anew, and this be said."""
    package = tree(tmp_path / "package")
    out, file, power = tmp_path / "out", tmp_path / "given", package / "edp/contact/laws" / "power.idp"
    given = "".join(f"{s / 10},{(s / 10) ** 2}\n" for s in range(6))
    flags = ["-h", 2, "-order", 1, "-law", "table", "-table", file]
    source = power.read_text()
    changes = {
        "table": (file, given.replace("0.5,0.25", "0.5,0.2501")),
        "flag": (file, given),
        "sources": (power, f"{source}// changed\n"),
    }
    flags += ["-history", 1, "-steps", 12, "-vtu", 0, "-estimate", 0]
    file.write_text(given)
    interrupted_series(DISC, *flags, "-out", out, cwd=package, rows=3)
    for what, (path, text) in changes.items():
        shutil.copytree(out, tmp_path / what)
        file.write_text(given)
        path.write_text(text)
        again = run_in(package, DISC, *flags, *(["-E", 101] if what == "flag" else []), out=tmp_path / what)
        assert "begun anew" in again.stdout and "goes on" not in again.stdout, what
        np.testing.assert_array_equal(np.unique(again.history["step"]), range(1, 13), err_msg=what)
        assert again.newton == len(again.history), what


def test_series_that_is_complete(tmp_path):
    """A complete series shall be begun anew; a run without one, or one that fails at once, shall keep none of it."""
    flags = ["-method", "newton", "-h", 5, "-history", 1, "-steps", 3, "-vtu", 0, "-estimate", 0]
    out = tmp_path / "out"
    run_in(ROOT, BLOCK, *flags, out=out)
    assert "complete" in run_in(ROOT, BLOCK, *flags, out=out).stdout
    assert {"series.csv", "series.state"} <= set(files(out))
    run_in(ROOT, BLOCK, *flags, "-maxNewton", 1, out=out, expect=20)
    assert not {"series.csv", "series.state"} & set(files(out))
    run_in(ROOT, BLOCK, *flags, out=out)
    run_in(ROOT, BLOCK, *TINY, out=out)
    assert files(out) == ["adaptations.csv", "contact.csv", "history.csv", "summary.json"]


@pytest.mark.parametrize("scene", cases_of(["disc-on-block"], ["two-cylinders", "hertz-line", "meshed-disc"]))
def test_series_of_the_exact_distance(tmp_path, scene):
    """A load series with the true distance shall end where one step does, its steps in the table."""
    flags = ["-distance", "exact", "-order", 1, "-estimate", 0, "-vtu", 0, "-h", 2]
    flags += ["-force", 0] if scene in ("hertz-line", "two-cylinders") else []
    series = run_in(ROOT, scene_script(scene), *flags, "-history", 1, "-steps", 4, out=tmp_path / "series")
    alone = run_in(ROOT, scene_script(scene), *flags, out=tmp_path / "alone")
    assert series.force == pytest.approx(alone.force, rel=1e-5)
    rows = (tmp_path / "series" / "series.csv").read_text().splitlines()
    assert len(rows) == 5 and float(rows[-1].split(",")[3]) == pytest.approx(series.force, rel=1e-9)


# ---------------------------------------------------------------- stresses below the contact


@pytest.mark.parametrize("scene, flags", [("hertz-line", ["-depth", 2]), ("meshed-disc", ["-depth", 3, "-order", 2])])
def test_axis_ends_with_the_body(tmp_path, scene, flags):
    """axis.csv shall end at the body's bottom: no rows of zeros from beside the body."""
    done = run_in(ROOT, scene_script(scene), *flags, "-h", 1, "-axis", 1, *TINY[2:], out=tmp_path / "out")
    rows = table(tmp_path / "out" / "axis.csv")
    assert len(rows) == 200 and (np.diff(rows["depth"]) > 0).all()
    assert (rows["s22"] != 0).all()
    depth = done.summary["parameters"]["depth"]
    assert rows["depth"][-1] <= depth * (1 + 1e-6)
    if scene == "hertz-line":
        assert rows["depth"][-1] == pytest.approx(depth, rel=1e-6)


# ---------------------------------------------------------------- a bare system
