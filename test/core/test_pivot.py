"""The point about which the foot pivots: below the sensor, and behind it along the foot."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import DualFootTracker, TrackerConfig
from dualfoot_ros.core.results.trajectory import stance_middles
from dualfoot_ros.evaluation import track
from dualfoot_ros.recording.importers import ImportOptions, import_recording

from .harness import Pairs, walk


def tracked(pairs: Pairs, back: float):
    config = TrackerConfig.from_mapping({"method": "zupt", "zupt.lever_back": back})
    return DualFootTracker(config).run(*pairs.series())


def climbs(run) -> list[float]:
    """Return by how much each foot's last stance is above its first, m."""
    found = []
    for foot in (run.left, run.right):
        middles = stance_middles(foot.stance)
        found.append(float(foot.position[middles[-1], 2] - foot.position[middles[0], 2]))
    return found


@pytest.mark.parametrize("mounted_deg", (-90.0, 40.0, 180.0))
def test_the_pivot_is_behind_along_the_way_of_the_foot_however_the_sensor_is_turned(mounted_deg):
    """Until its heading is known, a foot is taken to point along its sensor: three strides."""
    pairs = walk()
    turn = Rotation.from_euler("z", mounted_deg, degrees=True)
    blocks = [turn.apply(pairs.values[:, k : k + 3]) for k in (0, 3, 6, 9)]
    turned = Pairs(pairs.stamps, np.hstack(blocks))
    for back in (0.0, 0.1):
        straight, other = climbs(tracked(pairs, back)), climbs(tracked(turned, back))
        assert other == pytest.approx(straight, abs=0.25)
    assert max(climbs(tracked(pairs, 0.1))) < min(climbs(tracked(pairs, 0.0))) - 0.3


def test_eight_centimetres_behind_real_insteps_take_the_climb_of_level_walks_away(dual_feet):
    """24 m on one floor: 0.3 to 0.6 m of climb without, centimetres with it."""
    climbed = {0.0: [], 0.08: []}
    for path in sorted((dual_feet / "rectangle_ccw").glob("*.mat"))[:5]:
        recording = import_recording(ImportOptions(sources=(path,)))
        for back, found in climbed.items():
            config = {"method": "zupt", "zupt.lever_back": back}
            found.extend(climbs(track(recording, TrackerConfig.from_mapping(config))))
    assert min(climbed[0.0]) > 0.15
    assert np.abs(climbed[0.08]).max() < 0.25
    assert np.sqrt(np.mean(np.square(climbed[0.08]))) < 0.15
