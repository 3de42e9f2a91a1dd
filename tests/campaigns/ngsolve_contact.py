"""The paper's test, and its sphere in space, solved with NGSolve by plain Newton: the peer of `make bench-peers`.

Run as a scene is: `python ngsolve_contact.py -order 4 -h 0.5 -kappa 1e9 -out DIR`; it writes DIR/summary.json and, in
the plane, DIR/contact.csv. Exit code 0 converged, 20 not converged. Needs the packages of requirements-peers.txt.

It is written as one who knows NGSolve would write it for speed: elasticity is assembled once with static condensation;
a Newton step assembles the contact boundary alone, adds it to the condensed matrix and factorises that in place, the
ordering kept; the first iterate is the solution with P1 on the same mesh, of stiff laws with P1 and then P2, which
takes a quarter off. `-assembly whole -start 0` is the straightforward form of it. Newton's steps are not damped. The
quadrature of the contact has 2 p + 1 points an edge: with p to p + 2 of them, Gauss's or Lobatto's, a stiff law's force
is 3 to 100 times further off. One thread.

Lengths, forces and pressures are those of the package's scenes; pressures are positive in compression.
"""

import argparse
import json
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.polynomial import legendre
from numpy.polynomial.chebyshev import Chebyshev

try:
    import netgen.occ as occ
    import ngsolve as ng
    from netgen.geom2d import SplineGeometry
    from ngsolve.krylovspace import CGSolver
    from ngsolve.meshes import MakeStructured3DMesh
except ImportError as error:
    sys.exit(f"no NGSolve here ({error}); `make bench-peers` gets it, in an environment of its own")

CORNER_RATIO = 0.2  # of one layer's size to the next towards a clamped corner


@dataclass(frozen=True)
class Problem:
    """The block and what is pressed on it: the defaults of the scenes disc-on-block and sphere-on-block.

    Lengths; E a pressure; kappa a pressure/length^m.
    """

    kappa: float = 1e3
    m: int = 3
    space: bool = False
    width: float = 40.0
    depth: float = 20.0
    E: float = 100.0
    nu: float = 0.3
    R: float = 10.0
    gap: float = 0.5
    u0: float = 2.5
    d0: float = -0.25

    @property
    def scene(self) -> str:
        return "sphere-on-block" if self.space else "disc-on-block"

    @property
    def lame(self) -> tuple[float, float]:
        """(lambda, mu), pressures; plane strain in the plane."""
        return self.E * self.nu / ((1 + self.nu) * (1 - 2 * self.nu)), self.E / (2 * (1 + self.nu))

    @property
    def reach(self) -> float:
        """Half the length where contact is looked for: the rigid section at the undeformed surface, with some room."""
        sunk = self.u0 - self.gap - self.d0
        return 1.1 * np.sqrt(sunk * (2 * self.R - sunk))

    def shape(self, *at):
        """Shifted overlap s = d - d0 of the undeformed block at (x,) or (x, y), coefficient functions or arrays."""
        root = ng.sqrt if isinstance(at[0], ng.CoefficientFunction) else np.sqrt
        return self.u0 - self.gap - self.d0 - self.R + root(self.R**2 - sum(part * part for part in at))

    def overlap(self, displacement):
        """s as a coefficient function; displacement: the vertical one on the top."""
        return self.shape(*((ng.x, ng.y) if self.space else (ng.x,))) + displacement

    def pressure(self, s):
        """kappa s_+^m of a coefficient function."""
        return self.kappa * ng.IfPos(s, s**self.m, 0)

    def space_on(self, mesh: ng.Mesh, order: int) -> ng.VectorH1:
        """Displacements of this degree, clamped below, symmetric where the mesh has axes."""
        held = {f"dirichlet{name}": f"clamped|axis {name}" for name in "xy"} if self.space else {}
        if "axis" in mesh.GetBoundaries():
            held = {"dirichletx": "clamped|axis"}
        return ng.VectorH1(mesh, order=order, dirichlet="clamped", **held)

    def contact_on(self, space: ng.VectorH1, _stiffness: ng.BilinearForm, extra: int) -> ng.BilinearForm:
        """The forces of the contact boundary; extra: degree of the quadrature beyond the form's own."""
        u, v = space.TnT()
        normal = 2 if self.space else 1
        where = "contact|open" if "open" in space.mesh.GetBoundaries() else "contact"
        form = ng.BilinearForm(space, symmetric=True)
        form += self.pressure(self.overlap(u[normal])) * v[normal] * ng.ds(where, bonus_intorder=extra)
        return form


