"""Sensor exports and data sets, turned into recordings; one module a format."""

from .formats import FORMATS, Format, import_recording
from .options import ImportOptions

__all__ = ["FORMATS", "Format", "ImportOptions", "import_recording"]
