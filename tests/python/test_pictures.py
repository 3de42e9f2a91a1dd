"""`postprocess state`, `stress`, `check`: any run is drawn, in the plane and in space; what cannot be is refused."""

import json
import re
import shutil
import sys
import types
from dataclasses import replace

import numpy as np
import pytest
from freefem import FREEFEM, ROOT, cases_of, execute, run_in, script
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from text_boxes import faults

from postprocess import bodies, bodies_3d, style
from postprocess.command_line import main
from postprocess.commands import check, state, stress
from postprocess.results import read_run
from postprocess.vtu import MOVE, Grid, Surface, read_arrays, read_names

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
        *(name for name in ("axis", "two bodies", "several contacts")),
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


@pytest.mark.parametrize("command", ["state", "stress"])
def test_written(case, command, capsys):
    """A run shall be drawn into its own folder, as PDF and PNG, and the next run shall remove both."""
    assert main([command, str(case)]) == 0
    written = [case / f"{command}.{kind}" for kind in ("pdf", "png")]
    assert capsys.readouterr().out.split() == list(map(str, written))
    assert all(path.stat().st_size > 5000 for path in written)
    assert f"{command}.pdf" in (case / ".run/.written").read_text()


WAYS = [(state, False)]


@pytest.mark.parametrize(("command", "slide"), cases_of(WAYS, [(state, True), (stress, False), (stress, True)]))
def test_any_run(made, command, slide):
    """A run of any scene shall be drawn, in a column or on a slide, with no text cut or on another one."""
    assert faults(figure(command, made, slide=slide)) == []


@pytest.mark.parametrize("slide", [False, True])
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
    np.testing.assert_allclose(bodies.singular_points(drawn)[:, :2], [[0, 10]], atol=0.2)
    (bar,) = figure(stress, folder).axes[0].child_axes
    assert "up to" in bar.get_ylabel()
    assert bodies.read_bodies(read_run(case), None).scale in (10, 20, 50)


def test_eye_sees_the_contact():
    """Without --view the eye shall be where a contact's surface can be seen, from above, below or aside."""
    for normal in ((0, 0, 1), (0, 0, -1), (1, 0, 0), (0, -1, 0), (1, 1, 0.3)):
        eye = bodies_3d.view_matrix(*bodies_3d.view_angles(np.array(normal, float)))[2]
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


def test_pull_is_drawn(tmp_path):
    """Attraction shall be drawn as a pull: the curve goes down to the least pressure, on the axes."""
    adhesive = run_in(ROOT, script("adhesive-sphere"), "-order", 1, out=tmp_path / "run")
    least = adhesive.contact["pressure"].min()
    assert adhesive.force < 0 and least < 0
    axes = figure(state, adhesive.folder).axes[-1]
    assert min(np.min(line.get_ydata()) for line in axes.lines) == least > axes.get_ylim()[0]


def test_check(case, capsys):
    """What -check 1 has read shall be drawn: each boundary group of the case file with its role."""
    assert main(["check", str(case)]) == 0
    assert (case / "check/check.pdf").exists()
    with style.look():
        drawn = check.draw(case / "check", bodies_3d.view_matrix(*bodies_3d.VIEW))
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
    other = folder.parent / "other.py"
    assert main(["paraview", str(folder), "--out", str(other)]) == 0
    assert capsys.readouterr().out == f"{other}\n" and other.read_text() == (folder / "paraview.py").read_text()
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


# ---------------------------------------------------------------- surfaces made here: a shaft, lines in the plane


def shaft(pressed, turn=0.0):
    """A shaft along y of radius 1 whose whole side is the slave; the pressure pressed(angle from the top, y)."""
    ends, rounds = np.linspace(0, 4, 17), np.radians(np.arange(0, 360, 5))
    y, angle = (each.ravel() for each in np.meshgrid(ends, rounds))
    out = np.column_stack([np.sin(angle + turn), 0 * angle, np.cos(angle + turn)])
    number = np.arange(len(y)).reshape(len(rounds), len(ends))
    a, b = number, np.roll(number, -1, axis=0)
    cells = np.concatenate([[a[:, :-1], a[:, 1:], b[:, :-1]], [b[:, :-1], a[:, 1:], b[:, 1:]]], axis=1)
    cells = cells.reshape(3, -1).T
    pressure = pressed(np.minimum(angle, 2 * np.pi - angle), y)
    table = {"pressure": pressure, "weight": np.full(len(y), 0.1), "contact": np.zeros(len(y), int)}
    table |= dict(zip(("normalX", "normalY", "normalZ"), out.T, strict=True))
    surface = Surface(out + [0, 1, 0] * y[:, None], 0 * out, cells, np.zeros(len(cells), int), pressure, 0 * pressure)
    run = types.SimpleNamespace(summary={}, path=None)
    return bodies.Bodies(run, None, surface, table, ["side plate"], [False], 1.0)


