"""The estimates of the error and `-accuracy`, against references by an independent code and against finer meshes."""

import re
from itertools import count

import numpy as np
import pytest
import reference
from freefem import ROOT, cases_of, data, run_in, script, snippet, told
from scenes.test_examples import example

from postprocess import closed_forms as forms

HARD = (float("inf"), 1.0)


@pytest.fixture
def solved(tmp_path):
    """solved(scene, *flags) runs a scene; its summary."""

    numbers = count()

    def go(scene, *flags, expect=0):
        return run_in(ROOT, script(scene), *flags, "-vtu", 0, out=tmp_path / str(next(numbers)), expect=expect)

    return go


def true_errors(run, kappa, m):
    """quantity: |value - reference| for the disc on the block."""
    known = reference.values()["disc-on-block", kappa, m]
    return {name: abs(run.summary[name] - known[name]) for name in ("force", "pressureMax", "halfWidth")}


LAWS = (1e3, 3), (1e9, 3), (1e3, 10), HARD


@pytest.mark.parametrize(
    "law, order, h",
    [(law, order, h) for law in LAWS for order, h in ((1, 0.25), (2, 0.5), (4, 1), (4, 0.5))],
)
def test_estimates_hold(solved, order, h, law):
    """The error that is said shall be at least the true one, and not too much more."""
    flags = ["-law", "signorini"] if law == HARD else ["-kappa", law[0], "-m", law[1]]
    run = solved("disc-on-block", *flags, "-order", order, "-h", h, "-tol", 1e-8)
    true = true_errors(run, *law)
    for name, error in true.items():
        assert run.estimates[name]["error"] >= error, name
    # now and then the true error changes its sign: then what is said is small at least
    assert run.estimates["force"]["error"] <= max(30 * true["force"], 1e-5 * run.force)
    assert sum(run.estimates["parts"].values()) == pytest.approx(run.estimates["force"]["error"])


@pytest.mark.parametrize("order, h", cases_of([(1, 1), (2, 2)], [(3, 2.5), (2, 1.4)]))
def test_in_space(solved, order, h):
    """In space too: the sphere on the block."""
    run = solved("sphere-on-block", "-order", order, "-h", h)
    known = reference.values()["sphere-on-block", 1e3, 3]
    for name in ("force", "pressureMax"):
        assert abs(run.summary[name] - known[name]) <= run.estimates[name]["error"], name
    assert run.estimates["force"]["error"] <= 15 * abs(run.force - known["force"])
    # a quadratic function follows P2's pressures; their neighbours' mean would be 6 % away
    assert order == 1 or run.estimates["pressureMax"]["error"] <= 0.035 * run.pressureMax


def test_between_two_bodies_in_space(solved):
    """Between two balls the gap and both traces shall be taken where they are: lines between points say much more."""
    run = solved("two-spheres", "-h", 0.4)
    fine = 0.29066
    assert abs(run.approach - fine) <= run.estimates["approach"]["error"] <= 15 * abs(run.approach - fine)
    assert run.estimates["parts"]["line"] < 0.03 * run.force


SLAB = """SetFactory("OpenCASCADE"); Rectangle(1) = {0, SIDE, 0, 5, 5};
Physical Surface("slab") = {1}; Physical Curve("below") = {1}; Physical Curve("above") = {3}; MeshSize{:} = 2;
"""
ENDS = """
tell("pressure", phat);
tell("x", pointX);
tell("error", contactEndPressureError(phat.imax));
"""


