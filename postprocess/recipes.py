"""The runs behind figures and pages, as figures.toml states them: which there are, which are current, making them."""

import fnmatch
import functools
import itertools
import json
import shlex
import subprocess
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from postprocess.results import ResultsError

ROOT = Path(__file__).resolve().parent.parent
RECIPES = Path(__file__).with_name("figures.toml")


@dataclass(frozen=True)
class Figure:
    """A figure: the module of postprocess/figures/ that draws it, and the names of its runs in order."""

    module: str
    runs: tuple[str, ...]


@dataclass(frozen=True)
class Recipes:
    """Each run's script and flags as words, and each figure, by their names; cost: default runs a run, a mean."""

    runs: dict[str, tuple[str, ...]] = field(default_factory=dict)
    figures: dict[str, Figure] = field(default_factory=dict)
    cost: float = 3.0


def read_recipes(section: str, path: Path = RECIPES) -> Recipes:
    """The runs and figures of a section; its sweeps become runs, and each run has the section's flags."""
    stated = tomllib.loads(path.read_text(encoding="utf-8"))
    texts, section_of = stated.pop("texts", {}), stated.get(section)
    if section_of is None:
        raise ResultsError(section, f"no section of {path.name}; allowed: {', '.join(stated)}")
    runs = {name: text.format_map(texts) for name, text in section_of.get("runs", {}).items()}
    for name, sweep in section_of.get("sweeps", {}).items():
        runs |= dict(expand(name, sweep, texts))
    figures = {}
    for name, entry in section_of.get("drawn", {}).items():
        chosen = [run for pattern in entry["runs"] for run in runs if fnmatch.fnmatchcase(run, pattern)]
        figures[name] = Figure(entry.get("draw", name), tuple(chosen))
    always = section_of.get("flags", "")
    words = {name: tuple(shlex.split(f"{text} {always}")) for name, text in runs.items()}
    return Recipes(words, figures, section_of.get("cost", Recipes.cost))


def expand(name: str, sweep: dict, texts: dict[str, str]) -> Iterator[tuple[str, str]]:
    """(name, script and flags) of each combination of a sweep's values."""
    axes = {key: values for key, values in sweep.items() if key != "run"}
    for combination in itertools.product(*axes.values()):
        words = dict(zip(axes, combination, strict=True))
        flags = {key: axes[key][word] if isinstance(axes[key], dict) else word for key, word in words.items()}
        yield name.format_map(words), sweep["run"].format_map(texts | flags)


@functools.cache
def newest_source(script: str) -> float:
    """When the latest file changed that a run may read: script, modules, geometries, recipes; looked for once."""
    below = [path for suffix in ("idp", "sh", "py", "txt") for path in (ROOT / "edp").rglob(f"*.{suffix}")]
    return max(path.stat().st_mtime for path in [ROOT / script, RECIPES, *below, *(ROOT / "meshes").glob("*.geo")])


def is_current(folder: Path, script: str) -> bool:
    """Whether the results in a folder are later than all that they were made from."""
    summary = folder / "summary.json"
    return summary.exists() and summary.stat().st_mtime >= newest_source(script)


def last_seconds(folder: Path) -> float | None:
    """Seconds that the run in a folder was waited for, if there was one, whatever its sources were."""
    try:
        return float(json.loads((folder / "summary.json").read_text(encoding="utf-8"))["seconds"]["waited"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def make_run(words: tuple[str, ...], folder: Path, freefem: list[str]) -> None:
    """Runs a script with its flags into a folder, unless its results are current; a run that fails ends everything."""
    if is_current(folder, words[0]):
        return
    whole = folder.resolve()
    out = whole.relative_to(ROOT) if whole.is_relative_to(ROOT) else whole
    command = [*freefem, *words, "-out", str(out)]
    print(shlex.join(command), flush=True)
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        last = done.stdout.strip().splitlines()[-3:]
        raise ResultsError(folder, f"its run ended with code {done.returncode}: {' '.join(last)}")