# ---------------------------------------------------------------- meshes


def plane_mesh(problem: Problem, h: float, far: float, layers: int, ends: float = 0) -> ng.Mesh:
    """The whole block in triangles, size h where contact is looked for, `far` away; `layers` to the clamped corners.

    ends: half the contact's width, if known: the ends are breakpoints, with layers as the corners have.
    """
    half, reach, depth = 0.5 * problem.width, problem.reach, problem.depth
    points = [(-half, 0), (half, 0), (half, depth), (reach, depth), (-reach, depth), (-half, depth)]
    names = ["clamped", "free", "free", "contact", "free", "free"]
    if ends:
        points[4:4] = [(ends, depth), (-ends, depth)]
        names[3:4] = ["contact"] * 3
    geometry = SplineGeometry()
    singular = [y == 0 or abs(x) == ends for x, y in points]
    numbers = [
        geometry.AppendPoint(*point, **({"hpref": 1} if sharp else {}))
        for point, sharp in zip(points, singular, strict=True)
    ]
    for place, name in enumerate(names):
        size = {"maxh": h} if name == "contact" else {}
        geometry.Append(["line", numbers[place], numbers[(place + 1) % len(numbers)]], bc=name, **size)
    mesh = ng.Mesh(geometry.GenerateMesh(maxh=far, grading=0.3))
    if layers:
        mesh.RefineHP(layers, CORNER_RATIO)
    return mesh


def half_mesh(problem: Problem, edge: float, sizes: tuple[float, float], layers: int, ratio: float) -> ng.Mesh:
    """The right half of the block for a reference: `layers` to the clamped corner, to the free one and to x = edge.

    edge: where contact ends, so that it is a breakpoint of the mesh; sizes: of the elements away and at the contact.
    """
    half, depth, (far, near) = 0.5 * problem.width, problem.depth, sizes
    points = [(0, 0, far, 0), (half, 0, far, 1), (half, depth, far, 1)]
    points += [(0.99 * problem.R, depth, far, 0), (edge, depth, near, 1), (0, depth, near, 0)]
    names = ["clamped", "free", "free", "open", "contact", "axis"]
    geometry = SplineGeometry()
    numbers = []
    for x, y, size, singular in points:
        numbers.append(geometry.AppendPoint(x, y, maxh=size, **({"hpref": 1} if singular else {})))
    for place, name in enumerate(names):
        size = {"maxh": near} if name == "contact" else {}
        geometry.Append(["line", numbers[place], numbers[(place + 1) % len(numbers)]], bc=name, **size)
    mesh = ng.Mesh(geometry.GenerateMesh(maxh=far))
    mesh.RefineHP(layers, ratio)
    return mesh


def quarter_hexes(problem: Problem, h: float, growth: float, layers: int, ratio: float = 0.25) -> ng.Mesh:
    """A quarter of the block in bricks: size h below the contact, growing away, `layers` to the sides and bottom."""
    side, down = 0.5 * problem.width, problem.depth
    across = graded(h, 0.87 * problem.reach, growth, side, layers, ratio)
    below = down - np.array(graded(h, h, growth, down, layers, ratio))[::-1]
    n, nz = len(across) - 1, len(below) - 1
    mesh = MakeStructured3DMesh(
        hexes=True,
        nx=n,
        ny=n,
        nz=nz,
        mapping=lambda x, y, z: (across[round(x * n)], across[round(y * n)], below[round(z * nz)]),
    )
    for place, name in enumerate(["axis x", "axis y", "free", "free", "clamped", "contact"]):
        mesh.ngmesh.SetBCName(place, name)
    return ng.Mesh(mesh.ngmesh)


def graded(h: float, even: float, growth: float, end: float, layers: int, ratio: float) -> list[float]:
    """Abscissae from 0: about h up to `even`, then growing by `growth`, the last split in `layers` towards `end`."""
    found = list(np.linspace(0, even, max(round(even / h), 1) + 1))
    step = h * growth
    while found[-1] + 1.5 * step < end:
        found.append(found[-1] + step)
        step *= growth
    last = end - found[-1]
    return [*found, *(end - last * ratio ** (layer + 1) for layer in range(layers)), end]


