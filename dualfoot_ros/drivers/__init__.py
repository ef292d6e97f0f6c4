"""Real sensors: bytes of a device in, samples in SI units out."""

from .decoder import COUNTERS, Decoder
from .errors import SourceError
from .formats import FORMATS, make_decoder
from .sample import Sample

__all__ = ["COUNTERS", "FORMATS", "Decoder", "Sample", "SourceError", "make_decoder"]
