"""edp/examples: each case on a coarser mesh against its closed form; long: the pages' numbers, twenty shapes."""

import json
import re
import shlex
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import shapes
from docs.test_readme import fences, section
from freefem import FREEFEM, ROOT, execute, table, tree
from page_numbers import units

from postprocess import closed_forms as forms

FOLDER = ROOT / "edp/examples"
NAMES = sorted(path.parent.name for path in FOLDER.glob("*/*.case"))
STEEL = forms.plane_modulus(210e3, 0.3)
SPACE = ("crossed-cylinders", "ball-on-bracket", "wheel-on-rail")
PAPER = ("-method", "paper", "-order", "2")


@dataclass
class Case:
    """A run of a case: its summary, contact.csv, what it printed."""

    summary: dict
    contact: np.ndarray
    stdout: str

    @property
    def first(self):
        return self.summary["contacts"][0]


def solve(folder, mesh, case, space, *flags, expect=0):
    script = "edp/parts-3d.edp" if space else "edp/parts.edp"
    out = folder / "run"
    code, stdout = execute([*FREEFEM, script, "-mesh", mesh, "-case", case, "-out", out, "-vtu", "0", *flags])
    assert code == expect, f"exit code {code}:\n{stdout[-3000:]}"
    if code:
        return stdout
    return Case(json.loads((out / "summary.json").read_text()), table(out / "contact.csv"), stdout)


@pytest.mark.parametrize("name", NAMES)
def test_case_file_on_the_page(name):
    """The case file on an example's page is the file of its folder."""
    (shown,) = fences((FOLDER / name / "README.md").read_text(), "text")
    assert shown == (FOLDER / name / f"{name}.case").read_text()


def test_page_of_the_case_file(tmp_path):
    """The commands of the page run as they stand, and the case file on it is the example's."""
    text = (ROOT / "edp/input/README.md").read_text()
    (shown,) = fences(text, "text")
    case = (FOLDER / "pin-in-hole/pin-in-hole.case").read_text()
    assert [line.split("#")[0].split() for line in case.splitlines()[1:]] == [
        line.split() for line in shown.splitlines()
    ]
    package = tree(tmp_path / "package")
    for name in ("postprocess", ".venv"):
        (package / name).symlink_to(ROOT / name)
    for line in "".join(fences(text, "sh")).splitlines():
        code, stdout = execute(["sh", "-c", line], package)
        assert code == 0, f"{line}\n{stdout[-2000:]}"


def example(name, folder, exchanged="", *flags, **constants):
    """An example with other constants in its .geo, and "old|new" exchanged in its case file; no error wanted."""
    geo, case = ((FOLDER / name / f"{name}.{kind}").read_text() for kind in ("geo", "case"))
    for key, value in constants.items():
        geo, count = re.subn(rf"\[ {key} = \{{[^,]*,", f"[ {key} = {{{value},", geo)
        assert count == 1, key
    if exchanged:
        old, new = exchanged.split("|")
        assert old in case
        case = case.replace(old, new)
    (folder / f"{name}.geo").write_text(geo)
    (folder / f"{name}.case").write_text(case)
    short = [] if "-estimate" in flags else ["-estimate", "0"]
    return solve(folder, folder / f"{name}.geo", folder / f"{name}.case", name in SPACE, *flags, *short)


def balanced(case):
    """Action and reaction of every contact, and the supports' forces against the loads."""
    for contact in case.summary["contacts"]:
        assert all(np.isfinite(contact["force"]))
    assert case.summary["outOfBalance"] < 1e-9


# ---------------------------------------------------------------- on coarser meshes


