"""The pages as a site, `make site`: the same Markdown, laid out by Sphinx. Opens from a folder, asks no network.

Long pages are cut at their headings, a page a task; equations become MathML (postprocess/equations.py). Links lead to
the cut pages; one that no page and no file answers to ends the build, as any warning of Sphinx does.
"""

import argparse
import contextlib
import io
import re
import shutil
import sys
import tempfile
from pathlib import Path

from postprocess import equations

ROOT = Path(__file__).resolve().parent.parent
CUT = [f"edp/{name}.md" for name in "docs/WRITING docs/PAPER scenes/README".split()]
CUT += ["tests/RESULTS.md", "tests/COST.md"]
THEORY = (
    "discretisation nonmatching curved-surfaces condensation proximal-newton half-plane-model bending conditioning "
    "thresholds sequence-ends linear-model error-of-a-model friction wear adhesion lennard-jones-models heat "
    "plasticity mixed-elements exact-distance "
    "free-bodies rotations mesh-error geometry-error quantity-errors sensitivities friction-errors preload-errors"
).split()
# Chapters of the site by what a reader wants, and what stands in them: a page, or `PAGE#`, the sections of a long page.
CHAPTERS = {
    "Tutorials": [
        "edp/docs/tutorial/*.md",
        "edp/labs/README.md",
        "edp/labs/*/README.md",
        "edp/labs/0-algorithm/algorithm1.md",
        "edp/labs/0-algorithm/xnewton.md",
        "edp/labs/INSTRUCTOR.md",
        "edp/labs/CRIB.md",
    ],
    "How-to": [
        *(
            "edp/docs/howto/README.md",
            "edp/docs/howto/install.md",
            "edp/docs/howto/own-model.md",
            "edp/docs/CHOOSING.md",
            "edp/docs/howto/*.md",
        ),
        *("edp/docs/TROUBLESHOOTING.md", "template/README.md", "edp/docs/WRITING.md", "edp/docs/WRITING.md#"),
    ],
    "Reference": [
        *("edp/docs/reference/README.md", "edp/input/README.md", "edp/docs/reference/*.md", "edp/examples/README.md"),
        *("edp/examples/*/README.md", "edp/scenes/README.md", "edp/scenes/README.md#", "edp/docs/GLOSSARY.md"),
        "edp/docs/REFERENCES.md",
    ],
    "Explanation": [
        *("edp/docs/HOW-IT-WORKS.md", "edp/docs/LIMITS.md", "edp/docs/ERRORS.md", "edp/docs/theory/README.md"),
        *(f"edp/docs/theory/{name}.md" for name in THEORY),
        *("edp/docs/PAPER.md", "edp/docs/PAPER.md#"),
    ],
    "Results": ["tests/RESULTS.md", "tests/RESULTS.md#", "tests/VERIFICATION.md", "tests/COST.md", "tests/COST.md#"],
    "Code": [
        *("edp/README.md", "edp/docs/newton-step.md", "edp/docs/modules.md", "CONTRIBUTING.md"),
        *("tests/README.md", "tests/data/README.md", "CHANGELOG.md"),
    ],
}
ANSWERS = ["edp/labs/*/ANSWERS.md"]  # only with --answers, reached by links
SLANTED = re.compile(r"(`[^`]*`)|(?<![\w*])\*([^*\s][^*]*)\*(?!\w)")  # code, or slanted words
LINK = re.compile(r"(!?\[(?:[^\][]|`[^`]*`|!?\[[^\]]*\](?:\([^)]*\))?)*\])\(([^)\s]+)\)")
FENCE = re.compile(r"^```.*?^```$", re.M | re.S)
SETTINGS = {
    "project": "Stiff normal contact in FreeFEM",
    "extensions": "myst_parser",
    "html_theme": "furo",
    "html_title": "Stiff normal contact",
    "html_static_path": "_static",
    "html_css_files": "site.css",
    "html_copy_source": False,
    "html_show_sourcelink": False,
    "html_show_copyright": False,
    "html_show_search_summary": False,  # it would be fetched, which a browser refuses to a page of a folder
    "html_permalinks_icon": "#",
    "myst_heading_anchors": 6,
    "highlight_language": "text",
    "suppress_warnings": "misc.highlighting_failure,myst.header",
}


def slug(title):
    """A heading's name in links, as GitHub has it."""
    return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")


def outside_code(text, change):
    """The text with what stands outside of fenced code changed."""
    out, at = [], 0
    for fence in FENCE.finditer(text):
        out += [change(text[at : fence.start()]), fence[0]]
        at = fence.end()
    return "".join([*out, change(text[at:])])


