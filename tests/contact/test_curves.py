"""Load curves of cases with friction, load phases and bolts: columns of series.csv, energies, curve, hysteresis."""

import argparse
from math import atan, exp, pi, radians, sqrt, tan

import numpy as np
import pytest
from freefem import ROOT, cases_of, data, part
from input.test_parts import Mesh, block

from contact.test_friction import case, series
from postprocess import style
from postprocess.command_line import main
from postprocess.commands import hysteresis
from postprocess.formatting import Units
from postprocess.load_series import driving_load, load_curves, read_series
from postprocess.results import read_run

PUNCH = data("curves/punch.geo")
ONE = (
    PUNCH.split("Rectangle(2)")[0]
    + """
Physical Surface("base") = {1}; Physical Curve("bottom") = {1}; Physical Curve("top-of-base") = {3};
Physical Curve("side") = {4}; Mesh.MeshSizeMax = 0.5;
"""
)
PUNCHED = """body base E 1000 nu 0.3
body punch E 1000 nu 0.3
contact foot top-of-base friction 0.3
clamp bottom
leg 4
move head 0 -0.01
leg 4
move head 0.01 -0.01
leg 4
move head -0.01 -0.01
"""


def area(run, *names):
    """The areas under the curves of these loads and motions, added up; of all without a name."""
    found = {each.name: each for each in load_curves(read_series(read_run(run.folder)))}
    return sum(found[name].work()[-1] for name in names or found)


def test_columns_of_a_path(tmp_path, capsys):
    """Press, pull to and fro: rows are in balance; the area under the curves is the work; hysteresis finds the pull."""
    run = case(tmp_path, PUNCH, PUNCHED)
    rows = series(run)
    along, across = rows["move head x displacement"], rows["move head y displacement"]
    assert along == pytest.approx(0.01 * np.array([0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 0.5, 0, -0.5, -1]), abs=1e-12)
    assert across == pytest.approx(-0.01 * np.array([0.25, 0.5, 0.75, 1, *[1] * 8]), abs=1e-12)
    for axis in "xy":
        held, needed = rows[f"clamp bottom force {axis}"], rows[f"move head {axis} reaction"]
        assert held == pytest.approx(rows[f"foot top-of-base force {axis}"], abs=1e-7)
        assert held == pytest.approx(-needed, abs=1e-7)
    assert rows["foot top-of-base force y"] == pytest.approx(rows["foot top-of-base normal force"], rel=1e-9)
    assert run.summary["prescribed"][0]["force"] != 0 and rows["move head x reaction"][7] > 1
    assert area(run) == pytest.approx(rows["work"][-1], rel=2e-3)
    assert rows["work"] == pytest.approx(rows["stored"] + rows["dissipated"], rel=1e-3)
    assert driving_load(read_series(read_run(run.folder))).name == "move head x"
    assert main(["hysteresis", str(run.folder)]) == 0 and main(["curve", str(run.folder)]) == 0
    assert "move head x: greatest 1." in capsys.readouterr().out
    assert main(["hysteresis", str(run.folder), "--along", "move"]) == 2
    asked = argparse.Namespace(along=None, slide=False, slip=False, contact=0)
    units = Units(run.summary, ("mm", "MPa"))
    axes = hysteresis.draw(read_run(run.folder), style.Units("mm", "MPa"), asked, units).axes
    assert axes[0].get_title(loc="right").startswith(f"energy [{units.energy}]: ") and units.energy
    assert axes[1].get_title(loc="left") == f"(b) {run.summary['contacts'][0]['name']}"
    assert "move: no load or motion; allowed: move head x, move head y" in capsys.readouterr().err


def test_phases_without_friction(tmp_path):
    """The state at the end is that of its loads alone; all of the work is stored."""
    phases = PUNCHED.replace(" friction 0.3", "").replace("leg 4", "leg 2")
    run = case(tmp_path / "phases", PUNCH, phases)
    lines = phases.split("leg 2\n")
    once = case(tmp_path / "once", PUNCH, lines[0] + lines[-1])
    for name in ("force", "normalForce", "pressureMax"):
        found, expected = (each.summary["contacts"][0][name] for each in (run, once))
        assert found == pytest.approx(expected, rel=1e-6)
    rows = series(run)
    assert rows["work"] == pytest.approx(rows["stored"], rel=1e-9) and rows["dissipated"].max() == 0
    assert area(run) == pytest.approx(rows["stored"][-1], rel=1e-6)


