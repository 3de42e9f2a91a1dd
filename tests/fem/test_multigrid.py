"""The second engine, PETSc's multigrid, on one process and several: the direct engine's answers, refusals, one speaker.

Skipped where `make mpi` has not built the plugin; the refusals that need none are in every run.
"""

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from freefem import (
    MULTIGRID,
    ROOT,
    Run,
    environment,
    execute,
    flag_text,
    patience,
    run,
    run_in,
    script,
    snippet,
    told,
    tree,
)
from input.test_parts import Mesh, cube, turn_in_space, vector

pytestmark = pytest.mark.ranks
built = pytest.mark.skipif(not MULTIGRID.exists(), reason="the plugin is not built: make mpi")
AS_ROOT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",  # other tests run beside
}
MPIEXEC = ["mpiexec", "-n"]
ENGINES = ["direct", "multigrid"]
SAME = ("force", "pressureMax", "halfWidthMoment", "energy", "reactionZ", "approach")


def on_ranks(ranks, name, *flags, cwd=ROOT):
    """(exit code, output) of a script on so many processes; 1: FreeFem++ without mpirun."""
    start = ["FreeFem++", "-nw", "-v", 0] if ranks == 1 else [*MPIEXEC, ranks, "sh", "edp/freefem.sh"]
    return execute([*start, name, *map(flag_text, flags)], cwd, environment(**AS_ROOT))


def said(output):
    """The lines that are ours: without mpiexec's banner."""
    return [line for line in output.split("-----")[0].splitlines() if line.strip()]


