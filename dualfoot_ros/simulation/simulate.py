"""Simulation of two sensors on a walk, with the exact truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..core import FEET, ImuSeries, Increments, IntArray, PoseSeries, PressureSeries
from .air_pressure import BarometerConfig, barometers
from .clocks import ClockConfig, Sampling, sample_times
from .magnetometer import MagnetometerConfig, Surroundings, sense_field
from .sensors import SensorConfig, SensorErrors, draw_pair, measure
from .walk import START_NS, Walk, generators, nanoseconds, walk
from .walk_config import WalkConfig


@dataclass(frozen=True)
class Simulation:
    """The recordings of both sensors, with the exact truth and the drawn errors.

    Attributes
    ----------
    left, right : samples of the sensors, stamped by their own clocks, lost samples missing
    left_truth, right_truth : exact poses of the sensors' body frames (as published: the sensor's
        own axes, mounting rotation not undone) at every sampling instant, in true time
    left_arrival_ns, right_arrival_ns : (N,) true time at which each sample reached the host
    left_stances, right_stances : (M, 2) ns of true time, flat foot to heel-off
    moment_ns : (M,) true times of least distance, of the passes in ``walk.passes``
    left_errors, right_errors : errors drawn for the sensors
    pressure : air pressure by where the barometer is worn; empty without barometers
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
    rngs = generators(seed)
    errors = draw_pair(sensor, (rngs["left errors"], rngs["right errors"]))
    recorded = [
        _record(walked, index, sensor, errors[index], clocks[index], rngs) for index in range(2)
    ]
    if magnetometer is not None:
        recorded = _with_fields(recorded, magnetometer, rngs)
    (left, left_truth, left_arrival), (right, right_truth, right_arrival) = (
        (device.series[device.kept], device.truth, device.arrival_ns[device.kept])
        for device in recorded
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
    """The samples of one device; ``kept`` (N,) is False where one was lost."""

    series: ImuSeries
    truth: PoseSeries
    arrival_ns: IntArray
    kept: NDArray[np.bool_]


def _record(
    walked: Walk,
    index: int,
    sensor: SensorConfig,
    errors: SensorErrors,
    clock: ClockConfig,
    rngs: dict[str, np.random.Generator],
) -> _Recorded:
    """Return samples, truth and arrival times of one device."""
    foot = ("left", "right")[index]
    rate = walked.config.rate
    times: Sampling = sample_times(clock, rate, walked.duration_s, START_NS, rngs[f"{foot} clock"])
    kind = Increments(sensor.increments)
    force, turn = walked.sensed(index, times.edges_s, kind)
    ends = times.edges_s[1:]
    force, turn = measure(sensor, errors, ends, force, turn, rngs[f"{foot} noise"])
    truth = walked.truth(index, ends, times.true_ns(START_NS))
    series = ImuSeries(times.stamp_ns, force, turn, increments=kind)
    return _Recorded(series, truth, times.arrival_ns, times.kept)


def _with_fields(
    recorded: Sequence[_Recorded],
    config: MagnetometerConfig,
    rngs: dict[str, np.random.Generator],
) -> list[_Recorded]:
    """Return the recordings of both feet with the magnetic field."""
    surroundings = Surroundings(config, rngs["surroundings"])
    sensed = []
    for foot, device in zip(FEET, recorded, strict=True):
        field = sense_field(config, surroundings, device.truth, rngs[f"{foot} magnetometer"])
        sensed.append(device._replace(series=replace(device.series, magnetic_field=field)))
    return sensed
