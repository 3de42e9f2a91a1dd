"""Heat through contacts: bars in series, a shrink fit that opens, thermal stresses, balance, refusals."""

import json
import re
from math import cos, pi, sin

import numpy as np
import pytest
from freefem import ROOT, cases_of, data, part, table
from reader import Group, Refusal, Where, read_case

from postprocess import closed_forms as forms
from postprocess import vtu

BARS, TUBE, BOX, RING = (data(f"heat/{name}.geo") for name in ("bars", "tube", "box", "ring"))
SIDES = "symmetry left\nsymmetry right\nsymmetry beside\n"
HELD = f"clamp bottom\n{SIDES}temperature bottom 0\n"
CONTACT = "contact face foot conductance 0.5 hardness 5"
SOFT = "body lower E 100 nu 0.3\nbody upper E 100 nu 0.3\nconduct lower 1\nconduct upper 2\n"
UNLIKE = "body lower E 100 nu 0.3\nbody upper E 200 nu 0.2\n"
WARM = UNLIKE + "conduct lower 1 expand 1e-2 from 0.3\nconduct upper 2 expand 2e-2\n"
FIT = "body shaft E 210e3 nu 0.3\nbody ring E 70e3 nu 0.33\n"
CONDUCTS = "conduct shaft 0.05 expand 12e-6 from 20\nconduct ring 0.2 expand 23e-6 from 140\n"
RADII = 10, 25, 45


def solve(folder, mesh, case, *flags, space=False, expect=0):
    """summary.json of a run."""
    done = part(folder, mesh, case, *flags, space=space, expect=expect)
    if expect == 10:
        return done.stdout
    return json.loads((folder / "out/summary.json").read_text())


def through(pressure, h0=0.5, hardness=5.0, exponent=0.95):
    return h0 * (pressure / hardness) ** exponent


def flux(pressure, top=1.0, **law):
    """Bars of lengths 20 and 10, conductivities 1 and 2, in series with their contact."""
    return top / (20 + 5 + 1 / through(pressure, **law))


def balanced(heat):
    """What goes in goes out, through the contact as well."""
    assert heat["in"] == pytest.approx(heat["out"], rel=1e-10)
    given = [group["heat"] for group in heat["groups"]]
    assert sum(given) == pytest.approx(0, abs=1e-10 * heat["in"])


def confined(young, poisson):
    """Modulus of a bar that is held across, and how much more heat lengthens it."""
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)), (1 + poisson) / (1 - poisson)


def in_turn(push, force=None):
    """Pressure, flux and the displacement of the top of the WARM bars, whose top is moved down by push or pressed."""
    (first, more), (second, even) = confined(100, 0.3), confined(200, 0.2)
    soft = 20 / first + 10 / second

    def grows(flow):
        return more * 1e-2 * 20 * (10 * flow - 0.3) + even * 2e-2 * 10 * (1 - 2.5 * flow)

    if force:
        return force, flux(force), grows(flux(force)) - force * soft
    low, high = 0, 100
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if push + grows(flux(middle)) > middle * soft else (low, middle)
    return low, flux(low), -push


def test_bars_in_series(tmp_path):
    """Non-matching meshes shall carry the flux of bars in series; each point has its jump."""
    found = solve(tmp_path, BARS, f"{SOFT}{CONTACT}\n{HELD}move top 0 -1\ntemperature top 1\n", "-set", "n", 4)
    pressure = confined(100, 0.3)[0] / 30
    assert found["heat"]["in"] == pytest.approx(20 * flux(pressure), rel=1e-6)
    assert found["heat"]["contacts"][0]["heat"] == pytest.approx(-20 * flux(pressure), rel=1e-6)
    assert found["heat"]["contacts"][0]["conductance"] == pytest.approx(through(pressure), rel=1e-6)
    points = table(tmp_path / "out/contact.csv")
    assert points["temperatureJump"] == pytest.approx(-flux(pressure) / through(pressure), rel=1e-6)
    assert points["heatFlux"] @ points["weight"] == pytest.approx(-20 * flux(pressure), rel=1e-6)
    assert found["estimates"]["contacts"][0]["normalForce"]["error"] > 0 and found["heat"]["rounds"] == 0
    bodies = {body["name"]: (body["least"], body["greatest"]) for body in found["heat"]["bodies"]}
    assert bodies["lower"] == pytest.approx((0, 20 * flux(pressure)), abs=1e-6)
    assert bodies["upper"] == pytest.approx((1 - 5 * flux(pressure), 1), abs=1e-6)
    groups = {group["name"]: group["heat"] for group in found["heat"]["groups"]}
    assert groups["temperature top"] == pytest.approx(20 * flux(pressure), rel=1e-6)
    balanced(found["heat"])


