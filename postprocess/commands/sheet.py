"""write the sheet of one case: the part, its loads, pictures, results with ±, warnings and versions, to print on A4

RUN is a result folder of a case (parts.edp or parts-3d.edp). The page is RUN/sheet.html, or what --out names; it needs
no network and no further files. The case file stands on it as it is now: if it has changed since the run, a warning
says so. A run with -vtu 0 has a sheet without the picture of its bodies.
"""

import argparse
import contextlib
import io
import math
from pathlib import Path

from matplotlib.figure import Figure

from postprocess import html_page, style
from postprocess.bodies import read_bodies, units_of
from postprocess.commands import curve, stress
from postprocess.formatting import NONE, Units, command, path_in_package, short_number, typeset_number, with_error
from postprocess.html_page import Markup, element, joined, section, table
from postprocess.output import register_files_of_run, write_files
from postprocess.results import ResultsError, Run, is_number, one_line, read_run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RUN", help="a case's result folder")
    parser.add_argument("--out", metavar="FILE.html", help="where to write (default: RUN/sheet.html)")
    parser.add_argument("--title", help="the heading (default: the name of the case file)")


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, writes the page and prints its path."""
    chosen = read_run(arguments.folder)
    out = Path(arguments.out) if arguments.out else chosen.path / "sheet.html"
    if out.suffix != ".html":
        raise ResultsError(out, "the name of a sheet ends in .html")
    if not isinstance(chosen.summary.get("bodies"), list):
        raise ResultsError(chosen.path, "is not a run of a case; allowed: results of parts.edp and parts-3d.edp")
    text = build(chosen, arguments.title).encode()
    if not arguments.out:
        register_files_of_run(chosen.path, [out.name])
    for path in write_files({out: text}):
        print(path)


def build(chosen: Run, title: str | None = None) -> str:
    """The whole page."""
    summary = chosen.summary
    case = Path(str(summary["parameters"].get("case", "")))
    units = Units(summary)
    near, more = pictures(chosen)
    parts = [
        section("part", "Part and loads", *case_file_section(chosen, case), near),
        section("results", "Results", *result_tables(summary, units), *more),
        section("accuracy", "Errors, run and versions", *accuracy_section(chosen)),
    ]
    title = title or case.stem or chosen.path.name
    body = joined([header(chosen, title, case, units), element("main", joined(parts), id="main")])
    return html_page.document(title, element("div", body, class_="sheet"))


def header(chosen: Run, title: str, case: Path, units: Units) -> Markup:
    """The name, the verdict in a sentence, and the warnings."""
    summary = chosen.summary
    warnings = [one_line(text, 500) for text in summary["warnings"]]
    if not summary["converged"]:
        warnings.insert(
            0, "The run has not converged. Its numbers are no results. " + one_line(summary["message"], 300)
        )
    warnings += changed_files(chosen, case)
    state = {"strain": "plane strain", "stress": "plane stress", "axisymmetric": "axisymmetric"}
    kind = state.get(summary.get("state", ""), "in space")
    lead = f"Contact analysis, {kind}, linear elasticity, {one_line(str(summary.get('date', '')))[:10]}."
    lead += " Forces are for a unit of thickness." if units.plane else ""
    if any(each.get("times", 1) != 1 for each in summary.get("prescribed") or []):
        lead += " All numbers are those of the part that is modelled, within its planes of symmetry."
    notice = element("p", element("span", "No warnings.", class_="pass"))
    if warnings:
        listed = joined(element("li", text) for text in warnings)
        notice = joined([element("p", element("span", "Warnings", class_="fail")), element("ul", listed)])
    return element("header", joined([element("h1", title), element("p", lead, class_="lead"), notice]))


def changed_files(chosen: Run, case: Path) -> list[str]:
    """Sentences on the files of the case that are no longer those of the run."""
    made = (chosen.path / "summary.json").stat().st_mtime
    files = [("case file", case), ("geometry", Path(str(chosen.summary["parameters"].get("mesh", ""))))]
    return [
        f"The {name} {path_in_package(path)} has changed since the run."
        if path.is_file()
        else f"The {name} {path_in_package(path)} is not there any more."
        for name, path in files
        if not path.is_file() or path.stat().st_mtime > made + 1
    ]


def case_file_section(chosen: Run, case: Path) -> list[Markup]:
    """The case file, or where it was."""
    files = element(
        "p", joined(["Geometry: ", element("code", path_in_package(chosen.summary["parameters"].get("mesh", "")))], "")
    )
    try:
        text = case.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return [files, element("p", f"The case file {path_in_package(case)} cannot be read here.")]
    return [
        files,
        element("p", joined(["Case file: ", element("code", path_in_package(case))], "")),
        element("pre", text.rstrip()),
    ]


# ---------------------------------------------------------------- numbers


def column_title(name: str, unit: str) -> str:
    """A column's name with its unit, if there is one."""
    return f"{name}, {unit}" if unit else name


