"""Recordings on disk: rosbag2 bags, sensor exports and references, in and out."""

from typing import TYPE_CHECKING

from ..lazy_face import lazy_face

if TYPE_CHECKING:
    from ..core import RecordingError
    from .atomic import check_file, check_target, new_directory, new_file, new_files, write_text
    from .log_times import read_arrivals
    from .open_bag import METADATA, is_bag, list_topics
    from .read import read_bag, read_logged
    from .recording import ClockStep, Correction, Recording
    from .reference import Reference
    from .snapshot_file import read_snapshot, write_snapshot
    from .storage.bag_source import TopicInfo
    from .storage.bag_writer import new_bag
    from .storage.file_arrays import keep_large_arrays_on_disk
    from .topic_choice import TopicChoice, choose_topics, find_topics, topics_of_foot
    from .topics import IMU_TYPE, PRESSURE_TOPICS, Topics
    from .track_bag import OdometrySeries, write_track_bag
    from .unit_evidence import UnitEvidence, evidence_of
    from .write import STORAGES, write_bag

__getattr__, __dir__ = lazy_face(__name__)

__all__ = [
    "IMU_TYPE",
    "METADATA",
    "PRESSURE_TOPICS",
    "STORAGES",
    "ClockStep",
    "Correction",
    "OdometrySeries",
    "Recording",
    "RecordingError",
    "Reference",
    "TopicChoice",
    "TopicInfo",
    "Topics",
    "UnitEvidence",
    "check_file",
    "check_target",
    "choose_topics",
    "evidence_of",
    "find_topics",
    "is_bag",
    "keep_large_arrays_on_disk",
    "list_topics",
    "new_bag",
    "new_directory",
    "new_file",
    "new_files",
    "read_arrivals",
    "read_bag",
    "read_logged",
    "read_snapshot",
    "topics_of_foot",
    "write_bag",
    "write_snapshot",
    "write_text",
    "write_track_bag",
]
