"""Supports along axes: clamps of some components, and moves that leave some free. Closed forms, and symmetries."""

import numpy as np
import pytest
from fem.test_multigrid import built
from freefem import part

from input.test_parts import PLANE, STEEL, UNTURNED, Mesh, apart, block, bodies, cube, moved, solve, turn, two_blocks

ASIDE = 0.3 / 0.7  # of plane strain: what a bar of nu = 0.3 loses across itself, of its elongation
STACK = 'body block E 100 nu 0.3\nbody upper E 100 nu 0.3\ncontact top "upper bottom"\n'


def supports(run):
    """The forces of the supports by their names, and what prescribed motions need."""
    forces = {row["name"]: np.array(row["force"]) for row in run.summary["supports"]}
    return forces, {row["name"]: row["force"] for row in run.summary["prescribed"]}


def strained(result, part, gradient, shift=(0, 0, 0)):
    """How far the nodes of a body are from where these gradients of the displacement take them, of the greatest way."""
    places = np.array([result[name] for name in result if name.startswith(f"place-{part}-")])
    goal = places @ np.array(gradient, float).T + shift
    return abs(moved(result, f"{part}-") - goal).max() / abs(goal).max()


# ---------------------------------------------------------------- on the bodies alone


def held(group, x, y, turned=False):
    """The line that holds these components, None: it is free; turned by 90 degrees (x, y) is (-y, x)."""
    values = (None if y is None else -y, x) if turned else (x, y)
    if any(values):
        return f"move {group} {' '.join('*' if value is None else repr(value) for value in values)}\n"
    return f"clamp {group} {' '.join(axis for axis, value in zip('xy', values, strict=True) if value is not None)}\n"


@pytest.mark.parametrize("turned", [False, True])
def test_bars(tmp_path, turned):
    """Bars that are pulled or pressed between rollers are strained evenly; turned by 90 degrees the same."""
    bars = {  # the lines, the strains, where x = 0 and y = 0 go
        "pulled": ([("left", 0, None), ("bottom", None, 0), ("right", 0.03, None)], (0.01, -0.01 * ASIDE), (0, 0)),
        "both": ([("bottom", None, 0), ("bottom", 0.1, None)], (0, 0), (0.1, 0)),
        "pressed": ([("left", 0, None), ("bottom", None, 0)], (-0.0273, 0.0273 * ASIDE), (0, 0)),
        "driven": (
            [("left", 0, None), ("bottom", None, 0.02), ("right", -0.06, None)],
            (-0.02, 0.02 * ASIDE),
            (0, 0.02),
        ),
    }
    text = {name: STEEL + "".join(held(*line, turned) for line in bar[0]) + PLANE for name, bar in bars.items()}
    text["pressed"] += "pressure right 3\n"
    matrix = turn(np.pi / 2).round() if turned else UNTURNED
    mesh, case = apart(block, text)
    result, _ = bodies(tmp_path, mesh.text(matrix), case)
    assert result["balance"] < 1e-12
    for k, (name, (_, strains, way)) in enumerate(bars.items()):
        gradient = np.diag([*strains, 0])
        shift = [*way, 0] - gradient @ [5 * k, 0, 0]
        assert strained(result, name, matrix @ gradient @ matrix.T, matrix @ shift) < 1e-9, name


def test_cube_between_planes_along_no_axis(tmp_path):
    """In space, moved along an axis between two symmetries along no axis: nodes of both have turned dofs."""
    case = STEEL + "symmetry back\nsymmetry left\nclamp bottom z\nmove top * * -0.02\n"
    matrix = turn(0.5)
    result, _ = bodies(
        tmp_path, cube(Mesh()).text(matrix), case + "obstacle front sphere 100 100 100 R 1\n", space=True
    )
    assert strained(result, "block", matrix @ np.diag([0.006, 0.006, -0.02]) @ matrix.T) < 1e-9
    assert result["balance"] < 1e-11


