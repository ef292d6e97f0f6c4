"""Real sensors: bytes of a device in, samples in SI units out."""

from ..core import SourceError
from .checks import CheckConfig, SensorCheck, SensorFault, SensorFinding
from .conditioning import Conditioner, ConditioningConfig
from .protocols.decoder import COUNTERS, Decoder
from .protocols.registry import FORMATS, make_decoder
from .reader import BackoffConfig, Reader, State
from .sample import Sample
from .source import Source, make_transport
from .transports.transport import Transport
from .uri import SCHEMES, SourceUri, parse_uri

Checks = CheckConfig
Conditioning = ConditioningConfig
"""Short names of the two, which programs of users have."""

__all__ = [
    "COUNTERS",
    "FORMATS",
    "SCHEMES",
    "BackoffConfig",
    "CheckConfig",
    "Checks",
    "Conditioner",
    "Conditioning",
    "ConditioningConfig",
    "Decoder",
    "Reader",
    "Sample",
    "SensorCheck",
    "SensorFault",
    "SensorFinding",
    "Source",
    "SourceError",
    "SourceUri",
    "State",
    "Transport",
    "make_decoder",
    "make_transport",
    "parse_uri",
]
