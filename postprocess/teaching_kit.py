"""The teaching kit: slides with notes, handouts without answers, tables of expected values, from the labs' own pages.

Sources: edp/labs/slides.md (slides between lines `***`, notes after `Notes:`), the labs' README.md and ANSWERS.md,
edp/labs/CRIB.md, lab 0's page with edp/labs/block.txt in place of gmsh's mesh, and a run of lab 3 for the film.
"""

import base64
import csv
import functools
import html
import io
import re
import textwrap
from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from postprocess import html_page, markdown, slide_figures, style
from postprocess.formatting import first_line
from postprocess.html_page import Markup, element, joined
from postprocess.results import ResultsError, Run, read_run

LABS = Path(__file__).resolve().parent.parent / "edp" / "labs"
PAGE = "0-algorithm/algorithm1.edp"
# Of lab 0's page: the parts that a slide shows, each by a text in its first line, and one in the line after its last
SLIDES_OF_CODE = {
    "newton_step": [("real[int] diagonal", "newton++")],
    "status_and_thresholds": [("real d = g[i]", "real law"), ("modelError = 0;", "// line 10")],
}


def folders() -> list[Path]:
    """The labs' folders, in their order."""
    found = [path.parent for path in LABS.glob("[0-9]*/README.md")]
    return sorted(found, key=lambda path: int(path.name.partition("-")[0]))


def title_of(lab: Path) -> str:
    """The title of a lab's page."""
    return read_page(lab / "README.md").partition("\n")[0].removeprefix("# ")


def read_page(path: Path) -> str:
    try:
        return re.sub("<!--= .*? -->", "", path.read_text(encoding="utf-8"))  # where a number is from
    except OSError:
        raise ResultsError(path, "is not there: the kit is made of a checkout's own pages") from None


# ---------------------------------------------------------------- pictures


HEAD = (
    '<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">'
    '<link rel="icon" href="data:,">'
)


def styled_page(title: str, css: str, body: str) -> bytes:
    """A page with a look of its own, of the folder templates."""
    style_sheet = f"<title>{html.escape(title)}</title><style>{template_file(css)}</style>"
    return f'<!DOCTYPE html>\n<html lang="en"><head>{HEAD}{style_sheet}</head>\n<body>{body}</body></html>\n'.encode()


def template_file(name: str) -> str:
    return read_page(html_page.TEMPLATES / name).strip()


def data_address(png: bytes) -> str:
    return "data:image/png;base64," + base64.b64encode(png).decode()


def embedded_figure(figure: Figure, alt: str) -> Markup:
    """A figure within a page."""
    written = io.BytesIO()
    figure.savefig(written, format="png", dpi=120, metadata={"Software": None})
    return Markup(f'<img src="{data_address(written.getvalue())}" alt="{html.escape(alt, quote=True)}">')


def orders() -> list[tuple[str, float, float]]:
    """(element, unknowns, error of the force) of the meshes without more flags, of the answers of lab 8."""
    ((_, rows), *_) = markdown.tables(read_page(LABS / "8-error/ANSWERS.md"))
    degree = {"-order 1 ": "P1", "-h": "P2", "-order 4 -grading 60 ": "P4"}
    found = [
        (degree[start[1]], float(unknowns), float(error))
        for flags, error, _, unknowns in rows
        if (start := re.fullmatch(r"`(-order 1 |-order 4 -grading 60 |-h(?= [\d.]+`))(?:-h )? ?[\d.]+`", flags))
    ]
    return sorted(found)


def film(run: Run) -> Markup:
    """A picture a model: overlap, threshold and pressure along x; buttons on a screen, all of them on paper."""
    models = run.adaptations
    reach = 1.25 * np.abs(run.contact["x"][run.contact["pressure"] > 0]).max()
    most = max(table["pressure"].max() for table in models)
    low = 1.3 * run.parameter("d0")
    high = 1.6 * max(table["overlap"].max() for table in models) - 0.1 * low
    frames = []
    for number, table in enumerate(models, 1):
        figure = Figure(figsize=slide_figures.SLIDE, layout="constrained")
        above, below = figure.subplots(2, 1, sharex=True)
        x, wall = table["x"], table["status"] == 2
        above.axhline(run.parameter("d0"), color=style.GREY, linewidth=0.6)
        above.plot(x, table["threshold"], color=style.BLUE, linestyle=(0, (4, 1.5)), label="threshold $T$")
        above.plot(x, table["overlap"], color=style.VERMILION, label="overlap $d$")
        above.plot(x[wall], table["overlap"][wall], "s", color=style.VERMILION, label="at the wall")
        above.set_ylim(low, high)
        above.set_ylabel("overlap")
        words = f"{wall.sum()} points at the wall" if wall.any() else "no wall acts: this is the law"
        above.set_title(f"model {number}: {words}", loc="left")
        below.plot(x, table["pressure"], color=style.BLACK)
        below.set_ylim(0, 1.1 * most)
        below.set_xlim(-reach, reach)
        below.set_ylabel("pressure")
        below.set_xlabel("$x$")
        style.legend_outside(figure, "right upper", *above.get_legend_handles_labels())
        frames.append(element("div", embedded_figure(figure, f"Model {number}: {words}"), class_="frame"))
    names = [("back", "◀ model before"), ("on", "next model ▶"), ("play", "play")]
    buttons = joined((element("button", words, type="button", data_do=name) for name, words in names), " ")
    return element("div", joined([*frames, element("p", buttons, class_="buttons")]), class_="film")


