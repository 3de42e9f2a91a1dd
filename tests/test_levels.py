"""Products with the kernel of many points without its matrix: against the matrix, and whole runs."""

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
