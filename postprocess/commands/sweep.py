"""run a case for many values of one of its numbers, side by side: one table, one figure

CASE is a case file, MESH its mesh. NUMBER is the statement whose number is replaced, with * in its place, as
"force grip 0 *". --values has the numbers, or FROM:TO:COUNT. Runs go side by side on the cores; one that is there is
not run again, so an interrupted sweep goes on, unless a law's table, a file that MESH includes or the package has
changed since. DIR has a folder for each run, sweep.csv, sweep.pdf and sweep.png; the
last three are written when all runs have ended. What begins with - needs a =: --values=-3:-1:20, --flags="-order 4".
"""

import argparse
import contextlib
import csv
import hashlib
import io
import json
import os
import signal
import subprocess
import textwrap
import time
from pathlib import Path
from typing import BinaryIO

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.output import figure_writer, write_all_or_none, write_files
from postprocess.results import ResultsError, read_run

ROOT = Path(__file__).resolve().parent.parent.parent
SIZE = (style.PAGE, 0.36 * style.PAGE)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("mesh", metavar="MESH", help="a .geo or mesh file")
    parser.add_argument("case", metavar="CASE", help="a case file")
    parser.add_argument("--number", required=True, metavar="STATEMENT", help='with * for the number: "force grip 0 *"')
    parser.add_argument("--values", required=True, nargs="+", metavar="V", help="numbers, or FROM:TO:COUNT")
    parser.add_argument("--space", action="store_true", help="bodies in space (parts-3d)")
    parser.add_argument(
        "--jobs", type=int, default=os.cpu_count(), metavar="N", help="runs at once (default: the cores)"
    )
    parser.add_argument("--out", metavar="DIR", help="where to write (default: results/sweep/CASE)")
    parser.add_argument("--flags", default="", metavar="WORDS", help='the runs\' own flags: --flags="-order 4"')


def run(arguments: argparse.Namespace) -> None:
    """Runs what is missing, then writes the table and the figure and prints their paths."""
    case, mesh = Path(arguments.case), Path(arguments.mesh)
    values = numbers(arguments.values)
    folder = Path(arguments.out or Path("results/sweep") / case.stem)
    lines = text_of(case).splitlines()
    line, word = find_statement(case, lines, arguments.number)
    what = {"mesh": checksum(mesh), "case": lines, "number": arguments.number, "flags": arguments.flags.split()}
    check_same_sweep(folder, what)
    origin = identity(mesh, case, *arguments.flags.split())
    todo = []
    for value in values:
        target = folder / f"{value:.12g}"
        if not is_finished(target, origin):
            todo.append((target, case_with(lines, line, word, value)))
    print(f"{len(values) - len(todo)} of {len(values)} runs are there", flush=True)
    run_all(todo, mesh, origin, arguments)
    failed = [value for value in values if not is_finished(folder / f"{value:.12g}", origin)]
    if failed:
        first = folder / f"{failed[0]:.12g}.log"
        raise ResultsError(folder, f"{len(failed)} runs have failed, the first for {failed[0]:.6g}: see {first}")
    paths = write_results(folder, arguments.number, values)
    for path in paths:
        print(path)


# ---------------------------------------------------------------- what is asked for


def numbers(words: list[str]) -> list[float]:
    """Values, and ranges FROM:TO:COUNT, in order and once each."""
    found = []
    for word in filter(None, ",".join(words).split(",")):
        try:
            parts = [float(part) for part in word.split(":")]
        except ValueError:
            raise ResultsError("--values", f"{word}: allowed: numbers, or FROM:TO:COUNT") from None
        if len(parts) == 3 and parts[2] == int(parts[2]) and 1 < parts[2] <= 10000:
            found += np.linspace(parts[0], parts[1], int(parts[2])).tolist()
        elif len(parts) == 1:
            found += parts
        else:
            raise ResultsError("--values", f"{word}: allowed: numbers, or FROM:TO:COUNT")
    if not np.isfinite(found).all():
        raise ResultsError("--values", "allowed: finite numbers")
    return list(dict.fromkeys(float(f"{value:.12g}") for value in found))  # as their folders are named


