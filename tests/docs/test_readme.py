"""The pages against the package: flags, files, commands, links, examples, counts, the paper in the code."""

import html
import json
import os
import re
import shlex
import shutil
import subprocess

import numpy as np
import pages
import pytest
from freefem import FREEFEM, MULTIGRID, ROOT, TIMEOUT, cases_of, environment, execute, run, run_in, scenes, script, tree
from output.test_paraview import Grid
from solver.test_acceptance import FORCE, HALF_WIDTH, PRESSURE_MAX

from postprocess import recipes
from postprocess.commands import paper


def in_markdown(folder):
    """The package's pages."""
    return [*folder.glob("*.md"), *(path for name in ("edp", "tests") for path in (folder / name).rglob("*.md"))]


README = re.sub("<!-- .*? -->\n|<!--= .*? -->", "", (ROOT / "README.md").read_text())  # as it is read
# the reference, the how-to pages and WRITING.md; section() finds a heading in the first that has it
MANUAL = "\n".join(
    path.read_text()
    for path in (
        *sorted(ROOT.glob("edp/docs/reference/*.md")),
        *sorted(ROOT.glob("edp/docs/howto/*.md")),
        ROOT / "edp/docs/WRITING.md",
    )
)
SCENE_TABLE, METHOD_TABLE, CHOOSING = (
    re.sub("<!-- .*? -->\n", "", (ROOT / "edp/docs" / f"{name}.md").read_text())
    for name in ("reference/scenes", "reference/methods", "CHOOSING")
)
RESULTS = "\n".join((ROOT / "tests" / f"{name}.md").read_text() for name in ("RESULTS", "COST"))
PAPER = (ROOT / "edp/docs/PAPER.md").read_text()
PAGES = sorted(str(path.relative_to(ROOT)) for path in in_markdown(ROOT))
DONE = ["-o", ".venv/run.stamp", "-o", ".venv/dev.stamp", "-o", "system", "-o", "python"]  # set-up counts as done
# what stands for a table's values in the commands
VALUES = {"H": 2, "T0": 0, "TOL": 1e-6, "ORDER": 1, "METHOD": "paper", "KAPPA": 1e6, "M": 2, "RATIO": 1e3}
LAW, METHOD = "rounded", "damped"  # the law and the method that WRITING.md adds
INGREDIENTS = "The ingredients of `xnewton`"


def section(text, title):
    """The text below a heading, down to the next one of the same or a higher level."""
    (level, start), *_ = [(len(m[1]), m.end()) for m in re.finditer(rf"^(#+) {re.escape(title)}$", text, re.M)]
    end = re.search(rf"^#{{1,{level}}} ", text[start:], re.M)
    return text[start:][: end.start() if end else None]


def rows(text):
    """The rows of the tables in the text as lists of cells, without heads and rules."""
    lines = [line for line in text.splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]
    return [row for row, after in zip(cells, [*cells[1:], []], strict=True) if not (is_rule(row) or is_rule(after))]


def is_rule(row):
    return bool(row) and all(re.fullmatch(r":?-+:?", cell) for cell in row)


def quoted(text):
    """What stands in backticks, fenced blocks left out."""
    return re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S))


def fences(text, kind):
    """The fenced blocks of a kind."""
    return re.findall(rf"^```{kind}\n(.*?)^```", text, re.M | re.S)


SCENES = [quoted(name)[0] for name, *_ in rows(SCENE_TABLE)]

# ---------------------------------------------------------------- scenes and flags


FLAGS = {quoted(row[0])[0]: row for row in rows(section(MANUAL, "Flags")) if len(row) == 6}


def default_for(method, flag):
    """The default of a flag that a method has, of a cell such as "auto; `-method paper`: 0"."""
    own = re.search(rf"`-method {method}`: ([^;)]+)", FLAGS[flag][1])
    return own[1].strip() if own else re.split(r"[;(]", FLAGS[flag][1])[0].strip()


