"""Weighted nonlinear least squares with bounds: parameters from measured values, and how well these determine them.

`fit` minimises the sum of the squares of (model - measured)/deviation by Levenberg's and Marquardt's method. Positive
parameters vary in their logarithms, so a step is a factor. Parameters at a bound that the sum would pass are held.
Intervals are those of the linearised model: normal with known standard deviations, by Student's t otherwise.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from postprocess.distributions import chi_squared_tail, student_quantile

Vector = np.ndarray
# values (data) and derivatives (data x parameters) of a model at parameters, or None where it has no solution
Model = Callable[[dict[str, float]], tuple[Vector, np.ndarray] | None]

MAX_STEPS = 60
FLAT = 1e-4  # singular value over the greatest, below which a direction is not determined
VAGUE = 1.0  # standard deviation in the logarithm (a factor of e), beyond which a direction is not determined


@dataclass(frozen=True)
class Parameter:
    """A name, its first value and bounds; isLogarithmic: it varies in the logarithm of its magnitude."""

    name: str
    first: float
    low: float
    high: float
    is_logarithmic: bool = True

    def inner(self, value: float) -> float:
        return math.log(abs(value)) if self.is_logarithmic else value

    def outer(self, inner: float) -> float:
        return math.copysign(math.exp(inner), self.first) if self.is_logarithmic else inner

    def bounds(self) -> tuple[float, float]:
        low, high = sorted((self.inner(self.low), self.inner(self.high)))
        return low, high


@dataclass
class Fit:
    """A solution: values, covariance of inner variables, residuals in standard deviations, what was not determined."""

    parameters: list[Parameter]
    values: dict[str, float]
    inner: Vector
    covariance: np.ndarray  # of the inner variables
    modelled: Vector
    residuals: Vector  # (model - measured)/deviation
    is_scatter_known: bool
    converged: bool
    steps: int
    evaluations: int
    at_bound: list[str] = field(default_factory=list)
    directions: list[tuple[float, Vector]] = field(default_factory=list)  # singular values and directions, inner
    undetermined: list[Vector] = field(default_factory=list)

    @property
    def freedom(self) -> int:
        return len(self.residuals) - len(self.parameters)

    @property
    def sum_of_squares(self) -> float:
        return float(self.residuals @ self.residuals)

    @property
    def scatter(self) -> float:
        """The standard deviation of a residual: 1 as stated, otherwise estimated from the residuals."""
        if self.is_scatter_known:
            return 1.0
        return math.sqrt(self.sum_of_squares / self.freedom) if self.freedom > 0 else math.nan

    def deviation(self, k: int) -> float:
        """The standard deviation of the inner variable k."""
        return self.scatter * math.sqrt(self.covariance[k, k])

    def interval(self, k: int, level: float = 0.95) -> tuple[float, float]:
        """The bounds of parameter k in which the truth lies with this probability."""
        if not self.is_scatter_known and self.freedom < 1:
            return -math.inf, math.inf
        reach = student_quantile(level, math.inf if self.is_scatter_known else self.freedom) * self.deviation(k)
        one = self.parameters[k]
        ends = sorted(one.outer(min(max(self.inner[k] + side * reach, -600), 600)) for side in (-1, 1))
        return ends[0], ends[1]

    def correlation(self) -> np.ndarray:
        size = np.sqrt(np.diag(self.covariance))
        return self.covariance / np.outer(size, size)

    def misfit_probability(self) -> float:
        """The probability of a sum of squares as large as this one, if law and deviations are right; else NaN."""
        if not self.is_scatter_known or self.freedom < 1:
            return math.nan
        return chi_squared_tail(self.sum_of_squares, self.freedom)

    def criteria(self) -> tuple[float, float]:
        """Akaike's criterion, corrected for few data, and Schwarz's (AICc, BIC): smaller is better."""
        n, k = len(self.residuals), len(self.parameters) + (not self.is_scatter_known)
        deviance = self.sum_of_squares if self.is_scatter_known else n * math.log(max(self.sum_of_squares, 1e-300) / n)
        correction = 2 * k * (k + 1) / (n - k - 1) if n > k + 1 else math.inf
        return deviance + 2 * k + correction, deviance + k * math.log(n)


def fit(model: Model, parameters: list[Parameter], measured: Vector, deviation: Vector, known: bool) -> Fit | None:
    """The best fit from the first values on; None without a solution there. known: deviations are absolute."""
    bounds = np.array([one.bounds() for one in parameters])
    z = np.clip([one.inner(one.first) for one in parameters], *bounds.T)
    now = evaluate(model, parameters, z, measured, deviation)
    if now is None:
        return None
    evaluations, steps, damping, converged = 1, 0, 1e-3, False
    while steps < MAX_STEPS and not converged:
        steps += 1
        residuals, jacobian, _ = now
        gradient = jacobian.T @ residuals
        free = ~(((z <= bounds[:, 0]) & (gradient > 0)) | ((z >= bounds[:, 1]) & (gradient < 0)))
        if not free.any() or is_orthogonal(jacobian[:, free], residuals):
            converged = True
            break
        accepted = False
        while not accepted and damping < 1e12:
            trial = np.clip(z + damped_step(jacobian[:, free], residuals, damping, free), *bounds.T)
            new = evaluate(model, parameters, trial, measured, deviation)
            evaluations += 1
            accepted = new is not None and new[0] @ new[0] <= residuals @ residuals
            if not accepted:
                damping *= 10
            elif new is not None:
                moved = np.abs(trial - z)
                fell = residuals @ residuals - new[0] @ new[0]
                # below the accuracy of the model's own solution nothing more is gained
                converged = bool(
                    np.all(moved < 1e-6) or (np.all(moved < 1e-2) and fell < 1e-9 * (residuals @ residuals))
                )
                z, now, damping = trial, new, damping / 10
            if not accepted and np.all(np.abs(trial - z) < 1e-7):
                converged = accepted = True
        if not accepted:
            break
    return summarise(parameters, z, bounds, now, known, (converged, steps, evaluations))


def evaluate(
    model: Model, parameters: list[Parameter], z: Vector, measured: Vector, deviation: Vector
) -> tuple[Vector, np.ndarray, Vector] | None:
    """Residuals, their derivatives by the inner variables, and the modelled values; None without a solution."""
    values = {one.name: one.outer(inner) for one, inner in zip(parameters, z, strict=True)}
    found = model(values)
    if found is None or not (np.isfinite(found[0]).all() and np.isfinite(found[1]).all()):
        return None
    modelled, jacobian = found
    factors = np.array([values[one.name] if one.is_logarithmic else 1.0 for one in parameters])
    return (modelled - measured) / deviation, jacobian * factors / deviation[:, None], modelled


def is_orthogonal(jacobian: np.ndarray, residuals: Vector) -> bool:
    """Whether a step would move the values by less than a thousandth of their interval (Bates and Watts, 1981)."""
    explained = jacobian @ np.linalg.lstsq(jacobian, residuals, rcond=1e-10)[0]
    return bool(np.linalg.norm(explained) <= 1e-3 * np.linalg.norm(residuals - explained) + 1e-7)


def damped_step(jacobian: np.ndarray, residuals: Vector, damping: float, free: Vector) -> Vector:
    """Levenberg's and Marquardt's step of the free variables, at most a factor of 10; others 0."""
    size = np.linalg.norm(jacobian, axis=0) + 1e-300
    scaled = jacobian / size
    system = np.vstack([scaled, math.sqrt(damping) * np.eye(scaled.shape[1])])
    right = np.concatenate([-residuals, np.zeros(scaled.shape[1])])
    step = np.zeros(len(free))
    step[free] = np.linalg.lstsq(system, right, rcond=None)[0] / size
    return step * min(1.0, math.log(10) / max(float(np.abs(step).max()), 1e-300))


def summarise(
    parameters: list[Parameter],
    z: Vector,
    bounds: np.ndarray,
    now: tuple[Vector, np.ndarray, Vector],
    known: bool,
    counts: tuple[bool, int, int],
) -> Fit:
    """Covariance, and directions that the data do not determine, from the singular values of the Jacobian."""
    residuals, jacobian, modelled = now
    _, singular, directions = np.linalg.svd(jacobian, full_matrices=True)
    singular = np.concatenate([singular, np.zeros(len(parameters) - len(singular))])
    safe = np.maximum(singular, 1e-12 * max(float(singular.max()), 1e-300))
    at_bound = [one.name for one, at, (low, high) in zip(parameters, z, bounds, strict=True) if at <= low or at >= high]
    found = Fit(
        parameters,
        {one.name: one.outer(inner) for one, inner in zip(parameters, z, strict=True)},
        z,
        (directions.T / safe**2) @ directions,
        modelled,
        residuals,
        known,
        *counts,
        at_bound,
        list(zip(singular.tolist(), directions, strict=True)),
    )
    scatter = found.scatter if math.isfinite(found.scatter) else 1.0
    found.undetermined = [
        direction
        for value, direction in found.directions
        if value < FLAT * singular.max() or scatter / max(value, 1e-300) > VAGUE
    ]
    return found
