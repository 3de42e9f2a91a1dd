"""draw the bodies below a contact in space, cut open: the pressure on top, von Mises' stress inside (needs PyVista)

RUN is a run of a scene in space with one horizontal contact surface, cut by the plane y = 0; what is missing of a half
or a quarter is its mirror image. FILE.png is 860 pixels wide.
"""

import argparse
import io
from pathlib import Path
from types import ModuleType

import numpy as np
from PIL import Image

from postprocess import style
from postprocess.commands import small
from postprocess.output import write_files
from postprocess.results import ResultsError, Run, read_run
from postprocess.vtu import MOVE, PRESSURE, STRESS, bodies_file

SIZE = (3000, 1500)  # pixels, before the picture is cropped and made small
CROP = (0, 120, 3000, 1410)
WIDTH = 860


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="RUN", help="a run's result folder")
    parser.add_argument("--out", required=True, metavar="FILE.png", help="where to write; folders are created")
    parser.add_argument("--factor", type=float, default=3, metavar="X", help="of the displacements (default: 3)")
    style.add_units(parser)


def run(arguments: argparse.Namespace) -> None:
    """Reads the run, draws it, writes the picture and prints its path."""
    try:
        import pyvista
    except ImportError:
        raise ResultsError("cut", "needs PyVista: .venv/bin/python -m pip install pyvista") from None
    chosen = read_run(arguments.folder)
    picture = Image.fromarray(draw_cut(pyvista, chosen, arguments.factor, arguments.units[1]))
    written = io.BytesIO()
    small.shrink_frame(picture.crop(CROP), WIDTH).save(written, "PNG", optimize=True)
    for path in write_files({Path(arguments.out): written.getvalue()}):
        print(path)


def draw_cut(pyvista: ModuleType, chosen: Run, factor: float, unit: str) -> np.ndarray:
    """The pixels: six contact radii wide, four deep."""
    path = bodies_file(chosen.path)
    radius = chosen.summary.get("halfWidthMoment")
    if not path.exists() or not radius:
        raise ResultsError(chosen.path, "no run with a contact and -vtu 1")
    body = pyvista.read(path)
    if not np.any(body.celltypes == pyvista.CellType.TETRA):
        raise ResultsError(chosen.path, "no run in space")
    top = body.bounds[5]
    for axis, normal in ((0, (1, 0, 0)), (1, (0, 1, 0))):
        if body.bounds[2 * axis] >= 0:
            mirrored = body.reflect(normal, transform_all_input_vectors=True)
            body = body.merge(mirrored, merge_points=False)
    solid = body.extract_cells(body.celltypes == pyvista.CellType.TETRA)
    skin = body.extract_cells(body.celltypes == pyvista.CellType.TRIANGLE)
    skin = skin.clip("z", origin=(0, 0, top - 0.01 * radius), invert=False)
    bar = {"vertical": True, "width": 0.03, "height": 0.5, "position_y": 0.2, "fmt": "{:.0f}", "color": "black"}
    bar |= {"title_font_size": 44, "label_font_size": 44, "font_family": "arial"}
    scene = pyvista.Plotter(off_screen=True, window_size=SIZE)
    for part, name, title, colours, place in (
        (solid.slice("y", origin=(0, 1e-6 * radius, 0)), STRESS, "von Mises stress", "viridis", 0.89),
        (skin, PRESSURE, "contact pressure", "Oranges", 0.08),
    ):
        box = [radius * side for side in (-3, 3, 0, 3, -3.2, 1)]
        part = part.clip_box((*box[:4], top + box[4], top + box[5]), invert=False)
        on_top = name == PRESSURE
        scene.add_mesh(
            part.warp_by_vector(MOVE, factor=factor),
            scalars=name,
            cmap=colours,
            clim=(0, np.ceil(part[name].max())),
            scalar_bar_args={**bar, "title": f"{title} [{unit}]\n", "position_x": place, "n_labels": 6 - on_top},
            lighting=on_top,
            ambient=0.4,
            diffuse=0.6,
            show_edges=on_top,
            edge_opacity=0.15,
        )
    middle = (0, radius, top - 1.4 * radius)
    scene.camera_position = [(0, -9.6 * radius, top + 4.4 * radius), middle, (0, 0, 1)]
    scene.camera.view_angle = 25
    scene.enable_anti_aliasing("ssaa")
    return scene.screenshot()
