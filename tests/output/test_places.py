"""Where the package and what it makes may be: read-only checkouts, caches, an installed package, Python's packages."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from freefem import FREEFEM, ROOT, environment, execute, listing, patience, plotted, run_in, script, tree

BLOCK, DISC = script("confined-block"), script("disc-on-block")
QUICK = ["-h", 2, "-order", 1, "-vtu", 0, "-estimate", 0]
CACHES = ("CONTACT_CACHE", "XDG_CACHE_HOME", "TMPDIR", "CONTACT_RESULTS")
BARE = {name: value for name, value in environment().items() if name not in (*CACHES, "LD_PRELOAD")}  # of any user


@pytest.fixture(scope="module")
def places():
    """(a checkout that its user cannot write, a folder that he can, how he starts a command)."""
    top = Path(tempfile.mkdtemp(prefix="places-", dir="/tmp"))  # pytest's own folders are closed to other users
    package, home = tree(top / "package"), top / "home"
    (package / "tests").mkdir()
    shutil.copytree(ROOT / "postprocess", package / "postprocess", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "requirements.txt", package)
    home.mkdir()
    top.chmod(0o755)
    execute(["chmod", "-R", "a-w,a+rX", package])
    user = {}
    if os.geteuid() == 0:  # whom no permission stops
        user = {"user": 65534, "group": 65534, "extra_groups": []}
        os.chown(home, 65534, 65534)

    def by_user(*command, **env):
        done = subprocess.run(
            list(map(str, command)),
            cwd=package,
            env={**BARE, "HOME": str(home), **env},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=patience(100),
            **user,
        )
        return done.returncode, done.stdout + done.stderr

    yield package, home, by_user
    execute(["chmod", "-R", "u+w", top])
    shutil.rmtree(top)


def test_read_only_checkout(places):
    """A checkout that cannot be written shall run and stay as it is, its meshes in the user's cache, with -out."""
    package, home, by_user = places
    before = listing(package)
    code, said = by_user(*FREEFEM, DISC, *QUICK, "-out", home / "out")
    assert code == 0, said
    (mesh,) = (home / ".cache/stiff-contact/meshes").glob("*.msh")
    assert (home / "out" / "summary.json").exists() and mesh.name.startswith("block")
    code, said = by_user(*FREEFEM, BLOCK, *QUICK)
    assert code == 10 and "results/confined-block/xnewton: not writable" in said
    code, said = by_user(*FREEFEM, BLOCK, *QUICK, CONTACT_RESULTS=str(home / "res"))
    assert code == 0 and (home / "res/confined-block/xnewton/summary.json").exists(), said
    assert listing(package) == before


def test_make_in_a_read_only_checkout(places):
    """make run and make figures shall put results where RESULTS says, and what they install into the cache."""
    package, home, by_user = places
    before, done = listing(package), ["-o", "system", "-o", "python"]
    code, said = by_user("make", *done, "run", "SCENE=confined-block", "ARGS=-h 5 -estimate 0", f"RESULTS={home}/r")
    assert code == 0 and (home / "r/confined-block/xnewton/summary.json").exists(), said
    python = home / ".cache/stiff-contact/venv/bin/python"
    assert plotted(said) == f"{python} -m postprocess state {home}/r/confined-block/xnewton/"
    done += ["-o", f"{python.parents[1]}/run.stamp", f"RESULTS={home}/f"]
    code, said = by_user("make", "-n", *done, "figures")
    assert code == 0 and f"{python} -m postprocess make" in said and f"--out {home}/f figures" in said
    assert listing(package) == before


def test_order_of_caches(places):
    """CONTACT_CACHE first, then the checkout; where that is closed the user's caches, at last the temporary folder."""
    package, home, by_user = places

    def cache(root, **env):
        return by_user("sh", package / "edp/input/cache.sh", 0, root, **env)

    (home / "meshes").mkdir()
    (home / "meshes").chmod(0o777)
    assert cache(home) == (0, "")
    a, b, c = (str(home / name) for name in "abc")
    assert cache(home, CONTACT_CACHE=a, XDG_CACHE_HOME=b) == (1, f"{a}\n")
    assert cache(package, XDG_CACHE_HOME=b, TMPDIR=c) == (2, f"{b}/stiff-contact\n")
    assert cache(package, TMPDIR=c) == (3, f"{home}/.cache/stiff-contact\n")
    assert cache(package, HOME="/nonexistent", TMPDIR=c) == (4, f"{c}/stiff-contact\n")
    assert cache(package, XDG_CACHE_HOME="/nonexistent", HOME="", TMPDIR=c) == (4, f"{c}/stiff-contact\n")


