"""A case on meshes that are not what they should be: refused in one line or solved rightly, never a crash."""

import os
import resource
import subprocess
import time
from pathlib import Path

import pytest
from freefem import FREEFEM, ROOT, Run, environment, patience, wait_for
from shapes import polygon

NAMES = {"clamped": 11, "contact": 12, "master": 13, "pushed": 14, "free": 15, "lower": 21, "upper": 22}
SURFACES = ("lower", "upper")
MEMORY = 4 << 30  # bytes of address space
RESIDENT = 2 << 20  # kB
SECONDS = patience(30)
FLAGS = ["-order", "1", "-tol", "1e-11", "-vtu", "0", "-estimate", "0"]
CASE = """body lower E 100 nu 0.3
body upper E 100 nu 0.3
contact contact master gap vertical
clamp clamped
move pushed 0 -0.5
"""


class Mesh:
    """A block of 4 x 1 below a punch of 2.6 x 1: nodes {number: place}, lines and triangles [groups, nodes]."""

    def __init__(self):
        self.nodes, self.lines, self.triangles = {}, [], []
        self.names = dict(NAMES)
        self.grid(-2, 2, 0, 1, 9, 2, "lower", "clamped", "contact")
        self.grid(-1.3, 1.3, 1.1, 2.1, 4, 2, "upper", "master", "pushed")

    def grid(self, left, right, bottom, top, columns, rows, body, below, above):
        first = len(self.nodes) + 1
        for j in range(rows + 1):
            for i in range(columns + 1):
                place = left + (right - left) * i / columns, bottom + (top - bottom) * j / rows, 0.0
                self.nodes[first + i + j * (columns + 1)] = place
        number = [[first + i + j * (columns + 1) for i in range(columns + 1)] for j in range(rows + 1)]
        for j in range(rows):
            for i in range(columns):
                a, b, c, d = number[j][i], number[j][i + 1], number[j + 1][i + 1], number[j + 1][i]
                self.triangles += [[[body], [a, b, c]], [[body], [a, c, d]]]
        for i in range(columns):
            self.lines += [
                [[below], [number[0][i], number[0][i + 1]]],
                [[above], [number[rows][i], number[rows][i + 1]]],
            ]
        for j in range(rows):
            self.lines += [[["free"], [number[j][i], number[j + 1][i]]] for i in (0, columns)]

    def of(self, name):
        """The lines or triangles of a physical group."""
        return [entry for entry in self.lines + self.triangles if name in entry[0]]

    def text(self, number=str, coordinate=repr):
        """The file; an entity in several groups is written once for each, as gmsh does."""
        out = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(self.names))]
        out += [f'{2 if name in SURFACES else 1} {tag} "{name}"' for name, tag in self.names.items()]
        out += ["$EndPhysicalNames", "$Nodes", str(len(self.nodes))]
        out += [" ".join([number(i), *map(coordinate, place)]) for i, place in self.nodes.items()]
        elements = []
        for kind, entries in ((1, self.lines), (2, self.triangles)):
            for groups, corners in entries:
                for name in groups:
                    tag = self.names.get(name, NAMES.get(name, 99))
                    elements.append(f"{len(elements) + 1} {kind} 2 {tag} {tag} " + " ".join(map(number, corners)))
        return "\n".join([*out, "$EndNodes", "$Elements", str(len(elements)), *elements, "$EndElements", ""])


def moved(scale=1.0, right=0.0, up=0.0, only=None):
    """A change that scales and shifts the nodes, of one body only if it is named."""

    def change(mesh):
        of = {i for _, corners in (mesh.of(only) if only else mesh.triangles) for i in corners}
        for i in of:
            x, y, z = mesh.nodes[i]
            mesh.nodes[i] = (scale * x + right, scale * y + up, z)

    return change


def edited(old, new, count=1):
    """A change of the file's text."""

    def change(text):
        assert old in text
        return text.replace(old, new, count)

    return change


