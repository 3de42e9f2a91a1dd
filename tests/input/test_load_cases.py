"""The reader's load cases and rows: the case that each of them is, names of numbers, refusals."""

import pytest
from reader import Group, Refusal, Where, read_case
from reader import grammar as g
from reader.rows import LoadCases, Table, load_cases, places, row_lines, write_rows
from reader.words import split_case

GROUPS = [Group(1, name) for name in ("top", "round", "base", "head", "flank")] + [Group(2, "lower"), Group(2, "upper")]
COMMON = """body lower E 100 nu 0.3 density 2
body upper E 200 nu 0.3
contact top round friction 0.2 interference 0.01 law power kappa 1e4 m 2 d0 -0.02
clamp base
move head 0 -0.05
"""
CASES = f"""{COMMON}load case dead
gravity 0 -10
pressure flank 3
load case wind  # from the left
pressure flank -1
move head 0.02 -0.01
traction flank 4 0
combine storm 1.35 dead + 1.5 wind
combine both dead wind
combine less 2 dead -0.5 wind
"""


def split(text, **where):
    return load_cases(split_case(text, lambda word: ""), Where(**where))


def numbers(of, name):
    """Gravity, pressure, traction and move of a load case as the reader hands them over."""
    made = read_case("\n".join(" ".join(line.words) for line in of.lines(name)), Where(cases=True), GROUPS)
    (weight,), (pressure,), (traction,), (move,) = (
        made.of(kind) for kind in (g.Gravity, g.Pressure, g.Traction, g.Move)
    )
    return weight.value[1], pressure.value, traction.value[0], move.by[0], move.by[1]


def test_cases_are_sums():
    """A load is 0 in the load cases that do not state it, a motion that of all; combinations multiply both."""
    of = split(CASES)
    assert of.names == ["dead", "wind", "storm", "both", "less"]
    for name, expected in {
        "dead": (-10, 3, 0, 0, -0.05),
        "wind": (0, -1, 4, 0.02, -0.01),
        "storm": (-13.5, 4.05 - 1.5, 6, 0.03, -0.015),
        "both": (-10, 2, 4, 0.02, -0.01),
        "less": (-20, 6.5, -2, -0.01, 0.005),
    }.items():
        assert numbers(of, name) == pytest.approx(expected, abs=1e-15), name


def test_names_of_numbers():
    """Each number that a row may change has the name of its line, once; others have none."""
    plane, space = Where(), Where(space=True)
    for line, where, expected in (
        ("pressure top 12", plane, {"pressure.top": 2}),
        ("traction top 0 0 -5", space, {f"traction.top.{axis}": 2 + k for k, axis in enumerate("xyz")}),
        ("move head * -0.05", plane, {"move.head.y": 3}),
        ("gravity 0 -9.81", plane, {"gravity.x": 1, "gravity.y": 2}),
        ("expand ring 12e-6 -180", plane, {"expand.ring": 3}),
        ("preload cut torque 5 pitch 1 thread 5 0.1 head 8 0.1", plane, {}),
        ("preload cut 8000", plane, {"preload.cut": 2}),
        ("body lower E 100 nu 0.3", plane, {}),
        ("clamp base", plane, {}),
        ("spring base 1 2", plane, {}),
        ("contact a b", plane, {"contact.a.b.interference": 4}),
        (
            "contact a b law power kappa 1e3 m 3 d0 -1 friction 0.1 limit 5",
            plane,
            {"contact.a.b.kappa": 6, "contact.a.b.m": 8, "contact.a.b.d0": 10, "contact.a.b.friction": 12}
            | {"contact.a.b.limit": 14, "contact.a.b.interference": 16},
        ),
        ("contact friction kappa interference 3", plane, {"contact.friction.kappa.interference": 4}),
        (
            "obstacle top sphere 0 0 12 R 10 move 0 0 -0.1",
            space,
            {f"obstacle.top.move.{axis}": 9 + k for k, axis in enumerate("xyz")} | {"obstacle.top.interference": 13},
        ),
        ("join a b contact friction 0.3", plane, {"join.a.b.friction": 5}),
    ):
        assert places(split_case(line, str)[0], where) == expected, line


def test_row_is_the_edited_file():
    """A row's lines are those of a file with the cells in place of the numbers; an empty cell leaves them."""
    of = split(COMMON)
    names = ["move.head.y", "contact.top.round.kappa", "contact.top.round.interference"]
    texts = [" ".join(line.words) for line in row_lines(of, names, ["-1", "", "0.5"])]
    edited = COMMON.replace("-0.05", "-1").replace("interference 0.01", "interference 0.5")
    assert texts == [" ".join(line.split()) for line in edited.strip().split("\n")]
    assert [
        line.words[-2:] for line in row_lines(split("contact top round"), ["contact.top.round.interference"], ["2"])
    ] == [["interference", "2"]]


def rows_of(tmp_path, text, names, cells):
    """The first lines of the files of rows: why each is refused, or nothing."""
    (tmp_path / "table").write_text(
        "\n".join([f"{len(names)} {len(cells)}", *names, *(c for row in cells for c in row)])
    )
    base = read_case(text, Where(), GROUPS)
    write_rows(tmp_path / "table", tmp_path, "F", text, base, GROUPS, base.used(), {})
    assert not (tmp_path / "table").exists()
    return [(tmp_path / f"row-{k}").read_text().split("\n")[0] for k in range(len(cells))]


