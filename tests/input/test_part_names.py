"""The names of a STEP file's parts: of labels, in the table of -check 1, in statements and refusals."""

import re
import tempfile
from functools import cache
from pathlib import Path

import pytest
from freefem import part
from reader.names import LONGEST, body_names, name_of
from reader.words import quoted, split_line

from input.test_reader import read, refused
from input.test_reader_picks import boxes, made_of, module, picks  # noqa: F401
from input.test_zoo import gmsh

THREE = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 4, 4, 1}; Box(2) = {1, 1, 1, 1, 1, 2}; Box(3) = {3, 3, 1, 1, 1, 2};
"""
PRODUCT = re.compile(r"PRODUCT\('[^']*',\s*'[^']*'")


@cache
def plain_step():
    """The STEP file of the three boxes as Open CASCADE names their products."""
    return gmsh(Path(tempfile.mkdtemp()), "plain.step", THREE, "-0")


def named_step(folder, names):
    """A STEP file with these names of its assembly and of its parts, as a CAD program writes them."""
    left, file = iter(names), folder / "named.step"
    file.write_text(PRODUCT.sub(lambda found: "PRODUCT('{0}','{0}'".format(next(left)), plain_step().read_text()))
    assert next(left, None) is None
    return file


def twice(step):
    """The assembly of a STEP file of three parts with the second one also in the place of the third."""
    text = step.read_text()
    parts = re.findall(r"NEXT_ASSEMBLY_USAGE_OCCURRENCE\('\d','','',#\d+,(#\d+)", text)
    shapes = re.findall(r"REPRESENTATION_RELATIONSHIP\('','',(#\d+),#\d+\)", text)
    text = re.sub(rf"(OCCURRENCE\('3','','',#\d+,){parts[2]}\b", rf"\g<1>{parts[1]}", text)
    text = re.sub(rf"(REPRESENTATION_RELATIONSHIP\('','',){shapes[2]}\b", rf"\g<1>{shapes[1]}", text)
    # the third part itself, which nothing uses any more
    text = re.sub(rf"#\d+ = SHAPE_DEFINITION_REPRESENTATION\(#\d+,{shapes[2]}\);\n", "", text)
    step.write_text(text)
    return step


# ---------------------------------------------------------------- labels


@pytest.mark.parametrize("label, name", [
    ("Shapes/Assembly/1/Plate", "Plate"),
    ("Shapes/hex nut M8", "hex nut M8"),
    ("Shapes/A/2/  two \t blanks\n", "two blanks"),
    ('Shapes/A/2/3" pipe', "3 pipe"),
    ("Shapes/A/2/a\x01b\x7f", "a b"),
    ("Shapes/A/Träger", "Träger"),
    ("Shapes/A/Bodywork", "Bodywork"),
    ("Shapes/A/partition 2", "partition 2"),
    ("Shapes/A/M8", "M8"),
    ("Shapes/A/" + "x" * 100, "x" * LONGEST),
    ("Shapes/Assembly/2/", ""),
    ("", ""),
    ("Shapes/A/12", ""),
    ("Shapes/A/1e3", ""),
    ("Shapes/Open CASCADE STEP translator 7.6 1/1/Open CASCADE STEP translator 7.6 1.1", ""),
    ("Shapes/A/Body", ""),
    ("Shapes/A/Body001", ""),
    ("Shapes/A/SOLID", ""),
    ("Shapes/A/Solid1", ""),
    ("Shapes/A/Part 1", ""),
    ("Shapes/A/=>[0:1:1:2]", ""),
    ("Shapes/A/Manifold_Solid_Brep", ""),
])  # fmt: skip
def test_name_of(label, name):
    assert name_of(label) == name


def test_name_of_many():
    """The second of a name gets a number that no other body has; a word that `size` reads is no name."""
    labels = {3: "A/bolt", 5: "A/bolt", 7: "A/bolt-2", 8: "A/Body", 9: "A/bolt", 10: "A/Body", 11: "A/contact"}
    found = {3: "bolt", 5: "bolt-3", 7: "bolt-2", 8: "", 9: "bolt-4", 10: "", 11: "contact-2"}
    assert body_names(labels) == found


@pytest.mark.parametrize("name", ["bolt", "hex nut", "a#1", "#2", "x\ty", "Träger"])
def test_quoted(name):
    """A case file reads a name as it is told."""
    if "\t" not in name:
        assert split_line(1, f"body {quoted(name)} E 1", str).words[1] == name
    assert quoted(name).startswith('"') == (name not in ("bolt", "Träger"))


# ---------------------------------------------------------------- in a case

PARTS = {1: "plate", 2: "hex nut", 3: "", 4: "nut"}
TOUCH = "obstacle top plane 0 3 0 -1\ngroup top curves 3\n"


def test_case_with_names():
    """A statement names a part; names of parts that no statement has are no groups; the case's own names go before."""
    case = read(f'body "hex nut" E 1 nu 0\n{TOUCH}', [], bodies="1 2 3 4", labels=PARTS)
    assert [group.name for group in case.groups.all if group.dimension == 2] == ["hex nut"]
    case = read(f"group nut surfaces 1\nbody nut E 1 nu 0\n{TOUCH}", [], bodies="1 2 3 4", labels=PARTS)
    assert "nut" not in case.groups.labels and case.groups.picked["nut"] == 2


