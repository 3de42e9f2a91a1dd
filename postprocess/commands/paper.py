"""write the page on which the paper's claims stand beside what comes out

FOLDER holds the runs of `make paper`, one a folder: h-0.5, h-0.25-d0, newton, ...; FIGURES the paper's two figures with
their runs. Every number of the page is read from a run; the words about it are checked by it.
"""

import argparse
import re
from pathlib import Path

import numpy as np

from postprocess import html_page
from postprocess.formatting import command
from postprocess.html_page import Markup, element, joined, section, table
from postprocess.output import write_files
from postprocess.results import ResultsError, Run, read_run
from postprocess.results_folder import read_png

SIZES = ("1", "0.5", "0.25", "0.1")
TOLERANCES = ("1e-2", "1e-4", "1e-6", "1e-8", "1e-10", "1e-12")  # -tol; 1e-6 is the default
MODEL_ERRORS = ("1e-4", "1e-2", "1e-1")  # -eps; 1e-4 is the default
# Condition numbers of plain Newton's first tangent on this test (make conditioning; a test holds them): as it is, at
# kappa = 1e12, m = 3; scaled to a unit diagonal, for every kappa and m.
CONDITION, SCALED = "3e13", "3e3"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="FOLDER", type=Path, help="folder of the runs of make paper")
    parser.add_argument("--figures", required=True, metavar="FIGURES", type=Path, help="folder of figure1 and figure2")
    parser.add_argument("--out", required=True, metavar="FILE.html", type=Path, help="where to write")


def run(arguments: argparse.Namespace) -> None:
    """Writes the page and prints its path."""
    runs = {path.parent.name: read_run(path.parent) for path in sorted(arguments.folder.glob("*/summary.json"))}
    wanted = [*(f"h-{h}{start}" for h in SIZES for start in ("", "-d0")), "newton"]
    wanted += ["stiff", "stiff-d0", "stiff-newton"]
    wanted += [
        run_name(flag, value) for flag, values in (("tol", TOLERANCES), ("eps", MODEL_ERRORS)) for value in values
    ]
    missing = [name for name in wanted if name not in runs]
    if missing:
        raise ResultsError(arguments.folder, f"has no run {missing[0]}: make paper makes them")
    figures = {name: read_run(arguments.figures / name) for name in ("paper", "incremental")}
    pictures = {name: read_png(arguments.figures / f"{name}.png") for name in ("figure1", "figure2")}
    for path in write_files({arguments.out: build(runs, figures, pictures).encode()}):
        print(path)


def run_name(flag: str, value: str) -> str:
    """The name of the run with this value of -tol or -eps; the defaults are those of the run h-0.5."""
    return "h-0.5" if (flag, value) in (("tol", "1e-6"), ("eps", "1e-4")) else f"{flag}-{value}"


def counts_text(run: Run) -> str:
    """Adaptations / Newton steps."""
    return f"{run.summary['adaptations']} / {run.summary['newton']}"


def thresholds_never_decrease(run: Run) -> bool:
    """Proposition 4.1: no threshold of a model is below that of the model before, at any point."""
    tau = np.array([table["tau"] for table in run.adaptations])
    return bool(np.all(np.diff(tau, axis=0) >= 0))


def difference(one: Run, other: Run) -> float:
    """Of two runs' pressures on one mesh, the greatest difference over the greatest pressure."""
    a, b = one.contact["pressure"], other.contact["pressure"]
    return float(np.abs(a - b).max() / b.max())


def overshoot(run: Run) -> float:
    """ln(s0/s*)/ln(m/(m - 1)): the steps in which plain Newton comes from the free overlap to the solution's."""
    given = run.summary["parameters"]
    free = given["u0"] - given["gap"] - given["d0"]
    found = (run.summary["pressureMax"] / given["kappa"]) ** (1 / given["m"])
    return float(np.log(free / found) / np.log(given["m"] / (given["m"] - 1)))


