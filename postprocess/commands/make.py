"""make the runs of a section of figures.toml, and the figures drawn from them

SECTION is figures, paper or accuracy. WHAT is a figure (figure1, or figure1.pdf), a run (paper, or
paper/summary.json), or nothing: all. A run is made anew if a source is later than its results.
"""

import argparse
import os
import shlex
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from postprocess import figures, style
from postprocess.output import write_figure
from postprocess.progress import Progress, expect
from postprocess.recipes import Figure, Recipes, is_current, last_seconds, make_run, read_recipes
from postprocess.results import ResultsError, read_run

DRAWING = 5.5  # default runs that a picture takes, a mean


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("section", metavar="SECTION", help="figures, paper or accuracy")
    parser.add_argument("what", metavar="WHAT", nargs="*", help="figures or runs (default: all)")
    parser.add_argument("--out", metavar="DIR", default="results", help="runs and figures go to DIR/SECTION")
    parser.add_argument(
        "--freefem", metavar="COMMAND", default="FreeFem++ -nw -v 0", help="FreeFEM's program and options"
    )
    parser.add_argument("--jobs", metavar="N", type=int, default=os.cpu_count(), help="runs at once (default: cores)")
    parser.add_argument("--expect", action="store_true", help="only say what there is to do, and how long it takes")


def run(arguments: argparse.Namespace) -> None:
    """Makes the runs that are wanted, several at once, then draws the figures; says how long, and what is written."""
    section = arguments.section
    recipes, out, freefem = read_recipes(section), Path(arguments.out) / section, shlex.split(arguments.freefem)
    drawn, runs = choose(recipes, arguments.what)
    runs = [name for name in runs if not is_current(out / name, recipes.runs[name][0])]
    drawn = {
        name: figure
        for name, figure in drawn.items()
        if set(runs) & set(figure.runs) or not is_drawn(name, figure, out)
    }
    jobs, last = max(1, arguments.jobs), [last_seconds(out / name) for name in runs]
    seconds = expect(section, last, [recipes.cost] * len(runs), jobs, freefem, [DRAWING] * len(drawn))
    if arguments.expect:
        return
    # of the runs a job each, of the pictures all jobs' share: the time left is that of both
    weights = [*seconds[: len(runs)], *(jobs * each for each in seconds[len(runs) :])]
    progress = Progress(section, sum(weights), len(weights), pause=2)
    with ThreadPoolExecutor(jobs) as pool:
        begun = [pool.submit(make_run, recipes.runs[name], out / name, freefem) for name in runs]
        for weight, done in zip(weights, begun, strict=False):
            try:
                done.result()
            except BaseException:
                pool.shutdown(wait=True, cancel_futures=True)
                raise
            progress.step(weight)
    with style.look():
        for weight, (name, figure) in zip(weights[len(runs) :], drawn.items(), strict=True):
            draw(name, figure, out)
            progress.step(weight)


def choose(recipes: Recipes, wanted: list[str]) -> tuple[dict[str, Figure], list[str]]:
    """The figures to draw and the runs to make, each once."""
    wanted = wanted or list(recipes.figures) or list(recipes.runs)
    drawn: dict[str, Figure] = {}
    runs: list[str] = []
    for word in wanted:
        name = word.removesuffix(".pdf").removesuffix(".png").removesuffix("/summary.json")
        if name in recipes.figures and not word.endswith("/summary.json"):
            drawn[name] = recipes.figures[name]
            runs += recipes.figures[name].runs
        elif name in recipes.runs:
            runs.append(name)
        else:
            raise ResultsError(
                word, f"neither a figure nor a run of figures.toml; allowed: {', '.join(recipes.figures)}"
            )
    return drawn, list(dict.fromkeys(runs))


def files_of(name: str, out: Path) -> list[Path]:
    return [out / f"{name}.{kind}" for kind in ("pdf", "png")]


def is_drawn(name: str, figure: Figure, out: Path) -> bool:
    """Whether a figure is later than its runs and than what draws it."""
    made = files_of(name, out)
    sources = [out / run / "summary.json" for run in figure.runs] + list(Path(__file__).parent.parent.rglob("*.py"))
    return all(path.exists() for path in made) and min(path.stat().st_mtime for path in made) >= max(
        path.stat().st_mtime for path in sources if path.exists()
    )


def draw(name: str, figure: Figure, out: Path) -> None:
    runs = [read_run(out / run) for run in figure.runs]
    for path in write_figure(figures.modules()[figure.module].draw(runs, style.Units()), files_of(name, out)[0]):
        print(path)
