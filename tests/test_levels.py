"""Products with the kernel of many points without its matrix: against the matrix, and whole runs."""

import pytest
from freefem import ROOT, run, run_in, scene_text, script, snippet, told, tree

PRODUCTS = """
topNodes = 100;                               // three grids of few points
setUpContact();
{
    int[int] all(points);
    for (int i = 0; i < points; i++) all[i] = i;
    real[int] v(points); real[int] column(points); real[int] fast(points); real[int] slow(points);
    for (int test = 0; test < 2; test++)
    {
        kernelTest(0, v);
        if (test == 1) v = 0;
        v[points / 2] += test;
        levelsTimes(v, fast);
        slow = 0;
        for (int j = 0; j < points; j++)
        {
            kernelColumn(all, kernelCell, j, column);
            slow += v[j] * column;
        }
        fast -= slow; tell("off" + test, fast.l2 / slow.l2);
    }
    tell("levels", levels);
}
"""


@pytest.mark.parametrize(
    "scene, flags",
    [
        ("rough", ["-order", 1, "-h", 0.1, "-modes", 32]),
        pytest.param("rough", ["-order", 2, "-h", 0.2, "-modes", 32], marks=pytest.mark.long),
        ("rough", ["-order", 4, "-h", 0.4, "-modes", 32]),
        pytest.param("sphere-on-block", ["-order", 1, "-h", 0.5], marks=pytest.mark.long),
        pytest.param("sphere-on-block", ["-order", 2, "-h", 0.8], marks=pytest.mark.long),
        ("sphere-on-plane", ["-order", 2, "-h", 0.2]),
    ],
)
def test_products(scene, flags, tmp_path):
    """The same as with the matrix to 1 %, for a smooth pressure and for one force."""
    values = told(snippet(tmp_path, scene_text(scene) + PRODUCTS, *flags))
    assert values["levels"][0] >= 3
    assert values["off0"][0] < 0.01
    assert values["off1"][0] < 0.02


TURNED = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, -1, 3, 2, 1};
Rotate {{0, 0, 1}, {0, 0, 0}, Atan(0.75)} { Volume{1}; }
f() = Abs(Boundary{ Volume{1}; });
Physical Volume("block") = {1}; Physical Surface("left") = {f(0)}; Physical Surface("side") = {f(1)};
Physical Surface("front") = {f(2)}; Physical Surface("base") = {f(4)}; Physical Surface("top") = {f(5)};
Mesh.MeshSizeMax = 0.22;
"""
TURNED_CASE = """body block E 1 nu 0.3
obstacle top plane 0 0 1 0 0 -1
obstacle side plane 1.8 2.6 0 -0.8 -0.6 0
symmetry left
symmetry front
clamp base
"""


def test_products_of_a_case(tmp_path):
    """Contacts that face two ways, in mirrors that are no axes: each in its own plane, the other one not felt."""
    (tmp_path / "turned.geo").write_text(TURNED)
    (tmp_path / "turned.case").write_text(TURNED_CASE)
    text = (ROOT / "edp/parts-3d.edp").read_text()
    parts = (ROOT / "edp/parts.edp").read_text().split('include "solve/solve.idp"')[0]
    text = text.replace('include "parts.edp"', parts) + PRODUCTS
    text += 'for (int n = 3000; n < 5000; n += 1000) tell("offered" + n, levelsOffered(n));\n'
    values = told(snippet(tmp_path, text, "-mesh", "turned.geo", "-case", "turned.case", "-order", 1))
    assert values["offered3000"][0] == 0 < values["offered4000"][0]
    assert values["levels"][0] >= 2
    assert values["off0"][0] < 0.01
    assert values["off1"][0] < 0.02


SYNTHETIC = """
int side = countFlag("-side", 60, "points a side", 2, 1000);
flagsDone("a grid of points on a half-space, in a quarter");
macro grown(field) field.resize(points);
field = 0; //
points = side * side;
grown(pointX) grown(pointY) grown(pointZ) grown(normalX) grown(normalY) grown(normalZ)
grown(weight) grown(overlapBefore) grown(immobile) grown(paired) grown(contactOf)
paired = 1; normalZ = 1; verticalGaps = true; mirrorX = true; mirrorY = true; copies = 4; patch = 6;
contactLength = patch; weight = 4 * (patch / (side - 1.))^2;
for (int i = 0; i < points; i++)
{
    int place = (7919 * i) % points;          // in no order
    int row = place / side; int column = place % side; pointX[i] = patch * column / (side - 1.);
    pointY[i] = patch * row / (side - 1.);
    if (column == 0 || column == side - 1) weight[i] *= 0.5;
    if (row == 0 || row == side - 1) weight[i] *= 0.5;
    overlapBefore[i] = -(pointX[i]^2 + pointY[i]^2) / (2 * radius);
}
localCompliance = (1 - nu * nu) / (pi * youngModulus);
pressBy(u0);
tell("hertz", 4. / 3 * youngModulus / (1 - nu * nu) * sqrt(radius) * (u0 - d0)^1.5);
setUpContact();
setUpPreconditioner();
noteKernel(true);
kernelC = 0; preconditionerInUse = "kernel";
applyLoad(1.);
sFree = sRest;
firstThreshold();
solveOnCoarse();
tell("stride", startStride);
solveOnFine();
modelInPlace = true;
productsOf(q, Cq, 0, true);
presentOverlaps();
real[int] forces = q; tell("residual", residualNow()); tell("force", forces.sum);
"""


@pytest.mark.parametrize("side", [pytest.param(45, marks=pytest.mark.long), pytest.param(224, marks=pytest.mark.long)])
def test_start(side, tmp_path):
    """The start of a stiff law on a half-space without body: found on some points, solved on all; Hertz's force."""
    scene = scene_text("sphere-on-block").split("flagsDone(")[0]
    values = told(snippet(tmp_path, scene + SYNTHETIC, "-side", side, "-kappa", 1e9, "-u0", 2))
    assert values["stride"][0] > 1
    assert values["residual"][0] < 2e-3
    assert values["force"][0] == pytest.approx(values["hertz"][0], rel=0.02)


