"""The results of a case as on screen: of each contact, load, support and body, with errors and units."""

from collections.abc import Iterator
from typing import TypeGuard

from postprocess.formatting import Units
from postprocess.results import is_number, one_line

# numbers of the whole, which a case with several contacts does not have, or about the origin
WHOLE = set(
    "force approach pressureMax halfWidth halfWidthMoment contactMoment reactionX reactionY reactionZ reactionMoment "
    "masterForceX masterForceY masterForceZ masterMoment".split()
)


def is_case(summary: dict) -> bool:
    """Whether the run is one of a mesh and a case file, not of a built-in problem."""
    return summary.get("scene") in ("parts", "parts-3d") and isinstance(summary.get("bodies"), list)


def case_results(summary: dict) -> dict[str, tuple[object, object, str]]:
    """By its words each number, or the parts of each force, its error or None, and its unit."""
    units = Units(summary)
    return {
        one_line(words): (value, error, unit)
        for source in (contact_results, load_results, support_results, body_results)
        for words, value, error, unit in source(summary, units)
        if is_number(value) or is_vector(value)
    }


def is_vector(value: object) -> TypeGuard[list[float]]:
    return isinstance(value, list) and len(value) > 0 and all(map(is_number, value))


def objects_of_list(holder: object, key: str) -> list[dict]:
    """The objects of a list that a file may not have."""
    found = holder.get(key) if isinstance(holder, dict) else None
    return [each for each in found if isinstance(each, dict)] if isinstance(found, list) else []


def error_of(estimates: dict, key: str) -> object:
    known = estimates.get(key)
    return known.get("error") if isinstance(known, dict) else None


def contact_results(summary: dict, units: Units) -> Iterator[tuple]:
    estimates = objects_of_list(summary.get("estimates"), "contacts")
    area = f"{units.length}²" if units.length else ""
    for index, each in enumerate(objects_of_list(summary, "contacts")):
        errors = estimates[index] if index < len(estimates) else {}
        for words, key, unit in (
            ("resultant force", "force", units.force),
            ("normal force", "normalForce", units.force),
            ("greatest pressure", "pressureMax", units.stress),
            ("contact length", "contactLength", units.length),
            ("contact area", "area", area),
            ("shear force", "shearForce", units.force),
            ("points in contact", "contactPoints", ""),
        ):
            yield f"{each.get('name')}: {words}", each.get(key), error_of(errors, key), unit


def load_results(summary: dict, units: Units) -> Iterator[tuple]:
    for each in objects_of_list(summary, "prescribed"):
        for key, unit in (("force", units.force), ("moment", units.moment)):
            yield f"{each.get('name')}: {key}", each.get(key), each.get("error"), unit
    errors = {each.get("name"): error_of(each, "way") for each in objects_of_list(summary.get("estimates"), "loads")}
    for each in objects_of_list(summary, "ways"):
        name = str(each.get("name"))
        turns = name.startswith("moment ")
        word = "turns" if turns else "move" if name == "all loads" else "moves"
        yield f"{name} {word}", each.get("way"), errors.get(name), "rad" if turns else units.length
    for each in objects_of_list(summary, "preloads"):
        yield f"preload {each.get('name')}", each.get("force"), each.get("error"), units.force


def support_results(summary: dict, units: Units) -> Iterator[tuple]:
    for each in objects_of_list(summary, "supports"):
        yield f"{each.get('name')} carries", each.get("force"), None, units.force
    for each in objects_of_list(summary, "guides"):
        if each.get("carries"):
            yield f"guide of {each.get('name')} carries", each.get("force"), None, units.force
    for each in objects_of_list(summary, "moments"):
        if each.get("printed"):
            words = f"moment of {each.get('name')} on {each.get('body')}"
            moment = each.get("moment")
            yield (
                words,
                moment[0] if isinstance(moment, list) and len(moment) == 1 else moment,
                each.get("error"),
                units.moment,
            )


def body_results(summary: dict, units: Units) -> Iterator[tuple]:
    for each in objects_of_list(summary, "stresses"):
        yield f"greatest von Mises of {each.get('body')}", each.get("vonMises"), each.get("error"), units.stress
