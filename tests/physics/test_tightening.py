"""Bolts that are tightened one after the other: springs, errors, friction, mirrored order, refusals."""

from math import pi

import numpy as np
import pytest
from contact.test_curves import JOINT, SIDE, TWO_BOLTED, TWO_BOLTS
from contact.test_friction import case, series
from freefem import data

from postprocess.command_line import main

RINGS = """state axisymmetric
body shank E 1000 nu 0
body tube E 300 nu 0
body sleeve E 500 nu 0
body heads E 1e8 nu 0
clamp foot
contact "under inner" end
contact "under outer" end
preload inner 10
preload outer 7
"""
# stiffnesses of rods: area times modulus over length
BOLTS = {"inner": 1000 * pi / 10, "outer": 300 * pi * (16 - 3.2**2) / 10}
SLEEVE = 500 * pi * (9 - 1.2**2) / 9
FULL = {"inner": 10.0, "outer": 7.0}


def springs(order):
    """Forces of two bolts on a spring after each step: tightening one by dF takes dF k/(k + sleeve) from the other."""
    force, rows = dict.fromkeys(BOLTS, 0.0), []
    for name, fraction in order:
        (other,) = BOLTS.keys() - {name}
        change, force[name] = fraction * FULL[name] - force[name], fraction * FULL[name]
        force[other] = max(0.0, force[other] - change * BOLTS[other] / (BOLTS[other] + SLEEVE) * (force[other] > 0))
        rows.append([force["inner"], force["outer"]])
    return np.array(rows)


def forces(run):
    return np.array([one["forces"] for one in run.summary["tightening"]])


ORDERS = {
    "two passes": ("tighten inner outer\ntighten inner outer\n", [("inner", 1), ("outer", 1)] * 2),
    "in part": (
        "tighten outer inner to 0.5\ntighten outer inner outer\n",
        [("outer", 0.5), ("inner", 0.5), ("outer", 1), ("inner", 1), ("outer", 1)],
    ),
}


@pytest.mark.parametrize("name", ORDERS)
def test_two_bolts_over_a_spring(name, tmp_path):
    """An inner bolt and a tube around a sleeve, all rods, with stiff heads."""
    lines, order = ORDERS[name]
    run = case(tmp_path, data("tightening/rings.geo"), RINGS + lines)
    assert forces(run) == pytest.approx(springs(order), rel=5e-5)
    last = forces(run)[-1]
    assert [one["force"] for one in run.summary["preloads"]] == pytest.approx(last, rel=1e-9)
    steps = [(bolt, fraction * FULL[bolt]) for bolt, fraction in order]
    assert [(row["name"], row["to"]) for row in run.summary["tightening"]] == steps
    printed = [line.split() for line in run.stdout.splitlines() if line.startswith(f"  1 {order[0][0]} ")]
    assert printed[0][:3] == ["1", order[0][0], f"{steps[0][1]:g}"] and "tightened to" not in run.stdout


SEQUENCE = TWO_BOLTED + "tighten cut1 cut2 to 0.6\ntighten cut1 cut2\n"
SEQUENCE = SEQUENCE.replace("leg 2\ntraction top 0.2 0\nstresses\n", "")  # with friction, two bolts in turn


@pytest.mark.parametrize("friction", [" friction 0.1", ""], ids=["friction", "none"])
def test_errors_of_a_sequence(friction, tmp_path):
    """Against elements a third as large: the forces after each step, and the shortenings at the end, inside ±."""
    text = SEQUENCE.replace(" friction 0.1", friction)
    coarse = case(tmp_path / "coarse", TWO_BOLTS, text, "-estimate", 1)
    fine = case(tmp_path / "fine", TWO_BOLTS, text, "-set", "size", 0.25)
    bound = np.array([one["errors"] for one in coarse.summary["tightening"]])
    off = np.abs(forces(coarse) - forces(fine))
    assert (off <= bound).all() and (bound.max(axis=1) > 1e-3).all() and bound.max() < 0.01 * forces(fine).max()
    for found, true in zip(coarse.summary["preloads"], fine.summary["preloads"], strict=True):
        assert 0.1 < abs(found["shortened"] - true["shortened"]) / found["shortenedError"] < 1
        assert abs(found["force"] - true["force"]) < found["error"] < 0.01 * found["force"]


def test_a_mirrored_order(tmp_path):
    """The mirror image, whose bolts are tightened in the mirrored order."""
    left, right = "{-3-e, Y-e, -e, -2+e, Y+e, e}", "{2-e, Y-e, -e, 3+e, Y+e, e}"
    mirror = TWO_BOLTS.replace("Mesh.MeshSizeMax", "Symmetry {1, 0, 0, 0} { Surface{:}; }\nMesh.MeshSizeMax")
    for y, here, there in (("5", left, right), ("4", right, left)):
        mirror = mirror.replace(here.replace("Y", y), there.replace("Y", y))
    runs = [case(tmp_path / str(k), geo, SEQUENCE, "-estimate", 0) for k, geo in enumerate((TWO_BOLTS, mirror))]
    first, second = map(forces, runs)
    assert first == pytest.approx(second, rel=2e-3)
    # the block is the pivot of a lever
    assert first[1][0] > 1.2 * 16.2 and first[1][1] == pytest.approx(18)


def test_a_joint_under_a_transverse_load(tmp_path, capsys):
    """Below the friction limit, 0.2 times 20, a part sticks; above all slips at it. Flat faces lose no force."""
    for move, slips in ((0.008, False), (0.5, True)):
        cycle = "".join(f"leg 2\nmove side {way * move} *\n" for way in (1, -1, 1, -1))
        run = case(tmp_path / str(move), SIDE, JOINT + cycle)
        rows = series(run)
        pull = np.abs(rows["seat under force x"])
        assert rows["preload cut force"] == pytest.approx(20, rel=1e-6) and (pull < 4 * (1 + 1e-6)).all()
        assert (rows["stickingPoints"][1:].min() == 0) == slips and (pull[1:].max() > 4 * (1 - 1e-6)) == slips
        assert main(["clamp", str(run.folder)]) == 0
        head, *lines = capsys.readouterr().out.splitlines()
        assert head == "leg  sticks   cut force: end, least, loss" and len(lines) == 5
        assert lines[-1].split()[0] == "4" and lines[-1].endswith(", 0.00 %")
        assert (lines[-1].split()[1] == "0.0%") == slips


def test_what_a_joint_loses(tmp_path, capsys):
    """A sleeve that is pulled out narrows and takes force from the bolt: the loss of each phase, as in series.csv."""
    bends = JOINT.replace("sleeve E 500 nu 0", "sleeve E 500 nu 0.3")
    run = case(tmp_path, SIDE, f"{bends}leg 2\nmove side 0.02 *\n")
    force = series(run)["preload cut force"]
    assert main(["clamp", str(run.folder)]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    loss = 100 * (1 - force[-1] / force[0])
    assert loss > 0.1 and last.endswith(f"{force[-1]:.6g}, {force[1:].min():.6g}, {loss:.2f} %")


def test_no_new_meshes(tmp_path):
    """The steps are those of one mesh."""
    said = case(
        tmp_path,
        data("tightening/rings.geo"),
        f"{RINGS}tighten inner outer\n",
        "-accuracy",
        0.05,
        "-estimate",
        1,
        expect=10,
    )
    assert "-accuracy 0.05: not with tighten; allowed: 0" in said.stdout
