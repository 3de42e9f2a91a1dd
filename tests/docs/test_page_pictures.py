"""The pictures that pages show are none of yesterday: each keeps the recipe and the numbers that it was drawn from.

`make pictures` draws them and keeps both in the PNG; pixels, which depend on fonts and libraries, are not compared.
"""

import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pictures
import pytest
import screens
from freefem import ROOT, run_in, script
from PIL import Image

from postprocess import bodies, style
from postprocess.commands import small, stress
from postprocess.output import DRAWN, drawn_numbers
from postprocess.results import read_run

SHOWN = re.compile(r"!\[[^\]]*\]\(([^)]*\.png)\)")
PAGES = [ROOT / "README.md", *sorted((ROOT / "edp").rglob("*.md"))]
PICTURES = {(page.parent / name).resolve(): page for page in PAGES for name in SHOWN.findall(page.read_text())}
EXAMPLES = sorted((ROOT / "edp/examples").glob("*/README.md"))


def kept(picture):
    """What a PNG has been drawn from."""
    with Image.open(picture) as image:
        return image.text


def same(told, drawn):
    """Are these the numbers of the same picture, to two in a hundred of the largest beside them?"""
    old, new = (np.array(words.split(), float) for words in (told, drawn))
    return len(old) == len(new) and np.allclose(old, new, rtol=0.02, atol=1e-6 * np.abs(new).max())


@pytest.mark.parametrize("picture", sorted(PICTURES), ids=lambda path: path.relative_to(ROOT).as_posix())
def test_recipes(picture, monkeypatch):
    """The commands of the page that a picture was drawn by shall be those that the page has now; the file is small."""
    monkeypatch.chdir(ROOT)
    assert picture.stat().st_size < 100_000
    words = kept(picture).get(small.RECIPE, "").split()
    assert words and words[1] == small.recipe(Path(words[0])).split()[1], "make pictures"


@pytest.mark.parametrize("name", pictures.PICTURES)
def test_pictures_of_campaigns(name):
    """A picture of tables shall have the numbers that the tables have now."""
    with style.look():
        assert same(kept(ROOT / "postprocess" / name)[DRAWN], drawn_numbers(pictures.PICTURES[name]())), "make pictures"


def test_first_picture(tmp_path):
    """The README's first picture shall show what its commands draw now."""
    made = run_in(ROOT, script("meshed-disc"), out=tmp_path / "run")
    with style.look():
        drawn = stress.draw(bodies.read_bodies(read_run(made.folder)), style.Units(), None, True)
    assert same(kept(ROOT / "postprocess/readme-first.png")[DRAWN], drawn_numbers(drawn)), "make pictures"
    assert any(f"{made.force:.3f}" in axes.get_title(loc="left") for axes in drawn.axes)


@pytest.mark.parametrize("page", EXAMPLES, ids=lambda page: page.parent.name)
def test_pictures_of_examples(page, tmp_path):
    """An example's picture shall show what its commands draw now."""
    package = screens.package(tmp_path / "package")
    for block in re.findall(r"^```sh\n(.*?)^```", page.read_text(), re.M | re.S):
        code, said = screens.execute(SimpleNamespace(text=block), package)
        assert code == 0, said[-2000:]
    (name,) = SHOWN.findall(page.read_text())
    (made,) = (package / "results").glob(f"parts*/{page.parent.name}/{name}")
    assert same(kept(page.parent / name)[DRAWN], kept(made)[DRAWN]), "make pictures"
