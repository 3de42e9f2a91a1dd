"""Contacts with a known answer, as functions of numbers: Hertz's line and ellipse, a pin in a hole, a press fit.

Moduli are plane: contact_modulus gives them. Lengths, forces and pressures in any consistent units; in the plane a
force is per unit of thickness. Each is for hard, frictionless contact of elastic bodies.
"""

import numpy as np


def plane_modulus(young: float, poisson: float) -> float:
    """E/(1 - nu^2): of plane strain, and of a half-space."""
    return young / (1 - poisson**2)


def contact_modulus(first: float, second: float = np.inf) -> float:
    """E* of two bodies with these plane moduli."""
    return 1 / (1 / first + 1 / second)


def hertz_line(force: float, radius: float, modulus: float) -> tuple[float, float]:
    """(a, p0): half-width and greatest pressure of two cylinders side by side, 1/radius = 1/R1 + 1/R2.

    Johnson, Contact Mechanics (1985), 4.2.
    """
    a = np.sqrt(4 * force * radius / (np.pi * modulus))
    return a, 2 * force / (np.pi * a)


def elliptic(m: float) -> tuple[float, float]:
    """(K, E): the complete elliptic integrals of the parameter m = k^2, by the arithmetic-geometric mean."""
    a, b, total, weight = 1.0, np.sqrt(1 - m), 0.5 * m, 0.5
    for _ in range(12):  # quadratic convergence
        weight *= 2
        total += weight * (0.5 * (a - b)) ** 2
        a, b = 0.5 * (a + b), np.sqrt(a * b)
    first = np.pi / (2 * a)
    return first, first * (1 - total)


def hertz_ellipse(force: float, radii: tuple[float, float], modulus: float) -> tuple[float, float, float, float]:
    """(a, b, p0, approach) of a contact with these relative radii of curvature in two planes at a right angle.

    Of crossed cylinders they are the cylinders' own. a >= b. Johnson (1985), 4.1: with e^2 = 1 - (b/a)^2,
    ((a/b)^2 E - K)/(K - E) = radii' ratio, a^3 = 3 F (K - E)/(2 pi e^2 E* A), A = 1/(2 greater radius).
    """
    large, small = max(radii), min(radii)
    low, high = 0.0, 1 - 1e-15
    for _ in range(200):
        m = 0.5 * (low + high)
        flat, full = elliptic(m)
        # for a nearly round contact the difference of the integrals is lost in rounding: its series
        flatness = flat - full if m > 1e-6 else np.pi / 4 * m * (1 + 3 * m / 8)
        ratio = (full / (1 - m) - flat) / flatness if m > 1e-6 else 1 + 0.75 * m
        low, high = (m, high) if ratio < large / small else (low, m)
    a = (3 * force * flatness / m * large / (np.pi * modulus)) ** (1 / 3)
    b = a * np.sqrt(1 - m)
    return a, b, 3 * force / (2 * np.pi * a * b), 3 * force * flat / (2 * np.pi * a * modulus)


def pin_clearance(half_angle: float) -> float:
    """E' (R_hole - R_pin)/F of a pin in a hole of an infinite plate of the same material that touch up to this angle.

    E' is the plane modulus of one of them. Persson, On the stress distribution of cylindrical elastic bodies in contact
    (1964); with b = tan(angle/2) his equation is (2 (1 - b^2) - ln(1 + b^2)/(1 + b^2))/(pi b^2).
    """
    b2 = np.tan(half_angle / 2) ** 2
    return (2 * (1 - b2) - np.log1p(b2) / (1 + b2)) / (np.pi * b2)


def pin_angle(clearance: float) -> float:
    """The half angle of contact for E' (R_hole - R_pin)/F."""
    low, high = 1e-9, np.pi - 1e-9
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if pin_clearance(middle) > clearance else (low, middle)
    return middle


