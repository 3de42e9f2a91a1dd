"""The second engine, PETSc's multigrid, on one process and several: the direct engine's answers, refusals, one speaker.

Skipped where `make mpi` has not built the plugin; the refusals that need none are in every run.
"""

import json

import pytest
from freefem import ROOT, environment, execute, flag_text, run, run_in, script, tree

built = pytest.mark.skipif(
    not (ROOT / "build" / "multigrid-plugin.idp").exists(), reason="the plugin is not built: make mpi"
)
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
SAME = ("force", "pressureMax", "halfWidthMoment", "energy", "reactionZ", "approach")


def on_ranks(ranks, name, *flags, cwd=ROOT):
    """(exit code, output) of a script on so many processes; 1: FreeFem++ without mpirun."""
    start = ["FreeFem++", "-nw"] if ranks == 1 else ["ff-mpirun", "-np", ranks]
    return execute([*start, name, *map(flag_text, flags), "-v", "0"], cwd, environment(**AS_ROOT))


def said(output):
    """The lines that are ours: without ff-mpirun's echo and mpiexec's banner."""
    lines = [line for line in output.split("-----")[0].splitlines() if line.strip()]
    return [line for line in lines if not line.startswith("'") and "oversubscribe" not in line]


CASES = [
    ["sphere-on-block", "-h", 1.2, "-layers", 2],
    ["sphere-on-block", "-h", 1.2, "-layers", 2, "-order", 2, "-kappa", 1e9],
    ["sphere-on-block", "-h", 1.2, "-layers", 2, "-symmetry", "half", "-bodyForce", 0.1, "-traction", -1],
    ["two-spheres", "-h", 0.5, "-layers", 2],
    ["two-spheres", "-h", 0.5, "-layers", 2, "-order", 2, "-force", 0],
    ["sphere-on-plane", "-h", 0.4, "-layers", 2, "-order", 2],
    ["patch-test-3d"],
    ["patch-test-3d", "-order", 2, "-lower", 3, "-upper", 4],
]


@built
@pytest.mark.parametrize("ranks", [1, 2, 3])
@pytest.mark.parametrize("case", CASES, ids=lambda case: " ".join(map(flag_text, case)))
def test_same_answer(case, ranks, tmp_path):
    """Forces, pressures, radius to 1e-6 at -tol 1e-8, linearisations but for one, the residual below the tolerance."""
    scene, *flags = case
    flags = [*flags, "-tol", 1e-8] + ([] if "-order" in flags else ["-order", 1])
    direct = run(scene, *flags)
    code, output = on_ranks(ranks, script(scene), *flags, "-solver", "multigrid", "-vtu", 0, "-out", tmp_path / "out")
    assert code == 0, output[-2000:]
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    for name in SAME:
        assert summary[name] == pytest.approx(direct.summary[name], rel=1e-6, abs=1e-9), name
    assert abs(summary["newton"] - direct.newton) <= 1
    assert summary["residual"] <= 1e-8
    assert summary["ranks"] == ranks
    assert output.count("points in contact") == 1


@built
def test_load_series(tmp_path):
    """Two ranks write one series, whose last row is the direct engine's."""
    flags = ["-order", 1, "-h", 1.2, "-layers", 2, "-history", 1, "-steps", 3, "-vtu", 0]
    rows = []
    for ranks, solver in ((1, "direct"), (2, "multigrid")):
        code, output = on_ranks(ranks, script("sphere-on-block"), *flags, "-solver", solver, "-out", tmp_path / solver)
        assert code == 0, output[-2000:]
        rows.append((tmp_path / solver / "series.csv").read_text().splitlines())
    assert len(rows[0]) == len(rows[1]) == 4
    for one, other in zip(rows[0][1:], rows[1][1:], strict=True):
        one, other = ([float(word) for word in row.split(",")] for row in (one, other))
        assert other[:6] == pytest.approx(one[:6], rel=1e-5)


REFUSED = [
    (1, "sphere-on-block", ["-solver", "multigrid", "-method", "paper"], "-method paper"),
    (1, "sphere-on-block", ["-solver", "multigrid", "-path", "0 1"], "-solver multigrid"),
    (1, "adhesive-sphere-3d", ["-solver", "multigrid"], "law that falls"),
    (2, "sphere-on-block", [], "-solver direct runs on one process"),
    (2, "sphere-on-block", ["-kapa", 1, "-solver", "multigrid"], "did you mean -kappa"),
]


@built
@pytest.mark.parametrize("ranks, scene, flags, words", REFUSED)
def test_refusals(ranks, scene, flags, words, tmp_path):
    """One line, code 10, nothing written, on any number of processes."""
    code, output = on_ranks(ranks, script(scene), *flags, "-out", tmp_path / "out")
    assert code == 10
    assert len(said(output)) == 1, output
    assert words in said(output)[0]
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("scene", ["disc-on-block", "hertz-line"])
def test_plane_is_refused(scene, tmp_path):
    code, output = on_ranks(1, script(scene), "-solver", "multigrid", "-out", tmp_path / "out")
    assert code == 10
    assert "only with -method xnewton, in space" in output


def test_without_plugin(tmp_path):
    """A package in which nothing has been built: the flag is refused, the rest works."""
    package = tree(tmp_path / "package")
    flags = ["-order", 1, "-h", 1.2, "-layers", 2]
    refused = run_in(package, script("sphere-on-block"), *flags, "-solver", "multigrid", expect=10)
    assert len(refused.stdout.splitlines()) == 1
    assert "make mpi" in refused.stdout
    run_in(package, script("sphere-on-block"), *flags, "-vtu", 0, out=tmp_path / "out")
