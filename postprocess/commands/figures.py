"""draw every figure that can be made from a folder of results

RESULTS is a folder of results, `results` when it is not given. Each figure takes the runs that suit it, those of
`make figures` first; the figures of campaigns take the folders bench and stability. What cannot be made is listed
with what it needs. The figures are written as PDF and PNG: all of them, or none.
"""

import argparse
import contextlib
from pathlib import Path
from types import ModuleType

from postprocess import figures, style
from postprocess.figures import overshoot
from postprocess.figures.figure2 import SAME_PROBLEM
from postprocess.output import write_figures
from postprocess.results import ResultsError, Run
from postprocess.results_folder import ResultsFolder, read_results_folder

# What a figure of runs needs, for those who have to make it.
NEEDS = {
    "figure1": "a run of disc-on-block or meshed-disc made with -states 1",
    "figure2": "a run of the method incremental, and one of another method of the same problem",
    "convergence": "a run",
    "thresholds": "a run of the method paper",
    "equilibrium": "a run of a confined block",
    "overshoot": "a run of the method newton made with -states 1",
    "hertz_error": "Hertz's contacts on two or more meshes, which are named to `postprocess figure hertz_error`",
    "rigid": "a run of disc-on-block and two of meshed-disc, which are named to `postprocess figure rigid`",
    "patch": "a run of a patch test",
    "punch": "a run of flat-punch made with -force",
    "waves": "a run of wavy made with -force, five waves or more",
    "cost": "runs of the lab 5-cost, which are named to `postprocess figure cost`",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RESULTS", nargs="?", default="results", help="a folder of results")
    parser.add_argument("--out", metavar="DIR", help="where to write (default: RESULTS/figures)")
    style.add_units(parser)


def run(arguments: argparse.Namespace) -> None:
    """Draws what can be drawn, writes it, prints the paths, and what is missing with the reason."""
    tree = read_results_folder(arguments.folder)
    folder = Path(arguments.out) if arguments.out else tree.path / "figures"
    drawn, missing = {}, []
    with style.look():
        units = style.Units(*map(style.without_mathtext, arguments.units))
        for name, module in figures.modules().items():
            found = sources_of_figure(tree, name, module)
            if isinstance(found, str):
                missing.append(f"{name}: {found}")
                continue
            drawn[folder / f"{name}.pdf"] = module.draw(found, units)
        if not drawn:
            raise ResultsError(tree.path, "holds nothing that a figure could be made of")
        for path in write_figures(drawn):
            print(path)
    for line in missing:
        print(f"not made: {line}")


def sources_of_figure(tree: ResultsFolder, name: str, module: ModuleType) -> list | str:
    """What a figure is drawn from, or what it needs."""
    if hasattr(module, "READ"):
        folder = tree.path / name.partition("_")[0]
        if not any(folder.glob("*.csv")):
            return f"needs make {folder.name}"
        campaign = module.READ(folder)
        try:
            module.draw([campaign], style.Units())
        except ResultsError as error:
            if "no such file" in str(error):
                return f"needs the whole of make {folder.name}"
            raise
        return [campaign]
    chosen = CHOICES[name](figure_runs_first(tree.runs)) if name in CHOICES else first_drawable_run(tree.runs, module)
    return chosen or f"needs {NEEDS.get(name, 'a run that holds what it shows')}"


def first_drawable_run(runs: list[Run], module: ModuleType) -> list[Run]:
    """For a figure of one run: the first that it can be drawn from."""
    for run in runs if module.RUNS[0] == 1 else ():
        with contextlib.suppress(ResultsError):
            module.draw([run], style.Units())
            return [run]
    return []


def figure_runs_first(runs: list[Run]) -> list[Run]:
    """Those in a folder called figures first: they were made for it."""
    return sorted(runs, key=lambda run: ("figures" not in run.path.parts, str(run.path)))


def choose_states(runs: list[Run]) -> list[Run]:
    """Bodies of the paper's test, both meshed if possible."""
    fit = [run for run in runs if (run.path / "states.csv").exists() and run.summary["newton"] > 0]
    fit = [run for run in fit if run.summary["scene"] in ("meshed-disc", "disc-on-block")]
    return sorted(fit, key=lambda run: run.summary["scene"] != "meshed-disc")[:1]


def choose_pair(runs: list[Run]) -> list[Run]:
    """A run and the reference in small load steps, of one problem on one mesh."""
    references = [run for run in runs if run.summary["method"] == "incremental"]
    others = [run for run in runs if run.summary["method"] in ("paper", "xnewton")]
    others.sort(key=lambda run: run.summary["method"] != "paper")
    for other in others:
        for reference in references:
            if (
                problem(other) == problem(reference)
                and min(each.summary["contactPoints"] for each in (other, reference)) >= 5
            ):
                return [other, reference]
    return []


def choose_histories(runs: list[Run]) -> list[Run]:
    """One run per method and first threshold, all of the problem that most of them are of; no load steps."""
    fit = [run for run in runs if run.summary["newton"] > 0 and run.summary["method"] != "incremental"]
    groups: dict = {}
    for run in fit:
        key = run.summary["method"], str(run.summary["parameters"].get("T0"))
        groups.setdefault(problem(run), {}).setdefault(key, run)
    return list(max(groups.values(), key=len).values()) if groups else []


def choose_thresholds(runs: list[Run]) -> list[Run]:
    """The paper's scheme on one problem, a run for each first threshold, those made for the figures first."""
    fit = [run for run in runs if run.summary["method"] == "paper" and run.summary["contactPoints"] > 0]
    found = {str(run.summary["parameters"].get("T0")): run for run in fit[::-1] if problem(run) == problem(fit[0])}
    return sorted(found.values(), key=fit.index)[:3]


def choose_overshoots(runs: list[Run]) -> list[Run]:
    """Plain Newton on a law, with its steps."""
    fit = [run for run in runs if run.summary["method"] == "newton" and (run.path / "steps.csv").exists()]
    return first_drawable_run(fit, overshoot)


CHOICES = {
    "figure1": choose_states,
    "figure2": choose_pair,
    "convergence": choose_histories,
    "thresholds": choose_thresholds,
    "overshoot": choose_overshoots,
}


def problem(run: Run) -> tuple:
    """What two runs have in common whose results may be laid over each other."""
    summary = run.summary
    values = [str(summary["parameters"].get(name)) for name in [*SAME_PROBLEM, "law", "geometry"]]
    return summary["scene"], summary["order"], summary["h"], *values