def program_lines(parts: list[tuple[str, str]]) -> Markup:
    """Parts of lab 0's page as they stand, without comments; an empty line between two parts."""
    lines = read_page(LABS / PAGE).splitlines()
    shown: list[str] = []
    for first, after in parts:
        begin = next(place for place, line in enumerate(lines) if first in line)
        end = next(place for place in range(begin, len(lines)) if after in lines[place])
        part = textwrap.dedent("\n".join(re.sub(r" *//.*", "", line) for line in lines[begin:end]))
        shown += [*([" "] if shown else []), *part.splitlines()]
    spans = "".join(f"<span>{html.escape(line)}</span>" for line in shown if line)
    return Markup(f'<pre class="algorithm" tabindex="0">{spans}</pre>')


# ---------------------------------------------------------------- pages


def program_without_gmsh() -> str:
    """Lab 0's page with buildmesh's mesh: one file that needs FreeFEM alone."""
    text, block = read_page(LABS / PAGE), read_page(LABS / "block.txt")
    begin, end = text.index("// the package's mesh of the block"), text.index("// eq. (2)")
    block = "\n".join(line for line in block.splitlines() if not line.startswith("//"))
    text = text[:begin] + "// the block; sides of 0.5 where the disc can touch\n" + block + "\n\n" + text[end:]
    for plugin in ("gmsh", "shell"):
        text = text.replace(f'load "{plugin}"\n', "")
    return text.replace("no module:", "no module, no gmsh:")


def without_answers(text: str) -> str:
    """A page without what leads to answers: a link's words stay."""
    return "\n".join(line for line in text.splitlines() if "ANSWERS" not in line and "INSTRUCTOR" not in line)


def picture_of(folder: Path) -> Callable[[str], str]:
    """From the name of a picture in a folder to its address that holds the picture itself."""

    def embed(source: str) -> str:
        path = folder / source
        if not path.is_file():
            raise ResultsError(path, "is not there")
        kind = "gif" if path.suffix == ".gif" else "png"
        return f"data:image/{kind};base64," + base64.b64encode(path.read_bytes()).decode()

    return embed


def unlinked(target: str) -> str:
    return target if target.startswith("http") else ""


def printed_page(title: str, text: str, folder: Path) -> bytes:
    """A page to print."""
    body = element("main", markdown.markup(text, unlinked, picture_of(folder)), id="main")
    return html_page.document(title, body).encode()


def slides(run: Run) -> list[tuple[str, Markup, Markup]]:
    """(title, content, notes) of each slide."""
    drawn: dict[str, Callable[[], Markup]] = {"film": lambda: film(run)}
    drawn |= {name: functools.partial(program_lines, parts) for name, parts in SLIDES_OF_CODE.items()}
    pictures = slide_figures.PICTURES | {"orders": functools.partial(slide_figures.orders, orders())}
    found = []
    with style.look(), mpl.rc_context(slide_figures.LARGE):
        for text in re.split(r"^\*\*\*$", read_page(LABS / "slides.md"), flags=re.M):
            shown, _, notes = text.partition("\nNotes: ")
            title = next(line.removeprefix("# ") for line in shown.splitlines() if line.startswith("# "))
            content = markdown.markup(shown, unlinked, picture_of(LABS))
            for name in re.findall(r"<p>\{\{(\w+)\}\}</p>", content):
                if name in drawn:
                    made = drawn[name]()
                else:
                    made = embedded_figure(
                        slide_figures.draw_picture(pictures[name]),
                        alternative_text(getattr(pictures[name], "func", pictures[name])),
                    )
                content = Markup(content.replace(f"<p>{{{{{name}}}}}</p>", made))
            found.append((title, content, markdown.markup(notes, unlinked)))
    return found


