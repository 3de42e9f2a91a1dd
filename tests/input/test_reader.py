"""The reader of case files: typed statements, refusals, rules between statements, modules. Function calls alone."""

import re

import numpy as np
import pytest
from freefem import data
from reader import Group, Refusal, Where, read_case
from reader import grammar as g
from reader.fields import STATEMENTS, Statement, boundary, number, option, shown, usage
from reader.modules import Run, modules, needs
from reader.rigid.shapes import Ball
from reader.values import table
from reader.words import distance, nearest, split_line

PLANE = [Group(2, "block"), *(Group(1, name) for name in ("bottom", "right", "top", "left"))]
SPACE = [Group(3, "block"), *(Group(2, name) for name in ("bottom", "right", "top", "left"))]
TWO = [Group(2, "a"), Group(2, "b"), *(Group(1, name) for name in ("a-top", "b-bottom", "b-top", "a-bottom"))]
STEEL = "body block E 100 nu 0.3\n"
GOOD = f"{STEEL}clamp bottom\nobstacle top circle 1.5 5 R 3 move 0 -0.1\n"
GOOD_SPACE = f"{STEEL}clamp bottom\nobstacle top sphere 0 0 9 R 3 move 0 0 -0.1\n"
LEGS = f"{GOOD}pressure right 2\nleg 4\n"


def read(text, mesh=None, **where):
    space = where.get("space", False)
    where["bodies"] = dict.fromkeys(map(int, where.get("bodies", "").split()), "") | where.pop("labels", {})
    return read_case(text, Where(**where), (SPACE if space else PLANE) if mesh is None else mesh)


def refused(text, mesh=None, **where):
    with pytest.raises(Refusal) as found:
        read(text, mesh, **where)
    return found.value.text("a.case")


def only(case, kind):
    (found,) = case.of(kind)
    return found


def said(case, *splits):
    """The statements as FreeFEM reads them: word, line, labels of its groups, what it changes, values by name."""
    lines = table(case, *splits).splitlines()
    at = next(k for k, line in enumerate(lines) if line.startswith("statements ")) + 1
    found = []
    while at < len(lines):
        word, line, first, second, changes, numbers, texts = lines[at].split()
        values = dict(line.split(" ", 1) for line in lines[at + 1 : at + 1 + int(numbers) + int(texts)])
        for name in list(values)[: int(numbers)]:
            values[name] = float(values[name])
        found.append((word, int(line), (int(first), int(second)), int(changes), values))
        at += 1 + len(values)
    assert len(found) == int(next(line for line in lines if line.startswith("statements ")).split()[1])
    return found


def vector(values, name):
    return [values[f"{name}.{axis}"] for axis in "xyz"]


def test_before_the_mesh():
    """Where the groups are not known, any name is one, and every other mistake is refused; `where` stays as it is."""
    where = Where()
    case = read_case(f"{LEGS.replace('bottom', 'anything')}size one 1\nsize other 2\nsize contact 3\n", where, None)
    assert [str(s.on) for s in case.of(g.Clamp)] == ["anything"] and len(case.of(g.Size)) == 3
    assert (where.phase, case.where.phase) == (0, 1)
    for text in ("clmp top", "clamp", f"{GOOD}clamp bottom", f"{STEEL}clamp bottom", "body block E x nu 0.3"):
        with pytest.raises(Refusal) as before:
            read_case(text, Where(), None)
        assert before.value.text("a.case") == refused(text)


# ---------------------------------------------------------------- words


def test_words_of_a_line():
    """Blanks, quotes, comments, ends of lines of other systems."""
    line = split_line(7, '\t clamp  "two words"#x "y"\r', usage=str)
    assert (line.number, line.words) == (7, ["clamp", "two words"])
    assert split_line(1, "  # nothing", usage=str).words == []
    assert split_line(1, '"two words"\r', usage=str).words == ["two words"]
    assert len(read(f"\ufeff{GOOD}").statements) == 3


def test_distances():
    """Letters put in, left out, replaced, exchanged; a guess that is near enough."""
    pairs = [("clamp", "clamp"), ("clamp", "clampp"), ("clamp", "camp"), ("clamp", "clomp"), ("clamp", "clapm")]
    assert [distance(a, b) for a, b in pairs] == [0, 1, 1, 1, 1]
    assert distance("", "abc") == 3
    assert nearest("LFET", ["right", "left"]) == "left"
    assert nearest("xyz", ["right", "left"]) == ""
    assert nearest("l" * 41, ["l" * 42]) == ""
    assert nearest("ab", ["cd"]) == "" and nearest("abcd", ["abxy"]) == "abxy"


@pytest.mark.parametrize(
    "text, value", [("5", 5), ("+.5e1", 5), ("5.", 5), ("1e-40", 1e-40), ("-1e40", -1e40), ("0e99", 0)]
)
def test_numbers(text, value):
    assert only(read(f"{GOOD}pressure right {text}"), g.Pressure).value == value


@pytest.mark.parametrize("text", ["nan", "inf", "0x10", "1e", "1,5", "--3", "1_000", "٣", "5e+"])
def test_no_numbers(text):
    assert f"line 4: {text}: the pressure is no number; allowed: pressure NAME" in refused(
        f"{GOOD}pressure right {text}"
    )


def test_control_characters_and_length_of_refusals():
    said = refused(f"{GOOD}\x1b[31m")
    assert "\x1b" not in said and "a control character" in said
    said = refused(GOOD + "x" * 9000)
    assert len(said) < 3100 and " ... " in said and said.endswith("cycles, time, leg")


# ---------------------------------------------------------------- refusals