def test_bars_that_expand(tmp_path):
    """Heat shall press the bars together, and the pressure let heat through, until both agree."""
    case = f"{WARM}{CONTACT}\n{HELD}move top 0 -0.1\ntemperature top 1\n"
    found = solve(tmp_path, BARS, case, "-tol", 1e-9, "-set", "n", 4)
    pressure, flow, _ = in_turn(0.1)
    assert found["contacts"][0]["normalForce"] == pytest.approx(20 * pressure, rel=1e-8)
    assert found["heat"]["in"] == pytest.approx(20 * flow, rel=1e-8)
    assert 3 < found["heat"]["rounds"] < 15
    assert "thermal strain" in found["notEstimated"] and found["estimates"] is None
    balanced(found["heat"])


@pytest.mark.parametrize("above", ["film top 2 1", "temperature top 1\ntemperature beside 1"])
def test_open_gap(tmp_path, above):
    """Where nothing touches nothing shall be conducted: each bar has its own temperature."""
    case = f"{SOFT}contact face foot conductance 0.5\n{HELD}move top 0 0.1\n{above}\n"
    summary = solve(tmp_path, BARS, case, "-set", "n", 3)
    heat = summary["heat"]
    assert not any("rounding" in text for text in summary["warnings"])
    assert heat["contacts"] == [{"name": "face foot", "heat": 0, "conductance": 0, "jump": None}]
    assert [(body["least"], body["greatest"]) for body in heat["bodies"]] == [(0, 0), pytest.approx((1, 1), abs=1e-12)]
    assert heat["in"] == heat["out"] == 0


def strained(young, poisson, expansion, free, conductivity):
    """A body of plane strain as one of plane stress."""
    return young / (1 - poisson**2), poisson / (1 - poisson), expansion * (1 + poisson), free, conductivity


def exact_fit(outside, law=(0.01, 0.95, 100)):
    shaft, ring = strained(210e3, 0.3, 12e-6, 20, 0.05), strained(70e3, 0.33, 23e-6, 140, 0.2)
    return forms.heated_fit(RADII, shaft, ring, (20, outside), law)


def sleeve(outside, contact="conductance 0.01 hardness 100"):
    held = f"symmetry floor\nsymmetry roof\ntemperature bore 20\ntemperature outside {outside}\n"
    return f"state axisymmetric\n{FIT}{CONDUCTS}contact seat journal {contact}\n{held}"


def test_shrink_fit_opens(tmp_path):
    """A ring that is heated outside presses less, and at last lets go: then no heat goes through."""
    warm = solve(tmp_path / "warm", TUBE, sleeve(60), "-set", "edges", 4)
    pressure, heat, _ = exact_fit(60)
    assert warm["contacts"][0]["normalForce"] == pytest.approx(pressure * 2 * pi * 25 * 12, rel=1e-5)
    assert warm["heat"]["contacts"][0]["heat"] == pytest.approx(12 * heat, rel=1e-5)
    balanced(warm["heat"])
    hot = solve(tmp_path / "hot", TUBE, sleeve(145), "-set", "edges", 4)
    pressure, heat, gap = exact_fit(145)
    assert pressure == heat == 0 and gap > 0
    assert hot["contacts"][0]["normalForce"] == 0
    assert hot["heat"]["contacts"] == [{"name": "seat journal", "heat": 0, "conductance": 0, "jump": None}]
    assert hot["heat"]["in"] == hot["heat"]["out"] == 0
    ends = [(body["least"], body["greatest"]) for body in hot["heat"]["bodies"]]
    assert ends == [pytest.approx((20, 20)), pytest.approx((145, 145))]
    left = next(text for text in hot["warnings"] if "nothing presses" in text)
    assert float(left.split("gap left is ")[1].split(":")[0]) == pytest.approx(gap, rel=1e-4)