def pin_pressure(angle: np.ndarray, half_angle: float) -> np.ndarray:
    """p R/F at these angles from the load's direction; 0 outside the contact."""
    b = np.tan(half_angle / 2)
    y = np.tan(np.clip(np.abs(angle), 0, half_angle) / 2)
    root, s = np.sqrt(np.maximum(b * b - y * y, 0)), np.sqrt(1 + b * b)
    return 2 / (np.pi * s) * root / (1 + y * y) + np.log((s + root) / (s - root)) / (2 * np.pi * b * b * (1 + b * b))


def press_fit(
    radii: tuple[float, float, float], interference: float, inner: tuple[float, float], outer: tuple[float, float]
) -> float:
    """The pressure between two rings: bore, joint and outside radius, radial interference, (E, nu); plane strain.

    Lame; Timoshenko and Goodier, Theory of Elasticity, 28: a ring's joint moves by p r ((q^2 + 1)/(q^2 - 1) -+ nu)/E,
    q its radii's ratio, E and nu those of plane strain.
    """
    bore, joint, outside = radii

    def softness(young: float, poisson: float, ratio: float, sign: float) -> float:
        plane, effect = plane_modulus(young, poisson), poisson / (1 - poisson)
        return ((ratio**2 + 1) / abs(ratio**2 - 1) + sign * effect) / plane

    return interference / joint / (softness(*outer, outside / joint, 1) + softness(*inner, joint / bore, -1))


def taper(force: float, slope: float, friction: float) -> float:
    """The normal force on the flank of half a plug that `force` drives in; friction below 0: it comes out."""
    return force * np.hypot(1, slope) / (slope + friction)


def rough_profile(x: np.ndarray, width: float, modes: float, hurst: float, rms: float, seed: float) -> np.ndarray:
    """The height of the scene rough's wall towards the block: sum of n^(-H-1/2) cos(2 pi n x/width + phase_n)."""
    n = np.arange(1, int(modes) + 1)
    size = n ** (-hurst - 0.5)
    state, phase = int(seed), []
    for _ in n:
        state = 16807 * state % (2**31 - 1)
        phase.append(2 * np.pi * state / (2**31 - 1))
    return rms * np.sqrt(2 / np.sum(size**2)) * np.cos(2 * np.pi * np.outer(x, n) / width + phase) @ size


def shrink_fit(
    radii: tuple[float, float, float], strain: float, inner: tuple[float, float], outer: tuple[float, float]
) -> float:
    """The pressure between two rings of one radius when the outer one has shrunk by a strain; plane stress.

    Lame, as press_fit: the joint of the outer ring would be at r (1 - strain).
    """

    def softness(young: float, poisson: float, ratio: float, sign: float) -> float:
        return ((ratio**2 + 1) / abs(ratio**2 - 1) + sign * poisson) / young

    bore, joint, outside = radii
    return strain / (softness(*outer, outside / joint, 1) + softness(*inner, joint / bore, -1))


def heated_fit(
    radii: tuple[float, float, float],
    inner: tuple[float, float, float, float, float],
    outer: tuple[float, float, float, float, float],
    temperatures: tuple[float, float],
    conductance: tuple[float, float, float],
) -> tuple[float, float, float]:
    """Two rings of one radius, warm at the bore and outside: pressure between them, heat, gap; plane stress.

    inner, outer: E, nu, expansion, temperature without stress, conductivity. conductance: h0, m, H of h0 (p/H)^m; with
    H = 0 it is h0 at each pressure. Heat flows inwards, all round, for a unit of thickness; the gap is negative in
    contact: minus the overlap of the rings without their pressure. Of several states that with the greatest pressure.

    Fourier between cylinders; the radius of a free ring grows by the mean over its area of the thermal strain; Lame.
    """
    bore, joint, outside = radii

    def softness(young: float, poisson: float, ratio: float, sign: float) -> float:
        return joint * ((ratio**2 + 1) / abs(ratio**2 - 1) + sign * poisson) / young

    def mean(start: float, end: float, ratio: float) -> float:
        return start + (end - start) * (ratio**2 / (ratio**2 - 1) - 1 / (2 * np.log(ratio)))

    soft = softness(*inner[:2], joint / bore, -1) + softness(*outer[:2], outside / joint, 1)

    def state(pressure: float) -> tuple[float, float]:
        h0, exponent, hardness = conductance
        through = h0 * (pressure / hardness) ** exponent if hardness > 0 else h0
        resists = np.log(joint / bore) / inner[4], np.log(outside / joint) / outer[4]
        flow = 0.0  # for a radian
        if pressure > 0 and through > 0:
            flow = (temperatures[1] - temperatures[0]) / (sum(resists) + 1 / (joint * through))
        sides = temperatures[0] + flow * resists[0], temperatures[1] - flow * resists[1]
        means = mean(temperatures[0], sides[0], joint / bore), mean(sides[1], temperatures[1], outside / joint)
        strains = inner[2] * (means[0] - inner[3]), outer[2] * (means[1] - outer[3])
        return joint * (strains[0] - strains[1]), 2 * np.pi * flow

    most = 10 * max(abs(state(pressure)[0]) for pressure in (1e-300, 1e300)) / soft
    grid = most * np.geomspace(1, 1e-9, 4000)
    above = next((k for k, pressure in enumerate(grid) if state(pressure)[0] / soft > pressure), 0)
    if above == 0:
        overlap, heat = state(0)
        return 0.0, heat, -overlap
    low, high = grid[above], grid[above - 1]
    for _ in range(100):
        middle = (low + high) / 2
        if state(middle)[0] / soft > middle:
            low = middle
        else:
            high = middle
    overlap, heat = state(low)
    return low, heat, -overlap