def test_every_scene_is_documented():
    """The table of scenes shall name every scene with its script, and no other."""
    assert sorted(SCENES) == scenes()
    for name, path, _ in rows(SCENE_TABLE):
        assert quoted(path) == [script(quoted(name)[0])]


def test_tables_from_the_programs():
    """Tables that are made from heads, -help and runs shall be up to date, and every key of theirs have its meaning."""
    assert not pages.stale(), "make pages"
    meanings = [row[2] for name in ("summary", "statements") for row in pages.of_table(name)]
    meanings += [row[1] for row in pages.of_table("columns")]
    assert all(meanings) and len(meanings) > 40


def test_flags():
    """Flags that the pages name shall exist, and methods and laws that they list be those that -help offers."""
    mentioned = {word for word in re.findall(r"`(-[A-Za-z]\w+)", README + MANUAL + RESULTS)}
    assert mentioned <= FLAGS.keys() | {"-help", "-nw", "-kapa", "-spring", "-soft", "-damping"}
    methods, laws = (re.search(r"one of: ([\w -]+)", FLAGS[flag][4])[1] for flag in ("-method", "-law"))
    (more,) = [row for row in rows(section(MANUAL, "Flags of single scenes")) if row[0] == "`-law`"]
    assert sorted([*methods.split(), "ipopt"]) == sorted(METHODS)
    listed = [quoted(name)[0] for name, *_ in rows(section(MANUAL, "Laws"))]
    assert [sorted(laws.split())] == [sorted(set(listed) - {"lennard-jones"})]
    assert sorted(more[4].removeprefix("one of: ").split()) == sorted(listed) and more[1] == "*attracting*"


METHODS = [quoted(name)[0] for name, *_ in rows(METHOD_TABLE)]


def owners():
    """{flag: methods that have it} of the flags that are some methods' own."""
    named = {flag: re.search(r"`-method ([\w, ]+)`", row[5]) for flag, row in FLAGS.items()}
    return {flag: set(found[1].split(", ")) for flag, found in named.items() if found}


REFUSED = {str(sorted(methods)): flag for flag, methods in owners().items()}.values()  # a flag of each set of methods


@pytest.mark.parametrize("method", METHODS)
def test_flags_of_a_method(method, tmp_path):
    """A run shall have the flags of its method, with the defaults of the page; a method without a flag refuses it."""
    scene = "disc-on-block-ipopt" if method == "ipopt" else "disc-on-block"
    listed = {quoted(row[0])[0].split(",")[0] for row in rows(section(MANUAL, INGREDIENTS))}
    assert owners().keys() == listed | {"-model"}
    used = run(scene, "-method", method, "-h", 2).parameters
    assert {flag for flag in owners() if flag[1:] in used} == {flag for flag in owners() if method in owners()[flag]}
    for flag, methods in owners().items():
        if method in methods:
            assert str(used[flag[1:]]) == default_for(method, flag)
        elif method == next(name for name in METHODS if name not in methods) and flag in REFUSED:
            words = ["-method", method, flag, default_for("", flag)]
            stdout = run_in(ROOT, script(scene), *words, out=tmp_path / "out", expect=10).stdout
            said = re.fullmatch(rf"{flag}: not a flag of this method; allowed: only with -method ([\w ]+)\n", stdout)
            assert said and set(said[1].split()) == methods


# ---------------------------------------------------------------- files


@pytest.fixture(scope="module")
def paper_run(tmp_path_factory):
    """A run that writes every file."""
    out = tmp_path_factory.mktemp("readme") / "paper"
    cells = [row[0] for row in rows(section(MANUAL, "Files of a run")) if ".csv" in row[0]]
    switches = {tuple(name.split()) for cell in cells for name in quoted(cell) if name.startswith("-")}
    flags = [word for switch in sorted(switches) for word in switch]
    return run_in(ROOT, script("meshed-disc"), "-method", "paper", "-h", 2, "-steps", 2, *flags, out=out)