LOADED = """body base E 1000 nu 0.3
body punch E 1000 nu 0.3
contact foot top-of-base friction 0.5
clamp bottom
leg 2
traction head 0 -4
weight base 0 -1
leg 2
traction head 0.5 -4
weight base 0 -3
"""


def test_columns_of_loads(tmp_path):
    """Tractions that change direction have columns by axis; a weight keeps its own, its displacement is its work."""
    rows = series(case(tmp_path, PUNCH, LOADED))
    assert rows["traction head x reaction"] == pytest.approx([0, 0, 0.25, 0.5], abs=1e-9)
    assert rows["traction head y reaction"] == pytest.approx([-2, -4, -4, -4], rel=1e-9)
    assert rows["weight base"] == pytest.approx([0.5, 1, 2, 3])
    assert not {"traction head x displacement", "traction head z"} & set(rows.dtype.names)
    assert rows["weight base reaction"] == pytest.approx([4, 8, 16, 24], rel=1e-9)
    carried = rows["traction head y reaction"] - rows["weight base reaction"]
    assert rows["clamp bottom force y"] == pytest.approx(-carried, rel=1e-6)
    assert (np.diff(rows["weight base displacement"]) > 0).all()


BEAM = "state stress\nbody beam E 1000 nu 0\nobstacle bottom plane 0 -3 0 1\nclamp left\n"
BACK = {  # first phase, second phase, values, displacement by value, reaction by value
    "moment right": ("1", "-1", (1, -1), 0.048, 1),
    "traction right": ("2 0", "-4 0", (2, -4), 0.004, 1),
    "pressure right": ("-3", "2", (-3, 2), 0.004, 1),
    "force right": ("-2 0 free", "4 0 free", (2, -4), 0.004, 1),
    "traction  right": ("-4 0", "2 0", (4, -2), 0.004, 1),
}


@pytest.mark.parametrize("load", cases_of([*BACK][:3], [*BACK]))
def test_a_load_that_reverses(tmp_path, load):
    """A beam of 4 by 1, E 1000: value, displacement and reaction change their sign together; the area is the energy."""
    first, second, values, way, reaction = BACK[load]
    mesh = block(Mesh(), size=(4, 1), cells=(4, 1), at=(0, -0.5), name="beam").text()
    run = case(tmp_path, mesh, f"{BEAM}leg 1\n{load} {first}\nleg 1\n{load} {second}\n", "-estimate", 1)
    rows, name, values = series(run), " ".join(load.split()), np.array(values)
    assert rows[name] == pytest.approx(values, rel=1e-9)
    assert rows[f"{name} displacement"] == pytest.approx(way * values, rel=1e-6)
    assert rows[f"{name} reaction"] == pytest.approx(reaction * values, rel=1e-6)
    energy = 0.5 * way * reaction * values**2
    assert rows["work"] == pytest.approx(energy, rel=1e-6) and rows["stored"] == pytest.approx(energy, rel=1e-6)
    (curve,) = load_curves(read_series(read_run(run.folder)))
    assert curve.work()[1:] == pytest.approx(energy, rel=1e-6)
    told = abs(values[1]) if not name.startswith("pressure") else values[1]
    (entry,) = run.summary["prescribed"]
    assert entry["force" if "force" in entry else "moment"] == pytest.approx(told, rel=1e-6)


def test_moment_of_a_rigid_end(tmp_path):
    """The same beam in a load series, its end rigid: a moment below 0 turns it by a negative angle."""
    mesh = block(Mesh(), size=(4, 1), cells=(4, 1), at=(0, -0.5), name="beam").text()
    rows = series(case(tmp_path, mesh, f"{BEAM}moment right -1 rigid\n", "-history", 1, "-steps", 1))
    for word, number in {"": -1, " displacement": -0.048, " reaction": -1}.items():
        assert rows[f"moment right{word}"] == pytest.approx([number], rel=1e-6)


SPRUNG = """state stress
body low E 1000 nu 0
body up E 1000 nu 0
contact ubottom top
symmetry bottom
symmetry left
symmetry uleft
spring utop 0 400
leg 1
pressure utop 2
{}leg 1
pressure utop {}
"""
BLOCKS = 1000.0  # stiffness of two blocks of height 1 and width 2, one on the other