def test_free_motions(tmp_path):
    """What clamps along axes leave free; those in enough directions leave nothing."""
    cases = {
        "slides": ("clamp left x\n", ["along y"]),
        "turns": ("clamp left y\n", ["along x", "rotation about another place than its middle"]),
        "stands": ("clamp left x\nclamp bottom y\n", []),
        "drawn": ("move left 0.1 *\n", ["along y"]),
        "hangs": ("clamp bottom x y\n", []),
    }
    mesh, case = apart(block, {name: STEEL + text + PLANE for name, (text, _) in cases.items()})
    _, stdout = bodies(tmp_path, mesh.text(), case)
    assert [line[6:] for line in stdout.splitlines() if line.startswith("free: ")] == [
        f"{name}: {motion}" for name, (_, free) in cases.items() for motion in free
    ]


DISAGREEING = """
clamp bottom y / move right 0.1 0.2 | clamp bottom y: line 3 moves its node at (3, 0) elsewhere; allowed: the same
move bottom * 0.2 / clamp right | move bottom y: line 3 moves its node at (3, 0) elsewhere; allowed: the same
clamp bottom y / move right * 0.2 | move right y: line 2 moves its node at (3, 0) elsewhere; allowed: the same motion
symmetry bottom / move right * 0.2 | symmetry bottom: line 3 moves its node at (3, 0) across it; allowed: along it
clamp bottom y / force right 1 2 | force right: it touches the clamp bottom y of line 2, across which it cannot follow
clamp bottom y / force right 1 0 rigid | which it cannot follow; allowed: a group that does not touch it
move bottom * 0.2 / force right 1 0 | move bottom y: line 3 moves its node at (3, 0) elsewhere
"""


@pytest.mark.parametrize("lines, words", [line.split(" | ") for line in DISAGREEING.strip().splitlines()])
def test_supports_that_disagree(tmp_path, lines, words):
    """Two groups that share a node which their statements take to different places, or that cannot follow a force."""
    case = STEEL + lines.replace(" / ", "\n") + "\n" + PLANE
    run = solve(tmp_path, block(Mesh(), cells=(3, 2)).text(), case, expect=10)
    assert words in run.stdout and run.stdout.count("\n") == 1 and not (tmp_path / "out").exists()


def test_move_off_the_axis(tmp_path):
    """About an axis nothing moves a node of the axis off it."""
    case = "state axisymmetric\n" + STEEL + "move bottom 0.1 *\nclamp right y\n" + PLANE
    said = solve(tmp_path, block(Mesh(), cells=(3, 2)).text(), case, expect=10).stdout
    assert "line 3: move bottom x: it moves its node at (0, 0) off the axis; allowed: along it" in said


# ---------------------------------------------------------------- with contact


@pytest.mark.parametrize("state, force", [("strain", 3 / 0.91), ("stress", 3), ("axisymmetric", 9 * np.pi)])
def test_two_blocks_on_rollers(tmp_path, state, force):
    """Two blocks pressed together by 1 %, free to widen: the force of uniaxial stress, whatever the third direction."""
    case = f"state {state}\n" + STACK + 'clamp bottom y\nmove "upper top" * -0.02\n'
    if state != "axisymmetric":
        case += 'clamp left x\nclamp "upper left" x\n'
    run = solve(tmp_path, two_blocks((12, 4), (19, 6)).text(), case, "-tol", 1e-10)
    forces, needed = supports(run)
    assert needed == {"move upper top y": pytest.approx(force, rel=1e-6)}
    assert forces["clamp bottom y"] == pytest.approx([0, force], rel=1e-6, abs=1e-9)
    assert forces["move upper top y"] == pytest.approx([0, -force], rel=1e-6, abs=1e-9)
    assert run.summary["outOfBalance"] < 1e-9
    assert "move upper top y (*, -0.02)" in solve(tmp_path, two_blocks().text(), case, "-check", 1).stdout


