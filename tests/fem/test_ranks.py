"""Each process holds its part of the mesh: the answers, estimates and pictures of one process, and less memory.

Skipped where `make mpi` has not built the plugin.
"""

import json
import re

import numpy as np
import pytest
from freefem import ROOT, environment, execute, flag_text, script

from fem.test_multigrid import AS_ROOT, MPIEXEC, built, on_ranks, said
from postprocess.results import ResultsError
from postprocess.vtu import bodies_file, read_grid, read_surface

pytestmark = pytest.mark.ranks
SAME = ("force", "pressureMax", "halfWidthMoment", "energy", "reactionZ", "approach")
# bodies carry loads of their own
LOADED = ["sphere-on-block", "-h", 2, "-layers", 1, "-symmetry", "half", "-bodyForce", 0.1]
CASES = {
    "loads": [*LOADED, "-order", 2, "-force", 900],  # the force is prescribed
    "loads P1": [*LOADED, "-order", 1, "-traction", -1],
    "block": ["sphere-on-block", "-h", 1.2, "-layers", 2, "-order", 1, "-traction", -1],
    "rings": ["sphere-on-block", "-h", 1.2, "-layers", 2, "-order", 1, "-ends", 2],
    "exact": ["sphere-on-block", "-h", 1.2, "-layers", 2, "-order", 1, "-distance", "exact"],
    "spheres": ["two-spheres", "-h", 0.5, "-layers", 2, "-order", 1],
    "spheres P2": ["two-spheres", "-h", 0.5, "-layers", 2, "-order", 2, "-force", 0],
    "spheres exact": ["two-spheres", "-h", 0.5, "-layers", 2, "-order", 1, "-distance", "exact"],
    "plane": ["sphere-on-plane", "-h", 0.4, "-layers", 2, "-order", 2],
    "friction": ["fretting-3d", "-h", 1.2, "-layers", 2, "-order", 1],
    "halved": ["sphere-on-block", "-h", 2.4, "-layers", 1, "-order", 1, "-refine", 1],
    "halved P2": ["sphere-on-block", "-h", 4, "-layers", 1, "-order", 2, "-refine", 1, "-bodyForce", 0.1],
    "halved twice": ["sphere-on-block", "-h", 4, "-layers", 1, "-order", 1, "-refine", 2, "-patch", 6],
    "series": ["sphere-on-block", "-h", 1.2, "-layers", 2, "-order", 1, "-history", 1, "-steps", 3],
}
RUNS = [(name, ranks) for name in CASES for ranks in (2, 3)]


def solved(ranks, folder, scene, *flags):
    """The summary of a run by multigrid on so many processes, and what it printed."""
    code, output = on_ranks(ranks, script(scene), *flags, "-solver", "multigrid", "-tol", 1e-9, "-out", folder)
    assert code == 0, output[-2000:]
    return json.loads((folder / "summary.json").read_text()), output


def in_order(grid):
    """An order of the points that does not depend on their numbers: by place; bodies that touch have other places."""
    return np.lexsort(np.round(grid.points, 9).T)


@built
@pytest.mark.parametrize("name, ranks", RUNS)
def test_same_answer(name, ranks, tmp_path):
    """Results to 1e-9, others to the accuracy of their solves; the same pictures, in one file or several."""
    scene, *flags = CASES[name]
    one, _ = solved(1, tmp_path / "one", scene, *flags)
    many, output = solved(ranks, tmp_path / "many", scene, *flags)
    assert many["ranks"] == ranks and many["ndof"] == one["ndof"] and "mesh: whole" not in output
    for key in SAME:
        assert many[key] == pytest.approx(one[key], rel=3e-9, abs=1e-12), key
    for key in ("force", "approach", "energy", "pressureMax"):
        told, known = ((each["estimates"] or {}).get(key) for each in (many, one))
        assert (told is None) == (known is None), key
        if known and known.get("error") is not None:
            assert told["error"] == pytest.approx(known["error"], rel=1e-3, abs=1e-9 * abs(one[key])), key
    tables = [np.genfromtxt(tmp_path / each / "contact.csv", delimiter=",", skip_header=1) for each in ("one", "many")]
    pressure = one["pressureMax"]
    assert np.allclose(*tables, rtol=1e-7, atol=1e-7 * pressure, equal_nan=True)
    assert not (tmp_path / "many" / "solution.vtu").exists()
    grids = [read_grid(bodies_file(tmp_path / each)) for each in ("one", "many")]
    first, second = (in_order(grid) for grid in grids)
    assert len(first) == len(second)
    assert np.allclose(grids[0].points[first], grids[1].points[second], rtol=1e-14, atol=1e-14)
    for field in ("move", "stress", "pressure"):
        values = [getattr(grid, field)[order] for grid, order in zip(grids, (first, second), strict=True)]
        assert np.allclose(*values, rtol=1e-6, atol=1e-6 * np.abs(values[0]).max()), field
    for field in ("cells", "surface", "skin"):
        assert len(getattr(grids[0], field)) == len(getattr(grids[1], field)), field
    assert np.array_equal(*(np.bincount(grid.label) for grid in grids))
    surfaces = [read_surface(tmp_path / each / "contact.vtu") for each in ("one", "many")]
    assert np.array_equal(surfaces[0].points, surfaces[1].points)
    assert np.array_equal(surfaces[0].cells, surfaces[1].cells)


