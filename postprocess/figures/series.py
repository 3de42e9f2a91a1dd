"""force against approach of load series (runs with -history 1)"""

from matplotlib.figure import Figure

from postprocess import style
from postprocess.results import Run, read_table

RUNS = (1, 7)

COLUMNS = "step fraction approach force pressureMax overlapMax contactPoints newton backsolves".split()


def draw(runs: list[Run], units: style.Units) -> Figure:
    """Above, the force over the approach, a curve a run; below, the share of the surface that is in contact."""
    figure = Figure(figsize=(style.COLUMN, 1.05 * style.COLUMN), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[1.6, 1])
    names = [f"{run.summary['scene']}, {style.method(run)}" for run in runs]
    for index, (run, name) in enumerate(zip(runs, names, strict=True)):
        rows = read_table(run.path / "series.csv", COLUMNS, "the run needs -history 1")
        above.plot(rows["approach"], rows["force"], label=name, **style.curve(index))
        below.plot(rows["approach"], 100 * rows["contactPoints"] / run.summary["points"], **style.curve(index))
    above.set_ylabel(f"force [{units.stress} × {units.length}]")
    above.set_ylim(0, None)
    below.set_ylabel("points in contact [%]")
    below.set_ylim(0, None)
    below.set_xlabel(f"approach [{units.length}]")
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper center")
    return figure
