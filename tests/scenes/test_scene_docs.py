"""edp/scenes/README.md against the package: its sections, boundaries, gaps, commands, numbers and references."""

import re
import shlex

import numpy as np
import pytest
from docs.test_readme import fences, quoted, rows, section
from freefem import ROOT, check_invariants, run, scenes, script, skip_without_ipopt, stored, table
from page_numbers import agrees, number
from solver.test_acceptance import FORCE, HALF_WIDTH, PRESSURE_MAX

TEXT = (ROOT / "edp/scenes/README.md").read_text()
SCENES = scenes()
PARTS = ["Strong form", "Boundary", "Reference", "Expected numbers"]
INDEPENDENT = {"force": FORCE, "pressureMax": PRESSURE_MAX, "halfWidth": HALF_WIDTH}


def headings(text, level):
    return re.findall(rf"^{'#' * level} (.*)$", text, re.M)


# ---------------------------------------------------------------- sections and boundaries


def test_every_scene_has_a_section():
    """There shall be a section for every scene and for no other, each with its four parts in order."""
    assert headings(TEXT, 2)[0] == "In common"
    assert sorted(headings(TEXT, 2)[1:]) == SCENES
    for scene in SCENES:
        assert headings(section(TEXT, scene), 3) == PARTS
        assert re.search(r"^    d\(x", section(TEXT, scene), re.M) or "That of `disc-on-block`" in section(TEXT, scene)


def included(name, space=None):
    """The text of a script and of the scripts and blocks that it includes, as it is read in the plane or in space."""
    text = (ROOT / "edp" / name).read_text()
    outer = re.findall(r'^include "(scenes/\S+)"', text, re.M)
    if space is None:
        space = any(
            "macro threeDimensional()" in one for one in [text, *((ROOT / "edp" / file).read_text() for file in outer)]
        )
    other = "!threeDimensional" if space else "threeDimensional"
    text = re.sub(rf"^ *IFMACRO\({other}\)\n.*?^ *ENDIFMACRO\n", "", text, flags=re.M | re.S)
    inner = re.findall(r'^include "(main\.edp|scenes/\S+)"', text, re.M)
    twin = "space" if space else "plane"
    inner += [f"{name}-{twin}.idp" for name in re.findall(r"^readForDimension\((scenes/blocks/\S+)\)", text, re.M)]
    return text + "".join(included(file, space) for file in inner)


def boundaries(scene):
    """The names of a scene's boundary: groups of its .geo one dimension below the body's, or labels of its script."""
    text = included(script(scene.removesuffix("-ipopt")).removeprefix("edp/"))
    geos = re.findall(r'gmshMesh\("([\w-]+)"', text)
    if not geos:
        mesh = text.partition("startClock();")[2]
        lists = re.findall(r"^int ((?:\w+ = \d+(?:, )?)+); *(?://.*)?$", mesh, re.M)
        return set(re.findall(r"(\w+) =", " ".join(lists))) - {"block", "lower", "upper"}
    space = "macro threeDimensional()" in text
    far = re.search(r"^macro fineContact\b", text, re.M) is not None
    fits = [geo for geo in geos if ("far" in geo) == far and ("3d" in geo or not space)]
    source = (ROOT / "meshes" / f"{(fits or geos)[0]}.geo").read_text()
    for name in re.findall(r'Include "([\w.-]+)"', source):
        source += (ROOT / "meshes" / name).read_text()
    kind = "Surface" if space else "Curve"
    return set(re.findall(rf'Physical {kind}\("(\w+)"', source))


def test_boundary():
    """Boundary tables shall name every part of the boundary once, by its name in the .geo file or the script."""
    wrong = []
    for scene in SCENES:
        listed = [" ".join(quoted(row[0])) for row in rows(section(section(TEXT, scene), "Boundary"))]
        if sorted(listed) != sorted(boundaries(scene)):
            wrong.append(f"{scene}: {sorted(listed)}, not {sorted(boundaries(scene))}")
    assert not wrong, "\n".join(wrong)


# ---------------------------------------------------------------- gaps


