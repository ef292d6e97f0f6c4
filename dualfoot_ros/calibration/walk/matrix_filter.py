"""One foot on one walk through an error-state filter that also estimates the gyro matrix.

States: attitude error phi (navigation axes, C_hat = (I - [phi x]) C), velocity error, gyro bias,
accelerometer bias, the six elements m = (xx, yy, zz, xy, xz, yz) of the symmetric matrix S, and
height and set-back (h, b) of the sensor over the pivot of the foot.  With w the measured rate less
the bias of the stand, the true one is w + S(m) w - bias, and S(m) w = W(w) m.

- d phi = C (W(w) m - bias) dt: with the signs of the filter, phi grows by C W(w) dm dt when the
  estimate of m lacks dm.
- A standing foot turns about its pivot: 0 = v + (P C w) x C l with P = diag(1, 1, 0), as in the
  tracker, so its row has blocks for phi, bias, m and l.

The noise is that of a stance, not of a sample: the errors within a stance are alike, so a sample's
variance is multiplied by the number of samples of its stance.  There is no position: nothing here
needs to know where the walk led.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import FloatArray
from .filter_pass import FilterPass
from .filter_terms import FilterNoise
from .foot_walk import FootWalk

ELEMENTS = ("xx", "yy", "zz", "xy", "xz", "yz")


@dataclass(frozen=True)
class Information:
    """What one walk tells about m and the pivot, without the prior: J (x - x_hat) = 0.

    Attributes
    ----------
    matrix : J (8, 8)
    vector : J x_hat (8,), relative to the point of linearisation
    misfit : mean NIS of the stances, per degree of freedom, at least 1; J is divided by it
    """

    matrix: FloatArray
    vector: FloatArray
    misfit: float = 1.0


def filter_walk(walk: FootWalk, point: FloatArray, noise: FilterNoise) -> Information:
    """Return what ``walk`` tells about matrix and pivot, linearised at ``point`` (8,)."""
    run = FilterPass(walk, point, noise)
    covariance, change = run.run()
    whole = np.asarray(np.linalg.inv(covariance), dtype=np.float64)
    # noise.prior() enters at `point`, so the mean of the prior is a change of zero
    told: FloatArray = whole - np.diag(1.0 / noise.prior())
    misfit = max(1.0, run.misfit)
    return Information(told / misfit, whole @ change / misfit, misfit)