def test_temporary_folder(tmp_path):
    """The checked copy of a user's mesh shall be made where TMPDIR says."""
    env = {**BARE, "TMPDIR": str(tmp_path / "none")}
    punch = "edp/examples/punch/punch"
    words = ["-mesh", f"{punch}.geo", "-case", f"{punch}.case", "-out", tmp_path / "out"]
    said = run_in(ROOT, "edp/parts.edp", *words, env=env, expect=10).stdout
    assert f"cannot be checked: {tmp_path}/none cannot be written" in said


LINE = 'Line(1) = {1, 2};\nPhysical Line("line") = {1};\n'


def test_cache_of_two_packages(tmp_path):
    """In a shared cache a mesh of another copy's geometry shall be made anew, one of the same not."""
    mesh = tmp_path / "meshes" / "singular.msh"
    env = {**BARE, "CONTACT_CACHE": str(tmp_path)}
    made = []
    for name, text in (("a", "// one\n"), ("b", "// one\n"), ("c", "// two\n")):
        package = tree(tmp_path / name)
        geo = package / "meshes" / "singular.geo"
        geo.write_text(f"{text}Point(1) = {{0, 0, 0}};\nPoint(2) = {{1, 0, 0}};\n{LINE}")
        for path in geo.parent.glob("*.geo"):
            os.utime(path, (0, 0))  # older than the mesh
        execute(["sh", package / "edp/input/cache.sh", 0, package], env=env)
        words = [
            "sh",
            package / "edp/input/make-mesh.sh",
            os.getpid(),
            mesh,
            geo,
            "",
            "-1",
            "-v",
            1,
            "-format",
            "msh22",
        ]
        code, said = execute(words, env=env)
        assert code == 0, said
        made.append(mesh.stat().st_mtime_ns)
    assert made[0] == made[1] < made[2]


def test_what_a_run_is_made_of(tmp_path):
    """A checksum shall change with every file that is read, also by another file, and with a package that is a link."""
    package = tree(tmp_path / "package")
    here = tmp_path / "here"
    here.mkdir()
    for name in ("edp", "meshes"):
        (here / name).symlink_to(package / name)
    texts = {
        "part.geo": 'Include "below/b.geo"; // 5" pipe\nField[1].FileName = "grid.dat"; // merge of both\n',
        "below/b.geo": 'Include "../part.geo";\nMerge StrCat(A, "s.step");\nPhysical Line("include") = {1};\n',
        "part.case": 'obstacle x plane 0 0 0 1 law table "my law.csv" d0 -1\ncontact a b law table law.csv d0 -1\r\n',
        "own.edp": 'include "input/flags.idp"\n include "law.idp"\n',
        **dict.fromkeys(["grid.dat", "below/s.step", "part.geo.opt", "my law.csv", "law.csv", "law.idp"], "1\n"),
    }
    (here / "below").mkdir()
    for name, text in texts.items():
        (here / name).write_text(text)

    def identity():
        words = ["sh", "edp/output/report/run-checksum.sh", 0, "", "part.geo", "part.case", "own.edp"]
        code, said = execute(words, here, BARE)
        assert code == 0 and said.count("\n") == 1, said
        return said

    found = [identity()]
    assert identity() == found[0]
    for name in [*texts, "edp/input/cost-counters.idp", "edp/VERSION", "meshes/block.geo"]:
        with (here / name).open("a") as file:
            file.write("\n")
        found.append(identity())
    assert len(set(found)) == len(found)
    for unknown in ('Merge Sprintf("p%g.step", n);\n', 'SystemCall "make s.step";\n'):
        (here / "below/b.geo").write_text(unknown)
        assert "unknown" in identity()


