"""The report: one page of everything that has been run, from a tree of results."""

import datetime
import io
import platform
from dataclasses import replace
from pathlib import Path

import matplotlib
import numpy as np

from postprocess import doctor, figures, html_page, movie_player, style
from postprocess.campaign import CONVERGED, Campaign, Row, is_converged, number
from postprocess.figures import cost
from postprocess.formatting import (
    HISTORY_COLUMNS,
    command,
    figure_captions,
    first_line,
    history_rows,
    path_in_package,
    run_caption,
    short_number,
)
from postprocess.html_page import Markup, element, folded, joined, section, table
from postprocess.reference_values import PAPER, Check, checks, paper_test
from postprocess.results import ResultsError, Run, is_number, one_line
from postprocess.results_folder import ResultsFolder, read_bytes, read_png

NAMED = 6  # failures that the page's first lines name
HEAVY = 10**7  # bytes of a movie's page above which it is linked to, not shown

CAMPAIGNS = {
    "bench": ("Work and precision", "make bench", ("work_precision", "meshes", "growth", "ingredients")),
    "stability": ("Stability", "make stability", ("stability", "quick")),
}


def build(tree: ResultsFolder) -> str:
    """The whole page."""
    verdicts = [(run, checks(run)) for run in tree.runs]
    pictures = {path: read_png(path) for path in tree.figures}
    movies = {path: read_movie(path) for path in tree.movies}
    campaigns = [campaign(tree, name, pictures) for name in CAMPAIGNS]
    if not (tree.runs or pictures or movies or any(campaigns)):
        raise ResultsError(
            tree.path, "holds no run and no figure; make run, make figures, make bench or make stability"
        )
    order = list(figure_captions())
    own = [path for path in pictures if path.parent.name == "figures"]
    own.sort(key=lambda path: order.index(path.stem) if path.stem in order else len(order))
    parts = [
        section("accuracy", "Error against run time", *accuracy(tree)) if tree.runs else "",
        section("figures", "Figures", *(figure(path, pictures[path]) for path in own)) if own else "",
        section("movies", "Movies", *(movie(tree, path, part) for path, part in movies.items())) if movies else "",
        section("references", "Results against references", *references(tree, verdicts)) if tree.runs else "",
        section("runs", "Runs", *scenes(tree)) if tree.runs else "",
        *campaigns,
        section("machine", "Machine and versions", machine()),
    ]
    body = joined([header(tree, verdicts, parts), element("main", joined(filter(None, parts)), id="main")])
    return html_page.document("Stiff normal contact: report", body)


def header(tree: ResultsFolder, verdicts: list[tuple[Run, list[Check]]], parts: list) -> Markup:
    """What the page holds, in a few lines, and links to its parts."""
    converged = sum(run.summary["converged"] for run in tree.runs)
    found = [check for _, several in verdicts for check in several]
    sentences = [f"{converged} of {len(tree.runs)} runs converged."] if tree.runs else []
    if found:
        sentences.append(f"{sum(check.passed for check in found)} of {len(found)} comparisons with a reference pass.")
    failed = [
        f"{tree.name(run.path)} ({each.name} {each.difference:+.1%})"
        for run, several in verdicts
        for each in several
        if not each.passed
    ]
    failed += [f"{tree.name(run.path)} (not converged)" for run in tree.runs if not run.summary["converged"]]
    if failed:
        more = f" and {len(failed) - NAMED} more" if len(failed) > NAMED else ""
        sentences.append(f"Failed: {', '.join(failed[:NAMED])}{more}.")
    newest = max((run.path / "summary.json").stat().st_mtime for run in tree.runs) if tree.runs else None
    if newest is not None:
        when = datetime.datetime.fromtimestamp(newest, datetime.UTC)
        sentences.append(f"Newest run: {when:%Y-%m-%d %H:%M} UTC.")
    names = {"accuracy": "Error against run time", "figures": "Figures", "movies": "Movies", "references": "References"}
    names |= {"runs": "Runs"}
    names |= {name: title for name, (title, _, _) in CAMPAIGNS.items()} | {"machine": "Machine and versions"}
    there = [name for name in names if any(f'<section id="{name}"' in part for part in parts)]
    links = joined(element("li", element("a", names[name], href=f"#{name}")) for name in there)
    return element(
        "header",
        joined(
            [
                element("h1", "Stiff normal contact: report"),
                element("p", " ".join(sentences), class_="lead"),
                element(
                    "p",
                    joined(
                        [
                            "Made from ",
                            element("code", path_in_package(tree.path)),
                            " by ",
                            element("code", "make report"),
                            ".",
                        ],
                        "",
                    ),
                ),
                element("nav", element("ul", links), aria_label="Parts of this page"),
            ]
        ),
    )


