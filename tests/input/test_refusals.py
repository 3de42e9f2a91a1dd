"""What is refused: exit code 10, a first line with flag, value and what is allowed, and nothing written anywhere."""

import os

import pytest
from freefem import cases_of, environment, flag_lists, listing, run_in, tree

DISC, TWO_BODIES, BLOCK = "edp/main.edp", "edp/scenes/meshed-disc.edp", "edp/scenes/confined-block.edp"


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """A fresh clone: no meshes yet, no results; every run is refused and leaves it so."""
    return tree(tmp_path_factory.mktemp("refusals") / "package")


def refused(package, script, *flags, out="results/new/folder", env=None):
    """The first line of a run that must be refused; the package must be as it was."""
    before = listing(package)
    result = run_in(package, script, *flags, out=out, expect=10, env=env)
    assert listing(package) == before
    return result.stdout.splitlines()[0]


ALLOWED = {  # what is allowed: what is not
    "above 0": "-kappa 0 | -kappa -1e3 | -E -100 | -h 0 | -h -0.5 | -width 0 | -depth -20 | -rho 0 | -kappa 1e3x",
    "(1, 1000)": "-m 1 | -m 0.5",
    "(-1, 0.5)": "-nu 0.5 | -nu -1 | -nu 0.7",
    "below 0": "-d0 0 | -d0 0.1",
    "at most": "-h 20.5 | -h 20.00000001",
    "(0, 1)": "-eps 0 | -eps 1 | -tol 0 | -tol 1 | -tol -1e-6",
    "1 to 4": "-order 5 | -order 0 | -order 1.5",
    "from 1": "-steps 0 | -maxNewton 0 | -maxAdaptations 2.5",
    "paper": "-method fixedpoint",
    "newton": "-method Newton",
    "d0": "-T0 -0.3 | -T0 d1",
    "-kappa": "-kapa 1e3",
    "number": "-u0 1e400 | -gap half",
}
EVERYWHERE = [(*case.split(" "), allowed) for allowed, cases in ALLOWED.items() for case in cases.split(" | ")]


# the scenes share the modules that read these flags: each refuses a part of the values; the last of a flag and reason
# at once, the others in the long run
LAST = {(flag, allowed): value for flag, value, allowed in EVERYWHERE}
CASES = [((DISC, BLOCK, DISC, BLOCK, TWO_BODIES)[place % 5], *case) for place, case in enumerate(EVERYWHERE)]
QUICK = [case for case in CASES if LAST[case[1], case[3]] == case[2]]


@pytest.mark.parametrize("script, flag, value, allowed", cases_of(QUICK, CASES))
def test_refused_by_every_scene(package, script, flag, value, allowed):
    """A scene shall refuse the value in one line that names flag, value and what is allowed."""
    method = [] if flag in ("-method", "-T0") else ["-method", "newton"]
    line = refused(package, script, *method, flag, value)
    assert flag in line
    assert flag == "-kapa" or value in line
    assert "allowed" in line
    assert allowed in line.split("allowed", 1)[1]


OWN = {DISC: "-R 0 | -R -10 | -Eratio 1e6", TWO_BODIES: "-R 0 | -Eratio 0 | -gap -1", BLOCK: "-R 10"}


@pytest.mark.parametrize("script, flag, value", [(name, *one) for name in OWN for one in flag_lists(OWN[name])])
def test_refused_by_one_scene(package, script, flag, value):
    """A scene's own flags shall be refused outside their range, and where the scene does not have them."""
    line = refused(package, script, "-method", "newton", flag, value)
    assert flag in line
    assert "allowed" in line
    assert "unknown flag" in line or value in line


def test_value_of_several_lines(package):
    """A refusal shall be one line whatever it quotes."""
    before = listing(package)
    lines = run_in(package, DISC, "-kappa", "1\n2", expect=10).stdout.splitlines()
    assert lines == ["-kappa 1 2: not a number; allowed: a number above 0"] and listing(package) == before


