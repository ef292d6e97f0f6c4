"""Opening of recordings; any defect becomes a RecordingError with one sentence.

A bag that was cut off, or whose index or metadata is broken, is read as far as it goes.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ..core import RecordingError
from .storage.bag_source import BagSource, Block, Chained, TopicInfo
from .storage.bag_writer import NO_LIBRARY, has_rosbag2_py, has_rosbags
from .storage.mcap_bag import McapBag
from .storage.mcap_scan import McapScan

if TYPE_CHECKING:
    from .storage.sqlite_scan import SqliteScan

METADATA = "metadata.yaml"
ROS1 = ".bag"
MCAP = ".mcap"
SUFFIXES = (MCAP, ".db3")
HEAD = 200  # characters that hold the first key
UNUSUAL = (ValueError, KeyError, TypeError, AttributeError, OSError, struct.error)


def is_bag(folder: Path) -> bool:
    """Return whether ``folder`` is that of a rosbag2 recording, whole or damaged."""
    try:
        with (folder / METADATA).open(encoding="utf-8", errors="replace") as file:
            return "rosbag2" in file.read(HEAD)
    except OSError:
        return False


def list_topics(path: str | Path) -> dict[str, TopicInfo]:
    """Return topic -> type and number of messages; raise as :func:`opened`."""
    with opened(Path(path)) as source:
        return dict(source.topics)


@contextmanager
def opened(path: Path) -> Iterator[BagSource]:
    """Open the bag ``path`` for the block: a folder, or a .mcap, .db3 or (ROS 1) .bag file.

    Raises
    ------
    RecordingError
        When it is not there, is no bag, or nothing of it can be read.
    OSError
        When it may not be read.
    """
    _check_is_bag(path)
    source = _open(path)
    try:
        yield source
    finally:
        source.close()


def iterate(path: Path, source: BagSource, topics: Collection[str]) -> Iterator[Block]:
    """Yield all messages of ``topics`` in blocks; raise RecordingError where the bag is broken."""
    count = 0
    try:
        for block in source.blocks(topics):
            yield block
            count += len(block.log_ns)
    except GeneratorExit:
        raise
    except Exception as error:
        raise RecordingError(
            f"bag '{path}' is damaged behind {count} messages ({_reason(error)}); copy it again "
            "from where it was recorded, or record again"
        ) from error


def _open(path: Path) -> BagSource:
    """Open a bag with its index; without one, each of its files as far as it goes."""
    try:
        return _open_whole(path)
    except (PermissionError, RecordingError):
        raise
    except Exception as error:  # a broken file leads the reader to raise nearly anything
        files = bag_files(path)
        if not files:
            raise _damaged(path, error) from error
        parts = [_open_file(file) for file in files]
        return parts[0] if len(parts) == 1 else Chained(parts)


def _open_whole(path: Path) -> BagSource:
    """Open a bag with its index, with what is there."""
    if path.suffix == ROS1 and path.is_file():
        if not has_rosbags():
            raise RecordingError(
                f"'{path}' is a bag of ROS 1, which needs the package rosbags: pip install rosbags"
            )
        from .storage.rosbags_source import Ros1Source

        return Ros1Source(path)
    if has_rosbags():
        return _mcap_bag(path) or _with_rosbags(path)
    if has_rosbag2_py():
        from .storage.rosbag2_py_source import Rosbag2PySource

        return Rosbag2PySource(path)
    raise RecordingError(NO_LIBRARY)


def _with_rosbags(path: Path) -> BagSource:
    from .storage.rosbags_source import RosbagsSource

    return RosbagsSource(path)


def _mcap_bag(path: Path) -> McapBag | None:
    """Return the ordinary bag of MCAP files; None for any other, or a damaged one."""
    try:
        return McapBag(path) if path.is_dir() else None
    except UNUSUAL:
        return None


def _open_file(file: Path) -> BagSource:
    """Open one file of a bag; what its index does not tell, its records do."""
    try:
        return _open_whole(file)
    except (PermissionError, RecordingError):
        raise
    except Exception as error:
        try:
            scan = _scan(file)
        except Exception:  # not even its first records can be read
            raise _damaged(file, error) from error
        if not any(topic.messages for topic in scan.topics.values()):
            raise _damaged(file, error) from error
        return scan


def _scan(file: Path) -> McapScan | SqliteScan:
    """Read a file of a bag from its start."""
    if file.suffix == MCAP:
        return McapScan(file)
    from .storage.sqlite_scan import SqliteScan  # here: it brings sqlite3

    return SqliteScan(file)


def bag_files(path: Path) -> list[Path]:
    """Return the .mcap or .db3 files of a bag, in the order of their numbers."""
    if path.is_file():
        return [path] if path.suffix in SUFFIXES else []
    for suffix in SUFFIXES:
        if found := [file for file in path.glob(f"*{suffix}") if file.is_file()]:
            return sorted(found, key=_natural_order)
    return []


def _natural_order(file: Path) -> list[tuple[int, str]]:
    parts = re.split(r"(\d+)", file.name)
    return [(int(part), "") if part.isdigit() else (-1, part) for part in parts]


def _check_is_bag(path: Path) -> None:
    if not path.exists():
        raise RecordingError(f"there is no bag '{path}'; give the folder of a rosbag2 recording")
    if path.is_dir() and not (path / METADATA).exists() and not bag_files(path):
        raise RecordingError(
            f"folder '{path}' is no rosbag2 recording: it has no {METADATA} and no .mcap or .db3 "
            "file; give the folder of one, or a bag file"
        )
    _check_readable(path)
    if path.is_file() and path.suffix not in (*SUFFIXES, ROS1):
        raise RecordingError(
            f"'{path}' is no recording of ROS; allowed is the folder of a bag, a .mcap, a .db3 or "
            "a .bag file; a sensor's export is turned into a bag by 'dualfoot import'"
        )


def _check_readable(path: Path) -> None:
    """Open the files of a bag once: a reader calls one that it may not open damaged."""
    for file in [path] if path.is_file() else bag_files(path):
        file.open("rb").close()


def _damaged(path: Path, error: Exception) -> RecordingError:
    return RecordingError(
        f"bag '{path}' is damaged or cut off, and nothing of it can be read ({_reason(error)}); "
        "record again"
    )


def _reason(error: Exception) -> str:
    return " ".join(str(error).split()).rstrip(".") or type(error).__name__
