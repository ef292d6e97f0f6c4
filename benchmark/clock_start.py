"""How right the first stamps of a device are, and how long one waits for them.

    python benchmark/clock_start.py [--runs 60] [--skew 100] [--seed 0]

Devices on links of several kinds are switched on.  A row has the time from the first sample to the
first one that is stamped, and the errors of the second that begins there, against true time plus
the least delay of the link; last, for comparison, those of the second that begins with the very
first sample, had its samples not been withheld.  The second table has clocks just beyond the skew
that is allowed: how many of them are stamped for a while, how long, and whether all are refused
after a minute.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable

import numpy as np
from rich.console import Console
from rich.table import Table

from dualfoot_ros.core.samples.series import FloatArray, IntArray
from dualfoot_ros.simulation.arrivals import BleLinkConfig, arrivals
from dualfoot_ros.timing import DeviceClock, DeviceClockConfig

START = 1_750_000_000_000_000_000
DURATION_S = 12.0
BEYOND = (1.02, 1.05, 1.1, 1.15, 1.2)  # times the skew that is allowed
MINUTE_S = 60.0
Delays = Callable[[FloatArray, np.random.Generator], FloatArray]


def wired(elapsed: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Return delays (N,) in s beyond the least one, of samples taken at ``elapsed`` (N,) s."""
    return rng.exponential(0.0002, len(elapsed))


def polled(period: float) -> Delays:
    """Return the delays of a link that is looked at once in ``period`` s."""

    def delays(elapsed: FloatArray, rng: np.random.Generator) -> FloatArray:
        phase = rng.uniform(0.0, period)
        wait = np.ceil((elapsed - phase) / period) * period + phase - elapsed
        return wait + rng.exponential(0.0002, len(elapsed))

    return delays


def wireless(elapsed: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Return the delays of datagrams: mostly some ms, in the tail much more."""
    slow = rng.random(len(elapsed)) < 0.02
    return rng.exponential(0.002, len(elapsed)) + slow * 0.02 * rng.pareto(1.5, len(elapsed))


def ble(burst: int, **options: float) -> Delays:
    """Return the delays of Bluetooth Low Energy with a random connection interval."""

    def delays(elapsed: FloatArray, rng: np.random.Generator) -> FloatArray:
        link = BleLinkConfig(interval=float(rng.uniform(0.015, 0.05)), burst=burst, **options)
        sampled = np.round(1e9 * elapsed).astype(np.int64)
        return 1e-9 * (arrivals(link, sampled, rng) - sampled) - link.least

    return delays


LINKS: dict[str, Delays] = {
    "wired": wired,
    "USB, 1 ms polls": polled(0.001),
    "USB serial, 16 ms latency timer": polled(0.016),
    "Wi-Fi": wireless,
    "Bluetooth, single samples": ble(1),
    "Bluetooth, bursts of 10": ble(10),
    "Bluetooth, bursts of 20, bad": ble(20, failure=0.3, stall_period=1.0),
}


def device_on(
    delays: Delays, skew_ppm: float, duration_s: float, rng: np.random.Generator
) -> tuple[FloatArray, IntArray, IntArray]:
    """Return elapsed time (N,) s, device stamps and arrivals (N,) ns, at a random rate."""
    rate = float(rng.choice([60.0, 100.0, 120.0, 200.0]))
    elapsed = np.arange(round(duration_s * rate)) / rate
    device = np.round(1e9 * (3600.0 + elapsed * (1.0 + 1e-6 * skew_ppm))).astype(np.int64)
    late = np.maximum.accumulate(elapsed + delays(elapsed, rng))
    return elapsed, device, START + np.round(1e9 * late).astype(np.int64)


def one_run(delays: Delays, skew_ppm: float, seed: int) -> tuple[float, FloatArray, FloatArray]:
    """Return when stamps begin (s), and the errors (ms) of that second and of the first one."""
    rng = np.random.default_rng(seed)
    skew_ppm *= rng.uniform(-1.0, 1.0)
    elapsed, device, arrived = device_on(delays, skew_ppm, DURATION_S, rng)
    clock, used, all_of_them = DeviceClock(), [], []
    for device_ns, arrival_ns in zip(device.tolist(), arrived.tolist(), strict=True):
        used.append(clock.update(device_ns, arrival_ns) is not None)
        all_of_them.append(clock.translate(device_ns))
    error = 1e3 * (1e-9 * (np.array(all_of_them) - START) - elapsed)
    first, second = int(np.argmax(used)), round(1.0 / elapsed[1])
    begins = float(elapsed[first]) if any(used) else float("inf")
    return begins, error[first : first + second], error[:second]


def start_table(runs: int, skew_ppm: float, seed: int) -> Table:
    """Return the table of the first stamps."""
    table = Table(title=f"first stamps, skew +-{skew_ppm:g} ppm")
    for column in ("link", "begins s, median", "latest", "rms ms", "worst ms, median", "95 %",
                   "largest", "not withheld: rms", "worst, median", "largest"):  # fmt: skip
        table.add_column(column)
    for name, delays in LINKS.items():
        found = [one_run(delays, skew_ppm, seed + k) for k in range(runs)]
        begins, *errors = zip(*found, strict=True)
        (rms, worst), (rms_all, worst_all) = map(_sizes, errors)
        figures = [np.median(begins), max(begins), rms, np.median(worst), np.quantile(worst, 0.95)]
        figures += [worst.max(), rms_all, np.median(worst_all), worst_all.max()]
        table.add_row(name, *(f"{figure:.1f}" for figure in figures))
    return table


def limit_table(runs: int, seed: int) -> Table:
    """Return the table of clocks whose skew is just beyond what is allowed, on all links."""
    table = Table(title="clocks beyond the limit of the skew")
    for column in ("skew ppm", "clocks", "stamped", "s, median", "longest", "refused at the end"):
        table.add_column(column)
    for times in BEYOND:
        stamped, refused = [], 0
        for number, delays in enumerate(LINKS.values()):
            for k in range(runs):
                rng = np.random.default_rng([number, seed + k])
                skew_ppm = times * DeviceClockConfig().max_skew * rng.choice([-1.0, 1.0])
                elapsed, device, arrived = device_on(delays, skew_ppm, MINUTE_S, rng)
                clock = DeviceClock()
                pairs = zip(device.tolist(), arrived.tolist(), strict=True)
                used = sum(clock.update(*pair) is not None for pair in pairs)
                stamped += [used * elapsed[1]] if used else []
                refused += clock.state.phase == "refused"
        figures = [f"{np.median(stamped):.0f}", f"{max(stamped):.0f}"] if stamped else ["", ""]
        clocks = runs * len(LINKS)
        row = [f"+-{times * DeviceClockConfig().max_skew:.0f}", str(clocks), str(len(stamped))]
        table.add_row(*row, *figures, f"{refused} of {clocks}")
    return table


def _sizes(errors: tuple[FloatArray, ...]) -> tuple[float, FloatArray]:
    """Return the rms over all runs and the largest error of each."""
    rms = float(np.sqrt(np.mean([np.mean(each**2) for each in errors])))
    return rms, np.array([np.abs(each).max() for each in errors])


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=60, help="devices a link")
    parser.add_argument("--skew", type=float, default=100.0, help="largest skew, ppm")
    parser.add_argument("--seed", type=int, default=0)
    args = parser.parse_args()
    console = Console(width=140)
    console.print(start_table(args.runs, args.skew, args.seed))
    console.print(limit_table(max(args.runs // 5, 1), args.seed))


if __name__ == "__main__":
    main()
