"""A rate that is used and is not that of the samples is said with both figures."""

import numpy as np
import pytest

from dualfoot_ros.evaluation import RunOptions, run
from dualfoot_ros.inspection import FindingKind, find_other_rate
from dualfoot_ros.recording import Recording
from dualfoot_ros.simulation import WalkConfig, simulate

STEP_NS = 10_000_000


def found(used_hz, stamps):
    return [finding.text for finding in find_other_rate(used_hz, np.asarray(stamps, np.int64))]


def test_the_rate_of_the_samples_is_no_finding_with_losses_holes_and_bunches():
    rng = np.random.default_rng(0)
    even = np.arange(2000) * STEP_NS
    lossy = even[rng.random(2000) > 0.1]
    bunched = even // (10 * STEP_NS) * (10 * STEP_NS) + np.arange(2000) % 10
    for stamps in (even, lossy, np.delete(even, slice(500, 1500)), bunched, even[:50]):
        assert found(100.0, stamps) == []


@pytest.mark.parametrize("seen_hz", [50, 62.5, 200])
def test_another_rate_is_said_with_both_figures(seen_hz):
    (text,) = found(100.0, np.arange(2000) * 1e9 / seen_hz)
    assert "100.0 Hz" in text and f"{seen_hz:.1f} Hz" in text


def test_a_recording_whose_rate_halves_after_the_start_is_a_warning():
    walk = simulate(WalkConfig(route="straight", standing=5.0, rate=120.0), seed=2)
    keep = np.arange(len(walk.left))
    keep = keep[(keep < 600) | (keep % 2 == 0)]
    recording = Recording(walk.left[keep], walk.right[keep])
    evaluation = run(recording, options=RunOptions(check_feet=False))
    (finding,) = (f for f in evaluation.findings if f.kind is FindingKind.RATE_USED)
    assert "120.0 Hz" in finding.text and "60.0 Hz" in finding.text
    plain = run(Recording(walk.left, walk.right), options=RunOptions(check_feet=False))
    assert not [f for f in plain.findings if f.kind is FindingKind.RATE_USED]
