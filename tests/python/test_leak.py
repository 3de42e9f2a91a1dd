"""The command leak: the way of least pressure through a contact, on surfaces with known answers and in runs."""

import json
import re
from argparse import Namespace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from contact.test_friction import case

from postprocess.command_line import main
from postprocess.commands import leak
from postprocess.vtu import Surface


def ring(rings=9, rays=40, turn=2 * np.pi):
    """A flat annulus of radii 1 and 2: points, cells; closed, or a sector whose cuts are symmetries."""
    closed = turn == 2 * np.pi
    r, t = np.meshgrid(np.linspace(1, 2, rings), np.linspace(0, turn, rays + 1)[: rays + (not closed)], indexing="ij")
    k = np.arange(r.size).reshape(r.shape)
    k = np.c_[k, k[:, :1]] if closed else k
    a, b, c, d = k[:-1, :-1].ravel(), k[1:, :-1].ravel(), k[1:, 1:].ravel(), k[:-1, 1:].ravel()
    return np.c_[(r * np.cos(t)).ravel(), (r * np.sin(t)).ravel(), 0 * r.ravel()], np.r_[np.c_[a, b, c], np.c_[a, c, d]]


def leaks(monkeypatch, points, cells, pressure, across=(), error=None, inside=None, outside=None):
    monkeypatch.setattr(leak, "on_symmetries", lambda at, folder, name: abs(at[:, "xy".index(name)]) < 1e-9)
    surface = Surface(points, points, cells, np.zeros(len(cells), int), pressure, pressure)
    monkeypatch.setattr(leak, "read_surface", lambda path: surface)
    estimates = {"contacts": [{"pressureMax": {"error": error}}]}
    summary = {"contacts": [{"name": "a b", "across": across}], "estimates": estimates, "units": ["mm", "MPa"]}
    chosen = SimpleNamespace(path=Path("run"), summary=summary)
    (text,) = leak.leaks_in_space(chosen, Namespace(inside=inside, outside=outside))
    return text


def level(text):
    return float(re.search(r"leaks at ([\d.]+)", text)[1])


def test_least_of_a_ridge(monkeypatch):
    """p = ridge(r) (2 + cos t): as tight as the ridge where that is lowest; a scratch through it leaks at once."""
    points, cells = ring()
    r, t = np.hypot(*points[:, :2].T), np.arctan2(points[:, 1], points[:, 0])
    p = (1 - 4 * (r - 1.5) ** 2) * (2 + np.cos(t))
    assert level(leaks(monkeypatch, points, cells, p)) == pytest.approx(1)
    assert "at (-1.5, " in leaks(monkeypatch, points, cells, p)
    scratch = np.where(abs(t - 1) < 0.1, 0, p)
    assert leaks(monkeypatch, points, cells, scratch).endswith("leaks without pressure: there is an open way")
    # one that ends before the ridge lets the fluid come near only
    half = np.where((abs(t - 1) < 0.1) & (r < 1.45), 0, p)
    assert level(leaks(monkeypatch, points, cells, half)) == pytest.approx(1)
    # pressed most at the rims: these have to be passed too
    assert level(leaks(monkeypatch, points, cells, 3 - p / (2 + np.cos(t)))) == pytest.approx(3)


def test_a_winding_channel(monkeypatch):
    """A maze of walls 5 and a channel whose pressure rises to 2: the way follows it."""
    points, cells = ring(rings=21, rays=80)
    r, t = np.hypot(*points[:, :2].T), np.arctan2(points[:, 1], points[:, 0]) % (2 * np.pi)
    spiral = abs(r - 1 - t / (2 * np.pi)) < 0.08
    assert level(leaks(monkeypatch, points, cells, np.where(spiral, 2 * np.sin(t / 2), 5))) == pytest.approx(2)


def test_random_pressures(monkeypatch):
    """No way from inside to outside through points below the answer, and one through those up to it; turned alike."""
    rng = np.random.default_rng(4)
    points, cells = ring()
    edges, _ = leak.edges_of(cells)
    inner, outer = np.hypot(*points[:, :2].T) < 1.01, np.hypot(*points[:, :2].T) > 1.99

    def passes(p, bound, below):
        open_points = (p < bound) if below else (p <= bound)
        reached = inner & open_points
        for _ in points:
            step = edges[reached[edges].any(axis=1) & open_points[edges].all(axis=1)]
            reached[step] = True
        return (reached & outer).any()

    for _ in range(5):
        p = rng.random(len(points))
        one = leaks(monkeypatch, points, cells, p)
        found = p[np.argmin(abs(p - level(one)))]
        assert not passes(p, found, True) and passes(p, found, False)
        out = leaks(monkeypatch, points, cells, p, inside=[9.0, 0, 0], outside=[0.0, 0, 0])
        assert out == one


