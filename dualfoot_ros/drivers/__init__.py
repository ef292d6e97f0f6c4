"""Real sensors: bytes of a device in, samples in SI units out."""

from ..core import SourceError
from .checks import Checks, SensorCheck
from .conditioning import Conditioner, Conditioning
from .protocols.decoder import COUNTERS, Decoder
from .protocols.registry import FORMATS, make_decoder
from .reader import Backoff, Reader, State
from .sample import Sample
from .source import Source, make_transport
from .transports.transport import Transport
from .transports.udp import UdpTransport
from .uri import SCHEMES, SourceUri, parse_uri

__all__ = [
    "COUNTERS",
    "FORMATS",
    "SCHEMES",
    "Backoff",
    "Checks",
    "Conditioner",
    "Conditioning",
    "Decoder",
    "Reader",
    "Sample",
    "SensorCheck",
    "Source",
    "SourceError",
    "SourceUri",
    "State",
    "Transport",
    "UdpTransport",
    "make_decoder",
    "make_transport",
    "parse_uri",
]
