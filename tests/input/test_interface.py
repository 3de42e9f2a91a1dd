"""How runs are started and what they leave: folders, progress lines, help, meshes, interrupted runs, a full disk."""

import json
import os
import pty
import re
import resource
import select
import shutil
import signal
import subprocess
import time

import pytest
from freefem import (
    FREEFEM,
    ROOT,
    being_written,
    cases_of,
    environment,
    execute,
    files,
    listing,
    patience,
    plotted,
    run_in,
    script,
    tree,
)

DISC, TWO_BODIES, BLOCK = "disc-on-block", "meshed-disc", "confined-block"
SCENES = [DISC, TWO_BODIES, BLOCK]
FLAGS = "-E -nu -width -depth -u0 -gap -kappa -m -d0 -rho -h -order -T0 -eps -tol -maxNewton -maxAdaptations".split()
FLAGS += ["-steps", "-method", "-out"]
RESULTS = ["adaptations.csv", "contact.csv", "contact.vtu", "history.csv", "solution.vtu", "summary.json"]
COARSE = ["-h", 2, "-order", 1, "-estimate", 0]
BARE = {"PATH": "/usr/bin:/bin"}  # nothing else in the environment

# ---------------------------------------------------------------- starting


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """A fresh clone, in a folder whose name has a blank."""
    return tree(tmp_path_factory.mktemp("interface") / "a package")


@pytest.mark.parametrize(
    "folder, name, scene",
    [
        (".", "edp/main.edp", DISC),
        ("edp", "main.edp", DISC),
        (".", "edp/scenes/meshed-disc.edp", TWO_BODIES),
        ("edp/scenes", "confined-block.edp", BLOCK),
    ],
)
def test_started_from_either_folder(package, folder, name, scene):
    """Runs shall start without any environment, from the root and from edp/, their results in the root's results/."""
    before, method = set(listing(package)), "paper" if folder == "." else "newton"
    run_in(package / folder, name, "-method", method, *COARSE, env=BARE)
    out = package / "results" / scene / method
    assert files(out) == RESULTS
    new = {path for path in set(listing(package)) - before if not path.startswith(("results", "meshes/generated"))}
    assert not new


def test_started_with_a_whole_path(package, tmp_path):
    """-out shall be taken relative to the folder that the run is started in, blanks allowed."""
    run_in(package / "edp", package / "edp/main.edp", *COARSE, "-out", "../my results/a b", env=BARE)
    assert files(package / "my results" / "a b") == RESULTS


@pytest.mark.parametrize("scene", SCENES)
def test_help_names_every_flag(package, scene, tmp_path):
    """-help shall print the table of flags with defaults and ranges, and neither run nor write."""
    before = listing(package)
    stdout = run_in(package, script(scene), "-help", "-h", "2").stdout
    rows = {line.split()[0]: line for line in stdout.splitlines() if line.startswith("-")}
    wanted = [*FLAGS, *([] if scene == BLOCK else ["-R"]), *(["-Eratio"] if scene == TWO_BODIES else [])]
    for flag in wanted:
        assert flag in rows
        assert re.search(r"\(.+\)$", rows[flag]), flag
    for flag, default in (("-kappa", "1000"), ("-m", "3"), ("-d0", "-0.25"), ("-eps", "0.0001"), ("-tol", "1e-06")):
        assert rows[flag].split()[1] == default
    assert listing(package) == before


def test_commands_are_posix():
    """What FreeFEM hands to the shell shall not need GNU's options: BSD's sed takes -i's next word for a suffix."""
    texts = {path: path.read_text() for kind in ("idp", "edp", "sh") for path in (ROOT / "edp").rglob(f"*.{kind}")}
    assert any("exec(" in text for text in texts.values())
    for path, text in texts.items():
        assert not re.search(r"sed -i|readlink -f|grep -P|mktemp --|stat -c|date \+%N", text), path