@pytest.mark.parametrize("force, size", [(400, 0.4), (4000, 1.2)])
def test_pin_in_hole(tmp_path, force, size):
    """The pin's contact angle and greatest pressure shall be Persson's, its rotation fixed, its load its supports'."""
    case = example("pin-in-hole", tmp_path, f"0 -1000 |0 -{force} ", size=size)
    angle = forms.pin_angle(STEEL * 0.01 / force)
    greatest = forms.pin_pressure(0, angle) * force / 10.01
    assert case.first["contactLength"] / 2 / 10.01 == pytest.approx(angle, rel=0.015)
    assert case.first["pressureMax"] == pytest.approx(greatest, rel=2e-3)
    along = np.arctan2(case.contact["x"], -case.contact["y"])
    inside = np.abs(along) < 0.9 * angle
    exact = np.array([forms.pin_pressure(a, angle) * force / 10.01 for a in along[inside]])
    assert np.abs(case.contact["pressure"][inside] - exact).max() < 5e-3 * greatest
    assert case.summary["fixedMotions"] == ["pin core: rotation"] or "rotation" in case.summary["fixedMotions"][0]
    assert case.first["force"] == pytest.approx([0, -force], abs=1e-6 * force)
    assert sum(body["reaction"][1] for body in case.summary["bodies"]) == pytest.approx(force, rel=1e-9)
    balanced(case)


def test_roller(tmp_path):
    """Both contacts of the roller shall be Hertz's and carry the same force, and so the stresses below one."""
    case = example("roller", tmp_path, "", "-axis", "1", "-estimate", "1", size=0.2)
    a, greatest = forms.hertz_line(2000, 10, forms.contact_modulus(STEEL, STEEL))
    above, below = case.summary["contacts"]
    for contact in (above, below):
        assert contact["halfWidthMoment"] == pytest.approx(a, rel=0.02)
        assert contact["pressureMax"] == pytest.approx(greatest, rel=0.01)
    assert np.add(above["force"], below["force"]) == pytest.approx([0, 0], abs=1e-6)
    assert above["force"][1] == pytest.approx(-2000, rel=1e-9)
    assert case.summary["newton"] <= 6 and case.summary["backsolves"] <= 35
    balanced(case)
    below = table(tmp_path / "run" / "axis.csv")
    exact = -greatest / np.sqrt(1 + (below["depth"] / a) ** 2)
    assert below["depth"][-1] == pytest.approx(3 * a, rel=0.05)
    np.testing.assert_allclose(below["s22"], exact, rtol=0, atol=0.04 * greatest)
    assert np.abs(below["s12"]).mean() < 0.01 * greatest
    told = case.summary["estimates"]  # both contacts are known alike, and the way of what pushes it
    for contact in told["contacts"]:
        assert contact["force"]["error"] <= 1e-7 * 2000
        assert abs(contact["contactLength"]["value"] - 2 * a) <= contact["contactLength"]["error"]
        assert abs(contact["pressureMax"]["value"] - greatest) <= contact["pressureMax"]["error"] + 2e-3 * greatest
    assert told["loads"][0]["name"] == "force grip" and 0 < told["loads"][0]["way"]["error"] < 0.01


def test_roller_true_distance(tmp_path):
    """Nothing but its own dent holds the roller between the plates: it is kept in place, which is said."""
    case = example("roller", tmp_path, "", "-distance", "exact", size=0.2)
    assert "warning: roller: along x: kept where the rounds of the exact distance had brought it" in case.stdout
    above, below = case.summary["contacts"]
    assert above["pressureMax"] == pytest.approx(below["pressureMax"], rel=1e-3)
    assert np.add(above["force"], below["force"]) == pytest.approx([0, 0], abs=4e-2)
    assert abs(case.summary["bodies"][0]["motion"][0]) < 1e-3
    assert case.summary["outOfBalance"] < 1e-9