@pytest.mark.parametrize("flags", [(), pytest.param(("-solver", "multigrid"), marks=built)])
def test_two_cubes_on_rollers(tmp_path, flags):
    """In space, one of them under a traction too: the stress along z is less by nu times that."""
    mesh = cube(cube(Mesh()), cells=(5, 3, 2), at=(0, 0, 1), prefix="upper ", name="upper").text()
    case = STACK + 'clamp bottom z\nclamp back x\nclamp left y\nclamp "upper back" x\nmove "upper left" * 0.01 *\n'
    case += 'traction "upper front" 0.1 0 0\nmove "upper top" * * -0.02\n'
    run = solve(tmp_path, mesh, case, "-order", 1, "-tol", 1e-10, *flags, script="parts-3d.edp")
    forces, needed = supports(run)
    assert needed["move upper top z"] == pytest.approx(4 * (1 - 0.015), rel=1e-6)
    assert forces["clamp bottom z"] == pytest.approx([0, 0, 3.94], rel=1e-6, abs=1e-5)
    assert forces["clamp upper back x"] == pytest.approx([-0.2, 0, 0], rel=1e-6, abs=1e-5)
    others = [forces[name] for name in ("clamp back x", "clamp left y", "move upper left y")]
    assert np.abs(others).max() < 1e-5


def test_roller_is_no_mirror(tmp_path):
    """Half a block under a disc: a symmetry's forces are those of a roller, whose contact keeps its force across."""
    mesh, case = block(Mesh(), cells=(24, 16)).text(), STEEL + "{}\nmove bottom * 0.1\nobstacle top circle 0 5 R 3\n"
    half, whole = (
        part(tmp_path / line[:5], mesh, case.format(line), "-tol", 1e-10) for line in ("symmetry left", "clamp left x")
    )
    (mirrored, of_half), (forces, of_whole) = supports(half), supports(whole)
    assert of_whole == pytest.approx(of_half, rel=1e-8)
    assert forces["clamp left x"] == pytest.approx(mirrored["symmetry left"], rel=1e-6, abs=1e-9)
    (contact,), (other) = whole.summary["contacts"], half.summary["contacts"]
    assert contact["force"] == pytest.approx([-forces["clamp left x"][0], -of_whole["move bottom y"]], rel=1e-6)
    assert other[0]["force"][0] == 0 and other[0]["across"] == ["left"] and contact["across"] == []
    assert [run.summary["prescribed"][0]["times"] for run in (half, whole)] == [2, 1]
    errors = [run.summary["prescribed"][0]["error"] for run in (half, whole)]
    assert errors[1] == pytest.approx(errors[0], rel=0.1)


def test_squeezed_between_two_rollers(tmp_path):
    """A block that nothing lets widen: each side carries what it does in uniaxial strain, also the moved one."""
    case = STEEL + "clamp bottom y\nclamp right x\nmove left 0.03 *\nobstacle top plane 0 2 0 -1\n"
    forces, needed = supports(solve(tmp_path, block(Mesh()).text(), case, "-tol", 1e-10))
    stress = 100 * 0.7 / (1.3 * 0.4) * 0.01
    assert needed == {"move left x": pytest.approx(2 * stress, rel=1e-6)}
    assert forces["clamp right x"] == pytest.approx([-2 * stress, 0], rel=1e-6)
    assert forces["clamp bottom y"] == pytest.approx([0, 3 * stress * ASIDE], rel=1e-6)
    # under a disc the contact does not tell it
    forces, needed = supports(
        solve(tmp_path, block(Mesh()).text(), case.replace("plane 0 2 0 -1", "circle 0.7 4.95 R 3"))
    )
    assert abs(forces["clamp right x"] + forces["move left x"])[0] > 1e-3
    assert needed["move left x"] == pytest.approx(forces["move left x"][0], rel=1e-6)


