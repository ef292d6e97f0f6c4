"""Recognition of the format of a stream, by every decoder at once."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from ...core import Refusal
from ..protocols.registry import FORMATS, make_decoder
from ..protocols.xbus import XbusDecoder

LEAST_SAMPLES = 3
LEAST_FRAMES = 5
MOST_GARBAGE = 0.5  # of the bytes
BLE_ONLY = "dot"  # its notifications have no frame that could be found in a stream
CHECKED = ("xbus", "vectornav", "vectornav_ascii", "witmotion")
"""Formats with a checksum: their frames without samples are evidence of the format as well."""


class Recognition(NamedTuple):
    """A format that fits: samples found, frames without a sample, share of bytes that fit none."""

    format: str
    samples: int
    other_frames: int
    garbage: float

    @property
    def sentence(self) -> str:
        """What was found, in words."""
        if self.samples:
            return f"the bytes are of the format '{self.format}'"
        return (
            f"the bytes are of the format '{self.format}', but without specific force and angular "
            "rate: change what the device is set to send"
        )


def recognise(chunks: Iterable[bytes]) -> list[Recognition]:
    """Return the formats that fit the bytes of a stream, the best first."""
    pieces = list(chunks)
    found = [_try(name, pieces) for name in FORMATS if name != BLE_ONLY]
    fitting = [each for each in found if each is not None]
    return sorted(fitting, key=lambda r: (r.samples > 0, r.samples * (1.0 - r.garbage)))[::-1]


def devices_on_bus(chunks: Iterable[bytes]) -> list[int]:
    """Return the identifiers of the Xsens devices that share one bus, in their order."""
    decoder = XbusDecoder()
    for data in chunks:
        decoder.feed(data, 0)
    return sorted(number for number, count in decoder.devices.items() if count >= LEAST_SAMPLES)


def _try(name: str, chunks: list[bytes]) -> Recognition | None:
    decoder = make_decoder(name)
    samples = sum(len(decoder.feed(data, 0)) for data in chunks)
    counters = decoder.counters
    frames = counters[Refusal.INCOMPLETE] + counters[Refusal.OTHER] if name in CHECKED else 0
    garbage = counters[Refusal.GARBAGE_BYTES] / max(1, counters["bytes"])
    if garbage > MOST_GARBAGE or (samples < LEAST_SAMPLES and frames < LEAST_FRAMES):
        return None
    return Recognition(name, samples, frames, garbage)
