"""A run's files for other programs: tensors for ParaView, FRD for CalculiX's viewers, tables for spreadsheets."""

import csv
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from freefem import part
from input.test_parts import Mesh, block

from postprocess.command_line import main
from postprocess.exchange import COMPONENTS, Exported, frd, vtu
from postprocess.vtu import Grid, read_arrays, read_names

CASE = "units mm MPa\nbody block E 100 nu 0.3\nclamp bottom\nstresses\nobstacle top circle 1.5 5 R 3 move 0 -0.1\n"


@pytest.fixture(scope="module")
def pressed(tmp_path_factory):
    """A disc on a block, with stresses."""
    return part(tmp_path_factory.mktemp("export"), block(Mesh(), cells=(6, 4)).text(), CASE, "-vtu", 1)


def read_frd(text):
    """Nodes {number: place}, elements [(kind, body, nodes)], fields {name: (components, values)} by fixed columns."""
    lines = iter(text.splitlines())
    nodes, elements, fields = {}, [], {}
    assert next(lines).startswith("    1C")
    for line in lines:
        if line == " 9999":
            return nodes, elements, fields
        if line.startswith("    1U"):
            continue
        key, count = line[:6], int(line[24:36])
        assert line.endswith("1")  # the long format
        if key == "    2C":
            for _ in range(count):
                row = next(lines)
                assert row[:3] == " -1" and len(row) == 13 + 36
                nodes[int(row[3:13])] = [float(row[13 + 12 * k : 25 + 12 * k]) for k in range(3)]
        elif key == "    3C":
            for _ in range(count):
                row, more = next(lines), next(lines)
                assert row[:3] == " -1" and more[:3] == " -2"
                found = [int(more[k : k + 10]) for k in range(3, len(more), 10)]
                elements.append((int(row[13:18]), int(row[23:28]), found))
        else:
            assert key == "  100C" and int(line[56:58]) == 0 and len(line) == 75
            head = next(lines)
            name, wide = head[5:13].strip(), int(head[13:18])
            parts = [next(lines) for _ in range(wide)]
            kept = [part[5:13].strip() for part in parts if part[33:38].strip() != "1"]
            values = []
            for k in range(1, int(line[24:36]) + 1):
                row = next(lines)
                assert row[:3] == " -1" and int(row[3:13]) == k
                values.append([float(row[13 + 12 * n : 25 + 12 * n]) for n in range(len(kept))])
                assert len(row) == 13 + 12 * len(kept)
            fields[name] = kept, np.array(values)
        assert next(lines) == " -3"
    raise AssertionError("no end")


def tensors(stress):
    """From components XX, YY, ZZ, XY, YZ, XZ."""
    xx, yy, zz, xy, yz, xz = stress.T
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)


def random_bodies(space):
    """Two cells with random stresses."""
    draw = np.random.default_rng(5)
    n, corners = (5, 4) if space else (4, 3)
    cells = np.array([[0, 1, 2, 3][:corners], [1, 2, 3, 4][:corners]])
    field = draw.normal(size=n)
    grid = Grid(draw.normal(size=(n, 3)), draw.normal(size=(n, 3)), cells, cells[:, :-1], field, np.array([1, 2]))
    return Exported(grid, draw.normal(size=(n, 6)), {"units": ["mm", "MPa"], "bodies": ["1 one", "2 zwei ä"]})


