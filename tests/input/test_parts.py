"""Bodies of any shape: the case file and its refusals, supports and loads, floating bodies, turned problems."""

import itertools
import json
import os
import re
import subprocess

import numpy as np
import pytest
from freefem import FREEFEM, MOVED, ROOT, Run, data, execute, flag_text, part, script, snippet, told
from reader import Group, Refusal, Where, read_case
from reader.fields import STATEMENTS, shown

from postprocess.closed_forms import pin_angle, pin_pressure, plane_modulus

SPACE_GROUPS = {1: "back", 2: "front", 3: "left", 4: "right", 5: "bottom", 6: "top"}
UNTURNED = np.eye(3)
STEEL = "body block E 100 nu 0.3\n"


def turn(angle):
    """The rotation by an angle in the plane, as a matrix."""
    return np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])


def turn_in_space(seed):
    """A random rotation."""
    axes, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return axes * np.sign(np.linalg.det(axes))


class Mesh:
    """Nodes and elements of several blocks in gmsh's version 2 text format, with named groups."""

    def __init__(self):
        self.nodes, self.elements, self.names = [], [], []

    def group(self, dimension, name):
        if (dimension, name) not in self.names:
            self.names.append((dimension, name))
        return self.names.index((dimension, name)) + 1

    def add(self, nodes, sides, bodies):
        """Nodes (n, 3), sides and bodies as (group, corners)."""
        first = len(self.nodes) + 1
        self.nodes += [tuple(node) for node in nodes]
        for name, corners in (*sides, *bodies):
            inner = len(corners) == (3 if not sides or len(sides[0][1]) == 2 else 4)
            dimension = len(sides[0][1]) - 1 + inner
            kind = {2: 1, 3: 2, 4: 4}[len(corners)]
            tag = self.group(dimension, name)
            self.elements.append((kind, tag, [first + corner for corner in corners]))

    def text(self, matrix=UNTURNED):
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", len(self.names)]
        lines += [f'{dimension} {k + 1} "{name}"' for k, (dimension, name) in enumerate(self.names)]
        lines += ["$EndPhysicalNames", "$Nodes", len(self.nodes)]
        lines += [
            " ".join([str(k + 1), *map(repr, map(float, matrix @ node))])
            for k, node in enumerate(np.array(self.nodes, float))
        ]
        lines += ["$EndNodes", "$Elements", len(self.elements)]
        for k, (kind, tag, corners) in enumerate(self.elements):
            lines.append(" ".join(map(str, (k + 1, kind, 2, tag, tag, *corners))))
        return "\n".join(map(str, [*lines, "$EndElements", ""]))


def block(mesh, size=(3, 2), cells=(12, 8), at=(0, 0), prefix="", name="block"):
    """A rectangle of triangles with the groups bottom, right, top, left."""
    nx, ny = cells
    nodes = [
        (at[0] + size[0] * i / nx, at[1] + size[1] * j / ny, 0)
        for j, i in itertools.product(range(ny + 1), range(nx + 1))
    ]

    def number(i, j):
        return i + (nx + 1) * j

    sides = [(prefix + "bottom", (number(i, 0), number(i + 1, 0))) for i in range(nx)]
    sides += [(prefix + "right", (number(nx, j), number(nx, j + 1))) for j in range(ny)]
    sides += [(prefix + "top", (number(i + 1, ny), number(i, ny))) for i in range(nx)]
    sides += [(prefix + "left", (number(0, j + 1), number(0, j))) for j in range(ny)]
    bodies = []
    for i, j in itertools.product(range(nx), range(ny)):
        a, b, c, d = number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)
        bodies += [(name, (a, b, c)), (name, (a, c, d))] if (i + j) % 2 else [(name, (a, b, d)), (name, (b, c, d))]
    mesh.add(nodes, sides, bodies)
    return mesh


def cube(mesh, size=(2, 2, 1), cells=(4, 4, 2), at=(0, 0, 0), prefix="", name="block"):
    """A box of tetrahedra with the groups back, front (x), left, right (y), bottom, top (z)."""
    n = np.array(cells)
    nodes = [np.array(at) + np.array(size) * index / n for index in itertools.product(*(range(k + 1) for k in n))]

    def number(index):
        return int(np.ravel_multi_index(index, n + 1))

    sides, bodies = [], []
    for index in itertools.product(*(range(k) for k in n)):
        for way in itertools.permutations(range(3)):
            corner, corners = np.array(index), [number(index)]
            for axis in way:
                corner = corner + np.eye(3, dtype=int)[axis]
                corners.append(number(corner))
            bodies.append((name, corners))
    where = np.array(nodes)
    faces = {}
    for _, corners in bodies:
        for face in itertools.combinations(corners, 3):
            faces[tuple(sorted(face))] = faces.get(tuple(sorted(face)), 0) + 1
    for face, count in faces.items():
        if count == 1:
            place = where[list(face)] - at
            for axis in range(3):
                for end, value in ((0, 0), (1, size[axis])):
                    if (abs(place[:, axis] - value) < 1e-12).all():
                        sides.append((prefix + list(SPACE_GROUPS.values())[2 * axis + end], face))
    mesh.add(nodes, sides, bodies)
    return mesh


@pytest.fixture
def plane(tmp_path):
    (tmp_path / "block.msh").write_text(block(Mesh()).text())
    return tmp_path


def read(folder, case, mesh="block.msh", space=0):
    """(exit code, what input/read-case.sh says) of a case file's text."""
    (folder / "a.case").write_text(case)
    out = folder / "copy"
    given = [str(os.getpid()), folder / mesh, out, "a.case", str(space), "solve", "", "friction"]
    done = subprocess.run(["sh", ROOT / "edp/input/read-case.sh", *given], cwd=folder)
    why = (out / "why").read_text().strip() if (out / "why").exists() else ""
    table = (out / "case").read_text() if (out / "case").exists() else ""
    subprocess.run(["rm", "-rf", out], check=True)
    return done.returncode, why, table


GOOD = STEEL + "clamp bottom\nobstacle top circle 1.5 5 R 3 move 0 -0.1\n"


