"""The track of a walk for other programs: maps, tables, robots."""

from .estimate_bag import write_estimate_bag
from .floor_plan import FloorPlan
from .geo_files import write_geo_files
from .geo_origin import GeoOrigin, start_direction
from .person_files import write_person
from .tum import write_tum

__all__ = [
    "FloorPlan",
    "GeoOrigin",
    "start_direction",
    "write_estimate_bag",
    "write_geo_files",
    "write_person",
    "write_tum",
]
