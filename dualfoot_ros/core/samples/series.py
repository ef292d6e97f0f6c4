"""What flows in: samples of one inertial sensor, and synchronised pairs of the two feet."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import SeriesError
from .increments import Increments
from .large_arrays import contiguous

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True)
class ImuSeries:
    """A recording of one inertial sensor in its body frame (forward-left-up).

    Attributes
    ----------
    stamp_ns : (N,) int64, nanoseconds of any clock
    specific_force : (N, 3) m/s^2, what the accelerometer reads (+g upwards when standing)
    angular_rate : (N, 3) rad/s
    magnetic_field : (N, 3) T, or None
    increments : what the samples are, None where their source does not say

    Raises
    ------
    SeriesError
        When the lengths or shapes do not fit together.
    """

    stamp_ns: IntArray
    specific_force: FloatArray
    angular_rate: FloatArray
    magnetic_field: FloatArray | None = None
    increments: Increments | None = None

    def __post_init__(self) -> None:
        """Bring every array to its type and check that the shapes agree."""
        stamps = contiguous(self.stamp_ns, np.int64)
        if stamps.ndim != 1:
            raise SeriesError(f"stamp_ns has shape {stamps.shape}; allowed is (N,)")
        object.__setattr__(self, "stamp_ns", stamps)
        for name in ("specific_force", "angular_rate", "magnetic_field"):
            value = getattr(self, name)
            if value is None and name == "magnetic_field":
                continue
            array = contiguous(value, np.float64)
            if array.shape != (len(stamps), 3):
                raise SeriesError(
                    f"{name} has shape {array.shape}; with {len(stamps)} stamps allowed is "
                    f"({len(stamps)}, 3)"
                )
            object.__setattr__(self, name, array)

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.stamp_ns)

    def __getitem__(self, index: slice | NDArray[Any]) -> ImuSeries:
        """Return the part of the series that a slice or a mask selects."""
        field = self.magnetic_field
        return replace(
            self,
            stamp_ns=self.stamp_ns[index],
            specific_force=self.specific_force[index],
            angular_rate=self.angular_rate[index],
            magnetic_field=None if field is None else field[index],
        )

    @property
    def field(self) -> FieldSeries | None:
        """The magnetic field where it was measured (rows that are nan were not), or None."""
        if self.magnetic_field is None:
            return None
        there = ~np.isnan(self.magnetic_field).all(axis=1)
        return FieldSeries(self.stamp_ns[there], self.magnetic_field[there])

    @property
    def duration_s(self) -> float:
        """Seconds from the first to the last stamp (0 for fewer than two samples)."""
        return (int(self.stamp_ns[-1]) - int(self.stamp_ns[0])) * 1e-9 if len(self) > 1 else 0.0

    @property
    def rate_hz(self) -> float:
        """Sampling rate from the median interval (nan for fewer than two samples)."""
        if len(self) < 2:
            return float("nan")
        interval = float(np.median(np.diff(self.stamp_ns)))
        return 1e9 / interval if interval > 0 else float("nan")


class ImuPair(NamedTuple):
    """One synchronised pair of samples.

    ``values`` is (12,): specific force (m/s^2) and angular rate (rad/s) of the left foot, then
    the same of the right foot; all six of a foot that has no sample at this time are NaN.
    """

    stamp_ns: int
    values: FloatArray

    @property
    def present(self) -> tuple[bool, bool]:
        """Whether the left and the right foot have a sample."""
        left, right = self.values[:6], self.values[6:]
        return not np.isnan(left).all(), not np.isnan(right).all()

    @classmethod
    def of(
        cls,
        stamp_ns: int,
        left_force: FloatArray,
        left_rate: FloatArray,
        right_force: FloatArray,
        right_rate: FloatArray,
    ) -> ImuPair:
        """Build a pair from four (3,) vectors."""
        values = np.empty(12)
        values[0:3] = left_force
        values[3:6] = left_rate
        values[6:9] = right_force
        values[9:12] = right_rate
        return cls(int(stamp_ns), values)


def require_equal_stamps(left: ImuSeries, right: ImuSeries) -> None:
    """Raise SeriesError when two series do not have the same stamps."""
    if not np.array_equal(left.stamp_ns, right.stamp_ns):
        raise SeriesError(
            f"left ({len(left)} samples) and right ({len(right)} samples) do not have equal "
            "stamps; bring them on one grid with dualfoot_ros.timing.pairing.batch first"
        )


def stack_pairs(left: ImuSeries, right: ImuSeries) -> FloatArray:
    """Return (N, 12) values as in :class:`ImuPair`; the series must share their stamps.

    Rows in which a foot is missing have NaN in all six of its values.

    Raises
    ------
    SeriesError
        When the two series do not have the same stamps.
    """
    require_equal_stamps(left, right)
    return np.hstack(
        [left.specific_force, left.angular_rate, right.specific_force, right.angular_rate]
    )


@dataclass(frozen=True)
class PoseSeries:
    """Poses over time, of a reference or of an estimate, in a level frame with z up.

    Attributes
    ----------
    stamp_ns : (N,) int64
    position : (N, 3) m
    quaternion : (N, 4) body to navigation, Hamilton, x y z w
    velocity : (N, 3) m/s in the navigation frame, or None
    """

    stamp_ns: IntArray
    position: FloatArray
    quaternion: FloatArray
    velocity: FloatArray | None = None

    def __len__(self) -> int:
        """Return the number of poses."""
        return len(self.stamp_ns)


@dataclass(frozen=True)
class PressureSeries:
    """Air pressure over time.

    Attributes
    ----------
    stamp_ns : (N,) int64, of the same clock as the samples of the feet
    pressure : (N,) Pa

    Raises
    ------
    SeriesError
        When the two do not have the same length.
    """

    stamp_ns: IntArray
    pressure: FloatArray

    def __post_init__(self) -> None:
        """Bring both arrays to their types and check that the lengths agree."""
        stamps, pressure = _checked(self.stamp_ns, "pressure", self.pressure, ())
        object.__setattr__(self, "stamp_ns", stamps)
        object.__setattr__(self, "pressure", pressure)

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.stamp_ns)


@dataclass(frozen=True)
class FieldSeries:
    """The magnetic field over time, in the axes of a foot's sensor (forward-left-up).

    Attributes
    ----------
    stamp_ns : (N,) int64, of the same clock as the samples of the feet
    tesla : (N, 3) T

    Raises
    ------
    SeriesError
        When the two do not have the same length.
    """

    stamp_ns: IntArray
    tesla: FloatArray

    def __post_init__(self) -> None:
        """Bring both arrays to their types and check that the shapes agree."""
        stamps, tesla = _checked(self.stamp_ns, "tesla", self.tesla, (3,))
        object.__setattr__(self, "stamp_ns", stamps)
        object.__setattr__(self, "tesla", tesla)

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.stamp_ns)


def _checked(
    stamp_ns: IntArray, name: str, values: FloatArray, columns: tuple[int, ...]
) -> tuple[IntArray, FloatArray]:
    """Return stamps (N,) and ``values`` (N, *columns) as arrays of their types."""
    stamps = contiguous(stamp_ns, np.int64)
    array = contiguous(values, np.float64)
    if stamps.ndim != 1 or array.shape != (len(stamps), *columns):
        allowed = "(N,) for both" if not columns else f"(N,) and (N, {columns[0]})"
        raise SeriesError(
            f"stamp_ns has shape {stamps.shape} and {name} {array.shape}; allowed is {allowed}"
        )
    return stamps, array