def text_of(path: Path) -> str:
    if path.exists() and not path.is_file():
        raise ResultsError(path, "is not a file")
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ResultsError(path, f"cannot be read: {error}") from None


def checksum(path: Path) -> str:
    if path.exists() and not path.is_file():
        raise ResultsError(path, "is not a file")
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError as error:
        raise ResultsError(path, f"cannot be read: {error}") from None


def find_statement(case: Path, lines: list[str], pattern: str) -> tuple[int, int]:
    """The line, and which of its words, that a statement with * stands for."""
    wanted = pattern.split()
    if wanted.count("*") != 1:
        raise ResultsError("--number", f'{pattern}: allowed: a statement with one *, as "force grip 0 *"')
    at = wanted.index("*")

    def fits(line: str) -> bool:
        words = line.split("#")[0].split()
        return len(words) >= len(wanted) and all(k == at or words[k] == wanted[k] for k in range(len(wanted)))

    found = [index for index, line in enumerate(lines) if fits(line)]
    if len(found) != 1:
        raise ResultsError(case, f"{len(found)} lines begin with {pattern!r}; allowed: a statement that is there once")
    try:
        float(lines[found[0]].split()[at])
    except ValueError:
        raise ResultsError(case, f"line {found[0] + 1}: {lines[found[0]].split()[at]} is no number") from None
    return found[0], at


def case_with(lines: list[str], line: int, word: int, value: float) -> str:
    words = lines[line].split("#")[0].split()
    words[word] = repr(value)
    return "\n".join([*lines[:line], " ".join(words), *lines[line + 1 :]]) + "\n"


# ---------------------------------------------------------------- runs


def check_same_sweep(folder: Path, what: dict) -> None:
    """A folder belongs to one sweep: its mesh, case, number and flags; values may be added."""
    path = folder / "sweep.json"
    if path.exists():
        try:
            former = json.loads(text_of(path))
        except (ValueError, RecursionError):
            raise ResultsError(path, "is not what a sweep writes; allowed: another --out") from None
        if former != what:
            raise ResultsError(folder, "has another sweep (mesh, case, number or flags); allowed: another --out")
    else:
        if folder.exists() and any(folder.iterdir()):
            raise ResultsError(folder, "is not empty, and no sweep's; allowed: another --out")
        write_files({path: json.dumps(what, indent=1).encode()})


def identity(*files: Path | str) -> str:
    """The checksums of these files, of all that they read, and of the package."""
    words = ["sh", ROOT / "edp/output/report/run-checksum.sh", "0", ROOT, *files]
    return subprocess.run([*map(str, words)], stdout=subprocess.PIPE, text=True, check=True).stdout


def identity_file(folder: Path) -> Path:
    """Beside a run's folder: the identity of what it was computed from."""
    return folder.with_name(f"{folder.name}.identity")


def is_finished(folder: Path, origin: str) -> bool:
    """Whether a run of these files has come to its end: its record is written after it, its summary last."""
    there = identity_file(folder).exists() and (folder / "summary.json").exists()
    return there and text_of(identity_file(folder)) == origin and read_run(folder).summary["converged"]


def run_all(todo: list, mesh: Path, origin: str, arguments: argparse.Namespace) -> None:
    """So many at once; when interrupted none is left running."""
    script = "parts-3d" if arguments.space else "parts"
    running: dict[subprocess.Popen[bytes], tuple[Path, BinaryIO]] = {}
    waiting = list(todo)
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    try:
        while running or waiting:
            while waiting and len(running) < max(1, arguments.jobs):
                folder, case = waiting.pop(0)
                stated = folder.with_name(f"{folder.name}.case")
                identity_file(folder).unlink(missing_ok=True)
                write_files({stated: case.encode()})
                log = folder.with_name(f"{folder.name}.log").open("wb")
                words = ["sh", ROOT / "edp/freefem.sh", script, "-mesh", mesh, "-case", stated, "-out", folder]
                process = subprocess.Popen(
                    [*map(str, words), *arguments.flags.split()],
                    stdout=log,
                    stderr=subprocess.STDOUT,
                    env=environment,
                    start_new_session=True,
                )
                running[process] = (folder, log)
            time.sleep(0.02)
            for process in [process for process in running if process.poll() is not None]:
                folder, log = running.pop(process)
                log.close()
                if process.returncode in (0, 21):  # as of a run whose summary has converged
                    write_files({identity_file(folder): origin.encode()})
                print(
                    f"{folder.name}: {'done' if process.returncode == 0 else f'code {process.returncode}'}", flush=True
                )
    finally:
        for process, (_, log) in running.items():
            with contextlib.suppress(ProcessLookupError):  # the run, and what it has started
                os.killpg(process.pid, signal.SIGTERM)
            process.wait()
            log.close()


