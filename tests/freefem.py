"""Running scenes and snippets, reading what they wrote, and the invariants that every converged run keeps.

`run(scene, *flags)` runs a scene once per test session, whichever tests and workers ask for it, and checks it.
`snippet(folder, text, *flags)` runs a few lines of FreeFEM that use the package's modules.
`tree(folder)` copies the package, for tests that must not disturb this one's results and meshes.
"""

import contextlib
import fcntl
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import time
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from accounts import shared

ROOT = Path(__file__).resolve().parent.parent
MULTIGRID, FAST = (  # as built; the numbers in the names are those of what the plugins give the scripts
    ROOT / "build" / next((ROOT / "edp/input/without").glob(f"{name}-plugin-*.idp")).name
    for name in ("multigrid", "fast")
)
FREEFEM = ["FreeFem++", "-nw", "-v", "0"]
STORE = None  # the session's folder of runs: conftest.py
PLUGIN_SAYS = " load : P4 "  # 4.13's plugin, before anything else, whatever the verbosity

OPEN, LAW, WALL, TANGENT = 0, 1, 2, 3
SUMMARY_KEYS = set(
    "scene method converged adaptations newton newtonPerAdaptation factorisations backsolves force pressureMax "
    "overlapMax halfWidth wallPoints contactPoints modelError residual energy ndof points order h seconds "
    "parameters".split()
)
SECONDS_KEYS = set("mesh assembly factorisation contact total".split())
CONTACT_COLUMNS = tuple("x y weight overlap pressure lambda status threshold s tau".split())
CONTACT_COLUMNS += tuple("contact chain along normalX normalY".split())
SPACE_COLUMNS = ("x", "y", "z", *CONTACT_COLUMNS[2:], "normalZ")
FRICTION_COLUMNS = "shear slip slide shearX shearY shearZ slipX slipY slipZ".split()
MOVED = "two-bodies"  # no scene: a script that says what took its place
DEFAULT_RUN = float(os.environ.get("DEFAULT_RUN", "0.5"))  # CPU seconds of a default run here: run.py


def scenes():
    """The names of all scenes, in order."""
    names = {path.stem for path in (ROOT / "edp/scenes").glob("*.edp")}
    return sorted({"disc-on-block", *names} - {MOVED})


def script(scene):
    """The scene's script, relative to the repository's root; attraction/SCENE is one that also reads this option."""
    if "/" in scene:
        return f"tests/data/{scene}.edp"
    return "edp/main.edp" if scene == "disc-on-block" else f"edp/scenes/{scene}.edp"


def patience(runs):
    """Wall seconds after which what takes so many default runs hangs, on a machine that does eight things at a time."""
    return 8 * runs * DEFAULT_RUN


TIMEOUT = patience(150)


def environment(**changes):
    """The environment of a run: one thread, of OpenMP as well; ranks that wait yield; nothing of an enclosing make."""
    kept = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
    shared = {"OPENBLAS_NUM_THREADS": "1", "OMP_THREAD_LIMIT": "1", "OMPI_MCA_mpi_yield_when_idle": "1"}
    return {**kept, **shared, **changes}


def table(path):
    """A result table as a structured array, one entry a row; column names as in the file."""
    with open(path) as file:
        names = file.readline().strip().split(",")
        rows = [tuple(line.strip().split(",")) for line in file]
    return np.array([tuple(map(float, row)) for row in rows], dtype=[(name, float) for name in names])


class Run:
    """A finished run: exit code, output, folder, and its files read when they are asked for."""

    def __init__(self, code, stdout, folder):
        self.code, self.stdout, self.folder = code, stdout, Path(folder)

    @cached_property
    def summary(self):
        return json.loads((self.folder / "summary.json").read_text(), parse_constant=reject_constant)

    @cached_property
    def contact(self):
        return table(self.folder / "contact.csv")

    @cached_property
    def history(self):
        return table(self.folder / "history.csv")

    @cached_property
    def models(self):
        """(models, points): the fields after each model that was solved."""
        rows = table(self.folder / "adaptations.csv")
        return rows.reshape(-1, self.summary["points"])

    @property
    def load_step(self):
        """(models,): the load step that each model belongs to."""
        steps, adaptations = self.history["step"], self.history["adaptation"]
        first = np.ones(len(steps), bool)
        first[1:] = (np.diff(steps) != 0) | (np.diff(adaptations) != 0)
        return steps[first]

    def __getattr__(self, name):
        """run.force is run.summary["force"]."""
        try:
            return self.summary[name]
        except (KeyError, FileNotFoundError) as error:
            raise AttributeError(name) from error


