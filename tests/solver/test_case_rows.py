"""input/case/rows/: rows and load cases of a case: each is the run of its own edited file, on one factorisation.

The references are single runs whose case files the tests write themselves, and the superposition of loads where the
contact is glued.
"""

import csv
import json
import re

import numpy as np
import pytest
from freefem import ROOT, run_in

from solver.test_rows import NOT_SHARED, flat

PLANE = """
h = HSIZE;
Point(1) = {LEFT, -2, 0, h}; Point(2) = {2, -2, 0, h}; Point(3) = {2, 0, 0, h}; Point(4) = {LEFT, 0, 0, h};
Point(5) = {FROM, BOTTOM, 0, h}; Point(6) = {1, 0.05, 0, h}; Point(7) = {1, 1, 0, h}; Point(8) = {FROM, 1, 0, h};
Point(9) = {0, 10.0375, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Circle(5) = {5, 9, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8}; Plane Surface(2) = {2};
"""
NAMES = """
Physical Curve("base") = {1}; Physical Curve("side") = {2}; Physical Curve("top") = {3}; Physical Curve("round") = {5};
Physical Curve("flank") = {6}; Physical Curve("head") = {7}; Physical Curve("left") = {4}; Physical Curve("axis") = {8};
Physical Surface("lower") = {1}; Physical Surface("upper") = {2};
"""
SPACE = """
a[] = Extrude {0, 0, 1} { Surface{1}; };
b[] = Extrude {0, 0, 1} { Surface{2}; };
Physical Surface("base") = {a[2]}; Physical Surface("top") = {a[4]}; Physical Surface("round") = {b[2]};
Physical Surface("flank") = {b[3]}; Physical Surface("head") = {b[4]};
Physical Volume("lower") = {a[1]}; Physical Volume("upper") = {b[1]};
"""
BODIES = "units mm MPa\nSTATEbody lower E 1e3 nu 0.3 density 1e-6\nbody upper E 2e3 nu 0.25 density 2e-6\nclamp base\n"


def geometry(kind):
    """Two blocks, the upper one with a round face; a half of them for a ring, or both with a thickness in space."""
    left, start, bottom = ("0", "0", "0.0875") if kind == "axis" else ("-2", "-1", "0.05")
    text = PLANE.replace("LEFT", left).replace("FROM", start)
    if kind == "axis":  # the circle begins at its lowest point
        bottom = f"{10.0375 - np.hypot(1, 9.9875):.15g}"
    text = text.replace("BOTTOM", bottom).replace("HSIZE", "0.7" if kind == "space" else "0.4")
    return text + (SPACE if kind == "space" else NAMES)


class Problem:
    """A geometry and a case in a folder."""

    def __init__(self, folder, case, kind="plane"):
        self.folder, self.script = folder, "edp/parts-3d.edp" if kind == "space" else "edp/parts.edp"
        (folder / "blocks.geo").write_text(geometry(kind))
        self.case = BODIES.replace("STATE", "state axisymmetric\n" if kind == "axis" else "") + case

    def run(self, case, name, *flags, expect=0):
        (self.folder / f"{name}.case").write_text(case)
        words = ["-mesh", self.folder / "blocks.geo", "-case", self.folder / f"{name}.case", *flags]
        return run_in(ROOT, self.script, *words, out=self.folder / name, expect=expect)

    def rows(self, *flags, table="", expect=0):
        """(rows.json's rows, what is printed)."""
        if table:
            (self.folder / "table.csv").write_text(table)
            flags = ("-rows", self.folder / "table.csv", *flags)
        done = self.run(self.case, "rows", "-rows-start", "cold", *flags, expect=expect)
        return json.loads((self.folder / "rows/rows.json").read_text())["rows"], done.stdout

    def single(self, edits, *flags):
        """(exit code, summary.json as path: value, the last line printed) of the edited file's run."""
        text = self.case
        for old, new in edits:
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        done = self.run(text, "single", *flags, "-vtu", 0, expect=None)
        path = self.folder / "single/summary.json"
        return (
            done.code,
            dict(flat(json.loads(path.read_text()))) if done.code != 10 else {},
            done.stdout.strip().split("\n")[-1],
        )

    def compare(self, row, edits, *flags):
        """A row shall be this run: all numbers to 1e-10 of the greatest of their kind, all counts."""
        code, expected, said = self.single(edits, *flags)
        assert row["code"] == code, (row["inputs"], row["message"], said)
        if code == 10:
            assert row["message"].split(": ", 1)[1] == said.split(": ", 1)[1]
            return
        found = dict(flat(row["summary"]))
        assert {path for path in found if path not in expected} <= {"warmStart"}, row["inputs"]
        size = max(abs(expected["contacts.0.normalForce"]), abs(expected["pressureMax"]))
        for path, value in expected.items():
            if path.split(".")[0] in NOT_SHARED or path in ("used.vtu", "estimates.seconds"):
                continue
            if isinstance(value, float):
                assert found[path] == pytest.approx(value, rel=1e-9 if "error" in path else 1e-10, abs=1e-11 * size), (
                    path
                )
            elif path not in ("estimates.contacts.0.force.value",):
                assert found[path] == value, (path, row["inputs"])


