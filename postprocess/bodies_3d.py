"""Bodies in space for the commands `state` and `stress`: seen from outside, cut open, a contact's surface as a map.

With PyVista, where it is installed, the view from outside is rendered; without it faces are drawn from far to near.
"""

import contextlib
import os
from dataclasses import replace
from types import ModuleType

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import Collection, LineCollection, PolyCollection
from matplotlib.colors import Normalize, to_rgb
from matplotlib.tri import Triangulation

from postprocess import style
from postprocess.bodies import FILLS, LIGHT, ZONES, Bodies, coordinates_text, stress_range, whole_stress_range
from postprocess.results import ResultsError
from postprocess.vtu import Grid, bodies_file, cut_grid

VIEW = (-125.0, 22.0)
EDGE = np.cos(np.radians(30))  # faces that meet at more than that have an edge
THROUGH = 0.16  # how opaque a body is that hides a contact
PRESSED: style.Look = {"cmap": "YlOrRd", "vmin": 0}
PIXELS = 1400


def view_matrix(azimuth: float, elevation: float) -> np.ndarray:
    """The rows of an orthographic view (3, 3): to the right, up, towards the eye; angles in degrees."""
    turn, rise = np.radians([azimuth, elevation])
    eye = np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])
    right = np.array([-np.sin(turn), np.cos(turn), 0])
    return np.array([right, np.cross(eye, right), eye])


def view_angles(normal: np.ndarray) -> tuple[float, float]:
    """Azimuth and elevation of an eye that sees a surface with this normal, from aside."""
    normal = normal / np.linalg.norm(normal)
    if abs(normal[2]) > 0.7:
        return VIEW[0], 35.0 * np.sign(normal[2])
    return float(np.degrees(np.arctan2(normal[1], normal[0]))) + 35, VIEW[1]


def contact_forces(bodies: Bodies, contact: int) -> tuple[np.ndarray, np.ndarray]:
    """The points' forces in one contact (p,), without signs, and their resultant: where the contact looks to."""
    loads = bodies.table["weight"] * np.abs(bodies.table["pressure"]) * bodies.touching(contact)
    normal = loads @ bodies.normals
    if np.linalg.norm(normal) < 1e-3 * loads.sum():  # all around a shaft: no noise decides on the side that is seen
        towards = loads @ bodies.normals**2
        normal = loads.sum() * np.eye(3)[np.argmax(towards > 0.999 * towards.max())]
    return loads, normal


# ---------------------------------------------------------------- from outside


def faces_of(bodies: Bodies) -> tuple[np.ndarray, np.ndarray]:
    """Of each face of the skin the number of its body, and which bodies only hide contacts: no pressure is on them."""
    grid = bodies.grid
    numbers, number = np.unique(grid.body, return_inverse=True)
    of = np.zeros(len(grid.points), int)
    of[grid.cells] = number[:, None]
    pressed = np.zeros(len(numbers), bool)
    pressed[of[np.abs(grid.pressure) > 0]] = True
    return of[grid.skin[:, 0]], ~pressed & pressed.any()


def pressed_faces(grid: Grid) -> np.ndarray:
    """Of each face of the skin whether its group bears pressures: a side that shares a contact's edge does not."""
    sides = np.sort(np.concatenate([grid.surface, grid.skin]), axis=1)
    number = np.unique(sides, axis=0, return_inverse=True)[1].ravel()
    named, skin = number[: len(grid.surface)], number[len(grid.surface) :]
    groups = np.unique(grid.label[(grid.pressure[grid.surface] != 0).all(axis=1)])
    if not len(groups):
        return np.ones(len(skin), bool)
    return np.isin(skin, named[np.isin(grid.label, groups)])


def across_faces(skin: np.ndarray, place: np.ndarray) -> np.ndarray:
    """The faces' unit normals (s, 3), of either sign."""
    across = np.cross(place[skin[:, 1]] - place[skin[:, 0]], place[skin[:, 2]] - place[skin[:, 0]])
    return across / np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None]


