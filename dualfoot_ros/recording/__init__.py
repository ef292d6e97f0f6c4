"""Recordings on disk: rosbag2 bags, sensor exports and references, in and out."""

from ..core import RecordingError
from .atomic import check_file, check_target, new_directory, new_files, write_text
from .log_times import read_arrivals
from .open_bag import METADATA, TopicInfo, list_topics
from .read import read_bag
from .recording import Correction, Recording
from .reference import Reference
from .topics import PRESSURE_TOPICS, Topics
from .unit_evidence import UnitEvidence, evidence_of
from .write import STORAGES, write_bag

__all__ = [
    "METADATA",
    "PRESSURE_TOPICS",
    "STORAGES",
    "Correction",
    "Recording",
    "RecordingError",
    "Reference",
    "TopicInfo",
    "Topics",
    "UnitEvidence",
    "check_file",
    "check_target",
    "evidence_of",
    "list_topics",
    "new_directory",
    "new_files",
    "read_arrivals",
    "read_bag",
    "write_bag",
    "write_text",
]
