"""The results of a case as on screen: of each contact, load, support and body, with errors and units."""

from collections.abc import Iterator
from typing import TypeGuard

from postprocess.formatting import Units
from postprocess.results import brief, is_number

# numbers of the whole, which a case with several contacts does not have, or about the origin
WHOLE = set(
    "force approach pressureMax halfWidth halfWidthMoment contactMoment reactionX reactionY reactionZ reactionMoment "
    "masterForceX masterForceY masterForceZ masterMoment".split()
)


def is_case(summary: dict) -> bool:
    """Whether the run is one of a mesh and a case file, not of a built-in problem."""
    return summary.get("scene") in ("parts", "parts-3d") and isinstance(summary.get("bodies"), list)


def results(summary: dict) -> dict[str, tuple[object, object, str]]:
    """By its words each number, or the parts of each force, its error or None, and its unit."""
    units = Units(summary)
    return {
        brief(words): (value, error, unit)
        for source in (of_contacts, of_loads, of_supports, of_bodies)
        for words, value, error, unit in source(summary, units)
        if is_number(value) or is_vector(value)
    }


def is_vector(value: object) -> TypeGuard[list[float]]:
    return isinstance(value, list) and len(value) > 0 and all(map(is_number, value))


def entries(holder: object, key: str) -> list[dict]:
    """The objects of a list that a file may not have."""
    found = holder.get(key) if isinstance(holder, dict) else None
    return [each for each in found if isinstance(each, dict)] if isinstance(found, list) else []


def error_of(estimates: dict, key: str) -> object:
    known = estimates.get(key)
    return known.get("error") if isinstance(known, dict) else None


def of_contacts(summary: dict, units: Units) -> Iterator[tuple]:
    told = entries(summary.get("estimates"), "contacts")
    area = f"{units.length}²" if units.length else ""
    for index, each in enumerate(entries(summary, "contacts")):
        errors = told[index] if index < len(told) else {}
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


def of_loads(summary: dict, units: Units) -> Iterator[tuple]:
    for each in entries(summary, "prescribed"):
        for key, unit in (("force", units.force), ("moment", units.moment)):
            yield f"{each.get('name')}: {key}", each.get(key), each.get("error"), unit
    errors = {each.get("name"): error_of(each, "way") for each in entries(summary.get("estimates"), "loads")}
    for each in entries(summary, "ways"):
        name = str(each.get("name"))
        turns = name.startswith("moment ")
        word = "turns" if turns else "move" if name == "all loads" else "moves"
        yield f"{name} {word}", each.get("way"), errors.get(name), "rad" if turns else units.length
    for each in entries(summary, "preloads"):
        yield f"preload {each.get('name')}", each.get("force"), each.get("error"), units.force


def of_supports(summary: dict, units: Units) -> Iterator[tuple]:
    for each in entries(summary, "supports"):
        yield f"{each.get('name')} carries", each.get("force"), None, units.force
    for each in entries(summary, "guides"):
        if each.get("carries"):
            yield f"guide of {each.get('name')} carries", each.get("force"), None, units.force
    for each in entries(summary, "moments"):
        if each.get("printed"):
            words = f"moment of {each.get('name')} on {each.get('body')}"
            moment = each.get("moment")
            yield (
                words,
                moment[0] if isinstance(moment, list) and len(moment) == 1 else moment,
                each.get("error"),
                units.moment,
            )


def of_bodies(summary: dict, units: Units) -> Iterator[tuple]:
    for each in entries(summary, "stresses"):
        yield f"greatest von Mises of {each.get('body')}", each.get("vonMises"), each.get("error"), units.stress