@pytest.mark.parametrize("turn", [0, 135, 180, 250])
def test_the_far_side_of_a_shaft_is_not_drawn_on_its_contact(turn):
    """The map of a band of pressure shall show it from end to end, wherever on the shaft the band is."""
    drawn = shaft(lambda angle, y: np.maximum(0, 1 - (angle / 0.3) ** 2), np.radians(turn))
    axes = Figure(figsize=(2, 2), dpi=100).add_axes((0, 0, 1, 1))
    bodies_3d.draw_pressure_map(axes, drawn, 0, style.Units())
    canvas = FigureCanvasAgg(axes.figure)
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())[..., :3]
    view = bodies_3d.surface_axes(bodies_3d.contact_forces(drawn, 0)[1])
    middle = view @ [np.sin(np.radians(turn)), 0, np.cos(np.radians(turn))]
    for y in np.linspace(0.2, 3.8, 30):
        right, up = axes.transData.transform((middle + y * view[:, 1])[:2]).round().astype(int)
        red, green, _ = pixels[len(pixels) - 1 - up, right].astype(int)
        assert red < 200 and green < 60, (y, pixels[len(pixels) - 1 - up, right])
    words = bodies_3d.map_caption(drawn, 0)
    assert ("along" in words) is (turn in (135, 250)) and "other side" not in words


def test_names_of_a_map_s_axes():
    """Axes of a map are coordinates or letters of directions, which are said; to the right and upwards they grow."""
    for normal, names in (((0, 0, -1), "xyz"), ((0, 1, 0), "xzy"), ((-1, 0, 0), "yzx"), ((-0.7, 0, -0.7), "syn")):
        view = bodies_3d.surface_axes(np.array(normal, float))
        assert "".join(bodies_3d.axis_name(view, k)[1] for k in range(3)) == names
        np.testing.assert_allclose(view @ view.T, np.eye(3), atol=1e-12)
        assert all(row[np.abs(row).argmax()] > 0 for row in view) or names == "syn"
    assert (
        bodies_3d.axis_directions_caption(view, 0, 1, 2)
        == "; $s$ along (0.71,\u00a00,\u00a0\u22120.71); $n$ along (0.71,\u00a00,\u00a00.71)"
    )


def test_pressure_all_around_a_shaft():
    """Half of the force of a ring is on the side that its map does not show, which is said; no noise turns the map."""
    noise = np.random.default_rng(1)
    for _ in range(4):
        drawn = shaft(lambda angle, y: 1 + 1e-9 * noise.random(len(y)))
        assert np.array_equal(
            np.argmax(np.abs(bodies_3d.surface_axes(bodies_3d.contact_forces(drawn, 0)[1])), axis=1), [1, 2, 0]
        )
        assert re.search("(4[4-9]|5[0-6]) % of its force is on the other side", bodies_3d.map_caption(drawn, 0))


def lines(*made, axisymmetric=False, **more):
    """Contacts on straight surfaces, each (from, to, (pressures)): points at equal distances."""
    parts = []
    for number, (begin, end, pressure) in enumerate(made):
        place = np.linspace(begin, end, len(pressure))
        along = np.hypot(*(place - place[0]).T)
        across = np.array([[0, -1], [1, 0]]) @ (np.subtract(end, begin) / along[-1])
        parts.append((place, along, np.array(pressure, float), np.full(len(along), number), across + 0 * place))
    place, along, pressure, contact, normal = (np.concatenate(each) for each in zip(*parts, strict=True))
    table = {"x": place[:, 0], "along": along, "pressure": pressure, "weight": 0 * along + 1, "contact": contact}
    table |= {"chain": contact, "overlap": 0 * along, "normalX": normal[:, 0], "normalY": normal[:, 1]}
    table |= {"normalZ": 0 * along, **more}
    deep = np.column_stack([place, 0 * along])
    surface = Surface(deep, 0 * deep, None, None, pressure, 0 * along)
    state = {"state": "axisymmetric"} if axisymmetric else {}
    run = types.SimpleNamespace(summary={**state, "parameters": {}, "contacts": [{}] * len(made)}, path=None)
    fine = Grid(
        np.array([[0, 0, 0], [1, 0, 0], [0, 1e-4, 0]]), np.zeros((3, 3)), np.array([[0, 1, 2]]), None, np.zeros(3)
    )
    return bodies.Bodies(
        run, fine, surface, table, [f"slave{k} master" for k in range(len(made))], [False] * len(made), 1.0
    )


