"""Names of columns taken apart: quantity, axis, side of the body, unit, and the words that remain.

"Gyroscope X (deg/s)", "gyr_x_dps", "gyroRotationX(rad/s)" and "Shimmer_8665_Gyro_X_CAL" are all
the rate about x.  Names decide about candidates only; motion and gravity check them.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from .table_layout import AXES
from .unit_words import RAW, SIGNS, foreign_unit, unit_of

QUANTITIES = {
    "force": "acc accel accelerometer acceleration accelerometers acce accelero accelerations sf "
    "beschleunigung aceleracion",
    "rate": "gyr gyro gyroscope gyros omega angvel avel gyrometer rotationrate "
    "winkelgeschwindigkeit drehrate gyroskop",
    "field": "mag magnetometer magnetic magn magfield magneto compass magnetfeld",
    "push": "dv velinc deltav deltavelocity",
    "turn": "dq oriinc deltaq deltaquaternion",
}
LETTERS = {"a": "force", "g": "rate", "w": "rate", "m": "field", "b": "field"}
PHRASES = {
    ("angular", "velocity"): "rate",
    ("angular", "rate"): "rate",
    ("angular", "vel"): "rate",
    ("angular", "speed"): "rate",
    ("rotation", "rate"): "rate",
    ("rate", "of", "turn"): "rate",
    ("ang", "vel"): "rate",
    ("specific", "force"): "force",
    ("vel", "inc"): "push",
    ("delta", "v"): "push",
    ("ori", "inc"): "turn",
    ("delta", "q"): "turn",
}
PERHAPS_FREE = frozenset(
    {"linear", "lin", "lineare", "ohne"}
)  # ROS calls the specific force so, phones do not
OTHER = (
    *("quat", "quaternion", "quaternions", "euler", "roll", "pitch", "yaw", "orientation", "mat"),
    *("temp", "temperature", "gravity", "grav", "std", "var", "cov", "covariance", "bias", "jerk"),
    *("pressure", "baro", "barometer", "battery", "humidity", "altitude", "heading", "status"),
    *("free", "user", "velocity", "vel", "position", "pos", "clip", "norm", "absolute", "abs"),
)
TIMES = (
    *("sampletimefine", "time", "timestamp", "timestamps", "t", "stamp", "timesec", "epoch"),
    *("zeit", "zeitstempel", "tiempo", "temps", "tempo"),
    *("epoc", "elapsed", "seconds", "secs", "millis", "micros", "datetime", "ts", "unix", "clock"),
    *("uhrzeit", "hora", "heure", "ora", "orario", "date", "datum", "fecha"),
)
COUNTERS = (
    *(
        "packetcounter",
        "packetnumber",
        "packet",
        "counter",
        "count",
        "sample",
        "samples",
        "n",
        "f",
    ),
    *("samplenumber", "index", "idx", "frame", "seq", "sequence", "number", "nr", "row"),
)
DEVICES = (
    *("foot", "side", "leg", "limb", "address", "mac", "device", "deviceid", "devicetag"),
    *("sensor", "sensorid", "id", "tag", "segment", "location", "name"),
)
SIDES = {
    **dict.fromkeys(("left", "l", "lf", "leftfoot", "lfoot", "links", "gauche"), "left"),
    **dict.fromkeys(("right", "r", "rf", "rightfoot", "rfoot", "rechts", "droite"), "right"),
}
FILLERS = frozenset({"axis", "body", "sensor", "data", "value", "imu", "calibrated", "cal"})
PLACES = {"q0": "w", "q1": "x", "q2": "y", "q3": "z", "1": "x", "2": "y", "3": "z"}
UNIT_TOKENS = 3  # at most so many words at the end of a name spell a unit


@dataclass(frozen=True)
class ColumnName:
    """What the name of a column says.

    Attributes
    ----------
    place : number of the column, from 0
    text : the name as it stands in the file
    plain : lower case, without the unit
    kind : "force", "rate", "field", "push", "turn", "time", "counter", "device", or ""
    axis : "x", "y", "z" ("w" of a turn), or ""
    side : "left", "right", or ""
    unit : the unit that the name tells, or None
    words : what remains, such as the number of the device or "lowpass"
    free : whether gravity may be taken out, by its name
    foreign : the unit that the name tells where it is one that is not known here
    """

    place: int
    text: str
    plain: str
    kind: str
    axis: str
    side: str
    unit: str | None
    words: tuple[str, ...]
    free: bool = False
    foreign: str = ""


def read_name(text: str, place: int, unit_row: str = "", assumed: str = "") -> ColumnName:
    """Take a name apart; ``unit_row`` is its unit from a line of units below the names.

    A column that names an axis but no quantity holds ``assumed``, or what its unit is one of.
    """
    body, unit_text = _split_unit(text)
    tokens = _tokens(body)
    kind, left = _quantity(tokens)
    axis, left = _axis(kind, left)
    unit = unit_of(kind, unit_text or unit_row) if kind else None
    if not kind and axis and not _is_other(tokens):
        kind, unit = _by_unit(unit_text or unit_row, assumed)
    if kind and unit is None and not unit_text:
        unit, left = _unit_at_end(kind, left)
    foreign = "" if unit else foreign_unit(kind, unit_text or unit_row or "".join(left[-1:]))
    side = next((SIDES[token] for token in left if token in SIDES), "")
    words = tuple(t for t in left if t not in SIDES and t not in FILLERS and t not in PERHAPS_FREE)
    free = kind == "force" and bool(PERHAPS_FREE & set(tokens))
    plain = " ".join(_tokens(body))
    return ColumnName(place, text, plain, kind, axis, side, unit, words, free, foreign)


def _split_unit(text: str) -> tuple[str, str]:
    """Return the name and what stands in the brackets at its end."""
    match = re.fullmatch(r"(.*?)\s*[(\[{](.*)[)\]}]\s*", text.strip().translate(SIGNS), re.S)
    if match is None:
        return text, ""
    name, inside = match.groups()
    return (f"{name} {inside}", "") if inside.strip().isdigit() else (name, inside)


def _is_other(tokens: Sequence[str]) -> bool:
    return any(token in OTHER for token in tokens)


def _tokens(text: str) -> list[str]:
    apart = re.sub(r"(?<=[a-z]{2})(?=[A-Z])|(?<=[A-Z]{3})(?=[XYZ]\b)", " ", text.translate(SIGNS))
    return [token for token in re.split(r"[^0-9A-Za-z^]+", apart.lower()) if token]


def _quantity(tokens: list[str]) -> tuple[str, list[str]]:
    """Return the quantity, and the tokens without its words."""
    for phrase, kind in PHRASES.items():
        for start in range(len(tokens) - len(phrase) + 1):
            if tuple(tokens[start : start + len(phrase)]) == phrase:
                return kind, tokens[:start] + tokens[start + len(phrase) :]
    for kind, names in QUANTITIES.items():
        known = names.split()
        for place, token in enumerate(tokens):
            rest = _rest(token, known)
            if rest is not None and not _is_other(tokens):
                return kind, [*tokens[:place], *rest, *tokens[place + 1 :]]
    return _lone_letter(tokens)


def _rest(token: str, known: list[str]) -> list[str] | None:
    """Return the axis that is written together with a known word, nothing, or None."""
    if token in known:
        return []
    for word in known:
        if token in {f"{word}{axis}" for axis in (*AXES, "w", "q0", "q1", "q2", "q3")}:
            return [token[len(word) :]]
        if token in {f"{axis}{word}" for axis in AXES}:
            return [token[: -len(word)]]
    return None


def _lone_letter(tokens: list[str]) -> tuple[str, list[str]]:
    """Return the quantity of names like "ax", "g_x" and "omega", of times and of counters."""
    for place, token in enumerate(tokens):
        if len(token) == 2 and token[0] in LETTERS and token[1] in AXES:
            return LETTERS[token[0]], [*tokens[:place], token[1], *tokens[place + 1 :]]
    if len(tokens) > 1 and tokens[0] in LETTERS and tokens[1] in AXES:
        return LETTERS[tokens[0]], tokens[1:]
    joined = "".join(tokens)
    for kind, known in (("time", TIMES), ("device", DEVICES), ("counter", COUNTERS)):
        if joined in known:
            return kind, []
    for kind, known in (("time", TIMES), ("device", DEVICES), ("counter", COUNTERS)):
        for place, token in enumerate(tokens):
            if token in known and not _is_other(tokens):
                return kind, tokens[:place] + tokens[place + 1 :]
    return "", tokens


def _axis(kind: str, tokens: list[str]) -> tuple[str, list[str]]:
    """Return the axis, and the tokens without it."""
    if kind in ("time", "counter", "device"):
        return "", tokens
    allowed = {axis: axis for axis in AXES}
    if kind in ("turn", "push"):
        allowed |= {"w": "w"} | PLACES
    for place, token in enumerate(tokens):
        if token in allowed:
            return allowed[token], tokens[:place] + tokens[place + 1 :]
    return "", tokens


def _by_unit(unit_text: str, assumed: str) -> tuple[str, str | None]:
    """Return quantity and unit of a column that names an axis only."""
    if assumed:
        return assumed, unit_of(assumed, unit_text)
    for kind in ("force", "rate"):
        unit = unit_of(kind, unit_text)
        if unit is not None and unit != RAW:
            return kind, unit
    return "", None


def _unit_at_end(kind: str, tokens: list[str]) -> tuple[str | None, list[str]]:
    """Return the unit that the last words spell, and the others."""
    for count in range(min(UNIT_TOKENS, len(tokens)), 0, -1):
        unit = unit_of(kind, "_".join(tokens[-count:]))
        if unit is not None:
            return unit, tokens[:-count]
    return None, tokens