def test_one_material():
    """A single body that is no part is made of all; parts have names in joins and sizes all the same."""
    text = f'body steel E 1 nu 0\nsize plate 0.3\njoin plate "hex nut" contact\n{TOUCH}'
    case = read(text, [], bodies="1 2 3 4", labels=PARTS)
    assert case.groups.only_body == "steel" and {group.name for group in case.apart()} == {"plate", "hex nut", "nut"}
    assert read(f"body plate E 1 nu 0\n{TOUCH}", [], bodies="1 2", labels=PARTS).groups.only_body == ""
    said = refused(f"{text}weight plate 0 1\n", [], bodies="1 2 3 4", labels=PARTS)
    assert said.endswith("surface plate is made of; allowed: a line body plate E number nu number")


@pytest.mark.parametrize("line, said", [
    ("body nuts E 1 nu 0", 'nuts: no body of the geometry has this name; did you mean nut? '
                           'allowed: plate "hex nut" nut, or a line group nuts surfaces N ..., of 1 2 3 4'),
    ("clamp nut", "nut: no physical curve of the mesh; allowed: top"),
    ("weight hexnut 0 1", 'hexnut: no body of the geometry has this name; did you mean "hex nut"? allowed: '),
    ('weight "a b" 0 1', '"a b": no body of the geometry has this name; allowed: plate "hex nut" nut, or a line group '
                         '"a b" surfaces N ..., of 1 2 3 4'),
])  # fmt: skip
def test_refused_names(line, said):
    assert said in refused(f"body plate E 1 nu 0\n{line}\n{TOUCH}", [], bodies="1 2 3 4", labels=PARTS)


def test_groups_with_blanks_in_refusals():
    """Names of a mesh stand in refusals as a case file takes them."""
    from reader import Group

    mesh = [Group(2, "hex nut"), Group(2, "plate"), Group(1, "top side"), Group(1, "a#1")]
    said = refused('body "hex nut" E 1 nu 0\nclamp topside\n', mesh)
    assert 'topside: no physical curve of the mesh; did you mean "top side"? allowed: "top side" "a#1"' in said
    said = refused('body "hex nut" E 1 nu 0\nclamp "top side"\nobstacle a#1 plane 0 3 0 -1', mesh)
    assert "a: no physical curve" in said  # what stands behind the sign is a comment
    said = refused('body "hex nut" E 1 nu 0\nclamp "top side"\nobstacle "a#1" plane 0 3 0 -1', mesh)
    assert said.endswith("surface plate is made of; allowed: a line body plate E number nu number")
    said = refused('body plate E 1 nu 0\nclamp "top side"\nobstacle "a#1" plane 0 3 0 -1', mesh)
    assert said.endswith('allowed: a line body "hex nut" E number nu number')
    said = refused('body plate E 1 nu 0\nbody "hex nut" E 1 nu 0\nclamp "hex nut"\n', mesh)
    assert said.endswith('"hex nut": a surface of the mesh; allowed for clamp: its curves: "top side" "a#1"')
    said = refused('body plate E 1 nu 0\nclamp "top side"\nmove "top side" 0 1\n', mesh)
    assert '"top side": move after clamp in line 2' in said


