"""edp/labs/: every command of every lab runs, the answers' numbers hold, the scripts refuse as scenes do."""

import csv
import glob
import re
import shlex
import shutil

import numpy as np
import pytest
from accounts import shared
from docs.test_readme import fences, is_rule, quoted, section
from freefem import FREEFEM, ROOT, cases_of, environment, execute, listing, run, run_in, script, tree
from page_numbers import agrees, printed

from postprocess import formatting
from postprocess.command_line import main
from postprocess.results import read_run

FOLDERS = sorted(
    (path.parent for path in (ROOT / "edp/labs").glob("*/README.md")), key=lambda path: int(path.name.partition("-")[0])
)
LABS = [folder.name for folder in FOLDERS]
INDEX = (ROOT / "edp/labs/README.md").read_text()
OWN_LAW, PAGE, OWN_PART, MODELS = "4-own-law", "0-algorithm", "9-own-part", "11-lennard-jones"
SCENES = [lab for lab in LABS if lab not in (PAGE, OWN_PART, MODELS)]  # that are another scene with other defaults
BARE = {"PATH": "/usr/bin:/bin", "OPENBLAS_NUM_THREADS": "1"}  # nothing else in the environment


def readme(lab):
    return (ROOT / "edp/labs" / lab / "README.md").read_text()


def answers(lab):
    return re.sub("<!--= .*? -->", "", (ROOT / "edp/labs" / lab / "ANSWERS.md").read_text())  # as it is read


def lab_script(lab):
    """The lab's script, relative to the repository's root."""
    (path,) = (ROOT / "edp/labs" / lab).glob("[!x]*.edp")
    return str(path.relative_to(ROOT))


def package_in(folder):
    """A copy of the package in which the READMEs' commands find everything."""
    package = tree(folder / "package")
    for name in ("postprocess", ".venv"):
        (package / name).symlink_to(ROOT / name)
    return package


# ---------------------------------------------------------------- texts


def test_index():
    """The index shall list every lab."""
    assert re.findall(r"^\| \[(.*?)\]\((.*?)/README\.md\)", INDEX, re.M) == [(lab, lab) for lab in LABS]


def test_answers():
    """The instructor's page shall lead to all answers."""
    text = (ROOT / "edp/labs/INSTRUCTOR.md").read_text()
    assert re.findall(r"\[\d+\]\((.*?)/ANSWERS\.md\)", text) == LABS


@pytest.mark.parametrize("lab", LABS)
def test_parts_of_a_lab(lab):
    """A lab shall have a figure of its commands, core questions and their answers, elsewhere."""
    text = readme(lab)
    (core,) = re.findall(r"^Core: ([\d, ]+)\.$", section(text, "Questions"), re.M)
    asked = re.findall(r"^(\d+)\. ", section(text, "Questions"), re.M)
    assert set(core.split(", ")) <= set(asked) & set(re.findall(r"^\*\*(\d+)\.\*\* ", answers(lab), re.M))
    assert "](figure.png)" in text and (ROOT / "edp/labs" / lab / "figure.png").stat().st_size < 130_000
    (drawn,) = re.findall(r"^\*`(\w+)\.png` of these commands: .*\*$", text, re.M)
    assert f"{drawn}.pdf" in text or f"postprocess {drawn} " in text
    assert "ANSWERS" not in text + INDEX


def test_where_includes_are_found():
    """All labs shall have the same freefem++.pref, the scenes' but for the way up to edp/."""
    texts = {(folder / "freefem++.pref").read_text() for folder in FOLDERS}
    scenes = (ROOT / "edp/scenes/freefem++.pref").read_text()
    assert texts == {scenes.replace('"..', '"../..')}


# ---------------------------------------------------------------- commands


def commands(lab):
    """(command, exit code) of each line in the README's sh blocks; a comment before it names a code other than 0."""
    found, code = [], 0
    for line in "".join(fences(readme(lab), "sh")).splitlines():
        announced = re.match(r"# exit code (\d+)", line)
        if announced:
            code = int(announced[1])
        elif line and not line.startswith("#"):
            found.append((line, code))
            code = 0
    return found


