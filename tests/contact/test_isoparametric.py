"""P2's elements in space that follow curved surfaces: linear fields, volumes, what stays straight, closed forms."""

import re

import numpy as np
import pytest
from freefem import ROOT, cases_of, data, execute, part, snippet, told
from input.test_meshes import read

BALL = """SetFactory("OpenCASCADE"); Sphere(1) = {{0, 0, 0, 1}};
Mesh.MeshSizeMin = {size}; Mesh.MeshSizeMax = {size}; Mesh.ElementOrder = {order};
Physical Volume("ball") = {{1}}; Physical Surface("skin") = {{1}};
"""
ON_PLANE = "body ball E 1000 nu 0.3\nobstacle skin plane 0 0 -1 0 0 1\n"
BULK3 = 1000 / (1 - 2 * 0.3)  # three times the bulk modulus


def gmsh(folder, geo, name="a.msh"):
    (folder / "a.geo").write_text(geo)
    code, stdout = execute(["gmsh", "-3", "-v", "1", "-format", "msh22", folder / "a.geo", "-o", folder / name])
    assert code == 0, stdout
    return (folder / name).read_text()


def skin(text):
    """Places of the six nodes of the second-order triangles of a mesh file: corners, middles of sides 1-2, 2-3, 3-1."""
    _, place, elements = read(text)
    return np.array([[place[node] for node in nodes] for _, nodes in elements[9]])


def volume_and_area(faces):
    """Inside quadratic patches, by the divergence theorem; Gauss's rule on the square, one side drawn together."""
    at, weight = np.polynomial.legendre.leggauss(6)
    at, weight = (at + 1) / 2, weight / 2
    volume = area = 0
    for a, wa in zip(at, weight, strict=True):
        for b, wb in zip(at, weight, strict=True):
            m, n = a, b * (1 - a)
            k = 1 - m - n
            N = [k * (2 * k - 1), m * (2 * m - 1), n * (2 * n - 1), 4 * k * m, 4 * m * n, 4 * n * k]
            by_m = [1 - 4 * k, 4 * m - 1, 0, 4 * (k - m), 4 * n, -4 * n]
            by_n = [1 - 4 * k, 0, 4 * n - 1, -4 * m, 4 * m, 4 * (k - n)]
            normal = np.cross(np.einsum("j,ejc->ec", by_m, faces), np.einsum("j,ejc->ec", by_n, faces))
            volume += wa * wb * (1 - a) * np.einsum("j,ejc,ec->", N, faces, normal) / 3
            area += wa * wb * (1 - a) * np.linalg.norm(normal, axis=1).sum()
    return abs(volume), area


FIELDS = data("isoparametric/fields.edp")


def fields(folder, mesh, case):
    (folder / "a.msh").write_text(mesh)
    (folder / "a.case").write_text(case)
    space, whole = ((ROOT / name).read_text() for name in ("edp/parts-3d.edp", "edp/parts.edp"))
    text = re.sub(r'include "parts.*', "", space) + whole.split("checkOpposingSurfaces();")[0] + FIELDS
    return told(snippet(folder, text, "-mesh", "a.msh", "-case", "a.case"))


@pytest.fixture(scope="module")
def ball(tmp_path_factory):
    return gmsh(tmp_path_factory.mktemp("ball"), BALL.format(size=0.6, order=2))


def test_linear_fields(tmp_path, ball):
    """Rigid motions cost nothing, and a field that swells is in balance with its pressure, to rounding."""
    found = fields(tmp_path, ball, ON_PLANE + f"pressure skin {-BULK3!r}\n")
    assert found["sums"][3] > 100 and found["swollen"] > 100
    assert max(found["moved"], found["turned"], found["patch"]) < 1e-10 * found["swollen"]


def test_volume_and_area(tmp_path, ball):
    """Weights, tractions and the points' areas are those of the second-order mesh."""
    volume, area = volume_and_area(skin(ball))
    found = fields(tmp_path, ball, f"{ON_PLANE}weight ball 0 0 -1\ntraction skin 0 1 0\n")
    assert found["sums"][2] == pytest.approx(-volume, rel=1e-10)
    assert found["sums"][1] == pytest.approx(area, rel=1e-5)
    assert found["weight"] == pytest.approx(area, rel=1e-3)
    assert volume == pytest.approx(4 / 3 * np.pi, rel=2e-3)


def run(folder, mesh, case, *flags):
    """summary.json, and what was printed."""
    done = part(folder, mesh, case, *flags, space=True)
    return done.summary, done.stdout