def test_other_plugin_folders(tmp_path):
    """Folders in freefem++.pref that do not exist shall do no harm where FreeFEM has the right ones from elsewhere."""
    package = tree(tmp_path / "package")
    texts = {path: path.read_text() for path in package.rglob("freefem++.pref")}
    for path, text in texts.items():
        path.write_text(re.sub(r'\+= "/', '+= "/not/here/', text))
    for folder in (package, package / "edp", package / "edp" / "scenes"):
        own = re.findall(r'^\w+ \+= "/.*\n', texts[folder / "freefem++.pref"], re.MULTILINE)
        (tmp_path / ".freefem++.pref").write_text("".join(own))
        env = {**BARE, "HOME": str(tmp_path)}
        run_in(folder, package / script(BLOCK), "-h", 5, *COARSE[2:], "-vtu", 0, out=tmp_path / "out", env=env)


# ---------------------------------------------------------------- progress


def is_progress(line):
    """A line of a Newton step: its number, residual, points in contact, force; then perhaps the load step or model."""
    words = line.split()
    return len(words) in (4, 6) and all(re.fullmatch(r"[-+.\de]+", word) for word in words[:4])


def test_progress_appears_as_it_happens(tmp_path):
    """The line of a Newton step shall come through a pipe when the step is done, not when a buffer is full.

    The run is stopped there: what it leaves must not look like results.
    """
    out = tmp_path / "out"
    flags = ["-method", "incremental", "-steps", "100000", "-h", "0.1", "-order", "2", "-out", str(out)]
    command = [*FREEFEM, script(DISC), *flags]
    process = subprocess.Popen(command, cwd=ROOT, env=environment(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        text = b""
        while not any(map(is_progress, text.decode().split("\n")[:-1])):
            some = os.read(process.stdout.fileno(), 65536)
            assert some, text.decode()
            text += some
        assert process.poll() is None
        # a buffer of 4096 bytes would hold some forty of them
        assert sum(map(is_progress, text.decode().split("\n")[:-1])) < 10
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.stdout.close()
    assert out.is_dir()
    assert files(out) == []


@pytest.mark.parametrize("name", ["scenes/confined-block.edp", "labs/0-algorithm/algorithm1.edp"])
def test_from_any_folder(name, package, tmp_path):
    """Started by edp/freefem.sh from anywhere scripts shall find their modules; what a run says draws it from there."""
    program = ["sh", package / "edp/freefem.sh"]
    flags = ["-h", 5, "-estimate", 0, "-out", "here"] if "scenes" in name else []
    code, stdout = execute([*program, name, *flags], tmp_path, BARE)
    assert code == 0, stdout
    if "scenes" in name:
        assert (tmp_path / "here" / "summary.json").exists()
        for folder in (".venv", "postprocess"):
            (package / folder).symlink_to(ROOT / folder)
        command, _, drawn = plotted(stdout).partition(" state ")
        assert drawn == "here/"
        code, stdout = execute(["sh", "-c", f"{command} state --help"], tmp_path)
        assert code == 0 and stdout.startswith("usage: python -m postprocess state"), stdout
    code, stdout = execute([*program, "nowhere.edp"], tmp_path, BARE)
    assert code == 10 and stdout.startswith("nowhere.edp: no such script")


def test_modules_are_the_package_s(package, tmp_path):
    """The starter shall read no module, script or Python module of the present folder in place of the package's."""
    modules = "input/flags.idp input/scene.idp contact/laws/power.idp input/contact/laws/power.idp"
    for name in f"{modules} main.edp scenes/wavy.edp".split():
        (tmp_path / name).parent.mkdir(exist_ok=True, parents=True)
        (tmp_path / name).write_text('cout << "not the package" << endl; exit(3);\n')
    for name in ("numpy", "argparse", "csv", "matplotlib"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit(3)\n")
    for name in (".venv", "postprocess"):
        if not (package / name).exists():
            (package / name).symlink_to(ROOT / name)
    start = ["sh", package / "edp/freefem.sh"]
    quick = ["-h", 5, "-order", 1, "-vtu", 0, "-out"]
    # of these the first is handed over to a script that includes main.edp
    runs = [
        ("disc-on-block", ["-accuracy", 0.25]),
        ("confined-block", ["-estimate", 0]),
        ("labs/1-law/law.edp", ["-estimate", 0]),
    ]
    for script_, flags in runs:
        code, said = execute([*start, script_, *flags, *quick, "out"], tmp_path, BARE)
        assert code in (0, 21) and (tmp_path / "out" / "summary.json").exists(), said
    code, said = execute([*start, "postprocess", "show", "out"], tmp_path, BARE)
    assert code == 0 and "converged" in said, said
    python = [ROOT / ".venv/bin/python", "-m", "postprocess", "show", "out"]
    code, said = execute(python, tmp_path, {**BARE, "PYTHONPATH": str(ROOT)})
    assert code == 0 and "converged" in said, said


def test_module_in_the_present_folder(tmp_path):
    """Without the starter a file that FreeFEM would read in a module's place is refused; one of another name is not."""
    package = tree(tmp_path / "package")
    quick = ["-h", 5, "-order", 1, "-estimate", 0, "-vtu", 0]
    (package / "contact/laws").mkdir(parents=True)
    (package / "contact/laws/own.idp").write_text("")
    assert run_in(package, script(DISC), *quick, out=tmp_path / "out").code == 0
    shutil.copytree(package / "edp/contact/laws", package / "input/contact/laws")
    for flags in (quick, [*quick[:4], "-accuracy", 0.25]):
        said = run_in(package, script(DISC), *flags, out=tmp_path / "never", expect=10).stdout
        assert said.count("\n") == 1
        assert "input/contact/laws" in said and "in place of the package's contact/laws/" in said
    shutil.rmtree(package / "input")
    here = tmp_path / "here"
    here.mkdir()
    shutil.copy(package / "freefem++.pref", here)
    shutil.copytree(package / "edp", here / "edp")
    said = run_in(here, package / script(DISC), *quick, out=tmp_path / "never", expect=10).stdout
    assert "another copy of the package" in said and not (tmp_path / "never").exists()
    shutil.rmtree(here / "edp")
    for name in ("edp", "meshes"):  # as make new does: own modules are there on purpose
        (here / name).symlink_to(package / name)
    (here / "contact/laws").mkdir(parents=True)
    shutil.copy(package / "edp/contact/laws/power.idp", here / "contact/laws")
    run_in(here, "edp/main.edp", *quick, out=tmp_path / "own")


@pytest.mark.parametrize("out", ["it's; touch F", '-1 "$(touch F)"'])
def test_picture_can_be_pasted(out, tmp_path):
    """The command that a run prints shall be that when it is pasted, whatever the names of its folders."""
    package, here = tree(tmp_path / "it's; `touch F`"), tmp_path / "here"
    here.mkdir()
    (here / "freefem++.pref").symlink_to(package / "freefem++.pref")
    (here / "edp").symlink_to(package / "edp")
    stdout = run_in(here, package / script(BLOCK), "-h", 5, *COARSE[2:], "-out", out).stdout
    command = plotted(stdout)
    _, said = execute(["sh", "-c", f"printf '%s\\n' {command}"], here)
    folder = f"./{out}" if out.startswith("-") else out
    words = [f"PYTHONPATH={package}/", f"{package}/.venv/bin/python", "-m", "postprocess", "state", f"{folder}/"]
    assert said.splitlines() == words and not list(tmp_path.rglob("F"))


def test_folder_with_a_semicolon(tmp_path):
    """freefem.sh shall refuse a folder that FreeFEM's lists of folders would cut in two."""
    package = tree(tmp_path / "a;b")
    code, stdout = execute(["sh", package / "edp/freefem.sh", "main.edp", "-help"], tmp_path, BARE)
    assert code == 10 and len(stdout.splitlines()) == 1 and "allowed: a path without ;" in stdout


@pytest.mark.parametrize("scene", [DISC, "sphere-on-block"])
def test_plot_without_a_window(scene, tmp_path):
    """-plot 1 shall be understood in the plane and in space; with -nw there is no window, and the run goes on."""
    result = run_in(ROOT, script(scene), "-h", 2, "-vtu", 0, "-estimate", 0, "-plot", 1, out=tmp_path / "out")
    assert "plot" in result.given and result.converged


# ---------------------------------------------------------------- meshes


def test_mesh_is_made_once(package):
    """A mesh shall be kept under a name with its parameters, taken again, and made anew when a .geo is newer."""
    generated = package / "meshes" / "generated"
    flags = ["-method", "newton", "-h", 2.5, "-R", 12, "-vtu", 0, *COARSE[2:]]
    before = set(listing(package))
    run_in(package, script(DISC), *flags)
    (name,) = [path for path in set(listing(package)) - before if path.endswith(".msh")]
    assert "h0.0625" in name
    assert "left0.203" in name  # 0.5 - 0.99 R / width
    assert "right0.797" in name
    mesh = package / name
    assert not [path for path in generated.iterdir() if path.suffix != ".msh"]

    text, stamp = mesh.read_text(), mesh.stat().st_mtime_ns
    run_in(package / "edp", "main.edp", *flags)
    assert mesh.stat().st_mtime_ns == stamp

    hour = 3600 * 10**9
    os.utime(mesh, ns=(stamp - 1000 * hour, stamp - 1000 * hour))
    run_in(package, script(DISC), *flags)
    assert mesh.stat().st_mtime_ns > stamp - hour
    assert mesh.read_text() == text


def test_same_shape_same_mesh(package):
    """The same shape in other units shall take the same mesh."""
    flags = ["-vtu", 0, *COARSE[2:]]
    run_in(package, script(DISC), *flags, "-h", 2)
    before = listing(package)
    metres = ["-width", 0.04, "-depth", 0.02, "-R", 0.01, "-gap", 0.0005, "-u0", 0.0025, "-d0", -0.00025, "-h", 0.002]
    run_in(package, script(DISC), *flags, *metres)
    assert listing(package) == before


# ---------------------------------------------------------------- whole or not at all


@pytest.mark.parametrize("word", ["\033[31mbody", "a" * 30000], ids=["escape", "long"])
def test_what_is_echoed(word, tmp_path):
    """Codes that a terminal would obey shall not come back, and a word of any length be refused at once."""
    (tmp_path / "a.case").write_text(f"{word} x\n")
    punch = ["edp/parts.edp", "-mesh", "edp/examples/punch/punch.geo", "-case", str(tmp_path / "a.case")]
    for words in (punch, [script(DISC), "-h", word[:3000]], [script(DISC), f"-{word[:3000]}", "1"]):
        done = subprocess.run([*FREEFEM, *words], cwd=ROOT, stdout=subprocess.PIPE, timeout=patience(10))
        assert done.returncode == 10 and done.stdout.count(b"\n") == 1, done.stdout
        assert b"\033" not in done.stdout and len(done.stdout) < 7000


def test_pipes(tmp_path):
    """A pipe as a case file, or as the table of a law, shall not be waited for."""
    os.mkfifo(tmp_path / "it's a pipe")
    law = f'contact contact master gap vertical law table "{tmp_path}/it\'s a pipe" d0 -0.05'
    case = (ROOT / "edp/examples/punch/punch.case").read_text()
    (tmp_path / "a.case").write_text(re.sub("contact contact .*", law, case))
    (tmp_path / "no.case").write_text('body "lo\tw" E 1 nu 0\n')
    words = ["-mesh", "edp/examples/punch/punch.geo", "-case"]
    for command, said in (
        (["edp/parts.edp", *words, tmp_path / "it's a pipe"], "a pipe or a device"),
        (["edp/parts-3d.edp", *words, tmp_path / "it's a pipe", "-distance", "exact"], "a pipe or a device"),
        (["edp/parts.edp", *words, tmp_path / "a.case"], "it's a pipe: no such file, or empty, a folder, a pipe"),
        (["edp/parts.edp", *words, tmp_path / "no.case"], "a control character"),
        ([script(DISC), "-law", "table", "-table", tmp_path / "it's a pipe"], "it's a pipe: cannot be read"),
    ):
        done = subprocess.run([*FREEFEM, *command], cwd=ROOT, capture_output=True, text=True, timeout=patience(15))
        assert done.returncode == 10 and done.stdout.count("\n") == 1 and said in done.stdout, done.stdout


def no_room_beyond(limit):
    """A preexec_fn: a limit on a file's size stands for a full disk: writing beyond it fails."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))


@pytest.mark.parametrize("words", cases_of([["-mesh", "{0}.geo"], None], [["-mesh", "{0}.geo", "-case", "{0}.case"]]))
def test_no_room_for_a_mesh(words, tmp_path):
    """Where there is no room for a mesh or its copy a run shall say so, with code 30, and blame no mesh."""
    folder = tmp_path / "tmp"
    folder.mkdir()
    start = ["edp/parts.edp", *words] if words else ["edp/main.edp", "-h", "0.5"]
    start += ["-check", "1"] if words else []
    env = environment(TMPDIR=str(folder), **({} if words else {"CONTACT_CACHE": str(folder)}))
    done = subprocess.run(
        [*FREEFEM, *(word.format("edp/examples/punch/punch") for word in start), "-out", str(tmp_path / "out")],
        cwd=tree(tmp_path / "package"),
        env=env,
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: no_room_beyond(500),
        timeout=patience(50),
    )
    assert done.returncode == 30, done.stdout
    assert done.stdout.splitlines()[-1].startswith("out of disk: "), done.stdout
    assert "tmp" in done.stdout.splitlines()[-1] and "-mesh" not in done.stdout
    assert not (tmp_path / "out").exists() and list(folder.rglob("*.msh")) == []


@pytest.mark.parametrize("flags", [[], ["-history", "1", "-steps", "2"]])
def test_folder_moved_during_a_run(flags, tmp_path):
    """A run whose results' folder is taken away shall end with one line and code 30."""
    command = [*FREEFEM, script(DISC), "-order", "2", "-h", "0.1", *flags, "-out", tmp_path / "out"]
    with subprocess.Popen(command, cwd=ROOT, env=environment(), stdout=subprocess.PIPE, text=True) as running:
        while not (tmp_path / "out/.run/.written").exists() and running.poll() is None:
            time.sleep(0.01)
        (tmp_path / "out").rename(tmp_path / "other")
        said = running.communicate(timeout=patience(50))[0]
    assert running.returncode == 30 and "could not be written whole" in said.splitlines()[-1], said
    assert files(tmp_path / "other") == [] and not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "limit, flags",
    cases_of(
        [(0, []), (20000, []), (1000, ["-states", "1"]), (60000, ["-states", "1"])],
        [(700, []), (5000, []), (40000, ["-states", "1"])],
    ),
)
def test_disk_full(tmp_path, limit, flags):
    """When files cannot be written to their end, the run shall fail, say so, and keep none of them."""
    out = tmp_path / "out"
    done = subprocess.run(
        [*FREEFEM, script(BLOCK), "-method", "newton", "-h", "1", "-estimate", "0", "-out", str(out), *flags],
        cwd=ROOT,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        preexec_fn=lambda: no_room_beyond(limit),
        timeout=patience(50),
    )
    assert done.returncode not in (0, 10, 20), done.stdout
    assert "could not be written whole" in done.stdout
    assert files(out) == being_written(out) == []


@pytest.mark.parametrize(
    "folder, typed", [("edp", "main.edp"), (".", "edp/main.edp -half 1"), ("edp", "-nw main.edp -h 2")]
)
def test_no_listing_and_no_display(package, folder, typed, tmp_path):
    """FreeFem++ and a script shall print the results alone and end well, whatever the user's own settings say.

    Without a flag, without a display; the last line comes through a pipe.
    """
    (tmp_path / ".freefem++.pref").write_text("verbosity = 2\n")
    env = {**BARE, "OPENBLAS_NUM_THREADS": "1", "HOME": str(tmp_path), "FF_VERBOSITY": "2"}
    code, said = execute(["FreeFem++", *typed.split(), "-out", tmp_path / "out"], package / folder, env)
    lines = said.splitlines()
    assert code == 0 and len(lines) <= 30 and lines[-1].startswith("  more "), said[-3000:]


def test_every_folder_is_quiet():
    """Wherever FreeFEM finds the package, it shall not list the modules."""
    found = [ROOT / "freefem++.pref", *(ROOT / "edp").rglob("freefem++.pref")]
    assert len(found) > 10 and all("\nverbosity = 0\n" in path.read_text() for path in found)


# ---------------------------------------------------------------- signs of life


@pytest.mark.parametrize("busy, terminal", [(0, True), (0, False), (10, True)])
def test_signs_of_life(tmp_path, busy, terminal):
    """A long run says on a terminal what it computes; a short one, or one without a terminal, prints nothing new."""
    start = 'include "solver/solver.idp"\n'
    text = (ROOT / script(DISC)).read_text()
    assert text.count(start) == 1
    for name in ("edp", "meshes", "freefem++.pref", "build"):
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "own.edp").write_text(text.replace(start, f"{start}progressDelay = {busy};\n"))
    shown, errors = pty.openpty()
    command = [*FREEFEM, "own.edp", "-h", "2", "-vtu", "0", "-out", tmp_path / "out"]
    screen = errors if terminal else subprocess.PIPE
    done = subprocess.run(command, cwd=tmp_path, env=environment(), stdout=subprocess.PIPE, stderr=screen, check=True)
    said = os.read(shown, 9999).decode() if select.select([shown], [], [], 0)[0] else ""
    signs = [
        "assembling the equations of 1",
        "factorising the matrix of 1",
        "solving a linear system: ",
        "estimating errors: result 1 of ",
    ]
    assert [sign in said for sign in signs] == [terminal and busy == 0] * 4, said
    assert bool(said) is (terminal and busy == 0) and not done.stderr
    assert not any(sign in done.stdout.decode() for sign in signs)
    os.close(errors)
    os.close(shown)


# ---------------------------------------------------------------- numbers that are none


def test_no_finite_numbers_are_null(tmp_path):
    """summary.json of a run that ends with NaN is JSON: null stands there, and the message says why."""
    ending = 'include "output/report/report.idp"'
    spoilt = 'converged = false; failure = "no finite solution"; residual = log(-1.); modelError = -log(0.);\n'
    text = (ROOT / script("disc-on-block")).read_text()
    assert text.count(ending) == 1
    for name in ("edp", "meshes", "freefem++.pref", "build"):
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "own.edp").write_text(text.replace(ending, spoilt + ending))
    flags = ["-h", 2, "-order", 1, "-estimate", 0, "-vtu", 0]
    done = run_in(tmp_path, "own.edp", *flags, out=tmp_path / "out", expect=20)
    assert (done.residual, done.modelError, done.message) == (None, None, "no finite solution")
    assert done.force > 0 and "NOT CONVERGED: no finite solution" in done.stdout
    folder, program = tmp_path / "listed", ["sh", ROOT / "edp/input/folder.sh", os.getpid()]
    assert execute([*program, "open", folder])[0] == 0
    text = '{"name": "at least, information", "motion": [-nan, 1, -inf],\n"way": nan}\n'
    (folder / ".run/summary.json").write_text(text)
    (folder / ".run/.ends").write_text(f"summary.json {len(text)}\n")
    assert execute([*program, "publish", folder, "finite"])[0] == 0
    found = {"name": "at least, information", "motion": [None, 1, None], "way": None}
    assert json.loads((folder / "summary.json").read_text()) == found
