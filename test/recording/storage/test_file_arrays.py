"""Large arrays in files: what is in them, what is in memory, and what is left on disk."""

import errno
import tempfile
import time
from pathlib import Path

import numpy as np
import pytest

from dualfoot_ros.core import RecordingError, make_large_arrays_in, new_array
from dualfoot_ros.core.samples import large_arrays
from dualfoot_ros.recording import keep_large_arrays_on_disk
from dualfoot_ros.recording.storage import file_arrays

MEGABYTE = 1 << 20


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Keep large arrays in a folder of their own, until the end of the test."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", None)
    keep_large_arrays_on_disk()
    yield tmp_path
    make_large_arrays_in(None)


def in_memory(array: np.ndarray) -> bool:
    return array.base is None


def test_an_array_is_in_a_file_from_the_bound_on_and_where_a_program_asks_for_it(folder):
    rows = large_arrays.LARGE // 24
    assert in_memory(new_array((rows, 3)))
    large = new_array((rows + 1, 3))
    assert not in_memory(large)
    assert large.shape == (rows + 1, 3) and large.dtype == np.float64 and not large.any()
    make_large_arrays_in(None)
    assert in_memory(new_array((rows + 1, 3)))


def test_nothing_of_a_file_is_seen_in_its_folder_while_it_is_in_use(folder):
    array = new_array((large_arrays.LARGE,), np.int64)
    array[:] = 7
    assert list(folder.iterdir()) == []


def test_what_was_written_is_there_when_its_pages_have_been_let_go_of(folder):
    array = new_array((large_arrays.LARGE // 8,))
    array[:] = np.arange(len(array))
    file_arrays.FILES.let_go()
    np.testing.assert_array_equal(array, np.arange(len(array)))


def test_a_thread_lets_go_of_what_is_resident(folder):
    array = new_array((4 * file_arrays.MOST_RESIDENT,), np.uint8)
    before = resident()
    array[:] = 1
    deadline = time.monotonic() + 10.0
    while resident() - before > file_arrays.MOST_RESIDENT and time.monotonic() < deadline:
        time.sleep(file_arrays.EVERY_S)
    assert resident() - before <= file_arrays.MOST_RESIDENT
    assert array.all()


def resident() -> int:
    """Return the bytes of files in memory."""
    return int(Path(file_arrays.STATM).read_text().split()[2]) * 4096


@pytest.mark.parametrize("advice", [None, -1])
def test_a_system_without_large_pages_has_small_ones(folder, monkeypatch, advice):
    if advice is None:
        monkeypatch.delattr(file_arrays.mmap, "MADV_HUGEPAGE", raising=False)
    else:  # one that the system refuses
        monkeypatch.setattr(file_arrays.mmap, "MADV_HUGEPAGE", advice, raising=False)
    array = new_array((large_arrays.LARGE,), np.uint8)
    array[:] = 1
    assert not in_memory(array) and array.all()


def test_a_disk_without_room_is_named_with_what_was_needed(folder, monkeypatch):
    def full(_file: int, _start: int, _size: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(file_arrays.os, "posix_fallocate", full)
    with pytest.raises(RecordingError, match=rf"needs 200 MB in {folder}, where \d+ MB are free"):
        new_array((25_000_000,))
    assert list(folder.iterdir()) == []


def test_without_tmpdir_the_files_are_where_a_system_keeps_large_ones(folder, monkeypatch):
    monkeypatch.delenv("TMPDIR")
    assert file_arrays.room() in {
        file_arrays.ROOMY,
        Path(tempfile.gettempdir()),
    }
