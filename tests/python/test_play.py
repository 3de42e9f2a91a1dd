"""The page that needs nothing installed: its numbers are the package's, it is quick, works by keys and on a phone."""

import json

import access
import pytest
from browser import CHROMIUM, Browser
from freefem import cases_of, run

from postprocess.command_line import main

pytestmark = pytest.mark.skipif(not CHROMIUM, reason="needs Chromium")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The page's file."""
    path = tmp_path_factory.mktemp("play") / "page.html"
    assert main(["play", "--out", str(path)]) == 0
    return path


@pytest.fixture(scope="module")
def page(made, tmp_path_factory):
    """The page in a window of a desk."""
    with Browser(tmp_path_factory.mktemp("profile")) as browser:
        yield browser.open(made, 1280, 900)


BLOCK = [("newton", 1e9, 3), ("newton", 1e9, 8), ("paper", 1e9, 3)]


def solved(page, problem, method, kappa, m, threshold, tol):
    """{models, newton, force, converged} of the page's own solver."""
    settings = json.dumps({"kappa": kappa, "m": m, "T0": threshold, "tol": tol})
    found = "(({models, newton, force, converged}) => ({models, newton, force, converged}))"
    return page.evaluate(f"{found}(solve(problemOf('{problem}', DATA), {settings}, '{method}'))")


DISC = [
    ("disc41", "paper", 1e3, 3, 0),
    ("disc41", "paper", 1e3, 3, -0.25),
    ("disc41", "newton", 1e3, 3, 0),
    ("disc41", "paper", 1e12, 3, -0.25),
    ("disc41", "newton", 1e12, 3, 0),
    ("disc81", "paper", 1e3, 3, 0),
    ("disc81", "paper", 1e9, 3, -0.25),
]


@pytest.mark.parametrize("problem, method, kappa, m, threshold", cases_of(DISC[3:4], DISC))
def test_disc(problem, method, kappa, m, threshold, page):
    """The paper's test: models, steps and force shall be the package's."""
    h = 0.5 if problem == "disc41" else 0.25
    start = ["-T0", "d0" if threshold < 0 else threshold] if method == "paper" else []
    flags = ["-method", method, "-order", 1, "-h", h, "-kappa", kappa, "-m", m]
    theirs = run("disc-on-block", *flags, *start)
    ours = solved(page, problem, method, kappa, m, threshold, 1e-6)
    assert (ours["models"], ours["newton"]) == (theirs.adaptations, theirs.newton)
    assert ours["converged"] and ours["force"] == pytest.approx(theirs.force, rel=1e-8)


def test_proximal(page):
    """Proximal Newton shall come to the package's force, from no pressure in as many steps."""
    flags = ["-start", "none", "-order", 1, "-h", 0.5, "-forcing", 1e-6, "-tol", 1e-10]
    for kappa in (1e3, 1e12):
        theirs, ours = (
            run("disc-on-block", *flags, "-kappa", kappa),
            solved(page, "disc41", "proximal", kappa, 3, 0, 1e-10),
        )
        assert ours["force"] == pytest.approx(theirs.force, rel=1e-9)
        assert abs(ours["newton"] - theirs.newton) <= 1


@pytest.mark.parametrize("method, kappa, m", cases_of(BLOCK[:1], BLOCK))
def test_block(method, kappa, m, page):
    """The confined block: steps and pressure shall be the package's."""
    start = ["-T0", "d0"] if method == "paper" else []
    flags = ["-method", method, *start, "-kappa", kappa, "-m", m, "-h", 10, "-tol", 1e-12]
    theirs = run("confined-block", *flags)
    ours = solved(page, "block", method, kappa, m, -0.25, 1e-12)
    assert ours["newton"] == theirs.newton
    assert 20 * ours["force"] == pytest.approx(theirs.force, rel=1e-9)


def test_keys_and_steps(made, tmp_path):
    """Steps go forward and back by keys and buttons, and the pictures follow; tasks tell well from not."""
    with Browser(tmp_path) as browser:
        page = browser.open(made, 1280, 900)
        before = page.evaluate("$('newtonLaw').innerHTML")
        page.evaluate("$('step').focus()")
        for kind in ("keyDown", "keyUp"):
            page.call(
                "Input.dispatchKeyEvent", type=kind, key="ArrowRight", code="ArrowRight", windowsVirtualKeyCode=39
            )
        page.wait("step == 1")
        assert page.evaluate("$('newtonLaw').innerHTML") != before
        page.evaluate("$('last').click()")
        assert page.evaluate("step") == 12 and "3 models, 12 steps" in page.evaluate("$('paperEnd').textContent")
        page.evaluate("$('back').click()")
        assert page.evaluate("step") == 11
        set_to = "for (const [k, v] of Object.entries({})) {{ $(k).value = v; }} change(); $('{}Check').click()"
        for name, wrong, right in (
            ("factor", {"factor": 0.66}, {"factor": 0.75}),
            ("gain", {"kappa": 12, "T0": -0.24}, {"kappa": 12, "T0": -0.25}),
            ("one", {"kappa": 3, "T0": 0}, {"kappa": 3, "T0": 0.05}),
        ):
            for values, expected in ((wrong, "fail"), (right, "pass")):
                page.evaluate(set_to.format(json.dumps(values), name))
                assert page.evaluate(f"$('{name}Told').className") == expected, name


STATE = "#problem=disc81&kappa=9&m=2.5&T0=-0.25&tol=-8&step=4"


