"""RESULTS.md: the tables that are written by hand, that test_numbers.py cannot run: every row, to its digits."""

import re
import shlex

import attraction
import campaign
import numpy as np
import pytest
import shapes
from contact.test_adhesion import MODULUS, SPHERE, R, flags
from contact.test_surfaces import MIRROR, PIN, mirrored, rings
from contact.test_two_bodies import confined
from docs.test_readme import RESULTS, fences, quoted, rows, section
from freefem import data, part, run
from input.test_parts import solve, turn, turn_in_space, vector
from scenes.test_examples import FOLDER, STEEL, example
from scenes.test_examples import solve as solve_parts
from scenes.test_scene_docs import agrees, number

from postprocess import closed_forms as forms

FIGURE = r"[−+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?: %)?"


def written(head):
    """The rows of the table whose head starts so."""
    (text,) = [text for text in RESULTS.split("\n\n") if f"\n| {head}" in f"\n{text}"]
    return rows(text)


def figures(*cells):
    """The numbers of cells as they are written, those in brackets left out."""
    return re.findall(FIGURE, re.sub(r"\(.*?\)|`.*?`", "", " ".join(cells)))


def same(found, texts):
    """The numbers that were found shall be those that are written, to their digits."""
    assert [agrees(*pair) for pair in zip(found, texts, strict=True)] == [True] * len(texts), (found, texts)


def within(found, texts):
    """No number shall be beyond its written bound."""
    assert (np.array(found) <= [number(text) for text in texts]).all(), (found, texts)


def each(head):
    """The rows of a table as parameters."""
    return pytest.mark.parametrize("row", written(head), ids=lambda row: row[0])


# ---------------------------------------------------------------- a published benchmark

PUNCH = data("results/punch.geo")
PUNCHED = data("results/punched.case")


@pytest.mark.parametrize(
    "row", [row for row in written("rounded punch") if "package" in row[0]], ids=lambda row: row[0]
)
def test_rounded_punch(row, tmp_path):
    """The axial displacement and stress in the middle of the contact; on a finer mesh than the published ones."""
    order, *sizes = re.findall(r"[\d.]+\d|\d", row[0])
    part(tmp_path, PUNCH, PUNCHED.format(order, *sizes), "-order", order, "-estimate", 0)
    line = np.genfromtxt(tmp_path / "out/line-axis.csv", delimiter=",", names=True)[0]
    same([line["uy"], line["stressYY"]], figures(*row[1:]))


# ---------------------------------------------------------------- bodies that float


def pin(folder, edges, matrix):
    """The pin in its hole, pushed by a weight that turns with it."""
    push = matrix @ [1.0, -20.0, 0]
    case = f"{PIN}weight inner {float(push[0])!r} {float(push[1])!r}\n"
    return solve(folder, mirrored(rings(edges), matrix), case, "-order", 2).summary


def shape(folder, name, matrix, monkeypatch):
    monkeypatch.setattr(shapes, "turning", lambda *_: matrix)
    return solve_parts(folder, *shapes.mesh(name, folder), shapes.SHAPES[name].space).summary


def roller(folder, matrix):
    """The example, its mesh and its load turned."""
    mesh, case = folder / "roller.msh", folder / "roller.case"
    shapes.gmsh(FOLDER / "roller/roller.geo", mesh, "-2", matrix)
    text = (FOLDER / "roller/roller.case").read_text()
    assert "grip  0 -2000" in text
    case.write_text(text.replace("0 -2000", vector([0, -2000], matrix)))
    return solve_parts(folder, mesh, case, False, "-distance", "exact").summary


@each("case | directions")
def test_floating(row, tmp_path, monkeypatch):
    """The same counts in every direction."""
    name, *_ = quoted(row[0]) or figures(row[0])
    if "pin" in row[0]:
        runs = [pin(tmp_path, int(name), matrix) for matrix in (*map(turn, (0, 0.1, 1, 2.5)), MIRROR)]
    elif "roller" in row[0]:
        runs = [roller(tmp_path, turn(angle)) for angle in (0, 1)]
        assert {done["rounds"] for done in runs} == {8}
    else:
        matrices = (np.eye(3), turn_in_space(1), turn_in_space(2))
        runs = [shape(tmp_path, name, matrix, monkeypatch) for matrix in matrices]
    assert {f"{done['newton']} / {done['backsolves']}" for done in runs} == {row[2]}


# ---------------------------------------------------------------- Hertz


def measured(start):
    """The numbers of the row of the second table on Hertz that starts so."""
    (cell,) = [row[1] for row in written("case | measured") if row[0].startswith(start)]
    return figures(cell)


def test_nodal_patch():
    moduli = [100 * 0.7 / (1.3 * 0.4)] * 2
    exact = confined(1e3, 3, -0.25, 2, (20, 10), moduli)
    runs = [run(scene, "-points", "nodal") for scene in ("patch-test", "patch-test-3d")]
    same([abs(done.contact["pressure"] / exact - 1).max() for done in runs], measured("the same, `-points"))


def test_exchanged():
    found = []
    for h in (0.2, 0.1):
        given = ["-order", 2, "-force", 0, "-u0", 0.4, "-h", h]
        for bodies in (["-E2", 300, "-R2", 8], ["-E1", 300, "-E2", 100, "-R1", 8, "-R2", 10]):
            found.append(run("two-cylinders", *given, *bodies).force)
        found.append(h)
    same(found, measured("`two-cylinders -force"))


