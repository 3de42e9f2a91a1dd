"""The influence matrix of the surrogate: by array operations the same as column by column, of all or some points."""

import numpy as np
import pytest
from freefem import scene_text, snippet, told

TEXT = """
setUpContact();
func int compare(string name, int[int] & I, real[int] & w)
// Prints the matrix of computeSurrogateMatrix() without polynomial, and its columns computed singly.
{
    real[int,int] G(0, 0);
    real[int] all(0), column(I.n);
    polynomialCoeff = 0;
    computeSurrogateMatrix(I, w, G);
    real[int] found(I.n * I.n), single(I.n * I.n);
    for (int j = 0; j < I.n; j++) found(j * I.n : j * I.n + I.n - 1) = G(:, j);
    for (int j = 0; j < I.n; j++)
    {
        computeInfluenceColumn(I, w, j, column);
        single(j * I.n : j * I.n + I.n - 1) = column;
    }
    tell(name, found);
    tell(name + "-single", single);
}
fitPointsMax = 0.7 * points;
real[int] complete(2);
computeInfluenceMatrix();
complete[0] = influenceComplete;
int[int] all = 0 : points - 1;
compare("all", all, pointCell);
int[int] third = 0 : 3 : points - 1;
real[int] w(third.n);
computeCoarseWeights(third, w);
compare("third", third, w);
int[int] second = 0 : 2 : points - 1;
real[int,int] testForce(points, 1), residuals(second.n, 1);
for (int i = 0; i < points; i++) testForce(i, 0) = weight[i] * (1 + pointX[i]);
residuals = 0;
subtractInfluence(all, second, testForce, residuals);
real[int] subtracted = residuals(:, 0);
tell("subtracted", subtracted);
influenceComplete = false;
residuals = 0;
subtractInfluence(all, second, testForce, residuals);
subtracted = residuals(:, 0);
tell("subtracted-single", subtracted);
fitPointsMax = 0.4 * points;
resetSurrogate();
computeInfluenceMatrix();
complete[1] = influenceComplete;
tell("complete", complete);
"""


@pytest.mark.parametrize("flags", [("-order", 2), ("-order", 4), ("-order", 2, "-half", 1)], ids=["P2", "P4", "half"])
def test_filled_as_column_by_column(tmp_path, flags):
    """Neither way of computing shall differ from the other; more points than twice fitPointsMax get no whole matrix."""
    said = told(snippet(tmp_path, scene_text("disc-on-block") + TEXT, "-h", 1, *flags))
    assert list(said["complete"]) == [1, 0]
    for name in ("all", "third", "subtracted"):
        found, single = said[name], said[f"{name}-single"]
        assert len(found) > 10 and np.abs(found - single).max() < 1e-12 * np.abs(single).max(), name
