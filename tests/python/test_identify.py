"""The commands identify and uncertainty: intervals, warnings and ranking on a closed form, once by FreeFEM."""

import csv
import json
import math

import numpy as np
import pytest
from freefem import ROOT, run_in

from postprocess import law_fits
from postprocess.command_line import main
from postprocess.commands import identify, uncertainty
from postprocess.distributions import chi_squared_tail, student_quantile
from postprocess.least_squares import Parameter, fit
from postprocess.measurements import Measurements, read_measurements
from postprocess.problem_rows import Problem, read_problem
from postprocess.results import ResultsError

LOADS = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3]
BODY = 200.0  # stiffness of the body below the layer


def test_distributions():
    """Quantiles and tails shall be those of tables."""
    assert student_quantile(0.95, math.inf) == pytest.approx(1.959963984540054, rel=1e-12)
    for freedom, quantile in [(1, 12.706204736), (2, 4.302652730), (5, 2.570581836), (30, 2.042272456)]:
        assert student_quantile(0.95, freedom) == pytest.approx(quantile, rel=1e-9)
    for freedom, value in [(1, 3.841458821), (5, 11.07049769), (10, 18.30703805), (100, 124.3421134)]:
        assert chi_squared_tail(value, freedom) == pytest.approx(0.05, rel=1e-8)


class Springs(Problem):
    """A layer on a spring: the force P of p(P, u), with p(u - P/BODY) = P; derivatives from the same equation."""

    def solve(self, problems, sensitivities=True):
        self.calls += 1
        return [self.solve_one({**self.parameters, **one}, sensitivities) for one in problems]

    def solve_one(self, at, sensitivities):
        u = at["u0"]

        def law(s):
            if at["law"] == "power":
                pressure = at["kappa"] * s ** at["m"]
                return pressure, at["m"] * pressure / s, {"kappa": pressure / at["kappa"], "m": pressure * math.log(s)}
            grown = math.expm1(at["beta"] * s)
            slopes = {"p0": grown, "beta": at["p0"] * s * (grown + 1)}
            return at["p0"] * grown, at["p0"] * at["beta"] * (grown + 1), slopes

        low, high = 1e-12, u
        for _ in range(70):
            s = 0.5 * (low + high)
            low, high = (s, high) if law(s)[0] < BODY * (u - s) else (low, s)
        pressure, slope, by = law(s)
        row = {"force": pressure, "pressureMax": pressure}
        if sensitivities:
            share = BODY / (BODY + slope)
            row |= {f"sensitivities.force.{name}": value * share for name, value in by.items()}
            row["sensitivities.force.u0"] = slope * share
        return row


def springs(**changes):
    parameters = {"law": "power", "kappa": 300.0, "m": 3.0, "p0": 1.0, "beta": 10.0, "d0": -0.3, "E": 100.0, "u0": 0.1}
    parameters |= changes
    return Springs("springs", {}, parameters, {"pressureMax": 10.0})


def draw(generator, noise, truth, loads=LOADS, known=True):
    """Forces of these parameters with normal noise, relative to them."""
    exact = np.array([row["force"] for row in springs(**truth).solve([{"u0": load} for load in loads])])
    values = exact * (1 + noise * generator.standard_normal(len(loads)))
    deviations = noise * exact if known else np.abs(values)
    at = list(range(len(loads)))
    return Measurements("u0", list(loads), ["force"] * len(at), at, values.tolist(), deviations.tolist(), known)


TRUTHS = {
    "power": {"law": "power", "kappa": 800.0, "m": 2.2},
    "exponential": {"law": "exponential", "p0": 0.7, "beta": 18.0},
}


def identified(law, measured):
    names = ", ".join(law_fits.LAWS[law])
    return law_fits.fit_law(law, springs(), measured, law_fits.read_parameters(names, springs()), 1)


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize("law", TRUTHS)
def test_intervals_contain_the_truth(law, known):
    """Of 40 draws 34 shall have the truth in each 95 % interval, and known deviations shall be those of the draws."""
    generator = np.random.default_rng(4)
    inside, squares = np.zeros(2), np.zeros(2)
    for _ in range(40):
        found = identified(law, draw(generator, 0.02, TRUTHS[law], known=known)).fit
        assert found.converged and not found.undetermined
        for k, one in enumerate(found.parameters):
            low, high = found.interval(k)
            inside[k] += low <= TRUTHS[law][one.name] <= high
            squares[k] += (math.log(found.values[one.name] / TRUTHS[law][one.name]) / found.deviation(k)) ** 2 / 40
    assert np.all(inside >= 34), inside
    assert not known or np.all((squares > 0.75**2) & (squares < 1.3**2)), squares


def test_start_of_the_law():
    """A -d0 of a run in other units shall be told, one like the approaches or fitted not."""
    measured = draw(np.random.default_rng(6), 0.01, TRUTHS["power"])
    fits = [identified("power", measured)]
    for start, told in ((-0.3, False), (-30.0, True)):
        lines = identify.report(fits, measured, springs(d0=start))
        assert told == any(
            line.startswith(f"warning: the law of RUN begins at d0 {start:g}, far beyond all approaches, at most 0.3:")
            for line in lines
        )
    fits[0].fit.values["d0"] = -30.0
    assert not any("begins at" in line for line in identify.report(fits, measured, springs(d0=-30.0)))


