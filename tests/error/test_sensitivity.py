"""-sensitivity 1: derivatives of the results, against finite differences of other runs and against the units."""

import csv

import numpy as np
import pytest
from freefem import ROOT, cases_of, flag_lists, refusal, run_in

from postprocess.problem_rows import flatten as numbers_of


def flatten(done):
    """The numbers of a summary by the names of rows.csv."""
    return numbers_of(done.summary)


EXACT = ["-tol", 1e-11, "-eps", 1e-9, "-estimate", 0, "-vtu", 0]
LENGTHS = ("contactLength", "contactArea")
# parameters that grow with all pressures, or fall
UNITS = dict.fromkeys(("kappa", "p0", "E", "E1", "E2", "force", "shear", "shearLimit"), 1) | {"compliance": -1}
OF_PATH = ("drag", "shear")  # of all load steps: no columns of a table of problems
STEP = 1e-4  # relative step of the finite differences

FLAGS = "main.edp -h 1 | main.edp -h 1 -law barrier -geometry axisymmetric -force 300"
MORE = (
    "main.edp -h 0.5 | main.edp -h 1 -law exponential -force 100 | main.edp -h 0.5 -law signorini -force 120"
    "| main.edp -h 1 -law table -table TABLE -geometry stress | main.edp -h 1 -order 4 -offset 1.3 -bodyForce 0.05"
    "| scenes/sphere-on-block.edp -h 2.5 -patch 6 | scenes/wavy.edp | scenes/meshed-disc.edp -h 1 -kappa 1e6"
    "| scenes/two-cylinders.edp -d0 -0.01 -law power -kappa 1e5"
    "| scenes/sphere-on-plane.edp -d0 -0.01 -law exponential | scenes/flat-punch.edp -h 1 -law signorini"
)
# of one or two bodies, the plane and space; the last load steps turn back
FRICTION = [
    "fretting -h 0.8 -force 0 -u0 0.2 -drag 0.08 -law exponential -d0 -0.01 -compliance 1e-3|1 0, 1 0.5, 0.9 0.3",
    "fretting -h 0.2 -order 1 -shearLimit 1.2|1 0, 1 1, 1 -0.8, 0.9 0.2",
    "fretting-bodies -h 0.2 -law power -kappa 1e5 -d0 -0.001 -E2 300|1 0, 1 1",
    "fretting-3d -h 2.5 -u0 0.5 -drag 0.05 -gap 0 -law power -kappa 1e4 -m 2|1, 1 0.5 0.5, 1 -0.3 0.6",
    "wedge -h 0.4|1, 1e-3",
]


def on_path(text):
    """The script and its flags, from "scene FLAGS|LEGS"."""
    flags, legs = text.split("|")
    scene, *flags = flags.split()
    return [f"scenes/{scene}.edp", *flags, "-legs", legs]


def one(script, *flags, out):
    return run_in(ROOT, f"edp/{script}", *flags, *EXACT, "-sensitivity", 1, out=out)


def rows(script, flags, table, folder):
    """The rows of a table of problems, {column: text} each, solved by one run without estimates."""
    path = folder / "table.csv"
    path.write_text("\n".join(",".join(row) for row in table) + "\n")
    run_in(ROOT, f"edp/{script}", *flags, *EXACT, "-rows", path, out=folder / "rows")
    with open(folder / "rows" / "rows.csv") as f:
        return list(csv.DictReader(f))


def number(row, name):
    """A result in a row of rows.csv, or in a summary."""
    if name in LENGTHS:
        name = "contacts.1.contactLength" if name == "contactLength" else "contacts.1.area"
    others = {
        "shearForceX": "contacts.1.shearForce.1",
        "shearForceY": "contacts.1.shearForce.2",
        "dragged": "dragged.value",
    }
    return float(row[others.get(name, name)])


@pytest.mark.parametrize("flags", cases_of(flag_lists(FLAGS), [*flag_lists(MORE), *map(on_path, FRICTION)]), ids=str)
def test_finite_differences(flags, tmp_path):
    """Each derivative shall be that of four other solutions to 1e-5 of the greatest, of two by nu, drag and shear."""
    script, *flags = flags
    if "TABLE" in flags:
        flags[flags.index("TABLE")] = tmp_path / "law.csv"
        (tmp_path / "law.csv").write_text("overlap,pressure\n0,0\n0.02,1\n0.05,6\n0.1,30\n")
    base = one(script, *flags, out=tmp_path / "base")
    found = {name: value for name, value in base.sensitivities.items() if isinstance(value, dict)}
    assert {"pressureMax", "overlapMax", "halfWidthMoment"} < set(found)
    at = {name: base.parameters[name] for name in found["pressureMax"]}
    varied = [name for name in at if name[0] not in "En" and not (name == "d0" and "-d0" in flags)]
    varied = [name for name in varied if at[name] != 0 and name not in OF_PATH]
    table = [varied]
    for name in varied:
        for k in (-2, -1, 1, 2):
            table.append([repr(at[each] * (1 + k * STEP * (each == name))) for each in varied])
    given = [str(flag) for flag in flags]
    for name in varied:
        if f"-{name}" in given:
            del given[given.index(f"-{name}") : given.index(f"-{name}") + 2]
    solved = rows(script, given, table, tmp_path)
    assert [row["code"] for row in solved] == ["0"] * len(solved)
    values = {name: number(flatten(base), name) for name in found}
    scale = {name: max(abs(values[name]), *(abs(value[p] * at[p]) for p in at)) for name, value in found.items()}
    for n, p in enumerate(varied):
        for name, value in found.items():
            if name == "overlapMax" and base.parameters["law"] == "signorini":
                continue  # the overlap is d0 up to rounding
            f = [number(row, name) for row in solved[4 * n : 4 * n + 4]]
            difference = (f[0] - 8 * f[1] + 8 * f[2] - f[3]) / (12 * STEP)
            assert value[p] * at[p] == pytest.approx(difference, abs=1e-5 * scale[name], rel=1e-5), (name, p)
    for name, value in found.items():  # twice all pressures: twice the results that are pressures
        if name == "overlapMax" and base.parameters["law"] in ("signorini", "table"):
            continue
        grown = sum(value[p] * at[p] * UNITS[p] for p in at if p in UNITS)
        degree = name in ("force", "pressureMax", "shearForceX", "shearForceY")
        if base.parameters["law"] != "table" and base.parameters.get("bodyForce", 0) == 0:
            assert grown == pytest.approx(degree * values[name], abs=1e-6 * scale[name]), name
    for p in [next(p for p in at if p.startswith("nu")), *(p for p in OF_PATH if p in at)]:
        rest = [str(flag) for flag in flags]
        if f"-{p}" in rest:
            del rest[rest.index(f"-{p}") : rest.index(f"-{p}") + 2]
        moved = [one(script, *rest, f"-{p}", repr(at[p] * (1 + k * STEP)), out=tmp_path / f"{p}{k}") for k in (-1, 1)]
        for name, value in found.items():
            if name == "overlapMax" and base.parameters["law"] == "signorini":
                continue
            difference = (number(flatten(moved[1]), name) - number(flatten(moved[0]), name)) / (2 * STEP)
            assert value[p] * at[p] == pytest.approx(difference, abs=1e-5 * scale[name], rel=1e-5), (name, p)


