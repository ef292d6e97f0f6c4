"""Tables as text: any layout, found from names, header, motion and options."""

from .assumptions import Assumption, Origin, from_note, to_note
from .column_choice import parse_columns
from .feet_tables import SUFFIXES, Intake, read_feet, read_one
from .known_layouts import BY_NAME, LAYOUTS
from .layout_file import layout_text, load_layout
from .sensor_reading import Reading
from .table_layout import ROLES, Layout
from .unit_words import SAMPLES, TIME_UNITS

__all__ = [
    "BY_NAME",
    "LAYOUTS",
    "ROLES",
    "SAMPLES",
    "SUFFIXES",
    "TIME_UNITS",
    "Assumption",
    "Intake",
    "Layout",
    "Origin",
    "Reading",
    "from_note",
    "layout_text",
    "load_layout",
    "parse_columns",
    "read_feet",
    "read_one",
    "to_note",
]
