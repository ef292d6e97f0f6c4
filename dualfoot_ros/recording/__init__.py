"""Recordings on disk: rosbag2 bags, sensor exports, references, and the checks on them."""

from .errors import RecordingError
from .open_bag import TopicInfo, list_topics
from .read import read_bag
from .recording import Recording
from .reference import Reference
from .topics import Topics
from .write import write_bag

__all__ = [
    "Recording",
    "RecordingError",
    "Reference",
    "TopicInfo",
    "Topics",
    "list_topics",
    "read_bag",
    "write_bag",
]