# ---------------------------------------------------------------- table and figure


def result_row(folder: Path, value: float) -> dict:
    """What is known of one run: forces, contacts, loads, stresses, with their errors; an unknown one is empty."""
    summary = read_run(folder).summary
    found = {"value": value, "run": folder.name}
    for one in summary.get("prescribed", []):
        found[f"{one['name']} needs"] = one.get("force", one.get("moment"))
    known = summary.get("estimates") or {}
    for index, one in enumerate(summary.get("contacts", [])):
        errors = (known.get("contacts") or [{}] * (index + 1))[index]
        for name, label in (("normalForce", "normal force"), ("pressureMax", "greatest pressure")):
            found[f"{one['name']} {label}"] = one[name]
            found[f"{one['name']} {label} error"] = (errors.get(name) or {}).get("error")
        found[f"{one['name']} size"] = one.get("contactLength", one.get("area"))
    for one in known.get("loads", []):
        found[f"{one['name']} displacement"] = (one.get("way") or {}).get("value")
    for one in summary.get("stresses", []):
        found[f"{one['body']} von Mises"] = one["vonMises"]
        found[f"{one['body']} von Mises error"] = one["error"]
    for one in summary.get("preloads", []):
        found[f"preload {one['name']} force"] = one["force"]
    return found


def write_results(folder: Path, what: str, values: list[float]) -> list[Path]:
    rows = [result_row(folder / f"{value:.12g}", value) for value in values]
    names = list(dict.fromkeys(name for one in rows for name in one))
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([names, *([one.get(name) for name in names] for one in rows)])
    with style.look():
        figure = draw_results(what, rows, names)
        writers = {folder / "sweep.csv": lambda part: part.write_bytes(text.getvalue().encode())}
        for kind in ("pdf", "png"):
            writers[folder / f"sweep.{kind}"] = figure_writer(figure, kind, {})
        return write_all_or_none(writers)


def draw_results(what: str, rows: list[dict], names: list[str]) -> Figure:
    """Three panels over the number: forces, greatest pressures, and displacements or stresses, errors as bars."""
    at = np.array([one["value"] for one in rows])
    order = np.argsort(at)
    panels = {
        "force": [name for name in names if name.endswith((" normal force", " needs", " force"))],
        "greatest pressure": [name for name in names if name.endswith(" greatest pressure")],
        "von Mises stress": [name for name in names if name.endswith(" von Mises")],
        "displacement of the load": [name for name in names if name.endswith(" displacement")],
    }
    shown = {title: group for title, group in panels.items() if group}
    figure = Figure(figsize=SIZE, layout="constrained")
    for axes, (title, group) in zip(np.atleast_1d(figure.subplots(1, len(shown))), shown.items(), strict=True):
        for index, name in enumerate(group):
            column, error = (
                np.array([np.nan if one.get(key) is None else one[key] for one in rows], float)[order]
                for key in (name, f"{name} error")
            )
            label = style.without_mathtext(
                name.removesuffix(f" {title}").removesuffix(" displacement").removesuffix(" von Mises")
            )
            bars = np.where(np.isfinite(error), error, 0)
            axes.errorbar(at[order], column, bars, label=label, capsize=2, elinewidth=0.8, **style.curve(index))
        words = f"{what.replace('*', '...')} [as in the case]"
        axes.set_xlabel(style.without_mathtext(textwrap.fill(words, 84 // len(shown))))
        axes.set_ylabel(f"{title} [unit of the case]")
        axes.legend(fontsize=7)
    return figure
