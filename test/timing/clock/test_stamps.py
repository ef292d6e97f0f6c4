"""Each foot's samples are stamped by the policy chosen for it."""

import numpy as np
import pytest

from dualfoot_ros.core.errors import ConfigError
from dualfoot_ros.simulation.arrivals import BleLinkConfig, arrivals
from dualfoot_ros.timing import StampConfig, Stamps


def test_headers_pass_untouched_by_default():
    stamps = Stamps()
    assert stamps.stamp("left", 12345, 99) == 12345
    assert stamps.states == {}


def test_arrival_and_a_fixed_offset():
    stamps = Stamps(StampConfig(left="arrival", right_offset=-1.5))
    assert stamps.stamp("left", 12345, 99) == 99
    assert stamps.stamp("right", 2_000_000_000, 7) == 500_000_000


def test_another_policy_is_refused_by_name():
    with pytest.raises(ConfigError, match=r"left.*'guess'.*header, device, arrival"):
        StampConfig(left="guess")


def test_devices_with_clocks_of_their_own_agree_on_the_host():
    errors = relative_error_ms("separate", (40.0, 0.004), (-900.0, 0.004))
    assert np.abs(errors).max() < 3.0


def test_with_separate_clocks_a_difference_of_the_least_delays_is_an_offset_between_the_feet():
    errors = relative_error_ms("separate", (10.0, 0.004), (10.0, 0.024))
    assert np.median(errors) == pytest.approx(20.0, abs=1.0)


def test_devices_that_share_a_clock_keep_their_offset_whatever_the_links_do():
    errors = relative_error_ms("shared", (10.0, 0.004), (10.0, 0.024))
    assert np.abs(errors).max() < 1e-3


def test_feet_that_share_a_clock_begin_together_though_one_link_is_slow():
    stamps = Stamps(StampConfig(left="device", right="device", agreement="shared"))
    slow = arrivals(
        BleLinkConfig(interval=0.05, burst=20), np.arange(800) * 10**7, np.random.default_rng(0)
    )
    calls = [(k * 10**7 + 10**6, k, "left") for k in range(800)]
    calls += [(int(a), k, "right") for k, a in enumerate(slow)]
    begun = {}
    for n, (arrived, k, foot) in enumerate(sorted(calls)):
        if stamps.stamp(foot, k * 10**7, arrived) is not None:
            begun.setdefault(foot, n)
    assert begun["right"] - begun["left"] < 41  # a burst
    assert not stamps.settling("left") and not stamps.settling("right")


def relative_error_ms(agreement, left, right):
    """Return the offset (N,) between the feet after 20 s; each foot has drift and least delay."""
    stamps = Stamps(StampConfig(left="device", right="device", agreement=agreement))
    true = np.round(np.arange(4000) * 1e7).astype(np.int64)
    feet = {"left": left, "right": right}
    calls = []
    for k, (foot, (drift, least)) in enumerate(feet.items()):
        device = np.round(true * (1.0 + 1e-6 * drift)).astype(np.int64)
        link = BleLinkConfig(interval=0.0371, least=least)
        arrived = arrivals(link, true, np.random.default_rng(k))
        calls += [
            (int(a), int(d), i, foot) for i, (d, a) in enumerate(zip(device, arrived, strict=True))
        ]
    found = {foot: np.zeros(4000) for foot in feet}
    for arrived, device, i, foot in sorted(calls):
        stamp_ns = stamps.stamp(foot, device, arrived)
        found[foot][i] = np.nan if stamp_ns is None else stamp_ns - int(true[i])
    return (found["right"] - found["left"])[2000:] * 1e-6
