"""CalculiX (`ccx`): its input from a gmsh mesh of second order and a case file of the package, and its results.

A case file states the problem for both programs. `Deck` has a method for each statement that it translates; another
statement is an error. Contact is face to face, by a penalty.

Gives:
    mesh_of(path)                               Mesh
    Deck(mesh, case, contact, direct).text()    the input
    solve(folder, mesh, text, longest)          Result: the fields at the end of a run of ccx
    timed(command, folder, longest)             CPU seconds (user and system), exit code and printed text of a program
"""

import os
import re
import resource
import shlex
import subprocess
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

SIDES, ELEMENTS = (8, 9), (9, 11)  # gmsh's numbers of second order: plane, space
CORNERS = ((0, 1), (1, 2), (2, 0)), ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # of the faces S1, S2, ... of ccx
SWAPPED = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]  # C3D10 has gmsh's last two nodes the other way round
PLANE = {"strain": "CPE6", "stress": "CPS6", "axisymmetric": "CAX6"}
NEITHER = {"units", "line", "stresses"}  # statements that change no solution
OUTPUT = """*NODE FILE,OUTPUT=2D,FREQUENCY=1000
U
*EL FILE,FREQUENCY=1000
S
*CONTACT FILE,FREQUENCY=1000
CDIS,CSTR"""


# ---------------------------------------------------------------- the mesh


def quadratic(share: np.ndarray) -> np.ndarray:
    """Functions of second order at barycentric coordinates, in gmsh's order: corners, then edges."""
    pairs = [(0, 1), (1, 2), (2, 0), (3, 0), (2, 3), (1, 3)][: 3 * len(share) - 6]
    return np.array([a * (2 * a - 1) for a in share] + [4 * share[i] * share[j] for i, j in pairs])