def test_rows_of_rubber(tmp_path):
    """Loads of a row shall not assemble the mixed elements of a nearly incompressible body once more."""
    of = Problem(tmp_path, "contact top round\nmove head 0 -0.1\npressure side 3\n")
    of.case = of.case.replace("nu 0.3", "nu 0.499")
    rows, _ = of.rows("-estimate", 0, table="move.head.y,pressure.side\n-0.05,3\n-0.08,-4\n")
    of.compare(rows[0], [("move head 0 -0.1", "move head 0 -0.05")], "-estimate", 0)
    of.compare(
        rows[1], [("move head 0 -0.1", "move head 0 -0.08"), ("pressure side 3", "pressure side -4")], "-estimate", 0
    )


def test_rows_are_edited_files(tmp_path):
    """Motions, loads, weights, warming, interference and laws of contact and obstacle, whichever row came before."""
    of = Problem(
        tmp_path,
        "contact top round law power kappa 1e5 m 2 d0 -0.02\nobstacle side circle 3.1 -1 R 1 move -0.12 0\n"
        "move head 0 -0.1\npressure side 3\ngravity 0 -9810\nexpand lower 1e-5 20\n",
    )
    rows, _ = of.rows(
        table="move.head.x,move.head.y,pressure.side,gravity.y,expand.lower,contact.top.round.kappa,"
        "contact.top.round.interference,obstacle.side.move.x,tol\n"
        ",-0.05,,,,,,,\n0.02,,-20,0.5e6,,,0.03,,\n,,,,-100,1e7,,-0.15,1e-9\n,,x,,,,,,\n,,,,,,,,\n",
        expect=10,
    )
    of.compare(rows[0], [("move head 0 -0.1", "move head 0 -0.05")])
    second = [
        ("move head 0 -0.1", "move head 0.02 -0.1"),
        ("pressure side 3", "pressure side -20"),
        ("gravity 0 -9810", "gravity 0 0.5e6"),
    ]
    of.compare(rows[1], [*second, ("d0 -0.02", "d0 -0.02 interference 0.03")])
    third = [
        ("expand lower 1e-5 20", "expand lower 1e-5 -100"),
        ("kappa 1e5", "kappa 1e7"),
        ("move -0.12 0", "move -0.15 0"),
    ]
    of.compare(rows[2], third, "-tol", 1e-9)
    assert rows[3]["code"] == 10 and "line 8: x: the pressure is no number" in rows[3]["message"]
    of.compare(rows[4], [])
    forces = [row["summary"]["contacts"][0]["normalForce"] for row in rows if row["code"] == 0]
    assert len(set(forces)) == 4 and rows[0]["summary"]["factorisations"] == 1


def test_friction(tmp_path):
    """Coefficient, load and motion with friction: the path of each row begins without slip."""
    of = Problem(tmp_path, "contact top round friction 0.3\nmove head 0.05 -0.1\npressure side 5\nleg 3\n")
    of.case = of.case.replace("leg 3\n", "")
    rows, _ = of.rows("-vary", "contact.top.round.friction 0.3 0.1, move.head.x 0.05 0")
    for row, (mu, x) in zip(rows, ((0.3, 0.05), (0.3, 0), (0.1, 0.05), (0.1, 0)), strict=True):
        if (mu, x) != (0.3, 0.05):
            of.compare(row, [("friction 0.3", f"friction {mu}"), ("move head 0.05", f"move head {x}")])
    sheared = [row["summary"]["contacts"][0]["force"][0] for row in rows]
    assert abs(sheared[0]) > 2 * abs(sheared[2]) > 0