def changes():
    """(case, words) of each "change | words" of the data: lines behind the good case, before it, or old => new."""
    for line in data("parts/refused.txt").strip().splitlines():
        change, words = line.split(" | ")
        old, _, new = change.partition(" => ")
        lines = change[2:].replace(" / ", "\n")
        yield {"+ ": GOOD + lines, "- ": f"{lines}\n{GOOD}"}.get(change[:2], GOOD.replace(old, new)), words


@pytest.mark.parametrize("case, words", [change for change in changes() if "1 words after it" not in change[1]])
def test_mistakes(case, words):
    said = refused(case)
    assert said.startswith("-case a.case, ") and words in said and "allowed" in said and "\n" not in said


REFUSED = """
units mm | a unit of pressure is missing after mm; allowed: units LENGTH PRESSURE
state | a word is missing after state; allowed: state strain
gravity 0 -9 | line 4: gravity: no body has a density; allowed: body NAME E
spin block 5 | spin block: the body has no density; allowed: body block E
moment left 0 | moment left: 0; allowed: another number
force left 0 -1 at 0 0 | at: free or rigid must stand before it; allowed: force NAME
force left 0 -1 2 | 2: force has 3 numbers, more than the 2 components there are
force left 0 0 free | the force is 0 in every direction
spring left 0 0 | spring left: no stiffness; allowed: one above 0
spring left -1 0 | -1: the stiffness is out of range; allowed: at least 0
spring bottom 1 1 | bottom: a spring on what line 2 holds (clamp) does nothing
force bottom 0 1 free | bottom: a free force on what line 2 holds (clamp) does nothing
force bottom 0 1 rigid | bottom: force after clamp in line 2
line a.b 0 0 1 1 | a.b: a name for files; allowed: letters, digits, - and _
line a 0 1 0 1 | line a: begins where it ends; allowed: line NAME x y x y
temperature left 3 | line 4: a temperature, flux, film, source or time, and no body conducts
conduct block 3 | conduct, and no temperature anywhere
conduct block 3 / temperature left 1 / flux left 2 | line 6: left: a flux or film where line 5 gives the temperature
conduct block 3 / film left 1 1 / expand block 1 1 | line 6: expand with conduct; allowed: conduct block k expand
conduct block 3 / film left 1 1 / preload right 1 | line 6: preload with conduct
cycles 10 | line 4: cycles without wear
cycles 10 steps 2.5 | 2.5: no whole number of wear steps
obstacle right plane 4 0 -1 0 wear 1e-3 | wear: no sliding distance and no friction
obstacle right plane 4 0 -1 0 wear 1e-3 slide 2 | line 4: wear without cycles
obstacle right plane 4 0 -1 0 wear 1 slide 2 friction 0.1 | wear: slide with friction, whose slip is computed
obstacle right plane 4 0 -1 0 wear 1 slide 2 law barrier p0 1 d0 -1 | wear: with the law barrier
obstacle right plane 4 0 -1 0 wear 1 from no.csv | no.csv: no such file; allowed: the worn.csv
contact left right gap vertical / obstacle left plane 9 0 -1 0 | left: gap along its normals, in line 4 it is not
contact left right gap vertical wear 1 slide 2 | left: gap vertical with wear
contact left right conductance 3 | line 4: a conductance, and no body conducts
contact left right interference 1 interference 2 | interference: not allowed here; allowed: contact SLAVE
contact left right law power kappa 1 m 2 d0 0 | 0: d0 is out of range; allowed: below 0
contact left right law | a law's name is missing; allowed: power kappa m d0
obstacle top move 0 1 | obstacle top: move without a shape; allowed: move behind the shape in line 3, where that of
obstacle left law signorini | obstacle left: law without a shape; allowed: a shape before it, as obstacle top
group g curves | numbers are missing after curves
group g curves 1.5 | 1.5: not the number of one of the curves
group g faces 1 | faces: unknown; a case in space is run by edp/parts-3d.edp; allowed: group NAME
group g between block block | block: twice the same body
group left near 0 0 | left: the mesh or geometry has a group of this name
group g near 0 0 / group g near 1 1 | line 5: group g: stated before, in line 4
size nowhere 1 | nowhere: no physical curve of the mesh; allowed: bottom
size left 1 / size left 2 | line 5: size of left: stated before
cut c block plane 0 0 0 0 | the normal is 0 in every direction
cut c block plane 0 0 0 1 | line 4: cut c: nothing tightens it; allowed: a line preload c force
cut left block plane 0 0 0 1 | left: the mesh or geometry has a group of this name
contact left right gap 0.1 | gap: a gap that conducts stands behind a conductance; allowed: conductance h0 gap k
contact left right gap | gap: a gap that conducts stands behind a conductance
conduct block 1 start 20 / film left 1 1 | start: a temperature at the start stands behind a heat capacity
conduct block 1 from 20 / film left 1 1 | from: a temperature without stress stands behind an expansion
obstacle left polygon 0 4 3 4 3 5 1 | polygon: 7 numbers, of which the last has no partner; allowed: x and y
obstacle left polygon 0 4 3 round 1 | polygon: 3 numbers, of which the last has no partner
tighten left | line 4: tighten left: has no preload; allowed: a line preload left force
tighten to 0.5 | to: no physical curve of the mesh
tighten left to 0 | 0: the fraction of the preload is out of range; allowed: above 0 and below 10
preload left 1 / preload right 1 / tighten left | line 5: preload right: no line tighten names it; allowed: all preloads
preload left 1 / leg 2 / leg 2 / tighten left | line 7: tighten: in leg 2, but it holds in every leg
join block block tie | block: twice the same body
join block | a name is missing after block
leg 2.5 | 2.5: no whole number of steps
weld left | join BODY BODY part makes two bodies
mu 0.3 | mu: unknown statement; it stands behind a contact or an obstacle
Bolts left 3 | did you mean preload (a shank pulled together)?
"" left | "": an empty name; allowed: units, state
"""
REFUSED = [line.split(" | ") for line in REFUSED.strip().splitlines()]


