"""The screens: the model first, results with errors, none without convergence; help by topics; gmsh at work."""

import json
import os
import re
import subprocess

import pytest
from freefem import FREEFEM, ROOT, environment, execute, part, patience, run, run_in, script
from pages import scripts, told
from scenes.test_examples import example

from postprocess.command_line import main
from postprocess.formatting import command
from postprocess.results import read_run

EXAMPLES = ROOT / "edp/examples"
PIN = EXAMPLES / "pin-in-hole/pin-in-hole"


def screen(folder, summary, rows="", plot="", contact=""):
    """What edp/output/report/screen.sh prints of a summary."""
    folder.mkdir(exist_ok=True)
    (folder / "summary.json").write_text(json.dumps(summary, indent=1).replace("\n  ", " "))
    (folder / "contact.csv").write_text(contact)
    return execute(["sh", ROOT / "edp/output/report/screen.sh", "1", f"{folder}/", rows, plot])[1]


SUMMARY = {
    "converged": True,
    "message": "",
    "warnings": [],
    "adaptations": 1,
    "newton": 2,
    "force": 150.04036662364285,
    "approach": 2.5,
    "pressureMax": 22.557076198683834,
    "halfWidth": None,
    "contacts": [],
    "contactPoints": 39,
    "points": 81,
    "residual": 1.9771e-08,
    "notEstimated": "-estimate 0",
    "estimates": None,
    "seconds": {"total": 0.1},
    "parameters": {"verbose": 0, "tol": 1e-06, "force": 0},
}


def thick_body(thickness, state="strain"):
    """A summary of a half with a force, a moment, a preload, and no estimates."""
    own = {"bodies": [{"name": "bar"}], "units": ["mm", "MPa"], "thickness": thickness, "state": state}
    pushed, turned = {"name": "force top", "force": 48}, {"name": "moment right", "moment": 1.5}
    own["prescribed"] = [{**pushed, "times": 2}, {**turned, "times": 2}]
    own["ways"] = [{"name": "force top", "way": 0.25}, {"name": "moment right", "way": 0.125}]
    own["supports"] = [{"name": "clamp foot", "force": [0, 48]}]
    own["preloads"] = [{"name": "waist", "force": 12.5, "preload": 10, "shortened": 0.25}]
    own["moments"] = [{"name": "clamp foot", "body": "bar", "point": "", "about": [0, 0], "moment": [1.5]}]
    own["moments"][0]["printed"] = True
    return {**SUMMARY, **own}


def test_units_of_a_unit(tmp_path):
    """Forces on the screen are those of a unit of thickness, with that unit; the whole's stand beside them in N."""
    said = screen(tmp_path / "5", thick_body(5))
    for line in (
        r"  forces, moments, work and heat are those of a unit of thickness; all 5 carry 5 times as much",
        r"  force top +48 N/mm +240 N for the thickness 5, of the whole 2 times as much: 96, 480 N for the thickness 5",
        r"  moment right +1.5 N +7.5 N mm for the thickness 5",
        r"  force top moves +0.25 mm",
        r"  moment right turns +0.125 rad",
        r"  clamp foot carries +\(0, 48\) N/mm",
        r"    clamp foot +1.5 N +on bar, about \(0, 0\)",
        r"  preload waist +12.5 N/mm +under the loads; tightened to 10, 50 N for the thickness 5, shortened by 0.25",
    ):
        assert re.search(f"^{line}", said, re.M), (line, said)
    thin, ring = screen(tmp_path / "1", thick_body(1)), screen(tmp_path / "ring", thick_body(1, "axisymmetric"))
    assert "unit of thickness" not in thin + ring and "for the thickness" not in thin + ring
    assert re.search(r"^  force top +48 N/mm +of the whole 2 times as much: 96$", thin, re.M)
    open_ = thick_body(1)
    open_["prescribed"][0]["times"] = None
    said = screen(tmp_path / "open", open_)
    assert re.search(r"^  force top +48 N/mm +of the whole not known: its symmetries do not meet at 90", said, re.M)
    assert re.search(r"^  moment right +1.5 N +of the whole 2 times as much: 3$", thin, re.M)
    assert re.search(r"^  moment right +1.5 N mm +of the whole 2 times as much: 3$", ring, re.M)
    assert re.search(r"^  clamp foot carries +\(0, 48\) N$", ring, re.M)


