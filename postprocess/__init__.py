"""Figures and tables from the result files of contact runs.

The package reads what a run wrote into its folder and nothing else: it computes no contact and knows no solver.

    results.py          result files -> checked numpy arrays
    results_folder.py   a folder of results -> its runs, figures and movies
    formatting.py       captions, numbers with errors and units, and the command that repeats a run
    case_report.py      the results of each contact, load, support and body of a case
    reference_values.py the expected results of a run, and their tolerances
    style.py            fonts, colours, widths and labels that all figures share
    progress.py         how long many runs take, said before and meanwhile
    output.py           files, and a figure as FILE.pdf and FILE.png, whole or not at all
    laws.py             the law of a run as a curve
    load_series.py      the load steps of a case as curves
    bodies.py           bodies and pressures in the plane; bodies_3d.py: in space; geometry_faces.py: numbered faces
    newton_movie.py     the frames of a movie of Newton steps; path_movie.py: of a load path
    movie_player.py     frames as a player in a page, as GIF and MP4
    html_page.py        elements of a self-contained page, around templates/; report.py: the report
    teaching_kit.py     slides, notes and handouts of the labs; slide_figures.py: the figures of the slides
    command_line.py     the subcommands; __main__.py starts them without the present folder's modules
    doctor.py           what is installed and what is missing: needs nothing but Python itself
    figures/            one file per figure: draw(runs, units) -> matplotlib Figure
    commands/           one file per subcommand of `python -m postprocess`

A new figure or subcommand is one new file in its folder; nothing else has to know of it.
"""
