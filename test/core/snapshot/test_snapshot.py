"""A running tracker saved and loaded: it goes on bit for bit, or is refused with a reason."""

from functools import cache

import numpy as np
import pytest

from dualfoot_ros.core import DualFootTracker, EventKind, SnapshotError, TrackerConfig
from dualfoot_ros.core.constraints import METHODS

from ..carried.rides import pairs, ride
from ..following import key, live
from ..harness import quick_engine, walk

ENGINE = quick_engine().name
RATE = 60
AIDS = {"flat_floor": True, "barometer": True, "magnetic_heading": True, "straight_lines": True}


def settings(method, aids=False):
    return TrackerConfig.from_mapping({"method": method, **({"aids": AIDS} if aids else {})})


def fed(given, config, cut_s=None, engine=ENGINE):
    """Return what a tracker puts out, saved and loaded at some times."""
    tracker, found = DualFootTracker(config, engine=engine), None
    cuts = [round(s * RATE) for s in cut_s or ()]
    for first, last in zip([0, *cuts], [*cuts, len(given)], strict=True):
        found = live(tracker, given[first:last], found)
        tracker = DualFootTracker.load(tracker.save(), engine=engine)
    return found


def same(one, other):
    """Assert that both have put out the same bits and events."""
    assert np.array(one.rows).tobytes() == np.array(other.rows).tobytes()
    assert [key(event) for event in one.events] == [key(event) for event in other.events]


@pytest.mark.parametrize("method", METHODS.names())
def test_a_tracker_that_was_saved_in_mid_walk_goes_on_bit_for_bit(method):
    given = walk(12.0)
    config = settings(method)
    same(fed(given, config, [7.31, 10.0]), fed(given, config))


def test_the_aids_go_on_as_well():
    given, config = walk(12.0), settings("spacing_vector", aids=True)
    same(fed(given, config, [2.0, 8.1, 11.4]), fed(given, config))


def test_a_tracker_is_saved_before_its_start_and_while_it_still_refines():
    given, config = walk(9.0), settings("idc")
    same(fed(given, config, [0.5, 3.2]), fed(given, config))


@pytest.mark.parametrize("name", ["lift", "walkway"])
def test_a_tracker_is_saved_on_a_moving_floor(name):
    given, config = pairs(ride(name)), settings("spacing_vector")
    whole = fed(given, config)
    carried = [e.detected_ns for e in whole.events if e.kind is EventKind.CARRIED]
    cut_s = [round((ns - given.stamps[0]) * 1e-9 + 0.1, 2) for ns in carried]
    same(fed(given, config, cut_s), whole)


def test_the_interpreted_kernel_goes_on_where_the_compiled_one_was_saved():
    given = pairs(ride("walkway"))
    whole = fed(given, settings("spacing_vector"))
    begin = next(e for e in whole.events if e.kind is EventKind.CARRIED).detected_ns
    start = int(np.searchsorted(given.stamps, begin)) - RATE // 2
    tracker = DualFootTracker(settings("spacing_vector"), engine=ENGINE)
    live(tracker, given[:start])
    snapshot = tracker.save()
    tracks = []
    for engine in (ENGINE, "interpreted"):
        tracker = DualFootTracker.load(snapshot, engine=engine)
        tracks.append(live(tracker, given[start : start + RATE]))
    same(*tracks)
    assert any(e.kind is EventKind.CARRIED for e in tracks[0].events)


@cache
def snapshot() -> bytes:
    """Return a snapshot in mid-walk."""
    tracker = DualFootTracker(engine=ENGINE)
    live(tracker, walk(9.0))
    return tracker.save()


def test_the_same_tracker_gives_the_same_bytes_again():
    loaded = DualFootTracker.load(snapshot(), engine=ENGINE)
    assert loaded.save() == DualFootTracker.load(loaded.save(), engine=ENGINE).save()


@pytest.mark.parametrize("place", [0.2, 0.5, 0.999])
def test_a_damaged_snapshot_is_refused(place):
    data = bytearray(snapshot())
    data[int(place * len(data))] ^= 4
    with pytest.raises(SnapshotError, match="damaged"):
        DualFootTracker.load(bytes(data))


def test_half_a_snapshot_is_refused():
    with pytest.raises(SnapshotError, match="incomplete"):
        DualFootTracker.load(snapshot()[: len(snapshot()) // 2])


@pytest.mark.parametrize("data", [b"", b"dualfoot", b"\x80\x04pickle\n\n\n"])
def test_other_data_is_no_snapshot(data):
    with pytest.raises(SnapshotError, match="no snapshot"):
        DualFootTracker.load(data)


def test_another_format_is_refused_by_its_number():
    with pytest.raises(SnapshotError, match="format 2"):
        DualFootTracker.load(snapshot().replace(b"snapshot 1\n", b"snapshot 2\n", 1))


def test_a_snapshot_of_another_version_of_the_package_is_refused(monkeypatch):
    data = snapshot()
    monkeypatch.setattr("dualfoot_ros.core.snapshot.snapshot_format.__version__", "0.9.9")
    with pytest.raises(SnapshotError, match=r"here it is 0\.9\.9"):
        DualFootTracker.load(data)
