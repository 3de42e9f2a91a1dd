"""Little memory: an answer, or one line and a code; never a number beside it."""

import json
import re
import resource
import subprocess
import time

import pytest
from accounts import shared
from freefem import MULTIGRID, ROOT, TIMEOUT, cases_of, data, environment, flag_text, patience, script, snippet

EXAMPLES = ROOT / "edp" / "examples"
built = MULTIGRID.exists()


def within(megabytes, *command, threads=1, folder=None, longest=TIMEOUT):
    """(exit code, output, seconds) of a run in so much address space; None: in as much as there is."""

    def limit():
        if megabytes:
            resource.setrlimit(resource.RLIMIT_AS, (megabytes * 1000**2,) * 2)

    began = time.monotonic()
    done = subprocess.run(
        ["FreeFem++", "-nw", "-v", "0", *map(flag_text, command), "-vtu", "0", "-out", str(folder)],
        cwd=ROOT,
        env=environment(OPENBLAS_NUM_THREADS=str(threads)),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        stdin=subprocess.DEVNULL,
        preexec_fn=limit,
        timeout=longest,
    )
    return done.returncode, done.stdout.decode(errors="replace"), time.monotonic() - began


def example(name):
    return ["edp/parts-3d.edp", "-mesh", EXAMPLES / name / f"{name}.geo", "-case", EXAMPLES / name / f"{name}.case"]


SPACE = [script("sphere-on-block"), "-order", 1, "-h", 0.4]
CASES = {
    "space": SPACE,
    # both engines, as memory has it: each to the digits that are compared
    "space, finer": [script("sphere-on-block"), "-h", 0.6, "-tol", 1e-9],
    "space, full storage": [script("two-spheres"), "-method", "newton", "-h", 0.28],
    "plane": [script("disc-on-block"), "-h", 0.03],
    "plane, P4": [script("disc-on-block"), "-h", 0.08, "-order", 4],
    "plane, default": [script("disc-on-block")],
    "plane, full storage": [script("two-cylinders"), "-method", "newton", "-h", 0.05],
    "bracket": example("ball-on-bracket"),
    "cylinders": example("crossed-cylinders"),
    "multigrid": [script("sphere-on-block"), "-order", 1, "-h", 0.25, "-solver", "multigrid"],
}

SIZES = {1: (300, 400, 500, 700, 1000, 1500, 2000, 3000), 2: (350, 450, 600, 850, 1200, 1700, 3000)}  # MB, by threads


@shared
def unlimited(name, base):
    folder = base / name.replace(" ", "")
    code, output, seconds = within(None, *CASES[name], folder=folder)
    assert code == 0, output[-2000:]
    return json.loads((folder / "summary.json").read_text()), seconds


@pytest.mark.parametrize("name", CASES)
def test_answer_or_one_line(name, tmp_path_factory, capsys):
    """From 300 MB on, one thread of BLAS and two: a refusal or a failure in one line, nothing written, until there is
    room for the same answer."""
    if name == "multigrid" and not built:
        pytest.skip("the plugin is not built: make mpi")
    base = tmp_path_factory.mktemp("memory")
    free, seconds = unlimited(name, base)
    for threads in (1, 2):
        row = []
        for megabytes in SIZES[threads]:
            folder = base / f"{threads}-{megabytes}"
            longest = 10 * seconds + patience(20)
            code, output, _ = within(megabytes, *CASES[name], threads=threads, folder=folder, longest=longest)
            row.append(f"{megabytes}: {code}")
            if code == 0:
                answer = json.loads((folder / "summary.json").read_text())
                assert answer["force"] == pytest.approx(free["force"], rel=1e-9)
                break
            assert not (folder / "summary.json").exists()
            lines = output.splitlines()
            if code == 2:  # the plugin's libraries are loaded before the package's first line
                assert built and "Load error" in output and megabytes < 500
            elif code == 10:
                assert len([line for line in lines if "GB" in line and not line.startswith("engine: ")]) == 1, (
                    row,
                    output[-2000:],
                )
            else:
                assert code == 30, (row, output[-2000:])
                assert lines[-1].startswith("out of memory: "), (row, output[-2000:])
        assert code == 0, row  # 3 GB are enough for each
        with capsys.disabled():
            print(f"\n{name}, {free['ndof']} dofs, {threads} threads, {seconds:.1f} s: {', '.join(row)}")


def test_refused_before_it_is_taken(tmp_path):
    """One line that says what is needed, what is there and what would fit; it does."""
    code, output, _ = within(430, *SPACE[:-1], 0.36, folder=tmp_path / "out")
    assert code == 10
    assert len(output.splitlines()) == 1, output
    assert re.match("-h 0.36: 25[0-9]{3} unknowns take 0.16 GB of memory, ", output), output  # gmsh's version decides
    assert not (tmp_path / "out").exists()
    fits = output.split("-h ")[2].split(",")[0].strip()
    code, output, _ = within(430, *SPACE[:-1], fits, "-estimate", 0, folder=tmp_path / "out")
    assert code == 0, output


