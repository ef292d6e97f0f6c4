"""Simulate a walk with a sensor on each foot, and keep the exact truth beside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from ..core.results.trajectory import FEET
from ..core.samples.series import FloatArray, ImuSeries, IntArray, PoseSeries, PressureSeries
from .air_pressure import BarometerConfig, barometers
from .clocks import ClockConfig, Sampling, sample_times
from .errors import SimulationError
from .footprints import Footprints, plan
from .magnetometer import MagnetometerConfig, Surroundings, sense_field
from .motion import ShoeMotion, Walker
from .passing import NO_PASSES, Passes, pass_plan, passes, tune
from .routes import Route, route
from .sampling import interval_means
from .sensors import SensorConfig, SensorErrors, draw_pair, measure
from .walk_config import WalkConfig

START_NS = 1_750_000_000_000_000_000
SIDES = (1, -1)


@dataclass(frozen=True)
class Walk:
    """The motion of both shoes, before any sensor looks at it.

    ``levers`` (two of (3,) m) and ``mountings`` (two of (3, 3), sensor to shoe) say where the left
    and the right sensor sit, on ``shoes``, the feet ``sides`` (+1 left, -1 right).
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

    def truth(self, sensor: int, time_s: FloatArray, stamp_ns: IntArray) -> PoseSeries:
        """Return the exact poses and velocities of a sensor at ``time_s`` (N,) s."""
        place = self.levers[sensor], self.mountings[sensor]
        moved = self.shoes[sensor].kinematics(time_s, *place)
        turned = Rotation.from_matrix(moved.rotation).as_quat()
        return PoseSeries(stamp_ns, moved.position, _continuous(turned), moved.velocity)


@dataclass(frozen=True)
class Simulation:
    """Two recordings and all that is known about them.

    Attributes
    ----------
    left, right : what the sensors put out, stamped by their own clocks, lost samples missing
    left_truth, right_truth : exact poses of the sensors' body frames (as published: the sensor's
        own axes, mounting rotation not undone) at every sampling instant, in true time
    left_arrival_ns, right_arrival_ns : (N,) true time at which each sample reached the host
    left_stances, right_stances : (M, 2) ns of true time, flat foot to heel-off
    moment_ns : (M,) true times of least distance, of the passes in ``walk.passes``
    left_errors, right_errors : what was drawn for the sensors
    pressure : what barometers put out, where there are any, by where they are worn
    """

    left: ImuSeries
    right: ImuSeries
    left_truth: PoseSeries
    right_truth: PoseSeries
    left_arrival_ns: IntArray
    right_arrival_ns: IntArray
    left_stances: IntArray
    right_stances: IntArray
    moment_ns: IntArray
    left_errors: SensorErrors
    right_errors: SensorErrors
    walk: Walk
    pressure: Mapping[str, PressureSeries] = field(default_factory=dict)


def walk(config: WalkConfig | None = None, seed: int = 0) -> Walk:
    """Return the motion of both shoes; the same configuration and seed give the same walk.

    Raises
    ------
    SimulationError
        When the route cannot be repeated or has no room for the stops.
    """
    config = config or WalkConfig()
    rngs = _generators(seed)
    line = route(config.route, config.laps)
    prints = plan(config, line, rngs["plan"])
    wanted = pass_plan(config, line, prints, rngs["pass"])
    walkers = (
        Walker(config, line, prints, SIDES[0], rngs["left shoe"]),
        Walker(config, line, prints, SIDES[1], rngs["right shoe"]),
    )
    tune(walkers, prints, wanted)
    shoes = (walkers[0].motion(), walkers[1].motion())
    found = passes(shoes, config, prints, wanted)
    mount = config.mount
    levers = (mount.lever_of(1), mount.lever_of(-1))
    mountings = (mount.rotation_of(1), mount.rotation_of(-1))
    return Walk(config, line, prints, shoes, levers, mountings, found)


def rigid_pair(walked: Walk, separation: float = 0.014) -> Walk:
    """Return the walk with both sensors on the right shoe, ``separation`` m apart along it.

    The "left" sensor is the hinder one; both share one mounting rotation (Chen et al. 2022).

    Raises
    ------
    SimulationError
        When the separation is not between 1 mm and 0.3 m.
    """
    if not 0.001 <= separation <= 0.3:
        raise SimulationError(f"separation is {separation:g} m; allowed is 0.001 to 0.3 m")
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


