"""Snapshots of a tracker as files."""

import pytest

from dualfoot_ros.core import DualFootTracker, ImuPair, RecordingError, SnapshotError
from dualfoot_ros.recording import read_snapshot, write_snapshot


def standing(tracker, first, last):
    """Feed a standstill; return the newest row."""
    row = None
    for k in range(first, last):
        still = [0.0, 0.0, 9.80665 + 1e-3 * (k % 3)], [1e-3, 2e-3 * (k % 2), 0.0]
        row = tracker.add(ImuPair.of(k * 20_000_000, *still, *still)).row
    return row


def test_a_tracker_goes_on_from_its_file(tmp_path):
    tracker = DualFootTracker(engine="interpreted")
    standing(tracker, 0, 160)
    write_snapshot(tracker, tmp_path / "walk.snapshot")
    again = read_snapshot(tmp_path / "walk.snapshot", engine="interpreted")
    assert again.phase == tracker.phase == "standing"
    assert standing(again, 160, 170).tobytes() == standing(tracker, 160, 170).tobytes()


def test_another_file_is_no_snapshot(tmp_path):
    (tmp_path / "notes.txt").write_text("no snapshot")
    with pytest.raises(SnapshotError, match="no snapshot"):
        read_snapshot(tmp_path / "notes.txt")


def test_a_folder_is_not_replaced_by_a_snapshot(tmp_path):
    with pytest.raises(RecordingError, match="no ordinary file"):
        write_snapshot(DualFootTracker(engine="interpreted"), tmp_path)
