"""An assembly of 18 parts: what -check 1 tells of it, and its picture, in which no label lies on another one."""

import re

import assembly
import numpy as np
import pytest
from freefem import FREEFEM, execute
from matplotlib.figure import Figure
from text_boxes import faults

from postprocess import labels, raster, style
from postprocess.commands import check
from postprocess.geometry_faces import WIDE, arrange_rows, draw

# ---------------------------------------------------------------- pixels


def test_fronts():
    """Of triangles the nearest one at each pixel's middle, also where two cross."""
    far = [[0, 0, 0], [4, 0, 0], [0, 4, 0]]
    near = [[0, 0, 1], [2, 0, 1], [0, 2, 1]]
    seen = raster.fronts(np.array([near, far], float), np.zeros(2), 0.5, (9, 9))
    middles = 0.5 * (np.arange(9) + 0.5)
    x, y = np.meshgrid(middles, middles)
    assert (seen == np.where(x + y <= 2, 0, np.where(x + y <= 4, 1, -1))).all()
    leaning = [[0, 0, -1], [4, 0, 3], [0, 4, -1]]  # z = x - 1
    seen = raster.fronts(np.array([far, leaning], float), np.array([0.1, 0.0]), 0.5, (9, 9))
    at = x + 0.1
    assert (seen == np.where(at + y > 4, -1, np.where(at > 1, 1, 0))).all()


def test_fronts_in_parts(monkeypatch):
    """Many pixels are looked at in parts; a triangle aside or on edge is none."""
    rng = np.random.default_rng(3)
    seen = rng.normal(size=(60, 3, 3))
    seen[:5, 2] = seen[:5, 1]
    seen[5:9] += [50, 0, 0]
    with np.errstate(all="raise"):
        whole = raster.fronts(seen, np.array([-3.0, -3.0]), 0.1, (60, 60))
    monkeypatch.setattr(raster, "CHUNK", 500)
    assert (raster.fronts(seen, np.array([-3.0, -3.0]), 0.1, (60, 60)) == whole).all()
    assert whole.max() > 50 and not np.isin(whole, range(9)).any()


def test_rooms():
    """The pixel farthest from other regions, which is not the middle of all; thin regions have none."""
    number = np.full((12, 30), -1)
    number[1:10, 1:10] = 4
    number[4:6, 10:28] = 4
    number[11] = 2
    assert raster.rooms(number) == {4: (5, 5, 4)}
    number[2:9, 14:27] = 7
    rooms = raster.rooms(number)
    assert rooms[4] == (5, 5, 4) and rooms[7] == (5, 20, 3)
    above = np.repeat([[0], [1]], 9, axis=0).repeat(13, axis=1)  # one above the other
    assert raster.rooms(above) == {0: (4, 6, 3), 1: (12, 6, 3)}


def test_edges():
    number = np.array([[0, 0, 0, 1], [0, 0, 0, 1], [0, 0, 2, 1]])
    assert raster.edges(number).astype(int).tolist() == [[0, 0, 1, 1], [0, 0, 1, 1], [0, 1, 1, 1]]


# ---------------------------------------------------------------- labels


def points(width, height):
    """Axes with points as data."""
    figure = Figure(figsize=(width / 72, height / 72))
    axes = figure.add_axes([0, 0, 1, 1])
    axes.set_axis_off()
    axes.set_xlim(0, width)
    axes.set_ylim(0, height)
    return figure, axes


def test_labels_around():
    """Labels of places close together lie beside them; one with room lies at its place, without a line."""
    rng = np.random.default_rng(1)
    anchors = [*(50 + 12 * rng.normal(size=(30, 2))), [15, 12]]
    texts = [str(100 + k) for k in range(31)]
    with style.look():
        figure, axes = points(110, 100)
        labels.around(axes, anchors, texts, [*[0.0] * 30, 9.0], (110, 100))
        assert faults(figure) == []
    places = {text.get_text(): text.get_position() for text in axes.texts}
    assert sorted(places) == texts and places["130"] == (15, 12) and len(axes.lines) == 2 * 30
    for text, at in zip(texts[:30], anchors[:30], strict=True):
        assert 4 < np.linalg.norm(np.subtract(places[text], at)) < 70
        covered = labels.box_of(np.array(places[text]), text)
        assert not any((covered[0] < other).all() and (other < covered[1]).all() for other in np.array(anchors))


def test_labels_beside():
    """Names in two columns, in the order of their places; a name of two lines has more room."""
    anchors = [(60 + (k % 2) * 80, 50 + k) for k in range(12)]
    texts = [f"{k} a name" + ("\nof two lines" if k == 4 else "") for k in range(12)]
    with style.look():
        figure, axes = points(200, 90)
        labels.beside(axes, anchors, texts, (200, 90))
        assert faults(figure) == []
    at = {text.get_text(): text.get_position() for text in axes.texts}
    for column in (0, 1):
        own = [at[texts[k]] for k in range(column, 12, 2)]
        assert len({place[0] < 100 for place in own}) == 1
        assert [place[1] for place in own] == sorted(place[1] for place in own)
    with style.look():
        figure, axes = points(200, 90)
        labels.beside(axes, [(100 + k, 1 + 0.1 * k) for k in range(12)], texts, (200, 90))
        assert faults(figure) == []


def test_arrange_rows():
    """Bodies of many faces have a half or a whole row."""
    rows = arrange_rows({1: 16, 2: 6, 3: 12, 4: 41, 5: 4, 6: 4, 7: 4, 8: 4})
    assert [[number for number, _, _ in row] for row in rows] == [[1, 2], [3], [4], [5, 6, 7], [8]]
    assert rows[0] == [(1, 0, WIDE / 2), (2, WIDE / 2, WIDE / 3)] and rows[2] == [(4, 0, WIDE)]


