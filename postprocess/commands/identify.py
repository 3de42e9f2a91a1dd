"""identify the parameters of a law, of friction or of a material from measured values

MEASURED.csv has a column with the load (approach, load, or a flag as -drag) and columns with measured results (force,
approach, stiffness, contactLength, halfWidth, radius, pressure, overlap, or a number's name in rows.csv). A column sd,
or NAME_sd, has standard deviations; without it they are estimated, relative to the values. RUN is the result folder
of a run of the same bodies: its flags are kept, except those of --fit. Written are identify.json, identify.pdf and
identify.png in RUN, or in --out. Exit code 20: no fit has converged.
"""

import argparse
import json
import math
import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from postprocess import style
from postprocess.law_fits import LAWS, LawFit, fit_law, read_parameters
from postprocess.least_squares import Fit
from postprocess.measurements import LOADS, Measurements, read_measurements
from postprocess.output import figure_writer, register_files_of_run, write_all_or_none
from postprocess.problem_rows import Problem, read_problem
from postprocess.results import ResultsError

UNLIKELY = 0.01  # probability of the misfit below which a law is rejected
DECISIVE = 10.0  # difference of the criteria from which on the worse law has no support
CLOSE = 2.0  # and below which both laws are as good
THICK = 10.0  # ratio of -d0 to the greatest approach from which on -d0 is in doubt
WIDEST = 1e6  # ratio of the ends of an interval from which on it says nothing
SIZE = (style.PAGE, 0.42 * style.PAGE)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("measured", metavar="MEASURED.csv", type=Path, help="measured pairs")
    parser.add_argument("folder", metavar="RUN", type=Path, help="result folder of a run of these bodies")
    parser.add_argument("--fit", metavar="NAMES", help='parameters, as "kappa 1:1e9, m, E" (default: those of the law)')
    parser.add_argument("--laws", metavar="WORDS", help="laws that are compared (default: that of the run)")
    parser.add_argument("--starts", type=int, default=1, metavar="N", help="fits from so many first values (default 1)")
    parser.add_argument("--out", metavar="DIR", type=Path, help="where to write (default: RUN)")


def run(arguments: argparse.Namespace) -> None:
    """Fits each law, prints the report, writes the files."""
    problem = read_problem(arguments.folder)
    measured = read_measurements(arguments.measured)
    check_loads(problem, measured)
    laws = (arguments.laws or str(problem.parameters["law"])).split()
    unknown = [law for law in laws if law not in LAWS]
    if unknown:
        raise ResultsError("--laws", f"{unknown[0]}: allowed: {' '.join(LAWS)}")
    wanted = arguments.fit or ", ".join(dict.fromkeys(name for law in laws for name in LAWS[law]))
    sought = read_parameters(wanted, problem)
    fits = [found for law in laws if (found := fit_law(law, problem, measured, sought, arguments.starts))]
    if not fits:
        raise ResultsError(
            arguments.measured, "no first values have a solution at all loads; allowed: another RUN or --fit"
        )
    fits.sort(key=lambda one: one.fit.criteria()[0])
    for line in report(fits, measured, problem):
        print(line)
    write(arguments.out or arguments.folder, arguments.out is None, fits, measured)
    if not any(one.fit.converged for one in fits):
        sys.exit(20)


def check_loads(problem: Problem, measured: Measurements) -> None:
    """Refuses a load that the run has not, and a result that it prescribes."""
    if measured.flag not in problem.parameters:
        raise ResultsError("MEASURED.csv", f"-{measured.flag}: no flag of this run")
    by_force = measured.flag == "force"
    if not by_force and float(problem.parameters.get("force", 0)) > 0 and measured.flag == "u0":
        raise ResultsError(
            "MEASURED.csv", "approach: RUN has a prescribed force; allowed: load, or a RUN without -force"
        )
    prescribed = "force" if by_force else "approach"
    if measured.flag in LOADS.values() and prescribed in measured.names:
        raise ResultsError("MEASURED.csv", f"{prescribed}: is the load; allowed: other results")
    if by_force and min(measured.loads) <= 0:
        raise ResultsError("MEASURED.csv", "load: allowed: forces above 0")


