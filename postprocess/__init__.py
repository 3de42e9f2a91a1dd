"""Figures and tables from the result files of contact runs.

The package reads what a run wrote into its folder and nothing else: it computes no contact and knows no solver.

    results.py    result files -> checked numpy arrays
    tree.py       a folder of results -> its runs, figures and movies
    words.py      a run in words, and the command that makes it again
    references.py what a run should have given, and how far from it it may be
    style.py      fonts, colours, widths and labels that all figures share
    output.py     files, and a figure as FILE.pdf and FILE.png, whole or not at all
    laws.py       the law of a run as a curve
    frames.py     the pictures of a movie; player.py: as a page's player and as GIF
    page.py       pieces of a self-contained page, around templates/; report.py: the report
    doctor.py     what is installed and what is missing: needs nothing but Python itself
    figures/      one file per figure: draw(runs, units) -> matplotlib Figure
    commands/     one file per subcommand of `python -m postprocess`

A new figure or subcommand is one new file in its folder; nothing else has to know of it.
"""

import os
import sys

if sys.argv[0] == "-m":  # python -m postprocess: the present folder, which Python put first, is no place of modules
    if not getattr(sys.flags, "safe_path", False):
        del sys.path[0]
    _root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    sys.path[:] = [*(path for path in sys.path if os.path.abspath(path) != _root), _root]
