"""The plugins: that of `make fast` changes nothing but the time where it can be built, and nothing at all where not;
those of another version of the package stand aside."""

import hashlib
import json
import os
import re
import shutil
import sys

import numpy as np
import pytest
from freefem import FAST, MULTIGRID, ROOT, data, environment, execute, run_in, script, snippet, told, tree

DONE = ["-o", "system", "-o", ".venv/dev.stamp"]
RUNS = [  # elements with half matrices, bodies of two materials, and what the plugin sorts but does not assemble
    ("disc-on-block", "-order", "2", "-h", "2"),
    ("meshed-disc", "-order", "4", "-h", "4", "-Eratio", "3"),
    ("disc-on-block", "-order", "3", "-h", "3", "-geometry", "axisymmetric"),
    ("disc-on-block", "-order", "4", "-h", "4", "-half", "1", "-law", "linear", "-method", "newton"),
    ("sphere-on-block", "-order", "2", "-h", "2", "-patch", "4", "-layers", "1", "-grading", "10"),
]
ROUNDING = 1e-8  # of what is no difference of large numbers


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    package = tree(tmp_path_factory.mktemp("fast") / "package")
    (package / "postprocess").symlink_to(ROOT / "postprocess")
    return package


def make(package, *words, **env):
    return execute(["make", "-s", *DONE, *words], cwd=package, env=environment(**env))


def results(package, out):
    """The summaries of all runs."""
    found = []
    for k, (scene, *flags) in enumerate(RUNS):
        run_in(package, script(scene), *flags, "-vtu", "0", "-estimate", "0", out=out / str(k))
        found.append(json.loads((out / str(k) / "summary.json").read_text()))
    return found


def without(package, tmp_path, *missing):
    """A PATH whose programs are this machine's, but for those that are missing."""
    place = tmp_path / "programs"
    place.mkdir()
    for folder in reversed(os.environ["PATH"].split(os.pathsep)):
        if os.path.isdir(folder):
            for program in os.scandir(folder):
                if program.name not in missing:
                    link = place / program.name
                    link.unlink(missing_ok=True)
                    link.symlink_to(program.path)
    return str(place)


INTERFACES = {
    "fast-plugin-4": "6295d4fb0ec79055702883e3d7e3b6d1",
    "multigrid-plugin-5": "525b881089a64134bb6e4413f842575f",
}


@pytest.mark.parametrize("plugin", [FAST, MULTIGRID], ids=["fast", "multigrid"])
def test_another_interface_another_name(plugin):
    """Other functions shall have another number: an old build would end in a compile error."""
    source = (ROOT / "edp/solver/plugins" / plugin.stem.split("-")[0]).with_suffix(".cpp").read_text()
    functions = re.sub(r"\s+", "", "".join(re.findall(r"Global\.Add\(.*?;", source, re.S)))
    assert INTERFACES.get(plugin.stem) == hashlib.md5(functions.encode()).hexdigest()


def test_an_old_build_stands_aside(package, tmp_path):
    """What another version has built shall not be loaded; what needs it says so in one line, nothing written."""
    build = package / "build"
    build.mkdir()
    for name in ("fast-plugin", "multigrid-plugin", "fast-plugin-0", "multigrid-plugin-0"):
        (build / f"{name}.idp").write_text('load "nowhere"\nmacro multigridBuilt() 1 //\n')
    flags = ["-order", "1", "-h", "3", "-layers", "1"]
    refused = run_in(package, script("sphere-on-block"), *flags, "-solver", "multigrid", out=tmp_path / "no", expect=10)
    assert refused.stdout.count("\n") == 1 and "an older version's; allowed: direct, or `make mpi`" in refused.stdout
    assert not (tmp_path / "no").exists()
    run_in(package, script("sphere-on-block"), *flags, "-vtu", "0", "-estimate", "0", out=tmp_path / "yes")
    shutil.rmtree(build)


def test_no_compiler_no_word(package, tmp_path):
    """`make setup` shall try to build it: without a compiler silently, with one that fails in one line, and go on."""
    path = without(package, tmp_path, "g++", "c++")
    assert make(package, "try-fast", PATH=path, CXX="g++") == (0, "")
    code, stdout = make(package, "try-fast", CXX="false")
    assert code == 0 and len(stdout.splitlines()) == 1, stdout
    assert not list((package / "build").glob("*.idp"))


