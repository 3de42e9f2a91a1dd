"""Do the estimates of the error hold? Runs of the plane's scenes against finer solutions: `make coverage`.

`coverage.csv` in results/coverage/ has a row per run: the numbers and the errors that the run says of them (`..Said`);
the true ones are their distances from the same problem with P4 on a much finer mesh. A number is covered where what is
said is at least what is true. The constants were fitted on the disc's problems alone. Interrupted and started again, it
goes on where it was.
"""

import argparse
import sys
from pathlib import Path

import campaign
import numpy as np
from campaign import case, markdown, value

FOLDER = campaign.RESULTS_FOLDER / "coverage"
QUANTITIES = ("force", "approach", "pressureMax", "halfWidth", "profile", "energy")
PARTS = ("inside", "line", "model", "algebra")
COLUMNS = [f"{name}{kind}" for name in QUANTITIES for kind in ("Value", "Said", "True")]
COLUMNS += [*PARTS, "contactStiffness", "estimateBacksolves", "secondsEstimate", "linearSolve", "warnings"]

HARD = {"law": "signorini"}


def power(kappa: float, m: float = 3) -> dict:
    return {"kappa": kappa, "m": m}


def thin(kappa: float) -> dict:
    """The power law in scenes whose default is hard contact."""
    return {"law": "power", **power(kappa), "d0": -0.01}


# family: scene, its flags, the coarsest h of P4's meshes: P2's is half, P1's a quarter of it; each is twice halved
FAMILIES: dict[str, tuple[str, dict, float]] = {
    "disc": ("disc-on-block", {}, 2.0),
    "waves": ("wavy", {"waves": 4, "u0": 0.8}, 2.0),
    "rough": ("rough", {"modes": 16}, 2.0),
    "punch": ("flat-punch", {}, 2.0),
    "hertz-line": ("hertz-line", {}, 0.4),
    "two-cylinders": ("two-cylinders", {"reach": 1.6, "grading": 40}, 0.4),
    "axisymmetric": ("disc-on-block", {"geometry": "axisymmetric"}, 2.0),
}
PROBLEMS: list[tuple[str, dict]] = [
    *[("disc", power(kappa)) for kappa in (1e-2, 1.0, 1e3, 1e6, 1e9, 1e12, 1e30)],
    *[("disc", power(1e3, m)) for m in (1.05, 2, 10, 20)],
    ("disc", {"law": "exponential", "p0": 0.02, "beta": 60}),
    ("disc", {"law": "barrier", "p0": 1}),
    ("disc", HARD),
    ("disc", {"force": 150}),
    ("disc", {"force": 150, **HARD}),
    ("disc", {"bodyForce": 0.1, "traction": 0.5}),
    ("disc", {"geometry": "stress"}),
    ("disc", {"distance": "exact"}),
    ("disc", {"distance": "exact", **power(1e9)}),
    ("disc", {"offset": 6.3}),
    ("disc", {"method": "paper"}),
    *[("waves", law) for law in (power(1e3), power(1e9), HARD)],
    *[("rough", law) for law in (power(1e3), power(1e9), HARD)],
    *[("punch", law) for law in (power(1e3), power(1e6), HARD)],
    *[("hertz-line", law) for law in (thin(1e6), thin(1e12), {})],
    *[("two-cylinders", law) for law in (thin(1e6), {})],
    *[("axisymmetric", law) for law in (power(1e3), power(1e9), power(1e3, 10), HARD)],
    ("axisymmetric", {"force": 1500}),
]
SPACE: dict[str, tuple[str, dict, float]] = {
    "sphere": ("sphere-on-block", {"layers": 2}, 4.0),
    "ball on a plane": ("sphere-on-plane", {}, 0.4),
    "two balls": ("two-spheres", {}, 0.4),
}
IN_SPACE: list[tuple[str, dict]] = [
    *[("sphere", power(kappa)) for kappa in (1.0, 1e3, 1e6, 1e9, 1e12)],
    *[("sphere", power(1e3, m)) for m in (1.05, 10, 20)],
    ("sphere", {"law": "exponential", "p0": 0.02, "beta": 60}),
    ("sphere", {"law": "barrier", "p0": 1}),
    ("sphere", HARD),
    ("sphere", {"force": 1500}),
    ("ball on a plane", {}),
    ("two balls", {}),
]
FINEST = {"hertz-line": 10, "two-cylinders": 10}  # of the reference: P4's coarsest h over its own; 16 elsewhere


def problem_name(family: str, flags: dict) -> str:
    return " ".join([family, *(f"{flag} {campaign.flag_text(given)}" for flag, given in flags.items())])


def cases(root: Path = campaign.ROOT) -> list[campaign.Case]:
    """The reference of each problem first, then its runs."""
    found = []
    for family, flags in PROBLEMS:
        scene, common, size = FAMILIES[family]
        shared = {**common, **flags, "tol": 1e-8}
        name = problem_name(family, flags)
        fine = {key: word for key, word in shared.items() if key != "method"}
        found.append(case(f"{name}: reference", scene, weight=5, order=4, h=size / FINEST.get(family, 16), **fine))
        for order in (1, 2, 3, 4):
            for halved in range(3):
                found.append(case(name, scene, order=order, h=size * order / 4 / 2**halved, **shared))
    return found


def cases_in_space(root: Path = campaign.ROOT) -> list[campaign.Case]:
    """The same; P2's meshes grow finer by 1.4 each, P1's have half their sizes."""
    found = []
    for family, flags in IN_SPACE:
        scene, common, size = SPACE[family]
        shared = {**common, **flags, "tol": 1e-8}
        name = problem_name(family, flags)
        found.append(case(f"{name}: reference", scene, weight=9, order=2, h=size / 4.5, **shared))
        found += [case(name, scene, order=o, h=size * o / 2 / 1.4**k, **shared) for o in (1, 2) for k in range(3)]
    return found


