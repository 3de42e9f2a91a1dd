"""Is the tangent ill-conditioned, or is the overlap too large? `make conditioning`, results/conditioning/.

`conditioning.csv` has a row per stiffness kappa and exponent m of the law, on the paper's test (P1, h = 0.5): the
condition numbers of plain Newton's tangent K + B' diag(w p') B at the first step's overlap and at the solution, as it
is and scaled to a unit diagonal; those of the condensed C_AA + diag(a/w); the steps of plain Newton to a residual of
1e-6; and the prediction ln(s0/s*)/ln(m/(m - 1)), s0 and s* the greatest overlaps of the first step and of the solution.
"""

import argparse
import tempfile
from pathlib import Path

import campaign
import condensed
import numpy as np
from campaign import decade, markdown
from freefem import data, scene_text, snippet, told

FOLDER = campaign.RESULTS_FOLDER / "conditioning"
FLAGS = {"order": 1, "h": 0.5}
KAPPAS = tuple(10.0**power for power in range(0, 13, 2))
EXPONENTS = (1.5, 2.0, 3.0, 10.0, 20.0)
LINEAR = (1.0, 1.02)  # nearly linear laws, which part condition and overshoot; not in the fit
TOL = 1e-6
TANGENTS = [f"{kind}{where}" for where in ("First", "Solution") for kind in ("condition", "scaled")]
CONDENSED = ["condensedSolution", "condensedScaledSolution"]
COLUMNS = ["name", "script", "flags", "status", "kappa", "m", *FLAGS, "newton", "predicted", *TANGENTS, *CONDENSED]
COLUMNS += ["repeats", *campaign.MACHINE]
SHOWN = (LINEAR[1], 1.5, 3.0, 20.0)  # exponents of the table in tests/RESULTS.md


def cases(_root: Path = campaign.ROOT) -> list[campaign.Case]:
    """The problems, a row each; the condensed twin of the tests solves them, not FreeFEM."""
    pairs = [(kappa, m) for m in (*LINEAR, *EXPONENTS) for kappa in KAPPAS]
    return [campaign.case("linear" if m in LINEAR else "power", **FLAGS, kappa=kappa, m=m) for kappa, m in pairs]


def assembled(flags: dict) -> tuple[np.ndarray, np.ndarray, condensed.Problem]:
    """K (dofs, dofs), force/length; the contact points' unknowns in it (points,); the condensed problem."""
    words = [word for name, given in flags.items() for word in (f"-{name}", given)]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        values = told(snippet(folder, scene_text("disc-on-block") + data("theory/stiffness.edp"), *words))
        lines = (folder / "stiffness.txt").read_text().splitlines()
    cells = [line.split() for line in lines if not line.startswith("#")]
    triplets = np.array([row for row in cells[1:] if len(row) == 3], float)
    row, column, entry = triplets[:, 0].astype(int), triplets[:, 1].astype(int), triplets[:, 2]
    K = np.zeros((int(cells[0][0]),) * 2)
    K[row, column] = entry
    K = np.where(K == 0, K.T, K)  # only one half may be stored
    free = np.flatnonzero(np.diag(K) < 1e10 * np.median(np.diag(K)))  # the others are held by a penalty
    dof = np.searchsorted(free, values["unknown"].astype(int))
    K = K[np.ix_(free, free)]
    units = np.zeros((len(free), len(dof)))
    units[dof, np.arange(len(dof))] = 1
    C = np.linalg.solve(K, units)[dof]
    return K, dof, condensed.Problem((C + C.T) / 2, values["weight"], values["free"])


def conditions(H: np.ndarray) -> tuple[float, float]:
    """Condition number of a symmetric positive definite matrix, and of it scaled to a unit diagonal.

    The inverse is taken of the scaled matrix, so both are accurate even where the first is beyond 1e16.
    """
    d = 1 / np.sqrt(np.diag(H))
    scaled = d[:, None] * H * d
    inverse = np.linalg.inv(scaled)
    pairs = (H, d[:, None] * inverse * d), (scaled, inverse)
    return tuple(np.prod([np.linalg.eigvalsh((A + A.T) / 2)[-1] for A in pair]) for pair in pairs)


def tangent(K: np.ndarray, dof: np.ndarray, spring: np.ndarray) -> np.ndarray:
    H = K.copy()
    H[dof, dof] += spring
    return H