def hit(places, along, corners):
    """Pairs of a place and a triangle that faces it and that its line, both ways, hits inside by far."""
    first, second, third = corners.transpose(1, 0, 2)
    normal = np.cross(second - first, third - first)
    size = np.linalg.norm(normal, axis=1)
    pairs = set()
    for p, (place, way) in enumerate(zip(places, along, strict=True)):
        facing = -normal @ way
        x = place + (((first - place) * normal).sum(axis=1) / -facing)[:, None] * way
        inside = [
            (np.cross(t - s, x - s) * normal).sum(axis=1) > 0.01 * size**2
            for s, t in ((first, second), (second, third), (third, first))
        ]
        pairs |= {(p, k) for k in np.flatnonzero(np.all(inside, axis=0) & (facing > 0.1 * size))}
    return pairs


def test_same_in_space(tmp_path):
    """Curved elements, searches along rays and distances shall be the same with the plugin and without, and right."""
    bracket = "edp/examples/ball-on-bracket/ball-on-bracket"
    text = (ROOT / "edp/parts-3d.edp").read_text()
    parts = (ROOT / "edp/parts.edp").read_text().split('include "solver/solve.idp"')[0]
    text = text.replace('include "parts.edp"', parts) + data("fast/space.edp")
    sizes = [word for name, size in (("size", 0.8), ("round", 4), ("coarse", 12)) for word in ("-set", name, size)]
    flags = ["-mesh", f"{bracket}.geo", "-case", f"{bracket}.case", *sizes]
    without, by_plugin = tmp_path / "without", tmp_path / "with"
    for folder in (without, by_plugin):
        folder.mkdir()
    if FAST.exists():
        (by_plugin / "build").symlink_to(FAST.parent)
    plain, fast = (told(snippet(folder, text, *flags)) for folder in (without, by_plugin))
    scale = abs(plain["forces"]).max()
    assert abs(fast["forces"] - plain["forces"]).max() < 1e-11 * scale
    for name in ("rays", "squares"):
        assert (fast[name] == plain[name]).all(), name
    found = set(map(tuple, plain["rays"].reshape(-1, 2).astype(int)))
    expected = hit(*(plain[name].reshape(-1, 3) for name in ("places", "along")), plain["corners"].reshape(-1, 3, 3))
    assert len(expected) > 50 and expected <= found
    points = plain["points"].reshape(-1, 3)
    for i, squares in enumerate(plain["squares"].reshape(20, -1)):
        away = np.linalg.norm(points[::3] - points[i], axis=1)
        away[np.arange(0, len(points), 3) % 2 != i % 2] = 1e3 * (away.max() + 5)
        assert squares == pytest.approx(away**2, rel=1e-12)


EXAMPLE = ["edp/parts.edp", "-mesh", "edp/examples/taper/taper.geo", "-case", "edp/examples/taper/taper.case"]


@pytest.fixture(scope="module")
def plugin(tmp_path_factory):
    """The folder of the plugin: this package's, otherwise one that is made here."""
    if FAST.exists():
        return FAST.parent
    if not (shutil.which("ff-c++") and shutil.which("g++")):
        pytest.skip("needs FreeFEM's compiler")
    place = tree(tmp_path_factory.mktemp("plugin") / "package")
    (place / "postprocess").symlink_to(ROOT / "postprocess")
    assert make(place, "fast") == (0, "")
    return place / "build"


@pytest.mark.parametrize(
    "words",
    [["edp/main.edp", "-half", "1", "-order", "4", "-law", "linear", "-method", "newton", "-states", "1"], EXAMPLE],
    ids=["flags", "case"],
)
def test_one_start(words, plugin, tmp_path):
    """What flags and a case need shall be read at once; without the plugin the script starts again for it."""
    programs, log = tmp_path / "programs", tmp_path / "starts"
    programs.mkdir()
    starter = programs / "FreeFem++"
    program = shutil.which("FreeFem++")  # it starts itself by the name that it was called by
    starter.write_text(
        f"#!{sys.executable}\nimport os, sys\nopen({str(log)!r}, 'a').write('start\\n')\n"
        f"os.execv({program!r}, ['FreeFem++', *sys.argv[1:]])\n"
    )
    starter.chmod(0o755)
    found = {}
    for built in (False, True):
        place = tmp_path / str(built)
        place.mkdir()
        for name in ("edp", "meshes", "freefem++.pref", ".venv"):
            (place / name).symlink_to(ROOT / name)
        if built:
            (place / "build").symlink_to(plugin)
        log.unlink(missing_ok=True)
        path = f"{programs}{os.pathsep}{os.environ['PATH']}"
        command = ["FreeFem++", "-nw", "-v", "0", *words, "-unknown", "1"]  # refused once all modules are read
        code, stdout = execute(command, cwd=place, env=environment(PATH=path))
        assert code == 10 and "-unknown" in stdout, stdout
        found[built] = len(log.read_text().splitlines())
    assert found == {False: 2, True: 1}


