"""Plastic bodies in space, with tables and kinematic hardening, friction and pretension; plane stress."""

import itertools
import re

import numpy as np
import plasticity
import pytest
from freefem import ROOT, cases_of, data, part, snippet, told
from input.test_parts import Mesh, block, cube, turn_in_space
from output.test_paraview import Grid

# ---------------------------------------------------------------- the material at a point, in 3 x 3 tensors

COMPONENTS = (0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)


class Material:
    """Backward Euler, written with tensors and a search for the increment: nothing of it is the package's."""

    def __init__(self, E, nu, Y, table=(), H=0.0, C=0.0):
        self.shear, self.bulk, self.Y, self.C = E / (2 * (1 + nu)), E / (3 * (1 - 2 * nu)), Y, C
        self.rows = [(0, Y), *table, (1e3, table[-1][1])] if table else [(0, Y), (1e3, Y + 1e3 * H)]
        self.flow, self.hard = np.zeros((3, 3)), 0.0

    def limit(self, hard):
        return np.interp(hard, *zip(*self.rows, strict=True))

    def stored(self):
        at = np.linspace(0, self.hard, 200001)
        return np.trapezoid(self.limit(at) - self.Y, at) + self.C / 3 * (self.flow**2).sum()

    def step(self, strain, keep=True):
        """The stress at this strain; keep: it is the end of a step."""
        dev = strain - np.eye(3) * np.trace(strain) / 3
        trial = 2 * self.shear * (dev - self.flow) - 2 / 3 * self.C * self.flow
        size = np.sqrt(1.5 * (trial**2).sum())
        low, high = 0.0, size / self.shear
        for _ in range(200 if size > self.limit(self.hard) else 0):
            more = (low + high) / 2
            over = size - (3 * self.shear + self.C) * more - self.limit(self.hard + more)
            low, high = (more, high) if over > 0 else (low, more)
        more = (low + high) / 2 if size > self.limit(self.hard) else 0.0
        flow = self.flow + 1.5 * more * trial / max(size, 1e-300)
        if keep:
            self.flow, self.hard = flow, self.hard + more
        return self.bulk * np.trace(strain) * np.eye(3) + 2 * self.shear * (dev - flow)

    def plane_step(self, strain):
        """The same with no stress along z, whose strain is searched."""
        low, high = -1.0, 1.0
        for _ in range(200):
            strain[2, 2] = (low + high) / 2
            low, high = (low, strain[2, 2]) if self.step(strain, False)[2, 2] > 0 else (strain[2, 2], high)
        return self.step(strain)


TABLE = ((0.004, 1.6), (0.012, 2.1), (0.03, 2.2))
TEXT = "table " + " ".join(f"{a} {b}" for a, b in TABLE)
HARDENINGS = {
    TEXT: {"table": TABLE},
    "60 kinematic 80": {"H": 60, "C": 80},
    f"{TEXT} kinematic 40": {"table": TABLE, "C": 40},
}