def edges_of(grid: Grid, place: np.ndarray) -> np.ndarray:
    """The edges (n, 2) of the skin where faces meet at an angle."""
    skin = grid.skin
    across = across_faces(skin, place)
    sides = np.sort(np.concatenate([skin[:, [0, 1]], skin[:, [1, 2]], skin[:, [2, 0]]]), axis=1)
    face = np.tile(np.arange(len(skin)), 3)
    order = np.lexsort((sides[:, 1], sides[:, 0]))
    sides, face = sides[order], face[order]
    twins = np.flatnonzero((sides[1:] == sides[:-1]).all(axis=1))
    bent = np.abs(np.einsum("ij,ij->i", across[face[twins]], across[face[twins + 1]])) < EDGE
    return sides[twins[bent]]


def draw_bodies(axes: Axes, bodies: Bodies, view: np.ndarray, stress: bool) -> ScalarMappable:
    """The deformed bodies from outside with their edges, and the pressures on them, or coloured by von Mises' stress.

    What only lies on a contact is seen through, unless stresses are drawn. Returns what a colour bar is for.
    """
    grid, place = bodies.grid, bodies.place
    body, hides = faces_of(bodies)
    opaque = ~hides[body] | stress
    fills = np.array([[int(fill[k : k + 2], 16) / 255 for k in (1, 3, 5)] for fill in FILLS])
    colours = fills[body % len(fills)]
    scale = ScalarMappable(Normalize(0, whole_stress_range(bodies)), "viridis")
    if stress:
        colours = style.map_colours(grid.stress[grid.skin].mean(axis=1) / scale.norm.vmax)
    else:
        pressure = np.abs(grid.pressure[grid.skin].mean(axis=1)) / bodies.coloured
        shown = (pressure > 1e-3) & pressed_faces(grid)
        colours[shown] = style.map_colours(pressure[shown], PRESSED["cmap"])
    if not render_with_pyvista(axes, bodies, view, colours, opaque):
        across = across_faces(grid.skin, place)
        bright = 0.62 + 0.38 * np.abs((across @ view.T) @ LIGHT)
        rgba = np.column_stack([np.clip(colours * bright[:, None], 0, 1), np.where(opaque, 1.0, THROUGH)])
        seen, lines = place[grid.skin] @ view.T, place[edges_of(grid, place)] @ view.T
        # the edges, as thin as lines, lie a little nearer to the eye than their faces
        depth = np.concatenate([seen[:, :, 2].mean(axis=1), lines[:, :, 2].mean(axis=1) + 0.02 * np.ptp(place)])
        order = np.argsort(depth)
        outlines = [*seen[:, :, :2], *lines[:, :, :2]]
        grey = np.tile([0.25, 0.25, 0.25, 1], (len(lines), 1))
        width = np.concatenate([np.where(opaque, 0.15, 0), np.full(len(lines), 0.35)])
        faces = PolyCollection(
            [outlines[k] for k in order],
            facecolor=np.concatenate([rgba, grey])[order],
            edgecolor=np.concatenate([rgba, grey])[order],
            linewidth=width[order],
        )
        faces.set_rasterized(True)
        axes.add_collection(faces)
        axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()
    corner = np.array([0.02, 0.02])
    corner = corner - 0.13 * np.minimum(view[:2].min(axis=1), 0)
    for k, name in enumerate("xyz"):
        tip = 0.09 * view[:2, k]
        look: style.Look = {
            "xycoords": "axes fraction",
            "textcoords": "axes fraction",
            "ha": "center",
            "va": "center",
            "fontsize": 8,
        }
        arrow = {"arrowstyle": "<-", "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0}
        axes.annotate(f"${name}$", corner, corner + 1.45 * tip, arrowprops=arrow, **look)
    return scale


def import_pyvista() -> ModuleType | None:
    """PyVista where it is installed and can draw without a screen, else None."""
    with contextlib.suppress(ImportError, AttributeError):
        import pyvista
        from vtkmodules.vtkCommonCore import vtkLogger, vtkVersion

        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # it tells of each screen that it does not find
        # older ones end the process where there is no screen
        if os.environ.get("DISPLAY") or (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) >= (9, 4):
            return pyvista
    return None


def render_with_pyvista(axes: Axes, bodies: Bodies, view: np.ndarray, colours: np.ndarray, opaque: np.ndarray) -> bool:
    """Draws the faces in these colours by PyVista into the axes, in the view's coordinates; False without it."""
    pyvista = import_pyvista()
    if pyvista is None:
        return False
    grid, place = bodies.grid, bodies.place
    seen = place @ view.T
    low, high = seen[np.unique(grid.skin)].min(axis=0), seen[np.unique(grid.skin)].max(axis=0)
    margin = 0.02 * (high - low).max()
    low, high = low - margin, high + margin
    size = np.maximum(np.ceil(PIXELS * (high - low)[:2] / (high - low)[:2].max()), 1).astype(int)
    scene = pyvista.Plotter(off_screen=True, window_size=size.tolist())
    scene.set_background("white")
    with contextlib.suppress(Exception):  # what older ones do not have
        scene.enable_depth_peeling(8)
    for part, opacity in ((opaque, 1.0), (~opaque, THROUGH)):
        if part.any():
            skin = np.column_stack([np.full(part.sum(), 3), grid.skin[part]]).ravel()
            mesh = pyvista.PolyData(place, skin)
            mesh.cell_data["colour"] = np.round(255 * colours[part]).astype(np.uint8)
            scene.add_mesh(mesh, scalars="colour", rgb=True, opacity=opacity, ambient=0.35, diffuse=0.65)
    edges = edges_of(grid, place)
    if len(edges):
        lines = pyvista.PolyData(place, lines=np.column_stack([np.full(len(edges), 2), edges]).ravel())
        scene.add_mesh(lines, color="#404040", line_width=2)
    middle = 0.5 * (low + high) @ view
    scene.camera.parallel_projection = True
    scene.camera.focal_point = middle
    scene.camera.position = middle + 4 * np.ptp(seen) * view[2]
    scene.camera.up = view[1]
    scene.camera.parallel_scale = 0.5 * (high - low)[1]
    scene.camera.clipping_range = (0.1 * np.ptp(seen), 9 * np.ptp(seen))
    scene.enable_anti_aliasing("ssaa")
    picture = scene.screenshot(return_img=True)
    scene.close()
    axes.imshow(picture, extent=(low[0], high[0], low[1], high[1]), interpolation="antialiased")
    return True


# ---------------------------------------------------------------- sections and surfaces


def surface_axes(normal: np.ndarray) -> np.ndarray:
    """Two axes in a surface with this normal, and the normal, as rows.

    Each points along the coordinate that it is nearest to: a map has x to the right or z upwards, on whichever side of
    its body the surface lies.
    """
    normal = normal / np.linalg.norm(normal)
    if np.abs(normal).max() > 0.995:
        normal = np.round(normal)
    first = np.eye(3)[0 if abs(normal[0]) < 0.9 else 1]
    right = first - (first @ normal) * normal
    right /= np.linalg.norm(right)
    view = np.array([right, np.cross(normal, right), normal])
    for row, order in zip(view, (1, -1, -1), strict=True):
        # of two that are equal but for rounding the first one to the right, the last one upwards
        nearest = row[::order][(np.abs(row) > np.abs(row).max() - 1e-6)[::order].argmax()]
        row *= np.sign(nearest)
    return view


def axis_name(view: np.ndarray, k: int) -> str:
    """A coordinate, or the letter of a direction."""
    return f"${'xyz'[view[k].argmax()] if view[k].max() > 1 - 1e-9 else 'stn'[k]}$"


def axis_directions_caption(view: np.ndarray, *shown: int) -> str:
    """Of the letters on a map's axes the directions along which they are distances from the origin."""
    words = []
    for k in shown:
        parts = ",\u00a0".join(f"{round(part, 2) + 0.0:g}" for part in view[k]).replace("-", "\u2212")
        words += [f"; {axis_name(view, k)} along ({parts})"] if axis_name(view, k)[1] in "stn" else []
    return "".join(words)


def map_caption(bodies: Bodies, contact: int) -> str:
    """What its map does not show of a contact: directions of the axes, and the force of the other side."""
    loads, normal = contact_forces(bodies, contact)
    share = loads[~near_side(bodies, contact)].sum() / loads.sum()
    far = f"; {100 * share:.0f} % of its force is on the other side" if share >= 0.005 else ""
    return axis_directions_caption(surface_axes(normal), 0, 1) + far


def near_side(bodies: Bodies, contact: int) -> np.ndarray:
    """Which points (p,) lie on the side of a body from which a contact's map is seen."""
    return bodies.normals @ contact_forces(bodies, contact)[1] > 0


def draw_pressure_map(axes: Axes, bodies: Bodies, contact: int, units: style.Units) -> Collection:
    """The pressure on one contact's surface, seen along the mean of the normals where it presses.

    Only the side that is seen is drawn: the far side of a shaft lies behind it.
    """
    surface, count = bodies.surface, len(bodies.points)
    touched = bodies.touching(contact)
    loads, normal = contact_forces(bodies, contact)
    view = surface_axes(normal)
    cells = surface.cells[surface.contact == contact]
    # further nodes, of which no normals are known, stand between contact points
    ways = np.where((cells < count)[..., None], bodies.normals[np.minimum(cells, count - 1)], 0)
    cells = cells[ways.sum(axis=1) @ normal > 0]
    seen = (surface.points + bodies.scale * surface.move) @ view.T
    centre = loads @ seen[:count] / loads.sum()
    half = 1.25 * np.abs(seen[:count][touched] - centre)[:, :2].max(axis=0).max()
    mesh = Triangulation(seen[:, 0], seen[:, 1], cells)
    scale = PRESSED | {"vmax": bodies.coloured}
    if bodies.table["pressure"][touched].min() < 0:
        scale = {"cmap": "RdBu_r", "vmin": -bodies.coloured, "vmax": bodies.coloured}
    colours = axes.tripcolor(mesh, surface.pressure, shading="gouraud", rasterized=True, **scale)
    axes.set_aspect("equal")
    for limits, middle, low, high in (
        (axes.set_xlim, centre[0], seen[cells, 0].min(), seen[cells, 0].max()),
        (axes.set_ylim, centre[1], seen[cells, 1].min(), seen[cells, 1].max()),
    ):
        limits(max(middle - half, low), min(middle + half, high))
    name_axes(axes, view, 0, 1, units)
    return colours


def name_axes(axes: Axes, view: np.ndarray, across: int, upwards: int, units: style.Units) -> None:
    axes.set_xlabel(f"{axis_name(view, across)} [{units.length}]")
    axes.set_ylabel(f"{axis_name(view, upwards)} [{units.length}]")


def draw_shear_map(axes: Axes, bodies: Bodies, contact: int, beside: Axes) -> float:
    """What sticks and slips on one contact's surface, and arrows: the shear on the slave. Returns the greatest.

    beside: the panel with the contact's pressure, of which this one shows the same part.
    """
    table, touched = bodies.table, bodies.touching(contact)
    view = surface_axes(contact_forces(bodies, contact)[1])
    shear = (np.column_stack([table[f"shear{axis}"] for axis in "XYZ"]) @ view.T)[:, :2]
    greatest = np.linalg.norm(shear[touched], axis=1).max()
    near = near_side(bodies, contact)
    mine, touched = near & (table["contact"] == contact), near & touched
    place, seen = (bodies.points[mine] @ view.T)[:, :2], (bodies.points[touched] @ view.T)[:, :2]
    state, shear = np.where(touched, table["slide"], 0)[mine].astype(int), shear[touched]
    limits = beside.get_xlim(), beside.get_ylim()
    # each place is of the state of the point that is next to it
    right, up = (low + (high - low) * (np.arange(160) + 0.5) / 160 for low, high in limits)
    nearest = [((right[:, None] - place[:, 0]) ** 2 + (y - place[:, 1]) ** 2).argmin(axis=1) for y in up]
    colours = np.array([to_rgb(colour) for colour in ("white", *ZONES.values())])
    box = (*limits[0], *limits[1])
    axes.imshow(colours[state[np.array(nearest)]], extent=box, origin="lower", interpolation="nearest")
    length = 0.85 * np.ptp(limits, axis=1).max() / np.sqrt(min(max(len(seen), 16), 250))
    part = slice(None, None, 1 + len(seen) // 250)
    arrows: style.Look = {"angles": "xy", "scale_units": "xy", "scale": 1, "width": 0.006, "color": style.VERMILION}
    axes.quiver(*seen[part].T, *(shear[part] / max(greatest, 1e-300) * length).T, pivot="mid", **arrows)
    axes.set_xlim(limits[0])
    axes.set_ylim(limits[1])
    axes.set_xlabel(beside.get_xlabel())
    axes.set_ylabel(beside.get_ylabel())
    return greatest


def draw_section(axes: Axes, bodies: Bodies, contact: int, units: style.Units) -> Collection:
    """The section through the middle of what presses in one contact that holds its normal, with the outlines."""
    grid, count = bodies.grid, len(bodies.points)
    loads, normal = contact_forces(bodies, contact)
    flat = surface_axes(normal)
    # rows: along the surface, across the section, along the normal; cut() takes the second coordinate for the level
    frame = np.array([flat[0], -flat[1], flat[2]])
    turned = replace(grid, points=grid.points @ frame.T, move=bodies.scale * grid.move @ frame.T)
    level = loads @ (bodies.surface.points[:count] @ frame[1]) / loads.sum()
    aside = 1e-6 * np.ptp(grid.points, axis=0).max()
    sections = [cut_grid(turned, level + way * aside) for way in (1, -1)]
    pieces, stress, outline = max(sections, key=lambda section: len(section[0]))
    if not len(pieces):
        raise ResultsError(bodies_file(bodies.run.path), "nothing lies in the section through a contact's middle")
    corner = np.arange(4 * len(pieces)).reshape(-1, 4)
    triangles = np.concatenate([corner[:, [0, 1, 2]], corner[:, [0, 2, 3]]])
    place = pieces.reshape(-1, 2)[triangles]
    longest = np.square(np.roll(place, 1, axis=1) - place).sum(axis=2).max(axis=1)
    # without needles, which shading would colour far beyond their ends
    full = abs(np.linalg.det(place[:, 1:] - place[:, :1])) > 0.01 * longest
    mesh = Triangulation(pieces[..., 0].ravel(), pieces[..., 1].ravel(), triangles[full])
    look: style.Look = {
        "cmap": "viridis",
        "shading": "gouraud",
        "vmin": 0,
        "vmax": stress_range(bodies),
        "rasterized": True,
    }
    colours = axes.tripcolor(mesh, stress.ravel(), **look)
    axes.add_collection(LineCollection(list(outline), color=style.BLACK, linewidth=0.5))
    touched = bodies.points[bodies.touching(contact)] @ frame.T
    middle, half = loads @ bodies.points @ frame.T / loads.sum(), 1.5 * np.ptp(touched, axis=0).max()
    for limits, at, reach, values in (
        (axes.set_xlim, middle[0], half, pieces[..., 0]),
        (axes.set_ylim, middle[2], 0.75 * half, pieces[..., 1]),
    ):
        limits(max(at - reach, values.min()), min(at + reach, values.max()))
    axes.set_aspect("equal")
    name_axes(axes, flat, 0, 2, units)
    return colours


def section_caption(bodies: Bodies, contact: int, units: style.Units) -> str:
    """Where the section through a contact's middle lies, where that is a coordinate; directions of its axes."""
    loads, normal = contact_forces(bodies, contact)
    view = surface_axes(normal)
    middle = loads @ bodies.surface.points[: len(loads)] / loads.sum()
    k = int(view[1].argmax())
    if view[1][k] < 1 - 1e-9:
        return axis_directions_caption(view, 0, 2)
    unit = "" if units.length == style.Units.length else f"\u00a0{units.length}"
    return f" at ${'xyz'[k]}$ = {coordinates_text(bodies, middle[k : k + 1])[1:-1]}{unit}" + axis_directions_caption(
        view, 0, 2
    )