def test_turned_press_fit(tmp_path):
    exact = forms.press_fit((10, 20, 30), 0.002, (210e3, 0.3), (210e3, 0.3))
    turned = [example("press-fit", tmp_path, turn=angle) for angle in (0, 0.03, 0.1, 0.37, 1.1)]
    off = np.concatenate([case.contact["pressure"] for case in turned]) / exact - 1
    same([off.min(), off.max()], measured("[press fit]"))


def test_pin_under_five_forces(tmp_path):
    """The page's table too: half angle and greatest pressure."""
    worst = np.zeros(3)
    page = [row for row in rows((FOLDER / "pin-in-hole/README.md").read_text()) if row[0].isdigit()]
    for force, size, angle, _, _, greatest, *_ in page:
        case = example("pin-in-hole", tmp_path, f"0 -1000 |0 -{force} ", size=size)
        found = case.first["contactLength"] / 20.02, case.first["pressureMax"]
        same(found, (angle, greatest))
        half = forms.pin_angle(STEEL * 0.01 / float(force))
        scale = float(force) / 10.01
        exact = half, forms.pin_pressure(0, half) * scale
        along = np.arctan2(case.contact["x"], -case.contact["y"])
        inside = np.abs(along) < 0.9 * half
        profile = np.array([forms.pin_pressure(a, half) for a in along[inside]]) * scale
        off = np.abs(case.contact["pressure"][inside] - profile).max() / exact[1]
        worst = np.maximum(worst, [*abs(np.divide(found, exact) - 1), off])
    within(worst, measured("[pin in a hole]"))


def test_scatter():
    off = []
    for surface in ("smooth", "facets"):
        contact = run("two-cylinders", "-order", 2, "-h", 0.025, "-surface", surface).contact
        contact = contact[abs(contact["x"]) < 0.8]
        ratio = contact["pressure"] / np.sqrt(1 - contact["x"] ** 2)
        off.append(abs(ratio / np.polyval(np.polyfit(contact["x"], ratio, 8), contact["x"]) - 1).max())
    within(off, measured("pressure over"))


# ---------------------------------------------------------------- attraction


def follow(mu, element, *more):
    """The loop of a row of the table: the run, pi w R."""
    order, h = element.split(", ")
    size = float(h.split(" ")[0]) * (mu**1.5 if "√" in h else 1)
    far = -max(2.641 * mu ** (3 / 7), 1.65 * mu + 0.2) - 0.5
    given, unit = flags(mu, (far, 0.6 * mu + 0.5, far), per_length=size, order=int(order[1]))
    return run(SPHERE, *given, *more), unit


LOOPS = written("μ | element, h")
TEXT = section(RESULTS, "Attraction")


def test_command_of_a_loop():
    """The command on the page shall be that of the table's row."""
    (line,) = [line for block in fences(TEXT, "text") for line in block.splitlines() if "adhesive-sphere" in line]
    words = shlex.split(line)[2:]
    done, _ = follow(1, "P2, 0.1")
    for name, value in zip(words[::2], words[1::2], strict=True):
        used = done.parameters[name[1:]]
        numbers = [str(text).split() for text in (value, used)]
        assert [*map(float, numbers[0])] == pytest.approx([*map(float, numbers[1])], rel=1e-3), name


@pytest.mark.parametrize("mu", [0.05, 0.3, 1, 2, 3])
def test_size_of_the_block(mu):
    """Half and three times as wide and deep."""
    element = next(cell for tabor, cell, *_ in LOOPS if float(tabor) == mu and cell.startswith("P2"))
    sizes = ([], ["-width", 10, "-depth", 10], ["-width", 60, "-depth", 60])
    pulls = [follow(mu, element, *size)[0].pullOff for size in sizes]
    within(abs(np.array(pulls[1:]) / pulls[0] - 1), re.findall(r"by less than (\S+ %)", TEXT) * 2)


def test_random_loads(tmp_path):
    """Every load of the campaign shall come to a stable state, in the steps that the page tells."""
    cases, file = [attraction.load(k) for k in range(200)], tmp_path / "loads.csv"
    found = campaign.run(cases, file, columns=["stability"], measure=lambda *_: attraction.stability)
    assert all(row["status"] == "converged" and float(row["stability"]) > 0 for row in found)
    newton, solves = (np.array([int(row[name]) for row in found]) for name in ("newton", "backsolves"))
    (told,) = re.findall(r"in (\S+) linearisations.*?, (\d+) at most, (\S+) back-sub.*?, (\d+) at most", TEXT, re.S)
    same([newton.mean(), newton.max(), solves.sum() / newton.sum(), (solves / newton).max()], told)


def test_pull_off_in_the_plane():
    """The cylinder's command shall come to its end, and its least force to JKR's."""
    (line,) = re.findall(r"`(adhesive-cylinder .*?)`", TEXT)
    (bound,) = re.findall(r"JKR.* to (\S+ %)", TEXT)
    scene, *given = shlex.split(line)
    done = run(scene, *given)
    exact = -0.75 * (4 * np.pi * MODULUS * done.parameters["w"] ** 2 * R) ** (1 / 3)
    assert len(done.jumps) == 1
    within([abs(done.pullOff / exact - 1)], [bound])
