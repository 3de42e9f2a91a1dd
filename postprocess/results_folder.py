"""What lies in a tree of results: runs, figures, movies."""

from dataclasses import dataclass
from pathlib import Path

from postprocess.results import ResultsError, Run, check_file, read_run, system_message

PNG_START, PNG_END = b"\x89PNG\r\n\x1a\n", b"IEND\xaeB`\x82"
FIGURES = ("figures", "bench", "stability")  # folders whose pictures are figures


@dataclass(frozen=True)
class ResultsFolder:
    """The folder, its runs by path, its figures and its movies' pages, each in alphabetical order."""

    path: Path
    runs: list[Run]
    figures: list[Path]
    movies: list[Path]

    def name(self, path: Path) -> str:
        """A path as it is called within the tree."""
        return path.relative_to(self.path).as_posix() if path != self.path else self.path.name


def read_results_folder(folder: Path | str) -> ResultsFolder:
    """Everything below a folder; a file that cannot be used is refused, none is left out silently."""
    path = Path(folder)
    if not path.is_dir():
        raise ResultsError(path, "no such folder" if not path.exists() else "is not a folder")
    try:
        summaries = sorted(path.rglob("summary.json"))
        pictures = [picture for name in FIGURES for picture in sorted((path / name).glob("*.png"))]
        movies = sorted(path.rglob("movie.html"))
    except OSError as error:
        raise ResultsError(error.filename or path, system_message(error)) from None
    return ResultsFolder(path, [read_run(summary.parent) for summary in summaries], pictures, movies)


def read_png(path: Path) -> bytes:
    """A picture's bytes, once they begin and end like those of a PNG."""
    data = read_bytes(path)
    if not data.startswith(PNG_START) or data[12:16] != b"IHDR":
        raise ResultsError(path, "is not a PNG")
    if not data.endswith(PNG_END):
        raise ResultsError(path, "is truncated: a PNG without its end")
    return data


def read_bytes(path: Path) -> bytes:
    check_file(path)
    try:
        return path.read_bytes()
    except OSError as error:
        raise ResultsError(path, system_message(error)) from None