def sprung(folder, last, *flags, first=""):
    mesh = block(block(Mesh(), (2, 1), (4, 2), name="low"), (2, 1), (4, 2), (0, 1), "u", "up").text()
    return case(folder, mesh, SPRUNG.format(first, last), *flags)


def test_pressure_on_a_spring_reverses(tmp_path):
    """Two blocks and a spring: pressed they share the load, pulled only the spring carries it."""
    run = sprung(tmp_path, -3)
    rows = series(run)
    expected = {"": [2, -3], " displacement": [4 / (BLOCKS + 400), -6 / 400], " reaction": [4, -6]}
    for word, numbers in expected.items():
        assert rows[f"pressure utop{word}"] == pytest.approx(numbers, rel=1e-5)
    assert rows["stored"] == pytest.approx([0.5 * 4**2 / (BLOCKS + 400), 0.5 * 6**2 / 400], rel=1e-5)
    assert "  pressure utop                          -6 of the whole 2 times as much: -12" in run.stdout


@pytest.mark.parametrize("last, name", [("1", "pressure utop"), ("0\ntraction utop 0 -1", "traction utop")])
def test_results_are_of_the_last_phase(tmp_path, last, name):
    """Load and load-point displacement on the screen are those of the end, not of a phase before."""
    run = sprung(tmp_path, last, "-estimate", 1, first="traction utop 0 0\n" * ("traction" in last))
    (load,), (way,) = run.summary["prescribed"], run.summary["estimates"]["loads"]
    assert load["name"] == way["name"] == name and load["force"] == pytest.approx(2, rel=1e-9)
    assert way["way"]["value"] == pytest.approx(2 / (BLOCKS + 400), rel=1e-5)
    assert way["way"]["value"] == pytest.approx(series(run)[f"{name} displacement"][-1], rel=1e-5)


BELT = data("friction-bodies/belt.geo")
BELTED = """body belt E 2000 nu 0.3
obstacle inner circle 0 0 R 10 friction 0.3
leg 1
traction slack 0 -1
move tight 0 -0.3
leg 3
traction slack 0 -1
move tight 0 -0.6
"""


def test_belt_as_a_curve(tmp_path):
    """Where all of it slips, the tensions' ratio in each row is e^(mu theta), of a belt of this thickness: see
    test_friction_bodies.py; what the pull does beyond what it lifts goes into friction."""
    rows = series(case(tmp_path, BELT.replace("0.2 * k", "0.05 * k"), BELTED))
    middle, mu, thick = 10.025, 0.3, 0.05
    rate = (sqrt(middle**2 + 20 * mu**2 * thick) - middle) / (mu * thick)
    ratio = rows["move tight reaction"] / rows["traction slack reaction"]
    assert ratio == pytest.approx(np.full(4, exp(rate * pi)), rel=2e-3)
    assert ratio[-1] == pytest.approx(exp(mu * pi), rel=0.01)
    lost = np.diff(rows["dissipated"])
    work = 0.1 * 0.5 * (rows["move tight reaction"][1:] + rows["move tight reaction"][:-1])
    lifted = -np.diff(rows["traction slack displacement"]) * rows["traction slack reaction"][1:]
    assert lost == pytest.approx(work - lifted - np.diff(rows["stored"]), rel=1e-3)


HOOK = ROOT / "edp/examples/snap-hook/snap-hook.geo"
CLIPPED = """units mm MPa
state stress
body hook E 2600 nu 0.35
clamp root
size ramp 0.03
leg 10
obstacle ramp circle 22 -4.964101615 R 5 move -0.5 0FRICTION
leg 10
obstacle ramp move 0 0
"""


@pytest.fixture(scope="module")
def clips(tmp_path_factory):
    found = {}
    for mu in (0, 0.2):
        text = CLIPPED.replace("FRICTION", f" friction {mu}" if mu else "")
        folder = tmp_path_factory.mktemp("clip")
        found[mu] = case(folder, HOOK, text, "-distance", "exact")
    return found