def test_case_is_read(plane):
    """Every statement of the plane, quotes, comments, blanks, a line's end as other systems have it."""
    text = (
        "\ufeff# a comment\r\nunits mm MPa # and another\n\nstate stress\nthickness 2.5\n"
        '\tbody "block" E 210e3 nu .3#x\n'
        "clamp bottom\nmove left 0 -0.05\nobstacle top plane 0 3 0 -1 law power kappa 1e6 m 3 d0 -0.001\n"
        "pressure right 5\nweight block 0 -7.8e-5\n"
    )
    code, why, table = read(plane, text)
    assert (code, why) == (0, "")
    lines = table.splitlines()
    assert lines[:4] == ["units mm MPa", "state stress", "thickness 2.5", "groups 5"]
    assert "1 top" in lines and "2 block" in lines
    at = next(k for k, line in enumerate(lines) if line.startswith("obstacle"))
    assert lines[at].split()[2:5] == [str(lines.index("1 top") - 3), "0", "-1"]
    assert {"shape plane", "shape.place.y 3", "shape.direction.y -1", "law.name power", "law.m 3"} <= set(lines[at:])


def refusals(text, good=GOOD):
    """(case, words) of each "change | words": "+ lines" behind the good case, "- lines" before it, or "old => new"."""
    for line in text.strip().splitlines():
        change, words = line.split(" | ")
        kind, lines = change[:2], change[2:].replace(" / ", "\n")
        old, _, other = change.partition(" => ")
        assert kind in ("+ ", "- ") or old in good
        yield {"+ ": good + lines, "- ": f"{lines}\n{good}"}.get(kind, good.replace(old, other)), words


REFUSED = data("parts/refused.txt")
RING_CASE = "state axisymmetric\n" + GOOD
REFUSED = [
    *refusals(REFUSED),
    (RING_CASE + "rotate left 0 0 0.1", "rotate: a ring cannot turn"),
    (RING_CASE + "weight block 1 0", "off the axis; allowed with state axisymmetric: along y"),
    (STEEL + "clamp bottom", "no contact; allowed: at least one line contact or obstacle"),
    ("clamp bottom\ncontact top left", "nothing says what the surface block is made of; allowed: a line body block E "),
    ("", "it has no statement; allowed: at least body and contact or obstacle"),
]


def groups(space):
    """Those of block() and of cube()."""
    names = list(SPACE_GROUPS.values()) if space else ["bottom", "right", "top", "left"]
    return [Group(2 + space, "block"), *(Group(1 + space, name) for name in names)]


@pytest.mark.parametrize("case, words", REFUSED)
def test_case_is_refused(case, words):
    """Each mistake: one line that names the file, the line, the word, and what is allowed."""
    with pytest.raises(Refusal) as found:
        read_case(case, Where(friction="", wear=False, plastic=False), groups(0))
    why = found.value.text("a.case")
    assert why.startswith("-case a.case, ") and words in why and "\n" not in why
    assert "allowed" in why


@pytest.mark.parametrize("space", [0, 1])
def test_examples_of_statements(space):
    """The example beside each statement of the grammar is one: the reader takes it."""
    where = Where(space=bool(space))
    examples = {word: shown(cls.example, where).split() for word, cls in STATEMENTS.items() if cls.example}
    assert len(examples) >= 25
    bodies = ("body", "expand", "weight", "spin", "conduct", "source", "plastic")
    for word, words in examples.items():
        left_out = ("group", "size", "preload", "tighten", "leg", "cut", "join", "cycles", "time", "load", "combine")
        if word in left_out or (space and word in ("thickness", "state", "plastic")):
            continue
        if word not in ("line", "about", "gravity", "thickness", "state"):
            words[1] = "block" if word in bodies else "top"
        if word in ("contact", "tie"):
            words[2] = "bottom"
        first = "" if word == "body" else "body block E 100 nu 0.3 density 1\n"
        if word in ("conduct", "temperature", "flux", "film", "source"):  # none without the others
            first += "conduct block 1\n" * (word != "conduct") + "temperature bottom 0\n"
        obstacle = f"obstacle {'left' if space else 'right'} plane 9 0 {'0 -1 0 0' if space else '-1 0'}\n"
        lines = first + " ".join(words) + "\n" if word not in ("state", "thickness") else " ".join(words) + "\n" + first
        case = lines + obstacle * (word not in ("tie",))
        try:
            read_case(case, Where(space=bool(space)), groups(space))
        except Refusal as refusal:
            assert "axisymmetric" in str(refusal), (word, str(refusal))


def test_obstacle_in_a_later_phase(plane):
    """Its move alone, and a circle with or without R: the numbers are the same."""
    lines = STEEL + "clamp bottom\nobstacle top circle 1.5 5 {}3 move 0 0 friction 0.1\n"
    lines += "leg 1\nleg 2\nobstacle top {}move 0 -0.1\n"
    tables = [read(plane, lines.format(*words)) for words in (("R ", "circle 1.5 5 R 3 "), ("", ""))]
    moves = [[line for line in table.splitlines() if line.startswith("drive.by")] for _, _, table in tables]
    assert [code for code, _, _ in tables] == [0, 0] and moves[0] == moves[1] and len(moves[0]) == 6
    code, why, _ = read(plane, lines.format("", "").replace("obstacle top move", "obstacle bottom move"))
    assert code == 3 and "obstacle bottom: 0 obstacles of it" in why


def test_refused_before_anything_is_written(plane):
    """The exit code is 10, with -check too, and no folder is there."""
    (plane / "a.case").write_text(GOOD + "clamp lfet")
    (plane / "good.case").write_text(GOOD)
    code, stdout = run_parts(plane, "block.msh", "a.case", "-check", 1)
    assert code == 10
    assert stdout.splitlines()[-1].startswith(f"-case {plane}/a.case, line 4: lfet: no physical curve")
    assert not (plane / "out").exists()
    for flags, said in (
        (["-case", "a.case"], "-mesh none: a mesh is needed"),
        (["-mesh", plane / "block.msh"], "-case none: a case file is needed"),
        (["-mesh", plane / "block.msh", "-case", "b.case"], "-case b.case: no such file"),
        (["-mesh", plane / "block.msh", "-case", plane / "a.case", "-law", "power"], "line 4: lfet: "),
        (["-mesh", plane / "block.msh", "-case", plane / "good.case", "-law", "power"], "-law: "),
    ):
        code, stdout = execute([*FREEFEM, "edp/parts.edp", *flags])
        assert code == 10 and said in stdout


def run_parts(folder, mesh, case, *flags, script="parts.edp"):
    """A run's exit code and output; the error is not estimated."""
    files = ["-mesh", folder / mesh, "-case", folder / case, "-out", folder / "out", "-vtu", 0, "-estimate", 0]
    return execute(list(map(flag_text, [*FREEFEM, f"edp/{script}", *files, *flags])))


