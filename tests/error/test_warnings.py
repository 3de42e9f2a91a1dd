"""What makes a converged result doubtful is said: in summary.json, on the screen, by postprocess."""

import json
import re

import numpy as np
import pytest
from freefem import ROOT, data, execute, part, run, script, snippet
from scenes.test_scene_figures import draw
from text_boxes import faults

from postprocess.command_line import main

SENSIBLE = [
    ("disc-on-block", []),
    ("confined-block", []),
    ("flat-punch", []),
    ("hertz-line", []),
    ("meshed-disc", []),
    ("patch-test", []),
    ("rough", []),
    ("two-cylinders", []),
    ("wavy", []),
    ("flat-punch", ["-a", 1, "-force", 20, "-order", 2, "-h", 0.05, "-grading", 160, "-law", "signorini"]),
    ("patch-test-3d", []),
    ("sphere-on-plane", []),
]


@pytest.mark.parametrize("scene, flags", SENSIBLE)
def test_no_false_warning(scene, flags):
    """A scene with its default flags, a singular corner included, shall be no reason for a warning."""
    done = run(scene, *flags)
    assert done.warnings == []
    assert done.message == ""
    assert "warning" not in done.stdout.replace("warnings", "")


def warned(done, *words):
    """The one warning that holds all the words; it is on the screen too."""
    (text,) = [text for text in done.warnings if all(word in text for word in words)]
    assert f"warning: {text}" in done.stdout.splitlines()
    assert done.message == ""
    return text


# ---------------------------------------------------------------- waves


@pytest.mark.parametrize(
    "scene, flags, allowed",
    [
        ("wavy", ["-waves", 80, "-h", 0.5, "-order", 1], "at most 20 waves"),
        ("wavy", ["-waves", 81, "-h", 0.25, "-order", 2], "at most 80 waves"),
        ("rough", ["-modes", 100000], "at most 200 modes"),
    ],
)
def test_waves_that_the_mesh_cannot_carry(tmp_path, scene, flags, allowed):
    """Too few points a wave shall be refused in one line with the number that the mesh can carry, nothing written."""
    out = tmp_path / "new"
    code, stdout = execute(["FreeFem++", "-nw", "-v", "0", script(scene), *map(str, flags), "-out", out])
    (line,) = stdout.splitlines()
    assert (code, out.exists()) == (10, False)
    assert flags[0] in line and allowed in line.split("allowed", 1)[1]


def test_waves_that_the_mesh_carries_poorly():
    """Between 4 and 8 points a wave the run shall say so; the force is then off by more than with 16."""
    flags = ["-u0", 0.7, "-kappa", 1e9]
    fine, poor = (run("wavy", *flags, "-h", h) for h in (0.125, 0.5))
    warned(poor, "4 mesh points a wave", "-h")
    assert not [text for text in fine.warnings if "a wave" in text]
    warned(run("rough", "-h", 0.2), "3.125 mesh points on the shortest wave")
    assert fine.force == pytest.approx(run("wavy", *flags, "-order", 2, "-h", 0.25).force, rel=0.01)
    assert abs(poor.force / fine.force - 1) > 0.02


def rough_height(x, modes, seed=1, hurst=0.8, rms=0.1, width=40):
    """The profile as its definition says."""
    random, phases = seed, []
    for _ in range(modes):
        random = 16807 * random % 2147483647
        phases.append(2 * np.pi * random / 2147483647)
    n = np.arange(1, modes + 1)
    size = n ** (-hurst - 0.5)
    height = np.cos(2 * np.pi * np.outer(x, n) / width + phases) @ size
    return height * rms / np.sqrt(np.sum(size**2) / 2)


@pytest.mark.parametrize("modes, seed", [(16, 1), (64, 7)])
def test_rough_top_does_not_depend_on_the_mesh(modes, seed):
    """The gap at a point shall be a function of x alone: counted from the profile's own highest point, to 1e-9."""
    dense = np.linspace(-20, 20, 400 * modes + 1)
    guess = dense[np.argmax(rough_height(dense, modes, seed))]
    top = rough_height(guess + np.linspace(-1, 1, 20001) * (dense[1] - dense[0]), modes, seed).max()
    for h in (0.5, 0.23) if modes == 16 else (0.25, 0.1):
        done = run("rough", "-modes", modes, "-seed", seed, "-h", h, "-u0", 0.1, "-gap", 0.5, "-d0", -0.25)
        assert done.force == 0  # no contact: the overlap is the gap
        x, overlap = done.contact["x"], done.contact["overlap"]
        np.testing.assert_allclose(overlap, 0.1 - 0.5 - top + rough_height(x, modes, seed), atol=1e-9)


