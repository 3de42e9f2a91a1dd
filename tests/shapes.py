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

STEEL = "E 210e3 nu 0.3"


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
            box = [
                *(x - 0.01 for x in low),
                *([] if space else [-1]),
                *(x + 0.01 for x in high),
                *([] if space else [1]),
            ]
            lines.append(KEPT.format(skin, ", ".join(map(str, box)), name=name))
        lines += [f"{name}() -= {other}();" for other in without]
        lines.append(f'Physical {skin}("{word}") = {name}();')
    return "\n".join(lines)


def plane(geo: str, case: str, where: str, size: float = 0.5) -> Shape:
    return Shape(f"{geo}\n{groups(False, where)}", f"state strain\n{case}", size)


def solid(geo: str, case: str, where: str, size: float = 1.0) -> Shape:
    return Shape(f"{geo}\n{groups(True, where)}", case, size, True)


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


BLOCK = "Rectangle(1) = {-10, -8, 0, 20, 8};"
ON_BLOCK = "LOWER 1; UPPER 2; base 1:-10 -8 10 -8; top 1:-10 0 10 0; "
TWO = f"body lower {STEEL}\nbody upper {STEEL}\nclamp base\n"
SLAB = "Box(1) = {-8, -8, -6, 16, 16, 6};"
ON_SLAB = "LOWER 1; UPPER 2; base 1:-8 -8 -6 8 8 -6; top 1:-8 -8 0 8 8 0; "


def on_block(geo: str, skin: str = "round") -> Shape:
    """A body that rests on the block by its weight."""
    return plane(f"{BLOCK} {geo}", TWO + f"contact top {skin}\nweight upper <0 -20>", ON_BLOCK + f"{skin} 2")


def on_slab(geo: str, skin: str = "round") -> Shape:
    return solid(f"{SLAB} {geo}", TWO + f"contact top {skin}\nweight upper <0 0 -20>", ON_SLAB + f"{skin} 2")