def line(n, new):
    """A change of the n-th line after $Nodes, or, n < 0, of the n-th one before $EndElements."""

    def change(text):
        lines = text.splitlines()
        at = lines.index("$Nodes") + 1 + n if n >= 0 else lines.index("$EndElements") + n
        lines[at] = new(lines[at]) if callable(new) else new
        return "\n".join(lines) + "\n"

    return change


def unnamed(*names):
    def change(mesh):
        for name in names:
            del mesh.names[name]

    return change


def renumbered(step, first=1):
    """The nodes numbered first, first + step, ..."""
    return lambda mesh: mesh.text(number=lambda i: str(first + step * (i - 1)))


def added(places, groups, *corners):
    """A change that adds nodes and a line or a triangle; corners below 0 are of these nodes, -1 the first."""

    def change(mesh):
        first = len(mesh.nodes)
        mesh.nodes |= {first + k: (*place, 0.0) for k, place in enumerate(places, 1)}
        numbers = [first - corner if corner < 0 else corner for corner in corners]
        if numbers:
            (mesh.lines if len(numbers) == 2 else mesh.triangles).append([[groups], numbers])

    return change


def add_interior(name):
    def change(mesh):
        a, _, c = mesh.of("upper" if name in ("master", "pushed") else "lower")[0][1]
        mesh.lines.append([[name], [a, c]])

    return change


def crack(mesh):
    """The inner corner of the middle triangles of the lower body doubled: what is left of it opens."""
    n = len(mesh.nodes)
    middle = 15
    mesh.nodes[n + 1] = mesh.nodes[middle]
    for _, corners in [entry for entry in mesh.of("lower") if middle in entry[1]][:2]:
        corners[corners.index(middle)] = n + 1


def split(mesh):
    """All nodes between the two middle columns doubled, two parts in one body that are not joined."""
    right = [e for e in mesh.triangles if "lower" in e[0] and sum(mesh.nodes[i][0] for i in e[1]) / 3 > 0.25]
    left = {i for e in mesh.of("lower") if len(e[1]) == 3 and e not in right for i in e[1]}
    twin = {}
    for entry in right + [e for e in mesh.lines if sum(mesh.nodes[i][0] for i in e[1]) / 2 > 0.25 and e[1][0] < 31]:
        for k, i in enumerate(entry[1]):
            if i in left:
                twin.setdefault(i, len(mesh.nodes) + len(twin) + 1)
                entry[1][k] = twin[i]
    mesh.nodes |= {new: mesh.nodes[old] for old, new in twin.items()}


def exchange(*pair):
    """Two groups exchange their lines."""

    def change(mesh):
        for groups, _ in mesh.lines:
            groups[:] = [pair[1 - pair.index(name)] if name in pair else name for name in groups]

    return change


def reverse(mesh):
    """The lines' ends exchanged: gmsh does so for groups of reversed curves; the order says nothing."""
    for _, corners in mesh.lines:
        corners.reverse()


def one_edge(mesh):
    """Contact of one edge only, below the punch's middle."""
    edges = mesh.of("contact")
    for groups, _ in edges[:4] + edges[5:]:
        groups[:] = ["free"]


def regrouped(name, index, new):
    """A line of a group goes to another one."""
    return lambda mesh: mesh.of(name)[index][0].__setitem__(slice(None), [new])


def share_node(mesh):
    for _, corners in mesh.lines + mesh.of("upper"):
        if 31 in corners:
            corners[corners.index(31)] = 22


def again(kind, index=0, name=None):
    """An entity once more, in its own group or in another one."""

    def change(mesh):
        entry = mesh.of(kind)[index]
        entry[0].append(name or entry[0][0])

    return change