def within(summary, number, truth, most):
    """Value and error of a force of the first contact: the truth is in it."""
    force = summary["estimates"]["contacts"][0][number]
    assert abs(force["value"] - truth) < force["error"], (force, truth)
    assert abs(force["value"] / truth - 1) < most
    return force


def test_folded(tmp_path, ball):
    """A face that is dented by nearly its element's height: what would be folded stays straight, and that is said."""
    lines = ball.split("\n")
    first = lines.index("$Nodes") + 2
    faces = lines.index("$Elements") + 2
    face = next(line.split() for line in lines[faces + 10 :] if line.split()[1] == "9")
    nodes = [int(node) for node in face[-6:]]
    place = {node: np.array(lines[first + node - 1].split()[1:], float) for node in nodes}
    for k in range(3):
        ends = place[nodes[k]], place[nodes[(k + 1) % 3]]
        middle = (ends[0] + ends[1]) / 2 * (1 - 0.45 * np.linalg.norm(ends[0] - ends[1]))
        lines[first + nodes[3 + k] - 1] = " ".join([str(nodes[3 + k]), *(repr(float(x)) for x in middle)])
    summary, _ = run(tmp_path, "\n".join(lines), ON_PLANE + "weight ball 0 0 -1\n")
    assert any(
        "elements would be folded if they followed curved surfaces, one near (" in w for w in summary["warnings"]
    )
    within(summary, "force", 4 / 3 * np.pi, 0.02)


@pytest.mark.parametrize("order, most", [(2, 1e-3), (1, 0.2)])
def test_ball(tmp_path, order, most):
    """The weight of a ball of about 200 triangles."""
    mesh = gmsh(tmp_path, BALL.format(size=0.45, order=order))
    summary, _ = run(tmp_path, mesh, ON_PLANE + "weight ball 0 0 -1\n")
    within(summary, "force", 4 / 3 * np.pi, most)


EIGHTH = """SetFactory("OpenCASCADE"); Sphere(1) = {0, 0, 0, 1, 0, Pi / 2, Pi / 2};
Physical Volume("ball") = {1}; Mesh.MeshSizeMin = 0.5; Mesh.MeshSizeMax = 0.5;
"""
PRESSED = data("isoparametric/pressed.case")


@pytest.mark.parametrize("heat", [5e-3, -2e-2])
def test_heat(tmp_path, heat):
    """A pressed ball that is warmer too swells as freely as one that is not: the same stress, none of shape."""
    summary, _ = run(tmp_path, EIGHTH, f"{PRESSED}expand ball {heat / 100!r} 100\n", "-estimate", "0")
    line = np.genfromtxt(tmp_path / "out/line-out.csv", delimiter=",", names=True)
    swells = heat - 3 / BULK3
    assert line["ux"] == pytest.approx(swells * line["x"], abs=1e-9)
    assert line["uz"] - line["uz"][0] == pytest.approx(swells * line["z"], abs=1e-9)
    for name in ("stressXX", "stressYY", "stressZZ"):
        assert line[name] == pytest.approx(-3, abs=1e-6)
    assert line["vonMises"] == pytest.approx(0, abs=1e-6)
    assert summary["contacts"][0]["normalForce"] == pytest.approx(3 * np.pi / 4, rel=1e-3)


PLUG = """SetFactory("OpenCASCADE"); Cylinder(1) = {0, 0, 0, 0, 0, 1, 2, Pi / 2};
Physical Volume("plug") = {1}; Mesh.MeshSizeMin = 0.7; Mesh.MeshSizeMax = 0.7;
"""
PLUGGED = "".join(
    f"group {name} plane {place} {normal}\n"
    for name, place, normal in (("x", "0 1 0.5", "1 0 0"), ("y", "1 0 0.5", "0 1 0"), ("low", "1 1 0", "0 0 1"))
)
PLUGGED += "group top plane 1 1 1 0 0 1\nbody plug E 1000 nu 0.3\nobstacle low plane 0 0 0 0 0 1\n"
PLUGGED += "symmetry x\nsymmetry y\npressure top 3\n"


@pytest.mark.parametrize("order, most", cases_of([(2, 1e-4)], [(1, 0.02)]))
def test_pressure_within_a_rim(tmp_path, order, most):
    """A pressure on a flat face whose rim is round: the balance's force is known to the shape of the rim."""
    summary, _ = run(tmp_path, PLUG, PLUGGED, "-order", order)
    assert within(summary, "force", 3 * np.pi, most)["error"] < 10 * abs(summary["force"] - 3 * np.pi)