def with_error(summary: dict, name: str) -> str:
    """A number of a run, and what the run says of its error."""
    error = ((summary.get("estimates") or {}).get(name) or {}).get("error")
    return short_number(summary[name]) + (f" ± {error:.1g}" if error else "")


def scenes(tree: ResultsFolder) -> list[Markup]:
    """The runs scene by scene, folded: a table, then each run."""
    groups: dict[str, list[tuple[int, Run]]] = {}
    for index, run in enumerate(tree.runs, 1):
        groups.setdefault(run.summary["scene"], []).append((index, run))
    found = []
    for scene, runs in sorted(groups.items()):
        missed = sum(not run.summary["converged"] for _, run in runs)
        words = f"{scene}: {style.count(len(runs), 'run')}" + (f", {missed} not converged" if missed else "")
        found.append(folded(words, joined([overview(tree, scene, runs), *(details(tree, run, k) for k, run in runs)])))
    return found


def overview(tree: ResultsFolder, scene: str, runs: list[tuple[int, Run]]) -> Markup:
    """A row per run of a scene."""
    columns = (
        "run,converged,warnings,force,greatest pressure,half-width,method,element,h,dofs,adaptations,Newton steps,"
        "factorisations,back-substitutions,CPU s"
    ).split(",")
    rows = []
    for index, run in runs:
        summary = run.summary
        seconds = summary["seconds"].get("total")
        rows.append(
            [
                element("a", tree.name(run.path), href=f"#run-{index}"),
                verdict(summary["converged"], "yes", "NO"),
                verdict(not summary["warnings"], "0", str(len(summary["warnings"]))),
                *(with_error(summary, name) for name in "force pressureMax halfWidth".split()),
                *(summary["method"], f"P{summary['order']}", short_number(summary["h"]), summary["ndof"]),
                *(summary[name] for name in "adaptations newton factorisations backsolves".split()),
                f"{seconds:.2f}" if is_number(seconds) else "–",
            ]
        )
    return table(f"Runs of {scene}", columns, rows, [2, 3, 4, 5, *range(8, 15)])


def references(tree: ResultsFolder, verdicts: list[tuple[Run, list[Check]]]) -> list[Markup]:
    """A row per comparison, and what is compared with what."""
    rows = [
        [
            element("a", tree.name(run.path), href=f"#run-{index}"),
            verdict(check.passed, "pass", "FAIL"),
            f"P{run.summary['order']}, h\u00a0=\u00a0{short_number(run.summary['h'])}",
            check.name,
            check.source,
            f"{check.value:.8g}",
            f"{check.reference:.8g}",
            f"{check.difference:+.1e}",
            f"{check.allowed:.1e}",
        ]
        for index, (run, several) in enumerate(verdicts, 1)
        for check in several
    ]
    words = element(
        "p",
        "The paper's test (κ = 1000 with m = 3 or m = 10, everything else at its default) is compared with an "
        "independent computation: NGSolve, P4 elements, h = 0.0125. Allowed, relative: force and pressure 0.1 h√h "
        "for P1 and 0.0025 h for P2, half-width 0.05 h, and ten times the run's tolerance. The confined block "
        "has an exact state. Hard contact under a force is compared with closed forms on a half-space: Hertz's line "
        "and circle, the flat punch's pressure in the middle, Westergaard's wave at its crests; allowed is 0.4 h/a for "
        "P1 and 0.1 h/a for P2, a the half-width, radius or wavelength, and what a body of finite size is off. "
        "Runs with other parameters have no reference and are not in the table.",
    )
    if not rows:
        return [words, element("p", "No run so far is one of these.")]
    columns = "run,verdict,mesh,value,reference,found,expected,difference,allowed".split(",")
    return [words, table("Comparisons", columns, rows, [5, 6, 7, 8])]


def accuracy(tree: ResultsFolder) -> list[Markup]:
    """The paper's test: the force's error over run times, a curve a method and order; a row a run."""
    found = []
    for run in tree.runs:
        given, force = run.summary["parameters"], paper_test(run).get("force")
        usual = run.summary["scene"] == "disc-on-block" and (given.get("tol"), given.get("eps")) == (1e-6, 1e-4)
        if force == PAPER[1e3, 3.0]["force"] and usual and run.summary["converged"]:
            found.append(replace(run, summary={**run.summary, "parameters": {**given, "reference": force}}))
    words = element(
        "p",
        "For an error of 1e-4 take the default method with P2, for 1e-6 with P4. "
        "The paper's test at the default tolerances. The error is that of the contact force against an independent "
        "computation, the reference of the table above. CPU seconds are from assembly to displacement: no start, mesh, "
        "error estimate or file. The seconds waited are a clock's, from the start of FreeFEM to the results, the mesh "
        "included if it was made then; they depend on what else the machine did.",
    )
    if len(found) < 2:
        return [words, element("p", joined(["No two runs so far are of this test: ", element("code", "make report")]))]
    with style.look():
        drawn, file = cost.draw(found, style.Units()), io.BytesIO()
        drawn.savefig(file, format="png", metadata={"Software": None})
    rows = [
        [
            tree.name(run.path),
            *(run.summary["method"], f"P{run.summary['order']}", short_number(run.summary["h"]), run.summary["ndof"]),
            f"{cost.force_error(run):.1e}",
            f"{cost.seconds(run):.3f}",
            *(short_number(run.summary["seconds"].get(name), 3) for name in ("total", "waited")),
        ]
        for run in found
    ]
    columns = "run,method,element,h,unknowns,error of the force,CPU s of the solution,CPU s in all,s waited".split(",")
    seen = "Error of the contact force over CPU seconds and over the seconds waited"
    picture = html_page.picture(file.getvalue(), seen, Markup(f"{seen}, a curve a method and element."))
    return [words, picture, folded(style.count(len(rows), "run"), table("Runs", columns, rows, range(3, 9)))]