def test_arc_lengths_grow_upwards_or_to_the_right():
    """Contacts drawn over each other shall run the same way, and begin at the axis only if they reach it."""
    found = bodies.contact_chains(
        lines(((10, 0), (10, 40), (0, 1, 2, 1, 0)), ((19, 40), (14, 0), (0, 1, 0)), axisymmetric=True)
    )
    assert [chain.origin for chain in found] == ["middle", "middle"]
    assert all(np.polyfit(chain.along, chain.place[:, 1], 1)[0] > 0 for chain in found)
    np.testing.assert_allclose([chain.zero for chain in found], [[10, 20], [16.5, 20]])
    (flat,) = bodies.contact_chains(lines(((3, 1), (-3, 0), (0, 1, 0))))
    assert np.polyfit(flat.along, flat.place[:, 0], 1)[0] > 0 and (flat.towards, found[0].towards) == ("x", "y")
    (touching,) = bodies.contact_chains(lines(((0, 0), (4, 3), (2, 1, 0)), axisymmetric=True))
    assert touching.origin == "axis"


@pytest.mark.parametrize("pressure", [(0, 0, 0, 3, 0, 0, 0, 0), (0, 0, 1, 3, 5, 0, 0, 0)])
@pytest.mark.parametrize("end", [(1, 9), (9, 1)])
def test_no_pressure_is_cut_off(pressure, end):
    """Picture and curve of a contact shall show where the pressure begins and ends, of steep and coarse ones too."""
    drawn = lines(((0, 0), end, pressure))
    box = bodies.contact_window(drawn, 0)
    reached = np.flatnonzero(pressure)[[0, -1]] + [-1, 1]
    ends = np.array(end) * reached[:, None] / (len(pressure) - 1)
    assert (ends > box[0]).all() and (ends < box[1]).all()
    axes = Figure().add_subplot()
    bodies.plot_pressure(axes, drawn, style.Units())
    (line,) = (each for each in axes.lines if len(each.get_xdata()) > 2)
    for edge in axes.get_xlim():
        assert np.interp(edge, *line.get_data()) == 0
    bodies.draw_pressure_diagram(axes, drawn, box, 0, style.Units())
    crest = np.ptp(axes.collections[1].get_segments(), axis=(0, 1)).max()
    assert crest > 0.1 * np.ptp(box, axis=0).max()


def test_places_far_from_the_origin():
    """Ticks shall be whole numbers, not differences from one beside the axis."""
    drawn = lines(((4321, 0), (4321.01, 0), (0, 1, 0)), along=np.array([4321, 4321.005, 4321.01]))
    axes = Figure().add_subplot()
    bodies.plot_pressure(axes, drawn, style.Units())
    axes.figure.draw_without_rendering()
    assert axes.get_xlabel().startswith("$x$") and axes.xaxis.get_offset_text().get_text() == ""


def test_points_are_marked_where_something_touches():
    """The origin of an arc length has a dot only where its contact carries pressure."""
    drawn = lines(((0, 0), (9, 0), (0, 1, 0)), ((0, 5), (9, 6), (0, 0, 0)))
    axes = Figure().add_subplot()
    bodies.draw_pressure_diagram(axes, drawn, np.array([[0, 0], [9, 9]]), None, style.Units())
    assert len([line for line in axes.lines if line.get_marker() == "o"]) == 1


def test_zones_of_two_contacts_are_apart():
    """What sticks and slips of several contacts shall stand in a strip each, below the curves."""
    slides = {"slide": np.array([2, 1, 1, 2, 0, 2, 2, 1]), "shear": np.array([0, 1, 1, 0, 0, -1, -1, 0.0])}
    drawn = lines(((0, 0), (0, 3), (0, 4, 4, 0)), ((9, 0), (9, 3), (0, 4, 4, 0)), **slides)
    axes = Figure().add_subplot()
    bodies.plot_pressure(axes, drawn, style.Units())
    strips = [patch.get_window_extent() for patch in axes.patches if patch.get_alpha() is None]
    heights = sorted({(round(box.y0), round(box.y1)) for box in strips})
    assert len(strips) == 5 and len(heights) == 2 and heights[0][1] < heights[1][0]
    assert axes.transData.transform((0, -1))[1] > heights[1][1]


