"""The paper's test with NGSolve on the unknowns of the contact alone: the fastest peer of `make bench-peers`.

Elasticity is assembled once with static condensation and factorised once. A back-substitution for each vertical unknown
of the contact boundary gives their compliance, a small dense matrix; its inverse is their stiffness. Newton's method,
undamped and from no displacement, then runs on these unknowns with numpy. Last the other unknowns follow. The flags are
those of ngsolve_contact.py; `-half 1` meshes one half of the block. The quadrature of the contact has 2 p + 1 points an
edge. One thread. The problem is solved once before it is timed, so that nothing is charged for a first call.

Run as a scene is: `python ngsolve_condensed.py -order 5 -h 2 -corners 4 -half 1 -out DIR`; it writes DIR/summary.json.
"""

import argparse
import sys
import time
from types import SimpleNamespace

import numpy as np
from ngsolve_contact import (
    CORNER_RATIO,
    Problem,
    SplineGeometry,
    common_flags,
    elasticity,
    ng,
    plane_results,
    summary_of,
    write_run,
)


def block(problem: Problem, flags: argparse.Namespace) -> ng.Mesh:
    """The block or its right half in triangles, size h where contact is looked for, with layers to singular points."""
    side, down, reach, ends = 0.5 * problem.width, problem.depth, problem.reach, flags.ends
    right = [(side, 0, 1, "free"), (side, down, 0, "free"), (reach, down, 0, "contact")]
    right += [(ends, down, 1, "contact")] if ends else []
    if flags.half:
        corners = [(0, 0, 0, "clamped"), *right, (0, down, 0, "axis")]
    else:
        left = [(-ends, down, 1, "contact")] if ends else []
        left += [(-reach, down, 0, "free"), (-side, down, 0, "free")]
        corners = [(-side, 0, 1, "clamped"), *right, *left]
    geometry = SplineGeometry()
    numbers = [geometry.AppendPoint(x, y, **({"hpref": 1} if sharp else {})) for x, y, sharp, _ in corners]
    for place, (*_, name) in enumerate(corners):  # from each corner to the next
        size = {"maxh": flags.h} if name == "contact" else {}
        geometry.Append(["line", numbers[place], numbers[(place + 1) % len(numbers)]], bc=name, **size)
    mesh = ng.Mesh(geometry.GenerateMesh(maxh=flags.far, grading=0.3))
    if flags.corners:
        mesh.RefineHP(flags.corners, CORNER_RATIO)
    return mesh


def traces(space: ng.VectorH1, order: int) -> tuple[np.ndarray, ...]:
    """The contact's vertical unknowns, and at Gauss's points their functions (points, unknowns), weights, abscissae."""
    mesh = space.mesh
    where = mesh.Boundaries("contact")
    at = ng.comp.IntegrationRuleSpaceSurface(mesh, order=4 * order + 1, definedon=where)
    measure = ng.ds("contact", intrules=at.GetIntegrationRules())
    test = at.TestFunction()
    functions = ng.BilinearForm(trialspace=space, testspace=at)
    functions += space.TrialFunction()[1] * test * measure
    functions.Assemble()
    weight, moment = ng.LinearForm(at), ng.LinearForm(at)
    weight += test * measure
    moment += ng.x * test * measure
    weight.Assemble()
    moment.Assemble()
    w, wx = (form.vec.FV().NumPy() for form in (weight, moment))
    row, column, entry = (np.asarray(part) for part in functions.mat.COO())
    free = np.fromiter(space.FreeDofs(True), bool, space.ndof)
    kept = free[column] & (abs(entry) > 1e-14 * abs(entry).max())
    unknowns, place = np.unique(column[kept], return_inverse=True)
    points = np.flatnonzero(w)
    matrix = np.zeros((len(points), len(unknowns)))
    matrix[np.searchsorted(points, row[kept]), place] = entry[kept]
    return unknowns, matrix / w[points, None], w[points].copy(), wx[points] / w[points]


