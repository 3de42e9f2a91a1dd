"""The law of a run as a curve: pressure against overlap of the asperities, from the parameters in its summary."""

from collections.abc import Callable

import numpy as np

from postprocess.results import Run

Law = Callable[[np.ndarray], np.ndarray]


def law_of(run: Run) -> Law | None:
    """s = d - d0 (n,) -> pressure (n,) of the run's law, 0 below 0, inf where the law is; None if made of data."""
    name = run.summary["parameters"].get("law", "power")
    if name not in ("power", "exponential", "barrier", "signorini"):
        return None
    d0 = run.parameter("d0")
    if name == "signorini":
        return lambda s: np.zeros(len(s))
    if name == "power":
        kappa, exponent = run.parameter("kappa"), run.parameter("m")
        of_asperities = lambda s: kappa * s**exponent  # noqa: E731
    elif name == "exponential":
        scale, rate = run.parameter("p0"), run.parameter("beta")
        of_asperities = lambda s: scale * np.expm1(rate * s)  # noqa: E731
    else:
        scale = run.parameter("p0")
        of_asperities = lambda s: np.where(s < -d0, scale * s / np.maximum(-d0 - s, 1e-300), np.inf)  # noqa: E731

    def pressure(s: np.ndarray) -> np.ndarray:
        with np.errstate(over="ignore", invalid="ignore"):
            return of_asperities(np.maximum(np.asarray(s, float), 0))

    return pressure


def overlap_at(law: Law, pressure: float, left: float, right: float) -> float:
    """Where the law reaches a pressure, by bisection; `right` where it stays below it up to there."""
    if not law(np.array([right]))[0] > pressure:
        return right
    for _ in range(200):
        middle = 0.5 * (left + right)
        if law(np.array([middle]))[0] > pressure:
            right = middle
        else:
            left = middle
    return right