@pytest.mark.parametrize("lines, words", REFUSED)
def test_more_mistakes(lines, words):
    assert words in refused(GOOD + lines.replace(" / ", "\n"))


AXISYMMETRIC = """
rotate left 0 0 1 | rotate: a ring cannot turn
moment left 1 | moment: a ring does not turn
about p 0 0 | about: a ring has no moments
weight block 1 0 | block: a weight off the axis; allowed with state axisymmetric: along y
force left 1 0 | left: a force off the axis
force left 0 1 rigid | rigid: a ring moves along its axis alone
force left 0 1 free at 0 0 | at: a ring has its force on the axis
obstacle left plane 0 0 1 0 move 1 0 | obstacle: a move off the axis
gravity 1 0 | gravity off the axis
cut c block plane 0 0 1 0 | cut c: a plane that is not across the axis
spin block 1 about 0 0 | about: more than the statement takes
"""
AXISYMMETRIC = [line.split(" | ") for line in AXISYMMETRIC.strip().splitlines()]


@pytest.mark.parametrize("line, words", AXISYMMETRIC)
def test_rings(line, words):
    """What state axisymmetric excludes; the plane does not, but for the spin about a point."""
    assert words in refused(f"state axisymmetric\n{GOOD}{line}")
    try:
        read(
            f"body block E 100 nu 0.3 density 1\n{GOOD.removeprefix(STEEL)}{line}\npreload c 1"
            if "cut" in line
            else GOOD + line
        )
    except Refusal as refusal:
        assert words not in str(refusal)


PHASES = """
clamp left | clamp: in leg 2, but it holds in every leg; allowed there: move, rotate
pressure left 1 | pressure left: first stated in leg 2; allowed: also behind the first leg in line 5: pressure left 0
pressure right 1 / pressure right 2 | pressure of right in leg 2: stated before, in line 7
obstacle top circle 1.5 5 R 3 | no move here or in line 3
obstacle top circle 1.5 5 R 3 force 0 -1 | this obstacle of top: stated before, in line 3
obstacle top circle 1.5 5 R 3 friction 0.1 move 0 1 | law, friction or interference unlike line 3
obstacle top circle 1.5 5 R 4 move 0 1 | obstacle top: first stated in leg 2
obstacle left move 0 1 | obstacle left: 0 obstacles of it
force left 0 1 rigid | left: a rigid group's force in two legs; allowed there: a force that is free
force left 0 1 free | force left: first stated in leg 2
"""
PHASES = [line.split(" | ") for line in PHASES.strip().splitlines()]


@pytest.mark.parametrize("lines, words", PHASES)
def test_later_load_phases(lines, words):
    assert words in refused(f"{LEGS}leg 4\n" + lines.replace(" / ", "\n"))


@pytest.mark.parametrize("first", ["traction left 0 1", "weight block 0 1", "move right 0 1", "rotate right 0 0 1"])
def test_what_later_phases_change(first):
    """A load or a motion of the first phase, with other values."""
    case = read(f"{GOOD}leg 1\n{first}\nleg 1\n{first.replace('1', '2')}")
    assert case.statements[-1].changes is case.statements[-3]


def test_quoted_words_before_it_is_there():
    """A refusal shows the line as it must stand in the first phase: numbers of a name stay."""
    mesh = [*PLANE, Group(1, "5")]
    assert refused(f"{LEGS}leg 1\nmove 5 1 2", mesh).endswith("in line 5: move 5 0 0")
    assert refused(f"{LEGS}leg 1\nrotate left 1 2 3", mesh).endswith("in line 5: rotate left 1 2 0")


def test_first_load_phase():
    """It begins with nothing: what stands before it may not be stated in it again."""
    assert "pressure of right in line 4, before the first leg, and again in it" in refused(f"{LEGS}pressure right 3")
    moved = f"{STEEL}move bottom 0 1\nobstacle top plane 0 3 0 -1\nleg 2\nmove bottom 0 1"
    assert "move bottom in line 2, before the first leg, and again in it" in refused(moved)
    assert "force left: 0 of a rigid group" in refused(f"{LEGS}force left 0 0 rigid")
    read(f"{LEGS}force left 0 0 free\n")


ALONG_AXES = """
clamp left z | z: more than the statement takes; allowed: clamp NAME [x] [y], as clamp base
clamp left x x | x: stated before in this line; allowed: once
clamp left xy | xy: more than the statement takes
clamp left x / clamp left x | line 5: left: clamp after clamp along x in line 4; allowed: only one of clamp
clamp left x / move left 1 * | line 5: left: move after clamp along x in line 4
clamp left x / move left 1 2 | line 5: left: move after clamp along x in line 4
clamp left / move left * 2 | line 5: left: move after clamp along y in line 4
move left * 1 / clamp left y x | line 5: left: clamp after move along y in line 4
clamp left x / symmetry left | line 5: left: symmetry after clamp along x in line 4
clamp left x / rotate left 0 0 1 | line 5: left: rotate after clamp along x in line 4
clamp left x / force left 0 1 | line 5: left: force after clamp along x in line 4
move left * * | every component is free; allowed: move NAME x y, or * for a component that is left free, as move grip
move left 1 | the move is missing after 1
move left 1 * * | *: move has 3 numbers, more than the 2 components there are
clamp left y 1 | 1: more than the statement takes
move left * 1 2 | 2: move has 3 numbers, more than the 2 components there are
traction left * 1 | *: the traction is no number
clamp left y / move left 1 * / pressure left 1 | line 6: left: a pressure on what line 4 holds (clamp) does nothing
clamp left x / contact left right | line 5: left: a slave that line 4 holds (clamp); allowed: the other surface
roller left | did you mean clamp (no displacement, or none along axes)? allowed
"""