# ---------------------------------------------------------------- the assembly


@pytest.fixture(scope="module")
def checked(tmp_path_factory):
    """What -check 1 says of the assembly, and its folder."""
    folder = tmp_path_factory.mktemp("assembly")
    words = ["edp/parts-3d.edp", "-mesh", assembly.step(folder), "-check", 1, "-out", folder / "out"]
    code, said = execute([*FREEFEM, *words])
    assert code == 0
    return said, folder / "out/check"


def test_check_of_an_assembly(checked):
    """18 bodies with their names, those of several parts with numbers; 23 pairs touch, with the joins of the case."""
    said, _ = checked
    found = re.findall(r"^volume (\d+) \((.*?)\): .*faces ([\d ]+)$", said, re.M)
    kinds = {kind: iter(range(9)) for kind in assembly.NAMES}
    assert [name for _, name, _ in found] == [assembly.called(kind, next(kinds[kind])) for kind in assembly.NAMES]
    assert [int(face) for _, _, own in found for face in own.split()] == list(range(1, 159))
    assert said.count(" touch (faces ") == 23
    offered = re.findall(r"^  join (.*?) (?:tie|contact) ", said, re.M)
    for a, i, b, j, _ in assembly.PAIRS:
        names = assembly.called(a, i), assembly.called(b, j)
        assert " ".join(names) in offered or " ".join(names[::-1]) in offered


def test_picture_of_an_assembly(checked, capsys, monkeypatch):
    """Every name and the number of every face, none on another one or outside; lines tell of the progress."""
    monkeypatch.setattr("postprocess.geometry_faces.PATIENCE", 0.0)
    with style.look():
        figure = draw(checked[1] / "check-faces.csv", -60, 25)
        assert faults(figure) == []
    assert capsys.readouterr().err.splitlines()[-1] == "faces of body 18 of 18"
    words = [text.get_text() for axes in figure.axes for text in axes.texts]
    numbers = [word.strip("()") for word in words if re.fullmatch(r"\(?\d+\)?", word)]
    assert sorted(map(int, numbers)) == list(range(1, 159))
    kinds = {kind: iter(range(9)) for kind in assembly.NAMES}
    called = [assembly.called(kind, next(kinds[kind])).strip('"') for kind in assembly.NAMES]
    names = [f"{number} {name}" for number, name in enumerate(called, 1)]
    assert sorted(names) == sorted(word.strip("()").replace("\n", " ") for word in words if " " in word)
    for axes in figure.axes[:2]:  # names beside the bodies
        left, right, _, _ = axes.images[0].get_extent()
        for text in axes.texts:
            low, high = labels.box_of(np.array(text.get_position()), text.get_text())
            assert high[0] < left or low[0] > right
    titles = [text.get_text().replace("\n", " ") for text in figure.texts]
    assert titles == [f"volume {number}: {name}" for number, name in enumerate(called, 1)]
    # each face once, on the side that shows it; what no side shows is in brackets: nothing here
    assert not any(word.startswith("(") and word[1:-1].isdigit() for word in words)


# ---------------------------------------------------------------- the picture of a case


def test_pairs_with_blanks():
    """Slave and master have names with blanks; an obstacle is no group."""
    groups = ["Base plate", "plate", "Hex", "nut", "Hex nut", "rail"]
    assert check.pair("Hex nut Base plate", groups) == ("Hex nut", "Base plate")
    assert check.pair("Hex nut", ["Hex", "nut"]) == ("Hex", "nut")
    assert check.pair("rail Hex nut", groups[4:]) == ("rail", "Hex nut")
    assert check.pair("Base plate plane 0 1", groups[:1]) == ("Base plate", "plane 0 1")
    assert check.pair("rail", groups) == ("rail", "")
    said = {"groups": groups, "contacts": [{"name": "Hex nut Base plate"}], "statements": []}
    assert check.group_caption(said, 5) == "Hex nut: slave of Base plate"
    assert check.group_caption(said, 1) == "Base plate: master of Hex nut"
    assert check.group_caption(said, 3) == "Hex" and check.line_widths(said) == {1: 0.9, 5: 2.4}


def test_held_together():
    """Of many bodies those that are held alike share a line."""
    bodies = [{"name": f"part {k}", "held": "clamp base", "free": []} for k in range(3)]
    bodies[1] = {"name": "nut", "held": "contact only", "free": ["nut: along x", "nut: along y"]}
    free = "nut: held by contact only; free: along x, along y"
    assert check.held_by(bodies, True) == f"part 0, part 2: held by clamp base\n{free}"
    lines = check.held_by(bodies, False).split("\n")
    assert lines == ["part 0: held by clamp base", free, "part 2: held by clamp base"]


def test_picture_of_a_case_of_an_assembly(tmp_path):
    """17 joins of parts of one material: pairs, what is held, a legend, and nothing on anything else."""
    (tmp_path / "a.case").write_text(assembly.CASE)
    words = ["-mesh", assembly.step(tmp_path), "-case", tmp_path / "a.case", "-check", 1, "-out", tmp_path / "out"]
    code, said = execute([*FREEFEM, "edp/parts-3d.edp", *words])
    assert code == 0 and said.count(": the case file says how") == 17 and said.count("warning: bodies touch: ") == 6
    assert "left out" not in said
    with style.look():
        figure = check.draw(tmp_path / "out/check", np.eye(3))
        assert faults(figure) == []
    legend = [text.get_text() for text in figure.legends[0].get_texts()]
    # four masters on the cover are one surface, and two on each bracket
    assert len(legend) == 2 * 17 + 2 - 5 + 1 and "Cover-Base plate: slave of Base plate-Cover" in legend
