"""Plastic bodies: closed forms, energies, the elastic limit, symmetries, the grid's problems, refusals."""

import re

import numpy as np
import plasticity
import pytest
from freefem import ROOT, cases_of, part, table
from input.test_parts import UNTURNED, Mesh, block, turn, vector
from output.test_paraview import Grid

SCREEN = re.compile(r"^    greatest of block +(\S+)(?: ± (\S+) \(load steps\))?", re.M)


def series(run):
    return table(run.folder / "series.csv")


# ---------------------------------------------------------------- closed forms


def squeezed(strains, E, nu, Y, H):
    """Uniaxial strain: pressure, equivalent plastic strain, dissipated and stored energy per volume at each strain."""
    bulk, shear = E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu))
    flow, hard, lost, rows = 0.0, 0.0, 0.0, []
    for e in strains:
        trial = 2 * shear * e - 3 * shear * flow  # von Mises' stress with its sign
        more = max(0, abs(trial) - Y - H * hard) / (3 * shear + H)
        flow, hard, lost = flow + np.sign(trial) * more, hard + more, lost + Y * more
        mises = 2 * shear * e - 3 * shear * flow
        stored = bulk * e**2 / 2 + mises**2 / (6 * shear) + H * hard**2 / 2
        rows.append((bulk * e + 2 / 3 * mises, hard, lost, stored))
    return np.array(rows).T


@pytest.mark.parametrize("state", ["strain", "axisymmetric"])
def test_uniaxial_strain(tmp_path, state):
    """A block that cannot widen, loaded, unloaded until it yields again and loaded: the closed form at each step."""
    E, nu, Y, H, height = 1000, 0.3, 1, 150, 2
    ends = (0.006, 0.0018, 0.009)  # on the way back it yields again, and stays in contact
    case = f"state {state}\nbody block E {E} nu {nu}\nplastic block {Y} {H}\n"
    case += "clamp bottom\nsymmetry left\nsymmetry right\n".replace("clamp", "symmetry")
    for e in ends:
        case += f"leg 2\nobstacle top plane 0 {height} 0 -1 move 0 {-e * height!r}\n"
    run = part(tmp_path, block(Mesh(), cells=(3, 2)).text(), case, "-vtu", 1)
    rows, first = series(run), (0, *ends)
    strains = [a + (b - a) * k / 2 for a, b in zip(first, ends, strict=False) for k in (1, 2)]
    pressure, hard, lost, stored = squeezed(strains, E, nu, Y, H)
    area = np.pi * 3**2 if state == "axisymmetric" else 3
    assert rows["force"] == pytest.approx(area * pressure, rel=1e-6)
    assert rows["plasticStrain"] == pytest.approx(hard, rel=1e-6)
    assert rows["dissipated"] == pytest.approx(area * height * lost, rel=1e-6)
    assert rows["stored"] == pytest.approx(area * height * stored, rel=1e-6)
    assert rows["plasticVolume"] == pytest.approx(area * height * (hard > 0), rel=1e-9)
    assert run.factorisations <= 2
    entry = run.summary["plastic"]
    assert entry["dissipated"] == rows["dissipated"][-1] and entry["bodies"][0]["share"] == pytest.approx(1)
    assert run.summary["estimates"] is None or "parts" not in run.summary["estimates"]
    assert "±" not in run.stdout.split("Results")[1].split("\n", 1)[1]
    assert float(SCREEN.search(run.stdout)[1]) == pytest.approx(hard[-1], rel=1e-5)
    grid = Grid(run.folder / "solution.vtu")
    assert grid.at_points["plasticStrain"] == pytest.approx(hard[-1], rel=1e-5)
    mises = Y + H * hard[-1]
    assert grid.at_points["vonMises[pressure]"] == pytest.approx(mises, rel=1e-5)
    assert grid.at_points["stressYY[pressure]"] == pytest.approx(-pressure[-1], rel=1e-5)


def hill(c, r, unloaded):
    """Radial and hoop stress of a tube from 1 to 2 that yields to the radius c, over Y; pressure inside."""
    k = 2 / np.sqrt(3)
    p = k * (np.log(c) + (1 - c**2 / 4) / 2)
    radial = np.where(r < c, k * (np.log(r / c) - (1 - c**2 / 4) / 2), k * c**2 / 8 * (1 - 4 / r**2))
    hoop = np.where(r < c, radial + k, k * c**2 / 8 * (1 + 4 / r**2))
    gone = unloaded * p / 3
    return p, radial - gone * (1 - 4 / r**2), hoop - gone * (1 + 4 / r**2)


