"""The bodies and faces of a geometry: their kinds, places, normals or axes, radii, areas, and what lies on both sides.

`look(gmsh, cad, space)` meshes the faces of the geometry that gmsh has open coarsely, of second order;
`faces(outline)` makes the table of it, `table(outline)` the text of -check 1. In the plane bodies are surfaces, and
faces are curves. A kind is told where all nodes lie on it within 1e-6 of the face's size, by least squares; gmsh's own
names for kinds are not used, for a cylinder may be a surface of revolution or a spline there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
ON = 1e-6  # of a face's size: nodes so near to a shape lie on it
GAUSS = ((-np.sqrt(0.6), 5 / 18), (0.0, 8 / 18), (np.sqrt(0.6), 5 / 18))
TRIANGLE, LINE, QUADRANGLE = 9, 8, 10  # gmsh's types of second order


@dataclass
class Outline:
    """What gmsh made: by body its faces, by face the nodes of its pieces (pieces, 6 or 3, 3), by body its name.

    entities: all faces; groups: by dimension and name the bodies or faces of the file's own groups.
    """

    space: bool
    bodies: dict[int, list[int]]
    pieces: dict[int, Array]
    names: dict[int, str] = field(default_factory=dict)
    groups: dict[tuple[int, str], list[int]] = field(default_factory=dict)
    entities: list[int] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.entities = self.entities or list(self.pieces)

    @cached_property
    def sides(self) -> dict[int, list[int]]:
        """By face: the bodies that it bounds."""
        found: dict[int, list[int]] = {face: [] for face in self.pieces}
        for body, faces in self.bodies.items():
            for face in faces:
                found.setdefault(face, []).append(body)
        return found

    @cached_property
    def diagonal(self) -> float:
        nodes = np.concatenate([piece.reshape(-1, 3) for piece in self.pieces.values()] or [np.zeros((1, 3))])
        return float(np.linalg.norm(nodes.max(0) - nodes.min(0)))


@dataclass
class Face:
    """A face: `spot`: the middle of a plane, a centre, or a point of the axis; `way`: the normal out of the first body,
    or the axis; `tilt`: half the angle of a cone; `hollow`: the body is outside of it."""

    number: int
    kind: str
    spot: Array
    way: Array
    area: float
    bodies: list[int]
    radius: float = 0.0
    tilt: float = 0.0
    hollow: bool = False


def distance_field(gmsh: Any, places: Sequence[Sequence[float]], size: str) -> int:
    """The number of a field of sizes; size: by the distance from places, which it names {}."""
    model = gmsh.model
    first = 1 + max((tag for _, tag in model.getEntities(0)), default=0)
    tags = [model.geo.addPoint(*place, 0, first + k) for k, place in enumerate(places)]
    model.geo.synchronize()
    away, growing = model.mesh.field.add("Distance"), model.mesh.field.add("MathEval")
    model.mesh.field.setNumbers(away, "PointsList", tags)
    model.mesh.field.setString(growing, "F", size.format(f"F{away}"))
    return int(growing)


def nodes_of(model: Any) -> Array:
    """The places of the nodes of gmsh's mesh, by their numbers."""
    tags, places, _ = model.mesh.getNodes()
    where = np.zeros((int(max(tags, default=0)) + 1, 3))
    where[tags] = np.reshape(places, (-1, 3))
    return where


