"""A figure written as FILE.pdf and FILE.png: both whole, or neither."""

import contextlib
import os
from pathlib import Path

from matplotlib.figure import Figure

from postprocess.results import ResultsError, reason

# No dates and no versions: the same results give the same bytes.
METADATA = {"pdf": {"CreationDate": None, "Producer": None, "Creator": None}, "png": {"Software": None}}


def write_figure(figure: Figure, out: Path | str) -> list[Path]:
    """Writes the figure as `out`, whose name ends in .pdf, and as PNG beside it; returns both paths.

    Both are first written under temporary names in the same folder, which is created when it is missing.
    """
    out = Path(out)
    if out.suffix != ".pdf":
        raise ResultsError(out, "the name of a figure ends in .pdf (the PNG is written beside it)")
    written = {}
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        for kind, metadata in METADATA.items():
            path = out.with_suffix(f".{kind}")
            written[path] = path.with_name(f".{path.name}.{os.getpid()}.part")
            figure.savefig(written[path], format=kind, metadata=metadata)
        for path, temporary in written.items():
            os.replace(temporary, path)
    except OSError as error:
        raise ResultsError(error.filename2 or error.filename or out, reason(error)) from None
    finally:
        for temporary in written.values():
            with contextlib.suppress(OSError):
                temporary.unlink()
    return list(written)
