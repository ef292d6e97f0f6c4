"""References of a walk that are not measured at every moment: floor markers, a closed loop.

The file is a small YAML, ``reference.yaml`` inside the folder of the bag::

    format: dualfoot_reference
    version: 1
    source: tape measure, hall 3      # of the points
    frame: floor                      # level, z up; its origin and heading are free
    unit: m
    closed_loop: true                 # each foot ends where it started
    length: 24.0                      # walked way, or null when unknown
    markers:                          # where each stance of a foot stood, in order
      right:
        - [0.0, 0.0]                  # x y, or x y z
        - [1.2, 0.0]
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..core import FEET, FloatArray, RecordingError

FILE_NAME = "reference.yaml"
FORMAT = "dualfoot_reference"
VERSION = 1
KEYS = ("format", "version", "source", "frame", "unit", "closed_loop", "length", "markers")


@dataclass(frozen=True)
class Reference:
    """Floor markers and other knowledge of a walk.

    Attributes
    ----------
    source : of the reference, such as "tape measure, hall 3"
    markers : foot -> (K, 3) m, one point for each stance of that foot, in order; may be empty
    closed_loop : each foot ends where it started
    length_m : the walked way, or None when it is not known
    frame : name of the level frame (z up) of the points; its origin and heading are free
    """

    source: str
    markers: Mapping[str, FloatArray] = field(default_factory=dict)
    closed_loop: bool = False
    length_m: float | None = None
    frame: str = "floor"

    def summary(self) -> str:
        """Return the reference in one line."""
        parts = [
            f"{len(points)} markers of the {foot} foot" for foot, points in self.markers.items()
        ]
        parts += ["the way closes"] if self.closed_loop else []
        parts += [f"{self.length_m:g} m long"] if self.length_m is not None else []
        return f"{', '.join(parts) or 'nothing'} ({self.source})"

    def save(self, path: str | Path) -> None:
        """Write the reference to ``path``, whole or not at all; raise OSError when it cannot."""
        import yaml

        from .atomic import write_text  # here: most programs only read one

        document = {
            "format": FORMAT,
            "version": VERSION,
            "source": self.source,
            "frame": self.frame,
            "unit": "m",
            "closed_loop": self.closed_loop,
            "length": self.length_m,
            "markers": {
                foot: [[round(float(v), 6) for v in point] for point in points]
                for foot, points in self.markers.items()
            },
        }
        text = yaml.safe_dump(document, sort_keys=False, default_flow_style=None)
        write_text(Path(path), text)

    @classmethod
    def load(cls, path: str | Path) -> Reference:
        """Read a reference.

        Raises
        ------
        RecordingError
            When the file is no such YAML; the message names the key, its value and what is
            allowed.
        OSError
            When the file cannot be read.
        """
        import yaml

        try:
            document = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
        except (yaml.YAMLError, UnicodeDecodeError) as error:
            reason = " ".join(str(error).split())
            raise RecordingError(f"reference '{path}' is no YAML: {reason}") from None
        try:
            return cls._from_document(document)
        except RecordingError as error:
            raise RecordingError(f"reference '{path}': {error}") from None

    @classmethod
    def _from_document(cls, document: Any) -> Reference:
        if not isinstance(document, dict):
            raise RecordingError(f"allowed is a mapping with the keys {', '.join(KEYS)}")
        for key in document:
            if key not in KEYS:
                raise RecordingError(f"unknown key '{key}'; known: {', '.join(KEYS)}")
        _require("format", document.get("format"), document.get("format") == FORMAT, FORMAT)
        _require("version", document.get("version"), document.get("version") == VERSION, "1")
        _require("unit", document.get("unit", "m"), document.get("unit", "m") == "m", "m")
        closed = document.get("closed_loop", False)
        _require("closed_loop", closed, isinstance(closed, bool), "true or false")
        length = document.get("length")
        _require("length", length, length is None or _positive(length), "null or a length > 0 m")
        return cls(
            source=str(document.get("source", "")),
            markers=_markers(document.get("markers") or {}),
            closed_loop=closed,
            length_m=None if length is None else float(length),
            frame=str(document.get("frame", "floor")),
        )


def _require(key: str, value: Any, good: bool, allowed: str) -> None:
    if not good:
        raise RecordingError(f"'{key}' is {value!r}; allowed is {allowed}")


def _positive(value: Any) -> bool:
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return number and math.isfinite(value) and value > 0


def _markers(section: Any) -> dict[str, FloatArray]:
    _require("markers", section, isinstance(section, dict), "a list of points for left or right")
    for foot in section:
        _require("markers", foot, foot in FEET, "left or right")
    return {foot: _points(foot, points) for foot, points in section.items()}


def _points(foot: str, points: Any) -> FloatArray:
    allowed = "a list of at least two points, each [x, y] or [x, y, z] in m"
    _require(f"markers.{foot}", points, isinstance(points, list) and len(points) >= 2, allowed)
    rows = np.zeros((len(points), 3))
    for row, point in zip(rows, points, strict=True):
        good = isinstance(point, list) and len(point) in (2, 3) and all(map(_finite, point))
        _require(f"markers.{foot}", point, good, allowed)
        row[: len(point)] = point
    return rows


def _finite(value: Any) -> bool:
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return number and math.isfinite(value)
