"""The rival method ipopt: the same answers as the package's methods, its counts, its limits, where it is offered."""

import numpy as np
import pytest
from freefem import FREEFEM, OPEN, ROOT, WALL, cases_of, execute, run, run_in, script, tree

DISC, WITH_IPOPT = "disc-on-block", "disc-on-block-ipopt"
LAWS = {
    "base": [],
    "stiff": ["-kappa", 1e6],
    "stiffer": ["-kappa", 1e12],
    "m=20": ["-m", 20],
    "exponential": ["-law", "exponential"],
    "barrier": ["-law", "barrier"],
}


@pytest.mark.parametrize(
    "law, h, order",
    cases_of([("stiff", 0.25, 1)], [("base", 0.5, 1), ("stiff", 0.5, 2), ("base", 0.25, 2), ("stiff", 0.25, 2)]),
)
def test_same_answer_as_newton(law, h, order):
    """IPOPT's minimum of the energy shall carry the force that Newton's method finds, to 1e-6, at no more energy."""
    flags = [*LAWS[law], "-h", h, "-order", order]
    newton = run(DISC, "-method", "newton", "-tol", 1e-10, *flags)
    ipopt = run(WITH_IPOPT, *flags)
    assert ipopt.method == "ipopt"
    assert ipopt.newton <= 20
    assert ipopt.force == pytest.approx(newton.force, rel=1e-6)
    assert ipopt.energy == pytest.approx(newton.energy, rel=1e-9)
    assert (ipopt.contact["status"] == newton.contact["status"]).all()
    difference = np.abs(ipopt.contact["pressure"] - newton.contact["pressure"]).max()
    assert difference <= 1e-6 * newton.pressureMax


@pytest.mark.parametrize("law", [*(law for law in ("stiffer", "exponential", "m=20")), "barrier"])
def test_same_answer_on_every_law(law):
    """Laws that overflow or end at a finite overlap shall not stop IPOPT, nor need more than 20 iterations."""
    extended = run(DISC, *LAWS[law], "-h", 0.5, "-tol", 1e-10)
    ipopt = run(WITH_IPOPT, *LAWS[law], "-h", 0.5)
    assert ipopt.force == pytest.approx(extended.force, rel=1e-6)
    assert ipopt.newton <= 20


@pytest.mark.parametrize("order, h", [(1, 0.5), (2, 2), (2, 0.5)])
def test_hard_contact_by_bounds(order, h):
    """With -law signorini IPOPT shall find hard contact: a wall at d0, pressure nowhere else."""
    flags = ["-h", h, "-order", order]
    hard = run(DISC, "-method", "signorini", *flags)
    ipopt = run(WITH_IPOPT, "-law", "signorini", *flags)
    contact = ipopt.contact
    assert ipopt.force == pytest.approx(hard.force, rel=1e-8)
    assert (contact["status"] == hard.contact["status"]).all()
    assert set(contact["status"]) == {OPEN, WALL}
    assert (contact["overlap"][contact["status"] == WALL] == -0.25).all()


def test_counts():
    """Every iteration of IPOPT shall be a row of the history, with one factorisation."""
    result = run(WITH_IPOPT, "-h", 0.5)
    assert list(result.history["newton"]) == list(range(1, result.newton + 1))
    assert result.adaptations == 1
    assert result.newtonPerAdaptation == [result.newton]
    assert result.factorisations == result.backsolves == result.newton
    assert result.history["residual"][-1] == result.residual
    assert "ff-Ipopt" in result.plugins
    assert "solver/methods/ipopt" in result.modules


@pytest.mark.parametrize("flags", [[], ["-law", "signorini"]])
def test_not_converged(flags):
    """A run that IPOPT can not finish shall end with code 20, its files written, and name the flag to turn."""
    result = run(WITH_IPOPT, *flags, "-h", 1, "-maxNewton", 2, expect=20)
    assert result.summary["converged"] is False
    assert "-maxNewton" in result.message
    assert len(result.history) == result.newton == 2


@pytest.mark.parametrize("script", ["edp/main.edp", "edp/scenes/meshed-disc.edp"])
def test_refused_without_the_plugin(tmp_path, script):
    """Where the plugin is not loaded, -method ipopt shall be refused, and the script that has it be named."""
    out = tmp_path / "out"
    refused = run_in(ROOT, script, "-method", "ipopt", out=out, expect=10)
    assert "edp/scenes/disc-on-block-ipopt.edp" in refused.stdout
    assert not out.exists()


def test_said_in_one_line_where_the_plugin_is_not(tmp_path):
    """Where FreeFEM has no plugin ff-Ipopt the scene shall say so in one line, with code 10, nothing written."""
    package = tree(tmp_path / "it's here")
    plugin = package / "edp/scenes/ipopt/plugin.edp"
    plugin.write_text(plugin.read_text().replace("ff-Ipopt", "ff-Nowhere"))
    code, stdout = execute([*FREEFEM, script(WITH_IPOPT), "-h", 1], package)
    assert (code, stdout.count("\n")) == (10, 1) and "no plugin ff-Ipopt" in stdout
    assert not (package / "results").exists()


def test_force_is_refused(tmp_path):
    """A prescribed force shall be refused, with nothing written."""
    out = tmp_path / "out"
    refused = run_in(ROOT, "edp/scenes/disc-on-block-ipopt.edp", "-force", 100, out=out, expect=10)
    assert "-force" in refused.stdout
    assert not out.exists()


@pytest.mark.parametrize(
    "folder, name", [("edp", "scenes/disc-on-block-ipopt.edp"), ("edp/scenes", "disc-on-block-ipopt.edp")]
)
def test_runs_from_other_folders(tmp_path, folder, name):
    """The script shall run from edp/ and from its own folder too, and leave nothing behind in it."""
    before = sorted((ROOT / folder).iterdir())
    run_in(ROOT / folder, name, "-h", 1, "-vtu", 0, out=tmp_path / "out")
    assert sorted((ROOT / folder).iterdir()) == before
    assert not (tmp_path / "out" / ".run" / "ipopt.opt").exists()
