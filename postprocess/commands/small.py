"""make a picture small for a page: fewer pixels, 128 colours, no white margin

PICTURE is a PNG or a GIF, which stays a movie. A PNG keeps the numbers that it shows, and gets the recipe of the page
that it stands on: what a test compares. FILE is written whole or not at all.
"""

import argparse
import hashlib
import io
import re
from pathlib import Path

from PIL import Image, ImageChops, ImageOps, ImageSequence, UnidentifiedImageError
from PIL.PngImagePlugin import PngInfo

from postprocess import style
from postprocess.output import DRAWN, write_files
from postprocess.results import ResultsError

RECIPE = "Recipe"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("picture", metavar="PICTURE", help="a PNG or a GIF")
    parser.add_argument("--out", required=True, metavar="FILE", help="where to write; folders are created")
    parser.add_argument("--page", metavar="PAGE.md", help="the page with the commands that make the picture")
    parser.add_argument("--width", type=int, default=1000, metavar="PIXELS", help="its width (default: %(default)s)")


def run(arguments: argparse.Namespace) -> None:
    """Reads the picture, writes the small one and prints its path."""
    if arguments.width < 1:
        raise ResultsError(arguments.picture, "--width is above 0")
    try:
        with Image.open(arguments.picture) as picture:
            frames = [shrink_frame(frame, arguments.width) for frame in ImageSequence.Iterator(picture)]
            pause = picture.info.get("duration", 100)
            kind, told = picture.format, PngInfo()
            told.add_text(DRAWN, picture.info.get(DRAWN, ""))
    except (OSError, UnidentifiedImageError) as error:
        raise ResultsError(arguments.picture, f"cannot be read: {error}") from None
    moving: style.Look = {}
    if len(frames) > 1:
        frames = with_common_palette(frames)
        moving = {"save_all": True, "append_images": frames[1:], "duration": pause, "loop": 0}
    elif kind == "PNG":
        if arguments.page:
            told.add_text(RECIPE, recipe(Path(arguments.page)))
        frames = [frames[0].quantize(128, method=Image.Quantize.MEDIANCUT, kmeans=3, dither=Image.Dither.NONE)]
        moving = {"pnginfo": told}
    written = io.BytesIO()
    frames[0].save(written, kind, optimize=True, **moving)
    for path in write_files({Path(arguments.out): written.getvalue()}):
        print(path)


def recipe(page: Path) -> str:
    """A page, and what stands for the commands in it."""
    blocks = re.findall(r"^```sh\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S)
    return f"{page.as_posix()} {hashlib.sha256(''.join(blocks).encode()).hexdigest()[:16]}"


def shrink_frame(frame: Image.Image, width: int) -> Image.Image:
    """A frame with so many pixels across, on white, in steps of 3 of 255: not to be seen, and half the file."""
    whole = frame.convert("RGBA")
    picture = Image.alpha_composite(Image.new("RGBA", whole.size, "white"), whole).convert("RGB")
    picture = picture.crop(ImageChops.difference(picture, Image.new("RGB", picture.size, "white")).getbbox())
    picture = ImageOps.expand(picture, picture.width // 100, "white")
    height = max(1, round(picture.height * width / picture.width))
    return picture.resize((width, height), Image.Resampling.BOX).point(lambda level: 3 * round(level / 3))


def with_common_palette(frames: list[Image.Image]) -> list[Image.Image]:
    """The frames in the same 256 colours, so that what stands still does not flicker."""
    strip = Image.new("RGB", (frames[0].width, frames[0].height * len(frames)))
    for place, frame in enumerate(frames):
        strip.paste(frame, (0, frames[0].height * place))
    palette = strip.quantize(256, method=Image.Quantize.MAXCOVERAGE)
    return [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
