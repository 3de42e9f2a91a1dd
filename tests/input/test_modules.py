"""case/, bodies/, surface/ and solve/: each module by itself, against values worked out by hand."""

import json
from itertools import product

import numpy as np
import pytest
from freefem import ROOT, being_written, data, files, named, run, scene_text, snippet, told

E, NU = 100.0, 0.3
LAME = E * NU / ((1 + NU) * (1 - 2 * NU))
SHEAR = E / (2 * (1 + NU))
CONFINED = LAME + 2 * SHEAR  # M = E (1 - nu) / ((1 + nu) (1 - 2 nu))

# ---------------------------------------------------------------- input/flags.idp

FLAGS = data("modules/flags.edp")


@pytest.mark.parametrize("text", ["0.12345678901234567", "+2", "1E-30", ".5", "5."])
def test_flags_keep_every_digit(tmp_path, text):
    """A number shall be read with the precision that it is written in."""
    assert told(snippet(tmp_path, FLAGS, "-alpha", text))["alpha"] == float(text)


def test_flags_in_any_order(tmp_path):
    """Flags shall be taken in any order, FreeFEM's own words among them left alone."""
    flags = ["-text", "-1 'a' $b", "-nw", "-count", "2.0", "-v", "0", "-word", "two", "-alpha", "2"]
    stdout = snippet(tmp_path, FLAGS, *flags)
    values = told(stdout)
    assert (values["alpha"], values["count"]) == (2, 2)
    assert "word two\ntext -1 'a' $b\n" in stdout


NUMBERS = ["0", "10", "1e3x", "1,5", "1.5.2", "nan", "1e400", "0x1", "-", ""]
REFUSED = [(["-alpha", text], [f"-alpha {text}", "a number in (0, 10)"]) for text in NUMBERS]
REFUSED += [(["-count", text], [f"-count {text}", "a whole number from 1 to 5"]) for text in ("0", "6", "2.5", "1e20")]
REFUSED += [(["-word", text], [f"-word {text}", "one two"]) for text in ("tw", "one two", "")]
REFUSED += [
    (["-alpha"], ["-alpha", "a number in (0, 10)"]),
    (["-alpha", "1", "-alpha", "1"], ["-alpha 1", "-alpha once"]),
    (["-alpa", "1"], ["-alpa", "did you mean -alpha?"]),
    (["-other", "1"], ["-other", "-alpha -count -word -text"]),
    (["stray"], ["stray", "a flag with one value after it"]),
    (["-text", "a", "b"], ["b", "a flag with one value after it"]),
]


@pytest.mark.parametrize("flags, words", REFUSED, ids=named)
def test_flags_refused(tmp_path, flags, words):
    """What is not allowed shall be refused in the first line, naming flag, value and what is allowed."""
    first = snippet(tmp_path, FLAGS, *flags, expect=10).splitlines()[0]
    for word in words:
        assert word in first


def test_advice_of_another_value(tmp_path):
    """A message advises a flag's value only where the flag is there and has another one, as default or as given."""
    text = 'include "input/flags.idp"\nstring word = wordFlag("-word", "one", "", "one two");\n'
    said = (f'flagAdvice("-{flag}", "{word}")' for flag, word in (("word", "one"), ("word", "two"), ("none", "one")))
    text += f'cout << "told:" << {" << ".join(said)} << ":" << endl;\n'
    assert "told:use -word two, or :" in snippet(tmp_path, text)
    assert "told:use -word one, or :" in snippet(tmp_path, text, "-word", "two")


@pytest.mark.parametrize("help_flag", ["-help", "--help"])
def test_help(tmp_path, help_flag):
    """-help shall print flags, defaults, units and ranges, even beside a flag that is wrong, and run nothing."""
    stdout = snippet(tmp_path, FLAGS, "-alpha", "abc", help_flag)
    rows = {line.split()[0]: line for line in stdout.splitlines() if line.startswith("-")}
    assert list(rows) == ["-alpha", "-count", "-word", "-text"]
    for word in ("1.5", "length", "a real number", "(0, 10)"):
        assert word in rows["-alpha"]
    assert "What the script is for." in stdout
    assert not told(stdout)


