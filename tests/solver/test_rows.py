"""solver/rows/: a table of problems on one mesh: each row is the run of its own flags, and none ends the others.

The reference of a row is the single run with its flags: all numbers of its summary.json, and its exit code and message.
"""

import csv
import json
import shlex
import subprocess

import pytest
from freefem import FREEFEM, ROOT, environment, execute, run_in

COARSE = ["-order", 1, "-h", 1]
NOT_SHARED = "seconds date package freefem gmsh modules plugins costRatio given parameters".split()


def flat(entry, name=""):
    """(path, value) of all entries of JSON."""
    pairs = entry.items() if isinstance(entry, dict) else enumerate(entry) if isinstance(entry, list) else None
    if pairs is None:
        return [(name, entry)]
    return [found for key, inner in pairs for found in flat(inner, f"{name}.{key}" if name else str(key))]


def solve(folder, table, *flags, expect=0, script="edp/main.edp"):
    """(rows.json's rows, rows.csv's rows, what is printed) of a table: lists for -vary, or a CSV text."""
    words = ["-vary", table]
    if "\n" in table:
        (folder / "table.csv").write_text(table)
        words = ["-rows", folder / "table.csv"]
    done = run_in(ROOT, script, *words, *flags, out=folder / "rows", expect=expect)
    rows = json.loads((folder / "rows/rows.json").read_text())["rows"]
    with (folder / "rows/rows.csv").open() as file:
        found = list(csv.DictReader(file))
    assert len(rows) == len(found) and [row["code"] for row in found] == [str(row["code"]) for row in rows]
    assert max(row["code"] for row in rows) == expect
    assert sorted(path.name for path in (folder / "rows").iterdir()) == [".run", "rows.csv", "rows.json"]
    return rows, found, done.stdout


def single(folder, row, *flags, script="edp/main.edp"):
    """(exit code, summary.json as path: value, the last line printed) of the run of its own of a row."""
    words = [word for name, text in row["inputs"].items() if text for word in (f"-{name}", text)]
    done = run_in(ROOT, script, *words, *flags, "-vtu", 0, out=folder / "single", expect=None)
    summary = {}
    if done.code != 10:
        summary = dict(flat(json.loads((folder / "single/summary.json").read_text())))
    return done.code, summary, done.stdout.strip().split("\n")[-1]


def compare(folder, rows, *flags, script="edp/main.edp", tolerance=1e-10):
    """Each of these rows shall be its run of its own, with all counts; those refused with the same message."""
    for row in rows:
        code, expected, said = single(folder, row, *flags, script=script)
        assert row["code"] == code, (row["inputs"], row["message"], said)
        if code == 10:
            assert row["message"] == said
            continue
        found = dict(flat(row["summary"]))
        assert {path for path in found if path not in expected} <= {"warmStart"}, row["inputs"]
        for path, value in expected.items():
            if path.split(".")[0] in NOT_SHARED or path in ("used.vtu", "estimates.seconds"):
                continue
            if isinstance(value, float) and not path.startswith("reactionX"):
                assert found[path] == pytest.approx(value, rel=tolerance, abs=1e-13), (path, row["inputs"])
            elif not path.startswith("reactionX"):
                assert found[path] == value, (path, row["inputs"])


def test_rows_are_single_runs(tmp_path):
    """Laws, loads, thresholds, a force: cold rows have all digits and counts of single runs, whichever came before."""
    table = (
        "law,kappa,m,d0,u0,force,T0,tol\n"
        "power,1e3,3,,0.1,,,\n"
        "power,1e9,3,,,,,\n"
        "power,1e3,2,-0.1,1.5,,d0,1e-9\n"
        '"signorini",,,,,,,\n'
        "power,-5,3,,,,,\n"
        "exponential,,,,,,0,\n"
        "power,1e6,3,,,80,,\n"
        "power,1e3,3,0,,,,\n"
    )
    rows, found, said = solve(tmp_path, table, *COARSE, "-rows-start", "cold", expect=10)
    assert [row["code"] for row in rows] == [0, 0, 0, 0, 10, 0, 0, 10]
    assert "6 of 8 solved, 2 refused (code 10)" in said and "row 5     -kappa -5: out of range" in said
    compare(tmp_path, rows[1:], *COARSE)
    assert found[6]["force"] == format(rows[6]["summary"]["force"], ".17g")
    assert float(found[1]["force.error"]) == rows[1]["summary"]["estimates"]["force"]["error"]
    assert float(found[1]["contacts.1.pressureMax"]) == rows[1]["summary"]["contacts"][0]["pressureMax"]
    assert found[0]["force"] == "0" and found[0]["warnings"].startswith("no contact") and found[1]["warnings"] == ""
    assert found[4]["force"] == "" and found[4]["message"].startswith("-kappa -5")