def headings(text):
    return re.findall(r"^(#+) (.*)$", FENCE.sub("", text), re.M)


def cut(text):
    """(title, text) of a page's head and of each of its sections."""
    marked = outside_code(text, lambda part: re.sub(r"^## ", "\0", part, flags=re.M))
    head, *sections = marked.split("\0")
    return [("", head), *((section.partition("\n")[0], "# " + section) for section in sections)]


def typeset(text):
    """Indented blocks that are equations and slanted formulas, as MathML; numbers in tables that no line breaks."""

    def block(found):
        lines = [line[4:] for line in found[1].splitlines()]
        made = equations.display(lines)
        return f"\n\n{made}\n\n" if made else found[0]

    def change(part):
        part = re.sub(r"\n\n((?:    .+\n)+)(?=\n|\Z)", block, part)
        part = SLANTED.sub(lambda found: (found[2] and equations.inline(found[2])) or found[0], part)
        return re.sub(
            r"^\|.*$",
            lambda found: re.sub(r"(?<=[| ]\de-)(?=\d)|(?<=\.\de-)(?=\d)", "\u2060", found[0]),
            part,
            flags=re.M,
        )

    return outside_code(text, change)


def toctree(places, *options):
    """MyST's directive: links to pages, and their place in the site's contents."""
    lines = [*(f":{option}:" if ":" not in option else f":{option}" for option in options), ""]
    return "\n".join(["```{toctree}", *lines, *(f"/{place}" for place in places), "```", ""])


class Site:
    """The pages of the site: where each stands, and what each heading's place is."""

    def __init__(self, root, folder, chapters=CHAPTERS, answers=False, notebooks=()):
        """`notebooks`: the pages of executed notebooks, below the root; they are a chapter of their own."""
        own = {"Notebooks": [path.relative_to(root).as_posix() for path in notebooks]} if notebooks else {}
        self.root, self.folder, self.chapters = root, folder, chapters | own
        chapters = self.chapters
        self.below = {}  # {long page: the places of its sections}
        self.listed = {"index"}  # what the table of contents has so far
        self.pages = {}  # place in the site, without suffix: (page, text)
        self.places = {}  # (page, heading's name): place
        names = [
            "README.md",
            *(name for chapter in chapters.values() for name in chapter),
            *(ANSWERS if answers else []),
        ]
        self.left_out = set() if answers else {path for name in ANSWERS for path in root.glob(name)}
        files = [path for name in names for path in sorted(root.glob(name.partition("#")[0]))]
        for path in dict.fromkeys(files):
            self.add(path.relative_to(root).as_posix(), path.read_text())

    def add(self, page, text):
        place = "index" if page == "README.md" else page.removesuffix(".md")
        parts = cut(text) if page in CUT else [("", text)]
        for title, part in parts:
            own = f"{place}-{slug(title)}" if title else place
            self.pages[own] = page, part
            for level, heading in headings(part):
                # the page's first heading has no name of its own: the page is its place
                self.places[page, slug(heading)] = own if (level == "#") else f"{own}.md#{slug(heading)}"
            self.places.setdefault((page, ""), own)

    def target(self, page, to):
        """Where a link of a page leads in the site."""
        if re.match(r"[a-z]+:", to):
            return to
        name, _, heading = to.partition("#")
        path = (self.root / page).parent / name if name else self.root / page
        if path.is_dir():
            path = path / "README.md" if (path / "README.md").exists() else path
        if path.resolve() in self.left_out:
            return ""
        goal = path.resolve().relative_to(self.root).as_posix()
        if (goal, heading) in self.places:
            place = self.places[goal, heading]
            return f"/{place}" if "#" in place else f"/{place}.md"
        if heading or not path.exists():
            raise SystemExit(f"{page}: {to}: there is no such page, section or file")
        if path.is_dir():
            return ""
        copy = self.folder / goal
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, copy)
        return f"/{goal}"

    def linked(self, page, text):
        def link(found):
            words = found[1]
            if not words.startswith("!") and "](" in words:  # a picture that is a link
                words = LINK.sub(link, words[1:-1]).join("[]")
            to = self.target(page, found[2])
            return f"{words}({to})" if to else words[1:-1]

        return outside_code(text, lambda part: LINK.sub(link, re.sub(r"<!--.*?-->\n?", "\n", part, flags=re.S)))

    def chapter(self, names):
        """The places of a chapter's pages, in order, each once."""
        found = []
        for name in names:
            page, mark, heading = name.partition("#")
            if heading or not mark:
                pages = [path.relative_to(self.root).as_posix() for path in sorted(self.root.glob(page))]
                found += [self.places[one, heading] for one in pages]
            else:
                found += [place for place, (of, _) in self.pages.items() if of == page]
        return [place for place in dict.fromkeys(found) if not (place in self.listed or self.listed.add(place))]

    def contents(self):
        """The site's table of contents, for its first page; the other sections of a long page stand below that page."""
        chapters = {name: [one for one in names if not one.endswith("#")] for name, names in self.chapters.items()}
        trees = [toctree(self.chapter(names), "hidden", f"caption: {name}") for name, names in chapters.items()]
        for name in (name for names in self.chapters.values() for name in names if name.endswith("#")):
            self.below[name[:-1]] = self.chapter([name])
        return "\n".join(trees)

    def parts(self, page, place):
        """The sections of a page that was cut, also those that stand in another chapter."""
        own = [other for other, (of, _) in self.pages.items() if of == page and other != place]
        away = [f"- [{headings(self.pages[one][1])[0][1]}](/{one}.md)" for one in own if one not in self.below[page]]
        return "\n".join([toctree(self.below[page], "maxdepth: 1"), *away])

    def write(self):
        contents = self.contents()
        for place, (page, text) in self.pages.items():
            if page in CUT and self.places[page, ""] == place:
                # the page's own list of contents gives way to links to what are pages now
                text = re.sub(r"^\[[^]]+\]\(#(?:.|\n)*?\n\n", "\n", text, count=1, flags=re.M)
                body = f"{self.linked(page, text)}\n\n{self.parts(page, place)}\n"
            else:
                body = self.linked(page, text)
            if place == "index":
                body += "\n" + contents
            elif place not in self.listed:
                body = f"---\norphan: true\n---\n{body}"
            file = self.folder / f"{place}.md"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(typeset(body))
        static = self.folder / "_static"
        static.mkdir()
        shutil.copy(ROOT / "tests/data/site.css", static)


