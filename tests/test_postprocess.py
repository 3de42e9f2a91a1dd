"""postprocess/ on synthetic runs: readers, refusals, figures, command line.

The runs come from a Winkler bed: a block of independent vertical springs under the rigid disc of the paper. Every
method of the package is a few scalar lines there, so that counts, thresholds and residuals behave like real ones.
"""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from text_boxes import faults

from postprocess import figures, output, results, style
from postprocess.__main__ import main
from postprocess.results import ResultsError, read_run

ROOT = Path(__file__).resolve().parent.parent

WIDTH, DEPTH, RADIUS, GAP, PUSH = 40.0, 20.0, 10.0, 0.5, 2.5
KAPPA, POWER, D0, RHO, BED = 1000.0, 3.0, -0.25, 100.0, 15.0  # BED: pressure per settlement
TOLERANCE = 1e-8


def block_mesh():
    """Vertices (V, 2), triangles (M, 3) and the surface's vertices, left to right."""
    columns = np.concatenate([np.linspace(-20, -7, 8)[:-1], np.linspace(-7, 7, 29), np.linspace(7, 20, 8)[1:]])
    rows = DEPTH * (1 - np.linspace(1, 0, 9) ** 1.6)
    return grid_mesh(*np.meshgrid(columns, rows))


def disc_mesh():
    """The same for a half disc that hangs at the initial gap above the block."""
    radius, angle = np.meshgrid(np.linspace(RADIUS, 0.02 * RADIUS, 8), np.linspace(-np.pi, 0, 41), indexing="ij")
    vertices, triangles, _ = grid_mesh(radius * np.cos(angle), DEPTH + GAP + RADIUS + radius * np.sin(angle))
    return vertices, triangles


def grid_mesh(x, y):
    rows, columns = x.shape
    number = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    lower = np.stack([a, b, c], axis=-1).reshape(-1, 3)
    upper = np.stack([a, c, d], axis=-1).reshape(-1, 3)
    return np.column_stack([x.ravel(), y.ravel()]), np.concatenate([lower, upper]), number[-1]


def law(s, method):
    """Pressure and slope of the law at s = overlap - d0; hard contact has no law below its wall."""
    kappa = 0.0 if method == "signorini" else KAPPA
    s = np.maximum(s, 0)
    return kappa * s**POWER, kappa * POWER * s ** (POWER - 1)


def newton(method, free, threshold, overlap, carried):
    """Newton steps on one model: yields (overlap, carried, pressure, multiplier, status, changes, residual)."""
    at_wall = law(threshold - D0, method)[0] if np.isfinite(threshold).all() else 0 * free
    multiplier = np.where(overlap >= threshold, carried - at_wall, 0.0)
    for _ in range(200):
        wall = multiplier + RHO * np.nan_to_num(overlap - threshold, neginf=-1e9) > 0
        pressure, tangent = law(overlap - D0, method)
        overlap = np.where(wall, threshold, (BED * free - pressure + tangent * overlap) / (BED + tangent))
        carried = BED * (free - overlap)
        multiplier = np.where(wall, carried - at_wall, 0.0)
        now = multiplier + RHO * np.nan_to_num(overlap - threshold, neginf=-1e9) > 0
        pressure = np.where(wall, np.where(now, carried, 0.0), law(overlap - D0, method)[0])
        status = np.where(now, 2, np.where(pressure > 0, 1, 0))
        changes = np.count_nonzero(now != wall)
        scale = max(np.linalg.norm(carried), np.linalg.norm(pressure), 1e-3)
        residual = np.linalg.norm(carried - pressure) / scale
        yield overlap, carried, pressure, multiplier, status, changes, residual
        if residual < TOLERANCE and changes == 0:
            return