def test_heat_is_refused(tmp_path):
    """What does not go with heat is refused by name."""
    case = f"{SOFT}{CONTACT}\n{HELD}move top 0 -1\ntemperature top 1\n"
    said = solve(tmp_path, BARS, case, "-points", "nodal", expect=10)
    assert said.startswith("-points nodal: no flux goes")


@pytest.mark.parametrize("order", [1, 3, 4])
def test_orders(order, tmp_path):
    """Each element shall be as exact as its degree allows."""
    found = solve(tmp_path, TUBE, sleeve(60), "-order", order, "-tol", 1e-9)
    pressure, heat, _ = exact_fit(60)
    within = {1: 2e-3, 3: 1e-6, 4: 1e-7}[order]
    assert found["contacts"][0]["normalForce"] == pytest.approx(pressure * 2 * pi * 25 * 12, rel=within)
    assert found["heat"]["in"] == pytest.approx(12 * heat, rel=within)


@pytest.mark.parametrize("outside", [100, 130])
def test_heated_fit(outside, tmp_path):
    """The example on a coarser mesh, whose elements follow the circles."""
    folder = ROOT / "edp/examples/heated-fit"
    text = (folder / "heated-fit.case").read_text().replace("outside 100", f"outside {outside}")
    found = solve(tmp_path, folder / "heated-fit.geo", text, "-set", "edges", 12)
    shaft, ring = (210e3, 0.3, 12e-6, 20, 0.045), (70e3, 0.33, 23e-6, 140, 0.2)
    pressure, heat, _ = forms.heated_fit(RADII, shaft, ring, (20, outside), (0.2, 0.95, 1000))
    assert found["contacts"][0]["normalForce"] == pytest.approx(pressure * 25 * pi / 2, rel=1e-4)
    assert found["heat"]["in"] == pytest.approx(heat / 4, rel=1e-4)
    balanced(found["heat"])


def test_turned_mirrored_rescaled(tmp_path):
    """The same bars turned, mirrored and in other units shall be the same."""
    case = f"{WARM}{CONTACT}\n{HELD}temperature top 1\n"
    plain = solve(tmp_path / "a", BARS, f"{case}move top 0 -0.1\n", "-tol", 1e-9, "-set", "n", 4)
    angle = pi / 6
    moved = f"{case}move top {0.1 * sin(angle)!r} {-0.1 * cos(angle)!r}\n"
    given = "-tol", 1e-9, "-set", "n", 4, "-set", "angle", angle
    turned = solve(tmp_path / "b", BARS, moved, *given)
    mirrored = solve(tmp_path / "c", BARS, moved, *given, "-set", "mirror", -1)
    soft = case.replace("E 100", "E 1e8").replace("E 200", "E 2e8").replace("hardness 5", "hardness 5e6")
    stiff = solve(tmp_path / "d", BARS, f"{soft}move top 0 -0.1\n", "-tol", 1e-9, "-set", "n", 4)
    for other, pressure, close in ((turned, 1, 1e-9), (mirrored, 1, 1e-7), (stiff, 1e6, 1e-9)):
        assert other["heat"]["rounds"] == plain["heat"]["rounds"]
        assert other["heat"]["in"] == pytest.approx(plain["heat"]["in"], rel=close)
        force = pressure * plain["contacts"][0]["normalForce"]
        assert other["contacts"][0]["normalForce"] == pytest.approx(force, rel=close)


@pytest.mark.parametrize("case", ["conducts", "expands"])
def test_in_space(case, tmp_path):
    """The bars as boxes of tetrahedra."""
    sides = "".join(f"symmetry {side}\n" for side in ("left", "right", "front", "back"))
    push, bodies = (1, SOFT) if case == "conducts" else (0.1, WARM)
    held = f"clamp bottom\n{sides}temperature bottom 0\nmove top 0 0 {-push}\ntemperature top 1\n"
    found = solve(tmp_path, BOX, f"{bodies}{CONTACT}\n{held}", "-tol", 1e-9, space=True)
    pressure, flow = (confined(100, 0.3)[0] / 30, 0) if case == "conducts" else in_turn(push)[:2]
    assert found["heat"]["in"] == pytest.approx(400 * (flow or flux(pressure)), rel=1e-6)
    assert found["contacts"][0]["normalForce"] == pytest.approx(400 * pressure, rel=1e-6)
    balanced(found["heat"])