def build(runs: dict[str, Run], figures: dict[str, Run], pictures: dict[str, bytes]) -> str:
    """The page."""
    parts = [
        element("h1", "The paper's claims, and what comes out"),
        element(
            "p", "H. Ben Dhia, S. Du. An eXtended-Newton scheme for the solution of stiff normal contact problems."
        ),
        section("claims", "Claims that these runs measure", claims_table(runs, figures)),
        section(
            "every",
            "Every claim",
            element("p", "Counts are for P1, h = 0.5 and the default tolerances."),
            every_claim(),
        ),
        section("meshes", "On other meshes", *by_mesh(runs)),
        section("tolerances", "With other tolerances", *by_tolerance(runs)),
        section("conditions", "Overshoot, not conditioning", element("p", conditioning_text(runs))),
        section("figures", "Figures", *captioned(pictures)),
    ]
    return html_page.document("The paper, reproduced", element("main", joined(parts), id="main"))


# (claim of the paper, run, what comes out, whether it agrees, why)
Claim = tuple[str, Run, str, bool, str]


def claims_table(runs: dict[str, Run], figures: dict[str, Run]) -> Markup:
    """A row a claim: the command that tests it, its result, and whether that agrees with the paper."""
    claims = [*claims_on_counts(runs, figures), *claims_on_other_schemes(runs, figures)]
    rows = [
        [claim, element("code", command(each)), out, verdict_mark(well), why] for claim, each, out, well, why in claims
    ]
    return table("Claims", ["the paper", "command", "comes out", "agrees", "why, or on what"], rows)


def claims_on_counts(runs: dict[str, Run], figures: dict[str, Run]) -> list[Claim]:
    """The paper's counts of models and steps, and its two figures."""
    base, meshed = runs["h-0.5"], figures["paper"]
    away = difference(meshed, figures["incremental"])
    return [
        (
            "§5: the full-compliant solution after 3 adaptations with 12 Newton steps in total",
            base,
            f"{counts_text(base)}; with both bodies meshed {counts_text(meshed)}",
            counts_text(base) == counts_text(meshed) == "3 / 12",
            "P1, h = 0.5, T⁰ = 0; the paper names neither mesh nor tolerance, and the count depends on both (below)",
        ),
        (
            "§5, Figure 1: one load step, though the bodies pass through each other when the motion is prescribed",
            meshed,
            f"converged in one step: {'yes' if meshed.summary['converged'] else 'no'}",
            bool(meshed.summary["converged"]),
            "the figure below",
        ),
        (
            "§5, Figure 2: the pressures are those of many small load steps on the full law",
            figures["incremental"],
            f"greatest difference {away:.1e} of the greatest pressure",
            away < 1e-4,
            "both solve one discrete problem; 20 load steps",
        ),
    ]


def claims_on_other_schemes(runs: dict[str, Run], figures: dict[str, Run]) -> list[Claim]:
    """Plain Newton and small load steps compared with the scheme, stiff laws, and the monotone thresholds."""
    base, meshed = runs["h-0.5"], figures["paper"]
    schemes = [each for name, each in runs.items() if "newton" not in name]
    falls = [each for each in [*schemes, meshed] if not thresholds_never_decrease(each)]
    small = figures["incremental"].summary["newton"]
    plain, stiff = runs["newton"].summary["newton"], runs["stiff-newton"].summary["newton"]
    return [
        (
            "§5: very efficient compared with a classical resolution with many small steps",
            figures["incremental"],
            f"20 load steps: {small} Newton steps",
            small > meshed.summary["newton"],
            "",
        ),
        (
            "§5: the classical model will probably fail in one step, its tangent being ill-conditioned",
            runs["newton"],
            f"plain Newton on the full law, one step: converged after {plain}",
            plain > base.summary["newton"],
            "it takes fewer steps than the scheme: the law of this test is soft, and models cost; the condition number "
            "is no obstacle (below)",
        ),
        (
            "§1: the scheme is for stiff laws, which classical schemes hardly solve",
            runs["stiff-d0"],
            f"κ = 1e12: plain Newton {stiff}; T⁰ = 0: {counts_text(runs['stiff'])}; "
            f"T⁰ = d0: {counts_text(runs['stiff-d0'])}",
            runs["stiff-d0"].summary["newton"] < stiff,
            "from T⁰ = d0; from T⁰ = 0 the wall is never met, and the scheme is plain Newton, which is slow, not lost",
        ),
        (
            "Proposition 4.1: thresholds never decrease",
            base,
            f"{len(schemes) + 1} runs, every point and model: {'none falls' if not falls else 'some fall'}",
            not falls,
            "of τ = T − d0, as the proposition has it",
        ),
    ]