@pytest.mark.parametrize("law", TRUTHS)
def test_wrong_law_is_found_out(law):
    """With 1 % noise the other law shall be rejected by its sum of squares, and the true one preferred."""
    generator = np.random.default_rng(5)
    other = next(name for name in TRUTHS if name != law)
    for _ in range(5):
        measured = draw(generator, 0.01, TRUTHS[law])
        right, wrong = identified(law, measured), identified(other, measured)
        assert wrong.fit.misfit_probability() < identify.UNLIKELY < right.fit.misfit_probability()
        assert wrong.fit.criteria()[0] > right.fit.criteria()[0] + identify.DECISIVE
        assert [words for words in identify.warnings_of(wrong) if "does not fit" in words]
        assert identify.ranking([right, wrong])[-1].startswith(f"preferred: {law}, AICc lower by")


def test_criteria():
    """AICc and BIC of six values shall be those of the formulas; an unknown scatter is a parameter."""
    for known, terms in ((True, (8.0, 2 * math.log(6))), (False, (18.0, 3 * math.log(6)))):
        found = identified("power", draw(np.random.default_rng(7), 0.01, TRUTHS["power"], known=known)).fit
        misfit = found.sum_of_squares if known else 6 * math.log(found.sum_of_squares / 6)
        assert found.criteria() == pytest.approx((misfit + terms[0], misfit + terms[1]), rel=1e-12)


def test_exact_data():
    """Values without noise shall give the parameters to the accuracy of the model, from far away."""
    measured = draw(np.random.default_rng(1), 0.0, TRUTHS["power"], known=False)
    found = identified("power", measured).fit
    assert found.values == pytest.approx({"kappa": 800.0, "m": 2.2}, rel=1e-6)
    measured.deviations = [1e-3] * len(LOADS)
    parameters = [Parameter("kappa", 1e-3, 1e-9, 1e9), Parameter("m", 8.0, 1.1, 20)]
    model = law_fits.ContactModel(springs(), measured, {"law": "power"})
    far = fit(model.predict, parameters, np.array(measured.values), np.array(measured.deviations), True)
    assert far.converged and far.values == pytest.approx({"kappa": 800.0, "m": 2.2}, rel=1e-5)


def test_one_load_level():
    """Values at one load shall not determine two parameters: a warning names the combination."""
    generator = np.random.default_rng(2)
    for loads in ([0.2, 0.2, 0.2], [0.2, 0.2]):
        found = identified("power", draw(generator, 0.01, TRUTHS["power"], loads))
        words = [each for each in identify.warnings_of(found) if each.startswith("the data do not determine kappa^")]
        assert len(words) == 1
    found = identified("power", draw(generator, 0.01, TRUTHS["power"], [0.2]))
    assert found.fit.freedom == -1
    assert [w for w in identify.warnings_of(found) if w.startswith("1 values cannot determine 2 parameters")]
    assert not math.isfinite(found.fit.criteria()[0])


def test_bounds():
    """A bound below the truth shall hold the parameter, and be named."""
    measured = draw(np.random.default_rng(3), 0.01, TRUTHS["power"])
    sought = law_fits.read_parameters("kappa 1:500, m", springs())
    found = law_fits.fit_law("power", springs(), measured, sought, 1)
    assert found.fit.values["kappa"] == pytest.approx(500, rel=1e-12)
    assert found.fit.at_bound == ["kappa"]
    assert "kappa at a bound: widen it, or fit less" in identify.warnings_of(found)


def test_stiffness():
    """Measured stiffnesses shall identify the law by differences of derivatives."""
    problem = springs()
    exact = [row["sensitivities.force.u0"] for row in springs(**TRUTHS["power"]).solve([{"u0": u} for u in LOADS])]
    at = list(range(len(LOADS)))
    measured = Measurements("u0", LOADS, ["stiffness"] * len(at), at, exact, [0.01 * k for k in exact])
    found = law_fits.fit_law("power", problem, measured, law_fits.read_parameters("kappa, m", problem), 1).fit
    assert found.values == pytest.approx({"kappa": 800.0, "m": 2.2}, rel=1e-4)
    model = law_fits.ContactModel(problem, measured, {"law": "power"})
    _, jacobian = model.predict({"kappa": 800.0, "m": 2.2})
    ends = [model.predict({"kappa": 800.0 + side, "m": 2.2})[0] for side in (-1, 1)]
    assert jacobian[:, 0] == pytest.approx((ends[1] - ends[0]) / 2, rel=1e-5)


REFUSED = {
    "approach,force\n1,2\n2,x\n": "line 3, force: 'x' is not a number; allowed: a number, or an empty cell",
    "force,pressure\n1,2\n": "columns force,pressure: allowed: one load (approach, load or a flag as -drag)",
    "approach,colour\n1,2\n": "column colour: allowed: force approach stiffness",
    "approach,force,sd\n1,2,0\n": "line 2, force: standard deviation 0; allowed: above 0",
    "approach,force,sd\n1,2,1\n2,3,\n": "some values have a standard deviation, some none; allowed: all or none",
    "approach,force,pressure,sd\n1,2,3,4\n": "column sd: of which result? allowed: force_sd pressure_sd",
    "approach,force\n1,2,3\n": "line 2: 3 cells; allowed: 2, as in the first line",
    "approach,force\n1,\n": "has no measured values",
}