# what is done to the mesh, or (edited, line) to its text; SAME: the untouched mesh's force, or another one; or words of
# the refusal
DANGLING = [(2.5, 1.0), (3.0, 1.0)]
SAME, SOLVED = "the same force", "a force"
MESHES = {
    # elements
    "triangle twice": (again("lower", 3), ["overlap"]),
    "triangle of both bodies": (again("lower", 3, "upper"), ["overlap"]),
    "triangle in no body": (lambda mesh: mesh.triangles[5][0].__setitem__(0, "all"), ["triangle in no body"]),
    "triangle without area": (lambda mesh: mesh.nodes.update({12: mesh.nodes[11]}), ["element", "without area"]),
    "triangle clockwise": (lambda mesh: mesh.triangles[5][1].reverse(), SAME),
    "three triangles on an edge": (added([(-1.9, 0.4)], "lower", 1, 12, -1), ["the third", "overlap"]),
    "folded triangle": (added([(-1.8, 0.2)], "lower", 1, 2, -1), ["same side", "overlap"]),
    "one triangle": (
        lambda mesh: vars(mesh).update(triangles=mesh.triangles[:1], lines=[]),
        ['"upper" has no triangle'],
    ),
    "quadrangle": (line(-1, "99 3 2 22 22 1 2 12 11"), ["element", "overlap"]),
    "quadrangle of second order": (line(-1, "99 10 2 22 22 1 2 12 11 1 2 12 11 1"), ["element 99", "overlap"]),
    "second order": (line(-1, "99 9 2 22 22 1 2 12 3 4 11"), ["element 99", "overlap"]),
    "tetrahedron": (line(-1, "99 4 2 22 22 1 2 12 11"), ["element 99", "tetrahedron"]),
    "corner missing": (line(-1, lambda old: old.rsplit(" ", 1)[0]), ["element", "cut off"]),
    "corner not there": (line(-1, lambda old: old.rsplit(" ", 1)[0] + " 777"), ["node that is missing: 777"]),
    "element without tags": (line(-1, lambda old: "99 2 0 " + " ".join(old.split()[5:])), ["in no body"]),
    # lines
    "contact edge twice": (again("contact", 4), SAME),
    "edge in one more curve": (again("contact", 4, "free"), SAME),
    "edge in contact and clamped": (again("contact", 0, "clamped"), ["two physical groups", "clamped"]),
    "lines reversed": (reverse, SAME),
    "dangling line": (added(DANGLING, "free", -1, -2), SAME),
    "dangling contact": (added(DANGLING, "contact", -1, -2), ["element", '"contact"', "no triangle has"]),
    "contact inside": (add_interior("contact"), ['"contact" inside the bodies']),
    "free inside": (add_interior("free"), SAME),
    "contact and master exchanged": (exchange("contact", "master"), SOLVED),
    "clamped partly on the upper body": (regrouped("free", -1, "clamped"), ["line 5", "elsewhere"]),
    "contact in two pieces": (regrouped("contact", 4, "free"), SOLVED),
    "vertical edge": (regrouped("free", 0, "contact"), SAME),
    # nodes
    "node of no element": (added([(50.0, 50.0)], ""), SAME),
    "node number 0": (renumbered(1, 0), ["the node 0", "start at 1"]),
    "negative node number": (line(3, lambda old: "-" + old), ["the node -3"]),
    "node number of no number": (line(3, lambda old: "x" + old), ["the node x3"]),
    "sparse node numbers": (renumbered(1000, 7), SAME),
    "nodes not in order": (
        lambda mesh: setattr(mesh, "nodes", dict(sorted(mesh.nodes.items(), key=lambda n: -n[0]))),
        SAME,
    ),
    "node twice": (line(3, lambda old: old.replace("3 ", "2 ", 1)), ["node 2", "twice"]),
    "coordinate nan": (line(3, "3 nan 0 0"), ["node 3", "nan is no number"]),
    "coordinate hexadecimal": (line(3, "3 0x10 0 0"), ["0x10 is no number"]),
    "comma decimals": (lambda mesh: mesh.text(coordinate=lambda v: repr(v).replace(".", ",")), ["is no number"]),
    "coordinate missing": (line(3, "3 0.5 0"), ["node 3", "2 coordinates"]),
    "off the plane": (lambda mesh: mesh.nodes.update({5: (*mesh.nodes[5][:2], 0.1)}), ["z goes from 0 to 0.1"]),
    "plane z = 1": (
        lambda mesh: mesh.nodes.update({i: (x, y, 1.0) for i, (x, y, _) in mesh.nodes.items()}),
        ["z = 0 everywhere"],
    ),
    "huge": (moved(1e12), 0.0),
    "tiny": (moved(1e-12), ["too small"]),
    "too far away": (moved(right=1e12), ["too far"]),
    # bodies
    "crack": (crack, ["share no nodes", "crack"]),
    "body in two parts": (split, ["share no nodes"]),
    "bodies share a node": (share_node, ["node 22", "hinge"]),
    "piece that nothing holds": (
        added([(5.0, 0.0), (6.0, 0.0), (5.0, 1.0)], "lower", -1, -2, -3),
        ["lower at", "nothing holds it"],
    ),
    "piece that hangs on a node": (added([(3.0, 0.0), (3.0, 1.0)], "lower", 10, -1, -2), ["node 10", "hinge"]),
    "bodies overlap": (moved(up=-0.3, only="upper"), SOLVED),
    "master below": (moved(up=-5, only="upper"), ["line 3", "nothing lies opposite it"]),
    "bodies aside": (moved(right=30, only="upper"), ["line 3", "nothing lies opposite it"]),
    # names and sections
    "no names": (lambda mesh: mesh.names.clear(), ["no physical groups"]),
    "names missing": (unnamed("contact", "upper"), ["line 2: upper: no physical surface", "allowed: lower"]),
    "no $PhysicalNames": (lambda mesh: _without_names(mesh.text()), ["no physical groups"]),
    "name with a blank": (edited('"free"', '"free sides"'), SAME),
    "name of a curve on a surface": (edited('2 21 "lower"', '1 21 "lower"'), ["line 1: lower: a curve of the mesh"]),
    "unknown section": (edited("$Nodes", "$Periodic\n1\n0 1 2\n$EndPeriodic\n$Nodes"), SAME),
    "comments first": (edited("$MeshFormat", "$Comments\nmade by hand\n$EndComments\n$MeshFormat"), SAME),
    "CRLF": (lambda mesh: mesh.text().replace("\n", "\r\n"), SAME),
    "no last line end": (lambda mesh: mesh.text().rstrip(), SAME),
    "second $Nodes": (edited("$Elements", "$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements"), ["second $Nodes"]),
    "nodes miscounted": (edited("$Nodes\n45", "$Nodes\n1000000000"), ["$Nodes has 45 lines"]),
    "cut off": (lambda mesh: mesh.text()[:-200], ["cut off"]),
    "empty": (lambda mesh: "", ["an empty file"]),
    "version 3": (edited("2.2 0 8", "3 0 8"), ["version 3"]),
    "said to be binary": (edited("2.2 0 8", "2.2 1 8"), ["no "]),  # triangles (gmsh 4.8), physical groups (4.12)
    "said to be version 4": (edited("2.2 0 8", "4.1 0 8"), ["gmsh"]),
}


