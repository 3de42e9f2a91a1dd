"""`postprocess state`, `stress`, `check`: any run is drawn, in the plane and in space; what cannot be is refused."""

import json
import re
import shutil
import sys
import types

import numpy as np
import pytest
from freefem import FREEFEM, ROOT, execute, run_in, script, short_of
from text_boxes import faults

from postprocess import bodies, space, style
from postprocess.__main__ import main
from postprocess.commands import check, state, stress
from postprocess.results import read_run
from postprocess.vtu import MOVE, read_arrays, read_names

RUNS = {
    "plane": ("disc-on-block", "-h", 2),
    "axis": ("disc-on-block", "-h", 1, "-geometry", "axisymmetric"),
    "two bodies": ("meshed-disc", "-h", 1),
    "several contacts": ("wavy", "-kappa", 1e6, "-h", 1),
    "space": ("two-spheres", "-h", 0.6, "-layers", 1),
}


@pytest.fixture(
    scope="module",
    params=[
        "plane",
        "space",
        *(pytest.param(name, marks=pytest.mark.long) for name in ("axis", "two bodies", "several contacts")),
    ],
)
def made(request, tmp_path_factory):
    """A run of a scene, with its files for ParaView."""
    scene, *flags = RUNS[request.param]
    return run_in(ROOT, script(scene), *flags, "-estimate", 0, out=tmp_path_factory.mktemp("pictures") / "run").folder


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    """A coarse roller between plates: a run, and a check of it."""
    folder = tmp_path_factory.mktemp("case")
    geo = (ROOT / "edp/examples/roller/roller.geo").read_text().replace("size = {0.06,", "size = {1,")
    (folder / "roller.geo").write_text(geo)
    command = [*FREEFEM, "edp/parts.edp", "-mesh", folder / "roller.geo", "-case", "edp/examples/roller/roller.case"]
    for flags in ([], ["-check", "1"]):
        code, stdout = execute([*command, "-out", folder / "run", *flags])
        assert code == 0, stdout[-2000:]
    assert f"-m postprocess check {folder}/run/check" in stdout
    return folder / "run"


def figure(command, folder, scale=1.0, slide=False):
    with style.look():
        run = read_run(folder)
        units = bodies.units_of(run, (style.Units.length, style.Units.stress))
        drawn = command.draw(bodies.read_bodies(run, scale), units, None, slide)
        drawn.canvas.draw()
    return drawn


@pytest.mark.long
@pytest.mark.parametrize("command", ["state", pytest.param("stress", marks=pytest.mark.long)])
def test_written(case, command, capsys):
    """A run shall be drawn into its own folder, as PDF and PNG, and the next run shall remove both."""
    assert main([command, str(case)]) == 0
    written = [case / f"{command}.{kind}" for kind in ("pdf", "png")]
    assert capsys.readouterr().out.split() == list(map(str, written))
    assert all(path.stat().st_size > 5000 for path in written)
    assert f"{command}.pdf" in (case / ".run/.written").read_text()


WAYS = [(state, False)]


@pytest.mark.parametrize(("command", "slide"), short_of(WAYS, [(state, True), (stress, False), (stress, True)]))
def test_any_run(made, command, slide):
    """A run of any scene shall be drawn, in a column or on a slide, with no text cut or on another one."""
    assert faults(figure(command, made, slide=slide)) == []


@pytest.mark.long
@pytest.mark.parametrize("slide", [False, pytest.param(True, marks=pytest.mark.long)])
def test_every_contact_from_near(case, slide):
    """Each contact of the roller shall have a panel with the scale of its pressure and where the arc length begins."""
    drawn = figure(stress, case, slide=slide)
    assert faults(drawn) == []
    panels = sorted(drawn.axes, key=lambda axes: axes.get_title(loc="left"))
    titles = [axes.get_title(loc="left").replace("\n", " ") for axes in panels]
    names = [contact["name"] for contact in read_run(case).summary["contacts"]]
    assert all(any(name in title and "arc length from" in title for title in titles[:2]) for name in names)
    for axes in panels[:2]:
        assert any("pressure" in text.get_text() and "MPa" in text.get_text() for text in axes.texts)
        (bar,) = axes.child_axes
        assert bar.get_ylabel() == "von Mises [MPa]"
    assert "true scale" in titles[2] and "from the middle" in panels[3].get_xlabel().replace("\n", " ")


def test_singular_places_are_marked(case, tmp_path):
    """Colours near contacts shall end at the greatest stress with a bound, and circles mark where there is none."""
    folder = tmp_path / "run"
    shutil.copytree(case, folder)
    told = json.loads((folder / "summary.json").read_text())
    told["stresses"] = [{"body": "roller", "vonMises": 100.0, "at": [0, 0], "singular": [0.0, 10.0]}]
    (folder / "summary.json").write_text(json.dumps(told))
    drawn = bodies.read_bodies(read_run(folder))
    assert bodies.stress_range(drawn) == 100
    np.testing.assert_allclose(bodies.singular_places(drawn)[:, :2], [[0, 10]], atol=0.2)
    (bar,) = figure(stress, folder).axes[0].child_axes
    assert "up to" in bar.get_ylabel()
    assert bodies.read_bodies(read_run(case), None).scale in (10, 20, 50)


