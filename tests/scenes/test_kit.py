"""The teaching kit: slides, handouts, lab 0 without gmsh, and what make check-lab says of answers and laws."""

import csv
import re

import access
import pytest
from browser import CHROMIUM, Browser
from docs.test_readme import fences
from freefem import FREEFEM, ROOT, cases_of, execute, run_in
from page_numbers import printed

from postprocess import markdown, slide_figures
from postprocess.command_line import main
from postprocess.commands import check_lab
from scenes.test_labs import BARE, LABS, answers

CHECK = "check_lab"


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The kit's folder."""
    folder = tmp_path_factory.mktemp("kit")
    page = ROOT / "edp/labs/3-threshold/threshold.edp"
    film = run_in(ROOT, page, "-h", 0.5, "-vtu", 0, "-estimate", 0, out=folder / "film").folder
    assert main(["kit", str(film), "--out", str(folder / "kit")]) == 0
    return folder / "kit"


def test_handouts(made):
    """A handout a lab, with its pictures, without answers or a link but to what is on the net."""
    assert {path.stem for path in made.glob("handout-*.html")} == {f"handout-{lab}" for lab in LABS}
    for path in made.glob("handout-*.html"):
        text = path.read_text()
        assert "data:image/png" in text and "ANSWERS" not in text
        assert all(target.startswith(("http", "#", "data:")) for target in re.findall(r'href="([^"]*)"', text))


def test_the_page_without_gmsh(made, tmp_path):
    """Lab 0 in one file shall run anywhere, and have the paper's count; its force that of a like mesh."""
    assert "gmsh" not in re.sub(r"//.*", "", (made / "algorithm1.edp").read_text())
    code, stdout = execute([*FREEFEM, made / "algorithm1.edp"], tmp_path, BARE)
    assert code == 0, stdout
    assert (printed(stdout, "adaptations"), printed(stdout, "Newton steps")) == (3, 12)
    assert printed(stdout, "force") == pytest.approx(152.09, rel=0.01)


def test_slides(made):
    """A lecture: about thirty slides, each picture with words for who cannot see it, formulas typeset, links away."""
    text = (made / "slides.html").read_text()
    slides = re.findall("<section .*?</section>", text, re.S)
    assert 25 <= len(slides) <= 35 and sum("<img" in slide for slide in slides) > 20
    assert "{{" not in text and "Notes:" not in text and 'alt=""' not in text
    assert "<math" in text and not re.search(r"<em>[^<]*[=κ][^<]*</em>", text)


@pytest.mark.parametrize("name", cases_of(["cut", "four_five"], slide_figures.PICTURES))
def test_sketches(name, tmp_path):
    """Each picture of the lecture is drawn without a run, in both sizes."""
    assert main(["sketch", name, "--out", str(tmp_path / "page.pdf")]) == 0
    assert main(["sketch", name, "--slide", "--out", str(tmp_path / "slide.pdf")]) == 0
    assert {path.name for path in tmp_path.iterdir()} == {
        f"{n}.{kind}" for n in ("page", "slide") for kind in ("pdf", "png")
    }


@pytest.mark.skipif(not CHROMIUM, reason="needs Chromium")
def test_slides_on_a_screen(made, tmp_path):
    """Each slide fits the screen of a projector."""
    with Browser(tmp_path) as browser:
        page = browser.open(made / "slides.html", 1280, 720)
        sizes = page.evaluate("[...document.querySelectorAll('section')].map(s => s.scrollHeight)")
        assert max(sizes) <= 720 and page.messages == []


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here")
def test_for_everyone(made, tmp_path):
    """Slides and sheets: no serious fault on a desk and on a phone, no control that Tab does not come to or show."""
    pytest.importorskip("axe_core_python")
    with Browser(tmp_path) as browser:
        for name in (
            "slides",
            "index",
            "teacher/notes",
            "handout-0-algorithm",
            "handout-3-threshold",
            "crib",
            "glossary",
            "algorithm1",
        ):
            assert access.wrong(browser, made / f"{name}.html") == [], name
        for name, least in (("slides", 4), ("index", 20)):
            page = browser.open(made / f"{name}.html", 1280, 720)
            assert access.walked(page) == ([], []), name
            assert page.evaluate("controls.length") >= least
        # arrows turn the slides, but scroll what is wider than a phone
        page = browser.open(made / "slides.html", 390, 800)
        page.evaluate("Object.assign(document.querySelector('pre').style, {whiteSpace: 'pre', overflowX: 'auto'})")
        page.evaluate("{ const code = document.querySelector('pre'); code.tabIndex = 0; code.focus(); }")
        before = page.evaluate("scrollY")
        for kind in ("rawKeyDown", "keyUp"):
            page.call(
                "Input.dispatchKeyEvent", type=kind, key="ArrowRight", code="ArrowRight", windowsVirtualKeyCode=39
            )
        assert page.evaluate("scrollY") == before
        page.evaluate("document.activeElement.blur()")
        for kind in ("rawKeyDown", "keyUp"):
            page.call(
                "Input.dispatchKeyEvent", type=kind, key="ArrowRight", code="ArrowRight", windowsVirtualKeyCode=39
            )
        page.wait(f"scrollY != {before}")


