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
from postprocess.recipes import Figure, Recipes, make_run, read_recipes
from postprocess.results import ResultsError, read_run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("section", metavar="SECTION", help="figures, paper or accuracy")
    parser.add_argument("what", metavar="WHAT", nargs="*", help="figures or runs (default: all)")
    parser.add_argument("--out", metavar="DIR", default="results", help="runs and figures go to DIR/SECTION")
    parser.add_argument(
        "--freefem", metavar="COMMAND", default="FreeFem++ -nw -v 0", help="FreeFEM's program and options"
    )
    parser.add_argument("--jobs", metavar="N", type=int, default=os.cpu_count(), help="runs at once (default: cores)")


def run(arguments: argparse.Namespace) -> None:
    """Makes the runs that are wanted, several at once, then draws the figures; prints what is written."""
    recipes, out = read_recipes(arguments.section), Path(arguments.out) / arguments.section
    drawn, runs = choose(recipes, arguments.what)
    with ThreadPoolExecutor(max(1, arguments.jobs)) as pool:
        freefem = shlex.split(arguments.freefem)
        for done in [pool.submit(make_run, recipes.runs[name], out / name, freefem) for name in runs]:
            try:
                done.result()
            except BaseException:
                pool.shutdown(wait=True, cancel_futures=True)
                raise
    with style.look():
        for name, figure in drawn.items():
            draw(name, figure, out)


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


def draw(name: str, figure: Figure, out: Path) -> None:
    """Draws a figure, unless it is later than its runs and than what draws it."""
    folders = [out / run for run in figure.runs]
    made = [out / f"{name}.{kind}" for kind in ("pdf", "png")]
    sources = [folder / "summary.json" for folder in folders] + list(Path(__file__).parent.parent.rglob("*.py"))
    if all(path.exists() for path in made):
        oldest = min(path.stat().st_mtime for path in made)
        if oldest >= max(path.stat().st_mtime for path in sources):
            return
    picture = figures.modules()[figure.module].draw([read_run(folder) for folder in folders], style.Units())
    for path in write_figure(picture, made[0]):
        print(path)
