"""Bodies in states that are known: uniform stresses and expansions by heat, in the plane, about an axis, in space."""

import numpy as np
import pytest
from freefem import part
from input.test_parts import UNTURNED, Mesh, block, cube, turn, turn_in_space, vector

E, NU, HEAT = 100.0, 0.3, 2e-3
TENSOR = "stressXX stressYY stressZZ stressXY stressYZ stressXZ".split()
PLACES = (0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)


def line_of(folder, name="a"):
    return np.genfromtxt(folder / f"out/line-{name}.csv", delimiter=",", names=True)


def check_line(rows, stress, strain):
    """Every row has this tensor, what follows from it, and displacements of this strain but for a motion."""
    for name, (a, b) in zip(TENSOR, PLACES, strict=True):
        if name in rows.dtype.names:
            assert rows[name] == pytest.approx(stress[a, b], abs=1e-6), name
    principal = np.linalg.eigvalsh(stress)[::-1]
    for k in range(3):
        assert rows[f"stress{k + 1}"] == pytest.approx(principal[k], abs=1e-6), k
    mises = np.sqrt(((principal - np.roll(principal, 1)) ** 2).sum() / 2)
    assert rows["vonMises"] == pytest.approx(mises, abs=1e-6)
    names = [name for name in "xyz" if name in rows.dtype.names]
    way = np.array([rows[name][-1] - rows[name][0] for name in names])
    moved = np.array([rows[f"u{name}"][-1] - rows[f"u{name}"][0] for name in names])
    strain = strain[: len(names), : len(names)]
    assert moved @ way == pytest.approx(way @ strain @ way, rel=1e-6)


IN_PLANE = {"top": (1, 1), "bottom": (1, -1), "right": (0, 1), "left": (0, -1)}  # the axis it faces, which way
IN_SPACE = {"top": (2, 1), "bottom": (2, -1), "right": (1, 1), "left": (1, -1), "front": (0, 1), "back": (0, -1)}


UNIFORM = [("strain", 1), ("stress", 2), ("axisymmetric", 2), ("space", 1), ("space", 2)]


@pytest.mark.parametrize("state, order", UNIFORM)
def test_uniform(tmp_path, state, order):
    """A block between tractions and a rigid plane, warmed, all of it turned: its tensor, expansion, forces.

    A ring is not turned; hoop and radial stress are equal there.
    """
    space, ring = state == "space", state == "axisymmetric"
    dimension = 3 if space else 2
    stress = np.array([[3, 1.2, 0], [1.2, -2, 0], [0, 0, -4.0]]) if space else np.diag([-2.0 if ring else 3.0, -4, 0])
    hot = 1.5 * HEAT  # coefficient and change of temperature
    if state == "strain":
        stress[2, 2] = NU * (stress[0, 0] + stress[1, 1]) - E * hot
    if ring:
        stress[2, 2] = stress[0, 0]
    strain = ((1 + NU) * stress - NU * np.trace(stress) * np.eye(3)) / E + hot * np.eye(3)
    matrix = turn_in_space(3) if space else UNTURNED if ring else turn(0.7)

    def v(values):
        return vector(values, matrix, dimension)

    floor = np.eye(3)[2 if space else 1]
    case = "" if space else f"state {state}\n"
    case += f"body block E {E} nu {NU}\nexpand block {HEAT} 1.5\nobstacle bottom plane {v([0, 0, 0])} {v(floor)}\n"
    for name, (axis, sign) in (IN_SPACE if space else IN_PLANE).items():
        if name != "bottom" and not (ring and name == "left"):
            case += f"traction {name} {v(sign * stress[axis])}\n"
    ends = {"a": ([0.2, 0.3, 0.1], [1.7, 1.5, 0.9]), "b": ([1.8, 0.3, 0.7], [0.3, 1.1, 0.6])}
    case += "".join(f"line {name} {v(one)} {v(other)}\n" for name, (one, other) in ends.items())
    mesh = cube(Mesh(), cells=(2, 2, 1)) if space else block(Mesh())
    run = part(tmp_path, mesh.text(matrix), case, "-order", order, "-tol", 1e-10, "-estimate", 0, space=space)
    for name in ends:
        check_line(line_of(tmp_path, name), matrix @ stress @ matrix.T, matrix @ strain @ matrix.T)
    contact = run.summary["contacts"][0]
    area = 4 if space else np.pi * 9 if ring else 3
    assert contact["normalForce"] == pytest.approx(4 * area, rel=1e-6)
    assert np.array(contact["force"]) @ (matrix @ floor)[:dimension] == pytest.approx(4 * area, rel=1e-6)
    height = 1 if space else 2
    up = np.array(run.summary["bodies"][0]["motion"][:dimension]) @ (matrix @ floor)[:dimension]
    assert up == pytest.approx(strain[dimension - 1, dimension - 1] * height / 2, rel=1e-6)
    greatest = run.summary["stresses"][0]
    assert greatest["vonMises"] == pytest.approx(line_of(tmp_path)["vonMises"][0], rel=1e-6)
    assert not run.summary["warnings"]