@pytest.mark.parametrize("name", cases_of(["above", "scene"], ["below"]))
def test_end_of_contact_about_an_axis(tmp_path, name):
    """The peak's error by the ends shall count the contact on both sides of the axis, whichever way the chain goes."""
    flags = ["-order", 3, "-vtu", 0, "-estimate", 0]
    if name == "scene":
        flags += ["-h", 1, "-geometry", "axisymmetric", "-kappa", 1e9]
    else:
        sign, held = (1, "below") if name == "above" else (-1, "above")
        (tmp_path / "a.geo").write_text(SLAB.replace("SIDE", "-5" if sign > 0 else "0"))
        text = f"obstacle {name} circle 0 {10 * sign} R 10 move 0 {-0.1 * sign}\nclamp {held}\nsize contact 0.4\n"
        (tmp_path / "a.case").write_text("state axisymmetric\nbody slab E 1000 nu 0.3\n" + text)
        flags += ["-mesh", "a.geo", "-case", "a.case"]
    lines = f'include "{"main" if name == "scene" else "parts"}.edp"\n{ENDS}'
    numbers = told(snippet(tmp_path, lines, *flags))
    order = np.argsort(numbers["x"])
    x = numbers["x"][order]
    last = np.flatnonzero(numbers["pressure"][order]).max()
    spacing = x[last + 1] - x[last]
    expected = 4 * numbers["pressure"].max() * (2 * spacing / (2 * x[last] + spacing)) ** 3
    assert numbers["error"][0] == pytest.approx(expected, rel=1e-6)


def test_algebra(solved):
    """What the algebra leaves shall be predicted within a fifth."""
    exact = solved("disc-on-block", "-h", 1, "-tol", 1e-12, "-estimate", 0)
    for tol in (1e-2, 1e-3):
        loose = solved("disc-on-block", "-h", 1, "-tol", tol, "-start", "none", "-forcing", 0.9, "-kappa", 1e3)
        assert 1e-9 < loose.residual < 1e-2
        assert loose.estimates["parts"]["algebra"] == pytest.approx(abs(loose.force - exact.force), rel=0.2), tol


def test_model(solved):
    """What the threshold leaves shall be told apart and be of the right size."""
    flags = "-method", "paper", "-order", 1, "-T0", "d0", "-kappa", 1e9, "-h", 0.5
    rough = solved("disc-on-block", *flags, "-eps", 0.2)
    exact = solved("disc-on-block", *flags, "-eps", 1e-10, "-estimate", 0)
    true = abs(rough.force - exact.force)
    assert rough.wallPoints > 0 and true > 0
    # a bound: the energy norm of the gain times that of the error, so some times the error of the force
    assert true <= rough.estimates["parts"]["model"] <= 10 * true


def test_prescribed_force(solved):
    """Under a prescribed force the approach has the error, the force none."""
    coarse = solved("disc-on-block", "-force", 150, "-h", 1)
    fine = solved("disc-on-block", "-force", 150, "-order", 4, "-h", 0.5, "-estimate", 0)
    assert coarse.estimates["force"]["error"] == 0
    off = abs(coarse.approach - fine.approach)
    assert off <= coarse.estimates["approach"]["error"] <= 20 * off


def test_prescribed_force_on_a_soft_law(solved):
    """What is off at the contact moves the greatest pressure under a given force too; what is off far away does not."""
    law = ("-force", 19.42, "-d0", -0.001763, "-m", 1.149, "-kappa", 63.62, "-nu", 0.2139)
    coarse, fine = (solved("disc-on-block", *law, "-order", order, "-h", h) for order, h in ((2, 0.4116), (4, 0.3)))
    true = abs(coarse.pressureMax - fine.pressureMax)
    assert true + fine.estimates["pressureMax"]["error"] <= coarse.estimates["pressureMax"]["error"] <= 4 * true


def test_counts_are_apart(solved):
    """The estimates shall be printed, change no count of the run, and cost no more back-substitutions than a few."""
    told, silent = (solved("disc-on-block", "-h", 1, "-estimate", wanted) for wanted in (1, 0))
    assert re.search(r"^  greatest pressure +[\d.]+ ± [\d.]+ +\([\d.]+ %\)$", told.stdout, re.M)
    assert "no error estimate: -estimate 0" in silent.stdout and "±" not in silent.stdout
    for name in ("backsolves", "factorisations", "newton", "kernelNewton", "force"):
        assert told.summary[name] == silent.summary[name]
    assert 1 <= told.estimates["backsolves"] <= 8
    assert silent.estimates is None and silent.notEstimated == "-estimate 0"