@pytest.mark.parametrize("hardening", HARDENINGS, ids=["table", "kinematic", "both"])
@pytest.mark.parametrize("state", ["space", "stress", "strain"])
def test_random_strains(tmp_path, state, hardening):
    """Random strain paths through all components: a second integration at a point to 1e-8, on curved elements too."""
    space = state == "space"
    size = 3 if space else 2
    rng = np.random.default_rng([*map(ord, state + hardening)])
    turns = rng.normal(size=(12, size, size)) * 6e-3
    path = np.cumsum(turns, axis=0)
    (tmp_path / "strains.txt").write_text(
        f"{len(path)}\n" + "\n".join(" ".join(map(repr, p.ravel().tolist())) for p in path) + "\n"
    )
    case = f"body block E 1000 nu 0.3\nplastic block 1 {hardening}\n"
    if space:
        case, mesh = case.replace("block", "ball") + "clamp x\nobstacle y plane 0 9 0 0 -1 0\n", shell([1, 1.5], 2)
    else:
        case = f"state {state}\n{case}clamp bottom\nobstacle top plane 0 9 0 -1\n"
        mesh = block(Mesh(), cells=(2, 2)).text()
    (tmp_path / "a.msh").write_text(mesh)
    (tmp_path / "a.case").write_text(case)
    scripts = ["parts-3d", "parts"] if space else ["parts"]
    texts = [(ROOT / f"edp/{name}.edp").read_text() for name in scripts]
    options = "".join(f"macro {name}OnRequest() 1 //\n" for name in ("plastic", "friction", "stresses", "moments"))
    text = (
        options + "".join(re.sub(r'include "parts.*', "", part) for part in texts).split("checkOpposingSurfaces();")[0]
    )
    found = told(snippet(tmp_path, text + data("plastic-strains.edp"), "-mesh", "a.msh", "-case", "a.case"))
    point = Material(1000, 0.3, 1, **HARDENINGS[hardening])
    plane = 1000 / (1 - 0.3**2) * np.array([[1, 0.3], [0.3, 1]])
    count = 6 if space else 4
    for k, gradient in enumerate(path):
        strain = np.zeros((3, 3))
        strain[:size, :size] = (gradient + gradient.T) / 2
        stress = point.plane_step(strain) if state == "stress" else point.step(strain)
        row = found[f"step{k}"]
        assert row[:count] == pytest.approx([point.flow[c] for c in COMPONENTS[:count]], abs=1e-8)
        assert row[count] == pytest.approx(point.hard, abs=1e-8)
        # the load of the plastic strain works as the elastic stress less the stress
        elastic = point.bulk * np.trace(strain) * np.eye(3) + 2 * point.shear * (
            strain - np.eye(3) * np.trace(strain) / 3
        )
        if state == "stress":
            elastic = np.zeros((3, 3))
            elastic[[0, 1], [0, 1]] = plane @ strain[[0, 1], [0, 1]]
            elastic[0, 1] = elastic[1, 0] = 2 * point.shear * strain[0, 1]
            elastic[2, 2] = stress[2, 2] = 0
        work = ((elastic - stress)[:size, :size] * strain[:size, :size]).sum()
        assert row[count + 1] == pytest.approx(work, rel=1e-7)
        assert row[count + 2] == pytest.approx(point.stored(), rel=1e-6)
    assert point.hard > 0.02 and found["spread"] < 1e-12
    assert found["stiffness"] < 1e-11


# ---------------------------------------------------------------- closed forms


def shell(radii, m):
    """An eighth of a hollow ball, second-order tetrahedra, as text; groups inside, outside, x, y, z, ball."""
    index = {(i, j, m - i - j): None for i in range(m + 1) for j in range(m + 1 - i)}
    index = {key: k for k, key in enumerate(index)}
    ways = np.array([*index], float)
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    faces = []
    for i, j, k in index:
        faces += [[(i, j, k), (i + 1, j, k - 1), (i, j + 1, k - 1)]] * (k > 0)
        faces += [[(i + 1, j, k - 1), (i + 1, j + 1, k - 2), (i, j + 1, k - 1)]] * (k > 1)
    n, count = len(ways), len(radii) - 1
    way, radius = np.concatenate([ways] * len(radii)), np.repeat(radii, n)
    at = way * radius[:, None]
    bodies = []
    for layer, face in itertools.product(range(count), faces):
        low = [layer * n + index for index in sorted(index[corner] for corner in face)]
        high = [corner + n for corner in low]
        for cut in range(3):
            corners = [*low[: cut + 1], *high[cut:]]
            upright = np.linalg.det(at[corners[1:]] - at[corners[0]]) > 0
            bodies.append(corners if upright else [corners[1], corners[0], *corners[2:]])
    nodes, middles = list(at), {}

    def middle(a, b):
        key = min(a, b), max(a, b)
        if key not in middles:
            direction = way[a] + way[b]
            middles[key] = len(nodes)
            nodes.append(direction / np.linalg.norm(direction) * (radius[a] + radius[b]) / 2)
        return middles[key]

    sides = {}
    for corners in bodies:
        for face in itertools.combinations(corners, 3):
            sides.setdefault(frozenset(face), []).append(face)
    names = ["inside", "outside", "x", "y", "z", "ball"]
    rows = []
    for face, *others in sides.values():
        a, b, c = face
        place = at[[a, b, c]]
        on = [np.allclose(radius[[a, b, c]], radii[end]) for end in (0, -1)]
        on += [np.allclose(place[:, axis], 0) for axis in range(3)]
        if not others:
            rows.append((9, 1 + on.index(True), [a, b, c, middle(a, b), middle(b, c), middle(c, a)]))
    for a, b, c, d in bodies:
        edges = (a, b), (b, c), (a, c), (a, d), (c, d), (b, d)
        rows.append((11, 6, [a, b, c, d, *(middle(*edge) for edge in edges)]))
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", len(names)]
    lines += [f'{2 + (k == 5)} {k + 1} "{name}"' for k, name in enumerate(names)]
    lines += ["$EndPhysicalNames", "$Nodes", len(nodes)]
    lines += [" ".join([str(k + 1), *map(repr, map(float, node))]) for k, node in enumerate(nodes)]
    lines += ["$EndNodes", "$Elements", len(rows)]
    lines += [
        " ".join(map(str, (k + 1, kind, 2, tag, tag, *(c + 1 for c in f)))) for k, (kind, tag, f) in enumerate(rows)
    ]
    return "\n".join(map(str, [*lines, "$EndElements", ""]))


