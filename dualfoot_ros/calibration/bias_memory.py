"""A memory of gyro biases: what earlier stands told, as a prior for the next walk.

A small YAML file for a pair of sensors, each worn on the same foot every time::

    format: dualfoot_bias_memory
    version: 1
    stands:
      left:
        - {date: 2026-11-28T20:15:00, gyro_bias: [0.0012, -0.0031, 0.0008], std: 0.0004}
      right: [...]

Biases are in rad/s and sensor axes; ``temperature`` (degrees Celsius) may stand beside them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from ..core import FEET, BiasPrior, CalibrationError, Event, EventKind, FloatArray, Trajectory
from ..recording import write_text

FORMAT, VERSION = "dualfoot_bias_memory", 1
KEPT = 20  # newest stands that are kept for each foot
FROM_WALK_TO_WALK = 2e-3  # rad/s, scatter of a bias that only one stand has told
LARGEST = 0.5  # rad/s
SAME = 0.1  # deviations, from a stand to the same one with other parameters of the filter
FIRST_DATE = "2000"  # earlier ones count the seconds of a device


@dataclass(frozen=True)
class RememberedStand:
    """What one stand told: gyro bias (3,) and its standard deviation, rad/s, and when."""

    date: str
    gyro_bias: tuple[float, float, float]
    std: float
    temperature: float | None = None

    def is_same(self, other: RememberedStand) -> bool:
        """Return whether the other is this stand, told once more."""
        apart = max(abs(a - b) for a, b in zip(self.gyro_bias, other.gyro_bias, strict=True))
        return self.date == other.date and apart < SAME * self.std

    def to_dict(self) -> dict[str, Any]:
        """Return it as it stands in the file."""
        plain: dict[str, Any] = {
            "date": self.date,
            "gyro_bias": [round(value, 9) for value in self.gyro_bias],
            "std": round(self.std, 9),
        }
        return plain if self.temperature is None else {**plain, "temperature": self.temperature}


@dataclass
class BiasMemory:
    """The stands of both feet, oldest first."""

    stands: dict[str, list[RememberedStand]] = field(
        default_factory=lambda: {foot: [] for foot in FEET}
    )

    @classmethod
    def load(cls, path: str | Path) -> BiasMemory:
        """Read a file; one that does not exist yet is an empty memory.

        Raises
        ------
        CalibrationError
            When the file cannot be read, or is no bias memory.
        """
        import yaml

        path = Path(path).expanduser()
        if not path.exists():
            return cls()
        try:
            content = yaml.safe_load(path.read_text(encoding="utf-8"))
            return cls(_stands(content))
        except (OSError, UnicodeDecodeError, yaml.YAMLError, TypeError, ValueError) as error:
            raise CalibrationError(f"bias memory {path} cannot be used: {error}") from None

    def save(self, path: str | Path) -> Path:
        """Write the file, whole or not at all; return its path."""
        import yaml

        plain = {foot: [each.to_dict() for each in stands] for foot, stands in self.stands.items()}
        content = {"format": FORMAT, "version": VERSION, "stands": plain}
        path = Path(path).expanduser()
        write_text(path, yaml.safe_dump(content, sort_keys=False, default_flow_style=None))
        return path

    def priors(self) -> dict[str, BiasPrior]:
        """Return what is known of the gyro bias of each foot before the next walk."""
        return {foot: prior_of(stands) for foot, stands in self.stands.items() if stands}

    def without(self, begin_ns: int, end_ns: int) -> BiasMemory:
        """Return the memory without stands in that time, which are those of the walk itself.

        Stamps that are no date of a calendar tell nothing, and nothing is left out.
        """
        begin, end = _date(begin_ns), _date(end_ns)
        if begin < FIRST_DATE:
            return self
        kept = {
            foot: [each for each in stands if not begin <= each.date <= end]
            for foot, stands in self.stands.items()
        }
        return BiasMemory(kept)

    def remember(self, foot: str, stand: RememberedStand) -> None:
        """Add a stand of ``foot``, in place of itself where it is known; the oldest go."""
        others = [each for each in self.stands[foot] if not each.is_same(stand)]
        self.stands[foot] = [*others, stand][-KEPT:]


def prior_of(stands: Sequence[RememberedStand]) -> BiasPrior:
    """Return mean and deviation of the bias of the next walk, from those of earlier ones.

    The deviation is that from walk to walk (scatter of the stands), of the mean, and of the stands
    themselves.
    """
    biases = np.array([stand.gyro_bias for stand in stands])
    own = math.sqrt(float(np.mean([stand.std**2 for stand in stands])))
    mean: FloatArray = biases.mean(axis=0)
    if len(stands) == 1:
        return BiasPrior(mean, math.hypot(FROM_WALK_TO_WALK, own))
    scatter = float(biases.std(axis=0, ddof=1).max()) * math.sqrt(1.0 + 1.0 / len(stands))
    return BiasPrior(mean, math.hypot(scatter, own))


def stands_of(trajectory: Trajectory) -> dict[str, RememberedStand]:
    """Return what the best stand of each foot has told, of the feet that have stood."""
    found: dict[str, RememberedStand] = {}
    stands_in(trajectory.events, found)
    return found


def stands_in(events: Iterable[Event], found: dict[str, RememberedStand]) -> None:
    """Keep in ``found`` the best stand of each foot among those before and in ``events``."""
    for event in events:
        details = event.detail
        if event.kind is EventKind.ALIGNED and details["start"] != "first_stance":
            for foot in FEET:
                found[foot] = _stand(
                    event.stamp_ns, details[f"{foot}_gyro_bias"], details["gyro_bias_std"]
                )
        elif event.kind is EventKind.STOOD:
            known = found.get(event.foot)
            if known is None or details["gyro_bias_std"] <= known.std:
                found[event.foot] = _stand(
                    event.stamp_ns, details["gyro_bias"], details["gyro_bias_std"]
                )


def _stand(stamp_ns: int, bias: Sequence[float], std: float) -> RememberedStand:
    x, y, z = (float(value) for value in bias)
    return RememberedStand(_date(stamp_ns), (x, y, z), float(std))


def _date(stamp_ns: int) -> str:
    """Return a stamp as a date to the second; dates sort as they follow each other."""
    return datetime.fromtimestamp(stamp_ns * 1e-9, UTC).isoformat(timespec="seconds")


def _stands(content: Any) -> dict[str, list[RememberedStand]]:
    if not isinstance(content, Mapping) or content.get("format") != FORMAT:
        raise ValueError(f"format is not {FORMAT!r}")
    if content.get("version") != VERSION:
        raise ValueError(f"version is {content.get('version')!r}; allowed is {VERSION}")
    given = content.get("stands") or {}
    unknown = set(given) - set(FEET)
    if unknown:
        raise ValueError(f"stands of {sorted(unknown)}; allowed are left and right")
    return {foot: [_checked(foot, each) for each in given.get(foot) or ()] for foot in FEET}


def _checked(foot: str, given: Mapping[str, Any]) -> RememberedStand:
    x, y, z = (float(value) for value in given["gyro_bias"])
    std = float(given["std"])
    if not all(abs(value) <= LARGEST for value in (x, y, z)):
        raise ValueError(f"gyro_bias {[x, y, z]} of the {foot} foot is above {LARGEST} rad/s")
    if not 0.0 < std <= LARGEST:
        raise ValueError(f"std {std} of the {foot} foot; allowed is more than 0, up to {LARGEST}")
    warmth = given.get("temperature")
    temperature = None if warmth is None else float(warmth)
    return RememberedStand(str(given.get("date", "")), (x, y, z), std, temperature)
