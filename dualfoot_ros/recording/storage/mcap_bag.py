"""Bags of whole MCAP files, by what their ``metadata.yaml`` and the index of each file say.

It takes the ordinary bag only.  Whatever is unusual is a ``ValueError`` here, and another source
reads it or says what is wrong; that one takes ten times as long to be loaded.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from pathlib import Path, PurePath
from typing import Any

from .bag_source import Block, TopicInfo
from .mcap_chunks import McapChunks
from .mcap_format import HEAD, HEADER, MAGIC
from .mcap_scan import text

NEWEST = 9  # version of metadata.yaml
UNCOMPRESSED = ("", "none")  # as a whole or message by message; chunks may be compressed
PROFILE = "ros2"


class McapBag:
    """The folder of a bag whose storage is MCAP."""

    cut = ""

    def __init__(self, path: Path) -> None:
        """Open the folder ``path``.

        Raises
        ------
        ValueError, KeyError, TypeError, AttributeError, OSError, struct.error
            When it is another kind of bag, or damaged.
        """
        facts = _metadata(path / "metadata.yaml")
        names = [path / PurePath(name).name for name in facts["relative_file_paths"]]
        self._files = [_file(name, number) for number, name in enumerate(names)]
        self.topics = dict(sorted(_topics(facts["topics_with_message_count"])))
        custom = facts.get("custom_data")
        self.custom = dict(custom) if isinstance(custom, Mapping) else {}

    def blocks(self, topics: Collection[str]) -> Iterator[Block]:
        """Yield the messages of ``topics`` in blocks, by the chunks of the files."""
        for file in self._files:
            yield from file.blocks(topics)

    def close(self) -> None:
        """Do nothing: the files are open while they are read only."""


def _file(path: Path, number: int) -> McapChunks:
    """Return the chunks of a file that begins as one of ROS 2."""
    with path.open("rb") as file:
        magic = file.read(len(MAGIC))
        opcode, length = HEAD.unpack(file.read(HEAD.size))
        profile = text(file.read(min(length, 4 + len(PROFILE))), 0)
    if (magic, opcode, profile) != (MAGIC, HEADER, PROFILE):
        raise ValueError("it does not begin as a file of ROS 2")
    return McapChunks(path, number)


def _metadata(path: Path) -> dict[str, Any]:
    """Return what ``metadata.yaml`` says of the bag; all scalars are texts."""
    import yaml

    loader = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
    try:
        read = yaml.load(path.read_text(encoding="utf-8"), loader)  # noqa: S506
    except yaml.YAMLError as error:
        raise ValueError("its metadata is no YAML") from error
    facts: dict[str, Any] = read["rosbag2_bagfile_information"]
    mode = facts.get("compression_mode", "").lower()
    storage = facts["storage_identifier"]
    if int(facts["version"]) > NEWEST or storage != "mcap" or mode not in UNCOMPRESSED:
        raise ValueError("it is another kind of bag")
    return facts


def _topics(listed: list[dict[str, Any]]) -> Iterator[tuple[str, TopicInfo]]:
    """Yield name, type and number of messages of every topic, each of them listed once."""
    seen: set[str] = set()
    for entry in listed:
        topic = entry["topic_metadata"]
        if topic["name"] in seen or topic["serialization_format"] != "cdr":
            raise ValueError("its topics are listed in an unusual way")
        seen.add(topic["name"])
        yield topic["name"], TopicInfo(topic["type"], int(entry["message_count"]))
