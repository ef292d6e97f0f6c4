"""Framers: streams of bytes cut at a terminating byte, or by header, length and checksum."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

from ...core import Refusal

NEED_MORE = 0
NO_FRAME = -1
BAD_CHECKSUM = -2

Probe = Callable[[bytearray, int], int]
"""Probe of a frame that may start at an index of the buffer.

Returns its length in bytes when it is complete and valid, else NEED_MORE, NO_FRAME or
BAD_CHECKSUM.
"""

Doubt = Callable[[bytes, bool], bool]
"""Doubt about a valid frame, which may be right by chance.

Returns True when it may; the flag says that it follows another frame directly.
"""


class DelimitedFramer:
    """Framer for a byte that occurs nowhere else; a run without it is dropped when too long."""

    def __init__(self, delimiter: int, max_frame: int, counters: Counter[str]) -> None:
        """Keep at most ``max_frame`` bytes of an unfinished frame."""
        self._delimiter = bytes([delimiter])
        self._max_frame = max_frame
        self._counters = counters
        self._rest = b""
        self._skipping = False

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        return len(self._rest)

    def reset(self) -> None:
        """Forget an unfinished frame."""
        self._counters[Refusal.GARBAGE_BYTES] += len(self._rest)
        self._rest = b""
        self._skipping = False

    def push(self, data: bytes) -> list[bytes]:
        """Return the frames that ``data`` completes, without their delimiter; none is empty."""
        *whole, rest = (self._rest + data).split(self._delimiter)
        if self._skipping and whole:
            self._counters[Refusal.GARBAGE_BYTES] += len(whole.pop(0))
            self._skipping = False
        frames = [frame for frame in whole if frame and self._fits(frame)]
        if self._skipping or not self._fits(rest):
            self._counters[Refusal.GARBAGE_BYTES] += len(rest) if self._skipping else 0
            self._skipping = True
            rest = b""
        self._rest = rest
        return frames

    def _fits(self, frame: bytes) -> bool:
        if len(frame) <= self._max_frame:
            return True
        self._counters[Refusal.GARBAGE_BYTES] += len(frame)
        return False


class HeaderFramer:
    """Framer for frames that begin with a known byte and have a length and a checksum.

    Two rules keep it in step.  A frame in ``doubt``, as its checksum is weak, is trusted only when
    the next one follows directly.  And a header that still waits for its bytes, as garbage may
    fake one that announces a long frame, gives way as soon as two complete valid frames in a row
    stand behind it.  Where bytes were skipped between two frames, an empty one stands in the
    result, for decoders that join frames.
    """

    def __init__(
        self, sync: int, probe: Probe, max_frame: int, counters: Counter[str], doubt: Doubt
    ) -> None:
        """Search frames of at most ``max_frame`` bytes that start with the byte ``sync``."""
        self._sync = bytes([sync])
        self._probe = probe
        self._counters = counters
        self._doubt = doubt
        self._buffer = bytearray()
        self._in_step = False
        self.max_buffer = 2 * max_frame

    @property
    def buffered(self) -> int:
        """Number of bytes kept for the next call."""
        return len(self._buffer)

    def reset(self) -> None:
        """Forget an unfinished frame."""
        self._counters[Refusal.GARBAGE_BYTES] += len(self._buffer)
        self._buffer.clear()
        self._in_step = False

    def push(self, data: bytes) -> list[bytes]:
        """Return the frames that ``data`` completes, with an empty one for each gap."""
        buffer = self._buffer
        buffer += data
        frames: list[bytes] = []
        at = 0
        while at < len(buffer):
            length = self._probe_or_doubt(at)
            if length == NEED_MORE:
                pair = self._find_pair(at + 1)
                if pair is None:
                    break
                self._counters[Refusal.GARBAGE_BYTES] += pair - at
                frames.append(b"")
                at, length = pair, self._probe(buffer, pair)
            if length > 0:
                frames.append(bytes(buffer[at : at + length]))
                at += length
                self._in_step = True
            else:
                at = self._skip(at, length)
                frames.append(b"")
        del buffer[:at]
        return frames

    def _probe_or_doubt(self, at: int) -> int:
        """Probe a frame; in doubt, probe the one that follows as well."""
        length = self._probe(self._buffer, at)
        if length <= 0 or not self._doubt(bytes(self._buffer[at : at + length]), self._in_step):
            return length
        following = self._probe(self._buffer, at + length)
        return length if following > 0 else min(following, NEED_MORE)

    def _skip(self, at: int, reason: int) -> int:
        """Step over the byte at ``at`` and on to the next possible header."""
        if reason == BAD_CHECKSUM and self._in_step:
            self._counters[Refusal.BAD_CHECKSUM] += 1
        self._in_step = False
        header = self._buffer.find(self._sync, at + 1)
        end = len(self._buffer) if header < 0 else header
        self._counters[Refusal.GARBAGE_BYTES] += end - at
        return end

    def _find_pair(self, start: int) -> int | None:
        """Return where two complete valid frames in a row start, at or after ``start``."""
        at = self._buffer.find(self._sync, start)
        while at >= 0:
            length = self._probe(self._buffer, at)
            if length > 0 and self._probe(self._buffer, at + length) > 0:
                return at
            at = self._buffer.find(self._sync, at + 1)
        return None