def winkler(method, x, first, steps, push):
    """The rows of a run's tables, the bed's settlement after every Newton step, and the model error."""
    weight = np.gradient(x)
    drop = np.where(np.abs(x) < 0.99 * RADIUS, RADIUS - np.sqrt(np.maximum(RADIUS**2 - x**2, 0)), 1e3)
    overlap, carried = -GAP - drop, np.zeros(len(x))
    history, models, settlements, error = [], [], [carried], 0.0
    for step in range(1, steps + 1):
        free = push * step / steps - GAP - drop
        threshold = np.full(len(x), {"paper": first, "signorini": D0}.get(method, np.inf))
        for adaptation in range(1, 20):
            for iteration, state in enumerate(newton(method, free, threshold, overlap, carried), 1):
                overlap, carried, pressure, multiplier, status, changes, residual = state
                count = len(history) + 1
                settlements.append(carried / BED)
                row = (step, adaptation, iteration, count, residual, np.sum(pressure > 0), changes)
                row += (np.sum(status == 2), overlap.max(), weight @ pressure, count, count, 0.01 * count)
                history.append(row)
            models.append((x, 0 * x + DEPTH, overlap, pressure, multiplier, status, threshold))
            models[-1] += (overlap - D0, threshold - D0)
            wall = status == 2
            if method != "paper" or not wall.any():
                break
            moved = np.where(wall, np.maximum(threshold, D0 + (pressure / KAPPA) ** (1 / POWER)), threshold)
            error = np.max((moved - threshold)[wall] / (moved - D0)[wall])
            threshold = moved
    contact = np.column_stack([x, 0 * x + DEPTH, weight, *models[-1][2:]])
    adaptations = [np.column_stack([np.full(len(x), n), *model]) for n, model in enumerate(models, 1)]
    return np.array(history, float), contact, np.concatenate(adaptations), settlements, error


def write_table(path, columns, rows):
    """A CSV file as the scenes write it: names, then numbers, each line with its end."""
    lines = [",".join(format(value, ".17g") for value in row) for row in rows]
    path.write_text("\n".join([",".join(columns), *lines, ""]))


def make_run(folder, method="paper", first=0.0, steps=1, meshed=False, states=True, push=PUSH):
    """Writes a run folder as a scene would and returns its path."""
    folder.mkdir(parents=True)
    vertices, triangles, surface = block_mesh()
    history, contact, adaptations, settlements, error = winkler(method, vertices[surface, 0], first, steps, push)
    write_table(folder / "history.csv", results.HISTORY, history)
    write_table(folder / "contact.csv", results.CONTACT, contact)
    write_table(folder / "adaptations.csv", results.ADAPTATIONS, adaptations)
    if states:
        write_states(folder, vertices, triangles, history, settlements, meshed, push)
    last = dict(zip(results.HISTORY, history[-1].tolist(), strict=True))
    x, pressure = contact[:, 0], contact[:, 4]
    summary = {
        "scene": "meshed-disc" if meshed else "disc-on-block",
        "method": method,
        "converged": True,
        "adaptations": int(history[:, 1].max()),
        "newton": len(history),
        "newtonPerAdaptation": [int(n) for n in np.unique(history[:, :2], axis=0, return_counts=True)[1]],
        "factorisations": len(history),
        "backsolves": len(history),
        "force": last["force"],
        "pressureMax": pressure.max(),
        "overlapMax": last["overlapMax"],
        "halfWidth": np.abs(x[pressure > 0]).max() if pressure.any() else None,
        "wallPoints": int(last["wallPoints"]),
        "contactPoints": int(last["contactPoints"]),
        "modelError": error,
        "residual": last["residual"],
        "energy": 12.5,
        "ndof": 2 * len(vertices),
        "points": len(contact),
        "order": 1,
        "h": 0.5,
        "seconds": {"mesh": 0.02, "assembly": 0.01, "factorisation": 0.04, "contact": 0.1, "total": 0.2},
        "parameters": {
            **{"E": 100, "nu": 0.3, "width": WIDTH, "depth": DEPTH, "R": RADIUS, "gap": GAP, "u0": push},
            **{"kappa": KAPPA, "m": POWER, "d0": D0, "rho": RHO, "T0": first, "eps": 1e-4, "tol": TOLERANCE},
            "steps": steps,
        },
    }
    (folder / "summary.json").write_text(json.dumps(summary, indent=2) + "\n")
    return folder