def test_equal_contacts_keep_their_order():
    """Of contacts that carry the same but for rounding the first of the case file is drawn first."""
    for share in (1 - 1e-7, 1 + 1e-7):
        assert bodies.contacts_by_force(lines(((0, 0), (9, 0), (0, 1, 0)), ((0, 5), (9, 5), (0, share, 0)))) == [0, 1]


@pytest.mark.parametrize("command", [state, stress])
@pytest.mark.parametrize("name", ["the-{}-with-a-long-name {}-of-another-body", "MOUNTING-{} HAMMOCK-WITH-{}-MMMMMM"])
def test_long_names(case, command, name):
    """Titles of contacts with long names shall stay on the page, beside each other and beside a bar."""
    with style.look():
        found = bodies.read_bodies(read_run(case))
        names = [name.format(*old.split()) for old in found.names]
        assert faults(command.draw(replace(found, names=names), style.Units("mm", "MPa"), None, False)) == []


@pytest.mark.parametrize(("length", "stress_", "aside"), [(1e-3, 1e6, 0), (1, 1, -43210)])
@pytest.mark.parametrize("slide", [False, True])
def test_ticks_of_other_units_and_places(case, length, stress_, aside, slide):
    """Metres and pascals, and bodies far from the origin: whole numbers at ticks, powers of ten in the labels."""
    with style.look():
        found = bodies.read_bodies(read_run(case))
        grid, surface = found.grid, found.surface
        grid = replace(grid, points=length * grid.points + aside, move=length * grid.move, stress=stress_ * grid.stress)
        surface = replace(surface, points=length * surface.points + aside, move=length * surface.move)
        table = found.table | {"pressure": stress_ * found.table["pressure"], "along": length * found.table["along"]}
        table |= {name: length * found.table[name] + aside for name in "xy"} | {"overlap": length * table["overlap"]}
        contacts = found.run.summary["contacts"]
        closed = [{**each, "closed": {key: length * long for key, long in each["closed"].items()}} for each in contacts]
        run = types.SimpleNamespace(summary=found.run.summary | {"contacts": closed, "stresses": []}, path=None)
        drawn = replace(found, run=run, grid=grid, surface=surface, table=table)
        figure = stress.draw(drawn, style.Units("m", "Pa") if length < 1 else style.Units("mm", "MPa"), None, slide)
        assert faults(figure) == []
        every = style.every_axes(figure)
    shown = [axis.get_offset_text() for axes in every for axis in (axes.xaxis, axes.yaxis)]
    assert not any(text.get_text() and text.get_visible() for text in shown)
    labels = " ".join(text for axes in every for text in (axes.get_xlabel(), axes.get_ylabel()))
    assert ("[$10^{" in labels) is (length < 1)


def test_slave_below_its_master(case):
    """Where slave and master touch as drawn, the check shall show both: the thinner line of the master lies on top."""
    with style.look():
        axes = check.draw(case / "check", bodies_3d.view_matrix(*bodies_3d.VIEW)).axes[0]
    widths = {float(each.get_linewidths()[0]): each.get_zorder() for each in axes.collections[1:]}
    assert {0.9, 1.4, 2.4} <= set(widths) and widths[0.9] > widths[1.4] > widths[2.4]


def test_faults_are_seen():
    """A legend on a curve or on other axes is a fault, as is a text on another one or outside."""
    figure = Figure()
    left, right = figure.subplots(1, 2)
    left.plot([0, 1], [0, 1], label="a curve")
    left.set(xlabel="$x$ [mm]", ylabel="$y$ [mm]")
    right.set(xlabel="$x$ [mm]")
    left.legend(loc="center")
    right.set_axis_off()
    assert any("lies on the curve" in fault for fault in faults(figure))
    right.set_axis_on()
    left.legend(loc="center left", bbox_to_anchor=(0.95, 0.5))
    assert any("lies on other axes" in fault for fault in faults(figure))
    left.legend(loc="upper left")
    assert faults(figure) == []