def test_paraview(paper_run):
    """The files for ParaView shall be those of the README, with its fields and no other."""
    table = rows(section(MANUAL, "ParaView").split("\n## ")[0])  # below it: what other commands write
    names = [quoted(row[0])[0] for row in table]
    of_paraview = {path.name for path in paper_run.folder.iterdir() if path.suffix in (".vtu", ".pvd")}
    assert {name for name in of_paraview if not name.startswith("state-")} == set(names)
    for name, (_, _, at_points, in_cells) in zip(names, table, strict=True):
        grid = Grid(paper_run.folder / ("state-1.vtu" if name == "states.pvd" else name))
        assert grid.at_points.keys() == set(quoted(at_points)), name
        assert grid.in_cells.keys() == set(quoted(in_cells)), name


def test_exit_codes(tmp_path):
    """The exit codes shall be those of the README."""
    codes = [int(row[0]) for row in rows(section(MANUAL, "Files of a run")) if row[0].isdigit()]
    assert codes == [0, 10, 20, 21, 30, 130]
    run_in(ROOT, script("confined-block"), "-h", 5, out=tmp_path / "a", expect=0)
    run_in(ROOT, script("confined-block"), "-kapa", 5, out=tmp_path / "b", expect=10)
    run_in(ROOT, script("confined-block"), "-method", "newton", "-maxNewton", 1, "-h", 5, out=tmp_path / "c", expect=20)
    assert '"message": "Newton' in (tmp_path / "c" / "summary.json").read_text()


# ---------------------------------------------------------------- commands


def commands():
    """The lines of the pages' and the results' sh blocks; the README's: test_doors."""
    lines = [line for block in fences(MANUAL + RESULTS, "sh") for line in block.splitlines()]
    return [line for line in lines if line and not line.startswith("#")]


FREEFEM_COMMANDS = list(  # test_commands.py runs those on a case file that a line before them makes
    dict.fromkeys(line for line in commands() if line.startswith("FreeFem++") and "-case results/" not in line)
)
MAKE_COMMANDS = sorted({line for line in [*commands(), *quoted(README + MANUAL + RESULTS)] if line.startswith("make ")})


@pytest.mark.parametrize("line", FREEFEM_COMMANDS)
def test_freefem_commands(line, tmp_path):
    """FreeFEM's commands shall run, on a coarse mesh and with a value for each placeholder."""
    words = [str(VALUES.get(word, word)) for word in shlex.split(line)]
    assert "-nw" not in words and "-v" not in words  # no flag is needed
    if "multigrid" in words and not MULTIGRID.exists():
        pytest.skip("the plugin is not built: make mpi")
    if "-h" in words:
        words[words.index("-h") + 1] = "2"
    words += ["-h", "2"] if "multigrid" in words else ["-h", "0.2"] if "-legs" in words else []
    words += ["-set", "size", "1" if "clip.case" in line else "0.4"] if "-case" in words else []
    if "bodies.msh" in words:
        (made,) = [shlex.split(line) for line in commands() if line.startswith("gmsh")]
        assert execute([word if word != "bodies.msh" else tmp_path / word for word in made], ROOT)[0] == 0
        words[words.index("bodies.msh")] = str(tmp_path / "bodies.msh")
    if "-rows" in words:
        at = words.index("-rows") + 1
        (made,) = [shlex.split(line) for line in commands() if line.startswith("printf") and line.endswith(words[at])]
        words[at] = str(tmp_path / "rows.csv")
        (tmp_path / "rows.csv").write_text(execute(made[:2], ROOT)[1])
    if "-out" in words:
        at = words.index("-out")
        del words[at : at + 2]
    code, stdout = execute([*words, *([] if "-help" in words else ["-out", tmp_path / "out"])], ROOT)
    assert code == 0, stdout