# ---------------------------------------------------------------- rounding, mean planes


def test_overlap_lost_in_rounding():
    """Gap and displacement so large that their difference is rounding: no result, or one with a word."""
    lost = run("disc-on-block", "-h", 0.5, "-gap", 1e16, "-u0", 10000000000000002, expect=20)
    assert "rounding" in lost.message and "-u0" in lost.message
    near = run("disc-on-block", "-h", 0.5, "-gap", 1e10, "-u0", 10000000002.0)
    warned(near, "rounding", "-u0")
    assert near.force == pytest.approx(run("disc-on-block", "-h", 0.5).force, rel=1e-5)


def test_mean_planes_that_pass_through_each_other():
    """A law so soft that the bodies pass through each other shall be named with -kappa, no other one."""
    flags = ["-force", 0, "-law", "power", "-d0", -0.05, "-h", 0.2]
    soft = run("two-cylinders", *flags)
    text = warned(soft, "mean planes", "-kappa")
    assert soft.overlapMax > 0.1 * 0.4  # gap 0.1, approach 0.5
    assert f"{100 * soft.overlapMax / 0.4:.0f} %" in text
    assert not run("two-cylinders", *flags, "-kappa", 1e9).warnings


# ---------------------------------------------------------------- resolution


def hertz_greatest(force, radius=10, modulus=100 / 0.91):
    return (6 * force * modulus**2 / (np.pi**3 * radius**2)) ** (1 / 3)


def test_few_points_in_space():
    """A contact of a point or a few shall be said: its greatest pressure is far from Hertz's."""
    done = run("sphere-on-plane", "-h", 0.5)
    warned(done, "points across", "-h")
    one = run("sphere-on-plane", "-h", 0.5, "-force", 0.01)
    warned(one, "points across", "-h")
    assert abs(one.pressureMax / hertz_greatest(0.01) - 1) > 0.5


def test_few_points_in_the_plane():
    """In the plane too, contact by contact, with the share of the force that they carry."""
    warned(run("hertz-line", "-h", 0.5), "the contact has fewer than 6 points across", "-h")
    done = run("wavy", "-u0", 0.55, "-h", 0.25, "-law", "signorini", "-d0", 0)
    status = (done.contact["status"] > 0).astype(int)
    sizes = np.diff(np.flatnonzero(np.diff([0, *status, 0])))[::2]
    text = warned(done, "points across")
    assert f"{np.sum(sizes < 6)} of {len(sizes)} places of contact" in text


def test_jumping_pressure():
    """A fine, stiff slave against a coarse, soft master: the pressure jumps, and the run says so with the cure."""
    done = run("two-cylinders", "-E1", 1e5, "-h", 0.1)
    warned(done, "jumps from point to point", "softer body")
    warned(run("two-spheres", "-E1", 1e5, "-ratio", 2, "-h", 0.5), "jumps from point to point", "softer body")
    assert done.pressureMax > 1.5 * 2 * 8.631 / np.pi  # Hertz's, a = 1 nearly
    mended = run("two-cylinders", "-E2", 1e5, "-ratio", 0.5, "-h", 0.1)
    assert not [text for text in mended.warnings if "jumps" in text]


# ---------------------------------------------------------------- how it is told


def test_postprocess_tells_warnings(capsys, tmp_path):
    """show, compare, table and the report shall hold the texts of a run's warnings, and of its failure."""
    doubtful = run("hertz-line", "-h", 0.5)
    failed = run("disc-on-block", "-h", 0.5, "-method", "newton", "-maxNewton", 1, expect=20)
    (text,) = doubtful.warnings
    assert failed.warnings == [] and "-maxNewton" in failed.message
    for words in (["show", doubtful.folder], ["compare", doubtful.folder, failed.folder]):
        assert main([*map(str, words)]) == 0
        assert text in capsys.readouterr().out
    assert main(["show", str(failed.folder)]) == 0
    assert failed.message in capsys.readouterr().out
    out = tmp_path / "runs.csv"
    assert main(["table", "--out", str(out), str(doubtful.folder), str(failed.folder)]) == 0
    assert text in out.read_text() and failed.message in out.read_text()