def write_states(folder, vertices, triangles, history, settlements, meshed, push):
    """triangles.csv and states.csv: the block's columns shorten evenly, a meshed disc moves down whole."""
    region = np.ones(len(triangles))
    points, moves = vertices, []
    for settlement in settlements:
        surface = np.interp(vertices[:, 0], np.unique(vertices[:, 0]), settlement)
        moves.append(-surface * vertices[:, 1] / DEPTH)
    if meshed:
        disc, disc_triangles = disc_mesh()
        triangles = np.concatenate([triangles, disc_triangles + len(vertices)])
        region = np.concatenate([region, np.full(len(disc_triangles), 2)])
        points = np.concatenate([vertices, disc])
        moves = [np.append(move, np.full(len(disc), -push if state else 0.0)) for state, move in enumerate(moves)]
        moves.insert(1, np.append(0 * vertices[:, 1], np.full(len(disc), -push)))
    write_table(folder / "triangles.csv", results.TRIANGLES, np.column_stack([triangles, region]))
    steps = np.concatenate([np.zeros((len(moves) - len(history), 2)), history[:, [1, 3]]])
    number = np.arange(len(points))
    blocks = [
        np.column_stack([np.tile([state, *steps[state]], (len(number), 1)), number, points, 0 * number, move])
        for state, move in enumerate(moves)
    ]
    write_table(folder / "states.csv", results.STATES, np.concatenate(blocks))


