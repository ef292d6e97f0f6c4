"""The windows of a whole series are those that come one by one, to the bit."""

import numpy as np
import pytest

from dualfoot_ros.core import ImuSeries, TrackerConfig
from dualfoot_ros.core.alignment import FootStand, WholeWindows, WindowSlider, last_stand

SECONDS = 0.75


def stamps_of(kind: str, rng: np.random.Generator, count: int = 2500) -> np.ndarray:
    step = {"slow": 2e7, "fast": 1e9 / 400}.get(kind, 1e9 / 200)
    stamps = np.arange(count) * step
    if kind == "jittered":
        stamps += rng.uniform(0.0, 0.9 * step, count)
    if kind == "with holes":
        stamps = np.delete(stamps, np.r_[500:700, 1300:1420, 1800:1803])
    if kind == "few":
        stamps = np.arange(40) * 0.2e9
    return np.round(stamps).astype(np.int64) + 1_750_000_000_000_000_000


@pytest.mark.parametrize("kind", ["even", "slow", "fast", "jittered", "with holes", "few"])
@pytest.mark.parametrize("seconds", [SECONDS, 0.5, 1.3])
def test_every_window_has_the_bits_of_the_slider(kind, seconds):
    rng = np.random.default_rng(5)
    stamps = stamps_of(kind, rng)
    values = rng.normal(size=(len(stamps), 6)) * 10.0 ** rng.uniform(-3.0, 1.0, (len(stamps), 1))
    slider = WindowSlider(seconds)
    one_by_one = [slider.add(int(t), row) for t, row in zip(stamps, values, strict=True)]
    expected = [window for window in one_by_one if window is not None]
    whole = WholeWindows.over(stamps, values, seconds)
    assert len(whole) == len(expected) and (len(expected) > 0 or kind == "few")
    for k, window in enumerate(expected):
        mine = whole.window(k)
        assert (mine.end_ns, mine.seconds) == (window.end_ns, window.seconds)
        assert mine.mean == window.mean and mine.std == window.std


@pytest.mark.parametrize("stands", [[], [(3.0, 6.0)], [(1.0, 4.0), (7.0, 7.9)], [(8.0, 12.0)]])
def test_the_last_stand_is_the_last_run_of_quiet_windows_that_lasts(stands):
    config, rng = TrackerConfig(), np.random.default_rng(2)
    stamps = stamps_of("even", rng)
    values = rng.normal(size=(len(stamps), 6))
    for begin, end in stands:
        quiet = slice(round(begin * 200), round(end * 200))
        still = [0.0, 0.0, config.gravity, 0.01, -0.02, 0.0]
        values[quiet] = still + 1e-3 * values[quiet]
    found = last_stand(ImuSeries(stamps, values[:, :3], values[:, 3:]), config)
    expected = searched_forwards(stamps, values, config)
    assert (found is None) == (expected is None) == (not stands)
    if expected is not None:
        assert np.array_equal(found.angular_rate, expected.angular_rate)
        assert (found.end_ns, found.rate_std) == (expected.end_ns, expected.rate_std)


def searched_forwards(stamps: np.ndarray, values: np.ndarray, config: TrackerConfig):
    """Return the newest stand of two seconds, found window by window as they come."""
    slider, stand, found = WindowSlider(config.alignment.window), FootStand(config.alignment), None
    for stamp, row in [*zip(stamps, values, strict=True), (None, None)]:
        window = None if stamp is None else slider.add(int(stamp), row)
        if window is None and stamp is not None:
            continue
        moving = window is None or window.motion(config.alignment, config.gravity) is not None
        if not moving and window.quiet(config.alignment):
            stand.add(window)
            continue
        found = stand.result() if stand.seconds >= 2.0 else found
        stand.clear()
    return found


@pytest.mark.parametrize("kind", ["even", "jittered", "with holes", "few"])
def test_samples_taken_many_at_once_give_the_windows_of_those_taken_one_by_one(kind):
    rng = np.random.default_rng(7)
    stamps = stamps_of(kind, rng)
    values = rng.normal(size=(len(stamps), 6))
    alone, mixed, found, expected = WindowSlider(SECONDS), WindowSlider(SECONDS), [], []
    for k, row in enumerate(values):
        expected.append((k, alone.add(int(stamps[k]), row)))
    at = 0
    for size in (3, 200, 1, 350, 600, 5000):
        ahead = mixed.look_ahead(stamps[at : at + 2 * size], values[at : at + 2 * size])
        found += [(at + k, w) for k, w in mixed.windows(ahead) if k < size]
        mixed.take(ahead, min(size, len(stamps) - at))  # of those that were looked at
        at += size
        for k in range(at, min(at + 20, len(stamps))):
            found.append((k, mixed.add(int(stamps[k]), values[k])))
        at += 20
        if at >= len(stamps):
            break
    same_windows([f for f in found if f[1]], [e for e in expected if e[1]])


def same_windows(found, expected) -> None:
    assert [k for k, _ in found] == [k for k, _ in expected]
    for (_, one), (_, other) in zip(found, expected, strict=True):
        assert (one.end_ns, one.seconds) == (other.end_ns, other.seconds)
        assert np.array_equal(one.mean, other.mean) and np.array_equal(one.std, other.std)
