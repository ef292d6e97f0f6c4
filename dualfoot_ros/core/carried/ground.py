"""The ground under both feet: at rest, or a floor that moves, as the filter's state has it."""

from __future__ import annotations

import numpy as np

from ..joint_estimate import JointEstimate, Outcome
from ..kernel import Workspace
from ..kernel import layout as lay
from ..results.payloads import FloorKind, Ride
from ..samples.series import FloatArray


class Ground:
    """Reads and changes the velocity of the floor in a workspace."""

    def __init__(self, space: Workspace) -> None:
        """Look at ``space``."""
        self._space = space

    @property
    def velocity(self) -> FloatArray:
        """Velocity (3,) of the floor, m/s, in the navigation frame."""
        return self._space.w[lay.FLOOR_VEL : lay.FLOOR_VEL + 3].copy()

    @property
    def seconds(self) -> float:
        """Time since the floor has moved, s."""
        return float(self._space.w[lay.FLOOR_S])

    def move(
        self, velocity: FloatArray, std: float, up_std: float, seconds: float | None = None
    ) -> None:
        """Let the floor move with ``velocity`` (3,) m/s, known to ``std`` and ``up_std`` m/s.

        ``seconds`` is for how long it has done so, where that is to be changed; what that makes
        uncertain is added.
        """
        w = self._space.w
        w[lay.FLOOR_VEL : lay.FLOOR_VEL + 3] = velocity
        w[lay.FLOOR_STD], w[lay.FLOOR_UP_STD] = std, up_std
        if seconds is not None:
            w[lay.FLOOR_S] = seconds
            self.blur(lay.E_POS, std * seconds, up_std * seconds)

    def rest(self) -> None:
        """Let the floor be at rest."""
        self.move(np.zeros(3), 0.0, 0.0, 0.0)

    def shift(self, up_m: float) -> None:
        """Move both feet up."""
        w = self._space.w
        w[lay.POS + 2] += up_m
        w[lay.FOOT + lay.POS + 2] += up_m

    def blur(self, state: int, std: float, up_std: float) -> None:
        """Make a vector of both feet's error states uncertain by the same, besides."""
        w = self._space.w
        for axis, each in enumerate((std, std, up_std)):
            for block in (lay.PLL, lay.PRR, lay.PLR):
                w[block + lay.DIAGONAL * (state + axis)] += each**2

    def change(self, _: JointEstimate, by: FloatArray, ride: Ride) -> Outcome:
        """Go over to a floor that moves by ``by`` (3,) m/s faster; nothing in the world changes.

        The velocities of the feet are against the floor, so they change by the opposite.
        """
        w = self._space.w
        for foot in range(2):
            start = foot * lay.FOOT + lay.VEL
            w[start : start + 3] -= by
        self.blur(lay.E_VEL, ride.std, ride.std)
        if ride.over:
            self.rest()
        else:
            self.move(np.array(ride.velocity), ride.std, ride.up_std, 0.0)
        return Outcome(by, np.eye(3) * ride.std**2, 0.0, True, ride)

    def ride(self, kind: FloorKind, *, over: bool = False) -> Ride:
        """Return what is known of the floor."""
        w = self._space.w
        x, y, z = (float(v) for v in self.velocity)
        level, up = float(w[lay.FLOOR_STD]), float(w[lay.FLOOR_UP_STD])
        return Ride(kind, (x, y, z), level, up, self.seconds, over)
