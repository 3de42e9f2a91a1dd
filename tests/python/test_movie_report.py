"""Movies, the report, comparisons, all figures at once, the set-up check: on real runs, the page in a real browser."""

import fcntl
import html.parser
import json
import math
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import browser
import freefem
import numpy as np
import pytest
from freefem import ROOT, execute, patience, run, run_in, script, tree
from matplotlib.animation import FFMpegWriter
from scenes.test_scene_figures import WAVY
from text_boxes import faults

from postprocess import doctor, movie_player, style
from postprocess.command_line import main
from postprocess.formatting import command, figure_captions
from postprocess.laws import law_of
from postprocess.newton_movie import NewtonMovie, algorithm_line_caption, points_off_law
from postprocess.reference_values import PAPER, checks
from postprocess.results import Run, read_run

MOVIE = ["movie.html", "movie.gif", *(["movie.mp4"] if FFMpegWriter.isAvailable() else [])]


@pytest.fixture(scope="module")
def paper():
    """The paper's test by the paper's scheme, with its states: 12 Newton steps."""
    return run("disc-on-block", "-method", "paper", "-h", 0.5, "-states", 1).folder


@pytest.fixture(scope="module")
def brief():
    """The same by the default method: 2 or 3 Newton steps, so few frames."""
    return run("disc-on-block", "-h", 0.5, "-states", 1).folder


@pytest.fixture(scope="module")
def block():
    """A run with a single Newton step, so two frames."""
    return run("confined-block", "-method", "paper", "-h", 5, "-u0", 0.1, "-states", 1).folder