def solve(folder, mesh, case, *flags, expect=0, script="parts.edp"):
    """The run of a case's text on a mesh's text; the error is not estimated."""
    return part(folder, mesh, case, *flags, "-estimate", 0, script=f"edp/{script}", expect=expect)


# ---------------------------------------------------------------- supports and loads, on the bodies alone

BODIES = data("parts/bodies.edp")


def bodies(folder, mesh, case, *flags, space=False):
    """What the bodies alone do under a case's supports and loads, without contact: {name: numbers} and the output."""
    (folder / "a.msh").write_text(mesh)
    (folder / "a.case").write_text(case)
    script = (ROOT / "edp/parts.edp").read_text().split('include "input/case/case-file.idp"')[0]
    head = "macro threeDimensional() 1 //\nmacro inSpace(do, what) //\nmacro behindRigidModes(do, what) //\n"
    head = head + 'string scene = "parts-3d";\n' if space else ""
    stdout = snippet(folder, head + script + BODIES, "-mesh", "a.msh", "-case", "a.case", "-order", 2, *flags)
    return told(stdout), stdout


def moved(result, part=""):
    """The displacements of all nodes, or of a part's, (n, 3)."""
    return np.array([result[name] for name in result if name.startswith(f"node-{part}")])


def apart(make, cases):
    """The mesh and the case of several bodies 5 apart along x, of {name: lines} with the groups of a body alone."""
    mesh, text = Mesh(), ""
    for k, (name, lines) in enumerate(cases.items()):
        make(mesh, at=(5 * k, 0, 0), prefix=f"{name} ", name=name)
        text += re.sub(f"\\b({'|'.join(SPACE_GROUPS.values())})\\b", rf'"{name} \1"', lines.replace("block", name))
    return mesh, text


def vector(values, matrix=UNTURNED, dimension=2):
    return " ".join(map(repr, map(float, (matrix @ np.array([*values, 0, 0])[:3])[:dimension])))


PLANE = "obstacle top circle 100 100 R 1\n"
TURNED = turn(2.5)


def supports(matrix):
    """Cases without contact: every kind of support and load, each for a body of its own."""

    def v(*values):
        return vector(values, matrix)

    lines = {
        "symmetries": "symmetry left\nsymmetry bottom\npressure right -3\n",
        "one-symmetry": f"symmetry left\npressure right -3\ntraction top {v(2, 0)}\n",
        "clamp": f"clamp left\ntraction right {v(1, 2)}\nweight block {v(0, -1)}\n",
        "move": f"clamp left\nmove right {v(0.1, 0.02)}\n",
        "rotate": f"clamp left\nrotate right {v(24, 1)} 0.05\n",
        "force": f"clamp left\nforce right {v(4, 3)}\nweight block {v(0, -1)}\n",
        "force-along": f"symmetry left\nsymmetry bottom\nforce right {v(4, 0)}\n",
    }
    return {name: STEEL + text + PLANE for name, text in lines.items()}


def test_turned_supports(tmp_path):
    """Bodies turned with their supports and loads do the same, to rounding."""
    results = []
    for matrix in (UNTURNED, TURNED):
        mesh, case = apart(block, supports(matrix))
        results.append(bodies(tmp_path, mesh.text(matrix), case)[0])
    one, other = results
    assert one["balance"] < 1e-12
    assert other["target"] == pytest.approx(one["target"], rel=1e-9, abs=1e-12)
    for name in supports(UNTURNED):
        assert other[f"energy-{name}"] == pytest.approx(one[f"energy-{name}"], rel=1e-10), name
        if name != "one-symmetry":  # free along it: grounded elsewhere
            found, size = (np.sort(np.linalg.norm(moved(each, f"{name}-"), axis=1)) for each in (other, one))
            assert found == pytest.approx(size, abs=1e-9 * size[-1]), name


def test_resultants(tmp_path):
    """Pressure, traction and weight add up to what they say, also as rings about an axis."""
    loads = "clamp bottom\npressure right 5\ntraction top 0.3 -0.7\nweight block 0 -0.2\n"
    result, _ = bodies(tmp_path, block(Mesh()).text(), STEEL + loads + PLANE)
    assert result["load"][[0, 1, 5]] == pytest.approx(
        [-5 * 2 + 0.3 * 3, -0.7 * 3 - 0.2 * 6, 10 + 0.3 * 3 * -2 - 0.7 * 4.5 - 1.2 * 1.5]
    )
    assert result["reaction"][:2] == pytest.approx(-result["load"][:2])
    ring = "state axisymmetric\n" + STEEL + "clamp bottom\ntraction top 0 -0.7\nweight block 0 -0.2\n"
    result, _ = bodies(tmp_path, block(Mesh()).text(), ring + PLANE)
    assert result["load"][1] == pytest.approx(-np.pi * 9 * (0.7 + 0.2 * 2))
    assert abs(moved(result)[:, 0]).max() > 0


def test_lame(tmp_path):
    """A ring under inner pressure, axisymmetric between two symmetry planes: Lame's displacement."""
    text = "state axisymmetric\n" + STEEL + "symmetry bottom\nsymmetry top\npressure left 2\n"
    mesh = block(Mesh(), size=(1, 0.5), cells=(16, 4), at=(1, 0))
    result, _ = bodies(tmp_path, mesh.text(), text + "obstacle right circle 100 100 R 1\n")
    # plane strain, a = 1, b = 2: u(a) = (1 + nu)/E p a^2/(b^2 - a^2) ((1 - 2 nu) a + b^2/a)
    assert moved(result)[:, 0].max() == pytest.approx(1.3 / 100 * 2 / 3 * (0.4 + 4), rel=1e-4)


def test_free_motions(tmp_path):
    """What the supports leave free, and that it is grounded: no load, no displacement, no singular matrix."""
    held = {
        "sliding": ("symmetry left\n", ["along y"]),
        "corner": ("symmetry left\nsymmetry bottom\n", []),
        "between": ("symmetry left\nsymmetry right\n", ["along y"]),
        "nothing": ("", ["along x", "along y", "rotation"]),
    }
    mesh, case = apart(block, {name: STEEL + text + PLANE for name, (text, _) in held.items()})
    result, stdout = bodies(tmp_path, mesh.text(), case)
    assert [line[6:] for line in stdout.splitlines() if line.startswith("free: ")] == [
        f"{name}: {motion}" for name, (_, free) in held.items() for motion in free
    ]
    assert abs(moved(result)).max() == 0