def test_flag_without_value(package):
    """A flag at the end without a value, or given twice, shall be refused."""
    before = listing(package)
    line = run_in(package, DISC, "-kappa", expect=10).stdout.splitlines()[0]
    assert "-kappa" in line
    assert "above 0" in line
    assert "-kappa" in refused(package, DISC, "-kappa", "1", "-kappa", "2")
    assert listing(package) == before


@pytest.mark.parametrize(
    "out", ["/dev/null/x", "/dev/null", "/proc/x", "/proc/x/y", "edp/main.edp", "edp/main.edp/x", ""]
)
def test_folder_that_cannot_be_written(package, out):
    """An output folder that cannot be written shall be refused before anything is made, the mesh included."""
    before = listing(package)
    flags = ["-method", "newton", "-h", 1.5]
    line = run_in(package, DISC, *flags, "-out", out, expect=10).stdout.splitlines()[0]
    assert "-out" in line
    assert out in line
    assert "allowed" in line
    assert listing(package) == before


def test_flag_as_folder(package):
    """-out without its folder, followed by another flag, shall be refused and not become a folder of that name."""
    before = listing(package)
    for flags in (["-out", "-vtu", "0"], ["-vtu", "0", "-out"]):
        line = run_in(package, DISC, "-method", "newton", "-h", 1.5, *flags, expect=10).stdout.splitlines()[0]
        assert "-out" in line
    assert listing(package) == before


# ---------------------------------------------------------------- gmsh


@pytest.fixture(scope="module")
def path_without_gmsh(tmp_path_factory):
    """A folder with every command of PATH but gmsh."""
    folder = tmp_path_factory.mktemp("bin")
    for entry in os.environ["PATH"].split(":"):
        for name in os.listdir(entry) if os.path.isdir(entry) else []:
            if name != "gmsh" and not (folder / name).is_symlink():
                (folder / name).symlink_to(os.path.join(entry, name))
    return folder


@pytest.mark.parametrize("script", [DISC, TWO_BODIES])
def test_gmsh_missing(package, path_without_gmsh, script):
    """A scene that needs gmsh shall say that it is missing."""
    env = environment(PATH=str(path_without_gmsh))
    line = refused(package, script, "-method", "newton", "-h", 1.5, env=env)
    assert "gmsh" in line
    assert "PATH" in line


def test_gmsh_not_needed(package, path_without_gmsh, tmp_path):
    """A scene with FreeFEM's own mesh shall run without gmsh."""
    env = environment(PATH=str(path_without_gmsh))
    run_in(package, BLOCK, "-method", "newton", "-h", 5, out=tmp_path / "out", env=env)


@pytest.mark.parametrize(
    "does",
    [
        "exit 0",
        "exit 1",
        "kill -9 $$",
        'for last; do :; done; echo "not a mesh" > "$last"',
        'for last; do :; done; : > "$last"',
        'for last; do :; done; printf "\\$MeshFormat\\n2.2 0 8\\n\\$EndMeshFormat\\n" > "$last"',  # cut off
    ],
)
def test_gmsh_failing(package, path_without_gmsh, tmp_path, does):
    """When gmsh fails, whatever its exit code, the run shall be refused and nothing left behind."""
    gmsh = tmp_path / "gmsh"
    gmsh.write_text(f"#!/bin/sh\n{does}\n")
    gmsh.chmod(0o755)
    env = environment(PATH=f"{tmp_path}:{path_without_gmsh}")
    line = refused(package, DISC, "-method", "newton", "-h", 1.5, env=env)
    assert "gmsh failed" in line
    assert "h 0.0375" in line


@pytest.mark.parametrize(
    "flag, value", [("-h", "1e-14"), ("-grading", "1e20"), ("-depth", "1e14"), ("-R", "1e-13"), ("-reach", "1e-6")]
)
def test_shape_that_cannot_be_meshed(package, flag, value):
    """A ratio of lengths that the mesh's decimals cannot carry shall be refused, not rounded to another shape."""
    line = refused(package, DISC, "-method", "newton", flag, value)
    assert line.startswith(flag + " ") or "gmsh failed" in line
    assert "allowed" in line
    assert flag != "-grading" or "size" not in line
