"""References of the paper's test and of the sphere in space: tests/data/references.csv, pressure profiles beside it.

`python tests/campaigns/ngsolve_references.py [NAME ...]` with the packages of requirements-peers.txt; names as in
CASES, all of them by default. Each is solved by elements of high degree on two meshes of its own; `difference` is the
relative difference of the two, so that what it leaves are the digits they share.

In the plane the right half is meshed, and refined geometrically towards the clamped corner, the free one and the end of
contact, which is a breakpoint of the mesh: found by solving, meshing anew with it, and so on. Hard contact is
Signorini's problem with the wall at d0: displacements prescribed over the contact, whose end is where the opening
beside it has no square root. In space a quarter is meshed, in bricks.
"""

import argparse
import csv
import io
import sys
from dataclasses import dataclass
from pathlib import Path

import netgen.occ  # noqa: F401  before ngsolve: it registers the geometries
import ngsolve as ng
import numpy as np
from ngsolve_bodies import Bodies, Cylinders, Pin, reaction
from ngsolve_contact import (
    Problem,
    contact_edge,
    contact_force,
    elasticity,
    half_mesh,
    lobatto,
    newton,
    on_edges,
    quarter_hexes,
    quarter_rings,
    space_results,
    trace,
)
from numpy.polynomial.chebyshev import Chebyshev

DATA = Path(__file__).resolve().parents[1] / "data"
COLUMNS = "scene kappa m quantity value difference code".split()
HARD = float("inf")
STIFF = 1e6  # kappa from which on the sphere's mesh has the rim of contact


@dataclass(frozen=True)
class Refinement:
    """A mesh of the half block and a degree; sizes (length) away from the contact and at it."""

    sizes: tuple[float, float]
    order: int
    layers: int
    ratio: float


ROUGH = Refinement((4, 0.6), 6, 8, 0.15)
FINE = (Refinement((4, 0.4), 12, 12, 0.15), Refinement((3, 0.3), 12, 16, 0.3))
# of the quarter block: h (length), growth, layers, degree
BRICKS = ((1.2, 1.6, 1, 4), (1.0, 1.6, 2, 4))

# with a stiff law: h (length), size at the clamped edge, degree
RINGS = ((1.0, 0.8, 4), (0.7, 0.6, 4))
# of two bodies: h (length), degree
PAIRS = ((0.2, 7), (0.1, 7))

NODES = 17  # of a piece of a profile
PIECES = 13
TOWARDS_EDGE = 0.3  # of a piece's length to the one before it

# name: (problem, first guess of the half-width (length))
CASES = {
    "k1e3-m3": (Problem(1e3, 3), 4.93),
    "k1e9-m3": (Problem(1e9, 3), 4.27),
    "k1e12-m3": (Problem(1e12, 3), 4.245),
    "k1e3-m10": (Problem(1e3, 10), 5.46),
    "k1e3-m20": (Problem(1e3, 20), 5.61),
    "hard": (Problem(HARD, 1), 4.24),
    "sphere": (Problem(1e3, 3, space=True), 5.4),
    "sphere-k1e9": (Problem(1e9, 3, space=True), 4.883),
    "cylinders-k1e3": (Cylinders(1e3, 3), None),
    "cylinders-k1e9": (Cylinders(1e9, 3), None),
    "pin-k1e3": (Pin(1e3, 3), None),
    "pin-k1e9": (Pin(1e9, 3), None),
}


# ---------------------------------------------------------------- the plane


def plane(problem: Problem, edge: float) -> tuple[list[dict], tuple[np.ndarray, np.ndarray]]:
    """Force, greatest pressure and half-width on both fine meshes; profile (pieces, NODES): x and p, of the last."""
    solve = hard if problem.kappa == HARD else compliant
    for _ in range(3):
        results, _ = solve(problem, edge, ROUGH)
        edge = results["halfWidth"]
    found = []
    for refinement in FINE:
        results, profile = solve(problem, edge, refinement)
        edge = results["halfWidth"]
        print(f"  {refinement}: {results}", flush=True)
        found.append(results)
    return found, profile


