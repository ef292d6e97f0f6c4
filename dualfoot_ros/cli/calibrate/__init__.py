"""``dualfoot calibrate``: sensors and gait, each from a recording made for it."""

from __future__ import annotations

import argparse

from . import accelerometer as calibrate_accelerometer
from . import gyro as calibrate_gyro
from . import spacing as calibrate_spacing
from . import walk as calibrate_walk

HELP = "calibrate accelerometer, gyro, noise, gyro matrix, and the distance of the feet in passing"
WHAT = {
    "accelerometer": calibrate_accelerometer,
    "gyro": calibrate_gyro,
    "spacing": calibrate_spacing,
    "walk": calibrate_walk,
}
EXAMPLES = "examples:\n" + "".join(module.FIRST for module in WHAT.values())


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the kinds of calibration, each with its own arguments."""
    parsers = parser.add_subparsers(dest="what", metavar="WHAT", required=True)
    for name, module in WHAT.items():
        part = parsers.add_parser(
            name,
            help=module.HELP,
            description=module.HELP,
            epilog=module.EXAMPLES,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        module.add_arguments(part)


def run(args: argparse.Namespace) -> int:
    """Calibrate ``args.what``; return the exit code."""
    code: int = WHAT[args.what].run(args)
    return code