def quarter_tetrahedra(problem: Problem, h: float) -> ng.Mesh:
    """A quarter of the block in tetrahedra, size h where contact is looked for."""
    reach, depth = problem.reach, problem.depth
    block = quarter(problem)
    below = occ.Box((0, 0, depth - h), (reach, reach, depth))
    whole = occ.Glue([block - below, below])
    name_faces(whole, problem, lambda x, y: max(x, y) < reach, h)
    return ng.Mesh(occ.OCCGeometry(whole).GenerateMesh(maxh=0.25 * depth, grading=0.4))


def quarter_rings(problem: Problem, h: float, radius: float, clamped: float = 0.0) -> ng.Mesh:
    """The same, contact in a circle of this radius, where the mesh has edges of half the size; clamped: size there."""
    reach, depth, deep = problem.reach, problem.depth, 0.1 * problem.depth
    block = quarter(problem)
    inner, outer = (occ.Cylinder((0, 0, depth - deep), occ.Z, r=each, h=deep) * block for each in (radius, reach))
    whole = occ.Glue([block - outer, outer - inner, inner])
    name_faces(whole, problem, lambda x, y: np.hypot(x, y) < 0.9 * reach, h)
    for edge in whole.edges:
        x, y, z = edge.center
        if abs(z - depth) < 1e-9 and abs(edge.mass - 0.5 * np.pi * radius) < 1e-6:
            edge.maxh = 0.5 * h
        if clamped and abs(z) < 1e-9 and max(x, y) > 0.5 * problem.width - 1e-9:
            edge.maxh = clamped
    return ng.Mesh(occ.OCCGeometry(whole).GenerateMesh(maxh=0.25 * depth, grading=0.4))


def quarter(problem: Problem):
    """A quarter of the block."""
    return occ.Box((0, 0, 0), (0.5 * problem.width, 0.5 * problem.width, problem.depth))


def name_faces(block, problem: Problem, touching, h: float) -> None:
    """Names the faces of a quarter; those of the top where touching(x, y) are of size h."""
    for face in block.faces:
        x, y, z = face.center
        top, side = z > problem.depth - 1e-9, max(x, y) > 0.5 * problem.width - 1e-9
        name = {x < 1e-9: "axis x", y < 1e-9: "axis y", z < 1e-9: "clamped"}.get(True)
        face.name = name or ("contact" if top and touching(x, y) else "free" if top or side else "inner")
        if face.name == "contact":
            face.maxh = h


# ---------------------------------------------------------------- Newton's method


@dataclass
class Solution:
    """Displacement, steps, residual over contact forces, CPU seconds: of assembly, of a factorisation, of the rest."""

    displacement: ng.GridFunction
    force: ng.BaseVector  # of the contact, on each dof
    steps: int
    residual: float
    seconds: dict[str, float]
    elastic: float  # CPU seconds of what a linear elastic solve takes of it
    factorisations: int
    backsolves: int


def elasticity(problem, space: ng.VectorH1):
    """The weak form of linear elasticity on this space."""
    u, v = space.TnT()
    (first, mu), strain = problem.lame, lambda w: 0.5 * (ng.Grad(w) + ng.Grad(w).trans)
    e, test = strain(u), strain(v)
    return (2 * mu * ng.InnerProduct(e, test) + first * ng.Trace(e) * ng.Trace(test)) * ng.dx


