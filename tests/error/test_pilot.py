"""-ends auto: a coarse run finds the ends of contact, and the mesh shrinks towards them."""

import numpy as np
import pytest
import reference
from freefem import ROOT, cases_of, flag_lists, refusal, run_in

STIFF = ["-order", 4, "-h", 2, "-reach", 6.95, "-corners", 0.05, "-estimate", 0, "-vtu", 0]
SHORT = [(1e9, 1)]
EVERY = [(1e9, 0), (1e12, 0), (1e12, 1)]


@pytest.mark.parametrize("kappa, half", cases_of(SHORT, EVERY))
def test_stiff_law(kappa, half, tmp_path):
    """The half-width that is found shall be within 2 %, and the force within 2e-6; without a node there it is not."""
    flags = ["-kappa", kappa, "-half", half, *STIFF]
    known = reference.values()["disc-on-block", kappa, 3]
    sought = run_in(ROOT, "edp/main.edp", *flags, "-ends", "auto", out=tmp_path / "auto")
    assert sought.pilotEnds == pytest.approx(known["halfWidth"], rel=0.02)
    assert sought.force == pytest.approx(known["force"], rel=2e-6)
    assert sought.factorisations == 2
    assert sought.newton <= 5
    assert sought.warnings == []
    given = run_in(ROOT, "edp/main.edp", *flags, "-ends", sought.pilotEnds, out=tmp_path / "given")
    assert sought.ndof == given.ndof
    assert sought.force == pytest.approx(given.force, rel=1e-8)
    np.testing.assert_allclose(sought.contact["x"], given.contact["x"], atol=1e-9)
    np.testing.assert_allclose(sought.contact["pressure"], given.contact["pressure"], atol=1e-5)
    if half:
        coarse = run_in(ROOT, "edp/main.edp", *flags, out=tmp_path / "coarse")
        assert abs(coarse.force / known["force"] - 1) > 1e-4
        times = [done.seconds for done in (sought, given, coarse)]
        used = [each["assembly"] + each["factorisation"] + each["contact"] for each in times]
        assert used[0] > used[1]  # the coarse run is charged


OTHERS = flag_lists(
    "-offset 3 -kappa 1e9 | -h 1 -order 2 | -force 100 -law signorini | -R 1 -h 0.2 -law signorini"
    "| -geometry axisymmetric"
)


@pytest.mark.parametrize("flags", cases_of(OTHERS[1:2], [OTHERS[0], *OTHERS[2:]]), ids=str)
def test_other_contacts(flags, tmp_path):
    """Off the middle, under a force, of few elements, about an axis: within 3 % of the half-width that results."""
    done = run_in(ROOT, "edp/main.edp", *flags, "-ends", "auto", "-vtu", 0, "-estimate", 0, out=tmp_path / "out")
    assert done.pilotEnds == pytest.approx(done.halfWidth, rel=0.03)
    x = done.contact["x"] - float(dict(zip(flags[::2], flags[1::2], strict=True)).get("-offset", 0))
    near = abs(abs(x) - done.pilotEnds)
    assert np.diff(np.sort(x))[np.argsort(near)[:1]].min() < 0.2 * np.diff(np.sort(x)).max()


def test_nothing_touches(tmp_path):
    """Without contact the run shall warn and keep its even mesh."""
    done = run_in(ROOT, "edp/main.edp", "-u0", 0.1, "-ends", "auto", "-vtu", 0, out=tmp_path / "out")
    assert (done.force, done.pilotEnds) == (0, 0)
    assert [warning for warning in done.warnings if warning.startswith("-ends auto: there is no single contact")]


REFUSED = {
    "flat-punch": "-ends auto: no coarse run finds the contact of this scene",
    "disc-on-block -accuracy 1e-4": "-ends auto: -accuracy finds the ends of contact itself",
    "disc-on-block -history 1": "-ends auto: only for one load",
    "disc-on-block -corners 0": "-ends auto: with -corners 0 nothing shrinks",
}


@pytest.mark.parametrize("words", REFUSED)
def test_refused(words, tmp_path):
    """What a coarse run cannot tell shall be refused by one line."""
    assert refusal(tmp_path, *words.split(), "-ends", "auto").startswith(REFUSED[words])