@pytest.mark.parametrize(
    "scene, flags",
    [
        ("rough", ["-order", 1, "-h", 0.2]),
        pytest.param("sphere-on-block", ["-order", 1, "-h", 0.8, "-kappa", 1e9], marks=pytest.mark.long),
    ],
)
def test_runs(scene, flags, tmp_path):
    """With the hierarchy in the matrix's place a run shall need hardly more, and find the same."""
    package = tree(tmp_path / "package")
    name = package / "edp" / "options" / "many" / "levels.idp"
    text = name.read_text()
    assert text.count("int manyOnLevels = 1500;") == 1
    usual = run(scene, *flags).summary
    name.write_text(text.replace("int manyOnLevels = 1500;", "int manyOnLevels = 20;"))
    other = run_in(package, script(scene), *flags, "-estimate", 0, "-vtu", 0, out=tmp_path / "levels").summary
    assert other["force"] == pytest.approx(usual["force"], rel=1e-5) and other["force"] != usual["force"]
    assert other["newton"] <= usual["newton"] + 1
    assert other["backsolves"] <= usual["backsolves"] + 5


def test_no_convergence(tmp_path):
    """Where products over grids do not solve the model a matrix shall take their place, said once: no run hangs."""
    package = tree(tmp_path / "package")
    many = package / "edp" / "options" / "many"
    for name, before, after in (
        ("levels.idp", "int manyOnLevels = 1500;", "int manyOnLevels = 20;"),
        ("levels-inverse.idp", "int innerMost = 300;", "int innerMost = 1;"),
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
    name = package / "edp" / "kernel" / "preconditioner.idp"
    text = name.read_text()
    assert text.count("int densePointsMost = 6000;") == 1
    usual = run("disc-on-block", "-kappa", 1e6).summary
    name.write_text(text.replace("int densePointsMost = 6000;", "int densePointsMost = 20;"))
    flags = ["-kappa", 1e6, "-order", 1, "-estimate", 0, "-vtu", 0]
    other = run_in(package, script("disc-on-block"), *flags, out=tmp_path / "diagonal")
    assert other.summary["force"] == pytest.approx(usual["force"], rel=1e-5)
    assert other.summary["backsolves"] > usual["backsolves"]
    assert other.stdout.count("too many for a matrix of the kernel") == 1