def verdict(passed: bool, good_word: str, bad_word: str) -> Markup:
    return element("span", good_word if passed else bad_word, class_="pass" if passed else "fail")


def figure(path: Path, data: bytes) -> Markup:
    """A picture, what is seen in it, and the command that makes it."""
    name = path.stem
    module = figures.modules().get(name)
    title = f"{first_line(module)}." if module else f"Picture {name}."
    seen = figure_captions().get(name, title[0].upper() + title[1:])
    made = CAMPAIGNS[path.parent.name][1] if path.parent.name in CAMPAIGNS else f"make results/figures/{name}.pdf"
    return html_page.picture(data, seen, joined([element("strong", name), ": ", seen, " ", element("code", made)], ""))


def read_movie(path: Path) -> str | None:
    """The player in a movie's page; None when it is too heavy to be shown here."""
    data = read_bytes(path)
    try:
        part = movie_player.extract(data.decode("utf-8"))
    except UnicodeDecodeError:
        part = None
    if part is None:
        raise ResultsError(path, "is not a movie's page, or is truncated; make it again")
    return part if len(data) <= HEAVY else None


def movie(tree: ResultsFolder, path: Path, part: str | None) -> Markup:
    """A movie with its player, or a link to it."""
    name = tree.name(path.parent)
    runs = {run.path: run for run in tree.runs}
    run = runs.get(path.parent)
    heading = element("h3", run_caption(run) if run else name)
    folder = path_in_package(path.parent)
    made = f"python -m postprocess movie --out {folder} {folder if run else 'RUN'}"
    shown = (
        Markup(part)
        if part is not None
        else element("p", element("a", "The movie's own page", href=path.resolve().as_uri()))
    )
    return joined([heading, element("pre", made), shown])


def campaign(tree: ResultsFolder, name: str, pictures: dict) -> Markup | str:
    """The figures of a campaign and its tables in brief; nothing when it has not been run."""
    title, made, tables = CAMPAIGNS[name]
    folder = tree.path / name
    own = {path: data for path, data in pictures.items() if path.parent == folder}
    there = [each for each in tables if (folder / f"{each}.csv").exists()]
    checked = folder / "checks.csv"
    if not own and not there and not checked.exists():
        return ""
    parts = [element("p", joined(["Made by ", element("code", made), "."], ""))]
    parts += [figure(path, data) for path, data in own.items()]
    for each in there:
        parts += campaign_table(Campaign(folder), each)
    if checked.exists():
        parts += [campaign_checks(Campaign(folder))]
    return section(name, title, *parts)


def campaign_table(found: Campaign, name: str) -> list[Markup]:
    """A table's runs counted method by method; those that failed, one by one."""
    rows = found.rows(name, "script flags status method newton backsolves")
    groups: dict[str, list[Row]] = {}
    for row in rows:
        start = f", T⁰ = {row['T0']}" if row["method"] == "paper" and row.get("T0") else ""
        groups.setdefault(row["method"] + start, []).append(row)
    lines = []
    for method, group in groups.items():
        fine = [row for row in group if is_converged(row)]
        lines.append(
            [
                method,
                len(group),
                verdict(len(fine) == len(group), "0", str(len(group) - len(fine))),
                *(extent(fine, column) for column in ("newton", "backsolves")),
                *(middle(fine, column) for column in ("cpu", "costRatio")),
                *(extent(fine, column) for column in ("forceError",) if column in rows[0]),
            ]
        )
    columns = "method,runs,failed,linearisations,back-substitutions,median CPU s,median cost ratio".split(",")
    columns += ["force error"] if "forceError" in rows[0] else []
    title = name.replace("_", " ")
    parts = [table(f"{title}: {len(rows)} runs", columns, lines, range(1, len(columns)))]
    where = sorted(
        {f"{row['machine']}, {row['cores']} cores, FreeFEM {row['freefem']}" for row in rows if "machine" in row}
    )
    if where:
        parts.append(element("p", "Run on: " + "; ".join(where), class_="soft"))
    failed = [row for row in rows if row["status"] != CONVERGED]
    if failed:
        shown = [[f"{row['script']} {row['flags']}", row["status"]] for row in failed[:200]]
        more = f", the first {len(shown)}" if len(shown) < len(failed) else ""
        parts.append(
            folded(f"{title}: {len(failed)} runs that failed{more}", table("Failed runs", ["command", "status"], shown))
        )
    return parts