def test_eye_sees_the_contact():
    """Without --view the eye shall be where a contact's surface can be seen, from above, below or aside."""
    for normal in ((0, 0, 1), (0, 0, -1), (1, 0, 0), (0, -1, 0), (1, 1, 0.3)):
        eye = space.sight(*space.onto(np.array(normal, float)))[2]
        assert eye @ normal > 0.3 * np.linalg.norm(normal)


def test_pressure_of_a_case(case):
    """Both contacts of the roller shall have a curve, with the pressures of contact.csv and units of the case file."""
    run = read_run(case)
    axes = figure(state, case).axes
    lines = [line for line in axes[-1].lines if not line.get_label().startswith("_")]
    assert [line.get_label() for line in lines] == [contact["name"] for contact in run.summary["contacts"]]
    for line, contact in zip(lines, run.summary["contacts"], strict=True):
        assert line.get_ydata().max() == contact["pressureMax"]
    assert len(run.summary["units"]) == 2


@pytest.mark.long
def test_pull_is_drawn(tmp_path):
    """Attraction shall be drawn as a pull: the curve goes down to the least pressure, on the axes."""
    adhesive = run_in(ROOT, script("adhesive-sphere"), "-order", 1, out=tmp_path / "run")
    least = adhesive.contact["pressure"].min()
    assert adhesive.force < 0 and least < 0
    axes = figure(state, adhesive.folder).axes[-1]
    assert min(np.min(line.get_ydata()) for line in axes.lines) == least > axes.get_ylim()[0]


@pytest.mark.long
def test_check(case, capsys):
    """What -check 1 has read shall be drawn: each boundary group of the case file with its role."""
    assert main(["check", str(case)]) == 0
    assert (case / "check/check.pdf").exists()
    with style.look():
        drawn = check.draw(case / "check", space.sight(*space.VIEW))
    words = [text.get_text() for text in drawn.legends[0].get_texts()]
    assert "base: clamp" in words and "grip: force" in words and "roller-top: slave of upper-face" in words


@pytest.mark.parametrize("command", ["state", "stress"])
def test_refusals(case, tmp_path, capsys, command):
    """A run without its files for ParaView, or with another run's, shall be refused in one line, nothing written."""
    folder = tmp_path / "run"
    shutil.copytree(case, folder)
    (folder / "contact.vtu").unlink()
    assert main([command, str(folder), "--out", str(tmp_path / "f.pdf")]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1 and "run the scene with -vtu 1" in error
    (folder / "contact.vtu").write_bytes((case / "solution.vtu").read_bytes())
    assert main([command, str(folder), "--out", str(tmp_path / "f.pdf")]) == 2
    assert main(["check", str(tmp_path)]) == 2
    assert "run the case with -check 1" in capsys.readouterr().err
    assert not list(tmp_path.glob("f.*"))


class Recorder:
    """Stands for anything of paraview.simple; keeps what is called."""

    def __init__(self, calls, name):
        self.__dict__.update(calls=calls, name=name)

    def __getattr__(self, name):
        return Recorder(self.calls, f"{self.name}.{name}")

    def __setattr__(self, name, value):
        self.calls.append((f"{self.name}.{name}", value))

    def __call__(self, *given, **named):
        self.calls.append((self.name, given, named))
        return Recorder(self.calls, self.name)


def opened_in_paraview(folder, monkeypatch, capsys):
    """Runs the state beside a module that only keeps what is called; the names of labels."""
    assert main(["paraview", str(folder)]) == 0
    assert capsys.readouterr().out == f"{folder / 'paraview.py'}\n"
    calls = []
    simple = types.ModuleType("paraview.simple")
    text = (folder / "paraview.py").read_text()
    used = set(re.findall(r"\b[A-Z][A-Za-z]+(?=\()", text))
    assert {"WarpByVector", "ColorBy", "Render"} <= used
    used |= {"XMLUnstructuredGridReader", "XMLPartitionedUnstructuredGridReader"}
    simple.__dict__.update({name: Recorder(calls, name) for name in used})
    monkeypatch.setitem(sys.modules, "paraview", types.ModuleType("paraview"))
    monkeypatch.setitem(sys.modules, "paraview.simple", simple)
    exec(compile(text, "state", "exec"), {})
    arrays = {name for file in folder.glob("*.vtu") for part, name in read_arrays(file) if part == "PointData"}
    opened = [call[2]["FileName"][0] for call in calls if call[0] == "XMLUnstructuredGridReader"]
    assert opened == [str(folder / "solution.vtu"), str(folder / "contact.vtu")]
    assert {call[1][1][1] for call in calls if call[0] == "ColorBy"} | {MOVE} <= arrays
    return next((call[1] for call in calls if call[0].endswith(".Annotations")), [])


def test_paraview_state(case, monkeypatch, capsys):
    """The state shall run, open files of the run, colour by arrays that they have, and name what Label counts."""
    labels = opened_in_paraview(case, monkeypatch, capsys)
    assert labels[1:6:2] == [body["name"] for body in read_run(case).summary["bodies"]]
    assert read_names(case / "solution.vtu")["units"] == read_run(case).summary["units"]
    grid, named = bodies.read_bodies(read_run(case)).grid, {int(label) for label in labels[::2]}
    assert set(grid.body.tolist()) <= named and set(grid.label.tolist()) - named == {max(named) + 1}
