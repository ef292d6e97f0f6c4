"""Bias, scale and misalignment of an accelerometer from standstills in different attitudes.

At rest the specific force is gravity, whichever way the sensor lies, so the parameters make

    r_k = |T K (a_k - b)| - g        (m/s^2)

small in least squares, with a_k the mean of standstill k, b the bias, K = diag(k_x, k_y, k_z) the
scale factors and T lower triangular with ones on its diagonal (Skog and Händel 2006; Tedaldi et
al. 2014, eq. (10)).  T K is stored as one lower triangular matrix.  The norm does not depend on a
rotation of the three axes together, so a convention fixes it: the corrected x axis is the sensing
x axis, the corrected y axis lies in the plane of the sensing x and y axes, z is square to both.

Six positions along the axes determine bias and scale but no misalignment: f_x f_y is zero in all
of them.  So the largest model whose every parameter the attitudes determine is taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core import STANDARD_GRAVITY, CalibrationError, FloatArray
from .sensor import Triad
from .static import Segment, attitudes

REPEATABILITY = 0.01  # m/s^2, by which one attitude is reproduced at best
LOWER = (np.array([1, 2, 2]), np.array([0, 0, 1]))
DOUBTFUL = 0.04  # m/s^2; a fit that leaves more is not of one sensor at rest
AXES = ("x", "y", "z")
ZERO = 1e-6  # m/s^2
SIDES = 0.7  # cosine within which an attitude has an axis up or down


@dataclass(frozen=True)
class Model:
    """A set of parameters: its name, their number, and the number of attitudes they need."""

    name: str
    words: str
    size: int
    attitudes: int


MODELS = {
    m.name: m
    for m in (
        Model("full", "bias, scale and misalignment", 9, 9),
        Model("scale", "bias and scale", 6, 6),
        Model("bias", "bias", 3, 4),
    )
}
LARGEST_STD = np.array([0.03] * 3 + [0.005] * 6)  # m/s^2, then dimensionless
NEEDS = {
    "full": "at least 9 attitudes, some of them with two axes about 45 degrees up",
    "scale": "at least 6 attitudes: each axis once up and once down",
    "bias": "at least 4 attitudes, well apart",
}


@dataclass(frozen=True)
class AccelerometerFit:
    """Bias, scale and misalignment with their standard deviations, and the residuals.

    Attributes
    ----------
    model : "full", "scale" or "bias"
    bias, matrix : (3,) m/s^2 and (3, 3), corrected = matrix (measured - bias)
    bias_std, matrix_std : their standard deviations, from the attitudes and their repeatability
    residual_before, residual_after : (K,) m/s^2, norm of the specific force minus gravity
    attitudes : number of different attitudes
    redundancy : attitudes less parameters
    sigma : m/s^2, the misfit of an attitude on which the standard deviations rest
    gravity : m/s^2
    """

    model: str
    bias: FloatArray
    matrix: FloatArray
    bias_std: FloatArray
    matrix_std: FloatArray
    residual_before: FloatArray
    residual_after: FloatArray
    attitudes: int
    redundancy: int
    sigma: float
    gravity: float

    @property
    def zero_by_construction(self) -> bool:
        """Whether the residuals are zero because there are as many parameters as attitudes."""
        return self.redundancy <= 0 and rms(self.residual_after) < ZERO

    @property
    def doubtful(self) -> bool:
        """Whether the standstills do not fit one sensor."""
        return rms(self.residual_after) > DOUBTFUL

    def triad(self) -> Triad:
        """Return the entry of the calibration file."""
        about = {
            "model": self.model,
            "gravity": self.gravity,
            "attitudes": self.attitudes,
            "bias_std": [round(float(v), 5) for v in self.bias_std],
            "residual_before": round(rms(self.residual_before), 5),
            "residual_after": round(rms(self.residual_after), 5),
        }
        return Triad(self.bias, self.matrix, about)

    def residuals(self, means: FloatArray) -> FloatArray:
        """Return the residuals (K,) m/s^2 of mean specific forces (K, 3) not used for the fit."""
        return norms(self.triad().apply(means)) - self.gravity


def fit_accelerometer(
    segments: Sequence[Segment], model: str = "auto", gravity: float = STANDARD_GRAVITY
) -> AccelerometerFit:
    """Fit ``model``, or with "auto" the larger of "full" and "scale" that can be determined.

    Raises
    ------
    CalibrationError
        When the attitudes do not determine it; names their number and the missing ones.
    """
    names = ("full", "scale") if model == "auto" else (model,)
    reason = ""
    for name in names:
        reason = why_not(segments, MODELS[name], gravity)
        if not reason:
            return _fit(segments, MODELS[name], gravity)
    raise CalibrationError(reason)


def why_not(segments: Sequence[Segment], model: Model, gravity: float) -> str:
    """Return a sentence on why the attitudes do not determine ``model``; empty if they do."""
    count = len(set(attitudes(segments)))
    need = f"{model.words} need {NEEDS[model.name]}"
    if count < model.attitudes:
        plural = "attitude is" if count == 1 else "attitudes are"
        return f"{count} different {plural} too few: {need}{_missing_sides(segments)}"
    fitted = _fit(segments, model, gravity)
    std = np.concatenate([fitted.bias_std, np.diag(fitted.matrix_std), fitted.matrix_std[LOWER]])
    std *= REPEATABILITY / fitted.sigma  # by the geometry of the attitudes, not by their fit
    worst = int(np.argmax(std[: model.size] / LARGEST_STD[: model.size]))
    if std[worst] > LARGEST_STD[worst]:
        return (
            f"the {count} attitudes do not determine {_parameter_name(worst)} (standard deviation "
            f"{std[worst]:.2g}, allowed {LARGEST_STD[worst]:g}): {need}"
        )
    return ""


def norms(vectors: FloatArray) -> FloatArray:
    """Return the norm (K,) of each row (K, 3)."""
    lengths: FloatArray = np.linalg.norm(vectors, axis=1)
    return lengths


def rms(values: FloatArray) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))


def _fit(segments: Sequence[Segment], model: Model, gravity: float) -> AccelerometerFit:
    from scipy.optimize import least_squares

    means = np.array([s.mean for s in segments])
    numbers = attitudes(segments)
    weight = 1.0 / np.sqrt(np.bincount(numbers)[numbers])

    def weighted(x: FloatArray) -> FloatArray:
        bias, matrix = unpack(x)
        return weight * (norms((means - bias) @ matrix.T) - gravity)

    solved = least_squares(weighted, np.zeros(model.size), x_scale="jac", xtol=1e-14, ftol=1e-14)
    bias, matrix = unpack(solved.x)
    count = len(set(numbers))
    redundancy = count - model.size
    misfit = 2.0 * solved.cost / redundancy if redundancy > 0 else 0.0
    sigma = max(REPEATABILITY, float(np.sqrt(misfit)))
    covariance = sigma**2 * np.linalg.pinv(solved.jac.T @ solved.jac, rcond=1e-12)
    bias_std, matrix_std = _unpack_std(np.sqrt(np.diag(covariance)))
    before, after = norms(means) - gravity, norms((means - bias) @ matrix.T) - gravity
    return AccelerometerFit(
        model.name,
        bias,
        matrix,
        bias_std,
        matrix_std,
        before,
        after,
        count,
        redundancy,
        sigma,
        gravity,
    )


def unpack(x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return bias (3,) and matrix (3, 3) for 3, 6 or 9 parameters."""
    matrix = np.eye(3)
    if len(x) > 3:
        matrix[np.diag_indices(3)] += x[3:6]
    if len(x) > 6:
        matrix[LOWER] = x[6:9]
    return x[:3].copy(), matrix


def _unpack_std(std: FloatArray) -> tuple[FloatArray, FloatArray]:
    matrix = np.zeros((3, 3))
    if len(std) > 3:
        matrix[np.diag_indices(3)] = std[3:6]
    if len(std) > 6:
        matrix[LOWER] = std[6:9]
    return std[:3].copy(), matrix


def _parameter_name(index: int) -> str:
    if index < 3:
        return f"the bias of {AXES[index]}"
    if index < 6:
        return f"the scale of {AXES[index - 3]}"
    row, column = (int(at[index - 6]) for at in LOWER)
    return f"the misalignment of {AXES[row]} against {AXES[column]}"


def _missing_sides(segments: Sequence[Segment]) -> str:
    """Return the sides that have not been up, in words."""
    ups = np.array([s.direction for s in segments])
    lacking = [
        f"{axis} {word}"
        for k, axis in enumerate(AXES)
        for sign, word in ((1.0, "up"), (-1.0, "down"))
        if not (sign * ups[:, k] > SIDES).any()
    ]
    return f"; missing: {', '.join(lacking)}" if lacking else ""
