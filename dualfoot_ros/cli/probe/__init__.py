"""``dualfoot probe``: what a device sends, and which devices are there."""

from __future__ import annotations

import argparse
from typing import Any

from ...core import FEET, SourceError
from ..arguments import add_json_argument
from ..printing import print_json, print_warning

SHORTEST_S, LONGEST_S = 0.1, 600.0
HELP = "listen to a device: format, baud, rate, units, axes, clock, and the parameters for bringup"
EXAMPLES = """\
examples:
  dualfoot probe --scan                                 ports, Bluetooth, x-IMU3 that announce
  dualfoot probe serial:///dev/ttyUSB0                  tries the usual bauds and all formats
  dualfoot probe serial:///dev/ttyUSB0 udp://:8000      left and right foot, one YAML
  dualfoot probe udp://0.0.0.0:8000 --foot right --seconds 10
  dualfoot probe file://capture.bin

Keep the sensor still, as on a standing foot.  The YAML on standard output goes into a file for
'ros2 run dualfoot_ros bringup --ros-args --params-file FILE'; all else is on standard error.
The exit code is 2 when no sample was found.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "uri", nargs="*", metavar="URI", help="source; format and baud may be left out"
    )
    parser.add_argument("--scan", action="store_true", help="list the devices that are there")
    parser.add_argument(
        "--foot", choices=FEET, default="left", help="foot of a single URI (default: left)"
    )
    parser.add_argument(
        "--seconds", type=float, default=3.0, help="time to listen (default: %(default)s)"
    )
    add_json_argument(parser)


def run(args: argparse.Namespace) -> int:
    """Scan, or listen and describe; return 2 when no sample was found."""
    if args.scan == bool(args.uri) or len(args.uri) > len(FEET):
        raise SourceError("give one URI, two for the left and the right foot, or --scan")
    if not SHORTEST_S <= args.seconds <= LONGEST_S:
        raise SourceError(
            f"--seconds is {args.seconds:g}; allowed is {SHORTEST_S:g} to {LONGEST_S:g}"
        )
    return _scan(args) if args.scan else _probe(args)


def _scan(args: argparse.Namespace) -> int:
    from ...drivers import announced_devices, bluetooth_devices, serial_ports

    kinds: dict[str, Any] = {
        "serial ports": serial_ports,
        "Bluetooth devices": lambda: bluetooth_devices(args.seconds),
        "x-IMU3 in the network": lambda: announced_devices(args.seconds),
    }
    found: dict[str, Any] = {}
    for kind, look in kinds.items():
        try:
            found[kind] = [device._asdict() for device in look()]
        except SourceError as error:
            found[kind] = []
            print_warning("probe", f"{kind}: {error}")
    if args.json:
        print_json(found)
    else:
        _print_found(found)
    return 0


def _print_found(found: dict[str, Any]) -> None:
    for kind, devices in found.items():
        print(f"{kind}: {len(devices) or 'none'}")
        for device in devices:
            print(f"  {device['about'] or 'unnamed'}")
            for uri in device["uris"]:
                print(f"    dualfoot probe '{uri}'")


def _probe(args: argparse.Namespace) -> int:
    from .report import probe_one, yaml_of

    feet = FEET if len(args.uri) > 1 else (args.foot,)
    reports = {
        foot: probe_one(uri, args.seconds) for foot, uri in zip(feet, args.uri, strict=True)
    }
    if args.json:
        print_json({foot: report.to_dict() for foot, report in reports.items()})
    else:
        for foot, report in reports.items():
            report.print_words(foot)
        print(yaml_of(reports), end="")
    return 0 if all(report.facts for report in reports.values()) else 2
