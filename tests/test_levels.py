"""Products with the kernel of many points, without its matrix: against the matrix, in plane and space, and whole runs."""

import pytest
from freefem import run_in, scene_text, script, snippet, told, tree

PRODUCTS = """
setUpKernel();
{
    int[int] all(points);
    for (int i = 0; i < points; i++) all[i] = i;
    real[int] v(points);
    real[int] column(points);
    real[int] fast(points);
    real[int] slow(points);
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
        fast -= slow;
        tell("off" + test, fast.l2 / slow.l2);
    }
    tell("levels", levels);
}
"""


@pytest.mark.parametrize(
    "scene, flags",
    [
        ("rough", ["-order", 1, "-h", 0.05, "-modes", 32]),
        ("rough", ["-order", 2, "-h", 0.1, "-modes", 32]),
        ("disc-on-block", ["-order", 4, "-h", 0.1]),
        ("sphere-on-block", ["-order", 1, "-h", 0.4]),
        ("sphere-on-block", ["-order", 2, "-h", 0.8]),
        ("sphere-on-plane", ["-order", 2, "-h", 0.2]),
    ],
)
def test_products(scene, flags, tmp_path):
    """The same as with the matrix to 1 %, for a smooth pressure and for one force."""
    values = told(snippet(tmp_path, scene_text(scene) + PRODUCTS, *flags))
    assert values["levels"][0] >= 1
    assert values["off0"][0] < 0.01
    assert values["off1"][0] < 0.02


@pytest.mark.parametrize("scene, flags", [("rough", ["-h", 0.2]), ("sphere-on-block", ["-h", 0.6, "-kappa", 1e9])])
def test_runs(scene, flags, tmp_path):
    """With the hierarchy in the matrix's place a run shall need hardly more, and find the same."""
    package = tree(tmp_path / "package")
    name = package / "edp" / "kernel" / "levels.idp"
    text = name.read_text()
    assert text.count("int manyOnLevels = 1500;") == 1
    flags = [*flags, "-vtu", 0]
    usual = run_in(package, script(scene), *flags, out=tmp_path / "usual").summary
    name.write_text(text.replace("int manyOnLevels = 1500;", "int manyOnLevels = 50;"))
    other = run_in(package, script(scene), *flags, out=tmp_path / "levels").summary
    assert other["force"] == pytest.approx(usual["force"], rel=1e-5)
    assert other["newton"] <= usual["newton"] + 1
    assert other["backsolves"] <= usual["backsolves"] + 5


MANY = """
setUpKernel();
{
    // so many points on a square grid, under the scene's sphere; no body stands behind them
    int across = 224;
    real spacing = 2 * patch / (across - 1);
    points = across^2;
    macro sized(field) field.resize(points);
    field = 0; //
    sized(pointX)
    sized(pointY)
    sized(pointZ)
    sized(weight)
    sized(overlapBefore)
    sized(paired)
    sized(normalX)
    sized(normalY)
    sized(normalZ)
    for (int i = 0; i < points; i++) pointX[i] = -patch + spacing * (i % across);
    for (int i = 0; i < points; i++) pointY[i] = -patch + spacing * (i / across);
    for (int i = 0; i < points; i++) overlapBefore[i] = -separation(pointX[i], pointY[i], 0);
    real[int] place = pointX;
    real[int] beside = pointY;
    int[int] order(points);
    for (int i = 0; i < points; i++) order[i] = i;
    mortonPlace(place, beside);
    sort(place, order);
    macro sorted(field)
    {
        real[int] copy = field(order);
        field = copy;
    } //
    sorted(pointX)
    sorted(pointY)
    sorted(overlapBefore)
    weight = spacing^2;
    normalZ = 1;
    paired = 1;
    setUpKernel();
    setUpProblem();
    setUpPreconditioner();
    kernelUsed = true;
    kernelC = 0;
    real begun = clock();
    applyLoad(1);
    sFree = sRest;
    firstThreshold();
    preconditionerInUse = "kernel";
    solveOnCoarse();
    solveOnFine();
    tell("residual", residual);
    tell("start", clock() - begun);
    int[int] A(0);
    real[int] soft(0);
    real[int] b(0);
    tell("contact", contactSystem(A, soft, b));
    begun = clock();
    preconditionerFor(A, soft);
    real[int] out(A.n);
    precondition(b, out);
    tell("preconditioner", clock() - begun);
    tell("force", q.sum);
}
exec("grep VmHWM /proc/$PPID/status");
"""


@pytest.mark.long
def test_many_points(tmp_path):
    """50 000 points in space: start and preconditioner in 2 GB and two minutes."""
    flags = ["-order", 1, "-h", 2, "-layers", 2, "-patch", 5, "-symmetry", "whole", "-kappa", 1e6]
    output = snippet(tmp_path, scene_text("sphere-on-block") + MANY, *flags)
    values = told(output)
    assert values["residual"][0] < 1e-3
    assert values["contact"][0] > 20000
    assert values["start"][0] + values["preconditioner"][0] < 120
    assert int(output.split("VmHWM:")[1].split()[0]) < 2e6