FLUSH = PLUG.replace("Physical", "Cylinder(2) = {0, 0, 1, 0, 0, 1, 2, Pi / 2}; Physical")
FLUSH += 'Physical Volume("upper") = {2}; MeshSize{PointsOf{Volume{2};}} = 0.5;\n'
STACKED = PLUGGED.replace("pressure top 3", "").replace("top plane 1 1 1", "top plane 1 1 2").replace("nu 0.3", "nu 0")
STACKED = STACKED.replace(
    "obstacle low plane 0 0 0 0 0 1", "group a between plug upper\ngroup b between upper plug\nsymmetry low"
)
STACKED += "body upper E 3000 nu 0\ncontact a b\nmove top 0 0 -0.01\n"


def test_facets_at_a_rim(tmp_path):
    """A pressure that is uniform but for P3's straight elements: they are said, no pressure without bound."""
    summary, _ = run(tmp_path, FLUSH, STACKED, "-order", 3)
    (said,) = [text for text in summary["warnings"] if "the greatest one means nothing" in text]
    assert "straight elements" in said and "-order 2" in said and "without bound" not in said


PIPE = """Point(1) = {{0, 0, 0}}; Macro Sector
q = newl; p = newp;
Point(p) = {{r1, 0, 0}}; Point(p+1) = {{r2, 0, 0}}; Point(p+2) = {{0, r2, 0}}; Point(p+3) = {{0, r1, 0}};
Line(q) = {{p, p+1}}; Circle(q+1) = {{p+1, 1, p+2}}; Line(q+2) = {{p+2, p+3}}; Circle(q+3) = {{p+3, 1, p}};
Transfinite Curve {{q+1}} = n2 + 1; Transfinite Curve {{q+3}} = n1 + 1; Transfinite Curve {{q, q+2}} = 6;
Curve Loop(q) = {{q, q+1, q+2, q+3}}; Plane Surface(q) = {{q}};
e[] = Extrude{{0, 0, 2}} {{Surface{{q}}; Layers{{2}};}}; Return
r1 = 7; r2 = 10.01; n1 = {sides}; n2 = {sides}; Call Sector;
Physical Volume("inner") = {{e[1]}}; Physical Surface("pin") = {{e[3]}};
Physical Surface("mirrors0") = {{q, e[0]}}; Physical Surface("x0") = {{e[4]}}; Physical Surface("y0") = {{e[2]}};
r1 = 10; r2 = 14; n1 = {more}; n2 = {sides}; Call Sector;
Physical Volume("outer") = {{e[1]}}; Physical Surface("bore") = {{e[5]}};
Physical Surface("mirrors1") = {{q, e[0]}}; Physical Surface("x1") = {{e[4]}}; Physical Surface("y1") = {{e[2]}};
Mesh.ElementOrder = {order};
"""
PIPES = "body inner E 1000 nu 0.3\nbody outer E 1000 nu 0.3\ncontact bore pin\n" + "".join(
    f"symmetry {name}{k}\n" for name in ("mirrors", "x", "y") for k in (0, 1)
)


def lame(inner=7.0, radius=10.0, outer=14.0, overlap=0.01, height=2.0):
    """Integral of the pressure over a quarter of the bore, plane strain."""
    pin = radius + overlap
    bends = (pin**2 + inner**2) / (pin**2 - inner**2) + (outer**2 + radius**2) / (outer**2 - radius**2)
    return np.pi / 2 * radius * height * overlap / radius * 1000 / (1 - 0.3**2) / bends


@pytest.mark.parametrize("order, sides, more, most", cases_of([(2, 8, 10, 1e-3)], [(2, 5, 7, 3e-3), (1, 8, 10, 0.05)]))
def test_press_fit(tmp_path, order, sides, more, most):
    """A quarter of two pipes, meshes that do not match."""
    mesh = gmsh(tmp_path, PIPE.format(sides=sides, more=more, order=order))
    summary, _ = run(tmp_path, mesh, PIPES)
    within(summary, "normalForce", lame(), most)


def test_true_distance(tmp_path):
    """Bodies that hardly move: the true distance tells the same."""
    mesh = gmsh(tmp_path, PIPE.format(sides=8, more=10, order=2))
    forces = [run(tmp_path, mesh, PIPES, "-estimate", "0", "-distance", word)[0] for word in ("linear", "exact")]
    linear, exact = (summary["contacts"][0]["normalForce"] for summary in forces)
    assert linear == pytest.approx(exact, rel=1e-3)


def test_straight_when_asked(tmp_path, ball):
    """-surface facets, and P1, leave elements straight."""
    case = ON_PLANE + "weight ball 0 0 -1\n"
    for flags in (["-surface", "facets"], ["-order", "1"]):
        summary, _ = run(tmp_path, ball, case, "-estimate", "0", *flags)
        assert summary["contacts"][0]["normalForce"] < 0.95 * 4 / 3 * np.pi
