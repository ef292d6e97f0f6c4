"""Encoders of every format, written from the makers' documents and not from the decoders.

``frame(format, k)`` is the k-th sample of a made-up walk as the device would send it; ``truth(k)``
is what it stands for, in SI units.
"""

import math
import struct

G = 9.80665
DEG = math.pi / 180.0
PERIOD_US = 5000
FORMATS = (
    "mcu",
    "ximu3",
    "ximu3_ascii",
    "witmotion",
    "xbus",
    "vectornav",
    "vectornav_ascii",
    "dot_csv",
)
TIMED = tuple(name for name in FORMATS if name != "vectornav_ascii")  # which sends no time
CSV_HEADER = (
    b"sep=,\r\nDeviceTag:,A\r\nOutputRate:,200Hz\r\n\r\n"
    b"PacketCounter,SampleTimeFine,Acc_X,Acc_Y,Acc_Z,Gyr_X,Gyr_Y,Gyr_Z,Mag_X,Mag_Y,Mag_Z\r\n"
)


def decoder_format(name):
    return "ximu3" if name == "ximu3_ascii" else name


def truth(k):
    """Specific force (m/s^2) and angular rate (rad/s); multiples of every format's resolution."""
    force = tuple(G * (n % 4096 - 2048) / 2048 * 2 for n in (k * 7 + 11, k * 13 + 5, k * 3 + 2900))
    rate = tuple(DEG * (n % 1024 - 512) * 1000 / 8192 for n in (k * 5, k * 11 + 7, k * 17 + 3))
    return force, rate


def preamble(name):
    return CSV_HEADER if name == "dot_csv" else b""


def frame(name, k):
    return ENCODERS[name](k)


def stream(name, count, first=0):
    return preamble(name) + b"".join(frame(name, k) for k in range(first, first + count))


def crc16(data, start):
    """Bit by bit, polynomial 0x1021."""
    crc = start
    for byte in data:
        for bit in range(7, -1, -1):
            top = crc >> 15 ^ (byte >> bit & 1)
            crc = (crc << 1 & 0xFFFF) ^ (0x1021 if top else 0)
    return crc


def cobs(plain):
    """Stuff as the paper tells it: cut at zeros, then in blocks of at most 254 bytes."""
    out = b""
    for part in plain.split(b"\0"):
        rest = part
        while len(rest) >= 254:
            out, rest = out + b"\xff" + rest[:254], rest[254:]
        out += bytes([len(rest) + 1]) + rest
    return out + b"\0"


def mcu(k, *, layout=1, temperature=None, field=None):
    force, rate = truth(k)
    kind = layout | (temperature is not None) << 4 | (field is not None) << 5
    plain = struct.pack("<BHI", kind, k & 0xFFFF, k * PERIOD_US & 0xFFFFFFFF)
    if layout == 1:
        plain += struct.pack("<6f", *force, *rate)
    else:
        scales = 16 * G / 32768, 1000 * DEG / 32768
        words = [round(v / scales[i > 2]) for i, v in enumerate((*force, *rate))]
        plain += struct.pack("<2f6h", *scales, *words)
    if temperature is not None:
        plain += struct.pack("<h", round(temperature * 100))
    if field is not None:
        plain += struct.pack("<3h", *(round(v * 1e7) for v in field))
    return cobs(plain + struct.pack("<H", crc16(plain, 0xFFFF)))


def _device_units(k):
    force, rate = truth(k)
    return [v / DEG for v in rate], [v / G for v in force]


def ximu3(k):
    rate, force = _device_units(k)
    plain = struct.pack("<BQ6f", 0xC9, k * PERIOD_US, *rate, *force)
    return plain.replace(b"\xdb", b"\xdb\xdd").replace(b"\n", b"\xdb\xdc") + b"\n"