def rough_modes(given):
    """(wavenumber, amplitude, phase) of each mode of the rough profile, scaled to its root mean square."""
    wave = np.arange(1, given["modes"] + 1)
    state, phases = int(given["seed"]), []
    for _ in wave:
        state = 16807 * state % (2**31 - 1)
        phases.append(2 * np.pi * state / (2**31 - 1))
    size = wave ** (-given["hurst"] - 0.5)
    size *= given["rms"] / np.sqrt(np.sum(size**2) / 2)
    return 2 * np.pi * wave / given["width"], size, np.array(phases)


def rough_profile(x, given):
    wavenumber, size, phase = rough_modes(given)
    return np.sum(size * np.cos(np.outer(x, wavenumber) + phase), axis=1)


def rough_top(given):
    """The profile's highest value: a dense search, and a denser one around what it found."""
    dense = np.linspace(-0.5, 0.5, 100 * int(given["modes"]) + 1) * given["width"]
    found = dense[np.argmax(rough_profile(dense, given))]
    return rough_profile(found + np.linspace(-1, 1, 20001) * (dense[1] - dense[0]), given).max()


def circle(r, radius):
    return radius - np.sqrt(radius**2 - r**2)


# the gap at rest beyond -gap, as the sections write it; c: contact.csv, g: the flags
GAPS = {
    "disc-on-block": lambda c, g: circle(c["x"] - g["offset"], g["R"]),
    "meshed-disc": lambda c, g: circle(c["x"], g["R"]),
    "confined-block": lambda c, g: 0 * c["x"],
    "wavy": lambda c, g: g["amplitude"] * (1 + np.cos(2 * np.pi * c["x"] * g["waves"] / g["width"])),
    "flat-punch": lambda c, g: 0 * c["x"],
    "two-cylinders": lambda c, g: circle(c["x"], g["R1"]) + circle(c["x"], g["R2"]),
    "patch-test": lambda c, g: 0 * c["x"],
    "sphere-on-block": lambda c, g: circle(np.hypot(c["x"], c["y"]), g["R"]),
    "patch-test-3d": lambda c, g: 0 * c["x"],
    "sphere-on-plane": lambda c, g: circle(np.hypot(c["x"], c["y"]), g["R"]),
    "two-spheres": lambda c, g: sum(circle(np.hypot(c["x"], c["y"]), g[name]) for name in ("R1", "R2")),
    "rough": lambda c, g: rough_top(g) - rough_profile(c["x"], g),
}
GAPS["adhesive-sphere"] = GAPS["adhesive-cylinder"] = lambda c, g: circle(c["x"], g["R"])
GAPS["adhesive-sphere-3d"] = GAPS["sphere-on-block"]
GAPS["adhesive-wavy"] = lambda c, g: (
    g["amplitude"] * (1 - np.cos(2 * np.pi * c["x"] * g["waves"] / g["width"]))
    + 0.5 * g["curvature"] * c["x"] * (c["x"] - g["width"] / (3 * g["waves"]))
)
GAPS["hertz-line"] = GAPS["disc-on-block-ipopt"] = GAPS["fretting"] = GAPS["disc-on-block"]
GAPS["fretting-bodies"], GAPS["fretting-3d"] = GAPS["two-cylinders"], GAPS["sphere-on-block"]
GAPS["rolling"], GAPS["wedge"] = GAPS["two-cylinders"], GAPS["disc-on-block"]
NODAL = ["-points", "nodal"]
APART = {"hertz-line": ["-force", 0], "two-cylinders": ["-force", 0, *NODAL], "patch-test": NODAL}
APART |= {"fretting": ["-force", 0, "-shear", 0], "fretting-bodies": ["-force", 0, "-shear", 0, *NODAL]}
APART |= {"rolling": ["-force", 0, "-shear", 0, "-reach", 2, *NODAL], "wedge": ["-force", 0, "-legs", 1]}
APART |= {"patch-test-3d": NODAL, "sphere-on-plane": ["-force", 0, "-layers", 1]}
APART |= {"two-spheres": ["-force", 0, "-layers", 1, *NODAL], "wavy": ["-waves", 10], "rough": ["-modes", 20]}
ENDS = {  # of the contact: the greatest |x| of a point
    **{"disc-on-block": 9.9, "disc-on-block-ipopt": 9.9, "meshed-disc": 9.9, "confined-block": 10, "patch-test": 10},
    **{"wavy": 20, "rough": 20, "flat-punch": 4, "hertz-line": 2, "two-cylinders": 2},
    **{"fretting": 2, "fretting-bodies": 2, "rolling": 2, "wedge": 2},
}