def _without_names(text):
    head, rest = text.split("$PhysicalNames\n")
    return head + rest.split("$EndPhysicalNames\n")[1]


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def attempt(file, folder):
    """A run in little memory, within a minute: Run."""
    out = str(folder / "out")
    (folder / "two.case").write_text(CASE)
    files = ["-mesh", str(file), "-case", str(folder / "two.case"), "-out", out]
    process, stdout = in_little(folder, [*FREEFEM, "edp/parts.edp", *files, *FLAGS])
    assert not copies(process)
    return Run(process.returncode, stdout, folder / "out")


def checked(file, folder):
    """What FreeFEM would read of a mesh, and why it would not: (text or None, the reason)."""
    copy = folder / "copy"
    (folder / "two.case").write_text(CASE)
    command = ["sh", "edp/input/read-case.sh", os.getpid(), file, copy, folder / "two.case", 0]
    process, stdout = in_little(folder, list(map(str, command)))
    assert process.returncode in (0, 1, 3) and not stdout
    name = "why" if process.returncode else "mesh.msh"
    text = (copy / name).read_text()
    copy.rename(folder / f"checked {process.pid}")  # whoever made it waits for its name to go
    return (None, text) if process.returncode else (text, None)


def in_little(folder, command):
    """A command in little memory, within a minute: (process, output)."""
    began = time.monotonic()
    with open(folder / "stdout", "wb") as stdout:
        process = subprocess.Popen(
            command,
            cwd=ROOT,
            env=environment(LC_ALL="C"),
            stdin=subprocess.DEVNULL,
            stdout=stdout,
            stderr=stdout,
            preexec_fn=limited,
        )
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    assert time.monotonic() - began < SECONDS
    assert usage.ru_maxrss < RESIDENT
    return process, (folder / "stdout").read_text(errors="replace")