# ---------------------------------------------------------------- input/output.idp

OUTPUT = data("modules/output.edp")


def test_output_cut_off_is_not_published(tmp_path):
    """A file shorter than its writer left it shall not be published, nor left behind, and the run shall say so."""
    stdout = snippet(tmp_path, OUTPUT.replace("CUT", "4"), expect=30)
    assert "could not be written whole" in stdout
    folder = tmp_path / "folder of results"
    assert files(folder) == being_written(folder) == []


# ---------------------------------------------------------------- fem/mesh/gmsh.idp

GMSH = """
include "input/flags.idp"
include "input/output.idp"
include "fem/mesh/gmsh.idp"
"""


MESH = """
string[int] names = ["depth", "left", "right", "h", "grading"];
real[int] values = [0.5, 0.25, 0.75, 0.125, 0];
Th = gmshMesh("block", names, values, 40.);
"""

GROUPS = data("modules/groups.edp")


def test_mesh_has_its_named_groups(tmp_path):
    """The mesh shall have the size asked for, and its groups shall be found by name."""
    values = told(snippet(tmp_path, GMSH + MESH + GROUPS))
    np.testing.assert_allclose(values["area"], 40 * 20, rtol=1e-12)
    np.testing.assert_allclose(values["lines"], [20, 20, 40], rtol=1e-12)


def test_unknown_group_is_refused(tmp_path):
    """A group that the mesh does not have shall be refused by name, not become a label that marks nothing."""
    first = snippet(tmp_path, GMSH + MESH + 'int lost = group("contac");', expect=10).splitlines()[0]
    assert 'no physical group "contac"' in first


# ---------------------------------------------------------------- solver/element-system.idp

# the block [-2, 2] x [0, 2] in squares of side 1, clamped below, sides sliding
BLOCK = ["-method", "newton", "-width", 4, "-depth", 2, "-h", 1, "-E", E, "-nu", NU]

ENERGY = data("modules/energy.edp")


def high(order):
    """What begins a script that names an element which is read when -order asks for it."""
    return "macro highOrderOnRequest() 1 //\n" if order > 2 else ""


@pytest.mark.parametrize("order", [1, 2, 4])
def test_elastic_energy(tmp_path, order):
    """The stiffness shall give the strain energy of displacements whose energy is an integral by hand."""
    element = f"[P{order}, P{order}]"
    values = told(
        snippet(
            tmp_path,
            high(order) + scene_text("confined-block") + ENERGY.replace("ELEMENT", element),
            *BLOCK,
            "-order",
            order,
        )
    )
    np.testing.assert_allclose(values["pressed"], 0.5 * CONFINED * 0.01**2 * 8, rtol=1e-12)
    if order > 1:
        # e22 = c x, 2 e12 = c y: M c^2 int x^2 + mu c^2 int y^2
        sheared = 0.5 * 0.01**2 * (CONFINED * 2 * (16 / 3) + SHEAR * 4 * (8 / 3))
        np.testing.assert_allclose(values["sheared"], sheared, rtol=1e-12)


WEIGHT = """
macro loads(v1, v2) int2d(Th)(-3. * v2) //
"""

SINKING = """
set(stiffness, solver = "CHOLMOD", sym = 1, positive = 1);
real[int] sunk = stiffness^-1 * bodyLoad; real[int] top = sunk(pointDof);
tell("top", top); tell("load", bodyLoad.sum);
"""


def test_body_load(tmp_path):
    """A confined column under its own weight g shall sink at its top by g L^2 / (2 M)."""
    discretise = 'include "solver/discretise.idp"'
    text = scene_text("confined-block")
    assert text.count(discretise) == 1
    values = told(snippet(tmp_path, text.replace(discretise, WEIGHT + discretise) + SINKING, *BLOCK, "-order", 2))
    np.testing.assert_allclose(values["top"], -3 * 2**2 / (2 * CONFINED), rtol=1e-12)


# ---------------------------------------------------------------- fem/half-storage.idp

