"""The Makefile as a user meets it. Nothing is installed here: set-up counts as done (-o)."""

import shutil
import subprocess
import sys

import pytest
from freefem import ROOT, environment, execute, tree

DONE = ["-o", ".venv/run.stamp", "-o", ".venv/dev.stamp", "-o", "system", "-o", "python"]


def make(folder, *words):
    return execute(["make", *DONE, *words], cwd=folder)


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    return tree(tmp_path_factory.mktemp("make") / "package")


def test_make_alone_lists_the_targets():
    """`make` without a target shall list the targets and the scenes, and make nothing."""
    code, stdout = make(ROOT)
    assert code == 0
    for target in ("run", "figures", "test", "lint", "clean"):
        assert f"make {target} " in stdout
    for scene in ("disc-on-block", "meshed-disc", "confined-block"):
        assert scene in stdout


def test_make_run(package, tmp_path):
    """`make run` shall run the scene with the flags that it is given."""
    code, stdout = make(package, "run", "SCENE=confined-block", f"ARGS=-method newton -h 5 -out {tmp_path / 'out'}")
    assert code == 0, stdout
    assert (tmp_path / "out" / "summary.json").exists()


@pytest.mark.parametrize(
    "flags, why", [("-kappa 0", "refused input"), ("-method newton -h 5 -maxNewton 1", "not converged")]
)
def test_make_run_fails(package, flags, why):
    """`make run` shall fail with the run, and say why in words."""
    code, stdout = make(package, "run", "SCENE=confined-block", f"ARGS={flags}")
    assert code != 0
    assert why in stdout


def test_unknown_scene(package):
    """An unknown scene shall be refused in one line that names those there are."""
    code, stdout = make(package, "run", "SCENE=disk-on-block")
    assert code != 0
    (line,) = stdout.splitlines()
    for word in ("disk-on-block", "disc-on-block", "meshed-disc", "confined-block"):
        assert word in line


QUICK = "edp/scenes/confined-block.edp -h 5 -estimate 0"


def test_results_are_targets(package):
    """A result shall be made once, again when a source is newer, and not at all while it is current."""
    target = "results/figures/paper/summary.json"
    shutil.copytree(ROOT / "postprocess", package / "postprocess", ignore=shutil.ignore_patterns("__pycache__"))
    (package / "postprocess" / "figures.toml").write_text(f'[figures.runs]\npaper = "{QUICK}"\n')
    words = f"PYTHON={sys.executable}", target
    code, stdout = make(package, *words)
    assert code == 0, stdout
    made = (package / target).stat().st_mtime_ns
    make(package, *words)
    assert (package / target).stat().st_mtime_ns == made
    (package / "edp/contact/laws" / "power.idp").touch()
    make(package, *words)
    assert (package / target).stat().st_mtime_ns > made


def test_length():
    """The Makefile shall be read in one go: at most 220 lines, none above 130 characters."""
    lines = (ROOT / "Makefile").read_text().splitlines()
    assert len(lines) <= 220 and max(map(len, lines)) <= 130


def test_clean(package):
    """`make clean` shall remove results and generated meshes, nothing else."""
    for name in ("results/x/y.csv", "meshes/generated/z.msh", "edp/mine.edp"):
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).touch()
    code, _ = make(package, "clean")
    assert code == 0
    assert not (package / "results").exists()
    assert not (package / "meshes" / "generated").exists()
    assert (package / "meshes" / "block.geo").exists()
    assert (package / "edp" / "mine.edp").exists()


def test_what_is_begun_outside(tmp_path):
    """What `make new` begins shall stand its own test, which tells a spoilt law; an existing folder is refused."""
    folder = tmp_path / "my own"
    assert execute(["make", "new", f"DIR={folder}"], ROOT)[0] == 0
    code, said = execute(["sh", folder / "test.sh"], tmp_path, environment())
    assert code == 0 and said.count("ok ") == 9 and "OFF" not in said, said
    law = folder / "mylaw.idp"
    law.write_text(law.read_text().replace("p[i] / soft", "p[i] / soft / 3"))
    code, said = execute(["sh", folder / "test.sh"], tmp_path, environment())
    assert code == 1 and "OFF  inverse" in said
    assert execute(["make", "new", f"DIR={folder}"], ROOT)[0] != 0


def test_dollar_in_prefix(tmp_path):
    """make would replace a dollar sign and what follows: refused, nothing is installed."""
    done = subprocess.run(["make", "install", f"PREFIX={tmp_path}/a$b"], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode and "dollar sign" in done.stdout and not list(tmp_path.iterdir())