def look(
    gmsh: Any, cad: bool, space: bool, closer: Sequence[tuple[Array, float]] = (), listed: bool = False
) -> Outline:
    """Meshes the faces of what gmsh has open as far as curvature asks for, and takes them apart.

    closer: places where the outline must be finer, and the sizes there; listed: for a table alone, of what suffices.
    """
    dimension, model = 3 if space else 2, gmsh.model
    if not any(model.getType(*face).startswith("Discrete") for face in model.getEntities(dimension - 1)):
        model.mesh.clear()
    low, high = np.array(model.getBoundingBox(-1, -1)).reshape(2, 3)
    largest = float(f"{np.linalg.norm(high - low) / 15:g}")
    fields = []
    for places, finest in closer:
        growing = f"{finest:.9g}+0.25*Max(0,{{}}-{2 * finest:.9g})"
        fields.append(distance_field(gmsh, places.tolist(), growing))
    least = model.mesh.field.add("Min")  # in place of the geometry's own
    model.mesh.field.setNumbers(least, "FieldsList", fields)
    model.mesh.field.setAsBackgroundMesh(least)
    settings = {"MeshSizeFromPoints": 0, "MeshSizeExtendFromBoundary": 1, "MinimumCirclePoints": 16, "MeshSizeMin": 0}
    # of gmsh's own curves its curvature ends in an endless loop (4.8)
    settings |= {"MeshSizeFactor": 1, "ElementOrder": 2, "MeshSizeFromCurvature": 24 if cad else 0}
    settings["MeshSizeMax"] = min(largest, gmsh.option.getNumber("Mesh.MeshSizeMax"))
    settings |= {"MeshSizeExtendFromBoundary": 0, "Smoothing": 0, "Algorithm": 5} if listed and cad else {}
    for name, value in settings.items():
        gmsh.option.setNumber(f"Mesh.{name}", value)
    model.mesh.generate(dimension - 1)
    bodies = {
        tag: list(dict.fromkeys(abs(face) for _, face in model.getBoundary([(dimension, tag)], False, False)))
        for _, tag in model.getEntities(dimension)
    }
    made = Outline(space, bodies, {}, entities=[tag for _, tag in model.getEntities(dimension - 1)])
    for of, tag in model.getPhysicalGroups():
        if of >= dimension - 1 and (name := model.getPhysicalName(of, tag)):
            made.groups[of, name] = [int(member) for member in model.getEntitiesForPhysicalGroup(of, tag)]
    made.names = {own[0]: name for (of, name), own in made.groups.items() if of == dimension and len(own) == 1}
    where, kind = nodes_of(model), TRIANGLE if space else LINE
    for face in made.entities:
        nodes = np.reshape(model.mesh.getElementsByType(kind, face)[1], (-1, 6 if space else 3))
        if space:  # a mesh may have quadrangles
            four = np.reshape(model.mesh.getElementsByType(QUADRANGLE, face)[1], (-1, 9))
            nodes = np.concatenate([nodes, four[:, [0, 1, 2, 4, 5, 8]], four[:, [0, 2, 3, 8, 6, 7]]])
        if len(nodes):
            made.pieces[face] = where[nodes]
    return made


# ---------------------------------------------------------------- pieces of second order


def with_middles(ends: Array) -> Array:
    """Corners, and the middle between each and the next; of two corners the one middle."""
    return np.vstack([ends, (ends + np.roll(ends, -1, axis=0))[: 1 if len(ends) == 2 else 3] / 2])


def shapes(at: Array) -> Array:
    """The shape functions of second order at places with these weights of corners."""
    middles = 4 * at * np.roll(at, -1, axis=1)
    return np.hstack([at * (2 * at - 1), middles[:, : 1 if at.shape[1] == 2 else 3]])


# by the number of a piece's nodes: these by weights of corners, its parts by nodes, and as mixtures of its nodes its
# parts' nodes and its middle
NODES = {3: with_middles(np.eye(2)), 6: with_middles(np.eye(3))}
QUARTERS = {3: ((0, 2), (2, 1)), 6: ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))}
PARTS = {n: np.array([shapes(with_middles(at[list(part)])) for part in QUARTERS[n]]) for n, at in NODES.items()}
MIDDLE = {3: shapes(np.full((1, 2), 1 / 2))[0], 6: shapes(np.full((1, 3), 1 / 3))[0]}


def crosses(pieces: Array, weights: tuple[float, float, float]) -> Array:
    """The normals of triangles at a place, as long as twice their area."""
    a, b, c = (4 * w - 1 for w in weights)
    l0, l1, l2 = weights
    p = pieces.transpose(1, 0, 2)
    u = b * p[1] - a * p[0] + 4 * ((l0 - l1) * p[3] + l2 * (p[4] - p[5]))
    v = c * p[2] - a * p[0] + 4 * ((l0 - l2) * p[5] + l1 * (p[4] - p[3]))
    return np.cross(u, v)