def test_space(tmp_path):
    """A free upper block under a guided force, and gravity, in space."""
    of = Problem(tmp_path, "contact top round friction 0.2\nforce head 0 -20 0\nweight upper 0 -1 0\n", "space")
    rows, _ = of.rows("-vary", "force.head.y -20 -5, weight.upper.z 0 3")
    of.compare(rows[3], [("force head 0 -20 0", "force head 0 -5 0"), ("weight upper 0 -1 0", "weight upper 0 -1 3")])


def test_rings(tmp_path):
    """A ring that is warmed, under a free force."""
    of = Problem(tmp_path, "contact top round\nforce head 0 -20 free\nexpand upper 1e-5 10\n", "axis")
    of.case = of.case.replace("clamp base", "clamp base\nclamp axis x")
    rows, _ = of.rows("-vary", "force.head.y -20 -5, expand.upper 10 50")
    of.compare(rows[3], [("force head 0 -20", "force head 0 -5"), ("1e-5 10", "1e-5 50")])


LOAD_CASES = """contact top round
load case dead
gravity 0 -9810
pressure head 2
load case wind
pressure head 0.5
traction flank -0.5 0
combine storm 1.35 dead + 1.5 wind
"""
SPRINGS = "spring head 20 20\n"


def test_load_cases(tmp_path):
    """Each load case is the run of its own file; the table has them with ±, the envelope the least and the greatest."""
    of = Problem(tmp_path, SPRINGS + LOAD_CASES)
    rows, said = of.rows()
    assert [row["inputs"]["case"] for row in rows] == ["dead", "wind", "storm"]
    common = of.case[: of.case.index("load case dead")]
    loads = {
        "dead": "gravity 0 -9810\npressure head 2\n",
        "wind": "pressure head 0.5\ntraction flank -0.5 0\n",
        "storm": f"gravity 0 {-9810 * 1.35}\npressure head {2 * 1.35 + 0.5 * 1.5}\ntraction flank -0.75 0\n",
    }
    single = {}
    for name, text in loads.items():
        of.run(common + text, "single", "-vtu", 0)
        single[name] = json.loads((tmp_path / "single/summary.json").read_text())
    for row in rows:
        expected = single[row["inputs"]["case"]]
        for key in ("normalForce", "pressureMax", "contactLength"):
            assert row["summary"]["contacts"][0][key] == pytest.approx(expected["contacts"][0][key], rel=1e-10), (
                key,
                row["inputs"],
            )
            error = row["summary"]["estimates"]["contacts"][0][key]["error"]
            assert error == pytest.approx(expected["estimates"]["contacts"][0][key]["error"], rel=1e-8), (
                key,
                row["inputs"],
            )
        assert row["summary"]["energy"] == pytest.approx(expected["energy"], rel=1e-10)
    with (tmp_path / "rows/envelope.csv").open() as file:
        envelope = {row["result"]: row for row in csv.DictReader(file)}
    pressures = {name: one["contacts"][0]["pressureMax"] for name, one in single.items()}
    least, greatest = min(pressures, key=pressures.get), max(pressures, key=pressures.get)
    found = envelope["contacts.1.pressureMax"]
    assert (found["leastCase"], found["greatestCase"], found["name"]) == (least, greatest, "top round")
    assert [float(found[key]) for key in ("least", "greatest")] == pytest.approx(
        [pressures[least], pressures[greatest]], rel=1e-10
    )
    assert float(found["greatestPlusMinus"]) == pytest.approx(
        single[greatest]["estimates"]["contacts"][0]["pressureMax"]["error"], rel=1e-8
    )
    table = np.genfromtxt(tmp_path / "rows/envelope-contact.csv", delimiter=",", names=True)
    assert table["greatest"].max() == pytest.approx(pressures[greatest], rel=1e-8)
    assert (table["least"] <= table["greatest"]).all() and set(table["greatestRow"][table["greatest"] > 0]) <= {1, 2, 3}
    assert table["greatestRow"][table["greatest"].argmax()] == [*loads].index(greatest) + 1
    line = next(line for line in said.split("\n") if line.strip().startswith("storm"))
    normal, error = re.search(r"storm +([0-9.]+) ± ([0-9.]+)", line).groups()
    assert float(normal) == pytest.approx(single["storm"]["contacts"][0]["normalForce"], rel=1e-3) and float(error) > 0
    assert re.search(rf"greatest in +\w+ +{greatest} ", said) and "normal force, N/mm" in said
    assert not re.search("-vary|none", said)


