"""The covariance through a whole walk with the distance constraint: symmetric and positive."""

from __future__ import annotations

import numpy as np
import pytest

from dualfoot_ros.core import EventKind, TrackerConfig
from dualfoot_ros.core.kernel import layout as lay

from .harness import follow, open_session, walk


def correlation(P: np.ndarray) -> np.ndarray:
    std = np.sqrt(np.diag(P))
    return P / np.outer(std, std)


@pytest.mark.parametrize("std", (0.0, 0.1))
@pytest.mark.parametrize("apply_at", ("moment", "detection"))
def test_p_is_symmetric_to_the_bit_and_positive_semi_definite_through_a_walk(std, apply_at):
    config = TrackerConfig.from_mapping(
        {"method": "idc", "idc.distance_std": std, "idc.apply_at": apply_at}
    )
    pairs = walk()
    session, start = open_session(config, pairs)
    w, applied, least = session.space.w, 0, 0.0
    left, right = (w[o : o + lay.BLOCK].reshape(15, lay.ROW) for o in (lay.PLL, lay.PRR))
    for epoch, events in follow(session, pairs, start):
        applied += sum(e.kind is EventKind.CONSTRAINT and e.accepted for e in events)
        for block in (left, right):
            assert np.array_equal(block[:, :15], block[:, :15].T)
            assert not block[:, 15].any()
        if epoch % 7 == 0 or events:
            P = session.space.covariance()
            assert (np.diag(P) > 0.0).all()
            least = min(least, float(np.linalg.eigvalsh(correlation(P))[0]))
    assert applied > 15
    assert least > -1e-10


def test_a_constraint_correlates_the_feet_and_shrinks_the_uncertainty_of_their_separation():
    config = TrackerConfig.from_mapping({"method": "idc", "idc.distance_std": 0.0})
    pairs = walk()
    session, start = open_session(config, pairs)
    free, free_start = open_session(TrackerConfig(method="zupt"), pairs)
    first = None
    for (_, events), _ in zip(
        follow(session, pairs, start), follow(free, pairs, free_start), strict=True
    ):
        if any(e.kind is EventKind.CONSTRAINT and e.accepted for e in events):
            first = session.space.covariance(), free.space.covariance()
            break
    assert first is not None
    bound, loose = first
    assert np.abs(bound[:3, 15:18]).max() > 0.0
    pick = np.hstack([np.eye(3), np.zeros((3, 12)), -np.eye(3), np.zeros((3, 12))])
    assert np.trace(pick @ bound @ pick.T) < np.trace(pick @ loose @ pick.T)