@pytest.mark.parametrize("lines, words", [line.split(" | ") for line in ALONG_AXES.strip().splitlines()])
def test_supports_along_axes_are_refused(lines, words):
    assert words in refused(GOOD + lines.replace(" / ", "\n"))


def test_supports_along_axes():
    """Of one group each component once; loads act on what is free; later phases change the same components."""
    case = read(f"{GOOD}clamp left y\nmove left 1 *\nmove right * 2\npressure right 3\nspring right 1 0")
    assert [s.only for s in (*case.of(g.Clamp), *case.of(g.Move))] == ["", "y", "x", "y"]
    case = read(f"{GOOD_SPACE}clamp left z x\nmove left * 2 *\nmove right 1 * 3\nclamp right y", space=True)
    assert [s.only for s in (*case.of(g.Clamp), *case.of(g.Move))] == ["", "xz", "y", "y", "xz"]
    first = f"{GOOD}leg 1\nmove left 0 *\nmove left * 1\nmove right * 0\nleg 2\nmove left * 3\nmove left 2 *\n"
    case = read(first)
    assert [s.changes.line for s in case.statements if s.changes] == [6, 5]
    assert [values for word, *_, values in said(case) if word == "change"] == [
        {"by.x": 0, "by.y": 3, "by.z": 0},
        {"by.x": 2, "by.y": 0, "by.z": 0},
    ]
    assert "move right: other components than in line 7; allowed: those of that line" in refused(
        f"{first}move right 1 2"
    )
    assert "in line 4: move right 0 *" in refused(f"{GOOD}leg 1\nleg 1\nmove right 1 *")
    assert "move of left in leg 2: stated before, in line 9; allowed: once" in refused(f"{first}move left * 4")


SCRIPTS = [
    ({"friction": ""}, "contact left right friction 0.1", "friction: read by parts.edp and parts-3d.edp alone"),
    ({"friction": ""}, "leg 3", "leg: read by parts.edp and parts-3d.edp alone"),
    ({"friction": ""}, "tie left right", "tie: read by parts.edp"),
    ({"friction": "-distance exact"}, "tie left right", "tie: not with -distance exact; allowed: -distance linear"),
    ({"wear": False}, "contact left right wear 1 slide 2", "wear: read by parts.edp and parts-3d.edp alone"),
    ({"plastic": False}, "plastic block 1 1", "plastic: read by parts.edp and parts-3d.edp alone"),
]


@pytest.mark.parametrize("where, line, words", SCRIPTS)
def test_other_scripts(where, line, words):
    """What a script does not read is refused there."""
    assert words in refused(GOOD + line, **where)


def test_not_in_space():
    for line in ("state strain", "thickness 3"):
        assert f"{line.split()[0]}: only in the plane" in refused(f"{line}\n{GOOD_SPACE}", space=True)
    both = f"{GOOD_SPACE}contact left right gap vertical"
    assert "left: gap vertical, in line 3 it is not; allowed: one way for all contacts" in refused(both, space=True)


def test_whole_case():
    """What is missing, and what does nothing."""
    assert refused("") == "-case a.case, it has no statement; allowed: at least body and contact or obstacle"
    assert "no contact; allowed: at least one line" in refused(f"{STEEL}clamp bottom")
    assert "nothing says what the surface block is made of" in refused("clamp bottom\ncontact top left")
    assert "line 3: top: a slave that line 2 holds (clamp)" in refused(f"{STEEL}clamp top\ncontact top left")
    read("clamp bottom\ncontact top left", overlap=True)
    assert "more than 1000 statements" in refused(
        GOOD + "about p 0 0\n" + "\n".join(f"line l{k} 0 0 1 1" for k in range(997))
    )
    read(GOOD + "\n".join(f"line l{k} 0 0 1 1" for k in range(997)))


def test_gravity_and_weights():
    dense = GOOD.replace("nu 0.3", "nu 0.3 density 2") + "gravity 1 -9\n"
    assert "gravity, and a weight of block in line 5" in refused(f"{dense}weight block 0 1")
    ((_, line, *_, values),) = [row for row in said(read(dense)) if row[0] == "weight"]
    assert vector(values, "value") == [2, -18, 0] and line == 4


def test_wear_by_friction():
    """It needs a cycle of load phases, and is the one kind of wear in a case."""
    worn = f"{GOOD}contact left right wear 1e-3 friction 0.2\ncycles 10\n"
    assert "line 4: wear by friction without a cycle" in refused(f"{worn}leg 2")
    read(f"{worn}leg 2\nleg 2")
    both = f"{worn}obstacle right plane 4 0 -1 0 wear 1 slide 2\nleg 2\nleg 2"
    assert "line 6: wear with slide, in line 4 wear by friction" in refused(both)


def test_heat_of_all_bodies():
    two = "body a E 1 nu 0\nbody b E 1 nu 0\ncontact a-top b-bottom\nconduct a 1\ntemperature a-bottom 3\n"
    assert "line 2: b: nothing says how it conducts" in refused(two, TWO)
    read(f"{two}conduct b 1", TWO)


# ---------------------------------------------------------------- values