def test_methods(tmp_path):
    """A row has the flags and defaults of its method alone; a method that fails leaves the next row as it is."""
    table = (
        "method,kappa,T0,model,maxNewton\npaper,1e6,auto,linear,\nnewton,1e6,,,1\nxnewton,1e6,,linear,\npaper,1e6,,,\n"
    )
    flags = ["-order", 1, "-h", 2, "-estimate", 0, "-rows-start", "cold"]
    rows, found, _ = solve(tmp_path, table, *flags, expect=20)
    assert [row["code"] for row in rows] == [0, 20, 10, 0]
    assert rows[1]["summary"]["newton"] == 1 and "Newton's method stopped after 1 steps" in found[1]["message"]
    compare(tmp_path, rows[2:], *flags[:-2])


def test_threshold_of_another_layer(tmp_path):
    """The threshold of the command line counts from the mean planes, wherever the row's layer begins."""
    flags = ["-order", 1, "-h", 2, "-estimate", 0, "-T0", 0.01, "-kappa", 100]
    rows = solve(tmp_path, "d0 -0.25 -0.1", *flags, "-rows-start", "cold")[0]
    assert [row["summary"]["used"]["wall"] for row in rows] == [True, True]
    compare(tmp_path, rows[1:], *flags)


def test_friction(tmp_path):
    """Paths with friction: each row has its own interface, and a path that fails leaves nothing to the next one."""
    flags, script = ["-h", 0.2, "-order", 1, "-estimate", 0, "-legs", "1 0, 1 1, 1 -0.5"], "edp/scenes/fretting.edp"
    table = "friction,compliance,shearLimit,law\n0.5,,,\n0.1,,,\n0.3,1e-4,,\n0,,,\n0.4,,2,\n"
    rows = solve(tmp_path, table, *flags, "-rows-start", "cold", script=script, expect=20)[0]
    assert [row["code"] for row in rows] == [0, 20, 0, 10, 0]
    assert "gross sliding" in rows[1]["message"] and rows[3]["message"].startswith("-friction 0: not in a table")
    compare(tmp_path, [rows[2], rows[4]], *flags, script=script)


def test_warm_rows(tmp_path):
    """A warm row ends where a cold one does, in fewer products; a force scales that of the nearest row."""
    flags = [*COARSE, "-estimate", 0, "-tol", 1e-12]
    for lists in ("kappa 1e0:1e12:13 log, m 2 3", "force 20 40:100:4, kappa 1e4 1e8, d0 -0.2 -0.1", "force 20 40"):
        warm = solve(tmp_path, lists, *flags)[1]
        cold = solve(tmp_path, lists, *flags, "-rows-start", "cold")[1]
        for one, other in zip(warm, cold, strict=True):
            for name in ("force", "approach", "pressureMax", "energy", "halfWidth"):
                assert float(one[name]) == pytest.approx(float(other[name]), rel=1e-9)
        spent = [sum(int(row["backsolves"]) for row in rows) for rows in (warm, cold)]
        few = len(warm) == 2  # no columns are stored for so few
        assert spent[0] == spent[1] if few else spent[0] < 0.6 * spent[1], spent
        assert [row["warmStart"] for row in warm] == ["0"] + ["0" if few else "1"] * (len(warm) - 1)
        assert {row["warmStart"] for row in cold} == {"0"}


def test_screen_in_a_file(tmp_path):
    """The last lines of the screen shall stay where it is a file that other commands write on."""
    words = shlex.join(
        [*FREEFEM, "edp/main.edp", *map(str, COARSE), "-vary", "kappa 1e3 -1", "-out", str(tmp_path / "out")]
    )
    code, _ = execute(["sh", "-c", f"({words}; echo code $?) > {shlex.quote(str(tmp_path / 'screen'))}"])
    *_, first, refused, files, last = (tmp_path / "screen").read_text().splitlines()
    assert code == 0 and last == "code 10" and first.startswith("  rows      1 of 2 solved, 1 refused (code 10)")
    assert refused.startswith("  row 2     -kappa -1: ") and files.endswith("rows.csv, rows.json")


def test_half_model(tmp_path):
    """The mirrored results of a half model are no start of the next row."""
    flags = ["-half", 1, "-h", 2, "-estimate", 0]
    rows = solve(tmp_path, "kappa 1e3 1e9", *flags, "-rows-start", "cold")[0]
    compare(tmp_path, rows, *flags)


