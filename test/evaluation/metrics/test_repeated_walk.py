"""A walk walked four times over, and the feet at the 68th stride."""

import numpy as np
import pytest

from dualfoot_ros.core.results.trajectory import Trajectory
from dualfoot_ros.core.samples.series import ImuSeries
from dualfoot_ros.evaluation.metrics.repeated_walk import repeated, rounds, stride_place
from dualfoot_ros.recording import Recording, Reference

from ..walks import perfect, rectangle


def markers() -> np.ndarray:
    """Return the 21 floor markers of Ma and Särkkä, counter-clockwise, y forward."""
    return np.column_stack([rectangle(), np.zeros(21)])


def series(count: int, first_ns: int = 0) -> ImuSeries:
    stamps = first_ns + np.arange(count) * 10_000_000
    values = np.arange(3 * count, dtype=float).reshape(-1, 3)
    return ImuSeries(stamps, values, -values)


def test_the_samples_follow_each_other_at_one_rate_n_times():
    found = repeated(Recording(left=series(50), right=series(50)), 4)
    assert len(found.left) == 200 == len(found.right)
    assert set(np.diff(found.left.stamp_ns)) == {10_000_000}
    assert np.array_equal(found.right.specific_force[150:], series(50).specific_force)


def test_once_is_the_recording_itself():
    recording = Recording(left=series(50), right=series(50))
    assert repeated(recording, 1) is recording


def test_four_rectangles_that_end_to_the_right_are_a_windmill_that_closes():
    joined = rounds(markers(), 4)
    assert len(joined) == 81
    assert np.allclose(joined[-1], joined[0])
    assert np.allclose(joined[20:41], markers()[:, [1, 0, 2]] * [1, -1, 1], atol=1e-12)


def test_the_68th_stance_is_where_the_paper_has_it_but_for_the_place_of_its_sensor():
    """(-8.3, 0.0) m in the paper; seven strides of 1.2 m into the fourth round."""
    assert np.allclose(rounds(markers(), 4)[67], [-8.4, 0.0, 0.0], atol=1e-9)


def test_markers_go_along_and_a_loop_is_no_longer_said_to_close():
    reference = Reference("tape", {"right": markers()}, closed_loop=True, length_m=24.0)
    found = repeated(Recording(left=series(50), right=series(50), reference=reference), 3)
    assert found.reference.length_m == 72.0 and not found.reference.closed_loop
    assert len(found.reference.markers["right"]) == 61


def windmill() -> tuple[Trajectory, np.ndarray]:
    """Return an errorless walk of four rounds, x along the first strides, and its markers."""
    points = rounds(markers(), 4)
    return perfect(np.column_stack([points[:, 1], -points[:, 0]]))[0], points


def test_an_errorless_walk_has_no_error_in_the_table():
    run, points = windmill()
    place = stride_place(run, points)
    assert place.right == pytest.approx((-8.4, 0.0), abs=0.2)
    assert place.true_right == pytest.approx((-8.4, 0.0), abs=1e-9)
    assert place.true_left == pytest.approx((-7.8, -0.2), abs=1e-9)
    across = place.right[1] - place.left[1]
    assert across == pytest.approx(0.2, abs=1e-6)
    assert place.left[0] - place.right[0] == pytest.approx(0.6, abs=1e-6)


def test_a_walk_that_is_too_short_has_no_68th_stride():
    run, _ = windmill()
    assert stride_place(run, None, number=82) is None


def test_without_as_many_markers_as_stances_nothing_is_true():
    run, points = windmill()
    place = stride_place(run, points[:-1])
    assert place.true_right is None and place.true_left is None