def reject_constant(word):
    raise ValueError(f"summary.json contains {word}")


def flag_text(value):
    """A flag as the command line takes it; numbers with all their digits."""
    if isinstance(value, float):
        return repr(float(value))
    return str(value)


def data(name):
    """The text of a file of tests/data: a geometry, lines of FreeFEM."""
    return (ROOT / "tests/data" / name).read_text()


def named(value):
    """A parametrised test's name: its flags as they are typed."""
    return " ".join(map(flag_text, value)) if isinstance(value, list) else None


def cases_of(some, more):
    """A parametrised test's cases, each once."""
    return [*some, *(case for case in more if case not in some)]


def flag_lists(text):
    """The flags of each run of "-a 1 -b 2 | -c 3"."""
    return [part.split() for part in text.split("|")]


def interruptible():
    """A preexec_fn: Ctrl-C works as in a terminal; a job in the background is started with it ignored."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def interrupt(command, far_enough, cwd=ROOT, env=None):
    """Start a command and kill it, with all that it has started, once far_enough() holds.

    It runs behind everything else, so that it does not end while this process waits for its turn; one that did is begun
    again.
    """
    quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "process_group": 0}
    quiet |= {"cwd": cwd, "env": environment() if env is None else env, "preexec_fn": lambda: os.nice(19)}
    for _ in range(5):
        process = subprocess.Popen(list(map(str, command)), **quiet)
        end = time.monotonic() + TIMEOUT
        while process.poll() is None and not far_enough() and time.monotonic() < end:
            time.sleep(0.005)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        ended = process.wait()
        end = time.monotonic() + 5
        with contextlib.suppress(ProcessLookupError):  # what it had started keeps the folder until it has died, too
            while time.monotonic() < end:
                os.killpg(process.pid, 0)
                time.sleep(0.005)
        if ended == -signal.SIGKILL:
            return
    raise AssertionError("the command ended before it could be killed")


def execute(command, cwd=ROOT, env=None):
    """Run a command to its end; (code, output), without what it says only where it has to wait."""
    done = subprocess.run(
        list(map(str, command)),
        cwd=cwd,
        env=environment() if env is None else env,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        stdin=subprocess.DEVNULL,
        timeout=TIMEOUT,
    )
    stdout = done.stdout.decode(errors="replace").replace(PLUGIN_SAYS, "", 1)
    return done.returncode, re.sub(r"^gmsh (meshes|has been at work on) .*\n", "", stdout, flags=re.M)


@shared
def has_ipopt():
    """Whether this FreeFEM has the plugin ff-Ipopt: Debian 13's has not."""
    return execute([*FREEFEM, "edp/scenes/ipopt/plugin.edp"])[0] == 0


def skip_without_ipopt(name):
    if "disc-on-block-ipopt" in str(name) and not has_ipopt():
        pytest.skip("FreeFEM has no plugin ff-Ipopt")


def run(scene, *flags, expect=0):
    """The run of a scene with these flags; its exit code must be `expect`. Shared: its files must not be changed.

    Flags are pairs of a name and a value; in another order they are the same run.

    The elements are P1, whatever the scene's default, unless -order is among the flags: most meshes are made for it.
    The error is not estimated unless a flag asks for it: that is half of a short run.
    """
    skip_without_ipopt(scene)
    if "-order" not in flags:
        flags = (*flags, "-order", 1)
    if not {"-estimate", "-accuracy"} & set(flags):
        flags = (*flags, "-estimate", 0)
    pairs = sorted(zip(flags[::2], flags[1::2], strict=True), key=lambda pair: pair[0])
    result = stored(scene, tuple(flag_text(word) for pair in pairs for word in pair))
    assert result.code == expect, f"exit code {result.code} of {scene} {flags}:\n{result.stdout[-2000:]}"
    if expect == 0:
        check_invariants(result)
    elif expect == 20:
        check_numbers(result)
        check_last_model(result)
    return result