def test_nothing_holds(tmp_path):
    """A body that nothing holds and no contact touches is refused by name, with what is free."""
    two = block(block(Mesh()), at=(0, 5), prefix="far ", name="other")
    case = STEEL + 'body other E 1 nu 0\nclamp bottom\nobstacle top plane 0 9 0 -1\nsymmetry "far left"\n'
    stdout = solve(tmp_path, two.text(), case, expect=10).stdout
    assert "other: no contact touches it, and nothing holds it (other: along y); allowed: a clamp" in stdout


DISAGREEING = """
clamp left / move bottom 0 1 | move bottom: line 2 moves its node at (0, 0) elsewhere; allowed: the same motion there
clamp left / force bottom 0 1 | force bottom: it cannot follow its force, because line 2 holds its node at (0, 0)
symmetry left / force bottom 1 1 | force bottom: it touches the symmetry left of line 2, across which it cannot follow
symmetry left / move bottom 1 1 | symmetry left: line 3 moves its node at (0, 0) across it; allowed: along it
"""


@pytest.mark.parametrize("held, words", [line.split(" | ") for line in DISAGREEING.strip().splitlines()])
def test_supports_that_disagree(tmp_path, held, words):
    """Two statements that hold one node in different places: refused with the place and both lines."""
    case = STEEL + held.replace(" / ", "\n") + "\n" + PLANE
    assert words in solve(tmp_path, block(Mesh()).text(), case, expect=10).stdout


def test_curved_symmetry(tmp_path):
    """A symmetry that is not flat has no one direction: refused."""
    mesh = block(Mesh())
    mesh.nodes = [(x, y + 0.1 * x * x, z) for x, y, z in mesh.nodes]
    stdout = solve(tmp_path, mesh.text(), STEEL + "symmetry bottom\n" + PLANE, expect=10).stdout
    assert 'symmetry "bottom" of the case file, line 2: curved, by ' in stdout


SPACE = "obstacle top sphere 100 100 100 R 1\n"


def supports_in_space(matrix):
    """The same in space."""

    def v(*values):
        return vector(values, matrix, 3)

    sides = "".join(
        f"pressure {name} {p}\n" for name, p in (("front", -3), ("back", -3), ("top", 0.5), ("bottom", 0.5))
    )
    lines = {
        "symmetries": "symmetry left\nsymmetry bottom\nsymmetry back\npressure front -3\n",
        "one-symmetry": f"symmetry left\n{sides}",
        "rotate": f"clamp back\nrotate front {v(13, 1, 0)} {v(1, 2, 0)} 0.05\n",
        "force": f"symmetry left\nsymmetry back\nforce front {v(1, 0, 0)}\n",
    }
    return {name: STEEL + text + SPACE for name, text in lines.items()}


def test_turned_in_space(tmp_path):
    """The same in space, turned by a random rotation."""
    results = []
    for matrix in (UNTURNED, turn_in_space(0)):
        mesh, case = apart(cube, supports_in_space(matrix))
        results.append(bodies(tmp_path, mesh.text(matrix), case, space=True)[0])
    one, other = results
    assert one["balance"] < 1e-12 and other["balance"] < 1e-11
    assert len(np.atleast_1d(other["target"])) == len(np.atleast_1d(one["target"]))
    for name in supports_in_space(UNTURNED):
        assert other[f"energy-{name}"] == pytest.approx(one[f"energy-{name}"], rel=1e-9), name


# ---------------------------------------------------------------- with contact

STACK = """body block E 100 nu 0.3
body upper E 100 nu 0.3
contact top "upper bottom"
"""


def two_blocks(below=(3, 1), above=(3, 1), width=3):
    """A block on another one, each of its own cells."""
    mesh = block(Mesh(), size=(width, 1), cells=below)
    return block(mesh, size=(width, 1), cells=above, at=(0, 1), prefix="upper ", name="upper")


def stack(matrix=UNTURNED):
    """Two blocks of the same width on each other, their meshes differ."""
    return two_blocks((12, 4), (19, 6)).text(matrix)


@pytest.mark.parametrize(
    "held, order", [("", 2), ('symmetry "upper left"\n', 1), ('symmetry "upper left"\nsymmetry "upper right"\n', 2)]
)
def test_floating_patch(tmp_path, held, order):
    """A block that lies free on another one under a uniform pressure: uniform, whatever its sides slide on."""
    below = "symmetry bottom\nsymmetry left\n" + ("symmetry right\n" if "right" in held else "")
    run = solve(tmp_path, stack(), STACK + below + held + 'pressure "upper top" 2\n', "-order", order, "-tol", 1e-10)
    assert run.contact["pressure"] == pytest.approx(2, rel=1e-8)
    assert run.force == pytest.approx(6, rel=1e-9)
    assert run.reactionY == pytest.approx(6, rel=1e-9)
    assert run.summary["newton"] <= 6


def test_turned_contact(tmp_path):
    """Floating, pushed and moved bodies in contact, turned: the same counts, the same pressures."""

    def case(matrix):
        sides = f'symmetry bottom\nsymmetry left\nsymmetry "upper left"\nforce "upper top" {vector((0, -5), matrix)}\n'
        wall = f"{vector((3.2, 0), matrix)} {vector((-1, 0), matrix)} move {vector((-0.25, 0), matrix)}"
        return f"{STACK}{sides}obstacle right plane {wall}\n"

    found = []
    for matrix in (UNTURNED, TURNED):
        run = solve(tmp_path, stack(matrix), case(matrix), "-order", 1)
        found.append((run.newton, run.backsolves, run.contact))
    (*counts, one), (*others, other) = found
    assert others == counts
    assert other["pressure"] == pytest.approx(one["pressure"], abs=1e-9 * one["pressure"].max())
    assert one["pressure"][one["contact"] == 1].max() > 0


HELD = 'clamp bottom\nsymmetry "upper left"\nforce "upper top" 0 -5\nobstacle right plane 3.2 0 -1 0 move {} 0\n'


