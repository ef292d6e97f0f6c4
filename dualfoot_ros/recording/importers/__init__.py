"""Sensor exports and data sets, turned into recordings; one module a format."""

from .formats import FORMATS, Format, import_recording
from .options import STAMPS, ImportOptions
from .pressure_csv import read_pressure
from .xsens_dot import read_sensor

__all__ = [
    "FORMATS",
    "STAMPS",
    "Format",
    "ImportOptions",
    "import_recording",
    "read_pressure",
    "read_sensor",
]