# ---------------------------------------------------------------- answers


def filled(lab, folder, change=lambda value: value):
    """A lab's answers.csv with the page's own values."""
    lines = [["flags", "quantity", "value"]]
    for head, rows in markdown.tables(answers(lab)):
        for flags, *cells in rows:
            lines += [[flags, name, change(c)] for name, c in zip(head[1:], cells, strict=True) if c != "–"]
    path = folder / "answers.csv"
    with path.open("w") as file:
        csv.writer(file).writerows(lines)
    return path


@pytest.mark.parametrize("lab", cases_of([LABS[2], LABS[5]], LABS))
def test_answers(lab, made, tmp_path, capsys):
    """The page's own values shall be well, all; those 2 % off, but zeros, none; the template asks for the same."""
    assert main([CHECK, lab.partition("-")[0], str(filled(lab, tmp_path))]) == 0
    said = capsys.readouterr().out
    assert "OFF" not in said
    asked = (made / f"answers-{lab}.csv").read_text().splitlines()[1:]
    assert len(asked) == len(said.splitlines()) - 1 and all(line.endswith(",") for line in asked)
    path = filled(lab, tmp_path, lambda cell: 1.02 * kit_number(cell))
    with pytest.raises(SystemExit) as ended:
        main([CHECK, lab.partition("-")[0], str(path)])
    assert ended.value.code == 1 and capsys.readouterr().out.count("OFF") > 0.6 * len(asked)


def kit_number(cell):
    return float(cell.replace("−", "-"))


@pytest.mark.parametrize("text, why", [("a,b\n1,2\n", "first line"), ("flags,quantity,value\n-m 2,x,\n", "no value")])
def test_answers_refused(text, why, tmp_path, capsys):
    """What is no answers.csv shall be refused in one line."""
    (tmp_path / "a.csv").write_text(text)
    assert main([CHECK, "2", str(tmp_path / "a.csv")]) == 2
    assert why in capsys.readouterr().err
    assert main([CHECK, "99", str(tmp_path / "a.csv")]) == 2
    assert "allowed: 0 1 2" in capsys.readouterr().err


def test_answers_of_a_spreadsheet(tmp_path, capsys):
    """Semicolons, commas in numbers, another case of the head, rows cut short: as spreadsheets write them."""
    rows = ["Flags; Quantity ;Value", "-m 2;first ratio;0,49997", "-m 2;Newton steps;18,0", "-m 3;Newton steps", ""]
    (tmp_path / "a.csv").write_bytes("\r\n".join(rows).encode("utf-8-sig"))
    assert main([CHECK, "2", str(tmp_path / "a.csv")]) == 0
    assert capsys.readouterr().out.endswith("2 of 2 within tolerance\n")


def test_a_law_without_end(tmp_path, capsys, monkeypatch):
    """A law that loops for ever shall be stopped and said, no process be left."""
    monkeypatch.setattr(check_lab, "SECONDS", 1)
    law = (ROOT / "edp/labs/4-own-law/mylaw.idp").read_text()
    (tmp_path / "mine.idp").write_text(law + "\nint endless = 0;\nwhile (endless >= 0) endless = 1;\n")
    with pytest.raises(SystemExit):
        main([CHECK, "4", str(tmp_path / "mine.idp")])
    assert "does not end: stopped after 1 seconds" in capsys.readouterr().out


def test_a_law(tmp_path, capsys):
    """The answers' law shall be well; with a slope twice too steep that check alone is off."""
    (law,) = fences(answers("4-own-law"), "freefem")
    path = tmp_path / "mine.idp"
    path.write_text(law)
    assert main([CHECK, "4", str(path)]) == 0
    path.write_text(law.replace("? soft : stiff)", "? 2 * soft : 2 * stiff)"))
    capsys.readouterr()
    with pytest.raises(SystemExit):
        main([CHECK, "4", str(path)])
    (off,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("OFF")]
    assert "slope" in off