def test_press_fit(tmp_path):
    """The mean pressure between two rings that nothing else holds shall be Lame's, and be the same all round."""
    case = example("press-fit", tmp_path, "", "-estimate", "1", edges=92)
    exact = forms.press_fit((10, 20, 30), 0.002, (210e3, 0.3), (210e3, 0.3))
    pressure, weight = case.contact["pressure"], case.contact["weight"]
    assert pressure @ weight / weight.sum() == pytest.approx(exact, rel=2e-3)
    assert np.abs(pressure / exact - 1).max() < 3e-3
    assert len(case.summary["fixedMotions"]) == 4
    assert case.first["contactLength"] == pytest.approx(2 * np.pi * 20, rel=1e-3)
    # elements follow bore and outside too; Lame's rings have one radius, these differ by 1e-4 of it
    force = case.summary["estimates"]["contacts"][0]["normalForce"]
    assert abs(force["value"] / (2 * np.pi * 20 * exact) - 1) < 1e-4 and force["error"] < 1e-4 * force["value"]
    assert not case.summary["warnings"]
    balanced(case)


def test_crossed_cylinders(tmp_path):
    """Semi-axes and greatest pressure of crossed cylinders shall be those of Hertz's ellipse."""
    case = example("crossed-cylinders", tmp_path, size=0.27, extent=5)
    a, b, greatest, _ = forms.hertz_ellipse(2000, (10, 40), forms.contact_modulus(STEEL, STEEL))
    assert case.first["semiAxes"] == pytest.approx([a, b], rel=0.03)
    assert case.first["pressureMax"] == pytest.approx(greatest, rel=0.03)
    assert case.first["force"][2] == pytest.approx(-500, rel=1e-9)
    balanced(case)


def test_ball_on_bracket(tmp_path):
    """A ball that only contact holds shall press like Hertz's; what no gap feels is said."""
    case = example("ball-on-bracket", tmp_path, size=0.45, round=3, finer=0.9, coarse=10)
    check_ball(case, 0.06)
    assert len(case.summary["fixedMotions"]) == 3
    balanced(case)


def check_ball(case, allowed):
    force = -case.first["force"][2]
    assert force == pytest.approx(100, rel=1e-3)  # curved elements have the ball's volume
    modulus = forms.contact_modulus(STEEL, forms.plane_modulus(3e3, 0.4))
    a, b, greatest, _ = forms.hertz_ellipse(force, (8, 8), modulus)
    assert case.first["semiAxes"] == pytest.approx([a, b], rel=allowed)
    assert case.first["pressureMax"] == pytest.approx(greatest, rel=allowed)


def test_gear_pair(tmp_path):
    """A tooth's pressure shall be Hertz's of the involutes' radii, its force along the line of action."""
    case = example("gear-pair", tmp_path, "contact 0.02|contact 0.06")
    check_gears(case.first, case.summary, 5e-3)
    balanced(case)


def check_gears(contact, summary, allowed=1e-3):
    angle = np.radians(20)
    radius = 1 / (1 / (48 * np.sin(angle)) + 1 / (72 * np.sin(angle)))
    force = contact["normalForce"]
    a, greatest = forms.hertz_line(force, radius, forms.contact_modulus(STEEL, STEEL))
    assert contact["pressureMax"] == pytest.approx(greatest, rel=allowed)
    assert contact["halfWidthMoment"] == pytest.approx(a, rel=2 * allowed)
    along = np.degrees(np.arctan2(-contact["force"][1], -contact["force"][0]))
    assert along == pytest.approx(20, abs=20 * allowed)
    assert -summary["prescribed"][0]["moment"] == pytest.approx(force * 48 * np.cos(angle), rel=allowed)


def shrunk(folder, case):
    """Of the shrink fit mean and greatest pressure, stresses in the ring; Lame's."""
    along = table(folder / "line-across.csv")
    pressure = forms.shrink_fit((10, 25, 45), 23e-6 * 120, (210e3, 0.3), (70e3, 0.33))
    (radial, inside), (_, outside) = (forms.ring_stress(r, pressure, 25, 45) for r in (26, 45))
    mean = case.first["normalForce"] / case.first["contactLength"]
    found = [mean, case.first["pressureMax"], along["stressYY"][0], along["stressYY"][-1], along["stressXX"][0]]
    return found, [pressure, pressure, inside, outside, radial]