@pytest.mark.parametrize("flags", [(), ("-distance", "exact")])
def test_held_point(tmp_path, flags):
    """A wall against a clamped block: its clamped corner is refused, left out, or carries what the law says."""
    mesh, layer = stack(), "obstacle left plane -0.2 0 1 0 move 0.25 0 law power kappa 100 m 2 d0 -0.01\n"
    refused = solve(tmp_path, mesh, STACK + HELD.format(-0.25), *flags, "-order", 1, expect=10).stdout
    words = "contact right plane: the point at (3, 0): it is held, and so is what it touches, and they overlap by 0.05"
    assert words in refused.splitlines()[-1]
    assert not (tmp_path / "out").exists()
    run = solve(tmp_path, mesh, STACK + HELD.format(-0.2) + layer, *flags, "-order", 1)
    assert "right plane: the point at (3, 0) is held, and so is what is opposite: left out" in run.stdout
    assert "left plane: the point at (0, 0) is held, and so is what is opposite: 0.00" in run.stdout
    right, left = (run.contact[run.contact["contact"] == number] for number in (1, 2))
    assert right["pressure"].min() == 0 and right["pressure"].max() > 0.1
    corner = left[left["y"] == 0]
    assert corner["pressure"] == pytest.approx(100 * 0.06**2, rel=1e-9)
    assert (left["pressure"][left["y"] > 0] > corner["pressure"]).all()


MEETING = two_blocks((9, 3), (9, 3)).text()  # their nodes do


def test_held_on_both_sides(tmp_path):
    """A slave's clamped corner below a master's that is moved into it: no solution; a gap there is no matter."""
    case = STACK + 'clamp left\nclamp bottom\nmove "upper left" 0 {}\npressure "upper top" 1\n'
    said = solve(tmp_path, MEETING, case.format(-0.01), "-order", 1, expect=10).stdout
    assert "contact top upper bottom: the point at (0, 1): it is held" in said
    run = solve(tmp_path, MEETING, case.format(0.01), "-order", 1)
    assert run.summary["contacts"][0]["normalForce"] > 1 and "left out" not in run.stdout


@pytest.mark.parametrize(
    "case, gap, flags",
    [
        ('move "upper top" 0 0.1', 0.1, ()),
        ('symmetry "upper left"', 0, ("-distance", "exact")),
        ('move "upper top" -1 200', 200, ("-distance", "exact")),
    ],
)
def test_nothing_presses(tmp_path, case, gap, flags):
    """Bodies that do not press on each other: no force, and a word, however far they are moved."""
    run = solve(tmp_path, MEETING, f"{STACK}clamp bottom\n{case}\n", "-order", 1, *flags)
    assert not run.force and f"nothing presses on anything: the least gap left is {gap}" in run.stdout
    assert ": raise the loads that press, lower those that part" in run.stdout
    assert run.summary["outOfBalance"] < 1e-6


def test_gap_left_of_an_interference(tmp_path):
    """The gap left is that of the thicker bodies: the displacement less the interference."""
    fit = STACK.replace('"upper bottom"', '"upper bottom" interference 0.0007')
    run = solve(tmp_path, MEETING, f'{fit}clamp bottom\nmove "upper top" 0 0.005\n', "-order", 1)
    assert not run.force
    assert "nothing presses on anything: the least gap left is 0.0043: the loads part bodies" in run.stdout


def test_large_rotation(tmp_path):
    """A body that turns by so much that linearised rotations show: said, by methods that know no others."""
    turned = "rotate bottom {} 0 {}\nobstacle top plane 0 9 0 -1\n"
    mesh, case = apart(block, {"much": STEEL + turned.format(1.5, 0.2), "little": STEEL + turned.format(6.5, 0.05)})
    assert "linearised" not in solve(tmp_path, mesh.text(), case, "-order", 1).stdout
    said = solve(tmp_path, mesh.text(), case, "-order", 1, "-method", "paper").stdout
    assert "warning: much: turned by 0.2, and rotations are linearised" in said
    assert said.count("linearised") == 1


def test_slides(tmp_path):
    """A block that slides along another by more than what is loaded: said, and right with the true distance."""
    mesh = block(Mesh(), size=(6, 1), cells=(24, 4))
    block(mesh, size=(1, 1), cells=(5, 4), at=(1, 1), prefix="upper ", name="upper")
    case = STACK.replace('top "upper bottom"', '"upper bottom" top') + 'clamp bottom\nmove "upper top" {} -0.02\n'
    there = solve(tmp_path, mesh.text(), case.format(2), "-order", 1, "-distance", "exact")
    assert "slide along each other" not in there.stdout
    frozen = solve(tmp_path, mesh.text(), case.format(2), "-order", 1)
    assert "the bodies slide along each other by 1." in frozen.stdout
    back = block(Mesh(), size=(6, 1), cells=(24, 4))
    block(back, size=(1, 1), cells=(5, 4), at=(3, 1), prefix="upper ", name="upper")
    here = solve(tmp_path, back.text(), case.format(0), "-order", 1)
    assert there.force == pytest.approx(here.force, rel=2e-3)


def test_held_point_in_space(tmp_path):
    """The same in space, turned: the corner nodes of a box that is clamped at one side."""
    matrix = turn_in_space(3)
    place, normal = vector((0, 0, 1.1), matrix, 3), vector((0, 0, -1), matrix, 3)
    case = f"{STEEL}clamp left\nobstacle top plane {place} {normal} move {{}}\n"
    mesh = cube(Mesh()).text(matrix)
    move = vector((0, 0, -0.15), matrix, 3)
    assert "is held, and so is what it touches, and they overlap by 0.05" in (
        solve(tmp_path, mesh, case.format(move), "-order", 1, expect=10, script="parts-3d.edp").stdout
    )
    law = move + " law power kappa 1e3 m 2 d0 -0.01"
    run = solve(tmp_path, mesh, case.format(law), "-order", 1, script="parts-3d.edp")
    assert run.contact["pressure"].max() == pytest.approx(1e3 * 0.06**2, rel=1e-6)
    assert "more are held" in run.stdout and "reaches the end of the master" not in run.stdout


def test_thickness(tmp_path):
    """A force spreads over the width and the thickness of what it presses."""
    slides = 'symmetry bottom\nsymmetry left\nsymmetry "upper left"\nforce "upper top" 0 -6\n'
    run = solve(
        tmp_path, stack(), "thickness 2\n" + STACK.replace("nu 0.3", "nu 0") + slides, "-order", 1, "-tol", 1e-10
    )
    assert run.contact["pressure"] == pytest.approx(6 / (3 * 2), rel=1e-9)


