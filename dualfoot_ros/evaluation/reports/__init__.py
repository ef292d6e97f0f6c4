"""Tables, files and figures of an evaluation."""

from .comparison_rows import csv_text, flat
from .comparison_tables import tables
from .output import check_directory, staged, write_metrics
from .tum import write_tracks
from .walk_table import number, walk_table

__all__ = [
    "check_directory",
    "csv_text",
    "flat",
    "number",
    "staged",
    "tables",
    "walk_table",
    "write_metrics",
    "write_tracks",
]