def test_load_cases_have_their_starter(plugin, tmp_path):
    """Rows and load cases have a starter of their own, which the plugin leaves to do its work."""
    for name in ("edp", "meshes", "freefem++.pref", ".venv"):
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "build").symlink_to(plugin)
    folder = ROOT / "edp/examples/pin-in-hole"
    case = re.sub(r"^weight.*\n", "", (folder / "pin-in-hole.case").read_text(), flags=re.M)
    (tmp_path / "two.case").write_text(case + "load case a\nweight core 0 -1000\nload case b\nweight core 0 -500\n")
    words = ["edp/parts.edp", "-mesh", folder / "pin-in-hole.geo", "-case", tmp_path / "two.case", "-set", "size", 0.8]
    command = ["FreeFem++", "-nw", "-v", "0", *map(str, words), "-estimate", "0", "-out", str(tmp_path / "out")]
    code, stdout = execute(command, cwd=tmp_path, env=environment())
    assert code == 0 and "2 of 2 solved" in stdout
    for name in "ab":
        (tmp_path / f"{name}.csv").write_text("overlap,pressure\n0,0\n0.1,1\n0.2,4\n")
    table = f"table {tmp_path / 'a.csv'} {tmp_path / 'b.csv'}"
    words = ["edp/main.edp", "-law", "table", "-vary", table, "-h", "2", "-out", str(tmp_path / "rows")]
    code, stdout = execute(["FreeFem++", "-nw", "-v", "0", *words], cwd=tmp_path, env=environment())
    assert code == 0 and "2 of 2 solved" in stdout


def test_words_of_the_plugin():
    """Each module that the plugin asks for at the start is one that a script asks for later."""
    source = (ROOT / "edp/solver/plugins/fast.cpp").read_text()
    words = set(re.findall(r'^    \{"-[^}]*"(\w+OnRequest)"', source, re.M))
    scripts = "\n".join(path.read_text() for end in ("idp", "edp") for path in (ROOT / "edp").rglob(f"*.{end}"))
    asked = set(re.findall(r"\w+OnRequest", scripts))
    asked |= {f"{option}OnRequest" for option in re.findall(r"ifRequested\((\w+),", scripts)}
    assert len(words) > 8 and words <= asked


def test_clock_goes_on(plugin, tmp_path):
    """clock() of a script shall tell CPU time, though statements between { } do not ask for it."""
    (tmp_path / "build").symlink_to(plugin)
    text = "real t = clock(); real s = 0; for (int i = 0; i < 200000; i++) { s += 1; s -= 0.5; } t = clock() - t;"
    answer = told(snippet(tmp_path, f'include "input/flags.idp"\n{text}\ntell("t", t);'))
    assert 0.001 < answer["t"][0] < 60


def test_same_numbers(package, tmp_path):
    """With the plugin, where there is a compiler, all shall have the same counts and, but for rounding, results."""
    plain = results(package, tmp_path / "plain")
    assert all(summary["converged"] and '"fast"' not in json.dumps(summary["plugins"]) for summary in plain)
    if shutil.which("ff-c++") and shutil.which("g++"):
        if FAST.exists():  # newer than its source: what `make setup` has compiled is not compiled again
            shutil.copytree(FAST.parent, package / "build", copy_function=shutil.copyfile, dirs_exist_ok=True)
        assert make(package, "fast") == (0, "")
        for before, after in zip(plain, results(package, tmp_path / "fast"), strict=True):
            for count in ("ndof", "points", "contactPoints", "newton", "backsolves", "adaptations", "factorisations"):
                assert before[count] == after[count], count
            for number in ("force", "pressureMax", "halfWidthMoment", "energy"):
                assert after[number] == pytest.approx(before[number], rel=ROUNDING), number
    shutil.rmtree(package / "build", ignore_errors=True)