def by_mesh(runs: dict[str, Run]) -> list[Markup]:
    """Models and steps on other meshes: a text and a table."""
    adaptations = [runs[f"h-{h}{start}"].summary["adaptations"] for h in SIZES for start in ("", "-d0")]
    fewest, most = min(adaptations), max(adaptations)
    meshes = table(
        "Adaptations / Newton steps by mesh",
        ["h, P1", "T⁰ = 0", "T⁰ = d0"],
        [[h, counts_text(runs[f"h-{h}"]), counts_text(runs[f"h-{h}-d0"])] for h in SIZES],
        [1, 2],
    )
    words = (
        f"The number of adaptations, {fewest} to {most} here, is not one of the scheme: a point that newly comes into "
        "contact still has its first threshold, and a finer mesh has more such points."
    )
    return [element("p", words), meshes]


def by_tolerance(runs: dict[str, Run]) -> list[Markup]:
    """Models and steps by the tolerances of the residual and of the model error: a text and two tables."""
    needed = [runs[run_name("tol", value)].summary["newton"] for value in TOLERANCES]
    tables = [
        table(
            f"Adaptations / Newton steps by {words}",
            [f"-{flag}", "h = 0.5, T⁰ = 0"],
            [[value, counts_text(runs[run_name(flag, value)])] for value in values],
            [1],
        )
        for flag, values, words in (
            ("tol", TOLERANCES, "tolerance of the residual"),
            ("eps", MODEL_ERRORS, "tolerance of the model error, eq. (7)"),
        )
    ]
    words = (
        f"The paper names no tolerance. The tolerance of the residual changes the Newton steps, {min(needed)} to "
        f"{max(needed)} here, and not the models. With a looser model error the loop may end a model earlier."
    )
    return [element("p", words), *tables]


def conditioning_text(runs: dict[str, Run]) -> str:
    """The condition of plain Newton's tangent, and the steps that follow from the overshoot."""
    stiff = runs["stiff-newton"].summary["newton"]
    return (
        "The paper calls the tangent of a stiff law ill-conditioned. At κ = 1e12 its condition number is "
        f"{CONDITION} at the first step. Scaled to a unit diagonal it is {SCALED} for every κ and m, that of the block "
        "alone (make conditioning). A direct solver has the accuracy of the scaled matrix. The steps of plain Newton "
        "follow the overshoot: each step takes back the share 1/m of an overlap that is far too large. With the "
        "greatest overlaps s₀ without contact and s* of the solution, x = ln(s₀/s*)/ln(m/(m − 1)) steps are needed, "
        "and about four "
        f"more. At κ = 1e12 x is {overshoot(runs['stiff-newton']):.1f}, and plain Newton takes {stiff} steps."
    )


def captioned(pictures: dict[str, bytes]) -> list[Markup]:
    """The paper's two figures, each with what it shows."""
    seen = {
        "figure1": "The paper's Figure 1: at rest, the motion prescribed, the first model solved, converged",
        "figure2": "The paper's Figure 2: pressure by the scheme on that of 20 load steps",
    }
    return [html_page.picture(pictures[name], text, Markup(text + ".")) for name, text in seen.items()]


def every_claim() -> Markup:
    """The table of edp/docs/PAPER.md with each sentence of the paper that claims, asks or proposes something."""
    text = (Path(__file__).parents[2] / "edp/docs/PAPER.md").read_text(encoding="utf-8")
    lines = re.findall(r"^\| .*\|$", text.partition("## Every claim")[2].partition("###")[0], re.M)
    words = [re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", line.replace("`", "")) for line in lines]
    head, *rows = [[cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in words]
    return table("Every claim of the paper", head, rows)


def verdict_mark(well: bool) -> Markup:
    return element("span", "yes" if well else "NO", class_="pass" if well else "fail")
