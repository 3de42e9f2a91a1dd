"""The page that needs nothing installed: its numbers are the package's, it is quick, works by keys and on a phone."""

import json

import pytest
from browser import CHROMIUM, Browser
from freefem import run, short_of

from postprocess.__main__ import main

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


@pytest.mark.parametrize("problem, method, kappa, m, threshold", short_of(DISC[3:4], DISC))
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


@pytest.mark.parametrize("method, kappa, m", short_of(BLOCK[:1], BLOCK))
def test_block(method, kappa, m, page):
    """The confined block: steps and pressure shall be the package's."""
    start = ["-T0", "d0"] if method == "paper" else []
    flags = ["-method", method, *start, "-kappa", kappa, "-m", m, "-h", 10, "-tol", 1e-12]
    theirs = run("confined-block", *flags)
    ours = solved(page, "block", method, kappa, m, -0.25, 1e-12)
    assert ours["newton"] == theirs.newton
    assert 20 * ours["force"] == pytest.approx(theirs.force, rel=1e-9)


@pytest.mark.long
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