def test_curved_in_space(tmp_path):
    """A ring on a shaft, whose elements follow the cylinders: pressed and heated, then with a flux and a film."""
    faces = "symmetry floor\nsymmetry side\nsymmetry below\nsymmetry above\n"
    held = f"{faces}temperature bore 20\ntemperature outside 60\n"
    case = f"{FIT}{CONDUCTS}contact seat journal conductance 0.01 hardness 100\n{held}"
    found = solve(tmp_path / "fit", RING, case, "-set", "h", 7, space=True)
    pressure, heat, _ = exact_fit(60)
    assert found["contacts"][0]["normalForce"] == pytest.approx(pressure * pi / 2 * 25 * 6, rel=1e-4)
    assert found["heat"]["in"] == pytest.approx(heat / 4 * 6, rel=1e-4)
    balanced(found["heat"])
    given = "conduct shaft 0.05\nconduct ring 0.2\nflux bore 0.3\nfilm outside 2e-3 20\n"
    case = f"{FIT}{given}contact seat journal interference 0.01 conductance 0.01\n{faces}"
    heat = solve(tmp_path / "flux", RING, case, "-estimate", 0, "-set", "h", 7, space=True)["heat"]
    assert heat["in"] == pytest.approx(0.3 * pi / 2 * 10 * 6, rel=1e-4)
    ring = {body["name"]: body for body in heat["bodies"]}["ring"]
    assert ring["least"] == pytest.approx(20 + 3 / (2e-3 * 45), rel=1e-3)
    balanced(heat)


def test_prescribed_force(tmp_path):
    """Under a force the pressure is known, and heat moves the group."""
    case = f"{WARM}{CONTACT}\n{HELD}force top 0 -50\ntemperature top 1\n"
    found = solve(tmp_path, BARS, case, "-tol", 1e-9, "-vtu", 1)
    _, flow, moved = in_turn(0, force=2.5)
    assert found["heat"]["in"] == pytest.approx(20 * flow, rel=1e-8)
    fields = vtu.read_arrays(tmp_path / "out/solution.vtu")
    top = fields["Points", None].reshape(-1, 3)[:, 1] > 30 - 1e-6
    assert fields["PointData", vtu.MOVE].reshape(-1, 3)[top, 1] == pytest.approx(moved, rel=1e-6)
    warm = fields["PointData", "temperature[temperature]"]
    assert warm[top] == pytest.approx(1) and (warm.min(), warm.max()) == (0, 1)


@pytest.mark.parametrize("state", cases_of(["axisymmetric"], ["strain"]))
def test_fluxes_and_films(state, tmp_path):
    """Heat given at the bore leaves through a film outside, over curved edges too."""
    ring = state == "axisymmetric"
    mesh = TUBE if ring else ROOT / "edp/examples/heated-fit/heated-fit.geo"
    size = 2 * pi * 12 if ring else pi / 2  # of what a radius is multiplied by
    held = "symmetry floor\nsymmetry roof\n" if ring else "symmetry floor\nsymmetry side\n"
    bodies = FIT + "conduct shaft 0.05\nconduct ring 0.2\n"
    contact = "contact seat journal interference 0.01 conductance 0.01\n"
    case = f"state {state}\n{bodies}{contact}{held}flux bore 0.3\nfilm outside 2e-3 20\n"
    found = solve(tmp_path, mesh, case, "-estimate", 0)["heat"]
    heat = 0.3 * 10
    ends = [(body["least"], body["greatest"]) for body in found["bodies"]]
    outside = 20 + heat / (2e-3 * 45)
    seat = outside + heat * np.log(45 / 25) / 0.2
    journal = seat + heat / (0.01 * 25)
    assert found["in"] == pytest.approx(size * heat, rel=1e-6)
    assert ends[1] == pytest.approx((outside, seat), rel=1e-4)
    assert ends[0] == pytest.approx((journal, journal + heat * np.log(25 / 10) / 0.05), rel=1e-4)
    assert found["contacts"][0]["conductance"] == pytest.approx(0.01, rel=1e-9)
    balanced(found)