ATTRACTING = [scene for scene in SCENES if scene.startswith("adhesive-")]


def apart(scene):
    """A short run of the scene that shows its gap: short of contact, or of a stiff block."""
    if scene in ATTRACTING:
        h = ["-h", 0.08] if scene == "adhesive-sphere-3d" else []
        return run(scene, "-u0", -0.01, "-E", 1e6, *h)
    return run(scene, "-gap", 0.7, "-u0", 0.1, "-h", 1, *APART.get(scene, []))


@pytest.mark.parametrize("scene", ATTRACTING)
def test_gap_of_what_attracts(scene):
    """A thousand times as stiff a block shall show the section's gap as it is, up to the section's ends."""
    done = apart(scene)
    gap = done.parameters["gap"] + GAPS[scene](done.contact, done.parameters)
    np.testing.assert_allclose(done.contact["overlap"], -0.01 - gap, rtol=0, atol=1e-8)
    assert done.contact["x"].max() == pytest.approx(done.parameters.get("reach", 2.5), rel=1e-9)


@pytest.mark.parametrize("scene", [scene for scene in SCENES if scene not in ATTRACTING])
def test_gap(scene):
    """Short of contact the overlap shall be the section's formula with u = 0, at points up to the section's ends."""
    done = apart(scene)
    assert done.force == 0
    gap = 0.7 + GAPS[scene](done.contact, done.parameters)
    np.testing.assert_allclose(done.contact["overlap"], 0.1 - gap, rtol=0, atol=1e-12)
    if scene in ENDS:
        assert done.contact["x"].max() == pytest.approx(ENDS[scene], rel=1e-9)
        assert done.contact["x"].min() == pytest.approx(-ENDS[scene], rel=1e-9)


def test_square_of_the_sphere():
    """Without -patch the sphere's square shall have the size that the section gives."""
    done = run("sphere-on-block", "-h", 2, "-estimate", 1)
    depth = 2.5 - 0.5 + 0.25
    assert done.contact["x"].max() == pytest.approx(1.1 * np.sqrt(depth * (20 - depth)), rel=1e-9)


# ---------------------------------------------------------------- references


def confined_modulus(young, nu):
    return young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))


def uniform(given, soft):
    """The state of the power law in series with a spring of flexibility `soft` (length/pressure), by bisection."""
    push, d0, kappa, m = given["u0"] - given["gap"], given["d0"], given["kappa"], given["m"]
    low, high = 0.0, push - d0  # of s = d - d0
    for _ in range(200):
        s = 0.5 * (low + high)
        low, high = (s, high) if kappa * s**m < (push - d0 - s) / soft else (low, s)
    p = (push - d0 - s) / soft
    energy = given["width"] * (p**2 * soft / 2 + p * s / (m + 1))
    values = {"pressureMax": p, "least `pressure`": p, "force": given["width"] * p, "overlapMax": s + d0}
    return {**values, "energy": energy}


def confined_block(given):
    return {"bisection": uniform(given, given["depth"] / confined_modulus(given["E"], given["nu"]))}


def patch_test(given):
    modulus = confined_modulus(given["E"], given["nu"])
    soft = given["depth"] / modulus + given["height"] / (modulus * given["Eratio"])
    return {"bisection": uniform(given, soft)}


def patch_test_3d(given):
    values = patch_test(given)["bisection"]
    return {"bisection": values | {name: values[name] * given["width"] for name in ("force", "energy")}}


def plane_modulus(given):
    return given["E"] / (1 - given["nu"] ** 2)