@shared
def stored(scene, flags):
    key = hashlib.sha256(repr((scene, flags)).encode()).hexdigest()[:16]
    STORE.mkdir(parents=True, exist_ok=True)
    record = STORE / f"{key}.json"
    with open(STORE / f"{key}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not record.exists():
            code, stdout = execute([*FREEFEM, script(scene), *flags, "-vtu", "0", "-out", STORE / key])
            record.write_text(json.dumps([code, stdout]))
    return Run(*json.loads(record.read_text()), STORE / key)


def solve_rows(folder, scene, rows, *flags):
    """The summaries of many problems on one mesh, each from its own start; rows: flags of each. All must converge."""
    given = [dict(zip(words[::2], map(flag_text, words[1::2]), strict=True)) for words in rows]
    names = list(dict.fromkeys(name for row in given for name in row))
    lines = [",".join(name[1:] for name in names), *(",".join(row.get(name, "") for name in names) for row in given)]
    (folder / "table.csv").write_text("\n".join(lines) + "\n")
    words = ["-rows", folder / "table.csv", "-rows-start", "cold", "-estimate", 0, *flags]
    run_in(ROOT, script(scene), *words, out=folder / "rows")
    return [row["summary"] for row in json.loads((folder / "rows/rows.json").read_text())["rows"]]


def run_in(cwd, name, *flags, out=None, expect=0, env=None):
    """One run, not shared, of a script as a user would start it in `cwd`; out: its results; expect None: any code."""
    skip_without_ipopt(name)
    code, stdout = execute([*FREEFEM, name, *map(flag_text, flags), *(["-out", out] if out else [])], cwd, env)
    assert expect in (code, None), f"exit code {code} of {name} {flags}:\n{stdout[-2000:]}"
    return Run(code, stdout, out or cwd)


def refusal(folder, scene, *flags):
    """The one line by which a scene refuses flags; nothing is written."""
    done = run_in(ROOT, script(scene), *flags, out=folder / "out", expect=10)
    assert done.stdout.count("\n") == 1 and not (folder / "out").exists(), done.stdout
    return done.stdout


def part(folder, mesh, case, *flags, space=False, script=None, expect=0):
    """One run, not shared, of a case's text on a mesh, a file or its text; the results are in folder/out."""
    folder.mkdir(exist_ok=True)
    if not isinstance(mesh, Path):
        text, mesh = mesh, folder / ("a.msh" if mesh.startswith("$") else "a.geo")
        mesh.write_text(text)
    (folder / "a.case").write_text(case)
    words = ["-mesh", mesh, "-case", folder / "a.case", *([] if "-vtu" in flags else ["-vtu", 0]), *flags]
    return run_in(ROOT, script or f"edp/parts{'-3d' * space}.edp", *words, out=folder / "out", expect=expect)


def snippet(folder, text, *flags, expect=0):
    """Output of a FreeFEM script that stands beside the package; `include`s are relative to edp/, as in the scenes."""
    for name in ("edp", "meshes", "freefem++.pref"):
        if not (folder / name).exists():
            (folder / name).symlink_to(ROOT / name)
    (folder / "snippet.edp").write_text(TELL + text)
    code, stdout = execute([*FREEFEM, "snippet.edp", *map(flag_text, flags)], folder)
    assert code == expect, f"exit code {code}:\n{stdout[-3000:]}"
    return stdout


# tell("name", values) prints a line that told() reads
TELL = data("tell.edp")


def plotted(stdout):
    """The command that a run says to draw it with."""
    (line,) = (line for line in stdout.splitlines() if line.startswith("  plot "))
    return line.removeprefix("  plot").strip()


def told(stdout):
    """What tell() printed: {name: values}."""
    lines = (line.split() for line in stdout.splitlines() if line.startswith("told "))
    return {name: np.array(values, float) for _, name, *values in lines}


def scene_text(scene, until='include "solver/solve.idp"'):
    """The scene's own lines: bodies, obstacle and load, up to the solution."""
    text = (ROOT / script(scene)).read_text()
    assert text.count(until) == 1
    return text.split(until)[0]


def tree(folder):
    """A copy of the package without results, meshes and environment: what `git clone` gives."""
    folder.mkdir(parents=True)
    for name in ("edp", "meshes"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("generated", "*.msh"))
    for name in ("freefem++.pref", "Makefile"):
        shutil.copy(ROOT / name, folder)
    return folder


def wait_for(what, runs=30):
    end = time.monotonic() + patience(runs)
    while not what():
        assert time.monotonic() < end
        time.sleep(0.005)


def listing(folder):
    """Every file and folder below, to see what a run has left behind; a folder's lock has another number each time."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if not path.name.startswith(".lock-"))


def files(folder):
    """The files that a run has put into its folder, not what it keeps for the next run in .run."""
    return sorted(path.name for path in Path(folder).iterdir() if path.name != ".run")


def being_written(folder):
    """What a run is writing at present, or was when it was killed."""
    return [path.name for path in (Path(folder) / ".run").glob("*") if not path.name.startswith(".")]


# ---------------------------------------------------------------- invariants


def check_invariants(run):
    """What holds for every converged run of every scene and method."""
    summary, contact = run.summary, run.contact
    assert summary.keys() >= SUMMARY_KEYS
    assert summary["seconds"].keys() >= SECONDS_KEYS
    columns = tuple(name for name in contact.dtype.names if name not in FRICTION_COLUMNS)
    assert columns in (CONTACT_COLUMNS, SPACE_COLUMNS)
    assert len(contact) == summary["points"]
    assert summary["converged"] is True
    assert summary["residual"] <= summary["parameters"]["tol"]
    if summary["modelError"] >= summary["parameters"]["eps"]:  # the bound of the force has ended the loop
        assert summary["estimates"]["parts"]["model"] <= 0.1 * summary["accuracy"]["asked"] * abs(summary["force"])
    assert len(summary["newtonPerAdaptation"]) == len(run.models)
    assert sum(summary["newtonPerAdaptation"]) == summary["newton"] == len(run.history)
    check_numbers(run)
    check_last_model(run)
    check_fields(run)
    check_thresholds(run)
    check_equilibrium(run)


def check_numbers(run):
    """No NaN in any file; infinity is the threshold, T or tau, of a point without a wall, and nothing else."""
    assert "nan" not in run.stdout.lower()
    for rows in (run.contact, run.history, run.models):
        for name in rows.dtype.names:
            assert not np.isnan(rows[name]).any(), name
            assert name in ("threshold", "tau") or np.isfinite(rows[name]).all(), name


def check_fields(run):
    """Signs and complementarity: pressure only in contact, the wall's share only at the wall."""
    summary, contact = run.summary, run.contact
    status, pressure, share = contact["status"], contact["pressure"], contact["lambda"]
    nodal = contact["weight"] * pressure
    assert set(status) <= {OPEN, LAW, WALL, TANGENT}
    assert TANGENT not in status or summary["parameters"].get("model") == "linear"
    assert (contact["weight"] > 0).all()
    assert "z" in contact.dtype.names or (np.diff(contact["x"]) > 0).all()
    # a point on the law is linearised: its pressure is off the law, and so below 0 at the edge, by the residual at most
    if "stability" not in summary:  # surfaces that attract pull
        assert (nodal >= -summary["parameters"]["tol"] * np.linalg.norm(nodal)).all()
    assert (pressure[status == OPEN] == 0).all()
    # conjugate gradients reach the wall to the tolerance, the direct solvers exactly
    slack = summary["parameters"]["tol"] if summary["method"] == "xnewton" else 0
    assert (share >= -max(slack, 1e-12) * max(pressure.max(), 0)).all()
    assert (share[status != WALL] == 0).all()
    wall = status == WALL
    d0 = summary["parameters"]["d0"]
    assert (contact["overlap"] == contact["s"] + d0).all()
    assert (contact["threshold"] == contact["tau"] + d0).all()
    off = abs(contact["overlap"] - contact["threshold"])[wall]
    assert (off <= 10 * slack * abs(summary["approach"])).all()
    assert summary["wallPoints"] == wall.sum()
    assert summary["contactPoints"] == (status != OPEN).sum()
    if summary.get("rounds", 1) == 1:
        assert summary["force"] == np.sum(nodal) or abs(np.sum(nodal) / summary["force"] - 1) < 1e-12
    assert summary["pressureMax"] == pressure.max()
    assert summary["overlapMax"] == contact["overlap"].max()


def check_thresholds(run):
    """Proposition 4.1: from one model of a load step to the next no threshold decreases, at any point."""
    threshold, step = run.models["tau"], run.load_step
    assert len(step) == len(threshold)
    for (before, after), same in zip(pairwise(threshold), np.diff(step) == 0, strict=True):
        assert not same or (after >= before).all()


def check_last_model(run):
    """The contact table is that of the last model that was solved; a path may end in a state that was found ahead."""
    if "pullOff" in run.summary:
        away = np.abs(run.models["s"] - run.contact["s"]).max(axis=1)
        assert away.min() <= 1e-12 * np.abs(run.contact["s"]).max()
        return
    for name in ("overlap", "pressure", "lambda", "threshold", "s", "tau"):
        assert (run.models[name][-1] == run.contact[name]).all(), name


def check_equilibrium(run):
    """The contact's force and moment against those of the supports of the block."""
    summary, contact = run.summary, run.contact
    force, size = summary["force"], abs(summary["force"])
    reach = np.hypot(contact["x"], contact["y"]).max()
    if "z" in contact.dtype.names:
        check_equilibrium_in_space(summary, contact, force)
        return
    assert abs(summary["reactionY"] - force - weight_of_block(summary)) <= 1e-9 * (size + abs(weight_of_block(summary)))
    if summary["scene"] in ("patch-test", "confined-block"):
        return  # the sliding sides carry too
    if "friction" in summary:
        balance = summary["reactionX"] + summary["contacts"][0]["shearForce"][0]
        assert abs(balance) <= 10 * summary["parameters"]["tol"] * size
        return
    assert abs(summary["reactionX"]) <= 1e-9 * size or summary.get("rounds", 1) > 1
    assert abs(summary["reactionMoment"] + summary["contactMoment"]) <= 1e-9 * size * reach
    if summary.get("rounds", 1) == 1 and summary["parameters"].get("geometry") != "axisymmetric":
        moment = -np.sum(contact["x"] * contact["weight"] * contact["pressure"])
        assert abs(summary["contactMoment"] - moment) <= 1e-9 * size * reach


def weight_of_block(summary):
    """The downward body force on a block with free sides."""
    flags = summary["parameters"]
    side = flags["width"] if "reactionZ" in summary and "width" in flags else 1
    return flags["bodyForce"] * flags["width"] * side * flags["depth"] if flags.get("bodyForce") else 0


def check_equilibrium_in_space(summary, contact, force):
    """The same for contact forces along -z: three forces and three moments; across mirrors they vanish by symmetry."""
    nodal, size = contact["weight"] * contact["pressure"], abs(force)
    reach = np.abs([contact["x"], contact["y"], contact["z"]]).max()
    block = weight_of_block(summary)
    assert abs(summary["reactionZ"] - force - block) <= 1e-9 * (size + abs(block))
    others = [key for key in summary if key.startswith(("reaction", "contactMoment")) and key != "reactionZ"]
    assert len(others) == 7
    symmetry = summary["parameters"].get("symmetry", "whole")
    if summary["scene"] in ("sphere-on-plane", "two-spheres"):
        symmetry = "quarter"
    left = {"whole": others, "half": ["reactionY", "reactionMomentX", "contactMomentX"], "quarter": []}[symmetry]
    assert all(summary[key] == 0 for key in others if key not in left)
    if symmetry == "quarter" or summary["scene"] == "patch-test-3d" or block or "friction" in summary:
        return  # symmetric; the sliding sides carry too; the weight has its moments
    for axis in "XY":
        assert abs(summary[f"reaction{axis}"]) <= 1e-9 * size
    for axis, moment in (("X", -np.sum(contact["y"] * nodal)), ("Y", np.sum(contact["x"] * nodal))):
        if f"contactMoment{axis}" not in left:
            continue
        assert abs(summary[f"contactMoment{axis}"] - moment) <= 1e-9 * size * reach
        assert abs(summary[f"reactionMoment{axis}"] + moment) <= 1e-9 * size * reach
    assert abs(summary["reactionMomentZ"]) <= 1e-9 * size * reach
