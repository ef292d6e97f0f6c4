"""Tables, files and figures of an evaluation."""

from .comparison_rows import csv_text, flat
from .comparison_tables import tables
from .output import METRICS, check_directory, report_folder, write_json
from .text_files import write_strides, write_tracks
from .walk_table import number, walk_table

__all__ = [
    "METRICS",
    "check_directory",
    "csv_text",
    "flat",
    "number",
    "report_folder",
    "tables",
    "walk_table",
    "write_json",
    "write_strides",
    "write_tracks",
]
