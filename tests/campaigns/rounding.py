"""Do errors by rounding stay inside their ±? Random cases with stiffness ratios to 1e15 whose results are known.

Kinds of cases:
  column   a soft block with a stiff one grown onto it, pressed by an obstacle's motion or force
  blocks   the same as two bodies, the stiff one free, held by contact only
  spring   a block on springs
  rubber   nu near 0.5, between a plane and an obstacle, free sides
  lever    a stiff arm on a soft foot, pressed at its end: against the same with the ratio 1e7

    .venv/bin/python tests/campaigns/rounding.py 200

prints a line for each number that is off by more than its ± without a warning, and the counts. Exit code 1 if there is
one, or a warning below a ratio of 1e9.
"""

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
KINDS = ("column", "blocks", "spring", "rubber", "lever")


def rectangle(number, left, bottom, right, top, size, names):
    """A rectangle of gmsh's, and its sides' names: bottom, right, top, left."""
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    p = 100 * number
    lines = [f"Point({p + i})={{{x!r},{y!r},0,{size!r}}};" for i, (x, y) in enumerate(corners, 1)]
    lines += [f"Line({p + i})={{{p + i},{p + i % 4 + 1}}};" for i in range(1, 5)]
    lines += [f"Curve Loop({number})={{{p + 1},{p + 2},{p + 3},{p + 4}}};Plane Surface({number})={{{number}}};"]
    lines += [f'Physical Curve("{name}")={{{p + i}}};' for i, name in enumerate(names, 1) if name]
    return lines


def stacked(size, lower, upper, width):
    """Two rectangles that share a side."""
    lines = ['SetFactory("OpenCASCADE");']
    lines += [f"Rectangle(1)={{0,0,0,{width!r},{lower!r}}};Rectangle(2)={{0,{lower!r},0,{width!r},{upper!r}}};"]
    lines += ["BooleanFragments{Surface{1};Delete;}{Surface{2};Delete;}", "e=1e-4;"]
    lines += ['Physical Surface("soft")={1};Physical Surface("stiff")={2};']
    whole = lower + upper
    for name, box in {
        "left": (0, 0, 0, whole),
        "right": (width, 0, width, whole),
        "base": (0, 0, width, 0),
        "top": (0, whole, width, whole),
    }.items():
        a, b, c, d = box
        lines.append(f'Physical Curve("{name}")=Curve In BoundingBox{{{a}-e,{b}-e,-e,{c}+e,{d}+e,e}};')
    return [*lines, f"Mesh.MeshSizeMax={size!r};"]


def drawn(draw, kind):
    """A case: geometry, statements, flags, ratio, and the truth: normal force, the way of its obstacle or None."""
    ratio, young, moved = (float(10**exponent) for exponent in draw.uniform((2, -3, -5), (15, 6, -2)))
    nu, other = draw.uniform(0, 0.45, 2).tolist()
    lower, upper, width = draw.uniform(0.5, 2, 3).tolist()
    size = float(draw.uniform(0.2, 0.5)) * width
    order = int(draw.choice([1, 2, 2, 3, 4]))
    state = str(draw.choice(["strain", "strain", "stress", "axisymmetric"]))
    pressed = bool(draw.integers(2))
    flags = ["-order", order]
    area = float(np.pi) * width**2 if state == "axisymmetric" else width

    def modulus(E, v):
        return E / (1 - v**2) if state == "stress" else E * (1 - v) / ((1 + v) * (1 - 2 * v))

    def end(top, stiffness):
        load = moved * stiffness
        text = f"obstacle top plane 0 {top!r} 0 -1 " + (f"force 0 {-load!r}" if pressed else f"move 0 {-moved!r}")
        return text, load, moved if pressed else None

    head = [f"state {state}"]
    sides = ["symmetry right"] + ["symmetry left"] * (state != "axisymmetric")
    if kind == "column":
        geo = stacked(size, lower, upper, width)
        M, N = modulus(young, nu), modulus(young * ratio, other)
        text, force, way = end(lower + upper, area / (lower / M + upper / N))
        case = [
            f"body soft E {young!r} nu {nu!r}",
            f"body stiff E {young * ratio!r} nu {other!r}",
            *sides,
            "symmetry base",
            text,
        ]
    if kind == "blocks":
        geo = rectangle(1, 0.0, 0.0, width, lower, size, ["base", "rightA", "seat", "leftA"])
        geo += rectangle(2, 0.0, lower, width, lower + upper, 0.9 * size, ["under", "rightB", "top", "leftB"])
        geo += ['Physical Surface("soft")={1};Physical Surface("stiff")={2};']
        M, N = modulus(young, nu), modulus(young * ratio, other)
        text, force, way = end(lower + upper, area / (lower / M + upper / N))
        sides = [side + body for side in sides for body in "AB"]
        case = [
            f"body soft E {young!r} nu {nu!r}",
            f"body stiff E {young * ratio!r} nu {other!r}",
            *sides,
            "symmetry base",
        ]
        case += ["contact seat under", text]
    if kind == "spring":
        geo = rectangle(1, 0.0, 0.0, width, lower, size, ["base", "right", "top", "left"])
        geo += ['Physical Surface("block")={1};']
        E = young * ratio
        k = young * area / lower
        text, force, way = end(lower, 1 / (1 / k + lower / (modulus(E, nu) * area)))
        case = [
            f"body block E {E!r} nu {nu!r}",
            *sides,
            f"spring base {0 if state == 'axisymmetric' else k!r} {k!r}",
            text,
        ]
    if kind == "rubber":
        nu = 0.5 - min(1 / ratio, 0.05)
        state = "strain"
        head = ["state strain"]
        area = width
        geo = rectangle(1, 0.0, 0.0, width, lower, size, ["base", "right", "top", "left"])
        geo += ['Physical Surface("block")={1};']
        text, force, way = end(lower, young / (1 - nu**2) * area / lower)
        case = [f"body block E {young!r} nu {nu!r}", "symmetry left", "symmetry base", text]
    if kind == "lever":
        state = "strain"
        head = ["state strain"]
        geo = stacked(size, lower, upper, width)
        force, way = 1e-3 * young, None
        case = [f"body soft E {young!r} nu {nu!r}", "body stiff E {stiff} nu " + repr(other), "clamp base"]
        radius = 0.5 * width
        case += [f"obstacle top circle {0.8 * width!r} {lower + upper + radius!r} {radius!r} force 0 {-force!r}"]
        case = [line.replace("{stiff}", repr(young * ratio)) for line in case]
    return geo, [*head, *case], flags, ratio, force, way, young


