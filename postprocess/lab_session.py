"""What the cells of a lab's notebook use: run FreeFEM, draw with the package's commands, read tables as arrays.

The first cell of a notebook imports these functions. Paths are relative to the package's folder, where the session is.
"""

import glob
import shlex
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from postprocess.command_line import main
from postprocess.results import Run, read_run

CONVERGED, NOT_CONVERGED = 0, 20  # exit codes of a run
PICTURE_WIDTH = 760  # pixels


def execute(*words: object, codes: tuple[int, ...] = (CONVERGED,)) -> str:
    """Runs a program, prints its output and returns it. Raises RuntimeError for an exit code not in `codes`."""
    command = [str(word) for word in words]
    lines = []
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        assert process.stdout
        for line in process.stdout:
            print(line, end="")
            lines.append(line)
    if process.returncode not in codes:
        raise RuntimeError(f"{shlex.join(command)}: exit code {process.returncode}")
    return "".join(lines)


def freefem(program: str, *flags: object, codes: tuple[int, ...] = (CONVERGED,)) -> str:
    """Runs a program of FreeFEM with its flags, prints its screen and returns it."""
    return execute("FreeFem++", "-nw", "-v", "0", program, *flags, codes=codes)


def run_of(program: str, *flags: object, out: str) -> Run:
    """Runs a program, its screen hidden, into the folder `out`; its results: `.summary`, `.contact`, `.history` …

    A run that does not converge is a result too (`.summary["converged"]`); a refused one raises RuntimeError.
    """
    words = ["FreeFem++", "-nw", "-v", "0", program, *map(str, flags), "-out", out]
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode not in (CONVERGED, NOT_CONVERGED):
        raise RuntimeError(done.stdout[-1000:])
    return read_run(Path(out))


def columns(path: str | Path) -> dict[str, np.ndarray]:
    """The columns of a CSV file of numbers, by their names."""
    table = np.genfromtxt(path, delimiter=",", names=True, deletechars="")
    return {name: np.atleast_1d(table[name]) for name in table.dtype.names or ()}


def pictures() -> set[tuple[Path, int]]:
    """The pictures of all results, with the time at which each was drawn."""
    return {(path, path.stat().st_mtime_ns) for path in Path("results").rglob("*.png")}


def postprocess(*words: object, codes: tuple[int, ...] = (0,)) -> None:
    """A command of `python -m postprocess`, in this process; shows the pictures that it draws. Paths may have `*`."""
    from IPython.display import Image, display  # only notebooks have it

    before = pictures()
    typed = [path for word in map(str, words) for path in (sorted(glob.glob(word)) or [word])]
    code = main(typed)
    if code not in codes:
        raise RuntimeError(f"postprocess {shlex.join(typed)}: exit code {code}")
    for path, _ in sorted(pictures() - before):
        display(Image(path, width=PICTURE_WIDTH))


def gmsh(*words: object) -> str:
    """Runs gmsh with these words."""
    return execute("gmsh", *words)


def explore(draw: Callable[..., object], **choices: Sequence[object]) -> None:
    """Calls `draw` with a choice of each name: those of sliders if ipywidgets is installed, otherwise the first."""
    try:
        import ipywidgets
    except ImportError:
        draw(**{name: values[0] for name, values in choices.items()})
        return
    slider = ipywidgets.SelectionSlider
    ipywidgets.interact(
        draw, **{name: slider(options=values, continuous_update=False) for name, values in choices.items()}
    )
