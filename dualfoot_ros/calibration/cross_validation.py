"""Cross-validation of an accelerometer calibration on attitudes that were left out of the fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .accelerometer import MODELS, AccelerometerFit, fit_accelerometer, why_not
from .static import Segment, attitudes


@dataclass(frozen=True)
class CrossValidation:
    """Residuals of the data left out of the fit, m/s^2 RMS, without and with the calibration.

    ``how`` is "attitude" (each attitude left out in turn) or "half" (made from the first half of
    every standstill and tried on the second, which shows the repeatability and no more).
    """

    how: str
    model: str
    before: float
    after: float

    def sentence(self) -> str:
        """Return the result in words."""
        data = (
            "each attitude left out in turn"
            if self.how == "attitude"
            else "first halves of the standstills against second halves (this shows only the "
            "repeatability; record more attitudes to see more)"
        )
        return (
            f"cross-validation, {data}: {self.before:.4f} m/s^2 without, {self.after:.4f} m/s^2 "
            f"with the calibration ({MODELS[self.model].words})"
        )


def cross_validate(segments: Sequence[Segment], fit: AccelerometerFit) -> CrossValidation:
    """Leave each attitude out in turn where the others still determine the model; else halves."""
    numbers = np.array(attitudes(segments))
    before, after = [], []
    for number in sorted(set(numbers.tolist())):
        rest = [s for s, n in zip(segments, numbers, strict=True) if n != number]
        if why_not(rest, MODELS[fit.model], fit.gravity):
            return _halves(segments, fit)
        left_out = np.array(
            [s.mean for s, n in zip(segments, numbers, strict=True) if n == number]
        )
        refit = fit_accelerometer(rest, fit.model, fit.gravity)
        before += (np.linalg.norm(left_out, axis=1) - fit.gravity).tolist()
        after += refit.residuals(left_out).tolist()
    return _summarise("attitude", fit, before, after)


def _halves(segments: Sequence[Segment], fit: AccelerometerFit) -> CrossValidation:
    refit = fit_accelerometer([s.half(0) for s in segments], fit.model, fit.gravity)
    means = np.array([s.half(1).mean for s in segments])
    before = np.linalg.norm(means, axis=1) - fit.gravity
    return _summarise("half", fit, before.tolist(), refit.residuals(means).tolist())


def _summarise(
    how: str, fit: AccelerometerFit, before: list[float], after: list[float]
) -> CrossValidation:
    rms = [float(np.sqrt(np.mean(np.square(v)))) for v in (before, after)]
    return CrossValidation(how, fit.model, rms[0], rms[1])