def test_make_commands():
    """Every target of make that the README names shall exist, and make know how to bring it up to date."""
    assert len(MAKE_COMMANDS) > 5
    typed = [shlex.split(line)[1:] for line in MAKE_COMMANDS if "SCENE=name" not in line]
    plain = [words[0] for words in typed if len(words) == 1]
    for words in (plain, *(words for words in typed if len(words) > 1)):
        code, stdout = execute(["make", "-n", *DONE, *words], ROOT)
        assert code == 0, f"{words}: {stdout}"


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """A copy of the package with its drawing commands and the set-up's Python."""
    folder = tree(tmp_path_factory.mktemp("readme-make") / "package")
    for name in ("postprocess", ".venv"):
        (folder / name).symlink_to(ROOT / name)
    shutil.copytree(ROOT / "tests", folder / "tests")  # a campaign's results lie beside its own script
    case = folder / "edp/examples/wheel-on-rail/wheel-on-rail.case"
    text = case.read_text()
    assert text in README and len(text.splitlines()) <= 12
    case.write_text(text.replace("size    contact 1.25", "size    contact 10"))
    if MULTIGRID.exists():  # newer than its sources
        shutil.copytree(MULTIGRID.parent, folder / "build", copy_function=shutil.copyfile)
    return folder


def make(folder, *words, timeout=TIMEOUT):
    done = subprocess.run(
        ["make", *DONE, *words], cwd=folder, env=environment(), capture_output=True, text=True, timeout=timeout
    )
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize(
    "line",
    [line for line in commands() if line.startswith("make run")],
)
def test_make_run_commands(line, package):
    """The runs by make on the pages shall end with results in the scene's folder; on a coarse mesh."""
    words = shlex.split(line.replace("-h 0.1", "-h 0.5"))[1:]
    if "NP=" in line and not MULTIGRID.exists():
        pytest.skip("the plugin is not built: make mpi")
    code, stdout = make(package, *words, *([] if "ARGS" in line else ["ARGS=-h 2 -order 1 -estimate 0"]))
    assert code == 0, stdout
    scene = re.search(r"SCENE=([\w-]+)", line)
    assert (package / "results" / (scene[1] if scene else "disc-on-block") / "xnewton" / "summary.json").exists()


def test_make_builds_the_plugin(tmp_path):
    """A run on two processes shall first build the plugin that it needs, one on one process shall not."""
    folder = tree(tmp_path / "package")
    (folder / "postprocess").symlink_to(ROOT / "postprocess")
    code, stdout = make(folder, "-n", "-o", "petsc", "run", "SCENE=sphere-on-block", "NP=2", "ARGS=-h 2")
    built, ran = stdout.find("setup.sh multigrid "), stdout.find("mpiexec -n 2 ")
    assert code == 0 and 0 < built < ran, stdout
    code, stdout = make(folder, "-n", "run", "SCENE=sphere-on-block")
    assert code == 0 and "setup.sh multigrid " not in stdout and "FreeFem++" in stdout, stdout


DOORS = dict(zip(("first", "teach", "paper", "parts"), fences(README, "sh"), strict=True))


@pytest.mark.parametrize("door", cases_of(["first", "teach", "parts"], DOORS))
def test_doors(door, package):
    """The README's commands shall run as they are written, one after the other."""
    said = ""
    for line in DOORS[door].splitlines():
        words = shlex.split(line)
        if words == ["make", "setup"]:  # it is what the other targets do first
            continue
        words[:1] = ["make", *DONE] if words[0] == "make" else words[:1]
        code, stdout = execute(words, package, environment())
        assert code == 0, f"{line}: {stdout[-2000:]}"
        said += stdout
    drawn = {"first": "meshed-disc/xnewton/stress", "parts": "parts-3d/wheel-on-rail/state"}
    if door in drawn:
        for kind in ("pdf", "png"):
            assert (package / "results" / f"{drawn[door]}.{kind}").exists()
    else:
        assert "12 iterations, 3 models" in said or "adaptations 3, Newton steps 12" in said
    if door == "paper":
        for name in ("figure1", "figure2"):
            assert (package / f"results/figures/{name}.pdf").exists()
        claims = (package / "results/paper/claims.html").read_text()
        verdicts = re.findall(r'<span class="(\w+)">', claims)
        assert len(verdicts) == 7 and verdicts.count("fail") == 1  # plain Newton does not fail on the paper's test
        counted = dict(re.findall(r'<th scope="row">(1e-\d+)</th>\s*<td[^>]*>(\d+ / \d+)</td>', claims))
        assert [counted[tol] for tol in ("1e-2", "1e-12")] == [
            "2 / 10",
            "3 / 15",
        ]  # 1e-2: that of -eps, which comes last
        assert re.search(r"Newton steps, 9\s+to\s+15\s+here", claims)
        steps = {row[0].strip("`"): row[1:] for row in rows(section(CHOOSING, "Method"))}
        soft, stiff = ([steps[f"-method {words}"][k] for words in ("newton", "paper", "paper -T0 d0")] for k in (0, 1))
        for name, count in zip(("newton", "stiff-newton", "stiff", "stiff-d0"), (soft[0], *stiff), strict=True):
            assert json.loads((package / f"results/paper/{name}/summary.json").read_text())["newton"] == int(count)