# ---------------------------------------------------------------- whole screens


def test_screen_of_a_scene():
    """Model, iterations, results with ± and per cent, warnings, files, in this order, in 24 lines at most."""
    done = run("disc-on-block", "-order", 2, "-estimate", 1)
    lines = done.stdout.splitlines()
    heads = [
        "disc-on-block:",
        "  bodies ",
        "  contact ",
        "  load ",
        "  solution ",
        "  iteration ",
        "converged in 2 iterations, ",
    ]
    heads += ["Results (± estimated error)", "  contact force ", "  greatest pressure ", "  contact half-width "]
    heads += ["  balance:", "  no warnings", "  files ", "  more "]
    places = [next(k for k, line in enumerate(lines) if line.startswith(head)) for head in heads]
    assert places == sorted(places) and len(lines) <= 24
    assert "law power: p = kappa (d - d0)^m, kappa 1000, m 3, d0 -0.25, frictionless" in done.stdout
    assert re.search(r"^  contact force +150\.040 ± 0\.055 +\(0\.037 %\)$", done.stdout, re.M)
    assert not re.search("tol|model error|factorisations|within", done.stdout)


def test_screen_of_an_own_part(tmp_path):
    """Bodies by their names, what equilibrium makes exact, no rounding among the digits; 35 lines at most."""
    said = example("pin-in-hole", tmp_path, "", "-estimate", 1, size=0.6).stdout
    assert len(said.splitlines()) <= 35
    for line in (
        r"  body +plate: E 210000, nu 0.3; held by clamp frame",
        r"  body +pin\+core: E 210000, nu 0.3; held by contact only; free: along x, along y, rotation",
        r"  contact +bore pin-surface: hard contact, frictionless, \d+ points, initial gap 0.01",
        r"  load +weight core \(0, -1000\)",
        r"  note +pin\+core: rotation changes no gap and carries no load: it is set to 0",
        r"    resultant force +\(0, -1000\) N/mm  exact by equilibrium",
        r"    greatest pressure +[\d.]+ ± [\d.]+ +MPa +\([\d.]+ %\) +at \(-?[\d.]+, -10\.\d+\)",
        r"  clamp frame carries +\(0, 1000\) N/mm",
    ):
        assert re.search(f"^{line}$", said, re.M), line
    assert not re.search(r"e-(0[7-9]|[1-9]\d)", said.split("Results")[1])


COLUMN = """SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 4, 2}; MeshSize{:} = 1;
Physical Surface("block") = {1}; Physical Curve("base") = {1}; Physical Curve("top") = {3};
"""


@pytest.mark.parametrize("driven, exact", [("move 0 -0.01", False), ("force 0 -20", True)])
def test_exact_by_equilibrium(tmp_path, driven, exact):
    """A force on an obstacle fixes the resultant; its motion does not, even if the elements make no error."""
    case = f"body block E 1000 nu 0\nsymmetry base\nobstacle top plane 0 2 0 -1 {driven}\n"
    said = part(tmp_path, COLUMN, case, "-tol", 1e-12).stdout
    assert re.search(r"resultant force +\(0, -20\)", said) and ("exact by equilibrium" in said) is exact


def test_gaps_without_rounding(tmp_path):
    """Surfaces that touch at rest have the gap 0, not one of rounding."""
    hip = EXAMPLES / "hip-joint/hip-joint"
    words = ["-mesh", f"{hip}.geo", "-case", f"{hip}.case", "-set", "size", 0.4, "-check", 1]
    said = run_in(ROOT, "edp/parts.edp", *words, out=tmp_path / "out").stdout
    assert re.search(r"^  contact +socket ball: .*, initial gap 0 to 0\.0\d+$", said, re.M), said