UNDER_A_DISC = STEEL + "move bottom * {}\nmove left {} *\nobstacle top circle 0.7 5 R 3\n"


def test_slope_of_the_energy(tmp_path):
    """Each of two motions along axes needs the slope of the energy by it."""
    mesh, at, step = block(Mesh()).text(), np.array([0.1, 0.02]), 1e-3

    def run(change):
        return solve(tmp_path, mesh, UNDER_A_DISC.format(*(at + change)), "-order", 1, "-tol", 1e-10)

    needed = supports(run(0))[1]
    for change, name in zip(step * np.eye(2), ("move bottom y", "move left x"), strict=True):
        before, after = (run(sign * change).summary["energy"] for sign in (-1, 1))
        assert (after - before) / (2 * step) == pytest.approx(needed[name], rel=3e-3, abs=1e-3), name


def test_errors_of_two_motions(tmp_path):
    """The ± of what each needs holds the difference from a fine mesh, and is of its size."""
    case = UNDER_A_DISC.format(0.1, 0.02)
    found = part(tmp_path, block(Mesh()).text(), case).summary["prescribed"]
    fine = solve(tmp_path, block(Mesh(), cells=(24, 16)).text(), case, "-order", 4).summary["prescribed"]
    for row, exact in zip(found, fine, strict=True):
        assert abs(row["force"] - exact["force"]) < row["error"] < 0.12, row["name"]


def test_same_as_a_moved_disc(tmp_path):
    """A block that is moved against a disc is one on rollers against a disc that comes as far."""
    needed = supports(solve(tmp_path, block(Mesh()).text(), UNDER_A_DISC.format(0.1, 0.02), "-tol", 1e-10))[1]
    case = STEEL + "clamp bottom y\nclamp left x\nobstacle top circle 0.7 5 R 3 move -0.02 -0.1\n"
    forces, _ = supports(solve(tmp_path, block(Mesh()).text(), case, "-tol", 1e-10))
    assert forces["clamp bottom y"] == pytest.approx([0, needed["move bottom y"]], rel=1e-7)
    assert forces["clamp left x"] == pytest.approx([needed["move left x"], 0], rel=1e-5)


def test_dragged_by_one_side(tmp_path):
    """A block pressed on another and dragged: the drag is mu N, and the load phases change one component."""
    case = STACK.replace('bottom"', 'bottom" friction 0.3') + "clamp bottom\n"
    for steps, way in ((1, 0), (4, -0.2)):
        case += f'leg {steps}\npressure "upper top" 1\nmove "upper left" {way} *\n'
    run = solve(tmp_path, two_blocks((12, 4), (19, 6)).text(), case)
    forces, needed = supports(run)
    assert needed["move upper left x"] == pytest.approx(0.9, rel=1e-6)
    assert forces["move upper left x"] == pytest.approx([-0.9, 0], rel=1e-6)
    assert forces["clamp bottom"] == pytest.approx([0.9, 3], rel=1e-6)
    series = np.genfromtxt(tmp_path / "out/series.csv", delimiter=",", names=True)
    assert series["move_upper_left_x"][-5:] == pytest.approx([0, 0.05, 0.1, 0.15, 0.2])
    assert series["move_upper_left_x_reaction"][-1] == pytest.approx(0.9, rel=1e-6)


def test_large_rotation_along_a_roller(tmp_path):
    """A body turns by any angle where it is held along its axis only."""
    mesh = cube(cube(Mesh()), at=(0, 0, 1), prefix="upper ", name="upper").text()
    case = STACK + 'clamp bottom\nclamp "upper back" {}\nrotate "upper top" 1 1 0 0 0 1 0.7\n'
    solve(tmp_path, mesh, case.format("z"), "-check", 1, script="parts-3d.edp")
    said = solve(tmp_path, mesh, case.format("x"), "-check", 1, script="parts-3d.edp", expect=10).stdout
    assert "the angle 0.7; allowed: between -0.5 and 0.5" in said