def test_make_figures():
    """`make figures` shall make every figure of the page, by runs whose flags their scripts know."""
    made = recipes.read_recipes("figures")
    assert set(made.figures) == {quoted(row[0])[0] for row in rows(section(MANUAL, "Figures")) if "results/" in row[-1]}
    asked = {}
    for name, *flags in made.runs.values():
        asked.setdefault(name, set()).update(word for word in flags if re.fullmatch(r"-[A-Za-z]\w*", word))
    assert len(asked) > 8
    for name, flags in asked.items():
        known = re.findall(r"^(-\w+) ", execute([*FREEFEM, name, "-help", "all"], ROOT)[1], re.M)
        assert flags <= set(known), name


# ---------------------------------------------------------------- examples


def test_scene_example(tmp_path):
    """The scene that the README walks through shall be the one in edp/scenes/, its bodies' lines one's; a copy runs."""
    example, bodies = fences(section(MANUAL, "Writing a scene"), "freefem")
    assert example == (ROOT / "edp/scenes/flat-punch.edp").read_text()
    missing = set(bodies.splitlines()) - set((ROOT / "edp/scenes/confined-block.edp").read_text().splitlines())
    assert not missing
    package = tree(tmp_path / "package")
    copy = example.replace('scene = "flat-punch"', 'scene = "copy"')
    copy = copy.replace("(ax, ay, az) gap", "(ax, ay, az) (gap + 0.01 * ax^2)")
    (package / "edp/scenes/copy.edp").write_text(copy)
    contact = run_in(package, "edp/scenes/copy.edp", "-h", 2, "-u0", 0.1, "-vtu", 0, out=tmp_path / "out").contact
    np.testing.assert_allclose(contact["overlap"], 0.1 - 0.5 - 0.01 * contact["x"] ** 2, atol=1e-12)


def added(package, path, text, listing, name):
    """Adds a file to the package, and to its list what the README says: the list must differ from it in that alone."""
    (package / "edp" / path.replace("NAME", name)).write_text(text)
    path = package / "edp" / path.replace("NAME", "all")
    kept = "".join(line for line in listing.splitlines(keepends=True) if f"/{name}.idp" not in line)
    kept = kept.replace(f" do({name})", "")
    assert path.read_text().count(kept) == 1 and len(listing.splitlines()) == len(kept.splitlines()) + 1
    path.write_text(path.read_text().replace(kept, listing))


def soft_layer(package, out, *flags):
    """The confined block with the README's law against its exact state; the run."""
    width, depth, spring, soft, d0, approach, modulus, nu = 20, 20, 500, 0.2, -0.25, 2.5 - 0.5, 100, 0.3
    confined = modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / depth
    low, high = 0.0, approach - d0  # of the layer's overlap: what remains compresses the block
    for _ in range(100):
        s = 0.5 * (low + high)
        excess = spring * (np.hypot(s, soft) - soft) - confined * (approach - d0 - s)
        low, high = (low, s) if excess > 0 else (s, high)
    pressure = confined * (approach - d0 - s)
    s = np.linspace(0, s, 20001)
    energy = width * (pressure**2 / (2 * confined) + np.trapezoid(spring * (np.hypot(s, soft) - soft), s))
    flags = ["-law", LAW, "-spring", spring, "-soft", soft, *flags, "-h", 4, "-tol", 1e-11, "-vtu", 0]
    result = run_in(package, script("confined-block"), *flags, out=out)
    assert abs(result.force / (width * pressure) - 1) < 1e-9
    assert abs(result.energy / energy - 1) < 1e-9
    return result