def test_rolling():
    """The scene of rolling prints its creepage."""
    done = run("rolling", "-h", 0.05)
    (line,) = re.findall("^  creepage +(.*) of the length rolled$", done.stdout, re.M)
    assert float(line) == pytest.approx(done.creepage, rel=1e-5)


def test_verbose(tmp_path):
    """-verbose 1 adds statistics, shares of the error and all flags, and changes no number."""
    flags = ["-method", "paper", "-h", 1]
    short, long = (run_in(ROOT, script("disc-on-block"), *flags, "-verbose", k, out=tmp_path / str(k)) for k in (0, 1))
    assert "Details" not in short.stdout and "backsolves" not in short.stdout
    assert re.search(r"^  errors +as force: inside the bodies [\d.e-]+, on the contact line", long.stdout, re.M)
    assert f"back-substitutions {long.backsolves}," in long.stdout and "adapt" not in long.stdout
    listed = set(re.findall(r"  -(\S+) ", long.stdout.split("\nFlags\n")[1]))
    assert listed == set(long.summary["parameters"])
    left_out = {"date", "costRatio", "seconds", "parameters", "given", "estimates"}
    assert {k: v for k, v in short.summary.items() if k not in left_out} == {
        k: v for k, v in long.summary.items() if k not in left_out
    }
    models = [line.split()[-1] for line in short.stdout.splitlines() if re.search(r"   model \d+$", line)]
    assert models == [str(k) for k in range(2, short.adaptations + 1)]


# ---------------------------------------------------------------- what is no result


@pytest.mark.parametrize("flags, gap, least", [((), 0.4, 0.25), (("-law", "signorini", "-d0", 0), 0.4, 0.5)])
def test_no_contact(flags, gap, least):
    """Where nothing touches a scene says so: the gap that is left, and the approach that closes it."""
    done = run("disc-on-block", "-h", 2, "-u0", 0.1, *flags)
    (text,) = done.warnings
    assert text.startswith(f"no contact: the surfaces are {gap} apart") and text.endswith(
        f"increase -u0 beyond {least}"
    )
    assert ("0.15 more than the asperity layer (d0 = -0.25)" in text) == (not flags)
    assert f"warning: {text}" in done.stdout and "greatest pressure" not in done.stdout
    assert run("disc-on-block", "-h", 2, "-u0", 1.02 * least, *flags).force > 0


def test_not_converged():
    """Without convergence: the cause with its knob, the residual, and nothing that looks like a result."""
    done = run("disc-on-block", "-h", 2, "-maxNewton", 1, expect=20)
    after = done.stdout.split("NOT CONVERGED: ")[1]
    assert after.splitlines()[0] == done.message and "raise -maxNewton" in done.message
    assert re.search(r"^  residual \S+ \(tolerance 1e-06\) after 1 iteration, .*; there are no results$", after, re.M)
    assert not re.search("Results|contact force|greatest|plot|no warnings|±", after)


def test_accuracy_not_reached():
    """The headline says it, with the error and what was wanted as relative numbers."""
    done = run("disc-on-block", "-h", 2, "-accuracy", 1e-8, "-unknowns", 3000, expect=21)
    head = next(line for line in done.stdout.splitlines() if line.startswith("ACCURACY"))
    assert re.match(
        r"ACCURACY NOT REACHED: estimated relative error of the force \S+, wanted 1e-08: .*raise -unknowns", head
    )
    assert not re.search("^converged", done.stdout, re.M)
    assert re.search(
        r"^  mesh 1: \d+ unknowns, estimated relative error of the force \S+ \(wanted 1e-08\), ", done.stdout, re.M
    )


# ---------------------------------------------------------------- edp/output/report/screen.awk