def newton(
    problem,
    mesh: ng.Mesh,
    order: int,
    start: ng.CoefficientFunction | None = None,
    *,
    tol: float = 1e-8,
    most: int = 200,
    whole: bool = False,
    reuse: bool = False,
    points: int | None = None,
) -> Solution:
    """Newton's method on the law, undamped, from `start` or no displacement, until the residual is tol of the forces.

    problem: lame, space_on and contact_on, as of Problem; move(u), if it has that: sets the prescribed ones.
    whole: every step assembles the elasticity again. reuse: the first factorisation preconditions conjugate gradients
    in the steps after it. points: degree of the contact's quadrature beyond the form's own (default twice the order).
    """
    begin = time.process_time()
    space = problem.space_on(mesh, order)
    stiffness = ng.BilinearForm(space, symmetric=True, condense=True)
    stiffness += elasticity(problem, space)
    contact = problem.contact_on(space, stiffness, 2 * order if points is None else points)
    found = ng.GridFunction(space)
    if start is not None:
        found.Set(start)
    elif hasattr(problem, "move"):
        problem.move(found)
    skeleton, inner = space.FreeDofs(True), space.FreeDofs() & ~space.FreeDofs(True)
    ng.Projector(inner, False).Project(found.vec)  # condensed: they follow from the others
    onto = ng.Projector(skeleton, True)
    stiffness.Assemble()
    contact.AssembleLinearization(found.vec)
    matrix, places = stiffness.mat, positions(stiffness.mat, contact.mat)
    values = matrix.AsVector().FV().NumPy()
    elastic = values.copy()
    assembled = time.process_time()
    force, residual, step = (found.vec.CreateVector() for _ in range(3))
    inverse, steps, solves, factorised, linear = None, 0, 0, 0, 0.0
    while True:
        contact.Apply(found.vec, force)
        residual.data = matrix * found.vec + force
        onto.Project(residual)
        error = residual.Norm() / max(force.Norm(), 1e-300)
        if error <= tol or steps == most or not np.isfinite(error):
            break
        if whole:
            stiffness.Assemble()  # of which the values are known: what it costs is asked
        if steps or start is not None:
            contact.AssembleLinearization(found.vec)
        values[places] += contact.mat.AsVector().FV().NumPy()
        before = time.process_time()
        if inverse is None:
            inverse = matrix.Inverse(skeleton, "sparsecholesky")
        elif not reuse:
            inverse.Update()
        factorised += steps == 0 or not reuse
        middle = time.process_time()
        if steps == 0 or not reuse:
            step.data = inverse * residual
            solves += 1
        else:
            gradients = CGSolver(matrix, inverse, tol=1e-3 * tol / error if error < 1 else 1e-3, maxiter=200)
            step.data = gradients * residual
            solves += gradients.iterations
        if steps == 0:
            linear = time.process_time() - before
            factorisation = middle - before
        found.vec.data -= step
        values[:] = elastic
        steps += 1
    if inner.NumSet() > 0:
        found.vec.data += stiffness.harmonic_extension * found.vec
    end = time.process_time()
    seconds = {"assembly": assembled - begin, "factorisation": factorisation if steps else 0.0}
    seconds["contact"] = end - begin - sum(seconds.values())
    return Solution(found, force, steps, error, seconds, assembled - begin + linear, factorised, solves)


def ladder(problem, mesh: ng.Mesh, flags: argparse.Namespace, **how) -> tuple[list[Solution], Solution]:
    """The solutions of degree 1 to flags.start, each the start of the next, and the one of flags.order."""
    found = []
    for degree in [*range(1, min(flags.start + 1, flags.order)), flags.order]:
        tol = flags.tol if degree == flags.order else 1e-3
        found.append(newton(problem, mesh, degree, found[-1].displacement if found else None, tol=tol, **how))
    return found[:-1], found[-1]


def positions(matrix: ng.BaseMatrix, part: ng.BaseMatrix) -> np.ndarray:
    """Where the stored entries of a part of a sparse matrix stand among those of the whole."""
    _, columns, first = (np.asarray(found) for found in matrix.CSR())
    row, column, _ = (np.asarray(found) for found in part.COO())
    keys = np.repeat(np.arange(len(first) - 1), np.diff(first.astype(np.int64))) * len(first) + columns
    return np.searchsorted(keys, row.astype(np.int64) * len(first) + column)


# ---------------------------------------------------------------- what is read from a solution


def trace(problem: Problem, displacement: ng.GridFunction, nodes: np.ndarray, where: str) -> tuple:
    """(edges, nodes) abscissae and shifted overlaps at these parameters in [0, 1] of a plane block's boundary edges."""
    x, u = on_edges(displacement.space.mesh, [ng.x, displacement.components[1]], nodes, where)
    return x, problem.shape(x) + u


def on_edges(mesh: ng.Mesh, functions: list, nodes: np.ndarray, where: str) -> list[np.ndarray]:
    """(edges, nodes) each function's values at these parameters in [0, 1] of a plane mesh's boundary edges."""
    rule = ng.IntegrationRule([(float(t), 0, 0) for t in nodes], [0.0] * len(nodes))
    points = mesh.MapToAllElements(rule, mesh.Boundaries(where))
    return [np.array(function(points)).reshape(-1, len(nodes)) for function in functions]