def estimated(estimate: object, value: object) -> str:
    """A number of the summary and what its estimate says of it."""
    return with_error(value, estimate.get("error") if isinstance(estimate, dict) else None)


def vector(values: object, size: float = 0) -> str:
    """The components of a vector; those that are rounding beside the greatest, or beside this size, are 0."""
    if not isinstance(values, list) or not all(map(is_number, values)):
        return NONE
    most = max(map(abs, [*values, size]))
    return ", ".join(with_error(0.0 if abs(each) < 1e-6 * most else each) for each in values)


def length_of(values: object) -> float | None:
    """The length of a vector."""
    return math.hypot(*values) if isinstance(values, list) and all(map(is_number, values)) else None


def result_tables(summary: dict, units: Units) -> list[Markup]:
    """Tables of contacts, friction, loads, preloads, supports and bodies."""
    forces = (abs(each["normalForce"]) for each in summary.get("contacts") or [] if is_number(each.get("normalForce")))
    greatest = max(forces, default=0)
    small = [
        friction_table(summary, units),
        loads_table(summary, units),
        preloads_table(summary, units),
        supports_table(summary, units, greatest),
    ]
    columns = element("div", joined(each for each in small if each is not None), class_="columns")
    return [contacts_table(summary, units, greatest), columns, bodies_table(summary, units)]


def contacts_table(summary: dict, units: Units, greatest: float) -> Markup:
    """A row a contact: forces, greatest pressure, size, points; greatest: the largest normal force, for rounding."""
    estimates = summary.get("estimates") or {}
    contacts = summary.get("contacts") or []
    space = any("area" in each for each in contacts)
    length, area = ("area", f"{units.length}²" if units.length else "") if space else ("length", units.length)
    size = "area" if space else "contactLength"
    rows = [
        [
            f"{one_line(str(each['name']))}",
            estimated(known.get("normalForce"), each.get("normalForce")),
            vector(each.get("force"), greatest),
            estimated(known.get("pressureMax"), each.get("pressureMax"))
            + ("" if known.get("pressureMax") or not estimates else " (±: unknown)"),
            estimated(known.get("contactLength"), each.get(size)),
            f"{short_number(each.get('contactPoints'))} of {short_number(each.get('points'))}",
        ]
        for each, known in zip(contacts, estimates.get("contacts") or [{}] * len(contacts), strict=True)
    ]
    columns = ["contact", column_title("normal force", units.force), column_title("resultant", units.force)]
    columns += [column_title("greatest pressure", units.stress), column_title(length, area), "points in contact"]
    return table("Contacts", columns, rows, range(1, 6))


def friction_table(summary: dict, units: Units) -> Markup | None:
    """A row a contact with friction: shear force, share that sticks, dissipated energy; None without any."""
    rows = [
        [
            one_line(str(each["name"])),
            estimated((each.get("mesh") or {}).get("shearForce"), length_of(each["shearForce"])),
            f"{100 * each['stickShare']:.3g}" if is_number(each.get("stickShare")) else NONE,
            with_error(each.get("dissipated")),
        ]
        for each in summary.get("contacts") or []
        if "shearForce" in each
    ]
    columns = ["contact", column_title("shear force", units.force), "sticks on, %", "dissipated"]
    return table("Friction", columns, rows, range(1, 4)) if rows else None


def loads_table(summary: dict, units: Units) -> Markup | None:
    """A row a load: its force, and the displacement of its load point; None without any."""
    loads = (summary.get("estimates") or {}).get("loads") or []
    displacements = {each["name"]: each.get("way") for each in loads}
    rows = []
    for each in summary.get("prescribed") or []:
        displacement = displacements.get(each["name"])
        value = estimated(displacement, (displacement or {}).get("value"))
        rows.append([one_line(str(each["name"])), with_error(each.get("force")), value])
    columns = ["load", column_title("force", units.force), column_title("displacement along it", units.length)]
    return table("Loads", columns, rows, (1, 2)) if rows else None


def preloads_table(summary: dict, units: Units) -> Markup | None:
    """A row a preloaded cut: the force of tightening, and the force under the loads; None without any."""
    rows = [
        [one_line(str(each["name"])), with_error(each["preload"]), with_error(each["force"])]
        for each in summary.get("preloads") or []
    ]
    columns = ["cut", column_title("tightened to", units.force), column_title("carries", units.force)]
    return table("Preloads", columns, rows, (1, 2)) if rows else None


