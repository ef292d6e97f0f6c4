"""Bytes captured from two devices, one file a foot, through the decoders that run live.

The stamps are those of the devices' own clocks, without their wraps.  A device that sends no time
needs its rate; its samples then follow each other evenly.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...core import (
    FEET,
    FloatArray,
    ImuSeries,
    Increments,
    IntArray,
    RecordingError,
    Refusal,
    SourceError,
    axes_matrix,
)
from ...drivers import SampleSeries, SourceUri, make_decoder, parse_uri, recognise, series_of
from ..recording import Recording
from .options import ImportOptions
from .twins import without_twins

CHUNK = 1 << 16
LOSSES = (
    Refusal.LOST,
    Refusal.BAD_CHECKSUM,
    Refusal.MALFORMED,
    Refusal.NOT_FINITE,
    Refusal.INCOMPLETE,
    Refusal.GARBAGE_BYTES,
)


class _Decoded(NamedTuple):
    samples: SampleSeries
    losses: str
    kind: Increments | None


def load(options: ImportOptions) -> Recording:
    """Load the two captures ``options.left`` and ``options.right``.

    Raises
    ------
    ConfigError
        When the axes are not three signed axes, right-handed.
    RecordingError
        When a foot or the format is missing, a file has no samples of it, a device without a
        clock has no rate, or both feet hold the same samples.
    """
    if options.left is None or options.right is None or options.sources:
        raise RecordingError("a capture holds one sensor; give --left FILE and --right FILE")
    rotation = np.array(axes_matrix(options.axes))
    files = dict(zip(FEET, (options.left, options.right), strict=True))
    sources = {foot: _source(path, options.capture) for foot, path in files.items()}
    decoded = {foot: _decode(path, sources[foot]) for foot, path in files.items()}
    series = {
        foot: _series(files[foot], found, rotation, options.capture_rate)
        for foot, found in decoded.items()
    }
    losses = "; ".join(f"{foot} {found.losses}" for foot, found in decoded.items() if found.losses)
    notes = {
        "source": f"{options.left.name}, {options.right.name}",
        "format": f"capture, {sources['left'].format}",
        "stamp_source": _stamp_source(decoded["left"].samples, options.capture_rate),
        "axes": f"forward, left, up are the device's {options.axes}",
    }
    if losses:
        notes["losses"] = losses
    return without_twins(Recording(left=series["left"], right=series["right"], notes=notes))


def _source(path: Path, capture: str) -> SourceUri:
    """Return format and options of a capture: ``FORMAT?OPTION=VALUE``, or by its ending."""
    name, _, query = capture.partition("?")
    options = "&".join(part for part in (f"format={name}" if name else "", query) if part)
    try:
        return parse_uri(f"file://{_quoted(path)}{'?' if options else ''}{options}")
    except SourceError as error:
        if not name:
            raise RecordingError(
                f"'{path}' does not say what the device sent; give --capture FORMAT, or let "
                f"'dualfoot probe file://{path}' find it"
            ) from error
        raise RecordingError(f"--capture is '{capture}': {error}") from error


def _quoted(path: Path) -> str:
    from urllib.parse import quote

    return quote(str(path.absolute()))


def _decode(path: Path, source: SourceUri) -> _Decoded:
    decoder = make_decoder(source.format, source.decoder)
    data = path.read_bytes()
    chunks = [data[at : at + CHUNK] for at in range(0, len(data), CHUNK)]
    samples = [sample for chunk in chunks for sample in decoder.feed(chunk, 0)]
    if not samples:
        found = recognise(chunks)
        other = f"; {found[0].sentence}" if found else ""
        raise RecordingError(
            f"'{path}' has no sample of the format '{source.format}' in {len(data)} bytes{other}"
        )
    kinds = {sample.increments for sample in samples} - {None}  # not known before some intervals
    return _Decoded(
        series_of(samples, live=False),
        _describe_losses(decoder.counters),
        kinds.pop() if len(kinds) == 1 else None,
    )


def _describe_losses(counters: Counter[str]) -> str:
    return ", ".join(f"{counters[kind]} {kind.words}" for kind in LOSSES if counters[kind])


def _series(path: Path, decoded: _Decoded, rotation: FloatArray, rate_hz: float) -> ImuSeries:
    samples = decoded.samples
    turned = ImuSeries(
        _stamps(path, samples, rate_hz),
        samples.specific_force @ rotation.T,
        samples.angular_rate @ rotation.T,
        increments=decoded.kind,
    )
    field = samples.magnetic_field
    return turned if field is None else replace(turned, magnetic_field=field @ rotation.T)


def _stamps(path: Path, samples: SampleSeries, rate_hz: float) -> IntArray:
    if samples.device_ns is not None:
        return samples.device_ns
    if rate_hz <= 0.0:
        raise RecordingError(
            f"the device of '{path}' sends no time; give its rate with --capture-rate HZ"
        )
    stamps: IntArray = np.rint(np.arange(len(samples)) * 1e9 / rate_hz).astype(np.int64)
    return stamps


def _stamp_source(samples: SampleSeries, rate_hz: float) -> str:
    if samples.device_ns is not None:
        return "each device's own clock, unwrapped"
    return f"the number of the sample, at {rate_hz:g} Hz"