def row_of(K: np.ndarray, dof: np.ndarray, problem: condensed.Problem, kappa: float, m: float) -> dict:
    law = condensed.power(kappa, m)
    s, q = condensed.least(problem, law)
    plain = condensed.newton(problem, law, TOL)
    slope = law.slope(s)
    A = slope > 0
    M = problem.C[np.ix_(A, A)] + np.diag(1 / (problem.w * slope)[A])
    found = [conditions(tangent(K, dof, problem.w * law.slope(at))) for at in (problem.free, s)] + [conditions(M)]
    overshoot = np.log(problem.free.max() / law.inverse(q / problem.w).max())
    item = campaign.case("linear" if m in LINEAR else "power", **FLAGS, kappa=kappa, m=m)
    return {
        **dict(zip(("name", "script", "flags"), item.key, strict=True)),
        "repeats": 1,
        **campaign.machine(),
        "status": campaign.STATUS[0 if plain.ended else 20],
        "kappa": f"{kappa:g}",
        "m": f"{m:g}",
        **FLAGS,
        "newton": plain.steps if plain.ended else "",
        "predicted": f"{overshoot / np.log(m / (m - 1)):.4g}" if m > 1 else 0,
        **dict(zip([*TANGENTS, *CONDENSED], (f"{number:.4g}" for pair in found for number in pair), strict=True)),
    }


def fit(rows: list[dict], column: str, log: bool = False) -> tuple[float, float, float, float]:
    """Slope, offset, rms (steps) and correlation of plain Newton's steps over a column, laws that are no line."""
    rows = [row for row in rows if row["name"] == "power" and row["newton"] != ""]
    x, y = np.array([[float(row[column]), float(row["newton"])] for row in rows]).T
    x = np.log10(x) if log else x
    slope, offset = np.polyfit(x, y, 1)
    return slope, offset, np.sqrt(np.mean((slope * x + offset - y) ** 2)), np.corrcoef(x, y)[0, 1]


def table(rows: list[dict], exponents: tuple[float, ...] = (*LINEAR, *EXPONENTS)) -> str:
    heads = "m|κ|first tangent|scaled|at the solution|scaled|condensed, scaled|steps|x"
    lines = []
    for row in rows:
        if float(row["m"]) not in exponents:
            continue
        numbers = [f"{float(row[name]):.1e}".replace("e+0", "e").replace("e+", "e") for name in TANGENTS]
        steps = row["newton"] if row["newton"] not in ("", None) else "–"
        condensed = f"{float(row[CONDENSED[1]]):.2g}"
        lines.append(
            [row["m"], decade(float(row["kappa"])), *numbers, condensed, steps, f"{float(row['predicted']):.1f}"]
        )
    return markdown(heads.split("|"), lines)


def fits_table(rows: list[dict]) -> str:
    """The fits of plain Newton's steps: to the overshoot and to the logarithm of the first condition number."""
    lines = []
    for words, column, log in (("x, the overshoot", "predicted", False), ("log₁₀ of the condition", TANGENTS[0], True)):
        for least in (2.0, 1.5):
            chosen = [row for row in rows if float(row["m"]) >= least]
            slope, offset, rms, correlation = fit(chosen, column, log)
            line = f"{slope:.2f} × {offset:+.1f}".replace("+", "+ ").replace("-", "− ")
            lines.append([words, f"{least:g}", len(chosen), line, f"{rms:.2f}", f"{correlation:.3f}"])
    return markdown(["fitted to", "m ≥", "problems", "steps", "rms", "correlation"], lines)


def results_table(rows: list[dict]) -> str:
    """Both tables, of some exponents."""
    return f"{table(rows, SHOWN)}\n\n{fits_table(rows)}"


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of the CSV file")
    parser.add_argument("--quick", action="store_true", help="three stiffnesses, two exponents")
    arguments = parser.parse_args(argv)
    K, dof, problem = assembled(FLAGS)
    pairs = [(float(item.parameters["kappa"]), float(item.parameters["m"])) for item in cases()]
    if arguments.quick:
        pairs = [(kappa, m) for m in (1.02, 3.0) for kappa in (1.0, 1e6, 1e12)]
    rows = [row_of(K, dof, problem, kappa, m) for kappa, m in pairs]
    arguments.out.mkdir(parents=True, exist_ok=True)
    path = arguments.out / "conditioning.csv"
    path.unlink(missing_ok=True)
    campaign.add_rows(path, COLUMNS, rows)
    print(table(rows))
    bodies = conditions(K)
    print(f"\nthe bodies alone: condition {bodies[0]:.2e}, scaled {bodies[1]:.2e}")
    worst = max(float(row[name]) for row in rows for name in TANGENTS if name.startswith("scaled"))
    print(f"greatest scaled condition of a tangent: {worst:.4e}")
    if not arguments.quick:
        print(fits_table(rows))
    return 0 if worst <= bodies[1] * (1 + 1e-6) else 1


if __name__ == "__main__":
    raise SystemExit(main())