HALVES = data("modules/halves.edp")


def test_half_matrices(tmp_path):
    """What any FreeFEM halves shall multiply, be added to and be factorised as the whole."""
    values = told(snippet(tmp_path, HALVES))
    assert values["stored"] == 0 and max(values["product"], values["sum"], values["solution"]) < 1e-12


# ---------------------------------------------------------------- contact/surfaces/vertical-slave.idp

POINTS = data("modules/points.edp")
# points inside an edge from -1 to 1
INSIDE = {1: [], 2: [0], 3: [-np.sqrt(1 / 5), np.sqrt(1 / 5)], 4: [-np.sqrt(3 / 7), 0, np.sqrt(3 / 7)]}


@pytest.mark.parametrize(
    "order, element, weights",
    [
        (1, "[P1, P1]", np.array([1, 2, 2, 2, 1]) / 2),
        (2, "[P2, P2]", np.array([1, 4, 2, 4, 2, 4, 2, 4, 1]) / 6),
        (3, "[P3, P3]", np.array([1, 5, 5, *[2, 5, 5] * 3, 1]) / 12),
        (4, "[P4, P4]", np.array([9, 49, 64, 49, *[18, 49, 64, 49] * 3, 9]) / 180),
    ],
)
def test_slave_points(tmp_path, order, element, weights):
    """The points shall be the slave's nodes, of P3 and P4 Lobatto's points, from left to right, with the weights."""
    values = told(
        snippet(
            tmp_path,
            high(order) + scene_text("confined-block") + POINTS.replace("ELEMENT", element),
            *BLOCK,
            "-order",
            order,
        )
    )
    x = np.append((np.arange(-2, 2)[:, None] + 0.5 + 0.5 * np.array([-1, *INSIDE[order]])).ravel(), 2)
    np.testing.assert_allclose(values["x"], x, atol=1e-14)
    np.testing.assert_allclose(values["y"], 2, rtol=1e-14)
    np.testing.assert_allclose(values["weight"], weights, rtol=1e-13)
    assert abs(values["weight"].sum() - 4) < 1e-13
    np.testing.assert_allclose(values["trace"], 10 * x + 2, atol=1e-13)


# ---------------------------------------------------------------- contact/pairing/pair-plane.idp

MASTER = data("modules/master.edp")


@pytest.mark.parametrize(
    "order, element, h, surface",
    [
        (1, "[P1, P1]", 1.7, "smooth"),
        (2, "[P2, P2]", 1.7, "facets"),
        (2, "[P2, P2]", 0.5, "smooth"),
        (4, "[P4, P4]", 1.7, "facets"),
        (4, "[P4, P4]", 1.7, "smooth"),
    ],
)
def test_master_map(tmp_path, order, element, h, surface):
    """The overlap shall be the slave's trace less the master's: exact for linear functions of the places on curved
    elements, on straight ones for polynomials of the elements' degree."""
    text = high(order) + scene_text("meshed-disc") + MASTER.replace("ELEMENT", element)
    values = told(
        snippet(tmp_path, text, "-method", "newton", "-points", "nodal", "-h", h, "-order", order, "-surface", surface)
    )
    x, paired = values["x"], values["paired"] == 1
    assert values["unpaired"] == (~paired).sum()
    assert paired.all()
    near = dict(rtol=0, atol=1e-11)
    np.testing.assert_allclose(values["rigid"], 0, **near)
    np.testing.assert_allclose(values["sideways"], 0, **near)
    np.testing.assert_allclose(values["linear"], -(2 - 3 * x), **near)
    np.testing.assert_allclose(values["slave"], 2 - 3 * x + 0.5 * x**2, **near)
    if order > 1 and surface == "facets":
        np.testing.assert_allclose(values["quadratic"], -(2 - 3 * x + 0.5 * x**2), **near)


COVERED = data("modules/covered.edp")


SHORT, LONG = (0.62, 1), (0.35, 0.56, 0.74, 0.8)