@pytest.mark.parametrize("layers, m, most", cases_of([(8, 6, 1e-2)], [(12, 14, 1e-3)]))
def test_hollow_ball(tmp_path, layers, m, most):
    """Hill's hollow ball under pressure: the plastic radius, and the mean stresses of two layers of nodes."""
    b, c = 2.0, 1.5
    pressure = float(2 * np.log(c) + 2 / 3 * (1 - c**3 / b**3))
    case = "body ball E 1000 nu 0.3\nplastic ball 1 0\nsymmetry x\nsymmetry y\nsymmetry z\n"
    case += f"obstacle outside plane 0 0 9 0 0 -1\nleg 4\npressure inside {pressure!r}\n"
    run = part(tmp_path, shell(np.linspace(1, b, layers + 1), m), case, "-vtu", 1, "-estimate", 0, space=True)
    volume = run.summary["plastic"]["bodies"][0]["volume"]
    assert (1 + 6 * volume / np.pi) ** (1 / 3) == pytest.approx(c, abs=1e-3)
    assert run.factorisations == 1
    grid = Grid(run.folder / "solution.vtu")
    at = np.array(grid.points)
    r = np.linalg.norm(at, axis=1)
    tensor = np.zeros((len(r), 3, 3))
    for i, j in COMPONENTS:
        tensor[:, i, j] = tensor[:, j, i] = grid.at_points["stress" + "XYZ"[i] + "XYZ"[j] + "[pressure]"]
    radial = np.einsum("ri,rij,rj->r", at, tensor, at) / r**2
    hoop = (np.einsum("rii->r", tensor) - radial) / 2
    inner = r < c
    exact = np.where(inner, 2 * np.log(r / c) - 2 / 3 * (1 - (c / b) ** 3), 2 / 3 * (c / b) ** 3 * (1 - (b / r) ** 3))
    across = np.where(inner, exact + 1, 2 / 3 * (c / b) ** 3 * (1 + (b / r) ** 3 / 2))
    off = [
        [(found - true)[abs(r - q) < 1e-6].mean() for q in np.unique(r.round(9))]
        for found, true in ((radial, exact), (hoop, across))
    ]
    pairs = (np.array(off)[:, 1:] + np.array(off)[:, :-1]) / 2  # the pressure alternates between layers
    layer = np.linspace(1, b, pairs.shape[1] * 2 + 1)[1::2]
    assert abs(pairs[:, abs(layer - c) > 0.1]).max() < most


class Bar:
    """Backward Euler in one direction, with a stress along the bar alone; it leaves the plane instead of a pull."""

    def __init__(self, H, C):
        self.H, self.C, self.flow, self.hard = H, C, 0.0, 0.0

    def step(self, strain, keep):
        trial = 1000 * (strain - self.flow) - self.C * self.flow
        more = np.sign(trial) * max(0, abs(trial) - 1 - self.H * self.hard) / (1000 + self.H + self.C)
        stress = 1000 * (strain - self.flow - more)
        if stress < 0 and keep:
            self.flow, self.hard = self.flow + more, self.hard + abs(more)
        return min(stress, 0)


def place_of(bars, foot, force):
    """Where a plane on two bars stands under a force, the second bar's foot being lifted; the bars keep their state."""
    low, high = -0.1, 0.1
    for _ in range(60):
        place = (low + high) / 2
        total = bars[0].step(place, False) + bars[1].step(place - foot, False)
        low, high = (low, place) if total > -force else (place, high)
    bars[0].step(place, True)
    bars[1].step(place - foot, True)
    return place


class OneTop(Mesh):
    """The tops of all blocks are one group."""

    def group(self, dimension, name):
        return super().group(dimension, "top" if name.endswith("top") else name)


