"""How well a device's clock is followed over a Bluetooth Low Energy link, and what that costs.

    python benchmark/clock_accuracy.py [--runs 60] [--walks 4] [--seed 0] [--waits events|own]

First table: devices with random offset (+-1 h), skew (+-2000 ppm), a 32-bit counter of
microseconds that wraps, sampling rate and connection interval; error of the host time after 20 s
against true time plus the least delay of the link.  A run is *starved* when for more than 8 s no
notification arrives within 2 ms of the least delay: with ``--waits events`` the notification
period is then nearly a multiple of the connection interval, or of a simple part of it, with
``own`` the link is crowded.  Last how far the offset is off at the end, what the model says of
that, and how many are off by more than three times what it says.

Second table: simulated walks; the same samples once with their true times and once with those of
the clock model, both through aligner and tracker as they are by default; largest and final
distance between the two tracks of a foot in percent of the distance walked.  The devices are on
for 20 s before the tracker starts, and it sees the same samples both times, as one more or less
of the standstill alone would move a track.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass

import numpy as np
from rich.console import Console
from rich.table import Table

from dualfoot_ros.core import DualFootTracker, ImuSeries, TrackerConfig
from dualfoot_ros.core.results.events import FEET
from dualfoot_ros.core.results.trajectory import Trajectory
from dualfoot_ros.simulation import ClockConfig, WalkConfig, simulate
from dualfoot_ros.simulation.arrivals import BleLinkConfig, arrivals
from dualfoot_ros.timing import Aligner, CounterConfig, DeviceClock, Unwrapper

START = 1_750_000_000_000_000_000
SETTLED_S = 20.0
STARVED_S, FAST_S = 8.0, 0.002
WRAP = 1 << 32


@dataclass(frozen=True)
class Run:
    """Errors of one device after 20 s, ms; ``common`` is their mean, ``rms`` and ``worst`` all.

    They are of the samples that were stamped; ``refused`` tells that some were not.  ``last`` is
    the error at the end, ``says`` its standard deviation by the model itself.
    """

    burst: int
    rms: float
    worst: float
    common: float
    skew_error_ppm: float
    starved: bool
    refused: bool
    last: float
    says: float


def follow(device_ns: np.ndarray, arrival_ns: np.ndarray) -> tuple[np.ndarray, DeviceClock]:
    """Return the host times (N,) ns that the model gives, sample by sample."""
    start = int(device_ns[0]) // 1000
    wraps_after_12_s = WRAP - 12_000_000
    unwrapper, clock = Unwrapper(CounterConfig()), DeviceClock()
    found = np.empty(len(device_ns), dtype=np.int64)
    for i, (device, arrived) in enumerate(
        zip(device_ns.tolist(), arrival_ns.tolist(), strict=True)
    ):
        count = (device // 1000 - start + wraps_after_12_s) % WRAP
        host = clock.update(unwrapper.time_ns(count, arrived), arrived)
        found[i] = 0 if host is None else host
    return found, clock


def own_waits(link: BleLinkConfig, sampled_ns: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Return arrivals (N,) ns over a link on which each notification's wait is drawn anew.

    No lattice of events: the wait is anything up to an interval, and an interval more for each
    failure.  Notifications arrive in order, so one that waits holds up those behind it.
    """
    last = np.append(np.arange(link.burst - 1, len(sampled_ns) - 1, link.burst), -1)
    count = len(last)
    wait = rng.uniform(0.0, link.interval, count)
    wait += link.interval * (rng.geometric(1.0 - link.failure, count) - 1)
    sent = (sampled_ns[last] - sampled_ns[0]) * 1e-9 + wait
    stalls = 2 * int(sent.max() / link.stall_period) + 20
    begin = np.cumsum(rng.exponential(link.stall_period, stalls) + link.stall)
    which = np.searchsorted(begin, sent, side="right") - 1
    over = np.where(which >= 0, begin[np.maximum(which, 0)] + link.stall, -np.inf)
    slow = link.tail * rng.pareto(link.tail_shape, count) * (rng.random(count) < link.tail_share)
    handed = np.maximum(sent, over) + link.least + slow
    handed += link.handling * rng.exponential(size=count)
    received = sampled_ns[0] + np.ceil(np.maximum.accumulate(handed) * 1e9).astype(np.int64)
    return received[np.minimum(np.arange(len(sampled_ns)) // link.burst, count - 1)]


def one_run(burst: int, seed: int, waits: str = "events", duration_s: float = 60.0) -> Run:
    """Follow one random device over one random link."""
    rng = np.random.default_rng([burst, seed])
    rate = float(rng.choice([60.0, 100.0, 120.0, 200.0]))
    link = BleLinkConfig(interval=float(rng.uniform(0.015, 0.05)), burst=burst)
    drift, offset = float(rng.uniform(-2000.0, 2000.0)), float(rng.uniform(-3600.0, 3600.0))
    speed = 1.0 + 1e-6 * drift
    elapsed = np.arange(int(duration_s * rate)) / (rate * speed)
    true = START + np.round(1e9 * elapsed).astype(np.int64)
    device = START + round(1e9 * offset) + np.round(1e9 * elapsed * speed).astype(np.int64)
    arrived = {"events": arrivals, "own": own_waits}[waits](link, true, rng)
    found, clock = follow(device, arrived)
    settled, stamped = elapsed >= SETTLED_S, found > 0
    error = ((found - true)[settled & stamped]) * 1e-6 - 1e3 * link.least
    fast = elapsed[(arrived - true) * 1e-9 < link.least + FAST_S]
    hungry = np.diff(np.concatenate(([0.0], fast, [duration_s])))
    return Run(
        burst=burst,
        rms=float(np.sqrt(np.mean(error**2))),
        worst=float(np.abs(error).max()),
        common=float(error.mean()),
        skew_error_ppm=clock.state.skew_ppm - drift,
        starved=bool(hungry.max() > STARVED_S),
        refused=bool((settled & ~stamped).any()),
        last=float(error[-1]),
        says=1e3 * clock.state.offset_std_s,
    )


def clock_table(runs: int, seed: int, waits: str) -> Table:
    """Return the table of the errors of the clocks."""
    table = Table(title=f"host time after 20 s, BLE, waits: {waits}")
    for column in ("burst", "link", "runs", "rms ms", "95 %", "max", "worst ms, median", "95 %",
                   "max", "within 1, 3 ms", "skew rms ppm", "refused", "at the end: rms", "says",
                   "beyond 3"):  # fmt: skip
        table.add_column(column)
    for burst in (1, 10):
        every = [one_run(burst, seed + k, waits) for k in range(runs)]
        for name, starved in (("fed", False), ("starved", True)):
            some = [r for r in every if r.starved == starved]
            if some:
                table.add_row(str(burst), name, str(len(some)), *_figures(some))
    return table


def _figures(runs: list[Run]) -> list[str]:
    rms, worst = np.array([r.rms for r in runs]), np.array([r.worst for r in runs])
    refused = np.array([r.refused for r in runs])
    last, says = np.array([r.last for r in runs]), np.array([r.says for r in runs])
    within = np.mean((rms <= 1.0) & (worst <= 3.0) & ~refused)
    skew = np.sqrt(np.mean([r.skew_error_ppm**2 for r in runs]))
    return [
        f"{np.sqrt(np.mean(rms**2)):.2f}",
        f"{np.quantile(rms, 0.95):.2f}",
        f"{rms.max():.2f}",
        f"{np.median(worst):.2f}",
        f"{np.quantile(worst, 0.95):.2f}",
        f"{worst.max():.2f}",
        f"{100.0 * within:.0f} %",
        f"{skew:.1f}",
        str(int(refused.sum())),
        f"{np.sqrt(np.mean(np.square(last))):.2f}",
        f"{np.sqrt(np.mean(np.square(says))):.2f}",
        f"{100.0 * np.mean(np.abs(last) > 3.0 * says):.0f} %",
    ]


def one_walk(seed: int, method: str) -> tuple[float, float, float]:
    """Return distance walked (m), largest and final distance between the two tracks (%)."""
    rng = np.random.default_rng(seed)
    clocks = tuple(
        ClockConfig(offset=float(rng.uniform(-3600, 3600)), drift=float(rng.uniform(-2000, 2000)))
        for _ in FEET
    )
    walk = WalkConfig(route="rectangle", laps=4, standing=SETTLED_S + 10.0)
    simulation = simulate(walk, None, (clocks[0], clocks[1]), seed)
    streams, exact, shift = {}, {}, {}
    for foot in FEET:
        series = getattr(simulation, foot)
        true = getattr(simulation, f"{foot}_truth").stamp_ns
        link = BleLinkConfig(interval=float(rng.uniform(0.015, 0.05)))
        arrived = arrivals(link, true, rng)
        # The left foot, whose stamps are the grid, starts well within the right one's samples.
        use = (true - true[0]) * 1e-9 > SETTLED_S + (foot == "left")
        found, _ = follow(series.stamp_ns, arrived)
        streams[foot] = (arrived[use], found[use], series[use])
        exact[foot] = (true[use], true[use], series[use])
        shift[foot] = round(1e9 * link.least)
    perfect, real = track(exact, method), track(streams, method)
    return compare(perfect, real, shift)


def track(streams: dict[str, tuple[np.ndarray, np.ndarray, ImuSeries]], method: str) -> Trajectory:
    """Push the samples of both feet in the order of their arrival, and track the pairs."""
    aligner = Aligner()
    order = sorted(
        (int(arrived), i, foot) for foot in FEET for i, arrived in enumerate(streams[foot][0])
    )
    pairs = []
    for _, i, foot in order:
        _, stamps, series = streams[foot]
        values = np.concatenate([series.specific_force[i], series.angular_rate[i]])
        pairs += aligner.push(foot, int(stamps[i]), values)
    stamps = np.array([p.stamp_ns for p in pairs])
    values = np.array([p.values for p in pairs])
    left = ImuSeries(stamps, values[:, 0:3], values[:, 3:6])
    right = ImuSeries(stamps, values[:, 6:9], values[:, 9:12])
    config = TrackerConfig.from_mapping({"method": method})
    return DualFootTracker(config, engine="compiled").run(left, right)


def compare(
    perfect: Trajectory, real: Trajectory, shift: dict[str, int]
) -> tuple[float, float, float]:
    """Return distance (m), largest and final distance between the tracks of a foot (%)."""
    largest, final, distance = 0.0, 0.0, perfect.left.distance_m
    for foot in FEET:
        one, two = getattr(perfect, foot), getattr(real, foot)
        start = int(one.stamp_ns[0])
        at = (one.stamp_ns - start) * 1e-9
        also = (two.stamp_ns - shift["left"] - start) * 1e-9
        other = np.array([np.interp(at, also, two.position[:, k]) for k in range(3)]).T
        # In stance only: at 5 m/s of the swinging foot the time axis itself makes millimetres.
        apart = np.linalg.norm(other - one.position, axis=1)[one.stance]
        largest, final = max(largest, float(apart.max())), max(final, float(apart[-1]))
    return distance, 100.0 * largest / distance, 100.0 * final / distance


def walk_table(walks: int, seed: int) -> Table:
    """Return the table of what the clock model costs in the trajectory."""
    table = Table("method", "walks", "distance m", "largest %", "final %",
                  title="tracks with followed clocks against perfect ones")  # fmt: skip
    for method in ("zupt", "idc", "spacing_vector"):
        found = np.array([one_walk(seed + k, method) for k in range(walks)])
        table.add_row(
            method,
            str(walks),
            f"{found[:, 0].mean():.0f}",
            f"{np.median(found[:, 1]):.3f} (worst {found[:, 1].max():.3f})",
            f"{np.median(found[:, 2]):.3f} (worst {found[:, 2].max():.3f})",
        )
    return table


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=60, help="devices a row of the first table")
    parser.add_argument("--walks", type=int, default=4, help="walks a row of the second table")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument(
        "--waits",
        choices=("events", "own"),
        default="events",
        help="for the next connection event, or drawn anew for each notification (first table)",
    )
    args = parser.parse_args()
    console = Console(width=180)
    console.print(clock_table(args.runs, args.seed, args.waits))
    if args.walks:
        console.print(walk_table(args.walks, args.seed))


if __name__ == "__main__":
    main()
