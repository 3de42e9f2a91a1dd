"""print a run's summary as a table

DIR is a run's result folder. A dash stands for a value that the run does not define. Of a case the results are those
of each contact, load, support and body, with units; further lists are in summary.json.
"""

import argparse

from postprocess import case_report
from postprocess.results import is_number, read_run

GROUPS = {
    "run": "scene method converged message warnings".split(),
    "cost": "adaptations newton newtonPerAdaptation kernelNewton factorisations backsolves costRatio".split(),
    "contact": "force approach pressureMax overlapMax halfWidth halfWidthMoment contactPoints wallPoints".split(),
    "balance": "reactionX reactionY reactionMoment contactMoment".split(),
    "accuracy": "residual modelError energy".split(),
    "mesh": "points ndof order h".split(),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="DIR", help="a run's result folder")


def run(arguments: argparse.Namespace) -> None:
    """Prints the table on stdout."""
    print("\n".join(table(read_run(arguments.folder).summary)))


def table(summary: dict) -> list[str]:
    """The lines of the table: names left, values from one common column on, a blank line between groups."""
    case = case_report.is_case(summary)
    values = {key: with_error(summary, key) for key in summary if not case or key not in case_report.WHOLE}
    groups = {title: {key: values[key] for key in keys if key in values} for title, keys in GROUPS.items()}
    listed = {key for keys in GROUPS.values() for key in keys} | {"seconds", "parameters"}
    if case:
        run = {"run": groups.pop("run")}
        groups = (
            run
            | {"results": {words: number(*found) for words, found in case_report.case_results(summary).items()}}
            | groups
        )
    further = {key: summary[key] for key in values if key not in listed}
    groups["further"] = {key: value for key, value in further.items() if not case or not is_nested(value)}
    groups["seconds"] = summary["seconds"]
    groups["parameters"] = summary["parameters"]
    groups = {title: group for title, group in groups.items() if group}
    title_width = max(map(len, groups)) + 2
    name_width = max(len(name) for group in groups.values() for name in group) + 2
    lines = []
    for title, group in groups.items():
        row = 0
        for name, value in group.items():
            # a warning a line: each is a sentence
            for text in (
                map(value_text, value)
                if name == "warnings" and isinstance(value, list) and value
                else [value_text(value)]
            ):
                lines.append(f"{title if row == 0 else '':<{title_width}}{name:<{name_width}}{text}")
                row += 1
        lines.append("")
    return lines[:-1]


def with_error(summary: dict, name: str) -> object:
    """A number with what the run says of its error, where it says so; any other value as it is."""
    estimate = (summary.get("estimates") or {}).get(name)
    error = estimate.get("error") if isinstance(estimate, dict) else None
    return f"{value_text(summary[name])} ± {error:.2g}" if error else summary[name]


def number(value: object, error: object, unit: str) -> str:
    """A number, or the parts of a force, with its error and its unit."""
    text = f"({', '.join(map(value_text, value))})" if isinstance(value, list) else value_text(value)
    text += f" ± {error:.2g}" if is_number(error) and error > 0 else ""
    return f"{text} {unit}".rstrip()


def is_nested(value: object) -> bool:
    """Objects, and lists of them, which would stand in a line as in the file; and the names of what a run has read."""
    return isinstance(value, dict) or (isinstance(value, list) and (len(value) > 6 or any(map(is_nested, value))))


def value_text(value: object) -> str:
    """One value as text: numbers short, lists with spaces, null as a dash."""
    if value is None or value == "":
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.8g}"
    if isinstance(value, list):
        return " ".join(map(value_text, value)) or "-"
    if isinstance(value, dict):
        return ", ".join(f"{name} {value_text(inner)}" for name, inner in value.items()) or "-"
    return str(value)
