"""Twenty shapes that the package has never seen, drawn by gmsh's OpenCASCADE kernel and turned at random.

`mesh(name, folder)` writes <name>.geo, <name>.msh and <name>.case; NAMES are all of them, SPACE those in space.
`python tests/shapes.py FOLDER` writes all. The shapes are described upright, with the load downwards; mesh and case are
then turned together.
"""

import subprocess
import sys
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Shape:
    """geo: bodies and groups, upright; case: lines, <x y> or <x y z> a vector that turns with it; size of elements."""

    geo: str
    case: str
    size: float = 0.5
    space: bool = False


KEPT = """near() = {} In BoundingBox {{{}}};
kept() = {{}};
For k In {{0 : #{name}() - 1}}
For j In {{0 : #near() - 1}}
If ({name}(k) == near(j))
kept() += {name}(k);
EndIf
EndFor
EndFor
{name}() = kept();"""


def groups(space: bool, where: str) -> str:
    """Physical groups, "NAME tags; name body:box/less others; ...": bodies in capitals; a box by its two corners."""
    solid, skin = ("Volume", "Surface") if space else ("Surface", "Curve")
    lines = []
    for entry in where.split(";"):
        name, what = entry.split(maxsplit=1)
        word = name.replace("_", "-")
        if name.isupper():
            lines.append(f'Physical {solid}("{word.lower()}") = {{{what.strip()}}};')
            continue
        body, _, rest = what.strip().partition(":")
        lines.append(f"{name}() = Abs(Boundary{{ {solid}{{{body}}}; }});")
        corners, *without = rest.split("/")
        if corners:
            places = [float(number) for number in corners.split()]
            low, high = places[: 2 + space], places[2 + space :]
            low, high = [x - 0.01 for x in low], [x + 0.01 for x in high]
            box = [*low, *high] if space else [*low, -1, *high, 1]
            lines.append(KEPT.format(skin, ", ".join(map(str, box)), name=name))
        lines += [f"{name}() -= {other}();" for other in without]
        lines.append(f'Physical {skin}("{word}") = {name}();')
    return "\n".join(lines)


def shape(text: str) -> tuple[str, Shape]:
    """A paragraph of data/shapes.txt: name and kind, gmsh's lines, groups, lines of the case."""
    head, *lines = text.strip().split("\n  ")
    name, kind = head.split(", ")
    word = {
        start: [line.removeprefix(start) for line in lines if line.startswith(start)] for start in ("group ", "case ")
    }
    geo = "\n".join(line for line in lines if not line.startswith(tuple(word)))
    space, case = kind == "space", "\n".join(word["case "])
    geo += "\n" + groups(space, "; ".join(word["group "]))
    return name, Shape(geo, case if space else f"state strain\n{case}", 1.0 if space else 0.5, space)


def polygon(body, size, corners, names, first=1):
    """gmsh's geometry of one body: corners "x, y" in turn, names of its sides, from the first corner on.

    first: the number of the first corner, for one body beside others.
    """
    count = len(corners)
    sides = ", ".join(str(first + k) for k in range(count))
    lines = [f"Point({first + k}) = {{{corner}, 0, {size}}};" for k, corner in enumerate(corners)]
    lines += [f"Line({first + k}) = {{{first + k}, {first + (k + 1) % count}}};" for k in range(count)]
    lines += [f"Curve Loop({first}) = {{{sides}}};", f"Plane Surface({first}) = {{{first}}};"]
    lines += [f'Physical Curve("{name}") = {{{first + k - 1}}};' for k, name in names.items()]
    return "\n".join([*lines, f'Physical Surface("{body}") = {{{first}}};\n'])


SHAPES = dict(map(shape, (Path(__file__).parent / "data/shapes.txt").read_text().split("\n\n")))
NAMES = sorted(SHAPES)
SPACE = [name for name in NAMES if SHAPES[name].space]


def turning(name: str, space: bool) -> np.ndarray:
    """A random rotation of the shape's own seed."""
    random = np.random.default_rng(zlib.crc32(name.encode()))
    axis = random.normal(size=3) if space else np.array([0.0, 0, 1])
    x, y, z = axis / np.linalg.norm(axis)
    angle = random.uniform(0.3, 2.8)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew


def write(name: str, folder: Path) -> tuple[Path, Path]:
    """The shape's geometry, upright, and its case file, turned; their paths."""
    shape = SHAPES[name]
    matrix, case = turning(name, shape.space), shape.case
    while "<" in case:
        before, _, rest = case.partition("<")
        text, _, after = rest.partition(">")
        vector = np.array([*map(float, text.split()), 0])[:3]
        case = before + " ".join(f"{value:.15g}" for value in (matrix @ vector)[: len(text.split())]) + after
    geo, file = folder / f"{name}.geo", folder / f"{name}.case"
    geo.write_text(f'SetFactory("OpenCASCADE");\n{shape.geo}\nMesh.MeshSizeMax = {shape.size};\n')
    file.write_text(case + "\n")
    return geo, file


def gmsh(geo: Path, path: Path, dimension: str, matrix: np.ndarray) -> None:
    """A geometry's mesh by gmsh, turned."""
    subprocess.run(["gmsh", dimension, "-v", "1", "-format", "msh22", geo, "-o", path], check=True, timeout=120)
    path.write_text(moved(path.read_text(), matrix))


def moved(text: str, matrix: np.ndarray, scale: float = 1.0) -> str:
    """A mesh file's text, its nodes turned, mirrored, scaled; triangles of a mirrored one are turned round."""
    lines, size = text.splitlines(), len(matrix)
    first, elements = lines.index("$Nodes") + 2, lines.index("$Elements") + 2
    for k in range(first, first + int(lines[first - 1])):
        number, *place = lines[k].split()
        at = scale * matrix @ np.array(place[:size], float)
        lines[k] = " ".join([number, *(f"{value:.17g}" for value in at), *place[size:]])
    for k in range(elements, len(lines) - 1) if np.linalg.det(matrix) < 0 else ():
        words = lines[k].split()
        if words[1] == "2":
            lines[k] = " ".join([*words[:-2], words[-1], words[-2]])
    return "\n".join([*lines, ""])


def mesh(name: str, folder: Path) -> tuple[Path, Path]:
    """The shape's mesh by gmsh, turned, and its case file."""
    geo, case = write(name, folder)
    path, space = geo.with_suffix(".msh"), SHAPES[name].space
    gmsh(geo, path, "-3" if space else "-2", turning(name, space))
    return path, case


if __name__ == "__main__":
    for each in NAMES:
        print(*mesh(each, Path(sys.argv[1])))