def test_texts_in_json(tmp_path):
    """A text with quotes, backslashes, line ends and every letter shall come back from JSON as it was."""
    out = snippet(
        tmp_path,
        'include "input/flags.idp"\nstring t = "a \\"b\\" \\\\ c\\td\\ne abcdefghijklmnopqrstuvwxyz";\n'
        'cout << "[\\"" + jsonText(t) + "\\"]" << endl;',
    )
    assert json.loads(out) == ['a "b" \\ c\td\ne abcdefghijklmnopqrstuvwxyz']


def test_one_meaning_of_in_contact():
    """The step table, history.csv and the summary shall count the points whose status is not open."""
    for flags in (["-method", "signorini"], ["-method", "paper", "-T0", "d0"], []):
        done = run("disc-on-block", "-h", 0.5, *flags)
        assert done.history["contactPoints"][-1] == done.contactPoints == np.sum(done.contact["status"] > 0)
        assert (done.history["wallPoints"] <= done.history["contactPoints"]).all()


def test_layer_thinner_than_the_rounding_of_d0():
    """At kappa = 1e30 tau shall keep the digits that d0 swallows, and the thresholds' figure shall be drawn."""
    done = run("disc-on-block", "-h", 0.5, "-T0", "d0", "-kappa", 1e30, "-m", 1.05)
    assert (done.contact["threshold"] == -0.25).all()
    wanted = (done.pressureMax / 1e30) ** (1 / 1.05)  # where the law alone carries the greatest pressure, or beyond
    assert (done.contact["tau"] > 0.99 * wanted).all() and done.contact["tau"].max() < 100 * wanted
    assert faults(draw("thresholds", done)) == []


# ---------------------------------------------------------------- refusals

WRONG = [
    (["-kapa", "1e3"], ["did you mean -kappa?"]),
    (["-h=1"], ["write -h 1"]),
    (["1e6"], ["1e6", "-help"]),
    (["-Eratio", "3"], ["-Eratio", "-E ", "-kappa"]),
    (["-E", "1e-290"], ["-E 1e-290", "1e-40"]),
    (["-E", "1e-400"], ["-E 1e-400", "1e-40"]),
    (["-u0", "1e290"], ["-u0 1e290", "1e+40"]),
    (["-kappa", "1e-290"], ["-kappa 1e-290", "1e-250"]),
    (["-h", "1", "-h", "2"], ["-h 2", "once"]),
    (["-kappa"], ["-kappa", "above 0"]),
]


@pytest.mark.parametrize("flags, words, to", [*((*wrong, "pipe") for wrong in WRONG), (*WRONG[0], "file")])
def test_a_refusal_is_one_line(tmp_path, flags, words, to):
    """Nothing shall stand after a refusal's line, in a pipe or in a file; it names the fault and what is allowed."""
    command = ["FreeFem++", "-nw", "-v", "0", "edp/main.edp", *flags]
    if to == "file":
        command = ["sh", "-c", '"$@" > "$0"; code=$?; cat "$0"; exit $code', tmp_path / "said", *command]
    code, stdout = execute(command, cwd=ROOT)
    (line,) = stdout.splitlines()
    assert code == 10
    assert all(word in line for word in words) and "allowed" in line
    assert not ("did you mean" in line and "-maxAdaptations" in line)


@pytest.mark.parametrize("length, pressure", [(1e12, 1e-12), (1e-12, 1e12)])
def test_units_of_any_magnitude(length, pressure):
    """A change of units by 1e12 shall change no count, and force and energy by its factors only."""
    lengths = {"-width": 40, "-depth": 20, "-gap": 0.5, "-u0": 2.5, "-d0": -0.25, "-R": 10, "-h": 0.5}
    flags = [text for name, value in lengths.items() for text in (name, value * length)]
    flags += ["-E", 100 * pressure, "-kappa", 1e3 * pressure / length**3, "-rho", 100 * pressure / length]
    done, usual = run("disc-on-block", *flags), run("disc-on-block", "-h", 0.5)
    assert done.newton == usual.newton
    assert done.force / length / pressure == pytest.approx(usual.force, rel=1e-10)
    assert done.energy / length**2 / pressure == pytest.approx(usual.energy, rel=1e-10)