def test_address(page):
    """The address shall carry sliders and step: it sets the page, follows it, and leaves out what is no value."""
    page.evaluate(f"location.hash = '{STATE}'")
    page.wait("step == 4")
    seen = "[problem.n, settings.kappa, settings.m, settings.T0, settings.tol]"
    assert page.evaluate(seen) == pytest.approx([81, 1e9, 2.5, -0.25, 1e-8])
    assert page.evaluate("$('kappaHere').value") == "9" and page.evaluate("$('link').hash") == STATE
    page.evaluate("$('mHere').value = 4; $('mHere').dispatchEvent(new Event('input'))")
    assert page.evaluate("settings.m") == 4 and "&m=4&" in page.evaluate("location.hash")
    page.evaluate("location.hash = '#problem=none&kappa=a&m=3&step=900'")
    page.wait("settings.m == 3")
    assert page.evaluate("[problem.n, settings.kappa]") == pytest.approx([81, 1e9])
    assert page.evaluate("step == +$('step').max && location.hash.endsWith(`step=${step}`)")
    page.evaluate("location.hash = '#main'")
    assert page.evaluate("settings.m") == 3
    assert page.messages == []


def test_predict_then_look(page):
    """A result shall be shown after a prediction only, be that of the solver, and lead the sliders to its states."""
    names = page.evaluate("[...document.querySelectorAll('form.predict')].map(form => form.dataset.question)")
    assert names == page.evaluate("Object.keys(QUESTIONS)") and len(names) == 4
    answer = (
        "(() => {{ const form = document.querySelector('[data-question={0}]'); {1}; form.requestSubmit();"
        " const told = form.querySelector('[role=status]');"
        " return [$('{0}Result').hidden, told.className, told.textContent]; }})()"
    )
    write, choose = (
        "form.querySelector('input').value = '{}'",
        "form.querySelector('[value=\"{}\"]').checked = true",
    )
    expected = {
        "newton": (write, "many", "10", "26", "Plain Newton takes 26 steps."),
        "wall": (write, "0", "4", "10", "The paper's scheme takes 10 steps in 2 models, plain Newton 26."),
        "place": (choose, "", "0", "0.05", "T⁰ = 0.05 takes the fewest steps."),
        "stiff": (choose, "", "grow", "stay", "Proximal Newton takes 4 steps for κ = 1e3 and 5 for κ = 1e12."),
    }
    for name, (how, none, wrong, right, words) in expected.items():
        hidden, look, told = page.evaluate(answer.format(name, how.format(none) if none else ""))
        assert hidden and look == "fail" and told.startswith("Your prediction first"), name
        for given, expected_look in ((wrong, "fail"), (right, "pass")):
            hidden, look, told = page.evaluate(answer.format(name, how.format(given)))
            assert not hidden and look == expected_look and told.startswith(words), (name, told)
    page.evaluate("$('wallResult').querySelectorAll('[data-state]')[1].click()")
    assert page.evaluate("[settings.kappa, settings.T0, step]") == pytest.approx([1e12, -0.25, 10])
    assert page.evaluate("document.activeElement.id") == "on"
    assert page.messages == [] and [url for url in page.requests if not url.startswith("file:")] == []


def test_nothing_is_told_before_it_is_seen(page):
    """A method's count and its residuals shall be shown as far as the reader has gone."""
    page.evaluate("location.hash = '#problem=disc41&kappa=3&m=3&T0=0&tol=-6&step=3'")
    page.wait("step == 3")
    assert "12 steps" not in page.evaluate("document.body.innerText")
    assert page.evaluate("$('residuals').querySelectorAll('circle, rect').length") == 9
    page.evaluate("$('last').click()")
    assert "3 models, 12 steps" in page.evaluate("$('paperEnd').textContent")


@pytest.mark.parametrize(
    ("threshold", "wall", "words"), [(-0.1, True, "the wall carries "), (0.3, False, "below the wall")]
)
def test_law_with_its_wall(threshold, wall, words, page):
    """The law shall be drawn with its threshold, and with the wall where it is within the picture."""
    page.evaluate(f"location.hash = '#problem=disc41&kappa=3&m=3&T0={threshold}&tol=-6&step=0'")
    page.wait(f"settings.T0 == {threshold}")
    picture = "$('lawPicture').querySelector('{}')"
    assert page.evaluate(picture.format('[stroke-dasharray="6 4"]') + " != null")
    assert page.evaluate(picture.format('[stroke-width="5"]') + " != null") == wall
    assert words in page.evaluate("$('lawSaid').textContent")


def test_first_draw(made, page):
    """The first picture shall be drawn when the page opens, without a click."""
    fresh = page.browser.open(made, 1280, 900)
    assert fresh.evaluate("performance.getEntriesByName('drawn').length") == 1
    assert fresh.evaluate("location.hash") == "#problem=disc41&kappa=3&m=3&T0=0&tol=-6&step=0"


ANSWERED = """for (const form of document.querySelectorAll('form.predict')) {
  const field = form.querySelector('input');
  if (field.type == 'text') field.value = 10; else field.checked = true;
  form.requestSubmit();
}
document.querySelectorAll('#tasks button').forEach(button => button.click())"""


def test_for_everyone(made, page):
    """No serious fault in a window of a desk and of a phone, results open; each control is reached, and seen so."""
    pytest.importorskip("axe_core_python")
    assert access.wrong(page.browser, made, ANSWERED) == []
    fresh = page.browser.open(made, 1280, 900)
    fresh.evaluate(ANSWERED)
    assert access.walked(fresh) == ([], [])
    assert fresh.evaluate("controls.length") > 30
