"""The person's track on the map: GeoJSON, KML and GPX."""

from __future__ import annotations

import json
from dataclasses import dataclass
from datetime import UTC, datetime
from html import escape
from pathlib import Path

import numpy as np

from ...core import FloatArray
from ..frames.association import seconds
from ..tracked_person import PersonTrack
from .geo_origin import GeoOrigin

POINT_S = 0.5
"""Time from one point of a track on the map to the next."""

DIGITS = 8  # of a degree: 1 mm


@dataclass(frozen=True)
class _Points:
    """Points of a track: degrees (K, 2), height above the start (K,) m, 95 % radius, time."""

    degrees: FloatArray
    height: FloatArray
    radius: FloatArray
    stamp_ns: list[int]

    @classmethod
    def of(cls, person: PersonTrack, origin: GeoOrigin) -> _Points:
        time = seconds(person.stamp_ns, int(person.stamp_ns[0]))
        even = np.searchsorted(time, np.arange(0.0, time[-1], POINT_S))
        rows = np.unique(np.append(even, len(time) - 1))
        return cls(
            origin.degrees(person)[rows],
            (person.floor_m - person.floor_m[0])[rows],
            person.at(rows).radius_95_m,
            person.stamp_ns[rows].tolist(),
        )

    def place(self, k: int) -> tuple[str, str]:
        """Return longitude and latitude of point ``k`` as text."""
        lon, lat = self.degrees[k]
        return f"{lon:.{DIGITS}f}", f"{lat:.{DIGITS}f}"


def write_geo_files(
    directory: Path, person: PersonTrack, origin: GeoOrigin, name: str
) -> list[Path]:
    """Write ``person.geojson``, ``person.kml`` and ``person.gpx``; return their paths.

    Heights are above the start, whose own height is not known.
    """
    points = _Points.of(person, origin)
    made = {"geojson": _geojson, "kml": _kml, "gpx": _gpx}
    paths = [directory / f"person.{ending}" for ending in made]
    for path, make in zip(paths, made.values(), strict=True):
        path.write_text(make(points, name), encoding="utf-8")
    return paths


def _geojson(points: _Points, name: str) -> str:
    """Return a GeoJSON (RFC 7946): the line, and its two ends."""
    places = [
        [round(float(lon), DIGITS), round(float(lat), DIGITS), round(float(height), 3)]
        for (lon, lat), height in zip(points.degrees, points.height, strict=True)
    ]
    line = _feature(
        "LineString",
        places,
        {
            "name": name,
            "times": [_utc(stamp) for stamp in points.stamp_ns],
            "radius_95_m": [round(float(r), 3) for r in points.radius],
        },
    )
    start = _feature("Point", places[0], {"name": "start"})
    radius = round(float(points.radius[-1]), 3)
    end = _feature("Point", places[-1], {"name": "end", "radius_95_m": radius})
    return json.dumps({"type": "FeatureCollection", "features": [line, start, end]}) + "\n"


def _feature(kind: str, coordinates: object, properties: dict[str, object]) -> dict[str, object]:
    geometry = {"type": kind, "coordinates": coordinates}
    return {"type": "Feature", "geometry": geometry, "properties": properties}


def _kml(points: _Points, name: str) -> str:
    """Return a KML 2.2 document with the line and its two ends."""
    places = [
        f"{','.join(points.place(k))},{height:.3f}" for k, height in enumerate(points.height)
    ]
    ends = "\n".join(
        f"<Placemark><name>{label}</name><Point><altitudeMode>relativeToGround</altitudeMode>"
        f"<coordinates>{place}</coordinates></Point></Placemark>"
        for label, place in (("start", places[0]), ("end", places[-1]))
    )
    return f"""\
<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2">
<Document><name>{escape(name, quote=False)}</name>
<Style id="track"><LineStyle><color>ff8f3f4b</color><width>4</width></LineStyle></Style>
<Placemark><name>{escape(name, quote=False)}</name><styleUrl>#track</styleUrl>
<LineString><altitudeMode>relativeToGround</altitudeMode>
<coordinates>{" ".join(places)}</coordinates></LineString></Placemark>
{ends}
</Document>
</kml>
"""


def _gpx(points: _Points, name: str) -> str:
    """Return a GPX 1.1 track."""
    rows = []
    for k, (height, stamp) in enumerate(zip(points.height, points.stamp_ns, strict=True)):
        lon, lat = points.place(k)
        rows.append(
            f'<trkpt lat="{lat}" lon="{lon}"><ele>{height:.3f}</ele>'
            f"<time>{_utc(stamp)}</time></trkpt>"
        )
    return f"""\
<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="dualfoot_ros" xmlns="http://www.topografix.com/GPX/1/1">
<trk><name>{escape(name, quote=False)}</name><trkseg>
{chr(10).join(rows)}
</trkseg></trk>
</gpx>
"""


def _utc(stamp_ns: int) -> str:
    whole, rest = divmod(stamp_ns, 1_000_000_000)
    return f"{datetime.fromtimestamp(whole, UTC):%Y-%m-%dT%H:%M:%S}.{rest // 1_000_000:03d}Z"
