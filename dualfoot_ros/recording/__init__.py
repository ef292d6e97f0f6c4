"""Recordings on disk: rosbag2 bags, sensor exports and references, in and out."""

from ..core import RecordingError
from .atomic import check_file, check_target, new_directory, new_files, write_text
from .increments_topic import latched_qos
from .log_times import read_arrivals
from .open_bag import METADATA, TopicInfo, is_bag, list_topics
from .read import read_bag
from .recording import Correction, Recording
from .reference import Reference
from .topics import PRESSURE_TOPICS, Topics
from .track_bag import OdometrySeries, write_track_bag
from .write import STORAGES, write_bag

__all__ = [
    "METADATA",
    "PRESSURE_TOPICS",
    "STORAGES",
    "Correction",
    "OdometrySeries",
    "Recording",
    "RecordingError",
    "Reference",
    "TopicInfo",
    "Topics",
    "check_file",
    "check_target",
    "is_bag",
    "latched_qos",
    "list_topics",
    "new_directory",
    "new_files",
    "read_arrivals",
    "read_bag",
    "write_bag",
    "write_text",
    "write_track_bag",
]