def test_not_believed(solved):
    """Where a case is not covered no error shall be said, and why."""
    run = solved("adhesive-cylinder", "-h", 0.03, "-u0", -0.005, "-method", "linesearch")
    assert run.estimates is None and "another method than xnewton" in run.notEstimated
    assert solved("flat-punch", "-law", "signorini").estimates["pressureMax"] is None
    weak = solved("disc-on-block", "-kappa", 0.01, "-m", 30, "-order", 1, "-h", 1, "-u0", 0.25000000004)
    assert weak.estimates is None and "no error estimate: the contact carries nothing" in weak.stdout


def test_no_mesh_helps_a_contact_that_carries_nothing(solved):
    """Points that touch without a force are as exact as an open gap: -accuracy has nothing to aim at."""
    weak = ("-kappa", 0.01, "-m", 30, "-order", 1, "-h", 1, "-u0", 0.25000000004)
    said = solved("disc-on-block", *weak, "-accuracy", 0.01).stdout
    assert "the accuracy 0.01 needs no other mesh: the contact carries nothing: all contact forces are 0" in said


def test_too_coarse(solved):
    """A mesh that is too coarse to mean anything shall be said to be."""
    run = solved("disc-on-block", "-order", 1, "-h", 2, "-u0", 0.6)
    assert any("too coarse to mean anything" in text for text in run.warnings)
    assert run.estimates["force"]["error"] > 0.3 * run.force


@pytest.mark.parametrize("kappa", [1e3, 1e9])
def test_accuracy(solved, kappa):
    """-accuracy shall be kept by the true error, with few unknowns and few meshes, the same every time."""
    run = solved("disc-on-block", "-kappa", kappa, "-accuracy", 1e-5)
    again = solved("disc-on-block", "-kappa", kappa, "-accuracy", 1e-5) if kappa > 1e3 else run
    assert run.force == again.force and run.ndof == again.ndof
    known = reference.values()["disc-on-block", kappa, 3]["force"]
    assert abs(run.force / known - 1) <= run.accuracy["reached"] <= 1e-5
    assert run.accuracy["met"] and run.accuracy["meshes"] <= 4
    assert kappa > 1e3 or run.ndof <= 6000


def test_accuracy_of_the_pressure(solved):
    """The pressure's profile shall be as near as was asked for."""
    run = solved("disc-on-block", "-accuracy", 1e-3, "-goal", "pressure")
    assert reference.profile_error(1e3, 3, {name: run.contact[name] for name in run.contact.dtype.names}) <= 1e-3
    assert run.ndof <= 10000


COARSE_SPHERE = ("sphere-on-block", "-h", 3, "-layers", 2)


def test_accuracy_in_space(solved):
    """In space gmsh's new mesh shall keep the true error below what is asked; each mesh is told."""
    run = solved(*COARSE_SPHERE, "-accuracy", 1e-2)
    known = reference.values()["sphere-on-block", 1e3, 3]["force"]
    assert abs(run.force / known - 1) <= run.accuracy["reached"] <= 1e-2
    unknowns, said, seconds = np.array(run.accuracy["rounds"]).T
    assert len(said) == run.accuracy["meshes"] > 1 and run.ndof == unknowns[-1]
    assert said[0] > 1e-2 >= said[-1] == run.accuracy["reached"] and all(np.diff(seconds) > 0)
    assert not [path.name for path in (run.folder / ".run").glob(".*") if path.suffix in (".pos", ".msh")]


