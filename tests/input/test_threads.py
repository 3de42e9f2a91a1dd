"""Threads of OpenBLAS that wait spin: a plain command has one where more gain nothing, or as many as the user says."""

import os
import shutil
import subprocess

import pytest
from freefem import FAST, FREEFEM, ROOT, environment, execute, flag_text, script, tree

VARIABLES = ("OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS")
CORES = len(os.sched_getaffinity(0))
COUNT = 'exec("echo threads $(ls /proc/$PPID/task | wc -l)");\n'


def unset(**given):
    """An environment that names no number of threads but the given one."""
    return {name: value for name, value in environment().items() if name not in VARIABLES} | given


@pytest.fixture(scope="module")
def plugins(tmp_path_factory):
    """The folder of the plugin, which is built if it is not there."""
    if FAST.exists():
        return FAST.parent
    package = tree(tmp_path_factory.mktemp("plugin") / "package")
    (package / "postprocess").symlink_to(ROOT / "postprocess")
    code, stdout = execute(["make", "-s", "-o", "system", "fast"], cwd=package, env=environment())
    assert code == 0, stdout
    return package / FAST.parent.name


def words(folder, plugins, text, *flags, **given):
    """The numbers that a script says, by their names; it stands beside the package."""
    for name in ("edp", "meshes", "freefem++.pref", FAST.parent.name):
        (folder / name).symlink_to(plugins if name == FAST.parent.name else ROOT / name)
    (folder / "script.edp").write_text(text)
    code, stdout = execute([*FREEFEM, "script.edp", *map(flag_text, flags)], folder, unset(**given))
    assert code == 0, stdout
    return {
        line.split()[0]: int(line.split()[1])
        for line in stdout.splitlines()
        if len(line.split()) == 2 and line.split()[1].isdigit()
    }


@pytest.mark.parametrize(
    "given", [{}, {"OPENBLAS_NUM_THREADS": "2"}, {"OMP_NUM_THREADS": "2"}], ids=["none", "openblas", "omp"]
)
def test_the_plugin_ends_what_waits(tmp_path, plugins, given):
    """Without the user's word one thread is left, several come when asked for; with it none is touched."""
    text = f'include "fast-plugin-{FAST.stem[-1]}.idp"\n' + COUNT
    text += 'cout << "several " << setBlasThreads(1) << endl << "one " << setBlasThreads(0) << endl;\n'
    said = words(tmp_path, plugins, text, **given)
    if given:
        assert said == {"threads": min(CORES, 2), "several": 0, "one": 0}
    else:
        assert said == {"threads": 1, "several": min(CORES, 4), "one": 1}


@pytest.mark.parametrize("scene", ["disc-on-block", "sphere-on-block"])
def test_small_runs_stay_alone(tmp_path, plugins, scene):
    """Neither the plane nor a small problem in space shall have more than one thread at the end."""
    text = (ROOT / script(scene)).read_text() + COUNT
    text = text.replace('include "output/report/report.idp"', "")
    said = words(tmp_path, plugins, text, "-h", 2, "-order", 1, "-estimate", 0, "-vtu", 0, "-out", tmp_path / "out")
    assert said["threads"] == 1


@pytest.mark.parametrize(
    ("scene", "given", "expected"),
    [
        ("confined-block", {}, "1"),
        ("confined-block", {"OMP_NUM_THREADS": "3"}, "unset"),
        ("sphere-on-block", {}, "unset"),
    ],
)
def test_a_second_start_says_one(tmp_path, scene, given, expected):
    """What a script starts anew has one thread in the plane, plugin or not, unless the user has said how many."""
    program = tmp_path / "FreeFem++"
    program.write_text('#!/bin/sh\necho "threads ${OPENBLAS_NUM_THREADS-unset}"\n')
    program.chmod(0o755)
    path = f"{tmp_path}{os.pathsep}{os.environ['PATH']}"
    command = [*FREEFEM, script(scene), "-method", "signorini"]
    done = subprocess.run(
        command, executable=shutil.which("FreeFem++"), cwd=ROOT, env=unset(PATH=path, **given), capture_output=True
    )
    assert done.returncode == 0 and f"threads {expected}\n" in done.stdout.decode()
