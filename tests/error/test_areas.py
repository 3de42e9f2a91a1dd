"""Contact areas in space and their errors: Hertz, a law, and random shapes beside finer meshes."""

from math import pi

import numpy as np
import pytest
from freefem import part

BLOCK = """SetFactory("OpenCASCADE");
Box(1) = {-W, -W, -H, 2*W, 2*W, H}; Mesh.MeshSizeMax = 1.5;
"""
PRESSED = """group block volumes 1
group foot plane 0 0 -H 0 0 1
group top plane 0 0 0 0 0 1
body block E 1000 nu NU
clamp foot
obstacle top SHAPE
SIZE
"""


def pressed(folder, shape, size, width=4.0, height=4.0, nu=0.3, flags=("-estimate", 1)):
    """Area and error, and the run, of a block under a rigid shape."""
    geo = BLOCK.replace("W", f"{width:g}").replace("H", f"{height:g}")
    text = PRESSED.replace("SHAPE", shape).replace("SIZE", size).replace("H", f"{height:g}").replace("NU", f"{nu:g}")
    run = part(folder, geo, text, *flags, space=True)
    estimates = run.summary["estimates"]
    known = estimates["contacts"][0]["area"] if estimates else None
    return run.summary["contacts"][0]["area"], known and known["error"], run


@pytest.mark.parametrize("size, most", [(0.5, 0.3), (0.2, 0.15)])
def test_hertz(size, most, tmp_path):
    """A ball on a block: pi a^2, a^3 = 3 F R (1 - nu^2)/(4 E), within ±, which is smaller on a finer mesh."""
    area, error, run = pressed(tmp_path, "sphere 0 0 5 R 5 move 0 0 -0.1", f"size contact {size}", 6.0, 6.0)
    exact = pi * (3 * run.force * 5 * 0.91 / 4000) ** (2 / 3)
    assert abs(area - exact) < error < most * exact
    assert f"{run.summary['contacts'][0]['contactPoints']} of" in run.stdout and "contact area" in run.stdout


def test_all_of_a_surface(tmp_path):
    """A plane on all of a face: the area of the mesh, whose error nothing estimates."""
    area, error, run = pressed(tmp_path, "plane 0 0 0 0 0 -1 move 0 0 -0.1", "size top 2", nu=0)
    assert error is None and area == pytest.approx(64, rel=1e-9) and "error not known" in run.stdout


@pytest.mark.parametrize("seed", range(8))
def test_random_areas(seed, tmp_path):
    """Balls, cylinders and tilted planes of any sizes, some with a law: the area on a finer mesh lies within ±."""
    rng = np.random.default_rng(seed)
    radius, depth, x, y, angle = rng.uniform([2, 0.02, -0.3, -0.3, 0], [8, 0.1, 0.3, 0.3, pi])
    law = f" law power kappa {10 ** rng.uniform(3, 6):.3g} m 2 d0 -0.002" * (seed % 3 == 0)
    shape = (
        f"sphere {x} {y} {radius} R {radius} move 0 0 {-depth}",
        f"cylinder {x} {y} {radius} {np.cos(angle)} {np.sin(angle)} 0 R {radius} move 0 0 {-depth}",
        f"plane 0 0 0.05 {0.02 + depth / 3} {0.03 * np.sin(angle)} -1 move 0 0 {-0.08 - depth / 2}",
    )[seed % 3]
    size = rng.uniform(0.3, 0.7) * np.sqrt(radius * depth) if seed % 3 < 2 else rng.uniform(0.4, 0.8)
    word = "size contact" if seed % 3 < 2 else "size top"
    width, nu = rng.uniform([1.5, 0], [2.5, 0.45])
    coarse, error, _ = pressed(tmp_path / "coarse", shape + law, f"{word} {size}", width, 3.0, nu)
    fine, _, _ = pressed(tmp_path / "fine", shape + law, f"{word} {size / 2.2}", width, 3.0, nu, ("-estimate", 0))
    assert abs(coarse - fine) < error < 0.6 * fine