def ring_stress(r: float, pressure: float, joint: float, outside: float) -> tuple[float, float]:
    """Radial and hoop stress at r in a ring with a pressure inside; Lame."""
    scale = pressure * joint**2 / (outside**2 - joint**2)
    return scale * (1 - (outside / r) ** 2), scale * (1 + (outside / r) ** 2)


def snap_hook(
    arm: tuple[float, float], elastic: tuple[float, float], push: float, latch: float, friction: float = 0
) -> tuple[float, float]:
    """What pushes a round latch along a hook's ramp of 30 degrees, and the force normal to it, for a unit of width.

    arm: length and thickness; elastic: E, nu of plane stress; the latch's radius, its circle at rest on the ramp's
    middle, 2.5 beyond the arm and 0.634 below its lower side. The arm is Timoshenko's beam, the nose rigid, the ramp
    turns with it. Friction drags the hook along its ramp, the way that the latch goes.
    """
    (length, thick), (young, poisson), ramp = arm, elastic, np.pi / 6
    inertia, shear = thick**3 / 12, young / 2 / (1 + poisson)
    middle = np.array([length + 2.5, -1.5 + 1.5 * np.tan(ramp)])
    end = np.array([length, thick / 2])
    centre = middle + latch * np.array([np.sin(ramp), -np.cos(ramp)]) - [push, 0]

    def gap(force: float) -> tuple[float, float]:
        turn = 0.0
        for _ in range(50):
            normal = np.array([np.sin(ramp + turn), -np.cos(ramp + turn)])
            axial, across = force * (friction * np.array([normal[1], -normal[0]]) - normal)
            at = centre - latch * normal - end
            tip = at[0] * across - at[1] * axial  # the moment at the nose
            turn = (tip * length + across * length**2 / 2) / (young * inertia)
        rise = (tip * length**2 / 2 + across * length**3 / 3) / (
            young * inertia
        ) + 1.2 * across * length / shear / thick
        moved = np.array([axial * length / young / thick, rise])
        rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        along = float(normal[0] - friction * normal[1])
        return float((centre - end - moved - rotation @ (middle - end)) @ normal - latch), along

    low, high = 0.0, 1e-9 * young * thick
    while gap(high)[0] < 0:
        high *= 2
    for _ in range(200):
        force = (low + high) / 2
        low, high = (force, high) if gap(force)[0] < 0 else (low, force)
    return force * gap(force)[1], force


def joint_diagram(preload: float, load: float, bolt: float, parts: float) -> tuple[float, float]:
    """What a bolt and the parts that it clamps carry under a load at its head, by their stiffnesses."""
    share = preload + load * bolt / (bolt + parts)
    return (share, share - load) if share > load else (load, 0.0)
