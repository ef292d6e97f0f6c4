"""The motion of both shoes on a walk, from which sensors and truth are simulated."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..core import FloatArray, Increments, IntArray, PoseSeries, SimulationError
from .footprints import Footprints, plan
from .motion import Walker
from .passing import NO_PASSES, SIDES, Passes, pass_plan, passes, tuned
from .routes import Route, route
from .sampling import interval_means, sensed
from .shoe import ShoeMotion
from .walk_config import WalkConfig

START_NS = 1_750_000_000_000_000_000
SEPARATIONS_M = (0.001, 0.3)  # of two sensors on one shoe


@dataclass(frozen=True)
class Walk:
    """The motion of both shoes and the mountings of the sensors on them.

    ``levers`` (two of (3,) m) and ``mountings`` (two of (3, 3), sensor to shoe) are the places of
    the left and the right sensor, on ``shoes``, the feet ``sides`` (+1 left, -1 right).
    """

    config: WalkConfig
    route: Route
    footprints: Footprints
    shoes: tuple[ShoeMotion, ShoeMotion]
    levers: tuple[FloatArray, FloatArray]
    mountings: tuple[FloatArray, FloatArray]
    passes: Passes
    sides: tuple[int, int] = SIDES

    @property
    def duration_s(self) -> float:
        """Length of the walk with its standstills, s."""
        return self.footprints.end_s

    def means(self, sensor: int, edges_s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return true mean specific force and rate (N, 3) of sensor 0 (left) or 1 (right)."""
        place = self.levers[sensor], self.mountings[sensor]
        return interval_means(self.shoes[sensor], *place, edges_s)

    def sensed(
        self, sensor: int, edges_s: FloatArray, kind: Increments
    ) -> tuple[FloatArray, FloatArray]:
        """Return true force and rate (N, 3) of sensor 0 (left) or 1 (right), of that kind."""
        place = self.levers[sensor], self.mountings[sensor]
        return sensed(self.shoes[sensor], *place, edges_s, kind)

    def truth(self, sensor: int, time_s: FloatArray, stamp_ns: IntArray) -> PoseSeries:
        """Return the exact poses and velocities of a sensor at ``time_s`` (N,) s."""
        from scipy.spatial.transform import Rotation

        place = self.levers[sensor], self.mountings[sensor]
        moved = self.shoes[sensor].poses(time_s, *place)
        turned = Rotation.from_matrix(moved.rotation).as_quat()
        return PoseSeries(stamp_ns, moved.position, _continuous(turned), moved.velocity)


def walk(config: WalkConfig | None = None, seed: int = 0) -> Walk:
    """Return the motion of both shoes; the same configuration and seed give the same walk.

    Raises
    ------
    SimulationError
        When the route cannot be repeated or has no room for the stops.
    """
    config = config or WalkConfig()
    rngs = generators(seed)
    line = route(config.route, config.laps)
    prints = plan(config, line, rngs["plan"])
    wanted = pass_plan(config, line, prints, rngs["pass"])
    walkers = (
        Walker(config, line, prints, SIDES[0], rngs["left shoe"]),
        Walker(config, line, prints, SIDES[1], rngs["right shoe"]),
    )
    shoes = tuned(walkers, prints, wanted)
    true_passes = passes(shoes, config, prints, wanted)
    mount = config.mount
    levers = (mount.lever_of(1), mount.lever_of(-1))
    mountings = (mount.rotation_of(1), mount.rotation_of(-1))
    return Walk(config, line, prints, shoes, levers, mountings, true_passes)


def rigid_pair(walked: Walk, separation: float = 0.014) -> Walk:
    """Return the walk with both sensors on the right shoe, ``separation`` m apart along it.

    The "left" sensor is the hinder one; both share one mounting rotation (Chen et al. 2022).

    Raises
    ------
    SimulationError
        When the separation is not between 1 mm and 0.3 m.
    """
    least, most = SEPARATIONS_M
    if not least <= separation <= most:
        raise SimulationError(
            f"separation is {separation:g} m; allowed is {least:g} to {most:g} m"
        )
    shoe, lever, mounting = walked.shoes[1], walked.levers[1], walked.mountings[1]
    half = np.array([0.5 * separation, 0.0, 0.0])
    return replace(
        walked,
        shoes=(shoe, shoe),
        levers=(lever - half, lever + half),
        mountings=(mounting, mounting),
        passes=NO_PASSES,
        sides=(-1, -1),
    )


def nanoseconds(time_s: FloatArray) -> IntArray:
    """Return true time in ns for seconds since the start of the walk."""
    return START_NS + np.round(np.asarray(time_s) * 1e9).astype(np.int64)


def generators(seed: int) -> dict[str, np.random.Generator]:
    """Return one independent generator a purpose; adding a purpose at the end changes no other."""
    names = (
        "plan", "pass", "left shoe", "right shoe", "left errors", "right errors",
        "left noise", "right noise", "left clock", "right clock",
        "left barometer", "right barometer",
        "surroundings", "left magnetometer", "right magnetometer",
    )  # fmt: skip
    children = np.random.SeedSequence(seed).spawn(len(names))
    return {
        name: np.random.Generator(np.random.PCG64(child))
        for name, child in zip(names, children, strict=True)
    }


def _continuous(quaternion: FloatArray) -> FloatArray:
    """Return the quaternions (N, 4) with signs such that neighbours are close."""
    turn = np.einsum("ni,ni->n", quaternion[1:], quaternion[:-1])
    sign = np.cumprod(np.append(1.0, np.where(turn < 0.0, -1.0, 1.0)))
    return quaternion * sign[:, None]