@built
def test_halved_edges(tmp_path):
    """Eight tetrahedra for one: volume and labels are kept, and the force is that of a gmsh mesh of half the size."""
    times = 1
    scene = ["sphere-on-block", "-order", 1, "-estimate", 0]
    fine, _ = solved(1, tmp_path / "halved", *scene, "-h", 1.2 * 2**times, "-layers", 2 - times, "-refine", times)
    code, output = on_ranks(
        1,
        script(scene[0]),
        *scene[1:],
        "-solver",
        "direct",
        "-h",
        1.2 * 2**times,
        "-layers",
        2 - times,
        "-refine",
        times,
        "-tol",
        1e-9,
        "-out",
        tmp_path / "direct",
    )
    assert code == 0, output
    direct = json.loads((tmp_path / "direct" / "summary.json").read_text())
    coarse, _ = solved(1, tmp_path / "gmsh", *scene, "-h", 1.2, "-layers", 2)
    assert fine["force"] == pytest.approx(direct["force"], rel=1e-9)
    assert fine["points"] == coarse["points"]
    assert fine["force"] == pytest.approx(coarse["force"], rel=0.03)
    grids = [read_grid(tmp_path / each / "solution.vtu") for each in ("halved", "gmsh")]
    volumes = [np.linalg.det(np.diff(grid.points[grid.cells], axis=1)) / 6 for grid in grids]
    assert volumes[0].min() > 0
    assert volumes[0].sum() == pytest.approx(volumes[1].sum(), rel=1e-12)
    assert len(grids[0].skin) == len(grids[0].surface)
    assert (np.bincount(grids[0].label) > 0).tolist() == (np.bincount(grids[1].label) > 0).tolist()


@built
@pytest.mark.parametrize(
    "scene, flags, words",
    [
        ("two-spheres", [], "not for this mesh"),
        ("patch-test-3d", [], "not for this mesh"),
        ("sphere-on-block", ["-accuracy", 0.1], "not with -accuracy"),
    ],
)
def test_edges_that_are_not_halved(scene, flags, words, tmp_path):
    code, output = on_ranks(1, script(scene), "-order", 1, "-refine", 1, *flags, "-out", tmp_path / "out")
    assert code == 10 and words in said(output)[0] and len(said(output)) == 1, output
    assert not (tmp_path / "out").exists()


@built
def test_pieces_that_do_not_fit(tmp_path):
    """An index whose pieces are elsewhere, missing or cut off is refused."""
    solved(2, tmp_path / "run", "sphere-on-block", "-h", 2, "-layers", 1, "-order", 1, "-estimate", 0)
    index, piece = tmp_path / "run" / "solution.pvtu", tmp_path / "run" / "solution-1.vtu"
    text, whole = index.read_text(), piece.read_bytes()
    read_grid(index)
    for names, content in ((("solution-1", "../solution-1"), whole), (None, whole[: len(whole) // 2]), (None, b"")):
        index.write_text(text.replace(*names) if names else text)
        piece.write_bytes(content)
        with pytest.raises(ResultsError):
            read_grid(index)


@built
def test_whole_mesh_where_parts_do_not_go(tmp_path):
    """What needs the whole mesh says so, and has it on each process."""
    flags = ["-h", 2, "-layers", 1, "-order", 1, "-states", 1, "-estimate", 0]
    _, output = solved(2, tmp_path / "run", "sphere-on-block", *flags)
    assert "mesh: whole on each process, because of -states 1" in output
    assert (tmp_path / "run" / "solution.vtu").exists()


@built
def test_more_processes_than_parts(tmp_path):
    """A mesh with too few vertices is refused: one line, code 10, nothing written."""
    flags = ["-h", 6, "-layers", 1, "-order", 1, "-grading", 80, "-out", tmp_path / "out"]
    code, output = on_ranks(24, script("sphere-on-block"), *flags)
    assert code == 10 and re.match(r"-np 24: the mesh has \d+ vertices; allowed: at most", said(output)[0]), output
    assert len(said(output)) == 1 and not (tmp_path / "out").exists()


@built
def test_less_memory_on_each_process(tmp_path):
    """Under a limit of each process that ends a run on one process, a run on four has the answer, with its error."""
    flags = ["-order", 1, "-h", 0.17, "-kappa", 1e9, "-vtu", 0, "-solver", "multigrid", "-out", tmp_path / "out"]
    limited = ["sh", "-c", 'ulimit -v "$0" && exec "$@"', LIMIT]
    scene = ["-nw", "-v", 0, script("sphere-on-block"), *map(flag_text, flags)]
    one, output = execute([*limited, "FreeFem++", *scene], ROOT, environment(**AS_ROOT))
    assert one in (10, 30) and "memory" in output, output[-2000:]
    four, output = execute([*MPIEXEC, 4, *limited, "FreeFem++-mpi", *scene], ROOT, environment(**AS_ROOT))
    assert four == 0, output[-2000:]
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    error = summary["estimates"]["force"]["error"]
    assert abs(summary["force"] - FINER) < error < 0.05 * summary["force"]


FINER = 1879.26  # the force on a mesh with 964 392 unknowns
LIMIT = 920_000  # kB of addresses, of which the program and its libraries take 480 000
