"""Frames of a run along a path (-path): force against approach, and the pressures, a frame a state."""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from postprocess import style
from postprocess.results import ResultsError, Run, read_table

SIZE = (8.6, 3.6)  # inches
COLUMNS = "state leg approach force stability jump dissipated".split()


def along_path(run: Run) -> bool:
    """Whether the run followed a path, and kept no states of its Newton steps."""
    return (run.path / "path.csv").exists() and not (run.path / "states.csv").exists()


class PathMovie:
    """Draws the frames of one run, which was made with -path, into one figure."""

    def __init__(self, run: Run, units: style.Units):
        self.run, self.units = run, units
        self.rows = read_table(run.path / "path.csv", COLUMNS, "the run needs -path")
        table = read_table(run.path / "profiles.csv", "state x pressure".split(), "the run needs -path")
        self.count, points = len(self.rows["state"]), run.summary["points"]
        if len(table["x"]) != self.count * points:
            raise ResultsError(
                run.path / "profiles.csv", f"has {len(table['x'])} rows, not {self.count} times {points}"
            )
        self.x = table["x"].reshape(self.count, points)[0]
        self.pressure = table["pressure"].reshape(self.count, points)
        self.figure = Figure(figsize=SIZE)
        FigureCanvasAgg(self.figure)
        self.left = self.figure.add_axes((0.09, 0.15, 0.38, 0.7))
        self.right = self.figure.add_axes((0.59, 0.15, 0.38, 0.7))
        self.round = run.summary["parameters"].get("geometry") in (None, "axisymmetric")  # else per unit of thickness
        fine = run.summary["parameters"].get("fine", np.abs(self.x).max())
        self.window = (max(self.x.min(), -fine), fine)

    def draw(self, index: int) -> None:
        """Draws frame `index`, 0 ... count - 1, in place of the one before."""
        rows, approach, force = self.rows, self.rows["approach"], self.rows["force"]
        self.left.clear()
        self.right.clear()
        self.left.plot(approach, force, color=style.GREY, linewidth=0.6)
        gone = slice(0, index + 1)
        self.left.plot(approach[gone], force[gone], color=style.BLUE)
        jumped = [row for row in range(1, index + 1) if rows["jump"][row]]
        for row in jumped:
            self.left.plot(approach[row - 1 : row + 1], force[row - 1 : row + 1], color=style.VERMILION)
        self.left.plot(approach[index], force[index], marker="o", color=style.BLACK)
        self.left.set_xlabel(f"approach [{self.units.length}]")
        power = "²" if self.round else ""
        self.left.set_ylabel(f"force [{self.units.stress} × {self.units.length}{power}]")
        self.right.plot(self.x, self.pressure[index], color=style.BLUE, marker=".", markersize=3)
        self.right.axhline(0, color=style.GREY, linewidth=0.4)
        shown = (self.x >= self.window[0]) & (self.x <= self.window[1])
        low, high = self.pressure[:, shown].min(), self.pressure[:, shown].max()
        self.right.set_ylim(low - 0.05 * (high - low), high + 0.05 * (high - low))
        self.right.set_xlim(*self.window)
        self.right.set_xlabel(f"$x$ [{self.units.length}]")
        self.right.set_ylabel(f"pressure [{self.units.stress}]")
        self.figure.suptitle(self.title(index), fontsize=10)

    def title(self, index: int) -> str:
        """Which state, whether it was jumped to, whether it is stable."""
        rows = self.rows
        words = f"state {index + 1} of {self.count}, approach ${style.number(rows['approach'][index])}$"
        if rows["jump"][index]:
            words += f", jumped: ${style.number(rows['dissipated'][index])}$ dissipated"
        return words + ("" if rows["stability"][index] >= 0 else ", not stable")