def test_numbers(tmp_path):
    """Values have the decimals of their errors; large, small and signed ones; what is not known."""
    for value, error, shown in (
        (150.04036, 0.05509, "150.040 ± 0.055    (0.037 %)"),
        (-83.4478, 0.3, "-83.45 ± 0.30     (0.36 %)"),
        (1152.95, 740, "1150 ± 740      (64 %)"),
        (902.06, 7.9, "902.1 ± 7.9      (0.88 %)"),
        (0.0063209, 6.1e-06, "0.0063209 ± 6.1e-06  (0.097 %)"),
        (3.1e-7, 2e-9, "3.1e-07 ± 2e-09    (0.65 %)"),
        (9.9996, 0.0995, "10.000 ± 0.100    (1 %)"),
        (150.02947483143, 8.1e-10, "150.0294748 ± 1.5e-06  (1e-06 %)"),
        (40.0, 4e-11, "40.00000000 ± 4e-07    (1e-06 %)"),
        (0.0, 20.0, "0 ± 20"),
        (230.4, 310.0, "230 error not known (estimate 130 %)"),
        (7.61175e-06, 1.4e-05, "7.61e-06 error not known (estimate 180 %)"),
        (-11838.3, 1.5e9, "-11800 error not known (estimate more than 1000 %)"),
    ):
        estimates = {"force": {"value": value, "error": error}, "pressureMax": None, "parts": {"inside": 1}}
        said = screen(tmp_path / "run", {**SUMMARY, "force": value, "estimates": estimates, "notEstimated": ""})
        (line,) = (line for line in said.splitlines() if line.startswith("  contact force"))
        assert line.removeprefix("  contact force").strip() == shown
        assert re.search("greatest pressure +22.5571 error not known$", said, re.M)
    said = screen(tmp_path / "run", SUMMARY, rows="\n  a row", plot="draw it")
    assert (
        "Results (no error estimate: -estimate 0)" in said and "\n  a row\n" in said and "  plot      draw it" in said
    )


def case_summary(errors, aside=0.0, little=1.0):
    """A summary of two contacts; errors of force, normal force, pressure, length; little: the second one's share."""
    value = {"force": 500.0, "normalForce": 500.0, "pressureMax": 680.0, "contactLength": 0.94}
    own = {"bodies": [{"name": "hook"}], "units": ["mm", "MPa"], "thickness": 1, "state": "strain", "contactPoints": 8}
    own["contacts"] = [
        {
            **value,
            "name": name,
            "normalForce": 500.0 * share,
            "force": [0, 500.0 * share],
            "contactPoints": 4,
            "points": 9,
        }
        for name, share in (("hook bar", 1.0), ("pin bore", little))
    ]
    known = {key: {"value": value[key], "error": error * value[key]} for key, error in zip(value, errors, strict=True)}
    exact = {key: {"value": value[key], "error": 1e-9} for key in value}
    estimates = {"parts": {"inside": 1}, "contacts": [known, exact if little == 1 else known], "refine": "raise -order"}
    change = {"name": "hook bar", "kind": "force", "change": 0.004, "aside": aside}
    linear = {"trusted": True, "changes": [change], "pressureMax": [0, 0]}
    return {**SUMMARY, **own, "estimates": estimates, "notEstimated": "", "linearised": linear}


def test_large_errors_are_no_silence(tmp_path):
    """A printed number that is off by more than 30 % is named in a warning, once; smaller ones are not."""
    small, great = (0.29, 0.29, 0.29, 0.29), (0.01, 0.31, 0.93, 1.5)
    said = screen(tmp_path / "small", case_summary(small))
    assert "  no warnings" in said and "warning: " not in said
    said = screen(tmp_path / "great", case_summary(great))
    found = "normal force of hook bar 31 %, greatest pressure of hook bar 93 %, contact length of hook bar 150 %"
    assert (
        f"warning: estimated error above 30 %: {found}. Do not use these numbers" in said and "no warnings" not in said
    )
    told = {**case_summary(great), "warnings": ["the error of the greatest pressure of hook bar is estimated at 93 %"]}
    assert "warning: estimated error above 30 %: normal force of hook bar 31 %, contact" in screen(
        tmp_path / "told", told
    )
    said = screen(tmp_path / "little", case_summary(great, little=1e-4))
    assert "pin bore 93 %" not in said  # a contact that carries nothing beside the other one decides nothing


