"""Files written whole or not at all; a figure as FILE.pdf and FILE.png."""

import contextlib
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from postprocess.results import ResultsError, system_message

# No dates and no versions: the same results give the same bytes.
DRAWN = "Drawn"
METADATA = {"pdf": {"CreationDate": None, "Producer": None, "Creator": None}, "png": {"Software": None}}


def write_figure(figure: Figure, out: Path | str) -> list[Path]:
    """Writes the figure as `out`, whose name ends in .pdf, and as PNG beside it; returns both paths."""
    return write_figures({Path(out): figure})


def write_figure_of_run(figure: Figure, out: Path | str | None, usual: Path) -> None:
    """Writes the figure as `out`, or without it as the run's own file `usual`; prints the paths."""
    if not out:
        register_files_of_run(usual.parent, [usual.with_suffix(f".{kind}").name for kind in METADATA])
    for path in write_figure(figure, out or usual):
        print(path)


def write_figures(figures: dict[Path, Figure]) -> list[Path]:
    """Writes each figure under its name, which ends in .pdf, and as PNG beside it: all of them, or none.

    Its layout is found once and holds from then on: savefig() would draw twice for each file, to find it anew.
    """
    writers = {}
    for out, figure in figures.items():
        if out.suffix != ".pdf":
            raise ResultsError(out, "the name of a figure ends in .pdf (the PNG is written beside it)")
        for kind, metadata in METADATA.items():
            writers[out.with_suffix(f".{kind}")] = figure_writer(figure, kind, metadata)
    return write_all_or_none(writers)


def figure_writer(figure: Figure, kind: str, metadata: dict) -> Callable[[Path], object]:
    def write(path: Path) -> None:
        engine = figure.get_layout_engine()
        if engine is not None:
            engine.execute(figure)
            figure.set_layout_engine(None)
        told = {DRAWN: drawn_numbers(figure)} if kind == "png" else {}
        figure.savefig(path, format=kind, metadata=metadata | told)

    return write


def drawn_numbers(figure: Figure) -> str:
    """What a figure shows, in numbers: of each panel the limits, of each line its means and its greatest height."""
    found: list[float] = []
    for axes in figure.axes:
        found += [*axes.get_xlim(), *axes.get_ylim()]
        for line in axes.lines:
            points = np.asarray(line.get_xydata(), float)
            points = points[np.isfinite(points).all(axis=1)]
            found += [*points.mean(axis=0), points[:, 1].max()] if len(points) else []
    return " ".join(f"{value:.4g}" for value in found)


def write_files(contents: dict[Path, bytes]) -> list[Path]:
    """Writes each content under its name: all of them, or none."""
    return write_all_or_none({path: bytes_writer(data) for path, data in contents.items()})


def bytes_writer(data: bytes) -> Callable[[Path], object]:
    return lambda path: path.write_bytes(data)


def register_files_of_run(folder: Path, names: list[str]) -> None:
    """Names files drawn from the run in a folder as the run's own: the next run into it removes them with the rest."""
    listed = folder / ".run" / ".written"
    if listed.exists():
        with contextlib.suppress(OSError), listed.open("a") as file:
            file.writelines(f"{name}\n" for name in names)


def write_all_or_none(writers: dict[Path, Callable[[Path], object]]) -> list[Path]:
    """Calls each path's writer with a temporary name in the same folder, then renames them all; returns the paths.

    Folders are created when they are missing. When a writer fails nothing is left behind.
    """
    written = {}
    first = next(iter(writers))
    try:
        for path, writer in writers.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            written[path] = path.with_name(f".{path.name}.{os.getpid()}.part")
            writer(written[path])
        for path, temporary in written.items():
            os.replace(temporary, path)
    except OSError as error:
        raise ResultsError(error.filename2 or error.filename or first, system_message(error)) from None
    finally:
        for temporary in written.values():
            with contextlib.suppress(OSError):
                temporary.unlink()
    return list(writers)