def test_values_have_names():
    """Of a case with every kind of value."""
    case = read(
        "units mm MPa\nthickness 2.5\nbody block E 210e3 nu .3 density 8e-9 yield 350\nclamp bottom\n"
        "obstacle top circle 0 12 R 10 inside interference 0.01 law power kappa 1e6 m 3 d0 -0.001 move 0 -0.1\n"
        "contact left right friction 0.15 limit 9 compliance 2 conductance 3 hardness 4\nforce left 1 2 free at 3 4\n"
        "conduct block 5 expand 6 from 7\nfilm right 8 9\n"
    )
    assert (case.units, case.thickness, case.where.state) == ("mm MPa", 2.5, "strain")
    body = only(case, g.Body)
    assert (str(body.on), body.E, body.nu, body.density, body.yield_stress, body.line) == (
        "block",
        210e3,
        0.3,
        8e-9,
        350,
        3,
    )
    obstacle = only(case, g.Obstacle)
    assert isinstance(obstacle.shape, Ball) and isinstance(obstacle.drive, g.Moved)
    assert (obstacle.shape.place, obstacle.shape.radius, obstacle.shape.inside) == ((0, 12, 0), 10, True)
    assert (obstacle.drive.by, obstacle.interference) == ((0, -0.1, 0), 0.01)
    assert (obstacle.law.name, obstacle.law.kappa, obstacle.law.m, obstacle.law.d0) == ("power", 1e6, 3, -0.001)
    contact = only(case, g.Contact)
    assert (contact.friction.coefficient, contact.friction.compliance, contact.friction.limit) == (0.15, 2, 9)
    assert (contact.conductance.value, contact.conductance.hardness.value, contact.conductance.hardness.exponent) == (
        3,
        4,
        0.95,
    )
    force = only(case, g.Force)
    assert isinstance(force.how, g.Free) and (force.resultant, force.how.at) == ((1, 2, 0), (3, 4, 0))
    conduct = only(case, g.Conduct)
    assert (conduct.conductivity, conduct.expand.coefficient, conduct.expand.stress_free) == (5, 6, 7)
    film = only(case, g.Film)
    assert (film.coefficient, film.around) == (8, 9)
    assert [group.name for group in case.used()] == ["block", "bottom", "top", "left", "right"]


def test_changes_in_later_phases():
    case = read(
        f"{LEGS}leg 6\npressure right 7\nobstacle top move 0 -0.3\n"
        "leg 2\nobstacle top circle 1.5 5 3 move 0 0\npressure right 0"
    )
    changed = [s for s in case.statements if s.changes]
    assert [(type(s), s.line, s.changes.line) for s in changed] == [
        (g.Pressure, 7, 4), (g.ObstacleMove, 8, 3), (g.Obstacle, 10, 3), (g.Pressure, 11, 4),
    ]  # fmt: skip
    assert case.where.phase == 3
    found = [(of, values) for word, _, _, of, values in said(case) if word == "change"]
    assert [of for of, _ in found] == [3, 2, 2, 3]
    assert [values.get("value") for _, values in found] == [7, None, None, 0]
    assert [vector(values, "drive.by") for _, values in found[1:3]] == [[0, -0.3, 0], [0, 0, 0]]
    # a statement that changes another is no load and no obstacle itself: it has no words, only numbers
    assert [list(values) for _, values in found[:2]] == [["value"], ["drive.by.x", "drive.by.y", "drive.by.z"]]


VALUES = """
move left 1 2 | move 4 0 | by 1 2 0
move left * 2 | move 4 0 | by 0 2 0; only y
move left 1 * | move 4 0 | by 1 0 0; only x
clamp left | clamp 4 0 |
clamp left y | clamp 4 0 | only y
clamp left y x | clamp 4 0 |
rotate left 1 2 3 | rotate 4 0 | centre 1 2 0; axis 0 0 1; angle 3
force left 1 2 | force 4 0 | resultant 1 2 0
force left 1 2 free at 3 4 | force 4 0 | resultant 1 2 0; how free; how.at 3 4 0
force left 1 2 rigid | force 4 0 | resultant 1 2 0; how rigid
moment left 5 | moment 4 0 | size 5; how spread; couple 0 0 5
moment left 5 about 1 2 | moment 4 0 | size 5; how about; how.point 1 2 0; couple 0 0 5
spring left 1 2 | spring 4 0 | x 1; y 2; z 0
weight block 1 2 | weight 1 0 | value 1 2 0
expand block 1 -2 | expand 1 0 | coefficient 1; warmer -2
plastic block 3 4 | plastic 1 0 | yield_stress 3; hardening 4; kinematic 0
line l 1 2 3 4 | line 0 0 | name l; begin 1 2 0; end 3 4 0
stresses | stresses 0 0 |
leg 3 | leg 0 0 | steps 3
contact left right gap vertical interference 0.5 | contact 4 5 | vertical 1; interference 0.5
tie left right | tie 4 5 |
"""


@pytest.mark.parametrize(
    "line, head, values", [[cell.strip() for cell in line.split("|")] for line in VALUES.strip().splitlines()]
)
def test_values(line, head, values):
    """What FreeFEM reads of a statement: its word, the labels of its groups, its values by name."""
    word, at, groups, of, found = said(read(GOOD + line))[3]
    assert f"{word} {groups[0]} {groups[1]}" == head and (at, of) == (4, -1)
    expected = {}
    for name, *value in (each.split() for each in values.split(";") if each.strip()):
        numbers = [float(each) if re.fullmatch(r"[-.\d]+", each) else each for each in value]
        expected |= (
            {name: numbers[0]}
            if len(numbers) == 1
            else {f"{name}.{k}": x for k, x in zip("xyz", numbers, strict=False)}
        )
    assert found == expected


