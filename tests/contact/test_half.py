"""-half 1: one half of a symmetric block, against the whole block on the half's mesh and its mirror image."""

import numpy as np
import pytest
import reference
from freefem import ROOT, cases_of, flag_lists, named, refusal, run, run_in, script, snippet, table, told, tree

from postprocess import vtu

# the whole block of a copy of the package gets the half's mesh and its mirror image
UNFOLDED = {
    "bool startsAtSymmetry = axisymmetric || mirrorX;": "bool startsAtSymmetry = true;",
    "real meshedWidth = mirrorX ? 0.5 * width : width;": "real meshedWidth = 0.5 * width;",
    "(startsAtSymmetry ? 1 : 0.5) * (contactTo - contactFrom)": "0.5 * (contactTo - contactFrom)",
    "real[int] contactAbscissae = [contactFrom,": "real[int] contactAbscissae = [0.,",
    "setBoundaryLabels(group(": """Th = Th + movemesh(Th, [-x, y]);
leftAbscissa = -0.5 * width;
meshedWidth = width;
startsAtSymmetry = false;
setBoundaryLabels(group(""",
    'int leftLabel = group("left");': "int leftLabel = freeLabel;",  # the half's left side is in the middle
}


@pytest.fixture(scope="module")
def unfolded(tmp_path_factory):
    package = tree(tmp_path_factory.mktemp("unfolded") / "package")
    block = package / "edp/scenes/blocks" / "block-plane.idp"
    text = block.read_text()
    for old, new in UNFOLDED.items():
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    block.write_text(text)
    return package


SHORT = flag_lists(
    "disc-on-block -h 1 -order 2 -bodyForce 0.2 -traction -1 -estimate 1 | disc-on-block -h 0.5 -order 1 -force 100"
    "| wavy -h 0.4 -waves 9 -order 2"
)
EVERY = flag_lists(
    "disc-on-block -h 1 -order 3 -law signorini | disc-on-block -h 1 -order 4 -kappa 1e9 -ends 4.27 -estimate 1 |"
    "flat-punch -h 1 -order 2 -geometry stress | disc-on-block -h 0.02 -order 1 -grading 2000 -reach 6.95 |"
    "disc-on-block -h 2 -order 2 -distance exact |"
    "disc-on-block -h 0.5 -order 2 -method paper | disc-on-block -h 0.5 -order 1 -method newton"
    "| disc-on-block -h 0.5 -order 4 -method linesearch | disc-on-block -h 1 -order 3 -method incremental"
    "| disc-on-block -h 1 -order 2 -method signorini | disc-on-block-ipopt -h 1 -order 2"
    "| disc-on-block -h 1 -order 2 -distance exact | disc-on-block -h 1 -order 4 -distance exact"
    "| disc-on-block -h 0.5 -order 2 -method paper -model linear | disc-on-block -h 1 -order 2 -history 1 -steps 3"
    "| hertz-line -h 0.1 -order 2 -estimate 1 | flat-punch -h 0.5 -order 4 -law signorini -estimate 1"
    "| disc-on-block -h 0.02 -order 1 | wavy -h 0.2 -order 3 -waves 20 -estimate 1"
    "| disc-on-block -h 0.5 -order 1 -estimate 1 | disc-on-block -h 1 -order 2 -reach 3 -law exponential"
)
NUMBERS = "force approach pressureMax overlapMax halfWidth halfWidthMoment energy reactionY".split()
COUNTS = "points contactPoints wallPoints adaptations warnings unpairedPoints".split()
FORCED = "threshold", "tau"  # with a prescribed force the start chooses them