@pytest.fixture(scope="module")
def grown(tmp_path_factory):
    """A copy of the package with the law and the method that the README adds."""
    folder = tree(tmp_path_factory.mktemp("readme-added") / "package")
    added(folder, "contact/laws/NAME.idp", *fences(section(MANUAL, "Adding a law"), "freefem"), LAW)
    added(folder, "solver/methods/NAME.idp", *fences(section(MANUAL, "Adding a method"), "freefem"), METHOD)
    return folder


@pytest.mark.parametrize("method", ["xnewton", "paper", "newton"])
def test_law_example(grown, tmp_path, method):
    """The law that the README adds shall work: the exact state of the confined block, by every method that it has."""
    soft_layer(grown, tmp_path / "out", "-method", method)


def test_method_example(grown, tmp_path):
    """The method that the README adds shall work, its flag be its own; each step leaves 1 - damping of the error."""
    result = soft_layer(grown, tmp_path / "out", "-method", METHOD, "-damping", 0.9)
    assert result.parameters["damping"] == 0.9
    ratio = result.history["residual"][5:-1] / result.history["residual"][4:-2]
    np.testing.assert_allclose(ratio, 0.1, rtol=0.01)
    words = ["-method", "newton", "-damping", 0.9]
    stdout = run_in(grown, script("confined-block"), *words, out=tmp_path / "newton", expect=10).stdout
    assert f"only with -method {METHOD}" in stdout


def test_option_example(tmp_path):
    """The option that WRITING.md adds shall work where it is read, and be refused elsewhere, naming the scene."""
    package = tree(tmp_path / "package")
    option, offer = fences(section(MANUAL, "Adding an option"), "freefem")
    (package / "edp/output/centre").mkdir()
    (package / "edp/output/centre/centre.idp").write_text(option)
    listed = package / "edp/input/hooks.idp"
    listed.write_text(listed.read_text().replace('requireOption("meshes"', offer + 'requireOption("meshes"'))
    punch = package / "edp/scenes/flat-punch.edp"
    punch.write_text(punch.read_text().replace("do(pictures, what)", "do(pictures, what) do(centre, what)"))
    result = run_in(package, script("flat-punch"), "-h", 2, "-vtu", 0, out=tmp_path / "out")
    force = result.contact["weight"] * result.contact["pressure"]
    assert result.summary["centre"] == pytest.approx(force @ result.contact["x"] / force.sum(), abs=1e-9)
    assert "  the force acts at x = " in result.stdout
    refused = run_in(package, script("wavy"), "-centre", 0, out=tmp_path / "wavy", expect=10).stdout
    assert refused == "-centre 0: not read by this scene; allowed in: flat-punch\n"


def test_version(paper_run):
    """The package's version, in one file, shall be the citation's and the changelog's newest; runs shall say it."""
    version = (ROOT / "edp/VERSION").read_text().strip()
    assert re.fullmatch(r"\d+\.\d+\.\d+", version)
    headings = re.findall(r"^## \[(.*?)\](.*)$", (ROOT / "CHANGELOG.md").read_text(), re.M)
    assert next(name for name, _ in headings if name != "Unreleased") == version
    for name, rest in headings:
        assert name == "Unreleased" or re.fullmatch(r" - (unreleased|\d{4}-\d\d-\d\d)", rest)
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text()
    assert paper_run.summary["package"] == version


