"""Two bodies in contact with NGSolve by its own contact classes: two cylinders, a pin in a hole: `make bench-peers`.

`python ngsolve_bodies.py -problem two-cylinders -order 4 -h 0.2 -kappa 1e9 -out DIR` writes DIR/summary.json. Exit code
0 converged, 20 not converged. `ContactBoundary` finds what lies opposite, once: displacements are small, as in the
package; its forces are a form of their own, beside the elastic one that is assembled once, with static condensation.
For the rest, Newton's method, start and quadrature are those of ngsolve_contact.py.

Lengths, forces and pressures are those of the package's scene two-cylinders, and of pin.geo beside this file.
"""

import argparse
import itertools
import sys
import time
from dataclasses import dataclass, field

import numpy as np
from ngsolve_contact import CORNER_RATIO, Problem, common_flags, ladder, ng, occ, summary_of, write_run

REACH = 2.0  # of the cylinders: contact is looked for up to it (length)


@dataclass(frozen=True)
class Bodies:
    """Two bodies of one material, the upper or inner one pushed down by `push`; the law of the package, and its d0.

    Lengths; E a pressure; kappa a pressure/length^m.
    """

    kappa: float = 1e3
    m: int = 3
    d0: float = -0.05
    E: float = 100.0
    nu: float = 0.3
    kept: list = field(default_factory=list)  # what must live as long as the forms
    lame = Problem.lame
    pressure = Problem.pressure

    def space_on(self, mesh: ng.Mesh, order: int) -> ng.VectorH1:
        """Displacements of this degree, prescribed where the bodies are held and pushed."""
        return ng.VectorH1(mesh, order=order, dirichlet="clamped|pushed")

    def move(self, found: ng.GridFunction) -> None:
        """Sets what is prescribed."""
        places = found.space.mesh.Boundaries("pushed")
        found.components[1].Set(-self.push, definedon=places)

    def contact_on(self, space: ng.VectorH1, stiffness: ng.BilinearForm, extra: int) -> ng.BilinearForm:
        """The forces between the slave and what `ContactBoundary` finds opposite; extra: degree beyond the form's own.

        The stiffness is given the same pairs, so that its matrix has room for them: without load nothing touches.
        """
        (u, v), normal = space.TnT(), self.normal()
        across = sum((u.Other()[k] - u[k]) * normal[k] for k in range(2))
        test = sum((v[k] - v.Other()[k]) * normal[k] for k in range(2))
        load = self.pressure(-self.d0 - self.gap() - across) * self.share() * test
        form, flat = ng.BilinearForm(space, symmetric=True), self.flattened(space)
        order = 2 * space.globalorder + extra
        for each in (form, stiffness):
            pairs = ng.ContactBoundary(*(space.mesh.Boundaries(name) for name in ("slave", "master")))
            pairs.AddIntegrator(load)
            pairs.Update(flat, bf=each, intorder=order, maxdist=self.apart)
            self.kept.append(pairs)
        return form

    def share(self):
        """The length that a pressure acts on over that of the slave."""
        return 1

    def flattened(self, _space: ng.VectorH1) -> ng.GridFunction | None:
        """A displacement under which the nearest place opposite is the one that the package takes."""
        return None


@dataclass(frozen=True)
class Cylinders(Bodies):
    """The scene two-cylinders: half-cylinders of radius R, their flat sides held; gaps along the vertical."""

    R: float = 10.0
    separation: float = 0.1
    push: float = 0.5
    apart = 1.0
    scene = "two-cylinders"

    def mesh(self, h: float, far: float, layers: int, order: int) -> ng.Mesh:
        faces = [
            self.half(0.0, 1, "slave", "clamped", h),
            self.half(2 * self.R + self.separation, -1, "master", "pushed", h),
        ]
        mesh = ng.Mesh(occ.OCCGeometry(occ.Compound(faces), dim=2).GenerateMesh(maxh=far, grading=0.3))
        if layers:
            mesh.RefineHP(layers, CORNER_RATIO)
        mesh.Curve(order)
        return mesh

    def half(self, level: float, way: int, touching: str, held: str, h: float):
        """A half-disc above (way 1) or below its flat side at this level; its elements of size h where it touches."""
        middle, open_by = 0.5 * np.pi * (1 if way > 0 else 3), np.arcsin(REACH / self.R)
        begin = middle - 0.5 * np.pi
        ends = [begin, middle - open_by, middle + open_by, begin + np.pi]
        flat = occ.Segment((-way * self.R, level, 0), (way * self.R, level, 0))
        face = occ.Face(occ.Wire([flat, *(arc(self.R, level, *pair) for pair in itertools.pairwise(ends))]))
        for edge in face.edges:
            x, y, _ = edge.center
            edge.name = held if abs(y - level) < 1e-6 else touching if abs(x) < 0.5 * REACH else "free"
            if edge.name == touching:
                edge.maxh = h
        face.name = "slave" if way > 0 else "master"
        for vertex in face.vertices:
            if abs(vertex.p.y - level) < 1e-9:
                vertex.hpref = 1
        return face

    def normal(self):
        return ng.CoefficientFunction((0, 1))

    def gap(self):
        return self.separation + 2 * (self.R - ng.sqrt(self.R**2 - ng.x**2))

    def share(self):
        return ng.sqrt(1 - (ng.x / self.R) ** 2)  # the vertical pressure is one of a horizontal length

    def flattened(self, space: ng.VectorH1) -> ng.GridFunction:
        flat = ng.GridFunction(space)
        levels = space.mesh.BoundaryCF({"slave": self.R, "master": self.R + 0.5 * self.apart})
        flat.Set(ng.CoefficientFunction((0, levels - ng.y)), definedon=space.mesh.Boundaries("slave|master"))
        return flat


