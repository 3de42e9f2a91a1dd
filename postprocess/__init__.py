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