def test_values_of_laws_and_obstacles():
    lines = "contact left right law exponential beta 2 p0 3 d0 -4\nobstacle left plane 1 2 3 4 force 5 6"
    contact, obstacle = (values for *_, values in said(read(GOOD + lines))[3:])
    law = {"name": "exponential", "kappa": 0, "m": 0, "p0": 3, "beta": 2, "d0": -4}
    assert {name: contact[f"law.{name}"] for name in law} == law and contact["law"] == "law"
    assert (obstacle["shape"], obstacle["shape.radius"], obstacle["shape.inside"], obstacle["drive"]) == (
        "plane",
        0,
        0,
        "pushed",
    )
    assert [vector(obstacle, f"shape.{name}") for name in ("place", "direction")] == [[1, 2, 0], [3, 4, 0]]
    assert vector(obstacle, "drive.by") == [5, 6, 0]


def test_values_of_heat_and_wear():
    worn = "contact left right friction 0.1 wear 4\ncycles 9\nleg 1\nleg 1"
    found = said(read(GOOD + worn))[3:]
    assert [word for word, *_ in found] == ["contact", "cycles", "leg", "leg"]
    assert (found[0][4]["wear.coefficient"], found[0][4]["wear.slide"], found[1][4]) == (
        4,
        0,
        {"count": 9, "steps": 20},
    )
    friction = {name: found[0][4][f"friction.{name}"] for name in ("coefficient", "compliance", "limit")}
    assert friction == {"coefficient": 0.1, "compliance": 0, "limit": 0} and found[0][4]["friction"] == "friction"
    warm = "contact left right conductance 5 hardness 6 exponent 2\nconduct block 1 expand 2 from 3\nfilm top 1 4"
    contact, conduct, film = (values for *_, values in said(read(GOOD + warm))[3:])
    hard = [contact[f"conductance.{name}"] for name in ("value", "hardness.value", "hardness.exponent")]
    assert hard == [5, 6, 2] and film == {"coefficient": 1, "around": 4}
    assert [conduct[name] for name in ("conductivity", "expand.coefficient", "expand.stress_free")] == [1, 2, 3]


def test_values_in_space():
    """Axes, moments along them, cylinders, spins with the density of their body."""
    dense = GOOD_SPACE.replace("nu 0.3", "nu 0.3 density 2")
    lines = "spin block 7 about 1 2 3 axis 4 5 6\nrotate left 1 2 3 4 5 6 0.5\nmoment right 10 axis 0 3 4\n"
    lines += "obstacle right cylinder 1 2 3 4 5 6 R 7"
    spin, turn, moment, cylinder = (values for *_, values in said(read(dense + lines, space=True))[3:])
    assert (spin["speed"], vector(spin, "about"), vector(spin, "axis"), spin["density"]) == (7, [1, 2, 3], [4, 5, 6], 2)
    assert (vector(turn, "centre"), vector(turn, "axis"), turn["angle"]) == ([1, 2, 3], [4, 5, 6], 0.5)
    assert vector(moment, "couple") == [0, 6, 8]
    assert (cylinder["shape"], vector(cylinder, "shape.direction"), cylinder["shape.radius"]) == (
        "cylinder",
        [4, 5, 6],
        7,
    )
    ring = "state axisymmetric\n" + GOOD.replace("nu 0.3", "nu 0.3 density 2") + "spin block 7"
    assert vector(said(read(ring))[-1][4], "axis") == [0, 1, 0]
    assert vector(said(read(ring.partition("\n")[2]))[-1][4], "axis") == [0, 0, 1]


def test_symmetry_in_several_planes():
    """The groups that it is split into: a statement for each."""
    case = read(GOOD + "symmetry left")
    groups = [*case.used()[:3], Group(1, "left 1"), Group(1, "left 2")]
    found = said(case, groups, {5: 4})
    assert [(word, sides) for word, _, sides, *_ in found[3:]] == [("symmetry", (4, 0)), ("symmetry", (5, 0))]
    assert table(case, groups, {5: 4}).splitlines()[3:9] == [
        "groups 5",
        "2 block",
        "1 bottom",
        "1 top",
        "1 left 1",
        "1 left 2",
    ]