@pytest.fixture(scope="session")
def runs(tmp_path_factory):
    """Run folders by name: the methods, and a run without contact."""
    base = tmp_path_factory.mktemp("runs")
    return {
        "meshed": make_run(base / "meshed", meshed=True),
        "rigid": make_run(base / "rigid"),
        "d0": make_run(base / "d0", first=D0, states=False),
        "newton": make_run(base / "newton", "newton", states=False),
        "incremental": make_run(base / "incremental", "incremental", steps=4, states=False),
        "apart": make_run(base / "apart", push=0.2),
    }


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
        assert len(run.adaptations) == run.summary["adaptations"] == 2
        assert run.adaptations[1]["threshold"].shape == (run.summary["points"],)
        states = run.states
        assert states.ux.shape == states.uy.shape == (run.summary["newton"] + 2, len(states.x))
        assert states.newton[:3].tolist() == [0, 0, 1] and states.newton[-1] == run.summary["newton"]
        assert run.mesh.triangles.max() == len(states.x) - 1 and set(run.mesh.region) == {1, 2}
        assert run.parameter("d0") == D0

    def test_values_survive_the_file(self, runs):
        force = read_run(runs["rigid"]).contact
        assert force["weight"] @ force["pressure"] == pytest.approx(read_run(runs["rigid"]).summary["force"], rel=1e-14)

    def test_methods_agree_on_the_bed(self, runs):
        forces = [read_run(runs[name]).summary["force"] for name in ("rigid", "d0", "newton", "incremental")]
        assert np.ptp(forces) < 1e-8 * forces[0]

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

    def test_files_are_read_on_first_use_only(self, broken):
        folder = broken()
        for path in folder.glob("*.csv"):
            path.unlink()
        assert read_run(folder).summary["newton"] > 0

    def test_a_run_without_newton_steps(self, broken):
        folder = broken("newton")
        edit_summary(folder, newton=0)
        (folder / "history.csv").write_text(",".join(results.HISTORY) + "\n")
        assert all(len(column) == 0 for column in read_run(folder).history.values())

    def test_windows_line_ends(self, broken):
        folder = broken()
        path = folder / "history.csv"
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
        assert len(read_run(folder).history["newton"]) == read_run(folder).summary["newton"]


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
        [
            ("converged", 1),
            ("newton", -3),
            ("newton", 2.5),
            ("force", "large"),
            ("parameters", []),
            ("newtonPerAdaptation", 12),
            ("method", None),
            ("points", True),
            ("h", [0.5]),
        ],
    )
    def test_summary_values_of_the_wrong_kind(self, broken, key, value):
        folder = broken()
        edit_summary(folder, **{key: value})
        assert f"key {key} is not" in refusal(folder)

    def test_a_huge_summary_number_is_refused(self, broken):
        folder = broken()
        path = folder / "summary.json"
        path.write_text(re.sub(r'"force": [^,]*', '"force": 1e999', path.read_text()))
        assert "key force is not a number" in refusal(folder)

    @pytest.mark.parametrize("name", ["history", "contact", "adaptations", "triangles", "states"])
    @pytest.mark.parametrize(
        ("spoil", "words"),
        [
            (lambda data: None, "no such file"),
            (lambda data: b"", "is empty"),
            (lambda data: data[:-1], "is truncated: the last line has no end"),
            (lambda data: data[: len(data) // 2].rpartition(b"\n")[0] + b"\n", ""),
            (lambda data: bytes(range(256)) * 8, "is binary"),
            (lambda data: b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR" + data, "is binary"),
            (lambda data: b"time;price\n1;2\n", "wrong columns"),
            (lambda data: data.replace(b",", b";"), "wrong columns"),
            (lambda data: data.replace(b"\n", b",1,2\n").replace(b",1,2", b"", 1), "values in a row"),
            (lambda data: data.replace(b"\n", b",1\n", 4).replace(b",1\n", b"\n", 1), "unreadable row"),
            (lambda data: data + b"<html>\n", "unreadable row"),
            (lambda data: data.rstrip(b"\n").rpartition(b",")[0] + b",nan\n", "has the value nan in line"),
            (lambda data: data.rstrip(b"\n").rpartition(b",")[0] + b",-inf\n", "has the value -inf in line"),
            (lambda data: data.partition(b"\n")[0] + b"\n", ""),
            (lambda data: data.partition(b"\n")[2], "wrong columns"),
            (lambda data: data.partition(b"\n")[0] + b"\n\xff\xfe\xfd\n", "unreadable row"),
            (lambda data: data.partition(b"\n")[0] + b"\n" + b"x" * 100000 + b"\n", "unreadable row"),
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

    @pytest.mark.parametrize("name", ["history", "contact", "adaptations", "states"])
    def test_a_last_line_that_is_missing(self, broken, name):
        folder = broken()
        path = folder / f"{name}.csv"
        path.write_text("".join(path.read_text().splitlines(keepends=True)[:-1]))
        assert refusal(folder, name).startswith(f"{path}: ")

    def test_a_name_given_twice(self, broken):
        folder = broken()
        path = folder / "contact.csv"
        path.write_text(path.read_text().replace("x,y,weight", "x,y,weight,weight", 1))
        assert "appears twice" in refusal(folder, "contact")

    def test_only_thresholds_may_be_infinite(self, broken):
        folder = broken()
        path = folder / "contact.csv"
        head, first, *rest = path.read_text().splitlines()
        path.write_text("\n".join([head, "inf" + first[first.index(",") :], *rest, ""]))
        assert "column x has the value inf in line 2" in refusal(folder, "contact")

    def test_unknown_status(self, broken):
        folder = broken()
        path = folder / "contact.csv"
        path.write_text(re.sub(r",[012](,[^,]+,[^,]+,[^,]+)\n$", r",3\1\n", path.read_text()))
        assert "column status has 3" in refusal(folder, "contact")

    def test_fraction_where_a_count_belongs(self, broken):
        folder = broken()
        path = folder / "history.csv"
        path.write_text(path.read_text().replace("\n1,1,1,1,", "\n1,1,1.5,1,", 1))
        assert "column iteration has 1.5 in line 2" in refusal(folder, "history")

    def test_steps_in_disorder(self, broken):
        folder = broken()
        path = folder / "history.csv"
        head, first, second, *rest = path.read_text().splitlines(keepends=True)
        path.write_text("".join([head, second, first, *rest]))
        assert "does not count 1, 2, 3" in refusal(folder, "history")

    def test_tables_of_another_run(self, broken, runs):
        folder = broken()
        shutil.copy(runs["d0"] / "history.csv", folder)
        assert "or of another run" in refusal(folder, "history")

    def test_mesh_of_another_run(self, broken, runs):
        folder = broken()
        shutil.copy(runs["meshed"] / "triangles.csv", folder)
        assert "vertex index outside" in refusal(folder, "mesh")

    def test_states_are_asked_for_by_their_flag(self, runs):
        assert refusal(runs["d0"], "states").endswith("states.csv: no such file; run the scene with -states 1")

    def test_a_folder_in_place_of_a_file(self, broken):
        folder = broken()
        (folder / "contact.csv").unlink()
        (folder / "contact.csv").mkdir()
        assert refusal(folder, "contact").endswith("is not a file")

    def test_a_pipe_in_place_of_a_file(self, broken):
        folder = broken()
        (folder / "contact.csv").unlink()
        os.mkfifo(folder / "contact.csv")
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


def entries(legend):
    return legend.get_texts(), legend.get_lines()


def draw(name, *folders):
    with style.look():
        return figures.modules()[name].draw([read_run(folder) for folder in folders], style.Units())


class TestFigures:
    def test_every_figure_is_tested(self):
        of_runs = {name for name, module in figures.modules().items() if not hasattr(module, "READ")}
        drawn_from_real_runs = {"hertz", "series"}  # test_hertz_figures.py
        drawn_from_real_runs |= {"sphere", "patch", "punch", "waves", "rigid", "hertz_error"}  # test_scene_figures.py
        drawn_from_real_runs |= {"equilibrium", "overshoot", "cost"}  # test_labs.py
        drawn_from_real_runs |= {"attraction", "attraction_profiles"}  # test_adhesion.py
        assert of_runs - drawn_from_real_runs == FIGURES  # those of campaigns: test_campaign.py

    def test_written_as_pdf_and_png(self, runs, tmp_path, capsys):
        out = tmp_path / "new" / "folder" / "convergence.pdf"
        names = ("rigid", "d0", "newton", "incremental")
        assert main(["figure", "convergence", "--out", str(out), *(str(runs[run]) for run in names)]) == 0
        assert capsys.readouterr().out.split() == [str(out), str(out.with_suffix(".png"))]
        assert sorted(path.name for path in out.parent.iterdir()) == ["convergence.pdf", "convergence.png"]
        assert out.read_bytes().startswith(b"%PDF-") and out.stat().st_size > 5000
        width, height = struct.unpack(">II", out.with_suffix(".png").read_bytes()[16:24])
        assert width == pytest.approx(style.COLUMN * style.DPI, abs=1) and 0.4 < height / width < 1.5

    @pytest.mark.long
    @pytest.mark.parametrize("name", ["figure1", "thresholds"])
    def test_the_same_bytes_again(self, runs, tmp_path, name):
        for folder in ("one", "two"):
            assert main(["figure", name, "--out", str(tmp_path / folder / "f.pdf"), str(runs["rigid"])]) == 0
        for kind in ("pdf", "png"):
            assert (tmp_path / "one" / f"f.{kind}").read_bytes() == (tmp_path / "two" / f"f.{kind}").read_bytes()
        assert not re.search(rb"CreationDate|ModDate", (tmp_path / "one" / "f.pdf").read_bytes())

    def test_the_users_own_style_is_left_alone(self, runs):
        import matplotlib as mpl

        before = dict(mpl.rcParams)
        with mpl.rc_context({"font.size": 30}):
            label = draw("thresholds", runs["rigid"]).axes[0].yaxis.label
            assert label.get_fontsize() == style.RC["axes.labelsize"]
            assert mpl.rcParams["font.size"] == 30
        assert dict(mpl.rcParams) == before

    def test_figure1_names_the_states_of_the_scheme(self, runs):
        figure = draw("figure1", runs["meshed"])
        assert faults(figure) == [] and figure.get_figwidth() == style.PAGE
        axes = figure.axes
        first, second = read_run(runs["meshed"]).summary["newtonPerAdaptation"]
        assert [each.get_title(loc="left") for each in axes[:4]] == [
            "(a) initial state\nundeformed",
            "(b) prescribed motion\nbefore Newton step 1",
            f"(c) first model solved\nadaptation 1, Newton step {first}",
            f"(d) converged\nadaptation 2, Newton step {first + second}",
        ]
        assert [each.get_title() for each in axes[4:6]] == ["gap 0.5", "greatest overlap 2"]
        assert all(each.get_aspect() == 1 for each in axes[:8])
        table = read_run(runs["meshed"]).adaptations
        for panel, model in ((axes[10], table[0]), (axes[11], table[-1])):
            overlap, threshold = (line.get_ydata() for line in panel.lines[:2])
            assert np.array_equal(overlap, model["overlap"]) and np.array_equal(threshold, model["threshold"])
        assert axes[8].lines[0].get_ydata().max() == -0.5 and axes[9].lines[0].get_ydata().max() == 2

    def test_figure1_without_a_state_of_the_motion_alone(self, runs):
        axes = draw("figure1", runs["rigid"]).axes
        assert axes[1].get_title(loc="left") == "(b) first linear step\nadaptation 1, Newton step 1"

    def test_figure1_places_the_rigid_disc(self, runs):
        run = read_run(runs["rigid"])
        half_disc = figures.modules()["figure1"].half_disc
        assert half_disc(run, 0)[:, 1].min() == pytest.approx(DEPTH + GAP)
        outline = half_disc(run, 3)
        assert outline[:, 1].min() == pytest.approx(DEPTH + GAP - PUSH)
        assert np.ptp(outline[:, 0]) == pytest.approx(2 * RADIUS) and np.ptp(outline[:, 1]) == pytest.approx(RADIUS)

    def test_figure1_envelopes(self):
        module = figures.modules()["figure1"]
        x, y = np.array([0.0, 2.0, 2.0, 0.0]), np.array([0.0, 0.0, 1.0, 2.0])
        edges = module.boundary(np.array([[0, 1, 2], [0, 2, 3]]))
        assert edges.tolist() == [[0, 1], [0, 3], [1, 2], [2, 3]]
        at = np.array([-1.0, 0.5, 1.0, 3.0])
        assert module.envelope(at, x, y, edges, np.fmax) == pytest.approx([np.nan, 1.75, 1.5, np.nan], nan_ok=True)
        assert module.envelope(at, x, y, edges, np.fmin) == pytest.approx([np.nan, 0, 0, np.nan], nan_ok=True)

    def test_figure1_of_a_run_without_contact(self, runs):
        axes = draw("figure1", runs["apart"]).axes
        assert "gap 0.3" in [each.get_title() for each in axes]

    def test_figure2_subtracts_on_the_same_points(self, runs):
        below = draw("figure2", runs["rigid"], runs["incremental"]).axes[1]
        shown = below.lines[0].get_ydata()
        assert 0 < np.nanmax(shown) < 1e-7 and below.get_title(loc="right") == ""

    def test_figure2_interpolates_on_other_points(self, runs, broken):
        folder = broken("incremental")
        path = folder / "contact.csv"
        head, *rows = path.read_text().splitlines()
        edit_summary(folder, points=len(rows[::2]))
        path.write_text("\n".join([head, *rows[::2], ""]))
        below = draw("figure2", runs["rigid"], folder).axes[1]
        assert 1e-4 < np.nanmax(below.lines[0].get_ydata()) < 0.05
        assert "interpolated" in below.get_title(loc="right")

    def test_figure2_of_a_run_with_itself(self, runs):
        figure = draw("figure2", runs["rigid"], runs["rigid"])
        assert [text.get_text() for text in figure.axes[1].texts] == ["no difference"]

    def test_figure2_names_the_counts(self, runs):
        figure = draw("figure2", runs["rigid"], runs["incremental"])
        assert faults(figure) == [] and figure.get_figwidth() == style.COLUMN
        (legend,) = figure.legends
        texts = [text.get_text() for text in legend.get_texts()]
        few, many = (read_run(runs[name]).summary["newton"] for name in ("rigid", "incremental"))
        assert texts == [
            f"paper's scheme, $T^0 = 0$: 2 adaptations, {few} Newton steps",
            f"Newton, 4 load steps: {many} Newton steps",
        ]

    def test_figure2_breaks_long_legends(self, runs, broken):
        folder = broken("incremental")
        edit_summary(folder, h=0.25, order=2)
        (legend,) = draw("figure2", runs["rigid"], folder).legends
        assert legend.get_texts()[0].get_text().startswith("paper's scheme, $T^0 = 0$, P1, $h = 0.5$:\n")

    def test_figure2_refuses_another_problem(self, runs, broken):
        folder = broken("incremental")
        summary = read_run(folder).summary
        edit_summary(folder, parameters={**summary["parameters"], "kappa": 1e6})
        with pytest.raises(ResultsError, match=r"kappa = 1000.0, but 1000000.0 in .*: not the same problem"):
            draw("figure2", runs["rigid"], folder)

    def test_figure2_needs_contact(self, runs):
        with pytest.raises(ResultsError, match="only 0 points in contact, 5 are needed"):
            draw("figure2", runs["apart"], runs["apart"])

    def test_convergence_marks_models_and_tolerance(self, runs):
        figure = draw("convergence", runs["rigid"])
        assert [text.get_text() for text in figure.axes[0].texts] == ["$T^{0}$", "$T^{1}$"]
        texts = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
        steps = read_run(runs["rigid"]).summary["newton"]
        assert texts == [f"paper's scheme, $T^0 = 0$: 2 adaptations, {steps} steps", "tolerance $10^{-8}$"]

    def test_convergence_tells_what_did_not_converge(self, broken):
        folder = broken()
        edit_summary(folder, converged=False)
        (axes,) = draw("convergence", folder).axes
        assert "not converged" in axes.get_legend().get_texts()[0].get_text()

    def test_thresholds_of_a_method_without_wall(self, runs):
        (axes,) = draw("thresholds", runs["newton"]).axes
        assert "no wall" in axes.get_title()

    def test_thresholds_of_two_runs_side_by_side(self, runs):
        figure = draw("thresholds", runs["rigid"], runs["d0"])
        assert faults(figure) == [] and figure.get_figwidth() == style.COLUMN
        models = [read_run(runs[name]).adaptations for name in ("rigid", "d0")]
        panels = np.array(figure.axes).reshape(-1, 2).T
        for column, tables in zip(panels, models, strict=True):
            for axes, table in zip(column, tables, strict=False):
                drawn = {line.get_label(): line for line in axes.lines}
                assert np.array_equal(drawn["threshold $T^N$"].get_ydata(), table["tau"])
                assert np.array_equal(drawn["overlap $d^N$"].get_ydata(), table["s"])
        colours = {text.get_text(): line.get_color() for text, line in zip(*entries(figure.legends[0]), strict=True)}
        assert colours["threshold $T^N$"] == drawn["threshold $T^N$"].get_color() != colours["overlap $d^N$"]

    def test_texts_on_each_other_are_found(self, runs):
        figure = draw("thresholds", runs["rigid"])
        assert faults(figure) == []
        figure.axes[0].annotate("here", (0.5, 1.02), xycoords="axes fraction", ha="center")
        assert [fault for fault in faults(figure) if "'here'" in fault]

    def test_thresholds_far_from_the_overlap_are_logarithmic(self, broken):
        folder = broken()
        summary = read_run(folder).summary
        for name in ("contact.csv", "adaptations.csv"):
            path = folder / name
            head, *rows = path.read_text().splitlines()
            cells = [row.split(",") for row in rows]
            text = [",".join([*row[:-1], repr(1e3 + float(row[-1]))]) for row in cells]
            path.write_text("\n".join([head, *text, ""]))
        assert draw("thresholds", folder).axes[0].get_yscale() == "log"
        assert summary["overlapMax"] < 1

    def test_runs_are_labelled_by_what_differs(self, runs, broken):
        folder = broken()
        edit_summary(folder, h=0.25, order=2)
        labels = style.labels([read_run(runs["rigid"]), read_run(folder), read_run(runs["d0"])])
        assert labels == [
            "paper's scheme, $T^0 = 0$, P1, $h = 0.5$",
            "paper's scheme, $T^0 = 0$, P2, $h = 0.25$",
            "paper's scheme, $T^0 = d_0$, P1, $h = 0.5$",
        ]
        assert style.labels([read_run(runs["rigid"]), read_run(runs["meshed"])])[1].endswith("(meshed)")

    @pytest.mark.parametrize(
        ("value", "text"),
        [
            (0.25, "0.25"),
            (1000, "1000"),
            (1e-6, "10^{-6}"),
            (3.2e-9, r"3.2 \times 10^{-9}"),
            (1e12, "10^{12}"),
            (0, "0"),
            (-2.5e-5, r"-2.5 \times 10^{-5}"),
            (9.99e-7, "10^{-6}"),
        ],
    )
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

    def test_nothing_is_left_by_an_interrupt(self, tmp_path, monkeypatch):
        monkeypatch.setattr(output.os, "replace", lambda *paths: (_ for _ in ()).throw(KeyboardInterrupt))
        with pytest.raises(KeyboardInterrupt):
            output.write_figure(Figure(), tmp_path / "f.pdf")
        assert not list(tmp_path.iterdir())

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
    def test_help_lists_every_subcommand(self, capsys):
        with pytest.raises(SystemExit) as caught:
            main(["--help"])
        assert caught.value.code == 0
        assert {"figure", "show"} <= set(capsys.readouterr().out.split())

    def test_help_lists_every_figure(self, capsys):
        with pytest.raises(SystemExit):
            main(["figure", "--help"])
        assert set(capsys.readouterr().out.split()) >= FIGURES

    @pytest.mark.parametrize(
        ("name", "folders", "words"),
        [("figure2", 1, "takes 2 run folder(s), 1 given"), ("thresholds", 4, "run folder(s), 4 given")],
    )
    def test_wrong_number_of_runs(self, runs, tmp_path, capsys, name, folders, words):
        assert main(["figure", name, "--out", str(tmp_path / "f.pdf"), *[str(runs["rigid"])] * folders]) == 2
        assert words in capsys.readouterr().err

    def test_units_appear_in_the_labels(self, runs):
        with style.look():
            figure = figures.modules()["figure2"].draw(
                [read_run(runs["rigid"]), read_run(runs["newton"])], style.Units("mm", "MPa")
            )
        assert figure.axes[0].get_ylabel().endswith("[MPa]") and figure.axes[1].get_xlabel() == "$x$ [mm]"

    def test_show_prints_an_aligned_table(self, runs, capsys):
        assert main(["show", str(runs["apart"])]) == 0
        lines = capsys.readouterr().out.splitlines()
        column = lines[0].index("disc-on-block")
        assert all(line[column - 1] == " " and line[column] != " " for line in lines if line)
        rows = {line.split()[-2]: line.split()[-1] for line in lines if line}
        assert rows["converged"] == "yes" and rows["halfWidth"] == "-" and rows["force"] == "0"
        assert set(read_run(runs["apart"]).summary["parameters"]) <= set(rows)

    def test_as_a_process(self, tmp_path):
        command = [sys.executable, "-m", "postprocess", "show"]
        bad = subprocess.run([*command, tmp_path], cwd=ROOT, capture_output=True, text=True)
        assert bad.returncode == 2 and bad.stdout == ""
        assert bad.stderr == f"postprocess: {tmp_path}/summary.json: no such file\n"
