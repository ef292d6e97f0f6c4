"""Gait parameters of a walk, stride by stride and summed up, as gait laboratories define them."""

from .foot_contacts import FootContacts, find_contacts, forward_axis
from .gait_summary import PARAMETERS, Gait, Spread, summarise
from .strides import Stride, strides_of
from .strides_csv import strides_csv

__all__ = [
    "PARAMETERS",
    "FootContacts",
    "Gait",
    "Spread",
    "Stride",
    "find_contacts",
    "forward_axis",
    "strides_csv",
    "strides_of",
    "summarise",
]
