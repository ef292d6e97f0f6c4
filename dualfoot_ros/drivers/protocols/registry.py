"""Registry of the formats: decoder, options and description by name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from ...core import Parameters, SourceError
from .decoder import Decoder
from .dot import DotConfig, DotDecoder
from .dot_csv import DotCsvConfig, DotCsvDecoder
from .mcu import McuConfig, McuDecoder
from .vectornav import VectorNavConfig, VectorNavDecoder
from .vectornav_ascii import VectorNavAsciiConfig, VectorNavAsciiDecoder
from .witmotion import WitMotionConfig, WitMotionDecoder
from .xbus import XbusConfig, XbusDecoder
from .ximu3 import XImu3Config, XImu3Decoder


class Format(NamedTuple):
    """A wire format."""

    decoder: Callable[[Any], Decoder]
    options: type[Parameters]
    description: str


FORMATS: dict[str, Format] = {
    "mcu": Format(
        McuDecoder, McuConfig, "frame for boards of one's own, docs/reference/mcu_frame.md"
    ),
    "ximu3": Format(XImu3Decoder, XImu3Config, "x-io x-IMU3, ASCII and binary"),
    "witmotion": Format(WitMotionDecoder, WitMotionConfig, "WitMotion serial output"),
    "xbus": Format(XbusDecoder, XbusConfig, "Xsens MTi, MTData2 and MTData"),
    "vectornav": Format(VectorNavDecoder, VectorNavConfig, "VectorNav binary output"),
    "vectornav_ascii": Format(
        VectorNavAsciiDecoder, VectorNavAsciiConfig, "VectorNav ASCII output ($VNIMU, $VNYMR ...)"
    ),
    "dot": Format(DotDecoder, DotConfig, "Xsens (Movella) DOT, live over BLE"),
    "dot_csv": Format(DotCsvDecoder, DotCsvConfig, "csv export of the Xsens DOT app"),
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