def measures(pieces: Array, space: bool) -> tuple[Array, Array]:
    """The areas of pieces, in the plane their lengths, and their middles."""
    if space:
        at = ((0.5, 0.5, 0.0), (0.0, 0.5, 0.5), (0.5, 0.0, 0.5))
        return sum(np.linalg.norm(crosses(pieces, w), axis=1) for w in at) / 6, pieces[:, 3:].mean(axis=1)
    lengths = np.zeros(len(pieces))
    for s, w in GAUSS:
        slope = (s - 0.5) * pieces[:, 0] + (s + 0.5) * pieces[:, 1] - 2 * s * pieces[:, 2]
        lengths += 2 * w * np.linalg.norm(slope, axis=1)
    return lengths, (pieces[:, 0] + pieces[:, 1] + 4 * pieces[:, 2]) / 6


def solid_angle(pieces: Array, centre: Array) -> float:
    """Of all pieces, each as four flat triangles, seen from a point (van Oosterom and Strackee, 1983)."""
    rays = pieces - centre
    total = 0.0
    for part in QUARTERS[6]:
        a, b, c = (rays[:, k] for k in part)
        la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
        det = np.abs(np.einsum("ij,ij->i", a, np.cross(b, c)))
        ab, bc, ca = (np.einsum("ij,ij->i", x, y) for x, y in ((a, b), (b, c), (c, a)))
        total += float(np.sum(2 * np.arctan2(det, la * lb * lc + ab * lc + bc * la + ca * lb)))
    return total


# ---------------------------------------------------------------- kinds of faces


def flat(nodes: Array) -> Array | None:
    """The normal of the plane through the middle in which all nodes lie."""
    normal: Array = np.linalg.svd(nodes, full_matrices=False)[2][2]
    return normal if np.abs(nodes @ normal).max() < ON else None


def sphere(nodes: Array, components: int) -> tuple[Array, float] | None:
    """Centre and radius: the square of the distance from the centre is linear in it."""
    at = nodes[:, :components]
    rows = np.hstack([2 * at, np.ones((len(at), 1))])
    found, _, rank, _ = np.linalg.lstsq(rows, (at**2).sum(1), rcond=1e-12)
    square = found[-1] + found[:-1] @ found[:-1]
    if rank <= components or not 0 < square < 1e6:
        return None
    centre = np.append(found[:-1], np.zeros(3 - components))
    off = np.linalg.norm(nodes - centre, axis=1) - np.sqrt(square)
    return (centre, float(np.sqrt(square))) if np.abs(off).max() < ON else None


def across(axis: Array) -> tuple[Array, Array]:
    """Two directions across an axis."""
    least = np.eye(3)[np.argmin(np.abs(axis))]
    first = np.cross(axis, least)
    first /= np.linalg.norm(first)
    return first, np.cross(axis, first)


def cone(nodes: Array, axis: Array) -> tuple[Array, Array, float, float] | None:
    """A point of the axis, the axis, the radius beside the middle and its slope along the axis.

    Gauss and Newton's method on the distances from the axis; `axis`: one to begin with.
    """
    one, two = across(axis)
    t = nodes @ axis
    rows = np.column_stack([2 * nodes @ one, 2 * nodes @ two, np.ones(len(t)), t, t * t])
    found = np.linalg.lstsq(rows, (rows[:, 0] ** 2 + rows[:, 1] ** 2) / 4, rcond=1e-12)[0]
    square = found[2] + found[0] ** 2 + found[1] ** 2
    if square <= 0:
        return None
    radius = float(np.sqrt(square))
    slope, point = float(found[3] / (2 * radius)), found[0] * one + found[1] * two
    most = np.inf
    for _ in range(30):
        one, two = across(axis)
        from_axis = nodes - point
        t = from_axis @ axis
        w = from_axis - np.outer(t, axis)
        d = np.linalg.norm(w, axis=1) + 1e-300
        off = d - radius - slope * t
        if np.abs(off).max() < 1e-9 or abs(np.abs(off).max() - most) < 1e-12:
            break
        most = float(np.abs(off).max())
        x, y = (w @ one) / d, (w @ two) / d
        turned = t * x + slope * (from_axis @ one), t * y + slope * (from_axis @ two)
        step = np.linalg.lstsq(np.column_stack([x, y, *turned, np.ones(len(t)), t]), off, rcond=1e-10)[0]
        point = point + step[0] * one + step[1] * two
        axis = axis + step[2] * one + step[3] * two
        axis = axis / np.linalg.norm(axis)
        radius, slope = radius + float(step[4]), slope + float(step[5])
    if np.abs(off).max() > ON or not 0 < radius < 1e6:
        return None
    beside = float(point @ axis)
    return point - beside * axis, axis, radius - slope * beside, slope