CASES = [(1.5, True), (1.5, False), (1.98, False), (1.98, True)]


@pytest.mark.parametrize("c, unloaded", cases_of(CASES[:1], CASES))
def test_tube(tmp_path, c, unloaded):
    """A thick tube under pressure, near its collapse, and without it again: Hill's stresses within 1e-3 of Y."""
    case = "state axisymmetric\nbody tube E 1000 nu 0.49\nplastic tube 1 0\nsymmetry bottom\nsymmetry top\n"
    case += f"obstacle right plane 5 0 -1 0\nline a 1 0.01 2 0.01\nleg 4\npressure left {float(hill(c, 1, 0)[0])!r}\n"
    case += "leg 1\npressure left 0\n" * unloaded
    mesh = block(Mesh(), size=(1, 0.02), cells=(60, 1), at=(1, 0), name="tube")
    run = part(tmp_path, mesh.text(), case)
    found = table(run.folder / "line-a.csv")
    _, radial, hoop = hill(c, found["x"], unloaded)
    away = abs(found["x"] - c) > 0.03  # the elements at the elastic-plastic border
    assert abs(found["stressXX"] - radial)[away].max() < 1e-3
    assert abs(found["stressZZ"] - hoop)[away].max() < 1e-3
    volume = np.pi * (c**2 - 1) * 0.02
    assert run.summary["plastic"]["bodies"][0]["volume"] == pytest.approx(volume, rel=0.03)
    assert run.factorisations <= 2


@pytest.mark.parametrize("sphere, exact, within", [(True, 1.60, 0.02), (False, 1.79, 0.03)])
def test_first_yield(sphere, exact, within):
    """The greatest pressure at first yield: 1.60 Y below a sphere, 1.79 Y below a cylinder, by von Mises."""
    before, after = plasticity.first_yield(sphere, h=0.06, steps=12)
    assert before < after < 1.06 * before
    assert before < exact * (1 + within) and after > exact * (1 - within)


def test_hardness():
    """A sphere deep in an ideally plastic block: a mean pressure of 2.8 to 3 Y."""
    row = plasticity.hardness(0.06, 8, 300)
    assert row["code"] == 0 and row["strain"] > 60 and 2.8 < row["meanPressure"] < 3


GUIDED = """state {}
body block E 1000 nu 0.3
plastic block 10 100
clamp left
obstacle bottom plane 0 -5 0 1
leg 8
{}
"""


@pytest.mark.parametrize("load", ["moment right 9 about 3 1", "moment right 9 rigid", "force right 0 3 rigid"])
def test_guided_loads(tmp_path, load):
    """A beam that yields: the clamp carries the load on a rigid group, the guide nothing that it could follow."""
    run = part(tmp_path, block(Mesh(), cells=(6, 4)).text(), GUIDED.format("strain", load) + "about O 0 0\n")
    assert run.summary["plastic"]["bodies"][0]["share"] > 0.01
    told = {one["name"]: one for one in run.summary["supports"]}
    word, _, *numbers = load.split()
    if word == "force":
        assert told["clamp left"]["force"] == pytest.approx([-float(n) for n in numbers[:2]], abs=1e-6)
    if "rigid" in load:
        assert all(np.abs(guide["force"]).max() < 1e-5 for guide in run.summary["guides"])


def test_unloading(tmp_path):
    """The first unloading is elastic, with the stiffness 2 E* a of a flat punch, a as far as the mesh tells it."""
    folder = ROOT / "edp/examples/brinell"
    case = (folder / "brinell.case").read_text().replace("leg      10", "leg 5").split("leg      2")[0]
    run = part(tmp_path, folder / "brinell.geo", case, "-estimate", 0)
    rows = series(run)
    stiffness = (rows["force"][-2] - rows["force"][-1]) / 0.0002
    points = rows["contactPoints"][-2] * 0.025  # the first point is not on the axis
    assert points < stiffness / (2 * 210e3 / 0.91) < points + 0.025
    assert rows["plasticStrain"][-1] == pytest.approx(rows["plasticStrain"][-2], rel=1e-3)


