"""postprocess/ on small real runs: readers, refusals, figures, command line."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from freefem import ROOT, cases_of, run
from matplotlib.figure import Figure
from text_boxes import faults

from postprocess import figures, output, results, style
from postprocess.command_line import main
from postprocess.results import ResultsError, read_run

DISC = ["disc-on-block", "-h", 0.5, "-method"]


@pytest.fixture(scope="session")
def runs():
    """Run folders by name: the methods, and a run without contact."""
    several = {
        "meshed": ["meshed-disc", "-h", 1, "-method", "paper", "-states", 1],
        "rigid": [*DISC, "paper", "-states", 1],
        "d0": [*DISC, "paper", "-T0", "d0"],
        "newton": [*DISC, "newton"],
        "incremental": [*DISC, "incremental", "-steps", 4],
        "apart": [*DISC, "paper", "-states", 1, "-u0", 0.2],
    }
    return {name: run(*flags).folder for name, flags in several.items()}


@pytest.fixture
def broken(runs, tmp_path):
    """A copy of a run to be spoilt: broken(name) returns its folder."""

    def copy(name="rigid"):
        return Path(shutil.copytree(runs[name], tmp_path / "broken"))

    return copy


def edit_summary(folder, **changes):
    path = folder / "summary.json"
    summary = json.loads(path.read_text())
    summary.update(changes)
    path.write_text(json.dumps(summary))


def refusal(folder, *names):
    """The text with which the reader refuses a run when the named files (default: all) are read."""
    with pytest.raises(ResultsError) as caught:
        run = read_run(folder)
        for name in names or ("history", "contact", "adaptations", "states", "mesh"):
            getattr(run, name)
    text = str(caught.value)
    assert "\n" not in text and len(text) < 500
    return text


class TestReading:
    def test_a_run_is_read_with_shapes_and_types(self, runs):
        run = read_run(runs["meshed"])
        assert run.summary["method"] == "paper" and run.summary["converged"] is True
        assert len(run.history["newton"]) == run.summary["newton"]
        assert run.history["newton"].dtype == np.int64 and run.history["residual"].dtype == np.float64
        assert len(run.contact["x"]) == run.summary["points"] and np.all(np.diff(run.contact["x"]) > 0)
        assert len(run.adaptations) == run.summary["adaptations"]
        assert run.adaptations[1]["threshold"].shape == (run.summary["points"],)
        states = run.states
        assert states.ux.shape == states.uy.shape == (run.summary["newton"] + 2, len(states.x))
        assert states.newton[:3].tolist() == [0, 0, 1] and states.newton[-1] == run.summary["newton"]
        assert run.mesh.triangles.max() == len(states.x) - 1 and set(run.mesh.region) == {1, 2}
        assert run.parameter("d0") == -0.25

    def test_columns_are_found_by_name(self, broken):
        folder = broken()
        expected = read_run(folder).contact
        path = folder / "contact.csv"
        rows = [line.split(",") for line in path.read_text().splitlines()]
        path.write_text("".join(",".join(["note" if n == 0 else "7", *row[::-1]]) + "\n" for n, row in enumerate(rows)))
        found = read_run(folder).contact
        assert all(np.array_equal(found[name], expected[name]) for name in expected)

    def test_points_are_sorted_by_x(self, broken):
        folder = broken()
        path = folder / "contact.csv"
        head, *rows = path.read_text().splitlines(keepends=True)
        path.write_text(head + "".join(rows[::-1]))
        assert np.all(np.diff(read_run(folder).contact["x"]) > 0)

    def test_infinite_thresholds_are_read(self, runs):
        run = read_run(runs["newton"])
        assert np.all(run.contact["threshold"] == np.inf) and np.all(run.adaptations[0]["threshold"] == np.inf)

    def test_a_run_without_newton_steps(self, broken):
        folder = broken("newton")
        edit_summary(folder, newton=0)
        (folder / "history.csv").write_text(",".join(results.HISTORY) + "\n")
        assert all(len(column) == 0 for column in read_run(folder).history.values())


class TestRefusals:
    def test_no_folder(self, tmp_path):
        assert refusal(tmp_path / "nowhere") == f"{tmp_path / 'nowhere'}: no such folder"

    def test_a_file_in_place_of_the_folder(self, runs):
        assert refusal(runs["rigid"] / "summary.json").endswith("summary.json: is not a folder")

    def test_folder_without_summary(self, tmp_path):
        assert refusal(tmp_path) == f"{tmp_path / 'summary.json'}: no such file"

    @pytest.mark.parametrize(
        ("content", "words"),
        [
            (b"", "is empty"),
            (b'{"scene": "disc-on-block", ', "is truncated, at line 1"),
            (b"PK\x03\x04\xff\xfe\x00\x01", "is binary"),
            (b"[1, 2]", "not a run's summary"),
            (b'{"name": "left-pad", "version": "1.0"}', "no key scene"),
            (b'{"force": NaN}', "holds NaN"),
            (b'{"force": -Infinity}', "holds -Infinity"),
            (b"[" * 100000, "recursion"),
            (b'{"newton": ' + b"9" * 5000 + b"}", "digits"),
        ],
    )
    def test_bad_summaries(self, broken, content, words):
        folder = broken()
        (folder / "summary.json").write_bytes(content)
        text = refusal(folder)
        assert "summary.json: " in text and words in text

    @pytest.mark.parametrize(
        ("key", "value"),
        zip(
            "converged newton newton force parameters newtonPerAdaptation method points h".split(),
            [1, -3, 2.5, "large", [], 12, None, True, [0.5]],
            strict=True,
        ),
    )
    def test_summary_values_of_the_wrong_kind(self, broken, key, value):
        folder = broken()
        edit_summary(folder, **{key: value})
        assert f"key {key} is not" in refusal(folder)

    def test_a_huge_summary_number_is_refused(self, broken):
        path = broken() / "summary.json"
        path.write_text(re.sub(r'"force": [^,]*', '"force": 1e999', path.read_text(), count=1))
        assert "key force is not a number" in refusal(path.parent)

    @pytest.mark.parametrize("name", ["history", "contact", "triangles", "states"])
    @pytest.mark.parametrize(
        ("spoil", "words"),
        [
            (lambda data: None, "no such file"),
            (lambda data: b"", "is empty"),
            (lambda data: data[:-1], "is truncated: the last line has no end"),
            (lambda data: data[: len(data) // 2].rpartition(b"\n")[0] + b"\n", ""),
            (lambda data: bytes(range(256)) * 8, "is binary"),
            (lambda data: b"time;price\n1;2\n", "wrong columns"),
            (lambda data: data.replace(b"\n", b",1,2\n").replace(b",1,2", b"", 1), "values in a row"),
            (lambda data: data.replace(b"\n", b",1\n", 4).replace(b",1\n", b"\n", 1), "unreadable row"),
            (lambda data: data.rstrip(b"\n").rpartition(b",")[0] + b",nan\n", "has the value nan in line"),
            (lambda data: data.partition(b"\n")[0] + b"\n", ""),
            (lambda data: data.partition(b"\n")[0] + b"\n\xff\xfe\xfd\n", "unreadable row"),
        ],
    )
    def test_bad_tables(self, broken, name, spoil, words):
        folder = broken()
        path = folder / f"{name}.csv"
        data = spoil(path.read_bytes())
        path.unlink()
        if data is not None:
            path.write_bytes(data)
        text = refusal(folder, {"triangles": "mesh"}.get(name, name))
        assert text.startswith(f"{path}: ") and words in text

    @pytest.mark.parametrize(
        ("name", "spoil", "words"),
        [
            ("contact", lambda text: text.replace("x,y,weight", "x,y,weight,weight", 1), "appears twice"),
            ("contact", lambda text: re.sub(r"\n[^,]*,", "\ninf,", text, count=1), "x has the value inf in line 2"),
            ("contact", lambda text: re.sub(r"((,[^,]+){3}),\d((,[^,]+){8})\n$", r"\1,4\3\n", text), "status has 4"),
            ("history", lambda text: text.replace("\n1,1,1,1,", "\n1,1,1.5,1,", 1), "iteration has 1.5 in line 2"),
            ("history", lambda text: re.sub(r"\n(.*)\n(.*)\n", r"\n\2\n\1\n", text, count=1), "does not count 1, 2, 3"),
        ],
    )
    def test_bad_values(self, broken, name, spoil, words):
        folder = broken()
        path = folder / f"{name}.csv"
        path.write_text(spoil(path.read_text()))
        assert words in refusal(folder, name)

    def test_tables_of_another_run(self, broken, runs):
        folder = broken()
        shutil.copy(runs["d0"] / "history.csv", folder)
        assert "or of another run" in refusal(folder, "history")

    def test_mesh_of_another_run(self, broken, runs):
        folder = broken("meshed")
        shutil.copy(runs["rigid"] / "triangles.csv", folder)
        assert "vertex index outside" in refusal(folder, "mesh")

    def test_states_are_asked_for_by_their_flag(self, runs):
        assert refusal(runs["d0"], "states").endswith("states.csv: no such file; run the scene with -states 1")

    @pytest.mark.parametrize("make", [os.mkdir, os.mkfifo])
    def test_something_else_in_place_of_a_file(self, broken, make):
        folder = broken()
        (folder / "contact.csv").unlink()
        make(folder / "contact.csv")
        assert refusal(folder, "contact").endswith("is not a file")

    def test_a_gigabyte_is_refused_unread(self, broken):
        folder = broken()
        for name in ("contact.csv", "summary.json"):
            os.truncate(folder / name, 10**9)
            assert "is too large: 1000 MB, at most 200 MB" in refusal(folder)

    def test_a_parameter_that_is_not_there(self, runs):
        with pytest.raises(ResultsError, match=r"summary\.json: parameters has no number Eratio"):
            read_run(runs["rigid"]).parameter("Eratio")


FIGURES = {"figure1", "figure2", "convergence", "thresholds"}


def draw(name, *folders):
    with style.look():
        return figures.modules()[name].draw([read_run(folder) for folder in folders], style.Units())


class TestFigures:
    @pytest.mark.parametrize("name", ["figure1", "thresholds"])
    def test_the_same_bytes_again(self, runs, tmp_path, name):
        for folder in ("one", "two"):
            assert main(["figure", name, "--out", str(tmp_path / folder / "f.pdf"), str(runs["rigid"])]) == 0
        for kind in ("pdf", "png"):
            assert (tmp_path / "one" / f"f.{kind}").read_bytes() == (tmp_path / "two" / f"f.{kind}").read_bytes()
        assert not re.search(rb"CreationDate|ModDate", (tmp_path / "one" / "f.pdf").read_bytes())

    DRAWN = "figure1 meshed, figure2 rigid incremental, thresholds newton, thresholds rigid d0".split(", ")
    ALSO = "figure1 rigid, figure1 apart, convergence rigid d0 newton incremental".split(", ")

    @pytest.mark.parametrize("case", cases_of(DRAWN, ALSO))
    def test_drawn(self, runs, case):
        name, *folders = case.split()
        assert faults(draw(name, *(runs[folder] for folder in folders))) == []

    def test_figure1_shows_the_first_and_the_last_model(self, runs):
        axes, models = draw("figure1", runs["meshed"]).axes, read_run(runs["meshed"]).adaptations
        for panel, model in ((axes[10], models[0]), (axes[11], models[-1])):
            overlap, threshold = (line.get_ydata() for line in panel.lines[:2])
            assert np.array_equal(overlap, model["overlap"]) and np.array_equal(threshold, model["threshold"])
        assert axes[8].lines[0].get_ydata().max() == -0.5

    def test_thresholds_are_those_of_the_models(self, runs):
        panels = draw("thresholds", runs["rigid"], runs["d0"]).axes
        for column, name in enumerate(("rigid", "d0")):
            for axes, model in zip(panels[column::2], read_run(runs[name]).adaptations, strict=False):
                drawn = {line.get_label(): line.get_ydata() for line in axes.lines}
                assert np.array_equal(drawn["threshold $T^N$"], model["tau"])
                assert np.array_equal(drawn["overlap $d^N$"], model["s"])

    def test_figure1_places_the_rigid_disc(self, runs):
        run = read_run(runs["rigid"])
        half_disc = figures.modules()["figure1"].half_disc
        assert half_disc(run, 0)[:, 1].min() == pytest.approx(20 + 0.5)
        outline = half_disc(run, 3)
        assert outline[:, 1].min() == pytest.approx(20 + 0.5 - 2.5)
        assert np.ptp(outline[:, 0]) == pytest.approx(20) and np.ptp(outline[:, 1]) == pytest.approx(10)

    def test_figure2_subtracts_on_the_same_points(self, runs):
        below = draw("figure2", runs["rigid"], runs["incremental"]).axes[1]
        shown = below.lines[0].get_ydata()
        assert 0 < np.nanmax(shown) < 1e-6 and below.get_title(loc="right") == ""

    def test_figure2_interpolates_on_other_points(self, runs, broken):
        folder = broken("incremental")
        path = folder / "contact.csv"
        head, *rows = path.read_text().splitlines()
        edit_summary(folder, points=len(rows[::2]))
        path.write_text("\n".join([head, *rows[::2], ""]))
        below = draw("figure2", runs["rigid"], folder).axes[1]
        assert 1e-4 < np.nanmax(below.lines[0].get_ydata()) < 0.1
        assert "interpolated" in below.get_title(loc="right")

    def test_figure2_refuses_another_problem(self, runs, broken):
        folder = broken("incremental")
        summary = read_run(folder).summary
        edit_summary(folder, parameters={**summary["parameters"], "kappa": 1e6})
        with pytest.raises(ResultsError, match=r"kappa = 1000, but 1000000.0 in .*: not the same problem"):
            draw("figure2", runs["rigid"], folder)

    def test_figure2_needs_contact(self, runs):
        with pytest.raises(ResultsError, match="only 0 points in contact, 5 are needed"):
            draw("figure2", runs["apart"], runs["apart"])

    def test_convergence_tells_what_did_not_converge(self, broken):
        folder = broken()
        edit_summary(folder, converged=False)
        (legend,) = draw("convergence", folder).legends
        assert "not converged" in legend.get_texts()[0].get_text()

    def test_runs_are_labelled_by_what_differs(self, runs, broken):
        folder = broken()
        edit_summary(folder, h=0.25, order=2)
        labels = style.labels([read_run(runs["rigid"]), read_run(folder), read_run(runs["d0"])])
        told = "0$, P1, $h = 0.5$", "0$, P2, $h = 0.25$", "d_0$, P1, $h = 0.5$"
        assert labels == [f"paper's scheme, $T^0 = {words}" for words in told]
        edit_summary(folder, h=0.5, order=1, scene="meshed-disc")
        assert style.labels([read_run(runs["rigid"]), read_run(folder)])[1].endswith("(broken)")

    NUMBERS = (0.25, 1000, 1e-6, 3.2e-9, 1e12, 0, -2.5e-5, 9.99e-7)
    TEXTS = r"0.25|1000|10^{-6}|3.2 \times 10^{-9}|10^{12}|0|-2.5 \times 10^{-5}|10^{-6}".split("|")

    @pytest.mark.parametrize(("value", "text"), zip(NUMBERS, TEXTS, strict=True))
    def test_numbers_in_labels(self, value, text):
        assert style.number(value) == text


class TestWriting:
    def test_nothing_is_left_when_drawing_to_a_file_fails(self, tmp_path, monkeypatch):
        figure = Figure()
        out = tmp_path / "f.pdf"
        out.write_bytes(b"old")
        save = figure.savefig

        def fail_on_png(path, **options):
            save(path, **options)
            if options["format"] == "png":
                raise OSError(28, "No space left on device", str(path))

        monkeypatch.setattr(figure, "savefig", fail_on_png)
        with pytest.raises(ResultsError, match="no space left on device"):
            output.write_figure(figure, out)
        assert [path.name for path in tmp_path.iterdir()] == ["f.pdf"] and out.read_bytes() == b"old"

    def test_a_refused_run_creates_no_folder(self, runs, tmp_path, capsys):
        out = tmp_path / "new" / "f.pdf"
        assert main(["figure", "figure1", "--out", str(out), str(runs["d0"])]) == 2
        assert not out.parent.exists()
        captured = capsys.readouterr()
        assert captured.out == "" and captured.err.count("\n") == 1
        assert captured.err.startswith(f"postprocess: {runs['d0'] / 'states.csv'}: no such file")

    @pytest.mark.parametrize("out", ["f.png", "f", "blocked/f.pdf"])
    def test_names_that_cannot_be_written(self, runs, tmp_path, capsys, out):
        (tmp_path / "blocked").write_text("a file, not a folder")
        assert main(["figure", "thresholds", "--out", str(tmp_path / out), str(runs["rigid"])]) == 2
        assert capsys.readouterr().err.startswith(f"postprocess: {tmp_path / out.split('/')[0]}")
        assert [path.name for path in tmp_path.iterdir()] == ["blocked"]


class TestCommandLine:
    @pytest.mark.parametrize(
        ("name", "folders", "words"),
        [("figure2", 1, "takes 2 run folder(s), 1 given"), ("thresholds", 4, "run folder(s), 4 given")],
    )
    def test_wrong_number_of_runs(self, runs, tmp_path, capsys, name, folders, words):
        assert main(["figure", name, "--out", str(tmp_path / "f.pdf"), *[str(runs["rigid"])] * folders]) == 2
        assert words in capsys.readouterr().err

    def test_as_a_process(self, tmp_path):
        command = [sys.executable, "-m", "postprocess", "show"]
        bad = subprocess.run([*command, tmp_path], cwd=ROOT, capture_output=True, text=True)
        assert bad.returncode == 2 and bad.stdout == ""
        assert bad.stderr == f"postprocess: {tmp_path}/summary.json: no such file\n"