@pytest.fixture(scope="module")
def results(paper, brief):
    """A tree of results: a movie with its run, another run, a figure, a campaign, and the report made of them.

    Made once, whichever worker comes first. Its files must not be changed.
    """
    root = freefem.STORE / "results"
    with open(freefem.STORE / "results.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (root / "report").exists():
            folder = root / "movies" / "disc-on-block"
            shutil.copytree(brief, folder)
            shutil.copytree(paper, root / "disc-on-block" / "paper")
            (root / "bench").mkdir()
            (root / "bench" / "work_precision.csv").write_text(CAMPAIGN)
            assert main(["movie", "--out", str(folder), str(folder)]) == 0
            assert main(["figure", "convergence", "--out", str(root / "figures/convergence.pdf"), str(folder)]) == 0
            assert main(["report", "--out", str(root / "report" / "index.html"), str(root)]) == 0
    return root


@pytest.fixture(scope="module")
def film(results):
    """The folder of the movie, beside its run."""
    return results / "movies" / "disc-on-block"


CAMPAIGN = """script,flags,status,method,T0,newton,backsolves,cpu,costRatio,forceError,machine,cores,freefem
edp/main.edp,-method xnewton,converged,xnewton,,2,6,0.1,1.5,1e-9,a machine,2,4.9
edp/main.edp,-method paper,converged,paper,0,12,12,0.3,8.5,1e-8,a machine,2,4.9
edp/main.edp,-method paper -T0 <d0>,not converged,paper,d0,200,200,3,80,,a machine,2,4.9
"""


@pytest.fixture
def broken(brief, tmp_path):
    """broken(file, spoil): a copy of a run with one file spoilt."""

    def copy(name, spoil):
        folder = Path(shutil.copytree(brief, tmp_path / "runs" / "broken"))
        spoil(folder / name)
        return folder

    return copy


def rewritten(change):
    return lambda path: path.write_bytes(change(path.read_bytes()))


PUNCH = ["-a", 1, "-force", 20, "-order", 2, "-h", 0.05, "-grading", 160, "-law", "signorini"]

SPOILT = {"nan": rewritten(lambda data: data.rstrip(b"\n").rpartition(b",")[0] + b",nan\n"), "missing": Path.unlink}


def refused(capsys, *words):
    """The one line with which the command line refuses its arguments."""
    capsys.readouterr()
    assert main([str(word) for word in words]) == 2
    captured = capsys.readouterr()
    assert captured.out == "" and captured.err.startswith("postprocess: ")
    (line,) = captured.err.splitlines()
    return line


def loaded(folder, **changes):
    """The run with other parameters in its summary."""
    found = read_run(folder)
    parameters = {**found.summary["parameters"], **changes.pop("parameters", {})}
    return Run(found.path, {**found.summary, **changes, "parameters": parameters})


# ---------------------------------------------------------------- frames


class TestFrames:
    def test_steps_are_read(self, paper):
        """steps.csv shall hold the points before the first and after every Newton step; the last is the result."""
        found = read_run(paper)
        steps, contact = found.steps, found.contact
        assert steps.newton.tolist() == list(range(found.summary["newton"] + 1))
        assert steps.overlap.shape == (found.summary["newton"] + 1, found.summary["points"])
        for name, field in (("overlap", steps.overlap), ("pressure", steps.pressure), ("status", steps.status)):
            assert np.array_equal(field[-1], contact[name])
        assert np.all(np.diff(steps.x) > 0) and not steps.pressure[0].any()

    @pytest.mark.parametrize(
        "law, s, pressure",
        [
            ({"law": "power", "kappa": 1000, "m": 3, "d0": -0.25}, [-0.05, 0.0, 0.25], [0, 0, 15.625]),
            ({"law": "exponential", "p0": 0.02, "beta": 60, "d0": -0.25}, [-0.05, 0.1], [0, 0.02 * math.expm1(6)]),
            ({"law": "barrier", "p0": 1, "d0": -0.25}, [-0.05, 0.125, 0.2, 0.25], [0, 1, 4, math.inf]),
            ({"law": "signorini", "d0": -0.25}, [-0.05, 1.25], [0, 0]),
        ],
    )
    def test_the_laws_curves(self, brief, law, s, pressure):
        """The curve shall be that of the run's parameters."""
        assert law_of(loaded(brief, parameters=law))(np.array(s)) == pytest.approx(pressure)

    def test_a_frame_shows_the_points_and_the_disc(self, paper):
        """The dots shall be the points' overlaps and pressures, the disc where its prescribed motion takes it."""
        found = read_run(paper)
        with style.look():
            movie = NewtonMovie(found, style.Units("mm", "MPa"))
            movie.draw(movie.count - 1)
        assert movie.count == found.summary["newton"] + 1
        dots = np.concatenate([line.get_xydata() for line in movie.left.lines[1:]])
        contact = found.contact
        inside = contact["s"] >= movie.plane.left
        expected = np.column_stack([contact["s"], contact["pressure"]])[inside]
        assert sorted(map(tuple, dots)) == sorted(map(tuple, expected))
        (disc,) = movie.below.patches
        p = found.summary["parameters"]
        assert disc.get_xy()[:, 1].min() == pytest.approx(p["depth"] + p["gap"] - p["u0"], abs=1e-6)
        assert faults(movie.figure) == []
        lines = [algorithm_line_caption(found, index) for index in range(movie.count)]
        assert [index for index, words in enumerate(lines) if "back to line 1" in words] == [6, 10]
        assert "line 4 is next" in lines[0] and "the end" in lines[-1]
        assert all("back to line 4" in lines[index] for index in (1, 2, 3, 4, 5, 7, 8, 9, 11))

    def test_points_off_the_law_are_told(self, paper):
        """At the end every point shall be on the law or its wall; on the way those that are not shall be hollow."""
        with style.look():
            movie = NewtonMovie(read_run(paper), style.Units())
            movie.draw(4)
        assert not points_off_law(movie.steps, movie.plane, movie.count - 1)[0].any()
        off, expected = points_off_law(movie.steps, movie.plane, 4)
        assert 0 < off.sum() < len(off)
        assert np.allclose(expected[off], 1e3 * np.maximum(movie.steps.s[4][off], 0) ** 3)
        stems = movie.left.collections[1].get_segments()
        assert 0 < len(stems) <= off.sum()
        hollow = [line for line in movie.left.lines[1:] if line.get_markerfacecolor() == "white"]
        assert sum(len(line.get_xdata()) for line in hollow if line.get_color() == style.BLUE) > 0


# ---------------------------------------------------------------- movies


class TestMovie:
    def test_the_player(self, film):
        """The page shall hold every frame, ask nothing of the network, and tell in words what it shows."""
        page, frames = (film / "movie.html").read_text(), read_run(film).summary["newton"] + 1
        assert len(re.findall(r"frames\[\d+\] = ", page)) == frames
        assert "http" not in re.sub(r"base64,[^\"]*", "", page).replace("http-equiv", "")
        check_page(page)
        assert movie_player.extract(page).count("<script") == 2

    def test_the_gif(self, film):
        from PIL import Image

        frames = read_run(film).summary["newton"] + 1
        with Image.open(film / "movie.gif") as picture:
            assert picture.n_frames >= frames

    def test_speed_and_single_frames(self, film, tmp_path, capsys):
        """Twice the speed, half the time; a frame alone as SVG, the same bytes again; no such frame is refused."""
        from PIL import Image

        assert main(["movie", "--speed", "2", "--out", str(tmp_path), str(film)]) == 0
        pauses = []
        for path in (film, tmp_path):
            with Image.open(path / "movie.gif") as picture:
                pauses.append(picture.info["duration"])
        assert pauses[0] == pytest.approx(2 * pauses[1], abs=20)
        drawn = []
        for name in ("a", "b"):
            assert main(["movie", "--frame", "2", "--out", str(tmp_path / name), str(film)]) == 0
            drawn += [path.read_bytes() for path in (tmp_path / name).iterdir()]
        assert len(drawn) == 2 and drawn[0] == drawn[1] and b"<svg" in drawn[0]
        assert main(["movie", "--frame", "99", "--out", str(tmp_path), str(film)]) == 2
        assert "allowed: 1 to" in capsys.readouterr().err

    def test_make_movie(self, tmp_path):
        """`make movie` shall make the run and its movie."""
        package = tree(tmp_path / "package")
        for name in ("postprocess", ".venv"):
            (package / name).symlink_to(ROOT / name)
        made = ["make", "-o", ".venv/run.stamp", "-o", "system", "movie", "SCENE=confined-block"]
        code, stdout = execute([*made, "ARGS=-method newton -h 5 -tol 0.5 -estimate 0"], cwd=package)
        assert code == 0, stdout
        folder = package / "results/movies/confined-block"
        assert (folder / "movie.html").exists() and (folder / "movie.gif").exists()

    def test_a_run_in_space(self, tmp_path, capsys):
        """States in space are for ParaView: the movie is refused in one line that says so."""
        folder = run("sphere-on-block", "-h", 1.2, "-layers", 2, "-tol", 1e-8, "-states", 1).folder
        line = refused(capsys, "movie", "--out", tmp_path / "out", folder)
        assert "in space" in line and "states.pvd" in line
        assert not (tmp_path / "out").exists()

    def test_a_run_without_states(self, brief, tmp_path, capsys):
        folder = tmp_path / "run"
        shutil.copytree(brief, folder, ignore=shutil.ignore_patterns("steps.csv"))
        line = refused(capsys, "movie", "--out", tmp_path / "out", folder)
        assert line.endswith("steps.csv: no such file; run the scene with -states 1")
        assert not (tmp_path / "out").exists()


# ---------------------------------------------------------------- hostile inputs


@pytest.mark.parametrize("spoilt", SPOILT)
@pytest.mark.parametrize("name", ["steps.csv", "states.csv", "history.csv", "contact.csv", "summary.json"])
def test_hostile_files(broken, brief, tmp_path, capsys, name, spoilt):
    """A file that cannot be used: one clear line that names it, exit code 2, no traceback, nothing written."""
    folder = broken(name, SPOILT[spoilt])
    out = tmp_path / "new" / "out"
    movie = ("movie", "--out", out, folder)
    report = ("report", "--out", out / "index.html", folder.parent)
    compare = ("compare", brief, folder, "--out", out / "c.pdf")
    readers = {
        "steps.csv": [movie],
        "states.csv": [movie],
        "history.csv": [report, compare] + [movie] * (spoilt == "nan"),  # a movie reads it last, its axes drawn
        "contact.csv": [compare],
        "summary.json": [movie, compare, ("show", folder), report, ("figures", folder.parent, "--out", out)],
    }[name]
    for words in readers:
        if spoilt == "missing" and name == "summary.json" and words[0] in ("report", "figures"):
            assert "holds no" in refused(capsys, *words)
        else:
            assert f"{name}: " in refused(capsys, *words)
    assert not out.parent.exists()


@pytest.mark.parametrize(
    "name, content, words",
    [
        ("figures/f.png", b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR", "is truncated"),
        ("figures/f.png", b"GIF89a", "is not a PNG"),
        ("figures/f.png", b"", "is empty"),
        ("movies/a/movie.html", b"<html></html>", "is not a movie's page"),
        ("movies/a/movie.html", b"\xff\xfe\x00", "is not a movie's page"),
        ("bench/meshes.csv", b"a,b\n1,2\n", "wrong columns"),
        ("bench/meshes.csv", bytes(range(256)), "is binary"),
        ("stability/stability.csv", b"", "is empty"),
        ("stability/checks.csv", b"check,found\nx,1\n", "wrong columns"),
    ],
)
def test_hostile_files_of_a_tree(tmp_path, capsys, name, content, words):
    """The same for figures, movies and campaigns."""
    (tmp_path / name).parent.mkdir(parents=True)
    (tmp_path / name).write_bytes(content)
    line = refused(capsys, "report", "--out", tmp_path / "out" / "index.html", tmp_path)
    assert name in line and words in line
    assert not (tmp_path / "out").exists()


def test_senseless_parameters(block, capsys, tmp_path, monkeypatch):
    """Numbers that no run would write shall be refused or drawn, never end in a traceback."""
    monkeypatch.setattr(doctor, "versions", dict)
    several = {"d0": 1e308}, {"R": -1, "d0": "x"}, {"law": "barrier", "d0": 0}, {"kappa": 1e300, "m": 1e300, "nu": 0.5}
    for changes in several:
        folder = tmp_path / str(len(list(tmp_path.iterdir())))
        shutil.copytree(block, folder)
        summary = json.loads((folder / "summary.json").read_text())
        summary["parameters"].update(changes)
        (folder / "summary.json").write_text(json.dumps(summary))
        assert main(["movie", "--out", str(folder / "out"), str(folder)]) in (0, 2)
        assert main(["report", "--out", str(folder / "r.html"), str(folder)]) in (0, 2)
        assert "Traceback" not in capsys.readouterr().err


# ---------------------------------------------------------------- the report


class Checker(html.parser.HTMLParser):
    """What a page must have for those who do not see it; everything it links to must be in it."""

    VOID = frozenset("img meta link input br hr".split())

    def __init__(self):
        super().__init__()
        self.open, self.seen = [], {}

    def handle_starttag(self, tag, pairs):
        self.seen.setdefault(tag, []).append(dict(pairs))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def check_page(page):
    """The page's parser, once it is well formed and complete."""
    checker = Checker()
    checker.feed(page)
    checker.close()
    every = [attributes for tags in checker.seen.values() for attributes in tags]
    ids = [attributes["id"] for attributes in every if "id" in attributes]
    links = [attributes[name] for attributes in every for name in ("src", "href") if name in attributes]
    assert not checker.open and all(image.get("alt") for image in checker.seen.get("img", []))
    assert all(to.startswith(("#", "data:")) for to in links)
    assert len(set(ids)) == len(ids) and {to[1:] for to in links if to.startswith("#") and to != "#"} <= set(ids)
    assert page.startswith("<!DOCTYPE html>") and checker.seen["html"] == [{"lang": "en"}]
    assert "@import" not in page
    return checker


class TestReport:
    def test_the_page(self, results, film):
        """One page, complete in itself: figures, movie, references, runs by scene, campaign, machine, commands."""
        page = (results / "report" / "index.html").read_text()
        seen = check_page(page).seen
        assert len(seen["img"]) == 3
        assert "2 of 2 runs converged. 6 of 6 comparisons with a reference pass." in page
        for words in ("150.02947", "22.559747", "4.927623", "make results/figures/convergence.pdf", "make bench"):
            assert words in page
        made = re.search(r"FreeFem\+\+ edp/main.edp (.*-method paper.*) -out", page)[1].split()
        flags = {"-method": "paper", "-order": "1", "-h": "0.5", "-estimate": "0", "-states": "1", "-vtu": "0"}
        assert dict(zip(made[::2], made[1::2], strict=True)) == flags
        caption = figure_captions()["convergence"]
        assert (
            caption in [each["alt"] for each in seen["img"]]
            and f"<strong>convergence</strong>: {html.escape(caption)}" in page
        )
        assert "T⁰ = d0" in page and "-T0 &lt;d0&gt;" in page  # the campaign's failed run, escaped
        text = re.sub(r"<[^>]*>", " ", page)
        for residual in read_run(film).history["residual"]:
            assert f"{residual:.2e}" in text

    def test_texts_of_runs_are_escaped(self, brief, tmp_path):
        folder = tmp_path / "results" / "a<b>"
        shutil.copytree(brief, folder)
        summary = json.loads((folder / "summary.json").read_text())
        summary["scene"] = summary["parameters"]["note"] = '<script>alert("x")</script>'
        (folder / "summary.json").write_text(json.dumps(summary))
        out = tmp_path / "index.html"
        assert main(["report", "--out", str(out), str(tmp_path / "results")]) == 0
        assert "script" not in check_page(out.read_text()).seen

    def test_a_wrong_result_fails(self, brief):
        """The force shall be compared, within what mesh and tolerance explain, and fail beyond it."""
        force = next(each for each in checks(read_run(brief)) if each.name == "force")
        assert force.passed and force.reference == PAPER[1000, 3]["force"]
        wrong = checks(loaded(brief, force=1.04 * force.reference))
        assert [each.name for each in wrong if not each.passed] == ["force"]

    @pytest.mark.parametrize(
        "changes", [{"kappa": 1e6}, {"u0": 2}, {"offset": 1}, {"law": "barrier"}, {"geometry": "stress"}, {"m": 5}]
    )
    def test_other_parameters_are_not_compared(self, brief, changes):
        assert checks(loaded(brief, parameters=changes)) == []

    @pytest.mark.parametrize("flags", [["-h", 5], ["-h", 5, "-method", "signorini"], ["-h", 5, "-kappa", 1e9, "-m", 2]])
    def test_the_confined_block_is_compared_with_its_exact_state(self, flags):
        found = checks(read_run(run("confined-block", *flags).folder))
        assert [each.name for each in found] == ["force", "greatest pressure"]
        assert all(each.passed for each in found)

    @pytest.mark.parametrize(
        "scene, flags, source, names",
        [
            ("hertz-line", [], "Hertz", ["half-width", "greatest pressure"]),
            ("hertz-line", ["-geometry", "stress"], "Hertz", ["half-width", "greatest pressure"]),
            ("hertz-line", ["-geometry", "axisymmetric", "-force", 10], "Hertz", ["radius", "greatest pressure"]),
            ("flat-punch", [*PUNCH, "-geometry", "axisymmetric"], "flat punch", ["pressure in the middle"]),
            ("sphere-on-plane", [], "Hertz", ["radius", "greatest pressure"]),
            ("flat-punch", PUNCH, "flat punch", ["pressure in the middle"]),
            ("wavy", [*WAVY, "-force", 31.41592654], "Westergaard", ["greatest pressure"]),
        ],
    )
    def test_closed_forms_are_compared(self, scene, flags, source, names):
        """Hard contact under a force shall be compared with its closed form, and fail a tenth off it."""
        found = read_run(run(scene, *flags).folder)
        several = checks(found)
        assert [(each.name, each.source, each.passed) for each in several] == [(name, source, True) for name in names]
        for each in several:
            assert not replace(each, value=1.1 * each.value).passed
            assert not replace(each, value=0.9 * each.value).passed
        assert checks(loaded(found.path, parameters={"law": "power"})) == []
        assert checks(loaded(found.path, parameters={"force": 0})) == []
        assert checks(loaded(found.path, parameters={"traction": 1})) == []

    def test_the_first_lines_name_what_failed(self, brief, tmp_path):
        """A wrong number and a run that did not converge shall stand by name at the top of the page."""
        for name, change in (("wrong", {"force": 160.0}), ("open", {"converged": False})):
            shutil.copytree(brief, tmp_path / "results" / name)
            file = tmp_path / "results" / name / "summary.json"
            file.write_text(json.dumps({**json.loads(file.read_text()), **change}))
        assert main(["report", "--out", str(tmp_path / "r.html"), str(tmp_path / "results")]) == 0
        top = (tmp_path / "r.html").read_text().partition("<main")[0]
        assert "Failed: wrong (force +6.6%), open (not converged)." in top

    def test_error_against_run_time(self, tmp_path):
        """The report shall draw the paper's test over CPU seconds and over the seconds that a person waits."""
        for h in (2, 1):
            began = time.monotonic()
            flags = ("-method", "newton", "-h", h, "-order", 1, "-half", 1, "-estimate", 0, "-vtu", 0)
            made = run_in(ROOT, script("disc-on-block"), *flags, out=tmp_path / "results" / f"h-{h}").summary
            # its own clock, the first start included, which finds out that the option is needed
            passed = time.monotonic() - began
            assert 0.7 * passed < made["seconds"]["waited"] <= passed + 0.02
        assert main(["report", "--out", str(tmp_path / "r.html"), str(tmp_path / "results")]) == 0
        part = (tmp_path / "r.html").read_text().partition('<section id="accuracy"')[2].partition("</section>")[0]
        error = abs(made["force"] / PAPER[1000, 3]["force"] - 1)
        assert "data:image/png" in part and f"{error:.1e}" in part and f"{made['seconds']['waited']:.3g}" in part

    def test_nothing_to_report(self, tmp_path, capsys):
        assert "holds no run and no figure" in refused(capsys, "report", "--out", tmp_path / "r.html", tmp_path)
        assert "no such folder" in refused(capsys, "report", "--out", tmp_path / "r.html", tmp_path / "nowhere")
        assert "ends in .html" in refused(capsys, "report", "--out", tmp_path / "r.pdf", tmp_path)


@pytest.mark.skipif(browser.CHROMIUM is None, reason="no chromium, chromium-browser or google-chrome on the PATH")
class TestInABrowser:
    def test_the_report(self, results, film, tmp_path):
        """No error, no request, every picture loaded; the player plays."""
        with browser.Browser(tmp_path) as chromium:
            page = chromium.open(results / "report" / "index.html")
            page.wait("[...document.images].every(image => image.complete && image.naturalWidth > 0)")
            assert page.evaluate("document.images.length") == 3
            page.evaluate("document.querySelector('[aria-label=\"Increase speed\"]').click()")
            before = page.evaluate("document.querySelector('.animation img').src.length")
            page.evaluate("document.querySelector('[aria-label=Play]').click()")
            page.wait(f"document.querySelector('.anim-slider').value == '{read_run(film).summary['newton']}'")
            assert page.evaluate("document.querySelector('.animation img').src.length") != before
            page.evaluate("document.querySelector('[aria-label=\"First frame\"]').click()")
            assert page.evaluate("document.querySelector('.anim-slider').value") == "0"
            assert page.messages == [] and len(page.requests) == 1


# ---------------------------------------------------------------- the commands that make runs again


@pytest.mark.parametrize(
    "scene, flags",
    [
        ("disc-on-block", ["-h", 2, "-inner", "newton", "-T0", "d0", "-kappa", 1e6, "-nu", 0.25, "-tol", 1e-8]),
        ("confined-block", ["-h", 5, "-width", 10, "-law", "exponential", "-method", "incremental", "-steps", 3]),
    ],
)
def test_the_command_makes_the_run_again(tmp_path, scene, flags):
    """The command in the report shall give the same numbers."""
    found = read_run(run(scene, *flags).folder)
    words = shlex.split(command(found))
    assert words[:2] == ["FreeFem++", script(scene)] and words[-2] == "-out"
    assert set(words[2:-2:2]) - {"-vtu"} == {*flags[::2], "-order", "-estimate"}
    again = run_in(ROOT, words[1], *words[2:-2], out=tmp_path / "again").summary
    for name in ("force", "newton", "backsolves", "energy", "ndof"):
        assert again[name] == found.summary[name], name
    left_out = {"out", "vtu"}
    assert {name: value for name, value in again["parameters"].items() if name not in left_out} == {
        name: value for name, value in found.summary["parameters"].items() if name not in left_out
    }


# ---------------------------------------------------------------- compare, figures, show


def test_compare_prints_the_differences(paper, brief, tmp_path, capsys):
    """The table shall hold both runs' values and their differences, and the parameters in which they differ."""
    assert main(["compare", str(paper), str(brief), "--out", str(tmp_path / "c.pdf")]) == 0
    *lines, pdf, png = capsys.readouterr().out.splitlines()
    assert [pdf, png] == [str(tmp_path / "c.pdf"), str(tmp_path / "c.png")] and Path(pdf).exists()
    rows = {line.split()[0]: line.split() for line in lines[1:]}
    one, two = (read_run(folder).summary for folder in (paper, brief))
    assert rows["newton"][1:4] == [str(one["newton"]), str(two["newton"]), f"{two['newton'] - one['newton']:+d}"]
    assert float(rows["force"][3]) == pytest.approx(two["force"] - one["force"], rel=0.01)
    assert rows["-T0"] == ["-T0", "0", "auto"] and "-kappa" not in rows
    assert {"pressureMax", "halfWidth", "seconds.total", "method"} <= set(rows)
    assert len({len(line.rstrip()) for line in lines if line.startswith(("force", "pressureMax"))}) == 1


def test_every_figure_at_once(tmp_path, capsys):
    """`figures` shall draw what can be drawn, and list what is missing with what it needs."""
    out = tmp_path / "figures"
    root = tmp_path / "tree"
    shutil.copytree(run("disc-on-block", "-method", "paper", "-order", 1, "-h", 0.5).folder, root / "paper")
    assert main(["figures", str(root), "--out", str(out)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert sorted(path.name for path in out.iterdir()) == [
        f"{name}.{kind}" for name in ("convergence", "thresholds") for kind in ("pdf", "png")
    ]
    missing = [line for line in lines if line.startswith("not made: ")]
    assert any("figure2: needs a run of the method incremental" in line for line in missing)
    assert any("bench_growth: needs make bench" in line for line in missing)


def test_output_that_is_not_read_to_its_end(brief):
    """`show RUN | head -1` shall not end in a traceback."""
    text = f"{shlex.quote(sys.executable)} -m postprocess show {shlex.quote(str(brief))} | head -n 1"
    done = subprocess.run(["sh", "-c", text], cwd=ROOT, capture_output=True, text=True)
    assert done.stdout.startswith("run") and done.stderr == ""


# ---------------------------------------------------------------- the set-up check


class TestDoctor:
    SYSTEM = shutil.which("python3", path="/usr/bin:/bin") or sys.executable

    def examine(self, folder, **environment):
        """Exit code and output of the check with a bare Python: no module beyond the standard ones."""
        command = [self.SYSTEM, "-I", "-S", str(folder / "postprocess" / "doctor.py")]
        done = subprocess.run(
            command, capture_output=True, text=True, env={**os.environ, **environment}, timeout=patience(60)
        )
        assert done.stderr == ""
        return done.returncode, done.stdout

    def test_everything_is_there(self):
        code, stdout = self.examine(ROOT)
        assert code == 0, stdout
        for name in ("FreeFem++", "plugin gmsh", "plugin lapack", "plugin ff-Ipopt", "gmsh", "numpy", "plugin path"):
            assert re.search(rf"^(ok|absent) +{re.escape(name)} ", stdout, re.M), name

    def test_what_is_missing_and_how_to_get_it(self, tmp_path):
        """Without FreeFem++, and without .venv: code 1, and a way to get each."""
        (tmp_path / "bin").mkdir()
        for name in ("python3", "apt-get", "make"):
            (tmp_path / "bin" / name).symlink_to(shutil.which(name) or "/bin/true")
        (tmp_path / "postprocess").mkdir()
        shutil.copy(ROOT / "postprocess" / "doctor.py", tmp_path / "postprocess")
        code, stdout = self.examine(tmp_path, PATH=str(tmp_path / "bin"))
        assert code == 1
        assert "MISSING  FreeFem++" in stdout and "-> apt-get install freefem++" in stdout
        assert "no .venv" in stdout and "-> make setup" in stdout and "Missing for `make run`: FreeFem++" in stdout

    @pytest.mark.skipif(not Path("/usr/lib/freefem++").exists(), reason="only Debian's FreeFEM needs freefem++.pref")
    def test_a_broken_plugin_path(self, tmp_path):
        (tmp_path / "postprocess").mkdir()
        shutil.copy(ROOT / "postprocess" / "doctor.py", tmp_path / "postprocess")
        code, stdout = self.examine(tmp_path, HOME=str(tmp_path), FF_LOADPATH="")
        assert code == 1 and re.search(r"^MISSING +plugin gmsh +cannot be loaded", stdout, re.M)


def test_pictures_of_a_run(tmp_path, capsys):
    """A run's own pictures shall be shown with it, where they have been drawn; captions lean on no other."""
    folder = tmp_path / "results/disc"
    run_in(ROOT, script("disc-on-block"), "-h", 2, "-estimate", 0, out=folder)
    out = tmp_path / "index.html"
    assert main(["report", "--out", str(out), str(tmp_path / "results")]) == 0
    assert "postprocess state" not in out.read_text()
    assert main(["state", str(folder)]) == 0 and main(["report", "--out", str(out), str(tmp_path / "results")]) == 0
    assert "postprocess state" in out.read_text() and "the pressure along the contact" in out.read_text()
    assert not [name for name, words in figure_captions().items() if re.match("The same|As |That sphere", words)]
