"""An assembly of 18 parts that touch: two plates, two brackets, four bolts with nuts and washers, two pins; 158 faces.

`step(folder)` writes assembly.step with the names of the parts, as a CAD program does; JOINS are 17 statements that
join all of them, CASE a case with them. `python tests/assembly.py FOLDER` writes assembly.step and assembly.case.
"""

import re
import subprocess
import sys
from pathlib import Path

CORNERS = ((15, 25), (15, 55), (105, 25), (105, 55))
DOWELS = ((60, 20), (60, 60))
NAMES = ["Base plate", "Cover", "Bracket L", "Bracket R", *["Bolt M8"] * 4, *["Hex nut"] * 4, *["Washer"] * 4]
NAMES += ["Dowel pin"] * 2


def drilled(number: int, holes, z: float, height: float, radius: float) -> str:
    """Holes along z through a volume."""
    tools = "".join(
        f"Cylinder({900 + k}) = {{{x}, {y}, {z}, 0, 0, {height}, {radius}}};\n" for k, (x, y) in enumerate(holes)
    )
    return f"{tools}BooleanDifference{{ Volume{{{number}}}; Delete; }}{{ Volume{{900:{899 + len(holes)}}}; Delete; }}\n"


def hexagon(number: int, x: float, y: float, z: float, height: float, across: float) -> str:
    """A prism: of its six flats two opposite ones are `across` from each other."""
    boxes = "".join(
        f"Box({950 + k}) = {{{x - across / 2}, {y - across}, {z}, {across}, {2 * across}, {height}}};\n"
        f"Rotate{{ {{0, 0, 1}}, {{{x}, {y}, 0}}, {k}*Pi/3 }}{{ Volume{{{950 + k}}}; }}\n"
        for k in range(3)
    )
    return boxes + (
        "BooleanIntersection(960) = { Volume{950}; Delete; }{ Volume{951}; Delete; };\n"
        f"BooleanIntersection({number}) = {{ Volume{{960}}; Delete; }}{{ Volume{{952}}; Delete; }};\n"
    )


def geo() -> str:
    """The geometry for gmsh, volumes 1 to 18 in the order of NAMES; millimetres."""
    text = 'SetFactory("OpenCASCADE");\n'
    text += "Box(1) = {0, 0, 0, 120, 80, 10};\n"
    for k, (x, y) in enumerate(((0, 0), (120, 0), (120, 80), (0, 80))):  # four corners cut off
        text += f"Box({980 + k}) = {{-6, -6, -1, 12, 12, 12}};\n"
        text += f"Rotate{{ {{0, 0, 1}}, {{0, 0, 0}}, Pi/4 }}{{ Volume{{{980 + k}}}; }}\n"
        text += f"Translate{{ {x}, {y}, 0 }}{{ Volume{{{980 + k}}}; }}\n"
    text += "BooleanDifference{ Volume{1}; Delete; }{ Volume{980:983}; Delete; }\n"
    text += drilled(1, CORNERS, -1, 12, 4.5) + drilled(1, DOWELS, -1, 12, 3)
    text += "Box(2) = {0, 5, 10, 120, 70, 8};\n" + drilled(2, CORNERS, 9, 10, 4.5) + drilled(2, DOWELS, 9, 10, 3)
    for number, x, wall in ((3, 0, 0), (4, 90, 114)):
        text += f"Box(970) = {{{x}, 10, 18, 30, 60, 6}};\nBox(971) = {{{wall}, 10, 24, 6, 60, 36}};\n"
        text += f"BooleanUnion({number}) = {{ Volume{{970}}; Delete; }}{{ Volume{{971}}; Delete; }};\n"
        text += drilled(number, [c for c in CORNERS if x <= c[0] <= x + 30], 17, 8, 4.5)
        text += f"Cylinder(972) = {{{wall - 1}, 40, 45, 8, 0, 0, 7}};\n"
        text += f"BooleanDifference{{ Volume{{{number}}}; Delete; }}{{ Volume{{972}}; Delete; }}\n"
    for k, (x, y) in enumerate(CORNERS):
        text += f"Cylinder(990) = {{{x}, {y}, -10, 0, 0, 36, 4}};\nCone(991) = {{{x}, {y}, -11, 0, 0, 1, 3, 4}};\n"
        text += hexagon(992, x, y, 26, 6, 13)
        text += f"BooleanUnion({5 + k}) = {{ Volume{{990}}; Delete; }}{{ Volume{{991, 992}}; Delete; }};\n"
        text += hexagon(9 + k, x, y, -8, 8, 13) + drilled(9 + k, [(x, y)], -9, 10, 4)
        text += f"Cylinder({13 + k}) = {{{x}, {y}, 24, 0, 0, 2, 8}};\n" + drilled(13 + k, [(x, y)], 23, 4, 4.5)
    for k, (x, y) in enumerate(DOWELS):
        text += f"Cylinder(990) = {{{x}, {y}, 1, 0, 0, 17, 3}};\nCylinder(991) = {{{x}, {y}, 18, 0, 0, 3, 5}};\n"
        text += f"Cone(992) = {{{x}, {y}, 0, 0, 0, 1, 2, 3}};\n"
        text += f"BooleanUnion({17 + k}) = {{ Volume{{990}}; Delete; }}{{ Volume{{991, 992}}; Delete; }};\n"
    return text


def called(kind: str, k: int) -> str:
    """The name in a case file of the k-th part of a kind, from 0."""
    name = f"{kind}-{k + 1}" if k else kind
    return f'"{name}"' if " " in name else name


# the slave first: no face is that of two statements
PAIRS = [("Cover", 0, "Base plate", 0, "contact")]
PAIRS += [(f"Bracket {side}", 0, "Cover", 0, "tie") for side in "LR"]
for K in range(4):
    PAIRS += [("Washer", K, "Bracket L" if K < 2 else "Bracket R", 0, "tie"), ("Bolt M8", K, "Washer", K, "tie")]
    PAIRS += [("Hex nut", K, "Bolt M8", K, "tie")]
PAIRS += [("Dowel pin", K, "Cover", 0, "tie") for K in range(2)]
JOINS = [f"join {called(a, i)} {called(b, j)} {how}" for a, i, b, j, how in PAIRS]
CASE = "\n".join([
    "units mm MPa",
    "body steel E 210e3 nu 0.3",
    *JOINS,
    "group floor plane 0 0 0 0 0 1",
    "group face  plane 0 0 60 0 0 1",
    "size steel 8",
    "clamp floor",
    "traction face 1 0 0",
    "",
])  # fmt: skip


def step(folder: Path) -> Path:
    """assembly.step in a folder."""
    source, file = folder / "assembly.geo", folder / "assembly.step"
    source.write_text(geo())
    subprocess.run(["gmsh", source, "-0", "-v", "2", "-o", file], check=True, capture_output=True)
    left = iter(["Fixture", *NAMES])
    named = re.sub(r"PRODUCT\('[^']*',\s*'[^']*'", lambda _: "PRODUCT('{0}','{0}'".format(next(left)), file.read_text())
    assert next(left, None) is None
    file.write_text(named)
    return file


if __name__ == "__main__":
    FOLDER = Path(sys.argv[1])
    FOLDER.mkdir(parents=True, exist_ok=True)
    (FOLDER / "assembly.case").write_text(CASE)
    print(step(FOLDER))