def copies(process):
    """The folders that a run has made for its copy of the mesh."""
    return list(Path("/tmp").glob(f"mesh-{process.pid}-*"))


def assert_refused(run, file, words):
    assert run.code == 10, run.stdout[-2000:]
    lines = run.stdout.strip().splitlines()
    assert len(lines) == 1, run.stdout
    for word in [*words, "allowed"]:
        assert word in lines[0]
    assert str(file) in lines[0] or "two.case" in lines[0]
    assert not run.folder.exists()


@pytest.fixture(scope="module")
def untouched(tmp_path_factory):
    """Of the mesh as it is, the force and what FreeFEM reads."""
    folder = tmp_path_factory.mktemp("untouched")
    (folder / "mesh.msh").write_text(Mesh().text())
    run = attempt(folder / "mesh.msh", folder)
    assert run.code == 0, run.stdout
    assert not [said for said in run.summary["warnings"] if "strains are taken to be small" not in said]
    return run.force, checked(folder / "mesh.msh", folder)[0]


# refused by the run, which sees where the bodies are, and some of those that the script before it refuses
REFUSED_BY_A_RUN = ("master below", "bodies aside", "empty", "corner missing")
REFUSED_BY_A_RUN += ("clamped partly on the upper body", "piece that nothing holds")


@pytest.mark.parametrize("name", MESHES)
def test_hostile(name, tmp_path, untouched):
    """A mesh shall be refused in one line that names the file and what is wrong, or solved rightly."""
    change, expected = MESHES[name]
    mesh = Mesh()
    if change.__qualname__.startswith(("edited", "line")):
        text = change(mesh.text())
    else:
        text = change(mesh)
        text = text if isinstance(text, str) else mesh.text()
    file = tmp_path / "hostile.msh"
    file.write_text(text, newline="")
    if name in REFUSED_BY_A_RUN:
        assert_refused(attempt(file, tmp_path), file, expected)
        return
    copy, why = checked(file, tmp_path)
    if isinstance(expected, list):
        (line,) = why.splitlines()
        for word in expected:
            assert word in line
        return
    force, same = untouched
    if expected == SAME and copy == same:
        return  # FreeFEM reads the same
    run = attempt(file, tmp_path)
    assert run.code == 0, run.stdout[-2000:]
    assert run.summary["outOfBalance"] < (1e-9 if run.force else 1e-6)  # of the rounding of no force
    if expected == SOLVED:
        assert run.force > 0
    else:
        assert run.force == pytest.approx(force if expected == SAME else expected, rel=1e-9)


def test_one_edge(tmp_path, untouched):
    """Contact of a single edge shall carry less than the whole curve, and say that it is cut off."""
    mesh = Mesh()
    one_edge(mesh)
    (tmp_path / "edge.msh").write_text(mesh.text())
    run = attempt(tmp_path / "edge.msh", tmp_path)
    assert 0 < run.force < untouched[0]
    assert any("reaches the end" in text for text in run.summary["warnings"])