def test_clip_in_and_out(clips, capsys):
    """Friction turns the contact force by its angle, against the motion; the loop is what friction dissipates."""
    for mu, run in clips.items():
        rows = series(run)
        slope = rows["ramp circle force x"][:-1] / -rows["ramp circle force y"][:-1]
        angle = radians(30) + np.arctan(mu) * np.sign(9.5 - np.arange(19))
        turned = np.arctan(slope) - angle  # the ramp's own rotation: small, and nearly that of its deflection
        assert np.abs(turned).max() < 0.06 and (mu or turned[9] == pytest.approx(turned[8], abs=0.01))
        way = np.append(0, rows["obstacle ramp displacement"])
        force = np.append(0, rows["obstacle ramp reaction"])
        done = (0.5 * (force[1:] + force[:-1]) * np.diff(way)).sum()
        assert done == pytest.approx(rows["dissipated"][-1], rel=0.15, abs=1e-5)
        assert area(run) == pytest.approx(done, rel=1e-9)
    free, rubbed = (series(clips[mu])["obstacle ramp reaction"][:10] for mu in (0, 0.2))
    assert rubbed / free == pytest.approx(np.full(10, tan(radians(30) + atan(0.2)) / tan(radians(30))), rel=0.15)
    assert main(["curve", str(clips[0.2].folder)]) == 0
    greatest = series(clips[0.2])["obstacle ramp reaction"].max()
    assert f"obstacle ramp: greatest {greatest:.5g} N/mm at 0.5 mm" in capsys.readouterr().out


# ---------------------------------------------------------------- bolts

BOLT = data("engineer/bolt.geo")
SIDE = BOLT + 'Physical Curve("side") = {22};\n'
JOINT = data("engineer/joint.case").replace("seat under", "seat under friction 0.2")
SHANK, SLEEVE = 100.0, 75.0  # stiffnesses, under a rigid head
SHARE = SHANK / (SHANK + SLEEVE)


def test_joint_diagram_with_friction(tmp_path):
    """Tightened, heated, then pulled: tension and clamping force of each row, and the energies, in closed form."""
    text = f"{JOINT}expand sleeve 1e-4 50\nleg 4\ntraction top 0 0\nleg 2\ntraction top 0 2\n"
    run = case(tmp_path, BOLT, text, "-estimate", 1)
    rows = series(run)
    heat = 0.05 * SHANK * SLEEVE / (SHANK + SLEEVE) * np.array([0, 0.25, 0.5, 0.75, 1, 1, 1])
    load = np.array([0, 0, 0, 0, 0, 3, 6])
    assert rows["traction top reaction"] == pytest.approx(load, abs=1e-9)
    assert rows["preload cut force"] == pytest.approx(20 + heat + load * SHARE, rel=1e-6)
    assert rows["seat under normal force"] == pytest.approx(20 + heat - load * (1 - SHARE), rel=1e-6)
    tension, clamp = rows["preload cut force"], rows["seat under normal force"]
    # friction hinders the sleeve's expansion along the seat a little
    assert rows["stored"] == pytest.approx(tension**2 / (2 * SHANK) + clamp**2 / (2 * SLEEVE), rel=5e-4)
    assert rows["stored"][:1] == pytest.approx(20**2 / (2 * SHANK) + 20**2 / (2 * SLEEVE), rel=1e-6)
    assert rows["work"] == pytest.approx(rows["stored"] + rows["dissipated"], rel=1e-5)
    assert rows["step"][0] == rows["leg"][0] == 0
    (one,) = run.summary["preloads"]
    assert abs(one["force"] - tension[-1]) < 1e-9 and 0 < one["error"] < 1e-3 * one["force"]
    assert abs(one["shortened"] - 20 / SHANK - 20 / SLEEVE) < 1e-6 and one["shortenedError"] < 1e-6
    assert any("(1.5, 10)" in warning for warning in run.summary["warnings"])  # the edge of the head: no bound


def test_bolt_that_follows_a_force_in_phases(tmp_path):
    """The head follows the force as one: the tightened shank loads that motion, too."""
    text = f"{JOINT}leg 2\nforce top 0 9\ntraction side 0 0\nleg 1\ntraction side 0.001 0\n"
    rows = series(case(tmp_path, SIDE, text))
    load = np.array([0, 4.5, 9, 9])
    assert rows["force top reaction"] == pytest.approx(load, abs=1e-9)
    assert rows["preload cut force"] == pytest.approx(20 + load * SHARE, rel=1e-4)
    assert np.diff(rows["force top displacement"][:3]) == pytest.approx(np.full(2, 4.5 / (SHANK + SLEEVE)), rel=1e-4)