def test_files(tmp_path, monkeypatch):
    """Tables of laws and worn profiles; a folder and an empty file are none."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "law.csv").write_text("0,1\n")
    (tmp_path / "empty.csv").write_text("")
    lines = "contact left right law table law.csv d0 -1\nobstacle right plane 9 0 -1 0 wear 1 slide 2 from law.csv\n"
    contact, obstacle, _ = (values for *_, values in said(read(f"{GOOD}{lines}cycles 5"))[3:])
    assert (contact["law.file"], obstacle["wear.profile"]) == ("law.csv", "law.csv")
    for name in ("empty.csv", ".", "none"):
        assert f"{name}: no such file, or empty" in refused(f"{GOOD}contact left right law table {name} d0 -1")


# ---------------------------------------------------------------- groups of a geometry


def test_groups_that_a_case_picks():
    text = (
        "group shell surfaces 01\ngroup tip near 1 2\ngroup core box 0 0 1 1\nbody shell E 1 nu 0\nbody core E 1 nu 0\n"
        "group wall plane 0 0 0 1\ngroup faces between shell core\ncontact tip wall\nsize contact 0.5\nsize core 2\n"
        "obstacle faces plane 1 2 0 1\n"
    )
    case = read(text, [], bodies="1 2")
    assert [(group.dimension, group.name) for group in case.used()] == [
        (2, "shell"),
        (2, "core"),
        (1, "tip"),
        (1, "wall"),
        (1, "faces"),
    ]


def test_joins_and_cuts():
    """A join becomes a tie or a contact, between groups of its own; a cut is tightened."""
    text = "body a E 1 nu 0\nbody b E 1 nu 0\njoin a b contact friction 0.2\ncut c a plane 0 0 0 1\npreload c 5\n"
    case = read(text, TWO[:2])
    contact = only(case, g.Contact)
    assert (contact.slave.name, contact.master.name, contact.friction.coefficient) == ("a-b", "b-a", 0.2)
    tied = read(text.replace("contact friction 0.2", "tie"), TWO[:2])
    assert [word for word, *_ in said(tied)] == ["body", "body", "tie", "cut", "preload"]
    assert "no contact" in refused(text.replace("contact friction 0.2", "part"), TWO[:2])
    assert "friction: more than the statement takes; allowed: join" in refused(text.replace("contact", "part"), TWO[:2])
    assert "c: a cut or a join has a group of this name" in refused("group c near 0 0\n" + text, TWO[:2])
    assert "join of b and a: stated before, in line 3" in refused(text + "join b a tie", TWO[:2])


def test_bodies_without_names():
    """One body alone needs no group; several need one each."""
    case = read("body pin E 1 nu 0\nobstacle top plane 0 0 0 1\ngroup top curves 3", [], bodies="7")
    assert case.groups.only_body == "pin"
    near = "group top near 0 0\ngroup pin near 1 1\nbody pin E 1 nu 0\nobstacle top plane 0 0 0 1"
    assert read(near, [], bodies="7").groups.only_body == ""
    again = f"group left near 0 0\ngroup block near 0 0\n{GOOD}"
    assert "left: the mesh or geometry has a group of this name" in refused(again)
    read(again, again=True)
    said = refused("body pin E 1 nu 0\nbody rod E 1 nu 0", [], bodies="7 8")
    assert "pin: no body of the geometry has this name; allowed: a line group pin surfaces N ..., of 7 8" in said
    said = refused("body pin E 1 nu 0\nclamp base", [], bodies="7")
    assert (
        "base: no group; allowed: a line group base curves N ... (-check 1 without -case draws their numbers)" in said
    )


# ---------------------------------------------------------------- the grammar


OF_BODIES = {"body", "weight", "expand", "plastic", "conduct", "spin"}
WITH_OTHERS = (
    "load combine preload tighten leg cut join cycles time group units stresses temperature flux film source conduct "
    "spin"
).split()


@pytest.mark.parametrize("space", [False, True])
@pytest.mark.parametrize("word", [word for word in STATEMENTS if word not in WITH_OTHERS])
def test_examples_are_statements(word, space):
    """The example of each statement is read, with the groups that it names; those that need others stand elsewhere."""
    if space and word in ("state", "thickness"):
        return
    words = shown(STATEMENTS[word].example, Where(space=space)).split()
    if word not in ("line", "about", "gravity", "thickness", "state", "size"):
        words[1] = "block" if word in OF_BODIES else "left"
    if word in ("contact", "tie"):
        words[2] = "right"
    good = (GOOD_SPACE if space else GOOD).replace("nu 0.3", "nu 0.3 density 1")
    good = good.partition("\n")[2] if word == "body" else good
    case = read(f"{' '.join(words)}\n{good}", space=space)
    assert any(isinstance(s, STATEMENTS[word]) for s in case.statements)


def test_usages():
    """Made of the fields, in the plane and in space."""
    plane, space = Where(), Where(space=True)
    assert usage("film", plane) == "film NAME h T"
    assert usage("body", plane) == "body NAME E number nu number [yield number] [density number]"
    assert usage("conduct", space) == "conduct BODY k [capacity C [start T]] [expand alpha [from T]]"
    assert usage("move", space).startswith("move NAME x y z, or *") and usage("clamp", plane) == "clamp NAME [x] [y]"
    assert usage("spring", space) == "spring NAME kx ky kz" and usage("spring", plane) == "spring NAME kx ky"
    assert usage("expand", plane) == "expand NAME alpha dT, two numbers"
    assert "sphere x y z R r, cylinder x y z dx dy dz R r, box x y z x y z," in usage("obstacle", space)


def test_torque_of_a_bolt():
    """The work of a torque in a turn is that of the preload along the pitch, and of friction in thread and head."""
    words = "torque 46000 pitch 1.5 thread 9.026 0.12 head 12.8 0.1"
    case = f"body block E 100 nu 0.3\nclamp bottom\ncontact left right\npreload top {words}\n"
    force = only(read(case), g.Preload).force
    flank = force / np.cos(np.radians(30))
    work = force * 1.5 + 0.12 * flank * np.pi * 9.026 + 0.1 * force * np.pi * 12.8
    assert work == pytest.approx(2 * np.pi * 46000)
    for wrong, why in (
        ("torque 46000 pitch 1.5 thread 9 0.12", "head is missing after 0.12"),
        ("torque 46000", "pitch is missing after 46000"),
        ("torque 4 pitch 0 thread 9 0.1 head 1 0.1", "the pitch is out of range; allowed: above 0"),
    ):
        with pytest.raises(Refusal, match=why):
            read(case.replace(words, wrong))


# ---------------------------------------------------------------- modules


def asked(lines, first="", space=False, **run):
    found = modules(needs(read(first + (GOOD_SPACE if space else GOOD) + lines, space=space)), Run(space, **run))
    return {name.removesuffix("OnRequest") for name in (*found.macros, *found.options)}


MODULES = [
    ("", set()),
    ("# pressure, symmetry, rotate", set()),
    ("pressure left 1", {"loads"}),
    ("symmetry left", {"mirrors"}),
    ("rotate left 0 0 1", {"largeMotions", "moments", "largeRotation"}),
    ("rotate left 0 0 1\nleg 2", {"friction", "moments", "series", "largeMotions"}),
    ("force left 0 1", set()),
    ("force left 0 1 free", {"springsAndMoments"}),
    ("moment left 1", {"springsAndMoments", "moments"}),
    ("spring left 1 1", {"springsAndMoments"}),
    ("about p 0 0", {"moments"}),
    ("leg 2", {"friction", "moments", "series"}),
    ("tie left right", {"friction", "moments", "series"}),
    ("contact left right friction 0", {"friction", "moments", "series"}),
    ("contact left right law power kappa 1 m 2 d0 -1", set()),
    ("contact left right law barrier p0 1 d0 -1", {"laws"}),
    ("stresses", {"stresses"}),
    ("line l 0 0 1 1", {"stresses"}),
    ("expand block 1 1", {"initialStrain", "largeRotation", "largeMotions"}),
    ("preload left 1\ntighten left", {"initialStrain", "tightening", "largeRotation", "largeMotions"}),
    ("conduct block 1\nfilm left 1 1", {"initialStrain", "heat", "largeRotation", "largeMotions"}),
    ("conduct block 1 expand 1\nfilm left 1 1", {"initialStrain", "heat", "largeRotation", "largeMotions", "stresses"}),
    ("plastic block 1 1", {"plastic", "friction", "moments", "stresses"}),
    ("contact left right wear 1 slide 1\ncycles 5", {"wear"}),
]
RUBBER = GOOD.replace("nu 0.3", "nu 0.5")


@pytest.mark.parametrize("lines, names", MODULES)
def test_modules(lines, names):
    assert asked(lines) == names


def test_modules_of_flags():
    assert asked("", exact=True) == {"largeMotions", "largeRotation"}
    assert asked("", history=True) == {"series", "largeMotions", "largeRotation"}
    assert asked("leg 2", history=True) == {"friction", "moments", "series"}
    assert asked("leg 2", check=True) == {"friction", "moments", "check"}
    assert asked("", axis=True) == {"axisStresses"} and asked("", axis=True, space=True) == set()
    assert asked("pressure left 1\nstresses", own=False) == {"loads"}
    assert asked("", "state axisymmetric\n") == {"mirrors"}


def of_rubber(lines="", first="", nu=0.5, **run):
    case = read(first + RUBBER.replace("nu 0.5", f"nu {nu}") + lines)
    return "incompressible" in modules(needs(case), Run(space=False, **run)).options


def test_mixed_elements():
    """From above 0.49 on with P2; not where plastic, thermal or preload strains are, nor in plane stress."""
    assert of_rubber() and of_rubber(nu=0.4901) and not of_rubber(nu=0.49)
    assert not of_rubber(order="4") and not of_rubber(first="state stress\n")
    assert not of_rubber("expand block 1 1", nu=0.499) and not of_rubber("plastic block 1 1", nu=0.499)


@pytest.mark.parametrize("lines, run, words", [
    ("", {"order": "1"}, "nu 0.5: not with -order 1 or 3"),
    ("", {"order": "3"}, "nu 0.5: not with -order 1 or 3"),
    ("", {"own": False}, "nu 0.5: .*other scenes"),
    ("expand block 1 1", {}, "nu 0.5: .*expand"),
    ("plastic block 1 1", {"order": "4"}, "nu 0.5: .*plastic"),
    ("", {"axis": True}, "-axis: not with a nu above 0.49"),
])  # fmt: skip
def test_what_excludes_mixed_elements(lines, run, words):
    with pytest.raises(Refusal, match=words):
        of_rubber(lines, **run)


@pytest.mark.parametrize("lines, run, words", [
    ("plastic block 1 1\nconduct block 1\ntemperature top 1", {}, "plastic: not with conduct"),
    ("plastic block 1 1\npreload left 5\ntighten left", {}, "tighten: not with plastic"),
    ("expand block 1 1", {"own": False}, "expand, preload, conduct: allowed in edp/parts.edp"),
    ("conduct block 1\nfilm left 1 1\nleg 2", {}, "conduct: allowed without friction, tie and leg"),
])  # fmt: skip
def test_modules_that_exclude_each_other(lines, run, words):
    with pytest.raises(Refusal, match=words):
        asked(lines, **run)


def test_a_new_statement():
    """Two numbers and a keyword in one place: parser, bounds, refusals, usage and guesses come of it."""

    class Heave(Statement, word="heave", example="heave left 1 2"):
        does, synonyms = "a stand-in of this test", "lift"
        on: Group = boundary()
        amplitude: float = number("the amplitude", "a", above=0, unit="length")
        period: float = number("the period", "T", above=0, unit="time")
        phase: float = option("phase", number("the phase", "p"), default=0.5)

    try:
        found = only(read(f"{GOOD}heave left 3 4 phase 1"), Heave)
        assert (found.on.name, found.amplitude, found.period, found.phase) == ("left", 3, 4, 1)
        assert only(read(f"{GOOD}heave left 3 4"), Heave).phase == 0.5
        allowed = "allowed: heave NAME a T [phase p], as heave left 1 2"
        assert f"the period is missing after 3; {allowed}" in refused(f"{GOOD}heave left 3")
        assert "0: the amplitude is out of range; allowed: above 0" in refused(f"{GOOD}heave left 0 4")
        assert "heave of left: stated before, in line 4" in refused(f"{GOOD}heave left 3 4\nheave left 3 4")
        assert "did you mean heave (a stand-in of this test)?" in refused(f"{GOOD}lift left 3 4")
    finally:
        del STATEMENTS["heave"]