def alternative_text(picture: Callable) -> str:
    """What a picture shows, in words: the first line of its function's description."""
    return first_line(picture).rstrip(".")


def slide_page(found: list[tuple[str, Markup, Markup]]) -> bytes:
    """The slides: arrow keys on a screen, a page each on paper."""
    sections = "\n".join(
        f'<section data-number="{place}" aria-label="{html.escape(title, quote=True)}">{content}</section>'
        for place, (title, content, _) in enumerate(found, 1)
    )
    script = f"<script>{template_file('slides.js')}</script>"
    return styled_page(found[0][0], "slides.css", f"\n<main>\n{sections}\n</main>\n{script}\n")


def listing(text: str) -> bytes:
    """A program in two columns, lines numbered."""
    lines = "".join(
        f'<span data-n="{place}">{html.escape(line)}</span>' for place, line in enumerate(text.splitlines(), 1)
    )
    title = "algorithm1.edp: Algorithm 1 on one page of plain FreeFEM"
    return styled_page(title, "listing.css", f'<main class="two"><h1>{title}</h1><pre>{lines}</pre></main>')


def template(answers: str) -> str:
    """An answers.csv to fill in: the runs and quantities of a lab's tables, without the values."""
    lines = io.StringIO()
    to = csv.writer(lines, lineterminator="\n")
    to.writerow(["flags", "quantity", "value"])
    for head, rows in markdown.tables(answers):
        for flags, *values in rows:
            for name, value in zip(head[1:], values, strict=True):
                if value != "–":
                    to.writerow([flags.replace("`", ""), name.replace("`", ""), ""])
    return lines.getvalue()


def make_kit(folder: Path) -> dict[str, bytes]:
    """Every file of the kit by its name; `folder`: a run of lab 3."""
    found = slides(read_run(folder))
    files = {"slides.html": slide_page(found)}
    notes = [joined([element("h2", f"{place}. {title}"), words]) for place, (title, _, words) in enumerate(found, 1)]
    files["teacher/notes.html"] = html_page.document(
        "Speaker's notes", element("main", joined([element("h1", "Speaker's notes"), *notes]), id="main")
    ).encode()
    own = program_without_gmsh()
    files["algorithm1.edp"] = own.encode()
    files["algorithm1.html"] = listing(own)
    files["crib.html"] = printed_page("FreeFEM's idioms in lab 0", read_page(LABS / "CRIB.md"), LABS)
    docs = LABS.parent / "docs"
    files["glossary.html"] = printed_page("Glossary", read_page(docs / "GLOSSARY.md"), docs)
    expected = []
    for lab in folders():
        name = lab.name
        files[f"handout-{name}.html"] = printed_page(f"Lab {name}", without_answers(read_page(lab / "README.md")), lab)
        answers = read_page(lab / "ANSWERS.md")
        files[f"answers-{name}.csv"] = template(answers).encode()
        expected.append(answers)
    files["teacher/expected.html"] = printed_page(
        "Expected values", "# Only for the teacher\n\n" + "\n\n".join(expected), LABS
    )
    groups = {
        "The lecture": {"slides.html": "slides: arrow keys; printed, a page each; do not hand out"},
        "Lab 0 without an installation": {
            "algorithm1.edp": "the program, for FreeFEM alone, no gmsh",
            "algorithm1.html": "its listing, two columns",
            "crib.html": "FreeFEM's idioms in it",
        },
        "Handouts": {f"handout-{lab.name}.html": title_of(lab) for lab in folders()}
        | {"glossary.html": "the terms of slides and handouts"},
        "Answers to fill in": {
            f"answers-{lab.name}.csv": f"then make check-lab {lab.name.split('-')[0]} ANSWERS=file" for lab in folders()
        },
        "Only for the teacher": {
            "teacher/notes.html": "the speaker's notes",
            "teacher/expected.html": "answers and expected values; do not hand out teacher/, nor slides.html",
        },
    }
    parts = [element("h1", "Teaching kit")]
    for title, names in groups.items():
        items = (element("li", joined([element("a", name, href=name), ": ", text], "")) for name, text in names.items())
        parts += [element("h2", title), element("ul", joined(items))]
    body = element("main", joined(parts), id="main")
    files["index.html"] = html_page.document("Teaching kit", body).encode()
    return files