@pytest.mark.parametrize("hardening", ["0", "0 kinematic 200", "100"])
def test_two_bars(tmp_path, hardening):
    """Ratchetting under a constant force and a foot that goes up and down; kinematic hardening ends it."""
    force, lift, cycles, steps = 1.5, 0.004, 4, 8
    mesh = cube(OneTop(), size=(1, 1, 1), cells=(1, 1, 1), prefix="a", name="one")
    mesh = cube(mesh, size=(1, 1, 1), cells=(1, 1, 1), at=(3, 0, 0), prefix="b", name="two")
    case = f"body one E 1000 nu 0.3\nbody two E 1000 nu 0.3\nplastic one 1 {hardening}\nplastic two 1 {hardening}\n"
    case += "".join(f"symmetry {bar}{side}\n" for bar in "ab" for side in ("back", "left")) + "symmetry abottom\n"
    case += f"move bbottom * * 0\nleg 1\nobstacle top plane 0 0 1 0 0 -1 force 0 0 {-force}\n"
    case += "".join(f"leg {steps}\nmove bbottom * * {end}\n" for end in [lift, 0] * cycles)
    run = part(tmp_path, mesh.text(), case, "-estimate", 0, space=True)
    words = hardening.split()
    bars = [Bar(float(words[0]), float(words[-1]) if len(words) > 1 else 0.0) for _ in range(2)]
    way = [*np.arange(1, steps + 1) / steps, *np.arange(steps - 1, -1, -1) / steps]
    feet = [0.0, *(lift * share for _ in range(cycles) for share in way)]
    places = [place_of(bars, foot, force) for foot in feet]
    found = [body["strainMax"] for body in run.summary["plastic"]["bodies"]]
    assert found == pytest.approx([bar.hard for bar in bars], abs=2e-7)
    if hardening == "0":  # the plane sinks by this much in each cycle
        assert np.diff(places[2 * steps :: 2 * steps]) == pytest.approx(-(lift - 2 * (2 - force) / 1000), abs=1e-9)


BAR_PULLED = """state {state}
body block E 1000 nu 0.3
plastic block 1 {hardening}
symmetry bottom
{side}
symmetry top
obstacle right plane 9 0 -1 0
preload cut {force}
leg {steps}
"""


@pytest.mark.parametrize("hardening, steps", [("50", 2), ("0 kinematic 50", 4)])
def test_tightened(tmp_path, hardening, steps):
    """A bar between symmetry planes, tightened until it yields: its shortening, in plane stress in closed form."""
    mesh = block(Mesh(), size=(0.5, 1), cells=(4, 8))
    mesh.elements += [(1, mesh.group(1, "cut"), [21 + i, 22 + i]) for i in range(4)]
    force = 0.6
    case = BAR_PULLED.format(state="stress", hardening=hardening, side="symmetry left", force=force, steps=steps)
    run = part(tmp_path, mesh.text(), case, "-estimate", 0, "-vtu", 1)
    stress = force / 0.5
    at = Grid(run.folder / "solution.vtu").at_points
    assert at["stressYY[pressure]"] == pytest.approx(stress, rel=1e-4)
    assert at["vonMises[pressure]"] == pytest.approx(stress, rel=1e-4)
    assert abs(at["stressZZ[pressure]"]).max() < 1e-4
    (bolt,) = run.summary["preloads"]
    strain = (stress - 1) / 50
    assert bolt["shortened"] == pytest.approx(stress / 1000 + strain, rel=1e-4)
    assert bolt["force"] == pytest.approx(force, rel=1e-4)
    assert run.summary["plastic"]["bodies"][0]["strainMax"] == pytest.approx(strain, rel=1e-4)
    entry = run.summary["plastic"]
    assert entry["dissipated"] == pytest.approx(0.5 * strain, rel=1e-4)
    stored = 0.5 * (stress**2 / 2000 + 25 * strain**2)
    assert entry["storedElastic"] + entry["storedByHardening"] == pytest.approx(stored, rel=1e-3)


# ---------------------------------------------------------------- friction, turned problems, a ball


def pushed(matrix, friction, legs, plastic, length=1.0):
    """A cube on a clamped foot, pressed and pushed aside by a rigid plane with friction, the whole turned."""
    place = " ".join(map(repr, (matrix @ (1, 1, 1)).tolist()))
    inward = " ".join(map(repr, (matrix @ (0, 0, -1)).tolist()))
    text = f"body block E 1000 nu 0.3\n{plastic}clamp bottom\n"
    for k, (steps, motion) in enumerate(legs):
        move = " ".join(map(repr, (matrix @ motion).tolist()))
        head = (
            f"obstacle top plane {place} {inward} move {move} friction {friction}"
            if k == 0
            else f"obstacle top move {move}"
        )
        text += f"leg {steps}\n{head}\n"
    return text