def test_no_advice_to_raise_the_highest_order(tmp_path):
    """The row `finer` names a higher order only if there is one, and -distance exact only where it is not in use."""
    errors = (0.001, 0.001, 0.2, 0.001)
    for order, dimension, said_so in ((2, 2, True), (4, 2, False), (2, 3, True), (3, 3, False)):
        space = {"reactionZ": 0} if dimension == 3 else {}
        said = screen(tmp_path / f"{order}{dimension}", {**case_summary(errors), **space, "order": order})
        (line,) = re.findall("^  finer +(.*)$", said, re.M)
        assert line.startswith("raise -order, or refine at the contact" if said_so else "refine at the contact"), line
    for distance, said_so in (("linear", True), ("exact", False)):
        parts = {"linearised": {"trusted": True, "changes": [], "pressureMax": [200, 0]}}
        flags = {"parameters": {**SUMMARY["parameters"], "distance": distance}, "order": 2}
        said = screen(tmp_path / distance, {**case_summary(errors), **parts, **flags})
        assert ("use -distance exact" in said) is said_so, said


def test_no_advice_against_rounding():
    """Where an error is rounding nothing lowers it; at the highest order the mesh alone does."""
    exact, fourth = (
        run(*words, "-estimate", 1) for words in (["confined-block"], ["disc-on-block", "-order", 4, "-h", 2])
    )
    assert exact.estimates["force"]["error"] < 1e-8 * exact.force
    assert (exact.estimates["refine"], exact.estimates["wasted"]) == ("", "")
    assert fourth.estimates["refine"] == "lower -h"


def test_direction_of_a_force(tmp_path):
    """A resultant whose ± is mostly that of its direction says so; one whose size is as uncertain does not."""
    words = "mostly of its direction: -distance exact computes it"
    for error, aside, said_so in ((0.0062, 1.55, True), (0.0062, 0.0, False), (0.05, 1.55, False)):
        said = screen(tmp_path / f"{aside}{error}", case_summary((error, 1e-4, 1e-3, 1e-3), aside))
        (line,) = (
            line for line in said.splitlines() if "resultant force" in line and "±" in line and "e-09" not in line
        )
        assert (words in line) is said_so, line


def test_numbers_without_errors(tmp_path):
    """Beside numbers with ±, one without says that its error is not known: the overlap and the radius of a scene."""
    known = {"force": {"value": 150.0, "error": 0.5}, "parts": {"inside": 1}}
    own = {"contacts": [{"law": "power"}], "overlapMax": 0.0326, "halfWidthMoment": 1.25, "reactionZ": 0}
    said = screen(tmp_path / "1", {**SUMMARY, **own, "estimates": known, "notEstimated": ""})
    assert re.search("^  greatest overlap +0.0326 error not known$", said, re.M), said
    assert re.search("^  contact radius +1.25 error not known, by the second moment of the pressure$", said, re.M), said
    said = screen(tmp_path / "0", {**SUMMARY, **own})
    assert re.search("^  greatest overlap +0.0326$", said, re.M), said


def test_creepage(tmp_path):
    """Rolling prints its creepage, friction its energies and two errors."""
    contact = {
        "name": "", "force": [0.016, -0.086], "contactPoints": 41, "points": 81, "shearForce": [0.0155, 1e-19],
        "stickShare": 0.623, "dissipated": 1.2e-05, "mesh": {"shearForce": {"error": 1e-6}, "dissipatedLastStep": None},
        "loadSteps": {"shearForce": {"error": 2e-5}, "dissipated": {"error": 3e-7}},
    }  # fmt: skip
    rolled = {"friction": 0.3, "work": 3, "stored": 2, "dissipated": 1, "creepage": 0.00217183, "dragged": None}
    said = screen(tmp_path / "run", {**SUMMARY, **rolled, "contacts": [contact], "loadStepsError": "not known: why"})
    assert re.search("^  creepage +0.00217183 of the length rolled$", said, re.M)
    assert "0.015500 ± 1e-06 (mesh) ± 2e-05 (load steps)  on the slave (0.0155, 0)" in said
    assert "work of the loads 3, stored 2, dissipated 1, left over 0" in said
    assert "error of the load steps not known: why" in said


# ---------------------------------------------------------------- meshes


