"""draw a run's Newton steps, or its path, as a movie: a page with a player, a GIF, an MP4

RUN is a result folder of a run made with -states 1, or with -path. Written are DIR/movie.html and DIR/movie.gif, and
where ffmpeg is DIR/movie.mp4: all, or none. With --frame K, DIR/frame-K.svg alone.
One frame per Newton step: the collocation points in the (overlap, pressure) plane on the law's curve with its wall,
the pressure along the contact, and the deformed bodies; or a frame per state of the path: force against approach, and
the pressures. The page needs no network.
"""

import argparse
import io
from pathlib import Path

from matplotlib import rc_context

from postprocess import html_page, style
from postprocess.commands.show import value_text
from postprocess.formatting import HISTORY_COLUMNS, history_rows, run_caption
from postprocess.movie_player import render
from postprocess.newton_movie import NewtonMovie
from postprocess.output import register_files_of_run, write_files
from postprocess.path_movie import PathMovie, along_path
from postprocess.results import ResultsError, Run, one_line, read_run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RUN", help="a run's result folder")
    parser.add_argument("--out", required=True, metavar="DIR", help="where to write; folders are created")
    parser.add_argument("--speed", type=float, default=1.0, metavar="S", help="2: twice as fast (default: 1)")
    parser.add_argument("--frame", type=int, metavar="K", help="write one frame as SVG; the first is 1")
    style.add_units(parser)


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws the frames, writes the files and prints their paths."""
    if not 0 < arguments.speed < 1000:
        raise ResultsError(arguments.folder, f"--speed {arguments.speed:g}: allowed: above 0, below 1000")
    chosen = read_run(arguments.folder)
    try:
        with style.look():
            kind = PathMovie if along_path(chosen) else NewtonMovie
            movie = kind(chosen, style.Units(*map(style.without_mathtext, arguments.units)))
            if arguments.frame is not None:
                contents = {
                    Path(arguments.out) / f"frame-{arguments.frame}.svg": one_frame(chosen, movie, arguments.frame)
                }
        if arguments.frame is None:
            player, picture, film = render(movie, description(chosen), arguments.speed)
    except (ValueError, OverflowError) as error:
        raise ResultsError(chosen.path, f"cannot be drawn: {one_line(str(error))}") from None
    folder = Path(arguments.out)
    if arguments.frame is None:
        contents = {folder / "movie.html": web_page(chosen, player).encode(), folder / "movie.gif": picture}
        contents |= {folder / "movie.mp4": film} if film else {}
    register_files_of_run(folder, [path.name for path in contents])
    for path in write_files(contents):
        print(path)


def one_frame(run: Run, movie: NewtonMovie | PathMovie, number: int) -> bytes:
    """A frame as SVG."""
    if not 1 <= number <= movie.count:
        raise ResultsError(run.path, f"--frame {number}: allowed: 1 to {movie.count}")
    movie.draw(number - 1)
    written = io.BytesIO()
    with rc_context({"svg.hashsalt": run.path.name}):  # the same frame gives the same bytes
        movie.figure.savefig(written, format="svg", metadata={"Date": None, "Creator": None})
    return written.getvalue()


def description(run: Run) -> str:
    """What the movie shows, in words."""
    if along_path(run):
        return (
            f"One picture per state of the run {run_caption(run)}. Left: the force against the approach so far, "
            "with jumps. Right: the pressure along the contact."
        )
    return (
        f"One picture per Newton step of the run {run_caption(run)}. Left: each contact point's overlap and pressure, "
        "beside the curve of the law and its wall. Right: the pressure along the contact, and the deformed bodies. "
        "The table of Newton steps tells the same in numbers."
    )


def web_page(run: Run, player: str) -> str:
    """The player, and the same steps as a table."""
    words = (
        "Each dot is a contact point. Its overlap and pressure come from a linear solve: they are in equilibrium, "
        "but on the curve of the law only once the iteration has converged."
    )
    if along_path(run):
        words = "A frame is a state of the path: what the surfaces do as they come together and part."
    head = [html_page.element("h1", f"The method at work: {run_caption(run)}"), html_page.element("p", words)]
    steps = html_page.table("Newton steps", HISTORY_COLUMNS, history_rows(run), range(len(HISTORY_COLUMNS)))
    outcome = html_page.element(
        "p", f"Force {value_text(run.summary['force'])}, residual {value_text(run.summary['residual'])}."
    )
    body = html_page.joined([*head, html_page.Markup(player), outcome, steps])
    return html_page.document(f"Newton steps: {run_caption(run)}", html_page.element("main", body, id="main"))