def test_cuts_by_symmetries_are_no_rims(monkeypatch):
    """A quarter between two symmetries. Without these it has one rim, and says so."""
    points, cells = ring(turn=np.pi / 2)
    r = np.hypot(*points[:, :2].T)
    p = np.where(points[:, 0] < 1e-9, 0, 1 - 4 * (r - 1.5) ** 2)  # open along one cut
    assert "without pressure" in leaks(monkeypatch, points, cells, p, across=["x", "y"])
    assert level(leaks(monkeypatch, points, cells, p + 1, across=["x", "y"])) == pytest.approx(1)
    with pytest.raises(leak.ResultsError, match="its surface has 1 rims; allowed: with --inside"):
        leaks(monkeypatch, points, cells, p + 1)


def test_open_parts(monkeypatch):
    """A disc that touches along a ring: the fluid is in its open middle."""
    points, cells = ring(rings=30)
    points[:, :2] *= ((np.hypot(*points[:, :2].T) - 0.99) / np.hypot(*points[:, :2].T))[:, None]
    k = np.arange(40)
    cells = np.r_[cells, np.c_[k, np.roll(k, -1), np.full(40, len(points))]]
    points = np.r_[points, [[0.0, 0, 0]]]
    r = np.hypot(*points[:, :2].T)
    p = np.maximum(0, 1 - ((r - 0.5) / 0.2) ** 2)
    text = leaks(monkeypatch, points, cells, p, error=0.01, inside=[0.0, 0, 1], outside=[2.0, 0, 0])
    assert level(text) == pytest.approx(p.max(), abs=0.05) and text.split(" MPa")[1].startswith(", at (")
    # the error of the greatest pressure, and half of the difference to a neighbour
    (ridge,) = {round(float(x), 9) for x in p[r > 0][p[r > 0] == p.max()]}
    beside = ridge - max(0, 1 - ((0.5 - abs(r[p == p.max()][0] - 0.5) - 1 / 29) - 0.5) ** 2 / 0.04)
    assert float(text.split("± ")[1].split()[0]) == pytest.approx(0.01 + 0.5 * beside, abs=0.006)
    with pytest.raises(leak.ResultsError, match="1 rims"):
        leaks(monkeypatch, points, cells, p)


def test_a_bead_about_an_axis(tmp_path, capsys):
    """A ring of a half circle on a plane, hard against it: Hertz' line, p0 = sqrt(F E*/(pi R))."""
    geo = """SetFactory("OpenCASCADE");
    Disk(1) = {200, 20, 0, 20, 20}; Rectangle(2) = {150, 20, 0, 100, 100};
    BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
    """
    text = "units mm MPa\nstate axisymmetric\ngroup bead surfaces 3\ngroup round near 200 0\ngroup lid plane 0 20 0 1\n"
    text += "size contact 0.04\nbody bead E 1000 nu 0.3\nobstacle round plane 0 0 0 1\nmove lid 0 -0.05\n"
    run = case(tmp_path, geo, text, "-estimate", 1)
    assert main(["leak", str(run.folder)]) == 0
    said = capsys.readouterr().out
    found, error = re.search(r"leaks at ([\d.]+) ± ([\d.]+) MPa", said).groups()
    line = abs(json.loads((run.folder / "summary.json").read_text())["force"]) / (2 * np.pi * 200)
    exact = np.sqrt(line * 1000 / (1 - 0.09) / (np.pi * 20))
    assert float(found) == pytest.approx(exact, rel=0.02) and 0 < float(error) < 0.02 * exact
    summary = run.folder / "summary.json"
    summary.write_text(summary.read_text().replace('"converged": true', '"converged": false'))
    assert main(["leak", str(run.folder)]) == 2 and "has not converged" in capsys.readouterr().err


TORUS = """SetFactory("OpenCASCADE");
Disk(1) = {6, 0, 0, 3}; Rectangle(2) = {0, 0, 0, 12, 12};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Rotate {{1, 0, 0}, {0, 0, 0}, Pi/2} { Surface{3}; }
Extrude {{0, 0, 1}, {0, 0, 0}, Pi/6} { Surface{3}; }
Mesh.MeshSizeMax = 1.2;
"""
TWELFTH = """units mm MPa
group bead volumes 1
group one plane 0 0 0 0 1 0
group two plane 0 0 0 -0.5 0.8660254 0
group lid plane 0 0 0 0 0 1
group round near 5.7956 1.5529 -3
size contact 0.3
body bead E 1000 nu 0.3
symmetry one
symmetry two
clamp lid
obstacle round plane 0 0 -3 0 0 1 move 0 0 0.1
"""


def test_a_bead_in_space(tmp_path, capsys):
    """A twelfth of it, between oblique symmetries: the same line."""
    run = case(tmp_path, TORUS, TWELFTH, "-estimate", 1, "-vtu", 1, space=True)
    assert main(["leak", str(run.folder)]) == 0
    found, error = map(float, re.search(r"leaks at ([\d.]+) ± ([\d.]+) MPa, at", capsys.readouterr().out).groups())
    exact = np.sqrt(run.force / (2 * np.pi * 6 / 12) * 1000 / (1 - 0.09) / (np.pi * 3))
    assert abs(found - exact) < error < 0.3 * exact