def test_mean_of_a_cone(tmp_path):
    """A truncated cone under pressure all round: a uniform state; the mean of its motion is that of its volume."""
    mesh = block(Mesh(), cells=(12, 8))
    mesh.nodes = [(x * (1 - y / 4), y, z) for x, y, z in mesh.nodes]
    case = f"state axisymmetric\nbody block E {E} nu {NU}\nobstacle bottom plane 0 0 0 1\n"
    run = part(
        tmp_path,
        mesh.text(),
        f"{case}pressure top 4\npressure right 4\nline a 0.2 0.3 1 1.5\n",
        "-tol",
        1e-10,
        "-estimate",
        0,
    )
    strain = -4 * (1 - 2 * NU) / E
    check_line(line_of(tmp_path), -4 * np.eye(3), strain * np.eye(3))
    y, share = np.polynomial.legendre.leggauss(4)
    y, share = y + 1, share * (1 - (y + 1) / 4) ** 2
    assert run.summary["bodies"][0]["motion"][1] == pytest.approx(strain * (y @ share) / share.sum(), rel=1e-6)
    assert run.summary["contacts"][0]["normalForce"] == pytest.approx(4 * np.pi * 9, rel=1e-6)


@pytest.mark.parametrize("space", [False, True])
def test_moments(tmp_path, space):
    """A clamped block that a rigid round pushes off its middle: reaction and moment are those of the push."""
    dimension = 3 if space else 2
    matrix = turn_in_space(8) if space else turn(-1.1)
    place, push = ([1.4, 0.7, 1], [0, 0, -3]) if space else ([2, 2, 0], [0, -3, 0])
    middle = np.array(place) - 5 * np.array(push) / 3
    ways = [vector(values, matrix, dimension) for values in (middle, push)]
    shape = "sphere {} R 5 force {}" if space else "circle {} R 5 force {}"
    case = f"body block E 1000 nu {NU}\nclamp bottom\nobstacle top {shape.format(*ways)}\n"
    mesh = cube(Mesh(), cells=(7, 6, 2)) if space else block(Mesh(), cells=(24, 8))
    found = part(tmp_path, mesh.text(matrix), case, "-order", 1, "-estimate", 0, space=space)
    summary, points = found.summary, found.contact
    force, moment = matrix @ push, np.cross(matrix @ place, matrix @ push)
    carried = np.array(summary["supports"][0]["force"])
    assert carried @ force[:dimension] == pytest.approx(-9, rel=1e-5)
    assert carried == pytest.approx(-force[:dimension], abs=0.1)  # nothing else holds the round off its push
    assert [summary[f"reaction{axis}"] for axis in "XYZ"[:dimension]] == pytest.approx(carried, abs=1e-6)
    told = [summary[f"reactionMoment{axis}"] for axis in "XYZ"] if space else [0, 0, summary["reactionMoment"]]
    # a point carries for the round: its place is known to an element
    assert told == pytest.approx(-moment, abs=0.1 * np.linalg.norm(moment))
    places, normals = (
        np.array([points[name] if name in points.dtype.names else 0 * points["x"] for name in names]).T
        for names in (("x", "y", "z"), ("normalX", "normalY", "normalZ"))
    )
    turning = np.cross(places, (points["weight"] * points["pressure"])[:, None] * normals).sum(axis=0)
    assert told == pytest.approx(turning, abs=1e-6 * np.linalg.norm(moment))
