"""write a Python state for ParaView that opens a run as its picture shows it

RUN is a result folder of any run made with -vtu 1, the default. RUN/paraview.py is loaded by ParaView's `File > Load
State`, or draws RUN/paraview.png by `pvpython RUN/paraview.py`: the deformed bodies by von Mises' stress, in space cut
open through the middle of the contact that carries most, and the pressures on the contacts' surfaces, with units; the
eye is where the picture's is. `Label` has the names of a case's bodies and groups.
"""

import argparse
from pathlib import Path

import numpy as np

from postprocess import bodies as drawn
from postprocess import bodies_3d, style
from postprocess.bodies import Bodies, read_bodies, units_of
from postprocess.commands.state import strongest_contacts
from postprocess.output import register_files_of_run, write_files
from postprocess.results import read_run
from postprocess.vtu import MOVE, PRESSURE, STRESS, bodies_file, read_names

STATE = '''"""A state of ParaView: `File > Load State`, or `pvpython paraview.py`, which writes paraview.png."""

import os
import sys

from paraview.simple import *

folder = {folder!r}
if os.path.isfile(os.path.join(os.path.dirname(os.path.abspath(sys.argv[0] or ".")), {file!r})):
    folder = os.path.dirname(os.path.abspath(sys.argv[0]))
scale = {scale!r}  # of the displacements
view = GetActiveViewOrCreate("RenderView")
view.OrientationAxesVisibility = 1
view.UseColorPaletteForBackground = 0
view.Background = [1.0, 1.0, 1.0]


def shown(file, name, array, top, title, unit, corner, colours, cut=None):
    """A file's grid under its displacements, coloured by an array at its points, with a scale."""
    reader = XMLPartitionedUnstructuredGridReader if file.endswith(".pvtu") else XMLUnstructuredGridReader
    source = reader(registrationName=name, FileName=[os.path.join(folder, file)])
    moved = WarpByVector(registrationName=name + " deformed", Input=source)
    moved.Vectors = ["POINTS", {move!r}]
    moved.ScaleFactor = scale
    if cut:
        moved = Clip(registrationName=name + " cut open", Input=moved)
        moved.ClipType = "Plane"
        moved.ClipType.Origin, moved.ClipType.Normal = cut
        moved.Invert = 1  # what the normal points to is taken away
    display = Show(moved, view)
    display.Representation = "Surface"
    display.LineWidth = 4.0
    ColorBy(display, ("POINTS", array))
    table = GetColorTransferFunction(array)
    table.ApplyPreset(colours, True)
    table.RescaleTransferFunction(0.0, top)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, unit
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.WindowLocation = corner
    display.SetScalarBarVisibility(view, True)
    return source


{shows}
names = {names!r}  # of the bodies and of groups of their boundary, by Label
if names:
    label = GetColorTransferFunction("Label")
    label.InterpretValuesAsCategories = 1
    label.Annotations = names

view.CameraParallelProjection = 1
view.CameraFocalPoint = {focus!r}
view.CameraPosition = {position!r}
view.CameraViewUp = {up!r}
view.CameraParallelScale = {reach!r}
{flat}Render(view)
if os.path.basename(sys.argv[0]) == "paraview.py":
    SaveScreenshot(os.path.join(folder, "paraview.png"), view, ImageResolution=[1600, 900])
'''


def add_arguments(parser: argparse.ArgumentParser) -> None:
    style.add_picture(parser, "paraview", written="paraview.py")


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, writes the state and prints its path."""
    chosen = read_run(arguments.folder)
    bodies = read_bodies(chosen, arguments.scale)
    text = state(bodies, units_of(chosen, arguments.units), arguments.view)
    if not arguments.out:
        register_files_of_run(chosen.path, ["paraview.py", "paraview.png"])
    for path in write_files({Path(arguments.out or chosen.path / "paraview.py"): text.encode()}):
        print(path)


def state(bodies: Bodies, units: style.Units, view: tuple | None) -> str:
    """The script."""
    named = read_names(bodies_file(bodies.run.path))
    names = named.get("bodies", []) + named.get("groups", [])
    strongest = strongest_contacts(bodies)[0][0]
    loads, normal = bodies_3d.contact_forces(bodies, strongest)
    middle = loads @ bodies.points / loads.sum()
    unit = "" if units.stress == style.Units.stress else f"[{units.stress}]"
    solid: style.Look = {"cut": None}
    if bodies.grid.space:
        # what is nearer to the eye than the middle of the contact is taken away
        eye = bodies_3d.view_matrix(*(view or bodies_3d.view_angles(normal)))
        flat = bodies_3d.surface_axes(normal)
        across = flat[1] * (1 if flat[1] @ eye[2] > 0 else -1)
        solid["cut"] = [numbers(middle), numbers(across)]
        top = drawn.stress_range(bodies)
        reach = 1.5 * np.ptp(bodies.points[bodies.touching(strongest)], axis=0).max()
    else:
        eye, top = np.eye(3), drawn.stress_range(bodies)
        zone = drawn.contact_window(bodies, strongest)
        middle, reach = np.append(zone.mean(axis=0), 0), 0.5 * np.ptp(zone[:, 1])
    shows = [
        call(
            bodies_file(bodies.run.path).name,
            "bodies",
            STRESS,
            top,
            "von Mises",
            unit,
            "Lower Right Corner",
            "Viridis (matplotlib)",
            **solid,
        )
    ]
    pressed = ("contact.vtu", "contacts", PRESSURE, bodies.coloured, "contact pressure", unit, "Lower Left Corner")
    shows.append(call(*pressed, "Inferno (matplotlib)"))
    return STATE.format(
        file=bodies_file(bodies.run.path).name,
        folder=str(bodies.run.path.resolve()),
        scale=float(bodies.scale),
        move=MOVE,
        shows="\n".join(shows),
        names=[word for name in names for word in name.split(" ", 1)],
        focus=numbers(middle),
        position=numbers(middle + 4 * np.ptp(bodies.grid.points) * eye[2]),
        up=numbers(eye[1]),
        reach=float(reach),
        flat="" if bodies.grid.space else 'view.InteractionMode = "2D"\n',
    )


def numbers(values: np.ndarray) -> list[float]:
    return [float(f"{value:.9g}") for value in values]


def call(
    file: str,
    name: str,
    array: str,
    top: float,
    title: str,
    unit: str,
    corner: str,
    colours: str,
    cut: list[list[float]] | None = None,
) -> str:
    """The line of the script that shows one file's grid; cut: a point and the normal of the plane that cuts it open."""
    words: list[object] = [
        file,
        name,
        array,
        float(f"{top:.6g}"),
        title,
        unit,
        corner,
        colours,
        *([cut] if cut else []),
    ]
    return f"shown({', '.join(map(repr, words))})"