def ximu3_ascii(k):
    rate, force = _device_units(k)
    values = ",".join(f"{v:.4f}" for v in (*rate, *force))
    return f"I,{k * PERIOD_US},{values}\n".encode()


def wit(kind, content):
    body = bytes([0x55, kind]) + content
    return body + bytes([sum(body) % 256])


def witmotion(k):
    rate, force = _device_units(k)
    ms = k * PERIOD_US // 1000
    clock = struct.pack(
        "<6BH", 26, 11, 22, ms // 3600000, ms // 60000 % 60, ms // 1000 % 60, ms % 1000
    )
    acceleration = struct.pack("<4h", *(round(v / 16 * 32768) for v in force), 2512)
    angular = struct.pack("<4h", *(round(v / 2000 * 32768) for v in rate), 0)
    return wit(0x50, clock) + wit(0x51, acceleration) + wit(0x52, angular)


def xbus_message(mid, content):
    length = (
        bytes([len(content)]) if len(content) < 255 else b"\xff" + struct.pack(">H", len(content))
    )
    body = bytes([0xFF, mid]) + length + content
    return b"\xfa" + body + bytes([-sum(body) % 256])


def item(key, content):
    return struct.pack(">HB", key, len(content)) + content


def xbus(k):
    force, rate = truth(k)
    return xbus_message(
        0x36,
        item(0x1020, struct.pack(">H", k & 0xFFFF))
        + item(0x1060, struct.pack(">I", k * PERIOD_US // 100 & 0xFFFFFFFF))
        + item(0x4020, struct.pack(">3f", *force))
        + item(0x8020, struct.pack(">3f", *rate)),
    )


def vectornav_message(groups, masks, content):
    body = struct.pack(f"<B{len(masks)}H", groups, *masks) + content
    return b"\xfa" + body + struct.pack(">H", crc16(body, 0))


def vectornav(k):
    force, rate = truth(k)
    content = struct.pack("<Q6f", k * PERIOD_US * 1000, *force, *rate)
    return vectornav_message(0b001, [1 << 0 | 1 << 9], content)


def vectornav_line(text):
    """Return an ASCII line with the checksum that is an exclusive or."""
    check = 0
    for byte in text.encode():
        check ^= byte
    return f"${text}*{check:02X}\r\n".encode()


def vectornav_ascii(k):
    force, rate = truth(k)
    motion = [*(f"{v:+07.3f}" for v in force), *(f"{v:+010.6f}" for v in rate)]
    return vectornav_line(",".join(["VNIMU,+0.2500,-0.1250,+0.5000", *motion, "+25.5,+101.325"]))


def witmotion_combined(k):
    rate, force = _device_units(k)
    words = [round(v / 16 * 32768) for v in force] + [round(v / 2000 * 32768) for v in rate]
    return b"\x55\x61" + struct.pack("<9h", *words, 100, 200, 300)


def dot_csv(k):
    force, rate = truth(k)
    cells = ", ".join(repr(v) for v in (*force, *(v / DEG for v in rate), 0.5, -0.25, 0.75))
    return f"{k + 1}, {k * PERIOD_US & 0xFFFFFFFF}, {cells}\r\n".encode()


def dot(k, payload="rate", padding=0):
    force, rate = truth(k)
    start = struct.pack("<I", k * PERIOD_US & 0xFFFFFFFF)
    if payload == "custom5":
        start += struct.pack("<4f", 1, 0, 0, 0)
    motion = struct.pack("<6f", *force, *(v / DEG for v in rate))
    field = struct.pack("<3h", 2048, -1024, 3072) if payload == "rate_mag" else b""
    return start + motion + field + bytes(padding)


ENCODERS = {
    "mcu": mcu,
    "ximu3": ximu3,
    "ximu3_ascii": ximu3_ascii,
    "witmotion": witmotion,
    "xbus": xbus,
    "vectornav": vectornav,
    "vectornav_ascii": vectornav_ascii,
    "dot_csv": dot_csv,
}