def side_points(space: bool) -> list[tuple[np.ndarray, np.ndarray, float]]:
    """Functions, their slopes along the side, and weight, at the points of a quadrature of fifth degree."""
    if not space:
        points = [(-np.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (np.sqrt(0.6), 5 / 9)]
        shapes = [np.array([s * (s - 1) / 2, s * (s + 1) / 2, 1 - s * s]) for s, _ in points]
        slopes = [np.array([[s - 0.5, s + 0.5, -2 * s]]) for s, _ in points]
        return [(shape, slope, w) for shape, slope, (_, w) in zip(shapes, slopes, points, strict=True)]
    points, root = [(1 / 3, 1 / 3, 9 / 80)], np.sqrt(15)
    for c, w in (((6 - root) / 21, (155 - root) / 2400), ((6 + root) / 21, (155 + root) / 2400)):
        points += [(c, c, w), (1 - 2 * c, c, w), (c, 1 - 2 * c, w)]
    found = []
    for s, t, w in points:
        r = 1 - s - t
        along = (
            [1 - 4 * r, 4 * s - 1, 0, 4 * (r - s), 4 * t, -4 * t],
            [1 - 4 * r, 0, 4 * t - 1, -4 * s, 4 * s, 4 * (r - t)],
        )
        found.append((quadratic(np.array([r, s, t])), np.array(along), w))
    return found


@dataclass
class Mesh:
    """Places of the nodes (n, 3), numbers from 0; by group the nodes of its sides or elements, in gmsh's order."""

    place: np.ndarray
    sides: dict[str, np.ndarray]
    elements: dict[str, np.ndarray]

    @property
    def space(self) -> bool:
        return next(iter(self.elements.values())).shape[1] == 10

    @property
    def axes(self) -> int:
        return 2 + self.space

    def nodes(self, group: str) -> np.ndarray:
        return np.unique(self.sides[group] if group in self.sides else self.elements[group])

    def weights(self, group: str, axisymmetric: bool = False) -> np.ndarray:
        """(n,) integrals of the nodes' functions over the sides of a group; axisymmetric: over the whole circle."""
        found = np.zeros(len(self.place))
        for nodes in self.sides[group]:
            at = self.place[nodes]
            for shape, slopes, weight in side_points(self.space):
                along = slopes @ at
                size = np.linalg.norm(np.cross(*along) if self.space else along)
                found[nodes] += weight * size * shape * (2 * np.pi * (shape @ at)[0] if axisymmetric else 1)
        return found

    def at(self, point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Nodes of the element around a point, and their functions there; the sides are taken as straight."""
        elements = np.concatenate(list(self.elements.values()))
        corners = self.place[elements[:, : self.axes + 1], : self.axes]
        edges = (corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1)
        part = np.linalg.solve(edges, (point[: self.axes] - corners[:, 0])[..., None])[..., 0]
        share = np.column_stack([1 - part.sum(axis=1), part])
        best = share.min(axis=1).argmax()
        return elements[best], quadratic(share[best])


def mesh_of(path: Path) -> Mesh:
    """The mesh of a gmsh file of second order."""
    text = path.read_text()
    names = {(int(axes), int(tag)): name for axes, tag, name in re.findall(r'^(\d) (\d+) "(.*)"$', text, re.M)}
    section = lambda name: text.split(f"${name}\n")[1].split(f"$End{name}")[0].splitlines()[1:]  # noqa: E731
    nodes = [line.split() for line in section("Nodes")]
    number = {int(node[0]): k for k, node in enumerate(nodes)}
    rows = [[int(word) for word in line.split()] for line in section("Elements")]
    space = any(row[1] == ELEMENTS[1] for row in rows)
    found = {SIDES[space]: defaultdict(list), ELEMENTS[space]: defaultdict(list)}
    for _, kind, tags, group, *words in rows:
        if kind in found:
            axes = 1 + space + (kind == ELEMENTS[space])
            found[kind][names[axes, group]].append([number[k] for k in words[tags - 1 :]])
    sides, elements = ({name: np.array(each) for name, each in some.items()} for some in found.values())
    return Mesh(np.array([node[1:] for node in nodes], float), sides, elements)


# ---------------------------------------------------------------- the input


class Contact(NamedTuple):
    """Penalties for the pressure and for the shear of contact, pressure/length."""

    penalty: float
    stick: float


class Pair(NamedTuple):
    slave: str
    master: str
    friction: float


class Deck:
    """The input of a case. Its load steps are the first increments; with `direct` all increments."""

    def __init__(self, mesh: Mesh, case: str, contact: Contact, direct: bool = False):
        self.mesh, self.contact, self.direct = mesh, contact, direct
        self.state, self.model, self.held = "strain", [], []
        self.materials, self.warmer, self.pairs = defaultdict(list), {}, []
        self.legs: list[tuple[int, list[str]]] = []  # first increments, lines of the step
        self.tightened: dict[int, str] = {}  # number of the node that parts a cut: the force
        self.cuts = []  # (second nodes by the first ones, axis, height) of each preload
        self.moved: dict[str, None] = {}  # groups, in order
        self.places = list(mesh.place)  # of all nodes, with those that are added
        for line in case.splitlines():
            word, *rest = shlex.split(line, comments=True) or ["units"]
            if word in NEITHER:
                continue
            if not hasattr(self, f"on_{word}"):
                raise ValueError(f"{word}: this statement has no translation for CalculiX")
            getattr(self, f"on_{word}")(*rest)

    @property
    def circle(self) -> float:
        """The whole over what forces on axisymmetric faces are printed of: a wedge of two degrees."""
        return 180.0 if self.state == "axisymmetric" else 1.0

    def load(self, *lines: str) -> None:
        if not self.legs:
            self.on_leg(1)
        self.legs[-1][1].extend(lines)

    def on_state(self, state):
        self.state = state

    def on_body(self, body, *words):
        numbers = dict(zip(words[::2], words[1::2], strict=True))
        self.materials[body] += ["*ELASTIC", f"{numbers['E']},{numbers['nu']}"]

    def on_plastic(self, body, limit, hardening):
        self.materials[body] += ["*PLASTIC", f"{limit},0.", f"{float(limit) + float(hardening):g},1."]

    def on_expand(self, body, alpha, warmer):
        self.materials[body] += ["*EXPANSION", alpha]
        self.warmer[body] = warmer

    def on_contact(self, slave, master, *words):
        if words[::2] not in ((), ("friction",)):
            raise ValueError(f"contact with {' '.join(words)} has no translation for CalculiX")
        self.pairs.append(Pair(slave, master, float(words[1]) if words else 0.0))

    def on_clamp(self, group):
        self.held.append(f"{group},1,{self.mesh.axes}")

    def on_symmetry(self, group):
        extent = np.ptp(self.mesh.place[self.mesh.nodes(group), : self.mesh.axes], axis=0)
        (axis,) = np.flatnonzero(extent < 1e-9 * extent.max())
        self.held.append(f"{group},{axis + 1}")

    def on_leg(self, steps):
        self.legs.append((int(steps), []))

    def on_move(self, group, *way):
        self.load("*BOUNDARY", *(f"{group},{k},{k},{u}" for k, u in enumerate(way, 1)))
        self.moved[group] = None

    def on_traction(self, group, *stress):
        """By the forces at the nodes that do the same work."""
        weights, lines = self.mesh.weights(group, self.state == "axisymmetric"), ["*CLOAD"]
        for k, each in enumerate(map(float, stress), 1):
            lines += [f"{n + 1},{k},{weights[n] * each:.12g}" for n in self.mesh.nodes(group) if each]
        self.load(*lines)

    def on_force(self, group, *force):
        """Guided: all nodes of the group move alike along the force, and not across it."""
        (axis,) = (k for k, each in enumerate(force, 1) if float(each))
        self.held += [f"{group},{k}" for k in range(1, len(force) + 1) if k != axis]
        first, *others = self.mesh.nodes(group) + 1
        for node in others:
            self.model += ["*EQUATION", "2", f"{node},{axis},1.,{first},{axis},-1."]
        self.load("*CLOAD", f"{first},{axis},{force[axis - 1]}")

    def on_preload(self, group, force):
        """The nodes of the cut are doubled, and part by one length: a force in a step of its own, then held."""
        nodes = self.mesh.nodes(group)
        at = self.mesh.place[nodes]
        axis = int(np.ptp(at[:, : self.mesh.axes], axis=0).argmin())
        twins = {old: len(self.places) + k for k, old in enumerate(nodes)}
        self.places += [*at, at.mean(axis=0)]
        self.cuts.append((twins, axis, at[0, axis]))
        self.tightened[len(self.places)] = force
        for old, new in twins.items():
            for k in range(self.mesh.axes):
                apart = [f"{len(self.places)},1,1."] if k == axis else []
                if apart or self.state != "axisymmetric" or self.mesh.place[old, 0] > 0:
                    terms = [f"{new + 1},{k + 1},1.", f"{old + 1},{k + 1},-1.", *apart]
                    self.model += ["*EQUATION", str(len(terms)), ",".join(terms)]

    def doubled(self, nodes: np.ndarray) -> np.ndarray:
        """An element's nodes: above a cut its second ones."""
        for twins, axis, height in self.cuts:
            if self.mesh.place[nodes, axis].mean() > height:
                nodes = np.array([twins.get(n, n) for n in nodes])
        return nodes

    def text(self) -> str:
        lines = ["*NODE", *(f"{k},{x:.11g},{y:.11g},{z:.11g}" for k, (x, y, z) in enumerate(self.places, 1))]
        lines += [*self.groups(), *self.properties(), *self.model]
        lines += ["*INITIAL CONDITIONS,TYPE=TEMPERATURE", "EVERY,0."] if self.warmer else []
        steps = [(count, list(loads)) for count, loads in self.legs] or [(1, [])]
        if self.tightened:
            steps[0][1][:0] = ["*BOUNDARY,FIXED", *(f"{node},1" for node in self.tightened)]
            steps.insert(0, (1, ["*CLOAD", *(f"{node},1,{force}" for node, force in self.tightened.items())]))
        steps[0][1][:0] = ["*BOUNDARY", *self.held] if self.held else []
        warmer = ["*TEMPERATURE", *(f"B{body},{each}" for body, each in self.warmer.items())] if self.warmer else []
        for count, loads in steps:
            lines += ["*STEP,INC=1000", "*STATIC" + ",DIRECT" * self.direct, f"{1 / count:g},1."]
            lines += [*loads, *warmer, OUTPUT]
            for slave, master, _ in self.pairs:
                lines += [f"*CONTACT PRINT,SLAVE=S{slave},MASTER=S{master},FREQUENCY=1000", "CF"]
            for group in self.moved:
                lines += [f"*NODE PRINT,NSET={group},TOTALS=ONLY,FREQUENCY=1000", "RF"]
            lines += ["*END STEP"]
        return "\n".join(lines) + "\n"

    def groups(self) -> list[str]:
        """Elements, sets of nodes, and the faces of contacts."""
        lines, faces, count = [], {}, 0
        for body, elements in self.mesh.elements.items():
            lines += [f"*ELEMENT,TYPE={'C3D10' if self.mesh.space else PLANE[self.state]},ELSET={body}"]
            for nodes in elements:
                count += 1
                row = self.doubled(nodes)
                lines.append(f"{count}," + ",".join(str(n + 1) for n in (row[SWAPPED] if self.mesh.space else row)))
                for face, corners in enumerate(CORNERS[self.mesh.space], 1):
                    faces[frozenset(nodes[list(corners)])] = f"{count},S{face}"
        sets = {name: self.mesh.nodes(name) for name in self.mesh.sides} | {"EVERY": np.arange(len(self.places))}
        sets |= {f"B{body}": self.mesh.nodes(body) for body in self.warmer}
        for name, nodes in sets.items():
            lines += [f"*NSET,NSET={name}", *(f"{n + 1}," for n in nodes)]
        for group in dict.fromkeys(group for pair in self.pairs for group in pair[:2]):
            lines += [f"*SURFACE,NAME=S{group}"]
            lines += [faces[frozenset(side[: self.mesh.axes])] for side in self.mesh.sides[group]]
        return lines

    def properties(self) -> list[str]:
        """Materials and contacts."""
        lines = []
        for body, words in self.materials.items():
            lines += [f"*MATERIAL,NAME=M{body}", *words]
            lines += ["*EXPANSION", "0."] if self.warmer and body not in self.warmer else []
            lines += [f"*SOLID SECTION,ELSET={body},MATERIAL=M{body}", *([] if self.mesh.space else ["1."])]
        for slave, master, friction in self.pairs:
            name = f"I{slave}-{master}"
            lines += [f"*SURFACE INTERACTION,NAME={name}"]
            lines += ["*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR", f"{self.contact.penalty:g}"]
            lines += ["*FRICTION", f"{friction:g},{self.contact.stick:g}"] if friction else []
            lines += [f"*CONTACT PAIR,INTERACTION={name},TYPE=SURFACE TO SURFACE", f"S{slave},S{master}"]
        return lines


# ---------------------------------------------------------------- a run


def timed(command: list, folder: Path, longest: int) -> tuple[float, int, str]:
    """CPU seconds (user and system), exit code and words of a program; `longest`: seconds after which it is ended."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [str(word) for word in command],
        cwd=folder,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (longest, longest)),
        capture_output=True,
        text=True,
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"},
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, done.returncode, done.stdout + done.stderr


@dataclass
class Result:
    """A run: CPU seconds, iterations, increments, why it failed (or ""); at its end the fields and contact forces.

    fields, at the nodes: DISP (n, 3), STRESS (n, 6: xx yy zz xy yz xz),
    CONTACT (n, 6: gap, two slips, pressure, two shears).
    """

    seconds: float
    iterations: int
    increments: int
    message: str
    fields: dict[str, np.ndarray]
    contacts: list[np.ndarray]  # (3,) on the slaves, step by step
    reactions: list[np.ndarray]  # (3,) at the moved groups, step by step


def solve(folder: Path, mesh: Mesh, text: str, longest: int) -> Result:
    (folder / "a.inp").write_text(text)
    seconds, code, said = timed(["ccx", "-i", "a"], folder, longest)
    counts = len(re.findall(r"^ iteration +\d+", said, re.M))
    done = len(re.findall(r"^ +\d+ +\d+ .*$", (folder / "a.sta").read_text(), re.M))
    if code or "Job finished" not in said:
        lines = [line.strip() for line in said.splitlines() if "ERROR" in line or "too" in line] or [f"code {code}"]
        message = f"not done in {longest} s" if code < 0 else lines[-1]
        return Result(seconds, counts, done, message, {}, [], [])
    frd = (folder / "a.frd").read_text()
    fields = {name: field_of(frd, name, len(mesh.place)) for name in ("DISP", "STRESS", "CONTACT")}
    printed = (folder / "a.dat").read_text()
    contacts, reactions = (
        [np.array(line.split()[:3], float) for line in re.findall(rf"{words}.*\n\n(.*)\n", printed)]
        for words in ("total surface force", "total force")
    )
    return Result(seconds, counts, done, "", fields, contacts, reactions)


def field_of(frd: str, name: str, count: int) -> np.ndarray:
    """The last block of this name in a .frd file (count, columns); 0 at nodes that it leaves out."""
    rows = frd.split(f" -4  {name}")[-1].split(" -3")[0].splitlines()
    found = {int(row[3:13]): row[13:].rstrip() for row in rows if row.startswith(" -1")}
    values = np.zeros((count, max(len(row) for row in found.values()) // 12))
    for node, row in found.items():
        if node <= count:
            values[node - 1] = [float(row[k : k + 12]) for k in range(0, len(row), 12)]
    return values