@pytest.mark.parametrize("space", [False, True])
def test_formats(space, tmp_path):
    """Random tensors in both formats: the order of their components, principal values and directions."""
    bodies = random_bodies(space)
    path = tmp_path / "a.vtu"
    path.write_bytes(vtu(bodies))
    found = read_arrays(path)
    full = tensors(bodies.stress)
    assert found["PointData", "stress"].reshape(-1, 6) == pytest.approx(bodies.stress)
    values = found["PointData", "principal stresses"].reshape(-1, 3)
    assert (np.diff(values, axis=1) < 0).all()
    for k, which in enumerate(("first", "second", "third")):
        way = found["PointData", f"{which} principal direction"].reshape(-1, 3)
        assert np.einsum("nij,nj->ni", full, way) == pytest.approx(values[:, [k]] * way)
        assert np.linalg.norm(way, axis=1) == pytest.approx(1)
    text = path.read_bytes().partition(b"<AppendedData")[0].decode()
    root = ElementTree.fromstring(text + "</VTKFile>")
    stress = root.find(".//DataArray[@Name='stress']")
    assert [stress.get(f"ComponentName{k}") for k in range(6)] == ["XX", "YY", "ZZ", "XY", "YZ", "XZ"]
    assert root.find(".//PointData").get("Tensors") == "stress"
    assert read_names(path) == bodies.names
    nodes, elements, fields = read_frd(frd(bodies, "a run").decode())
    assert np.array(list(nodes.values())) == pytest.approx(bodies.grid.points, rel=1e-5)
    assert [nodes for *_, nodes in elements] == (bodies.grid.cells + 1).tolist()
    assert [row[:2] for row in elements] == [(3 if space else 7, 1), (3 if space else 7, 2)]
    names, values = fields["STRESS"]
    assert names == ["SXX", "SYY", "SZZ", "SXY", "SYZ", "SZX"]
    for name, column in zip(names, values.T, strict=True):
        row, other = ("XYZ".index(letter) for letter in name[1:])
        assert column == pytest.approx(full[:, row, other], rel=1e-5)
    assert fields["DISP"][0] == ["D1", "D2", "D3"] and fields["DISP"][1] == pytest.approx(bodies.grid.move, rel=1e-5)
    assert "CPRESS" not in fields


def test_a_run(pressed, capsys):
    """Of a run: the principal stresses of solution.vtu, balance of units, tables with units and errors."""
    main(["export", str(pressed.folder)])
    said = capsys.readouterr().out.split()
    assert [line.rsplit("/", 1)[1] for line in said] == [
        "bodies.vtu",
        "bodies.frd",
        "contacts.csv",
        "contact-points.csv",
    ]
    before, found = read_arrays(pressed.folder / "solution.vtu"), read_arrays(pressed.folder / "bodies.vtu")
    values = found["PointData", "principal stresses"].reshape(-1, 3)
    for k in range(3):
        assert values[:, k] == pytest.approx(before["PointData", f"stress{k + 1}[pressure]"], abs=1e-9)
    for k, component in enumerate(COMPONENTS):
        known = before["PointData", f"stress{component}[pressure]"]
        assert found["PointData", "stress"].reshape(-1, 6)[:, k] == pytest.approx(known)
    _, elements, fields = read_frd((pressed.folder / "bodies.frd").read_text())
    assert len(elements) == (before["Cells", "types"] == 5).sum()
    assert fields["CPRESS"][1].max() == pytest.approx(pressed.summary["pressureMax"], rel=1e-5)
    with open(pressed.folder / "contacts.csv", encoding="utf-8-sig", newline="") as file:
        (row,) = csv.DictReader(file)
    contact, errors = pressed.summary["contacts"][0], pressed.summary["estimates"]["contacts"][0]
    assert float(row["normal force [N/mm]"]) == contact["normalForce"]
    assert float(row["resultant force y [N/mm]"]) == contact["force"][1]
    assert float(row["± of normal force [N/mm]"]) == errors["normalForce"]["error"]
    assert float(row["greatest pressure [MPa]"]) == contact["pressureMax"]
    assert row["contact"] == "top circle" and float(row["points in contact"]) == contact["contactPoints"]
    with open(pressed.folder / "contact-points.csv", encoding="utf-8-sig", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["pressure [MPa]"]) for row in rows] == pytest.approx(list(pressed.contact["pressure"]))
    assert {"x [mm]", "overlap [mm]", "normalX"} < set(rows[0])


def test_without_stresses(tmp_path, capsys):
    """A run without stresses says how to get them; one without files of bodies is refused; the kinds can be chosen."""
    run = part(tmp_path, block(Mesh(), cells=(4, 2)).text(), CASE.replace("stresses\n", ""), "-vtu", 1, "-estimate", 0)
    main(["export", str(run.folder), "--kinds", "vtu", "csv", "--out", str(tmp_path / "here")])
    assert re.match("no stress tensor in this run: add the statement stresses", capsys.readouterr().out)
    assert sorted(path.name for path in (tmp_path / "here").iterdir()) == [
        "bodies.vtu",
        "contact-points.csv",
        "contacts.csv",
    ]
    assert "not known" in (tmp_path / "here/contacts.csv").read_text(encoding="utf-8-sig")
    assert ("PointData", "stress") not in read_arrays(tmp_path / "here/bodies.vtu")
    (run.folder / "solution.vtu").unlink()
    assert main(["export", str(run.folder), "--kinds", "frd"])
    assert "run the scene with -vtu 1" in capsys.readouterr().err
