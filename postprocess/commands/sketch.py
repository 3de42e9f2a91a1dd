"""draw a picture of the lecture: a sketch or a closed form, no run needed

FILE.pdf is written, and FILE.png beside it: both, or neither.
"""

import argparse

from postprocess import slide_figures, style
from postprocess.formatting import first_line
from postprocess.output import write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    width = max(map(len, slide_figures.PICTURES)) + 2
    table = [f"  {name:<{width}}{first_line(draw)}" for name, draw in slide_figures.PICTURES.items()]
    parser.epilog = "\n".join(["pictures:", *table])
    parser.add_argument("name", choices=list(slide_figures.PICTURES), metavar="NAME", help="which picture to draw")
    parser.add_argument("--out", required=True, metavar="FILE.pdf", help="where to write; folders are created")
    parser.add_argument("--slide", action="store_true", help="in the size of a slide, with larger letters")


def run(arguments: argparse.Namespace) -> None:
    """Draws the picture, writes it and prints the paths."""
    with style.look():
        for path in write_figure(
            slide_figures.draw_picture(slide_figures.PICTURES[arguments.name], arguments.slide), arguments.out
        ):
            print(path)