def test_superposition(tmp_path):
    """Where the contact is glued a combination is the sum of its load cases times their factors."""
    text = LOAD_CASES.replace("contact top round", "tie round top\nmove head 0 0").replace(
        "load case wind", "load case wind\nmove head 0.01 0.02"
    )
    of = Problem(tmp_path, text.replace("pressure head", "pressure side"))
    rows, _ = of.rows("-estimate", 0)
    values = []
    for row in rows:
        s = row["summary"]
        values.append(
            [
                *s["bodies"][0]["motion"],
                *s["bodies"][1]["motion"],
                *s["contacts"][0]["force"],
                *s["supports"][0]["force"],
            ]
        )
    dead, wind, storm = np.array(values)
    assert storm == pytest.approx(1.35 * dead + 1.5 * wind, rel=1e-9, abs=1e-9 * np.abs(storm).max())
    assert all(np.abs(one).max() > 0.1 for one in (dead, wind))


def test_rows_that_fail(tmp_path):
    """Rows that are refused late, or do not converge, have the code of their own runs; the others are solved."""
    of = Problem(tmp_path, "contact top round law power kappa 1e5 m 3 d0 -0.1\ntraction head 0 -1\n")
    rows, said = of.rows(
        "-estimate", 0, table="traction.head.x,traction.head.y,maxNewton\n0,-1,\n0,-1,1\n1,-1,\n0,-2,\n", expect=20
    )
    assert [row["code"] for row in rows] == [0, 20, 10, 0] and "2 of 4 solved" in said
    assert "a load works on it" in rows[2]["message"] or "nothing resists" in rows[2]["message"]
    force = [row["summary"]["contacts"][0]["normalForce"] for row in rows if row["code"] == 0]
    assert force == pytest.approx([2, 4], rel=1e-9)


@pytest.mark.parametrize(
    ("case", "flags", "message"),
    [
        (
            "contact top round\nmove head 0 -0.1\n",
            ["-vary", "body.lower.E 1 2"],
            "column body.lower.E: no number that a row may change",
        ),
        ("contact top round\nmove head 0 -0.1\n", ["-vary", "h 1 2"], "-vary: column h: "),
        (
            "contact top round\nmove head 0 -0.1\n",
            ["-vary", "move.head.y -1 -2", "-distance", "exact"],
            "-distance exact: not with a table",
        ),
        (
            "contact top round\nrotate head 0 0 0.1\n",
            ["-vary", "contact.top.round.interference 1 2"],
            "-vary: not with rotate",
        ),
        (
            "contact top round\nleg 1\nmove head 0 -0.1\nleg 1\nmove head 0 0\n",
            ["-vary", "tol 1e-6 1e-7"],
            "-vary: not with several legs",
        ),
        (LOAD_CASES + "move head 0 1\n", [], "move: after combine; allowed: combinations at the end"),
        (
            "clamp head\nplastic lower 1 1\n" + LOAD_CASES.replace("pressure head", "pressure side"),
            [],
            "load case: not with plastic",
        ),
    ],
    ids=["stiffness", "mesh", "exact", "rotate", "legs", "grammar", "plastic"],
)
def test_refusals(tmp_path, case, flags, message):
    """One line, exit code 10, nothing written."""
    of = Problem(tmp_path, case)
    done = of.run(of.case, "rows", *flags, expect=10)
    assert message in done.stdout.strip().split("\n")[-1] and not (tmp_path / "rows").exists()
