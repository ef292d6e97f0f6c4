"""Files appear whole or not at all, and what cannot be written is named as it was given."""

import os
import re

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