def test_touching_point(tmp_path):
    """At the approach at which a point just touches, the run shall give the derivatives of both sides, and warn."""
    flags = ["main.edp", "-h", 1, "-law", "signorini"]
    first, second = (one(*flags, "-u0", u, out=tmp_path / f"{u}") for u in (2.5, 2.5001))
    rate = (second.contact["s"] - first.contact["s"]) / 1e-4
    is_open = (first.contact["status"] == 0) & (rate > 0)
    touch = 2.5 - np.max(first.contact["s"][is_open] / rate[is_open])
    there = one(*flags, "-u0", repr(float(touch)), out=tmp_path / "there")
    sides = [one(*flags, "-u0", repr(float(touch + k)), out=tmp_path / f"{k}") for k in (-1e-3, 1e-3)]
    assert there.warnings == ["a point just touches: 9 sensitivities differ for increasing and decreasing parameters"]
    for name in ("force", "pressureMax", "halfWidthMoment"):
        below, above = (side.sensitivities[name]["u0"] for side in sides)
        if name != "halfWidthMoment":  # it is not linear in u0 between two changes
            assert there.sensitivities[name]["u0"] == pytest.approx({"below": below, "above": above}, rel=1e-6)
        shift = there.sensitivities[name]["d0"]
        assert shift["below"] == pytest.approx(-there.sensitivities[name]["u0"]["above"], rel=1e-6)
    assert isinstance(there.sensitivities["force"]["E"], float)  # it moves no point of a hard contact


def test_half(tmp_path):
    """A half model shall have the derivatives of the whole, on another mesh."""
    half, whole = (one("main.edp", "-h", 1, "-half", k, out=tmp_path / f"{k}").sensitivities for k in (1, 0))
    for name in ("force", "pressureMax", "halfWidthMoment", "contactLength", "halfWidth"):
        size = max(map(abs, whole[name].values()))
        assert half[name] == pytest.approx(whole[name], rel=0.02, abs=0.01 * size), name


def test_jumps(tmp_path):
    """An area that is a sum over points shall have no derivative, but a reason."""
    done = one("scenes/sphere-on-plane.edp", "-h", 0.3, out=tmp_path / "out")
    assert done.sensitivities["contactArea"] is None
    assert done.sensitivities["contactAreaReason"] == "it changes in jumps, from point to point"
    none = one("main.edp", "-h", 1, "-u0", 0.1, out=tmp_path / "none")
    assert none.sensitivities["force"] is None
    assert none.sensitivities["forceReason"] == "the contact carries nothing"


def test_kink_of_friction(tmp_path):
    """A load step that changes nothing leaves points at their friction bound: no single derivative, but the reason."""
    flags = ["scenes/fretting.edp", "-h", 0.8, "-legs", "1 0, 1 1, 1 1"]
    done = one(*flags, out=tmp_path / "out")
    assert done.sensitivities["approach"] is None
    reason = "in load step 3 a point just touches or just slips: there are two derivatives"
    assert done.sensitivities["approachReason"] == done.sensitivities["draggedReason"] == reason


REFUSED = {
    "scenes/rolling.edp": "-sensitivity 1: not with rolling, whose surfaces move through the contact; "
    "allowed: -sensitivity 0",
    "main.edp -distance exact": "-sensitivity 1: not with -distance exact, whose contact points move with the "
    "solution; allowed: -sensitivity 0",
}


@pytest.mark.parametrize("flags", cases_of(list(REFUSED), []))
def test_refused(flags, tmp_path):
    """Problems without these derivatives shall be refused."""
    script, *flags = flags.split()
    assert (
        refusal(
            tmp_path,
            script.split("/")[-1].removesuffix(".edp").replace("main", "disc-on-block"),
            *flags,
            "-sensitivity",
            1,
        ).strip()
        == REFUSED[" ".join([script, *flags])]
    )
