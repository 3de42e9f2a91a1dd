"""`make site`: the pages as a site that opens from a folder, with search, typeset equations and no broken link."""

import re
import xml.etree.ElementTree as xml
from html.parser import HTMLParser
from urllib.parse import unquote

import documents
import pytest
from browser import CHROMIUM, Browser
from freefem import ROOT

from postprocess import equations

MATHML = "{http://www.w3.org/1998/Math/MathML}"
pytestmark = pytest.mark.filterwarnings("ignore:.*Check CHANGES for Sphinx")
needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here")
PAGES = {
    "README.md": "# Contact\n\n[law](edp/THEORY.md#the-law), ![a picture](postprocess/a.png), [code](edp/main.edp)\n",
    "edp/THEORY.md": "# Theory\n\n[The law](#the-law) · [Work](#work)\n\n## The law\n\nBelow the wall\n\n"
    "    p = κ s^m/2\n\n"
    "## Work\n\nas [above](#the-law), 1e-3:\n\n| a |\n|---|\n| 1e-3 |\n\n    leg 4\n",
}
CHAPTERS = {"Theory": ["edp/THEORY.md", "edp/THEORY.md#"]}


def written(*lines):
    """The MathML of an equation, one element for each of its pieces."""
    return [piece for each in xml.fromstring(f"<all>{equations.display(lines)}</all>") for piece in each]


def shape(element):
    """A short form: tags with their parts, texts as they are; rows of one part and brackets' groups fall away."""
    inner = [shape(part) for part in element]
    name = element.tag.removeprefix(MATHML)
    if name in ("mrow", "math"):
        return inner[0] if len(inner) == 1 else " ".join(inner)
    return f"{name}({', '.join(inner)})" if inner else (element.text or "")


@pytest.mark.parametrize(
    "text, expected",
    [
        ("κ (d − d0)^m = M (u0 − gap − d)/H", "κ msup(( d − msub(d, 0) ), m) = mfrac(M ( msub(u, 0) − gap − d ), H)"),
        ("a = √(4 F R/(π E*))", "a = msqrt(mfrac(4 F R, π msup(E, *)))"),
        ("‖q‖²_C ≤ s_freeᵀ q", "msubsup(‖ q ‖, C, 2) ≤ msubsup(s, free, T) q"),
        ("e = 0 elsewhere", "e = 0 \xa0elsewhere"),
        ("F̂ = Σ q̇ (s − s(p̂)):", "mover(F, ^) = Σ mover(q, ˙) ( s − s \u2061 ( mover(p, ^) ) ) :"),
        ("n = ln(m/(m − 1)) − 13/4 ψ_j", "n = ln \u2061 ( mfrac(m, m − 1) ) − mfrac(13, 4) msub(ψ, j)"),
        ("C = B K⁻¹ Bᵀ", "C = B msup(K, − 1) msup(B, T)"),
    ],
)
def test_equations(text, expected):
    """An equation shall mean in MathML what it means as it is written: quotients, roots, indices, words."""
    (piece,) = written(text)
    assert shape(piece) == expected


def test_what_is_no_equation():
    """Commands, statements and messages shall stay code; pieces between wide gaps shall be apart."""
    for text in ("FreeFem++ edp/parts.edp -mesh FILE", "move top 0 -0.1", "-case pin.case, line 6: bor: no curve"):
        assert equations.display([text]) == ""
    assert len(written("σ = 0   where free", "u = 0")) == 3


def test_every_page_has_its_place(tmp_path):
    """Every page of the package shall stand in the site's contents once, and the theory's equations be typeset."""
    site = documents.Site(ROOT, tmp_path)
    site.write()  # ends the test where a link leads nowhere
    trees = [
        tree for path in tmp_path.rglob("*.md") for tree in re.findall(r"```{toctree}.*?```", path.read_text(), re.S)
    ]
    contents = re.findall(r"^/(.*)$", "\n".join(trees), re.M)
    assert len(contents) == len(set(contents)) > 90
    assert all(re.search(r"^# ", path.read_text(), re.M) for path in tmp_path.rglob("*.md"))
    answers = {place for place in site.pages if place.endswith("ANSWERS")}
    assert {"index", *contents, *answers} == site.pages.keys()
    pages = [path.relative_to(ROOT) for path in ROOT.rglob("*.md") if not {".venv", "results"} & {*path.parts}]
    left_out = {page.as_posix() for page in pages if not page.parts[0].startswith(".")} - {
        of for of, _ in site.pages.values()
    }
    assert left_out == {"edp/labs/slides.md"}
    for name in ("edp/THEORY*", "edp/scenes/README*", "edp/labs/*/README*"):
        for path in tmp_path.glob(f"{name}.md"):
            left = re.findall(r"\n\n((?:    .+\n)+)(?=\n|\Z)", documents.FENCE.sub("", path.read_text()))
            assert not [block for block in left if not block.strip().startswith("[")], path


