"""Sensor exports and data sets, turned into recordings; one module a format."""

from .csv_tables import read_sensor, read_sensors
from .formats import (
    FORMATS,
    Format,
    check_as_it_is,
    import_recording,
    is_export,
    is_table,
)
from .options import STAMPS, ImportOptions
from .pressure_csv import read_pressure

__all__ = [
    "FORMATS",
    "STAMPS",
    "Format",
    "ImportOptions",
    "check_as_it_is",
    "import_recording",
    "is_export",
    "is_table",
    "read_pressure",
    "read_sensor",
    "read_sensors",
]