@pytest.mark.parametrize("megabytes, h, order", cases_of([(275, 0.1, 3)], [(265, 0.06, 4), (280, 0.05, 4)]))
def test_plane_numbered_within_memory(tmp_path, megabytes, h, order):
    """FreeFEM crashes where the numbering of the plane's nodes does not fit: one line before that."""
    flags = *CASES["plane, default"], "-h", h, "-order", order
    code, output, _ = within(megabytes, *flags, folder=tmp_path / "out")
    assert code == 10 and len(output.splitlines()) == 1 and "GB" in output, (megabytes, code, output)


def starts(megabytes, folder):
    """Does FreeFEM itself begin with two threads in so much? Newer ones wait for ever, before they read a script."""
    (folder / "empty.edp").write_text('cout << "begun" << endl;\n')
    try:
        return "begun" in within(megabytes, folder / "empty.edp", threads=2, folder=folder, longest=10)[1]
    except subprocess.TimeoutExpired:
        return False


def test_threads_without_addresses(tmp_path):
    """OpenBLAS waits for ever for the buffers of two threads where FreeFEM just fits; with one there is an answer."""
    least = next(megabytes for megabytes in (300, 400, 500) if starts(megabytes, tmp_path))
    code, output, _ = within(least, *CASES["plane, default"], threads=2, folder=tmp_path / "out")
    assert code == 10 and "OPENBLAS_NUM_THREADS=1" in output
    assert len(output.splitlines()) == 1
    room = 300 if least == 300 else least + 100
    code, output, _ = within(room, *CASES["plane, default"], "-estimate", 0, threads=1, folder=tmp_path / "out")
    assert code == 0, output


def test_memory_of_several_processes():
    """The model of the job script, and the formula of a run, against the measured table."""
    words = r"([\d.]+) GB for .* ([\d.]+) kB n of P1, ([\d.]+) of\n# P2,.* ([\d.]+) kB n\^\(2/3\) of P1, ([\d.]+) of"
    found = re.search(words, (ROOT / "edp/scenes/slurm.sh").read_text())
    program, *each = (float(word) for word in found.groups())
    formula = (ROOT / "edp/solver/compliance/memory.idp").read_text()
    surfaces, parts = (re.search(rf"(\d+) : (\d+)\) {last}", formula).groups() for last in (r"\* n\^\(2", "/ ranks"))
    assert [1000 * kilobytes for kilobytes in each] == [float(word) for word in (*parts, *surfaces)]
    constants = re.search(r"real leanFraction = ([\d.]+)", formula)
    table = (ROOT / "tests/COST.md").read_text().split("<!-- table: ranks -->")[1].split("<!-- end -->")[0]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines() if line[:3] == "| P"]
    rows = [row for row in rows if row[2] != "1" and row[3].isdigit()]
    assert len(rows) >= 4 and any("lean" in row[0] for row in rows)
    for name, dofs, ranks, megabytes, *_ in rows:
        part, surface = each[name.startswith("P2") :: 2]
        model = 1000 * program + (part * int(dofs) / int(ranks) + surface * int(dofs) ** (2 / 3)) / 1000
        if "lean" in name:
            model = 1000 * program + (model - 1000 * program) * float(constants[1])
        assert 0.7 * model <= float(megabytes) <= 1.02 * model, name


SYSTEM = data("memory/system.edp")


def test_groups_and_a_failed_factorisation(tmp_path):
    """The least that a control group above the process leaves; a solution that solves nothing ends the run."""
    files = {
        "proc/self/cgroup": "0::/a/b\n",
        "sys/fs/cgroup/a/b/memory.max": "max\n",
        "sys/fs/cgroup/a/memory.max": "3000000000\n",
        "sys/fs/cgroup/a/memory.current": "1500000000\n",
        "sys/fs/cgroup/a/memory.stat": "anon 1\nfile 2\ninactive_file 500000000\n",
    }
    for name, text in files.items():
        path = tmp_path / "fake" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    asked = ["sh", str(ROOT / "edp/solver/compliance/memory.sh"), "1"]
    assert subprocess.check_output([*asked, str(tmp_path / "fake")], text=True) == "2000000000 1e300\n"
    assert subprocess.check_output([*asked, str(tmp_path / "none")], text=True) == "1e300 1e300\n"
    output = snippet(tmp_path, SYSTEM, expect=30)
    assert output.splitlines()[-1].startswith("out of memory: ")
