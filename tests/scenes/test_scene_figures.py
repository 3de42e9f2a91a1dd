"""postprocess/figures of single scenes, drawn from real runs: what they show, and what they refuse."""

import json
import shutil
from dataclasses import replace

import numpy as np
import pytest
from freefem import ROOT, cases_of, run, run_in, script
from text_boxes import faults

from postprocess import figures, style
from postprocess.command_line import main
from postprocess.reference_values import hertz, merging_pressure
from postprocess.results import read_run
from postprocess.vtu import cut_grid, read_grid

SMALL = ["-h", 0.2, "-layers", 2]
PUNCH = ["-a", 1, "-force", 20, "-order", 2, "-h", 0.025, "-grading", 80]
WAVY = ["-law", "signorini", "-nu", 0, "-width", 20, "-depth", 5, "-waves", 10, "-amplitude", 0.02]
WAVY += ["-order", 2, "-h", 0.1]
DISC = ["-h", 0.5, "-tol", 1e-11]
SPHERE = ["-geometry", "axisymmetric", "-law", "signorini", "-R", 100, "-force", 1.4652014652, "-reach", 2]
SPHERE += ["-grading", 80]


def draw(name, *runs):
    """The figure of these runs, in the package's style."""
    with style.look():
        figure = figures.modules()[name].draw([read_run(each.folder) for each in runs], style.Units())
        assert faults(figure) == []
    return figure


def curves(axes):
    """{legend entry: (x, y)} of a panel's lines."""
    return {line.get_label(): line.get_data() for line in axes.lines}


@pytest.fixture(scope="module")
def balls(tmp_path_factory):
    """A run of two-spheres with its file for ParaView."""
    return run_in(ROOT, script("two-spheres"), *SMALL, "-estimate", 0, out=tmp_path_factory.mktemp("balls") / "run")


# ---------------------------------------------------------------- in space


def test_section(balls):
    """The section by y = 0 shall be as large as two quarters of a disc, its outline as long as theirs."""
    grid = read_grid(balls.folder / "solution.vtu")
    pieces, stress, outline = cut_grid(replace(grid, move=0 * grid.move), 1e-4)
    x, z = pieces[..., 0], pieces[..., 1]
    area = 0.5 * np.abs(np.sum(x * np.roll(z, -1, axis=1) - z * np.roll(x, -1, axis=1), axis=1))
    assert area.sum() == pytest.approx(2 * np.pi * 10**2 / 4, rel=0.01)
    assert len(stress) == len(pieces) and stress.min() > 0
    lengths = np.hypot(*(outline[:, 0] - outline[:, 1]).T)
    assert lengths.sum() == pytest.approx(2 * (np.pi / 2 + 2) * 10, rel=0.01)


def test_stress_below_the_contact(balls):
    """Its greatest value in the section shall be Hertz's 0.62 p0, half a radius below the surface."""
    pieces, stress, _ = cut_grid(read_grid(balls.folder / "solution.vtu"), 1e-4)
    a, greatest = hertz(read_run(balls.folder), balls.force)
    x, z = pieces.reshape(-1, 2)[np.argmax(stress)]
    assert stress.max() == pytest.approx(0.62 * greatest, rel=0.1)
    assert x < 0.5 * a and 0.25 * a < abs(z - balls.contact["z"].max()) < 0.9 * a


HARD_SPHERE = "sphere-on-block", ["-law", "signorini", "-h", 1.2, "-layers", 1]


@pytest.mark.parametrize("scene, flags", cases_of([HARD_SPHERE], [("sphere-on-plane", ["-h", 0.3, "-layers", 2])]))
def test_sphere(tmp_path, scene, flags):
    """The figure of a contact in space shall have its section, and the obstacle where it is rigid."""
    done = run_in(ROOT, script(scene), *flags, "-d0", 0, "-estimate", 0, out=tmp_path / "run")
    figure = draw("sphere", done)
    section = figure.axes[3]
    assert section.get_title() == f"section $y = 0$, displacements at true scale; P{done.order}, $h = {done.h}$"
    assert section.get_aspect() == 1
    (obstacle,) = section.lines
    x, z = obstacle.get_data()
    assert z.min() == pytest.approx(done.contact["z"].max() + done.parameters["gap"] - done.approach, abs=1e-3)
    assert (np.ptp(z) == 0) == (scene == "sphere-on-plane")
    assert np.abs(np.interp(0, x, z) - done.contact["z"].max()) > 0.01, "the surface is pressed down"


