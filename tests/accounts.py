"""What each test costs and reads: a plugin of pytest.

CPU, starts of FreeFEM and files are counted for a test alone; what tests share (stored runs, fixtures of a module or a
session, cached functions) has an account of its own, named in the `uses` of all who use it. Programs are watched by
reads.c, where there is a compiler for it; one that is started with an environment of its own escapes, and its test
then reads everything.

A test that passed is not run again as long as nothing that it read has changed; --cache-clear runs it all the same.
"""

import ast
import contextlib
import functools
import hashlib
import json
import os
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
HERE = ROOT / "tests"
UNWATCHED = ("results/", "build/", ".venv", ".pytest_cache/", ".ruff_cache/", ".mypy_cache/", "meshes/generated/.")
ALWAYS = ["tests/conftest.py", "tests/freefem.py", "tests/accounts.py", "pyproject.toml"]
SKIPPED = {".git", ".venv", ".venv-peers", "__pycache__", "build", "generated", "results"}
SKIPPED |= {".pytest_cache", ".ruff_cache", ".mypy_cache"}
TOOLS = "FreeFem++ FreeFem++-mpi gmsh mawk python3 sh ccx chromium mpiexec make".split()
EVERYTHING = "everything"
UNCHANGED_TESTS = "unchanged"
UNCHANGED = pytest.StashKey[int]()
BEGAN = time.time_ns()

base = None  # the session's folder, shared by its workers
frames = []
imported = {}  # what modules beside the tests read when they are imported, by file
fixtures = {}  # labels of fixtures that tests share, by place, name and parameter


# ---------------------------------------------------------------- accounts


def cpu():
    """CPU seconds of this process and of the programs that it has waited for."""
    own, children = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return own.ru_utime + own.ru_stime + children.ru_utime + children.ru_stime


class Frame:
    """What is done for a label, until it ends; what is begun within has an account of its own."""

    def __init__(self, label):
        self.label, self.inner, self.uses, self.reads, self.outcome = label, 0.0, set(), set(), ""
        self.log = base / f"reads-{os.getpid()}-{id(self)}"

    def __enter__(self):
        self.began = cpu()
        frames.append(self)
        self.tell()
        return self

    def tell(self):
        """Programs started from now on belong here."""
        os.environ |= {"READS_FOR": self.label.replace("\0", " "), "READS_TO": str(self.log)}

    def __exit__(self, *_):
        used = cpu() - self.began
        frames.pop()
        if frames:
            frames[-1].inner += used
            frames[-1].uses.add(self.label)
            frames[-1].tell()
        starts = 0
        lost = self.log.with_name(f"{self.log.name}.lost")
        if lost.exists():  # a program could not write down what it read
            self.reads.add(EVERYTHING)
            lost.unlink()
        if self.log.exists():
            for line in set_of_lines(self.log):
                kind, _, name = line.partition(" ")
                starts += kind == "program" and name.split(" ")[0].rsplit("/", 1)[-1].startswith("FreeFem++")
                if kind == "read":
                    self.reads.add(name)
            self.log.unlink()
        row = {"label": self.label, "cpu": used - self.inner, "starts": starts, "outcome": self.outcome}
        write_row(row | {"uses": sorted(self.uses)}, self.reads)


def write_row(row, reads):
    row["reads"] = sorted(filter(None, map(source, reads)))
    with (base / f"accounts-{os.getpid()}").open("a") as file:
        file.write(json.dumps(row) + "\n")


def set_of_lines(path):
    """Its lines: those of reads once, those of programs as often as they were started."""
    lines = path.read_text(errors="replace").splitlines()
    programs = [line for line in lines if line.startswith("program ")]
    return [*programs, *{line for line in lines if line.startswith("read ")}]


def source(name):
    """The file of the package that decides on what stands in one that was opened; None: of no account."""
    if "__pycache__" in name:
        folder, _, file = name.rpartition("__pycache__/")
        return f"{folder}{file.split('.')[0]}.py" if file else None
    if name.startswith("meshes/generated/") and name.endswith(".msh"):
        return f"meshes/{name.split('/')[2].split('_')[0]}.geo"
    if name.startswith(".git/"):
        return EVERYTHING
    return None if name.startswith(UNWATCHED) or name == "meshes/generated" else name


def shared(function):
    """A cached function whose account all who call it share."""
    done = {}

    @functools.wraps(function)
    def called(*arguments):
        if arguments not in done:
            label = f"call {function.__module__}.{function.__qualname__}{arguments}"
            with Frame(label) if frames else contextlib.nullcontext():
                done[arguments] = label, function(*arguments)
        elif frames:
            frames[-1].uses.add(done[arguments][0])
        return done[arguments][1]

    called.cache_clear = done.clear
    return called