def test_rows_are_refused_one_by_one(tmp_path):
    """A row with a wrong number says so in the words of the file; the others are written."""
    names = ["contact.top.round.friction", "move.head.y"]
    why = rows_of(tmp_path, COMMON, names, [["0.3", "1"], ["-1", "1"], ["0", ""], ["", "a"]])
    assert why[0] == "" and "friction 1 " not in why[0]
    assert (
        why[1]
        == "-case F, line 3: -1: the coefficient of friction is out of range; allowed: at least 0 and below 1000000"
    )
    assert why[2] == "-case F, line 3: friction: 0 in some rows; allowed: above 0 in the file and in all rows"
    assert why[3].startswith("-case F, line 5: a: the move is no number")
    made = (tmp_path / "row-0").read_text()
    assert "friction.coefficient 0.29999999999999999" in made and "by.y 1\n" in made


def test_guided_forces_keep_their_direction(tmp_path):
    """Another size is a load; another direction or sign would guide the group along another line."""
    text = COMMON.replace("move head 0 -0.05", "force head 0 -8")
    why = rows_of(tmp_path, text, ["force.head.x", "force.head.y"], [["", "-3"], ["1", ""], ["", "3"], ["", "0"]])
    assert why[0] == ""
    assert all("it guides its group along the force of the file" in one for one in why[1:3])
    assert "the force is 0 in every direction" in why[3]


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (
            ["body.lower.E"],
            "column body.lower.E: no number that a row may change: all rows have one mesh and stiffness",
        ),
        (["move.haed.y"], "column move.haed.y: no number of a statement; did you mean move.head.y?"),
        (["case"], "column case: the file has no load case"),
    ],
    ids=["stiffness", "misspelt", "no-case"],
)
def test_columns_are_refused(tmp_path, names, message):
    with pytest.raises(Refusal) as refused:
        rows_of(tmp_path, COMMON, names, [["1"]])
    assert str(refused.value).startswith(message) and "; allowed: " in str(refused.value)


def test_twice_the_same_name(tmp_path):
    text = COMMON + "obstacle head plane 0 9 0 -1 move 0 0\nobstacle head plane 0 8 0 -1 move 0 0\n"
    text = text.replace("move head 0 -0.05\n", "")
    with pytest.raises(Refusal, match="2 lines have this name"):
        rows_of(tmp_path, text, ["obstacle.head.move.y"], [["1"]])


BLOCK = COMMON + "load case one\n"


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        (
            f"{BLOCK}clamp flank\n",
            7,
            "clamp: in load case one, but it holds in all; allowed before the first load case",
        ),
        (
            f"{BLOCK}force flank 1 0\n",
            7,
            "force flank: its group would be held in all load cases; allowed: force flank ... free",
        ),
        (f"{BLOCK}force flank 1 0 rigid\n", 7, "force flank: its group would be held in all load cases"),
        (f"{BLOCK}moment flank 1 rigid\n", 7, "moment flank: its group would be rigid in all load cases"),
        (
            f"{BLOCK}move flank 1 0\n",
            7,
            "move flank: it holds in all load cases; allowed: also before the first one, with the "
            "motion of the others, as move flank 0 0",
        ),
        (f"{BLOCK}obstacle flank move 1 0\n", 7, "obstacle flank: it holds in all load cases"),
        (
            f"pressure flank 2\n{BLOCK}pressure flank 1\n",
            8,
            "pressure flank: also in line 1, in all load cases; allowed: one of them",
        ),
        (
            f"{BLOCK}pressure flank 1\npressure flank 2\n",
            8,
            "pressure flank: stated before in load case one, in line 7",
        ),
        (f"{BLOCK}pressure flank a\n", 7, "a: the pressure is no number"),
        (f"{BLOCK}pressure flink 1\n", 7, "flink: no physical curve of the mesh"),
        (f"{BLOCK}load case one\n", 7, "one: a load case or combination before has this name"),
        (f"{BLOCK}load one\n", 7, "one: not allowed here; allowed: load case NAME"),
        (f"{BLOCK}load case a,b\n", 7, "a,b: a name; allowed: letters, digits, - and _"),
        (f"{BLOCK}combine two 1.5 oen\n", 7, "oen: no load case; did you mean one? allowed: one"),
        (f"{BLOCK}combine two 1.5\n", 7, "a load case is missing after 1.5"),
        (f"{BLOCK}combine two 1.5 one 2 one\n", 7, "combine two: one load case twice; allowed: once"),
        (f"{BLOCK}combine two one\npressure flank 1\n", 8, "pressure: after combine; allowed: combinations at the end"),
        (f"{COMMON}combine two 1.5 one\n", 6, "one: no load case; allowed: load cases before it"),
        (f"{COMMON}leg 3\nload case one\npressure flank 1\n", 6, "leg: with load cases; allowed: one of them"),
        (f"{COMMON}gravity 0 0\n", 6, "the gravity is 0 in every direction"),
    ],
)
def test_wrong_load_cases(text, line, message):
    with pytest.raises(Refusal) as refused:
        read_case(text, Where(), GROUPS)
    assert refused.value.line == line and str(refused.value).startswith(message)


def test_the_model_has_all_loads():
    """What the run checks and pairs is the case with all loads, each once; its load cases are known by name."""
    case = read_case(CASES, Where(), GROUPS)
    assert case.load_cases == ["dead", "wind", "storm", "both", "less"]
    assert [s.word for s in case.statements][5:] == ["gravity", "pressure", "traction"]
    assert LoadCases(Where()).names == [] and Table(["a"], [["1"]]).names == ["a"]
