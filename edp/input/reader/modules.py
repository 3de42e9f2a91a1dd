"""Which modules of the package a case and the flags ask for, by their names.

`needs(case)` says what the statements need; `modules(needs, run)` makes the list: macros that read a module on request,
and options.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from . import grammar as g
from .case import Case
from .rigid.shapes import has_edges
from .words import Refusal

MIXED_ABOVE = 0.49  # the Poisson's ratio, as in fem/incompressible/mixed-element.idp


@dataclass
class Needs:
    """What the statements of a case need."""

    friction: bool  # friction, load phases, ties, plastic bodies: the state depends on the way to it
    strains: bool  # expand, preload, conduct
    tightening: bool  # bolts in sequence
    heat: bool
    time: bool  # of heat
    rotations: bool
    stresses: bool
    laws: bool  # other than hard contact and the power law
    symmetries: bool  # or an axis
    loads: bool
    forces: bool  # free and rigid forces, moments, springs, spins
    moments: bool  # to be told about a point
    gravity: bool
    wear: bool
    plastic: bool
    surface: bool  # rigid shapes with edges
    poisson: float  # the greatest ratio, in plane stress 0


@dataclass
class Run:
    """What the flags of a run say that matters here; `own`: it is parts.edp or parts-3d.edp themselves."""

    space: bool
    own: bool = True
    exact: bool = False
    history: bool = False
    axis: bool = False
    check: bool = False
    order: str = "2"


@dataclass
class Modules:
    macros: list[str] = field(default_factory=list)
    options: list[str] = field(default_factory=list)


def needs(case: Case) -> Needs:
    touching = case.touching
    plastic = case.has(g.Plastic)
    conducts = case.of(g.Conduct)
    pushed = [s for s in case.of(g.Force) if s.how]
    friction = plastic or case.has(g.Leg, g.Tie) or any(s.friction for s in touching)
    return Needs(
        friction=friction,
        strains=case.has(g.Expand, g.Preload, g.Conduct),
        tightening=case.has(g.Tighten),
        heat=bool(conducts),
        time=case.has(g.Time),
        rotations=case.has(g.Rotate),
        stresses=plastic
        or case.has(g.Stresses, g.LineOut)
        or any(s.yield_stress for s in case.of(g.Body))
        or any(s.expand for s in conducts),
        laws=any(s.law and s.law.name not in ("signorini", "power") for s in touching),
        symmetries=case.has(g.Symmetry) or case.where.state == "axisymmetric",
        loads=case.has(g.Pressure, g.Traction, g.Weight, g.Gravity),
        forces=bool(pushed) or case.has(g.Moment, g.Spin, g.Spring),
        moments=friction or case.has(g.AboutPoint, g.Moment, g.Rotate),
        gravity=case.has(g.Gravity),
        wear=case.has(g.Cycles) or any(s.wear for s in touching),
        plastic=plastic,
        poisson=max((s.nu for s in case.of(g.Body) if case.where.state != "stress"), default=0.0),
        surface=any(has_edges(s.shape) for s in case.of(g.Obstacle)),
    )


def mixed(need: Needs, run: Run) -> bool:
    """Whether bodies have mixed elements."""
    return need.poisson > MIXED_ABOVE and run.order == "2" and run.own and not (need.plastic or need.strains)


def refuse_together(need: Needs, run: Run) -> None:
    """Statements and flags that exclude each other."""
    if need.plastic and need.tightening:
        raise Refusal("tighten: not with plastic; allowed: preload without tighten, which tightens all bolts together")
    if need.plastic and (need.heat or need.wear):
        raise Refusal("plastic: not with conduct or wear; allowed: loads, motions, contacts, expand, preload")
    if need.strains and not run.own:
        raise Refusal("expand, preload, conduct: allowed in edp/parts" + ("-3d" if run.space else "") + ".edp")
    fourth = run.order == "4" and not (need.plastic or need.strains)
    if need.poisson == 0.5 and not (mixed(need, run) or fourth):
        raise Refusal(
            "nu 0.5: not with -order 1 or 3, expand, preload, conduct or plastic, nor in other scenes; "
            "allowed there: nu below 0.5"
        )
    if run.axis and mixed(need, run):
        raise Refusal(f"-axis: not with a nu above {MIXED_ABOVE}; allowed: line NAME x y x y in the case")
    if need.heat and need.friction:
        raise Refusal("conduct: allowed without friction, tie and leg")
    if run.axis and need.strains:
        raise Refusal(
            "-axis: not with expand, preload or conduct, whose strains it leaves out; "
            "allowed: line NAME x y x y in the case"
        )


def modules(need: Needs, run: Run) -> Modules:
    """The macros and the options that are read."""
    refuse_together(need, run)
    series = run.history and not need.friction and run.own
    far = need.strains or (need.rotations and not need.friction) or series or run.exact
    asked = {
        "lawsOnRequest": need.laws,
        "mirrorsOnRequest": need.symmetries,
        "loadsOnRequest": need.loads,
        "largeMotionsOnRequest": need.rotations or far,
        "checkOnRequest": run.check,
    }
    options = {
        "series": series or (need.friction and not need.plastic and not run.check),
        "axisStresses": run.axis and not run.space and not need.friction,
        "springsAndMoments": need.forces,
        "moments": need.moments,
        "wear": need.wear,
        "heat": need.heat,
        "heatInTime": need.time,
        "plastic": need.plastic,
        "friction": need.friction,
        "initialStrain": need.strains,
        "tightening": need.tightening,
        "stresses": need.stresses or need.gravity,
        "deflections": need.gravity,
        "largeRotation": far,
        "rigidSurface": need.surface,
        "incompressible": mixed(need, run),
    }
    return Modules([name for name, on in asked.items() if on], [name for name, on in options.items() if on and run.own])