# ---------------------------------------------------------------- report


def shown(value: float) -> str:
    return f"{value:.5g}"


def direction_text(found: Fit, direction: np.ndarray) -> str:
    """A direction in logarithms as a product of powers: kappa^0.71 m^-0.7."""
    parts = [(one.name, share) for one, share in zip(found.parameters, direction, strict=True) if abs(share) > 0.05]
    return " ".join(name if len(parts) == 1 else f"{name}^{share:.2g}" for name, share in parts)


def warnings_of(one: LawFit) -> list[str]:
    """What makes the values of a fit doubtful."""
    found = one.fit
    said = []
    if found.freedom < 0:
        said.append(
            f"{len(found.residuals)} values cannot determine {len(found.parameters)} parameters: measure at more loads"
        )
    for direction in found.undetermined:
        said.append(
            f"the data do not determine {direction_text(found, direction)}: measure at other loads, or fit less"
        )
    if found.at_bound:
        said.append(f"{' '.join(found.at_bound)} at a bound: widen it, or fit less")
    if not found.converged:
        said.append("the fit has not converged: start from a RUN with closer parameters")
    if found.misfit_probability() < UNLIKELY:
        said.append(
            f"the law does not fit: a sum of squares of {shown(found.sum_of_squares)} has a probability of "
            f"{found.misfit_probability():.1g}: try other --laws, or larger standard deviations"
        )
    return said


def report(fits: list[LawFit], measured: Measurements, problem: Problem) -> list[str]:
    """The lines of the screen, the preferred law first."""
    scatter = "stated" if measured.is_scatter_known else "estimated, relative"
    lines = [f"{len(measured.values)} measured values at {len(measured.loads)} loads, standard deviations {scatter}"]
    start, reach = abs(float(problem.parameters.get("d0", 0))), max(map(abs, measured.loads))
    if measured.flag == "u0" and start > THICK * reach and "d0" not in fits[0].fit.values:
        lines.append(
            f"warning: the law of RUN begins at d0 -{shown(start)}, far beyond all approaches, at most {shown(reach)}: "
            "give the run its -d0, or fit it"
        )
    for one in fits:
        found = one.fit
        lines += ["", f"law {one.law}, {style.count(found.steps, 'step')}"]
        for k, parameter in enumerate(found.parameters):
            low, high = found.interval(k)
            size = sorted((abs(low), abs(high)))
            determined = math.isfinite(size[1]) and size[1] <= WIDEST * size[0]
            ends = f"{shown(low)} to {shown(high)}" if determined else "not determined"
            lines.append(f"  {parameter.name:10s}{shown(found.values[parameter.name]):>12s}   95 %: {ends}")
        correlation = found.correlation()
        for j in range(len(found.parameters)):
            for k in range(j):
                names = f"{found.parameters[k].name}, {found.parameters[j].name}"
                lines.append(f"  correlation of {names}: {correlation[k, j]:.3f}")
        if measured.is_scatter_known:
            lines.append(f"  sum of squares {shown(found.sum_of_squares)} of {found.freedom} expected")
        elif found.freedom > 0:
            lines.append(f"  scatter of the values {100 * found.scatter:.3g} %")
        lines += [f"  warning: {words}" for words in warnings_of(one)]
    if len(fits) > 1:
        lines += ["", *ranking(fits)]
    return [*lines, "", f"{problem.calls} runs of FreeFEM"]


def ranking(fits: list[LawFit]) -> list[str]:
    """The criteria of all laws, and which is preferred."""
    lines = ["law            AICc       BIC"]
    for one in fits:
        akaike, schwarz = one.fit.criteria()
        lines.append(f"{one.law:10s}{akaike:9.2f} {schwarz:9.2f}")
    gap = fits[1].fit.criteria()[0] - fits[0].fit.criteria()[0]
    words = f"preferred: {fits[0].law}, AICc lower by {gap:.1f}"
    if not gap >= CLOSE:
        words = f"not distinguished: {fits[0].law} and {fits[1].law} fit alike"
    elif gap >= DECISIVE:
        words += ": the others have no support"
    return [*lines, words]


