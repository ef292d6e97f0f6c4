"""Options of the importers."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ...core import FORWARD_LEFT_UP
from .tables import Layout

STAMPS = ("header", "log", "index")


@dataclass(frozen=True)
class ImportOptions:
    """The files to import and how; options that a format does not need keep their default.

    Attributes
    ----------
    sources : files that hold both feet
    left, right : files of one foot each
    axes : device axes that point forward, left and up, as ``core.axes_matrix`` reads it
    right_offset_s : added to every stamp of the right foot, s
    field_scale : tesla per unit of the magnetometer, 0 leaves it out
    left_topic, right_topic : sensor_msgs/Imu topics of a bag, or two as "ACCELEROMETER,GYRO"; None
        for those this package writes, else those whose names say which foot they are of
    capture : format of captured bytes, and options of its decoder, as ``witmotion?force_range=4``
    capture_rate : samples a second of a captured device that sends no time; 0 for one that does
    stamps : stamps of a bag, one of ``STAMPS``: those of the headers as they are, the log times
        evened out, or those of the headers evened out by the number of the sample
    increments : what the samples are, a value of ``Increments``; "auto" as the source says
    force_unit, rate_unit : units of the samples, keys of ``FORCE_UNITS``, ``RATE_UNITS``; None
        for SI (bags), and for what names, layout and motion tell (tables)
    layout : what is said about the layout of tables
    known_layout : the layout of tables, from a file; where None, ``preset`` or the table tells
    preset : name of a known layout, "" to recognise it
    left_device, right_device : what a column of devices calls the sensor of each foot
    """

    sources: tuple[Path, ...] = ()
    left: Path | None = None
    right: Path | None = None
    axes: str = FORWARD_LEFT_UP
    right_offset_s: float = 0.0
    field_scale: float = 0.0
    left_topic: str | None = None
    right_topic: str | None = None
    force_unit: str | None = None
    rate_unit: str | None = None
    stamps: str = "header"
    capture: str = ""
    capture_rate: float = 0.0
    increments: str = "auto"
    layout: Layout | None = None
    known_layout: Layout | None = None
    preset: str = ""
    left_device: str | None = None
    right_device: str | None = None