@pytest.mark.parametrize("drawn", [False, True])
def test_installed(tmp_path, drawn):
    """make install shall put a starter in place that runs and draws from any folder; make uninstall takes all away."""
    prefix, stage, here = tmp_path / "a prefix", tmp_path / "stage", tmp_path / "here"
    here.mkdir()
    assert execute(["make", "install", f"PREFIX={prefix}", f"DESTDIR={stage}"], env=BARE)[0] == 0
    assert not prefix.exists()
    (stage / str(prefix)[1:]).rename(prefix)
    before = listing(prefix)
    env = {**BARE, "PATH": f"{Path(sys.executable).parent}:{BARE['PATH']}", "HOME": str(tmp_path)}
    starter = prefix / "bin" / "stiff-contact"
    code, said = execute([starter, "disc-on-block", "-h", 2, "-order", 1, "-estimate", 0], here, env)
    assert code == 0 and (here / "results/disc-on-block/xnewton/summary.json").exists(), said
    assert list((tmp_path / ".cache/stiff-contact/meshes").glob("block*.msh"))
    command = plotted(said)
    assert command == f"'{starter}' postprocess state results/disc-on-block/xnewton/"
    if drawn:
        code, said = execute(["sh", "-c", command], here, env)
        assert code == 0 and (here / "results/disc-on-block/xnewton/state.png").exists(), said
    assert [path for path in listing(prefix) if "__pycache__" not in path] == before
    assert execute(["make", "uninstall", f"PREFIX={prefix}"], env=BARE)[0] == 0
    assert listing(prefix) == ["bin", "share"]


FIGURES = ["tests/python/test_postprocess.py", "tests/python/test_pictures.py", "tests/scenes/test_hertz_figures.py"]


@pytest.mark.skipif(sys.version_info >= (3, 12), reason="numpy 1.24 is for Python up to 3.11")
def test_oldest_numpy_and_matplotlib(tmp_path):
    """Every figure shall be drawn by the oldest versions within the bounds, Debian 12's."""
    assert execute([sys.executable, "-m", "venv", tmp_path])[0] == 0
    python = tmp_path / "bin" / "python"
    wanted = ["numpy==1.24.*", "matplotlib==3.6.*", "pytest>=8,<10", "pytest-xdist>=3.6,<4"]
    code, said = execute([python, "-m", "pip", "install", "-q", *wanted], env={**BARE, "PIP_FIND_LINKS": ""})
    if code:
        pytest.skip(f"no package index: {said[-200:]}")
    for tests in FIGURES:
        words = [python, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-W", "ignore", "-n", 2, tests]
        code, said = execute(words, env=BARE)
        assert code == 0, said[-3000:]


@pytest.mark.parametrize("version, code", [("1.24.2", 0), ("1.23.5", 1), ("2.4.0", 0), ("3.0.0", 1), (None, 1)])
def test_python_of_the_system(tmp_path, version, code):
    """A Python's own packages shall be taken where their versions are within the bounds."""
    for name, number in (("numpy", version), ("matplotlib", "3.6.3")):
        if number:
            folder = tmp_path / f"{name}-{number}.dist-info"
            folder.mkdir()
            (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {number}\n")
    base = Path(sys.base_prefix) / "bin" / "python3"
    env = {**BARE, "PYTHONPATH": str(tmp_path)}
    assert execute([base, "-S", "postprocess/doctor.py", "--can", "own"], env=env)[0] == code
    assert execute([base, "-S", "postprocess/doctor.py", "--can", "none"], env=env)[0] == 1


def test_cleaning_leaves_what_is_not_ours(tmp_path):
    """A cache with a blank in its name shall be refused, a folder `meshes` that was there before shall stay."""
    package = tree(tmp_path / "package")
    cache = tmp_path / "My cache"
    code, said = execute(["make", "distclean"], package, environment(CONTACT_CACHE=str(cache)))
    assert code == 2 and "blank in its name; allowed: CONTACT_CACHE=" in said
    (tmp_path / "home/meshes").mkdir(parents=True)
    (tmp_path / "home/venv").mkdir()
    code, _ = execute(["make", "distclean"], package, environment(CONTACT_CACHE=str(tmp_path / "home")))
    assert code == 0 and listing(tmp_path / "home") == ["meshes", "venv"]