def solved(folder, geo, case, flags):
    folder.mkdir(exist_ok=True)
    (folder / "a.geo").write_text("\n".join(geo) + "\n")
    (folder / "a.case").write_text("\n".join(case) + "\n")
    words = [
        "FreeFem++",
        "-nw",
        "-v",
        "0",
        ROOT / "edp/parts.edp",
        "-mesh",
        folder / "a.geo",
        "-case",
        folder / "a.case",
    ]
    words += ["-vtu", 0, *flags, "-out", folder / "out"]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=600)
    file = folder / "out/summary.json"
    try:
        return done, json.loads(file.read_text())
    except (OSError, ValueError) as error:
        return done, {"warnings": [], "message": f"no summary: {error}"}


def checks(summary, force, way):
    """Numbers with error and truth: name, value, ±, truth."""
    found = summary["estimates"]
    for contact in found["contacts"]:
        told = contact["normalForce"]
        if told is not None:
            yield "normal force", told["value"], told["error"], force
    if way is not None and found["loads"]:
        (told,) = (load["way"] for load in found["loads"])
        if told is not None:
            yield "way", told["value"], told["error"], way


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int, nargs="?", default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", nargs="+", default=KINDS)
    chosen = parser.parse_args()
    counts = {"inside": 0, "warned": 0, "stopped": 0, "outside": 0, "alarm below 1e9": 0, "refused": 0}
    worst = {}
    for number in range(chosen.count):
        draw = np.random.default_rng([chosen.seed, number])
        kind = chosen.kinds[number % len(chosen.kinds)]
        geo, case, flags, ratio, force, way, young = drawn(draw, kind)
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            done, summary = solved(folder / "one", geo, case, flags)
            about = f"{number} {kind} {' '.join(map(str, flags))} ratio {ratio:.1e} {case[0]}"
            rounded = any("rounding" in text for text in [*summary["warnings"], summary["message"]])
            if done.returncode == 20 and rounded:
                counts["stopped"] += 1
                counts["alarm below 1e9"] += ratio < 1e9
                print(about, "stopped:", summary["message"][:90], flush=True)
                continue
            if done.returncode or "estimates" not in summary:
                counts["refused"] += 1
                print(about, f"code {done.returncode}:", done.stdout[-300:], summary["message"], flush=True)
                continue
            if kind == "lever" and ratio > 1e7:
                # what is left of the arm's own strains falls with the ratio
                other = [line.replace(repr(young * ratio), repr(young * 1e7)) for line in case]
                way = solved(folder / "two", geo, other, flags)[1]["estimates"]["loads"][0]["way"]["value"]
            if not list(checks(summary, force, way)):
                print(about, "no estimates:", summary["notEstimated"], summary["warnings"], flush=True)
            off = [
                (name, value, error, truth)
                for name, value, error, truth in checks(summary, force, way)
                if not abs(value - truth) <= error + (1e-6 * abs(truth) if kind == "lever" else 1e-12 * abs(truth))
            ]
            for _, value, _, truth in checks(summary, force, way):
                decade = int(np.log10(ratio)) // 3 * 3
                worst[decade] = max(worst.get(decade, 0), abs(value / truth - 1))
            counts["alarm below 1e9"] += rounded and ratio < 1e9
            counts["warned"] += rounded
            counts["outside"] += bool(off) and not rounded
            counts["inside"] += not off
            for name, value, error, truth in off:
                print(
                    about,
                    f"{name} {value!r} ± {error:.2g}, right {truth!r}, off {abs(value - truth):.2g}",
                    rounded,
                    flush=True,
                )
    print(counts)
    print("greatest relative error by ratio:", {f"1e{k}": f"{v:.1e}" for k, v in sorted(worst.items())})
    return counts["outside"] + counts["alarm below 1e9"] > 0


if __name__ == "__main__":
    raise SystemExit(main())