def pressed_head(folder, case, clearance=0.06):
    """Of the hip joint greatest pressure and radius; Hertz's."""
    radius = 14 * (14 + clearance) / clearance
    a, _, greatest, _ = forms.hertz_ellipse(2500, (radius, radius), forms.contact_modulus(STEEL, STEEL))
    return [case.first["pressureMax"], case.first["halfWidthMoment"]], [greatest, a]


def pushed_hook(folder, case, friction=0):
    """Of the snap hook the force along the latch's way and that on the ramp; a beam's."""
    return [case.summary["force"], case.first["normalForce"]], forms.snap_hook((17, 3), (2600, 0.35), 0.5, 5, friction)


def joint(folder, case):
    """Of the bolted sleeve what bolt and sleeve carry; the joint diagram's."""
    steps = table(folder / "series.csv")
    bolt, sleeve = steps["preload cut force"], steps["seat under normal force"]
    exact = [forms.joint_diagram(20e3, load, 0.25, 0.64 - 0.55**2) for load in steps["force top"]]
    return [bolt[3], sleeve[3], bolt[5], bolt[7]], [*exact[3], exact[5][0], exact[7][0]]


def test_shrink_fit(tmp_path):
    """A ring that cools shall press like Lame's, its stresses along a line within their errors."""
    case = example("shrink-fit", tmp_path, "", "-estimate", "1", edges=10)
    found, exact = shrunk(tmp_path / "run", case)
    assert found == pytest.approx(exact, rel=0.012) and found[0] == pytest.approx(exact[0], rel=1e-4)
    along = table(tmp_path / "run/line-across.csv")
    radial, hoop = np.array([forms.ring_stress(r, exact[0], 25, 45) for r in along["x"]]).T
    mises = np.sqrt(radial**2 - radial * hoop + hoop**2)
    assert (np.abs(along["vonMises"] - mises) < along["vonMisesError"]).all()
    balanced(case)


@pytest.mark.parametrize(
    "clearance, size, least, most",
    [(0.3, 0.14, 0.01, 0.025), (0.06, 0.3, 0.04, 0.06)],
)
def test_hip_joint(clearance, size, least, most, tmp_path):
    """The farther the socket is from the ball, the nearer shall pressure and radius be to Hertz's."""
    case = example("hip-joint", tmp_path, "stresses|", wall=20, clearance=clearance, size=size)
    found, exact = pressed_head(tmp_path / "run", case, clearance)
    assert least < found[0] / exact[0] - 1 < most and found[1] == pytest.approx(exact[1], rel=most)


def test_snap_hook(tmp_path):
    """A hook shall need the force of a beam whose end turns; the ± of linear gaps is not asked for."""
    case = example("snap-hook", tmp_path, "ramp 0.01|ramp 0.03", "-distance", "exact", size=0.5)
    found, exact = pushed_hook(tmp_path, case)
    assert found == pytest.approx(exact, rel=0.03)
    assert found[0] / found[1] > np.sin(np.pi / 6)  # steeper than at rest
    balanced(case)


@pytest.mark.parametrize("friction", [0.1, 0.3])
def test_snap_hook_with_friction(tmp_path, friction):
    """Friction bends the arm too: the beam's force on the way in, not that without friction times a factor."""
    text = (FOLDER / "snap-hook" / "snap-hook.case").read_text().replace("  yield 65", "")
    text = text.replace("ramp 0.01", "ramp 0.05").replace("R 5", f"R 5  friction {friction}")
    (tmp_path / "a.case").write_text(text)
    flags = ("-estimate", "0", "-distance", "exact", "-history", "1", "-steps", "3")
    case = solve(tmp_path, FOLDER / "snap-hook" / "snap-hook.geo", tmp_path / "a.case", False, *flags)
    found, exact = pushed_hook(tmp_path, case, friction)
    assert found == pytest.approx(exact, rel=0.04)
    assert case.first["stickShare"] == 0