def test_late_refusal(tmp_path):
    """A row that is refused while it is solved ends its process: the next one goes on, and nothing stays behind."""
    (tmp_path / "good.csv").write_text("overlap,pressure\n0,0\n0.1,1\n0.2,4\n")
    (tmp_path / "bad.csv").write_text("overlap,pressure\n0,0\n0.1,x\n0.2,4\n")
    temporary = tmp_path / "tmp"
    temporary.mkdir()
    lists = f"table {tmp_path}/bad.csv {tmp_path}/good.csv {tmp_path}/bad.csv"
    words = [*FREEFEM, "edp/main.edp", "-law", "table", "-vary", lists, "-h", 2, "-order", 1, "-estimate", 0]
    code, said = execute([*words, "-out", tmp_path / "rows"], env=environment(TMPDIR=str(temporary)))
    rows = json.loads((tmp_path / "rows/rows.json").read_text())["rows"]
    assert code == 10 and "1 of 3 solved, 2 refused" in said
    assert [row["code"] for row in rows] == [10, 0, 10]
    assert "bad.csv, line 3 x: not a number" in rows[2]["message"]
    assert list(temporary.iterdir()) == []


@pytest.mark.parametrize(
    "scene, lists", [("sphere-on-block", "kappa 1e3 1e8, m 2 5"), ("two-cylinders", "force 0 5, kappa 1e3 1e9")]
)
def test_scenes(tmp_path, scene, lists):
    """Rows of a scene in space, and of two bodies."""
    flags, script = ["-order", 1, "-estimate", 0], f"edp/scenes/{scene}.edp"
    rows = solve(tmp_path, lists, *flags, "-rows-start", "cold", script=script)[0]
    compare(tmp_path, rows[-1:], *flags, script=script)


@pytest.mark.parametrize(
    "words, message",
    [
        (["-vary", "h 1 2"], "-vary: column h: all rows have one mesh, one stiffness"),
        (["-vary", "E 1 2"], "-vary: column E: all rows have one mesh, one stiffness"),
        (["-vary", "kapa 1 2"], "-vary: column kapa: no flag of this scene; allowed: kappa m d0"),
        (["-vary", "kappa 1 2", "-kappa", 3], "-kappa 3: also a column of the table"),
        (["-vary", "kappa 1 2", "-rows", "x.csv"], "-vary kappa 1 2: not with -rows"),
        (["-rows", "x.csv"], "-rows x.csv: cannot be read"),
        (["-vary", "kappa 0:10:3 log"], "-vary: kappa 0:10:3 log: a logarithm needs positive ends"),
        (["-vary", "method xnewton paper"], "-vary: method paper: its elements are of degree 1"),
        (["-vary", "method newton", "-order", 3], "-vary: method newton: with two bodies, or -order above 2"),
        (["-vary", "kappa 1 2", "-vtu", 1], "-vtu 1: not with a table of problems"),
        (["-vary", "kappa 1 2", "-accuracy", 0.1], "-accuracy 0.1: not with a table of problems"),
    ],
)
def test_refusals(tmp_path, words, message):
    """A wrong table is refused whole, in one line, and nothing is written."""
    done = run_in(ROOT, "edp/main.edp", *words, out=tmp_path / "rows", expect=10)
    assert done.stdout.startswith(message) and done.stdout.count("\n") == 1, done.stdout
    assert not (tmp_path / "rows").exists()


def read_table(text, lists=""):
    """What table.awk makes of a table: [first line, columns, rows, names ..., cells ...]."""
    path = ROOT / "edp/solver/rows/table.awk"
    done = subprocess.run(
        ["awk", "-f", path], input=text, env=environment(VARY=lists), capture_output=True, text=True, check=True
    )
    return done.stdout.split("\n")[:-1]


def test_table():
    """Quotes, blanks, comments, a mark of the byte order and carriage returns; lists in their order."""
    text = '\ufeff# measured\r\nkappa, "legs",-m\r\n\r\n1e3,"1 0, 1 1", 3 \r\n2,,"a ""b"""\r\n'
    assert read_table(text) == ["", "3", "2", "kappa", "legs", "m", "1e3", "1 0, 1 1", "3", "2", "", 'a "b"']
    assert read_table("", "kappa 1:100:3 log 7, m 2 3") == (
        ["", "2", "8", "kappa", "m"] + [text for kappa in ("1", "10", "100", "7") for text in (kappa, "2", kappa, "3")]
    )
    assert read_table("", "u0 1:2:3")[5:] == ["1.5", "2"]


@pytest.mark.parametrize(
    "text, lists, message",
    [
        ("kappa,m\n1\n", "", "line 2 has 1 cells, the head 2"),
        ("kappa,kappa\n1,2\n", "", "column kappa stands twice"),
        ("kappa,\n1,2\n", "", "column 2 has no name"),
        ('kappa\n"1\n', "", "line 2: a quote is not closed"),
        ("kappa\n", "", "no rows"),
        ("", "kappa 1:2", "kappa 1:2: no range"),
        ("", "kappa 1,,m 2", "list 2 is empty"),
        ("", "kappa", "kappa: no values"),
        ("", "kappa 1:9:1000, m 1:9:1001", "1001000 rows; allowed: at most 1000000"),
    ],
)
def test_wrong_table(text, lists, message):
    assert read_table(text, lists)[0].startswith(message)