LEGS = (2, (0, 0, -0.008)), (3, (0.006, 0.002, -0.008))


def test_turned_with_friction(tmp_path):
    """A body that yields under a plane with friction, and the same turned: the same forces, strains and energies."""
    found, rubbed = [], []
    mesh = cube(Mesh(), size=(2, 2, 1), cells=(3, 3, 2))
    for seed in (None, 3):
        matrix = np.eye(3) if seed is None else turn_in_space(seed)
        case = pushed(matrix, 0.3, LEGS, "plastic block 2 40 kinematic 30\n")
        run = part(tmp_path / str(seed), mesh.text(matrix), case, "-estimate", 0, space=True)
        contact, entry = run.summary["contacts"][0], run.summary["plastic"]
        shear = matrix.T @ contact["shearForce"]
        found.append([contact["normalForce"], *shear[:2], entry["dissipated"], entry["bodies"][0]["strainMax"]])
        found[-1].append(entry["work"])
        rubbed.append(contact["dissipated"])
        assert run.factorisations == 1 and entry["bodies"][0]["share"] > 0.5
        left = entry["work"] - entry["storedElastic"] - entry["storedByHardening"] - entry["dissipated"]
        assert abs(left) < 0.2 * entry["work"]  # of few steps
    assert found[1] == pytest.approx(found[0], rel=1e-5)
    assert rubbed[1] == pytest.approx(rubbed[0], rel=1e-3)  # where slip begins in a step, the axes matter
    assert 0.99 < np.hypot(*found[0][1:3]) / (0.3 * found[0][0]) < 1 + 1e-6  # it slides


def test_elastic_with_friction(tmp_path):
    """With a yield stress beyond all stresses the forces with friction are those of the elastic body."""
    mesh = cube(Mesh(), size=(2, 2, 1), cells=(3, 3, 2)).text()
    contacts = []
    for name, plastic in (("e", ""), ("p", "plastic block 1e9 0\n")):
        case = pushed(np.eye(3), 0.3, LEGS, plastic)
        run = part(tmp_path / name, mesh, case, "-estimate", 0, "-tol", 1e-9, space=True)
        contacts.append(run.contact)
    assert contacts[1]["pressure"] == pytest.approx(contacts[0]["pressure"], abs=1e-7)
    assert contacts[1]["shearX"] == pytest.approx(contacts[0]["shearX"], abs=1e-7)


QUARTER = """SetFactory("OpenCASCADE"); Cylinder(1) = {{0, 0, -6, 0, 0, 6, 6, Pi / 2}};
Physical Volume("block") = {{1}};
Field[1] = MathEval; Field[1].F = "{h} * Max(1, 1 + 1.2 * (Sqrt(x*x+y*y+z*z) - 1.1))"; Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;
"""
SIDES = {"top": "0 0 0 0 0 1", "bottom": "0 0 -6 0 0 1", "x": "0 0 0 1 0 0", "y": "0 0 0 0 1 0"}


@pytest.mark.parametrize("h, most", cases_of([(0.2, 0.006)], [(0.12, 0.003)]))
def test_ball(tmp_path, h, most):
    """A ball pressed into a quarter of a block, far beyond first yield: the force of the axisymmetric run."""
    problem = plasticity.Indentation(True, 0.01, 20)
    code, ring, _ = plasticity.solve(tmp_path, plasticity.geometry(0.025, 6), problem.case([(4, 1)]), "-estimate", 0)
    radius = 1 / problem.unit
    case = "".join(f"group {name} plane {at}\n" for name, at in SIDES.items())
    case += f"body block E 1 nu 0.3\nplastic block {problem.limit!r} {problem.hardening!r}\nclamp bottom\nsymmetry x\n"
    depth = -problem.depth / problem.unit
    case += f"symmetry y\nleg 4\nobstacle top sphere 0 0 {radius!r} R {radius!r} move 0 0 {depth!r}\n"
    run = part(tmp_path / "space", QUARTER.format(h=h), case, "-estimate", 0, space=True)
    assert code == 0 and run.factorisations == 1
    assert 4 * run.summary["contacts"][0]["normalForce"] == pytest.approx(ring["contacts"][0]["normalForce"], rel=most)