@pytest.mark.parametrize("lab", LABS)
def test_no_run_replaces_another(lab):
    """No two commands of a lab shall write one folder: what -out names, or the method's of those without."""
    runs = [line for line, _ in commands(lab) if line.startswith("FreeFem++")]
    folders = [
        (re.search(r"-out (\S+)", line) or re.search(r"-method (\S+)", line) or ["", "default"])[1]
        for line in runs
        if "algorithm1.edp" not in line and "models.edp" not in line  # which write nothing
    ]
    assert len(folders) == len(set(folders))


@pytest.mark.parametrize("lab, script_name", [("1-law", "confined-block"), ("2-newton", "confined-block")])
def test_data_of_a_lab(lab, script_name):
    """What a page asks to predict from shall stand on it: the data of its runs, and the stiffness that follows."""
    data = re.search(r"\*\*Data\.\*\*(.*?)\n\n", readme(lab), re.S)[1]
    used = run(script_name).parameters
    given = {"E": "E", "ν": "nu", "L": "depth", "`?gap`?": "gap", "d0": "d0", "u0": "u0"}
    for symbol, name in given.items():
        (value,) = re.findall(rf"(?<!\w){symbol} =? ?([−\d.]*\d)", data)
        assert float(value.replace("−", "-")) == used[name], symbol
    if lab == "2-newton":
        modulus = used["E"] * (1 - used["nu"]) / (1 + used["nu"]) / (1 - 2 * used["nu"])
        found = re.findall(r"(?<!\w)[Mkδ] = ([\d.]*\d)", data)
        expected = [modulus, modulus / used["depth"], used["u0"] - used["gap"] - used["d0"]]
        assert list(map(float, found)) == pytest.approx(expected, rel=1e-5)


DRAW = ".venv/bin/python -m postprocess "


# of the other labs the answers' first numbers are tested always
@pytest.mark.parametrize("lab", cases_of([PAGE], LABS))
def test_commands(lab, tmp_path, monkeypatch):
    """Every command of a lab shall run as it is written, in this order, and leave what it names."""
    package = package_in(tmp_path)
    assert len(commands(lab)) > 3
    for line, expected in commands(lab):
        if line.startswith(DRAW):  # in this process: it has read matplotlib already
            monkeypatch.chdir(package)
            typed = shlex.split(line.removeprefix(DRAW))
            code, stdout = main([path for word in typed for path in sorted(glob.glob(word)) or [word]]), ""
        else:  # a loop's exit code is its last command's: stop at the first that fails
            code, stdout = execute(["sh", "-c", line.replace("; done", " || exit; done")], package)
        assert code == expected, f"{line}\n{stdout[-2000:]}"
        for name in re.findall(r"-out (\S+)", line):
            if name.startswith("results/") and "$" not in name:
                assert (package / name).exists(), line
        if "postprocess figure" in line:
            assert (package / re.search(r"--out (\S+)\.pdf", line)[1]).with_suffix(".png").stat().st_size > 10_000
    assert {path.name for path in (package / "results").iterdir()} == {"labs"}
    assert {path.name for path in (package / "results/labs").iterdir()} == {lab}


def test_table_of_runs(tmp_path):
    """`postprocess table` shall write a row a run: the values that all have, and the flags in which they differ."""
    for h in (5, 10):
        run_in(ROOT, lab_script("1-law"), "-h", h, "-vtu", 0, out=tmp_path / f"h{h}")
    out = tmp_path / "new" / "table.csv"
    assert main(["table", "--out", str(out), str(tmp_path / "h5"), str(tmp_path / "h10")]) == 0
    first, second = csv.DictReader(out.read_text().splitlines())
    summary = read_run(tmp_path / "h5").summary
    assert first["run"] == str(tmp_path / "h5")
    assert float(first["force"]) == summary["force"]
    assert float(first["seconds.contact"]) == summary["seconds"]["contact"]
    assert (int(first["newton"]), first["method"]) == (summary["newton"], "xnewton")
    assert (float(first["h"]), float(second["h"])) == (5, 10)
    assert not [name for name in first if name.startswith("-")]


# ---------------------------------------------------------------- the answers' numbers


def tables(text):
    """(head, rows) of each table in the text, cells without blanks around them."""
    for block in re.findall(r"(?:^\|.*\n)+", text, re.M):
        cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in block.splitlines()]
        assert is_rule(cells[1])
        yield cells[0], cells[2:]


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """A copy of the package, a blank in its path."""
    return tree(tmp_path_factory.mktemp("labs") / "a package")


