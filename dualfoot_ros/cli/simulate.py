"""``dualfoot simulate``: a walk with exact truth, as a bag."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from ..core import Increments
from .arguments import (
    add_bag_output_argument,
    add_json_argument,
    add_set_argument,
    add_storage_arguments,
    save_bag,
)
from .printing import print_json
from .simulate_options import barometer, configurations, magnetometer, show_choices

if TYPE_CHECKING:
    from ..core import PoseSeries
    from ..recording import Recording
    from ..simulation import Simulation

HELP = "simulate a walk with a sensor on each foot and exact truth, as a bag"
EXAMPLES = """\
examples:
  dualfoot simulate -o walk                                 a rectangle, consumer sensors, 100 Hz
  dualfoot simulate -o lap --route track --rate 200 --seed 7
  dualfoot simulate -o eight --route figure_eight --laps 3 --stops 4 --errors mirrored
  dualfoot simulate -o heels --mounting heel --set gait.min_distance=0.25
  dualfoot simulate -o clocks --set right_clock.offset=12.5 --set right_clock.drift=40
  dualfoot simulate -o board --route L --one-shoe 0.014     two sensors on the right shoe
  dualfoot simulate -o dots --rate 60 --increments compensated   as Xsens DOT send them
  dualfoot simulate -o climb --route stairs --barometer     air pressure too
  dualfoot simulate -o lap --route track --magnetometer     magnetic field too
  dualfoot simulate --list                                  routes, mountings, grades, parameters
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    add_bag_output_argument(parser)
    parser.add_argument("--list", action="store_true", help="show all choices, and exit")
    parser.add_argument(
        "--seed", type=int, default=0, help="seed of the random numbers (default: 0)"
    )
    _add_walk(parser)
    _add_sensor(parser)
    add_set_argument(parser, "any other parameter by its dotted name, see --list; may be repeated")
    _add_output(parser)


