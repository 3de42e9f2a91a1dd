"""The package's scenes as cases, on their own meshes: the scene's numbers, and the same to rounding in any direction.

Scenes whose gap is a function of x (wavy, rough, flat-punch) and rings about an axis have no other direction.
"""

import numpy as np
import pytest
from freefem import ROOT, run_in, script
from test_parts import UNTURNED, Mesh, solve, turn, turn_in_space, vector

from postprocess import vtu

MIRROR = np.diag([-1.0, 1, 1])


class Scene:
    """A scene's run of first order, whose mesh and parameters its case takes."""

    def __init__(self, folder, name, flags):
        self.run = run_in(ROOT, script(name), *flags, "-order", 1, "-vtu", 1, out=folder / "scene")
        self.grid = vtu.read_grid(self.run.folder / "solution.vtu")
        self.space = self.grid.space
        self.up = 2 if self.space else 1
        self.size = np.ptp(self.grid.points, axis=0).max()

    def side(self, axis, end):
        """The name of the side that lies at the least (0) or greatest (-1) coordinate along an axis."""
        at = self.grid.points[:, axis]
        at = at.min() if end == 0 else at.max()
        for label in np.unique(self.grid.label):
            nodes = np.unique(self.grid.surface[self.grid.label == label])
            if (abs(self.grid.points[nodes, axis] - at) < 1e-9 * self.size).all():
                return f"side{label}"
        raise AssertionError(f"no side at the end {end} of axis {axis}")

    def touching(self, which):
        return f"side{self.run.summary['contacts'][0][which]}"

    def __getattr__(self, name):
        return self.run.summary["parameters"][name]

    def mesh(self, matrix):
        """gmsh's text; a mirrored one's elements are turned back."""
        mesh, grid = Mesh(), self.grid
        order = [1, 0, *range(2, grid.cells.shape[1])] if np.linalg.det(matrix) < 0 else slice(None)
        sides = [(f"side{label}", tuple(corners)) for label, corners in zip(grid.label, grid.surface, strict=True)]
        cells = grid.cells[:, order]
        bodies = [(f"body{body}", tuple(corners)) for body, corners in zip(grid.body, cells, strict=True)]
        mesh.add(grid.points, sides, bodies)
        return mesh.text(matrix)

    def law(self):
        if self.run.summary["parameters"]["law"] == "signorini":
            return ""
        return f" law power kappa {self.kappa!r} m {self.m!r} d0 {self.d0!r}"


def bodies(scene, *young):
    """The bodies, by region, with their Young's moduli; the clamp."""
    nu = scene.run.summary["parameters"].get("nu", 0.3)
    regions = np.unique(scene.grid.body)
    lines = [f"body body{k} E {E!r} nu {nu!r}" for k, E in zip(regions, young, strict=True)]
    return "\n".join([*lines, f"clamp {scene.side(scene.up, 0)}", ""])


def loaded(scene, at, share=1):
    """How an obstacle or the upper side is pushed: by u0, or a force of which `share` is modelled."""
    down = [0] * scene.up
    if scene.run.summary["parameters"].get("force"):
        return f"force {at([*down, -scene.force * share])}"
    return f"move {at([*down, -scene.u0])}"


def obstacle(scene, what, at, share=1):
    return f"obstacle {scene.touching('slave')} {what} {loaded(scene, at, share)}{scene.law()}\n"


def block_and_round(scene, at):
    """A rigid round above a block."""
    place = at([0] * scene.up + [scene.depth + scene.gap + scene.R])
    kind = "sphere" if scene.space else "circle"
    return bodies(scene, scene.E) + obstacle(scene, f"{kind} {place} R {scene.R!r}", at)


def under_plane(scene, at):
    """A ball under a rigid plane; a block between walls under one."""
    share = 0.25 if scene.space else 1
    down = [0] * scene.up
    top = scene.R if scene.space else scene.depth
    plane = f"plane {at([*down, top + scene.gap])} {at([*down, -1])}"
    return bodies(scene, scene.E) + obstacle(scene, plane, at, share)


