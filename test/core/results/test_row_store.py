"""A trajectory has the bits of the kernel's rows, whatever is kept of them."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dualfoot_ros.core import DualFootTracker, EventKind, Trajectory
from dualfoot_ros.core.kernel import Workspace, interpreted
from dualfoot_ros.core.kernel import layout as lay
from dualfoot_ros.core.results.row_store import RowStore
from dualfoot_ros.core.samples.series import stack_pairs
from dualfoot_ros.simulation import WalkConfig, grade, simulate

from ..following import live, same_bits
from ..harness import Pairs, quick_engine

OF_FOOT = {
    "position_covariance": lay.O_COV_POS,
    "velocity_covariance": lay.O_COV_VEL,
    "attitude_covariance": lay.O_COV_ATT,
}


@cache
def walk():
    return simulate(WalkConfig(route="straight", rate=60.0), grade("consumer"), seed=5)


@cache
def tracked(covariances: bool) -> Trajectory:
    return DualFootTracker().run(walk().left, walk().right, covariances=covariances)


@cache
def followed():
    left, right = walk().left, walk().right
    return live(DualFootTracker(), Pairs(left.stamp_ns, stack_pairs(left, right)))


def test_every_cell_of_every_covariance_is_that_of_the_rows_turned_as_they_came():
    result, rows = tracked(covariances=True), followed().turned()
    assert result.of_kind(EventKind.HEADING)
    for foot, track in enumerate((result.left, result.right)):
        for name, start in OF_FOOT.items():
            cells = rows[:, foot * lay.O_FOOT + start :][:, :9]
            assert np.array_equal(getattr(track, name)[:].reshape(-1, 9), cells)
    relative = rows[:, lay.O_RELATIVE : lay.O_RELATIVE + 9]
    assert np.array_equal(result.relative_covariance[:].reshape(-1, 9), relative)


@pytest.mark.parametrize("name", OF_FOOT)
def test_without_covariances_all_else_is_the_same(name):
    result, whole = tracked(covariances=False), tracked(covariances=True)
    assert result.zupt_nis.tobytes() == whole.zupt_nis.tobytes()
    for track, same in zip((result.left, result.right), (whole.left, whole.right), strict=True):
        for part in ("position", "velocity", "quaternion", "stance", "present", "stamp_ns"):
            assert getattr(track, part).tobytes() == getattr(same, part).tobytes()
        assert getattr(track, name).shape == (len(track), 3, 3)
        assert np.isnan(getattr(track, name)[::50]).all()
    assert [e.stamp_ns for e in result.events] == [e.stamp_ns for e in whole.events]


@pytest.mark.parametrize("covariances", [False, True])
def test_the_heading_at_the_end_has_the_deviation_of_its_feet(covariances):
    feet = tracked(covariances=True).left, tracked(covariances=True).right
    stds = [math.sqrt(foot.attitude_covariance[-1][2, 2]) for foot in feet]
    assert tracked(covariances).heading_std == sum(stds) / 2


def test_the_heading_of_a_walk_that_ends_on_one_foot_is_that_of_the_foot():
    left, right = walk().left, walk().right
    gone = np.arange(len(right)) > len(right) - 100
    force, rate = (
        np.where(gone[:, np.newaxis], np.nan, part)
        for part in (right.specific_force, right.angular_rate)
    )
    right = replace(right, specific_force=force, angular_rate=rate)
    result = DualFootTracker().run(left, right)
    assert not result.right.present[-1]
    assert result.heading_std == math.sqrt(result.left.attitude_covariance[-1][2, 2])
    assert result.right.attitude_covariance[-1][2, 2] != result.left.attitude_covariance[-1][2, 2]


def test_a_live_run_has_the_same_rows():
    same_bits(followed(), tracked(covariances=True))


@pytest.mark.parametrize("engine", [quick_engine(), interpreted()])
@pytest.mark.parametrize("floor_std", [0.0, 0.3])
def test_the_kernel_keeps_the_cells_of_the_row_that_it_tells(engine, floor_std):
    space = Workspace(100.0, 1.0)
    w, n = space.w, space.n
    rng = np.random.default_rng(4)
    for foot in range(2):
        w[foot * lay.FOOT : foot * lay.FOOT + lay.ROT] = rng.normal(size=lay.ROT)
        rotation = Rotation.random(random_state=foot).as_matrix().ravel()
        w[foot * lay.FOOT + lay.ROT : foot * lay.FOOT + lay.ROT + 9] = rotation
    joint = rng.normal(size=(30, 30))
    space.put_covariance(joint @ joint.T)
    w[[lay.FLOOR_STD, lay.FLOOR_UP_STD]] = floor_std, 2.0 * floor_std
    w[lay.FLOOR_VEL : lay.FLOOR_VEL + 3] = 1.0, 2.0, 3.0
    w[[lay.C_HEIGHT_DRIFT, lay.WALKED, lay.Z_RIGHT + lay.Z_NIS]] = 0.1, 7.0, 5.0
    n[lay.N_EPOCH], n[lay.N_FLAGS] = 0, 2  # the right foot stands
    out, written, put = np.zeros((1, lay.OUT)), RowStore(2), RowStore(2)
    engine.emit(w, n, out, 0)
    engine.keep(w, n, 1, *written.arrays)
    put.put([1], out)
    for ours, theirs in zip(written.arrays, put.arrays, strict=True):
        assert np.asarray(ours).tobytes() == np.asarray(theirs).tobytes()
    assert np.count_nonzero(written.arrays[-1][1]) == 6 and not written.arrays[-1][0].any()


def test_without_covariances_the_kernel_writes_none():
    store = RowStore(3, covariances=False)
    space = Workspace(100.0, 1.0)
    space.w[[lay.ROT, lay.ROT + 4, lay.ROT + 8]] = 1.0
    quick_engine().keep(space.w, space.n, 2, *store.arrays)
    assert store.arrays[0][2, lay.K_QUAT :].tolist() == [0.0, 0.0, 0.0, 1.0]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("array", [0, 1, 5, -1])
def test_rows_that_are_no_numbers_are_found_out(bad, array):
    store, there = RowStore(9), np.ones((3, 2), dtype=bool)
    assert store.written(slice(3, 6), there, [0.1])
    store.arrays[array][4, 2] = bad
    assert store.written(slice(6, 9), there, [0.1])
    assert not store.written(slice(3, 6), there, [0.1])
    store.arrays[array][3:6] = 1e308  # whose sum is none
    assert store.written(slice(3, 6), there, [0.1])