def test_bolted_sleeve(tmp_path):
    """Bolt and sleeve shall share the load as the joint diagram has it, and part where it says."""
    case = example("bolted-sleeve", tmp_path, "", "-history", "1", "-steps", "8", size=1.2)
    found, exact = joint(tmp_path / "run", case)
    assert found == pytest.approx(exact, rel=0.02) and found[3] == pytest.approx(40e3, rel=1e-9)
    assert case.first["contactPoints"] == 0 and "nothing presses" in case.stdout


@pytest.mark.parametrize("friction", [0.05, 0.2])
def test_taper(tmp_path, friction):
    """Driven in it slips all over; let go of it stays where friction is above its slope, and comes out where not."""
    text = (FOLDER / "taper" / "taper.case").read_text().replace("friction 0.2", f"friction {friction}")
    (tmp_path / "a.case").write_text(text[: text.rindex("leg")])
    case = solve(
        tmp_path, FOLDER / "taper" / "taper.geo", tmp_path / "a.case", False, "-estimate", "0", "-set", "size", "2"
    )
    forces = table(tmp_path / "run" / "series.csv")["force"]
    assert forces[3] == pytest.approx(forms.taper(1400, 0.1, friction), rel=1e-6)
    if friction < 0.1:
        assert case.summary["contacts"][0]["stickShare"] < 1
        assert forces[5] == pytest.approx(forms.taper(1.4, 0.1, -friction), rel=1e-6)
    else:
        assert 0.8 * forces[3] < forces[5] < forces[3]


# ---------------------------------------------------------------- the pages


@pytest.mark.parametrize("name", NAMES)
def test_page(name):
    """Each page shall name every boundary group that its case uses, have two commands, and a picture that is there."""
    page, case = (FOLDER / name / "README.md").read_text(), (FOLDER / name / f"{name}.case").read_text()
    named = set(re.findall(r"`([\w-]+)`", section(page, "Strong form")))
    words = [line.split("#")[0].split() for line in case.splitlines()]
    words = [word for word in words if word and word[0] not in ("units", "state", "size", "leg", "cycles")]
    used = [word[1:3] if word[0] == "contact" else word[1:2] for word in words]
    of_bodies = "body", "plastic"
    boundary = {group for word, groups in zip(words, used, strict=True) for group in groups if word[0] not in of_bodies}
    assert boundary <= named
    (commands,) = fences(page, "sh")
    first, second = commands.splitlines()
    assert f"-case edp/examples/{name}/{name}.case" in first and second.startswith(".venv/bin/python -m postprocess")
    for target in re.findall(r"\]\(([^)#]+)\)", page):
        assert (FOLDER / name / target).exists(), target
    assert f"({name}/README.md)" in (FOLDER / "README.md").read_text()


def test_screen_of_the_manual():
    """The greatest pressure on the page shall be the pin's."""
    text = (ROOT / "edp/docs/howto/accuracy.md").read_text()
    (line,) = re.findall(r"^    greatest pressure .*$", text, re.M)
    (command,) = [unit.command for unit in units((FOLDER / "pin-in-hole/README.md").read_text() + "1<!--= 1 -->")]
    assert line in execute([*FREEFEM, *shlex.split(command), "-vtu", "0"])[1]


# ---------------------------------------------------------------- shapes never seen


@pytest.mark.parametrize("name", shapes.NAMES)
def test_shape(name, tmp_path):
    """A shape that the package has never seen shall run at first try, its forces in balance."""
    mesh, case = shapes.mesh(name, tmp_path)
    done = solve(tmp_path, Path(mesh), Path(case), shapes.SHAPES[name].space)
    assert done.summary["converged"]
    balanced(done)