def test_plane_mesh_in_space(tmp_path):
    """A plane geometry, a plane mesh file, and both checked only: parts-3d.edp names the script for them."""
    code, _ = execute(
        ["gmsh", "-2", "-v", 0, "-format", "msh22", f"{PIN}.geo", "-setnumber", "size", 2, "-o", tmp_path / "a.msh"]
    )
    assert code == 0
    for mesh, flags in ((f"{PIN}.geo", []), (tmp_path / "a.msh", []), (f"{PIN}.geo", ["-check", 1])):
        words = ["-mesh", mesh, "-case", f"{PIN}.case", *flags]
        said = run_in(ROOT, "edp/parts-3d.edp", *words, out=tmp_path / "out", expect=10).stdout
        assert re.search("only in the plane, with edp/parts.edp|it has no volumes: use edp/parts.edp", said)
        assert said.count("\n") == 1


def test_gmsh_at_work(tmp_path):
    """After five seconds of gmsh the run says what is meshed, and how many elements are expected; not before."""
    (tmp_path / "bin").mkdir()
    slept = tmp_path / "slept"  # a line a second
    waits = f'until test "$(wc -l < {slept})" -ge "$SECONDS_OF_GMSH"; do command -p sleep 0.02; done'
    for name, text in (("sleep", f"echo >> {slept}; command -p sleep 0.02"), ("gmsh", waits)):
        (tmp_path / "bin" / name).write_text(f"#!/bin/sh\n{text}\n")
        (tmp_path / "bin" / name).chmod(0o755)
    (tmp_path / "a.geo").write_text("")
    for seconds, expected, said in (
        (7, "87000", "gmsh meshes a.geo: about 87000 elements expected ...\n"),
        (7, "", "gmsh meshes a.geo ...\n"),
        (7, "-", ""),
        (0, "87000", ""),
    ):
        slept.write_text("")
        env = {**os.environ, "PATH": f"{tmp_path}/bin:{os.environ['PATH']}", "SECONDS_OF_GMSH": str(seconds)}
        words = [
            "sh",
            ROOT / "edp/input/make-mesh.sh",
            str(os.getpid()),
            tmp_path / "a.msh",
            tmp_path / "a.geo",
            expected,
            "-2",
        ]
        done = subprocess.run(words, env=env, capture_output=True, text=True, timeout=patience(30))
        assert (done.returncode, done.stdout) == (5, said)


@pytest.mark.parametrize("scene, flags", [("sphere-on-block", ["-h", 0.02]), ("disc-on-block", ["-h", 0.0001])])
def test_refused_before_it_is_meshed(scene, flags, tmp_path):
    """What cannot fit into any memory is refused before gmsh begins."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/gmsh").write_text(f"#!/bin/sh\n: > {tmp_path}/begun\n")
    (tmp_path / "bin/gmsh").chmod(0o755)
    env = {**environment(), "PATH": f"{tmp_path}/bin:{os.environ['PATH']}"}
    done = run_in(ROOT, script(scene), *flags, out=tmp_path / "out", expect=10, env=env)
    assert not (tmp_path / "begun").exists()
    assert "unknowns take" in done.stdout and "allowed: up to" in done.stdout and done.stdout.count("\n") == 1


@pytest.mark.parametrize(
    "scene, flags", [("disc-on-block", ["-h", 0.25, "-order", 1]), ("sphere-on-block", ["-h", 1, "-order", 1])]
)
def test_expected_elements(scene, flags, tmp_path):
    """The elements expected of a mesh are those that gmsh makes, to a third."""
    text = (ROOT / script(scene)).read_text()
    line = 'include "solver/solve.idp"'
    assert line in text
    (tmp_path / "own.edp").write_text(
        text.replace(line, 'cout << "told " << gmshExpected << " " << Th.nt << endl; exit(0);\n' + line)
    )
    for name in ("edp", "meshes", "freefem++.pref", "build"):
        (tmp_path / name).symlink_to(ROOT / name)
    code, said = execute([*FREEFEM, "own.edp", *map(str, flags), "-out", tmp_path / "out"], tmp_path, environment())
    expected, made = map(float, re.search(r"^told (\S+) (\S+)", said, re.M).groups())
    assert abs(expected / made - 1) < 1 / 3, (code, expected, made)


# ---------------------------------------------------------------- -help


def test_help_by_topics():
    """Each flag of each scene stands under a topic, or is the scene's own; columns are aligned; units are explained."""
    of_scenes = {
        flag
        for path in (ROOT / "edp/scenes").glob("*.edp")
        for flag in re.findall(r'Flag\("(-[\w-]+)"', path.read_text())
    }
    for name in (
        "main.edp",
        "parts.edp",
        "scenes/sphere-on-block.edp",
        "scenes/adhesive-sphere.edp",
        "scenes/fretting-3d.edp",
    ):
        said = execute([*FREEFEM, ROOT / "edp" / name, "-help", "all"], ROOT)[1]
        head = next(line for line in said.splitlines() if line.startswith("flag "))
        topics = re.findall(r"\n\n([A-Z][\w ]+)\n(?=-)", said)
        assert len(topics) == len(set(topics)) >= 6
        own = re.search(r"\nThis scene\n((?:-.*\n)*)", said)
        assert set(re.findall(r"^-[\w-]+", own[1] if own else "", re.M)) <= of_scenes
        for line in said.splitlines():
            if line.startswith("-") and len(line.split()[1]) < 16:
                assert line[head.index("default")] != " " and line[head.index("default") - 1] == " ", line
                assert line[head.index("meaning")] != " " and line[head.index("meaning") - 1] == " ", line
        assert "Units are yours, consistent: lengths in one unit" in said
    assert told("main.edp")["-kappa"] == told("main.edp", "-method", "newton")["-kappa"] and len(scripts()) > 20


