"""The facade: synchronised pairs in, both feet's estimates and events out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from .aids import AidInputs
from .alignment import BiasPrior
from .batch_run import BatchRun
from .config import TrackerConfig
from .errors import AlignmentError, ConfigError, SnapshotError
from .pair_stream import PairStream
from .results.events import FEET
from .results.payloads import Reason
from .results.trajectory import Trajectory
from .results.update import Update
from .samples.increments import Increments
from .samples.series import (
    FieldSeries,
    FloatArray,
    ImuPair,
    ImuSeries,
    PressureSeries,
    require_equal_stamps,
)
from .session import given_pose


class DualFootTracker:
    """Tracks both feet of a walking person from synchronised pairs of samples.

    ``engine`` is "auto" (live starts interpreted and goes over to the compiled kernel when it is
    ready), "compiled" or "interpreted"; all three give the same bits.

    Raises
    ------
    ConfigError
        For an unknown ``engine``.
    """

    def __init__(self, config: TrackerConfig | None = None, *, engine: str = "auto") -> None:
        """Start aligning with the first pair."""
        self.config = config or TrackerConfig()
        counters: Counter[str] = Counter()
        self._inputs = AidInputs(self.config.aids, counters)
        self._stream = PairStream(self.config, counters, self._inputs, engine)

    def use_engine(self, engine: str) -> None:
        """Go on with another form of the kernel: "auto", "compiled" or "interpreted".

        Raises
        ------
        ConfigError
            For any other ``engine``.
        """
        self._stream.use_engine(engine)

    def save(self) -> bytes:
        """Return a snapshot of all that the tracker is, to go on from it by `load`."""
        from .snapshot import dump  # here: few runs are to go on from a snapshot

        return dump(self, self.config.to_mapping())

    @classmethod
    def load(cls, snapshot: bytes, *, engine: str = "auto") -> DualFootTracker:
        """Return the tracker of a ``snapshot``; it goes on as that one would have, bit for bit.

        Raises
        ------
        SnapshotError
            When the snapshot is damaged, or of another version.
        ConfigError
            For an unknown ``engine``.
        """
        from .snapshot import restore

        tracker = restore(snapshot)
        if not isinstance(tracker, cls):
            raise SnapshotError("the snapshot is not that of a tracker")
        tracker.use_engine(engine)
        return tracker

    @property
    def engine(self) -> str:
        """Which form of the kernel runs: "interpreted" or "compiled"."""
        return self._stream.engine.name

    @property
    def counters(self) -> Counter[str]:
        """What became of the pairs, and of what the aids were given, by name: until now."""
        return self._stream.counters

    @property
    def phase(self) -> str:
        """The phase: "aligning", "standing" (aligned, still refining) or "walking"."""
        return self._stream.phase

    @property
    def spacing(self) -> tuple[float, float] | None:
        """Distance of the feet side by side, given or learnt, and its standard deviation, m."""
        return self._stream.session.spacing if self._stream.session else None

    @property
    def complaint(self) -> str | None:
        """Why the last window of the alignment was no standstill, if it was not."""
        return self._stream.alignment.complaint

    def reset(self, stamp_ns: int | None = None, reason: Reason = Reason.ASKED_FOR) -> None:
        """Forget everything but the counters and align anew."""
        self._stream.reset(0 if stamp_ns is None else stamp_ns, reason)

    def retune(self, config: TrackerConfig) -> None:
        """Go on with the weights, thresholds, aids and distances of ``config``.

        What else it changes holds from the next alignment on; the method must be the same.

        Raises
        ------
        ConfigError
            When the method is another one.
        """
        if config.method != self.config.method:
            raise ConfigError(
                f"method is {config.method}; a running tracker keeps to {self.config.method}"
            )
        self.config = config
        self._stream.retune(config)

    def set_pose(
        self, position: Sequence[float], yaw: float, covariance: FloatArray | None = None
    ) -> None:
        """Move and turn both tracks so that the person is at ``position`` (3,) m facing ``yaw``.

        ``covariance`` (4, 4) of x, y, z (m) and yaw (rad) says how well that is known; without it
        the tracks keep theirs.  Takes effect with the next pair that is tracked.

        Raises
        ------
        ConfigError
            When ``position`` is not three finite numbers, ``yaw`` is not finite, or ``covariance``
            is none.
        """
        self._stream.set_pose(given_pose(position, yaw, covariance))

    def add(self, pair: ImuPair) -> Update:
        """Take one pair; total: bad data gives a counted, named refusal, never an exception."""
        return self._stream.add(pair)

    def declare_increments(self, foot: str, kind: Increments | None) -> None:
        """Take note what the samples of "left" or "right" are, as their source says.

        It holds from the next alignment on; ``increments`` in the configuration wins over it.
        """
        self._stream.increments[foot] = kind

    def declare_bias(self, foot: str, prior: BiasPrior | None) -> None:
        """Take what is known of the gyro bias of "left" or "right" before the walk.

        It holds from the next alignment on.
        """
        stream = self._stream
        stream.priors.pop(foot, None)
        if prior is not None:
            stream.priors[foot] = prior
        if stream.session is None:
            stream.align_anew()

    def add_pressure(self, worn: str, stamp_ns: int, pascal: float) -> str | None:
        """Take air pressure (Pa) of a sensor worn on "left" or "right", or on the body for "both".

        It is used when ``aids.barometer`` is on; the stamp is of the clock of the pairs.  Returns
        the name of why it was refused, if it was; all is counted.

        Raises
        ------
        ConfigError
            When ``worn`` is none of these.
        """
        refused = self._inputs.take_pressure(worn, int(stamp_ns), float(pascal))
        self._inputs.trim()
        return refused

    def add_magnetic_field(
        self, foot: str, stamp_ns: int, tesla: Sequence[float] | FloatArray
    ) -> str | None:
        """Take the field (3,) T in the axes of the sensor on "left" or "right", forward-left-up.

        It is used when ``aids.magnetic_heading`` is on; the stamp is of the clock of the pairs.
        Returns the name of why it was refused, if it was; all is counted.

        Raises
        ------
        ConfigError
            When ``foot`` is none of these, or ``tesla`` are not three numbers.
        """
        refused = self._inputs.take_field(foot, int(stamp_ns), tesla)
        self._inputs.trim()
        return refused

    def run(
        self,
        left: ImuSeries,
        right: ImuSeries,
        pressure: Mapping[str, PressureSeries] | None = None,
        fields: Mapping[str, FieldSeries] | None = None,
        *,
        covariances: bool = True,
    ) -> Trajectory:
        """Track two series with equal stamps; the same bits as `add`, one by one.

        ``pressure`` is air pressure by "left", "right" or "both", for the barometer aid;
        ``fields`` the magnetic field by "left" or "right" as it was measured, for the magnetic
        heading (default: that of the series).  Without ``covariances`` the trajectory needs a
        third of the memory, and has nan in their place.

        Raises
        ------
        SeriesError
            When the series do not have the same stamps.
        AlignmentError
            When there is no standstill to align from.
        ConfigError
            When ``pressure`` or ``fields`` has another key.
        """
        require_equal_stamps(left, right)
        for foot, imu in zip(FEET, (left, right), strict=True):
            if imu.increments is not None:
                self.declare_increments(foot, imu.increments)
        self._stream.wait_for_engine()
        for worn, series in (pressure or {}).items():
            for stamp, pascal in zip(series.stamp_ns, series.pressure, strict=True):
                self._inputs.take_pressure(worn, int(stamp), float(pascal))
        for foot, field in (fields_of(left, right) if fields is None else fields).items():
            self._inputs.take_fields(foot, field)
        batch = BatchRun(left, right, covariances)
        batch.run(self._stream)
        if batch.is_empty:
            raise AlignmentError(self._no_start(left))
        return batch.trajectory(self.counters, self.config.method)

    def _no_start(self, left: ImuSeries) -> str:
        if self._stream.alignment.finish() is not None:
            return f"the recording is {left.duration_s:.1f} s long and ends while the feet stand"
        seen = self.complaint or f"the recording is {left.duration_s:.1f} s long"
        return (
            f"neither a standstill of both feet nor a stance of each was found ({seen}); stand "
            "still with both feet on the ground at the start, and check units and axes"
        )


def fields_of(left: ImuSeries, right: ImuSeries) -> dict[str, FieldSeries]:
    """Return the magnetic field of the feet that have one."""
    found = zip(FEET, (left.field, right.field), strict=True)
    return {foot: field for foot, field in found if field is not None and len(field)}