def watch(event, arguments):
    """Files and folders that this process opens itself, and programs that it starts unwatched."""
    collecting = not frames or frames[-1].label.startswith("module ")
    if event in ("open", "os.listdir", "os.scandir"):
        own = importing() if collecting else None
        reads = imported.setdefault(own, set()) if own else frames[-1].reads if frames else None
        path = arguments[0]
        if isinstance(path, bytes):
            path = os.fsdecode(path)
        if reads is not None and (path is None or isinstance(path, str)):
            name = os.path.realpath(path or ".")
            if name.startswith(f"{ROOT}/"):
                reads.add(name[len(str(ROOT)) + 1 :])
    elif event == "subprocess.Popen" and frames:
        env = arguments[3]
        if "LD_PRELOAD" not in (os.environ if env is None else env):
            frames[-1].reads.add(EVERYTHING)


def importing():
    """The file of tests/ whose own lines are being executed, as when it is imported; None: none."""
    frame = sys._getframe(1)
    while frame:
        if frame.f_code.co_name == "<module>" and frame.f_code.co_filename.startswith(f"{HERE}/"):
            return frame.f_code.co_filename[len(str(ROOT)) + 1 :]
        frame = frame.f_back
    return None


sys.addaudithook(watch)


def build_watcher():
    """reads.c as a library, where there is a compiler."""
    library = base / "reads.so"
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler and not library.exists():
        new = library.with_suffix(f".{os.getpid()}")
        done = subprocess.run([compiler, "-O1", "-shared", "-fPIC", "-o", new, HERE / "reads.c", "-ldl"])
        if done.returncode == 0:
            new.rename(library)
    if library.exists():
        os.environ |= {"LD_PRELOAD": str(library), "READS_BELOW": str(ROOT)}


# ---------------------------------------------------------------- what has not changed


@functools.cache
def imports(file):
    """The files of tests/ that a file there imports, whatever the depth; "postprocess" stands for all of that."""
    found = set()
    for node in ast.walk(ast.parse((ROOT / file).read_text())):
        names = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
        names += [f"{names[0]}.{alias.name}" for alias in node.names] if names else []  # a module of a folder of tests
        names += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        for name in names:
            if name.split(".")[0] == "postprocess":
                found.add("postprocess")
            for place in ("tests", "tests/campaigns"):
                path = f"{place}/{name.replace('.', '/')}.py"
                if path != file and path not in found and (ROOT / path).exists():
                    found |= {path} | imports(path)
    return frozenset(found)


@functools.cache
def digest(name):
    """Of what a test has read: a file's content, a folder's names, all there is."""
    path = ROOT / name
    if name == "postprocess" or name == EVERYTHING:
        parts = []
        for folder, folders, files in os.walk(ROOT if name == EVERYTHING else path):
            folders[:] = sorted(set(folders) - SKIPPED)
            parts += [digest(os.path.relpath(os.path.join(folder, file), ROOT)) for file in sorted(files)]
        return hashlib.sha256("".join(map(str, parts)).encode()).hexdigest()[:16]
    if path.is_dir():
        seen = sorted(entry for entry in os.listdir(path) if entry not in ("generated", "__pycache__"))
        return hashlib.sha256("\n".join(seen).encode()).hexdigest()[:16]
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16] if path.is_file() else "-"


def tools():
    """The programs that runs stand on, and the plugins."""
    found = [sys.version, digest("tests/accounts.py")]
    for path in [*map(shutil.which, TOOLS), *sorted((ROOT / "build").glob("*.so"))]:
        found += [f"{path} {os.stat(path).st_size} {os.stat(path).st_mtime}"] if path else []
    return hashlib.sha256("\n".join(found).encode()).hexdigest()[:16]


def read_by(rows):
    """By label: everything that a test has read, itself or by what it shares."""
    own, uses = {}, {}
    for row in rows:
        own.setdefault(row["label"], set()).update(row["reads"])
        uses.setdefault(row["label"], set()).update(row["uses"])

    @functools.cache
    def every(label):
        found = set(own.get(label, [] if label.startswith("module ") else [EVERYTHING]))
        for other in uses.get(label, ()):
            found |= every(other)
        return frozenset(found)

    return every


@functools.cache
def state(reads):
    """Of the files, tuple of names, that a test reads: changes with each of them."""
    return hashlib.sha256("".join(map(digest, reads)).encode()).hexdigest()[:16]