# ---------------------------------------------------------------- facets

# A pin (R = 10) in a hole (R = 10.05) of a large plate: their gap is the difference of two nearly equal curves, and the
# meshes' facets are as large as it. `PIN` is the pin's element size, the hole's is 0.25.
PIN_IN_HOLE = data("warnings/pin-in-hole.geo")
TRUE_CIRCLES = 227.1  # greatest pressure, from the true circles' gap, another code


@pytest.mark.parametrize("pin, said", [("0.15", False), ("0.37", True), ("0.6", True)])
def test_facets(tmp_path, pin, said):
    """A pressure that facets spoil shall be said; one that they do not is near that of the true circles, and is not."""
    case = "body lower E 2.1e5 nu 0.3\nbody upper E 2.1e5 nu 0.3\ncontact contact master gap vertical\nclamp clamped\n"
    flags = ["-order", 1, "-estimate", 0, "-surface", "facets"]
    done = part(tmp_path, PIN_IN_HOLE.replace("PIN", pin), case + "force pushed 0 -2000\n", *flags)
    if said:
        assert done.pressureMax > 2 * TRUE_CIRCLES
        warned(done, "jumps from point to point", "finer edges")
    else:
        assert done.pressureMax == pytest.approx(TRUE_CIRCLES, rel=0.02)
        assert done.warnings == []


FOOT = """h = 1; r = 0.3;
Point(1) = {-2, r, 0, h}; Point(2) = {-2 + r, r, 0, h}; Point(3) = {-2 + r, 0, 0, h}; Point(4) = {2 - r, 0, 0, h};
Point(5) = {2 - r, r, 0, h}; Point(6) = {2, r, 0, h}; Point(7) = {2, 3, 0, h}; Point(8) = {-2, 3, 0, h};
Circle(1) = {1, 2, 3}; Line(2) = {3, 4}; Circle(3) = {4, 5, 6};
Line(4) = {6, 7}; Line(5) = {7, 8}; Line(6) = {8, 1};
Curve Loop(1) = {1 : 6}; Plane Surface(1) = {1};
Physical Surface("pad") = {1}; Physical Curve("foot") = {1 : 3};
Physical Curve("head") = {5}; Physical Curve("sides") = {4, 6};
"""


@pytest.mark.parametrize(("fillet", "h", "young", "told"), [(0.3, 1, 1e5, True), (1, 0.1, 1e3, False)])
def test_a_greatest_pressure_below_its_error(tmp_path, fillet, h, young, told):
    """Fillets beside a flat foot, touched within less than an edge: their pressure means nothing, as a warning says."""
    text = f"body pad E {young} nu 0.3\nobstacle foot plane 0 0 0 1\npressure head 100\n"
    run = part(tmp_path, FOOT.replace("h = 1; r = 0.3", f"h = {h}; r = {fillet}"), text)
    pressure = run.summary["estimates"]["contacts"][0]["pressureMax"]
    assert (pressure["error"] > pressure["value"]) is told
    said = "the error of the greatest pressure of foot plane is estimated at"
    warned = [text for text in run.summary["warnings"] if said in text]
    assert bool(warned) is told and all("it means nothing" in text for text in warned)
    assert run.summary["contacts"][0]["normalForce"] == pytest.approx(400, rel=1e-8)


def test_points_at_a_singular_edge_are_no_jumps(tmp_path):
    """The ends of a press fit are singular, as a warning says; the pressures there are no oscillation inside."""
    groups = "group seat faces 1\ngroup bore faces 7\ngroup end faces 3\ngroup rim faces 4\n"
    text = "body shaft E 210e3 nu 0.3\nbody hub E 210e3 nu 0.3\ncontact bore seat interference 0.02\n"
    text += "units mm MPa\nclamp rim\nclamp end\n"
    run = part(tmp_path, data("warnings/hub.geo"), groups + text, space=True)
    (warning,) = run.summary["warnings"]
    assert "the pressure grows without bound towards the edge" in warning
    within = r"within \d\.?\d? mm of it the contact carries about \d\d?0* N, a mean pressure of about \d\d?0* MPa$"
    assert re.search(within, warning)