def test_nothing_resists(tmp_path):
    """A load on a motion that nothing resists is refused by the body's name; without one it is fixed and said below."""
    pushed = STACK + 'clamp bottom\npressure "upper top" 2\ntraction "upper left" 1e-3 0\n'
    said = solve(tmp_path, stack(), pushed, expect=10).stdout
    assert "upper: along x: a load works on it, but no contact, support or symmetry resists it" in said


def test_check(tmp_path):
    """-check 1 says what it read, writes files to draw it, and solves nothing."""
    run = solve(tmp_path, stack(), "units mm MPa\n" + STACK + 'clamp bottom\npressure "upper top" 2\n', "-check", 1)
    said = run.stdout
    assert re.search("^  body +block: .*; held by clamp bottom$", said, re.M)
    assert re.search("^  body +upper: .*; held by contact only; free: along x, along y, rotation$", said, re.M)
    assert "top upper bottom: hard contact, frictionless, 25 points, initial gap " in said
    assert "iteration" not in said
    folder = tmp_path / "out/check"
    files = {"check-boundary.csv", "check-mesh.vtu", "check-points.csv", "check.json"}  # faces: of geometries
    assert {file.name for file in folder.glob("check*")} == files
    found = json.loads((folder / "check.json").read_text())
    assert [body["name"] for body in found["bodies"]] == ["block", "upper"]
    assert found["contacts"][0]["paired"] == 25
    assert found["fixed"] == ["upper: along x"]
    assert "  note      upper: along x changes no gap and carries no load: it is set to 0" in said
    assert not (tmp_path / "out/summary.json").exists()


def test_check_tells_interference_and_expansion(tmp_path):
    """What loads without a force is listed: an interference, with a law in its d0, and an expansion."""
    case = (
        STACK.replace('"upper bottom"', '"upper bottom" interference 0.0007') + "clamp bottom\nexpand upper 1e-5 20\n"
    )
    said = solve(tmp_path / "hard", stack(), case, "-check", 1).stdout
    assert re.search("^  load +contact top: interference 0.0007$", said, re.M), said
    assert re.search("^  load +expand upper 1e-05 20$", said, re.M), said
    law = case.replace("0.0007", "0.0007 law power kappa 1e6 m 2 d0 -0.001")
    said = solve(tmp_path / "law", stack(), law, "-check", 1).stdout
    assert "top upper bottom: law power, d0 -0.0017, frictionless" in said and "load      contact" not in said, said


def test_facing_nothing(tmp_path):
    """Surfaces that do not face each other are refused with the line."""
    case = STACK.replace('"upper bottom"', '"upper top"') + "clamp bottom\n"
    said = solve(tmp_path, stack(), case, expect=10).stdout
    assert "line 3: contact top: nothing lies opposite it; allowed: surfaces that face each other" in said


def boxes(matrix=UNTURNED):
    """A box on a box, of other meshes."""
    mesh = cube(Mesh(), cells=(4, 4, 2))
    return cube(mesh, cells=(3, 5, 2), at=(0, 0, 1), prefix="upper ", name="upper").text(matrix)


def test_turned_contact_in_space(tmp_path):
    """A box that lies free on another one, one side on a symmetry plane, turned: the same counts and pressures."""
    case = STACK + 'clamp bottom\nsymmetry "upper left"\npressure "upper top" 2\n'
    results = [
        solve(tmp_path, boxes(matrix), case, "-tol", 1e-9, "-order", 1, script="parts-3d.edp")
        for matrix in (UNTURNED, turn_in_space(1))
    ]
    one, other = results
    assert one.summary["newton"] == other.summary["newton"]
    pressures = [np.sort(run.contact["pressure"]) for run in results]
    assert pressures[1] == pytest.approx(pressures[0], abs=1e-8 * one.pressureMax)
    assert np.linalg.norm(one.summary["contacts"][0]["force"]) == pytest.approx(8, rel=1e-9)


def test_second_order_mesh(tmp_path):
    """The nodes in the middle of a second-order mesh's sides, on the user's own surface, take the spline's place."""
    geo = (ROOT / "edp/examples/pin-in-hole/pin-in-hole.geo").read_text().replace("size = {0.28,", "size = {1.5,")
    case = (ROOT / "edp/examples/pin-in-hole/pin-in-hole.case").read_text()
    folder = tmp_path / "a b'c"
    folder.mkdir()
    (folder / "pin.geo").write_text(geo)
    (folder / "pin.case").write_text(case)
    execute(["gmsh", "-2", "-order", "2", "-v", "1", folder / "pin.geo", "-o", folder / "pin.msh"])
    code, stdout = run_parts(folder, "pin.msh", "pin.case")
    assert code == 0, stdout[-2000:]
    assert " curved elements P2" in stdout
    force, clearance, hole = 1000, 0.01, 10.01
    angle = pin_angle(plane_modulus(210e3, 0.3) * clearance / force)
    found = Run(code, stdout, folder / "out").pressureMax
    assert found == pytest.approx(pin_pressure(0, angle) * force / hole, rel=0.02)


# ---------------------------------------------------------------- gaps along the vertical, the methods

PUNCH = ROOT / "edp/examples/punch"
SOFT = "law power kappa 1e3 m 3 d0 -0.05"


def punch(folder, *flags, exchanged=(), size=0.3, expect=0):
    """The example punch on larger elements, with (old, new) exchanged in its case."""
    geo, case = ((PUNCH / f"punch.{kind}").read_text() for kind in ("geo", "case"))
    for old, new in exchanged:
        assert old in case
        case = case.replace(old, new)
    return solve(folder, geo.replace("size = {0.1,", f"size = {{{size},"), case, *flags, expect=expect)


@pytest.mark.parametrize("upper", [False, True])
def test_gap_vertical(tmp_path, upper):
    """A gap along the vertical is the arcs' difference at the same abscissa, also of a slave that faces down."""
    exchanged = [("contact contact master", "contact master contact")] if upper else []
    run = punch(tmp_path, "-check", 1, exchanged=exchanged)
    assert run.stdout.count(" initial gap ") == 1
    found = np.genfromtxt(tmp_path / "out/check/check-points.csv", delimiter=",", names=True)
    found = found[found["paired"] == 1]
    found = found[np.abs(found["x"]) < 2.5]  # near their ends splines know less
    x = found["x"]
    assert (found["nx"] == 0).all() and (found["ny"] == (-1 if upper else 1)).all()
    assert found["gap"] == pytest.approx(14.1 - np.sqrt(64 - x**2) - np.sqrt(1600 - x**2) + 34, abs=2e-6)


