"""Which test runs the commands of which page; each page with commands has one, each drawing command is understood."""

import re
import shlex
from fnmatch import fnmatch

import pytest
import screens
from freefem import MULTIGRID, ROOT, environment, execute

from docs.test_readme import PAGES, fences
from postprocess.command_line import parser

# a page, and the test that runs its commands as they stand or on a coarser mesh
RUN_BY = {
    "README.md": "test_readme.py::test_doors",
    "CONTRIBUTING.md": ".ci/run",  # they are what it runs
    "edp/input/README.md": "test_examples.py::test_page_of_the_case_file",
    "edp/examples/*/README.md": "test_examples.py",  # the case on coarser or finer meshes
    "edp/docs/howto/*.md": "test_commands.py::test_page",
    "edp/labs/*/README.md": "test_labs.py",
    "edp/labs/0-algorithm/*.md": "test_tutorials.py::test_commands",
    "edp/scenes/README.md": "test_scene_docs.py",
    "edp/docs/tutorial/*.md": "test_tutorials.py::test_commands",
    "edp/docs/ERRORS.md": "test_tutorials.py::test_commands",
    "tests/RESULTS.md": "test_readme.py::test_freefem_commands",
    "tests/VERIFICATION.md": "test_verification.py::test_case",
    "template/README.md": "test_commands.py::test_what_is_begun",
}
HOWTO = {path.stem: path for path in sorted((ROOT / "edp/docs/howto").glob("*.md")) if fences(path.read_text(), "sh")}
COARSER = {  # each page as it stands, apart from these
    "-h 0.1": "-h 0.5",
    "-100:-2000:20": "-100:-2000:2",
    '--flags="-order 4"': '--flags="-order 1 -estimate 0"',
    "SCENE=sphere-on-block NP=2": "SCENE=sphere-on-block NP=2 ARGS='-h 2 -estimate 0'",
    "-solver multigrid": "-solver multigrid -h 2 -estimate 0",
    "-accuracy 1e-6": "-accuracy 1e-3",
    "-method paper -order 2": "-method paper -order 2 -set size 0.4",
}
# Open MPI in a container: as root, on fewer cores than processes
MPI = """export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
"""
NEEDS_FIGURES = "paraview"  # a picture of `make figures`, drawn by PyVista: test_pictures draws the like


def all_pages():
    return sorted({*PAGES, "template/README.md"})


def test_every_page_has_its_test():
    """Each page with commands shall be in the table; each line of the table shall have a page, and a test."""
    shown = {page for page in all_pages() if fences((ROOT / page).read_text(), "sh")}
    left_out = {page for page in shown if not any(fnmatch(page, name) for name in RUN_BY)}
    assert left_out == set()
    for name, test in RUN_BY.items():
        assert any(fnmatch(page, name) for page in shown), name
        file, _, function = test.partition("::")
        path = ROOT / file if "/" in file else next((ROOT / "tests").glob(f"*/{file}"))
        assert f"def {function}" in path.read_text() if function else path.exists()


def test_drawing_commands():
    """Each `python -m postprocess` of a page shall be one that the program takes."""
    read, wrong, understood = 0, [], parser()
    for page in all_pages():
        text = (ROOT / page).read_text()
        lines = [line for block in fences(text, "sh") for line in block.splitlines()]
        for line in lines + re.findall(r"`(\.venv/bin/python -m postprocess [^`]+)`", text):
            if found := re.match(r"\.venv/bin/python -m postprocess (.*)", line):
                words = shlex.split(found[1].partition("#")[0])
                words = words[: words.index(">")] if ">" in words else words
                if len(words) == 1:  # a subcommand that is named, or --help
                    continue
                read += 1
                try:
                    understood.parse_args(words)
                except SystemExit:
                    wrong.append(f"{page}: {line}")
    assert wrong == [] and read > 50


@pytest.mark.parametrize("name", [name for name in HOWTO if name != NEEDS_FIGURES])
def test_page(name, tmp_path):
    """The commands of a how-to page shall run, one after the other, on coarse meshes."""
    commands = "".join(fences(HOWTO[name].read_text(), "sh"))
    if "multigrid" in commands and not MULTIGRID.exists():
        pytest.skip("the plugin is not built: make mpi")
    for fine, coarse in COARSER.items():
        commands = commands.replace(fine, coarse)
    commands = re.sub(r"^make mpi\n", "", commands, flags=re.M)  # test_make_builds_the_plugin builds it
    package = screens.package(tmp_path / "package")
    (package / "build").symlink_to(ROOT / "build")
    code, stdout = screens.execute(screens.Script(MPI + commands), package)
    assert code == 0, stdout[-3000:]


def test_what_is_begun(tmp_path):
    """The commands on the page of a folder that `make new` begins shall run there."""
    folder = tmp_path / "mine"
    assert execute(["make", "new", f"DIR={folder}"], ROOT)[0] == 0
    (commands,) = fences((folder / "README.md").read_text(), "sh")
    code, stdout = execute(["sh", "-e", "-c", commands], folder, environment())
    assert code == 0, stdout[-3000:]
    assert (folder / "results/my-scene/xnewton/state.pdf").exists()