def profile_path(name: str) -> Path:
    return FOLDER / "profiles" / f"{name.replace(' ', '_')}.csv"


def joined(x: np.ndarray, at: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values at x: of the cubic through the two points of `at` on either side; linear where one of these is open."""
    found = np.interp(x, at, values)
    first = np.searchsorted(at, x) - 2
    inside = (first >= 0) & (first + 3 < len(at))
    four = first[inside, None] + np.arange(4)
    places, of = at[four], values[four]
    cubic = np.zeros(inside.sum())
    for k in range(4):
        other = [j for j in range(4) if j != k]
        ratio = (x[inside, None] - places[:, other]) / (places[:, [k]] - places[:, other])
        cubic += of[:, k] * ratio.prod(axis=1)
    found[inside] = np.where((of > 0).all(axis=1), cubic, found[inside])
    return found


def profile_error(contact: dict, exact: np.ndarray) -> float:
    """Relative difference in L2 of the pressures at a run's points to the finer ones, joined by cubics."""
    expected = joined(contact["x"], exact[:, 0], exact[:, 1])
    root = np.sqrt(contact["weight"])
    return float(np.linalg.norm(root * (contact["pressure"] - expected)) / np.linalg.norm(root * expected))


def measure(*_) -> campaign.Measure:
    """COLUMNS of a run; a reference leaves its profile behind."""

    def gauge(item: campaign.Case, summary: dict, folder: Path) -> dict:
        contact = campaign.read_contact(folder)
        name, _, is_reference = item.name.partition(": ")
        path = profile_path(name)
        found: dict = {}
        if is_reference and "z" not in contact:
            path.parent.mkdir(parents=True, exist_ok=True)
            np.savetxt(path, np.column_stack([contact["x"], contact["pressure"]]))
        elif "z" not in contact:  # a profile is a curve in the plane
            found["profileTrue"] = profile_error(contact, np.loadtxt(path))
        told = summary.get("estimates") or {}
        for quantity in QUANTITIES:
            found[f"{quantity}Value"] = summary.get(quantity)
            found[f"{quantity}Said"] = (told.get(quantity) or {}).get("error")
        for way in [load["way"] for load in told.get("loads", []) if load["way"]]:
            found["approachValue"], found["approachSaid"] = way["value"], way["error"]
        found |= {part: told.get("parts", {}).get(part) for part in PARTS}
        seconds = summary["seconds"]
        contact_seconds = seconds["assembly"] + seconds["factorisation"] + seconds["contact"]
        return found | {
            "contactStiffness": told.get("contactStiffness"),
            "estimateBacksolves": told.get("backsolves"),
            "secondsEstimate": seconds.get("estimate"),
            "linearSolve": contact_seconds / summary["costRatio"],
            "warnings": len(summary["warnings"]),
        }

    return gauge


def judged(rows: list[dict]) -> list[dict]:
    """A row a number: run, quantity, said, true, and what the reference itself is uncertain by."""
    exact = {row["name"].partition(":")[0]: row for row in rows if row["name"].endswith(": reference")}
    found = []
    for row in rows:
        if row["name"].endswith(": reference") or row["name"] not in exact or row["status"] != "converged":
            continue
        for quantity in QUANTITIES:
            said = value(row, f"{quantity}Said")
            if not np.isfinite(said) or row[f"{quantity}{'True' if quantity == 'profile' else 'Value'}"] == "":
                continue
            fine = exact[row["name"]]
            if quantity == "profile":
                true, doubt = value(row, "profileTrue"), value(fine, "profileSaid")
            else:
                true = abs(value(row, f"{quantity}Value") - value(fine, f"{quantity}Value"))
                doubt = value(fine, f"{quantity}Said")
            # what is prescribed, or told by the balance, has no error
            least = 1e-10 * np.nan_to_num(abs(value(row, f"{quantity}Value")))
            if said > least and np.isfinite(true):
                found.append({"row": row, "quantity": quantity, "said": said, "true": true, "doubt": doubt})
    return found


def table(numbers: list[dict]) -> str:
    """Coverage and ratios by quantity and order; of all, and apart on the disc, on which constants were fitted."""
    lines = []
    for quantity in QUANTITIES:
        for order in ("1", "2", "3", "4"):
            these = [n for n in numbers if n["quantity"] == quantity and n["row"]["order"] == order]
            if these:
                lines.append([quantity, f"P{order}", *statistics(these)])
    fitted = [n for n in numbers if n["row"]["name"].startswith("disc ")]
    others = [n for n in numbers if n not in fitted]
    groups = {"all": numbers} | ({"all of the disc": fitted, "all of the others": others} if fitted and others else {})
    lines += [[name, "", *statistics(these)] for name, these in groups.items()]
    return markdown(["number", "element", "runs", "covered", "median ratio", "90 % of ratios below"], lines)


def statistics(numbers: list[dict]) -> list[str]:
    said = np.array([n["said"] for n in numbers])
    true = np.array([n["true"] for n in numbers])
    ratio = said / np.maximum(true, 1e-300)
    share = f"{100 * np.mean(ratio >= 1):.1f} %"
    return [str(len(numbers)), share, f"{np.median(ratio):.2g}", f"{np.quantile(ratio, 0.9):.2g}"]


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", nargs="?", default="", help="only problems whose name has this text")
    arguments = parser.parse_args(argv)
    for name, part in ("coverage", cases), ("space", cases_in_space):
        wanted = [item for item in part() if arguments.part in item.name]
        if wanted:
            rows = campaign.run(wanted, FOLDER / f"{name}.csv", columns=COLUMNS, measure=measure)
            print(table(judged(rows)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