@pytest.fixture(scope="module")
def coating(tmp_path_factory):
    """A copy of the package whose own law is the answers' solution."""
    package = tree(tmp_path_factory.mktemp("labs") / "package")
    (law,) = fences(answers(OWN_LAW), "freefem")
    (package / "edp/labs" / OWN_LAW / "mylaw.idp").write_text(law)
    return package


def test_coating(coating, tmp_path):
    """The answers' numbers of their own law; the others are held by test_numbers.py."""
    ((head, rows),) = [table for table in tables(answers(OWN_LAW)) if "coating" in table[0][0]]
    for flags, *cells in rows:
        words = [*shlex.split(quoted(flags)[0]), "-vtu", 0, "-estimate", 0]
        result = run_in(coating, lab_script(OWN_LAW), *words, out=tmp_path / "out", env=BARE)
        found = [printed(result.stdout, label) for label in head[1:3]] + [result.summary["newton"]]
        assert [agrees(*pair) for pair in zip(found, cells, strict=True)] == [True] * 3, (flags, found)


@pytest.mark.parametrize("lab", cases_of(["3-threshold"], SCENES))
def test_results_of_a_lab(lab, plain):
    """A run in the lab's folder, no environment set: its results lie at the root."""
    shutil.rmtree(plain / "results", ignore_errors=True)
    folder, name = lab_script(lab).rsplit("/", 1)
    coarse = ["-h", 0.034] if lab == "7-gecko" else []
    run_in(plain / folder, name, *coarse, "-vtu", 0, "-estimate", 0, expect=0, env=BARE)
    (summary,) = (plain / "results").rglob("summary.json")
    assert summary.parent.parent == plain / "results/labs" / lab


def test_next_thresholds(tmp_path):
    """The greatest next T that lab 3 prints shall be that of all points, in contact or not."""
    result = run_in(ROOT, lab_script("3-threshold"), "-vtu", 0, "-estimate", 0, out=tmp_path / "out")
    said = re.findall(r"model (\d+): .*greatest next T (\S+)", result.stdout)
    found = [result.models["threshold"][int(model)].max() for model, _ in said]
    assert len(said) == 2 and [float(text) for _, text in said] == pytest.approx(found, rel=1e-5)


def test_theory_of_newton_alone(tmp_path):
    """What the theory says of plain Newton shall not be said of another method."""
    result = run_in(ROOT, lab_script("2-newton"), "-method", "xnewton", "-vtu", 0, out=tmp_path / "out")
    assert "Newton steps 3" in result.stdout and "first ratio" not in result.stdout and "ln(s0" not in result.stdout


def test_words_of_the_gecko():
    """The coarse mesh's jumps in the words shall be the table's."""
    (jumps,) = re.findall(r"^\*\*5\.\*\* (\d+)\.", answers("7-gecko"), re.M)
    assert jumps == next(tables(answers("7-gecko")))[1][-1][3]


def test_unknowns_of_the_sphere(tmp_path):
    """The unknowns that lab 6 says of its finest mesh shall be the run's."""
    (flags, count) = re.findall(r"^With `(.*)` the block has ([\d ]+) unknowns", readme("6-sphere"), re.M)[0]
    done = run_in(ROOT, lab_script("6-sphere"), *flags.split(), "-vtu", 0, "-estimate", 0, out=tmp_path / "out")
    assert done.summary["ndof"] == int(count.replace(" ", ""))


def changed_page(words):
    """Lab 0's page with a change of the answers' table."""
    text = (ROOT / lab_script(PAGE)).read_text()
    if words == "the uniform update":
        text = text.replace("T[i] = next;", "top = max(top, next);").replace(
            "modelError = 0;", "modelError = 0; real top = T.max;"
        )
        end = text.rindex("}", 0, text.index("// line 10"))
        return text[:end] + "T = top; }" + text[end + 1 :]
    for name, value in re.findall(r"(\w+) = ([-\w.\"]+)", words):
        text, count = re.subn(rf"\b{name} = [^,;]+", f"{name} = {value}", text, count=1)
        assert count == 1
    return text


@shared
def said_by_page(words, package):
    (package / lab_script(PAGE)).write_text(changed_page(words))
    code, stdout = execute([*FREEFEM, lab_script(PAGE)], package, BARE)
    assert code == 0, stdout
    return stdout