# What the theme leaves out: the levels of headings, names of regions, the keyboard for what scrolls
MENDED = {
    '<p class="caption" role="heading">': '<p class="caption" role="heading" aria-level="2">',
    '<aside class="sidebar-drawer">': '<aside class="sidebar-drawer" aria-label="All pages">',
    '<aside class="toc-drawer">': '<aside class="toc-drawer" aria-label="This page">',
    '<th class="head"><p></p></th>': "<td></td>",
    '<div class="highlight"><pre>': '<div class="highlight"><pre tabindex="0">',
}
TABLE = re.compile(r'<div class="table-wrapper[^"]*"(?=>)')


def mend(path):
    """A page of the site, made accessible."""
    text = path.read_text()
    for found, instead in MENDED.items():
        text = text.replace(found, instead)
    text = TABLE.sub(r'\g<0> role="region" aria-label="Table" tabindex="0"', text)
    if "<h1" not in text:
        text = re.sub(r"(<article[^>]*>)", r"\1<h1>Search</h1>", text, count=1)
    path.write_text(text)


def build(out, root=ROOT, chapters=CHAPTERS, answers=False, notebooks=()):
    """Builds the site into a folder; the exit code of Sphinx. `notebooks`: pages below the root."""
    from sphinx.cmd.build import main  # a development dependency: nothing else of the package wants it

    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, "source")
        source.mkdir()
        Site(root, source, chapters, answers, notebooks).write()
        told = {key: int(value) if isinstance(value, bool) else value for key, value in SETTINGS.items()}
        values = [word for key, value in told.items() for word in ("-D", f"{key}={value}")]
        words = [*"-q -W --keep-going -b html -C".split(), *values, "-d", f"{folder}/trees", str(source), str(out)]
        with contextlib.redirect_stderr(io.StringIO()) as said:
            code = main(words)
    print("".join(dict.fromkeys(said.getvalue().splitlines(keepends=True))), end="", file=sys.stderr)  # each once
    shutil.rmtree(Path(out, "_sources"), ignore_errors=True)
    for path in Path(out).rglob("*.html"):
        mend(path)
    return code


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", required=True, type=Path, help="the site's folder")
    parser.add_argument("--answers", action="store_true", help="with the answers to the labs")
    parser.add_argument("--notebooks", type=Path, help="the folder of the executed notebooks, if there is one")
    given = parser.parse_args()
    shutil.rmtree(given.out, ignore_errors=True)
    given.out.parent.mkdir(parents=True, exist_ok=True)
    books = (
        sorted(given.notebooks.resolve().glob("pages/*.md"), key=lambda path: int(path.name.split("-")[1]))
        if given.notebooks
        else ()
    )
    if code := build(given.out, answers=given.answers, notebooks=books):
        sys.exit(code)
    print(f"site: {given.out}/index.html")