def test_made_by(paper_run, tmp_path):
    """A run shall say its FreeFEM as the system's package has it, its gmsh if that made the mesh, and the date."""
    asked = execute(["dpkg-query", "-W", "-f", "${Version}", "freefem++"]) if shutil.which("dpkg-query") else (1, "")
    if asked[0] == 0 and os.path.samefile(shutil.which("FreeFem++"), "/usr/bin/FreeFem++"):
        assert paper_run.summary["freefem"] == asked[1]
    assert paper_run.summary["gmsh"] == execute(["gmsh", "-version"])[1].split()[-1]
    day = {**environment(), "SOURCE_DATE_EPOCH": "86400"}
    summary = run_in(ROOT, script("confined-block"), "-h", 5, out=tmp_path / "out", env=day).summary
    assert summary["gmsh"] is None and summary["date"] == "1970-01-02T00:00:00Z"


# ---------------------------------------------------------------- numbers


def test_reference_values():
    """The README's reference values shall be those that the tests compare with."""
    values = re.findall(r"(?:force|pressure|half-width) (\d+\.\d{5,})", section(RESULTS, "Accuracy"))
    assert tuple(map(float, values)) == (FORCE, PRESSURE_MAX, HALF_WIDTH)


# ---------------------------------------------------------------- theory


def test_from_the_paper_to_the_code():
    """Each text of the table shall stand in the file that it names; no equation and no line shall be missing."""
    table = rows(section(PAPER, "From the paper to the code"))
    for what, file, text in table:
        assert quoted(text)[0] in (ROOT / "edp" / quoted(file)[0]).read_text(), what
    names = " ".join(row[0] for row in table)
    assert {*map(str, range(1, 9))} <= set(re.findall(r"\((\d)\)", names))
    assert {*map(str, range(1, 11))} == set(re.findall(r"line (\d+)", names))


def test_notation():
    """Every name that the notation table gives shall exist in the code."""
    code = " ".join(path.read_text() for path in (ROOT / "edp").rglob("*.idp"))
    for row in rows(section(PAPER, "Notation")):
        for name in quoted(row[1]):
            assert re.search(rf"\b{name}\b", code), name


def anchors(text):
    """The names of a page's headings, as links have them."""
    titles = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M)
    return {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}


def test_links():
    """Relative links and pictures shall exist, and the headings that they name."""
    wrong = []
    for page in PAGES:
        text = re.sub(r"^```.*?^```$", "", (ROOT / page).read_text(), flags=re.M | re.S)  # code has brackets of its own
        for target, heading in re.findall(r"\]\(([^)#\s]*)(?:#([^)]*))?\)", text):
            path = (ROOT / page).parent / target if target else ROOT / page
            if not target.startswith("http") and not path.exists():
                wrong.append(f"{page}: {target}")
            elif not target.startswith("http") and heading and heading not in anchors(path.read_text()):
                wrong.append(f"{page}: {target}#{heading}")
    assert not wrong, "\n".join(wrong)


def test_sources_that_pages_name():
    """Sources that a page names shall exist, but those that WRITING.md adds."""
    wrong = []
    for page in PAGES:
        text = " ".join(quoted((ROOT / page).read_text()))
        for name in re.findall(r"(?<![\w/.-])(?:[\w-]+/)+[\w.-]+\.(?:idp|edp|sh|awk|geo|py|cpp)\b", text):
            there = any((base / name).exists() for base in (ROOT, ROOT / "edp", (ROOT / page).parent))
            if not (there or re.search(rf"PATH|NAME|/(?:{LAW}|{METHOD}|centre)\.", name)):
                wrong.append(f"{page}: {name}")
    assert not wrong, "\n".join(wrong)


def test_every_claim_of_the_paper_is_on_its_page():
    """The page of claims shall show the whole table of PAPER.md, without its marks."""
    there = (ROOT / "edp/docs/PAPER.md").read_text().partition("\n## Every")[2].partition("###")[0]
    sentences = [line.split(" | ")[1] for line in there.splitlines() if line.startswith("| ")][1:]
    page = paper.every_claim()
    assert page.count("<tr>") == len(sentences) + 1 > 35
    assert all(html.escape(each.replace("`", "")) in page for each in sentences)
    assert "](" not in page and "`" not in page
