"""`make site`: the pages as a site that opens from a folder, with search, typeset equations and no broken link."""

import xml.etree.ElementTree as xml

import access
import documents
import pytest
from browser import CHROMIUM, Browser
from freefem import ROOT

from postprocess import equations

MATHML = "{http://www.w3.org/1998/Math/MathML}"
pytestmark = pytest.mark.filterwarnings("ignore:.*Check CHANGES for Sphinx")
needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here")
PAGES = {
    "README.md": "# Contact\n\n[law](edp/docs/PAPER.md#the-law), ![a picture](postprocess/a.png), "
    "[code](edp/main.edp)\n",
    "edp/docs/PAPER.md": "# Theory\n\n[The law](#the-law) · [Work](#work)\n\n## The law\n\nBelow the wall\n\n"
    "    p = κ s^m/2\n\n"
    "## Work\n\nas [above](#the-law), 1e-3:\n\n| a |\n|---|\n| 1e-3 |\n\n    leg 4\n",
}
CHAPTERS = {"Theory": ["edp/docs/PAPER.md", "edp/docs/PAPER.md#"]}


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


@pytest.mark.parametrize(
    "text, typeset", [("p = κ s^m", True), ("T", True), ("your", False), ("a law", False), ("1", False)]
)
def test_formulas_in_a_line(text, typeset):
    """Slanted formulas are typeset, slanted words stay."""
    assert (equations.inline(text) != "") == typeset
    assert ("<math" in documents.typeset(f"so *{text}*, but `a *T* b`\n")) == typeset
    assert "`a *T* b`" in documents.typeset("so `a *T* b`\n")


def test_answers_only_if_asked_for(tmp_path):
    """The answers are no pages of the site, and links to them are words; with --answers they are."""
    for answers in (False, True):
        site = documents.Site(ROOT, tmp_path, answers=answers)
        assert any("ANSWERS" in place for place in site.pages) == answers
        target = site.target("edp/labs/INSTRUCTOR.md", "0-algorithm/ANSWERS.md")
        assert target == ("/edp/labs/0-algorithm/ANSWERS.md" if answers else "")


def found(browser, folder, word):
    """The titles that the site's search finds."""
    page = browser.open(folder / "index.html", 1200, 800)
    page.evaluate(f"document.querySelector('input[name=q]').value = '{word}'; document.querySelector('form').submit()")
    page.wait("location.pathname.endsWith('search.html') && document.querySelectorAll('ul.search li a').length > 0")
    assert page.messages == [] and all(url.startswith("file:") for url in page.requests)
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
    assert "1e-\u20603" in (site / "edp/docs/PAPER-work.html").read_text()
    with Browser(tmp_path / "profile") as browser:
        assert found(browser, site, "wall") == ["The law"]


def test_a_link_that_leads_nowhere(tmp_path):
    """A link to no page, section or file shall end the build, naming the page and the link."""
    (tmp_path / "README.md").write_text("# Contact\n\n[law](edp/docs/PAPER.md#the-law)\n")
    with pytest.raises(
        SystemExit, match=r"README.md: edp/docs/PAPER.md#the-law: there is no such page, section or file"
    ):
        documents.Site(tmp_path, tmp_path / "out", {}).write()


SHOWN = [
    *"index search edp/labs/3-threshold/README edp/docs/howto/install edp/docs/theory/friction".split(),
    *"edp/docs/GLOSSARY tests/RESULTS".split(),
]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The whole site: Sphinx's warnings and dead links end it."""
    folder = tmp_path_factory.mktemp("site")
    assert documents.build(folder) == 0
    return folder


def test_site(site, tmp_path):
    """The whole site shall be built; some of its pages are for everyone."""
    if CHROMIUM is None:
        return
    pytest.importorskip("axe_core_python")
    with Browser(tmp_path) as browser:
        for name in SHOWN:
            assert access.wrong(browser, site / f"{name}.html") == [], name
        for name in ("index", "edp/docs/howto/install"):
            page = browser.open(site / f"{name}.html", 1200, 800)
            assert access.walked(page) == ([], []), name
            assert page.evaluate("controls.length") > 50


@needs_chromium
def test_every_page(site, tmp_path):
    """Every page of the site: no serious fault on a phone, a desk and a wide screen, light and dark."""
    pytest.importorskip("axe_core_python")
    windows = ((390, 800), (1280, 800), (1920, 1080))
    pages = sorted(site.rglob("*.html"))
    assert len(pages) > 150
    with Browser(tmp_path) as browser:
        found = {page.name: access.wrong(browser, page, "0", windows, ("light", "dark")) for page in pages}
    assert {name: faults for name, faults in found.items() if faults} == {}