def contact_force(solution: Solution, copies: int) -> float:
    """What holds the elastic forces, by the solve's own quadrature, times the copies that make a whole of the mesh.

    It is as good as the energy. An integral of the pressure by other points is not: of a stiff law the pressure between
    those of the quadrature is wrong by the force's own size.
    """
    space = solution.displacement.space
    up = ng.GridFunction(space)
    up.Set(ng.CoefficientFunction((0,) * (space.mesh.dim - 1) + (1,)))
    return copies * ng.InnerProduct(solution.force, up.vec)


def contact_edge(x: np.ndarray, s: np.ndarray) -> float | None:
    """The greatest abscissa where s changes sign, if any; x, s: (edges, nodes), enough nodes for the element's degree.

    A change may lie within an edge both ends of which are open: between the nodes of a coarse mesh the disc bulges.
    """
    found = []
    for along, values in zip(x, s, strict=True):
        middle, half = 0.5 * (along[0] + along[-1]), 0.5 * (along[-1] - along[0])
        at = (along - middle) / half
        for place in np.flatnonzero(values[:-1] * values[1:] <= 0):
            curve = Chebyshev.fit(at, values, len(along) - 1, domain=[-1, 1])
            found.append(middle + half * bisected(curve, at[place], at[place + 1]))
    return float(max(found)) if found else None


def bisected(curve, low: float, high: float) -> float:
    """The root of a function that changes sign between low and high."""
    sign = curve(low)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if curve(middle) * sign > 0 else (low, middle)
    return 0.5 * (low + high)


def lobatto(count: int) -> np.ndarray:
    """Chebyshev's nodes with both ends, in [0, 1]."""
    return 0.5 - 0.5 * np.cos(np.pi * np.arange(count) / (count - 1))


def plane_results(problem: Problem, solution: Solution, order: int) -> tuple[dict, np.ndarray]:
    """Force, greatest pressure, half-width; (points, 3) abscissa, pressure and weight at Gauss's points."""
    x, s = trace(problem, solution.displacement, lobatto(4 * order + 1), "contact")
    results = {"force": contact_force(solution, 1), "halfWidth": contact_edge(x, s)}
    at, weight = np.polynomial.legendre.leggauss(2 * order + 1)  # of newton's own rule
    gx, gs = trace(problem, solution.displacement, 0.5 + 0.5 * at, "contact")
    p = problem.kappa * np.maximum(gs, 0) ** problem.m
    fitted = legendre.legval(np.linspace(-1, 1, 41), legendre.legfit(at, p.T, order))
    results["pressureMax"] = float(fitted.max())  # between these points a stiff law makes what it likes
    length = np.abs(x[:, -1:] - x[:, :1])
    rows = [gx, p, 0.5 * length * weight]
    return results, np.stack([np.broadcast_to(part, gx.shape).ravel() for part in rows], axis=1)


def space_results(problem: Problem, solution: Solution) -> dict:
    """Force, greatest pressure, contact area and the radius of a circle of that area."""
    displacement = solution.displacement

    def overlap(r: float, angle: float) -> float:
        x, y, inside = r * np.cos(angle), r * np.sin(angle), 1e-10
        at = displacement.space.mesh(x + inside, y + inside, problem.depth - inside)
        return problem.shape(x, y) + displacement(at)[2]

    nodes, weights = np.polynomial.legendre.leggauss(8)
    radii = []
    for angle in 0.25 * np.pi * (nodes + 1):
        low, high = 0.3 * problem.R, 0.69 * problem.R
        for _ in range(50):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if overlap(middle, angle) > 0 else (low, middle)
        radii.append(low)
    area = 0.5 * np.pi * float(np.sum(weights * np.array(radii) ** 2))
    top = float(problem.kappa * overlap(0, 0) ** problem.m)
    results = {"force": contact_force(solution, 4), "pressureMax": top}
    return {**results, "contactArea": area, "contactRadius": float(np.sqrt(area / np.pi))}


# ---------------------------------------------------------------- one run


