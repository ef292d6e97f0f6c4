"""``rigid_pair``: two sensors on one shoe, a constant lever arm apart.

Chen et al. 2022: "left" is the first sensor, "right" the second.  In swing and stance alike

    r_2 - r_1 = R_1 m                  eq. (12)
    v_2 - v_1 = R_1 (omega x m)        eq. (13)

with m the lever arm in the first sensor's body frame and omega the mean of what both sensors
measure.  A sample is the mean rate of its interval, so the rate at its end, where the velocities
hold, is carried on from the last two samples: half an interval matters as soon as the arm is not
tiny (a swing turns at more than 100 rad/s^2).

The paper's linear Kalman filter, eqs (16)-(22), has positions and velocities as its states and
takes attitude from the gyros as it is; that filter is this one with no uncertainty in attitude and
biases, which is what ``chen2022.yaml`` sets.  With that uncertainty the rows also carry the
attitude of the first sensor and the gyro biases.  (Eq. (21) of the paper misses the inverse of the
innovation covariance.)  The paper gives m = (0.01, 0.01, 0) m right-front-up.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..joint_estimate import JointEstimate, Outcome
from ..kernel.layout import attitude_row, gyro_bias_row, position_row, velocity_row
from ..parameters import Parameters, parameter
from ..results.payloads import Details
from ..rotation import skew
from ..samples.series import FloatArray
from .method import Gait, Method, Request


@dataclass(frozen=True)
class RigidPairConfig(Parameters):
    """Parameters of the rigid pair."""

    lever_arm: tuple[float, float, float] = parameter(
        (0.01, -0.01, 0.0),
        "second sensor from the first, in the first's body frame (forward-left-up)",
        unit="m",
        minimum=-0.5,
        maximum=0.5,
    )
    position_std: float = parameter(
        0.01, "noise of the position difference", unit="m", minimum=1e-5, maximum=1.0
    )
    velocity_std: float = parameter(
        0.1, "noise of the velocity difference", unit="m/s", minimum=1e-5, maximum=1.0
    )
    every: int = parameter(1, "epochs from one constraint to the next", minimum=1, maximum=100)


class RigidPair(Method):
    """Constrains both differences at every epoch."""

    name = "rigid_pair"
    config_class = RigidPairConfig
    config: RigidPairConfig
    sensors_on_one_shoe = True
    dimensions = 3
    watch_m = -1.0

    def __init__(self, config: RigidPairConfig) -> None:
        """Use ``config``."""
        self.config = config
        self._arm = np.array(config.lever_arm)
        self.lever_arm = self._arm

    def on_epoch(self, gait: Gait) -> Sequence[Request]:
        """Return the constraint of this epoch."""
        if gait.now % self.config.every:
            return ()
        now = gait.now
        ahead = [self._ahead(gait, sensor) for sensor in range(2)]
        apply = partial(self.apply, gait=gait, epoch=now, ahead=ahead)
        return (Request(now, False, apply),)

    def _ahead(self, gait: Gait, sensor: int) -> FloatArray:
        """Return by how much the rate (3,) changes from the newest sample's middle to its end."""
        if gait.now < 1:
            return np.zeros(3)
        change: FloatArray = gait.sample(sensor, gait.now) - gait.sample(sensor, gait.now - 1)
        return 0.5 * change[3:]

    def apply(
        self, estimate: JointEstimate, gait: Gait, epoch: int, ahead: Sequence[FloatArray]
    ) -> Outcome:
        """Update with eq. (13), then with eq. (12); ``ahead`` is added to both rates."""
        sensors = (0, 1) if self._same_axes(estimate) else (0,)
        share = 1.0 / len(sensors)
        rate = share * np.sum([gait.sample(s, epoch)[3:] + ahead[s] for s in sensors], axis=0)
        rotation = estimate.rotation(0)
        moved = rotation @ (skew(rate) @ self._arm)
        velocity = estimate.velocity(1) - estimate.velocity(0) - moved
        rows = difference_rows(velocity_row, moved)
        add_bias(rows, share * rotation @ skew(self._arm), sensors)
        estimate.update(rows, velocity.tolist(), [self.config.velocity_std**2] * 3)
        arm = estimate.rotation(0) @ self._arm
        position = estimate.position(1) - estimate.position(0) - arm
        rows = difference_rows(position_row, arm)
        s, nis = estimate.update(rows, position.tolist(), [self.config.position_std**2] * 3)
        details = Details({"velocity_innovation": velocity.tolist()})
        return Outcome(position, s, nis, True, details)

    def _same_axes(self, estimate: JointEstimate) -> bool:
        """Return whether both sensors have the same axes, so that their rates can be averaged."""
        relative = estimate.rotation(0).T @ estimate.rotation(1)
        return float(np.trace(relative)) > 3.0 - 0.01


def difference_rows(
    state: Callable[[int, int], int], vector: FloatArray
) -> list[dict[int, float]]:
    """Return the rows of (second minus first) position or velocity minus ``vector``.

    ``state`` is `position_row` or `velocity_row`, ``vector`` (3,) what the first sensor's attitude
    turned, whose error is [vector x] phi.
    """
    attitude = -skew(vector)
    rows = []
    for i in range(3):
        row = {state(1, i): 1.0, state(0, i): -1.0}
        row.update({attitude_row(0, j): float(attitude[i, j]) for j in range(3)})
        rows.append(row)
    return rows


def add_bias(rows: list[dict[int, float]], slope: FloatArray, sensors: Sequence[int]) -> None:
    """Add the derivative (3, 3) by the gyro bias of each sensor whose rate was used."""
    for i, row in enumerate(rows):
        for sensor in sensors:
            row.update({gyro_bias_row(sensor, j): float(slope[i, j]) for j in range(3)})