def supports_table(summary: dict, units: Units, greatest: float) -> Markup | None:
    """A row a support with its reaction; None without any."""
    rows = [
        [one_line(str(each["name"])), vector(each.get("force"), greatest)] for each in summary.get("supports") or []
    ]
    return table("Supports", ["support", column_title("carries", units.force)], rows, [1]) if rows else None


def bodies_table(summary: dict, units: Units) -> Markup:
    """A row a body: its mean displacement and, where the run has stresses, the greatest von Mises stress."""
    stresses = {each["body"]: each for each in summary.get("stresses") or []}
    rows = [
        [
            one_line(str(each["name"])),
            vector(each["motion"][: 3 if summary["scene"] == "parts-3d" else 2]),
            *stress_cells(stresses.get(each["name"])),
        ]
        for each in summary["bodies"]
    ]
    columns = ["body", column_title("mean displacement", units.length)]
    if stresses:
        columns += [column_title("greatest von Mises stress", units.stress), column_title("at", units.length)]
        columns += [column_title("yield stress", units.stress)]
    return table("Bodies", columns, rows, range(1, len(columns)))


def stress_cells(each: dict | None) -> list[str]:
    """The cells of a body's greatest stress; none without stresses in the run."""
    if each is None:
        return []
    where = vector(each.get("at")) + ("; no limit at a corner" if each.get("singular") else "")
    return [
        with_error(each.get("vonMises"), each.get("error")),
        where,
        with_error(each.get("yield")),
    ]


def accuracy_section(chosen: Run) -> list[Markup]:
    """The meaning of ±, the parts of the worst number's error, and the run."""
    summary = chosen.summary
    estimates = summary.get("estimates") or {}
    why = one_line(str(summary.get("notEstimated") or "estimates were left out"), 300)
    words = (
        "± is the estimated distance of a number from that of the same problem without a mesh, with exact distances. "
        "It holds for the model: materials, loads and supports are taken as exact. Numbers without ± have no estimate."
    )
    worst = one_line(str(estimates.get("worst") or ""))
    names = {"inside": "inside the bodies", "line": "on the contact line", "geometry": "shape", "algebra": "solver"}
    rows = [
        [names[key], typeset_number(short_number(value, 2))]
        for key, value in (estimates.get("parts") or {}).items()
        if key in names
    ]
    tables = [table("Run", ["", ""], versions(summary))]
    if worst and rows:
        tables.insert(0, table(f"Parts of the error: {worst}", ["part", "error"], rows, [1]))
    found = [element("p", words if estimates else f"Errors are not known: {why}.")]
    if estimates.get("refine"):
        found.append(element("p", f"To reduce the errors: {one_line(str(estimates['refine']), 200)}."))
    return [*found, element("div", joined(tables), class_="columns"), element("pre", command(chosen))]


# ---------------------------------------------------------------- pictures and versions


def pictures(chosen: Run) -> tuple[Markup, list[Markup]]:
    """The stresses and pressures, or the reason why they are not there; the curves of a series."""
    units = units_of(chosen, (style.Units.length, style.Units.stress))
    more = []
    with style.look():
        try:
            drawn = stress.draw(read_bodies(chosen, None), units, slide=True)
            near = picture(drawn, "Deformed bodies with the von Mises stress, and the contact pressure")
        except ResultsError as error:
            near = element("p", f"No picture: {one_line(str(error), 300)}.")
        with contextlib.suppress(ResultsError):
            words = "Loads over their displacements, contact forces, and energies"
            more.append(picture(curve.draw_curves(chosen, Units(chosen.summary)), words))
    return near, more


def picture(figure: Figure, words: str) -> Markup:
    file = io.BytesIO()
    figure.savefig(file, format="png", bbox_inches="tight", metadata={"Software": None})
    return html_page.picture(file.getvalue(), words, Markup(f"{words}."))


def versions(summary: dict) -> list[list[str]]:
    """The programs, the method, the size and the cost of the run."""
    seconds = summary["seconds"].get("total")
    rows = {
        "package": summary.get("package"),
        "FreeFEM": summary.get("freefem"),
        "gmsh": summary.get("gmsh"),
        "run at": summary.get("date"),
        "method, element": f"{summary['method']}, P{summary['order']}",
        "unknowns": summary["ndof"],
        "contact points": summary["points"],
        "linearisations": summary["newton"],
        "residual": short_number(summary.get("residual"), 2),
        "CPU seconds": f"{seconds:.2f}" if is_number(seconds) else None,
    }
    return [[name, NONE if value is None else one_line(str(value))] for name, value in rows.items()]