@pytest.mark.parametrize("share", [*SHORT, *LONG])
@pytest.mark.parametrize("order, element", [(1, "[P1, P1]"), (2, "[P2, P2]"), (3, "[P3, P3]"), (4, "[P4, P4]")])
def test_partly_covered(tmp_path, share, order, element):
    """Whatever part the master covers, no weight shall be negative, and together they give the integrals."""
    text = high(order) + scene_text("patch-test")
    whole = "upperElements, [width * (x - 0.5), depth + joinDistance + height * y"
    assert text.count(whole) == 1
    text = text.replace(
        whole, f"upperElements, [width * ({share} * x - 0.5), depth + joinDistance + height * y"
    ) + COVERED.replace("ELEMENT", element)
    values = told(snippet(tmp_path, text, "-method", "newton", "-order", order, "-width", 2, "-lower", 4, "-upper", 3))
    weight, paired = values["weight"], values["paired"] == 1
    assert (weight > 0).all()
    end = 2 * share - 1
    lost = 2 * share - weight[paired].sum()
    if (order, share) in ((4, 0.56), (4, 0.8)):  # of a point's weight less than 2 % is covered: it stays open
        assert 1e-9 < lost < 0.02 * weight.max()
        return
    assert lost == pytest.approx(0, abs=1e-9)
    assert weight @ values["linear"] == pytest.approx(-(2 * end - 1.5 * end**2 + 3.5), abs=1e-9)


# ---------------------------------------------------------------- solver/problem/problem.idp

# The solver's overlaps are made wrong by a share of the greatest one, and the displacement by a share of itself.
SPOILT = data("modules/spoilt.edp")


@pytest.mark.parametrize("flags", ["", "-method paper", "-force 80", "-law signorini -tol 1e-12"])
def test_overlaps_of_the_displacement(flags, tmp_path):
    """What the solver has summed must be what the displacement makes, to 10 -tol, or the run has no result."""
    text = scene_text("disc-on-block") + SPOILT
    tol = float(flags.split()[-1]) if "-tol" in flags else 1e-6
    text = text.replace("1e-5 * max", f"{max(10 * tol, 1e-8)} * max")
    values = told(snippet(tmp_path, text, *flags.split(), "-order", 1, "-h", 1, "-estimate", 0, "-vtu", 0))
    assert {name: bool(value[0]) for name, value in values.items()} == {
        "right": True,
        "little": True,
        "much": False,
        "less": False,
        "moved": False,
    }


# ---------------------------------------------------------------- solver/newton/full-system.idp

# A Newton step from u0 solves J (u1 - u0) = -G(u0). G, the imbalance, is written anew here; J by central differences.
TANGENT = data("modules/tangent.edp")


TANGENTS = [("disc-on-block", 4), ("meshed-disc", 2), ("confined-block", 1)]
OTHERS = sorted({*product(("disc-on-block", "meshed-disc", "confined-block"), (1, 2, 3, 4))} - {*TANGENTS})
TANGENTS += [case for case in OTHERS]


@pytest.mark.parametrize("scene, order", TANGENTS)
def test_tangent(tmp_path, scene, order):
    """The linearised system shall be the derivative of the equilibrium residual, by central differences."""
    solver = (ROOT / "edp/solver/solve.idp").read_text()
    assert (
        solver.count("printHistoryHead();") == solver.count("openOutputFolder(requestedFolder, preservedFiles);") == 1
    )
    solver = solver.split("printHistoryHead();")[0].replace("openOutputFolder(requestedFolder, preservedFiles);", "")
    flags = ["-method", "newton", "-order", order, "-h", 1, *(["-Eratio", 50] if scene == "meshed-disc" else [])]
    values = told(snippet(tmp_path, scene_text(scene) + solver + TANGENT, *flags))
    for step in (2, 5):
        assert values[f"imbalance{step}"] > 1e-3
        assert values[f"error{step}"] < 1e-7 * values[f"imbalance{step}"]


# ---------------------------------------------------------------- kernel/