def test_uniform_temperature(tmp_path):
    """At one temperature everywhere the fit shall be that of `expand`, in forces and stresses."""
    held = "symmetry floor\nsymmetry side\n"
    heated = f"contact seat journal conductance 1\n{CONDUCTS}temperature outside 50\n"
    mesh = ROOT / "edp/examples/heated-fit/heated-fit.geo"
    for state in ("stress", "strain"):
        case = f"state {state}\n{FIT}{held}"
        flags = "-estimate", 0, "-set", "edges", 8, "-tol", 1e-10
        one = solve(tmp_path / f"{state}-a", mesh, case + heated, *flags)
        cooled = "contact seat journal\nexpand shaft 12e-6 30\nexpand ring 23e-6 -90\nstresses\n"
        other = solve(tmp_path / f"{state}-b", mesh, case + cooled, *flags)
        assert one["contacts"][0]["normalForce"] == pytest.approx(other["contacts"][0]["normalForce"], rel=1e-8)
        for each, of_expand in zip(one["stresses"], other["stresses"], strict=True):
            assert each["vonMises"] == pytest.approx(of_expand["vonMises"], rel=1e-7)


def test_uniform_temperature_under_a_force(tmp_path):
    """The same of a bar with a force on its side, which heat moves against the bar's own stiffness."""
    held = "clamp bottom\nsymmetry left\nforce beside -30 0\n"
    heated = f"{CONTACT}\nconduct lower 1 expand 1e-3\nconduct upper 1 expand 1e-3\ntemperature top 10\n"
    cooled = "contact face foot\nexpand lower 1e-3 10\nexpand upper 1e-3 10\nstresses\n"
    flags = "-estimate", 0, "-set", "n", 4, "-tol", 1e-10
    one, other = (
        solve(tmp_path / name, BARS, UNLIKE + held + more, *flags) for name, more in (("a", heated), ("b", cooled))
    )
    assert one["contacts"][0]["normalForce"] == pytest.approx(other["contacts"][0]["normalForce"], rel=1e-8)
    for each, of_expand in zip(one["bodies"], other["bodies"], strict=True):
        assert each["motion"] == pytest.approx(of_expand["motion"], rel=1e-7, abs=1e-9)
    for each, of_expand in zip(one["stresses"], other["stresses"], strict=True):
        assert each["vonMises"] == pytest.approx(of_expand["vonMises"], rel=1e-7)


def test_thermal_stresses(tmp_path):
    """Stresses along a radius of the ring: Lame's and those of the temperature (Timoshenko and Goodier, 150)."""
    case = sleeve(60) + "line r 25.5 6 44.5 6\n"
    solve(tmp_path, TUBE, case, "-order", 4)
    found = np.genfromtxt(tmp_path / "out/line-r.csv", delimiter=",", names=True)
    pressure, heat, _ = exact_fit(60)
    flow, r = heat / (2 * pi), found["x"]

    def integral(end):
        """Of (T - 140) r from the seat to a radius."""
        rise, start = flow / 0.2, 60 - flow / 0.2 * np.log(45 / 25) - 140
        return (start - rise / 2) * (end**2 - 25**2) / 2 + rise * end**2 / 2 * np.log(end / 25)

    warm = 60 - 140 - flow / 0.2 * np.log(45 / r)
    scale, whole = 23e-6 * 70e3 / (1 - 0.33), integral(45) / (45**2 - 25**2)
    lame = [np.array(each) for each in zip(*(forms.ring_stress(place, pressure, 25, 45) for place in r), strict=True)]
    along = lame[0] + scale * ((1 - 25**2 / r**2) * whole - integral(r) / r**2)
    around = lame[1] + scale * ((1 + 25**2 / r**2) * whole + integral(r) / r**2 - warm)
    third = 0.33 * (along + around) - 23e-6 * 70e3 * warm
    for name, exact in (("stressXX", along), ("stressZZ", around), ("stressYY", third)):
        assert found[name] == pytest.approx(exact, abs=2e-3 * np.abs(exact).max()), name