def compliant(problem: Problem, edge: float, refinement: Refinement):
    """The power law, with a breakpoint of the mesh at x = edge: results, and the profile."""
    mesh = half_mesh(problem, edge, refinement.sizes, refinement.layers, refinement.ratio)
    order, start = refinement.order, None
    for degree, tol in ((2, 1e-6), (order // 2, 1e-6), (order, 3e-12)):
        solution = newton(problem, mesh, degree, start, tol=tol, points=60)
        start = solution.displacement
    x, s = trace(problem, start, lobatto(2 * order + 1), "contact|open")
    half_width = contact_edge(x, s)
    results = {"force": contact_force(solution, 2)}
    results["pressureMax"] = float(problem.kappa * s.ravel()[np.argmin(x)] ** problem.m)
    results["halfWidth"] = half_width
    return results, profile(x, s, half_width, lambda value: problem.kappa * np.maximum(value, 0) ** problem.m)


def hard(problem: Problem, edge: float, refinement: Refinement):
    """Signorini's problem: the secant method on the square root in the opening, over the end of contact."""
    before, at = edge - 1e-3, edge
    last = opening(problem, before, refinement)[0]
    for _ in range(8):
        root, results, curve = opening(problem, at, refinement)
        if abs(at - before) < 1e-10 or root == last:
            break
        before, last, at = at, root, at - root * (at - before) / (root - last)
    return results, curve


def opening(problem: Problem, edge: float, refinement: Refinement):
    """With contact up to x = edge: factor of the opening's square root beside it (length^0.5), results, profile."""
    mesh = half_mesh(problem, edge, refinement.sizes, refinement.layers, refinement.ratio)
    contact = mesh.Boundaries("contact")
    held = {"dirichletx": "clamped|axis", "dirichlety": "clamped|contact"}
    space = ng.VectorH1(mesh, order=refinement.order, dirichlet="clamped", **held)
    stiffness = ng.BilinearForm(space, symmetric=True)
    stiffness += elasticity(problem, space)
    stiffness.Assemble()
    found, resultant = ng.GridFunction(space), ng.GridFunction(space)
    found.components[1].Set(-problem.shape(ng.x), definedon=contact, dual=True)
    resultant.components[1].Set(ng.CoefficientFunction(1), definedon=contact, dual=True)
    inverse = stiffness.mat.Inverse(space.FreeDofs(), "sparsecholesky")
    for _ in range(2):  # the second removes the rounding of the first
        found.vec.data -= inverse @ stiffness.mat * found.vec
    reaction = (stiffness.mat * found.vec).Evaluate()
    x, s = trace(problem, found, lobatto(2 * refinement.order + 1), "open")
    r = x.ravel() - edge
    near = (r > 1e-4) & (r < 0.05)
    root = np.linalg.lstsq(np.vander(r[near], 4)[:, ::-1], s.ravel()[near] / np.sqrt(r[near]), rcond=None)[0][0]
    first, mu = problem.lame
    strain = ng.BoundaryFromVolumeCF(ng.Grad(found))
    stress = (2 * mu + first) * strain[1, 1] + first * strain[0, 0]
    x, p = on_edges(mesh, [ng.x, -stress], lobatto(2 * refinement.order + 1), "contact")
    results = {"force": -2 * ng.InnerProduct(reaction, resultant.vec)}
    results |= {"pressureMax": float(p.ravel()[np.argmin(x)]), "halfWidth": edge}
    return float(root), results, profile(x, p, edge, lambda value: value)


def profile(x: np.ndarray, values: np.ndarray, edge: float, pressure) -> tuple[np.ndarray, np.ndarray]:
    """(PIECES, NODES) abscissae and pressures on pieces that shrink towards the edge; x, values: (edges, nodes)."""
    ends = edge * np.append(1 - TOWARDS_EDGE ** np.arange(PIECES), 1)
    at = ends[:-1, None] + np.diff(ends)[:, None] * lobatto(NODES)
    found = np.empty_like(at)
    for along, value in zip(x, values, strict=True):
        low, high = min(along), max(along)
        inside = (at >= low - 1e-12) & (at <= high + 1e-12)
        if inside.any():
            scaled = (2 * along - low - high) / (high - low)
            curve = Chebyshev.fit(scaled, value, len(along) // 2 + 4, domain=[-1, 1])
            found[inside] = curve((2 * at[inside] - low - high) / (high - low))
    return at, pressure(found)


# ---------------------------------------------------------------- space


def sphere(problem: Problem, _edge: float) -> tuple[list[dict], None]:
    """Force, greatest pressure, contact area and radius on both meshes of the quarter."""
    found = []
    for h, growth, layers, order in BRICKS:
        mesh, start = quarter_hexes(problem, h, growth, layers), None
        for degree, tol in ((1, 1e-3), (3, 1e-6), (order, 1e-9)):
            solution = newton(problem, mesh, degree, start, tol=tol, reuse=True)
            start = solution.displacement
        results = space_results(problem, solution)
        print(f"  h = {h}, P{order}, {start.space.ndof} dofs: {results}", flush=True)
        found.append(results)
    return found, None


def stiff_sphere(problem: Problem, radius: float) -> tuple[list[dict], None]:
    """The same in tetrahedra, the rim of contact a line of edges; its radius need be right to 1e-3 only."""
    found = []
    for h, clamped, order in RINGS:
        mesh, start = quarter_rings(problem, h, radius, clamped), None
        for degree, tol in ((1, 1e-3), (2, 1e-5), (3, 1e-7), (order, 1e-7)):
            solution = newton(problem, mesh, degree, start, tol=tol)
            start = solution.displacement
        results = space_results(problem, solution)
        print(f"  h = {h}, P{order}, {start.space.ndof} dofs: {results}", flush=True)
        found.append({name: results[name] for name in ("force", "contactRadius")})
    return found, None


# ---------------------------------------------------------------- two bodies


def pair(problem: Bodies, _edge) -> tuple[list[dict], None]:
    """The force on both meshes; a pin's elements are twice as large as the cylinders'."""
    found = []
    for h, order in PAIRS:
        mesh, start = problem.mesh((2 if isinstance(problem, Pin) else 1) * h, 2.5, 10, order), None
        for degree, tol in ((1, 1e-3), (3, 1e-6), (order, 1e-10)):
            solution = newton(problem, mesh, degree, start, tol=tol)
            start = solution.displacement
        found.append({"force": reaction(solution, "slave")})
        print(f"  h = {h}, P{order}, {start.space.ndof} dofs: {found[-1]}", flush=True)
    return found, None


# ---------------------------------------------------------------- files


def rows_of(problem: Problem, found: list[dict]) -> list[dict[str, str]]:
    """The lines of a case in references.csv: the values of the second, finer solution."""
    scene = problem.scene
    common = {"scene": scene, "kappa": f"{problem.kappa:g}", "m": str(problem.m), "code": f"NGSolve {ng.__version__}"}
    first, last = found
    return [
        {**common, "quantity": name, "value": f"{value:.13g}", "difference": f"{abs(first[name] / value - 1):.1e}"}
        for name, value in last.items()
    ]


def update(path: Path, rows: list[dict[str, str]]) -> None:
    """Writes rows over those of the same scene, law and quantity, and leaves the others."""
    key = "scene kappa m quantity".split()
    kept = {}
    if path.exists():
        kept = {tuple(row[name] for name in key): row for row in csv.DictReader(io.StringIO(path.read_text()))}
    kept |= {tuple(row[name] for name in key): row for row in rows}
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(kept.values())
    path.write_text(text.getvalue())


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(CASES)} (default: all)")
    parser.add_argument("--out", type=Path, default=DATA, help="folder of the files")
    arguments = parser.parse_args(argv)
    unknown = set(arguments.names) - set(CASES)
    if unknown:
        parser.error(f"no such case: {', '.join(sorted(unknown))}")
    ng.ngsglobals.msg_level = 0
    ng.SetNumThreads(1)
    for name in arguments.names or CASES:
        problem, edge = CASES[name]
        print(name, flush=True)
        in_space = stiff_sphere if problem.kappa >= STIFF else sphere
        solve = pair if isinstance(problem, Bodies) else in_space if problem.space else plane
        found, curve = solve(problem, edge)
        update(arguments.out / "references.csv", rows_of(problem, found))
        if curve:
            points = np.column_stack([part.ravel() for part in curve])
            path = arguments.out / f"profile-{name}.csv"
            np.savetxt(path, points, fmt="%.13g", delimiter=",", header="x,pressure", comments="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