def test_gap_vertical_forces(tmp_path):
    """Vertical gaps have vertical forces, whose work is the energy; normals give nearly the same."""
    step = 1e-3
    runs = [
        punch(tmp_path / f"{k}", "-tol", 1e-11, exchanged=[("0 -0.5", f"0 {-0.5 - k * step!r}")], size=0.6)
        for k in (-1, 0, 1)
    ]
    force = runs[1].summary["contacts"][0]["force"]
    assert abs(force[0]) < 1e-12 and force[1] == pytest.approx(-runs[1].force, rel=1e-12)
    assert (runs[2].energy - runs[0].energy) / (2 * step) == pytest.approx(runs[1].force, rel=1e-5)
    along_normals = punch(tmp_path / "normals", exchanged=[(" gap vertical", "")], size=0.6)
    assert along_normals.force == pytest.approx(runs[1].force, rel=5e-3)
    assert along_normals.force != pytest.approx(runs[1].force, rel=1e-5)


def test_gap_vertical_in_space(tmp_path):
    """A box on a box: the flat contact's pressure, by gaps along z and by another method."""
    case = STACK.replace('"upper bottom"', '"upper bottom" gap vertical') + 'clamp bottom\nmove "upper top" 0 0 -0.1\n'
    forces = []
    for flags, text in (([], case.replace(" gap vertical", "")), ([], case), (["-method", "paper"], case)):
        run = solve(tmp_path, boxes(), text, "-tol", 1e-9, "-order", 1, *flags, script="parts-3d.edp")
        forces.append(run.summary["contacts"][0]["force"][2])
    assert forces[1:] == pytest.approx([forces[0]] * 2, rel=1e-8)


def test_gap_vertical_of_a_slave_that_faces_down(tmp_path):
    """In space the gap is measured up: a slave that faces down is refused, with the contact to write."""
    case = STACK.replace('top "upper bottom"', '"upper bottom" top gap vertical') + "clamp bottom\n"
    said = solve(tmp_path, boxes(), case, script="parts-3d.edp", expect=10).stdout
    assert "contact upper bottom top: gap vertical: the slave does not face up at (" in said
    assert "allowed: slave and master exchanged, or no gap vertical" in said


@pytest.mark.parametrize(
    "text, words",
    [
        ('contact top "upper bottom" gap', "gap: a gap that conducts stands behind a conductance; allowed: "),
        ('contact top "upper bottom" gap normal', "conductance h0 gap k, or gap vertical"),
        ('contact top "upper bottom" gap vertical\nobstacle top plane 0 9 0 -1', "top: gap along its normals, in "),
        ("obstacle top plane 0 9 0 -1 gap vertical", "gap: not allowed here"),
    ],
)
def test_gap_is_refused(tmp_path, text, words):
    """A gap is vertical or not, one way for a slave; that to an obstacle is along normals."""
    case = STACK.replace('contact top "upper bottom"\n', text + "\n") + "clamp bottom\n"
    assert words in solve(tmp_path, stack(), case, expect=10).stdout


def test_states_change_nothing(tmp_path):
    """The pictures of the steps shall leave the steps as they are."""
    plain, drawn = (
        punch(tmp_path / f"{states}", "-method", "linesearch", "-order", 1, "-states", states) for states in (0, 1)
    )
    assert drawn.force == plain.force and drawn.newton == plain.newton


def test_methods(tmp_path):
    """Every method of a scene's shall find the same pressures; with -steps some load only grazes."""
    flags = ("-order", 1, "-tol", 1e-9)
    for law, methods in ((SOFT, ("paper", "newton", "incremental")), ("", ("signorini", "paper"))):
        runs = [
            punch(tmp_path / f"{method}{len(law)}", "-method", method, *flags, exchanged=[(SOFT, law)], size=0.6)
            for method in ("xnewton", *methods)
        ]
        for run in runs[1:]:
            assert run.force == pytest.approx(runs[0].force, rel=1e-7), run.method
            assert run.contact["pressure"] == pytest.approx(runs[0].contact["pressure"], abs=1e-6 * run.pressureMax)
            assert run.summary["outOfBalance"] < 1e-9
            motions = [body["motion"] for result in (run, runs[0]) for body in result.summary["bodies"]]
            assert np.ravel(motions[:2]) == pytest.approx(np.ravel(motions[2:]), abs=1e-7)


@pytest.mark.parametrize(
    "method, lines, words",
    [
        ("paper", "clamp clamped\nforce pushed 0 -10", "paper: free: pushed: along its force; allowed: xnewton"),
        ("newton", "clamp clamped\nclamp pushed\nSECOND", "1 of 2 contacts have a law; allowed: a law behind each "),
        ("linesearch", "clamp clamped\nclamp pushed\nHARD", "linesearch: 0 of 1 contacts have a law; allowed: a law"),
        ("signorini", "clamp clamped\nclamp pushed", "1 of 1 contacts have a law; allowed: hard contact"),
    ],
)
def test_method_is_refused(tmp_path, method, lines, words):
    """What a method cannot solve is refused in one line, before anything is written."""
    exchanged = [("clamp clamped\nmove pushed 0 -0.5", lines.replace("\nHARD", "").replace("\nSECOND", ""))]
    exchanged += [(SOFT, "")] if "HARD" in lines else []
    exchanged += [(f"gap vertical {SOFT}", f"{SOFT}\nobstacle contact plane 0 20 0 -1")] if "SECOND" in lines else []
    run = punch(tmp_path, "-method", method, exchanged=exchanged, expect=10)
    assert words in run.stdout and not run.folder.exists()


def test_method_with_turned_dofs(tmp_path):
    """A symmetry across no axis needs xnewton."""
    case = f"{STEEL}obstacle top circle {vector((1.5, 5), TURNED)} R 3\nsymmetry left\nsymmetry bottom\n"
    said = solve(tmp_path, block(Mesh()).text(TURNED), case, "-method", "newton", expect=10).stdout
    assert "-method newton: a symmetry across no axis turns its nodes' dofs; allowed: xnewton" in said


