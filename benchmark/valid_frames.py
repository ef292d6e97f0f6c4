"""Frames whose content is damaged and whose checksum is right, so that a decoder reads them."""

from __future__ import annotations

import random
import struct
from collections.abc import Callable

from drivers import frames

Damage = Callable[[random.Random, bytearray], None]
Damages = tuple[Damage, ...]
NAMES = (*frames.FORMATS, "dot")
DOT_PAYLOADS = ("rate", "rate_mag", "custom5")


def sealed(name: str, k: int, dice: random.Random, damages: Damages) -> bytes:
    """Return the ``k``-th frame of a format, its content damaged, as a valid frame."""
    return SEALERS[name](k, dice, damages)


def _damaged(content: bytes, dice: random.Random, damages: Damages) -> bytes:
    data = bytearray(content)
    for _ in range(dice.randrange(1, 5)):
        if data:
            dice.choice(damages)(dice, data)
    return bytes(data)


def _mcu(k: int, dice: random.Random, damages: Damages) -> bytes:
    plain = _damaged(_unstuffed(frames.mcu(k))[:-2], dice, damages)
    return frames.cobs(plain + struct.pack("<H", frames.crc16(plain, 0xFFFF)))


def _unstuffed(data: bytes) -> bytes:
    """Undo COBS, frame by the book."""
    out, at = b"", 0
    while data[at]:
        length = data[at]
        out += data[at + 1 : at + length] + (b"\0" if length < 255 else b"")
        at += length
    return out[:-1]


def _ximu3(k: int, dice: random.Random, damages: Damages) -> bytes:
    plain = frames.ximu3(k)[:-1].replace(b"\xdb\xdc", b"\n").replace(b"\xdb\xdd", b"\xdb")
    plain = plain[:1] + _damaged(plain[1:], dice, damages)
    return plain.replace(b"\xdb", b"\xdb\xdd").replace(b"\n", b"\xdb\xdc") + b"\n"


def _line(name: str) -> Callable[[int, random.Random, Damages], bytes]:
    """Return the sealer of a format of lines without a checksum."""

    def seal(k: int, dice: random.Random, damages: Damages) -> bytes:
        content = frames.frame(name, k).rstrip(b"\r\n")
        return _damaged(content, dice, damages).replace(b"\n", b" ") + b"\r\n"

    return seal


def _witmotion(k: int, dice: random.Random, damages: Damages) -> bytes:
    kind = dice.choice((0x50, 0x51, 0x52, 0x53, 0x54, 0x59, dice.randrange(256)))
    content = _damaged(frames.witmotion(k)[2:10], dice, damages)
    return frames.wit(kind, content.ljust(8, b"\0")[:8])


def _xbus(k: int, dice: random.Random, damages: Damages) -> bytes:
    message = frames.xbus(k)
    mid = 0x36 if dice.random() < 0.7 else dice.randrange(256)
    return frames.xbus_message(mid, _damaged(message[4:-1], dice, damages))


def _vectornav(k: int, dice: random.Random, damages: Damages) -> bytes:
    body = frames.vectornav(k)[1:-2]
    if dice.random() < 0.5:  # the content alone, of the same length
        values = bytes(dice.choice((0x00, 0x7F, 0x80, 0xFF)) for _ in body[3:])
        body = body[:3] + values
    else:
        body = _damaged(body, dice, damages)
    return b"\xfa" + body + struct.pack(">H", frames.crc16(body, 0))


def _vectornav_ascii(k: int, dice: random.Random, damages: Damages) -> bytes:
    text = frames.vectornav_ascii(k)[1:].partition(b"*")[0]
    content = text[:5] + _damaged(text[5:], dice, damages).replace(b"\n", b" ").replace(b"*", b"+")
    return frames.vectornav_line(content.decode("latin-1"))


def _dot(k: int, dice: random.Random, damages: Damages) -> bytes:
    """Return a notification of the right length; what its numbers are is anybody's guess."""
    good = frames.dot(k, dice.choice(DOT_PAYLOADS))
    content = _damaged(good, dice, damages)
    return (content + good)[: len(good)]


SEALERS: dict[str, Callable[[int, random.Random, Damages], bytes]] = {
    "mcu": _mcu,
    "ximu3": _ximu3,
    "ximu3_ascii": _line("ximu3_ascii"),
    "witmotion": _witmotion,
    "xbus": _xbus,
    "vectornav": _vectornav,
    "vectornav_ascii": _vectornav_ascii,
    "dot_csv": _line("dot_csv"),
    "dot": _dot,
}