def test_no_steady_state(tmp_path):
    """A ring that touches only while it is cold, and is warmed by what touches: the run says that it found nothing."""
    bodies = FIT + "conduct shaft 0.05 expand 2e-6 from 20\nconduct ring 0.2 expand 23e-6 from 20\n"
    held = "symmetry floor\nsymmetry roof\ntemperature bore 100\nfilm outside 1e-3 20\n"
    contact = "contact seat journal interference 0.002 conductance 0.01"
    case = f"state axisymmetric\n{bodies}{contact}\n{held}"
    found = solve(tmp_path / "a", TUBE, case, "-set", "edges", 3, "-order", 1, expect=20)
    assert "no steady state" in found["message"] and "hardness" in found["message"] and found["heat"]["rounds"] == 200
    found = solve(tmp_path / "b", TUBE, case.replace("0.01\n", "0.01 hardness 100\n"), "-set", "edges", 3)
    assert 0 < found["heat"]["contacts"][0]["conductance"] < 1e-3


def test_cold_body(tmp_path):
    """A body that is warm by nothing has no temperature; one that no statement can warm is refused at once."""
    case = f"{SOFT}{CONTACT}\n{HELD}move top 0 1\nflux top 0.1\n"
    found = solve(tmp_path / "bar", BARS, case, expect=20)
    assert found["message"].startswith("upper: nothing fixes its temperature")
    folder = ROOT / "edp/examples/roller"  # roller and plate touch, and nothing warms either of them
    case = (folder / "roller.case").read_text() + "".join(
        f"conduct {name} 1\n" for name in ("roller", "upper", "lower")
    )
    case = case.replace("upper-face", "upper-face conductance 1") + "temperature base 20\n"
    said = solve(tmp_path / "roller", folder / "roller.geo", case, "-set", "size", 1, "-estimate", 0, expect=10)
    assert "upper: nothing can fix its temperature; allowed: a temperature or film on it" in said
    assert not (tmp_path / "roller/out/summary.json").exists()


def test_law(tmp_path):
    """With a law the conductance follows its pressure."""
    case = f"{SOFT}{CONTACT} law power kappa 100 m 2 d0 -0.1\n{HELD}move top 0 -1\ntemperature top 1\n"
    found = solve(tmp_path, BARS, case, "-set", "n", 4)
    pressure = found["contacts"][0]["normalForce"] / 20
    assert 1 < pressure < 6
    assert found["heat"]["in"] == pytest.approx(20 * flux(pressure), rel=1e-6)


CASE = f"{SOFT}{CONTACT}\n{HELD}move top 0 -1\ntemperature top 1\n"
FLAGS = {  # flags: what the message says
    "-distance exact": "-distance exact: not with conduct",
    "-history 1": "whose heat is steady",
    "-accuracy 1e-2": "temperatures have no estimated error",
    "-method newton": "-method newton: not with conduct",
}
CHANGES = {  # what the message says: what is changed in the case
    "upper: nothing says how it conducts": ("conduct upper 2\n", ""),
    "line 4: a conductance, and no body conducts": (
        "conduct lower 1\nconduct upper 2\ncontact",
        "#\ncontact",
        "temp",
        "#",
    ),
    "line 8: a temperature, flux, film, source or time, and no body conducts": (
        "conduct lower 1\nconduct upper 2\n",
        "",
    ),
    "no temperature anywhere": ("temperature bottom 0\n", "", "temperature top 1\n", ""),
    "expand with conduct": ("clamp", "expand lower 1e-5 3\nclamp"),
    "line 5: wear with conduct": ("hardness 5", "hardness 5 wear 1e-8 slide 20", "clamp", "cycles 10\nclamp"),
    "preload with conduct": ("clamp", "preload left 3\nclamp"),
    "line 6: top: a flux or film where line 13": ("clamp", "flux top 3\nclamp"),
    "conduct of lower: stated before, in line 3": ("clamp", "conduct lower 3\nclamp"),
    "the conductance is missing": ("0.5 hardness 5", ""),
    "exponent: not allowed here": ("0.5 hardness 5", "0.5 exponent 2"),
    "the conductivity is out of range": ("conduct lower 1", "conduct lower 0"),
    "it stands behind a contact": ("clamp", "conductance 3\nclamp"),
    "did you mean film": ("clamp", "convection top 3\nclamp"),
}