def simulate(
    walk_config: WalkConfig | Walk | None = None,
    sensor: SensorConfig | None = None,
    clock: ClockConfig | tuple[ClockConfig, ClockConfig] | None = None,
    seed: int = 0,
    barometer: BarometerConfig | None = None,
    magnetometer: MagnetometerConfig | None = None,
) -> Simulation:
    """Simulate a walk (or sense a given one) and return recordings and truth.

    ``clock`` is one for both devices or one each.  There is no pressure without ``barometer`` and
    no magnetic field without ``magnetometer``.  Walk, sensors, clocks, barometers, surroundings,
    and magnetometers draw from streams of their own: changing one does not change the others.

    Raises
    ------
    SimulationError
        When the walk cannot be made.
    """
    walked = walk_config if isinstance(walk_config, Walk) else walk(walk_config, seed)
    sensor = sensor or SensorConfig()
    clocks = clock if isinstance(clock, tuple) else (clock or ClockConfig(),) * 2
    rngs = _generators(seed)
    errors = draw_pair(sensor, (rngs["left errors"], rngs["right errors"]))
    recorded = [
        _record(walked, index, sensor, errors[index], clocks[index], rngs) for index in range(2)
    ]
    if magnetometer is not None:
        recorded = _with_fields(recorded, magnetometer, rngs)
    (left, left_truth, left_arrival), (right, right_truth, right_arrival) = (
        (each.series[each.kept], each.truth, each.arrival_ns[each.kept]) for each in recorded
    )
    pressure: dict[str, PressureSeries] = {}
    if barometer is not None:
        streams = rngs["left barometer"], rngs["right barometer"]
        pressure = barometers(walked, barometer, clocks, START_NS, streams)
    return Simulation(
        left=left,
        right=right,
        left_truth=left_truth,
        right_truth=right_truth,
        left_arrival_ns=left_arrival,
        right_arrival_ns=right_arrival,
        left_stances=nanoseconds(walked.footprints.stances_of(walked.sides[0])),
        right_stances=nanoseconds(walked.footprints.stances_of(walked.sides[1])),
        moment_ns=nanoseconds(walked.passes.time_s),
        left_errors=errors[0],
        right_errors=errors[1],
        walk=walked,
        pressure=pressure,
    )


class _Recorded(NamedTuple):
    """What one device measured; ``kept`` (N,) of it was not lost."""

    series: ImuSeries
    truth: PoseSeries
    arrival_ns: IntArray
    kept: NDArray[np.bool_]


def nanoseconds(time_s: FloatArray) -> IntArray:
    """Return true time in ns for seconds since the start of the walk."""
    return START_NS + np.round(np.asarray(time_s) * 1e9).astype(np.int64)


def _record(
    walked: Walk,
    index: int,
    sensor: SensorConfig,
    errors: SensorErrors,
    clock: ClockConfig,
    rngs: dict[str, np.random.Generator],
) -> _Recorded:
    """Return what one device measured, the truth, and when its samples arrived."""
    foot = ("left", "right")[index]
    rate = walked.config.rate
    times: Sampling = sample_times(clock, rate, walked.duration_s, START_NS, rngs[f"{foot} clock"])
    force, turn = walked.means(index, times.edges_s)
    ends = times.edges_s[1:]
    force, turn = measure(sensor, errors, ends, force, turn, rngs[f"{foot} noise"])
    truth = walked.truth(index, ends, times.true_ns(START_NS))
    series = ImuSeries(times.stamp_ns, force, turn)
    return _Recorded(series, truth, times.arrival_ns, times.kept)


def _with_fields(
    recorded: Sequence[_Recorded],
    config: MagnetometerConfig,
    rngs: dict[str, np.random.Generator],
) -> list[_Recorded]:
    """Return the recordings of both feet with the magnetic field."""
    surroundings = Surroundings(config, rngs["surroundings"])
    found = []
    for foot, each in zip(FEET, recorded, strict=True):
        field = sense_field(config, surroundings, each.truth, rngs[f"{foot} magnetometer"])
        found.append(each._replace(series=replace(each.series, magnetic_field=field)))
    return found


def _generators(seed: int) -> dict[str, np.random.Generator]:
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
