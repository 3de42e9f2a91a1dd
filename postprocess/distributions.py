"""Probabilities and quantiles of the distributions of Student and of chi squared, by continued fractions.

Source: Press and others, Numerical Recipes, 3rd edition 2007, sections 6.2 (incomplete gamma), 6.4 (incomplete beta).
"""

import math
from collections.abc import Callable

TINY = 1e-300


def fraction(terms: Callable[[int], tuple[float, float]], first: float) -> float:
    """The continued fraction first + a1/(b1 + a2/(b2 + ...)) of terms(k) = (ak, bk), by Lentz's method."""
    value = c = first or TINY
    d = 0.0
    for k in range(1, 10000):
        a, b = terms(k)
        d = 1 / (b + a * d or TINY)
        c = b + a / c or TINY
        value *= c * d
        if abs(c * d - 1) < 1e-15:
            break
    return value


def gamma_tail(a: float, x: float) -> float:
    """The upper regularised incomplete gamma function Q(a, x)."""
    if x <= 0:
        return 1.0
    front = math.exp(a * math.log(x) - x - math.lgamma(a))
    if x < a + 1:  # the series of P
        term = total = 1 / a
        for k in range(1, 10000):
            term *= x / (a + k)
            total += term
            if term < 1e-16 * total:
                break
        return 1 - front * total
    return front / fraction(lambda k: (-k * (k - a), x + 2 * k + 1 - a), x + 1 - a)


def beta_share(a: float, b: float, x: float) -> float:
    """The regularised incomplete beta function I(a, b; x)."""
    if x <= 0 or x >= 1:
        return float(x >= 1)
    if x > (a + 1) / (a + b + 2):
        return 1 - beta_share(b, a, 1 - x)
    front = math.exp(a * math.log(x) + b * math.log1p(-x) + math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b)) / a

    def terms(k: int) -> tuple[float, float]:
        m = k // 2
        if k % 2:
            return -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)), 1.0
        return m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)), 1.0

    return front / fraction(terms, 1.0)


def chi_squared_tail(value: float, freedom: int) -> float:
    """The probability that chi squared with so many degrees of freedom exceeds a value."""
    return gamma_tail(freedom / 2, value / 2)


def student_quantile(probability: float, freedom: float) -> float:
    """The t > 0 with P(|T| <= t) = probability; freedom may be infinite (the normal distribution)."""

    def inside(t: float) -> float:
        if math.isinf(freedom):
            return math.erf(t / math.sqrt(2))
        return 1 - beta_share(freedom / 2, 0.5, freedom / (freedom + t * t))

    low, high = 0.0, 1.0
    while inside(high) < probability:
        high *= 2
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if inside(middle) < probability else (low, middle)
    return 0.5 * (low + high)
