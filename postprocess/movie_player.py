"""A movie as matplotlib's HTML player, made to work without network and for screen readers, as GIF, and as MP4."""

import hashlib
import html
import logging
import re
import tempfile
from pathlib import Path
from typing import Protocol

from matplotlib.animation import AbstractMovieWriter, FFMpegWriter, HTMLWriter, PillowWriter
from matplotlib.figure import Figure

from postprocess import style

BEGIN, END = "<!-- player -->", "<!-- end of player -->"
MILLISECONDS = 800  # a frame
HOLD = 3  # frames for which the GIF shows the last one
MANY = 40  # frames above which they are drawn smaller

# The player's buttons ask for an icon font from the network; these characters stand in for it.
ICONS = {
    "minus": "\u2212",
    "plus": "+",
    "fast-backward": "|\u25c0",
    "step-backward": "\u2039",
    "play": "\u25b6\ufe0e",
    "play.fa-flip-horizontal": "\u25c0\ufe0e",
    "pause": "\u2016",
    "step-forward": "\u203a",
    "fast-forward": "\u25b6|",
}


class Animation(Protocol):
    """Frames that are drawn into one figure, one after the other: NewtonMovie, PathMovie."""

    figure: Figure
    count: int

    def draw(self, index: int) -> None:
        """Draws frame `index`, 0 ... count - 1, in place of the one before."""


def render(movie: Animation, described: str, speed: float = 1) -> tuple[str, bytes, bytes | None]:
    """Every frame drawn once: the player as a piece of HTML between BEGIN and END, the GIF's bytes, the MP4's.

    described: what the pictures show, for those who do not see them. speed: 2 is twice as fast. No MP4 without ffmpeg.
    """
    dpi = 100 if movie.count <= MANY else 72
    rate = 1000 / MILLISECONDS * speed
    timing: style.Look = {"fps": rate}
    web = HTMLWriter(**timing, embed_frames=True, default_mode="once", embed_limit=1e6)
    gif = PillowWriter(**timing)
    still: list[AbstractMovieWriter] = [gif]
    if FFMpegWriter.isAvailable():
        even = ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-fflags", "+bitexact"]
        still.append(FFMpegWriter(**timing, codec="libx264", extra_args=even))
    with tempfile.TemporaryDirectory() as folder, style.look():
        page, picture, film = (Path(folder) / name for name in ("player.html", "movie.gif", "movie.mp4"))
        web.setup(movie.figure, page, dpi=dpi)
        for writer, path in zip(still, (picture, film), strict=False):
            writer.setup(movie.figure, path, dpi=dpi)
        for index in range(movie.count):
            movie.draw(index)
            web.grab_frame()
            for writer in still:
                writer.grab_frame()
        for writer in still * (HOLD - 1):
            writer.grab_frame()
        web.finish()
        logging.getLogger("PIL").setLevel(logging.WARNING)
        for writer in still:
            writer.finish()
        moving = film.read_bytes() if film.exists() else None
        return adapted(page.read_text(encoding="utf-8"), described), picture.read_bytes(), moving


def adapted(player: str, described: str) -> str:
    """matplotlib's player without its reference to the network, with texts for a screen reader and a name of its own.

    The name comes from the content: the same movie gives the same bytes.
    """
    player = re.sub(r"<link\b[^>]*>", "", player)
    player = player.replace(' language="javascript"', "")
    (name,) = set(re.findall(r"_anim_img([0-9a-f]{32})", player))
    player = player.replace(name, "0" * 32)
    player = player.replace("0" * 32, hashlib.sha256(player.encode()).hexdigest()[:16])
    described = html.escape(described, quote=True)
    player = re.sub(r'<img id="', f'<img alt="{described}" id="', player, count=1)
    player = player.replace('type="range"', 'type="range" aria-label="Frame"', 1)
    player = player.replace('<i class="fa', '<i aria-hidden="true" class="fa')
    player = player.replace("<button ", '<button type="button" ')
    icons = "".join(f'.fa-{name}::before{{content:"{text}"}}' for name, text in ICONS.items())
    look = (
        "<style>.animation,.animation img{max-width:100%}.animation img{height:auto}"
        "input[type=range].anim-slider{width:min(374px,100%)}.anim-buttons button{min-width:32px;min-height:32px}"
        f".fa{{font-style:normal}}{icons}@media print{{.anim-controls{{display:none}}}}</style>"
    )
    without = "<noscript><p>The player needs JavaScript. The same frames are in movie.gif.</p></noscript>"
    return "\n".join([BEGIN, player.strip(), look, without, END])


def extract(page: str) -> str | None:
    """The player of a page that `render` was used for; None when there is none, or not the whole of it."""
    begin, end = page.find(BEGIN), page.find(END)
    return page[begin : end + len(END)] if 0 <= begin < end else None
