"""A roller bearing whose rollers are free: some carry, some hardly, some touch nothing; what a run says of each."""

import json
import re

import pytest
from freefem import part, scene_text, snippet, told

ROLLERS = 8
GEO = """
DefineConstant[ count = 8 ];
DefineConstant[ clear = 0 ];
Point(1) = {0, 0, 0};
Macro Ring
  For k In {1 : 4}
    Point(at + k) = {r * Cos(k * Pi / 2), r * Sin(k * Pi / 2), 0};
  EndFor
  For k In {1 : 4}
    Circle(at + k) = {at + k, 1, at + k % 4 + 1};
  EndFor
  Curve Loop(at) = {at + 1 : at + 4};
Return
at = 10; r = 14; Call Ring;
at = 20; r = 20; Call Ring;
at = 30; r = 30 + clear; Call Ring;
at = 40; r = 38; Call Ring;
Plane Surface(1) = {20, 10};
Plane Surface(2) = {40, 30};
all() = {};
For n In {1 : count}
  at = 100 * n; p = -Pi / 2 + (n - 1) * 2 * Pi / count;
  Point(at) = {25 * Cos(p), 25 * Sin(p), 0};
  For k In {1 : 4}
    Point(at + k) = {25 * Cos(p) + 5 * Cos(p + k * Pi / 2), 25 * Sin(p) + 5 * Sin(p + k * Pi / 2), 0};
  EndFor
  For k In {1 : 4}
    Circle(at + k) = {at + k, at, at + k % 4 + 1};
  EndFor
  Curve Loop(at) = {at + 1 : at + 4};
  Plane Surface(at) = {at};
  Physical Surface(Sprintf("roller%g", n)) = {at};
  Physical Curve(Sprintf("r%g", n)) = {at + 1 : at + 4};
  all() += {at + 1 : at + 4};
EndFor
Physical Curve("bore") = {11 : 14};
Physical Curve("inner-race") = {21 : 24};
Physical Curve("outer-race") = {31 : 34};
Physical Curve("outside") = {41 : 44};
Physical Surface("inner") = {1};
Physical Surface("outer") = {2};
Mesh.MeshSizeMax = 2;
"""
BODIES = "units mm MPa\nsize contact 0.035\nclamp outside\nforce bore 0 -500\n" + "".join(
    f"body {name} E 210e3 nu 0.3\n" for name in ("inner", "outer", *(f"roller{n + 1}" for n in range(ROLLERS)))
)
CASE = BODIES + "".join(f"contact r{n + 1} {race}-race\n" for n in range(ROLLERS) for race in ("inner", "outer"))
ONE_BY_ONE = 'macro beforeSolution() dampedCyclesMax = 0; //\ninclude "parts.edp"\n'
# does what holds idle rollers carry nothing, if it carries these shares of all forces?
SHARES = (0, 1e-8, 1e-4)
HELD = """
real[int] nothing(shares.n);
for (int k = 0; k < shares.n; k++)
{
    freeModeAmplitude = 1;
    real[int] held = modeRegularisation * freeModeAmplitude;
    freeModeAmplitude *= shares[k] * max(q.l1, freeModeLoad.linfty) / held.linfty;
    nothing[k] = isRegularisationIdle(q);
}
tell("nothing", nothing);
"""


@pytest.fixture(scope="module")
def bearing(tmp_path_factory):
    return part(tmp_path_factory.mktemp("bearing"), GEO, CASE, "-order", 1)


def by_name(run):
    """The contacts and their errors, by name."""
    summary = run.summary
    both = zip(summary["contacts"], summary["estimates"]["contacts"], strict=True)
    return {contact["name"]: (contact, errors) for contact, errors in both}


def test_one_point_at_a_time(bearing, tmp_path):
    """The primal active set alone finds equilibrium, with the forces of linear elements; the usual steps take nine."""
    (tmp_path / "a.geo").write_text(GEO)
    (tmp_path / "a.case").write_text(CASE.replace("contact 0.035", "contact 0.1"))
    flags = ["-mesh", "a.geo", "-case", "a.case", "-estimate", 0, "-vtu", 0, "-out", tmp_path / "out"]
    idle = told(snippet(tmp_path, ONE_BY_ONE + f"real[int] shares = {list(SHARES)};" + HELD, *flags))
    assert idle["nothing"].tolist() == [1, 1, 0]
    one = json.loads((tmp_path / "out/summary.json").read_text())
    assert one["converged"] and one["residual"] < 1e-6 and one["newton"] < 25
    forces = [contact["normalForce"] for contact in one["contacts"]]
    linear = [contact["normalForce"] for contact in bearing.summary["contacts"]]
    assert forces == pytest.approx(linear, abs=2)
    assert sum(contact["force"][1] for contact in one["contacts"][::2]) == pytest.approx(-500, rel=1e-6)


@pytest.mark.parametrize("before, expect", [(1, [0.5, 0, 1, 1, 1]), (-0.5, [-1, -3, 1, 0, 1])])
def test_one_point_opens(before, expect, tmp_path):
    """Of two points that would pull, the first on the way there opens, where it carries nothing; the other stays.

    From a solution that pulls itself there is no way: both open.
    """
    text = f"""include "solver/solve.idp"
real before = {before};
saveSolution();
phatOld = 1;
phat = 1;
shat = 0;
shatOld = 0;
state = wall;
int[int] solved = state;
int one = points / 2, other = one + 1;
phatOld[one] = before;
phat[one] = -1;
phat[other] = -3;
state[one] = state[other] = open;
activeSetStep(solved);
real[int] found = [phat[one], phat[other], phat[0], real(state[one] == wall), real(state[other] == open)];
tell("found", found);
"""
    found = told(snippet(tmp_path, scene_text("disc-on-block") + text, "-order", 1, "-h", 1, "-vtu", 0))
    assert found["found"] == pytest.approx(expect, abs=1e-12)


def test_what_carries_has_errors(bearing):
    """Rollers that nothing holds take no error from the others, and add none."""
    found = by_name(bearing)
    for name in ("r1 inner-race", "r1 outer-race", "r2 inner-race", "r8 outer-race"):
        contact, errors = found[name]
        assert 0 < errors["normalForce"]["error"] < 0.2 * contact["normalForce"], name
    total = sum(contact["force"][1] for name, (contact, _) in found.items() if "inner" in name)
    assert total == pytest.approx(-500, rel=1e-6)
    assert 0 < bearing.summary["estimates"]["loads"][0]["way"]["error"] < 0.1 * bearing.summary["ways"][0]["way"]
    # beside forces of 250 what a roller with 0.1 is off by is no warning
    assert min(contact["normalForce"] for contact, _ in found.values() if contact["contactPoints"] > 0) < 1
    assert not any("means nothing" in text or "to mean anything" in text for text in bearing.summary["warnings"])
    finer = re.search(r"finer .*error of the .* of (r\d)", bearing.stdout)
    assert finer and finer[1] in ("r1", "r2", "r8"), bearing.stdout


def test_what_touches_nothing_is_named(bearing):
    """The upper rollers."""
    (row,) = re.findall(r"^  (.*) touch nothing: their places mean nothing$", bearing.stdout, re.M)
    assert row == "roller4, roller5, roller6"
    assert bearing.stdout.count("touches nowhere") + bearing.stdout.count("carries nothing") == 6