def test_cycle_by_motion(tmp_path):
    """A bar that a motion alone strains to and fro: the first residual of a step does not see prescribed motions."""
    (tmp_path / "bar.geo").write_text(
        'SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 2, 2}; Mesh.MeshSizeMax = 0.5;\n'
        'Physical Surface("b") = {1}; Physical Curve("bottom") = {1}; Physical Curve("right") = {2};\n'
        'Physical Curve("top") = {3}; Physical Curve("left") = {4};\n'
    )
    ways = (-0.02, 0.01, -0.02)
    case = "state axisymmetric\nbody b E 210e3 nu 0.3\nplastic b 300 2500\nobstacle right plane 2.5 0 -1 0\n"
    case += "clamp bottom y\nsymmetry left\n" + "".join(f"leg 4\nmove top * {way}\n" for way in ways)
    run = part(tmp_path, tmp_path / "bar.geo", case, "-estimate", 0)
    plastic, hardened, stress = 0.0, 300.0, 0.0
    for way in ways:  # uniaxial stress with isotropic hardening
        trial = 210e3 * (way / 2 - plastic)
        flow = max(0.0, abs(trial) - hardened) / (210e3 + 2500) * np.sign(trial)
        plastic, hardened = plastic + flow, hardened + 2500 * abs(flow)
        stress = 210e3 * (way / 2 - plastic)
    force = {support["name"]: support["force"][1] for support in run.summary["supports"]}
    assert force["move top y"] == pytest.approx(stress * 4 * np.pi, rel=1e-5)


# ---------------------------------------------------------------- limits, energies, errors


def pressed(legs, sphere=True, hardening=0.01, depth=5.0, plastic=None):
    return plasticity.Indentation(sphere, hardening, depth).case(legs, plastic)


SMALL = plasticity.geometry(h=0.15, size=8)


def test_without_yielding(tmp_path):
    """With a yield stress beyond all stresses the run shall be the elastic one, digit by digit, its errors included."""
    elastic = part(tmp_path / "e", SMALL, pressed([(0, 1)], plastic="stresses\n"), "-tol", 1e-9)
    run = part(tmp_path / "p", SMALL, pressed([(1, 1)], plastic="plastic block 1e30 0\n"))
    assert (run.folder / "contact.csv").read_bytes() == (elastic.folder / "contact.csv").read_bytes()
    for found in (run, elastic):
        found.summary["estimates"].pop("seconds")
    same = "newton backsolves factorisations contacts estimates energy reactionY pressureMax prescribed bodies supports"
    for key in [*same.split(), "stresses"]:
        assert run.summary[key] == elastic.summary[key], key
    assert run.summary["plastic"]["yielded"] is False and "no body yields" in run.stdout


DISC = """SetFactory("OpenCASCADE"); Point(1) = {0, 0, 0, 0.4}; Point(2) = {0, -1, 0, 0.12}; Point(3) = {1, 0, 0, 0.4};
Circle(1) = {2, 1, 3}; Line(2) = {3, 1}; Line(3) = {1, 2}; Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
Physical Curve("round") = {1}; Physical Curve("middle") = {2}; Physical Curve("axis") = {3};
Physical Surface("block") = {1};
"""


def flattened(folder, state, steps, *flags):
    """A half disc or half sphere, with curved elements, pressed on a plane."""
    case = f"state {state}\nbody block E 100 nu 0.3\nplastic block 0.3 1\nsymmetry axis\n"
    case += f"obstacle round plane 0 -1 0 1\nleg {steps}\nmove middle 0 -0.02\n"
    return part(folder, DISC, case, "-estimate", 0, *flags)


@pytest.mark.parametrize("state", cases_of(["strain"], ["strain", "axisymmetric"]))
def test_energies(tmp_path, state):
    """Work is what is stored and dissipated, to the steps' error, also with curved elements."""
    off = []
    for steps in (3, 12):
        entry = flattened(tmp_path / str(steps), state, steps).summary["plastic"]
        assert entry["dissipated"] > 0.1 * entry["work"]
        left = entry["work"] - entry["storedElastic"] - entry["storedByHardening"] - entry["dissipated"]
        off.append(abs(left) / entry["work"])
    assert off[0] < 0.15 and off[1] < 0.2 * off[0]