def known(config):
    """{test: (what it read, in which state)} of those that passed with these tools."""
    if not hasattr(config, "cache") or not os.environ.get("LD_PRELOAD"):
        return None
    kept = config.cache.get("unchanged", {})
    if kept.get("tools") != tools():
        return {}
    sets = [tuple(kept["files"][k] for k in numbers) for numbers in kept["sets"]]
    return {name: (sets[number], was) for name, (number, was) in kept["tests"].items()}


def remember(config, rows):
    """Add the tests that passed to those that need not run again."""
    tests = known(config)
    if tests is None:
        return
    digest.cache_clear()
    state.cache_clear()
    every = read_by(rows)

    @functools.cache
    def touched(name):
        path = ROOT / name
        return path.is_file() and path.stat().st_mtime_ns > BEGAN

    for row in rows:
        name = row["label"]
        if "::" not in name or name.startswith(("fixture ", "call ", "module ")):
            continue
        tests.pop(name, None)
        file = name.split("::")[0]
        modules = {file} | imports(file) | set(ALWAYS)
        reads = every(name) | modules | set().union(*(every(f"module {module}") for module in modules))
        if row["outcome"] == "passed" and not any(map(touched, reads)):
            reads = tuple(sorted(reads))
            tests[name] = reads, state(reads)
    files = {name: k for k, name in enumerate(sorted({name for reads, _ in tests.values() for name in reads}))}
    sets = {reads: k for k, reads in enumerate(sorted({reads for reads, _ in tests.values()}))}
    kept = {"tools": tools(), "files": list(files), "sets": [[files[name] for name in reads] for reads in sets]}
    kept["tests"] = {name: [sets[reads], was] for name, (reads, was) in tests.items()}
    config.cache.set("unchanged", kept)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config, items):
    tests = known(config) or {}
    left_out = [
        item for item in items if item.nodeid in tests and state(tests[item.nodeid][0]) == tests[item.nodeid][1]
    ]
    if left_out:
        config.hook.pytest_deselected(items=left_out)
        gone = set(left_out)
        items[:] = [item for item in items if item not in gone]
        config.stash[UNCHANGED] = len(left_out)


# ---------------------------------------------------------------- pytest's hooks


@pytest.hookimpl(tryfirst=True)
def pytest_sessionstart(session):
    global base
    base = session.config._tmp_path_factory.getbasetemp()
    if os.environ.get("PYTEST_XDIST_WORKER"):  # its folder lies in the session's
        base = base.parent
    build_watcher()


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector):
    if not isinstance(collector, pytest.Module):
        return (yield)
    with Frame(f"module {collector.nodeid}"):
        return (yield)


def pytest_collection_finish():
    for file, reads in imported.items():
        write_row({"label": f"module {file}", "cpu": 0, "starts": 0, "outcome": "", "uses": []}, reads)


@pytest.hookimpl(wrapper=True)
def pytest_fixture_setup(fixturedef, request):
    if fixturedef.scope == "function" or not frames:
        return (yield)
    place = fixturedef.baseid, fixturedef.argname, repr(getattr(request, "param", ""))
    fixtures[place] = "fixture " + " ".join(place)
    with Frame(fixtures[place]):
        return (yield)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_protocol(item):
    with Frame(item.nodeid) as frame:
        result = yield
        params = getattr(getattr(item, "callspec", None), "params", {})
        for (place, name, param), label in fixtures.items():
            if item.nodeid.startswith(place) and name in item.fixturenames and param == repr(params.get(name, "")):
                frame.uses.add(label)
        return result


def pytest_runtest_logreport(report):
    if frames and (report.when == "call" or report.outcome != "passed"):
        frames[-1].outcome = report.outcome if frames[-1].outcome in ("", "passed") else frames[-1].outcome


def pytest_terminal_summary(terminalreporter, config):
    if config.stash.get(UNCHANGED, 0):
        terminalreporter.write_line(
            f"{config.stash[UNCHANGED]} tests passed before, and nothing that they read has changed since: not run "
            "(--cache-clear runs them)"
        )


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node):
    node.config.stash[UNCHANGED] = getattr(node, "workeroutput", {}).get(UNCHANGED_TESTS, 0)


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session):
    unchanged = session.config.stash.get(UNCHANGED, 0)
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput[UNCHANGED_TESTS] = unchanged
        return
    if unchanged and session.exitstatus == pytest.ExitCode.NO_TESTS_COLLECTED:
        session.exitstatus = pytest.ExitCode.OK
    files = [] if base is None else sorted(base.glob("accounts-*"))
    rows = [json.loads(line) for file in files for line in file.read_text().splitlines()]
    if not rows:
        return
    remember(session.config, rows)
    if os.environ.get("ACCOUNTS"):
        with open(os.environ["ACCOUNTS"], "a") as file:
            file.writelines(json.dumps(row) + "\n" for row in rows)