SHAPES = {
    "disc": on_block("Disk(2) = {0, 5, 0, 5};"),
    "ellipse": on_block("Disk(2) = {0, 3, 0, 6, 3};"),
    "cushion": on_block("Rectangle(2) = {-4, 0, 0, 8, 6, 1.5};", "shell"),
    "pin": plane(
        "Rectangle(1) = {-10, -10, 0, 20, 20}; Disk(3) = {0, 0, 0, 4.1};\n"
        "BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{3}; Delete; }; Disk(2) = {0, 0, 0, 4};",
        TWO + "contact bore round\nweight upper <0 -20>",
        "LOWER 4; UPPER 2; base 4:-10 -10 10 -10; bore 4:-4.1 -4.1 4.1 4.1; round 2",
    ),
    "groove": plane(
        "Rectangle(1) = {-10, -8, 0, 20, 8}; Disk(3) = {0, 2, 0, 5};\n"
        "BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{3}; Delete; }; Disk(2) = {0, 2, 0, 4.9};",
        TWO + "contact groove round\nweight upper <0 -20>",
        "LOWER 4; UPPER 2; base 4:-10 -8 10 -8; groove 4:-5 -3 5 0; round 2",
    ),
    "ring": plane(
        "Disk(1) = {0, 0, 0, 10}; Disk(3) = {0, 0, 0, 5}; \n"
        "BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{3}; Delete; };\n"
        "Disk(5) = {0, -0.9, 0, 4.1}; Disk(6) = {0, -0.9, 0, 2};\n"
        "BooleanDifference(2) = { Surface{5}; Delete; }{ Surface{6}; Delete; };",
        TWO + "contact bore outside\nweight upper <0 -20>",
        "LOWER 4; UPPER 2; bore 4:-5 -5 5 5; base 4:/bore; eye 2:-2 -2.9 2 1.1; outside 2:/eye",
    ),
    "stack": plane(
        f"{BLOCK} Disk(2) = {{0, 4, 0, 4}}; Rectangle(3) = {{-9, 8, 0, 18, 4}};",
        f"{TWO}body lid {STEEL}\ncontact top round\ncontact round under\nforce grip <0 -200>",
        ON_BLOCK + "LID 3; round 2; under 3:-9 8 9 8; grip 3:-9 12 9 12",
    ),
    "teeth": plane(
        "Rectangle(1) = {-10, -8, 0, 20, 8}; Rectangle(5) = {-8, -1, 0, 3, 4}; Rectangle(6) = {-1.5, -1, 0, 3, 4};\n"
        "Rectangle(7) = {5, -1, 0, 3, 4}; BooleanUnion(4) = { Surface{1}; Delete; }{ Surface{5, 6, 7}; Delete; };\n"
        "Rectangle(2) = {-12, 3, 0, 24, 5};",
        TWO + "contact tips under law power kappa 1e8 m 2 d0 -0.01\nmove grip <0 -0.02>",
        "LOWER 4; UPPER 2; base 4:-10 -8 10 -8; tips 4:-8 3 8 3; under 2:-12 3 12 3; grip 2:-12 8 12 8",
    ),
    "fork": plane(
        "Rectangle(1) = {-8, -8, 0, 16, 18}; Rectangle(5) = {-4, 0, 0, 8, 11}; Disk(6) = {0, 0, 0, 4};\n"
        "BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{5, 6}; Delete; }; Disk(2) = {0, 0, 0, 3.95};",
        TWO + "contact cradle round\nweight upper <0 -20>",
        "LOWER 4; UPPER 2; base 4:-8 -8 8 -8; cradle 4:-4 -4 4 9.9; round 2",
    ),
    "stamp": plane(
        BLOCK,
        f"body lower {STEEL}\nclamp base\nobstacle top circle <0 30> R 30 force <0 -400>",
        "LOWER 1; base 1:-10 -8 10 -8; top 1:-10 0 10 0",
    ),
    "ball": on_slab("Sphere(2) = {0, 0, 4, 4};"),
    "log": on_slab("Cylinder(2) = {-5, 0, 3, 10, 0, 0, 3};", "shell"),
    "socket": solid(
        f"{SLAB} Sphere(3) = {{0, 0, 2, 5}};\n"
        "BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{3}; Delete; };\n"
        "Sphere(2) = {0, 0, 2, 4.8};",
        TWO + "contact cup round\nweight upper <0 0 -20>",
        "LOWER 4; UPPER 2; base 4:-8 -8 -6 8 8 -6; cup 4:-5 -5 -3 5 5 0; round 2",
    ),
    "axle": solid(
        "Box(1) = {-8, -4, -8, 16, 8, 16}; Cylinder(3) = {0, -5, 0, 0, 10, 0, 4.1};\n"
        "BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{3}; Delete; }; Cylinder(2) = {0, -6, 0, 0, 12, 0, 4};",
        TWO + "contact bore shell\nsymmetry left\nweight upper <0 0 -20>",
        "LOWER 4; UPPER 2; base 4:-8 -4 -8 8 4 -8; bore 4:-4.1 -4 -4.1 4.1 4 4.1; "
        "left 2:-4 -6 -4 4 -6 4; shell 2:/left",
    ),
    "torus": on_slab("Torus(2) = {0, 0, 1.5, 4, 1.5};"),
    "cone": solid(
        f"{SLAB} Cone(2) = {{0, 0, 0, 0, 0, 6, 1.5, 4}};",
        TWO + "contact top shell law power kappa 1e8 m 2 d0 -0.01\nmove lid <0 0 -0.01>",
        ON_SLAB + "lid 2:-4 -4 6 4 4 6; shell 2:/lid",
    ),
    "cross": solid(
        "Cylinder(1) = {-8, 0, -4, 16, 0, 0, 4}; Cylinder(2) = {0, -8, 3, 0, 16, 0, 3};",
        f"body lower {STEEL}\nbody upper {STEEL}\nclamp ends\ncontact under over\nforce caps <0 0 -400>",
        "LOWER 1; UPPER 2; ends 1:-8 -4 -8 -8 4 0; under 1:/ends; caps 2:-3 8 0 3 8 6; over 2:/caps",
    ),
    "pillow": on_slab(
        "Box(2) = {-3, -3, 0, 6, 6, 5}; \n"
        "b() = Curve In BoundingBox {-3.1, -3.1, -0.1, 3.1, 3.1, 0.1}; Fillet{2}{b()}{1.2}",
        "shell",
    ),
    "plate": solid(
        SLAB,
        f"body lower {STEEL}\nclamp base\nobstacle top sphere <0 0 20> R 20 move <0 0 -0.05>",
        "LOWER 1; base 1:-8 -8 -6 8 8 -6; top 1:-8 -8 0 8 8 0",
    ),
    "egg": solid(
        f"{SLAB} Sphere(2) = {{0, 0, 3, 3}}; Dilate {{{{0, 0, 3}}, {{1.5, 1.2, 1}}}} {{ Volume{{2}}; }}\n"
        "Box(3) = {-8, -8, 6, 16, 16, 4};",
        f"{TWO}body lid {STEEL}\ncontact top round\ncontact round under\nforce grip <0 0 -400>",
        ON_SLAB + "LID 3; round 2; under 3:-8 -8 6 8 8 6; grip 3:-8 -8 10 8 8 10",
    ),
}
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