def test_names_of_picks():
    """The table and its statements have the names of parts; those of the case go before; left out are named too."""
    text = "body low E 1 nu 0\ngroup ground plane 0 0 0 0 0 1\nclamp ground\nobstacle ground plane 0 0 9 0 0 -1\n"
    text = text.replace("obstacle ground", "obstacle up") + "group up faces 12\n"
    found = picks(text, labels={1: "low", 2: "the high"})
    assert found.choose() == [] and found.members[3, "low"] == [1] and (3, "the high") not in found.members
    table = found.table()
    assert "volume 1 (low): from" in table and 'volume 2 ("the high"): from' in table
    assert '  join low "the high" part ' in table and "group V" not in table
    assert found.left() == 'volumes 2 ("the high")'
    again = picks("group mine volumes 2\nbody mine E 1 nu 0\n" + text, labels={1: "low", 2: "the high"})
    assert again.choose() == [] and again.named(2) == "mine" and again.named(1) == "low"
    assert again.left() == "" and "join low mine tie" in again.table()


def test_names_of_bodies_apart():
    """A body that was taken apart has another number, and its name."""
    text = "body low E 1 nu 0\ngroup up faces 12\nobstacle up plane 0 0 9 0 0 -1\n"
    found = picks(text, labels={1: "low", 2: "high"})
    found.called = {2: 7}
    assert found.named(7) == "high" and found.named(1) == "low" and found.named(2) == ""


# ---------------------------------------------------------------- files


def test_step_file(tmp_path, module):  # noqa: F811
    """Names in a STEP file: blanks, quotes, letters of ISO 10303-21, two parts of one name."""
    from reader import mesher

    def made(names):
        return mesher.prepare(named_step(tmp_path, names), True, None, None, tmp_path)

    told = made(["Rig", "Base plate", r"Tr\X2\00E4\X0\ger", "O''Hara"])
    assert told.bodies == {1: "Base plate", 2: "Träger", 3: "O'Hara"}
    told = made(["Rig", "bolt", "", "bolt"])
    assert told.bodies == {1: "bolt", 2: "", 3: "bolt-2"} and "volume 3 (bolt-2): from" in told.table
    assert "volume 2: from" in told.table
    brep = gmsh(tmp_path, "b.brep", THREE, "-0")
    for plain in (plain_step(), brep):
        made_of_it = mesher.prepare(plain, True, None, None, tmp_path)
        assert set(made_of_it.bodies.values()) == {""} and "volume 1: from" in made_of_it.table


def test_part_in_two_places(tmp_path, module):  # noqa: F811
    """A part that an assembly has twice has two names."""
    from reader import mesher

    step = twice(named_step(tmp_path, ["Rig", "plate", "bolt", "other"]))
    assert mesher.prepare(step, True, None, None, tmp_path).bodies == {1: "plate", 2: "bolt", 3: "bolt-2"}


CASE = """units mm MPa
body steel E 210e3 nu 0.3
size bolt 0.5
join "Base plate" bolt contact
join "Base plate" bolt-2 tie
group base plane 0 0 0 0 0 1
group top box 0 0 2.9 9 9 3.1
clamp base
pressure top 3
"""


def test_case_of_a_step_file(tmp_path):
    """Names in a run: parts of one material, then one of their own; what is left out; a name that is none."""
    step = named_step(tmp_path, ["Rig", "Base plate", "bolt", "bolt"])
    done = part(tmp_path / "1", step, CASE, "-estimate", 0, space=True)
    names = ["Base plate-bolt bolt-Base plate", "Base plate-bolt-2 bolt-2-Base plate"]
    assert [contact["name"] for contact in done.contacts] == names
    assert done.contacts[0]["force"][2] == pytest.approx(-3, rel=1e-6)
    own = CASE.replace("steel E 210e3 nu 0.3", '"Base plate" E 210e3 nu 0.3\nbody bolt E 70e3 nu 0.3')
    own = own.replace('join "Base plate" bolt-2 tie\n', "").replace("top box 0 0 2.9 9 9 3.1", "top faces 12")
    done = part(tmp_path / "2", step, own, "-estimate", 0, space=True)
    assert any("volumes 3 (bolt-2), which no group has" in each for each in done.warnings)
    done = part(tmp_path / "3", step, own.replace("size bolt", "size bolts"), space=True, expect=10)
    assert done.stdout.count("\n") == 1 and "did you mean bolt? " in done.stdout