# ---------------------------------------------------------------- files


def content(fits: list[LawFit], measured: Measurements) -> dict:
    """What identify.json has."""
    laws = []
    for one in fits:
        found = one.fit
        parameters = {
            parameter.name: {
                "value": found.values[parameter.name],
                "interval95": [end if math.isfinite(end) else None for end in found.interval(k)],
                "deviation": found.deviation(k) if math.isfinite(found.deviation(k)) else None,
                "logarithmic": parameter.is_logarithmic,
            }
            for k, parameter in enumerate(found.parameters)
        }
        akaike, schwarz = found.criteria()
        misfit = found.misfit_probability()
        laws.append(
            {
                "law": one.law,
                "parameters": parameters,
                "correlation": found.correlation().tolist(),
                "singularValues": [value for value, _ in found.directions],
                "sumOfSquares": found.sum_of_squares,
                "freedom": found.freedom,
                "scatter": found.scatter if math.isfinite(found.scatter) else None,
                "misfitProbability": misfit if math.isfinite(misfit) else None,
                "AICc": akaike if math.isfinite(akaike) else None,
                "BIC": schwarz,
                "converged": found.converged,
                "warnings": warnings_of(one),
                "modelled": found.modelled.tolist(),
                "residuals": found.residuals.tolist(),
            }
        )
    data = [
        {"load": measured.loads[at], "result": name, "measured": value, "deviation": deviation}
        for at, name, value, deviation in zip(
            measured.at, measured.names, measured.values, measured.deviations, strict=True
        )
    ]
    return {"load": measured.flag, "scatterKnown": measured.is_scatter_known, "data": data, "laws": laws}


def draw(fits: list[LawFit], measured: Measurements) -> Figure:
    """Measured values with the fitted laws, and the residuals below: a column for each result."""
    names = list(dict.fromkeys(measured.names))
    figure = Figure(figsize=SIZE, layout="constrained")
    panels = figure.subplots(2, len(names), squeeze=False, sharex=True, height_ratios=[2, 1])
    for column, name in enumerate(names):
        members = [k for k, one in enumerate(measured.names) if one == name]
        at = np.array([measured.loads[measured.at[k]] for k in members])
        order = np.argsort(at)
        above, below = panels[0, column], panels[1, column]
        values, bars = (np.array(each)[members] for each in (measured.values, measured.deviations))
        known = bars if measured.is_scatter_known else bars * fits[0].fit.scatter
        above.errorbar(at, values, np.nan_to_num(known), fmt="o", color=style.BLACK, markersize=3, label="measured")
        for index, one in enumerate(fits):
            look = style.curve(index)
            above.plot(at[order], one.fit.modelled[members][order], label=one.law, **look)
            below.plot(at[order], one.fit.residuals[members][order] / one.fit.scatter, **look)
        below.axhspan(-2, 2, color="#DDDDDD", zorder=0)
        above.set_ylabel(style.without_mathtext(name.split(".")[-1]))
        below.set_ylabel("residual / sd")
        below.set_xlabel({"u0": "approach", "force": "load"}.get(measured.flag, measured.flag))
        above.legend()
    return figure


def write(folder: Path, is_of_run: bool, fits: list[LawFit], measured: Measurements) -> None:
    """Writes identify.json and the figure, all or none; prints their paths."""
    text = json.dumps(content(fits, measured), indent=1) + "\n"
    with style.look():
        figure = draw(fits, measured)
        writers = {folder / "identify.json": lambda part: part.write_bytes(text.encode())}
        for kind in ("pdf", "png"):
            writers[folder / f"identify.{kind}"] = figure_writer(figure, kind, {})
        if is_of_run:
            register_files_of_run(folder, [path.name for path in writers])
        else:
            folder.mkdir(parents=True, exist_ok=True)
        for path in write_all_or_none(writers):
            print(path)
