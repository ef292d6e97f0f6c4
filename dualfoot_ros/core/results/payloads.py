"""What an event carries: typed, so that other parts can act on it, and plain for JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple, Protocol

from ..rotation import about_z, rotate_covariances, rotate_vectors, turn_quaternions
from ..samples.series import FloatArray

Triple = tuple[float, float, float]


class Reason(StrEnum):
    """Why something was refused or taken with a doubt, or why the tracker started anew."""

    DISTANCE_WITHIN_C0 = "distance within c0"
    DISTANCE_WITHIN_BOUND = "distance within the bound"
    NO_UNCERTAINTY = "no uncertainty"
    FIRST_STANCE = "reference of the first stance"
    FIRST_STANCES = "reference of the first stances"
    DISTURBED_FIELD = "disturbed"
    AFTER_DISTURBANCE = "after a disturbance"
    ASKED_FOR = "asked for"
    TIME_JUMPED = "time jumped back"
    NOT_FINITE = "the estimate was not finite"
    DID_NOT_FIT = "the feet could not be where they seemed to be"


class Payload(Protocol):
    """What every payload can do."""

    def to_dict(self) -> dict[str, Any]:
        """Return named plain values, for JSON and for people."""


def named_values(payload: Payload, reason: StrEnum | None) -> dict[str, Any]:
    """Return the values of a payload by name, and the reason where there is one."""
    return {**payload.to_dict(), **({} if reason is None else {"reason": str(reason)})}


@dataclass(frozen=True)
class Details:
    """Named values for people and files; nothing acts on them."""

    values: Mapping[str, Any] = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        """Return the values."""
        return dict(self.values)


NO_DETAILS = Details()


class Levelled(NamedTuple):
    """What a track starts from: gyro bias (rad/s) and specific force norm (m/s^2) by foot.

    ``kind`` is the name of a `StartKind`, ``bias_std`` the standard deviation of either bias,
    ``rate_hz`` the rate of the samples that is used from there on.
    """

    kind: str
    gyro_bias: Mapping[str, list[float]]
    gravity: Mapping[str, float]
    bias_std: float
    rate_hz: float

    def to_dict(self) -> dict[str, Any]:
        """Return one value a foot and quantity."""
        plain: dict[str, Any] = {
            "start": self.kind,
            "gyro_bias_std": self.bias_std,
            "rate": self.rate_hz,
        }
        for foot, bias in self.gyro_bias.items():
            plain[f"{foot}_gyro_bias"] = bias
            plain[f"{foot}_gravity"] = self.gravity[foot]
        return plain


class StandBias(NamedTuple):
    """The gyro bias (3,) rad/s that a stand of ``seconds`` s gave, and its deviation, rad/s."""

    gyro_bias: list[float]
    gyro_bias_std: float
    seconds: float

    def to_dict(self) -> dict[str, Any]:
        """Return everything by name."""
        return {
            "gyro_bias": self.gyro_bias,
            "gyro_bias_std": self.gyro_bias_std,
            "seconds": self.seconds,
        }


class YawTurn(NamedTuple):
    """A turn of a track by ``yaw`` rad about the vertical through ``pivot`` m, then a ``shift``.

    ``joint`` says that the other foot turns with it.
    """

    yaw: float
    pivot: Triple
    shift: Triple
    joint: bool = False

    @classmethod
    def from_dict(cls, plain: Mapping[str, Any]) -> YawTurn:
        """Return the turn that `to_dict` gave."""
        px, py, pz = (float(v) for v in plain["pivot"])
        sx, sy, sz = (float(v) for v in plain["shift"])
        return cls(float(plain["yaw"]), (px, py, pz), (sx, sy, sz), bool(plain["joint"]))

    @property
    def rotation(self) -> FloatArray:
        """The rotation (3, 3)."""
        return about_z(self.yaw)

    def positions(self, points: FloatArray) -> FloatArray:
        """Return positions (N, 3) m turned and shifted."""
        return rotate_vectors(points - self.pivot, self.rotation) + self.pivot + self.shift

    def vectors(self, vectors: FloatArray) -> FloatArray:
        """Return vectors (N, 3) turned; they are not shifted."""
        return rotate_vectors(vectors, self.rotation)

    def quaternions(self, quaternions: FloatArray) -> FloatArray:
        """Return attitudes (N, 4) turned."""
        return turn_quaternions(quaternions, self.yaw)

    def covariances(self, matrices: FloatArray) -> FloatArray:
        """Return covariances (N, 3, 3) turned."""
        return rotate_covariances(matrices, self.rotation)

    def to_dict(self) -> dict[str, Any]:
        """Return yaw, pivot, shift and joint."""
        return {
            "yaw": self.yaw,
            "pivot": self.pivot,
            "shift": self.shift,
            "joint": self.joint,
        }


class DistanceLimit(NamedTuple):
    """A distance of the feet and its limit, m; ``after`` a correction, where there was one."""

    distance: float
    target: float
    after: float | None = None

    def to_dict(self) -> dict[str, Any]:
        """Return distance, target and distance after."""
        plain = {"distance": self.distance, "target": self.target}
        return plain if self.after is None else {**plain, "distance_after": self.after}


class Passing(NamedTuple):
    """One foot passing the other, and what the constraint there did to their separation.

    Attributes
    ----------
    limit : distance of the feet and what it was to be
    heading : rad, direction the person faces
    before, after : left minus right position (3,) m, without and with the constraint
    lateral : m, component of ``before`` to the left of the heading, where the method uses it
    """

    limit: DistanceLimit
    heading: float
    before: list[float]
    after: list[float]
    lateral: float | None = None

    def to_dict(self) -> dict[str, Any]:
        """Return everything by name."""
        lateral = {} if self.lateral is None else {"lateral": self.lateral}
        return {
            **self.limit.to_dict(),
            **lateral,
            "heading": self.heading,
            "separation": self.before,
            "separation_after": self.after,
        }


class FloorKind(StrEnum):
    """What carries a person.

    Attributes
    ----------
    LIFT : it moves up or down while both feet stand
    VEHICLE : it moves ahead while both feet stand
    WALKWAY : a moving walkway or an escalator, which the feet step on and off
    """

    LIFT = "lift"
    VEHICLE = "vehicle"
    WALKWAY = "walkway"


class Ride(NamedTuple):
    """A floor that carries the person: its velocity (3,) m/s, and how well that is known, m/s.

    ``seconds`` is how long it has carried the person.  When it does so no more (``over``), the
    velocity is the mean of that time, and zero for a vehicle, of which nothing is known.
    """

    kind: FloorKind
    velocity: Triple
    std: float
    up_std: float
    seconds: float
    over: bool = False

    def to_dict(self) -> dict[str, Any]:
        """Return everything by name."""
        return {
            "floor": str(self.kind),
            "velocity": list(self.velocity),
            "std": self.std,
            "up_std": self.up_std,
            "seconds": self.seconds,
            "over": self.over,
        }


@dataclass(frozen=True)
class FieldDirection:
    """The magnetic field (3,) T at a stance of ``foot`` (0, 1), and its level direction, rad."""

    foot: int
    field: Triple
    angle: float

    def to_dict(self) -> dict[str, Any]:
        """Return everything by name."""
        aid = "magnetic_heading"
        return {"aid": aid, "foot": self.foot, "field": self.field, "angle": self.angle}


class PressureHeight(NamedTuple):
    """The mean pressure height (m) of a stance, from the sensor worn at ``worn``."""

    worn: str
    height: float

    def to_dict(self) -> dict[str, Any]:
        """Return everything by name."""
        return {"aid": "barometer", "worn": self.worn, "height": self.height}
