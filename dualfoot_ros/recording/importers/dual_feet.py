"""The dual-feet data set of Ma and Särkkä (IPIN 2023): one .mat file a walk.

``imu0L`` and ``imu0R`` hold ``acc`` (m/s^2), ``gyros`` (rad/s), ``mag`` (nT), axes
right-front-up, and ``sT``, the microseconds of the device as a 32-bit counter.  The body here is
forward-left-up: forward = y, left = -x, up = z.  The device stamps are kept.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ...core import (
    RIGHT_FRONT_UP,
    FloatArray,
    ImuSeries,
    Increments,
    IntArray,
    RecordingError,
    axes_matrix,
)
from ..recording import Recording
from ..reference import Reference
from .dual_feet_walks import reference_of
from .options import ImportOptions
from .sample_counter import same_wrap, unwrap_us

NANOTESLA = 1e-9
FEET = {"left": "imu0L", "right": "imu0R"}


def load(options: ImportOptions) -> Recording:
    """Load the one .mat file of ``options``.

    Raises
    ------
    RecordingError
        When it is no such file; names the variable that is missing or of the wrong shape.
    """
    if len(options.sources) != 1 or options.left or options.right:
        raise RecordingError(
            "a dual-feet walk is one .mat file that holds both feet; give exactly one, without "
            "--left and --right"
        )
    path = options.sources[0]
    walk = _read(path)
    left_ns, right_ns = same_wrap(_stamps(walk, path, "left"), _stamps(walk, path, "right"))
    return Recording(
        left=_series(walk, path, "left", left_ns),
        right=_series(walk, path, "right", right_ns),
        reference=_reference(walk),
        notes={
            "source": path.name,
            "format": "dual-feet",
            "stamp_source": "sT, microseconds of each device's own clock, unwrapped",
            "axes": "right-front-up in the file, forward-left-up here (forward = y, left = -x)",
        },
    )


def _read(path: Path) -> dict[str, Any]:
    from scipy.io import loadmat

    try:
        content: dict[str, Any] = loadmat(path, squeeze_me=True, struct_as_record=False)
    except OSError:
        raise
    except Exception as error:  # a broken file leads the reader to raise nearly anything
        reason = " ".join(str(error).split()) or type(error).__name__
        raise RecordingError(f"'{path}' is no readable .mat file ({reason})") from error
    return content


def _reference(walk: dict[str, Any]) -> Reference | None:
    direction = np.ravel(walk.get("pathdirec", 0))
    clockwise = direction.dtype.kind in "fiu" and direction.size == 1 and direction[0] < 0
    return reference_of(str(walk.get("pathshape", "")), -1 if clockwise else 1)


def _field(walk: dict[str, Any], path: Path, foot: str, name: str) -> FloatArray:
    value = getattr(walk.get(FEET[foot]), name, None)
    if value is None:
        raise RecordingError(
            f"'{path}' has no '{FEET[foot]}.{name}'; allowed is a walk of the dual-feet data set"
        )
    return np.asarray(value, dtype=np.float64)


def _stamps(walk: dict[str, Any], path: Path, foot: str) -> IntArray:
    stamps = _field(walk, path, foot, "sT")
    if stamps.ndim != 1 or not np.isfinite(stamps).all():
        raise RecordingError(
            f"'{path}': '{FEET[foot]}.sT' is of shape {stamps.shape} or not finite; allowed is "
            "(N,) microseconds"
        )
    return unwrap_us(stamps)


def _series(walk: dict[str, Any], path: Path, foot: str, stamp_ns: IntArray) -> ImuSeries:
    turn = np.array(axes_matrix(RIGHT_FRONT_UP)).T
    columns = {}
    for name in ("acc", "gyros", "mag"):
        column = _field(walk, path, foot, name)
        if column.shape != (len(stamp_ns), 3):
            raise RecordingError(
                f"'{path}': '{FEET[foot]}.{name}' is of shape {column.shape}; with "
                f"{len(stamp_ns)} stamps allowed is ({len(stamp_ns)}, 3)"
            )
        columns[name] = column @ turn
    field = columns["mag"] * NANOTESLA
    kind = Increments.COMPENSATED  # Xsens DOT
    return ImuSeries(stamp_ns, columns["acc"], columns["gyros"], field, kind)
