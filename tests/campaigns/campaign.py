"""Campaigns: many runs of the scenes, a CSV row for each; interrupted and started again, they go on where they were.

A campaign is a list of `Case`s, each a scene's script with its flags. `run(cases, path)` executes those that `path` has
no row of yet. What makes a row current are the case's name, script and flags and the sources, comments aside. The
sources are copied first, so that a file edited meanwhile does not mix two versions. Runs that do not converge, crash or
take too long are rows too: the column `status` says so.

Seconds: `cpu`, `seconds_*` are process CPU seconds, told by the run itself. From outside are measured `wall`, of the
whole process, start to end, `used`, its CPU seconds with those of the processes that it starts, and `memory`, its
greatest resident set in MB. One BLAS thread. A case with several repeats gives the median of each of these and of
`costRatio`; everything else is that of the first repeat.
"""

import contextlib
import csv
import functools
import hashlib
import io
import json
import os
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from postprocess import problem_rows
from postprocess.progress import Progress, expect

ROOT = Path(__file__).resolve().parents[2]
RESULTS_FOLDER = Path(os.environ.get("CONTACT_RESULTS") or ROOT / "results").absolute()
CACHE = Path(os.environ["CONTACT_CACHE"]).absolute() if os.environ.get("CONTACT_CACHE") else None
FREEFEM = ("FreeFem++", "-nw", "-v", "0")
THREADS = 1  # of BLAS, in every run
REPEATS_END = 20.0  # wall seconds of a case after which it is not repeated once more
WEIGHED = 0.25  # seconds of a default run on the machine whose seconds the cases' weights are
STATUS = {0: "converged", 20: "not converged", 10: "refused"}  # by exit code; every other one is a crash

# Columns of every campaign: what was asked for, how it ended, what it cost and what it gave.
CASE = "name script flags sources".split()
PARAMETERS = "method law kappa m p0 beta d0 E nu R gap u0 h order grading aspect offset T0 tol eps steps".split()
PARAMETERS += "threshold inner start preconditioner".split()
ENDED = "status message repeats".split()
COUNTS = "adaptations newton kernelNewton factorisations backsolves contactPoints wallPoints ndof points".split()
RESULTS = "residual modelError force pressureMax overlapMax halfWidth energy".split()
TIMES = "wall cpu used memory costRatio seconds_mesh seconds_assembly seconds_factorisation seconds_contact".split()
MACHINE = "machine cores freefem threads commit day".split()
COLUMNS = [*CASE, "scene", *PARAMETERS, *ENDED, *COUNTS, *RESULTS, *TIMES, *MACHINE]
WORDS = frozenset([*CASE, "scene", *MACHINE, "status", "message"])


@dataclass(frozen=True)
class Case:
    """One run: part of the campaign it belongs to, script, flags; `weight`: guess of its seconds, for the time left.

    program: what executes the script, if not FreeFEM.
    """

    name: str
    script: str
    flags: tuple[str, ...]
    timeout: float = 300.0
    repeats: int = 1
    weight: float = 1.0
    program: tuple[str, ...] = ()

    @property
    def key(self) -> tuple[str, str, str]:
        return self.name, self.script, " ".join(self.flags)

    @property
    def parameters(self) -> dict[str, str]:
        return {flag[1:]: value for flag, value in zip(self.flags[::2], self.flags[1::2], strict=True)}


def case(
    name: str, scene: str = "disc-on-block", timeout: float = 300, repeats: int = 1, weight: float = 1, **flags
) -> Case:
    """A case from keyword flags: case("grid", kappa=1e6, order=2). With method="ipopt" the script is that method's."""
    texts = tuple(text for flag, value in flags.items() for text in (f"-{flag}", flag_text(value)))
    return Case(name, script_of(scene, flags.get("method")), texts, timeout, repeats, weight)


def script_of(scene: str, method: str | None = None) -> str:
    if method == "ipopt":
        return f"edp/scenes/{scene}-ipopt.edp"
    if scene.startswith("parts"):
        return f"edp/{scene}.edp"
    return "edp/main.edp" if scene == "disc-on-block" else f"edp/scenes/{scene}.edp"