def test_error_of_a_moment_in_space(tmp_path):
    """What bounds the size of a vector stands behind that size, not behind the components."""
    own = thick_body(1, "space") | {"reactionZ": 0}
    row = {"name": "pad disc", "body": "pad", "point": "", "about": [0, 0, 0], "force": [0, 0, 0]}
    own["moments"] = [{**row, "moment": [30, -40, 0], "printed": True, "error": 2}]
    said = screen(tmp_path, own)
    assert re.search(
        r"^    pad disc +\(30, -40, 0\) N mm +on pad, about \(0, 0, 0\), size 50.0 ± 2.0 \(4 %\)$", said, re.M
    ), said


def test_lines_of_many_iterations():
    """Of many iterations the first, each twentieth and the last ones have a line; with -verbose 1 all have."""
    flags = "-h", 2, "-order", 2, "-method", "newton", "-kappa", 1e20
    brief, whole = run("disc-on-block", *flags), run("disc-on-block", *flags, "-verbose", 1)
    count = brief.summary["newton"]
    printed = list(map(int, re.findall(r"^ +(\d+) +\S+ +\d+ +[\d.]+$", brief.stdout, re.M)))
    assert count > 30 and len(whole.history["newton"]) == count
    assert printed == [*range(1, 21), *range(count - 4, count + 1)]
    assert re.findall(r"^ +1 +1 +(\d+) ", whole.stdout, re.M) == list(map(str, range(1, count + 1)))
    longer = run("disc-on-block", *flags, "-tol", 1e-30)
    printed = list(map(int, re.findall(r"^ +(\d+) +\S+ +\d+ +[\d.]+$", longer.stdout, re.M)))
    assert longer.summary["newton"] == 42 and printed == [*range(1, 21), 40, 41, 42]
    stopped = run("disc-on-block", *flags, "-maxNewton", 29, expect=20).stdout
    assert re.search(r"^ +29 +\S+ +\d+ +\S+\nNOT CONVERGED", stopped, re.M)


