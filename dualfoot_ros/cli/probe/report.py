"""Report of ``dualfoot probe`` on one source, and the parameters of ``bringup`` that follow."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import numpy as np

from ...core import RecordingError
from ...drivers import (
    BAUDS,
    Heard,
    SampleSeries,
    devices_on_bus,
    listen,
    make_decoder,
    parse_uri,
    series_of,
)
from ...inspection import ArrivalFacts, advice_on, arrival_facts, describe_arrival

LEAST_SAMPLES = 5
XBUS = "xbus"
FILE = "file:"
TABLE_FORMAT = "dot_csv"  # one layout of many, in which the importer looks at more than this does
TABLES = (".csv", ".txt", ".tsv")


@dataclass(frozen=True)
class ProbeReport:
    """What a source sends: facts where samples were found, problems, and what to change."""

    heard: Heard
    facts: ArrivalFacts | None = None
    problems: list[str] = field(default_factory=list)
    advice: Mapping[str, str] = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        """Return the report in plain values."""
        return {
            "uri": self.heard.uri,
            "bytes": self.heard.bytes,
            "formats": [found._asdict() for found in self.heard.recognised],
            "bauds_tried": list(self.heard.tried),
            "facts": None if self.facts is None else self.facts._asdict(),
            "problems": self.problems,
            "advice": dict(self.advice),
        }

    def print_words(self, foot: str) -> None:
        """Print everything but the parameters on standard error."""
        lines = [f"{foot}: {self.heard.uri}"]
        if self.facts is not None:
            lines.append(f"  {self.facts.samples} samples: {describe_arrival(self.facts)}")
        lines += [f"  {problem}" for problem in self.problems]
        lines += [f"  {name}: {text}" for name, text in self.advice.items()]
        if self.facts is not None and not self.advice:
            lines.append("  nothing to change")
        print("\n".join(lines), file=sys.stderr)

    def parameters(self) -> dict[str, str]:
        """Return the parameters of ``imu_adapter`` as YAML values."""
        values = {"source": f'"{self.heard.uri}"'}
        if self.facts is None:
            return values
        if self.facts.rate_hz > 0.0:
            values["checks"] = f"{{rate: {round(self.facts.rate_hz)}.0}}"
        if self.facts.axes is not None:
            values["mounting"] = f'{{axes: "{self.facts.axes}"}}'
        return values


def probe_one(uri: str, seconds: float) -> ProbeReport:
    """Listen to a source and report.

    Raises
    ------
    SourceError
        When the URI is wrong, or the source cannot be opened.
    """
    heard = listen(uri, seconds)
    if not heard.bytes:
        return ProbeReport(heard, problems=["nothing came: is the device on, and set to send?"])
    usable = [found.format for found in heard.recognised if found.samples]
    table = _table(uri)
    if table is not None and usable in ([], [TABLE_FORMAT]):
        return _probe_table(table, Heard(uri, heard.chunks, heard.recognised))
    if not usable and not heard.uri.startswith("ble:"):
        return ProbeReport(heard, problems=[_unusable(heard)])
    samples = _decode(heard)
    if len(samples) < LEAST_SAMPLES:
        return ProbeReport(heard, problems=[f"only {len(samples)} samples came"])
    stamps = samples.arrival_ns if samples.device_ns is None else samples.device_ns
    has_time = samples.device_ns is not None
    if not has_time and heard.uri.startswith(FILE):
        stamps = np.zeros_like(stamps)  # those of reading say nothing
    facts = arrival_facts(stamps, samples.specific_force, samples.angular_rate, has_time)
    return ProbeReport(heard, facts, _problems(heard), advice_on(facts, units_known=True))


def _table(uri: str) -> Path | None:
    """Return the table that a URI without options names, or None."""
    parts = urlsplit(uri)
    path = Path(unquote(parts.netloc + parts.path)).expanduser()
    named = parts.scheme == "file" and not parts.query and path.suffix.lower() in TABLES
    return path if named else None


def _probe_table(path: Path, heard: Heard) -> ProbeReport:
    """Report what the importer finds in a table, as ``imu_adapter`` reads it."""
    from ...recording.importers import read_sensors

    try:
        sensors = read_sensors(path)
    except RecordingError as error:
        return ProbeReport(heard, problems=[str(error)])
    series = next(iter(sensors.values()))
    facts = arrival_facts(series.stamp_ns, series.specific_force, series.angular_rate, True)
    problems = [] if len(sensors) == 1 else ["both feet are in it; described is the left one"]
    return ProbeReport(heard, facts, problems, advice_on(facts, units_known=True))


def _decode(heard: Heard) -> SampleSeries:
    parsed = parse_uri(heard.uri)
    decoder = make_decoder(parsed.format, parsed.decoder)
    samples = [s for c in heard.chunks for s in decoder.feed(c.data, c.arrival_ns)]
    return series_of(samples, live=parsed.scheme != "file")


def _unusable(heard: Heard) -> str:
    if heard.recognised:
        return heard.recognised[0].sentence
    text = f"{heard.bytes} bytes came, and no known format is in them"
    if heard.tried:
        return f"{text} at {', '.join(map(str, BAUDS))} baud"
    return text


def _problems(heard: Heard) -> list[str]:
    senders = sorted({chunk.sender for chunk in heard.chunks} - {""})
    if len(senders) > 1:
        names = ", ".join(senders)
        return [f"several devices send here: {names}; give each a port, or list peers= in the URI"]
    if heard.recognised and heard.recognised[0].format == XBUS:
        devices = devices_on_bus(chunk.data for chunk in heard.chunks)
        if len(devices) > 1:
            names = ", ".join(map(str, devices))
            return [f"several devices are on the bus: {names}; choose one with bus_id= in the URI"]
    return []


def yaml_of(reports: Mapping[str, ProbeReport]) -> str:
    """Return the parameter file of ``bringup`` for the sources with samples."""
    lines = []
    for foot, report in reports.items():
        if report.facts is None:
            continue
        lines += [f"/**/{foot}/imu_adapter:", "  ros__parameters:"]
        lines += [f"    {name}: {value}" for name, value in report.parameters().items()]
    return "".join(f"{line}\n" for line in lines)
