"""Figures and tables from the result files of contact runs.

The package reads what a run wrote into its folder and nothing else: it computes no contact and knows no solver.

    results.py    result files -> checked numpy arrays
    style.py      fonts, colours, widths and labels that all figures share
    output.py     files, and a figure as FILE.pdf and FILE.png, whole or not at all
    figures/      one file per figure: draw(runs, units) -> matplotlib Figure
    commands/     one file per subcommand of `python -m postprocess`

A new figure or subcommand is one new file in its folder; nothing else has to know of it.
"""