def summary_of(flags: argparse.Namespace, before: list, solution, clock: tuple, results: dict) -> dict:
    """A run's summary with the keys of the package's own. clock: when it began, had its mesh, had its solution (s)."""
    begin, meshed, solved = clock
    used = solved - meshed
    seconds = {**solution.seconds, "mesh": meshed - begin, "total": solved - begin}
    seconds["contact"] = used - seconds["assembly"] - seconds["factorisation"]
    converged = bool(solution.residual <= flags.tol)
    return {
        "scene": flags.problem,
        "parameters": {name: value for name, value in vars(flags).items() if name not in ("out", "vtu")},
        "converged": converged,
        "message": "" if converged else f"residual {solution.residual:.1e} after {solution.steps} Newton steps",
        "newton": solution.steps,
        "kernelNewton": sum(each.steps for each in before),
        "adaptations": 1,
        "factorisations": sum(each.factorisations for each in [*before, solution]),
        "backsolves": sum(each.backsolves for each in [*before, solution]),
        "ndof": solution.displacement.space.ndof,
        "residual": solution.residual,
        **results,
        "costRatio": used / solution.elastic,
        "seconds": seconds,
    }


def common_flags() -> argparse.ArgumentParser:
    """The flags of every problem, under the package's names."""
    parser = argparse.ArgumentParser(allow_abbrev=False, add_help=False)
    parser.add_argument("-method", choices=["ngsolve"], default="ngsolve")
    parser.add_argument("-law", choices=["power"], default="power")
    parser.add_argument("-order", type=int, default=3, help="degree of the displacement")
    parser.add_argument("-kappa", type=float, default=1e3)
    parser.add_argument("-m", type=int, default=3)
    parser.add_argument("-tol", type=float, default=1e-8, help="of the residual, relative to the contact forces")
    parser.add_argument("-maxNewton", type=int, default=200)
    parser.add_argument("-vtu", type=int, default=0, help="has no effect")
    parser.add_argument("-out", type=Path, required=True, help="folder of the results")
    return parser


def write_run(flags: argparse.Namespace, solve) -> int:
    """Solves on one thread and writes the run's files; its exit code."""
    ng.ngsglobals.msg_level = 0
    ng.SetNumThreads(1)
    summary, points = solve(flags)
    flags.out.mkdir(parents=True, exist_ok=True)
    if points is not None:
        np.savetxt(flags.out / "contact.csv", points, delimiter=",", header="x,pressure,weight", comments="")
    (flags.out / "summary.json").write_text(json.dumps(summary, indent=1))
    return 0 if summary["converged"] else 20


def solve(flags: argparse.Namespace) -> tuple[dict, np.ndarray | None]:
    """The run's summary, with the keys of the package's own, and in the plane its points."""
    problem = Problem(kappa=flags.kappa, m=flags.m, space=flags.problem == "sphere-on-block")
    begin = time.process_time()
    if not problem.space:
        mesh = plane_mesh(problem, flags.h, min(flags.far, 10 * flags.h), flags.corners, flags.ends)
    elif flags.ends:
        mesh = quarter_rings(problem, flags.h, flags.ends, flags.h)
    elif flags.mesh == "hexes":
        mesh = quarter_hexes(problem, flags.h, 1.8, flags.corners)
    else:
        mesh = quarter_tetrahedra(problem, flags.h)
    meshed = time.process_time()
    how = {"whole": flags.assembly == "whole", "reuse": flags.reuse == 1, "most": flags.maxNewton}
    before, solution = ladder(problem, mesh, flags, **how)
    solved = time.process_time()
    points = None
    if problem.space:
        results = space_results(problem, solution)
    else:
        results, points = plane_results(problem, solution, flags.order)
    return summary_of(flags, before, solution, (begin, meshed, solved), results), points


def main(argv: list[str] | None = None) -> int:
    parser = common_flags()
    parser.add_argument("-problem", choices=["disc-on-block", "sphere-on-block"], default="disc-on-block")
    parser.add_argument("-h", type=float, default=0.5, help="element size on the contact surface")
    parser.add_argument("-far", type=float, default=2.5, help="greatest element size, at most 10 h, in the plane")
    parser.add_argument("-corners", type=int, default=5, help="layers of geometric refinement to the clamped edges")
    parser.add_argument("-ends", type=float, default=0, help="half the contact's width, if known: layers to its ends")
    parser.add_argument("-mesh", choices=["hexes", "tetrahedra"], default="hexes", help="in space")
    parser.add_argument("-start", type=int, choices=[0, 1, 2, 3], default=1, help="degrees solved before, from 1 to it")
    parser.add_argument("-assembly", choices=["contact", "whole"], default="contact", help="what every step assembles")
    parser.add_argument("-reuse", type=int, choices=[0, 1], default=0, help="1: one factorisation, then gradients")
    return write_run(parser.parse_args(argv), solve)


if __name__ == "__main__":
    sys.exit(main())