CHANGES = {row[0]: row[1:] for row in next(tables(answers(PAGE)))[1]}
KINDS = ["none", "`T0 = d0`", "`kappa = 1e9`", "`m = 10`", "the uniform update", '`model = "linear"`']  # of changes


@pytest.mark.parametrize("change", cases_of(KINDS, CHANGES))
def test_the_page(change, plain):
    """Lab 0's page, as it is and changed, shall give the counts and the force of the answers."""
    stdout = said_by_page(change, plain)
    for label, cell in zip(("adaptations", "Newton steps", "force"), CHANGES[change], strict=True):
        assert agrees(printed(stdout, label), cell), label


def test_the_page_against_the_package(plain):
    """Lab 0's page is plain, a hundred lines at most, and has the package's walls at every step, and its force."""
    text = (ROOT / lab_script(PAGE)).read_text()
    assert len(text.splitlines()) <= 100 and "include" not in text
    assert re.findall(r"// line (\d+)", text) == [str(k) for k in range(1, 11)]
    stdout = said_by_page("none", plain)
    same = run("disc-on-block", "-method", "paper", "-order", 1, "-h", 0.5)
    assert [int(n) for n in re.findall(r"at the wall (\d+)", stdout)] == same.history["wallPoints"].astype(int).tolist()
    assert printed(stdout, "adaptations") == same.adaptations
    assert printed(stdout, "force") == pytest.approx(same.force, rel=1e-9)
    assert printed(stdout, "greatest pressure") == pytest.approx(same.pressureMax, rel=1e-9)


@pytest.mark.parametrize("name", ["algorithm1", "xnewton"])
def test_narrated_program(name):
    """The code of the page on a program shall be the program, line by line, in 150 lines at most."""
    folder = ROOT / "edp/labs" / PAGE
    lines = (folder / f"{name}.edp").read_text().splitlines()
    told = "".join(fences((folder / f"{name}.md").read_text(), "freefem")).splitlines()
    assert [line for line in told if line] == [line for line in lines if line]
    assert len(lines) <= 150 and not any(line.startswith("include") for line in lines)


XNEWTON = {row[0]: row[1:] for row in next(tables((ROOT / "edp/labs" / PAGE / "xnewton.md").read_text()))[1]}


@pytest.mark.parametrize("change", cases_of(["none"], XNEWTON))
def test_xnewton_page(change, plain):
    """The second program of lab 0, as it is and changed, shall have the counts of its page, and the package's force."""
    path = plain / "edp/labs" / PAGE / "xnewton.edp"
    text = (ROOT / "edp/labs" / PAGE / "xnewton.edp").read_text()
    flags = []
    if change != "none":
        name, value = quoted(change)[0].split(" = ")
        text, count = re.subn(rf"\b{name} = [^,;]+", f"{name} = {value}", text, count=1)
        assert count == 1
        flags = [f"-{name}", value] if name in ("kappa", "m") else []
    path.write_text(text)
    code, stdout = execute([*FREEFEM, path.relative_to(plain)], plain, BARE)
    assert code == 0, stdout
    labels = ("steps on the surrogate", "Newton steps", "back-substitutions")
    assert [printed(stdout, label) for label in labels] == list(map(int, XNEWTON[change]))
    same = run("disc-on-block", "-order", 1, "-h", 0.5, "-estimate", 0, "-tol", 1e-8, *flags)
    assert printed(stdout, "force") == pytest.approx(same.force, rel=1e-6)
    assert printed(stdout, "greatest pressure") == pytest.approx(same.pressureMax, rel=1e-6)


ADHESIVE = {quoted(row[0])[0]: row[1:] for row in next(tables(answers(MODELS)))[1]}  # lab 11: flags, what it prints
BRIEF = [flags for flags in ADHESIVE if flags in ("-u0 0 -model wall", "-u0 0")]


def adhesive(*flags, code=0):
    """Output of lab 11's page, which needs nothing of the package."""
    found, stdout = execute([*FREEFEM, lab_script(MODELS), *map(str, flags)], ROOT, environment())
    assert found == code, stdout
    return stdout


@pytest.mark.parametrize("flags", cases_of(BRIEF, ADHESIVE))
def test_models_of_an_adhesive_law(flags):
    """Lab 11's page shall give the models, steps, forces and energies of the answers, in stable states."""
    stdout = adhesive(*flags.split())
    for label, cell in zip(("models", "Newton steps", "force", "energy"), ADHESIVE[flags], strict=True):
        assert agrees(printed(stdout, label), cell), label
    assert ", stable" in stdout