class Links(HTMLParser):
    """What a page links to and what it names."""

    def __init__(self, text):
        super().__init__()
        self.to, self.names = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.names.add(found.get("id"))
        self.to += [found[name] for name in ("href", "src") if found.get(name)]


def broken(folder):
    """Links of a site that lead nowhere, and what it would load from elsewhere."""
    pages = {path.resolve(): Links(path.read_text()) for path in folder.rglob("*.html")}
    wrong = []
    for path, links in pages.items():
        for to in links.to:
            name, _, heading = unquote(re.sub(r"\?[^#]*", "", to)).partition("#")
            goal = (path.parent / name).resolve() if name else path
            if re.match(r"(https?|mailto|data):", to):
                continue
            if not goal.exists() or (heading and goal in pages and heading not in pages[goal].names):
                wrong.append(f"{path.relative_to(folder)}: {to}")
        text = path.read_text()
        wrong += re.findall(r'<(?:script|link|img)[^>]*(?:src|href)="https?:[^"]*"', text)
    return wrong


def looked_at(browser, folder, place, width):
    """A page of a site in a browser; it shall complain about nothing and ask nobody."""
    page = browser.open(folder / place, width, 800)
    assert page.messages == []
    assert all(url.startswith("file:") for url in page.requests)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    return page


def found(browser, folder, word):
    """The titles that the site's search finds."""
    page = looked_at(browser, folder, "index.html", 1200)
    page.evaluate(f"document.querySelector('input[name=q]').value = '{word}'; document.querySelector('form').submit()")
    page.wait("location.pathname.endsWith('search.html') && document.querySelectorAll('ul.search li a').length > 0")
    assert page.messages == []
    return page.evaluate("[...document.querySelectorAll('ul.search li a')].map(link => link.textContent)")


@needs_chromium
def test_small_site(tmp_path):
    """Two pages, one of them cut in three: links, a picture, an equation that is drawn, search from a folder."""
    for name, text in PAGES.items():
        path = tmp_path / "root" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    for name in ("postprocess/a.png", "edp/main.edp"):
        path = tmp_path / "root" / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes((ROOT / "edp/labs/1-law/figure.png").read_bytes() if name.endswith("png") else b"// code\n")
    site = tmp_path / "site"
    assert documents.build(site, tmp_path / "root", CHAPTERS) == 0
    assert broken(site) == []
    assert "1e-\u20603" in (site / "edp/THEORY-work.html").read_text()
    with Browser(tmp_path / "profile") as browser:
        page = looked_at(browser, site, "edp/THEORY-the-law.html", 390)
        height = "document.querySelector('mfrac').getBoundingClientRect().height"
        assert page.evaluate(height) > page.evaluate(
            "document.querySelector('mfrac mn').getBoundingClientRect().height"
        )
        assert found(browser, site, "wall") == ["The law"]


def test_a_link_that_leads_nowhere(tmp_path):
    """A link to no page, section or file shall end the build, naming the page and the link."""
    (tmp_path / "README.md").write_text("# Contact\n\n[law](edp/THEORY.md#the-law)\n")
    with pytest.raises(SystemExit, match=r"README.md: edp/THEORY.md#the-law: there is no such page, section or file"):
        documents.Site(tmp_path, tmp_path / "out", {}).write()


@pytest.mark.long
@needs_chromium
def test_site(tmp_path):
    """The whole site: no link that leads nowhere, nothing from the network, pages that fit a phone, search."""
    assert documents.build(tmp_path / "site") == 0
    assert broken(tmp_path / "site") == []
    with Browser(tmp_path / "profile") as browser:
        for width in (390, 1280):
            for place in ("index", "edp/MANUAL-flags", "edp/THEORY-the-proximal-step", "edp/labs/3-threshold/README"):
                page = looked_at(browser, tmp_path / "site", f"{place}.html", width)
                assert page.evaluate("[...document.images].every(image => image.complete && image.naturalWidth > 0)")
        assert "Lab 3: the threshold loop by hand" in found(browser, tmp_path / "site", "threshold")