def test_errors_of_the_steps(tmp_path):
    """The errors that fewer steps tell shall cover a path with many more steps, and cost no second factorisation."""
    fine = flattened(tmp_path / "fine", "axisymmetric", 48).summary
    for steps in (8, 16):
        run = flattened(tmp_path / str(steps), "axisymmetric", steps, "-stepErrors", 1)
        entry = run.summary["plastic"]
        assert entry["loadStepsError"] == "measured" and entry["meshError"] is None and run.factorisations == 1
        body, exact = entry["bodies"][0], fine["plastic"]["bodies"][0]
        pairs = [(body["strainMax"], exact["strainMax"], body["strainMaxError"])]
        pairs += [(body["volume"], exact["volume"], body["volumeError"])]
        pairs += [(entry["dissipated"], fine["plastic"]["dissipated"], entry["dissipatedError"])]
        force = "normalForce"
        pairs += [(*(s["contacts"][0][force] for s in (run.summary, fine)), entry["contacts"][0]["normalForceError"])]
        for value, wanted, error in pairs:
            assert abs(value - wanted) <= error < 0.5 * value
        assert float(SCREEN.search(run.stdout)[2]) == pytest.approx(body["strainMaxError"], rel=0.1)
    odd = flattened(tmp_path / "odd", "axisymmetric", 4, "-stepErrors", 1).summary["plastic"]
    assert odd["dissipatedError"] is None and "multiple of four" in odd["loadStepsError"]


def test_turned_and_rescaled(tmp_path):
    """The same problem turned by a right angle, and in other units: the same strains."""
    case = "body block E {E} nu 0.3\nplastic block {Y} {H}\nclamp bottom\nleg 2\n"
    case += "obstacle top circle {at} R {R} move {by}\nleg 1\nobstacle top move {back}\n"
    found = []
    for angle, length, stress in ((0, 1, 1), (np.pi / 2, 1, 1), (0, 1e-3, 1e6)):
        matrix = np.round(turn(angle)) * length
        at, by, back = (vector(matrix @ np.array(v), UNTURNED) for v in ([0.1, 6, 0], [0, -0.1, 0], [0, -0.02, 0]))
        text = case.format(E=100 * stress, Y=0.5 * stress, H=stress, at=at, by=by, back=back, R=4 * length)
        mesh = block(Mesh(), size=(3, 2), cells=(10, 6), at=(-1.5, 0)).text(matrix)
        run = part(tmp_path / str(len(found)), mesh, text)
        entry = run.summary["plastic"]["bodies"][0]
        force = run.summary["contacts"][0]["normalForce"] / length / stress
        found.append([entry["strainMax"], entry["volume"] / length**2, force])
    assert found[1] == pytest.approx(found[0], rel=1e-5) and found[2] == pytest.approx(found[0], rel=1e-5)
    assert found[0][0] > 1e-3


def test_press_fit(tmp_path):
    """Rings that only contact holds, one of which yields: as about an axis, where two rectangles stand for them."""
    bodies = "body inner E 210e3 nu 0.3\nbody outer E 210e3 nu 0.3\nplastic outer 12 1000\n"
    folder = ROOT / "edp/examples/press-fit"
    flags = "-estimate", 0, "-set", "edges", 96
    free = part(tmp_path / "free", folder / "press-fit.geo", f"{bodies}contact hub shaft\nleg 1\n", *flags)
    mesh = block(Mesh(), size=(10.002, 0.5), cells=(16, 1), at=(10, 0), prefix="in", name="inner")
    mesh = block(mesh, size=(10, 0.5), cells=(24, 1), at=(20, 0), prefix="out", name="outer")
    sides = "".join(f"symmetry {body}{side}\n" for body in ("in", "out") for side in ("bottom", "top"))
    case = f"state axisymmetric\n{bodies}contact outleft inright\n{sides}leg 1\n"
    ring = part(tmp_path / "ring", mesh.text(), case, "-estimate", 0)
    pressures = [run.contact["pressure"] @ run.contact["weight"] / run.contact["weight"].sum() for run in (free, ring)]
    strains = [run.summary["plastic"]["bodies"][0]["strainMax"] for run in (free, ring)]
    shares = [run.summary["plastic"]["bodies"][0]["share"] for run in (free, ring)]
    assert pressures[0] == pytest.approx(pressures[1], rel=2e-3) and pressures[0] < 5.3
    assert strains[0] == pytest.approx(strains[1], rel=0.05) and strains[0] > 1e-5
    assert shares[0] == pytest.approx(shares[1], abs=0.05)


# ---------------------------------------------------------------- the iteration


