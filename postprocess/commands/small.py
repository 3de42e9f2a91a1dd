"""make a picture small: fewer pixels, few colours, for a page

PICTURE is a PNG or a GIF; a GIF stays a movie. FILE is written whole or not at all.
"""

import argparse
import io
from pathlib import Path

from PIL import Image, ImageSequence, UnidentifiedImageError

from postprocess.output import write_files
from postprocess.results import ResultsError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("picture", metavar="PICTURE", help="a PNG or a GIF")
    parser.add_argument("--out", required=True, metavar="FILE", help="where to write; folders are created")
    parser.add_argument("--width", type=int, default=1000, metavar="PIXELS", help="its width (default: %(default)s)")
    parser.add_argument("--colours", type=int, default=64, metavar="N", help="2 to 256 (default: %(default)s)")


def run(arguments: argparse.Namespace) -> None:
    """Reads the picture, writes the small one and prints its path."""
    if not (arguments.width > 0 and 2 <= arguments.colours <= 256):
        raise ResultsError(arguments.picture, "--width is above 0, --colours from 2 to 256")
    try:
        with Image.open(arguments.picture) as picture:
            frames = [reduced(frame, arguments.width, arguments.colours) for frame in ImageSequence.Iterator(picture)]
            pause = picture.info.get("duration", 100)
            kind = picture.format
    except (OSError, UnidentifiedImageError) as error:
        raise ResultsError(arguments.picture, f"cannot be read: {error}") from None
    moving = {"save_all": True, "append_images": frames[1:], "duration": pause, "loop": 0} if len(frames) > 1 else {}
    written = io.BytesIO()
    frames[0].save(written, kind, optimize=True, **moving)
    for path in write_files({Path(arguments.out): written.getvalue()}):
        print(path)


def reduced(frame: Image.Image, width: int, colours: int) -> Image.Image:
    """A frame with so many pixels across, on white, and so many colours."""
    whole = frame.convert("RGBA")
    picture = Image.alpha_composite(Image.new("RGBA", whole.size, "white"), whole).convert("RGB")
    height = max(1, round(picture.height * width / picture.width))
    picture = picture.resize((width, height), Image.Resampling.LANCZOS)
    return picture.quantize(colours, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
