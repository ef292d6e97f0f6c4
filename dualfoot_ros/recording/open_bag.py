"""Opening of rosbag2 recordings; any defect becomes a RecordingError with one sentence."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..core import RecordingError

if TYPE_CHECKING:
    from rosbags.interfaces import Connection
    from rosbags.rosbag2 import Reader

METADATA = "metadata.yaml"
HEAD = 200  # characters that hold the first key


def is_bag(folder: Path) -> bool:
    """Return whether ``folder`` is that of a rosbag2 recording, whole or damaged."""
    try:
        with (folder / METADATA).open(encoding="utf-8", errors="replace") as file:
            return "rosbag2" in file.read(HEAD)
    except OSError:
        return False


class TopicInfo(NamedTuple):
    """Type and number of messages of one topic of a bag."""

    msgtype: str
    messages: int


def list_topics(path: str | Path) -> dict[str, TopicInfo]:
    """Return topic -> type and number of messages; raise as :func:`opened`."""
    with opened(Path(path)) as reader:
        return {
            topic: TopicInfo(info.msgtype or "several types", info.msgcount)
            for topic, info in reader.topics.items()
        }


@contextmanager
def opened(path: Path) -> Iterator[Reader]:
    """Open the bag ``path`` for the block.

    Raises
    ------
    RecordingError
        When it is not there, is no bag, or is damaged.
    OSError
        When it may not be read.
    """
    from rosbags.rosbag2 import Reader

    _check_is_bag(path)
    try:
        reader = Reader(path)
        reader.open()
    except PermissionError:
        raise
    except Exception as error:  # a broken file leads the reader to raise nearly anything
        raise _damaged(path, error) from error
    try:
        yield reader
    finally:
        reader.close()


def iterate(
    path: Path, reader: Reader, connections: list[Connection]
) -> Iterator[tuple[str, bytes]]:
    """Yield topic and raw bytes of every message; raise RecordingError where the bag is broken."""
    if not connections:
        return
    try:
        for connection, _, data in reader.messages(connections):
            yield connection.topic, data
    except GeneratorExit:
        raise
    except Exception as error:
        raise _damaged(path, error) from error


def _check_is_bag(path: Path) -> None:
    if not path.exists():
        raise RecordingError(f"there is no bag '{path}'; give the folder of a rosbag2 recording")
    if path.is_dir() and not (path / METADATA).exists():
        raise RecordingError(
            f"folder '{path}' is no rosbag2 recording (it has no {METADATA}); give the folder "
            "of one, or run 'ros2 bag reindex' on it when the recording was cut off"
        )
    if path.is_file() and path.suffix not in (".mcap", ".db3"):
        raise RecordingError(
            f"'{path}' is no rosbag2 recording; allowed is the folder of a bag, a .mcap or a .db3 "
            "file; a sensor's export is turned into a bag by 'dualfoot import'"
        )


def _damaged(path: Path, error: Exception) -> RecordingError:
    reason = " ".join(str(error).split()).rstrip(".") or type(error).__name__
    return RecordingError(
        f"bag '{path}' is damaged or cut off and cannot be read ({reason}); try "
        "'ros2 bag reindex' on it, or record again"
    )