def solve_once(problem: Problem, mesh: ng.Mesh, flags: argparse.Namespace) -> SimpleNamespace:
    """The solution, as ngsolve_contact.Solution is, and the CPU seconds that it took."""
    clock = [time.process_time()]
    held = {"dirichletx": "clamped|axis", "dirichlety": "clamped"}
    space = ng.VectorH1(mesh, order=flags.order, **held)
    stiffness = ng.BilinearForm(space, symmetric=True, condense=True)
    stiffness += elasticity(problem, space)
    stiffness.Assemble()
    clock.append(time.process_time())
    inverse = stiffness.mat.Inverse(space.FreeDofs(True), "sparsecholesky")
    clock.append(time.process_time())
    unknowns, at, weight, x = traces(space, flags.order)
    load, answer = stiffness.mat.CreateColVector(), stiffness.mat.CreateColVector()
    loads, answers = load.FV().NumPy(), answer.FV().NumPy()
    compliance = np.empty((len(unknowns),) * 2)
    loads[:] = 0
    for place, unknown in enumerate(unknowns):
        loads[unknown] = 1
        answer.data = inverse * load
        loads[unknown] = 0
        compliance[place] = answers[unknowns]
    own = np.linalg.inv(0.5 * (compliance + compliance.T))
    rest, moved, steps = problem.shape(x), np.zeros(len(unknowns)), 0
    while True:
        overlap = np.maximum(rest + at @ moved, 0)
        force = at.T @ (weight * problem.kappa * overlap**problem.m)
        off = own @ moved + force
        error = np.linalg.norm(off) / np.linalg.norm(force)
        if error <= flags.tol or steps == flags.maxNewton or not np.isfinite(error):
            break
        slope = weight * problem.kappa * problem.m * overlap ** (problem.m - 1)
        moved -= np.linalg.solve(own + at.T @ (slope[:, None] * at), off)
        steps += 1
    found, forces = ng.GridFunction(space), stiffness.mat.CreateColVector()
    loads[unknowns] = -force
    found.vec.data = inverse * load
    if flags.order > 1:
        found.vec.data += stiffness.harmonic_extension * found.vec
    clock.append(time.process_time())
    forces.FV().NumPy()[:] = 0
    forces.FV().NumPy()[unknowns] = (2 if flags.half else 1) * force
    first, second, third = np.diff(clock)
    return SimpleNamespace(
        displacement=found,
        force=forces,
        steps=steps,
        residual=float(error),
        seconds={"assembly": first, "factorisation": second, "contact": third},
        elastic=first + second,
        factorisations=1,
        backsolves=len(unknowns) + 1,
    )


def solve(flags: argparse.Namespace) -> tuple[dict, np.ndarray]:
    """The run's summary, with the keys of the package's own, and its points."""
    problem = Problem(kappa=flags.kappa, m=flags.m)
    begin = time.process_time()
    mesh = block(problem, flags)
    meshed = time.process_time()
    for _ in range(2 - flags.cold):
        solution = solve_once(problem, mesh, flags)
    results, points = plane_results(problem, solution, flags.order)
    clock = begin, meshed, meshed + sum(solution.seconds.values())
    return summary_of(flags, [], solution, clock, results), points


def main(argv: list[str] | None = None) -> int:
    parser = common_flags()
    parser.add_argument("-problem", choices=["disc-on-block"], default="disc-on-block")
    parser.add_argument("-h", type=float, default=2, help="element size on the contact surface")
    parser.add_argument("-far", type=float, default=4, help="greatest element size")
    parser.add_argument("-corners", type=int, default=4, help="layers of geometric refinement to the clamped corners")
    parser.add_argument("-ends", type=float, default=0, help="half the contact's width, if known: layers to its ends")
    parser.add_argument("-half", type=int, choices=[0, 1], default=0, help="1: the right half of the block")
    parser.add_argument("-cold", type=int, choices=[0, 1], default=0, help="1: not solved once before it is timed")
    return write_run(parser.parse_args(argv), solve)


if __name__ == "__main__":
    sys.exit(main())
