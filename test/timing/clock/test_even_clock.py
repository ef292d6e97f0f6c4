"""Jitter is taken off the stamps of a sensor that samples regularly, sample by sample."""

import numpy as np
import pytest

from dualfoot_ros.timing import StampConfig, Stamps
from dualfoot_ros.timing.clock.even_clock import EvenClock

STEP_NS = 10_000_000
START_NS = 1_700_000_000 * 10**9
SECOND = 10**9


def sampled(seconds: float, step_ns: float = STEP_NS) -> np.ndarray:
    count = round(seconds * 1e9 / step_ns)
    return START_NS + np.rint(np.arange(count) * step_ns).astype(np.int64)


def late(kind: str, taken: np.ndarray, seed: int = 0) -> np.ndarray:
    """Return when samples arrive, in order, over a link of some kind."""
    rng = np.random.default_rng(seed)
    if kind == "bursts":
        last = np.minimum(np.arange(len(taken)) // 10 * 10 + 9, len(taken) - 1)
        return taken[last] + rng.uniform(0, 5e6, len(taken) // 10 + 1).astype(int)[last // 10]
    if kind == "polls":
        return taken + 16_000_000 - (taken + 3_000_000) % 16_000_000
    delay = (
        rng.uniform(0, 12e6, len(taken)) if kind == "uniform" else rng.exponential(6e6, len(taken))
    )
    return np.maximum.accumulate(taken + delay.astype(np.int64))


def even(times: np.ndarray) -> tuple[np.ndarray, EvenClock]:
    """Return the stamps (N,) ns, 0 where a sample is withheld, and the clock that gave them."""
    clock = EvenClock()
    return np.array([clock.update(t, 0) or 0 for t in times.tolist()], dtype=np.int64), clock


def errors_ms(stamps: np.ndarray, taken: np.ndarray) -> np.ndarray:
    """Return the errors of the stamps against what they have in common, after the first 6 s."""
    off = (stamps - taken)[stamps > 0][400:] * 1e-6
    return off - np.median(off)


@pytest.mark.parametrize("kind", ["uniform", "exponential", "polls", "bursts"])
@pytest.mark.parametrize("step_ns", [STEP_NS, STEP_NS * 1.0003])
def test_jitter_and_bursts_are_taken_off_to_half_a_millisecond(kind, step_ns):
    taken = sampled(40.0, step_ns)
    stamps, clock = even(late(kind, taken))
    assert np.abs(errors_ms(stamps, taken)).max() < 0.5
    assert clock.counters["holes"] == 0


def test_only_the_first_seconds_are_withheld_and_stamps_increase():
    taken = sampled(20.0)
    stamps, clock = even(late("uniform", taken))
    withheld = int((stamps == 0).sum())
    assert withheld == clock.counters["settling"] <= 500 and (stamps[withheld:] > 0).all()
    assert (np.diff(stamps[withheld:]) > 0).all()
    assert clock.state.phase in ("acquiring", "tracking")


@pytest.mark.parametrize("kind", ["uniform", "exponential", "bursts"])
def test_lost_samples_are_found_within_thirty(kind):
    taken = sampled(40.0)
    keep = np.ones(len(taken), dtype=bool)
    keep[[900, 1500, 1501, 2600]] = False
    stamps, clock = even(late(kind, taken)[keep])
    assert clock.counters["holes"] == 4
    wrong = np.abs((stamps - taken[keep])[600:] * 1e-6 - errors_base(stamps, taken[keep])) > 1.0
    assert wrong.sum() <= 3 * 30


def errors_base(stamps: np.ndarray, taken: np.ndarray) -> float:
    return float(np.median((stamps - taken)[stamps > 0][400:])) * 1e-6


@pytest.mark.parametrize("seconds", [5.0, 3600.0])
def test_after_a_silence_the_stamps_are_right_again_within_half_a_second(seconds):
    taken = np.concatenate([sampled(20.0), sampled(20.0) + round((20.0 + seconds) * SECOND)])
    stamps, _ = even(late("uniform", taken))
    off_ms = np.abs((stamps - taken) * 1e-6 - errors_base(stamps[:2000], taken[:2000]))
    assert off_ms[2050:].max() < 12.0
    assert off_ms[2300:].max() < 1.0


@pytest.mark.parametrize("jump_s", [-3600.0, -2.0, 3600.0])
def test_after_the_clock_of_the_headers_is_set_the_stamps_follow_it(jump_s):
    taken = sampled(30.0)
    jump = np.where(np.arange(len(taken)) < 1500, 0, round(jump_s * SECOND))
    stamps, _ = even(late("exponential", taken) + jump)
    assert np.abs(stamps - taken - jump)[1550:].max() < 40_000_000
    assert np.abs(stamps - taken - jump)[2500:].max() < 5_000_000


def test_a_stall_whose_samples_come_at_once_moves_no_stamp():
    taken = sampled(30.0)
    times = late("uniform", taken)
    times[1500:1700] = times[1700]  # two seconds of samples in one heap
    stamps, clock = even(times)
    assert np.abs(errors_ms(stamps, taken)).max() < 1.0
    assert clock.counters["holes"] == 0


def test_a_header_of_zero_gives_way_to_the_time_of_arrival():
    stamps = Stamps(StampConfig(left="even"))
    taken = sampled(10.0)
    arrived = late("uniform", taken)
    found = [stamps.stamp("left", 0, t) for t in arrived.tolist()]
    assert stamps.settling("left") is False and stamps.counters["left_settling"] <= 500
    assert found[-1] is not None and abs(found[-1] - int(taken[-1])) < 2_000_000


def test_single_stamps_that_cannot_be_do_no_harm():
    taken = sampled(30.0)
    times = late("uniform", taken)
    times[1000], times[2000] = START_NS - SECOND * 10**6, START_NS + SECOND * 10**6
    stamps, _ = even(times)
    off_ms = np.abs((stamps - taken) * 1e-6 - errors_base(stamps, taken))
    wrong = np.flatnonzero(off_ms[600:] > 1.0) + 600
    assert set(wrong) <= {1000, 2000}


def test_samples_that_are_no_stream_are_withheld_and_nothing_is_raised():
    rng = np.random.default_rng(3)
    clock = EvenClock()
    for time_ns in rng.integers(0, 2**62, 3000).tolist():
        clock.update(time_ns, 0)
    for _ in range(500):
        clock.update(START_NS, 0)
    assert clock.state.phase in ("settling", "acquiring", "tracking", "refused")
