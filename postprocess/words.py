"""A run in words, as numbers of a table, and as the command that makes it again."""

import os
import shlex
from pathlib import Path

from postprocess.results import Run, is_number

ROOT = Path(__file__).resolve().parent.parent

# Defaults of flags, which need not stand in a command; the tests compare them with what -help prints.
DEFAULTS = {
    **{"E": 100, "nu": 0.3, "width": 40, "depth": 20, "gap": 0.5, "u0": 2.5, "force": 0, "geometry": "strain"},
    **{"bodyForce": 0, "traction": 0, "grading": 20, "aspect": 1, "R": 10, "offset": 0, "distance": "linear"},
    **{"reach": 0, "Eratio": 1e6, "law": "power", "d0": -0.25, "p0": 0.02, "kappa": 1e3, "m": 3, "beta": 60},
    **{"table": "none", "rho": 100, "forcing": 0.001, "eps": 1e-4, "tol": 1e-6, "maxNewton": 200},
    **{"maxAdaptations": 50, "history": 0, "steps": 20, "order": 1, "h": 0.25, "states": 0, "vtu": 1, "axis": 0},
}
# Scenes whose own defaults of some of these differ: there the flags are always written out.
OTHERWISE = {
    "confined-block": "width",
    "hertz-line": "law d0 force reach h gap grading",
    "patch-test": "width gap u0 h Eratio law d0",
    "patch-test-3d": "width gap u0 h Eratio law d0",
    "rough": "u0 h",
    "sphere-on-block": "gap u0 h grading law d0 force width depth",
    "sphere-on-plane": "gap u0 force grading law d0 h",
    "two-bodies": "gap u0 law d0 h",
    "two-cylinders": "gap u0 force reach grading law d0 h",
    "two-spheres": "gap u0 force grading law d0 h",
}
LABS = "labs/"  # every lab has defaults of its own: all its flags are written out
# What a method takes from its own defaults.
BY_METHOD = {
    "xnewton": {
        "T0": "auto",
        "threshold": "uniform",
        "inner": "proximal",
        "start": "kernel",
        "preconditioner": "kernel",
    },
    "": {"T0": "0", "threshold": "pointwise", "inner": "newton", "start": "none", "preconditioner": "none"},
}

HISTORY_COLUMNS = (
    "Newton step,adaptation,residual,in contact,status changes,at the wall,greatest overlap,force,back-substitutions"
).split(",")


def run_words(run: Run) -> str:
    """Scene, method and discretisation."""
    summary = run.summary
    return f"{summary['scene']}, {summary['method']}, P{summary['order']}, h = {short(summary['h'])}"


def short(value: object, digits: int = 6) -> str:
    """A number with so many digits; a dash for what is not defined."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.{digits}g}" if isinstance(value, float) else str(value)


def history_rows(run: Run) -> list[list[str]]:
    """A row of text per Newton step, HISTORY_COLUMNS."""
    history = run.history
    names = "newton adaptation residual contactPoints statusChanges wallPoints overlapMax force backsolves".split()
    rows = zip(*(history[name].tolist() for name in names), strict=True)
    return [
        [f"{value:.2e}" if name == "residual" else short(value) for name, value in zip(names, row, strict=True)]
        for row in rows
    ]


def script(scene: str, method: str = "") -> str:
    """The file of a scene, relative to the repository's root."""
    if scene == "disc-on-block":
        return "edp/scenes/disc-on-block-ipopt.edp" if method == "ipopt" else "edp/main.edp"
    if scene.startswith(LABS):
        return f"edp/{scene}/{scene.partition('-')[2]}.edp"
    return f"edp/scenes/{scene}.edp"


def command(run: Run) -> str:
    """The command, from the repository's root, that makes the run again: its flags other than the defaults."""
    scene, method = run.summary["scene"], run.summary["method"]
    words = ["FreeFem++", "-nw", "-v", "0", script(scene, method), "-method", method]
    always = OTHERWISE.get(scene, "").split()
    defaults = {} if scene.startswith(LABS) else {**DEFAULTS, **BY_METHOD.get(method, BY_METHOD[""])}
    for name, value in run.summary["parameters"].items():
        if name in ("method", "out") or (name not in always and name in defaults and same(value, defaults[name])):
            continue
        words += [f"-{name}", flag_text(value)]
    return shlex.join([*words, "-out", place(run.path)])


def same(value: object, default: object) -> bool:
    if is_number(value) and is_number(default):
        return float(value) == float(default)
    return str(value) == str(default)


def flag_text(value: object) -> str:
    """A flag's value as the command line takes it."""
    if is_number(value) and float(f"{value:g}") == value:
        return f"{value:g}"
    return repr(value) if isinstance(value, float) else str(value)


def place(path: Path | str) -> str:
    """A path relative to the repository's root where it lies in it."""
    full = Path(os.path.abspath(path))
    return str(full.relative_to(ROOT)) if full.is_relative_to(ROOT) else str(path)