def wavy(given):
    length = given["width"] / given["waves"]
    merge = np.pi * plane_modulus(given) * given["amplitude"] / length
    means = given["force"] / given["width"] * np.arange(1, given["steps"] + 1) / given["steps"]
    if not given["history"]:
        means = means[-1:]
    greatest = np.where(means < merge, 2 * np.sqrt(means * merge), means + merge)
    values = {f"pressureMax at step {i}": value for i, value in enumerate(greatest, 1)}
    values |= {"pressureMax": greatest[-1], "share of contact": 1.0}
    if means[-1] < merge:
        values |= {"share of contact": 2 / np.pi * np.arcsin(np.sqrt(means[-1] / merge))}
    else:
        values |= {"pressure at x = 1": means[-1] + merge, "pressure at x = 2": means[-1] - merge}
    points = round(given["width"] / given["h"]) * given["order"] + 1
    return {"Westergaard": values, "all points": {"wallPoints": points}}


def flat_punch(given):
    force, a = given["force"], given["a"]
    at = {f"pressure at x = {x}": force / (np.pi * np.sqrt(a**2 - float(x) ** 2)) for x in ("0", "0.5", "0.8")}
    return {"closed form": {**at, "halfWidthMoment": np.sqrt(2) * a}}


def hertz(force, radius, modulus):
    a = np.sqrt(4 * force * radius / (np.pi * modulus))
    return {"halfWidthMoment": a, "pressureMax": 2 * force / (np.pi * a)}


def half_plane(force, radius, modulus):
    """Under the profile x^2/(2R) + x^4/(8R^3): half-width by bisection, the pressure's moment by quadrature."""
    low, high = 0.0, radius
    for _ in range(200):
        a = 0.5 * (low + high)
        carried = np.pi * modulus * a**2 * (1 + 3 * a**2 / (8 * radius**2)) / (4 * radius)
        low, high = (a, high) if carried < force else (low, a)
    angle = (np.arange(1000) + 0.5) * np.pi / 1000  # x = a cos(angle)
    x = a * np.cos(angle)
    pressure = modulus * a * np.sin(angle) * (1 + (a**2 / 2 + x**2) / (2 * radius**2)) / (2 * radius)
    share = pressure * a * np.sin(angle) * np.pi / 1000
    assert np.sum(share) == pytest.approx(force, rel=1e-10)
    greatest = modulus * a * (1 + a**2 / (4 * radius**2)) / (2 * radius)
    return {"halfWidthMoment": 2 * np.sqrt(np.sum(share * x**2) / force), "pressureMax": greatest}


def hertz_line(given):
    case = given["force"], given["R"], plane_modulus(given)
    return {"Hertz": hertz(*case), "closed form, circle": half_plane(*case), "prescribed": {"force": given["force"]}}


def two_cylinders(given):
    modulus = 1 / sum((1 - given[f"nu{i}"] ** 2) / given[f"E{i}"] for i in (1, 2))
    values = hertz(given["force"], 1 / (1 / given["R1"] + 1 / given["R2"]), modulus)
    facing = {"every slave point faces the master": {"unpairedPoints": 0}}
    return {"Hertz": values, "prescribed": {"force": given["force"]}, **facing}


def sphere_on_block(given):
    a = (3 * given["force"] * given["R"] / (4 * plane_modulus(given))) ** (1 / 3)
    values = {"halfWidthMoment": a, "pressureMax": 3 * given["force"] / (2 * np.pi * a**2)}
    return {"Hertz": values, "prescribed": {"force": given["force"]}}


def two_spheres(given):
    modulus = 1 / sum((1 - given[f"nu{i}"] ** 2) / given[f"E{i}"] for i in (1, 2))
    radius = 1 / (1 / given["R1"] + 1 / given["R2"])
    a = (3 * given["force"] * radius / (4 * modulus)) ** (1 / 3)
    values = {"halfWidthMoment": a, "pressureMax": 3 * given["force"] / (2 * np.pi * a**2)}
    forces = {"force": given["force"], "masterForceZ": given["force"]}
    facing = {"every slave point faces the master": {"unpairedPoints": 0}}
    return {"Hertz": values, "prescribed": forces, **facing}