def test_a_number_of_the_geometry_among_the_flags(tmp_path):
    """A number of -set shall stand in summary.json, among the flags and in the command of a run as it was given."""
    pair = EXAMPLES / "gear-pair/gear-pair"
    words = (
        "-mesh",
        f"{pair}.geo",
        "-case",
        f"{pair}.case",
        "-set",
        "module",
        2,
        "-estimate",
        0,
        "-vtu",
        0,
        "-verbose",
        1,
    )
    done = run_in(ROOT, "edp/parts.edp", *words, out=tmp_path / "run")
    assert done.summary["parameters"]["set module"] == "2" and "set" not in done.summary["parameters"]
    assert "set module" in done.summary["given"] and "set" not in done.summary["given"]
    flags = done.stdout.partition("\nFlags\n")[2]
    assert "  -set module 2 " in flags and flags.count("-set") == flags.count("-mesh") == 1
    assert " -set module 2 -" in command(read_run(done.folder))


def test_all_loads_move(tmp_path):
    """Several loads move, one load moves."""
    told = {**thick_body(1), "ways": [{"name": "all loads", "way": 0.25}, {"name": "force top", "way": 0.5}]}
    said = screen(tmp_path / "run", told)
    assert re.search(r"^  all loads move +0.25 mm$", said, re.M) and re.search(
        r"^  force top moves +0.5 mm$", said, re.M
    )


def test_show_and_compare_a_case(tmp_path, capsys):
    """Tables of a case shall have the numbers of its screen with units, no empty ones, and no lists as in the file."""
    done, folder = example("pin-in-hole", tmp_path, "", "-estimate", 1, size=0.6), str(tmp_path / "run")
    assert main(["show", folder]) == 0
    said = capsys.readouterr().out
    contact, units = done.summary["contacts"][0], done.summary["units"]
    assert re.search(rf"{contact['name']}: normal force +{contact['normalForce']:.8g} ± \S+ N(/mm)?$", said, re.M)
    assert re.search(
        rf"{contact['name']}: greatest pressure +{contact['pressureMax']:.8g} ± \S+ {units[1]}$", said, re.M
    )
    assert re.search(r" carries +\(\S+, \S+\) N(/mm)?$", said, re.M)
    assert not re.search("contactMoment|^ +force +-|masterForce|modules|estimates|name ", said, re.M)
    assert max(map(len, said.splitlines())) < 160
    assert main(["compare", folder, folder]) == 0
    said = capsys.readouterr().out
    assert re.search(rf"^{contact['name']}: normal force \[N(/mm)?\] .* 0$", said, re.M)
    assert not re.search("^(force|approach|halfWidth) ", said, re.M)


def test_digits_without_an_error_of_the_mesh(tmp_path):
    """Load or wear steps alone give three digits at most; with the error of the mesh the greater decides."""
    contact = {
        "name": "", "force": [0.016, -0.086], "contactPoints": 41, "points": 81, "shearForce": [0.0155432, 0],
        "stickShare": 0.62345, "dissipated": 1.23456e-05, "mesh": {"shearForce": {"error": 2e-6}},
        "loadSteps": {"shearForce": {"error": 1e-9}, "dissipated": {"error": 3e-15}, "stickShare": {"error": 1e-9}},
    }  # fmt: skip
    body = {
        "body": "b",
        "strainMax": 9.47194e-05,
        "strainMaxError": 1.6e-10,
        "at": [1, 2],
        "volume": 6.104321,
        "share": 1,
    }
    plastic = {"yielded": True, "steps": 2, "iterations": 9, "bodies": [{**body, "volumeError": 0.75}], "contacts": []}
    plastic |= {key: 1.0 for key in ("storedElastic", "storedByHardening", "work", "dissipated")}
    rubbed = {"friction": 0.3, "work": 3, "stored": 2, "dissipated": 1, "dragged": None, "contacts": [contact]}
    said = screen(tmp_path / "a", {**SUMMARY, **rubbed, "plastic": {**plastic, "loadStepsError": "measured"}})
    assert re.search(r"shear force +0.0155432 ± 2e-06 \(mesh\) ± 1e-09 \(load steps\)", said)
    assert re.search(r"dissipated +1.23e-05 ± 3e-15 \(load steps\)", said)
    assert re.search(r"sticking part +62.3 ± 1e-07 \(load steps\)", said)
    assert re.search(r"greatest of b +9.47e-05 ± 1.6e-10 \(load steps\)", said), said
    assert re.search(r"yielded area +6.10 ± 0.75 \(load steps\)", said)