def test_files(tmp_path, untouched):
    """A folder, a file that is not there or may not be read shall be refused; odd names shall work."""
    assert_refused(attempt(tmp_path, tmp_path), tmp_path, ["a folder"])
    file = tmp_path / "quote's a=b, blanks.msh"
    assert_refused(attempt(file, tmp_path), file, ["no such file"])
    file.write_text(Mesh().text().replace('"upper"', '"\033[31mupper"'))
    assert_refused(attempt(file, tmp_path), file, ["a control character in a group's name"])
    file.write_text(Mesh().text())
    assert attempt(file, tmp_path).force == pytest.approx(untouched[0], rel=1e-9)
    file.chmod(0)
    assert checked(file, tmp_path) == ((untouched[1], None) if os.geteuid() == 0 else (None, "may not be read"))


GEO = polygon("lower", 0.5, ["-2, 0", "2, 0", "2, 1", "-2, 1"], {1: "clamped", 3: "contact"})
UPPER = ["-1.2, 1.1", "1.2, 1.1", "1.2, 2.1", "-1.2, 2.1"]
GEO += polygon("upper", "0.5", UPPER, {1: "master", 3: "pushed"}, 5)


CROSSED = """Point(1) = {0, 0, 0, 1}; Point(2) = {2, 2, 0, 1}; Point(3) = {2, 0, 0, 1}; Point(4) = {0, 2, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1}; Physical Surface("upper") = {1}; Physical Curve("master") = {1};
"""


@pytest.mark.parametrize(
    "text, words",
    [
        (
            "Point(1) = {0, 0;\n",
            ["gmsh cannot read it: '", "line 1: syntax error", "; allowed: a geometry without this error. "],
        ),
        (CROSSED, ["gmsh reads it, but cannot mesh it: ", "; allowed: another size of elements, another algorithm"]),
        ("Point(1) = {0, 0, 0};", ["no surface in it"]),
        (GEO.replace("Physical", "// Physical"), ["no physical groups"]),
        (GEO.replace('"master"', '"Master"'), ["line 3: master: no physical curve", "did you mean Master?"]),
    ],
    ids="broken crossed point unnamed misnamed".split(),
)
def test_refused_geo(text, words, tmp_path):
    """What gmsh cannot read, or reads as another mesh than the scene wants, shall be refused."""
    (tmp_path / "bodies.geo").write_text(text)
    _, why = checked(tmp_path / "bodies.geo", tmp_path)
    for word in words:
        assert word in why
    if "gmsh" in words[0]:
        assert_refused(attempt(tmp_path / "bodies.geo", tmp_path), tmp_path / "bodies.geo", words)


def test_quadrangles_of_a_geometry(tmp_path):
    """They are cut to triangles."""
    (tmp_path / "bodies.geo").write_text(GEO + "Recombine Surface{1, 2};")
    copy, why = checked(tmp_path / "bodies.geo", tmp_path)
    kinds = [row.split()[1] for row in copy.split("$Elements")[1].splitlines()[2:-1]]
    assert why is None and set(kinds) == {"1", "2"} and kinds.count("2") > 30


def test_nothing_left_when_killed(tmp_path):
    """The copy shall go also when the run is killed while it is made."""
    (tmp_path / "slow.geo").write_text(GEO.replace("0, 0.5}", "0, 0.004}"))
    (tmp_path / "two.case").write_text(CASE)
    files = ["-mesh", tmp_path / "slow.geo", "-case", tmp_path / "two.case", "-out", tmp_path / "out"]
    command = [*FREEFEM, "edp/parts.edp", *files]
    process = subprocess.Popen(
        command, cwd=ROOT, env=environment(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL
    )
    wait_for(lambda: copies(process))
    process.kill()
    process.wait()
    wait_for(lambda: not copies(process))