@pytest.mark.parametrize("words", cases_of(SHORT, EVERY), ids=named)
def test_same_as_whole(words, unfolded, tmp_path):
    """Numbers, tables, errors and counts shall be those of the whole; the solves as many, or few more."""
    scene, *flags = [*words, "-tol", "1e-12"]
    half = run(scene, *flags, "-half", 1)
    flags += [] if "-estimate" in flags else ["-estimate", 0]
    whole = run_in(unfolded, script(scene), *flags, "-vtu", 0, out=tmp_path / "out")
    assert half.ndof < 0.52 * whole.ndof
    for name in NUMBERS:
        ours, theirs = half.summary[name], whole.summary[name]
        assert ours == theirs or ours == pytest.approx(theirs, rel=1e-10, abs=1e-12), name
    for name in COUNTS:
        assert half.summary[name] == whole.summary[name], name
    assert half.newton <= whole.newton + (half.method in ("xnewton", "ipopt"))  # the last step is at rounding
    assert half.backsolves <= 1.3 * whole.backsolves + 3
    for name in ("contactLength", "halfWidthMoment", "arcs", "normalForce", "force"):
        np.testing.assert_allclose(half.contacts[0][name], whole.contacts[0][name], rtol=1e-9, atol=1e-10, err_msg=name)
    for name in half.contact.dtype.names:
        if name in FORCED and "-force" in flags:
            continue
        ours, theirs = half.contact[name], whole.contact[name]
        finite = np.isfinite(theirs)
        assert (np.isfinite(ours) == finite).all(), name
        size = max(abs(theirs[finite]).max(initial=0), 1e-3)
        np.testing.assert_allclose(ours[finite], theirs[finite], atol=1e-9 * size, rtol=0, err_msg=name)
    if "-estimate" in words:
        for name in ("force", "approach", "pressureMax", "halfWidth", "profile", "energy"):
            ours, theirs = half.estimates[name], whole.estimates[name]
            assert (ours is None) == (theirs is None), name
            assert ours is None or ours["error"] == pytest.approx(theirs["error"], rel=2e-3), name


ROUNDING = """include "scenes/hertz-line.edp"
real[int] rounding(points);
computeRoundingPressure(rounding);
real[int] unloaded = abs(sFree), removed = abs(Cq);
tell("amplitude", freeModeAmplitude[0]);
tell("epsilon", machineEpsilon);
tell("unloaded", unloaded);
tell("removed", removed);
tell("stiffness", bodyStiffness);
tell("rounding", rounding);
"""


def test_rounding_with_a_free_mode(tmp_path):
    """With a prescribed force the approach shall count at all points of the whole, not only at those of the half."""
    numbers = told(snippet(tmp_path, ROUNDING, "-half", 1, "-h", 0.4, "-vtu", 0))
    size = numbers["unloaded"] + numbers["removed"] + abs(numbers["amplitude"])
    np.testing.assert_allclose(numbers["rounding"], numbers["epsilon"] * size * numbers["stiffness"], rtol=1e-12)


@pytest.mark.parametrize("order", [2, 4])
def test_errors_contain_each_other(order):
    """On meshes of their own both forces shall be within their errors of the true one, and of each other."""
    flags = ["-order", order, "-estimate", 1]
    true = reference.values()["disc-on-block", 1e3, 3]["force"]
    half, whole = (run("disc-on-block", *flags, "-half", value).estimates["force"] for value in (1, 0))
    for one in (half, whole):
        assert abs(one["value"] - true) < one["error"] < 1e-3 * true
        assert abs(half["value"] - whole["value"]) < one["error"]