SPREAD = data("modules/spread.edp")
BODIES = "body foundation E 70e3 nu 0.3\nbody punch E 210e3 nu 0.3\nclamp base\ncontact top sole\npressure head 100\n"
PUNCHED = ["-mesh", "punch.geo", "-case", "punch.case", "-order", 2]


def parts_of(folder, state):
    """A rounded punch's files and the script of its parts, up to the solution."""
    (folder / "punch.geo").write_text(data("results/punch.geo"))
    (folder / "punch.case").write_text(f"{state}size contact 3\nsize foundation 20\nsize punch 15\n{BODIES}")
    return (ROOT / "edp/parts.edp").read_text().split('include "solver/solve.idp"')[0]


@pytest.mark.parametrize("name", ["disc-on-block", "about an axis", "chords", "chords about an axis"])
def test_of_some_points(tmp_path, name):
    """Cells that add up to the surface, its ends' as large before as behind; pressures of some points straight between
    these, and none beyond, whatever was there before."""
    axis, chords = name.endswith("axis"), name.startswith("chords")
    text = parts_of(tmp_path, "state axisymmetric\n" * axis) if chords else scene_text("disc-on-block")
    flags = PUNCHED if chords else ["-order", 2, "-h", 1, *(["-geometry", "axisymmetric"] if axis else [])]
    values = told(snippet(tmp_path, text + SPREAD, *flags))
    x, cell = values["x"], values["cell"]
    way = values["along"] if chords else x
    between = 0.5 * (way[1:] + way[:-1])
    edges = np.concatenate([[2 * way[0] - between[0]], between, [2 * way[-1] - between[-1]]])
    edges[0] *= not axis  # there a circle
    areas = np.pi * (edges[1:] ** 2 - edges[:-1] ** 2) if axis else np.diff(edges)
    assert cell == pytest.approx(areas, rel=0.01 if chords and axis else 1e-9)  # round the corner: 2 pi r by its length
    some = values["places"].astype(int)
    expected = np.interp(way, way[some], values["coarse"], left=0, right=0)
    assert values["fine"] == pytest.approx(expected, abs=1e-12) and (expected == 0).any()


# ---------------------------------------------------------------- lists of a scene's own

LISTS = """
macro eachLaw(do) do(signorini) do(power) //
macro lawFiles() include "contact/laws/signorini.idp"
include "contact/laws/power.idp" //
macro eachMethod(do) do(newton) //
macro methodFiles() include "solver/methods/newton.idp" //
"""


def test_a_scene_loads_the_laws_and_methods_that_it_offers(tmp_path):
    """A scene with its own lists shall load nothing else, and take the first entry where the usual one is missing."""
    text = LISTS + (ROOT / "edp/scenes/confined-block.edp").read_text()
    snippet(tmp_path, text, "-h", 5, "-vtu", 0, "-out", tmp_path / "out")
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    loaded = {
        name
        for name in summary["modules"]
        if name.startswith(("contact/laws/", "solver/newton/extended-newton", "solver/methods/", "solver/surrogate/"))
    }
    assert loaded == {
        "contact/laws/laws",
        "contact/laws/power",
        "contact/laws/signorini",
    } | {
        "solver/newton/extended-newton",
        "solver/methods/newton",
        "solver/surrogate/half-plane",
        "solver/surrogate/horizontal-plane",
    }
    assert summary["method"] == "newton"
    exact = run("confined-block", "-h", 5, "-method", "newton").summary["force"]
    assert summary["force"] == pytest.approx(exact, rel=1e-12)
    refused = snippet(tmp_path, text, "-method", "xnewton", expect=10)
    assert refused.startswith("-method xnewton: unknown; allowed: one of: newton;")


# ---------------------------------------------------------------- contact/points/points-of-map.idp

ENTRIES = data("modules/entries.edp")


def test_entries_of_a_matrix(tmp_path):
    """A matrix read as triplets shall keep its last entry, and gain none: FreeFEM adds the size if that is missing."""
    lines = snippet(tmp_path, ENTRIES).splitlines()
    once = ["told count 4", "told value 1 2 3 4", "told at 1 10 22 23"]
    assert [line for line in lines if line.startswith("told")] == 2 * once
