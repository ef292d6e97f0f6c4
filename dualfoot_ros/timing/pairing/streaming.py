"""Pairs with equal stamps from two streams, sample by sample.

The grid is either the stamps of one foot, whose samples then pass unchanged while the other foot
is interpolated (or held, ``between``) onto them (``rate`` 0: no rate has to be known or
estimated, a sensor clock that is off or drifts is followed, and streams that share their stamps
pass untouched), or it is uniform from the first common stamp on (``rate`` above 0: both feet are
interpolated).
Nothing looks at arrival times, so any interleaving whose lateness is below ``max_delay`` gives
the same pairs, bit for bit those of :func:`dualfoot_ros.timing.pairing.batch`.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...core import FEET, FloatArray, ImuPair
from .grid import grid_of
from .pairing_config import AlignerConfig
from .sample_buffer import WAIT, BufferedSample, SampleBuffer
from .stream_gate import Gate, all_finite

OUTCOMES = ("pairs", "interpolated", "in_gap", "late", "outside", "restarts")


class Aligner:
    """Turn two streams of samples into pairs with equal stamps, with bounded memory and delay.

    ``counters`` holds for each foot ``left_accepted``, ``left_not_finite``, ``left_duplicate``,
    ``left_out_of_order``, ``left_gap``, and of the grid ``pairs``, ``interpolated`` (pairs in
    which a foot was, or was held), ``in_gap`` (dropped, a foot has a hole there), ``late``
    (dropped, a foot came too late), ``outside`` (dropped, only one foot was on) and ``restarts``.
    """

    def __init__(self, config: AlignerConfig | None = None) -> None:
        self.config = config or AlignerConfig()
        self._gates = {foot: Gate(self.config) for foot in FEET}
        self._outcomes = dict.fromkeys(OUTCOMES, 0)
        self.reset()

    @property
    def counters(self) -> dict[str, int]:
        """What became of every sample and of every stamp of the grid."""
        feet = {f"{f}_{k}": n for f in FEET for k, n in self._gates[f].counters.items()}
        return feet | self._outcomes

    def reset(self) -> None:
        """Forget all samples; the counters stay."""
        for gate in self._gates.values():
            gate.forget()
        self._buffers = {foot: SampleBuffer(self.config) for foot in FEET}
        self._grid = grid_of(self.config)

    def push(self, foot: str, stamp_ns: int, values: FloatArray) -> list[ImuPair]:
        """Take one sample and return the pairs that are complete with it.

        ``values`` (6,) is specific force (m/s^2) and angular rate (rad/s).  A sample that cannot
        be used is counted, never an exception.  A stream that goes on at an older time (see
        ``restart_after``) resets the aligner, and the stamps of the pairs go back with it.
        """
        stamp_ns = int(stamp_ns)
        sample = np.array(values, dtype=np.float64)
        gate = self._gates[foot]
        if gate.refusal(stamp_ns, all_finite(sample.tolist())) is not None:
            if not gate.restarted:
                return []
            self._outcomes["restarts"] += 1
            self.reset()
            gate.refusal(stamp_ns, True)
        self._buffers[foot].append(stamp_ns, sample)
        self._grid.admit(foot, stamp_ns)
        return list(self._complete())

    def _complete(self) -> Iterator[ImuPair]:
        left, right = self._buffers["left"], self._buffers["right"]
        while (stamp_ns := self._grid.head()) is not None:
            found = left.at(stamp_ns), right.at(stamp_ns)
            missing = [f for f in found if f.values is None]
            if not missing:
                self._outcomes["pairs"] += 1
                self._outcomes["interpolated"] += any(f.why for f in found)
                yield ImuPair(stamp_ns, np.concatenate([f.values for f in found]))
                self._grid.advance(stamp_ns + 1)
                continue
            lost = [f for f in missing if f is not WAIT]
            if not lost and not self._waited_too_long(stamp_ns):
                return
            self._drop(lost[0] if lost else self._timeout())

    def _waited_too_long(self, stamp_ns: int) -> bool:
        newest = max(t.newest_ns for t in self._buffers.values() if t.samples)
        return newest - stamp_ns > self.config.max_delay_ns

    def _timeout(self) -> BufferedSample:
        on = [buffer for buffer in self._buffers.values() if buffer.samples]
        until = max(t.newest_ns for t in on) - self.config.max_delay_ns
        return BufferedSample(None, "late" if len(on) == 2 else "outside", until)

    def _drop(self, lost: BufferedSample) -> None:
        self._outcomes[lost.why] += self._grid.advance(lost.next_ns)