@pytest.mark.parametrize("flag", FLAGS)
def test_refused_flags(flag, tmp_path):
    """Each by its name, before anything is solved."""
    said = solve(tmp_path, BARS, CASE, *flag.split(), "-set", "n", 2, expect=10)
    assert FLAGS[flag] in said and "allowed" in said


@pytest.mark.parametrize("words", CHANGES)
def test_refused_statements(words):
    """The reader of case files names line, statement and what is allowed."""
    case = CASE
    for old, new in zip(CHANGES[words][::2], CHANGES[words][1::2], strict=True):
        assert old in case
        case = case.replace(old, new)
    said = read(case)
    assert words in said and "allowed" in said, said
    assert read(CASE) == ""


GROUPS = [
    *(Group(1, name) for name in "bottom top left right beside face foot".split()),
    Group(2, "lower"),
    Group(2, "upper"),
]


def read(case):
    """What the reader says of a case in the plane: nothing, or its refusal."""
    try:
        read_case(case, Where(), GROUPS)
    except Refusal as refusal:
        return refusal.text("a.case")
    return ""


def test_refused_groups(tmp_path):
    """Temperatures that meet, and bodies that turn, are refused once the mesh is known."""
    meet, turn = CASE.replace("clamp", "temperature left 3\nclamp"), CASE.replace("move top 0 -1", "rotate top 0 0 0.1")
    assert "has another temperature in line" in solve(tmp_path / "a", BARS, meet, "-set", "n", 2, expect=10)
    assert "rotate top: not with conduct" in solve(tmp_path / "b", BARS, turn, "-set", "n", 2, expect=10)
    friction = CASE.replace("hardness 5", "hardness 5 friction 0.1")
    assert "without friction, tie" in solve(tmp_path / "c", BARS, friction, "-set", "n", 2, expect=10)


def test_heat_of_a_body_that_conducts_far_better(tmp_path):
    """A ring of next to no resistance: its group gives what the shaft takes."""
    case = CONDUCTS.replace("ring 0.2", "ring 2e10")
    case = f"state stress\n{FIT}{case}contact seat journal conductance 0.2 hardness 1000\n"
    case += "symmetry floor\nsymmetry side\ntemperature bore 20\ntemperature outside 100\n"
    mesh = ROOT / "edp/examples/heated-fit/heated-fit.geo"
    heat = solve(tmp_path, mesh, case, "-set", "edges", 4, "-estimate", 0)["heat"]
    taken, given = (group["heat"] for group in heat["groups"])
    assert given == pytest.approx(-taken, rel=1e-9)
    assert given == pytest.approx(abs(heat["contacts"][0]["heat"]), rel=1e-9)
    assert 4 < given < 7


@pytest.mark.parametrize("upper, off", [(2e6, 0), (2e10, 2e-3), (2e13, 2)])
def test_rounding_of_heat_is_said(tmp_path, upper, off):
    """Two groups hold a body's temperature: their shares are lost to rounding with a word, and only then."""
    case = SOFT.replace("conduct upper 2", f"conduct upper {upper!r}")
    case += f"{CONTACT}\n{HELD}move top 0 -1\ntemperature top 1\ntemperature beside 1\n"
    summary = solve(tmp_path, BARS, case, "-set", "n", 3)
    balance = sum(group["heat"] for group in summary["heat"]["groups"])
    said = [text for text in summary["warnings"] if ": rounding may change the heat that it gives by " in text]
    assert len(said) == 2 * (off > 0)
    assert all(0.5 * off < float(re.search(r"gives by ([^,]+),", text)[1]) < off for text in said)
    assert abs(balance) <= max(2 * off, 1e-6)


def test_flux_and_film_beside_a_held_temperature(tmp_path):
    """The group that alone holds the temperature of a body takes what a flux and a film bring to this body, too."""
    case = f"{SOFT}{CONTACT}\n{HELD}move top 0 -1\ntemperature top 1\nflux left 0.1\nfilm right 0.2 3\n"
    heat = solve(tmp_path, BARS, case, "-set", "n", 2)["heat"]
    balanced(heat)
    assert max(abs(group["heat"]) for group in heat["groups"]) > 1