def test_limit_in_space(solved):
    """What needs too many unknowns shall be said, with code 21 and the best mesh's files."""
    run = solved(*COARSE_SPHERE, "-accuracy", 1e-3, "-unknowns", 6000, expect=21)
    assert "unknowns" in run.accuracy["why"] and run.ndof < 6000 and run.accuracy["reached"] < 0.03


@pytest.mark.parametrize("scene", ["sphere-on-block", "sphere-on-plane", "two-spheres"])
def test_space_is_deterministic(solved, scene):
    """Two runs in space shall make the same meshes."""
    first, second = (solved(scene, "-accuracy", 6e-3) for _ in range(2))
    assert first.accuracy["meshes"] > 1 and first.ndof == second.ndof
    assert first.force == second.force and first.approach == second.approach


ARCS = data("error/arcs.edp")


def test_arcs(tmp_path):
    """The curvature that a scene's straight edges stand for is that of its circles, and none on flat sides."""
    text = (ROOT / "edp/scenes/two-cylinders.edp").read_text() + ARCS
    found = told(snippet(tmp_path, text, "-order", 1, "-h", 0.2, "-estimate", 0, "-vtu", 0))
    x, y, dx, dy = (found[name] for name in ("x", "y", "alongX", "alongY"))
    flat = np.isin(found["label"], (1, 5))
    centre = np.where(found["label"] > 3, 20.1, 0)
    for px, py in ((x, y), (x + dx, y + dy)):
        np.testing.assert_allclose(np.where(flat, 10, np.hypot(px, py - centre)), 10, rtol=1e-5)
    for bend in (found["from"], found["to"]):
        np.testing.assert_allclose(bend, np.where(flat, 0, 0.1), rtol=1e-3, atol=1e-12)
    assert found["off"] == pytest.approx(1.5 * (np.arange(len(found["off"])) == 3))  # alternating pressures


def crossed_cylinders(folder, *flags, size=0.3, expect=0):
    """The example with elements of another size in the contact."""
    example = ROOT / "edp/examples/crossed-cylinders/crossed-cylinders"
    geo = folder / "own.geo"
    geo.write_text(example.with_suffix(".geo").read_text().replace("size = {0.08", f"size = {{{size}"))
    parts = "-mesh", geo, "-case", example.with_suffix(".case"), "-vtu", 0
    return run_in(ROOT, "edp/parts-3d.edp", *parts, *flags, out=folder / "run", expect=expect)


@pytest.mark.parametrize("size, asked", [(0.3, 1e-2), (0.16, 1e-2), (0.16, 3e-3)])
def test_accuracy_of_parts_in_space(tmp_path, size, asked):
    """A user's own .geo file shall be meshed again until the way that the force goes is as near as asked."""
    run = crossed_cylinders(tmp_path, "-accuracy", asked, size=size)
    way = run.estimates["loads"][0]["way"]
    fine = 0.018438  # 74 613 unknowns, second order, fine everywhere: +- 0.2 %, two such meshes 0.04 % apart
    assert run.accuracy["met"] and run.accuracy["meshes"] > 1
    assert abs(way["value"] / fine - 1) <= asked and way["error"] <= asked * way["value"]


def test_accuracy_needs_a_geometry(tmp_path):
    """A mesh file in space cannot be meshed anew: said in one line."""
    (tmp_path / "a.msh").write_text("")
    flags = "-mesh", tmp_path / "a.msh", "-case", "none.case", "-accuracy", 1e-2
    run = run_in(ROOT, "edp/parts-3d.edp", *flags, out=tmp_path / "run", expect=10)
    assert "-accuracy 0.01: new meshes need the geometry" in run.stdout and not (tmp_path / "run").exists()


def test_accuracy_on_curves(solved):
    """New meshes of two cylinders shall stay on the circles."""
    run = solved("two-cylinders", "-h", 1, "-accuracy", 1e-3)
    assert run.accuracy["met"] and run.accuracy["meshes"] > 1
    vertices = run.contact[::4]
    assert np.ptp(vertices["y"] - np.sqrt(100 - vertices["x"] ** 2)) < 1e-9