@pytest.mark.parametrize(
    "flags",
    cases_of(["-model newton", "-u0 -1 -model newton"], ["-w 0.003108162 -model wall", "-u0 -1.68 -from 0 -steps 5"]),
)
def test_where_no_state_is_found(flags):
    """Where the answers say that a way fails, it shall say so, with exit code 20."""
    assert adhesive(*flags.split(), code=20).startswith("NO STATE: ")


def test_one_approach_has_two_states():
    """From afar and from contact lab 11's page shall find two stable states, those of the package's path."""
    afar, touching = adhesive("-u0", -1.68), adhesive("-u0", -1.68, "-from", -1.5, "-steps", 4)
    forces = [printed(stdout, "force") for stdout in (afar, touching)]
    assert forces[0] > -0.6 and forces[1] < -1.2 and ", stable" in afar and ", stable" in touching
    unit = np.pi * 0.0010989011 * 10
    flags = ["-path", "-0.0031 -0.00168", "-steps", 3, "-estimate", 0, "-order", 1]
    near = run("adhesive-sphere", *flags).force / unit
    assert near == pytest.approx(forces[0], rel=0.03)
    flags[1] = "-0.0031 0 -0.00168"
    assert run("adhesive-sphere", *flags).force / unit == pytest.approx(forces[1], rel=0.03)


@pytest.mark.parametrize("u0", [1, -2])
def test_the_adhesive_page_against_the_package(u0):
    """Lab 11's page, on a mesh of its own, shall have the force of the package's stable step."""
    force = run("adhesive-sphere", "-u0", u0 * 1e-3, "-estimate", 0).force / (np.pi * 0.0010989011 * 10)
    assert printed(adhesive("-u0", u0), "force") == pytest.approx(force, rel=0.02)


# ---------------------------------------------------------------- what a lab says


def confined_state(law, stiffness, at_rest):
    """The root s of p(s) = stiffness (at_rest - s)."""
    low, high = 0.0, at_rest
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if law(middle) < stiffness * (at_rest - middle) else (low, middle)
    return low


@pytest.mark.parametrize("kappa, m, u0", [(1e3, 3, 2.5), (10, 1.5, 0.9), (1e12, 8, 2.5)])
def test_exact_state(kappa, m, u0, tmp_path):
    """Lab 1 shall print the exact state, and the run shall have it."""
    modulus, depth = 100 * 0.7 / (1.3 * 0.4), 20
    s = confined_state(lambda s: kappa * s**m, modulus / depth, u0 - 0.5 + 0.25)
    flags = ["-kappa", kappa, "-m", m, "-u0", u0, "-vtu", 0]
    stdout = run_in(ROOT, lab_script("1-law"), *flags, out=tmp_path / "out").stdout
    pressure, depression = modulus / depth * (u0 - 0.25 - s), u0 - 0.25 - s
    for label, value in (("pressure p", pressure), ("s = d - d0", s), ("p depth/M", depression)):
        found = re.findall(re.escape(label) + r"\s+(\S+)\s+(\S+)\n", stdout)[-1]
        assert [float(number) for number in found] == pytest.approx([value, value], rel=1e-5)


def test_no_contact(tmp_path):
    """Labs shall take a wall that does not touch as a result."""
    for lab in ("1-law", "2-newton", OWN_LAW):
        run_in(ROOT, lab_script(lab), "-u0", 0.1, "-vtu", 0, out=tmp_path / lab)


SLOPED = (41, 6, 33)  # steps
INVERSE = "= p[i] <= soft * knee ? p[i] / soft : knee + (p[i] - soft * knee) / stiff;"