def rough(given):
    wavenumber, size, phase = rough_modes(given)

    def pressure(x):
        waves = wavenumber * size * np.cos(np.outer(x, wavenumber) + phase)
        return given["force"] / given["width"] + plane_modulus(given) / 2 * np.sum(waves, axis=1)

    at = {f"pressure at x = {text}": pressure([number(text)])[0] for text in ("−10", "0", "5")}
    greatest = pressure(np.linspace(-0.5, 0.5, 4001) * given["width"]).max()
    closed = {"closed form": {**at, "pressureMax": greatest}}
    return {**closed, "all points": {"wallPoints": round(given["width"] / given["h"]) * given["order"] + 1}}


def independent(given):
    return {"independent code": INDEPENDENT}


def meshed_disc(given):
    alone = run("disc-on-block", "-method", given["method"], "-order", given["order"], "-h", given["h"])
    return {
        "the paper": {"adaptations": 3, "newton": 12},
        "`disc-on-block`, the same flags": alone.summary,
        "independent code, rigid disc": INDEPENDENT,
    }


def minimum(given):
    other = run("disc-on-block", "-order", given["order"], "-h", given["h"], "-tol", given["tol"])
    return {"`disc-on-block`, the same flags": other.summary, "independent code": INDEPENDENT}


REFERENCES = {
    **{"disc-on-block": independent, "meshed-disc": meshed_disc, "disc-on-block-ipopt": minimum},
    **{"confined-block": confined_block, "patch-test": patch_test, "wavy": wavy, "flat-punch": flat_punch},
    **{"hertz-line": hertz_line, "two-cylinders": two_cylinders, "sphere-on-block": sphere_on_block, "rough": rough},
    **{"patch-test-3d": patch_test_3d, "sphere-on-plane": sphere_on_block, "two-spheres": two_spheres},
}


def fretting(given):
    pulls = {f"shearForce at step {k}": share * given["shear"] for k, share in ((2, 1), (3, -1))}
    return {"prescribed": {"force": given["force"], **pulls}}


def fretting_bodies(given):
    modulus = plane_modulus({"E": given["E1"], "nu": given["nu1"]})
    force, pull, friction = given["force"], given["shear"], given["friction"]

    def ahead(q):
        left = force - q / friction
        return 2 * friction / np.pi / modulus * (left * np.log(left / force) + q / friction)

    at, share = np.polynomial.legendre.leggauss(60)
    loop = 4 * pull * ahead(pull) - 4 * pull * (share * ahead(pull / 2 * (at + 1))).sum()
    hertzian = {"halfWidthMoment": hertz(force, 5, modulus / 2)["halfWidthMoment"]}
    return {"Hertz": hertzian, "Cattaneo and Mindlin": {"dissipated": loop / 4}, **fretting(given)}


REFERENCES["fretting"], REFERENCES["fretting-bodies"], REFERENCES["fretting-3d"] = fretting, fretting_bodies, fretting


def rolling(given):
    half = hertz(given["force"], 5, plane_modulus({"E": given["E1"], "nu": given["nu1"]}) / 2)["halfWidthMoment"]
    slips = 1 - np.sqrt(1 - given["shear"] / given["friction"] / given["force"])
    carter = {"Carter": {"creepage": given["friction"] * half / 5 * slips}, "Hertz": {"halfWidthMoment": half}}
    return {**carter, "prescribed": {"shearForce at step 81": given["shear"]}}


def wedge(given):
    slope, friction = given["slope"], given["friction"]
    forces = {"force at step 1": slope * given["force"] / (slope + friction)}
    if friction < slope:
        forces["force at step 2"] = 1e-3 * slope * given["force"] / (slope - friction)
    return {"equilibrium": forces, "comes out": {"stickingPoints at step 2": 0}}


REFERENCES["rolling"], REFERENCES["wedge"] = rolling, wedge
REFERENCES["adhesive-wavy"] = lambda given: {}