def test_heavily_loaded(tmp_path):
    """Far beyond first yield, hardly hardening, in one step: one factorisation, few back-substitutions."""
    run = part(tmp_path, SMALL, pressed([(1, 1)], hardening=1e-4, depth=80), "-estimate", 0)
    entry = run.summary["plastic"]
    assert run.factorisations == 1 and entry["iterations"] > 20 and run.summary["residual"] < 1e-9
    assert run.backsolves < 2.5 * entry["iterations"] + 2 * run.points


def test_grid():
    """A problem of the campaign: the force over that at first yield, as another program has it on another mesh."""
    row = plasticity.grid_row(True, 0.01, 20, 10)
    assert row["code"] == 0 and row["factorisations"] == 1
    assert row["force"] == pytest.approx(64.18, rel=0.005)


def test_few_plastic_points(tmp_path):
    """A step in which few points are plastic has few independent changes: still found soon."""
    case = "state strain\nbody block E 100 nu 0.3\nplastic block 0.3 1\nsymmetry axis\n"
    case += f"obstacle round plane 0 -1 0 1\nleg 3\nmove middle 0 {-0.06 / 64}\n"
    run = part(tmp_path, DISC, case, "-estimate", 0)
    assert run.summary["plastic"]["bodies"][0]["strainMax"] > 1e-3 and run.summary["plastic"]["mostIterations"] < 30


def test_not_found(tmp_path):
    """A step that is not found ends the run with code 20, and names what to change."""
    flags = "-estimate", 0, "-maxPlastic", 3
    run = part(tmp_path, SMALL, pressed([(1, 1)]), *flags, expect=20)
    assert run.summary["converged"] is False
    assert re.search(r"load step 1: the plastic strains .*\(leg STEPS\), or raise -maxPlastic", run.summary["message"])


# ---------------------------------------------------------------- refusals

BODY = "body block E 100 nu 0.3\nplastic block 1 0\nclamp bottom\nobstacle top plane 0 2.1 0 -1 move 0 -0.2{}\n"
REFUSED = {
    ("state stress\n" + BODY.format("\nexpand block 1e-5 10"),): "plastic: not with expand in plane stress; allowed",
    (BODY.format(""), "-order", 1): "plastic: not with -order 1; allowed: 2",
    (BODY.format(""), "-accuracy", 0.1): "plastic: not with -accuracy 0.1; allowed: -accuracy 0, for the errors",
    (BODY.format("").replace("1 0\nclamp", "1 table 0.1 0.9\nclamp"),): "the table starts with 0.9, below the yield",
    (BODY.format(""), "-method", "newton"): "plastic: not with -method newton; allowed: xnewton",
    (BODY.format(""), "-distance", "exact"): "plastic: not with -distance exact; allowed: linear",
    (BODY.format(""), "-history", 1): "plastic: not with -history 1; allowed: a line leg STEPS",
    (BODY.format("\nrotate left 0 0 0.1"),): "plastic: not with rotate",
    (BODY.format(" wear 1e-6 slide 1\ncycles 10"),): "plastic: not with conduct or wear",
    (BODY.format("").replace("1 0\nclamp", "1 table 0.1 2 0.05 3\nclamp"),): "0.05: the plastic strain is out of range",
    (BODY.format(" interference 0.1"),): "plastic: not with interference, which would act as a whole",
    (BODY.format("").replace("nu 0.3", "nu 0.3 yield 2"),): "plastic: not with yield of the same body",
    (BODY.format("").replace("1 0\nclamp", "0 0\nclamp"),): "0: the yield stress is out of range; allowed: above 0",
    (
        BODY.format("").replace("1 0\nclamp", "1 -2\nclamp"),
    ): "-2: the hardening modulus is out of range; allowed: at least 0",
    (BODY.format("\nplastic block 2 0"),): "plastic block: stated before",
    (BODY.format("").replace("plastic block", "plastic top"),): "top: a curve of the mesh",
}


@pytest.mark.parametrize("number", cases_of([0, 1, 2], range(len(REFUSED))))
def test_refused(tmp_path, number):
    """What does not go with plasticity is refused in one line by its name, and nothing is written."""
    given = [*REFUSED][number]
    run = part(tmp_path, block(Mesh(), cells=(4, 3)).text(), given[0], *given[1:], expect=10)
    lines = run.stdout.splitlines()
    assert REFUSED[given] in lines[0] and "allowed" in lines[0]
    assert not (tmp_path / "out").exists()