def campaign_checks(found: Campaign) -> Markup:
    """Comparisons of runs with what does not rest on the code, kind by kind."""
    rows = found.rows("checks", "check passed error")
    lines = []
    for kind in dict.fromkeys(row["check"] for row in rows):
        group = [row for row in rows if row["check"] == kind]
        bad = sum(row["passed"] != "True" for row in group)
        lines.append([kind, len(group), verdict(bad == 0, "0", str(bad)), extent(group, "error")])
    return table("Checks of the runs", ["check", "comparisons", "not passed", "error"], lines, [1, 2, 3])


def extent(rows: list[Row], column: str) -> str:
    """Least and greatest of a column."""
    values = np.array([number(row, column) for row in rows if column in row])
    values = values[np.isfinite(values)]
    if len(values) == 0:
        return "–"
    low, high = short_number(float(values.min()), 2), short_number(float(values.max()), 2)
    if (values == values.round()).all() and values.max() < 1e9:
        low, high = str(int(values.min())), str(int(values.max()))
    return low if low == high else f"{low} to {high}"


def middle(rows: list[Row], column: str) -> str:
    values = np.array([number(row, column) for row in rows if column in row])
    values = values[np.isfinite(values)]
    return short_number(float(np.median(values)), 3) if len(values) else "–"


def details(tree: ResultsFolder, run: Run, index: int) -> Markup:
    """One run: how to make it again, what it was given, what it gave, step by step."""
    summary = run.summary
    results = {**{name: value for name, value in summary.items() if not isinstance(value, dict | list)}}
    results["newtonPerAdaptation"] = " ".join(map(str, summary["newtonPerAdaptation"]))
    seconds = [[f"seconds {name}", cell(value)] for name, value in summary["seconds"].items()]
    given = [[name, cell(value)] for name, value in summary["parameters"].items() if name != "out"]
    gave = [[name, cell(value)] for name, value in results.items() if name not in ("scene", "method", "message")]
    tables = [
        table("Results", ["name", "value"], gave + seconds, [1]),
        table("Parameters", ["flag", "value"], [[f"-{name}", value] for name, value in given], [1]),
    ]
    steps = table("Newton steps", HISTORY_COLUMNS, history_rows(run), range(len(HISTORY_COLUMNS)))
    count = len(run.history["newton"])
    parts = [
        element("h3", f"{tree.name(run.path)}: {run_caption(run)}", id=f"run-{index}"),
        element("pre", command(run)),
    ]
    if not summary["converged"]:
        parts.append(element("p", f"Not converged. {summary['message']}", class_="fail"))
    parts += [element("p", f"Warning: {text}", class_="fail") for text in summary["warnings"]]
    parts += [picture_of_run(run, name) for name in ("state", "stress") if (run.path / f"{name}.png").exists()]
    parts.append(folded(style.count(count, "Newton step"), steps))
    parts.append(folded("Results and parameters", element("div", joined(tables), class_="columns")))
    return element("article", joined(parts), aria_labelledby=f"run-{index}")


def picture_of_run(run: Run, name: str) -> Markup:
    """A run's own picture, where it has been drawn."""
    what = {
        "state": "the deformed bodies and the pressure along the contact",
        "stress": "the bodies by von Mises' stress",
    }
    seen = f"{run_caption(run)}: {what[name]}"
    made = element("code", f".venv/bin/python -m postprocess {name} {path_in_package(run.path)}")
    return html_page.picture(
        read_png(run.path / f"{name}.png"), seen, joined([f"{what[name].capitalize()}. ", made], "")
    )


def cell(value: object) -> str:
    return one_line(short_number(value, 8), 200)


def machine() -> Markup:
    """Where and with what the page was made."""
    versions = doctor.versions()
    rows = [
        ["machine", f"{doctor.processor()}, {doctor.cores()} cores, {platform.machine()}"],
        ["system", doctor.system_name()],
        *([name, version] for name, version in versions.items()),
        ["Python", platform.python_version()],
        ["numpy", np.__version__],
        ["matplotlib", matplotlib.__version__],
    ]
    return joined(
        [
            element("p", "The machine on which this page was made; the campaigns above name their own."),
            table("Machine and versions", ["what", "which"], rows),
        ]
    )