@dataclass(frozen=True)
class Pin(Bodies):
    """A pin of radius R around a rigid core, in a hole of a ring that is held outside; gaps along the radius."""

    R: float = 10.0
    clearance: float = 0.1
    core: float = 4.0
    outside: float = 30.0
    push: float = 0.3
    apart = 1.0
    scene = "pin-in-hole"

    def mesh(self, h: float, far: float, _layers: int, order: int) -> ng.Mesh:
        disc = {r: occ.Circle((0, 0), r).Face() for r in (self.core, self.R, self.R + self.clearance, self.outside)}
        radii = sorted(disc)
        names = dict(zip(radii, ("pushed", "master", "slave", "clamped"), strict=True))
        for r, face in disc.items():
            for edge in face.edges:
                edge.name = names[r]
                edge.maxh = h if names[r] in ("master", "slave") else far
        faces = [disc[radii[1]] - disc[radii[0]], disc[radii[3]] - disc[radii[2]]]
        for face, name in zip(faces, ("master", "slave"), strict=True):
            face.name = name
        mesh = ng.Mesh(occ.OCCGeometry(occ.Compound(faces), dim=2).GenerateMesh(maxh=far, grading=0.3))
        mesh.Curve(order)
        return mesh

    def normal(self):
        return -ng.CoefficientFunction((ng.x, ng.y)) / ng.sqrt(ng.x**2 + ng.y**2)

    def gap(self):
        return self.clearance


PROBLEMS = {problem.scene: problem for problem in (Cylinders, Pin)}


def arc(radius: float, level: float, begin: float, end: float):
    """Of a circle about (0, level), between these angles."""
    at = [(radius * np.cos(angle), level + radius * np.sin(angle), 0) for angle in (begin, 0.5 * (begin + end), end)]
    return occ.ArcOfCircle(*at)


def solve(flags: argparse.Namespace) -> tuple[dict, None]:
    """The run's summary."""
    problem = PROBLEMS[flags.problem](kappa=flags.kappa, m=flags.m)
    begin = time.process_time()
    mesh = problem.mesh(flags.h, flags.far, flags.corners, flags.order)
    meshed = time.process_time()
    before, solution = ladder(problem, mesh, flags, most=flags.maxNewton)
    clock = begin, meshed, time.process_time()
    return summary_of(flags, before, solution, clock, {"force": reaction(solution, "slave")}), None


def reaction(solution, slave: str) -> float:
    """The vertical force between the bodies, by the solve's own quadrature: what holds the slave's elastic forces."""
    space = solution.displacement.space
    up = ng.GridFunction(space)
    up.components[1].Set(1, definedon=space.mesh.Materials(slave))
    return abs(ng.InnerProduct(solution.force, up.vec))


def main(argv: list[str] | None = None) -> int:
    parser = common_flags()
    parser.add_argument("-problem", choices=list(PROBLEMS), default="two-cylinders")
    parser.add_argument("-h", type=float, default=0.2, help="element size on the contact surfaces")
    parser.add_argument("-far", type=float, default=2.5, help="greatest element size")
    parser.add_argument("-corners", type=int, default=4, help="layers of geometric refinement to the held corners")
    parser.add_argument("-start", type=int, choices=[1, 2, 3], default=1, help="degrees solved before, from 1 to it")
    return write_run(parser.parse_args(argv), solve)


if __name__ == "__main__":
    sys.exit(main())