@pytest.mark.parametrize("pull, code", [(0.3, 0), (0.33, 20)])
def test_joint_slips(tmp_path, pull, code):
    """Under an axial load of 10 the seat bears 0.02 of what clamps it, 0.314, and no more."""
    axial = "leg 2\ntraction top 0 3.3333333333\n"
    text = f"{JOINT.replace('0.2', '0.02')}{axial}traction side 0 0\n{axial}"
    run = case(tmp_path, SIDE, f"{text}traction side {-pull / 10} 0\n", expect=code)
    assert code or abs(series(run)["seat under force x"][-1]) == pytest.approx(pull, rel=1e-3)
    assert not code or "sleeve: along x: no equilibrium" in run.message


SLEEVE_BOLT = ROOT / "edp/examples/bolted-sleeve/bolted-sleeve.geo"
SLEEVED = """units mm MPa
state axisymmetric
group under between bolt sleeve
group cut plane 2.5 20 0 1
group middle plane 0 0 0 1
group top plane 0 47 0 1
body bolt E 210e3 nu 0.3
body sleeve E 210e3 nu 0.3
contact seat under friction 0.15
symmetry middle
preload cut 20e3
"""
LATER = {"pulled": "force top 0 10e3\n", "heated": "expand sleeve 12e-6 100\n"}


def off(found, fine, name, error):
    return abs(found[name] - fine[name]) / found[error]


@pytest.mark.parametrize("later", LATER)
@pytest.mark.parametrize("order", [1, 2])
def test_errors_of_a_preload(tmp_path, later, order):
    """Against P4 on elements a third as large: inside ±, which is no more than ten times as large."""
    text = SLEEVED + LATER[later]
    coarse = case(tmp_path / "coarse", SLEEVE_BOLT, text, "-set", "size", 2.5, "-order", order, "-estimate", 1)
    fine = case(tmp_path / "fine", SLEEVE_BOLT, text, "-set", "size", 0.8, "-order", 4)
    found, true = (run.summary["preloads"][0] for run in (coarse, fine))
    assert 0.1 < off(found, true, "shortened", "shortenedError") < 1
    assert off(found, true, "force", "error") < 1 and found["error"] < 0.02 * found["force"]
    known = coarse.summary["estimates"]["contacts"][0]["normalForce"]["error"]
    forces = [run.summary["contacts"][0]["normalForce"] for run in (coarse, fine)]
    assert abs(forces[0] - forces[1]) < known < 0.02 * forces[1]


TWO_BOLTS = data("curves/two-bolts.geo")
TWO_BOLTED = """state stress
body frame E 1000 nu 0.3
body block E 500 nu 0.3
contact seat under friction 0.1
clamp foot
preload cut1 27
preload cut2 30
expand frame 1e-4 -40
leg 2
traction top 0.2 0
stresses
"""


def test_errors_of_two_preloads(tmp_path):
    """Each shortening depends on both tensions. The stress has the errors of the shortenings, too."""
    coarse = case(tmp_path / "coarse", TWO_BOLTS, TWO_BOLTED, "-estimate", 1)
    fine = case(tmp_path / "fine", TWO_BOLTS, TWO_BOLTED, "-order", 4, "-set", "size", 0.35)
    for found, true in zip(coarse.summary["preloads"], fine.summary["preloads"], strict=True):
        assert 0.1 < off(found, true, "shortened", "shortenedError") < 1
        assert off(found, true, "force", "error") < 1 and found["error"] < 0.01 * found["force"]
    found, true = (run.summary["stresses"][0] for run in (coarse, fine))
    assert off(found, true, "vonMises", "error") < 1


ROUND_BOLT = """SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 6, 2, Pi/2};
Cylinder(2) = {0, 0, 6, 0, 0, 1, 3, Pi/2};
Mesh.MeshSizeMax = 1.5;
"""
ROUND = """group shank volumes 1
group head volumes 2
group x plane 0 0 0 1 0 0
group y plane 0 0 0 0 1 0
group foot plane 0 0 0 0 0 1
group seat plane 0 0 6 0 0 1
body shank E 200 nu 0
body head E 200e6 nu 0
join shank head part
symmetry x
symmetry y
clamp foot
obstacle seat plane 0 0 6 0 0 1
cut waist shank plane 0 0 3 0 0 1
preload waist 10
"""