def test_what_was_a_scene(tmp_path):
    """The script says in one line which case takes its place; that case is one."""
    code, stdout = execute([*FREEFEM, script(MOVED), "-mesh", "any.msh", "-u0", "0.5"])
    (line,) = stdout.strip().splitlines()
    assert code == 10 and "FreeFem++ edp/parts.edp -mesh FILE -case CASE" in line
    (tmp_path / "a.case").write_text(line.partition("with the lines: ")[2].replace("; ", "\n") + "\n")
    (tmp_path / "a.geo").write_text((PUNCH / "punch.geo").read_text())
    code, stdout = run_parts(tmp_path, "a.geo", "a.case", "-check", 1)
    assert code == 0, stdout


# ---------------------------------------------------------------- meshes


def joined():
    """The mesh of two blocks above each other that share the nodes between them."""
    mesh = two_blocks()
    same = {node: number + 1 for number, node in reversed(list(enumerate(mesh.nodes)))}
    mesh.elements = [
        (kind, tag, [same[mesh.nodes[corner - 1]] for corner in corners]) for kind, tag, corners in mesh.elements
    ]
    return mesh


LAYERS = STEEL + 'body upper E 10 nu 0.3\nclamp bottom\nobstacle "upper top" plane 0 3 0 -1\n'


def test_joined_bodies(tmp_path):
    """Bodies that share nodes are one part; edges between them can be no contact."""
    said = solve(tmp_path, joined().text(), LAYERS, "-check", 1).stdout
    assert "block+upper: E 100, nu 0.3 and E 10, nu 0.3; held by clamp bottom" in said
    case = LAYERS + 'contact top "upper bottom"\n'
    said = solve(tmp_path, joined().text(), case, expect=10).stdout
    assert 'edge of "top" inside the bodies, which share its nodes; allowed: each body\'s own nodes' in said


def test_space_in_the_plane(tmp_path):
    """Tetrahedra for parts.edp and triangles for parts-3d.edp are refused, each with what it wants."""
    (tmp_path / "block.msh").write_text(cube(Mesh()).text())
    code, why, _ = read(tmp_path, GOOD)
    assert code == 3 and "block: a volume of the mesh; allowed for body: its surfaces: " in why
    code, why, _ = read(tmp_path, GOOD.replace("circle 1.5 5 R 3 move 0 -0.1", "sphere 0 0 9 R 3"), space=1)
    assert (code, why) == (0, "")


@pytest.mark.parametrize("load", ["force 0 -{}", "move 0 -{}"])
def test_work_of_an_obstacle(tmp_path, load):
    """The energy's slope is the force on an obstacle that is moved, and minus the approach of one that is pushed."""
    mesh = block(Mesh(), cells=(60, 10)).text()
    case = STEEL + "move bottom 0 0.05\nobstacle top circle 1.5 5 R 3 " + load + "\n"
    at, step = (0.1, 1e-3) if "move" in load else (4, 0.04)
    before, after = (
        solve(tmp_path, mesh, case.format(at + k * step), "-tol", 1e-10, "-order", 1).summary for k in (-1, 1)
    )
    forces = [
        run["prescribed"][1]["force"] if "move" in load else run["obstacles"][0]["motion"][1] for run in (before, after)
    ]
    assert (after["energy"] - before["energy"]) / (2 * step) == pytest.approx(np.mean(forces), rel=1e-3)


QUARTER = 'SetFactory("OpenCASCADE");\nRectangle(1) = {0, 0, 0, 3, 3}; Disk(2) = {0, 0, 0, 1};\n'
QUARTER += 'BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };\nPhysical Surface("block") = {3};\n'
QUARTER += "".join(
    f'Physical Curve("{name}") = Curve In BoundingBox {{{box}}};\n'
    for name, box in {
        "left": "-0.01, 0.9, -1, 0.01, 3.1, 1",
        "low": "0.9, -0.01, -1, 3.1, 0.01, 1",
        "bore": "-0.01, -0.01, -1, 1.01, 1.01, 1",
        "top": "-0.1, 2.9, -1, 3.1, 3.1, 1",
        "right": "2.9, -0.1, -1, 3.1, 3.1, 1",
    }.items()
)
QUARTER += "Mesh.MeshSizeMax = 0.5;\n"


def test_mirror_images_that_cancel(tmp_path):
    """A quarter of a bore under pressure: the whole's resultant is 0, not 4 times the quarter's; a traction's is 2."""
    text = "body block E 1000 nu 0.3\nobstacle top plane 0 3 0 -1\nsymmetry left\nsymmetry low\n"
    text += "pressure bore 4\ntraction right 2 0\n"
    run = solve(tmp_path, QUARTER, text, "-vtu", 0)
    bore, right = run.summary["prescribed"]
    assert bore["force"] == pytest.approx(4 * 2**0.5, rel=1e-2) and bore["cancelled"] == pytest.approx(1, abs=1e-9)
    assert right["times"] == 2 and "cancelled" not in right
    assert "its mirror images cancel it" in run.stdout and "4 times as much" not in run.stdout


def test_motion_fixed_with_others(tmp_path):
    """A plate round a pin away from its middle turns about the pin: only motions together change no gap."""
    geo = 'SetFactory("OpenCASCADE");\nRectangle(1) = {-1.5, -1.5, 0, 6, 3}; Disk(2) = {0, 0, 0, 1};\n'
    geo += 'BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2}; Delete; };\nPhysical Surface("plate") = {4};\n'
    geo += 'Physical Curve("bore") = Curve In BoundingBox {-1.05, -1.05, -1, 1.05, 1.05, 1}; Mesh.MeshSizeMax = 0.2;\n'
    said = solve(tmp_path, geo, "body plate E 1000 nu 0.3\nobstacle bore circle 0 0 R 0.9\n", "-check", 1).stdout
    assert re.search(
        "^  note +plate: .* together with other motions of plate changes no gap and carries no load", said, re.M
    ), said


def test_nothing_presses_at_the_end_of_a_path(tmp_path):
    """A path that ends open is not told to raise its loads first; one load alone is."""
    text = "body block E 1000 nu 0.3\nobstacle top plane 0 3.1 0 -1 move 0 {}\nclamp low\n"
    for steps, words in (
        ("", "nothing presses on anything: the least gap left is 0.1: raise"),
        ("leg 1\n", "at the end of the last leg nothing"),
    ):
        path = text.format(0) if not steps else f"{text.format(-0.2)}leg 1\nleg 1\nobstacle top move 0 0\n"
        run = solve(tmp_path / str(len(steps)), QUARTER, path, "-vtu", 0)
        assert any(text.startswith(words) for text in run.summary["warnings"]), run.summary["warnings"]
