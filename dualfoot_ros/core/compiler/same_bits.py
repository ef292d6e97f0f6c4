"""Whether a compiled kernel computes what the kernel in Python computes, to the last bit.

A compiler may be told to keep to the order of operations and not do it.  So every entry runs once
in both forms on the same numbers before a library is used.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from ..kernel import interpreted
from ..kernel import layout as lay
from ..samples.series import FloatArray, IntArray

RING, EPOCHS = 32, 24
Calls = Mapping[str, Callable[..., Any]]


def same_bits(functions: Calls) -> bool:
    """Return whether ``functions``, the entries by name, have the bits of the kernel in Python."""
    plain = interpreted()._asdict()
    with np.errstate(all="ignore"):
        pairs = zip(_computed(functions), _computed(plain), strict=True)
        return all(ours == theirs for ours, theirs in pairs)


def _computed(functions: Calls) -> Iterator[bytes]:
    """Yield what every entry makes of the same numbers."""
    w, n = _numbers()
    out, samples, ring = np.zeros((EPOCHS, lay.OUT)), _walk(), np.zeros(RING, dtype=np.int64)
    stamps, parts = 10**7 * np.arange(EPOCHS), [samples[:, k : k + 3].copy() for k in (0, 3, 6, 9)]
    rows = [np.zeros((EPOCHS, columns)) for columns in (lay.KEPT, lay.KEPT, 2, *(6,) * 7)]
    kept = *rows[:3], -1.0, 1, *rows[3:]
    at = 1
    while at < EPOCHS:
        at = functions["advance"](w, n, ring, stamps, *parts, at, EPOCHS, *kept)
    functions["keep"](w, n, 0, *kept)
    yield w.tobytes() + n.tobytes() + ring.tobytes() + b"".join(each.tobytes() for each in rows)
    functions["set_flags"](n, 1, 0, EPOCHS - 2, 1)
    functions["restore"](w, n, 3)
    functions["rerun"](w, n, 3, EPOCHS - 2)
    functions["emit"](w, n, out, 0)
    yield from _told(functions, w, n, ring, samples)
    yield w.tobytes() + n.tobytes() + out.tobytes()
    for kind in (None, lay.KNOW_ALL, lay.KNOW_COMMON, lay.KEEP_PLACE, lay.KNOW_NOTHING):
        yield _updated(functions, w, kind)
    yield from _constrained(functions, w)
    yield from _ended(functions, w, n)
    for foot in range(2):
        functions["turn"](w, 0, foot, 0.6, 0.8, np.array([0.3, 0.7]), np.array([1.0, 2.0, 0.1]))
    yield w.tobytes()
    x = np.zeros(lay.X_SIZE)
    x[lay.M_R : lay.M_AXES] = [0.9, 0.5, -0.1, 0.4, 0.1, 0.02, 0.1, 0.3, 0.05, 0.02, 0.05, 0.2]
    functions["closest"](x, 0.7, 0.05)
    yield x.tobytes()


def _told(
    functions: Calls, w: FloatArray, n: IntArray, ring: IntArray, samples: FloatArray
) -> Iterator[bytes]:
    """Yield what is told of the newest epoch, and of two more."""
    told = np.zeros((1, lay.TOLD))
    functions["emit"](w, n, told, 0)
    numbers = functions["tell"](w, told)
    yield np.append(told, numbers).tobytes()
    done = functions["step"](w, n, ring, 7, 0.01, samples[0], told)
    yield np.append(told, done).tobytes() + ring.tobytes()
    n[lay.N_LONGEST] = 10**8
    done = functions["take_pair"](w, n, ring, 10**7, samples[1], told)
    yield np.append(told, done).tobytes() + ring.tobytes()


def _updated(functions: Calls, w: FloatArray, kind: int | None) -> bytes:
    """Return the state after an update of two rows; ``kind`` is what it leaves alone, if any."""
    rows = w[lay.S_H : lay.S_H + lay.ROWS_MOST * lay.JOINT].reshape(lay.ROWS_MOST, lay.JOINT)
    rows[:] = 0.0
    rows[0, [0, lay.SIDE, lay.E_ATT + 2]] = 1.0, -1.0, 0.2
    rows[1, [1, lay.SIDE + 1, lay.SIDE + lay.E_BG]] = 1.0, -1.0, 0.3
    x = np.zeros(lay.X_SIZE)
    if kind is None:
        functions["collect"](w, 2)
        w[lay.S_Y : lay.S_Y + 2] = 0.02, -0.03
        w[[lay.S_S, lay.S_S + 4]] += 0.01
        nis = functions["correct"](w, 2)
    else:
        x[lay.X_Y : lay.X_Y + 2], x[lay.X_NOISE : lay.X_NOISE + 2] = (0.02, -0.03), 0.01
        nis = functions["observe"](w, x, 2, kind)
    return w.tobytes() + np.append(x, nis).tobytes()


def _constrained(functions: Calls, w: FloatArray) -> Iterator[bytes]:
    """Yield the state after each constraint between the feet."""
    x = np.zeros(lay.X_SIZE)
    for lateral, kind in ((0, lay.KNOW_COMMON), (1, lay.KNOW_NOTHING)):
        nis = functions["constrain_spacing"](w, x, 0.6, 0.8, 0.15, 0.08, 0.15, lateral, kind)
        yield w.tobytes() + np.append(x, nis).tobytes()
    exceeds = functions["constrain_distance"](w, x, 0.1, 0.05, 1, 0, 0.0, 0.0, 0.0)
    yield w.tobytes() + np.append(x, exceeds).tobytes()
    learnt = np.zeros(lay.L_SIZE)
    learnt[lay.L_COVARIANCE : lay.L_BEGUN] = (0.01 * np.eye(4) + 0.001).ravel()
    for _ in range(2):
        functions["learn_spacing"](learnt, 0.3, 0.2, 0.1, 0.15, 0.6, 0.8)
    yield learnt.tobytes()


def _ended(functions: Calls, w: FloatArray, n: IntArray) -> Iterator[bytes]:
    """Yield what is found of a landing, and what every rule makes of the end of its stance."""
    functions["set_flags"](n, 0, 10, 20, 0)
    right = lay.N_FOOT + lay.N_STRIDE
    n[right + lay.N_START], n[right + lay.N_LEAVE] = 12, 19
    x, learnt = np.zeros(lay.X_SIZE), np.zeros(lay.L_SIZE)
    nis = functions["landing"](w, n, x, 1, 0.06)
    yield np.append(x, nis).tobytes()
    learnt[lay.L_STATE], learnt[lay.L_COVARIANCE] = 0.01, 0.01
    for kind, gate, since in (
        (lay.R_SPACING, 1e9, 0),
        (lay.R_DISTANCE, 1e9, 0),
        (lay.R_SPACING, 1e-9, 0),
        (lay.R_DISTANCE, 1e-9, 0),
        (lay.R_SPACING, 1e9, 20),
    ):
        rule = np.array([kind, 0.5, 1.0, 0.08, 0.15, 0.0, lay.KNOW_COMMON, 3.0, 1.0])
        done = functions["end_stance"](w, n, x, rule, learnt, 1, 0.6, 0.8, gate, since)
        distance = functions["distance_after"](w, x)
        yield np.append(x, (done, distance)).tobytes() + learnt.tobytes()
        yield w.tobytes() + n.tobytes()


def _numbers() -> tuple[FloatArray, IntArray]:
    """Return the arrays of a tracker that is under way."""
    rng = np.random.default_rng(7)
    w = np.zeros(lay.workspace_size(RING))
    n = np.zeros(lay.integer_size(RING), dtype=np.int64)
    n[lay.N_RING], n[lay.N_EPOCH] = RING, -1
    n[[lay.N_WINDOW, lay.N_MIN_STANCE, lay.N_MIN_SWING, lay.N_STILL]] = 3, 3, 2, 6
    n[[lay.N_SHORT_STANCE, lay.N_DECIMATE, lay.N_WALKING, lay.N_SETTLED, lay.N_STANDS]] = (
        2,
        1,
        9,
        4,
        8,
    )
    constants = slice(lay.C_GRAVITY, lay.C_FOOT)
    w[constants] = rng.uniform(1e-4, 2e-4, constants.stop - constants.start)
    w[lay.C_GRAVITY], w[lay.C_GLRT_FORCE], w[lay.C_GLRT_RATE] = 9.81, 300.0, 300.0
    w[[lay.C_GLRT_THRESHOLD, lay.C_WATCH, lay.C_ZUPT_CONSIDERS]] = 80.0, 1e9, 1.0
    w[lay.C_BIAS_KNOWN_VAR] = 1.0
    for foot in range(2):
        of_foot = lay.C_FOOT + foot * lay.C_STRIDE
        w[of_foot : of_foot + lay.C_STILL_RATE] = 0.02, -0.01, -0.05
        w[of_foot + lay.C_STILL_NORM], w[of_foot + lay.C_INCREMENTS] = 9.81, float(foot)
        w[foot * lay.FOOT + lay.ROT + np.array([0, 4, 8])] = 1.0
    joint = rng.normal(size=(30, 40)) * 0.05
    P = joint @ joint.T + 0.01 * np.eye(30)
    for start, part in ((lay.PLL, P[:15, :15]), (lay.PRR, P[15:, 15:]), (lay.PLR, P[:15, 15:])):
        w[start : start + lay.BLOCK].reshape(15, lay.ROW)[:, :15] = part
    return w, n


def _walk() -> FloatArray:
    """Return samples (EPOCHS, 12) of feet that stand and swing in turn."""
    rng = np.random.default_rng(8)
    values = 0.02 * rng.normal(size=(EPOCHS, 12))
    values[:, [2, 8]] += 9.81
    for foot, swings in enumerate((slice(4, 9), slice(10, 15))):
        values[swings, 6 * foot : 6 * foot + 6] += rng.normal(size=(5, 6)) * [4, 3, 6, 1, 4, 1]
    return values