@pytest.mark.parametrize(
    "scene, flags, why",
    [
        ("disc-on-block", ["-unknowns", 5000, "-law", "signorini"], "unknowns"),
        ("flat-punch", ["-goal", "pressure", "-law", "signorini"], "no estimate"),
    ],
)
def test_accuracy_missed(solved, scene, flags, why):
    """What cannot be reached shall be said, with code 21 and the files of the best mesh."""
    run = solved(scene, "-accuracy", 1e-6, *flags, expect=21)
    assert not run.accuracy["met"] and why in run.accuracy["why"] and "NOT REACHED" in run.stdout


@pytest.mark.parametrize(
    "scene, flags", [("disc-on-block", ["-force", 5, "-goal", "force"]), ("disc-on-block", ["-goal", "approach"])]
)
def test_goals_refused(solved, scene, flags):
    """What is prescribed cannot be asked for."""
    run = solved(scene, "-accuracy", 1e-3, *flags, expect=10)
    assert "-goal" in run.stdout and "allowed" in run.stdout


# ---------------------------------------------------------------- a user's own parts

PERSSON = forms.pin_angle(forms.plane_modulus(210e3, 0.3) * 0.01 / 1000)  # of the example's pin in its hole
PIN_MOVED = 0.0238430  # P4, 117 000 unknowns: -mesh with size 0.5


def parts_of(case):
    """The estimates of a case's only contact and load, and whether they hold for the pin."""
    told = case.summary["estimates"]
    contact, way = told["contacts"][0], told["loads"][0]["way"]
    assert abs(contact["pressureMax"]["value"] - forms.pin_pressure(0, PERSSON) * 1000 / 10.01) <= (
        contact["pressureMax"]["error"] + 0.05  # the plate is no infinite one
    )
    assert abs(contact["contactLength"]["value"] - 2 * 10.01 * PERSSON) <= contact["contactLength"]["error"]
    assert abs(way["value"] - PIN_MOVED) <= way["error"]
    return contact, way


def test_own_parts(tmp_path):
    """A floating pin: its force is told by the balance; pressure, length, the way of its load are known by an error."""
    case = example("pin-in-hole", tmp_path, "", "-estimate", 1, size=1.5)
    check_pin(case)


def check_pin(case):
    contact, way = parts_of(case)
    assert contact["force"]["error"] <= 1e-10 * contact["force"]["value"] and way["error"] <= 0.01 * way["value"]
    assert re.search(r"weight core moves +\S+ ± ", case.stdout)


def test_accuracy_of_own_parts(tmp_path):
    """New meshes of a user's parts shall keep their curves, and their errors what was asked for."""
    asked = "-estimate", 1, "-accuracy", 2e-2, "-goal", "pressure"
    case = example("pin-in-hole", tmp_path, "", "-order", 2, *asked, size=2)
    accuracy = case.summary["accuracy"]
    assert accuracy["met"] and accuracy["meshes"] > 1
    check_pin(case)
    radius = np.hypot(case.contact["x"], case.contact["y"])[::4]
    assert np.abs(radius - 10.01).max() < 1e-5


def test_flat_elements_are_named(solved):
    """On flat elements ± may be too small, by 2.5 times at -aspect 5: a warning says so, and only there."""
    flat = solved("disc-on-block", "-h", 1, "-half", 1, "-aspect", 5)
    usual = solved("disc-on-block", "-h", 1, "-half", 1, "-aspect", 2)
    true = 4.927623  # P4, h = 0.15: 4.9276230 ± 4.5e-6
    assert abs(usual.halfWidth - true) <= usual.estimates["halfWidth"]["error"] and not usual.warnings
    assert abs(flat.halfWidth - true) == pytest.approx(2.5 * flat.estimates["halfWidth"]["error"], rel=0.1)
    assert "-aspect 5: on flat elements" in flat.warnings[0]