@pytest.mark.parametrize(
    "function, change, check, steps",
    [
        ("slope", ("? soft : stiff)", "? 2 * soft : 2 * stiff)"), "slope, against differences of the pressure", SLOPED),
        ("inverse", (INVERSE, "= x / 3;"), "inverse of pressure, against s", (None, "0.90 %", "3.5 %")),
        (
            "potential",
            ("W[i] = 0.5", "W[i] = 3 * 0.5"),
            "pressure, against differences of the potential",
            (1, 1, 4),
        ),
    ],
    ids=["slope", "inverse", "potential"],
)
def test_a_law_is_checked(function, change, check, steps, coating, tmp_path):
    """The lab's check shall tell each spoilt function of a law, converged or not; steps as in the answers."""
    package = tree(tmp_path / "package")
    law = (coating / "edp/labs" / OWN_LAW / "mylaw.idp").read_text()
    assert change[0] in law
    change = (change[0], change[1].replace("x", f"({change[0][2:-1]})"))
    (package / "edp/labs" / OWN_LAW / "mylaw.idp").write_text(law.replace(*change))
    methods = (["newton"], ["xnewton"], ["paper", "-T0", "d0"])
    for method, expected in zip(methods[: len(steps)], steps, strict=True):
        command = [*FREEFEM, lab_script(OWN_LAW), "-vtu", "0", "-out", tmp_path / method[0], "-method", *method]
        code, stdout = execute(command, package)
        assert code in (0, 20)
        assert printed(stdout, check) > 0.3
        assert code == 0 or not expected
        if isinstance(expected, str):  # a wrong pressure
            assert agrees(printed(stdout, "relative difference"), expected) and expected in answers(OWN_LAW)
        elif expected:
            assert printed(stdout, "converged in") == expected
            assert printed(stdout, "confined block: pressure") == 14.3811


def test_own_law_stays_in_its_lab():
    """The law of the lab shall be no law of the package's scenes."""
    assert "mylaw" in run_in(ROOT, lab_script(OWN_LAW), "-help").stdout
    assert "mylaw" not in run_in(ROOT, script("confined-block"), "-help").stdout


# ---------------------------------------------------------------- scripts


@pytest.mark.parametrize("lab", cases_of(["1-law", OWN_LAW, "7-gecko"], SCENES))
def test_help_and_refusals(lab, tmp_path):
    """-help shall print the flags; a bad flag or value shall end with code 10; nothing shall be written."""
    package = tree(tmp_path / "package")
    before = listing(package)
    stdout = run_in(package, lab_script(lab), "-help").stdout
    for flag in ("-method", "-law", "-kappa", "-h", "-out"):
        assert re.search(rf"^{flag} ", stdout, re.M)
    assert f"results/labs/{lab}/" in stdout
    assert "-kapa" in run_in(package, lab_script(lab), "-kapa", 5, expect=10).stdout
    assert listing(package) == before


@pytest.mark.parametrize("lab, flags", [("1-law", ["-h", 5]), ("6-sphere", ["-h", 1.6, "-layers", 1, "-estimate", 0])])
def test_the_command_of_a_run(lab, flags, tmp_path):
    """The command that a page of runs gives for a lab's run shall make that run again."""
    result = run_in(ROOT, lab_script(lab), *flags, out=tmp_path / "a")
    command = shlex.split(formatting.command(read_run(result.folder)))
    assert lab_script(lab) in command
    command[command.index("-out") + 1] = str(tmp_path / "b")
    code, stdout = execute(command, ROOT, environment())
    assert code == 0, stdout
    again = read_run(tmp_path / "b").summary
    assert again["force"] == result.force
    assert {**again["parameters"], "out": ""} == {**result.parameters, "out": ""}


# ---------------------------------------------------------------- figures


@pytest.mark.parametrize(
    "figure, words", [("equilibrium", "not a confined block"), ("overshoot", "-states 1"), ("cost", "reference")]
)
def test_figures_refuse(figure, words, tmp_path, capsys):
    """A run that does not hold what a figure shows shall be refused in one line."""
    folders = [str(run("disc-on-block", "-h", 2).folder)] * (2 if figure == "cost" else 1)
    assert main(["figure", figure, "--out", str(tmp_path / "x.pdf"), *folders]) == 2
    assert words in capsys.readouterr().err
    assert not (tmp_path / "x.pdf").exists()


def test_figures_of_a_lab(tmp_path, capsys):
    """`figures` shall draw a lab's figures from a lab's run."""
    run_in(ROOT, lab_script("2-newton"), "-vtu", 0, out=tmp_path / "run")
    assert main(["figures", str(tmp_path)]) == 0
    assert {"equilibrium.png", "overshoot.png"} <= {path.name for path in (tmp_path / "figures").iterdir()}
    assert "cost: needs runs of the lab 5-cost" in capsys.readouterr().out
