"""draw one figure from one or more run folders

FILE.pdf is written, and FILE.png beside it: both, or neither.
"""

import argparse

from postprocess import figures, style
from postprocess.formatting import first_line
from postprocess.output import write_figure
from postprocess.results import ResultsError, read_run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    modules = figures.modules()
    width = max(map(len, modules)) + 2
    table = [f"  {name:<{width}}{first_line(module)}" for name, module in modules.items()]
    parser.epilog = "\n".join(["figures:", *table])
    parser.add_argument("name", choices=list(modules), metavar="NAME", help="which figure to draw")
    parser.add_argument("folders", nargs="+", metavar="DIR", help="a run's or a campaign's result folder")
    parser.add_argument("--out", required=True, metavar="FILE.pdf", help="where to write; folders are created")
    style.add_units(parser)


def run(arguments: argparse.Namespace) -> None:
    """Reads the runs, draws the figure, writes it and prints the paths."""
    module = figures.modules()[arguments.name]
    least, most = module.RUNS
    given = len(arguments.folders)
    if given < least or (most is not None and given > most):
        wanted = f"{least}" if least == most else f"{least} or more"
        raise ResultsError(arguments.name, f"takes {wanted} run folder(s), {given} given")
    read = getattr(module, "READ", read_run)
    runs = [read(folder) for folder in arguments.folders]
    with style.look():
        figure = module.draw(runs, style.Units(*map(style.without_mathtext, arguments.units)))
        for path in write_figure(figure, arguments.out):
            print(path)
