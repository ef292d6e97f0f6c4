"""Files appear whole or not at all, and what cannot be written is named as it was given."""

import os
import re
import resource
import shutil

import pytest

from dualfoot_ros.recording import RecordingError
from dualfoot_ros.recording.atomic import new_directory, new_files, write_text


def made(path):
    """Make a folder ``path`` as a bag is made."""
    with new_directory(path) as folder:
        folder.mkdir()


def text(path):
    write_text(path, "a\n")


@pytest.mark.parametrize("write", [text, made])
def test_below_a_file_nothing_is_written_and_the_path_given_is_named(write, tmp_path):
    (tmp_path / "file").write_text("mine")
    target = tmp_path / "file" / "deeper" / "x"
    with pytest.raises(OSError, match=f"'{re.escape(str(tmp_path))}/file' is no folder") as found:
        write(target)
    assert found.value.filename == str(target)
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


@pytest.mark.parametrize("write", [text, made])
def test_a_name_too_long_is_named_and_not_the_one_in_between(write, tmp_path):
    target = tmp_path / ("x" * 250)
    with pytest.raises(OSError, match="it cannot be written: File name too long") as found:
        write(target)
    assert found.value.filename == str(target)


def test_only_a_file_is_replaced(tmp_path):
    file, pipe, loose = (tmp_path / name for name in ("file", "pipe", "loose"))
    text(file)
    text(file)
    assert file.read_text() == "a\n"
    os.mkfifo(pipe)
    loose.symlink_to("nowhere")
    for other in (tmp_path, pipe, loose):
        with pytest.raises(RecordingError, match="no ordinary file"):
            text(other)
    assert pipe.is_fifo()
    assert loose.is_symlink()


def test_new_files_go_into_a_folder_that_keeps_what_is_not_theirs(tmp_path):
    target = tmp_path / "report"
    target.mkdir()
    for name in ("old.tum", "mine.txt", "same.json"):
        (target / name).write_text("old")
    with new_files(target, replacing=("*.tum",)) as folder:
        (folder / "same.json").write_text("new")
        assert (target / "old.tum").exists()
    assert {p.name: p.read_text() for p in target.iterdir()} == {
        "mine.txt": "old",
        "same.json": "new",
    }


@pytest.mark.parametrize("there", [True, False])
def test_files_of_a_block_that_fails_leave_the_folder_as_it_was(tmp_path, there):
    target = tmp_path / "report"
    if there:
        target.mkdir()
        (target / "old.tum").write_text("old")

    def fail():
        with new_files(target, replacing=("*.tum",)) as folder:
            (folder / "new.tum").write_text("new")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail()
    assert [p.name for p in tmp_path.rglob("*")] == (["report", "old.tum"] if there else [])


def large(path):
    """Write a file in the midst of a folder that is made."""
    with new_directory(path) as folder:
        folder.mkdir()
        (folder / "x").write_bytes(bytes(10_000))


def large_files(path):
    with new_files(path) as folder:
        (folder / "x").write_bytes(bytes(10_000))


@pytest.fixture
def full_disk():
    """Let no file grow beyond 1000 bytes."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def large_text(path):
    write_text(path, 10_000 * "a")


@pytest.mark.parametrize("write", [large, large_files, large_text])
def test_a_disk_that_is_full_is_said_of_the_output(write, tmp_path, full_disk):
    target = tmp_path / "x"
    with pytest.raises(OSError, match="it cannot be written: File too large") as found:
        write(target)
    assert found.value.filename == str(target)
    assert list(tmp_path.iterdir()) == []


def test_a_scratch_folder_goes_also_when_an_interrupt_comes_while_it_is_removed(
    tmp_path, monkeypatch
):
    remove, calls = shutil.rmtree, []

    def interrupted(*args, **kwargs):
        calls.append(args)
        if len(calls) == 1:
            raise KeyboardInterrupt
        remove(*args, **kwargs)

    monkeypatch.setattr(shutil, "rmtree", interrupted)
    with pytest.raises(KeyboardInterrupt):
        text(tmp_path / "x")
    assert [p.name for p in tmp_path.iterdir()] == ["x"]


def test_what_was_to_be_replaced_comes_back_when_the_new_one_does_not(tmp_path):
    target = tmp_path / "walk"
    made(target)
    (target / "mine").write_text("old")
    with pytest.raises(FileNotFoundError), new_directory(target, overwrite=True):
        pass  # nothing is made
    assert [str(p.relative_to(tmp_path)) for p in tmp_path.rglob("*")] == ["walk", "walk/mine"]
