"""Units as people spell them in the names of columns, and their sizes in SI."""

from __future__ import annotations

import re

from ....core import FORCE_UNITS, RATE_UNITS

TIME_UNITS = {"s": 1.0, "ms": 1e-3, "100us": 1e-4, "us": 1e-6, "ns": 1e-9}
FIELD_UNITS = {"T": 1.0, "mT": 1e-3, "uT": 1e-6, "nT": 1e-9, "G": 1e-4, "mG": 1e-7}
SAMPLES = "samples"
ARBITRARY = "a.u."
RAW = "raw counts"

_FORCE = {
    "m/s^2": "m/s^2 m/s2 m/s/s m/s**2 m/(s^2) m/sec^2 m/sec2 ms2 mss ms-2 ms^-2 ms^2 mps2 mpss "
    "m/ss m*s^-2 m.s-2 m.s^-2 m_s2 m_s_2 m_per_s2 m_per_sec_squared meters/second^2",
    "g": "g gs g's gn grav gravity g0 gforce",
    "mg": "mg milli-g millig mgs mgn",
}
_RATE = {
    "rad/s": "rad/s rad/sec rads rads-1 rads^-1 radps rad*s^-1 rad.s-1 rad_s rad_per_s rad_sec "
    "radians/s radians/second radian/s",
    "deg/s": "deg/s deg/sec degs degs-1 dps d/s degps deg_s deg_per_s deg_sec degrees/s degree/s "
    "degrees/second degree/sec degpers degpersec degpersecond degreespersecond",
    "mdeg/s": "mdeg/s mdps mdegs milli-deg/s",
}
_FIELD = {
    "T": "t tesla",
    "mT": "mt millitesla",
    "uT": "ut microtesla",
    "nT": "nt nanotesla",
    "G": "g gauss ga gs",
    "mG": "mg mgauss milligauss mga",
    ARBITRARY: "a.u. au a.u arb arbitrary norm normalized normalised",
}
_TIME = {
    "s": "s sec secs second seconds unix",
    "ms": "ms msec msecs millis millisecond milliseconds millisec",
    "us": "us usec usecs micros microsecond microseconds microsec",
    "ns": "ns nsec nsecs nanos nanosecond nanoseconds nanosec",
    SAMPLES: "samples sample",
}
_RAW = frozenset({"lsb", "raw", "adc", "counts", "count", "digits"})
_FOREIGN = {
    "force": "cm/s^2 cm/s2 cms2 cm/s/s mm/s^2 mm/s2 mms2 ft/s^2 ft/s2 fts2 in/s^2 gal mgal ug",
    "rate": "rpm rps rev/s rev/min cps mrad/s mrads urad/s deg/h deg/hr deg/min udps rad/min",
}
_PER_TIME = re.compile(r"[a-z]+/(?:s|sec|min|h|hr)(?:\^?2|/s)?")
_KINDS = {"force": _FORCE, "rate": _RATE, "field": _FIELD, "time": _TIME}
WORDS = {
    kind: {word: unit for unit, words in units.items() for word in words.split()}
    for kind, units in _KINDS.items()
}
SIZES = {"force": FORCE_UNITS, "rate": RATE_UNITS, "field": FIELD_UNITS, "time": TIME_UNITS}
SIGNS = str.maketrans({"µ": "u", "μ": "u", "²": "2", "³": "3", "\u2212": "-", "·": "*", "⋅": "*"})


def unit_of(kind: str, text: str) -> str | None:
    """Return the unit of ``kind`` (force, rate, field or time) that ``text`` spells, or None."""
    plain = _plain(text)
    if plain in _RAW and kind != "time":
        return RAW
    known = WORDS.get(kind, {})
    return known.get(plain) or known.get(plain.replace("_", "/"))


def foreign_unit(kind: str, text: str) -> str:
    """Return ``text`` where it spells a unit of force or rate that is unknown here, or ""."""
    plain = _plain(text)
    if kind not in _FOREIGN or unit_of(kind, text):
        return ""
    spelled = plain in _FOREIGN[kind].split() or _PER_TIME.fullmatch(plain)
    return text.strip() if spelled else ""


def is_unit(text: str) -> bool:
    """Return whether ``text`` spells a unit of any kind."""
    known = any(unit_of(kind, text) or foreign_unit(kind, text) for kind in WORDS)
    return known or _plain(text) in OTHER_UNITS


OTHER_UNITS = {
    *("", "-", "n/a", "none", "no", "nounits", "nounit", "degc", "c", "degcelsius", "pa", "hpa"),
    *("kpa", "mbar", "deg", "rad", "m", "mv", "v", "%", "hz", "quaternion", "yyyy/mm/ddhh:mm:ss"),
}


def _plain(text: str) -> str:
    """Return the spelling without case, spaces and brackets around it, in ASCII signs."""
    plain = re.sub(r"\s+", "", text.translate(SIGNS)).lower()
    plain = re.sub(r"^[°º˚]", "deg", plain).replace("°", "deg")
    if plain[:1] + plain[-1:] in ("()", "[]", "{}", "<>"):
        plain = plain[1:-1]
    return plain