def flags_of(row: dict[str, str]) -> dict[str, str]:
    """The flags of a row's run, as they were given."""
    texts = row["flags"].split()
    return dict(zip(texts[::2], texts[1::2], strict=True))


def flag_text(value: object) -> str:
    """A flag's value as the command line takes it: short where that is exact."""
    if isinstance(value, float):
        return f"{value:g}" if float(f"{value:g}") == value else repr(float(value))
    return str(value)


# ---------------------------------------------------------------- sources


def sources_digest(root: Path) -> str:
    """What the runs depend on: scripts, added files and the meshes' sources, without comments and blank space."""
    digest = hashlib.sha256()
    for path in source_files(root):
        text = re.sub(r"//[^\n]*", "", path.read_text(encoding="utf-8"))
        digest.update(f"{path.relative_to(root)}\0{' '.join(text.split())}\0".encode())
    return digest.hexdigest()[:12]


def source_files(root: Path) -> list[Path]:
    below = [f"edp/**/*.{kind}" for kind in "edp idp sh awk txt cpp".split()]
    below += ["edp/examples/**/*.geo", "edp/examples/**/*.case", "edp/input/**/*.py", "meshes/*.geo"]
    below += ["*.py", "*.geo", "*.case"]  # of a copy: what is added
    found = {path for pattern in below for path in root.glob(pattern)}
    return sorted(path for path in found if path.is_file())


@contextlib.contextmanager
def frozen_sources(root: Path, files: dict[str, str] | None = None):
    """A copy of the package without results; generated meshes are shared with the original, being named by content."""
    with tempfile.TemporaryDirectory(prefix="campaign-") as name:
        copy = Path(name)
        for path in [*source_files(root), *root.glob("freefem++.pref"), *root.glob("edp/**/freefem++.pref")]:
            target = copy / path.relative_to(root)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, target)
        (copy / "meshes").mkdir(exist_ok=True)
        if not CACHE:
            (root / "meshes" / "generated").mkdir(parents=True, exist_ok=True)
            (copy / "meshes" / "generated").symlink_to(root / "meshes" / "generated")
        if (root / "build").exists():
            (copy / "build").symlink_to(root / "build")
        for relative, text in (files or {}).items():
            (copy / relative).write_text(text)
        yield copy