@pytest.mark.parametrize(
    "spoil, words",
    [
        (lambda data: None, "no such file; run the scene with -vtu 1"),
        (lambda data: b"", "is empty"),
        (lambda data: data[:500], "is not XML, or is truncated"),
        (lambda data: bytes(range(256)) * 8, "is not XML"),
        (lambda data: b"<html><body>404</body></html>", "is not a run's solution: no Points, displacement[length]"),
        (lambda data: data.replace(b"vonMises", b"Mises"), "no vonMises[pressure]"),
        (lambda data: data.replace(b'"Float64"', b'"Float8"'), "numbers of an unknown type 'Float8'"),
        (lambda data: data[: 2 * len(data) // 3], "is truncated"),
        (lambda data: data.replace(b"\n\0\0\0\0\0\0\0" * 300, b"\t\0\0\0\0\0\0\0" * 300), "not a grid"),
    ],
)
def test_spoilt_grids(balls, tmp_path, capsys, spoil, words):
    """A file for ParaView that is missing, truncated or foreign shall be refused in one line, nothing written."""
    folder = tmp_path / "run"
    shutil.copytree(balls.folder, folder)
    path = folder / "solution.vtu"
    data = spoil(path.read_bytes())
    path.unlink()
    if data is not None:
        path.write_bytes(data)
    assert main(["figure", "sphere", "--out", str(tmp_path / "f.pdf"), str(folder)]) == 2
    error = capsys.readouterr().err
    assert error.startswith(f"postprocess: {path}: ") and words in error and error.count("\n") == 1
    assert not list(tmp_path.glob("f.*"))


# ---------------------------------------------------------------- closed forms


def test_patch():
    """Nodal overlaps shall be 15 % off in the plane and 33 % in space, averaged ones exact to 1e-9."""
    runs = [
        run(scene, "-tol", 1e-11, *points)
        for scene in ("patch-test", "patch-test-3d")
        for points in (["-points", "nodal"], [])
    ]
    plane, nodal, segment = draw("patch", *runs).axes
    lines = {label.partition(":")[0]: y for label, (_, y) in curves(plane).items()}
    assert np.abs(lines["overlaps at nodes"]).max() == pytest.approx(14.64, abs=0.01)
    assert np.abs(lines["averaged overlaps"]).max() < 1e-7
    for axes, words in ((nodal, "overlaps at nodes:\nat most $33$ %"), (segment, "averaged overlaps:\nat most")):
        assert words in axes.get_title(loc="left")
    assert np.abs(nodal.collections[0].get_array()).max() == pytest.approx(32.55, abs=0.01)
    assert np.abs(segment.collections[0].get_array()).max() < 1e-7


def test_punch():
    """Hard contact shall follow the closed form to 1 % inside, a soft layer fall short of it at the corner."""
    figure = draw("punch", run("flat-punch", *PUNCH, "-law", "signorini"), run("flat-punch", *PUNCH, "-kappa", 1e3))
    left = curves(figure.axes[0])
    (hard, (x, pressure)), (_, (_, soft)), (_, (line, closed)) = left.items()
    assert hard == "hard contact" and list(left)[1] == r"$\kappa = 1000$, $m = 3$"
    inside = np.abs(x) < 0.85
    order = np.argsort(line)
    np.testing.assert_allclose(pressure[inside], np.interp(x[inside], line[order], closed[order]), rtol=0.01)
    assert np.nanmax(soft) < 2 < np.nanmax(pressure)
    distance, near = figure.axes[1].lines[-1].get_data()
    slope = np.polyfit(np.log(distance[:100]), np.log(near[:100]), 1)[0]
    assert slope == pytest.approx(-0.5, abs=0.01)


def test_waves():
    """Inside the contacts the difference from Westergaard's shall be below 1 % of p*, before and after they merge."""
    runs = [run("wavy", *WAVY, "-force", force) for force in (31.41592654, 94.24777961)]
    right = draw("waves", *runs).axes[1]
    for line, edge in zip(right.lines, (0.22, 0.5), strict=True):
        x, difference = line.get_data()
        assert np.abs(difference[np.abs(x) < edge]).max() < 1
    assert merging_pressure(read_run(runs[0].folder)) == pytest.approx(np.pi)


def test_rigid():
    """The differences from the rigid disc shall fall with the ratio of the moduli, slope -1 to 0.01."""
    discs = [run("meshed-disc", *DISC, "-Eratio", ratio) for ratio in (1e2, 1e4, 1e6)]
    right = draw("rigid", run("disc-on-block", *DISC), *discs[::-1]).axes[2]
    assert list(curves(right)) == ["pressure, slope $-1.00$", "force, slope $-1.00$"]
    for ratio, difference in curves(right).values():
        slope = np.polyfit(np.log(ratio), np.log(difference), 1)[0]
        assert slope == pytest.approx(-1, abs=0.01)
        assert difference[-1] < 1e-6


def test_hertz_error():
    """Errors over h, axisymmetric: radius with slope 2 (P1), pressure with 1; P2 smaller than P1 everywhere."""
    runs = [run("disc-on-block", *SPHERE, "-order", order, "-h", h) for order in (1, 2) for h in (0.2, 0.1, 0.05)]
    figure = draw("hertz_error", *runs)
    radius, _, spread = (list(curves(axes).values()) for axes in figure.axes)
    (h, first), (_, second) = radius
    assert h == pytest.approx([0.05, 0.1, 0.2], rel=1e-9)
    assert np.polyfit(np.log(h), np.log(first), 1)[0] == pytest.approx(2, abs=0.15)
    assert (second < 0.1 * first).all()
    for _, error in spread:
        assert np.polyfit(np.log(h), np.log(error), 1)[0] == pytest.approx(1, abs=0.15)
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert names[0].startswith("sphere on block, P1: 2.0") and names[1].startswith("sphere on block, P2: ")


# ---------------------------------------------------------------- refusals


@pytest.mark.parametrize(
    "name, runs, words",
    [
        ("patch", 1, "scene 'confined-block' is not patch-test or patch-test-3d"),
        ("punch", 1, "scene 'confined-block' is not flat-punch"),
        ("waves", 1, "scene 'confined-block' is not wavy"),
        ("rigid", 3, "scene 'confined-block' is not disc-on-block"),
        ("hertz_error", 2, "scene 'confined-block' is not hertz-line or two-cylinders or disc-on-block"),
        ("sphere", 1, "contact.csv: wrong columns: no z"),
    ],
)
def test_other_scenes_are_refused(tmp_path, capsys, name, runs, words):
    """A figure of one scene shall refuse the runs of another in one line."""
    done = run("confined-block", "-h", 4)
    assert main(["figure", name, "--out", str(tmp_path / "f.pdf"), *[str(done.folder)] * runs]) == 2
    error = capsys.readouterr().err
    assert words in error and error.count("\n") == 1


@pytest.mark.parametrize(
    "name, scene, flags, change, words",
    [
        ("punch", "flat-punch", [*PUNCH, "-kappa", 1e3], {"a": 0}, "parameters has a = 0, which is not above 0"),
        ("waves", "wavy", [*WAVY, "-force", 31.41592654], {"width": -1}, "width = -1, which is not above 0"),
        ("waves", "wavy", [*WAVY, "-force", 31.41592654], {"nu": 1}, "nu = 1, which is not within"),
        ("patch", "patch-test", ["-tol", 1e-11], {"Eratio": 0}, "Eratio = 0, which is not above 0"),
        ("patch", "patch-test", ["-tol", 1e-11], {"nu": 0.5}, "nu = 0.5: the block cannot be compressed"),
        ("sphere", "two-spheres", SMALL, {"R1": 0}, "R1 = 0, which is not above 0"),
        ("sphere", "two-spheres", SMALL, {"R2": None}, "parameters has no number R2"),
    ],
)
def test_spoilt_parameters(tmp_path, capsys, name, scene, flags, change, words):
    """A summary whose parameters no run can have shall be refused in one line."""
    folder = tmp_path / "run"
    shutil.copytree(run(scene, *flags).folder, folder)
    summary = json.loads((folder / "summary.json").read_text())
    summary["parameters"].update(change)
    (folder / "summary.json").write_text(json.dumps(summary))
    assert main(["figure", name, "--out", str(tmp_path / "f.pdf"), str(folder)]) == 2
    error = capsys.readouterr().err
    assert words in error and error.count("\n") == 1


def test_other_points_are_refused(tmp_path, capsys):
    """A meshed disc on another mesh than the rigid one's shall be refused."""
    runs = [run("disc-on-block", *DISC), *(run("meshed-disc", "-h", h, "-tol", 1e-11) for h in (0.5, 2))]
    assert main(["figure", "rigid", "--out", str(tmp_path / "f.pdf"), *(str(each.folder) for each in runs)]) == 2
    assert "has other points than" in capsys.readouterr().err
