"""The place on the Earth where a walk started, and latitude and longitude of its track."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core import EvaluationError, FloatArray
from ..tracked_person import PersonTrack

SEMI_MAJOR_M = 6_378_137.0  # WGS 84
ECCENTRICITY_2 = 6.694379990141e-3
HEADING_M = 3.0
"""The first metres, which show in which direction a walk starts."""

MOST_LATITUDE = 85.0
EAST = 90.0  # on a compass
NORTH = 90.0  # from the x axis of a map


@dataclass(frozen=True)
class GeoOrigin:
    """Where and in which direction a walk starts.

    Attributes
    ----------
    latitude, longitude : degrees, WGS 84, of the point between the feet at the start
    heading : compass bearing of the first metres, degrees clockwise from north; None leaves x to
        the east and y to the north
    """

    latitude: float
    longitude: float
    heading: float | None = None

    @classmethod
    def parse(cls, text: str) -> GeoOrigin:
        """Read ``LAT,LON`` or ``LAT,LON,HEADING`` in degrees.

        Raises
        ------
        EvaluationError
            When it is none; names what is allowed.
        """
        try:
            values = [float(part) for part in text.split(",")]
        except ValueError:
            values = []
        if len(values) not in (2, 3) or not all(map(math.isfinite, values)):
            raise EvaluationError(
                f"--origin is '{text}'; allowed is LAT,LON or LAT,LON,HEADING in degrees"
            )
        if abs(values[0]) > MOST_LATITUDE or abs(values[1]) > 180:
            raise EvaluationError(
                f"--origin is '{text}'; allowed are latitudes within +-{MOST_LATITUDE:g} and "
                "longitudes within +-180 degrees"
            )
        return cls(*values)

    def degrees(self, person: PersonTrack) -> FloatArray:
        """Return (N, 2) longitude and latitude of a track, in the plane that touches the start.

        The radii of curvature are those of WGS 84 at the start; 10 km away that is about 8 m off.
        """
        east, north = self._east_north(person)
        phi = math.radians(self.latitude)
        w = math.sqrt(1.0 - ECCENTRICITY_2 * math.sin(phi) ** 2)
        prime, meridian = SEMI_MAJOR_M / w, SEMI_MAJOR_M * (1.0 - ECCENTRICITY_2) / w**3
        latitude = self.latitude + np.degrees(north / meridian)
        longitude = self.longitude + np.degrees(east / (prime * math.cos(phi)))
        return np.column_stack([np.mod(longitude + 180.0, 360.0) - 180.0, latitude])

    def _east_north(self, person: PersonTrack) -> tuple[FloatArray, FloatArray]:
        x, y = (person.position - person.position[0])[:, :2].T
        turn = self._turn(person)
        c, s = math.cos(turn), math.sin(turn)
        return c * x - s * y, s * x + c * y

    def north(self, person: PersonTrack) -> float:
        """Return the direction of north in the frame of a track, degrees from x to the left."""
        return NORTH - math.degrees(self._turn(person))

    def _turn(self, person: PersonTrack) -> float:
        """Return by how much the track is turned to the left, rad, to start along ``heading``."""
        if self.heading is None:
            return 0.0
        return math.radians(EAST - self.heading) - start_direction(person)


def start_direction(person: PersonTrack) -> float:
    """Return the direction of the first metres of a walk in its own frame, rad from x."""
    ahead = min(int(np.searchsorted(person.walked_m, HEADING_M)), len(person.walked_m) - 1)
    way = person.position[ahead] - person.position[0]
    return math.atan2(way[1], way[0])