def process_of_rank(rank, word):
    """The FreeFEM process of this rank whose command line has the word, or None."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command = (folder / "cmdline").read_bytes().decode()
            mine = f"OMPI_COMM_WORLD_RANK={rank}".encode() in (folder / "environ").read_bytes().split(b"\0")
            name = (folder / "comm").read_text()
        except OSError:
            continue
        if mine and word in command and name.startswith("FreeFem"):
            return int(folder.name)
    return None


def has_loaded(process, library):
    """Whether the process, if it still lives, has a library of this name in its memory."""
    try:
        return library in Path(f"/proc/{process}/maps").read_text()
    except OSError:
        return False


CASES = [
    ["sphere-on-block", "-h", 1.2, "-layers", 2],
    ["sphere-on-block", "-h", 2, "-layers", 1, "-order", 2, "-kappa", 1e9, "-estimate", 1],
    ["sphere-on-block", "-h", 1.2, "-layers", 2, "-symmetry", "half", "-bodyForce", 0.1, "-traction", -1],
    ["sphere-on-block", "-h", 1.2, "-layers", 2, "-distance", "exact"],
    ["two-spheres", "-h", 0.5, "-layers", 2, "-estimate", 1, "-force", 0],
    ["two-spheres", "-h", 0.5, "-layers", 2, "-order", 2],
    ["two-spheres", "-h", 0.5, "-layers", 2, "-distance", "exact"],
    ["sphere-on-plane", "-h", 0.4, "-layers", 2, "-order", 2],
    ["patch-test-3d"],
    ["patch-test-3d", "-order", 2, "-lower", 3, "-upper", 4],
]
RUNS = [(case, ranks) for case in CASES for ranks in (1, 2, 3)]


@built
@pytest.mark.parametrize("case, ranks", RUNS)
def test_same_answer(case, ranks, tmp_path):
    """Forces, pressures, radius to 1e-6 at -tol 1e-8, linearisations but for one, the residual below the tolerance; the
    estimate of the error to 1 %."""
    scene, *flags = case
    flags = [*flags, "-tol", 1e-8] + ([] if "-order" in flags else ["-order", 1])
    flags += [] if "-estimate" in flags else ["-estimate", 0]
    direct = run(scene, *flags)
    code, output = on_ranks(ranks, script(scene), *flags, "-solver", "multigrid", "-vtu", 0, "-out", tmp_path / "out")
    assert code == 0, output[-2000:]
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    for name in SAME:
        assert summary[name] == pytest.approx(direct.summary[name], rel=1e-6, abs=1e-9), name
    assert abs(summary["newton"] - direct.newton) <= 1
    assert summary["residual"] <= 1e-8
    if direct.summary["estimates"]:
        error = direct.summary["estimates"]["force"]["error"]
        assert summary["estimates"]["force"]["error"] == pytest.approx(error, rel=0.01)
    assert summary["ranks"] == ranks
    assert output.count("points in contact") == 1


PEAK = """import resource, subprocess, sys
code = subprocess.call(sys.argv[1:])
sys.stdout.write("peak %d\\n" % resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
sys.exit(code)
"""


@built
def test_products_are_freed(tmp_path):
    """Two ranks: what PETSc's products of matrices keep is freed; the peak falls, no digit changes, PETSc is silent."""
    peaks, found = [], []
    for keep in ("-mat_product_clear 0 -mat_freeintermediatedatastructures 0", ""):
        start = [*MPIEXEC, 2, sys.executable, "-c", PEAK, "FreeFem++-mpi", "-nw", "-v", 0, script("sphere-on-block")]
        flags = ["-order", 1, "-h", 0.25, "-solver", "multigrid", "-estimate", 0, "-vtu", 0, "-out", tmp_path / "out"]
        code, output = execute([*start, *flags], env=environment(**AS_ROOT, PETSC_OPTIONS=keep))
        assert code == 0 and "WARNING" not in output and "unused" not in output, output[-2000:]
        peaks.append(max(int(line.split()[1]) for line in output.splitlines() if line.startswith("peak")))
        found.append((tmp_path / "out" / "contact.csv").read_text())
    assert peaks[1] < 0.95 * peaks[0], peaks  # 152 for 167 MB; the program takes 50
    assert found[0] == found[1]


RESTED = """include "scenes/sphere-on-block.edp"
func real held()
{
    ifstream f("/proc/self/status");
    string word = "";
    while (word != "VmRSS:") f >> word;
    real kilobytes;
    f >> kilobytes;
    return kilobytes;
}
real[int] f(ndof), u(ndof), v(ndof);
computeContactLoad(q, f);
int before = factorisations;
elasticSolve(f, u);
real full = held();
releaseSolver();
real[int] freed = [full - held()];
elasticSolve(f, v);
v -= u;
real[int] off = [v.linfty / u.linfty], made = [factorisations - before];
tell("freed", freed);
tell("off", off);
tell("made", made);
"""


@built
def test_levels_are_freed_and_made_again(tmp_path):
    """A run that has ended has no levels; a solve makes them, releaseSolver() frees them, the next makes the same."""
    (tmp_path / "build").symlink_to(MULTIGRID.parent)
    flags = ["-order", 1, "-h", 0.5, "-solver", "multigrid", "-estimate", 0, "-vtu", 0]
    found = told(snippet(tmp_path, RESTED, *flags))
    assert found["freed"][0] > 3000 and found["off"][0] < 1e-12 and found["made"][0] == 2, found  # 5400 kB


LEAN = [
    # bytes of the machine, PETSc's options, code, whether the run says so, whether its products are lean
    (9e9, "", 0, False, False),
    (7.3e6, "", 0, True, True),
    (3e6, "", 10, False, False),
    (9e9, "-matptap_via allatonce", 0, False, True),
    (7.3e6, "-matptap_via allatonce", 0, False, True),
    (7.3e6, "-matptap_via nonscalable", 10, False, False),
]


@built
@pytest.mark.parametrize("free, options, code, told, lean", LEAN)
def test_lean_levels(free, options, code, told, lean, tmp_path):
    """Two ranks: levels take less memory where the usual way does not fit, and the run says so; an option decides."""
    package = tree(tmp_path / "package")
    (package / "build").symlink_to(ROOT / "build")
    (package / "edp/solver/compliance" / "memory.sh").write_text(f"echo {free} 1e300\n")
    flags = ["-order", 1, "-h", 1.2, "-layers", 2, "-vtu", 0, "-estimate", 0, "-tol", 1e-9, "-out", tmp_path / "out"]
    start = ["sh", "-c", 'ulimit -v 50000000 && exec "$@"', "sh", *MPIEXEC, 2, "sh", "edp/freefem.sh"]
    set_by = environment(**AS_ROOT, PETSC_OPTIONS=f"{options} -info {tmp_path}/info:mat")
    found, output = execute(
        [*map(flag_text, start), script("sphere-on-block"), *map(flag_text, flags)], package, set_by
    )
    assert found == code, output[-2000:]
    assert ("multigrid: lean set-up" in output) == told, output
    if code == 10:
        assert len(said(output)) == 1 and "GB" in output, output
        return
    assert ("Nonscalable" not in (tmp_path / "info.0").read_text()) == lean
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["force"] == pytest.approx(
        run("sphere-on-block", "-h", 1.2, "-layers", 2, "-tol", 1e-9).force, rel=1e-8
    )


@built
def test_load_series(tmp_path):
    """Two ranks write one series, whose last row is the direct engine's."""
    flags = ["-order", 1, "-h", 1.2, "-layers", 2, "-history", 1, "-steps", 2, "-vtu", 0, "-estimate", 0]
    rows = []
    for ranks, solver in ((1, "direct"), (2, "multigrid")):
        code, output = on_ranks(ranks, script("sphere-on-block"), *flags, "-solver", solver, "-out", tmp_path / solver)
        assert code == 0, output[-2000:]
        rows.append((tmp_path / solver / "series.csv").read_text().splitlines())
    assert len(rows[0]) == len(rows[1]) == 3
    for one, other in zip(rows[0][1:], rows[1][1:], strict=True):
        one, other = ([float(word) for word in row.split(",")] for row in (one, other))
        assert other[:6] == pytest.approx(one[:6], rel=1e-5)


@built
def test_new_meshes(tmp_path):
    """An accuracy asked for: a new matrix for each mesh, and as good an answer as the direct engine's."""
    flags = ["-order", 1, "-h", 2, "-layers", 1, "-accuracy", 0.15, "-vtu", 0]
    direct, other = (
        run_in(ROOT, script("sphere-on-block"), *flags, "-solver", solver, out=tmp_path / solver).summary
        for solver in ("direct", "multigrid")
    )
    assert other["accuracy"]["meshes"] == direct["accuracy"]["meshes"] > 1
    assert other["factorisations"] == other["accuracy"]["meshes"]
    assert other["force"] == pytest.approx(direct["force"], rel=1e-2)


REFUSED = [
    (1, "sphere-on-block", ["-solver", "multigrid", "-method", "paper"], "-method paper"),
    (1, "adhesive-sphere-3d", ["-solver", "multigrid", "-path", "0 1"], "-solver multigrid"),
    (1, "adhesive-sphere-3d", ["-solver", "multigrid"], "law that falls"),
    (2, "sphere-on-block", ["-accuracy", 0.01], "-accuracy"),
    (1, "sphere-on-block", ["-solver", "multigrid", "-order", 4], "-order"),
    (2, "disc-on-block", ["-order", 4], "scenes in space"),
    (2, "sphere-on-block", ["-solver", "direct"], "-solver direct runs on one process"),
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


@built
@pytest.mark.parametrize("unlike", ["flag", "file"])
def test_ranks_of_different_commands(tmp_path, unlike):
    """Processes with other flags, or another file under one name, shall be refused in one line."""
    start = [
        "sh",
        "edp/freefem.sh",
        script("sphere-on-block"),
        "-solver",
        "multigrid",
        "-h",
        2,
        "-out",
        tmp_path / "out",
    ]
    ways = [["-kappa", "1e6"], ["-kappa", "1e7"]]
    if unlike == "file":
        ways = [["-law", "table", "-table", "law.csv"]] * 2
    folders = [tmp_path / str(k) for k in range(2)]
    for k, folder in enumerate(folders):
        folder.mkdir()
        (folder / "law.csv").write_text(f"0,0\n0.1,{k + 1}\n0.2,{k + 3}\n")
    start[1] = ROOT / start[1]
    start[2] = ROOT / start[2]
    first, second = (["-n", 1, "-wdir", folder, *start, *way] for folder, way in zip(folders, ways, strict=True))
    code, output = execute(["mpiexec", *first, ":", *second], ROOT, environment(**AS_ROOT))
    assert code == 10 and len(said(output)) == 1, output
    assert said(output)[0].startswith("-np 2: the processes have different flags or input files")
    assert not (tmp_path / "out").exists()


@built
def test_words_reach_several_processes_as_they_are(tmp_path):
    """No shell shall read the flags of a run on several processes again, whose engine needs no flag."""
    flags = ["-order", 1, "-h", 2, "-layers", 1, "-vtu", 0, "-estimate", 0]
    package = tree(tmp_path / "package")
    (package / "build").symlink_to(ROOT / "build")
    code, output = on_ranks(2, script("sphere-on-block"), *flags, "-out", "a b;touch F $(touch F)", cwd=package)
    assert code == 0, output
    assert (package / "a b;touch F $(touch F)" / "summary.json").exists() and not list(package.glob("F*"))


@built
def test_plugin_in_a_cache(tmp_path):
    """The starter shall find the plugin in the cache, a folder with a freefem++.pref or not."""
    package = tree(tmp_path / "package")
    shutil.copytree(ROOT / "build", tmp_path / "cache" / "build")
    lines = [f'{kind} += "{tmp_path}/cache/build"\n' for kind in ("loadpath", "includepath")]
    (tmp_path / "cache" / "build" / ".freefem++.pref").write_text("".join(lines))
    words = ["sphere-on-block", "-solver", "multigrid", "-h", 2, "-order", 1, "-vtu", 0, "-estimate", 0]
    code, output = execute(
        ["sh", "edp/freefem.sh", *words], package, environment(CONTACT_CACHE=str(tmp_path / "cache"))
    )
    assert code == 0, output


@built
@pytest.mark.parametrize(
    "program, flags, allowed",
    [("FreeFem++", [], "FreeFem++-mpi"), ("FreeFem++-mpi", ["-distance", "exact"], "sh edp/freefem.sh")],
)
def test_several_processes_of_freefem_itself(program, flags, allowed, tmp_path):
    """mpiexec with FreeFem++, which is no program of MPI's, shall be refused with what to write instead; so shall ranks
    that would have to start anew for what their flags ask for."""
    start = [*MPIEXEC, 2, program, "-nw", "-v", 0, script("sphere-on-block"), "-solver", "multigrid", "-h", 2, *flags]
    code, output = execute([*start, "-out", tmp_path / "out"], env=environment(**AS_ROOT))
    assert code == 10 and f"allowed: mpiexec -n 2 {allowed}" in said(output)[0] and len(said(output)) == 1, output
    assert not (tmp_path / "out").exists()


STACK = 'body block E 100 nu 0.3\nbody upper E 100 nu 0.3\ncontact top "upper bottom"\nclamp bottom\n'
PULLED = STACK + 'clamp "upper left"\nforce "upper right" {}\nweight block {}\n'
FLOATS = STACK + 'symmetry "upper left"\npressure "upper top" 2\nstresses\n'
MOVED = STACK + 'move "upper top" {}\n'
PARTS = [
    (FLOATS, [], ["-order", 1, "-estimate", 1], 2),  # grounded, its symmetry across no axis; duals of next to no forces
    (PULLED, [(0, 0, -1), (0, 0, -1)], ["-order", 2, "-estimate", 1], 1),
    (
        MOVED,
        [(2e-3, 1e-3, -1e-2)],
        ["-order", 1, "-history", 1, "-steps", 2, "-estimate", 1],
        2,
    ),  # errors by products with K
    (MOVED, [(2e-3, 1e-3, -1e-2)], ["-order", 1, "-distance", "exact"], 2),
    (MOVED.replace('bottom"', 'bottom" friction 0.3', 1), [(2e-3, 1e-3, -1e-2)], ["-order", 1], 1),
]


@built
@pytest.mark.parametrize("case, ways, flags, ranks", PARTS)
def test_case(case, ways, flags, ranks, tmp_path):
    """Two boxes, turned: the direct engine's pressures, forces and motions, on any number of processes."""
    matrix = turn_in_space(1)
    mesh = cube(Mesh(), cells=(4, 4, 3))
    cube(mesh, cells=(5, 3, 2), at=(0, 0, 1), prefix="upper ", name="upper")
    (tmp_path / "a.msh").write_text(mesh.text(matrix))
    (tmp_path / "a.case").write_text(case.format(*(vector(way, matrix, 3) for way in ways)))
    given = ["-mesh", tmp_path / "a.msh", "-case", tmp_path / "a.case", "-tol", 1e-8, "-vtu", 0, *flags]
    given += [] if "-estimate" in flags else ["-estimate", 0]
    found = []
    for solver, count in (("direct", 1), ("multigrid", ranks)):
        flags = [*given, "-solver", solver, "-out", tmp_path / solver]
        code, output = on_ranks(count, "edp/parts-3d.edp", *flags)
        assert code == 0, output[-2000:]
        found.append(Run(code, output, tmp_path / solver))
    one, other = found
    assert other.summary["iterations"] > 0 == one.summary["iterations"]
    assert abs(other.newton - one.newton) <= 1
    assert other.contact["pressure"] == pytest.approx(one.contact["pressure"], abs=1e-6 * one.pressureMax)
    for a, b in zip(one.summary["contacts"], other.summary["contacts"], strict=True):
        assert b["force"] == pytest.approx(a["force"], abs=1e-6 * np.linalg.norm(a["force"]))
    force = np.linalg.norm(one.summary["contacts"][0]["force"])
    for a, b in zip(one.summary["bodies"], other.summary["bodies"], strict=True):
        assert b["motion"] == pytest.approx(a["motion"], rel=1e-5, abs=1e-8)
        assert b["reaction"] == pytest.approx(a["reaction"], abs=1e-5 * force)


@built
def test_moved_support_is_in_balance(tmp_path):
    """What moves a support is a load far greater than the forces: these shall balance as far as a case is asked to."""
    mesh = cube(Mesh(), cells=(4, 4, 3))
    cube(mesh, cells=(5, 3, 2), at=(0, 0, 1), prefix="upper ", name="upper")
    (tmp_path / "a.msh").write_text(mesh.text(turn_in_space(1)))
    down = vector((0, 0, -1e-5), turn_in_space(1), 3)
    bodies = "body block E 70 nu 0.3\nbody upper E 210 nu 0.3\n"
    (tmp_path / "a.case").write_text(f'{bodies}contact "upper bottom" top\nclamp bottom\nmove "upper top" {down}\n')
    files = ["-mesh", tmp_path / "a.msh", "-case", tmp_path / "a.case", "-out", tmp_path / "out"]
    flags = ["-solver", "multigrid", "-order", 2, "-tol", 1e-4, "-estimate", 0, "-vtu", 0]
    code, output = on_ranks(1, "edp/parts-3d.edp", *files, *flags)
    assert code == 0, output[-2000:]
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["outOfBalance"] <= 5e-7


@built
def test_case_that_turns_is_refused(tmp_path):
    (tmp_path / "a.msh").write_text(cube(Mesh()).text())
    case = "body block E 100 nu 0.3\nobstacle top plane 0 0 1.1 0 0 -1\nrotate bottom 0 0 0 0 0 1 0.01\n"
    (tmp_path / "a.case").write_text(case)
    flags = ["-mesh", tmp_path / "a.msh", "-case", tmp_path / "a.case", "-solver", "multigrid"]
    code, output = on_ranks(1, "edp/parts-3d.edp", *flags, "-out", tmp_path / "out")
    assert code == 10 and "rotate bottom: not with -solver multigrid; allowed: -solver direct" in said(output)[-1]


@built
def test_engine_chosen_by_size(tmp_path):
    """Beyond 50 000 unknowns of P1 the engine is multigrid, said in one line."""
    flags = ["-order", 1, "-vtu", 0, "-estimate", 0, "-tol", 1e-3, "-verbose", 1, "-out", tmp_path / "out"]
    code, output = on_ranks(1, script("sphere-on-block"), "-h", 0.265, *flags)
    assert code == 0 and output.count("engine: multigrid, for ") == 1, output
    assert "faster than -solver direct" in output and "their iterations" in output


@built
@pytest.mark.parametrize("kilobytes, expect", [(1500000, 0), (480000, 10)])
def test_one_rank_has_less_memory(kilobytes, expect, tmp_path):
    """Its limit of address space, if enough, changes nothing; else all ranks end, with one line."""
    flags = ["-order", 1, "-h", 2.4, "-layers", 1, "-solver", "multigrid", "-estimate", 0, "-out", tmp_path / "out"]
    run = shlex.join(map(flag_text, ["FreeFem++-mpi", "-nw", "-v", 0, script("sphere-on-block"), *flags]))
    limited = f"test $OMPI_COMM_WORLD_RANK = 0 || ulimit -v {kilobytes}; exec {run}"
    code, output = execute([*MPIEXEC, "2", "sh", "-c", limited], ROOT, environment(**AS_ROOT))
    assert code == expect and output.count("ulimit -v: ") == (expect > 0), output


@built
def test_job_script(tmp_path):
    """It takes a script with its flags, says the memory of a rank before the run, and runs so many ranks."""
    flags = [script("sphere-on-block"), "-h", 1.5, "-layers", 1, "-order", 1, "-estimate", 0, "-out", tmp_path / "out"]
    command = ["sh", "edp/scenes/slurm.sh", *map(flag_text, flags)]
    code, output = execute(command, ROOT, environment(**AS_ROOT, SLURM_NTASKS="2"))
    assert code == 0, output
    summary = json.loads((tmp_path / "out/summary.json").read_text())
    told = float(re.search(r"memory: up to ([\d.]+) GB on each of 2 processes", output)[1])
    assert summary["ranks"] == 2 and summary["converged"]
    n = summary["ndof"]
    assert told == pytest.approx(0.05 + 2.6e-6 * n / 2 + 18e-6 * n ** (2 / 3), rel=0.05)
    code, output = execute([*command, "-order", "7"], ROOT, environment(**AS_ROOT, SLURM_NTASKS="2"))
    assert code == 10 and len(said(output)) == 1, output
    code, output = execute(command, ROOT, {**environment(**AS_ROOT), "SLURM_NTASKS": ""})
    assert code and output.strip().endswith("start this by sbatch, or set it to the number of processes"), output


@built
def test_tie(tmp_path):
    """Its start takes many products of the compliance, of vectors nearly along each other: the overlaps stay true.

    The fewer digits a product needs, the fewer iterations it takes: with all digits each it takes 38.
    """
    statements = (
        "body bracket E 3e3 nu 0.4\nbody ball E 210e3 nu 0.3\ntie shelf ball-surface\nclamp bolts\n"
        "weight ball 0.01 0 -0.046627423\n"
    )
    (tmp_path / "tie.case").write_text(statements)
    geometry = (ROOT / "edp/examples/ball-on-bracket/ball-on-bracket.geo").read_text()
    (tmp_path / "coarse.geo").write_text(geometry.replace("size = {0.2", "size = {3"))
    names = ["-mesh", tmp_path / "coarse.geo", "-case", tmp_path / "tie.case"]
    flags = [*names, "-order", 1, "-tol", 1e-9, "-estimate", 0]
    found = [run_in(ROOT, "edp/parts-3d.edp", *flags, "-solver", engine, out=tmp_path / engine) for engine in ENGINES]
    direct, multigrid = (result.summary for result in found)
    # the direct engine may factorise bodies and tie together
    assert direct["newton"] <= multigrid["newton"] <= direct["newton"] + 1 and multigrid["backsolves"] <= 55
    assert multigrid["iterations"] < 28 * multigrid["backsolves"]
    assert multigrid["pressureMax"] == pytest.approx(direct["pressureMax"], rel=1e-8)


@built
def test_killed_rank(tmp_path):
    """A rank that dies ends the run, with mpiexec's word; the next run into the same folder finds its way.

    It dies once the plugin is loaded: in the 20 ms before, in which a process makes itself known to mpiexec, a death
    can leave mpiexec of Open MPI 4.1 waiting for ever (two of 150 runs, also of an empty script).
    """
    name = script("sphere-on-block")
    flags = ["-order", 1, "-solver", "multigrid", "-vtu", 0, "-estimate", 0, "-out", tmp_path / "out"]
    command = map(flag_text, [*MPIEXEC, 2, "FreeFem++-mpi", "-nw", "-v", 0, name, *flags, "-h", 0.4])
    pipe = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    running = subprocess.Popen(list(command), cwd=ROOT, env=environment(**AS_ROOT), **pipe)
    victim = None
    while running.poll() is None and (victim is None or not has_loaded(victim, "multigrid-plugin")):
        time.sleep(0.05)
        victim = process_of_rank(1, str(tmp_path / "out"))
    assert victim is not None
    os.kill(victim, signal.SIGKILL)
    output, _ = running.communicate(timeout=patience(60))
    assert running.returncode not in (0, 10, 20)
    assert "rank 1" in output
    code, output = on_ranks(1, name, *flags, "-h", 1.2, "-layers", 2)
    assert code == 0, output[-2000:]


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
    run_in(package, script("sphere-on-block"), *flags, "-vtu", 0, "-estimate", 0, out=tmp_path / "out")