def _add_walk(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("walk")
    group.add_argument("--route", metavar="R", help="where to walk (default: rectangle)")
    group.add_argument("--laps", type=int, metavar="N", help="how often, on a closed route")
    group.add_argument("--speed", type=float, metavar="M/S", help="walking speed (default: 1.2)")
    group.add_argument("--stops", type=int, metavar="N", help="stops on the way (default: 0)")
    group.add_argument("--stop-duration", type=float, metavar="S", help="length of each stop")
    group.add_argument("--standing", type=float, metavar="S", help="standstill at the start")


def _add_sensor(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("sensors")
    group.add_argument("--rate", type=float, metavar="HZ", help="60 to 400 (default: 100)")
    group.add_argument("--mounting", metavar="M", help="instep or heel (default: instep)")
    group.add_argument("--grade", default="consumer", help="quality (default: %(default)s)")
    group.add_argument(
        "--increments",
        choices=[kind.value for kind in Increments],
        help="what the samples are (default: averaged)",
    )
    group.add_argument(
        "--errors",
        choices=("independent", "mirrored"),
        default="independent",
        help="relation of the errors of the two feet (default: %(default)s)",
    )
    group.add_argument(
        "--one-shoe",
        type=float,
        metavar="M",
        help="put both sensors on the right shoe, this far apart along it",
    )
    group.add_argument(
        "--barometer",
        nargs="?",
        const="feet",
        metavar="WORN",
        help="air pressure too, on the feet (default) or on the body",
    )
    group.add_argument(
        "--magnetometer", action="store_true", help="the magnetic field at both feet too"
    )


def _add_output(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("output")
    group.add_argument(
        "--truth-rate",
        type=float,
        metavar="HZ",
        help="thin the truth in the bag to about this rate (default: that of the samples)",
    )
    add_storage_arguments(group)
    add_json_argument(group)


def run(args: argparse.Namespace) -> int:
    """Simulate, write the bag and describe it; return the exit code."""
    from ..simulation import SimulationError

    if args.list:
        return show_choices(args.json)
    if args.output is None:
        raise SimulationError("no output given; name the bag to write with -o BAG")
    if args.seed < 0:
        raise SimulationError(f"--seed is {args.seed}; allowed is a whole number from 0")
    if args.truth_rate is not None and not args.truth_rate > 0.0:
        raise SimulationError(f"--truth-rate is {args.truth_rate:g}; allowed is more than 0 Hz")
    return _simulate(args)


def _simulate(args: argparse.Namespace) -> int:
    from ..simulation import rigid_pair, simulate, walk

    walk_config, sensor, clocks = configurations(args)
    walked = walk(walk_config, args.seed)
    if args.one_shoe is not None:
        walked = rigid_pair(walked, args.one_shoe)
    aids = barometer(args), magnetometer(args)
    simulation = simulate(walked, sensor, clocks, args.seed, *aids)
    save_bag(_recording(simulation, args), args)
    _report(args, simulation)
    return 0


def _recording(simulation: Simulation, args: argparse.Namespace) -> Recording:
    from ..recording import Recording

    config = simulation.walk.config
    notes = {
        "source": "dualfoot simulate",
        "route": f"{config.route}, {config.laps} x, seed {args.seed}",
        "sensors": f"{args.grade}, {args.errors} errors, {config.mounting}, "
        f"{config.rate:g} Hz, {simulation.left.increments}",
        "min_distance_m": f"{config.min_distance:g}",
    }
    step = 1 if args.truth_rate is None else max(1, round(config.rate / args.truth_rate))
    return Recording(
        left=simulation.left,
        right=simulation.right,
        left_truth=_thinned(simulation.left_truth, step),
        right_truth=_thinned(simulation.right_truth, step),
        pressure=simulation.pressure,
        notes=notes,
    )


def _thinned(truth: PoseSeries, step: int) -> PoseSeries:
    """Return every ``step``-th pose, and the last one."""
    import numpy as np

    from ..core import PoseSeries

    last = len(truth) - 1
    keep = np.unique(np.append(np.arange(0, last + 1, step), last))
    velocity = None if truth.velocity is None else truth.velocity[keep]
    return PoseSeries(truth.stamp_ns[keep], truth.position[keep], truth.quaternion[keep], velocity)


def _report(args: argparse.Namespace, simulation: Simulation) -> None:
    from ..simulation import summary

    facts = {"bag": str(args.output), "seed": args.seed, **summary(simulation)}
    if args.one_shoe is not None:
        facts["lever_arm_m"] = _lever_arm(simulation)
    if args.json:
        print_json(facts)
        return
    print(
        f"{args.output}: {facts['route']}, {facts['distance_m']:.0f} m in "
        f"{facts['duration_s']:.0f} s, {facts['left_samples']} + {facts['right_samples']} samples "
        f"at {facts['rate_hz']:g} Hz, {facts['left_stances']} + {facts['right_stances']} stances"
    )
    for worn, count in facts.get("pressure_samples", {}).items():
        print(f"{count} samples of air pressure, worn on {worn}")
    if "magnetic_field" in facts:
        print("every sample has the magnetic field")
    if "lever_arm_m" in facts:
        arm = ", ".join(f"{v:g}" for v in facts["lever_arm_m"])
        print(f"both sensors on the right shoe: --set rigid_pair.lever_arm='[{arm}]'")
    if facts["passes"]:
        print(
            f"the feet pass {facts['passes']} times at {facts['min_distance_mean_m']:.3f} +- "
            f"{facts['min_distance_std_m']:.3f} m, kappa {facts['kappa_mean']:.2f} +- "
            f"{facts['kappa_std']:.2f}"
        )


def _lever_arm(simulation: Simulation) -> list[float]:
    """Return where the second sensor on a shoe is from the first, in the first's axes (3,), m."""
    walked = simulation.walk
    arm = walked.mountings[0].T @ (walked.levers[1] - walked.levers[0])
    return [round(float(v), 6) for v in arm]