@pytest.mark.parametrize("text", REFUSED)
def test_refused_tables(text, tmp_path):
    """A wrong table shall be refused with its line."""
    path = tmp_path / "measured.csv"
    path.write_text(text)
    with pytest.raises(ResultsError) as refused:
        read_measurements(path)
    assert str(refused.value).startswith(f"{path}: {REFUSED[text]}")


@pytest.mark.parametrize("words", ["colour", "kappa 5:1", "kappa -1:1", "kappa low", "law"])
def test_refused_parameters(words):
    """Parameters that the run has not, and wrong bounds, shall be refused."""
    with pytest.raises(ResultsError, match="--fit"):
        law_fits.read_parameters(words, springs())


def test_identification_by_freefem(tmp_path, capsys):
    """A table made by other runs shall give its law; a prediction shall have the uncertainty of its covariance."""
    flags = ["-h", 2, "-order", 1, "-E", 1000, "-gap", 0, "-vtu", 0]
    table = tmp_path / "loads.csv"
    loads = [-0.1, 0.0, 0.1]
    table.write_text("u0\n" + "\n".join(map(str, loads)) + "\n")
    run_in(
        ROOT, "edp/main.edp", *flags, "-kappa", 500, "-m", 2.5, "-estimate", 0, "-rows", table, out=tmp_path / "rows"
    )
    with open(tmp_path / "rows/rows.csv", newline="") as f:
        forces = [float(row["force"]) for row in csv.DictReader(f)]
    lines = [f"{load},{force:.7g},{0.01 * force:.3g}" for load, force in zip(loads, forces, strict=True)]
    (tmp_path / "measured.csv").write_text("approach,force,sd\n" + "\n".join(lines) + "\n")
    run_in(ROOT, "edp/main.edp", *flags, "-u0", 0.1, "-estimate", 0, out=tmp_path / "run")
    assert main(["identify", str(tmp_path / "measured.csv"), str(tmp_path / "run")]) in (0, None)
    said = capsys.readouterr().out
    assert "law power" in said and "warning" not in said
    found = json.loads((tmp_path / "run/identify.json").read_text())["laws"][0]
    values = {name: one["value"] for name, one in found["parameters"].items()}
    assert values == pytest.approx({"kappa": 500, "m": 2.5}, rel=1e-4)
    known = [word for name, value in values.items() for word in (f"-{name}", repr(value))]
    run_in(ROOT, "edp/main.edp", *flags, *known, "-u0", 0.1, "-sensitivity", 1, out=tmp_path / "next")
    main(["uncertainty", str(tmp_path / "next"), "--identified", str(tmp_path / "run/identify.json")])
    line = next(text for text in capsys.readouterr().out.splitlines() if text.startswith("contact force"))
    force, reach = float(line.split()[2]), float(line.split()[4])
    slopes = json.loads((tmp_path / "next/summary.json").read_text())["sensitivities"]["force"]
    size = np.array([slopes[n] * values[n] * found["parameters"][n]["deviation"] for n in values])
    variance = size @ np.array(found["correlation"]) @ size
    assert reach == pytest.approx(uncertainty.NORMAL * math.sqrt(variance), rel=1e-2)
    assert reach < 2 * 0.01 * force  # the force at a load that was measured is known as well as its value


def test_friction(tmp_path, capsys):
    """Displacements under tangential forces shall give the coefficient of friction; -history 1 is refused."""
    flags = ["-h", 0.2, "-order", 1, "-vtu", 0, "-estimate", 0]
    lines = ["-shear,dragged.value,sd"]
    for load in (1.5, 2.2):
        done = run_in(ROOT, "edp/scenes/fretting.edp", *flags, "-friction", 0.35, "-shear", load, out=tmp_path / "out")
        moved = done.dragged["value"]
        lines.append(f"{load},{moved!r},{0.001 * moved!r}")
    (tmp_path / "measured.csv").write_text("\n".join(lines) + "\n")
    run_in(ROOT, "edp/scenes/fretting.edp", *flags, out=tmp_path / "run")
    main(["identify", str(tmp_path / "measured.csv"), str(tmp_path / "run"), "--fit", "friction"])
    assert "friction" in capsys.readouterr().out
    found = json.loads((tmp_path / "run/identify.json").read_text())["laws"][0]["parameters"]["friction"]
    assert found["value"] == pytest.approx(0.35, rel=1e-3)
    assert found["interval95"][1] - found["interval95"][0] < 0.02
    run_in(ROOT, "edp/scenes/fretting.edp", *flags, "-history", 1, "-steps", 2, out=tmp_path / "series")
    with pytest.raises(ResultsError, match="is a run with -history 1; allowed: more phases in -legs"):
        read_problem(tmp_path / "series")