@functools.cache
def machine() -> dict[str, object]:
    """Columns MACHINE: this computer, the package's commit ("+": its sources were changed since) and the day, UTC."""
    model = "unknown"
    with contextlib.suppress(OSError):
        found = re.search(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
        model = found.group(1).strip() if found else model
    version = "unknown"
    with tempfile.TemporaryDirectory() as name, contextlib.suppress(OSError, subprocess.SubprocessError):
        (Path(name) / "version.edp").write_text("exit(0);\n")
        command = ["FreeFem++", "-nw", "-v", "1", "version.edp"]
        head = subprocess.run(command, cwd=name, capture_output=True, timeout=30, stdin=subprocess.DEVNULL).stdout
        found = re.search(rb"FreeFem\+\+ +v?([\w.]+)", head)
        version = found.group(1).decode() if found else version
    return {
        "machine": model,
        "cores": os.cpu_count(),
        "freefem": version,
        "threads": THREADS,
        "commit": commit_of(ROOT),
        "day": time.strftime("%Y-%m-%d", time.gmtime()),
    }


def commit_of(root: Path) -> str:
    """The commit that is checked out, "+" behind it if sources were changed since; "unknown" without git."""
    said = []
    for words in (["rev-parse", "--short=10", "HEAD"], ["status", "--porcelain", "--", "edp", "meshes"]):
        with contextlib.suppress(OSError, subprocess.SubprocessError):
            done = subprocess.run(
                ["git", "-C", str(root), *words], capture_output=True, text=True, timeout=30, check=True
            )
            said.append(done.stdout.strip())
    return said[0] + ("+" if said[1] else "") if len(said) == 2 else "unknown"


# ---------------------------------------------------------------- one run


class Interrupted(Exception):
    """The campaign is being stopped."""


@dataclass
class Outcome:
    """A finished process: exit code (None: ran out of time), seconds and MB from outside, what it printed and wrote."""

    code: int | None
    wall: float
    used: float
    memory: float
    output: str
    summary: dict


class Processes:
    """Starts the runs and can stop all of them."""

    def __init__(self):
        self.lock = threading.Lock()
        self.active: set[int] = set()
        self.stopping = False

    def execute(self, command: list[str], cwd: Path, folder: Path, timeout: float) -> Outcome:
        """One process from start to end; its files are looked for in `folder`."""
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": str(THREADS)}
        late = threading.Event()
        with tempfile.TemporaryFile() as printed:
            begin = time.perf_counter()
            with self.lock:
                if self.stopping:
                    raise Interrupted
                to = {"stdin": subprocess.DEVNULL, "stdout": printed, "stderr": subprocess.STDOUT}
                process = subprocess.Popen(command, cwd=cwd, env=environment, start_new_session=True, **to)
                self.active.add(process.pid)

            def end():
                late.set()
                self.kill(process.pid)

            timer = threading.Timer(timeout, end)
            timer.start()
            try:
                _, status, usage = os.wait4(process.pid, 0)
            finally:
                with self.lock:
                    self.active.discard(process.pid)
                timer.cancel()
            wall = time.perf_counter() - begin
            process.returncode = os.waitstatus_to_exitcode(status)
            if self.stopping:
                raise Interrupted
            printed.seek(0)
            output = printed.read(10**6).decode(errors="replace")
        code = None if late.is_set() else process.returncode
        used = usage.ru_utime + usage.ru_stime
        return Outcome(code, wall, used, usage.ru_maxrss / 1024, output, read_summary(folder / "summary.json"))

    def kill(self, pid: int) -> None:
        with self.lock:
            if pid in self.active:
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(pid, signal.SIGKILL)

    def stop(self) -> None:
        """No new run starts, and those under way end."""
        self.stopping = True
        for pid in list(self.active):
            self.kill(pid)


def read_summary(path: Path) -> dict:
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return {}


Measure = Callable[[Case, dict, Path], dict]  # further columns of a run that has written its files: folder's path


def run_case(
    item: Case, sources: Path, processes: Processes, measure: Measure | None = None, freefem: Iterable[str] = FREEFEM
) -> dict:
    """The case's row, without the columns that are those of the whole campaign."""
    outcomes: list[Outcome] = []
    further: dict = {}
    spent = 0.0
    while len(outcomes) < item.repeats and (not outcomes or spent < REPEATS_END):
        with tempfile.TemporaryDirectory(prefix="run-") as name:
            command = [*(item.program or freefem), item.script, *item.flags, "-vtu", "0", "-out", name]
            outcome = processes.execute(command, sources, Path(name), item.timeout)
            if not outcomes and measure and outcome.code == 0:
                further = measure(item, outcome.summary, Path(name))
        outcomes.append(outcome)
        spent += outcome.wall
        if outcome.code != 0:
            break
    return {**row_of(item, outcomes), **further}


def row_of(item: Case, outcomes: list[Outcome]) -> dict:
    last = outcomes[-1]
    summary = last.summary if last.code != 0 else outcomes[0].summary
    parameters = {**item.parameters, **summary.get("parameters", {})}
    row = {"name": item.name, "script": item.script, "flags": " ".join(item.flags)}
    row["scene"] = summary.get("scene", re.sub(r"-ipopt$", "", Path(item.script).stem).replace("main", "disc-on-block"))
    row |= {name: parameters.get(name) for name in PARAMETERS}
    row |= {name: summary.get(name) for name in [*COUNTS, *RESULTS]}
    row["status"] = status_of(last.code)
    row["message"] = message_of(last)
    row["repeats"] = len(outcomes)
    row["wall"] = statistics.median(outcome.wall for outcome in outcomes)
    row["used"] = statistics.median(outcome.used for outcome in outcomes)
    row["memory"] = statistics.median(outcome.memory for outcome in outcomes)
    told = [outcome.summary for outcome in outcomes if outcome.summary]
    if told:
        row["costRatio"] = statistics.median(summary["costRatio"] for summary in told)
        row["cpu"] = statistics.median(summary["seconds"]["total"] for summary in told)
        for part in "mesh assembly factorisation contact".split():
            row[f"seconds_{part}"] = statistics.median(summary["seconds"][part] for summary in told)
    return row


# ---------------------------------------------------------------- cases on one mesh: rows of one run

# flags that leave mesh and stiffness as they are, edp/docs/howto/many-runs.md; words that exclude rows
OF_METHODS = "steps T0 threshold inner start forcing preconditioner model tol eps rho maxNewton maxAdaptations"
ROW_FLAGS = problem_rows.ROW_FLAGS | frozenset(OF_METHODS.split())
NO_ROWS = frozenset("friction legs drag shear distance accuracy history case path w eps0 control branch".split())
NO_ROW_SCENES = ("adhesive", "fretting", "rolling", "wedge", "parts")


def may_share(item: Case) -> bool:
    """Whether the case may be a row of a table: one repeat, a scene and flags that allow it."""
    scene = Path(item.script).stem
    usual = not item.program and item.repeats == 1 and not scene.endswith("-ipopt")
    return usual and not scene.startswith(NO_ROW_SCENES) and not NO_ROWS & set(item.parameters)


def common_flags(item: Case) -> tuple[str, ...]:
    """The flags that the rows of a table share."""
    given = item.parameters.items()
    return tuple(text for name, value in given if name not in ROW_FLAGS for text in (f"-{name}", value))


def groups(cases: Iterable[Case], together: Callable[[Case], bool] | None) -> list[list[Case]]:
    """The cases, those that share script and mesh in one group if `together` accepts them."""
    found: dict[tuple, list[Case]] = {}
    for item in cases:
        shared = together is not None and may_share(item) and together(item)
        found.setdefault((item.script, *sorted(common_flags(item))) if shared else item.key, []).append(item)
    return list(found.values())


def run_group(
    group: list[Case], sources: Path, processes: Processes, measure: Measure | None = None, freefem=FREEFEM
) -> list[dict]:
    """The rows of these cases: of a single case by its run, of several by one run with -rows, each from its own start.

    Of a row of several, `cpu` is that of its solution and report; `wall` and `memory` are those of its process, `wall`
    divided by the cases. Rows that the process has not given are run alone.
    """
    if len(group) == 1:
        return [run_case(group[0], sources, processes, measure, freefem)]
    common = common_flags(group[0])
    names = list(dict.fromkeys(name for item in group for name in item.parameters if f"-{name}" not in common))
    with tempfile.TemporaryDirectory(prefix="run-") as folder:
        with (Path(folder) / "table.csv").open("w") as file:
            csv.writer(file).writerows([names, *([item.parameters.get(name, "") for name in names] for item in group)])
        command = [*freefem, group[0].script, *common, "-rows", f"{folder}/table.csv", "-rows-start", "cold"]
        allowed = sum(item.timeout for item in group)
        outcome = processes.execute([*command, "-out", f"{folder}/out"], sources, Path(folder) / "out", allowed)
        told = read_summary(Path(folder) / "out/rows.json")
        found = told.get("rows", [])
        rows = []
        for item, row in zip(group, found or [None] * len(group), strict=True):
            if row is None or row["code"] not in STATUS:
                rows.append(run_case(item, sources, processes, measure, freefem))
                continue
            summary = row["summary"] or {}
            if summary:
                given = {name: number_or_text(text) for name, text in item.parameters.items()}
                summary |= {"parameters": told["parameters"] | given}
                summary["seconds"]["total"] = row["seconds"]
            shares = outcome.wall / len(group), outcome.used / len(group)
            one = Outcome(row["code"], *shares, outcome.memory, row["message"], summary)
            further = measure(item, summary, Path(folder)) if measure and row["code"] == 0 else {}
            rows.append({**row_of(item, [one]), **further})
    return rows


def number_or_text(text: str) -> int | float | str:
    """A flag's value as summary.json has it: FreeFEM writes whole numbers without a point."""
    with contextlib.suppress(ValueError):
        number = float(text)
        return int(number) if number.is_integer() and abs(number) < 1e17 else number
    return text


def status_of(code: int | None) -> str:
    return "timeout" if code is None else STATUS.get(code, f"crash {code}")


def message_of(outcome: Outcome) -> str:
    """One line: the run's own reason, or what it printed first (refused) or last (crashed)."""
    if outcome.code == 0:
        return ""
    if outcome.code == 20:
        return outcome.summary.get("message", "")
    lines = [line.strip() for line in outcome.output.splitlines() if line.strip()]
    if not lines:
        return ""
    return (lines[0] if outcome.code == 10 else " | ".join(lines[-3:]))[:300]


# ---------------------------------------------------------------- the table


def read_rows(path: Path) -> list[dict[str, str]]:
    """The complete rows of a campaign's CSV, as text; a line that was cut off while it was written is left out."""
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return []
    return list(csv.DictReader(io.StringIO(text[: text.rfind("\n") + 1])))


def csv_line(values: Iterable) -> str:
    """One line; None is an empty cell, line breaks in a text become spaces, so a row is a line."""
    cells = ["" if value is None else " ".join(str(value).split()) for value in values]
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(cells)
    return text.getvalue()


def add_rows(path: Path, columns: Sequence[str], rows: Iterable[dict]) -> None:
    """Append rows to a CSV; a new one begins with its columns."""
    head = [] if path.exists() else [columns]
    with path.open("a", encoding="utf-8") as file:
        file.write(
            "".join(csv_line(cells) for cells in [*head, *([row.get(name) for name in columns] for row in rows)])
        )


class Table:
    """A campaign's CSV on disk: rows are appended whole; those of other sources are dropped when it is opened."""

    def __init__(self, path: Path, columns: list[str], sources: str, keys: set[tuple]):
        self.path, self.columns, self.sources = path, columns, sources
        old = read_rows(path)
        kept = [row for row in old if row.get("sources") == sources and key_of(row) in keys]
        if old and list(old[0]) != columns:
            kept = []
        self.dropped = len(old) - len(kept)
        self.done = {key_of(row) for row in kept}
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
        lines = [csv_line(columns), *(csv_line(row[name] for name in columns) for row in kept)]
        temporary.write_text("".join(lines), encoding="utf-8")
        os.replace(temporary, path)

    def append(self, row: dict) -> None:
        unknown = set(row) - set(self.columns)
        if unknown:
            raise ValueError(f"no column for {', '.join(sorted(unknown))}")
        line = csv_line(row.get(name) for name in self.columns).encode()
        handle = os.open(self.path, os.O_WRONLY | os.O_APPEND)
        try:
            if os.write(handle, line) != len(line):
                raise OSError(f"{self.path}: disk full")
            os.fsync(handle)
        finally:
            os.close(handle)
        self.done.add(key_of(row))


def key_of(row: dict) -> tuple[str, str, str]:
    return row["name"], row["script"], row["flags"]


# ---------------------------------------------------------------- the campaign


def run(
    cases: list[Case],
    path: Path,
    jobs: int = 1,
    columns: Iterable[str] = (),
    measure: Callable[[Path, Processes], Measure] | None = None,
    root: Path = ROOT,
    files: dict[str, str] | None = None,
    freefem: Iterable[str] = FREEFEM,
    title: str | None = None,
    together: Callable[[Case], bool] | None = None,
) -> list[dict[str, str]]:
    """Executes the cases that `path` has no current row of, `jobs` at a time; all rows, as text.

    together: whether a case may be solved with others on its mesh (run_group): `measure` then has its summary alone.
    columns: names of further columns; `measure(sources, processes)` gives the function that fills them, where `sources`
    is the frozen copy of the package (with `files` added: name to text). Interrupted with Ctrl-C or SIGTERM, the CSV
    holds all the runs that have ended, and KeyboardInterrupt is raised.
    """
    cases = list({item.key: item for item in cases}.values())
    processes = Processes()
    with frozen_sources(root, files) as sources:
        digest = sources_digest(sources)
        before = {key_of(row): float(row["wall"]) * int(row["repeats"]) for row in read_rows(path) if row.get("wall")}
        table = Table(path, [*COLUMNS, *columns], digest, {item.key for item in cases})
        if table.dropped:
            print(f"{path}: {table.dropped} rows of other sources dropped", file=sys.stderr)
        todo = [item for item in cases if item.key not in table.done]
        if todo:
            common = {"sources": digest, **machine()}
            last, usual = [before.get(item.key) for item in todo], [weight_of(item) / WEIGHED for item in todo]
            weights = dict(zip(todo, expect(title or path.stem, last, usual, jobs, freefem), strict=True))
            progress = Progress(title or path.stem, sum(weights.values()), len(todo))
            gauge = measure(sources, processes) if measure else None
            with working(jobs, processes) as pool:
                parts = groups(todo, together)
                waiting = {pool.submit(run_group, part, sources, processes, gauge, freefem): part for part in parts}
                while waiting:
                    ended, _ = wait(waiting, return_when=FIRST_COMPLETED)
                    for future in ended:
                        for item, row in zip(waiting.pop(future), future.result(), strict=True):
                            table.append({**row, **common})
                            progress.step(weights[item], row["status"] == "converged")
    order = {item.key: place for place, item in enumerate(cases)}
    return sorted(read_rows(path), key=lambda row: order[key_of(row)])


def weight_of(item: Case) -> float:
    return item.weight * item.repeats


@contextlib.contextmanager
def working(jobs, processes, *_):
    """A pool of so many workers; what interrupts it ends their processes and what waits too."""
    with terminable(), ThreadPoolExecutor(jobs) as pool:
        try:
            yield pool
        except BaseException:
            processes.stop()
            pool.shutdown(cancel_futures=True)
            raise


@contextlib.contextmanager
def terminable():
    """SIGTERM like Ctrl-C, as far as this is the main thread."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def interrupt(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


# ---------------------------------------------------------------- reading what was written


def value(row: dict[str, str], name: str) -> float:
    """A number of a row; NaN where the cell is empty."""
    return float(row[name]) if row[name] != "" else float("nan")


def select(rows: Iterable[dict[str, str]], **wanted) -> list[dict[str, str]]:
    """The rows whose cells are these; numbers are compared as numbers."""
    return [row for row in rows if all(same(row[name], asked) for name, asked in wanted.items())]


def same(cell: str, asked: object) -> bool:
    if isinstance(asked, str):
        return cell == asked
    with contextlib.suppress(ValueError):
        return float(cell) == float(asked)
    return False


def read_contact(folder: Path) -> dict[str, np.ndarray]:
    """contact.csv of a run's folder: column name to values, one a collocation point."""
    with (folder / "contact.csv").open() as file:
        names = file.readline().strip().split(",")
        values = np.loadtxt(file, delimiter=",", ndmin=2)
    return dict(zip(names, values.T, strict=True))


def decade(number: float) -> str:
    """A power of ten, short: 1e-3, 1, 1e12."""
    mantissa, exponent = f"{number:.0e}".split("e")
    return f"{mantissa}e{int(exponent)}" if int(exponent) else mantissa


def signed(number: float) -> str:
    """A difference, short: −1.5e-3."""
    mantissa, exponent = f"{abs(number):.1e}".split("e")
    return f"{'−' if number < 0 else ''}{mantissa}e{int(exponent)}"


def markdown(header: list[str], rows: list[list[object]]) -> str:
    """A table for a README."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)
