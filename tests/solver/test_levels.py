"""Products with the kernel of many points without its matrix: against the matrix, and whole runs."""

import pytest
from freefem import ROOT, cases_of, data, run, run_in, scene_text, script, snippet, told, tree

PRODUCTS = data("levels/products.edp")
MODEL = data("levels/model.edp")


@pytest.mark.parametrize(
    "scene, flags",
    [
        ("rough", ["-order", 1, "-h", 0.1, "-modes", 32]),
        ("rough", ["-order", 2, "-h", 0.2, "-modes", 32]),
        ("rough", ["-order", 4, "-h", 0.4, "-modes", 32]),
        ("sphere-on-block", ["-order", 1, "-h", 0.5]),
        ("sphere-on-block", ["-order", 2, "-h", 0.8]),
        ("sphere-on-plane", ["-order", 2, "-h", 0.2]),
    ],
)
def test_products(scene, flags, tmp_path):
    """The same as with the matrix to 1 %, for a smooth pressure and for one force, also with the fitted polynomial;
    what keeps the model definite is added, and new points have new grids."""
    values = told(snippet(tmp_path, scene_text(scene) + PRODUCTS + MODEL, *flags))
    assert values["model"][0] < 0.01
    assert values["guard"][0] == pytest.approx(0.02)
    assert values["kept"][0] == 0
    assert values["levels"][0] >= 3
    assert values["off0"][0] < 0.01
    assert values["off1"][0] < 0.02


TURNED = data("levels/turned.geo")
TURNED_CASE = data("levels/turned-case.case")


def test_products_of_a_case(tmp_path):
    """Contacts that face two ways, in mirrors that are no axes: each in its own plane, the other one not felt."""
    (tmp_path / "turned.geo").write_text(TURNED)
    (tmp_path / "turned.case").write_text(TURNED_CASE)
    text = (ROOT / "edp/parts-3d.edp").read_text()
    parts = (ROOT / "edp/parts.edp").read_text().split('include "solver/solve.idp"')[0]
    text = text.replace('include "parts.edp"', parts) + PRODUCTS
    text += 'for (int n = 3000; n < 5000; n += 1000) tell("offered" + n, usesGrids(n));\n'
    values = told(snippet(tmp_path, text, "-mesh", "turned.geo", "-case", "turned.case", "-order", 1))
    assert values["offered3000"][0] == 0 < values["offered4000"][0]
    assert values["levels"][0] >= 2
    assert values["off0"][0] < 0.01
    assert values["off1"][0] < 0.02


SYNTHETIC = data("levels/synthetic.edp")


@pytest.mark.parametrize("side", [45, 90])
def test_start(side, tmp_path):
    """The start of a stiff law on a half-space without body: found on some points, solved on all; Hertz's force."""
    scene = scene_text("sphere-on-block").split("checkCommandLine(")[0]
    values = told(snippet(tmp_path, scene + SYNTHETIC, "-side", side, "-kappa", 1e9, "-u0", 2))
    assert values["stride"][0] > 1
    assert values["residual"][0] < 2e-3
    assert values["force"][0] == pytest.approx(values["hertz"][0], rel=0.02)


STIFF = "sphere-on-block", ["-order", 1, "-h", 0.8, "-kappa", 1e9]


@pytest.mark.parametrize("scene, flags", cases_of([("rough", ["-order", 1, "-h", 0.2])], [STIFF]))
def test_runs(scene, flags, tmp_path):
    """With the hierarchy in the matrix's place a run shall need hardly more, and find the same."""
    package = tree(tmp_path / "package")
    name = package / "edp/solver/hierarchical/grid-products.idp"
    text = name.read_text()
    assert text.count("int gridPointsMin = 1500;") == 1
    usual = run(scene, *flags).summary
    name.write_text(text.replace("int gridPointsMin = 1500;", "int gridPointsMin = 20;"))
    other = run_in(package, script(scene), *flags, "-estimate", 0, "-vtu", 0, out=tmp_path / "levels").summary
    assert other["force"] == pytest.approx(usual["force"], rel=1e-5) and other["force"] != usual["force"]
    assert other["newton"] <= usual["newton"] + 1
    assert other["backsolves"] <= usual["backsolves"] + 5


def test_no_convergence(tmp_path):
    """Where products over grids do not solve the model a matrix shall take their place, said once: no run hangs."""
    package = tree(tmp_path / "package")
    many = package / "edp/solver/hierarchical"
    for name, before, after in (
        ("grid-products.idp", "int gridPointsMin = 1500;", "int gridPointsMin = 20;"),
        ("grid-preconditioner.idp", "int innerIterationsMax = 300;", "int innerIterationsMax = 1;"),
    ):
        text = (many / name).read_text()
        assert text.count(before) == 1
        (many / name).write_text(text.replace(before, after))
    usual = run("rough", "-order", 1, "-h", 0.2).summary
    other = run_in(package, script("rough"), "-order", 1, "-h", 0.2, "-estimate", 0, "-vtu", 0, out=tmp_path / "out")
    assert other.stdout.count("do not converge on these points") == 1
    assert other.summary["force"] == pytest.approx(usual["force"], rel=1e-5)


def test_no_matrix(tmp_path):
    """Without the hierarchy, and with too many points for a matrix, the diagonal shall take its place, and be named."""
    package = tree(tmp_path / "package")
    name = package / "edp/solver/surrogate" / "preconditioner.idp"
    text = name.read_text()
    assert text.count("int densePointsMax = 6000;") == 1
    usual = run("disc-on-block", "-kappa", 1e6).summary
    name.write_text(text.replace("int densePointsMax = 6000;", "int densePointsMax = 20;"))
    flags = ["-kappa", 1e6, "-order", 1, "-estimate", 0, "-vtu", 0]
    other = run_in(package, script("disc-on-block"), *flags, out=tmp_path / "diagonal")
    assert other.summary["force"] == pytest.approx(usual["force"], rel=1e-5)
    assert other.summary["backsolves"] > usual["backsolves"]
    assert other.stdout.count("too many for a matrix of the kernel") == 1
