"""The formats by name: which decoder, and with which options."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from ...core import Parameters, SourceError
from .decoder import Decoder
from .dot import DotDecoder, DotOptions
from .dot_csv import DotCsvDecoder, DotCsvOptions
from .mcu import McuDecoder, McuOptions
from .vectornav import VectorNavDecoder, VectorNavOptions
from .witmotion import WitMotionDecoder, WitMotionOptions
from .xbus import XbusDecoder, XbusOptions
from .ximu3 import XImu3Decoder, XImu3Options


class Format(NamedTuple):
    """A format as a user names it."""

    decoder: Callable[[Any], Decoder]
    options: type[Parameters]
    description: str


FORMATS: dict[str, Format] = {
    "mcu": Format(McuDecoder, McuOptions, "frame for boards of one's own, docs/mcu_frame.md"),
    "ximu3": Format(XImu3Decoder, XImu3Options, "x-io x-IMU3, ASCII and binary"),
    "witmotion": Format(WitMotionDecoder, WitMotionOptions, "WitMotion serial output"),
    "xbus": Format(XbusDecoder, XbusOptions, "Xsens MTi, MTData2"),
    "vectornav": Format(VectorNavDecoder, VectorNavOptions, "VectorNav binary output"),
    "dot": Format(DotDecoder, DotOptions, "Xsens (Movella) DOT, live over BLE"),
    "dot_csv": Format(DotCsvDecoder, DotCsvOptions, "csv export of the Xsens DOT app"),
}


def find_format(name: str) -> Format:
    """Return the format called ``name``; raise :class:`SourceError` naming those that exist."""
    if name not in FORMATS:
        raise SourceError(f"format is '{name}'; allowed is one of {', '.join(FORMATS)}")
    return FORMATS[name]


def make_decoder(name: str, options: Parameters | None = None) -> Decoder:
    """Return a new decoder of the format called ``name``.

    Raises
    ------
    SourceError
        When there is no such format.
    """
    return find_format(name).decoder(options)