def test_errors_of_a_round_bolt(tmp_path):
    """Curved elements in front of the cut open as it does: a uniform strain has no error but that of the curves."""
    (tmp_path / "bolt.geo").write_text(ROUND_BOLT)
    run = case(tmp_path, tmp_path / "bolt.geo", ROUND, "-estimate", 1, space=True)
    found = run.summary["preloads"][0]
    exact = 10 * 6 / (200 * pi)
    assert found["shortened"] == pytest.approx(exact, abs=found["shortenedError"])
    assert 0 < found["shortenedError"] < 2e-3 * exact and 0 < found["error"] < 0.05


def test_an_interrupted_path_with_a_bolt(tmp_path):
    """It goes on with the shortenings that it has found, and says that its errors are not known."""
    text = f"{JOINT}leg 2\ntraction top 0 1\nleg 2\ntraction top 0 3\n"
    whole = case(tmp_path / "whole", BOLT, text)
    folder = tmp_path / "cut"
    part(folder, BOLT, text, "-estimate", 0, "-maxNewton", 60)
    again = part(folder, BOLT, text, "-estimate", 0, "-maxNewton", 60)
    assert "complete" in again.stdout
    assert series(again)["preload cut force"] == pytest.approx(series(whole)["preload cut force"], rel=1e-9)


def test_bolt_in_space_with_friction(tmp_path):
    """The joint diagram in space: tension and clamping force of each row."""
    text = JOINT.replace("state stress\n", "").replace("symmetry axis\n", "symmetry axis\nsymmetry side\n")
    run = case(tmp_path, data("engineer/bolt-in-space.geo"), f"{text}leg 2\ntraction top 0 0 3\n", space=True)
    rows = series(run)
    load = rows["traction top reaction"]
    shank, sleeve = 100.0, 500 * rows["seat under size"][0] / 10
    share = shank / (shank + sleeve)
    assert rows["preload cut force"] == pytest.approx(20 + share * load, rel=1e-3)
    assert rows["seat under normal force"] == pytest.approx(20 - (1 - share) * load, rel=1e-3)


def test_strains_that_are_not_small(tmp_path):
    """A bar that its load shortens by 12 % says so; by 8 % it does not."""
    bar = "body base E 1000 nu 0\nobstacle top-of-base plane 0 0 0 -1\n"
    for pressure, told in ((120, 1), (80, 0)):
        run = case(tmp_path, ONE, f"{bar}pressure bottom {pressure}\nsymmetry side\n")
        said = [warning for warning in run.summary["warnings"] if "strains are taken to be small" in warning]
        assert len(said) == told and all(warning.startswith("base: strains of 12 %") for warning in said)


def test_no_curve_of_a_plastic_case(tmp_path, capsys):
    """The advice names the columns that its series has, and no flag that the case refuses."""
    mesh = block(Mesh(), cells=(2, 1)).text()
    text = "body block E 1000 nu 0.3\nplastic block 1 150\nsymmetry bottom\nsymmetry left\n"
    run = case(tmp_path, mesh, f"{text}leg 1\nobstacle top plane 0 2 0 -1 move 0 -0.01\n")
    assert main(["curve", str(run.folder)]) == 2
    said = capsys.readouterr().err
    assert "a plastic case writes none: its energies are in the columns work, stored and dissipated" in said
    assert "-history" not in said and {"work", "stored", "dissipated"} < set(series(run).dtype.names)


@pytest.mark.parametrize(
    "line, words",
    [
        ("leg", "the number of steps is missing after leg; allowed: leg STEPS, as leg 8"),
        ("obstacle seat ring 1 2 3", "allowed: plane x y nx ny, circle x y R r, as obstacle top circle 0 12 R 10 move"),
        ("obstacle seat circle 1 2 3 law", "as law power kappa 1e6 m 3 d0 -0.001"),
        ("group more faces 3", "faces: unknown; a case in space is run by edp/parts-3d.edp; allowed: group"),
    ],
)
def test_refusals_with_examples(tmp_path, line, words):
    run = case(tmp_path, BOLT, f"{JOINT}{line}\n", expect=10)
    assert words in run.stdout


def test_curve_of_a_thick_body(tmp_path, capsys):
    """Forces of a curve are those of a unit of thickness: a line says so, and how much all of it carries."""
    run = case(tmp_path, PUNCH, "thickness 4\n" + PUNCHED)
    assert main(["curve", str(run.folder)]) == 0
    assert "are of a unit of thickness; all 4 carry 4 times as much" in capsys.readouterr().out