def sphere_that_attracts(given):
    least = -1.6702 * np.pi * given["w"] * given["R"]
    return {"boundary elements": {"pullOff": least, "force": least}}


def cylinder_that_attracts(given):
    return {"JKR": {"pullOff": -0.75 * (4 * np.pi * plane_modulus(given) * given["w"] ** 2 * given["R"]) ** (1 / 3)}}


REFERENCES["adhesive-sphere"] = REFERENCES["adhesive-sphere-3d"] = sphere_that_attracts
REFERENCES["adhesive-cylinder"] = cylinder_that_attracts
MEASURED = "measured with this package"

# ---------------------------------------------------------------- commands and numbers


def experiments():
    """(scene, command, rows) of every command, the table being the one that follows it."""
    for scene in SCENES:
        text = section(section(TEXT, scene), "Expected numbers")
        for block in re.split(r"(?=^```sh$)", text, flags=re.M)[1:]:
            (command,) = fences(block, "sh")
            yield scene, " ".join(command.replace("\\\n", " ").split()), rows(block)


EXPERIMENTS = list(experiments())


def test_every_scene_has_a_command():
    """Each scene shall have a command, and each command a table with the same columns."""
    assert {scene for scene, *_ in EXPERIMENTS} == set(SCENES)
    head = "| quantity | this run | reference | difference | from |"
    lines = TEXT.splitlines()
    assert sum(line == head for line in lines) == len(EXPERIMENTS)
    assert all(expected and all(len(row) == 5 for row in expected) for *_, expected in EXPERIMENTS)


def result(command):
    """The run of a command as it is written, but into another folder, shared; every invariant is checked."""
    words = shlex.split(command)
    assert words[:2] == ["make", "run"]
    (flags,) = [word for word in words if word.startswith("ARGS=")]
    scene = next((word.removeprefix("SCENE=") for word in words if word.startswith("SCENE=")), "disc-on-block")
    given = shlex.split(flags.removeprefix("ARGS="))
    skip_without_ipopt(scene)
    done = stored(scene, (*given, "-estimate", "0"))
    assert done.code == 0, done.stdout[-2000:]
    assert done.scene == ("disc-on-block" if scene == "disc-on-block-ipopt" else scene)
    check_invariants(done)
    return done


def value(done, quantity):
    """A quantity of a table, out of the run's files."""
    names = quoted(quantity)
    if quantity == "share of contact":
        weight = done.contact["weight"]
        return weight[done.contact["status"] > 0].sum() / weight.sum()
    (name,) = names
    if quantity == f"least `{name}`":
        return done.contact[name].min()
    if step := re.fullmatch(r"`\w+` at step (\d+)", quantity):
        return table(done.folder / "series.csv")[name][int(step[1]) - 1]
    if x := re.fullmatch(r"`\w+` at x = (\S+)", quantity):
        return np.interp(number(x[1]), done.contact["x"], done.contact[name])
    assert quantity == f"`{name}`"
    return done.summary[name]


@pytest.mark.parametrize("scene, command, expected", EXPERIMENTS, ids=[each[1] for each in EXPERIMENTS])
def test_numbers(scene, command, expected):
    """The command shall give the table's numbers, and its references be those computed here from the flags alone."""
    done = result(command)
    if scene != "disc-on-block-ipopt":
        assert done.scene == scene
    references = REFERENCES[scene](done.parameters)
    for quantity, ours, reference, difference, source in expected:
        found = value(done, quantity)
        assert agrees(found, ours), f"{quantity}: {found}, not {ours}"
        if source == MEASURED:
            assert reference == difference == "", quantity
            continue
        key = quantity if quantity in references[source] else quantity.replace("`", "")
        exact = references[source][key]
        assert agrees(exact, reference), f"{quantity}: reference {exact}, not {reference}"
        off = found - exact if exact == 0 else found / exact - 1
        if difference.startswith("<"):
            assert abs(off) < number(difference[1:]), f"{quantity}: {off}"
        else:
            assert agrees(off, difference), f"{quantity}: difference {off}, not {difference}"