def two_bodies(scene, at):
    """Two elastic bodies, of which the upper one is pushed down."""
    how, load = loaded(scene, at, 0.25 if scene.space else 1).split(" ", 1)
    given = scene.run.summary["parameters"]
    young = (given["E1"], given["E2"]) if "E1" in given else (given["E"], given["E"] * given["Eratio"])
    contact = f"contact {scene.touching('slave')} {scene.touching('master')}{scene.law()}\n"
    return bodies(scene, *young) + contact + f"{how} {scene.side(scene.up, -1)} {load}\n"


def symmetries(scene, *sides):
    return "".join(f"symmetry {scene.side(*side)}\n" for side in sides)


WALLS = ((0, 0), (0, -1))
MIRRORS = ((0, 0), (1, 0))

# the scene and its flags; its case; its symmetry planes
SCENES = {
    "disc": ("disc-on-block", ("-h", 0.5), block_and_round, ()),
    "stiff disc": ("disc-on-block", ("-h", 0.5, "-kappa", 1e9), block_and_round, ()),
    "hertz-line": ("hertz-line", ("-h", 0.2), block_and_round, ()),
    "two-cylinders": ("two-cylinders", ("-h", 0.2), two_bodies, ()),
    "meshed-disc": ("meshed-disc", ("-h", 0.5), two_bodies, ()),
    "confined-block": ("confined-block", ("-h", 1), under_plane, WALLS),
    "patch-test": ("patch-test", (), two_bodies, WALLS),
    "sphere-on-block": ("sphere-on-block", ("-h", 0.5, "-u0", 1, "-patch", 4), block_and_round, MIRRORS),
    "sphere-on-plane": ("sphere-on-plane", ("-h", 0.3), under_plane, MIRRORS),
    "two-spheres": ("two-spheres", ("-h", 0.3), two_bodies, MIRRORS),
}


def pressures_by_place(run, back):
    """The points, turned back, and their pressures, in the order of their places."""
    names = ("x", "y", "z") if "z" in run.contact.dtype.names else ("x", "y")
    places = np.zeros((len(run.contact), 3))
    for axis, name in enumerate(names):
        places[:, axis] = run.contact[name]
    places = places @ back.T
    order = np.lexsort(np.round(places.T, 6))
    return places[order], run.contact["pressure"][order]


@pytest.mark.long
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("name", SCENES)
def test_turned(tmp_path, name, order):
    """The scene's force within a few per cent (its gaps are vertical); the same counts and pressures after any turn."""
    scene_name, flags, case, sides = SCENES[name]
    scene = Scene(tmp_path, scene_name, flags)
    dimension = 3 if scene.space else 2

    def solved(matrix, tol=1e-6):
        text = case(scene, lambda values: vector(values, matrix, dimension)) + symmetries(scene, *sides)
        given = ("-order", order, "-tol", tol)
        run = solve(tmp_path, scene.mesh(matrix), text, *given, script="parts-3d.edp" if scene.space else "parts.edp")
        return (run, run.summary["newton"], run.summary["backsolves"], *pressures_by_place(run, np.linalg.inv(matrix)))

    def agree(one, other):
        assert other[3] == pytest.approx(one[3], abs=1e-9 * scene.size)
        assert other[4] == pytest.approx(one[4], abs=1e-9 * one[0].pressureMax)

    one = solved(UNTURNED)
    for matrix in [turn_in_space(seed) for seed in (1, 2, 3)] if scene.space else map(turn, (0.1, 1.0, 2.5)):
        other = solved(matrix)
        assert other[1:3] == one[1:3]
        agree(one, other)
    if not scene.space:
        # chains run the other way: another path to the same solution
        one, other = solved(UNTURNED, 1e-10), solved(MIRROR, 1e-10)
        assert abs(other[1] - one[1]) <= 1 and abs(other[2] - one[2]) <= 4
        agree(one, other)
    assert one[0].force * (4 if scene.space else 1) == pytest.approx(scene.run.force, rel=0.05)