@pytest.mark.parametrize("order", cases_of([4], [1, 2, 3]))
def test_pictures_show_the_whole(order, unfolded, tmp_path):
    """Files for ParaView and the tables of states shall be those of the whole, but for the order of nodes."""
    flags = ["-method", "newton", "-h", 2, "-order", order, "-states", 1, "-tol", 1e-12, "-estimate", 0]
    half = run_in(ROOT, "edp/main.edp", *flags, "-half", 1, out=tmp_path / "half")
    whole = run_in(unfolded, "edp/main.edp", *flags, out=tmp_path / "whole")

    def sorted_rows(rows, names):
        columns = np.array([rows[name] for name in names])
        return columns[:, np.lexsort(np.round(columns[:3], 9))]

    places = ["state", "x", "y", "ux", "uy"]
    ours, theirs = (sorted_rows(table(done.folder / "states.csv"), places) for done in (half, whole))
    np.testing.assert_allclose(ours, theirs, atol=1e-8)
    grids = [vtu.read_grid(done.folder / "solution.vtu") for done in (half, whole)]
    fields = []
    for grid in grids:
        points = np.round(grid.points[:, :2], 9)
        fields.append(np.column_stack([grid.points, grid.move, grid.stress, grid.pressure])[np.lexsort(points.T)])
    np.testing.assert_allclose(*fields, atol=1e-7)
    assert len(grids[0].skin) == len(grids[0].surface)  # no edge is left in the middle
    surfaces = [vtu.read_surface(done.folder / "contact.vtu") for done in (half, whole)]
    np.testing.assert_allclose(np.sort(surfaces[0].points[:, 0]), np.sort(surfaces[1].points[:, 0]), atol=1e-9)
    for done in (half, whole):
        assert done.models["x"].shape[1] == done.points
        assert (np.diff(done.contact["x"]) > 0).all()
    for name in half.models.dtype.names:
        ours, theirs = half.models[name], whole.models[name]
        assert (np.isfinite(ours) == np.isfinite(theirs)).all()
        np.testing.assert_allclose(ours[np.isfinite(ours)], theirs[np.isfinite(theirs)], atol=1e-9)


def test_error_shares(tmp_path):
    """The elements' shares of the error in solution.vtu shall be those of the whole: their sum is the part inside."""
    done = run_in(ROOT, "edp/main.edp", "-half", 1, "-h", 2, "-order", 2, out=tmp_path / "out")
    share = vtu.read_arrays(done.folder / "solution.vtu")["CellData", "errorShare[force]"]
    cells = share[share > 0].reshape(-1, 4)  # a P2 element as four triangles
    assert (cells == cells[:, :1]).all()
    assert cells[:, 0].sum() == pytest.approx(done.estimates["parts"]["inside"], rel=1e-9)


def test_accuracy(tmp_path):
    """New meshes of a half shall keep to the plane of symmetry and reach what is asked for."""
    done = run_in(ROOT, "edp/main.edp", "-half", 1, "-accuracy", 1e-6, "-order", 3, "-vtu", 0, out=tmp_path / "out")
    true = reference.values()["disc-on-block", 1e3, 3]["force"]
    assert done.accuracy["met"] is True
    assert len(done.accuracy["rounds"]) > 1
    assert abs(done.force / true - 1) < 1e-6
    assert abs(done.contact["x"] + done.contact["x"][::-1]).max() < 1e-12


def test_accuracy_of_pressures(tmp_path):
    """A peak in the plane of symmetry is no end of contact: hard contact shall have a bound of its profile."""
    flags = ["-half", 1, "-law", "signorini", "-goal", "pressure", "-accuracy", 5e-3, "-order", 2, "-vtu", 0]
    assert run_in(ROOT, "edp/main.edp", *flags, out=tmp_path / "out").accuracy["met"] is True


NOT_SYMMETRIC = {
    "disc-on-block -offset 1": "-offset 1: the disc is not symmetric",
    "disc-on-block -geometry axisymmetric": "-half 1 with -geometry axisymmetric: ",
    "fretting": "-half 1 with -friction: ",
    "attraction/disc-on-block": "-half 1 with an adhesive law: ",
    "meshed-disc": "-half 1: not read by this scene; allowed in: disc-on-block",
    "rough": "-half 1: not read by this scene; allowed in: disc-on-block",
}


@pytest.mark.parametrize("words", NOT_SYMMETRIC)
def test_refused(words, tmp_path):
    """Data that are not symmetric shall be refused by one line."""
    assert refusal(tmp_path, *words.split(), "-half", 1).startswith(NOT_SYMMETRIC[words])