def start_axis(pieces: Array) -> Array:
    """The normals of a cone make one angle with its axis: the direction in which they differ least."""
    normals = crosses(pieces, (1 / 3, 1 / 3, 1 / 3))
    areas = np.linalg.norm(normals, axis=1) + 1e-300
    units = normals / areas[:, None]
    middle = np.average(units, axis=0, weights=areas)
    moments = np.einsum("i,ij,ik->jk", areas / areas.sum(), units - middle, units - middle)
    return np.linalg.eigh(moments)[1][:, 0]


def face_of(made: Outline, number: int) -> Face:
    """A face with its kind, before its sides are known."""
    pieces = made.pieces[number]
    areas, middles = measures(pieces, made.space)
    area, middle = float(areas.sum()), np.average(middles, axis=0, weights=areas)
    all_nodes = pieces[:: 1 + len(pieces) // 60].reshape(-1, 3) - middle  # a few hundred nodes tell a surface
    size = float(np.linalg.norm(all_nodes.max(0) - all_nodes.min(0))) + 1e-300
    nodes = all_nodes / size
    face = Face(number, "other", middle, np.zeros(3), area, made.sides[number])
    in_plane = flat(nodes) if made.space else line_normal(nodes)
    if in_plane is not None:
        face.kind, face.way = "plane" if made.space else "line", in_plane
    elif ball := sphere(nodes, 3 if made.space else 2):
        face.kind = "sphere" if made.space else "circle"
        face.spot, face.radius = middle + size * ball[0], size * ball[1]
        if made.space:
            face.area = solid_angle(pieces, face.spot) * face.radius**2
    elif made.space and (found := cone(nodes, start_axis(pieces))):
        point, face.way, radius, slope = found
        face.kind = "cylinder" if abs(slope) < 3e-6 else "cone"
        face.tilt = float(np.arctan(abs(slope))) if face.kind == "cone" else 0.0
        face.spot, face.radius = middle + size * point, size * radius
    return face


def line_normal(nodes: Array) -> Array | None:
    """The normal of a straight curve in the plane."""
    along = np.linalg.svd(nodes[:, :2], full_matrices=False)[2][0]
    normal = np.array([-along[1], along[0], 0.0])
    return normal if np.abs(nodes @ normal).max() < ON else None


# ---------------------------------------------------------------- sides


def corners_of(made: Outline, body: int) -> Array:
    """The flat pieces around a body."""
    count = 3 if made.space else 2
    return np.concatenate([made.pieces[face][:, :count] for face in made.bodies[body] if face in made.pieces])


def crossings(origin: Array, ray: Array, flats: Array) -> int:
    """How many flat pieces a ray meets (Möller and Trumbore, 1997)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        a, q = flats[:, 1] - flats[:, 0], origin - flats[:, 0]
        if flats.shape[1] == 2:
            det = ray[0] * a[:, 1] - ray[1] * a[:, 0]
            t = (a[:, 0] * q[:, 1] - a[:, 1] * q[:, 0]) / det
            u = (ray[0] * q[:, 1] - ray[1] * q[:, 0]) / det
            return int(np.sum((t > 1e-12) & (u >= 0) & (u < 1)))
        b = flats[:, 2] - flats[:, 0]
        h = np.cross(ray, b)
        det = np.einsum("ij,ij->i", a, h)
        u = np.einsum("ij,ij->i", q, h) / det
        g = np.cross(q, a)
        v = g @ ray / det
        t = np.einsum("ij,ij->i", b, g) / det
        return int(np.sum((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 1e-12)))


def turn_outward(made: Outline, face: Face) -> None:
    """Turns a normal out of the first body, and tells a bore: by how often a ray meets the body's other pieces."""
    way = face.way
    way[np.abs(way) < 1e-9] = 0
    first = next((c for c in way if abs(c) > 1e-6), 0.0)
    if first < 0:
        way *= -1
    way += 0.0  # no -0
    if not face.bodies or face.kind == "other":
        return
    pieces = made.pieces[face.number]
    reach = np.linalg.norm(pieces - pieces.mean(axis=1)[:, None], axis=2).max(axis=1)
    piece = pieces[int(np.argmax(reach))]
    corners = piece[: 3 if made.space else 2]
    u = corners[1] - corners[0]
    normal = np.cross(u, corners[2] - corners[0]) if made.space else np.array([u[1], -u[0], 0.0])
    normal /= np.linalg.norm(normal)
    around = corners_of(made, face.bodies[0])
    around = around[np.abs(around - corners).max(axis=(1, 2)) > 0]
    aslant = np.array([0.0123, -0.0217, 0.0171 if made.space else 0.0])
    if crossings(corners.mean(axis=0), normal + aslant, around) % 2:
        normal = -normal
    if face.kind in ("plane", "line"):
        face.way = way if normal @ way > 0 else -way + 0.0
    else:
        from_spot = piece.mean(axis=0) - face.spot
        face.hollow = bool(normal @ (from_spot - (from_spot @ way) * way) < 0)


def faces(made: Outline) -> list[Face]:
    """All faces, by their numbers."""
    found = [face_of(made, number) for number in sorted(made.pieces)]
    for face in found:
        turn_outward(made, face)
    return found


# ---------------------------------------------------------------- the table


def triple(values: Array, space: bool, digits: int, zero: float) -> str:
    """Two or three numbers; what is less than `zero` is rounding."""
    return " ".join(f"{0.0 if abs(x) < zero else x:.{digits}g}" for x in values[: 3 if space else 2])


def table(made: Outline, found: list[Face], on: dict[int, list[int]]) -> str:
    """The bodies and the faces, as -check 1 prints them; on: by face those of other bodies that lie on it."""
    space, diagonal = made.space, made.diagonal
    lines = []
    many, body_word = ("faces", "volume") if space else ("curves", "surface")
    for body, own in made.bodies.items():
        nodes = np.concatenate([made.pieces[face].reshape(-1, 3) for face in own if face in made.pieces])
        low, high = (triple(end, space, 6, 1e-6 * diagonal).replace(" ", ", ") for end in (nodes.min(0), nodes.max(0)))
        name = f" ({made.names[body]})" if body in made.names else ""
        lines.append(f"{body_word} {body}{name}: from ({low}) to ({high}), {many} {' '.join(map(str, own))}")
    head = ("face", "kind", "middle, centre or on the axis", "normal outwards or axis", "radius", "area", "of; on")
    if not space:
        head = ("curve", "kind", "middle or centre", "normal outwards", "radius", "length", "of; on")
    lines += ["", "{:>6}  {:<15} {:<30} {:<30} {:>10} {:>10}  {}".format(*head)]
    for face in found:
        kind = face.kind + (" hole" if face.kind == "circle" else " hollow") * face.hollow
        kind += f" {np.degrees(face.tilt):.4g} deg" if face.tilt else ""
        at_middle = face.kind in ("plane", "line", "other")
        spot = triple(face.spot, space, 4 if at_middle else 6, (3e-5 if at_middle else 1e-7) * diagonal)
        way = "-" if face.kind in ("other", "sphere", "circle") else triple(face.way, space, 6, 1e-7)
        radius = f"{face.radius:.6g}" if face.radius else "-"
        sides = " and ".join(map(str, face.bodies)) + (
            "; on " + " ".join(map(str, on[face.number])) if face.number in on else ""
        )
        lines.append(f"{face.number:>6}  {kind:<15} {spot:<30} {way:<30} {radius:>10} {face.area:>10.4g}  {sides}")
    return "\n".join(lines) + "\n"
